//! What a tool takes under what stays: a disc or a ball on a thinner neck.
//!
//! Along a straight way, and along a level arc, each cell is under the tool between one lowest and one highest place: the
//! lower surface of the sweep, and its upper one, which is that of the tool upside down.

use std::ops::Range;

use fearless_simd::Simd;

use crate::map::{Grid, LANES};
use crate::moves::Way;
use crate::surface::{Across, Along, Cells, Surface, indices};
use crate::sweep::{chords, sweep};
use crate::tool::Cutter;

/// Shows the cells that a tool with an upper surface goes through, and between which heights.
pub(crate) fn through(
    grid: Grid,
    cutter: &Cutter,
    from: [f64; 3],
    to: [f64; 3],
    way: &Way,
    shown: &mut dyn FnMut(usize, [f32; 2]),
) {
    match way {
        Way::Away => {}
        Way::Arc { plane, centre, sweep } if *plane != [0, 1, 2] || from[2] != to[2] => {
            let mut last = from;
            for at in chords(from, to, plane.map(usize::from), *centre, *sweep) {
                one(grid, cutter, [last, at], &Way::Feed, shown);
                last = at;
            }
        }
        Way::Rapid | Way::Feed | Way::Arc { .. } => one(grid, cutter, [from, to], way, shown),
    }
}

fn one(grid: Grid, cutter: &Cutter, ends: [[f64; 3]; 2], way: &Way, shown: &mut dyn FnMut(usize, [f32; 2])) {
    let Some(above) = &cutter.upper() else { return };
    let mut low = Lowest { grid, rows: 0..0, columns: 0..0, heights: Vec::new() };
    sweep(&mut low, cutter, ends.each_ref(), way, false);
    let mut high = Lowest { heights: vec![f32::INFINITY; low.heights.len()], ..low.clone() };
    let upside_down = ends.map(|[x, y, z]| [x, y, -z]);
    sweep(&mut high, above, upside_down.each_ref(), way, false);
    debug_assert_eq!(low.heights.len(), high.heights.len(), "both surfaces reach as far");
    for (n, (low_at, high_at)) in low.heights.iter().zip(&high.heights).enumerate() {
        let [row, column] = [n / low.columns.len(), n % low.columns.len()];
        let cell = grid.index([low.columns.start + column, low.rows.start + row]);
        if low_at.is_finite() && high_at.is_finite() {
            shown(cell, [*low_at, -high_at]);
        }
    }
}

/// The lowest of a surface in the cells of a box, infinite where it is not.
#[derive(Clone)]
struct Lowest {
    grid: Grid,
    rows: Range<usize>,
    columns: Range<usize>,
    heights: Vec<f32>,
}

impl Cells for Lowest {
    fn grid(&self) -> Grid {
        self.grid
    }

    type Sums<S: Simd> = ();

    const TAKES_NARROW: bool = false;

    fn begin<S: Simd>(&mut self, _simd: S, rows: &Range<usize>, columns: &Range<usize>) {
        let with = |own: &Range<usize>, other: &Range<usize>| match own.is_empty() {
            true => other.clone(),
            false => own.start.min(other.start)..own.end.max(other.end),
        };
        let (rows, columns) = (with(&self.rows, rows), with(&self.columns, columns));
        if rows == self.rows && columns == self.columns {
            return;
        }
        let mut heights = vec![f32::INFINITY; rows.len() * columns.len()];
        for (n, height) in self.heights.iter().enumerate() {
            let row = self.rows.start + n / self.columns.len() - rows.start;
            let column = self.columns.start + n % self.columns.len() - columns.start;
            heights[row * columns.len() + column] = *height;
        }
        (self.rows, self.columns, self.heights) = (rows, columns, heights);
    }

    fn row<S: Simd>(
        &mut self,
        _sums: (),
        simd: S,
        row: usize,
        columns: Range<usize>,
        (surface, _least): (impl Surface, f32),
    ) {
        let start = (row - self.rows.start) * self.columns.len();
        for first in columns.clone().step_by(LANES) {
            let new: [f32; LANES] = surface.at(indices(simd, first - columns.start)).into();
            for (column, new) in (first..columns.end).zip(new) {
                let own = &mut self.heights[start + column - self.columns.start];
                *own = own.min(new);
            }
        }
    }

    fn end<S: Simd>(&mut self, _sums: ()) {}

    fn narrow<S: Simd, W: Along>(&mut self, _: (), _: S, _: [Range<usize>; 2], _: Across, _: W) {}
}
