//! The frame of a text: start and end marks, program numbers and titles, what is subprogram and
//! what is main, the end, and texts that are none.
//!
//! The first program of a text is the main one; each further program number begins a subprogram.

use ncc_dialects::Meaning;
use ncc_ir::diag::Fault;
use ncc_ir::program::{Op, Procedure, Text};
use ncc_ir::source::Span;
use ncc_ir::unsupported::TextUnsupported;

use super::o_code::o_subs::is_title;
use super::reader::Reader;
use super::text::frame::Called;
use super::word_state::WordState;
use crate::batch::Batch;
use crate::common::Source;
use crate::common::known::Know;
use crate::common::text::decode;
use crate::common::words::{Value, Word};

/// Characters that no text has, before reading is given up.
const MOST_CONTROL_SIGNS: u32 = 16;

/// End of a text file in old systems; nothing may follow it.
const CONTROL_Z: u8 = 0x1A;

/// Whether a line may be one that a control executes, or the head of a program.
fn may_be_block(line: &[u8], numbers: [u8; 2]) -> bool {
    let line = line.trim_ascii();
    let words = line.strip_prefix(b"/").unwrap_or(line);
    let is_sign = |b: &u8| b.is_ascii_digit() || b"+-.#[".contains(b);
    match words {
        [b'#' | b'(' | b'<' | b';', ..] => true,
        [letter, value @ ..] if letter.is_ascii_alphabetic() || numbers.contains(letter) => {
            value.trim_ascii_start().first().is_some_and(is_sign)
        }
        _ => false,
    }
}

impl Reader {
    /// Bytes before the opening mark that the control skips: lines none of which is a block, a comment or the head of
    /// a program, before a mark with a program after it. What may be a program without its mark stays.
    pub(super) fn leader(&mut self, text: &[u8], out: &mut Batch) -> usize {
        let mark = self.frame.mark.as_bytes();
        let begin = if text.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 };
        let mut at = begin;
        let mut first = None;
        while at < text.len() {
            let end = memchr::memchr(b'\n', &text[at..]).map_or(text.len(), |len| at + len);
            let from = text[at..end].iter().take_while(|b| **b == 0 || b.is_ascii_whitespace()).count() + at;
            let line = &text[from.min(end)..end];
            if line.starts_with(mark) {
                let follows = text[end..].iter().any(|b| !b.is_ascii_whitespace() && *b != 0);
                if !follows || from == begin {
                    return 0;
                }
                if let Some(span) = first {
                    out.report(Fault::TextBeforeStart { mark: self.frame.mark.into() }, span);
                }
                return from;
            }
            if may_be_block(line, self.frame.number) {
                return 0;
            }
            let words = line.trim_ascii_end();
            if first.is_none() && !words.is_empty() {
                first = Some(Span::new(from as u32, (from + words.len()) as u32));
            }
            at = end + 1;
        }
        0
    }

    /// Lines that belong to the frame, and all after the end; `true` if it was one.
    pub(super) fn framing(&mut self, line: &[u8], span: Span, out: &mut Batch) -> bool {
        let text = line.trim_ascii();
        if text.first() == Some(&CONTROL_Z) {
            self.end_of_program(out);
            self.frame.closed = true;
            return text.iter().all(|&b| b == CONTROL_Z) || self.text_after_end(span, out);
        }
        if self.frame.closed {
            // A first mark is one of a dialect that has them.
            let is_mark = text.starts_with(self.frame.mark.as_bytes());
            if (is_mark || may_be_block(line, self.frame.number))
                && let Some(at) = self.frame.first_mark.take()
            {
                // The control would execute what follows the mark, and skip the blocks before it.
                let mark = self.frame.mark.into();
                out.report(Fault::OpeningMarkMissing { mark, follows: !is_mark }, at);
                self.frame.faulty = true;
                self.frame.after_end = true;
            }
            return text.is_empty() || self.text_after_end(span, out);
        }
        let ignored = self.frame.ignored.as_bytes();
        if !ignored.is_empty() && text.starts_with(ignored) {
            return true;
        }
        let mark = self.frame.mark.as_bytes();
        if mark.is_empty() || !text.starts_with(mark) {
            // A blank line after the end is nothing.
            return self.lower.ended && text.is_empty();
        }
        // The rest of the opening line is a leader, which controls ignore.
        if self.frame.opened || self.frame.blocks || !self.frame.programs.is_empty() {
            if !(self.frame.opened || self.frame.mark_behind_end && self.lower.ended) {
                let mark = self.frame.mark.into();
                out.report(Fault::OpeningMarkMissing { mark, follows: false }, span);
                self.frame.faulty = true;
            } else if self.frame.leader && !self.frame.opened {
                self.frame.first_mark = Some(span);
            }
            self.end_of_program(out);
            self.frame.closed = true;
        }
        self.frame.opened = true;
        true
    }

    fn text_after_end(&mut self, span: Span, out: &mut Batch) -> bool {
        if !std::mem::replace(&mut self.frame.after_end, true) {
            out.report(Fault::TextAfterEnd, span);
        }
        true
    }

    /// A block after the program's end: it is never reached.
    pub(super) fn after_end(&mut self, src: Source, out: &mut Batch) {
        // A comment may stand there.
        if self.block.is_comment() {
            return self.lower.block(&self.block, src, out);
        }
        if self.ends_the_file(src) {
            return;
        }
        let begins_again = self.lower.main_ending.returns.or(self.lower.main_ending.begins_again).is_some();
        self.lower.goes_on_behind_return(out);
        // The usual last block after a program that begins again.
        if !(begins_again && self.is_end()) {
            self.text_after_end(self.block.span, out);
        }
    }

    /// Whether the block at hand says the program's end and nothing else.
    fn is_end(&self) -> bool {
        let [word] = &self.block.words[..] else { return false };
        let Value::Number(digits) = word.value else { return false };
        let tenths =
            u32::try_from(digits.mantissa).ok().filter(|_| digits.scale == 0).and_then(|n| n.checked_mul(10));
        let row = tenths.and_then(|tenths| self.lower.settings.dialect.code_row(word.letter, tenths));
        row.is_some_and(|row| row.means == Some(Meaning::ProgramEnd))
    }

    /// A program number at the head of a block; `true` if the block is over with it.
    pub(super) fn program_word(&mut self, src: Source, out: &mut Batch) -> bool {
        if let Some(&name) = self.block.names.first()
            && (!self.frame.named || self.block.names.len() > 1)
        {
            let name = self.block.names.get(1).copied().filter(|_| self.frame.named).unwrap_or(name);
            let fault =
                Fault::NotSupported { code: src.text(name), what: TextUnsupported::ProgramName.into() };
            self.block.faults.push((fault, name));
            return false;
        }
        if let Some(&name) = self.block.names.first()
            && self.block.words.is_empty()
            && self.block.faults.is_empty()
            && self.block.skip == 0
        {
            self.named_program(name, src, out);
            self.block.names.clear();
            return true;
        }
        if is_title(&self.block) {
            return self.title(src, out);
        }
        let first = self.block.words.first().copied();
        let Some(word) = first.filter(|w| w.letter != 0 && self.frame.number.contains(&w.letter)) else {
            return false;
        };
        let number = match word.value {
            Value::Number(d) if !d.point && (d.mantissa > 0 || self.is_unnumbered(d.mantissa)) => {
                u32::try_from(d.mantissa).ok()
            }
            Value::Number(_) | Value::Computed(_) | Value::None => None,
        };
        let Some(number) = number else {
            out.report(Fault::OutOfRange { word: src.text(word.span).into() }, word.span);
            self.frame.faulty = true;
            return true;
        };
        self.begin_program(Called::Number(number), word.span, src, out);
        self.block.words.remove(0);
        self.block.tail = self.block.tail.map(|at| at.saturating_sub(1));
        if self.frame.title && !self.block.comments.is_empty() {
            self.block.comments.remove(0);
        }
        self.block.is_empty()
    }

    /// Whether a number of the main program is the one that stands for none.
    fn is_unnumbered(&self, number: i64) -> bool {
        number == 0 && self.frame.zero && self.frame.programs.is_empty() && !self.frame.blocks
    }

    /// The name of the main program of a control with O words, which nothing calls; `true` if it is that.
    fn title(&mut self, src: Source, out: &mut Batch) -> bool {
        let Some(span) = self.block.title else { return false };
        if !self.frame.programs.is_empty() || self.frame.blocks {
            let fault =
                Fault::NotSupported { code: src.text(span), what: TextUnsupported::ProgramName.into() };
            self.block.faults.push((fault, span));
            return false;
        }
        let name = String::from_utf8_lossy(src.bytes(span))
            .trim_start_matches(['O', 'o', ' ', '<'])
            .trim_end_matches('>')
            .into();
        out.name.title = Some(name);
        self.frame.programs.insert("".into());
        self.block.title = None;
        self.block.is_empty()
    }

    /// A program's name in a block of its own.
    fn named_program(&mut self, span: Span, src: Source, out: &mut Batch) {
        let Some(called) = Called::parse(src.bytes(span)) else {
            out.report(Fault::OutOfRange { word: src.text(span).into() }, span);
            self.frame.faulty = true;
            return;
        };
        // The name is the main program's title; a comment beside it stays one.
        let is_main = self.frame.programs.is_empty() && !self.frame.blocks;
        let keeps = is_main && matches!(called, Called::Name(_));
        self.begin_program(called, span, src, out);
        if self.frame.title && !self.block.comments.is_empty() && !keeps {
            self.block.comments.remove(0);
        }
        if !self.block.comments.is_empty() {
            self.block.names.clear();
            self.lower.block(&self.block, src, out);
        }
    }

    fn begin_program(&mut self, called: Called, span: Span, src: Source, out: &mut Batch) {
        let title: Option<Text> = match self.block.comments.first() {
            Some(&comment) if self.frame.title => Some(decode(src.bytes(comment))),
            Some(_) | None => None,
        };
        let name = called.text();
        if !self.frame.lower_case.insert(name.to_ascii_lowercase()) {
            out.report(Fault::ProgramTwice { name: name.clone() }, span);
            self.frame.faulty = true;
        }
        let is_main = self.frame.programs.is_empty() && !self.frame.blocks;
        self.frame.programs.insert(name.clone());
        if is_main {
            match called {
                Called::Number(number) => {
                    (out.name.number, out.name.title) = (Some(number).filter(|number| *number > 0), title);
                }
                Called::Name(name) => out.name.title = Some(name),
            }
            return;
        }
        if !self.frame.blocks && !self.frame.faulty {
            out.report(Fault::EmptyProgram, span);
            self.frame.faulty = true;
        }
        let last = self.lower.target(out).last();
        // An alarm ends the program as well.
        let alarmed = last.is_some_and(|stmt| stmt.skip.is_none() && matches!(stmt.op, Op::Alarm(_)));
        let open = !self.lower.ended && !alarmed;
        if self.lower.settings.dialect.program.o_words && open && !self.frame.faulty {
            // A number in its way ends nothing (LinuxCNC's interpreter, run).
            let what = TextUnsupported::GoesOn.into();
            out.report(Fault::NotSupported { code: src.text(span), what }, span);
            self.frame.faulty = true;
        }
        self.end_of_program(out);
        self.lower.o.subs.numbered(name.clone());
        self.lower.o.numbered_program = true;
        self.lower.o.given = Default::default();
        self.lower.inherited.enter(name.clone());
        self.lower.sub = Some(Procedure { name, title, ..Procedure::default() });
        self.lower.ended = false;
        self.lower.state = WordState::called();
        self.lower.refresh();
        out.whole = true;
    }

    /// The program that is being read is over.
    pub(super) fn end_of_program(&mut self, out: &mut Batch) {
        if self.frame.closed {
            return;
        }
        self.lower.open_loops(out);
        self.lower.open_bodies(out);
        self.lower.open_functions(out);
        let in_sub = self.lower.sub.is_some();
        let expected = in_sub || self.frame.blocks;
        if expected && !self.lower.ended && !self.frame.faulty {
            let end = self.frame.end;
            let last = self.lower.target(out).last().map(|stmt| stmt.span);
            let before = if in_sub { None } else { out.last };
            let at = last.or(before).unwrap_or_else(|| Span::new(end.saturating_sub(1), end));
            out.report(Fault::NoProgramEnd, at);
            if self.lower.settings.dialect.program.o_words && self.lower.state.compensated == Know::Said(true)
            {
                // The last move under it is made when the program says its end (LinuxCNC's interpreter, run).
                let what = TextUnsupported::EndUnderCompensation.into();
                out.report(Fault::NotSupported { code: "G40".into(), what }, at);
            }
        }
        if let Some(procedure) = self.lower.sub.take() {
            out.procedures.push(procedure);
        }
        self.lower.ended = true;
    }

    /// The whole text is over.
    pub(super) fn end_of_text(&mut self, out: &mut Batch) {
        if !self.frame.blocks && !self.frame.faulty {
            out.report(Fault::EmptyProgram, Span::new(0, 0));
        }
    }

    /// Signs that no text has; many of them, and it is none.
    pub(super) fn control_signs(&mut self, out: &mut Batch) {
        let found = self.block.faults.iter().find_map(|(fault, span)| match fault {
            Fault::UnexpectedCharacter { found } if found.is_control() => Some(*span),
            _ => None,
        });
        if let Some(span) = found {
            self.frame.control_signs += 1;
            if self.frame.control_signs > MOST_CONTROL_SIGNS {
                self.not_text(span, out);
            }
        }
    }

    /// This is no text: nothing more is read.
    pub(super) fn not_text(&mut self, span: Span, out: &mut Batch) {
        self.frame.is_binary = true;
        self.frame.faulty = true;
        out.report(Fault::NotText, span);
    }

    /// The letter O where a zero is meant: as the number of a letter that has none (`GOX-15.`,
    /// `GZO`), or without a number after another word's digits (`X1O`).
    pub(super) fn check_letters(&mut self, src: Source) {
        let block = &mut self.block;
        let spelt = |from: &Word, to: &Word| from.span.end == to.span.start && to.value == Value::None;
        for (at, pair) in block.words.windows(2).enumerate() {
            let (word, next) = (&pair[0], &pair[1]);
            // Further letters after it spell a word of a language: `COVER`.
            if block.words.get(at + 2).is_some_and(|behind| spelt(next, behind)) {
                continue;
            }
            let is_number = word.value == Value::None;
            let adjoining = spelt(word, next);
            if next.letter == b'O' && (is_number || adjoining) {
                debug_assert!(!src.bytes(next.span).is_empty());
                let letter = Span::new(next.span.start, next.span.start + 1);
                block.faults.push((Fault::LetterOForZero, letter));
            }
        }
    }
}
