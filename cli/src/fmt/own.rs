//! Dialects whose texts are lists of statements: the layout is that of their own writer, through a
//! translation into themselves, which is verified as any is.
//!
//! Notes, which are no part of a program, are put back where they stood. Where that place cannot be told
//! for certain the text is refused. Not here: what a translation does.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};

use crate::job::{Failure, Job};
use crate::translate;

/// What became of a text.
#[derive(Debug)]
pub(super) enum Written {
    /// Laid out, executed before and after.
    Done(Vec<u8>),
    /// It has errors, or is of another form than its writer's.
    Refused,
    /// It was not shown to do the same.
    NotSame,
    /// Its notes would be lost.
    Notes,
}

/// What begins a note.
const NOTE: &[u8] = b"#";

/// Lays a text out.
///
/// # Errors
/// Reading or writing.
pub(super) fn text(job: &Job, from: &mut File) -> io::Result<Written> {
    from.seek(SeekFrom::Start(0))?;
    let mut outcome = translate::translate(job, from)?;
    match outcome.release {
        Ok(()) => {}
        Err(Failure::Refused) => return Ok(Written::Refused),
        Err(Failure::VerificationFailed) => return Ok(Written::NotSame),
    }
    let written = outcome.output.to_vec()?;
    from.seek(SeekFrom::Start(0))?;
    let mut source = Vec::new();
    from.read_to_end(&mut source)?;
    Ok(with_notes(&source, written).map_or(Written::Notes, Written::Done))
}

/// Puts the notes of a source back: the other lines of both texts are the same in number and order, but
/// for lines that go on with the block before.
fn with_notes(source: &[u8], written: Vec<u8>) -> Option<Vec<u8>> {
    let is_note = |line: &&[u8]| line.trim_ascii_start().starts_with(NOTE);
    let goes_on = |line: &&[u8]| line.trim_ascii_start().starts_with(b"&");
    let lines: Vec<&[u8]> = source.split_inclusive(|b| *b == b'\n').collect();
    if !lines.iter().any(|line| is_note(line)) {
        return Some(written);
    }
    let mut woven = Vec::with_capacity(source.len());
    let mut others = written.split_inclusive(|b| *b == b'\n');
    let eol: &[u8] = if written.ends_with(b"\r\n") { b"\r\n" } else { b"\n" };
    for line in lines {
        if is_note(&line) {
            woven.extend_from_slice(line.trim_ascii_end());
            woven.extend_from_slice(eol);
        } else if !goes_on(&line) {
            woven.extend_from_slice(others.next()?);
        }
    }
    others.next().is_none().then_some(woven)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notes_stay_between_their_lines() {
        let woven = |source: &str, written: &str| {
            with_notes(source.as_bytes(), written.into()).map(|text| String::from_utf8(text).unwrap())
        };
        assert_eq!(woven("a\n# n \nb\n&c\nd\n", "A\nB&C\nD\n").as_deref(), Some("A\n# n\nB&C\nD\n"));
        assert_eq!(woven("a\nb\n", "X\nY\nZ\n").as_deref(), Some("X\nY\nZ\n"));
        assert_eq!(woven("a\n# n\nb\n", "X\n"), None);
        assert_eq!(woven("a\n# n\nb\n", "X\nY\nZ\n"), None);
    }
}
