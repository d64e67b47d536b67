//! Calls of one macro after every move, of a control that makes them by itself: `G66` before the first of them, `G67`
//! after the last.
//!
//! The moves are those of blocks in which nothing but the call is after them, and between which stands nothing that goes
//! another way, is skipped or acts by a cycle. What the arguments are worth is written there once; so they are numbers.

use ncc_ir::expr::{Expr, Node};
use ncc_ir::program::{Call, Op, Stmt};

use crate::common::Sink;
use crate::common::block::{Need, Part, Rank};
use crate::word::Writer;

/// Whether calls after moves are being written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::word) enum AtMoves {
    /// Each call is one of its own.
    None,
    /// The block that says the call.
    Begins,
    /// The blocks after which the control makes it.
    Within,
}

/// Blocks with such calls: from the first statement to after the last, and one of the calls.
pub(in crate::word) struct Run {
    pub(in crate::word) from: usize,
    pub(in crate::word) to: usize,
    pub(in crate::word) call: usize,
}

/// What a block is for them.
enum Kind<'s> {
    /// It moves, and the call is after the move.
    Calls(&'s Call),
    /// It does not move.
    Between,
    Other,
}

/// A code of motion without words moves nothing, and the control calls nothing after it.
fn is_move(op: &Op) -> bool {
    match op {
        Op::StraightTraverse(words) | Op::StraightFeed(words) | Op::Position(words) => !words.to.is_empty(),
        op => matches!(op, Op::ArcFeed(_)),
    }
}

/// What neither moves nor leads away.
fn is_beside(op: &Op) -> bool {
    matches!(
        op,
        Op::Comment(_)
            | Op::NoEffect(_)
            | Op::Blank
            | Op::UseLengthUnits(_)
            | Op::SetDistanceMode(_)
            | Op::SelectPlane(_)
            | Op::SetFeedMode(_)
            | Op::SetFeedRate(_)
            | Op::SetSpindleSpeed(_)
            | Op::StartSpindleClockwise
            | Op::StartSpindleCounterclockwise
            | Op::StopSpindleTurning
            | Op::FloodOn
            | Op::MistOn
            | Op::CoolantOff
            | Op::Dwell(_)
    )
}

fn is_number(value: &Expr) -> bool {
    value.literal().is_some() || matches!(value, Expr::Node(node) if **node == Node::Vacant)
}

fn kind(block: &[Stmt]) -> Kind<'_> {
    if block.iter().any(|stmt| stmt.skip.is_some()) {
        return Kind::Other;
    }
    match block {
        [before @ .., place, Stmt { op: Op::Call(call), comment: None, .. }]
            if is_move(&place.op) && before.iter().all(|stmt| is_beside(&stmt.op)) =>
        {
            match call.arguments.iter().all(is_number) {
                true => Kind::Calls(call),
                false => Kind::Other,
            }
        }
        block if block.iter().all(|stmt| is_beside(&stmt.op)) => Kind::Between,
        _ => Kind::Other,
    }
}

impl Writer {
    /// Where the control makes calls after moves by itself.
    pub(in crate::word) fn runs_at_moves(&self, stmts: &[Stmt]) -> Vec<Run> {
        let mut runs: Vec<Run> = Vec::new();
        // A call in the block of something else is rare, and looked for first.
        let beside = |stmt: &Stmt| stmt.joined && matches!(stmt.op, Op::Call(_));
        if self.words.codes.calls_at_moves.is_none() || !stmts.iter().any(beside) {
            return runs;
        }
        let mut open: Option<(Run, &Call)> = None;
        let mut at = 0;
        while at < stmts.len() {
            let end = self.words.block_end(stmts, at);
            match kind(&stmts[at..end]) {
                Kind::Calls(call) if self.calls_with_variables(call) => match &mut open {
                    Some((run, own)) if *own == call => run.to = end,
                    _ => {
                        runs.extend(open.take().map(|(run, _)| run));
                        open = Some((Run { from: at, to: end, call: end - 1 }, call));
                    }
                },
                Kind::Between => {}
                Kind::Calls(_) | Kind::Other => runs.extend(open.take().map(|(run, _)| run)),
            }
            at = end;
        }
        runs.extend(open.map(|(run, _)| run));
        runs
    }

    /// The block that says the call.
    pub(in crate::word) fn begin_calls_at_moves(&mut self, call: &Stmt, sink: &mut Sink) {
        let said = [Stmt::new(call.span, call.op.clone())];
        self.words.pass_on(sink.out);
        self.at_moves = AtMoves::Begins;
        self.source_block(&said, sink);
        self.at_moves = AtMoves::Within;
        if self.words.trace.is_some() {
            self.words.block_written(sink.out);
        }
    }

    /// The block that ends the calls.
    pub(in crate::word) fn end_calls_at_moves(&mut self, call: &Stmt, sink: &mut Sink) {
        self.at_moves = AtMoves::None;
        let Some((_, code)) = self.words.codes.calls_at_moves else { return };
        self.words.pass_on(sink.out);
        let said = [Stmt::new(call.span, Op::Blank)];
        self.open_block(&said[0]);
        self.words.block.skip = None;
        match self.words.admit(&Need::new(Rank::Alone).code(Some(code)), sink) {
            Ok(()) => self.words.block.code(Part::Tail, &code),
            Err(fault) => sink.report(fault, call.span),
        }
        self.close_block(&said, sink);
        if self.words.trace.is_some() {
            self.words.block_written(sink.out);
        }
    }
}
