//! Calls, jumps and repetitions of a run: what comes next, and what is left of each.

use std::rc::Rc;

use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::value::Value;
use ncc_ir::program::{Op, Stmt};
use ncc_ir::source::Span;
use ncc_ir::unexecuted::FlowUnexecuted;

use super::{NOWHERE, Runner};
use crate::run::code::{Again, At, Called};
use crate::run::nesting::{Blocks, Frame};
use crate::run::term::{Asked, Why};

/// Deepest nesting of calls and repetitions.
const DEEPEST: usize = 64;

impl<'p> Runner<'p> {
    /// That a way back leads to where something is different.
    #[inline]
    pub(super) fn goes_on(&mut self, from: At, span: Span) -> Result<(), Diagnostic> {
        let back = self.at < from && !self.asks();
        if back && self.endless_loop.again(self.at, &self.variables, &self.calls, &self.turns, &self.blocks) {
            return Err(Diagnostic::new(Fault::Endless, span));
        }
        Ok(())
    }

    pub(super) fn another_turn(&mut self, to: At) {
        match self.turns.last_mut() {
            Some(left) if *left > 0 => {
                *left -= 1;
                self.at = to;
            }
            Some(_) | None => {
                self.turns.pop();
            }
        }
    }

    fn deep(&self, name: &str, span: Span) -> Result<(), Diagnostic> {
        if self.calls.len() + self.blocks.len() + self.turns.len() >= DEEPEST {
            return Err(Diagnostic::new(
                Fault::CallsTooDeep { name: name.into(), most: DEEPEST as u32 },
                span,
            ));
        }
        Ok(())
    }

    pub(super) fn call(&mut self, called: &Called, asked: Asked, span: Span) -> Result<(), Diagnostic> {
        let name = &called.call.name;
        let Some(entry) = called.entry else {
            return Err(Diagnostic::new(Fault::CallUnknown { name: name.clone() }, span));
        };
        if called.call.times == 0 {
            return Ok(());
        }
        self.deep(name, span)?;
        let given: Result<Rc<[Value]>, Why> =
            called.arguments.iter().map(|term| self.variables.value(term, asked)).collect();
        let given = given.map_err(|why| self.no_value(why, span))?;
        let frame = Frame {
            entry,
            back: self.at,
            again: called.call.times - 1,
            turns: self.turns.len(),
            base: self.variables.base,
            shared: called.call.shared,
            parameters: called.parameters.clone(),
            given,
        };
        if !frame.shared {
            self.variables.base = self.variables.locals.len();
        }
        self.enter(&frame);
        self.calls.push(frame);
        self.end = NOWHERE;
        Ok(())
    }

    /// Gives a call its locals, new ones each time if it has its own, and its parameters.
    fn enter(&mut self, frame: &Frame) {
        if !frame.shared {
            let base = self.variables.base;
            self.variables.locals.truncate(base);
            self.variables.locals.resize(base + self.code.names.count as usize, Value::Vacant);
        }
        for (place, value) in frame.parameters.iter().zip(&*frame.given) {
            self.variables.set(*place, *value);
        }
        self.at = frame.entry;
    }

    /// Ends the present call; `false` is the main procedure.
    pub(super) fn leave(&mut self) -> bool {
        let Some(mut frame) = self.calls.pop() else { return false };
        if frame.back == NOWHERE {
            self.calls.push(frame);
            return false;
        }
        self.turns.truncate(frame.turns);
        let depth = self.calls.len();
        self.blocks.retain(|blocks| blocks.call <= depth);
        if frame.again > 0 {
            frame.again -= 1;
            self.enter(&frame);
            self.calls.push(frame);
        } else {
            if !frame.shared {
                self.variables.locals.truncate(self.variables.base);
                self.variables.base = frame.base;
            }
            self.at = frame.back;
        }
        self.find_end();
        true
    }

    pub(super) fn jump(&mut self, to: Option<(At, u32)>, stmt: &Stmt) -> Result<(), Diagnostic> {
        let Some((to, counted)) = to else {
            let Op::Goto(label) = &stmt.op else {
                return Err(Diagnostic::new(
                    Fault::not_executed(FlowUnexecuted::LeaveOutsideLoop),
                    stmt.span,
                ));
            };
            return Err(Diagnostic::new(Fault::LabelUnknown { name: label.clone() }, stmt.span));
        };
        let inner = self.blocks.last().filter(|blocks| blocks.call == self.calls.len());
        if inner.is_some_and(|blocks| !(blocks.begin..blocks.end).contains(&to)) {
            return Err(Diagnostic::new(Fault::not_executed(FlowUnexecuted::JumpOutOfRepetition), stmt.span));
        }
        let open = match (inner, self.calls.last()) {
            (Some(blocks), _) => blocks.turns + counted.saturating_sub(blocks.counted) as usize,
            (None, Some(frame)) => frame.turns + counted as usize,
            (None, None) => 0,
        };
        self.turns.truncate(open);
        self.at = to;
        Ok(())
    }

    pub(super) fn again(&mut self, again: &Again, times: u64, stmt: &Stmt) -> Result<(), Diagnostic> {
        let Some((begin, end)) = again.steps else {
            let Op::RepeatBlocks(repeat) = &stmt.op else { return Ok(()) };
            return Err(Diagnostic::new(Fault::LabelUnknown { name: repeat.from.clone() }, stmt.span));
        };
        if times > 0 && begin < end {
            self.deep("", stmt.span)?;
            let (call, turns) = (self.calls.len(), self.turns.len());
            let left = times - 1;
            let counted = again.counted;
            self.blocks.push(Blocks { begin, end, back: self.at, again: left, call, turns, counted });
            self.at = begin;
            self.end = end;
        }
        Ok(())
    }

    pub(super) fn end_of_blocks(&mut self) {
        let Some(blocks) = self.blocks.last_mut() else { return };
        if blocks.again > 0 {
            blocks.again -= 1;
            self.at = blocks.begin;
        } else {
            self.at = blocks.back;
            self.blocks.pop();
            self.find_end();
        }
    }

    fn find_end(&mut self) {
        let here = self.blocks.last().filter(|blocks| blocks.call == self.calls.len());
        self.end = here.map_or(NOWHERE, |blocks| blocks.end);
    }
}
