//! `ncc serve import`: the programs of a folder, put into a database.
//!
//! The files are those that `ncc translate` of the folder takes, but links are not followed. Not here: how a program is kept
//! (`ncc_service`).

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use codespan_reporting::term::termcolor::WriteColor;
use ncc_driver::guess::{Guess, guess};
use ncc_driver::problem::{Exit, Problem, as_write};
use ncc_driver::render::numbers::plural;
use ncc_driver::source::Source;
use ncc_service::{Entry, Imported, NotImported};

use super::database::{Database, author, unusable};
use crate::batch::gather::{Gathered, Item, gather};
use crate::files;

/// `ncc serve import`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  ncc serve import programs/ --into shop/mill-3
  ncc serve import old/ --from fanuc --machine fanuc-vmc

A program is found again by its folder and name: the same text is no new revision, another one is. Servers may run meanwhile. \
Exit code 1 if a file was left out because of what is in it, 4 if one could not be read.")]
pub struct Import {
    /// The folder; its sub-folders too
    pub folder: PathBuf,
    /// The folder of the database that they go into [default: the top]
    #[arg(long, value_name = "FOLDER", default_value = "", hide_default_value = true)]
    pub into: String,
    /// Their dialect [default: that of the machine, or the one that each is recognised as]
    #[arg(long, value_name = "DIALECT")]
    pub from: Option<String>,
    /// Their machine
    #[arg(long, value_name = "MACHINE")]
    pub machine: Option<String>,
    /// The name under which changes are kept [default: that of the user of this computer]
    #[arg(long, value_name = "NAME")]
    pub author: Option<String>,
    /// The database
    #[command(flatten)]
    pub database: Database,
    /// Name what is left out
    #[arg(short, long)]
    pub verbose: bool,
}

/// Results of the files.
#[derive(Debug)]
struct Account {
    /// Programs by what they have become: new, changed, the same.
    counts: [u64; 3],
    /// Those without a certain dialect.
    unsure: u64,
    /// Files that were left out, each with the reason.
    left_out: Vec<(PathBuf, String)>,
    exit: Exit,
}

/// Puts the programs of a folder into a database.
///
/// # Errors
/// Wrong usage, or a database that cannot be used.
pub(super) fn run(args: &Import, err: &mut dyn WriteColor) -> Result<Exit, Problem> {
    let begun = Instant::now();
    let shown = args.folder.display();
    if !args.folder.is_dir() {
        return Err(Problem::usage(format!("{shown} is no folder"), "name the folder of the programs"));
    }
    let import = ncc_service::Import::open(&args.database.place()?, &author(args.author.as_deref()));
    let import = import.map_err(|why| unusable(&why))?;
    let stated = import.dialect(args.from.as_deref().unwrap_or_default());
    let dialects = match stated.map_err(|(what, help)| Problem::usage(what, help))? {
        Some(dialect) => vec![dialect],
        None => ncc_dialects::builtins().collect(),
    };
    if let Some(name) = &args.machine
        && !import.has_machine(name).map_err(|why| unusable(&why))?
    {
        return Err(Problem::usage(
            format!("there is no machine `{name}`"),
            "put its profile in first: PUT /api/v1/machines/NAME; `ncc machines` lists those that come with ncc",
        ));
    }
    let extensions = dialects.iter().flat_map(|own| &own.extensions);
    let extensions: BTreeSet<String> = extensions.map(|extension| extension.to_lowercase()).collect();
    let found = gather(std::slice::from_ref(&args.folder), &extensions, None);
    let mut account = Account { counts: [0; 3], unsure: 0, left_out: Vec::new(), exit: Exit::Done };
    for item in &found.items {
        if ncc_exec::halt::is_asked() {
            account.exit = Exit::Interrupted;
            break;
        }
        match one(args, item, &import, &mut account.unsure) {
            Ok(became) => account.counts[became as usize] += 1,
            Err(NotImported::Database(why)) => return Err(unusable(&why)),
            Err(not) => {
                let exit = if matches!(not, NotImported::File(_)) { Exit::File } else { Exit::Refused };
                account.exit = account.exit.and(exit);
                // If nobody can read it, there is nobody to tell; the summary and the exit code have it too.
                let _ = writeln!(as_write(err), "{}: {not}", item.path.display());
                account.left_out.push((item.path.clone(), not.to_string()));
            }
        }
    }
    for (path, problem) in &found.unread {
        account.exit = account.exit.and(problem.exit);
        let _ = writeln!(as_write(err), "{}", problem.message);
        account.left_out.push((path.clone(), problem.message.clone()));
    }
    if found.items.is_empty() && found.unread.is_empty() {
        let extensions: Vec<String> = extensions.iter().map(|extension| format!(".{extension}")).collect();
        let help = format!("of a folder, {} are taken", extensions.join(", "));
        return Err(Problem::usage(format!("there is no program in {shown}"), help));
    }
    files::to_stdout(&mut |out| summary(args, &account, &found, begun.elapsed().as_secs_f64(), out))?;
    Ok(account.exit)
}

/// Puts one file in.
fn one(
    args: &Import,
    item: &Item,
    import: &ncc_service::Import,
    unsure: &mut u64,
) -> Result<Imported, NotImported> {
    let refused = |words: &str| NotImported::Refused(words.to_owned());
    if fs::symlink_metadata(&item.path).map_err(NotImported::File)?.is_symlink() {
        return Err(refused("it is a link"));
    }
    let name = item.path.file_name().and_then(|name| name.to_str());
    let name = name.ok_or_else(|| refused("its name is no text in UTF-8"))?;
    let folder =
        folder(&args.into, &item.below).ok_or_else(|| refused("its folder's name is no text in UTF-8"))?;
    let file = File::open(&item.path).map_err(NotImported::File)?;
    let mut source = Source::of(file, name);
    if source.is_no_text().map_err(|problem| NotImported::Refused(problem.message))? {
        return Err(refused("it is no text"));
    }
    let dialect = match (&args.from, &args.machine) {
        (Some(id), _) => id.as_str(),
        // The machine says it.
        (None, Some(_)) => "",
        (None, None) => {
            match guess(&mut source.file, ncc_dialects::builtins()).map_err(NotImported::File)? {
                Guess::Sure(dialect, ..) => &dialect.id,
                Guess::Unsure(_) => {
                    *unsure += 1;
                    ""
                }
            }
        }
    };
    let machine = args.machine.as_deref().unwrap_or_default();
    import.put(&Entry { folder: &folder, name, dialect, machine }, &mut source.file)
}

/// The folder of the database for a sub-folder.
fn folder(into: &str, below: &Path) -> Option<String> {
    let into = into.split('/').filter(|part| !part.is_empty()).map(Some);
    let below = below.components().map(|part| part.as_os_str().to_str());
    let parts: Option<Vec<&str>> = into.chain(below).collect();
    Some(parts?.join("/"))
}

fn summary(
    args: &Import,
    account: &Account,
    found: &Gathered,
    seconds: f64,
    out: &mut dyn Write,
) -> std::io::Result<()> {
    let [new, changed, same] = account.counts;
    let all = new + changed + same;
    write!(out, "{all} {}: {new} new, {changed} changed, {same} the same", plural(all, "program"))?;
    if account.unsure > 0 {
        write!(out, "; {} in no certain dialect", account.unsure)?;
    }
    if !account.left_out.is_empty() {
        write!(out, "; {} not imported", account.left_out.len())?;
    }
    writeln!(out, "; {seconds:.2} s")?;
    if !found.skipped.is_empty() {
        let hint = if args.verbose { "" } else { " (--verbose names them)" };
        let count = found.skipped.len() as u64;
        writeln!(out, "left out: {count} other {}{hint}", plural(count, "file"))?;
    }
    for skipped in found.skipped.iter().filter(|_| args.verbose) {
        writeln!(out, "  {}: {}", skipped.path.display(), skipped.reason.words(false))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_are_kept() {
        assert_eq!(folder("", Path::new("")).as_deref(), Some(""));
        assert_eq!(folder("/shop//a/", Path::new("b/c")).as_deref(), Some("shop/a/b/c"));
    }
}
