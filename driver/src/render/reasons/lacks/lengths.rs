//! The words of reasons: tool length offsets.

use std::borrow::Cow;

use ncc_ir::lack::LengthsLack as L;

pub(super) fn text(lack: &L) -> Cow<'static, str> {
    Cow::Borrowed(match lack {
        L::Offset => "a length offset",
        L::NoTable => "a length of no table",
        L::OffsetWithoutZ => "a length offset in a block without Z",
        L::ToolOffsetWithoutZ => "a tool-length offset without a block that commands Z",
        L::ToolOffsetBeforeZ => "a tool-length offset with no absolute Z before this",
        L::OtherPlane => "a tool's length in another plane than XY",
        L::ByValue => "a tool's length by its value",
        L::OffsetsByValue => "a tool's offsets by their values",
        L::NotOwnEntry => "an entry of the length table that is not the tool's own",
        L::LengthInUse => "another length of the tool in the spindle, whose edge counts from its change on",
        L::EntryWithTool { entry, tool } => {
            return format!("entry {entry} of the length table with tool {tool} in the spindle").into();
        }
        L::EntryWithUnknownTool { entry } => {
            return format!("entry {entry} of the length table with a tool that is not known").into();
        }
        L::EntryWithOtherTool { entry } => {
            return format!("entry {entry} of the length table with another tool in the spindle").into();
        }
        L::Computed => "a computed length offset",
        L::ComputedByName => "a computed length offset, where tools go by name",
        L::ZByOtherLength => "a move along Z by the length of another tool",
        L::IncrementTakesLength => {
            "an incremental move along Z with which the length of a new tool takes effect"
        }
        L::WithAndWithout => "moves of one tool along Z with its length and without",
        L::OffsetSetByOperator => "Z of a work offset, which the operator sets by each tool",
        L::FromMachinePlace => "a tool length that moves Z from a place of the machine",
        L::UnitUnknown => "a tool length that moves Z in units that are not known",
        L::CoordinateUnknown => "a tool length that moves Z from a coordinate that is not known",
        L::UnderArcOrCycle => "a tool length that moves Z under an arc or a cycle",
        L::NotStatedAgain => {
            "a move of Z by a length that is not called up again after a place of the machine"
        }
        L::NotInTable => "the length of a tool that the program has not put into the table",
    })
}
