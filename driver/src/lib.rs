//! The compiler of ncc as a library: sources, results and diagnostics are values.
//!
//! A [`Job`](job::Job) says what is translated into what, [`translate`](translate::translate) does it, and the
//! [`Outcome`](job::Outcome) has the output, all that was found, and whether the output may be used. An output that was
//! not shown to make the same cut is not released.
//!
//! ```
//! use std::io::Cursor;
//!
//! use ncc_dialects::{Settings, builtin};
//! use ncc_driver::job::Job;
//! use ncc_driver::translate::translate;
//!
//! let [haas, fanuc] = ["haas", "fanuc"].map(|id| Settings::new(builtin(id).expect("a built-in dialect")));
//! let job = Job { head: false, ..Job::new(haas, fanuc, "part.nc") };
//! let mut source = Cursor::new("G21 G90 G17 G40\nG00 Z50.\nG00 X10. Y5.\nM30\n");
//! let mut outcome = translate(&job, &mut source)?;
//! assert_eq!(outcome.release, Ok(()));
//! let text = String::from_utf8(outcome.output.to_vec()?).expect("plain text");
//! assert!(text.contains("X10. Y5."));
//! # Ok::<(), std::io::Error>(())
//! ```
//!
//! | to | there is |
//! |---|---|
//! | say what is asked for | [`job`], [`machines`], [`job::initial_variables`] (what variables hold), [`job::project_answers`] |
//! | give it programs | [`source`], [`source::include_path`] (programs that it calls, by name) |
//! | know the dialect | [`guess`], [`source::not_milling`] |
//! | translate | [`translate`], [`questions`], [`translate::split`] (one text as several files) |
//! | compare two programs | [`side`], [`review`], [`translate::judge`] |
//! | time, check, lay out | [`time`], [`check`], [`fmt`] |
//! | let programs of the user process custom functions | [`functions`] |
//! | say where text comes from | [`provenance`] |
//! | tell it | [`render`], [`render::report`], [`render::explain`], [`render::dialects`] |
//!
//! Nothing here prints, knows a command line, or looks at a clock. Bytes are kept in memory, and in files only where the
//! host gives a way to make them ([`source::spool`]). A host that is asked to stop says so by `ncc_exec::halt`.
//!
//! Not here: what a program says (`ncc_ir`), what a machine does (`ncc_exec`), rewriting (`ncc_passes`), and how texts
//! are read and written (`ncc_frontends`, `ncc_backends`).

pub mod check;
pub mod dialect_test;
pub mod fmt;
pub mod functions;
pub mod guess;
pub mod job;
pub mod listing;
pub mod machines;
pub mod names;
pub mod problem;
pub mod provenance;
pub mod questions;
pub mod render;
pub mod review;
pub mod side;
mod side_by_side;
pub mod simulate;
pub mod source;
mod stretches;
pub mod time;
pub mod translate;
pub mod verify_run;
