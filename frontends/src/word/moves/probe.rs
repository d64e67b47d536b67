//! Lowering of probing moves: straight at feed, until the probe triggers.
//!
//! What the control measures there, programs read from variables (`[[system]]` of the dictionary).
//!
//! Refused: under a cycle or cutter radius compensation, and bare axis words after a code that stays active,
//! which would probe again.

use ncc_dialects::Meaning;
use ncc_ir::diag::Fault;
use ncc_ir::program::{Move, Op};
use ncc_ir::source::Span;
use ncc_ir::unsupported::MoveUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::common::known::Know;
use crate::word::block_words::{Code, Words};
use crate::word::lower::Lower;

impl Lower {
    /// A block with the code of a probing move.
    pub(in crate::word) fn probe(
        &mut self,
        code: &Code,
        block: Span,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        let Meaning::StraightProbe(probe) = code.meaning else { return };
        let text = || code.row.code.as_str().into();
        let under = Fault::NotSupported { code: text(), what: MoveUnsupported::ProbingInCycle.into() };
        self.without_cycle(under, code.span, out);
        let why = match () {
            () if self.state.compensated.value() == Some(true) => Some(MoveUnsupported::ProbingCompensated),
            () if self.state.thread.is_some() => Some(MoveUnsupported::ProbingInThread),
            () => None,
        };
        if let Some(what) = why {
            self.fault(Fault::NotSupported { code: text(), what: what.into() }, code.span, out);
        }
        if code.row.own_feed && !self.now.fed {
            let word = char::from(self.roles.feed).to_string().into();
            return self.fault(Fault::WordMissing { code: text(), word }, code.span, out);
        }
        self.rely_on_feed(block, out);
        let to = self.point(None, block, words, src, out);
        if to.is_empty() {
            let word = "X".into();
            return self.fault(Fault::WordMissing { code: text(), word }, code.span, out);
        }
        self.push(code.span, Op::Probe(probe), out);
        self.push(block, Op::StraightFeed(Move { to, said: true }), out);
        let stays = self
            .settings
            .dialect
            .code
            .iter()
            .any(|row| row.means == Some(Meaning::StraightFeed) && row.group == code.row.group);
        // Bare axis words would probe again, or go on as the caller moves, which no statement after this
        // one can say.
        if stays || self.state.modes.motion.value().is_none() {
            (self.state.modes.motion, self.state.no_motion) = (Know::Unsaid, true);
        }
    }
}
