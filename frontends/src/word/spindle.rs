//! What a speed counts, and its limit.

use ncc_dialects::{Meaning, Quantity};
use ncc_ir::canon::SpindleMode;
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::program::Op;

use super::Source;
use super::lower::Lower;
use super::sort::{Code, Words, motion_of};
use crate::Batch;

/// The option that says whose coordinate is the radius of a surface speed.
const AXIS: &str = "surface_axis";

impl Lower {
    /// A code by which the speed of its block is a surface's.
    pub(super) fn surface_speed(&mut self, code: &Code, words: &mut Words, src: Source, out: &mut Batch) {
        let code_text: Box<str> = code.row.code.as_str().into();
        if words.get(self.roles.speed).is_none() {
            let word = char::from(self.roles.speed).to_string().into();
            return self.fault(Fault::WordMissing { code: code_text, word }, code.span, out);
        }
        let asked = self.settings.dialect.option.iter().any(|option| option.name == AXIS);
        if asked && self.option(AXIS, code.span, out) != "X" {
            let name = "constant surface speed about another axis than X".into();
            return self.fault(Fault::NotSupported { code: code_text, name }, code.span, out);
        }
        if let Some(letter) = code.row.limit {
            let word = words.take(letter as u8);
            if *self.limits.get_or_insert(word.is_some()) != word.is_some() {
                let name = "surface speeds with and without a limit".into();
                return self.fault(Fault::NotSupported { code: code_text, name }, code.span, out);
            }
            if let Some(word) = word
                && let Some(limit) = self.number(&word, Quantity::Speed, src, out)
            {
                self.push(word.span, Op::LimitSpindleSpeed(Expr::Num(limit)), out);
            }
        }
        self.push(code.span, Op::SetSpindleMode(SpindleMode::Surface), out);
    }

    /// Refuses a surface speed in a block that changes its unit, where that comes behind feed and speed.
    pub(super) fn units_before_speed(&mut self, settings: &[Code], words: &Words, out: &mut Batch) {
        let surface = Meaning::SetSpindleMode(SpindleMode::Surface);
        let met = || self.limits.is_some() || settings.iter().any(|code| code.meaning == surface);
        if self.settings.dialect.block.feed_before_units
            && words.get(self.roles.speed).is_some()
            && let Some(code) = settings.iter().find(|c| matches!(c.meaning, Meaning::UseLengthUnits(_)))
            && met()
        {
            let name = "units in the block of a surface speed".into();
            self.fault(Fault::NotSupported { code: code.row.code.as_str().into(), name }, code.span, out);
        }
    }

    /// The speed word beside the code is the highest speed of the spindle.
    pub(super) fn speed_limit(
        &mut self,
        code: &Code,
        functions: &[Code],
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        let own = |c: &Code| c.span.start == code.span.start || c.row.code.starts_with('M');
        if let Some(other) = functions.iter().find(|c| !own(c) || motion_of(c.meaning).is_some()) {
            let fault = Fault::CodesExclude { first: src.text(code.span), second: src.text(other.span) };
            return self.fault(fault, other.span, out);
        }
        if self.has_axis_word(words) {
            let name = "coordinates and a limit of the spindle in one block".into();
            b"XYZABC".iter().for_each(|letter| _ = words.take(*letter));
            _ = words.take(self.roles.speed);
            let code_text = code.row.code.as_str().into();
            return self.fault(Fault::NotSupported { code: code_text, name }, code.span, out);
        }
        let Some(word) = words.take(self.roles.speed) else {
            let word = char::from(self.roles.speed).to_string().into();
            let code_text = code.row.code.as_str().into();
            return self.fault(Fault::WordMissing { code: code_text, word }, code.span, out);
        };
        if let Some(limit) = self.number(&word, Quantity::Speed, src, out) {
            self.push(code.span.to(word.span), Op::LimitSpindleSpeed(Expr::Num(limit)), out);
        }
    }
}
