//! The words of reasons: variables, expressions and their rounding.

use std::borrow::Cow;

use ncc_ir::run_time::RunTimeValue as R;

pub(super) fn text(reason: &R) -> Cow<'static, str> {
    Cow::Borrowed(match reason {
        R::Variable { name } => return format!("the variable {name}").into(),
        R::VariableOfCaller { name } => {
            return format!("the variable {name} of what calls this, which has its own").into();
        }
        R::VariableWithoutRoom { name } => {
            return format!("the variable {name}, for which there is no room").into();
        }
        R::VariableMaybeEmpty { name } => {
            return format!("the variable {name}, which may have no value where it is read").into();
        }
        R::SystemVariable { name } => return format!("the system variable {name}").into(),
        R::AskedVariable { asked } => return format!("the system variable {asked}").into(),
        R::Assignment => "an assignment",
        R::Declaration => "a variable that is made known",
        R::DeclarationAfterBlocks => "a variable that is made known behind blocks that are executed",
        R::DeclarationSkipped => "a variable that is made known in a block that can be skipped",
        R::DeclarationCommon => "a variable that all programs see, made known",
        R::SeveralFirstValues => "several first values of one variable",
        R::NotWholeInInteger => "a value that is not whole, in a variable of whole numbers",
        R::NumberInTruth => "a number in a variable of truth values",
        R::Array => "an array",
        R::NoSuchElement => "an element that its array does not have",
        R::SeveralNumbers => "a variable of several numbers",
        R::ComputedNumber => "a variable whose number is computed",
        R::ComputedNumberOfOthers => "a variable whose number is computed, of other variables",
        R::ComputedNumberAmongRenamed => {
            "a variable whose number is computed, among those that have other numbers"
        }
        R::ComputedNumberMaybeEmpty => {
            "a variable whose number is computed, and which may have no value where it is read"
        }
        R::ComputedNumberOfArguments => "a variable whose number is computed, among the arguments of a macro",
        R::WordWithExpression => "a word with a variable or an expression",
        R::BracketDepth => "brackets within so many others",
        R::LiteralUnit => "a literal with a unit of its own in an expression",
        R::NoValue => "no value at all",
        R::Opposite => "the opposite of a condition",
        R::ThisFunction => "this function",
        R::ThisOperator => "this operator",
        R::Function { function } => return format!("the function {}", called(function)).into(),
        R::Operator { operator } => return format!("the operator {}", called(operator)).into(),
        R::HasValue => "whether a variable has a value",
        R::NamelessHasValue => "whether a variable without a name has a value",
        R::ArgumentGiven { name } => {
            return format!("the question whether a call gives the argument {name}").into();
        }
        R::RoundingInExpression => "rounding to some digits in an expression",
        R::WholeInRoundedWord => "rounding to a whole number in a word that is rounded to digits",
        R::NegativeArcAngle => "an arc's angle below zero",
        R::Computed => "a value that is computed",
        R::ConditionAsValue => "a condition as a value",
        R::OtherDigits => "a computed value that is rounded to other digits than its word",
        R::NotRounded => "a computed value that is not rounded, in a word that rounds it",
        R::FineIncrement => "an incremental word that is finer than the digits of the control",
        R::Milliseconds => "computed seconds in a word of milliseconds",
        R::ComputedTurns => "an arc with a computed number of turns",
        R::NearlyEqual => "two numbers that are nearly the same where they are compared",
        R::NegativeRounded => "a number below zero that is rounded, or divided for a remainder",
        R::RoundedOneByOne => {
            "lengths with more digits than the control's, which it rounds one by one, and which add up"
        }
    })
}

/// The name of an operator or a function, as in the text form.
fn called(of: &impl std::fmt::Debug) -> String {
    format!("{of:?}").to_lowercase()
}
