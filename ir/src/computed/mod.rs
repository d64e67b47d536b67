//! Numbers that are computed when the program runs, in places where other controls want a number that is written: codes,
//! calls, entries of tables; and what of a program that computes a target can say.
//!
//! ```text
//! G#100 X10          code_of     the code with the number that is computed
//! #[2000 + #1]       entry_of    an entry of a table by a computed number
//! ```
//!
//! Not here: the values themselves (`expr`).

pub mod call_of;
pub mod changed;
pub mod code_of;
pub mod computes;
pub mod entry_of;
pub mod open;
