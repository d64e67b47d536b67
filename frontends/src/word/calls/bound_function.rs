//! Custom functions that a program of the user processes (`[functions]` of the dictionary).
//!
//! ```text
//! G200 X10. Y5. R4.       one block, handed over by itself
//! G201 Z-5. / X0. / G202  a function with its end: handed over together
//! ```
//!
//! The statements of the answer have the spans of the blocks that were handed over. Not here: the files, and how a program is
//! started; whoever may start programs gives the dialect a host for that.

use ncc_dialects::{Dialect, FunctionCall, FunctionRow, GivenBlock, Role};
use ncc_ir::canon::{AXES, Axis, Distance, Fact, FeedMode, Plane, Units};
use ncc_ir::diag::{Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num, Unit};
use ncc_ir::program::Op;
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;
use ncc_ir::unsupported::FunctionUnsupported;

use super::function_state::OpenFunction;
use crate::batch::Batch;
use crate::common::Source;
use crate::common::known::Know;
use crate::common::words::{Value, Word, tenths};
use crate::word::lower::{Lower, Now};
use crate::word::text::block::Block;
use crate::word::word_state::{AxisWords, CycleState};

/// A word that begins or ends a function.
struct FunctionCode {
    name: &'static str,
    row: &'static FunctionRow,
    /// Whether it ends it.
    ends: bool,
    span: Span,
}

/// The modes at the call of a function.
struct Surroundings {
    units: Units,
    plane: Plane,
}

/// The word of a block that begins or ends a function.
fn function_code(block: &Block, dialect: &'static Dialect) -> Option<FunctionCode> {
    block.words.iter().find_map(|word| {
        let Value::Number(digits) = word.value else { return None };
        let number = tenths(digits).filter(|_| matches!(word.letter, b'G' | b'M'))?;
        let begun = dialect.function(word.letter, number).map(|(name, row)| (name, row, false));
        let found = begun
            .or_else(|| dialect.function_ended(word.letter, number).map(|(name, row)| (name, row, true)));
        found.map(|(name, row, ends)| FunctionCode { name, row, ends, span: word.span })
    })
}

/// Whether a block has something besides words that a function cannot have.
fn has_more(block: &Block) -> bool {
    block.statement.is_some()
        || !block.settings.is_empty()
        || block.decision.is_some()
        || !block.names.is_empty()
}

impl Lower {
    /// Lowers a block of a dialect with functions.
    pub(in crate::word) fn block_with_functions(&mut self, block: &Block, src: Source, out: &mut Batch) {
        self.follow(out);
        let dialect = self.settings.dialect;
        let code = function_code(block, dialect);
        let open = self.functions.as_mut().and_then(|state| state.open.take());
        match (open, code) {
            (None, None) => self.lowered(block, src, out),
            (None, Some(code)) => self.bound_function(&code, block, src, out),
            (Some(open), code) => self.function_goes_on(open, code.as_ref(), block, src, out),
        }
        self.follow(out);
    }

    /// Further lines are read: the statements before them may have been taken out.
    pub(in crate::word) fn functions_begin(&mut self, out: &mut Batch) {
        let len = if self.functions.is_some() { self.target(out).len() } else { 0 };
        if let Some(state) = &mut self.functions {
            state.seen = len;
        }
    }

    /// Follows the statements that have been added. Another program has its own state, which its callers decide; after the
    /// blocks of a loop or a branch nothing is known.
    pub(in crate::word) fn follow(&mut self, out: &mut Batch) {
        let Some(mut state) = self.functions.take() else { return };
        let program = self.sub.as_ref().map(|sub| sub.name.clone());
        let structured = !self.computes.loops.is_empty() || !self.o.open.is_empty();
        let stmts = self.target(out);
        if state.program != program {
            (state.program, state.tracker) = (program, Tracker::unknown());
        } else if let Some(further) = stmts.get(state.seen..) {
            further.iter().for_each(|stmt| state.tracker.step(stmt));
        } else {
            state.tracker.forget();
        }
        state.seen = stmts.len();
        if std::mem::replace(&mut state.structured, structured) || structured {
            state.tracker.forget();
        }
        self.functions = Some(state);
    }

    /// Begins a block with a function.
    fn begin_function_block(&mut self, block: &Block, src: Source, out: &mut Batch) {
        self.cycle_before(out);
        self.in_loop(out);
        self.o_body(out);
        self.now = Now::at(self.target(out).len());
        for (fault, span) in &block.faults {
            self.fault(fault.clone(), *span, out);
        }
        let number = self.settings.dialect.block.number.map_or(0, |c| c as u8);
        if let Some(word) = block.words.iter().find(|word| word.letter == number) {
            self.now.number = self.read_whole(word, src, out);
        }
    }

    /// A block with the code of a function, where none is open.
    fn bound_function(&mut self, code: &FunctionCode, block: &Block, src: Source, out: &mut Batch) {
        self.begin_function_block(block, src, out);
        self.jumped_to(block, out);
        if self.target(out).len() > self.now.mark {
            // The label has it.
            self.now.number = None;
        }
        self.follow(out);
        let open = self.opened(code, block, src, out);
        // The statements so far are followed.
        self.now.mark = self.target(out).len();
        match open {
            Some(mut open) if code.row.until.is_some() => {
                self.now.silent = true;
                self.close(block, src, out);
                open.failed = self.now.failed;
                if let Some(state) = &mut self.functions {
                    state.open = Some(open);
                }
            }
            Some(open) => {
                self.run_function(&open, out);
                self.close(block, src, out);
            }
            None => {
                self.now.failed = true;
                self.close(block, src, out);
                self.leave_open(code, block);
            }
        }
        self.refresh();
    }

    /// A function that was refused goes on up to its end, of which nothing more is reported.
    fn leave_open(&mut self, code: &FunctionCode, block: &Block) {
        if code.row.until.is_none() || code.ends {
            return;
        }
        let open = OpenFunction {
            name: code.name,
            row: code.row,
            code: code.span,
            number: None,
            blocks: Vec::new(),
            spans: vec![block.span],
            at: [0; AXES],
            failed: true,
        };
        if let Some(state) = &mut self.functions {
            state.open = Some(open);
        }
    }

    /// The function with its first block; `None` is refused.
    fn opened(
        &mut self,
        code: &FunctionCode,
        block: &Block,
        src: Source,
        out: &mut Batch,
    ) -> Option<OpenFunction> {
        if code.ends {
            let what = FunctionUnsupported::NotBegun { name: code.name.into() };
            return self.refuse(Fault::not_supported(src.text(code.span), what), code.span, out);
        }
        self.may_be_called(code, block, out)?;
        let at = self.function_position(block.span, out)?;
        let mut open = OpenFunction {
            name: code.name,
            row: code.row,
            code: code.span,
            number: self.now.number,
            blocks: Vec::new(),
            spans: Vec::new(),
            at,
            failed: false,
        };
        let name = if code.row.until.is_some() { "START_CYCLE" } else { code.name };
        self.give_block(&mut open, name, block, src, out)?;
        (!self.now.failed).then_some(open)
    }

    /// Refuses a function where its program cannot know what it has to.
    fn may_be_called(&mut self, code: &FunctionCode, block: &Block, out: &mut Batch) -> Option<()> {
        use FunctionUnsupported as No;
        let (tip, tilt) = (self.state.tip, self.state.modes.tilt);
        let tilted = self.tip.ends(tip) | self.tilt.ends(tilt);
        let state = &self.state;
        let tracker = self.functions.as_ref().map(|state| &state.tracker)?;
        let what = if block.skip != 0 {
            Some(No::Skipped)
        } else if has_more(block) {
            Some(No::BesideCodes)
        } else if !self.computes.loops.is_empty() || !self.o.open.is_empty() {
            Some(No::InStructure)
        } else if matches!(state.compensated, Know::Said(true) | Know::Lost) || tracker.compensated {
            Some(No::Compensated)
        } else if state.cycle != CycleState::None || tracker.cycle.is_some() || tracker.cycle_in_doubt {
            Some(No::InCycle)
        } else if tilted || tracker.tilted {
            Some(No::Tilted)
        } else if state.words != AxisWords::Cartesian {
            Some(No::Polar)
        } else if state.unplaced != 0 {
            Some(No::BeforePlaced)
        } else {
            None
        };
        if let Some(what) = what {
            return self.refuse(Fault::not_supported(code.name, what), code.span, out);
        }
        if self.within_modal(code.span, out) {
            self.now.failed = true;
            return None;
        }
        if self.level_open() {
            self.refuse_level(code.span, out);
            return None;
        }
        Some(())
    }

    /// The position of the tool at the call of a function.
    fn function_position(&mut self, at: Span, out: &mut Batch) -> Option<[Nanos; AXES]> {
        let known = self.functions.as_ref()?.tracker.position;
        let mut position = [0; AXES];
        for axis in Axis::ALL {
            let named = self.rotary_named >> (axis.letter() - b'A') & 1 == 1;
            match known[axis as usize] {
                Some(value) => position[axis as usize] = value,
                None if axis.is_rotary() && !named => {}
                None => {
                    let axis = char::from(axis.letter());
                    return self.refuse(Fault::PositionUnknown { axis }, at, out);
                }
            }
        }
        Some(position)
    }

    /// Adds a block to those that are handed over; `None` is refused.
    fn give_block(
        &mut self,
        open: &mut OpenFunction,
        name: &str,
        block: &Block,
        src: Source,
        out: &mut Batch,
    ) -> Option<()> {
        let mut parameters = Vec::new();
        let number = self.settings.dialect.block.number.map_or(0, |c| c as u8);
        let mut codes = 0;
        for word in &block.words {
            if word.letter == number {
                continue;
            }
            if matches!(word.letter, b'G' | b'M') {
                codes += 1;
                if codes > 1 || name == "HOLE" {
                    let what = FunctionUnsupported::BesideCodes;
                    return self.refuse(Fault::not_supported(open.name, what), word.span, out);
                }
                continue;
            }
            let value = self.parameter(word, open, src, out)?;
            let letter = char::from(word.letter).to_ascii_lowercase();
            if parameters.iter().any(|(other, _)| *other == letter) {
                let letter = char::from(word.letter);
                return self.refuse(Fault::WordTwice { letter }, word.span, out);
            }
            parameters.push((letter, value));
        }
        let tracker = &self.functions.as_ref()?.tracker;
        let inch = self.state.modes.units.value() == Some(Units::Inch);
        let of = |num: Option<Num>| num.and_then(|num| num.nanos(inch)).unwrap_or(0);
        let call = open.blocks.first().map(|first| first.position);
        open.blocks.push(GivenBlock {
            gcode: src.text(block.span).into(),
            function_name: name.to_owned(),
            position: call.unwrap_or(open.at),
            rotary: self.rotary_named != 0,
            cut_offset: tracker.modes.length_offset,
            feed: of(tracker.feed.filter(|_| !tracker.stale_feed)),
            speed: of(tracker.speed),
            tool: tracker.tool.unwrap_or(0).max(0),
            parameters,
        });
        open.spans.push(block.span);
        for (letter, value) in &open.blocks.last()?.parameters {
            if let Some(row) = self.axis_row_of(*letter as u8) {
                open.at[row as usize] = *value;
            }
        }
        Some(())
    }

    /// The axis of a letter, in lower case.
    fn axis_row_of(&self, letter: u8) -> Option<Axis> {
        Axis::from_letter(letter.to_ascii_uppercase()).filter(|axis| self.axis_row(*axis).is_some())
    }

    /// The value of a word of a function, in nanos.
    fn parameter(&mut self, word: &Word, open: &OpenFunction, src: Source, out: &mut Batch) -> Option<Nanos> {
        let digits = match word.value {
            Value::Number(digits) => digits,
            Value::Computed(_) => {
                let what = FunctionUnsupported::Computed;
                return self.refuse(Fault::not_supported(src.text(word.span), what), word.span, out);
            }
            Value::None => {
                let letter = char::from(word.letter);
                return self.refuse(Fault::WordWithoutNumber { letter }, word.span, out);
            }
        };
        if !word.letter.is_ascii_uppercase() {
            return self.refuse(Fault::WordUnused { word: src.text(word.span) }, word.span, out);
        }
        let row = self.letters[usize::from(word.letter - b'A')];
        let num = match row {
            Some(row) => self.number(word, row.quantity, src, out)?,
            None => {
                Num { mantissa: digits.mantissa, scale: digits.scale, point: digits.point, unit: Unit::One }
            }
        };
        let inch = self.state.modes.units.value() == Some(Units::Inch);
        let wrong = |word: &Word| Fault::OutOfRange { word: src.text(word.span).into() };
        let Some(value) = num.nanos(inch) else { return self.refuse(wrong(word), word.span, out) };
        let Some(axis) = row.filter(|row| row.role == Role::Axis).and_then(|_| self.axis_row_of(word.letter))
        else {
            return Some(value);
        };
        if axis.is_rotary() {
            self.rotary_named |= 1 << (word.letter - b'A');
        }
        match self.distance(word.span, out) {
            Fact::Known(Distance::Absolute) => Some(value),
            Fact::Known(Distance::Incremental) => match open.at[axis as usize].checked_add(value) {
                Some(value) => Some(value),
                None => self.refuse(wrong(word), word.span, out),
            },
            Fact::Entry => self.refuse(Fault::EntryFactNeeded { fact: ModeName::Distance }, word.span, out),
        }
    }

    /// A block while a function waits for its end.
    fn function_goes_on(
        &mut self,
        mut open: OpenFunction,
        code: Option<&FunctionCode>,
        block: &Block,
        src: Source,
        out: &mut Batch,
    ) {
        self.begin_function_block(block, src, out);
        let ends = code.is_some_and(|code| code.ends && code.name == open.name);
        let name = if ends { "END_CYCLE" } else { "HOLE" };
        if !block.is_comment() && !open.failed {
            self.check_inside(&open, block, out);
            if !self.now.failed && self.give_block(&mut open, name, block, src, out).is_none() {
                self.now.failed = true;
            }
        }
        open.failed |= self.now.failed;
        // Of what follows in a function that was refused, nothing is known.
        self.now.failed = open.failed;
        self.now.number = open.number.take();
        self.now.silent = true;
        if ends && !open.failed {
            self.run_function(&open, out);
        } else {
            open.number = self.now.number.take();
        }
        self.close(block, src, out);
        if !ends && let Some(state) = &mut self.functions {
            state.open = Some(open);
        }
        self.refresh();
    }

    /// Refuses blocks that cannot be among those of a function.
    fn check_inside(&mut self, open: &OpenFunction, block: &Block, out: &mut Batch) {
        let named = self
            .now
            .number
            .filter(|_| self.computes.jumps)
            .is_some_and(|number| !self.computes.passes(number));
        let what = if block.skip != 0 {
            FunctionUnsupported::Skipped
        } else if has_more(block) {
            FunctionUnsupported::BesideCodes
        } else if named {
            FunctionUnsupported::JumpTarget
        } else {
            return;
        };
        self.fault(Fault::not_supported(open.name, what), block.span, out);
    }

    /// The modes at the call of a function; `None` is refused.
    fn surroundings(&mut self, open: &OpenFunction, out: &mut Batch) -> Option<Surroundings> {
        let needed = |fact| Fault::EntryFactNeeded { fact };
        let Fact::Known(units) = self.units(open.code, out) else {
            return self.refuse(needed(ModeName::Units), open.code, out);
        };
        let Fact::Known(plane) = self.plane(open.code, out) else {
            return self.refuse(needed(ModeName::Plane), open.code, out);
        };
        self.rely_on_frames(true, open.code, out);
        self.rely_on_feed_mode(open.code, out);
        if self.state.modes.feed_mode.value() != Some(FeedMode::PerMinute) {
            let fault = Fault::not_supported(open.name, FunctionUnsupported::FeedMode);
            return self.refuse(fault, open.code, out);
        }
        Some(Surroundings { units, plane })
    }

    /// Has the program of a function process its blocks, and adds the statements of the answer.
    fn run_function(&mut self, open: &OpenFunction, out: &mut Batch) {
        let Some(Surroundings { units, plane }) = self.surroundings(open, out) else {
            self.now.failed = true;
            return;
        };
        debug_assert_eq!(open.blocks.len(), open.spans.len());
        let (name, row) = (open.name, open.row);
        let Some(host) = &self.settings.dialect.function_host else {
            let fault = Fault::FunctionNotRun { name: name.into(), program: row.program().into() };
            return self.fault(fault, open.code, out);
        };
        let answer = match host.run(&FunctionCall { name, row, units, plane, blocks: &open.blocks }) {
            Ok(answer) => answer,
            Err((why, said)) => {
                let program = row.program().into();
                let fault = Fault::FunctionFailed { name: name.into(), program, why, said };
                return self.fault(fault, open.code, out);
            }
        };
        let (assume, main) = (self.assume, self.sub.is_none());
        if let Some(state) = &mut self.functions {
            if assume && state.reported.insert(name) {
                let program = row.program().into();
                out.report(Fault::AssumedFunction { name: name.into(), program }, open.code);
            }
            if main {
                state.first.get_or_insert((name, open.code));
            }
        }
        self.leave_motion(None, out);
        for (place, (from, ops)) in answer.blocks.into_iter().enumerate() {
            if place > 0 {
                self.end_block_here();
            }
            let span = open.spans.get(from).copied().unwrap_or(open.code);
            for op in ops {
                self.after_function(&op);
                self.push(span, op, out);
            }
        }
    }

    /// The state after a statement of an answer.
    fn after_function(&mut self, op: &Op) {
        let to = match op {
            Op::StraightTraverse(to) | Op::StraightFeed(to) => &to.to,
            Op::ArcFeed(arc) => &arc.to,
            Op::SetFeedRate(Expr::Num(_)) => {
                self.state.modes.feed = Know::Said(());
                self.state.cycle_feed = None;
                return;
            }
            _ => return,
        };
        self.state.level_open &= to.get(Axis::Z).is_none();
        // Bare axis words after it would do something that the text does not say.
        (self.state.modes.motion, self.state.no_motion) = (Know::Unsaid, true);
        (self.state.thread, self.state.lead, self.state.after_cycle) = (None, None, false);
    }

    /// The program is over: a function that waits for its end has none.
    pub(in crate::word) fn open_functions(&mut self, out: &mut Batch) {
        let Some(open) = self.functions.as_mut().and_then(|state| state.open.take()) else { return };
        if !open.failed {
            let until = open.row.until.as_deref().unwrap_or_default().into();
            let fault = Fault::not_supported(open.name, FunctionUnsupported::NotEnded { until });
            self.fault(fault, open.code, out);
        }
    }

    /// The text is over. Blocks that are called by their numbers begin elsewhere than those before them end.
    pub(in crate::word) fn settle_functions(&mut self, out: &mut Batch) {
        let first = self.functions.as_ref().and_then(|state| state.first);
        if let Some((name, at)) = first.filter(|_| !self.computes.local_calls.is_empty()) {
            out.report(Fault::not_supported(name, FunctionUnsupported::InCalledBlocks), at);
        }
    }
}
