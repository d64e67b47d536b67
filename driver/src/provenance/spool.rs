//! Rows of the record, kept in a temporary file: a few numbers for each line of the output.

use std::io::{self, BufRead, BufReader, BufWriter, Read, Seek, SeekFrom, Write};

use ncc_ir::source::Span;

use crate::source::spool::Spool;

/// What is known of a line.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Row {
    /// Places of the source.
    pub spans: Vec<Span>,
    /// Places of events that it makes besides: holes that it makes in one with others.
    pub also: Vec<Span>,
    /// Its events.
    pub stretches: Vec<Stretch>,
    /// Events beyond those.
    pub more: u64,
}

/// Events that follow one another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stretch {
    pub(crate) first: u64,
    pub(crate) last: u64,
    /// Their kinds, a bit each.
    pub kinds: u32,
}

/// Rows in their order.
#[derive(Debug)]
pub struct Written {
    file: BufWriter<Spool>,
    /// Memory for the row at hand.
    row: Vec<u8>,
}

impl Written {
    pub(crate) fn new() -> Written {
        Written { file: BufWriter::new(Spool::default()), row: Vec::new() }
    }

    /// Adds a row.
    ///
    /// # Errors
    /// The temporary file cannot be written.
    pub fn push(&mut self, row: &Row) -> io::Result<()> {
        let out = &mut self.row;
        out.clear();
        for spans in [&row.spans, &row.also] {
            number(out, spans.len() as u64);
            for span in spans {
                number(out, u64::from(span.start));
                number(out, u64::from(span.end));
            }
        }
        number(out, row.stretches.len() as u64);
        for stretch in &row.stretches {
            number(out, stretch.first);
            number(out, stretch.last);
            number(out, u64::from(stretch.kinds));
        }
        number(out, row.more);
        self.file.write_all(out)
    }

    /// Reads them from the first one.
    ///
    /// # Errors
    /// The temporary file cannot be read.
    pub fn rows(self) -> io::Result<Rows> {
        let mut file = self.file.into_inner().map_err(io::IntoInnerError::into_error)?;
        file.seek(SeekFrom::Start(0))?;
        Ok(Rows { file: BufReader::new(file) })
    }
}

/// Rows that are read again.
#[derive(Debug)]
pub struct Rows {
    file: BufReader<Spool>,
}

impl Rows {
    /// The next row.
    ///
    /// # Errors
    /// There is none, or the temporary file cannot be read.
    pub fn next(&mut self, row: &mut Row) -> io::Result<()> {
        let from = &mut self.file;
        for spans in [&mut row.spans, &mut row.also] {
            spans.clear();
            for _ in 0..read(from)? {
                spans.push(Span::new(read(from)? as u32, read(from)? as u32));
            }
        }
        row.stretches.clear();
        for _ in 0..read(from)? {
            let (first, last, kinds) = (read(from)?, read(from)?, read(from)? as u32);
            row.stretches.push(Stretch { first, last, kinds });
        }
        row.more = read(from)?;
        Ok(())
    }
}

/// Seven bits a byte, the lowest first; the highest bit says that more follow.
fn number(out: &mut Vec<u8>, mut value: u64) {
    while value > 0x7f {
        out.push((value & 0x7f) as u8 | 0x80);
        value >>= 7;
    }
    out.push(value as u8);
}

fn read(from: &mut BufReader<Spool>) -> io::Result<u64> {
    let mut value = 0u64;
    for shift in (0..64).step_by(7) {
        let byte = match from.buffer().first() {
            Some(&byte) => {
                from.consume(1);
                byte
            }
            None => {
                let mut byte = [0];
                from.read_exact(&mut byte)?;
                byte[0]
            }
        };
        value |= u64::from(byte & 0x7f) << shift;
        if byte & 0x80 == 0 {
            return Ok(value);
        }
    }
    Err(io::ErrorKind::InvalidData.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_come_back_as_they_were() {
        let row = Row {
            spans: vec![Span::new(0, 7), Span::new(300, u32::MAX)],
            also: vec![Span::new(9, 10)],
            stretches: vec![Stretch { first: 127, last: 1 << 40, kinds: 0x800 }],
            more: u64::MAX,
        };
        let mut spool = Written::new();
        let rows = [row.clone(), Row::default(), row];
        rows.iter().for_each(|row| spool.push(row).expect("memory"));
        let mut again = spool.rows().expect("memory");
        let mut found = Row::default();
        for row in &rows {
            again.next(&mut found).expect("a row");
            assert_eq!(found, *row);
        }
        assert!(again.next(&mut found).is_err());
    }
}
