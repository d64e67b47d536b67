//! Lowers spindle-synchronised moves: threads, and a tap that moves in and out in one block.
//!
//! ```text
//! G33 Z-10. F1.5    →    SYNCHRONISED_FEED to Z-10 with a lead of 1.5
//! ```
//!
//! It refuses threads along several axes or about a rotary axis, because their lead differs between controls. It also
//! refuses a lead without a decimal point where such numbers count increments. After a lead in the feed word, ncc
//! treats the feed as unknown. Not here: tapping cycles.

use ncc_dialects::{Bare, CodeRow, Meaning, Quantity, Thread};
use ncc_ir::canon::Axis;
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Num;
use ncc_ir::program::{Op, Pitch, Synchronised};
use ncc_ir::source::Span;
use ncc_ir::unsupported::MoveUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::common::known::Know;
use crate::common::words::{Value, Word};
use crate::word::block_words::{Code, Words, motion_of};
use crate::word::lower::Lower;
use crate::word::word_state::AxisWords;

impl Lower {
    /// Whether the feed word of the block is a lead.
    pub(in crate::word) fn is_lead(&self, motion: &[Code]) -> bool {
        let by_feed = |row: &CodeRow| row.words.bytes().next() == Some(self.roles.feed);
        let thread = motion.iter().find(|code| matches!(code.meaning, Meaning::SynchronisedFeed(_)));
        let ends = |code: &Code| {
            motion_of(code.meaning).is_some()
                || matches!(code.meaning, Meaning::StartCycle | Meaning::EndCycle)
        };
        match thread {
            Some(code) => by_feed(code.row),
            None => self.state.thread.is_some_and(by_feed) && !motion.iter().any(ends),
        }
    }

    /// Records the lead of the feed word. The feed is unknown afterwards.
    pub(in crate::word) fn lead(&mut self, word: &Word, src: Source, out: &mut Batch) {
        self.state.lead = self.lead_number(word, Quantity::Feed, src, out);
        self.state.modes.feed = Know::Unsaid;
    }

    fn lead_number(&mut self, word: &Word, quantity: Quantity, src: Source, out: &mut Batch) -> Option<Num> {
        let bare = matches!(word.value, Value::Number(d) if !d.point);
        if bare && self.settings.dialect.numbers(quantity).bare == Bare::Increments && !self.calculator {
            let what = MoveUnsupported::ThreadLead.into();
            return self.refuse(Fault::NotSupported { code: src.text(word.span), what }, word.span, out);
        }
        match self.number(word, quantity, src, out)? {
            num if num.mantissa > 0 => Some(num),
            _ => self.refuse(Fault::OutOfRange { word: src.text(word.span).into() }, word.span, out),
        }
    }

    /// Lowers a spindle-synchronised move. `row` is its code, `block` the span of its block.
    pub(in crate::word) fn thread(
        &mut self,
        row: &'static CodeRow,
        block: Span,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        let code: Box<str> = row.code.as_str().into();
        if self.state.words != AxisWords::Cartesian {
            let what = MoveUnsupported::ThreadPolar.into();
            return self.fault(Fault::NotSupported { code, what }, block, out);
        }
        let letter = row.words.bytes().next().unwrap_or(self.roles.feed);
        let lead = match words.take(letter) {
            Some(word) => self.lead_number(&word, Quantity::Length, src, out),
            None if letter == self.roles.feed => self.state.lead,
            None => None,
        };
        let to = self.point(None, block, words, src, out);
        let along: Vec<Axis> = Axis::ALL.into_iter().filter(|axis| to.get(*axis).is_some()).collect();
        if !matches!(along[..], [axis] if !axis.is_rotary()) {
            let what = MoveUnsupported::ThreadAxes.into();
            return self.fault(Fault::NotSupported { code, what }, block, out);
        }
        let Some(lead) = lead else {
            if !self.now.failed {
                let word = char::from(letter).to_string().into();
                self.fault(Fault::WordMissing { code, word }, block, out);
            }
            return;
        };
        let back = row.means == Some(Meaning::SynchronisedFeed(Thread::Back));
        let pitch = Pitch::Stated(Expr::Num(lead));
        let thread = Synchronised { to, pitch, chuck: false, turn: None, back };
        self.push(block, Op::SynchronisedFeed(Box::new(thread)), out);
    }
}
