//! `ncc time`: when everything in a program happens, and how long it takes.
//!
//! `drive` goes from the text to functions with times; each form of output is a sink that takes them
//! one by one (`csv`, `payload`, `canon`, `tally` for the summaries). What is written goes to a temporary file
//! first, as a translation does, and is released when the whole program could be
//! executed. Not here: models (ncc-time), machines (ncc-machines), pictures.
//!
//! ```text
//! ncc time --from fanuc part.nc    4 min 12 s, by tool and kind of move
//! ```

pub mod args;
mod progress;
pub(crate) mod running;

use std::io::{self, BufReader, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use codespan_reporting::term::termcolor::WriteColor;
use ncc_dialects::{BREAK_LIFT, PECK_CLEARANCE, Settings};
use ncc_driver::guess::better;
use ncc_driver::job::options::{choose, state_units};
use ncc_driver::job::{Failure, Job, Output};
use ncc_driver::machines::pair::Machines;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::questions::{self, Policy};
use ncc_driver::render::{About, summary as account};
use ncc_driver::render::{Loudness, human};
use ncc_driver::source::{Source, include_path};
use ncc_driver::time::drive::{Course, Plan, Sink, Stage, drive};
use ncc_driver::time::payload::{self, Header};
use ncc_driver::time::{assumed, canon, columns, csv, duration};
use ncc_ir::canon::Axis;
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_machines::Profile;
use ncc_machines::reading::Side;
use ncc_time::{AssumedFact, Machine};

use self::args::{Form, Time};
use self::progress::Progress;
use crate::files::{self, Destination};
use crate::m_codes;
use crate::milling::{self, Voice};
use crate::project::{self, Sides, Stated};
use crate::registry::DialectRegistry;
use crate::registry::recognised::recognise_all;
pub use ncc_driver::time::payload::SCHEMA;
use ncc_driver::time::summary::Report;
use ncc_driver::time::summary::Timing;
use ncc_driver::time::tally::Tallier;
use ncc_driver::time::tally::Tally;
use ncc_driver::translate::translate;

/// The machine of a call, as the model sees it.
pub(crate) struct Shop {
    pub(crate) profile: Option<Profile>,
    machine: Machine,
    /// What the model assumes of it.
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
            Some(name) => Some(crate::machines::find(name, known, err)?),
            None => own.cloned(),
        };
        let mut machine = profile.as_ref().map(Profile::machine).unwrap_or_default();
        if let Some(on) = args.setting.tool_change_on {
            machine.tool_change_on = on;
        }
        let (machine, assumed) = machine.assumed(args.setting.model);
        Ok(Shop { profile, machine, assumed })
    }

    pub(crate) fn title(&self) -> &str {
        self.profile.as_ref().map_or("", |p| &p.schema.title)
    }
}

/// Runs the verb.
///
/// # Errors
/// Wrong usage, or a file that cannot be read or written. What is wrong with a program is reported on
/// `err`.
pub fn run(args: &Time, known: &DialectRegistry, err: &mut dyn WriteColor) -> Result<Exit, Problem> {
    if args.schema {
        files::to_stdout(&mut |out| out.write_all(SCHEMA.as_bytes()))?;
        return Ok(Exit::Done);
    }
    check(args, known)?;
    let mut own = None;
    let mut lost = Lost { names: Vec::new(), exit: Exit::Done };
    let mut sources = Vec::new();
    let voice = if args.telling.quiet { Voice::Quiet } else { Voice::Human };
    for path in &args.files {
        match milling::open(path, voice, known, err) {
            Ok(mut source) => {
                let machine = settle(args, path, &mut source, known, err)?;
                if let Some((_, first)) = own.as_ref().filter(|(own, _)| !same(own, &machine)) {
                    return Err(Problem::usage(
                        format!("{first} and {} are for two machines", source.shown),
                        "call ncc once for each of them, or name one machine: --machine MACHINE",
                    ));
                }
                own.get_or_insert((machine, source.shown.clone()));
                sources.push(source);
            }
            Err(problem) => lost.take(args, path.display().to_string(), problem, err)?,
        }
    }
    let own = own.and_then(|(machine, _)| machine);
    let shop = Shop::of(args, own.as_ref().map(|(profile, _)| &**profile), known, err)?;
    let destination = destination(args, &sources)?;
    destination.check()?;
    let mut spool = Spool { output: Output::new() };
    match args.form {
        Form::Summary | Form::Json | Form::Markdown | Form::Tools => {
            let report = summaries(args, &shop, known, &mut sources, &mut lost, err)?;
            if !report.programs.is_empty() {
                write_report(args, &report, &mut spool)
                    .map_err(|e| Problem::file("write", "the summary", &e))?;
                match (args.form, &destination) {
                    (Form::Summary, Destination::Stdout) => {
                        files::to_stdout(&mut |out| spool.output.write_to(out))?;
                    }
                    _ => destination.release(&mut spool.output)?,
                }
            }
            Ok(lost.exit)
        }
        Form::Csv | Form::Payload | Form::Ndjson | Form::Canon => {
            let exit = match sources.first_mut() {
                Some(source) => stream(args, &shop, known, source, &mut spool, err)?,
                None => Exit::Usage,
            };
            if exit == Exit::Done {
                destination.release(&mut spool.output)?;
            }
            Ok(exit)
        }
    }
}

/// A machine of a project file, and the file with the line in which it stands.
pub(crate) type Own = Option<(Arc<Profile>, (String, usize))>;

/// Whether two programs are for one machine.
fn same(one: &Own, other: &Own) -> bool {
    let place = |own: &Own| own.as_ref().map(|(_, place)| place.clone());
    place(one) == place(other)
}

/// Keeps with a source what a project file says of it; gives its machine.
///
/// # Errors
/// As of [`DialectRegistry::project`].
pub(crate) fn settle(
    args: &Time,
    path: &Path,
    source: &mut Source,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<Own, Problem> {
    let Some(row) = project::row(path, !args.telling.quiet, known, err)? else { return Ok(None) };
    let stated = Stated {
        from: args.reading.from.as_deref(),
        machine: args.setting.machine.as_deref(),
        from_options: &args.reading.from_option,
        ..Stated::default()
    };
    let settled = project::settle(&row, Sides::One, &stated, None, known)?;
    settled.put_into(source);
    if !args.telling.quiet {
        project::note(&source.shown, &settled.used, err);
    }
    let line = row.machine.as_ref().map_or(0, |machine| machine.line);
    Ok(settled.machine.map(|machine| (machine, (row.file.shown.clone(), line))))
}

/// Programs that could not be executed.
struct Lost {
    /// Their names.
    names: Vec<String>,
    /// The exit code.
    exit: Exit,
}

impl Lost {
    /// One of which its diagnostics have been reported.
    fn refused(&mut self, name: String) {
        self.names.push(name);
        self.exit = self.exit.and(Exit::Refused);
    }

    /// One that could not be read. A single one is the command's own problem; of several, the others
    /// go on.
    fn take(
        &mut self,
        args: &Time,
        name: String,
        problem: Problem,
        err: &mut dyn WriteColor,
    ) -> Result<(), Problem> {
        if args.files.len() < 2 {
            return Err(problem);
        }
        // The exit code says so too.
        let _ = problem.print(err, false);
        self.names.push(name);
        self.exit = self.exit.and(problem.exit);
        Ok(())
    }
}

/// What options mean together.
fn check(args: &Time, known: &DialectRegistry) -> Result<(), Problem> {
    if let Some(id) = args.reading.from.as_deref().filter(|id| *id != "auto") {
        known.dialect(id)?;
    }
    if args.files.iter().filter(|file| *file == Path::new("-")).count() > 1 {
        return Err(Problem::usage("stdin can be read only once", "name a file"));
    }
    if args.files.len() > 1 && !args.form.takes_several() {
        return Err(Problem::usage(
            format!("{} files: --as {} is about one", args.files.len(), args.form.name()),
            "call ncc once for each of them; summary, json, markdown and tools take several",
        ));
    }
    if Stage::from(args.stage) == Stage::Before && !matches!(args.form, Form::Payload | Form::Ndjson) {
        return Err(Problem::usage(
            format!("--stage before with --as {}", args.form.name()),
            "only payload and ndjson tell of cycles as they are called",
        ));
    }
    Ok(())
}

fn destination(args: &Time, sources: &[Source]) -> Result<Destination, Problem> {
    let name: Option<&PathBuf> = args.output.as_ref().filter(|name| *name != Path::new("-"));
    for source in sources {
        source.guard(name.map(PathBuf::as_path))?;
    }
    Ok(name.map_or(Destination::Stdout, |name| Destination::File(name.clone())))
}

/// What is written before it may be used.
struct Spool {
    output: Output,
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

/// A program as a translation into itself: so its diagnostics are reported.
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
        // Cycles that are reported as they are called have no times.
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

/// What a program's timing assumes.
pub(crate) fn assumptions(shop: &Shop, plan: &Plan, course: &Course) -> Vec<String> {
    let mut lines = Vec::new();
    let dialect = plan.job.from.dialect;
    match &shop.profile {
        None => lines.push("no machine is named".to_owned()),
        // Canonical text and the text form are nobody's language.
        Some(_) if dialect.caps.flat || dialect.can.everything => {}
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

/// Programs that are counted.
fn summaries(
    args: &Time,
    shop: &Shop,
    known: &DialectRegistry,
    sources: &mut [Source],
    lost: &mut Lost,
    err: &mut dyn WriteColor,
) -> Result<Report, Problem> {
    let mut report = Report {
        ncc_time: 1,
        ncc_version: env!("CARGO_PKG_VERSION"),
        model: args.setting.model.name(),
        machine: shop.profile.as_ref().map(|p| p.id().to_owned()),
        machine_name: shop.title().to_owned(),
        programs: Vec::new(),
        not_timed: Vec::new(),
        total: Tally::default(),
    };
    for source in sources {
        let job = match job(args, shop, known, source, err) {
            Ok(job) => job,
            Err(problem) => {
                lost.take(args, source.name.clone(), problem, err)?;
                continue;
            }
        };
        let plan = plan(args, shop, &job);
        let mut tallier = Tallier::new(&shop.machine);
        let course = execute(args, &plan, known, source, &mut tallier, err)?;
        if course.refused {
            lost.refused(source.name.clone());
            continue;
        }
        let mut timing = Timing {
            prog_name: source.name.clone(),
            dialect: job.from.dialect.id.clone(),
            blocks: course.blocks,
            functions: 0,
            clock: [plan.start_time, course.end].map(columns::micro),
            bounds: course.bounds.map(|bounds| bounds.map(columns::micro)),
            assumed: assumptions(shop, &plan, &course),
            total: Tally::default(),
            tools: Vec::new(),
            operations: Vec::new(),
        };
        timing.take(tallier.finish());
        report.total.join(&timing.total);
        report.programs.push(timing);
    }
    report.total = report.total.rounded();
    report.not_timed = lost.names.clone();
    Ok(report)
}

fn write_report(args: &Time, report: &Report, spool: &mut Spool) -> io::Result<()> {
    match args.form {
        Form::Json => report.json(spool),
        Form::Markdown => spool.write_all(report.markdown(args.setting.model).as_bytes()),
        Form::Tools => report.tool_list(spool),
        Form::Summary | Form::Csv | Form::Payload | Form::Ndjson | Form::Canon => {
            spool.write_all(report.plain(args.setting.model).as_bytes())
        }
    }
}

/// A program of which every function is reported.
fn stream(
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
        Form::Payload | Form::Ndjson | Form::Summary | Form::Json | Form::Markdown | Form::Tools => {
            let header =
                Header { prog_name: &name, machine_name: shop.title(), dialect: &job.from.dialect.id };
            let shape = match args.form {
                Form::Ndjson => payload::Shape::Lines,
                _ => payload::Shape::Document,
            };
            let stage = Stage::from(args.stage);
            let sink = payload::Payload::new(&header, &shop.machine, shape, stage, &mut out);
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
    // What was assumed of the source; the canonical text states what it means.
    course.diagnostics = outcome.diagnostics;
    Ok(Ok(course))
}
