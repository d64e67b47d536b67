//! A tool length that moves its axis at once, written with a word of that axis.
//!
//! ```text
//! G49                       G49 Z10.        of a control that moves Z by the length, which stands at Z10
//! G01 X10.          →       G01 X10.
//! ```
//!
//! The axis keeps its coordinate, so that the word is the one where it stands. At a place of the machine no length
//! counts: a cancelled one moves nothing there, and what another one moves to has no coordinate that is known.
//!
//! Not here: a control of which it is open ([`ncc_exec`] runs both), and a length that waits for the next word
//! (`offset_with_z`).

use crate::support::walk::Walk;
use crate::support::write::at;
use ncc_ir::behaviour::{Behaviour, Behaviours};
use ncc_ir::canon::{Axis, Distance, Motion, Units};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::Unit;
use ncc_ir::lack::LengthsLack;
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Move, Op, Point, Stmt};

/// Whether such moves are to be written, and where Z stands.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LengthMovesState {
    used: bool,
    z: Place,
}

/// Where Z stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Place {
    /// At a place of the machine: where the program starts, and after a return to a reference point.
    #[default]
    Machine,
    /// Where a word of the program has put it.
    Program,
    /// Control comes from elsewhere.
    Unknown,
}

impl LengthMovesState {
    pub(crate) fn new(source: &Behaviours, target: &Behaviours) -> LengthMovesState {
        let moves = Behaviour::LengthWithoutAxis;
        LengthMovesState { used: source.surely(moves) && !target.surely(moves), z: Place::Machine }
    }

    /// Whether the two controls differ.
    pub(crate) fn is_used(self) -> bool {
        self.used
    }

    /// Rewrites further statements, which are whole blocks.
    pub(crate) fn rewrite_moves(&mut self, stmts: &mut Vec<Stmt>, start: &Walk, diags: &mut Vec<Diagnostic>) {
        let mut walk = start.clone();
        let mut made: Vec<Stmt> = Vec::with_capacity(stmts.len() + 2);
        let mut rest = std::mem::take(stmts).into_iter().peekable();
        while let Some(first) = rest.next() {
            let mut block = vec![first];
            while let Some(next) = rest.next_if(|next| next.joined) {
                block.push(next);
            }
            if let Some(called) = block.iter().position(|stmt| stmt.op.calls_length())
                && !block.iter().any(|stmt| keeps_axis(&walk, &stmt.op))
            {
                let at = block[called].span;
                let fault = match self.write(&mut block, called, &walk) {
                    Ok(true) => Some(Fault::SideEffectWritten { behaviour: Behaviour::LengthWithoutAxis }),
                    Ok(false) => None,
                    Err(lack) => Some(Fault::lacks(lack)),
                };
                diags.extend(fault.map(|fault| Diagnostic::new(fault, at)));
            }
            for stmt in block {
                self.note(&walk, &stmt);
                walk.step(&stmt);
                made.push(stmt);
            }
        }
        *stmts = made;
    }

    /// Puts the word of the axis into a block that calls a length up; whether one is needed.
    ///
    /// # Errors
    /// What cannot be written.
    fn write(&self, block: &mut Vec<Stmt>, called: usize, walk: &Walk) -> Result<bool, LengthsLack> {
        let cancels = matches!(&block[called].op, Op::UseToolLengthOffset(entry)
            if entry.literal().is_some_and(|n| n.mantissa == 0));
        if self.z == Place::Machine {
            return match cancels {
                true => Ok(false),
                false => Err(LengthsLack::FromMachinePlace),
            };
        }
        let z = walk.at.position[Axis::Z as usize].filter(|_| self.z == Place::Program);
        let unit = match walk.at.modes.units {
            Some(Units::Inch) => Unit::Inch,
            Some(Units::Mm) => Unit::Mm,
            None => return Err(LengthsLack::UnitUnknown),
        };
        let (Some(z), Some(Distance::Absolute)) = (z, walk.at.modes.distance) else {
            return Err(LengthsLack::CoordinateUnknown);
        };
        let word = at(z, Axis::Z, unit);
        let motion = block.iter_mut().find_map(|stmt| match &mut stmt.op {
            Op::StraightTraverse(m) | Op::StraightFeed(m) => Some(m),
            _ => None,
        });
        if let Some(motion) = motion {
            motion.to.set(Axis::Z, word);
            return Ok(true);
        }
        let mut to = Point::default();
        to.set(Axis::Z, word);
        let to = Move { to, said: false };
        let op = match walk.at.modes.motion {
            Some(Motion::Traverse) => Op::StraightTraverse(to),
            Some(Motion::Feed) => Op::StraightFeed(to),
            Some(Motion::Arc(_) | Motion::Cycle) | None => {
                return Err(LengthsLack::UnderArcOrCycle);
            }
        };
        let stmt = Stmt { joined: true, skip: block[called].skip, ..Stmt::new(block[called].span, op) };
        block.insert(called + 1, stmt);
        Ok(true)
    }

    fn note(&mut self, walk: &Walk, stmt: &Stmt) {
        let z = match &stmt.op {
            Op::GoToReference(to) if to.axes[Axis::Z as usize] => Place::Machine,
            Op::StraightTraverse(m) if walk.at.raw && m.to.get(Axis::Z).is_some() => Place::Machine,
            Op::ChangeTool if walk.at.z_lost_at_change => Place::Machine,
            flow!() => Place::Unknown,
            op if walk.commands_z(op) => Place::Program,
            _ => return,
        };
        self.z = if stmt.skip.is_some() && z != self.z { Place::Unknown } else { z };
    }
}

/// Whether a block with this operation leaves nothing for a length to move.
fn keeps_axis(walk: &Walk, op: &Op) -> bool {
    let machine = matches!(op, Op::GoToReference(_) | Op::UseMachineCoordinates { .. } | Op::Detour(_));
    machine || matches!(op, Op::StartCycle(_) | Op::UseToolCentrePoint(_)) || walk.commands_z(op)
}
