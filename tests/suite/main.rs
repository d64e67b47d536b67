//! The tests that cross crates.

mod cycles;
mod second;
