//! Incremental words after a change of frame or work offset, for controls that include the change in them.
//!
//! On such a control `G0 X1`, `TRANS X100`, `X=IC(1)` goes to X2 in the new frame; on others to where X stands and one
//! more. An absolute word is the same on both: the first word of each axis after such a change becomes one, as far as
//! it is known where it leads. Anything else is refused, unless source and target both include the change.
//!
//! Not here: how the word is written (the back-ends), and what a control does with it ([`ncc_exec`]).

mod pending;

use std::collections::HashMap;

use crate::pass::{Moment, Pass, ProgramMoment, ProgramStep, Step};
use crate::support::walk::Walk;
use crate::support::write::at;
use ncc_ir::behaviour::{Behaviour, Behaviours};
use ncc_ir::canon::{AXES, Axis, Distance, Fact, Plane};
use ncc_ir::computed::computed_code::computed_code;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::lack::FramesLack;
use ncc_ir::program::arguments::{words_of, words_of_mut};
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{
    Control, Coord, Data, FrameSlot, FrameStep, Lines, Op, Point, Program, Shape, Slot, Stmt, Text,
};
use ncc_ir::track::Tracker;
use pending::Pending;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "frame-increments",
    about: "writes incremental words after a change of frame as both controls count them",
    alone: None,
    step: Some(Step {
        moment: Moment::Arrival,
        needed: |l, p| {
            p.lines.is_none()
                && l.states.ask(|own: &FrameIncrementsState| own.concerns(p.stmts, l.walk.at.modes.distance))
        },
        run: |l, p| l.states.state_mut::<FrameIncrementsState>().count_increments(p.stmts, &l.walk, p.diags),
        otherwise: |l, p| match p.lines {
            Some(lines) => l.states.state_mut::<FrameIncrementsState>().note_lines(lines),
            None => l.states.state_mut::<FrameIncrementsState>().note(p.stmts, &l.walk),
        },
        first: None,
        finish: |_, _, _| {},
    }),
    program: &[
        ProgramStep {
            moment: ProgramMoment::SourceIncrements,
            needed: |_, _| true,
            run: |l, p| {
                let mut source = l.states.state_mut::<FrameIncrementsState>().take_source();
                source.count_program(p.program, &l.walk.at, p.diags);
            },
        },
        ProgramStep {
            moment: ProgramMoment::Increments,
            needed: |_, _| true,
            run: |l, p| {
                l.states.state_mut::<FrameIncrementsState>().count_program(p.program, &l.walk.at, p.diags)
            },
        },
    ],
    parametric: None,
};

/// Most rounds in which it is found out what subprograms leave; each adds an axis at least.
const MOST_ROUNDS: usize = 64;

const LINEAR: [bool; AXES] = [true, true, true, false, false, false];

/// How the change counts on both sides, and which axes have had no word since one.
#[derive(Clone, Debug, Default)]
pub struct FrameIncrementsState {
    /// Whether the source's control includes it.
    from: bool,
    /// Whether the target's does.
    to: bool,
    /// Whether both are of one mind, so that words stay as they are, but for passes that rewrite them.
    same: bool,
    /// Axes that have had no word since a change.
    pending: Pending,
    /// Whether the program, which is kept whole, is done.
    over: bool,
}

impl FrameIncrementsState {
    /// For the source's control, and the target's, which may include the change where that is open.
    pub fn new(source: &Behaviours, target: &Behaviours) -> FrameIncrementsState {
        let included = Behaviour::FrameOffsetIncremental;
        let from = source.does(included);
        let to = target.does(included) || target.is_open(included);
        // A target's program opens with a work offset that its control may not have had before.
        let pending =
            if to { Pending { axes: [Some(None); AXES], ..Pending::default() } } else { Pending::default() };
        // What is open is the same fact of the same machine.
        let alike = |all: &Behaviours| (all.get(included), all.is_open(included));
        FrameIncrementsState { from, to, same: alike(source) == alike(target), pending, over: false }
    }

    /// Nothing is in front of the program: its caller has said all that was to be stated.
    pub fn stands_alone(&mut self) {
        self.pending = Pending::default();
    }

    /// What the source's control makes of the words, by itself; what is left is the target's.
    pub(crate) fn take_source(&mut self) -> FrameIncrementsState {
        self.same = false;
        let source = FrameIncrementsState { to: false, pending: Pending::default(), ..self.clone() };
        self.from = false;
        source
    }

    /// Whether there is anything to do.
    pub fn is_used(&self) -> bool {
        (self.from || self.to) && !self.same && !self.over
    }

    /// Statements of a program that streams.
    pub(crate) fn count_increments(&mut self, stmts: &mut [Stmt], start: &Walk, diags: &mut Vec<Diagnostic>) {
        if !self.is_used() {
            return;
        }
        let mut walk = start.clone();
        self.pending.measure(walk.at.modes.distance, false);
        let mut way = Way { state: self, program: &HashMap::new(), diags };
        way.body(stmts, &mut walk);
    }

    /// Whether any of these statements would be rewritten, or refused. `distance` is the active mode before them.
    pub(crate) fn concerns(&self, stmts: &[Stmt], distance: Option<Distance>) -> bool {
        if !self.is_used() {
            return false;
        }
        let mut pending = self.pending.clone();
        pending.measure(distance, false);
        if stmts.iter().all(|stmt| is_absolute_move(&stmt.op, &pending)) {
            return false;
        }
        for Stmt { op, skip, .. } in stmts {
            if let (Some(to), true) = (words_of(op), pending.any()) {
                let mut words = pending.axes.iter().zip(&to.axes);
                let relative = |word: &Coord| pending.may_be_relative(word);
                if words.any(|(axis, word)| axis.is_some() && word.as_ref().is_some_and(relative)) {
                    return true;
                }
            }
            note(&mut pending, op, None, skip.is_some());
        }
        false
    }

    /// Notes statements that go along lines alone, by absolute words.
    pub(crate) fn note_lines(&mut self, lines: Lines) {
        for (axis, pending) in self.pending.axes.iter_mut().enumerate() {
            if lines.axes >> axis & 1 == 1 {
                *pending = None;
            }
        }
    }

    /// Notes statements of which none is concerned.
    pub(crate) fn note(&mut self, stmts: &[Stmt], start: &Walk) {
        if !self.is_used() {
            return;
        }
        let changes = |stmt: &Stmt| changes(&stmt.op, None, &LINEAR).is_some();
        if self.from && stmts.iter().any(changes) {
            // Where the program had put the axes before it counts.
            let mut own = stmts.to_vec();
            return self.count_increments(&mut own, start, &mut Vec::new());
        }
        for stmt in stmts {
            note(&mut self.pending, &stmt.op, None, stmt.skip.is_some());
        }
    }

    /// A program that is kept whole, from its first statement that was not seen yet. It is done then.
    pub fn count_program(&mut self, program: &mut Program, start: &Tracker, diags: &mut Vec<Diagnostic>) {
        if !self.is_used() {
            return;
        }
        let mut walk = Walk::new(start.clone());
        walk.assume(&program.assumed);
        self.pending.measure(walk.at.modes.distance, false);
        let entry = self.pending.clone();
        // What may be pending where each procedure begins and ends.
        let mut ends: HashMap<Text, [Pending; 2]> = program
            .procedures
            .iter()
            .skip(1)
            .map(|p| (p.name.clone(), [Pending::default(), Pending::default()]))
            .collect();
        for _ in 0..MOST_ROUNDS {
            let mut grown = false;
            for at in 0..program.procedures.len() {
                let Some(procedure) = program.procedures.get(at) else { continue };
                let own = ends.get(&procedure.name).filter(|_| at > 0).map(|[begin, _]| begin.clone());
                let pending = own.unwrap_or_else(|| entry.clone());
                let mut calls = Vec::new();
                let (goes_on, _) = reach(&procedure.body, &pending, &ends, &mut calls);
                for (name, pending) in calls {
                    if let Some([begin, _]) = ends.get_mut(&name) {
                        grown |= unite(begin, &pending);
                    }
                }
                if let (true, Some([_, end])) = (at > 0, ends.get_mut(&procedure.name)) {
                    grown |= unite(end, &goes_on);
                }
            }
            if !grown {
                break;
            }
        }
        for at in 0..program.procedures.len() {
            let Some(procedure) = program.procedures.get_mut(at) else { continue };
            self.pending = match ends.get(&procedure.name).filter(|_| at > 0) {
                Some([begin, _]) => begin.clone(),
                None => entry.clone(),
            };
            let mut walk = if at == 0 { walk.clone() } else { Walk::new(Tracker::unknown()) };
            let mut way = Way { state: self, program: &ends, diags };
            way.body(&mut procedure.body, &mut walk);
        }
        self.over = true;
    }
}

/// Both may be pending; whether that is more than before.
fn unite(own: &mut Pending, other: &Pending) -> bool {
    let before = own.clone();
    for (own, other) in own.axes.iter_mut().zip(&other.axes) {
        if other.is_some() {
            *own = Some(None);
        }
    }
    own.rotated = std::array::from_fn(|axis| own.rotated[axis] || other.rotated[axis]);
    own.measured = std::array::from_fn(|way| own.measured[way] || other.measured[way]);
    before != *own
}

/// What may be pending where control goes from one place of a procedure to another.
#[derive(Clone, Debug, Default, PartialEq)]
struct Jumps {
    /// At a jump, or at a repetition of blocks: so it is at the label where that goes on.
    labels: HashMap<Text, Pending>,
    /// Where a loop is left, or begins its next turn.
    leaves: Pending,
    /// Where the procedure returns before its end.
    returns: Pending,
    /// Whether any of them has become more.
    grown: bool,
}

impl Jumps {
    fn go_to_label(&mut self, name: &Text, own: &Pending) {
        self.grown |= match self.labels.get_mut(name) {
            Some(label) => unite(label, own),
            None => {
                let mut label = Pending::default();
                unite(&mut label, own);
                self.labels.insert(name.clone(), label);
                true
            }
        };
    }
}

/// What may be pending after a body, and where it jumps to, if `before` may be before it. `calls` gets what may be
/// where each subprogram is called.
fn reach(
    body: &[Stmt],
    before: &Pending,
    ends: &HashMap<Text, [Pending; 2]>,
    calls: &mut Vec<(Text, Pending)>,
) -> (Pending, Jumps) {
    let mut jumps = Jumps::default();
    loop {
        let mut own = before.bits();
        jumps.grown = false;
        pass(body, &mut own, ends, calls, &mut jumps);
        if !jumps.grown {
            unite(&mut own, &jumps.returns);
            return (own, jumps);
        }
    }
}

/// Follows what may be pending through a body.
fn pass(
    body: &[Stmt],
    own: &mut Pending,
    ends: &HashMap<Text, [Pending; 2]>,
    calls: &mut Vec<(Text, Pending)>,
    jumps: &mut Jumps,
) {
    for stmt in body {
        match &stmt.op {
            Op::Call(call) => {
                calls.push((call.name.clone(), own.clone()));
                after_call(own, ends.get(&call.name), stmt.skip.is_some());
            }
            Op::Label(name) => jumps.labels.get(name).into_iter().for_each(|from| _ = unite(own, from)),
            Op::Goto(to) => jumps.go_to_label(to, own),
            Op::RepeatBlocks(again) => jumps.go_to_label(&again.from, own),
            Op::Leave | Op::NextTurn => jumps.grown |= unite(&mut jumps.leaves, own),
            Op::Return => jumps.grown |= unite(&mut jumps.returns, own),
            Op::Control(control) if is_code(control) => own.measured = [true; 2],
            Op::Control(control) => within_turns(control, own, ends, calls, jumps),
            op => note(own, op, None, stmt.skip.is_some()),
        }
    }
}

/// What may be pending before each iteration of a structure, and after it.
fn within_turns(
    control: &Control,
    own: &mut Pending,
    ends: &HashMap<Text, [Pending; 2]>,
    calls: &mut Vec<(Text, Pending)>,
    jumps: &mut Jumps,
) {
    loop {
        let before = own.clone();
        for body in control.bodies() {
            let mut inner = own.clone();
            pass(body, &mut inner, ends, calls, jumps);
            unite(own, &inner);
        }
        unite(own, &jumps.leaves);
        if before == *own {
            return;
        }
    }
}

/// Whether a branch is about the code of a group that a variable was given: it restores what was active, as a rule,
/// and where it does not, execution judges what follows.
fn is_code(control: &Control) -> bool {
    computed_code(control).is_some()
}

/// What may be pending after a call.
fn after_call(own: &mut Pending, called: Option<&[Pending; 2]>, skipped: bool) {
    let before = own.clone();
    *own = match called {
        Some([_, end]) => end.clone(),
        None => Pending::ANYTHING,
    };
    if skipped {
        unite(own, &before);
    }
}

/// Whether a statement surely changes no frame, and has no incremental word.
fn is_absolute_move(op: &Op, pending: &Pending) -> bool {
    let to = match op {
        Op::StraightFeed(m) | Op::StraightTraverse(m) => &m.to,
        Op::ArcFeed(arc) => &arc.to,
        Op::SetFeedRate(_) | Op::Comment(_) | Op::Blank => return true,
        _ => return false,
    };
    !to.axes.iter().flatten().any(|word| pending.may_be_relative(word))
}

/// Notes what a statement changes, and what it moves. `plane` is the active one, if it is known.
fn note(pending: &mut Pending, op: &Op, plane: Option<Plane>, skipped: bool) {
    match op {
        Op::StraightFeed(m) | Op::StraightTraverse(m) => return clear(pending, &m.to, skipped),
        Op::ArcFeed(arc) => return clear(pending, &arc.to, skipped),
        Op::SetFeedRate(_) | Op::Comment(_) | Op::Blank => return,
        _ => {}
    }
    if let Op::SetDistanceMode(distance) = op {
        pending.measure(Some(*distance), skipped);
    }
    if let Some(axes) = changes(op, None, &pending.rotated) {
        mark(pending, axes);
        turn(pending, op, axes);
    }
    if let Some(to) = words_of(op) {
        clear(pending, to, skipped);
    }
    if let Op::Polar(polar) = op {
        // Both axes of the plane go to a point, by whatever words.
        let goes = in_plane(polar.plane.known().or(plane));
        for (at, pending) in pending.axes.iter_mut().enumerate() {
            match goes {
                Some(axes) if axes[at] && !skipped => *pending = None,
                Some(axes) if !axes[at] => {}
                Some(_) | None => *pending = pending.map(|_| None),
            }
        }
    }
    if let Op::GoToReference(reference) = op
        && !skipped
    {
        for (pending, goes) in pending.axes.iter_mut().zip(reference.axes) {
            if goes {
                *pending = None;
            }
        }
    }
}

/// Notes rotations.
fn turn(pending: &mut Pending, op: &Op, axes: [bool; AXES]) {
    if matches!(op, Op::SetSlot(slot) if matches!(**slot, Slot::Rotation { .. })) {
        pending.rotated = std::array::from_fn(|axis| pending.rotated[axis] || axes[axis]);
    }
}

fn mark(pending: &mut Pending, axes: [bool; AXES]) {
    for (pending, changes) in pending.axes.iter_mut().zip(axes) {
        if changes {
            *pending = Some(None);
        }
    }
}

fn clear(pending: &mut Pending, to: &Point, skipped: bool) {
    for (pending, word) in pending.axes.iter_mut().zip(&to.axes) {
        if word.is_some() {
            *pending = if skipped { pending.map(|_| None) } else { None };
        }
    }
}

/// Whether a statement may change the coordinate of Z without moving it.
pub(crate) fn changes_place(op: &Op) -> bool {
    changes(op, None, &LINEAR).is_some_and(|axes| axes[Axis::Z as usize])
}

/// The axes of a plane.
fn in_plane(plane: Option<Plane>) -> Option<[bool; AXES]> {
    let (first, second, _) = plane?.axes();
    Some(std::array::from_fn(|axis| axis == first as usize || axis == second as usize))
}

/// Axes whose coordinates a statement may change without moving them.
fn changes(op: &Op, plane: Option<Plane>, rotated: &[bool; AXES]) -> Option<[bool; AXES]> {
    let all = [true; AXES];
    let named = |axes: &[Option<ncc_ir::expr::Expr>; AXES]| std::array::from_fn(|axis| axes[axis].is_some());
    let turning = |own: Fact<Plane>| in_plane(own.known().or(plane)).unwrap_or(LINEAR);
    let three = |axes: [bool; 3]| std::array::from_fn(|axis| axis < 3 && axes[axis]);
    match op {
        Op::SetOriginOffsets(_) | Op::UseOriginShift(_) => Some(all),
        Op::ClearFrame(FrameSlot::Polar | FrameSlot::Tilt) => None,
        Op::ClearFrame(FrameSlot::Rotation) => Some(*rotated),
        Op::ClearFrame(FrameSlot::Scale | FrameSlot::Mirror) => Some(LINEAR),
        Op::ClearFrame(FrameSlot::Shift | FrameSlot::Local | FrameSlot::Chain) => Some(all),
        // Where it takes the place of others, theirs are over.
        Op::SetFrame(frame) if !frame.added => Some(all),
        Op::SetFrame(frame) => Some(match &frame.step {
            FrameStep::Translate(by) => named(by),
            FrameStep::Rotate { plane, .. } => turning(*plane),
            FrameStep::Scale(by) => three(std::array::from_fn(|axis| by[axis].is_some())),
            FrameStep::Mirror(axes) => three(*axes),
        }),
        Op::SetSlot(slot) => match &**slot {
            Slot::Shift { axes, .. } => Some(named(axes)),
            Slot::Mirror(lines) => Some(three(std::array::from_fn(|axis| lines[axis].is_some()))),
            Slot::Rotation { plane, .. } => Some(turning(*plane)),
            Slot::Scale { .. } | Slot::NoMirror(_) => Some(LINEAR),
            Slot::Tilt(_) => None,
        },
        Op::SetPosition(axes) => Some(named(axes)),
        Op::SetData(data) => match &**data {
            Data::Offset { words, turn, .. } => {
                let turns = turn.is_some();
                Some(std::array::from_fn(|axis| words[axis].is_some() || turns && axis < 2))
            }
            _ => None,
        },
        _ => None,
    }
}

/// What a body is walked with.
struct Way<'s> {
    state: &'s mut FrameIncrementsState,
    /// What may be pending where each procedure begins and ends.
    program: &'s HashMap<Text, [Pending; 2]>,
    diags: &'s mut Vec<Diagnostic>,
}

impl Way<'_> {
    fn body(&mut self, stmts: &mut [Stmt], walk: &mut Walk) {
        // Only a program that is kept whole goes another way than straight on.
        let (_, mut jumps) = match stmts.iter().any(|stmt| matches!(stmt.op, flow!())) {
            true => reach(stmts, &self.state.pending, self.program, &mut Vec::new()),
            false => Default::default(),
        };
        self.within(stmts, walk, &mut jumps);
    }

    /// A body, or one of a structure in it.
    fn within(&mut self, stmts: &mut [Stmt], walk: &mut Walk, jumps: &mut Jumps) {
        for stmt in stmts {
            match &mut stmt.op {
                Op::Call(call) => {
                    let called = self.program.get(&call.name);
                    after_call(&mut self.state.pending, called, stmt.skip.is_some());
                }
                Op::Label(name) => {
                    let from = jumps.labels.get(name);
                    from.into_iter().for_each(|from| _ = unite(&mut self.state.pending, from));
                }
                Op::Control(control) if is_code(control) => self.state.pending.measured = [true; 2],
                Op::Control(control) => {
                    let mut pending = self.state.pending.bits();
                    within_turns(control, &mut pending, self.program, &mut Vec::new(), jumps);
                    for body in control.bodies_mut() {
                        self.state.pending = pending.clone();
                        self.within(body, &mut Walk::new(Tracker::unknown()), jumps);
                    }
                    self.state.pending = pending;
                }
                _ => self.statement(stmt, walk),
            }
            walk.step(stmt);
        }
    }

    fn statement(&mut self, stmt: &mut Stmt, walk: &mut Walk) {
        walk.enter(stmt.skip);
        let raw = walk.at.raw;
        let (op, skipped) = (&mut stmt.op, stmt.skip.is_some());
        if self.state.pending.any() && !raw && self.absolute(op, walk) == Err(()) {
            self.diags.push(Diagnostic::new(Fault::lacks(FramesLack::IncrementAfterChange), stmt.span));
        }
        let axes = changes(op, walk.at.modes.plane, &self.state.pending.rotated);
        let Some(axes) = axes.filter(|_| !self.same_offset(op, walk)) else {
            return note(&mut self.state.pending, op, walk.at.modes.plane, skipped);
        };
        turn(&mut self.state.pending, op, axes);
        // Each axis is where the program has put it, until it has a word again.
        let turns = matches!(op, Op::SetFrame(frame) if matches!(frame.step, FrameStep::Rotate { .. }))
            || matches!(op, Op::SetSlot(slot) if matches!(**slot, Slot::Rotation { .. }))
            || walk.at.turned
            || walk.at.chain_turned;
        for (axis, pending) in self.state.pending.axes.iter_mut().enumerate() {
            if axes[axis] {
                let place = walk.at.position[axis].filter(|_| !turns && !skipped);
                *pending = Some(match *pending {
                    None => place,
                    Some(before) => before.filter(|_| !turns && !skipped),
                });
            }
        }
    }

    /// Whether it activates the work offset that is active.
    fn same_offset(&self, op: &Op, walk: &Walk) -> bool {
        matches!(op, Op::SetOriginOffsets(number) if walk.at.modes.work_offset == Some(*number))
    }

    /// Makes incremental words of axes that a change is pending for absolute.
    fn absolute(&self, op: &mut Op, walk: &Walk) -> Result<(), ()> {
        let FrameIncrementsState { from, to, pending, .. } = &*self.state;
        if let Op::ArcForm(arc) = op
            && let Shape::Through(via) = &arc.shape
        {
            let counts = |axis: usize| {
                let word = via.axes[axis].as_ref();
                word.is_some_and(|word| pending.is_relative(word))
            };
            if (0..AXES).any(|axis| pending.axes[axis].is_some() && counts(axis)) {
                return Err(());
            }
        }
        let is_return = matches!(op, Op::GoToReference(_));
        let Some(point) = words_of_mut(op) else { return Ok(()) };
        let mut refused = false;
        for (axis, word) in Axis::ALL.into_iter().zip(&mut point.axes) {
            let (Some(own), Some(before)) = (word.as_mut(), pending.axes[axis as usize]) else { continue };
            if !pending.is_relative(own) {
                continue;
            }
            // On the way to a reference point, no way is no word.
            if is_return && !from && own.value.literal().is_some_and(|n| n.is_zero()) {
                continue;
            }
            let here = if *from { before } else { walk.at.position[axis as usize] };
            let now = walk.at.resolve(own, here);
            match now.filter(|_| walk.at.modes.distance.is_some() || own.distance.known().is_some()) {
                Some(now) => *own = at(now, axis, walk.unit()),
                // Both controls include it, and make the same of the same word.
                None if *from && *to => {}
                None => refused = true,
            }
        }
        if refused { Err(()) } else { Ok(()) }
    }
}
