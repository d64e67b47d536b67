//! Facts that hold on every way to a statement are put into it: through loops, decisions, jumps and calls.
//!
//! What is in force at the head of a loop is what is so before it and behind each turn; at a label, where every jump
//! to it comes from; in a subprogram, at every call. Found by going through the program until nothing changes. What
//! positions do that only a caller knows stays as it is. What holds where a stretch of blocks begins is kept for those
//! who go on from there. A position in a loop or behind a label at which one cycle is in force, as it was called up,
//! calls it up by itself: where control goes, a target may leave none in force.
//!
//! Not here: values of variables.

use std::collections::{BTreeMap, HashMap};

use super::expand_calls::{settle, settle_point};
use crate::arguments;
use crate::canon::Motion;
use crate::cycle::Cycle;
use crate::expr::Target;
use crate::kinds::flow;
use crate::program::{Control, Op, Program, Stmt, Text};
use crate::track::Tracker;

/// Most times that a program is gone through; one that needs more keeps what it says.
const MOST_ROUNDS: u32 = 24;

/// What holds where stretches of blocks without control begin, by their places in the source.
#[derive(Clone, Debug, Default)]
pub struct Known {
    starts: HashMap<u32, Tracker>,
}

impl Known {
    /// What holds where a stretch begins with a statement.
    pub(super) fn before(&self, stmt: &Stmt) -> Option<&Tracker> {
        self.starts.get(&stmt.span.start)
    }
}

/// Puts known facts in. `entry` is what holds where the program begins.
pub fn run(program: &mut Program, entry: &Tracker) -> Known {
    let names = program.procedures.iter().map(|p| p.name.clone()).collect();
    let mut flow = Flow { names, ..Flow::default() };
    flow.ways = vec![Ways::default(); program.procedures.len()];
    if let Some(main) = flow.ways.first_mut() {
        main.entry = Some(Held { at: entry.clone(), as_called: false });
    }
    for _ in 0..MOST_ROUNDS {
        flow.changed = false;
        flow.over(program);
        if !flow.changed {
            flow.settles = true;
            flow.over(program);
            let cycles = flow.cycles;
            program.procedures.iter_mut().for_each(|procedure| call_up(&mut procedure.body, &cycles));
            return Known { starts: flow.starts };
        }
    }
    Known::default()
}

/// What holds at a place.
#[derive(Clone, Debug, Default, PartialEq)]
struct Held {
    at: Tracker,
    /// Whether the cycle in force is as its block has called it up: the same words would call up the same.
    as_called: bool,
}

impl Held {
    fn join(&mut self, other: &Held) {
        self.at.join(&other.at);
        self.as_called &= other.as_called;
    }

    /// The cycle in force, if it is known and as it was called up.
    fn cycle(&self) -> Option<&Cycle> {
        let sure = self.as_called && !self.at.cycle_in_doubt && self.at.modes.motion == Some(Motion::Cycle);
        self.at.cycle.as_ref().filter(|_| sure).map(|in_force| &in_force.cycle)
    }

    /// A variable gets another value.
    fn sets(&mut self, to: &Target) {
        let Some(in_force) = &self.at.cycle else { return };
        let mut found = false;
        arguments::each(&mut Op::StartCycle(Box::new(in_force.cycle.clone())), &mut |argument, _| {
            found |= argument.expr().is_some_and(|expr| expr.reads(to));
            Ok::<(), std::convert::Infallible>(())
        })
        .unwrap_or_else(|never| match never {});
        self.as_called &= !found;
    }

    fn apply(&mut self, op: &Op) {
        if let Op::Assign(to, _) = op {
            self.sets(to);
        } else if matches!(op, Op::StartCycle(_)) {
            self.as_called = true;
        } else if !matches!(
            op,
            Op::Hole(_)
                | Op::Position(_)
                | Op::Pattern(_)
                | Op::SetDistanceMode(_)
                | Op::Comment(_)
                | Op::NoEffect(_)
                | Op::Blank
                | Op::Message(_)
                | Op::MessageOf(_)
                | Op::FloodOn
                | Op::MistOn
                | Op::CoolantOff
                | Op::Declare(_)
        ) {
            self.as_called = false;
        }
        self.at.apply(op);
    }
}

/// Positions at which a cycle is in force call it up by themselves.
fn call_up(body: &mut Vec<Stmt>, cycles: &HashMap<u32, Option<Cycle>>) {
    let mut out = Vec::with_capacity(body.len());
    for mut stmt in std::mem::take(body) {
        if let Op::Control(control) = &mut stmt.op {
            control.bodies_mut().for_each(|body| call_up(body, cycles));
        }
        match (&stmt.op, cycles.get(&stmt.span.start)) {
            (Op::Position(to), Some(Some(cycle))) => {
                let hole = Op::Hole(to.clone());
                let cycle = Op::StartCycle(Box::new(cycle.clone()));
                let hole = Stmt { op: hole, joined: true, number: None, ..stmt.clone() };
                out.push(Stmt { op: cycle, comment: None, ..stmt });
                out.push(hole);
            }
            _ => out.push(stmt),
        }
    }
    *body = out;
}

/// Ways into and out of a procedure.
#[derive(Clone, Default)]
struct Ways {
    entry: Option<Held>,
    exit: Option<Held>,
    labels: BTreeMap<Text, Held>,
}

#[derive(Default)]
struct Flow {
    names: Vec<Text>,
    ways: Vec<Ways>,
    /// The procedure at hand.
    at: usize,
    /// Loops that are open: what holds where they are left, and where their next turn begins.
    left: Vec<Option<Held>>,
    next: Vec<Option<Held>>,
    changed: bool,
    settles: bool,
    starts: HashMap<u32, Tracker>,
    /// Cycles in force at positions, by their places, that are as they were called up on every way there.
    cycles: HashMap<u32, Option<Cycle>>,
    /// What the text has said so far, for blocks to which no way leads: they are written as they stand there.
    text: Held,
}

/// What holds where another way comes in; whether that is less than before.
fn meet(state: &mut Option<Held>, other: Option<&Held>) -> bool {
    let Some(other) = other else { return false };
    match state {
        None => {
            *state = Some(other.clone());
            true
        }
        Some(known) => {
            let before = known.clone();
            known.join(other);
            *known != before
        }
    }
}

impl Flow {
    fn over(&mut self, program: &mut Program) {
        for (at, procedure) in program.procedures.iter_mut().enumerate() {
            self.at = at;
            let entry = self.ways[at].entry.clone();
            let end = self.body(&mut procedure.body, entry);
            self.changed |= meet(&mut self.ways[at].exit, end.as_ref());
        }
    }

    fn body(&mut self, body: &mut [Stmt], mut state: Option<Held>) -> Option<Held> {
        let mut begins = true;
        for stmt in body {
            let before = state.clone();
            let flow = matches!(stmt.op, flow!());
            if let (true, false, true) = (begins, flow, self.settles) {
                let known = state.as_ref().unwrap_or(&self.text);
                // Statements that were made of one have its place.
                self.starts
                    .entry(stmt.span.start)
                    .and_modify(|at| at.join(&known.at))
                    .or_insert_with(|| known.at.clone());
            }
            begins = flow;
            state = self.stmt(stmt, state);
            if stmt.skip.is_some() {
                meet(&mut state, before.as_ref());
            }
        }
        state
    }

    fn stmt(&mut self, stmt: &mut Stmt, state: Option<Held>) -> Option<Held> {
        match &mut stmt.op {
            Op::Label(name) => {
                let mut state = state;
                meet(&mut state, self.ways[self.at].labels.get(name));
                state
            }
            Op::Goto(name) => {
                if let Some(state) = &state {
                    let mut there = self.ways[self.at].labels.remove(name);
                    self.changed |= meet(&mut there, Some(state));
                    self.ways[self.at].labels.extend(there.map(|there| (name.clone(), there)));
                }
                None
            }
            Op::Leave => {
                self.left.last_mut().map(|left| meet(left, state.as_ref()));
                None
            }
            Op::NextTurn => {
                self.next.last_mut().map(|next| meet(next, state.as_ref()));
                None
            }
            Op::Return => {
                let at = self.at;
                self.changed |= meet(&mut self.ways[at].exit, state.as_ref());
                None
            }
            Op::ProgramEnd | Op::Alarm(_) => None,
            Op::Call(call) => {
                let found = self.names.iter().skip(1).position(|name| *name == call.name)?;
                let called = &mut self.ways[found + 1];
                // A cycle in force is its caller's, which says it once.
                let entered = state.clone().map(|held| Held { as_called: false, ..held });
                self.changed |= meet(&mut called.entry, entered.as_ref());
                // Where it leads is known after it has been gone through.
                state.and(called.exit.clone())
            }
            Op::RepeatBlocks(_) => state.map(|mut state| {
                state.at.forget();
                state
            }),
            Op::Control(control) => self.control(control, state),
            op => {
                let reached = state.is_some();
                let mut state = state.unwrap_or_else(|| self.text.clone());
                if self.settles {
                    if let Op::Position(m) = op {
                        settle_point(&mut m.to, &state.at);
                        if let Some(cycle) = state.cycle().filter(|_| reached) {
                            let own = self.cycles.entry(stmt.span.start);
                            own.and_modify(|own| *own = None).or_insert_with(|| Some(cycle.clone()));
                        }
                    } else {
                        settle(op, &state.at);
                    }
                }
                if let (false, Op::StartCycle(_)) = (self.settles, &*op) {
                    // It must be the same cycle as when facts are put in.
                    let mut cycle = op.clone();
                    settle(&mut cycle, &state.at);
                    state.apply(&cycle);
                } else {
                    state.apply(op);
                }
                self.text.clone_from(&state);
                reached.then_some(state)
            }
        }
    }

    fn control(&mut self, control: &mut Control, mut state: Option<Held>) -> Option<Held> {
        if let (Control::For { variable, .. }, Some(state)) = (&*control, &mut state) {
            state.sets(&Target::Var(variable.clone()));
        }
        match control {
            Control::If { then, otherwise, .. } => {
                let mut after = self.body(then, state.clone());
                let other = self.body(otherwise, state);
                meet(&mut after, other.as_ref());
                after
            }
            Control::Loop { body } => self.turns(body, state).left,
            Control::Until { body, .. } => {
                let mut turned = self.turns(body, state);
                meet(&mut turned.left, turned.end.as_ref());
                turned.left
            }
            Control::Repeat { body, .. } | Control::While { body, .. } | Control::For { body, .. } => {
                let mut turned = self.turns(body, state);
                meet(&mut turned.left, turned.head.as_ref());
                turned.left
            }
        }
    }

    /// A body that is executed again and again.
    fn turns(&mut self, body: &mut [Stmt], state: Option<Held>) -> Turned {
        let mut head = state;
        let settles = std::mem::replace(&mut self.settles, false);
        for _ in 0..MOST_ROUNDS {
            let turned = self.turn(body, head.clone());
            if !meet(&mut head, turned.end.as_ref()) {
                break;
            }
        }
        self.settles = settles;
        let turned = self.turn(body, head.clone());
        Turned { head, ..turned }
    }

    fn turn(&mut self, body: &mut [Stmt], head: Option<Held>) -> Turned {
        self.left.push(None);
        self.next.push(None);
        let mut end = self.body(body, head);
        let (left, next) = (self.left.pop().flatten(), self.next.pop().flatten());
        meet(&mut end, next.as_ref());
        Turned { head: None, end, left }
    }
}

/// What holds at the head of a body, at the end of a turn, and where it is left from within.
struct Turned {
    head: Option<Held>,
    end: Option<Held>,
    left: Option<Held>,
}
