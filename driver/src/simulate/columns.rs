//! The moves of a program as columns of numbers, for a page that draws them: never one object a move.
//!
//! The first line is JSON: how many pieces there are, and for each column its name, its type (`u8`, `u16`, `u32`, `f32`,
//! `f64`), where it begins, counted in bytes from the end of the line, and how many numbers it has. Numbers are little-endian. An arc is as many
//! straight pieces as a picture needs. Where there are tilted planes, that line has their axes as `tilts`: the rows of a matrix, whose
//! third column is the direction of the tool, from its tip.
//!
//! | column | what it is |
//! |---|---|
//! | `t0`, `t1` | begin and end, seconds |
//! | `x0` … `z1` | start and end, mm, coordinates of the part |
//! | `feed`, `speed` | mm/min, 0 in rapids; rev/min, 0 while the spindle is stopped |
//! | `line` | line of the source, from 1; 0 if not known |
//! | `move` | number of the move, from 1 |
//! | `tool` | place of the tool in the document of `ncc simulate` |
//! | `tilt` | 0, or the number of the tilted plane on which the tool stands, from 1; only where there are any |
//! | `kind` | 0 rapid, 1 straight at feed, 2 clockwise, 3 counterclockwise, 4 rapid to an unknown height |

use std::io::{self, Write};

use ncc_simulate::{Way, turned, turned_back};
use serde::Serialize;
use serde_json::{Map, Value};

use super::path::Path;

/// Pieces of a whole circle.
const PIECES: f64 = 96.0;

#[derive(Serialize)]
struct Head {
    #[serde(flatten)]
    about: Map<String, Value>,
    columns: Vec<Column>,
}

#[derive(Serialize)]
struct Column {
    name: &'static str,
    r#type: &'static str,
    offset: usize,
    count: usize,
}

/// Name, type and bytes of a column.
pub(super) type Bytes = (&'static str, &'static str, Vec<u8>);

#[derive(Default)]
struct Columns {
    times: [Vec<f64>; 2],
    places: [Vec<f32>; 6],
    rates: [Vec<f32>; 2],
    lines: Vec<u32>,
    moves: Vec<u32>,
    tools: Vec<u16>,
    tilts: Vec<u16>,
    kinds: Vec<u8>,
}

impl Columns {
    fn piece(&mut self, n: usize, path: &Path, ends: [[f64; 3]; 2], times: [f64; 2]) {
        let own = &path.moves[n];
        for (column, time) in self.times.iter_mut().zip(times) {
            column.push(time);
        }
        for (column, at) in self.places.iter_mut().zip(ends.into_iter().flatten()) {
            column.push(at as f32);
        }
        self.rates[0].push(path.feeds[n]);
        self.rates[1].push(path.speeds[n]);
        self.lines.push(own.line);
        self.moves.push(n as u32 + 1);
        self.tools.push(u16::try_from(own.tool).unwrap_or(u16::MAX));
        self.tilts.push(own.tilt);
        self.kinds.push(match own.way {
            Way::Rapid => 0,
            Way::Feed => 1,
            Way::Arc { sweep, .. } if sweep < 0.0 => 2,
            Way::Arc { .. } => 3,
            Way::Away => 4,
        });
    }

    fn r#move(&mut self, n: usize, path: &Path, from: [f64; 3]) {
        let own = &path.moves[n];
        let [begin, end] = [path.begins[n], own.time];
        let Way::Arc { plane, centre, sweep } = own.way else {
            return self.piece(n, path, [from, own.end], [begin, end]);
        };
        // The arc is one of its tilted plane's axes.
        let axes = own.tilt.checked_sub(1).map(|n| &path.tilts[usize::from(n)]);
        let along = |at: [f64; 3]| axes.map_or(at, |axes| turned_back(axes, at));
        let ends = [along(from), along(own.end)];
        let [f, s, normal] = plane.map(usize::from);
        let count = (sweep.abs() / std::f64::consts::TAU * PIECES).ceil().clamp(1.0, 1e4) as usize;
        let arm = [ends[0][f] - centre[0], ends[0][s] - centre[1]];
        let (radius, end_radius) =
            (arm[0].hypot(arm[1]), (ends[1][f] - centre[0]).hypot(ends[1][s] - centre[1]));
        let mut last = (from, begin);
        for i in 1..=count {
            let part = i as f64 / count as f64;
            let mut at = own.end;
            if i < count {
                let (sin, cos) = (sweep * part).sin_cos();
                // What the end is off the circle is spread over the arc.
                let grown = if radius > 0.0 { 1.0 + part * (end_radius / radius - 1.0) } else { 1.0 };
                at[f] = centre[0] + (arm[0] * cos - arm[1] * sin) * grown;
                at[s] = centre[1] + (arm[0] * sin + arm[1] * cos) * grown;
                at[normal] = ends[0][normal] + part * (ends[1][normal] - ends[0][normal]);
                at = axes.map_or(at, |axes| turned(axes, at));
            }
            let time = begin + part * (end - begin);
            self.piece(n, path, [last.0, at], [last.1, time]);
            last = (at, time);
        }
    }
}

/// Writes the moves.
///
/// # Errors
/// Writing.
pub fn write(out: &mut dyn Write, path: &Path) -> io::Result<()> {
    let mut all = Columns::default();
    let mut from = path.start;
    for n in 0..path.moves.len() {
        all.r#move(n, path, from);
        from = path.moves[n].end;
    }
    let doubles = ["t0", "t1"].into_iter().zip(&all.times);
    let doubles = doubles.map(|(name, own)| (name, "f64", bytes(own, |v| v.to_le_bytes())));
    let places = ["x0", "y0", "z0", "x1", "y1", "z1"].into_iter().zip(&all.places);
    let singles = places.chain(["feed", "speed"].into_iter().zip(&all.rates));
    let singles = singles.map(|(name, own)| (name, "f32", bytes(own, |v| v.to_le_bytes())));
    let wholes = [("line", &all.lines), ("move", &all.moves)];
    let wholes = wholes.into_iter().map(|(name, own)| (name, "u32", bytes(own, |v| v.to_le_bytes())));
    let rest = [("tool", "u16", bytes(&all.tools, |v| v.to_le_bytes())), ("kind", "u8", all.kinds.clone())];
    let columns: Vec<_> = doubles.chain(singles).chain(wholes).chain(rest).collect();
    let tilts = (!path.tilts.is_empty()).then(|| ("tilt", "u16", bytes(&all.tilts, |v| v.to_le_bytes())));
    let columns: Vec<_> = columns.into_iter().chain(tilts).collect();
    let mut about = Map::from_iter([("pieces".to_owned(), all.kinds.len().into())]);
    if !path.tilts.is_empty() {
        about
            .insert("tilts".to_owned(), path.tilts.iter().map(|axes| axes.as_flattened().to_vec()).collect());
    }
    table(out, about, &columns)
}

/// Writes a line of JSON and columns.
pub(super) fn table(out: &mut dyn Write, about: Map<String, Value>, columns: &[Bytes]) -> io::Result<()> {
    let mut offset = 0;
    let columns_of = columns.iter().map(|(name, r#type, bytes)| {
        let width = r#type[1..].parse::<usize>().map_or(1, |bits| bits / 8);
        let own = Column { name, r#type, offset, count: bytes.len() / width };
        offset += bytes.len();
        own
    });
    let head = Head { about, columns: columns_of.collect() };
    let mut line = serde_json::to_vec(&head)?;
    // Columns of a page begin where their type may.
    line.resize((line.len() + 1).next_multiple_of(8) - 1, b' ');
    line.push(b'\n');
    out.write_all(&line)?;
    columns.iter().try_for_each(|(_, _, bytes)| out.write_all(bytes))
}

/// The bytes of a column.
pub(super) fn bytes<T: Copy, const N: usize>(column: &[T], of: impl Fn(T) -> [u8; N]) -> Vec<u8> {
    column.iter().flat_map(|value| of(*value)).collect()
}
