//! ncc: the command line, and the pipeline behind it as a library for tests.

pub mod job;
