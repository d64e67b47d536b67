//! Must-analysis: the facts that hold on every path to a statement, through loops, branches, jumps and calls.
//!
//! It goes over the program until nothing changes, then once more to take what was asked for.

use std::collections::{BTreeMap, HashMap};

use super::called::Called;
use super::held::Held;
use crate::support::settle::{settle, settle_point};
use crate::values::constant_queries;
use ncc_ir::computed::computes::Computes;
use ncc_ir::expr::Target;
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Call, Control, Op, PathControl, Program, Stmt, Text};
use ncc_ir::track::Tracker;

/// Most times that a program is gone through; one that needs more keeps what it says.
pub(super) const MOST_ROUNDS: u32 = 24;

/// What holds at a call.
#[derive(Clone, Debug)]
pub(crate) struct At {
    pub(crate) before: Tracker,
    /// How corners are taken, if it is known.
    pub(crate) path: Option<Box<PathControl>>,
    /// What holds where the subprogram returns; `None` if it does not.
    pub(crate) behind: Option<Tracker>,
}

/// Where the subprograms of a program stand in it, by their names.
fn places(program: &Program) -> HashMap<Text, usize> {
    let mut places = HashMap::new();
    for (at, procedure) in program.procedures.iter().enumerate().skip(1) {
        places.entry(procedure.name.clone()).or_insert(at);
    }
    places
}

/// Ways into and out of a procedure.
#[derive(Clone, Default)]
struct Ways {
    entry: Option<Held>,
    exit: Option<Held>,
    labels: BTreeMap<Text, Held>,
}

/// The analysis: what is known at each point of a program, and what was asked for of it.
#[derive(Default)]
pub(super) struct Flow<'t> {
    names: HashMap<Text, usize>,
    /// What the target can say, where only saved codes and answers are put in.
    pub(super) target: Option<&'t Computes>,
    /// Those that restore the modes of their callers.
    pub(super) gives: Vec<bool>,
    ways: Vec<Ways>,
    /// The procedure at hand.
    at: usize,
    /// Loops that are open: what holds where they are left, and where their next turn begins.
    left: Vec<Option<Held>>,
    next: Vec<Option<Held>>,
    pub(super) changed: bool,
    pub(super) settles: bool,
    /// Whether holes are looked at too, and whether a cycle has been activated in the stretch at hand.
    pub(super) holes: bool,
    called: bool,
    pub(super) starts: HashMap<u32, Tracker>,
    pub(super) paths: HashMap<u32, Option<Box<PathControl>>>,
    pub(super) cycles: HashMap<u32, Option<Called>>,
    /// What holds at calls, by their places.
    pub(super) calls: HashMap<u32, At>,
    /// Whether a cycle may be active at statements, by their places, where that is asked for.
    pub(super) active: Option<HashMap<u32, bool>>,
    /// What the text has stated so far, for blocks to which no way leads: they are written as they stand there.
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

impl Flow<'_> {
    /// Ready to go over a program. `entry` holds where its main procedure begins.
    pub(super) fn new(program: &Program, entry: Held) -> Self {
        let mut ways = vec![Ways::default(); program.procedures.len()];
        if let Some(main) = ways.first_mut() {
            main.entry = Some(entry);
        }
        Flow { names: places(program), ways, ..Flow::default() }
    }

    /// Goes over the program until nothing changes any more, and once more to take what holds then. False if it
    /// changes still after [`MOST_ROUNDS`].
    pub(super) fn until_settled(&mut self, program: &mut Program) -> bool {
        for _ in 0..MOST_ROUNDS {
            self.changed = false;
            self.visit_program(program);
            if !self.changed {
                self.settles = true;
                self.visit_program(program);
                return true;
            }
        }
        false
    }

    pub(super) fn visit_program(&mut self, program: &mut Program) {
        for (at, procedure) in program.procedures.iter_mut().enumerate() {
            self.at = at;
            let entry = self.ways[at].entry.clone();
            let end = self.body(&mut procedure.body, entry);
            self.changed |= meet(&mut self.ways[at].exit, end.as_ref());
        }
    }

    fn body(&mut self, body: &mut [Stmt], mut state: Option<Held>) -> Option<Held> {
        let mut begins = true;
        // Blocks in a row with one level are skipped together: the level, and what holds before them.
        let mut skipped: Option<(u8, Option<Held>)> = None;
        for stmt in body {
            let flow = matches!(stmt.op, flow!());
            if let Some((_, before)) = skipped.take_if(|(level, _)| flow || stmt.skip != Some(*level)) {
                meet(&mut state, before.as_ref());
            }
            if let (None, Some(level)) = (&skipped, stmt.skip) {
                skipped = Some((level, state.clone()));
            }
            self.called = !begins && self.called;
            if let (true, false, true) = (begins, flow, self.settles) {
                let known = state.as_ref().unwrap_or(&self.text);
                // Statements that were made of one have its place.
                self.starts
                    .entry(stmt.span.start)
                    .and_modify(|at| at.join(&known.at))
                    .or_insert_with(|| known.at.clone());
                let path = self.paths.entry(stmt.span.start).or_insert_with(|| known.path.clone());
                if *path != known.path {
                    *path = None;
                }
            }
            if let (Some(active), true) = (&mut self.active, self.settles) {
                note_cycle(active, stmt, state.as_ref());
            }
            begins = flow;
            state = self.stmt(stmt, state);
            if let Some((_, before)) = skipped.take_if(|_| flow) {
                meet(&mut state, before.as_ref());
            }
        }
        if let Some((_, before)) = skipped {
            meet(&mut state, before.as_ref());
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
                    let mut jumped = self.ways[self.at].labels.remove(name);
                    self.changed |= meet(&mut jumped, Some(state));
                    self.ways[self.at].labels.extend(jumped.map(|jumped| (name.clone(), jumped)));
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
            Op::ProgramEnd | Op::BeginAgain | Op::Alarm(_) => None,
            Op::Call(call) => self.call(call, stmt.span.start, state),
            Op::RepeatBlocks(_) => state.map(|mut state| {
                state.at.forget();
                state.path = None;
                state.saved.forget();
                state
            }),
            Op::Control(control)
                if let Some(op) = state.as_ref().and_then(|held| held.saved.code(control)) =>
            {
                // The mode that was saved is known: that is what is restored.
                if self.settles {
                    stmt.op = op;
                    return self.stmt(stmt, state);
                }
                self.stmt(&mut Stmt { op, ..stmt.clone() }, state)
            }
            Op::Control(control) => self.control(control, state),
            op => {
                let reached = state.is_some();
                let mut state = state.unwrap_or_else(|| self.text.clone());
                if let Some(target) = self.target {
                    if let Op::Assign(_, value) = op
                        && self.settles
                        && reached
                    {
                        constant_queries::put_in(value, &state.at.modes, target);
                    }
                } else if self.settles {
                    let hole = matches!(op, Op::Hole(_) | Op::Pattern(_)) && self.holes && !self.called;
                    if (hole || matches!(op, Op::Position(_)))
                        && let Some(cycle) = state.cycle().filter(|_| reached)
                    {
                        let own = self.cycles.entry(stmt.span.start);
                        own.and_modify(|own| *own = None).or_insert(Some(cycle));
                    }
                    match op {
                        Op::Position(m) => settle_point(&mut m.to, &state.at),
                        _ => settle(op, &state.at),
                    }
                }
                self.called |= matches!(op, Op::StartCycle(_));
                if let (false, Op::StartCycle(_)) = (self.settles, &*op) {
                    // It must be the same cycle as when facts are put in.
                    let mut cycle = op.clone();
                    settle(&mut cycle, &state.at);
                    state.apply(&cycle, stmt.span.start);
                } else {
                    state.apply(op, stmt.span.start);
                }
                self.text.clone_from(&state);
                reached.then_some(state)
            }
        }
    }

    /// A call that stands at a place: what holds enters what is called, and what that has left goes on.
    fn call(&mut self, call: &Call, place: u32, state: Option<Held>) -> Option<Held> {
        let found = *self.names.get(&call.name)?;
        let called = &mut self.ways[found];
        // An active cycle is its caller's, which says it once.
        let shared = call.shared;
        let enters = |held: Held| Held { as_called: false, saved: held.saved.entered(shared), ..held };
        let entered = state.clone().map(enters);
        self.changed |= meet(&mut called.entry, entered.as_ref());
        // What is called more than once begins again with what it has left.
        let again = called.exit.clone().filter(|_| call.times > 1 && state.is_some()).map(enters);
        self.changed |= meet(&mut called.entry, again.as_ref());
        // Where it leads is known after it has been gone through.
        let caller = state?;
        let behind = called.exit.clone();
        if self.settles {
            let at = At {
                before: caller.at.clone(),
                path: caller.path.clone(),
                behind: behind.as_ref().map(|behind| behind.at.clone()),
            };
            self.calls.insert(place, at);
        }
        let gives = self.gives.get(found) == Some(&true);
        let behind = behind.map(|behind| Held { saved: behind.saved.left(&caller.saved, shared), ..behind });
        behind.map(|behind| if gives { behind.with_restored_modes(&caller) } else { behind })
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

/// Notes whether a cycle may be active at a statement, before it is executed.
fn note_cycle(active: &mut HashMap<u32, bool>, stmt: &Stmt, before: Option<&Held>) {
    if matches!(stmt.op, flow!()) {
        return;
    }
    let own = before.is_some_and(|held| held.at.cycle.is_some() || held.at.cycle_in_doubt);
    *active.entry(stmt.span.start).or_default() |= own;
}
