//! The error of work that was asked to stop.

use std::fmt;

/// The work on a source was interrupted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Interrupted {
    /// The line that was next, from 1; `None` where no source is read.
    pub line: Option<u64>,
}

impl fmt::Display for Interrupted {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(out, "interrupted at line {line}"),
            None => write!(out, "interrupted"),
        }
    }
}

impl std::error::Error for Interrupted {}
