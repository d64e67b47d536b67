//! The frame of a text: start and end marks, program numbers and titles, what is subprogram and
//! what is main, the end, and texts that are none.
//!
//! The first program of a text is the main one; each further program number begins a subprogram.

use std::collections::HashSet;

use ncc_dialects::{Dialect, Meaning};
use ncc_ir::diag::Fault;
use ncc_ir::program::{Op, Procedure, Text};
use ncc_ir::source::Span;

use crate::Batch;
use crate::common::Source;
use crate::common::known::Know;
use crate::common::text::decode;
use crate::common::words::{Value, Word};
use crate::word::Reader;
use crate::word::o_code::o_subs::is_title;
use crate::word::word_state::WordState;

/// Characters that no text has, before reading is given up.
const MOST_CONTROL_SIGNS: u32 = 16;

/// End of a text file in old systems; nothing may follow it.
const CONTROL_Z: u8 = 0x1A;

/// Longest name of a program.
const LONGEST_NAME: usize = 32;

/// What a program is called by.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::word) enum Called {
    Number(u32),
    Name(Text),
}

impl Called {
    /// What a name in brackets calls: `<O12>` is a number; `None` is no name.
    pub(in crate::word) fn of(bracketed: &[u8]) -> Option<Called> {
        let name = std::str::from_utf8(bracketed).ok()?.strip_prefix('<')?.strip_suffix('>')?;
        let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        if let Some(number) = name.strip_prefix('O').filter(|rest| digits(rest)) {
            return number.parse().ok().filter(|number| *number > 0).map(Called::Number);
        }
        let fits = |b: u8| b.is_ascii_alphanumeric() || b"+-_.".contains(&b);
        let is_name = (1..=LONGEST_NAME).contains(&name.len()) && name.bytes().all(fits);
        // A name of digits alone would be another program than that number's.
        (is_name && !digits(name)).then(|| Called::Name(name.into()))
    }

    /// The name by which statements call it.
    pub(in crate::word) fn text(&self) -> Text {
        match self {
            Called::Number(number) => number.to_string().into(),
            Called::Name(name) => name.clone(),
        }
    }
}

/// How far the frame of the text is.
#[derive(Debug)]
pub(in crate::word) struct Frame {
    /// Line that stands before and after the program; empty for none.
    mark: &'static str,
    /// Line that counts for nothing; empty for none.
    ignored: &'static str,
    /// Letter of the program number and the sign that may stand for it; 0 for none.
    number: [u8; 2],
    title: bool,
    /// Whether programs may have names.
    named: bool,
    /// Whether the main program may have number 0, which is none.
    zero: bool,
    /// Whether text before the mark is skipped.
    leader: bool,
    /// Whether a mark behind the end needs none before the program.
    mark_behind_end: bool,
    /// Whether the mark that opens the text has been met.
    opened: bool,
    /// Nothing is read any more: the closing mark has been met.
    pub(in crate::word) closed: bool,
    /// Whether any block with words has been met.
    pub(in crate::word) blocks: bool,
    /// Whether anything was refused.
    pub(in crate::word) faulty: bool,
    /// Whether text after the end was reported.
    after_end: bool,
    /// Not a text; nothing is read any more.
    pub(in crate::word) is_binary: bool,
    control_signs: u32,
    /// Numbers and names of the programs met.
    programs: HashSet<Text>,
    /// The same, in small letters.
    lower_case: HashSet<String>,
    /// End of what has been read.
    pub(in crate::word) end: u32,
}

impl Frame {
    pub(in crate::word) fn new(dialect: &'static Dialect) -> Frame {
        let program = &dialect.program;
        let sign = |c: Option<char>| c.map_or(0, |c| c as u8);
        Frame {
            mark: &program.frame,
            ignored: &program.ignored,
            number: [sign(program.number), sign(program.number_also)],
            title: program.title,
            named: program.names,
            zero: program.zero_unnumbered,
            leader: program.leader,
            mark_behind_end: program.mark_behind_end,
            opened: false,
            closed: false,
            blocks: false,
            faulty: false,
            after_end: false,
            is_binary: false,
            control_signs: 0,
            programs: HashSet::new(),
            lower_case: HashSet::new(),
            end: 0,
        }
    }
}

impl Frame {
    /// Whether the control skips text before the mark.
    pub(in crate::word) fn has_leader(&self) -> bool {
        self.leader
    }

    /// Numbers and names of the programs met.
    pub(in crate::word) fn programs(&self) -> &HashSet<Text> {
        &self.programs
    }
}

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
    /// a program, before a mark with a program behind it. What may be a program without its mark stays.
    pub(in crate::word) fn leader(&mut self, text: &[u8], out: &mut Batch) -> usize {
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
    pub(in crate::word) fn framing(&mut self, line: &[u8], span: Span, out: &mut Batch) -> bool {
        let text = line.trim_ascii();
        if text.first() == Some(&CONTROL_Z) {
            self.end_of_program(out);
            self.frame.closed = true;
            return text.iter().all(|&b| b == CONTROL_Z) || self.text_after_end(span, out);
        }
        if self.frame.closed {
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
                out.report(Fault::OpeningMarkMissing { mark: self.frame.mark.into() }, span);
                self.frame.faulty = true;
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
    pub(in crate::word) fn after_end(&mut self, src: Source, out: &mut Batch) {
        // A comment may stand there.
        if self.block.is_comment() {
            return self.lower.block(&self.block, src, out);
        }
        if self.ends_the_file(src) {
            return;
        }
        let begins_again = self.lower.alone.returns.or(self.lower.alone.begins_again).is_some();
        self.lower.goes_on_behind_return(out);
        // The usual last block behind a program that begins again.
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
    pub(in crate::word) fn program_word(&mut self, src: Source, out: &mut Batch) -> bool {
        if let Some(&name) = self.block.names.first()
            && (!self.frame.named || self.block.names.len() > 1)
        {
            let name = self.block.names.get(1).copied().filter(|_| self.frame.named).unwrap_or(name);
            let fault = Fault::NotSupported { code: src.text(name), name: "program with a name".into() };
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
            out.report(Fault::OutOfRange { word: src.text(word.span) }, word.span);
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
            let fault = Fault::NotSupported { code: src.text(span), name: "program with a name".into() };
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
        let Some(called) = Called::of(src.bytes(span)) else {
            out.report(Fault::OutOfRange { word: src.text(span) }, span);
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
            let told = "program that another one goes on into".into();
            out.report(Fault::NotSupported { code: src.text(span), name: told }, span);
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
    pub(in crate::word) fn end_of_program(&mut self, out: &mut Batch) {
        if self.frame.closed {
            return;
        }
        self.lower.open_loops(out);
        self.lower.open_bodies(out);
        let in_sub = self.lower.sub.is_some();
        let expected = in_sub || self.frame.blocks;
        if expected && !self.lower.ended && !self.frame.faulty {
            let end = self.frame.end;
            let at = match self.lower.target(out).last() {
                Some(stmt) => stmt.span,
                None => Span::new(end.saturating_sub(1), end),
            };
            out.report(Fault::NoProgramEnd, at);
            if self.lower.settings.dialect.program.o_words && self.lower.state.compensated == Know::Said(true)
            {
                // The last move under it is made when the program says its end (LinuxCNC's interpreter, run).
                let name = "under cutter radius compensation".into();
                out.report(Fault::NotSupported { code: "end of the text".into(), name }, at);
            }
        }
        if let Some(procedure) = self.lower.sub.take() {
            out.procedures.push(procedure);
        }
        self.lower.ended = true;
    }

    /// The whole text is over.
    pub(in crate::word) fn end_of_text(&mut self, out: &mut Batch) {
        if !self.frame.blocks && !self.frame.faulty {
            out.report(Fault::EmptyProgram, Span::new(0, 0));
        }
    }

    /// Signs that no text has; many of them, and it is none.
    pub(in crate::word) fn control_signs(&mut self, out: &mut Batch) {
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
    pub(in crate::word) fn not_text(&mut self, span: Span, out: &mut Batch) {
        self.frame.is_binary = true;
        self.frame.faulty = true;
        out.report(Fault::NotText, span);
    }

    /// The letter O where a zero is meant: as the number of a letter that has none (`GOX-15.`,
    /// `GZO`), or without a number behind another word's digits (`X1O`).
    pub(in crate::word) fn check_letters(&mut self, src: Source) {
        let block = &mut self.block;
        let spelt = |from: &Word, to: &Word| from.span.end == to.span.start && to.value == Value::None;
        for (at, pair) in block.words.windows(2).enumerate() {
            let (word, next) = (&pair[0], &pair[1]);
            // Further letters behind it spell a word of a language: `COVER`.
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
