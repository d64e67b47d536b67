//! Where emitted lines come from, over the whole corpus and all targets: the map that `--map` writes, and
//! the source's lines that `--annotate` puts beside the text.
//!
//! The pairs of events are found here once more, by executing source and output as they are; the map is
//! held against them, and against its schema.

use std::collections::BTreeSet;
use std::io::Cursor;
use std::ops::Range;

use codespan_reporting::term::termcolor::NoColor;
use ncc::provenance::args::Why;
use ncc::provenance::why;
use ncc::registry::DialectRegistry;
use ncc_driver::job::{Job, Outcome};
use ncc_driver::provenance::map;
use ncc_driver::provenance::trace::Asked;
use ncc_driver::render::About;
use ncc_exec::verify::{Comparison, Pair, Resolution};
use ncc_exec::world::World;
use ncc_exec::{Event, Kind};
use ncc_ir::canon::{Distance, FeedMode, Modes, Motion, Plane, ReturnLevel, Units};
use ncc_ir::source::Span;
use ncc_tests::besides;
use ncc_tests::corpus::{self, DIALECTS, Program};
use ncc_tests::expect::Failures;
use ncc_tests::translate::{execute, job, read, translate};
use serde_json::Value;

use crate::schema::faults_by;

/// A released output with its map.
struct Mapped {
    text: Vec<u8>,
    map: Value,
}

fn recorded(job: &Job, asked: Asked, program: &Program) -> Option<(Outcome, Vec<u8>, Option<Value>)> {
    let text = &program.text;
    let (mut outcome, record) =
        ncc_driver::translate::translate_recording(job, asked, &mut std::io::Cursor::new(text))
            .expect("an output in memory");
    outcome.release.ok()?;
    let written = outcome.output.to_vec().expect("an output in memory");
    let map = record.map(|record| {
        let mut source = Cursor::new(text);
        let mut about = About { job, name: &program.file, source: &mut source };
        let mut out = Vec::new();
        map::write(&mut out, &mut about, "out.nc", &mut outcome, record).expect("a map in memory");
        serde_json::from_slice(&out).unwrap_or_else(|e| panic!("{}: {e}", String::from_utf8_lossy(&out)))
    });
    Some((outcome, written, map))
}

fn mapped(job: &Job, program: &Program) -> Option<Mapped> {
    let (_, text, map) = recorded(job, Asked { map: true, annotate: false }, program)?;
    Some(Mapped { text, map: map.expect("a map of a verified output") })
}

/// Where lines begin and end, with their ends.
fn lines(text: &[u8]) -> Vec<Range<u32>> {
    let mut at = 0;
    let one = |line: &[u8]| {
        let start = at;
        at += line.len() as u32;
        start..at
    };
    text.split_inclusive(|b| *b == b'\n').map(one).collect()
}

fn number(value: &Value, name: &str) -> u32 {
    value[name].as_u64().and_then(|n| u32::try_from(n).ok()).unwrap_or_else(|| panic!("{name} of {value}"))
}

fn list<'v>(value: &'v Value, name: &str) -> &'v [Value] {
    value[name].as_array().map(Vec::as_slice).unwrap_or_default()
}

fn places(line: &Value) -> Vec<Span> {
    [list(line, "source"), list(line, "also")]
        .concat()
        .iter()
        .map(|place| Span::new(number(place, "start"), number(place, "end")))
        .collect()
}

/// The pairs of events of two texts, executed in one world.
fn pairs(job: &Job, source: &[u8], output: &[u8]) -> Result<Vec<Pair>, String> {
    let (a, b) = (read(&job.from.dialect.id, source)?, read(&job.to.dialect.id, output)?);
    let usual = Modes {
        motion: Some(Motion::Traverse),
        distance: Some(Distance::Absolute),
        units: Some(Units::Mm),
        plane: Some(Plane::Xy),
        feed_mode: Some(FeedMode::PerMinute),
        return_level: Some(ReturnLevel::Initial),
        work_offset: Some(1),
        length_offset: Some(0),
        no_origin_shift: Some(true),
    };
    let world = besides::zeroed(World::generate(1, &usual), [&job.from.dialect.id, &job.to.dialect.id]);
    let of = |behaviours| World { behaviours, ..world.clone() };
    let (mut a, mut b): (Vec<Event>, Vec<Event>) =
        (execute(&a, &of(job.source_behaviours()), 0)?, execute(&b, &of(job.target_behaviours()), 0)?);
    if !job.to.dialect.caps.modes.messages {
        a.retain(|event| !matches!(event.kind, Kind::Message(_)));
    }
    // The verification has judged them already; here they are only paired.
    let rough = Resolution { mm: 2, inch: 3, degree: 2, feed: 1, feed_inch: 2, second: 2, speed: 0 };
    let mut comparison = Comparison::new(rough, world.start);
    comparison.keep_pairs(true);
    comparison.see(ncc_exec::Seen::by(&job.to.dialect.caps));
    comparison.advance(&mut a, &mut b, true).map_err(|d| format!("{d:?}"))?;
    Ok(comparison.take_pairs())
}

#[test]
fn every_line_says_where_it_comes_from() {
    let schema: Value = serde_json::from_str(map::SCHEMA).expect("the schema is JSON");
    let mut failures = Failures::default();
    let mut unpaired = Vec::new();
    let (mut unfolded, mut also) = (0, 0);
    let (mut maps, mut paired, mut all_lines, mut all_events) = (0, 0, 0, 0);
    for program in corpus::all() {
        for to in DIALECTS {
            let job = job(program.dialect, to, &program.file);
            let what = format!("{}/{} to {to}", program.dialect, program.file);
            let (plain, _) = translate(&job, &program.text);
            let Some(found) = mapped(&job, &program) else {
                if plain.release.is_ok() {
                    failures.add(&what, "released without a map alone");
                }
                continue;
            };
            maps += 1;
            let mut wrong = faults_by(&schema, &found.map);
            held(&program, &found, &mut wrong);
            match pairs(&job, &program.text, &found.text) {
                Ok(pairs) => {
                    paired += 1;
                    all_events += pairs.len();
                    agrees(&found, &pairs, &mut wrong);
                }
                Err(fault) => unpaired.push(format!("{what}: {fault}")),
            }
            all_lines += list(&found.map, "lines").len();
            if !job.folds() {
                unfolded += list(&found.map, "lines").len();
                also += list(&found.map, "lines").iter().filter(|line| line["also"].is_array()).count();
            }
            for fault in wrong {
                failures.add(&what, fault);
            }
        }
    }
    println!("{maps} maps, {all_lines} lines, {paired} held against {all_events} pairs of events");
    println!("of {unfolded} lines that were not folded, {also} make events of further places");
    // A leg of a cycle goes to a position that another block names, and little else.
    if also * 1000 > unfolded {
        failures.add("further places", format!("{also} of {unfolded}"));
    }
    // A parameter of the source's control may not be in the output, which is then executed otherwise.
    assert!(maps > 100 && unpaired.len() * 20 <= maps, "{maps} maps, without pairs: {unpaired:#?}");
    failures.finish();
}

/// What a map must be by itself.
fn held(program: &Program, found: &Mapped, wrong: &mut Vec<String>) {
    let (map, text) = (&found.map, &found.text);
    let bounds = lines(text);
    let entries = list(map, "lines");
    if entries.len() != bounds.len() {
        wrong.push(format!("{} lines in the map, {} in the text", entries.len(), bounds.len()));
        return;
    }
    let source_lines = lines(&program.text);
    let mut seen = BTreeSet::new();
    for (entry, bounds) in entries.iter().zip(&bounds) {
        let at = number(entry, "line");
        if number(entry, "start") != bounds.start {
            wrong.push(format!("line {at} begins at {}, not {}", bounds.start, entry["start"]));
        }
        let all = [list(entry, "source"), list(entry, "also")].concat();
        for (span, place) in places(entry).into_iter().zip(&all) {
            let line = source_lines.iter().position(|line| line.contains(&span.start));
            if span.start >= span.end || span.end as usize > program.text.len() {
                wrong.push(format!("line {at}: {span:?} is no place in the source"));
            } else if line.map(|line| line as u32 + 1) != Some(number(place, "line")) {
                wrong.push(format!("line {at}: {place} is on line {line:?}"));
            }
        }
        for events in list(entry, "events") {
            let motion = list(events, "kinds").iter().any(|kind| {
                ["STRAIGHT_TRAVERSE", "STRAIGHT_FEED", "ARC_FEED"].contains(&kind.as_str().unwrap_or(""))
            });
            if motion && places(entry).is_empty() {
                wrong.push(format!("line {at} moves, and nobody knows why"));
            }
            for event in number(events, "first")..=number(events, "last") {
                if !seen.insert(event) {
                    wrong.push(format!("event {event} is in line {at} and in another one"));
                }
            }
        }
        for (name, all) in [("rows", "rows"), ("source_rows", "source_rows")] {
            let all = list(map, all).len() as u64;
            if list(entry, name).iter().any(|row| row.as_u64().is_none_or(|row| row >= all)) {
                wrong.push(format!("line {at} names rows that are not there"));
            }
        }
    }
    seen.extend(map["text_end"].as_u64().map(|event| event as u32));
    if !seen.iter().copied().eq(0..number(map, "events")) {
        wrong.push(format!("{} events, of which the lines have {seen:?}", map["events"]));
    }
}

/// Whether a map says what the pairs say.
fn agrees(found: &Mapped, pairs: &[Pair], wrong: &mut Vec<String>) {
    let bounds = lines(&found.text);
    let entries = list(&found.map, "lines");
    if number(&found.map, "events") as usize != pairs.len() {
        wrong.push(format!("{} events, {} pairs", found.map["events"], pairs.len()));
        return;
    }
    for (event, pair) in pairs.iter().enumerate() {
        if matches!(pair.kind, Kind::TextEnd) {
            continue;
        }
        let Some(at) = bounds.iter().position(|line| line.contains(&pair.target.start)) else {
            wrong.push(format!("event {event} is at {:?}, which is no line", pair.target));
            continue;
        };
        let entry = &entries[at];
        let own = list(entry, "events")
            .iter()
            .any(|events| (number(events, "first")..=number(events, "last")).contains(&(event as u32)));
        if !own {
            wrong.push(format!("event {event} is made by line {}, which the map does not say", at + 1));
        }
        let from = places(entry);
        let touched = from.iter().any(|span| span.start < pair.source.end && pair.source.start < span.end);
        if !touched {
            wrong.push(format!(
                "line {} comes from {from:?}, its event {event} ({:?}) from {:?}",
                at + 1,
                pair.kind,
                pair.source
            ));
        }
    }
}

/// Annotated outputs are verified as they are; here: that they are released where the plain ones are, and
/// that they are the plain ones where the comments are left away.
#[test]
fn the_source_stands_beside_the_text() {
    let mut failures = Failures::default();
    let (mut outputs, mut comments) = (0, 0);
    for program in corpus::all() {
        for to in DIALECTS.into_iter().filter(|to| *to != "canon") {
            let job = job(program.dialect, to, &program.file);
            let what = format!("{}/{} to {to}", program.dialect, program.file);
            let (plain, text) = translate(&job, &program.text);
            let asked = Asked { map: true, annotate: true };
            let Some((_, annotated, map)) = recorded(&job, asked, &program) else {
                if plain.release.is_ok() {
                    failures.add(&what, "not released with comments");
                }
                continue;
            };
            outputs += 1;
            let (text, annotated) = (String::from_utf8_lossy(&text), String::from_utf8_lossy(&annotated));
            if text.lines().count() != annotated.lines().count() {
                failures.add(&what, "another number of lines");
                continue;
            }
            for (a, b) in text.lines().zip(annotated.lines()) {
                if !b.starts_with(a) {
                    failures.add(&what, format!("`{a}` became `{b}`"));
                }
                comments += usize::from(a.len() < b.len());
            }
            let map = map.expect("a map of a verified output");
            if list(&map, "lines").len() != annotated.lines().count() {
                failures.add(&what, "the map has another number of lines");
            }
        }
    }
    println!("{outputs} outputs, {comments} lines with their source beside them");
    assert!(outputs > 100 && comments > 1000);
    failures.finish();
}

#[test]
fn the_answer_about_a_line_has_a_schema() {
    let schema: Value = serde_json::from_str(why::SCHEMA).expect("the schema is JSON");
    let folder = tempfile::tempdir().expect("a folder");
    let known = DialectRegistry::built_in();
    let mut failures = Failures::default();
    let mut answers = 0;
    for (program, to) in [("grid.cn", "siemens"), ("teste.cn", "fanuc"), ("calls.nc", "siemens")] {
        let program = corpus::all().into_iter().find(|p| p.file == program).expect("a program of the corpus");
        let job = job(program.dialect, to, &program.file);
        let found = mapped(&job, &program).expect("it is translated");
        let out = folder.path().join("out.nc");
        let map = serde_json::to_vec(&found.map).expect("JSON");
        let source = folder.path().join(&program.file);
        for (path, text) in
            [(&source, &program.text), (&out, &found.text), (&folder.path().join("out.nc.map.json"), &map)]
        {
            std::fs::write(path, text).expect("a file");
        }
        for line in 1..=lines(&found.text).len() {
            let args = Why {
                place: (out.clone(), line),
                map: None,
                from_source: None,
                from: None,
                to: None,
                format: ncc::args::typed::Format::Json,
            };
            let what = format!("{} to {to}, line {line}", program.file);
            match why::document(&args, &known, &mut NoColor::new(Vec::new())) {
                Ok(answer) => {
                    answers += 1;
                    for fault in faults_by(&schema, &answer) {
                        failures.add(&what, fault);
                    }
                    if answer["state"] != "known" {
                        failures.add(&what, &answer["state"]);
                    }
                    let from = list(&found.map["lines"][line - 1], "source").len();
                    if list(&answer, "source").len() != from {
                        failures.add(&what, "other places than in the map");
                    }
                }
                Err(problem) => failures.add(&what, problem.message),
            }
        }
    }
    assert!(answers > 50, "{answers} answers");
    failures.finish();
}
