//! Undo and redo for a height map: its state after any move, forwards and backwards.
//!
//! After every [`STRIDE`] moves, `keep` stores each changed cell with its old and its new value. `show` applies these
//! changes from stride to stride. The caller then cuts the moves from the stride to the wanted one: fewer than [`STRIDE`].

use crate::map::{HeightMap, TILE};

/// Moves between two stored states.
pub(crate) const STRIDE: usize = 5_000;

/// A cell that has changed in a stride; old and new value.
#[derive(Clone, Copy, Debug)]
struct Change {
    cell: u32,
    heights: [f32; 2],
    last: [u32; 2],
}

/// The changes of each stride.
#[derive(Clone, Debug)]
pub(crate) struct History {
    strides: Vec<Vec<Change>>,
    /// The map at stride `at`.
    base: HeightMap,
    /// Strides from the start to `base`.
    at: usize,
    /// Tiles in which the shown map may differ from `base`.
    dirty: Vec<bool>,
    /// Tiles along X.
    across: usize,
}

impl History {
    pub(crate) fn new(map: &HeightMap) -> History {
        let [across, along] = map.grid.cells.map(|cells| cells.div_ceil(TILE));
        History { strides: Vec::new(), base: map.clone(), at: 0, dirty: vec![false; across * along], across }
    }

    /// Marks the tiles of these columns and rows: their cells may change.
    pub(crate) fn touch(&mut self, columns: &std::ops::Range<usize>, rows: &std::ops::Range<usize>) {
        if columns.is_empty() || rows.is_empty() {
            return;
        }
        for row in rows.start / TILE..=(rows.end - 1) / TILE {
            let start = row * self.across;
            self.dirty[start + columns.start / TILE..=start + (columns.end - 1) / TILE].fill(true);
        }
    }

    /// The stride of `base`.
    pub(crate) fn at(&self) -> usize {
        self.at
    }

    /// Stored strides.
    pub(crate) fn len(&self) -> usize {
        self.strides.len()
    }

    /// Stores the changes of a map since the last stride as those of the next one.
    pub(crate) fn keep(&mut self, map: &HeightMap) {
        let mut changes = Vec::new();
        self.each_dirty(|base, cells| {
            for cell in cells {
                let heights = [base.heights[cell], map.heights[cell]];
                let last = [base.last[cell], map.last[cell]];
                if last[0] != last[1] {
                    changes.push(Change { cell: cell as u32, heights, last });
                    base.heights[cell] = heights[1];
                    base.last[cell] = last[1];
                }
            }
        });
        changes.shrink_to_fit();
        self.strides.push(changes);
        self.at += 1;
    }

    /// Puts a map into the state of a stride.
    pub(crate) fn show(&mut self, map: &mut HeightMap, stride: usize) {
        self.each_dirty(|base, cells| {
            map.heights[cells.clone()].copy_from_slice(&base.heights[cells.clone()]);
            map.last[cells.clone()].copy_from_slice(&base.last[cells]);
        });
        while self.at != stride {
            let forward = self.at < stride;
            let which = if forward { self.at } else { self.at - 1 };
            for change in &self.strides[which] {
                let cell = change.cell as usize;
                for own in [&mut *map, &mut self.base] {
                    own.heights[cell] = change.heights[usize::from(forward)];
                    own.last[cell] = change.last[usize::from(forward)];
                }
            }
            self.at = if forward { self.at + 1 } else { self.at - 1 };
        }
    }

    /// Calls `shown` with `base` and the cells of each marked tile, row by row, and clears the marks.
    fn each_dirty(&mut self, mut shown: impl FnMut(&mut HeightMap, std::ops::Range<usize>)) {
        let [width, height] = self.base.grid.cells;
        for tile in 0..self.dirty.len() {
            if !std::mem::replace(&mut self.dirty[tile], false) {
                continue;
            }
            let [column, row] = [tile % self.across * TILE, tile / self.across * TILE];
            for row in row..(row + TILE).min(height) {
                let start = row * width;
                shown(&mut self.base, start + column..start + (column + TILE).min(width));
            }
        }
    }

    /// Memory of the stored changes, bytes.
    pub(crate) fn bytes(&self) -> usize {
        self.strides.iter().map(|all| all.len() * size_of::<Change>()).sum()
    }
}
