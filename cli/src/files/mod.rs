//! Reading the source and writing what comes out, so that no input is ever written over and no
//! half-written file is ever seen.
//!
//! ```text
//! -o part.mpf    a scratch file beside it, which takes its name when all of it is verified
//! ```
//!
//! Not here: what is written.

pub mod arrow;
pub mod scratch;

use std::fs::{self, File};
use std::io::{self, IsTerminal, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use ncc_driver::job::Output;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::render::terminal::Shown;
use ncc_driver::source::include_path::Library;
use ncc_driver::source::{Origin, Source, halted};
use same_file::Handle;

use crate::interrupt;

/// Largest source, in bytes: places in it are 32-bit numbers.
const LARGEST: u64 = u32::MAX as u64;

/// Called programs in folders of this machine.
#[derive(Clone, Copy, Debug)]
pub struct Disk;

impl Library for Disk {
    fn list(&self, folder: &Path) -> Vec<PathBuf> {
        let entries = fs::read_dir(folder).into_iter().flatten();
        entries.filter_map(|entry| Some(entry.ok()?.path())).collect()
    }

    fn bytes(&self, path: &Path) -> Option<u64> {
        fs::metadata(path).ok().filter(fs::Metadata::is_file).map(|about| about.len())
    }

    fn read(&self, path: &Path, most: u64) -> io::Result<Vec<u8>> {
        let mut text = Vec::new();
        File::open(path)?.take(most).read_to_end(&mut text)?;
        Ok(text)
    }
}

/// Which file a source is.
#[derive(Debug)]
struct OwnFile {
    identity: Option<Handle>,
    /// Whether it is a plain file that was named, not a pipe.
    plain: bool,
}

impl Origin for OwnFile {
    fn is_at(&self, path: &Path) -> bool {
        match (&self.identity, Handle::from_path(path)) {
            (Some(own), Ok(other)) => *own == other,
            (None, _) | (_, Err(_)) => false,
        }
    }

    fn is_stdout(&self) -> bool {
        self.plain && self.identity.is_some() && self.identity == Handle::stdout().ok()
    }
}

/// Opens a source; `-` is stdin, which is kept in a temporary file.
///
/// # Errors
/// It cannot be read, or is too large.
pub fn open(path: &Path) -> Result<Source, Problem> {
    let stdin = path == Path::new("-");
    let shown = if stdin { "<stdin>".to_owned() } else { path.display().to_string() };
    let wrong = |error: &io::Error| Problem::file("read", &shown, error);
    let identity = if stdin { Handle::stdin() } else { Handle::from_path(path) };
    let mut plain = false;
    let mut file = if stdin {
        spool(&mut io::stdin().lock()).map_err(|e| wrong(&e))?
    } else {
        let mut file = File::open(path).map_err(|e| wrong(&e))?;
        let metadata = file.metadata().map_err(|e| wrong(&e))?;
        if metadata.is_dir() {
            return Err(wrong(&io::ErrorKind::IsADirectory.into()));
        }
        plain = metadata.is_file();
        if plain { file } else { spool(&mut file).map_err(|e| wrong(&e))? }
    };
    if file.metadata().map_err(|e| wrong(&e))?.len() > LARGEST {
        let message = format!("cannot read {shown}: it is larger than 4 GiB");
        return Err(Problem { exit: Exit::File, message, help: vec!["split the program".to_owned()] });
    }
    refuse_stored(&mut file, &shown)?;
    let name = match path.file_name() {
        Some(name) if !stdin => name.to_string_lossy().into_owned(),
        Some(_) | None => "-".to_owned(),
    };
    let origin = OwnFile { identity: identity.ok(), plain };
    Ok(Source { shown, origin: Some(Box::new(origin)), ..Source::of(file, &name) })
}

/// The name and the text of a file that is no program.
///
/// # Errors
/// It cannot be read, or is no UTF-8.
pub(crate) fn text(path: &Path) -> Result<(String, String), Problem> {
    let name = path.display().to_string();
    let text = fs::read_to_string(path).map_err(|error| Problem::file("read", &name, &error))?;
    Ok((name, text))
}

/// How the refusal of such a text begins, after its name.
pub(crate) const AS_STORED: &str = "is not a part program as it is stored";

/// Bytes at the beginning of a source by which its form is known.
const BEGINNING: u64 = 1 << 16;

/// A text that no control reads as it is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stored {
    /// Two bytes a character, as iconv names the order.
    Wide(&'static str),
    /// Lines that end with CR and no LF.
    CrAlone,
}

/// How the beginning of a text is stored, if no control reads it.
fn stored(beginning: &[u8]) -> Option<Stored> {
    match beginning {
        [0xff, 0xfe, ..] => return Some(Stored::Wide("UTF-16LE")),
        [0xfe, 0xff, ..] => return Some(Stored::Wide("UTF-16BE")),
        _ => {}
    }
    // Without a mark: each character of a program has one byte zero. Tape feed has both.
    let pairs = beginning.chunks_exact(2).take(1 << 10);
    let count = |zero: usize| pairs.clone().filter(|pair| pair[zero] == 0 && pair[1 - zero] != 0).count();
    let all = pairs.len();
    if all >= 4 {
        for (zero, name) in [(1, "UTF-16LE"), (0, "UTF-16BE")] {
            if count(zero) * 10 > all * 9 {
                return Some(Stored::Wide(name));
            }
        }
    }
    let lines = beginning.trim_ascii_end();
    // A file with bytes that stand in no text, not on paper tape either, is none.
    let text = !beginning.iter().any(|byte| matches!(byte, 1..=8 | 14..=16 | 21..=25 | 27..=31));
    (text && lines.contains(&b'\r') && !beginning.contains(&b'\n')).then_some(Stored::CrAlone)
}

/// Refuses a text that no control reads as it is stored, by what it is.
///
/// # Errors
/// It is such a text, or it cannot be read.
fn refuse_stored(file: &mut File, shown: &str) -> Result<(), Problem> {
    let mut beginning = Vec::new();
    let read = file.take(BEGINNING).read_to_end(&mut beginning).and_then(|_| file.seek(SeekFrom::Start(0)));
    read.map_err(|e| Problem::file("read", shown, &e))?;
    let (message, command) = match stored(&beginning) {
        None => return Ok(()),
        Some(Stored::Wide(order)) => (
            format!("{shown} {AS_STORED}: UTF-16, two bytes a character"),
            format!("iconv -f {order} -t UTF-8"),
        ),
        Some(Stored::CrAlone) => {
            (format!("{shown} {AS_STORED}: its lines end with CR alone"), "tr '\\r' '\\n'".to_owned())
        }
    };
    let help =
        format!("save it as plain text, in UTF-8 with line ends LF or CR LF: `{command} < {shown} > NEW`");
    Err(Problem { exit: Exit::Refused, message, help: vec![help] })
}

/// Keeps what can be read only once in a temporary file.
fn spool(from: &mut dyn Read) -> io::Result<File> {
    let mut file = scratch::file()?;
    io::copy(&mut from.take(LARGEST + 1), &mut file).map_err(scratch::full)?;
    file.seek(SeekFrom::Start(0))?;
    Ok(file)
}

/// Writes what is for people to stdout, without control characters of the texts that it is about. Somebody who stops
/// reading, as `head` does, is no one to complain to.
///
/// # Errors
/// stdout cannot be written.
pub fn to_stdout(write: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>) -> Result<(), Problem> {
    write_stdout(true, write)
}

/// Writes programs and data to stdout: every byte as it is, unless stdout is a terminal.
///
/// # Errors
/// stdout cannot be written.
pub fn data_to_stdout(write: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>) -> Result<(), Problem> {
    write_stdout(io::stdout().is_terminal(), write)
}

fn write_stdout(
    filtered: bool,
    write: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Problem> {
    halted::heed(None).map_err(|error| Problem::file("write", "stdout", &error))?;
    let mut stdout = io::stdout().lock();
    let written = match filtered {
        false => write(&mut stdout),
        true => {
            let mut shown = Shown::new(&mut stdout);
            write(&mut shown).and_then(|()| shown.finish().map(|_| ()))
        }
    };
    match written.and_then(|()| stdout.flush()) {
        Ok(()) => Ok(()),
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => {
            Err(Problem { exit: Exit::File, message: String::new(), help: Vec::new() })
        }
        Err(error) => Err(Problem::file("write", "stdout", &error)),
    }
}

/// Writes a file whole or not at all. What is no plain file, such as `/dev/null`, is written as
/// it is.
///
/// # Errors
/// The file cannot be written.
pub fn to_file(path: &Path, write: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>) -> Result<(), Problem> {
    replace(path, write).map_err(|error| Problem::file("write", &path.display().to_string(), &error))
}

fn replace(path: &Path, write: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    // Through a link, the file that it leads to is replaced, not the link.
    let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let before = fs::metadata(&path).ok();
    match &before {
        Some(metadata) if metadata.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
        Some(metadata) if !metadata.is_file() => {
            let mut file = File::options().write(true).open(&path)?;
            return write(&mut file);
        }
        Some(metadata) if metadata.permissions().readonly() => {
            return Err(io::ErrorKind::PermissionDenied.into());
        }
        Some(_) | None => {}
    }
    let _placing = interrupt::placing()?;
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
        Some(_) | None => PathBuf::from("."),
    };
    if let Some(mut file) = unnamed(&folder) {
        if let Some(metadata) = before {
            file.set_permissions(metadata.permissions())?;
        }
        write(&mut file)?;
        file.sync_all()?;
        return named(&file, &folder, &path);
    }
    let mut builder = tempfile::Builder::new();
    builder.prefix(".ncc-");
    #[cfg(unix)]
    if before.is_none() {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(folder)?;
    if let Some(metadata) = before {
        file.as_file().set_permissions(metadata.permissions())?;
    }
    write(file.as_file_mut())?;
    file.as_file().sync_all()?;
    file.persist(path)?;
    Ok(())
}

/// A file without a name in a folder: if ncc is killed, nothing is left of it. `None` where there are no such files.
#[cfg(target_os = "linux")]
fn unnamed(folder: &Path) -> Option<File> {
    use rustix::fs::{Mode, OFlags, open};
    // Through it such a file gets its name.
    if !Path::new("/proc/self/fd").exists() {
        return None;
    }
    let flags = OFlags::TMPFILE | OFlags::RDWR | OFlags::CLOEXEC;
    open(folder, flags, Mode::from_raw_mode(0o666)).ok().map(File::from)
}

#[cfg(not(target_os = "linux"))]
fn unnamed(_: &Path) -> Option<File> {
    None
}

/// Gives such a file its name, in the place of another of that name.
#[cfg(target_os = "linux")]
fn named(file: &File, folder: &Path, path: &Path) -> io::Result<()> {
    use rustix::fs::{AtFlags, CWD, linkat};
    use std::os::fd::AsRawFd;
    let own = format!("/proc/self/fd/{}", file.as_raw_fd());
    let link = |to: &Path| linkat(CWD, own.as_str(), CWD, to, AtFlags::SYMLINK_FOLLOW);
    // A link is never made over a name: it gets one that is free, and takes the other's place under that.
    for number in 0..1000 {
        let free = folder.join(format!(".ncc-{}-{number}", std::process::id()));
        match link(&free) {
            Ok(()) => {
                return fs::rename(&free, path).inspect_err(|_| drop(fs::remove_file(&free)));
            }
            Err(rustix::io::Errno::EXIST) => {}
            Err(error) => return Err(error.into()),
        }
    }
    Err(io::ErrorKind::AlreadyExists.into())
}

#[cfg(not(target_os = "linux"))]
fn named(_: &File, _: &Path, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

/// Makes a folder of outputs that a project file names.
///
/// # Errors
/// There is a file of its name, or it cannot be made.
pub(crate) fn make_folder(folder: &Path) -> Result<(), Problem> {
    let shown = folder.display().to_string();
    if folder.exists() && !folder.is_dir() {
        let message = format!("{shown} is a file, and `ncc.toml` has it as the folder of outputs");
        return Err(Problem::usage(message, "name another folder there, or -o FILE here"));
    }
    fs::create_dir_all(folder).map_err(|error| Problem::file("make the folder", &shown, &error))
}

/// Where an output goes.
#[derive(Debug)]
pub enum Destination {
    /// stdout.
    Stdout,
    /// A file.
    File(PathBuf),
}

impl Destination {
    /// Finds out before anything is done whether there is a folder for it.
    ///
    /// # Errors
    /// There is none.
    pub fn check(&self) -> Result<(), Problem> {
        let Destination::File(path) = self else { return Ok(()) };
        match path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() && !folder.is_dir() => {
                let error = io::ErrorKind::NotFound.into();
                Err(Problem::file("write", &path.display().to_string(), &error))
            }
            Some(_) | None => Ok(()),
        }
    }

    /// The name of the output's file without its folder; `-` is standard output.
    pub fn file_name(&self) -> String {
        let name = match self {
            Destination::File(path) => path.file_name().map(|name| name.to_string_lossy().into_owned()),
            Destination::Stdout => None,
        };
        name.unwrap_or_else(|| "-".to_owned())
    }

    /// Writes the output there.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn release(&self, output: &mut Output) -> Result<(), Problem> {
        match self {
            Destination::Stdout => data_to_stdout(&mut |out| output.write_to(out)),
            Destination::File(path) => to_file(path, &mut |out| output.write_to(out)),
        }
    }

    /// Writes an output there that is for people and has passed [`Shown`] already, so that its colours are ncc's own.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn release_shown(&self, output: &mut Output) -> Result<(), Problem> {
        match self {
            Destination::Stdout => write_stdout(false, &mut |out| output.write_to(out)),
            Destination::File(_) => self.release(output),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(target_os = "linux")]
    #[test]
    fn nothing_has_a_name_until_it_is_whole() {
        let folder = tempfile::tempdir().unwrap();
        let names =
            || fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().file_name()).collect::<Vec<_>>();
        let path = folder.path().join("out.nc");
        for text in ["first", "second"] {
            let before = names();
            to_file(&path, &mut |out| {
                out.write_all(text.as_bytes())?;
                assert_eq!(names(), before);
                Ok(())
            })
            .unwrap();
            assert_eq!((fs::read_to_string(&path).unwrap().as_str(), names().len()), (text, 1));
        }
        let failed = to_file(&path, &mut |_| Err(io::ErrorKind::StorageFull.into()));
        assert!(failed.is_err());
        assert_eq!((fs::read_to_string(&path).unwrap().as_str(), names().len()), ("second", 1));
    }

    #[test]
    fn texts_that_no_control_reads_are_known() {
        let wide = |text: &str, big: bool| -> Vec<u8> {
            let two = |c: u16| if big { c.to_be_bytes() } else { c.to_le_bytes() };
            text.encode_utf16().flat_map(two).collect()
        };
        let program = "%\nO1\nG0 X1\nM30\n%\n";
        assert_eq!(stored(&wide(program, false)), Some(Stored::Wide("UTF-16LE")));
        assert_eq!(stored(&wide(program, true)), Some(Stored::Wide("UTF-16BE")));
        let marked = [&[0xff, 0xfe][..], &wide("M2", false)].concat();
        assert_eq!(stored(&marked), Some(Stored::Wide("UTF-16LE")));
        assert_eq!(stored(program.replace('\n', "\r").as_bytes()), Some(Stored::CrAlone));
        assert_eq!(stored(b"G0 X1\rM2"), Some(Stored::CrAlone));
        assert_eq!(stored(b"\x7fELF\x02\x01\r\0"), None, "no text at all");
        for text in
            [&b""[..], b"M2", b"M2\r", b"G0\r\nM2\r\n", b"\0\0\0\0\0\0\0\0%\nM30\n", program.as_bytes()]
        {
            assert_eq!(stored(text), None, "{text:?}");
        }
    }
}
