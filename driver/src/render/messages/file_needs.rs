//! Why a tool cannot have a file of its own: the form of NC0510 and its help.
//!
//! ```text
//! FileNeeds::Place(Y)    this first move relies on the position of Y at the change
//! ```
//!
//! Not here: what the file of a tool needs (`translate::per_tool`).

use ncc_ir::diag::FileNeeds;

use super::message::{Help, Message};

/// The entry of NC0510, and the axis in it.
pub(super) fn message(needs: FileNeeds, m: Message) -> Message {
    match needs {
        FileNeeds::Place(axis) => m.text("axis", char::from(axis.letter())),
        FileNeeds::PlaceInInches(axis) => m.form("inches").text("axis", char::from(axis.letter())),
        FileNeeds::AnotherTool => m.form("tool"),
        FileNeeds::Feed => m.form("feed"),
        FileNeeds::Speed => m.form("speed"),
        FileNeeds::Shift => m.form("shift"),
        FileNeeds::Length => m.form("length"),
        FileNeeds::Cycle => m.form("cycle"),
        FileNeeds::Compensation => m.form("compensation"),
        FileNeeds::TableValue => m.form("table"),
        FileNeeds::Setting => m.form("setting"),
        FileNeeds::Switch => m.form("switch"),
        FileNeeds::ToolNumber => m.form("number"),
        FileNeeds::Control => m.form("control"),
    }
}

/// What to do.
pub(super) fn helps(needs: FileNeeds) -> Vec<Help> {
    let own = match needs {
        FileNeeds::Place(_) => Some("help-place"),
        FileNeeds::AnotherTool => Some("help-first"),
        FileNeeds::Control => Some("help-flatten"),
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
    own.into_iter().chain(["help"]).map(Help::new).collect()
}
