//! The cells that a tool touches on its way along a line, row by row: eight rows at once.
//!
//! ```text
//!          ╭──────────╮          left, right      where the row is within the radius of the line
//!   row ──(──[·····]───)──       own              where the low end of the line is what counts
//!          ╰──────────╯
//! ```
//!
//! Lengths in mm from the start of the line, in single precision, which is fine enough for so short pieces. Cells on the very
//! border count as within: half of them would come and go with the rounding.

use fearless_simd::{Select, Simd, SimdBase, SimdFloat, f32x8, i32x8};

use crate::surface::{endless, indices, not_below_zero};

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

/// Cells that the tool has cut already, so that they are not looked at again. Lengths in mm.
#[derive(Clone, Copy)]
pub(crate) struct Done {
    /// Cells up to so far along the line.
    pub(crate) along: f32,
    /// Cells so far around the start of the line; below zero where none are.
    pub(crate) around: f32,
}

impl Done {
    /// No cells.
    pub(crate) const NONE: Done = Done { along: f32::MIN, around: -1.0 };
}

impl Rows {
    /// How far rows are along Y, from one of them on.
    #[inline(always)]
    fn y<S: Simd>(&self, simd: S, row: usize) -> f32x8<S> {
        indices(simd, row) * self.cell + self.first[1]
    }

    /// From and to which X rows are touched; the first is greater where none is.
    #[inline(always)]
    fn reach<S: Simd>(&self, simd: S, row: usize) -> [f32x8<S>; 2] {
        let y = self.y(simd, row);
        let (none, square) = (endless(simd), f32x8::splat(simd, self.radius * self.radius));
        let (mut low, mut high) = (none, -none);
        for (x, y) in [(0.0, y), (self.end[0], y - self.end[1])] {
            let left = square - y * y;
            let half = not_below_zero(left).sqrt();
            let touched = left.simd_ge(0.0);
            low = low.min(touched.select(-half + x, none));
            high = high.max(touched.select(half + x, -none));
        }
        let [ux, uy] = self.along;
        if uy != 0.0 && self.length > 0.0 {
            let per_y = 1.0 / uy;
            for side in [self.radius, -self.radius] {
                // The place along this parallel where the row crosses it.
                let part = (y - side * ux) * per_y;
                let on = part.simd_ge(0.0) & part.simd_le(self.length);
                let x = part * ux - side * uy;
                low = low.min(on.select(x, none));
                high = high.max(on.select(x, -none));
            }
        }
        [low, high]
    }

    /// The part of it that is more than so far along the line.
    #[inline(always)]
    fn beyond<S: Simd>(&self, simd: S, row: usize, [left, right]: [f32x8<S>; 2], done: f32) -> [f32x8<S>; 2] {
        let [ux, uy] = self.along;
        if ux.abs() <= 1e-3 {
            return [left, right];
        }
        // The X at which the distance along the line, x · ux + y · uy, is `done`.
        let x = (done - self.y(simd, row) * uy) * (1.0 / ux);
        if ux > 0.0 { [left.max(x), right] } else { [left, right.min(x)] }
    }

    /// First cells and ends of two runs in each of a group of rows, counted from the first cell of a row: cells that are touched
    /// and not done. There is one run only where nothing is done around the start: it is given twice.
    #[inline(always)]
    pub(crate) fn touched<S: Simd>(&self, simd: S, row: usize, done: Done) -> [[i32x8<S>; 2]; 2] {
        let [mut low, mut high] = self.reach(simd, row);
        // Cells on the other side of the start are in the hole, if all is done around it.
        if done.along > f32::MIN && done.around < self.radius {
            [low, high] = self.beyond(simd, row, [low, high], done.along);
        }
        let (first, end) = (self.place(low, -BORDER), self.place(high, BORDER));
        if done.around < 0.0 {
            return [[first, end]; 2];
        }
        // The hole between the runs is a little narrower than what is done.
        let y = self.y(simd, row);
        let left = done.around * done.around - y * y;
        let (half, is_near) = (not_below_zero(left).sqrt(), left.simd_ge(0.0));
        let none = endless(simd);
        let hole_first = self.place(is_near.select(-half, none), 2.0 * BORDER).min(end);
        let hole_end = self.place(is_near.select(half, none), -2.0 * BORDER).max(first);
        [[first, hole_first], [hole_end, end]]
    }

    /// The cell behind each X, whatever its sign: conversion to an integer cuts, and does not round down.
    #[inline(always)]
    fn place<S: Simd>(&self, x: f32x8<S>, off: f32) -> i32x8<S> {
        let place = (x - self.first[0]) * (1.0 / self.cell) + (1.0 + off);
        place.max(0.0).min(self.columns as i32 as f32).to_int()
    }
}
