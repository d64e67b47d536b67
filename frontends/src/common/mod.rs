//! What readers share: words with exact numbers, the recognisers of plain blocks, what is known of the
//! facts that a program sets.
//!
//! ```text
//! N10 G1 X10.5 F200      fast_parse::read    four words with their digits and spans
//! X10.5 Y3.              fast_lower::line     the statement of a plain move, without words
//! G2 X5. Y5. I5. (A)     fast_block::read    the words of a move of another kind
//! X10.5 Y3.              plain_words         letters and numbers, whatever they mean
//! ```
//!
//! Not here: what a word means, and what one reader alone needs.

pub(crate) mod fast_block;
pub(crate) mod fast_lower;
pub(crate) mod fast_parse;
pub(crate) mod known;
pub(crate) mod modal_state;
pub(crate) mod number;
pub(crate) mod only_value;
pub(crate) mod pieces;
pub(crate) mod plain_words;
pub(crate) mod saved;
pub(crate) mod setting;
pub(crate) mod sort;
pub(crate) mod switched;
pub(crate) mod text;
pub(crate) mod words;

use ncc_ir::source::Span;

/// A piece of the source with the place of its first byte.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Source<'s> {
    pub(crate) text: &'s [u8],
    pub(crate) base: u32,
}

impl Source<'_> {
    /// The bytes of a span.
    pub(crate) fn bytes(&self, span: Span) -> &[u8] {
        let at = |place: u32| place.saturating_sub(self.base) as usize;
        self.text.get(at(span.start)..at(span.end)).unwrap_or_default()
    }

    /// The text of a span.
    pub(crate) fn text(&self, span: Span) -> Box<str> {
        String::from_utf8_lossy(self.bytes(span)).into()
    }
}
