//! The command line from its arguments to its exit code.

use std::ffi::OsString;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser};
use codespan_reporting::term::termcolor::{Buffer, ColorChoice, StandardStream, WriteColor};
use ncc_dialects::Dialect;
use ncc_driver::job::{Failure, Job, file_per_tool};
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::provenance::map;
use ncc_driver::provenance::trace::Asked;
use ncc_driver::render::scaffold::scaffold;
use ncc_driver::render::terminal::Shown;
use ncc_driver::render::{About, dialects, explain, line, report};
use ncc_driver::source::not_milling::Refusal;
use ncc_driver::source::{Source, include_path};
use ncc_driver::translate::{self, tools_by_name};
use ncc_ir::canon::Units;
use ncc_passes::PASSES;

use crate::args::sugar::{Said, rewrite};
use crate::args::typed::{Assumed, Color, Eol, Format, Style, is_name};
use crate::args::{Cli, DialectsWhat, Translate, Verb};
use crate::files::{self, Destination, arrow};
use crate::milling::{self, Voice};
use crate::print_after::print_after;
use crate::provenance::why;
use crate::registry::recognised::{doubt_dialect, recognise_all};
use crate::registry::{self, DialectRegistry, dictionary_test};
use crate::report::tell;
use crate::target_options::TargetOptions;
use crate::time::running::Running;
use crate::{batch, check, doctor, fmt, listing, machines, plot, project, review, simulate, time};

/// Runs `ncc` with its arguments, the program's name first.
pub fn run(arguments: Vec<OsString>) -> Exit {
    let exit = run_verb(arguments);
    // A verb that was interrupted may have ended with the exit code of a fault in the program.
    if ncc_exec::halt::is_asked() { Exit::Interrupted } else { exit }
}

fn run_verb(arguments: Vec<OsString>) -> Exit {
    let mut err = Shown::new(StandardStream::stderr(choice(Color::Auto)));
    let as_json = arguments.windows(2).any(|a| a[0] == "--format" && a[1] == "json")
        || arguments.iter().any(|a| a == "--format=json");
    // A shell's torn arrow is understood only where the target's name is known.
    let files = registry::files(&arguments);
    let mut known = DialectRegistry::built_in();
    if registry::runs_functions(&arguments) {
        known.run_functions();
    }
    if let Err(problem) = known.add(&files, (!as_json).then_some(&mut err as &mut dyn WriteColor)) {
        return fail(&problem, &mut err, as_json);
    }
    let (arguments, arrow) = match honour(rewrite(arguments), &known) {
        Ok(both) => both,
        Err(problem) => return fail(&problem, &mut err, as_json),
    };
    let cli = match Cli::try_parse_from(&arguments) {
        Ok(cli) => cli,
        Err(error) => return clap_says(&error, &arguments, &known, &mut err),
    };
    let mut err = Shown::new(StandardStream::stderr(choice(cli.color)));
    match cli.assume {
        None => {}
        Some(Some(Assumed::Milling)) => known.assume_milling(),
        Some(None) => known.assume_readings(),
    }
    known.state_units(cli.units.map(Units::from));
    known.state_m_codes(&cli.m_code);
    known.leave_calls_out(&cli.call);
    if let Verb::Translate(args) = &cli.verb {
        known.state_variables(&args.value);
    }
    if !cli.no_config {
        known.use_projects();
    }
    if let Err(problem) = known.look_in(&cli.include) {
        return fail(&problem, &mut err, as_json);
    }
    let done = match &cli.verb {
        Verb::Translate(args) => return translate_verb(args, arrow, &known, &mut err),
        Verb::Dialects(args) => match &args.what {
            None => print(&dialects::list(&known.all())),
            Some(DialectsWhat::Show { id }) => {
                known.dialect(id).and_then(|dialect| print(&dialects::show(dialect)))
            }
            Some(DialectsWhat::New { id, base }) => new_dialect(id, base, &known),
            Some(DialectsWhat::Schema) => print(dialects::SCHEMA),
            Some(DialectsWhat::Test { what, verbose, .. }) => {
                return ended(dictionary_test::run(known, what, *verbose, &mut err), &mut err);
            }
        },
        Verb::Machines(args) => return ended(machines::run(args, &known, &mut err), &mut err),
        Verb::Doctor(args) => return ended(doctor::run(args, &known, &mut err), &mut err),
        Verb::Init(args) => return ended(project::init::run(args, &known, &mut err), &mut err),
        Verb::Config(args) => return ended(project::config::run(args, &known, &mut err), &mut err),
        Verb::Passes => print(&passes()),
        Verb::Time(args) => return ended(time::run(args, &known, &mut err), &mut err),
        Verb::Check(args) => return ended(check::run(args, &known, cli.color, &mut err), &mut err),
        Verb::Fmt(args) => return ended(fmt::run(args, &known, &mut err), &mut err),
        Verb::Plot(args) => return ended(plot::run(args, &known, &mut err), &mut err),
        Verb::Simulate(args) => return ended(simulate::run(args, &known, &mut err), &mut err),
        #[cfg(feature = "serve")]
        Verb::Serve(args) => return ended(crate::serve::run(args, &mut err), &mut err),
        #[cfg(feature = "studio")]
        Verb::Studio(args) => studio(args, &mut err),
        Verb::Verify(args) => return ended(review::verify::run(args, &known, &mut err), &mut err),
        Verb::Diff(args) => return ended(review::diff::run(args, &known, &mut err), &mut err),
        Verb::GitDiff(args) => return ended(review::diff::git::run(args, &known, &mut err), &mut err),
        Verb::GitTextconv(args) => return ended(review::textconv::run(args, &known, &mut err), &mut err),
        Verb::Why(args) => return ended(why::run(args, &known, &mut err), &mut err),
        Verb::Explain(args) => match explain::page(&args.code) {
            Some(page) => print(page),
            None => Err(Problem::usage(
                format!("there is no message `{}`", args.code),
                "a code looks like NC0107; it is in brackets at the beginning of a message",
            )),
        },
        Verb::Completions(args) => {
            let mut text = Vec::new();
            clap_complete::generate(args.shell, &mut Cli::command(), "ncc", &mut text);
            files::data_to_stdout(&mut |out| out.write_all(&text))
        }
        Verb::Man(args) => manual(args.verb.as_deref()),
    };
    match done {
        Ok(()) => Exit::Done,
        Err(problem) => fail(&problem, &mut err, false),
    }
}

/// Serves the page, and opens it.
#[cfg(feature = "studio")]
fn studio(args: &crate::args::Studio, err: &mut dyn Write) -> Result<(), Problem> {
    let shown = args.programs.display().to_string();
    let studio = ncc_studio::Studio::open(args.port, &args.programs).map_err(|e| match e.kind() {
        io::ErrorKind::AddrInUse | io::ErrorKind::PermissionDenied if args.port > 0 => {
            Problem::usage(format!("port {} is not free", args.port), "name another one, or none")
        }
        _ => Problem::file("open", &shown, &e),
    })?;
    let address = studio.address();
    print(&format!("{address}\n"))?;
    // Without a browser the address is there to be copied.
    if !args.no_open && open::that_detached(&address).is_err() {
        let _ = writeln!(err, "no browser could be opened: open the address above");
    }
    studio.serve().map_err(|e| Problem::file("serve", &shown, &e))
}

/// Prints a dictionary to begin with.
fn new_dialect(id: &str, base: &str, known: &DialectRegistry) -> Result<(), Problem> {
    let base = known.dialect(base)?;
    if !is_name(id) || known.get(id).is_some() {
        return Err(Problem::usage(
            format!("`{id}` cannot be the name of a dialect of your own"),
            "letters, digits, `_` and `-`, and no name that `ncc dialects` lists",
        ));
    }
    print(&scaffold(id, base))
}

/// Prints a manual page in roff, the form that `man -l` takes.
fn manual(verb: Option<&str>) -> Result<(), Problem> {
    let mut all = Cli::command();
    all.build();
    let page = match verb {
        None => all,
        Some(verb) => {
            let found = all.get_subcommands().find(|command| command.get_name() == verb);
            let verbs: Vec<&str> = all.get_subcommands().map(|command| command.get_name()).collect();
            let found = found.ok_or_else(|| {
                Problem::usage(
                    format!("there is no verb `{verb}`"),
                    format!("there are: {}", verbs.join(", ")),
                )
            })?;
            found.clone()
        }
    };
    let mut text = Vec::new();
    clap_mangen::Man::new(page).render(&mut text).map_err(|e| Problem::file("write", "the page", &e))?;
    files::data_to_stdout(&mut |out| out.write_all(&text))
}

fn ended(done: Result<Exit, Problem>, err: &mut dyn WriteColor) -> Exit {
    done.unwrap_or_else(|problem| fail(&problem, err, false))
}

/// Joins a torn arrow if it is certain that it is one.
fn honour(said: Said, known: &DialectRegistry) -> Result<(Vec<OsString>, Option<&'static Dialect>), Problem> {
    let (from, typed, rest) = match said {
        Said::Plain(arguments) => return Ok((arguments, None)),
        Said::Arrow { from, typed, rest } => (from, typed, rest),
    };
    let to = arrow::target(known).map_err(|doubt| Problem {
        exit: Exit::Usage,
        message: format!("`{from} {typed}` without a target: {}", doubt.words()),
        help: vec![
            format!("a shell takes the `>` of `{typed}` for a redirection; put it in quotes, or write"),
            format!("  ncc {from} to DIALECT FILE -o NAME"),
        ],
    })?;
    let mut arguments: Vec<OsString> =
        ["ncc", "translate", "--from", &from, "--to", &to.id].map(OsString::from).into();
    arguments.extend(rest);
    Ok((arguments, Some(to)))
}

/// What clap has to say: help and version on stdout, anything else is wrong usage.
fn clap_says(
    error: &clap::Error,
    arguments: &[OsString],
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Exit {
    let unknown = error.kind() == ErrorKind::InvalidSubcommand || error.kind() == ErrorKind::UnknownArgument;
    let verbs: Vec<String> = Cli::command().get_subcommands().map(|v| v.get_name().to_owned()).collect();
    let word = arguments.iter().skip(1).find_map(|a| a.to_str().filter(|a| !a.starts_with('-')));
    if let (true, Some(word)) = (unknown, word)
        && !verbs.iter().any(|verb| verb == word)
    {
        let is_dialect = known.get(word).is_some();
        let message = match is_dialect {
            true => format!("translate from {word} into what?"),
            false => format!("`{word}` is neither a command nor a dialect"),
        };
        let help = vec![
            "to translate a program, name both dialects: ncc mach9 to fanuc part.cn".to_owned(),
            format!("dialects: {}; commands: {}", known.ids(), verbs.join(", ")),
        ];
        return fail(&Problem { exit: Exit::Usage, message, help }, err, false);
    }
    // If nobody can read it, there is nobody to tell. Names of files are the shell's, and may hold anything.
    let _ = match arguments.iter().any(|a| a.to_string_lossy().contains(char::is_control)) {
        true => write!(err, "{}", error.render()),
        false => error.print(),
    };
    if error.use_stderr() { Exit::Usage } else { Exit::Done }
}

fn translate_verb(
    args: &Translate,
    arrow: Option<&'static Dialect>,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Exit {
    let as_json = args.format == Format::Json;
    translated(args, arrow, known, err).unwrap_or_else(|problem| fail(&problem, err, as_json))
}

fn translated(
    args: &Translate,
    arrow: Option<&'static Dialect>,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<Exit, Problem> {
    if batch::is_meant(args) {
        if args.style == Style::Rs274 {
            return Err(Problem::usage("`--style rs274` lists one program", "list them one by one"));
        }
        return batch::run(args, arrow, known, err);
    }
    let path = args.files.first().map_or(Path::new("-"), PathBuf::as_path);
    let say = args.format == Format::Human && !args.telling.quiet;
    let order = {
        // For a reader of JSON, the problem alone says where.
        let mut nowhere = Buffer::no_color();
        let told: &mut dyn WriteColor = if args.format == Format::Json { &mut nowhere } else { err };
        let row = project::row(path, say, known, told)?;
        TargetOptions::find(args, known, row.as_deref(), told)?
    };
    if file_per_tool(&order.to) {
        batch::per_tool::check(args, order.folder(args), arrow)?;
        return batch::run(args, arrow, known, err);
    }
    let mut destination = destination(args, arrow)?;
    if let Some(folder) = order.folder(args).filter(|_| arrow.is_none() && args.style == Style::Plain) {
        files::make_folder(folder)?;
        destination = Destination::File(folder.to_owned());
    }
    destination.check()?;
    let voice = match (args.format, args.telling.quiet) {
        (Format::Json, _) => Voice::Json,
        (Format::Human, true) => Voice::Quiet,
        // The head and the report state it.
        (Format::Human, false) => Voice::Human,
    };
    let mut source = files::open(path)?;
    if let Some(settled) = &order.settled {
        settled.put_into(&mut source);
    }
    if let Some(refusal) = milling::admit(&mut source, voice, known, err)? {
        not_milling(args, &order, &mut source, &refusal, (voice, err))?;
        return Ok(Exit::Refused);
    }
    guard(args, &source, &destination)?;
    let (from, rivals) = match order.named {
        Some(dialect) => (dialect, Vec::new()),
        None => recognise_all(&mut source, !args.telling.quiet && args.format == Format::Human, known, err)?,
    };
    let crlf = match order.eol(args) {
        Eol::Lf => false,
        Eol::Crlf => true,
        Eol::Keep => source.is_crlf()?,
    };
    let mut job = order.job(args, from, &source.name, crlf)?;
    job.rivals = rivals;
    include_path::load_subprograms(&mut source, &job.from, known.folders(), &files::Disk)?;
    job.called.clone_from(&source.called);
    job.assumed.extend_from_slice(&source.assumed);
    tools_by_name::number(&mut job, &mut source.file)
        .map_err(|e| Problem::file("read", &source.shown, &e))?;
    source.rewind()?;
    if args.style == Style::Rs274 {
        listing::check(args, &job)?;
        return listing::run(args, &job, &mut source, &destination, err);
    }
    let cannot_read = |e: &io::Error, source: &Source| Problem::file("translate", &source.shown, e);
    let asked = Asked { map: args.map.is_some(), annotate: args.annotate };
    let watch = (args.print_after.clone().map(print_after), Running::shown(&source.name, say));
    let (mut outcome, record) = translate::translate_recording(&job, asked, &mut source.file)
        .map_err(|e| cannot_read(&e, &source))?;
    drop(watch);
    if let Destination::File(folder) = &destination
        && folder.is_dir()
    {
        let name = outcome.file_name(&job.machines, job.to.dialect, &source.name);
        let name = folder.join(name);
        source.guard(Some(&name))?;
        destination = Destination::File(name);
    }
    if outcome.release.is_ok() {
        destination.release(&mut outcome.output)?;
    }
    let mut about = About { job: &job, name: &source.shown, source: &mut source.file };
    // Of a run that was interrupted, the messages say where it was.
    if let Some(name) = args.report.as_ref().filter(|_| !ncc_exec::halt::is_asked()) {
        files::to_file(name, &mut |out| report::write(out, &mut about, &outcome))?;
    }
    if let (Some(name), Some(record)) = (&args.map, record) {
        let output = destination.file_name();
        let mut record = Some(record);
        files::to_file(name, &mut |out| match record.take() {
            Some(record) => map::write(out, &mut about, &output, &mut outcome, record),
            None => Ok(()),
        })?;
    }
    // Messages that cannot be written change nothing about what was done.
    let _ = tell(args, &mut about, &outcome, err);
    if outcome.release == Err(Failure::Refused)
        && !outcome.is_asked(&job)
        && !args.telling.quiet
        && args.format == Format::Human
    {
        let _ = doubt_dialect(&mut source, &job, known, err);
    }
    if let (Some(to), Ok(()), false) = (arrow, outcome.release, args.telling.quiet) {
        let _ = say_where(to, &job, &source.shown, args.format, err);
    }
    Ok(outcome.exit())
}

/// Where the output goes: the file of `-o`, or standard output, which the shell may send to a file.
fn destination(args: &Translate, arrow: Option<&'static Dialect>) -> Result<Destination, Problem> {
    match &args.output {
        Some(name) if arrow.is_some() => Err(Problem::usage(
            format!("two places to write to: the shell's redirection, and {}", name.display()),
            "leave one of them out",
        )),
        Some(name) if name != Path::new("-") => Ok(Destination::File(name.clone())),
        Some(_) | None => Ok(Destination::Stdout),
    }
}

/// Writes the report, and the line for a reader of JSON, of a program that is none for a mill.
fn not_milling(
    args: &Translate,
    order: &TargetOptions,
    source: &mut Source,
    refusal: &Refusal,
    (voice, err): (Voice, &mut dyn WriteColor),
) -> Result<(), Problem> {
    if let Some(name) = &args.report {
        source.guard(Some(name))?;
        let named = order.named.map(|dialect| dialect.id.as_str());
        files::to_file(name, &mut |out| report::refused(out, (named, &order.to), source, refusal))?;
    }
    if voice == Voice::Json {
        line::line(&mut ncc_driver::problem::as_write(err), &refusal.asked())
            .map_err(|e| Problem::file("write", "messages", &e))?;
        refusal.line(err)?;
    }
    Ok(())
}

/// Refuses files to write to that are read, or that two things would be written to.
fn guard(args: &Translate, source: &Source, destination: &Destination) -> Result<(), Problem> {
    match destination {
        Destination::File(name) => source.guard(Some(name))?,
        Destination::Stdout => source.guard(None)?,
    }
    let both = |name: &Path, what: &str| {
        let message = format!("{} is both {what}", name.display());
        Problem::usage(message, "choose another name for one of them")
    };
    for (file, what) in [(&args.report, "output and report"), (&args.map, "output and map")] {
        let Some(file) = file else { continue };
        source.guard(Some(file))?;
        if matches!(destination, Destination::File(name) if name == file) {
            return Err(both(file, what));
        }
    }
    match args.map.as_ref().filter(|map| args.report.as_ref() == Some(map)) {
        Some(map) => Err(both(map, "report and map")),
        None => Ok(()),
    }
}

/// Says where an arrow has led to.
fn say_where(to: &Dialect, job: &Job, shown: &str, format: Format, err: &mut dyn Write) -> io::Result<()> {
    let (from, to) = (&job.from.dialect.id, &to.id);
    if format == Format::Json {
        return Ok(());
    }
    writeln!(
        err,
        "The program is in the file `{to}` of this folder: the shell took `> {to}` for a redirection.\n\
         To choose a name: ncc {from} to {to} {shown} -o NAME, or now: mv {to} NAME"
    )
}

fn passes() -> String {
    let wide = PASSES.iter().map(|pass| pass.name.len()).max().unwrap_or(0);
    PASSES.iter().map(|pass| format!("{:wide$}  {}\n", pass.name, pass.about)).collect()
}

fn choice(color: Color) -> ColorChoice {
    let wanted = match color {
        Color::Always => true,
        Color::Never => false,
        Color::Auto => {
            io::stderr().is_terminal()
                && std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty())
                && std::env::var_os("TERM").is_none_or(|term| term != "dumb")
        }
    };
    if wanted { ColorChoice::Always } else { ColorChoice::Never }
}

fn print(text: &str) -> Result<(), Problem> {
    files::to_stdout(&mut |out| out.write_all(text.as_bytes()))
}

fn fail(problem: &Problem, err: &mut dyn WriteColor, json: bool) -> Exit {
    // If stderr cannot be written, the exit code has to say it all.
    let _ = problem.print(err, json);
    problem.exit
}
