//! Repetition of blocks by block numbers.
//!
//! The blocks at both ends get numbers, whatever is done about numbers otherwise. Where the last block takes
//! several lines, its number stands on the last of them.
//!
//! Not here: which blocks are at the ends; a pass has named them.

use std::collections::BTreeMap;

use ncc_dialects::REPEAT_COUNT;
use ncc_ir::canon::Motion;
use ncc_ir::diag::Fault;
use ncc_ir::lack::FlowLack;
use ncc_ir::program::packed::PackedLines;
use ncc_ir::program::{Op, RepeatBlocks, Stmt, Text};
use ncc_ir::source::Span;

use super::Writer;
use crate::Numbering;
use crate::common::Sink;
use crate::common::block::{Need, Part, Rank};
use crate::common::fault::cannot;
use crate::common::packed::packed;
use crate::common::words::HIGHEST_NUMBER;

/// Most passes of a repetition.
const MOST_TIMES: u32 = 9999;

/// A named block.
#[derive(Clone, Debug)]
pub(crate) struct Label {
    name: Text,
    /// Whether blocks are repeated from it.
    begins: bool,
    /// Whether blocks are repeated up to it.
    ends: bool,
    /// Its number, and one for its last line.
    numbers: [u32; 2],
    /// The number of its last line, once written.
    end: Option<u32>,
}

/// Labels of the program.
#[derive(Clone, Debug, Default)]
pub(crate) struct Labels {
    all: Vec<Label>,
    /// The label that ends with the block at hand.
    ending: Option<usize>,
    /// Whether units, plane and distance mode are changed after the first label.
    changed: [bool; 3],
    /// Whether cycles are activated, or end, within repeated blocks.
    cycles: bool,
}

impl Writer {
    /// Gives every label of the program its numbers.
    pub(crate) fn number_labels(&mut self, stmts: &[Stmt]) {
        let is_label = |s: &&Stmt| matches!(s.op, Op::Label(_));
        if self.dialect.repeat.letters().is_none() || !stmts.iter().any(|s| is_label(&s)) {
            return;
        }
        let mut seen: BTreeMap<u32, u32> = BTreeMap::new();
        let packed = stmts.iter().filter_map(packed).flat_map(PackedLines::unpack);
        for number in stmts.iter().filter_map(|s| s.number).chain(packed.filter_map(|s| s.number)) {
            *seen.entry(number).or_default() += 1;
        }
        let mut next = seen.keys().last().copied().filter(|n| *n < 90_000).unwrap_or(0) / 10 * 10;
        let mut free = |seen: &mut BTreeMap<u32, u32>| {
            let tens = (1..).map(|n| next + 10 * n).take_while(|n| *n <= HIGHEST_NUMBER);
            let number = tens.chain(1..=HIGHEST_NUMBER).find(|n| !seen.contains_key(n));
            let number = number.unwrap_or(HIGHEST_NUMBER);
            next = number;
            seen.insert(number, 1);
            number
        };
        let repeats = || {
            stmts
                .iter()
                .filter_map(|s| if let Op::RepeatBlocks(repeat) = &s.op { Some(repeat) } else { None })
        };
        let first = stmts.iter().position(|s| is_label(&s)).unwrap_or_default();
        for stmt in &stmts[first..] {
            let changed = &mut self.labels.changed;
            changed[0] |= matches!(stmt.op, Op::UseLengthUnits(_));
            changed[1] |= matches!(stmt.op, Op::SelectPlane(_));
            changed[2] |= matches!(stmt.op, Op::SetDistanceMode(_));
        }
        for repeat in repeats() {
            let place = |name: &Text| stmts.iter().position(|s| matches!(&s.op, Op::Label(l) if l == name));
            let (from, to) = (place(&repeat.from), repeat.to.as_ref().and_then(place));
            let blocks = from.zip(to).and_then(|(from, to)| stmts.get(from..to)).unwrap_or_default();
            let last = to.map_or(&[][..], |to| &stmts[to + 1..]).iter().take_while(|s| s.joined);
            let cycle = |s: &Stmt| matches!(s.op, Op::StartCycle(_) | Op::EndCycle);
            self.labels.cycles |= blocks.iter().chain(last).any(cycle);
        }
        for stmt in stmts.iter().filter(is_label) {
            let Op::Label(name) = &stmt.op else { continue };
            let own = stmt.number.filter(|n| *n > 0 && seen.get(n) == Some(&1));
            let first = own.unwrap_or_else(|| free(&mut seen));
            let begins = repeats().any(|r| r.from == *name);
            let ends = repeats().any(|r| r.to.as_ref() == Some(name));
            let numbers = [first, if begins && ends { free(&mut seen) } else { first }];
            self.labels.all.push(Label { name: name.clone(), begins, ends, numbers, end: None });
        }
    }

    pub(crate) fn label(&mut self, name: &str, sink: &mut Sink) -> Result<(), Fault> {
        let mut known = self.labels.all.iter().enumerate().filter(|(_, label)| *label.name == *name);
        let (Some((at, label)), None) = (known.next(), known.next()) else {
            return Err(cannot(FlowLack::Label));
        };
        let (begins, ends) = (label.begins, label.ends);
        if self.held.as_ref().is_some_and(|held| !held.in_text) {
            return Err(cannot(FlowLack::RepetitionInCycleBlock));
        }
        if !self.words.block.is_empty() {
            self.words.flush(false, sink);
            self.words.split = true;
        }
        if let Numbering::Every { first, step } = self.words.numbers.numbering {
            let numbers = [self.words.numbers.count(first, step), self.words.numbers.count(first, step)];
            self.labels.all[at].numbers = numbers;
        }
        let label = &self.labels.all[at];
        if begins {
            self.words.numbers.waiting = Some(label.numbers[0]);
        }
        if ends {
            self.labels.ending = Some(at);
        }
        // The label's number stands in one line alone.
        self.words.block.number = None;
        self.words.numbers.lines = 0;
        if begins {
            self.forget_all_but_cycle();
        }
        Ok(())
    }

    /// What is active is not known, but for modes that nothing changes, and the cycle, which is activated
    /// again.
    fn forget_all_but_cycle(&mut self) {
        let (held, force) = (self.held.take(), self.words.active);
        self.forget();
        let [units, plane, distance] = self.labels.changed;
        if !units {
            self.words.active.units = force.units;
        }
        if !plane && !force.our_plane {
            self.words.active.plane = force.plane;
        }
        if !distance && !force.our_distance {
            self.words.active.distance = force.distance;
        }
        self.held = held;
        match &mut self.held {
            Some(held) if self.labels.cycles => held.in_text = false,
            Some(_) => self.words.active.motion = force.motion.filter(|motion| *motion == Motion::Cycle),
            None => {}
        }
    }

    /// The block of a label is about to end: its last line is still to be written, if it has words.
    pub(crate) fn label_ends(&mut self) {
        let Some(at) = self.labels.ending.take() else { return };
        let Some(label) = self.labels.all.get_mut(at) else { return };
        let written = !self.words.block.is_empty();
        label.end = match (written, self.words.numbers.waiting, self.words.numbers.lines) {
            // Its only line is still to be written.
            (true, Some(number), _) => Some(number),
            (true, None, _) => {
                self.words.numbers.waiting = Some(label.numbers[1]);
                Some(label.numbers[1])
            }
            (false, None, 1) if label.begins => Some(label.numbers[0]),
            (false, _, _) => None,
        };
    }

    pub(crate) fn repeat_blocks(
        &mut self,
        repeat: &RepeatBlocks,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let letters = self.dialect.repeat.letters().ok_or_else(|| cannot(FlowLack::Repetition))?;
        let times = repeat.times.literal().and_then(|n| n.whole_number()).and_then(|n| u32::try_from(n).ok());
        let times = times.ok_or_else(|| cannot(FlowLack::RepetitionComputed))?;
        if times == 0 {
            return Ok(());
        }
        let named = |name: &Text| self.labels.all.iter().find(|label| label.name == *name);
        let from = named(&repeat.from).map(|label| label.numbers[0]);
        let to = repeat.to.as_ref().and_then(named).and_then(|label| label.end);
        let (Some(from), Some(to), None) = (from, to, self.words.numbers.waiting) else {
            return Err(cannot(FlowLack::RepetitionOfThese));
        };
        let total = self.words.settings.get(REPEAT_COUNT) == "total";
        let times = times.saturating_add(u32::from(total));
        if times > MOST_TIMES {
            return Err(Fault::TargetRange { word: times.to_string().into() });
        }
        self.words.rely(REPEAT_COUNT, span, sink);
        let need = letters.iter().fold(Need::new(Rank::Alone), |need, letter| need.letter(*letter));
        self.words.admit(&need, sink)?;
        for (letter, value) in letters.into_iter().zip([from, to, times]) {
            self.words.block.digits(Part::Tail, letter, &value.to_string());
        }
        self.forget_all_but_cycle();
        Ok(())
    }
}
