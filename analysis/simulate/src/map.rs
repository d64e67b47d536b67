//! Heights of material over a grid of square cells.

use crate::hollows::Hollows;

/// Where the cells of a map are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// The corner with the least X and Y, mm.
    pub low: [f64; 2],
    /// Side of a cell, mm; above zero.
    pub cell: f64,
    /// Cells along X and along Y.
    pub cells: [usize; 2],
    /// Cells a mm.
    per_mm: f64,
    /// Cells of a map from the begin of a row to that of the next.
    pitch: usize,
}

impl Grid {
    /// Square cells over a rectangle, so many along its longer side at most.
    ///
    /// ```text
    /// 100 × 60 mm, 1024 cells    cells of 0.0977 mm, 1024 × 615
    /// ```
    pub fn over(low: [f64; 2], high: [f64; 2], most: usize) -> Grid {
        let sides = [0, 1].map(|axis| (high[axis] - low[axis]).max(1e-6));
        let cell = sides[0].max(sides[1]) / most.max(1) as f64;
        let cells = sides.map(|side| ((side / cell - 1e-9).ceil() as usize).clamp(1, most.max(1)));
        Grid { low, cell, cells, per_mm: 1.0 / cell, pitch: pitch(cells[0]) }
    }

    /// The index in a map of the cell in a column and a row.
    #[inline(always)]
    pub fn index(&self, [column, row]: [usize; 2]) -> usize {
        row * self.pitch + column
    }

    /// Column and row of the cell with this index in a map.
    #[inline]
    pub fn place(&self, cell: usize) -> [usize; 2] {
        [cell % self.pitch, cell / self.pitch]
    }

    /// Centre of the cell with this index in a map, X Y in mm.
    pub fn centre_of(&self, cell: usize) -> [f64; 2] {
        let [column, row] = self.place(cell);
        [self.centre(0, column), self.centre(1, row)]
    }

    /// Indices in a map of the cells of each row, the row of the least Y first.
    pub fn rows(&self) -> impl Iterator<Item = std::ops::Range<usize>> + use<> {
        let Grid { cells: [columns, rows], pitch, .. } = *self;
        (0..rows).map(move |row| row * pitch..row * pitch + columns)
    }

    /// Cells of a map from the begin of a row to that of the next.
    #[inline(always)]
    pub(crate) fn pitch(&self) -> usize {
        self.pitch
    }

    /// Centre of a cell along an axis, mm.
    #[inline]
    pub fn centre(&self, axis: usize, n: usize) -> f64 {
        // There are never so many that they need 64 bits, of which many processors cannot make a number at once.
        self.low[axis] + (f64::from(n as i32) + 0.5) * self.cell
    }

    /// The cells of which the centre lies between two places of an axis; empty where none does.
    #[inline(always)]
    pub(crate) fn between(&self, axis: usize, low: f64, high: f64) -> std::ops::Range<usize> {
        // Integers round down: `f64::floor` is a call on some machines, and so is a number without a sign. One cell more, so
        // that none is below zero.
        let most = self.cells[axis] as f64 + 1.0;
        let place = |at: f64| {
            let place = (at - self.low[axis]) * self.per_mm + 0.5;
            if place > 0.0 { if place < most { place } else { most } } else { 0.0 }
        };
        let (low, high) = (place(low), place(high));
        let first = low as i32;
        let first = if f64::from(first) < low { first + 1 } else { first }.max(1) - 1;
        let behind = (high as i32).min(self.cells[axis] as i32);
        first.min(behind) as usize..behind as usize
    }

    /// The same in fewer steps. A cell whose centre is at an end may be one of them or not.
    #[inline(always)]
    pub(crate) fn about(&self, axis: usize, low: f64, high: f64) -> std::ops::Range<usize> {
        /// 1.5 · 2⁵²: numbers of this size are whole. A sum with it has the other number, rounded, in its low bits.
        const WHOLE: f64 = 6_755_399_441_055_744.0;
        let most = f64::from(self.cells[axis] as i32);
        let nearest = |at: f64| {
            let place = (at - self.low[axis]) * self.per_mm;
            let place = if place > 0.0 { place } else { 0.0 };
            let place = if place < most { place } else { most };
            (place + WHOLE).to_bits() as u32 as usize
        };
        nearest(low)..nearest(high)
    }

    /// The cell in which a place lies.
    pub fn cell_at(&self, x: f64, y: f64) -> Option<[usize; 2]> {
        let cell = |axis: usize, at: f64| {
            let n = ((at - self.low[axis]) / self.cell).floor();
            (n >= 0.0 && n < self.cells[axis] as f64).then_some(n as usize)
        };
        Some([cell(0, x)?, cell(1, y)?])
    }

    /// How many numbers a map holds: those of the cells, and of what lies between their rows.
    pub fn len(&self) -> usize {
        self.pitch * self.cells[1]
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Cells of a group. The widest vectors used hold eight numbers (AVX2); narrower ones take two or more instructions.
pub(crate) const LANES: usize = 8;

/// Cells from row to row, where so many are used: eight of any of them are in one row. Rows begin an odd number of
/// cache lines apart. Rows of 1024 cells would all share one of 64 sets of lines, which holds eight: cutting takes up to a half longer.
fn pitch(cells: usize) -> usize {
    /// Cells of a cache line of 64 bytes.
    const LINE: usize = 16;
    (cells + LANES - 1).next_multiple_of(LINE) | LINE
}

/// Side of the tiles of a map by which changes are noted, cells.
pub(crate) const TILE: usize = 64;

/// How high material stands in each cell, and which move was the last to cut there.
#[derive(Debug, PartialEq)]
pub struct HeightMap {
    /// Where its cells are.
    pub grid: Grid,
    /// Heights, mm, in workpiece coordinates, by [`Grid::index`]. [`HeightMap::NOTHING`] where there is no material, and
    /// between the rows of cells.
    pub heights: Vec<f32>,
    /// Number of the move that made the height, counted from 1; 0 where none did.
    pub last: Vec<u32>,
    /// Spaces without material below these heights.
    pub hollows: Hollows,
}

impl Clone for HeightMap {
    fn clone(&self) -> HeightMap {
        HeightMap {
            grid: self.grid,
            heights: self.heights.clone(),
            last: self.last.clone(),
            hollows: self.hollows.clone(),
        }
    }

    /// Into the memory that is there: maps are large.
    fn clone_from(&mut self, other: &HeightMap) {
        self.grid = other.grid;
        self.heights.clone_from(&other.heights);
        self.last.clone_from(&other.last);
        self.hollows.clone_from(&other.hollows);
    }
}

impl HeightMap {
    /// The height where there is no material at all.
    pub const NOTHING: f32 = f32::NEG_INFINITY;

    /// A map with one height.
    pub fn flat(grid: Grid, height: f32) -> HeightMap {
        let mut heights = vec![HeightMap::NOTHING; grid.len()];
        grid.rows().for_each(|row| heights[row].fill(height));
        HeightMap { grid, heights, last: vec![0; grid.len()], hollows: Hollows::default() }
    }

    /// The height at a place; `None` outside.
    pub fn height_at(&self, x: f64, y: f64) -> Option<f32> {
        self.heights.get(self.grid.index(self.grid.cell_at(x, y)?)).copied()
    }

    /// The greatest height; [`HeightMap::NOTHING`] of a map without material.
    pub fn highest(&self) -> f32 {
        self.heights.iter().copied().fold(HeightMap::NOTHING, f32::max)
    }

    /// The material of a cell above a level: from and to which heights, the lowest first.
    pub fn material(&self, cell: usize, level: f32) -> Vec<[f32; 2]> {
        let (mut all, mut from) = (Vec::new(), level);
        for [low, high] in self.hollows.of(cell) {
            if *low > from {
                all.push([from, *low]);
            }
            from = from.max(*high);
        }
        if self.heights[cell] > from {
            all.push([from, self.heights[cell]]);
        }
        all
    }

    /// Volume of the hollows above a level, mm³.
    pub fn hollows_above(&self, level: f64) -> f64 {
        self.hollows.length_above(level) * self.grid.cell * self.grid.cell
    }

    /// Volume of the material above a level, mm³.
    pub fn volume_above(&self, level: f64) -> f64 {
        let area = self.grid.cell * self.grid.cell;
        let columns = self.heights.iter().map(|height| (f64::from(*height) - level).max(0.0)).sum::<f64>();
        (columns - self.hollows.length_above(level)) * area
    }
}
