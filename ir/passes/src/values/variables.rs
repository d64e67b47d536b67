//! Variables as the target has them: names, words that round by themselves or do not, and values that are there before
//! they are read.
//!
//! Which variable becomes which is reported in `names`: it depends on the program and on the two controls alone, and on
//! nothing that another translation has done. Where the target does not know of empty variables, what the
//! program decides by that is decided here (`empty_variables`).
//!
//! Refused: a variable that may or may not have a value where it is read, for such a target; one for which the target
//! has no room.

mod defaults;
mod empty_variables;
mod inventory;
mod names;
mod references;
mod remainders;
mod rename;
pub mod renamed;
mod words;

use ncc_ir::canon::{Distance, Units};
use ncc_ir::computed::computes::{Computes, Handed};
use ncc_ir::diag::Diagnostic;
use ncc_ir::expr::num::Unit;
use ncc_ir::expr::{Expr, Function, Node, Target};
use ncc_ir::program::arguments::{self, Argument};
use ncc_ir::program::{Control, Op, Program, Stmt};

use self::empty_variables::Vacant;
use self::renamed::{Digits, Renamed};
use crate::pass::Pass;
pub use empty_variables::{Question, questions};
pub use words::Fineness;
pub(crate) use words::{as_rounded, round, rounded};

/// This pass.
pub(crate) const PASS: Pass = Pass::parametric(
    "variables",
    "names variables as the target does",
    |_, _| true,
    |program, own, found| own.renamed = run(program, own.source, own.target, own.digits, found),
);

/// Puts the target's variables in.
///
/// `from` is what the source's control computes with.
pub fn run(
    program: &mut Program,
    from: &Computes,
    computes: &Computes,
    Digits { decimals, increments, seconds }: Digits,
    diags: &mut Vec<Diagnostic>,
) -> Renamed {
    // A language takes what is stated in it as it is.
    let own = from == computes;
    if !own || computes.handed != Handed::Names {
        references::copied(program);
    }
    let vacant = Vacant { target: computes.vacant, source: from.vacant };
    if !own
        && (!computes.vacant || gives(program) && !computes.functions.contains(&Function::Given))
        && let Err(refused) = empty_variables::resolve(program, vacant, diags)
    {
        diags.push(refused);
        return Renamed::default();
    }
    if !computes.functions.contains(&Function::RoundUp) && computes.functions.contains(&Function::Ceiling) {
        words::up(program, diags);
    }
    remainders::run(program, from, computes, diags);
    if !own {
        program.procedures.iter_mut().for_each(|procedure| {
            expressions(&mut procedure.body, &mut |_, value| words::round_literal(value));
        });
    }
    let pairs = if own { Vec::new() } else { rename::rename_variables(program, from, computes, diags) };
    if computes.rounds && !from.rounds {
        words::rounds(program, increments, diags);
    }
    if let Some(seconds) = seconds.filter(|_| computes.rounds && !own) {
        words::waits(program, seconds);
    }
    if !computes.rounds {
        let inches = program.assumed.units == Some(Units::Inch)
            || program.procedures.iter_mut().any(|procedure| in_inches(&mut procedure.body));
        let decimals = decimals + u8::from(inches);
        program.procedures.iter_mut().for_each(|procedure| words::unrounded(&mut procedure.body, decimals));
    }
    Renamed { pairs, filled: !computes.vacant }
}

/// Whether anything must have a value where it is read.
fn gives(program: &mut Program) -> bool {
    let given = |node: &Node| matches!(node, Node::Call(Function::Given, _));
    let mut found = false;
    for procedure in &mut program.procedures {
        expressions(&mut procedure.body, &mut |_, e| found |= e.has(&given));
    }
    found
}

/// Shows every expression of a body, each with its statement as it was.
pub fn expressions(body: &mut [Stmt], seen: &mut dyn FnMut(&Stmt, &mut Expr)) {
    for stmt in body {
        let at = Stmt::new(stmt.span, Op::Blank);
        match &mut stmt.op {
            Op::Assign(to, value) => {
                if let Target::Element(element) = to {
                    element.at.iter_mut().for_each(|index| seen(&at, index));
                }
                seen(&at, value);
            }
            Op::Control(control) => {
                match &mut **control {
                    Control::Repeat { times: value, .. }
                    | Control::While { condition: value, .. }
                    | Control::Until { condition: value, .. }
                    | Control::If { condition: value, .. } => seen(&at, value),
                    Control::For { from, to, step, .. } => {
                        [from, to, step].into_iter().for_each(|value| seen(&at, value));
                    }
                    Control::Loop { .. } => {}
                }
                control.bodies_mut().for_each(|body| expressions(body, seen));
            }
            Op::Call(call) => call.arguments.iter_mut().for_each(|value| seen(&at, value)),
            Op::Declare(declare) => declare.initial.iter_mut().flatten().for_each(|value| seen(&at, value)),
            op => each_value(op, &mut |value, _| seen(&at, value)),
        }
    }
}

/// Shows the values of a statement that are computed, each with whether it is a length that is measured from zero.
pub(crate) fn each_value(op: &mut Op, seen: &mut dyn FnMut(&mut Expr, bool)) {
    if !arguments::computed(op) {
        return;
    }
    let all = arguments::each(op, &mut |argument, unit| {
        match argument {
            Argument::Word(Some(word)) => {
                let absolute = word.distance.known() == Some(Distance::Absolute);
                seen(&mut word.value, absolute && unit == Unit::Entry);
            }
            Argument::Optional(Some(value)) | Argument::Value(value) => seen(value, unit == Unit::Entry),
            Argument::Word(None) | Argument::Optional(None) => {}
        }
        Ok::<(), std::convert::Infallible>(())
    });
    all.unwrap_or_else(|never| match never {});
}

/// Whether a body says inches anywhere, or has a length in them.
fn in_inches(body: &mut [Stmt]) -> bool {
    body.iter_mut().any(|stmt| {
        if let Op::Control(control) = &mut stmt.op {
            return control.bodies_mut().any(|body| in_inches(body));
        }
        let mut found = stmt.op == Op::UseLengthUnits(Units::Inch);
        let all = arguments::each(&mut stmt.op, &mut |argument, _| {
            let literal = argument.expr().and_then(Expr::literal);
            found |= literal.is_some_and(|n| n.unit == Unit::Inch);
            Ok::<(), std::convert::Infallible>(())
        });
        all.unwrap_or_else(|never| match never {});
        found
    })
}
