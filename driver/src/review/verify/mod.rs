//! Two given programs compared as strictly as a translation is verified: [`pair`] compares, [`document`] is the result
//! and the certificate, [`text`] is the document for people.
//!
//! ```text
//! part.nc, part.mpf    the document: verified, 162 events, or the first event that differs
//! ```
//!
//! Not here: how events are compared (`ncc_exec::verify`).

pub mod document;
pub mod hashes;
mod in_step;
pub mod pair;
mod plan;
pub mod text;
