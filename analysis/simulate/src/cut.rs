//! Cuts cells of a map between two heights, and finds material in the way of a move.

use std::ops::Range;

use crate::map::{Grid, HeightMap};

/// Depths up to this are no collision, mm: what single precision makes of two surfaces at one place.
pub(crate) const TOUCH: f32 = 0.001;

/// The material that a move has removed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Removed {
    /// Volume, mm³.
    pub volume: f32,
    /// Greatest depth at a place, mm.
    pub depth: f32,
}

/// The change of a map by a move: the material removed, and the box of the cells changed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cut {
    /// Height removed, summed over all cells, mm.
    pub(crate) heights: f64,
    /// Greatest height removed in a cell, mm.
    pub(crate) depth: f32,
    pub(crate) columns: Range<usize>,
    pub(crate) rows: Range<usize>,
}

impl Cut {
    /// The material removed, of cells with this side.
    #[inline]
    pub(crate) fn removed(&self, cell: f64) -> Removed {
        Removed { volume: (self.heights * cell * cell) as f32, depth: self.depth }
    }

    pub(crate) fn reaches(&mut self, rows: &Range<usize>, columns: &Range<usize>) {
        let with = |own: &Range<usize>, other: &Range<usize>| match own.is_empty() {
            true => other.clone(),
            false => own.start.min(other.start)..own.end.max(other.end),
        };
        self.columns = with(&self.columns, columns);
        self.rows = with(&self.rows, rows);
    }
}

/// A collision: its place, and how deep the tool is in material there, mm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    pub(crate) place: [f64; 3],
    pub(crate) depth: f32,
}

/// Takes the material of a cell between two heights; gives how much that was.
pub(crate) fn take(map: &mut HeightMap, cell: usize, between: [f32; 2], number: u32) -> f32 {
    let top = &mut map.heights[cell];
    if between[0] >= *top {
        return 0.0;
    }
    let (new, taken) = map.hollows.take(cell, *top, between, number);
    if new < *top {
        (*top, map.last[cell]) = (new, number);
    }
    taken
}

/// Shows cells, and between which heights a tool goes through each.
pub(crate) type Shown<'s> = &'s mut dyn FnMut(usize, [f32; 2]);

/// Cuts the cells that are shown.
pub(crate) fn cut_between(map: &mut HeightMap, number: u32, show: impl FnOnce(Shown)) -> Cut {
    let (mut cut, grid) = (Cut::default(), map.grid);
    show(&mut |cell, between| {
        let taken = take(map, cell, between, number);
        if taken > 0.0 {
            let [column, row] = grid.place(cell);
            cut.reaches(&(row..row + 1), &(column..column + 1));
            cut.heights += f64::from(taken);
            cut.depth = cut.depth.max(taken);
        }
    });
    cut
}

/// The deepest place where material is in the way, of the cells that are shown.
pub(crate) fn probe_between(map: &HeightMap, show: impl FnOnce(Shown)) -> Option<Hit> {
    let (grid, mut worst): (Grid, _) = (map.grid, None::<Hit>);
    show(&mut |cell, between| {
        let depth = map.hollows.material(cell, map.heights[cell], between);
        if depth > worst.map_or(TOUCH, |worst| worst.depth) {
            let [column, row] = grid.place(cell);
            let place = [grid.centre(0, column), grid.centre(1, row), f64::from(between[0])];
            worst = Some(Hit { place, depth });
        }
    });
    worst
}
