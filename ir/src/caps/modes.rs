//! Modes, advice, messages; and the order of blocks.

use std::sync::Arc;

use crate::canon::{AdviceKind, PathMode};
use crate::computed::computes::Computes;

/// What a target can say of modes, advice and messages.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ModeCaps {
    /// Incremental coordinates.
    pub incremental: bool,
    /// A word can say for itself whether it is absolute or incremental.
    pub word_distance: bool,
    /// Both units of length.
    pub inch: bool,
    /// A change of units within a program stands in a block of its own.
    pub units_alone: bool,
    /// A feed can be in another unit than the lengths.
    pub feed_apart: bool,
    /// A change of units leaves it open what a feed said before means.
    pub feed_again: bool,
    /// A feed by the time of a move.
    pub feed_by_time: bool,
    /// Digits after the point of F.
    pub feed_decimals: u8,
    /// A code of what the feed counts ends the feed even where it counts that already.
    pub feed_ends_with_mode: bool,
    /// Modes of taking corners, a bit each.
    pub path: u16,
    /// How it always takes corners, where it lacks that.
    pub only_path: Option<PathMode>,
    /// Whether plain rounding goes as far from the path as the acceleration asks for.
    pub rounds_freely: bool,
    /// Whether the length of rounding can be another one in rapids.
    pub path_in_rapids: bool,
    /// Whether moves that the control makes one have a length of their own.
    pub path_merges: bool,
    /// Advice that it supports, each with its value.
    pub advice: Vec<(AdviceKind, u8)>,
    /// Messages to the operator.
    pub messages: bool,
    /// Those that stand right before a program stop in its block.
    pub stop_messages: bool,
}

/// What a target can say of the order of blocks, and what it computes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FlowCaps {
    /// Subprograms.
    pub calls: bool,
    /// Subprograms are called by numbers of at most so many digits; 0 if by name.
    pub call_digits: u32,
    /// Repetition of blocks.
    pub repeats: bool,
    /// Repetition of blocks between labels.
    pub repeat_blocks: bool,
    /// It names both ends by their block numbers, and none stands within another.
    pub repeat_by_numbers: bool,
    /// Whether such a count includes the first pass is known of the machine.
    pub repeat_count_known: bool,
    /// Positions that a subprogram's caller gives the meaning to.
    pub inherits_motion: bool,
    /// Highest block-skip level; 0 if there is no block skip.
    pub skip_levels: u8,
    /// What it computes with when the program runs; `None` is nothing.
    pub computes: Option<Arc<Computes>>,
}
