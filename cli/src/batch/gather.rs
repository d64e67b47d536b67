//! Which files a batch is about: those that are named, and those in folders that are.
//!
//! Of a folder, the files with an extension of the source's dialect are taken, its sub-folders too.
//! What is left out is remembered with the reason. Not here: reading what is in a file.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::{fs, io};

use ncc_driver::problem::Problem;

/// A file to be translated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Item {
    /// Where it is.
    pub(crate) path: PathBuf,
    /// Its sub-folder of the folder that was named, which its output has too.
    pub(crate) below: PathBuf,
}

/// A file that is left out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Skipped {
    /// Where it is.
    pub(crate) path: PathBuf,
    /// Why.
    pub(crate) reason: Reason,
}

/// Why a file is left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Reason {
    /// Its name begins with a point.
    Hidden,
    /// Its extension is none of the source's dialect.
    Extension,
    /// A folder behind a link: it may lead back to its own folder.
    LinkedFolder,
    /// Neither file nor folder.
    NoFile,
    /// The folder that the outputs go to.
    OutputFolder,
    /// It has been taken already.
    Twice,
}

impl Reason {
    /// Its name in a document.
    pub(super) fn name(self) -> &'static str {
        match self {
            Reason::Hidden => "hidden",
            Reason::Extension => "extension",
            Reason::LinkedFolder => "linked-folder",
            Reason::NoFile => "no-file",
            Reason::OutputFolder => "output-folder",
            Reason::Twice => "named-twice",
        }
    }

    /// What to say of so many.
    pub(crate) fn words(self, many: bool) -> &'static str {
        match (self, many) {
            (Reason::Hidden, _) => "hidden",
            (Reason::Extension, false) => "of another extension",
            (Reason::Extension, true) => "of other extensions",
            (Reason::LinkedFolder, false) => "a link to a folder",
            (Reason::LinkedFolder, true) => "links to folders",
            (Reason::NoFile, false) => "no file",
            (Reason::NoFile, true) => "no files",
            (Reason::OutputFolder, _) => "the folder of the outputs",
            (Reason::Twice, _) => "named twice",
        }
    }
}

/// What was found.
#[derive(Debug, Default)]
pub(crate) struct Gathered {
    /// To be translated, in the order in which they are named, and by name in a folder.
    pub(crate) items: Vec<Item>,
    /// Left out.
    pub(crate) skipped: Vec<Skipped>,
    /// Folders that cannot be read.
    pub(crate) unread: Vec<(PathBuf, Problem)>,
    seen: BTreeSet<Identity>,
}

/// What tells a file from all others.
#[cfg(unix)]
pub(super) type Identity = (u64, u64);
/// What tells a file from all others, hard links excepted.
#[cfg(not(unix))]
pub(super) type Identity = PathBuf;

/// What tells this file from all others; `None` if there is none.
#[cfg(unix)]
pub(super) fn identity(path: &Path) -> Option<Identity> {
    use std::os::unix::fs::MetadataExt;
    fs::metadata(path).ok().map(|m| (m.dev(), m.ino()))
}

/// What tells this file from all others; `None` if there is none.
#[cfg(not(unix))]
pub(super) fn identity(path: &Path) -> Option<Identity> {
    fs::canonicalize(path).ok()
}

/// Finds the files of a batch. `output` is the folder that the outputs go to.
pub(crate) fn gather(named: &[PathBuf], extensions: &BTreeSet<String>, output: Option<&Path>) -> Gathered {
    let mut found = Gathered::default();
    let output = output.and_then(identity);
    for path in named {
        if !path.is_dir() {
            found.take(path.clone(), PathBuf::new());
            continue;
        }
        // The outputs may go beside the sources, if that is stated.
        let output = output.as_ref().filter(|output| identity(path).as_ref() != Some(output));
        found.walk(path, extensions, output);
    }
    found
}

impl Gathered {
    fn take(&mut self, path: PathBuf, below: PathBuf) {
        // A missing file is reported when it is read.
        let twice = identity(&path).is_some_and(|own| !self.seen.insert(own));
        if twice {
            self.skip(path, Reason::Twice);
        } else {
            self.items.push(Item { path, below });
        }
    }

    /// Leaves out a file that was taken.
    pub(super) fn leave(&mut self, path: PathBuf, reason: Reason) {
        self.skip(path, reason);
    }

    fn skip(&mut self, path: PathBuf, reason: Reason) {
        self.skipped.push(Skipped { path, reason });
    }

    fn walk(&mut self, root: &Path, extensions: &BTreeSet<String>, output: Option<&Identity>) {
        // Depth does not depend on the stack.
        let mut open = vec![PathBuf::new()];
        while let Some(below) = open.pop() {
            let folder = if below.as_os_str().is_empty() { root.to_owned() } else { root.join(&below) };
            let names = match listed(&folder) {
                Ok(names) => names,
                Err(error) => {
                    let problem = Problem::file("read", &folder.display().to_string(), &error);
                    self.unread.push((folder, problem));
                    continue;
                }
            };
            let mut folders = Vec::new();
            for name in names {
                let path = folder.join(&name);
                let inside = below.join(&name);
                let link = fs::symlink_metadata(&path).is_ok_and(|m| m.is_symlink());
                let is_taken = || {
                    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
                    extension.is_some_and(|e| extensions.contains(&e))
                };
                if name.to_string_lossy().starts_with('.') {
                    self.skip(path, Reason::Hidden);
                } else if path.is_dir() && link {
                    self.skip(path, Reason::LinkedFolder);
                } else if path.is_dir() {
                    match output.is_some() && identity(&path).as_ref() == output {
                        true => self.skip(path, Reason::OutputFolder),
                        false => folders.push(inside),
                    }
                } else if !is_taken() {
                    self.skip(path, Reason::Extension);
                } else if path.is_file() || link {
                    self.take(path, below.clone());
                } else {
                    self.skip(path, Reason::NoFile);
                }
            }
            open.extend(folders.into_iter().rev());
        }
    }
}

/// Names in a folder, in an order that does not depend on the file system.
fn listed(folder: &Path) -> io::Result<Vec<std::ffi::OsString>> {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder)? {
        names.push(entry?.file_name());
    }
    names.sort();
    Ok(names)
}
