//! A program of which every function is told: as CSV, as the case study's document, as canonical functions.
//!
//! ```text
//! ncc time --as csv part.nc    n,block,function_name,…
//! ```

use std::io::{self, BufReader, BufWriter, Seek, SeekFrom, Write};

use codespan_reporting::term::termcolor::WriteColor;
use ncc_dialects::Settings;
use ncc_driver::job::{Failure, Job};
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::questions::{self, Policy};
use ncc_driver::render::{About, Loudness, human, summary as account};
use ncc_driver::source::Source;
use ncc_driver::time::drive::{Course, Plan, Stage};
use ncc_driver::time::payload::{self, Fields, Header, Look, Shape};
use ncc_driver::time::{canon, csv, duration};
use ncc_driver::translate::translate;
use ncc_ir::canon::Axis;

use super::args::{Form, Time};
use super::course::{Shop, Spool, assumptions, execute, job, plan};
use crate::registry::DialectRegistry;

/// A program of which every function is told.
pub(super) fn stream(
    args: &Time,
    shop: &Shop,
    known: &DialectRegistry,
    source: &mut Source,
    spool: &mut Spool,
    err: &mut dyn WriteColor,
) -> Result<Exit, Problem> {
    let job = job(args, shop, known, source, err)?;
    let name = source.name.clone();
    let cannot = |e: io::Error| Problem::file("time", &name, &e);
    let plan = plan(args, shop, &job);
    let mut out = BufWriter::with_capacity(1 << 16, spool);
    let course = match args.form {
        Form::Csv => {
            let mut sink = csv::Csv::new(&shop.machine, &mut out).map_err(cannot)?;
            let course = execute(args, &plan, known, source, &mut sink, err)?;
            sink.finish().map_err(cannot)?;
            course
        }
        Form::Canon => match canonical(args, shop, &plan, source, &mut out, err)? {
            Ok(course) => course,
            Err(failure) => return Ok(failure.exit()),
        },
        Form::Payload
        | Form::PayloadPrinted
        | Form::Ndjson
        | Form::Summary
        | Form::Json
        | Form::Markdown
        | Form::Tools => {
            let dialect = job.from.dialect;
            let shape = match args.form {
                Form::Ndjson => Shape::Lines,
                _ => Shape::Document,
            };
            let (fields, machine_name) = match args.form {
                Form::PayloadPrinted => (Fields::Printed(dialect), shop.id()),
                _ => (Fields::Full, shop.title()),
            };
            let header = Header { prog_name: &name, machine_name, dialect: &dialect.id };
            let look = Look { shape, stage: Stage::from(args.stage), fields };
            let sink = payload::Writer::new(&header, &shop.machine, look, &mut out);
            let mut sink = sink.map_err(cannot)?;
            let course = execute(args, &plan, known, source, &mut sink, err)?;
            sink.finish().map_err(cannot)?;
            course
        }
    };
    out.flush().map_err(cannot)?;
    drop(out);
    if course.refused {
        return Ok(Exit::Refused);
    }
    if !args.telling.quiet {
        let _ = say(args, shop, &plan, &course, &source.shown, err);
    }
    Ok(Exit::Done)
}

/// The account of a program that does not tell it itself.
pub(crate) fn say(
    args: &Time,
    shop: &Shop,
    plan: &Plan,
    course: &Course,
    shown: &str,
    err: &mut dyn Write,
) -> io::Result<()> {
    let on = if shop.title().is_empty() { "no machine" } else { shop.title() };
    let end = duration::hms(course.end);
    match Stage::from(args.stage) {
        Stage::After => writeln!(err, "{shown}: over at {end} on {on}, model {}", args.setting.model.name())?,
        Stage::Before => writeln!(err, "{shown}: before processing, without times")?,
    }
    for (i, line) in assumptions(shop, plan, course).iter().enumerate() {
        writeln!(err, "  {:<13}{line}", if i == 0 { "assumed" } else { "" })?;
    }
    Ok(())
}

/// The program as canonical functions, with times.
fn canonical(
    args: &Time,
    shop: &Shop,
    first: &Plan,
    source: &mut Source,
    out: &mut dyn Write,
    err: &mut dyn WriteColor,
) -> Result<Result<Course, Failure>, Problem> {
    let known = DialectRegistry::built_in();
    let shown = source.shown.clone();
    let cannot = |e: io::Error| Problem::file("time", &shown, &e);
    let to = Settings::new(known.dialect("canon")?);
    // Rotary axes that nobody has placed are not named in the text either.
    let mut start = first.job.start;
    for axis in Axis::ALL.into_iter().filter(|axis| !axis.is_rotary()) {
        start[axis as usize].get_or_insert(0);
    }
    let job = Job { to: to.clone(), start, questions: Policy::Skip, ..first.job.clone() };
    let mut outcome = translate(&job, &mut source.file).map_err(cannot)?;
    if !args.telling.quiet {
        questions::note(first.job, source, &outcome.diagnostics, outcome.release.is_ok(), err)?;
    }
    if let Err(failure) = outcome.release {
        let mut about = About { job: &job, name: &shown, source: &mut source.file };
        let _ = human::print(err, &mut about, &outcome.diagnostics, Loudness::Usual);
        let _ = account::print(err, &mut about, &outcome);
        return Ok(Err(failure));
    }
    let mut file = ncc_driver::source::spool::Spool::default();
    outcome.output.write_to(&mut file).map_err(cannot)?;
    file.seek(SeekFrom::Start(0)).map_err(cannot)?;
    // A reader of its own: the other one is somewhere else in the text.
    let mut again = ncc_driver::source::spool::Spool::default();
    outcome.output.write_to(&mut again).map_err(cannot)?;
    again.seek(SeekFrom::Start(0)).map_err(cannot)?;
    let mut text = Source::of(file, &source.name);
    let second = Job { from: to.clone(), to, start, called: None, ..first.job.clone() };
    // Each function of the text has its own line.
    let plan =
        Plan { job: &second, machine: shop.machine.clone(), centre: false, ..plan(args, shop, &second) };
    let mut sink = canon::Canon::new(BufReader::new(again), out);
    let mut course = execute(args, &plan, &known, &mut text, &mut sink, err)?;
    sink.finish().map_err(cannot)?;
    // What was taken for granted of the source; the canonical text states what it means.
    course.diagnostics = outcome.diagnostics;
    Ok(Ok(course))
}
