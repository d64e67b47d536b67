//! Laws that hold of all programs, tried on random ones: seeded and bounded, the same in each run.

use std::collections::BTreeSet;

use ncc_dialects::{Family, Meaning, builtin};
use ncc_driver::job::{Failure, Job, Outcome};
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::Units;
use ncc_ir::diag::{Fault, Gravity, ModeName};
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::Op;
use ncc_passes::Legaliser;
use ncc_tests::besides;
use ncc_tests::corpus::{self, DIALECTS};
use ncc_tests::interpreter::{PowerOn, Setup};
use ncc_tests::plain::{self, Corners, Tolerance};
use ncc_tests::sketch::{self, SPELLED, pieces, spell};
use ncc_tests::translate::{self, job, rendered, straight_job};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// Tries a law on so many values.
fn law<S: Strategy>(cases: u32, values: S, holds: impl Fn(S::Value) -> Result<(), String>) {
    let config = Config { cases, failure_persistence: None, max_shrink_iters: 500, ..Config::default() };
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut runner = TestRunner::new_with_rng(config, rng);
    let result = runner.run(&values, |value| holds(value).map_err(TestCaseError::fail));
    if let Err(fault) = result {
        panic!("{fault}");
    }
}

/// A translation that must be released, with its text.
fn released(from: &str, to: &str, text: &str) -> Result<String, String> {
    released_by(&job(from, to, "law"), text)
}

/// A translation back to a machine of which it is stated that its codes do, besides their names, what those of the other
/// control do: then no words are needed for that.
fn job_back(through: &str, to: &str, file: &str) -> Job {
    let mut job = job(through, to, file);
    let there = builtin(through).map(|d| d.behaviours()).unwrap_or_default();
    for behaviour in Behaviour::ALL {
        if builtin(to).is_some_and(|d| d.behaviours().is_open(*behaviour)) {
            let value = behaviour.values()[usize::from(there.get(*behaviour))];
            job.to.choose(&behaviour.option(), value).expect("an option of an open behaviour");
        }
    }
    job
}

fn released_by(job: &Job, text: &str) -> Result<String, String> {
    let (from, to) = (&job.from.dialect.id, &job.to.dialect.id);
    let job = Job { head: false, ..job.clone() };
    let (outcome, written) = translate::translate(&job, text.as_bytes());
    match outcome.release {
        Ok(()) => String::from_utf8(written).map_err(|e| e.to_string()),
        Err(_) => {
            let said = rendered(&job, "law", text.as_bytes(), &outcome.diagnostics);
            Err(format!("{from} to {to}\n{text}\n{said}"))
        }
    }
}

/// Dialects of the corpus in which sketches are spelled.
fn spelled() -> impl Iterator<Item = &'static str> {
    SPELLED.into_iter().filter(|d| DIALECTS.contains(d))
}

/// Whether a dialect has words for all of a sketch: not every control has mist, optional stops and block skip.
fn takes(dialect: &str, text: &str) -> bool {
    let Some(d) = builtin(dialect).filter(|d| d.family == Family::Word) else { return true };
    let says = |words: [&str; 2]| text.lines().any(|line| line.split(' ').any(|word| words.contains(&word)));
    let code = |words, meaning| !says(words) || d.code_for(meaning).is_some();
    let skips = text.lines().any(|line| line.starts_with('/'));
    code(["M7", "M07"], Meaning::MistOn)
        && code(["M1", "M01"], Meaning::OptionalProgramStop)
        && (!skips || d.caps.flow.skip_levels > 0)
}

/// What a sketch is does not depend on its spelling.
#[test]
fn spellings_agree() {
    law(200, pieces(), |pieces| {
        let start = plain::world(1).start.map(|n| n as f64 / 1e9);
        let run = |dialect: &str| {
            let text = spell(&pieces, dialect);
            let machine = plain::second(dialect, text.as_bytes(), plain::setup(&plain::world(1), 0))
                .map_err(|e| format!("{dialect}: {e}\n{text}"))?;
            Ok::<_, String>(plain::of_machine(&machine, start))
        };
        let first = run(SPELLED[0])?;
        SPELLED[1..].iter().try_for_each(|d| plain::compare(&first, &run(d)?, Tolerance::SAME))
    });
}

/// All spellings of a random program make the same moves, by the second interpreter; each is
/// translated into every dialect and verified; and the second interpreter agrees with the outcome.
#[test]
fn random_programs_through_every_pair() {
    law(60, pieces(), |pieces| {
        let start = plain::world(1).start.map(|n| n as f64 / 1e9);
        let run_with = |dialect: &str, text: &str, other: &str| {
            let world = besides::zeroed(plain::world(1), [dialect, other]);
            let machine = plain::second(dialect, text.as_bytes(), plain::setup(&world, 0))?;
            Ok::<_, String>(plain::of_machine(&machine, start))
        };
        let run = |dialect: &str, text: &str| run_with(dialect, text, dialect);
        let sources: Vec<_> = spelled().map(|dialect| (dialect, spell(&pieces, dialect))).collect();
        let moves = run("mach9", &sources[0].1)?;
        for (from, text) in &sources {
            plain::compare(&moves, &run(from, text)?, Tolerance::SAME)
                .map_err(|e| format!("{from}: {e}\n{text}"))?;
            for to in DIALECTS.into_iter().filter(|to| takes(to, text)) {
                let written = released(from, to, text)?;
                // What a code does besides its name is the source's own control's.
                let own = run_with(from, text, to)?;
                let same = run_with(to, &written, from)
                    .and_then(|made| plain::compare(&own, &made, Tolerance::ROUNDED));
                same.map_err(|e| format!("{from} to {to}: {e}\n{text}\n{written}"))?;
            }
        }
        Ok(())
    });
}

/// Reading what was written gives what was written: A→A is a fixed point.
#[test]
fn read_after_write() {
    law(60, pieces(), |pieces| {
        for dialect in spelled() {
            let once = released(dialect, dialect, &spell(&pieces, dialect))?;
            let twice = released(dialect, dialect, &once)?;
            fixed(dialect, &once, &twice)?;
            for to in ["canon", "ir"] {
                let there = released(dialect, to, &once)?;
                fixed(to, &there, &released(to, to, &there)?)?;
            }
        }
        Ok(())
    });
}

fn fixed(dialect: &str, once: &str, twice: &str) -> Result<(), String> {
    match once == twice {
        true => Ok(()),
        false => Err(format!("{dialect}\n{}", ncc_tests::expect::diff(once.as_bytes(), twice.as_bytes()))),
    }
}

/// A→B→A makes the same cut as A, without the steps between. What each text takes for granted
/// is said in its head, and is so in the worlds that are tried.
#[test]
fn there_and_back() {
    law(40, pieces(), |pieces| {
        for from in spelled() {
            let text = spell(&pieces, from);
            for through in DIALECTS.into_iter().filter(|d| *d != from && takes(d, &text)) {
                let back = released_by(&job_back(through, from, "law"), &released(from, through, &text)?)?;
                same_cut_at(from, text.as_bytes(), back.as_bytes(), None, (Corners::All, true), through)
                    .map_err(|e| format!("{from}→{through}→{from}: {e}\n{text}\n{back}"))?;
            }
        }
        Ok(())
    });
}

/// The work offset that the only one of a control without words for it stands for.
fn only(there: &Outcome, through: &str) -> Option<u16> {
    let silent = builtin(through).is_some_and(|d| d.caps.frames.work_offsets == 0);
    let named = there.diagnostics.iter().find_map(|d| match d.fault {
        Fault::AssumedWorkOffset { offset } => Some(offset),
        _ => None,
    });
    named.filter(|_| silent)
}

/// Whether two programs of a dialect make the same cut, where `only` is the work offset that the second program knows as
/// its first, and so much of corners, and of what F counts on arcs, could be said on the way.
fn same_cut_at(
    dialect: &str,
    a: &[u8],
    b: &[u8],
    only: Option<u16>,
    (corners, arcs): (Corners, bool),
    through: &str,
) -> Result<(), String> {
    let (a, mut b) = (translate::read(dialect, a)?, translate::read(dialect, b)?);
    let mut stmts = a.procedures.iter().flat_map(|p| &p.body);
    let within = match stmts.any(|s| s.op == Op::UseLengthUnits(Units::Inch)) {
        // A feed in inches has three digits.
        true => Tolerance { feed: 0.0005 * 25.4 + 0.002, ..Tolerance::ROUNDED },
        false => Tolerance::ROUNDED,
    };
    let within = Tolerance { corners, arcs, ..within };
    for stmt in b.procedures.iter_mut().flat_map(|p| &mut p.body) {
        if let (Op::SetOriginOffsets(1), Some(only)) = (&stmt.op, only) {
            stmt.op = Op::SetOriginOffsets(only);
        }
    }
    for seed in [1, 2] {
        let world = besides::zeroed(plain::of_dialect(plain::world(seed), dialect), [dialect, through]);
        let start = world.start.map(|n| n as f64 / 1e9);
        for skip in [0, 0x7fe] {
            let list = |p| Ok::<_, String>(plain::of_events(&translate::execute(p, &world, skip)?, start));
            let [a, b] = [list(&a)?, list(&b)?].map(|list| besides::as_shown(list, through));
            // A control on the way may have stopped spindle and coolant where nothing is cut, which comes back as words.
            plain::compare(&a, &b, within)
                .or_else(|_| plain::compare(&besides::of_cuts(&a), &besides::of_cuts(&b), within))?;
        }
    }
    Ok(())
}

/// The corpus, there and back: every program that a dialect takes comes back as the same cut.
#[test]
fn the_corpus_there_and_back() {
    let mut failures = ncc_tests::expect::Failures::default();
    let mut done = 0;
    for program in corpus::all() {
        let from = program.dialect;
        for through in DIALECTS.into_iter().filter(|d| *d != from) {
            let (mut there, mut text) = translate::translate(&straight_job(&program, through), &program.text);
            if there.release.is_err() {
                continue;
            }
            let what = format!("{from}/{} through {through}", program.file);
            // A list has no control of which it could be stated that Z goes up for a tool change.
            let states = builtin(from).is_some_and(|d| d.behaviours().is_open(Behaviour::ZAtChange));
            if !states && there.diagnostics.iter().any(|d| d.fault == Fault::MovedAtChange) {
                continue;
            }
            let mut back_job = job_back(through, from, &program.file);
            let (mut back, mut returned) = translate::translate(&back_job, &text);
            if back.release.is_err() && through == "siemens" {
                // Words that another setting data would have measured otherwise come back if it is stated.
                let mut stated = straight_job(&program, through);
                for settings in [&mut stated.to, &mut back_job.from] {
                    let option = Behaviour::FrameOffsetIncremental.option();
                    settings.choose(&option, "excluded").expect("an option of the dialect");
                }
                (there, text) = translate::translate(&stated, &program.text);
                (back, returned) = translate::translate(&back_job, &text);
            }
            match back.release {
                Ok(()) => {
                    done += 1;
                    let said = (Corners::between(from, through), plain::says_arcs(through));
                    let result =
                        same_cut_at(from, &program.text, &returned, only(&there, through), said, through);
                    failures.check(
                        &what,
                        result.map_err(|e| format!("{e}\n{}", String::from_utf8_lossy(&returned))),
                    );
                }
                // What a dialect was given it can give back.
                Err(Failure::Refused | Failure::VerificationFailed) => {
                    failures.add(&what, rendered(&back_job, &program.file, &text, &back.diagnostics));
                }
            }
        }
    }
    println!("{done} there and back");
    failures.finish();
}

/// An emitted program does not depend on how the machine was left: from an unusual state at
/// power-on it makes the same moves, as far as its head does not say what it takes for granted.
#[test]
fn emitted_programs_state_their_modes() {
    let mut failures = ncc_tests::expect::Failures::default();
    for program in corpus::all() {
        for to in spelled() {
            let (outcome, text) = translate::translate(&straight_job(&program, to), &program.text);
            if outcome.release.is_err() {
                continue;
            }
            let assumed = |fact: ModeName| {
                outcome
                    .diagnostics
                    .iter()
                    .any(|d| matches!(d.fault, Fault::AssumedMode { fact: f, .. } if f == fact))
            };
            let usual = PowerOn::default();
            let unusual = PowerOn {
                inch: !assumed(ModeName::Units),
                absolute: assumed(ModeName::Distance),
                plane: if assumed(ModeName::Plane) { 17 } else { 19 },
                return_initial: assumed(ModeName::ReturnLevel),
                motion: 1,
                // A control whose tools have edges: the last one may be in force.
                edge: u32::from(to == "siemens" && !assumed(ModeName::LengthOffset)),
                ..usual
            };
            let world = plain::world(1);
            let start = world.start.map(|n| n as f64 / 1e9);
            let moves = |power_on| {
                let setup = Setup { power_on, ..plain::setup(&world, 0) };
                Ok::<_, String>(plain::of_machine(&plain::second(to, &text, setup)?, start))
            };
            let result = moves(usual).and_then(|a| plain::compare(&a, &moves(unusual)?, Tolerance::SAME));
            let what = format!("{}/{} to {to}", program.dialect, program.file);
            failures.check(what, result.map_err(|e| format!("{e}\n{}", String::from_utf8_lossy(&text))));
        }
    }
    failures.finish();
}

/// What the passes write out makes the same events as executing the cycles, patterns and calls.
#[test]
fn expansion_equals_execution() {
    let mut failures = ncc_tests::expect::Failures::default();
    let flat = &builtin("canon").expect("a dialect").caps;
    let mut expanded = 0;
    for program in corpus::all() {
        let what = format!("{}/{}", program.dialect, program.file);
        let Some(whole) = failures.check(&what, translate::read(program.dialect, &program.text)) else {
            continue;
        };
        let mut flattened = whole.clone();
        let mut found = Vec::new();
        let clearance = Num { mantissa: 1, scale: 0, point: true, unit: Unit::Mm };
        let mut legaliser = Legaliser::new(flat, 9, Some(clearance));
        legaliser.set_break_lift(Some(clearance));
        legaliser.run_program(&mut flattened, &mut found);
        if found.iter().any(|d| d.fault.gravity() == Gravity::Error) {
            // It cannot be said there; what is refused is listed.
            continue;
        }
        expanded += usize::from(!found.is_empty());
        for seed in [0, 1, 2] {
            let mut world = plain::world(seed);
            world.peck_clearance = ncc_ir::expr::num::ONE;
            world.break_lift = ncc_ir::expr::num::ONE;
            let start = world.start.map(|n| n as f64 / 1e9);
            for skip in [0, 0x7fe] {
                let list = |p: &ncc_ir::program::Program| {
                    Ok::<_, String>(plain::of_events(&translate::execute(p, &world, skip)?, start))
                };
                // It has no word for what F counts on arcs.
                let within = Tolerance { arcs: plain::says_arcs("canon"), ..Tolerance::SAME };
                let result = list(&whole).and_then(|a| plain::compare(&a, &list(&flattened)?, within));
                failures.check(format!("{what} world {seed} skip {skip:b}"), result);
            }
        }
    }
    assert!(expanded > 20, "hardly anything was expanded: {expanded}");
    failures.finish();
}

/// A coordinate keeps its value to the last digit, through every dialect, in both units.
#[test]
fn decimals_are_exact() {
    let value = (any::<bool>(), 0..99_999_999i64, any::<bool>());
    law(200, value, |(inch, mantissa, negative)| {
        let scale = if inch { 4 } else { 3 };
        let ten = 10i64.pow(scale);
        let sign = if negative && mantissa != 0 { "-" } else { "" };
        let digits = format!("{sign}{}.{:0width$}", mantissa / ten, mantissa % ten, width = scale as usize);
        let digits = digits.trim_end_matches('0');
        let units = if inch { "G70" } else { "G71" };
        let text = format!("G99\nG90\n{units}\nG17\nG0X{digits}\nY0.\nZ1.\nM2\n");
        for to in DIALECTS {
            let written = released("mach9", to, &text)?;
            let back = released(to, "mach9", &written)?;
            let words: BTreeSet<&str> = back.lines().filter_map(|l| l.split_once('X')).map(|w| w.1).collect();
            // Through canon every axis is named in every move, so X comes more than once.
            let value = |w: &str| {
                w.split(|c: char| !(c.is_ascii_digit() || "+-.".contains(c))).next().map(str::to_owned)
            };
            let values: BTreeSet<Option<String>> = words.into_iter().map(value).collect();
            let expected = BTreeSet::from([Some(digits.to_owned())]);
            if values != expected {
                return Err(format!("through {to}: {values:?} for {digits}\n{text}\n{written}\n{back}"));
            }
        }
        Ok(())
    });
}

/// Any bytes: an outcome, never a panic, never a failed verification.
#[test]
fn any_bytes() {
    let bytes = proptest::collection::vec(any::<u8>(), 0..200);
    law(300, (bytes, 0..DIALECTS.len(), 0..DIALECTS.len()), |(text, from, to)| {
        quiet(&job(DIALECTS[from], DIALECTS[to], "law"), &text)
    });
}

/// The same with texts that look like programs, so that more than the first line is reached.
#[test]
fn any_words() {
    let word = prop_oneof![
        8 => (proptest::char::range('A', 'Z'), "-?[0-9]{0,3}\\.?[0-9]{0,3}").prop_map(|(l, n)| format!("{l}{n}")),
        6 => proptest::sample::select(vec![
            "G0", "G1", "G2", "G3", "G4", "G17", "G18", "G19", "G20", "G21", "G24", "G25", "G40", "G43", "G49",
            "G54", "G55", "G70", "G71", "G80", "G81", "G82", "G83", "G85", "G89", "G90", "G91", "G98", "G99",
            "M3", "M5", "M6", "M8", "M9", "M0", "M30", "M98 P2", "M99", "O2", "O1", "L3", "F100", "%", "/2", "/",
            "(x)", ";y", "#1=2", "[", "I1.", "J0", "R2.", "Q1.", "P100", "D1.", "H1", "M17", "RET", "CR=5",
            "AR=90", "X=IC(5)", "I=AC(1)", "TURN=1", "CIP", "CT", "I1=3", "J1=2", "MCALL", "SUPA", "TRANS",
            "AROT", "RPL=30", "SCALE", "AMIRROR", "CYCLE81(5,0,1,-3)", "CYCLE83(5,0,1,-9,,-3,,0,,,1,1)",
            "CYCLE85(5,0,1,-3,,,9,9)", "HOLES1(0,0,0,5,5,3)", "HOLES2(0,0,9,0,0,4)", "(5,,3)", "MSG(\"m\")",
            "CYCLE801(0,0,0,5,5,2,2)", "LAB:", "REPEAT LAB P=2", "L12", "%_N_L12_SPF", "%_N_A_MPF", "R1=2",
            "IF R1==2 GOTOF LAB", "DEF REAL A1", "G4F1", "T=\"X\"", "\"",
        ]).prop_map(str::to_owned),
        3 => Just("\n".to_owned()),
        1 => Just("\r\n".to_owned()),
        2 => Just(" ".to_owned()),
    ];
    let text = proptest::collection::vec(word, 0..60).prop_map(|words| words.concat());
    law(600, (text, 0..DIALECTS.len(), 0..DIALECTS.len()), |(text, from, to)| {
        quiet(&job(DIALECTS[from], DIALECTS[to], "law"), text.as_bytes())
    });
}

/// The corpus with single bytes changed.
#[test]
fn any_slip() {
    let all = corpus::all();
    let slip = (0..all.len(), any::<u16>(), any::<u8>(), 0..DIALECTS.len());
    law(400, slip, |(which, place, byte, to)| {
        let program = &all[which];
        let mut text = program.text.clone();
        let place = usize::from(place) % text.len().max(1);
        if let Some(old) = text.get_mut(place) {
            *old = byte;
        }
        quiet(&straight_job(program, DIALECTS[to]), &text)
    });
}

fn quiet(job: &ncc_driver::job::Job, text: &[u8]) -> Result<(), String> {
    let (from, to) = (&job.from.dialect.id, &job.to.dialect.id);
    let (outcome, _) = translate::translate(job, text);
    let said = rendered(job, "law", text, &outcome.diagnostics);
    match outcome.release {
        Err(Failure::VerificationFailed) => {
            Err(format!("{from} to {to}: {said}\n{}", String::from_utf8_lossy(text)))
        }
        Err(Failure::Refused) if said.trim().is_empty() => {
            Err(format!("{from} to {to}: refused without a word"))
        }
        _ => Ok(()),
    }
}

/// Numbers of sketches, which the laws rest on.
#[test]
fn numbers_of_sketches() {
    assert_eq!(sketch::number(-12_340), "-12.34");
    assert_eq!(sketch::number(5_000), "5.");
    assert_eq!(sketch::number(0), "0.");
    assert_eq!(sketch::number(-7), "-0.007");
}
