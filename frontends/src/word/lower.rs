//! Lowering of a block: from words to statements, in the order in which a block's functions happen.
//!
//! What a code or letter means comes from the dictionary alone. A block with a fault gives
//! diagnostics and no statements; what it says of modes still counts, so that one slip is not
//! reported again at every block after it.
//!
//! Moves, cycles and calls have files of their own beside this one.

use ncc_dialects::{Address, CodeRow, Dialect, Meaning, NumberRules, Quantity, Role, Settings};
use ncc_ir::canon::{Axis, Motion};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::num::Num;
use ncc_ir::program::{FrameSlot, Op, Procedure, Stmt, Text};
use ncc_ir::source::Span;

use super::Source;
use super::block::{Block, Value, Word};
use super::facts::{InForce, Know, State};
use super::fast::Fast;
use super::number::UnitsSeen;
use crate::Batch;

/// Lowers the blocks of one text, one after the other.
#[derive(Debug)]
pub(super) struct Lower {
    pub(super) settings: Settings,
    /// Whether what the program never says is taken for granted and reported.
    pub(super) assume: bool,
    /// Number rules by quantity.
    pub(super) rules: [NumberRules; 7],
    /// Whether a number without a point counts whole units where the dictionary says increments.
    pub(super) calculator: bool,
    /// Rows of the address letters.
    pub(super) letters: [Option<&'static Address>; 26],
    pub(super) roles: Roles,
    pub(super) state: State,
    pub(super) units_seen: UnitsSeen,
    pub(super) reported: Reported,
    /// The subprogram that is being read; `None` in the main program.
    pub(super) sub: Option<Procedure>,
    /// Whether the program that is being read has ended.
    pub(super) ended: bool,
    /// What plain moves need; `None` if a block must be looked at.
    pub(super) fast: Option<Fast>,
    pub(super) now: Now,
    codes: Vec<Code>,
}

/// Letters by role; 0 where the dialect has none.
#[derive(Clone, Copy, Debug)]
pub(super) struct Roles {
    pub(super) feed: u8,
    speed: u8,
    tool: u8,
    length_entry: u8,
    corrector: u8,
    pub(super) radius: u8,
    pub(super) centre: [u8; 3],
    /// Letters of axes, a bit each.
    pub(super) axes: u32,
}

impl Roles {
    fn new(dialect: &Dialect) -> Roles {
        let letter = |role| dialect.letter_for(role).map_or(0, |c| c as u8);
        let axes = dialect.address.iter().filter(|row| row.role == Role::Axis);
        Roles {
            feed: letter(Role::Feed),
            speed: letter(Role::Speed),
            tool: letter(Role::Tool),
            length_entry: letter(Role::LengthEntry),
            corrector: letter(Role::Corrector),
            radius: letter(Role::Radius),
            centre: [letter(Role::CentreX), letter(Role::CentreY), letter(Role::CentreZ)],
            axes: axes.fold(0, |bits, row| bits | 1 << (row.letter as u8).saturating_sub(b'A')),
        }
    }
}

/// What has been reported and is not to be reported again.
#[derive(Debug, Default)]
pub(super) struct Reported {
    /// Quantities of numbers without a point, a bit each.
    pub(super) bare: u8,
    pub(super) after_cycle: bool,
    pub(super) offset_with_z: bool,
    pub(super) skip: bool,
    /// Rows of codes.
    codes: Vec<bool>,
    /// Address letters, a bit each.
    letters: u32,
    /// Options of the dictionary, by place.
    options: u32,
}

/// State of the block that is being lowered.
#[derive(Debug, Default)]
pub(super) struct Now {
    number: Option<u32>,
    /// Skip level of the statements that are pushed.
    pub(super) skip: Option<u8>,
    /// Skip level of the last statement.
    last_skip: Option<u8>,
    pushed: bool,
    /// Whether something was refused.
    pub(super) failed: bool,
    /// Whether a code was refused, so that it is not known what the words belong to.
    refused: bool,
    /// Whether a code of a cycle was refused, so that it is not known what the next blocks mean.
    cycle_refused: bool,
    /// Length of the target before the block.
    mark: usize,
    /// Feed of a cycle's own block.
    pub(super) feed: Option<Num>,
    /// Whether the cycle in force must be called up again with other data.
    pub(super) recall: bool,
}

/// A G or M code of a block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Code {
    pub(super) row: &'static CodeRow,
    pub(super) meaning: Meaning,
    pub(super) span: Span,
    /// Index of its word.
    pub(super) at: usize,
}

/// The words of a block that are no codes, each to be used once.
#[derive(Debug)]
pub(super) struct Words<'b> {
    all: &'b [Word],
    /// Index plus one, by letter.
    at: [u16; 26],
    /// Letters that are still to be used, a bit each.
    left: u32,
}

impl Words<'_> {
    /// The word of a letter, which is then used.
    #[inline]
    pub(super) fn take(&mut self, letter: u8) -> Option<Word> {
        let word = self.get(letter)?;
        self.left &= !(1 << (letter - b'A'));
        Some(word)
    }

    /// Whether any of these letters (a bit each) is still to be used.
    #[inline]
    pub(super) fn has_any(&self, letters: u32) -> bool {
        self.left & letters != 0
    }

    /// The word of a letter, if it is still to be used.
    #[inline]
    pub(super) fn get(&self, letter: u8) -> Option<Word> {
        let place = usize::from(letter.wrapping_sub(b'A'));
        if place >= 26 || self.left >> place & 1 == 0 {
            return None;
        }
        Some(self.all[usize::from(self.at[place]) - 1])
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
        ];
        let mut table = [NumberRules::default(); 7];
        for quantity in rules {
            table[quantity as usize] = dialect.numbers(quantity);
        }
        let mut lower = Lower {
            calculator: settings.get("decimal_point") == "calculator",
            rules: table,
            letters: std::array::from_fn(|i| dialect.address_row(b'A' + i as u8)),
            roles: Roles::new(dialect),
            reported: Reported { codes: vec![false; dialect.code.len()], ..Reported::default() },
            settings,
            assume,
            state: State::default(),
            units_seen: UnitsSeen::default(),
            sub: None,
            ended: false,
            fast: None,
            now: Now::default(),
            codes: Vec::new(),
        };
        lower.refresh();
        lower
    }

    /// Lowers a block.
    pub(super) fn block(&mut self, block: &Block, src: Source, out: &mut Batch) {
        let before = (block.skip != 0).then(|| self.state.clone());
        let level = (block.skip != 0).then_some(block.skip);
        self.now = Now {
            skip: if block.tail.is_some() { None } else { level },
            mark: self.target(out).len(),
            failed: !block.faults.is_empty(),
            refused: !block.faults.is_empty(),
            ..Now::default()
        };
        for (fault, span) in &block.faults {
            out.report(fault.clone(), *span);
        }
        if block.skip != 0 {
            self.check_skip(block, out);
        }
        let mut codes = std::mem::take(&mut self.codes);
        codes.clear();
        let mut words = Words { all: &block.words, at: [0; 26], left: 0 };
        // A block that is none by its form is not asked for its meaning.
        if !self.now.refused {
            self.sort_words(block, &mut codes, &mut words, src, out);
            self.check_tail(block, &codes, out);
        }
        if !self.now.refused {
            self.functions(block, &codes, &mut words, level, src, out);
            if !self.now.failed {
                self.check_unused(&words, src, out);
            }
        } else {
            // The modes that it says still count.
            for code in &codes {
                self.set_mode(code.meaning, out);
            }
        }
        self.codes = codes;
        self.close(block, src, out);
        if let (Some(before), None) = (before, block.tail) {
            self.state.join(&before);
        }
        self.refresh();
    }

    fn check_skip(&mut self, block: &Block, out: &mut Batch) {
        let rules = &self.settings.dialect.block;
        if block.skip > rules.skip_levels {
            let code = format!("/{}", block.skip).into();
            self.fault(Fault::NotSupported { code, name: "block-skip level".into() }, block.span, out);
        }
        if self.assume && rules.skip_unsure && !std::mem::replace(&mut self.reported.skip, true) {
            let (code, meaning) = (rules.skip.as_str().into(), "block skip".into());
            out.report(Fault::AssumedRow { code, meaning }, block.span);
        }
    }

    /// Tells codes from other words, and finds what must not stand together.
    fn sort_words<'b>(
        &mut self,
        block: &'b Block,
        codes: &mut Vec<Code>,
        words: &mut Words<'b>,
        src: Source,
        out: &mut Batch,
    ) {
        let dialect = self.settings.dialect;
        let number_letter = dialect.block.number.map_or(0, |c| c as u8);
        let mut counts = [0u8; 2];
        for (at, word) in block.words.iter().enumerate() {
            if word.value == Value::None && !dialect.block.omitted_zero {
                let letter = char::from(word.letter);
                self.fault(Fault::WordWithoutNumber { letter }, word.span, out);
                self.now.refused = true;
            }
            match word.letter {
                b'G' | b'M' => {
                    let m = usize::from(word.letter == b'M');
                    counts[m] = counts[m].saturating_add(1);
                    let limit = if m == 1 { dialect.block.m_codes } else { dialect.block.g_codes };
                    if limit != 0 && counts[m] == limit + 1 {
                        let letter = char::from(word.letter);
                        self.fault(Fault::TooManyCodes { letter, limit }, word.span, out);
                    }
                    self.code(at, word, codes, src, out);
                }
                letter if letter == number_letter => {
                    if self.now.number.is_some() {
                        self.fault(Fault::WordTwice { letter: char::from(letter) }, word.span, out);
                    }
                    self.now.number = self.whole(word, src, out);
                }
                letter => {
                    let place = usize::from(letter.wrapping_sub(b'A'));
                    let Some(row) = self.letters.get(place).copied().flatten() else {
                        self.fault(Fault::UnknownCode { code: src.text(word.span) }, word.span, out);
                        continue;
                    };
                    if words.at[place] != 0 {
                        self.fault(Fault::WordTwice { letter: char::from(letter) }, word.span, out);
                    }
                    words.at[place] = (at + 1) as u16;
                    words.left |= 1 << place;
                    let reported = self.reported.letters >> place & 1 == 1;
                    if !row.sure && self.assume && !reported {
                        self.reported.letters |= 1 << place;
                        let meaning = role_name(row.role).into();
                        out.report(
                            Fault::AssumedRow { code: char::from(letter).to_string().into(), meaning },
                            word.span,
                        );
                    }
                }
            }
        }
        codes.sort_by_key(|c| rank(c.meaning));
    }

    /// Looks a code up.
    fn code(&mut self, at: usize, word: &Word, codes: &mut Vec<Code>, src: Source, out: &mut Batch) {
        let dialect = self.settings.dialect;
        let tenths = match word.value {
            Value::None => Some(0),
            Value::Number(d) if d.scale == 0 => d.mantissa.checked_mul(10),
            Value::Number(d) if d.scale == 1 => Some(d.mantissa),
            Value::Number(_) => None,
        };
        let tenths = tenths.and_then(|t| u32::try_from(t).ok());
        let Some(row) = tenths.and_then(|t| dialect.code_row(word.letter, t)) else {
            self.now.refused = true;
            return self.fault(Fault::UnknownCode { code: src.text(word.span) }, word.span, out);
        };
        if word.letter == b'M' && matches!(word.value, Value::Number(d) if d.point) {
            self.fault(Fault::PointNotAllowed { word: src.text(word.span) }, word.span, out);
        }
        let Some(meaning) = row.means else {
            self.now.refused = true;
            let cycles = dialect.code_for(Meaning::StartCycle).map(|row| row.group.as_str());
            self.now.cycle_refused |= cycles == Some(&row.group);
            let name = row.refuse.as_deref().unwrap_or_default().into();
            return self.fault(Fault::NotSupported { code: row.code.as_str().into(), name }, word.span, out);
        };
        if let Some(other) = codes.iter().find(|c| !row.group.is_empty() && c.row.group == row.group) {
            let fault = Fault::CodesExclude { first: src.text(other.span), second: src.text(word.span) };
            self.now.failed = true;
            out.diagnostics.push(Diagnostic { fault, span: word.span, related: vec![other.span] });
        }
        if !row.sure {
            self.assume_row(row, &meaning.to_string(), word.span, out);
        }
        codes.push(Code { row, meaning, span: word.span, at });
    }

    /// Reports, once, that a row is not confirmed.
    pub(super) fn assume_row(&mut self, row: &'static CodeRow, meaning: &str, at: Span, out: &mut Batch) {
        if self.assume && self.first_time(row) {
            out.report(Fault::AssumedRow { code: row.code.as_str().into(), meaning: meaning.into() }, at);
        }
    }

    /// Whether this row is met for the first time by the reports.
    fn first_time(&mut self, row: &'static CodeRow) -> bool {
        let rows = &self.settings.dialect.code;
        let place = rows.iter().position(|r| std::ptr::eq(r, row));
        match place.and_then(|p| self.reported.codes.get_mut(p)) {
            Some(reported) => !std::mem::replace(reported, true),
            None => false,
        }
    }

    /// The value of an option that decides here; reported once if nobody chose it.
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

    /// The block's functions, in the order in which they happen.
    fn functions(
        &mut self,
        block: &Block,
        codes: &[Code],
        words: &mut Words,
        level: Option<u8>,
        src: Source,
        out: &mut Batch,
    ) {
        let first_function = codes.partition_point(|c| rank(c.meaning) < RANK_WORDS);
        let (settings, functions) = codes.split_at(first_function);
        let before_motion = functions.partition_point(|c| rank(c.meaning) < RANK_MOTION);
        let (before, rest) = functions.split_at(before_motion);
        let motion_end = rest.partition_point(|c| rank(c.meaning) < RANK_AFTER);
        let (motion, after) = rest.split_at(motion_end);

        for code in settings {
            self.setting(code, out);
        }
        self.feed_word(motion, words, src, out);
        self.speed_and_tool(words, src, out);
        let mut dwell = false;
        for code in before {
            self.skip_in_tail(block, code, level);
            dwell |= code.meaning == Meaning::Dwell;
            self.function(code, words, src, out);
        }
        self.now.skip = if block.tail.is_some() { None } else { level };
        self.corrector(words, src, out);
        self.motion_codes(motion, dwell, block.span, words, src, out);
        for code in after {
            self.skip_in_tail(block, code, level);
            self.function(code, words, src, out);
        }
    }

    /// A skip mark amid the words counts for what follows it. That is taken only of M codes that
    /// stand for themselves; anything else would be a different block, not a shorter one.
    fn check_tail(&mut self, block: &Block, codes: &[Code], out: &mut Batch) {
        let Some(tail) = block.tail else {
            return;
        };
        let words = block.words.get(tail..).unwrap_or_default();
        let calls = codes.iter().any(|c| matches!(c.meaning, Meaning::Call | Meaning::Return));
        if calls || words.iter().any(|w| w.letter != b'M') {
            let name = "block skip amid the words of a block".into();
            self.fault(Fault::NotSupported { code: "/".into(), name }, block.span, out);
        }
    }

    /// The skip level of a code's statement, where the mark stands amid the words.
    fn skip_in_tail(&mut self, block: &Block, code: &Code, level: Option<u8>) {
        if let Some(tail) = block.tail {
            self.now.skip = if code.at >= tail { level } else { None };
        }
    }

    /// Sets a mode; also for a block that is refused.
    fn set_mode(&mut self, meaning: Meaning, out: &mut Batch) {
        match meaning {
            Meaning::UseLengthUnits(units) => {
                self.state.units = Know::Said(units);
                self.see_units(units, out);
            }
            Meaning::SelectPlane(plane) => self.state.plane = Know::Said(plane),
            Meaning::SetDistanceMode(distance) => self.state.distance = Know::Said(distance),
            Meaning::SetFeedMode(mode) => self.state.feed_mode = Know::Said(mode),
            Meaning::SetReturnLevel(level) => {
                self.now.recall |= self.state.return_level.value() != Some(level);
                self.state.return_level = Know::Said(level);
            }
            Meaning::SetOriginOffsets(offset) => self.state.work_offset = Know::Said(offset),
            Meaning::ClearFrame(FrameSlot::Shift) => self.state.no_shift = Know::Said(true),
            Meaning::StraightTraverse => self.state.motion = Know::Said(Motion::Traverse),
            Meaning::StraightFeed => self.state.motion = Know::Said(Motion::Feed),
            Meaning::ArcFeed(turn) => self.state.motion = Know::Said(Motion::Arc(turn)),
            Meaning::EndCycle => self.state.cycle = InForce::None,
            _ => {}
        }
    }

    fn setting(&mut self, code: &Code, out: &mut Batch) {
        if let (Meaning::SelectPlane(plane), InForce::Active(active)) = (code.meaning, &self.state.cycle)
            && active.plane.known() != Some(plane)
        {
            let name = "change of the plane while a cycle is in force".into();
            self.fault(Fault::NotSupported { code: code.row.code.as_str().into(), name }, code.span, out);
        }
        self.set_mode(code.meaning, out);
        let op = match code.meaning {
            Meaning::NoEffect => {
                let name = code.row.code.as_str();
                if self.assume && self.first_time(code.row) {
                    out.report(Fault::AssumedNoEffect { code: name.into() }, code.span);
                }
                Op::NoEffect(name.into())
            }
            Meaning::UseLengthUnits(units) => Op::UseLengthUnits(units),
            Meaning::SelectPlane(plane) => Op::SelectPlane(plane),
            Meaning::SetDistanceMode(distance) => Op::SetDistanceMode(distance),
            Meaning::SetFeedMode(mode) => Op::SetFeedMode(mode),
            Meaning::SetOriginOffsets(offset) => Op::SetOriginOffsets(offset),
            Meaning::ClearFrame(slot) => Op::ClearFrame(slot),
            Meaning::SetReturnLevel(level) => Op::SetReturnLevel(level),
            Meaning::StopCutterRadiusCompensation => Op::StopCutterRadiusCompensation,
            _ => return,
        };
        self.push(code.span, op, out);
    }

    /// Speed and tool words.
    fn speed_and_tool(&mut self, words: &mut Words, src: Source, out: &mut Batch) {
        if let Some(word) = words.take(self.roles.speed)
            && let Some(num) = self.number(&word, Quantity::Speed, src, out)
        {
            self.push(word.span, Op::SetSpindleSpeed(Expr::Num(num)), out);
        }
        if let Some(word) = words.take(self.roles.tool) {
            self.state.tool = Know::Said(());
            if let Some(num) = self.entry(&word, src, out) {
                self.push(word.span, Op::SelectTool(Expr::Num(num)), out);
            }
        }
    }

    /// A number of a table's entry, or of a tool: whole, not negative.
    pub(super) fn entry(&mut self, word: &Word, src: Source, out: &mut Batch) -> Option<Num> {
        let whole = self.whole(word, src, out)?;
        Some(Num::int(i64::from(whole), ncc_ir::num::Unit::One))
    }

    /// A code that stands for itself, before or after the motion.
    fn function(&mut self, code: &Code, words: &mut Words, src: Source, out: &mut Batch) {
        let op = match code.meaning {
            Meaning::ChangeTool => {
                if self.state.tool == Know::Unsaid {
                    self.fault(Fault::NoToolSelected, code.span, out);
                }
                Op::ChangeTool
            }
            Meaning::StartSpindleClockwise => Op::StartSpindleClockwise,
            Meaning::StartSpindleCounterclockwise => Op::StartSpindleCounterclockwise,
            Meaning::StopSpindleTurning => Op::StopSpindleTurning,
            Meaning::FloodOn => Op::FloodOn,
            Meaning::MistOn => Op::MistOn,
            Meaning::CoolantOff => Op::CoolantOff,
            Meaning::Dwell => {
                let found =
                    code.row.dwell.iter().find_map(|d| Some((words.take(d.letter as u8)?, d.quantity)));
                let Some((word, quantity)) = found else {
                    let word = code.row.dwell.first().map_or(' ', |d| d.letter).to_string().into();
                    let code_text = code.row.code.as_str().into();
                    return self.fault(Fault::WordMissing { code: code_text, word }, code.span, out);
                };
                match self.number(&word, quantity, src, out) {
                    Some(num) => Op::Dwell(Expr::Num(num)),
                    None => return,
                }
            }
            Meaning::UseToolLengthOffset => {
                let Some(word) = words.take(self.roles.length_entry) else {
                    let word = char::from(self.roles.length_entry).to_string().into();
                    let code_text = code.row.code.as_str().into();
                    return self.fault(Fault::WordMissing { code: code_text, word }, code.span, out);
                };
                return self.length_offset(&word, code.span.to(word.span), words, src, out);
            }
            Meaning::CancelToolLengthOffset => {
                self.state.length_offset = Know::Said(());
                Op::UseToolLengthOffset(Expr::int(0))
            }
            Meaning::ProgramStop => Op::ProgramStop,
            Meaning::OptionalProgramStop => Op::OptionalProgramStop,
            Meaning::ProgramEnd => {
                self.ended |= self.now.skip.is_none();
                Op::ProgramEnd
            }
            Meaning::Call => return self.call(code, words, src, out),
            Meaning::Return => return self.return_from(code, out),
            _ => return,
        };
        self.push(code.span, op, out);
    }

    /// A word that takes up a length entry by itself.
    fn corrector(&mut self, words: &mut Words, src: Source, out: &mut Batch) {
        let Some(word) = words.take(self.roles.corrector) else {
            return;
        };
        if self.option("o_word", word.span, out) == "ignore" {
            let _ = self.whole(&word, src, out);
            self.state.length_offset = Know::Said(());
            return;
        }
        self.length_offset(&word, word.span, words, src, out);
    }

    fn length_offset(&mut self, word: &Word, span: Span, words: &Words, src: Source, out: &mut Batch) {
        self.state.length_offset = Know::Said(());
        let Some(num) = self.entry(word, src, out) else {
            return;
        };
        let with_z = words.get(b'Z').is_some();
        if self.assume && !with_z && !std::mem::replace(&mut self.reported.offset_with_z, true) {
            out.report(Fault::AssumedOffsetWithZ, span);
        }
        self.push(span, Op::UseToolLengthOffset(Expr::Num(num)), out);
    }

    fn check_unused(&mut self, words: &Words, src: Source, out: &mut Batch) {
        let mut left = words.left;
        while left != 0 {
            let place = left.trailing_zeros() as usize;
            left &= left - 1;
            let word = words.all[usize::from(words.at[place]) - 1];
            self.fault(Fault::WordUnused { word: src.text(word.span) }, word.span, out);
        }
    }

    /// Where statements go.
    #[inline]
    pub(super) fn target<'o>(&'o mut self, out: &'o mut Batch) -> &'o mut Vec<Stmt> {
        match &mut self.sub {
            Some(procedure) => &mut procedure.body,
            None => &mut out.stmts,
        }
    }

    /// Adds a statement to the block.
    pub(super) fn push(&mut self, span: Span, op: Op, out: &mut Batch) {
        let now = &mut self.now;
        let joined = now.pushed && now.last_skip == now.skip;
        let number = if now.pushed { None } else { now.number };
        now.pushed = true;
        now.last_skip = now.skip;
        let skip = now.skip;
        self.target(out).push(Stmt { span, number, skip, joined, comment: None, op });
    }

    /// From here on, statements stand in a block of their own.
    pub(super) fn separate(&mut self, out: &mut Batch) {
        if let Some(stmt) = self.target(out).last_mut() {
            stmt.joined = false;
        }
    }

    /// Reports something that refuses the block.
    pub(super) fn fault(&mut self, fault: Fault, span: Span, out: &mut Batch) {
        self.now.failed = true;
        out.report(fault, span);
    }

    /// The same, for a value that is then missing.
    pub(super) fn refuse<T>(&mut self, fault: Fault, span: Span, out: &mut Batch) -> Option<T> {
        self.fault(fault, span, out);
        None
    }

    /// Ends the block: its comment, or what stands for an empty one.
    fn close(&mut self, block: &Block, src: Source, out: &mut Batch) {
        if self.now.failed {
            let mark = self.now.mark;
            self.target(out).truncate(mark);
            self.forgive();
            return;
        }
        let comment = join_comments(&block.comments, src);
        match (comment, self.now.pushed) {
            (None, true) => {}
            (None, false) => self.push(block.span, Op::Blank, out),
            (Some(text), false) => self.push(block.span, Op::Comment(text), out),
            (Some(text), true) => {
                if let Some(stmt) = self.target(out).last_mut() {
                    stmt.comment = Some(Box::new(text));
                }
            }
        }
    }

    /// After a refused block, what it may have said is not asked for again.
    pub(super) fn forgive(&mut self) {
        for said in [&mut self.state.feed, &mut self.state.tool] {
            if *said == Know::Unsaid {
                *said = Know::Lost;
            }
        }
        if self.state.motion == Know::Unsaid {
            self.state.motion = Know::Lost;
        }
        if self.now.cycle_refused {
            self.state.cycle = InForce::Lost;
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

/// Text as UTF-8, else Latin-1; blanks at the end are no part of it.
pub(super) fn decode(bytes: &[u8]) -> Text {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.trim_end().into(),
        Err(_) => bytes.iter().map(|&b| char::from(b)).collect::<String>().trim_end().into(),
    }
}

const RANK_WORDS: u8 = 10;
const RANK_MOTION: u8 = 20;
const RANK_AFTER: u8 = 30;

/// When a code's function happens within its block.
fn rank(meaning: Meaning) -> u8 {
    match meaning {
        Meaning::NoEffect => 0,
        Meaning::UseLengthUnits(_) => 1,
        Meaning::SelectPlane(_) => 2,
        Meaning::SetDistanceMode(_) => 3,
        Meaning::SetFeedMode(_) => 4,
        Meaning::SetOriginOffsets(_) => 5,
        Meaning::ClearFrame(_) => 6,
        Meaning::SetReturnLevel(_) => 7,
        Meaning::StopCutterRadiusCompensation => 8,
        // Feed, speed and tool words.
        Meaning::ChangeTool => RANK_WORDS,
        Meaning::StartSpindleClockwise | Meaning::StartSpindleCounterclockwise => 11,
        Meaning::FloodOn | Meaning::MistOn => 12,
        Meaning::Dwell => 13,
        Meaning::UseToolLengthOffset | Meaning::CancelToolLengthOffset => 14,
        Meaning::EndCycle => RANK_MOTION,
        Meaning::StraightTraverse | Meaning::StraightFeed | Meaning::ArcFeed(_) => 21,
        Meaning::StartCycle | Meaning::Pattern => 22,
        Meaning::StopSpindleTurning => RANK_AFTER,
        Meaning::CoolantOff => 31,
        Meaning::ProgramStop | Meaning::OptionalProgramStop => 32,
        Meaning::ProgramEnd => 33,
        Meaning::Call | Meaning::Return => 34,
    }
}

/// The motion of a motion code.
pub(super) fn motion_of(meaning: Meaning) -> Option<Motion> {
    match meaning {
        Meaning::StraightTraverse => Some(Motion::Traverse),
        Meaning::StraightFeed => Some(Motion::Feed),
        Meaning::ArcFeed(turn) => Some(Motion::Arc(turn)),
        _ => None,
    }
}

fn role_name(role: Role) -> &'static str {
    match role {
        Role::Axis => "axis",
        Role::CentreX | Role::CentreY | Role::CentreZ => "centre of an arc",
        Role::Radius => "radius of an arc",
        Role::Feed => "feed",
        Role::Speed => "spindle speed",
        Role::Tool => "tool",
        Role::LengthEntry => "entry of the length table",
        Role::Corrector => "tool corrector",
        Role::RadiusEntry => "entry of the radius table",
        Role::Parameter => "parameter of codes",
    }
}
