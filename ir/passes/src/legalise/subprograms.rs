//! Legalises subprograms: keeps them, with the modes active in their callers, or inlines them.
//!
//! Inlined are only subprograms that belong to a cycle of a caller which the target writes differently, and those
//! that the target cannot write by themselves.

use crate::arcs::arc_form::ArcFormState;
use crate::arcs::compensated_modes::CompensatedModesState;
use crate::arcs::expand_corners::ExpandCornersState;
use crate::arcs::polar_words::PolarWordsState;
use crate::frames::expand_frames::ExpandFramesState;
use crate::frames::machine_moves::MachineMovesState;
use crate::holes::expand_cycles::ExpandCyclesState;
use crate::holes::sayable::sayable;
use crate::modes::feed_time::FeedTimeState;
use crate::modes::feed_unit::FeedUnitState;
use crate::modes::immediate_effects::ImmediateEffectsState;
use crate::modes::one_move::OneMoveState;
use crate::modes::path_control::PathControlState;
use crate::threads::in_step::ThreadsState;
use crate::threads::taps::TapsState;
use crate::tools::tool_axis::ToolAxisState;
use crate::tools::tool_change::ToolChangeState;
use crate::tools::tool_edge::ToolEdgeState;
use crate::tools::z_after_change::ZAfterChangeState;
use std::collections::{BTreeSet, HashSet};
use std::rc::Rc;

use super::*;
use crate::support::mode_analysis::has_bare_holes;
use crate::watch::unwatched;
use ncc_ir::canon::FeedMode;
use ncc_ir::lack::HolesLack;
use ncc_ir::program::Text;
use ncc_ir::program::kinds::flow;
use ncc_ir::program::valid::{ends_callers_cycle, leaves_a_cycle};

impl Legaliser {
    /// Brings a program that is kept whole within the target's capabilities: the rest of the main
    /// procedure, and all subprograms. Ends it, as [`Legaliser::finish`] does.
    pub fn run_program(&mut self, rest: &mut Program, diags: &mut Vec<Diagnostic>) {
        let assumed = rest.assumed;
        self.shared.walk.assume(&assumed);
        let frames =
            self.shared.lacks & FRAME != 0 && expand_frames::has_frames(rest, &self.shared.target.caps);
        // Where the frames can be stated, subprograms stay what they are.
        let apart = frames && !expand_frames::shifts_origin_in_calls(rest, &self.shared.target.caps);
        if apart && rest.procedures.len() > 1 && self.shared.lacks & CALL == 0 {
            let (mut own, mut program, mut found) = (self.clone(), rest.clone(), Vec::new());
            own.run_whole(&mut program, Subprograms::Keep, &mut found);
            let worked_in = |d: &Diagnostic| {
                d.fault.gravity() == Gravity::Error || matches!(d.fault, Fault::FramesExpanded)
            };
            if !found.iter().any(worked_in) {
                (*self, *rest) = (own, program);
                return diags.append(&mut found);
            }
        }
        if frames || self.repeats_in_the_way(rest) {
            self.on_program(ProgramMoment::Repetitions, rest, Subprograms::Keep, diags);
        }
        // A subprogram may lack what only its callers know: it is given that, or written out.
        let ways = [Subprograms::Keep, Subprograms::Specialise, Subprograms::Expand];
        let first = match self.shared.lacks & CALL != 0 || frames {
            true => 2,
            false if !self.calls_under_expanded(rest) => 0,
            false => {
                let mut own = rest.clone();
                let mut nothing = Vec::new();
                unwatched(|| {
                    self.on_program(ProgramMoment::Calls, &mut own, Subprograms::Specialise, &mut nothing)
                });
                if self.calls_under_expanded(&own) { 2 } else { 1 }
            }
        };
        if first == 2 && self.shared.lacks & CALL == 0 && !frames && self.write_out_some(rest, diags) {
            return;
        }
        if first == 2 {
            return self.run_whole(rest, Subprograms::Expand, diags);
        }
        if self.shared.lacks != 0 && rest.procedures.len() > 1 {
            for way in ways.into_iter().skip(first) {
                if way == Subprograms::Expand && self.write_out_some(rest, diags) {
                    return;
                }
                let (mut own, mut program, mut found) = (self.clone(), rest.clone(), Vec::new());
                own.run_whole(&mut program, way, &mut found);
                if !found.iter().any(|d| d.fault.gravity() == Gravity::Error) {
                    (*self, *rest) = (own, program);
                    return diags.append(&mut found);
                }
            }
        }
        self.run_whole(rest, ways[first], diags);
    }

    /// Subprograms get the modes active in their callers, and and only those are inlined that take a cycle from
    /// them, or cannot be stated. Tells whether that is done, and nothing else is left that cannot be stated.
    fn write_out_some(&mut self, rest: &mut Program, diags: &mut Vec<Diagnostic>) -> bool {
        let (mut given, mut reported) = (rest.clone(), Vec::new());
        self.on_program(ProgramMoment::Calls, &mut given, Subprograms::Specialise, &mut reported);
        let subs = given.procedures.iter().skip(1);
        let mut names: BTreeSet<Text> = match self.calls_under_expanded(&given) {
            true => subs.clone().filter(|sub| takes_cycle(&sub.body)).map(|sub| sub.name.clone()).collect(),
            false => BTreeSet::new(),
        };
        loop {
            let (mut own, mut program, mut found) = (self.clone(), given.clone(), reported.clone());
            own.on_program(ProgramMoment::Calls, &mut program, Subprograms::ExpandNamed(&names), &mut found);
            if program.procedures.len() < 2 || self.calls_under_expanded(&program) {
                return false;
            }
            own.run_whole(&mut program, Subprograms::Keep, &mut found);
            let refused = found.iter().filter(|d| d.fault.gravity() == Gravity::Error);
            let starts: HashSet<u32> = refused.map(|d| d.span.start).collect();
            if starts.is_empty() {
                let left: BTreeSet<Text> = program.procedures.iter().map(|p| p.name.clone()).collect();
                found.retain(|d| !matches!(&d.fault, Fault::NameChanged { to, .. } if !left.contains(to)));
                (*self, *rest) = (own, program);
                diags.append(&mut found);
                return true;
            }
            let known = names.len();
            let has = |sub: &&Procedure| sub.body.iter().any(|stmt| starts.contains(&stmt.span.start));
            names.extend(subs.clone().filter(has).map(|sub| sub.name.clone()));
            if names.len() == known {
                return false;
            }
        }
    }

    /// The same, with subprograms treated in one way.
    fn run_whole(&mut self, rest: &mut Program, way: Subprograms, diags: &mut Vec<Diagnostic>) {
        let assumed = rest.assumed;
        self.on_program(ProgramMoment::SubprogramRepetitions, rest, way, diags);
        self.on_program(ProgramMoment::Calls, rest, way, diags);
        self.refuse_cycles_left(rest, diags);
        self.on_program(ProgramMoment::Names, rest, way, diags);
        self.shared.entries = self.entries_of(rest).map(Rc::new);
        let mut procedures = rest.procedures.iter_mut();
        if let Some(main) = procedures.next() {
            self.run(&mut main.body, &assumed, None, diags);
            self.finish(&mut main.body, diags);
        }
        for procedure in procedures {
            self.shared.walk = Walk::new(Tracker::unknown());
            self.shared.states.forget::<ExpandCyclesState>();
            self.shared.states.forget::<TapsState>();
            self.shared.states.forget::<FeedUnitState>();
            self.shared.states.forget::<ThreadsState>();
            self.shared.states.state_mut::<ToolEdgeState>().start_over();
            self.shared.states.state_mut::<ToolAxisState>().start_over();
            self.shared.states.state_mut::<PathControlState>().start_over();
            self.shared.states.forget::<OneMoveState>();
            self.shared.states.forget::<PolarWordsState>();
            self.shared.states.forget::<ExpandCornersState>();
            self.shared.states.forget::<ArcFormState>();
            self.shared.states.state_mut::<ExpandFramesState>().start_over();
            self.shared.states.forget::<MachineMovesState>();
            self.shared.states.state_mut::<ToolChangeState>().start_over();
            self.shared.states.forget::<ImmediateEffectsState>();
            self.shared.states.state_mut::<ZAfterChangeState>().start_over();
            self.enter(procedure.body.first());
            self.run(&mut procedure.body, &Modes::default(), None, diags);
            self.shared.states.state_mut::<ToolChangeState>().start_over();
            self.finish(&mut procedure.body, diags);
            self.shared.states.state_mut::<ImmediateEffectsState>().end_of_sub(&procedure.body, diags);
        }
    }

    /// Refuses subprograms that leave an active cycle to their callers, where the target's cannot.
    pub(super) fn refuse_cycles_left(&self, program: &Program, diags: &mut Vec<Diagnostic>) {
        if !self.shared.target.caps.holes.end_with_call {
            return;
        }
        let left = program.procedures.iter().skip(1).filter_map(|sub| leaves_a_cycle(&sub.body));
        let fault = || Fault::lacks(HolesLack::LeftActive);
        diags.extend(left.map(|at| Diagnostic::new(fault(), at)));
        let fault = || Fault::lacks(HolesLack::EndsCallersCycle);
        diags.extend(ends_callers_cycle(program).into_iter().map(|at| Diagnostic::new(fault(), at)));
    }

    /// What holds after each call and label, where a pass asks for it.
    pub(super) fn entries_of(&self, program: &Program) -> Option<mode_analysis::Known> {
        let has = |wanted| program.procedures.iter().any(|procedure| has(&procedure.body, wanted));
        let units = self.shared.feed_again && has(|op| matches!(op, Op::UseLengthUnits(_)));
        let starts = || has(|op| matches!(op, Op::StartCutterRadiusCompensation { .. }));
        let compensated = self.shared.states.ask(CompensatedModesState::clone);
        let beside = compensated.refused.any() && (compensated.on || starts());
        let by_time = self.shared.times_differ && has(|op| *op == Op::SetFeedMode(FeedMode::InverseTime));
        if !(units || beside || by_time) || !has(|op| matches!(op, flow!())) {
            return None;
        }
        let mut entry = match self.shared.follow {
            true => self.shared.walk.at.clone(),
            false => Tracker::unknown(),
        };
        entry.compensated = compensated.on;
        mode_analysis::starts(program, &entry, compensated.path())
    }

    /// Control comes from elsewhere to a body, or to what follows control.
    pub(super) fn enter(&mut self, first: Option<&Stmt>) {
        let entries = self.shared.entries.clone();
        let at = first.and_then(|first| entries.as_ref()?.before(first));
        let path = first.and_then(|first| entries.as_ref()?.path_before(first));
        let unknown = Tracker { compensated: self.shared.walk.at.compensated, ..Tracker::unknown() };
        self.shared.states.state_mut::<CompensatedModesState>().enter(at.unwrap_or(&unknown), path);
        self.shared.states.state_mut::<FeedUnitState>().enter();
        self.shared.states.state_mut::<FeedTimeState>().enter();
    }

    /// Whether blocks that are executed again may belong to a cycle that is expanded, or lack what
    /// is known only where they are inlined.
    fn repeats_in_the_way(&self, program: &Program) -> bool {
        if self.shared.lacks == 0
            || !self.shared.target.caps.flow.repeat_blocks
            || !expand_repeats::repeats_blocks(program)
        {
            return false;
        }
        let caps = &self.shared.target.caps;
        let moved = |p: &Procedure| {
            caps.arcs.centres_from_zero && repeat_ends::moves_arcs(&p.body)
                || (!caps.flow.repeat_by_numbers || repeat_ends::changes_cycle(&p.body))
                    && repeat_ends::under_another_cycle(&p.body)
                || !caps.flow.repeat_by_numbers && repeat_ends::is_one_block_of_several(&p.body)
        };
        if program.procedures.iter().any(moved) {
            return true;
        }
        let (mut own, mut trial, mut found) = (self.clone(), program.clone(), Vec::new());
        let way = if self.shared.lacks & CALL != 0 { Subprograms::Expand } else { Subprograms::Keep };
        own.run_whole(&mut trial, way, &mut found);
        let written_out = |d: &Diagnostic| {
            matches!(d.fault, Fault::CycleExpanded { .. }) || d.fault.gravity() == Gravity::Error
        };
        found.iter().any(written_out)
    }

    /// Whether positions in a subprogram may belong to a cycle that the target cannot say.
    fn calls_under_expanded(&self, program: &Program) -> bool {
        if self.shared.lacks & CYCLE == 0
            || !program.procedures.iter().skip(1).any(|sub| takes_cycle(&sub.body))
        {
            return false;
        }
        let walk = Walk::default();
        let planes = self.shared.target.caps.holes.returns;
        let bodies = || program.procedures.iter().enumerate();
        let stands =
            |at: usize| if at == 0 { self.shared.walk.clone() } else { Walk::new(Tracker::unknown()) };
        bodies().flat_map(|(at, p)| p.body.iter().map(move |s| (at, s))).any(|(at, stmt)| match &stmt.op {
            Op::StartCycle(cycle) if !planes.says(cycle.return_plane.is_some()) => {
                let body = program.procedures.get(at).map_or(&[][..], |p| &p.body);
                !return_plane::converts_all(body, &stands(at), &self.shared.target)
            }
            Op::StartCycle(cycle) => {
                let other = self.shared.target.caps.holes.approach.is_some_and(|a| a != cycle.approach);
                let mut nothing = Vec::new();
                let says = sayable(&walk, cycle, &self.shared.target, stmt.span, &mut nothing);
                other || !says || !nothing.is_empty()
            }
            _ => false,
        })
    }
}

/// Whether a body makes holes under a cycle of its caller, or leaves its own to it.
fn takes_cycle(body: &[Stmt]) -> bool {
    let calls = body.iter().filter_map(|stmt| match stmt.op {
        Op::StartCycle(_) => Some(true),
        Op::EndCycle => Some(false),
        _ => None,
    });
    let mut calls = calls.peekable();
    has_bare_holes(body) || calls.peek() == Some(&false) || calls.last() == Some(true)
}

/// Whether an operation stands in a body, or in one of a structure in it.
fn has(body: &[Stmt], wanted: fn(&Op) -> bool) -> bool {
    body.iter().any(|stmt| match &stmt.op {
        Op::Control(control) => control.bodies().any(|body| has(body, wanted)) || wanted(&stmt.op),
        op => wanted(op),
    })
}
