//! The tests that cross crates.

mod second;
