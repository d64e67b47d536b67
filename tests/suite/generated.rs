//! Programs that compute and that nobody wrote: expressions, decisions, loops and calls by chance, of all three
//! languages, all of which come to an end. The compiler and the second interpreter execute each of them, and find the
//! same moves; each goes into another dialect as straight blocks, and with its structure into the controls that
//! compute, verified, and the second interpreter finds the source's moves in what was written. What one of them
//! refuses, the other must not run: but the compiler may refuse more, by name, of few programs.
//!
//! `NCC_GENERATED=10000` makes so many, each for every control that computes, and tells what is refused.
//! `NCC_TEXTS=DIR` keeps the texts for LinuxCNC there, of which its own interpreter is a judge (`.ci/rs274`).

mod fanuc;
mod linuxcnc;
mod siemens;

use std::collections::{BTreeMap, BTreeSet};

use ncc_driver::job::{Failure, Job};
use ncc_exec::world::World;
use ncc_tests::besides;
use ncc_tests::corpus::DIALECTS;
use ncc_tests::expect::Failures;
use ncc_tests::interpreter::Setup;
use ncc_tests::plain::{self, Corners, Plain, Tolerance};
use ncc_tests::translate::{self, job, rendered};

/// Programs of a language in a usual run.
const USUAL: usize = 200;

/// At most one in so many may be refused by the compiler alone where it is executed, or written as straight blocks.
const MOST_REFUSED: usize = 10;

/// Faults after which it is enough.
const MOST_FAULTS: usize = 10;

/// Targets that keep what is computed.
const KEEPING: [&str; 4] = ["fanuc", "haas", "siemens", "linuxcnc"];

/// What the second interpreter refuses for the manuals say nothing of it.
const OPEN: [&str; 5] = [
    "halves below zero go is open",
    "MOD of a number below zero",
    "ROUNDUP of a number below zero",
    "MOD of numbers that are not whole",
    // Told where it is read.
    "an elseif that is passed over",
];

#[test]
fn programs_of_a_fanuc_by_chance() {
    by_chance("fanuc", fanuc::Maker::program);
}

#[test]
fn programs_of_a_sinumerik_by_chance() {
    by_chance("siemens", siemens::Maker::program);
}

#[test]
fn programs_of_o_words_by_chance() {
    by_chance("linuxcnc", linuxcnc::Maker::program);
}

fn by_chance(from: &'static str, program: fn(u64) -> String) {
    let asked: Option<usize> = std::env::var("NCC_GENERATED").ok().and_then(|n| n.parse().ok());
    let first: usize = std::env::var("NCC_GENERATED_FROM").ok().and_then(|n| n.parse().ok()).unwrap_or(0);
    let many = asked.unwrap_or(USUAL);
    let mut judge = Judge::default();
    for seed in first..first + many {
        let source = Source {
            from,
            name: format!("{from} program {seed}"),
            text: program(seed as u64 * 7919 + 13),
            world: plain::of_dialect(plain::world(seed as u32 % 3), from),
        };
        let Some(moves) = judge.executed(&source) else { continue };
        judge.written(&source, &moves, DIALECTS[seed % DIALECTS.len()], true);
        for (turn, to) in KEEPING.into_iter().enumerate() {
            if asked.is_some() || turn == seed % KEEPING.len() {
                judge.written(&source, &moves, to, false);
            }
        }
        if judge.failures.count() >= MOST_FAULTS {
            break;
        }
    }
    judge.finish(from, many);
}

/// A program that was made.
struct Source {
    from: &'static str,
    name: String,
    text: String,
    world: World,
}

impl Source {
    /// What the second interpreter does with a text.
    fn second(&self, dialect: &str, text: &[u8]) -> Result<Vec<Plain>, String> {
        self.second_in(&self.world, dialect, text)
    }

    fn second_in(&self, world: &World, dialect: &str, text: &[u8]) -> Result<Vec<Plain>, String> {
        let machine = plain::second(dialect, text, plain::setup(world, 0))?;
        Ok(plain::of_machine(&machine, self.start()))
    }

    /// Whether it goes elsewhere where its powers, and what its words round, are greater by 1 part of 1e15: which way a
    /// control goes then hangs on the last digits of its numbers, and no other has the same.
    fn hangs_on_last_digits(&self, moves: &[Plain], within: Tolerance) -> bool {
        let setup = Setup { last_digits_up: true, ..plain::setup(&self.world, 0) };
        let other = plain::second(self.from, self.text.as_bytes(), setup);
        other.is_ok_and(|other| same_way(moves, &plain::of_machine(&other, self.start()), within).is_err())
    }

    /// What it is held to in a target: its own moves, with the zero of Z set by each tool where that control has no other
    /// way.
    fn held_to(&self, moves: &[Plain], to: &str) -> Result<Vec<Plain>, String> {
        let world = besides::zeroed(self.world.clone(), [self.from, to]);
        if !world.zeroed_by_tool {
            return Ok(moves.to_vec());
        }
        self.second_in(&world, self.from, self.text.as_bytes())
    }

    fn start(&self) -> [f64; 6] {
        self.world.start.map(|n| n as f64 / 1e9)
    }

    /// How far what was written may be from it.
    fn within(&self, to: &str) -> Tolerance {
        // A feed in inches has three digits somewhere.
        let inches = self.text.contains("G20");
        let feed = if inches { 0.0005 * 25.4 + 0.002 } else { Tolerance::ROUNDED.feed };
        Tolerance {
            corners: Corners::between(self.from, to),
            arcs: plain::says_arcs(to),
            feed,
            ..Tolerance::ROUNDED
        }
    }
}

/// Compares what a source does with what was written of it. A straight move that is no longer than a rounding is none
/// for the one whose digits end above it.
fn same_way(source: &[Plain], written: &[Plain], within: Tolerance) -> Result<(), String> {
    same_but_for_moves_of(&[0.001, 0.0015, 0.0025], source, written, within)
}

/// Compares two ways. One may lack straight moves that are no longer than one of these lengths, in mm.
fn same_but_for_moves_of(
    lengths: &[f64],
    source: &[Plain],
    written: &[Plain],
    within: Tolerance,
) -> Result<(), String> {
    let told = plain::compare(source, written, within);
    let Err(why) = told else { return Ok(()) };
    let longer = ncc_tests::besides::longer;
    let same =
        |least: &f64| plain::compare(&longer(source, *least), &longer(written, *least), within).is_ok();
    if lengths.iter().any(same) { Ok(()) } else { Err(why) }
}

/// What came of all programs.
#[derive(Default)]
struct Judge {
    failures: Failures,
    same: usize,
    both: usize,
    open: usize,
    /// Held back, and their way hangs on the last digits of numbers.
    hanging: usize,
    straight: usize,
    /// Into each target.
    kept: BTreeMap<&'static str, usize>,
    /// By the compiler alone where they are executed or written as straight blocks, and by a target that would keep
    /// them.
    alone: BTreeMap<String, usize>,
    not_kept: BTreeMap<String, usize>,
}

impl Judge {
    /// Executes a program by both, and finds the same moves.
    fn executed(&mut self, source: &Source) -> Option<Vec<Plain>> {
        let first = translate::read(source.from, source.text.as_bytes())
            .and_then(|read| translate::execute(&read, &source.world, 0))
            .map(|events| plain::of_events(&events, source.start()));
        match (first, source.second(source.from, source.text.as_bytes())) {
            // What goes towards a place by less and less goes on a little longer with one's last digits than with the other's.
            (Ok(first), Ok(second)) => match same_but_for_moves_of(&[1e-6], &second, &first, Tolerance::SAME)
            {
                Ok(()) => {
                    self.same += 1;
                    if source.from == "linuxcnc" {
                        translate::keep(&format!("{} source", source.name), source.text.as_bytes());
                    }
                    return Some(second);
                }
                // A value that lies halfway between two digits of a word is rounded to either.
                Err(_) if source.hangs_on_last_digits(&second, Tolerance::SAME) => self.hanging += 1,
                Err(why) => self.fault(source, why),
            },
            (Err(_), Err(_)) => self.both += 1,
            (Err(why), Ok(_)) => *self.alone.entry(why).or_default() += 1,
            // What no manual says, the compiler takes for granted, and tells.
            (Ok(_), Err(why)) if OPEN.iter().any(|open| why.contains(open)) => self.open += 1,
            (Ok(_), Err(why)) => {
                self.fault(source, format!("only the second interpreter refuses it: {why}"));
            }
        }
        None
    }

    /// Writes it for a target, and has the second interpreter judge what was written.
    fn written(&mut self, source: &Source, moves: &[Plain], to: &'static str, straight: bool) {
        let passes = match straight {
            true => vec![ncc_driver::translate::rewrite::pass("flatten").expect("a pass of that name")],
            false => Vec::new(),
        };
        let job = Job { passes, ..job(source.from, to, &source.name) };
        let (outcome, output) = translate::translate(&job, source.text.as_bytes());
        match outcome.release {
            Ok(()) => {
                let how = if straight { "straight" } else { "kept" };
                if to == "linuxcnc" {
                    translate::keep(&format!("{} {how}", source.name), &output);
                }
                let world = besides::zeroed(source.world.clone(), [source.from, to]);
                let fault = match source.second_in(&world, to, &output) {
                    Ok(moved) => match source.held_to(moves, to) {
                        Ok(own) => same_way(&own, &moved, source.within(to)).err(),
                        Err(why) => Some(why),
                    },
                    Err(why) if OPEN.iter().any(|open| why.contains(open)) => return self.open += 1,
                    Err(why) => Some(why),
                };
                if let Some(why) = fault {
                    self.fault(source, format!("{to}, {how}: {why}\n{}", String::from_utf8_lossy(&output)));
                }
                match straight {
                    true => self.straight += 1,
                    false => *self.kept.entry(to).or_default() += 1,
                }
            }
            Err(Failure::Refused) => {
                let codes = translate::stopping(&job, &outcome);
                let told = match straight {
                    true => &mut self.alone,
                    false => &mut self.not_kept,
                };
                let whats: BTreeSet<String> = outcome
                    .diagnostics
                    .iter()
                    .filter(|d| job.refuses(d))
                    .filter_map(|d| match &d.fault {
                        ncc_ir::diag::Fault::Computes { what } => Some(format!("{what:?}")),
                        _ => None,
                    })
                    .collect();
                *told.entry(format!("{to} {codes:?} {whats:?}")).or_default() += 1;
            }
            Err(Failure::VerificationFailed)
                if source.hangs_on_last_digits(moves, source.within(source.from)) =>
            {
                self.hanging += 1
            }
            Err(Failure::VerificationFailed) => {
                let told = rendered(&job, &source.name, source.text.as_bytes(), &outcome.diagnostics);
                self.fault(source, format!("{to}, held back: {told}"));
            }
        }
    }

    fn fault(&mut self, source: &Source, why: impl std::fmt::Display) {
        if let Some(folder) = std::env::var_os("NCC_GENERATED_FAULTS") {
            let file = std::path::Path::new(&folder).join(source.name.replace(' ', "-"));
            let _ = std::fs::write(file, &source.text);
        }
        self.failures.add(&source.name, format!("{why}\n{}", source.text));
    }

    fn finish(mut self, from: &str, many: usize) {
        let (alone, kept): (usize, usize) = (self.alone.values().sum(), self.kept.values().sum());
        let not_kept: usize = self.not_kept.values().sum();
        println!(
            "{from}: {} executed alike, {} written straight and judged, {kept} kept and judged {:?}, {} refused by both, {} \
             open, {alone} by the compiler alone, {not_kept} not kept, {} held back that hang on last digits",
            self.same, self.straight, self.kept, self.both, self.open, self.hanging
        );
        if std::env::var_os("NCC_GENERATED").is_some() {
            let told = |refused: &BTreeMap<String, usize>| {
                let mut refused: Vec<_> = refused.iter().collect();
                refused.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
                refused.iter().for_each(|(why, count)| println!("{count:6} {why}"));
            };
            told(&self.alone);
            println!("not kept:");
            told(&self.not_kept);
        }
        if alone > many / MOST_REFUSED {
            self.failures.add("refused by the compiler alone", format!("{:?}", self.alone));
        }
        if self.failures.count() == 0 {
            assert!(self.straight > many / 2, "hardly any was written: {} of {many}", self.straight);
        }
        self.failures.finish();
    }
}
