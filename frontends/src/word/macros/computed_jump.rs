//! Jumps to the block whose number is computed (B-63684EN, custom macro, unconditional branch: "a sequence number can
//! also be specified using an expression", `GOTO #10`): a branch for each block of the program that a jump can go
//! to, and an alarm where none has the number (alarm 128).
//!
//! They are made when the text is read, since blocks further down are among them. What the number is rounded to, no
//! manual says: one that is not whole is that of no block.

use ncc_ir::expr::{Binary, Expr, Node};
use ncc_ir::program::{Alarm, Control, NO_SUCH_BLOCK, Op, Stmt, Text};

use super::computes::{ComputedJump, Computes, label};
use crate::batch::Batch;

/// What a jump is called until the text is read: no block has this name.
fn mark(at: usize) -> Text {
    format!("#{at}").into()
}

impl Computes {
    /// A jump to the block of a number that is computed, if a condition holds. Gives where it goes until
    /// [`Computes::join_jumps`].
    pub(in crate::word) fn computed_jump(&mut self, condition: Option<Expr>, to: Expr) -> Text {
        self.computed_jumps.push(ComputedJump { condition, to });
        mark(self.computed_jumps.len() - 1)
    }

    /// The text is over: such jumps become branches for the blocks of their program.
    pub(in crate::word) fn join_jumps(&self, out: &mut Batch) {
        if self.computed_jumps.is_empty() {
            return;
        }
        self.join(&mut out.stmts, &[]);
        for procedure in &mut out.procedures {
            self.join(&mut procedure.body, &[]);
        }
    }

    /// `outside` are the numbers of the blocks of the bodies that this one is in: into a loop no jump goes.
    fn join(&self, body: &mut Vec<Stmt>, outside: &[u32]) {
        let mut numbers = outside.to_vec();
        for stmt in &*body {
            if let Op::Label(name) = &stmt.op
                && let Some(number) = name.strip_prefix('N').and_then(|n| n.parse().ok())
                && !numbers.contains(&number)
            {
                numbers.push(number);
            }
        }
        let mut at = 0;
        while at < body.len() {
            match &mut body[at].op {
                Op::Control(control) => control.bodies_mut().for_each(|body| self.join(body, &numbers)),
                Op::Goto(name) => {
                    let found = name.strip_prefix('#').and_then(|n| n.parse::<usize>().ok());
                    if let Some(jump) = found.and_then(|found| self.computed_jumps.get(found)) {
                        let chain = jump.decisions(&numbers, &body[at]);
                        let length = chain.len();
                        body.splice(at..=at, chain);
                        at += length;
                        continue;
                    }
                }
                _ => {}
            }
            at += 1;
        }
    }
}

impl ComputedJump {
    /// The branches, in the block of the jump.
    fn decisions(&self, numbers: &[u32], jump: &Stmt) -> Vec<Stmt> {
        let both = |a: Option<Expr>, b: Option<Expr>| match (a, b) {
            (Some(a), Some(b)) => Some(Expr::Node(Box::new(Node::Binary(Binary::And, a, b)))),
            (a, b) => a.or(b),
        };
        let of = |condition: Option<Expr>, op: Op| match condition {
            None => op,
            Some(condition) => {
                let then = vec![Stmt::new(jump.span, op)];
                Op::Control(Box::new(Control::If { condition, then, otherwise: Vec::new() }))
            }
        };
        let mut all: Vec<Stmt> = Vec::with_capacity(numbers.len() + 1);
        for number in numbers {
            let is = Node::Binary(Binary::Equal, self.to.clone(), Expr::int(i64::from(*number)));
            let condition = both(self.condition.clone(), Some(Expr::Node(Box::new(is))));
            all.push(Stmt::new(jump.span, of(condition, Op::Goto(label(*number)))));
        }
        let alarm = Op::Alarm(Box::new(Alarm { number: None, text: NO_SUCH_BLOCK.into() }));
        all.push(Stmt::new(jump.span, of(self.condition.clone(), alarm)));
        for (at, stmt) in all.iter_mut().enumerate() {
            stmt.skip = jump.skip;
            (stmt.joined, stmt.number) = if at == 0 { (jump.joined, jump.number) } else { (true, None) };
        }
        if let Some(last) = all.last_mut() {
            last.comment.clone_from(&jump.comment);
        }
        all
    }
}
