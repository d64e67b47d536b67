//! What has a number that another machine may not share.

/// What has a number that another machine may not share.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Numbered {
    /// A tool.
    Tool,
    /// An entry of the length table.
    LengthEntry,
    /// A work offset.
    WorkOffset,
    /// A program or subprogram.
    Program,
}

impl Numbered {
    /// All of them.
    pub const ALL: [Numbered; 4] =
        [Numbered::Tool, Numbered::LengthEntry, Numbered::WorkOffset, Numbered::Program];
}
