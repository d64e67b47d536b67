//! Laws of `ncc verify`: what ncc has written is equal to its source, and the certificate of that holds;
//! a change that the verification of translations finds makes it different; pages with one fact in every
//! dialect are equal whoever wrote them.

use ncc::registry::DialectRegistry;
use ncc::review::cert::disagreements;
use ncc::review::verify::{SCHEMA, of_texts};
use ncc_dialects::{Family, builtin};
use ncc_driver::job::Job;
use ncc_driver::review::verify::document::{Document, Word, finer_note};
use ncc_driver::translate::judge::Judge;
use ncc_ir::diag::Fault;
use ncc_tests::corpus::{self, DIALECTS};
use ncc_tests::expect::Failures;
use ncc_tests::page;
use ncc_tests::translate::{computes, job, translate};
use serde_json::Value;

use crate::schema::faults_of;

#[path = "../mutants/names.rs"]
mod names;
#[allow(dead_code)] // The other half is used where every mutant is tried.
#[path = "../mutants/words.rs"]
mod words;

/// Mutants of an output that are tried.
const SAMPLE: usize = 4;

fn verify(job: &Job, source: &[u8], output: &[u8]) -> Document {
    of_texts(job, [source, output], None, &DialectRegistry::built_in()).expect("anonymous files")
}

fn value(document: &Document) -> Value {
    serde_json::to_value(document).expect("JSON")
}

fn first(document: &Value) -> String {
    format!("{} {} {}", document["verdict"], document["summary"], document["first_difference"])
}

/// A certificate is read back as it was written, and a comparison made anew bears it out.
#[test]
fn the_certificate_of_a_translation_holds() {
    let mut failures = Failures::default();
    let mut equal = 0;
    for program in corpus::all() {
        for to in DIALECTS {
            let job = job(program.dialect, to, &program.file);
            let (outcome, written) = translate(&job, &program.text);
            // A loss that somebody allowed is not judged here.
            if outcome.release.is_err() {
                continue;
            }
            let what = format!("{}/{} to {to}", program.dialect, program.file);
            let certificate = verify(&job, &program.text, &written);
            let there = value(&certificate);
            for wrong in faults_of(SCHEMA, &there) {
                failures.add(&what, wrong);
            }
            match certificate.verdict() {
                Word::Equal => equal += 1,
                Word::EqualWithinTolerance | Word::Different | Word::NotCompared => {
                    failures.add(&what, first(&there));
                }
            }
            let text = there.to_string();
            let read: Document = serde_json::from_str(&text).expect("a certificate");
            for wrong in disagreements(&read, &verify(&job, &program.text, &written)) {
                failures.add(&what, wrong);
            }
        }
    }
    println!("{equal} translations equal to their sources");
    assert!(equal > 400, "{equal}");
    failures.finish();
}

/// The judge of mutants and `verify` are of one opinion, which is that of translations.
#[test]
fn a_mutant_is_different() {
    let mut failures = Failures::default();
    let (mut caught, mut passed, mut coarse) = (0, 0, 0);
    for (at, program) in corpus::all().into_iter().enumerate() {
        for (to_at, to) in DIALECTS.into_iter().enumerate() {
            // Between dialects: what two programs for one control do not say is the same for both.
            // Of a source that is coarser than its target all are looked at, of other pairs a third.
            let coarser = program.dialect == "siemens" && to == "canon";
            if to == program.dialect || (at + to_at) % 3 != 0 && !coarser {
                continue;
            }
            // A loop of which a word is changed may have no end, and is followed to where that is certain.
            if computes(&program) {
                continue;
            }
            let mut job = job(program.dialect, to, &program.file);
            job.head = false;
            let mut judge = Judge::new(&job, &program.text).expect("a source in memory");
            if judge.outcome.release.is_err() {
                continue;
            }
            // What a translation computes with more digits than the source has is told only to it.
            if judge.outcome.diagnostics.iter().any(|d| matches!(d.fault, Fault::PatternFolded { .. })) {
                continue;
            }
            let text = judge.outcome.output.to_vec().expect("an output in memory");
            let mutants = words::mutants(&text, form(to));
            let step = (mutants.len() / SAMPLE).max(1);
            for mutant in mutants.iter().skip(at % step).step_by(step) {
                let found = verify(&job, &program.text, &mutant.text);
                let differs = judge.judge_another(&mutant.text).is_err();
                let what = format!("{}/{} to {to}: {:?}", program.dialect, program.file, mutant.change);
                match (found.verdict(), differs) {
                    (Word::Different | Word::NotCompared, true) => caught += 1,
                    (Word::Equal, false) => passed += 1,
                    // A user's text of this form begins with its version.
                    (Word::NotCompared, false) if to == "ir" => passed += 1,
                    // A translation is held to the target's last digit, a pair to the coarser side's.
                    (Word::Equal, true) if tells_that(&value(&found)) => coarse += 1,
                    _ => {
                        let old = String::from_utf8_lossy(&text[mutant.at.clone()]);
                        failures.add(&what, format!("`{old}` at {:?}: {}", mutant.at, first(&value(&found))));
                    }
                }
            }
        }
    }
    println!("{caught} mutants different, {passed} that change nothing equal, {coarse} by a digit too fine");
    assert!(caught > 200 && (1..20).contains(&coarse), "{caught} {coarse}");
    failures.finish();
}

/// Whether it is told that two programs are apart by a digit that only the output resolves.
fn tells_that(found: &Value) -> bool {
    let finer = finer_note();
    found["compared"]["notes"].as_array().is_some_and(|notes| notes.iter().any(|note| *note == finer))
}

/// Programs that nobody translated: each block of a page against each other one.
#[test]
fn pages_are_equal_in_every_dialect() {
    let mut failures = Failures::default();
    let mut equal = 0;
    for path in corpus::files(&corpus::root().join("tests/pages")) {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let page = page::read(&std::fs::read_to_string(&path).expect("a page"));
        let differs = page.fact("differs").unwrap_or_default().to_owned();
        for a in &page.blocks {
            for b in page.blocks.iter().filter(|b| b.language != a.language) {
                let pair = [a, b].map(|block| block.notes.is_empty() && !block.text.trim().is_empty());
                let known =
                    DIALECTS.contains(&a.language.as_str()) && DIALECTS.contains(&b.language.as_str());
                if pair != [true; 2] || !known || differs.contains(&format!("{}→{}", a.language, b.language))
                {
                    continue;
                }
                let job = job(&a.language, &b.language, "page");
                let found = verify(&job, a.text.as_bytes(), b.text.as_bytes());
                match found.verdict() {
                    Word::Equal => equal += 1,
                    Word::EqualWithinTolerance | Word::Different | Word::NotCompared => {
                        failures.add(format!("{name}: {} {}", a.language, b.language), first(&value(&found)));
                    }
                }
            }
        }
    }
    println!("{equal} pairs of blocks equal");
    assert!(equal > 1000, "{equal}");
    failures.finish();
}

/// Programs of one control in which one word is another: its machine does something else, though points and
/// feeds are the same.
#[test]
fn another_word_is_another_cut() {
    let path = "%\nO0001\nG21 G17 G90 G94 G54\nT1 M06\nS1000 M03\nG00 X0. Y0. Z5.\nG64\n@\nG01 X10. F100.\nY10.\nM30\n%\n";
    let rotary = "%_N_A_MPF\nG710 G17 G90 G94 G54\nT1 M6\nD1\nS1000 M3\nG0 X0 Y0 Z5 C0\nC=DC(90)\n@\nG1 X10 F100\nM30\n";
    let programs = [
        ("fanuc", path, ["G61", "G62", "G63", "G64"].as_slice()),
        // The long way round, and the short one.
        ("siemens", rotary, &["C=ACP(10)", "C=ACN(10)"]),
        ("siemens", rotary, &["C=DC(200)", "C=ACN(200)"]),
    ];
    let mut failures = Failures::default();
    for (dialect, text, words) in programs {
        let job = job(dialect, dialect, "word");
        for a in words {
            for b in words {
                let [one, other] = [a, b].map(|word| text.replace('@', word));
                let found = verify(&job, one.as_bytes(), other.as_bytes());
                let expected = if a == b { Word::Equal } else { Word::Different };
                if found.verdict() != expected {
                    failures.add(format!("{dialect}: {a} and {b}"), first(&value(&found)));
                }
            }
        }
    }
    failures.finish();
}

fn form(dialect: &str) -> words::Form {
    let dialect = builtin(dialect).expect("a dialect");
    match dialect.family {
        Family::Word => {
            let open = dialect.comment.open.chars().next().expect("comments");
            words::Form::Letters(open, dialect.comment.close.chars().next())
        }
        Family::Canon | Family::Ir => words::Form::Functions,
        Family::Sinumerik => words::Form::Names,
    }
}

/// A cut in machine coordinates, said in a work offset: what lies between must all be taken off, and nothing else.
#[test]
fn a_place_of_the_machine_is_less_all_that_lies_between() {
    let siemens =
        "G710 G17 G90 G94\nG55\nT1 M6\nD1\nS1000 M3\nG0 X0 Y0 Z50\nG1 SUPA Z-100 F300\nG0 Z50\nM5\nM30\n";
    let linuxcnc = "G21 G17 G90 G94 G40 G49 G80\nG55\nT1 M6\nG43 H1\nS1000 M3\nG0 X0 Y0 Z50\nG53 G1 Z-100 F300\nG0 Z50\nM5\nM2\n";
    let fanuc = |cut: &str| {
        format!(
            "%\nO0001\nG21 G17 G90 G40 G49 G80 G94\nG55\nT1 M06\nS1000 M03\nG00 G43 H1 X0. Y0. Z50.\n{cut}\n\
             G00 G43 H1 Z50.\nM05\nM30\n%\n"
        )
    };
    let place = "Z[-100. - #5203 - #5243] F300.";
    let cases = [
        ("siemens", siemens, format!("G01 {place}"), Word::Equal),
        ("siemens", siemens, "G01 Z[-100. - #5243] F300.".into(), Word::Different),
        ("siemens", siemens, "G01 Z[-100. - #5203] F300.".into(), Word::Different),
        ("siemens", siemens, "G01 Z[-100. - #5203 - #5223] F300.".into(), Word::Different),
        ("siemens", siemens, "G01 Z[-100. - #5202 - #5243] F300.".into(), Word::Different),
        ("siemens", siemens, format!("G49 G01 {place}"), Word::Different),
        ("siemens", siemens, "G53 G00 Z-100.".into(), Word::Different),
        ("linuxcnc", linuxcnc, format!("G49 G01 {place}"), Word::Equal),
        ("linuxcnc", linuxcnc, format!("G01 {place}"), Word::Different),
    ];
    let mut failures = Failures::default();
    for (dialect, text, cut, expected) in cases {
        let found = verify(&job(dialect, "fanuc", "cut"), text.as_bytes(), fanuc(&cut).as_bytes());
        if found.verdict() != expected {
            failures.add(format!("{dialect}: {cut}"), first(&value(&found)));
        }
    }
    failures.finish();
}
