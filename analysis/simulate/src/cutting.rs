//! Lowers the cells of a map to the surface that a move leaves, and compares that surface with a map.

use std::ops::Range;

use fearless_simd::{Select, Simd, SimdBase, SimdFrom, SimdMask, f32x8, u32x8};

use crate::cut::{Cut, Hit, TOUCH, take};
use crate::map::{Grid, HeightMap, LANES};
use crate::moves::{Move, Way};
use crate::surface::{Across, Along, Cells, Row, Surface, endless, indices, not_below_zero};
use crate::sweep::sweep;
use crate::tool::Cutter;

/// Cuts one move with an upright tool. `number` counts moves from 1; `continues` as for [`sweep`].
///
/// Adds to `cut`. To return it would copy it in pieces of another size than it was written, which the processor waits for.
#[inline(always)]
pub(crate) fn lower(
    map: &mut HeightMap,
    number: u32,
    cutter: &Cutter,
    ends: [&[f64; 3]; 2],
    way: &Way,
    continues: bool,
    cut: &mut Cut,
) {
    let mut cutting = Cutting { has_hollows: !map.hollows.is_empty(), map, number, cut };
    sweep(&mut cutting, cutter, ends, way, continues);
}

/// Lowers a map.
struct Cutting<'m> {
    map: &'m mut HeightMap,
    number: u32,
    has_hollows: bool,
    cut: &'m mut Cut,
}

impl Cutting<'_> {
    /// As [`Cells::row`], cell by cell.
    #[cold]
    #[inline(never)]
    fn row_with_hollows<S: Simd>(
        &mut self,
        simd: S,
        row: usize,
        columns: Range<usize>,
        surface: impl Surface,
    ) {
        let start = self.map.grid.index([0, row]);
        for first in columns.clone().step_by(LANES) {
            let new: [f32; LANES] = surface.at(indices(simd, first - columns.start)).into();
            for (column, new) in (first..columns.end).zip(new) {
                let taken = take(self.map, start + column, [new, f32::INFINITY], self.number);
                self.cut.heights += f64::from(taken);
                self.cut.depth = self.cut.depth.max(taken);
            }
        }
    }
}

/// Removed heights, mm: their sum and the greatest, in each lane.
#[derive(Clone, Copy)]
struct Sums<S: Simd> {
    volumes: f32x8<S>,
    depths: f32x8<S>,
}

impl<S: Simd> Sums<S> {
    #[inline(always)]
    fn new(simd: S) -> Sums<S> {
        Sums { volumes: f32x8::splat(simd, 0.0), depths: f32x8::splat(simd, 0.0) }
    }

    /// Lowers cells to a surface, where that is lower.
    #[inline(always)]
    fn lower(
        &mut self,
        heights: &mut [f32; LANES],
        last: &mut [u32; LANES],
        new: f32x8<S>,
        number: u32x8<S>,
    ) {
        let simd = new.simd;
        let old = f32x8::simd_from(simd, *heights);
        // No height of material is endless as a surface may be: a difference is always a number.
        let depth = not_below_zero(old - new);
        *heights = old.min(new).into();
        let is_lower = new.simd_lt(old);
        *last = is_lower.select(number, u32x8::simd_from(simd, *last)).into();
        self.volumes += depth;
        self.depths = self.depths.max(depth);
    }
}

impl Cells for Cutting<'_> {
    type Sums<S: Simd> = Sums<S>;

    const TAKES_NARROW: bool = true;

    #[inline(always)]
    fn grid(&self) -> Grid {
        self.map.grid
    }

    #[inline(always)]
    fn begin<S: Simd>(&mut self, simd: S, rows: &Range<usize>, columns: &Range<usize>) -> Sums<S> {
        self.cut.reaches(rows, columns);
        Sums::new(simd)
    }

    #[inline(always)]
    fn row<S: Simd>(
        &mut self,
        mut sums: Sums<S>,
        simd: S,
        row: usize,
        columns: Range<usize>,
        (surface, least): (impl Surface, f32),
    ) -> Sums<S> {
        if self.has_hollows {
            self.row_with_hollows(simd, row, columns, surface);
            return sums;
        }
        let begin = self.map.grid.index([columns.start, row]);
        // No `Range::len`, which asks whether the range is the wrong way round.
        let count = columns.end - columns.start;
        let whole = begin..begin + count.next_multiple_of(LANES);
        let heights = self.map.heights.get_mut(whole.clone());
        let (Some(heights), Some(last)) = (heights, self.map.last.get_mut(whole)) else { return sums };
        let (count, mut at, number) =
            (count as i32 as f32, indices(simd, 0), u32x8::splat(simd, self.number));
        for (heights, last) in heights.as_chunks_mut().0.iter_mut().zip(last.as_chunks_mut().0) {
            // Most of what a tool goes over is cut already: the surface is looked at where it may be lower. Cells behind the
            // last one stay.
            if f32x8::simd_from(simd, *heights).simd_gt(least).any_true() {
                let new = at.simd_lt(count).select(surface.at(at), endless(simd));
                sums.lower(heights, last, new, number);
            }
            at += LANES as f32;
        }
        sums
    }

    #[inline(always)]
    fn narrow<S: Simd, W: Along>(
        &mut self,
        mut sums: Sums<S>,
        simd: S,
        [rows, columns]: [Range<usize>; 2],
        at: Across,
        along: W,
    ) -> Sums<S> {
        let grid = self.map.grid;
        if self.has_hollows {
            for row in rows.clone() {
                let surface = Row { at: at.shifted(row - rows.start, 0), along };
                sums = self.row(sums, simd, row, columns.clone(), (surface, f32::NEG_INFINITY));
            }
            return sums;
        }
        let least = along.least(f32x8::splat(simd, 0.0));
        let number = u32x8::splat(simd, self.number);
        // From the first cell of a box to its last. Both slices are as long, so that one test is enough.
        let (begin, count) = (grid.index([columns.start, rows.start]), columns.end - columns.start);
        let all = begin..begin + (rows.end - rows.start - 1) * grid.pitch() + count;
        let heights = self.map.heights.get_mut(all.clone());
        let (Some(heights), Some(last)) = (heights, self.map.last.get_mut(all)) else { return sums };
        let (mut row_s, mut row_d) = at.of(indices(simd, 0));
        let (mut row, steps) = (0, [at.ds * LANES as f32, at.dd * LANES as f32]);
        if count == LANES {
            while let (Some(heights), Some(last)) = (group(heights, row), group(last, row)) {
                sums.lower(heights, last, along.over(row_s, row_d), number);
                (row_s, row_d, row) = (row_s - at.dd, row_d + at.ds, row + grid.pitch());
            }
            return sums;
        }
        while let (Some(heights), Some(last)) =
            (heights.get_mut(row..row + count), last.get_mut(row..row + count))
        {
            let (mut s, mut d) = (row_s, row_d);
            for (heights, last) in heights.as_chunks_mut().0.iter_mut().zip(last.as_chunks_mut().0) {
                if W::IS_CHEAP || f32x8::simd_from(simd, *heights).simd_gt(least).any_true() {
                    sums.lower(heights, last, along.over(s, d), number);
                }
                (s, d) = (s + steps[0], d + steps[1]);
            }
            (row_s, row_d, row) = (row_s - at.dd, row_d + at.ds, row + grid.pitch());
        }
        sums
    }

    /// Adds the sums of a box to the totals: single precision is accurate enough for its cells.
    #[inline(always)]
    fn end<S: Simd>(&mut self, sums: Sums<S>) {
        let simd = sums.volumes.simd;
        // First by halves: one lane after the other takes twice as long.
        let [(one, other), (deep, deeper)] = [simd.split_f32x8(sums.volumes), simd.split_f32x8(sums.depths)];
        let (volumes, depths): ([f32; 4], [f32; 4]) = ((one + other).into(), deep.max(deeper).into());
        self.cut.heights += f64::from(volumes.into_iter().sum::<f32>());
        self.cut.depth = depths.into_iter().fold(self.cut.depth, greater);
    }
}

/// The cells of a group that begins here; none where fewer are left.
#[inline(always)]
fn group<T>(cells: &mut [T], first: usize) -> Option<&mut [T; LANES]> {
    cells.get_mut(first..)?.first_chunk_mut()
}

/// The greater of two numbers: none of them is no number, which `f32::max` must ask.
#[inline(always)]
fn greater(one: f32, other: f32) -> f32 {
    if one > other { one } else { other }
}

/// How deep a part of a tool goes into a map along a move, where it does.
pub(crate) fn probe(map: &HeightMap, part: &Cutter, from: [f64; 3], own: &Move) -> Option<Hit> {
    let mut probing = Probing { map, worst: None };
    sweep(&mut probing, part, [&from, &own.end], &own.way, false);
    probing.worst
}

/// Looks at a map.
struct Probing<'m> {
    map: &'m HeightMap,
    worst: Option<Hit>,
}

impl Cells for Probing<'_> {
    fn grid(&self) -> Grid {
        self.map.grid
    }

    type Sums<S: Simd> = ();

    const TAKES_NARROW: bool = false;

    fn begin<S: Simd>(&mut self, _simd: S, _rows: &Range<usize>, _columns: &Range<usize>) {}

    fn row<S: Simd>(
        &mut self,
        _sums: (),
        simd: S,
        row: usize,
        columns: Range<usize>,
        (surface, _least): (impl Surface, f32),
    ) {
        let (grid, start) = (self.map.grid, self.map.grid.index([0, row]));
        for first in columns.clone().step_by(LANES) {
            let tools: [f32; LANES] = surface.at(indices(simd, first - columns.start)).into();
            for (column, tool) in (first..columns.end).zip(tools) {
                let depth = self.map.heights[start + column] - tool;
                if depth > self.worst.map_or(TOUCH, |worst| worst.depth) {
                    let place = [grid.centre(0, column), grid.centre(1, row), f64::from(tool)];
                    self.worst = Some(Hit { place, depth });
                }
            }
        }
    }

    fn end<S: Simd>(&mut self, _sums: ()) {}

    fn narrow<S: Simd, W: Along>(&mut self, _: (), _: S, _: [Range<usize>; 2], _: Across, _: W) {}
}
