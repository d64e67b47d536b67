//! The surface that a tool leaves where it goes along: for each cell, the lowest that any part of the tool comes there.
//!
//! Along a straight line that rises by `m` a mm, a tool whose surface is f(r) above its tip comes to
//!
//! ```text
//! z0 + m·t + f(√(d² + (s − t)²))      t, 0 to the length: where the tip is; s, d: along and across the line, of the cell
//! ```
//!
//! over a cell. For each form of a band the lowest of these is known in closed form (flat, cone, ball), or as the root of a
//! polynomial (round corners of a flat tool). Arcs that stay level are as exact: the nearest place of the arc counts. Others,
//! and helices, are cut into chords that leave them by less than [`CHORD`].

use std::ops::Range;

use fearless_simd::{Select, Simd, SimdBase, SimdInt, dispatch, f32x8, i32x8};

use crate::band::{Band, Form};
use crate::level_arc::{WIDEST, level_arc};
use crate::line::Line;
use crate::map::LANES;
use crate::moves::Way;
use crate::rows::{Done, Rows};
use crate::surface::{
    Across, Along, Ball, Cells, Cone, Flat, Level, LevelRound, Row, SlopedRound, WideFlat, Within, indices,
    level,
};
use crate::tool::Cutter;

/// How far chords leave an arc, mm.
const CHORD: f64 = 0.000_25;

/// Longest piece of a line that is worked on at once, mm: single precision is fine enough for such.
const PIECE: f64 = 32.0;

/// Goes along a move of the tip.
///
/// `continues`: the tool has cut already what it cuts where it stands at the start.
#[inline(always)]
pub(crate) fn sweep(
    cells: &mut impl Cells,
    cutter: &Cutter,
    [from, to]: [&[f64; 3]; 2],
    way: &Way,
    continues: bool,
) {
    match way {
        Way::Away => {}
        Way::Rapid | Way::Feed => straight(cells, cutter, [from, to], continues),
        Way::Arc { plane, centre, sweep } => {
            arc(cells, cutter, [from, to], (plane, *centre, *sweep), continues);
        }
    }
}

fn arc(
    cells: &mut impl Cells,
    cutter: &Cutter,
    [from, to]: [&[f64; 3]; 2],
    (plane, centre, sweep): (&[u8; 3], [f64; 2], f64),
    continues: bool,
) {
    if *plane == [0, 1, 2] && from[2] == to[2] && distance([from[0], from[1]], centre) < WIDEST {
        for band in cutter.bands() {
            level_arc(cells, band, [*from, *to], centre, sweep);
        }
        return;
    }
    let (mut last, mut continues) = (*from, continues);
    for at in chords(*from, *to, plane.map(usize::from), centre, sweep) {
        straight(cells, cutter, [&last, &at], continues);
        (last, continues) = (at, true);
    }
}

/// Ends of chords of an arc; the last is its end.
pub(crate) fn chords(
    from: [f64; 3],
    to: [f64; 3],
    [f, s, n]: [usize; 3],
    centre: [f64; 2],
    sweep: f64,
) -> impl Iterator<Item = [f64; 3]> {
    let arm = [from[f] - centre[0], from[s] - centre[1]];
    let radius = arm[0].hypot(arm[1]);
    let end_radius = (to[f] - centre[0]).hypot(to[s] - centre[1]);
    let widest = 2.0 * (1.0 - CHORD / radius.max(end_radius).max(CHORD)).acos();
    let count = (sweep.abs() / widest.max(1e-4)).ceil().clamp(1.0, 1e6) as usize;
    (1..=count).map(move |i| {
        if i == count {
            return to;
        }
        let part = i as f64 / count as f64;
        let (sin, cos) = (sweep * part).sin_cos();
        // The end may be off the circle; what it is off is spread over the arc.
        let grown = if radius > 0.0 { 1.0 + part * (end_radius / radius - 1.0) } else { 1.0 };
        let mut at = from;
        at[f] = centre[0] + (arm[0] * cos - arm[1] * sin) * grown;
        at[s] = centre[1] + (arm[0] * sin + arm[1] * cos) * grown;
        at[n] = from[n] + part * (to[n] - from[n]);
        at
    })
}

#[inline(always)]
fn straight(cells: &mut impl Cells, cutter: &Cutter, [from, to]: [&[f64; 3]; 2], continues: bool) {
    let length = distance([from[0], from[1]], [to[0], to[1]]);
    match length <= PIECE {
        true => piece(cells, cutter, [from, to], length, continues),
        false => long(cells, cutter, [from, to], length, continues),
    }
}

/// A line in pieces.
#[cold]
#[inline(never)]
fn long(cells: &mut impl Cells, cutter: &Cutter, [from, to]: [&[f64; 3]; 2], length: f64, continues: bool) {
    let pieces = (length / PIECE).ceil().min(1e6);
    let mut last = *from;
    for i in 1..=pieces as usize {
        let part = i as f64 / pieces;
        let end =
            if part < 1.0 { [0, 1, 2].map(|axis| from[axis] + (to[axis] - from[axis]) * part) } else { *to };
        piece(cells, cutter, [&last, &end], length / pieces, continues || i > 1);
        last = end;
    }
}

#[inline(always)]
fn piece(cells: &mut impl Cells, cutter: &Cutter, ends: [&[f64; 3]; 2], length: f64, continues: bool) {
    let line = Line::new(ends, length, continues);
    for band in cutter.bands() {
        line.sweep(cells, band);
    }
}

/// The distance of two places. Not by `f64::hypot`, which is a slow call that reckons with numbers that no machine has.
fn distance(one: [f64; 2], other: [f64; 2]) -> f64 {
    let [x, y] = [other[0] - one[0], other[1] - one[1]];
    (x * x + y * y).sqrt()
}

impl Line {
    /// The surface that a band leaves.
    fn sweep(&self, cells: &mut impl Cells, band: &Band) {
        // Uphill, the tool has cut the cells beside and behind the start already: it comes no lower there.
        let rise = self.rise as f32;
        let is_cut = self.continues && rise >= 0.0;
        let around = |radius: f64| match is_cut {
            true => Done { along: 0.0, around: radius as f32 },
            false => Done::NONE,
        };
        let done = Done { around: -1.0, ..around(0.0) };
        let is_level = rise == 0.0;
        match band.form {
            Form::Flat if is_level => self.rows::<Level>(cells, band, around(band.outer)),
            Form::Flat if band.outer > WIDE * cells.grid().cell => {
                self.rows::<WideFlat>(cells, band, around(band.outer));
            }
            Form::Flat => self.rows::<Flat>(cells, band, around(band.outer)),
            Form::Round(radius) if band.inner == 0.0 => {
                // Downhill, a ball comes lowest over cells that are behind its tip, so far at most.
                let behind = radius as f32 * Ball::ahead(rise).min(0.0);
                let along = if self.continues { behind } else { f32::MIN };
                self.rows::<Ball>(cells, band, Done { along, ..Done::NONE });
            }
            Form::Round(_) => {
                let done = around(band.inner);
                match is_level {
                    true => self.rows::<LevelRound>(cells, band, done),
                    false => self.rows::<SlopedRound>(cells, band, done),
                }
            }
            Form::Cone(_) => self.rows::<Cone>(cells, band, done),
        }
    }

    /// From and to where along X or Y a band of this radius touches cells that are more than `done` along the line.
    ///
    /// ```text
    ///        ╭────┬─────╮
    ///   ( ···│ ───│──▶  │ )     the box begins beside the place that is `done`, not a radius before it
    ///        ╰────┴─────╯
    /// ```
    #[inline(always)]
    fn reach(&self, axis: usize, radius: f64, done: f64) -> [f64; 2] {
        let (from, to, along, across) =
            (self.from[axis], self.to[axis], self.along[axis], self.along[1 - axis].abs());
        let begin = least(radius, radius * across - done + BESIDE);
        match along > 0.0 {
            true => [from - begin, to + radius],
            false => [to - radius, from + begin],
        }
    }

    /// Goes over the rows that a band touches. `done` is known to be cut already.
    ///
    /// Each surface is compiled on its own: fewer values wait in memory for a register than in one large function.
    fn rows<W: Along>(&self, cells: &mut impl Cells, band: &Band, done: Done) {
        dispatch!(level(), simd => self.rows_by::<_, _, W>(simd, cells, band, done));
    }

    #[inline(always)]
    fn rows_by<S: Simd, C: Cells, W: Along>(&self, simd: S, cells: &mut C, band: &Band, done: Done) {
        let (grid, radius, along) = (cells.grid(), band.outer, W::of(self, band));
        let [[x0, y0, _], [x1, y1, _]] = [self.from, self.to];
        let [mut left, mut right] = [least(x0, x1) - radius, most(x0, x1) + radius];
        let [mut front, mut back] = [least(y0, y1) - radius, most(y0, y1) + radius];
        let (width, cells_wide) = (right - left, |cells: usize| cells as f64 * grid.cell);
        let narrow = C::TAKES_NARROW && width <= cells_wide(W::NARROW);
        // Of a few cells, all are worked on sooner than it is known which ones. In wide boxes they are passed over row by row.
        if narrow && done.along > f32::MIN && width > cells_wide(2 * LANES) {
            [left, right] = self.reach(0, radius, f64::from(done.along));
            [front, back] = self.reach(1, radius, f64::from(done.along));
        }
        let (columns, rows) = (grid.about(0, left, right), grid.about(1, front, back));
        if columns.is_empty() || rows.is_empty() {
            return;
        }
        let columns = if narrow { whole_groups(columns, grid.pitch()) } else { columns };
        let mut sums = cells.begin(simd, &rows, &columns);
        let cell = grid.cell as f32;
        let first = [grid.centre(0, columns.start) - self.from[0], grid.centre(1, rows.start) - self.from[1]];
        let [ux, uy] = self.along;
        // Of the first cell; `ds` and `dd` are the steps from column to column, and with them those from row to row.
        let (s, d) = ((first[0] * ux + first[1] * uy) as f32, (first[1] * ux - first[0] * uy) as f32);
        let at = Across { s, d, ds: cell * ux as f32, dd: -cell * uy as f32 };
        if narrow {
            // Asking of each cell is less work than asking where the cells of each row begin.
            sums = cells.narrow(sums, simd, [rows, columns], at, Within(along));
            cells.end(sums);
            return;
        }
        let touched = Rows {
            end: [(self.to[0] - self.from[0]) as f32, (self.to[1] - self.from[1]) as f32],
            along: [ux as f32, uy as f32],
            length: self.length as f32,
            radius: radius as f32,
            first: [first[0] as f32, first[1] as f32],
            cell,
            columns: columns.len(),
        };
        for group in (0..rows.len()).step_by(LANES) {
            let runs = touched.touched(simd, group, done);
            let count = if done.around < 0.0 { 1 } else { 2 };
            for run in &runs[..count] {
                let run = Run::new(indices(simd, group), *run, &at, along);
                for (lane, row) in (group..rows.len()).take(LANES).enumerate() {
                    let (first, end) = (run.first[lane] as usize, run.end[lane] as usize);
                    if first < end {
                        let surface = Row { at: Across { s: run.s[lane], d: run.d[lane], ..at }, along };
                        let columns = columns.start + first..columns.start + end;
                        sums = cells.row(sums, simd, rows.start + row, columns, (surface, run.least[lane]));
                    }
                }
            }
        }
        cells.end(sums);
    }
}

/// One run of cells in each of a group of rows.
struct Run {
    first: [i32; LANES],
    end: [i32; LANES],
    /// Coordinates of the first cell along and across the line.
    s: [f32; LANES],
    d: [f32; LANES],
    /// Heights that the surface does not go below.
    least: [f32; LANES],
}

impl Run {
    #[inline(always)]
    fn new<S: Simd>(rows: f32x8<S>, [first, end]: [i32x8<S>; 2], at: &Across, along: impl Along) -> Run {
        let (column, behind): (f32x8<S>, f32x8<S>) = (first.to_float(), end.to_float());
        let s = column * at.ds - rows * at.dd + at.s;
        let row_d = rows * at.ds + at.d;
        let (d, last) = (column * at.dd + row_d, (behind - 1.0) * at.dd + row_d);
        // The line goes on at both ends; where it crosses the run, its distance is 0.
        let nearest = (d * last).simd_gt(0.0).select(d.abs().min(last.abs()), f32x8::splat(rows.simd, 0.0));
        let least = along.least(nearest);
        Run { first: first.into(), end: end.into(), s: s.into(), d: d.into(), least: least.into() }
    }
}

/// So much more than is not done is looked at, mm: cells on the border between both would be lost by rounding.
const BESIDE: f64 = 1e-5;

/// Radius of a wide tool, in cells.
const WIDE: f64 = 6.0;

/// Some more columns, so that these are whole groups; all of them in the rows of a map.
#[inline(always)]
fn whole_groups(columns: Range<usize>, pitch: usize) -> Range<usize> {
    let count = (columns.end - columns.start).next_multiple_of(LANES);
    let start = columns.start.min(pitch - count);
    start..start + count
}

/// The lesser of two numbers: none of them is no number, which `f64::min` must ask.
#[inline(always)]
fn least(one: f64, other: f64) -> f64 {
    if one < other { one } else { other }
}

/// The greater of two numbers.
#[inline(always)]
fn most(one: f64, other: f64) -> f64 {
    if one > other { one } else { other }
}
