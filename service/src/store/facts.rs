//! Facts of programs as they are now, and the programs that wait for theirs.
//!
//! Each change of a program, of one that it calls and of its machine raises the turn of its row, in the transaction of the
//! change. A worker claims a row for a while and writes the facts of the turn that it has claimed, so a change meanwhile makes
//! the program wait again. Not here: what a program does (`crate::facts`), and how it is found (`search`).

use super::documents::now;
use super::hooks::events::became_stale;
use super::session::{Row, Session, Value, values};
use super::{Store, StoreError};
use crate::rights::Act;

/// Claims of a program before it is no more executed: each of them ended its process.
const TRIES: i64 = 3;

/// Terms that one statement writes.
const ROWS: usize = 32;

/// The term of a program that calls one which is not there.
pub(crate) const CALLS_ABSENT: &str = "k";

/// The term of a program that calls another one from its folder.
pub(crate) fn calls(name: &str) -> String {
    format!("k {name}")
}

/// A program whose facts a worker computes.
#[derive(Clone, Debug)]
pub(crate) struct Claimed {
    id: i64,
    turn: i64,
    /// The program.
    pub(crate) program: String,
    /// Digests of what the facts that are there were computed from, JSON; empty before the first time.
    pub(crate) inputs: String,
    /// The facts that are there, JSON.
    pub(crate) document: String,
    /// Whether it may be executed: it has not ended its process several times.
    pub(crate) may_run: bool,
}

/// A term by which a program is found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Term {
    /// Its kind, a letter, and its text.
    pub(crate) text: String,
    /// The first line with it, from 1; 0 of none.
    pub(crate) line: i64,
    /// The first byte of that line; -1 of none.
    pub(crate) place: i64,
}

/// Facts, computed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Computed {
    /// Digests of what went in, JSON.
    pub(crate) inputs: String,
    /// All of them, JSON.
    pub(crate) document: String,
    /// Seconds of the program, in ms; none where it was not executed.
    pub(crate) ms: Option<i64>,
    /// Least and greatest X, Y and Z of its feed moves, in µm.
    pub(crate) extents: Option<[[i64; 2]; 3]>,
    /// Terms, each once.
    pub(crate) terms: Vec<Term>,
    /// Its translations, and which inputs of each have changed; none of one that is not stale.
    pub(crate) stale: Vec<(String, Vec<&'static str>)>,
}

impl Store {
    /// Whether a program waits for its facts.
    pub(crate) fn facts_wait(&self) -> Result<bool, StoreError> {
        self.database.read(|from| {
            let one = "SELECT id FROM fact WHERE done < turn AND until < $1 LIMIT 1";
            Ok(from.maybe_row(one, values![now()])?.is_some())
        })
    }

    /// Claims the program that waits longest, for so many seconds.
    pub(crate) fn claim_facts(&self, worker: &str, seconds: i64) -> Result<Option<Claimed>, StoreError> {
        self.database.write(|to| {
            let time = now();
            let claimed = to.maybe_row(
                "UPDATE fact SET worker = $1, until = $2, tries = tries + 1 WHERE id IN (
                     SELECT id FROM fact WHERE done < turn AND until < $3 ORDER BY since, id LIMIT 1)
                 RETURNING id, turn, program, inputs, document, tries",
                values![worker, time + seconds, time],
            )?;
            let read = |mut row: Row| {
                Ok(Claimed {
                    id: row.int(0)?,
                    turn: row.int(1)?,
                    program: row.text(2)?,
                    inputs: row.text(3)?,
                    document: row.text(4)?,
                    may_run: row.int(5)? <= TRIES,
                })
            };
            claimed.map(read).transpose()
        })
    }

    /// Writes the facts of a program that a worker has claimed; whether it was still the worker's.
    pub(crate) fn keep_facts(
        &self,
        worker: &str,
        claimed: &Claimed,
        made: &Computed,
    ) -> Result<bool, StoreError> {
        self.database.write(|to| {
            let ends = made.extents.map(|all| all.map(|[least, most]| [Some(least), Some(most), Some(most - least)]));
            let [x, y, z] = ends.unwrap_or_default();
            let kept = to.change(
                "UPDATE fact SET done = $3, worker = '', until = 0, tries = 0, ncc = $4, inputs = $5, document = $6, ms = $7,
                     x_min = $8, x_max = $9, x_span = $10, y_min = $11, y_max = $12, y_span = $13, z_min = $14, z_max = $15,
                     z_span = $16
                 WHERE id = $1 AND worker = $2",
                values![
                    claimed.id,
                    worker,
                    claimed.turn,
                    env!("CARGO_PKG_VERSION"),
                    &made.inputs,
                    &made.document,
                    made.ms,
                    x[0],
                    x[1],
                    x[2],
                    y[0],
                    y[1],
                    y[2],
                    z[0],
                    z[1],
                    z[2]
                ],
            )?;
            if kept == 0 {
                return Ok(false);
            }
            to.change("DELETE FROM term WHERE fact = $1", values![claimed.id])?;
            made.terms.chunks(ROWS).try_for_each(|terms| add(to, claimed.id, terms))?;
            for (translation, changed) in &made.stale {
                let is_stale = !changed.is_empty();
                let is_new = to.change(
                    "UPDATE translation SET is_stale = $2 WHERE id = $1 AND is_stale <> $2",
                    values![translation, is_stale],
                )? == 1;
                if is_stale && is_new {
                    became_stale(to, translation, changed)?;
                }
            }
            Ok(true)
        })
    }

    /// Gives a program back whose facts a worker has not computed; it does not count as tried.
    pub(crate) fn give_facts_back(&self, worker: &str, claimed: &Claimed) -> Result<(), StoreError> {
        self.database.write(|to| {
            to.change(
                "UPDATE fact SET worker = '', until = 0, tries = tries - 1 WHERE id = $1 AND worker = $2",
                values![claimed.id, worker],
            )?;
            Ok(())
        })
    }

    /// Has programs wait whose facts another version of ncc has computed.
    pub(super) fn renew_facts(&self) -> Result<(), StoreError> {
        let ncc = env!("CARGO_PKG_VERSION");
        let other = self.database.read(|from| {
            from.maybe_row("SELECT id FROM fact WHERE done = turn AND ncc <> $1 LIMIT 1", values![ncc])
        })?;
        // A database on a full disk is opened too.
        if other.is_none() {
            return Ok(());
        }
        self.database.write(|to| {
            to.change(
                "UPDATE fact SET turn = turn + 1, since = $2 WHERE done = turn AND ncc <> $1",
                values![ncc, now()],
            )?;
            Ok(())
        })
    }

    /// The facts of a program, JSON, and whether they are of the program as it is; none before the first time.
    pub(crate) fn facts(&self, program: &str) -> Result<(Option<String>, bool), StoreError> {
        self.database.read(|from| {
            self.may_with(from, program, Act::Read)?;
            let sql = "SELECT document, done = turn FROM fact WHERE program = $1";
            let mut row = from.row(sql, values![program])?;
            Ok((Some(row.text(0)?).filter(|document| !document.is_empty()), row.is(1)?))
        })
    }
}

/// Writes terms by one statement.
fn add(to: &dyn Session, fact: i64, terms: &[Term]) -> Result<(), StoreError> {
    let rows = (0..terms.len()).map(|row| {
        let at = 3 * row + 2;
        format!("(${}, $1, ${}, ${})", at, at + 1, at + 2)
    });
    let sql =
        format!("INSERT INTO term (term, fact, line, place) VALUES {}", rows.collect::<Vec<_>>().join(", "));
    let one = |term: &Term| [Value::from(&term.text), Value::Int(term.line), Value::Int(term.place)];
    let values: Vec<Value> = std::iter::once(Value::Int(fact)).chain(terms.iter().flat_map(one)).collect();
    to.change(&sql, &values)?;
    Ok(())
}

/// Has a program wait for its facts after a change of it, and programs that call it. `now_at` is its folder, its name and its
/// machine; none of a program that was deleted.
pub(super) fn changed(to: &dyn Session, program: &str, now_at: Option<[&str; 3]>) -> Result<(), StoreError> {
    let before = to.maybe_row("SELECT folder, name FROM fact WHERE program = $1", values![program])?;
    if let Some(mut before) = before {
        callers_wait(to, &before.text(0)?, &before.text(1)?)?;
    }
    let Some([folder, name, machine]) = now_at else {
        to.change("DELETE FROM fact WHERE program = $1", values![program])?;
        return Ok(());
    };
    callers_wait(to, folder, name)?;
    to.change(
        "INSERT INTO fact (program, folder, name, machine, since) VALUES ($1, $2, $3, $4, $5)
         ON CONFLICT (program) DO UPDATE SET folder = excluded.folder, name = excluded.name, machine = excluded.machine,
             turn = fact.turn + 1, since = CASE WHEN fact.done < fact.turn THEN fact.since ELSE excluded.since END",
        values![program, folder, name, machine, now()],
    )?;
    Ok(())
}

/// Has programs of a folder wait that call one under this name, or one that was not there, or of which that is not known yet.
fn callers_wait(to: &dyn Session, folder: &str, name: &str) -> Result<(), StoreError> {
    to.change(
        "UPDATE fact SET turn = turn + 1, since = CASE WHEN done < turn THEN since ELSE $4 END
         WHERE folder = $1 AND (id IN (SELECT fact FROM term WHERE term = $2 OR term = $3) OR done < turn AND worker <> '')",
        values![folder, calls(name), CALLS_ABSENT, now()],
    )?;
    Ok(())
}

/// Has programs wait that are for a machine or in a dialect, or have been translated from it or for it; and those whose facts
/// are computed right now, as these do not say yet what goes in.
pub(super) fn shop_changed(to: &dyn Session, name: &str) -> Result<(), StoreError> {
    // As facts have what went in, and translations what was asked for.
    let stated = serde_json::Value::from(name).to_string();
    let signs = stated.replace('!', "!!").replace('%', "!%").replace('_', "!_");
    to.change(
        "UPDATE fact SET turn = turn + 1, since = CASE WHEN done < turn THEN since ELSE $3 END
         WHERE machine = $1 OR done < turn AND worker <> '' OR inputs LIKE CAST($2 AS TEXT) ESCAPE '!'
         OR program IN (SELECT program FROM translation WHERE asked LIKE CAST($2 AS TEXT) ESCAPE '!')",
        values![name, format!("%\":{signs}%"), now()],
    )?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::programs::{Details, Said};
    use super::super::{Place, Receiving};
    use super::*;

    fn store() -> (tempfile::TempDir, Store) {
        let folder = tempfile::tempdir().expect("a folder");
        let store = Store::open(&Place::File(folder.path().join("a.sqlite"))).expect("a store");
        let details = Details { name: "a.nc".to_owned(), ..Details::default() };
        store.create_program("a", &details, Receiving::default(), &Said::default(), None).expect("a program");
        (folder, store)
    }

    fn claim(store: &Store, worker: &str, seconds: i64) -> Option<Claimed> {
        store.claim_facts(worker, seconds).expect("a store")
    }

    #[test]
    fn a_program_is_computed_by_one_worker() {
        let (_folder, store) = store();
        let dead = claim(&store, "dead", -1).expect("a program");
        let alive = claim(&store, "alive", 60).expect("the program again");
        assert!(claim(&store, "third", 60).is_none());
        assert!(!store.keep_facts("dead", &dead, &Computed::default()).expect("a store"));
        assert!(store.keep_facts("alive", &alive, &Computed::default()).expect("a store"));
        assert!(!store.facts_wait().expect("a store") && claim(&store, "third", 60).is_none());
    }

    #[test]
    fn a_change_while_it_is_computed_makes_it_wait_again() {
        let (_folder, store) = store();
        let claimed = claim(&store, "w", 60).expect("a program");
        let tags = |details: &mut Details| details.tags.push("new".to_owned());
        store.change_details("a", tags, &Said::default(), &super::super::Condition::Any).expect("a change");
        assert!(store.keep_facts("w", &claimed, &Computed::default()).expect("a store"));
        assert!(!store.facts("a").expect("facts").1);
        assert!(claim(&store, "w", 60).is_some());
    }

    #[test]
    fn a_program_that_ends_its_process_is_no_more_executed() {
        let (_folder, store) = store();
        let given = claim(&store, "w", 60).expect("a program");
        store.give_facts_back("w", &given).expect("a store");
        for _ in 0..TRIES {
            assert!(claim(&store, "w", -1).expect("a program").may_run);
        }
        assert!(!claim(&store, "w", -1).expect("a program").may_run);
    }

    #[test]
    fn another_ncc_computes_them_again() {
        let (_folder, store) = store();
        let claimed = claim(&store, "w", 60).expect("a program");
        store.keep_facts("w", &claimed, &Computed::default()).expect("a store");
        store.renew_facts().expect("a store");
        assert!(!store.facts_wait().expect("a store"));
        let older = "UPDATE fact SET ncc = '0.0.1'";
        store.database.write(|to| to.change(older, values![])).expect("a store");
        store.renew_facts().expect("a store");
        assert!(store.facts_wait().expect("a store"));
    }
}
