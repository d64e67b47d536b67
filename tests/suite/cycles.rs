//! Canned cycles, and what else is cited, against the moves that a source from outside gives.
//!
//! `tests/cycles/*.md`: the source, the program, the moves. Both the second interpreter and the
//! compiler must make exactly these moves; the compiler in the dialects that it reads.

use std::path::PathBuf;

use ncc_tests::corpus;
use ncc_tests::expect::Failures;
use ncc_tests::interpreter::Setup;
use ncc_tests::interpreter::{Corner, Per};
use ncc_tests::page::{self, Page};
use ncc_tests::plain::{self, Corners, Happening, Plain, Tolerance};
use ncc_tests::translate;

/// Dialects of cited programs.
const CITED: [&str; 3] = ["mach9", "fanuc", "siemens"];

/// A cited example.
struct Cited {
    name: String,
    dialect: &'static str,
    text: String,
    start: [f64; 6],
    unit: f64,
    moves: Vec<Plain>,
    within: Tolerance,
    /// Code with which a translation into canonical functions is refused, if it is.
    refused: Option<String>,
}

fn cited() -> Vec<Cited> {
    let folder = corpus::root().join("tests/cycles");
    corpus::files(&folder).into_iter().map(|path| read(&path)).collect()
}

fn read(path: &PathBuf) -> Cited {
    let name = path.display().to_string();
    let page: Page = page::read(&std::fs::read_to_string(path).expect("a page that can be read"));
    assert!(page.fact("source").is_some_and(|s| s.len() > 20), "{name}: no source");
    let unit = if page.fact("unit") == Some("inch") { 25.4 } else { 1.0 };
    let dialect = CITED.into_iter().find(|d| page.block(d).is_some()).expect("a program");
    let number = |word: &str| word.parse::<f64>().unwrap_or_else(|_| panic!("{name}: {word}"));
    let mut start = [0.0; 6];
    for (axis, word) in page.fact("start").expect("a start").split(' ').enumerate() {
        start[axis] = number(word) * unit;
    }
    let mut moves = Vec::new();
    for line in page.block("moves").expect("moves").text.lines() {
        let words: Vec<&str> = line.split(' ').collect();
        let place = |words: &[&str]| {
            let mut at = start;
            for (axis, word) in words.iter().take(3).enumerate() {
                at[axis] = number(word) * unit;
            }
            at
        };
        let last = moves.last().map_or(start, |m: &Plain| m.at);
        let (what, at, feed) = match words[0] {
            "traverse" => (Happening::Traverse, place(&words[1..]), 0.0),
            "feed" => (Happening::Feed, place(&words[1..]), number(&words[4][1..]) * unit),
            "dwell" => (Happening::Dwell(number(words[1])), last, 0.0),
            // End point, plane, centre on its two axes, sweep.
            "arc" => {
                let normal = ["yz", "zx", "xy"].iter().position(|p| *p == words[4]).expect("a plane");
                let (first, second) = [(1, 2), (2, 0), (0, 1)][normal];
                let centre = [number(words[5]) * unit, number(words[6]) * unit];
                let radius = (last[first] - centre[0]).hypot(last[second] - centre[1]);
                let what = Happening::Arc { normal, centre, sweep: number(words[7]), radius };
                (what, place(&words[1..]), number(&words[8][1..]) * unit)
            }
            other => panic!("{name}: {other}"),
        };
        let (per, corner) = (Per::Minute, Corner::Unsaid);
        moves.push(Plain {
            what,
            at,
            feed,
            per,
            corner,
            tool: None,
            speed: 0.0,
            surface: None,
            coolant: (false, false),
            beside: None,
            five: [false; 2],
            by_itself: ncc_tests::interpreter::ByItself::default(),
            timed: false,
        });
    }
    let place = if page.fact("digits") == Some("3") { 0.0005001 } else { 1e-6 };
    Cited {
        name,
        dialect,
        text: page.block(dialect).expect("a program").text.clone(),
        start,
        unit,
        moves,
        within: Tolerance { place, feed: 1e-6, corners: Corners::All, arcs: true },
        refused: page.fact("canon").and_then(|f| f.strip_prefix("refused ")).map(str::to_owned),
    }
}

/// The pages of dialects that the compiler reads.
fn cited_to_the_compiler() -> Vec<Cited> {
    cited().into_iter().filter(|c| corpus::DIALECTS.contains(&c.dialect)).collect()
}

/// Only moves and dwells, without what the examples leave out: tools, spindle, coolant, the end.
fn bare(events: Vec<Plain>) -> Vec<Plain> {
    events
        .into_iter()
        .filter(|e| {
            use Happening::{Arc, Dwell, Feed, Traverse};
            matches!(e.what, Traverse | Feed | Dwell(_) | Arc { .. })
        })
        .map(|e| Plain { tool: None, speed: 0.0, coolant: (false, false), ..e })
        .collect()
}

/// Where the cited moves pass through a point without stopping there, both are one move: a rapid
/// that goes on in the same direction.
fn joined(moves: &[Plain]) -> Vec<Plain> {
    let mut joined: Vec<Plain> = Vec::new();
    for m in moves {
        if let [.., before, last] = &joined[..] {
            let same = |axis: usize| before.at[axis] == last.at[axis] && last.at[axis] == m.at[axis];
            let up = (last.at[2] - before.at[2]) * (m.at[2] - last.at[2]) > 0.0;
            let rapid = last.what == Happening::Traverse && m.what == Happening::Traverse;
            if rapid && same(0) && same(1) && up {
                joined.pop();
            }
        }
        joined.push(*m);
    }
    joined
}

#[test]
fn the_second_interpreter_makes_the_cited_moves() {
    let mut failures = Failures::default();
    for c in cited() {
        let setup = Setup { start: c.start, ..Setup::plain() };
        let result = plain::second(c.dialect, c.text.as_bytes(), setup).and_then(|machine| {
            let made = bare(plain::of_machine(&machine, c.start));
            plain::compare(&joined(&c.moves), &joined(&made), c.within)
        });
        failures.check(&c.name, result);
    }
    failures.finish();
}

#[test]
fn the_compiler_makes_the_cited_moves() {
    let mut failures = Failures::default();
    for c in cited_to_the_compiler() {
        let result = translate::read(c.dialect, c.text.as_bytes()).and_then(|program| {
            let mut world = plain::world(0);
            world.start = c.start.map(|mm| (mm * 1e9).round() as i64);
            world.peck_clearance = ncc_ir::expr::num::ONE;
            world.break_lift = ncc_ir::expr::num::ONE;
            world.break_lift = ncc_ir::expr::num::ONE;
            let events = translate::execute(&program, &world, 0)?;
            let made = bare(plain::of_events(&events, c.start));
            plain::compare(&joined(&c.moves), &joined(&made), c.within)
        });
        failures.check(&c.name, result);
    }
    failures.finish();
}

/// The same cycles written out as canonical functions.
#[test]
fn written_out_they_make_the_cited_moves() {
    let mut failures = Failures::default();
    for c in cited_to_the_compiler() {
        let mut job = translate::job(c.dialect, "canon", "cited");
        let mut program = c.text.clone();
        // A work offset leaves open where the tool stands, so it goes to the start by a block.
        let [x, y, z, ..] = c.start.map(|mm| mm / c.unit);
        let after = |mark: &str| {
            let at = program.find(mark).unwrap_or(0);
            at + program[at..].find('\n').map_or(0, |end| end + 1)
        };
        match c.dialect {
            "fanuc" => program.insert_str(after(""), &format!("G90 G54 G00 X{x:.3} Y{y:.3} Z{z:.3}\n")),
            "siemens" => program.insert_str(after("G54"), &format!("G71 G90 G0 X{x:.3} Y{y:.3} Z{z:.3}\n")),
            _ => {}
        }
        for (axis, at) in c.start.iter().enumerate().take(3) {
            job.start[axis] = Some((at * 1e9).round() as i64);
        }
        let (outcome, text) = translate::translate(&job, program.as_bytes());
        if let Some(code) = &c.refused {
            let codes: Vec<String> =
                translate::stopping(&job, &outcome).iter().map(|c| format!("NC{c:04}")).collect();
            if codes != [code.clone()] {
                failures.add(&c.name, format!("refused with {codes:?}"));
            }
            continue;
        }
        if outcome.release.is_err() {
            let said = translate::rendered(&job, "cited", program.as_bytes(), &outcome.diagnostics);
            failures.add(&c.name, said);
            continue;
        }
        let setup = Setup { start: c.start, ..Setup::plain() };
        let result = plain::second("canon", &text, setup).and_then(|machine| {
            let made = bare(plain::of_machine(&machine, c.start));
            plain::compare(
                &joined(&c.moves),
                &joined(&made),
                Tolerance { place: c.within.place + 1e-6, ..c.within },
            )
        });
        failures.check(&c.name, result.map_err(|e| format!("{e}\n{}", String::from_utf8_lossy(&text))));
    }
    failures.finish();
}
