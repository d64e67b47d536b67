//! The cells that a tool touches on its way along a line, row by row: four rows at once.
//!
//! ```text
//!          ╭──────────╮          left, right      where the row is within the radius of the line
//!   row ──(──[·····]───)──       own              where the low end of the line is what counts
//!          ╰──────────╯
//! ```
//!
//! Lengths in mm from the start of the line, in single precision, which is fine enough for so short pieces. Cells on the very
//! border count as within: half of them would come and go with the rounding.

use std::ops::Range;

use wide::{CmpGe, CmpLe, f32x4};

use crate::surface::{COUNT, LANES, between, not_below_zero};

/// How far the border of a tool counts outwards, in cells.
const BORDER: f32 = 1e-4;

/// A line, the radius of what goes along it, and the cells around both.
pub(crate) struct Rows {
    /// The end of the line.
    pub(crate) end: [f32; 2],
    /// Its direction.
    pub(crate) along: [f32; 2],
    pub(crate) length: f32,
    /// Radius of the tool.
    pub(crate) radius: f32,
    /// Centre of the first cell of the first row.
    pub(crate) first: [f32; 2],
    /// Side of a cell.
    pub(crate) cell: f32,
    /// Cells of a row.
    pub(crate) columns: usize,
}

/// Cells of four rows, counted from the first of a row.
pub(crate) struct Four {
    first: [i32; LANES],
    behind: [i32; LANES],
}

impl Four {
    /// Cells of one of them.
    #[inline(always)]
    pub(crate) fn of(&self, lane: usize) -> Range<usize> {
        self.first[lane] as usize..self.behind[lane] as usize
    }
}

impl Rows {
    /// How far rows are along Y, from one of them on.
    #[inline(always)]
    fn y(&self, row: usize) -> f32x4 {
        (f32x4::splat(row as f32) + COUNT) * self.cell + self.first[1]
    }

    /// From and to which X rows are touched; the first is greater where none is.
    #[inline(always)]
    fn reach(&self, row: usize) -> [f32x4; 2] {
        let y = self.y(row);
        let (none, square) = (f32x4::splat(f32::INFINITY), f32x4::splat(self.radius * self.radius));
        let (mut low, mut high) = (none, -none);
        for (x, y) in [(0.0, y), (self.end[0], y - self.end[1])] {
            let left = square - y * y;
            let half = not_below_zero(left).sqrt();
            let touched = left.cmp_ge(f32x4::ZERO);
            low = low.fast_min(touched.blend(-half + x, none));
            high = high.fast_max(touched.blend(half + x, -none));
        }
        let [ux, uy] = self.along;
        if uy != 0.0 && self.length > 0.0 {
            let per_y = 1.0 / uy;
            for side in [self.radius, -self.radius] {
                // The place along this parallel where the row crosses it.
                let part = (y - side * ux) * per_y;
                let on = part.cmp_ge(f32x4::ZERO) & part.cmp_le(f32x4::splat(self.length));
                let x = part * ux - side * uy;
                low = low.fast_min(on.blend(x, none));
                high = high.fast_max(on.blend(x, -none));
            }
        }
        [low, high]
    }

    /// The part of it that is more than so far along the line.
    #[inline(always)]
    fn beyond(&self, row: usize, [left, right]: [f32x4; 2], done: f32) -> [f32x4; 2] {
        let [ux, uy] = self.along;
        // The X at which the distance along the line, x · ux + y · uy, is `done`.
        let x = || (-self.y(row) * uy + done) * (1.0 / ux);
        if ux > 1e-3 {
            [left.fast_max(x()), right]
        } else if ux < -1e-3 {
            [left, right.fast_min(x())]
        } else {
            [left, right]
        }
    }

    /// Cells that are touched and more than `done` along the line, mm.
    #[inline(always)]
    pub(crate) fn touched(&self, row: usize, done: Option<f32>) -> Four {
        let reach = self.reach(row);
        let [low, high] = done.map_or(reach, |done| self.beyond(row, reach, done));
        let (most, per_mm) = (f32x4::splat(self.columns as f32), 1.0 / self.cell);
        // The cell behind each place, whatever its sign: whole numbers are cut, not rounded down.
        let place = |x: f32x4, off: f32| {
            between((x - self.first[0]) * per_mm + (1.0 + off), f32x4::ZERO, most).fast_trunc_int().to_array()
        };
        Four { first: place(low, -BORDER), behind: place(high, BORDER) }
    }
}
