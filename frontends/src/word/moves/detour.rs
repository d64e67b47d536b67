//! Lowering of rapid moves that are not straight: from one side, or by the intermediate point.
//!
//! Refused: incremental words of a return by the intermediate point, which count from there on some controls
//! and no diagnostic is reported here; both while a cycle or a thread is active, and under cutter radius compensation.

use ncc_dialects::Meaning;
use ncc_ir::canon::Distance;
use ncc_ir::diag::Fault;
use ncc_ir::program::{Detour, Move, Op};
use ncc_ir::source::Span;
use ncc_ir::unsupported::MoveUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::common::known::Know;
use crate::word::block_words::{Code, Words};
use crate::word::lower::Lower;

impl Lower {
    /// A block with the code of such a move.
    pub(in crate::word) fn by_detour(
        &mut self,
        code: &Code,
        block: Span,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        let Meaning::Detour(detour) = code.meaning else { return };
        let text = || code.row.code.as_str().into();
        let what = MoveUnsupported::DetourInCycle.into();
        self.without_cycle(Fault::NotSupported { code: text(), what }, code.span, out);
        let why = match () {
            () if self.state.compensated.value() == Some(true) => Some(MoveUnsupported::DetourCompensated),
            () if self.state.thread.is_some() => Some(MoveUnsupported::DetourInThread),
            () => None,
        };
        if let Some(what) = why {
            self.fault(Fault::NotSupported { code: text(), what: what.into() }, code.span, out);
        }
        let to = self.point(None, block, words, src, out);
        if to.is_empty() {
            let word = "X".into();
            return self.fault(Fault::WordMissing { code: text(), word }, code.span, out);
        }
        if detour == Detour::Intermediate && self.state.modes.distance.value() == Some(Distance::Incremental)
        {
            let what = MoveUnsupported::IntermediateIncrement.into();
            return self.fault(Fault::NotSupported { code: text(), what }, code.span, out);
        }
        self.push(code.span, Op::Detour(detour), out);
        self.push(block, Op::StraightTraverse(Move { to, said: true }), out);
        // From one side it may stay active. As the caller moves, no statement after this one can say.
        if detour == Detour::OneSide || self.state.modes.motion.value().is_none() {
            (self.state.modes.motion, self.state.no_motion) = (Know::Unsaid, true);
        }
    }
}
