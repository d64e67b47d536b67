//! What the wording of a fault may name besides its own data: both dialects, and the text at the place.

use ncc_dialects::Dialect;

/// What the wording may name besides the fault's own data.
#[derive(Clone, Copy, Debug)]
pub struct Context<'a> {
    /// The source's dialect.
    pub from: &'a Dialect,
    /// The target's dialect.
    pub to: &'a Dialect,
    /// The text that the diagnostic points at.
    pub snippet: &'a str,
    /// The text directly before and after it.
    pub beside: (&'a str, &'a str),
}
