//! Execution of arcs.

pub(crate) mod same;

use crate::{Event, Exec, Kind, MOTION};
use ncc_ir::canon::{AXES, Distance, FeedMode, Motion, Plane, Turn};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Nanos;
use ncc_ir::geometry::arc_solver::{ArcRule, Around, SolvedArc, solve_arc};
use ncc_ir::geometry::{self, ArcFault};
use ncc_ir::program::{Arc, ArcForm, Centre, CentreFrom, Point, Shape};
use ncc_ir::source::Span;
use ncc_ir::syntax::Ranged;
use ncc_ir::unexecuted::MoveUnexecuted;

/// Most turns of one arc; more is a slip of the pen.
const MOST_TURNS: u32 = 10_000;

/// Direction of the last move, for an arc that goes on in it. In program coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Heading {
    /// Not known: nothing has moved since the frame changed.
    None,
    /// Straight, from there to where the axes stand.
    From([Nanos; AXES]),
    /// The end of an arc in a plane.
    Bent(Plane, [f64; 2]),
}

/// An arc in program coordinates.
#[derive(Clone, Copy)]
struct Way {
    plane: Plane,
    turn: Turn,
    turns: u32,
    /// Position before it.
    before: [Nanos; AXES],
    /// Centre in the plane.
    centre: [Nanos; 2],
}

/// Start, end in the plane.
fn ends(plane: Plane, before: &[Nanos; AXES], after: &[Nanos; AXES]) -> [[Nanos; 2]; 2] {
    let (f, s, _) = plane.axes();
    [[before[f as usize], before[s as usize]], [after[f as usize], after[s as usize]]]
}

/// What execution knows where an arc begins.
struct Now<'e> {
    exec: &'e Exec,
    plane: Plane,
    before: &'e [Nanos; AXES],
    heading: Heading,
    /// Whether the third axis stays where it is.
    flat: bool,
    span: Span,
}

impl Around for Now<'_> {
    type Unknown = Diagnostic;

    fn value(&self, value: &Expr) -> Result<Nanos, Diagnostic> {
        self.exec.value(value, self.span)
    }

    fn via(&self, point: &Point) -> Result<[Nanos; 2], Diagnostic> {
        let (first, second, normal) = self.plane.axes();
        let via = self.exec.point(point, self.before, self.span)?;
        if via[normal as usize] != self.before[normal as usize] || !self.flat {
            self.exec.not_executed(MoveUnexecuted::CircleInSpace, self.span)?;
        }
        Ok([via[first as usize], via[second as usize]])
    }

    fn heading(&self) -> Result<[f64; 2], Diagnostic> {
        Ok(match self.heading {
            Heading::None => [0.0; 2],
            Heading::From(from) => {
                let [a, b] = ends(self.plane, &from, self.before);
                [(b[0] - a[0]) as f64, (b[1] - a[1]) as f64]
            }
            Heading::Bent(plane, direction) if plane == self.plane => direction,
            Heading::Bent(..) => [0.0; 2],
        })
    }

    fn rule(&self) -> (ArcRule, bool) {
        (self.exec.world.arcs, self.exec.modes.inch)
    }
}

impl Exec {
    pub(crate) fn arc(&mut self, arc: &Arc, span: Span, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let plane = self.plane_of(arc.plane);
        let (first, second, _) = plane.axes();
        let (f, s) = (first as usize, second as usize);
        let before = self.position;
        let from_zero = matches!(arc.centre, Centre::Point { from: CentreFrom::Zero, .. });
        if [f, s].contains(&self.along)
            && (from_zero || arc.to.axes[self.along].is_some())
            && self.another_length_waits()
        {
            // Its start is counted by one length, its end or its centre by the other.
            return self.not_executed(MoveUnexecuted::ArcTakesLength, span);
        }
        self.set_axes(&arc.to, span)?;
        let [start, end] = ends(plane, &before, &self.position);
        let centre = match &arc.centre {
            Centre::Point { words, from } => {
                let mut centre = start;
                for (c, axis) in centre.iter_mut().zip([f, s]) {
                    *c = match (&words[axis], from) {
                        (Some(word), CentreFrom::Start) => before[axis].wrapping_add(self.value(word, span)?),
                        (Some(word), CentreFrom::Zero) => self.value(word, span)?,
                        (None, CentreFrom::Start) => before[axis],
                        (None, CentreFrom::Zero) => return self.fault(Fault::ArcWithoutCentre, span),
                    };
                }
                let (radii, inch) = (geometry::radii(start, end, centre), self.modes.inch);
                if let Some(beside) = &mut self.beside {
                    beside.judge_radii(radii, inch);
                }
                self.world.arcs.check(radii, inch).map(|()| centre)
            }
            Centre::Radius(radius) => {
                let (radius, inch) = (self.value(radius, span)?, self.modes.inch);
                let short = self.world.arcs.short(inch);
                let centre = geometry::centre_by_radius(start, end, radius, arc.turn, short);
                if let (Some(beside), Ok(centre)) = (&mut self.beside, centre) {
                    beside.judge_centre([start, end], (radius, arc.turn), centre, inch);
                }
                centre
            }
        };
        let centre = self.shaped(centre, span)?;
        let turns = arc.turns.count().map_err(|fault| Diagnostic::new(fault, span))?;
        self.go_round(Way { plane, turn: arc.turn, turns, before, centre }, span, out)
    }

    pub(crate) fn arc_form(
        &mut self,
        arc: &ArcForm,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        let plane = self.plane_of(arc.plane);
        let (first, second, normal) = plane.axes();
        let before = self.position;
        let heading = self.heading;
        if [first, second].iter().any(|axis| *axis as usize == self.along) && self.another_length_waits() {
            return self.not_executed(MoveUnexecuted::ArcTakesLength, span);
        }
        self.set_axes(&arc.to, span)?;
        let [start, end] = ends(plane, &before, &self.position);
        let in_plane = [first, second].iter().any(|axis| arc.to.get(*axis).is_some());
        if in_plane && matches!(arc.shape, Shape::AngleAbout { .. }) {
            return self.fault(Fault::ArcCentreAndRadius, span);
        }
        let normal = normal as usize;
        let flat = self.position[normal] == before[normal];
        let now = Now { exec: self, plane, before: &before, heading, flat, span };
        let found = solve_arc(&arc.shape, plane, start, end, &now)?;
        if found == Err(ArcFault::Straight) {
            self.heading = Heading::From(before);
            self.modes.motion = Motion::Feed;
            self.said |= MOTION;
            self.cycle = None;
            return self.emit_move(true, span, out);
        }
        if found == Err(ArcFault::NoWay) {
            return self.fault(Fault::NoArc, span);
        }
        let SolvedArc { centre, end, turn } = self.shaped(found, span)?;
        self.position[first as usize] = end[0];
        self.position[second as usize] = end[1];
        self.go_round(Way { plane, turn, turns: arc.turns, before, centre }, span, out)
    }

    /// Where words put the axes, as seen from `before`.
    fn point(&self, to: &Point, before: &[Nanos; AXES], span: Span) -> Result<[Nanos; AXES], Diagnostic> {
        let mut next = *before;
        for (axis, word) in to.axes.iter().enumerate() {
            if let Some(word) = word {
                if self.carries(axis) && word.distance.or(self.modes.distance) == Distance::Incremental {
                    self.not_executed(MoveUnexecuted::ArcInFrameChange, span)?;
                }
                next[axis] = self.target(word, before[axis], span)?;
            }
        }
        Ok(next)
    }

    fn shaped<T>(&self, found: Result<T, ArcFault>, span: Span) -> Result<T, Diagnostic> {
        found.or_else(|fault| {
            let fault = match fault {
                ArcFault::RadiusTooSmall => Fault::ArcRadiusTooSmall,
                ArcFault::NoWay | ArcFault::Straight => Fault::ArcRadiusNoWay,
                ArcFault::EndOffCircle { radii, allowed } => Fault::ArcEndOffCircle { radii, allowed },
                ArcFault::NoRadius => Fault::ArcWithoutCentre,
            };
            self.fault(fault, span)
        })
    }

    /// Makes the arc; the position is already that of its end.
    fn go_round(&mut self, way: Way, span: Span, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let Way { plane, turn, turns, before, centre } = way;
        if self.probing.take().is_some() || self.detour.take().is_some() {
            return self.not_executed(MoveUnexecuted::ArcProbing, span);
        }
        let (first, second, _) = plane.axes();
        let (f, s) = (first as usize, second as usize);
        let [start, end] = ends(plane, &before, &self.position);
        let sense = match &self.chain {
            None => Some(turn),
            Some(chain) => chain.sense(plane, turn),
        };
        let Some(sense) = sense else {
            return self.not_executed(MoveUnexecuted::ArcNotInPlane, span);
        };
        self.modes.motion = Motion::Arc(turn);
        self.said |= MOTION;
        self.cycle = None;
        let mut middle = self.position;
        (middle[f], middle[s]) = (centre[0], centre[1]);
        let middle = self.place(&middle);
        let centre_here = [middle[f], middle[s]];
        let kind = |full| Kind::Arc { plane, turn: sense, full, centre: centre_here };
        if turns > 0 {
            if turns > MOST_TURNS {
                return self.fault(Fault::OutOfRange { word: Ranged::Turns }, span);
            }
            // The whole turns are an event each; the third axis goes with the angle.
            let total = geometry::sweep_degrees(start, end, centre, turn, turns).abs();
            let (from, to) = (self.last, self.machine());
            let begin = self.place(&before);
            for k in 1..=turns {
                let part = 360.0 * f64::from(k) / total;
                self.last =
                    std::array::from_fn(|i| from[i] + ((to[i] - from[i]) as f64 * part).round() as Nanos);
                for axis in [f, s] {
                    self.last[axis] = begin[axis];
                }
                self.pace = self.pace_of_arc(360.0);
                self.emit(kind(true), span, out)?;
            }
        }
        self.heading = Heading::Bent(plane, geometry::tangent(end, centre, turn));
        self.last = self.machine();
        if self.state.feed_mode == FeedMode::InverseTime {
            self.pace = self.pace_of_arc(geometry::sweep_degrees(start, end, centre, turn, 0));
        }
        self.emit(kind(start == end), span, out)
    }
}
