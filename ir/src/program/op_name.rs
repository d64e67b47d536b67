//! The stable names of statements.

use super::machine::{Data, ToolLength};
use super::{Control, Op};
use crate::canon::CornerShape;
use crate::operator_text::Output;
use crate::program::cycle::Pattern;

impl Op {
    /// Its upper-case name in text; control has lower-case words.
    pub const fn name(&self) -> &'static str {
        match self {
            Op::Comment(_) => "COMMENT",
            Op::NoEffect(_) => "NO_EFFECT",
            Op::Blank => "BLANK",
            Op::Lines(_) => "LINES",
            Op::UseLengthUnits(_) => "USE_LENGTH_UNITS",
            Op::SetDistanceMode(_) => "SET_DISTANCE_MODE",
            Op::SelectPlane(_) => "SELECT_PLANE",
            Op::SetFeedMode(_) => "SET_FEED_MODE",
            Op::SetReturnLevel(_) => "SET_RETURN_LEVEL",
            Op::SetOriginOffsets(_) => "SET_ORIGIN_OFFSETS",
            Op::ClearFrame(_) => "CLEAR_FRAME",
            Op::SetFrame(frame) => {
                if frame.added {
                    "ADD_FRAME"
                } else {
                    "SET_FRAME"
                }
            }
            Op::SetSlot(slot) => slot.name(),
            Op::SetPosition(_) => "SET_POSITION",
            Op::UseOriginShift(_) => "USE_ORIGIN_SHIFT",
            Op::UseToolCentrePoint(_) => "USE_TOOL_CENTRE_POINT",
            Op::OrientToolAxis(_) => "ORIENT_TOOL_AXIS",
            Op::UseMachineCoordinates { .. } => "USE_MACHINE_COORDINATES",
            Op::Probe(_) => "PROBE",
            Op::Detour(_) => "DETOUR",
            Op::SetData(data) => match **data {
                Data::Offset { .. } => "SET_OFFSET_DATA",
                Data::Tool { .. } => "SET_TOOL_DATA",
                Data::Measured { .. } => "MEASURE_TOOL",
                Data::Position(_) => "STORE_POSITION",
                Data::ToolInSpindle(_) => "SET_TOOL_NUMBER",
            },
            Op::GoToReference(_) => "GO_TO_REFERENCE",
            Op::UseToolEdge { .. } => "USE_TOOL_EDGE",
            Op::StartCutterRadiusCompensation { .. } => "START_CUTTER_RADIUS_COMPENSATION",
            Op::StopCutterRadiusCompensation => "STOP_CUTTER_RADIUS_COMPENSATION",
            Op::SetMotionControlMode(_) => "SET_MOTION_CONTROL_MODE",
            Op::ExactStop => "EXACT_STOP",
            Op::TurnRotaryAxes(_) => "TURN_ROTARY_AXES",
            Op::Corner { shape, .. } => match shape {
                CornerShape::Round => "ROUND_CORNER",
                CornerShape::Leg => "CHAMFER_CORNER",
                CornerShape::Length => "CHAMFER_CORNER_BY_LENGTH",
            },
            Op::Advise(_) => "ADVISE",
            Op::SetFeedRate(_) => "SET_FEED_RATE",
            Op::SetSpindleSpeed(_) => "SET_SPINDLE_SPEED",
            Op::SetSpindleMode(_) => "SET_SPINDLE_MODE",
            Op::LimitSpindleSpeed(_) => "LIMIT_SPINDLE_SPEED",
            Op::SelectTool(_) => "SELECT_TOOL",
            Op::SelectToolByName(_) => "SELECT_TOOL_BY_NAME",
            Op::ChangeTool => "CHANGE_TOOL",
            Op::UseToolLengthOffset(_) => "USE_TOOL_LENGTH_OFFSET",
            Op::UseToolLength(length) => match **length {
                ToolLength::Value(_) => "USE_TOOL_LENGTH",
                ToolLength::Added(_) => "ADD_TOOL_LENGTH",
                ToolLength::AddedEntry(_) => "ADD_TOOL_LENGTH_OFFSET",
                ToolLength::Offsets { added: false, .. } => "USE_TOOL_OFFSETS",
                ToolLength::Offsets { added: true, .. } => "ADD_TOOL_OFFSETS",
            },
            Op::StartSpindleClockwise => "START_SPINDLE_CLOCKWISE",
            Op::StartSpindleCounterclockwise => "START_SPINDLE_COUNTERCLOCKWISE",
            Op::StopSpindleTurning => "STOP_SPINDLE_TURNING",
            Op::OrientSpindle(_) => "ORIENT_SPINDLE",
            Op::MachineFunction(_) => "MACHINE_FUNCTION",
            Op::FloodOn => "FLOOD_ON",
            Op::MistOn => "MIST_ON",
            Op::CoolantOff => "COOLANT_OFF",
            Op::Dwell(_) => "DWELL",
            Op::StraightTraverse(_) => "STRAIGHT_TRAVERSE",
            Op::StraightFeed(_) => "STRAIGHT_FEED",
            Op::SynchronisedFeed(_) => "SYNCHRONISED_FEED",
            Op::ArcFeed(_) => "ARC_FEED",
            Op::ArcForm(arc) => arc.shape.name(),
            Op::SetPole(_) => "SET_POLE",
            Op::Polar(_) => "POLAR",
            Op::Position(_) => "POSITION",
            Op::StartCycle(_) => "START_CYCLE",
            Op::Hole(_) => "HOLE",
            Op::Pattern(pattern) => match **pattern {
                Pattern::Circle { .. } => "CIRCLE_PATTERN",
                Pattern::Line { .. } => "LINE_PATTERN",
                Pattern::Grid { .. } => "RECTANGULAR_LAYOUT",
                Pattern::List(_) => "POSITION_LIST",
            },
            Op::EndCycle => "END_CYCLE",
            Op::ProgramStop => "PROGRAM_STOP",
            Op::OptionalProgramStop => "OPTIONAL_PROGRAM_STOP",
            Op::ProgramEnd => "PROGRAM_END",
            Op::BeginAgain => "BEGIN_AGAIN",
            Op::Message(_) => "MESSAGE",
            Op::MessageOf(_) => "MESSAGE_OF",
            Op::Output(output) => match **output {
                Output::Open => "OPEN_OUTPUT",
                Output::Line(_) => "OUTPUT",
                Output::Close => "CLOSE_OUTPUT",
            },
            Op::Alarm(_) => "ALARM",
            Op::Call(_) => "CALL",
            Op::Return => "RETURN",
            Op::RepeatBlocks(_) => "REPEAT_BLOCKS",
            Op::Assign(..) => "assignment",
            Op::Declare(_) => "DECLARE",
            Op::Control(control) => match **control {
                Control::Repeat { .. } => "repeat",
                Control::Loop { .. } => "loop",
                Control::While { .. } => "while",
                Control::Until { .. } => "until",
                Control::For { .. } => "for",
                Control::If { .. } => "if",
            },
            Op::Goto(_) => "GOTO",
            Op::Label(_) => "LABEL",
            Op::Leave => "LEAVE",
            Op::NextTurn => "NEXT_TURN",
        }
    }
}
