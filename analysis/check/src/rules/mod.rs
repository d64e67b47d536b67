//! The rules, one file each: plain functions that are shown what happens.
//!
//! ```text
//! rapid-into-part    G0 Z-5. above a place that was cut from Z 0    a finding at the block
//! ```
//!
//! Not here: which rules are run, and how findings are shown.

pub(crate) mod feed;
pub(crate) mod left;
pub(crate) mod length;
pub(crate) mod points;
pub(crate) mod rapid;
pub(crate) mod speed;
pub(crate) mod spindle;
pub(crate) mod thread;
pub(crate) mod travel;
