//! Sorting of a block's words: codes and words of several letters, looked up in the dictionary and
//! put in the order in which their functions happen, and the addresses by their letters or names.
//!
//! What must not stand together, and what is no constant, is refused here. Not here: what the words
//! do.

use ncc_dialects::{NameMeaning, NameRole, Quantity, Role};
use ncc_ir::canon::{Distance, FeedMode, RotaryWay};
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::source::Span;
use ncc_ir::unsupported::left_out::LeftOut;
use ncc_ir::unsupported::{CodeUnsupported, Unsupported, ValueUnsupported};

use super::block_words::{Code, Given, Words};
use super::lower::Lower;
use super::text::letters::letter_for_zero;
use super::text::tree::{Address, Called, Expr, Item, Place, Qualifier, Value};
use crate::batch::Batch;
use crate::common::Source;
use crate::common::number::unit_of;
use crate::common::sort::{RANK_MOTION, rank};
use crate::common::words::{Value as Number, Word};

/// When a word's function happens within its block.
fn order(meaning: NameMeaning) -> u8 {
    match meaning {
        NameMeaning::Code(meaning) => rank(meaning),
        NameMeaning::SetFrame(_) | NameMeaning::AddFrame(_) | NameMeaning::ArcThrough => RANK_MOTION + 1,
        NameMeaning::ArcTangent => RANK_MOTION + 1,
        NameMeaning::CallModal
        | NameMeaning::Message
        | NameMeaning::RepeatBlocks
        | NameMeaning::RepeatBlock
        | NameMeaning::TurnRotaryAxis(_)
        | NameMeaning::EndOfRepeat => u8::MAX,
    }
}

impl Lower {
    /// Sorts the items of a block that the grammar has read.
    pub(super) fn sort_items(&mut self, items: &[Item], words: &mut Words, src: Source, out: &mut Batch) {
        for item in items {
            match item {
                Item::Word(word) => self.sort_word(word, words, src, out),
                Item::Set { place, value, span } => self.sort_set(place, value, *span, words, src, out),
                Item::Name(called) => self.sort_name(called, words, src, out),
            }
        }
        words.codes.sort_by_key(|c| order(c.meaning));
    }

    /// Sorts the words of a plain block, without its number.
    pub(super) fn sort_plain(&mut self, plain: &[Word], words: &mut Words, src: Source, out: &mut Batch) {
        for word in plain {
            self.sort_word(word, words, src, out);
        }
        words.codes.sort_by_key(|c| order(c.meaning));
    }

    fn sort_word(&mut self, word: &Word, words: &mut Words, src: Source, out: &mut Batch) {
        let Number::Number(digits) = word.value else {
            return;
        };
        let given = Given { digits, distance: None, way: None, computed: None, span: word.span };
        self.letter(word.letter, given, words, src, out);
    }

    fn letter(&mut self, letter: u8, given: Given, words: &mut Words, src: Source, out: &mut Batch) {
        if matches!(letter, b'G' | b'M') {
            return self.code(letter, given, words, src, out);
        }
        let place = usize::from(letter.wrapping_sub(b'A'));
        let Some(row) = self.settings.dialect.address_row(letter) else {
            self.now.refused = true;
            // `X1O.5`
            if let (b'O', Some(at)) = (letter, letter_for_zero(src, self.now.span)) {
                return self.fault(Fault::LetterOForZero, at, out);
            }
            return self.fault(Fault::UnknownCode { code: src.text(given.span) }, given.span, out);
        };
        let measured = matches!(row.role, Role::Axis | Role::CentreX | Role::CentreY | Role::CentreZ);
        if given.way.is_some() && !b"ABC".contains(&letter) {
            let what = CodeUnsupported::WayOfOtherWord.into();
            let code = src.text(given.span);
            return self.fault(Fault::NotSupported { code, what }, given.span, out);
        }
        if given.distance.is_some() && !measured {
            let what = CodeUnsupported::DistanceOfOtherWord.into();
            let code = src.text(given.span);
            return self.fault(Fault::NotSupported { code, what }, given.span, out);
        }
        if !row.sure && self.first_time(&row.letter.to_string()) {
            let (code, meaning) = (row.letter.to_string().into(), format!("{:?}", row.role).into());
            out.report(Fault::AssumedRow { code, meaning }, given.span);
        }
        if words.letters[place].replace(given).is_some() {
            self.fault(Fault::WordTwice { letter: char::from(letter) }, given.span, out);
        }
    }

    fn code(&mut self, letter: u8, given: Given, words: &mut Words, src: Source, out: &mut Batch) {
        let dialect = self.settings.dialect;
        if given.computed.is_some() {
            return self.not_supported(&src.text(given.span), CodeUnsupported::Computed, given.span, out);
        }
        let digits = given.digits;
        let whole = u32::try_from(digits.mantissa).ok().filter(|_| digits.scale == 0);
        let row = whole.and_then(|n| n.checked_mul(10)).and_then(|t| dialect.code_row(letter, t));
        if letter == b'M' {
            self.now.m_codes = self.now.m_codes.saturating_add(1);
            let limit = dialect.block.m_codes;
            if limit != 0 && self.now.m_codes == limit + 1 {
                self.fault(Fault::TooManyCodes { letter: 'M', limit }, given.span, out);
            }
        }
        let Some(row) = row else {
            self.now.refused = true;
            return self.fault(Fault::UnknownCode { code: src.text(given.span) }, given.span, out);
        };
        if digits.point || given.distance.is_some() {
            self.fault(Fault::PointNotAllowed { word: src.text(given.span) }, given.span, out);
        }
        let Some(meaning) = row.means else {
            let what = Unsupported::named(row.refuse.as_deref().unwrap_or_default());
            return self.not_supported(&row.code, what, given.span, out);
        };
        if let Some(other) = row.read_as.as_deref()
            && self.first_time(&row.code)
        {
            let what = LeftOut::ReadAs { code: row.code.as_str().into(), other: other.into() };
            out.report(Fault::CodeLeftOut { what }, given.span);
        }
        let code = Code {
            name: &row.code,
            meaning: NameMeaning::Code(meaning),
            group: &row.group,
            feed_stays: row.feed_stays,
            feed_mode: row.feed_mode.map(FeedMode::from),
            span: given.span,
        };
        self.add_code(code, row.sure, words, src, out);
    }

    fn add_code(&mut self, code: Code, sure: bool, words: &mut Words, src: Source, out: &mut Batch) {
        if let Some(other) = words.codes.iter().find(|c| !code.group.is_empty() && c.group == code.group) {
            let fault = Fault::CodesExclude { first: src.text(other.span), second: src.text(code.span) };
            self.now.failed = true;
            out.diagnostics.push(Diagnostic { fault, span: code.span, related: vec![other.span] });
        }
        if !sure && self.first_time(code.name) {
            let (name, meaning) = (code.name.into(), code.meaning.to_string().into());
            out.report(Fault::AssumedRow { code: name, meaning }, code.span);
        }
        words.codes.push(code);
    }

    /// Something with `=`.
    fn sort_set(
        &mut self,
        place: &Place,
        value: &Value,
        span: Span,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        if self.by_number(place, value, span, src, out) {
            return;
        }
        if self.is_variable(place, src) {
            return self.assign(place, value, span, src, out);
        }
        if !place.index.is_empty() && !self.is_first_spindle(place, src, out) {
            return match place.address {
                Address::Name(name) => self.refuse_name(name, span, src, out),
                Address::Letter(_) => self.not_supported(&src.text(span), CodeUnsupported::Index, span, out),
                Address::System(_) => self.set_control(place, value, span, src, out),
            };
        }
        let name: Box<str> = match (place.address, place.extension) {
            (Address::System(_), _) => return self.set_control(place, value, span, src, out),
            (Address::Letter(letter), None | Some(1)) if self.is_tool_name(letter, value) => {
                if place.extension.is_some() {
                    self.master_spindle(span, out);
                }
                return self.tool_name(value, span, words, src, out);
            }
            // The first spindle is the master spindle, which a word without a number means.
            (Address::Letter(letter @ (b'S' | b'M' | b'T')), Some(1)) => {
                self.master_spindle(span, out);
                return match self.constant(value, span, src, out) {
                    Some(given) => self.letter(letter, given, words, src, out),
                    None => self.now.refused = true,
                };
            }
            (Address::Letter(letter), None) => {
                return match self.constant(value, span, src, out) {
                    Some(given) => self.letter(letter, given, words, src, out),
                    None => self.now.refused = true,
                };
            }
            (Address::Letter(letter), Some(number)) => format!("{}{number}", char::from(letter)).into(),
            (Address::Name(name), _) => src.text(name).to_ascii_uppercase().into(),
        };
        let row = self.settings.dialect.name_row(&name);
        match (row.and_then(|row| row.role), place.address) {
            (Some(role), _) => {
                let Some(given) = self.constant(value, span, src, out) else {
                    self.now.refused = true;
                    return;
                };
                let through = matches!(
                    role,
                    NameRole::ThroughX
                        | NameRole::ThroughY
                        | NameRole::ThroughZ
                        | NameRole::PolarRadius
                        | NameRole::PolarAngle
                        | NameRole::LineAngle
                );
                // In which direction the spindle goes to where it stops cuts nothing, where it is the shortest.
                let stop = role == NameRole::SpindleAngle;
                if given.way.is_some_and(|way| !(stop && way == RotaryWay::Shortest)) {
                    let what = CodeUnsupported::WayOfOtherWord;
                    return self.not_supported(&src.text(span), what, span, out);
                }
                let absolute = stop && given.distance == Some(Distance::Absolute);
                if given.distance.is_some() && !through && !absolute {
                    let what = CodeUnsupported::DistanceOfOtherWord;
                    return self.not_supported(&src.text(span), what, span, out);
                }
                if words.named[role as usize].replace(given).is_some() {
                    let letter = name.chars().next().unwrap_or(' ');
                    self.fault(Fault::WordTwice { letter }, span, out);
                }
            }
            (None, Address::Name(name)) => {
                // What the dictionary does not have is a variable.
                match row {
                    Some(row) if row.zero_is_none && is_zero(value) => {
                        out.report(Fault::AssumedNoEffect { code: src.text(span) }, span);
                    }
                    Some(_) => self.refuse_name(name, span, src, out),
                    None => {
                        self.now.refused = true;
                        self.fault(Fault::MacroLanguage { what: src.text(span) }, span, out);
                    }
                }
            }
            (None, _) => {
                let kind = match place.address {
                    Address::Letter(b'S' | b'M') => CodeUnsupported::SpindleByNumber,
                    Address::Letter(b'T') => CodeUnsupported::ToolOfSpindle,
                    Address::Letter(b'H') => CodeUnsupported::AuxiliaryFunction,
                    _ => CodeUnsupported::AxisByNumber,
                };
                let row = self.settings.dialect.name_row(&name).and_then(|row| row.refuse.as_deref());
                let what = row.map_or(kind.into(), Unsupported::named);
                self.not_supported(&name, what, span, out);
            }
        }
    }

    /// A name of the dictionary that is refused, or has no business here.
    fn refuse_name(&mut self, name: Span, span: Span, src: Source, out: &mut Batch) {
        let text = src.text(name).to_ascii_uppercase();
        let row = self.settings.dialect.name_row(&text);
        match row.and_then(|row| row.refuse.as_deref()) {
            Some(refuse) => self.not_supported(&text, Unsupported::named(refuse), span, out),
            None => {
                self.now.refused = true;
                self.fault(Fault::MacroLanguage { what: src.text(span) }, span, out);
            }
        }
    }

    /// A word of several letters, alone or with arguments.
    fn sort_name(&mut self, called: &Called, words: &mut Words, src: Source, out: &mut Batch) {
        let text = src.text(called.name).to_ascii_uppercase();
        let Some(row) = self.settings.dialect.name_row(&text) else {
            self.now.refused = true;
            return self.fault(Fault::UnknownCode { code: text.into() }, called.span, out);
        };
        match (row.means, row.refuse.as_deref(), &called.arguments) {
            (Some(meaning), _, None) => {
                let (group, span) = (&*row.group, called.span);
                let code = Code { name: &row.name, meaning, group, feed_stays: false, feed_mode: None, span };
                self.add_code(code, row.sure, words, src, out);
            }
            (_, Some(_), Some(arguments)) if row.empty_brackets && arguments.is_empty() => {}
            (_, Some(refuse), _) => {
                self.not_supported(&row.name, Unsupported::named(refuse), called.span, out)
            }
            (_, None, Some(_)) => self.not_supported(&row.name, CodeUnsupported::Arguments, called.span, out),
            (None, None, None) => {
                let fault = Fault::WordMissing { code: row.name.as_str().into(), word: "=".into() };
                self.now.refused = true;
                self.fault(fault, called.span, out);
            }
        }
    }

    /// What stands after `=`: a constant, or what is computed.
    pub(super) fn constant(
        &mut self,
        value: &Value,
        span: Span,
        src: Source,
        out: &mut Batch,
    ) -> Option<Given> {
        let mut way = None;
        let (distance, expr) = match value {
            Value::Expr(expr) => (None, expr),
            Value::Qualified(Qualifier::Direct, expr) => {
                way = Some(RotaryWay::Shortest);
                (Some(Distance::Absolute), expr)
            }
            Value::Qualified(Qualifier::Positive, expr) => {
                way = Some(RotaryWay::Positive);
                (Some(Distance::Absolute), expr)
            }
            Value::Qualified(Qualifier::Negative, expr) => {
                way = Some(RotaryWay::Negative);
                (Some(Distance::Absolute), expr)
            }
            Value::Qualified(Qualifier::Absolute, expr) => (Some(Distance::Absolute), expr),
            Value::Qualified(Qualifier::Incremental, expr) => (Some(Distance::Incremental), expr),
            // The same function, without a wait for it.
            Value::Qualified(Qualifier::Quick, expr) if src.bytes(span).first() == Some(&b'M') => {
                if self.first_time("QU") {
                    out.report(Fault::AssumedFact { fact: ControlFact::QuickCode }, span);
                }
                (None, expr)
            }
            Value::Qualified(qualifier, _) => {
                let text = src.text(span);
                let word = text.split(['=', '(']).nth(1).unwrap_or_default().trim().to_ascii_uppercase();
                let row = self.settings.dialect.name_row(&word).and_then(|row| row.refuse.as_deref());
                let what = match qualifier {
                    Qualifier::Quick => CodeUnsupported::QuickFunction.into(),
                    _ => row.map_or(CodeUnsupported::CodedPosition.into(), Unsupported::named),
                };
                self.not_supported(&text, what, span, out);
                return None;
            }
            Value::List(_) => {
                return self.refuse(Fault::MacroLanguage { what: src.text(span) }, span, out);
            }
        };
        match expr {
            Expr::Number(digits, _) => Some(Given { digits: *digits, distance, way, computed: None, span }),
            Expr::Text(_) => {
                self.not_supported(&src.text(span), ValueUnsupported::Name, span, out);
                None
            }
            _ => {
                let typed = self.formula(expr, src, out)?;
                let given = self.given(typed, span);
                if way.is_some() && given.computed.is_some() {
                    let what = CodeUnsupported::ComputedTurn;
                    self.not_supported(&src.text(span), what, span, out);
                    return None;
                }
                Some(Given { distance, way, ..given })
            }
        }
    }

    /// The literal of an address or an argument; `None` if it is refused (reported).
    pub(super) fn number(
        &mut self,
        given: Given,
        quantity: Quantity,
        src: Source,
        out: &mut Batch,
    ) -> Option<Num> {
        let Given { digits, span, .. } = given;
        if given.computed.is_some() {
            self.not_supported(&src.text(span), CodeUnsupported::ComputedWord, span, out);
            return None;
        }
        if self.settings.dialect.numbers(quantity).unsigned && digits.mantissa < 0 {
            return self.refuse(Fault::OutOfRange { word: src.text(span).into() }, span, out);
        }
        let unit = match quantity {
            Quantity::Length => unit_of(self.units(span, out)),
            Quantity::Feed => self.feed_unit(span, out)?,
            Quantity::Angle => Unit::Degree,
            Quantity::Seconds | Quantity::Milliseconds => Unit::Second,
            Quantity::Speed | Quantity::Factor => Unit::One,
            Quantity::Integer => {
                if digits.point {
                    return self.refuse(Fault::PointNotAllowed { word: src.text(span) }, span, out);
                }
                Unit::One
            }
        };
        let num = Num { mantissa: digits.mantissa, scale: digits.scale, point: digits.point, unit };
        let plainly_in_range = num.mantissa.unsigned_abs() < 10_000_000 && num.scale <= 8;
        if !plainly_in_range && (num.nanos(false).is_none() || num.nanos(true).is_none()) {
            return self.refuse(Fault::OutOfRange { word: src.text(span).into() }, span, out);
        }
        Some(num)
    }

    /// A whole number, not negative.
    pub(super) fn read_whole(&mut self, given: Given, src: Source, out: &mut Batch) -> Option<u32> {
        let num = self.number(given, Quantity::Integer, src, out)?;
        match u32::try_from(num.mantissa) {
            Ok(whole) => Some(whole),
            Err(_) => self.refuse(Fault::OutOfRange { word: src.text(given.span).into() }, given.span, out),
        }
    }
}

/// Whether a value is the number 0, as it is written.
fn is_zero(value: &Value) -> bool {
    matches!(value, Value::Expr(Expr::Number(digits, _)) if digits.mantissa == 0)
}
