//! The words of reasons: frames, tilted planes and tool centre point control.

use ncc_ir::unexecuted::FrameUnexecuted as R;

pub(super) fn text(reason: &R) -> &'static str {
    match reason {
        R::OffsetByPosition => "a work offset set by the position under a frame",
        R::TurnedOffsetPosition => "a frame that depends on where the axes stand in a turned work offset",
        R::PresentPointTurned => "coordinates of the present point in a frame that turns or scales",
        R::PresentPointOffset => "coordinates of the present point in a frame of a turned offset",
        R::EarlierShift => "an origin shift of which an earlier program has numbers",
        R::IncrementAfterTurn => "an incremental word after a frame that turns",
        R::TipInTilt => "tool centre point control in a tilted plane",
        R::TipUnderFrame => "tool centre point control under a frame",
        R::TiltUnderTip => "a tilted plane under tool centre point control",
        R::TiltUnderFrame => "a tilted plane under a frame",
        R::TiltInTilt => "a tilted plane in another one",
        R::TiltEndUnderFrame => "the end of a tilted plane under another frame",
        R::AxisWithoutTilt => "the tool's axis turned without a tilted plane",
        R::AxisInCycle => "the tool's axis turned under a cycle or a compensated contour",
        R::FrameUnderTip => "another frame or work offset under tool centre point control",
        R::FrameInTilt => "another frame or work offset in a tilted plane",
        R::ArcUnderTip => "an arc under tool centre point control",
        R::CycleUnderTip => "a cycle under tool centre point control",
        R::ThreadUnderTip => "a thread under tool centre point control",
        R::CompensationUnderTip => "cutter radius compensation under tool centre point control",
        R::MachinePointUnderTip => "a point of the machine under tool centre point control",
        R::ProbingUnderTip => "probing under tool centre point control",
        R::DetourUnderTip => "a rapid move by a detour under tool centre point control",
        R::ToolChangeUnderTip => "a tool change under tool centre point control",
        R::UnitsUnderTip => "other units under tool centre point control",
    }
}
