//! The steps by which a database comes to the form that this ncc knows.
//!
//! A step is in the words of SQLite; `postgres` changes the few that differ. Lines after `-- in sqlite` or `-- in postgres`
//! are for this database alone, up to `-- in both`. A step is never changed once it has been released; the next one follows it.

use super::StoreError;

/// The steps, in their order.
pub(super) const STEPS: &[&str] = &[
    include_str!("migrations/001-documents.sql"),
    include_str!("migrations/002-programs.sql"),
    include_str!("migrations/003-translations.sql"),
    include_str!("migrations/004-states.sql"),
    include_str!("migrations/005-jobs.sql"),
    include_str!("migrations/006-users.sql"),
    include_str!("migrations/007-audit.sql"),
    include_str!("migrations/008-search.sql"),
    include_str!("migrations/009-stale.sql"),
    include_str!("migrations/011-comparisons.sql"),
    include_str!("migrations/012-hooks.sql"),
    include_str!("migrations/013-machine-revisions.sql"),
    include_str!("migrations/014-dialects.sql"),
];

/// The steps that are left, where so many have been taken.
///
/// # Errors
/// More have been taken than this ncc knows.
pub(super) fn left(taken: i64) -> Result<&'static [&'static str], StoreError> {
    let taken = usize::try_from(taken).unwrap_or(usize::MAX);
    STEPS.get(taken..).ok_or_else(|| StoreError::Database("it was written by a later ncc".to_owned()))
}

/// The lines of a step that are for a database: `sqlite` or `postgres`.
pub(super) fn lines_for(step: &str, database: &str) -> String {
    let mut is_ours = true;
    let mut lines = String::new();
    for line in step.lines() {
        match line.strip_prefix("-- in ") {
            Some(whose) => is_ours = whose == database || whose == "both",
            None if is_ours => {
                lines.push_str(line);
                lines.push('\n');
            }
            None => {}
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_database_takes_its_lines() {
        let step = "a\n-- in sqlite\nb\n-- in postgres\nc\n-- in both\nd\n";
        assert_eq!(lines_for(step, "sqlite"), "a\nb\nd\n");
        assert_eq!(lines_for(step, "postgres"), "a\nc\nd\n");
    }
}
