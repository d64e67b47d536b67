//! `expand-cycles`: a canned cycle becomes its moves. This is the definition of what a cycle does.
//!
//! A hole, in the order of its moves:
//! 1. to the position in the plane, at the level where the tool is, then by rapid to the
//!    retract plane R (Fanuc 15i-M); if the tool stands below R and the cycle is
//!    [`Approach::RaiseFirst`], up to R first (NIST RS274/NGC 3.8.1); if it is
//!    [`Approach::RetractFirst`], to R first from above too; under [`Approach::ClearFirst`] from a hole
//!    that was left no higher than R straight to the return level above the next;
//! 2. feed to the bottom; [`CycleKind::DrillPeck`] by pecks, after each by rapid to R and back to
//!    the clearance above the last depth, the last peck clipped at the bottom (without a clearance, by rapid to
//!    where the tool is left and down at feed); dwell, if there is one;
//! 3. out by rapid to R or to the level where the tool stood when the cycle was activated, which
//!    under [`Approach::RaiseFirst`] is not below R (NIST RS274/NGC 3.5.20); [`CycleKind::Bore`]
//!    feeds to R first.
//!
//! The cycle's feed is stated again before the first feed of every hole, as the case study has it.
//! Moves without way are left out. Levels that the program measures from others are written
//! absolute, for which they must be known.

use super::sayable::{lasts, level, sayable};
use super::series::{Series, over_hole};
use crate::arcs::polar_places;
use crate::holes::approach::is_one_way;
use crate::holes::expand_patterns;
use crate::holes::pecks::{level_is_here, pecks};
use crate::holes::spindle_holes::with_spindle;
use crate::pass::{Moment, Pass, Step};
use crate::support::needs::CYCLE;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{Rebuild, at, cut, only, rebuild, traverse};
use crate::target::Target;
use ncc_ir::canon::{Axis, Motion, ReturnLevel};
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::{Diagnostic, Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Nanos;
use ncc_ir::lack::HolesLack;
use ncc_ir::program::cycle::{Approach, Clearance, CycleKind, Leg, Shift};
use ncc_ir::program::kinds::{flow, moves};
use ncc_ir::program::{Op, Point, Program, Stmt};
use ncc_ir::source::Span;
use ncc_ir::track::{ActiveCycle, Tracker};

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "expand-cycles",
    about: "turns canned cycles into their moves",
    alone: Some(run),
    step: Step::at(
        Moment::Wording,
        |_, p| p.needs(CYCLE),
        |l, p| {
            let begins = |stmt: &Stmt| matches!(stmt.op, Op::StartCycle(_));
            if !l.states.ask(ExpandCyclesState::is_busy) && !p.stmts.iter().any(begins) {
                // Nothing is expanded: holes of a cycle that the target says stay as they are.
                return;
            }
            expand_cycles(
                p.stmts,
                &mut p.start.clone(),
                l.states.state_mut::<ExpandCyclesState>(),
                &l.target,
                p.diags,
            )
        },
    ),
    program: &[],
    parametric: None,
};

/// What the pass remembers from piece to piece of a body.
#[derive(Clone, Debug, Default)]
pub(crate) struct ExpandCyclesState {
    /// The active cycle is being expanded.
    expanding: bool,
    /// Feed that is stated again at every hole.
    feed: Option<Expr>,
    /// That feed, if no hole has stated it yet; a cycle sets the feed even if it makes no hole.
    owed: Option<Owed>,
}

#[derive(Clone, Debug)]
struct Owed {
    feed: Expr,
    skip: Option<u8>,
    span: Span,
}

/// Expands the cycles that the target cannot say, and their patterns.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| expand_cycles(body, walk, &mut Default::default(), target, diags));
}

impl ExpandCyclesState {
    /// Whether statements of a cycle that is not there any more are to come.
    pub(crate) fn is_busy(&self) -> bool {
        self.expanding
    }
}

/// The same for one piece of a body.
pub(crate) fn expand_cycles(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    state: &mut ExpandCyclesState,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    let mut series: Option<Series> = None;
    rebuild(body, |mut stmt, made| {
        walk.enter(stmt.skip);
        if stmt.skip.is_some() || !matches!(stmt.op, Op::Hole(_) | Op::Comment(_) | Op::Blank) {
            series = None;
        }
        match &stmt.op {
            Op::StartCycle(cycle) => {
                let feed = cycle.feed.clone();
                state.start(stmt, feed, walk, target, made, diags);
            }
            Op::Polar(polar) if state.expanding && matches!(polar.op, Op::Hole(_) | Op::Position(_)) => {
                match polar_places::by_coordinates(polar, walk, target) {
                    Ok(Op::Hole(m) | Op::Position(m)) => {
                        // The pole and its words are those after the point.
                        let mut behind = walk.at.clone();
                        behind.apply(&stmt.op);
                        (walk.at.pole, walk.at.pole_lost) = (behind.pole, behind.pole_lost);
                        state.holes(stmt, Ok(vec![m.to]), walk, target, made, diags);
                    }
                    Ok(_) => {}
                    Err(fault) => {
                        diags.push(Diagnostic::new(fault, stmt.span));
                        walk.step(&stmt);
                        made.push(stmt);
                    }
                }
            }
            Op::Hole(m) if state.expanding => {
                if stmt.skip.is_none() && state.is_as_before(&mut series, walk, target) {
                    return state.hole_again(series.as_ref(), stmt, walk, made);
                }
                let holes = Ok(vec![m.to.clone()]);
                state.holes(stmt, holes, walk, target, made, diags);
            }
            Op::Position(m) if state.expanding && walk.at.modes.motion == Some(Motion::Cycle) => {
                let holes = Ok(vec![m.to.clone()]);
                state.holes(stmt, holes, walk, target, made, diags);
            }
            Op::Pattern(pattern) if state.expanding => {
                let holes = expand_patterns::holes(walk, pattern, target.decimals_in(walk.unit()));
                if let Ok(holes) = &holes {
                    let count = holes.len() as u32;
                    diags.push(Diagnostic::new(Fault::PatternExpanded { holes: count }, stmt.span));
                }
                state.holes(stmt, holes, walk, target, made, diags);
            }
            Op::EndCycle if state.expanding => {
                walk.step(&stmt);
                if stmt.skip.is_none() {
                    state.expanding = false;
                }
                match state.owed.take() {
                    Some(owed) if owed.skip == stmt.skip => {
                        made.replace(stmt, [(true, Op::SetFeedRate(owed.feed))]);
                    }
                    owed => {
                        state.owed = owed;
                        state.pay(&mut stmt, made);
                        made.leave_out(stmt);
                    }
                }
            }
            Op::SetFeedRate(feed) if state.expanding => {
                walk.step(&stmt);
                if stmt.skip.is_none() && state.feed.is_some() {
                    // The next hole says it.
                    state.feed = Some(feed.clone());
                    state.owed = Some(Owed { feed: feed.clone(), skip: None, span: stmt.span });
                    return made.leave_out(stmt);
                }
                if stmt.skip.is_some() {
                    // Which feed is active depends on a switch: the last one said goes on.
                    state.pay(&mut stmt, made);
                    state.feed = None;
                }
                made.push(stmt);
            }
            _ => {
                walk.step(&stmt);
                if state.expanding && ends(stmt.op.unwrapped()) {
                    // A move ends a cycle; one that may be skipped ends it perhaps.
                    state.expanding = stmt.skip.is_some();
                    state.pay(&mut stmt, made);
                }
                made.push(stmt);
            }
        }
    });
}

/// Whether a statement ends a cycle that is active, or goes where this pass does not follow.
fn ends(op: &Op) -> bool {
    matches!(op, Op::Position(_) | Op::ProgramEnd | Op::BeginAgain | moves!() | flow!())
}

impl ExpandCyclesState {
    /// States a feed that no hole has stated, in a block of its own before `next`.
    fn pay(&mut self, next: &mut Stmt, made: &mut Rebuild) {
        if let Some(owed) = self.owed.take() {
            let mut stmt = Stmt::new(owed.span, Op::SetFeedRate(owed.feed));
            stmt.skip = owed.skip;
            made.push(stmt);
            next.joined = false;
        }
    }

    /// A cycle that is activated: told and expanded from here on, if the target cannot say it.
    fn start(
        &mut self,
        mut stmt: Stmt,
        feed: Option<Expr>,
        walk: &mut Walk,
        target: &Target,
        made: &mut Rebuild,
        diags: &mut Vec<Diagnostic>,
    ) {
        let [kept, doubt] = in_force_before(walk).map(|is| is && !self.expanding);
        walk.step(&stmt);
        let must = match &walk.at.cycle {
            // Cycles activated one after another share the initial level.
            Some(_) if self.expanding => true,
            Some(now) => must_expand(walk, now, kept || doubt, target, stmt.span, diags),
            None => false,
        };
        if !must {
            self.pay(&mut stmt, made);
            self.expanding = false;
            return made.push(stmt);
        }
        reported(&stmt, target, diags);
        self.expanding = true;
        if stmt.skip.is_some() || feed.is_none() {
            self.pay(&mut stmt, made);
        }
        let owed = |feed| Owed { feed, skip: stmt.skip, span: stmt.span };
        self.owed = feed.clone().map(owed);
        self.feed = feed;
        if kept {
            made.replace(stmt, [(true, Op::EndCycle)]);
        } else {
            made.leave_out(stmt);
        }
    }

    /// Whether the hole that comes next is made as those of a series; begins one where it can.
    fn is_as_before(&self, series: &mut Option<Series>, walk: &Walk, target: &Target) -> bool {
        let Some(in_force) = walk.at.cycle.as_ref().filter(|_| self.feed.is_some() || self.owed.is_none())
        else {
            return false;
        };
        let normal = walk.at.plane(in_force.cycle.plane).map(|plane| plane.axes().2);
        let Some(from) = normal.and_then(|axis| walk.at.position[axis as usize]) else { return false };
        if series.as_ref().is_none_or(|series| series.from != from) {
            *series = series_from(from, walk, in_force, self.feed.as_ref(), target);
        }
        series.is_some()
    }

    /// Puts the moves of a hole of a series in the place of its statement.
    fn hole_again(&mut self, series: Option<&Series>, stmt: Stmt, walk: &mut Walk, made: &mut Rebuild) {
        let plane = walk.at.cycle.as_ref().and_then(|in_force| walk.at.plane(in_force.cycle.plane));
        let (Some(series), Some(plane), Op::Hole(m)) = (series, plane, &stmt.op) else { return };
        let (over, goes) = over_hole(walk, &m.to, plane.axes().2);
        walk.step(&stmt);
        self.owed = None;
        series.write(stmt, Some(over).filter(|_| goes), made);
    }

    /// Puts the moves of holes in the place of their statement.
    fn holes(
        &mut self,
        mut stmt: Stmt,
        holes: Result<Vec<Point>, Fault>,
        walk: &mut Walk,
        target: &Target,
        made: &mut Rebuild,
        diags: &mut Vec<Diagnostic>,
    ) {
        let holes = match holes {
            Ok(holes) => holes,
            Err(fault) => {
                diags.push(Diagnostic::new(fault, stmt.span));
                walk.step(&stmt);
                return made.leave_out(stmt);
            }
        };
        // Most holes are four moves, and a feed.
        let mut moves = Vec::with_capacity(6 * holes.len());
        // After the first hole the tool is followed apart from the walk, which goes by the statement.
        let mut apart: Option<Walk> = None;
        let last = holes.len().saturating_sub(1);
        for (at, to) in holes.into_iter().enumerate() {
            let inner = apart.as_ref().unwrap_or(walk);
            let moved = match &inner.at.cycle {
                Some(in_force) => hole(inner, in_force, &to, self.feed.as_ref(), target, &mut moves),
                None => Err(Fault::lacks(HolesLack::CycleInSkippedBlock)),
            };
            if let Err(fault) = moved {
                diags.push(Diagnostic::new(fault, stmt.span));
                break;
            }
            if at == last {
                break;
            }
            let op = Op::Hole(ncc_ir::program::Move { to, said: false });
            let mut one = Stmt::new(stmt.span, op);
            one.skip = stmt.skip;
            apart.get_or_insert_with(|| walk.clone()).step(&one);
        }
        let bores_out = walk.at.cycle.as_ref().is_some_and(|c| bores_out(&c.cycle.kind));
        walk.step(&stmt);
        if self.feed.is_none() {
            self.pay(&mut stmt, made);
        } else if self.owed.as_ref().is_some_and(|o| stmt.skip.is_none() || o.skip == stmt.skip) {
            self.owed = None;
        } else if bores_out {
            self.pay(&mut stmt, made);
        }
        if bores_out && let Some(feed) = &self.feed {
            // The way out has left another feed active than the cycle does.
            self.owed = Some(Owed { feed: feed.clone(), skip: stmt.skip, span: stmt.span });
        }
        made.replace(stmt, moves);
    }
}

/// Whether a hole is left at another feed.
fn bores_out(kind: &CycleKind) -> bool {
    matches!(kind, CycleKind::Bore { feed_out: Some(_), .. })
}

fn reported(stmt: &Stmt, target: &Target, diags: &mut Vec<Diagnostic>) {
    let Op::StartCycle(cycle) = &stmt.op else { return };
    diags.push(Diagnostic::new(Fault::CycleExpanded { kind: cycle.kind.name().into() }, stmt.span));
    let length =
        |value: ncc_ir::expr::num::Num| (value.nanos(false).unwrap_or(0) as f64 / 1e9).to_string().into();
    let assumption = match &cycle.kind {
        CycleKind::DrillPeck { clearance: Clearance::Parameter, .. } => {
            target.peck_clearance.map(|value| ControlFact::PeckClearance { length: length(value) })
        }
        CycleKind::DrillBreak { lift: Clearance::Parameter, .. } => {
            target.break_lift.map(|value| ControlFact::BreakLift { length: length(value) })
        }
        CycleKind::FineBore(bore) => {
            if let (None, Some(angle)) = (&bore.angle, target.orientation) {
                let degrees = (angle.nanos(false).unwrap_or(0) as f64 / 1e9).to_string().into();
                let assumption = ControlFact::Orientation { degrees };
                diags.push(Diagnostic::new(Fault::AssumedFact { fact: assumption }, stmt.span));
            }
            if let (Shift::Parameter(_), Some(direction)) = (&bore.shift, target.bore_shift) {
                let assumption = ControlFact::BoreShift { direction: direction.name() };
                diags.push(Diagnostic::new(Fault::AssumedFact { fact: assumption }, stmt.span));
            }
            return;
        }
        _ => return,
    };
    if let Some(assumption) = assumption {
        diags.push(Diagnostic::new(Fault::AssumedFact { fact: assumption }, stmt.span));
    }
}

/// Whether a cycle is active, and whether one may be.
fn in_force_before(walk: &Walk) -> [bool; 2] {
    [walk.at.cycle.is_some(), walk.at.cycle_in_doubt]
}

fn must_expand(
    walk: &Walk,
    in_force: &ActiveCycle,
    kept: bool,
    target: &Target,
    span: Span,
    diags: &mut Vec<Diagnostic>,
) -> bool {
    let cycle = &in_force.cycle;
    if kept && !level_is_here(walk, in_force, target) {
        return true;
    }
    let same_way = target.caps.holes.approach.is_none_or(|way| is_one_way(walk, in_force, way));
    !sayable(walk, cycle, target, span, diags) || !same_way
}

/// The moves that all further holes of a cycle share, for a tool that stands at this level; `None` if they depend on the
/// position of the hole.
fn series_from(
    from: Nanos,
    walk: &Walk,
    in_force: &ActiveCycle,
    feed: Option<&Expr>,
    target: &Target,
) -> Option<Series> {
    let kind = &in_force.cycle.kind;
    let plain = matches!(kind, CycleKind::Drill | CycleKind::DrillDwell { .. })
        || matches!(kind, CycleKind::DrillPeck { .. } | CycleKind::DrillBreak { .. });
    let way = in_force.cycle.approach;
    if !plain || walk.waiting || way == Approach::ClearFirst {
        return None;
    }
    let mut moves = Vec::new();
    // A hole at the tool's own position has no move in the plane.
    hole(walk, in_force, &Point::default(), feed, target, &mut moves).ok()?;
    let raises = way != Approach::PlaneFirst && way.retracts(from, in_force.retract?);
    Some(Series { from, moves, place: usize::from(raises) })
}

/// The moves of one hole; `true` marks those that stand in the block of the one before.
pub(crate) fn hole(
    walk: &Walk,
    in_force: &ActiveCycle,
    to: &Point,
    feed: Option<&Expr>,
    target: &Target,
    moves: &mut Vec<(bool, Op)>,
) -> Result<(), Fault> {
    let cycle = &in_force.cycle;
    let here = &walk.at;
    let plane = here.plane(cycle.plane).ok_or(Fault::EntryFactNeeded { fact: ModeName::Plane })?;
    let normal = plane.axes().2;
    let unknown = Fault::PositionUnknown { axis: normal.letter() as char };
    let retract = only(normal, level(walk, &cycle.retract, in_force.retract, normal)?);
    let depth = only(normal, level(walk, &cycle.depth, in_force.depth, normal)?);
    if let (Some(r), Some(d)) = (in_force.retract, in_force.depth)
        && d > r
    {
        return Err(Fault::CycleUpsideDown);
    }
    let out = way_out(walk, in_force, normal)?;

    // 1. To the retract plane above the hole.
    let now = here.position[normal as usize];
    let (mut aside, goes_aside) = over_hole(walk, to, normal);
    let mut slant = None;
    let raise = match (cycle.approach, now.zip(in_force.retract)) {
        (Approach::PlaneFirst, _) => false,
        (Approach::ClearFirst, Some((now, retract))) => {
            let initial = in_force.initial.ok_or_else(|| unknown.clone())?;
            let clear = match &out {
                Some(_) if cycle.return_plane.is_some() => {
                    in_force.return_plane.ok_or_else(|| unknown.clone())?
                }
                Some(_) => cycle.approach.initial(initial, retract),
                None => retract,
            };
            let leg = cycle.approach.leg(now, initial, retract, clear);
            slant = (leg == Leg::Slant).then_some(clear);
            leg == Leg::Level
        }
        (way, Some((now, retract))) => way.retracts(now, retract),
        (Approach::RaiseFirst | Approach::ClearFirst, None) if goes_aside => return Err(unknown),
        (Approach::RaiseFirst | Approach::RetractFirst | Approach::ClearFirst, None) => true,
    };
    let above = slant.or(now);
    if let Some(clear) = slant {
        aside.axes[normal as usize] = Some(at(clear, normal, walk.unit()));
    }
    let to_retract = above.is_none() || above != in_force.retract || walk.waiting;
    if matches!(&cycle.kind, CycleKind::Tap(tap) if !tap.chuck) {
        moves.push((false, Op::StopSpindleTurning));
    }
    if raise {
        moves.push((false, traverse(retract.clone())));
    }
    if goes_aside || slant.is_some() {
        moves.push((false, traverse(aside)));
    }
    if to_retract && !raise {
        moves.push((false, traverse(retract.clone())));
    }

    // 2. The hole.
    let stated = feed.is_some();
    if !stated && bores_out(&cycle.kind) {
        // Nothing says to which feed to return.
        return Err(Fault::lacks(HolesLack::BoringFeedOut));
    }
    if let Some(feed) = feed {
        moves.push((false, Op::SetFeedRate(feed.clone())));
    }
    if cycle.kind.drives_spindle() {
        let from = moves.len();
        with_spindle(walk, in_force, to, [retract, depth], out, target, moves)?;
        if let Some((joined, Op::StraightFeed(_) | Op::SynchronisedFeed(_))) = moves.get_mut(from) {
            *joined = stated;
        }
        return Ok(());
    }
    pecks(walk, in_force, [&retract, out.as_ref().unwrap_or(&retract)], target, stated, moves)?;
    let first_cut = matches!(moves.last(), Some((_, Op::SetFeedRate(_))));
    moves.push((stated && first_cut, cut(depth)));
    let dwell = match &cycle.kind {
        CycleKind::Drill | CycleKind::Tap(_) | CycleKind::FineBore(_) | CycleKind::BoreStop(_) => None,
        CycleKind::DrillDwell { dwell } => Some(dwell),
        CycleKind::DrillPeck { dwell, .. }
        | CycleKind::DrillBreak { dwell, .. }
        | CycleKind::Bore { dwell, .. } => dwell.as_ref(),
    };
    if let Some(dwell) = dwell.filter(|dwell| lasts(dwell)) {
        moves.push((false, Op::Dwell(dwell.clone())));
    }

    // 3. Out.
    leave(&cycle.kind, retract, out, moves);
    Ok(())
}

/// Where the tool is left above the hole, if that is not the retract plane.
fn way_out(walk: &Walk, in_force: &ActiveCycle, normal: Axis) -> Result<Option<Point>, Fault> {
    let cycle = &in_force.cycle;
    let unknown = Fault::PositionUnknown { axis: normal.letter() as char };
    match cycle.return_level.known().or(walk.at.modes.return_level) {
        _ if let Some(plane) = &cycle.return_plane => {
            let same = in_force.return_plane.is_some() && in_force.return_plane == in_force.retract;
            let word = level(walk, plane, in_force.return_plane, normal)?;
            Ok((!same).then(|| only(normal, word)))
        }
        Some(ReturnLevel::Retract) => Ok(None),
        Some(ReturnLevel::Initial) => {
            let initial = in_force.initial.ok_or_else(|| unknown.clone())?;
            let initial = match (cycle.approach, in_force.retract) {
                (Approach::RaiseFirst | Approach::ClearFirst, None) => return Err(unknown),
                (way, retract) => way.initial(initial, retract.unwrap_or(initial)),
            };
            let differs = in_force.retract != Some(initial);
            Ok(differs.then(|| only(normal, at(initial, normal, walk.unit()))))
        }
        None => Err(Fault::EntryFactNeeded { fact: ModeName::ReturnLevel }),
    }
}

/// Out of the hole, to the retract plane or where the tool is left.
fn leave(kind: &CycleKind, retract: Point, out: Option<Point>, moves: &mut Vec<(bool, Op)>) {
    match (kind, out) {
        (CycleKind::Bore { feed_out, to_level, .. }, out) => {
            if let Some(feed) = feed_out {
                moves.push((false, Op::SetFeedRate(feed.clone())));
            }
            match out {
                Some(out) if *to_level => moves.push((feed_out.is_some(), cut(out))),
                out => {
                    moves.push((feed_out.is_some(), cut(retract)));
                    moves.extend(out.map(|out| (false, traverse(out))));
                }
            }
        }
        (_, out) => moves.push((false, traverse(out.unwrap_or(retract)))),
    }
}
