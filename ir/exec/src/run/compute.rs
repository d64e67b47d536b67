//! A statement's arguments, computed: literals in the places of expressions.
//!
//! Not here: the value of an expression (`term`).

use std::rc::Rc;

use ncc_ir::canon::FeedMode;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Unit;
use ncc_ir::expr::value::Value;
use ncc_ir::program::arguments;
use ncc_ir::program::{Centre, Coord, Move, Op, Point, Stmt};
use ncc_ir::unexecuted::ValueUnexecuted;

use super::Runner;
use crate::message;
use crate::run::term::{Asked, literal, real};

impl Runner<'_> {
    /// Computes a statement's arguments; `false` where nothing is left of it.
    pub(super) fn compute(&mut self, at: usize, asked: Asked) -> Result<bool, Diagnostic> {
        let code = Rc::clone(&self.code);
        let computed = &code.computed[at];
        let (stmt, now) = (computed.stmt, &mut self.now);
        if std::mem::replace(&mut self.now_of, at) != at {
            *now = written(stmt);
        }
        let variables = &self.variables;
        let fault = |fault| Diagnostic::new(fault, stmt.span);
        let mut terms = computed.terms.iter();
        match (&stmt.op, &mut now.op) {
            (Op::StraightFeed(from), Op::StraightFeed(to))
            | (Op::StraightTraverse(from), Op::StraightTraverse(to))
            | (Op::Position(from), Op::Position(to))
            | (Op::Hole(from), Op::Hole(to)) => {
                for ((axis, word), term) in from.to.axes.iter().enumerate().zip(terms) {
                    if let (Some(word), Some(term)) = (word, term) {
                        let value =
                            variables.value(term, asked).map_err(|why| fault(code.names.fault(why)))?;
                        let unit = if axis < 3 { Unit::Entry } else { Unit::Degree };
                        let value = literal(value, unit).map_err(fault)?;
                        to.to.axes[axis] =
                            value.map(|n| Coord { value: Expr::Num(n), distance: word.distance });
                    }
                }
                let makes_holes = matches!(stmt.op, Op::Hole(_) | Op::Position(_));
                if makes_holes && to.to.axes.iter().all(Option::is_none) {
                    return Err(fault(Fault::not_executed(ValueUnexecuted::PositionWithoutValue)));
                }
                return Ok(true);
            }
            _ => {}
        }
        if asked.exec.shown.leaves_out(&stmt.op) {
            return Ok(false);
        }
        if let Some(pieces) = message::pieces(&stmt.op) {
            let text = asked.exec.shown.clone().with_values(pieces, &mut |value| match terms.next() {
                Some(Some(term)) => variables.value(term, asked).map_err(|why| fault(code.names.fault(why))),
                _ => Ok(value.literal().map_or(Value::Vacant, |n| Value::Number(real(n)))),
            })?;
            now.op = message::said(&stmt.op, text);
            return Ok(true);
        }
        now.op = stmt.op.clone();
        let per_time = asked.exec.state.feed_mode == FeedMode::InverseTime;
        let rate = matches!(now.op, Op::SetFeedRate(_));
        let positive = rate || matches!(now.op, Op::SetSpindleSpeed(_) | Op::SelectTool(_) | Op::Dwell(_));
        let mut left = true;
        let droppable = matches!(now.op, Op::SetFeedRate(_) | Op::SetSpindleSpeed(_) | Op::SelectTool(_));
        arguments::each(&mut now.op, &mut |argument, unit| {
            let Some(Some(term)) = terms.next() else { return Ok(()) };
            let value = variables.value(term, asked).map_err(|why| fault(code.names.fault(why)))?;
            let unit = if rate && per_time { Unit::One } else { unit };
            if positive && value != Value::Vacant && value.number() < 0.0
                || rate && value == Value::Number(0.0)
            {
                return Err(fault(Fault::not_executed(ValueUnexecuted::NotPositive)));
            }
            match literal(value, unit).map_err(fault)? {
                Some(n) => argument.set(Expr::Num(n)),
                None => match argument {
                    arguments::Argument::Word(word) => *word = None,
                    arguments::Argument::Optional(place) => *place = None,
                    arguments::Argument::Value(_) if droppable => left = false,
                    arguments::Argument::Value(_) => {
                        return Err(fault(Fault::not_executed(ValueUnexecuted::WordWithoutValue)));
                    }
                },
            }
            Ok(())
        })?;
        if let Op::ArcFeed(arc) = &now.op
            && let Centre::Point { words, .. } = &arc.centre
            && words.iter().all(Option::is_none)
        {
            return Err(fault(Fault::ArcWithoutCentre));
        }
        Ok(left)
    }
}

/// A statement with as much of it as need not be computed.
fn written(stmt: &Stmt) -> Stmt {
    let plain = |to: &Move| {
        let literal = |word: &Coord| word.value.literal().is_some();
        let own = |axis: usize| to.to.axes[axis].as_ref().filter(|word| literal(word)).cloned();
        let axes = std::array::from_fn(own);
        Move { to: Point { axes }, said: to.said }
    };
    let op = match &stmt.op {
        Op::StraightFeed(to) => Op::StraightFeed(plain(to)),
        Op::StraightTraverse(to) => Op::StraightTraverse(plain(to)),
        Op::Position(to) => Op::Position(plain(to)),
        Op::Hole(to) => Op::Hole(plain(to)),
        // The whole of it is made again each time.
        _ => Op::Blank,
    };
    let Stmt { span, number, skip, joined, .. } = *stmt;
    Stmt { span, number, skip, joined, comment: stmt.comment.clone(), op }
}
