//! The tests that cross crates.

// What was tried is told with `--nocapture`.
#![allow(clippy::print_stdout)]

mod anywhere;
mod beside;
mod check;
mod computing;
mod computing_pages;
mod controls;
mod cycles;
mod dialects;
mod dictionary_form;
mod diff;
mod doctor;
mod essay;
mod everyday;
mod expected;
mod faults;
mod fmt;
mod fold;
mod generated;
mod kept;
mod laws;
mod limits;
mod machines;
mod options;
mod order;
mod pages;
mod pairs;
mod passes;
mod provenance;
mod questions;
mod recognise;
mod rooms;
mod rows;
mod rs274;
mod schema;
mod second;
mod shared;
mod shop_programs;
mod shop_siemens;
mod shop_stops;
mod shop_tools;
mod siemens_peer;
mod siemens_second;
mod spliced;
mod stable;
mod structure;
mod tables;
mod text_forms;
mod tidy;
mod time;
mod time_modes;
mod twice;
mod variants;
mod verify;
