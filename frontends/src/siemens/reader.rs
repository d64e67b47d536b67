//! The reader of a Sinumerik's text: lines, units, what is main program and what is subprogram, and
//! the end.
//!
//! A usual block of one move goes from the line straight to its statement. Any other line goes to the recogniser
//! of plain blocks, which the word-address dialects have as well, and to the grammar if it is not
//! one. The first program of a text is the main one; a unit of type SPF that follows is a subprogram.
//! Without headers the whole text is the main program.
//!
//! Refused: a second main program, units that are no programs, and subprograms that only a
//! path could call.

use ncc_dialects::Settings;
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::Fault;
use ncc_ir::program::{Op, Procedure, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::unsupported::TextUnsupported;

use super::lower::Lower;
use super::program::calls::procedure_name;
use super::siemens_state::ModalCall;
use super::text::fast_computed;
use super::text::letters::letter_for_zero;
use super::text::parse::parse;
use super::text::tree::{Block, Statement};
use super::text::unit;
use super::text::unit::{Header, Kind, Line};
use crate::batch::{Batch, refused};
use crate::common::pieces::{Shown, pieces};
use crate::common::words::{Value, Word};
use crate::common::{Source, fast_parse};

/// Longest block of a dictionary that sets no limit, in bytes.
const LONGEST: usize = 60_000;

/// Characters that no text has, before reading is given up.
const MOST_CONTROL_SIGNS: u32 = 16;

/// Reads one text, piece by piece.
#[derive(Debug)]
pub struct Reader {
    pub(super) lower: Lower,
    words: Vec<Word>,
    /// Longest block, in bytes.
    longest: usize,
    /// Whether a header has been met.
    headed: bool,
    /// Whether the line before was a header.
    after_header: bool,
    /// Lines are passed over: of a unit that is no program, or is refused.
    passing: bool,
    /// Whether any block that says something has been met.
    blocks: bool,
    /// Whether anything was refused.
    faulty: bool,
    /// Whether text after the end was reported.
    after_end: bool,
    /// Not a text; nothing is read any more.
    is_binary: bool,
    control_signs: u32,
    /// End of the last line that was looked at.
    end: u32,
    /// Every line goes through the grammar.
    #[cfg(test)]
    slow: bool,
}

impl Reader {
    /// A reader of one text. With `assume`, what the program relies on and never says is taken
    /// from the dictionary and reported; without, it stays open and nothing is reported of it.
    pub fn new(settings: Settings, assume: bool) -> Reader {
        let longest = match settings.dialect.block.longest {
            0 => LONGEST,
            longest => (longest as usize).min(LONGEST),
        };
        Reader {
            lower: Lower::new(settings, assume),
            words: Vec::new(),
            longest,
            headed: false,
            after_header: false,
            passing: false,
            blocks: false,
            faulty: false,
            after_end: false,
            is_binary: false,
            control_signs: 0,
            end: 0,
            #[cfg(test)]
            slow: false,
        }
    }

    /// Takes no short ways, to compare with.
    #[cfg(test)]
    pub(super) fn grammar_alone(&mut self) {
        self.slow = true;
    }

    fn takes_short_ways(&self) -> bool {
        #[cfg(test)]
        let short = !self.slow;
        #[cfg(not(test))]
        let short = true;
        short
    }

    /// As of [`crate::Reader::watch`].
    pub(crate) fn watch(&mut self) {
        self.lower.watch = true;
    }

    /// As of [`crate::Reader::report_parameters`].
    pub(crate) fn report_parameters(&mut self) {
        self.lower.reports = true;
    }

    /// As of [`crate::Reader::named`].
    pub(crate) fn named(&mut self, file: &str) {
        let Some((_, extension)) = file.rsplit_once('.') else { return };
        let dialect = self.lower.settings.dialect;
        let same = |other: &String| other.eq_ignore_ascii_case(extension);
        if dialect.program.sub_extension.as_ref().is_some_and(same) {
            self.lower.unit = Some(Kind::Sub);
        } else if dialect.extensions.iter().any(same) {
            self.lower.unit = Some(Kind::Main);
        }
    }

    /// As of [`crate::Reader::called`].
    pub(crate) fn called(&mut self) {
        self.lower.unit = Some(Kind::Sub);
        (self.lower.called, self.lower.assume) = (true, true);
        self.lower.refresh();
    }

    /// Reads further whole lines; `base` is the place of their first byte in the source.
    pub fn read(&mut self, text: &[u8], base: u32, out: &mut Batch) {
        self.read_showing(text, base, out, (usize::MAX, &mut |_, _| {}));
        out.keep_last();
    }

    /// As of [`crate::Reader::settled`].
    pub(crate) fn is_settled(&self) -> bool {
        self.lower.flow.open.is_empty()
    }

    /// As of [`crate::Reader::read_showing`].
    pub(crate) fn read_showing(&mut self, text: &[u8], base: u32, out: &mut Batch, shown: Shown) {
        if self.is_binary {
            return;
        }
        if let Some(at) = memchr::memchr(0, text) {
            let at = base + at as u32;
            return self.not_text(Span::new(at, at + 1), out);
        }
        out.tabled &= self.is_settled();
        self.lower.look_ahead(text, out);
        // What has been written of it would have stated what is its caller's.
        out.whole |= self.lower.unit == Some(Kind::Sub);
        if !out.whole {
            self.lower.note_stand(base > 0);
        }
        let (piece, shown) = shown;
        for piece in pieces(text, piece) {
            self.lines(&text[piece.clone()], base + piece.start as u32, out);
            if self.is_binary {
                return;
            }
            let settled = if self.is_settled() { out.stmts.len() } else { 0 };
            shown(&mut out.stmts, settled);
        }
    }

    fn lines(&mut self, text: &[u8], base: u32, out: &mut Batch) {
        let src = Source { text, base };
        let mut at = if base == 0 && text.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 };
        while at < text.len() {
            let open = self.takes_short_ways() && !self.passing && !self.lower.ended;
            if open && let Some(end) = self.lower.short_way(text, at, base, self.longest, out) {
                self.blocks = true;
                self.after_header = false;
                let returns = text[..end].ends_with(b"\r");
                self.end = base + end as u32 - u32::from(returns);
                at = end + 1;
                continue;
            }
            if open
                && let Some(end) = fast_parse::read(text, at, base, &mut self.words)
                && end - at <= self.longest
                && !negative_number(&self.words, src)
                && self.fast_parsed_block(src, out)
            {
                at = end + 1;
                continue;
            }
            let end = memchr::memchr(b'\n', &text[at..]).map_or(text.len(), |len| at + len);
            self.line(at, end, src, out);
            if self.is_binary {
                return;
            }
            at = end + 1;
        }
    }

    /// A line that is too long to be handed over: only its place is known.
    pub fn too_long(&mut self, span: Span, out: &mut Batch) {
        let limit = self.longest.min(u32::MAX as usize) as u32;
        out.report(Fault::BlockTooLong { limit }, span);
        self.faulty = true;
        self.end = self.end.max(span.end);
        if self.lower.watch {
            self.lower.target(out).push(refused(span));
        }
        self.lower.forgive();
        self.lower.refresh();
    }

    /// The end of the text.
    pub fn finish(&mut self, out: &mut Batch) {
        if self.is_binary {
            return;
        }
        self.end_of_program(out);
        match self.lower.callers_feed.take() {
            Some(at) if !out.subprogram => out.report(Fault::NoFeed, at),
            Some(at) if self.lower.assume => {
                out.report(Fault::AssumedFact { fact: ControlFact::CallersFeed }, at);
            }
            _ => {}
        }
        self.lower.hand_over(out);
        self.lower.give_back(out);
        self.lower.saved.check(out);
        self.lower.inherited.settle(self.lower.settings.dialect, out);
        for (name, at) in self.lower.repeated_blocks.unknown() {
            out.report(Fault::CallUnknown { name }, at);
        }
        if !self.blocks && !self.faulty {
            out.report(Fault::EmptyProgram, Span::new(0, 0));
        }
    }

    /// A block that the recogniser has read; `false` if it is the grammar's after all.
    fn fast_parsed_block(&mut self, src: Source, out: &mut Batch) -> bool {
        let is_number = |word: &Word| match word.value {
            Value::Number(d) => !d.point && d.mantissa >= 0 && u32::try_from(d.mantissa).is_ok(),
            Value::None | Value::Computed(_) => false,
        };
        // A block number comes first, and calls have their zeros.
        let number = self.words.iter().position(|w| w.letter == b'N');
        let fits = match number {
            None => true,
            Some(0) => is_number(&self.words[0]) && self.words[1..].iter().all(|w| w.letter != b'N'),
            Some(_) => false,
        };
        let (Some(first), Some(last)) = (self.words.first(), self.words.last()) else {
            return false;
        };
        if !fits || self.words.iter().any(|w| w.letter == b'L') {
            return false;
        }
        let span = Span::new(first.span.start, last.span.end);
        let words = std::mem::take(&mut self.words);
        self.blocks = true;
        self.after_header = false;
        self.end = span.end;
        self.lower.lower_fast_parsed(&words, span, src, out);
        self.words = words;
        self.faulty |= self.lower.now.failed;
        true
    }

    /// A line that is not plain.
    fn line(&mut self, start: usize, mut end: usize, src: Source, out: &mut Batch) {
        while end > start && src.text[end - 1] == b'\r' {
            end -= 1;
        }
        let base = src.base + start as u32;
        let span = Span::new(base, src.base + end as u32);
        let after_header = std::mem::take(&mut self.after_header);
        let line = &src.text[start..end];
        match unit::line(line, base) {
            Ok(Line::Header(header)) => return self.header(header, span, src, out),
            Ok(Line::Path(_)) if after_header => {
                self.after_header = true;
                return;
            }
            Ok(Line::Mark) => return,
            Ok(Line::Path(_) | Line::Block) if self.passing => return,
            Ok(Line::Path(_) | Line::Block) => {}
            Err((fault, at)) => return self.fault(fault, at, out),
        }
        if end - start > self.longest {
            return self.too_long(span, out);
        }
        self.end = span.end;
        let recognised = if self.takes_short_ways() { fast_computed::read(line, base) } else { None };
        let block = match recognised.map_or_else(|| parse(line, base), Ok) {
            Ok(block) => block,
            Err((fault, at)) => return self.no_block(fault, at, span, src, out),
        };
        let says_nothing = says_nothing(&block);
        if self.lower.ended && !says_nothing {
            if !std::mem::replace(&mut self.after_end, true) {
                out.report(Fault::TextAfterEnd, block.span);
            }
            return;
        }
        // A blank line after the end is nothing.
        if self.lower.ended && block.comment.is_none() {
            return;
        }
        self.blocks |= !says_nothing;
        self.lower.block(&block, src, out);
        self.faulty |= self.lower.now.failed;
    }

    /// A line that is no block by its form.
    fn no_block(&mut self, fault: Fault, at: Span, line: Span, src: Source, out: &mut Batch) {
        if let Fault::UnexpectedCharacter { found } = &fault
            && found.is_control()
        {
            self.control_signs += 1;
            if self.control_signs > MOST_CONTROL_SIGNS {
                return self.not_text(at, out);
            }
        }
        if self.lower.ended {
            if !std::mem::replace(&mut self.after_end, true) {
                out.report(Fault::TextAfterEnd, line);
            }
            return;
        }
        self.blocks = true;
        match letter_for_zero(src, line) {
            Some(letter) => self.fault(Fault::LetterOForZero, letter, out),
            None => self.fault(fault, at, out),
        }
        // What follows is not blamed for having no cycle.
        let text = src.text(line).to_ascii_uppercase();
        if text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').any(|word| word == "MCALL") {
            self.lower.state.cycle = ModalCall::Refused;
            self.lower.refresh();
        }
    }

    fn fault(&mut self, fault: Fault, at: Span, out: &mut Batch) {
        out.report(fault, at);
        self.faulty = true;
        if self.lower.watch {
            self.lower.target(out).push(refused(at));
        }
        self.lower.forgive();
        self.lower.refresh();
    }

    /// A unit begins.
    fn header(&mut self, header: Header, line: Span, src: Source, out: &mut Batch) {
        let first = !std::mem::replace(&mut self.headed, true) && !self.blocks;
        self.after_header = true;
        let name = src.text(header.name).to_ascii_uppercase();
        self.passing = false;
        match header.kind {
            Kind::Other => {
                // The main program may come after it.
                self.headed = !first;
                self.passing = true;
                self.refuse(&src.text(line), TextUnsupported::NoProgram, line, out);
            }
            Kind::Main | Kind::Sub if first => {
                let sub = header.kind == Kind::Sub;
                self.lower.unit = Some(if sub { Kind::Sub } else { Kind::Main });
                out.whole |= sub;
                out.name.number = name.parse().ok();
                if out.name.number.is_none() {
                    out.name.title = Some(name.into());
                }
            }
            Kind::Main => {
                self.passing = true;
                self.refuse(&src.text(line), TextUnsupported::SecondMain, line, out);
            }
            Kind::Sub if name.starts_with(|c: char| c.is_ascii_digit()) => {
                self.passing = true;
                self.refuse(&name, TextUnsupported::ByPathOnly, header.name, out);
            }
            Kind::Sub => {
                self.end_of_program(out);
                let name: Text = procedure_name(&name);
                self.lower.enter(&name, header.name, out);
                self.lower.sub = Some(Procedure { name, ..Procedure::default() });
                self.lower.refresh();
                self.after_end = false;
                out.whole = true;
            }
        }
    }

    fn refuse(&mut self, code: &str, what: TextUnsupported, at: Span, out: &mut Batch) {
        self.end_of_program(out);
        self.lower.ended = true;
        self.fault(Fault::not_supported(code, what), at, out);
    }

    /// The program that is being read is over.
    fn end_of_program(&mut self, out: &mut Batch) {
        let in_sub = self.lower.sub.is_some();
        let over = self.lower.flow.over && self.lower.flow.has_end;
        self.faulty |= self.lower.end_flow(out);
        if (in_sub || self.blocks) && !self.lower.ended && !over {
            let end = self.end;
            let last = self.lower.target(out).last().map(|stmt| stmt.span);
            let before = if in_sub { None } else { out.last };
            let at = last.or(before).unwrap_or_else(|| Span::new(end.saturating_sub(1), end));
            if in_sub {
                self.lower.now.failed = false;
                self.lower.leave_motion_before(at, out);
                self.lower.leave(at, out);
                self.faulty |= self.lower.now.failed;
            }
            if !self.faulty {
                out.report(Fault::NoProgramEnd, at);
            }
            if !in_sub && self.lower.unit == Some(Kind::Sub) && !self.faulty {
                out.subprogram = true;
                self.lower.target(out).push(Stmt::new(at, Op::Return));
            }
        }
        if let Some(procedure) = self.lower.sub.take() {
            out.procedures.push(procedure);
        }
        self.lower.ended = true;
    }

    /// This is no text: nothing more is read.
    fn not_text(&mut self, span: Span, out: &mut Batch) {
        self.is_binary = true;
        self.faulty = true;
        out.report(Fault::NotText, span);
    }
}

/// Whether a block number is written with a sign, `N-0`, which its value need not show.
#[inline]
fn negative_number(words: &[Word], src: Source) -> bool {
    let at = |word: &Word| src.text.get((word.span.start - src.base) as usize + 1);
    matches!(words, [first, ..] if first.letter == b'N' && at(first) == Some(&b'-'))
}

/// Whether a block has nothing but a comment.
fn says_nothing(block: &Block) -> bool {
    let empty =
        matches!(&block.statement, Statement::Words { items, jumps } if items.is_empty() && jumps.is_empty());
    empty && block.skip.is_none() && block.number.is_none() && block.label.is_none()
}
