//! Profiles of machines, by their names, and their revisions. Whoever may read anything may read them: programs are made for
//! them.

use super::documents::{Condition, now};
use super::facts::machine_changed;
use super::session::{Row, Session, values};
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

/// A revision of a profile.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct MachineRevision {
    /// Its number, from 1.
    pub(crate) number: i64,
    /// The text from then on; `None` where the machine was deleted.
    pub(crate) text: Option<String>,
    /// The tag of that text; empty without a text.
    pub(crate) tag: String,
    /// The account that made it; empty of profiles that were there before revisions were kept.
    pub(crate) author: String,
    /// Its time, seconds since 1970 (UTC).
    pub(crate) made: i64,
}

fn revision(mut row: Row) -> Result<MachineRevision, StoreError> {
    let text = Some(row.text(1)?).filter(|text| !text.is_empty());
    Ok(MachineRevision {
        number: row.int(0)?,
        text,
        tag: row.text(2)?,
        author: row.text(3)?,
        made: row.int(4)?,
    })
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
            if there.as_ref() != Some(&tag) {
                self.machine_revised(to, name, [text, &tag])?;
            }
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
            self.machine_revised(to, name, ["", ""])?;
            machine_changed(to, name)?;
            self.note(to, "machine.delete", name, "")
        })
    }

    /// Adds a revision with a text and its tag.
    fn machine_revised(
        &self,
        to: &dyn Session,
        name: &str,
        [text, tag]: [&str; 2],
    ) -> Result<(), StoreError> {
        let last = "SELECT COALESCE(MAX(number), 0) FROM machine_revision WHERE name = $1";
        let number = to.row(last, values![name])?.int(0)? + 1;
        to.change(
            "INSERT INTO machine_revision (name, number, text, tag, author, made) VALUES ($1, $2, $3, $4, $5, $6)",
            values![name, number, text, tag, &self.who.name, now()],
        )?;
        Ok(())
    }

    /// Revisions of a profile before a number, the newest first, so many at most. A deleted machine has them too.
    pub(crate) fn machine_revisions(
        &self,
        name: &str,
        before: i64,
        most: u32,
    ) -> Result<Vec<MachineRevision>, StoreError> {
        if !self.who.reads_anything() {
            return Err(StoreError::Absent);
        }
        self.database.read(|from| {
            from.row("SELECT 1 FROM machine_revision WHERE name = $1 LIMIT 1", values![name])?;
            from.read(
                "SELECT number, text, tag, author, made FROM machine_revision WHERE name = $1 AND number < $2
                 ORDER BY number DESC LIMIT $3",
                values![name, before, i64::from(most)],
                revision,
            )
        })
    }

    /// A revision of a profile.
    pub(crate) fn machine_revision(&self, name: &str, number: i64) -> Result<MachineRevision, StoreError> {
        if !self.who.reads_anything() {
            return Err(StoreError::Absent);
        }
        self.database.read(|from| {
            revision(from.row(
                "SELECT number, text, tag, author, made FROM machine_revision WHERE name = $1 AND number = $2",
                values![name, number],
            )?)
        })
    }
}
