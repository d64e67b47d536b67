//! `ncc doctor`: which facts about both machines a translation depends on.
//!
//! The program is translated as it would be, and every assumption that was reported is asked back as a
//! question about one of the two machines. The answers have a place in a profile; a profile with
//! exactly these questions can be written. Not here: which fact an assumption rests on
//! (`ncc_machines::reading`).
//!
//! ```text
//! ncc doctor --from fanuc --to haas part.nc    questions, each with the line of the profile that answers it
//! ```

pub mod args;
mod init;
mod question;
mod stub;

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::io;
use std::path::Path;

use codespan_reporting::term::termcolor::WriteColor;
use ncc_dialects::Settings;
use ncc_driver::job::options::{choose, state_units};
use ncc_driver::job::{Job, Outcome, Rest};
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::questions::Policy;
use ncc_driver::render::About;
use ncc_driver::render::{Loudness, human};
use ncc_driver::source::Source;
use ncc_driver::translate;
use ncc_ir::canon::AXES;
use ncc_ir::diag::{Diagnostic, Gravity};
use ncc_machines::Profile;
use ncc_machines::reading::{Place, Side, UNNAMED};
use question::{Question, questions};

use self::args::Doctor;
use crate::args::common_args::Verbosity;
use crate::args::typed::Start;
use crate::machines::agreed;
use crate::milling::{self, Voice};
use crate::project::args::Init;
use crate::project::{self, Sides, Stated};
use crate::registry::DialectRegistry;
use crate::registry::recognised::{INTO_WHAT, recognise};
use crate::{files, m_codes};

/// Runs it. Exit code 0 if the program can be translated, whatever is asked; else that of the translation.
///
/// # Errors
/// Wrong usage, or a file.
pub fn run(args: &Doctor, known: &DialectRegistry, err: &mut dyn WriteColor) -> Result<Exit, Problem> {
    let stated = Asked {
        file: &args.file,
        from: args.from.as_deref(),
        to: args.to.as_deref(),
        machine_from: args.machine_from.as_deref(),
        machine_to: args.machine_to.as_deref(),
        from_option: &args.from_option,
        to_option: &args.to_option,
        start: args.standing.start.unwrap_or_default(),
        telling: args.telling,
        no_project: false,
    };
    for path in [&args.write_from, &args.write_to].into_iter().flatten() {
        if path.exists() {
            let message = format!("{} is there already", path.display());
            return Err(Problem::usage(message, "name a new file; nothing is written over"));
        }
    }
    if args.write_from.is_some() && args.write_from == args.write_to {
        return Err(Problem::usage("one file for two machines", "each has a profile of its own"));
    }
    let Examined { job, mut source, outcome, exit } = examine(&stated, known, err)?;
    let shown = source.shown.clone();
    let mut about = About { job: &job, name: &shown, source: &mut source.file };
    let cannot_read = |e: io::Error| Problem::file("examine", &args.file.display().to_string(), &e);
    // Messages that cannot be written change nothing about what was found.
    let asked_for: BTreeSet<usize> = outcome.rests.iter().map(|rest| rest.diagnostic).collect();
    let others = outcome.diagnostics.iter().enumerate().filter(|(at, _)| !asked_for.contains(at));
    let others: Vec<Diagnostic> = others.map(|(_, diagnostic)| diagnostic.clone()).collect();
    let _ = match args.telling.verbose {
        true => {
            human::print_counted(err, &mut about, (&outcome.diagnostics, &outcome.counted), Loudness::Verbose)
        }
        false => human::print(err, &mut about, &others, Loudness::Quiet),
    };
    let asked = questions(&mut about, &outcome).map_err(cannot_read)?;
    let text = questions_by_machine(&about, &others, &asked);
    files::to_stdout(&mut |out| out.write_all(text.as_bytes()))?;
    for (side, path) in [(Side::From, &args.write_from), (Side::To, &args.write_to)] {
        let Some(path) = path else { continue };
        let text = stub::profile(side, &about, &asked, &stem(path));
        files::to_file(path, &mut |out| out.write_all(text.as_bytes()))?;
    }
    Ok(exit)
}

/// The text of a project file for a program, with the questions as comments.
///
/// # Errors
/// Wrong usage, or a file.
pub(crate) fn project(
    args: &Init,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<String, Problem> {
    let stated = Asked {
        file: &args.program,
        from: args.from.as_deref(),
        to: args.to.as_deref(),
        machine_from: args.machine_from.as_deref(),
        machine_to: args.machine_to.as_deref(),
        from_option: &args.from_option,
        to_option: &[],
        start: [None; AXES],
        telling: Verbosity { verbose: false, quiet: false },
        no_project: true,
    };
    let Examined { job, mut source, outcome, .. } = examine(&stated, known, err)?;
    let shown = source.shown.clone();
    let mut about = About { job: &job, name: &shown, source: &mut source.file };
    let asked = questions(&mut about, &outcome)
        .map_err(|e| Problem::file("examine", &args.program.display().to_string(), &e))?;
    Ok(init::text(args, known, &about, &asked))
}

/// A program and both sides, as the command line names them.
struct Asked<'a> {
    file: &'a Path,
    from: Option<&'a str>,
    to: Option<&'a str>,
    machine_from: Option<&'a str>,
    machine_to: Option<&'a str>,
    from_option: &'a [(String, String)],
    to_option: &'a [(String, String)],
    start: Start,
    telling: Verbosity,
    /// Whether no project file counts.
    no_project: bool,
}

/// A translation of which the questions are asked.
struct Examined {
    job: Job,
    source: Source,
    outcome: Outcome,
    /// That of the translation as it was asked for.
    exit: Exit,
}

fn examine(args: &Asked, known: &DialectRegistry, err: &mut dyn WriteColor) -> Result<Examined, Problem> {
    let mut machines = crate::machines::find_both(args.machine_from, args.machine_to, known, err)?;
    let stated = Stated {
        from: args.from,
        machine: args.machine_from,
        from_options: args.from_option,
        to: args.to,
        machine_to: args.machine_to,
        to_options: args.to_option,
        output: None,
    };
    let row = match args.no_project {
        true => None,
        false => project::row(args.file, !args.telling.quiet, known, err)?,
    };
    let settled = row.map(|row| project::settle(&row, Sides::Both, &stated, None, known)).transpose()?;
    if let Some(settled) = &settled {
        machines.from = machines.from.or_else(|| settled.machine.clone());
        machines.to = machines.to.or_else(|| settled.to.clone());
    }
    let to = args.to.map(|id| known.dialect(id)).transpose()?;
    let to = agreed(to, machines.to.as_deref(), "to")?;
    let to = to.ok_or_else(|| Problem::usage("translated into what?", INTO_WHAT))?;
    let named = args.from.filter(|id| *id != "auto").map(|id| known.dialect(id)).transpose()?;
    let named = agreed(named, machines.from.as_deref(), "from")?;
    let voice = if args.telling.quiet { Voice::Quiet } else { Voice::Human };
    let mut source = milling::open(args.file, voice, known, err)?;
    if let Some(settled) = &settled {
        settled.put_into(&mut source);
        if !args.telling.quiet {
            project::note(&source.shown, &settled.used, err);
        }
    }
    let from = match named {
        Some(dialect) => dialect,
        None => recognise(&mut source, !args.telling.quiet, known, err)?,
    };
    let mut said = choose(machines.settings(Side::From, from), args.from_option)?;
    state_units(&mut said, known.units())?;
    m_codes::state(&mut said, Side::From, known)?;
    let mut into = choose(machines.settings(Side::To, to), args.to_option)?;
    m_codes::state(&mut into, Side::To, known)?;
    let assumed = source.assumed.clone();
    let start = args.start;
    let mut job =
        Job { machines, start, assumed, questions: Policy::Skip, ..Job::new(said, into, &source.name) };
    source.rewind()?;
    let cannot_read = |e: io::Error| Problem::file("examine", &args.file.display().to_string(), &e);
    let mut outcome = translate::translate(&job, &mut source.file).map_err(cannot_read)?;
    let exit = outcome.exit();
    let codes = outcome.rests.iter().filter_map(|rest| match &rest.place {
        Place::Code(code) => Some(code.clone()),
        _ => None,
    });
    let codes: BTreeSet<String> = codes.collect();
    let unknown = outcome.rests.iter().filter(|rest| matches!(rest.place, Place::Code(_)));
    let unknown: Vec<(Rest, Diagnostic)> =
        unknown.map(|rest| (rest.clone(), outcome.diagnostics[rest.diagnostic].clone())).collect();
    if !codes.is_empty() {
        // What else there is to ask shows once these codes stand for something.
        let mut profile = job.machines.from.as_deref().cloned().unwrap_or_else(|| Profile::empty(from));
        codes.iter().for_each(|code| profile.add_code(code, &stand_in(code)));
        job.from = choose(profile.settings(), args.from_option)?;
        state_units(&mut job.from, known.units())?;
        m_codes::state(&mut job.from, Side::From, known)?;
        source.rewind()?;
        outcome = translate::translate(&job, &mut source.file).map_err(cannot_read)?;
        for (rest, diagnostic) in unknown {
            outcome.rests.push(Rest { diagnostic: outcome.diagnostics.len(), ..rest });
            outcome.diagnostics.push(diagnostic);
        }
    }
    Ok(Examined { job, source, outcome, exit })
}

/// A name for what a code does, as long as nobody has said it.
fn stand_in(code: &str) -> String {
    format!("{UNNAMED}{}", code.trim_start_matches('M'))
}

/// The name of a profile after its file.
fn stem(path: &Path) -> String {
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}

/// The questions, grouped by machine.
fn questions_by_machine(about: &About, others: &[Diagnostic], asked: &[Question]) -> String {
    let (from, to): (&Settings, &Settings) = (&about.job.from, &about.job.to);
    let mut text = format!("{}: {} to {}, ", about.name, from.dialect.id, to.dialect.id);
    text.push_str(&match asked.len() {
        0 => "depends on no fact that is not stated\n".to_owned(),
        1 => "depends on 1 fact that is not stated\n".to_owned(),
        n => format!("depends on {n} facts that are not stated\n"),
    });
    for (side, whose, dialect) in [
        (Side::From, "the machine that it was written for", from.dialect),
        (Side::To, "the machine to translate for", to.dialect),
    ] {
        let own: Vec<&Question> = asked.iter().filter(|q| q.side == side).collect();
        if own.is_empty() {
            continue;
        }
        // Writing into a text cannot fail.
        let _ = writeln!(text, "\n{whose} ({}):", dialect.id);
        let wide = own.iter().map(|q| q.place.to_string().len()).max().unwrap_or(0);
        for question in own {
            let place = question.place.to_string();
            let _ = writeln!(text, "  {place:wide$}  {} ({})", question.taken, question.lines());
            let _ = writeln!(text, "  {:wide$}  {}", "", question.takes);
        }
    }
    if others.iter().any(|d| d.fault.gravity() == Gravity::Error) {
        text.push_str(
            "\nThe program is refused, so there may be more questions after the block that stops it.\n",
        );
    }
    let open = asked.iter().any(|q| q.side == Side::From).then_some("--write-from FILE");
    let open: Vec<&str> = open
        .into_iter()
        .chain(asked.iter().any(|q| q.side == Side::To).then_some("--write-to FILE"))
        .collect();
    if !open.is_empty() {
        let _ = writeln!(text, "\n{} writes profiles with these questions, to be filled in.", open.join(" "));
    }
    text
}
