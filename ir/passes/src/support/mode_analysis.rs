//! Must-analysis: writes into each statement the facts that hold on every path to it, through loops, branches, jumps and calls.
//!
//! Paths merge at the head of a loop (before it, after each iteration), at a label (every jump to it) and at the start
//! of a subprogram (every call). The analysis runs to a fixed point. Positions whose effect only a caller knows stay as
//! they are. The facts at the start of each stretch of blocks are kept for later passes. Where one cycle is active at a
//! hole in a loop or after a label, the hole activates it again, since a target may leave none active after a jump. A
//! cycle call that served only such holes is left out.
//!
//! Not here: values of variables.

use std::collections::HashMap;

use self::called::Called;
use self::called_up::call_up_all;
use self::flow::{Flow, MOST_ROUNDS};
use self::held::Held;
use ncc_ir::canon::Modes;
use ncc_ir::computed::computes::Computes;
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Attribute, Op, PathControl, Program, Stmt};
use ncc_ir::track::Tracker;

mod active_cycles;
mod called;
mod called_up;
mod flow;
mod held;

pub use self::active_cycles::ActiveCycles;
pub use self::called_up::has_bare_holes;
pub(crate) use self::flow::At;

/// What holds where stretches of blocks without control begin, by their places in the source.
#[derive(Clone, Debug, Default)]
pub struct Known {
    starts: HashMap<u32, Tracker>,
    /// How corners are taken there, if that is known.
    paths: HashMap<u32, Option<Box<PathControl>>>,
    /// Cycles active at holes, by their places, that are as they were activated on every path there.
    cycles: HashMap<u32, Option<Called>>,
}

impl Known {
    /// What holds where a stretch begins with a statement.
    pub(crate) fn before(&self, stmt: &Stmt) -> Option<&Tracker> {
        self.starts.get(&stmt.span.start)
    }

    /// Puts units, feed and motion into a walk that reaches a statement from elsewhere.
    pub(crate) fn feeds(&self, stmt: &Stmt, walk: &mut Tracker) {
        let Some(at) = self.before(stmt) else { return };
        (walk.modes.units, walk.modes.feed_mode) = (at.modes.units, at.modes.feed_mode);
        (walk.fed, walk.feed, walk.modes.motion) = (at.fed, at.feed, at.modes.motion);
    }

    /// How corners are taken where a stretch begins with a statement, if it is known.
    pub(crate) fn path_before(&self, stmt: &Stmt) -> Option<&PathControl> {
        self.paths.get(&stmt.span.start)?.as_deref()
    }

    /// The active modes where stretches begin, by the places of their first statements.
    pub fn modes(&self) -> HashMap<u32, Modes> {
        self.starts.iter().map(|(at, known)| (*at, known.modes)).collect()
    }
}

/// Has holes that the text itself puts under a cycle of another stretch activate it. What is `known` is of a copy of
/// the program with its facts put in.
pub(crate) fn holes(program: &mut Program, known: &Known) {
    call_up_all(program, &known.cycles, false);
}

/// Leaves such holes to what is active, for a target that keeps it in loops as the source does. Tells whether there
/// are any.
pub(crate) fn positions(body: &mut [Stmt]) -> bool {
    let (mut called, mut any) = (false, false);
    for stmt in body {
        called &= !matches!(stmt.op, flow!());
        match &mut stmt.op {
            Op::StartCycle(_) => called = true,
            Op::Hole(to) if !called => {
                any = true;
                stmt.op = Op::Position(std::mem::take(to));
            }
            Op::Control(control) => {
                any = control.bodies_mut().map(|body| positions(body)).fold(any, std::ops::BitOr::bitor);
            }
            _ => {}
        }
    }
    any
}

/// Puts known facts in. `entry` is what holds where the program begins. With `holes`, those that the text itself
/// puts under a cycle are made to activate it too.
pub fn run(program: &mut Program, entry: &Tracker, holes: bool) -> Known {
    let mut flow = Flow::new(program, Held { at: entry.clone(), ..Held::default() });
    flow.holes = holes;
    for _ in 0..MOST_ROUNDS {
        flow.changed = false;
        flow.visit_program(program);
        if !flow.changed {
            flow.settles = true;
            flow.visit_program(program);
            call_up_all(program, &flow.cycles, true);
            return Known { starts: flow.starts, paths: flow.paths, cycles: flow.cycles };
        }
    }
    Known::default()
}

/// Puts modes back that are known where their codes were saved, and answers what a target of these capabilities cannot be
/// asked for and is known; nothing else. `entry` is what holds where the program begins.
pub fn put_back(program: &mut Program, entry: &Tracker, target: &Computes) {
    let mut flow = Flow::new(program, Held { at: entry.clone(), ..Held::default() });
    flow.target = Some(target);
    flow.until_settled(program);
}

/// What holds where stretches begin; the program stays as it is. `entry` is what holds where the program begins, and
/// `path` how corners are taken there.
pub(crate) fn starts(program: &Program, entry: &Tracker, path: Option<&PathControl>) -> Option<Known> {
    let mut program = program.clone();
    let path = path.cloned().map(Box::new);
    let mut flow = Flow::new(&program, Held { at: entry.clone(), path, ..Held::default() });
    flow.until_settled(&mut program).then_some(Known {
        starts: flow.starts,
        paths: flow.paths,
        cycles: flow.cycles,
    })
}

/// What holds at each call that a way leads to, by its place, where subprograms restore the modes that they state;
/// `None` if that is not found. `entry` is what holds where the program begins.
pub(crate) fn at_calls(program: &Program, entry: &Tracker) -> Option<HashMap<u32, At>> {
    let mut program = program.clone();
    let gives = program.procedures.iter().map(|p| p.attributes.contains(&Attribute::GivesBack)).collect();
    let mut flow = Flow::new(&program, Held { at: entry.clone(), ..Held::default() });
    flow.gives = gives;
    flow.until_settled(&mut program).then_some(flow.calls)
}
