//! A tool change by hand, of a control that has none.
//!
//! ```text
//! T3 M06      →      M5 M9 G53 G0 Z0 T3 M0 (TOOL 3)
//! ```
//!
//! One block does it all: the spindle and the coolant are off before Z goes up, and the program stops after that. The
//! reader takes exactly this block for a change.
//!
//! Not here: the spindle that starts again after it (`passes::side_effects`), and the length of the tool, which no
//! program knows (`passes::length_by_hand`).

use ncc_dialects::{BY_HAND, FILE_PER_TOOL, TOOL_CHANGE};
use ncc_ir::canon::{Axis, Motion};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::lack::ToolsLack;
use ncc_ir::source::Span;

use super::Writer;
use crate::common::Sink;
use crate::common::block::{Need, Part, Rank};
use crate::common::fault::cannot;

impl Writer {
    /// Writes a change to the tool that is selected.
    ///
    /// # Errors
    /// The option refuses it, or the tool's number is not known.
    pub(super) fn change_by_hand(&mut self, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        self.words.rely(TOOL_CHANGE, span, sink);
        // Of a file per tool, this block is where one ends and the next begins.
        if ![BY_HAND, FILE_PER_TOOL].contains(&self.words.settings.get(TOOL_CHANGE)) {
            return Err(cannot(ToolsLack::ChangeByHand));
        }
        let tool = self.words.tracker.selected.filter(|tool| *tool >= 0);
        let tool = tool.ok_or_else(|| cannot(ToolsLack::ChangeByHandUnknown))?;
        let (codes, z) = (&self.words.codes, self.words.codes.axes[Axis::Z as usize]);
        let all = [codes.spindle_stop, codes.coolant_off, codes.machine[0], codes.traverse, codes.stop];
        let ([Some(off), Some(dry), Some(machine), Some(rapid), Some(stop)], Some(z), Some(letter)) =
            (all, z, codes.tool)
        else {
            return Err(cannot(ToolsLack::Change));
        };
        let number = self.words.number(&letter, &Expr::int(tool), span, sink)?;
        let zero = self.words.number(&z, &Expr::int(0), span, sink)?;
        // A tool word of its own says no more.
        self.words.block.drop_alone(letter.letter);
        let need = all.into_iter().fold(Need::new(Rank::Alone), Need::code);
        self.words.admit(&need.letter(z.letter).letter(letter.letter), sink)?;
        for code in [off, dry, machine, rapid] {
            self.words.block.code(Part::Mode, &code);
        }
        self.words.block.word(Part::Axes, z.letter, zero);
        self.words.block.word(Part::Tail, letter.letter, number);
        self.words.block.code(Part::Tail, &stop);
        self.words.comment(&format!("TOOL {tool}"), span, sink);
        self.words.active.motion = Some(Motion::Traverse);
        self.words.residue[Axis::Z as usize] = 0;
        Ok(())
    }
}
