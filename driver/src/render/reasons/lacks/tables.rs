//! The words of reasons: values in the control's tables.

use std::borrow::Cow;

use ncc_ir::lack::TablesLack as L;

pub(super) fn text(lack: &L) -> Cow<'static, str> {
    Cow::Borrowed(match lack {
        L::Value => "this value in the control's tables",
        L::AddedValue => "a value added to one in the control's tables",
        L::AxesPosition => "storing where the axes stand",
        L::ToolInSpindle => "setting the number of the tool in the spindle",
        L::OffsetZero { offset } => return format!("the zero of work offset {offset}").into(),
        L::OffsetNotActivatedAgain => {
            "the zero of a work offset that may be in force, and is not called up again"
        }
        L::MeasuredTool => "a tool measured where the axes stand",
        L::Diameter => "this diameter",
        L::ToolInUse => "a value of the tool in use that counts when it is called up anew",
        L::ToolMaybeInUse => "a value of a tool that may be in use, and stays as it was until called up",
        L::NotMillimetres => "values of tables where lengths do not count in millimetres",
        L::PlaceByNumber => "a place of the control's tables by its number",
        L::ToolNotWhole => "values of a tool of which the program has not said all",
    })
}
