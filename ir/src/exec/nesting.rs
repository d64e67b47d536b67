//! What a run is within: calls, and stretches of blocks that are repeated.
//!
//! Not here: bodies of counted loops, which are numbers alone (`run`).

use std::rc::Rc;

use super::code::At;
use super::term::Place;
use crate::value::Value;

/// A call that is open.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Frame {
    pub(super) entry: At,
    pub(super) back: At,
    /// Further times after this one.
    pub(super) again: u32,
    /// How many bodies were open, and places of variables in use, where it was called.
    pub(super) turns: usize,
    pub(super) base: usize,
    /// Whether it has its caller's locals.
    pub(super) shared: bool,
    pub(super) parameters: Rc<[Place]>,
    /// What they are given, each time.
    pub(super) given: Rc<[Value]>,
}

/// A repeated stretch of blocks that is open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Blocks {
    pub(super) begin: At,
    pub(super) end: At,
    pub(super) back: At,
    pub(super) again: u64,
    /// In which call.
    pub(super) call: usize,
    /// How many bodies that are counted were open there, of all and of the procedure's own.
    pub(super) turns: usize,
    pub(super) counted: u32,
}
