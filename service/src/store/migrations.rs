//! The steps by which a database comes to the form that this ncc knows.
//!
//! A step is in the words of SQLite; `postgres` changes the few that differ. It is never changed once it has been released;
//! the next one follows it.

use super::StoreError;

/// The steps, in their order.
pub(super) const STEPS: &[&str] = &[
    include_str!("migrations/001-documents.sql"),
    include_str!("migrations/002-programs.sql"),
    include_str!("migrations/003-translations.sql"),
    include_str!("migrations/004-states.sql"),
    include_str!("migrations/005-jobs.sql"),
];

/// The steps that are left, where so many have been taken.
///
/// # Errors
/// More have been taken than this ncc knows.
pub(super) fn left(taken: i64) -> Result<&'static [&'static str], StoreError> {
    let taken = usize::try_from(taken).unwrap_or(usize::MAX);
    STEPS.get(taken..).ok_or_else(|| StoreError::Database("it was written by a later ncc".to_owned()))
}
