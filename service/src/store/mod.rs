//! The data of the service, in a database.
//!
//! `database` is the one way to it, an SQLite file (`sqlite`) or a PostgreSQL server (`postgres`) under one `session`;
//! `documents`, `programs`, texts of the `shop` and their `contents` are what is kept, `facts` what programs do, `comparisons` what
//! revisions changed, `search` finds them, `hooks` tell others of them,
//! and `backup` copies all of it. Every change is one transaction: it is there as a whole, or not at all. Not here: what a
//! document says, and HTTP.

mod accounts;
mod audit;
mod backup;
mod comparisons;
mod contents;
mod database;
mod documents;
mod facts;
mod hooks;
mod jobs;
mod logins;
mod migrations;
mod postgres;
mod programs;
mod search;
mod session;
mod shop;
mod sqlite;
mod states;
mod translations;

use std::fmt;
use std::path::PathBuf;
use std::sync::Arc;

use sha2::{Digest, Sha256};

use self::database::Database;
use crate::rights::{Act, Who};

pub(crate) use self::accounts::{Account, AccountChange};
pub(crate) use self::audit::{Entry, Filter};
pub(crate) use self::backup::{backup, restore};
pub(crate) use self::comparisons::{Comparison, Pair, Verdict};
pub(crate) use self::contents::{Content, Receiving};
pub(crate) use self::documents::{Condition, Listed, Parts};
pub(crate) use self::facts::{CALLS_ABSENT, Claimed, Computed, Term, calls};
pub(crate) use self::hooks::{Attempt, Delivery, Due, EventKind, Hook, HookState};
pub(crate) use self::jobs::{End, Job, Task, TaskResult};
pub(crate) use self::logins::{LONGEST, Token};
pub(crate) use self::programs::{Change, Details, Once, Revision, Said, Wanted};
pub(crate) use self::search::{Found, Hit, OfProgram, Range, Shown, Sought};
pub(crate) use self::shop::{ShopRevision, ShopText, Sort};
pub(crate) use self::states::{State, Step};
pub(crate) use self::translations::{Outcome, Translation};

/// An error of the store.
#[derive(Debug)]
pub(crate) enum StoreError {
    /// Nothing has this name.
    Absent,
    /// Something has this name already.
    Exists,
    /// It is not what the writer has read.
    Changed,
    /// The user has no right to it.
    Forbidden,
    /// Nobody could administer any more.
    LastAdmin,
    /// The key of a request that may be sent again was used for another request.
    Reused,
    /// There are as many as there may be.
    TooMany,
    /// The disk is full.
    Full,
    /// Others write: it did not get its turn in time.
    Busy,
    /// The database's own words.
    Database(String),
}

impl fmt::Display for StoreError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            StoreError::Absent => out.write_str("nothing has this name"),
            StoreError::Exists => out.write_str("the name is taken"),
            StoreError::Changed => out.write_str("it has been changed meanwhile"),
            StoreError::Forbidden => out.write_str("there is no right to it"),
            StoreError::LastAdmin => out.write_str("an admin of everything has to stay"),
            StoreError::Reused => out.write_str("the key was used for another request"),
            StoreError::TooMany => out.write_str("there are as many as there may be"),
            StoreError::Full => out.write_str("the disk is full"),
            StoreError::Busy => out.write_str("others write for too long"),
            StoreError::Database(words) => out.write_str(words),
        }
    }
}

impl std::error::Error for StoreError {}

/// The place of the database.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// An SQLite file.
    File(PathBuf),
    /// A PostgreSQL server: `postgres://user:password@host/database`.
    Server(String),
}

/// The store, for a user. All of them share the database.
#[derive(Clone)]
pub(crate) struct Store {
    database: Arc<Database>,
    /// The user whose rights hold, and who is the author of changes.
    who: Arc<Who>,
}

impl Store {
    /// Opens a database; a file is made where it is not there.
    ///
    /// # Errors
    /// It is no database of ncc, one of a later ncc, or cannot be reached or written.
    pub(crate) fn open(place: &Place) -> Result<Store, StoreError> {
        let store = Store { database: Arc::new(Database::open(place)?), who: Arc::new(Who::service()) };
        store.tidy()?;
        store.renew_facts()?;
        Ok(store)
    }

    /// The same store for a user.
    pub(crate) fn of(&self, who: Arc<Who>) -> Store {
        Store { database: Arc::clone(&self.database), who }
    }

    /// The user may do something in a folder. A folder that may not be read is as one that is not there. Machines and
    /// accounts are no secret.
    fn may(&self, act: Act, folder: &str) -> Result<(), StoreError> {
        match (self.who.may(act, folder), act == Act::Administer || self.who.may(Act::Read, folder)) {
            (true, _) => Ok(()),
            (false, true) => Err(StoreError::Forbidden),
            (false, false) => Err(StoreError::Absent),
        }
    }

    /// The user may do something in a folder that the user has named.
    fn may_put_into(&self, folder: &str) -> Result<(), StoreError> {
        if self.who.may(Act::Change, folder) { Ok(()) } else { Err(StoreError::Forbidden) }
    }

    /// The account whose rights decide what a list has; nothing where the user may read everything.
    fn reader(&self) -> Option<&str> {
        if self.who.may(Act::Read, "") { None } else { Some(&self.who.name) }
    }
}

/// SHA-256 in hexadecimal digits.
pub(crate) fn digest(pieces: &[&[u8]]) -> String {
    let mut digest = Sha256::new();
    for piece in pieces {
        digest.update((piece.len() as u64).to_le_bytes());
        digest.update(piece);
    }
    hex(&digest.finalize())
}

/// Bytes in hexadecimal digits.
pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
