//! What words with expressions and assigned values are worth: their unit, their digits and their rounding.

use ncc_dialects::{ANGLE_RANGE, COMPUTED_DWELL, Operator, Quantity, RemainderRule};
use ncc_ir::canon::Units;
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::system::System;
use ncc_ir::expr::{Binary, Expr, Function, Node, Var};
use ncc_ir::source::Span;
use ncc_ir::unsupported::ValueUnsupported;

use super::has_round;
use crate::batch::Batch;
use crate::common::Source;
use crate::common::number::{spell, unit_of};
use crate::common::words::{Value, Word};
use crate::word::block_words::Words;
use crate::word::lower::Lower;

impl Lower {
    /// An expression outside words.
    pub(in crate::word) fn value(&mut self, expr: &Expr, at: Span, out: &mut Batch) -> Expr {
        let mut expr = expr.clone();
        self.mean(&mut expr, &|a| Node::Call(Function::Round, vec![a]), at, out);
        expr
    }

    /// A word's value, written or computed; `None` if it is refused (reported).
    pub(in crate::word) fn amount(
        &mut self,
        word: &Word,
        quantity: Quantity,
        words: &Words,
        src: Source,
        out: &mut Batch,
    ) -> Option<Expr> {
        let Value::Computed(place) = word.value else {
            return self.number(word, quantity, src, out).map(Expr::Num);
        };
        let mut expr = words.exprs[usize::from(place)].clone();
        if self.settings.dialect.program.o_words {
            let value = self.o_amount(&expr, quantity, word.span, out);
            return match value {
                Some(value) => Some(value),
                None => self.refuse(Fault::MacroLanguage { what: src.text(word.span) }, word.span, out),
            };
        }
        // Where a point tells what a dwell counts, what is computed has none.
        let quantity = match quantity {
            Quantity::Seconds if self.option(COMPUTED_DWELL, word.span, out) == "milliseconds" => {
                Quantity::Milliseconds
            }
            _ => quantity,
        };
        let digits = self.digits(word, quantity, src, out)?;
        out.whole = true;
        // The control rounds what an address gets to the least increment of it (16-C, custom macro, referencing
        // variables; 96-8000: three digits, four of inches), and so does ROUND within an address.
        let Some(digits) = digits else {
            if has_round(&expr) {
                return self.refuse(Fault::MacroLanguage { what: src.text(word.span) }, word.span, out);
            }
            self.mean(&mut expr, &|a| Node::Call(Function::Round, vec![a]), word.span, out);
            return Some(self.written(expr, quantity, word.span, out));
        };
        let counted = matches!(quantity, Quantity::Length | Quantity::Angle);
        if counted && self.assume && !std::mem::replace(&mut self.reported.increment, true) {
            let increment = spell(Num { mantissa: 1, scale: digits, point: true, unit: Unit::One }).into();
            out.report(Fault::AssumedFact { fact: ControlFact::WordIncrement { increment } }, word.span);
        }
        let rounded = |a| Node::Call(Function::RoundTo, vec![a, Expr::int(i64::from(digits))]);
        self.mean(&mut expr, &rounded, word.span, out);
        if let Expr::Num(num) = expr
            && quantity != Quantity::Milliseconds
        {
            return Some(self.written(Expr::Num(num.rounded(digits)), quantity, word.span, out));
        }
        let value = Expr::Node(Box::new(rounded(expr)));
        Some(match quantity {
            Quantity::Milliseconds => {
                Expr::Node(Box::new(Node::Binary(Binary::Divide, value, Expr::int(1000))))
            }
            _ => value,
        })
    }

    /// A number in brackets, `F[7]`, counts what one without them does, where it has a point.
    pub(in crate::word) fn written(
        &mut self,
        expr: Expr,
        quantity: Quantity,
        at: Span,
        out: &mut Batch,
    ) -> Expr {
        let Expr::Num(num) = expr else { return expr };
        let unit = match quantity {
            Quantity::Length | Quantity::Feed => unit_of(self.units(at, out)),
            Quantity::Angle => Unit::Degree,
            Quantity::Seconds | Quantity::Milliseconds => Unit::Second,
            Quantity::Speed | Quantity::Integer | Quantity::Factor => Unit::One,
        };
        Expr::Num(Num { point: num.point || unit != Unit::One, unit, ..num })
    }

    /// To how many digits a word of this quantity is rounded; none of a feed, whose increment is the machine's.
    fn digits(
        &mut self,
        word: &Word,
        quantity: Quantity,
        src: Source,
        out: &mut Batch,
    ) -> Option<Option<u8>> {
        let rules = self.rules[quantity as usize];
        Some(match quantity {
            Quantity::Length => Some(self.digits_of(quantity, word.span, out)?),
            Quantity::Angle | Quantity::Seconds => Some(rules.increment),
            Quantity::Feed => {
                self.units(word.span, out);
                None
            }
            Quantity::Speed | Quantity::Integer | Quantity::Milliseconds => Some(0),
            Quantity::Factor => {
                return self.refuse(Fault::MacroLanguage { what: src.text(word.span) }, word.span, out);
            }
        })
    }

    /// To how many digits a length is rounded, in the active units.
    pub(in crate::word) fn digits_of(&mut self, quantity: Quantity, at: Span, out: &mut Batch) -> Option<u8> {
        let rules = self.rules[quantity as usize];
        let units = self.units(at, out);
        debug_assert!(unit_of(units) != Unit::One);
        Some(match rules.increment_inch.filter(|inch| *inch != rules.increment) {
            None => rules.increment,
            Some(inch) => match self.units_of_increment(units, at, out)? {
                Units::Mm => rules.increment,
                Units::Inch => inch,
            },
        })
    }

    /// Puts in what `ROUND` means where an expression stands, and in which range angles are.
    fn mean(&mut self, expr: &mut Expr, round: &dyn Fn(Expr) -> Node, at: Span, out: &mut Batch) {
        let Expr::Node(node) = expr else { return };
        match &mut **node {
            Node::Var(Var::System(System::Other(name))) => {
                let name = name.clone();
                if let Some(value) = self.control_value(&name, at, out) {
                    *expr = value;
                }
            }
            Node::Var(_) | Node::Vacant | Node::Unary(..) | Node::Binary(..) => {
                if let Node::Binary(Binary::Modulo, a, b) = &**node
                    && self.settings.dialect.formula.remainders == RemainderRule::MadeWhole
                    && [a, b].iter().any(|e| e.literal().is_some_and(|n| n.whole_number().is_none()))
                {
                    let code = self.settings.dialect.formula.operators[&Operator::Modulo].as_str().into();
                    let what = ValueUnsupported::Remainder.into();
                    self.fault(Fault::NotSupported { code, what }, at, out);
                }
                let rules = &self.settings.dialect.formula;
                if matches!(**node, Node::Binary(Binary::Power, ..))
                    && !rules.power
                    && !rules.operators.contains_key(&Operator::Power)
                {
                    let fault =
                        Fault::NotSupported { code: "POW".into(), what: ValueUnsupported::Function.into() };
                    self.fault(fault, at, out);
                }
                expr.parts_mut().for_each(|part| self.mean(part, round, at, out));
            }
            Node::Element(element) => {
                self.no_place_here(element, at, out);
                element.of = self.numbered();
                let whole = |a| Node::Call(Function::Round, vec![a]);
                element.at.iter_mut().for_each(|index| self.mean(index, &whole, at, out));
            }
            Node::Call(function, arguments) => {
                let function = *function;
                if !self.settings.dialect.formula.has(function) {
                    let code = format!("{function:?}").to_uppercase();
                    self.fault(Fault::not_supported(code, ValueUnsupported::Function), at, out);
                }
                arguments.iter_mut().for_each(|a| self.mean(a, round, at, out));
                if function == Function::Round
                    && let Some(a) = arguments.pop()
                {
                    **node = round(a);
                } else if matches!(function, Function::Asin | Function::Atan2)
                    && self.option(ANGLE_RANGE, at, out) != "half"
                {
                    // From 0 on; an arc's sine is then never between 90 and 270 degrees.
                    let turn = || Expr::int(360);
                    let angle = std::mem::replace(expr, Expr::int(0));
                    let more = Expr::Node(Box::new(Node::Binary(Binary::Add, angle, turn())));
                    *expr = Expr::Node(Box::new(Node::Binary(Binary::Modulo, more, turn())));
                }
            }
        }
    }
}
