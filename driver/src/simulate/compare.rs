//! The parts that two programs make of one raw part, held against each other: a judgement of a translation that shares
//! nothing with the comparison of events; and a part against the one that it should be.

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
            let above = f64::from(a.max(floor)) - f64::from(b.max(floor));
            let place = || [one.grid.centre(0, n % width), one.grid.centre(1, n / width)];
            if above > 0.0 {
                between.more += above * area;
                if between.highest.is_none_or(|(_, most)| above > most) {
                    between.highest = Some((place(), above));
                }
            } else if above < 0.0 {
                between.less -= above * area;
                if between.deepest.is_none_or(|(_, most)| -above > most) {
                    between.deepest = Some((place(), -above));
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
