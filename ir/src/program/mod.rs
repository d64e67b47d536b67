//! `Program`: what a part program says.
//!
//! Procedures of statements. A statement is a canonical machining function, a cycle, a pattern of
//! positions, control, or an assignment; it knows its place in the source, and may have a block
//! number, a skip level and a comment. Statements with `joined` stand in the same block as the one
//! before, so that a back-end can keep blocks together.
//!
//! Coordinates are in the program's own frame; frames are named slots, never baked in. Modal facts
//! are [`Fact`](crate::canon::Fact)s: a statement says what it means as far as its own procedure knows it.
//!
//! Not here: block layout, number formats, the spelling of any control.

pub mod arguments;
pub mod cycle;
pub mod kinds;
pub mod line_table;
pub mod numbered;
pub mod packed;
pub mod packing;
pub mod rows;
pub mod shapes;
pub mod valid;

mod arc;
mod frame;
mod lines;
mod machine;
mod moves;
mod op_name;
mod polar;
pub(crate) mod text;
pub(crate) mod tool_value;

pub use arc::{Arc, ArcForm, Centre, CentreFrom, Shape, Turns};
pub use frame::{Frame, FrameSlot, FrameStep, Slot, Tilt, Toward};
pub use lines::Lines;
pub use machine::{CutterRadius, Data, DataMode, Detour, Probe, Reference, ReferencePoint, ToolLength};
pub use moves::{Coord, Move, PathControl, Pitch, Point, Synchronised};
pub use polar::{Polar, PoleFrom, PoleWords, SetPole};
pub use text::Text;
pub use tool_value::ToolValue;

use std::collections::HashMap;
use std::sync::Arc as Shared;

use crate::canon::{
    AXES, AdviceKind, CornerShape, Distance, FeedMode, Modes, Plane, ReturnLevel, RotaryWay, Side,
    SpindleMode, Units,
};
pub use crate::computed::alarm_texts::NO_SUCH_BLOCK;
use crate::expr::{Expr, Target, Var};
pub use crate::operator_text::{Alarm, Output, Piece};
use crate::program::cycle::{Cycle, Pattern};
use crate::program::packed::PackedLines;
use crate::source::Span;

/// A part program: the main procedure first, then its subprograms.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// What the text calls it.
    pub name: ProgramName,
    /// Facts that were assumed because the program relies on them and never says them.
    pub assumed: Modes,
    /// `procedures[0]` is the main procedure.
    pub procedures: Vec<Procedure>,
}

impl Program {
    /// Places in `procedures` of all but the main procedure, by their names; of several with one name the first counts.
    pub fn by_name(&self) -> HashMap<&str, usize> {
        let named = self.procedures.iter().enumerate().skip(1).rev();
        named.map(|(place, procedure)| (&*procedure.name, place)).collect()
    }
}

/// The program's own number and title.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ProgramName {
    /// A number such as Fanuc's O word, if the text has one.
    pub number: Option<u32>,
    /// A title, if the text has one.
    pub title: Option<Text>,
}

/// A procedure: the main program, a subprogram or a macro.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Procedure {
    /// By what it is called; for the main procedure, its number as text, or empty.
    pub name: Text,
    /// A title, if it has one.
    pub title: Option<Text>,
    /// Parameters, in the order of a call's arguments. One that all procedures see is the caller's variable itself: the
    /// call gives it that variable's value, and an assignment after the call, in its block, gives it back.
    pub parameters: Vec<Var>,
    /// What the parameters hold, in their order, where that is stated; else any number. A call has converted what it
    /// hands over.
    pub kinds: Vec<Type>,
    /// What is said of it as a whole, in the order in which it is stated.
    pub attributes: Vec<Attribute>,
    /// What it does.
    pub body: Vec<Stmt>,
}

/// What is said of a procedure as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Attribute {
    /// `gives-back`: after each call the modes, the work offset and the chain of frames are those that were active
    /// before it. The statements that say so stand there (the pass `restored_modes`).
    GivesBack,
    /// `runs-through`: advice to stop after none of its blocks where the operator has the control stop after each.
    RunsThrough,
    /// `not-shown`: advice not to show its blocks.
    NotShown,
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

/// Blocks that are executed again.
#[derive(Clone, Debug, PartialEq)]
pub struct RepeatBlocks {
    /// Label where they begin: the last one of that name before this statement.
    pub from: Text,
    /// Label where they end, its own block included; without, they end before this statement.
    pub to: Option<Text>,
    /// How many times, after they have been passed once: a whole number; one that is computed is 1 or more.
    pub times: Expr,
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
    /// `SET_SHIFT`, `SET_ROTATION`, `SET_SCALE`, `SET_MIRROR`, `CLEAR_MIRROR`, `SET_TILT`: fills a slot of the
    /// coordinate chain.
    SetSlot(Box<Slot>),
    /// `SET_POSITION`: from here on, the present point has these coordinates in the work offset with the
    /// G92 shift, which is changed so; the local shift of the axes named is over.
    SetPosition(Box<[Option<Expr>; AXES]>),
    /// `USE_ORIGIN_SHIFT`: off, no G92 shift is active from here on, and its numbers are kept; on, it
    /// is again what it was then. What is said of it in between takes the place of what was kept.
    UseOriginShift(bool),
    /// `USE_MACHINE_COORDINATES`: words of the straight move that follows in this block are machine
    /// coordinates; work offset and frames are off for it.
    UseMachineCoordinates {
        /// Whether the tool's length stays; else it is off for the block too.
        length: bool,
    },
    /// `PROBE`: the straight move at feed that follows in this block is NIST's `STRAIGHT_PROBE`: it ends where
    /// the probe triggers. Where that is, along the axes that it names, no program knows.
    Probe(Probe),
    /// `DETOUR`: the rapid straight move that follows in this block goes another way than straight.
    Detour(Detour),
    /// `USE_TOOL_CENTRE_POINT`: whether points are those of the tool tip, which the control keeps there
    /// while rotary axes turn the tool or the work. Moves nothing. Where the axes stand in the program's
    /// coordinates after it, the machine alone knows.
    UseToolCentrePoint(bool),
    /// `ORIENT_TOOL_AXIS`: rotary axes go to where the tool is upright on the tilted plane. Which way,
    /// and what the linear axes do meanwhile, is the machine's.
    OrientToolAxis(Option<Toward>),
    /// `SET_OFFSET_DATA` or `SET_TOOL_DATA`: puts values into the control's tables.
    SetData(Box<Data>),
    /// `START_CUTTER_RADIUS_COMPENSATION`: from the next move in the plane on, the programmed contour is
    /// that of the work, and the tool goes beside it by its radius.
    StartCutterRadiusCompensation {
        /// On which side of it.
        side: Side,
        /// By which radius.
        radius: CutterRadius,
    },
    /// `STOP_CUTTER_RADIUS_COMPENSATION`
    StopCutterRadiusCompensation,
    /// `SET_MOTION_CONTROL_MODE`: how corners are taken from here on.
    SetMotionControlMode(Box<PathControl>),
    /// `EXACT_STOP`: the move that follows in this block ends in an exact stop.
    ExactStop,
    /// `TURN_ROTARY_AXES`: the direction in which A, B and C turn in the straight move that follows in this block, whose
    /// words say angles of one turn for them. Where the axis then stands is that angle.
    TurnRotaryAxes([Option<RotaryWay>; 3]),
    /// `ROUND_CORNER`, `CHAMFER_CORNER` or `CHAMFER_CORNER_BY_LENGTH`: the corner between the move that follows
    /// in this block and the next one of the plane is rounded or chamfered. Both are programmed to the
    /// corner itself.
    Corner {
        /// How.
        shape: CornerShape,
        /// By which length.
        size: Expr,
    },
    /// `ADVISE`: a word for the control's own conduct, without effect on what the program says.
    Advise(Box<Advice>),

    /// `SET_FEED_RATE`: mm/min or inch/min under [`FeedMode::PerMinute`], mm or inch a turn under
    /// [`FeedMode::PerRevolution`], turns of the clock's minute (a pure number) under
    /// [`FeedMode::InverseTime`], and then for one move. A change of the feed mode takes the feed away.
    SetFeedRate(Expr),
    /// `SET_SPINDLE_SPEED`: rev/min, or under [`SpindleMode::Surface`] the surface speed in m/min, in inches in
    /// ft/min.
    SetSpindleSpeed(Expr),
    /// `SET_SPINDLE_MODE`: what the speed counts. A change takes the speed away: what a control makes of the
    /// one before differs, and a turning spindle needs another before anything moves.
    SetSpindleMode(SpindleMode),
    /// `LIMIT_SPINDLE_SPEED`: no more than so many rev/min under a surface speed, from here on. Whether it
    /// counts for a speed in rev/min as well differs (a Sinumerik's does under G97, those of a Fanuc and of
    /// LinuxCNC do not), so a spindle that turns is given no speed above it.
    LimitSpindleSpeed(Expr),
    /// `SELECT_TOOL`
    SelectTool(Expr),
    /// `SELECT_TOOL_BY_NAME`
    SelectToolByName(Text),
    /// `CHANGE_TOOL`: to the selected tool.
    ChangeTool,
    /// `USE_TOOL_LENGTH_OFFSET`: entry of the length table, 0 for none. Moves nothing; applied
    /// with the next move of the drilling axis (Z).
    UseToolLengthOffset(Expr),
    /// `USE_TOOL_LENGTH`, `ADD_TOOL_LENGTH`, `ADD_TOOL_LENGTH_OFFSET`: a length that is no entry of the table.
    UseToolLength(Box<ToolLength>),
    /// `USE_TOOL_EDGE`: length of an edge of the tool in the spindle, 0 for none. Moves nothing;
    /// applied with the next move of the drilling axis (Z). Edge 1 of a tool is the entry of the
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
    /// `MACHINE_FUNCTION`: switches something of the machine that no dialect supports, by a name
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
    /// `GO_TO_REFERENCE`: rapid move to a reference point. What bare axis words do afterwards is
    /// as before it.
    GoToReference(Box<Reference>),
    /// `ARC_FEED`
    ArcFeed(Box<Arc>),
    /// `ARC_BY_ANGLE`, `ARC_ABOUT_BY_ANGLE`, `ARC_ABOUT`, `ARC_THROUGH`, `ARC_TANGENT`: arcs in other
    /// forms.
    ArcForm(Box<ArcForm>),
    /// `SET_POLE`: about which point polar words are.
    SetPole(Box<SetPole>),
    /// `POLAR`: a move to a point by radius and angle.
    Polar(Box<Polar>),
    /// `POSITION`: axis words that do whatever motion is active.
    Position(Move),
    /// A stretch of straight moves and feeds, for which statements in front of it and after it stand
    /// ([`PackedLines`]). No text has it: it is written as its statements.
    Lines(Shared<PackedLines>),

    /// `START_CYCLE`: calls a cycle up; makes no hole yet.
    StartCycle(Box<Cycle>),
    /// `HOLE`: the active cycle at a position.
    Hole(Move),
    /// `CIRCLE_PATTERN`, `LINE_PATTERN`, `RECTANGULAR_LAYOUT` or `POSITION_LIST`: the active cycle
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
    /// `BEGIN_AGAIN`: the main program begins again, for ever. Nothing of the control is reset.
    BeginAgain,
    /// `MESSAGE`: text for the operator.
    Message(Text),
    /// `MESSAGE_OF`: text for the operator with values in it.
    MessageOf(Box<[Piece]>),
    /// `OPEN_OUTPUT`, `OUTPUT`, `CLOSE_OUTPUT`: text for a device.
    Output(Box<Output>),
    /// `ALARM`: the program ends with an alarm for the operator; what turns goes on turning or not, as the machine
    /// will have it.
    Alarm(Box<Alarm>),

    /// `CALL`
    Call(Box<Call>),
    /// `RETURN`
    Return,
    /// `REPEAT_BLOCKS`: blocks from a label to here, or to another label, again.
    RepeatBlocks(Box<RepeatBlocks>),
    /// Assignment.
    Assign(Target, Expr),
    /// `DECLARE`: a variable, or an array, that has its first values from here on, each time it is executed.
    Declare(Box<Declare>),
    /// Structured control.
    Control(Box<Control>),
    /// `GOTO` a label.
    Goto(Text),
    /// A label, the target of jumps.
    Label(Text),
    /// `LEAVE`: goes after the innermost body that is executed again and again.
    Leave,
    /// `NEXT_TURN`: goes to its next turn.
    NextTurn,
}

impl Op {
    /// Whether a length is activated, or off, which many controls apply with the next command of Z.
    pub const fn calls_length(&self) -> bool {
        matches!(self, Op::UseToolLengthOffset(_) | Op::UseToolLength(_) | Op::UseToolEdge { .. })
    }

    /// The move itself, where its point is polar; else the operation.
    pub fn unwrapped(&self) -> &Op {
        match self {
            Op::Polar(polar) => &polar.op,
            op => op,
        }
    }
}

/// A variable that is made known.
#[derive(Clone, Debug, PartialEq)]
pub struct Declare {
    /// Which.
    pub var: Var,
    /// What it holds.
    pub kind: Type,
    /// Of an array, how many elements in each direction.
    pub sizes: Box<[u32]>,
    /// First values, of the elements one after the other; what has none is zero.
    pub initial: Vec<Option<Expr>>,
}

/// What a variable holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type {
    /// A number.
    Real,
    /// A whole number.
    Int,
    /// 1 or 0.
    Bool,
}

impl Type {
    /// Its name in text.
    pub const fn name(self) -> &'static str {
        match self {
            Type::Real => "real",
            Type::Int => "int",
            Type::Bool => "bool",
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
    /// Whether the procedure has its caller's local variables (Fanuc's `M98`); else it has its own (`G65`).
    pub shared: bool,
}

/// Structured control.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)] // The field names are the meaning.
pub enum Control {
    /// The body, a number of times.
    Repeat { times: Expr, body: Vec<Stmt> },
    /// Endless, left by a jump or the program's end.
    Loop { body: Vec<Stmt> },
    /// Tested before each iteration.
    While { condition: Expr, body: Vec<Stmt> },
    /// Tested after each iteration, and left when it holds.
    Until { condition: Expr, body: Vec<Stmt> },
    /// Counted.
    For { variable: Var, from: Expr, to: Expr, step: Expr, body: Vec<Stmt> },
    /// One or the other.
    If { condition: Expr, then: Vec<Stmt>, otherwise: Vec<Stmt> },
}

impl Control {
    /// Its bodies: of a branch what is executed where it holds and where it does not, else the one.
    pub fn bodies(&self) -> impl Iterator<Item = &Vec<Stmt>> {
        let (first, second) = match self {
            Control::Repeat { body, .. }
            | Control::Loop { body }
            | Control::While { body, .. }
            | Control::Until { body, .. }
            | Control::For { body, .. } => (body, None),
            Control::If { then, otherwise, .. } => (then, Some(otherwise)),
        };
        std::iter::once(first).chain(second)
    }

    /// The same, to be changed.
    pub fn bodies_mut(&mut self) -> impl Iterator<Item = &mut Vec<Stmt>> {
        let (first, second) = match self {
            Control::Repeat { body, .. }
            | Control::Loop { body }
            | Control::While { body, .. }
            | Control::Until { body, .. }
            | Control::For { body, .. } => (body, None),
            Control::If { then, otherwise, .. } => (then, Some(otherwise)),
        };
        std::iter::once(first).chain(second)
    }
}
