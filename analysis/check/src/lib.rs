//! ncc-check: rules for an executed part program and for its text.
//!
//! A [`Checker`] executes the statements one by one and shows each event to the rules, plain functions
//! in `rules/`. A [`Finding`] is data with a span in the source.
//!
//! ```text
//! M5
//! G1 X20. F100.      finding NC0805: feed move with the spindle stopped
//! ```
//!
//! The checker never guesses a state. A block that was not read, or a table that nobody states, makes
//! the state unknown: rules that need it are silent until the program sets it again. [`Unchecked`]
//! lists what no rule could check.
//!
//! Not here: reading programs and profiles, any dialect's name, words for people, printing.

mod finding;
pub mod flow;
mod limits;
mod met;
mod rule;
mod rules;
mod seen;
mod watch;
mod watched;

pub use finding::{Finding, Findings, LeftOn, Outside, Setting, StandardPitch, What};
pub use limits::{Limits, Unchecked};
pub use rule::{Rule, Severity};
pub use watch::{Checked, Checker, Refusal};
