//! `machine-moves`: moves in machine coordinates, and to reference points, in the target's form.
//!
//! One control measures machine coordinates with the tool length, another without it. The pass cancels the length
//! offset for such a move, and activates it again before the next move that needs it. Where no length is active, it
//! writes the other form. A return to machine zero becomes a move in machine coordinates, through its intermediate
//! point. Where the target's machine coordinates allow rapid moves only, a cut is written in the active work offset
//! (`machine_cuts`), which includes the tool length.
//!
//! Refused: a probing move of a kind that the target lacks; a move measured with a length, where the target's is
//! measured without, unless none is active; reference points that the target lacks; and Z after a reference point
//! return without a new length offset, where the target keeps the length for certain.

mod around;

use crate::frames::machine_cuts;
use crate::frames::origin_shift;
use crate::pass::{Moment, Pass, Step};
use crate::support::needs::{EDGE, LENGTH, MACHINE, TABLE};
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{Rebuild, at as at_place, is_absolute, traverse, unit_of};
use crate::target::Target;
use ncc_ir::canon::{Axis, Distance, Fact};
use ncc_ir::caps::{Caps, TiltForm};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Num;
use ncc_ir::lack::MachineLack;
use ncc_ir::program::arguments::words_of;
use ncc_ir::program::kinds::{flow, moves};
use ncc_ir::program::{
    Coord, Detour, Move, Op, Point, Probe, Program, Reference, ReferencePoint, Slot, Stmt,
};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "machine-moves",
    about: "moves in machine coordinates and to points of the machine in the target's form",
    alone: Some(run),
    step: Step::at(
        Moment::Placing,
        |_, p| p.needs(MACHINE),
        |l, p| {
            let found = p.diags.len();
            expand_machine_moves(
                p.stmts,
                &mut p.start.clone(),
                l.states.state_mut::<MachineMovesState>(),
                &l.target,
                p.diags,
            );
            let cut = p.diags[found..].iter().find(|d| matches!(d.fault, Fault::MachineCutExpanded { .. }));
            if let Some(at) = cut.map(|cut| cut.span) {
                origin_shift::take(l.states.state_mut::<origin_shift::OriginShiftState>(), at, p.diags);
            }
            p.needs |= l.lacks & (EDGE | TABLE | LENGTH);
        },
    ),
    program: &[],
    parametric: None,
};

/// What the pass remembers from piece to piece of a body.
#[derive(Clone, Debug, Default)]
pub(crate) struct MachineMovesState {
    /// The length that is active in the source and was put off in the target.
    put_off: Option<u32>,
    /// Words have cancelled it: the next Z takes it up.
    cancelled: bool,
    /// A return to a reference point that may have left none of the length.
    lost: Option<Span>,
    /// A move in machine coordinates comes next in this block, with the tool's length or without.
    machine: Option<Stmt>,
    /// A return by the intermediate point comes next in this block, in moves of its own.
    intermediate: Option<Stmt>,
    /// A return to a reference point became a rapid move where the active motion is the caller's.
    motion_lost: bool,
}

impl MachineMovesState {
    /// The refusal of a statement that moves Z by an increment, and applies the length which words have cancelled.
    fn refuses_increment(&self, stmt: &Stmt, walk: &Walk) -> Option<Diagnostic> {
        let word = words_of(&stmt.op).and_then(|to| to.get(Axis::Z))?;
        let takes_up = self.put_off.is_some() && self.cancelled;
        (takes_up && !is_absolute(word, walk.at.modes.distance))
            .then(|| Diagnostic::new(Fault::lacks(MachineLack::IncrementAfterMachineMove), stmt.span))
    }

    /// Whether something waits for the statements that come.
    pub(crate) fn is_busy(&self) -> bool {
        self.put_off.is_some()
            || self.lost.is_some()
            || self.machine.is_some()
            || self.intermediate.is_some()
            || self.motion_lost
    }
}

/// Brings the moves into the target's form.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| {
        expand_machine_moves(body, walk, &mut MachineMovesState::default(), target, diags)
    });
}

/// The same for one piece of a body.
pub(crate) fn expand_machine_moves(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    state: &mut MachineMovesState,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    let before = walk.at.modes.distance;
    let input = std::mem::take(body);
    let with_plane = retracts_with_plane(&input, &target.caps);
    let mut made = Rebuild::new(input.len() + 4);
    for (place, stmt) in input.into_iter().enumerate() {
        walk.enter(stmt.skip);
        if with_plane.get(place) == Some(&true) {
            walk.step(&stmt);
            made.push(stmt);
            continue;
        }
        take(stmt, walk, state, target, &mut made, diags);
    }
    *body = made.out;
    around::drop_distance_mode(body, before);
}

fn take(
    mut stmt: Stmt,
    walk: &mut Walk,
    state: &mut MachineMovesState,
    target: &Target,
    made: &mut Rebuild,
    diags: &mut Vec<Diagnostic>,
) {
    let caps = &target.caps;
    // The point by which a return goes is measured with the length.
    let by_z = matches!(&stmt.op, Op::GoToReference(reference) if reference.via.get(Axis::Z).is_some());
    if by_z {
        length_again(&mut stmt, state, made);
    }
    match &stmt.op {
        Op::Probe(probe) if !caps.moves.probes[Caps::probe(*probe)] => {
            let lack = match (probe.away, probe.error) {
                _ if caps.moves.probes == [false; 4] => MachineLack::Probing,
                (_, true) if caps.moves.probes[Caps::probe(Probe { error: false, ..*probe })] => {
                    MachineLack::ProbingWithError
                }
                (true, _) => MachineLack::ProbingAway,
                (false, _) => MachineLack::ProbingKind,
            };
            diags.push(Diagnostic::new(Fault::lacks(lack), stmt.span));
        }
        Op::Detour(Detour::OneSide) if !caps.moves.detours[Detour::OneSide as usize] => {
            diags.push(Diagnostic::new(Fault::lacks(MachineLack::OneSide), stmt.span));
        }
        Op::Detour(Detour::Intermediate) if !caps.moves.detours[Detour::Intermediate as usize] => {
            walk.step(&stmt);
            state.intermediate = Some(stmt);
            return;
        }
        Op::StraightTraverse(m) if state.intermediate.is_some() => {
            if let Some(detour) = state.intermediate.take() {
                stmt = by_intermediate(detour, m, walk, stmt.clone(), made, diags);
            }
        }
        Op::UseMachineCoordinates { length } if caps.machine.rapid || !caps.machine.length.says(*length) => {
            walk.step(&stmt);
            state.machine = Some(stmt);
            return;
        }
        Op::StraightTraverse(m) | Op::StraightFeed(m) if state.machine.is_some() => {
            let with_z = m.to.get(Axis::Z).is_some();
            let in_force = walk.at.modes.length_offset;
            if let Some(machine) = state.machine.take() {
                let length = matches!(machine.op, Op::UseMachineCoordinates { length: true });
                if caps.machine.rapid && matches!(stmt.op, Op::StraightFeed(_)) {
                    return cut(machine, stmt, walk, state, caps, made, diags);
                }
                if caps.machine.length.says(length) {
                    made.push(machine);
                } else {
                    in_other_form(machine, with_z, in_force, state, made, diags);
                }
            }
            walk.step(&stmt);
            return made.push(stmt);
        }
        Op::GoToReference(reference) => {
            let other = !caps.machine.references.has(reference.point)
                || !reference.via.is_empty() && !caps.machine.reference_via;
            if other {
                state.motion_lost |= walk.at.modes.motion.is_none();
                return by_machine_zero(stmt.clone(), reference, walk, state, target, made, diags);
            }
            let keeps = caps.machine.reference_length.or(reference.keeps_length);
            if reference.keeps_length && !keeps && reference.axes[Axis::Z as usize] {
                match walk.at.modes.length_offset {
                    Some(0) => {}
                    Some(entry) => (state.put_off, state.cancelled) = (Some(entry), false),
                    None => state.lost = state.lost.or(Some(stmt.span)),
                }
            }
            let reference = Reference { keeps_length: keeps, ..(**reference).clone() };
            walk.step(&stmt);
            return made.push(Stmt { op: Op::GoToReference(Box::new(reference)), ..stmt });
        }
        Op::Position(_) if state.motion_lost => {
            diags.push(Diagnostic::new(Fault::lacks(MachineLack::CallersMotionAfterReturn), stmt.span));
        }
        Op::UseToolLengthOffset(_)
        | Op::UseToolLength(_)
        | Op::UseToolEdge { .. }
        | Op::ProgramEnd
        | Op::BeginAgain => {
            (state.put_off, state.lost) = (None, None);
        }
        op if walk.commands_z(op) || matches!(op, Op::StartCycle(_) | Op::Pattern(_) | flow!()) => {
            diags.extend(state.refuses_increment(&stmt, walk));
            length_again(&mut stmt, state, made);
            if let Some(span) = state.lost.take() {
                diags.push(Diagnostic::new(Fault::lacks(MachineLack::LengthAfterReturn), span));
            }
        }
        _ => {}
    }
    state.motion_lost &= !(matches!(stmt.op, moves!()) && stmt.skip.is_none());
    walk.step(&stmt);
    made.push(stmt);
}

/// Says the length again that was put off, before a statement that needs it.
fn length_again(stmt: &mut Stmt, state: &mut MachineMovesState, made: &mut Rebuild) {
    let Some(entry) = state.put_off.take() else { return };
    let mut again = Stmt::new(stmt.span, Op::UseToolLengthOffset(Expr::int(i64::from(entry))));
    (again.skip, again.joined) = (stmt.skip, stmt.joined);
    again.number = stmt.number.take();
    stmt.joined = true;
    made.push(again);
}

/// Which moves to the machine's zero the target says with the word that sets a tilted plane in their block: along
/// Z, or along Z and then in its plane, and then the tool is turned.
fn retracts_with_plane(body: &[Stmt], caps: &Caps) -> Vec<bool> {
    let is_plane = |op: &Op| matches!(op, Op::SetSlot(slot) if matches!(**slot, Slot::Tilt(_)));
    if caps.frames.tilt != TiltForm::AxisByAxis || !body.iter().any(|stmt| is_plane(&stmt.op)) {
        return Vec::new();
    }
    let mut with_plane = vec![false; body.len()];
    for place in 0..body.len() {
        let Some(said) = retract(&body[place..]) else { continue };
        let behind = &body[place + said..];
        let joined = |at: usize| behind.get(at).filter(|s| s.joined && s.skip == body[place].skip);
        let turned = joined(1).is_some_and(|s| matches!(s.op, Op::OrientToolAxis(_)));
        if turned && joined(0).is_some_and(|s| is_plane(&s.op)) {
            with_plane[place..place + said].fill(true);
        }
    }
    with_plane
}

/// How many statements at the start are a retraction along Z, or along Z and then X and Y, in one block.
pub fn retract(stmts: &[Stmt]) -> Option<usize> {
    let along = |stmt: &Stmt| match &stmt.op {
        Op::GoToReference(to) if to.point == ReferencePoint::Home && to.via.is_empty() => Some(to.axes),
        _ => None,
    };
    let first = stmts.first()?;
    if along(first)? != [false, false, true, false, false, false] {
        return None;
    }
    let second = stmts.get(1).filter(|stmt| stmt.joined && stmt.skip == first.skip).and_then(along);
    Some(if second == Some([true, true, false, false, false, false]) { 2 } else { 1 })
}

/// A cut in machine coordinates as one of the active work offset, where it is measured with the tool's length.
fn cut(
    machine: Stmt,
    mut stmt: Stmt,
    walk: &mut Walk,
    state: &mut MachineMovesState,
    caps: &Caps,
    made: &mut Rebuild,
    diags: &mut Vec<Diagnostic>,
) {
    let (Op::StraightFeed(to), Op::UseMachineCoordinates { length }) = (&stmt.op, &machine.op) else {
        return made.push(stmt);
    };
    let aside = !length && walk.at.aside && [Axis::X, Axis::Y].iter().any(|axis| to.to.get(*axis).is_some());
    let said = match aside {
        true => Err(MachineLack::CutWithoutToolOffsets),
        false => machine_cuts::as_work(to, &walk.at, caps),
    };
    let with_z = to.to.get(Axis::Z).is_some();
    let (length, in_force) = (*length, walk.at.modes.length_offset);
    walk.step(&stmt);
    match said {
        Ok((to, offset)) => {
            diags.push(Diagnostic::new(Fault::MachineCutExpanded { offset }, stmt.span));
            stmt.op = Op::StraightFeed(to);
        }
        Err(lack) => diags.push(Diagnostic::new(Fault::lacks(lack), stmt.span)),
    }
    let (joined, number) = (machine.joined, machine.number);
    let off = !length && puts_off(with_z, in_force, state, stmt.span);
    if off {
        let mut none = Stmt::new(stmt.span, Op::UseToolLengthOffset(Expr::int(0)));
        (none.skip, none.joined, none.number) = (machine.skip, joined, number);
        made.push(none);
    } else {
        (stmt.joined, stmt.number) = (joined, number);
    }
    stmt.comment = stmt.comment.or(machine.comment);
    made.push(stmt);
}

/// The statement of machine coordinates in the other form; the move follows.
fn in_other_form(
    mut machine: Stmt,
    with_z: bool,
    in_force: Option<u32>,
    state: &mut MachineMovesState,
    made: &mut Rebuild,
    diags: &mut Vec<Diagnostic>,
) {
    let Op::UseMachineCoordinates { length } = machine.op else { return made.push(machine) };
    machine.op = Op::UseMachineCoordinates { length: !length };
    let none = in_force == Some(0) || state.put_off.is_some();
    if with_z && length && !none {
        diags.push(Diagnostic::new(Fault::lacks(MachineLack::WithToolLength), machine.span));
    }
    if !length && puts_off(with_z, in_force, state, machine.span) {
        let mut off = Stmt::new(machine.span, Op::UseToolLengthOffset(Expr::int(0)));
        off.skip = machine.skip;
        off.joined = machine.joined;
        off.number = machine.number.take();
        machine.joined = true;
        made.push(off);
    }
    made.push(machine);
}

/// Puts the tool's length off, if one may be active and a move of Z is measured without it.
fn puts_off(with_z: bool, in_force: Option<u32>, state: &mut MachineMovesState, at: Span) -> bool {
    let off = with_z && in_force != Some(0) && state.put_off.is_none();
    if off {
        match in_force {
            Some(entry) => (state.put_off, state.cancelled) = (Some(entry), true),
            None => state.lost = state.lost.or(Some(at)),
        }
    }
    off
}

/// The move to the intermediate point; what is left to be stated is the rest of the way, in a block of its own.
fn by_intermediate(
    detour: Stmt,
    to: &Move,
    walk: &mut Walk,
    mut rest: Stmt,
    made: &mut Rebuild,
    diags: &mut Vec<Diagnostic>,
) -> Stmt {
    let Some(points) = walk.at.intermediate(&to.to) else {
        diags.push(Diagnostic::new(Fault::lacks(MachineLack::IntermediatePointUnknown), detour.span));
        return rest;
    };
    let mut via = Point::default();
    for (axis, at) in Axis::ALL.into_iter().zip(points) {
        if let Some(at) = at {
            via.set(axis, at_place(at, axis, walk.unit()));
        }
    }
    let first = Stmt { op: traverse(via), comment: None, ..detour };
    walk.step(&first);
    made.push(first);
    (rest.joined, rest.number) = (false, None);
    rest
}

/// A move to the machine's zero as one in machine coordinates.
fn by_machine_zero(
    stmt: Stmt,
    reference: &Reference,
    walk: &mut Walk,
    state: &mut MachineMovesState,
    target: &Target,
    made: &mut Rebuild,
    diags: &mut Vec<Diagnostic>,
) {
    let mut cannot = |lack: MachineLack| {
        diags.push(Diagnostic::new(Fault::lacks(lack), stmt.span));
    };
    if reference.point != ReferencePoint::Home {
        cannot(match reference.point {
            ReferencePoint::Stored(_) => MachineLack::StoredPosition,
            _ => MachineLack::FurtherPoint,
        });
        return made.push(stmt);
    }
    if !target.caps.machine.coordinates {
        cannot(MachineLack::MachineZero);
        return made.push(stmt);
    }
    let in_force = walk.at.modes.length_offset;
    let with_z = reference.axes[Axis::Z as usize];
    if with_z && !reference.keeps_length && in_force != Some(0) {
        state.lost = Some(stmt.span);
    }
    let mut block = Stmt { comment: None, ..stmt.clone() };
    if !reference.via.is_empty() {
        block.op = Op::StraightTraverse(Move { to: reference.via.clone(), said: true });
        made.push(block.clone());
        block.number = None;
        block.joined = false;
    }
    let mut to = Point::default();
    for axis in Axis::ALL {
        if reference.axes[axis as usize] {
            let zero = Num::int(0, unit_of(axis, walk.unit()));
            to.set(axis, Coord { value: Expr::Num(zero), distance: Fact::Known(Distance::Absolute) });
        }
    }
    let own = target.caps.machine.length.or(false);
    let machine = Stmt { op: Op::UseMachineCoordinates { length: false }, ..block.clone() };
    if own {
        in_other_form(machine, with_z, in_force, state, made, diags);
    } else {
        made.push(machine);
    }
    let op = Op::StraightTraverse(Move { to, said: true });
    walk.step(&stmt);
    made.push(Stmt { op, joined: true, number: None, ..stmt });
}
