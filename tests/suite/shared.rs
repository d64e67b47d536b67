//! Material that is given beside the repository: the case study's tables, programs that nobody here
//! wrote. Each test says so and passes where it is absent.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use ncc_driver::job::Failure;
use ncc_ir::expr::num::{Num, Unit};
use ncc_tests::corpus::{self, DIALECTS, files};
use ncc_tests::expect::{self, Failures};
use ncc_tests::translate::{job, rendered, stopping, translate};

/// A folder beside the repository; says so if it is absent.
pub(crate) fn beside(folder: &str) -> Option<PathBuf> {
    let path = corpus::shared().map(|shared| shared.join(folder)).filter(|p| p.is_dir());
    if path.is_none() {
        println!("skipped: no ../shared/{folder} beside the repository");
    }
    path
}

/// The case study's programs are in the corpus byte for byte.
#[test]
fn the_case_study_is_unchanged() {
    let Some(study) = beside("cases/mach9") else { return };
    for name in ["teste.cn", "table9.cn"] {
        let ours = fs::read(corpus::root().join("corpus/mach9").join(name)).expect("the corpus");
        assert_eq!(ours, fs::read(study.join(name)).expect("the case study"), "{name}");
    }
}

/// Table 9 gives table 12 exactly, from the stated start, with a corrector word that emits nothing.
#[test]
fn table_9_gives_table_12() {
    let Some(study) = beside("cases/mach9") else { return };
    let mut job = job("mach9", "canon", "table9.cn");
    job.head = false;
    job.from.choose("o_word", "ignore").expect("an option");
    let start = [(-9, 0), (15_588, 3), (3, 0)];
    for (axis, (mantissa, scale)) in start.into_iter().enumerate() {
        job.start[axis] = Num { mantissa, scale, point: true, unit: Unit::Mm }.nanos(false);
    }
    let text = fs::read(study.join("table9.cn")).expect("the case study");
    let (outcome, written) = translate(&job, &text);
    assert!(outcome.release.is_ok(), "{}", rendered(&job, "table9.cn", &text, &outcome.diagnostics));
    let table = fs::read(study.join("table12.canon")).expect("the case study");
    assert!(written == table, "{}", expect::diff(&table, &written));
}

/// What became of programs from elsewhere, of one dialect into another.
#[derive(Default)]
struct Tally {
    done: usize,
    refused: BTreeMap<String, usize>,
}

/// Programs from elsewhere: translated and verified, or refused with a reason; never a failed
/// verification. Some of the Fanuc's leave points away as a control in calculator mode allows: they
/// are tried both ways.
#[test]
fn programs_from_elsewhere() {
    let mut failures = Failures::default();
    for (from, ways) in [("fanuc", &["increment", "calculator"][..]), ("siemens", &[""])] {
        let Some(programs) = beside(&format!("programs/{from}")).filter(|_| DIALECTS.contains(&from)) else {
            continue;
        };
        let mut tallies: BTreeMap<&str, Tally> = BTreeMap::new();
        let mut outside = 0;
        for path in files(&programs) {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let text = fs::read(&path).expect("a program");
            let needs_variables = calculates(from, &text);
            outside += usize::from(needs_variables);
            for to in DIALECTS {
                // Best way of reading, the first one to be translated.
                let mut codes = Some(String::new());
                for way in ways {
                    let mut job = job(from, to, &name);
                    if !way.is_empty() {
                        job.from.choose("decimal_point", way).expect("an option");
                    }
                    let (outcome, _) = translate(&job, &text);
                    let said = rendered(&job, &name, &text, &outcome.diagnostics);
                    match outcome.release {
                        Ok(()) => codes = None,
                        Err(Failure::Refused) if !said.is_empty() => {
                            if let Some(codes) = &mut codes {
                                *codes = stopping(&job, &outcome)
                                    .iter()
                                    .map(|c| format!("NC{c:04}"))
                                    .collect::<Vec<_>>()
                                    .join(",");
                            }
                        }
                        Err(_) => failures.add(format!("{name} to {to}"), said),
                    }
                }
                if let (true, Some(codes)) = (needs_variables, &codes) {
                    println!("  {from} {name} {to} {codes} (needs variables)");
                    continue;
                }
                println!("  {from} {name} {to} {}", codes.as_deref().unwrap_or("verified"));
                let tally = tallies.entry(to).or_default();
                match codes {
                    None => tally.done += 1,
                    Some(codes) => *tally.refused.entry(codes).or_default() += 1,
                }
            }
        }
        println!("{from}: {outside} programs need variables");
        for (to, tally) in tallies {
            let refused: Vec<String> = tally.refused.iter().map(|(c, n)| format!("{n} {c}")).collect();
            // Codes and words that this version does not know or translate, and the macro language.
            let beyond = |codes: &str| ["NC0201", "NC0202", "NC0220"].iter().any(|c| codes.contains(c));
            let within = tally.refused.iter().filter(|(c, _)| !beyond(c)).map(|(_, n)| n).sum::<usize>();
            println!(
                "{from} to {to}: {} verified of {} that use only what is translated; refused: {}",
                tally.done,
                tally.done + within,
                refused.join(", ")
            );
        }
    }
    failures.finish();
}

/// Whether a program calculates, decides or jumps: beyond what is translated so far.
fn calculates(dialect: &str, text: &[u8]) -> bool {
    let text = String::from_utf8_lossy(text).to_ascii_uppercase();
    text.lines().any(|line| match dialect {
        "fanuc" => line.split('(').next().is_some_and(|l| l.contains('#')),
        _ => {
            let bare = line.split(';').next().unwrap_or_default();
            let words = || bare.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_' || c == '$'));
            let flow = [
                "DEF", "IF", "ELSE", "FOR", "WHILE", "LOOP", "GOTO", "GOTOF", "GOTOB", "GOTOC", "CASE",
                "REPEAT", "UNTIL", "EXTERN", "DEFINE",
            ];
            let repeat_until = |w: &str| w != "REPEAT" || bare.trim_end().ends_with("REPEAT");
            words().any(|w| flow.contains(&w) && repeat_until(w) || w.starts_with('$'))
                || words().any(|w| {
                    let number = w.strip_prefix('R').filter(|n| !n.is_empty());
                    number.is_some_and(|n| n.bytes().all(|b| b.is_ascii_digit()))
                })
        }
    })
}

/// Lines of foreign Sinumerik programs that are wrong on purpose, by the remarks beside them.
const WRONG_LINES: &[(&str, &[usize])] = &[
    ("s840d_syntax_test_archive.arc", &[15]),
    ("s840d_syntax_test_call.spf", &[8, 12, 17, 30, 38, 60]),
    ("s840d_syntax_test_din.spf", &[39, 70, 75, 422]),
    ("s840d_syntax_test_repeat.spf", &[61, 69, 78, 88, 141, 150, 162, 171]),
];

/// The Sinumerik's grammar takes every line of programs from elsewhere that is not wrong on purpose.
#[test]
fn sinumerik_lines_from_elsewhere_have_their_form() {
    let mut failures = Failures::default();
    for folder in ["programs/siemens", "cases/siemens-peer"] {
        let Some(programs) = beside(folder) else { continue };
        for path in files(&programs) {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if [".csv", ".md"].iter().any(|end| name.ends_with(end)) {
                continue;
            }
            let text = fs::read(&path).expect("a program");
            let faults = ncc_frontends::siemens::form(&text);
            let line = |at: u32| text[..at as usize].iter().filter(|b| **b == b'\n').count() + 1;
            let lines: Vec<usize> = faults.iter().map(|d| line(d.span.start)).collect();
            let wrong = WRONG_LINES.iter().find(|(n, _)| *n == name).map_or(&[][..], |(_, lines)| lines);
            if lines != wrong {
                let said: Vec<_> =
                    faults.iter().map(|d| format!("{}: {:?}", line(d.span.start), d.fault)).collect();
                failures.add(&name, said.join("\n"));
            }
        }
    }
    failures.finish();
}
