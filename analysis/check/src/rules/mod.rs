//! The rules, one file each: plain functions that are shown what happens.

pub(crate) mod feed;
pub(crate) mod left;
pub(crate) mod length;
pub(crate) mod points;
pub(crate) mod rapid;
pub(crate) mod speed;
pub(crate) mod spindle;
pub(crate) mod travel;
