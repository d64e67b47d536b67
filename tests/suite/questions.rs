//! Questions: which programs have two readings, what is asked of them, and what answers it.
//!
//! `tests/questions/<dialect>/` holds programs beside what is asked, as the user sees it; of `auto` the dialect is
//! recognised. `tests/questions/corpus.txt` names every program of the corpus that has a question: all others
//! translate without one.

use std::fmt::Write as _;
use std::io::Cursor;
use std::path::Path;

use codespan_reporting::term::termcolor::NoColor;
use ncc_dialects::{Settings, builtin, builtins};
use ncc_driver::guess::{Guess, guess};
use ncc_driver::job::Job;
use ncc_driver::questions::{Answer, Fact, Policy, Question, of_text};
use ncc_driver::render::{About, questions};
use ncc_tests::corpus;
use ncc_tests::expect::{self, Failures};
use ncc_tests::translate::settings;

fn asked(job: &Job, name: &str, text: &[u8], found: &[Question]) -> String {
    let mut source = Cursor::new(text);
    let mut about = About { job, name, source: &mut source };
    let mut out = NoColor::new(Vec::new());
    questions::print(&mut out, &mut about, found).expect("writing to memory");
    String::from_utf8_lossy(&out.into_inner()).into_owned()
}

/// A translation into itself, of a dialect or of the one that is recognised.
fn job(dialect: &str, name: &str, text: &[u8]) -> Job {
    if dialect != "auto" {
        return Job::new(settings(dialect), settings("ir"), name);
    }
    match guess(&mut Cursor::new(text), builtins()).expect("a text in memory") {
        Guess::Sure(dialect, _, rivals) => {
            Job { rivals, ..Job::new(Settings::new(dialect), settings("ir"), name) }
        }
        Guess::Unsure(fits) => panic!("{name} is not recognised: {fits:?}"),
    }
}

/// The same translation with an answer.
fn answered(job: &Job, answer: &Answer) -> Option<Job> {
    let mut job = job.clone();
    match answer {
        Answer::From(dialect) => {
            job.from = Settings::new(builtin(dialect)?);
            job.rivals.clear();
        }
        Answer::Units(units) => assert!(job.from.state_units(*units)),
        Answer::Option(option, value) => job.from.choose(option, value).expect("a value that it takes"),
        Answer::WritePoints | Answer::OfMachines { .. } => return None,
    }
    Some(job)
}

#[test]
fn what_is_asked_of_programs() {
    let mut failures = Failures::default();
    let (mut programs, mut answers) = (0, 0);
    let mut facts = [0; 8];
    // A translation alone asks it (`cli/tests/cli/questions.rs`).
    facts[Fact::RotaryTurn as usize] = 1;
    for folder in corpus::files(&corpus::root().join("tests/questions")).into_iter().filter(|p| p.is_dir()) {
        let dialect = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        for path in corpus::files(&folder) {
            if path.extension().is_some_and(|e| e == "asked") {
                continue;
            }
            programs += 1;
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let text = std::fs::read(&path).expect("a program");
            let what = format!("{dialect}/{name}");
            let job = job(&dialect, &name, &text);
            let found = of_text(&job, &text).expect("a text in memory");
            let said = match found.is_empty() {
                true => "nothing\n".to_owned(),
                false => asked(&job, &name, &text, &found),
            };
            let file = path.with_extension("asked");
            failures.check(&what, expect::file(&file, said.as_bytes()));
            stops(&job, &text, &found, &what, &mut failures);
            for question in &found {
                facts[question.fact as usize] += 1;
                // An answer leaves nothing to ask of its fact, whichever it is.
                for answer in question.readings.iter().filter_map(|reading| answered(&job, &reading.answer)) {
                    answers += 1;
                    let left = of_text(&answer, &text).expect("a text in memory");
                    if left.iter().any(|other| other.fact == question.fact) {
                        failures.add(&what, format!("asked again: {left:?}"));
                    }
                }
            }
        }
    }
    assert!(programs >= 20, "{programs} programs");
    assert!(facts.iter().all(|n| *n > 0), "{facts:?}");
    assert!(answers >= 20, "{answers} answers");
    failures.finish();
}

/// A translation stops with its questions, goes on with ncc's readings where that is asked for, and its head names
/// them then.
fn stops(job: &Job, text: &[u8], found: &[Question], what: &str, failures: &mut Failures) {
    let done = |questions: Policy| {
        let job = Job { to: settings("ir"), questions, ..job.clone() };
        ncc_driver::translate::translate(&job, &mut Cursor::new(text)).expect("an output in memory")
    };
    let (ask, mut assume) = (done(Policy::Ask), done(Policy::Assume));
    if ask.questions != found || assume.questions != found {
        failures.add(what, "a translation has other questions than the text");
    }
    if ask.release.is_ok() != found.is_empty() || assume.release.is_err() {
        failures.add(what, format!("asking: {:?}, assuming: {:?}", ask.release, assume.release));
    }
    let written = assume.output.to_vec().expect("an output in memory");
    let head = String::from_utf8_lossy(&written).contains("not answered: ");
    if head == found.is_empty() {
        failures.add(what, "the head does not say what was not answered");
    }
}

/// Which programs of the corpus have two readings.
#[test]
fn the_corpus_has_no_other_questions() {
    let mut list = String::new();
    let programs = corpus::all().into_iter().chain(corpus::DIALECTS.into_iter().flat_map(corpus::computing));
    for program in programs {
        let job = job(program.dialect, &program.file, &program.text);
        let found = of_text(&job, &program.text).expect("a text in memory");
        if found.is_empty() {
            continue;
        }
        let _ = write!(list, "{}/{}:", program.dialect, program.file);
        for question in &found {
            let fact = match question.fact {
                Fact::Control => "control",
                Fact::Units => "units",
                Fact::DecimalPoint => "decimal point",
                Fact::RotaryTurn => "rotary turn",
                Fact::Centres => "centres of arcs",
                Fact::CycleBesideMotion => "cycle beside a motion",
                Fact::ReturnPath => "path of a return",
                Fact::ToolChange => "tool of a change",
            };
            let _ = write!(list, " {fact};");
        }
        list.push('\n');
    }
    let path = corpus::root().join("tests/questions/corpus.txt");
    expect::file(Path::new(&path), list.as_bytes()).unwrap_or_else(|fault| panic!("{fault}"));
}

/// Holes that two readings make at the same places are executed once; one among them at another place is asked for, however
/// far it is from where the cycle is called up.
#[test]
fn a_hole_without_points_among_many_is_asked_for() {
    let holes = |among: &str| {
        let mut text =
            "%\nO1\nG21 G17 G90 G40 G49 G80 G94\nG54\nT1 M06\nS500 M03\nG00 X0. Y0.\nG43 H1 Z50.\n\
                        G99 G81 X1. Y1. Z-20. R2. F150.\n"
                .to_owned();
        for n in 0..8000 {
            let _ = writeln!(text, "X{}.5 Y{}.", n % 300, n % 70);
            text += if n == 3000 { among } else { "" };
        }
        text + "G80\nG00 Z50.\nM30\n%\n"
    };
    let found = |text: String| of_text(&job("fanuc", "holes.nc", text.as_bytes()), text.as_bytes());
    assert!(found(holes("")).expect("a text in memory").is_empty());
    assert_eq!(found(holes("X100 Y50\n")).expect("a text in memory").len(), 1);
}
