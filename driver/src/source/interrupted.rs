//! The error of work that was asked to stop. Its words are those of a [`Problem`](crate::problem::Problem).

use std::fmt;

/// The work on a source was interrupted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Interrupted {
    /// The line that was next, from 1; `None` where no source is read.
    pub line: Option<u64>,
}

impl fmt::Display for Interrupted {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self, out)
    }
}

impl std::error::Error for Interrupted {}
