//! Temporary files, and what to tell where none can be made or filled.
//!
//! ncc keeps what it reads from a pipe and what is not released yet in files without a name. They lie in the folder
//! that TMPDIR names (on Windows TMP).

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};

use ncc_driver::source::spool::{self, Lacking, Store};

/// Has long texts of the compiler kept in temporary files.
pub fn use_files() {
    spool::overflow_to(|| Ok(Box::new(Kept(file()?)) as Box<dyn Store>));
}

/// A temporary file without a name.
///
/// # Errors
/// It cannot be made; the error names the folder.
pub fn file() -> io::Result<File> {
    tempfile::tempfile().map_err(wrong)
}

/// The error of a temporary file with the name of its folder.
pub fn wrong(error: io::Error) -> io::Error {
    let reason = match error.kind() {
        io::ErrorKind::NotFound => "there is no such folder".to_owned(),
        io::ErrorKind::NotADirectory => "it is not a folder".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => "it is full".to_owned(),
        io::ErrorKind::ReadOnlyFilesystem => "nothing can be written there".to_owned(),
        // One that is named already.
        _ if error.get_ref().is_some_and(|inner| inner.is::<Lacking>()) => return error,
        _ => error.to_string(),
    };
    io::Error::other(Lacking { folder: std::env::temp_dir(), reason })
}

/// What is written to a temporary file by others, such as a copy of stdin: the error names the folder if it is full.
pub fn full(error: io::Error) -> io::Error {
    match error.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => wrong(error),
        _ => error,
    }
}

/// A temporary file whose errors name its folder.
#[derive(Debug)]
struct Kept(File);

impl Write for Kept {
    fn write(&mut self, text: &[u8]) -> io::Result<usize> {
        self.0.write(text).map_err(wrong)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush().map_err(wrong)
    }
}

impl Read for Kept {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        self.0.read(into)
    }
}

impl Seek for Kept {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.0.seek(to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ncc_driver::problem::Problem;

    #[test]
    fn a_full_folder_is_named_with_what_to_do() {
        let full = wrong(wrong(io::Error::from(io::ErrorKind::StorageFull)));
        let problem = Problem::file("translate", "part.nc", &full);
        let folder = std::env::temp_dir().display().to_string();
        let message = format!(
            "cannot translate part.nc: cannot use the folder of temporary files, {folder}: it is full"
        );
        assert_eq!(problem.message, message);
        assert_eq!(problem.help.len(), 1);
        assert!(problem.help[0].contains("free space"));
    }
}
