//! Numbers that are computed when the program runs, in places where other controls want a number that is written: codes,
//! calls, entries of tables; and what of a program that computes a target can say.
//!
//! ```text
//! G#100 X10          computed_code     the code with the number that is computed
//! #[2000 + #1]       computed_entry    an entry of a table by a computed number
//! ```
//!
//! Not here: the values themselves (`expr`).

pub mod alarm_texts;
pub mod assigned_variables;
pub mod computed_call;
pub mod computed_code;
pub mod computed_entry;
pub mod computes;
pub mod free_variables;
