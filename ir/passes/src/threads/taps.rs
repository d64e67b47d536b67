//! `taps`: a thread's pitch and what the spindle does after a hole, as the target says them.
//!
//! Some controls take the pitch from feed and speed, others state it; some leave the spindle stopped
//! after a rigid tap, others start it again. Where the cycle's end has to say what the cycle itself
//! cannot, it is stated there. A feed by the turn with more digits than the target writes is stated by the minute. A feed that the cycle set stays active after it, as it was. After boring
//! with a stop, one control has the spindle turn clockwise, another as it did before: where it surely
//! turns clockwise, these are one.
//!
//! Not here: tapping for a target without a cycle for it, which `expand-cycles` writes out or refuses.

use crate::support::walk::each_body;
use crate::support::write::{exact, rebuild, rounded};
use crate::target::Target;
use ncc_ir::canon::{FeedMode, Motion, Spindle, Units};
use ncc_ir::caps::{CycleCap, CycleForm};
use ncc_ir::diag::{Diagnostic, Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num, ONE, Unit};
use ncc_ir::lack::{TapValue, ThreadsLack};
use ncc_ir::program::cycle::{Cycle, CycleKind, Tap};
use ncc_ir::program::kinds::{
    conduct, flow, frames, machine, miscellaneous, moves, polar, tooling, variables,
};
use ncc_ir::program::{Op, Pitch, Program, Stmt};
use ncc_ir::track::Tracker;

use crate::pass::{Moment, Pass, Step};
use crate::support::needs::CYCLE;
use crate::support::walk::Walk;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "taps",
    about: "writes pitches of threads in the target's form",
    alone: Some(run),
    step: Step::at(
        Moment::Wording,
        |_, p| p.needs(CYCLE),
        |l, p| {
            let state = l.states.state_mut::<TapsState>();
            if state.passes(p.stmts) {
                return p.stmts.iter().for_each(|stmt| state.note(stmt));
            }
            convert_taps(p.stmts, &mut p.start.clone(), state, &l.target, p.diags)
        },
    ),
    program: &[],
    parametric: None,
};

/// Digits of a pitch in millimetres that follows from feed and speed, as fine as pitches are compared.
const PITCH_DIGITS: u8 = 6;

/// The same in inches, of which one digit less would be coarser.
const PITCH_DIGITS_INCH: u8 = 8;

/// Feed and speed active, as far as they are numbers.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Said {
    pub(crate) speed: Option<Num>,
    pub(crate) feed: Option<Num>,
}

/// What the pass remembers from piece to piece of a body.
#[derive(Clone, Debug, Default)]
pub(crate) struct TapsState {
    /// Feed and speed active.
    pub(crate) said: Said,
    /// A tap has been changed and is active, and relies on feed or speed staying as they are.
    changed: bool,
    /// The feed that it says on the target.
    feed: Option<Num>,
    /// What its end has to say.
    owed: Vec<Op>,
    /// A bore is active that relies on the spindle turning clockwise.
    clockwise: bool,
    /// Whether a feed that is not said here has been stated where control comes from.
    entered: bool,
    /// A tap has put its feed in the place of one that is not known.
    lost: bool,
    /// A tap is active that counts its feed by the minute, where the program counts it by the turn.
    by_minute: bool,
}

impl TapsState {
    /// The state of a stretch of blocks to which control may come from several places: `known` is what holds there.
    pub(crate) fn entered(known: &Tracker) -> TapsState {
        let said = Said { feed: known.feed, speed: known.speed };
        TapsState { said, entered: known.fed, ..TapsState::default() }
    }

    /// Whether the feed that a stretch leaves active is another than the program's, which is not known.
    pub(crate) fn has_lost_feed(&self) -> bool {
        self.lost
    }

    /// Whether a statement goes at a feed that a tap has put in the place of one that is not known.
    fn goes_lost(&mut self, stmt: &Stmt) -> bool {
        match stmt.op.unwrapped() {
            Op::SetFeedRate(_) | Op::ProgramEnd | Op::BeginAgain => {
                self.lost &= stmt.skip.is_some();
                false
            }
            Op::StartCycle(cycle) => self.lost && cycle.feed.is_none(),
            Op::StraightFeed(_) | Op::ArcFeed(_) | Op::ArcForm(_) => self.lost,
            Op::Position(_) => self.lost && !self.changed,
            _ => false,
        }
    }

    /// Whether statements are holes and plain moves alone, and no cycle that was changed is active or has left its feed:
    /// then they are noted, and no more.
    fn passes(&self, stmts: &[Stmt]) -> bool {
        let plain = |stmt: &Stmt| {
            let op = &stmt.op;
            matches!(
                op,
                Op::Hole(_) | Op::StraightFeed(_) | Op::StraightTraverse(_) | Op::Comment(_) | Op::Blank
            )
        };
        let waits = self.is_busy() || self.by_minute || self.lost || !self.owed.is_empty();
        !waits && stmts.iter().all(plain)
    }

    /// Whether the end of a cycle that was changed is to come.
    pub(crate) fn is_busy(&self) -> bool {
        self.changed || self.clockwise
    }

    /// Takes note of feed and speed.
    #[inline]
    pub(crate) fn note(&mut self, stmt: &Stmt) {
        self.said.note(stmt);
    }

    /// Whether a feed is the one that a changed tap says on the target.
    fn says_the_same(&self, stmt: &Stmt, walk: &Walk) -> bool {
        let Op::SetFeedRate(feed) = &stmt.op else { return false };
        let both = [feed.literal(), self.feed].map(|feed| in_unit(feed?, walk).ok());
        stmt.skip.is_none() && both[0].is_some() && both[0] == both[1]
    }
}

impl Said {
    /// Takes note of feed and speed.
    #[inline]
    pub(crate) fn note(&mut self, stmt: &Stmt) {
        // In a block with block skip, the number that is active already changes nothing.
        let literal = |value: &Expr, now: Option<Num>| {
            value.literal().filter(|value| stmt.skip.is_none() || Some(*value) == now)
        };
        match &stmt.op {
            Op::SetFeedRate(feed) => self.feed = literal(feed, self.feed),
            Op::StartCycle(cycle) => {
                if let Some(feed) = &cycle.feed {
                    self.feed = literal(feed, self.feed);
                }
                if matches!(cycle.kind, CycleKind::Bore { feed_out: Some(_), .. }) {
                    self.feed = None;
                }
            }
            Op::UseLengthUnits(_) | Op::SetFeedMode(_) => self.feed = None,
            miscellaneous!() => match &stmt.op {
                Op::SetSpindleSpeed(speed) => self.speed = literal(speed, self.speed),
                Op::SetSpindleMode(_) => self.speed = None,
                _ => {}
            },
            flow!() => (self.feed, self.speed) = (None, None),
            Op::SetDistanceMode(_)
            | Op::SelectPlane(_)
            | Op::SetReturnLevel(_)
            | Op::Position(_)
            | Op::Hole(_)
            | Op::Pattern(_)
            | Op::EndCycle
            | Op::ProgramEnd
            | Op::BeginAgain
            | variables!()
            | machine!()
            | frames!()
            | conduct!()
            | tooling!()
            | moves!()
            | polar!() => {}
        }
    }
}

/// Says them as the target does.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| {
        convert_taps(body, walk, &mut TapsState::default(), target, diags)
    });
}

/// The same for one piece of a body.
pub(crate) fn convert_taps(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    state: &mut TapsState,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    rebuild(body, |mut stmt, made| {
        walk.enter(stmt.skip);
        let ends = (state.changed || state.clockwise)
            && match stmt.op.unwrapped() {
                Op::EndCycle | Op::StartCycle(_) | Op::ProgramEnd | Op::BeginAgain | moves!() | flow!() => {
                    true
                }
                Op::Position(_) => walk.at.modes.motion != Some(Motion::Cycle),
                _ => false,
            };
        let same = state.changed && state.says_the_same(&stmt, walk);
        if same {
            // It is active there already, and stays so after the tap.
            state.owed.retain(|op| !matches!(op, Op::SetFeedRate(_)));
        }
        let relies = state.changed && !same && matches!(stmt.op, Op::SetFeedRate(_) | Op::SetSpindleSpeed(_))
            || state.by_minute && matches!(stmt.op, Op::SetFeedMode(_) | Op::UseLengthUnits(_));
        if ends && state.changed && stmt.skip.is_some() || relies {
            let lack = if ends { ThreadsLack::SkippedTapEnd } else { ThreadsLack::FeedOrSpeedChanges };
            diags.push(Diagnostic::new(Fault::lacks(lack), stmt.span));
        }
        if let Some(lack) = turned(&stmt, state) {
            diags.push(Diagnostic::new(Fault::lacks(lack), stmt.span));
        }
        if state.goes_lost(&stmt) {
            diags.push(Diagnostic::new(Fault::lacks(ThreadsLack::FeedReplaced), stmt.span));
        }
        state.clockwise &= !ends;
        let mut after = Vec::new();
        if ends {
            (state.changed, state.feed, state.by_minute) = (false, None, false);
            after = std::mem::take(&mut state.owed);
            let again = matches!(&stmt.op, Op::StartCycle(cycle) if matches!(cycle.kind, CycleKind::Tap(_)));
            if again {
                // The next tap says its own.
                after.retain(|op| matches!(op, Op::SetFeedRate(_) | Op::SetFeedMode(_)));
            }
            if !matches!(stmt.op, Op::EndCycle) && !after.is_empty() {
                let ops = std::mem::take(&mut after);
                for op in std::iter::once(Op::EndCycle).chain(ops) {
                    let one = Stmt::new(stmt.span, op);
                    walk.step(&one);
                    state.note(&one);
                    made.push(one);
                }
                stmt.joined = false;
            }
        }
        let mut before = None;
        if let Op::StartCycle(cycle) = &mut stmt.op
            && stmt.skip.is_none()
            && let Some(feed) = by_minute(cycle, walk, state, target)
        {
            cycle.feed = Some(feed.into());
            let mut mode = Stmt::new(stmt.span, Op::SetFeedMode(FeedMode::PerMinute));
            (mode.number, mode.joined) = (stmt.number.take(), stmt.joined);
            stmt.joined = false;
            walk.step(&mode);
            made.push(mode);
            state.owed.push(Op::SetFeedMode(FeedMode::PerRevolution));
            (state.changed, state.by_minute, state.lost, state.feed) = (true, true, true, Some(feed));
        }
        if let Op::StartCycle(cycle) = &mut stmt.op {
            match fit(cycle, walk, state, target) {
                Ok(Some(feed)) if stmt.skip.is_some() => {
                    diags.push(Diagnostic::new(Fault::lacks(ThreadsLack::SkippedTap), stmt.span));
                    let _ = feed;
                }
                Ok(feed) => before = feed.flatten(),
                Err(fault) => diags.push(Diagnostic::new(fault, stmt.span)),
            }
        }
        if let Some(feed) = before {
            let mut said = Stmt::new(stmt.span, Op::SetFeedRate(feed));
            (said.number, said.joined) = (stmt.number.take(), stmt.joined);
            stmt.joined = false;
            state.note(&said);
            made.push(said);
        }
        // A mode that is active already leaves the feed as it is; in other units it is still that of the source.
        let again = match &stmt.op {
            Op::SetFeedMode(mode) => walk.at.modes.feed_mode == Some(*mode),
            Op::UseLengthUnits(units) => walk.at.modes.units == Some(*units),
            _ => false,
        };
        if matches!(stmt.op, Op::UseLengthUnits(_)) && !again {
            state.entered |= state.said.feed.is_some();
        }
        walk.step(&stmt);
        // What a changed tap sets is given back at its end.
        let tap = state.changed && matches!(stmt.op, Op::StartCycle(_));
        if !again && !tap {
            state.note(&stmt);
        }
        let span = stmt.span;
        made.push(stmt);
        for op in after {
            let one = Stmt::new(span, op);
            state.note(&one);
            walk.step(&one);
            made.push(one);
        }
    });
}

/// What cannot be said of a spindle that is switched while a cycle is active whose end has to say what
/// the spindle does.
fn turned(stmt: &Stmt, state: &TapsState) -> Option<ThreadsLack> {
    let stops =
        matches!(stmt.op, Op::StartSpindleCounterclockwise | Op::StopSpindleTurning | Op::OrientSpindle(_));
    let may_end = stmt.skip.is_some() && matches!(stmt.op, Op::StartCycle(_) | Op::EndCycle);
    if state.clockwise && (stops || may_end) {
        return Some(ThreadsLack::BoringReversal);
    }
    let switches = stops || matches!(stmt.op, Op::StartSpindleClockwise | Op::ChangeTool);
    let owed = |op: &Op| !matches!(op, Op::SetFeedRate(_));
    (switches && state.owed.iter().any(owed)).then_some(ThreadsLack::SwitchedSpindle)
}

/// The feed by the minute of a tap whose feed by the turn has more digits than the target writes, where it has fewer.
fn by_minute(cycle: &Cycle, walk: &Walk, state: &TapsState, target: &Target) -> Option<Num> {
    let CycleKind::Tap(tap) = &cycle.kind else { return None };
    let name = cycle.kind.name();
    let by_feed =
        target.caps.holes.cycles.iter().any(|c| c.kind == name && matches!(c.form, CycleForm::Control(_)));
    if !by_feed || tap.pitch != Pitch::Feed || walk.at.modes.feed_mode != Some(FeedMode::PerRevolution) {
        return None;
    }
    let feed = cycle.feed.as_ref().map_or(state.said.feed, Expr::literal)?;
    let (turn, unit) = in_unit(feed, walk).ok()?;
    let digits = |nanos: Nanos| exact(nanos, unit).trimmed().scale;
    let minute = i128::from(turn) * turns(state.said.speed).ok()? / i128::from(ONE);
    let minute = Nanos::try_from(minute).ok()?;
    let decimals = target.caps.modes.feed_decimals + u8::from(unit == Unit::Inch);
    (digits(turn) > decimals && digits(minute) <= decimals).then(|| exact(minute, unit))
}

/// Makes a tap one that the target says. Gives the feed that must be stated before it, if it was changed.
#[allow(clippy::option_option)]
fn fit(
    cycle: &mut Cycle,
    walk: &Walk,
    state: &mut TapsState,
    target: &Target,
) -> Result<Option<Option<Expr>>, Fault> {
    let name = cycle.kind.name();
    if let Some(after) = spindle_after(cycle, walk, target) {
        match &mut cycle.kind {
            CycleKind::BoreStop(bore) => bore.after = after,
            CycleKind::FineBore(bore) => bore.after = after,
            _ => {}
        }
        state.clockwise = true;
    }
    let CycleKind::Tap(tap) = &mut cycle.kind else { return Ok(None) };
    let mut caps = target.caps.holes.cycles.iter().filter(|c| c.kind == name);
    let fits = |c: &CycleCap| c.form == CycleForm::Any || c.turns.contains(&tap.turn);
    let Some(form) = caps.find(|c| fits(c)).map(|c| c.form) else { return Ok(None) };
    if form.says(&CycleKind::Tap(tap.clone())) {
        return Ok(None);
    }
    let mut before = None;
    match (form, &tap.pitch) {
        (CycleForm::Stated, Pitch::Feed) if !tap.chuck => {
            let feed = cycle.feed.as_ref().and_then(Expr::literal).or(state.said.feed);
            let pitch = pitch_of(feed, state.said.speed, walk)?;
            tap.pitch = Pitch::Stated(pitch.into());
            before = cycle.feed.take();
        }
        (CycleForm::Control(_), Pitch::Stated(pitch)) => {
            let feed = feed_of(pitch.literal(), state.said.speed, walk)?;
            tap.pitch = Pitch::Feed;
            cycle.feed = Some(feed.into());
            state.feed = Some(feed);
            state.owed.extend(state.said.feed.map(|feed| Op::SetFeedRate(feed.into())));
            state.lost |= state.entered && state.said.feed.is_none();
        }
        _ => {}
    }
    if matches!(form, CycleForm::Control(_)) {
        let own = if tap.chuck { tap.turn.spindle() } else { Spindle::Stopped };
        if tap.after != own {
            state.owed.insert(0, start(tap));
            tap.after = own;
        }
    }
    state.changed = true;
    Ok(Some(before))
}

/// What the spindle does after boring with a stop, as the target says it, where it says the cycle so and
/// the spindle surely turns clockwise before it.
#[allow(clippy::option_option)]
fn spindle_after(cycle: &Cycle, walk: &Walk, target: &Target) -> Option<Option<Spindle>> {
    let name = cycle.kind.name();
    let (turn, after) = match &cycle.kind {
        CycleKind::BoreStop(bore) => (bore.turn, bore.after),
        CycleKind::FineBore(bore) => (bore.turn, bore.after),
        CycleKind::Drill
        | CycleKind::DrillDwell { .. }
        | CycleKind::DrillPeck { .. }
        | CycleKind::DrillBreak { .. }
        | CycleKind::Bore { .. }
        | CycleKind::Tap(_) => return None,
    };
    let own = target.caps.holes.cycles.iter().filter(|c| c.kind == name).find_map(|c| match c.form {
        CycleForm::Control(own) => Some(own.after()),
        CycleForm::Any | CycleForm::Stated => None,
    })?;
    let one = [None, Some(Spindle::Clockwise)].contains(&after) && turn.is_none();
    (one && own != after && walk.at.spindle == Some(Spindle::Clockwise)).then_some(own)
}

/// What brings the spindle to what it does after a tap.
fn start(tap: &Tap) -> Op {
    match tap.after {
        Spindle::Stopped => Op::StopSpindleTurning,
        Spindle::Clockwise => Op::StartSpindleClockwise,
        Spindle::Counterclockwise => Op::StartSpindleCounterclockwise,
    }
}

fn unknown(value: TapValue) -> Fault {
    Fault::lacks(ThreadsLack::TapUnknown { value })
}

fn in_unit(num: Num, walk: &Walk) -> Result<(Nanos, Unit), Fault> {
    let unit = match (num.unit, walk.at.modes.units) {
        (Unit::Mm, _) => Unit::Mm,
        (Unit::Inch, _) | (_, Some(Units::Inch)) => Unit::Inch,
        (_, Some(Units::Mm)) => Unit::Mm,
        (_, None) => return Err(Fault::EntryFactNeeded { fact: ModeName::Units }),
    };
    let nanos = Num { unit, ..num }.nanos(false).filter(|n| *n > 0);
    Ok((nanos.ok_or_else(|| unknown(TapValue::Pitch))?, unit))
}

/// Whether the feed is one of a minute, else of a turn.
fn per_minute(walk: &Walk) -> Result<bool, Fault> {
    match walk.at.modes.feed_mode {
        Some(FeedMode::PerMinute) => Ok(true),
        Some(FeedMode::PerRevolution) => Ok(false),
        Some(FeedMode::InverseTime) => Err(unknown(TapValue::Feed)),
        None => Err(Fault::EntryFactNeeded { fact: ModeName::FeedMode }),
    }
}

fn turns(speed: Option<Num>) -> Result<i128, Fault> {
    let nanos = speed.and_then(|n| n.nanos(false)).filter(|n| *n > 0);
    nanos.map(i128::from).ok_or_else(|| unknown(TapValue::Speed))
}

pub(crate) fn pitch_of(feed: Option<Num>, speed: Option<Num>, walk: &Walk) -> Result<Num, Fault> {
    let (feed, unit) = in_unit(feed.ok_or_else(|| unknown(TapValue::Feed))?, walk)?;
    if !per_minute(walk)? {
        return Ok(exact(feed, unit));
    }
    let speed = turns(speed)?;
    let pitch = (i128::from(feed) * i128::from(ONE) + speed / 2) / speed;
    Ok(rounded(Nanos::try_from(pitch).unwrap_or(Nanos::MAX), pitch_digits(unit), unit))
}

fn pitch_digits(unit: Unit) -> u8 {
    if unit == Unit::Inch { PITCH_DIGITS_INCH } else { PITCH_DIGITS }
}

fn feed_of(pitch: Option<Num>, speed: Option<Num>, walk: &Walk) -> Result<Num, Fault> {
    let (pitch, unit) = in_unit(pitch.ok_or_else(|| unknown(TapValue::Pitch))?, walk)?;
    if !per_minute(walk)? {
        return Ok(exact(pitch, unit));
    }
    let feed = i128::from(pitch) * turns(speed)? / i128::from(ONE);
    Ok(rounded(Nanos::try_from(feed).unwrap_or(Nanos::MAX), PITCH_DIGITS, unit))
}
