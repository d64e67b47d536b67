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

use crate::flow::expand_calls::{settle, settle_point};
use crate::values::known_answers::{self, Saved};
use ncc_ir::canon::{AXES, Modes, Motion};
use ncc_ir::computed::computes::Computes;
use ncc_ir::expr::Target;
use ncc_ir::program::arguments;
use ncc_ir::program::cycle::Cycle;
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Attribute, Control, Op, PathControl, Procedure, Program, Stmt, Text};
use ncc_ir::track::Tracker;

mod active_cycles;
pub use active_cycles::ActiveCycles;

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

/// Has holes call up their cycles. Where all of them do, in whatever program, what has called them up is left out.
fn call_up_all(program: &mut Program, cycles: &HashMap<u32, Option<Called>>, bare: bool) {
    let calls = calls_of(program);
    let (mut any, mut all) = (false, true);
    for Procedure { body, .. } in &mut program.procedures {
        let served = call_up(body, (cycles, &calls), bare);
        any |= served;
        all &= served || !has_bare_holes(body);
    }
    if any && all {
        program.procedures.iter_mut().for_each(|procedure| without_holes(&mut procedure.body));
    }
}

/// The calls of cycles, by their places.
fn calls_of(program: &Program) -> HashMap<u32, Cycle> {
    fn over(body: &[Stmt], out: &mut HashMap<u32, Cycle>) {
        for stmt in body {
            match &stmt.op {
                Op::StartCycle(cycle) => out.insert(stmt.span.start, (**cycle).clone()),
                Op::Control(control) => {
                    control.bodies().for_each(|body| over(body, out));
                    None
                }
                _ => None,
            };
        }
    }
    let mut out = HashMap::new();
    program.procedures.iter().for_each(|procedure| over(&procedure.body, &mut out));
    out
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

/// What holds at a place.
#[derive(Clone, Debug, Default, PartialEq)]
struct Held {
    at: Tracker,
    /// How corners are taken, if the program has said it.
    path: Option<Box<PathControl>>,
    /// Whether the cycle in force is as its block has called it up: the same words would call up the same.
    as_called: bool,
    /// The place of that block, and what holds there.
    called_at: (u32, Modes),
    /// Variables that have whole numbers, such as saved codes in force.
    saved: Saved,
}

impl Held {
    fn join(&mut self, other: &Held) {
        self.at.join(&other.at);
        if self.path != other.path {
            self.path = None;
        }
        self.as_called &= other.as_called && self.called_at == other.called_at;
        self.saved.join(&other.saved);
    }

    /// The cycle in force, if it is known and as it was called up.
    fn cycle(&self) -> Option<Called> {
        let in_force = self.at.cycle.is_some() && !self.at.cycle_in_doubt;
        let sure = self.as_called && self.at.modes.motion == Some(Motion::Cycle);
        let (at, with) = self.called_at;
        (sure && in_force).then_some(Called { at, with, modes: self.at.modes })
    }

    /// Behind a call that gives back what its caller had.
    fn given_back(mut self, caller: &Held) -> Held {
        let (own, before) = (&mut self.at, &caller.at);
        let (modes, had) = (&mut own.modes, &before.modes);
        modes.motion = had.motion;
        modes.distance = had.distance;
        modes.units = had.units;
        modes.plane = had.plane;
        modes.feed_mode = had.feed_mode;
        modes.work_offset = had.work_offset;
        (own.framed, own.chained, own.turned) = (before.framed, before.chained, before.turned);
        own.turning = before.turning;
        (own.chain, own.chain_turned) = (before.chain, before.chain_turned);
        own.compensated = before.compensated;
        // They were those of its own frames.
        own.position = [None; AXES];
        self.path.clone_from(&caller.path);
        self
    }

    /// A variable gets another value.
    fn sets(&mut self, to: &Target) {
        self.saved.set(to, None);
        let Some(in_force) = &self.at.cycle else { return };
        self.as_called &= !arguments::reads(&Op::StartCycle(Box::new(in_force.cycle.clone())), to);
    }

    fn apply(&mut self, op: &Op, at: u32) {
        if let Op::Assign(to, value) = op {
            self.sets(to);
            self.saved.set(to, known_answers::worth(value, &self.at.modes));
        } else if let Op::Declare(_) = op {
            self.saved.forget();
        } else if matches!(op, Op::StartCycle(_)) {
            (self.as_called, self.called_at) = (true, (at, self.at.modes));
        } else if let Op::SetMotionControlMode(control) = op {
            self.path = Some(control.clone());
            self.as_called = false;
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
                | Op::Output(_)
                | Op::FloodOn
                | Op::MistOn
                | Op::CoolantOff
        ) {
            self.as_called = false;
        }
        self.at.apply(op);
    }
}

/// Which cycles are in force at holes, and their calls.
type Calls<'c> = (&'c HashMap<u32, Option<Called>>, &'c HashMap<u32, Cycle>);

/// Holes at which a cycle is in force call it up by themselves; with `bare`, words too of which only the run knows
/// that they are holes. Tells whether there are any, and all of them do.
fn call_up(body: &mut Vec<Stmt>, from: Calls, bare: bool) -> bool {
    let mut out = Vec::with_capacity(body.len());
    let (mut any, mut all, mut called) = (false, true, false);
    for mut stmt in std::mem::take(body) {
        called &= !matches!(stmt.op, flow!());
        called |= matches!(stmt.op, Op::StartCycle(_));
        if let Op::Control(control) = &mut stmt.op {
            for body in control.bodies_mut() {
                let (served, holes) = (call_up(body, from, bare), has_bare_holes(body));
                any |= served;
                all &= served || !holes;
            }
        }
        let hole = match &stmt.op {
            Op::Position(to) if bare => Some(Op::Hole(to.clone())),
            Op::Position(_) => {
                all = false;
                None
            }
            Op::Hole(_) | Op::Pattern(_) if !called => Some(stmt.op.clone()),
            _ => None,
        };
        let called = from.0.get(&stmt.span.start).copied().flatten();
        match (hole, called.and_then(|called| Some((called, from.1.get(&called.at)?)))) {
            (Some(mut hole), Some((called, cycle))) => {
                any = true;
                let mut cycle = Op::StartCycle(Box::new(cycle.clone()));
                settle(&mut cycle, &Tracker::new(called.with));
                settle(&mut hole, &Tracker::new(called.modes));
                let hole = Stmt { op: hole, joined: true, number: None, ..stmt.clone() };
                out.push(Stmt { op: cycle, comment: None, ..stmt });
                out.push(hole);
            }
            (hole, _) => {
                all &= hole.is_none();
                out.push(stmt);
            }
        }
    }
    *body = out;
    any && all
}

/// Whether holes stand in a stretch before any cycle has been called up there.
pub fn has_bare_holes(body: &[Stmt]) -> bool {
    let mut called = false;
    body.iter().any(|stmt| {
        called &= !matches!(stmt.op, flow!());
        match &stmt.op {
            Op::StartCycle(_) => {
                called = true;
                false
            }
            Op::Hole(_) | Op::Pattern(_) => !called,
            Op::Position(_) => true,
            Op::Control(control) => control.bodies().any(|body| has_bare_holes(body)),
            _ => false,
        }
    })
}

/// Whether programs are called here, or blocks repeated.
fn has_calls(stmt: &Stmt) -> bool {
    match &stmt.op {
        Op::Call(_) | Op::RepeatBlocks(_) => true,
        Op::Control(control) => control.bodies().flatten().any(has_calls),
        _ => false,
    }
}

/// Calls of cycles that make no hole before control goes another way leave their feed alone behind.
fn without_holes(body: &mut [Stmt]) {
    let mut idle = None;
    for at in 0..body.len() {
        match &mut body[at].op {
            Op::StartCycle(_) => idle = Some(at),
            Op::Hole(_) | Op::Pattern(_) | Op::Position(_) => idle = None,
            op if matches!(op, flow!()) => {
                if let Op::Control(control) = op {
                    control.bodies_mut().for_each(|body| without_holes(body));
                }
                if let Some(call) = idle.take().filter(|_| !has_calls(&body[at]))
                    && let Op::StartCycle(cycle) = &mut body[call].op
                {
                    body[call].op = cycle.feed.take().map_or(Op::Blank, Op::SetFeedRate);
                }
            }
            _ => {}
        }
    }
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
            Op::Call(call) => {
                let found = *self.names.get(&call.name)?;
                let called = &mut self.ways[found];
                // A cycle in force is its caller's, which says it once.
                let shared = call.shared;
                let enters =
                    |held: Held| Held { as_called: false, saved: held.saved.entered(shared), ..held };
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
                    self.calls.insert(stmt.span.start, at);
                }
                let gives = self.gives.get(found) == Some(&true);
                let behind =
                    behind.map(|behind| Held { saved: behind.saved.left(&caller.saved, shared), ..behind });
                behind.map(|behind| if gives { behind.given_back(&caller) } else { behind })
            }
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
