//! A repetition that a block asks for, and the text that it may be of.
//!
//! Not here: how blocks are read again (`repeated_blocks`).

use ncc_dialects::Dialect;
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
    /// Whether no block of the text is one that executes others again.
    pub(in crate::word) never: bool,
}

/// Whether a line of these has all the letters of a block that executes others again.
pub(crate) fn may_repeat(dialect: &Dialect, lines: &[u8]) -> bool {
    let Some([first, ..]) = dialect.repeat.letters() else { return false };
    memchr::memchr2_iter(first, first.to_ascii_lowercase(), lines).any(|at| {
        let (before, behind) = lines.split_at(at);
        let begins = memchr::memrchr(b'\n', before).map_or(0, |end| end + 1);
        let ends = memchr::memchr(b'\n', behind).map_or(lines.len(), |len| at + len);
        let has = |letter: &u8| lines[begins..ends].iter().any(|byte| byte.eq_ignore_ascii_case(letter));
        dialect.repeat.letters().iter().flatten().all(has)
    })
}
