//! `ncc init`: writes a project file for a program, with what `ncc doctor` asks as comments.

use std::fs::File;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use clap::Args;
use codespan_reporting::term::termcolor::WriteColor;
use ncc_driver::problem::{Exit, Problem};
use ncc_machines::project::NAME;

use crate::args::pair;
use crate::doctor;
use crate::known::Known;

const EXAMPLES: &str = "\
Examples:
  ncc init part.nc --to siemens               writes `ncc.toml` beside the program
  ncc init part.nc --from haas --to siemens   the same, where the dialect cannot be recognised
  ncc to siemens part.nc                      what is in the file needs no option any more";

/// `ncc init`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Init {
    /// A program of the folder
    #[arg(value_name = "PROGRAM")]
    pub program: PathBuf,
    /// Dialect to translate into
    #[arg(long, value_name = "DIALECT")]
    pub to: Option<String>,
    /// Dialect of the program, or `auto` to recognise it [default: the machine's, else auto]
    #[arg(long, value_name = "DIALECT")]
    pub from: Option<String>,
    /// The machine that the program was written for: a profile's name or file
    #[arg(long, value_name = "MACHINE")]
    pub machine_from: Option<String>,
    /// The machine to translate for
    #[arg(long, value_name = "MACHINE")]
    pub machine_to: Option<String>,
    /// Decide a question that the program's dictionary leaves open
    #[arg(long, value_name = "NAME=VALUE", value_parser = pair)]
    pub from_option: Vec<(String, String)>,
}

/// Writes the file.
///
/// # Errors
/// It is there already; wrong usage; a file that cannot be read or written.
pub fn run(args: &Init, known: &Known, err: &mut dyn WriteColor) -> Result<Exit, Problem> {
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
    let _ =
        writeln!(err, "{shown} is written; `ncc config {}` shows what is in force", args.program.display());
    if let Ok(Some(Some((other, _)))) = hidden {
        let _ = writeln!(err, "for the programs of this folder it goes before {}", other.shown);
    }
    Ok(Exit::Done)
}
