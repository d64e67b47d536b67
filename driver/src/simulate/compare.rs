//! The parts that two programs make of one raw part, held against each other: a judgement of a translation that shares
//! nothing with the comparison of events; and a part against the one that it should be.
//!
//! At a wall, a thousandth of a millimetre decides on which side of it the centre of a cell is. So a height is another one
//! only where it is beyond those of all cells around: walls are compared to the width of a cell. Volumes are of each cell.

use ncc_simulate::{HeightMap, without};

/// Heights of two programs' parts that differ by no more are the same, mm, where nobody states another tolerance.
pub const TOLERANCE: f64 = 0.001;

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
        let area = one.grid.cell * one.grid.cell;
        if !(one.hollows.is_empty() && other.hollows.is_empty()) {
            return Between::with_hollows(one, other, floor);
        }
        for (n, (a, b)) in one.heights.iter().zip(&other.heights).enumerate() {
            let by = f64::from(a.max(floor)) - f64::from(b.max(floor));
            if by == 0.0 {
                continue;
            }
            let [low, high] = around(other, n, floor);
            let own = a.max(floor);
            if by > 0.0 {
                between.more += by * area;
                let above = f64::from(own - high).max(0.0);
                if above > 0.0 && between.highest.is_none_or(|(_, most)| above > most) {
                    between.highest = Some((one.grid.centre_of(n), above));
                }
            } else {
                between.less -= by * area;
                let below = f64::from(low - own).max(0.0);
                if below > 0.0 && between.deepest.is_none_or(|(_, most)| below > most) {
                    between.deepest = Some((one.grid.centre_of(n), below));
                }
            }
        }
        between
    }

    /// As [`Between::of`], of parts of which one has hollows: what lies in one cell must be of none of those around.
    fn with_hollows(one: &HeightMap, other: &HeightMap, floor: f32) -> Between {
        let mut between = Between::default();
        let area = one.grid.cell * one.grid.cell;
        let length = |all: &[[f32; 2]]| all.iter().map(|[low, high]| f64::from(high - low)).sum::<f64>();
        for cell in 0..one.heights.len() {
            let [own, its] = [one, other].map(|map| map.material(cell, floor));
            if own == its {
                continue;
            }
            let [more, less] = [without(&own, &its), without(&its, &own)];
            between.more += length(&more) * area;
            between.less += length(&less) * area;
            for (mut left, most, is_there) in
                [(more, &mut between.highest, true), (less, &mut between.deepest, false)]
            {
                for near in beside(other, cell) {
                    let material = other.material(near, floor);
                    // What the first has too much no cell around may have; what it lacks each of them must have.
                    left = match is_there {
                        true => without(&left, &material),
                        false => without(&left, &without(&left, &material)),
                    };
                }
                let longest = left.iter().map(|[low, high]| f64::from(high - low)).fold(0.0, f64::max);
                if longest > 0.0 && most.is_none_or(|(_, most)| longest > most) {
                    *most = Some((one.grid.centre_of(cell), longest));
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
    beside(map, cell).fold([f32::INFINITY, f32::NEG_INFINITY], |range, near| {
        let own = map.heights[near].max(floor);
        [range[0].min(own), range[1].max(own)]
    })
}

/// A cell and those around it.
fn beside(map: &HeightMap, cell: usize) -> impl Iterator<Item = usize> {
    let (grid, [width, height]) = (map.grid, map.grid.cells);
    let [column, row] = map.grid.place(cell);
    let columns = column.saturating_sub(1)..(column + 2).min(width);
    (row.saturating_sub(1)..(row + 2).min(height))
        .flat_map(move |row| columns.clone().map(move |column| grid.index([column, row])))
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
            for row in map.grid.rows() {
                map.heights[row][from..].fill(low);
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

    #[test]
    fn undercuts_are_compared_as_heights_are() {
        use ncc_simulate::{Cutter, Move, Setup, Shape, Simulation, Stock, Tool, Way};
        // A disc 2 mm thick that comes in from the left, so far and so high.
        let under = |to: f64, z: f64| {
            let cutter = Cutter::new(&Shape::TSlot, 4.0, 2.0).expect("a tool");
            let tool =
                Tool { number: 1, cutter, flute: Some(2.0), shank: None, holder: None, guessed: false };
            let mut simulation = Simulation::new(Setup {
                stock: Stock::Block { low: [0.0, 0.0, -10.0], high: [10.0, 10.0, 0.0] },
                guessed: false,
                cells: 10,
                tools: vec![tool],
                fixtures: Vec::new(),
                table: None,
                start: [-5.0, 5.0, z],
                tilts: Vec::new(),
            });
            simulation.push(Move {
                way: Way::Feed,
                end: [to, 5.0, z],
                tool: 0,
                tilt: 0,
                turns: true,
                time: 0.0,
                line: 0,
            });
            simulation.map().clone()
        };
        let (one, same) = (under(5.0, -6.0), under(5.0, -6.0));
        assert!(Between::of(&one, &same, -10.0).is_within(0.0));
        let farther = Between::of(&under(6.0, -6.0), &one, -10.0);
        assert!(farther.is_within(0.0) && farther.more == 0.0 && farther.less > 0.0, "{farther:?}");
        let much_farther = Between::of(&under(8.0, -6.0), &one, -10.0);
        assert!(!much_farther.is_within(1.9) && much_farther.highest.is_none(), "{much_farther:?}");
        let higher = Between::of(&under(5.0, -5.9), &one, -10.0);
        assert!(!higher.is_within(0.09) && higher.is_within(0.11), "{higher:?}");
        assert!(!Between::of(&HeightMap::flat(one.grid, 0.0), &one, -10.0).is_within(1.9));
    }
}
