//! Calls of blocks of the program itself (96-8000, M97: a subroutine referenced by a line number within the same program,
//! ended by M99; L the repeat count; `M98 Q` without P of a 30i): they become subprograms, which have their caller's variables.
//!
//! They are cut out when the text has been read. Refused: blocks that the program also runs into or jumps into,
//! or out of; such a call in a subprogram, or beside jumps whose number is computed.

use ncc_dialects::{CodeRow, Dialect, Meaning, Quantity};
use ncc_ir::computed::computed_call::so_often;
use ncc_ir::diag::Fault;
use ncc_ir::program::{Call, Op, Procedure, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::unsupported::CallUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::common::words::{Value, Word};
use crate::word::block_words::{Code, Words};
use crate::word::lower::Lower;
use crate::word::macros::computes::{Computes, LocalCall, label};

const WITHIN: CallUnsupported = CallUnsupported::BlocksInSub;
const COMPUTED: CallUnsupported = CallUnsupported::BlocksComputed;
const BESIDE: CallUnsupported = CallUnsupported::BlocksBesideJumps;
const NOT_THERE: CallUnsupported = CallUnsupported::BlocksMissing;
const TWICE: CallUnsupported = CallUnsupported::BlocksTwice;
const RUN_INTO: CallUnsupported = CallUnsupported::BlocksRunInto;
const NO_RETURN: CallUnsupported = CallUnsupported::BlocksNoReturn;
const JUMPED_INTO: CallUnsupported = CallUnsupported::BlocksJumpedInto;

/// Whether a text has a word that calls a block: a code of that meaning whose row has `blocks`.
pub(in crate::word) fn has_local_calls(text: &[u8], dialect: &Dialect) -> bool {
    let mut rows =
        dialect.code.iter().filter(|row| row.means == Some(Meaning::Call) && !row.blocks.is_empty());
    rows.any(|row| {
        let code = row.code.as_bytes();
        memchr::memmem::find_iter(text, &code[1..]).any(|at| {
            let begins = at > 0 && text[at - 1].eq_ignore_ascii_case(&code[0]);
            let rest = &text[at + code.len() - 1..];
            // A code that names a program too calls a block only where the block is named alone.
            let named =
                names_program(row).then(|| rest.trim_ascii_start().first().map(u8::to_ascii_uppercase));
            let calls = named.is_none_or(|next| next.is_some_and(|b| row.blocks.as_bytes().contains(&b)));
            begins && calls && rest.first().is_none_or(|b| !b.is_ascii_digit())
        })
    })
}

/// Whether the first letter of a code's words names a program.
fn names_program(row: &CodeRow) -> bool {
    row.words.bytes().next().is_some_and(|letter| !row.blocks.as_bytes().contains(&letter))
}

impl Lower {
    /// A call of the block with a number, so often.
    pub(in crate::word) fn local_call(
        &mut self,
        code: &Code,
        block: &Word,
        count: Option<&Word>,
        words: &Words,
        src: Source,
        out: &mut Batch,
    ) {
        let span = code.span.to(count.map_or(block.span, |count| count.span));
        if self.within_modal(span, out) {
            return;
        }
        let why = match block.value {
            Value::Computed(_) => Some(COMPUTED),
            Value::Number(_) | Value::None => self.sub.is_some().then_some(WITHIN),
        };
        if let Some(why) = why {
            return self.fault(refused(&code.row.code, why), code.span, out);
        }
        let Some(number) = self.read_whole(block, src, out) else { return };
        let times = match count {
            None => None,
            Some(count) => match self.amount(count, Quantity::Integer, words, src, out) {
                Some(times) => Some(times),
                None => return,
            },
        };
        if !self.jumps_from(&code.row.code, Some(number), span, out) {
            return;
        }
        out.whole = true;
        self.computes.local_calls.push((number, &code.row.code, code.span));
        let once = |times| Call { name: label(number), times, arguments: Vec::new(), shared: true };
        let op = match times {
            None => Op::Call(Box::new(once(1))),
            Some(times) => match times.literal().and_then(|n| n.whole_number()) {
                Some(n @ 1..=9999) => Op::Call(Box::new(once(n as u32))),
                Some(_) => {
                    let word = count.map(|count| src.text(count.span)).unwrap_or_default();
                    return self.fault(Fault::OutOfRange { word: word.into() }, span, out);
                }
                None => so_often(Op::Call(Box::new(once(1))), &times, span),
            },
        };
        self.push(span, op, out);
        // What is called stands in the main program: what that begins with holds there as after a jump.
        self.lose(span, out);
    }

    /// Whether a return after the end of the main program is that of blocks which it calls.
    pub(in crate::word) fn returns_from_blocks(&self) -> bool {
        self.main_ending.ends && !self.computes.local_calls.is_empty()
    }
}

fn refused(code: &str, what: CallUnsupported) -> Fault {
    Fault::not_supported(code, what)
}

impl Computes {
    /// The text is over: the blocks that are called become subprograms.
    pub(in crate::word) fn cut_out_called_blocks(&self, out: &mut Batch) {
        if self.local_calls.is_empty() {
            return;
        }
        match self.called_blocks(&out.stmts) {
            Ok(ranges) => {
                let mut cut: Vec<Procedure> = Vec::new();
                for (number, first, last) in ranges.into_iter().rev() {
                    let body = out.stmts.drain(first..=last).collect();
                    cut.insert(0, Procedure { name: label(number), body, ..Procedure::default() });
                }
                out.procedures.splice(0..0, cut);
            }
            Err((code, what, at)) => {
                leave_out(&mut out.stmts, &self.local_calls);
                return out.report(refused(code, what), at);
            }
        }
        // None of a called block's: the main program would begin again.
        if let Some(left) = out.stmts.iter().find(|stmt| stmt.op == Op::Return) {
            out.report(refused("M99", CallUnsupported::MainReturn), left.span);
        }
    }

    /// Numbers of the blocks that are called, each with where its statements begin and where its return is, in the order
    /// of the text.
    #[allow(clippy::type_complexity)]
    fn called_blocks(
        &self,
        body: &[Stmt],
    ) -> Result<Vec<(u32, usize, usize)>, (&'static str, CallUnsupported, Span)> {
        let mut starts: Vec<(usize, LocalCall)> = Vec::new();
        for &call in &self.local_calls {
            let (number, code, at) = call;
            if !self.computed_jumps.is_empty() {
                return Err((code, BESIDE, at));
            }
            if starts.iter().any(|(_, (other, ..))| *other == number) {
                continue;
            }
            let name = label(number);
            let mut found = (0..body.len()).filter(|&at| body[at].op == Op::Label(name.clone()));
            let Some(first) = found.next() else { return Err((code, NOT_THERE, at)) };
            if found.next().is_some() {
                return Err((code, TWICE, at));
            }
            starts.push((first, call));
        }
        starts.sort_by_key(|(first, _)| *first);
        let mut ranges = Vec::new();
        for (k, &(first, (number, code, at))) in starts.iter().enumerate() {
            let before =
                body[..first].iter().rev().find(|stmt| !matches!(stmt.op, Op::Blank | Op::Comment(_)));
            if !before.is_some_and(goes_nowhere_on) {
                return Err((code, RUN_INTO, at));
            }
            let end = starts.get(k + 1).map_or(body.len(), |(next, _)| *next);
            let returns = (first..end).filter(|&i| body[i].op == Op::Return && body[i].skip.is_none());
            let closed = |last: usize| {
                let (labels, jumps) = labels_and_jumps(&body[first..=last]);
                jumps.iter().all(|to| labels.contains(to))
            };
            let Some(last) = returns.into_iter().find(|&last| closed(last)) else {
                return Err((code, NO_RETURN, at));
            };
            ranges.push((number, first, last));
            let (labels, _) = labels_and_jumps(&body[first..=last]);
            let outside =
                labels_and_jumps(&body[..first]).1.into_iter().chain(labels_and_jumps(&body[last + 1..]).1);
            if outside.into_iter().any(|to| labels.contains(&to)) {
                return Err((code, JUMPED_INTO, at));
            }
        }
        Ok(ranges)
    }
}

/// Leaves marks in the places of calls that are refused.
fn leave_out(body: &mut [Stmt], calls: &[LocalCall]) {
    for stmt in body {
        match &mut stmt.op {
            Op::Control(control) => control.bodies_mut().for_each(|body| leave_out(body, calls)),
            Op::Call(call) if calls.iter().any(|(number, ..)| label(*number) == call.name) => {
                stmt.op = crate::batch::refused(stmt.span).op;
            }
            _ => {}
        }
    }
}

/// Whether the code after a statement is unreachable.
fn goes_nowhere_on(stmt: &Stmt) -> bool {
    stmt.skip.is_none() && matches!(stmt.op, Op::ProgramEnd | Op::BeginAgain | Op::Return | Op::Goto(_))
}

/// Labels of some statements, and where they jump.
fn labels_and_jumps(body: &[Stmt]) -> (Vec<Text>, Vec<Text>) {
    let (mut labels, mut jumps) = (Vec::new(), Vec::new());
    let mut left: Vec<&Stmt> = body.iter().collect();
    while let Some(stmt) = left.pop() {
        match &stmt.op {
            Op::Label(name) => labels.push(name.clone()),
            Op::Goto(to) => jumps.push(to.clone()),
            Op::Control(control) => control.bodies().for_each(|body| left.extend(body)),
            _ => {}
        }
    }
    (labels, jumps)
}
