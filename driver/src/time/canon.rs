//! The canonical functions with their times.
//!
//! The program is translated to canon and verified, as `ncc X to canon` does; then that text is
//! timed, and a comment after each function that takes time says how long it takes and when it is
//! over. So what is printed is a canonical program like any other, with its assumptions at the top.

use std::io::{self, BufRead, Write};

use ncc_time::Timed;

use super::drive::{Said, Sink};

/// Writes a canonical text with times.
pub struct Canon<R: BufRead, W: Write> {
    text: R,
    /// Lines that are written.
    line: u32,
    buffer: Vec<u8>,
    out: W,
}

impl<R: BufRead, W: Write> Canon<R, W> {
    /// One that adds times to a canonical text.
    pub fn new(text: R, out: W) -> Canon<R, W> {
        Canon { text, line: 0, buffer: Vec::new(), out }
    }

    /// Copies lines up to and including this one.
    fn copy(&mut self, line: u32) -> io::Result<()> {
        while self.line < line {
            self.buffer.clear();
            if self.text.read_until(b'\n', &mut self.buffer)? == 0 {
                return Ok(());
            }
            self.line += 1;
            self.out.write_all(&self.buffer)?;
            if self.buffer.last() != Some(&b'\n') {
                self.out.write_all(b"\n")?;
            }
        }
        Ok(())
    }

    /// Copies the rest.
    pub fn finish(&mut self) -> io::Result<()> {
        self.copy(u32::MAX)?;
        self.out.flush()
    }
}

impl<R: BufRead, W: Write> Sink for Canon<R, W> {
    fn function(&mut self, timed: &Timed, _: &Said) -> io::Result<()> {
        self.copy(timed.act.place.line)?;
        if timed.duration > 0.0 {
            writeln!(self.out, "COMMENT(\"time {:.6}, end {:.6}\")", timed.duration, timed.end())?;
        }
        Ok(())
    }
}
