//! Programs and their revisions.
//!
//! Every change of a program is a revision: of its text, its name, its folder, its tags, and that it was deleted. A
//! revision is never changed.

use rusqlite::{Connection, OptionalExtension, Row, params};
use serde::Serialize;

use super::contents::{Content, Receiving, settle};
use super::documents::now;
use super::{Condition, Store, StoreError};

/// What a revision has changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Change {
    /// It is the first one.
    Created,
    /// The text.
    Text,
    /// Name, folder, tags, dialect or machine.
    Details,
    /// The program was deleted.
    Deleted,
    /// The program is again as it was in an earlier one.
    Restored,
}

impl Change {
    const ALL: [(Change, &str); 5] = [
        (Change::Created, "created"),
        (Change::Text, "text"),
        (Change::Details, "details"),
        (Change::Deleted, "deleted"),
        (Change::Restored, "restored"),
    ];

    fn name(self) -> &'static str {
        Change::ALL.iter().find(|(own, _)| *own == self).map_or("", |(_, name)| name)
    }

    fn named(name: &str) -> Option<Change> {
        Change::ALL.iter().find(|(_, own)| *own == name).map(|(change, _)| *change)
    }
}

/// What its owner says of a program.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Details {
    /// The folder, `shafts/left`; empty is the top.
    pub(crate) folder: String,
    /// The name of its file.
    pub(crate) name: String,
    /// The name of its dialect; empty where it is recognised.
    pub(crate) dialect: String,
    /// The name of its machine; empty where it has none.
    pub(crate) machine: String,
    /// Tags, each once, in order.
    pub(crate) tags: Vec<String>,
}

/// Who changed something, and why.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Said {
    /// Who.
    pub(crate) author: String,
    /// Why; may be empty.
    pub(crate) message: String,
}

/// A program as it was, or is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Revision {
    /// The program.
    pub(crate) program: String,
    /// Counted from 1.
    pub(crate) number: i64,
    /// What its owner says of it.
    pub(crate) details: Details,
    /// Its text.
    pub(crate) content: Content,
    /// What it has changed.
    pub(crate) change: Change,
    /// Who made it, and why.
    pub(crate) said: Said,
    /// When, seconds since 1970 (UTC).
    pub(crate) made: i64,
}

/// Which programs are wanted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Wanted {
    /// Those in this folder.
    pub(crate) folder: Option<String>,
    /// Those in this folder and below it.
    pub(crate) under: Option<String>,
    /// Those whose name has this text.
    pub(crate) name: Option<String>,
    /// Those with this tag.
    pub(crate) tag: Option<String>,
    /// Those of this dialect.
    pub(crate) dialect: Option<String>,
    /// Those of this machine.
    pub(crate) machine: Option<String>,
    /// Deleted ones, and no others.
    pub(crate) deleted: bool,
    /// Those after this one.
    pub(crate) after: Option<String>,
    /// So many at most.
    pub(crate) most: u32,
}

/// A request that may be sent again: its key, and a digest of what it asks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Once {
    /// The key.
    pub(crate) key: String,
    /// A digest of what is asked, but for the body.
    pub(crate) request: String,
}

impl Store {
    /// Keeps a new program; `id` is one that is free. The same request again gives the revision that it made.
    pub(crate) fn create_program(
        &self,
        id: &str,
        details: &Details,
        text: Receiving,
        said: &Said,
        once: Option<&Once>,
    ) -> Result<Revision, StoreError> {
        self.database.write(|to| {
            let content = settle(to, text)?;
            let request = once.map(|once| format!("{} {}", once.request, content.sha256));
            if let (Some(once), Some(request)) = (once, &request) {
                let done: Option<(String, String, i64)> = to
                    .query_row(
                        "SELECT request, program, number FROM idempotency WHERE key = ?1",
                        [&once.key],
                        |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?)),
                    )
                    .optional()?;
                if let Some((before, program, number)) = done {
                    return if before == *request { revision(to, &program, number) } else { Err(StoreError::Reused) };
                }
                to.execute(
                    "INSERT INTO idempotency (key, request, program, number, made) VALUES (?1, ?2, ?3, 1, ?4)",
                    params![once.key, request, id, now()],
                )?;
            }
            is_free(to, details, id)?;
            to.execute(
                "INSERT INTO program (id, folder, name, head, is_deleted) VALUES (?1, ?2, ?3, 0, FALSE)",
                params![id, details.folder, details.name],
            )?;
            add(to, id, 1, details, &content, Change::Created, said)
        })
    }

    /// Keeps another text of a program. The same text as before is no change.
    pub(crate) fn change_text(
        &self,
        id: &str,
        text: Receiving,
        said: &Said,
        over: &Condition,
    ) -> Result<Revision, StoreError> {
        self.database.write(|to| {
            let head = head(to, id, over)?;
            if head.change == Change::Deleted {
                return Err(StoreError::Absent);
            }
            let content = settle(to, text)?;
            if content.sha256 == head.content.sha256 {
                return Ok(head);
            }
            add(to, id, head.number + 1, &head.details, &content, Change::Text, said)
        })
    }

    /// Changes what is said of a program. Nothing else than before is no change.
    pub(crate) fn change_details(
        &self,
        id: &str,
        change: impl FnOnce(&mut Details),
        said: &Said,
        over: &Condition,
    ) -> Result<Revision, StoreError> {
        self.database.write(|to| {
            let head = head(to, id, over)?;
            if head.change == Change::Deleted {
                return Err(StoreError::Absent);
            }
            let mut details = head.details.clone();
            change(&mut details);
            if details == head.details {
                return Ok(head);
            }
            is_free(to, &details, id)?;
            add(to, id, head.number + 1, &details, &head.content, Change::Details, said)
        })
    }

    /// Deletes a program; its revisions stay.
    pub(crate) fn delete_program(
        &self,
        id: &str,
        said: &Said,
        over: &Condition,
    ) -> Result<Revision, StoreError> {
        self.database.write(|to| {
            let head = head(to, id, over)?;
            if head.change == Change::Deleted {
                return Err(StoreError::Absent);
            }
            add(to, id, head.number + 1, &head.details, &head.content, Change::Deleted, said)
        })
    }

    /// Makes a program again what it was in a revision.
    pub(crate) fn restore(
        &self,
        id: &str,
        number: i64,
        said: &Said,
        over: &Condition,
    ) -> Result<Revision, StoreError> {
        self.database.write(|to| {
            let head = head(to, id, over)?;
            let as_it_was = revision(to, id, number)?;
            is_free(to, &as_it_was.details, id)?;
            let (details, content) = (&as_it_was.details, &as_it_was.content);
            add(to, id, head.number + 1, details, content, Change::Restored, said)
        })
    }

    /// A program as it is.
    pub(crate) fn program(&self, id: &str) -> Result<Revision, StoreError> {
        self.database.read(|from| head(from, id, &Condition::Any))
    }

    /// A program as it was.
    pub(crate) fn revision(&self, id: &str, number: i64) -> Result<Revision, StoreError> {
        self.database.read(|from| revision(from, id, number))
    }

    /// Revisions of a program, the newest first: those before a number, so many at most.
    pub(crate) fn revisions(&self, id: &str, before: i64, most: u32) -> Result<Vec<Revision>, StoreError> {
        self.database.read(|from| {
            head(from, id, &Condition::Any)?;
            let sql =
                format!("{REVISION} WHERE r.program = ?1 AND r.number < ?2 ORDER BY r.number DESC LIMIT ?3");
            let mut all = from.prepare_cached(&sql)?;
            let rows = all.query_map(params![id, before, most], read)?;
            Ok(rows.collect::<Result<_, _>>()?)
        })
    }

    /// Programs in the order of their folders and names.
    pub(crate) fn programs(&self, wanted: &Wanted) -> Result<Vec<Revision>, StoreError> {
        self.database.read(|from| {
            let sql = format!(
                "{REVISION} JOIN program p ON p.id = r.program AND p.head = r.number
                 WHERE p.is_deleted = ?1
                   AND (?2 IS NULL OR p.folder = ?2)
                   AND (?3 IS NULL OR p.folder = ?3 OR substr(p.folder, 1, length(?3) + 1) = ?3 || '/')
                   AND (?4 IS NULL OR instr(lower(p.name), lower(?4)) > 0)
                   AND (?5 IS NULL OR r.dialect = ?5)
                   AND (?6 IS NULL OR r.machine = ?6)
                   AND (?7 IS NULL OR EXISTS (SELECT 1 FROM program_tag t WHERE t.tag = ?7 AND t.program = p.id))
                   AND (?8 IS NULL OR (p.folder, p.name, p.id) >
                        (SELECT folder, name, id FROM program WHERE id = ?8))
                 ORDER BY p.folder, p.name, p.id LIMIT ?9"
            );
            let mut all = from.prepare_cached(&sql)?;
            let rows = all.query_map(
                params![
                    wanted.deleted,
                    wanted.folder,
                    wanted.under,
                    wanted.name,
                    wanted.dialect,
                    wanted.machine,
                    wanted.tag,
                    wanted.after,
                    wanted.most
                ],
                read,
            )?;
            Ok(rows.collect::<Result<_, _>>()?)
        })
    }
}

/// Reads revisions, with their contents.
const REVISION: &str = "SELECT r.program, r.number, r.folder, r.name, r.dialect, r.machine, r.tags, r.change, r.author, \
                        r.message, r.made, c.id, c.sha256, c.bytes FROM revision r JOIN content c ON c.id = r.content";

fn read(row: &Row) -> rusqlite::Result<Revision> {
    let (tags, change, bytes): (String, String, i64) = (row.get(6)?, row.get(7)?, row.get(13)?);
    Ok(Revision {
        program: row.get(0)?,
        number: row.get(1)?,
        details: Details {
            folder: row.get(2)?,
            name: row.get(3)?,
            dialect: row.get(4)?,
            machine: row.get(5)?,
            tags: tags.lines().map(str::to_owned).collect(),
        },
        change: Change::named(&change).ok_or(rusqlite::Error::InvalidQuery)?,
        said: Said { author: row.get(8)?, message: row.get(9)? },
        made: row.get(10)?,
        content: Content { id: row.get(11)?, sha256: row.get(12)?, bytes: bytes.unsigned_abs() },
    })
}

fn revision(from: &Connection, program: &str, number: i64) -> Result<Revision, StoreError> {
    let mut one = from.prepare_cached(&format!("{REVISION} WHERE r.program = ?1 AND r.number = ?2"))?;
    Ok(one.query_row(params![program, number], read)?)
}

/// The program as it is, if a writer's condition holds.
fn head(from: &Connection, program: &str, over: &Condition) -> Result<Revision, StoreError> {
    let mut number = from.prepare_cached("SELECT head FROM program WHERE id = ?1")?;
    let number: i64 = number.query_row([program], |row| row.get(0))?;
    over.holds(&number.to_string())?;
    revision(from, program, number)
}

/// No other program is there under this name.
fn is_free(from: &Connection, details: &Details, program: &str) -> Result<(), StoreError> {
    let mut other = from.prepare_cached(
        "SELECT 1 FROM program WHERE folder = ?1 AND name = ?2 AND id <> ?3 AND NOT is_deleted",
    )?;
    match other.exists(params![details.folder, details.name, program])? {
        true => Err(StoreError::Exists),
        false => Ok(()),
    }
}

/// Adds a revision, which the program is then.
fn add(
    to: &Connection,
    program: &str,
    number: i64,
    details: &Details,
    content: &Content,
    change: Change,
    said: &Said,
) -> Result<Revision, StoreError> {
    let made = now();
    to.prepare_cached(
        "INSERT INTO revision (program, number, content, folder, name, dialect, machine, tags, change, author, message, made)
         VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12)",
    )?
    .execute(params![
        program,
        number,
        content.id,
        details.folder,
        details.name,
        details.dialect,
        details.machine,
        details.tags.join("\n"),
        change.name(),
        said.author,
        said.message,
        made
    ])?;
    to.prepare_cached("UPDATE program SET folder = ?2, name = ?3, head = ?4, is_deleted = ?5 WHERE id = ?1")?
        .execute(params![program, details.folder, details.name, number, change == Change::Deleted])?;
    to.prepare_cached("DELETE FROM program_tag WHERE program = ?1")?.execute([program])?;
    let mut tag = to.prepare_cached("INSERT INTO program_tag (program, tag) VALUES (?1, ?2)")?;
    for own in &details.tags {
        tag.execute(params![program, own])?;
    }
    Ok(Revision {
        program: program.to_owned(),
        number,
        details: details.clone(),
        content: content.clone(),
        change,
        said: said.clone(),
        made,
    })
}
