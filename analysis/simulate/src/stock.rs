//! Raw parts and fixtures.

use crate::map::{Grid, HeightMap};
use crate::mesh::{Triangle, rasterise};

/// A raw part, in workpiece coordinates.
#[derive(Clone, Debug, PartialEq)]
pub enum Stock {
    /// A block between two corners, X Y Z in mm.
    Block {
        /// The least coordinates.
        low: [f64; 3],
        /// The greatest.
        high: [f64; 3],
    },
    /// A cylinder that stands along Z.
    Cylinder {
        /// Its axis, X Y in mm.
        axis: [f64; 2],
        /// Its radius, mm.
        radius: f64,
        /// Where it begins and ends along Z, mm.
        between: [f64; 2],
    },
    /// A body of triangles; what is under its upper surface counts as material.
    Body(Vec<Triangle>),
}

impl Stock {
    /// The box around it: the least and the greatest coordinates, mm.
    pub fn extent(&self) -> [[f64; 3]; 2] {
        match self {
            Stock::Block { low, high } => [*low, *high],
            Stock::Cylinder { axis, radius, between } => [
                [axis[0] - radius, axis[1] - radius, between[0]],
                [axis[0] + radius, axis[1] + radius, between[1]],
            ],
            Stock::Body(triangles) => extent(triangles),
        }
    }

    /// Its volume, mm³; of triangles, what stands on a grid of so many cells along the longer side.
    pub fn volume(&self, cells: usize) -> f64 {
        match self {
            Stock::Block { low, high } => (0..3).map(|axis| high[axis] - low[axis]).product(),
            Stock::Cylinder { radius, between, .. } => {
                std::f64::consts::PI * radius * radius * (between[1] - between[0])
            }
            Stock::Body(triangles) => self.map(cells).volume_above(extent(triangles)[0][2]),
        }
    }

    /// Its heights, over a grid of so many cells along its longer side.
    pub fn map(&self, cells: usize) -> HeightMap {
        let [low, high] = self.extent();
        let grid = Grid::over([low[0], low[1]], [high[0], high[1]], cells);
        let mut map = HeightMap::flat(grid, HeightMap::NOTHING);
        self.put_on(&mut map);
        map
    }

    /// Raises a map to its upper surface.
    pub fn put_on(&self, map: &mut HeightMap) {
        let grid = map.grid;
        match self {
            Stock::Block { low, high } => {
                let columns = grid.between(0, low[0], high[0]);
                for row in grid.between(1, low[1], high[1]) {
                    raise(map, row, columns.clone(), high[2]);
                }
            }
            Stock::Cylinder { axis, radius, between } => {
                for row in grid.between(1, axis[1] - radius, axis[1] + radius) {
                    let off = grid.centre(1, row) - axis[1];
                    let half = (radius * radius - off * off).max(0.0).sqrt();
                    raise(map, row, grid.between(0, axis[0] - half, axis[0] + half), between[1]);
                }
            }
            Stock::Body(triangles) => rasterise(triangles, map),
        }
    }
}

fn raise(map: &mut HeightMap, row: usize, columns: std::ops::Range<usize>, height: f64) {
    let start = map.grid.index([0, row]);
    for own in &mut map.heights[start + columns.start..start + columns.end] {
        *own = own.max(height as f32);
    }
}

fn extent(triangles: &[Triangle]) -> [[f64; 3]; 2] {
    let mut all = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for at in triangles.iter().flatten() {
        for axis in 0..3 {
            all[0][axis] = all[0][axis].min(f64::from(at[axis]));
            all[1][axis] = all[1][axis].max(f64::from(at[axis]));
        }
    }
    all
}

/// What holds the part: nothing may touch it.
#[derive(Clone, Debug, PartialEq)]
pub struct Fixture {
    /// Its name, as ncc reports it.
    pub name: String,
    /// Its shape, in workpiece coordinates.
    pub shape: Stock,
}

impl Fixture {
    /// The heights of fixtures over one grid with cells of this side; `None` where there are none.
    pub(crate) fn map(all: &[Fixture], cell: f64) -> Option<HeightMap> {
        let boxes: Vec<_> = all.iter().map(|fixture| fixture.shape.extent()).collect();
        let [low, high] = boxes.into_iter().reduce(|[low, high], [own_low, own_high]| {
            [
                std::array::from_fn(|axis| low[axis].min(own_low[axis])),
                std::array::from_fn(|axis| high[axis].max(own_high[axis])),
            ]
        })?;
        // Fixtures may lie far apart; their cells are larger then.
        let side = (high[0] - low[0]).max(high[1] - low[1]);
        let grid =
            Grid::over([low[0], low[1]], [high[0], high[1]], ((side / cell).ceil() as usize).clamp(1, 4096));
        let mut map = HeightMap::flat(grid, HeightMap::NOTHING);
        all.iter().for_each(|fixture| fixture.shape.put_on(&mut map));
        Some(map)
    }
}
