//! Lowers a block: from words to statements.
//!
//! The dictionary alone decides the meaning of a code or letter. A faulty block gives
//! diagnostics and no statements. Its modes still count, so that one slip is not
//! reported again at every later block.
//!
//! Not here: the role of each word (`sort`), and the functions, moves, cycles, patterns and calls
//! of a block; they have files of their own in this folder.

mod fast_block;
mod message;

use ncc_dialects::{
    Address, Bare, CALCULATOR, CodeRow, DECIMAL_POINT, INTEGER_FEED, NumberRules, Quantity, Role, Settings,
};
use ncc_ir::canon::{Axis, Distance, FeedMode, Units};
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::Num;
use ncc_ir::program::{Op, Procedure, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::unsupported::{CodeUnsupported, Unsupported};

use super::block_words::{Code, Roles, UsualBlocks, Words};
use super::text::block::Block;
use super::text_facts::{
    CentreSeen, CyclesMet, Dwells, MainEnding, MotionWithoutMove, RadiusNamed, Reported, ToolsNamed,
};
use super::word_state::{CycleState, WordState};
use crate::batch::{Batch, refused};
use crate::common::Source;
use crate::common::fast_lower::FastLower;
use crate::common::known::Know;
use crate::common::only_value::OnlyValue;
use crate::common::switched::Met;
use crate::common::text::{begins, decode};
use crate::initial_modes::Inherited;
use crate::word::calls::function_state::FunctionState;
use crate::word::macros::computes::Computes;
use crate::word::o_code::o_state::OWordState;

/// Lowers the blocks of one text, one after the other.
#[derive(Debug)]
pub(super) struct Lower {
    pub(super) settings: Settings,
    /// Whether modes that the program never sets are assumed and reported.
    pub(super) assume: bool,
    /// Modes that are active where subprograms start.
    pub(super) inherited: Inherited,
    /// Whether refused blocks and numbers without a point are noted.
    pub(super) watch: bool,
    /// Number rules by quantity.
    pub(super) rules: [NumberRules; 8],
    /// Whether a number without a point counts whole units, where the dictionary says increments.
    pub(super) calculator: bool,
    /// Whether that holds for seconds too: not if the dictionary's option has no such value, because then the
    /// point of a dwell is a rule of the control.
    pub(super) calculator_seconds: bool,
    /// Rows of the address letters.
    pub(super) letters: [Option<&'static Address>; 26],
    pub(super) roles: Roles,
    pub(super) state: WordState,
    /// The units that the text sets, for numbers whose unit is open.
    pub(super) only_units: OnlyValue<Units>,
    pub(super) centre_seen: CentreSeen,
    pub(super) reported: Reported,
    pub(super) dwells: Dwells,
    /// Whether the surface speeds of the text have limits of their own.
    pub(super) limits: Option<bool>,
    /// The subprogram that is being read; `None` in the main program.
    pub(super) sub: Option<Procedure>,
    /// Whether this program has ended.
    pub(super) ended: bool,
    pub(super) computes: Computes,
    pub(super) main_ending: MainEnding,
    pub(super) o: OWordState,
    pub(super) motion_without_move: MotionWithoutMove,
    pub(super) cycles: CyclesMet,
    /// Tables for plain moves; `None` if a block needs the general path.
    pub(super) fast_lower: Option<FastLower>,
    pub(super) usual: UsualBlocks,
    pub(super) now: Now,
    codes: Vec<Code>,
    /// Tool centre point control and tilted planes, as the text sets them.
    pub(super) tip: Met,
    pub(super) tilt: Met,
    pub(super) tools: ToolsNamed,
    pub(super) radius: RadiusNamed,
    /// Letters of rotary axes that the text has named so far, a bit each.
    pub(super) rotary_named: u32,
    /// For custom functions of the user's programs, of a dialect that has some.
    pub(super) functions: Option<Box<FunctionState>>,
}

/// State of the block that is lowered.
#[derive(Debug, Default)]
pub(super) struct Now {
    pub(super) number: Option<u32>,
    /// Skip level of the next statements.
    pub(super) skip: Option<u8>,
    /// Skip level of the last statement.
    last_skip: Option<u8>,
    pushed: bool,
    /// Whether something was refused.
    pub(super) failed: bool,
    /// Whether a code was refused, so that the meaning of the words is unknown.
    pub(super) refused: bool,
    /// Whether a cycle code was refused, so that the meaning of the next blocks is unknown.
    pub(super) cycle_refused: bool,
    /// Whether the code that cancels the cycle was lowered.
    pub(super) cycle_ended: bool,
    /// Length of the output before the block.
    pub(super) mark: usize,
    /// Whether the block has a feed word.
    pub(super) fed: bool,
    /// Feed of a cycle's own block.
    pub(super) feed: Option<Num>,
    /// The angle at which the block stops the spindle.
    pub(super) angle: Option<Num>,
    /// Whether the active cycle must be called again with other data.
    pub(super) recall: bool,
    /// Whether the last comment is a message.
    pub(super) message: bool,
    /// Whether its comment needs a statement of its own.
    pub(super) commented: bool,
    /// Whether a code has no statement of its own.
    pub(super) silent: bool,
    /// The corner word after a comma, until a move takes it.
    pub(super) corner: Option<crate::common::words::Word>,
    /// Polar radius and angle of the end point in signs of their own, until a move takes them.
    pub(super) polar: [Option<crate::common::words::Word>; 2],
    /// A program name, until a call takes it.
    pub(super) name: Option<(Text, Span)>,
    /// The repeat count of the block.
    pub(super) repetition: Option<crate::word::calls::repetition::Repetition>,
    /// The reference of the words of a return, if it is not the distance mode after the block.
    pub(super) return_distance: Option<Distance>,
}

/// Characters of a line that count, if blanks and comments do not.
fn bare_length(line: &[u8]) -> usize {
    let mut remark = false;
    let counts = |byte: &&u8| {
        remark |= **byte == b'(';
        let counts = !remark && !byte.is_ascii_whitespace();
        remark &= **byte != b')';
        counts
    };
    line.iter().take_while(|byte| **byte != b';').filter(counts).count()
}

impl Now {
    /// The state of a block with this many statements before it.
    pub(super) fn at(mark: usize) -> Now {
        Now { mark, ..Now::default() }
    }
}

impl Lower {
    pub(super) fn new(settings: Settings, assume: bool) -> Lower {
        let dialect = settings.dialect;
        let rules = [
            Quantity::Length,
            Quantity::Angle,
            Quantity::Feed,
            Quantity::Speed,
            Quantity::Seconds,
            Quantity::Milliseconds,
            Quantity::Integer,
            Quantity::Factor,
        ];
        let mut table = [NumberRules::default(); 8];
        for quantity in rules {
            table[quantity as usize] = dialect.numbers(quantity);
        }
        if settings.get(DECIMAL_POINT) == INTEGER_FEED {
            table[Quantity::Feed as usize].bare = Bare::Units;
        }
        let roles = Roles::new(dialect);
        let usual = UsualBlocks::new(&settings, &roles, &table);
        let mut lower = Lower {
            calculator: settings.get(DECIMAL_POINT) == CALCULATOR,
            calculator_seconds: settings.takes(DECIMAL_POINT, CALCULATOR),
            rules: table,
            letters: std::array::from_fn(|i| dialect.address_row(b'A' + i as u8)),
            roles,
            dwells: Dwells::default(),
            limits: None,
            reported: Reported { codes: vec![false; dialect.code.len()], ..Reported::default() },
            settings,
            assume,
            inherited: Inherited::default(),
            watch: false,
            state: WordState::default(),
            only_units: OnlyValue::default(),
            centre_seen: CentreSeen::default(),
            sub: None,
            ended: false,
            computes: Computes::default(),
            main_ending: MainEnding::default(),
            o: OWordState::default(),
            motion_without_move: MotionWithoutMove::default(),
            cycles: CyclesMet::default(),
            fast_lower: None,
            usual,
            now: Now::default(),
            codes: Vec::new(),
            tip: Met::default(),
            tilt: Met::default(),
            tools: ToolsNamed::default(),
            radius: RadiusNamed::default(),
            rotary_named: 0,
            functions: (!dialect.functions.is_empty()).then(Box::default),
        };
        lower.refresh();
        lower
    }

    /// Lowers a block.
    pub(super) fn block(&mut self, block: &Block, src: Source, out: &mut Batch) {
        match self.functions {
            None => self.lowered(block, src, out),
            Some(_) => self.block_with_functions(block, src, out),
        }
    }

    /// Lowers a block that is none of a function of the user's.
    pub(super) fn lowered(&mut self, block: &Block, src: Source, out: &mut Batch) {
        self.cycle_before(out);
        self.in_loop(out);
        self.o_body(out);
        if block.skip != 0 && block.tail.is_none() {
            // A word with block skip in its place is not active if it is skipped.
            self.leave_motion(None, out);
        }
        let before = (block.skip != 0).then(|| self.state.clone());
        let level = (block.skip != 0).then_some(block.skip);
        self.now = Now {
            skip: if block.tail.is_some() { None } else { level },
            mark: self.target(out).len(),
            failed: !block.faults.is_empty(),
            refused: !block.faults.is_empty(),
            name: block.names.first().map(|&span| (src.text(span), span)),
            ..Now::default()
        };
        if self.state.modes.feed_mode.value() == Some(FeedMode::InverseTime) {
            // An inverse-time feed belongs to the move of its own block.
            self.state.modes.feed = Know::Unsaid;
        }
        for (fault, span) in &block.faults {
            out.report(fault.clone(), *span);
        }
        let limit = self.settings.dialect.block.longest_bare;
        if limit > 0 && bare_length(src.bytes(block.span)) > limit as usize {
            self.fault(Fault::BlockTooLong { limit }, block.span, out);
        }
        if block.skip != 0 {
            self.check_skip(block, out);
        }
        let mut codes = std::mem::take(&mut self.codes);
        codes.clear();
        let mut words = Words { all: &block.words, exprs: &block.exprs, at: [0; 26], left: 0 };
        // A block with another form is not lowered here.
        let left_out = !self.now.refused && self.leaves_coded_call_out(block, out);
        let called = self.macro_code(block).filter(|_| !self.now.refused && !left_out);
        let by_words = if called.is_none() && !self.now.refused && !left_out {
            self.by_words(block, src, out)
        } else {
            None
        };
        if left_out {
            // All its words are arguments.
        } else if let Some(code) = &called {
            self.macro_call(code, block, src, out);
        } else if let Some(code) = &by_words {
            self.words_call(code, block, src, out);
        } else if !self.now.refused {
            self.sort_words(block, &mut codes, &mut words, src, out);
            self.check_tail(block, &codes, out);
            self.refused_under_compensation(&codes, out);
        }
        if called.is_some() || by_words.is_some() || left_out {
            // The block contains nothing else.
        } else if !self.now.refused {
            self.jumped_to(block, out);
            self.o_comment(block, src, out);
            self.settings(block, false, out);
            self.message(block, src, out);
            self.computed_codes(block, &codes, src, out);
            if let Some(statement) = &block.statement {
                self.statement(statement, block, src, out);
            } else if let Some(decision) = &block.decision {
                self.decide_flow(decision, block, out);
                words.left = 0;
            } else if !self.repetition(block, &codes, &mut words, src, out) {
                self.functions(block, &codes, &mut words, level, src, out);
            }
            self.settings(block, true, out);
            self.call_at_moves(block, src, out);
            self.asked_in_time(block, out);
            if !self.now.failed {
                self.check_unused(&words, src, out);
            }
            if let Some((name, span)) = self.now.name.take().filter(|_| !self.now.failed) {
                self.fault(Fault::WordUnused { word: name }, span, out);
            }
        } else {
            if let Some(statement) = &block.statement {
                self.statement(statement, block, src, out);
            }
            // Its modes still count.
            for code in &codes {
                self.set_mode(code.meaning, out);
            }
        }
        self.codes = codes;
        self.tool_block_over();
        self.close(block, src, out);
        if let (Some(before), None) = (before, block.tail) {
            if self.state.modes.motion != before.modes.motion {
                self.leave_motion(self.now.skip, out);
            }
            self.state.join(&before);
        }
        self.refresh();
    }

    fn check_skip(&mut self, block: &Block, out: &mut Batch) {
        let rules = &self.settings.dialect.block;
        if rules.skip_levels == 0 {
            let code = rules.skip.as_str().into();
            let what = CodeUnsupported::NoSkipSwitch.into();
            self.fault(Fault::NotSupported { code, what }, block.span, out);
        } else if block.skip > rules.skip_levels {
            let code = format!("/{}", block.skip).into();
            self.fault(
                Fault::NotSupported { code, what: CodeUnsupported::SkipLevel.into() },
                block.span,
                out,
            );
        }
        if self.assume && rules.skip_unsure && !std::mem::replace(&mut self.reported.skip, true) {
            let (code, meaning) = (rules.skip.as_str().into(), "block skip".into());
            out.report(Fault::AssumedRow { code, meaning }, block.span);
        }
    }

    /// Reports once that a row is not confirmed by a manual.
    pub(super) fn assume_row(&mut self, row: &'static CodeRow, meaning: &str, at: Span, out: &mut Batch) {
        if self.assume && self.first_time(row) {
            out.report(Fault::AssumedRow { code: row.code.as_str().into(), meaning: meaning.into() }, at);
        }
    }

    /// Whether this row is reported for the first time.
    pub(super) fn first_time(&mut self, row: &'static CodeRow) -> bool {
        let rows = &self.settings.dialect.code;
        let place = rows.iter().position(|r| std::ptr::eq(r, row));
        match place.and_then(|p| self.reported.codes.get_mut(p)) {
            Some(reported) => !std::mem::replace(reported, true),
            None => false,
        }
    }

    /// The value of an option that decides here; reported once if the user did not choose it.
    pub(super) fn option(&mut self, name: &'static str, at: Span, out: &mut Batch) -> &str {
        let place = self.settings.dialect.option.iter().position(|o| o.name == name);
        if let Some(place) = place {
            let reported = self.reported.options >> (place & 31) & 1 == 1;
            if self.assume && !reported && !self.settings.is_chosen(name) {
                self.reported.options |= 1 << (place & 31);
                let value = self.settings.get(name).into();
                out.report(Fault::AssumedOption { option: name.into(), value }, at);
            }
        }
        self.settings.get(name)
    }

    /// Whether nothing more is reported of this option.
    pub(super) fn option_is_told(&self, name: &str) -> bool {
        let place = self.settings.dialect.option.iter().position(|o| o.name == name);
        let reported = place.is_none_or(|place| self.reported.options >> (place & 31) & 1 == 1);
        !self.assume || reported || self.settings.is_chosen(name)
    }

    fn check_unused(&mut self, words: &Words, src: Source, out: &mut Batch) {
        self.check_corner(src, out);
        self.check_polar_signs(src, out);
        let mut left = words.left;
        while left != 0 {
            let place = left.trailing_zeros() as usize;
            left &= left - 1;
            let word = words.all[usize::from(words.at[place]) - 1];
            // Some words have a function of their own, which ncc knows and does not translate.
            let refused = self.letters[place].and_then(|row| row.refuse.as_deref());
            let fault = match refused {
                Some(name) => Fault::not_supported(src.text(word.span), Unsupported::named(name)),
                None => Fault::WordUnused { word: src.text(word.span) },
            };
            self.fault(fault, word.span, out);
        }
    }

    /// The list of the statements.
    #[inline]
    pub(super) fn target<'o>(&'o mut self, out: &'o mut Batch) -> &'o mut Vec<Stmt> {
        out.body(&mut self.sub)
    }

    /// Adds a statement to the block.
    #[inline]
    pub(super) fn push(&mut self, span: Span, op: Op, out: &mut Batch) {
        if self.has_motion_without_move() {
            self.moved(&op);
        }
        if let Op::Call(call) = &op {
            let name = (*call.name != *crate::word::macros::computes::COMPUTED).then(|| call.name.clone());
            self.inherited.call(name, self.state.unsaid());
        }
        let now = &mut self.now;
        let joined = now.pushed && now.last_skip == now.skip;
        let number = if now.pushed { None } else { now.number };
        now.pushed = true;
        now.last_skip = now.skip;
        let skip = now.skip;
        if self.state.follows_polar
            && ncc_ir::geometry::polar::leaves_points(&op, Some(ncc_ir::canon::Plane::Xy))
        {
            self.state.follows_polar = false;
        }
        self.target(out).push(Stmt { span, number, skip, joined, comment: None, op });
    }

    /// Ends a block before this point, as if the next words were in another block; a label holds the number.
    pub(super) fn end_block_here(&mut self) {
        self.now.pushed = false;
        self.now.silent = true;
        self.now.number = None;
    }

    /// From here on, statements belong to a block of their own.
    pub(super) fn separate(&mut self, out: &mut Batch) {
        if let Some(stmt) = self.target(out).last_mut() {
            stmt.joined = false;
        }
    }

    /// Reports a fault that refuses the block.
    pub(super) fn fault(&mut self, fault: Fault, span: Span, out: &mut Batch) {
        self.now.failed = true;
        out.report(fault, span);
    }

    /// The same, for a value that is then missing.
    pub(super) fn refuse<T>(&mut self, fault: Fault, span: Span, out: &mut Batch) -> Option<T> {
        self.fault(fault, span, out);
        None
    }

    /// The comments of a block that do nothing.
    pub(super) fn plain_comment(&self, block: &Block, src: Source) -> Option<Text> {
        let last = usize::from(self.now.message || self.acts(block, src));
        join_comments(&block.comments[..block.comments.len().saturating_sub(last)], src)
    }

    /// Whether the last comment of a block does something.
    fn acts(&self, block: &Block, src: Source) -> bool {
        let rules = &self.settings.dialect.comment;
        let words = rules.shown.iter().chain([&rules.message, &rules.alarm]);
        let Some(&last) = block.comments.last() else { return false };
        let bracketed = src.bytes(Span::new(last.end, last.end + 1)) == rules.close.as_bytes();
        bracketed && words.filter(|word| !word.is_empty()).any(|word| begins(src.bytes(last), word).is_some())
    }

    /// Ends the block: its comment, or the statement of an empty block.
    pub(super) fn close(&mut self, block: &Block, src: Source, out: &mut Batch) {
        if self.now.failed {
            let mark = self.now.mark;
            self.target(out).truncate(mark);
            if self.watch {
                self.target(out).push(refused(block.span));
            }
            self.forgive();
            return;
        }
        let comment = self.plain_comment(block, src).filter(|_| !self.now.commented);
        match (comment, self.now.pushed) {
            (None, true) => {}
            (None, false) if self.now.silent => {}
            (None, false) => self.push(block.span, Op::Blank, out),
            (Some(text), false) => self.push(block.span, Op::Comment(text), out),
            (Some(text), true) => {
                if let Some(stmt) = self.target(out).last_mut() {
                    stmt.comment = Some(Box::new(text));
                }
            }
        }
    }

    /// After a refused block, its modes are not reported as missing.
    pub(super) fn forgive(&mut self) {
        self.state.modes.forgive();
        if self.now.cycle_refused {
            self.state.cycle = CycleState::Lost;
        }
    }

    /// The axes' rows: letters that are coordinates.
    pub(super) fn axis_row(&self, axis: Axis) -> Option<&'static Address> {
        self.letters[usize::from(axis.letter() - b'A')].filter(|row| row.role == Role::Axis)
    }
}

/// Comments of one block as one text.
fn join_comments(comments: &[Span], src: Source) -> Option<Text> {
    match comments {
        [] => None,
        [one] => Some(decode(src.bytes(*one))),
        many => {
            let texts: Vec<Text> = many.iter().map(|&c| decode(src.bytes(c))).collect();
            Some(texts.join(" ").into())
        }
    }
}
