//! The words of reasons: machine coordinates, reference points and probing.

use ncc_ir::lack::MachineLack as L;

pub(super) fn text(lack: &L) -> &'static str {
    match lack {
        L::Coordinates => "a move in machine coordinates",
        L::CoordinatesCode => "machine coordinates",
        L::WithToolLength => "a move in machine coordinates that is measured with the tool's length",
        L::WithoutToolLength => "a move in machine coordinates without the tool's length",
        L::CoordinatesWithoutLength => "machine coordinates without the tool's length",
        L::Probing => "a probing move",
        L::ProbingWithError => "a probing move with an error at the end of its way",
        L::ProbingAway => "a probing move away from a contact",
        L::ProbingKind => "a probing move of this kind",
        L::ProbingFeedUnknown => "a probing move whose feed is not known",
        L::OneSide => "positioning from one side: how far beyond is the machine's",
        L::CallersMotionAfterReturn => {
            "a position by the caller's motion, behind a return to a point of the machine"
        }
        L::LengthAfterReturn => {
            "a return to a point of the machine behind which Z moves by a length that is not said anew"
        }
        L::IncrementAfterMachineMove => {
            "an incremental Z behind a move to a place of the machine, with the tool's length"
        }
        L::CutWithoutToolOffsets => {
            "a cut in machine coordinates without the offsets of the tool along X and Y"
        }
        L::Cut => "a cut in machine coordinates",
        L::CutUnderFrame => "a cut in machine coordinates under a frame of the program",
        L::CutAfterRotation => "a cut in machine coordinates behind a rotation",
        L::CutOffsetUnknown => "a cut in machine coordinates: its work offset is not known",
        L::CutUnitUnknown => "a cut in machine coordinates: the unit is not known",
        L::CutOffsetVariable => "a cut in machine coordinates: no variable has this offset",
        L::CutDigits => "a cut in machine coordinates with so many digits",
        L::IntermediatePointUnknown => "a return by an intermediate point that is not known here",
        L::IntermediateRotary => "an intermediate point of a turning axis",
        L::StoredPosition => "a move to a position that is stored in the control",
        L::FurtherPoint => "a move to this point of the machine",
        L::MachineZero => "a move to the machine's zero",
        L::ReferencePoint => "a move to the reference point",
        L::Detour => "a rapid move by a detour",
        L::ZAfterToolChange => "Z at machine zero after a tool change",
    }
}
