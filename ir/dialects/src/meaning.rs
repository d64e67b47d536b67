//! The meanings that a code of a dictionary can have, as its data file spells them.

use std::fmt;
use std::str::FromStr;

use ncc_ir::canon::{
    AdviceKind, Distance, FeedMode, PathMode, Plane, ReturnLevel, Side, SpindleMode, Turn, Units,
};
use ncc_ir::program::{CentreFrom, Detour, FrameSlot, PoleFrom, Probe, ReferencePoint};
use serde::{Deserialize, Deserializer};

/// What a G or M code means. Spelled as in the text form of the IR, with its argument after a
/// blank: `SELECT_PLANE XY`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)] // The names are those of `ncc_ir::program::Op`.
pub enum Meaning {
    StraightTraverse,
    StraightFeed,
    ArcFeed(Turn),
    /// A straight spindle-synchronised move; the row's words are those of the lead.
    SynchronisedFeed(Thread),
    Dwell,
    UseLengthUnits(Units),
    SetDistanceMode(Distance),
    SelectPlane(Plane),
    SetFeedMode(FeedMode),
    SetReturnLevel(ReturnLevel),
    /// From where the words of a centre are measured. No statement: an arc carries it.
    SetCentreMode(CentreFrom),
    SetOriginOffsets(u16),
    ClearFrame(FrameSlot),
    /// G92 shift (`true`) or local shift by the block's axis words, each for its own axis.
    SetShift(bool),
    /// The present point gets the block's axis words as coordinates.
    SetPosition,
    /// The G92 shift is suspended (`false`), or restored as it was.
    UseOriginShift(bool),
    /// Rotation in the plane about the block's axis words; the row's first word is the angle.
    SetRotation,
    /// Factors about the block's axis words; the row's first word is one for all axes, the next three
    /// are those along X, Y and Z.
    SetScale,
    /// The axes of the block's words are mirrored there.
    SetMirror,
    /// The axes of the block's words are mirrored no more.
    ClearMirror,
    /// Points are those of the tool tip. As a code, with the length entry that a word names; what ends
    /// the length ends it.
    UseToolCentrePoint(bool),
    /// A tilted plane: the axis words are its zero, three words of the row the turns about Z, the new X and
    /// the new Z; or the arguments of a call. What ends a rotation of the same group ends it.
    SetTilt,
    /// The tool is turned upright on it.
    OrientToolAxis,
    /// With the tool's length, or without it.
    UseMachineCoordinates {
        length: bool,
        /// Whether the move is rapid whatever motion is active.
        rapid: bool,
    },
    /// A straight move at feed that ends where the probe triggers. As a code of the group of motions it stays active,
    /// and bare axis words after it are refused.
    StraightProbe(Probe),
    /// To a reference point; [`ReferencePoint::Further`] 0 is the one that a word of the block names.
    GoToReference {
        point: ReferencePoint,
        keeps_length: bool,
    },
    /// A rapid move to the block's words that is not straight. One from one side stays active where a
    /// parameter of the control says so: bare axis words after it are refused.
    Detour(Detour),
    /// Puts values into the table of the row of `[[data]]` that a word of the block names.
    SetData,
    /// Where the axes stand becomes the stored position of this number.
    StorePosition(u8),
    /// The row's word is the number of the tool in the spindle.
    SetToolNumber,
    /// The block's axis words, or polar ones, say about which point polar words are.
    SetPole(PoleFrom),
    /// From here on, the words of the plane's axes are radius and angle about program zero (`true`), or
    /// coordinates again. No statement: points carry it.
    PolarWords(bool),
    /// With the radius of the entry that a word names, or the active one of the dialect.
    StartCutterRadiusCompensation(Side),
    /// The same by the diameter of the tool, which a word of the block states.
    StartCompensationByDiameter(Side),
    StopCutterRadiusCompensation,
    SetMotionControlMode(PathMode),
    ExactStop,
    /// Advice of a kind; without its value, a word of the block says it: 0 is off, and another number,
    /// which the row has, is on.
    Advise(AdviceKind, Option<u8>),
    /// Whether the operator's switches change feed and speed: [`AdviceKind::FeedOverride`] and
    /// [`AdviceKind::SpeedOverride`] at once.
    Overrides(bool),
    SetSpindleMode(SpindleMode),
    /// The speed word of the block is the highest one, and axes have no words in it.
    LimitSpindleSpeed,
    /// Stops the spindle at the control's own angle, or at that of a word of the block.
    OrientSpindle,
    /// Applies the length entry that a word of the block names.
    UseToolLengthOffset,
    /// The block's Z word is the active length, or is added to it; so is the length of the entry that a word
    /// names.
    UseToolLength {
        added: bool,
    },
    /// No length offset.
    CancelToolLengthOffset,
    /// Calls up the cycle of the row with the same code.
    StartCycle,
    EndCycle,
    /// The pattern of the row with the same code.
    Pattern,
    NoEffect,
    /// On this machine without an effect on the cut, as its user has stated: read, told, and not written.
    LeftOut,
    StartSpindleClockwise,
    StartSpindleCounterclockwise,
    StopSpindleTurning,
    /// The tapping cycle activated next is a rigid one.
    RigidTapping,
    ChangeTool,
    /// A function of the machine that no dialect supports, by its name.
    MachineFunction(&'static str),
    FloodOn,
    MistOn,
    CoolantOff,
    ProgramStop,
    OptionalProgramStop,
    ProgramEnd,
    /// The main program begins again, for ever.
    BeginAgain,
    Call,
    CallMacro,
    /// Such a call after every block that moves an axis, until they end.
    CallMacroAtMoves,
    /// Such a call in every block, whose words are its arguments, until they end.
    CallMacroAtBlocks,
    EndCallsAtMoves,
    Return,
}

/// Spindle-synchronised moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Thread {
    /// As the spindle turns.
    Plain,
    /// As the spindle turns, and back to where it began with the spindle turned round.
    Back,
    /// The control turns the spindle itself, in this sense for a positive lead, and holds it after.
    Turned(Turn),
    /// Feed and spindle each on their own, with a compensating chuck.
    Chuck,
}

impl<'de> Deserialize<'de> for Meaning {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Meaning, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(serde::de::Error::custom)
    }
}

impl Meaning {
    /// Whether the code calls a macro, at once, at moves or at every block: a word of its block says which.
    pub const fn calls_macro(self) -> bool {
        matches!(self, Meaning::CallMacro | Meaning::CallMacroAtMoves | Meaning::CallMacroAtBlocks)
    }
}

impl fmt::Display for Meaning {
    /// As a data file spells it.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Meaning::StraightTraverse => "STRAIGHT_TRAVERSE",
            Meaning::StraightFeed => "STRAIGHT_FEED",
            Meaning::ArcFeed(Turn::Clockwise) => "ARC_FEED clockwise",
            Meaning::ArcFeed(Turn::Counterclockwise) => "ARC_FEED counterclockwise",
            Meaning::SynchronisedFeed(Thread::Plain) => "SYNCHRONISED_FEED",
            Meaning::SynchronisedFeed(Thread::Back) => "SYNCHRONISED_FEED back",
            Meaning::SynchronisedFeed(Thread::Turned(Turn::Clockwise)) => "SYNCHRONISED_FEED clockwise",
            Meaning::SynchronisedFeed(Thread::Turned(Turn::Counterclockwise)) => {
                "SYNCHRONISED_FEED counterclockwise"
            }
            Meaning::SynchronisedFeed(Thread::Chuck) => "SYNCHRONISED_FEED chuck",
            Meaning::Dwell => "DWELL",
            Meaning::UseLengthUnits(Units::Mm) => "USE_LENGTH_UNITS mm",
            Meaning::UseLengthUnits(Units::Inch) => "USE_LENGTH_UNITS inch",
            Meaning::SetDistanceMode(Distance::Absolute) => "SET_DISTANCE_MODE absolute",
            Meaning::SetDistanceMode(Distance::Incremental) => "SET_DISTANCE_MODE incremental",
            Meaning::SelectPlane(Plane::Xy) => "SELECT_PLANE XY",
            Meaning::SelectPlane(Plane::Zx) => "SELECT_PLANE ZX",
            Meaning::SelectPlane(Plane::Yz) => "SELECT_PLANE YZ",
            Meaning::SetFeedMode(FeedMode::PerMinute) => "SET_FEED_MODE per-minute",
            Meaning::SetFeedMode(FeedMode::PerRevolution) => "SET_FEED_MODE per-revolution",
            Meaning::SetFeedMode(FeedMode::InverseTime) => "SET_FEED_MODE inverse-time",
            Meaning::SetReturnLevel(ReturnLevel::Initial) => "SET_RETURN_LEVEL initial",
            Meaning::SetReturnLevel(ReturnLevel::Retract) => "SET_RETURN_LEVEL retract",
            Meaning::SetCentreMode(CentreFrom::Zero) => "SET_CENTRE_MODE absolute",
            Meaning::SetCentreMode(CentreFrom::Start) => "SET_CENTRE_MODE incremental",
            Meaning::SetOriginOffsets(number) => return write!(f, "SET_ORIGIN_OFFSETS {number}"),
            Meaning::ClearFrame(slot) => {
                return write!(f, "CLEAR_FRAME {}", format!("{slot:?}").to_lowercase());
            }
            Meaning::SetShift(true) => "SET_SHIFT shift",
            Meaning::SetShift(false) => "SET_SHIFT local",
            Meaning::SetPosition => "SET_POSITION",
            Meaning::UseOriginShift(true) => "USE_ORIGIN_SHIFT on",
            Meaning::UseOriginShift(false) => "USE_ORIGIN_SHIFT off",
            Meaning::SetRotation => "SET_ROTATION",
            Meaning::SetScale => "SET_SCALE",
            Meaning::SetMirror => "SET_MIRROR",
            Meaning::ClearMirror => "CLEAR_MIRROR",
            Meaning::UseToolCentrePoint(true) => "USE_TOOL_CENTRE_POINT on",
            Meaning::UseToolCentrePoint(false) => "USE_TOOL_CENTRE_POINT off",
            Meaning::SetTilt => "SET_TILT",
            Meaning::OrientToolAxis => "ORIENT_TOOL_AXIS",
            Meaning::StraightProbe(Probe { away: false, error: false }) => "STRAIGHT_PROBE",
            Meaning::StraightProbe(Probe { away: false, error: true }) => "STRAIGHT_PROBE or-error",
            Meaning::StraightProbe(Probe { away: true, error: false }) => "STRAIGHT_PROBE away",
            Meaning::StraightProbe(Probe { away: true, error: true }) => "STRAIGHT_PROBE away or-error",
            Meaning::Detour(Detour::OneSide) => "DETOUR one-side",
            Meaning::Detour(Detour::Intermediate) => "DETOUR intermediate",
            Meaning::UseMachineCoordinates { length: true, rapid: false } => "USE_MACHINE_COORDINATES",
            Meaning::UseMachineCoordinates { length: true, rapid: true } => "USE_MACHINE_COORDINATES rapid",
            Meaning::UseMachineCoordinates { length: false, rapid: false } => {
                "USE_MACHINE_COORDINATES no-length"
            }
            Meaning::UseMachineCoordinates { length: false, rapid: true } => {
                "USE_MACHINE_COORDINATES no-length rapid"
            }
            Meaning::GoToReference { point, keeps_length } => {
                let keeps = if *keeps_length { " keeps-length" } else { "" };
                return match point {
                    ReferencePoint::Home => write!(f, "GO_TO_REFERENCE home{keeps}"),
                    ReferencePoint::Further(0) => write!(f, "GO_TO_REFERENCE further{keeps}"),
                    ReferencePoint::Further(n) => write!(f, "GO_TO_REFERENCE further {n}{keeps}"),
                    ReferencePoint::Fixed(n) => write!(f, "GO_TO_REFERENCE fixed {n}{keeps}"),
                    ReferencePoint::Stored(n) => write!(f, "GO_TO_REFERENCE stored {n}{keeps}"),
                };
            }
            Meaning::SetData => "SET_DATA",
            Meaning::StorePosition(place) => return write!(f, "STORE_POSITION {place}"),
            Meaning::SetToolNumber => "SET_TOOL_NUMBER",
            Meaning::SetPole(PoleFrom::Zero) => "SET_POLE zero",
            Meaning::SetPole(PoleFrom::Here) => "SET_POLE here",
            Meaning::SetPole(PoleFrom::Pole) => "SET_POLE pole",
            Meaning::PolarWords(true) => "POLAR on",
            Meaning::PolarWords(false) => "POLAR off",
            Meaning::StartCutterRadiusCompensation(Side::Left) => "START_CUTTER_RADIUS_COMPENSATION left",
            Meaning::StartCutterRadiusCompensation(Side::Right) => "START_CUTTER_RADIUS_COMPENSATION right",
            Meaning::StartCompensationByDiameter(Side::Left) => {
                "START_CUTTER_RADIUS_COMPENSATION left by-diameter"
            }
            Meaning::StartCompensationByDiameter(Side::Right) => {
                "START_CUTTER_RADIUS_COMPENSATION right by-diameter"
            }
            Meaning::StopCutterRadiusCompensation => "STOP_CUTTER_RADIUS_COMPENSATION",
            Meaning::SetMotionControlMode(mode) => {
                return write!(f, "SET_MOTION_CONTROL_MODE {}", mode.name());
            }
            Meaning::ExactStop => "EXACT_STOP",
            Meaning::Advise(kind, None) => return write!(f, "ADVISE {}", kind.name()),
            Meaning::Advise(kind, Some(value)) => {
                let value = kind.values().get(usize::from(*value)).unwrap_or(&"off");
                return write!(f, "ADVISE {} {value}", kind.name());
            }
            Meaning::Overrides(true) => "ENABLE_OVERRIDES",
            Meaning::Overrides(false) => "DISABLE_OVERRIDES",
            Meaning::SetSpindleMode(SpindleMode::Turns) => "SET_SPINDLE_MODE turns",
            Meaning::SetSpindleMode(SpindleMode::Surface) => "SET_SPINDLE_MODE surface",
            Meaning::LimitSpindleSpeed => "LIMIT_SPINDLE_SPEED",
            Meaning::OrientSpindle => "ORIENT_SPINDLE",
            Meaning::UseToolLengthOffset => "USE_TOOL_LENGTH_OFFSET",
            Meaning::UseToolLength { added: false } => "USE_TOOL_LENGTH",
            Meaning::UseToolLength { added: true } => "ADD_TOOL_LENGTH",
            Meaning::CancelToolLengthOffset => "USE_TOOL_LENGTH_OFFSET 0",
            Meaning::StartCycle => "START_CYCLE",
            Meaning::EndCycle => "END_CYCLE",
            Meaning::Pattern => "PATTERN",
            Meaning::NoEffect => "NO_EFFECT",
            Meaning::StartSpindleClockwise => "START_SPINDLE_CLOCKWISE",
            Meaning::StartSpindleCounterclockwise => "START_SPINDLE_COUNTERCLOCKWISE",
            Meaning::StopSpindleTurning => "STOP_SPINDLE_TURNING",
            Meaning::RigidTapping => "RIGID_TAPPING",
            Meaning::ChangeTool => "CHANGE_TOOL",
            Meaning::LeftOut => return f.write_str("LEFT_OUT"),
            Meaning::MachineFunction(name) => return write!(f, "MACHINE_FUNCTION {name}"),
            Meaning::FloodOn => "FLOOD_ON",
            Meaning::MistOn => "MIST_ON",
            Meaning::CoolantOff => "COOLANT_OFF",
            Meaning::ProgramStop => "PROGRAM_STOP",
            Meaning::OptionalProgramStop => "OPTIONAL_PROGRAM_STOP",
            Meaning::ProgramEnd => "PROGRAM_END",
            Meaning::BeginAgain => "BEGIN_AGAIN",
            Meaning::Call => "CALL",
            Meaning::CallMacro => "CALL_MACRO",
            Meaning::CallMacroAtMoves => "CALL_MACRO_AT_MOVES",
            Meaning::CallMacroAtBlocks => "CALL_MACRO_AT_BLOCKS",
            Meaning::EndCallsAtMoves => "END_CALLS_AT_MOVES",
            Meaning::Return => "RETURN",
        })
    }
}

impl FromStr for Meaning {
    type Err = String;

    fn from_str(text: &str) -> Result<Meaning, String> {
        let (name, argument) = text.split_once(' ').unwrap_or((text, ""));
        Ok(match (name, argument) {
            ("STRAIGHT_TRAVERSE", "") => Meaning::StraightTraverse,
            ("STRAIGHT_FEED", "") => Meaning::StraightFeed,
            ("ARC_FEED", "clockwise") => Meaning::ArcFeed(Turn::Clockwise),
            ("ARC_FEED", "counterclockwise") => Meaning::ArcFeed(Turn::Counterclockwise),
            ("SYNCHRONISED_FEED", "") => Meaning::SynchronisedFeed(Thread::Plain),
            ("SYNCHRONISED_FEED", "back") => Meaning::SynchronisedFeed(Thread::Back),
            ("SYNCHRONISED_FEED", "clockwise") => Meaning::SynchronisedFeed(Thread::Turned(Turn::Clockwise)),
            ("SYNCHRONISED_FEED", "counterclockwise") => {
                Meaning::SynchronisedFeed(Thread::Turned(Turn::Counterclockwise))
            }
            ("SYNCHRONISED_FEED", "chuck") => Meaning::SynchronisedFeed(Thread::Chuck),
            ("DWELL", "") => Meaning::Dwell,
            ("USE_LENGTH_UNITS", "mm") => Meaning::UseLengthUnits(Units::Mm),
            ("USE_LENGTH_UNITS", "inch") => Meaning::UseLengthUnits(Units::Inch),
            ("SET_DISTANCE_MODE", "absolute") => Meaning::SetDistanceMode(Distance::Absolute),
            ("SET_DISTANCE_MODE", "incremental") => Meaning::SetDistanceMode(Distance::Incremental),
            ("SELECT_PLANE", "XY") => Meaning::SelectPlane(Plane::Xy),
            ("SELECT_PLANE", "ZX") => Meaning::SelectPlane(Plane::Zx),
            ("SELECT_PLANE", "YZ") => Meaning::SelectPlane(Plane::Yz),
            ("SET_FEED_MODE", "per-minute") => Meaning::SetFeedMode(FeedMode::PerMinute),
            ("SET_FEED_MODE", "per-revolution") => Meaning::SetFeedMode(FeedMode::PerRevolution),
            ("SET_FEED_MODE", "inverse-time") => Meaning::SetFeedMode(FeedMode::InverseTime),
            ("SET_RETURN_LEVEL", "initial") => Meaning::SetReturnLevel(ReturnLevel::Initial),
            ("SET_RETURN_LEVEL", "retract") => Meaning::SetReturnLevel(ReturnLevel::Retract),
            ("SET_CENTRE_MODE", "absolute") => Meaning::SetCentreMode(CentreFrom::Zero),
            ("SET_CENTRE_MODE", "incremental") => Meaning::SetCentreMode(CentreFrom::Start),
            ("SET_ORIGIN_OFFSETS", number) => {
                Meaning::SetOriginOffsets(number.parse().map_err(|_| format!("no meaning: {text}"))?)
            }
            ("CLEAR_FRAME", "shift") => Meaning::ClearFrame(FrameSlot::Shift),
            ("CLEAR_FRAME", "rotation") => Meaning::ClearFrame(FrameSlot::Rotation),
            ("CLEAR_FRAME", "scale") => Meaning::ClearFrame(FrameSlot::Scale),
            ("SET_SHIFT", "shift") => Meaning::SetShift(true),
            ("SET_SHIFT", "local") => Meaning::SetShift(false),
            ("SET_POSITION", "") => Meaning::SetPosition,
            ("USE_ORIGIN_SHIFT", "on") => Meaning::UseOriginShift(true),
            ("USE_ORIGIN_SHIFT", "off") => Meaning::UseOriginShift(false),
            ("SET_ROTATION", "") => Meaning::SetRotation,
            ("SET_SCALE", "") => Meaning::SetScale,
            ("SET_MIRROR", "") => Meaning::SetMirror,
            ("CLEAR_MIRROR", "") => Meaning::ClearMirror,
            ("USE_TOOL_CENTRE_POINT", "on") => Meaning::UseToolCentrePoint(true),
            ("USE_TOOL_CENTRE_POINT", "off") => Meaning::UseToolCentrePoint(false),
            ("SET_TILT", "") => Meaning::SetTilt,
            ("ORIENT_TOOL_AXIS", "") => Meaning::OrientToolAxis,
            ("STRAIGHT_PROBE", "") => Meaning::StraightProbe(Probe { away: false, error: false }),
            ("STRAIGHT_PROBE", "or-error") => Meaning::StraightProbe(Probe { away: false, error: true }),
            ("STRAIGHT_PROBE", "away") => Meaning::StraightProbe(Probe { away: true, error: false }),
            ("STRAIGHT_PROBE", "away or-error") => Meaning::StraightProbe(Probe { away: true, error: true }),
            ("DETOUR", "one-side") => Meaning::Detour(Detour::OneSide),
            ("DETOUR", "intermediate") => Meaning::Detour(Detour::Intermediate),
            ("USE_MACHINE_COORDINATES", "") => Meaning::UseMachineCoordinates { length: true, rapid: false },
            ("USE_MACHINE_COORDINATES", "no-length") => {
                Meaning::UseMachineCoordinates { length: false, rapid: false }
            }
            ("USE_MACHINE_COORDINATES", "no-length rapid") => {
                Meaning::UseMachineCoordinates { length: false, rapid: true }
            }
            ("GO_TO_REFERENCE", "home") => {
                Meaning::GoToReference { point: ReferencePoint::Home, keeps_length: false }
            }
            ("GO_TO_REFERENCE", "home keeps-length") => {
                Meaning::GoToReference { point: ReferencePoint::Home, keeps_length: true }
            }
            ("GO_TO_REFERENCE", "further") => {
                Meaning::GoToReference { point: ReferencePoint::Further(0), keeps_length: false }
            }
            ("GO_TO_REFERENCE", "stored 1") => {
                Meaning::GoToReference { point: ReferencePoint::Stored(1), keeps_length: false }
            }
            ("GO_TO_REFERENCE", "stored 1 keeps-length") => {
                Meaning::GoToReference { point: ReferencePoint::Stored(1), keeps_length: true }
            }
            ("GO_TO_REFERENCE", "stored 2") => {
                Meaning::GoToReference { point: ReferencePoint::Stored(2), keeps_length: false }
            }
            ("GO_TO_REFERENCE", "stored 2 keeps-length") => {
                Meaning::GoToReference { point: ReferencePoint::Stored(2), keeps_length: true }
            }
            ("SET_DATA", "") => Meaning::SetData,
            ("STORE_POSITION", "1") => Meaning::StorePosition(1),
            ("STORE_POSITION", "2") => Meaning::StorePosition(2),
            ("SET_TOOL_NUMBER", "") => Meaning::SetToolNumber,
            ("SET_POLE", "zero") => Meaning::SetPole(PoleFrom::Zero),
            ("SET_POLE", "here") => Meaning::SetPole(PoleFrom::Here),
            ("SET_POLE", "pole") => Meaning::SetPole(PoleFrom::Pole),
            ("POLAR", "on") => Meaning::PolarWords(true),
            ("POLAR", "off") => Meaning::PolarWords(false),
            ("START_CUTTER_RADIUS_COMPENSATION", "left") => {
                Meaning::StartCutterRadiusCompensation(Side::Left)
            }
            ("START_CUTTER_RADIUS_COMPENSATION", "right") => {
                Meaning::StartCutterRadiusCompensation(Side::Right)
            }
            ("START_CUTTER_RADIUS_COMPENSATION", "left by-diameter") => {
                Meaning::StartCompensationByDiameter(Side::Left)
            }
            ("START_CUTTER_RADIUS_COMPENSATION", "right by-diameter") => {
                Meaning::StartCompensationByDiameter(Side::Right)
            }
            ("STOP_CUTTER_RADIUS_COMPENSATION", "") => Meaning::StopCutterRadiusCompensation,
            ("SET_MOTION_CONTROL_MODE", mode) => Meaning::SetMotionControlMode(
                PathMode::named(mode).ok_or_else(|| format!("no meaning: {text}"))?,
            ),
            ("EXACT_STOP", "") => Meaning::ExactStop,
            ("ADVISE", advice) => {
                let (kind, value) = advice.split_once(' ').unwrap_or((advice, ""));
                let kind = AdviceKind::named(kind).ok_or_else(|| format!("no meaning: {text}"))?;
                match kind.value(value) {
                    None if !value.is_empty() => return Err(format!("no meaning: {text}")),
                    value => Meaning::Advise(kind, value),
                }
            }
            ("ENABLE_OVERRIDES", "") => Meaning::Overrides(true),
            ("DISABLE_OVERRIDES", "") => Meaning::Overrides(false),
            ("SET_SPINDLE_MODE", "turns") => Meaning::SetSpindleMode(SpindleMode::Turns),
            ("SET_SPINDLE_MODE", "surface") => Meaning::SetSpindleMode(SpindleMode::Surface),
            ("LIMIT_SPINDLE_SPEED", "") => Meaning::LimitSpindleSpeed,
            ("ORIENT_SPINDLE", "") => Meaning::OrientSpindle,
            ("USE_TOOL_LENGTH_OFFSET", "") => Meaning::UseToolLengthOffset,
            ("USE_TOOL_LENGTH", "") => Meaning::UseToolLength { added: false },
            ("ADD_TOOL_LENGTH", "") => Meaning::UseToolLength { added: true },
            ("USE_TOOL_LENGTH_OFFSET", "0") => Meaning::CancelToolLengthOffset,
            ("START_CYCLE", "") => Meaning::StartCycle,
            ("END_CYCLE", "") => Meaning::EndCycle,
            ("PATTERN", "") => Meaning::Pattern,
            ("NO_EFFECT", "") => Meaning::NoEffect,
            ("LEFT_OUT", "") => Meaning::LeftOut,
            ("START_SPINDLE_CLOCKWISE", "") => Meaning::StartSpindleClockwise,
            ("START_SPINDLE_COUNTERCLOCKWISE", "") => Meaning::StartSpindleCounterclockwise,
            ("STOP_SPINDLE_TURNING", "") => Meaning::StopSpindleTurning,
            ("RIGID_TAPPING", "") => Meaning::RigidTapping,
            ("CHANGE_TOOL", "") => Meaning::ChangeTool,
            // A dictionary lives as long as the process.
            ("MACHINE_FUNCTION", name) if !name.is_empty() => {
                Meaning::MachineFunction(Box::leak(name.to_owned().into_boxed_str()))
            }
            ("FLOOD_ON", "") => Meaning::FloodOn,
            ("MIST_ON", "") => Meaning::MistOn,
            ("COOLANT_OFF", "") => Meaning::CoolantOff,
            ("PROGRAM_STOP", "") => Meaning::ProgramStop,
            ("OPTIONAL_PROGRAM_STOP", "") => Meaning::OptionalProgramStop,
            ("PROGRAM_END", "") => Meaning::ProgramEnd,
            ("BEGIN_AGAIN", "") => Meaning::BeginAgain,
            ("CALL", "") => Meaning::Call,
            ("CALL_MACRO", "") => Meaning::CallMacro,
            ("CALL_MACRO_AT_MOVES", "") => Meaning::CallMacroAtMoves,
            ("CALL_MACRO_AT_BLOCKS", "") => Meaning::CallMacroAtBlocks,
            ("END_CALLS_AT_MOVES", "") => Meaning::EndCallsAtMoves,
            ("RETURN", "") => Meaning::Return,
            _ => return Err(format!("no meaning: {text}")),
        })
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_meaning_in_a_dictionary_is_written_as_it_is_read() {
        for row in crate::builtins().flat_map(|d| &d.code) {
            if let Some(meaning) = row.means {
                assert_eq!(meaning.to_string().parse(), Ok(meaning));
            }
        }
    }
}
