//! Variables of the control itself, by what they mean.
//!
//! A position in the workpiece's coordinates is where the last block ended: what is asked for while axes move is not
//! known, and a control stops reading ahead for it.
//!
//! Refused: all that has no row here, and positions where lengths count in inches.

use ncc_dialects::Quantity;
use ncc_ir::canon::{AXES, Axis, Units};
use ncc_ir::expr::system::System;
use ncc_ir::expr::{Node, Var};
use ncc_ir::program::{Data, DataMode, Op, Stmt, ToolValue};
use ncc_ir::source::Span;
use ncc_ir::unsupported::{TableUnsupported, ValueUnsupported};

use super::typed::{Kind, Typed};
use crate::batch::Batch;
use crate::common::Source;
use crate::siemens::lower::Lower;
use crate::siemens::siemens_state::ModalCall;
use crate::siemens::text::tree::{Address, Expr as Tree, Place, Value};

impl Lower {
    /// The value of a variable of the control.
    pub(in crate::siemens) fn of_control(
        &mut self,
        name: Span,
        place: &Place,
        src: Source,
        out: &mut Batch,
    ) -> Option<Typed> {
        let span = place.span;
        let name = src.text(name).to_ascii_uppercase();
        let rows = &self.settings.dialect.system;
        let found = rows
            .iter()
            .find_map(|row| Some((row, table_entry(&row.name, row.count, &name, place, self.worth, src)?)));
        let Some((row, (entry, axis))) = found else { return self.stated(place, src, out) };
        let entry = entry.map_or(String::new(), |entry| format!(".{entry}"));
        let along =
            axis.map_or(String::new(), |axis| format!(".{}", axis.letter().to_ascii_lowercase() as char));
        let system = System::named(&format!("{}{entry}{along}", row.means));
        let counted = matches!(system, System::Tool | System::WorkOffsetNumber);
        let kind = if counted { Kind::Int } else { Kind::Real };
        if !counted && self.units(span, out).known() == Some(Units::Inch) {
            self.not_supported(&name, ValueUnsupported::InInches, span, out);
            return None;
        }
        if system.is_place() {
            self.no_stale_offset(span, out);
        }
        out.whole = true;
        Some(Typed::new(Node::Var(Var::System(system)), kind))
    }

    /// A variable of the control of which the user states what it holds wherever the program reads it.
    fn stated(&mut self, place: &Place, src: Source, out: &mut Batch) -> Option<Typed> {
        let text = src.text(place.span);
        let name: String = text.chars().filter(|sign| !sign.is_whitespace()).collect();
        let name = name.to_ascii_uppercase();
        let elsewhere = &self.settings.dialect.program.variables_elsewhere;
        if elsewhere.iter().any(|row| row.name == name && !row.left_out) {
            out.whole = true;
            return Some(Typed::new(Node::Var(Var::Common(name.into())), Kind::Real));
        }
        self.not_supported(&text, ValueUnsupported::Control, place.span, out);
        None
    }

    /// What is to be in place before control divides, or anything moves.
    pub(in crate::siemens) fn no_stale_offset(&mut self, at: Span, out: &mut Batch) {
        if std::mem::take(&mut self.stale) {
            let what = TableUnsupported::OffsetNotCalled;
            self.not_supported("$P_UIFR", what, at, out);
        }
    }

    /// `$TC_DP3[5,1]=120.5`: a value of a tool, by its first edge. It counts from where the edge is activated the next
    /// time; what is in use is refused where it is executed.
    fn set_tool(
        &mut self,
        entry: u32,
        which: ToolValue,
        value: &Value,
        span: Span,
        src: Source,
        out: &mut Batch,
    ) {
        let Some(given) = self.constant(value, span, src, out) else { return };
        let Some(value) = self.amount(given, Quantity::Length, src, out) else { return };
        let data = Data::Tool { entry, which, added: false, kept: false, value };
        self.push(span, Op::SetData(Box::new(data)), out);
    }

    /// A variable of the control is set: `$P_UIFR[1,X,TR]=100`.
    pub(in crate::siemens) fn set_control(
        &mut self,
        place: &Place,
        value: &Value,
        span: Span,
        src: Source,
        out: &mut Batch,
    ) {
        let Address::System(name) = place.address else { return };
        let name = src.text(name).to_ascii_uppercase();
        let rows = self.settings.dialect.data.iter().filter(|row| row.is_variable());
        let mut found = rows.filter_map(|row| {
            Some((row, table_entry(&row.name, u32::from(row.count), &name, place, self.worth, src)?))
        });
        let (Some((row, (Some(entry), axis))), Value::Expr(_)) = (found.next(), value) else {
            return self.not_supported(&name, ValueUnsupported::ControlSet, span, out);
        };
        if self.state.cycle != ModalCall::None {
            let what = TableUnsupported::TableInCycle;
            return self.not_supported(&src.text(span), what, span, out);
        }
        if self.state.modes.units.value() == Some(Units::Inch) {
            let what = TableUnsupported::TableInInches;
            return self.not_supported(&src.text(span), what, span, out);
        }
        let (axis, offset) = match (axis, u16::try_from(entry), row.values.first()) {
            (Some(axis), Ok(offset), None) => (axis, offset),
            (None, _, Some(word)) => return self.set_tool(entry, word.of.into(), value, span, src, out),
            _ => return self.not_supported(&name, ValueUnsupported::ControlSet, span, out),
        };
        let quantity = if axis.is_rotary() { Quantity::Angle } else { Quantity::Length };
        let Some(given) = self.constant(value, span, src, out) else { return };
        let Some(value) = self.amount(given, quantity, src, out) else { return };
        // Values of one work offset that stand in one block are put in at once.
        let mark = self.now.mark;
        let last = self.target(out).get_mut(mark..).and_then(|block| block.last_mut());
        if let Some(Stmt { op: Op::SetData(data), .. }) = last
            && let Data::Offset { offset: same, mode: DataMode::Set, words, turn: None } = &mut **data
            && *same == offset
            && words[axis as usize].is_none()
        {
            words[axis as usize] = Some(value);
            return;
        }
        let mut words = [const { None }; AXES];
        words[axis as usize] = Some(value);
        let data = Data::Offset { offset, mode: DataMode::Set, words: Box::new(words), turn: None };
        // The one active counts as it was until it is activated again; by a computed number, it may be that one.
        self.stale |=
            self.worth.is_some() || self.state.modes.work_offset.value().is_none_or(|now| now == offset);
        self.stand.forget();
        self.push(span, Op::SetData(Box::new(data)), out);
    }
}

/// The entry and the axis of a variable, where it is the one that a row of the dictionary names: `$P_UIFR[#,@,TR]`.
/// Where the number of the entry is computed, it is what `worth` says.
pub(in crate::siemens) fn table_entry(
    row: &str,
    count: u32,
    name: &str,
    place: &Place,
    worth: Option<u32>,
    src: Source,
) -> Option<(Option<u32>, Option<Axis>)> {
    let (own, indices) = match row.split_once('[') {
        Some((own, rest)) => (own, rest.strip_suffix(']')?.split(',').collect()),
        None => (row, Vec::new()),
    };
    if own != name || indices.len() != place.index.len() {
        return None;
    }
    let (mut entry, mut axis) = (None, None);
    for (index, given) in indices.iter().zip(&place.index) {
        let given = given.as_ref()?;
        match *index {
            "#" => {
                let number = match given {
                    Tree::Number(..) => whole_literal(given),
                    _ => worth.map(i64::from),
                };
                let number = number.filter(|number| (1..=i64::from(count)).contains(number))?;
                entry = Some(u32::try_from(number).ok()?);
            }
            "@" => axis = Some(axis_of(Some(given))?),
            index => match index.parse::<i64>() {
                Ok(index) => drop(whole_literal(given).filter(|number| *number == index)?),
                Err(_) => match given {
                    Tree::Place(Place { address: Address::Name(what), .. })
                        if src.text(*what).eq_ignore_ascii_case(index) => {}
                    _ => return None,
                },
            },
        }
    }
    Some((entry, axis))
}

fn whole_literal(index: &Tree) -> Option<i64> {
    match index {
        Tree::Number(number, _) => (number.scale == 0).then_some(number.mantissa),
        _ => None,
    }
}

/// An axis as an index.
pub(in crate::siemens) fn axis_of(index: Option<&Tree>) -> Option<Axis> {
    match index? {
        Tree::Place(Place { address: Address::Letter(letter), extension: None, index, .. })
            if index.is_empty() =>
        {
            Axis::from_letter(*letter)
        }
        _ => None,
    }
}
