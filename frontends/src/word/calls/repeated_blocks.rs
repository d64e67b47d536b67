//! Blocks that a block's words execute again, by their numbers.
//!
//! Statements say what is known of the modes where they stand. Blocks that are executed again must mean the
//! same then: their text is read once more with what is active after them, and again until nothing new is
//! active, and every statement must be the one that it was. Else the repetition is refused.
//!
//! Not here: repetitions within repeated blocks, and of blocks that stand further on; no source says how a
//! control takes them.

use ncc_dialects::REPEAT_COUNT;
use ncc_ir::diag::{Diagnostic, Fault, Gravity};
use ncc_ir::expr::Expr;
use ncc_ir::program::{Op, RepeatBlocks, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::unsupported::CallUnsupported;

use super::repetition::Repetition;
use crate::batch::{Batch, refused};
use crate::common::Source;
use crate::word::block_words::{Code, Words};
use crate::word::lower::Lower;
use crate::word::reader::Reader;
use crate::word::text::block::Block;

/// Most passes of a repetition.
const MOST_TIMES: u32 = 9999;

/// Passes that are looked at before what is active must be the same.
const MOST_PASSES: u32 = 4;

/// The label of a numbered block.
fn label(number: u32) -> Text {
    format!("BLOCK{number}").into()
}

impl Lower {
    /// A block of the three words of a repetition; `false` if it is not one.
    pub(in crate::word) fn repetition(
        &mut self,
        block: &Block,
        codes: &[Code],
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) -> bool {
        let Some(letters) = self.settings.dialect.repeat.letters() else { return false };
        let all = letters.iter().fold(0u32, |bits, letter| bits | 1 << (letter - b'A'));
        if words.left != all || !codes.is_empty() || block.tail.is_some() {
            return false;
        }
        let found = letters.map(|letter| words.take(letter));
        let [Some(first), Some(last), Some(count)] = found else { return false };
        let whole = [first, last, count].map(|word| self.read_whole(&word, src, out));
        let [Some(from), Some(to), Some(times)] = whole else { return true };
        let total = self.option(REPEAT_COUNT, count.span, out) == "total";
        if times == 0 || times > MOST_TIMES {
            self.fault(Fault::OutOfRange { word: src.text(count.span).into() }, count.span, out);
            return true;
        }
        let times = if total { times - 1 } else { times };
        let at = self.target(out).len();
        self.now.repetition =
            Some(Repetition { first: (from, first.span), last: (to, last.span), times, at });
        let times = Expr::int(i64::from(times));
        let blocks = RepeatBlocks { from: label(from), to: Some(label(to)), times };
        self.push(block.span, Op::RepeatBlocks(Box::new(blocks)), out);
        true
    }
}

impl Reader {
    /// Keeps the text of numbered blocks, where a repetition may name them.
    pub(in crate::word) fn keep(&mut self, text: &[u8], base: u32) {
        if self.kept.never || self.lower.settings.dialect.repeat.letters().is_none() || self.kept.busy {
            return;
        }
        let kept = &mut self.kept;
        if !kept.open {
            kept.text.clear();
            kept.base = base;
        }
        if kept.open || memchr::memchr2(b'N', b'n', text).is_some() {
            kept.text.extend_from_slice(text);
        }
    }

    /// A block has been read: from the first one with a number on, the program is kept whole.
    pub(in crate::word) fn kept(&mut self, from: usize, out: &mut Batch) {
        let kept = &self.kept;
        let repeats = !kept.never && self.lower.settings.dialect.repeat.letters().is_some();
        if kept.busy || kept.open || !repeats {
            return;
        }
        let body = self.lower.target(out);
        if body[from.min(body.len())..].iter().any(|stmt| stmt.number.is_some()) {
            self.kept.open = true;
            out.whole = true;
        }
    }

    /// The repetition that the last block has asked for.
    pub(in crate::word) fn repeat(&mut self, out: &mut Batch) {
        let Some(asked) = self.lower.now.repetition.take() else { return };
        if self.lower.now.failed {
            return;
        }
        if let Err((fault, span)) = self.repeated(asked, out) {
            let block = self.block.span;
            let watch = self.lower.watch;
            let body = self.lower.target(out);
            body.truncate(asked.at);
            if watch {
                body.push(refused(block));
            }
            self.lower.now.failed = true;
            out.report(fault, span);
            self.lower.forgive();
            self.lower.refresh();
        }
    }

    fn repeated(&mut self, asked: Repetition, out: &mut Batch) -> Result<(), (Fault, Span)> {
        let refuse = |what: CallUnsupported| {
            let fault = Fault::not_supported("H", what);
            Err((fault, asked.first.1))
        };
        if self.kept.busy {
            return refuse(CallUnsupported::RepeatInRepeat);
        }
        if self.lower.sub.is_some() {
            return refuse(CallUnsupported::RepeatInSub);
        }
        let body = &self.lower.target(out)[..asked.at];
        let first = block_of(body, asked.first)?;
        let last = block_of(body, asked.last)?;
        if last < first {
            return Err((Fault::OutOfRange { word: format!("E{}", asked.last.0).into() }, asked.last.1));
        }
        let end = last + 1 + body[last + 1..].iter().take_while(|stmt| stmt.joined).count();
        let blocks = &body[first..end];
        if blocks.iter().any(|stmt| matches!(stmt.op, Op::RepeatBlocks(_))) {
            return refuse(CallUnsupported::RepeatInRepeat);
        }
        let span = blocks.iter().fold(blocks[0].span, |span, stmt| span.to(stmt.span));
        let said: Vec<Stmt> = blocks.iter().filter(|stmt| !is_label(stmt)).cloned().collect();
        if !self.same_again(&said, span, asked.times, out) {
            return refuse(CallUnsupported::RepeatModes);
        }
        let body = self.lower.target(out);
        let second = put_label(body, last, asked.last.0);
        debug_assert!(second <= 1);
        put_label(body, first, asked.first.0);
        Ok(())
    }

    /// Reads blocks again with what is active, and finds whether they say the same.
    fn same_again(&mut self, said: &[Stmt], span: Span, times: u32, out: &mut Batch) -> bool {
        let text = std::mem::take(&mut self.kept.text);
        let base = self.kept.base;
        let start = span.start.saturating_sub(base) as usize;
        let end = (span.end.saturating_sub(base) as usize).min(text.len());
        let from = text[..start.min(end)].iter().rposition(|b| *b == b'\n').map_or(0, |at| at + 1);
        let to = memchr::memchr(b'\n', &text[end..]).map_or(text.len(), |at| end + at + 1);
        let before = self.lower.state.clone();
        let skip = self.block.skip != 0;
        let (block, frame_end) = (std::mem::take(&mut self.block), self.frame.end);
        let faulty = self.frame.faulty;
        let now = std::mem::take(&mut self.lower.now);
        self.kept.busy = true;
        let mut passes = 0;
        let same = loop {
            if passes == times {
                break true;
            }
            let state = self.lower.state.clone();
            let mut batch = Batch { assumed: out.assumed, ..Batch::default() };
            self.lines(&text[from..to], base + from as u32, &mut batch);
            out.assumed = batch.assumed;
            let error = |d: &Diagnostic| d.fault.gravity() == Gravity::Error;
            let again = batch.stmts.iter().filter(|stmt| !is_label(stmt));
            if batch.diagnostics.iter().any(error) || !again.map(meaning).eq(said.iter().map(meaning)) {
                break false;
            }
            out.diagnostics.extend(batch.diagnostics.into_iter().filter(is_assumption));
            passes += 1;
            if self.lower.state == state {
                break true;
            }
            if passes == MOST_PASSES {
                break false;
            }
        };
        self.kept.busy = false;
        self.kept.text = text;
        (self.block, self.frame.end, self.frame.faulty) = (block, frame_end, faulty);
        self.lower.now = now;
        if !same {
            self.lower.state = before;
        } else if skip {
            self.lower.state.join(&before);
        }
        self.lower.refresh();
        same
    }
}

/// What a statement says, and where.
fn meaning(stmt: &Stmt) -> (&Op, Option<u8>, Span) {
    (&stmt.op, stmt.skip, stmt.span)
}

fn is_label(stmt: &Stmt) -> bool {
    matches!(stmt.op, Op::Label(_))
}

/// Whether something was assumed that had not been reported before.
fn is_assumption(found: &Diagnostic) -> bool {
    matches!(
        found.fault,
        Fault::AssumedMode { .. }
            | Fault::AssumedOption { .. }
            | Fault::AssumedRow { .. }
            | Fault::AssumedWorkOffset { .. }
            | Fault::AssumedNoEffect { .. }
    )
}

/// Where the block of a number begins. A number that occurs twice names none.
fn block_of(body: &[Stmt], (number, at): (u32, Span)) -> Result<usize, (Fault, Span)> {
    let mut found = body.iter().enumerate().filter(|(_, stmt)| stmt.number == Some(number)).map(|(at, _)| at);
    match (found.next(), found.next()) {
        (Some(place), None) => Ok(place),
        (None, _) => Err((Fault::LabelUnknown { name: format!("N{number}").into() }, at)),
        (Some(_), Some(_)) => {
            let what = CallUnsupported::RepeatNumberTwice.into();
            Err((Fault::NotSupported { code: format!("N{number}").into(), what }, at))
        }
    }
}

/// Names the block that begins at a place, if it has no name; gives how many statements that took.
fn put_label(body: &mut Vec<Stmt>, at: usize, number: u32) -> usize {
    let Some(first) = body.get_mut(at).filter(|stmt| !is_label(stmt)) else { return 0 };
    let mut stmt = Stmt::new(first.span, Op::Label(label(number)));
    stmt.number = first.number.take();
    stmt.skip = first.skip;
    first.joined = true;
    body.insert(at, stmt);
    1
}
