//! The calls of a program as LinuxCNC's stand-alone interpreter prints them: shown to do what the program does.
//!
//! [`read_back`] executes a listing and holds its events against those of the program, in the order of `by_time`. Not
//! here: how a listing is written (`ncc_backends::canon::rs274`).

pub mod by_time;
pub mod read_back;
