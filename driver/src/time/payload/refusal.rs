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

/// A block that keeps a document from being used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unusable {
    /// Its place in the document, from 0.
    pub place: usize,
    /// Why.
    pub why: Why,
}

/// Why a block cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// The document has not been processed.
    NotProcessed,
    /// Its function has no canonical call with what the document has of it.
    NoCall,
    /// The length is an edge of the tool.
    Edge,
    /// Its way is not the one between its positions: a frame or cutter compensation is active.
    Path,
    /// It begins elsewhere than the block before ends: the origin has changed.
    Origin,
}

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

impl Unusable {
    /// In words; `name` is the file's.
    pub fn problem(self, document: &Document, name: &str) -> Problem {
        let form = match self.why {
            Why::NotProcessed => "payload-not-processed",
            Why::NoCall => "payload-no-call",
            Why::Edge => "payload-edge",
            Why::Path => "payload-path",
            Why::Origin => "payload-origin",
        };
        let function = document.blocks.get(self.place).map_or("", |block: &Block| &block.function_name);
        let message = problem(form)
            .text("name", name)
            .text("block", (self.place + 1).to_string())
            .text("function", function);
        Problem::of(Exit::Refused, &message, None)
    }
}
