//! Profiles of machines, by their names.

use rusqlite::{OptionalExtension, Row, params};

use super::documents::{Condition, now};
use super::{Store, StoreError, digest};

/// A profile.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Machine {
    /// Its name.
    pub(crate) name: String,
    /// Its text, as its owner wrote it.
    pub(crate) text: String,
    /// Changes whenever its text does.
    pub(crate) tag: String,
}

fn machine(row: &Row) -> rusqlite::Result<Machine> {
    Ok(Machine { name: row.get(0)?, text: row.get(1)?, tag: row.get(2)? })
}

impl Store {
    /// The profile under a name.
    pub(crate) fn machine(&self, name: &str) -> Result<Machine, StoreError> {
        self.database.read(|from| {
            let mut row = from.prepare_cached("SELECT name, text, tag FROM machine WHERE name = ?1")?;
            Ok(row.query_row([name], machine)?)
        })
    }

    /// All profiles, in the order of their names.
    pub(crate) fn machines(&self) -> Result<Vec<Machine>, StoreError> {
        self.database.read(|from| {
            let mut all = from.prepare_cached("SELECT name, text, tag FROM machine ORDER BY name")?;
            let rows = all.query_map([], machine)?;
            Ok(rows.collect::<Result<_, _>>()?)
        })
    }

    /// Keeps a profile; gives its tag, and whether there was none before.
    pub(crate) fn keep_machine(
        &self,
        name: &str,
        text: &str,
        over: &Condition,
    ) -> Result<(String, bool), StoreError> {
        self.database.write(|to| {
            let there: Option<String> = to
                .prepare_cached("SELECT tag FROM machine WHERE name = ?1")?
                .query_row([name], |row| row.get(0))
                .optional()?;
            match (&there, over) {
                (None, Condition::OneOf(_)) => return Err(StoreError::Changed),
                (None, Condition::Any) => {}
                (Some(tag), over) => over.holds(tag)?,
            }
            let tag = digest(&[text.as_bytes()]);
            to.prepare_cached(
                "INSERT INTO machine (name, text, tag, changed) VALUES (?1, ?2, ?3, ?4)
                 ON CONFLICT (name) DO UPDATE SET text = excluded.text, tag = excluded.tag, changed = excluded.changed",
            )?
            .execute(params![name, text, tag, now()])?;
            Ok((tag, there.is_none()))
        })
    }

    /// Lets go of a profile.
    pub(crate) fn delete_machine(&self, name: &str, over: &Condition) -> Result<(), StoreError> {
        self.database.write(|to| {
            let tag: String = to
                .prepare_cached("SELECT tag FROM machine WHERE name = ?1")?
                .query_row([name], |row| row.get(0))?;
            over.holds(&tag)?;
            to.prepare_cached("DELETE FROM machine WHERE name = ?1")?.execute([name])?;
            Ok(())
        })
    }
}
