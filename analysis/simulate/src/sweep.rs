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

use crate::band::{Band, Form};
use crate::level_arc::level_arc;
use crate::moves::Way;
use crate::surface::{
    Across, Around, Ball, BallAt, Cells, Cone, ConeAt, Flat, Level, LevelRound, Round, RoundAt, Sloped,
    SlopedRound, Surface, Within,
};
use crate::tool::Cutter;

/// How far chords leave an arc, mm.
const CHORD: f64 = 0.000_25;

/// Longest piece of a line that is worked on at once, mm: single precision is fine enough for such.
const PIECE: f64 = 32.0;

/// Goes along a move of the tip.
pub(crate) fn sweep(cells: &mut impl Cells, cutter: &Cutter, from: [f64; 3], to: [f64; 3], way: &Way) {
    match way {
        Way::Away => {}
        Way::Rapid | Way::Feed => straight(cells, cutter, from, to),
        Way::Arc { plane: [0, 1, 2], centre, sweep } if from[2] == to[2] => {
            for band in cutter.bands() {
                level_arc(cells, band, [from, to], *centre, *sweep);
            }
        }
        Way::Arc { plane, centre, sweep } => {
            let mut last = from;
            for at in chords(from, to, plane.map(usize::from), *centre, *sweep) {
                straight(cells, cutter, last, at);
                last = at;
            }
        }
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

fn straight(cells: &mut impl Cells, cutter: &Cutter, from: [f64; 3], to: [f64; 3]) {
    let pieces = (distance([from[0], from[1]], [to[0], to[1]]) / PIECE).ceil().clamp(1.0, 1e6) as usize;
    let point = |i: usize| match i == pieces {
        true => to,
        false => {
            std::array::from_fn(|axis| from[axis] + (to[axis] - from[axis]) * (i as f64 / pieces as f64))
        }
    };
    for i in 0..pieces {
        let line = Line::new(point(i), point(i + 1));
        for band in cutter.bands() {
            line.sweep(cells, band);
        }
    }
}

/// The distance of two places. Not by `f64::hypot`, which is a slow call that reckons with numbers that no machine has.
fn distance(one: [f64; 2], other: [f64; 2]) -> f64 {
    let [x, y] = [other[0] - one[0], other[1] - one[1]];
    (x * x + y * y).sqrt()
}

/// A straight way of the tip, seen from above.
struct Line {
    from: [f64; 3],
    to: [f64; 3],
    /// Its direction.
    along: [f64; 2],
    length: f64,
    /// How much it rises a mm.
    rise: f64,
}

impl Line {
    fn new(from: [f64; 3], to: [f64; 3]) -> Line {
        let [x, y] = [to[0] - from[0], to[1] - from[1]];
        let length = distance([from[0], from[1]], [to[0], to[1]]);
        if length < 1e-9 {
            // Straight down or up: what counts is the lower end.
            let low = [from[0], from[1], from[2].min(to[2])];
            return Line { from: low, to: low, along: [1.0, 0.0], length: 0.0, rise: 0.0 };
        }
        Line { from, to, along: [x / length, y / length], length, rise: (to[2] - from[2]) / length }
    }

    /// The surface that a band leaves.
    fn sweep(&self, cells: &mut impl Cells, band: &Band) {
        let low = self.low();
        let (floor, bottom) = ((self.from[2] + band.base) as f32, (low[2] + band.base) as f32);
        let (rise, outer, inner) = (self.rise as f32, (band.outer * band.outer) as f32, band.inner as f32);
        let own = |at| Sloped { at, floor, rise, outer };
        match band.form {
            Form::Flat if rise == 0.0 => self.rows(cells, band, |_| Level(floor), |_| Level(bottom)),
            Form::Flat => self.rows(cells, band, |at| Flat(own(at)), |_| Level(bottom)),
            Form::Round(radius) if band.inner == 0.0 => {
                let ahead = rise / (1.0 + rise * rise).sqrt();
                let (radius, square) = (radius as f32, (radius * radius) as f32);
                let top = bottom + radius;
                let ball = |at| Ball { own: own(at), radius, square, ahead };
                self.rows(cells, band, ball, |around| BallAt { around, top, square });
            }
            Form::Round(radius) => {
                let round = Round { inner, radius: radius as f32, outer: band.outer as f32 };
                let end = |around| RoundAt { around, floor: bottom, round };
                match rise == 0.0 {
                    true => self.rows(cells, band, |at| LevelRound { own: own(at), round }, end),
                    false => self.rows(cells, band, |at| SlopedRound { own: own(at), round }, end),
                }
            }
            Form::Cone(slope) => {
                let slope = slope as f32;
                let steep = rise.abs() >= slope;
                let ahead = if steep { 0.0 } else { rise / (slope * slope - rise * rise).sqrt() };
                let sense = if rise == 0.0 { 0.0 } else { rise.signum() };
                let beside = if steep { sense } else { 0.0 };
                let cone = |at| Cone { own: own(at), slope, inner, ahead, beside, sense };
                self.rows(cells, band, cone, |around| ConeAt { around, floor: bottom, slope, inner });
            }
        }
    }

    /// Goes over the rows that a band touches, with the surface of the way, and with that of its low end where this one
    /// counts.
    #[inline(always)]
    fn rows<W: Surface, E: Surface>(
        &self,
        cells: &mut impl Cells,
        band: &Band,
        way: impl Fn(Across) -> W,
        end: impl Fn(Around) -> E,
    ) {
        let grid = cells.grid();
        let radius = band.outer;
        let [columns, rows] = [0, 1].map(|axis| {
            let [one, other] = [self.from[axis], self.to[axis]];
            grid.between(axis, least(one, other) - radius, most(one, other) + radius)
        });
        if columns.is_empty() || rows.is_empty() {
            return;
        }
        cells.reaches(&rows, &columns);
        let [ux, uy] = self.along;
        let (ds, dd, length) = ((grid.cell * ux) as f32, (-grid.cell * uy) as f32, self.length as f32);
        let across = |row, column| {
            let off = [grid.centre(0, column) - self.from[0], grid.centre(1, row) - self.from[1]];
            let (s, d) = ((off[0] * ux + off[1] * uy) as f32, (off[1] * ux - off[0] * uy) as f32);
            Across { s, d, ds, dd, length }
        };
        if columns.len() <= NARROW {
            // Asking of each cell is less work than asking where the cells of each row begin.
            let outer = (radius * radius) as f32;
            for row in rows {
                let at = across(row, columns.start);
                cells.row(row, columns.clone(), &Within { way: way(at), at, outer });
            }
            return;
        }
        let reach = Reach::new(self, radius);
        for row in rows {
            let y = grid.centre(1, row);
            let [left, right] = reach.at(y);
            let columns = grid.between(0, left, right);
            if columns.is_empty() {
                continue;
            }
            if self.rise == 0.0 || columns.len() <= SHORT {
                let first = columns.start;
                cells.row(row, columns, &way(across(row, first)));
                continue;
            }
            let [low, high] = self.of_low_end(y, band, [left, right]);
            let own = grid.between(0, low, high);
            let own = own.start.clamp(columns.start, columns.end)..own.end.clamp(columns.start, columns.end);
            let own = if own.is_empty() { columns.start..columns.start } else { own };
            if !own.is_empty() {
                let low = self.low();
                let off = y - low[1];
                let x = (grid.centre(0, own.start) - low[0]) as f32;
                let around = Around { x, dx: grid.cell as f32, y2: (off * off) as f32 };
                cells.row(row, own.clone(), &end(around));
            }
            for columns in [columns.start..own.start, own.end..columns.end] {
                if !columns.is_empty() {
                    let first = columns.start;
                    cells.row(row, columns, &way(across(row, first)));
                }
            }
        }
    }

    /// The end where the tip is lowest.
    fn low(&self) -> &[f64; 3] {
        if self.rise > 0.0 { &self.from } else { &self.to }
    }

    /// Where a row of the way is cut lowest from the low end: behind that end, as the way rises, and under what is level of
    /// the tool there. Not all such places need to be among these. The first is greater than the second where there are none.
    #[inline(always)]
    fn of_low_end(&self, y: f64, band: &Band, [left, right]: [f64; 2]) -> [f64; 2] {
        let [x, at, _] = *self.low();
        let off = y - at;
        let sense = if self.rise < 0.0 { -1.0 } else { 1.0 };
        let [ux, uy] = [self.along[0] * sense, self.along[1] * sense];
        // Behind is where (place - end) · direction is below zero.
        let behind = if ux > 1e-9 {
            [left, least(right, x - off * uy / ux)]
        } else if ux < -1e-9 {
            [most(left, x - off * uy / ux), right]
        } else if off * uy <= 0.0 {
            [left, right]
        } else {
            [right, left]
        };
        let half = band.inner * band.inner - off * off;
        if half <= 0.0 {
            return behind;
        }
        let half = half.sqrt();
        let level = [x - half, x + half];
        if behind[0] > behind[1] {
            return level;
        }
        match level[0] <= behind[1] && level[1] >= behind[0] {
            true => [least(behind[0], level[0]), most(behind[1], level[1])],
            false => behind,
        }
    }
}

/// A box around a line with so few columns is worked on as a whole.
const NARROW: usize = 12;

/// Rows with so few cells are worked on as a whole.
const SHORT: usize = 8;

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

/// Where rows are within a distance of a line.
struct Reach {
    from: [f64; 2],
    to: [f64; 2],
    square: f64,
    /// For both parallels: X where they begin, and how far along the line a row at the line's start is.
    parallels: [[f64; 2]; 2],
    /// X of a mm along the line.
    ux: f64,
    /// Along the line, of a mm along Y; 0 where it has none.
    per_y: f64,
    length: f64,
}

impl Reach {
    fn new(line: &Line, radius: f64) -> Reach {
        let [ux, uy] = line.along;
        let per_y = if line.length > 0.0 && uy != 0.0 { 1.0 / uy } else { 0.0 };
        let parallel = |side: f64| [line.from[0] - side * uy, -side * ux * per_y];
        Reach {
            from: [line.from[0], line.from[1]],
            to: [line.to[0], line.to[1]],
            square: radius * radius,
            parallels: [parallel(radius), parallel(-radius)],
            ux,
            per_y,
            length: line.length,
        }
    }

    /// The first is greater than the second where a row is not.
    #[inline(always)]
    fn at(&self, y: f64) -> [f64; 2] {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let off = y - self.from[1];
        for (end, off) in [(self.from[0], off), (self.to[0], y - self.to[1])] {
            let half = self.square - off * off;
            if half >= 0.0 {
                let half = half.sqrt();
                low = least(low, end - half);
                high = most(high, end + half);
            }
        }
        if self.per_y != 0.0 {
            for [x, begin] in self.parallels {
                let part = begin + off * self.per_y;
                if part >= 0.0 && part <= self.length {
                    let x = x + part * self.ux;
                    low = least(low, x);
                    high = most(high, x);
                }
            }
        }
        [low, high]
    }
}
