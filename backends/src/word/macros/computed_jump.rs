//! Jumps to the block whose number is computed: branches for one value in one block, which go to the block of the
//! number that they compare it with, and an alarm of the control after them.
//!
//! Read again, `GOTO` with a value is a branch for each block that has a number; so these must be all of them, by
//! their own numbers, which the verification tells.

use ncc_ir::diag::Fault;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::{Binary, Expr, Node};
use ncc_ir::program::{Control, NO_SUCH_BLOCK, Op, Stmt};
use ncc_ir::run_time::RunTimeFlow;

use crate::common::Sink;
use crate::common::fault::cannot_compute;
use crate::word::Writer;

/// Such a jump.
pub(in crate::word) struct JumpOf<'s> {
    condition: Option<&'s Expr>,
    value: &'s Expr,
    /// Each block's number and its label.
    to: Vec<(i64, &'s str)>,
}

/// A branch for one statement.
fn decided(stmt: &Stmt) -> Option<(&Expr, &Op)> {
    let Op::Control(control) = &stmt.op else { return None };
    match &**control {
        Control::If { condition, then, otherwise } if otherwise.is_empty() => match &then[..] {
            [only] => Some((condition, &only.op)),
            _ => None,
        },
        _ => None,
    }
}

fn binary(e: &Expr, operator: Binary) -> Option<(&Expr, &Expr)> {
    let Expr::Node(node) = e else { return None };
    match &**node {
        Node::Binary(own, a, b) if *own == operator => Some((a, b)),
        _ => None,
    }
}

/// Whether a statement is the alarm after such branches, and what it depends on.
fn ends(stmt: &Stmt) -> Option<Option<&Expr>> {
    let (condition, op) = decided(stmt).map_or((None, &stmt.op), |(condition, op)| (Some(condition), op));
    let Op::Alarm(alarm) = op else { return None };
    (alarm.number.is_none() && *alarm.text == *NO_SUCH_BLOCK).then_some(condition)
}

/// The jump that ends a block, and what stands before it.
pub(in crate::word) fn found(stmts: &[Stmt]) -> (&[Stmt], Option<JumpOf<'_>>) {
    let Some((last, rest)) = stmts.split_last() else { return (stmts, None) };
    let Some(condition) = ends(last) else { return (stmts, None) };
    let mut to = Vec::new();
    let mut value: Option<&Expr> = None;
    let mut before = rest.len();
    for stmt in rest.iter().rev() {
        let Some((holds, Op::Goto(label))) = decided(stmt) else { break };
        let compared = match condition {
            None => Some(holds),
            Some(condition) => binary(holds, Binary::And).filter(|(a, _)| *a == condition).map(|(_, b)| b),
        };
        let Some((own, Expr::Num(number))) = compared.and_then(|c| binary(c, Binary::Equal)) else { break };
        let Num { mantissa, scale: 0, unit: Unit::One, .. } = *number else { break };
        if value.is_some_and(|value| value != own) {
            break;
        }
        value = Some(own);
        to.push((mantissa, &**label));
        before -= 1;
    }
    match value {
        Some(value) => (&rest[..before], Some(JumpOf { condition, value, to })),
        None => (stmts, None),
    }
}

impl Writer {
    /// Such a jump as the control says it.
    pub(in crate::word) fn jump_to_number(
        &mut self,
        jump: &JumpOf,
        stmt: &Stmt,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        self.words.spelling(None)?;
        let own = |(number, label): &(i64, &str)| self.number_of_label(label).map(i64::from) == Some(*number);
        if !self.dialect.program.macro_b || !jump.to.iter().all(own) {
            return Err(cannot_compute(RunTimeFlow::ComputedJump));
        }
        self.flow(stmt, sink)?;
        let blank = if self.dialect.block.blanks { " " } else { "" };
        let condition = match jump.condition {
            Some(condition) => {
                format!("IF{blank}{}{blank}", self.words.condition(condition, stmt.span, sink)?)
            }
            None => String::new(),
        };
        let value = self.words.behind(jump.value, None, stmt.span, sink)?;
        self.statement_alone(&format!("{condition}GOTO{blank}{value}"), sink)
    }
}
