//! The calls of a program as LinuxCNC's stand-alone interpreter prints them: shown to do what the program does.
//!
//! [`read_back`] executes a listing and holds its events against those of the program, in the order of `by_time`. Not
//! here: how a listing is written (`ncc_backends::canon::rs274`).
//!
//! ```text
//! `STRAIGHT_FEED(10.0000, …)` in a listing    the event of the program that it is
//! ```

pub mod by_time;
pub mod read_back;
