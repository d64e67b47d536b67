//! Execution of arcs.

use super::{Event, Exec, Kind, MOTION};
use crate::canon::{AXES, Axis, Distance, Fact, Motion, Plane, Turn};
use crate::diag::{Diagnostic, Fault};
use crate::expr::Expr;
use crate::geometry::{self, ArcFault};
use crate::num::{Nanos, ONE};
use crate::program::{Arc, ArcForm, Centre, CentreFrom, Coord, Point, Shape};
use crate::source::Span;

/// Greatest difference of an arc's two radii, 0.02 mm; a control's parameter is of this order.
const ARC_TOLERANCE: Nanos = ONE / 50;

/// Most turns of one arc; more is a slip of the pen.
const MOST_TURNS: u32 = 10_000;

/// Direction of the last move, for an arc that goes on in it. In program coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Heading {
    /// Not known: nothing has moved since the frame changed.
    None,
    /// Straight, from there to where the axes stand.
    From([Nanos; AXES]),
    /// The end of an arc in a plane.
    Bent(Plane, [f64; 2]),
}

/// An arc in program coordinates.
#[derive(Clone, Copy)]
struct Round {
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

impl Exec {
    pub(super) fn arc(&mut self, arc: &Arc, span: Span, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let plane = self.plane_of(arc.plane);
        let (first, second, _) = plane.axes();
        let (f, s) = (first as usize, second as usize);
        let before = self.position;
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
                geometry::check_on_circle(start, end, centre, ARC_TOLERANCE).map(|()| centre)
            }
            Centre::Radius(radius) => {
                geometry::centre_by_radius(start, end, self.value(radius, span)?, arc.turn)
            }
        };
        let centre = self.shaped(centre, span)?;
        self.go_round(Round { plane, turn: arc.turn, turns: arc.turns, before, centre }, span, out)
    }

    pub(super) fn arc_form(
        &mut self,
        arc: &ArcForm,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        let plane = self.plane_of(arc.plane);
        let (first, second, normal) = plane.axes();
        let before = self.position;
        let heading = self.heading;
        self.set_axes(&arc.to, span)?;
        let [start, end] = ends(plane, &before, &self.position);
        let (centre, turn) = match &arc.shape {
            Shape::Angle { turn, angle } => {
                let angle = self.value(angle, span)?;
                (geometry::centre_by_angle(start, end, angle, *turn), *turn)
            }
            Shape::AngleAbout { turn, angle, centre } => {
                let centre = self.centre_of(centre, plane, &before, span)?;
                let angle = self.value(angle, span)?;
                if arc.to.get(first).is_some() || arc.to.get(second).is_some() {
                    return self.fault(Fault::ArcCentreAndRadius, span);
                }
                if angle <= 0 || angle >= 360 * ONE {
                    return self.fault(Fault::OutOfRange { word: "opening angle".into() }, span);
                }
                let signed = if *turn == Turn::Counterclockwise { angle } else { -angle };
                let end = geometry::turned(centre, start, signed);
                self.position[first as usize] = end[0];
                self.position[second as usize] = end[1];
                (geometry::check_on_circle(start, end, centre, ARC_TOLERANCE).map(|()| centre), *turn)
            }
            Shape::Mixed { turn, centre } => {
                let centre = self.centre_of(centre, plane, &before, span)?;
                (geometry::check_on_circle(start, end, centre, ARC_TOLERANCE).map(|()| centre), *turn)
            }
            Shape::Through(via) => {
                let via = self.point(via, &before, span)?;
                if via[normal as usize] != before[normal as usize]
                    || self.position[normal as usize] != before[normal as usize]
                {
                    return self.not_executed("a circle in space", span);
                }
                let via = [via[first as usize], via[second as usize]];
                let found = geometry::arc_through(start, via, end);
                let turn = found.map_or(Turn::Clockwise, |(_, turn)| turn);
                (found.map(|(centre, _)| centre), turn)
            }
            Shape::Tangent => {
                let direction = match heading {
                    Heading::None => [0.0; 2],
                    Heading::From(from) => {
                        let [a, b] = ends(plane, &from, &before);
                        [(b[0] - a[0]) as f64, (b[1] - a[1]) as f64]
                    }
                    Heading::Bent(p, direction) if p == plane => direction,
                    Heading::Bent(..) => [0.0; 2],
                };
                let found = geometry::arc_tangent(start, end, direction);
                let turn = found.map_or(Turn::Clockwise, |(_, turn)| turn);
                (found.map(|(centre, _)| centre), turn)
            }
        };
        let centre = self.shaped(centre, span)?;
        self.go_round(Round { plane, turn, turns: arc.turns, before, centre }, span, out)
    }

    /// Where words put the axes, as seen from `before`.
    fn point(&self, to: &Point, before: &[Nanos; AXES], span: Span) -> Result<[Nanos; AXES], Diagnostic> {
        let mut next = *before;
        for (axis, word) in to.axes.iter().enumerate() {
            if let Some(word) = word {
                next[axis] = self.target(word, before[axis], span)?;
            }
        }
        Ok(next)
    }

    /// A centre whose words say each from where they are measured.
    fn centre_of(
        &self,
        words: &[Option<Coord>; 3],
        plane: Plane,
        before: &[Nanos; AXES],
        span: Span,
    ) -> Result<[Nanos; 2], Diagnostic> {
        let (first, second, _) = plane.axes();
        let along = |axis: Axis| match &words[axis as usize] {
            None => Ok(before[axis as usize]),
            Some(word) => {
                let value = self.value(&word.value as &Expr, span)?;
                Ok(match word.distance {
                    Fact::Known(Distance::Absolute) => value,
                    Fact::Known(Distance::Incremental) | Fact::Entry => {
                        before[axis as usize].wrapping_add(value)
                    }
                })
            }
        };
        Ok([along(first)?, along(second)?])
    }

    fn shaped(&self, centre: Result<[Nanos; 2], ArcFault>, span: Span) -> Result<[Nanos; 2], Diagnostic> {
        centre.or_else(|fault| {
            let fault = match fault {
                ArcFault::RadiusTooSmall => Fault::ArcRadiusTooSmall,
                ArcFault::NoWay => Fault::ArcRadiusNoWay,
                ArcFault::EndOffCircle(by) => Fault::ArcEndOffCircle { by },
                ArcFault::NoRadius => Fault::ArcWithoutCentre,
            };
            self.fault(fault, span)
        })
    }

    /// Makes the arc; the position is already that of its end.
    fn go_round(&mut self, round: Round, span: Span, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let Round { plane, turn, turns, before, centre } = round;
        let (first, second, _) = plane.axes();
        let (f, s) = (first as usize, second as usize);
        let [start, end] = ends(plane, &before, &self.position);
        let sense = match &self.chain {
            None => Some(turn),
            Some(chain) => chain.sense(plane, turn),
        };
        let Some(sense) = sense else {
            return self.not_executed("an arc in a frame that does not leave it an arc of its plane", span);
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
                return self.fault(Fault::OutOfRange { word: "number of turns".into() }, span);
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
                self.emit(kind(true), span, out)?;
            }
        }
        self.heading = Heading::Bent(plane, geometry::tangent(end, centre, turn));
        self.last = self.machine();
        self.emit(kind(start == end), span, out)
    }
}
