//! Where the lines of a text come from, and the files that it is cut into.
//!
//! ```text
//! lines 5 to 9 of the text    from line 3 of the source
//! ```
//!
//! Not here: where a text is cut (`scan`), and whether a file is right (`crate::verify_run::per_tool`).

use ncc_backends::Origin;
use ncc_ir::source::Span;

/// What a file per tool needs besides the text.
#[derive(Debug, Default)]
pub(in crate::translate) struct PerTool {
    /// Where the lines of the text come from, in their order.
    pub(super) origins: Vec<(u32, Span)>,
    /// The files without their heads, in the order in which they are run.
    pub(super) cut: Vec<Cut>,
}

/// A file without its head.
#[derive(Debug)]
pub(in crate::translate) struct Cut {
    pub(super) tool: Option<i64>,
    /// Work offsets that are active in it, by their numbers.
    pub(super) offsets: Vec<u16>,
    /// First and last line of the source, where the tool changes follow one another there.
    pub(super) lines: Option<(u64, u64)>,
    /// Where it begins in the text of the whole, and where its tool change is.
    pub(super) begins: [usize; 2],
    pub(super) text: Vec<u8>,
}

impl PerTool {
    /// Takes where further lines of the text come from.
    pub(in crate::translate) fn take(&mut self, origins: &[Origin]) {
        let own = |origin: &Origin| (origin.lines, origin.spans.last().copied().unwrap_or_default());
        self.origins.extend(origins.iter().map(own));
    }

    /// The places in the source of what is written at places of the text, which come in their order.
    pub(in crate::translate) fn sources_of(
        &self,
        text: &[u8],
        places: impl IntoIterator<Item = usize>,
    ) -> Vec<Span> {
        let mut origins = self.origins.iter();
        let mut origin = origins.next();
        // Lines of the text before `from`, and before the end of the origin at hand.
        let (mut from, mut line, mut end) = (0, 0, origin.map_or(0, |(lines, _)| u64::from(*lines)));
        let mut found = Vec::new();
        for at in places {
            line += memchr::memchr_iter(b'\n', text.get(from..at).unwrap_or_default()).count() as u64;
            from = at.max(from);
            while origin.is_some() && line >= end {
                origin = origins.next();
                end += origin.map_or(0, |(lines, _)| u64::from(*lines));
            }
            // An empty line has no place of its own, nor has a safe start: the next one that has.
            let mut rest = origin.into_iter().chain(origins.clone()).map(|(_, span)| *span);
            found.push(rest.find(|span| span.start < span.end).unwrap_or_default());
        }
        found
    }

    /// The place in the source of what is written at a place of the text.
    pub(in crate::translate) fn source_of(&self, text: &[u8], at: usize) -> Span {
        self.sources_of(text, [at]).first().copied().unwrap_or_default()
    }
}
