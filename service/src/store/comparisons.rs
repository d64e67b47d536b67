//! Comparisons of each revision with the one before it: who waits for one, who makes it, and its line.
//!
//! A revision never changes, so its comparison is made once. Not here: the comparison (`crate::comparing`).

use std::collections::BTreeMap;

use super::documents::now;
use super::session::{Row, Session, values};
use super::{Store, StoreError};
use crate::rights::Act;

/// Claims of a pair before it is no more executed: each of them ended its process.
const TRIES: i64 = 3;

/// The result of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// It is not known yet.
    Waiting,
    /// Both make the same motion.
    Equal,
    /// They do not.
    Different,
    /// One of them cannot be executed.
    NotCompared,
}

impl Verdict {
    const ALL: [(&str, Verdict); 4] = [
        ("waiting", Verdict::Waiting),
        ("equal", Verdict::Equal),
        ("different", Verdict::Different),
        ("not-compared", Verdict::NotCompared),
    ];

    /// Its name.
    pub(crate) fn name(self) -> &'static str {
        Verdict::ALL.iter().find(|(_, own)| *own == self).map_or("", |(name, _)| name)
    }

    fn of(name: &str) -> Result<Verdict, StoreError> {
        let found = Verdict::ALL.iter().find(|(own, _)| *own == name).map(|(_, own)| *own);
        found.ok_or_else(|| StoreError::Database(format!("no comparison is `{name}`")))
    }
}

/// A comparison.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Comparison {
    /// Its result.
    pub(crate) verdict: Verdict,
    /// The result in a line; empty while it waits.
    pub(crate) line: String,
}

/// A revision that a worker compares with the one before it.
#[derive(Clone, Debug)]
pub(crate) struct Pair {
    /// The program.
    pub(crate) program: String,
    /// The revision, from 2.
    pub(crate) number: i64,
    /// Whether both may be executed: they have not ended their process several times.
    pub(crate) may_run: bool,
}

/// Has a new revision wait for its comparison.
pub(super) fn wait(to: &dyn Session, program: &str, number: i64, made: i64) -> Result<(), StoreError> {
    if number > 1 {
        to.change(
            "INSERT INTO comparison (program, number, since) VALUES ($1, $2, $3)",
            values![program, number, made],
        )?;
    }
    Ok(())
}

impl Store {
    /// Whether a revision waits for its comparison.
    pub(crate) fn comparisons_wait(&self) -> Result<bool, StoreError> {
        self.database.read(|from| {
            let one = "SELECT number FROM comparison WHERE state = 'waiting' AND until < $1 LIMIT 1";
            Ok(from.maybe_row(one, values![now()])?.is_some())
        })
    }

    /// Claims the revision that waits longest, for so many seconds.
    pub(crate) fn claim_comparison(&self, worker: &str, seconds: i64) -> Result<Option<Pair>, StoreError> {
        self.database.write(|to| {
            let time = now();
            let claimed = to.maybe_row(
                "UPDATE comparison SET worker = $1, until = $2, tries = tries + 1 WHERE (program, number) IN (
                     SELECT program, number FROM comparison WHERE state = 'waiting' AND until < $3
                     ORDER BY since, program, number LIMIT 1)
                 RETURNING program, number, tries",
                values![worker, time + seconds, time],
            )?;
            let read = |mut row: Row| {
                let (program, number) = (row.text(0)?, row.int(1)?);
                Ok(Pair { program, number, may_run: row.int(2)? <= TRIES })
            };
            claimed.map(read).transpose()
        })
    }

    /// Keeps the comparison of a revision that a worker has claimed; whether it was still the worker's.
    pub(crate) fn keep_comparison(
        &self,
        worker: &str,
        pair: &Pair,
        made: &Comparison,
    ) -> Result<bool, StoreError> {
        self.database.write(|to| {
            let kept = to.change(
                "UPDATE comparison SET state = $4, line = $5, worker = '', until = 0
                 WHERE program = $1 AND number = $2 AND worker = $3",
                values![&pair.program, pair.number, worker, made.verdict.name(), &made.line],
            )?;
            Ok(kept > 0)
        })
    }

    /// Gives a revision back that a worker has not compared; it does not count as tried.
    pub(crate) fn give_comparison_back(&self, worker: &str, pair: &Pair) -> Result<(), StoreError> {
        self.database.write(|to| {
            to.change(
                "UPDATE comparison SET worker = '', until = 0, tries = tries - 1
                 WHERE program = $1 AND number = $2 AND worker = $3",
                values![&pair.program, pair.number, worker],
            )?;
            Ok(())
        })
    }

    /// Comparisons of revisions of a program from one number to another, by their numbers.
    pub(crate) fn comparisons(
        &self,
        program: &str,
        [least, most]: [i64; 2],
    ) -> Result<BTreeMap<i64, Comparison>, StoreError> {
        self.database.read(|from| {
            self.may_with(from, program, Act::Read)?;
            let read = |mut row: Row| {
                let verdict = Verdict::of(&row.text(1)?)?;
                Ok((row.int(0)?, Comparison { verdict, line: row.text(2)? }))
            };
            let sql = "SELECT number, state, line FROM comparison
                       WHERE program = $1 AND number >= $2 AND number <= $3";
            Ok(from.read(sql, values![program, least, most], read)?.into_iter().collect())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::programs::{Details, Said};
    use super::super::{Condition, Place, Receiving};
    use super::*;

    fn store() -> (tempfile::TempDir, Store) {
        let folder = tempfile::tempdir().expect("a folder");
        let store = Store::open(&Place::File(folder.path().join("a.sqlite"))).expect("a store");
        let details = Details { name: "a.nc".to_owned(), ..Details::default() };
        store.create_program("a", &details, Receiving::default(), &Said::default(), None).expect("a program");
        assert!(!store.comparisons_wait().expect("a store"), "a first revision has none before it");
        let tags = |details: &mut Details| details.tags.push("new".to_owned());
        store.change_details("a", tags, &Said::default(), &Condition::Any).expect("a change");
        (folder, store)
    }

    #[test]
    fn a_pair_is_compared_by_one_worker() {
        let (_folder, store) = store();
        let claim = |worker: &str, seconds| store.claim_comparison(worker, seconds).expect("a store");
        let dead = claim("dead", -1).expect("a pair");
        let alive = claim("alive", 60).expect("the pair again");
        assert_eq!((alive.number, alive.may_run), (2, true));
        assert!(claim("third", 60).is_none());
        let made = Comparison { verdict: Verdict::Equal, line: "the same text".to_owned() };
        assert!(!store.keep_comparison("dead", &dead, &made).expect("a store"));
        assert!(store.keep_comparison("alive", &alive, &made).expect("a store"));
        assert_eq!(store.comparisons("a", [1, 9]).expect("a store"), BTreeMap::from([(2, made)]));
        assert!(!store.comparisons_wait().expect("a store"));
    }

    #[test]
    fn a_pair_that_ends_its_process_is_no_more_executed() {
        let (_folder, store) = store();
        let given = store.claim_comparison("w", 60).expect("a store").expect("a pair");
        store.give_comparison_back("w", &given).expect("a store");
        for may_run in [true, true, true, false] {
            let pair = store.claim_comparison("w", -1).expect("a store").expect("a pair");
            assert_eq!(pair.may_run, may_run);
        }
    }
}
