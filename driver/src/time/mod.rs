//! When a program does what: [`drive`] executes it with a clock, a sink makes one form of the result.
//!
//! [`csv`], [`payload`] and [`canon`] have every function with its time; [`tally`] sums them up for [`summary`];
//! [`parameters`] counts what programs are judged by; [`used`] has coolants and work offsets, [`recorder`] what charts show;
//! [`assumed`] lists what the times rest on. Not here: the clock
//! (`ncc_time`).
//!
//! ```text
//! a program, the model of a machine    drive    every function with its start and end    csv, payload, canon
//! ```

pub mod assumed;
pub mod blocks;
pub mod canon;
pub mod columns;
pub mod csv;
pub mod drive;
pub mod duration;
pub mod grid;
pub mod modes;
pub mod parameters;
pub mod payload;
pub mod reach;
pub mod recorder;
pub mod summary;
pub mod tally;
pub mod used;
