//! A tool change by hand, of a control that has none: one block that stops spindle and coolant, goes to machine zero
//! along Z, names the tool and stops the program.
//!
//! ```text
//! M5 M9 G53 G0 Z0 T3 M0      →      SELECT_TOOL(3) & CHANGE_TOOL()
//! ```
//!
//! Any word more or less, and the block is what its words say. What happens besides the change is in the dictionary, as
//! what the control does at a change.

use ncc_dialects::{BY_HAND, FILE_PER_TOOL, Meaning, TOOL_CHANGE};
use ncc_ir::diag::Fault;
use ncc_ir::program::Op;
use ncc_ir::source::Span;
use ncc_ir::unsupported::TableUnsupported;

use super::block_words::{Code, Words, motion_of};
use super::lower::Lower;
use crate::batch::Batch;
use crate::common::Source;
use crate::common::words::Value;

impl Lower {
    /// Reads a block as a tool change by hand, if it is one.
    pub(super) fn change_by_hand(
        &mut self,
        codes: &[Code],
        words: &mut Words,
        block: Span,
        src: Source,
        out: &mut Batch,
    ) -> bool {
        if !self.settings.dialect.can.change_by_hand || !self.is_change(codes, words) {
            return false;
        }
        if ![BY_HAND, FILE_PER_TOOL].contains(&self.option(TOOL_CHANGE, block, out)) {
            return false;
        }
        words.take(b'Z');
        self.speed_and_tool(words, src, out);
        self.tool_changed();
        self.push(block, Op::ChangeTool, out);
        self.set_mode(Meaning::StraightTraverse, out);
        true
    }

    /// Refuses a length, or its end, beside another command of axes, where the control does, and entry 0 of a table where
    /// the control takes another one.
    pub(super) fn length_alone(&mut self, codes: &[Code], words: &Words, src: Source, out: &mut Batch) {
        let entry = words.get(self.roles.length_entry);
        let zero = entry.filter(|word| matches!(word.value, Value::Number(digits) if digits.mantissa == 0));
        if let Some(span) = zero.map(|word| word.span)
            && codes.iter().any(|code| code.row.no_entry_zero)
        {
            self.fault(Fault::OutOfRange { word: src.text(span).into() }, span, out);
        }
        if !self.settings.dialect.can.length_alone {
            return;
        }
        let length = codes.iter().find_map(|code| match code.meaning {
            Meaning::UseToolLength { .. } => Some((code, u32::from(words.get(b'Z').is_some()))),
            Meaning::CancelToolLengthOffset => Some((code, 0)),
            _ => None,
        });
        let Some((code, own)) = length else { return };
        let axes = b"XYZABC".iter().filter(|letter| words.get(**letter).is_some()).count() as u32;
        let moves = codes.iter().any(|code| motion_of(code.meaning).is_some());
        if moves || axes > own {
            let what = TableUnsupported::LengthBesideMove.into();
            self.fault(Fault::NotSupported { code: code.row.code.as_str().into(), what }, code.span, out);
        }
    }

    fn is_change(&self, codes: &[Code], words: &Words) -> bool {
        let says = |fits: fn(Meaning) -> bool| codes.iter().any(|code| fits(code.meaning));
        let only = |letter: u8| 1 << letter.wrapping_sub(b'A');
        codes.len() == 5
            && says(|m| m == Meaning::StopSpindleTurning)
            && says(|m| m == Meaning::CoolantOff)
            && says(|m| matches!(m, Meaning::UseMachineCoordinates { .. }))
            && says(|m| m == Meaning::StraightTraverse)
            && says(|m| m == Meaning::ProgramStop)
            && words.left == only(self.roles.tool) | only(b'Z')
            && words.get(b'Z').is_some_and(|z| matches!(z.value, Value::Number(n) if n.mantissa == 0))
    }
}
