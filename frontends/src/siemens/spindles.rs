//! Spindles and tools that are named: the first spindle by its number, the master spindle, tools by name;
//! and words of the dictionary with arguments of their own.
//!
//! Refused: other spindles than the first, and tolerances of the path in the coding of older
//! controls.

use ncc_dialects::{Meaning, NameMeaning, NameRole, Role};
use ncc_ir::canon::AdviceKind;
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::Num;
use ncc_ir::program::{Advice, Op, Text};
use ncc_ir::source::Span;
use ncc_ir::unsupported::{CodeUnsupported, SpindleUnsupported, TableUnsupported};

use super::block_words::Words;
use super::lower::Lower;
use super::text::tree::{Address, Called, Expr, Place, Value};
use crate::batch::Batch;
use crate::common::Source;
use crate::common::known::Know;
use crate::common::number::unit_of;
use crate::common::text::decode;

/// The machine data that say which spindle the words without a number mean.
const MASTER: &str = "MD 20090 SPIND_DEF_MASTER_SPIND";

/// The word that makes a spindle the master spindle.
const SET_MASTER: &str = "SETMS";

/// Names of the stages of machining, in the order of [`AdviceKind::PathTolerance`]'s values, with the numbers
/// that stand for them.
const STAGES: [(&str, i64); 4] = [("_OFF", 0), ("_ROUGH", 3), ("_SEMIFIN", 2), ("_FINISH", 1)];

impl Lower {
    /// Whether a value is the name of a tool.
    pub(super) fn is_tool_name(&self, letter: u8, value: &Value) -> bool {
        let named = |row: &ncc_dialects::Address| row.role == Role::Tool && row.named;
        matches!(value, Value::Expr(Expr::Text(_)))
            && self.settings.dialect.address_row(letter).is_some_and(named)
    }

    /// Notes a tool's name; it is selected where tools are.
    pub(super) fn tool_name(
        &mut self,
        value: &Value,
        span: Span,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        let Value::Expr(Expr::Text(text)) = value else { return };
        let bytes = src.bytes(*text);
        if bytes.len() <= 2 || bytes[1..bytes.len() - 1].contains(&b'"') {
            return self.not_supported(&src.text(span), TableUnsupported::ToolName, span, out);
        }
        let number = self.settings.dialect.letter_for(Role::Tool).map_or(0, |letter| letter as u8);
        if words.get(number).is_some() || words.tool_name.replace(*text).is_some() {
            self.fault(Fault::WordTwice { letter: char::from(number) }, span, out);
        }
    }

    /// A tool by its name.
    pub(super) fn select_by_name(&mut self, text: Span, src: Source, out: &mut Batch) {
        self.state.modes.tool = Know::Said(None);
        let bytes = src.bytes(text);
        let name: Text = decode(bytes.get(1..bytes.len() - 1).unwrap_or_default());
        self.push(text, Op::SelectToolByName(name), out);
    }

    /// Which spindle the words without a number mean is assumed and reported once.
    pub(super) fn master_spindle(&mut self, at: Span, out: &mut Batch) {
        if self.first_time(MASTER) {
            out.report(Fault::AssumedFact { fact: ControlFact::MasterSpindle }, at);
        }
    }

    /// Whether a place is that of the first spindle, which is the master spindle: `SPOS[1]`, `LIMS[1]`.
    pub(super) fn is_first_spindle(&mut self, place: &Place, src: Source, out: &mut Batch) -> bool {
        let Address::Name(name) = place.address else { return false };
        let word = src.text(name).to_ascii_uppercase();
        let role = self.settings.dialect.name_row(&word).and_then(|row| row.role);
        let of_spindle = matches!(role, Some(NameRole::SpindleAngle | NameRole::SpindleLimit));
        let first = matches!(&place.index[..], [index] if number(Some(index)) == Some(1));
        if of_spindle && first {
            self.master_spindle(name, out);
        }
        of_spindle && first
    }

    /// Whether a word of the dictionary has arguments of its own.
    pub(super) fn is_word_with_arguments(&self, name: &str) -> bool {
        let row = self.settings.dialect.name_row(name);
        match row.and_then(|row| row.means) {
            _ if row.is_some_and(|row| row.arguments) => true,
            Some(NameMeaning::Code(Meaning::Advise(kind, None))) => kind == AdviceKind::PathTolerance,
            Some(NameMeaning::Code(Meaning::NoEffect)) => name == SET_MASTER,
            Some(NameMeaning::Code(Meaning::SetTilt | Meaning::UseToolCentrePoint(_))) => true,
            _ => false,
        }
    }

    /// Such a word.
    pub(super) fn word_with_arguments(&mut self, name: &str, called: &Called, src: Source, out: &mut Batch) {
        let arguments = called.arguments.as_deref().unwrap_or_default();
        let row = self.settings.dialect.name_row(name);
        if let Some(row) = row.filter(|row| row.arguments) {
            if self.first_time(&row.name) {
                out.report(Fault::AssumedNoEffect { code: row.name.as_str().into() }, called.span);
            }
            return self.push(called.span, Op::NoEffect(src.text(called.span)), out);
        }
        match row.and_then(|row| row.means) {
            Some(NameMeaning::Code(Meaning::SetTilt)) => {
                return self.swivel(name, called.span, arguments, src, out);
            }
            Some(NameMeaning::Code(Meaning::UseToolCentrePoint(on))) => {
                return self.transformation(name, called.span, on, arguments, out);
            }
            _ => {}
        }
        if name != SET_MASTER {
            return self.path_tolerance(name, called, arguments, src, out);
        }
        if !arguments.is_empty() && (arguments.len() > 1 || number(arguments.first()) != Some(1)) {
            return self.not_supported(
                &src.text(called.span),
                SpindleUnsupported::MasterSpindle,
                called.span,
                out,
            );
        }
        self.master_spindle(called.span, out);
        self.push(called.span, Op::NoEffect(name.into()), out);
    }

    /// `CYCLE832(0.05,_ROUGH)`; without arguments it is off.
    fn path_tolerance(
        &mut self,
        name: &str,
        called: &Called,
        arguments: &[Option<Expr>],
        src: Source,
        out: &mut Batch,
    ) {
        let stage = match arguments.get(1) {
            None | Some(None) if arguments.is_empty() => Some(0),
            Some(Some(Expr::Place(place))) if place.extension.is_none() && place.index.is_empty() => {
                let stage = |name: Span| {
                    let text = src.text(name).to_ascii_uppercase();
                    STAGES.iter().position(|(own, _)| *own == text)
                };
                match place.address {
                    Address::Name(name) => stage(name),
                    Address::Letter(_) | Address::System(_) => None,
                }
            }
            stage @ Some(Some(_)) => {
                let stage = number(stage);
                STAGES.iter().position(|(_, own)| Some(*own) == stage)
            }
            None | Some(None) => None,
        };
        let Some(stage) = stage else {
            return self.not_supported(name, CodeUnsupported::ToleranceCoding, called.span, out);
        };
        let amount = match (arguments.first(), stage) {
            (_, 0) => None,
            (Some(Some(Expr::Number(digits, _))), _) if digits.mantissa > 0 => {
                let unit = unit_of(self.units(called.span, out));
                let num = Num { mantissa: digits.mantissa, scale: digits.scale, point: digits.point, unit };
                Some(ncc_ir::expr::Expr::Num(num))
            }
            _ => {
                return self.not_supported(name, CodeUnsupported::ToleranceWithoutValue, called.span, out);
            }
        };
        // A third argument of 1 says that the orientation of the tool is not meant.
        if arguments.len() > 3 || arguments.get(2).is_some_and(|a| a.is_some() && number(Some(a)) != Some(1))
        {
            return self.not_supported(name, CodeUnsupported::Tolerance, called.span, out);
        }
        let advice = Advice { kind: AdviceKind::PathTolerance, value: stage as u8, amount };
        self.push(called.span, Op::Advise(Box::new(advice)), out);
    }
}

/// A whole number that is an argument.
pub(super) fn number(argument: Option<&Option<Expr>>) -> Option<i64> {
    match argument {
        Some(Some(Expr::Number(digits, _))) if digits.scale == 0 => Some(digits.mantissa),
        _ => None,
    }
}
