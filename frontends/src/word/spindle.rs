//! What a speed counts, and its limit.

use ncc_dialects::{Meaning, Quantity};
use ncc_ir::canon::SpindleMode;
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, ONE, Unit};
use ncc_ir::program::Op;
use ncc_ir::unsupported::SpindleUnsupported;

use super::block_words::{Code, Words};
use super::lower::Lower;
use crate::batch::Batch;
use crate::common::Source;

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
            let what = SpindleUnsupported::SurfaceAxis.into();
            return self.fault(Fault::NotSupported { code: code_text, what }, code.span, out);
        }
        if let Some(letter) = code.row.limit {
            let word = words.take(letter as u8);
            if *self.limits.get_or_insert(word.is_some()) != word.is_some() {
                let what = SpindleUnsupported::SurfaceLimits.into();
                return self.fault(Fault::NotSupported { code: code_text, what }, code.span, out);
            }
            if let Some(word) = word
                && let Some(limit) = self.number(&word, Quantity::Speed, src, out)
            {
                self.push(word.span, Op::LimitSpindleSpeed(Expr::Num(limit)), out);
            }
        }
        self.push(code.span, Op::SetSpindleMode(SpindleMode::Surface), out);
    }

    /// Refuses a surface speed in a block that changes its unit, where that comes after feed and speed.
    pub(super) fn units_before_speed(&mut self, settings: &[Code], words: &Words, out: &mut Batch) {
        let surface = Meaning::SetSpindleMode(SpindleMode::Surface);
        let met = || self.limits.is_some() || settings.iter().any(|code| code.meaning == surface);
        if self.settings.dialect.block.feed_before_units
            && words.get(self.roles.speed).is_some()
            && let Some(code) = settings.iter().find(|c| matches!(c.meaning, Meaning::UseLengthUnits(_)))
            && met()
        {
            let what = SpindleUnsupported::SurfaceUnits.into();
            self.fault(Fault::NotSupported { code: code.row.code.as_str().into(), what }, code.span, out);
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
        if !self.stands_beside(code, functions, false, src, out) {
            return;
        }
        if self.has_axis_word(words) {
            let what = SpindleUnsupported::LimitAndAxes.into();
            b"XYZABC".iter().for_each(|letter| _ = words.take(*letter));
            _ = words.take(self.roles.speed);
            let code_text = code.row.code.as_str().into();
            return self.fault(Fault::NotSupported { code: code_text, what }, code.span, out);
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

    /// The words of a stop of the spindle: the angle, if one is stated.
    pub(super) fn orient_words(
        &mut self,
        code: &Code,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) -> Option<Num> {
        let rule = code.row.orient.as_ref()?;
        let code_text: Box<str> = code.row.code.as_str().into();
        let said = rule.angle.iter().find(|word| words.get(word.letter as u8).is_some()).copied();
        let option = self.settings.dialect.option.iter().find(|o| Some(&o.name) == rule.option.as_ref());
        if let (Some(said), Some(option)) = (said, option) {
            // The speed word is a speed on a machine where it is no angle.
            let chosen = self.settings.get(&option.name) == said.letter.to_string();
            if !chosen && said.letter as u8 == self.roles.speed {
                return None;
            }
            if !chosen {
                let option = option.name.as_str().into();
                let what = SpindleUnsupported::AngleByOption { letter: said.letter, option };
                self.fault(Fault::NotSupported { code: code_text, what: what.into() }, code.span, out);
                _ = words.take(said.letter as u8);
                return None;
            }
        }
        let missing = |letter: char| Fault::WordMissing {
            code: code.row.code.as_str().into(),
            word: letter.to_string().into(),
        };
        if let Some(wait) = rule.wait {
            let letter = if said.is_none() { rule.angle.first().map_or(wait, |w| w.letter) } else { wait };
            let Some(word) = words.take(wait as u8).filter(|_| said.is_some()) else {
                return self.refuse(missing(letter), code.span, out);
            };
            let seconds = self.number(&word, Quantity::Seconds, src, out)?;
            if seconds.mantissa <= 0 {
                return self.refuse(Fault::OutOfRange { word: src.text(word.span).into() }, word.span, out);
            }
        }
        if let Some(turn) = rule.turn
            && let Some(word) = words.take(turn as u8)
            && self.read_whole(&word, src, out)? != 0
        {
            let what = SpindleUnsupported::Direction.into();
            return self.refuse(Fault::NotSupported { code: src.text(word.span), what }, word.span, out);
        }
        let said = said?;
        let word = words.take(said.letter as u8)?;
        if self.settings.dialect.cycles.retained_by_all() {
            // The cycles have the letter too; whether theirs changes with it, no source tells.
            let what = SpindleUnsupported::AngleInCycle { letter: said.letter }.into();
            self.without_cycle(Fault::NotSupported { code: code_text, what }, word.span, out);
        }
        let mut angle = self.number(&word, said.quantity, src, out)?;
        angle.unit = Unit::Degree;
        if !angle.nanos(false).is_some_and(|nanos| (0..360 * ONE).contains(&nanos)) {
            return self.refuse(Fault::OutOfRange { word: src.text(word.span).into() }, word.span, out);
        }
        Some(angle)
    }
}
