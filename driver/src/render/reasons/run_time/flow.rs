//! The words of reasons: loops, decisions, jumps and calls.

use std::borrow::Cow;

use ncc_ir::run_time::RunTimeFlow as R;

pub(super) fn text(reason: &R) -> Cow<'static, str> {
    Cow::Borrowed(match reason {
        R::Loop => "a loop",
        R::LoopLeft => "a loop that is left",
        R::LoopLeftKind => "a loop of this kind that is left",
        R::LoopNextTurn => "a turn of a loop that is left",
        R::LoopTimes => "a loop that is repeated a number of times",
        R::LoopComputedTimes => "a loop that is repeated a computed number of times",
        R::LoopCounts => "a loop that counts",
        R::LoopCountsOtherwise => "a loop that counts otherwise than by ones",
        R::LoopOtherKind => "a loop of another kind",
        R::LoopTestedAfter => "a loop that is tested behind each turn",
        R::LoopDepth => "a loop within so many others",
        R::LoopSkipped => "a loop that can be skipped",
        R::LoopEndless => "a loop that has no end",
        R::LoopWithoutCondition => "a loop without a condition",
        R::LoopBesideLeft => "a repeated loop beside one whose turns are left and tested at their end",
        R::StructureDepth { most } => return format!("a structure within {most} others").into(),
        R::Decision => "a decision",
        R::DecisionStatements => "a decision about more than one statement",
        R::DecisionStatement => "a decision about another statement",
        R::DecisionSkipped => "a decision that can be skipped",
        R::Jump => "a jump",
        R::ComputedJump => "a jump to a block whose number is computed",
        R::Subprogram => "a subprogram with parameters",
        R::CallArguments => "a call with arguments",
        R::CallOwnVariables => "a call with variables of its own",
        R::CallOwnAgain => "a call with variables of its own that is made several times",
        R::CallOwnDepth => "a call with variables of its own within so many others",
        R::CallMoreArguments => "a call with more arguments than the program has parameters",
        R::CallOtherArguments => "a call with other arguments than its program has parameters",
        R::CallChangesValues => {
            "a call that is made several times, with values that the called program may change"
        }
        R::CallOfOwnElsewhere => "a call of a program that has variables of its own elsewhere",
        R::ArgumentNotLocal => "an argument that is no local variable",
        R::ArgumentNotOfCall => "an argument that is no variable of the call",
        R::ArgumentLetters => "arguments of which the variables have no letters",
        R::ArgumentRounded => "a rounding in an argument",
        R::ArgumentEmpty { name } => {
            return format!("the argument {name}, which --args leaves without a value").into();
        }
        R::ArgumentLetter { number } => {
            return format!("the argument {number}, which no letter gives").into();
        }
        R::ParameterCommon => "a parameter that all programs see",
        R::ParameterArray => "an array of the caller's as a parameter",
        R::ParameterOtherType => {
            "a parameter that is the caller's own variable, and is given none of its type"
        }
        R::ReturnOutOfLoop => "a return out of a loop that is repeated a number of times",
        R::ResultElsewhere => "the setting of a result elsewhere than with the return",
    })
}
