//! The words of reasons: tools and their tables.

use ncc_ir::unexecuted::ToolUnexecuted as R;

pub(super) fn text(reason: &R) -> &'static str {
    match reason {
        R::LengthUnderArc => "a tool length that moves its axis under an arc or a cycle",
        R::LengthInCycle => "a tool length that moves its axis in a cycle, a contour or a tilted plane",
        R::IncrementTakesLength => "an incremental way along Z on which a length is taken up",
        R::OffsetInCycle => "another offset of the tool along X or Y in a cycle, a contour or a tilted plane",
        R::RadiusInUse => "another radius for the tool that is in use",
        R::LengthInUse => "another length for the tool that is in use",
        R::MeasuredInFrame => "a tool measured in a frame that turns or scales, or beside a contour",
    }
}
