//! `Program`: what a part program says.
//!
//! Procedures of statements. A statement is a canonical machining function, a cycle, a pattern of
//! positions, control, or an assignment; it knows its place in the source, and may have a block
//! number, a skip level and a comment. Statements with `joined` stand in the same block as the one
//! before, so that a back-end can keep blocks together.
//!
//! Coordinates are in the program's own frame; frames are named slots, never baked in. Modal facts
//! are [`Fact`]s: a statement says what it means as far as its own procedure knows it.
//!
//! Not here: block layout, number formats, the spelling of any control.

use crate::canon::{
    AXES, AdviceKind, Axis, Distance, Fact, FeedMode, Modes, PathMode, Plane, ReturnLevel, SpindleMode, Turn,
    Units,
};
use crate::cycle::{Cycle, Pattern};
use crate::expr::{Expr, Var};
use crate::source::Span;

/// A part program: the main procedure first, then its subprograms.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// What the text calls it.
    pub name: ProgramName,
    /// Facts that were taken for granted because the program relies on them and never says them.
    pub assumed: Modes,
    /// `procedures[0]` is the main procedure.
    pub procedures: Vec<Procedure>,
}

/// The program's own number and title.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ProgramName {
    /// A number such as Fanuc's O word, if the text has one.
    pub number: Option<u32>,
    /// A title, if the text has one.
    pub title: Option<Text>,
}

/// Text of a comment or message, as Unicode. Front-ends decode (UTF-8, else Latin-1).
pub type Text = Box<str>;

/// A procedure: the main program, a subprogram or a macro.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Procedure {
    /// By what it is called; for the main procedure, its number as text, or empty.
    pub name: Text,
    /// A title, if it has one.
    pub title: Option<Text>,
    /// Parameters, in the order of a call's arguments.
    pub parameters: Vec<Var>,
    /// What it does.
    pub body: Vec<Stmt>,
}

/// A statement.
#[derive(Clone, Debug, PartialEq)]
pub struct Stmt {
    /// Where it was written.
    pub span: Span,
    /// Block number, on the first statement of its block.
    pub number: Option<u32>,
    /// Block-skip level, 1 to 10: not executed while that switch is on. Every statement of the
    /// block carries it.
    pub skip: Option<u8>,
    /// Whether it stands in the same block as the statement before.
    pub joined: bool,
    /// A comment that stands in the block, on its last statement.
    pub comment: Option<Box<Text>>,
    /// What it does.
    pub op: Op,
}

impl Stmt {
    /// A statement in a block of its own.
    pub fn new(span: Span, op: Op) -> Stmt {
        Stmt { span, number: None, skip: None, joined: false, comment: None, op }
    }
}

/// A coordinate word.
#[derive(Clone, Debug, PartialEq)]
pub struct Coord {
    /// Its value.
    pub value: Expr,
    /// From where it is measured.
    pub distance: Fact<Distance>,
}

/// The axis words of a move; an axis without a word stays where it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Point {
    /// One place per axis, in the order of [`Axis::ALL`].
    pub axes: [Option<Coord>; AXES],
}

impl Point {
    /// The word of an axis.
    #[inline]
    pub fn get(&self, axis: Axis) -> Option<&Coord> {
        self.axes[axis as usize].as_ref()
    }

    /// Sets the word of an axis.
    pub fn set(&mut self, axis: Axis, coord: Coord) {
        self.axes[axis as usize] = Some(coord);
    }

    /// Whether no axis has a word.
    pub fn is_empty(&self) -> bool {
        self.axes.iter().all(Option::is_none)
    }
}

/// A straight move, or hole position.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Move {
    /// Where to.
    pub to: Point,
    /// Whether the block itself says the motion code. A back-end that inherits it need not.
    pub said: bool,
}

/// A straight move in step with the spindle, as threads are cut.
#[derive(Clone, Debug, PartialEq)]
pub struct Synchronised {
    /// Where to.
    pub to: Point,
    /// How far the axis goes in a turn.
    pub pitch: Pitch,
    /// Whether feed and spindle each go on their own, and a compensating chuck makes good what they
    /// are apart.
    pub chuck: bool,
    /// The sense in which the control turns the spindle for this move, to hold it after; without, it
    /// turns as it does.
    pub turn: Option<Turn>,
}

/// How far an axis goes in one turn of the spindle.
#[derive(Clone, Debug, PartialEq)]
pub enum Pitch {
    /// So far, positive.
    Stated(Expr),
    /// As feed and speed in force say.
    Feed,
}

/// An arc or helix.
#[derive(Clone, Debug, PartialEq)]
pub struct Arc {
    /// Its plane.
    pub plane: Fact<Plane>,
    /// Its sense.
    pub turn: Turn,
    /// End point; words outside the plane make it a helix. No words in the plane, or an end equal
    /// to the start, make a full circle (with [`Centre::Point`]).
    pub to: Point,
    /// Its centre.
    pub centre: Centre,
    /// Full turns made beyond the first, partial one.
    pub turns: u32,
    /// Whether the block itself says the motion code.
    pub said: bool,
}

/// How an arc's centre is given.
#[derive(Clone, Debug, PartialEq)]
pub enum Centre {
    /// Words along X, Y and Z; only the two of the plane count. A missing one is 0 from
    /// [`CentreFrom::Start`], and an error from [`CentreFrom::Zero`].
    Point {
        /// The words (I, J, K).
        words: [Option<Expr>; 3],
        /// From where they are measured.
        from: CentreFrom,
    },
    /// By radius: positive makes an arc of at most 180°, negative of more.
    Radius(Expr),
}

/// An arc given so that its centre, its end or its sense must be computed: not by centre or radius.
#[derive(Clone, Debug, PartialEq)]
pub struct ArcForm {
    /// Its plane.
    pub plane: Fact<Plane>,
    /// End point; words outside the plane make it a helix.
    pub to: Point,
    /// What gives it its shape.
    pub shape: Shape,
    /// Full turns made beyond the first, partial one.
    pub turns: u32,
    /// Whether the block itself says the motion code.
    pub said: bool,
}

/// What gives an arc its shape.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Opening angle in degrees, more than 0 and less than 360, to the end point.
    Angle {
        /// Its sense.
        turn: Turn,
        /// The angle.
        angle: Expr,
    },
    /// Opening angle about a centre: the end point follows, and has no words in the plane.
    AngleAbout {
        /// Its sense.
        turn: Turn,
        /// The angle.
        angle: Expr,
        /// Words along X, Y and Z, each from where its distance says: from program zero
        /// (absolute) or the start of the arc (incremental). A missing one is the start's.
        centre: Box<[Option<Coord>; 3]>,
    },
    /// Centre with words some of which are from program zero and some from the start.
    Mixed {
        /// Its sense.
        turn: Turn,
        /// As of [`Shape::AngleAbout`].
        centre: Box<[Option<Coord>; 3]>,
    },
    /// Through a point between start and end.
    Through(Box<Point>),
    /// Goes on in the direction in which the move before ended.
    Tangent,
}

impl Shape {
    /// The upper-case name in text of an arc in this form.
    pub const fn name(&self) -> &'static str {
        match self {
            Shape::Angle { .. } => "ARC_BY_ANGLE",
            Shape::AngleAbout { .. } => "ARC_ABOUT_BY_ANGLE",
            Shape::Mixed { .. } => "ARC_ABOUT",
            Shape::Through(_) => "ARC_THROUGH",
            Shape::Tangent => "ARC_TANGENT",
        }
    }
}

/// A point of the machine to which axes can be sent by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ReferencePoint {
    /// The machine's zero: where a reference point of its axes is that machine coordinates count from.
    Home,
    /// A further reference point of the machine, 2 to 4.
    Further(u8),
    /// A fixed point of the machine, 1 to 4.
    Fixed(u8),
    /// A position stored in the control, 1 or 2.
    Stored(u8),
}

/// A rapid move of axes to a point of the machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// Which point.
    pub point: ReferencePoint,
    /// Which axes go there; the others stay.
    pub axes: [bool; AXES],
    /// A point that is reached first, by a rapid move, in program coordinates. No words: from where
    /// the axes stand.
    pub via: Point,
    /// Whether the tool's length is surely in force behind it. Else, where it moves Z, it is so only
    /// if the program says it anew.
    pub keeps_length: bool,
}

/// How a program sets a value of the control's tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DataMode {
    /// The value takes the place of the one before.
    Set,
    /// The value is added to the one before.
    Add,
    /// A work offset is set so that the words become the coordinates of where the axes stand.
    Here,
}

/// A value of the table of tools.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ToolValue {
    /// Length, without wear.
    Length,
    /// Wear of the length, which is added to it.
    LengthWear,
    /// Radius, without wear.
    Radius,
    /// Wear of the radius.
    RadiusWear,
}

impl ToolValue {
    /// All values.
    pub const ALL: [ToolValue; 4] =
        [ToolValue::Length, ToolValue::LengthWear, ToolValue::Radius, ToolValue::RadiusWear];
}

/// Values that a program puts into the control's tables.
#[derive(Clone, Debug, PartialEq)]
pub enum Data {
    /// The zero of a work offset (1 is the first), in machine coordinates.
    Offset {
        /// Its number.
        offset: u16,
        /// How.
        mode: DataMode,
        /// The words; an axis without one keeps its value.
        words: Box<[Option<Expr>; AXES]>,
    },
    /// A value of an entry of the table of tools; [`DataMode::Here`] is none of these.
    Tool {
        /// The entry.
        entry: u32,
        /// Which value.
        which: ToolValue,
        /// Whether it is added to the one before.
        added: bool,
        /// The value.
        value: Expr,
    },
}

/// A step of the chain of frames: what it does to the coordinates that follow.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Whether it is appended as the innermost step; else it replaces the chain.
    pub added: bool,
    /// What it does.
    pub step: FrameStep,
}

/// What a step of the chain of frames does.
#[derive(Clone, Debug, PartialEq)]
pub enum FrameStep {
    /// Moves the origin.
    Translate(Box<[Option<Expr>; AXES]>),
    /// Turns in the plane, degrees, counter-clockwise positive.
    Rotate {
        /// The plane.
        plane: Fact<Plane>,
        /// The angle.
        angle: Expr,
    },
    /// Factors along X, Y and Z.
    Scale(Box<[Option<Expr>; 3]>),
    /// Turns the axis round: X, Y, Z.
    Mirror([bool; 3]),
}

/// How corners are taken from here on.
#[derive(Clone, Debug, PartialEq)]
pub struct PathControl {
    /// The mode.
    pub mode: PathMode,
    /// How far from a corner, or from the path, where the mode says that.
    pub within: Option<Expr>,
    /// The same for rapids, where it is another one.
    pub rapids: Option<Expr>,
}

impl PathControl {
    /// A mode without lengths of its own.
    pub fn plain(mode: PathMode) -> PathControl {
        PathControl { mode, within: None, rapids: None }
    }
}

/// A word that advises the control, and changes nothing of what the program says.
#[derive(Clone, Debug, PartialEq)]
pub struct Advice {
    /// What of.
    pub kind: AdviceKind,
    /// Which of the kind's values.
    pub value: u8,
    /// The length that belongs to it, if it has one.
    pub amount: Option<Expr>,
}

impl Advice {
    /// The name of its value.
    pub fn value_name(&self) -> &'static str {
        self.kind.values().get(usize::from(self.value)).copied().unwrap_or("off")
    }
}

/// What a slot of the coordinate chain is given. From the machine towards the program:
/// work offset, [`FrameSlot::Shift`], [`FrameSlot::Local`], rotation, scale, mirror, chain. The centre
/// of a rotation is scaled and mirrored like any point, and an odd number of mirrors in its plane turns
/// its sense round.
#[derive(Clone, Debug, PartialEq)]
pub enum Slot {
    /// `SET_SHIFT`: each axis named has this shift from here on, the others keep theirs.
    Shift {
        /// Whether it is that of the origin ([`FrameSlot::Shift`]); else the local one.
        origin: bool,
        /// The shifts, of which zero is none.
        axes: Box<[Option<Expr>; AXES]>,
    },
    /// `SET_ROTATION`
    Rotation {
        /// Its plane.
        plane: Fact<Plane>,
        /// From program zero along X, Y and Z, of which the two of the plane count; one that is missing
        /// is where the tool stands.
        centre: Box<[Option<Expr>; 3]>,
        /// Degrees, counter-clockwise positive; an increment is added to the angle in force.
        angle: Coord,
    },
    /// `SET_SCALE`
    Scale {
        /// From program zero along X, Y and Z; one that is missing is where the tool stands.
        centre: Box<[Option<Expr>; 3]>,
        /// Factors along X, Y and Z, more than zero; one that is missing is 1.
        factors: Box<[Option<Expr>; 3]>,
    },
    /// `SET_MIRROR`: each axis named is mirrored at this place from here on.
    Mirror(Box<[Option<Expr>; 3]>),
    /// `CLEAR_MIRROR`: the axes named are mirrored no more.
    NoMirror([bool; 3]),
}

impl Slot {
    /// The upper-case name in text of a statement that sets it.
    pub const fn name(&self) -> &'static str {
        match self {
            Slot::Shift { .. } => "SET_SHIFT",
            Slot::Rotation { .. } => "SET_ROTATION",
            Slot::Scale { .. } => "SET_SCALE",
            Slot::Mirror(_) => "SET_MIRROR",
            Slot::NoMirror(_) => "CLEAR_MIRROR",
        }
    }
}

/// Blocks that are executed again.
#[derive(Clone, Debug, PartialEq)]
pub struct RepeatBlocks {
    /// Label where they begin: the last one of that name before this statement.
    pub from: Text,
    /// Label where they end, its own block included; without, they end before this statement.
    pub to: Option<Text>,
    /// How many times, after they have been passed once.
    pub times: u32,
}

/// From where the words of a centre are measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CentreFrom {
    /// From the start point of the arc.
    Start,
    /// From program zero.
    Zero,
}

/// A named slot of the coordinate chain, from the machine towards the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FrameSlot {
    /// A temporary re-definition of program zero.
    Shift,
    /// A local shift.
    Local,
    /// Rotation in the plane.
    Rotation,
    /// Scale factors.
    Scale,
    /// Mirror about a point or line.
    Mirror,
    /// Polar words.
    Polar,
    /// Tilted working plane.
    Tilt,
    /// Frames chained freely, last one innermost.
    Chain,
}

impl FrameSlot {
    /// All slots.
    pub const ALL: [FrameSlot; 8] = [
        FrameSlot::Shift,
        FrameSlot::Local,
        FrameSlot::Rotation,
        FrameSlot::Scale,
        FrameSlot::Mirror,
        FrameSlot::Polar,
        FrameSlot::Tilt,
        FrameSlot::Chain,
    ];
}

/// What a statement does. The upper-case name in each comment is its name in text.
///
/// Within one block the order is that of the statements: settings, feed and speed, tool, spindle
/// and coolant on, dwell, offsets, motion, then spindle and coolant off, stops and end.
#[derive(Clone, Debug, PartialEq)]
pub enum Op {
    /// `COMMENT`: text on its own, no effect.
    Comment(Text),
    /// `NO_EFFECT`: a word whose dictionary row says that no effect is known; the translation
    /// assumes that it has none. The text is the dictionary's name of the row.
    NoEffect(Text),
    /// An empty block.
    Blank,

    /// `USE_LENGTH_UNITS`
    UseLengthUnits(Units),
    /// `SET_DISTANCE_MODE`
    SetDistanceMode(Distance),
    /// `SELECT_PLANE`
    SelectPlane(Plane),
    /// `SET_FEED_MODE`
    SetFeedMode(FeedMode),
    /// `SET_RETURN_LEVEL`: where cycles leave the tool.
    SetReturnLevel(ReturnLevel),
    /// `SET_ORIGIN_OFFSETS`: makes a work offset current; 1 is the first.
    SetOriginOffsets(u16),
    /// `CLEAR_FRAME`: empties a slot of the coordinate chain.
    ClearFrame(FrameSlot),
    /// `SET_FRAME` or `ADD_FRAME`: a step of [`FrameSlot::Chain`].
    SetFrame(Box<Frame>),
    /// `SET_SHIFT`, `SET_ROTATION`, `SET_SCALE`, `SET_MIRROR`, `CLEAR_MIRROR`: fills a slot of the
    /// coordinate chain.
    SetSlot(Box<Slot>),
    /// `SET_POSITION`: from here on, the present point has these coordinates in the work offset with the
    /// shift of the origin, which is changed so; the local shift of the axes named is over.
    SetPosition(Box<[Option<Expr>; AXES]>),
    /// `USE_MACHINE_COORDINATES`: words of the straight move that follows in this block are machine
    /// coordinates; work offset and frames are off for it.
    UseMachineCoordinates {
        /// Whether the tool's length stays; else it is off for the block too.
        length: bool,
    },
    /// `SET_OFFSET_DATA` or `SET_TOOL_DATA`: puts values into the control's tables.
    SetData(Box<Data>),
    /// `STOP_CUTTER_RADIUS_COMPENSATION`
    StopCutterRadiusCompensation,
    /// `SET_MOTION_CONTROL_MODE`: how corners are taken from here on.
    SetMotionControlMode(Box<PathControl>),
    /// `EXACT_STOP`: the move that follows in this block ends in an exact stop.
    ExactStop,
    /// `ADVISE`: a word for the control's own conduct, without effect on what the program says.
    Advise(Box<Advice>),

    /// `SET_FEED_RATE`: mm/min or inch/min under [`FeedMode::PerMinute`], mm or inch a turn under
    /// [`FeedMode::PerRevolution`], turns of the clock's minute (a pure number) under
    /// [`FeedMode::InverseTime`], and then for one move. A change of the feed mode takes the feed away.
    SetFeedRate(Expr),
    /// `SET_SPINDLE_SPEED`: rev/min, or the surface speed under [`SpindleMode::Surface`].
    SetSpindleSpeed(Expr),
    /// `SET_SPINDLE_MODE`: what the speed counts.
    SetSpindleMode(SpindleMode),
    /// `LIMIT_SPINDLE_SPEED`: no more than so many rev/min from here on.
    LimitSpindleSpeed(Expr),
    /// `SELECT_TOOL`
    SelectTool(Expr),
    /// `SELECT_TOOL_BY_NAME`
    SelectToolByName(Text),
    /// `CHANGE_TOOL`: to the selected tool.
    ChangeTool,
    /// `USE_TOOL_LENGTH_OFFSET`: entry of the length table, 0 for none. Moves nothing; taken up
    /// with the next move of the drilling axis (Z).
    UseToolLengthOffset(Expr),
    /// `USE_TOOL_EDGE`: length of an edge of the tool in the spindle, 0 for none. Moves nothing;
    /// taken up with the next move of the drilling axis (Z). Edge 1 of a tool is the entry of the
    /// length table with the tool's number.
    UseToolEdge {
        /// Its number.
        edge: Expr,
        /// Whether the block itself says it; else it comes with the tool.
        said: bool,
    },
    /// `START_SPINDLE_CLOCKWISE`
    StartSpindleClockwise,
    /// `START_SPINDLE_COUNTERCLOCKWISE`
    StartSpindleCounterclockwise,
    /// `STOP_SPINDLE_TURNING`
    StopSpindleTurning,
    /// `ORIENT_SPINDLE`: stops it at an angle in degrees; `None` is the machine's own.
    OrientSpindle(Option<Expr>),
    /// `MACHINE_FUNCTION`: switches something of the machine that no dialect has a word for, by a name
    /// that means the same on every machine. No axis moves, no tool changes.
    MachineFunction(Text),
    /// `FLOOD_ON`
    FloodOn,
    /// `MIST_ON`
    MistOn,
    /// `COOLANT_OFF`: NIST's `FLOOD_OFF` and `MIST_OFF` at once.
    CoolantOff,
    /// `DWELL`: seconds.
    Dwell(Expr),

    /// `STRAIGHT_TRAVERSE`
    StraightTraverse(Move),
    /// `STRAIGHT_FEED`
    StraightFeed(Move),
    /// `SYNCHRONISED_FEED`: NIST's `START_SPEED_FEED_SYNCH`, `STRAIGHT_FEED` and `STOP_SPEED_FEED_SYNCH`
    /// at once.
    SynchronisedFeed(Box<Synchronised>),
    /// `GO_TO_REFERENCE`: rapid move to a point of the machine. What bare axis words do afterwards is
    /// as before it.
    GoToReference(Box<Reference>),
    /// `ARC_FEED`
    ArcFeed(Box<Arc>),
    /// `ARC_BY_ANGLE`, `ARC_ABOUT_BY_ANGLE`, `ARC_ABOUT`, `ARC_THROUGH`, `ARC_TANGENT`: arcs in other
    /// forms.
    ArcForm(Box<ArcForm>),
    /// `POSITION`: axis words that do whatever motion is in force.
    Position(Move),

    /// `START_CYCLE`: calls a cycle up; makes no hole yet.
    StartCycle(Box<Cycle>),
    /// `HOLE`: the cycle in force at a position.
    Hole(Move),
    /// `CIRCLE_PATTERN`, `LINE_PATTERN`, `RECTANGULAR_LAYOUT` or `POSITION_LIST`: the cycle in force
    /// at each position.
    Pattern(Box<Pattern>),
    /// `END_CYCLE`
    EndCycle,

    /// `PROGRAM_STOP`
    ProgramStop,
    /// `OPTIONAL_PROGRAM_STOP`
    OptionalProgramStop,
    /// `PROGRAM_END`
    ProgramEnd,
    /// `MESSAGE`: text for the operator.
    Message(Text),

    /// `CALL`
    Call(Box<Call>),
    /// `RETURN`
    Return,
    /// `REPEAT_BLOCKS`: blocks from a label to here, or to another label, again.
    RepeatBlocks(Box<RepeatBlocks>),
    /// Assignment.
    Assign(Var, Expr),
    /// Structured control.
    Control(Box<Control>),
    /// `GOTO` a label.
    Goto(Text),
    /// A label, the target of jumps.
    Label(Text),
}

impl Op {
    /// Its upper-case name in text; control has lower-case words.
    pub const fn name(&self) -> &'static str {
        match self {
            Op::Comment(_) => "COMMENT",
            Op::NoEffect(_) => "NO_EFFECT",
            Op::Blank => "BLANK",
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
            Op::UseMachineCoordinates { .. } => "USE_MACHINE_COORDINATES",
            Op::SetData(data) => match **data {
                Data::Offset { .. } => "SET_OFFSET_DATA",
                Data::Tool { .. } => "SET_TOOL_DATA",
            },
            Op::GoToReference(_) => "GO_TO_REFERENCE",
            Op::UseToolEdge { .. } => "USE_TOOL_EDGE",
            Op::StopCutterRadiusCompensation => "STOP_CUTTER_RADIUS_COMPENSATION",
            Op::SetMotionControlMode(_) => "SET_MOTION_CONTROL_MODE",
            Op::ExactStop => "EXACT_STOP",
            Op::Advise(_) => "ADVISE",
            Op::SetFeedRate(_) => "SET_FEED_RATE",
            Op::SetSpindleSpeed(_) => "SET_SPINDLE_SPEED",
            Op::SetSpindleMode(_) => "SET_SPINDLE_MODE",
            Op::LimitSpindleSpeed(_) => "LIMIT_SPINDLE_SPEED",
            Op::SelectTool(_) => "SELECT_TOOL",
            Op::SelectToolByName(_) => "SELECT_TOOL_BY_NAME",
            Op::ChangeTool => "CHANGE_TOOL",
            Op::UseToolLengthOffset(_) => "USE_TOOL_LENGTH_OFFSET",
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
            Op::Message(_) => "MESSAGE",
            Op::Call(_) => "CALL",
            Op::Return => "RETURN",
            Op::RepeatBlocks(_) => "REPEAT_BLOCKS",
            Op::Assign(..) => "assignment",
            Op::Control(control) => match **control {
                Control::Repeat { .. } => "repeat",
                Control::Loop { .. } => "loop",
                Control::While { .. } => "while",
                Control::For { .. } => "for",
                Control::If { .. } => "if",
            },
            Op::Goto(_) => "GOTO",
            Op::Label(_) => "LABEL",
        }
    }
}

/// A call of a procedure.
#[derive(Clone, Debug, PartialEq)]
pub struct Call {
    /// Name of the procedure.
    pub name: Text,
    /// How many times, one after the other.
    pub times: u32,
    /// Arguments, for a procedure with parameters.
    pub arguments: Vec<Expr>,
}

/// Structured control.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)] // The field names are the meaning.
pub enum Control {
    /// The body, a number of times.
    Repeat { times: Expr, body: Vec<Stmt> },
    /// Endless, left by a jump or the program's end.
    Loop { body: Vec<Stmt> },
    /// Tested before each turn.
    While { condition: Expr, body: Vec<Stmt> },
    /// Counted.
    For { variable: Var, from: Expr, to: Expr, step: Expr, body: Vec<Stmt> },
    /// One or the other.
    If { condition: Expr, then: Vec<Stmt>, otherwise: Vec<Stmt> },
}
