//! The macro language: expressions, assignments, jumps, loops, and computed numbers in the place of codes
//! and of entries in tables.
//!
//! ```text
//! #1 = #2 * 2                an assignment
//! IF [#1 GT 5] GOTO 100      a branch
//! ```
//!
//! Not here: the language of O words (`o_code`).

pub(super) mod computed_code;
pub(super) mod computed_entry;
pub(super) mod computed_jump;
pub(super) mod computes;
pub(super) mod computing;
pub(super) mod control_set;
pub(super) mod formula;
pub(super) mod named_blocks;
pub(super) mod output;
