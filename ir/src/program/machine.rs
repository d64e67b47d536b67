//! Reference points and values of the control's tables, as a program names them.
//!
//! Not here: where those points are, and what the tables hold (`world`).

use super::Point;
use crate::canon::AXES;
use crate::expr::Expr;
use crate::program::tool_value::ToolValue;

/// A reference point to which axes can be sent by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ReferencePoint {
    /// The machine's zero: where a reference point of its axes is that machine coordinates count from.
    Home,
    /// A further reference reference point, 2 to 4.
    Further(u8),
    /// A fixed reference point, 1 to 4.
    Fixed(u8),
    /// A position stored in the control, 1 or 2.
    Stored(u8),
}

/// A rapid move of axes to a reference point.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// Which point.
    pub point: ReferencePoint,
    /// Which axes go there; the others stay.
    pub axes: [bool; AXES],
    /// A point that is reached first, by a rapid move, in program coordinates. No words: from where
    /// the axes stand.
    pub via: Point,
    /// Whether the tool's length is surely active after it. Else, where it moves Z, it is so only
    /// if the program says it again.
    pub keeps_length: bool,
}

/// Which other way than straight a rapid move goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Detour {
    /// Unidirectional positioning: the axes that the move names reach its end from one side, always the same, if
    /// need be from beyond it, and also where they stand there already. The side, and how far beyond, are the
    /// machine's.
    OneSide,
    /// Return from a reference point: the axes that the move names go to the point through which they went
    /// to it last ([`Reference::via`], or where they stood), and from there to the end of the move, whose words
    /// count from program zero.
    Intermediate,
}

impl Detour {
    /// All of them.
    pub const ALL: [Detour; 2] = [Detour::OneSide, Detour::Intermediate];

    /// Its name in texts.
    pub fn name(self) -> &'static str {
        match self {
            Detour::OneSide => "one-side",
            Detour::Intermediate => "intermediate",
        }
    }
}

/// What a probing move looks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Probe {
    /// It ends where contact is lost; else where contact is made.
    pub away: bool,
    /// The control stops with an error where that does not happen on the way; else it goes on at the end of it.
    pub error: bool,
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
        /// By how many degrees the offset is turned about Z from here on, counter-clockwise, between its zero
        /// and the G92 shift; without, as before. A control without such a turn has none ever.
        turn: Option<Expr>,
    },
    /// `STORE_POSITION`: where the axes stand becomes a position stored in the control
    /// ([`ReferencePoint::Stored`]).
    Position(u8),
    /// `SET_TOOL_NUMBER`: the tool in the spindle is the one with this number; nothing is changed or moved, and
    /// the active length stays.
    ToolInSpindle(Expr),
    /// A value of an entry of the table of tools; [`DataMode::Here`] is none of these.
    Tool {
        /// The entry.
        entry: u32,
        /// Which value.
        which: ToolValue,
        /// Whether it is added to the one before.
        added: bool,
        /// Whether what is active of the entry stays as it is until the entry is activated again; else nobody
        /// knows, and such a value for the tool in use is not executed.
        kept: bool,
        /// The value.
        value: Expr,
    },
    /// `MEASURE_TOOL`: offsets of an entry of the table of tools are set so that, as soon as the entry is activated,
    /// the words are the coordinates of where the axes stand. What is active stays until then. An axis without
    /// a word keeps its value along that axis of the work offset.
    Measured {
        /// The entry.
        entry: u32,
        /// In the coordinates of this work offset, without the G92 shift; else in the active ones.
        offset: Option<u16>,
        /// The words, of X, Y and Z alone.
        words: Box<[Option<Expr>; AXES]>,
    },
}

/// A length of the tool that is no entry of the table. It moves nothing, and takes effect as an entry's is.
#[derive(Clone, Debug, PartialEq)]
pub enum ToolLength {
    /// `USE_TOOL_LENGTH`: this length takes the place of the active one.
    Value(Expr),
    /// `ADD_TOOL_LENGTH`: it is added to the active one.
    Added(Expr),
    /// `ADD_TOOL_LENGTH_OFFSET`: the length of an entry of the table is added to the active one.
    AddedEntry(Expr),
    /// `USE_TOOL_OFFSETS`, `ADD_TOOL_OFFSETS`: offsets along X, Y and Z take the place of the active ones, or are added
    /// to them; an axis without a word keeps its own.
    Offsets {
        /// Whether they are added.
        added: bool,
        /// The words, of X, Y and Z alone.
        words: Box<[Option<Expr>; AXES]>,
    },
}

/// By which radius a contour is compensated. In general it is no length: what stands in the control's
/// tables is the operator's.
#[derive(Clone, Debug, PartialEq)]
pub enum CutterRadius {
    /// That of an entry of the table of tools; where lengths and radii have tables of their own, of the
    /// table of radii.
    Entry(Expr),
    /// That of the entry with the number of the tool in the spindle.
    Tool,
    /// That of the edge, or of the entry, whose length is active.
    InForce,
    /// Half of a diameter that the program itself states; a negative one makes the other side.
    Diameter(Expr),
}
