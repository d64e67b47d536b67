//! One program of a call: its machine, its options, and its run; what is written of it goes to a spool first.
//!
//! ```text
//! job, plan, execute    a program with its machine, executed with a clock
//! ```

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use codespan_reporting::term::termcolor::WriteColor;
use ncc_dialects::{BREAK_LIFT, PECK_CLEARANCE};
use ncc_driver::guess::better;
use ncc_driver::job::options::{choose, state_units};
use ncc_driver::job::{Job, Output};
use ncc_driver::machines::pair::Machines;
use ncc_driver::problem::Problem;
use ncc_driver::questions;
use ncc_driver::render::About;
use ncc_driver::render::human;
use ncc_driver::source::{Source, include_path};
use ncc_driver::time::assumed;
use ncc_driver::time::drive::{Course, Plan, Sink, Stage, drive};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_machines::Profile;
use ncc_machines::reading::Side;
use ncc_time::{AssumedFact, Machine};

use super::args::Time;
use super::progress::Progress;
use crate::files::{self, Destination};
use crate::m_codes;
use crate::registry::DialectRegistry;
use crate::registry::recognised::recognise_all;

/// The machine of a call, as the model sees it.
pub(crate) struct Shop {
    pub(crate) profile: Option<Profile>,
    pub(super) machine: Machine,
    /// What the model takes for granted of it.
    assumed: Vec<AssumedFact>,
}

impl Shop {
    /// `own` is the machine of a project file, which counts where the command line names none.
    pub(crate) fn of(
        args: &Time,
        own: Option<&Profile>,
        known: &DialectRegistry,
        err: &mut dyn WriteColor,
    ) -> Result<Shop, Problem> {
        let profile = match &args.setting.machine {
            Some(name) => Some(crate::machines::find_for_times(name, known, err)?),
            None => own.cloned(),
        };
        let mut machine = profile.as_ref().map(Profile::machine).unwrap_or_default();
        if let Some(on) = args.setting.tool_change_on {
            machine.tool_change_on = on;
        }
        let (machine, assumed) = machine.assumed(args.setting.model);
        Ok(Shop { profile, machine, assumed })
    }

    /// The short name of the machine.
    pub(super) fn id(&self) -> &str {
        self.profile.as_ref().map_or("", Profile::id)
    }

    pub(crate) fn title(&self) -> &str {
        self.profile.as_ref().map_or("", |p| &p.schema.title)
    }
}

pub(super) fn destination(args: &Time, sources: &[Source]) -> Result<Destination, Problem> {
    let name: Option<&PathBuf> = args.output.as_ref().filter(|name| *name != Path::new("-"));
    for source in sources {
        source.guard(name.map(PathBuf::as_path))?;
    }
    Ok(name.map_or(Destination::Stdout, |name| Destination::File(name.clone())))
}

/// What is written before it may be used.
#[derive(Default)]
pub(super) struct Spool {
    pub(super) output: Output,
}

impl Write for Spool {
    fn write(&mut self, text: &[u8]) -> io::Result<usize> {
        self.output.push(text)?;
        Ok(text.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// A program as a translation into itself: so its diagnostics are told.
pub(crate) fn job(
    args: &Time,
    shop: &Shop,
    known: &DialectRegistry,
    source: &mut Source,
    err: &mut dyn WriteColor,
) -> Result<Job, Problem> {
    let own = shop.profile.as_ref();
    let named = match (args.reading.from.as_deref(), own) {
        (Some("auto"), _) | (None, None) => None,
        (None, Some(profile)) if profile.any_control => None,
        (Some(id), _) => Some(known.dialect(id)?),
        (None, Some(profile)) => Some(profile.dialect),
    };
    let (dialect, rivals) = match named {
        Some(dialect) => (dialect, Vec::new()),
        None => recognise_all(source, !args.telling.quiet, known, err)?,
    };
    // What a profile states of its control holds for programs in that control's language.
    let machines = match own.filter(|profile| profile.dialect.id == dialect.id) {
        Some(profile) => {
            let profile = Arc::new(profile.clone());
            Machines { from: Some(Arc::clone(&profile)), to: Some(profile) }
        }
        None => Machines::default(),
    };
    let mut from = choose(machines.settings(Side::From, dialect), &args.reading.from_option)?;
    state_units(&mut from, known.units())?;
    m_codes::state(&mut from, Side::From, known)?;
    include_path::load_subprograms(source, &from, known.folders(), &files::Disk)?;
    source.rewind()?;
    Ok(Job {
        machines,
        called: source.called.clone(),
        project: source.project.clone(),
        rivals,
        start: args.setting.standing.start.unwrap_or_default(),
        given: args.setting.holding.read()?,
        ..Job::new(from.clone(), from, &source.name)
    })
}

pub(crate) fn plan<'p>(args: &Time, shop: &Shop, job: &'p Job) -> Plan<'p> {
    Plan {
        job,
        machine: shop.machine.clone(),
        tables: shop.profile.as_ref().map(Profile::tables).unwrap_or_default(),
        parameters: [PECK_CLEARANCE, BREAK_LIFT].map(|option| own_parameter(shop.profile.as_ref()?, option)),
        model: args.setting.model,
        skip: args.setting.switches.on(),
        start_time: args.setting.start_time,
        stage: args.stage.into(),
        // Cycles that are told as they are called have no times.
        centre: Stage::from(args.stage) == Stage::After,
    }
}

/// What a machine's profile states of a parameter of its control, for programs in a language that has no
/// such option.
fn own_parameter(profile: &Profile, option: &str) -> Option<Nanos> {
    let stated = profile.schema.options.iter().find(|(name, _)| name.get_ref() == option)?;
    let mm: f64 = stated.1.value.as_ref()?.0.parse().ok()?;
    Some((mm * ONE as f64).round() as Nanos)
}

/// Executes a program and tells what was found.
pub(crate) fn execute(
    args: &Time,
    plan: &Plan,
    known: &DialectRegistry,
    source: &mut Source,
    sink: &mut dyn Sink,
    err: &mut dyn WriteColor,
) -> Result<Course, Problem> {
    let bytes = source.bytes().unwrap_or_default();
    let course = {
        let mut progress = Progress::new(&source.name, bytes, !args.telling.quiet);
        drive(plan, source, sink, &mut progress).map_err(|e| Problem::file("time", &source.shown, &e))?
    };
    if !args.telling.quiet {
        questions::note(plan.job, source, &course.diagnostics, !course.refused, err)?;
    }
    // Messages that cannot be written change nothing about what was done.
    let _ = tell(args, plan, known, source, &course, err);
    Ok(course)
}

fn tell(
    args: &Time,
    plan: &Plan,
    known: &DialectRegistry,
    source: &mut Source,
    course: &Course,
    err: &mut dyn WriteColor,
) -> io::Result<()> {
    let loudness = args.telling.loudness();
    let shown = source.shown.clone();
    let other = match course.refused {
        false => None,
        true => better(&mut source.file, &plan.job.from, known.all())?,
    };
    let mut about = About { job: plan.job, name: &shown, source: &mut source.file };
    // What is wrong with a text in another language is nothing that anybody wants to know.
    if other.is_none() || args.telling.quiet {
        human::print(err, &mut about, &course.diagnostics, loudness)?;
    }
    if course.refused && !args.telling.quiet {
        let others = args.files.len() > 1 && args.form.takes_several();
        let rest = if others { "" } else { "; nothing was written" };
        writeln!(err, "{shown}: not timed{rest}")?;
        if let Some((other, reasons)) = other {
            let read = &plan.job.from.dialect.id;
            writeln!(err, "{shown} reads like {}: {}", other.id, reasons.join(", "))?;
            writeln!(err, "  it was read as {read}, in which it has errors\n  help: --from {}", other.id)?;
        }
    }
    err.flush()
}

/// Assumptions of a program's timing, a line each.
pub(crate) fn assumptions(shop: &Shop, plan: &Plan, course: &Course) -> Vec<String> {
    let mut lines = Vec::new();
    let dialect = plan.job.from.dialect;
    match &shop.profile {
        None => lines.push("no machine is named".to_owned()),
        // Canonical text and the text form are nobody's language.
        Some(_) if dialect.caps.flat || dialect.can.everything => {}
        Some(profile) if profile.any_control => {}
        Some(profile) if profile.dialect.id != dialect.id => {
            lines.push(format!(
                "the machine, whose control reads {}, carries it out all the same",
                profile.dialect.id
            ));
        }
        Some(_) => {}
    }
    if let Some(profile) = &shop.profile {
        lines.extend(assumed::of_profile(profile));
    }
    lines.extend(assumed::of_machine(plan, &shop.assumed, course));
    lines.extend(assumed::of_run(plan, course));
    lines.extend(assumed::of_program(plan.job, &course.diagnostics));
    lines
}
