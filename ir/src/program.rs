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

use crate::canon::{AXES, Axis, Distance, Fact, FeedMode, Modes, Plane, ReturnLevel, Turn, Units};
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
    /// Block-skip level, 1 to 9: not executed while that switch is on. Every statement of the
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
    /// A temporary re-definition of program zero, or local shift.
    Shift,
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
    pub const ALL: [FrameSlot; 7] = [
        FrameSlot::Shift,
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
    /// `SET_FRAME`: fills a slot; the arguments' meaning belongs to the slot. Not executed yet.
    SetFrame(FrameSlot, Vec<Expr>),
    /// `STOP_CUTTER_RADIUS_COMPENSATION`
    StopCutterRadiusCompensation,

    /// `SET_FEED_RATE`: mm/min or inch/min under [`FeedMode::PerMinute`].
    SetFeedRate(Expr),
    /// `SET_SPINDLE_SPEED`: rev/min.
    SetSpindleSpeed(Expr),
    /// `SELECT_TOOL`
    SelectTool(Expr),
    /// `CHANGE_TOOL`: to the selected tool.
    ChangeTool,
    /// `USE_TOOL_LENGTH_OFFSET`: entry of the length table, 0 for none. Moves nothing; taken up
    /// with the next move of the drilling axis (Z).
    UseToolLengthOffset(Expr),
    /// `START_SPINDLE_CLOCKWISE`
    StartSpindleClockwise,
    /// `START_SPINDLE_COUNTERCLOCKWISE`
    StartSpindleCounterclockwise,
    /// `STOP_SPINDLE_TURNING`
    StopSpindleTurning,
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
    /// `ARC_FEED`
    ArcFeed(Box<Arc>),
    /// `POSITION`: axis words that do whatever motion is in force.
    Position(Move),

    /// `START_CYCLE`: calls a cycle up; makes no hole yet.
    StartCycle(Box<Cycle>),
    /// `HOLE`: the cycle in force at a position.
    Hole(Move),
    /// `CIRCLE_PATTERN` or `RECTANGULAR_LAYOUT`: the cycle in force at each position.
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
            Op::SetFrame(..) => "SET_FRAME",
            Op::StopCutterRadiusCompensation => "STOP_CUTTER_RADIUS_COMPENSATION",
            Op::SetFeedRate(_) => "SET_FEED_RATE",
            Op::SetSpindleSpeed(_) => "SET_SPINDLE_SPEED",
            Op::SelectTool(_) => "SELECT_TOOL",
            Op::ChangeTool => "CHANGE_TOOL",
            Op::UseToolLengthOffset(_) => "USE_TOOL_LENGTH_OFFSET",
            Op::StartSpindleClockwise => "START_SPINDLE_CLOCKWISE",
            Op::StartSpindleCounterclockwise => "START_SPINDLE_COUNTERCLOCKWISE",
            Op::StopSpindleTurning => "STOP_SPINDLE_TURNING",
            Op::FloodOn => "FLOOD_ON",
            Op::MistOn => "MIST_ON",
            Op::CoolantOff => "COOLANT_OFF",
            Op::Dwell(_) => "DWELL",
            Op::StraightTraverse(_) => "STRAIGHT_TRAVERSE",
            Op::StraightFeed(_) => "STRAIGHT_FEED",
            Op::ArcFeed(_) => "ARC_FEED",
            Op::Position(_) => "POSITION",
            Op::StartCycle(_) => "START_CYCLE",
            Op::Hole(_) => "HOLE",
            Op::Pattern(pattern) => match **pattern {
                Pattern::Circle { .. } => "CIRCLE_PATTERN",
                Pattern::Grid { .. } => "RECTANGULAR_LAYOUT",
            },
            Op::EndCycle => "END_CYCLE",
            Op::ProgramStop => "PROGRAM_STOP",
            Op::OptionalProgramStop => "OPTIONAL_PROGRAM_STOP",
            Op::ProgramEnd => "PROGRAM_END",
            Op::Message(_) => "MESSAGE",
            Op::Call(_) => "CALL",
            Op::Return => "RETURN",
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
