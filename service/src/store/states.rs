//! States of translations: who may use a text at the machine.
//!
//! A step is never changed. Of the translations of one program for one target, one is released at most; the one before it
//! is obsolete from then on.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::documents::now;
use super::hooks::events::released;
use super::programs::Said;
use super::session::{Row, Session, values};
use super::{Store, StoreError};
use crate::rights::Act;

/// A state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum State {
    /// Nobody has looked at it.
    #[default]
    Draft,
    /// Somebody looks at it.
    InReview,
    /// Somebody has looked at it, and it is good.
    Approved,
    /// It may be cut.
    Released,
    /// It may not be cut any more.
    Obsolete,
}

impl State {
    /// All states, with their names.
    pub(crate) const ALL: [(&str, State); 5] = [
        ("draft", State::Draft),
        ("in-review", State::InReview),
        ("approved", State::Approved),
        ("released", State::Released),
        ("obsolete", State::Obsolete),
    ];

    /// Its name.
    pub(crate) fn name(self) -> &'static str {
        State::ALL.iter().find(|(_, own)| *own == self).map_or("", |(name, _)| name)
    }

    pub(super) fn named(name: &str) -> Option<State> {
        State::ALL.iter().find(|(own, _)| *own == name).map(|(_, state)| *state)
    }

    /// States that may follow.
    pub(crate) const fn next(self) -> &'static [State] {
        match self {
            State::Draft => &[State::InReview, State::Obsolete],
            State::InReview => &[State::Approved, State::Draft, State::Obsolete],
            State::Approved => &[State::Released, State::Draft, State::Obsolete],
            State::Released => &[State::Obsolete],
            State::Obsolete => &[State::Draft],
        }
    }

    /// The act of putting a translation into it.
    const fn act(self) -> Act {
        match self {
            State::InReview => Act::Change,
            State::Approved | State::Draft => Act::Review,
            State::Released | State::Obsolete => Act::Release,
        }
    }
}

/// A step from a state to another one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Step {
    /// Counted from 1.
    pub(crate) number: i64,
    /// The state that it led to.
    pub(crate) state: State,
    /// Who, and why.
    pub(crate) said: Said,
    /// When, seconds since 1970 (UTC).
    pub(crate) made: i64,
}

impl Store {
    /// Puts a translation into another state, if it holds then: nobody else changes anything meanwhile. A release makes the
    /// one before it obsolete.
    pub(crate) fn step(
        &self,
        id: &str,
        to: State,
        said: &Said,
        holds: impl FnOnce() -> bool,
    ) -> Result<(), StoreError> {
        self.database.write(|store| {
            let mut row =
                store.row("SELECT state, program, target FROM translation WHERE id = $1", values![id])?;
            let (state, program, target) = (row.text(0)?, row.text(1)?, row.text(2)?);
            self.may_with(store, &program, to.act())?;
            let may = State::named(&state).is_some_and(|state| state.next().contains(&to));
            if !may || !holds() {
                return Err(StoreError::Changed);
            }
            let mut before = Vec::new();
            if to == State::Released {
                before = store.read(
                    "SELECT id FROM translation WHERE program = $1 AND target = $2 AND state = 'released'",
                    values![program, target],
                    |mut row| row.text(0),
                )?;
                for before in &before {
                    let why = Said { message: format!("{id} is released"), ..said.clone() };
                    self.enter(store, before, State::Obsolete, &why)?;
                }
            }
            self.enter(store, id, to, said)?;
            match to {
                State::Released => released(store, id, [&said.author, &said.message], &before),
                _ => Ok(()),
            }
        })
    }

    /// The user may put a translation into a state.
    pub(crate) fn allows_step(&self, of: &str, to: State) -> Result<(), StoreError> {
        self.database.read(|from| {
            let mut row = from.row("SELECT program FROM translation WHERE id = $1", values![of])?;
            self.may_with(from, &row.text(0)?, to.act())
        })
    }

    fn enter(&self, to: &dyn Session, id: &str, state: State, said: &Said) -> Result<(), StoreError> {
        add(to, id, state, said)?;
        self.note(to, "translation.state", id, state.name())
    }

    /// The steps of a translation, in order.
    pub(crate) fn steps(&self, id: &str) -> Result<Vec<Step>, StoreError> {
        self.database.read(|from| {
            let mut of = from.row("SELECT program FROM translation WHERE id = $1", values![id])?;
            self.may_with(from, &of.text(0)?, Act::Read)?;
            let step = |mut row: Row| {
                let state = row.text(1)?;
                let unknown = || StoreError::Database(format!("no state is called {state:?}"));
                Ok(Step {
                    number: row.int(0)?,
                    state: State::named(&state).ok_or_else(unknown)?,
                    said: Said { author: row.text(2)?, message: row.text(3)? },
                    made: row.int(4)?,
                })
            };
            from.read(
                "SELECT number, state, author, message, made FROM state WHERE translation = $1 ORDER BY number",
                values![id],
                step,
            )
        })
    }
}

fn add(to: &dyn Session, id: &str, state: State, said: &Said) -> Result<(), StoreError> {
    to.change("UPDATE translation SET state = $2 WHERE id = $1", values![id, state.name()])?;
    let mut last =
        to.row("SELECT coalesce(max(number), 0) FROM state WHERE translation = $1", values![id])?;
    to.change(
        "INSERT INTO state (translation, number, state, author, message, made) VALUES ($1, $2, $3, $4, $5, $6)",
        values![id, last.int(0)? + 1, state.name(), &said.author, &said.message, now()],
    )?;
    Ok(())
}
