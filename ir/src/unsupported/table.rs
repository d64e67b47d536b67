//! What ncc does not translate: tool tables, offsets and stored positions.

use crate::reason::reasons;

reasons! {
    /// What ncc does not translate: tool tables, offsets and stored positions.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum TableUnsupported {
        /// Ncc does not know this kind of data input.
        Kind,
        /// Data input while a canned cycle may be active.
        InCycle,
        /// Does this value replace the old one, or add to it?
        UnknownMode,
        /// A work offset from the position, with a rotation.
        TurnFromPosition,
        /// The active work offset is not known.
        UnknownOffset,
        /// Ncc does not translate entry 0.
        NoEntryZero,
        /// This entry does not exist.
        NoEntry,
        /// The entry active at the start is not known.
        EntryAtStart,
        /// The number of the entry is a run-time value.
        EntryComputed,
        /// This code in a block with axis words.
        StoredWithAxes,
        /// This position is stated to be machine zero.
        StoredZero,
        /// An H number and axis words in one block.
        LengthWithAxes,
        /// A tool offset along a rotary axis.
        OffsetAxis,
        /// A tool value other than its offsets in X, Y and Z.
        OtherValue,
        /// The number of this entry may be anything.
        AnyEntry,
        /// The program begins again with another T or H.
        SeveralStarts,
        /// This code and a move in one block.
        LengthBesideMove,
        /// Two computed table entries in one assignment.
        TwoComputed,
        /// Two computed table entries in one block.
        TwoComputedHere,
        /// A computed table entry that is no value.
        NoValue,
        /// A computed table entry beside other words.
        BesideWords,
        /// A computed table entry in a word or a condition.
        InWord,
        /// A tool edge and a move before the tool change.
        EdgeBeforeChange,
        /// A tool with this name.
        ToolName,
        /// The active work offset changes but is not called again.
        OffsetNotCalled,
        /// A table value while a canned cycle is active.
        TableInCycle,
        /// A table value in inches.
        TableInInches,
        /// An origin by values after a move.
        OriginAfterMove,
        /// Origins by number and by values in one program.
        OriginByBoth,
    }
}
