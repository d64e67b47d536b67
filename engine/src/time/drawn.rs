//! Charts and the counts of a setup sheet, for hosts that are no page.

use std::io;

use codespan_reporting::term::termcolor::Buffer;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::render::{About, Loudness, human};
use ncc_driver::side::Side;
use ncc_driver::time::drive::{Unwatched, drive};
use ncc_driver::time::recorder::Recorder;
use ncc_driver::time::tally::Tallier;
use ncc_driver::time::used::{Noted, offsets};
use ncc_plot::Record;
use serde_json::json;

use super::{Ready, planned, summed_up_by};
use crate::program::{Files, Outputs};
use crate::request::Summary;
use crate::request::drawn::{Chart, ChartName};

impl From<ChartName> for ncc_plot::Chart {
    fn from(name: ChartName) -> ncc_plot::Chart {
        match name {
            ChartName::Speed => ncc_plot::Chart::Speed,
            ChartName::Tool => ncc_plot::Chart::Tool,
            ChartName::Feed => ncc_plot::Chart::Feed,
            ChartName::Position => ncc_plot::Chart::Position,
        }
    }
}

/// Draws a program over time.
pub(crate) fn chart(asked: &Chart, files: &Files, messages: &mut Buffer) -> Result<(Exit, Outputs), Problem> {
    let timed = asked.of.time();
    let cannot = |e: io::Error| Problem::file("time", &timed.file, &e);
    let Ready { side: Side { mut source, job }, profile, model } = Ready::of(&timed, files, messages)?;
    let (mut plan, _) = planned(&timed, &job, profile.as_deref(), model);
    // The picture is that of the contour, as of `ncc plot`.
    plan.centre = false;
    let mut recorder = Recorder(Record::new(&timed.file));
    let course = drive(&plan, &mut source, &mut recorder, &mut Unwatched).map_err(cannot)?;
    let shown = source.shown.clone();
    let mut about = About { job: &job, name: &shown, source: &mut source.file };
    human::print(messages, &mut about, &course.diagnostics, Loudness::Usual).map_err(cannot)?;
    if course.refused {
        return Ok((Exit::Refused, Vec::new()));
    }
    let mut record = recorder.0;
    record.finish();
    let charts: Vec<ncc_plot::Chart> = match asked.charts.as_slice() {
        [] => ncc_plot::Chart::ALL.to_vec(),
        some => some.iter().map(|name| (*name).into()).collect(),
    };
    let on = profile.as_deref().map_or("no machine", |profile| &profile.schema.title);
    let caption = format!("{on} \u{b7} model {}", model.name());
    let picture = ncc_plot::charts(&[&record], &charts, &caption);
    Ok((Exit::Done, vec![("picture", picture.into_bytes())]))
}

/// Sums up for a setup sheet.
pub(crate) fn sheet(
    asked: &Summary,
    files: &Files,
    messages: &mut Buffer,
) -> Result<(Exit, Outputs), Problem> {
    let mut used = Vec::new();
    let (exit, mut outputs) = summed_up_by(asked, files, messages, |plan, source| {
        let mut noted = Noted { tallier: Tallier::new(&plan.machine), cooled: Vec::new() };
        let course = drive(plan, source, &mut noted, &mut Unwatched)?;
        let offsets = offsets(&course.offsets, plan.job.from.dialect);
        used = serde_json::to_vec(&json!({ "tools": noted.cooled, "offsets": offsets })).unwrap_or_default();
        Ok((course, noted.tallier.finish()))
    })?;
    outputs.push(("used", used));
    Ok((exit, outputs))
}
