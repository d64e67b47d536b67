//! A program with a clock.
//!
//! Not here: the clock (`ncc_driver::time`), and the forms of what is made of it.

#[cfg(not(target_arch = "wasm32"))]
pub(crate) mod drawn;

use std::io::{self, Write};
use std::sync::Arc;

use codespan_reporting::term::termcolor::Buffer;
use ncc_driver::job::Job;
use ncc_driver::problem::{BrokenOff, Exit, Problem, RequestFault};
use ncc_driver::render::json::entries;
use ncc_driver::render::{About, Loudness, human};
use ncc_driver::side::Side;
use ncc_driver::source::Source;
use ncc_driver::time::assumed;
use ncc_driver::time::drive::{Course, Plan, Stage, Unwatched, drive};
use ncc_driver::time::payload::{Fields, Header, Look, Shape, Writer};
use ncc_driver::time::summary::{Report, Timing};
use ncc_driver::time::tally::{Account, Tallier};
use ncc_machines::Profile;
use ncc_time::{AssumedFact, Model, ToolChangeOn};

use crate::program::{Files, Outputs, machine_for_times, plan, side_on, stands};
use crate::request::{self, Form, Summary, Time};

/// A program, ready to be executed with a clock.
struct Ready {
    side: Side,
    profile: Option<Arc<Profile>>,
    model: Model,
}

impl Ready {
    fn of(asked: &Time, files: &Files, messages: &mut Buffer) -> Result<Ready, Problem> {
        let one = asked.one();
        let profile = machine_for_times(&one, files)?;
        let mut side = side_on(profile.clone(), &one, files, messages)?;
        side.job.start = stands(asked.start.as_deref())?;
        if !(0.0..1e9).contains(&asked.start_time) {
            return Err(RequestFault::StartTime.into());
        }
        let no_model = |name: &str| RequestFault::NoModel(name.to_owned());
        let model = asked.model.as_deref().map(|name| name.parse().map_err(|_| no_model(name)));
        Ok(Ready { side, profile, model: model.transpose()?.unwrap_or_default() })
    }
}

/// The plan of an execution, from the request.
fn planned<'p>(
    asked: &Time,
    job: &'p Job,
    profile: Option<&Profile>,
    model: Model,
) -> (Plan<'p>, Vec<AssumedFact>) {
    let (mut plan, unstated) = plan(job, profile, model);
    plan.start_time = asked.start_time;
    plan.stage = match asked.stage {
        request::Stage::Before => Stage::Before,
        request::Stage::After => Stage::After,
    };
    // Cycles that stand as they are called have no moves along which a centre goes.
    plan.centre = plan.stage == Stage::After;
    if let Some(on) = asked.tool_change_on {
        plan.machine.tool_change_on = match on {
            request::ToolChangeOn::Select => ToolChangeOn::Select,
            request::ToolChangeOn::Change => ToolChangeOn::Change,
        };
    }
    (plan, unstated)
}

/// Times a program.
pub(crate) fn timed(asked: &Time, files: &Files, messages: &mut Buffer) -> Result<(Exit, Outputs), Problem> {
    let cannot = |e: io::Error| Problem::file("time", &asked.file, &e);
    let Ready { side: Side { mut source, job }, profile, model } = Ready::of(asked, files, messages)?;
    let profile = profile.as_deref();
    let (plan, unstated) = planned(asked, &job, profile, model);
    let (fields, machine_name) = match asked.form {
        Form::Document => (Fields::Full, profile.map_or("", |profile| &profile.schema.title)),
        Form::Printed => (Fields::Printed(job.from.dialect), profile.map_or("", |profile| profile.id())),
    };
    let header = Header { prog_name: &asked.file, machine_name, dialect: &job.from.dialect.id };
    let look = Look { shape: Shape::Document, stage: plan.stage, fields };
    let mut times = AtMost { bytes: Vec::new(), most: asked.most.unwrap_or(u64::MAX) };
    let course = {
        let mut sink = Writer::new(&header, &plan.machine, look, &mut times).map_err(cannot)?;
        let course = drive(&plan, &mut source, &mut sink, &mut Unwatched).map_err(cannot)?;
        sink.finish().map_err(cannot)?;
        course
    };
    let shown = source.shown.clone();
    let mut about = About { job: &job, name: &shown, source: &mut source.file };
    human::print(messages, &mut about, &course.diagnostics, Loudness::Usual).map_err(cannot)?;
    let mut outputs = Vec::new();
    if !course.refused {
        outputs.push(("times", times.bytes));
    }
    if asked.findings {
        let found = entries(&mut about, &course.diagnostics, Loudness::Usual).map_err(cannot)?;
        outputs.push(("findings", serde_json::to_vec(&found).unwrap_or_default()));
        let assumed = assumptions(&plan, profile, &unstated, &course);
        outputs.push(("assumed", serde_json::to_vec(&assumed).unwrap_or_default()));
    }
    Ok((if course.refused { Exit::Refused } else { Exit::Done }, outputs))
}

/// Times a program and sums up.
pub(crate) fn summed_up(
    asked: &Summary,
    files: &Files,
    messages: &mut Buffer,
) -> Result<(Exit, Outputs), Problem> {
    summed_up_by(asked, files, messages, |plan, source| {
        let mut tallier = Tallier::new(&plan.machine);
        let course = drive(plan, source, &mut tallier, &mut Unwatched)?;
        Ok((course, tallier.finish()))
    })
}

/// The same, where something else counts.
fn summed_up_by(
    asked: &Summary,
    files: &Files,
    messages: &mut Buffer,
    count: impl FnOnce(&Plan, &mut Source) -> io::Result<(Course, Account)>,
) -> Result<(Exit, Outputs), Problem> {
    let cannot = |e: io::Error| Problem::file("time", &asked.file, &e);
    let asked = asked.time();
    let Ready { side: Side { mut source, job }, profile, model } = Ready::of(&asked, files, messages)?;
    let profile = profile.as_deref();
    let (plan, unstated) = planned(&asked, &job, profile, model);
    let (course, account) = count(&plan, &mut source).map_err(cannot)?;
    let shown = source.shown.clone();
    let mut about = About { job: &job, name: &shown, source: &mut source.file };
    human::print(messages, &mut about, &course.diagnostics, Loudness::Usual).map_err(cannot)?;
    let mut outputs = Vec::new();
    if asked.findings {
        let found = entries(&mut about, &course.diagnostics, Loudness::Usual).map_err(cannot)?;
        let called = source.called.iter().flat_map(|called| &called.files);
        let called: Vec<&str> = called.map(|file| file.name.as_str()).collect();
        outputs.push(("findings", serde_json::to_vec(&found).unwrap_or_default()));
        outputs.push(("called", serde_json::to_vec(&called).unwrap_or_default()));
    }
    if course.refused {
        return Ok((Exit::Refused, outputs));
    }
    let assumed = assumptions(&plan, profile, &unstated, &course);
    let timing = Timing::of(&asked.file, &plan, &course, assumed, account);
    let report = Report {
        ncc_time: 1,
        ncc_version: env!("CARGO_PKG_VERSION"),
        model: model.name(),
        machine: profile.map(|profile| profile.id().to_owned()),
        machine_name: profile.map_or_else(String::new, |profile| profile.schema.title.clone()),
        total: timing.total.clone(),
        programs: vec![timing],
        not_timed: Vec::new(),
    };
    let (mut document, mut tools) = (Vec::new(), Vec::new());
    report.json(&mut document).map_err(cannot)?;
    report.tool_list(&mut tools).map_err(cannot)?;
    outputs.extend([("document", document), ("tools", tools)]);
    Ok((Exit::Done, outputs))
}

/// Facts of machine and control that the times assume, a line each.
fn assumptions(
    plan: &Plan,
    profile: Option<&Profile>,
    unstated: &[AssumedFact],
    course: &Course,
) -> Vec<String> {
    let mut lines = profile.map(assumed::of_profile).unwrap_or_default();
    lines.extend(assumed::of_machine(plan, unstated, course));
    lines.extend(assumed::of_run(plan, course));
    lines.extend(assumed::of_program(plan.job, &course.diagnostics));
    lines
}

/// Bytes in memory up to a number of them: a loop of a few lines can make any number of moves.
struct AtMost {
    bytes: Vec<u8>,
    most: u64,
}

impl Write for AtMost {
    fn write(&mut self, piece: &[u8]) -> io::Result<usize> {
        if (self.bytes.len() + piece.len()) as u64 > self.most {
            return Err(io::Error::other(BrokenOff::LongOutput(self.most)));
        }
        self.bytes.extend_from_slice(piece);
        Ok(piece.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
