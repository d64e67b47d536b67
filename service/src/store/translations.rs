//! Translations of programs. What went in and what came out of one is never changed.

use utoipa::ToSchema;

use super::contents::{Content, Receiving, settle};
use super::documents::now;
use super::programs::holds_in;
use super::session::{Row, Session, values};
use super::states::State;
use super::{Store, StoreError};
use crate::rights::{Act, Role};

/// A translation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Translation {
    /// Its name.
    pub(crate) id: String,
    /// A digest of all that went in, but for the programs that it calls.
    pub(crate) key: String,
    /// The program.
    pub(crate) program: String,
    /// The revision.
    pub(crate) revision: i64,
    /// The request, JSON.
    pub(crate) asked: String,
    /// Digests of what went in, JSON.
    pub(crate) inputs: String,
    /// The target: machine and dialect.
    pub(crate) target: String,
    /// The state of the approval.
    pub(crate) state: State,
    /// Author of the first request.
    pub(crate) author: String,
    /// When it was made, seconds since 1970 (UTC).
    pub(crate) made: i64,
}

/// A result of a translation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ToSchema)]
#[schema(as = TranslationResult, rename_all = "lowercase")]
pub(crate) enum Outcome {
    /// The text.
    Output,
    /// The report, as `ncc --report` writes it.
    Report,
    /// For each line of the output the first line of the source that it comes from, or 0: a list, JSON.
    Map,
    /// The certificate, once somebody has asked for it.
    Certificate,
}

impl Outcome {
    const fn column(self) -> &'static str {
        match self {
            Outcome::Output => "output",
            Outcome::Report => "report",
            Outcome::Map => "map",
            Outcome::Certificate => "certificate",
        }
    }
}

const TRANSLATION: &str = "SELECT id, key, program, revision, asked, inputs, target, state, author, made \
                           FROM translation";

fn read(mut row: Row) -> Result<Translation, StoreError> {
    let state = row.text(7)?;
    let unknown = || StoreError::Database(format!("no state is called {state:?}"));
    Ok(Translation {
        id: row.text(0)?,
        key: row.text(1)?,
        program: row.text(2)?,
        revision: row.int(3)?,
        asked: row.text(4)?,
        inputs: row.text(5)?,
        target: row.text(6)?,
        state: State::named(&state).ok_or_else(unknown)?,
        author: row.text(8)?,
        made: row.int(9)?,
    })
}

fn keep(to: &dyn Session, bytes: &[u8]) -> Result<i64, StoreError> {
    let mut text = Receiving::default();
    text.take(bytes);
    Ok(settle(to, text)?.id)
}

impl Store {
    /// Keeps a translation; those that have been made of the same are given in its place.
    pub(crate) fn keep_translation(
        &self,
        made: &Translation,
        [output, report, map]: [&[u8]; 3],
    ) -> Result<Translation, StoreError> {
        self.database.write(|to| {
            self.may_with(to, &made.program, Act::Change)?;
            let same = format!("{TRANSLATION} WHERE key = $1 AND inputs = $2");
            if let Some(there) = to.maybe_row(&same, values![&made.key, &made.inputs])? {
                return read(there);
            }
            let made = Translation { made: now(), ..made.clone() };
            let [output, report, map] = [output, report, map].map(|bytes| keep(to, bytes));
            to.change(
                "INSERT INTO translation
                 (id, key, program, revision, asked, inputs, output, report, map, author, made, target, state)
                 VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11, $12, $13)",
                values![
                    &made.id,
                    &made.key,
                    &made.program,
                    made.revision,
                    &made.asked,
                    &made.inputs,
                    output?,
                    report?,
                    map?,
                    &made.author,
                    made.made,
                    &made.target,
                    made.state.name()
                ],
            )?;
            let detail = format!("program {} revision {}", made.program, made.revision);
            self.note(to, "translation.create", &made.id, &detail)?;
            Ok(made)
        })
    }

    /// Translations of which the same went in, but for the programs that they call.
    pub(crate) fn same_translations(&self, key: &str) -> Result<Vec<Translation>, StoreError> {
        self.database.read(|from| {
            from.read(&format!("{TRANSLATION} WHERE key = $1 ORDER BY made DESC, id"), values![key], read)
        })
    }

    /// A translation.
    pub(crate) fn translation(&self, id: &str) -> Result<Translation, StoreError> {
        self.database.read(|from| {
            let found = read(from.row(&format!("{TRANSLATION} WHERE id = $1"), values![id])?)?;
            self.may_with(from, &found.program, Act::Read)?;
            Ok(found)
        })
    }

    /// Translations of a program, or all, those in a state, or all, in the order of their names; those after a name, so many
    /// at most.
    pub(crate) fn translations(
        &self,
        program: Option<&str>,
        state: Option<State>,
        after: &str,
        most: u32,
    ) -> Result<Vec<Translation>, StoreError> {
        self.database.read(|from| {
            let sql = format!(
                "{TRANSLATION} WHERE (CAST($1 AS TEXT) IS NULL OR program = $1)
                 AND (CAST($2 AS TEXT) IS NULL OR state = $2) AND id > $3
                 AND (CAST($5 AS TEXT) IS NULL OR EXISTS (
                     SELECT 1 FROM program p WHERE p.id = program AND {}))
                 ORDER BY id LIMIT $4",
                holds_in("p.folder", "$5", "$6")
            );
            let rank = Role::of(Act::Read).rank();
            from.read(&sql, values![program, state.map(State::name), after, most, self.reader(), rank], read)
        })
    }

    /// Notes that a translation is stale, so that it is found as such.
    pub(crate) fn note_stale(&self, id: &str) -> Result<(), StoreError> {
        self.database.write(|to| {
            to.change("UPDATE translation SET is_stale = TRUE WHERE id = $1", values![id])?;
            Ok(())
        })
    }

    /// A result of a translation; none of a certificate before the first request for it.
    pub(crate) fn outcome(&self, id: &str, outcome: Outcome) -> Result<Option<Content>, StoreError> {
        self.database.read(|from| {
            let column = outcome.column();
            let sql = format!(
                "SELECT c.id, c.sha256, c.bytes, t.program FROM translation t
                 LEFT JOIN content c ON c.id = t.{column} WHERE t.id = $1"
            );
            let mut row = from.row(&sql, values![id])?;
            self.may_with(from, &row.text(3)?, Act::Read)?;
            let (content, sha256) = (row.maybe_int(0)?, row.maybe_text(1)?);
            let bytes = row.maybe_int(2)?.unwrap_or_default().unsigned_abs();
            Ok(content.zip(sha256).map(|(id, sha256)| Content { id, sha256, bytes }))
        })
    }

    /// Keeps a certificate with its translation.
    pub(crate) fn keep_certificate(&self, id: &str, text: &[u8]) -> Result<(), StoreError> {
        self.database.write(|to| {
            let content = keep(to, text)?;
            to.change("UPDATE translation SET certificate = $2 WHERE id = $1", values![id, content])?;
            Ok(())
        })
    }
}
