//! Numbers that are computed when the program runs, in places where other controls want a number that is written: codes,
//! calls, entries of tables; and what of a program that computes a target can say.

pub mod call_of;
pub mod changed;
pub mod code_of;
pub mod computes;
pub mod entry_of;
pub mod open;
