//! What a reader keeps for custom functions of a user's program: where the tool is, and blocks that wait for their end.
//!
//! Not here: what is done with it (`bound_function`).

use std::collections::BTreeSet;

use ncc_dialects::{FunctionRow, GivenBlock};
use ncc_ir::canon::AXES;
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::Text;
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

/// What a reader keeps for the functions of a dialect that has some.
#[derive(Debug, Default)]
pub(in crate::word) struct FunctionState {
    /// The state after the statements so far, of the program that is being read.
    pub(in crate::word) tracker: Tracker,
    /// The name of that program; `None` is the main program.
    pub(in crate::word) program: Option<Text>,
    /// How many statements of it have been followed, of those that are there.
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
    /// Where the function's code stands.
    pub(in crate::word) code: Span,
    /// The number of its block.
    pub(in crate::word) number: Option<u32>,
    /// Its blocks so far, and where they stand.
    pub(in crate::word) blocks: Vec<GivenBlock>,
    pub(in crate::word) spans: Vec<Span>,
    /// Where the axis words so far lead, from which increments count.
    pub(in crate::word) at: [Nanos; AXES],
    /// Whether one of its blocks was refused.
    pub(in crate::word) failed: bool,
}
