//! Two given programs compared as strictly as a translation is verified: [`pair`] compares, [`document`] is the result
//! and the certificate, [`text`] is the document for people.

pub mod document;
pub mod hashes;
pub mod pair;
pub mod text;
