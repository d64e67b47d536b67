//! Every function as a row of CSV (RFC 4180), in the columns of the case study's table.
//!
//! Positions are the program's, mm, after the function; times in seconds, a stamp is the end of its
//! function. Rotary axes have no column in that table; the payload has them.

use std::io::{self, Write};

use ncc_ir::expr::num::Nanos;
use ncc_time::{Machine, Timed};

use super::columns::{Columns, micro, units};
use super::drive::{Said, Sink};
use super::duration::short;
use super::payload::{Document, NotProcessed};

/// The columns.
pub const HEADER: [&str; 11] =
    ["n", "block", "function_name", "x1", "y1", "z1", "feed", "speed", "tool", "time", "timestamp"];

/// A row. Numbers have at most six digits after the point, as the payload has them: so it has the same rows.
struct Line<'l> {
    n: usize,
    block: &'l str,
    name: &'l str,
    at: [f64; 3],
    feed: f64,
    speed: f64,
    tool: i64,
    time: f64,
    stamp: f64,
}

/// Writes rows.
struct Table<W: Write>(csv::Writer<W>);

impl<W: Write> Table<W> {
    fn new(out: W) -> io::Result<Table<W>> {
        let mut writer = csv::WriterBuilder::new().terminator(csv::Terminator::CRLF).from_writer(out);
        writer.write_record(HEADER)?;
        Ok(Table(writer))
    }

    fn line(&mut self, line: &Line) -> io::Result<()> {
        let [x, y, z] = line.at.map(|value| fixed((value * 1e6).round() as Nanos * 1000, 4));
        self.0.write_record([
            &*line.n.to_string(),
            line.block,
            line.name,
            &x,
            &y,
            &z,
            &short(line.feed, 3),
            &short(line.speed, 3),
            &line.tool.to_string(),
            // As in the payload: rounded half away from zero.
            &format!("{:.6}", line.time),
            &format!("{:.6}", line.stamp),
        ])?;
        Ok(())
    }
}

/// Writes the rows of a document that was read back: those of its program, but for blocks of the printed form, which
/// have the G word alone. Gives the block that shows that it was not processed.
///
/// # Errors
/// Writing.
pub fn of_document(document: &Document, out: impl Write) -> io::Result<Result<(), NotProcessed>> {
    if let Err(unusable) = document.processed() {
        return Ok(Err(unusable));
    }
    let mut table = Table::new(out)?;
    for (place, block) in document.blocks.iter().enumerate() {
        table.line(&Line {
            n: place + 1,
            block: &block.gcode,
            name: &block.function_name,
            at: [block.x1, block.y1, block.z1],
            feed: block.feed,
            speed: block.speed,
            tool: block.tool,
            time: block.time,
            stamp: block.timestamp,
        })?;
    }
    table.0.flush().map(Ok)
}

/// Writes the rows of a program.
pub struct Csv<'m, W: Write> {
    machine: &'m Machine,
    columns: Columns,
    table: Table<W>,
}

impl<'m, W: Write> Csv<'m, W> {
    /// Writes the header.
    pub fn new(machine: &'m Machine, out: W) -> io::Result<Csv<'m, W>> {
        Ok(Csv { machine, columns: Columns::default(), table: Table::new(out)? })
    }

    /// Nothing is left to write.
    pub fn finish(&mut self) -> io::Result<()> {
        self.table.0.flush()
    }
}

impl<W: Write> Sink for Csv<'_, W> {
    fn wants_blocks(&self) -> bool {
        true
    }

    fn function(&mut self, timed: &Timed, said: &Said) -> io::Result<()> {
        let Some(row) = self.columns.row(timed, self.machine) else { return Ok(()) };
        let [x, y, z, ..] = timed.act.program_to.map(|nanos| micro(units(nanos)));
        self.table.line(&Line {
            n: row.n as usize,
            block: &said.block,
            name: row.name,
            at: [x, y, z],
            feed: micro(row.feed),
            speed: micro(row.speed),
            tool: row.tool,
            time: micro(timed.duration),
            stamp: micro(timed.end()),
        })
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
