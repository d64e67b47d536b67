//! Texts: what text variables hold, texts that are joined and compared.
//!
//! A text variable is followed through the program text, and has its text as long as that is known: up to where
//! control may come from elsewhere, and beyond if it is not changed after that. A text that is known is a
//! constant; none is handed on.
//!
//! Refused: texts that are not known where they are used, that are longer than their variable, and comparisons
//! of texts that differ by small and capital letters alone.

use ncc_ir::program::Text;
use ncc_ir::source::Span;
use ncc_ir::unsupported::ValueUnsupported;

use super::typed::Kind;
use super::variables::Variable;
use crate::batch::Batch;
use crate::common::Source;
use crate::siemens::lower::Lower;
use crate::siemens::text::tree::{Address, Binary as Operator, Expr as Tree, Place, Unary, Value};

impl Lower {
    /// The name of a text variable.
    pub(in crate::siemens) fn text_variable(&self, place: &Place, src: Source) -> Option<String> {
        let Address::Name(name) = place.address else { return None };
        let name = src.text(name).to_ascii_uppercase();
        let variable = self.variables.get(&*name)?;
        (variable.kind == Kind::Text).then_some(name)
    }

    pub(in crate::siemens) fn set_text(
        &mut self,
        name: &str,
        value: &Value,
        span: Span,
        src: Source,
        out: &mut Batch,
    ) {
        let text = match value {
            Value::Expr(value) => self.known_text(value, src),
            Value::Qualified(..) | Value::List(_) => None,
        };
        let Some(text) = text else {
            return self.not_supported(&src.text(span), ValueUnsupported::TextJoined, span, out);
        };
        self.now.heading = true;
        let skipped = self.skipped();
        let Some(Variable { text: of, .. }) = self.variables.get_mut(name) else { return };
        let refuse = if of.relied.get() {
            Some(ValueUnsupported::TextChanged)
        } else if of.longest.is_some_and(|longest| text.chars().count() > longest) {
            Some(ValueUnsupported::TextLong)
        } else {
            None
        };
        // Up to there the text is gone through once, from block to block.
        of.first = (!skipped && !of.behind).then(|| text.clone());
        of.now = (!skipped).then_some(text);
        if let Some(refuse) = refuse {
            self.not_supported(&src.text(span), refuse, span, out);
        }
    }

    /// A text that is written, or that of a variable where it is known.
    pub(in crate::siemens) fn known_text(&self, value: &Tree, src: Source) -> Option<Text> {
        match value {
            Tree::Text(span) => Some(unquoted(src.bytes(*span))),
            Tree::Place(place) => {
                let of = &self.variables.get(&*self.text_variable(place, src)?)?.text;
                of.relied.set(of.relied.get() || of.behind);
                of.now.clone()
            }
            Tree::Group(inner, _) => self.known_text(inner, src),
            Tree::Unary(Unary::Show, part, _) => self.known_part(part, src),
            Tree::Binary(Operator::Join, parts) => {
                let [first, second] = [&parts.0, &parts.1].map(|part| self.known_part(part, src));
                Some(format!("{}{}", first?, second?).into())
            }
            _ => None,
        }
    }

    /// A part of a text that is put together: a whole number by its digits (Job planning 03/2006, 1.10).
    fn known_part(&self, part: &Tree, src: Source) -> Option<Text> {
        match part {
            Tree::Number(digits, _) if digits.scale == 0 && !digits.point => {
                Some(digits.mantissa.to_string().into())
            }
            part => self.known_text(part, src),
        }
    }

    /// Whether an expression is a text.
    pub(in crate::siemens) fn is_text(&self, value: &Tree, src: Source) -> bool {
        match value {
            Tree::Text(_) | Tree::Binary(Operator::Join, _) | Tree::Unary(Unary::Show, ..) => true,
            Tree::Place(place) => self.text_variable(place, src).is_some(),
            Tree::Group(inner, _) => self.is_text(inner, src),
            _ => false,
        }
    }

    /// Whether two texts are the same; outer `None` where neither is one, inner where that is not known (reported).
    #[allow(clippy::option_option)]
    pub(in crate::siemens) fn same_texts(
        &mut self,
        [a, b]: [&Tree; 2],
        span: Span,
        src: Source,
        out: &mut Batch,
    ) -> Option<Option<bool>> {
        if !self.is_text(a, src) && !self.is_text(b, src) {
            return None;
        }
        let known = (self.known_text(a, src), self.known_text(b, src));
        let refuse = match known {
            (Some(a), Some(b)) if a == b => return Some(Some(true)),
            (Some(a), Some(b)) if !a.eq_ignore_ascii_case(&b) => return Some(Some(false)),
            (Some(_), Some(_)) => ValueUnsupported::TextCase,
            _ => ValueUnsupported::TextsUnknown,
        };
        self.not_supported(&src.text(span), refuse, span, out);
        Some(None)
    }

    /// A jump goes past blocks, which may set texts.
    pub(in crate::siemens) fn texts_may_be_passed_over(&mut self) {
        self.variables.values_mut().for_each(|variable| variable.text.behind = true);
    }

    /// At a jump target, no text is known but those that have been what they are since before
    /// any such place.
    pub(in crate::siemens) fn forget_texts(&mut self) {
        for Variable { text, .. } in self.variables.values_mut() {
            text.now.clone_from(&text.first);
            text.behind = true;
        }
    }
}

/// A text without its quotes, blanks and all: UTF-8, else Latin-1.
pub(in crate::siemens) fn unquoted(bytes: &[u8]) -> Text {
    let inner = bytes.get(1..bytes.len().saturating_sub(1)).unwrap_or_default();
    let text = match std::str::from_utf8(inner) {
        Ok(text) => text.to_owned(),
        Err(_) => inner.iter().map(|&b| char::from(b)).collect(),
    };
    text.replace("\"\"", "\"").into()
}
