//! The arrow that a POSIX shell takes apart: `ncc mach9 -> fanuc part.cn`.
//!
//! The shell has opened a file named `fanuc` for our stdout before we run, and emptied it. If
//! stdout is that file beyond doubt, the name of the file is the name of the target, and the
//! program is written into it. In any doubt nothing is written and the hint says what to type.

use std::fs::File;
use std::io;

use ncc_dialects::Dialect;

use crate::registry::DialectRegistry;

/// Why an arrow cannot be honoured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Doubt {
    /// stdout is no file, or cannot be compared here.
    NoFile,
    /// stdout is a file that bears no dialect's name.
    OtherFile,
    /// The file is open for appending (`>>`), or not at its start.
    Append,
    /// The file has something in it.
    NotEmpty,
}

impl Doubt {
    /// What to say.
    pub fn words(self) -> &'static str {
        match self {
            Doubt::NoFile => "stdout is not a file that can be recognised",
            Doubt::OtherFile => "stdout is not a file with a dialect's name in this folder",
            Doubt::Append => "the file is opened for appending",
            Doubt::NotEmpty => "the file was not empty",
        }
    }
}

/// The dialect whose name the file at stdout bears.
///
/// # Errors
/// The doubt, if it is not certain that a shell has just made or emptied that file for us.
pub fn target(known: &DialectRegistry) -> Result<&'static Dialect, Doubt> {
    let stdout = own_stdout().map_err(|_| Doubt::NoFile)?;
    let metadata = stdout.metadata().map_err(|_| Doubt::NoFile)?;
    if !metadata.is_file() {
        return Err(Doubt::NoFile);
    }
    let identity = same_file::Handle::stdout().map_err(|_| Doubt::NoFile)?;
    let bears_name = |name: &&'static str| {
        same_file::Handle::from_path(std::path::Path::new(".").join(name)).is_ok_and(|file| file == identity)
    };
    let dialect = known.names().find(bears_name).and_then(|name| known.get(name)).ok_or(Doubt::OtherFile)?;
    if appends(&stdout).map_err(|_| Doubt::NoFile)? {
        return Err(Doubt::Append);
    }
    if metadata.len() != 0 {
        return Err(Doubt::NotEmpty);
    }
    Ok(dialect)
}

#[cfg(unix)]
fn own_stdout() -> io::Result<File> {
    use std::os::fd::AsFd;
    Ok(File::from(io::stdout().as_fd().try_clone_to_owned()?))
}

/// Elsewhere nothing tells a file opened for appending from another, so there is always doubt.
#[cfg(not(unix))]
fn own_stdout() -> io::Result<File> {
    Err(io::ErrorKind::Unsupported.into())
}

#[cfg(unix)]
fn appends(mut file: &File) -> io::Result<bool> {
    use std::io::Seek;
    let flags = rustix::fs::fcntl_getfl(file)?;
    Ok(flags.contains(rustix::fs::OFlags::APPEND) || file.stream_position()? != 0)
}

#[cfg(not(unix))]
fn appends(_file: &File) -> io::Result<bool> {
    Err(io::ErrorKind::Unsupported.into())
}
