//! Reader of the canonical stream.
pub(crate) mod text;
