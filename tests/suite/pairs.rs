//! Every program of the corpus into every dialect: translated and verified, or refused as listed.
//!
//! `tests/refusals.txt` has a line for each refusal: source, target, codes. A refusal that is not
//! listed fails, and so does a listed one that does not happen; `UPDATE_EXPECT=1` writes the list. A program that
//! computes, and is refused for that alone, goes there as straight blocks, verified; a line of its own has the
//! targets of which that is so.

use std::fmt::Write;

use ncc_driver::job::Failure;
use ncc_tests::corpus::{self, DIALECTS};
use ncc_tests::expect::{self, Failures};
use ncc_tests::translate::{job, rendered, stopping, straight_job, translate};

/// Of a program that is computed, whose target has no words for that.
const COMPUTES: u16 = 233;

#[test]
fn every_ordered_pair() {
    let mut failures = Failures::default();
    let mut refusals = String::from(HEAD);
    let (mut done, mut refused, mut events) = (0, 0, 0);
    for program in corpus::all() {
        let mut straight = Vec::new();
        for to in DIALECTS {
            let what = format!("{}/{} to {to}", program.dialect, program.file);
            let mut job = job(program.dialect, to, &program.file);
            let mut computes = "";
            let (mut outcome, _) = translate(&job, &program.text);
            if outcome.release.is_err() && stopping(&job, &outcome) == [COMPUTES].into() {
                computes = "NC0233,";
                job = straight_job(&program, to);
                outcome = translate(&job, &program.text).0;
            }
            match outcome.release {
                Ok(()) => match outcome.verified {
                    Some(v) if v.worlds >= 2 && v.events > 0 => {
                        done += 1;
                        events += v.events;
                        straight.extend((!computes.is_empty()).then_some(to));
                    }
                    other => failures.add(&what, format!("released, but verified {other:?}")),
                },
                Err(Failure::Refused) => {
                    refused += 1;
                    if to == program.dialect {
                        failures.add(&what, "a dialect's own program is refused");
                    }
                    let codes: Vec<String> =
                        stopping(&job, &outcome).iter().map(|c| format!("NC{c:04}")).collect();
                    let codes = codes.join(",");
                    let _ = writeln!(refusals, "{}/{} {to} {computes}{codes}", program.dialect, program.file);
                }
                Err(Failure::VerificationFailed) => {
                    failures.add(&what, rendered(&job, &program.file, &program.text, &outcome.diagnostics));
                }
            }
        }
        if !straight.is_empty() {
            let (dialect, file, straight) = (program.dialect, &program.file, straight.join(" "));
            let _ = writeln!(refusals, "{dialect}/{file} NC0233, taken as straight blocks: {straight}");
        }
    }
    let list = corpus::root().join("tests/refusals.txt");
    failures.check("refusals", expect::file(&list, refusals.as_bytes()));
    println!("{done} pairs translated and verified, {events} events compared, {refused} refused as listed");
    failures.finish();
}

const HEAD: &str = "\
# Programs of the corpus that a target cannot take, and the codes that say so; those that compute are taken as
# straight blocks where it says so.
# Written by UPDATE_EXPECT=1 cargo test -p ncc-tests every_ordered_pair; read it before committing.
";

/// The corpus is as large as it should be.
#[test]
fn at_least_sixteen_programs_a_dialect() {
    for dialect in DIALECTS {
        let programs = corpus::of(dialect);
        assert!(programs.len() >= 16, "{dialect}: {}", programs.len());
    }
}
