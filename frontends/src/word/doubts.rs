//! Blocks that two readings take for two different things, as far as the text shows it: a T beside M06 while another
//! tool waits, and two codes of distance in the block of a return to a reference point.
//!
//! ```text
//! T1 / M06 T2 / G43 H1          tool 2 with the length of tool 1, or tool 1
//! G91 G28 X0 Y0 Z0. G90         through zero of the part, or from where the axes stand
//! ```
//!
//! Each is an assumption, which is asked where both readings make two different cuts. Not here: what a control puts
//! in (its behaviour), and the question.

use ncc_dialects::{CYCLE_BESIDE_MOTION, CycleRow, MOTION_CANCELS, Meaning, RETURN_DISTANCE, RETURN_FIRST};
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::{Axis, Distance};
use ncc_ir::diag::{Diagnostic, Fault};

use super::block_words::{Code, Words};
use super::lower::Lower;
use super::text::block::Block;
use crate::batch::Batch;
use crate::common::Source;
use crate::common::words::{Value, Word};

impl Lower {
    /// A block selects a tool.
    pub(super) fn tool_named(&mut self, word: &Word) {
        let (before, now) = (self.tools.waits, word.to_whole());
        self.tools.waits = now;
        self.tools.now = now.map(|now| (before, now, word.span));
    }

    /// A block changes the tool.
    pub(super) fn tool_changed(&mut self) {
        let block = self.tools.now.take();
        let both = block.and_then(|(before, named, span)| Some((named, before?, span)));
        self.tools.doubt = both.filter(|(named, waiting, _)| named != waiting);
        if self.tools.doubt.is_none() {
            self.tools.waits = None;
        }
    }

    /// A block is over: its T waits from here on.
    pub(super) fn tool_block_over(&mut self) {
        self.tools.now = None;
    }

    /// A length is activated: with the number of the tool that waited, it contradicts the T beside M06.
    pub(super) fn length_named(&mut self, word: &Word, out: &mut Batch) {
        let Some((named, waiting, span)) = self.tools.doubt.take() else { return };
        let contradicts = word.to_whole() == Some(waiting);
        let behaviours = self.settings.behaviours();
        let with_change = Behaviour::ToolWithChange;
        let open = behaviours.is_open(with_change) && !behaviours.does(with_change);
        if self.assume && contradicts && open && !std::mem::replace(&mut self.reported.tool_change, true) {
            out.report(Fault::AssumedToolChange { named, waiting }, span);
        }
    }

    /// Whether a code of motion cancels the cycle whose code is in its block: the option of the dictionary says so.
    /// Then the words that are the cycle's alone mean nothing.
    pub(super) fn cancels(
        &mut self,
        motion: &Code,
        cycle: &Code,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) -> bool {
        if !self.settings.takes(CYCLE_BESIDE_MOTION, MOTION_CANCELS) {
            return false;
        }
        let open = self.assume && !self.settings.is_chosen(CYCLE_BESIDE_MOTION);
        if open && !std::mem::replace(&mut self.reported.cycle_beside_motion, true) {
            let fault = Fault::AssumedCycle { cycle: src.text(cycle.span), motion: src.text(motion.span) };
            out.report(fault, cycle.span);
        }
        if self.settings.get(CYCLE_BESIDE_MOTION) != MOTION_CANCELS {
            return false;
        }
        let dialect = self.settings.dialect;
        let own =
            dialect.cycle.iter().filter(|row| row.code == cycle.row.code).flat_map(CycleRow::own_letters);
        for letter in own.chain(dialect.cycles.repeat).chain(self.settings.repeat_word()) {
            words.take(letter as u8);
        }
        true
    }

    /// Whether two codes of distance in one block may have two readings.
    pub(super) fn may_have_two_distances(&self, meaning: Meaning, codes: &[Code]) -> bool {
        let distance = |meaning| matches!(meaning, Meaning::SetDistanceMode(_));
        distance(meaning)
            && codes.iter().filter(|code| distance(code.meaning)).count() == 1
            && self.settings.takes(RETURN_DISTANCE, RETURN_FIRST)
    }

    /// Two codes of distance in one block: the last one is active after it. In the block of a return, the option of
    /// the dictionary says by which one its words are read; elsewhere they exclude each other.
    pub(super) fn two_distances(
        &mut self,
        block: &Block,
        codes: &mut Vec<Code>,
        src: Source,
        out: &mut Batch,
    ) {
        let distance = |code: &Code| match code.meaning {
            Meaning::SetDistanceMode(distance) => Some(distance),
            _ => None,
        };
        let mut both =
            codes.iter().enumerate().filter_map(|(at, code)| Some((at, distance(code)?, code.span)));
        let (Some((at, first, span)), Some((_, last, other))) = (both.next(), both.next()) else { return };
        let reference = codes.iter().find(|code| matches!(code.meaning, Meaning::GoToReference { .. }));
        let Some(code) = reference.filter(|_| first != last) else {
            let fault = Fault::CodesExclude { first: src.text(span), second: src.text(other) };
            self.now.failed = true;
            out.diagnostics.push(Diagnostic { fault, span: other, related: vec![span] });
            return;
        };
        let (code, first_counts) = (code.span, self.settings.get(RETURN_DISTANCE) == RETURN_FIRST);
        codes.remove(at);
        self.now.return_distance = first_counts.then_some(first);
        let words: Vec<&Word> = block.words.iter().filter(|word| self.is_axis_letter(word.letter)).collect();
        let zero = |word: &&Word| matches!(word.value, Value::Number(digits) if digits.mantissa == 0);
        let open = self.assume && !words.is_empty() && !self.settings.is_chosen(RETURN_DISTANCE);
        if open && !std::mem::replace(&mut self.reported.return_distance, true) {
            let fault = Fault::AssumedReturn {
                code: src.text(code),
                words: words.iter().map(|word| src.text(word.span)).collect::<Vec<_>>().join(" ").into(),
                zero: words.iter().all(zero),
                last: last == Distance::Absolute,
            };
            out.report(fault, span.to(other));
        }
    }

    fn is_axis_letter(&self, letter: u8) -> bool {
        Axis::ALL.into_iter().any(|axis| axis.letter() == letter && self.axis_row(axis).is_some())
    }
}
