//! `ncc fmt`: cases, and its laws: laid out once is laid out for good, and what is laid out makes the same
//! events, by an execution of its own here. Over the corpus, foreign programs and random ones.

use std::ffi::OsString;
use std::fs;
use std::path::Path;

use clap::Parser;
use codespan_reporting::term::termcolor::NoColor;
use ncc::args::{Cli, Verb};
use ncc::registry::DialectRegistry;
use ncc_dialects::{Family, builtin};
use ncc_driver::problem::Exit;
use ncc_exec::Event;
use ncc_tests::corpus::{self, files, shared};
use ncc_tests::expect::{self, Failures};
use ncc_tests::sketch::{SPELLED, pieces, spell};
use ncc_tests::{page, plain, translate};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// Lays a text out; the exit code, the text afterwards, and what was told.
fn fmt(dialect: &str, options: &str, text: &[u8]) -> (Exit, Vec<u8>, String) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("part");
    fs::write(&path, text).expect("a file");
    let mut all: Vec<OsString> = ["ncc", "fmt", "--from", dialect].map(OsString::from).into();
    all.extend(options.split_whitespace().map(OsString::from));
    all.push(path.clone().into());
    let cli = Cli::try_parse_from(&all).unwrap_or_else(|e| panic!("{all:?}: {e}"));
    let mut known = DialectRegistry::built_in();
    if cli.assume.is_some() {
        known.assume_milling();
    }
    let Verb::Fmt(asked) = cli.verb else { panic!("another verb") };
    let mut told = NoColor::new(Vec::new());
    let exit = match ncc::fmt::run(&asked, &known, &mut told) {
        Ok(exit) => exit,
        Err(problem) => {
            problem.print(&mut told, false).expect("memory");
            problem.exit
        }
    };
    let told = String::from_utf8_lossy(&told.into_inner()).replace(&path.display().to_string(), "part");
    (exit, fs::read(&path).expect("a file"), told)
}

/// Events of a text in a world, without their places.
fn events(dialect: &str, text: &[u8], skip: u16) -> Result<Vec<Event>, String> {
    let mut events = translate::execute(&translate::read(dialect, text)?, &plain::world(1), skip)?;
    events.iter_mut().for_each(|event| event.span = ncc_ir::source::Span::default());
    Ok(events)
}

fn shown(text: &[u8]) -> String {
    String::from_utf8_lossy(text).into_owned()
}

/// Both laws of one text. Gives the text laid out, if it is not refused.
fn holds(dialect: &str, options: &str, text: &[u8]) -> Result<Option<Vec<u8>>, String> {
    let (exit, once, told) = fmt(dialect, options, text);
    match exit {
        Exit::Done => {}
        Exit::Refused if once == text => return Ok(None),
        _ => return Err(format!("{exit:?}\n{told}\n{}", shown(text))),
    }
    let (_, twice, _) = fmt(dialect, options, &once);
    if twice != once {
        return Err(format!("once more, it is another:\n{}\n──\n{}", shown(&once), shown(&twice)));
    }
    let (exit, _, told) = fmt(dialect, &format!("--check {options}"), &once);
    if exit != Exit::Done {
        return Err(format!("--check afterwards: {exit:?}: {told}"));
    }
    for skip in [0, 0b10, u16::MAX] {
        if let Ok(before) = events(dialect, text, skip) {
            let after = events(dialect, &once, skip)?;
            if before != after {
                return Err(format!("other events:\n{}\n──\n{}", shown(text), shown(&once)));
            }
        }
    }
    Ok(Some(once))
}

#[test]
fn every_case_looks_as_it_should() {
    let mut failures = Failures::default();
    for path in files(&corpus::root().join("tests/fmt/cases")) {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let text = fs::read_to_string(&path).expect("a page");
        let case = page::read(&text);
        let dialect = case.fact("dialect").expect("a dialect");
        let options = case.fact("options").unwrap_or_default();
        let source = case.block("in").expect("an input");
        let (exit, written, told) = fmt(dialect, options, source.text.as_bytes());
        let (word, is) = match exit {
            Exit::Done => ("out", shown(&written)),
            _ => ("refused", told),
        };
        let start = text.find("```in").expect("an input");
        let end = start + text[start..].find("\n```\n").expect("its end") + 5;
        let expected = format!("{}\n```{word}\n{is}```\n", &text[..end]);
        failures.check(name, expect::file(&path, expected.as_bytes()));
        if exit == Exit::Done {
            failures.check(path.display(), holds(dialect, options, source.text.as_bytes()));
        }
    }
    failures.finish();
}

/// Programs that go the ways that values of the machine's tables have them go: they are held to their words alone. With
/// a number in every block each may be jumped to, where no cycle may be in force for G31.
const ASKING: [&str; 2] = ["tool-length-check.nc", "tool-life.nc"];

#[test]
fn the_corpus_is_laid_out_and_does_the_same() {
    let mut failures = Failures::default();
    for program in corpus::all() {
        if ASKING.contains(&&*program.file) {
            failures.check(&program.file, holds(program.dialect, "", &program.text));
            continue;
        }
        let result = holds(program.dialect, "--executed", &program.text)
            .and_then(|laid_out| laid_out.map(|_| ()).ok_or_else(|| "refused".to_owned()));
        failures.check(&program.file, result);
        let family = builtin(program.dialect).map(|d| d.family);
        if !matches!(family, Some(Family::Word | Family::Sinumerik)) {
            continue;
        }
        for options in ["--number 10:10", "--number off", "--number 1:1 --eol crlf"] {
            failures
                .check(format!("{} {options}", program.file), holds(program.dialect, options, &program.text));
        }
        // New numbers, taken away again, leave what is left without any; those of main blocks stay, and those that
        // are jumped to, which are other ones then.
        let jumps = program.text.windows(4).any(|word| word == b"GOTO");
        if jumps || program.text.windows(2).any(|pair| pair == b"\n:") {
            continue;
        }
        let numbered = fmt(program.dialect, "--number 7:3", &program.text).1;
        let (without, straight) = (
            fmt(program.dialect, "--number off", &numbered).1,
            fmt(program.dialect, "--number off", &program.text).1,
        );
        if without != straight {
            failures.add(&program.file, format!("{}\n──\n{}", shown(&without), shown(&straight)));
        }
    }
    failures.finish();
}

#[test]
fn foreign_programs_are_laid_out_or_left_as_they_are() {
    let Some(folder) = shared().map(|shared| shared.join("programs")).filter(|folder| folder.is_dir()) else {
        return println!("skipped: no programs beside the repository");
    };
    let mut failures = Failures::default();
    for dialect in ["fanuc", "siemens", "haas", "mach9"] {
        let own = if dialect == "siemens" { "siemens" } else { "fanuc" };
        for path in files(&folder.join(own)).into_iter().filter(|path| path.is_file()) {
            let text = fs::read(&path).expect("a program");
            for options in ["", "--number 10:10", "--number off"] {
                failures
                    .check(format!("{dialect} {} {options}", path.display()), holds(dialect, options, &text));
            }
        }
    }
    failures.finish();
}

fn law<S: Strategy>(cases: u32, values: S, holds: impl Fn(S::Value) -> Result<(), String>) {
    let config = Config { cases, failure_persistence: None, max_shrink_iters: 500, ..Config::default() };
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let result =
        TestRunner::new_with_rng(config, rng).run(&values, |value| holds(value).map_err(TestCaseError::fail));
    if let Err(fault) = result {
        panic!("{fault}");
    }
}

/// Small letters, and more blanks between words, outside of comments.
fn untidy(text: &str, seed: u64) -> String {
    let mut random = fastrand::Rng::with_seed(seed);
    let mut comment = false;
    let mut untidy = String::new();
    for c in text.chars() {
        comment = match c {
            '(' | ';' => true,
            ')' | '\n' => false,
            _ => comment,
        };
        let doubled = c == ' ' && !comment;
        untidy.push(if comment || random.bool() { c } else { c.to_ascii_lowercase() });
        if doubled {
            untidy.push_str([" ", "", "\t"][random.usize(..3)]);
        }
    }
    untidy
}

#[test]
fn random_programs_are_laid_out_alike_however_they_are_typed() {
    law(40, (pieces(), any::<u64>()), |(pieces, seed)| {
        for dialect in SPELLED.into_iter().filter(|d| corpus::DIALECTS.contains(d)) {
            let text = spell(&pieces, dialect);
            let laid_out = holds(dialect, "", text.as_bytes())?;
            let of_untidy = holds(dialect, "", untidy(&text, seed).as_bytes())?;
            if laid_out != of_untidy {
                let shown = |text: Option<Vec<u8>>| text.map(|text| shown(&text));
                return Err(format!("{dialect}: {:?}\n──\n{:?}", shown(laid_out), shown(of_untidy)));
            }
        }
        Ok(())
    });
}

/// Pieces that blocks are made of, and some that are none.
const SCRAPS: [&str; 44] = [
    "G", "g01", "X", "+", "-", "1", "05.", ".5", " ", "  ", "\t", "N10", "n", "O", "(", ")", "(a b)", ";",
    "#", "#1", "[", "]", "=", "/", "/2", ":", ",", "IF", "GOTO", "GOTOF", "EQ", "and", "CR", "R1", "_A",
    "$P", "\"q w\"", "'H1F'", "MSG(", "DO1", "%", "\n", "\n", "\r\n",
];

#[test]
fn whatever_is_typed_is_laid_out_for_good() {
    law(400, vec(0..SCRAPS.len(), 0..60), |scraps| {
        let text: String = scraps.into_iter().map(|at| SCRAPS[at]).collect();
        for dialect in ["mach9", "fanuc", "haas", "siemens"] {
            for options in ["", "--number 10:10"] {
                holds(dialect, options, text.as_bytes()).map_err(|e| format!("{dialect} {options}: {e}"))?;
            }
        }
        Ok(())
    });
}

/// No option of the layout changes what a file of another kind says.
#[test]
fn what_is_refused_is_not_written() {
    for text in [&b"\0\0\0"[..], b"G0 X1.\n\x01\0", b"\x7fELF\0\x01"] {
        for dialect in corpus::DIALECTS {
            let (exit, after, told) = fmt(dialect, "", text);
            assert!(exit == Exit::Refused && after == text, "{dialect}: {exit:?} {told}");
        }
    }
    assert!(Path::new(env!("CARGO_MANIFEST_DIR")).join("fmt/cases").is_dir());
}
