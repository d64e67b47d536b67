//! Arcs that stay level: of each cell, the nearest place of the arc counts.
//!
//! Distances are in single precision, which is fine enough up to [`WIDEST`].

use wide::{CmpGe, CmpGt, CmpLe, CmpLt, f32x4};

use crate::band::{Band, Form};
use crate::surface::{Cells, Surface, not_below_zero};

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
    let grid = cells.grid();
    let sector = Sector::new([from, to].map(|at| [at[0] - centre[0], at[1] - centre[1]]), sweep);
    let outer = band.outer;
    let radius = sector.radii[0].max(sector.radii[1]);
    let [low, high] = sector.box_around(radius);
    let hole = sector.radii[0].min(sector.radii[1]) - outer;
    let [columns, rows] = [0, 1]
        .map(|axis| grid.between(axis, centre[axis] + low[axis] - outer, centre[axis] + high[axis] + outer));
    if columns.is_empty() || rows.is_empty() {
        return;
    }
    cells.reaches(&rows, &columns);
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
            let (floor, cell) = (from[2] as f32, grid.cell as f32);
            cells.row(row, columns, Ring { sector: &sector, band, floor, x, y: y as f32, cell });
        }
    }
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
    fn at(&self, i: f32x4) -> f32x4 {
        let distance = self.sector.distance([i * self.cell + self.x, f32x4::splat(self.y)]);
        let (base, inner) = ((self.band.base as f32) + self.floor, self.band.inner as f32);
        let beyond = not_below_zero(distance - inner);
        let height = match self.band.form {
            Form::Flat => f32x4::splat(base),
            Form::Cone(slope) => beyond * (slope as f32) + base,
            Form::Round(radius) => {
                let radius = radius as f32;
                -not_below_zero(f32x4::splat(radius * radius) - beyond * beyond).sqrt() + (base + radius)
            }
        };
        distance.cmp_le(f32x4::splat(self.band.outer as f32)).blend(height, f32x4::splat(f32::INFINITY))
    }

    #[inline(always)]
    fn least(&self, _cells: usize) -> f32 {
        (self.band.base as f32) + self.floor
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
fn quarters([x, y]: [f32x4; 2]) -> f32x4 {
    let part = y / (x.abs() + y.abs()).fast_max(f32x4::splat(f32::MIN_POSITIVE));
    let right = y.cmp_lt(f32x4::ZERO).blend(part + 4.0, part);
    x.cmp_lt(f32x4::ZERO).blend(-part + 2.0, right)
}

#[inline(always)]
fn length([x, y]: [f32x4; 2]) -> f32x4 {
    (x * x + y * y).sqrt()
}

/// A place, four times.
#[inline(always)]
fn four(at: [f64; 2]) -> [f32x4; 2] {
    at.map(|value| f32x4::splat(value as f32))
}

impl Sector {
    fn new([start, end]: [[f64; 2]; 2], sweep: f64) -> Sector {
        let radii = [start, end].map(|[x, y]: [f64; 2]| (x * x + y * y).sqrt());
        Sector { start, end, radii, sweep }
    }

    /// The radius of the arc in a direction that is one of it.
    #[inline(always)]
    fn radius(&self, at: [f32x4; 2]) -> f32x4 {
        let [begin, end] = self.radii;
        let constant = f32x4::splat(begin as f32);
        if begin == end {
            return constant;
        }
        // Quarters from one direction to another in the sense of the arc.
        let turn = |to: [f32x4; 2]| {
            let turn = (quarters(to) - quarters(four(self.start))) * (self.sweep.signum() as f32);
            turn.cmp_lt(f32x4::ZERO).blend(turn + 4.0, turn)
        };
        let all = turn(four(self.end));
        let part = (turn(at) / all).fast_min(f32x4::splat(1.0));
        let part = all.cmp_gt(f32x4::ZERO).blend(part, f32x4::ZERO);
        constant + part * ((end - begin) as f32)
    }

    /// Whether directions are of the arc: all bits of a number set, or none.
    #[inline(always)]
    fn has(&self, [x, y]: [f32x4; 2]) -> f32x4 {
        let sense = self.sweep.signum();
        let [start, end] = [self.start, self.end].map(|[x, y]| [(x * sense) as f32, (y * sense) as f32]);
        let behind_start = (y * start[0] - x * start[1]).cmp_ge(f32x4::ZERO);
        let before_end = (x * end[1] - y * end[0]).cmp_ge(f32x4::ZERO);
        match self.sweep.abs() {
            // Chords of an arc that ends where it begins would be no arc.
            sweep if sweep >= std::f64::consts::TAU - 1e-9 => f32x4::ZERO.cmp_le(f32x4::ZERO),
            sweep if sweep <= std::f64::consts::PI => behind_start & before_end,
            _ => behind_start | before_end,
        }
    }

    /// Distances of places from the arc.
    #[inline(always)]
    fn distance(&self, at: [f32x4; 2]) -> f32x4 {
        let along = (length(at) - self.radius(at)).abs();
        let from = |end: [f64; 2]| length([at[0] - end[0] as f32, at[1] - end[1] as f32]);
        self.has(at).blend(along, from(self.start).fast_min(from(self.end)))
    }

    /// The box around the arc.
    fn box_around(&self, radius: f64) -> [[f64; 2]; 2] {
        let ends = [self.start, self.end];
        let tops = [[radius, 0.0], [0.0, radius], [-radius, 0.0], [0.0, -radius]];
        let all = ends.into_iter().chain(tops.into_iter().filter(|top| self.has(four(*top)).any()));
        all.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], at| {
            [[low[0].min(at[0]), low[1].min(at[1])], [high[0].max(at[0]), high[1].max(at[1])]]
        })
    }
}
