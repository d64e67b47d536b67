//! The back-end of the word-address family: blocks of letters and numbers.
//!
//! Everything that differs from control to control comes from the dictionary. Statements of one
//! block are written as one block where the control can read it so, in the order in which posts
//! write words. What the dictionary has no word for is a fault at the statement, never silent.
//!
//! ```text
//! a cycle of drilling    `G99 G81 X10. Z-6. R3. F100.`
//! ```
//!
//! Not here: expanding what a control cannot say (passes), and judging the result (verification).

mod blocks;
mod by_hand;
mod corner;
mod cycles;
mod data;
mod frame;
mod frames;
mod holes_again;
mod macros;
mod modes;
mod motion;
mod plain;
mod polar;
mod repeat;
mod spindle;
mod start;
mod statement;
mod thread;

use std::collections::BTreeMap;

use ncc_dialects::{Dialect, Role, Settings};
use ncc_ir::canon::{AXES, Modes, RotaryWay, Turn, Units};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::{Nanos, Num, Unit};
use ncc_ir::program::{Op, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

use cycles::Held;
use start::Preamble;

use crate::common::Sink;
use crate::common::active_modes::ActiveModes;
use crate::common::block::Block;
use crate::common::codes::Codes;
use crate::common::comment::Comments;
use crate::origin::Trace;
use crate::{Form, Layout, Numbering, ToolChange};

/// Highest block number (FANUC 16-C: N1 to N99999); numbering begins again after it.
const HIGHEST_NUMBER: u32 = 99_999;

/// Choices of the dictionary's options that decide how a word reads back.
#[derive(Clone, Copy, Debug)]
struct Options {
    /// The corrector word takes up a length; else it means nothing and cannot carry one.
    corrector_counts: bool,
    /// A bolt circle's positive step is clockwise.
    circle_clockwise: bool,
    /// A bolt circle without centre words is about program zero; else about where the tool stands.
    circle_about_zero: bool,
    /// A grid's words are the whole extent of a row; else the pitch.
    grid_extent: bool,
    /// Tapping is rigid, without a code that makes it so.
    rigid_taps: bool,
}

/// Writes a program in a word-address dialect.
#[derive(Clone, Debug)]
pub struct Writer {
    pub(crate) dialect: &'static Dialect,
    options: Options,
    pub(crate) settings: Settings,
    /// Options that nobody chose and the text relies on, as far as told.
    told_options: Vec<&'static str>,
    numbering: Numbering,
    pub(crate) eol: &'static [u8],
    pub(crate) codes: Codes,
    comments: Comments,
    pub(crate) block: Block,
    pub(crate) active: ActiveModes,
    pub(crate) tracker: Tracker,
    /// Whether nothing goes on behind what has been written of the main procedure.
    main_ends: bool,
    /// What the written position lags behind the program's, by rounding; nanos per axis.
    pub(crate) residue: [Nanos; AXES],
    /// Which way round A, B and C go in the next move.
    pub(crate) ways: [Option<RotaryWay>; 3],
    /// Whether any residue is not zero.
    pub(crate) residual: bool,
    held: Option<Held>,
    pub(crate) preamble: Option<Preamble>,
    /// Facts taken for granted that were known at the last piece.
    pub(crate) assumed: Modes,
    /// Whether facts of the program's start may have been changed unseen (a call, a skipped block).
    lost: bool,
    /// Whether a stretch of blocks begins.
    pub(super) forgotten: bool,
    stated: Modes,
    next_number: u32,
    numbers_left: u32,
    first_left: Option<Span>,
    /// Whether the source block at hand had to be split.
    pub(crate) split: bool,
    /// Holes that the word of repetition makes after the one at hand.
    repeats: usize,
    /// What the program stop that comes next says.
    stop_text: Option<Text>,
    /// A cycle has said a dwell that stays in force for others: for those of its series, or for all.
    pub(crate) dwell_left: bool,
    /// Whether the pecks that the text has in force decrease, if it has said any since a cycle ended.
    pecks_left: Option<bool>,
    /// A length offset in the block at hand that needs a Z word beside it.
    offset_waits: Option<Span>,
    /// What the text has said of surface speeds and their limits.
    pub(crate) surfaces: spindle::Surfaces,
    /// The sense in which the spindle turned on the way into the thread at hand.
    pub(crate) turned_in: Option<Turn>,
    /// The next straight move is in machine coordinates, by this code.
    machine: Option<crate::common::codes::Code>,
    /// The next straight move at feed is a probing one, by this code.
    probe: Option<crate::common::codes::ProbeCode>,
    /// The next rapid straight move is one by a detour, by this code.
    detour: Option<crate::common::codes::Code>,
    /// The word of the corner behind the next move.
    pub(crate) corner: Option<String>,
    told_corner: bool,
    /// Blocks that others repeat, or that are jumped to.
    pub(crate) labels: repeat::Labels,
    /// What is known of a program that computes.
    computing: macros::computing::Computing,
    /// Whether calls behind moves are being written, and how far.
    at_moves: macros::modal_call::AtMoves,
    /// Names of the variables of the procedure at hand, as they are spelt.
    pub(crate) variables: BTreeMap<Text, String>,
    /// What is known of its O words.
    o_words: macros::o_words::OWords,
    /// Whether the words of the statement at hand say their own distance mode, where others rely on the one in force.
    pub(crate) says_distance: bool,
    /// Whether the words of the plane's axes are radius and angle.
    polar: bool,
    /// Whether lengths are taken up with control of the tool's tip.
    tip: bool,
    /// Units that the text states anywhere.
    units_stated: [bool; 2],
    /// A literal that relies on one unit being in force throughout, and where.
    units_relied: Option<(Units, Span)>,
    /// Lines of plain moves that have not been passed on, and how many bytes they are.
    page: [u8; plain::PAGE],
    filled: usize,
    /// Codes whose meaning is not confirmed, as far as reported.
    pub(crate) told_unsure: Vec<crate::common::codes::Code>,
    /// Whether it was reported that entry 0 of the length table is taken for none.
    told_no_length: bool,
    /// Words of plain moves that the tracker has not been told of yet, and which axes they name.
    last_words: [Num; AXES],
    named: u8,
    /// Blocks of a tool change.
    pub(crate) tool_change: ToolChange,
    /// Where the lines come from, if somebody asked.
    pub(crate) trace: Option<Box<Trace>>,
}

impl Writer {
    /// A writer for a dialect of the word-address family.
    pub fn new(settings: Settings, layout: Layout) -> Writer {
        let dialect = settings.dialect;
        let rules = &dialect.block;
        let next_number = match layout.numbering {
            Numbering::Every { first, .. } => first,
            Numbering::Off | Numbering::Keep => 0,
        };
        Writer {
            dialect,
            told_unsure: Vec::new(),
            told_options: Vec::new(),
            told_no_length: false,
            options: Options {
                corrector_counts: settings.get("o_word") != "ignore",
                circle_clockwise: settings.get("g24_direction") == "cw",
                circle_about_zero: settings.get("g24_centre") == "zero",
                grid_extent: settings.get("g25_xy") == "extent",
                rigid_taps: settings.get(ncc_dialects::TAPPING) == "rigid",
            },
            numbering: match rules.number {
                Some(_) => layout.numbering,
                None => Numbering::Off,
            },
            eol: if layout.crlf { b"\r\n" } else { b"\n" },
            codes: Codes::new(&settings),
            settings,
            comments: Comments::new(&dialect.comment),
            block: Block::new(rules.blanks, rules.g_codes, rules.m_codes),
            active: ActiveModes::default(),
            tracker: Tracker::default(),
            main_ends: false,
            residue: [0; AXES],
            ways: [None; 3],
            residual: false,
            held: None,
            preamble: (!dialect.safe_start.is_empty()).then(Preamble::default),
            assumed: Modes::default(),
            lost: false,
            forgotten: false,
            stated: Modes::default(),
            next_number,
            numbers_left: 0,
            first_left: None,
            split: false,
            repeats: 0,
            stop_text: None,
            dwell_left: false,
            pecks_left: None,
            offset_waits: None,
            surfaces: spindle::Surfaces::default(),
            turned_in: None,
            machine: None,
            probe: None,
            detour: None,
            corner: None,
            told_corner: false,
            labels: repeat::Labels::default(),
            computing: macros::computing::Computing::default(),
            at_moves: macros::modal_call::AtMoves::None,
            variables: BTreeMap::new(),
            o_words: macros::o_words::OWords::default(),
            says_distance: false,
            polar: false,
            tip: false,
            units_stated: [false; 2],
            units_relied: None,
            page: [0; plain::PAGE],
            filled: 0,
            last_words: [Num::int(0, Unit::Mm); AXES],
            named: 0,
            tool_change: ToolChange::Kept,
            trace: None,
        }
    }

    /// Writes statements of the main procedure, in pieces of whole blocks. `assumed` holds the facts
    /// that the source relies on without having said them; it may grow from piece to piece.
    pub fn write(&mut self, stmts: &[Stmt], assumed: &Modes, out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        let mut sink = Sink { out, diags };
        self.take_for_granted(assumed);
        self.main_ends = frame::ends(stmts).unwrap_or(self.main_ends);
        self.number_labels(stmts);
        self.number_jumps(stmts);
        self.look_ahead(stmts);
        self.o_main(stmts, &mut sink);
        let silent = |s: &&Stmt| !matches!(s.op, Op::Comment(_) | Op::Blank | Op::NoEffect(_));
        let last = stmts.iter().rev().find(silent).filter(|s| s.op == Op::BeginAgain && s.skip.is_none());
        if let Some(last) = last.filter(|_| self.dialect.program.macro_b) {
            // Without an end of its own such a text is a subprogram.
            self.o_main(&[Stmt::new(last.span, Op::ProgramEnd)], &mut sink);
        }
    }

    /// Takes a shop's choices for the form of the text.
    pub fn set_form(&mut self, form: Form) {
        self.tool_change = form.tool_change;
    }

    /// A tool change stands in no block with a move, nor with a length that needs one.
    pub fn changes_apart(&mut self) {
        let edges = self.dialect.address.iter().any(|row| row.role == Role::ToolEdge);
        let from =
            if edges { crate::common::block::Rank::CycleEnd } else { crate::common::block::Rank::Offset };
        self.block.apart = Some(from).filter(|_| !self.dialect.block.change_first);
    }

    /// Facts that the written text states by itself, in its safe start line.
    pub fn stated(&self) -> Modes {
        self.stated
    }

    /// Where the axes stand before the first statement, in program coordinates, as far as the user
    /// has said it.
    pub fn stand_at(&mut self, start: &[Option<Nanos>; AXES]) {
        self.tracker.position = *start;
    }

    fn body(&mut self, stmts: &[Stmt], sink: &mut Sink) {
        let runs = self.runs_at_moves(stmts);
        let mut at = 0;
        while at < stmts.len() {
            let end = self.block_end(stmts, at);
            self.repeats = if runs.is_empty() { self.equal_holes(stmts, at, end) } else { 0 };
            let (block, repeated) = stmts[at..end + self.repeats].split_at(end - at);
            let end = end + repeated.len();
            if let Some(run) = runs.iter().find(|run| run.from == at) {
                self.begin_calls_at_moves(&stmts[run.call], sink);
            }
            if let Some(trace) = &mut self.trace {
                trace.enter(&stmts[at..end]);
            }
            if !repeated.is_empty() || !self.plain_block(block, sink.out) {
                self.pass_on(sink.out);
                self.source_block(block, sink);
            }
            repeated.iter().for_each(|stmt| self.tracker.step(stmt));
            if self.trace.is_some() {
                self.block_written(sink.out);
            }
            at = end;
            if let Some(run) = runs.iter().find(|run| run.to == at) {
                self.end_calls_at_moves(&stmts[run.call], sink);
            }
        }
        self.pass_on(sink.out);
    }

    /// Notes the lines of the block at hand as its own.
    pub(crate) fn block_written(&mut self, out: &mut Vec<u8>) {
        self.pass_on(out);
        if let Some(trace) = &mut self.trace {
            trace.wrote(out, self.preamble.as_ref().map_or(&[], |p| &p.held));
        }
    }

    /// Begins to record where lines come from.
    pub(crate) fn trace(&mut self) {
        self.trace = Some(Box::default());
    }

    /// A comment to stand at the end of a line: as much of the text as one comment holds.
    pub(crate) fn beside(&mut self, text: &str, out: &mut Vec<u8>) -> bool {
        if self.dialect.comment.open.is_empty() {
            return false;
        }
        let start = out.iter().rposition(|byte| *byte == b'\n').map_or(0, |at| at + 1);
        if self.comments.shows_message(&out[start..]) {
            // Of several comments in a block the last one counts: the message would not be shown.
            return false;
        }
        out.push(b' ');
        self.comments.write(text, out, &mut Vec::new(), self.eol);
        true
    }

    /// One past the last statement of the block that begins at `at`, by the form of a tool change.
    pub(crate) fn block_end(&self, stmts: &[Stmt], at: usize) -> usize {
        let mut end = at + 1;
        while end < stmts.len() {
            let (last, next) = (&stmts[end - 1], &stmts[end]);
            // The number of a loop's first block, and the comment in it, stand before the loop.
            let head = matches!(next.op, Op::Control(_)) && last.span == next.span;
            if head && matches!(last.op, Op::Label(_) | Op::Comment(_)) {
                end += 1;
                continue;
            }
            let change = matches!((&last.op, &next.op), (Op::SelectTool(_), Op::ChangeTool));
            let joined = match self.tool_change {
                ToolChange::OneBlock if change => {
                    let free = next.number.is_none() || self.numbering != Numbering::Keep;
                    next.joined || free && last.skip == next.skip && last.comment.is_none()
                }
                ToolChange::TwoBlocks if change => false,
                ToolChange::Kept | ToolChange::OneBlock | ToolChange::TwoBlocks => next.joined,
            };
            if !joined {
                break;
            }
            end += 1;
        }
        end
    }

    /// Writes the statements of one block of the source.
    fn source_block(&mut self, stmts: &[Stmt], sink: &mut Sink) {
        let Some(first) = stmts.first() else { return };
        self.open_block(first);
        let (before, jump) = macros::computed_jump::found(stmts);
        for stmt in before {
            let before = self.open(stmt, sink);
            let written = match before {
                Ok(_) => self.statement(stmt, sink),
                Err(ref fault) => Err(fault.clone()),
            };
            self.close(stmt, before.ok(), written, sink);
        }
        if let (Some(jump), Some(first), Some(last)) = (jump, stmts.get(before.len()), stmts.last()) {
            let force = self.open(first, sink);
            let written = match force {
                Ok(_) => self.jump_to_number(&jump, first, sink),
                Err(ref fault) => Err(fault.clone()),
            };
            self.close(last, force.ok(), written, sink);
        }
        self.close_block(stmts, sink);
    }

    /// Reports, once each, the codes written of which no source confirms the meaning.
    fn tell_unsure(&mut self, span: Span, sink: &mut Sink) {
        while let Some(code) = self.block.unsure.pop() {
            if let Some(meaning) = code.unsure.filter(|_| !self.told_unsure.contains(&code)) {
                self.told_unsure.push(code);
                let text = String::from_utf8_lossy(code.text()).into();
                sink.report(Fault::AssumedRow { code: text, meaning: meaning.to_string().into() }, span);
            }
        }
    }

    /// Reports, once, that what is written rests on an option that nobody chose.
    pub(crate) fn rely(&mut self, option: &'static str, span: Span, sink: &mut Sink) {
        let open = self.dialect.option.iter().any(|o| o.name == option) && !self.settings.is_chosen(option);
        if open && !self.told_options.contains(&option) {
            self.told_options.push(option);
            let value = self.settings.get(option).into();
            sink.report(Fault::AssumedOption { option: option.into(), value }, span);
        }
    }

    pub(crate) fn comment(&mut self, text: &str, span: Span, sink: &mut Sink) {
        let block = &mut self.block;
        if self.comments.write(text, &mut block.comment, &mut block.after, self.eol) {
            sink.report(Fault::CommentReformatted, span);
        }
    }

    /// Forgets everything that is in force: after a call, at a procedure's start.
    pub(crate) fn forget(&mut self) {
        self.active = ActiveModes::default();
        self.held = None;
        self.residue = [0; AXES];
        self.residual = false;
        self.named = 0;
        self.lost = true;
        self.forgotten = true;
    }
}
