//! A pool of connections to an SQLite file.
//!
//! The file is in WAL mode: readers do not wait for the writer. A change is on the disk before it is acknowledged
//! (`synchronous = FULL`).

use std::path::{Path, PathBuf};
use std::time::Duration;

use r2d2::{ManageConnection, Pool};
use rusqlite::{Connection, ErrorCode, OpenFlags, TransactionBehavior};

use super::{StoreError, migrations};

/// How long a writer waits for its turn, and a request for a connection.
const PATIENCE: Duration = Duration::from_secs(10);

/// Connections at most.
const CONNECTIONS: u32 = 16;

/// The database.
pub(super) struct Database {
    pool: Pool<File>,
}

/// The file.
struct File(PathBuf);

impl ManageConnection for File {
    type Connection = Connection;
    type Error = rusqlite::Error;

    fn connect(&self) -> Result<Connection, rusqlite::Error> {
        let connection = Connection::open_with_flags(
            &self.0,
            OpenFlags::SQLITE_OPEN_READ_WRITE
                | OpenFlags::SQLITE_OPEN_CREATE
                | OpenFlags::SQLITE_OPEN_NO_MUTEX,
        )?;
        connection.busy_timeout(PATIENCE)?;
        connection.pragma_update(None, "journal_mode", "WAL")?;
        connection.pragma_update(None, "synchronous", "FULL")?;
        connection.pragma_update(None, "foreign_keys", true)?;
        connection.set_prepared_statement_cache_capacity(64);
        Ok(connection)
    }

    fn is_valid(&self, connection: &mut Connection) -> Result<(), rusqlite::Error> {
        connection.execute_batch("")
    }

    fn has_broken(&self, _connection: &mut Connection) -> bool {
        false
    }
}

impl Database {
    pub(super) fn open(file: &Path) -> Result<Database, StoreError> {
        // A first connection tells what is wrong with the file; the pool would try again until its patience ends.
        let file = File(file.to_owned());
        let mut first = file.connect()?;
        migrations::run(&mut first)?;
        drop(first);
        let pool = Pool::builder()
            .max_size(CONNECTIONS)
            .min_idle(Some(1))
            .connection_timeout(PATIENCE)
            .test_on_check_out(false)
            .build(file)
            .map_err(|error| StoreError::Database(error.to_string()))?;
        Ok(Database { pool })
    }

    /// Reads: what it sees is of one moment.
    pub(super) fn read<T>(
        &self,
        work: impl FnOnce(&Connection) -> Result<T, StoreError>,
    ) -> Result<T, StoreError> {
        let mut connection = self.pool.get().map_err(|_| StoreError::Busy)?;
        let moment = connection.transaction_with_behavior(TransactionBehavior::Deferred)?;
        work(&moment)
    }

    /// Changes: all of it is done, or nothing.
    pub(super) fn write<T>(
        &self,
        work: impl FnOnce(&Connection) -> Result<T, StoreError>,
    ) -> Result<T, StoreError> {
        let mut connection = self.pool.get().map_err(|_| StoreError::Busy)?;
        let change = connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
        let done = work(&change)?;
        change.commit()?;
        Ok(done)
    }
}

impl From<rusqlite::Error> for StoreError {
    fn from(error: rusqlite::Error) -> StoreError {
        match (&error, error.sqlite_error_code()) {
            (rusqlite::Error::QueryReturnedNoRows, _) => StoreError::Absent,
            (_, Some(ErrorCode::DiskFull)) => StoreError::Full,
            (_, Some(ErrorCode::DatabaseBusy | ErrorCode::DatabaseLocked)) => StoreError::Busy,
            _ => StoreError::Database(error.to_string()),
        }
    }
}
