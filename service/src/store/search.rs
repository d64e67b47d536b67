//! Programs found by what they say and do.
//!
//! Words, codes, tools, tags and other equalities are terms of one index (`term`), times and extents are columns with an index
//! each. A search begins with its rarest condition and probes the others for each program that this one gives; if all are
//! frequent, it goes through the programs in their order and stops when a page is full. The statements are the same for both
//! databases. Not here: the terms of a program (`crate::facts`).

use super::contents::PIECE;
use super::programs::{COLUMNS, Revision, holds_in, read_from};
use super::session::{Row, Session, Value, values};
use super::states::State;
use super::{Store, StoreError};
use crate::rights::{Act, Role};

/// Programs with which a condition counts as frequent.
const FREQUENT: i64 = 1000;

/// Bytes of a line that are shown, at most.
const EXCERPT: usize = 160;

/// Programs of which one statement lists the translations.
const PROGRAMS: usize = 100;

/// A condition on a number: its column, and the least and the greatest value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Range {
    /// The name of the column, never text of a request.
    pub(crate) column: &'static str,
    /// The least value.
    pub(crate) least: Option<i64>,
    /// The greatest value.
    pub(crate) most: Option<i64>,
}

/// Conditions of a search; all of them hold for what is found.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Sought {
    /// Terms that the program has.
    pub(crate) terms: Vec<String>,
    /// Beginnings of terms, each of one that the program has.
    pub(crate) beginnings: Vec<String>,
    /// Numbers.
    pub(crate) ranges: Vec<Range>,
    /// The folder, with those below it.
    pub(crate) under: Option<String>,
    /// The folder alone.
    pub(crate) folder: Option<String>,
    /// The state of one of its translations.
    pub(crate) state: Option<State>,
    /// Whether one of its translations is stale.
    pub(crate) stale: Option<bool>,
    /// The term whose first line is shown.
    pub(crate) shown: Option<Shown>,
    /// Those after this program.
    pub(crate) after: Option<String>,
    /// So many at most.
    pub(crate) most: u32,
}

/// A term that is shown where it stands, or the beginning of one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Shown {
    /// The term.
    Term(String),
    /// Its beginning.
    Beginning(String),
}

/// A place of a word in a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Hit {
    /// The line, from 1.
    pub(crate) line: i64,
    /// Bytes from the beginning of the line.
    pub(crate) text: Vec<u8>,
}

/// A translation of a program that was found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct OfProgram {
    /// Its name.
    pub(crate) id: String,
    /// Its target.
    pub(crate) target: String,
    /// The state.
    pub(crate) state: String,
    /// Whether it is stale.
    pub(crate) is_stale: bool,
}

/// A program that was found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Found {
    /// The program as it is.
    pub(crate) of: Revision,
    /// Its facts, JSON; empty before the first time.
    pub(crate) document: String,
    /// Whether they are of the program as it is.
    pub(crate) is_up_to_date: bool,
    /// Place of the word in the text.
    pub(crate) hit: Option<Hit>,
    /// Its translations, the newest first.
    pub(crate) translations: Vec<OfProgram>,
}

/// A statement in the making.
#[derive(Default)]
struct Statement {
    values: Vec<Value>,
}

impl Statement {
    /// A place for a value.
    fn put(&mut self, value: impl Into<Value>) -> String {
        self.values.push(value.into());
        format!("${}", self.values.len())
    }

    /// The terms with a beginning.
    fn begins(&mut self, beginning: &str) -> String {
        // Behind all signs that a term has.
        let (from, to) = (self.put(beginning), self.put(format!("{beginning}\u{10FFFF}")));
        format!("h.term >= {from} AND h.term < {to}")
    }

    fn range(&mut self, range: &Range, table: &str) -> String {
        let mut all = Vec::new();
        for (value, sign) in [(range.least, ">="), (range.most, "<=")] {
            all.extend(value.map(|value| format!("{table}.{} {sign} {}", range.column, self.put(value))));
        }
        all.join(" AND ")
    }

    /// Programs `f` in a folder and below it. The first two bounds are those of the index; between them there are other names,
    /// such as `a-b` for `a`.
    fn under(&mut self, folder: &str) -> String {
        let (own, behind) = (self.put(folder), self.put(format!("{folder}0")));
        let below = self.put(format!("{folder}/"));
        format!("f.folder >= {own} AND f.folder < {behind} AND (f.folder = {own} OR f.folder >= {below})")
    }
}

/// A condition that may be the one that a search begins with: it gives the rows of programs.
enum First<'s> {
    Term(&'s str),
    Range(&'s Range),
    State(State),
    Stale,
}

impl First<'_> {
    /// Its rows of `fact`, and how the statement names them.
    fn rows(&self, statement: &mut Statement) -> String {
        match self {
            First::Term(term) => format!("SELECT h.fact AS id FROM term h WHERE h.term = {}", statement.put(*term)),
            First::Range(range) => format!("SELECT g.id FROM fact g WHERE {}", statement.range(range, "g")),
            First::State(state) => format!(
                "SELECT DISTINCT g.id FROM translation t CROSS JOIN fact g WHERE t.state = {} AND g.program = t.program",
                statement.put(state.name())
            ),
            First::Stale => {
                "SELECT DISTINCT g.id FROM translation t CROSS JOIN fact g WHERE t.is_stale AND g.program = t.program"
                    .to_owned()
            }
        }
    }
}

impl Sought {
    fn firsts(&self) -> Vec<First<'_>> {
        let terms = self.terms.iter().map(|term| First::Term(term));
        let ranges = self.ranges.iter().map(First::Range);
        let states = self.state.map(First::State);
        terms.chain(ranges).chain(states).chain((self.stale == Some(true)).then_some(First::Stale)).collect()
    }

    /// Its rarest condition, unless all are frequent.
    fn rarest(&self, from: &dyn Session) -> Result<Option<First<'_>>, StoreError> {
        let mut rarest = None;
        let mut fewest = FREQUENT;
        for first in self.firsts() {
            let mut statement = Statement::default();
            let rows = first.rows(&mut statement);
            let most = statement.put(fewest);
            let sql = format!("SELECT count(*) FROM ({rows} LIMIT {most}) few");
            let count = from.row(&sql, &statement.values)?.int(0)?;
            if count < fewest {
                (rarest, fewest) = (Some(first), count);
            }
        }
        Ok(rarest)
    }

    /// Conditions on a program `f`, the rights of the reader first.
    fn conditions(&self, reader: Option<&str>, statement: &mut Statement) -> Vec<String> {
        let mut all = Vec::new();
        if let Some(reader) = reader {
            let (reader, rank) = (statement.put(reader), statement.put(Role::of(Act::Read).rank()));
            all.push(holds_in("f.folder", &reader, &rank));
        }
        for term in &self.terms {
            let term = statement.put(term);
            all.push(format!("EXISTS (SELECT 1 FROM term h WHERE h.term = {term} AND h.fact = f.id)"));
        }
        for beginning in &self.beginnings {
            let begins = statement.begins(beginning);
            all.push(format!("EXISTS (SELECT 1 FROM term h WHERE h.fact = f.id AND {begins})"));
        }
        all.extend(self.ranges.iter().map(|range| statement.range(range, "f")));
        all.extend(self.under.as_deref().map(|folder| statement.under(folder)));
        all.extend(self.folder.as_ref().map(|folder| format!("f.folder = {}", statement.put(folder))));
        if let Some(state) = self.state {
            let state = statement.put(state.name());
            all.push(format!(
                "EXISTS (SELECT 1 FROM translation t WHERE t.state = {state} AND t.program = f.program)"
            ));
        }
        if let Some(stale) = self.stale {
            let not = if stale { "" } else { "NOT " };
            all.push(format!(
                "{not}EXISTS (SELECT 1 FROM translation t WHERE t.program = f.program AND t.is_stale)"
            ));
        }
        if let Some(after) = &self.after {
            let after = statement.put(after);
            // The row of a program stays when it is deleted.
            all.push(format!(
                "(f.folder, f.name, f.program) > (SELECT folder, name, id FROM program WHERE id = {after})"
            ));
        }
        all
    }

    /// The statement of a page: columns of a revision, then the facts, whether they are up to date, and the line of the word
    /// with its text.
    fn statement(&self, first: Option<&First>, reader: Option<&str>) -> (String, Vec<Value>) {
        let mut statement = Statement::default();
        let source = match first {
            None => "fact f".to_owned(),
            Some(first) => format!("({}) d CROSS JOIN fact f", first.rows(&mut statement)),
        };
        let mut all = self.conditions(reader, &mut statement);
        all.extend(first.map(|_| "f.id = d.id".to_owned()));
        let all = if all.is_empty() { String::new() } else { format!("WHERE {}", all.join(" AND ")) };
        let most = statement.put(self.most);
        let (line, place) = match &self.shown {
            None => ("0".to_owned(), "-1".to_owned()),
            Some(shown) => {
                let condition = match shown {
                    Shown::Term(term) => format!("h.term = {}", statement.put(term)),
                    Shown::Beginning(beginning) => statement.begins(beginning),
                };
                let of = |column: &str| {
                    format!(
                        "(SELECT h.{column} FROM term h WHERE h.fact = f.id AND {condition} AND h.place >= 0
                          ORDER BY h.place LIMIT 1)"
                    )
                };
                (of("line"), of("place"))
            }
        };
        let sql = format!(
            "SELECT {COLUMNS}, g.document, g.is_up_to_date, g.line,
                    (SELECT substr(b.bytes, CAST(g.place % {PIECE} + 1 AS INTEGER), {EXCERPT}) FROM content_piece b
                     WHERE b.content = c.id AND b.number = g.place / {PIECE} AND g.place >= 0)
             FROM (SELECT f.folder, f.name, f.program, f.document, f.done = f.turn AS is_up_to_date,
                          {line} AS line, {place} AS place
                   FROM {source} {all} ORDER BY f.folder, f.name, f.program LIMIT {most}) g
             JOIN program p ON p.id = g.program
             JOIN revision r ON r.program = p.id AND r.number = p.head
             JOIN content c ON c.id = r.content
             ORDER BY g.folder, g.name, g.program"
        );
        (sql, statement.values)
    }
}

fn read(mut row: Row) -> Result<Found, StoreError> {
    let of = read_from(&mut row)?;
    let line = row.maybe_int(16)?;
    let text = row.maybe_bytes(17)?;
    Ok(Found {
        of,
        document: row.text(14)?,
        is_up_to_date: row.is(15)?,
        hit: line.zip(text).map(|(line, text)| Hit { line, text }),
        translations: Vec::new(),
    })
}

/// Adds the translations of a page.
fn list_translations(from: &dyn Session, page: &mut [Found]) -> Result<(), StoreError> {
    for page in page.chunks_mut(PROGRAMS) {
        // The statement is the same for all pages: the last program fills it up.
        let Some(last) = page.last().map(|last| last.of.program.clone()) else { continue };
        let mut statement = Statement::default();
        let names = page.iter().map(|found| &found.of.program).chain(std::iter::repeat(&last)).take(PROGRAMS);
        let places: Vec<String> = names.map(|name| statement.put(name)).collect();
        let sql = format!(
            "SELECT program, id, target, state, is_stale FROM translation WHERE program IN ({})
             ORDER BY program, made DESC, id",
            places.join(", ")
        );
        let listed = |mut row: Row| {
            let listed = OfProgram {
                id: row.text(1)?,
                target: row.text(2)?,
                state: row.text(3)?,
                is_stale: row.is(4)?,
            };
            Ok((row.text(0)?, listed))
        };
        for (program, listed) in from.read(&sql, &statement.values, listed)? {
            if let Some(found) = page.iter_mut().find(|found| found.of.program == program) {
                found.translations.push(listed);
            }
        }
    }
    Ok(())
}

impl Store {
    /// A page of programs in the order of their folders and names; and how many programs wait for their facts.
    pub(crate) fn search(&self, sought: &Sought) -> Result<(Vec<Found>, i64), StoreError> {
        self.database.read(|from| {
            let first = sought.rarest(from)?;
            let (sql, values) = sought.statement(first.as_ref(), self.reader());
            let mut page = from.read(&sql, &values, read)?;
            list_translations(from, &mut page)?;
            let waiting = from.row("SELECT count(*) FROM fact WHERE done < turn", values![])?.int(0)?;
            Ok((page, waiting))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::facts::{Computed, Term};
    use super::super::programs::{Details, Said};
    use super::super::{Place, Receiving};
    use super::*;

    /// A store with programs that have a frequent and a rare term.
    fn store(programs: i64) -> (tempfile::TempDir, Store) {
        let folder = tempfile::tempdir().expect("a folder");
        let store = Store::open(&Place::File(folder.path().join("a.sqlite"))).expect("a store");
        for number in 0..programs {
            let details = Details {
                folder: format!("f{}", number % 3),
                name: format!("p{number}"),
                ..Details::default()
            };
            let id = format!("{number}");
            store
                .create_program(&id, &details, Receiving::default(), &Said::default(), None)
                .expect("a program");
            let claimed = store.claim_facts("w", 60).expect("a store").expect("a program");
            let term = |text: String| Term { text, line: 0, place: -1 };
            let computed = Computed {
                ms: Some(number * 1000),
                extents: Some([[0, number], [0, 1], [0, 2]]),
                terms: vec![term("c G1".to_owned()), term(format!("w only{number}"))],
                ..Computed::default()
            };
            assert!(store.keep_facts("w", &claimed, &computed).expect("a store"));
        }
        (folder, store)
    }

    fn range(column: &'static str, least: Option<i64>, most: Option<i64>) -> Range {
        Range { column, least, most }
    }

    /// Usual searches.
    fn usual() -> Vec<Sought> {
        let of = |terms: &[&str]| Sought {
            terms: terms.iter().map(|term| (*term).to_owned()).collect(),
            most: 10,
            ..Sought::default()
        };
        let shown = |term: &str| Some(Shown::Term(term.to_owned()));
        vec![
            of(&[]),
            of(&["c G1"]),
            Sought { shown: shown("w only7"), ..of(&["w only7", "c G1"]) },
            Sought { beginnings: vec!["w only".to_owned()], ..of(&["c G1"]) },
            Sought { under: Some("f1".to_owned()), ..of(&["c G1"]) },
            Sought { folder: Some("f1".to_owned()), ..of(&[]) },
            Sought { ranges: vec![range("ms", Some(2000), Some(4000))], ..of(&[]) },
            Sought {
                ranges: vec![range("x_span", None, Some(5)), range("z_span", None, Some(9))],
                ..of(&[])
            },
            Sought { state: Some(State::Released), ..of(&[]) },
            Sought { stale: Some(true), ..of(&[]) },
            Sought { after: Some("4".to_owned()), ..of(&["c G1"]) },
        ]
    }

    #[test]
    fn no_search_goes_through_a_table() {
        let (_folder, store) = store(30);
        for sought in usual() {
            for first in sought.firsts().iter().map(Some).chain([None]) {
                let (sql, values) = sought.statement(first, Some("ana"));
                let plan = store.database.read(|from| {
                    from.read(&format!("EXPLAIN QUERY PLAN {sql}"), &values, |mut row| row.text(3))
                });
                for step in plan.expect("a plan") {
                    // The programs in their order are an index, which is left when a page is full; that of stale
                    // translations has no others; `d` and `g` are the rows of the first condition and of the page.
                    let fits = [
                        "SCAN f USING INDEX fact_order",
                        "SCAN t USING INDEX translation_stale",
                        "SCAN d",
                        "SCAN g",
                    ];
                    let is_read_through = step.starts_with("SCAN") && !fits.contains(&step.as_str());
                    assert!(!is_read_through, "{step}: {sought:?}");
                }
            }
        }
    }

    #[test]
    fn whatever_a_search_begins_with_it_finds_the_same() {
        let (_folder, store) = store(30);
        for sought in usual() {
            let found = |first: Option<&First>| {
                let (sql, values) = sought.statement(first, None);
                let found = store.database.read(|from| from.read(&sql, &values, read)).expect("a page");
                found.into_iter().map(|found| found.of.details.name).collect::<Vec<_>>()
            };
            let all = found(None);
            for first in sought.firsts() {
                assert_eq!(found(Some(&first)), all, "{sought:?}");
            }
        }
        let sought =
            Sought { terms: vec!["c G1".to_owned(), "w only3".to_owned()], most: 5, ..Sought::default() };
        let rarest = store
            .database
            .read(|from| Ok(sought.rarest(from)?.map(|first| first.rows(&mut Statement::default()))));
        assert!(rarest.is_ok_and(|rows| rows.is_some()));
        assert_eq!(store.search(&sought).expect("a page").0.len(), 1);
    }
}
