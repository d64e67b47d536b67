//! A repetition that a block asks for, and the text that it may be of.
//!
//! Not here: how blocks are read again (`repeated_blocks`).

use ncc_ir::source::Span;

/// A repetition that a block asks for.
#[derive(Clone, Copy, Debug)]
pub(in crate::word) struct Repetition {
    /// Number of the first block, and its word.
    pub(in crate::word) first: (u32, Span),
    /// Number of the last block, and its word.
    pub(in crate::word) last: (u32, Span),
    /// Passes after the first.
    pub(in crate::word) times: u32,
    /// Where its statement stands.
    pub(in crate::word) at: usize,
}

/// The text that repetitions may be of.
#[derive(Debug, Default)]
pub(in crate::word) struct RepeatedText {
    pub(in crate::word) text: Vec<u8>,
    pub(in crate::word) base: u32,
    /// Whether numbered blocks have been met.
    pub(in crate::word) open: bool,
    /// Whether blocks are being read again.
    pub(in crate::word) busy: bool,
}
