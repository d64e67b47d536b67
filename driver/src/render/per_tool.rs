//! The words of files for one tool each: `messages/per-tool`.
//!
//! ```text
//! (TOOL 2: file 2 of 3, lines 14 to 31 of the source)
//! ```

use super::messages::message::{Message, Part};

/// How a file for one tool begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Begins {
    /// The operator sets the zero of Z with the tool of the file.
    ZeroSet,
    /// With the tool of the file, and the zero of Z as it was.
    ZeroKept,
    /// With the tool in the spindle.
    InSpindle,
}

/// An entry about a file for one tool.
pub(crate) fn per_tool(form: &'static str) -> Message {
    Message::part(Part::PerTool, form)
}

/// The line that names the tool, the file, and the lines of the source.
pub(crate) fn file_line(tool: Option<i64>, number: usize, count: usize, lines: Option<(u64, u64)>) -> String {
    let form = match (tool, lines) {
        (Some(_), None) => "file",
        (Some(_), Some((first, last))) if first == last => "file-line",
        (Some(_), Some(_)) => "file-lines",
        (None, None) => "spindle-file",
        (None, Some((first, last))) if first == last => "spindle-file-line",
        (None, Some(_)) => "spindle-file-lines",
    };
    let (first, last) = lines.unwrap_or_default();
    per_tool(form)
        .text("tool", tool.unwrap_or_default().to_string())
        .text("number", number.to_string())
        .text("count", count.to_string())
        .text("first", first.to_string())
        .text("last", last.to_string())
        .headline()
}

/// The line that says how the operator begins; `offsets` are the codes of the work offsets whose zero of Z is set.
pub(crate) fn begin_line(begins: Begins, offsets: &[&str]) -> String {
    let message = match (begins, offsets.split_last()) {
        (Begins::ZeroSet, None) => per_tool("begin-by-hand"),
        (Begins::ZeroSet, Some((last, []))) => per_tool("begin-by-hand-in").text("offset", *last),
        (Begins::ZeroSet, Some((last, others))) => {
            per_tool("begin-by-hand-among").text("offset", *last).text("others", others.join(", "))
        }
        (Begins::ZeroKept, _) => per_tool("begin"),
        (Begins::InSpindle, _) => per_tool("begin-in-spindle"),
    };
    message.headline()
}
