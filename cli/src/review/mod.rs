//! Judging programs: what two of them do, held side by side.
//!
//! `side` is a program named on the command line, `stream` executes it whole in given worlds, `feed`
//! makes records of what it does. What is found is told by the verbs' own rooms; `cert` checks again what
//! `verify` has certified. Not here: what a difference is (ncc-diff).
//!
//! ```text
//! ncc diff old.nc new.nc       what moves otherwise, at which line of each
//! ncc verify part.nc part.mpf  whether both make the same cut
//! ```

pub mod args;
pub mod cert;
pub mod diff;
pub(crate) mod side;
pub mod textconv;
pub mod verify;
