//! ncc-check: rules over what a part program does, and what the text says of it.
//!
//! A [`Checker`] executes the statements of a program one by one and looks at the functions that they
//! make; each rule is a plain function in `rules/`. What it finds is data with places in the source
//! ([`Finding`]). A state that cannot be known, because a block was not read or a table is not stated, is
//! never guessed: the rules that need it are silent until the program has said it again, and what was
//! not checked is told ([`Unchecked`]).
//!
//! Not here: reading programs and profiles, any dialect's name, words for people, printing.

mod finding;
pub mod flow;
mod limits;
mod rule;
mod rules;
mod seen;
mod watch;

pub use finding::{Finding, Findings, LeftOn, Outside, Setting, What};
pub use limits::{Limits, Unchecked};
pub use rule::{Rule, Severity};
pub use watch::{Checked, Checker, Refusal};
