//! Parameters and expressions of a control with O words (LinuxCNC 2.9, gcode/overview.html).
//!
//! The grammar leaves a parameter as the text names it; which variable that is, or which value of the control's own,
//! is looked up here, by the dictionary. A local that may have no value yet is an error where it is read: one with
//! a name is so on the control, and a number holds what an earlier program has left in it.
//!
//! Not here: settings of parameters, and blocks that decide where the program goes (`o_words`).

use ncc_dialects::{MACHINE_UNITS, Quantity, SystemRow};
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::Fault;
use ncc_ir::expr::system::System;
use ncc_ir::expr::{Binary, Expr, Function, Many, Node, Numbers, Scope, Var};
use ncc_ir::source::Span;
use ncc_ir::unsupported::{Unsupported, ValueUnsupported};

use super::o_formula::node;
use crate::batch::Batch;
use crate::word::lower::Lower;

/// Parameters that belong to a call, and those that all programs have (overview, numbered parameters).
const LOCALS: u32 = 30;
const OWN: u32 = 5000;

/// To how many digits the number of a parameter, or a whole number, is looked at.
pub(in crate::word) const WHOLE_DIGITS: i64 = 4;

/// What a name of the text is.
pub(in crate::word) enum Named {
    Var(Var),
    /// A value of the control's own, or several that make one.
    Value(Expr),
}

impl Lower {
    /// Puts variables and values of the control in where an expression has parameters. Reports what is refused.
    pub(in crate::word) fn parameters(&mut self, expr: &mut Expr, at: Span, out: &mut Batch) {
        let Expr::Node(inner) = expr else { return };
        match &mut **inner {
            Node::Var(Var::System(System::Other(name))) if name.starts_with('#') => {
                let name = name.clone();
                let Some(found) = self.named(&name, at, out) else { return };
                *expr = match found {
                    Named::Value(value) => value,
                    Named::Var(var) if self.o.given.has(&var) => node(Node::Var(var)),
                    Named::Var(var) => node(Node::Call(Function::Given, vec![node(Node::Var(var))])),
                };
            }
            Node::Binary(Binary::NotEqual, Expr::Node(left), Expr::Node(right))
                if matches!(**right, Node::Vacant) =>
            {
                let Node::Var(Var::System(System::Other(name))) = &**left else { return };
                let name = name.clone();
                match self.named(&name, at, out) {
                    Some(Named::Var(var)) => **left = Node::Var(var),
                    Some(Named::Value(_)) => *expr = Expr::int(1),
                    None => {}
                }
            }
            Node::Element(element) => {
                self.no_place_here(element, at, out);
                element.of = Many::Numbered(numbers());
                for index in &mut element.at {
                    self.parameters(index, at, out);
                    let whole = std::mem::replace(index, Expr::int(0));
                    *index = node(Node::Call(Function::RoundTo, vec![whole, Expr::int(WHOLE_DIGITS)]));
                }
                let element = std::mem::replace(expr, Expr::int(0));
                *expr = match self.o.given.numbered {
                    true => element,
                    false => node(Node::Call(Function::Given, vec![element])),
                };
            }
            _ => expr.parts_mut().for_each(|part| self.parameters(part, at, out)),
        }
    }

    /// What a parameter is by the text's name of it, `#31` or `#<_x>`; `None` is refused (reported).
    pub(in crate::word) fn named(&mut self, name: &str, at: Span, out: &mut Batch) -> Option<Named> {
        let refuse = |lower: &mut Lower, what: Unsupported, out: &mut Batch| {
            let fault = Fault::not_supported(name, what);
            lower.refuse(fault, at, out)
        };
        let bare = name.trim_start_matches('#');
        if let Some(word) = bare.strip_prefix('<').and_then(|word| word.strip_suffix('>')) {
            if !word.starts_with('_') {
                if self.o.numbered_program {
                    return refuse(self, ValueUnsupported::LocalInNumbered.into(), out);
                }
                return Some(Named::Var(Var::Local(word.into())));
            }
            if word.starts_with("_ini[") || word.starts_with("_hal[") {
                return refuse(self, ValueUnsupported::MachineValue.into(), out);
            }
            let row = self.settings.dialect.system.iter().find(|row| row.name == word);
            let Some(row) = row else { return Some(Named::Var(Var::Common(word.into()))) };
            return match self.value_of(row, 0, at, out) {
                Some(value) => Some(Named::Value(value)),
                None => refuse(self, Unsupported::named(row.refuse.as_deref().unwrap_or_default()), out),
            };
        }
        let number: u32 = bare.parse().ok()?;
        if number <= OWN {
            return Some(Named::Var(parameter(bare)));
        }
        let rows = &self.settings.dialect.system;
        let row = rows.iter().find(|row| row.numbers().contains(&number));
        let Some(row) = row else {
            return self.refuse(Fault::OutOfRange { word: name.into() }, at, out);
        };
        match self.value_of(row, number - row.number, at, out) {
            Some(value) => Some(Named::Value(value)),
            None => refuse(self, Unsupported::named(row.refuse.as_deref().unwrap_or_default()), out),
        }
    }

    /// The value of a row; of one that counts axes, along the one with this place.
    pub(in crate::word) fn value_of(
        &mut self,
        row: &SystemRow,
        place: u32,
        at: Span,
        out: &mut Batch,
    ) -> Option<Expr> {
        let unit =
            if row.machine_units { self.option(MACHINE_UNITS, at, out).to_owned() } else { String::new() };
        if row.zero {
            if self.assume && !std::mem::replace(&mut self.o.no_such_axes, true) {
                out.report(Fault::AssumedFact { fact: ControlFact::NoSuchAxes }, at);
            }
            return Some(Expr::int(0));
        }
        row.value(place, &unit)
    }

    /// The value of a word that is computed, as the quantity of its letter.
    pub(in crate::word) fn o_amount(
        &mut self,
        expr: &Expr,
        quantity: Quantity,
        at: Span,
        out: &mut Batch,
    ) -> Option<Expr> {
        out.whole = true;
        let mut expr = expr.clone();
        self.parameters(&mut expr, at, out);
        if let Quantity::Length | Quantity::Feed = quantity {
            self.units(at, out);
        }
        match quantity {
            Quantity::Integer => {
                let digits = Expr::int(WHOLE_DIGITS);
                Some(node(Node::Call(Function::RoundTo, vec![expr, digits])))
            }
            Quantity::Length | Quantity::Angle | Quantity::Feed | Quantity::Speed | Quantity::Seconds => {
                Some(self.written(expr, quantity, at, out))
            }
            Quantity::Milliseconds | Quantity::Factor => None,
        }
    }
}

/// A parameter of the program's own, by the digits of its number: those that live as long as a call come first.
pub(in crate::word) fn parameter(digits: &str) -> Var {
    match digits.parse::<u32>() {
        Ok(number) if number <= LOCALS => Var::Local(digits.into()),
        _ => Var::Common(digits.into()),
    }
}

/// All numbered parameters that a program may set.
pub(in crate::word) fn numbers() -> Box<[Numbers]> {
    let numbers = |scope, from, to| Numbers { scope, prefix: "".into(), from, to };
    Box::new([numbers(Scope::Local, 1, LOCALS), numbers(Scope::Common, LOCALS + 1, OWN)])
}

/// Whether an expression asks for a value of the control's own.
pub(in crate::word) fn asks(expr: &Expr) -> Option<&System> {
    if let Expr::Node(node) = expr
        && let Node::Var(Var::System(system)) = &**node
    {
        return Some(system);
    }
    expr.parts().find_map(asks)
}
