//! `ncc translate` of several programs: files and folders in, a folder out.
//!
//! Each program is translated as it is by itself, on one of several threads; reports come in the order
//! of the files. A program that gives nothing does not stop the others. No output has the name of a
//! source or of another program's output, nor that of a subprogram which is there and another: such
//! programs are refused before anything is written.
//!
//! Refused here: programs of several files, which are not put together; one report, map or program on
//! stdin for several.
//!
//! ```text
//! ncc translate old/ --from fanuc --to siemens -o new/    new/a.mpf, new/b.mpf, and a line on each
//! ```

pub(crate) mod gather;
mod names;
mod orders;
pub(crate) mod per_tool;
mod pool;
mod progress;
mod summary;
mod work;

use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Instant;

use codespan_reporting::term::termcolor::{Buffer, WriteColor};
use ncc_dialects::Dialect;
use ncc_driver::job::file_per_tool;
use ncc_driver::translate::split;

pub use self::summary::SCHEMA;

use self::gather::{Gathered, gather, identity};
use self::names::Claim;
use self::orders::{Orders, several, where_to};
use self::progress::Progress;
use self::summary::{Result as Came, Row, Summary};
use self::work::{Bench, Done, Held, Store, make_folder};
use crate::args::Translate;
use crate::args::typed::Format;
use crate::files;
use crate::registry::DialectRegistry;
use crate::target_options::TargetOptions;
use ncc_driver::problem::Exit;
use ncc_driver::problem::Problem;
use ncc_driver::problem::as_write;
use ncc_driver::source::include_path;

/// Whether a command is about several programs, or about a folder of outputs.
pub(crate) fn is_meant(args: &Translate) -> bool {
    let ends_as_folder = |path: &PathBuf| {
        path.as_os_str().to_string_lossy().ends_with(std::path::is_separator) && !path.exists()
    };
    args.files.len() > 1
        || args.files.iter().any(|file| file.is_dir())
        || args.split
        || args.output.as_ref().is_some_and(ends_as_folder)
}

/// Translates several programs.
///
/// # Errors
/// Nothing can be translated: the command makes no sense, or the folder of the outputs cannot be made.
pub(crate) fn run(
    args: &Translate,
    arrow: Option<&'static Dialect>,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<Exit, Problem> {
    let begun = Instant::now();
    // For a reader of JSON, the problem alone says where.
    let mut nowhere = Buffer::no_color();
    // A command need not say what project files say, so this failure alone is no error.
    let mut aside = if err.supports_color() { Buffer::ansi() } else { Buffer::no_color() };
    let plain = TargetOptions::find(args, known, None, &mut aside);
    let one = matches!(args.files.as_slice(), [file] if !file.is_dir());
    if plain.as_ref().is_ok_and(|order| one && file_per_tool(&order.to)) {
        per_tool::check(args, None, arrow)?;
    }
    let folder = output_folder(args, known)?;
    let extensions = extensions(plain.as_ref().ok(), known);
    let mut found = gather(&args.files, &extensions, folder.as_deref());
    let told: &mut dyn WriteColor = if args.format == Format::Json { &mut nowhere } else { err };
    let failed = plain.is_err();
    let orders = Orders::of(args, plain, folder.as_deref(), &found, known, told);
    if failed && orders.is_err() {
        // If nobody can read it, there is nobody to tell.
        let _ = as_write(told).write_all(aside.as_slice());
    }
    let mut orders = orders?;
    if folder.is_none() {
        orders.leave_outputs(&mut found);
    }
    let (found, orders) = (found, orders);
    let Some(to) = orders.target() else { return Err(where_to(args)) };
    if args.split && !split::can(to) {
        return Err(Problem::usage(
            format!("subprograms of {} are no files of their own", to.id),
            "leave --split out",
        ));
    }
    if found.items.is_empty() {
        return Err(nothing(&found, &extensions));
    }
    let split = !args.no_split && (args.split || split::usual(to));
    // Names that follow from what is in the programs are known at the end.
    let late = split
        || orders.orders().any(|(order, _)| order.machines.names_by_number())
        || include_path::by_files(to);
    let late = late || orders.orders().any(|(order, _)| file_per_tool(&order.to));
    let sources: BTreeSet<_> = found.items.iter().filter_map(|item| identity(&item.path)).collect();
    let shown = |at: usize| found.items[at].path.display().to_string();
    let mut refused: BTreeMap<usize, Problem> = orders.refused().collect();
    if !late {
        refused.extend(names::refused(&planned(&orders, &found), &sources, &shown));
    }
    for (_, folder) in orders.orders() {
        make_folder(&folder.join("x"))?;
    }
    let store = match late {
        true => Some(Mutex::new(Store::new().map_err(|e| Problem::file("write", "a temporary file", &e))?)),
        false => None,
    };
    let bench = Bench {
        args,
        orders: &orders,
        known,
        items: &found.items,
        refused: &refused,
        split,
        store: store.as_ref(),
        colour: err.supports_color(),
    };
    let (mut rows, mut held) = translate_all(&bench, err)?;
    for (path, problem) in &found.unread {
        let mut row = Row::new(path.display().to_string());
        row.fails(Came::NotTranslated, problem);
        rows.push(row);
        say(args, problem, err);
    }
    if let Some(store) = &store {
        let mut store = store.lock().unwrap_or_else(PoisonError::into_inner);
        give_way(&mut held, &mut rows);
        write_all(args, &mut store, &held, &sources, &mut rows, err);
    }
    let summary = Summary {
        to: &to.id,
        folder: folders(&orders),
        exit: rows.iter().fold(Exit::Done, |exit, row| exit.and(row.exit)),
        rows,
        skipped: &found.skipped,
        seconds: (begun.elapsed().as_secs_f64() * 1e3).round() / 1e3,
        verbose: args.telling.verbose,
        letter: to.program.number,
    };
    tell(args, arrow, &summary, err)?;
    Ok(summary.exit)
}

/// The folders of the outputs, each once.
fn folders(orders: &Orders) -> String {
    let all: BTreeSet<String> = orders.orders().map(|(_, folder)| folder.display().to_string()).collect();
    all.into_iter().collect::<Vec<_>>().join(", ")
}

/// The folder of the outputs that the command names.
fn output_folder(args: &Translate, known: &DialectRegistry) -> Result<Option<PathBuf>, Problem> {
    let several = several(args);
    let folder = match &args.output {
        Some(name) if name != Path::new("-") => Some(name.clone()),
        // A project file may name it.
        None if known.projects().is_some() => None,
        Some(_) | None => return Err(where_to(args)),
    };
    if let Some(folder) = folder.as_ref().filter(|folder| folder.exists() && !folder.is_dir()) {
        return Err(Problem::usage(
            format!("{several}: {} is a file", folder.display()),
            "the outputs go to a folder",
        ));
    }
    if args.files.iter().any(|file| file == Path::new("-")) && args.files.len() > 1 {
        return Err(Problem::usage("`-` among several programs", "translate stdin by itself"));
    }
    if args.map.is_some() {
        return Err(Problem::usage("--map is about one program", "translate it by itself"));
    }
    if args.report.is_some() {
        return Err(Problem::usage(
            "--report is about one program",
            "--format json prints one document about all of them",
        ));
    }
    Ok(folder)
}

/// Extensions of files in folders that are taken, in small letters.
fn extensions(order: Option<&TargetOptions>, known: &DialectRegistry) -> BTreeSet<String> {
    let of = |dialect: &Dialect| dialect.extensions.iter().map(|e| e.to_lowercase()).collect::<Vec<_>>();
    match order.and_then(|order| order.named) {
        Some(dialect) => of(dialect).into_iter().collect(),
        None => known.all().into_iter().flat_map(of).collect(),
    }
}

fn nothing(found: &Gathered, extensions: &BTreeSet<String>) -> Problem {
    if let Some((_, problem)) = found.unread.first() {
        return problem.clone();
    }
    let extensions: Vec<String> = extensions.iter().map(|e| format!(".{e}")).collect();
    let left = found.skipped.len();
    Problem::usage(
        format!("there is no program in the folders; {left} left out"),
        format!("of a folder, {} are taken; name other files themselves", extensions.join(", ")),
    )
}

/// Names of the outputs, where they follow from those of the sources.
fn planned(orders: &Orders, found: &Gathered) -> Vec<Claim> {
    let name = |path: &Path| path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    let claim = |(by, item): (usize, &gather::Item)| {
        let (order, folder) = orders.at(by)?;
        let name = order.machines.file_name(order.to.dialect, &name(&item.path), None);
        Some(Claim { by, path: folder.join(&item.below).join(name), shared: None })
    };
    found.items.iter().enumerate().filter_map(claim).collect()
}

/// Translates all, and tells of each in its turn.
fn translate_all(bench: &Bench, err: &mut dyn WriteColor) -> Result<(Vec<Row>, Vec<Vec<Held>>), Problem> {
    let args = bench.args;
    let jobs = match args.jobs {
        Some(jobs) => usize::from(jobs),
        None => thread::available_parallelism().map_or(1, usize::from),
    };
    let progress = Progress::new(bench.items.len(), !args.telling.quiet && args.format == Format::Human);
    let (mut rows, mut held) = (Vec::new(), Vec::new());
    let took = |_: usize, done: Done| {
        progress.aside(|| {
            // If nobody can read it, there is nobody to tell.
            let _ = as_write(err).write_all(done.messages.as_slice());
        });
        rows.push(done.row);
        held.push(done.held);
    };
    pool::each(bench.items.len(), jobs, |at| bench.one(at), || progress.ended(), took)
        .map_err(|e| Problem::file("start", "a thread", &e))?;
    Ok((rows, held))
}

/// Writes what has waited for its name.
/// Subprograms that stand alone have the names of their sources where a program of this command has them itself, under
/// the names by which they are called: it was verified with its own.
fn give_way(held: &mut [Vec<Held>], rows: &mut [Row]) {
    let keys = |all: &[Held]| all.iter().map(|held| names::key(&held.path)).collect::<Vec<_>>();
    let claimed: Vec<Vec<String>> = held.iter().map(|all| keys(all)).collect();
    for (at, all) in held.iter_mut().enumerate() {
        let [only] = &mut all[..] else { continue };
        let own = names::key(&only.path);
        let others = claimed.iter().enumerate().filter(|(other, _)| *other != at);
        if others.flat_map(|(_, keys)| keys).any(|key| *key == own)
            && let Some(otherwise) = only.otherwise.take()
        {
            rows[at].outputs = vec![otherwise.display().to_string()];
            only.path = otherwise;
        }
    }
}

fn write_all(
    args: &Translate,
    store: &mut Store,
    held: &[Vec<Held>],
    sources: &BTreeSet<gather::Identity>,
    rows: &mut [Row],
    err: &mut dyn WriteColor,
) {
    let claims: Vec<Claim> = held
        .iter()
        .enumerate()
        .flat_map(|(by, all)| all.iter().map(move |held| (by, held)))
        .map(|(by, held)| Claim { by, path: held.path.clone(), shared: held.shared })
        .collect();
    let shown = |by: usize| rows[by].file.clone();
    let mut refused = names::at_odds_with_the_folder(&claims, &shown);
    refused.extend(names::refused(&claims, sources, &shown));
    for (at, held) in held.iter().enumerate() {
        if !refused.contains_key(&at) {
            say_anew(args, held, err);
        }
        // The main program comes last: what it calls is there when it is.
        let written = match refused.get(&at) {
            Some(problem) => Err(problem.clone()),
            None => held.iter().rev().try_for_each(|held| write_one(store, held)),
        };
        if let (Err(problem), Some(row)) = (written, rows.get_mut(at)) {
            row.fails(Came::NotWritten, &problem);
            say(args, &problem, err);
        }
    }
}

/// Tells which subprograms become others: programs that are not of this command may call them too.
fn say_anew(args: &Translate, held: &[Held], err: &mut dyn WriteColor) {
    if args.format != Format::Human || args.telling.quiet {
        return;
    }
    for held in held {
        if held.shared.is_some_and(|own| names::holds_another(&held.path, &own)) {
            let path = held.path.display();
            // Nothing depends on whether somebody reads it.
            let _ =
                writeln!(as_write(err), "{path} becomes another; whatever calls it there calls the new one");
        }
    }
}

fn write_one(store: &mut Store, held: &Held) -> Result<(), Problem> {
    make_folder(&held.path)?;
    files::to_file(&held.path, &mut |out| store.get(&held.range, out))
}

/// Tells a problem that does not stop the rest. The summary and the exit code say it too.
fn say(args: &Translate, problem: &Problem, err: &mut dyn WriteColor) {
    if args.format == Format::Human {
        let _ = problem.print(err, false);
    }
}

fn tell(
    args: &Translate,
    arrow: Option<&'static Dialect>,
    summary: &Summary,
    err: &mut dyn WriteColor,
) -> Result<(), Problem> {
    let mut text = Vec::new();
    let done: io::Result<()> = match args.format {
        Format::Json => summary.json(&mut text),
        Format::Human if args.telling.quiet => Ok(()),
        Format::Human => text.write_all(summary.table().as_bytes()),
    };
    done.map_err(|e| Problem::file("write", "the summary", &e))?;
    match arrow {
        None if args.format == Format::Json => files::data_to_stdout(&mut |out| out.write_all(&text)),
        None => files::to_stdout(&mut |out| out.write_all(&text)),
        Some(to) => {
            // stdout is a file that the shell has made.
            let _ = as_write(err).write_all(&text);
            if args.format == Format::Human && !args.telling.quiet {
                let _ = writeln!(
                    err,
                    "The empty file `{0}` of this folder is the shell's, which took `> {0}` for a redirection.",
                    to.id
                );
            }
            Ok(())
        }
    }
}
