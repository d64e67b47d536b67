//! Variables of the control itself, by what they mean.
//!
//! A position in the workpiece's coordinates is where the last block ended: what is asked for while axes move is not
//! known, and a control stops reading ahead for it.
//!
//! Refused by name: all that has no row here, and positions where lengths count in inches.

use ncc_dialects::Quantity;
use ncc_ir::canon::{AXES, Axis, Units};
use ncc_ir::expr::{Node, Var};
use ncc_ir::program::{Data, DataMode, Op};
use ncc_ir::source::Span;
use ncc_ir::system::System;

use super::facts::InForce;
use super::formula::{Kind, Typed};
use super::lower::Lower;
use super::tree::{Address, Expr as Tree, Place, Value};
use crate::Batch;
use crate::word::Source;

/// The highest number of a work offset that stands in a variable: G599.
const LAST_OFFSET: i64 = 99;

impl Lower {
    /// The value of a variable of the control.
    pub(super) fn of_control(
        &mut self,
        name: Span,
        place: &Place,
        src: Source,
        out: &mut Batch,
    ) -> Option<Typed> {
        let span = place.span;
        let name = src.text(name).to_ascii_uppercase();
        let axis = match &place.index[..] {
            [index] => axis_of(index.as_ref()),
            _ => None,
        };
        // Siemens, list of system variables: programmed end point, actual value in workpiece and machine coordinates.
        let (system, kind) = match (name.as_str(), axis) {
            ("$P_EP" | "$AA_IW", Some(axis)) => (System::EndPoint(axis), Kind::Real),
            ("$AA_IM", Some(axis)) => (System::MachinePoint(axis), Kind::Real),
            ("$P_TOOLNO", None) if place.index.is_empty() => (System::Tool, Kind::Int),
            ("$P_UIFR", None) => match work_offset_of(place, src) {
                Some((number, axis)) => (System::WorkOffset { number, axis, unit: None }, Kind::Real),
                None => return self.no_meaning(&name, span, out),
            },
            _ => return self.no_meaning(&name, span, out),
        };
        let length = !matches!(system, System::Tool);
        if length && self.units(span, out).known() == Some(Units::Inch) {
            self.not_supported(&name, "position of the control where lengths count in inches", span, out);
            return None;
        }
        out.whole = true;
        Some(Typed::new(Node::Var(Var::System(system)), kind))
    }

    fn no_meaning(&mut self, name: &str, span: Span, out: &mut Batch) -> Option<Typed> {
        self.not_supported(name, "variable of the control", span, out);
        None
    }

    /// What is to be in place before control divides, or anything moves.
    pub(super) fn no_stale_offset(&mut self, at: Span, out: &mut Batch) {
        if std::mem::take(&mut self.stale) {
            let name = "work offset that may be in force, and is not called up again with its new value";
            self.not_supported("$P_UIFR", name, at, out);
        }
    }

    /// A variable of the control is set: `$P_UIFR[1,X,TR]=100`.
    pub(super) fn set_control(
        &mut self,
        place: &Place,
        value: &Value,
        span: Span,
        src: Source,
        out: &mut Batch,
    ) {
        let Address::System(name) = place.address else { return };
        let name = src.text(name).to_ascii_uppercase();
        let found = if name == "$P_UIFR" { work_offset_of(place, src) } else { None };
        let (Some((offset, axis)), Value::Expr(_)) = (found, value) else {
            return self.not_supported(&name, "variable of the control that is set", span, out);
        };
        if self.state.cycle != InForce::None {
            let name = "value of a work offset while a cycle is in force";
            return self.not_supported(&src.text(span), name, span, out);
        }
        let quantity = if axis.is_rotary() { Quantity::Angle } else { Quantity::Length };
        let Some(given) = self.constant(value, span, src, out) else { return };
        let Some(value) = self.amount(given, quantity, src, out) else { return };
        let mut words = [const { None }; AXES];
        words[axis as usize] = Some(value);
        let data = Data::Offset { offset, mode: DataMode::Set, words: Box::new(words), turn: None };
        // The one in force counts as it was until it is called up again.
        self.stale |= self.state.work_offset.value().is_none_or(|now| now == offset);
        self.stand.forget();
        self.push(span, Op::SetData(Box::new(data)), out);
    }
}

/// `[1,X,TR]`: a work offset and its axis.
fn work_offset_of(place: &Place, src: Source) -> Option<(u16, Axis)> {
    let [Some(Tree::Number(number, _)), axis, Some(Tree::Place(Place { address: Address::Name(what), .. }))] =
        &place.index[..]
    else {
        return None;
    };
    let whole = (1..=LAST_OFFSET).contains(&number.mantissa) && number.scale == 0;
    let shift = src.text(*what).eq_ignore_ascii_case("TR");
    let number = u16::try_from(number.mantissa).ok().filter(|_| whole && shift)?;
    Some((number, axis_of(axis.as_ref())?))
}

/// An axis as an index.
fn axis_of(index: Option<&Tree>) -> Option<Axis> {
    match index? {
        Tree::Place(Place { address: Address::Letter(letter), extension: None, index, .. })
            if index.is_empty() =>
        {
            Axis::from_letter(*letter)
        }
        _ => None,
    }
}
