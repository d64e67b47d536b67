//! Kinds of statements that some controls refuse under cutter compensation, as data of a refusal.

/// A kind of statement that some controls refuse there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// How corners are taken.
    Path,
    /// Where cycles leave the tool.
    ReturnLevel,
    /// A work offset, the active one too.
    WorkOffset,
    /// A tool length offset, the active one too.
    Length,
    /// A local shift, or its end.
    LocalShift,
    /// The operator's switches.
    Overrides,
}

/// What the source's control refuses under cutter compensation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CompensationRefusal {
    /// A code, by its text.
    Code {
        /// The text.
        code: Box<str>,
    },
    /// A kind of statement.
    Kind(Kind),
}
