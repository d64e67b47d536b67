//! Programs put into a database from outside of a server, which may run meanwhile.
//!
//! A program is found again by its folder and name: the same text is no new revision, another one is. Not here: which files
//! are taken, and their dialects (the command line).

use std::fmt;
use std::io::{self, Read, Seek, SeekFrom};
use std::sync::Arc;

use ncc_dialects::Dialect;
use sha2::{Digest, Sha256};

use crate::Limits;
use crate::api::{fits, new_id};
use crate::http::Problem;
use crate::rights::Who;
use crate::shop::named;
use crate::store::{Condition, Details, Place, Receiving, Revision, Said, Sort, Store, StoreError, hex};

/// Bytes of a text that are read at once.
const READ: usize = 1 << 16;

/// Result of an imported program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Imported {
    /// It was not there.
    New,
    /// It has another text: a revision was added.
    Changed,
    /// It is there with the same text.
    Same,
}

/// Reason why a program was not put in.
#[derive(Debug)]
pub enum NotImported {
    /// Its place, dialect or machine is none; or it is too large. In words.
    Refused(String),
    /// It cannot be read.
    File(io::Error),
    /// The database; its reason. Nothing more can be put in.
    Database(String),
}

impl fmt::Display for NotImported {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotImported::Refused(words) | NotImported::Database(words) => out.write_str(words),
            NotImported::File(error) => error.fmt(out),
        }
    }
}

impl std::error::Error for NotImported {}

impl From<StoreError> for NotImported {
    fn from(error: StoreError) -> NotImported {
        NotImported::Database(error.to_string())
    }
}

/// The place and the statements of a program that is put in.
#[derive(Clone, Copy, Debug)]
pub struct Entry<'e> {
    /// Its folder in the database: `shafts/left`; empty is the top.
    pub folder: &'e str,
    /// Its name.
    pub name: &'e str,
    /// Its dialect; empty where it is to be recognised.
    pub dialect: &'e str,
    /// Its machine; empty where it has none.
    pub machine: &'e str,
}

/// A database that programs are put into.
pub struct Import {
    store: Store,
    said: Said,
    /// Bytes of a program at most.
    largest: u64,
}

impl Import {
    /// Opens a database. Changes are `author`'s.
    ///
    /// # Errors
    /// It cannot be used; its reason.
    pub fn open(place: &Place, author: &str) -> Result<Import, String> {
        let store = Store::open(place).map_err(|error| error.to_string())?;
        let store = store.of(Arc::new(Who::command(author)));
        let said = Said { author: author.to_owned(), message: "imported".to_owned() };
        Ok(Import { store, said, largest: Limits::default().largest })
    }

    /// Whether a machine comes with ncc or is in the database.
    ///
    /// # Errors
    /// The database; its reason.
    pub fn has_machine(&self, name: &str) -> Result<bool, String> {
        if ncc_machines::find(name).is_some() {
            return Ok(true);
        }
        match self.store.shop_text(Sort::Machine, name) {
            Ok(_) => Ok(true),
            Err(StoreError::Absent) => Ok(false),
            Err(error) => Err(error.to_string()),
        }
    }

    /// The dialect of a name, one of ncc's or of the database.
    ///
    /// # Errors
    /// There is none, or the database; in words, with what to do.
    pub fn dialect(&self, name: &str) -> Result<Option<&'static Dialect>, (String, String)> {
        let told = |problem: Problem| {
            (problem.detail().to_owned(), problem.first_help().unwrap_or_default().to_owned())
        };
        named(&self.store, name).map_err(told)
    }

    /// Puts a program in. Dialect and machine are those of a new one; another one keeps its own.
    ///
    /// # Errors
    /// It is refused, or cannot be read or stored.
    pub fn put(&self, entry: &Entry, text: &mut (impl Read + Seek)) -> Result<Imported, NotImported> {
        let details = Details {
            folder: entry.folder.to_owned(),
            name: entry.name.to_owned(),
            dialect: entry.dialect.to_owned(),
            machine: entry.machine.to_owned(),
            tags: Vec::new(),
        };
        let refused = |problem: Problem| NotImported::Refused(problem.detail().to_owned());
        fits(&details).map_err(refused)?;
        named(&self.store, entry.dialect).map_err(refused)?;
        if let Some(there) = self.store.program_at(entry.folder, entry.name)? {
            return self.change(&there, text);
        }
        let id = new_id().map_err(refused)?;
        let received = self.receive(text)?;
        let aside = received.aside();
        match self.store.create_program(&id, &details, received, &self.said, None) {
            Ok(_) => Ok(Imported::New),
            // Somebody else has made it since.
            Err(StoreError::Exists) => {
                self.store.forget(aside)?;
                let there = self.store.program_at(entry.folder, entry.name)?;
                self.change(&there.ok_or(StoreError::Changed)?, text)
            }
            Err(error) => self.not_kept(aside, error),
        }
    }

    fn change(&self, there: &Revision, text: &mut (impl Read + Seek)) -> Result<Imported, NotImported> {
        if self.digest(text)? == there.content.sha256 {
            return Ok(Imported::Same);
        }
        let received = self.receive(text)?;
        let aside = received.aside();
        match self.store.change_text(&there.program, received, &self.said, &Condition::Any) {
            Ok(now) if now.number == there.number => Ok(Imported::Same),
            Ok(_) => Ok(Imported::Changed),
            Err(error) => self.not_kept(aside, error),
        }
    }

    fn not_kept(&self, aside: Option<i64>, error: StoreError) -> Result<Imported, NotImported> {
        self.store.forget(aside)?;
        Err(error.into())
    }

    /// Reads a text from its beginning.
    fn each(
        &self,
        text: &mut (impl Read + Seek),
        mut take: impl FnMut(&[u8]) -> Result<(), NotImported>,
    ) -> Result<(), NotImported> {
        text.seek(SeekFrom::Start(0)).map_err(NotImported::File)?;
        let (mut piece, mut bytes) = (vec![0; READ], 0);
        loop {
            let count = match text.read(&mut piece) {
                Ok(0) => return Ok(()),
                Ok(count) => count,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                Err(error) => return Err(NotImported::File(error)),
            };
            bytes += count as u64;
            if bytes > self.largest {
                return Err(NotImported::Refused(format!("it has more than {} bytes", self.largest)));
            }
            take(&piece[..count])?;
        }
    }

    fn digest(&self, text: &mut (impl Read + Seek)) -> Result<String, NotImported> {
        let mut digest = Sha256::new();
        self.each(text, |piece| {
            digest.update(piece);
            Ok(())
        })?;
        Ok(hex(&digest.finalize()))
    }

    fn receive(&self, text: &mut (impl Read + Seek)) -> Result<Receiving, NotImported> {
        let mut received = Receiving::default();
        let read = self.each(text, |piece| match received.take(piece) {
            true => Ok(self.store.put_aside(&mut received)?),
            false => Ok(()),
        });
        if let Err(error) = read {
            self.store.forget(received.aside())?;
            return Err(error);
        }
        Ok(received)
    }
}
