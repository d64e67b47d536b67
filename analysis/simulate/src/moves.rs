//! Moves as the kernel takes them.

/// How the tool goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way {
    /// Where it does not matter: it cuts nothing, and nothing is looked at.
    Away,
    /// Straight, in rapid.
    Rapid,
    /// Straight, at feed.
    Feed,
    /// Along an arc or a helix, at feed.
    Arc {
        /// Axes of its plane, first and second, and the normal: 0 is X, 1 is Y, 2 is Z.
        plane: [usize; 3],
        /// Its centre along the first and the second axis, mm.
        centre: [f64; 2],
        /// Angle from start to end, radians: above zero from the first axis to the second.
        sweep: f64,
    },
}

/// A move of the tool's tip, in workpiece coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    /// How it goes.
    pub way: Way,
    /// Where it ends, X Y Z in mm.
    pub end: [f64; 3],
    /// The tool, by its place in [`Setup::tools`](crate::Setup::tools).
    pub tool: usize,
    /// Whether the spindle turns.
    pub turns: bool,
    /// When it is over, seconds from the start of the program.
    pub time: f64,
    /// Line of the program, from 1; 0 if not known.
    pub line: u32,
}
