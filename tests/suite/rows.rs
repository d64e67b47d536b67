//! Every row of a dictionary is met by a program: what has a meaning by one of the corpus, or of those that
//! compute, what is refused
//! by a block made for it.
//!
//! A row that a dictionary has from the one it builds on, unchanged, may be met there.

use std::collections::BTreeSet;

use ncc_dialects::{Address, CodeRow, Dialect, Family, Meaning, Role, Settings, builtins};
use ncc_frontends::pieces::{Lines, Piece, PieceKind};
use ncc_ir::diag::Fault;
use ncc_tests::expect::Failures;
use ncc_tests::{corpus, translate};

/// The words of a dialect's corpus: codes as tenths behind their letter (`G510`), other letters and
/// names as they are.
fn words(dialect: &'static Dialect) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut pieces: Vec<Piece> = Vec::new();
    for program in corpus::of(&dialect.id).into_iter().chain(corpus::computing(&dialect.id)) {
        let mut lines = Lines::new(Settings::new(dialect));
        for line in program.text.split(|byte| *byte == b'\n') {
            let line = line.strip_suffix(b"\r").unwrap_or(line);
            let _ = lines.line(line, &mut pieces);
            for (at, piece) in pieces.iter().enumerate() {
                let text = || String::from_utf8_lossy(piece.text(line)).to_uppercase();
                match piece.kind {
                    PieceKind::Address | PieceKind::Letter => {
                        let number = pieces.get(at + 1).filter(|next| next.kind == PieceKind::Number);
                        let number =
                            number.and_then(|n| std::str::from_utf8(n.text(line)).ok()?.parse().ok());
                        found.extend(number.map(|number: f64| code(&text(), number)));
                        found.insert(text());
                    }
                    PieceKind::Name | PieceKind::Key => {
                        found.insert(text());
                    }
                    PieceKind::Number
                    | PieceKind::Sign
                    | PieceKind::Skip
                    | PieceKind::Kept
                    | PieceKind::Comment
                    | PieceKind::End => {}
                }
            }
        }
    }
    found
}

fn code(letter: &str, number: f64) -> String {
    format!("{letter}{}", (number * 10.0).round())
}

/// A row's code as [`words`] has it.
fn of_row(written: &str) -> String {
    let (letter, number) = written.split_at(1);
    number.parse().map_or_else(|_| written.to_uppercase(), |number| code(letter, number))
}

/// The dictionaries whose programs are blocks of words.
fn spelled() -> impl Iterator<Item = &'static Dialect> {
    builtins().filter(|d| matches!(d.family, Family::Word | Family::Sinumerik))
}

#[test]
fn every_row_with_a_meaning_is_met_in_the_corpus() {
    let mut failures = Failures::default();
    for dialect in spelled().filter(|dialect| corpus::DIALECTS.contains(&dialect.id.as_str())) {
        let own = words(dialect);
        let base = dialect.base.as_deref().and_then(|id| builtins().find(|d| d.id == id));
        let theirs = base.map(words).unwrap_or_default();
        let mut missing = Vec::new();
        let mut look = |written: &str, same: bool| {
            let word = of_row(written);
            if !(own.contains(&word) || same && theirs.contains(&word)) {
                missing.push(written.to_owned());
            }
        };
        // Of a list of further work offsets, one stands for all.
        let far = |row: &CodeRow| matches!(row.means, Some(Meaning::SetOriginOffsets(7..)));
        let met = |row: &CodeRow| own.contains(&of_row(&row.code));
        let listed: BTreeSet<&str> =
            dialect.code.iter().filter(|row| far(row) && met(row)).map(|row| &*row.source).collect();
        for row in dialect.code.iter().filter(|row| row.means.is_some()) {
            if far(row) && listed.contains(&*row.source) {
                continue;
            }
            let same = |other: &CodeRow| other.code == row.code && other.means == row.means;
            look(&row.code, base.is_some_and(|base| base.code.iter().any(same)));
        }
        for row in &dialect.cycle {
            look(&row.code, base.is_some_and(|base| base.cycle.iter().any(|other| other.code == row.code)));
        }
        for row in &dialect.pattern {
            look(
                row.code(),
                base.is_some_and(|base| base.pattern.iter().any(|other| other.code() == row.code())),
            );
        }
        for row in dialect.name.iter().filter(|row| row.refuse.is_none()) {
            look(&row.name, false);
        }
        for row in &dialect.call {
            look(&row.name, false);
        }
        // A parameter is a word of the codes that name it, and says nothing by itself.
        let says = |row: &&Address| row.refuse.is_none() && row.role != Role::Parameter;
        for row in dialect.address.iter().filter(says) {
            let letter = row.letter.to_string();
            look(&letter, base.is_some_and(|base| base.address.iter().any(|o| o.letter == row.letter)));
        }
        if !missing.is_empty() {
            failures.add(&dialect.id, missing.join(" "));
        }
    }
    failures.finish();
}

/// A word of several letters as it stands in a block.
fn in_its_form(name: &str, valued: bool) -> String {
    match name {
        "DC" | "ACP" | "ACN" | "CAC" | "CIC" | "CDC" | "CACP" | "CACN" => format!("C={name}(1)"),
        "EXTCALL" => format!("{name} R1"),
        "ISOCALL" => format!("{name} \"A\""),
        "CALL" | "PCALL" => format!("{name} A"),
        // `A3` alone would be the axis A at 3.
        _ if valued || name.ends_with(|c: char| c.is_ascii_digit()) => format!("{name}=1"),
        _ => name.to_owned(),
    }
}

/// What is refused is refused by the name that its row gives it, in a block of a program that is right
/// without it.
#[test]
fn every_refused_row_is_refused_by_its_name() {
    let mut failures = Failures::default();
    let mut looked = 0;
    for dialect in spelled() {
        let codes = dialect.code.iter().filter_map(|row| Some((row.code.clone(), row.refuse.as_deref()?)));
        let names = dialect
            .name
            .iter()
            .filter_map(|row| Some((in_its_form(&row.name, row.role.is_some()), row.refuse.as_deref()?)));
        for (word, name) in codes.chain(names) {
            looked += 1;
            let (before, after) = match dialect.family {
                Family::Word if dialect.program.frame.is_empty() => ("G90\n", "\nM30\n"),
                Family::Word => ("%\nO0001\nG90\n", "\nM30\n%\n"),
                Family::Sinumerik | Family::Canon | Family::Ir => ("G90\n", "\nM30\n"),
            };
            let text = format!("{before}{word}{after}");
            let found = translate::faults(&dialect.id, text.as_bytes());
            let by_name = found.iter().any(|fault| {
                matches!(fault, Fault::NotSupported { what, .. } if what.is_named(name))
                    || matches!(fault, Fault::MacroLanguage { .. })
            });
            if !by_name {
                failures.add(format!("{} {word}", dialect.id), format!("{name:?} is told as {found:?}"));
            }
        }
    }
    println!("{looked} rows");
    failures.finish();
}
