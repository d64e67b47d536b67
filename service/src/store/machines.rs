//! Profiles of machines, by their names. Whoever may read anything may read them: programs are made for them.

use super::documents::{Condition, now};
use super::facts::machine_changed;
use super::session::{Row, values};
use super::{Store, StoreError, digest};
use crate::rights::Act;

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

fn machine(mut row: Row) -> Result<Machine, StoreError> {
    Ok(Machine { name: row.text(0)?, text: row.text(1)?, tag: row.text(2)? })
}

impl Store {
    /// The profile under a name.
    pub(crate) fn machine(&self, name: &str) -> Result<Machine, StoreError> {
        if !self.who.reads_anything() {
            return Err(StoreError::Absent);
        }
        self.database.read(|from| {
            machine(from.row("SELECT name, text, tag FROM machine WHERE name = $1", values![name])?)
        })
    }

    /// All profiles, in the order of their names.
    pub(crate) fn machines(&self) -> Result<Vec<Machine>, StoreError> {
        if !self.who.reads_anything() {
            return Ok(Vec::new());
        }
        self.database
            .read(|from| from.read("SELECT name, text, tag FROM machine ORDER BY name", values![], machine))
    }

    /// Keeps a profile; gives its tag, and whether there was none before.
    pub(crate) fn keep_machine(
        &self,
        name: &str,
        text: &str,
        over: &Condition,
    ) -> Result<(String, bool), StoreError> {
        self.may(Act::Administer, "")?;
        self.database.write(|to| {
            let there = to.maybe_row("SELECT tag FROM machine WHERE name = $1", values![name])?;
            let there = there.map(|mut row| row.text(0)).transpose()?;
            match (&there, over) {
                (None, Condition::OneOf(_)) => return Err(StoreError::Changed),
                (None, Condition::Any) => {}
                (Some(tag), over) => over.holds(tag)?,
            }
            let tag = digest(&[text.as_bytes()]);
            to.change(
                "INSERT INTO machine (name, text, tag, changed) VALUES ($1, $2, $3, $4)
                 ON CONFLICT (name) DO UPDATE SET text = excluded.text, tag = excluded.tag, changed = excluded.changed",
                values![name, text, &tag, now()],
            )?;
            machine_changed(to, name)?;
            self.note(to, "machine.put", name, &tag)?;
            Ok((tag, there.is_none()))
        })
    }

    /// Lets go of a profile.
    pub(crate) fn delete_machine(&self, name: &str, over: &Condition) -> Result<(), StoreError> {
        self.may(Act::Administer, "")?;
        self.database.write(|to| {
            over.holds(&to.row("SELECT tag FROM machine WHERE name = $1", values![name])?.text(0)?)?;
            to.change("DELETE FROM machine WHERE name = $1", values![name])?;
            machine_changed(to, name)?;
            self.note(to, "machine.delete", name, "")
        })
    }
}
