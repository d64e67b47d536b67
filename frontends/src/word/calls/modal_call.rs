//! Lowering of a macro call that comes again after every block that moves an axis, until it is called off (B-63684EN,
//! custom macro, modal call): each of them is a call of its own after the move. Another comes in every block, whose
//! words are its arguments: each of those blocks is a call.
//!
//! The arguments are worth what they are in the block that says them; so they are numbers, or the program's local
//! variables, which nothing sets until the calls are over.
//!
//! Refused: one within another, other calls and cycles while it is active, and ways from where it is active
//! to where it is not.

use std::collections::{BTreeSet, HashMap};

use ncc_dialects::Meaning;
use ncc_ir::diag::Fault;
use ncc_ir::expr::{Expr, Node, Var};
use ncc_ir::program::{Call, Op, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::unsupported::CallUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::common::words::{Value, Word, tenths};
use crate::initial_modes::Jumps;
use crate::word::block_words::{Code, Words};
use crate::word::lower::Lower;
use crate::word::macros::computes::{AtMoves, Computes};
use crate::word::text::block::Block;

/// The option that says whether the block of such a code makes a call itself.
const OWN_BLOCK: &str = "own_block_call";

impl Lower {
    /// Which calls at moves are active; 0 is none.
    pub(in crate::word) fn active_calls(&self) -> u32 {
        self.computes.at_moves.as_ref().map_or(0, |calls| calls.which)
    }

    pub(in crate::word) fn refuse_modal(
        &mut self,
        code: &str,
        what: CallUnsupported,
        at: Span,
        out: &mut Batch,
    ) {
        self.fault(Fault::not_supported(code, what), at, out);
    }

    /// The same, by the code that has said the calls.
    pub(in crate::word) fn refuse_under(&mut self, what: CallUnsupported, at: Span, out: &mut Batch) {
        let code = self.computes.reach.code.clone();
        self.refuse_modal(&code, what, at, out);
    }

    /// The block that says the call; it makes none itself.
    pub(in crate::word) fn begin_calls_at_moves(
        &mut self,
        code: &Code,
        call: Call,
        block: &Block,
        out: &mut Batch,
    ) {
        let what = if self.computes.at_moves.is_some() {
            CallUnsupported::ModalInModal
        } else if block.skip != 0 {
            CallUnsupported::ModalMacroSkipped
        } else if !call.arguments.iter().all(stays) {
            CallUnsupported::ModalArgument
        } else if self.now.failed {
            return;
        } else {
            let what = match code.meaning {
                Meaning::CallMacroAtBlocks => "MODAL_MACRO_CALL words",
                _ => "MODAL_MACRO_CALL anew",
            };
            self.assume_row(code.row, what, code.span, out);
            self.now.silent = true;
            self.computes.reach.seen += 1;
            self.computes.reach.code = code.row.code.as_str().into();
            let own = self.sub.as_ref().map(|program| program.name.clone()).unwrap_or_default();
            self.computes.reach.called.push((own, call.name.clone(), code.span));
            let computed = call.arguments.iter().any(|value| value.literal().is_none() && !is_vacant(value));
            let which = self.computes.reach.seen;
            self.computes.at_moves = Some(AtMoves { call, which, computed, by_words: None });
            return;
        };
        self.refuse_modal(&code.row.code, what, code.span, out);
    }

    /// The block after which every block is a call, and is one itself where the control has it so.
    pub(in crate::word) fn begin_calls_at_blocks(
        &mut self,
        code: &Code,
        call: Call,
        block: &Block,
        out: &mut Batch,
    ) {
        let own = Call { arguments: Vec::new(), ..call.clone() };
        self.begin_calls_at_moves(code, own, block, out);
        let Some(calls) = self.computes.at_moves.as_mut().filter(|_| !self.now.failed) else { return };
        calls.by_words = Some(*code);
        if self.option(OWN_BLOCK, code.span, out) == "calls" {
            self.now.silent = false;
            self.leave_motion(None, out);
            self.push(block.span, Op::Call(Box::new(call)), out);
            self.lose(block.span, out);
        }
    }

    /// The code of the calls of which a block is one by its words.
    pub(in crate::word) fn by_words(&mut self, block: &Block, src: Source, out: &mut Batch) -> Option<Code> {
        let code = self.computes.at_moves.as_ref()?.by_words?;
        if block.statement.is_some() || block.decision.is_some() {
            self.refuse_under(CallUnsupported::ArgumentStatement, block.span, out);
            return None;
        }
        let number = self.settings.dialect.block.number.map_or(0, |c| c as u8);
        let words = || block.words.iter().filter(|word| word.letter != number);
        let ends = |word: &&Word| {
            let Value::Number(digits) = word.value else { return false };
            let row = tenths(digits).and_then(|number| self.settings.dialect.code_row(word.letter, number));
            row.is_some_and(|row| row.means == Some(Meaning::EndCallsAtMoves))
        };
        if words().any(|word| ends(&word)) {
            // One that moves an axis is refused as such.
            let axis = words().any(|word| b"XYZABC".contains(&word.letter));
            if words().count() > 1 && !axis {
                self.refuse_under(CallUnsupported::ArgumentEnd, block.span, out);
            }
            return None;
        }
        words().next()?;
        // Of a function no source of this control says that it is an argument, and not what it always is.
        if let Some(other) = words().find(|word| b"GMSTPLO".contains(&word.letter)) {
            let what = CallUnsupported::ArgumentWord { word: src.text(other.span) };
            self.refuse_under(what, other.span, out);
            return None;
        }
        Some(code)
    }

    /// Such a block.
    pub(in crate::word) fn call_by_words(&mut self, arguments: Vec<Expr>, block: &Block, out: &mut Batch) {
        let Some(call) = self.computes.at_moves.as_ref().map(|calls| calls.call.clone()) else { return };
        self.computes.calls(&call.name, arguments.len());
        self.leave_motion(None, out);
        self.push(block.span, Op::Call(Box::new(Call { arguments, ..call })), out);
        self.lose(block.span, out);
    }

    /// The calls are over; where none are active, nothing is.
    pub(in crate::word) fn end_calls_at_moves(&mut self, code: &Code, words: &Words, out: &mut Batch) {
        self.now.silent = true;
        if self.computes.at_moves.is_none() {
            return;
        }
        if self.now.skip.is_some() {
            return self.refuse_modal(&code.row.code, CallUnsupported::ModalEndSkipped, code.span, out);
        }
        if self.has_axis_word(words) {
            // Whether the block's own move is one of those after which it is called, no manual says.
            return self.refuse_modal(&code.row.code, CallUnsupported::ModalEndMoves, code.span, out);
        }
        self.computes.at_moves = None;
    }

    /// After a block that moves an axis.
    pub(in crate::word) fn call_at_moves(&mut self, block: &Block, src: Source, out: &mut Batch) {
        let at_moves = self.computes.at_moves.as_ref().is_some_and(|calls| calls.by_words.is_none());
        if !at_moves || self.now.failed || block.statement.is_some() {
            return;
        }
        let mark = self.now.mark;
        let own = self.target(out).get(mark..).unwrap_or_default();
        let other = own.iter().any(|stmt| {
            matches!(
                stmt.op,
                Op::GoToReference(_)
                    | Op::OrientToolAxis(_)
                    | Op::UseMachineCoordinates { .. }
                    | Op::StartCycle(_)
                    | Op::Hole(_)
                    | Op::Pattern(_)
                    | Op::Polar(_)
                    | Op::Corner { .. }
                    | Op::Detour(_)
            )
        });
        let moves = own.iter().any(|stmt| {
            matches!(
                stmt.op,
                Op::StraightTraverse(_)
                    | Op::StraightFeed(_)
                    | Op::SynchronisedFeed(_)
                    | Op::ArcFeed(_)
                    | Op::ArcForm(_)
                    | Op::Position(_)
            )
        });
        if other {
            let what = CallUnsupported::ModalOther;
            return self.refuse_under(what, block.span, out);
        }
        if !moves {
            return;
        }
        if self.level_open() {
            return self.refuse_level(block.span, out);
        }
        let Some(call) = self.computes.at_moves.as_ref().map(|calls| calls.call.clone()) else { return };
        // The block's comment is the move's.
        if let Some(comment) = self.plain_comment(block, src).filter(|_| !self.now.commented) {
            self.now.commented = true;
            if let Some(stmt) = self.target(out).last_mut() {
                stmt.comment = Some(Box::new(comment));
            }
        }
        self.leave_motion(None, out);
        self.push(block.span, Op::Call(Box::new(call)), out);
        self.lose(block.span, out);
    }

    /// Whether a modal call is active, where none of its own may be made (reported).
    pub(in crate::word) fn within_modal(&mut self, at: Span, out: &mut Batch) -> bool {
        let within = self.computes.at_moves.is_some();
        if within {
            self.refuse_under(CallUnsupported::ModalFlow, at, out);
        }
        within
    }

    /// A variable is set.
    pub(in crate::word) fn argument_changes(&mut self, at: Span, out: &mut Batch) {
        if self.computes.at_moves.as_ref().is_some_and(|calls| calls.computed) {
            let what = CallUnsupported::ModalAssignment;
            self.refuse_under(what, at, out);
        }
    }

    /// The end of a program: jumps lead from where the same calls are active.
    pub(in crate::word) fn calls_over(&mut self, out: &mut Batch) {
        self.computes.at_moves = None;
        self.computes.reach.unsaid_at_jumps = Jumps::default();
        let labels = std::mem::take(&mut self.computes.reach.labels);
        let mut by_number: HashMap<u32, BTreeSet<u32>> = HashMap::new();
        for (number, calls) in &labels {
            by_number.entry(*number).or_default().insert(*calls);
        }
        let all: BTreeSet<u32> = labels.iter().map(|(_, calls)| *calls).collect();
        for (to, from, at) in std::mem::take(&mut self.computes.reach.jumps) {
            let calls = match to {
                Some(to) => by_number.get(&to),
                None => Some(&all),
            };
            if calls.is_some_and(|calls| calls.iter().any(|calls| *calls != from)) {
                self.refuse_under(CallUnsupported::ModalJump, at, out);
            }
        }
    }
}

impl Computes {
    /// The text is over: what is called after moves must have no such calls itself, nor what it calls. How one works
    /// within another is not translated.
    pub(in crate::word) fn no_calls_within(&self, out: &mut Batch) {
        for (_, name, at) in &self.reach.called {
            let mut known: Vec<&Text> = vec![name];
            let mut next = 0;
            while let Some(name) = known.get(next).copied() {
                next += 1;
                if self.reach.called.iter().any(|(own, ..)| own == name) {
                    let what = CallUnsupported::ModalInModal.into();
                    out.report(Fault::NotSupported { code: self.reach.code.clone(), what }, *at);
                    break;
                }
                let bodies = out.procedures.iter().filter(|procedure| procedure.name == *name);
                bodies.for_each(|procedure| calls_of(&procedure.body, &mut known));
            }
        }
    }
}

/// The programs that a body calls.
fn calls_of<'s>(body: &'s [Stmt], known: &mut Vec<&'s Text>) {
    for stmt in body {
        if let Op::Call(call) = &stmt.op {
            if !known.contains(&&call.name) {
                known.push(&call.name);
            }
        } else if let Op::Control(control) = &stmt.op {
            control.bodies().for_each(|body| calls_of(body, known));
        }
    }
}

fn is_vacant(value: &Expr) -> bool {
    matches!(value, Expr::Node(node) if **node == Node::Vacant)
}

/// Whether it has the same value until a local variable is set.
fn stays(value: &Expr) -> bool {
    let Expr::Node(node) = value else { return true };
    match &**node {
        Node::Vacant | Node::Var(Var::Local(_)) => true,
        Node::Var(_) | Node::Element(_) => false,
        Node::Unary(..) | Node::Binary(..) | Node::Call(..) => value.parts().all(stays),
    }
}
