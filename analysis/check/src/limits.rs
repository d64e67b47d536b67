//! Machine data for the rules, and the checks that missing data made impossible.
//!
//! Not here: the rules (`rules`), and reading the data from a profile.

use ncc_exec::world::Tables;
use ncc_ir::canon::{AXES, Axis};
use ncc_ir::expr::num::Nanos;

/// Machine data that the rules compare a program with. `None` is not stated.
#[derive(Clone, Debug, Default)]
pub struct Limits {
    /// Whether the user named a machine.
    pub machine: bool,
    /// Least and greatest machine coordinate of each axis, nanos.
    pub travel: [Option<[Nanos; 2]>; AXES],
    /// Highest feed along the path, nanos of mm/min.
    pub max_feed: Option<Nanos>,
    /// Highest feed of each axis, nanos of mm/min or degrees/min.
    pub axis_feed: [Option<Nanos>; AXES],
    /// Highest speed of the spindle, nanos of rev/min.
    pub max_speed: Option<Nanos>,
    /// Lowest Z allowed for a rapid move: program coordinates, nanos.
    pub rapid_plane: Option<Nanos>,
    /// Work offsets and tool lengths.
    pub tables: Tables,
    /// Whether the operator sets Z zero with each tool, so that programs activate no tool length offset.
    pub no_lengths: bool,
}

/// A check that was not possible, and its reason.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Unchecked {
    /// Travel, feeds and speeds: the user named no machine.
    NoMachine,
    /// Rapid moves: the user named no plane.
    NoPlane,
    /// Travel of an axis that moves: the machine data lack it. Holds the axis index.
    Travel(u8),
    /// Travel of an axis: the work offset has no value for it. Holds the offset and the axis index.
    Offset(u16, u8),
    /// Travel of Z: the length is not stated. Holds the number of the table entry, or of the tool.
    Length(i64),
    /// Travel of an axis: ncc did not read the blocks before, so the zero point is unknown. Holds the axis index.
    Frame(u8),
    /// Travel of an axis: its start point is unknown. Holds the axis index.
    Start(u8),
    /// Travel of an axis: TCP or a tilted plane is active. Holds the axis index.
    Tilted(u8),
    /// Feeds: the highest feed is not stated.
    MaxFeed,
    /// Speeds: the highest speed is not stated.
    MaxSpeed,
    /// All rules that need execution: the program does not end.
    Endless,
}

impl Unchecked {
    /// The axis of an index from a variant of this type; Z if the index is out of range.
    pub fn axis(index: u8) -> Axis {
        Axis::ALL.get(usize::from(index)).copied().unwrap_or(Axis::Z)
    }
}
