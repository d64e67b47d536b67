//! The words of reasons: shifts, rotations, scales, mirrors and tilted planes.

use std::borrow::Cow;

use ncc_ir::lack::{FramesLack as L, OutsideFrame};

pub(super) fn text(lack: &L) -> Cow<'static, str> {
    Cow::Borrowed(match lack {
        L::Frame => "a frame",
        L::Shift => "a shift",
        L::Rotation => "a rotation",
        L::RotationByIncrement => "a rotation by an increment",
        L::Scale => "factors",
        L::Mirror => "a mirror",
        L::LocalShift => "a local shift",
        L::TiltedPlane => "a tilted plane",
        L::TiltAxes => "a tilted plane by turns about these axes",
        L::TiltByComputedAngles => "a tilted plane by computed angles",
        L::TiltAfterUnknownEnd => "a tilted plane behind an end of one that may be none",
        L::TiltEnd => "the end of a tilted plane",
        L::AxisOntoTilt => "the tool's axis turned onto a tilted plane",
        L::AxisApartFromTilt => "the tool's axis turned apart from its plane",
        L::AxisTurning => "the way in which the tool's axis is turned",
        L::PresentPoint => "coordinates of the present point",
        L::ShiftResumed => "an origin shift taken up again",
        L::ShiftSuspended => "an origin shift suspended",
        L::Clear => "clearing this frame",
        L::BesideChain => "a shift, rotation, scale or mirror beside a chain of frames",
        L::DrillingAxisTurned => "a cycle in a frame that turns, mirrors or scales its drilling axis",
        L::DrillingAxisMoved => "a frame that moves the drilling axis of the cycle in force",
        L::ShiftEndInTurnedFrame => "the end of an origin shift in a turned or scaled frame",
        L::ShiftEndInCycle => "the end of an origin shift while a cycle is in force",
        L::ShiftEndBeforeLength => "the end of an origin shift along Z before a length offset is taken up",
        L::BesidePresentPoint => "this frame beside coordinates of the present point",
        L::OtherFormInCycle => "another form of frame while a cycle is in force",
        L::Thread => "a thread in a turned or scaled frame",
        L::Probing => "probing in a frame that is worked in",
        L::Detour => "a rapid move by a detour in a frame that is worked in",
        L::PolarPoint => "a point by radius and angle in a frame that is worked in",
        L::NotStraightOn => "a frame where the program does not go straight on",
        L::CompensationWithoutArcs => "cutter radius compensation in a frame that does not leave arcs",
        L::OffsetByPosition => "a work offset set by the position under a frame",
        L::ComputedWord => "a computed word in a frame",
        L::UnderTurnedFrame { what } => {
            return format!("{} while a rotation, factors or a mirror are in force", outside(*what)).into();
        }
        L::InSkippedBlock => "a frame in a block that can be skipped",
        L::LengthInTurnedFrame => "a length offset that waits in a turned frame",
        L::ArcFirstInRotation => "an arc as the first move of another rotation",
        L::ArcNoLonger => "an arc in a frame that does not leave it an arc",
        L::IncrementAfterChange => "an incremental word after a change of frame",
        L::OffsetRotation => "rotation of a work offset",
        L::ComputedWorkOffset => "a computed work offset, where work offsets go by name",
        L::WorkOffset { offset } => return format!("work offset {offset}").into(),
    })
}

fn outside(what: OutsideFrame) -> &'static str {
    match what {
        OutsideFrame::WorkOffset => "another work offset",
        OutsideFrame::ReferencePoint => "a return to a point of the machine",
        OutsideFrame::MachineCoordinates => "a move in machine coordinates",
        OutsideFrame::TableValue => "a value put into a table",
    }
}
