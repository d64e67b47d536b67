//! ncc: the command line, and the pipeline behind it as a library for tests.
//!
//! `run` goes from the arguments to the exit code, `job` is the face of the pipeline in
//! `translate`, `render` turns typed diagnostics into words. Only this crate reads files and prints.

pub mod args;
pub mod arrow;
pub mod batch;
pub mod called;
pub mod check;
mod chunks;
pub mod dialect_test;
pub mod dialects;
mod difference;
pub mod doctor;
pub mod explain;
pub mod files;
pub mod fmt;
pub mod given;
pub mod guess;
pub mod head;
pub mod interrupt;
pub mod job;
pub mod judge;
pub mod known;
mod listing;
mod m_codes;
pub mod machines;
pub mod milling;
mod order;
pub mod plot;
pub mod problem;
pub mod project;
pub mod provenance;
pub mod questions;
pub mod render;
pub mod report;
pub mod review;
pub mod rewrite;
pub mod run;
pub mod scratch;
pub mod setting;
pub mod sugar;
pub mod time;
mod tools_by_name;
pub mod translate;
mod verify_run;
