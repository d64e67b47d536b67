//! The back-end of the word-address family: blocks of letters and numbers.
//!
//! Everything that differs from control to control comes from the dictionary. Statements of one
//! block are written as one block where the control can read it so, in the order in which posts
//! write words. What the dictionary lacks is a fault at the statement, never silent.
//!
//! ```text
//! a cycle of drilling    `G99 G81 X10. Z-6. R3. F100.`
//! ```
//!
//! Not here: expanding what a control cannot say (passes), and judging the result (verification).

mod by_hand;
mod corner;
mod cycles;
mod data;
mod frame;
mod holes_again;
mod macros;
mod motion;
mod polar;
mod repeat;
mod spindle;
mod statement;

use ncc_dialects::{Dialect, Settings};
use ncc_ir::canon::Modes;
use ncc_ir::diag::Diagnostic;
use ncc_ir::expr::num::Num;
use ncc_ir::program::{Op, Stmt, Text};

use cycles::Held;

use crate::Layout;
use crate::common::Sink;
use crate::common::packed::{each_blocks, packed};
use crate::common::table::WritesBlocks;
use crate::common::words::Words;

/// Choices of the dictionary's options that decide how a word reads back.
#[derive(Clone, Copy, Debug)]
struct Options {
    /// The corrector word applies a length; else it means nothing and cannot carry one.
    corrector_counts: bool,
    /// A bolt circle's positive step is clockwise.
    circle_clockwise: bool,
    /// A bolt circle without centre words is about program zero; else about where the tool is.
    circle_about_zero: bool,
    /// A grid's words are the whole extent of a row; else the pitch.
    grid_extent: bool,
    /// Tapping is rigid, without a code that makes it so.
    rigid_taps: bool,
}

/// Writes a program in a word-address dialect.
#[derive(Clone, Debug)]
pub struct Writer {
    pub(crate) words: Words,
    dialect: &'static Dialect,
    options: Options,
    /// Whether nothing goes on after what has been written of the main procedure.
    main_ends: bool,
    held: Option<Held>,
    /// Holes that the word of repetition makes after the one at hand.
    repeats: usize,
    /// What the program stop that comes next says.
    stop_text: Option<Text>,
    /// A cycle has said a dwell that stays active for others: for those of its series, or for all.
    dwell_left: bool,
    /// Whether the pecks that the text has active decrease, if it has said any since a cycle ended.
    pecks_left: Option<bool>,
    told_corner: bool,
    /// Blocks that others repeat, or that are jumped to.
    labels: repeat::Labels,
    /// What is known of a program that computes.
    computing: macros::computing::Computing,
    /// Whether calls after moves are being written, and how far.
    at_moves: macros::modal_call::AtMoves,
    /// What is known of its O words.
    o_words: macros::o_words::OWords,
    /// Whether the words of the plane's axes are radius and angle.
    polar: bool,
    /// Whether lengths take effect with tool centre point control.
    tip: bool,
    /// Whether it was reported that entry 0 of the length table is taken for none.
    told_no_length: bool,
}

impl Writer {
    /// A writer for a dialect of the word-address family.
    pub fn new(settings: Settings, layout: Layout) -> Writer {
        Writer {
            dialect: settings.dialect,
            options: Options {
                corrector_counts: settings.get("o_word") != "ignore",
                circle_clockwise: settings.get("g24_direction") == "cw",
                circle_about_zero: settings.get("g24_centre") == "zero",
                grid_extent: settings.get("g25_xy") == "extent",
                rigid_taps: settings.get(ncc_dialects::TAPPING) == "rigid",
            },
            words: Words::new(settings, &layout),
            main_ends: false,
            held: None,
            repeats: 0,
            stop_text: None,
            dwell_left: false,
            pecks_left: None,
            told_corner: false,
            labels: repeat::Labels::default(),
            computing: macros::computing::Computing::default(),
            at_moves: macros::modal_call::AtMoves::None,
            o_words: macros::o_words::OWords::default(),
            polar: false,
            tip: false,
            told_no_length: false,
        }
    }

    /// Facts that the written text states by itself, in its safe start line.
    pub fn stated(&self) -> Modes {
        self.words.stated()
    }

    /// Writes statements of the main procedure, in pieces of whole blocks. `assumed` holds the facts
    /// that the source relies on without having said them; it may grow from piece to piece.
    pub fn write(&mut self, stmts: &[Stmt], assumed: &Modes, out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        let mut sink = Sink { out, diags };
        self.words.take_for_granted(assumed);
        self.main_ends = frame::ends(stmts).unwrap_or(self.main_ends);
        self.number_labels(stmts);
        self.number_jumps(stmts);
        self.words.look_ahead(stmts);
        self.o_main(stmts, &mut sink);
        let silent = |s: &&Stmt| !matches!(s.op, Op::Comment(_) | Op::Blank | Op::NoEffect(_));
        let last = stmts.iter().rev().find(silent).filter(|s| s.op == Op::BeginAgain && s.skip.is_none());
        if let Some(last) = last.filter(|_| self.dialect.program.macro_b) {
            // Without an end of its own such a text is a subprogram.
            self.o_main(&[Stmt::new(last.span, Op::ProgramEnd)], &mut sink);
        }
    }

    fn body(&mut self, stmts: &[Stmt], sink: &mut Sink) {
        let runs = self.runs_at_moves(stmts);
        let mut at = 0;
        while at < stmts.len() {
            if let Some(lines) = packed(&stmts[at]) {
                each_blocks(lines, |blocks| self.body(blocks, sink));
                at += 1;
                continue;
            }
            let end = self.words.block_end(stmts, at);
            self.repeats = if runs.is_empty() { self.equal_holes(stmts, at, end) } else { 0 };
            let (block, repeated) = stmts[at..end + self.repeats].split_at(end - at);
            let end = end + repeated.len();
            if let Some(run) = runs.iter().find(|run| run.from == at) {
                self.begin_calls_at_moves(&stmts[run.call], sink);
            }
            if let Some(trace) = &mut self.words.trace {
                trace.enter(&stmts[at..end]);
            }
            if !repeated.is_empty() || !self.plain_block(block, sink) {
                self.words.pass_on(sink.out);
                self.source_block(block, sink);
            }
            repeated.iter().for_each(|stmt| self.words.tracker.step(stmt));
            if self.words.trace.is_some() {
                self.words.block_written(sink.out);
            }
            at = end;
            if let Some(run) = runs.iter().find(|run| run.to == at) {
                self.end_calls_at_moves(&stmts[run.call], sink);
            }
        }
        self.words.pass_on(sink.out);
    }

    /// Writes the statements of one block of the source.
    fn source_block(&mut self, stmts: &[Stmt], sink: &mut Sink) {
        let Some(first) = stmts.first() else { return };
        self.open_block(first);
        let (before, jump) = macros::computed_jump::found(stmts);
        for stmt in before {
            let before = self.words.open(stmt, sink);
            let written = match before {
                Ok(_) => self.statement(stmt, sink),
                Err(ref fault) => Err(fault.clone()),
            };
            self.words.close(stmt, before.ok(), written, sink);
        }
        if let (Some(jump), Some(first), Some(last)) = (jump, stmts.get(before.len()), stmts.last()) {
            let force = self.words.open(first, sink);
            let written = match force {
                Ok(_) => self.jump_to_number(&jump, first, sink),
                Err(ref fault) => Err(fault.clone()),
            };
            self.words.close(last, force.ok(), written, sink);
        }
        self.close_block(stmts, sink);
    }

    /// Begins a block of the source.
    fn open_block(&mut self, first: &Stmt) {
        self.words.open_block(first);
        if !self.is_jumped_to(&first.op) {
            self.words.numbers.seen(first.number, first.span);
        }
    }

    /// Ends a block of the source.
    fn close_block(&mut self, stmts: &[Stmt], sink: &mut Sink) {
        self.label_ends();
        self.number_alone(sink);
        self.words.close_block(stmts, sink);
    }

    /// Writes a block that is nothing but a straight move, or leaves it untouched.
    #[inline]
    fn plain_block(&mut self, block: &[Stmt], sink: &mut Sink) -> bool {
        self.writes_plainly() && self.words.plain_block(block, sink)
    }

    /// Forgets everything that is active: after a call, at a procedure's start.
    fn forget(&mut self) {
        self.words.forget();
        self.held = None;
    }
}

impl WritesBlocks for Writer {
    fn words(&mut self) -> &mut Words {
        &mut self.words
    }

    #[inline]
    fn writes_plainly(&self) -> bool {
        self.held.is_none() && !self.polar
    }

    fn feed_stated(&mut self, _: Num) {}

    fn blocks(&mut self, stmts: &[Stmt], sink: &mut Sink) {
        self.body(stmts, sink);
    }
}
