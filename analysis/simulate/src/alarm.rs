//! Alarms: collisions, and cuts that the tool cannot make.

/// Kinds of alarms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum AlarmKind {
    /// The tool goes through material in rapid.
    Rapid,
    /// It cuts with the spindle stopped.
    Stopped,
    /// Material reaches above the flutes.
    Flute,
    /// The shank is in material.
    Shank,
    /// The holder is in material.
    Holder,
    /// Tool, shank or holder are in a fixture.
    Fixture,
    /// The tip is below the table.
    Table,
}

impl AlarmKind {
    /// All of them, in the order in which a list has them.
    pub const ALL: [AlarmKind; 7] = [
        AlarmKind::Rapid,
        AlarmKind::Stopped,
        AlarmKind::Flute,
        AlarmKind::Shank,
        AlarmKind::Holder,
        AlarmKind::Fixture,
        AlarmKind::Table,
    ];

    /// Its stable name, as JSON has it.
    pub fn name(self) -> &'static str {
        match self {
            AlarmKind::Rapid => "rapid-in-stock",
            AlarmKind::Stopped => "spindle-stopped",
            AlarmKind::Flute => "deeper-than-flute",
            AlarmKind::Shank => "shank-in-stock",
            AlarmKind::Holder => "holder-in-stock",
            AlarmKind::Fixture => "fixture",
            AlarmKind::Table => "table",
        }
    }
}

/// Something that must not happen: one move, or several one after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Alarm {
    /// What.
    pub kind: AlarmKind,
    /// Number of the first move, from 1.
    pub first: u32,
    /// Number of the last one.
    pub last: u32,
    /// The tool, by its place in [`Setup::tools`](crate::Setup::tools).
    pub tool: usize,
    /// Line of the first move; 0 if not known.
    pub line: u32,
    /// When the first move is over, seconds.
    pub time: f64,
    /// X Y Z in mm: the deepest place of a collision; of a cut without spindle or above the flutes, one cell of it.
    pub place: [f64; 3],
    /// How deep there, mm.
    pub depth: f64,
    /// Whether it rests on a tool or a stock that is a guess.
    pub guessed: bool,
}
