//! A limit of the spindle's speed.
//!
//! Not here: what a speed counts (`common::words`).

use ncc_ir::canon::{Spindle, SpindleMode};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::lack::SpindleLack;
use ncc_ir::program::Op;
use ncc_ir::source::Span;

use super::Writer;
use crate::common::Sink;
use crate::common::block::{Need, Part, Rank};
use crate::common::fault::cannot;

impl Writer {
    /// The highest speed under a surface speed.
    pub(super) fn speed_limit(&mut self, limit: &Expr, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        if let (Some(code), Some(letter)) = (self.words.codes.speed_limit, self.words.codes.speed) {
            let value = self.words.value(&letter, limit, span, sink)?;
            if !self.words.block.is_empty() {
                self.words.flush(false, sink);
                self.words.split = true;
            }
            self.words.admit(&Need::new(Rank::Alone).code(Some(code)).letter(letter.letter), sink)?;
            self.words.block.code(Part::Mode, &code);
            self.words.block.word(Part::Mode, letter.letter, value);
            return Ok(());
        }
        let known = self.words.codes.surface_limit.and_then(|_| limit.literal());
        let limit = known.ok_or_else(|| cannot(SpindleLack::SpeedLimit))?;
        // It is stated with the surface speed that follows.
        if self.words.surfaces.unlimited || self.words.active.spindle_mode == Some(SpindleMode::Surface) {
            return Err(cannot(SpindleLack::LimitAfterSurfaceSpeed));
        }
        self.words.surfaces.limited = true;
        self.words.surfaces.unsaid = Some(span);
        self.words.active.limit = Some(limit);
        Ok(())
    }

    /// Tells of a limit that counts before a surface speed could say it.
    pub(super) fn limit_in_turns(&mut self, op: &Op, sink: &mut Sink) {
        let starts = matches!(op, Op::StartSpindleClockwise | Op::StartSpindleCounterclockwise);
        let sets = matches!(
            op,
            Op::LimitSpindleSpeed(_)
                | Op::SetSpindleMode(_)
                | Op::SetSpindleSpeed(_)
                | Op::SetFeedMode(_)
                | Op::SetFeedRate(_)
                | Op::UseLengthUnits(_)
                | Op::SetDistanceMode(_)
                | Op::SelectPlane(_)
                | Op::SetOriginOffsets(_)
                | Op::SelectTool(_)
                | Op::StopSpindleTurning
                | Op::Comment(_)
                | Op::Blank
                | Op::NoEffect(_)
        );
        let turns =
            matches!(self.words.tracker.spindle, Some(Spindle::Clockwise | Spindle::Counterclockwise));
        if (starts || turns && !sets)
            && let Some(span) = self.words.surfaces.unsaid.take()
        {
            sink.report(cannot(SpindleLack::LimitUnderTurns), span);
        }
    }
}
