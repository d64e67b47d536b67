//! Why a tool cannot have a file of its own, in words, and what to do.
//!
//! ```text
//! FileNeeds::Place(Y)    this first move relies on where Y was at the tool change
//! ```
//!
//! Not here: what the file of a tool needs (`translate::per_tool`).

use ncc_ir::diag::FileNeeds;

/// The label at the place.
pub(super) fn label(needs: FileNeeds) -> String {
    let text = match needs {
        FileNeeds::Place(axis) => {
            let axis = char::from(axis.letter());
            return format!("this first move relies on where {axis} was at the tool change");
        }
        FileNeeds::PlaceInInches(axis) => {
            let axis = char::from(axis.letter());
            return format!("inches cannot state exactly where {axis} is at the tool change");
        }
        FileNeeds::AnotherTool => {
            "this comes before the first tool change, and in the file its tool is in the spindle already"
        }
        FileNeeds::Feed => "F of another tool is active here",
        FileNeeds::Speed => "S of another tool is active here",
        FileNeeds::Shift => "a shift of program zero is active at this tool change",
        FileNeeds::Length => "a tool length is active at this tool change",
        FileNeeds::Cycle => "a canned cycle is active at this tool change",
        FileNeeds::Compensation => "cutter compensation is active at this tool change",
        FileNeeds::TableValue => "a value that stays in the control's tables",
        FileNeeds::Setting => "a setting that lasts beyond its tool",
        FileNeeds::Switch => "a switch decides whether this block is executed",
        FileNeeds::ToolNumber => "the number of this tool is computed",
        FileNeeds::Control => "its text has calls, labels or loops",
    };
    text.to_owned()
}

/// What to do.
pub(super) fn advice(needs: FileNeeds) -> Vec<String> {
    let own = match needs {
        FileNeeds::Place(_) => Some("state it here: a rapid move in G90 with all axes, above the work"),
        FileNeeds::AnotherTool => Some("move it behind the first tool change"),
        FileNeeds::Control => Some("`--pass flatten` writes the straight blocks that come of the program"),
        FileNeeds::PlaceInInches(_)
        | FileNeeds::Feed
        | FileNeeds::Speed
        | FileNeeds::Shift
        | FileNeeds::Length
        | FileNeeds::Cycle
        | FileNeeds::Compensation
        | FileNeeds::TableValue
        | FileNeeds::Setting
        | FileNeeds::Switch
        | FileNeeds::ToolNumber => None,
    };
    let manual = "`--to-option tool_change=manual` writes one file, which stops for each tool";
    own.into_iter().chain([manual]).map(str::to_owned).collect()
}
