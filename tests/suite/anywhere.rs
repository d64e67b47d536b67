//! Every code of a dictionary that stands alone in its block, at several places of an ordinary program, into every
//! dialect: translated and verified, or refused as listed.
//!
//! `tests/anywhere/<dialect>.txt` is the program, with its places in braces. A code that the dialect's own reader takes
//! alone neither there nor elsewhere is no case. `tests/anywhere/refusals.txt` has a line for each place of a code
//! that some target refuses; `UPDATE_EXPECT=1` writes it.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;

use ncc_dialects::{Dialect, builtin};
use ncc_driver::job::Failure;
use ncc_tests::corpus::{DIALECTS, root};
use ncc_tests::expect::{self, Failures};
use ncc_tests::translate::{job, rendered, stopping, translate};

const HEAD: &str = "\
# Codes that stand alone in a block of an ordinary program, the place, and who refuses them, with which codes.
# Written by UPDATE_EXPECT=1 cargo test -p ncc-tests anywhere; read it before committing.
";

/// The program of a dialect, with one line in one of its places.
fn with(program: &str, place: &str, line: &str) -> String {
    let mut text = String::new();
    for own in program.lines() {
        match own.strip_prefix('{').and_then(|own| own.strip_suffix('}')) {
            Some(name) if name == place => {
                let _ = writeln!(text, "{line}");
            }
            Some(_) => {}
            None => {
                let _ = writeln!(text, "{own}");
            }
        }
    }
    text
}

/// Most codes of one kind, such as work offsets.
const OF_A_KIND: usize = 4;

fn codes(dialect: &Dialect) -> Vec<&str> {
    let mut kinds = Vec::new();
    let few = dialect.code.iter().filter(|row| {
        let Some(kind) = row.means.as_ref().map(std::mem::discriminant) else { return false };
        kinds.push(kind);
        kinds.iter().filter(|other| **other == kind).count() <= OF_A_KIND
    });
    few.map(|row| row.code.as_str()).collect()
}

#[test]
fn codes_go_anywhere() {
    let mut failures = Failures::default();
    let mut refusals = String::from(HEAD);
    let (mut done, mut refused) = (0, 0);
    let folder = root().join("tests/anywhere");
    for from in ["fanuc", "haas", "linuxcnc", "mach9", "siemens"] {
        let program = fs::read_to_string(folder.join(format!("{from}.txt"))).expect("a program");
        let places: Vec<&str> =
            program.lines().filter_map(|line| line.strip_prefix('{')?.strip_suffix('}')).collect();
        assert!(places.len() > 2, "{from}");
        let dialect = builtin(from).expect("a dialect");
        for place in &places {
            for code in codes(dialect) {
                let text = with(&program, place, code);
                let own = job(from, from, "anywhere.nc");
                if translate(&own, text.as_bytes()).0.release.is_err() {
                    continue;
                }
                let mut by: BTreeMap<String, Vec<&str>> = BTreeMap::new();
                for to in DIALECTS {
                    let job = job(from, to, "anywhere.nc");
                    let (outcome, _) = translate(&job, text.as_bytes());
                    match outcome.release {
                        Ok(()) => done += 1,
                        Err(Failure::Refused) => {
                            refused += 1;
                            let codes: Vec<String> =
                                stopping(&job, &outcome).iter().map(|c| format!("NC{c:04}")).collect();
                            by.entry(codes.join(",")).or_default().push(to);
                        }
                        Err(Failure::VerificationFailed) => failures.add(
                            format!("{from} {code} {place} to {to}"),
                            rendered(&job, "anywhere.nc", text.as_bytes(), &outcome.diagnostics),
                        ),
                    }
                }
                for (codes, who) in by {
                    let _ = writeln!(refusals, "{from} {code} {place}: {codes} {}", who.join(" "));
                }
            }
        }
    }
    println!("{done} translated and verified, {refused} refused as listed");
    failures.check("refusals", expect::file(&folder.join("refusals.txt"), refusals.as_bytes()));
    failures.finish();
}
