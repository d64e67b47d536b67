//! The reader of a text of words: its lines, each by the shortest way that can read it, and the end.
//!
//! Not here: what frames a program (`framing`), and what a block means (`lower`).

use ncc_dialects::{BLOCK_SKIP, Settings};
use ncc_ir::diag::Fault;
use ncc_ir::source::Span;

use super::calls::repetition::RepeatedText;
use super::lower::Lower;
use super::o_code::o_state::StandaloneOsub;
use super::text::block;
use super::text::block::{Block, is_misspelt};
use super::text::fast_computed;
use super::text::frame::Frame;
use super::text::token::Signs;
use crate::batch::{Batch, refused};
use crate::common::Source;
use crate::common::pieces::{Shown, pieces};

/// Longest block of a dialect that sets no limit, in bytes.
const LONGEST: usize = 60_000;

/// Reads one text, piece by piece.
#[derive(Debug)]
pub struct Reader {
    pub(super) lower: Lower,
    pub(super) frame: Frame,
    pub(super) signs: Signs,
    pub(super) block: Block,
    /// Longest block, in bytes.
    pub(super) longest: usize,
    /// Longest line of which the characters need not be counted.
    pub(super) uncounted: usize,
    /// Text of blocks that may be executed again.
    pub(super) kept: RepeatedText,
}

impl Reader {
    /// A reader of one text. With `assume`, what the program relies on and never says is taken
    /// from the dictionary and reported; without, it stays open and nothing is reported of it.
    pub fn new(settings: Settings, assume: bool) -> Reader {
        let dialect = settings.dialect;
        let longest = match dialect.block.longest {
            0 => LONGEST,
            longest => (longest as usize).min(LONGEST),
        };
        Reader {
            signs: Signs::new(dialect),
            frame: Frame::new(dialect),
            longest,
            uncounted: match dialect.block.longest_bare {
                0 => longest,
                bare => (bare as usize).min(longest),
            },
            lower: Lower::new(settings, assume),
            block: Block::default(),
            kept: RepeatedText::default(),
        }
    }

    /// As of [`crate::Reader::watch`].
    pub(crate) fn watch(&mut self) {
        self.lower.watch = true;
    }

    /// As of [`crate::Reader::repeats`].
    pub(crate) fn repeats(&mut self, may: bool) {
        self.kept.never = !may;
    }

    /// As of [`crate::Reader::foresee_jumps`].
    pub(crate) fn foresee_jumps(&mut self, lines: &[u8]) {
        self.lower.foresee_jumps(lines);
    }

    /// What the text never says is assumed from here on.
    pub(crate) fn assume(&mut self) {
        self.lower.assume = true;
        self.lower.refresh();
    }

    /// As of [`crate::Reader::called`].
    pub(crate) fn called(&mut self) {
        self.assume();
        if self.lower.settings.dialect.program.o_words {
            self.lower.o.standalone = StandaloneOsub::Looked;
        }
    }

    /// Reads further whole lines; `base` is the place of their first byte in the source.
    pub fn read(&mut self, text: &[u8], base: u32, out: &mut Batch) {
        self.read_showing(text, base, out, (usize::MAX, &mut |_, _| {}));
        out.keep_last();
    }

    /// As of [`crate::Reader::settled`].
    pub(crate) fn is_settled(&self) -> bool {
        let repeats = !self.kept.never && self.lower.settings.dialect.repeat.letters().is_some();
        !repeats && self.lower.computes.loops.is_empty() && self.lower.o.open.is_empty()
    }

    /// As of [`crate::Reader::read_showing`].
    pub(crate) fn read_showing(&mut self, text: &[u8], base: u32, out: &mut Batch, shown: Shown) {
        if self.frame.is_binary {
            return;
        }
        if base == 0 && self.frame.has_leader() {
            let len = self.leader(text, out);
            if len > 0 {
                return self.read_showing(&text[len..], len as u32, out, shown);
            }
        }
        if let Some(at) = memchr::memchr(0, text) {
            if self.frame.has_leader() && text[at..].iter().all(|b| *b == 0 || b.is_ascii_whitespace()) {
                // The feed at the end of a tape.
                return self.read_showing(&text[..at], base, out, shown);
            }
            let at = base + at as u32;
            return self.not_text(Span::new(at, at + 1), out);
        }
        if base == 0 {
            self.look_for_standalone_osub(text);
        }
        out.tabled &= self.is_settled();
        self.keep(text, base);
        self.lower.look_ahead(text, out);
        let from = self.lower.target(out).len();
        if text.is_empty() {
            self.frame.end = base;
        }
        let (piece, shown) = shown;
        for piece in pieces(text, piece) {
            self.lines(&text[piece.clone()], base + piece.start as u32, out);
            if self.frame.is_binary {
                break;
            }
            let settled = if self.is_settled() { out.stmts.len() } else { 0 };
            shown(&mut out.stmts, settled);
        }
        self.kept(from, out);
    }

    pub(super) fn lines(&mut self, text: &[u8], base: u32, out: &mut Batch) {
        self.lower.functions_begin(out);
        let src = Source { text, base };
        let mut at = if base == 0 && text.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 };
        while at < text.len() {
            let open = !self.frame.closed && !self.lower.ended;
            let plain = open && self.lower.functions.is_none();
            if plain && let Some(end) = self.lower.short_way(text, at, base, self.uncounted, out) {
                self.frame.blocks = true;
                at = end + 1;
                continue;
            }
            if open
                && let Some(end) = crate::common::fast_parse::read(text, at, base, &mut self.block.words)
                && end - at <= self.uncounted
            {
                self.fast_parsed_block(at, end, src, out);
                at = end + 1;
                continue;
            }
            if open
                && self.takes_sums()
                && let Some(end) = fast_computed::read(text, at, base, &mut self.block)
                && end - at <= self.uncounted
            {
                self.recognised_block(src, out);
                at = end + 1;
                continue;
            }
            let end = memchr::memchr(b'\n', &text[at..]).map_or(text.len(), |len| at + len);
            self.line(at, end, src, out);
            if self.frame.is_binary {
                return;
            }
            at = end + 1;
        }
        self.lower.follow(out);
        self.frame.end = base + text.len() as u32;
    }

    /// Whether moves by sums go the short way.
    fn takes_sums(&self) -> bool {
        #[cfg(test)]
        if self.lower.usual.off {
            return false;
        }
        self.signs.computes && !self.signs.o_words
    }

    /// A line that is too long to be handed over: only its place is known.
    pub fn too_long(&mut self, span: Span, out: &mut Batch) {
        let limit = self.longest.min(u32::MAX as usize) as u32;
        out.report(Fault::BlockTooLong { limit }, span);
        self.frame.faulty = true;
        self.frame.end = self.frame.end.max(span.end);
        if self.lower.watch {
            self.lower.target(out).push(refused(span));
        }
        self.lower.forgive();
        self.lower.refresh();
    }

    /// The end of the text.
    pub fn finish(&mut self, out: &mut Batch) {
        if !self.frame.is_binary {
            self.end_of_program(out);
            self.end_of_text(out);
            self.lower.settle_main_ending(out);
            self.lower.settle_functions(out);
            self.lower.computes.give_parameters(&mut out.procedures);
            self.lower.computes.cut_out_called_blocks(out);
            self.lower.computes.join_returns(out);
            self.lower.computes.join_jumps(out);
            self.lower.computes.join_calls(out);
            self.lower.computes.saved.check(out);
            self.lower.computes.no_calls_within(out);
            self.lower.settle_calls(out);
            self.lower.settle_cycles(out);
            self.lower.inherited.settle(self.lower.settings.dialect, out);
        }
    }

    /// A block that the recogniser has read.
    fn fast_parsed_block(&mut self, start: usize, end: usize, src: Source, out: &mut Batch) {
        let words = std::mem::take(&mut self.block.words);
        self.block.clear();
        self.block.words = words;
        debug_assert!(start < end);
        self.recognised_block(src, out);
    }

    /// A block of which the words are there.
    fn recognised_block(&mut self, src: Source, out: &mut Batch) {
        if let (Some(first), Some(last)) = (self.block.words.first(), self.block.words.last()) {
            self.block.span = Span::new(first.span.start, last.span.end);
        }
        self.meaning(src, out);
    }

    /// A line that is not plain.
    fn line(&mut self, start: usize, mut end: usize, src: Source, out: &mut Batch) {
        while end > start && src.text[end - 1] == b'\r' {
            end -= 1;
        }
        let span = Span::new(src.base + start as u32, src.base + end as u32);
        if end - start > self.longest {
            return self.too_long(span, out);
        }
        self.frame.end = span.end;
        let line = &src.text[start..end];
        if self.framing(line, span, out) {
            return;
        }
        let base = src.base + start as u32;
        let mut from = 0;
        loop {
            self.block.clear();
            let next = match self.flow(line) {
                None => block::parse(line, from, base, self.signs, &mut self.block),
                Some((start, end)) => {
                    let what = String::from_utf8_lossy(&line[start..end]).into();
                    let span = Span::new(base + start as u32, base + end as u32);
                    self.block.faults.push((Fault::MacroLanguage { what }, span));
                    self.block.span = span;
                    None
                }
            };
            self.block.span = trimmed(src, self.block.span);
            self.check_letters(src);
            self.control_signs(out);
            if self.frame.is_binary {
                return;
            }
            // `X1.;;` is one block.
            if from == 0 || !self.block.is_empty() {
                self.meaning(src, out);
            }
            match next {
                // A sign at the very end of the line ends the block with it.
                Some(at) if !line[at..].iter().all(|b| b.is_ascii_whitespace()) => from = at,
                Some(_) | None => return,
            }
        }
    }

    /// Where a block of the control's own flow begins and ends: a program number with a word of it.
    fn flow(&self, line: &[u8]) -> Option<(usize, usize)> {
        let program = &self.lower.settings.dialect.program;
        let letter = program.number.filter(|_| !program.flow.is_empty() && !program.o_words)? as u8;
        let blanks = |at: usize| at + line[at..].iter().take_while(|b| b.is_ascii_whitespace()).count();
        let digits = |at: usize| at + line[at..].iter().take_while(|b| b.is_ascii_digit()).count();
        let is = |at: usize, byte: u8| line.get(at).is_some_and(|b| b.eq_ignore_ascii_case(&byte));
        let mut start = blanks(0);
        if is(start, b'/') {
            start = blanks(start + 1);
        }
        if self.signs.number != 0 && is(start, self.signs.number) {
            start = blanks(digits(blanks(start + 1)));
        }
        if !is(start, letter) {
            return None;
        }
        let after = blanks(start + 1);
        let name = match line.get(after)? {
            b'<' => after + memchr::memchr(b'>', &line[after..])? + 1,
            b'[' => after + memchr::memchr(b']', &line[after..])? + 1,
            b'#' => digits(after + 1),
            _ => digits(after),
        };
        let word = blanks(name);
        let end = word + line[word..].iter().take_while(|b| b.is_ascii_alphabetic()).count();
        let found = program.flow.iter().any(|w| w.as_bytes().eq_ignore_ascii_case(&line[word..end]));
        let named = name > after && line.get(after).is_some_and(|b| !b.is_ascii_digit());
        (found || named).then_some((start, line.trim_ascii_end().len()))
    }

    /// Whether a block after the end can be reached all the same, since it has a number that jumps may name.
    fn reached_again(&mut self) -> bool {
        let numbered = self.block.words.first().is_some_and(|word| word.letter == self.signs.number);
        let again = self.lower.computes.jumps && numbered && self.signs.number != 0;
        if again {
            self.lower.ended = false;
        }
        again
    }

    /// A block with block skip, where the user states how the switch stands.
    #[cold]
    fn state_switch(&mut self, out: &mut Batch) {
        let on = match self.lower.settings.get(BLOCK_SKIP) {
            "on" => true,
            "off" => false,
            _ => return,
        };
        if self.block.skip > self.lower.settings.dialect.block.skip_levels {
            return;
        }
        if !std::mem::replace(&mut self.lower.reported.switch, true) {
            let value = self.lower.settings.get(BLOCK_SKIP).into();
            out.report(Fault::AssumedOption { option: BLOCK_SKIP.into(), value }, self.block.span);
        }
        self.block.with_switch(on);
    }

    /// A block, whichever way it was read.
    fn meaning(&mut self, src: Source, out: &mut Batch) {
        // What is read back is executed either way.
        if self.block.skip != 0 && self.lower.assume {
            self.state_switch(out);
        }
        if self.sub_word(src, out) || self.program_word(src, out) {
            return;
        }
        if self.lower.ended && !self.reached_again() {
            return self.after_end(src, out);
        }
        let block = &self.block;
        self.frame.blocks |= !block.words.is_empty() || block.skip != 0 || block.decision.is_some();
        self.frame.blocks |= !block.settings.is_empty();
        self.frame.faulty |= !self.block.faults.is_empty();
        self.lower.o.misspelt |= self.block.faults.iter().any(|(fault, _)| is_misspelt(fault));
        self.lower.block(&self.block, src, out);
        // An end within a structure is not that of the text.
        self.lower.ended &= self.lower.o.open.is_empty();
        self.repeat(out);
        self.frame.faulty |= self.lower.now.failed;
    }
}

/// A span without blanks at its ends.
fn trimmed(src: Source, span: Span) -> Span {
    let bytes = src.bytes(span);
    let lead = bytes.iter().take_while(|b| b.is_ascii_whitespace()).count() as u32;
    let trail = bytes.iter().rev().take_while(|b| b.is_ascii_whitespace()).count() as u32;
    match lead as usize == bytes.len() {
        true => Span::new(span.start, span.start),
        false => Span::new(span.start + lead, span.end - trail),
    }
}
