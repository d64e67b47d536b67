//! State of a reader for custom functions: the position of the tool, and blocks that wait for their end.
//!
//! Not here: what is done with it (`bound_function`).

use std::collections::BTreeSet;

use ncc_dialects::{FunctionRow, GivenBlock};
use ncc_ir::canon::AXES;
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::Text;
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

/// State of a reader for the functions of a dialect that has some.
#[derive(Debug, Default)]
pub(in crate::word) struct FunctionState {
    /// The state after the statements so far, of the program that is being read.
    pub(in crate::word) tracker: Tracker,
    /// The name of that program; `None` is the main program.
    pub(in crate::word) program: Option<Text>,
    /// The number of its statements that have been followed.
    pub(in crate::word) seen: usize,
    /// Whether the last block was in a loop or a branch.
    pub(in crate::word) structured: bool,
    /// The function that waits for the block that ends it.
    pub(in crate::word) open: Option<OpenFunction>,
    /// Functions that have been reported.
    pub(in crate::word) reported: BTreeSet<&'static str>,
    /// The first function of the main program.
    pub(in crate::word) first: Option<(&'static str, Span)>,
}

/// A function whose blocks are handed over together.
#[derive(Debug)]
pub(in crate::word) struct OpenFunction {
    pub(in crate::word) name: &'static str,
    pub(in crate::word) row: &'static FunctionRow,
    /// The place of the function's code.
    pub(in crate::word) code: Span,
    /// The number of its block.
    pub(in crate::word) number: Option<u32>,
    /// Its blocks so far, and where they stand.
    pub(in crate::word) blocks: Vec<GivenBlock>,
    pub(in crate::word) spans: Vec<Span>,
    /// The end point of the axis words so far; increments count from it.
    pub(in crate::word) at: [Nanos; AXES],
    /// Whether one of its blocks was refused.
    pub(in crate::word) failed: bool,
}
