//! A pool of connections to an SQLite file.
//!
//! The file is in WAL mode: readers do not wait for the writer. A change is on the disk before it is acknowledged
//! (`synchronous = FULL`). The file has the number of the last migration (`user_version`) and the mark of ncc
//! (`application_id`), so that no other file is changed by mistake.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::Duration;

use r2d2::ManageConnection;
use rusqlite::types::{ToSqlOutput, ValueRef};
use rusqlite::{CachedStatement, Connection, ErrorCode, OpenFlags, ToSql, TransactionBehavior};
use same_file::Handle;

use super::StoreError;
use super::migrations::{self, STEPS};
use super::session::{Row, Session, Value};

/// The mark of ncc: `ncc1` in ASCII.
pub(super) const MARK: i32 = 0x6e63_6331;

/// The file.
pub(super) struct File {
    pub(super) path: PathBuf,
    /// Time limit of a writer that waits for the lock.
    pub(super) patience: Duration,
    /// The file as it was first opened. Where another one has taken its place, connections to both would mix two databases.
    pub(super) first: OnceLock<Handle>,
}

impl File {
    /// Whether the file is still the one that was opened first.
    fn is_the_same(&self) -> Result<bool, rusqlite::Error> {
        let cannot = |error: std::io::Error| rusqlite::Error::ToSqlConversionFailure(error.into());
        let now = Handle::from_path(&self.path).map_err(cannot)?;
        Ok(*self.first.get_or_init(|| now) == Handle::from_path(&self.path).map_err(cannot)?)
    }
}

impl ManageConnection for File {
    type Connection = Connection;
    type Error = rusqlite::Error;

    fn connect(&self) -> Result<Connection, rusqlite::Error> {
        let connection = Connection::open_with_flags(
            &self.path,
            OpenFlags::SQLITE_OPEN_READ_WRITE
                | OpenFlags::SQLITE_OPEN_CREATE
                | OpenFlags::SQLITE_OPEN_NO_MUTEX,
        )?;
        connection.busy_timeout(self.patience)?;
        connection.pragma_update(None, "journal_mode", "WAL")?;
        connection.pragma_update(None, "synchronous", "FULL")?;
        connection.pragma_update(None, "foreign_keys", true)?;
        connection.set_prepared_statement_cache_capacity(128);
        match self.is_the_same()? {
            true => Ok(connection),
            false => Err(rusqlite::Error::InvalidPath(self.path.clone())),
        }
    }

    fn is_valid(&self, connection: &mut Connection) -> Result<(), rusqlite::Error> {
        connection.execute_batch("")
    }

    fn has_broken(&self, _connection: &mut Connection) -> bool {
        false
    }
}

/// Makes the file of a new database, which other users of this computer cannot read: it has digests of passwords. SQLite gives
/// the files beside it the same rights.
pub(super) fn make(path: &Path) -> std::io::Result<()> {
    // To SQLite this is no file, and each connection would have a database of its own.
    if path == Path::new(":memory:") {
        return Err(std::io::ErrorKind::InvalidInput.into());
    }
    let mut options = std::fs::OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    match options.open(path) {
        Err(error) if error.kind() != std::io::ErrorKind::AlreadyExists => Err(error),
        _ => Ok(()),
    }
}

/// Takes the migrations that are still to be taken.
pub(super) fn migrate(connection: &mut Connection) -> Result<(), StoreError> {
    let change = connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
    let number = |name| change.pragma_query_value(None, name, |row| row.get::<_, i32>(0));
    let tables: i64 = change.query_row("SELECT count(*) FROM sqlite_schema", [], |row| row.get(0))?;
    if number("application_id")? != MARK && tables > 0 {
        return Err(StoreError::Database("it is a database of another program".to_owned()));
    }
    let left = migrations::left(number("user_version")?.into())?;
    // A database that is up to date is opened on a full disk too.
    if left.is_empty() {
        return Ok(());
    }
    for step in left {
        change.execute_batch(&migrations::lines_for(step, "sqlite"))?;
    }
    change.pragma_update(None, "application_id", MARK)?;
    change.pragma_update(None, "user_version", STEPS.len() as i64)?;
    Ok(change.commit()?)
}

/// Does something in a transaction.
pub(super) fn within<T>(
    connection: &mut Connection,
    writes: bool,
    work: impl FnOnce(&dyn Session) -> Result<T, StoreError>,
) -> Result<T, StoreError> {
    let behavior = if writes { TransactionBehavior::Immediate } else { TransactionBehavior::Deferred };
    let transaction = connection.transaction_with_behavior(behavior)?;
    let done = work(&Open(&transaction))?;
    transaction.commit()?;
    Ok(done)
}

/// A transaction that is open.
struct Open<'c>(&'c Connection);

impl Open<'_> {
    /// A statement with its values.
    fn bound(&self, sql: &str, values: &[Value]) -> Result<CachedStatement<'_>, StoreError> {
        let mut statement = self.0.prepare_cached(sql)?;
        for (at, value) in values.iter().enumerate() {
            // `$1` is a name for SQLite.
            if let Some(index) = statement.parameter_index(&format!("${}", at + 1))? {
                statement.raw_bind_parameter(index, value)?;
            }
        }
        Ok(statement)
    }
}

impl Session for Open<'_> {
    fn rows(&self, sql: &str, values: &[Value]) -> Result<Vec<Row>, StoreError> {
        let mut statement = self.bound(sql, values)?;
        let columns = statement.column_count();
        let mut rows = statement.raw_query();
        let mut all = Vec::new();
        while let Some(row) = rows.next()? {
            let value = |column| {
                Ok::<_, rusqlite::Error>(match row.get_ref(column)? {
                    ValueRef::Null => Value::Null,
                    ValueRef::Integer(number) => Value::Int(number),
                    ValueRef::Text(text) => Value::Text(String::from_utf8_lossy(text).into_owned()),
                    ValueRef::Blob(bytes) => Value::Bytes(bytes.to_vec()),
                    ValueRef::Real(_) => return Err(rusqlite::Error::InvalidQuery),
                })
            };
            all.push(Row((0..columns).map(value).collect::<Result<_, _>>()?));
        }
        Ok(all)
    }

    fn change(&self, sql: &str, values: &[Value]) -> Result<u64, StoreError> {
        Ok(self.bound(sql, values)?.raw_execute()? as u64)
    }

    fn with_numbers(&self) -> &'static str {
        ""
    }

    fn count_on(&self, _table: &str, _column: &str) -> Result<(), StoreError> {
        Ok(())
    }
}

impl ToSql for Value {
    fn to_sql(&self) -> rusqlite::Result<ToSqlOutput<'_>> {
        Ok(ToSqlOutput::Borrowed(match self {
            Value::Null => ValueRef::Null,
            Value::Bool(value) => ValueRef::Integer((*value).into()),
            Value::Int(number) => ValueRef::Integer(*number),
            Value::Text(text) => ValueRef::Text(text.as_bytes()),
            Value::Bytes(bytes) => ValueRef::Blob(bytes),
        }))
    }
}

impl From<rusqlite::Error> for StoreError {
    fn from(error: rusqlite::Error) -> StoreError {
        match error.sqlite_error_code() {
            Some(ErrorCode::DiskFull) => StoreError::Full,
            Some(ErrorCode::DatabaseBusy | ErrorCode::DatabaseLocked) => StoreError::Busy,
            _ => StoreError::Database(error.to_string()),
        }
    }
}

// Windows does not move a file that is open.
#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn another_file_in_its_place_is_not_opened() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.sqlite");
        let file = File { path: path.clone(), patience: Duration::from_secs(1), first: OnceLock::new() };
        let first = file.connect().expect("a file");
        file.connect().expect("the same file");
        drop(first);
        std::fs::rename(&path, folder.path().join("moved.sqlite")).expect("moved");
        assert!(file.connect().is_err());
    }
}
