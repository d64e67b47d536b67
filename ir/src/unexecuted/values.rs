//! Values of words and expressions that ncc does not execute.

use crate::expr::system::System;
use crate::reason::reasons;

reasons! {
    /// Values of words and expressions that ncc does not execute.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum ValueUnexecuted {
        /// An expression.
        Expression,
        /// A position of which no word has a value.
        PositionWithoutValue,
        /// A feed, a speed, a time or a number that is not positive.
        NotPositive,
        /// A word without a value that cannot be left out.
        WordWithoutValue,
        /// A variable of the control's own that is set.
        ControlVariableSet,
        /// A system variable by this name.
        SystemVariable {
            /// The name.
            name: Box<str>,
        },
        /// A system variable whose value is not known.
        SystemVariableUnknown {
            /// What the program asks of the control.
            asked: System,
        },
        /// A literal with a unit of its own in an expression.
        LiteralUnit,
        /// A value in a message.
        MessageValue,
        /// A value in what is written.
        WrittenValue,
        /// An unknown clearance of peck drilling.
        PeckClearanceUnknown,
        /// An unknown lift of chip-breaking drilling.
        BreakLiftUnknown,
    }
}
