//! Motion codes in a block without a move: `G1 F200`, then `N20 X5`.
//!
//! Usually the next move states the motion code. At a call, a jump target or a loop, ncc loses the active motion
//! code. Before such a block, this module adds a feed or rapid move without axis words, which keeps the code.
//! An arc cannot have such a move, because it needs a centre. So ncc refuses bare axis words after a lost arc code.
//!
//! Not here: the moves themselves (`motion`).

use ncc_dialects::Meaning;
use ncc_ir::canon::Motion;
use ncc_ir::diag::Fault;
use ncc_ir::program::{Move, Op, Point, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::unsupported::MoveUnsupported;

use crate::batch::Batch;
use crate::common::known::Know;
use crate::word::lower::Lower;
use crate::word::word_state::{CycleState, WordState};

impl Lower {
    /// Notes a motion code; `before` is the motion mode before its block.
    pub(in crate::word) fn said_motion(&mut self, motion: Motion, before: Know<Motion>, span: Span) {
        // A code that is already active needs no move.
        if self.motion_without_move.code.is_some() || before.value() != Some(motion) {
            self.motion_without_move.code = Some((span, motion));
        }
    }

    /// Clears the pending motion code if `op` is a move: the move states the code.
    pub(in crate::word) fn moved(&mut self, op: &Op) {
        let moves = matches!(
            op,
            Op::StraightTraverse(_)
                | Op::StraightFeed(_)
                | Op::SynchronisedFeed(_)
                | Op::ArcFeed(_)
                | Op::ArcForm(_)
                | Op::Polar(_)
        );
        if moves {
            self.motion_without_move.code = None;
        }
    }

    /// Loses all modes at a merge, a jump or a call.
    pub(in crate::word) fn lose_state(&mut self, out: &mut Batch) {
        self.leave_motion(None, out);
        self.carry_dwell(out);
        self.tap_elsewhere(out);
        self.state = if self.assume { self.state.at_merge() } else { WordState::lost() };
    }

    /// The dialect's code for rigid tapping; empty if it has none.
    pub(in crate::word) fn rigid_code(&self) -> Text {
        let row = self.settings.dialect.code_for(Meaning::RigidTapping);
        row.map_or("", |row| row.code.as_str()).into()
    }

    /// Refuses a call, a jump or a merge between the code for rigid tapping and its cycle.
    pub(in crate::word) fn tap_elsewhere(&mut self, out: &mut Batch) {
        if let Some(code) = self.state.rigid.filter(|_| !matches!(self.state.cycle, CycleState::Active(_))) {
            let fault = Fault::not_supported(self.rigid_code(), MoveUnsupported::RigidTappingFlow);
            self.fault(fault, code, out);
        }
    }

    /// Keeps a pending motion code before ncc loses the modes: adds a move without axis words, or notes a lost arc
    /// code. `skip` is the skip level of the code's block.
    pub(in crate::word) fn leave_motion(&mut self, skip: Option<u8>, out: &mut Batch) {
        let Some((span, motion)) = self.motion_without_move.code.take() else { return };
        let nowhere = Move { to: Point::default(), said: true };
        let op = match motion {
            Motion::Traverse => Op::StraightTraverse(nowhere),
            Motion::Feed => Op::StraightFeed(nowhere),
            Motion::Arc(_) | Motion::Cycle => {
                self.motion_without_move.lost.get_or_insert(span);
                return self.tell_motion(out);
            }
        };
        let stmts = self.target(out);
        match stmts.last_mut() {
            // The block of the code is otherwise empty: the move replaces its blank statement.
            Some(last) if last.op == Op::Blank && last.skip == skip => (last.op, last.span) = (op, span),
            _ => stmts.push(Stmt { span, number: None, skip, joined: false, comment: None, op }),
        }
    }

    /// Whether a motion code waits for its first move.
    pub(in crate::word) fn has_motion_without_move(&self) -> bool {
        self.motion_without_move.code.is_some()
    }

    /// Notes a block of axis words whose motion code is known only at run time.
    pub(in crate::word) fn bare_words(&mut self, block: Span, out: &mut Batch) {
        self.motion_without_move.bare.get_or_insert(block);
        self.tell_motion(out);
    }

    /// Whether another block of bare axis words would add nothing to the report.
    pub(in crate::word) fn position_is_told(&self) -> bool {
        let motion = &self.motion_without_move;
        motion.bare.is_some() && (motion.lost.is_none() || motion.reported)
    }

    fn tell_motion(&mut self, out: &mut Batch) {
        let (Some(code), Some(bare)) = (self.motion_without_move.lost, self.motion_without_move.bare) else {
            return;
        };
        if std::mem::replace(&mut self.motion_without_move.reported, true) {
            return;
        }
        let what = MoveUnsupported::MotionUnknown.into();
        let fault = Fault::NotSupported { code: "G".into(), what };
        out.diagnostics.push(ncc_ir::diag::Diagnostic { fault, span: bare, related: vec![code] });
        self.now.failed = true;
    }
}
