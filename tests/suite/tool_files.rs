//! A file per tool: `tests/tool-files/<from>/<name>.<extension>` beside the files that are written of it for a Grbl, in a
//! folder of its name.
//!
//! The second interpreter runs each file by itself, from modes that no program wants and from another place, with its tool
//! put in. What all of them do, one after another, is what the one program with the change by hand does, and what the
//! source does. The corpus is held to the first of these too.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use ncc_driver::job::{Job, Outcome};
use ncc_exec::world::World;
use ncc_tests::expect::{self, Failures};
use ncc_tests::interpreter::{ByItself, PowerOn};
use ncc_tests::plain::{self, Corners, Happening, Plain, Tolerance};
use ncc_tests::translate::{job, settings, stopping, straight_job, translate};
use ncc_tests::{besides, corpus};

/// Modes of a control that an operator has left in all the wrong ones.
const WRONG: PowerOn = PowerOn {
    inch: true,
    absolute: false,
    plane: 19,
    offset: 4,
    entry: 0,
    return_initial: true,
    motion: 1,
    tool: None,
    edge: 0,
};

fn per_tool(job: &Job) -> Job {
    let mut own = job.clone();
    own.to.choose("tool_change", "file-per-tool").expect("an option of the dialect");
    own
}

/// The text of a program, and how it is begun.
struct Begun<'t> {
    text: &'t [u8],
    tool: Option<u32>,
    power_on: PowerOn,
    /// From which world the axes' place is.
    from: u32,
}

fn run(begun: &Begun, world: &World) -> Result<Vec<Plain>, String> {
    let mut start = world.start;
    // The control has no rotary axes.
    start[..3].copy_from_slice(&plain::world(begun.from).start[..3]);
    let power_on = PowerOn { tool: begun.tool, ..begun.power_on };
    let setup = plain::setup(&World { start, ..world.clone() }, 0);
    let machine = plain::second("grbl", begun.text, ncc_tests::interpreter::Setup { power_on, ..setup })?;
    Ok(plain::of_machine(&machine, start.map(|n| n as f64 / 1e9)))
}

/// The events without what a file begins and ends with, and without the changes.
fn at_work(list: Vec<Plain>) -> Vec<Plain> {
    let rests = |event: &Plain| match event.what {
        Happening::ToolChange | Happening::End | Happening::TextEnd => true,
        Happening::Traverse => event.at[2].abs() < 1e-6,
        Happening::Coolant => event.coolant == (false, false),
        _ => false,
    };
    // Coolant may go on before the first move, wherever the operator has left the axes.
    let moves = |event: &Plain| {
        matches!(
            event.what,
            Happening::Traverse | Happening::Feed | Happening::Arc { .. } | Happening::Probe(..)
        )
    };
    let plain = |event: Plain| {
        let at = if moves(&event) { event.at } else { [0.0; 6] };
        Plain { at, by_itself: ByItself::default(), ..event }
    };
    list.into_iter().filter(|event| !rests(event)).map(plain).collect()
}

/// The files of an outcome: name, tool, text.
fn files(outcome: &mut Outcome, job: &Job) -> Vec<(String, Option<u32>, Vec<u8>)> {
    let whole = outcome.file_name(&job.machines, job.to.dialect, &job.source_name);
    let own = |file: &mut ncc_driver::job::ToolFile| {
        let text = file.output.to_vec().expect("an output in memory");
        (file.name(&whole), file.tool.map(|tool| tool as u32), text)
    };
    outcome.files.iter_mut().map(own).collect()
}

/// Runs the files, and the one program; both at work.
fn judge(
    files: &[(String, Option<u32>, Vec<u8>)],
    whole: &[u8],
    world: &World,
) -> Result<Vec<Plain>, String> {
    let seed = world.seed;
    let first = files.first().and_then(|file| file.1);
    let begun = |power_on| Begun { text: whole, tool: first, power_on, from: seed };
    let expected = at_work(run(&begun(PowerOn::default()), world)?);
    // Of a program that leaves modes to the control, a file does so too.
    let says_all = run(&begun(WRONG), world)
        .is_ok_and(|list| plain::compare(&expected, &at_work(list), Tolerance::SAME).is_ok());
    let power_on = if says_all { WRONG } else { PowerOn::default() };
    let mut all = Vec::new();
    for (at, (name, tool, text)) in files.iter().enumerate() {
        let from = if at == 0 { seed } else { seed + 7 };
        let list = run(&Begun { text, tool: *tool, power_on, from }, world)
            .map_err(|fault| format!("{name}: {fault}"))?;
        match list.last() {
            Some(last)
                if last.what == Happening::End && last.speed == 0.0 && last.coolant == (false, false) => {}
            _ if at + 1 == files.len() => {}
            last => return Err(format!("{name}: ends with {last:?}")),
        }
        all.extend(at_work(list));
    }
    plain::compare(&expected, &all, Tolerance::SAME)?;
    Ok(all)
}

/// The programs of this test: where they stand, their control.
fn programs() -> Vec<(std::path::PathBuf, String)> {
    let mut all = Vec::new();
    for folder in corpus::files(&corpus::root().join("tests/tool-files")) {
        let from = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        all.extend(
            corpus::files(&folder).into_iter().filter(|path| path.is_file()).map(|path| (path, from.clone())),
        );
    }
    all
}

#[test]
fn each_file_does_its_part_of_the_source() {
    let mut failures = Failures::default();
    let programs = programs();
    assert!(programs.len() >= 8, "{} programs", programs.len());
    for (path, from) in &programs {
        let text = fs::read(path).expect("a program");
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let manual = job(from, "grbl", &name);
        let whole = translate(&manual, &text).1;
        let own = per_tool(&manual);
        let (mut outcome, _) = translate(&own, &text);
        if outcome.release.is_err() {
            failures.add(&name, format!("refused: {:?}", stopping(&own, &outcome)));
            continue;
        }
        let files = files(&mut outcome, &own);
        let folder = path.with_extension("");
        for (file, _, text) in &files {
            failures.check(&name, expect::file(&folder.join(file), text));
        }
        failures.check(&name, no_others(&folder, &files));
        for seed in [1, 2, 3] {
            let world = besides::zeroed(plain::of_dialect(plain::world(seed), from), [from, "grbl"]);
            let Some(all) = failures.check(&name, judge(&files, &whole, &world)) else { continue };
            let source = plain::second(from, &text, plain::setup(&world, 0)).and_then(|machine| {
                let list = plain::of_machine(&machine, world.start.map(|n| n as f64 / 1e9));
                let corners = Corners::between(from, "grbl");
                let within = Tolerance { corners, arcs: false, ..Tolerance::ROUNDED };
                plain::compare(&at_work(besides::for_target(list, &own)), &all, within)
            });
            failures.check(format!("{name}, by its source"), source);
        }
    }
    failures.finish();
}

/// No file is left of what was written before.
fn no_others(folder: &Path, files: &[(String, Option<u32>, Vec<u8>)]) -> Result<(), String> {
    let names: BTreeSet<&str> = files.iter().map(|file| file.0.as_str()).collect();
    let there = corpus::files(folder);
    let other = there
        .iter()
        .find(|path| path.file_name().is_none_or(|name| !names.contains(name.to_string_lossy().as_ref())));
    other.map_or(Ok(()), |path| Err(format!("{} is no file of it", path.display())))
}

/// What goes through with the change by hand goes through as a file per tool, or is refused for what no file can state.
#[test]
fn the_corpus_goes_through_as_files_per_tool() {
    let mut failures = Failures::default();
    let (mut several, mut refused) = (0, 0);
    for program in corpus::all() {
        let manual = straight_job(&program, "grbl");
        let (outcome, whole) = translate(&manual, &program.text);
        if outcome.release.is_err() || program.dialect == "grbl" {
            continue;
        }
        let own = per_tool(&manual);
        let what = format!("{}/{}", program.dialect, program.file);
        let (mut outcome, _) = translate(&own, &program.text);
        if outcome.release.is_err() {
            refused += 1;
            let codes = stopping(&own, &outcome);
            if !codes.iter().eq([&510]) {
                failures.add(&what, format!("refused: {codes:?}"));
            }
            continue;
        }
        let files = files(&mut outcome, &own);
        if files.is_empty() {
            continue;
        }
        several += usize::from(files.len() > 1);
        for seed in [1, 2] {
            let world = plain::of_dialect(plain::world(seed), program.dialect);
            let world = besides::zeroed(world, [program.dialect, "grbl"]);
            failures.check(&what, judge(&files, &whole, &world));
        }
    }
    assert!(several >= 3, "{several} programs with several tools, {refused} refused");
    println!("{several} with several tools, {refused} refused");
    failures.finish();
}

/// Names sort in the order of execution.
#[test]
fn names_sort_in_the_order_of_execution() {
    let mut text = String::from("G21 G17 G90 G94 G54 G40 G49 G80\n");
    for tool in [9, 10, 2, 9, 1, 3, 4, 5, 6, 7, 11] {
        text +=
            &format!("T{tool} M6\nS1000 M3\nG0 X0 Y0\nG43 H{tool} Z5\nG1 Z-1 F100\nG0 Z5\nM5\nG53 G0 Z0\n");
    }
    text += "M2\n";
    let own = per_tool(&Job::new(settings("linuxcnc"), settings("grbl"), "part.ngc"));
    let (mut outcome, _) = translate(&own, text.as_bytes());
    let names: Vec<String> = files(&mut outcome, &own).into_iter().map(|file| file.0).collect();
    assert_eq!(names.first().map(String::as_str), Some("part-01-T9.gcode"));
    assert_eq!(names.last().map(String::as_str), Some("part-11-T11.gcode"));
    assert!(names.is_sorted(), "{names:?}");
}
