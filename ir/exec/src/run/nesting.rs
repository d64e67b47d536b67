//! What a run is within: calls, and stretches of blocks that are repeated.
//!
//! Not here: bodies of counted loops, which are numbers alone (`run`).

use std::rc::Rc;

use crate::run::code::At;
use crate::run::term::Place;
use ncc_ir::expr::value::Value;

/// A call that is open.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Frame {
    pub(crate) entry: At,
    pub(crate) back: At,
    /// Further times after this one.
    pub(crate) again: u32,
    /// How many bodies were open, and places of variables in use, where it was called.
    pub(crate) turns: usize,
    pub(crate) base: usize,
    /// Whether it has its caller's locals.
    pub(crate) shared: bool,
    pub(crate) parameters: Rc<[Place]>,
    /// What they are given, each time.
    pub(crate) given: Rc<[Value]>,
}

/// A repeated stretch of blocks that is open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Blocks {
    pub(crate) begin: At,
    pub(crate) end: At,
    pub(crate) back: At,
    pub(crate) again: u64,
    /// In which call.
    pub(crate) call: usize,
    /// How many bodies that are counted were open there, of all and of the procedure's own.
    pub(crate) turns: usize,
    pub(crate) counted: u32,
}
