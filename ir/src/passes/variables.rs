//! Variables as the target has them: other names, words that round by themselves or do not, and values that are there
//! before they are read.
//!
//! A variable whose name is a number has that number behind the target's prefix, whatever it lives for. The variables
//! of calls become ones that all programs see, where no call has variables of its own.
//!
//! Refused: a variable that may be read before it has a value, where the target does not know such a thing.

use std::collections::{BTreeMap, BTreeSet};

use crate::arguments::{self, Argument};
use crate::canon::{Distance, Units};
use crate::computes::Computes;
use crate::diag::{Diagnostic, Fault};
use crate::expr::{Binary, Expr, Function, Many, Node, Target, Var};
use crate::num::{Num, Unit};
use crate::program::{Control, Op, Procedure, Program, Stmt, Text};
use crate::source::Span;
use crate::types::Types;

/// Most calls one within another that are looked into.
const DEEPEST: u32 = 10;

/// Puts the target's variables in.
///
/// `decimals` are the digits behind the point of the target's lengths in mm; in inches it has one more.
pub fn run(program: &mut Program, computes: &Computes, decimals: u8, diags: &mut Vec<Diagnostic>) {
    if !computes.vacant
        && let Some((name, at)) = Assigned::unset(program)
    {
        let what = format!("the variable {name}, which may have no value where it is read").into();
        diags.push(Diagnostic::new(Fault::Computes { what }, at));
        return;
    }
    if !computes.functions.contains(&Function::RoundUp) && computes.functions.contains(&Function::Ceiling) {
        up(program, diags);
    }
    let whole = computes.whole_remainder;
    if whole || !computes.operators.contains(&Binary::Modulo) {
        program.procedures.iter_mut().for_each(|procedure| {
            let types = whole.then(|| Types::of_procedure(procedure));
            expressions(&mut procedure.body, &mut |_, value| remainder(value, types.as_ref()));
        });
    }
    if !computes.prefix.is_empty() {
        let own = program.procedures.iter().any(|p| !p.parameters.is_empty() || calls_with_own(&p.body));
        let names = Names { prefix: &computes.prefix, locals: !own };
        program.procedures.iter_mut().for_each(|procedure| names.body(&mut procedure.body));
    }
    if !computes.rounds {
        let inches = program.assumed.units == Some(Units::Inch)
            || program.procedures.iter_mut().any(|procedure| in_inches(&mut procedure.body));
        let decimals = decimals + u8::from(inches);
        program.procedures.iter_mut().for_each(|procedure| unrounded(&mut procedure.body, decimals));
    }
}

/// A remainder as what it is: what is divided, less the divisor as often as it goes into it; where there are types,
/// one of whole numbers stays.
fn remainder(expr: &mut Expr, types: Option<&Types>) {
    let Expr::Node(node) = expr else { return };
    match &mut **node {
        Node::Var(_) | Node::Vacant => {}
        Node::Element(element) => element.at.iter_mut().for_each(|index| remainder(index, types)),
        Node::Unary(_, a) => remainder(a, types),
        Node::Call(_, arguments) => arguments.iter_mut().for_each(|a| remainder(a, types)),
        Node::Binary(operator, a, b) => {
            let whole = types.is_some_and(|types| types.are_whole(a) && types.are_whole(b));
            remainder(a, types);
            remainder(b, types);
            if *operator == Binary::Modulo && !whole {
                let of = |operator, a: &Expr, b: &Expr| {
                    Expr::Node(Box::new(Node::Binary(operator, a.clone(), b.clone())))
                };
                let quotient = of(Binary::Divide, a, b);
                let often = Expr::Node(Box::new(Node::Call(Function::Truncate, vec![quotient])));
                *expr = of(Binary::Subtract, a, &of(Binary::Multiply, &often, b));
            }
        }
    }
}

/// Rounding away from zero becomes rounding up, which is the same of what is not negative: execution tells whether
/// it is.
fn up(program: &mut Program, diags: &mut Vec<Diagnostic>) {
    fn over(expr: &mut Expr, found: &mut bool) {
        let Expr::Node(node) = expr else { return };
        match &mut **node {
            Node::Var(_) | Node::Vacant => {}
            Node::Element(element) => element.at.iter_mut().for_each(|index| over(index, found)),
            Node::Unary(_, a) => over(a, found),
            Node::Binary(_, a, b) => {
                over(a, found);
                over(b, found);
            }
            Node::Call(function, arguments) => {
                if *function == Function::RoundUp {
                    *function = Function::Ceiling;
                    *found = true;
                }
                arguments.iter_mut().for_each(|a| over(a, found));
            }
        }
    }
    let mut at = None;
    let every = &mut |stmt: &Stmt, expr: &mut Expr| {
        let mut found = false;
        over(expr, &mut found);
        if found && at.is_none() {
            at = Some(stmt.span);
        }
    };
    program.procedures.iter_mut().for_each(|procedure| expressions(&mut procedure.body, every));
    if let Some(at) = at {
        let parameter = "what is rounded up".into();
        let value = "never negative, as in this program".into();
        diags.push(Diagnostic::new(Fault::AssumedParameter { parameter, value }, at));
    }
}

/// Shows every expression of a body, each with its statement as it was.
pub(super) fn expressions(body: &mut [Stmt], seen: &mut dyn FnMut(&Stmt, &mut Expr)) {
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

/// Whether calls have variables of their own.
fn calls_with_own(body: &[Stmt]) -> bool {
    body.iter().any(|stmt| match &stmt.op {
        Op::Call(call) => !call.shared || !call.arguments.is_empty(),
        Op::Control(control) => control.bodies().any(|body| calls_with_own(body)),
        _ => false,
    })
}

struct Names<'c> {
    prefix: &'c str,
    /// Whether those of calls are renamed too.
    locals: bool,
}

impl Names<'_> {
    fn body(&self, body: &mut [Stmt]) {
        expressions(body, &mut |_, value| self.expr(value));
        self.targets(body);
    }

    /// What is given values.
    fn targets(&self, body: &mut [Stmt]) {
        for stmt in body {
            match &mut stmt.op {
                Op::Assign(Target::Var(var), _) => self.var(var),
                Op::Assign(Target::Element(element), _) => self.many(&mut element.of),
                Op::Declare(declare) => self.var(&mut declare.var),
                Op::Control(control) => {
                    if let Control::For { variable, .. } = &mut **control {
                        self.var(variable);
                    }
                    control.bodies_mut().for_each(|body| self.targets(body));
                }
                _ => {}
            }
        }
    }

    fn var(&self, var: &mut Var) {
        let name = match var {
            Var::Local(name) if self.locals => name,
            Var::Common(name) | Var::Retentive(name) => name,
            Var::Local(_) | Var::System(_) => return,
        };
        if !name.is_empty() && name.bytes().all(|b| b.is_ascii_digit()) {
            *var = Var::Common(format!("{}{name}", self.prefix).into());
        }
    }

    fn many(&self, many: &mut Many) {
        if let Many::Array { var, .. } = many {
            self.var(var);
        }
    }

    fn expr(&self, expr: &mut Expr) {
        let Expr::Node(node) = expr else { return };
        match &mut **node {
            Node::Var(var) => self.var(var),
            Node::Element(element) => {
                self.many(&mut element.of);
                element.at.iter_mut().for_each(|index| self.expr(index));
            }
            Node::Vacant => {}
            Node::Unary(_, a) => self.expr(a),
            Node::Binary(_, a, b) => {
                self.expr(a);
                self.expr(b);
            }
            Node::Call(_, arguments) => arguments.iter_mut().for_each(|a| self.expr(a)),
        }
    }
}

/// Shows the values of a statement that are computed, each with whether it is a length that is measured from zero.
fn each_value(op: &mut Op, seen: &mut dyn FnMut(&mut Expr, bool)) {
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

/// Takes away what only says that a word rounds. A length from zero is no further off than half of the target's last
/// digit; what adds up, or counts, or has finer digits there, is rounded as the program says.
fn unrounded(body: &mut [Stmt], decimals: u8) {
    for stmt in body {
        if let Op::Control(control) = &mut stmt.op {
            control.bodies_mut().for_each(|body| unrounded(body, decimals));
            continue;
        }
        each_value(&mut stmt.op, &mut |value, from_zero| {
            let Some((inner, digits)) = rounded(value) else { return };
            if from_zero && digits >= decimals {
                *value = inner;
            } else if digits > 0 {
                let by = || Expr::Num(Num::int(10i64.pow(u32::from(digits.min(9))), Unit::One));
                let up = Expr::Node(Box::new(Node::Binary(Binary::Multiply, inner, by())));
                let whole = Expr::Node(Box::new(Node::Call(Function::Round, vec![up])));
                *value = Expr::Node(Box::new(Node::Binary(Binary::Divide, whole, by())));
            }
        });
    }
}

/// What is rounded to some digits, and to how many.
fn rounded(value: &Expr) -> Option<(Expr, u8)> {
    let Expr::Node(node) = value else { return None };
    match &**node {
        Node::Call(Function::RoundTo, arguments) => match &arguments[..] {
            [inner, to] => Some((inner.clone(), u8::try_from(to.literal()?.whole()?).ok()?)),
            _ => None,
        },
        _ => None,
    }
}

/// Which variables have a value, on every way to where a program is looked at.
struct Assigned<'p> {
    procedures: &'p [Procedure],
    /// Those that have one.
    set: BTreeSet<Text>,
    /// Whether no way leads here.
    nowhere: bool,
    /// What has a value where a label ahead is jumped to.
    ahead: BTreeMap<&'p str, BTreeSet<Text>>,
    depth: u32,
}

impl<'p> Assigned<'p> {
    /// The first variable that may be read before it has a value.
    fn unset(program: &'p Program) -> Option<(Text, Span)> {
        let (set, ahead) = (BTreeSet::new(), BTreeMap::new());
        let mut assigned = Assigned { procedures: &program.procedures, set, nowhere: false, ahead, depth: 0 };
        program.procedures.first().and_then(|main| assigned.body(&main.body).err())
    }

    fn body(&mut self, body: &'p [Stmt]) -> Result<(), (Text, Span)> {
        body.iter().try_for_each(|stmt| self.stmt(stmt))
    }

    fn stmt(&mut self, stmt: &'p Stmt) -> Result<(), (Text, Span)> {
        let before = self.set.clone();
        match &stmt.op {
            Op::Assign(to, value) => {
                self.reads(value, stmt.span)?;
                match to {
                    Target::Var(var) => self.sets(var),
                    Target::Element(element) => {
                        element.at.iter().try_for_each(|index| self.reads(index, stmt.span))?;
                    }
                }
            }
            Op::Declare(declare) => {
                declare.initial.iter().flatten().try_for_each(|value| self.reads(value, stmt.span))?;
                self.sets(&declare.var);
            }
            Op::Control(control) => self.control(control, stmt)?,
            Op::Goto(label) => {
                let there = self.ahead.remove(&**label);
                let here = self.set.clone();
                let both = there.map_or(here.clone(), |there| there.intersection(&here).cloned().collect());
                self.ahead.insert(label, both);
                self.nowhere = true;
            }
            Op::Label(name) => {
                if let Some(there) = self.ahead.remove(&**name) {
                    self.set = match self.nowhere {
                        true => there,
                        false => there.intersection(&self.set).cloned().collect(),
                    };
                }
                self.nowhere = false;
            }
            Op::Call(call) => {
                call.arguments.iter().try_for_each(|value| self.reads(value, stmt.span))?;
                let found = self.procedures.iter().skip(1).find(|p| p.name == call.name);
                if let (Some(procedure), true) = (found, self.depth < DEEPEST && call.shared) {
                    let outside = std::mem::take(&mut self.ahead);
                    self.depth += 1;
                    let result = self.body(&procedure.body);
                    self.depth -= 1;
                    self.ahead = outside;
                    self.nowhere = false;
                    result?;
                }
            }
            op => {
                let mut op = op.clone();
                let mut result = Ok(());
                each_value(&mut op, &mut |value, _| {
                    if result.is_ok() {
                        result = self.reads(value, stmt.span);
                    }
                });
                result?;
            }
        }
        // A block that may be skipped gives nothing for sure.
        if stmt.skip.is_some() {
            self.set = before;
            self.nowhere = false;
        }
        Ok(())
    }

    fn control(&mut self, control: &'p Control, stmt: &'p Stmt) -> Result<(), (Text, Span)> {
        match control {
            Control::If { condition, then, otherwise } => {
                self.reads(condition, stmt.span)?;
                let before = (self.set.clone(), self.nowhere);
                self.body(then)?;
                let after = (std::mem::replace(&mut self.set, before.0), self.nowhere);
                self.nowhere = before.1;
                self.body(otherwise)?;
                self.set = match (after.1, self.nowhere) {
                    (true, _) => std::mem::take(&mut self.set),
                    (false, true) => after.0,
                    (false, false) => after.0.intersection(&self.set).cloned().collect(),
                };
                self.nowhere &= after.1;
            }
            Control::While { condition, body } => {
                self.reads(condition, stmt.span)?;
                self.maybe(body)?;
            }
            Control::Repeat { times, body } => {
                self.reads(times, stmt.span)?;
                self.maybe(body)?;
            }
            Control::For { variable, from, to, step, body } => {
                [from, to, step].into_iter().try_for_each(|value| self.reads(value, stmt.span))?;
                self.sets(variable);
                self.maybe(body)?;
            }
            Control::Loop { body } => self.maybe(body)?,
            Control::Until { condition, body } => {
                self.body(body)?;
                self.nowhere = false;
                self.reads(condition, stmt.span)?;
            }
        }
        Ok(())
    }

    /// A body that may not be executed at all.
    fn maybe(&mut self, body: &'p [Stmt]) -> Result<(), (Text, Span)> {
        let before = self.set.clone();
        self.body(body)?;
        self.set = before;
        self.nowhere = false;
        Ok(())
    }

    fn sets(&mut self, var: &Var) {
        if let Var::Local(name) = var {
            self.set.insert(name.clone());
        }
    }

    fn reads(&self, value: &Expr, at: Span) -> Result<(), (Text, Span)> {
        let Expr::Node(node) = value else { return Ok(()) };
        match &**node {
            Node::Var(Var::Local(name)) => {
                let known = self.nowhere || self.set.contains(name);
                if known { Ok(()) } else { Err((name.clone(), at)) }
            }
            // Whether the others have one is the same question in both programs.
            Node::Var(_) | Node::Vacant => Ok(()),
            Node::Element(element) => element.at.iter().try_for_each(|index| self.reads(index, at)),
            Node::Unary(_, a) => self.reads(a, at),
            // Whether it has a value is what is asked, or an error in both programs.
            Node::Binary(Binary::NotEqual, _, Expr::Node(b)) if **b == Node::Vacant => Ok(()),
            Node::Call(Function::Given, _) => Ok(()),
            Node::Binary(_, a, b) => {
                self.reads(a, at)?;
                self.reads(b, at)
            }
            Node::Call(_, arguments) => arguments.iter().try_for_each(|a| self.reads(a, at)),
        }
    }
}
