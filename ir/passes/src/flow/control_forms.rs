//! `control_forms`: branches, loops and jumps in the forms that the target has.
//!
//! A loop that counts, or that is repeated a computed number of times, becomes one with a condition and a counter: the
//! counter is given its first value, then the end and the pace are worth what they are there, once, before the first
//! turn; where the body may change what they are made of, they are kept in variables of their own. A loop that is
//! tested after its turns, one that stands in more others than the target can have, and one that is left from within
//! become labels and jumps; so does a branch for blocks where the target decides about one statement. What the
//! target has stays as it is, and so do blocks, their comments and their numbers.
//!
//! Functions that the target lacks are computed by branches before all that (`worked_out`).
//!
//! What neither the target nor this can say stays too, and is refused as what it is (`computes`). Not here: names of
//! variables (`variables`), and jumps made into loops and branches (`structures`).

mod conditions;
mod names;
mod structures;
mod worked_out;

use conditions::{compared, is_condition, opposite};
use names::{Names, one_label_a_place};

use crate::pass::Pass;
use ncc_ir::computed::assigned_variables::AssignedVariables;
use ncc_ir::computed::computed_call::computed_call;
use ncc_ir::computed::computes::{ComputeFeature, Computes, Handed, counted};
use ncc_ir::expr::num::Num;
use ncc_ir::expr::{Binary, Expr, Function, Node, Target, Unary, Var};
use ncc_ir::program::{Control, Op, Program, Stmt, Text};
use ncc_ir::source::Span;

/// This pass.
pub(crate) const PASS: Pass = Pass::parametric(
    "control-forms",
    "writes loops, branches and jumps in the target's forms",
    |_, _| true,
    |program, own, _| run(program, own.target),
);

/// Says a program's control in the target's forms.
pub fn run(program: &mut Program, computes: &Computes) {
    let mut taken = Names::from_program(program);
    worked_out::compute_missing_words(program, computes, &mut taken);
    let by_subprograms = AssignedVariables::by_subprograms(&program.procedures);
    let mut forms = Forms { computes, by_subprograms, taken, turning: Vec::new(), open: 0, split: false };
    for procedure in &mut program.procedures {
        if !has_control(&procedure.body) {
            continue;
        }
        forms.taken.only_once(procedure);
        if !computes.has(ComputeFeature::Jump) && computes.blocks && computes.has(ComputeFeature::Leave) {
            structures::structure_jumps(procedure, &mut forms.taken, computes.opposite);
        }
        let body = std::mem::take(&mut procedure.body);
        procedure.body = forms.body(body);
        one_label_a_place(&mut procedure.body);
    }
}

fn has_control(body: &[Stmt]) -> bool {
    body.iter().any(|stmt| {
        matches!(stmt.op, Op::Control(_) | Op::Goto(_) | Op::Assign(..) | Op::Declare(_) | Op::Call(_))
    })
}

/// How a body is left, or how its next turn is begun.
#[derive(Clone, Debug)]
enum Way {
    /// By the target's own word.
    Own,
    /// By a jump to a label; whether there is one.
    Jump(Text, bool),
    /// By statements, and then by the target's own word.
    Behind(Vec<Stmt>),
}

/// A body that is executed again and again.
#[derive(Debug)]
struct Turning {
    leave: Way,
    next: Way,
}

/// A loop taken to pieces.
struct Loop {
    span: Span,
    /// Another turn is begun while it holds; without, always.
    head: Option<Expr>,
    body: Vec<Stmt>,
    /// What every iteration ends with, however its body ends.
    tail: Vec<Stmt>,
    /// After a turn, the loop is over when it holds.
    until: Option<Expr>,
}

struct Forms<'c> {
    computes: &'c Computes,
    /// What may be another value when a call is made again.
    by_subprograms: AssignedVariables,
    taken: Names,
    turning: Vec<Turning>,
    /// Loops that are open, of those that stay loops.
    open: u8,
    /// Whether the last statement has become several blocks.
    split: bool,
}

impl Forms<'_> {
    fn has(&self, statement: ComputeFeature) -> bool {
        self.computes.has(statement)
    }

    fn body(&mut self, body: Vec<Stmt>) -> Vec<Stmt> {
        let mut out: Vec<Stmt> = Vec::with_capacity(body.len());
        for mut stmt in body {
            // What comes after a branch that was made of its neighbour has a block of its own.
            stmt.joined &= !std::mem::take(&mut self.split);
            match &mut stmt.op {
                Op::Leave => self.leaves(stmt, &mut out, true),
                Op::NextTurn => self.leaves(stmt, &mut out, false),
                Op::Control(_) => self.control(stmt, &mut out),
                Op::Assign(_, value) if !self.computes.blocks && is_condition(value) => {
                    self.truth(stmt, &mut out);
                }
                Op::Declare(declare)
                    if !self.computes.blocks
                        && declare.sizes.is_empty()
                        && declare.initial.iter().flatten().any(is_condition) =>
                {
                    let to = Target::Var(declare.var.clone());
                    let value = std::mem::take(&mut declare.initial).into_iter().flatten().next();
                    let span = stmt.span;
                    out.push(stmt);
                    if let Some(value) = value {
                        self.truth(Stmt::new(span, Op::Assign(to, value)), &mut out);
                    }
                }
                Op::Call(call)
                    if call.times > 1
                        && (!call.shared || !call.arguments.is_empty())
                        && (!self.computes.arguments_again || self.computes.handed == Handed::Names) =>
                {
                    self.called_again(stmt, &mut out);
                }
                _ => out.push(stmt),
            }
        }
        out
    }

    /// A turn is left, or its loop.
    fn leaves(&mut self, stmt: Stmt, out: &mut Vec<Stmt>, leave: bool) {
        let turning = self.turning.last_mut();
        match turning.map(|turning| if leave { &mut turning.leave } else { &mut turning.next }) {
            Some(Way::Jump(label, used)) => {
                *used = true;
                out.push(Stmt { op: Op::Goto(label.clone()), ..stmt });
            }
            Some(Way::Behind(before)) => {
                out.extend(before.iter().cloned());
                out.push(stmt);
            }
            Some(Way::Own) | None => out.push(stmt),
        }
    }

    /// A variable that is given the value of a condition, where a condition is no number.
    fn truth(&mut self, mut stmt: Stmt, out: &mut Vec<Stmt>) {
        let Op::Assign(to, value) = std::mem::replace(&mut stmt.op, Op::Blank) else { return };
        let one = |n: i64| Stmt::new(stmt.span, Op::Assign(to.clone(), Expr::int(n)));
        let mut changed = AssignedVariables::default();
        changed.look(&[one(0)]);
        if changed.keeps(&value) && stmt.skip.is_none() {
            let (number, joined, comment) = (stmt.number, stmt.joined, stmt.comment.take());
            out.push(Stmt { number, joined, comment, ..one(0) });
            out.extend(decided(stmt.span, compared(&value, false), one(1)));
            self.split = true;
            return;
        }
        let (then, otherwise) = (vec![one(1)], vec![one(0)]);
        stmt.op = Op::Control(Box::new(Control::If { condition: value, then, otherwise }));
        if stmt.skip.is_some() {
            // Its blocks would have to be skipped together.
            return out.push(stmt);
        }
        self.control(stmt, out);
        self.split = true;
    }

    /// A call with variables of its own that is made several times: its arguments are worth what they are before the
    /// first. Where a target makes each by itself, that is so written.
    fn called_again(&mut self, mut stmt: Stmt, out: &mut Vec<Stmt>) {
        let Op::Call(call) = &mut stmt.op else { return };
        if stmt.skip.is_some() {
            return out.push(stmt);
        }
        let changed = AssignedVariables { shared: call.shared, ..self.by_subprograms.clone() };
        for argument in &mut call.arguments {
            if !changed.keeps(argument) {
                let own = self.taken.counter("GIVEN");
                let value = Expr::Node(Box::new(Node::Var(own.clone())));
                let value = std::mem::replace(argument, value);
                let before = Op::Assign(Target::Var(own), value);
                out.push(Stmt { number: stmt.number.take(), ..Stmt::new(stmt.span, before) });
                stmt.joined = false;
            }
        }
        if self.computes.arguments_again {
            return out.push(stmt);
        }
        let times = Expr::int(std::mem::replace(&mut call.times, 1).into());
        // A counter cannot be set in the block of a move that precedes the call.
        stmt.joined = false;
        let (span, number) = (stmt.span, stmt.number.take());
        let repeat = Control::Repeat { times, body: vec![stmt] };
        let repeat = Stmt { number, ..Stmt::new(span, Op::Control(Box::new(repeat))) };
        self.control(repeat, out);
    }

    fn control(&mut self, mut stmt: Stmt, out: &mut Vec<Stmt>) {
        let Op::Control(mut control) = std::mem::replace(&mut stmt.op, Op::Blank) else { return };
        if self.has(ComputeFeature::CallOf) && computed_call(&control).is_some() {
            return out.push(Stmt { op: Op::Control(control), ..stmt });
        }
        if self.computes.says_number(&control) {
            return out.push(Stmt { op: Op::Control(control), ..stmt });
        }
        if self.says_about_one(&control) {
            if let Control::If { condition, .. } = &mut *control {
                *condition = compared(condition, false);
            }
            return out.push(Stmt { op: Op::Control(control), ..stmt });
        }
        // Its blocks are skipped together, which jumps would have to be as well.
        if stmt.skip.is_some() && !is_plain(&control) {
            let mut control = control;
            let turns = !matches!(*control, Control::If { .. });
            let mut behind = None;
            control.bodies_mut().for_each(|body| {
                let own = std::mem::take(body);
                if turns {
                    (*body, behind) = self.turning(own, stmt.span, &[]);
                } else {
                    *body = self.body(own);
                }
            });
            out.push(Stmt { op: Op::Control(control), ..stmt });
            out.extend(behind);
            return;
        }
        let begins = out.len();
        let (span, number, joined) = (stmt.span, stmt.number, stmt.joined);
        let (skip, comment) = (stmt.skip, stmt.comment.take());
        match *control {
            Control::If { condition, then, otherwise } => {
                self.decision(span, condition, then, otherwise, out)
            }
            Control::While { condition, body } => {
                let head = Some(condition);
                self.turns(Loop { span, head, body, tail: Vec::new(), until: None }, out);
            }
            Control::Loop { body } => {
                self.turns(Loop { span, head: None, body, tail: Vec::new(), until: None }, out);
            }
            Control::Until { condition, body } if !self.has(ComputeFeature::Until) => {
                let until = Some(condition);
                self.turns(Loop { span, head: None, body, tail: Vec::new(), until }, out);
            }
            Control::Until { condition, body } => {
                self.kept(span, body, |body| Control::Until { condition, body }, out);
            }
            Control::For { variable, from, to, step, body } if !self.has(ComputeFeature::Count) => {
                self.counted(span, variable, [from, to, step], body, out);
            }
            Control::For { variable, from, to, step, body } => {
                self.kept(span, body, |body| Control::For { variable, from, to, step, body }, out);
            }
            Control::Repeat { times, body } if !self.has(ComputeFeature::Times) => {
                self.times(span, times, body, out);
            }
            Control::Repeat { times, body } => {
                self.kept(span, body, |body| Control::Repeat { times, body }, out);
            }
        }
        if let Some(first) = out.get_mut(begins) {
            (first.number, first.joined, first.skip) = (number, joined, skip);
            if first.comment.is_none() {
                first.comment = comment;
            }
        }
    }

    /// Whether it is an alarm or a stop that depends on something, which the target says in one block.
    fn says_about_one(&self, control: &Control) -> bool {
        let Control::If { then, otherwise, .. } = control else { return false };
        let acts = then.iter().all(|stmt| {
            let acts = matches!(stmt.op, Op::Alarm(_) | Op::Message(_) | Op::ProgramStop);
            acts && stmt.skip.is_none() && stmt.comment.is_none()
        });
        acts && otherwise.is_empty() && !self.computes.blocks && self.computes.decides(then)
    }

    /// A loop that stays as it is.
    fn kept(
        &mut self,
        span: Span,
        body: Vec<Stmt>,
        of: impl FnOnce(Vec<Stmt>) -> Control,
        out: &mut Vec<Stmt>,
    ) {
        let (body, left) = self.turning(body, span, &[]);
        out.push(Stmt::new(span, Op::Control(Box::new(of(body)))));
        out.extend(left);
    }

    /// The body of a loop that stays one, of which every iteration ends with `tail`; and what stands after the loop.
    fn turning(&mut self, body: Vec<Stmt>, span: Span, tail: &[Stmt]) -> (Vec<Stmt>, Option<Stmt>) {
        let jumps = self.has(ComputeFeature::Jump);
        let leave = match self.has(ComputeFeature::Leave) || !jumps {
            true => Way::Own,
            false => Way::Jump(self.taken.label("LEFT"), false),
        };
        let next = match self.has(ComputeFeature::NextTurn) || !jumps {
            true if tail.is_empty() => Way::Own,
            true => Way::Behind(tail.to_vec()),
            false => Way::Jump(self.taken.label("NEXT"), false),
        };
        self.turning.push(Turning { leave, next });
        self.open += 1;
        let mut body = self.body(body);
        self.open -= 1;
        let jumped = |way: Way| match way {
            Way::Jump(label, true) => Some(Stmt::new(span, Op::Label(label))),
            Way::Jump(_, false) | Way::Own | Way::Behind(_) => None,
        };
        let mut left = None;
        if let Some(Turning { leave, next }) = self.turning.pop() {
            body.extend(jumped(next));
            left = jumped(leave);
        }
        body.extend(tail.iter().cloned());
        (body, left)
    }

    fn decision(
        &mut self,
        span: Span,
        condition: Expr,
        then: Vec<Stmt>,
        otherwise: Vec<Stmt>,
        out: &mut Vec<Stmt>,
    ) {
        let when = |condition: Expr, stmt: Stmt| decided(span, condition, stmt);
        let then = self.body(then);
        let otherwise = self.body(otherwise);
        if self.computes.blocks || !self.has(ComputeFeature::Jump) {
            let control = Control::If { condition, then, otherwise };
            return out.push(Stmt::new(span, Op::Control(Box::new(control))));
        }
        match (single(&then), single(&otherwise)) {
            (Some(jump), _) if matches!(jump.op, Op::Goto(_)) => {
                out.extend(when(compared(&condition, false), jump.clone()));
                out.extend(otherwise);
            }
            (Some(assigned), None) if otherwise.is_empty() => {
                out.extend(when(compared(&condition, false), assigned.clone()));
            }
            (None, Some(other)) if then.is_empty() || matches!(other.op, Op::Goto(_)) => {
                out.extend(when(opposite(&condition, false), other.clone()));
                out.extend(then);
            }
            _ => {
                let goto = |label: &Text| Stmt::new(span, Op::Goto(label.clone()));
                let over = self.taken.label("OVER");
                if otherwise.is_empty() {
                    out.extend(when(opposite(&condition, false), goto(&over)));
                    out.extend(then);
                } else {
                    let other = self.taken.label("ELSE");
                    out.extend(when(opposite(&condition, false), goto(&other)));
                    let goes_on = !ends_elsewhere(&then);
                    out.extend(then);
                    if goes_on {
                        out.push(goto(&over));
                    }
                    out.push(Stmt::new(span, Op::Label(other)));
                    out.extend(otherwise);
                }
                out.push(Stmt::new(span, Op::Label(over)));
            }
        }
    }

    /// A loop that counts: its counter, its end and its pace are given values in this order.
    fn counted(
        &mut self,
        span: Span,
        variable: Var,
        [from, to, step]: [Expr; 3],
        body: Vec<Stmt>,
        out: &mut Vec<Stmt>,
    ) {
        let assign = |var: &Var, value: Expr| Stmt::new(span, Op::Assign(Target::Var(var.clone()), value));
        let mut changed = AssignedVariables::default();
        changed.look(&body);
        changed.variables.insert(variable.clone());
        out.push(assign(&variable, from));
        let mut keep = |value: Expr, kind: &str, out: &mut Vec<Stmt>| {
            if changed.keeps(&value) {
                return value;
            }
            let own = self.taken.counter(kind);
            out.push(assign(&own, value));
            Expr::Node(Box::new(Node::Var(own)))
        };
        let to = keep(to, "END", out);
        let step = keep(step, "STEP", out);
        let value = |var: &Var| Expr::Node(Box::new(Node::Var(var.clone())));
        let within = |operator| Expr::binary(operator, value(&variable), to.clone());
        let head = match sign(&step) {
            Some(true) => within(Binary::LessOrEqual),
            Some(false) => within(Binary::GreaterOrEqual),
            // Which way it goes is known when it runs.
            None => {
                let goes = |operator| Expr::binary(operator, step.clone(), Expr::int(0));
                Expr::binary(
                    Binary::Or,
                    Expr::binary(Binary::And, goes(Binary::GreaterOrEqual), within(Binary::LessOrEqual)),
                    Expr::binary(Binary::And, goes(Binary::Less), within(Binary::GreaterOrEqual)),
                )
            }
        };
        let further = match step {
            Expr::Num(n) if n.mantissa < 0 => {
                let less = Expr::Num(Num { mantissa: -n.mantissa, ..n });
                Expr::binary(Binary::Subtract, value(&variable), less)
            }
            step => Expr::binary(Binary::Add, value(&variable), step),
        };
        let tail = vec![assign(&variable, further)];
        self.turns(Loop { span, head: Some(head), body, tail, until: None }, out);
    }

    /// A body that is executed a number of times. The turns are counted from 1: a number below that is none by itself.
    fn times(&mut self, span: Span, times: Expr, body: Vec<Stmt>, out: &mut Vec<Stmt>) {
        let times = match counted(&times) {
            own if *own == times => times,
            own => Expr::Node(Box::new(Node::Call(Function::Round, vec![own.clone()]))),
        };
        let counter = self.taken.counter("TURN");
        self.counted(span, counter, [Expr::int(1), times, Expr::int(1)], body, out);
    }

    fn turns(&mut self, of: Loop, out: &mut Vec<Stmt>) {
        let stays = of.until.is_none() && self.open < self.computes.loops || !self.has(ComputeFeature::Jump);
        if stays { self.stays_loop(of, out) } else { self.as_jumps(of, out) }
    }

    /// A loop stays one.
    fn stays_loop(&mut self, of: Loop, out: &mut Vec<Stmt>) {
        let Loop { span, head, body, tail, until } = of;
        let mut behind = tail;
        behind.extend(until.map(|condition| {
            let then = vec![Stmt::new(span, Op::Leave)];
            Stmt::new(span, Op::Control(Box::new(Control::If { condition, then, otherwise: Vec::new() })))
        }));
        let (body, left) = self.turning(body, span, &behind);
        let condition = head.map(|head| compared(&head, self.computes.blocks));
        let control = match condition {
            Some(condition) if condition.literal().is_none_or(|n| n.is_zero()) => {
                Control::While { condition, body }
            }
            _ if self.has(ComputeFeature::Endless) => Control::Loop { body },
            _ => Control::While { condition: Expr::int(1), body },
        };
        out.push(Stmt::new(span, Op::Control(Box::new(control))));
        out.extend(left);
    }

    /// A loop becomes a label, its blocks, and a jump back.
    fn as_jumps(&mut self, of: Loop, out: &mut Vec<Stmt>) {
        let Loop { span, head, body, tail, until } = of;
        let word = self.computes.opposite;
        let goto = |label: &Text| Stmt::new(span, Op::Goto(label.clone()));
        let when = |condition: Expr, label: &Text| decided(span, condition, goto(label));
        let [again, next, left] = ["AGAIN", "NEXT", "LEFT"].map(|kind| self.taken.label(kind));
        out.push(Stmt::new(span, Op::Label(again.clone())));
        let tested = head.is_some();
        if let Some(head) = head {
            out.extend(when(opposite(&head, word), &left));
        }
        let at_head = tail.is_empty() && until.is_none();
        let next = if at_head { again.clone() } else { next };
        self.turning.push(Turning { leave: Way::Jump(left, false), next: Way::Jump(next, false) });
        let body = self.body(body);
        let turning = self.turning.pop();
        let goes_on = !ends_elsewhere(&body);
        out.extend(body);
        let (leave, next) = match turning {
            Some(Turning { leave: Way::Jump(left, leave), next: Way::Jump(next, used) }) => {
                ((left, leave || tested), (next, used && !at_head))
            }
            _ => return,
        };
        let comes = goes_on || next.1;
        if next.1 {
            out.push(Stmt::new(span, Op::Label(next.0)));
        }
        out.extend(tail);
        match until {
            Some(until) => out.extend(when(opposite(&until, word), &again)),
            None if comes => out.push(goto(&again)),
            None => {}
        }
        if leave.1 {
            out.push(Stmt::new(span, Op::Label(leave.0)));
        }
    }
}

/// A statement that is executed when a condition holds; what always holds, or never, decides nothing.
fn decided(span: Span, condition: Expr, stmt: Stmt) -> Option<Stmt> {
    match condition {
        Expr::Num(n) => (!n.is_zero()).then_some(stmt),
        condition => {
            let control = Control::If { condition, then: vec![stmt], otherwise: Vec::new() };
            Some(Stmt::new(span, Op::Control(Box::new(control))))
        }
    }
}

/// Whether a branch is about one jump or one assignment alone.
fn is_plain(control: &Control) -> bool {
    match control {
        Control::If { then, otherwise, .. } => single(then).is_some() && otherwise.is_empty(),
        Control::Repeat { .. }
        | Control::Loop { .. }
        | Control::While { .. }
        | Control::Until { .. }
        | Control::For { .. } => false,
    }
}

/// The only statement, of which a branch can be about it without blocks: a jump, or an assignment.
fn single(body: &[Stmt]) -> Option<&Stmt> {
    match body {
        [only] if matches!(only.op, Op::Goto(_) | Op::Assign(..)) => {
            (only.skip.is_none() && only.comment.is_none()).then_some(only)
        }
        _ => None,
    }
}

/// Whether control never reaches the end of a body.
fn ends_elsewhere(body: &[Stmt]) -> bool {
    body.last().is_some_and(|last| {
        let away = matches!(
            last.op,
            Op::Goto(_)
                | Op::Leave
                | Op::NextTurn
                | Op::Return
                | Op::ProgramEnd
                | Op::BeginAgain
                | Op::Alarm(_)
        );
        away && last.skip.is_none()
    })
}

/// Whether a pace goes up, where it is written.
fn sign(step: &Expr) -> Option<bool> {
    match step {
        Expr::Num(n) => Some(n.mantissa >= 0),
        Expr::Node(node) => match &**node {
            Node::Unary(Unary::Negate, Expr::Num(n)) => Some(n.mantissa <= 0),
            _ => None,
        },
    }
}
