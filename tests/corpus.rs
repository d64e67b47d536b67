//! The programs of `corpus/`, one folder a dialect.

use std::fs;
use std::path::{Path, PathBuf};

/// Dialects with a folder in the corpus.
pub const DIALECTS: [&str; 9] =
    ["mach9", "fanuc", "haas", "siemens", "linuxcnc", "grbl", "mach3", "canon", "ir"];

/// A program of the corpus.
#[derive(Clone, Debug)]
pub struct Program {
    /// Its dialect.
    pub dialect: &'static str,
    /// Its file's name, without the extension.
    pub name: String,
    /// Its file's name.
    pub file: String,
    /// Its text.
    pub text: Vec<u8>,
}

/// The top of the repository.
pub fn root() -> PathBuf {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR"));
    tests.parent().map_or_else(|| tests.to_owned(), Path::to_owned)
}

/// Material that is given beside the repository, if it is there.
pub fn shared() -> Option<PathBuf> {
    let shared = root().join("../shared");
    shared.is_dir().then_some(shared)
}

/// Files of a folder, by name.
///
/// # Panics
/// The folder cannot be read.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut files: Vec<PathBuf> = entries.filter_map(|e| Some(e.ok()?.path())).collect();
    files.sort();
    files
}

/// The programs of a dialect, by name.
///
/// # Panics
/// The corpus cannot be read.
pub fn of(dialect: &'static str) -> Vec<Program> {
    under("corpus", dialect)
}

/// The programs of a dialect that compute: no target takes them as they are.
///
/// # Panics
/// They cannot be read.
pub fn computing(dialect: &'static str) -> Vec<Program> {
    // How a target writes a program stands beside it.
    let written = |program: &Program| DIALECTS.iter().any(|d| program.file.ends_with(&format!(".{d}")));
    under("tests/computing", dialect).into_iter().filter(|program| !written(program)).collect()
}

fn under(folder: &str, dialect: &'static str) -> Vec<Program> {
    let expected = |path: &PathBuf| path.extension().is_some_and(|e| e == "flat" || e == "stderr");
    let folder = root().join(folder).join(dialect);
    let found = if folder.is_dir() { files(&folder) } else { Vec::new() };
    found
        .into_iter()
        .filter(|path| path.is_file() && !expected(path))
        .map(|path| Program {
            dialect,
            name: part(path.file_stem()),
            file: part(path.file_name()),
            text: fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display())),
        })
        .collect()
}

/// All programs.
pub fn all() -> Vec<Program> {
    DIALECTS.into_iter().flat_map(of).collect()
}

fn part(name: Option<&std::ffi::OsStr>) -> String {
    name.map(|n| n.to_string_lossy().into_owned()).unwrap_or_default()
}
