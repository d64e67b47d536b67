//! ncc-ir: what a part program means, without the name of any control.
//!
//! Two representations answer two questions. [`program::Program`] is what the program *says*:
//! structured, symbolic, the form that passes rewrite. The canonical stream, [`exec::Event`]s made
//! by executing a `Program` in a [`world::World`], is what the machine *does*; [`verify`] compares
//! two of them. Numbers are exact decimals ([`num`]); a binary float lives only in geometry.
//!
//! This crate knows no dialect by name, reads no file and prints nothing.

pub mod alarms;
pub mod arc_feed;
pub mod arguments;
pub mod behaviour;
pub mod beside;
pub mod call_of;
pub mod canon;
pub mod caps;
pub mod changed;
pub mod code_of;
pub mod compensated;
pub mod computes;
pub mod corner;
pub mod cycle;
pub mod decimals;
pub mod diag;
pub mod entry_of;
pub mod exec;
pub mod expr;
pub mod fails;
pub mod geometry;
pub mod given_back;
pub mod halt;
mod kinds;
pub mod letters;
pub mod maps;
pub mod num;
pub mod open;
pub mod passes;
pub mod places;
pub mod polar;
pub mod program;
pub mod rank;
pub mod round;
pub mod shown;
pub mod source;
pub mod system;
pub mod track;
pub mod types;
pub mod units;
pub mod valid;
pub mod value;
pub mod verify;
pub mod world;
