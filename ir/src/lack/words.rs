//! Blocks, axis words and numbers, as reasons of a refusal.

use crate::canon::Axis;
use crate::reason::reasons;

reasons! {
    /// Blocks, axis words and numbers that a target lacks.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum WordsLack {
        /// This axis.
        Axis,
        /// The word of this axis.
        AxisWord {
            /// The axis.
            axis: Axis,
        },
        /// A number that the digits of the target do not hold.
        Number {
            /// The word.
            word: Box<str>,
        },
        /// A number that the target takes only as a whole number.
        NotWhole {
            /// The word.
            word: Box<str>,
        },
        /// A number with more digits than the target has, in an unknown unit.
        TooFine {
            /// The word.
            word: Box<str>,
        },
        /// A computed value.
        ComputedValue,
        /// An expression.
        Expression,
        /// These codes in one block.
        CodesInOneBlock,
        /// A block of more than {most} characters.
        BlockLength {
            /// The most that the target takes.
            most: u32,
        },
        /// A statement that is more than codes and words.
        CodesAndWords,
        /// Moves that are packed.
        Packed,
        /// A canonical function, by its name.
        Function {
            /// The name.
            function: &'static str,
        },
        /// A function of the machine, by its name.
        MachineFunction {
            /// The name.
            name: Box<str>,
        },
        /// A straight move.
        StraightMove,
        /// A rapid move.
        RapidMove,
        /// A position that does what the caller has active.
        CallersMotion,
        /// The direction of a rotary axis.
        RotaryDirection,
        /// The direction of a rotary axis from an unknown position.
        RotaryStartUnknown,
        /// A rotary axis that turns in the other direction.
        RotaryOtherDirection,
        /// A rotary axis that turns in a stated direction by half a turn or more.
        RotaryHalfTurn,
    }
}
