//! What would change, as a unified difference. Lines are laid out one by one, so that the n-th line of one
//! text is the n-th of the other, and nothing has to be searched for.

use std::io::{self, BufRead, BufReader, SeekFrom, Write};

use crate::source::Readable;

/// The line by which `patch` knows that the line before it has no end.
const NO_NEWLINE: &[u8] = include_bytes!("no_newline.txt");

/// Lines shown before and after a change.
const AROUND: usize = 2;

/// Writes the difference of two texts of as many lines.
///
/// # Errors
/// Reading or writing.
pub fn difference(
    name: &str,
    before: &mut dyn Readable,
    after: &mut dyn Readable,
    to: &mut dyn Write,
) -> io::Result<()> {
    before.seek(SeekFrom::Start(0))?;
    after.seek(SeekFrom::Start(0))?;
    let (mut before, mut after) = (BufReader::new(before), BufReader::new(after));
    writeln!(to, "--- {name}\n+++ {name} (laid out)")?;
    let mut hunk: Vec<(Vec<u8>, Vec<u8>)> = Vec::new();
    let (mut first, mut equal, mut any) = (1, 0, false);
    loop {
        let (mut a, mut b) = (Vec::new(), Vec::new());
        let read = before.read_until(b'\n', &mut a)? + after.read_until(b'\n', &mut b)?;
        if read > 0 {
            equal = if a == b { equal + 1 } else { 0 };
            any |= a != b;
            hunk.push((a, b));
        }
        match any {
            false if hunk.len() > AROUND => {
                hunk.remove(0);
                first += 1;
            }
            true if equal > 2 * AROUND || read == 0 => {
                let keep = equal.min(AROUND);
                let rest = hunk.split_off(hunk.len() - (equal - keep));
                write_hunk(&hunk, first, to)?;
                first += hunk.len() + rest.len().saturating_sub(AROUND);
                hunk = rest.into_iter().rev().take(AROUND).rev().collect();
                (equal, any) = (hunk.len(), false);
            }
            true | false => {}
        }
        if read == 0 {
            return Ok(());
        }
    }
}

fn write_hunk(hunk: &[(Vec<u8>, Vec<u8>)], first: usize, to: &mut dyn Write) -> io::Result<()> {
    writeln!(to, "@@ -{first},{n} +{first},{n} @@", n = hunk.len())?;
    let mut at = 0;
    while at < hunk.len() {
        let run = hunk[at..].iter().take_while(|(a, b)| a != b).count();
        for (a, _) in &hunk[at..at + run] {
            line(b"-", a, to)?;
        }
        for (_, b) in &hunk[at..at + run] {
            line(b"+", b, to)?;
        }
        if let Some((a, _)) = hunk.get(at + run) {
            line(b" ", a, to)?;
        }
        at += run + 1;
    }
    Ok(())
}

/// A line with its mark. The end of a line that Windows wrote can be seen only if it is named.
fn line(mark: &[u8], text: &[u8], to: &mut dyn Write) -> io::Result<()> {
    to.write_all(mark)?;
    to.write_all(text)?;
    if !text.ends_with(b"\n") {
        to.write_all(b"\n")?;
        to.write_all(NO_NEWLINE)?;
    }
    Ok(())
}
