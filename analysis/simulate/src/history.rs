//! The states of a map after any move, in both directions.
//!
//! Every [`STRIDE`] moves it is kept what has changed since the last time, and every [`KEY`] times the whole map. From the
//! whole map before a place, the changes up to it are put in; from there, at most so many moves are made again.

use fearless_simd::{Simd, SimdBase, SimdFrom, SimdMask, dispatch, u32x8};

use crate::hollows::Spaces;
use crate::map::{HeightMap, LANES, TILE};
use crate::surface::level;

/// Moves from one place to the next that can be gone to at once.
pub(crate) const STRIDE: usize = 5_000;

/// From one whole map to the next, so many strides.
const KEY: usize = 32;

/// Cells of a row that are looked at together: most of them have not changed.
const GROUP: usize = 2 * LANES;

/// Whether any of these moves is after another, and whether all are.
#[inline(always)]
fn after<S: Simd>(simd: S, moves: &[u32; GROUP], before: u32) -> [bool; 2] {
    let (halves, _) = moves.as_chunks::<LANES>();
    let mut is_after = [false, true];
    for half in halves {
        let own = u32x8::simd_from(simd, *half).simd_gt(before);
        is_after = [is_after[0] | own.any_true(), is_after[1] & own.all_true()];
    }
    is_after
}

/// Changes of a stride.
#[derive(Clone, Debug, Default)]
struct Changes {
    /// First cell and how many behind each other have changed.
    runs: Vec<(u32, u16)>,
    /// Their heights.
    heights: Vec<f32>,
    /// The moves that cut them last, from the first of the stride.
    last: Vec<u16>,
    /// Hollows of them.
    hollows: Vec<(usize, Spaces)>,
    /// Hollows of other cells, which are as high as before.
    under: Vec<(usize, Spaces)>,
}

impl Changes {
    /// Adds the cells of a part of a row that moves of the stride have cut.
    #[inline(always)]
    fn add<S: Simd>(&mut self, simd: S, map: &HeightMap, cells: std::ops::Range<usize>, before: usize) {
        let before = before as u32;
        if !map.hollows.is_empty() {
            let under = map.hollows.range(cells.clone());
            let under = under.filter(|(cell, own)| own.last > before && map.last[*cell] <= before);
            self.under.extend(under.map(|(cell, own)| (cell, own.clone())));
        }
        let (groups, rest) = map.last[cells.clone()].as_chunks();
        let mut first = cells.start;
        for group in groups {
            match after(simd, group, before) {
                [false, _] => {}
                [true, true] => self.add_run(first..first + GROUP),
                [true, false] => self.add_group(group, first, before),
            }
            first += GROUP;
        }
        self.add_group(rest, first, before);
    }

    /// Adds the runs of a group from a cell on, of which some cells were cut.
    fn add_group(&mut self, mut group: &[u32], mut first: usize, before: u32) {
        while let Some(skipped) = group.iter().position(|last| *last > before) {
            (group, first) = (&group[skipped..], first + skipped);
            let count = group.iter().position(|last| *last <= before).unwrap_or(group.len());
            self.add_run(first..first + count);
            (group, first) = (&group[count..], first + count);
        }
    }

    /// Adds a run, to the run before where it goes on.
    fn add_run(&mut self, cells: std::ops::Range<usize>) {
        let (first, count) = (cells.start as u32, cells.len() as u16);
        match self.runs.last_mut() {
            Some((run, length))
                if *run + u32::from(*length) == first && length.checked_add(count).is_some() =>
            {
                *length += count;
            }
            _ => self.runs.push((first, count)),
        }
    }

    /// Copies the cells of the runs, when all runs are known.
    #[inline(always)]
    fn copy_cells(&mut self, map: &HeightMap, before: usize) {
        let before = before as u32;
        self.runs.shrink_to_fit();
        let count = self.runs.iter().map(|(_, count)| usize::from(*count)).sum();
        self.heights.reserve_exact(count);
        self.last.reserve_exact(count);
        for (first, count) in &self.runs {
            let cells = *first as usize..*first as usize + usize::from(*count);
            if !map.hollows.is_empty() {
                let hollows = map.hollows.range(cells.clone());
                self.hollows.extend(hollows.map(|(cell, own)| (cell, own.clone())));
            }
            self.heights.extend_from_slice(&map.heights[cells.clone()]);
            self.last.extend(map.last[cells].iter().map(|last| (last - before - 1) as u16));
        }
    }

    /// Puts them into a map; `before` moves were made before the stride.
    #[inline(always)]
    fn put_into(&self, map: &mut HeightMap, before: usize) {
        let mut at = 0;
        let mut hollows = self.hollows.iter().peekable();
        for (first, count) in &self.runs {
            let (first, count) = (*first as usize, usize::from(*count));
            if !map.hollows.is_empty() || !self.hollows.is_empty() {
                let own =
                    std::iter::from_fn(|| hollows.next_if(|(cell, _)| (first..first + count).contains(cell)));
                map.hollows.put_all(first..first + count, own.map(|(cell, own)| (*cell, own)));
            }
            map.heights[first..first + count].copy_from_slice(&self.heights[at..at + count]);
            let last = map.last[first..first + count].iter_mut().zip(&self.last[at..at + count]);
            last.for_each(|(own, last)| *own = (before + usize::from(*last) + 1) as u32);
            at += count;
        }
        self.under.iter().for_each(|(cell, own)| map.hollows.put(*cell, own.clone()));
    }

    fn bytes(&self) -> usize {
        size_of::<(u32, u16)>() * self.runs.len()
            + 4 * self.heights.len()
            + 2 * self.last.len()
            + self.hollows.iter().chain(&self.under).map(|(_, own)| own.bytes()).sum::<usize>()
    }
}

/// What has changed in a map from stride to stride.
#[derive(Clone, Debug)]
pub(crate) struct History {
    strides: Vec<Changes>,
    /// The map before strides 0, [`KEY`], …
    keys: Vec<HeightMap>,
    /// The map at the last of these places that is not behind the one that is shown.
    base: HeightMap,
    /// That place, in strides from the start; `None` after moves have been made, with which the map does not keep up.
    at: Option<usize>,
    /// Tiles that may have changed since that place.
    dirty: Vec<bool>,
    /// Tiles along X.
    across: usize,
    /// Rows and columns of the tiles marked last: most moves stay in the tiles of the move before.
    marked: [std::ops::Range<usize>; 2],
}

/// [`History::marked`] where no tiles are marked.
const NONE: [std::ops::Range<usize>; 2] = [0..0, 0..0];

impl History {
    pub(crate) fn new(map: &HeightMap) -> History {
        let [across, along] = map.grid.cells.map(|cells| cells.div_ceil(TILE));
        History {
            strides: Vec::new(),
            keys: vec![map.clone()],
            base: map.clone(),
            at: Some(0),
            dirty: vec![false; across * along],
            across,
            marked: NONE,
        }
    }

    /// Cells of these columns and rows may change.
    #[inline(always)]
    pub(crate) fn touch(&mut self, columns: &std::ops::Range<usize>, rows: &std::ops::Range<usize>) {
        let is_in = |own: &std::ops::Range<usize>, all: &std::ops::Range<usize>| {
            own.start >= all.start && own.end <= all.end
        };
        if !(is_in(rows, &self.marked[0]) && is_in(columns, &self.marked[1])) {
            self.mark(columns, rows);
        }
    }

    #[cold]
    fn mark(&mut self, columns: &std::ops::Range<usize>, rows: &std::ops::Range<usize>) {
        if columns.is_empty() || rows.is_empty() {
            return;
        }
        let [rows, columns] = [rows, columns].map(|own| own.start / TILE..own.end.div_ceil(TILE));
        // Whole groups of cells may go beyond the last tile.
        let marked = columns.start..columns.end.min(self.across);
        for row in rows.clone() {
            self.dirty[row * self.across..][marked.clone()].fill(true);
        }
        self.marked = [rows, columns].map(|own| own.start * TILE..own.end * TILE);
    }

    /// The stride that is shown, where nothing has been kept since.
    pub(crate) fn at(&self) -> Option<usize> {
        self.at
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.strides.len()
    }

    /// Keeps the state of a map as that of the next stride.
    pub(crate) fn keep(&mut self, map: &HeightMap) {
        dispatch!(level(), simd => self.keep_by(simd, map));
    }

    #[inline(always)]
    fn keep_by<S: Simd>(&mut self, simd: S, map: &HeightMap) {
        let mut changes = Changes::default();
        let before = self.strides.len() * STRIDE;
        self.each_dirty(|_, cells| changes.add(simd, map, cells, before));
        changes.copy_cells(map, before);
        self.strides.push(changes);
        self.at = None;
        if self.strides.len().is_multiple_of(KEY) {
            self.keys.push(map.clone());
        }
    }

    /// Puts a map into the state of a stride.
    pub(crate) fn show(&mut self, map: &mut HeightMap, stride: usize) {
        let key = stride / KEY;
        let near = self.at.filter(|at| (key * KEY..=stride).contains(at));
        match near {
            Some(_) => self.each_dirty(|base, cells| {
                map.heights[cells.clone()].copy_from_slice(&base.heights[cells.clone()]);
                map.last[cells.clone()].copy_from_slice(&base.last[cells.clone()]);
                map.hollows.put_all(cells.clone(), base.hollows.range(cells));
            }),
            None => {
                self.base.clone_from(&self.keys[key]);
                self.dirty.fill(false);
                self.marked = NONE;
            }
        }
        for at in near.unwrap_or(key * KEY)..stride {
            self.strides[at].put_into(&mut self.base, at * STRIDE);
            if near.is_some() {
                self.strides[at].put_into(map, at * STRIDE);
            }
        }
        if near.is_none() {
            map.clone_from(&self.base);
        }
        self.at = Some(stride);
    }

    /// Shows the cells of tiles that may have changed, row by row; after that none may.
    #[inline(always)]
    fn each_dirty(&mut self, mut shown: impl FnMut(&mut HeightMap, std::ops::Range<usize>)) {
        let (grid, [width, height]) = (self.base.grid, self.base.grid.cells);
        self.marked = NONE;
        for tile in 0..self.dirty.len() {
            if !std::mem::replace(&mut self.dirty[tile], false) {
                continue;
            }
            let [column, row] = [tile % self.across * TILE, tile / self.across * TILE];
            for row in row..(row + TILE).min(height) {
                let start = grid.index([0, row]);
                shown(&mut self.base, start + column..start + (column + TILE).min(width));
            }
        }
    }

    /// Bytes that it takes.
    pub(crate) fn bytes(&self) -> usize {
        let map = self.base.grid.len() * (size_of::<f32>() + size_of::<u32>());
        self.strides.iter().map(Changes::bytes).sum::<usize>() + map * (self.keys.len() + 1)
    }
}
