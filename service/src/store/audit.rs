//! The audit: who did what when. Entries are added, and neither changed nor taken out.
//!
//! An entry is written with the change itself, in one transaction. Its digest is that of its fields and of the digest before
//! it: a chain, which a hand that changes the database breaks.

use super::documents::now;
use super::session::{Row, Session, Value, values};
use super::{Store, StoreError, digest};
use crate::rights::Act;

/// Entries that are read at once where the whole chain is read.
const PIECE: u32 = 1000;

/// An entry.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Entry {
    /// Counted from 1.
    pub(crate) number: i64,
    /// When, seconds since 1970 (UTC).
    pub(crate) moment: i64,
    /// The account, or the name of the local user; empty for the service itself.
    pub(crate) account: String,
    /// `local`, `login`, `token ID`, `job`, `command`, `service`.
    pub(crate) way: String,
    /// The client's address; empty without one.
    pub(crate) address: String,
    /// The name of the request; empty without one.
    pub(crate) request: String,
    /// The action: `program.create`.
    pub(crate) action: String,
    /// The name of what was changed.
    pub(crate) subject: String,
    /// More about the change.
    pub(crate) detail: String,
    /// Of all fields, and of the digest before.
    pub(crate) digest: String,
}

impl Entry {
    /// The digest that it has to have after another one.
    fn digest_after(&self, before: &str) -> String {
        digest(
            &[
                before,
                &self.number.to_string(),
                &self.moment.to_string(),
                &self.account,
                &self.way,
                &self.address,
                &self.request,
                &self.action,
                &self.subject,
                &self.detail,
            ]
            .map(str::as_bytes),
        )
    }
}

/// A filter of entries.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Filter {
    /// Those of this account.
    pub(crate) account: Option<String>,
    /// Those about this.
    pub(crate) subject: Option<String>,
    /// Those of this action.
    pub(crate) action: Option<String>,
    /// Those from this moment on, seconds since 1970 (UTC).
    pub(crate) from: Option<i64>,
    /// Those before this moment.
    pub(crate) until: Option<i64>,
}

/// The end of a chain that holds: how many entries it has, and the digest of the last one.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Chain {
    /// Number of entries.
    pub(crate) entries: i64,
    /// Digest of the last one; empty if there is none.
    pub(crate) digest: String,
    /// The first entry that does not follow the one before it.
    pub(crate) broken: Option<i64>,
}

const ENTRY: &str =
    "SELECT number, moment, account, way, address, request, action, subject, detail, digest FROM audit";

fn read(mut row: Row) -> Result<Entry, StoreError> {
    Ok(Entry {
        number: row.int(0)?,
        moment: row.int(1)?,
        account: row.text(2)?,
        way: row.text(3)?,
        address: row.text(4)?,
        request: row.text(5)?,
        action: row.text(6)?,
        subject: row.text(7)?,
        detail: row.text(8)?,
        digest: row.text(9)?,
    })
}

impl Store {
    /// Adds an entry about a change of the same transaction.
    pub(super) fn note(
        &self,
        to: &dyn Session,
        action: &str,
        subject: &str,
        detail: &str,
    ) -> Result<(), StoreError> {
        let last =
            to.maybe_row("SELECT number, digest FROM audit ORDER BY number DESC LIMIT 1", values![])?;
        let (number, before) = match last {
            Some(mut row) => (row.int(0)?, row.text(1)?),
            None => (0, String::new()),
        };
        let mut entry = Entry {
            number: number + 1,
            moment: now(),
            account: self.who.name.clone(),
            way: self.who.way(),
            address: self.who.address.map(|address| address.to_string()).unwrap_or_default(),
            request: self.who.request.clone(),
            action: action.to_owned(),
            subject: subject.to_owned(),
            detail: detail.to_owned(),
            digest: String::new(),
        };
        entry.digest = entry.digest_after(&before);
        to.change(
            "INSERT INTO audit (number, moment, account, way, address, request, action, subject, detail, digest)
             VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9, $10)",
            values![
                entry.number,
                entry.moment,
                entry.account,
                entry.way,
                entry.address,
                entry.request,
                entry.action,
                entry.subject,
                entry.detail,
                entry.digest
            ],
        )?;
        Ok(())
    }

    /// Adds an entry about something that changes nothing else.
    pub(crate) fn note_alone(&self, action: &str, subject: &str, detail: &str) -> Result<(), StoreError> {
        self.database.write(|to| self.note(to, action, subject, detail))
    }

    /// Entries before a number, the newest first, so many at most.
    pub(crate) fn audit(&self, filter: &Filter, before: i64, most: u32) -> Result<Vec<Entry>, StoreError> {
        self.entries(filter, "number < $6 ORDER BY number DESC", before, most)
    }

    /// Entries after a number, the oldest first, so many at most.
    pub(crate) fn audit_after(
        &self,
        filter: &Filter,
        after: i64,
        most: u32,
    ) -> Result<Vec<Entry>, StoreError> {
        self.entries(filter, "number > $6 ORDER BY number", after, most)
    }

    fn entries(
        &self,
        filter: &Filter,
        order: &str,
        number: i64,
        most: u32,
    ) -> Result<Vec<Entry>, StoreError> {
        self.may(Act::Administer, "")?;
        let sql = format!(
            "{ENTRY} WHERE (CAST($1 AS TEXT) IS NULL OR account = $1)
             AND (CAST($2 AS TEXT) IS NULL OR subject = $2)
             AND (CAST($3 AS TEXT) IS NULL OR action = $3)
             AND moment >= $4 AND moment < $5 AND {order} LIMIT $7"
        );
        let values: &[Value] = values![
            &filter.account,
            &filter.subject,
            &filter.action,
            filter.from.unwrap_or(i64::MIN),
            filter.until.unwrap_or(i64::MAX),
            number,
            most
        ];
        self.database.read(|from| from.read(&sql, values, read))
    }

    /// Follows the chain from its beginning.
    pub(crate) fn follow_chain(&self) -> Result<Chain, StoreError> {
        let mut chain = Chain::default();
        loop {
            let piece = self.audit_after(&Filter::default(), chain.entries, PIECE)?;
            if piece.is_empty() {
                return Ok(chain);
            }
            for entry in piece {
                let is_next = entry.number == chain.entries + 1;
                if !is_next || entry.digest_after(&chain.digest) != entry.digest {
                    chain.broken = Some(entry.number);
                    return Ok(chain);
                }
                (chain.entries, chain.digest) = (entry.number, entry.digest);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A changed entry with a new digest breaks the next entry.
    #[test]
    fn an_entry_rests_on_the_one_before() {
        let folder = tempfile::tempdir().expect("a folder");
        let store = Store::open(&super::super::Place::File(folder.path().join("a.sqlite"))).expect("a store");
        for subject in ["a", "b", "c"] {
            store.note_alone("test", subject, "").expect("an entry");
        }
        let all = store.audit_after(&Filter::default(), 0, 10).expect("entries");
        let [first, second, third] = all.as_slice() else { panic!("{all:?}") };
        assert_eq!(second.digest_after(&first.digest), second.digest);
        let changed = Entry { subject: "x".to_owned(), ..second.clone() };
        assert_ne!(third.digest_after(&changed.digest_after(&first.digest)), third.digest);
        assert_eq!(store.follow_chain().expect("a chain").entries, 3);
    }
}
