//! `exact_comparisons`: numbers that are compared are the same or not, for a target that finds none equal that are
//! nearly so.
//!
//! What one control compares to within a tolerance is the same there unless two numbers differ by less than that;
//! the program is taken to compare none such, which is reported. Execution tells whether it is so.

use crate::pass::Pass;
use crate::values::variables::expressions;
use ncc_ir::computed::computes::Computes;
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::{Binary, Expr, Function, Node, Unary};
use ncc_ir::program::Program;

/// This pass.
pub(crate) const PASS: Pass = Pass::parametric(
    "exact-comparisons",
    "compares exactly what the target would find nearly equal",
    |_, _| true,
    |program, own, found| run(program, own.target, found),
);

/// Says comparisons without a tolerance.
pub fn run(program: &mut Program, computes: &Computes, diags: &mut Vec<Diagnostic>) {
    // One with a tolerance of its own takes it for this one (`arithmetic`).
    if computes.near || computes.equal_within.is_some() {
        return;
    }
    let mut reported = None;
    for procedure in &mut program.procedures {
        expressions(&mut procedure.body, &mut |stmt, value| {
            let mut found = false;
            compare_exactly(value, &mut found);
            if found {
                reported.get_or_insert(stmt.span);
            }
        });
    }
    if let Some(at) = reported {
        diags.push(Diagnostic::new(Fault::AssumedFact { fact: ControlFact::NearNumbers }, at));
    }
}

/// Two numbers of which it is asked whether they are nearly the same.
fn nearly(e: &Expr) -> Option<(&Expr, &Expr)> {
    let Expr::Node(node) = e else { return None };
    match &**node {
        Node::Call(Function::NearRatio | Function::Near, arguments) => match &arguments[..] {
            [a, b, _] => Some((a, b)),
            _ => None,
        },
        _ => None,
    }
}

/// Whether they are not.
fn apart(e: &Expr) -> Option<(&Expr, &Expr)> {
    let Expr::Node(node) = e else { return None };
    match &**node {
        Node::Unary(Unary::Not, a) => nearly(a),
        _ => None,
    }
}

/// The comparison that an expression is without its tolerance.
fn exact(e: &Expr) -> Option<Expr> {
    let Expr::Node(node) = e else { return None };
    let equal =
        |operator, (a, b): (&Expr, &Expr)| Expr::Node(Box::new(Node::Binary(operator, a.clone(), b.clone())));
    if let Some(of) = nearly(e) {
        return Some(equal(Binary::Equal, of));
    }
    if let Some(of) = apart(e) {
        return Some(equal(Binary::NotEqual, of));
    }
    let Node::Binary(joint, first, second) = &**node else { return None };
    let Expr::Node(first) = first else { return None };
    let Node::Binary(operator, a, b) = &**first else { return None };
    let same = match (joint, operator) {
        (Binary::And, Binary::Less | Binary::Greater) => apart(second),
        (Binary::Or, Binary::LessOrEqual | Binary::GreaterOrEqual) => nearly(second),
        _ => None,
    };
    (same == Some((a, b))).then(|| equal(*operator, (a, b)))
}

fn compare_exactly(e: &mut Expr, found: &mut bool) {
    if let Some(plain) = exact(e) {
        *e = plain;
        *found = true;
    }
    e.parts_mut().for_each(|part| compare_exactly(part, found));
}
