//! Programs that compute: assignments, jumps, calls, and computed numbers in the place of
//! codes and of entries in tables; in the macro language and in O words.
//!
//! ```text
//! #1 = #2 * 2                an assignment
//! o100 if [#1 GT 5]          a branch in O words
//! ```
//!
//! Not here: expressions (`common::formula`), and passes that bring expressions within the target's capabilities.

pub(super) mod alarm;
pub(super) mod computed_call;
pub(super) mod computed_code;
pub(super) mod computed_entry;
pub(super) mod computed_jump;
pub(super) mod computing;
pub(super) mod modal_call;
pub(super) mod o_words;
pub(super) mod output;
