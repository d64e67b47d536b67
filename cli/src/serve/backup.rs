//! `ncc serve backup` and `ncc serve restore`.

use std::path::PathBuf;

use clap::Args;
use ncc_driver::problem::{Exit, Problem};

use super::database::{Database, unusable};
use crate::files;

/// `ncc serve backup`.
#[derive(Debug, Args)]
#[command(after_help = "\
The backup is an SQLite file, whichever database it is of; nobody else may read it. Servers may go on meanwhile.")]
pub struct Backup {
    /// The new file
    pub file: PathBuf,
    /// The database
    #[command(flatten)]
    pub database: Database,
}

/// `ncc serve restore`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  ncc serve restore monday.sqlite --database new.sqlite
  NCC_DATABASE_URL=postgres://ncc@localhost/ncc ncc serve restore monday.sqlite
                                                from one file to a server")]
pub struct Restore {
    /// The backup
    pub file: PathBuf,
    /// The database
    #[command(flatten)]
    pub database: Database,
}

/// Copies a database.
///
/// # Errors
/// Wrong usage, a file, or the database.
pub(super) fn backup(args: &Backup) -> Result<Exit, Problem> {
    let shown = args.file.display();
    if args.file.symlink_metadata().is_ok() {
        return Err(Problem::usage(
            format!("{shown} is there already"),
            "name a new file; nothing is written over",
        ));
    }
    let rows = ncc_service::backup(&args.database.place()?, &args.file).map_err(|why| unusable(&why))?;
    files::to_stdout(&mut |out| writeln!(out, "{shown}: {rows} rows"))?;
    Ok(Exit::Done)
}

/// Makes an empty database what a backup has.
///
/// # Errors
/// As of [`backup`].
pub(super) fn restore(args: &Restore) -> Result<Exit, Problem> {
    let shown = args.file.display();
    let cannot = |why: String| Problem {
        exit: Exit::File,
        message: format!("cannot restore {shown}: {why}"),
        help: vec!["nothing was restored; the database stays as it was".to_owned()],
    };
    let rows = ncc_service::restore(&args.database.place()?, &args.file).map_err(cannot)?;
    files::to_stdout(&mut |out| writeln!(out, "{shown}: {rows} rows restored"))?;
    Ok(Exit::Done)
}
