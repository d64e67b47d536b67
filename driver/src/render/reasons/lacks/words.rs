//! The words of reasons: blocks, axis words and numbers.

use std::borrow::Cow;

use ncc_ir::lack::WordsLack as L;

pub(super) fn text(lack: &L) -> Cow<'static, str> {
    Cow::Borrowed(match lack {
        L::Axis => "this axis",
        L::AxisWord { axis } => return format!("the axis {}", axis.letter() as char).into(),
        L::Number { word } => return word.to_string().into(),
        L::NotWhole { word } => return format!("{word}, which is not a whole number").into(),
        L::TooFine { word } => {
            return format!("{word}, which is too fine in a unit that is not known").into();
        }
        L::ComputedValue => "a computed value",
        L::Expression => "an expression",
        L::CodesInOneBlock => "these codes in one block",
        L::BlockLength { most } => return format!("a block of more than {most} characters").into(),
        L::CodesAndWords => "a statement that is more than codes and words",
        L::Packed => "moves that are packed",
        L::Function { function } => function,
        L::MachineFunction { name } => return format!("the machine function {name}").into(),
        L::StraightMove => "a straight move",
        L::RapidMove => "a rapid move",
        L::CallersMotion => "a position that does what the caller has in force",
        L::RotaryDirection => "which way round a rotary axis goes",
        L::RotaryStartUnknown => "the way of a rotary axis from where nobody knows",
        L::RotaryOtherDirection => "a rotary axis that goes the other way round",
        L::RotaryHalfTurn => "a rotary axis that goes a stated way by half a turn or more",
    })
}
