//! Variables, expressions and their rounding that a target cannot compute when the program runs.

use crate::expr::system::System;
use crate::expr::{Binary, Function};
use crate::reason::reasons;

reasons! {
    /// Variables, expressions and their rounding that a target cannot compute when the program runs.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum RunTimeValue {
        /// A variable by this name.
        Variable {
            /// The name.
            name: Box<str>,
        },
        /// A variable of the caller, which has its own variables.
        VariableOfCaller {
            /// The name.
            name: Box<str>,
        },
        /// A variable for which the target has no free number.
        VariableWithoutRoom {
            /// The name.
            name: Box<str>,
        },
        /// A variable that may be empty where the program reads it.
        VariableMaybeEmpty {
            /// The name.
            name: Box<str>,
        },
        /// A system variable by this name.
        SystemVariable {
            /// The name.
            name: Box<str>,
        },
        /// A system variable by its meaning.
        AskedVariable {
            /// What the program asks of the control.
            asked: System,
        },
        /// An assignment.
        Assignment,
        /// A declaration of a variable.
        Declaration,
        /// A declaration after executed blocks.
        DeclarationAfterBlocks,
        /// A declaration in a block with block skip.
        DeclarationSkipped,
        /// A declaration of a common variable.
        DeclarationCommon,
        /// Several first values of one variable.
        SeveralFirstValues,
        /// A value that is not whole, in a variable of whole numbers.
        NotWholeInInteger,
        /// A number in a variable of truth values.
        NumberInTruth,
        /// An array.
        Array,
        /// An element that its array does not have.
        NoSuchElement,
        /// A variable of several numbers.
        SeveralNumbers,
        /// A variable whose number is computed.
        ComputedNumber,
        /// A variable whose number is computed, of other variables.
        ComputedNumberOfOthers,
        /// A variable whose number is computed, among those that have other numbers.
        ComputedNumberAmongRenamed,
        /// A variable whose number is computed, and which may have no value where it is read.
        ComputedNumberMaybeEmpty,
        /// A variable whose number is computed, among the arguments of a macro.
        ComputedNumberOfArguments,
        /// A word with a variable or an expression.
        WordWithExpression,
        /// Brackets within so many others.
        BracketDepth,
        /// A literal with a unit of its own in an expression.
        LiteralUnit,
        /// No value at all.
        NoValue,
        /// The opposite of a condition.
        Opposite,
        /// This function.
        ThisFunction,
        /// This operator.
        ThisOperator,
        /// A function of expressions.
        Function {
            /// The function.
            function: Function,
        },
        /// An operator of expressions.
        Operator {
            /// The operator.
            operator: Binary,
        },
        /// Whether a variable has a value.
        HasValue,
        /// Whether a variable without a name has a value.
        NamelessHasValue,
        /// The test whether a call passes this argument.
        ArgumentGiven {
            /// The name.
            name: Box<str>,
        },
        /// Rounding to some digits in an expression.
        RoundingInExpression,
        /// Rounding to a whole number in a word that is rounded to digits.
        WholeInRoundedWord,
        /// An arc's angle below zero.
        NegativeArcAngle,
        /// A value that is computed.
        Computed,
        /// A condition as a value.
        ConditionAsValue,
        /// A computed value that is rounded to other digits than its word.
        OtherDigits,
        /// A computed value that is not rounded, in a word that rounds it.
        NotRounded,
        /// An incremental word that is finer than the digits of the control.
        FineIncrement,
        /// Computed seconds in a word of milliseconds.
        Milliseconds,
        /// An arc with a computed number of turns.
        ComputedTurns,
        /// Two numbers that are nearly the same where they are compared.
        NearlyEqual,
        /// A number below zero that is rounded, or divided for a remainder.
        NegativeRounded,
        /// Lengths with more digits than the control's, which it rounds one by one, and which add up.
        RoundedOneByOne,
    }
}
