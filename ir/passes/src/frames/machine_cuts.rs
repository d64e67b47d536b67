//! Cuts in machine coordinates, for controls that go there rapidly alone; and back.
//!
//! In a work offset, a place of the machine is that place less the active offset and the one that counts in all of
//! them. A program can ask for both: they are data of the control, so that it does not matter how far it reads ahead
//! of the moves. For a target that cuts in machine coordinates, and cannot be asked for the common offset, such words
//! become those places again.
//!
//! Refused: a cut where a frame of the program may be active, or the work offset or the unit is not known, and
//! along axes whose offsets the target cannot be asked for. Not here: the tool's length, of which the cut is the
//! target's own (`machine_moves`).

use crate::pass::Pass;
use crate::support::mode_analysis::{self, Known};
use crate::support::write::exact;
use crate::values::variables::{round, rounded};
use ncc_ir::canon::{Axis, Distance, Fact, Units};
use ncc_ir::caps::Caps;
use ncc_ir::computed::computes::Computes;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::system::System;
use ncc_ir::expr::{Binary, Expr, Node, Unary, Var};
use ncc_ir::lack::MachineLack;
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Coord, Move, Op, Point, Program, Stmt};
use ncc_ir::source::Span;
use ncc_ir::track::{Shifted, Tracker};

/// This pass.
pub(crate) const PASS: Pass = Pass::parametric(
    "machine-cuts",
    "writes cuts in machine coordinates by work offsets that the program reads",
    |_, _| true,
    |program, own, found| read(program, &own.entry, own.caps, found),
);

/// Whether a target says cuts in machine coordinates in its work offsets.
pub(crate) fn in_work(caps: &Caps) -> bool {
    caps.machine.rapid
        && caps.flow.computes.as_ref().is_some_and(|target| asks(target, System::ExternalOffset(Axis::X)))
}

/// Whether straight blocks have such a cut, which a target of these capabilities computes.
pub fn computes(stmts: &[Stmt], caps: &Caps) -> bool {
    let cuts = |pair: &[Stmt]| match pair {
        [machine, cut] => {
            matches!(machine.op, Op::UseMachineCoordinates { .. }) && matches!(cut.op, Op::StraightFeed(_))
        }
        _ => false,
    };
    in_work(caps) && stmts.windows(2).any(cuts)
}

fn asks(target: &Computes, system: System) -> bool {
    target.system.contains(&system)
}

/// The words of a cut in machine coordinates as those of the active work offset; with its number.
///
/// # Errors
/// Why that cannot be stated.
pub(crate) fn as_work(to: &Move, at: &Tracker, caps: &Caps) -> Result<(Move, u16), MachineLack> {
    let target = caps.flow.computes.as_deref().filter(|_| in_work(caps));
    let target = target.ok_or(MachineLack::Cut)?;
    if has_frame(at) {
        return Err(MachineLack::CutUnderFrame);
    }
    if is_open_behind_a_rotation(&to.to, at) {
        return Err(MachineLack::CutAfterRotation);
    }
    let number = at.modes.work_offset.filter(|number| *number > 0);
    let number = number.ok_or(MachineLack::CutOffsetUnknown)?;
    let units = at.modes.units.ok_or(MachineLack::CutUnitUnknown)?;
    let mut made = to.clone();
    for axis in Axis::ALL {
        let Some(word) = &mut made.to.axes[axis as usize] else { continue };
        let offsets = offsets(axis, number);
        if !offsets.iter().all(|offset| asks(target, offset.clone())) {
            return Err(MachineLack::CutOffsetVariable);
        }
        let inch = units == Units::Inch && !axis.is_rotary();
        let place = match (&word.value, rounded(&word.value)) {
            (_, Some((inner, _))) => inner,
            (Expr::Num(n), None) => {
                let own = if inch { Unit::Inch } else { Unit::Mm };
                let exactly = |n: Num| Num { unit: Unit::One, point: true, ..n };
                match at.nanos(&word.value) {
                    _ if axis.is_rotary() || n.unit == Unit::Entry || n.unit == own => Expr::Num(exactly(*n)),
                    Some(nanos) => Expr::Num(exactly(exact(nanos, own))),
                    None => return Err(MachineLack::CutDigits),
                }
            }
            (value, None) => value.clone(),
        };
        let of = |offset| Expr::Node(Box::new(Node::Var(Var::System(offset))));
        let less = |from: Expr, offset| Expr::binary(Binary::Subtract, from, of(offset));
        // Nothing less an offset is written as the offset with its sign.
        let place = if place.literal().is_some_and(Num::is_zero) { Expr::int(0) } else { place };
        word.value = offsets.into_iter().fold(place, less);
        if target.rounds {
            round(&mut word.value, target.increments[usize::from(inch)]);
        }
    }
    Ok((made, number))
}

/// What lies between the machine's zero and that of a work offset: what counts in all of them, and its own.
fn offsets(axis: Axis, number: u16) -> [System; 2] {
    [System::ExternalOffset(axis), System::WorkOffset { number, axis, unit: None }]
}

/// Whether anything but a work offset may lie between the machine's zero and the program's.
fn has_frame(at: &Tracker) -> bool {
    let slots = at.turning != [false; 3] || at.local != Shifted::default();
    let chain = at.chained || at.chain_turned || at.chain != Shifted::default();
    slots || chain || at.tilted || at.compensated || at.modes.no_origin_shift != Some(true)
}

/// Whether a rotation was active before and the move leaves an axis of the plane out, of which it is not known since
/// where it stands: controls do not agree about it.
fn is_open_behind_a_rotation(to: &Point, at: &Tracker) -> bool {
    let Some(plane) = at.modes.plane.filter(|_| at.turned) else { return at.turned };
    let (first, second, _) = plane.axes();
    let moves = |axis: Axis| to.get(axis).is_some();
    let left_out = |axis: Axis| !moves(axis) && at.position[axis as usize].is_none();
    let plane = [first, second];
    plane.into_iter().any(moves) && plane.into_iter().any(left_out)
}

/// The words of a move as they were before the offsets were taken off them, whatever work offset that was; the move as
/// it is, if they were not.
pub(crate) fn without_offsets(op: &Op) -> Op {
    let Op::StraightFeed(to) = op else { return op.clone() };
    let mut made = to.clone();
    for axis in Axis::ALL {
        let Some(word) = &mut made.to.axes[axis as usize] else { continue };
        let Some((place, _, digits)) = place(&word.value, axis) else { return op.clone() };
        word.value = place;
        if let Some(digits) = digits {
            round(&mut word.value, digits);
        }
    }
    Op::StraightFeed(made)
}

/// What a word is of the machine, the number of the work offset that is taken off it, and the digits to which it is
/// rounded.
fn place(value: &Expr, axis: Axis) -> Option<(Expr, u16, Option<u8>)> {
    let (value, digits) = match rounded(value) {
        Some((inner, digits)) => (inner, Some(digits)),
        None => (value.clone(), None),
    };
    let (rest, own) = less(&value)?;
    let (mut place, common) = less(&rest)?;
    if let Expr::Node(node) = &place
        && let Node::Unary(Unary::Negate, Expr::Num(n)) = &**node
    {
        place = Expr::Num(Num { mantissa: n.mantissa.checked_neg()?, ..*n });
    }
    match own {
        System::WorkOffset { number, axis: along, unit: None }
            if along == axis && common == System::ExternalOffset(axis) =>
        {
            Some((place, number, digits))
        }
        _ => None,
    }
}

/// From what a value of the control is taken off, and which; with its sign alone it is taken off nothing.
fn less(value: &Expr) -> Option<(Expr, System)> {
    let Expr::Node(node) = value else { return None };
    let (from, off) = match &**node {
        Node::Binary(Binary::Subtract, from, off) => (from.clone(), off),
        Node::Unary(Unary::Negate, off) => (Expr::int(0), off),
        _ => return None,
    };
    match off {
        Expr::Node(off) => match &**off {
            Node::Var(Var::System(system)) => Some((from, system.clone())),
            _ => None,
        },
        Expr::Num(_) => None,
    }
}

/// Has words from which the active offsets are taken off say the place of the machine, for a target that can cut there
/// and cannot be asked for the common offset. `entry` is what holds where the program begins.
pub fn read(program: &mut Program, entry: &Tracker, caps: &Caps, diags: &mut Vec<Diagnostic>) {
    let asked =
        caps.flow.computes.as_ref().is_some_and(|target| asks(target, System::ExternalOffset(Axis::X)));
    if asked
        || caps.machine.rapid
        || !caps.machine.coordinates
        || !program.procedures.iter().any(|p| any(&p.body))
    {
        return;
    }
    let known = mode_analysis::run(&mut program.clone(), entry, false);
    for procedure in &mut program.procedures {
        settle_cuts(&mut procedure.body, &known, diags);
    }
}

/// Whether a body has such words.
fn any(body: &[Stmt]) -> bool {
    body.iter().any(|stmt| match &stmt.op {
        Op::Control(control) => control.bodies().any(|body| any(body)),
        op @ Op::StraightFeed(_) => without_offsets(op) != *op,
        _ => false,
    })
}

fn settle_cuts(body: &mut Vec<Stmt>, known: &Known, diags: &mut Vec<Diagnostic>) {
    let mut at: Option<Tracker> = None;
    let mut out = Vec::with_capacity(body.len());
    for mut stmt in std::mem::take(body) {
        if matches!(stmt.op, flow!()) {
            at = None;
            if let Op::Control(control) = &mut stmt.op {
                control.bodies_mut().for_each(|body| settle_cuts(body, known, diags));
            }
            out.push(stmt);
            continue;
        }
        let here = at.get_or_insert_with(|| known.before(&stmt).cloned().unwrap_or_else(Tracker::unknown));
        let made = match &stmt.op {
            Op::StraightFeed(to) => in_machine(to, here, stmt.span, diags),
            _ => None,
        };
        here.step(&stmt);
        if let Some(to) = made {
            let machine = Op::UseMachineCoordinates { length: true };
            out.push(Stmt { op: machine, comment: None, ..stmt.clone() });
            stmt = Stmt { op: Op::StraightFeed(to), joined: true, number: None, ..stmt };
        }
        out.push(stmt);
    }
    *body = out;
}

/// The words of a move as machine coordinates, if each of them is such a place less what lies between, here.
fn in_machine(to: &Move, at: &Tracker, span: Span, diags: &mut Vec<Diagnostic>) -> Option<Move> {
    if to.to.is_empty() || has_frame(at) {
        return None;
    }
    let mut made = Point::default();
    let mut coarse = None;
    let inch = at.modes.units? == Units::Inch;
    for axis in Axis::ALL {
        let Some(word) = &to.to.axes[axis as usize] else { continue };
        let (mut value, number, digits) = place(&word.value, axis)?;
        let absolute = word.distance.known().or(at.modes.distance) == Some(Distance::Absolute);
        if at.modes.work_offset != Some(number) || !absolute {
            return None;
        }
        let unit = match axis.is_rotary() {
            true => Unit::Degree,
            false if inch => Unit::Inch,
            false => Unit::Mm,
        };
        coarse = coarse.max(digits);
        match (&mut value, digits) {
            (Expr::Num(n), _) => n.unit = unit,
            (value, Some(digits)) => round(value, digits),
            (_, None) => {}
        }
        made.set(axis, Coord { value, distance: Fact::Known(Distance::Absolute) });
    }
    if let Some(digits) = coarse {
        diags.push(Diagnostic::new(Fault::MachineCutFolded { digits, inch }, span));
    }
    Some(Move { to: made, said: to.said })
}
