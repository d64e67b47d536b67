//! Remainders as the target has them: an operator for all numbers, for those that are whole by their types, or for those
//! that are whole by what they are. Others are written as what they are: what is divided, less the divisor as often as it
//! goes into it.
//!
//! A control that makes its numbers whole first does so in a way that is not known for sure: that there is nothing to
//! make whole is assumed of its own programs, and reported where another control takes the numbers as they are.

use crate::values::variables::expressions;
use ncc_ir::computed::computes::{Computes, Remainders};
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::decimals::Decimals;
use ncc_ir::expr::types::Types;
use ncc_ir::expr::{Binary, Expr, Function, Node};
use ncc_ir::program::Program;
use ncc_ir::source::Span;

/// Puts in what the target has.
pub(super) fn run(program: &mut Program, from: &Computes, to: &Computes, diags: &mut Vec<Diagnostic>) {
    let has = to.operators.contains(&Binary::Modulo);
    let as_they_are = from.remainders == Remainders::OfAny && to.remainders == Remainders::OfAny;
    if has && (as_they_are || from == to && to.remainders != Remainders::Typed) {
        return;
    }
    let mut decimals = Decimals::from_program(program);
    let mut made_whole = None;
    for (at, procedure) in program.procedures.iter_mut().enumerate() {
        decimals.within(at);
        let types = Types::of_procedure(procedure);
        let whole = |a: &Expr, b: &Expr| decimals.is_whole(a) && decimals.is_whole(b);
        let made = from.remainders == Remainders::MadeWhole;
        let stays = |a: &Expr, b: &Expr| match to.remainders {
            _ if !has => false,
            Remainders::OfAny => true,
            Remainders::Typed => types.are_whole(a) && types.are_whole(b),
            Remainders::MadeWhole => made || whole(a, b) || to.turn && is_angle(a, b),
        };
        expressions(&mut procedure.body, &mut |stmt, value| {
            expand_remainders(value, &mut |a, b| {
                if made && made_whole.is_none() && !whole(a, b) && !is_angle(a, b) {
                    made_whole = Some(stmt.span);
                }
                stays(a, b)
            });
        });
    }
    if let Some(at) = made_whole {
        tell(at, diags);
    }
}

fn tell(at: Span, diags: &mut Vec<Diagnostic>) {
    diags.push(Diagnostic::new(Fault::AssumedFact { fact: ControlFact::WholeRemainder }, at));
}

/// The angle of an arc, brought between 0 and a turn: a function of the control does that, and no operator.
fn is_angle(a: &Expr, b: &Expr) -> bool {
    let Expr::Node(sum) = a else { return false };
    let Node::Binary(Binary::Add, Expr::Node(arc), more) = &**sum else { return false };
    matches!(**arc, Node::Call(Function::Asin | Function::Atan2, _))
        && *more == Expr::int(360)
        && *b == Expr::int(360)
}

/// Each remainder that does not stay becomes what it is.
fn expand_remainders(expr: &mut Expr, stays: &mut dyn FnMut(&Expr, &Expr) -> bool) {
    let kept = match expr {
        Expr::Node(node) => match &**node {
            Node::Binary(Binary::Modulo, a, b) => stays(a, b),
            _ => true,
        },
        Expr::Num(_) => return,
    };
    expr.parts_mut().for_each(|part| expand_remainders(part, stays));
    if !kept
        && let Expr::Node(node) = expr
        && let Node::Binary(Binary::Modulo, a, b) = &**node
    {
        let of =
            |operator, a: &Expr, b: &Expr| Expr::Node(Box::new(Node::Binary(operator, a.clone(), b.clone())));
        let quotient = of(Binary::Divide, a, b);
        let often = Expr::Node(Box::new(Node::Call(Function::Truncate, vec![quotient])));
        *expr = of(Binary::Subtract, a, &of(Binary::Multiply, &often, b));
    }
}
