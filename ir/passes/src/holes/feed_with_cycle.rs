//! `feed-with-cycle`: a feed that is stated right before a cycle is stated by the cycle.
//!
//! A cycle states its feed again at every hole, so that the machine does the same. Only where
//! nothing but remarks stands between, under the same block skip, and the cycle says no feed itself.

use crate::pass::Pass;
use crate::support::write::rebuild;
use crate::target::Target;
use ncc_ir::diag::Diagnostic;
use ncc_ir::expr::Expr;
use ncc_ir::program::{Op, Program, Stmt};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass =
    Pass::named("feed-with-cycle", "lets a cycle say the feed that stands right before it", Some(run));

/// Moves the feeds.
pub fn run(program: &mut Program, _: &Target, _: &Tracker, _: &mut Vec<Diagnostic>) {
    for procedure in &mut program.procedures {
        join_feed(&mut procedure.body);
    }
}

/// The same for one body.
fn join_feed(body: &mut Vec<Stmt>) {
    let mut moved: Option<Expr> = None;
    let takes: Vec<bool> = (0..body.len()).map(|at| is_taken(&body[at..])).collect();
    let mut takes = takes.into_iter();
    rebuild(body, |mut stmt, made| {
        if takes.next() == Some(true)
            && let Op::SetFeedRate(feed) = &stmt.op
        {
            moved = Some(feed.clone());
            return made.leave_out(stmt);
        }
        if let Op::StartCycle(cycle) = &mut stmt.op
            && let Some(feed) = moved.take()
        {
            cycle.feed = Some(feed);
        }
        made.push(stmt);
    });
}

/// Whether the first statement is a feed that the cycle activated next can say.
fn is_taken(stmts: &[Stmt]) -> bool {
    let Some((first, rest)) = stmts.split_first() else { return false };
    let Op::SetFeedRate(_) = &first.op else { return false };
    let next = rest.iter().find(|stmt| !matches!(stmt.op, Op::Comment(_) | Op::Blank));
    // A block of its own: the feed of a block with more in it stays there.
    let alone = !first.joined && rest.first().is_none_or(|stmt| !stmt.joined);
    alone
        && next.is_some_and(|stmt| match &stmt.op {
            Op::StartCycle(cycle) => cycle.feed.is_none() && stmt.skip == first.skip,
            _ => false,
        })
}
