//! Machine profiles: what is wrong with one, as the user sees it (`tests/machines/<name>.toml` beside
//! `<name>.stderr`), and what a profile does to a translation.

use std::collections::BTreeSet;
use std::sync::Arc;

use codespan_reporting::term::termcolor::Buffer;
use ncc::machines::pair::Machines;
use ncc_dialects::builtin;
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
