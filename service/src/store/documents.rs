//! The case study's documents, by the names of their programs.

use std::collections::BTreeMap;
use std::time::{SystemTime, UNIX_EPOCH};

use rusqlite::{Connection, OptionalExtension, Row, params};
use serde::{Deserialize, Serialize};

use super::{Store, StoreError, digest};

/// Bytes of a piece at most.
const PIECE: usize = 1 << 20;

/// The parts of a document by their names; what they are is said by `case_study::document`.
pub(crate) type Parts = BTreeMap<String, Vec<u8>>;

/// What is known of a document.
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
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
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

/// What a writer expects to be there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Condition {
    /// Whatever is there.
    Any,
    /// Something with one of these tags.
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
        self.database.write(|to| match tag_of(to, name)? {
            Some(_) => Err(StoreError::Exists),
            None => insert(to, name, [machine, dialect], parts),
        })
    }

    /// Keeps a document in the place of the one under a name; gives its tag.
    pub(crate) fn replace(
        &self,
        name: &str,
        [machine, dialect]: [&str; 2],
        parts: &Parts,
        over: &Condition,
    ) -> Result<String, StoreError> {
        self.database.write(|to| {
            over.holds(&tag_of(to, name)?.ok_or(StoreError::Absent)?)?;
            remove(to, name)?;
            insert(to, name, [machine, dialect], parts)
        })
    }

    /// Lets go of a document.
    pub(crate) fn delete(&self, name: &str, over: &Condition) -> Result<(), StoreError> {
        self.database.write(|to| {
            over.holds(&tag_of(to, name)?.ok_or(StoreError::Absent)?)?;
            remove(to, name)
        })
    }

    /// A document and those of its parts that are wanted and there.
    pub(crate) fn parts(&self, name: &str, wanted: &[&str]) -> Result<(Document, Parts), StoreError> {
        self.database.read(|from| {
            let about = about(from, name)?;
            let mut parts = Parts::new();
            let mut pieces = from.prepare_cached(
                "SELECT bytes FROM document_piece WHERE document = ?1 AND part = ?2 ORDER BY number",
            )?;
            for part in wanted {
                let mut whole = None;
                let mut rows = pieces.query(params![about.id, part])?;
                while let Some(row) = rows.next()? {
                    let piece = row.get_ref(0)?.as_blob().map_err(rusqlite::Error::from)?;
                    whole.get_or_insert_with(Vec::new).extend_from_slice(piece);
                }
                parts.extend(whole.map(|whole| ((*part).to_owned(), whole)));
            }
            Ok((about, parts))
        })
    }

    /// Documents in the order of their names, those after a name, so many at most.
    pub(crate) fn list(&self, after: &str, most: u32) -> Result<Vec<Listed>, StoreError> {
        self.database.read(|from| {
            let mut all = from.prepare_cached(
                "SELECT name, machine, dialect, tag, changed FROM document WHERE name > ?1 ORDER BY name LIMIT ?2",
            )?;
            let listed = |row: &Row| {
                Ok(Listed {
                    name: row.get(0)?,
                    machine: row.get(1)?,
                    dialect: row.get(2)?,
                    tag: row.get(3)?,
                    changed: row.get(4)?,
                })
            };
            let rows = all.query_map(params![after, most], listed)?;
            Ok(rows.collect::<Result<_, _>>()?)
        })
    }
}

/// Seconds since 1970 (UTC).
pub(super) fn now() -> i64 {
    SystemTime::now()
        .duration_since(UNIX_EPOCH)
        .map_or(0, |since| i64::try_from(since.as_secs()).unwrap_or(0))
}

fn tag_of(from: &Connection, name: &str) -> Result<Option<String>, StoreError> {
    let mut tag = from.prepare_cached("SELECT tag FROM document WHERE name = ?1")?;
    Ok(tag.query_row([name], |row| row.get(0)).optional()?)
}

fn about(from: &Connection, name: &str) -> Result<Document, StoreError> {
    let mut document =
        from.prepare_cached("SELECT id, machine, dialect, tag FROM document WHERE name = ?1")?;
    Ok(document.query_row([name], |row| {
        Ok(Document { id: row.get(0)?, machine: row.get(1)?, dialect: row.get(2)?, tag: row.get(3)? })
    })?)
}

fn insert(
    to: &Connection,
    name: &str,
    [machine, dialect]: [&str; 2],
    parts: &Parts,
) -> Result<String, StoreError> {
    let said = [machine, dialect].map(str::as_bytes);
    let named = parts.iter().flat_map(|(part, bytes)| [part.as_bytes(), bytes.as_slice()]);
    let tag = digest(&said.into_iter().chain(named).collect::<Vec<_>>());
    let mut document = to.prepare_cached(
        "INSERT INTO document (name, machine, dialect, tag, changed) VALUES (?1, ?2, ?3, ?4, ?5) RETURNING id",
    )?;
    let id: i64 = document.query_row(params![name, machine, dialect, tag, now()], |row| row.get(0))?;
    let mut piece = to.prepare_cached(
        "INSERT INTO document_piece (document, part, number, bytes) VALUES (?1, ?2, ?3, ?4)",
    )?;
    for (part, bytes) in parts {
        let empty: &[u8] = &[];
        let pieces = bytes.chunks(PIECE).chain(bytes.is_empty().then_some(empty));
        for (number, bytes) in pieces.enumerate() {
            piece.execute(params![id, part, number as i64, bytes])?;
        }
    }
    Ok(tag)
}

fn remove(from: &Connection, name: &str) -> Result<(), StoreError> {
    from.prepare_cached("DELETE FROM document WHERE name = ?1")?.execute([name])?;
    Ok(())
}
