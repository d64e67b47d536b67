//! `feed-unit`: feeds are written in the unit of length active.
//!
//! Likewise a feed is stated again before the first cut after a change of units, where it is not known that both controls
//! take the feed before for the same then (`F100.`, then `G20`: 100 mm or 100 in a minute), and after a code of what the
//! feed counts, for targets on which such a code ends the feed even where it counts that already. Refused is a feed that
//! would have to be stated again and is not known.
//!
//! For targets whose feed counts what their lengths count. To inches a feed is rounded to one digit
//! more than a length in millimetres has.

use crate::modes::one_distance::is_measured;
use crate::pass::{Moment, Pass, Shared, Step};
use crate::support::mode_analysis::Known;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{exact, rebuild, rounded};
use crate::target::Target;
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::{FeedMode, Motion, Units};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::lack::FeedsLack;
use ncc_ir::program::cycle::CycleKind;
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Op, Program, Stmt};
use ncc_ir::track::Tracker;

/// Whether feeds are followed, because the target may forget one.
fn follows(l: &Shared) -> bool {
    l.target.caps.modes.feed_ends_with_mode || l.feed_again
}

/// A pass.
pub(crate) const AGAIN: Pass = Pass {
    name: "feed-again",
    about: "writes a feed again where the target forgets it with a mode",
    alone: None,
    step: Some(Step {
        moment: Moment::Arrival,
        needed: |l, p| {
            let again = l.feed_again;
            let changes =
                |op: &Op| matches!(op, Op::SetFeedMode(_)) || again && matches!(op, Op::UseLengthUnits(_));
            let changes = || l.entries.is_some() || p.stmts.iter().any(|stmt| changes(&stmt.op));
            follows(l) && (changes() || l.states.ask(FeedUnitState::is_busy))
        },
        run: |l, p| {
            let entries = l.entries.clone();
            let known = entries.as_deref();
            again(
                p.stmts,
                &mut l.walk.clone(),
                l.states.state_mut::<FeedUnitState>(),
                &l.target,
                known,
                p.diags,
            );
        },
        otherwise: |l, p| {
            if follows(l) {
                let own = l.states.state_mut::<FeedUnitState>();
                p.stmts.iter().for_each(|stmt| own.note(&stmt.op));
            }
        },
        first: None,
        finish: |_, _, _| {},
    }),
    program: &[],
    parametric: None,
};

/// A pass.
pub(crate) const PASS: Pass = Pass {
    name: "feed-unit",
    about: "writes feeds in the active unit of length",
    alone: Some(run),
    step: Step::at(
        Moment::Wording,
        |l, p| is_measured(l, p) && !l.target.caps.modes.feed_apart,
        |l, p| convert_feed_unit(p.stmts, &mut p.start.clone(), &l.target),
    ),
    program: &[],
    parametric: None,
};

/// Whether feeds are stated again after a change of units: it is not known what the target makes of them, or it makes
/// something else of them than the source.
pub(crate) fn says_again(target: &Target) -> bool {
    let fact = Behaviour::FeedAtUnits;
    let (own, other) = (target.source, target.caps.behaviours);
    let open = own.is_open(fact) || other.is_open(fact);
    target.caps.modes.feed_again || target.other_control && open || own.get(fact) != other.get(fact)
}

/// Feed active, and whether the units have changed since it was stated, or a code has ended it.
#[derive(Clone, Debug, Default)]
pub(crate) struct FeedUnitState {
    /// The feed of the source, in the unit in which its number counts now.
    feed: Option<Num>,
    /// What it was before the units changed, if that made it another.
    before: Option<Num>,
    /// Whether it is inverse time.
    by_time: bool,
    stale: bool,
    ended: bool,
    /// The units have changed, and which feed is active is not known: the caller or the iteration before has set it.
    lost: bool,
    /// Control comes from elsewhere before the next statement.
    enters: bool,
}

impl FeedUnitState {
    /// A subprogram begins.
    pub(crate) fn enter(&mut self) {
        self.enters = true;
    }

    /// Where control comes from elsewhere, and this holds.
    pub(crate) fn entered(at: &Tracker) -> FeedUnitState {
        let by_time = at.modes.feed_mode == Some(FeedMode::InverseTime);
        FeedUnitState { feed: at.feed, by_time, lost: at.stale_feed, ..FeedUnitState::default() }
    }

    /// Whether a feed waits to be stated again.
    pub(crate) fn is_busy(&self) -> bool {
        self.stale || self.ended || self.lost
    }

    /// Notes the feed of a statement.
    #[inline]
    pub(crate) fn note(&mut self, op: &Op) {
        let feed = match op {
            Op::SetFeedRate(feed) => feed,
            Op::StartCycle(cycle) => match &cycle.feed {
                Some(feed) => feed,
                None => return,
            },
            _ => return,
        };
        self.feed = feed.literal();
        (self.stale, self.ended, self.lost, self.before) = (false, false, false, None);
    }

    /// The units change; `lost`: a feed that is not known may be active.
    fn units(&mut self, units: Units, known: Option<Units>, lost: bool, target: &Target) {
        if known == Some(units) || self.by_time {
            return;
        }
        if self.feed.is_none() {
            self.lost = lost;
            return;
        }
        self.stale = true;
        let Some(feed) = &mut self.feed else { return };
        let unit = if units == Units::Inch { Unit::Inch } else { Unit::Mm };
        if target.source.does(Behaviour::FeedAtUnits)
            && matches!(feed.unit, Unit::Mm | Unit::Inch)
            && feed.unit != unit
        {
            self.before = Some(self.before.unwrap_or(*feed));
            feed.unit = unit;
        }
    }
}

/// Whether a statement applies the active feed.
fn cuts(op: &Op) -> bool {
    match op {
        Op::StraightFeed(_) | Op::SynchronisedFeed(_) | Op::ArcFeed(_) | Op::ArcForm(_) => true,
        Op::Hole(_) | Op::Pattern(_) => true,
        Op::StartCycle(cycle) => cycle.feed.is_none(),
        _ => false,
    }
}

/// What is stated between blocks that end the feed and a structure, which is looked at by itself: the feed again, where the
/// structure or what follows it takes it up.
pub(crate) fn before_control(
    state: &mut FeedUnitState,
    at: &Tracker,
    target: &Target,
    control: &Stmt,
    behind: &[Stmt],
) -> Option<Result<Stmt, Diagnostic>> {
    let goes_on = matches!(control.op, Op::Control(_) | Op::Label(_) | Op::Call(_) | Op::RepeatBlocks(_));
    let taken = || cuts_first(std::slice::from_ref(control)) || goes_on && cuts_first(behind);
    if !std::mem::take(&mut state.ended) || !taken() {
        return None;
    }
    let (Some(feed), Some(units)) = (state.feed, at.modes.units) else {
        return Some(Err(Diagnostic::new(Fault::lacks(FeedsLack::EndedByModeCode), control.span)));
    };
    let feed = in_unit(feed, units, target).unwrap_or(feed);
    Some(Ok(Stmt::new(control.span, Op::SetFeedRate(feed.into()))))
}

/// Whether statements may apply the active feed before they say one.
fn cuts_first(body: &[Stmt]) -> bool {
    let mut before = body.iter().take_while(|stmt| {
        stmt.skip.is_some()
            || !matches!(&stmt.op, Op::SetFeedRate(_) | Op::SetFeedMode(_))
                && !matches!(&stmt.op, Op::StartCycle(cycle) if cycle.feed.is_some())
    });
    before.any(|stmt| match &stmt.op {
        Op::Control(control) => control.bodies().any(|body| cuts_first(body)),
        Op::Position(_) => true,
        op => cuts(op.unwrapped()),
    })
}

/// Says feeds again after a change of units, and after codes that end them.
pub(crate) fn again(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    state: &mut FeedUnitState,
    target: &Target,
    entries: Option<&Known>,
    diags: &mut Vec<Diagnostic>,
) {
    let (mut split, mut after_flow) = (false, std::mem::take(&mut state.enters));
    let has = |units| body.iter().any(|stmt| stmt.op == Op::UseLengthUnits(units));
    let mixed = says_again(target) && has(Units::Mm) && has(Units::Inch);
    rebuild(body, |mut stmt, made| {
        walk.enter(stmt.skip);
        stmt.joined &= !std::mem::take(&mut split);
        // After a call the feed is what the subprogram has left.
        if std::mem::replace(&mut after_flow, matches!(stmt.op, flow!()))
            && let Some(at) = entries.and_then(|known| known.before(&stmt))
        {
            *state = FeedUnitState { ended: state.ended, ..FeedUnitState::entered(at) };
            entries.into_iter().for_each(|known| known.feeds(&stmt, &mut walk.at));
        }
        let cuts = match stmt.op.unwrapped() {
            Op::Position(_) => walk.at.modes.motion == Some(Motion::Feed),
            op => cuts(op),
        };
        let again = state.stale || state.ended;
        if cuts && state.ended && (state.feed.is_none() || walk.at.modes.units.is_none()) {
            diags.push(Diagnostic::new(Fault::lacks(FeedsLack::EndedByModeCode), stmt.span));
            state.ended = false;
        }
        let may_cut = matches!(stmt.op, Op::Position(_)) && walk.at.modes.motion.is_none();
        let by_feed = cuts && !matches!(stmt.op.unwrapped(), Op::SynchronisedFeed(_));
        if (by_feed || may_cut) && std::mem::take(&mut state.lost) || may_cut && state.stale {
            diags.push(Diagnostic::new(Fault::lacks(FeedsLack::EndedByUnits), stmt.span));
        }
        if let (true, true, Some(feed), Some(units)) = (cuts, again, state.feed, walk.at.modes.units) {
            if state.stale {
                let before = state.before.unwrap_or(feed).nanos(false).unwrap_or(0);
                let now = feed.nanos(false).unwrap_or(0);
                diags.push(Diagnostic::new(Fault::FeedAtUnits { before, now }, stmt.span));
            }
            let feed = in_unit(feed, units, target).unwrap_or(feed);
            let mut said = Stmt::new(stmt.span, Op::SetFeedRate(feed.into()));
            (said.number, said.skip, said.joined) = (stmt.number.take(), stmt.skip, stmt.joined);
            stmt.joined = true;
            // In a block that may be skipped it is stated for that block alone.
            let skipped = stmt.skip.is_some();
            (state.stale, state.ended) = (state.stale && skipped, state.ended && skipped);
            made.push(said);
        }
        if let Op::UseLengthUnits(units) = &stmt.op {
            let known = walk.at.modes.units;
            state.units(*units, known, (mixed || known.is_some()) && walk.at.fed, target);
            if target.caps.modes.units_alone && walk.at.modes.units.is_some_and(|now| now != *units) {
                (stmt.joined, split) = (false, true);
            }
        }
        if let Op::SetFeedMode(mode) = &stmt.op {
            state.by_time = *mode == FeedMode::InverseTime;
        }
        if let (Op::SetFeedMode(mode), true) = (&stmt.op, target.caps.modes.feed_ends_with_mode) {
            // Another mode ends it on every control.
            let other = walk.at.modes.feed_mode.is_some_and(|now| now != *mode);
            state.ended = !other && *mode != FeedMode::InverseTime && walk.at.fed;
            if other {
                state.feed = None;
            }
        }
        state.note(&stmt.op);
        walk.step(&stmt);
        made.push(stmt);
    });
}

/// Writes them in the active unit.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| {
        convert_feed_unit(body, &mut walk.clone(), target);
        again(body, walk, &mut FeedUnitState::default(), target, None, diags);
    });
}

/// The same for one body.
pub(crate) fn convert_feed_unit(body: &mut [Stmt], walk: &mut Walk, target: &Target) {
    for stmt in body {
        walk.enter(stmt.skip);
        let units = walk.at.modes.units;
        let mut mend = |feed: &mut Expr| {
            if let (Some(units), Some(num)) = (units, feed.literal())
                && let Some(num) = in_unit(num, units, target)
            {
                *feed = num.into();
            }
        };
        match &mut stmt.op {
            Op::SetFeedRate(feed) => mend(feed),
            Op::StartCycle(cycle) => {
                cycle.feed.iter_mut().for_each(&mut mend);
                if let CycleKind::Bore { feed_out: Some(feed), .. } = &mut cycle.kind {
                    mend(feed);
                }
            }
            _ => {}
        }
        walk.step(stmt);
    }
}

/// Whether a statement says a feed in another unit than `units`.
pub(crate) fn differs(op: &Op, units: Option<Units>) -> bool {
    let other = |feed: &Expr| match (feed.literal().map(|n| n.unit), units) {
        (Some(Unit::Mm), units) => units != Some(Units::Mm),
        (Some(Unit::Inch), units) => units != Some(Units::Inch),
        _ => false,
    };
    match op {
        Op::SetFeedRate(feed) => other(feed),
        Op::StartCycle(cycle) => cycle.feed.as_ref().is_some_and(other),
        _ => false,
    }
}

fn in_unit(num: Num, units: Units, target: &Target) -> Option<Num> {
    let nanos = num.nanos(false)?;
    match (num.unit, units) {
        (Unit::Mm, Units::Inch) => Some(rounded(nanos, target.decimals_in(Unit::Inch), Unit::Inch)),
        (Unit::Inch, Units::Mm) => Some(exact(nanos, Unit::Mm)),
        _ => None,
    }
}
