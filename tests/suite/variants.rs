//! Options of a dictionary that bring rows: `tests/variants/grblhal/<name>.gcode` are programs of a grblHAL, `<name>.m6`
//! of one with M6 and a table of tools, `<name>.axes` of one with rotary axes.
//!
//! The second interpreter, which was written from grblHAL's own source, judges how they are read, what is written of them
//! for other controls, and what is written for a grblHAL of the corpus of the others.

use std::fs;

use ncc_dialects::Settings;
use ncc_driver::job::Job;
use ncc_exec::world::World;
use ncc_ir::expr::num::ONE;
use ncc_tests::expect::Failures;
use ncc_tests::interpreter::Setup;
use ncc_tests::interpreter::grbl::run_hal;
use ncc_tests::plain::{self, Corners, Plain, Tolerance};
use ncc_tests::{besides, corpus, translate};

/// Options of every program, and of those with a mark before their extension.
const OPTIONS: [(&str, &[(&str, &str)]); 3] = [
    ("", &[("controller", "grblhal")]),
    ("m6", &[("tool_change", "m6"), ("tool_table", "yes")]),
    ("axes", &[("rotary_axes", "yes")]),
];

/// What another control has no words for: a cycle along another axis, a table, the number of a tool.
const REFUSED: [(&str, &[&str]); 3] = [
    ("planes.gcode", &["fanuc", "haas"]),
    ("more-offsets.gcode", &["siemens", "canon"]),
    ("tool-number.m6.gcode", &["fanuc", "haas", "siemens", "canon"]),
];

/// A program of a grblHAL.
struct Program {
    file: String,
    text: Vec<u8>,
    settings: Settings,
}

/// The order in which options are chosen makes no difference, and a later choice takes the rows away again: a profile's
/// options stand in the order of their names, and the command line goes before them.
#[test]
fn options_are_chosen_in_any_order() {
    let all = [
        ("coolant_at_change", "does-not"),
        ("controller", "grblhal"),
        ("tool_change", "m6"),
        ("tool_table", "yes"),
        ("z_at_change", "stays"),
    ];
    let orders: [Vec<usize>; 3] = [vec![0, 1, 2, 3, 4], vec![4, 3, 2, 1, 0], vec![2, 0, 4, 1, 3]];
    for order in orders {
        let mut settings = translate::settings("grbl");
        for at in &order {
            settings.choose(all[*at].0, all[*at].1).expect("an option of the dialect");
        }
        let says = |settings: &Settings, code: &str| {
            settings.dialect.code.iter().any(|row| row.code == code && row.means.is_some())
        };
        assert!(["G81", "M6", "G43"].into_iter().all(|code| says(&settings, code)), "{order:?}");
        assert_eq!(settings.get("z_at_change"), "stays", "{order:?}");
        settings.choose("controller", "grbl").expect("an option of the dialect");
        assert!(!["G81", "M6", "G43"].into_iter().any(|code| says(&settings, code)), "{order:?}");
    }
}

/// Every row of a variant is tried by `ncc dialects test`; every one with a meaning is met by a program.
#[test]
fn every_row_of_a_variant_is_met() {
    let mut failures = Failures::default();
    let words: Vec<String> = programs()
        .iter()
        .flat_map(|program| {
            let text = String::from_utf8_lossy(&program.text).into_owned();
            text.split([' ', '\n', '/']).map(str::to_owned).collect::<Vec<_>>()
        })
        .collect();
    let dialect = translate::settings("grbl").dialect;
    let lines = ncc_driver::dialect_test::test(dialect);
    for (variant, _) in dialect.variants() {
        let cycle = |code: &str| variant.cycle.iter().any(|row| row.code == code);
        for row in &variant.code {
            let tried = |line: &ncc_driver::dialect_test::Row| {
                line.row.split(' ').next() == Some(&row.code) && line.row.contains('(')
            };
            if !cycle(&row.code) && !lines.iter().any(tried) {
                failures.add(&row.code, "is not tried".to_owned());
            }
            if row.means.is_some() && !words.contains(&row.code) {
                failures.add(&row.code, "is met by no program".to_owned());
            }
        }
    }
    failures.finish();
}

fn grblhal(marks: &[&str]) -> Settings {
    let mut settings = translate::settings("grbl");
    for (option, value) in OPTIONS.iter().filter(|own| marks.contains(&own.0)).flat_map(|own| own.1) {
        settings.choose(option, value).expect("an option of the dialect");
    }
    settings
}

fn programs() -> Vec<Program> {
    let program = |path: std::path::PathBuf| {
        let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let mark = file.split('.').nth(1).filter(|mark| *mark != "gcode").unwrap_or_default();
        Program { text: fs::read(&path).expect("a program"), settings: grblhal(&["", mark]), file }
    };
    corpus::files(&corpus::root().join("tests/variants/grblhal")).into_iter().map(program).collect()
}

/// A world of a grblHAL: G98 and a lift of 0.1 mm ($28) at the start.
fn world(seed: u32, settings: &Settings) -> World {
    let world = plain::world(seed);
    World {
        break_lift: ONE / 10,
        peck_clearance: ONE,
        behaviours: settings.behaviours(),
        zeroed_by_tool: settings.dialect.can.change_by_hand,
        ..world
    }
}

fn second(settings: &Settings, text: &[u8], world: &World, skip: u16) -> Result<Vec<Plain>, String> {
    let setup = plain::setup(world, skip);
    let machine = match settings.get("controller") {
        "grblhal" => run_hal(text, setup).map_err(|halt| format!("line {}: {}", halt.line, halt.why)),
        _ => plain::second(&settings.dialect.id, text, setup),
    }?;
    Ok(plain::of_machine(&machine, world.start.map(|n| n as f64 / 1e9)))
}

/// Programs without a word that this interpreter leaves out.
fn judged(program: &Program) -> bool {
    !program.file.contains(".axes.")
}

#[test]
fn programs_of_a_grblhal_are_read_as_its_source_has_them() {
    let mut failures = Failures::default();
    let programs = programs();
    assert!(programs.len() >= 20, "{} programs", programs.len());
    for program in &programs {
        let Some(read) =
            failures.check(&program.file, translate::read_as(program.settings.clone(), &program.text))
        else {
            continue;
        };
        for seed in [0, 1, 2] {
            let world = world(seed, &program.settings);
            for skip in [0, 0b10] {
                let start = world.start.map(|n| n as f64 / 1e9);
                let result = translate::execute(&read, &world, skip).and_then(|events| {
                    if !judged(program) {
                        return Ok(());
                    }
                    let expected = second(&program.settings, &program.text, &world, skip)?;
                    plain::compare(&expected, &plain::of_events(&events, start), Tolerance::SAME)
                });
                failures.check(format!("{} world {seed} skip {skip:b}", program.file), result);
            }
        }
        // Grbl 1.1 has none of what they are about.
        let plain = translate::settings("grbl");
        if translate::read_as(plain, &program.text).is_ok() {
            failures.add(&program.file, "Grbl 1.1 reads it too".to_owned());
        }
    }
    failures.finish();
}

/// A Sinumerik that leaves the tool's length out in coordinates of the machine (MD 10760 = 1), and one that counts it:
/// with D1 in the block, with D1 before it, and with another code.
#[test]
fn the_length_in_coordinates_of_the_machine() {
    let mut failures = Failures::default();
    for block in
        ["SUPA G0 Z0 D1", "D1\nSUPA G0 X5 Z0", "G0 Z50 D1\nG153 Z0", "G0 Z50 D1\nG53 Z-5", "SUPA G0 Z0 D0"]
    {
        let text = format!(
            "G710 G17 G90 G94 G54\nT1 M6 D0\nS1000 M3\nG0 X10 Y10\n{block}\nG0 X20 Y20\nZ50 D1\nG1 Z-1 F100\nM30\n"
        );
        for value in ["counted", "suppressed"] {
            let mut settings = translate::settings("siemens");
            settings.choose("machine_length", value).expect("an option of the dialect");
            let what = format!("{block} {value}");
            let Some(read) = failures.check(&what, translate::read_as(settings.clone(), text.as_bytes()))
            else {
                continue;
            };
            for seed in [0, 1, 2] {
                let world = plain::of_dialect(plain::world(seed), "siemens");
                let setup = Setup { length_suppressed: value == "suppressed", ..plain::setup(&world, 0) };
                let start = world.start.map(|n| n as f64 / 1e9);
                let result = plain::second("siemens", text.as_bytes(), setup).and_then(|machine| {
                    let expected = plain::of_machine(&machine, start);
                    let events = translate::execute(&read, &world, 0)?;
                    plain::compare(&expected, &plain::of_events(&events, start), Tolerance::SAME)
                });
                failures.check(&what, result);
            }
        }
    }
    failures.finish();
}

/// What a target makes of a source, by the second interpreter of each.
fn same_moves(job: &Job, source: &[u8], text: &[u8]) -> Result<(), String> {
    let ids = [&*job.from.dialect.id, &*job.to.dialect.id];
    let within = Tolerance {
        corners: Corners::between(ids[0], ids[1]),
        arcs: plain::says_arcs(ids[1]),
        feed: Tolerance::ROUNDED.feed + 0.0005 * 25.4,
        ..Tolerance::ROUNDED
    };
    let by_hand = [&job.from, &job.to].into_iter().any(|side| side.dialect.can.change_by_hand);
    for seed in [0, 1, 2] {
        let world = match job.from.get("controller") {
            "grblhal" => world(seed, &job.from),
            _ => plain::of_dialect(plain::world(seed), ids[0]),
        };
        let world = World { zeroed_by_tool: by_hand, ..world };
        for skip in [0, 0x7fe] {
            let source = besides::for_target(second(&job.from, source, &world, skip)?, job);
            plain::compare(&source, &second(&job.to, text, &world, skip)?, within)?;
        }
    }
    Ok(())
}

#[test]
fn programs_of_a_grblhal_go_to_other_controls() {
    let mut failures = Failures::default();
    let mut released = 0;
    for program in programs() {
        for to in ["grbl", "fanuc", "haas", "siemens", "linuxcnc", "canon"] {
            let what = format!("{} to {to}", program.file);
            let mut job = translate::job("grbl", to, &program.file);
            job.from = program.settings.clone();
            if to == "grbl" {
                job.to = program.settings.clone();
            }
            job.head = false;
            let (outcome, text) = translate::translate(&job, &program.text);
            let refused = REFUSED.iter().any(|(file, others)| *file == program.file && others.contains(&to));
            if outcome.release.is_err() || refused {
                if outcome.release.is_err() != refused {
                    failures.add(&what, format!("refused: {:?}", translate::stopping(&job, &outcome)));
                }
                continue;
            }
            released += 1;
            if judged(&program) && to != "canon" {
                failures.check(&what, same_moves(&job, &program.text, &text));
            }
        }
    }
    println!("{released} released");
    failures.finish();
}

/// The corpus of other controls for a grblHAL: what is released makes the same moves, and has its cycles.
#[test]
fn the_corpus_goes_to_a_grblhal() {
    let mut failures = Failures::default();
    let (mut released, mut cycles) = (0, 0);
    for program in corpus::all().into_iter().filter(|program| program.dialect != "grbl") {
        for marks in [&[""][..], &["", "m6"]] {
            let what = format!("{}/{} to grblHAL {marks:?}", program.dialect, program.file);
            let mut job = translate::straight_job(&program, "grbl");
            job.to = grblhal(marks);
            job.head = false;
            let (outcome, text) = translate::translate(&job, &program.text);
            let bug = outcome.diagnostics.iter().find(|d| (601..=602).contains(&d.fault.code()));
            if let Some(bug) = bug {
                failures.add(&what, format!("{:?}", bug.fault));
            }
            if outcome.release.is_err() {
                continue;
            }
            released += 1;
            let has = |code: &str| text.windows(code.len()).any(|part| part == code.as_bytes());
            cycles += u32::from(["G81", "G82", "G73", "G83"].into_iter().any(has));
            if let Err(fault) = same_moves(&job, &program.text, &text) {
                failures.add(&what, format!("{fault}\n{}", String::from_utf8_lossy(&text)));
            }
        }
    }
    println!("{released} released, {cycles} of them with a cycle");
    failures.finish();
    assert!(released > 300 && cycles > 20, "{released} released, {cycles} with a cycle");
}
