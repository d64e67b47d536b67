//! A program on a part: its moves, its tools and its raw part for the kernel of stock removal (`ncc_simulate`).
//!
//! [`path`] takes the moves of a program as it is executed with a clock, [`tooling`] says which tools it has, [`raw`] which
//! part it starts from, [`cut`] puts them together, and [`document`] and [`told`] have the result as data and in words.
//!
//! ```text
//! a program, a profile, a raw part    →    what each tool removed, alarms, the part after any move
//! ```
//!
//! A tool or a raw part that nobody has stated is guessed, which is marked wherever something rests on it. Not here: stock
//! removal itself, pictures, files.

pub mod columns;
pub mod comments;
pub mod compare;
pub mod cut;
pub mod described;
pub mod document;
pub mod files;
pub mod modes;
pub mod path;
mod planes;
pub mod raw;
pub mod surroundings;
pub mod told;
pub mod tooling;
pub mod unsimulated;
