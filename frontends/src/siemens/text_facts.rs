//! What a text has stated so far, wherever: facts that hold for all of it.
//!
//! Not here: what holds at the block that is read (`siemens_state`).

/// What the text has said of surface speeds.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Surfaces {
    /// Whether any was active so far.
    pub(super) met: bool,
    /// Whether a code of the feed stood where it is not known what a speed counts, before the first one.
    pub(super) doubted: bool,
}
