//! The project file of a program: `ncc.toml`, which ends the options on each call.
//!
//! The nearest file counts, searched upward from the program's folder; files are not merged, and paths in one are
//! relative to its folder. A row of it is settled with the options of the call (`settle`): an option goes before the
//! file, and a contradiction is reported. Not here: the form of the file (`ncc_machines::project`), and what a profile
//! does to a program (`machines::pair`).
//!
//! ```text
//! [[programs]]
//! files = "old/*.nc"
//! machine = "haas-vf2.toml"
//! ```

pub mod args;
pub mod config;
pub mod init;
mod load;
pub(crate) mod projects;
mod settle;

pub(crate) use projects::{InForce, Projects};
pub(crate) use settle::{Settled, Sides, Stated, goes_before, settle};
use std::path::Path;
use std::sync::Arc;

use codespan_reporting::term::termcolor::WriteColor;
use ncc_driver::job::project_answers::Used;
use ncc_driver::problem::Problem;

use crate::registry::DialectRegistry;

/// Which program a project file is asked about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Look<'a> {
    /// One in a file: the search begins in its folder.
    File(&'a Path),
    /// One that git knows by its path: the search begins in the working folder.
    Git(&'a Path),
    /// One that git hands over in a file of its own, of which only the name is that of the program.
    Named(&'a str),
    /// None: no project file counts.
    Nothing,
}

impl DialectRegistry {
    /// What the project file says of a program.
    ///
    /// # Errors
    /// The file cannot be read or has faults, which are reported on `err`; two of its rows match the program.
    pub(crate) fn project(
        &self,
        look: Look,
        err: &mut dyn WriteColor,
    ) -> Result<Option<Arc<InForce>>, Problem> {
        match self.projects() {
            Some(projects) => projects.find(look, self, err),
            None => Ok(None),
        }
    }
}

/// What the project file says of a program in a file. With `say`, a file of which no row is about it is reported.
///
/// # Errors
/// As of [`DialectRegistry::project`].
pub(crate) fn row(
    path: &Path,
    say: bool,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<Option<Arc<InForce>>, Problem> {
    let row = known.project(Look::File(path), err)?;
    if say && row.is_none() && path.is_file() {
        let folder = path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
        let nearest =
            known.projects().map(|projects| projects.nearest(folder, known, err)).transpose()?.flatten();
        if let Some((file, _)) = nearest {
            let _ = writeln!(err, "{}: no pattern of {} matches it", path.display(), file.shown);
        }
    }
    Ok(row)
}

/// Prints what a project file answers for a program, in a line, and each contradiction.
pub(crate) fn note(shown: &str, used: &Used, err: &mut dyn WriteColor) {
    // What cannot be reported changes nothing about what is done.
    let _ = writeln!(err, "{shown}: {}", used.line());
    for line in &used.overridden {
        let _ = writeln!(err, "  {line}");
    }
}
