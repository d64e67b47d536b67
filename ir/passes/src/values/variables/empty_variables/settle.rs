//! Puts what is known of variables that have no value into a program's statements.
//!
//! Refused: a value that may be nothing, or a number, where that makes a difference.

use super::may::{Known, May, holds, is_nothing, may, nothing};
use super::ways::{Facts, place};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::{Expr, Function, Node, Target, Var};
use ncc_ir::program::arguments::{self, Argument};
use ncc_ir::program::{Control, Op, Piece, Stmt};
use ncc_ir::run_time::RunTimeValue;
use ncc_ir::source::Span;

/// Puts in what is known.
pub(super) struct Settle<'f> {
    pub(super) facts: &'f Facts,
    /// Whether the target knows empty variables.
    pub(super) vacant: bool,
    /// Whether a branch of this procedure is made.
    pub(super) decided: bool,
}

/// What becomes of a statement.
enum Kept {
    As(Stmt),
    /// In its place, as blocks of their own.
    Instead(Vec<Stmt>),
}

impl Settle<'_> {
    /// A body; `was` is the same before anything was put in, of which the facts are.
    ///
    /// # Errors
    /// A variable that may or may not have a value where it is read.
    pub(super) fn body(&mut self, was: &[Stmt], body: Vec<Stmt>) -> Result<Vec<Stmt>, Diagnostic> {
        let mut out: Vec<Stmt> = Vec::with_capacity(body.len());
        // What the first statement of a block was that is gone.
        let mut first: Option<Option<u32>> = None;
        for (was, mut stmt) in was.iter().zip(body) {
            if let Some(number) = first.take()
                && stmt.joined
            {
                (stmt.joined, stmt.number) = (false, number);
            }
            let (joined, number, skip) = (stmt.joined, stmt.number, stmt.skip);
            match self.stmt(was, stmt)? {
                Kept::As(stmt) => out.push(stmt),
                Kept::Instead(mut stmts) => {
                    let own = number.filter(|_| stmts.is_empty());
                    if let Some(stmt) = stmts.first_mut() {
                        stmt.number = number.or(stmt.number);
                    }
                    first = (!joined).then_some(own);
                    for stmt in &mut stmts {
                        stmt.skip = stmt.skip.or(skip);
                    }
                    out.append(&mut stmts);
                }
            }
        }
        if self.decided {
            over_nothing(&mut out);
        }
        Ok(out)
    }

    fn stmt(&mut self, was: &Stmt, mut stmt: Stmt) -> Result<Kept, Diagnostic> {
        let Some(known) = self.facts.get(&place(was)) else {
            // No way leads here. What a branch has cut off is gone.
            let stays = matches!(stmt.op, Op::Label(_) | Op::Comment(_)) || !self.decided;
            return Ok(if stays { Kept::As(stmt) } else { Kept::Instead(Vec::new()) });
        };
        let at = stmt.span;
        let values = Values { known, vacant: self.vacant, at };
        let gone = |stmt: Stmt| {
            let comment = stmt.comment.map(|text| Stmt::new(stmt.span, Op::Comment(*text)));
            Kept::Instead(comment.into_iter().collect())
        };
        match &mut stmt.op {
            Op::Assign(to, value) => {
                if let Target::Element(element) = to {
                    element.at.iter_mut().try_for_each(|index| values.number(index))?;
                }
                values.settle_word(value)?;
                if !self.vacant && is_nothing(value) && matches!(to, Target::Var(Var::Local(_))) {
                    return Ok(gone(stmt));
                }
            }
            Op::Declare(declare) => {
                declare.initial.iter_mut().flatten().try_for_each(|value| values.number(value))?;
            }
            Op::Call(call) => call.arguments.iter_mut().try_for_each(|value| values.handed(value))?,
            Op::Control(control) => {
                let Op::Control(before) = &was.op else { return Ok(Kept::As(stmt)) };
                if matches!(**control, Control::If { .. }) {
                    return self.decision(before, stmt, values);
                }
                self.turns(before, control, values)?;
            }
            Op::MessageOf(pieces) => {
                let mut all = std::mem::take(pieces).into_vec();
                for piece in &mut all {
                    if let Piece::Value { value, .. } = piece {
                        values.settle_word(value)?;
                    }
                }
                if !self.vacant {
                    all.retain(|piece| !matches!(piece, Piece::Value { value, .. } if is_nothing(value)));
                }
                *pieces = all.into();
            }
            op if arguments::computed(op) => {
                let left = values.arguments(op)?;
                if !left {
                    return Ok(gone(stmt));
                }
            }
            _ => {}
        }
        Ok(Kept::As(stmt))
    }

    /// A branch, or what it leads to where that is known.
    fn decision(&mut self, before: &Control, mut stmt: Stmt, values: Values) -> Result<Kept, Diagnostic> {
        let Op::Control(control) = &mut stmt.op else { return Ok(Kept::As(stmt)) };
        let Control::If { condition, then, otherwise } = &mut **control else { return Ok(Kept::As(stmt)) };
        let decided = holds(condition, values.known).filter(|_| !self.vacant);
        self.decided |= decided.is_some();
        let mut bodies = before.bodies();
        for (place, body) in [then, otherwise].into_iter().enumerate() {
            let Some(was) = bodies.next() else { continue };
            let own = std::mem::take(body);
            if decided.is_none_or(|holds| holds == (place == 0)) {
                *body = self.body(was, own)?;
            }
        }
        match decided {
            None => {
                values.number(condition)?;
                Ok(Kept::As(stmt))
            }
            Some(_) => {
                let comment = stmt.comment.take();
                let Op::Control(control) = stmt.op else { return Ok(Kept::Instead(Vec::new())) };
                let Control::If { then, otherwise, .. } = *control else {
                    return Ok(Kept::Instead(Vec::new()));
                };
                let mut all: Vec<Stmt> = then.into_iter().chain(otherwise).collect();
                match (all.last_mut(), comment) {
                    (Some(last), Some(comment)) => {
                        last.comment.get_or_insert(comment);
                    }
                    (None, Some(comment)) => all.push(Stmt::new(stmt.span, Op::Comment(*comment))),
                    (_, None) => {}
                }
                Ok(Kept::Instead(all))
            }
        }
    }

    /// A loop.
    fn turns(&mut self, before: &Control, control: &mut Control, values: Values) -> Result<(), Diagnostic> {
        match control {
            Control::While { condition: value, .. } | Control::Until { condition: value, .. } => {
                let known = self.facts.get(&place(before)).unwrap_or(values.known);
                Values { known, ..values }.number(value)?;
            }
            Control::Repeat { times: value, .. } => values.number(value)?,
            Control::For { from, to, step, .. } => {
                [from, to, step].into_iter().try_for_each(|value| values.number(value))?;
            }
            Control::Loop { .. } | Control::If { .. } => {}
        }
        for (was, body) in before.bodies().zip(control.bodies_mut()) {
            let own = std::mem::take(body);
            *body = self.body(was, own)?;
        }
        Ok(())
    }
}

/// Leaves out jumps to where control comes anyway.
fn over_nothing(body: &mut Vec<Stmt>) {
    let mut at = 0;
    while at < body.len() {
        let (stmt, behind) = (&body[at], &body[at + 1..]);
        let does_nothing = |stmt: &&Stmt| matches!(stmt.op, Op::Comment(_) | Op::Blank | Op::Label(_));
        let over = match &stmt.op {
            Op::Goto(to) => behind
                .iter()
                .take_while(does_nothing)
                .any(|stmt| matches!(&stmt.op, Op::Label(label) if label == to)),
            _ => false,
        };
        if over && stmt.skip.is_none() && stmt.comment.is_none() {
            body.remove(at);
        } else {
            at += 1;
        }
    }
}

/// The values of a statement.
#[derive(Clone, Copy)]
struct Values<'f> {
    known: &'f Known,
    vacant: bool,
    at: Span,
}

impl Values<'_> {
    fn refused(&self, name: &str) -> Diagnostic {
        let what = RunTimeValue::VariableMaybeEmpty { name: name.into() };
        Diagnostic::new(Fault::computes(what), self.at)
    }

    /// The first variable of an expression that is one thing or the other.
    fn unsure(&self, e: &Expr) -> Diagnostic {
        fn first<'e>(e: &'e Expr, known: &Known) -> Option<&'e str> {
            if let Expr::Node(node) = e
                && let Node::Var(Var::Local(name)) = &**node
            {
                return (known.value_of(name) != May::Number).then_some(&**name);
            }
            e.parts().find_map(|part| first(part, known))
        }
        self.refused(first(e, self.known).unwrap_or_default())
    }

    /// What may be nothing: a word, what a variable is given.
    fn settle_word(&self, e: &mut Expr) -> Result<(), Diagnostic> {
        self.settled(e, nothing())
    }

    /// What is handed over. One that may have no value is refused where it is read there: nothing reads it, so that
    /// any number will do, and a control that knows no variables without one is not asked for it.
    fn handed(&self, e: &mut Expr) -> Result<(), Diagnostic> {
        let handed_on = matches!(e, Expr::Node(node) if matches!(**node, Node::Var(_)));
        if !self.vacant && may(e, self.known) == May::Either && handed_on {
            *e = Expr::int(0);
            return Ok(());
        }
        self.settle_word(e)
    }

    /// What counts as zero where it is nothing.
    fn number(&self, e: &mut Expr) -> Result<(), Diagnostic> {
        self.settled(e, Expr::int(0))
    }

    /// What is nothing becomes this; what may be nothing or a number is refused.
    fn settled(&self, e: &mut Expr, nothing: Expr) -> Result<(), Diagnostic> {
        if self.vacant {
            return self.inner(e);
        }
        match may(e, self.known) {
            May::Nothing => {
                *e = nothing;
                Ok(())
            }
            May::Either => Err(self.unsure(e)),
            May::Number => self.inner(e),
        }
    }

    /// The words of a statement. False if one has no value without which the statement says nothing.
    fn arguments(&self, op: &mut Op) -> Result<bool, Diagnostic> {
        let droppable = matches!(op, Op::SetFeedRate(_) | Op::SetSpindleSpeed(_) | Op::SelectTool(_));
        let mut left = true;
        arguments::each(op, &mut |argument, _| {
            let takes = |value: &mut Expr| {
                self.settle_word(value)?;
                Ok(!self.vacant && is_nothing(value))
            };
            match argument {
                Argument::Word(word) => {
                    if let Some(own) = word
                        && takes(&mut own.value)?
                    {
                        *word = None;
                    }
                }
                Argument::Optional(place) => {
                    if let Some(own) = place
                        && takes(own)?
                    {
                        *place = None;
                    }
                }
                Argument::Value(value) => left &= !takes(value)? || !droppable,
            }
            Ok(())
        })?;
        Ok(left)
    }

    /// The parts of an expression.
    fn inner(&self, e: &mut Expr) -> Result<(), Diagnostic> {
        if !self.vacant
            && let Some(holds) = holds(e, self.known)
        {
            *e = Expr::int(i64::from(holds));
            return Ok(());
        }
        if let Expr::Node(node) = e
            && let Node::Call(Function::Given, arguments) = &mut **node
        {
            let [a] = &mut arguments[..] else { return Ok(()) };
            if may(a, self.known) != May::Number {
                return Err(self.unsure(a));
            }
            self.number(a)?;
            *e = a.clone();
            return Ok(());
        }
        e.parts_mut().try_for_each(|part| self.number(part))
    }
}
