//! What is known of the machine, and what could not be checked because it is not.

use ncc_exec::world::Tables;
use ncc_ir::canon::{AXES, Axis};
use ncc_ir::expr::num::Nanos;

/// Facts of a machine that rules hold a program against, each as far as it is stated.
#[derive(Clone, Debug, Default)]
pub struct Limits {
    /// Whether a machine is named at all.
    pub machine: bool,
    /// Least and greatest machine coordinate of each axis, nanos.
    pub travel: [Option<[Nanos; 2]>; AXES],
    /// Highest feed along the path, nanos of mm/min.
    pub max_feed: Option<Nanos>,
    /// Highest feed of each axis, nanos of mm/min or degrees/min.
    pub axis_feed: [Option<Nanos>; AXES],
    /// Highest speed of the spindle, nanos of rev/min.
    pub max_speed: Option<Nanos>,
    /// Plane below which no rapid may go: Z in program coordinates, nanos.
    pub rapid_plane: Option<Nanos>,
    /// Work offsets and lengths.
    pub tables: Tables,
    /// Whether the operator sets the zero of Z by each tool, so that no length is activated.
    pub no_lengths: bool,
}

/// What was not checked, and why.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Unchecked {
    /// Travel, feeds and speeds: no machine is named.
    NoMachine,
    /// Rapids: no plane is named.
    NoPlane,
    /// Travel of an axis that moves: the machine's is not stated.
    Travel(u8),
    /// Travel of an axis: the zero of the work offset is not stated along it.
    Offset(u16, u8),
    /// Travel of Z: the length of the entry (or of the tool, whose edge it is) is not stated.
    Length(i64),
    /// Travel of an axis: blocks before were not read, so that it is not known where zero is.
    Frame(u8),
    /// Travel of an axis: it moves from a place that the program does not say.
    Start(u8),
    /// Travel of an axis: points are those of the tool tip, or of a tilted plane.
    Tilted(u8),
    /// Feeds: the highest is not stated.
    MaxFeed,
    /// Speeds: the highest is not stated.
    MaxSpeed,
    /// All that needs execution, from a place on: it does not end.
    Endless,
}

impl Unchecked {
    /// The axis of an index that stands in it.
    pub fn axis(index: u8) -> Axis {
        Axis::ALL.get(usize::from(index)).copied().unwrap_or(Axis::Z)
    }
}
