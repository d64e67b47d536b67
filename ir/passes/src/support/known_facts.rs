//! Facts that hold on every way to a statement are put into it: through loops, decisions, jumps and calls.
//!
//! What is in force at the head of a loop is what is so before it and behind each turn; at a label, where every jump
//! to it comes from; in a subprogram, at every call. Found by going through the program until nothing changes. What
//! positions do that only a caller knows stays as it is. What holds where a stretch of blocks begins is kept for those
//! who go on from there. A hole in a loop or behind a label at which one cycle is in force, as it was called up,
//! calls it up by itself: where control goes, a target may leave none in force. A call that has served only such
//! holes is left out.
//!
//! Not here: values of variables.

use std::collections::{BTreeMap, HashMap};

use self::called_up::call_up_all;
use self::held::Held;
use crate::flow::expand_calls::{settle, settle_point};
use crate::values::known_answers;
use ncc_ir::canon::Modes;
use ncc_ir::computed::computes::Computes;
use ncc_ir::expr::Target;
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Attribute, Call, Control, Op, PathControl, Program, Stmt, Text};
use ncc_ir::track::Tracker;

mod active_cycles;
mod called_up;
mod held;

pub use self::active_cycles::ActiveCycles;
pub use self::called_up::has_bare_holes;

/// Most times that a program is gone through; one that needs more keeps what it says.
const MOST_ROUNDS: u32 = 24;

/// What holds where stretches of blocks without control begin, by their places in the source.
#[derive(Clone, Debug, Default)]
pub struct Known {
    starts: HashMap<u32, Tracker>,
    /// How corners are taken there, if that is known.
    paths: HashMap<u32, Option<Box<PathControl>>>,
    /// Cycles in force at holes, by their places, that are as they were called up on every way there.
    cycles: HashMap<u32, Option<Called>>,
}

/// Where the cycle in force at a hole is called up, what holds there, and what holds at the hole.
#[derive(Clone, Copy, Debug)]
struct Called {
    at: u32,
    with: Modes,
    modes: Modes,
}

impl Known {
    /// What holds where a stretch begins with a statement.
    pub(crate) fn before(&self, stmt: &Stmt) -> Option<&Tracker> {
        self.starts.get(&stmt.span.start)
    }

    /// Puts units, feed and motion into a walk that comes to a statement from elsewhere.
    pub(crate) fn feeds(&self, stmt: &Stmt, walk: &mut Tracker) {
        let Some(at) = self.before(stmt) else { return };
        (walk.modes.units, walk.modes.feed_mode) = (at.modes.units, at.modes.feed_mode);
        (walk.fed, walk.feed, walk.modes.motion) = (at.fed, at.feed, at.modes.motion);
    }

    /// How corners are taken where a stretch begins with a statement, if it is known.
    pub(crate) fn path_before(&self, stmt: &Stmt) -> Option<&PathControl> {
        self.paths.get(&stmt.span.start)?.as_deref()
    }

    /// The modes in force where stretches begin, by the places of their first statements.
    pub fn modes(&self) -> HashMap<u32, Modes> {
        self.starts.iter().map(|(at, known)| (*at, known.modes)).collect()
    }
}

/// Has holes that the text itself puts under a cycle of another stretch call it up. What is `known` is of a copy of
/// the program with its facts put in.
pub(crate) fn holes(program: &mut Program, known: &Known) {
    call_up_all(program, &known.cycles, false);
}

/// Leaves such holes to what is in force, for a target that keeps it in loops as the source does. Tells whether there
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
/// puts under a cycle are made to call it up too.
pub fn run(program: &mut Program, entry: &Tracker, holes: bool) -> Known {
    let names = places(program);
    let mut flow = Flow { names, holes, ..Flow::default() };
    flow.ways = vec![Ways::default(); program.procedures.len()];
    if let Some(main) = flow.ways.first_mut() {
        main.entry = Some(Held { at: entry.clone(), ..Held::default() });
    }
    for _ in 0..MOST_ROUNDS {
        flow.changed = false;
        flow.over(program);
        if !flow.changed {
            flow.settles = true;
            flow.over(program);
            call_up_all(program, &flow.cycles, true);
            return Known { starts: flow.starts, paths: flow.paths, cycles: flow.cycles };
        }
    }
    Known::default()
}

/// Puts modes back that are known where their codes were saved, and answers what a target of these capabilities cannot be
/// asked for and is known; nothing else. `entry` is what holds where the program begins.
pub fn put_back(program: &mut Program, entry: &Tracker, there: &Computes) {
    let names = places(program);
    let mut flow = Flow { names, there: Some(there), ..Flow::default() };
    flow.ways = vec![Ways::default(); program.procedures.len()];
    if let Some(main) = flow.ways.first_mut() {
        main.entry = Some(Held { at: entry.clone(), ..Held::default() });
    }
    flow.until_settled(program);
}

/// What holds where stretches begin; the program stays as it is. `entry` is what holds where the program begins, and
/// `path` how corners are taken there.
pub(crate) fn starts(program: &Program, entry: &Tracker, path: Option<&PathControl>) -> Option<Known> {
    let mut program = program.clone();
    let names = places(&program);
    let mut flow = Flow { names, ..Flow::default() };
    flow.ways = vec![Ways::default(); program.procedures.len()];
    if let Some(main) = flow.ways.first_mut() {
        let path = path.cloned().map(Box::new);
        main.entry = Some(Held { at: entry.clone(), path, ..Held::default() });
    }
    flow.until_settled(&mut program).then_some(Known {
        starts: flow.starts,
        paths: flow.paths,
        cycles: flow.cycles,
    })
}

/// What holds at a call.
#[derive(Clone, Debug)]
pub(crate) struct At {
    pub(crate) before: Tracker,
    /// How corners are taken, if it is known.
    pub(crate) path: Option<Box<PathControl>>,
    /// What holds where the subprogram goes back; `None` if it does not.
    pub(crate) behind: Option<Tracker>,
}

/// What holds at each call that a way leads to, by its place, where subprograms give back what they say they do;
/// `None` if that is not found. `entry` is what holds where the program begins.
pub(crate) fn at_calls(program: &Program, entry: &Tracker) -> Option<HashMap<u32, At>> {
    let mut program = program.clone();
    let names = places(&program);
    let gives = program.procedures.iter().map(|p| p.attributes.contains(&Attribute::GivesBack)).collect();
    let mut flow = Flow { names, gives, ..Flow::default() };
    flow.ways = vec![Ways::default(); program.procedures.len()];
    if let Some(main) = flow.ways.first_mut() {
        main.entry = Some(Held { at: entry.clone(), ..Held::default() });
    }
    flow.until_settled(&mut program).then_some(flow.calls)
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

#[derive(Default)]
struct Flow<'t> {
    names: HashMap<Text, usize>,
    /// What the target can say, where only saved codes and answers are put in.
    there: Option<&'t Computes>,
    /// Those that give back what their callers had.
    gives: Vec<bool>,
    ways: Vec<Ways>,
    /// The procedure at hand.
    at: usize,
    /// Loops that are open: what holds where they are left, and where their next turn begins.
    left: Vec<Option<Held>>,
    next: Vec<Option<Held>>,
    changed: bool,
    settles: bool,
    /// Whether holes are looked at too, and whether a cycle has been called up in the stretch at hand.
    holes: bool,
    called: bool,
    starts: HashMap<u32, Tracker>,
    paths: HashMap<u32, Option<Box<PathControl>>>,
    cycles: HashMap<u32, Option<Called>>,
    /// What holds at calls, by their places.
    calls: HashMap<u32, At>,
    /// Whether a cycle may be active at statements, by their places, where that is asked for.
    active: Option<HashMap<u32, bool>>,
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

impl Flow<'_> {
    /// Goes over the program until nothing changes any more, and once more to take what holds then. False if it
    /// changes still after [`MOST_ROUNDS`].
    fn until_settled(&mut self, program: &mut Program) -> bool {
        for _ in 0..MOST_ROUNDS {
            self.changed = false;
            self.over(program);
            if !self.changed {
                self.settles = true;
                self.over(program);
                return true;
            }
        }
        false
    }

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
                active_cycles::note(active, stmt, state.as_ref());
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
                // The mode that was saved is known: that is what is put back.
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
                if let Some(there) = self.there {
                    if let Op::Assign(_, value) = op
                        && self.settles
                        && reached
                    {
                        known_answers::put_in(value, &state.at.modes, there);
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
        // A cycle in force is its caller's, which says it once.
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
        behind.map(|behind| if gives { behind.given_back(&caller) } else { behind })
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
