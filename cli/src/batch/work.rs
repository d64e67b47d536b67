//! One program of a batch: translated as by itself, its messages kept for their turn, its output
//! written at once or held until all names are known.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use codespan_reporting::term::termcolor::Buffer;
use ncc_dialects::Dialect;
use ncc_driver::job::{Failure, Job, Outcome};
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::provenance::trace::Asked;
use ncc_driver::questions::of_translation;
use ncc_driver::render::human::reported;
use ncc_driver::render::{About, json, questions};
use ncc_driver::source::{Source, include_path, not_milling};
use ncc_driver::translate::{self, split, tools_by_name};
use ncc_ir::diag::{Fault, Gravity, Verdict};
use sha2::{Digest, Sha256};

use super::gather::Item;
use super::orders::Orders;
use super::per_tool::left_over;
use super::summary::{Missing, OfTool, Result as Came, Row};
use crate::args::Translate;
use crate::args::typed::{Eol, Format};
use crate::files;
use crate::registry::DialectRegistry;
use crate::registry::recognised;
use crate::registry::recognised::doubt_dialect;
use crate::report::tell;

/// Highest number of a program.
const MOST_NUMBER: u32 = 99_999_999;

/// Outputs that wait, one after another in a temporary file.
#[derive(Debug)]
pub(super) struct Store {
    file: File,
    bytes: u64,
}

impl Store {
    pub(super) fn new() -> io::Result<Store> {
        Ok(Store { file: crate::files::scratch::file()?, bytes: 0 })
    }

    fn put(&mut self, write: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>) -> io::Result<Range<u64>> {
        let start = self.file.seek(SeekFrom::Start(self.bytes))?;
        write(&mut self.file).map_err(crate::files::scratch::full)?;
        self.bytes = self.file.stream_position()?;
        Ok(start..self.bytes)
    }

    pub(super) fn get(&mut self, range: &Range<u64>, into: &mut dyn Write) -> io::Result<()> {
        self.file.seek(SeekFrom::Start(range.start))?;
        let bytes = range.end - range.start;
        match io::copy(&mut (&mut self.file).take(bytes), into)? == bytes {
            true => Ok(()),
            false => Err(io::ErrorKind::UnexpectedEof.into()),
        }
    }
}

/// An output that waits for its name.
#[derive(Debug)]
pub(super) struct Held {
    pub(super) path: PathBuf,
    /// The name that it has if another program has that one: of a standalone subprogram.
    pub(super) otherwise: Option<PathBuf>,
    pub(super) range: Range<u64>,
    /// The hash of a subprogram, which several programs may have.
    pub(super) shared: Option<[u8; 32]>,
}

/// What became of a program.
#[derive(Debug)]
pub(super) struct Done {
    pub(super) row: Row,
    /// Messages for people.
    pub(super) messages: Buffer,
    pub(super) held: Vec<Held>,
}

/// What all programs of a batch are translated with.
#[derive(Debug)]
pub(super) struct Bench<'a> {
    pub(super) args: &'a Translate,
    pub(super) orders: &'a Orders,
    pub(super) known: &'a DialectRegistry,
    pub(super) items: &'a [Item],
    /// Programs that are not to be translated.
    pub(super) refused: &'a BTreeMap<usize, Problem>,
    pub(super) split: bool,
    /// Where outputs wait, if they do.
    pub(super) store: Option<&'a Mutex<Store>>,
    pub(super) colour: bool,
}

impl Bench<'_> {
    /// Translates one of the programs.
    pub(super) fn one(&self, at: usize) -> Done {
        let begun = Instant::now();
        let item = &self.items[at];
        let mut done = Done {
            row: Row::new(item.path.display().to_string()),
            messages: if self.colour { Buffer::ansi() } else { Buffer::no_color() },
            held: Vec::new(),
        };
        if let Err(problem) = self.translated(at, item, &mut done) {
            let came = match done.row.result.is_done() {
                true => Came::NotWritten,
                false => Came::NotTranslated,
            };
            done.row.fails(came, &problem);
            done.held.clear();
            if self.args.format == Format::Human {
                // The summary and the exit code say so too.
                let _ = problem.print(&mut done.messages, false);
            }
        }
        done.row.seconds = (begun.elapsed().as_secs_f64() * 1e3).round() / 1e3;
        done
    }

    fn translated(&self, at: usize, item: &Item, done: &mut Done) -> Result<(), Problem> {
        if let Some(problem) = self.refused.get(&at) {
            return Err(problem.clone());
        }
        let args = self.args;
        let Some((order, folder)) = self.orders.at(at) else { return Ok(()) };
        let mut source = files::open(&item.path)?;
        if let Some(settled) = &order.settled {
            settled.put_into(&mut source);
        }
        let say = !args.telling.quiet && args.format == Format::Human;
        if let Some(refusal) = not_milling::refusal(&mut source, self.known.all_for_mills())? {
            done.row.result = Came::Refused;
            done.row.exit = Exit::Refused;
            done.row.reason = Some(refusal.reason());
            done.row.questions.extend(serde_json::to_value(refusal.asked()).ok());
            match args.format {
                // The summary and the exit code say so too.
                Format::Human => drop(refusal.print(&mut done.messages)),
                Format::Json => done.row.messages.extend(serde_json::to_value(refusal.entry()).ok()),
            }
            return Ok(());
        }
        if let Some(note) = not_milling::note(&source).filter(|_| say) {
            let _ = writeln!(done.messages, "{note}");
        }
        let (from, rivals) = match order.named {
            Some(dialect) => (dialect, Vec::new()),
            None => recognised::recognise_all(&mut source, say, self.known, &mut done.messages)?,
        };
        done.row.from = Some(from.id.clone());
        done.row.project = source.project.as_deref().cloned();
        let crlf = match order.eol(args) {
            Eol::Lf => false,
            Eol::Crlf => true,
            Eol::Keep => source.is_crlf()?,
        };
        let mut job = order.job(args, from, &source.name, crlf)?;
        job.program_number = args.program_number.map(|first| number(first, at)).transpose()?;
        job.rivals = rivals;
        job.one_thread = true;
        include_path::load_subprograms(&mut source, &job.from, self.known.folders(), &files::Disk)?;
        job.called.clone_from(&source.called);
        job.assumed.extend_from_slice(&source.assumed);
        tools_by_name::number(&mut job, &mut source.file)
            .map_err(|e| Problem::file("read", &source.shown, &e))?;
        source.rewind()?;
        let asked = Asked { map: false, annotate: args.annotate };
        let (mut outcome, _) = translate::translate_recording(&job, asked, &mut source.file)
            .map_err(|e| Problem::file("translate", &source.shown, &e))?;
        self.account(item, &job, &mut source, &outcome, &mut done.row)?;
        if outcome.release.is_ok() {
            done.held = self.release(item, folder, &job, &source, &mut outcome, &mut done.row)?;
        }
        let mut about = About { job: &job, name: &source.shown, source: &mut source.file };
        match args.format {
            // Messages that cannot be kept change nothing about what was done.
            Format::Human => drop(tell(args, &mut about, &outcome, &mut done.messages)),
            Format::Json => {
                let entries = json::entries(&mut about, &outcome.diagnostics, args.telling.loudness());
                let entries = entries.map_err(|e| Problem::file("read", &source.shown, &e))?;
                done.row.messages = entries.iter().filter_map(|e| serde_json::to_value(e).ok()).collect();
            }
        }
        if outcome.release == Err(Failure::Refused) && !outcome.is_asked(&job) && say {
            let _ = doubt_dialect(&mut source, &job, self.known, &mut done.messages);
        }
        Ok(())
    }

    /// What is to be reported of a translation in one line.
    fn account(
        &self,
        item: &Item,
        job: &Job,
        source: &mut Source,
        outcome: &Outcome,
        row: &mut Row,
    ) -> Result<(), Problem> {
        row.result = match (outcome.release, outcome.verified) {
            (Ok(()), Some(_)) => Came::Verified,
            (Ok(()), None) => Came::Unverified,
            (Err(Failure::Refused), _) => Came::Refused,
            (Err(Failure::VerificationFailed), _) => Came::VerificationFailed,
        };
        row.exit = outcome.exit();
        row.events = outcome.verified.filter(|_| outcome.release.is_ok()).map(|v| v.events);
        row.program_number = outcome.program_number.filter(|_| outcome.release.is_ok());
        let shown = source.shown.clone();
        let unread = |e: io::Error| Problem::file("read", &shown, &e);
        let mut about = About { job, name: &shown, source: &mut source.file };
        let asked = questions::ask(&mut about, &of_translation(job, outcome)).map_err(unread)?;
        row.questions = asked.iter().filter_map(|asked| serde_json::to_value(asked).ok()).collect();
        let warns = |gravity: Gravity| match gravity {
            Gravity::Error => false,
            Gravity::Warning => true,
            Gravity::Verdict(verdict) => Verdict::stops(verdict),
        };
        let warnings = outcome.diagnostics.iter().filter(|d| warns(d.fault.gravity()) && !job.refuses(d));
        row.warnings = warnings.count();
        if outcome.release.is_ok() {
            return Ok(());
        }
        for diagnostic in &outcome.diagnostics {
            let Fault::CallUnknown { name } = &diagnostic.fault else { continue };
            if row.missing.iter().all(|missing| *missing.name != **name) {
                row.missing.push(Missing { name: name.to_string(), beside: beside(&item.path, name) });
            }
        }
        if let Some(asked) = asked.first().filter(|_| outcome.is_asked(job)) {
            row.reason = Some(format!("line {}: {}", asked.place.line, asked.question));
            return Ok(());
        }
        let first = reported(job, &outcome.diagnostics, ncc_driver::render::Loudness::Quiet);
        let first = first.first().copied().or(outcome.diagnostics.last());
        let Some(first) = first else { return Ok(()) };
        let lines = about.lines(std::iter::once(first)).map_err(unread)?;
        let told = about.tell(&lines, first).map_err(unread)?;
        row.reason = Some(format!("line {}: {}", told.place.start.0, told.message));
        Ok(())
    }

    /// Writes an output, or holds it.
    fn release(
        &self,
        item: &Item,
        folder: &Path,
        job: &Job,
        source: &Source,
        outcome: &mut Outcome,
        row: &mut Row,
    ) -> Result<Vec<Held>, Problem> {
        let to = job.to.dialect;
        let below = folder.join(&item.below);
        let plain = below.join(job.machines.file_name(to, &source.name, outcome.program_number));
        let main = below.join(outcome.file_name(&job.machines, to, &source.name));
        let otherwise = (plain != main).then_some(plain);
        let cannot = |path: &Path, e: &io::Error| Problem::file("write", &path.display().to_string(), e);
        let Some(store) = self.store else {
            make_folder(&main)?;
            files::to_file(&main, &mut |out| outcome.output.write_to(out))?;
            row.outputs.push(main.display().to_string());
            return Ok(Vec::new());
        };
        let mut held = Vec::new();
        let mut hold = |path: PathBuf,
                        shared: Option<[u8; 32]>,
                        write: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>| {
            let range = store.lock().unwrap_or_else(PoisonError::into_inner).put(write);
            let range = range.map_err(|e| cannot(&path, &e))?;
            row.outputs.push(path.display().to_string());
            Ok::<Held, Problem>(Held { path, otherwise: None, range, shared })
        };
        for file in &mut outcome.files {
            let path = main.with_file_name(file.name(&file_name(&main)));
            row.tool_files.push(OfTool {
                output: path.display().to_string(),
                tool: file.tool,
                first_line: file.lines.map(|(first, _)| first),
                last_line: file.lines.map(|(_, last)| last),
            });
            held.push(hold(path, None, &mut |out| file.output.write_to(out))?);
        }
        if !held.is_empty() {
            let written: Vec<PathBuf> = held.iter().map(|held| held.path.clone()).collect();
            row.left_over = left_over(&written).iter().map(|path| path.display().to_string()).collect();
            return Ok(held);
        }
        if !self.split || !split::can(to) {
            let held = hold(main, None, &mut |out| outcome.output.write_to(out))?;
            return Ok(vec![Held { otherwise, ..held }]);
        }
        let whole = outcome.output.to_vec().map_err(|e| cannot(&main, &e))?;
        let Some(parts) = split::apart(to, &whole) else {
            let held = hold(main, None, &mut |out| out.write_all(&whole))?;
            return Ok(vec![Held { otherwise, ..held }]);
        };
        if split::join(to, &parts) != whole {
            let message = format!("{}: its programs joined again are not what was verified", source.shown);
            let help = vec!["--no-split writes them as one text".to_owned()];
            return Err(Problem { exit: Exit::VerificationFailed, message, help });
        }
        for (i, part) in parts.iter().enumerate() {
            let (path, shared) = match i {
                0 => (main.clone(), None),
                _ => (main.with_file_name(part_name(job, to, part)), Some(Sha256::digest(&part.text).into())),
            };
            held.push(hold(path, shared, &mut |out| out.write_all(&part.text))?);
        }
        Ok(held)
    }
}

fn file_name(path: &Path) -> String {
    path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

fn part_name(job: &Job, to: &Dialect, part: &split::Part) -> String {
    match part.extension() {
        Some(extension) => format!("{}.{extension}", part.stem()),
        None => job.machines.with_extension(to, part.stem()),
    }
}

/// Makes the folder that a file is to be in.
pub(super) fn make_folder(path: &Path) -> Result<(), Problem> {
    let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) else { return Ok(()) };
    fs::create_dir_all(folder).map_err(|error| {
        let shown = folder.display().to_string();
        let mut problem = Problem::file("make the folder", &shown, &error);
        if matches!(error.kind(), io::ErrorKind::AlreadyExists | io::ErrorKind::NotADirectory) {
            problem.message = format!("cannot make the folder {shown}: there is a file of that name");
        }
        problem
    })
}

/// The number of a program, counted up from the first one's.
fn number(first: u32, at: usize) -> Result<u32, Problem> {
    let number = u32::try_from(at).ok().and_then(|at| first.checked_add(at));
    number.filter(|number| *number <= MOST_NUMBER).ok_or_else(|| {
        Problem::usage(
            format!("--program-number {first} counts up over {MOST_NUMBER}"),
            "begin with a lower number",
        )
    })
}

/// A file beside a program that has the name of one that it calls: the name itself, or its number.
fn beside(caller: &Path, name: &str) -> Option<String> {
    let folder = caller.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let digits = |text: &str| -> Option<u64> { text.parse().ok() };
    let is_meant = |stem: &str| {
        let number = stem.strip_prefix(|c: char| c.is_ascii_alphabetic()).unwrap_or(stem);
        stem.eq_ignore_ascii_case(name) || (digits(name).is_some() && digits(number) == digits(name))
    };
    let mut names: Vec<String> = fs::read_dir(folder)
        .ok()?
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter(|file| Some(file.as_str()) != caller.file_name().and_then(|own| own.to_str()))
        .filter(|file| is_meant(file.rsplit_once('.').map_or(file.as_str(), |(stem, _)| stem)))
        .collect();
    names.sort();
    names.into_iter().next()
}
