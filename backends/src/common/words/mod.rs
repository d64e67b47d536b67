//! A writer of words, letters with numbers, which writers hold that have them: the block at hand, what is active in
//! the text, where the axes are, and the statements that are stated by codes and addresses alone.
//!
//! ```text
//! STRAIGHT_FEED(X 10.5mm) & SET_FEED_RATE(100mm)    `G1 X10.5 F100.`
//! ```
//!
//! Not here: what the languages of controls say each in its own way: cycles, calls, jumps, arcs, lengths of tools.

mod arc;
mod blocks;
mod facts;
mod formula;
mod frames;
mod modes;
mod motion;
mod numbers;
mod plain;
mod spindle;
mod start;
mod statement;
mod thread;

use std::collections::BTreeMap;

use ncc_dialects::{Dialect, Role, Settings};
use ncc_ir::canon::{AXES, Modes, RotaryWay, Turn, Units};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num, Unit};
use ncc_ir::lack::ModesLack;
use ncc_ir::program::{Op, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

use facts::ProgramFacts;
use numbers::Numbers;
use spindle::Surfaces;
use start::Preamble;

use crate::common::Sink;
use crate::common::active_modes::ActiveModes;
use crate::common::block::{Block, Rank};
use crate::common::codes::{Code, Codes, ProbeCode};
use crate::common::comment::Comments;
use crate::common::fault::cannot;
use crate::origin::Trace;
use crate::{Form, Layout, Numbering, ToolChange};

pub(crate) use numbers::HIGHEST_NUMBER;
pub(crate) use plain::Behind;
pub(crate) use statement::rounded;

/// Writes blocks of words.
#[derive(Clone, Debug)]
pub(crate) struct Words {
    pub(crate) dialect: &'static Dialect,
    pub(crate) settings: Settings,
    /// Options that the user did not choose, that the text relies on, and that are reported already.
    told_options: Vec<&'static str>,
    /// Numbers of blocks.
    pub(crate) numbers: Numbers,
    pub(crate) eol: &'static [u8],
    pub(crate) codes: Codes,
    pub(crate) comments: Comments,
    pub(crate) block: Block,
    pub(crate) active: ActiveModes,
    pub(crate) tracker: Tracker,
    /// By how much rounding puts the written position after the program's: nanos of a millimetre or degree, by axis.
    pub(crate) residue: [Nanos; AXES],
    /// The direction in which A, B and C turn in the next move.
    pub(crate) ways: [Option<RotaryWay>; 3],
    /// Whether any residue is not zero.
    pub(crate) residual: bool,
    pub(crate) preamble: Option<Preamble>,
    /// Facts assumed that were known at the last piece.
    pub(crate) assumed: Modes,
    /// Whether facts of the program's start may have been changed unseen (a call, a skipped block).
    pub(crate) lost: bool,
    /// Whether a stretch of blocks begins.
    pub(crate) forgotten: bool,
    stated: Modes,
    /// Whether the source block at hand had to be split.
    pub(crate) split: bool,
    /// A length offset in the block at hand that needs a Z word beside it.
    pub(crate) offset_waits: Option<Span>,
    /// What the text has said of surface speeds and their limits.
    pub(crate) surfaces: Surfaces,
    /// The sense in which the spindle turned on the way into the thread at hand.
    pub(crate) turned_in: Option<Turn>,
    /// The next straight move is in machine coordinates, by this code.
    pub(crate) machine: Option<Code>,
    /// The next straight move at feed is a probing one, by this code.
    pub(crate) probe: Option<ProbeCode>,
    /// The next rapid straight move is one by a detour, by this code.
    pub(crate) detour: Option<Code>,
    /// The word of the corner after the next move.
    pub(crate) corner: Option<String>,
    /// What is known of the program as a whole.
    pub(crate) facts: ProgramFacts,
    /// Values of the control's own, by their numbers.
    pub(crate) own_values: Vec<(u32, Expr)>,
    /// Names of the variables of the procedure at hand, as they are spelt.
    pub(crate) variables: BTreeMap<Text, String>,
    /// Whether the words of the statement at hand say their own distance mode, where others rely on the active one.
    pub(crate) says_distance: bool,
    /// Units that the text states anywhere.
    pub(crate) units_stated: [bool; 2],
    /// A literal that relies on one unit being active throughout, and where.
    units_relied: Option<(Units, Span)>,
    /// Lines of plain moves that have not been passed on, and how many bytes they are.
    page: [u8; plain::PAGE],
    filled: usize,
    /// Codes whose meaning is not confirmed, as far as reported.
    told_unsure: Vec<Code>,
    /// Words of plain moves that the tracker does not know yet, and which axes they name.
    last_words: [Num; AXES],
    pub(crate) named: u8,
    /// Blocks of a tool change.
    tool_change: ToolChange,
    /// Where the lines come from, if somebody asked.
    pub(crate) trace: Option<Box<Trace>>,
}

impl Words {
    /// A writer at the start of a program.
    pub(crate) fn new(settings: Settings, layout: &Layout) -> Words {
        let dialect = settings.dialect;
        let rules = &dialect.block;
        Words {
            dialect,
            told_unsure: Vec::new(),
            told_options: Vec::new(),
            numbers: Numbers::new(rules, layout.numbering),
            eol: if layout.crlf { b"\r\n" } else { b"\n" },
            codes: Codes::new(&settings),
            settings,
            comments: Comments::new(&dialect.comment),
            block: Block::new(rules.blanks, rules.g_codes, rules.m_codes),
            active: ActiveModes::default(),
            tracker: Tracker::default(),
            residue: [0; AXES],
            ways: [None; 3],
            residual: false,
            preamble: (!dialect.safe_start.is_empty()).then(Preamble::default),
            assumed: Modes::default(),
            lost: false,
            forgotten: false,
            stated: Modes::default(),
            split: false,
            offset_waits: None,
            surfaces: Surfaces::default(),
            turned_in: None,
            machine: None,
            probe: None,
            detour: None,
            corner: None,
            facts: ProgramFacts::default(),
            own_values: Vec::new(),
            variables: BTreeMap::new(),
            says_distance: false,
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

    /// Takes a shop's choices for the form of the text.
    pub(crate) fn set_form(&mut self, form: Form) {
        self.tool_change = form.tool_change;
    }

    /// A tool change stands in no block with a move, nor with a length that needs one.
    pub(crate) fn changes_apart(&mut self) {
        let edges = self.dialect.address.iter().any(|row| row.role == Role::ToolEdge);
        let from = if edges { Rank::CycleEnd } else { Rank::Offset };
        self.block.apart = Some(from).filter(|_| !self.dialect.block.change_first);
    }

    /// Facts that the written text states by itself, in its safe start line.
    pub(crate) fn stated(&self) -> Modes {
        self.stated
    }

    /// Where the axes stand before the first statement, in program coordinates, as far as the user
    /// has said it.
    pub(crate) fn stand_at(&mut self, start: &[Option<Nanos>; AXES]) {
        self.tracker.position = *start;
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
                    let free = next.number.is_none() || self.numbers.numbering != Numbering::Keep;
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

    /// Reports, once each, the codes written of which no source confirms the meaning.
    pub(super) fn tell_unsure(&mut self, span: Span, sink: &mut Sink) {
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

    /// Forgets everything that is active: after a call, at a procedure's start.
    pub(crate) fn forget(&mut self) {
        self.active = ActiveModes::default();
        self.residue = [0; AXES];
        self.residual = false;
        self.named = 0;
        self.lost = true;
        self.forgotten = true;
    }

    /// A comment in a line of its own.
    pub(crate) fn comment_line(&self, text: &str, out: &mut Vec<u8>) {
        let (mut line, mut after) = (Vec::new(), Vec::new());
        self.comments.clone().write(text, &mut line, &mut after, self.eol);
        out.append(&mut line);
        out.extend_from_slice(self.eol);
        out.append(&mut after);
    }

    /// Writes the end marks, and tells what only the end of the text shows.
    pub(crate) fn finish(&mut self, sink: &mut Sink) {
        let frame = &self.dialect.program.frame;
        if !frame.is_empty() {
            sink.out.extend_from_slice(frame.as_bytes());
            sink.out.extend_from_slice(self.eol);
        }
        if let Some(trace) = &mut self.trace {
            trace.frame(sink.out);
        }
        if let Some(span) = self.numbers.first_left.take() {
            sink.report(Fault::NumbersLeftOut { count: self.numbers.left }, span);
        }
        if let Some((units, span)) = self.units_relied
            && self.units_stated[1 - units as usize]
        {
            sink.report(cannot(ModesLack::CallersUnit), span);
        }
    }
}
