//! `ncc init`: writes a project file for a program, with what `ncc doctor` asks as comments.

use std::fs::File;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use codespan_reporting::term::termcolor::WriteColor;
use ncc_driver::problem::{Exit, Problem};
use ncc_machines::project::NAME;

use super::args::Init;
use crate::doctor;
use crate::registry::DialectRegistry;

/// Writes the file.
///
/// # Errors
/// It is there already; wrong usage; a file that cannot be read or written.
pub fn run(args: &Init, known: &DialectRegistry, err: &mut dyn WriteColor) -> Result<Exit, Problem> {
    let folder = args.program.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
    let path = match folder == Path::new(".") {
        true => PathBuf::from(NAME),
        false => folder.join(NAME),
    };
    let shown = path.display().to_string();
    let there = || {
        Problem::usage(format!("{shown} is there already"), "nothing is written over; `ncc config` shows it")
    };
    if args.program == Path::new("-") {
        return Err(Problem::usage("a program on stdin has no folder", "name the file of a program"));
    }
    if path.symlink_metadata().is_ok() {
        return Err(there());
    }
    let hidden = known.projects().map(|projects| projects.nearest(folder, known, err)).transpose();
    let text = doctor::project(args, known, err)?;
    let mut file = File::create_new(&path).map_err(|error| match error.kind() {
        io::ErrorKind::AlreadyExists => there(),
        _ => Problem::file("write", &shown, &error),
    })?;
    file.write_all(text.as_bytes()).map_err(|error| Problem::file("write", &shown, &error))?;
    // If nobody can read it, the file is there all the same.
    let _ = writeln!(err, "{shown} is written; `ncc config {}` shows what is active", args.program.display());
    if let Ok(Some(Some((other, _)))) = hidden {
        let _ = writeln!(err, "for the programs of this folder it goes before {}", other.shown);
    }
    Ok(Exit::Done)
}
