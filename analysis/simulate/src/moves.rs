//! The moves that the simulation cuts: lines and arcs of the tool's tip, with tool, time and line.
//!
//! Not here: making them from the events of an execution.

/// The path of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way {
    /// Nothing is cut and nothing is looked at: the place says nothing of the part.
    Away,
    /// A line at rapid.
    Rapid,
    /// A line at feed.
    Feed,
    /// An arc or a helix at feed.
    Arc {
        /// First and second axis of its plane, and the axis normal to it: 0 is X, 1 is Y, 2 is Z.
        plane: [u8; 3],
        /// Its centre along the first and the second axis, mm.
        centre: [f64; 2],
        /// Angle from start to end, radians; positive from the first axis towards the second.
        sweep: f64,
    },
}

/// A move of the tool's tip, in workpiece coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    /// Its path.
    pub way: Way,
    /// End point X Y Z, mm.
    pub end: [f64; 3],
    /// Index of the tool in [`Setup::tools`](crate::Setup::tools).
    pub tool: usize,
    /// Whether the spindle turns.
    pub turns: bool,
    /// End of the move, seconds from the start of the program.
    pub time: f64,
    /// Line of the program, from 1; 0 if not known.
    pub line: u32,
}
