//! Values that a program puts into the table of tools: whether the target has them, and means the same by them.

use ncc_ir::caps::Caps;
use ncc_ir::lack::TablesLack;
use ncc_ir::program::Data;
use ncc_ir::track::Tracker;

/// What the target cannot say of a value of a tool, if anything.
pub(super) fn refusal(data: &Data, at: &Tracker, caps: &Caps) -> Option<TablesLack> {
    match data {
        Data::Tool { which, added, .. }
            if !caps.tools.data[*which as usize] || *added && !caps.tools.data_added =>
        {
            Some(TablesLack::Value)
        }
        // Where another entry is surely active, nothing of it can stay or change.
        Data::Tool { entry, which, kept: true, .. }
            if which.is_offset()
                && !caps.tools.data_kept
                && at.modes.length_offset.is_none_or(|own| own == *entry) =>
        {
            Some(TablesLack::ToolInUse)
        }
        Data::Measured { offset, .. } if !caps.tools.measured[usize::from(offset.is_some())] => {
            Some(TablesLack::MeasuredTool)
        }
        Data::Tool { .. }
        | Data::Measured { .. }
        | Data::Offset { .. }
        | Data::Position(_)
        | Data::ToolInSpindle(_) => None,
    }
}
