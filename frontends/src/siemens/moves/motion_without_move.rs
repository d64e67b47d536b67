//! A code of motion in a block without a move (`G1 F200`): nothing says it but the next move. Where what is active
//! is not known after it (after a call, at a label, a loop or a branch, at blocks that a switch may skip), axis words
//! alone do what is active when the program runs: before such a place a move to nowhere says it.
//!
//! Refused: an arc, or a thread, that is not said by a move before such a place. It has no way to nowhere.

use ncc_ir::program::{Move, Op, Stmt};
use ncc_ir::source::Span;
use ncc_ir::unsupported::MoveUnsupported;

use crate::batch::Batch;
use crate::common::known::Know;
use crate::siemens::lower::Lower;
use crate::siemens::siemens_state::{ModalCall, Motion};

impl Lower {
    /// Control leaves here, or may come here from elsewhere: what is active must have been stated.
    pub(in crate::siemens) fn leave_motion(&mut self, at: Span, out: &mut Batch) {
        if let Some(op) = self.untold_motion(at, out) {
            self.push(at, op, out);
        }
    }

    /// The same before a block that may be skipped begins.
    pub(in crate::siemens) fn leave_motion_before(&mut self, at: Span, out: &mut Batch) {
        let Some(op) = self.untold_motion(at, out) else { return };
        let stmts = self.target(out);
        match stmts.last_mut() {
            // The code's own block said nothing else.
            Some(last) if last.op == Op::Blank && last.skip.is_none() => last.op = op,
            _ => {
                let stmt = Stmt { span: at, number: None, skip: None, joined: false, comment: None, op };
                stmts.push(stmt);
            }
        }
    }

    fn untold_motion(&mut self, at: Span, out: &mut Batch) -> Option<Op> {
        let Know::Said(motion) = self.state.modes.motion else { return None };
        if self.moved == Some(motion) {
            return None;
        }
        if matches!(
            self.state.cycle,
            ModalCall::Active(_) | ModalCall::Inherited { .. } | ModalCall::Lost { .. }
        ) {
            // A move to nowhere would be one of its positions. Where they are reached in rapid, nothing is to be stated.
            if motion != Motion::Traverse && std::mem::take(&mut self.motion_without_move) {
                let what = MoveUnsupported::MotionUnderCycle;
                self.not_supported(word_of(motion), what, at, out);
            }
            return None;
        }
        let nowhere = Move { said: true, ..Move::default() };
        let op = match motion {
            Motion::Traverse => Op::StraightTraverse(nowhere),
            Motion::Feed => Op::StraightFeed(nowhere),
            Motion::Arc(_) | Motion::Through | Motion::Tangent | Motion::Thread(_) => {
                if std::mem::take(&mut self.motion_without_move) {
                    let what = MoveUnsupported::MotionUnused;
                    self.not_supported(word_of(motion), what, at, out);
                }
                return None;
            }
        };
        self.repeated_blocks.use_fact(crate::siemens::program::repeated_blocks::MOTION);
        self.moved = Some(motion);
        Some(op)
    }
}

/// The word of a motion.
fn word_of(motion: Motion) -> &'static str {
    match motion {
        Motion::Through => "CIP",
        Motion::Tangent => "CT",
        Motion::Arc(_) => "G2",
        Motion::Thread(_) => "G33",
        Motion::Traverse => "G0",
        Motion::Feed => "G1",
    }
}
