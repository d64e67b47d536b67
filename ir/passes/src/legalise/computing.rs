//! Programs that compute, brought within a target's capabilities.
//!
//! Between two statements of control the blocks follow one another as in any program, and are brought within the
//! target's capabilities by the same passes; after each nothing is known. What a pass would have to change that is
//! computed, or that other blocks rely on in a way that only execution knows, is refused at its place.

use crate::arcs::compensated_modes::CompensatedModesState;
use crate::arcs::still_blocks::StillBlocksState;
use crate::frames::expand_frames::ExpandFramesState;
use crate::frames::frame_increments::FrameIncrementsState;
use crate::frames::origin_shift::OriginShiftState;
use crate::modes::immediate_effects::ImmediateEffectsState;
use crate::threads::taps::TapsState;
use crate::tools::z_after_change::ZAfterChangeState;
use std::rc::Rc;

use crate::frames::machine_cuts;
use crate::legalise::{Legaliser, Target};
use crate::modes::feed_unit;
use crate::pass::{KeptProgram, ProgramMoment, Shared, Subprograms};
use crate::support::mode_analysis::{self, Known};
use ncc_ir::canon::Modes;
use ncc_ir::diag::{Diagnostic, Fault, Gravity};
use ncc_ir::lack::ThreadsLack;
use ncc_ir::program::arguments;
use ncc_ir::program::cycle::{Cycle, CycleKind};
use ncc_ir::program::kinds::{drilling, flow};
use ncc_ir::program::{Coord, Op, Pitch, Point, Program, Stmt};
use ncc_ir::run_time::RunTimeWord;
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

impl Legaliser {
    /// What holds after what has come so far.
    pub fn entry(&self) -> &Tracker {
        &self.shared.walk.at
    }

    /// Brings a program that computes within the target's capabilities, its structure kept.
    /// `known` is what holds where stretches of its blocks begin.
    pub fn run_computing(&mut self, program: &mut Program, known: &Known, diags: &mut Vec<Diagnostic>) {
        self.on_computing(ProgramMoment::Names, program, known, diags);
        let mut found = Vec::new();
        let mut bare = program.clone();
        let any = bare
            .procedures
            .iter_mut()
            .map(|p| mode_analysis::positions(&mut p.body))
            .fold(false, |a, b| a | b);
        if any && self.shared.target.caps.flow.computes.as_ref().is_some_and(|target| !target.restates) {
            self.stretches(&mut bare, known, &mut found);
            if found.iter().all(|d| d.fault.gravity() != Gravity::Error) {
                *program = bare;
                return diags.append(&mut found);
            }
            mode_analysis::holes(program, known);
        }
        self.stretches(program, known, diags);
    }

    /// Runs the passes of a moment on a program that computes. Tells whether one of them refused it.
    fn on_computing(
        &mut self,
        moment: ProgramMoment,
        program: &mut Program,
        known: &Known,
        diags: &mut Vec<Diagnostic>,
    ) -> bool {
        let subprograms = Subprograms::Keep;
        let mut kept = KeptProgram { program, subprograms, known: Some(known), diags, refused: false };
        self.on_kept(moment, &mut kept);
        kept.refused
    }

    fn stretches(&mut self, program: &mut Program, known: &Known, diags: &mut Vec<Diagnostic>) {
        let assumed = program.assumed;
        // What the target says of a program's flow has been looked at before.
        let mut fresh = self.clone();
        fresh.shared.lacks &= !(crate::legalise::CONTROL | crate::legalise::CALL);
        if fresh.on_computing(ProgramMoment::Frames, program, known, diags) {
            return;
        }
        fresh.shared.entries = fresh.entries_of(program).map(Rc::new);
        let mut first = fresh.clone();
        first.shared.entries = None;
        let bare = program.procedures.iter().any(|procedure| mode_analysis::has_bare_holes(&procedure.body));
        let levels = program.procedures.iter().all(|procedure| levels_with_cycles(&procedure.body, bare));
        for (at, procedure) in program.procedures.iter_mut().enumerate() {
            let start = match at {
                0 => Some((first.clone(), assumed)),
                _ => None,
            };
            let inherits = has_positions(&procedure.body);
            let mut region = Region {
                fresh: &fresh,
                known,
                inherits,
                levels,
                diags,
                shift: *self.shared.states.state_mut(),
            };
            region.body(&mut procedure.body, start);
            self.shared.states.put(region.shift);
        }
    }

    /// The feed that has to be stated again before a statement of control.
    fn feed_before(&mut self, control: &Stmt, behind: &[Stmt]) -> Option<Result<Stmt, Diagnostic>> {
        let Shared { states, walk, target, .. } = &mut self.shared;
        feed_unit::before_control(states.state_mut(), &walk.at, target, control, behind)
    }

    /// The same legaliser where nothing is known of what was before but this.
    fn anew(&self, known: Option<Tracker>, first: Option<&Stmt>) -> Legaliser {
        let Target { caps, decimals, peck_clearance, .. } = &self.shared.target;
        let mut own = Legaliser::new(caps, *decimals, *peck_clearance);
        own.shared.target.clone_from(&self.shared.target);
        (own.shared.lacks, own.shared.measures, own.shared.follow) =
            (self.shared.lacks, self.shared.measures, self.shared.follow);
        (own.shared.source_arcs, own.shared.feed_again, own.shared.times_differ) =
            (self.shared.source_arcs, self.shared.feed_again, self.shared.times_differ);
        own.shared.walk = crate::legalise::Walk::new(known.unwrap_or_else(Tracker::unknown));
        own.shared.walk.at.z_lost_at_change = self.shared.walk.at.z_lost_at_change;
        own.shared.states.state_mut::<CompensatedModesState>().refused =
            self.shared.states.ask(|here: &CompensatedModesState| here.refused);
        own.shared.entries.clone_from(&self.shared.entries);
        own.shared.states.put(self.shared.states.ask(StillBlocksState::clone));
        own.enter(first);
        own.shared.states.put(TapsState::entered(&own.shared.walk.at));
        own.shared.states.forget::<ImmediateEffectsState>();
        own.shared.states.put(self.shared.states.ask(FrameIncrementsState::clone));
        own.shared.states.put(self.shared.states.ask(ZAfterChangeState::clone));
        own.shared.states.state_mut::<ZAfterChangeState>().start_over();
        own
    }
}

/// Whether positions rely on a cycle, or a motion, that is active where control comes from.
fn has_positions(body: &[Stmt]) -> bool {
    body.iter().any(|stmt| match &stmt.op {
        Op::Position(_) => true,
        Op::Control(control) => control.bodies().any(|body| has_positions(body)),
        _ => false,
    })
}

/// Whether where cycles leave the tool is stated nowhere but for cycles that are activated after it, before any hole.
/// With `bare`, holes stand under cycles that other stretches have activated.
fn levels_with_cycles(body: &[Stmt], bare: bool) -> bool {
    let mut blocks = body.iter().enumerate().filter(|(_, stmt)| matches!(stmt.op, Op::SetReturnLevel(_)));
    let with = blocks.all(|(at, _)| {
        let rest = body[at + 1..].iter().take_while(|stmt| !matches!(stmt.op, flow!()));
        let mut same = rest.clone().take_while(|stmt| stmt.joined);
        let next = rest.into_iter().find(|stmt| matches!(stmt.op, drilling!() | Op::Position(_)));
        same.any(|stmt| matches!(stmt.op, Op::StartCycle(_)))
            || !bare && next.is_none_or(|next| matches!(next.op, Op::StartCycle(_)))
    });
    with && body.iter().all(|stmt| match &stmt.op {
        Op::Control(control) => control.bodies().all(|body| levels_with_cycles(body, bare)),
        _ => true,
    })
}

/// The same statement. A hole may be expanded with the same computed words, on the way over it. A cycle may go to its
/// holes by the target's approach, where both approaches were found to be one, and may state a parameter's value; with `levels`,
/// it may say its return plane, which no position changes, or the level that this plane is.
fn as_before(was: &Op, is: &Op, levels: bool) -> bool {
    let (was, is) = match (was, is) {
        (Op::StartCycle(was), Op::StartCycle(is)) => (was, is),
        (Op::Hole(was), Op::StraightTraverse(is)) => {
            return computed_words(&was.to).eq(computed_words(&is.to));
        }
        (was, is) => return was == is,
    };
    let mut same = driven_as(was, is, levels);
    if levels && was.return_plane.is_some() != is.return_plane.is_some() {
        same.return_plane.clone_from(&is.return_plane);
        same.return_level = is.return_level;
    }
    same.kind.state_clearance(&is.kind);
    same == **is
}

/// A cycle with the other's approach to its holes, and, with `levels`, with a tap driven as there: the same thread, said by
/// a feed or a pitch, after which the spindle turns as the cycle leaves it or as the next block says.
fn driven_as(was: &Cycle, is: &Cycle, levels: bool) -> Cycle {
    let mut same = Cycle { approach: is.approach, ..was.clone() };
    if let (CycleKind::Tap(tap), CycleKind::Tap(other)) = (&mut same.kind, &is.kind)
        && levels
        && [&tap.pitch, &other.pitch].into_iter().all(is_written)
        && [&was.feed, &is.feed].into_iter().flatten().all(|feed| feed.literal().is_some())
    {
        (tap.pitch, tap.after) = (other.pitch.clone(), other.after);
        same.feed.clone_from(&is.feed);
    }
    same
}

fn is_written(pitch: &Pitch) -> bool {
    match pitch {
        Pitch::Stated(pitch) => pitch.literal().is_some(),
        Pitch::Feed => true,
    }
}

/// Whether a statement is of a cycle of which holes are expanded: it moves by computed words that are all the
/// cycle's, says its feed, or, with `levels`, activates it for a hole of which the rest is expanded, or for those
/// after it.
fn is_of(cycle: &Cycle, op: &Op, levels: bool) -> bool {
    let to = match op {
        Op::StraightTraverse(to) | Op::StraightFeed(to) => &to.to,
        Op::SynchronisedFeed(thread) => &thread.to,
        Op::SetFeedRate(feed) => return cycle.feed.as_ref() == Some(feed),
        Op::StartCycle(is) if levels => {
            let same = Cycle {
                reference: is.reference.clone(),
                return_plane: None,
                return_level: is.return_level,
                ..driven_as(cycle, is, levels)
            };
            return same == **is;
        }
        _ => return false,
    };
    let planes = || [&cycle.retract, &cycle.depth].into_iter().chain(&cycle.return_plane);
    let mut words = computed_words(to).peekable();
    words.peek().is_some() && words.all(|(_, word)| planes().any(|plane| plane.value == word.value))
}

/// The words of a move that are computed.
fn computed_words(words: &Point) -> impl Iterator<Item = (usize, &Coord)> {
    let words = words.axes.iter().enumerate();
    words.filter_map(|(axis, word)| Some((axis, word.as_ref().filter(|w| w.value.literal().is_none())?)))
}

/// What is not known of a program that computes, and would be if it were executed, is reported as that.
fn only_the_run_knows(found: &mut Diagnostic) {
    let what = match &found.fault {
        Fault::PositionUnknown { axis } => RunTimeWord::PositionUnknown { axis: *axis },
        Fault::EntryFactNeeded { .. } => RunTimeWord::ModeUnknown,
        _ => return,
    };
    found.fault = Fault::computes(what);
}

/// Statements with what is computed of cuts in machine coordinates alone taken back.
fn without_offsets(stmts: &[Stmt]) -> Vec<Stmt> {
    let plain = |stmt: &Stmt| Stmt { op: machine_cuts::without_offsets(&stmt.op), ..stmt.clone() };
    stmts.iter().map(plain).collect()
}

struct Region<'l> {
    fresh: &'l Legaliser,
    known: &'l Known,
    inherits: bool,
    /// Whether a cycle's return plane is one for all its positions.
    levels: bool,
    diags: &'l mut Vec<Diagnostic>,
    /// What has been assumed of the origin's shift.
    shift: OriginShiftState,
}

impl Region<'_> {
    /// A body: stretches of blocks, and between them control.
    fn body(&mut self, body: &mut Vec<Stmt>, mut start: Option<(Legaliser, Modes)>) {
        let mut out = Vec::with_capacity(body.len());
        let mut stretch = Vec::new();
        let mut rest = std::mem::take(body).into_iter();
        while let Some(mut stmt) = rest.next() {
            if !matches!(stmt.op, flow!()) {
                stretch.push(stmt);
                continue;
            }
            self.stretch(&mut stretch, start.take(), Some((&stmt, rest.as_slice())), &mut out);
            if let Op::Control(control) = &mut stmt.op {
                control.bodies_mut().for_each(|body| self.body(body, None));
            }
            out.push(stmt);
        }
        self.stretch(&mut stretch, start.take(), None, &mut out);
        *body = out;
    }

    /// Blocks without control; `next` is the statement of control after them, and the rest of the body.
    fn stretch(
        &mut self,
        stmts: &mut Vec<Stmt>,
        start: Option<(Legaliser, Modes)>,
        next: Option<(&Stmt, &[Stmt])>,
        out: &mut Vec<Stmt>,
    ) {
        if stmts.is_empty() {
            return;
        }
        let known = stmts.first().and_then(|first| self.known.before(first));
        let (mut own, assumed) =
            start.unwrap_or_else(|| (self.fresh.anew(known.cloned(), stmts.first()), Modes::default()));
        let before = stmts.clone();
        let mut found = Vec::new();
        own.shared.states.put(self.shift);
        own.run(stmts, &assumed, None, &mut found);
        let again = next.and_then(|(control, behind)| own.feed_before(control, behind));
        match again {
            Some(Ok(feed)) => stmts.push(feed),
            Some(Err(refusal)) => found.push(refusal),
            None => {}
        }
        self.shift = *own.shared.states.state_mut();
        if own.shared.states.ask(ExpandFramesState::is_worked_in)
            && let Some(last) = before.last().filter(|last| last.op != Op::ProgramEnd)
        {
            found.push(Diagnostic::new(Fault::computes(RunTimeWord::FrameExpanded), last.span));
        }
        if own.shared.states.ask(TapsState::has_lost_feed)
            && let Some(last) = before.last()
        {
            found.push(Diagnostic::new(Fault::lacks(ThreadsLack::FeedReplaced), last.span));
        }
        own.finish(stmts, &mut found);
        // It may stand in the block of what came before it.
        if let (Some(first), Some(was)) = (stmts.first_mut(), before.first()) {
            first.joined = was.joined;
        }
        let refused = found.iter().any(|d| d.fault.gravity() == Gravity::Error);
        found.iter_mut().for_each(only_the_run_knows);
        self.diags.append(&mut found);
        if !refused && let Some(at) = self.relied_on(&before, stmts) {
            self.diags.push(Diagnostic::new(Fault::computes(RunTimeWord::BlocksRewritten), at));
        }
        out.append(stmts);
    }

    /// The place of a statement that a pass has changed though it is computed, or others rely on it.
    fn relied_on(&self, before: &[Stmt], after: &[Stmt]) -> Option<Span> {
        // A cut that is stated in a work offset is the same, less the offsets.
        let (before, after) = [before, after].map(without_offsets).into();
        let relies = |stmt: &&Stmt| {
            let cycle = matches!(stmt.op, drilling!() | Op::EndCycle | Op::Position(_));
            // How corners are taken may be stated with less, which is reported; nothing relies on it.
            let corners = matches!(stmt.op, Op::SetMotionControlMode(_));
            arguments::computed(&stmt.op) && !corners
                || matches!(stmt.op, Op::Assign(..))
                || self.inherits && cycle
        };
        let mut was = before.iter().filter(relies).peekable();
        let mut is = after.iter().filter(relies).peekable();
        // The cycle of which holes are written out.
        let mut out: Option<&Cycle> = None;
        loop {
            match (was.peek(), is.peek()) {
                (_, Some(b)) if out.is_some_and(|cycle| is_of(cycle, &b.op, self.levels)) => _ = is.next(),
                (Some(a), Some(b)) if as_before(&a.op, &b.op, self.levels) && a.skip == b.skip => {
                    out = out.filter(|_| !matches!(b.op, Op::StartCycle(_)));
                    was.next();
                    is.next();
                }
                (Some(a), _) if !self.inherits && a.skip.is_none() && out.is_none() => {
                    let Op::StartCycle(cycle) = &a.op else { return Some(a.span) };
                    out = Some(cycle);
                    was.next();
                }
                (None, None) => return None,
                (a, b) => return a.or(b).map(|stmt| stmt.span),
            }
        }
    }
}
