//! The steps by which a database comes to the form that this ncc knows.
//!
//! The file has the number of the last step (`user_version`) and the mark of ncc (`application_id`), so that no other
//! file is changed by mistake. A step is never changed once it has been released; the next one follows it.

use rusqlite::{Connection, TransactionBehavior};

use super::StoreError;

/// The steps, in their order.
const STEPS: &[&str] = &[
    include_str!("migrations/001-documents.sql"),
    include_str!("migrations/002-programs.sql"),
    include_str!("migrations/003-translations.sql"),
    include_str!("migrations/004-states.sql"),
    include_str!("migrations/005-jobs.sql"),
];

/// The mark of ncc: `ncc1` in ASCII.
const MARK: i32 = 0x6e63_6331;

/// Takes all steps that are still to be taken.
pub(super) fn run(connection: &mut Connection) -> Result<(), StoreError> {
    let change = connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
    let number = |name| change.pragma_query_value(None, name, |row| row.get::<_, i32>(0));
    let tables: i64 = change.query_row("SELECT count(*) FROM sqlite_schema", [], |row| row.get(0))?;
    if number("application_id")? != MARK && tables > 0 {
        return Err(StoreError::Database("it is a database of another program".to_owned()));
    }
    let taken = usize::try_from(number("user_version")?).unwrap_or(usize::MAX);
    let left =
        STEPS.get(taken..).ok_or_else(|| StoreError::Database("it was written by a later ncc".to_owned()))?;
    // A database that is up to date is opened on a full disk too.
    if left.is_empty() {
        return Ok(());
    }
    for step in left {
        change.execute_batch(step)?;
    }
    change.pragma_update(None, "application_id", MARK)?;
    change.pragma_update(None, "user_version", STEPS.len() as i64)?;
    Ok(change.commit()?)
}
