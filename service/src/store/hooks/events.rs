//! Events, written as deliveries in the transaction of the change that they tell of.
//!
//! ```text
//! { "type": "release", "timestamp": "2026-01-31T12:00:00Z", "data": { "translation": "…", "program": "…", … } }
//! ```
//!
//! An event that no hook wants is not written.

use serde_json::{Value, json};

use super::super::StoreError;
use super::super::documents::now;
use super::super::session::{Session, values};
use super::records::{EventKind, active};
use crate::moments::moment;
use crate::rights::is_in;

/// Signs of the name of an event: 100 bits. It has no `.`, which would be a part of the signed text.
const ID: usize = 20;

/// An event with its place.
struct Event {
    kind: EventKind,
    /// The name of the translation or the job.
    subject: String,
    /// The folders of the programs that it is about.
    folders: Vec<String>,
    /// The data of the message.
    data: Value,
}

impl Event {
    /// Writes a delivery for each of the hooks whose folder has all of its programs. An event without programs is about
    /// everything.
    fn write(&self, to: &dyn Session) -> Result<(), StoreError> {
        let hooks = active(to)?.into_iter().filter(|hook| {
            let is_there = !self.folders.is_empty() || hook.folder.is_empty();
            is_there
                && hook.events.contains(&self.kind)
                && self.folders.iter().all(|folder| is_in(folder, &hook.folder))
        });
        let hooks: Vec<String> = hooks.map(|hook| hook.id).collect();
        if hooks.is_empty() {
            return Ok(());
        }
        let time = now();
        let id = crate::chance::signs(ID).map_err(|error| StoreError::Database(error.to_string()))?;
        let body =
            json!({ "type": self.kind.name(), "timestamp": moment(time), "data": self.data }).to_string();
        for hook in hooks {
            to.change(
                "INSERT INTO delivery (id, hook, event, subject, body, moment, next) VALUES ($1, $2, $3, $4, $5, $6, $6)",
                values![&id, hook, self.kind.name(), &self.subject, &body, time],
            )?;
        }
        Ok(())
    }
}

/// Whether a hook wants events of a kind: most of the time there is none, and nothing else is read.
fn is_wanted(from: &dyn Session, kind: EventKind) -> Result<bool, StoreError> {
    Ok(active(from)?.iter().any(|hook| hook.events.contains(&kind)))
}

/// A translation was released, in place of others.
pub(in super::super) fn released(
    to: &dyn Session,
    id: &str,
    [author, message]: [&str; 2],
    replaced: &[String],
) -> Result<(), StoreError> {
    if !is_wanted(to, EventKind::Release)? {
        return Ok(());
    }
    let mut row = to.row(
        "SELECT t.program, p.folder, p.name, t.revision, t.target, c.sha256 FROM translation t
         JOIN program p ON p.id = t.program JOIN content c ON c.id = t.output WHERE t.id = $1",
        values![id],
    )?;
    let folder = row.text(1)?;
    let data = json!({
        "translation": id,
        "program": row.text(0)?,
        "folder": folder,
        "name": row.text(2)?,
        "revision": row.int(3)?,
        "target": row.text(4)?,
        "sha256": row.maybe_text(5)?,
        "author": author,
        "message": message,
        "replaces": replaced,
    });
    let event = Event { kind: EventKind::Release, subject: id.to_owned(), folders: vec![folder], data };
    event.write(to)
}

/// A translation that was not stale is stale now, because of some inputs. Of one that nobody uses nothing is told.
pub(in super::super) fn became_stale(
    to: &dyn Session,
    id: &str,
    changed: &[&'static str],
) -> Result<(), StoreError> {
    if !is_wanted(to, EventKind::Stale)? {
        return Ok(());
    }
    let used = to.maybe_row(
        "SELECT t.program, p.folder, p.name, t.revision, t.target, t.state FROM translation t
         JOIN program p ON p.id = t.program WHERE t.id = $1 AND t.state IN ('in-review', 'approved', 'released')",
        values![id],
    )?;
    let Some(mut row) = used else { return Ok(()) };
    let folder = row.text(1)?;
    let data = json!({
        "translation": id,
        "program": row.text(0)?,
        "folder": folder,
        "name": row.text(2)?,
        "revision": row.int(3)?,
        "target": row.text(4)?,
        "state": row.text(5)?,
        "changed": changed,
    });
    let event = Event { kind: EventKind::Stale, subject: id.to_owned(), folders: vec![folder], data };
    event.write(to)
}

/// A job has ended.
pub(in super::super) fn job_ended(to: &dyn Session, id: &str) -> Result<(), StoreError> {
    if !is_wanted(to, EventKind::Job)? {
        return Ok(());
    }
    let mut row = to.row("SELECT author, made, ended, is_cancelled FROM job WHERE id = $1", values![id])?;
    let counts =
        to.read("SELECT state, COUNT(*) FROM task WHERE job = $1 GROUP BY state", values![id], |mut row| {
            Ok((row.text(0)?, Value::from(row.int(1)?)))
        })?;
    let folders = to.read(
        "SELECT DISTINCT p.folder FROM task t JOIN program p ON p.id = t.program WHERE t.job = $1",
        values![id],
        |mut row| row.text(0),
    )?;
    let data = json!({
        "job": id,
        "author": row.text(0)?,
        "made": moment(row.int(1)?),
        "ended": row.maybe_int(2)?.map(moment),
        "cancelled": row.is(3)?,
        "tasks": counts.into_iter().collect::<serde_json::Map<_, _>>(),
    });
    Event { kind: EventKind::Job, subject: id.to_owned(), folders, data }.write(to)
}
