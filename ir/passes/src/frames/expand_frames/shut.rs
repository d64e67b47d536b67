//! What a target forbids while a rotation, factors or a mirror are active: there they are taken back
//! before it and stated again after it.
//!
//! Another work offset is such a thing. Values put into tables, and moves in machine coordinates and to
//! reference points, which would lead the tool out of a turned frame and back, are refused.

use crate::frames::expand_frames::{Frames, Slots, cannot};
use crate::frames::frame_forms::between;
use crate::support::write::Rebuild;
use ncc_exec::Chain;
use ncc_ir::canon::AXES;
use ncc_ir::diag::Fault;
use ncc_ir::lack::{FramesLack, OutsideFrame};
use ncc_ir::program::{Op, Stmt};

impl Frames<'_> {
    /// Whether a statement is one that the target forbids in the frames that were written.
    pub(super) fn is_shut(&self, op: &Op) -> bool {
        let said = &self.set.said;
        let open = said.rotation.is_none() && said.scale.is_none() && said.mirror == [None; 3];
        let outside = matches!(
            op,
            Op::SetOriginOffsets(_)
                | Op::GoToReference(_)
                | Op::SetData(_)
                | Op::UseMachineCoordinates { .. }
        );
        self.target.caps.frames.shut && outside && !open
    }

    /// Writes it outside of them.
    ///
    /// # Errors
    /// It cannot stand there.
    pub(super) fn outside(&mut self, stmt: Stmt, made: &mut Rebuild) -> Result<(), Fault> {
        let what = match stmt.op {
            Op::SetOriginOffsets(_) => OutsideFrame::WorkOffset,
            Op::GoToReference(_) => OutsideFrame::ReferencePoint,
            Op::UseMachineCoordinates { .. } => OutsideFrame::MachineCoordinates,
            _ => OutsideFrame::TableValue,
        };
        let in_cycle = self.inner.at.cycle.is_some() || self.inner.at.cycle_in_doubt;
        let coordinates = self.set.said.origin != [None; AXES] || self.set.said.steps != Chain::NONE;
        if !matches!(stmt.op, Op::SetOriginOffsets(_)) || stmt.skip.is_some() || in_cycle || coordinates {
            made.leave_out(stmt);
            return Err(cannot(FramesLack::UnderTurnedFrame { what }));
        }
        let said = self.set.said.clone();
        let bare = Slots { rotation: None, scale: None, mirror: [None; 3], ..said.clone() };
        let (caps, unit) = (&self.target.caps, self.inner.unit());
        let mut ops = between(&said, &bare, caps, unit);
        ops.push(stmt.op.clone());
        ops.extend(between(&bare, &said, caps, unit));
        self.advance(&stmt);
        for op in &ops {
            self.outer.step(&Stmt::new(stmt.span, op.clone()));
            self.note(op);
        }
        made.replace(stmt, ops.into_iter().map(|op| (false, op)));
        Ok(())
    }
}
