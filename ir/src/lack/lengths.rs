//! Tool length offsets, as reasons of a refusal.

use crate::reason::reasons;

reasons! {
    /// Tool length offsets that a target lacks.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum LengthsLack {
        /// A length offset.
        Offset,
        /// A length of no table.
        NoTable,
        /// A length offset in a block without Z.
        OffsetWithoutZ,
        /// A tool-length offset without a block that commands Z.
        ToolOffsetWithoutZ,
        /// A tool-length offset with no absolute Z before this.
        ToolOffsetBeforeZ,
        /// The zero of a work offset by where Z stands, with no absolute Z before this: the output calls a length off first.
        ZeroBeforeZ,
        /// A tool's length in another plane than XY.
        OtherPlane,
        /// A tool's length by its value.
        ByValue,
        /// A tool's offsets by their values.
        OffsetsByValue,
        /// An entry of the length table that is not the tool's own.
        NotOwnEntry,
        /// Another length of the tool in the spindle, whose edge counts from its change on.
        LengthInUse,
        /// Entry {entry} of the length table with tool {tool} in the spindle.
        EntryWithTool {
            /// The entry of the table.
            entry: u32,
            /// The number of the tool.
            tool: u32,
        },
        /// Entry {entry} of the length table with a tool that is not known.
        EntryWithUnknownTool {
            /// The entry of the table.
            entry: u32,
        },
        /// Entry {entry} of the length table with another tool in the spindle.
        EntryWithOtherTool {
            /// The entry of the table.
            entry: i64,
        },
        /// A computed length offset.
        Computed,
        /// A computed length offset, where tools go by name.
        ComputedByName,
        /// A move along Z by the length of another tool.
        ZByOtherLength,
        /// An incremental move along Z with which the length of a new tool takes effect.
        IncrementTakesLength,
        /// Moves of one tool along Z with its length and without.
        WithAndWithout,
        /// Z of a work offset, which the operator sets by each tool.
        OffsetSetByOperator,
        /// A tool length that moves Z from a position in machine coordinates.
        FromMachinePlace,
        /// A tool length that moves Z in units that are not known.
        UnitUnknown,
        /// A tool length that moves Z from a coordinate that is not known.
        CoordinateUnknown,
        /// A tool length that moves Z under an arc or a cycle.
        UnderArcOrCycle,
        /// A move of Z by a length that is not activated again after a position in machine coordinates.
        NotStatedAgain,
        /// The length of a tool that the program has not put into the table.
        NotInTable,
    }
}
