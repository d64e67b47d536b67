//! Facts that hold on every way to a statement are put into it: through loops, decisions, jumps and calls.
//!
//! What is in force at the head of a loop is what is so before it and behind each turn; at a label, where every jump
//! to it comes from; in a subprogram, at every call. Found by going through the program until nothing changes. What
//! positions do that only a caller knows stays as it is. What holds where a stretch of blocks begins is kept for those
//! who go on from there.
//!
//! Not here: values of variables.

use std::collections::{BTreeMap, HashMap};

use super::expand_calls::{settle, settle_point};
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
        main.entry = Some(entry.clone());
    }
    for _ in 0..MOST_ROUNDS {
        flow.changed = false;
        flow.over(program);
        if !flow.changed {
            flow.settles = true;
            flow.over(program);
            return Known { starts: flow.starts };
        }
    }
    Known::default()
}

/// Ways into and out of a procedure.
#[derive(Clone, Default)]
struct Ways {
    entry: Option<Tracker>,
    exit: Option<Tracker>,
    labels: BTreeMap<Text, Tracker>,
}

#[derive(Default)]
struct Flow {
    names: Vec<Text>,
    ways: Vec<Ways>,
    /// The procedure at hand.
    at: usize,
    /// Loops that are open: what holds where they are left, and where their next turn begins.
    left: Vec<Option<Tracker>>,
    next: Vec<Option<Tracker>>,
    changed: bool,
    settles: bool,
    starts: HashMap<u32, Tracker>,
    /// What the text has said so far, for blocks to which no way leads: they are written as they stand there.
    text: Tracker,
}

/// What holds where another way comes in; whether that is less than before.
fn meet(state: &mut Option<Tracker>, other: Option<&Tracker>) -> bool {
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

    fn body(&mut self, body: &mut [Stmt], mut state: Option<Tracker>) -> Option<Tracker> {
        let mut begins = true;
        for stmt in body {
            let before = state.clone();
            let flow = matches!(stmt.op, flow!());
            if let (true, false, true) = (begins, flow, self.settles) {
                let known = state.as_ref().unwrap_or(&self.text);
                // Statements that were made of one have its place.
                self.starts
                    .entry(stmt.span.start)
                    .and_modify(|at| at.join(known))
                    .or_insert_with(|| known.clone());
            }
            begins = flow;
            state = self.stmt(stmt, state);
            if stmt.skip.is_some() {
                meet(&mut state, before.as_ref());
            }
        }
        state
    }

    fn stmt(&mut self, stmt: &mut Stmt, state: Option<Tracker>) -> Option<Tracker> {
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
                self.changed |= meet(&mut called.entry, state.as_ref());
                // Where it leads is known after it has been gone through.
                state.and(called.exit.clone())
            }
            Op::RepeatBlocks(_) => state.map(|mut state| {
                state.forget();
                state
            }),
            Op::Control(control) => self.control(control, state),
            op => {
                let reached = state.is_some();
                let mut state = state.unwrap_or_else(|| self.text.clone());
                if self.settles {
                    if let Op::Position(m) = op {
                        settle_point(&mut m.to, &state);
                    } else {
                        settle(op, &state);
                    }
                }
                state.apply(op);
                self.text.clone_from(&state);
                reached.then_some(state)
            }
        }
    }

    fn control(&mut self, control: &mut Control, state: Option<Tracker>) -> Option<Tracker> {
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
    fn turns(&mut self, body: &mut [Stmt], state: Option<Tracker>) -> Turned {
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

    fn turn(&mut self, body: &mut [Stmt], head: Option<Tracker>) -> Turned {
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
    head: Option<Tracker>,
    end: Option<Tracker>,
    left: Option<Tracker>,
}
