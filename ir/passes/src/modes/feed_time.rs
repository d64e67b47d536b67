//! Moves whose F the target counts otherwise than the source.
//!
//! Linear and rotary axes together: `G1 X10 A90 F100` takes 54 s where a degree counts as a millimetre, and 6 s where F
//! counts along X, Y and Z alone. Such a line is written by its time, which counts the same on every control:
//!
//! ```text
//! G01 X10. A90. F100.   →   G93 G1 X10 A90 F1.104
//! X20.                      G94 X20 F100
//! ```
//!
//! A target without an inverse-time feed gets the feed that takes the same time by its own way of counting.
//!
//! An inverse-time arc: `G93 G02 X20. I10. F2.` goes at F times the radius where F counts radii, and in a half minute where it
//! counts time alone. F is divided or multiplied by the arc's angle.
//!
//! Not here: how long they take, which is execution's.

use crate::pass::{Moment, Pass, Step};
use crate::support::mode_analysis::Known;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{Rebuild, rebuild};
use crate::target::Target;
use ncc_exec::{DEGREES, LINEAR};
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::{AXES, FeedMode, Modes, Units};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::{Nanos, Num, ONE, Unit};
use ncc_ir::geometry;
use ncc_ir::lack::FeedsLack;
use ncc_ir::program::kinds::{drilling, flow};
use ncc_ir::program::{Arc, Op, Point, Program, Stmt};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "feed-time",
    about: "writes moves in inverse time whose feed the target counts otherwise",
    alone: Some(run),
    step: Some(Step {
        moment: Moment::Arrival,
        needed: |l, p| {
            let concerned =
                || l.entries.is_some() || l.states.ask(|own: &FeedTimeState| own.concerns(p.stmts, &l.walk));
            l.times_differ && p.lines.is_none() && concerned()
        },
        run: |l, p| {
            let entries = l.entries.clone();
            let known = entries.as_deref();
            convert_feed_time(
                p.stmts,
                &mut l.walk.clone(),
                l.states.state_mut::<FeedTimeState>(),
                &l.target,
                known,
                p.diags,
            );
        },
        otherwise: |l, p| {
            if l.times_differ && p.lines.is_none() {
                l.states.state_mut::<FeedTimeState>().note(p.stmts);
            }
        },
        first: None,
        finish: |_, _, _| {},
    }),
    program: &[],
    parametric: None,
};

/// What the pass remembers from piece to piece.
#[derive(Clone, Debug, Default)]
pub(crate) struct FeedTimeState {
    /// What the feed counts in the source, where the output has another feed.
    by_time: Option<FeedMode>,
    /// Whether the source has said that mode again since, so that F alone is missing.
    mode_said: bool,
    /// F of the source, which its unit and its mode need not take away where they are stated again.
    feed: Option<Num>,
    /// The tool tip is controlled.
    tip: bool,
    /// Whether inverse-time output was reported.
    reported: bool,
    /// Control comes from elsewhere before the next statement.
    enters: bool,
}

/// Whether anything may have to be done.
pub(crate) fn differs(target: &Target) -> bool {
    rotary_differs(target) || arcs_differ(target)
}

fn rotary_differs(target: &Target) -> bool {
    let fact = Behaviour::RotaryFeed;
    let (own, there) = (target.source, target.caps.behaviours);
    // Two machines have diameters of their own.
    let own_way = own.get(fact) > DEGREES;
    own.get(fact) != there.get(fact) || target.other_control && (there.is_open(fact) || own_way)
}

fn arcs_differ(target: &Target) -> bool {
    let fact = Behaviour::ArcByTime;
    target.source.get(fact) != target.caps.behaviours.get(fact)
}

fn turns(to: &Point) -> bool {
    to.axes[3..].iter().any(Option::is_some)
}

impl FeedTimeState {
    /// Whether statements may concern it.
    pub(crate) fn concerns(&self, stmts: &[Stmt], walk: &Walk) -> bool {
        self.by_time.is_some()
            || walk.at.modes.feed_mode == Some(FeedMode::InverseTime)
            || stmts.iter().any(|stmt| match &stmt.op {
                Op::StraightFeed(m) | Op::Position(m) => turns(&m.to),
                Op::SetFeedMode(mode) => *mode == FeedMode::InverseTime,
                _ => false,
            })
    }

    /// A subprogram begins.
    pub(crate) fn enter(&mut self) {
        (self.enters, self.by_time, self.mode_said) = (true, None, false);
    }

    /// Follows statements that do not concern it.
    pub(crate) fn note(&mut self, stmts: &[Stmt]) {
        for stmt in stmts {
            if let Op::UseToolCentrePoint(on) = stmt.op {
                self.tip = on;
            }
        }
    }
}

/// What was active before a statement.
struct Before {
    modes: Modes,
    feed: Option<Num>,
}

/// Runs it alone.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| {
        convert_feed_time(body, walk, &mut FeedTimeState::default(), target, None, diags)
    });
}

/// Writes such moves so that the target takes the same time.
pub(crate) fn convert_feed_time(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    state: &mut FeedTimeState,
    target: &Target,
    entries: Option<&Known>,
    diags: &mut Vec<Diagnostic>,
) {
    let mut after_flow = std::mem::take(&mut state.enters);
    // The walk has followed what was made of the statements before these.
    if let Some(mode) = state.by_time {
        (walk.at.modes.feed_mode, walk.at.feed) = (Some(mode), state.feed);
    }
    rebuild(body, |mut stmt, made| {
        walk.enter(stmt.skip);
        if std::mem::replace(&mut after_flow, matches!(stmt.op, flow!())) {
            entries.into_iter().for_each(|known| known.feeds(&stmt, &mut walk.at));
        }
        let before = Before { modes: walk.at.modes, feed: walk.at.feed };
        if let Op::UseToolCentrePoint(on) = stmt.op {
            state.tip = on;
        }
        let timed = match &stmt.op {
            Op::StraightFeed(m) if turns(&m.to) && !state.tip && rotary_differs(target) => {
                Some(line(&m.to, &walk.at, target))
            }
            _ => None,
        };
        let in_time = before.modes.feed_mode == Some(FeedMode::InverseTime);
        let arc_from = (in_time && matches!(stmt.op, Op::ArcFeed(_))).then(|| walk.at.clone());
        walk.step(&stmt);
        let again = match &stmt.op {
            Op::SetFeedMode(mode) => before.modes.feed_mode == Some(*mode),
            Op::UseLengthUnits(units) => before.modes.units == Some(*units),
            _ => false,
        };
        if again {
            // Said again, they leave F as it is.
            walk.at.feed = walk.at.feed.or(before.feed);
        }
        match &stmt.op {
            Op::StraightFeed(_) if timed.is_some() => match timed.unwrap_or(Ok(None)) {
                Ok(None) => state.back(&mut stmt, &before, target, made),
                Ok(Some(time)) => {
                    if !std::mem::replace(&mut state.reported, true) {
                        diags.push(Diagnostic::new(Fault::FeedByTime, stmt.span));
                    }
                    state.by_time(&mut stmt, &before, time, target, made);
                }
                Err(lack) => {
                    let fault = Fault::lacks(lack);
                    diags.push(Diagnostic::new(fault, stmt.span));
                }
            },
            Op::Position(m) if turns(&m.to) && !state.tip && rotary_differs(target) => {
                diags.push(Diagnostic::new(Fault::lacks(FeedsLack::RotaryMaybeRapid), stmt.span));
            }
            Op::ArcFeed(arc) if in_time => {
                if arcs_differ(target)
                    && let Some(from) = &arc_from
                    && let Err(lack) = arc_by_time(arc, from, target, made)
                {
                    let fault = Fault::lacks(lack);
                    diags.push(Diagnostic::new(fault, stmt.span));
                }
            }
            Op::SetFeedRate(_) if state.by_time.is_some() => {
                state.feed = walk.at.feed;
                return made.leave_out(stmt);
            }
            // The same mode again: F counts as before, and the target has that of the time.
            Op::SetFeedMode(mode) if state.by_time == Some(*mode) => state.mode_said = true,
            Op::SetFeedMode(_) => (state.by_time, state.mode_said) = (None, false),
            Op::StraightFeed(_)
            | Op::ArcFeed(_)
            | Op::ArcForm(_)
            | Op::SynchronisedFeed(_)
            | Op::Position(_)
            | Op::Polar(_)
            | Op::ProgramEnd
            | Op::BeginAgain
            | drilling!()
            | flow!() => state.back(&mut stmt, &before, target, made),
            _ => {}
        }
        made.push(stmt);
    });
}

impl FeedTimeState {
    /// A block by its time.
    fn by_time(&mut self, stmt: &mut Stmt, before: &Before, time: Num, target: &Target, made: &mut Rebuild) {
        let mut said = Vec::new();
        // F in the same block is that of the other way.
        let stated = made.out.pop_if(|last| stmt.joined && matches!(last.op, Op::SetFeedRate(_)));
        if let Some(stated) = stated {
            (stmt.joined, stmt.number) = (stated.joined, stated.number.or(stmt.number));
        }
        if self.by_time.is_none() || self.mode_said {
            self.by_time = before.modes.feed_mode;
            self.mode_said = false;
            if target.caps.modes.feed_by_time {
                said.push(Op::SetFeedMode(FeedMode::InverseTime));
            }
        }
        self.feed = before.feed.or(self.feed);
        said.push(Op::SetFeedRate(time.into()));
        put_before(stmt, said, made);
    }

    /// The feed counts again what it counts in the source.
    fn back(&mut self, stmt: &mut Stmt, before: &Before, target: &Target, made: &mut Rebuild) {
        let Some(mode) = self.by_time.take() else { return };
        let mut said = Vec::new();
        if target.caps.modes.feed_by_time && !self.mode_said {
            said.push(Op::SetFeedMode(mode));
        }
        self.mode_said = false;
        let feed = before.feed.or(self.feed);
        if let Some(feed) = feed.filter(|_| !matches!(stmt.op, Op::ProgramEnd | Op::BeginAgain)) {
            said.push(Op::SetFeedRate(feed.into()));
        }
        put_before(stmt, said, made);
    }
}

/// Puts statements into the block of another, before it.
fn put_before(stmt: &mut Stmt, ops: Vec<Op>, made: &mut Rebuild) {
    for op in ops {
        let mut new = Stmt::new(stmt.span, op);
        (new.number, new.skip, new.joined) = (stmt.number.take(), stmt.skip, stmt.joined);
        stmt.joined = true;
        made.push(new);
    }
}

/// One over the minutes that a line takes in the source; `None` if every control takes the same.
fn line(to: &Point, at: &Tracker, target: &Target) -> Result<Option<Num>, FeedsLack> {
    let fact = Behaviour::RotaryFeed;
    let (own, there) = (target.source.get(fact), target.caps.behaviours.get(fact));
    let units = at.modes.units.ok_or(FeedsLack::RotaryUnitsUnknown)?;
    let unit = if units == Units::Inch { 25.4 } else { 1.0 };
    let simple = |value| value == LINEAR || value == DEGREES;
    // Rotary axes alone turn at degrees a minute, from wherever they are.
    if to.axes[..3].iter().all(Option::is_none) && simple(own) && simple(there) {
        return Ok(None);
    }
    let mut ways = [0.0; AXES];
    for (axis, word) in to.axes.iter().enumerate() {
        let Some(word) = word else { continue };
        let here = at.position[axis];
        // An increment needs no place.
        let way = match (here, at.resolve(word, here.or(Some(0))), is_increment(word, at)) {
            (Some(here), Some(end), _) => end - here,
            (None, Some(way), true) => way,
            _ => return Err(FeedsLack::RotaryStartUnknown),
        };
        ways[axis] = way as f64 / ONE as f64;
    }
    let length = |axes: &[f64]| axes.iter().copied().fold(0.0, f64::hypot);
    let (line, turn) = (length(&ways[..3]) / unit, length(&ways[3..]));
    if turn == 0.0 || line == 0.0 && simple(own) && simple(there) {
        return Ok(None);
    }
    if at.modes.feed_mode == Some(FeedMode::InverseTime) {
        // A time is the same whatever a feed counts.
        return Ok(None);
    }
    let way = match own {
        LINEAR if line > 0.0 => line,
        LINEAR => turn,
        DEGREES => line.hypot(turn),
        _ => return Err(FeedsLack::RotarySourceDiameter),
    };
    let per_minute = match at.modes.feed_mode {
        Some(FeedMode::PerMinute) => 1.0,
        _ => return Err(FeedsLack::RotaryNotPerMinute),
    };
    let feed = at.feed.and_then(|feed| feed.nanos(units == Units::Inch));
    let feed = feed.ok_or(FeedsLack::RotaryUnknown)?;
    let number = feed as f64 / ONE as f64 / unit * per_minute;
    if target.caps.modes.feed_by_time {
        return by_time(number / way, target).map(Some);
    }
    let own_way = match there {
        LINEAR if line > 0.0 => line,
        LINEAR => turn,
        DEGREES => line.hypot(turn),
        _ => return Err(FeedsLack::RotaryTargetDiameter),
    };
    let said = by_time(number / way * own_way, target)?;
    Ok(Some(Num { unit: if units == Units::Inch { Unit::Inch } else { Unit::Mm }, ..said }))
}

fn is_increment(word: &ncc_ir::program::Coord, at: &Tracker) -> bool {
    word.distance.known().or(at.modes.distance) == Some(ncc_ir::canon::Distance::Incremental)
}

/// F of a time in the target's digits, which must say it to half a per cent.
fn by_time(per_minute: f64, target: &Target) -> Result<Num, FeedsLack> {
    let nanos = (per_minute * ONE as f64).round() as Nanos;
    let num = Num::from_nanos(nanos, target.caps.modes.feed_decimals, Unit::One);
    let said = num.nanos(false).unwrap_or(0);
    let off = (said - nanos).abs();
    match said > 0 && off.saturating_mul(200) <= nanos {
        true => Ok(num),
        false => Err(FeedsLack::TimeDigits),
    }
}

/// Restates the inverse-time F of an arc, which stands before it in its block.
fn arc_by_time(arc: &Arc, at: &Tracker, target: &Target, made: &mut Rebuild) -> Result<(), FeedsLack> {
    let unknown = FeedsLack::ArcTimeStartUnknown;
    if !arc.turns.is_none() {
        return Err(FeedsLack::ArcTimeTurns);
    }
    let plane = at.plane(arc.plane).ok_or(unknown)?;
    let (first, second, _) = plane.axes();
    let end = at.target(&arc.to);
    let of = |place: &[Option<Nanos>]| Some([place[first as usize]?, place[second as usize]?]);
    let (Some(start), Some(end), Some(centre)) = (of(&at.position), of(&end), at.centre(arc)) else {
        return Err(unknown);
    };
    let angle = geometry::sweep_degrees(start, end, centre, arc.turn, 0).abs().to_radians();
    let radii = target.source.does(Behaviour::ArcByTime);
    let factor = if radii { 1.0 / angle } else { angle };
    let stated = made.block_mut().find_map(|stmt| match &mut stmt.op {
        Op::SetFeedRate(feed) => Some(feed),
        _ => None,
    });
    let feed = stated.ok_or(FeedsLack::ArcTimeOtherBlock)?;
    let number = feed.literal().and_then(|feed| feed.nanos(false)).ok_or(FeedsLack::ArcTimeComputed)?;
    let unit = feed.literal().map_or(Unit::One, |feed| feed.unit);
    let said = by_time(number as f64 / ONE as f64 * factor, target)?;
    *feed = Num { unit, ..said }.into();
    Ok(())
}
