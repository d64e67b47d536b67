//! Rows of a dictionary that stand behind a line: its codes, words and letters, found by the dialect's own
//! lexer.
//!
//! A row's name is the table and the word: `code/G43`, `cycle/G81`, `call/CYCLE81`, `address/Z`. What a
//! dictionary has no row for is not named.

use std::collections::HashMap;

use ncc_dialects::{Dialect, PatternRow};
use ncc_frontends::Word;
use serde::Serialize;

use super::shapes::{Shape, Shapes};
use crate::render::dialects::spaced;

/// A row of a dictionary.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct RowOf {
    /// Its table and word.
    pub id: String,
    /// The dictionary.
    pub dialect: &'static str,
    /// What the word means.
    pub meaning: String,
    /// The manual and its page, or another source.
    pub source: &'static str,
    /// Whether it is confirmed.
    pub sure: bool,
}

/// The rows of one dictionary that were met, each with a number.
#[derive(Debug)]
pub struct Met {
    dialect: &'static Dialect,
    /// Number of the first row.
    rows: Vec<RowOf>,
    numbers: HashMap<(Table, &'static str), usize>,
    /// Those of the rows of letters once more, by the letter: most words are met again and again.
    letters: [Option<usize>; LETTERS.len()],
    shapes: Shapes,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Table {
    Code,
    Cycle,
    Pattern,
    Address,
    Name,
    Call,
}

impl Met {
    pub(crate) fn new(dialect: &'static Dialect) -> Met {
        Met {
            dialect,
            rows: Vec::new(),
            numbers: HashMap::new(),
            letters: [None; LETTERS.len()],
            shapes: Shapes::new(),
        }
    }

    /// The rows met so far.
    pub fn rows(&self) -> &[RowOf] {
        &self.rows
    }

    /// Numbers of the rows behind a line, each once, in the order of the line.
    pub fn line(&mut self, line: &[u8], found: &mut Vec<usize>) {
        found.clear();
        let shape = Shape::of(line);
        if let Some(rows) = shape.as_ref().and_then(|shape| self.shapes.rows(shape)) {
            found.extend_from_slice(rows);
            return;
        }
        self.lexed(line, found);
        if let Some(shape) = shape {
            self.shapes.keep(shape, found);
        }
    }

    /// The same by the lexer.
    fn lexed(&mut self, line: &[u8], found: &mut Vec<usize>) {
        let dialect = self.dialect;
        ncc_frontends::words(dialect, line, &mut |word| self.word(dialect, word, found));
    }

    fn word(&mut self, d: &'static Dialect, word: Word, found: &mut Vec<usize>) {
        match word {
            Word::Numbered { letter, tenths: Some(tenths) } if letter == b'G' || letter == b'M' => {
                let Some(row) = d.code_row(letter, tenths) else { return self.letter(d, letter, found) };
                self.add(Table::Code, &row.code, found, || RowOf {
                    id: format!("code/{}", row.code),
                    dialect: &d.id,
                    meaning: meaning(row.means.map(|m| m.to_string()), row.refuse.as_deref()),
                    source: &row.source,
                    sure: row.sure,
                });
                self.structures(d, &row.code, found);
            }
            Word::Numbered { letter, .. } | Word::Letter(letter) => self.letter(d, letter, found),
            Word::Name(name) => self.name(d, &String::from_utf8_lossy(name).to_ascii_uppercase(), found),
        }
    }

    /// What a code activates.
    fn structures(&mut self, d: &'static Dialect, code: &str, found: &mut Vec<usize>) {
        if let Some(row) = d.cycle_row(code) {
            self.add(Table::Cycle, &row.code, found, || RowOf {
                id: format!("cycle/{}", row.code),
                dialect: &d.id,
                meaning: format!("canned cycle {}", row.kind),
                source: &row.source,
                sure: row.sure,
            });
        }
        if let Some(row) = d.pattern_row(code) {
            let (what, source) = match row {
                PatternRow::Circle { source, .. } => ("pattern bolt-circle", source),
                PatternRow::Grid { source, .. } => ("pattern grid", source),
            };
            self.add(Table::Pattern, row.code(), found, || RowOf {
                id: format!("pattern/{}", row.code()),
                dialect: &d.id,
                meaning: what.to_owned(),
                source,
                sure: true,
            });
        }
    }

    fn letter(&mut self, d: &'static Dialect, letter: u8, found: &mut Vec<usize>) {
        let place = usize::from(letter.wrapping_sub(b'A'));
        if let Some(number) = self.letters.get(place).copied().flatten() {
            return once(number, found);
        }
        let Some(row) = d.address_row(letter) else { return };
        let Some(name) = LETTERS.get(place) else { return };
        let number = self.add(Table::Address, name, found, || RowOf {
            id: format!("address/{}", row.letter),
            dialect: &d.id,
            meaning: match &row.refuse {
                Some(name) => name.clone(),
                None => spaced(&format!("{:?}, {:?}", row.role, row.quantity)),
            },
            source: &row.source,
            sure: row.sure,
        });
        if let Some(known) = self.letters.get_mut(place) {
            *known = Some(number);
        }
    }

    fn name(&mut self, d: &'static Dialect, name: &str, found: &mut Vec<usize>) {
        if let Some(row) = d.name_row(name) {
            let role = || row.role.map(|role| spaced(&format!("{role:?}")));
            self.add(Table::Name, &row.name, found, || RowOf {
                id: format!("name/{}", row.name),
                dialect: &d.id,
                meaning: meaning(row.means.map(|m| m.to_string()).or_else(role), row.refuse.as_deref()),
                source: &row.source,
                sure: row.sure,
            });
        }
        if let Some(row) = d.call_row(name) {
            self.add(Table::Call, &row.name, found, || RowOf {
                id: format!("call/{}", row.name),
                dialect: &d.id,
                meaning: spaced(&format!("{:?}", row.kind)),
                source: &row.source,
                sure: row.sure,
            });
        }
    }

    fn add(
        &mut self,
        table: Table,
        word: &'static str,
        found: &mut Vec<usize>,
        row: impl FnOnce() -> RowOf,
    ) -> usize {
        let rows = &mut self.rows;
        let number = *self.numbers.entry((table, word)).or_insert_with(|| {
            rows.push(row());
            rows.len() - 1
        });
        once(number, found);
        number
    }
}

fn once(number: usize, found: &mut Vec<usize>) {
    if !found.contains(&number) {
        found.push(number);
    }
}

/// The letters, each as a text.
const LETTERS: [&str; 26] = [
    "A", "B", "C", "D", "E", "F", "G", "H", "I", "J", "K", "L", "M", "N", "O", "P", "Q", "R", "S", "T", "U",
    "V", "W", "X", "Y", "Z",
];

fn meaning(means: Option<String>, refuse: Option<&str>) -> String {
    match (means, refuse) {
        (Some(means), _) => means,
        (None, Some(name)) => format!("refused: {name}"),
        (None, None) => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use ncc_dialects::{Family, builtins};

    use super::*;

    /// Lines whose shapes are known have the rows that the lexer finds, in every dialect.
    #[test]
    fn lines_of_a_known_shape_have_the_rows_of_the_lexer() {
        let mut known = 0;
        for dialect in builtins() {
            if matches!(dialect.family, Family::Canon | Family::Ir) {
                continue;
            }
            let [mut met, mut lexed] = [Met::new(dialect), Met::new(dialect)];
            for letter in b'A'..=b'Z' {
                for value in ["1", "2", "81", "-1", "0.5", "17.25", "54.1", "54.2", "10.", "007", ".5", "."] {
                    let letter = letter as char;
                    for line in [
                        format!("{letter}{value}\n"),
                        format!("N10 {letter}{value} Y5"),
                        format!("X1.5 {letter}{value} G1 F100\r\n"),
                        format!("X1{letter}{value} {letter} M3"),
                        format!("CYCLE{value} {letter}{value}"),
                        format!("{letter}1{value} G{value} M{value}"),
                    ] {
                        let [mut by_shape, mut by_lexer] = [Vec::new(), Vec::new()];
                        let shape = Shape::of(line.as_bytes());
                        known += u32::from(shape.is_some_and(|shape| met.shapes.rows(&shape).is_some()));
                        met.line(line.as_bytes(), &mut by_shape);
                        lexed.lexed(line.as_bytes(), &mut by_lexer);
                        assert_eq!(by_shape, by_lexer, "{}: {line}", dialect.id);
                    }
                }
            }
            assert_eq!(met.rows(), lexed.rows(), "{}", dialect.id);
        }
        assert!(known > 1_000, "{known}");
    }
}
