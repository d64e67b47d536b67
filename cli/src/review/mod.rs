//! Judging programs: what two of them do, held side by side.
//!
//! `side` is a program named on the command line, `comparison` compares two of them, and the verbs report the
//! result in folders of their own; `cert` checks again what `verify` has certified.
//! Not here: what a difference is (ncc-diff).
//!
//! ```text
//! ncc diff old.nc new.nc       what moves otherwise, at which line of each
//! ncc verify part.nc part.mpf  whether both make the same cut
//! ```

pub mod args;
pub mod cert;
mod comparison;
pub mod diff;
pub(crate) mod side;
pub mod textconv;
pub mod verify;
