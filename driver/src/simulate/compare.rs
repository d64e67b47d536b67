//! The parts that two programs make of one raw part, held against each other: a judgement of a translation that shares
//! nothing with the comparison of events; and a part against the one that it should be.
//!
//! At a wall, a thousandth of a millimetre decides on which side of it the centre of a cell is. So a height is another one
//! only where it is beyond those of all cells around: walls are compared to the width of a cell. Volumes are of each cell.

use ncc_simulate::HeightMap;

/// What lies between two parts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Between {
    /// What the first has and the second has not, mm³.
    pub more: f64,
    /// What the second has and the first has not, mm³.
    pub less: f64,
    /// Where the first stands highest above the second: X Y in mm, and by how much, mm.
    pub highest: Option<([f64; 2], f64)>,
    /// Where it lies deepest below.
    pub deepest: Option<([f64; 2], f64)>,
}

impl Between {
    /// Compares two maps of one grid. Where a map has no material, its height is `floor`.
    ///
    /// # Panics
    /// Where the grids differ.
    pub fn of(one: &HeightMap, other: &HeightMap, floor: f32) -> Between {
        assert_eq!(one.grid, other.grid, "parts on two grids");
        let mut between = Between::default();
        let width = one.grid.cells[0];
        let area = one.grid.cell * one.grid.cell;
        for (n, (a, b)) in one.heights.iter().zip(&other.heights).enumerate() {
            let by = f64::from(a.max(floor)) - f64::from(b.max(floor));
            let place = || [one.grid.centre(0, n % width), one.grid.centre(1, n / width)];
            if by == 0.0 {
                continue;
            }
            let [low, high] = around(other, n, floor);
            let own = a.max(floor);
            if by > 0.0 {
                between.more += by * area;
                let above = f64::from(own - high).max(0.0);
                if above > 0.0 && between.highest.is_none_or(|(_, most)| above > most) {
                    between.highest = Some((place(), above));
                }
            } else {
                between.less -= by * area;
                let below = f64::from(low - own).max(0.0);
                if below > 0.0 && between.deepest.is_none_or(|(_, most)| below > most) {
                    between.deepest = Some((place(), below));
                }
            }
        }
        between
    }

    /// Whether no height differs by more than so much, mm.
    pub fn is_within(&self, tolerance: f64) -> bool {
        [self.highest, self.deepest].into_iter().flatten().all(|(_, by)| by <= tolerance)
    }
}

/// The least and the greatest height of a cell and those around it.
fn around(map: &HeightMap, cell: usize, floor: f32) -> [f32; 2] {
    let [width, height] = map.grid.cells;
    let [column, row] = [cell % width, cell / width];
    let mut range = [f32::INFINITY, f32::NEG_INFINITY];
    for j in row.saturating_sub(1)..(row + 2).min(height) {
        for i in column.saturating_sub(1)..(column + 2).min(width) {
            let own = map.heights[j * width + i].max(floor);
            range = [range[0].min(own), range[1].max(own)];
        }
    }
    range
}

#[cfg(test)]
mod tests {
    use super::*;
    use ncc_simulate::Grid;

    #[test]
    fn a_wall_may_be_a_cell_away_and_a_floor_nowhere() {
        let flat = || HeightMap::flat(Grid::over([0.0; 2], [10.0; 2], 10), 0.0);
        // Low from a column on.
        let step = |from: usize, low: f32| {
            let mut map = flat();
            for (n, height) in map.heights.iter_mut().enumerate() {
                *height = if n % 10 >= from { low } else { 0.0 };
            }
            map
        };
        let between = Between::of(&step(4, -5.0), &step(5, -5.0), -10.0);
        assert!(between.is_within(0.0) && (between.more, between.less) == (0.0, 50.0), "{between:?}");
        assert!(!Between::of(&step(3, -5.0), &step(5, -5.0), -10.0).is_within(1.0));
        let deeper = Between::of(&step(4, -5.1), &step(4, -5.0), -10.0);
        assert!(!deeper.is_within(0.09) && deeper.is_within(0.11), "{deeper:?}");
        assert!(!Between::of(&step(4, -5.0), &flat(), -10.0).is_within(1.0));
    }
}
