//! Words of the `ir` text: names of functions, key words, numbers with their units, texts.
//!
//! Works on one line. A word that is not known is a token as well, so that the parser can point at
//! it. Not here: what the words mean together.

use logos::Logos;
use ncc_ir::canon::RotaryWay;
use ncc_ir::expr::{Function, Var};
use ncc_ir::program::{Attribute, Detour, Op, Output, Text, ToolValue, Type};

use crate::scan::{block_number, number, quoted, variable};
use crate::word::{Form, LexFault, Literal, Valued, Worded};

/// A word.
#[derive(Clone, Debug, Logos, PartialEq)]
#[logos(error = LexFault)]
#[logos(skip r"[ \t\r]+")]
#[logos(skip(r"#[^\n]*", allow_greedy = true))]
pub(crate) enum Token {
    #[token("(")]
    Open,
    #[token(")")]
    Close,
    #[token("{")]
    Begin,
    #[token("}")]
    End,
    #[token("[")]
    OpenIndex,
    #[token("]")]
    CloseIndex,
    #[token(",")]
    Comma,
    #[token("&")]
    Join,
    #[token("=")]
    Assign,
    #[token("+")]
    Plus,
    #[token("-")]
    Minus,
    #[token("*")]
    Times,
    #[token("/")]
    Slash,
    #[token("^")]
    Power,
    #[token("==")]
    Equal,
    #[token("!=")]
    NotEqual,
    #[token("<")]
    Less,
    #[token("<=")]
    LessOrEqual,
    #[token(">")]
    Greater,
    #[token(">=")]
    GreaterOrEqual,

    #[regex(r"([0-9]+(\.[0-9]*)?|\.[0-9]+)(mm|in|deg|s|u)?", |lexer| number(lexer.slice()))]
    Number(Literal),
    #[regex(r#""([^"\\\n]|\\[^\n])*""#, |lexer| quoted(lexer.slice()))]
    Text(Text),
    #[regex(r"N[0-9]+", |lexer| block_number(lexer.slice()))]
    BlockNumber(u32),
    #[regex(r#"(local|common|retentive|system):([A-Za-z0-9_.$]+|"([^"\\\n]|\\[^\n])*")"#, |lexer| variable(lexer.slice()))]
    Var(Var),

    #[token("X")]
    X,
    #[token("Y")]
    Y,
    #[token("Z")]
    Z,
    #[token("A")]
    A,
    #[token("B")]
    B,
    #[token("C")]
    C,
    #[token("I")]
    I,
    #[token("J")]
    J,
    #[token("K")]
    K,
    #[token("XY")]
    Xy,
    #[token("ZX")]
    Zx,
    #[token("YZ")]
    Yz,

    #[token("BLANK", |_| Box::new(Op::Blank))]
    #[token("STOP_CUTTER_RADIUS_COMPENSATION", |_| Box::new(Op::StopCutterRadiusCompensation))]
    #[token("OPEN_OUTPUT", |_| Box::new(Op::Output(Box::new(Output::Open))))]
    #[token("CLOSE_OUTPUT", |_| Box::new(Op::Output(Box::new(Output::Close))))]
    #[token("CHANGE_TOOL", |_| Box::new(Op::ChangeTool))]
    #[token("START_SPINDLE_CLOCKWISE", |_| Box::new(Op::StartSpindleClockwise))]
    #[token("START_SPINDLE_COUNTERCLOCKWISE", |_| Box::new(Op::StartSpindleCounterclockwise))]
    #[token("STOP_SPINDLE_TURNING", |_| Box::new(Op::StopSpindleTurning))]
    #[token("FLOOD_ON", |_| Box::new(Op::FloodOn))]
    #[token("MIST_ON", |_| Box::new(Op::MistOn))]
    #[token("COOLANT_OFF", |_| Box::new(Op::CoolantOff))]
    #[token("END_CYCLE", |_| Box::new(Op::EndCycle))]
    #[token("PROGRAM_STOP", |_| Box::new(Op::ProgramStop))]
    #[token("OPTIONAL_PROGRAM_STOP", |_| Box::new(Op::OptionalProgramStop))]
    #[token("PROGRAM_END", |_| Box::new(Op::ProgramEnd))]
    #[token("BEGIN_AGAIN", |_| Box::new(Op::BeginAgain))]
    #[token("EXACT_STOP", |_| Box::new(Op::ExactStop))]
    #[token("RETURN", |_| Box::new(Op::Return))]
    #[token("LEAVE", |_| Box::new(Op::Leave))]
    #[token("NEXT_TURN", |_| Box::new(Op::NextTurn))]
    /// A function without arguments; in a box, since most words are small.
    Bare(Box<Op>),
    #[token("SET_FEED_RATE", |_| Valued::SetFeedRate)]
    #[token("SET_SPINDLE_SPEED", |_| Valued::SetSpindleSpeed)]
    #[token("LIMIT_SPINDLE_SPEED", |_| Valued::LimitSpindleSpeed)]
    #[token("SELECT_TOOL", |_| Valued::SelectTool)]
    #[token("USE_TOOL_LENGTH", |_| Valued::UseToolLength)]
    #[token("ADD_TOOL_LENGTH", |_| Valued::AddToolLength)]
    #[token("ADD_TOOL_LENGTH_OFFSET", |_| Valued::AddToolLengthOffset)]
    #[token("USE_TOOL_LENGTH_OFFSET", |_| Valued::UseToolLengthOffset)]
    #[token("DWELL", |_| Valued::Dwell)]
    #[token("ROUND_CORNER", |_| Valued::RoundCorner)]
    #[token("CHAMFER_CORNER", |_| Valued::ChamferCorner)]
    #[token("CHAMFER_CORNER_BY_LENGTH", |_| Valued::ChamferCornerByLength)]
    Valued(Valued),
    #[token("COMMENT", |_| Worded::Comment)]
    #[token("NO_EFFECT", |_| Worded::NoEffect)]
    #[token("MESSAGE", |_| Worded::Message)]
    #[token("MACHINE_FUNCTION", |_| Worded::MachineFunction)]
    #[token("SELECT_TOOL_BY_NAME", |_| Worded::SelectToolByName)]
    Worded(Worded),
    #[token("SET_MOTION_CONTROL_MODE")]
    SetMotionControlMode,
    #[token("ADVISE")]
    Advise,
    #[token("SET_SPINDLE_MODE")]
    SetSpindleMode,
    #[token("USE_LENGTH_UNITS")]
    UseLengthUnits,
    #[token("SET_DISTANCE_MODE")]
    SetDistanceMode,
    #[token("SELECT_PLANE")]
    SelectPlane,
    #[token("SET_FEED_MODE")]
    SetFeedMode,
    #[token("SET_RETURN_LEVEL")]
    SetReturnLevel,
    #[token("SET_ORIGIN_OFFSETS")]
    SetOriginOffsets,
    #[token("CLEAR_FRAME")]
    ClearFrame,
    #[token("SET_FRAME")]
    SetFrame,
    #[token("ADD_FRAME")]
    AddFrame,
    #[token("SET_POSITION")]
    SetPosition,
    #[token("SET_SHIFT")]
    SetShift,
    #[token("SET_ROTATION")]
    SetRotation,
    #[token("SET_SCALE")]
    SetScale,
    #[token("SET_MIRROR")]
    SetMirror,
    #[token("CLEAR_MIRROR")]
    ClearMirror,
    #[token("SET_POLE")]
    SetPole,
    #[token("POLAR")]
    PolarMove,
    #[token("TURN_ROTARY_AXES")]
    TurnRotaryAxes,
    #[token("shortest", |_| RotaryWay::Shortest)]
    #[token("positive", |_| RotaryWay::Positive)]
    #[token("negative", |_| RotaryWay::Negative)]
    /// Direction.
    RotaryWay(RotaryWay),
    #[token("pole")]
    Pole,
    #[token("SET_TILT")]
    SetTilt,
    #[token("USE_ORIGIN_SHIFT")]
    UseOriginShift,
    #[token("USE_TOOL_CENTRE_POINT")]
    UseTip,
    #[token("ORIENT_TOOL_AXIS")]
    OrientToolAxis,
    #[token("on")]
    On,
    #[token("off")]
    Off,
    #[token("minus")]
    TowardMinus,
    #[token("plus")]
    TowardPlus,
    #[token("START_CUTTER_RADIUS_COMPENSATION")]
    StartCompensation,
    #[token("left")]
    Left,
    #[token("right")]
    Right,
    #[token("tool")]
    Tool,
    #[token("in-force")]
    InForce,
    #[token("diameter")]
    Diameter,
    #[token("USE_TOOL_EDGE")]
    UseToolEdge,
    #[token("USE_MACHINE_COORDINATES")]
    UseMachineCoordinates,
    #[token("GO_TO_REFERENCE")]
    GoToReference,
    #[token("PROBE")]
    Probe,
    #[token("DETOUR")]
    Detour,
    #[token("one-side", |_| Detour::OneSide)]
    #[token("intermediate", |_| Detour::Intermediate)]
    /// A way that is not straight.
    Way(Detour),
    #[token("contact")]
    Contact,
    #[token("no-contact")]
    NoContact,
    #[token("or-error")]
    OrError,
    #[token("SET_OFFSET_DATA")]
    SetOffsetData,
    #[token("SET_TOOL_DATA")]
    SetToolData,
    #[token("MEASURE_TOOL")]
    MeasureTool,
    #[token("USE_TOOL_OFFSETS", |_| false)]
    #[token("ADD_TOOL_OFFSETS", |_| true)]
    ToolOffsets(bool),
    #[token("kept")]
    Kept,
    #[token("STORE_POSITION")]
    StorePosition,
    #[token("SET_TOOL_NUMBER")]
    SetToolNumber,
    #[token("turned")]
    Turned,
    #[token("LINE_PATTERN")]
    LinePattern,
    #[token("POSITION_LIST")]
    PositionList,
    #[token("REPEAT_BLOCKS")]
    RepeatBlocks,
    #[token("ARC_BY_ANGLE", |_| Form("ARC_BY_ANGLE"))]
    #[token("ARC_ABOUT_BY_ANGLE", |_| Form("ARC_ABOUT_BY_ANGLE"))]
    #[token("ARC_ABOUT", |_| Form("ARC_ABOUT"))]
    #[token("ARC_THROUGH", |_| Form("ARC_THROUGH"))]
    #[token("ARC_TANGENT", |_| Form("ARC_TANGENT"))]
    ArcForm(Form),
    #[token("STRAIGHT_TRAVERSE")]
    StraightTraverse,
    #[token("STRAIGHT_FEED")]
    StraightFeed,
    #[token("POSITION")]
    Position,
    #[token("HOLE")]
    Hole,
    #[token("ARC_FEED")]
    ArcFeed,
    #[token("START_CYCLE")]
    StartCycle,
    #[token("CIRCLE_PATTERN")]
    CirclePattern,
    #[token("RECTANGULAR_LAYOUT")]
    RectangularLayout,
    #[token("CALL")]
    Call,
    #[token("GOTO")]
    Goto,
    #[token("LABEL")]
    Label,

    #[token("ncc-ir")]
    Version,
    #[token("program")]
    Program,
    #[token("assumed")]
    Assumed,
    #[token("procedure")]
    Procedure,
    #[token("gives-back", |_| Attribute::GivesBack)]
    #[token("runs-through", |_| Attribute::RunsThrough)]
    #[token("not-shown", |_| Attribute::NotShown)]
    Attribute(Attribute),
    #[token("repeat")]
    Repeat,
    #[token("loop")]
    Loop,
    #[token("while")]
    While,
    #[token("for")]
    For,
    #[token("to")]
    To,
    #[token("step")]
    Step,
    #[token("if")]
    If,
    #[token("else")]
    Else,
    #[token("said")]
    Said,
    #[token("inc")]
    Inc,
    #[token("entry")]
    Entry,
    #[token("mm")]
    Mm,
    #[token("inch")]
    Inch,
    #[token("absolute")]
    Absolute,
    #[token("incremental")]
    Incremental,
    #[token("per-minute")]
    PerMinute,
    #[token("per-revolution")]
    PerRevolution,
    #[token("inverse-time")]
    InverseTime,
    #[token("initial")]
    Initial,
    #[token("retract")]
    Retract,
    #[token("clockwise")]
    Clockwise,
    #[token("counterclockwise")]
    Counterclockwise,
    #[token("shift")]
    Shift,
    #[token("local")]
    Local,
    #[token("rotation")]
    Rotation,
    #[token("scale")]
    Scale,
    #[token("mirror")]
    Mirror,
    #[token("polar")]
    Polar,
    #[token("tilt")]
    Tilt,
    #[token("chain")]
    Chain,
    #[token("centre")]
    Centre,
    #[token("start")]
    Start,
    #[token("zero")]
    Zero,
    #[token("radius")]
    Radius,
    #[token("turns")]
    Turns,
    #[token("reference")]
    Reference,
    #[token("return-plane")]
    ReturnPlane,
    #[token("about")]
    About,
    #[token("no-length")]
    NoLength,
    #[token("keeps-length")]
    KeepsLength,
    #[token("home")]
    Home,
    #[token("further")]
    Further,
    #[token("fixed")]
    Fixed,
    #[token("stored")]
    Stored,
    #[token("via")]
    Via,
    #[token("added")]
    Added,
    #[token("length", |_| ToolValue::Length)]
    #[token("length-wear", |_| ToolValue::LengthWear)]
    #[token("tool-radius", |_| ToolValue::Radius)]
    #[token("tool-radius-wear", |_| ToolValue::RadiusWear)]
    #[token("x-offset", |_| ToolValue::OffsetX)]
    #[token("y-offset", |_| ToolValue::OffsetY)]
    ToolValue(ToolValue),
    #[token("angle")]
    Angle,
    #[token("offset")]
    Offset,
    #[token("pitch")]
    Pitch,
    #[token("translate")]
    Translate,
    #[token("rotate")]
    Rotate,
    #[token("merged")]
    Merged,
    #[token("through")]
    Through,
    #[token("tangent")]
    Tangent,
    #[token("at-feed")]
    AtFeed,
    #[token("lift")]
    Lift,
    #[token("pause")]
    Pause,
    #[token("less")]
    LessBy,
    #[token("settle")]
    Settle,
    #[token("drill-break")]
    DrillBreak,
    #[token("feed-out")]
    FeedOut,
    #[token("drill")]
    Drill,
    #[token("drill-dwell")]
    DrillDwell,
    #[token("drill-peck")]
    DrillPeck,
    #[token("bore")]
    Bore,
    #[token("to-level")]
    ToLevel,
    #[token("back")]
    Back,
    #[token("tap")]
    Tap,
    #[token("tap-rigid")]
    TapRigid,
    #[token("bore-fine")]
    BoreFine,
    #[token("bore-stop")]
    BoreStop,
    #[token("chuck")]
    Chuck,
    #[token("after")]
    After,
    #[token("as-before")]
    AsBefore,
    #[token("stopped")]
    Stopped,
    #[token("program-stop")]
    ProgramStopWord,
    #[token("along")]
    AlongWord,
    #[token("SYNCHRONISED_FEED")]
    SynchronisedFeed,
    #[token("ORIENT_SPINDLE")]
    OrientSpindle,
    #[token("dwell")]
    DwellWord,
    #[token("peck")]
    Peck,
    #[token("clearance")]
    Clearance,
    #[token("parameter")]
    Parameter,
    #[token("depth")]
    Depth,
    #[token("return")]
    ReturnWord,
    #[token("raise-first")]
    RaiseFirst,
    #[token("clear-first")]
    ClearFirst,
    #[token("plane-first")]
    PlaneFirst,
    #[token("retract-first")]
    RetractFirst,
    #[token("feed")]
    Feed,
    #[token("here")]
    Here,
    #[token("first")]
    First,
    #[token("count")]
    Count,
    #[token("columns")]
    Columns,
    #[token("rows")]
    Rows,
    #[token("serpentine")]
    Serpentine,
    #[token("times")]
    TimesWord,
    #[token("shared")]
    Shared,
    #[token("motion")]
    Motion,
    #[token("traverse")]
    Traverse,
    #[token("arc")]
    Arc,
    #[token("cycle")]
    Cycle,
    #[token("distance")]
    Distance,
    #[token("units")]
    Units,
    #[token("plane")]
    Plane,
    #[token("feed-mode")]
    FeedMode,
    #[token("return-level")]
    ReturnLevel,
    #[token("work-offset")]
    WorkOffset,
    #[token("length-offset")]
    LengthOffset,
    #[token("no-origin-shift")]
    NoOriginShift,
    #[token("true", |_| true)]
    #[token("false", |_| false)]
    Bool(bool),

    #[token("DECLARE")]
    Declare,
    #[token("real", |_| Type::Real)]
    #[token("int", |_| Type::Int)]
    #[token("bool", |_| Type::Bool)]
    Type(Type),
    #[token("none")]
    None,
    #[token("of")]
    Of,
    #[token("MESSAGE_OF")]
    MessageOf,
    #[token("OUTPUT")]
    Output,
    #[token("places")]
    Places,
    #[token("digits")]
    Digits,
    #[token("short")]
    Short,
    #[token("ALARM")]
    Alarm,
    #[token("until")]
    Until,
    #[token("vacant")]
    Vacant,
    #[token("not")]
    Not,
    #[token("and")]
    And,
    #[token("or")]
    Or,
    #[token("xor")]
    Xor,
    #[token("mod")]
    Modulo,
    #[token("sin", |_| Function::Sin)]
    #[token("cos", |_| Function::Cos)]
    #[token("tan", |_| Function::Tan)]
    #[token("asin", |_| Function::Asin)]
    #[token("acos", |_| Function::Acos)]
    #[token("atan2", |_| Function::Atan2)]
    #[token("sqrt", |_| Function::Sqrt)]
    #[token("abs", |_| Function::Abs)]
    #[token("round", |_| Function::Round)]
    #[token("roundto", |_| Function::RoundTo)]
    #[token("roundup", |_| Function::RoundUp)]
    #[token("floor", |_| Function::Floor)]
    #[token("ceiling", |_| Function::Ceiling)]
    #[token("truncate", |_| Function::Truncate)]
    #[token("ln", |_| Function::Ln)]
    #[token("exp", |_| Function::Exp)]
    #[token("min", |_| Function::Min)]
    #[token("max", |_| Function::Max)]
    #[token("remainder", |_| Function::Remainder)]
    #[token("given", |_| Function::Given)]
    #[token("near", |_| Function::Near)]
    #[token("nearratio", |_| Function::NearRatio)]
    #[token("bitand", |_| Function::BitAnd)]
    #[token("bitor", |_| Function::BitOr)]
    #[token("bitxor", |_| Function::BitXor)]
    Function(Function),

    /// A name in capitals that is no function's.
    #[regex(r"[A-Z][A-Z0-9_]*", priority = 1)]
    UnknownName,
    /// A word that is no key word.
    #[regex(r"[a-z]+(-[a-z]+)*", priority = 1)]
    UnknownWord,
}
