//! LinuxCNC's own test programs beside the repository: the calls that its stand-alone interpreter prints
//! for them are printed by ours, and what it refuses is refused. All of them are listed; says "skipped: …"
//! where they are absent.
//!
//! What is not translated must be refused by name: a program that begins to come out equal has to be moved
//! to those that must.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use ncc_backends::canon::rs274;
use ncc_frontends::{Batch, Reader};
use ncc_ir::diag::Gravity;
use ncc_ir::num::Nanos;
use ncc_ir::program::{Procedure, Program};
use ncc_tests::corpus;
use ncc_tests::expect::Failures;
use ncc_tests::translate::settings;

use crate::shared::beside;

/// What must become of a program.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Must {
    /// Printed as the interpreter prints it.
    Equal,
    /// The interpreter refuses it, and so do we, with this in what is told.
    Refused(&'static str),
    /// It is for a lathe, or taps in another plane than XY, which the interpreter does at places of other
    /// axes; or it says what is not translated: refused by name, with this in what is told.
    RefusedByName(&'static str),
}

/// The programs without variables, expressions and O words of the control's own flow.
const PLAIN: [(&str, Must); 19] = [
    ("ccomp-lathe-comp", Must::RefusedByName("")),
    ("ccomp-mill-line-arc-entry", Must::Equal),
    ("interp-bad--a-in-canned-cycle", Must::Refused("rotary axis in a canned cycle")),
    ("interp-bad--ccomp-arcexit", Must::Refused("an arc that leaves")),
    ("interp-bad--no-ijr", Must::Refused("ArcWithoutCentre")),
    ("interp-g10-g10-l1-l10", Must::RefusedByName("(DEBUG,")),
    ("interp-g10-g10-with-g92", Must::RefusedByName("(DEBUG,")),
    ("interp-g52-g52-g92-interaction", Must::RefusedByName("(PRINT,")),
    ("interp-g6164", Must::Equal),
    ("interp-g76", Must::RefusedByName("")),
    ("interp-g81-g17-g99", Must::Equal),
    ("interp-g81-g18-g99", Must::Equal),
    ("interp-g81-g19-g99", Must::Equal),
    ("interp-g84-g17-g99", Must::Equal),
    ("interp-g84-g18-g99", Must::RefusedByName("")),
    ("interp-g84-g19-g99", Must::RefusedByName("")),
    ("interp-m98m99-04-M98-but-no-sub", Must::Refused("CallUnknown")),
    ("interp-rotation-g53", Must::Equal),
    ("interp-unit-conversion", Must::RefusedByName("(DEBUG,")),
];

/// The calls of a program, or the codes of the messages by which it is refused.
fn printed(text: &[u8], radii: &BTreeMap<u32, Nanos>) -> Result<String, String> {
    let mut batch = Batch::default();
    let mut reader = Reader::new(settings("linuxcnc"), true);
    reader.read(text, 0, &mut batch);
    reader.finish(&mut batch);
    let errors = batch.diagnostics.iter().filter(|d| d.fault.gravity() == Gravity::Error);
    let errors: Vec<String> = errors.map(|d| format!("{:?}", d.fault)).collect();
    if !errors.is_empty() {
        return Err(errors.join("; "));
    }
    let main = Procedure { body: std::mem::take(&mut batch.stmts), ..Procedure::default() };
    let procedures = [main].into_iter().chain(std::mem::take(&mut batch.procedures)).collect();
    let program = Program { name: batch.name.clone(), assumed: batch.assumed, procedures };
    rs274::print(&program, text, radii).map_err(|d| format!("{:?}", d.fault))
}

/// Radii of the tools of a table: a line has their number behind a T, and their diameter behind a D in
/// inches, as the stand-alone interpreter reads it.
fn radii(folder: &Path) -> BTreeMap<u32, Nanos> {
    let Ok(table) = fs::read_to_string(folder.join("test.tbl")) else { return BTreeMap::new() };
    let word = |line: &str, letter: char| -> Option<f64> {
        line.split_whitespace().find_map(|word| word.strip_prefix(letter)?.trim_end_matches(';').parse().ok())
    };
    let row = |line: &str| {
        let (number, inches) = (word(line, 'T')?, word(line, 'D')?);
        Some((number as u32, (inches / 2.0 * 25.4 * 1e9).round() as Nanos))
    };
    table.lines().map(|line| line.split_once(';').map_or(line, |(row, _)| row)).filter_map(row).collect()
}

/// As the folder of the programs says that texts are to be compared.
fn normalised(text: &str) -> String {
    let mut all = String::new();
    for line in text.lines().filter(|l| !l.starts_with("START_CHANGE")) {
        let line = if line.starts_with("CHANGE_TOOL(") { "CHANGE_TOOL()" } else { line };
        let line = line.split_whitespace().collect::<Vec<_>>().join(" ").replace("-0.0000", "0.0000");
        all.push_str(&line);
        all.push('\n');
    }
    all
}

#[test]
fn programs_of_the_interpreter_are_printed_as_it_does() {
    let Some(folder) = beside("cases/linuxcnc") else { return };
    let index = fs::read_to_string(folder.join("INDEX.tsv")).expect("the list of the programs");
    let mut failures = Failures::default();
    let (mut all, mut plain) = (0, 0);
    for row in index.lines().skip(1) {
        let mut fields = row.split('\t');
        let (Some(name), Some(input)) = (fields.next(), fields.next()) else { continue };
        all += 1;
        let Some((_, must)) = PLAIN.iter().find(|(plain, _)| *plain == name) else {
            println!("  {name}: needs variables, expressions or O words");
            continue;
        };
        plain += 1;
        let folder: &Path = &folder.join(name);
        let found = printed(&fs::read(folder.join(input)).expect("a program"), &radii(folder));
        let wrong = match (must, &found) {
            (Must::Equal, Ok(text)) => {
                let expected = fs::read_to_string(folder.join("expected.canon")).expect("its calls");
                let (expected, text) = (normalised(&expected), normalised(text));
                (expected != text).then(|| ncc_tests::expect::diff(expected.as_bytes(), text.as_bytes()))
            }
            (Must::Equal, Err(why)) => Some(format!("refused: {why}")),
            (Must::RefusedByName(told), Err(why)) => {
                let named = why.contains("NotSupported") || why.contains("CannotSay");
                (!named || !why.contains(told)).then(|| why.clone())
            }
            (Must::Refused(told), Err(why)) => (!why.contains(told)).then(|| why.clone()),
            (_, Ok(text)) => Some(format!("is not refused:\n{text}")),
        };
        match wrong {
            Some(wrong) => failures.add(name, wrong),
            None => println!("  {name}: {must:?}"),
        }
    }
    println!("{plain} of {all} programs without variables, expressions and O words");
    assert_eq!((all, plain), (51, PLAIN.len()));
    failures.finish();
}

/// The corpus is read without an error, and printed or refused for what has no call there.
#[test]
fn the_corpus_is_printed() {
    let mut failures = Failures::default();
    let programs = corpus::of("linuxcnc");
    assert!(programs.len() >= 25, "{} programs", programs.len());
    for program in programs {
        // No tool of the corpus is in a table.
        if let Err(why) = printed(&program.text, &BTreeMap::new())
            && !why.starts_with("CannotSay")
            && !why.starts_with("RadiusUnknown")
        {
            failures.add(&program.file, why);
        }
    }
    failures.finish();
}
