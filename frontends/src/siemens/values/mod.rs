//! Computed values: variables of the program and of the control, expressions with their types, texts.
//!
//! ```text
//! DEF REAL DEPTH=-5          a variable with its first value
//! R1=$P_UIFR[1,X,TR]         the X of a work offset
//! ```
//!
//! Not here: jumps and loops (`program`).

pub(super) mod computed_entry;
pub(super) mod computing;
pub(super) mod control;
pub(super) mod formula;
pub(super) mod texts;
pub(super) mod typed;
pub(super) mod variables;
