//! Arcs that stay level: of each cell, the nearest place of the arc counts.
//!
//! Distances are in single precision, which is fine enough up to [`WIDEST`].

use fearless_simd::{Select, Simd, SimdBase, SimdFloat, SimdMask, dispatch, f32x8, mask32x8};

use crate::band::{Band, Form};
use crate::surface::{Cells, Surface, endless, level, not_below_zero};

/// Radius of the widest arc, mm.
pub(super) const WIDEST: f64 = 1000.0;

/// A level arc: over each cell, the nearest place of the tip counts.
pub(super) fn level_arc(
    cells: &mut impl Cells,
    band: &Band,
    [from, to]: [[f64; 3]; 2],
    centre: [f64; 2],
    sweep: f64,
) {
    let sector = Sector::new([from, to].map(|at| [at[0] - centre[0], at[1] - centre[1]]), sweep);
    dispatch!(level(), simd => rows(simd, cells, band, from[2], centre, &sector));
}

#[inline(always)]
fn rows<S: Simd>(
    simd: S,
    cells: &mut impl Cells,
    band: &Band,
    floor: f64,
    centre: [f64; 2],
    sector: &Sector,
) {
    let grid = cells.grid();
    let outer = band.outer;
    let radius = sector.radii[0].max(sector.radii[1]);
    let [low, high] = sector.box_around(simd, radius);
    let hole = sector.radii[0].min(sector.radii[1]) - outer;
    let [columns, rows] = [0, 1]
        .map(|axis| grid.between(axis, centre[axis] + low[axis] - outer, centre[axis] + high[axis] + outer));
    if columns.is_empty() || rows.is_empty() {
        return;
    }
    let mut sums = cells.begin(simd, &rows, &columns);
    for row in rows {
        let y = grid.centre(1, row) - centre[1];
        let half = ((radius + outer).powi(2) - y * y).max(0.0).sqrt();
        let left = (low[0] - outer).max(-half);
        let right = (high[0] + outer).min(half);
        // Nothing is cut around the centre of a wide arc.
        let gap = if hole > y.abs() { (hole * hole - y * y).sqrt() } else { 0.0 };
        for [left, right] in [[left, right.min(-gap)], [left.max(gap), right]] {
            let columns = grid.between(0, centre[0] + left, centre[0] + right);
            if left > right || columns.is_empty() {
                continue;
            }
            let x = (grid.centre(0, columns.start) - centre[0]) as f32;
            let (floor, cell) = (floor as f32, grid.cell as f32);
            let ring = Ring { sector, band, floor, x, y: y as f32, cell };
            let least = band.base as f32 + floor;
            sums = cells.row(sums, simd, row, columns, (ring, least));
        }
    }
    cells.end(sums);
}

/// A band along a level arc, over cells of a row.
#[derive(Clone, Copy)]
struct Ring<'r> {
    sector: &'r Sector,
    band: &'r Band,
    floor: f32,
    /// The first cell, from the centre of the arc.
    x: f32,
    y: f32,
    cell: f32,
}

impl Surface for Ring<'_> {
    #[inline(always)]
    fn at<S: Simd>(&self, i: f32x8<S>) -> f32x8<S> {
        let distance = self.sector.distance([i * self.cell + self.x, f32x8::splat(i.simd, self.y)]);
        let (base, inner) = ((self.band.base as f32) + self.floor, self.band.inner as f32);
        let beyond = not_below_zero(distance - inner);
        let height = match self.band.form {
            Form::Flat => f32x8::splat(i.simd, base),
            Form::Cone(slope) => beyond * (slope as f32) + base,
            Form::Round(radius) => {
                let radius = radius as f32;
                (base + radius) - not_below_zero(radius * radius - beyond * beyond).sqrt()
            }
        };
        distance.simd_le(self.band.outer as f32).select(height, endless(i.simd))
    }
}

/// An arc about the origin. Its end may be a little farther from there than its start, or nearer, as controls allow it for
/// rounded numbers: what that is, is spread over the arc.
struct Sector {
    start: [f64; 2],
    end: [f64; 2],
    /// Distances of both.
    radii: [f64; 2],
    sweep: f64,
}

/// The direction of a place in quarters of a turn, from 0 to 4: it grows as the angle does, which is enough to spread what
/// is small.
#[inline(always)]
fn quarters<S: Simd>([x, y]: [f32x8<S>; 2]) -> f32x8<S> {
    let part = y / (x.abs() + y.abs()).max(f32::MIN_POSITIVE);
    let right = y.simd_lt(0.0).select(part + 4.0, part);
    x.simd_lt(0.0).select(2.0 - part, right)
}

#[inline(always)]
fn length<S: Simd>([x, y]: [f32x8<S>; 2]) -> f32x8<S> {
    (x * x + y * y).sqrt()
}

/// A place, once a lane.
#[inline(always)]
fn splat<S: Simd>(simd: S, at: [f64; 2]) -> [f32x8<S>; 2] {
    [f32x8::splat(simd, at[0] as f32), f32x8::splat(simd, at[1] as f32)]
}

impl Sector {
    fn new([start, end]: [[f64; 2]; 2], sweep: f64) -> Sector {
        let radii = [start, end].map(|[x, y]: [f64; 2]| (x * x + y * y).sqrt());
        Sector { start, end, radii, sweep }
    }

    /// The radius of the arc in a direction that is one of it.
    #[inline(always)]
    fn radius<S: Simd>(&self, at: [f32x8<S>; 2]) -> f32x8<S> {
        let simd = at[0].simd;
        let [begin, end] = self.radii;
        let constant = f32x8::splat(simd, begin as f32);
        if begin == end {
            return constant;
        }
        let all = self.turn(splat(simd, self.end));
        let part = (self.turn(at) / all).min(1.0);
        let part = all.simd_gt(0.0).select(part, f32x8::splat(simd, 0.0));
        constant + part * ((end - begin) as f32)
    }

    /// Quarters of a turn from the start to a direction, in the sense of the arc.
    #[inline(always)]
    fn turn<S: Simd>(&self, to: [f32x8<S>; 2]) -> f32x8<S> {
        let turn = (quarters(to) - quarters(splat(to[0].simd, self.start))) * (self.sweep.signum() as f32);
        turn.simd_lt(0.0).select(turn + 4.0, turn)
    }

    /// Whether directions are of the arc.
    #[inline(always)]
    fn has<S: Simd>(&self, [x, y]: [f32x8<S>; 2]) -> mask32x8<S> {
        let sense = self.sweep.signum();
        let [start, end] = [self.start, self.end].map(|[x, y]| [(x * sense) as f32, (y * sense) as f32]);
        let behind_start = (y * start[0] - x * start[1]).simd_ge(0.0);
        let before_end = (x * end[1] - y * end[0]).simd_ge(0.0);
        match self.sweep.abs() {
            // Chords of an arc that ends where it begins would be no arc.
            sweep if sweep >= std::f64::consts::TAU - 1e-9 => mask32x8::splat(x.simd, true),
            sweep if sweep <= std::f64::consts::PI => behind_start & before_end,
            _ => behind_start | before_end,
        }
    }

    /// Distances of places from the arc.
    #[inline(always)]
    fn distance<S: Simd>(&self, at: [f32x8<S>; 2]) -> f32x8<S> {
        let along = (length(at) - self.radius(at)).abs();
        let [start, end] = [self.start, self.end].map(|end| end.map(|part| part as f32));
        let from_start = length([at[0] - start[0], at[1] - start[1]]);
        let from_end = length([at[0] - end[0], at[1] - end[1]]);
        self.has(at).select(along, from_start.min(from_end))
    }

    /// The box around the arc.
    fn box_around<S: Simd>(&self, simd: S, radius: f64) -> [[f64; 2]; 2] {
        let ends = [self.start, self.end];
        let tops = [[radius, 0.0], [0.0, radius], [-radius, 0.0], [0.0, -radius]];
        let all =
            ends.into_iter().chain(tops.into_iter().filter(|top| self.has(splat(simd, *top)).any_true()));
        all.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], at| {
            [[low[0].min(at[0]), low[1].min(at[1])], [high[0].max(at[0]), high[1].max(at[1])]]
        })
    }
}
