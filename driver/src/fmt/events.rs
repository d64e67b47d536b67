//! Whether two texts of one dialect do the same: both are executed in the worlds of a verification, with
//! all block-skip switches off and with all of them on, and what they do is held against each other.
//!
//! Both must do exactly the same, to the last digit: only places in the text may differ. What is compared
//! is a digest of all events, so that memory does not grow with the program. Not here: whether the texts
//! have the same words (`same`), which goes further than two settings of the switches do.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::io;
use std::ops::ControlFlow;

use ncc_exec::{Event, Exec, Kind};
use ncc_ir::diag::{Diagnostic, Fault};

use crate::job::Job;
use crate::review::stream::{Made, clearances, stream, worlds};
use crate::source::Readable;

/// What a comparison found out.
#[derive(Debug)]
pub enum Compared {
    /// Both do the same; how many events were compared.
    Same(u64),
    /// They do not.
    Different,
    /// The first text cannot be executed; its first error, if one is known, and whether it is no text.
    NotExecuted(Box<Option<Diagnostic>>, bool),
}

/// Executes and compares; what the first text is found to assume goes to `assumed`.
///
/// # Errors
/// Reading.
pub fn compare(
    job: &Job,
    before: &mut dyn Readable,
    after: &mut dyn Readable,
    assumed: &mut Vec<Diagnostic>,
) -> io::Result<Compared> {
    let (done, levels) = digest(job, before, 0, assumed)?;
    let mut events = match &done {
        Done::Executed(_, events) => *events,
        Done::Refused(first, no_text) => return Ok(Compared::NotExecuted(first.clone(), *no_text)),
    };
    if done != digest(job, after, 0, &mut Vec::new())?.0 {
        return Ok(Compared::Different);
    }
    if levels != 0 {
        let skipped = digest(job, before, levels, &mut Vec::new())?.0;
        match &skipped {
            Done::Executed(_, more) => events += more,
            // With blocks skipped the program may have no sense; then nothing is known of that way.
            Done::Refused(..) => return Ok(Compared::Same(events)),
        }
        if skipped != digest(job, after, levels, &mut Vec::new())?.0 {
            return Ok(Compared::Different);
        }
    }
    Ok(Compared::Same(events))
}

#[derive(Debug)]
enum Done {
    /// The digest, and how many events went into it.
    Executed(u64, u64),
    Refused(Box<Option<Diagnostic>>, bool),
}

impl PartialEq for Done {
    fn eq(&self, other: &Done) -> bool {
        match (self, other) {
            (Done::Executed(a, n), Done::Executed(b, m)) => (a, n) == (b, m),
            (Done::Refused(..), _) | (_, Done::Refused(..)) => false,
        }
    }
}

/// The digest of what a text does, and the skip levels that occur in it.
fn digest(
    job: &Job,
    file: &mut dyn Readable,
    skip: u16,
    assumed: &mut Vec<Diagnostic>,
) -> io::Result<(Done, u16)> {
    let controls: Vec<Exec> =
        worlds(job, clearances(job)).iter().map(|world| Exec::new(world, skip)).collect();
    let mut hashers = vec![DefaultHasher::new(); controls.len()];
    let mut events = 0;
    let course = stream(job, file, controls, &mut |made: Made| {
        for (control, hasher) in made.controls.iter().zip(&mut hashers) {
            events += control.events.len() as u64;
            control.events.iter().for_each(|event| take(event, hasher));
        }
        ControlFlow::Continue(())
    })?;
    assumed.extend(course.diagnostics.iter().cloned());
    if course.refused {
        let no_text = course.diagnostics.iter().any(|d| d.fault == Fault::NotText);
        let is_error = |d: &&Diagnostic| d.fault.gravity() == ncc_ir::diag::Gravity::Error;
        let first = course.diagnostics.iter().find(is_error).cloned();
        return Ok((Done::Refused(Box::new(first), no_text), course.skip_levels));
    }
    let mut all = DefaultHasher::new();
    hashers.iter().for_each(|hasher| hasher.finish().hash(&mut all));
    Ok((Done::Executed(all.finish(), events), course.skip_levels))
}

/// All of an event but its place.
fn take(event: &Event, into: &mut DefaultHasher) {
    let Event { kind, end, rate, state, inch, span: _ } = event;
    std::mem::discriminant(kind).hash(into);
    match kind {
        Kind::Arc { plane, turn, full, centre } => (plane, turn, full, centre).hash(into),
        Kind::Synchronised { pitch, chuck } => (pitch, chuck).hash(into),
        Kind::Probe { to, probe } => (to, probe).hash(into),
        Kind::Dwell(value) | Kind::Orient(value) => value.hash(into),
        Kind::MachineFunction(text) | Kind::Message(text) => text.hash(into),
        Kind::Output(written) => written.hash(into),
        Kind::Alarm(number, text) => (number, text).hash(into),
        Kind::Data(stored) => stored.hash(into),
        Kind::Tilt(plane) => plane.as_ref().map(ToString::to_string).hash(into),
        Kind::OrientToolAxis(toward) => toward.hash(into),
        Kind::Traverse
        | Kind::Feed
        | Kind::ToolChange
        | Kind::Coolant
        | Kind::ProgramStop
        | Kind::OptionalProgramStop
        | Kind::ProgramEnd
        | Kind::BeginAgain
        | Kind::TextEnd
        // Made only where functions are narrated.
        | Kind::Attribute(_) => {}
    }
    (end, rate, inch).hash(into);
    (state.tool, state.speed, state.spindle, state.flood, state.mist).hash(into);
    (state.tip, state.tilted, state.turned, state.one_side).hash(into);
    (state.compensation.side, state.compensation.radius).hash(into);
    (state.compensation.gap, state.compensation.again).hash(into);
    (
        state.compensation.plane,
        state.advice,
        (state.limit, state.centre),
        state.within,
        state.spindle_mode,
        state.feed_mode,
        state.path,
    )
        .hash(into);
}
