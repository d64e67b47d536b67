//! ncc: the command line over the compiler (`ncc_driver`): arguments, files, verbs, printing.
//!
//! `run` goes from the arguments to the exit code. `order` and `review::side` make a job of options, profile and project
//! file; a verb's module does it and prints what came of it. Only this crate reads files and prints.
//!
//! ```text
//! ncc mach9 to fanuc part.cn    args → order (a job) → driver → render
//! ```
//!
//! Not here: the compiler, and the words of its messages.

pub mod args;
pub mod batch;
pub mod check;
pub mod doctor;
pub mod files;
pub mod fmt;
pub mod interrupt;
mod listing;
mod m_codes;
pub mod machines;
pub mod milling;
pub mod plot;
mod print_after;
pub mod project;
pub mod provenance;
pub mod registry;
mod report;
pub mod review;
pub mod run;
#[cfg(feature = "serve")]
pub mod serve;
pub mod simulate;
mod target_options;
pub mod time;
