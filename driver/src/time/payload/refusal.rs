//! Why a document cannot be used, and its words.

use super::{Block, Document};
use crate::problem::{Exit, Problem, problem};

/// A text that is no document.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unread {
    /// Line of the text, from 1.
    pub line: usize,
    /// Column in it, from 1; 0 where the line is empty.
    pub column: usize,
    /// The words of the JSON reader.
    pub reason: String,
}

/// A block that shows that a document has not been processed: its place, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotProcessed(pub usize);

impl Unread {
    /// In words; `name` is the file's.
    pub fn problem(&self, name: &str) -> Problem {
        let message = problem("payload")
            .text("name", name)
            .text("line", self.line.to_string())
            .text("column", self.column.to_string())
            .text("reason", self.reason.as_str());
        Problem::of(Exit::Refused, &message, None)
    }
}

impl NotProcessed {
    /// In words; `name` is the file's.
    pub fn problem(self, document: &Document, name: &str) -> Problem {
        let function = document.blocks.get(self.0).map_or("", |block: &Block| &block.function_name);
        let message = problem("payload-not-processed")
            .text("name", name)
            .text("block", (self.0 + 1).to_string())
            .text("function", function);
        Problem::of(Exit::Refused, &message, None)
    }
}
