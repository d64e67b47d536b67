//! The words of reasons: rounded and chamfered corners.

use ncc_ir::unexecuted::{CornerUnexecuted as R, NoCorner};

pub(super) fn text(reason: &R) -> &'static str {
    match reason {
        R::TwoAfterMove => "two corners behind one move",
        R::NotSettings => "something other than settings between the moves of a corner",
        R::MachineMove => "a move in machine coordinates at a corner",
        R::Probing => "a probing move at a corner",
        R::Detour => "a rapid move by a detour at a corner",
        R::OnContour => "a corner of a contour whose compensation is worked out",
        R::AxisTurned => "a corner with the tool's axis turned",
        R::TangentArc => "a tangent arc behind a corner",
        R::SeveralTurns => "an arc of several turns at a corner",
        R::FullCircle => "a corner beside a full circle",
        R::Frame => "a corner in a frame that does not leave it one",
        R::Rapid => "a corner beside a rapid",
        R::OtherMove => "a corner beside another move than a line or an arc at feed",
        R::FeedByTime => "a corner between moves whose feed is their time",
        R::DifferentFeeds => "a corner between moves of different feeds",
        R::DifferentPath => "a corner between moves that are taken differently",
        R::Scaled => "a corner in a frame that scales",
        R::Slight => "a corner of less than a degree",
        R::ChamferAtArc => "a chamfer beside an arc",
    }
}

pub(crate) fn no_corner(why: NoCorner) -> &'static str {
    match why {
        NoCorner::NoSize => "a corner of no size",
        NoCorner::PlaneChanges => "a change of the plane at a corner",
        NoCorner::NoMotion => "a move that goes nowhere at a corner",
        NoCorner::LeavesPlane => "a corner beside a move that leaves its plane",
        NoCorner::TurnsBack => "a corner at which the way turns back",
        NoCorner::TooLarge => "a corner that takes more than its moves have",
        NoCorner::NoNextMove => "a corner without a move that follows in its plane",
    }
}
