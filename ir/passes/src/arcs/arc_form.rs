//! `arc-form`: arcs by angle, through a point, tangent, or with a centre measured in both distance modes are
//! written by their centre.
//!
//! Where the tool stands must be known (a tangent arc straight ahead is a line), and for a tangent arc which way it came.

use crate::pass::{Moment, Pass, Step};
use crate::support::needs::ARC;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{EXACT, rounded, unit_of};
use crate::target::Target;
use ncc_ir::canon::{AXES, Axis, Fact, Plane};
use ncc_ir::diag::{Diagnostic, Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Nanos;
use ncc_ir::geometry::arc_solver::{ArcRule, Around, SolvedArc, solve_arc};
use ncc_ir::geometry::{self, ArcFault};
use ncc_ir::lack::ArcsLack;
use ncc_ir::program::cycle::absolute;
use ncc_ir::program::kinds::{conduct, miscellaneous};
use ncc_ir::program::{Arc, ArcForm, Centre, CentreFrom, Move, Op, Point, Program, Shape, Stmt, Turns};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "arc-form",
    about: "writes arcs by angle, through a point or tangent by their centre",
    alone: Some(run),
    step: Step::at(
        Moment::Wording,
        |l, p| p.needs(ARC) && !l.target.caps.arcs.forms,
        |l, p| {
            convert_arc_form(
                p.stmts,
                &mut p.start.clone(),
                l.states.state_mut::<ArcFormState>(),
                &l.target,
                p.diags,
            )
        },
    ),
    program: &[],
    parametric: None,
};

/// What the pass remembers from piece to piece: which way the tool came.
#[derive(Clone, Debug, Default)]
pub(crate) struct ArcFormState {
    heading: Heading,
}

#[derive(Clone, Copy, Debug, Default)]
enum Heading {
    #[default]
    Unknown,
    /// Straight, from there.
    From([Option<Nanos>; AXES]),
    /// The end of an arc in a plane.
    Bent(Plane, [f64; 2]),
}

/// Writes them by their centre.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| {
        convert_arc_form(body, walk, &mut ArcFormState::default(), target, diags)
    });
}

/// The same for one piece of a body.
pub(crate) fn convert_arc_form(
    body: &mut [Stmt],
    walk: &mut Walk,
    state: &mut ArcFormState,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    for stmt in body {
        walk.enter(stmt.skip);
        // Errors of rounding do not add up: the next arc begins where this one really ends.
        let mut exactly = None;
        let mut refused = false;
        if let Op::ArcForm(arc) = &stmt.op {
            match state.by_centre(arc, walk, target.decimals_in(walk.unit())) {
                Ok((op, made)) => {
                    exactly = made;
                    diags.push(Diagnostic::new(Fault::ArcReformatted, stmt.span));
                    stmt.op = op;
                }
                Err(fault) => {
                    diags.push(Diagnostic::new(fault, stmt.span));
                    refused = true;
                }
            }
        }
        state.step(stmt, walk);
        if refused {
            // It is reported once.
            stmt.op = Op::Blank;
        }
        if let Some(Exactly { end, heading }) = exactly {
            for (axis, nanos) in end {
                walk.at.position[axis as usize] = Some(nanos);
            }
            state.heading = if stmt.skip.is_none() { heading } else { Heading::Unknown };
        }
    }
}

/// Statements at the end of a piece that say which way the tool came, as good as always.
const TAIL: usize = 8;

/// Follows a piece without such arcs.
pub(crate) fn follow(body: &[Stmt], walk: &mut Walk, state: &mut ArcFormState) {
    let (most, tail) = body.split_at(body.len().saturating_sub(TAIL));
    if !most.is_empty() {
        walk.pass(most);
        state.heading = Heading::Unknown;
    }
    tail.iter().for_each(|stmt| state.step(stmt, walk));
}

impl ArcFormState {
    /// An arc by its centre, for the walk that stands before it; its computed words have at most so
    /// many digits.
    ///
    /// # Errors
    /// What must be known and is not; an arc that is none.
    pub(crate) fn by_centre(&self, arc: &ArcForm, walk: &Walk, decimals: u8) -> Result<Made, Fault> {
        by_centre(arc, walk, self.heading, decimals)
    }

    /// Executes a statement.
    pub(crate) fn step(&mut self, stmt: &Stmt, walk: &mut Walk) {
        let before = walk.at.position;
        let bent = match &stmt.op {
            Op::ArcFeed(arc) => bend(arc, &walk.at),
            _ => Heading::Unknown,
        };
        walk.step(stmt);
        self.heading = match &stmt.op {
            Op::StraightTraverse(_) | Op::StraightFeed(_) if stmt.skip.is_none() => {
                if before == walk.at.position { self.heading } else { Heading::From(before) }
            }
            Op::ArcFeed(_) if stmt.skip.is_none() => bent,
            Op::Polar(polar)
                if stmt.skip.is_none()
                    && matches!(polar.op, Op::StraightTraverse(_) | Op::StraightFeed(_)) =>
            {
                if before == walk.at.position { self.heading } else { Heading::From(before) }
            }
            op if keeps(op) => self.heading,
            _ => Heading::Unknown,
        };
    }
}

/// Whether a statement leaves the direction of the last move as it is.
fn keeps(op: &Op) -> bool {
    matches!(
        op,
        Op::SetFeedRate(_)
            | Op::SetDistanceMode(_)
            | Op::SelectPlane(_)
            | Op::SetFeedMode(_)
            | miscellaneous!()
            | conduct!()
    )
}

fn bend(arc: &Arc, at: &Tracker) -> Heading {
    let end = at.target(&arc.to);
    let bent = at.plane(arc.plane).zip(at.centre(arc)).and_then(|(plane, centre)| {
        let (first, second, _) = plane.axes();
        let end = [end[first as usize]?, end[second as usize]?];
        Some(Heading::Bent(plane, geometry::tangent(end, centre, arc.turn)))
    });
    bent.unwrap_or_default()
}

/// What is known where an arc begins.
struct Known<'w> {
    at: &'w Tracker,
    plane: Plane,
    heading: Heading,
}

impl Known<'_> {
    fn side(&self, axis: Axis) -> Result<Nanos, Fault> {
        let unknown = Fault::PositionUnknown { axis: axis.letter() as char };
        self.at.position[axis as usize].ok_or(unknown)
    }
}

impl Around for Known<'_> {
    type Unknown = Fault;

    fn value(&self, value: &Expr) -> Result<Nanos, Fault> {
        self.at.nanos(value).ok_or(match self.at.modes.units {
            None => Fault::EntryFactNeeded { fact: ModeName::Units },
            Some(_) => Fault::lacks(ArcsLack::ComputedValue),
        })
    }

    fn via(&self, point: &Point) -> Result<[Nanos; 2], Fault> {
        let (first, second, normal) = self.plane.axes();
        let via = self.at.target(point);
        if via[normal as usize] != self.at.position[normal as usize] {
            return Err(Fault::lacks(ArcsLack::CircleInSpace));
        }
        let at =
            |axis: Axis| via[axis as usize].ok_or(Fault::PositionUnknown { axis: axis.letter() as char });
        Ok([at(first)?, at(second)?])
    }

    fn heading(&self) -> Result<[f64; 2], Fault> {
        let (first, second, _) = self.plane.axes();
        match self.heading {
            Heading::Bent(plane, direction) if plane == self.plane => Ok(direction),
            Heading::Bent(..) => Ok([0.0; 2]),
            Heading::From(from) => {
                let along = |axis: Axis| {
                    let unknown = Fault::PositionUnknown { axis: axis.letter() as char };
                    Ok((self.side(axis)? - from[axis as usize].ok_or(unknown)?) as f64)
                };
                Ok([along(first)?, along(second)?])
            }
            Heading::Unknown => Err(Fault::lacks(ArcsLack::TangentAfterUnknown)),
        }
    }

    /// The arc that is made of it is judged by the target's rule ([`crate::arcs::arc_radii`]).
    fn rule(&self) -> (ArcRule, bool) {
        (ArcRule::UNTESTED, false)
    }
}

/// How an arc ends before its words are rounded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Exactly {
    end: [(Axis, Nanos); 2],
    heading: Heading,
}

/// An arc by its centre, and how it ends exactly; or the line that it is.
pub(crate) type Made = (Op, Option<Exactly>);

fn by_centre(arc: &ArcForm, walk: &Walk, heading: Heading, decimals: u8) -> Result<Made, Fault> {
    let plane = walk.at.plane(arc.plane).ok_or(Fault::EntryFactNeeded { fact: ModeName::Plane })?;
    let (first, second, _) = plane.axes();
    let known = Known { at: &walk.at, plane, heading };
    let start = [known.side(first)?, known.side(second)?];
    let end = walk.at.target(&arc.to);
    let at = |axis: Axis| end[axis as usize].ok_or(Fault::PositionUnknown { axis: axis.letter() as char });
    let end = [at(first)?, at(second)?];
    let found = solve_arc(&arc.shape, plane, start, end, &known)?;
    if found == Err(ArcFault::Straight) {
        return Ok((Op::StraightFeed(Move { to: arc.to.clone(), said: arc.said }), None));
    }
    let SolvedArc { centre, end, turn } = found.map_err(|fault| match fault {
        ArcFault::RadiusTooSmall => Fault::ArcRadiusTooSmall,
        ArcFault::NoWay | ArcFault::Straight => Fault::NoArc,
        ArcFault::EndOffCircle { radii, allowed } => Fault::ArcEndOffCircle { radii, allowed },
        ArcFault::NoRadius => Fault::ArcWithoutCentre,
    })?;
    let unit = walk.unit();
    // How a third axis goes with several turns depends on the very angle.
    let decimals = if arc.turns > 0 { EXACT } else { decimals };
    let mut words: [Option<Expr>; 3] = [None, None, None];
    let mut to = arc.to.clone();
    for (i, axis) in [first, second].into_iter().enumerate() {
        let unit = unit_of(axis, unit);
        words[axis as usize] = Some(rounded(centre[i].wrapping_sub(start[i]), decimals, unit).into());
        if matches!(arc.shape, Shape::AngleAbout { .. }) {
            to.set(axis, absolute(rounded(end[i], decimals, unit)));
        }
    }
    let heading = Heading::Bent(plane, geometry::tangent(end, centre, turn));
    let exactly = Exactly { end: [(first, end[0]), (second, end[1])], heading };
    let arc = Arc {
        plane: Fact::Known(plane),
        turn,
        to,
        centre: Centre::Point { words, from: CentreFrom::Start },
        turns: Turns::from(arc.turns),
        said: arc.said,
    };
    Ok((Op::ArcFeed(Box::new(arc)), Some(exactly)))
}
