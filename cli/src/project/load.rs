//! Finding a project file, reading it, and the row of a program.

use std::path::{Component, Path, PathBuf};
use std::sync::{Arc, PoisonError};
use std::{fs, io};

use codespan_reporting::diagnostic::Severity;
use codespan_reporting::term::termcolor::WriteColor;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::simulate::raw::{self, NoBody};
use ncc_machines::project::{MachineRef, NAME, Programs, Project};
use ncc_machines::{Profile, ProfileError, Wrong, shipped};
use sha2::{Digest, Sha256};
use toml::Spanned;

use super::Look;
use super::projects::{InForce, Loaded, Projects, Row, Value};
use crate::machines;
use crate::registry::DialectRegistry;

/// The commands that list every key.
pub(super) const SCHEMAS: &str =
    "`ncc config --schema` lists the keys of this file, `ncc machines schema` those of a machine";

impl InForce {
    /// Whether a path is below the folder of the outputs.
    pub(crate) fn has_output(&self, path: &Path) -> bool {
        let whole = |path: &Path| fs::canonicalize(path).ok();
        let folder = self.output.as_ref().and_then(|folder| whole(&folder.value.1));
        folder.zip(whole(path)).is_some_and(|(folder, path)| path.starts_with(folder))
    }
}

impl Projects {
    /// What the nearest file says of a program.
    ///
    /// # Errors
    /// As of [`DialectRegistry::project`].
    pub(super) fn find(
        &self,
        look: Look,
        known: &DialectRegistry,
        err: &mut dyn WriteColor,
    ) -> Result<Option<Arc<InForce>>, Problem> {
        let here = Path::new(".");
        let (folder, below) = match look {
            Look::Nothing => return Ok(None),
            Look::File(path) if path == Path::new("-") => return Ok(None),
            Look::File(path) => {
                let Some(name) = path.file_name() else { return Ok(None) };
                (path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(here), Path::new(name))
            }
            Look::Git(path) => (here, path),
            Look::Named(_) => (here, here),
        };
        let Some((loaded, start)) = self.nearest(folder, known, err)? else { return Ok(None) };
        let row = match look {
            Look::Named(name) => loaded.project.row_by_name(name),
            _ => match below_of(&loaded.path, &start.join(below)) {
                Some(path) => loaded.project.row(&path).map_err(|wrong| loaded.report(&[wrong], err))?,
                None => None,
            },
        };
        let Some(at) = row else { return Ok(None) };
        let key = (loaded.path.clone(), at);
        let mut rows = self.rows.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(row) = rows.get(&key) {
            return Ok(Some(Arc::clone(row)));
        }
        let row = Arc::new(loaded.row(at, known, err)?);
        rows.insert(key, Arc::clone(&row));
        Ok(Some(row))
    }

    /// The nearest file, upward from a folder, and that folder by its whole path.
    ///
    /// # Errors
    /// It cannot be read, or has faults.
    pub(super) fn nearest(
        &self,
        folder: &Path,
        known: &DialectRegistry,
        err: &mut dyn WriteColor,
    ) -> Result<Option<(Arc<Loaded>, PathBuf)>, Problem> {
        // A folder that is not there is reported where the program is opened.
        let Ok(start) = fs::canonicalize(folder) else { return Ok(None) };
        let found =
            start.ancestors().map(|folder| folder.join(NAME)).find(|path| path.symlink_metadata().is_ok());
        let Some(path) = found else { return Ok(None) };
        let mut read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(loaded) = read.get(&path) {
            return Ok(Some((Arc::clone(loaded), start)));
        }
        let loaded = Arc::new(load(path.clone(), known, err)?);
        read.insert(path, Arc::clone(&loaded));
        Ok(Some((loaded, start)))
    }
}

/// A path from the folder of a file, with `/` between folders; `None` if it is not below.
fn below_of(file: &Path, path: &Path) -> Option<String> {
    let mut parts: Vec<String> = Vec::new();
    for part in path.strip_prefix(file.parent()?).ok()?.components() {
        match part {
            Component::Normal(part) => parts.push(part.to_string_lossy().into_owned()),
            Component::ParentDir => drop(parts.pop()?),
            Component::CurDir => {}
            Component::RootDir | Component::Prefix(_) => return None,
        }
    }
    Some(parts.join("/"))
}

/// A path as it is reported and used: from the working folder where it is below that or above it.
fn near(path: &Path) -> PathBuf {
    let Some(here) = std::env::current_dir().ok().and_then(|here| fs::canonicalize(here).ok()) else {
        return path.to_owned();
    };
    if let Ok(below) = path.strip_prefix(&here) {
        return if below == Path::new("") { PathBuf::from(".") } else { below.to_owned() };
    }
    for (up, folder) in here.ancestors().enumerate().skip(1) {
        // The root is near nothing.
        if folder.parent().is_none() {
            break;
        }
        if let Ok(below) = path.strip_prefix(folder) {
            return PathBuf::from("../".repeat(up)).join(below);
        }
    }
    path.to_owned()
}

fn load(path: PathBuf, known: &DialectRegistry, err: &mut dyn WriteColor) -> Result<Loaded, Problem> {
    let shown = near(&path).display().to_string();
    let ignored = |mut problem: Problem| {
        problem.help.push("`--no-config` ignores it".to_owned());
        problem
    };
    let bytes = match path.is_dir() {
        true => Err(io::ErrorKind::IsADirectory.into()),
        false => fs::read(&path),
    };
    let bytes = bytes.map_err(|e: io::Error| ignored(Problem::file("read", &shown, &e)))?;
    let sha256 = Sha256::digest(&bytes).into();
    let text = String::from_utf8(bytes).map_err(|_| {
        ignored(Problem {
            exit: Exit::File,
            message: format!("cannot read {shown}: it is not UTF-8"),
            help: vec!["a project file is a TOML file, in UTF-8".to_owned()],
        })
    })?;
    let project = match Project::parse(&text, &|id| known.get(id)) {
        Ok(project) => project,
        Err(wrong) => return Err(report_faults(&shown, &text, &wrong, err)),
    };
    let loaded = Loaded { path, shown, text, sha256, project };
    let mut wrong: Vec<ProfileError> =
        loaded.project.rows.iter().flat_map(|row| loaded.not_there(row, known)).collect();
    wrong.sort_by_key(|error| error.span.start);
    if wrong.is_empty() { Ok(loaded) } else { Err(loaded.report(&wrong, err)) }
}

/// Prints what is wrong with a file.
fn report_faults(shown: &str, text: &str, wrong: &[ProfileError], err: &mut dyn WriteColor) -> Problem {
    // If stderr cannot be written, the exit code has to say it all.
    let _ = machines::print_as(Severity::Error, SCHEMAS, shown, text, wrong, err);
    let first = wrong.first().map(|error| machines::place(text, error.span.start)).unwrap_or_default();
    Problem {
        exit: Exit::Usage,
        message: format!("{shown} cannot be used: {}{first}", machines::count(wrong.len(), "error")),
        help: vec!["`--no-config` ignores it".to_owned()],
    }
}

impl Loaded {
    /// Its folder.
    pub(crate) fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new("."))
    }

    /// The line of a place, from 1.
    pub(crate) fn line(&self, at: usize) -> usize {
        self.text.get(..at).unwrap_or_default().matches('\n').count() + 1
    }

    pub(super) fn report(&self, wrong: &[ProfileError], err: &mut dyn WriteColor) -> Problem {
        report_faults(&self.shown, &self.text, wrong, err)
    }

    /// A path that is written in it, from the working folder.
    fn at(&self, written: &str) -> PathBuf {
        near(&self.folder().join(written))
    }

    /// What a row names and is not there.
    fn not_there(&self, row: &Programs, known: &DialectRegistry) -> Vec<ProfileError> {
        let machine = |machine: &Option<MachineRef>| match machine {
            Some(MachineRef::Named(name)) if !self.is_machine(name.get_ref()) => {
                let name_ = name.get_ref().clone();
                let is_dialect = known.get(&name_).is_some();
                let has = shipped().iter().map(|profile| profile.id().to_owned()).collect();
                Some(ProfileError::new(Wrong::NoMachine { name: name_, has, is_dialect }, name.span()))
            }
            Some(_) | None => None,
        };
        let folder = |name: &Spanned<String>| {
            let there = self.at(name.get_ref()).is_dir();
            (!there).then(|| ProfileError::new(Wrong::NoFolder { name: name.get_ref().clone() }, name.span()))
        };
        let folders = row.include.iter().filter_map(folder);
        let body = |text: &Spanned<String>| {
            let fault = raw::stated(text.get_ref()).err()?;
            let wrong = Wrong::NoBody { text: text.get_ref().clone(), is_range: fault == NoBody::Range };
            Some(ProfileError::new(wrong, text.span()))
        };
        let bodies = row.stock.iter().chain(&row.fixtures).filter_map(body);
        machine(&row.machine).into_iter().chain(machine(&row.to)).chain(folders).chain(bodies).collect()
    }

    fn is_machine(&self, name: &str) -> bool {
        ncc_machines::find(name).is_some() || self.at(name).is_file()
    }

    /// A row with its machines.
    pub(super) fn row(
        self: &Arc<Loaded>,
        at: usize,
        known: &DialectRegistry,
        err: &mut dyn WriteColor,
    ) -> Result<InForce, Problem> {
        let row = &self.project.rows[at];
        let mut machine = |machine: &Option<MachineRef>| match machine {
            None => Ok::<_, Problem>(None),
            Some(MachineRef::Inline(profile, span)) => {
                let profile = Arc::new(Profile::clone(profile));
                Ok(Some(Row { profile, named: None, found: None, line: self.line(span.start) }))
            }
            Some(MachineRef::Named(name)) => {
                let own = name.get_ref().as_str();
                let found = match ncc_machines::find(own) {
                    Some(_) => own.to_owned(),
                    None => self.at(own).display().to_string(),
                };
                let profile = Arc::new(machines::find(&found, known, err)?);
                let line = self.line(name.span().start);
                Ok(Some(Row { profile, named: Some(own.to_owned()), found: Some(found), line }))
            }
        };
        let path = |name: &Spanned<String>| Value {
            value: (name.get_ref().clone(), self.at(name.get_ref())),
            line: self.line(name.span().start),
        };
        let body = |text: &Spanned<String>| {
            let stated = match raw::stated(text.get_ref()).ok()? {
                raw::Stated::File(name) => raw::Stated::File(self.at(&name).display().to_string()),
                shape @ raw::Stated::Shape(_) => shape,
            };
            Some(Value { value: (text.get_ref().clone(), stated), line: self.line(text.span().start) })
        };
        let pattern = |pattern: &ncc_machines::project::Pattern| Value {
            value: pattern.text.get_ref().clone(),
            line: self.line(pattern.text.span().start),
        };
        Ok(InForce {
            machine: machine(&row.machine)?,
            to: machine(&row.to)?,
            files: row.files.iter().map(pattern).collect(),
            include: row.include.iter().map(path).collect(),
            output: row.output.as_ref().map(path),
            stock: row.stock.as_ref().and_then(body),
            fixtures: row.fixtures.iter().filter_map(body).collect(),
            table: row
                .table
                .as_ref()
                .map(|table| Value { value: *table.get_ref(), line: self.line(table.span().start) }),
            file: Arc::clone(self),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_is_below_the_file() {
        let of = |path: &str| below_of(Path::new("/shop/ncc.toml"), Path::new(path));
        assert_eq!(of("/shop/old/a.nc").as_deref(), Some("old/a.nc"));
        assert_eq!(of("/shop/old/../a.nc").as_deref(), Some("a.nc"));
        assert_eq!((of("/shop/../a.nc"), of("/other/a.nc")), (None, None));
    }
}
