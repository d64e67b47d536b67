//! The case study's documents, by the names of their programs.

use std::collections::BTreeMap;
use std::time::{SystemTime, UNIX_EPOCH};

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::session::{Row, Session, values};
use super::{Store, StoreError, digest};
use crate::rights::Act;

/// Bytes of a piece at most.
const PIECE: usize = 1 << 20;

/// The parts of a document by their names; what they are is said by `case_study::document`.
pub(crate) type Parts = BTreeMap<String, Vec<u8>>;

/// A document without its parts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Document {
    id: i64,
    /// The short name of its machine; empty where it has none.
    pub(crate) machine: String,
    /// The name of its dialect.
    pub(crate) dialect: String,
    /// Changes whenever one of its parts does.
    pub(crate) tag: String,
}

/// A document in a list.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[schema(as = DocumentEntry)]
pub(crate) struct Listed {
    /// The name of its program.
    #[serde(rename = "prog_name")]
    pub(crate) name: String,
    /// As of [`Document`].
    pub(crate) machine: String,
    /// As of [`Document`].
    pub(crate) dialect: String,
    /// As of [`Document`].
    pub(crate) tag: String,
    /// When it was changed last, seconds since 1970 (UTC).
    pub(crate) changed: i64,
}

/// The condition of a writer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Condition {
    /// No condition.
    Any,
    /// The stored tag is one of these.
    OneOf(Vec<String>),
}

impl Condition {
    pub(super) fn holds(&self, tag: &str) -> Result<(), StoreError> {
        match self {
            Condition::Any => Ok(()),
            Condition::OneOf(tags) if tags.iter().any(|own| own == tag) => Ok(()),
            Condition::OneOf(_) => Err(StoreError::Changed),
        }
    }
}

impl Store {
    /// Keeps a document under a name that is free; gives its tag.
    pub(crate) fn create(
        &self,
        name: &str,
        [machine, dialect]: [&str; 2],
        parts: &Parts,
    ) -> Result<String, StoreError> {
        self.may(Act::Change, "")?;
        let tag = tag_for([machine, dialect], parts);
        self.database.write(|to| match tag_of(to, name)? {
            Some(_) => Err(StoreError::Exists),
            None => {
                self.note(to, "document.create", name, "")?;
                insert(to, name, [machine, dialect], parts, &tag)
            }
        })?;
        Ok(tag)
    }

    /// Keeps a document in the place of the one under a name; gives its tag.
    pub(crate) fn replace(
        &self,
        name: &str,
        [machine, dialect]: [&str; 2],
        parts: &Parts,
        over: &Condition,
    ) -> Result<String, StoreError> {
        self.may(Act::Change, "")?;
        let tag = tag_for([machine, dialect], parts);
        self.database.write(|to| {
            over.holds(&tag_of(to, name)?.ok_or(StoreError::Absent)?)?;
            remove(to, name)?;
            self.note(to, "document.replace", name, "")?;
            insert(to, name, [machine, dialect], parts, &tag)
        })?;
        Ok(tag)
    }

    /// Lets go of a document.
    pub(crate) fn delete(&self, name: &str, over: &Condition) -> Result<(), StoreError> {
        self.may(Act::Change, "")?;
        self.database.write(|to| {
            over.holds(&tag_of(to, name)?.ok_or(StoreError::Absent)?)?;
            self.note(to, "document.delete", name, "")?;
            remove(to, name)
        })
    }

    /// A document and those of its parts that are wanted and there.
    pub(crate) fn parts(&self, name: &str, wanted: &[&str]) -> Result<(Document, Parts), StoreError> {
        self.may(Act::Read, "")?;
        self.database.read(|from| {
            let about = about(from, name)?;
            let mut parts = Parts::new();
            for part in wanted {
                let pieces = from.rows(
                    "SELECT bytes FROM document_piece WHERE document = $1 AND part = $2 ORDER BY number",
                    values![about.id, *part],
                )?;
                // An empty part has an empty piece.
                let mut whole = None;
                for mut piece in pieces {
                    whole.get_or_insert_with(Vec::new).extend_from_slice(&piece.bytes(0)?);
                }
                parts.extend(whole.map(|whole| ((*part).to_owned(), whole)));
            }
            Ok((about, parts))
        })
    }

    /// Documents in the order of their names, those after a name, so many at most.
    pub(crate) fn list(&self, after: &str, most: u32) -> Result<Vec<Listed>, StoreError> {
        if !self.who.may(Act::Read, "") {
            return Ok(Vec::new());
        }
        self.database.read(|from| {
            let listed = |mut row: Row| {
                Ok(Listed {
                    name: row.text(0)?,
                    machine: row.text(1)?,
                    dialect: row.text(2)?,
                    tag: row.text(3)?,
                    changed: row.int(4)?,
                })
            };
            from.read(
                "SELECT name, machine, dialect, tag, changed FROM document WHERE name > $1 ORDER BY name LIMIT $2",
                values![after, most],
                listed,
            )
        })
    }
}

/// Seconds since 1970 (UTC).
pub(super) fn now() -> i64 {
    SystemTime::now()
        .duration_since(UNIX_EPOCH)
        .map_or(0, |since| i64::try_from(since.as_secs()).unwrap_or(0))
}

fn tag_of(from: &dyn Session, name: &str) -> Result<Option<String>, StoreError> {
    let found = from.maybe_row("SELECT tag FROM document WHERE name = $1", values![name])?;
    found.map(|mut row| row.text(0)).transpose()
}

fn about(from: &dyn Session, name: &str) -> Result<Document, StoreError> {
    let mut row =
        from.row("SELECT id, machine, dialect, tag FROM document WHERE name = $1", values![name])?;
    Ok(Document { id: row.int(0)?, machine: row.text(1)?, dialect: row.text(2)?, tag: row.text(3)? })
}

/// The tag of a document. It is made before a change begins: others wait for its end.
fn tag_for(of: [&str; 2], parts: &Parts) -> String {
    let of = of.map(str::as_bytes);
    let named = parts.iter().flat_map(|(part, bytes)| [part.as_bytes(), bytes.as_slice()]);
    digest(&of.into_iter().chain(named).collect::<Vec<_>>())
}

fn insert(
    to: &dyn Session,
    name: &str,
    [machine, dialect]: [&str; 2],
    parts: &Parts,
    tag: &str,
) -> Result<(), StoreError> {
    let id = to
        .row(
            "INSERT INTO document (name, machine, dialect, tag, changed) VALUES ($1, $2, $3, $4, $5) RETURNING id",
            values![name, machine, dialect, tag, now()],
        )?
        .int(0)?;
    for (part, bytes) in parts {
        let empty: &[u8] = &[];
        let pieces = bytes.chunks(PIECE).chain(bytes.is_empty().then_some(empty));
        for (number, bytes) in pieces.enumerate() {
            to.change(
                "INSERT INTO document_piece (document, part, number, bytes) VALUES ($1, $2, $3, $4)",
                values![id, part, number as i64, bytes],
            )?;
        }
    }
    Ok(())
}

fn remove(from: &dyn Session, name: &str) -> Result<(), StoreError> {
    from.change("DELETE FROM document WHERE name = $1", values![name])?;
    Ok(())
}
