//! ncc-frontends: from the text of a dialect to statements of the neutral program.
//!
//! Reading never fails: it gives statements and diagnostics, and goes on at the next block. Text
//! comes in pieces of whole lines, so that memory does not grow with the program.
//!
//! ```text
//! `G1 X10.5 F100.`    STRAIGHT_FEED(X 10.5mm) & SET_FEED_RATE(100mm), and where they stand in the text
//! ```
//!
//! Not here: file access, formatting, printing, anything of back-ends.

mod batch;
pub mod canon;
mod common;
mod corners;
mod initial_modes;
pub mod ir;
mod outline;
pub mod pieces;
pub mod recognise;
pub mod siemens;
pub mod word;

pub use batch::{BareNumber, Batch, REFUSED};
pub use common::pieces::Shown;
use corners::Corners;
use ncc_dialects::{Dialect, Family, Settings};
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::Num;
use ncc_ir::source::Span;
pub use outline::{Flow, Word};

/// Tells the blocks and jumps of a whole text, translated or not. Texts of families without jumps have
/// none.
pub fn flow(settings: &Settings, text: &[u8], found: &mut dyn FnMut(Flow)) {
    match settings.dialect.family {
        Family::Word => word::text::jumps::jumps(settings, text, found),
        Family::Sinumerik => siemens::text::jumps::jumps(text, found),
        Family::Canon | Family::Ir => {}
    }
}

/// Tells the words of one line by the dialect's own lexer, comments left out, whether they make sense or
/// not. It stops at what is no word. Lines of families without a dictionary of words have none.
pub fn words(dialect: &Dialect, line: &[u8], found: &mut dyn FnMut(Word)) {
    match dialect.family {
        Family::Word => word::text::words::words(dialect, line, found),
        Family::Sinumerik => siemens::text::words::words(line, found),
        Family::Canon | Family::Ir => {}
    }
}

/// Whether any of these whole lines may have the control execute blocks again by their numbers: a text in which none does
/// need not be kept ([`Reader::repeats`]).
pub fn may_repeat_blocks(dialect: &Dialect, lines: &[u8]) -> bool {
    match dialect.family {
        Family::Word => word::may_repeat(dialect, lines),
        Family::Sinumerik | Family::Canon | Family::Ir => false,
    }
}

/// Whether any of these whole lines may go to another block by its number: then which blocks are named so must be known
/// before they are read ([`Reader::foresee_jumps`]).
pub fn may_jump(dialect: &Dialect, lines: &[u8]) -> bool {
    match dialect.family {
        Family::Word => word::may_jump(dialect, lines),
        Family::Sinumerik | Family::Canon | Family::Ir => false,
    }
}

/// A literal for people: `0.1 mm`.
pub fn spell(num: Num) -> String {
    common::number::spell(num)
}

/// The reader of one text, of whichever family its dialect is.
pub struct Reader {
    family: OfFamily,
    corners: Option<Corners>,
}

/// The reader of a family of dialects.
enum OfFamily {
    /// Letters and numbers.
    Word(Box<word::Reader>),
    /// The canonical functions.
    Canon(Box<canon::Reader>),
    /// The Sinumerik's language.
    Siemens(Box<siemens::Reader>),
    /// The text form of the neutral program.
    Ir(Box<ir::Reader>),
}

impl Reader {
    /// The reader of a dialect. With `assume` (a user's source), a fact that the program relies on
    /// and never says is taken from the dictionary, recorded in [`Batch::assumed`] and reported
    /// once; without (text that ncc wrote), it stays open.
    pub fn new(settings: Settings, assume: bool) -> Reader {
        let corners = Corners::from_settings(&settings).filter(|_| assume);
        let family = match settings.dialect.family {
            Family::Word => OfFamily::Word(Box::new(word::Reader::new(settings, assume))),
            Family::Canon => OfFamily::Canon(Box::new(canon::Reader::new(settings, assume))),
            Family::Sinumerik => OfFamily::Siemens(Box::new(siemens::Reader::new(settings, assume))),
            Family::Ir => OfFamily::Ir(Box::new(ir::Reader::new(settings, assume))),
        };
        Reader { family, corners }
    }

    /// The program of the text is called by another, states nothing of the modes active in its caller, and returns to
    /// it: what the text never says is assumed from here on, as of a source.
    pub fn called(&mut self) {
        if let Some(corners) = &mut self.corners {
            corners.called();
        }
        match &mut self.family {
            OfFamily::Word(reader) => reader.called(),
            OfFamily::Siemens(reader) => reader.called(),
            OfFamily::Canon(_) | OfFamily::Ir(_) => {}
        }
    }

    /// The text is that of a file of this name, by which or by whose extension some controls know subprograms.
    pub fn named(&mut self, file: &str) {
        match &mut self.family {
            OfFamily::Siemens(reader) => reader.named(file),
            OfFamily::Word(reader) => reader.named(file),
            OfFamily::Canon(_) | OfFamily::Ir(_) => {}
        }
    }

    /// For a text of which modes are known from elsewhere: what it assumes of its control besides them is
    /// reported all the same. Of the Sinumerik's language; the writers of the others report it.
    pub fn report_parameters(&mut self) {
        match &mut self.family {
            OfFamily::Siemens(reader) => reader.report_parameters(),
            OfFamily::Word(_) | OfFamily::Canon(_) | OfFamily::Ir(_) => {}
        }
    }

    /// For somebody who looks at a program without executing all of it: a refused block leaves a
    /// statement without effect ([`REFUSED`]) at its place, a missing feed is left to the execution, and
    /// numbers without a point are noted in [`Batch::bare`]. Of the families of words alone; texts of
    /// the others are refused as ever.
    pub fn watch(&mut self) {
        match &mut self.family {
            OfFamily::Word(reader) => reader.watch(),
            OfFamily::Siemens(reader) => reader.watch(),
            OfFamily::Canon(_) | OfFamily::Ir(_) => {}
        }
    }

    /// Whether a block of the text that is read from here on may execute others again by their numbers
    /// ([`may_repeat_blocks`]); one that has not been looked through may. If none does, a block's number is no reason to
    /// keep the program whole.
    pub fn repeats(&mut self, may: bool) {
        match &mut self.family {
            OfFamily::Word(reader) => reader.repeats(may),
            OfFamily::Siemens(_) | OfFamily::Canon(_) | OfFamily::Ir(_) => {}
        }
    }

    /// The text goes to other blocks somewhere ([`may_jump`]): these are lines of it, before any is read.
    pub fn foresee_jumps(&mut self, lines: &[u8]) {
        match &mut self.family {
            OfFamily::Word(reader) => reader.foresee_jumps(lines),
            OfFamily::Siemens(_) | OfFamily::Canon(_) | OfFamily::Ir(_) => {}
        }
    }

    /// Reads further whole lines. Spans count from `base`, the place of the first byte of `text`
    /// in the source.
    pub fn read(&mut self, text: &[u8], base: u32, out: &mut Batch) {
        let before = (out.stmts.len(), out.procedures.len());
        match &mut self.family {
            OfFamily::Word(reader) => reader.read(text, base, out),
            OfFamily::Canon(reader) => reader.read(text, base, out),
            OfFamily::Siemens(reader) => reader.read(text, base, out),
            OfFamily::Ir(reader) => reader.read(text, base, out),
        }
        self.state_corners(before, out);
    }

    /// Reads further whole lines, and gives the plain moves before anything else as a table ([`Batch::table`]), which the
    /// caller takes out before more is read.
    pub fn read_to_table(&mut self, text: &[u8], base: u32, out: &mut Batch) {
        out.tabled = self.corners.is_none();
        self.read(text, base, out);
        out.tabled = false;
    }

    /// How many of the main procedure's statements are as they stay, whatever is read further, where they are plain moves
    /// and not of the last block: they may be packed ([`Op::Lines`](ncc_ir::program::Op::Lines)). None are where a
    /// structure is open, which knows its beginning by its place, or where blocks are looked for by their numbers.
    pub fn settled(&self, out: &Batch) -> usize {
        let settled = match &self.family {
            OfFamily::Word(reader) => reader.is_settled(),
            OfFamily::Siemens(reader) => reader.is_settled(),
            OfFamily::Canon(_) | OfFamily::Ir(_) => false,
        };
        if settled { out.stmts.len() } else { 0 }
    }

    /// Reads a text that is there, as [`Reader::read`] does, and shows what is read of it after each piece of so many
    /// bytes, with how many statements are [settled](Reader::settled).
    pub fn read_showing(&mut self, text: &[u8], base: u32, out: &mut Batch, shown: Shown) {
        match &mut self.family {
            OfFamily::Word(reader) if self.corners.is_none() => reader.read_showing(text, base, out, shown),
            OfFamily::Siemens(reader) if self.corners.is_none() => {
                reader.read_showing(text, base, out, shown)
            }
            _ => self.read(text, base, out),
        }
    }

    /// A line that is too long to be handed over: only its place is known.
    pub fn too_long(&mut self, span: Span, out: &mut Batch) {
        match &mut self.family {
            OfFamily::Word(reader) => reader.too_long(span, out),
            OfFamily::Siemens(reader) => reader.too_long(span, out),
            OfFamily::Canon(_) | OfFamily::Ir(_) => {
                out.report(Fault::BlockTooLong { limit: LONGEST_LINE }, span)
            }
        }
    }

    /// The end of the text.
    pub fn finish(&mut self, out: &mut Batch) {
        let before = (out.stmts.len(), out.procedures.len());
        match &mut self.family {
            OfFamily::Word(reader) => reader.finish(out),
            OfFamily::Canon(reader) => reader.finish(out),
            OfFamily::Siemens(reader) => reader.finish(out),
            OfFamily::Ir(reader) => reader.finish(out),
        }
        self.state_corners(before, out);
    }

    fn state_corners(&mut self, (stmts, procedures): (usize, usize), out: &mut Batch) {
        let Some(corners) = &mut self.corners else { return };
        corners.state(&mut out.stmts, stmts, out.assumed.units);
        for procedure in &mut out.procedures[procedures..] {
            corners.state_in(&mut procedure.body);
        }
    }
}

/// Longest line of a text whose dialect sets no limit, in bytes; longer ones are not handed over.
pub const LONGEST_LINE: u32 = 1 << 16;
