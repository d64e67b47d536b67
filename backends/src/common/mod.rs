//! What writers share: the block that is put together, the codes of a dictionary, numbers as a control
//! writes them, what is active in the text, expressions, and a writer of words that the writers of blocks hold; and
//! quoted texts of the two text forms.
//!
//! ```text
//! Need { … }, Rank::Feed      block     where a word stands, and whether it fits into the block at hand
//! 10.5 mm                     number    `10.5`, `10500`: by the dictionary's rules
//! STRAIGHT_FEED(X 10.5mm)     words     `G1 X10.5`: a statement that is codes and words alone
//! ```
//!
//! Not here: what each language says in its own way.

pub(crate) mod active_modes;
pub(crate) mod block;
pub(crate) mod codes;
pub(crate) mod comment;
pub(crate) mod entry;
pub(crate) mod fault;
pub(crate) mod formula;
pub(crate) mod number;
pub(crate) mod packed;
pub(crate) mod quoted;
pub(crate) mod setting;
pub(crate) mod table;
pub(crate) mod words;

use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::source::Span;

/// Where a piece of the program goes.
pub(crate) struct Sink<'a> {
    pub(crate) out: &'a mut Vec<u8>,
    pub(crate) diags: &'a mut Vec<Diagnostic>,
}

impl Sink<'_> {
    pub(crate) fn report(&mut self, fault: Fault, span: Span) {
        self.diags.push(Diagnostic::new(fault, span));
    }
}
