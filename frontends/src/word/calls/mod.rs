//! Lowering of calls and returns, and of blocks that run again.
//!
//! ```text
//! M98 P1000 L3               a call of subprogram 1000, repeat count 3
//! G65 P9010 X5. Z-2.         a macro call with two arguments
//! ```
//!
//! Not here: the language of O words (`o_code`).

pub(super) mod bound_function;
pub(super) mod call;
pub(super) mod computed_call;
pub(super) mod function_state;
pub(super) mod local_call;
pub(super) mod macro_call;
pub(super) mod modal_call;
pub(super) mod repeated_blocks;
pub(super) mod repetition;
pub(super) mod return_to;
