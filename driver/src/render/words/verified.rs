//! What verification left open, in words: a message and a label.

use ncc_ir::behaviour::Behaviour;
use ncc_ir::diag::ArgumentCheck;

/// An argument that every call of a macro must give; `place` is its place among the arguments, 0 if it has none.
pub(super) fn argument_needed(name: &str, place: u32, check: &ArgumentCheck) -> (String, String) {
    let message = match place {
        0 if *check == ArgumentCheck::Whole => {
            format!("every call must give the argument {name}, a whole number")
        }
        0 => format!("every call must give the argument {name}"),
        place => format!("every call must give the argument {name} in place {place}"),
    };
    let label = match check {
        ArgumentCheck::NotAsked => {
            "in the output it is a parameter, which is zero where a call leaves it out"
        }
        ArgumentCheck::Nothing => {
            "in the output it is a variable of the call, which has no value where a call leaves it out"
        }
        ArgumentCheck::Whole => {
            "in the output it is a variable of the call, without a value where a call leaves it out; as the \
             speed it is rounded"
        }
        ArgumentCheck::LeftOut | ArgumentCheck::Default(_) => {
            "this check is left out: in the output it is a parameter, which is zero where a call leaves it out"
        }
    };
    (message, label.into())
}

/// A branch that never ran: `holds` and `fails` are whether its condition never held, and never failed.
pub(super) fn not_taken(never: [bool; 2]) -> (String, String) {
    let label = match never {
        [true, true] => "this decision was not come to",
        [true, false] => "this never held",
        [false, _] => "this always held",
    };
    ("not all of the program was executed when it was verified".into(), label.into())
}

/// Another value of an open fact of `control` (without one: the switch for optional stops) that was not tried to the end.
pub(super) fn fact_not_tried(behaviour: Option<Behaviour>, control: &str) -> (String, String) {
    let fact = |b: Behaviour| format!("another value of {} on {control}", b.option());
    let what = behaviour.map_or("the switch for optional stops".into(), fact);
    let left = "the run with it was left 1000000 events or 20000000 steps after this";
    (format!("{what} was not tried to the end of the program"), left.into())
}
