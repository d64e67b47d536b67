//! Every function as a row of CSV (RFC 4180), in the columns of the case study's table.
//!
//! Positions are the program's, mm, after the function; times in seconds, a stamp is the end of its
//! function. Rotary axes have no column in that table; the payload has them.

use std::io::{self, Write};

use ncc_ir::expr::num::Nanos;
use ncc_time::{Machine, Timed};

use super::columns::{Columns, micro};
use super::drive::{Said, Sink};
use super::duration::short;

/// The columns.
pub const HEADER: [&str; 11] =
    ["n", "block", "function_name", "x1", "y1", "z1", "feed", "speed", "tool", "time", "timestamp"];

/// Writes the rows.
pub struct Csv<'m, W: Write> {
    machine: &'m Machine,
    columns: Columns,
    writer: csv::Writer<W>,
}

impl<'m, W: Write> Csv<'m, W> {
    /// Writes the header.
    pub fn new(machine: &'m Machine, out: W) -> io::Result<Csv<'m, W>> {
        let mut writer = csv::WriterBuilder::new().terminator(csv::Terminator::CRLF).from_writer(out);
        writer.write_record(HEADER)?;
        Ok(Csv { machine, columns: Columns::default(), writer })
    }

    /// Nothing is left to write.
    pub fn finish(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

impl<W: Write> Sink for Csv<'_, W> {
    fn wants_blocks(&self) -> bool {
        true
    }

    fn function(&mut self, timed: &Timed, said: &Said) -> io::Result<()> {
        let Some(row) = self.columns.row(timed, self.machine) else { return Ok(()) };
        let at = &timed.act.program_to;
        self.writer.write_record([
            &*row.n.to_string(),
            &said.block,
            row.name,
            &fixed(at[0], 4),
            &fixed(at[1], 4),
            &fixed(at[2], 4),
            &short(row.feed, 3),
            &short(row.speed, 3),
            &row.tool.to_string(),
            // As in the payload: rounded half away from zero.
            &format!("{:.6}", micro(timed.duration)),
            &format!("{:.6}", micro(timed.end())),
        ])?;
        Ok(())
    }
}

/// Nanos with so many digits after the point, rounded half away from zero.
pub fn fixed(nanos: Nanos, digits: u32) -> String {
    let unit = 10u64.pow(9 - digits);
    let rounded = (nanos.unsigned_abs() + unit / 2) / unit;
    let one = 10u64.pow(digits);
    let sign = if nanos < 0 && rounded > 0 { "-" } else { "" };
    format!("{sign}{}.{:0wide$}", rounded / one, rounded % one, wide = digits as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_are_rounded_and_never_minus_zero() {
        for (nanos, text) in [
            (15_588_457_268, "15.5885"),
            (-9_000_000_000, "-9.0000"),
            (-49_999, "0.0000"),
            (-50_000, "-0.0001"),
            (0, "0.0000"),
        ] {
            assert_eq!(fixed(nanos, 4), text);
        }
    }
}
