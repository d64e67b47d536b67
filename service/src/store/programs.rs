//! Programs and their revisions.
//!
//! Every change of a program is a revision: of its text, its name, its folder, its tags, and that it was deleted. A
//! revision is never changed.

use serde::Serialize;
use utoipa::ToSchema;

use super::comparisons::wait;
use super::contents::{Content, Receiving, settle};
use super::documents::now;
use super::facts::changed;
use super::session::{Row, Session, values};
use super::{Condition, Store, StoreError};
use crate::rights::{Act, Role};

/// The kind of change of a revision.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ToSchema)]
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

/// Details of a program, stated by its owner.
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

/// Author and message of a change.
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
    /// The details.
    pub(crate) details: Details,
    /// Its text.
    pub(crate) content: Content,
    /// The kind of change.
    pub(crate) change: Change,
    /// Author and message.
    pub(crate) said: Said,
    /// When, seconds since 1970 (UTC).
    pub(crate) made: i64,
}

/// A filter of programs.
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
    /// Those with which the user may do this.
    pub(crate) act: Act,
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
            self.may_put_into(&details.folder)?;
            let content = settle(to, text)?;
            let request = once.map(|once| format!("{} {}", once.request, content.sha256));
            if let (Some(once), Some(request)) = (once, &request) {
                let done = to.maybe_row(
                    "SELECT request, program, number FROM idempotency WHERE key = $1",
                    values![&once.key],
                )?;
                if let Some(mut done) = done {
                    let (is_same, program) = (done.text(0)? == *request, done.text(1)?);
                    // Another user may have the same key, and the program may have been put elsewhere.
                    return match is_same && self.may_with(to, &program, Act::Read).is_ok() {
                        true => revision(to, &program, done.int(2)?),
                        false => Err(StoreError::Reused),
                    };
                }
                to.change(
                    "INSERT INTO idempotency (key, request, program, number, made) VALUES ($1, $2, $3, 1, $4)",
                    values![&once.key, request, id, now()],
                )?;
            }
            is_free(to, details, id)?;
            to.change(
                "INSERT INTO program (id, folder, name, head, is_deleted) VALUES ($1, $2, $3, 0, FALSE)",
                values![id, &details.folder, &details.name],
            )?;
            self.add(to, id, 1, details, &content, Change::Created, said)
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
            let head = self.head(to, id, Act::Change, over)?;
            if head.change == Change::Deleted {
                return Err(StoreError::Absent);
            }
            let content = settle(to, text)?;
            if content.sha256 == head.content.sha256 {
                return Ok(head);
            }
            self.add(to, id, head.number + 1, &head.details, &content, Change::Text, said)
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
            let head = self.head(to, id, Act::Change, over)?;
            if head.change == Change::Deleted {
                return Err(StoreError::Absent);
            }
            let mut details = head.details.clone();
            change(&mut details);
            if details == head.details {
                return Ok(head);
            }
            if details.folder != head.details.folder {
                self.may_put_into(&details.folder)?;
            }
            is_free(to, &details, id)?;
            self.add(to, id, head.number + 1, &details, &head.content, Change::Details, said)
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
            let head = self.head(to, id, Act::Change, over)?;
            if head.change == Change::Deleted {
                return Err(StoreError::Absent);
            }
            self.add(to, id, head.number + 1, &head.details, &head.content, Change::Deleted, said)
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
            let head = self.head(to, id, Act::Change, over)?;
            let as_it_was = revision(to, id, number)?;
            self.may_put_into(&as_it_was.details.folder)?;
            is_free(to, &as_it_was.details, id)?;
            let (details, content) = (&as_it_was.details, &as_it_was.content);
            self.add(to, id, head.number + 1, details, content, Change::Restored, said)
        })
    }

    /// A program as it is.
    pub(crate) fn program(&self, id: &str) -> Result<Revision, StoreError> {
        self.database.read(|from| self.head(from, id, Act::Read, &Condition::Any))
    }

    /// The program in a folder under a name, if there is one.
    pub(crate) fn program_at(&self, folder: &str, name: &str) -> Result<Option<Revision>, StoreError> {
        self.database.read(|from| {
            let sql = "SELECT id FROM program WHERE folder = $1 AND name = $2 AND NOT is_deleted";
            let Some(mut found) = from.maybe_row(sql, values![folder, name])? else { return Ok(None) };
            self.head(from, &found.text(0)?, Act::Read, &Condition::Any).map(Some)
        })
    }

    /// A program as it was.
    pub(crate) fn revision(&self, id: &str, number: i64) -> Result<Revision, StoreError> {
        self.database.read(|from| {
            self.may_with(from, id, Act::Read)?;
            revision(from, id, number)
        })
    }

    /// Revisions of a program, the newest first: those before a number, so many at most.
    pub(crate) fn revisions(&self, id: &str, before: i64, most: u32) -> Result<Vec<Revision>, StoreError> {
        self.database.read(|from| {
            self.may_with(from, id, Act::Read)?;
            let sql =
                format!("{REVISION} WHERE r.program = $1 AND r.number < $2 ORDER BY r.number DESC LIMIT $3");
            from.read(&sql, values![id, before, most], read)
        })
    }

    /// Folders with programs, each with their number.
    pub(crate) fn folders(&self) -> Result<Vec<(String, i64)>, StoreError> {
        self.database.read(|from| {
            let sql =
                "SELECT folder, COUNT(*) FROM program WHERE NOT is_deleted GROUP BY folder ORDER BY folder";
            from.read(sql, values![], |mut row| Ok((row.text(0)?, row.int(1)?)))
        })
    }

    /// Programs in the order of their folders and names.
    pub(crate) fn programs(&self, wanted: &Wanted) -> Result<Vec<Revision>, StoreError> {
        // A pattern of LIKE has signs of its own.
        let signs = |text: &str| text.replace('!', "!!").replace('%', "!%").replace('_', "!_");
        let below = wanted.under.as_ref().map(|folder| format!("{}/%", signs(folder)));
        let part = wanted.name.as_ref().map(|name| format!("%{}%", signs(&name.to_ascii_lowercase())));
        self.database.read(|from| {
            let sql = format!(
                "{REVISION} JOIN program p ON p.id = r.program AND p.head = r.number
                 WHERE p.is_deleted = $1
                   AND (CAST($2 AS TEXT) IS NULL OR p.folder = $2)
                   AND (CAST($3 AS TEXT) IS NULL OR p.folder = $3 OR p.folder LIKE CAST($4 AS TEXT) ESCAPE '!')
                   AND (CAST($5 AS TEXT) IS NULL OR lower(p.name) LIKE $5 ESCAPE '!')
                   AND (CAST($6 AS TEXT) IS NULL OR r.dialect = $6)
                   AND (CAST($7 AS TEXT) IS NULL OR r.machine = $7)
                   AND (CAST($8 AS TEXT) IS NULL
                        OR EXISTS (SELECT 1 FROM program_tag t WHERE t.tag = $8 AND t.program = p.id))
                   AND (CAST($9 AS TEXT) IS NULL
                        OR (p.folder, p.name, p.id) > (SELECT folder, name, id FROM program WHERE id = $9))
                   AND (CAST($11 AS TEXT) IS NULL OR {})
                 ORDER BY p.folder, p.name, p.id LIMIT $10",
                holds_in("p.folder", "$11", "$12")
            );
            let values = values![
                wanted.deleted,
                &wanted.folder,
                &wanted.under,
                below,
                part,
                &wanted.dialect,
                &wanted.machine,
                &wanted.tag,
                &wanted.after,
                wanted.most,
                self.reader(),
                Role::of(wanted.act).rank()
            ];
            from.read(&sql, values, read)
        })
    }
}

impl Store {
    /// The user may do something with a program.
    pub(super) fn may_with(&self, from: &dyn Session, program: &str, act: Act) -> Result<(), StoreError> {
        let mut row = from.row("SELECT folder FROM program WHERE id = $1", values![program])?;
        self.may(act, &row.text(0)?)
    }

    /// The user may do something with a program.
    pub(crate) fn allows(&self, act: Act, program: &str) -> Result<(), StoreError> {
        self.database.read(|from| self.may_with(from, program, act))
    }

    /// The program as it is, if the user may do this with it, and a writer's condition holds. Rights come first: the
    /// condition would say that the program is there.
    fn head(
        &self,
        from: &dyn Session,
        program: &str,
        act: Act,
        over: &Condition,
    ) -> Result<Revision, StoreError> {
        let mut row = from.row("SELECT head, folder FROM program WHERE id = $1", values![program])?;
        let number = row.int(0)?;
        self.may(act, &row.text(1)?)?;
        over.holds(&number.to_string())?;
        revision(from, program, number)
    }

    /// Adds a revision, which the program is then.
    #[expect(clippy::too_many_arguments, reason = "a revision has as many parts")]
    fn add(
        &self,
        to: &dyn Session,
        program: &str,
        number: i64,
        details: &Details,
        content: &Content,
        change: Change,
        said: &Said,
    ) -> Result<Revision, StoreError> {
        let added = insert(to, program, number, details, content, change, said)?;
        let place = [&*details.folder, &*details.name].into_iter().filter(|part| !part.is_empty());
        let detail = format!("{} revision {number}", place.collect::<Vec<_>>().join("/"));
        self.note(to, &format!("program.{}", change.name()), program, &detail)?;
        Ok(added)
    }
}

/// The condition that an account has a right in the folder of a column, with a rank at least. Folders are compared by
/// their bytes; LIKE does not tell capital letters from small ones.
pub(super) fn holds_in(folder: &str, account: &str, rank: &str) -> String {
    format!(
        "EXISTS (SELECT 1 FROM holding h WHERE h.account = {account} AND h.rank >= {rank}
                 AND (h.folder = '' OR {folder} = h.folder
                      OR substr({folder}, 1, length(h.folder) + 1) = h.folder || '/'))"
    )
}

/// Columns of a revision `r` with its content `c`.
macro_rules! columns {
    () => {
        "r.program, r.number, r.folder, r.name, r.dialect, r.machine, r.tags, r.change, r.author, r.message, r.made, c.id, \
         c.sha256, c.bytes"
    };
}

/// Columns of a revision `r` with its content `c`; [`read`] reads them.
pub(super) const COLUMNS: &str = columns!();

/// Reads revisions, with their contents.
const REVISION: &str = concat!("SELECT ", columns!(), " FROM revision r JOIN content c ON c.id = r.content");

/// A revision from a row that begins with [`COLUMNS`].
pub(super) fn read(row: Row) -> Result<Revision, StoreError> {
    read_from(&mut { row })
}

/// The same; what follows these columns stays in the row.
pub(super) fn read_from(row: &mut Row) -> Result<Revision, StoreError> {
    let change = row.text(7)?;
    let unknown = || StoreError::Database(format!("no change is called {change:?}"));
    Ok(Revision {
        program: row.text(0)?,
        number: row.int(1)?,
        details: Details {
            folder: row.text(2)?,
            name: row.text(3)?,
            dialect: row.text(4)?,
            machine: row.text(5)?,
            tags: row.text(6)?.lines().map(str::to_owned).collect(),
        },
        change: Change::named(&change).ok_or_else(unknown)?,
        said: Said { author: row.text(8)?, message: row.text(9)? },
        made: row.int(10)?,
        content: Content { id: row.int(11)?, sha256: row.text(12)?, bytes: row.int(13)?.unsigned_abs() },
    })
}

fn revision(from: &dyn Session, program: &str, number: i64) -> Result<Revision, StoreError> {
    read(from.row(&format!("{REVISION} WHERE r.program = $1 AND r.number = $2"), values![program, number])?)
}

/// No other program is there under this name.
fn is_free(from: &dyn Session, details: &Details, program: &str) -> Result<(), StoreError> {
    let other = from.maybe_row(
        "SELECT id FROM program WHERE folder = $1 AND name = $2 AND id <> $3 AND NOT is_deleted",
        values![&details.folder, &details.name, program],
    )?;
    if other.is_some() { Err(StoreError::Exists) } else { Ok(()) }
}

/// Adds a revision, which the program is then.
fn insert(
    to: &dyn Session,
    program: &str,
    number: i64,
    details: &Details,
    content: &Content,
    change: Change,
    said: &Said,
) -> Result<Revision, StoreError> {
    let made = now();
    to.change(
        "INSERT INTO revision (program, number, content, folder, name, dialect, machine, tags, change, author, message, made)
         VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11, $12)",
        values![
            program,
            number,
            content.id,
            &details.folder,
            &details.name,
            &details.dialect,
            &details.machine,
            details.tags.join("\n"),
            change.name(),
            &said.author,
            &said.message,
            made
        ],
    )?;
    wait(to, program, number, made)?;
    to.change(
        "UPDATE program SET folder = $2, name = $3, head = $4, is_deleted = $5 WHERE id = $1",
        values![program, &details.folder, &details.name, number, change == Change::Deleted],
    )?;
    to.change("DELETE FROM program_tag WHERE program = $1", values![program])?;
    for tag in &details.tags {
        to.change("INSERT INTO program_tag (program, tag) VALUES ($1, $2)", values![program, tag])?;
    }
    let place = [&details.folder, &details.name, &details.machine].map(String::as_str);
    changed(to, program, Some(place).filter(|_| change != Change::Deleted))?;
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
