//! The words of reasons: tools, tool changes and edges.

use std::borrow::Cow;

use ncc_ir::lack::ToolsLack as L;

pub(super) fn text(lack: &L) -> Cow<'static, str> {
    Cow::Borrowed(match lack {
        L::Number => "a tool number",
        L::Name { name } => return format!("a tool called {name}").into(),
        L::Change => "a tool change",
        L::ChangeByHand => "a tool change by hand, which the option tool_change refuses",
        L::ChangeByHandUnknown => "a tool change by hand to a tool that is not known",
        L::ChangeOfSelected => {
            "a tool change of a tool that an earlier block selects, which is not known here"
        }
        L::ChangeKeepsLength => "a tool change that keeps the length of another tool",
        L::ChangeUnderUnknownLength => "a tool change under a length offset that is not known",
        L::SpindleTurnsAtChange => "a spindle that goes on turning when the tool is changed",
        L::Edge => "an edge of a tool",
        L::EdgeNumber { edge } => return format!("edge {edge} of a tool").into(),
        L::EdgeOfUnknownTool => "an edge of a tool that is not known",
        L::ComputedEdge => "a computed edge of a tool",
        L::ComputedTool => "a computed tool, where tools go by name",
        L::TipControl => "control of the tool's tip",
        L::TipAfterUnknownEnd => "control of the tool's tip behind an end of it that may have none",
        L::TipSkipped => "control of the tool's tip in a block that can be skipped",
        L::TipLengthUnknown => "control of the tool's tip without a length that is known",
        L::TipWithoutLength => "control of the tool's tip without a length",
        L::TipEndLengthUnknown => "the end of control of the tool's tip under a length that is not known",
        L::LengthUnderTip => "another length where the tool's tip may be under control",
    })
}
