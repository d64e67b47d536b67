//! Hooks: who is told of what.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::super::documents::now;
use super::super::session::{Row, Session, values};
use super::super::{Store, StoreError};
use crate::rights::Act;

/// Hooks at most: each event is held against all of them.
const MOST: i64 = 100;

/// A kind of events.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum EventKind {
    /// A translation was released.
    Release,
    /// A translation in review, approved or released has become stale.
    Stale,
    /// A job has ended.
    Job,
}

impl EventKind {
    const ALL: [(&str, EventKind); 3] =
        [("release", EventKind::Release), ("stale", EventKind::Stale), ("job", EventKind::Job)];

    /// Its name.
    pub(crate) fn name(self) -> &'static str {
        EventKind::ALL.iter().find(|(_, own)| *own == self).map_or("", |(name, _)| name)
    }

    /// The kind of a name.
    fn named(name: &str) -> Option<EventKind> {
        EventKind::ALL.iter().find(|(own, _)| *own == name).map(|(_, kind)| *kind)
    }
}

/// The state of a hook.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum HookState {
    /// It is told of events.
    Active,
    /// Its receiver has answered 410: it is told of nothing more.
    Stopped,
}

impl HookState {
    /// Its name.
    pub(super) const fn name(self) -> &'static str {
        match self {
            HookState::Active => "active",
            HookState::Stopped => "stopped",
        }
    }
}

/// A hook. Its secret stays in the table, but for the one who signs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Hook {
    /// Its name.
    pub(crate) id: String,
    /// The address that is told.
    pub(crate) target: String,
    /// The kinds of events, each once, in order.
    pub(crate) events: Vec<EventKind>,
    /// The folder, with those below it; empty is everything.
    pub(crate) folder: String,
    /// Its state.
    pub(crate) state: HookState,
    /// Its maker.
    pub(crate) author: String,
    /// When it was made, seconds since 1970 (UTC).
    pub(crate) made: i64,
}

const HOOK: &str = "SELECT id, target, events, folder, state, author, made FROM hook";

fn read(mut row: Row) -> Result<Hook, StoreError> {
    Ok(Hook {
        id: row.text(0)?,
        target: row.text(1)?,
        events: row.text(2)?.split(' ').filter_map(EventKind::named).collect(),
        folder: row.text(3)?,
        state: if row.text(4)? == HookState::Active.name() { HookState::Active } else { HookState::Stopped },
        author: row.text(5)?,
        made: row.int(6)?,
    })
}

/// The hooks that are told of events.
pub(super) fn active(from: &dyn Session) -> Result<Vec<Hook>, StoreError> {
    from.read(&format!("{HOOK} WHERE state = $1 ORDER BY id"), values![HookState::Active.name()], read)
}

impl Store {
    /// Keeps a new hook with its secret; gives when it was made. `shown` is its target for the audit.
    ///
    /// # Errors
    /// [`StoreError::TooMany`] where there are as many as there may be.
    pub(crate) fn create_hook(&self, hook: &Hook, secret: &[u8], shown: &str) -> Result<i64, StoreError> {
        self.may(Act::Administer, "")?;
        self.database.write(|to| {
            if to.row("SELECT COUNT(*) FROM hook", values![])?.int(0)? >= MOST {
                return Err(StoreError::TooMany);
            }
            let made = now();
            let events = hook.events.iter().map(|kind| kind.name()).collect::<Vec<_>>().join(" ");
            to.change(
                "INSERT INTO hook (id, target, secret, events, folder, state, author, made)
                 VALUES ($1, $2, $3, $4, $5, $6, $7, $8)",
                values![
                    &hook.id,
                    &hook.target,
                    secret,
                    &events,
                    &hook.folder,
                    hook.state.name(),
                    &hook.author,
                    made
                ],
            )?;
            self.note(to, "hook.create", &hook.id, &format!("{events} to {shown}"))?;
            Ok(made)
        })
    }

    /// Hooks in the order of their names; those after one, so many at most.
    pub(crate) fn hooks(&self, after: &str, most: u32) -> Result<Vec<Hook>, StoreError> {
        self.may(Act::Administer, "")?;
        self.database.read(|from| {
            from.read(&format!("{HOOK} WHERE id > $1 ORDER BY id LIMIT $2"), values![after, most], read)
        })
    }

    /// A hook.
    pub(crate) fn hook(&self, id: &str) -> Result<Hook, StoreError> {
        self.may(Act::Administer, "")?;
        self.database.read(|from| read(from.row(&format!("{HOOK} WHERE id = $1"), values![id])?))
    }

    /// Lets go of a hook, and of its deliveries.
    pub(crate) fn delete_hook(&self, id: &str) -> Result<(), StoreError> {
        self.may(Act::Administer, "")?;
        self.database.write(|to| {
            if to.change("DELETE FROM hook WHERE id = $1", values![id])? == 0 {
                return Err(StoreError::Absent);
            }
            self.note(to, "hook.delete", id, "")
        })
    }

    /// The hooks that are told of events, for the service itself.
    pub(crate) fn active_hooks(&self) -> Result<Vec<Hook>, StoreError> {
        self.database.read(active)
    }
}
