//! The moves that the simulation cuts: lines and arcs of the tool tip, with tool, time and line.
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
        /// First and second axis of its plane, and the axis normal to it: 0 is X, 1 is Y, 2 is Z. On a tilted plane these are
        /// the axes of that.
        plane: [u8; 3],
        /// Its centre along the first and the second axis, mm, from the zero of the part.
        centre: [f64; 2],
        /// Angle from start to end, radians; positive from the first axis towards the second.
        sweep: f64,
    },
}

/// A move of the tool tip, in workpiece coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    /// Its path.
    pub way: Way,
    /// End point X Y Z, mm.
    pub end: [f64; 3],
    /// Index of the tool in [`Setup::tools`](crate::Setup::tools).
    pub tool: usize,
    /// The tilted plane on which the tool stands upright: 1 is the first of [`Setup::tilts`](crate::Setup::tilts), 0 none.
    pub tilt: u16,
    /// Whether the spindle turns.
    pub turns: bool,
    /// End of the move, seconds from the start of the program.
    pub time: f64,
    /// Line of the program, from 1; 0 if not known.
    pub line: u32,
}

/// Directions of X, Y and Z of a tilted plane, as columns, in workpiece coordinates: unit vectors at right angles. The tool
/// stands along the third.
pub type Axes = [[f64; 3]; 3];

/// A place along the axes of a plane in workpiece coordinates; both from one zero.
pub fn turned(axes: &Axes, at: [f64; 3]) -> [f64; 3] {
    axes.map(|row| row[0] * at[0] + row[1] * at[1] + row[2] * at[2])
}

/// A place in workpiece coordinates along the axes of a plane; both from one zero.
pub fn turned_back(axes: &Axes, at: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|n: usize| axes[0][n] * at[0] + axes[1][n] * at[1] + axes[2][n] * at[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Programs have millions of moves.
    #[test]
    fn a_move_is_small() {
        assert_eq!(size_of::<Move>(), 80);
    }
}
