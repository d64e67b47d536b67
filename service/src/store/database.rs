//! The one way to the database, whichever it is.

use std::sync::OnceLock;
use std::time::Duration;

use r2d2::{ManageConnection, Pool};

use super::postgres::{self, Server};
use super::session::Session;
use super::sqlite::{self, File};
use super::{Place, StoreError};

/// Time limit of a writer that waits for the lock, and of a request that waits for a connection.
pub(super) const PATIENCE: Duration = Duration::from_secs(10);

/// Time after which an idle connection is closed, but for the last one. A database server has few for many processes.
const IDLE: Duration = Duration::from_secs(10);

/// Connections at most.
const CONNECTIONS: u32 = 16;

/// The database.
pub(super) enum Database {
    File(Pool<File>),
    Server(Pool<Server>),
}

fn pool<M: ManageConnection>(manager: M) -> Result<Pool<M>, StoreError> {
    Pool::builder()
        .max_size(CONNECTIONS)
        .min_idle(Some(1))
        .idle_timeout(Some(IDLE))
        .connection_timeout(PATIENCE)
        .test_on_check_out(false)
        .build(manager)
        .map_err(|error| StoreError::Database(error.to_string()))
}

impl Database {
    pub(super) fn open(place: &Place) -> Result<Database, StoreError> {
        // A first connection tells what is wrong; the pool would try again until its patience ends.
        match place {
            Place::File(path) => {
                sqlite::make(path).map_err(|error| StoreError::Database(error.to_string()))?;
                let file = File { path: path.clone(), patience: PATIENCE, first: OnceLock::new() };
                sqlite::migrate(&mut file.connect()?)?;
                Ok(Database::File(pool(file)?))
            }
            Place::Server(address) => {
                let server = Server::at(address, PATIENCE)?;
                let first = server.connect();
                let cannot = |error| StoreError::Database(postgres::words(&error));
                postgres::migrate(&mut first.map_err(cannot)?)?;
                Ok(Database::Server(pool(server)?))
            }
        }
    }

    fn within<T>(
        &self,
        writes: bool,
        work: impl FnOnce(&dyn Session) -> Result<T, StoreError>,
    ) -> Result<T, StoreError> {
        match self {
            Database::File(pool) => {
                sqlite::within(&mut *pool.get().map_err(|_| StoreError::Busy)?, writes, work)
            }
            Database::Server(pool) => {
                postgres::within(&mut *pool.get().map_err(|_| StoreError::Busy)?, writes, work)
            }
        }
    }

    /// Reads: what it sees is of one moment.
    pub(super) fn read<T>(
        &self,
        work: impl FnOnce(&dyn Session) -> Result<T, StoreError>,
    ) -> Result<T, StoreError> {
        self.within(false, work)
    }

    /// Changes: all of it is done, or nothing. Changes follow each other.
    pub(super) fn write<T>(
        &self,
        work: impl FnOnce(&dyn Session) -> Result<T, StoreError>,
    ) -> Result<T, StoreError> {
        self.within(true, work)
    }
}
