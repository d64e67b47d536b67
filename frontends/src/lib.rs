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

pub mod canon;
mod common;
mod corners;
mod initial_modes;
pub mod ir;
pub mod pieces;
pub mod recognise;
pub mod siemens;
pub mod word;

use corners::Corners;
use ncc_dialects::{Dialect, Family, Settings};
use ncc_ir::canon::Modes;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::Num;
use ncc_ir::program::{Op, Procedure, ProgramName, Stmt};
use ncc_ir::source::Span;

/// What reading a piece of text gave. The vectors are drained by the caller between pieces and
/// their memory is used again.
#[derive(Debug, Default)]
pub struct Batch {
    /// Further statements of the main procedure.
    pub stmts: Vec<Stmt>,
    /// Subprograms that are complete.
    pub procedures: Vec<Procedure>,
    /// The program's own name, as far as read.
    pub name: ProgramName,
    /// Every fact that the program has relied on so far without having said it, with the value
    /// taken for granted; grows, and is not to be drained.
    pub assumed: Modes,
    /// Set with the first call, label, jump or loop: from there on the program must be kept whole.
    pub whole: bool,
    /// What was found.
    pub diagnostics: Vec<Diagnostic>,
    /// Numbers without a point that count increments; only after [`Reader::watch`].
    pub bare: Vec<BareNumber>,
    /// Whether a length has been met that is written with a point and is not zero; only after
    /// [`Reader::watch`], and of dialects where the point matters.
    pub pointed: bool,
    /// Whether the text has been found to be a subprogram without its main program.
    pub subprogram: bool,
    /// What the main procedure says of itself, where that is more than its name: a subprogram that is read alone has
    /// parameters, which are given their values from elsewhere. Its body is empty.
    pub heading: Option<Box<Procedure>>,
}

impl Batch {
    /// The main procedure with these statements, and what it says of itself.
    pub fn main(&mut self, body: Vec<Stmt>) -> Procedure {
        let heading = self.heading.take().map(|heading| *heading).unwrap_or_default();
        Procedure { body, ..heading }
    }

    /// Where further statements go: into the subprogram that is being read, else into the main procedure.
    #[inline]
    pub(crate) fn body<'o>(&'o mut self, sub: &'o mut Option<Procedure>) -> &'o mut Vec<Stmt> {
        match sub {
            Some(procedure) => &mut procedure.body,
            None => &mut self.stmts,
        }
    }
}

/// A number that stands without a decimal point where the dialect's rule makes that another value.
#[derive(Clone, Debug, PartialEq)]
pub struct BareNumber {
    /// Its word.
    pub span: Span,
    /// The value by the dialect's rule.
    pub read: Num,
    /// What the same digits are with a point after them.
    pub with_point: Num,
    /// Whether it is a feed.
    pub feed: bool,
}

/// A piece of a text, as far as it says where a program can go.
#[derive(Clone, Debug, PartialEq)]
pub enum Flow {
    /// A program or subprogram begins: numbers and labels are its own.
    Program,
    /// A block.
    Block {
        /// Its number or label, as jumps name it: `N40`, `AGAIN`.
        label: Option<String>,
        /// All of it.
        at: Span,
        /// Whether it says anything that is executed.
        says: bool,
        /// Whether it is part of a structure (a loop, an alternative) that may lead to it by itself.
        frames: bool,
    },
    /// A jump, in the block that was told last.
    Jump {
        /// Where to; `None` is computed.
        to: Option<String>,
        /// Its place.
        at: Span,
        /// Whether it is always made.
        always: bool,
        /// Whether the control goes on where there is no such block.
        quiet: bool,
    },
}

/// Tells the blocks and jumps of a whole text, translated or not. Texts of families without jumps have
/// none.
pub fn flow(settings: &Settings, text: &[u8], found: &mut dyn FnMut(Flow)) {
    match settings.dialect.family {
        Family::Word => word::text::jumps::jumps(settings, text, found),
        Family::Sinumerik => siemens::text::jumps::jumps(text, found),
        Family::Canon | Family::Ir => {}
    }
}

/// A word of a text, as its dictionary may have a row for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Word<'t> {
    /// A letter with a number, in tenths where it has them: `G43`, `G5.1`, `X10.`.
    Numbered {
        /// The letter, a capital.
        letter: u8,
        /// Ten times the number, if that is a whole number; `None` for what no code has.
        tenths: Option<u32>,
    },
    /// A letter with another value, or none.
    Letter(u8),
    /// A word of several letters, as written.
    Name(&'t [u8]),
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

/// A literal for people: `0.1 mm`.
pub fn spell(num: Num) -> String {
    common::number::spell(num)
}

/// The name of the [`NoEffect`](ncc_ir::program::Op::NoEffect) that stands where a block was refused, after
/// [`Reader::watch`].
pub const REFUSED: &str = "";

/// A statement for a block that was refused.
pub(crate) fn refused(span: Span) -> Stmt {
    Stmt::new(span, Op::NoEffect(REFUSED.into()))
}

impl Batch {
    /// Reports something at a place.
    pub(crate) fn report(&mut self, fault: Fault, span: Span) {
        self.diagnostics.push(Diagnostic::new(fault, span));
    }

    /// Whether the last thing reported is an error of a word of this block.
    pub(crate) fn refused_within(&self, block: Span) -> bool {
        self.diagnostics.last().is_some_and(|last| {
            last.fault.gravity() == ncc_ir::diag::Gravity::Error
                && block.start <= last.span.start
                && last.span.end <= block.end
        })
    }
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
        let corners = Corners::of(&settings).filter(|_| assume);
        let family = match settings.dialect.family {
            Family::Word => OfFamily::Word(Box::new(word::Reader::new(settings, assume))),
            Family::Canon => OfFamily::Canon(Box::new(canon::Reader::new(settings, assume))),
            Family::Sinumerik => OfFamily::Siemens(Box::new(siemens::Reader::new(settings, assume))),
            Family::Ir => OfFamily::Ir(Box::new(ir::Reader::new(settings, assume))),
        };
        Reader { family, corners }
    }

    /// The program of the text is called by another, states nothing of what its caller has in force, and goes back to
    /// it: what the text never says is taken for granted from here on, as of a source.
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

    /// For a text of which modes are known from elsewhere: what it takes for granted of its control besides them is
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
