//! The tests that cross crates.

mod cycles;
mod expected;
mod faults;
mod laws;
mod pages;
mod pairs;
mod passes;
mod second;
mod text_forms;
mod tidy;
