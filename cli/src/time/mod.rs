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
mod course;
mod progress;
mod rows;
pub(crate) mod running;
mod stored;

use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;

use codespan_reporting::term::termcolor::WriteColor;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::source::Source;
use ncc_driver::time::drive::Stage;
use ncc_machines::Profile;

use self::args::{Form, Time};
pub(crate) use self::course::{Shop, assumptions, execute, job, plan};
use self::course::{Spool, destination};
pub(crate) use self::rows::say;
use crate::files::{self, Destination};
use crate::milling::{self, Voice};
use crate::project::{self, Sides, Stated};
use crate::registry::DialectRegistry;
pub use ncc_driver::time::payload::SCHEMA;
use ncc_driver::time::summary::Report;
use ncc_driver::time::summary::Timing;
use ncc_driver::time::tally::Tallier;
use ncc_driver::time::tally::Tally;

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
    if args.reading.from.as_deref() == Some(stored::PAYLOAD) {
        return stored::run(args);
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
    let mut spool = Spool::default();
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
        Form::Csv | Form::Payload | Form::PayloadPrinted | Form::Ndjson | Form::Canon => {
            let exit = match sources.first_mut() {
                Some(source) => rows::stream(args, &shop, known, source, &mut spool, err)?,
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
    if Stage::from(args.stage) == Stage::Before && !args.form.takes_stages() {
        return Err(Problem::usage(
            format!("--stage before with --as {}", args.form.name()),
            "only payload, payload-printed and ndjson tell of cycles as they are called",
        ));
    }
    Ok(())
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
        let assumed = assumptions(shop, &plan, &course);
        let timing = Timing::of(&source.name, &plan, &course, assumed, tallier.finish());
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
        Form::Summary | Form::Csv | Form::Payload | Form::PayloadPrinted | Form::Ndjson | Form::Canon => {
            spool.write_all(report.plain(args.setting.model).as_bytes())
        }
    }
}
