//! Lowering of tool centre point control, and of tilted planes.
//!
//! Control of the tip is switched on by the code that takes the length up with it, and ended by the codes of
//! lengths; a tilted plane is ended by the code that ends a rotation of the same group. Where it is not known
//! whether either is on, such an end counts as one only if the text has switched it on before; switching it
//! on later is then refused. So are planes without all of their words.

use ncc_dialects::{Meaning, Quantity};
use ncc_ir::diag::Fault;
use ncc_ir::program::{FrameSlot, Op, Slot, Tilt};
use ncc_ir::source::Span;
use ncc_ir::unsupported::FrameUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::common::known::Know;
use crate::word::block_words::{Code, Words};
use crate::word::lower::Lower;

impl Lower {
    fn has(&self, meaning: Meaning) -> bool {
        self.settings.dialect.code_for(meaning).is_some()
    }

    /// Applies a length with control of the tip.
    pub(in crate::word) fn use_tip(&mut self, code: &Code, words: &mut Words, src: Source, out: &mut Batch) {
        let Some(word) = words.take(self.roles.length_entry) else {
            let word = char::from(self.roles.length_entry).to_string().into();
            let code_text = code.row.code.as_str().into();
            return self.fault(Fault::WordMissing { code: code_text, word }, code.span, out);
        };
        // The way to the end of its own block is not that of the tip.
        if b"ABC".iter().any(|letter| words.get(*letter).is_some()) {
            let what = FrameUnsupported::TcpAxes.into();
            let code_text = code.row.code.as_str().into();
            return self.fault(Fault::NotSupported { code: code_text, what }, code.span, out);
        }
        if !self.tip.starts() {
            return self.behind_an_end(code, out);
        }
        self.set_mode(code.meaning, out);
        self.push(code.span, Op::UseToolCentrePoint(true), out);
        self.length_offset(&word, code.span.to(word.span), words, src, out);
    }

    fn behind_an_end(&mut self, code: &Code, out: &mut Batch) {
        let what = FrameUnsupported::TcpAgain.into();
        self.fault(Fault::NotSupported { code: code.row.code.as_str().into(), what }, code.span, out);
    }

    /// A code of lengths ends control of the tip, if it is on.
    pub(in crate::word) fn end_tip(&mut self, span: Span, out: &mut Batch) {
        if self.has(Meaning::UseToolCentrePoint(true)) {
            if self.tip.ends(self.state.tip) {
                self.push(span, Op::UseToolCentrePoint(false), out);
            }
            self.state.tip = Know::Said(false);
        }
    }

    /// A tilted plane.
    pub(in crate::word) fn tilt(
        &mut self,
        code: &Code,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) -> Option<Op> {
        if !self.tilt.starts() {
            self.behind_an_end(code, out);
            return None;
        }
        let missing = |letter: u8| Fault::WordMissing {
            code: code.row.code.as_str().into(),
            word: letter_text(letter),
        };
        if let Some(letter) = b"XYZ".iter().find(|letter| words.get(**letter).is_none()) {
            return self.refuse(missing(*letter), code.span, out);
        }
        let origin = self.linear(words, src, out);
        let mut angles = [const { None }; 3];
        for (angle, letter) in angles.iter_mut().zip(code.row.words.bytes()) {
            let Some(word) = words.take(letter) else {
                return self.refuse(missing(letter), code.span, out);
            };
            *angle = self.amount(&word, Quantity::Angle, words, src, out);
        }
        let [Some(first), Some(second), Some(third)] = angles else { return None };
        self.set_mode(code.meaning, out);
        let about = code.row.turns_about()?;
        Some(Op::SetSlot(Box::new(Slot::Tilt(Box::new(Tilt {
            origin,
            about,
            angles: [first, second, third],
        })))))
    }

    /// The end of a rotation ends a tilted plane of its group; gives whether that is all it does.
    pub(in crate::word) fn end_tilt(&mut self, code: &Code, out: &mut Batch) -> bool {
        let row = self.settings.dialect.code_for(Meaning::SetTilt);
        if row.is_none_or(|row| row.group != code.row.group) {
            return false;
        }
        let alone = self.state.modes.tilt == Know::Said(true);
        if self.tilt.ends(self.state.modes.tilt) {
            self.push(code.span, Op::ClearFrame(FrameSlot::Tilt), out);
        }
        self.state.modes.tilt = Know::Said(false);
        // In a tilted plane there is no rotation.
        alone
    }

    /// The tool is turned upright on the plane.
    pub(in crate::word) fn upright(&mut self, code: &Code, words: &Words, out: &mut Batch) {
        if self.has_axis_word(words) {
            let what = FrameUnsupported::AxisWords.into();
            let code_text = code.row.code.as_str().into();
            return self.fault(Fault::NotSupported { code: code_text, what }, code.span, out);
        }
        self.push(code.span, Op::OrientToolAxis(None), out);
    }
}

fn letter_text(letter: u8) -> Box<str> {
    char::from(letter).to_string().into()
}
