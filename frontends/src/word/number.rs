//! Numbers of words: from digits to a literal with its unit, by the dictionary's number rules.
//!
//! A number without a decimal point is read by the dialect's rule, and a rule that is in doubt is
//! reported once for each kind of quantity. Nothing is rounded.

use ncc_dialects::{
    ARC_CENTRES, Bare, DECIMAL_POINT, FROM_START, FROM_ZERO, INTEGER_FEED, PointRule, Quantity,
};
use ncc_ir::canon::{Fact, Units};
use ncc_ir::diag::{Fault, ModeName};
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::CentreFrom;
use ncc_ir::source::Span;
use ncc_ir::unsupported::MoveUnsupported;

use super::lower::Lower;
use super::text_facts::OwnCentre;
use crate::batch::{BareNumber, Batch};
use crate::common::Source;
use crate::common::known::Know;
use crate::common::number::{spell, unit_of};
use crate::common::words::{Digits, Value, Word};

fn centre_open() -> Fault {
    let what = MoveUnsupported::CentreOfOtherBlocks.into();
    Fault::NotSupported { code: "I J K".into(), what }
}

/// Digits after the point that are kept of a length which may be in inches: a millionth of a micrometre is finer than
/// any control computes.
const FINEST: u8 = 8;

/// A number in digits.
fn spelled(num: Num) -> String {
    let digits = format!("{:0>width$}", num.mantissa.unsigned_abs(), width = usize::from(num.scale) + 1);
    let (whole, rest) = digits.split_at(digits.len() - usize::from(num.scale));
    let sign = if num.mantissa < 0 { "-" } else { "" };
    format!("{sign}{whole}.{rest}")
}

impl Lower {
    /// Whether a point after a whole number of this word is read; told, the first time.
    fn point_read(&mut self, word: &Word, src: Source, out: &mut Batch) -> bool {
        let Value::Number(Digits { mantissa, point: true, .. }) = word.value else { return false };
        let place = usize::from(word.letter.wrapping_sub(b'A'));
        let Some(row) = self.letters.get(place).copied().flatten().filter(|row| row.point_read) else {
            return false;
        };
        let told = self.reported.letters >> place & 1 == 1;
        if row.sure && self.assume && !told {
            self.reported.letters |= 1 << place;
            let meaning = format!("{}{mantissa}", row.letter).into();
            out.report(Fault::AssumedRow { code: src.text(word.span), meaning }, word.span);
        }
        true
    }

    /// The literal of a word; `None` if it is refused (reported), as what is computed is.
    pub(super) fn number(
        &mut self,
        word: &Word,
        quantity: Quantity,
        src: Source,
        out: &mut Batch,
    ) -> Option<Num> {
        let digits = match word.value {
            Value::Number(digits) => digits,
            Value::None => Digits { mantissa: 0, scale: 0, point: false },
            Value::Computed(_) => {
                return self.refuse(Fault::MacroLanguage { what: src.text(word.span) }, word.span, out);
            }
        };
        let rules = self.rules[quantity as usize];
        if rules.unsigned && digits.mantissa < 0 {
            return self.refuse(Fault::OutOfRange { word: src.text(word.span).into() }, word.span, out);
        }
        let (unit, units) = match quantity {
            Quantity::Length | Quantity::Feed => {
                let units = self.units(word.span, out);
                (unit_of(units), units)
            }
            Quantity::Angle => (Unit::Degree, Fact::Entry),
            Quantity::Seconds => (Unit::Second, Fact::Entry),
            Quantity::Factor => (Unit::One, Fact::Entry),
            Quantity::Speed | Quantity::Integer | Quantity::Milliseconds => {
                let whole = quantity != Quantity::Speed && digits.scale > 0;
                let read = digits.scale == 0 && self.point_read(word, src, out);
                if digits.point && (rules.point == PointRule::Never || whole) && !read {
                    return self.refuse(Fault::PointNotAllowed { word: src.text(word.span) }, word.span, out);
                }
                if quantity == Quantity::Milliseconds {
                    return Some(Num {
                        mantissa: digits.mantissa,
                        scale: 3,
                        point: true,
                        unit: Unit::Second,
                    });
                }
                (Unit::One, Fact::Entry)
            }
        };
        let mut num = Num { mantissa: digits.mantissa, scale: digits.scale, point: digits.point, unit };
        out.pointed |= self.watch && num.point && num.mantissa != 0 && quantity == Quantity::Length;
        if !num.point && num.mantissa != 0 {
            match rules.bare {
                Bare::Units => {}
                Bare::UnitsUnsure => self.assume_bare(word, num, quantity, src, out),
                Bare::Increments => {
                    let by_units = unit == Unit::Mm || unit == Unit::Inch || unit == Unit::Entry;
                    let shift = match rules.increment_inch.filter(|_| by_units) {
                        Some(inch) if inch != rules.increment => {
                            match self.units_of_increment(units, word.span, out)? {
                                Units::Mm => rules.increment,
                                Units::Inch => inch,
                            }
                        }
                        Some(_) | None => rules.increment,
                    };
                    if shift > 0 {
                        let timed = quantity == Quantity::Seconds;
                        if self.watch && !self.calculator && !timed {
                            let read = Num { scale: shift, point: true, ..num };
                            out.bare.push(BareNumber {
                                span: word.span,
                                read,
                                with_point: num,
                                feed: quantity == Quantity::Feed,
                            });
                        }
                        if !self.calculator || timed && !self.calculator_seconds {
                            num.scale = shift;
                            num.point = true;
                        }
                        let chosen = self.settings.is_chosen(DECIMAL_POINT);
                        if !chosen || self.settings.get(DECIMAL_POINT) == INTEGER_FEED {
                            self.assume_bare(word, num, quantity, src, out);
                        }
                    }
                }
            }
        }
        let plainly_in_range = num.mantissa.unsigned_abs() < 10_000_000 && num.scale <= 8;
        let in_range = |num: Num| num.nanos(false).is_some() && num.nanos(true).is_some();
        if !plainly_in_range && !in_range(num) {
            // Digits that no machine resolves: posts write them where they have computed in inches.
            let rounded = num.rounded(FINEST).trimmed();
            if self.settings.dialect.block.any_digits && num.scale > FINEST && in_range(rounded) {
                let written = format!("{}{}", char::from(word.letter), spelled(rounded)).into();
                out.report(Fault::Rounded { word: src.text(word.span), written }, word.span);
                return Some(Num { point: true, ..rounded });
            }
            return self.refuse(Fault::OutOfRange { word: src.text(word.span).into() }, word.span, out);
        }
        Some(num)
    }

    /// From where the words of an arc's centre are measured here; `None` if it is refused (reported).
    pub(super) fn centre_from(&mut self, at: Span, out: &mut Batch) -> Option<CentreFrom> {
        let dialect = self.settings.dialect;
        let Some(row) = &dialect.power_on.centre else {
            return Some(if dialect.arc.centre_absolute { CentreFrom::Zero } else { CentreFrom::Start });
        };
        match self.state.centre {
            Know::Said(from) | Know::Taken(from) => Some(from),
            Know::Unsaid => Some(self.centre_at_start(row.value.into(), at, out)),
            // Open here, but if the whole text says no other, it is what was stated on every path to here, or else that at
            // power-on.
            Know::Lost | Know::Open | Know::Callers => {
                let from = match self.state.centre_before {
                    Some(from) => from,
                    None => self.centre_at_start(row.value.into(), at, out),
                };
                let seen = &mut self.centre_seen;
                if let Some(own) = &mut seen.own {
                    own.relied.get_or_insert(at);
                    return Some(own.from);
                }
                if seen.said.iter().any(|said| *said != from) {
                    return self.refuse(centre_open(), at, out);
                }
                if !seen.relied.iter().any(|(other, _)| *other == from) {
                    seen.relied.push((from, at));
                }
                Some(from)
            }
        }
    }

    /// The same where it is settled, and nothing is to be reported of it.
    pub(super) fn settled_centre(&self) -> Option<CentreFrom> {
        let dialect = self.settings.dialect;
        let Some(row) = &dialect.power_on.centre else {
            return Some(if dialect.arc.centre_absolute { CentreFrom::Zero } else { CentreFrom::Start });
        };
        match self.state.centre {
            Know::Said(from) | Know::Taken(from) => Some(from),
            Know::Unsaid if self.option_is_told(ARC_CENTRES) => Some(match self.settings.get(ARC_CENTRES) {
                FROM_ZERO => CentreFrom::Zero,
                FROM_START => CentreFrom::Start,
                _ => row.value.into(),
            }),
            Know::Unsaid | Know::Lost | Know::Open | Know::Callers => None,
        }
    }

    /// From where they are measured by a program that has not said it.
    fn centre_at_start(&mut self, usual: CentreFrom, at: Span, out: &mut Batch) -> CentreFrom {
        match self.option(ARC_CENTRES, at, out) {
            FROM_ZERO => CentreFrom::Zero,
            FROM_START => CentreFrom::Start,
            _ => usual,
        }
    }

    /// The program says from where the words of a centre are measured.
    pub(super) fn set_centre_mode(&mut self, from: CentreFrom, out: &mut Batch) {
        (self.state.centre, self.state.centre_before) = (Know::Said(from), Some(from));
        // In no loop and no branch of a subprogram, every path comes by it.
        let surely = self.in_o_sub() && self.o.open.len() == 1 && self.now.skip.is_none();
        let seen = &mut self.centre_seen;
        let other = seen.own.take_if(|own| own.from != from);
        if let Some(at) = other.and_then(|own| own.relied) {
            out.report(centre_open(), at);
        }
        if surely && seen.own.is_none() {
            seen.own = Some(OwnCentre { from, relied: None });
        }
        if !seen.said.contains(&from) {
            seen.said.push(from);
        }
        for (_, at) in seen.relied.extract_if(.., |(other, _)| *other != from) {
            out.report(centre_open(), at);
        }
    }

    /// Another subprogram may say from where they are measured: it is called, or begins or ends here.
    pub(super) fn centre_said_elsewhere(&mut self, out: &mut Batch) {
        let within = self.o.open.len() > 1;
        if let Some(at) = self.centre_seen.own.take().and_then(|own| own.relied).filter(|_| within) {
            out.report(centre_open(), at);
        }
    }

    /// A whole number of a word, not negative.
    pub(super) fn read_whole(&mut self, word: &Word, src: Source, out: &mut Batch) -> Option<u32> {
        let num = self.number(word, Quantity::Integer, src, out)?.trimmed();
        match u32::try_from(num.mantissa) {
            Ok(whole) => Some(whole),
            Err(_) => self.refuse(Fault::OutOfRange { word: src.text(word.span).into() }, word.span, out),
        }
    }

    fn assume_bare(&mut self, word: &Word, num: Num, quantity: Quantity, src: Source, out: &mut Batch) {
        let bit = 1u8 << quantity as u8;
        if self.assume && self.reported.bare & bit == 0 {
            self.reported.bare |= bit;
            let value = spell(num).into();
            out.report(Fault::AssumedBareNumber { word: src.text(word.span), value }, word.span);
        }
    }

    /// The units whose increment a number without a point counts.
    pub(super) fn units_of_increment(
        &mut self,
        units: Fact<Units>,
        at: Span,
        out: &mut Batch,
    ) -> Option<Units> {
        // Open here, but if the whole text says only one kind of units, it is that one.
        let units = units.known().or_else(|| self.only_units.rely(None, at));
        units.or_else(|| self.refuse(Fault::EntryFactNeeded { fact: ModeName::Units }, at, out))
    }

    /// The program says units.
    pub(super) fn see_units(&mut self, units: Units, out: &mut Batch) {
        if let Some(at) = self.only_units.see(units) {
            out.report(Fault::EntryFactNeeded { fact: ModeName::Units }, at);
        }
    }
}
