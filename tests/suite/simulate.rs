//! `ncc simulate`: a program and its port make the same part, whatever the comparison of events says of them; and the
//! document is as its schema says.

use std::collections::BTreeMap;
use std::io::Cursor;

use ncc_driver::job::{Failure, Job};
use ncc_driver::questions::Policy;
use ncc_driver::simulate::compare::Between;
use ncc_driver::simulate::cut::{Bench, CutProgram, Uncut, cut};
use ncc_driver::simulate::document::{self, About};
use ncc_driver::simulate::path::{Path, Recorder};
use ncc_driver::simulate::surroundings::Surroundings;
use ncc_driver::simulate::{files, told, tooling};
use ncc_driver::source::Source;
use ncc_driver::time::drive::{Plan, Stage, Unwatched, drive};
use ncc_exec::world::Tables;
use ncc_simulate::Stock;
use ncc_tests::corpus::{self, DIALECTS};
use ncc_tests::expect::Failures;
use ncc_tests::translate::{job, settings, translate};
use ncc_time::{Machine, Model};
use serde_json::Value;

use crate::schema;

/// Cells along the longer side of a part: coarse, because each height is exact at the centre of its cell.
const CELLS: usize = 96;

/// Programs that are no judgement of their ports: the target writes places of the machine as computed numbers, which nobody
/// can tell from places of the part.
const OF_MACHINE: [&str; 1] = ["linuxcnc/dressing.ngc"];

/// How far heights of one part may be apart, mm: targets round to a thousandth of a millimetre, arcs by both ends.
const APART: f64 = 0.01;

/// The moves of a text, if its dialect's control carries it out.
fn moves(dialect: &str, name: &str, text: &[u8]) -> Option<(Path, Source)> {
    let own = settings(dialect);
    let job = Job { questions: Policy::Assume, ..Job::new(own.clone(), own, name) };
    let plan = Plan {
        job: &job,
        machine: Machine::default(),
        tables: Tables::default(),
        parameters: [None; 2],
        model: Model::Ideal,
        skip: 0,
        start_time: 0.0,
        stage: Stage::After,
        centre: false,
    };
    let mut source = Source::of(Cursor::new(text.to_vec()), name);
    let mut recorder = Recorder::new(&plan.tables, false);
    let course = drive(&plan, &mut source, &mut recorder, &mut Unwatched).expect("memory");
    (!course.refused).then(|| (recorder.finish(), source))
}

fn cut_out(path: Path, stock: Option<Stock>) -> Result<CutProgram, Uncut> {
    let tools = tooling::tools(&path, &BTreeMap::new(), None).expect("tools that can be guessed");
    cut(
        path,
        tools,
        Bench { guessed: stock.is_none(), stock, fixtures: Vec::new(), table: None, cells: CELLS },
    )
}

/// Every program of the corpus, and what it becomes for another control, cut out of one raw part.
#[test]
fn a_port_makes_the_same_part() {
    let schema: Value = serde_json::from_str(document::SCHEMA).expect("JSON");
    let mut failures = Failures::default();
    let (mut parts, mut removed, mut alarms) = (0, 0.0, 0);
    for (n, program) in corpus::all().into_iter().enumerate() {
        let what = format!("{}/{}", program.dialect, program.file);
        let Some((path, mut source)) = moves(program.dialect, &program.file, &program.text) else { continue };
        let Ok(own) = cut_out(path, None) else { continue };
        let (boxes, _) = told::alarms(&own, &mut source).expect("memory");
        let around = Surroundings::default();
        let about = About { source: &program.file, dialect: program.dialect, assumed: &[], around: &around };
        let mut text = Vec::new();
        document::write(&mut text, &[(about, &own, &boxes)], None).expect("memory");
        let document: Value = serde_json::from_slice(&text).expect("JSON");
        let wrong = schema::faults_by(&schema, &document);
        if !wrong.is_empty() {
            failures.add(&what, wrong.join("\n"));
        }
        alarms += boxes.len();
        if OF_MACHINE.contains(&what.as_str()) {
            continue;
        }
        // Each program has another target.
        let targets = DIALECTS.into_iter().cycle().skip(n).take(DIALECTS.len());
        let ports = targets.filter(|to| *to != program.dialect).filter_map(|to| {
            let (outcome, text) = translate(&job(program.dialect, to, &program.file), &program.text);
            matches!(outcome.release, Ok(()) | Err(Failure::Refused)).then_some(())?;
            outcome.release.ok().map(|()| (to, text))
        });
        for (to, text) in ports.take(1) {
            let Some((path, _)) = moves(to, &program.file, &text) else { continue };
            // Numbers of tools that only one of both says are no matter of the part.
            match cut_out(path, Some(own.simulation.setup().stock.clone())) {
                Ok(port) => {
                    let maps = [&own, &port].map(|own| own.simulation.map());
                    let between = Between::of(maps[0], maps[1], files::floor(&own));
                    if !between.is_within(APART) {
                        failures.add(format!("{what} to {to}"), format!("{between:?}"));
                    }
                    parts += 1;
                    removed += own.volume();
                }
                Err(uncut) => failures.add(format!("{what} to {to}"), format!("{uncut:?}")),
            }
        }
    }
    println!("{parts} parts are the same twice, {removed:.0} mm³ removed, {alarms} alarms");
    assert!(parts > 100, "{parts}");
    failures.finish();
}
