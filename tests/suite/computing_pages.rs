//! Side-by-side pages of programs that compute: `tests/computing/pages/*.md`, one fact in every dialect that has words
//! for it, and as the straight blocks that it comes to in the others.
//!
//! `goes:` says where the moves at feed end, worked out by hand. Every block makes these moves, for the compiler and
//! for the second interpreter; every block is translated into every other dialect as straight blocks; and `kept:` says
//! between which dialects the program is translated with its structure. A block marked `refused NC0501` says that the
//! fact cannot be said there.
//!
//! `UPDATE_EXPECT=1` fills empty blocks by translation and writes the `kept:` line anew.

use ncc_driver::translate::rewrite::pass;
use ncc_tests::expect::{self, Failures};
use ncc_tests::interpreter::{Event, Machine, What};
use ncc_tests::page::{self, Page};
use ncc_tests::plain::{self, Corners, Tolerance};
use ncc_tests::translate::{self, job, stopping, translate};
use ncc_tests::{besides, corpus};

/// Dialects of the pages.
const SIDES: [&str; 6] = ["fanuc", "siemens", "linuxcnc", "haas", "mach9", "canon"];

/// Those in which a program can compute.
const COMPUTING: [&str; 4] = ["fanuc", "siemens", "linuxcnc", "haas"];

/// A translation with its structure, or as straight blocks.
fn translated(from: &str, to: &str, text: &str, flat: bool) -> Result<Vec<u8>, Vec<u16>> {
    let passes = if flat { vec![pass("flatten").expect("a pass of that name")] } else { Vec::new() };
    let job = ncc_driver::job::Job { passes, head: false, ..job(from, to, &format!("page.{from}")) };
    let (outcome, written) = translate(&job, text.as_bytes());
    match outcome.release {
        Ok(()) => Ok(written),
        // Held back: there is no refusal.
        Err(ncc_driver::job::Failure::VerificationFailed) => Err(Vec::new()),
        Err(ncc_driver::job::Failure::Refused) => Err(stopping(&job, &outcome).into_iter().collect()),
    }
}

#[test]
fn one_fact_that_is_computed_in_every_dialect() {
    let mut failures = Failures::default();
    let paths = corpus::files(&corpus::root().join("tests/computing/pages"));
    assert!(paths.len() >= 40, "{} pages", paths.len());
    let mut pairs = 0;
    for path in paths {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let mut text = std::fs::read_to_string(&path).expect("a page");
        if expect::updating() {
            text = filled(&text);
        }
        let page = page::read(&text);
        failures.check(&name, moves_are(&page));
        let mut kept = Vec::new();
        for left in page.blocks.iter().filter(|b| b.notes.is_empty()) {
            for right in &page.blocks {
                let (from, to) = (left.language.as_str(), right.language.as_str());
                let what = format!("{name}: {from} to {to}");
                pairs += 1;
                match (translated(from, to, &left.text, true), &right.notes[..]) {
                    (Ok(flat), []) => drop(failures.check(&what, same(from, &left.text, to, &flat))),
                    (Err(codes), [refused, code]) if refused == "refused" => {
                        if codes.iter().all(|c| format!("NC{c:04}") != *code) {
                            failures.add(&what, format!("refused by {codes:?}"));
                        }
                    }
                    (Ok(_), _) => failures.add(&what, "the page says that it is refused"),
                    (Err(codes), _) => failures.add(&what, format!("refused by {codes:?}")),
                }
                match translated(from, to, &left.text, false) {
                    Ok(_) if ![from, to].iter().all(|side| COMPUTING.contains(side)) => {}
                    Ok(written) => {
                        kept.push(format!("{from}→{to}"));
                        failures.check(&what, same(from, &left.text, to, &written));
                    }
                    Err(codes) if codes.is_empty() => failures.add(&what, "held back"),
                    Err(_) => {}
                }
            }
        }
        let line = format!("kept: {}", kept.join(" "));
        let text = text.lines().map(|l| if l.starts_with("kept: ") || l == "kept:" { &line } else { l });
        let text = text.collect::<Vec<_>>().join("\n") + "\n";
        failures.check(&name, expect::file(&path, text.as_bytes()));
    }
    println!("{pairs} pairs");
    failures.finish();
}

/// The moves at feed of every block end where the page says, and all blocks make the same moves, in the compiler's
/// execution and in the second interpreter's.
fn moves_are(page: &Page) -> Result<(), String> {
    let goes = page.fact("goes").ok_or("it does not say where moves go")?;
    let expected: Vec<Vec<f64>> =
        goes.split(' ').map(|place| place.split(',').filter_map(|n| n.parse().ok()).collect()).collect();
    let mut first: Option<(&str, &str)> = None;
    for block in page.blocks.iter().filter(|b| b.notes.is_empty()) {
        let (dialect, text) = (block.language.as_str(), block.text.as_str());
        let machine = plain::second(dialect, text.as_bytes(), plain::setup(&plain::world(0), 0))
            .map_err(|why| format!("{dialect}: {why}"))?;
        let ends: Vec<&Event> = machine.events.iter().filter(|e| matches!(e.what, What::Feed)).collect();
        let near = |event: &Event, place: &[f64]| {
            place.len() == 3 && place.iter().zip(event.program).all(|(a, b)| (a - b).abs() < 0.001)
        };
        if ends.len() != expected.len() || !ends.iter().zip(&expected).all(|(e, place)| near(e, place)) {
            let ends: Vec<_> = ends.iter().map(|e| &e.program[..3]).collect();
            return Err(format!("{dialect} goes {ends:?}"));
        }
        agrees(dialect, text)?;
        match first {
            None => first = Some((dialect, text)),
            Some((from, other)) => same(from, other, dialect, text.as_bytes())?,
        }
    }
    Ok(())
}

/// Both interpreters find the same in a text.
fn agrees(dialect: &str, text: &str) -> Result<(), String> {
    let read = translate::read(dialect, text.as_bytes())?;
    for world in [0, 1, 2].map(plain::world) {
        let start = world.start.map(|n| n as f64 / 1e9);
        let machine = plain::second(dialect, text.as_bytes(), plain::setup(&world, 0))?;
        let events = translate::execute(&read, &plain::behaving(&world, dialect), 0)?;
        let (a, b) = (plain::of_machine(&machine, start), plain::of_events(&events, start));
        plain::compare(&a, &b, Tolerance::SAME).map_err(|why| format!("{dialect}: {why}"))?;
    }
    Ok(())
}

/// Two texts make the same moves for the second interpreter.
fn same(from: &str, left: &str, to: &str, right: &[u8]) -> Result<(), String> {
    let within =
        Tolerance { corners: Corners::between(from, to), arcs: plain::says_arcs(to), ..Tolerance::ROUNDED };
    for world in [0, 1, 2].map(plain::world) {
        let world = besides::zeroed(world, [from, to]);
        let start = world.start.map(|n| n as f64 / 1e9);
        let list = |machine: &Machine| plain::of_machine(machine, start);
        let a = plain::second(from, left.as_bytes(), plain::setup(&world, 0))?;
        let b = plain::second(to, right, plain::setup(&world, 0))
            .map_err(|why| format!("{to}: {why}\n{}", String::from_utf8_lossy(right)))?;
        plain::compare(&list(&a), &list(&b), within)
            .map_err(|why| format!("{why}\n{}", String::from_utf8_lossy(right)))?;
    }
    Ok(())
}

/// The page with its empty blocks translated from the Fanuc's, with its structure where that is kept.
fn filled(text: &str) -> String {
    let page = page::read(text);
    let mut out = String::new();
    let mut lines = text.lines().peekable();
    while let Some(line) = lines.next() {
        let language = line.strip_prefix("```").filter(|l| SIDES.contains(l));
        let (Some(to), Some(source), Some(&"```")) = (language, page.block("fanuc"), lines.peek()) else {
            out.push_str(line);
            out.push('\n');
            continue;
        };
        let written = translated("fanuc", to, &source.text, false)
            .or_else(|_| translated("fanuc", to, &source.text, true));
        match written {
            Ok(written) => out.push_str(&format!("```{to}\n{}", String::from_utf8_lossy(&written))),
            Err(codes) => {
                let code = codes.first().copied().unwrap_or_default();
                out.push_str(&format!("```{to} refused NC{code:04}\n"));
            }
        }
    }
    out
}
