//! Functions that the target lacks, computed by branches in blocks before the one that needs them: the
//! lesser and the greater of two values, rounding up where only cutting off is known, the value of a condition where
//! it is no number, the base of a power, which becomes a product, and angles by the arc cosine.
//!
//! `#1 = MAX[#2, #3]` is `#1 = #2` and `IF [#1 LT #3] THEN #1 = #3`: nothing is computed that the function does not
//! compute. An angle that the target gives from 0 to a turn, as `#1 = ATAN[#2]/[#3]`, is taken back by a turn where it is
//! more than half of one. Sines and tangents use the arc cosine, to 13 digits. A value in a word, a condition or an
//! argument gets its own variable. A loop condition is computed before the loop and at the end of each iteration.
//!
//! What stays as it is, and is refused as what it is: functions in blocks with block skip, or after assignments in
//! the same block, and in conditions of loops of which a turn is left.

use std::collections::BTreeMap;

use crate::flow::control_forms::conditions::is_condition;
use crate::flow::control_forms::names::Names;
use crate::values::variables::each_value;
use ncc_ir::computed::computed_call::computed_call;
use ncc_ir::computed::computes::{Computes, counted};
use ncc_ir::expr::decimals::Decimals;
use ncc_ir::expr::{Binary, Expr, Function, Node, Target, Unary, Var};
use ncc_ir::program::{Control, Op, Piece, Program, Stmt};
use ncc_ir::source::Span;

/// How many digits a value has, and whether it may be negative.
type Kind = (Option<u8>, bool);

/// Computes what the target lacks.
pub(super) fn compute_missing_words(program: &mut Program, computes: &Computes, taken: &mut Names) {
    taken.read(program);
    let mut decimals = Decimals::from_program(program);
    let mut own = BTreeMap::new();
    for (at, procedure) in program.procedures.iter_mut().enumerate() {
        decimals.within(at);
        let mut out = WorkedOut { computes, decimals: &decimals, taken, own: &mut own };
        let body = std::mem::take(&mut procedure.body);
        procedure.body = out.body(body);
    }
}

fn value(var: &Var) -> Expr {
    Expr::Node(Box::new(Node::Var(var.clone())))
}

fn call(function: Function, a: Expr) -> Expr {
    Expr::Node(Box::new(Node::Call(function, vec![a])))
}

/// The angle of a sine, by the cosine that is the same.
fn beside_cosine(a: Expr) -> Expr {
    Expr::binary(Binary::Subtract, Expr::int(90), call(Function::Acos, a))
}

/// An angle on both sides of zero, from 0 to a turn.
fn from_zero(angle: Expr) -> Expr {
    Expr::binary(Binary::Modulo, Expr::binary(Binary::Add, angle, Expr::int(360)), Expr::int(360))
}

/// A number, or a variable that the program alone changes.
fn is_simple(e: &Expr) -> bool {
    match e {
        Expr::Num(_) => true,
        Expr::Node(node) => matches!(&**node, Node::Var(var) if !matches!(var, Var::System(_))),
    }
}

/// Whether it asks the control for a value of its own, which what stands in the block before it may change.
fn asks_control(stmt: &Stmt) -> bool {
    let system = |node: &Node| matches!(node, Node::Var(Var::System(_)));
    let mut found = false;
    values(&mut stmt.op.clone(), &mut |e| found |= e.has(&system));
    found
}

/// Shows the values of a statement that may be computed before it. A repeat count is rounded by the
/// control itself.
fn values(op: &mut Op, seen: &mut dyn FnMut(&mut Expr)) {
    match op {
        Op::Assign(to, value) => {
            if let Target::Element(element) = to {
                element.at.iter_mut().for_each(&mut *seen);
            }
            seen(value);
        }
        Op::Call(call) => call.arguments.iter_mut().for_each(seen),
        Op::Control(control) => match &mut **control {
            Control::If { condition, .. } => seen(condition),
            Control::For { .. }
            | Control::Repeat { .. }
            | Control::While { .. }
            | Control::Until { .. }
            | Control::Loop { .. } => {}
        },
        Op::Declare(declare) => declare.initial.iter_mut().flatten().for_each(seen),
        op => each_value(op, &mut |value, _| seen(value)),
    }
}

struct WorkedOut<'c> {
    computes: &'c Computes,
    decimals: &'c Decimals,
    taken: &'c mut Names,
    /// The variables that are worked in. Each is read in the statement for which it is computed alone.
    own: &'c mut BTreeMap<(Kind, usize), Var>,
}

/// What is computed before a statement.
#[derive(Default)]
struct Before {
    stmts: Vec<Stmt>,
    /// Variables in use.
    used: BTreeMap<Kind, usize>,
}

impl WorkedOut<'_> {
    fn has(&self, function: Function) -> bool {
        self.computes.functions.contains(&function)
    }

    fn body(&mut self, body: Vec<Stmt>) -> Vec<Stmt> {
        let mut out: Vec<Stmt> = Vec::with_capacity(body.len());
        // Where the block at hand begins.
        let mut block = 0;
        let mut split = false;
        for mut stmt in body {
            stmt.joined &= !std::mem::take(&mut split);
            if !stmt.joined {
                block = out.len();
            }
            let called = matches!(&stmt.op, Op::Control(control) if computed_call(control).is_some());
            if let Op::Control(control) = &mut stmt.op
                && !called
            {
                for body in control.bodies_mut() {
                    let own = std::mem::take(body);
                    *body = self.body(own);
                }
                self.turns(&mut stmt, &mut out);
            }
            let before = &out[block.min(out.len())..];
            if called || stmt.skip.is_some() || !may_stand_behind(&stmt, before) {
                out.push(stmt);
                continue;
            }
            if let Some(steps) = self.assigned(&mut stmt) {
                out.extend(steps);
                split = true;
                continue;
            }
            let mut before = Before::default();
            self.statement(&mut stmt.op, stmt.span, &mut before);
            self.put(before.stmts, stmt, block, &mut out);
        }
        out
    }

    /// Puts what is computed before the block of a statement, after its label.
    fn put(&mut self, steps: Vec<Stmt>, mut stmt: Stmt, block: usize, out: &mut Vec<Stmt>) {
        if steps.is_empty() {
            return out.push(stmt);
        }
        if !stmt.joined {
            let number = stmt.number.take();
            let first = out.len();
            out.extend(steps);
            if let Some(first) = out.get_mut(first) {
                first.number = number;
            }
            return out.push(stmt);
        }
        let labels = out[block..].iter().take_while(|stmt| matches!(stmt.op, Op::Label(_))).count();
        let at = block + labels;
        let mut rest = out.split_off(at);
        let number = rest.first_mut().map_or_else(|| None, |first| first.number.take());
        let begins = out.len();
        out.extend(steps);
        if let Some(first) = out.get_mut(begins).filter(|_| labels == 0) {
            first.number = number;
        }
        rest.push(stmt);
        if let Some(first) = rest.first_mut() {
            first.joined = false;
        }
        out.append(&mut rest);
    }

    /// A variable that is given the value of one function, computed in that variable itself.
    fn assigned(&mut self, stmt: &mut Stmt) -> Option<Vec<Stmt>> {
        let Op::Assign(Target::Var(to), of) = &stmt.op else { return None };
        if stmt.joined || matches!(to, Var::System(_)) || of.reads(&Target::Var(to.clone())) {
            return None;
        }
        let Expr::Node(node) = of else { return None };
        let Node::Call(function, arguments) = &**node else { return None };
        if !self.lacks(*function) {
            return None;
        }
        let (to, function, mut arguments) = (to.clone(), *function, arguments.clone());
        let kind = arguments.first().map_or((None, true), |first| self.kind(first));
        let mut before = Before::default();
        for argument in &mut arguments {
            self.expr(argument, false, stmt.span, &mut before);
        }
        self.function((function, arguments), kind, &to, stmt.span, &mut before);
        let mut steps = before.stmts;
        if let Some(first) = steps.first_mut() {
            first.number = stmt.number.take();
            first.comment = stmt.comment.take();
        }
        Some(steps)
    }

    /// Loops: what is asked before each iteration, after each iteration, or before all of them.
    fn turns(&mut self, stmt: &mut Stmt, out: &mut Vec<Stmt>) {
        let span = stmt.span;
        if stmt.skip.is_some() || stmt.joined {
            return;
        }
        let mut before = Before::default();
        let Op::Control(control) = &mut stmt.op else { return };
        match &mut **control {
            Control::While { condition, body } if !next_turn(body) => {
                self.expr(condition, true, span, &mut before);
                body.extend(before.stmts.iter().cloned());
            }
            Control::Until { condition, body } if !next_turn(body) => {
                self.expr(condition, true, span, &mut before);
                body.append(&mut before.stmts);
            }
            Control::Repeat { times, .. } => {
                let own = counted(times).clone();
                let mut worked = own.clone();
                self.expr(&mut worked, false, span, &mut before);
                if !before.stmts.is_empty() {
                    replace(times, &own, &worked);
                }
            }
            // The counter has its first value when its end and its pace are asked for.
            Control::For { variable, from, to, step, .. } => {
                let counter = Target::Var(variable.clone());
                self.expr(from, false, span, &mut before);
                for bound in [to, step] {
                    if !bound.reads(&counter) {
                        self.expr(bound, false, span, &mut before);
                    }
                }
            }
            _ => {}
        }
        if !before.stmts.is_empty() {
            before.stmts[0].number = stmt.number.take();
            out.append(&mut before.stmts);
        }
    }

    /// The values of a statement.
    fn statement(&mut self, op: &mut Op, span: Span, before: &mut Before) {
        let truth = match op {
            // A variable set to the value of a condition is a branch of its own.
            Op::Assign(Target::Var(_), _) | Op::Declare(_) => true,
            Op::Control(control) => matches!(**control, Control::If { .. }),
            _ => false,
        };
        values(op, &mut |value| self.expr(value, truth, span, before));
        if let Op::MessageOf(pieces) = op
            && self.computes.values_in_full.is_some()
        {
            self.in_variables(pieces, span, before);
        }
    }

    /// Values of a message in variables, where it can have no others.
    fn in_variables(&mut self, pieces: &mut [Piece], span: Span, before: &mut Before) {
        for piece in pieces {
            let Piece::Value { value: shown, .. } = piece else { continue };
            let is_variable = matches!(shown, Expr::Node(node) if matches!(**node, Node::Var(_)));
            if !is_variable {
                let own = self.room((None, true), before);
                before.stmts.push(assign(&own, std::mem::replace(shown, value(&own)), span));
            }
        }
    }

    /// Whether a function is computed.
    fn lacks(&self, function: Function) -> bool {
        let both_ways = self.computes.worth && self.has(Function::Floor) && self.has(Function::Ceiling);
        let up = self.has(Function::RoundUp) || self.has(Function::Ceiling) || both_ways;
        match function {
            Function::Min | Function::Max => !self.has(function) && !self.computes.worth,
            Function::RoundUp | Function::Ceiling => !up && self.has(Function::Truncate),
            Function::Asin | Function::Atan2 if self.turns_round(function) => true,
            Function::Asin => !self.has(function) && self.has(Function::Acos),
            Function::Atan2 => {
                !self.has(function)
                    && [Function::Acos, Function::Sqrt, Function::Abs].map(|f| self.has(f)) == [true; 3]
            }
            _ => false,
        }
    }

    /// Whether a function gives angles from 0 to a turn, of which those below zero are made by a branch.
    fn turns_round(&self, function: Function) -> bool {
        self.computes.turn && self.has(function) && matches!(function, Function::Asin | Function::Atan2)
    }

    /// Angles of which a sine, a cosine or a tangent is asked: a turn more is the same there.
    fn any_turn(&self, e: &mut Expr) {
        let Expr::Node(node) = &mut *e else { return };
        match &mut **node {
            Node::Unary(Unary::Negate, a) => self.any_turn(a),
            Node::Binary(Binary::Add | Binary::Subtract, a, b) => {
                self.any_turn(a);
                self.any_turn(b);
            }
            Node::Call(function, _) if self.turns_round(*function) => {
                let angle = std::mem::replace(e, Expr::int(0));
                *e = from_zero(angle);
            }
            _ => {}
        }
    }

    /// What is known of a value of the program as it was.
    fn kind(&self, e: &Expr) -> Kind {
        (self.decimals.digits(e), self.decimals.may_be_negative(e))
    }

    /// A variable to work in.
    fn room(&mut self, kind: Kind, before: &mut Before) -> Var {
        let next = before.used.entry(kind).or_default();
        let place = (kind, *next);
        *next += 1;
        self.own.entry(place).or_insert_with(|| self.taken.room(&self.computes.local)).clone()
    }

    /// A number or a variable: else one that is computed.
    fn simple(&mut self, a: &Expr, before: &mut Before, span: Span) -> Expr {
        if is_simple(a) {
            return a.clone();
        }
        let own = self.room((None, true), before);
        before.stmts.push(assign(&own, a.clone(), span));
        value(&own)
    }

    /// An angle from 0 to a turn, of one on both sides of zero that is computed.
    fn round(&mut self, e: &mut Expr, span: Span, before: &mut Before) -> bool {
        let turn = |e: &Expr| e.literal().is_some_and(|n| n.whole_number() == Some(360));
        let Expr::Node(node) = &mut *e else { return false };
        let Node::Binary(Binary::Modulo, sum, of) = &mut **node else { return false };
        let Expr::Node(inner) = &mut *sum else { return false };
        let Node::Binary(Binary::Add, angle, more) = &mut **inner else { return false };
        let Expr::Node(asked) = &mut *angle else { return false };
        let Node::Call(function @ (Function::Asin | Function::Atan2), arguments) = &mut **asked else {
            return false;
        };
        if !self.lacks(*function) || !turn(of) || !turn(more) {
            return false;
        }
        if self.turns_round(*function) {
            arguments.iter_mut().for_each(|part| self.expr(part, false, span, before));
            return true;
        }
        self.expr(angle, false, span, before);
        let Expr::Node(worked) = &*angle else { return false };
        let Node::Var(own) = &**worked else { return false };
        let own = own.clone();
        let by = |operator| assign(&own, Expr::binary(operator, value(&own), Expr::int(360)), span);
        before.stmts.push(when(Expr::binary(Binary::Less, value(&own), Expr::int(0)), by(Binary::Add)));
        // One that is nothing but the least bit below zero.
        before.stmts.push(when(
            Expr::binary(Binary::GreaterOrEqual, value(&own), Expr::int(360)),
            by(Binary::Subtract),
        ));
        *e = value(&own);
        true
    }

    /// Takes out of an expression what has to be computed. `truth`: a condition can stand where it stands.
    fn expr(&mut self, e: &mut Expr, truth: bool, span: Span, before: &mut Before) {
        let was = e.clone();
        if self.round(e, span, before) {
            return;
        }
        let Expr::Node(node) = e else { return };
        if let Node::Call(Function::Sin | Function::Cos | Function::Tan, arguments) = &mut **node {
            arguments.iter_mut().for_each(|angle| self.any_turn(angle));
        }
        match &mut **node {
            Node::Binary(Binary::And | Binary::Or | Binary::Xor, a, b) => {
                self.expr(a, true, span, before);
                self.expr(b, true, span, before);
            }
            Node::Unary(Unary::Not, a) => self.expr(a, true, span, before),
            // A condition that is compared with what holds, or does not, is one.
            Node::Binary(Binary::Equal | Binary::NotEqual, a, Expr::Num(n))
                if is_condition(a) && (n.is_zero() || n.whole_number() == Some(1)) =>
            {
                self.expr(a, true, span, before);
            }
            Node::Binary(Binary::Power, base, exponent) => {
                self.expr(base, false, span, before);
                let times = exponent.literal().and_then(|n| n.whole_number());
                if self.computes.operators.contains(&Binary::Power) {
                    return self.expr(exponent, false, span, before);
                }
                match times {
                    Some(1) => *e = std::mem::replace(base, Expr::int(0)),
                    Some(0) if is_simple(base) => *e = Expr::int(1),
                    // What is a product then (`arithmetic`), or nothing but 1.
                    Some(0 | 2..=4) if !is_simple(base) => {
                        let kind = was.parts().next().map_or((None, true), |first| self.kind(first));
                        let own = self.room(kind, before);
                        let worth = std::mem::replace(base, value(&own));
                        before.stmts.push(assign(&own, worth, span));
                        if times == Some(0) {
                            *e = Expr::int(1);
                        }
                    }
                    _ => {}
                }
                return;
            }
            _ => e.parts_mut().for_each(|part| self.expr(part, false, span, before)),
        }
        let is_number = !truth && is_condition(e) && !self.computes.worth && !self.computes.blocks;
        let Expr::Node(node) = e else { return };
        match &mut **node {
            Node::Call(function, arguments) if self.lacks(*function) => {
                let (function, arguments) = (*function, std::mem::take(arguments));
                let kind = self.kind(&was);
                let own = self.room(kind, before);
                let of = was.parts().next().map_or((None, true), |first| self.kind(first));
                self.function((function, arguments), of, &own, span, before);
                *e = value(&own);
            }
            _ if is_number => {
                let own = self.room((Some(0), false), before);
                let condition = std::mem::replace(e, value(&own));
                before.stmts.push(assign(&own, Expr::int(0), span));
                before.stmts.push(when(condition, assign(&own, Expr::int(1), span)));
            }
            _ => {}
        }
    }

    /// Computes one function in a variable, of arguments that the target can say; `kind` is that of the first.
    fn function(
        &mut self,
        (function, arguments): (Function, Vec<Expr>),
        kind: Kind,
        to: &Var,
        span: Span,
        before: &mut Before,
    ) {
        match (function, &arguments[..]) {
            (Function::Asin | Function::Atan2, _) if self.turns_round(function) => {
                let angle = Expr::Node(Box::new(Node::Call(function, arguments)));
                let back = Expr::binary(Binary::Subtract, value(to), Expr::int(360));
                before.stmts.extend([
                    assign(to, from_zero(angle), span),
                    when(Expr::binary(Binary::Greater, value(to), Expr::int(180)), assign(to, back, span)),
                ]);
            }
            (Function::Asin, [a]) => {
                before.stmts.push(assign(to, beside_cosine(a.clone()), span));
            }
            (Function::Atan2, [y, x]) => {
                let [y, x] = [y, x].map(|a| self.simple(a, before, span));
                let far = self.room((None, false), before);
                let square = |a: &Expr| Expr::binary(Binary::Multiply, a.clone(), a.clone());
                let squares = Expr::binary(Binary::Add, square(&x), square(&y));
                before.stmts.push(assign(&far, call(Function::Sqrt, squares), span));
                let part =
                    |a: &Expr| Expr::binary(Binary::Divide, call(Function::Abs, a.clone()), value(&far));
                let steep = |operator| {
                    Expr::binary(operator, call(Function::Abs, y.clone()), call(Function::Abs, x.clone()))
                };
                let less = |e: &Expr| Expr::binary(Binary::Less, e.clone(), Expr::int(0));
                let from = |n: i64| assign(to, Expr::binary(Binary::Subtract, Expr::int(n), value(to)), span);
                before.stmts.extend([
                    // Each where it is as fine as the numbers are.
                    when(steep(Binary::LessOrEqual), assign(to, beside_cosine(part(&y)), span)),
                    when(steep(Binary::Greater), assign(to, call(Function::Acos, part(&x)), span)),
                    when(less(&x), from(180)),
                    when(less(&y), from(0)),
                ]);
            }
            (Function::Min | Function::Max, [a, b]) => {
                let (first, second) = if is_simple(a) && !is_simple(b) { (b, a) } else { (a, b) };
                let other = if function == Function::Min { Binary::Greater } else { Binary::Less };
                before.stmts.push(assign(to, first.clone(), span));
                let further = Expr::binary(other, value(to), second.clone());
                before.stmts.push(when(further, assign(to, second.clone(), span)));
            }
            (Function::RoundUp | Function::Ceiling, [a]) => {
                let a = match is_simple(a) {
                    true => a.clone(),
                    false => {
                        let own = self.room(kind, before);
                        before.stmts.push(assign(&own, a.clone(), span));
                        value(&own)
                    }
                };
                let cut = call(Function::Truncate, a.clone());
                before.stmts.push(assign(to, cut.clone(), span));
                let below = function == Function::RoundUp && kind.1;
                // What has been counted up is compared no more.
                let whole = if below { cut.clone() } else { value(to) };
                let mut one_more = |beyond: Binary, step: Binary| {
                    let further = assign(to, Expr::binary(step, whole.clone(), Expr::int(1)), span);
                    before.stmts.push(when(Expr::binary(beyond, a.clone(), whole.clone()), further));
                };
                one_more(Binary::Greater, Binary::Add);
                if below {
                    one_more(Binary::Less, Binary::Subtract);
                }
            }
            _ => {}
        }
    }
}

/// Whether what is computed before the whole block has the same value there: nothing that stands in the block before
/// the statement gives a variable a value, or leads elsewhere, or changes what the control is asked for.
fn may_stand_behind(stmt: &Stmt, before: &[Stmt]) -> bool {
    let acts = before.iter().any(|stmt| !matches!(stmt.op, Op::Label(_)));
    let changes = |stmt: &Stmt| {
        matches!(
            stmt.op,
            Op::Assign(..)
                | Op::Declare(_)
                | Op::Call(_)
                | Op::Control(_)
                | Op::Goto(_)
                | Op::Leave
                | Op::NextTurn
                | Op::Return
                | Op::RepeatBlocks(_)
        )
    };
    !stmt.joined || !(before.iter().any(changes) || acts && asks_control(stmt))
}

/// Whether an iteration of this loop is left for the next one.
fn next_turn(body: &[Stmt]) -> bool {
    body.iter().any(|stmt| match &stmt.op {
        Op::NextTurn => true,
        Op::Control(control) => match &**control {
            Control::If { then, otherwise, .. } => next_turn(then) || next_turn(otherwise),
            _ => false,
        },
        _ => false,
    })
}

fn assign(to: &Var, value: Expr, span: Span) -> Stmt {
    Stmt::new(span, Op::Assign(Target::Var(to.clone()), value))
}

fn when(condition: Expr, then: Stmt) -> Stmt {
    let span = then.span;
    let control = Control::If { condition, then: vec![then], otherwise: Vec::new() };
    Stmt::new(span, Op::Control(Box::new(control)))
}

/// Puts one expression into another in the place of its part.
fn replace(e: &mut Expr, part: &Expr, by: &Expr) {
    if e == part {
        e.clone_from(by);
        return;
    }
    e.parts_mut().for_each(|inner| replace(inner, part, by));
}
