//! Arcs that stay level: of each cell, the nearest place of the arc counts.

use wide::f32x4;

use crate::band::Band;
use crate::surface::{Cells, Surface};

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
            let x0 = grid.centre(0, columns.start) - centre[0];
            let surface = Ring { sector: &sector, band, floor: from[2], from: [x0, y], cell: grid.cell };
            cells.row(row, columns, &surface);
        }
    }
}

/// A band along a level arc, over cells of a row.
struct Ring<'r> {
    sector: &'r Sector,
    band: &'r Band,
    floor: f64,
    /// The first cell, from the centre of the arc.
    from: [f64; 2],
    cell: f64,
}

impl Surface for Ring<'_> {
    #[inline(always)]
    fn at(&self, i: f32x4) -> f32x4 {
        f32x4::new(i.to_array().map(|i| {
            let at = [self.from[0] + f64::from(i) * self.cell, self.from[1]];
            let distance = self.sector.distance(at);
            match distance <= self.band.outer {
                true => (self.floor + self.band.height(distance)) as f32,
                false => f32::INFINITY,
            }
        }))
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
#[inline]
fn quarters([x, y]: [f64; 2]) -> f64 {
    let part = y / (x.abs() + y.abs()).max(f64::MIN_POSITIVE);
    if x < 0.0 {
        2.0 - part
    } else if y < 0.0 {
        4.0 + part
    } else {
        part
    }
}

impl Sector {
    fn new([start, end]: [[f64; 2]; 2], sweep: f64) -> Sector {
        let radii = [start, end].map(|[x, y]: [f64; 2]| (x * x + y * y).sqrt());
        Sector { start, end, radii, sweep }
    }

    /// The radius of the arc in a direction that is one of it.
    #[inline]
    fn radius(&self, at: [f64; 2]) -> f64 {
        let [begin, end] = self.radii;
        if begin == end {
            return begin;
        }
        // Quarters from one direction to another in the sense of the arc.
        let turn =
            |to: [f64; 2]| ((quarters(to) - quarters(self.start)) * self.sweep.signum()).rem_euclid(4.0);
        let all = turn(self.end);
        let part = if all > 0.0 { (turn(at) / all).min(1.0) } else { 0.0 };
        begin + (end - begin) * part
    }

    /// Whether a direction is one of the arc.
    #[inline]
    fn has(&self, at: [f64; 2]) -> bool {
        let cross = |a: [f64; 2], b: [f64; 2]| (a[0] * b[1] - a[1] * b[0]) * self.sweep.signum();
        let behind_start = cross(self.start, at) >= 0.0;
        let before_end = cross(at, self.end) >= 0.0;
        match self.sweep.abs() {
            // Chords of an arc that ends where it begins would be no arc.
            sweep if sweep >= std::f64::consts::TAU - 1e-9 => true,
            sweep if sweep <= std::f64::consts::PI => behind_start && before_end,
            _ => behind_start || before_end,
        }
    }

    /// Distance of a place from the arc.
    #[inline]
    fn distance(&self, at: [f64; 2]) -> f64 {
        let length = |[x, y]: [f64; 2]| (x * x + y * y).sqrt();
        if self.has(at) {
            return (length(at) - self.radius(at)).abs();
        }
        let from = |end: [f64; 2]| length([at[0] - end[0], at[1] - end[1]]);
        from(self.start).min(from(self.end))
    }

    /// The box around the arc.
    fn box_around(&self, radius: f64) -> [[f64; 2]; 2] {
        let ends = [self.start, self.end];
        let tops = [[radius, 0.0], [0.0, radius], [-radius, 0.0], [0.0, -radius]];
        let all = ends.into_iter().chain(tops.into_iter().filter(|top| self.has(*top)));
        all.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], at| {
            [[low[0].min(at[0]), low[1].min(at[1])], [high[0].max(at[0]), high[1].max(at[1])]]
        })
    }
}
