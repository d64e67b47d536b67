//! A code of motion in a block without a move (`G1 F200`): nothing says it but the next move. Where no fact is
//! known after it (after a call, at a block that can be jumped to, at a loop), axis words alone do what is active
//! when the program runs: before such a place a move to nowhere says it. An arc to nowhere has no centre;
//! axis words after its code are refused.

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
    /// A code of motion; `before` is what was known until then.
    pub(in crate::word) fn said_motion(&mut self, motion: Motion, before: Know<Motion>, span: Span) {
        // What is active already is stated.
        if self.motion_without_move.code.is_some() || before.value() != Some(motion) {
            self.motion_without_move.code = Some((span, motion));
        }
    }

    /// A move says it.
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

    /// All facts are lost, as control can come here from elsewhere, or goes there.
    pub(in crate::word) fn lose_state(&mut self, out: &mut Batch) {
        self.leave_motion(None, out);
        self.carry_dwell(out);
        self.tap_elsewhere(out);
        self.state = if self.assume { self.state.at_merge() } else { WordState::lost() };
    }

    /// The code for rigid tapping.
    pub(in crate::word) fn rigid_code(&self) -> Text {
        let row = self.settings.dialect.code_for(Meaning::RigidTapping);
        row.map_or("", |row| row.code.as_str()).into()
    }

    /// Control goes elsewhere between the code for rigid tapping and its cycle: nobody knows there that it is rigid.
    pub(in crate::word) fn tap_elsewhere(&mut self, out: &mut Batch) {
        if let Some(code) = self.state.rigid.filter(|_| !matches!(self.state.cycle, CycleState::Active(_))) {
            let fault = Fault::not_supported(self.rigid_code(), MoveUnsupported::RigidTappingFlow);
            self.fault(fault, code, out);
        }
    }

    /// The facts of motion are lost, or others than the next block may go on with them; `skip` is that of the code.
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
            // Its block said nothing else.
            Some(last) if last.op == Op::Blank && last.skip == skip => (last.op, last.span) = (op, span),
            _ => stmts.push(Stmt { span, number: None, skip, joined: false, comment: None, op }),
        }
    }

    /// Whether no move has said the code of motion yet.
    pub(in crate::word) fn has_motion_without_move(&self) -> bool {
        self.motion_without_move.code.is_some()
    }

    /// Axis words that do what is active when the program runs.
    pub(in crate::word) fn bare_words(&mut self, block: Span, out: &mut Batch) {
        self.motion_without_move.bare.get_or_insert(block);
        self.tell_motion(out);
    }

    /// Whether one that stands here adds nothing to what is reported of them.
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
