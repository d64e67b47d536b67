//! Machine profiles: what is wrong with one, as the user sees it (`tests/machines/<name>.toml` beside
//! `<name>.stderr`), and what a profile does to a translation.

use std::collections::BTreeSet;
use std::sync::Arc;

use codespan_reporting::term::termcolor::Buffer;
use ncc_dialects::builtin;
use ncc_driver::machines::pair::Machines;
use ncc_ir::diag::{Gravity, Verdict};
use ncc_machines::{Profile, Wrong};
use ncc_tests::corpus;
use ncc_tests::expect::{self, Failures};
use ncc_tests::translate::{job, stopping, translate};

#[test]
fn wrong_profiles_and_their_diagnostics() {
    let mut failures = Failures::default();
    let mut codes = BTreeSet::new();
    for path in corpus::files(&corpus::root().join("tests/machines")) {
        if path.extension().is_none_or(|e| e != "toml") {
            continue;
        }
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let text = std::fs::read_to_string(&path).expect("a profile");
        let wrong = match Profile::parse(&text, &builtin) {
            Ok(_) => Vec::new(),
            Err(wrong) => wrong,
        };
        if wrong.is_empty() {
            failures.add(&name, "nothing is wrong with it");
        }
        codes.extend(wrong.iter().map(|error| error.wrong.code()));
        let mut told = Buffer::no_color();
        ncc::machines::print(&name, &text, &wrong, &mut told).expect("a text in memory");
        failures.check(&name, expect::file(&path.with_extension("stderr"), told.as_slice()));
    }
    for code in Wrong::CODES {
        if !codes.contains(code) {
            failures.add(format!("NC{code:04}"), "no profile has it");
        }
    }
    failures.finish();
}

fn profile(dialect: &str, rest: &str) -> Arc<Profile> {
    let text = format!("id = \"shop\"\ntitle = \"\"\ndialect = \"{dialect}\"\n{rest}");
    Arc::new(Profile::parse(&text, &builtin).unwrap_or_else(|wrong| panic!("{wrong:?}\n{text}")))
}

/// Translates with profiles; gives the text and the codes that stop it.
fn with(from: &Arc<Profile>, to: &Arc<Profile>, text: &str) -> (String, BTreeSet<u16>, usize) {
    let mut job = job(&from.dialect.id, &to.dialect.id, "part");
    job.machines = Machines { from: Some(from.clone()), to: Some(to.clone()) };
    (job.from, job.to) = (from.settings(), to.settings());
    job.layout.numbering = ncc_backends::Numbering::Off;
    job.head = false;
    let (outcome, written) = translate(&job, text.as_bytes());
    let assumed = |d: &&ncc_ir::diag::Diagnostic| d.fault.gravity() == Gravity::Verdict(Verdict::Assumed);
    let assumed = outcome.diagnostics.iter().filter(assumed).count();
    // Latin-1, which all that is asked for here is.
    let written = written.iter().map(|b| char::from(*b)).collect();
    (written, stopping(&job, &outcome), assumed)
}

const PART: &str =
    "G71\nG90\nG17\nT1M6\nO1S500M3\nG0X0.Y0.\nZ5.\n;FURO\nG1Z-1.F100\nX10.125\nG0Z50.\nM5\nM2\n";

const KNOWN: &str = "[options]\no_word = \"offset\"\n[power_on]\nwork_offset = 1\nlength_offset = 0\nno_origin_shift = true\n[confirmed]\nlength-offset-with-next-z = true\n";

#[test]
fn what_a_profile_states_is_no_assumption() {
    let (bare, fanuc) = (profile("mach9", ""), profile("fanuc", ""));
    let (_, stops, assumed) = with(&bare, &fanuc, PART);
    assert!(stops.is_empty() && assumed >= 4, "{stops:?}, {assumed} assumptions");
    let (text, stops, assumed) = with(&profile("mach9", KNOWN), &fanuc, PART);
    assert!(stops.is_empty(), "{stops:?}");
    assert_eq!(assumed, 0, "{text}");
}

#[test]
fn what_a_profile_denies_stops() {
    let denied = KNOWN.replace("next-z = true", "next-z = false");
    let (_, stops, _) = with(&profile("mach9", &denied), &profile("fanuc", ""), PART);
    assert_eq!(stops, BTreeSet::from([505]));
}

#[test]
fn a_fact_at_power_on_counts_in_the_worlds() {
    // The source is silent about its work offset; the profile says which it is.
    let known = KNOWN.replace("work_offset = 1", "work_offset = 3");
    let (text, stops, _) = with(&profile("mach9", &known), &profile("fanuc", ""), PART);
    assert!(stops.is_empty() && text.contains("G56"), "{stops:?}\n{text}");
    // A silent source of inches is written as inches.
    let silent = PART.replace("G71\n", "");
    let known = KNOWN.replace("[power_on]\n", "[power_on]\nunits = \"inch\"\n");
    let (text, stops, assumed) = with(&profile("mach9", &known), &profile("fanuc", ""), &silent);
    assert!(stops.is_empty() && text.contains("G20") && assumed == 0, "{stops:?}, {assumed}\n{text}");
}

#[test]
fn the_shop_writes_as_it_wants() {
    let from = profile("mach9", KNOWN);
    let lines = |emit: &str| with(&from, &profile("fanuc", &format!("[emit]\n{emit}")), PART);
    let (text, ..) = lines("blanks = false\n");
    assert!(text.contains("G01Z-1.F100."), "{text}");
    let (text, stops, _) = lines("decimals = 2\n");
    assert!(text.contains("X10.13\n") && stops.is_empty(), "{text}{stops:?}");
    let (text, ..) = lines("tool_change = \"two-blocks\"\nheader = [\"größe 3\"]\nfooter = [\"ende\"]\n");
    assert!(text.contains("T1\nM06\n"), "{text}");
    assert!(text.contains("(GROESSE 3)\n") && text.contains("(ENDE)\nM30\n"), "{text}");
    let own = |emit: &str| {
        let mut part = PART.replace("T1M6", "T1\nM6");
        part = part.replace("FURO", "FURAÇÃO — é");
        with(&from, &profile("mach9", &format!("{KNOWN}[emit]\n{emit}")), &part).0
    };
    let text = own("characters = \"latin1\"\n");
    assert!(text.contains(";FURAÇÃO - é\n"), "{text}");
    let text = own("characters = \"ascii\"\ntool_change = \"one-block\"\nblanks = true\n");
    assert!(text.contains(";FURACAO - e\n") && text.contains("\nT1 M6\n"), "{text}");
    let text = own("characters = \"capitals\"\n");
    assert!(text.contains(";FURACAO - E\n"), "{text}");
}

#[test]
fn an_unknown_m_code_is_carried_only_through_both_maps() {
    let codes = |dialect: &str, code: &str| {
        let known = if dialect == "mach9" { KNOWN } else { "" };
        let row = |code: &str, name: &str| format!("[[m_code]]\ncode = {code:?}\nfunction = {name:?}\n");
        profile(dialect, &format!("{known}{}{}", row("M95", "air-on"), row(code, "conveyor-on")))
    };
    let part = PART.replace("G0X0.", "M21\nG0X0.");
    let (text, stops, _) = with(&codes("mach9", "M21"), &codes("fanuc", "M70"), &part);
    assert!(stops.is_empty() && text.contains("\nM70\n"), "{stops:?}\n{text}");
    let (text, stops, _) = with(&codes("mach9", "M21"), &codes("siemens", "M21"), &part);
    assert!(stops.is_empty() && text.contains("\nM21\n"), "{stops:?}\n{text}");
    let stops = with(&profile("mach9", KNOWN), &codes("fanuc", "M70"), &part).1;
    assert_eq!(stops, BTreeSet::from([201]), "not named by the source's machine");
    let stops = with(&codes("mach9", "M21"), &profile("fanuc", ""), &part).1;
    assert_eq!(stops, BTreeSet::from([501]), "not named by the target's machine");
    // Beside a move it would be the machine's matter when it happens.
    let stops = with(&codes("mach9", "M21"), &codes("fanuc", "M70"), &PART.replace("G0X0.", "M21G0X0.")).1;
    assert_eq!(stops, BTreeSet::from([202]));
    // In every dialect that has statements of its own for it, and back.
    for middle in ["ir", "canon"] {
        let there = with(&codes("mach9", "M21"), &profile(middle, ""), &part).0;
        assert!(there.contains("MACHINE_FUNCTION(\"conveyor-on\")"), "{there}");
        let (text, stops, _) = with(&profile(middle, ""), &codes("fanuc", "M70"), &there);
        assert!(stops.is_empty() && text.contains("\nM70\n"), "{stops:?}\n{text}");
    }
}

/// Rows of tools: number, name, length entry if it is another.
fn tools(rows: &[(u32, &str, Option<u32>)]) -> String {
    let row = |(number, name, entry): &(u32, &str, Option<u32>)| {
        let entry = entry.map_or(String::new(), |entry| format!("length_entry = {entry}\n"));
        format!("[[tool]]\nnumber = {number}\nname = {name:?}\n{entry}")
    };
    rows.iter().map(row).collect()
}

/// Rows of work offsets or programs.
fn rows(table: &str, rows: &[(u32, &str)]) -> String {
    rows.iter().map(|(number, name)| format!("[[{table}]]\nnumber = {number}\nname = {name:?}\n")).collect()
}

const FANUC: &str = "%\nO1\nG21 G17 G90 G40 G49 G80 G94\nG54\nT3 M06\nS500 M03\nG00 X0. Y0.\nG43 H23 Z5.\nG01 Z-1. F100.\nG49\nT4 M06\nS500 M03\nG00 G43 H4 Z5.\nG55\nX1. Y2. Z3.\nT0 M06\nM30\n%\n";

const SIEMENS: &str = "G71 G17 G90 G40 G94\nG54\nT3 M6\nD1\nS500 M3\nG0 X0 Y0\nZ5\nG1 Z-1 F100\nT4 M6\nD1\nG0 Z5\nG55\nG0 X1 Y2 Z3\nM30\n";

/// Tools 3 and 4, work offsets 1 and 2 of a source.
fn ours(dialect: &str, entry: Option<u32>) -> Arc<Profile> {
    let offsets = rows("work_offset", &[(1, "vice"), (2, "plate")]);
    profile(dialect, &(tools(&[(3, "drill-8", entry), (4, "mill-10", None)]) + &offsets))
}

/// The same, in other places.
fn theirs(dialect: &str, entry: Option<u32>) -> Arc<Profile> {
    let offsets = rows("work_offset", &[(3, "vice"), (1, "plate")]);
    profile(dialect, &(tools(&[(7, "drill-8", entry), (3, "mill-10", None)]) + &offsets))
}

#[test]
fn tools_lengths_and_work_offsets_go_by_name() {
    let has = |(text, stops, _): (String, BTreeSet<u16>, usize), words: &[&str], not: &[&str]| {
        assert!(stops.is_empty(), "{stops:?}");
        let mut at = 0;
        for word in words {
            at += text[at..].find(word).unwrap_or_else(|| panic!("{word} in order:\n{text}")) + word.len();
        }
        for word in not {
            assert!(!text.contains(word), "{word}:\n{text}");
        }
    };
    let (fanuc, siemens) = (ours("fanuc", Some(23)), ours("siemens", None));
    let words = ["G56", "T7", "H27", "T3", "H3", "G54", "T0"];
    has(with(&fanuc, &theirs("fanuc", Some(27)), FANUC), &words, &["H23", "H7", "G55", "T4"]);
    has(with(&fanuc, &theirs("haas", Some(27)), FANUC), &words, &["H23", "H7", "G55", "T4"]);
    let words = ["G56", "T7", "T3", "G54", "T0"];
    let part = FANUC;
    has(with(&fanuc, &theirs("siemens", None), part), &words, &["G55", "T4"]);
    let words = ["G56", "T7", "H27", "T3", "H3", "G54"];
    has(with(&siemens, &theirs("fanuc", Some(27)), SIEMENS), &words, &["H7", "G55", "T4"]);
    has(with(&siemens, &theirs("siemens", None), SIEMENS), &["G56", "T7", "T3", "G54"], &["G55", "T4"]);
    // Both text forms, there and back: they have names of their own, or none.
    for middle in ["ir", "canon"] {
        let (there, stops, _) = with(&fanuc, &theirs(middle, Some(27)), FANUC);
        assert!(stops.is_empty() && there.contains("SELECT_TOOL(7"), "{stops:?}\n{there}");
        let back = with(&theirs(middle, Some(27)), &fanuc, &there);
        has(back, &["G54", "T3", "H23", "T4", "H4", "G55", "T0"], &["G56", "T7"]);
        let (there, stops, _) = with(&fanuc, &profile(middle, ""), FANUC);
        assert!(stops.is_empty() && there.contains("SELECT_TOOL(3"), "{stops:?}\n{there}");
    }
}

#[test]
fn the_only_work_offset_of_a_control_goes_by_name_too() {
    let names = |rows_: &[(u32, &str)]| rows("work_offset", rows_);
    let known = |rest: &str| format!("{KNOWN}{}{rest}", tools(&[(1, "drill-8", None)]));
    let mach9 = profile("mach9", &known(&names(&[(1, "vice")])));
    let to = tools(&[(5, "drill-8", Some(25))]) + &names(&[(1, "plate"), (4, "vice")]);
    let (text, stops, _) = with(&mach9, &profile("fanuc", &to), PART);
    assert!(stops.is_empty(), "{stops:?}");
    assert!(text.contains("G57") && text.contains("T5") && text.contains("H25"), "{text}");
    assert!(!text.contains("G54") && !text.contains("T1") && !text.contains("H1"), "{text}");
    // Back again: its only work offset is what it is called.
    let from = profile("fanuc", &to);
    let (back, stops, _) = with(&from, &mach9, &text);
    assert!(stops.is_empty() && back.contains("T1") && back.contains("O1"), "{stops:?}\n{back}");
    // A zero that the target has no name for is refused, though the program never says it.
    let to = profile("fanuc", &(tools(&[(5, "drill-8", None)]) + &names(&[(1, "plate")])));
    assert_eq!(with(&mach9, &to, PART).1, BTreeSet::from([506]));
    // A fact at power-on is of the target's own numbers.
    let to = tools(&[(5, "drill-8", None)]) + &names(&[(4, "vice"), (1, "plate")]);
    let to = profile("fanuc", &format!("[power_on]\nwork_offset = 1\n{to}"));
    let (text, stops, _) = with(&mach9, &to, PART);
    assert!(stops.is_empty() && text.contains("G57"), "{stops:?}\n{text}");
}

#[test]
fn what_is_not_in_the_map_is_refused_at_its_place() {
    let refused = |from: &Arc<Profile>, to: &Arc<Profile>, text: &str| {
        let mut job = job(&from.dialect.id, &to.dialect.id, "part");
        job.machines = Machines { from: Some(from.clone()), to: Some(to.clone()) };
        (job.from, job.to) = (from.settings(), to.settings());
        let (outcome, written) = translate(&job, text.as_bytes());
        assert!(outcome.release.is_err() && written.is_empty());
        let errors = outcome.diagnostics.iter().filter(|d| d.fault.gravity() == Gravity::Error);
        let at = |d: &ncc_ir::diag::Diagnostic| {
            let line = text[..d.span.start as usize].matches('\n').count() + 1;
            (d.fault.code(), line)
        };
        errors.map(at).collect::<Vec<_>>()
    };
    let (from, to) = (ours("fanuc", Some(23)), theirs("fanuc", None));
    // The tool, and its entry with it; an entry of nobody; a work offset.
    assert_eq!(refused(&from, &to, &FANUC.replace("T4", "T5").replace("H4", "H5")), [(506, 11)]);
    assert_eq!(refused(&from, &to, &FANUC.replace("H4", "H44")), [(506, 13)]);
    assert_eq!(refused(&from, &to, &FANUC.replace("H23", "H3")), [(506, 8)]);
    assert_eq!(refused(&from, &to, &FANUC.replace("G55", "G56")), [(506, 14)]);
    // Named by the source's machine alone.
    let more =
        format!("{}{}", tools(&[(3, "drill-8", Some(23)), (4, "tap", None)]), rows("work_offset", &[]));
    assert_eq!(refused(&profile("fanuc", &more), &to, FANUC), [(506, 11)]);
    // In a program that is kept whole, in its subprograms too.
    let whole = FANUC.replace("T0 M06\nM30\n", "M98 P20\nM30\nO20\nT6 M06\nM99\n");
    assert_eq!(refused(&from, &to, &whole), [(506, 19)]);
    // Between a table and edges.
    assert_eq!(refused(&ours("siemens", None), &to, &SIEMENS.replace("T4", "T9")), [(506, 9)]);
    // What one of them does not name at all stays as it is.
    let only = profile("fanuc", &tools(&[(7, "drill-8", None), (3, "mill-10", None)]));
    let (text, stops, _) = with(&ours("fanuc", Some(23)), &only, FANUC);
    assert!(stops.is_empty() && text.contains("G55") && text.contains("T7"), "{stops:?}\n{text}");
    let (text, stops, _) = with(&ours("fanuc", Some(23)), &profile("fanuc", ""), FANUC);
    assert!(stops.is_empty() && text.contains("T4") && text.contains("H23"), "{stops:?}\n{text}");
}

#[test]
fn an_entry_of_another_number_is_not_taken_for_the_tool_s() {
    // No names: edge 1 is the entry of the tool's number, unless a profile says otherwise.
    let entry = profile("fanuc", "[[tool]]\nnumber = 3\nlength_entry = 23\n");
    let part = FANUC.replace("H23", "H3").replace("T0 M06\n", "");
    assert_eq!(with(&entry, &profile("siemens", ""), &part).1, BTreeSet::from([505]));
    assert_eq!(with(&profile("siemens", ""), &entry, SIEMENS).1, BTreeSet::from([505]));
}

const CALLS: &str = "%\nO1\nG21 G17 G90 G40 G49 G80 G94\nG54\nG00 X0. Y0. Z5.\nM98 P1001\nM98 P1002\nM30\nO1001\nG21 G90 G00 X1.\nM99\nO1002\nG21 G90 G00 X2.\nM98 P1001\nM99\n%\n";

#[test]
fn programs_have_names_and_numbers() {
    let pair = [(1001, "Pocket"), (1002, "slot_2"), (1, "PART_7")];
    let named = rows("program", &pair);
    let (there, stops, _) = with(&profile("fanuc", &named), &profile("siemens", ""), CALLS);
    assert!(stops.is_empty(), "{stops:?}\n{there}");
    assert!(there.contains("%_N_POCKET_SPF") && there.contains("%_N_SLOT_2_SPF"), "{there}");
    assert!(there.contains("%_N_PART_7_MPF") && !there.contains("L1001"), "{there}");
    // The target's profile alone says it as well.
    let (same, ..) = with(&profile("fanuc", ""), &profile("siemens", &named), CALLS);
    assert_eq!(there, same);
    // And back: by the rows of the machine with numbers. (Names in the text form are those of the rows.)
    let ir = profile("ir", "");
    let (there, stops, _) = with(&profile("fanuc", &named), &ir, CALLS);
    assert!(stops.is_empty() && there.contains("CALL(\"SLOT_2\")"), "{stops:?}\n{there}");
    let to = rows("program", &[(2001, "POCKET"), (2002, "SLOT_2"), (2, "PART_7")]);
    let (back, stops, _) = with(&ir, &profile("fanuc", &to), &there);
    assert!(stops.is_empty(), "{stops:?}\n{back}");
    assert!(
        back.contains("O2001 (POCKET)") && back.contains("O2002") && back.contains("M98 P2001"),
        "{back}"
    );
    assert!(back.contains("O0002"), "{back}");
    // Without a row a number is made, but none that is another program's.
    let (made, stops, _) = with(&ir, &profile("fanuc", &rows("program", &pair[1..2])), &there);
    assert!(
        stops.is_empty() && made.contains("M98 P1002") && made.contains("M98 P1001"),
        "{stops:?}\n{made}"
    );
    let other = rows("program", &[(1001, "OTHER"), (1002, "SLOT_2")]);
    let (made, stops, _) = with(&ir, &profile("fanuc", &other), &there);
    assert!(stops.is_empty() && !made.contains("P1001") && made.contains("P1003"), "{stops:?}\n{made}");
    // The same from a control with names, whose subprograms are written out.
    let (there, ..) = with(&profile("fanuc", &named), &profile("siemens", ""), CALLS);
    let (back, stops, _) = with(&profile("siemens", ""), &profile("fanuc", &to), &there);
    assert!(stops.is_empty() && back.contains("O0002"), "{stops:?}\n{back}");
    // From number to number by way of the name; a number without one is refused.
    let (text, stops, _) = with(&profile("fanuc", &named), &profile("haas", &to), CALLS);
    assert!(stops.is_empty(), "{stops:?}\n{text}");
    assert!(text.contains("M98 P2001") && text.contains("M98 P2002") && !text.contains("1001"), "{text}");
    let some = profile("fanuc", &rows("program", &pair[..1]));
    assert_eq!(with(&some, &profile("haas", &to), CALLS).1, BTreeSet::from([506]));
    assert_eq!(
        with(&profile("fanuc", &named), &profile("haas", &rows("program", &[(9, "POCKET")])), CALLS).1,
        BTreeSet::from([506])
    );
    // Two programs of one number: a number that stays, and one that is put in.
    let clash = profile("haas", &rows("program", &[(1002, "POCKET")]));
    let two = there_with_both(&ir, &named);
    assert_eq!(with(&ir, &clash, &two).1, BTreeSet::from([219]));
    // The program's own number counts as well.
    let own = profile("haas", &rows("program", &[(1002, "PART_7")]));
    let text = CALLS.replace("P1001", "P1003").replace("O1001", "O1003");
    let from = profile("fanuc", &rows("program", &[(1, "PART_7"), (1002, "X1"), (1003, "X2")]));
    let all = rows("program", &[(7, "PART_7"), (8, "X1"), (7777, "X2")]);
    let (text_, stops, _) = with(&from, &profile("haas", &all), &text);
    assert!(stops.is_empty() && text_.contains("O00007") && text_.contains("P7777"), "{stops:?}\n{text_}");
    let (_, stops, _) = with(&profile("fanuc", ""), &own, &text);
    assert!(stops.is_empty(), "{stops:?}");
}

/// A program in the text form with a subprogram by name and one by number.
fn there_with_both(ir: &Arc<Profile>, named: &str) -> String {
    let row = named.split("[[program]]").find(|row| row.contains("Pocket")).unwrap_or_default();
    with(&profile("fanuc", &format!("[[program]]{row}")), ir, CALLS).0
}
