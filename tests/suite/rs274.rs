//! LinuxCNC's own test programs beside the repository: the calls that its stand-alone interpreter prints
//! for them are printed by ours, and what it refuses is refused. All of them are listed; says "skipped: …"
//! where they are absent.
//!
//! What is not translated must be refused by name: a program that begins to come out equal has to be moved
//! to those that must.

use std::fs;
use std::path::Path;

use ncc_backends::canon::rs274;
use ncc_exec::world::Tables;
use ncc_frontends::{Batch, Reader};
use ncc_ir::diag::Gravity;
use ncc_ir::expr::num::Nanos;
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
    /// The same, but for numbers that lie half-way between two of its digits: it adds up binary numbers that are a
    /// little off them.
    EqualToADigit,
    /// What it shows is the same; nothing else of it is listed.
    Messages,
    /// The interpreter refuses it, and so do we, with this in what is told.
    Refused(&'static str),
    /// It is for a lathe, or taps in another plane than XY, which the interpreter does at places of other
    /// axes; or it says what is not translated: refused by name, with this in what is told.
    RefusedByName(&'static str),
}

/// All of the programs.
const PROGRAMS: [(&str, Must); 51] = [
    ("ccomp-lathe-comp", Must::RefusedByName("Lengths(NotInTable)")),
    ("ccomp-mill-line-arc-entry", Must::Equal),
    ("interp-bad--a-in-canned-cycle", Must::Refused("Cycle(RotaryAxis)")),
    ("interp-bad--bad-arc.big.imperial.center-format", Must::Refused("ArcEndOffCircle")),
    ("interp-bad--bad-arc.medium.imperial.center-format", Must::Refused("ArcEndOffCircle")),
    ("interp-bad--bad-arc.small.imperial.center-format", Must::Refused("ArcEndOffCircle")),
    ("interp-bad--ccomp-arcexit", Must::Refused("ArcLeadOut")),
    ("interp-bad--exists-1", Must::Refused("Syntax")),
    ("interp-bad--exists-3", Must::Refused("EXISTS[###2]")),
    ("interp-bad--exists-5", Must::Refused("UnexpectedCharacter")),
    ("interp-bad--exists-7", Must::Refused("Syntax")),
    ("interp-bad--nested", Must::Refused("Flow(SubInSub)")),
    ("interp-bad--no-ijr", Must::Refused("ArcWithoutCentre")),
    ("interp-cam-nisley", Must::EqualToADigit),
    ("interp-do-while-break", Must::Equal),
    ("interp-flowsnake", Must::Equal),
    ("interp-g10-g10-l1-l10", Must::Equal),
    ("interp-g10-g10-l2-while-active", Must::Equal),
    ("interp-g10-g10-with-g92", Must::Equal),
    ("interp-g52-g52-g92-interaction", Must::Equal),
    ("interp-g6164", Must::Equal),
    ("interp-g71-with-g70", Must::RefusedByName("lathe")),
    ("interp-g76", Must::RefusedByName("lathe")),
    ("interp-g81-g17-g99", Must::Equal),
    ("interp-g81-g18-g99", Must::Equal),
    ("interp-g81-g19-g99", Must::Equal),
    ("interp-g84-g17-g99", Must::Equal),
    // The manual's G84 feeds along the normal of the plane, whichever it is; from R 3 over (1, 2) of X and Z this
    // interpreter feeds to X0.5 Y2 Z1, its coordinates in the order of the plane's axes, and G81 and G85 do not. So a
    // machine under it goes where the program does not say, and such a tap is refused, read and written.
    ("interp-g84-g18-g99", Must::RefusedByName("Cycle(OtherAxis)")),
    ("interp-g84-g19-g99", Must::RefusedByName("Cycle(OtherAxis)")),
    ("interp-good--good-arc.big.metric.center-format", Must::Equal),
    ("interp-good--good-arc.medium.metric.center-format", Must::Equal),
    ("interp-good--good-arc.small.metric.center-format", Must::Equal),
    // Feeds by the time of moves that are other ones beside a contour.
    (
        "interp-inverse-time-with-comp",
        Must::RefusedByName("Expanded { what: Function { function: \"SET_FEED_MODE\" } }"),
    ),
    ("interp-m98m99-02-variables", Must::Equal),
    ("interp-m98m99-04-M98-but-no-sub", Must::Refused("CallUnknown")),
    (
        "interp-m98m99-06-error-mixed-sub-styles--O...-called-with-O..._call",
        Must::Refused("Call(KindOfNumbered"),
    ),
    (
        "interp-m98m99-06-error-mixed-sub-styles--O...-sub-called-with-M98",
        Must::Refused("Call(KindOfProgram"),
    ),
    ("interp-m98m99-07-nested-subs", Must::Equal),
    ("interp-m98m99-09-disable-fanuc-subs--04-test-fanuc", Must::Equal),
    // Two programs with the number 2: which of them a call means is the order of a text, and is not relied on.
    ("interp-m98m99-10-M98-P001", Must::Refused("ProgramTwice")),
    (
        "interp-m98m99-11-main-program-oword--test-illegal-no-m30-before-osub",
        Must::Refused("Flow(SubRunInto)"),
    ),
    ("interp-m98m99-11-main-program-oword--test-legal-end-main-with-m02", Must::Equal),
    ("interp-m98m99-11-main-program-oword--test-legal-end-main-with-m30", Must::Equal),
    ("interp-m98m99-13-named-program--test-named", Must::Equal),
    ("interp-m98m99-14-o-expression-call", Must::Equal),
    ("interp-namedparam-bug424", Must::Equal),
    ("interp-oword-bug315-p2", Must::Equal),
    ("interp-rotation-abs-pts", Must::Messages),
    ("interp-rotation-g53", Must::Equal),
    ("interp-unit-conversion", Must::Equal),
    ("oword-while.0", Must::Equal),
];

/// The calls of a program, or the codes of the messages by which it is refused.
fn printed(text: &[u8], tables: &Tables) -> Result<String, String> {
    let mut batch = Batch::default();
    // The stand-alone interpreter is a machine in inches.
    let mut chosen = settings("linuxcnc");
    chosen.choose("machine_units", "inch").expect("an option");
    let arcs = chosen.arc_rule();
    let mut reader = Reader::new(chosen, true);
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
    rs274::print(&program, text, tables, arcs).map_err(|d| format!("{:?}", d.fault))
}

/// The tools of a table: a line has their number behind a T, their offsets behind X, Y and Z, and their diameter behind
/// a D, in inches or none, as the stand-alone interpreter reads it.
fn tools(folder: &Path) -> Tables {
    let mut tables = Tables::default();
    let Ok(table) = fs::read_to_string(folder.join("test.tbl")) else { return tables };
    let word = |line: &str, letter: char| -> Option<f64> {
        line.split_whitespace().find_map(|word| word.strip_prefix(letter)?.trim_end_matches(';').parse().ok())
    };
    for line in table.lines().map(|line| line.split_once(';').map_or(line, |(row, _)| row)) {
        let Some(number) = word(line, 'T') else { continue };
        let number = number as u32;
        let nanos = |letter| (word(line, letter).unwrap_or(0.0) * 25.4 * 1e9).round() as Nanos;
        tables.radii.insert(number, nanos('D') / 2);
        // A lathe's tool, known by the side on which its tip lies, has offsets that a mill's has not.
        if word(line, 'Q').is_some() {
            continue;
        }
        tables.lengths.insert(number, nanos('Z'));
        tables.offsets.insert(number, [nanos('X'), nanos('Y')]);
    }
    tables
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

/// Whether two calls differ in no more than the last of their four digits.
fn same_to_a_digit(a: &str, b: &str) -> bool {
    let words = |line: &str| line.split([' ', ',', '(', ')']).map(str::to_owned).collect::<Vec<_>>();
    let (a, b) = (words(a), words(b));
    let same = |(a, b): (&String, &String)| match (a.parse::<f64>(), b.parse::<f64>()) {
        (Ok(x), Ok(y)) => (x - y).abs() < 0.000_100_1,
        _ => a == b,
    };
    a.len() == b.len() && a.iter().zip(&b).all(same)
}

#[test]
fn programs_of_the_interpreter_are_printed_as_it_does() {
    let Some(folder) = beside("cases/linuxcnc") else { return };
    let index = fs::read_to_string(folder.join("INDEX.tsv")).expect("the list of the programs");
    let mut failures = Failures::default();
    let mut all = 0;
    for row in index.lines().skip(1) {
        let mut fields = row.split('\t');
        let (Some(name), Some(input)) = (fields.next(), fields.next()) else { continue };
        all += 1;
        let Some((_, must)) = PROGRAMS.iter().find(|(listed, _)| *listed == name) else {
            failures.add(name, "is not listed".to_owned());
            continue;
        };
        let folder: &Path = &folder.join(name);
        let found = printed(&fs::read(folder.join(input)).expect("a program"), &tools(folder));
        let wrong = match (must, &found) {
            (Must::Equal, Ok(text)) => {
                let expected = fs::read_to_string(folder.join("expected.canon")).expect("its calls");
                let (expected, text) = (normalised(&expected), normalised(text));
                (expected != text).then(|| ncc_tests::expect::diff(expected.as_bytes(), text.as_bytes()))
            }
            (Must::EqualToADigit, Ok(text)) => {
                let expected = fs::read_to_string(folder.join("expected.canon")).expect("its calls");
                let (expected, text) = (normalised(&expected), normalised(text));
                let same = expected.lines().count() == text.lines().count()
                    && expected.lines().zip(text.lines()).all(|(a, b)| same_to_a_digit(a, b));
                (!same).then(|| ncc_tests::expect::diff(expected.as_bytes(), text.as_bytes()))
            }
            (Must::Messages, Ok(text)) => {
                let expected = fs::read_to_string(folder.join("expected.canon")).expect("its calls");
                let shown: Vec<&str> = text.lines().filter(|line| line.starts_with("MESSAGE")).collect();
                let (expected, text) = (normalised(&expected), normalised(&shown.join("\n")));
                (expected != text).then(|| ncc_tests::expect::diff(expected.as_bytes(), text.as_bytes()))
            }
            (Must::Equal | Must::EqualToADigit | Must::Messages, Err(why)) => Some(format!("refused: {why}")),
            (Must::RefusedByName(told), Err(why)) => {
                let named = why.contains("NotSupported") || why.contains("TargetLacks");
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
    assert_eq!(all, PROGRAMS.len());
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
        if let Err(why) = printed(&program.text, &Tables::default())
            && !why.starts_with("TargetLacks")
            && !why.starts_with("RadiusUnknown")
        {
            failures.add(&program.file, why);
        }
    }
    failures.finish();
}

/// The interpreter by itself keeps the length of the last tool change, whatever number M61 sets, and has none before the
/// first: its own print of this program with a table of these lengths.
#[test]
fn the_length_of_the_last_tool_change() {
    let lengths =
        [(7, 70), (8, 80), (9, 90)].map(|(tool, length)| (tool, length * ncc_ir::expr::num::ONE)).into();
    let offsets = [7, 8, 9].map(|tool| (tool, [0; 2])).into();
    let tables = Tables { lengths, offsets, ..Tables::default() };
    let text = "G21 G90 G17 G94\nM61 Q7\nG43\nG0 Z9\nT8 M6\nG43\nM61 Q9\nG43\nG0 Z8\nM2\n";
    let printed = printed(text.as_bytes(), &tables).expect("a listing");
    let offsets: Vec<&str> = printed.lines().filter(|line| line.starts_with("USE_TOOL_LENGTH")).collect();
    let offset = |z: &str| {
        format!("USE_TOOL_LENGTH_OFFSET(0.0000 0.0000 {z}, 0.0000 0.0000 0.0000, 0.0000 0.0000 0.0000)")
    };
    assert_eq!(offsets, [offset("0.0000"), offset("80.0000"), offset("80.0000")]);
}
