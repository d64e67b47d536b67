//! A program's text with what is known of it before it is read: its names, called programs, the project file.
//!
//! ```text
//! Source { name: "part.nc", bytes }    chunks    pieces of whole lines
//! `M98 P2000`                          called    the text of O2000, asked of the host
//! ```
//!
//! Not here: what a text means (front-ends).

pub mod called_files;
pub mod chunks;
pub mod halted;
pub mod include_path;
pub mod interrupted;
pub mod not_milling;
pub(crate) mod reader;
#[cfg(test)]
pub(crate) mod spliced;
pub mod spool;

use std::fmt;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use ncc_ir::diag::Diagnostic;

use crate::job::project_answers::Used;
use crate::problem::{Exit, Problem, problem};
use crate::source::called_files::Called;

/// Bytes that can be read again, from wherever the host keeps them.
pub trait Readable: Read + Seek {}

impl<T: Read + Seek> Readable for T {}

/// Where a source comes from, as far as it must not be written over.
pub trait Origin: fmt::Debug + Send {
    /// Whether a path leads to it.
    fn is_at(&self, path: &Path) -> bool;

    /// Whether stdout writes into it.
    fn is_stdout(&self) -> bool;
}

/// A source that can be read more than once.
pub struct Source {
    /// Its bytes.
    pub file: Box<dyn Readable + Send>,
    /// Its name in messages: the path, or `<stdin>`.
    pub shown: String,
    /// Its name in the output and the report: the file's name without folders, or `-`.
    pub name: String,
    /// What programs it calls from files of their own; they stand behind its own text in `file`.
    pub called: Option<Called>,
    /// Assumptions about the file that the user stated, such as `--assume milling`.
    pub assumed: Vec<Diagnostic>,
    /// The project file's answers for this program.
    pub project: Option<Arc<Used>>,
    /// Folders of called programs that the project file names.
    pub include: Vec<PathBuf>,
    /// Where it comes from, of a source that has such a place.
    pub origin: Option<Box<dyn Origin>>,
}

impl fmt::Debug for Source {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_struct("Source")
            .field("shown", &self.shown)
            .field("called", &self.called)
            .finish_non_exhaustive()
    }
}

impl Source {
    /// A source with one name, which nothing else is known of.
    pub fn of(file: impl Readable + Send + 'static, name: &str) -> Source {
        let (shown, name) = (name.to_owned(), name.to_owned());
        let (project, include) = (None, Vec::new());
        Source {
            file: Box::new(file),
            shown,
            name,
            called: None,
            assumed: Vec::new(),
            project,
            include,
            origin: None,
        }
    }

    /// Length of its bytes; it stands at its beginning then.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn bytes(&mut self) -> io::Result<u64> {
        let bytes = self.file.seek(SeekFrom::End(0))?;
        self.file.seek(SeekFrom::Start(0))?;
        Ok(bytes)
    }

    /// Refuses to write over the source.
    ///
    /// # Errors
    /// The path is the source, or, without a path, stdout is.
    pub fn guard(&self, into: Option<&Path>) -> Result<(), Problem> {
        let same = match into {
            Some(path) => self.origin.as_ref().is_some_and(|origin| origin.is_at(path)),
            None => self.origin.as_ref().is_some_and(|origin| origin.is_stdout()),
        };
        match (same, into) {
            (false, _) => Ok(()),
            (true, Some(path)) => {
                let message = problem("is-source").text("name", path.display().to_string());
                Err(Problem::of(Exit::Usage, &message, None))
            }
            (true, None) => {
                let message = problem("stdout-is-source").text("name", &self.shown);
                Err(Problem::of(Exit::Usage, &message, None))
            }
        }
    }

    /// Whether its first line ends with CR LF.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn is_crlf(&mut self) -> Result<bool, Problem> {
        let look = |file: &mut dyn Readable| -> io::Result<bool> {
            file.seek(SeekFrom::Start(0))?;
            let mut piece = vec![0; 1 << 16];
            let mut before = 0;
            loop {
                let n = file.read(&mut piece)?;
                match memchr::memchr(b'\n', &piece[..n]) {
                    _ if n == 0 => return Ok(false),
                    Some(0) => return Ok(before == b'\r'),
                    Some(at) => return Ok(piece[at - 1] == b'\r'),
                    None => before = piece[n - 1],
                }
            }
        };
        look(&mut *self.file).map_err(|e| Problem::file("read", &self.shown, &e))
    }

    /// Whether there is nothing in it but white space.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn is_blank(&mut self) -> Result<bool, Problem> {
        self.rewind()?;
        let mut piece = vec![0; 1 << 16];
        loop {
            match self.file.read(&mut piece).map_err(|e| Problem::file("read", &self.shown, &e))? {
                0 => return Ok(true),
                n if piece[..n].trim_ascii().is_empty() => {}
                _ => return Ok(false),
            }
        }
    }

    /// Whether there are bytes at its beginning that no text contains.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn is_no_text(&mut self) -> Result<bool, Problem> {
        self.rewind()?;
        let mut beginning = Vec::new();
        let read = (&mut self.file).take(1 << 16).read_to_end(&mut beginning);
        read.map_err(|e| Problem::file("read", &self.shown, &e))?;
        // Feed at both ends of a tape is none of it.
        let feed = |b: &u8| *b == 0 || b.is_ascii_whitespace();
        let from = beginning.iter().take_while(|b| feed(b)).count();
        let behind = beginning.iter().rev().take_while(|b| feed(b)).count();
        let text = beginning.get(from..beginning.len().saturating_sub(behind)).unwrap_or_default();
        Ok(if text.is_empty() { beginning.contains(&0) } else { text.contains(&0) })
    }

    /// Goes back to the start.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn rewind(&mut self) -> Result<(), Problem> {
        self.file.seek(SeekFrom::Start(0)).map_err(|e| Problem::file("read", &self.shown, &e))?;
        Ok(())
    }
}
