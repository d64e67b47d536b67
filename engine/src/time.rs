//! A program with a clock.
//!
//! Not here: the clock (`ncc_driver::time`), and the form of the document (`ncc_driver::time::payload`).

use std::io::{self, Write};

use codespan_reporting::term::termcolor::Buffer;
use ncc_driver::problem::{BrokenOff, Exit, Problem, RequestFault};
use ncc_driver::render::json::entries;
use ncc_driver::render::{About, Loudness, human};
use ncc_driver::side::Side;
use ncc_driver::time::drive::{Stage, Unwatched, drive};
use ncc_driver::time::payload::{Fields, Header, Look, Shape, Writer};
use ncc_time::ToolChangeOn;

use crate::program::{Files, Outputs, machine_for_times, plan, side_on, stands};
use crate::request::{self, Form, Time};

/// Times a program.
pub(crate) fn timed(asked: &Time, files: &Files, messages: &mut Buffer) -> Result<(Exit, Outputs), Problem> {
    let cannot = |e: io::Error| Problem::file("time", &asked.file, &e);
    let one = asked.one();
    let profile = machine_for_times(&one, files)?;
    let Side { mut source, mut job } = side_on(profile.clone(), &one, files, messages)?;
    job.start = stands(asked.start.as_deref())?;
    if !(0.0..1e9).contains(&asked.start_time) {
        return Err(RequestFault::StartTime.into());
    }
    let no_model = |name: &str| RequestFault::NoModel(name.to_owned());
    let model = asked.model.as_deref().map(|name| name.parse().map_err(|_| no_model(name))).transpose()?;
    let (mut plan, _) = plan(&job, profile.as_deref(), model.unwrap_or_default());
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
    let profile = profile.as_deref();
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
    }
    Ok((if course.refused { Exit::Refused } else { Exit::Done }, outputs))
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
