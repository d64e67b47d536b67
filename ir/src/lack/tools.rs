//! Tools, tool changes and edges, as reasons of a refusal.

use crate::reason::reasons;

reasons! {
    /// Tools, tool changes and edges that a target lacks.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum ToolsLack {
        /// A tool number.
        Number,
        /// A tool by this name.
        Name {
            /// The name.
            name: Box<str>,
        },
        /// A tool change.
        Change,
        /// A tool change by hand, which the option tool_change refuses.
        ChangeByHand,
        /// A tool change by hand to a tool that is not known.
        ChangeByHandUnknown,
        /// A tool change of a tool that an earlier block selects, which is not known here.
        ChangeOfSelected,
        /// A tool change that keeps the length of another tool.
        ChangeKeepsLength,
        /// A tool change under a length offset that is not known.
        ChangeUnderUnknownLength,
        /// A tool change with the spindle turning.
        SpindleTurnsAtChange,
        /// An edge of a tool.
        Edge,
        /// Edge {edge} of a tool.
        EdgeNumber {
            /// The edge.
            edge: u32,
        },
        /// An edge of a tool that is not known.
        EdgeOfUnknownTool,
        /// A computed edge of a tool.
        ComputedEdge,
        /// A computed tool, where tools go by name.
        ComputedTool,
        /// Tool centre point control.
        TipControl,
        /// Tool centre point control after an end of it that may have none.
        TipAfterUnknownEnd,
        /// Tool centre point control in a block with block skip.
        TipSkipped,
        /// Tool centre point control without a length that is known.
        TipLengthUnknown,
        /// Tool centre point control without a length.
        TipWithoutLength,
        /// The end of tool centre point control under a length that is not known.
        TipEndLengthUnknown,
        /// Another length where tool centre point control may be active.
        LengthUnderTip,
    }
}
