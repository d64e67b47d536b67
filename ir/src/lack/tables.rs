//! Values in the control's tables, as reasons of a refusal.

use crate::reason::reasons;

reasons! {
    /// Values in the control's tables that a target lacks.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum TablesLack {
        /// This value in the control's tables.
        Value,
        /// A value added to one in the control's tables.
        AddedValue,
        /// Storing where the axes stand.
        AxesPosition,
        /// Setting the number of the tool in the spindle.
        ToolInSpindle,
        /// The zero of work offset {offset}.
        OffsetZero {
            /// The number of the work offset; 1 is the first.
            offset: u16,
        },
        /// The zero of a work offset that may be active, and is not activated again.
        OffsetNotActivatedAgain,
        /// A tool measured where the axes stand.
        MeasuredTool,
        /// A diameter that is half of one that cannot be written.
        Diameter,
        /// A value of the tool in use that counts when it is activated again.
        ToolInUse,
        /// A value of a tool that may be in use, and stays as it was until activated.
        ToolMaybeInUse,
        /// Values of tables where lengths do not count in millimetres.
        NotMillimetres,
        /// A place of the control's tables by its number.
        PlaceByNumber,
        /// Values of a tool of which the program has not stated all.
        ToolNotWhole,
    }
}
