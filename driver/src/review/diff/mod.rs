//! Do two programs make the same cut? If not, what differs: [`motion`] finds it, [`tell`] has one account of it, which
//! [`html`] and [`json`] lay out.
//!
//! ```text
//! G1 X10 | G1 X10.5    the end of the move differs by 0.5 mm, at line 4 of both
//! ```
//!
//! Not here: which differences there are (`ncc_diff`).

pub mod account;
pub mod html;
pub mod json;
pub mod motion;
pub mod tell;
pub(crate) mod wording;
