//! Hollows: where there is no material under the upper surface of a part, cell by cell.
//!
//! ```text
//!   ███  ███  <- the height of the cell        of the cells beside the neck: height 0, a hollow from -12 to -6
//!   ███  ███
//!   █      █  <- what the disc of a T-slot cutter has taken
//!   ████████
//! ```

use std::collections::BTreeMap;
use std::ops::Range;

/// The hollows of a cell.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Spaces {
    /// The lower and the upper end of each, the lowest first. They do not touch each other, and none reaches the height of the
    /// cell.
    all: Vec<[f32; 2]>,
    /// Number of the move that was the last to change them, from 1.
    pub(crate) last: u32,
}

impl Spaces {
    /// Bytes that they take.
    pub(crate) fn bytes(&self) -> usize {
        size_of::<(usize, Spaces)>() + size_of_val(self.all.as_slice())
    }
}

/// The hollows of a map: of few of its cells. Heights in mm.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hollows {
    cells: BTreeMap<usize, Spaces>,
}

impl Hollows {
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// Those of a cell: where they begin and end, the lowest first.
    pub fn of(&self, cell: usize) -> &[[f32; 2]] {
        self.cells.get(&cell).map_or(&[], |own| &own.all)
    }

    /// The move that was the last to change those of a cell, from 1; 0 where there are none.
    pub fn last(&self, cell: usize) -> u32 {
        self.cells.get(&cell).map_or(0, |own| own.last)
    }

    /// Cells with hollows, and these.
    pub fn iter(&self) -> impl Iterator<Item = (usize, &[[f32; 2]])> {
        self.cells.iter().map(|(cell, own)| (*cell, own.all.as_slice()))
    }

    /// Takes the material of a cell between two heights, by a move; gives the cell's height after that, and how much was taken.
    pub(crate) fn take(&mut self, cell: usize, top: f32, [from, to]: [f32; 2], number: u32) -> (f32, f32) {
        let to = to.min(top);
        if from >= to {
            return (top, 0.0);
        }
        let before = self.of(cell);
        let had = length(before);
        let (mut low, mut high) = (from, to);
        let mut own: Vec<[f32; 2]> = Vec::with_capacity(before.len() + 1);
        for hollow in before {
            // Those that it touches become one with it.
            match hollow[0] <= high && hollow[1] >= low {
                true => (low, high) = (low.min(hollow[0]), high.max(hollow[1])),
                false => own.push(*hollow),
            }
        }
        let new = if high >= top { low } else { top };
        if high < top {
            let at = own.partition_point(|hollow| hollow[0] < low);
            own.insert(at, [low, high]);
        }
        let taken = (top - had) - (new - length(&own));
        if own != before {
            self.put(cell, Spaces { all: own, last: number });
        }
        (new, taken)
    }

    /// How much material a cell has between two heights.
    pub(crate) fn material(&self, cell: usize, top: f32, [from, to]: [f32; 2]) -> f32 {
        let within = |[low, high]: [f32; 2]| (high.min(to) - low.max(from)).max(0.0);
        (to.min(top) - from).max(0.0) - self.of(cell).iter().map(|own| within(*own)).sum::<f32>()
    }

    /// Puts the hollows of some cells in the place of those that were there.
    pub(crate) fn put_all<'h>(
        &mut self,
        cells: Range<usize>,
        all: impl Iterator<Item = (usize, &'h Spaces)>,
    ) {
        if !self.cells.is_empty() {
            let had: Vec<usize> = self.cells.range(cells).map(|(cell, _)| *cell).collect();
            had.iter().for_each(|cell| drop(self.cells.remove(cell)));
        }
        all.for_each(|(cell, own)| self.put(cell, own.clone()));
    }

    /// Those of some cells.
    pub(crate) fn range(&self, cells: Range<usize>) -> impl Iterator<Item = (usize, &Spaces)> {
        self.cells.range(cells).map(|(cell, own)| (*cell, own))
    }

    /// The sum of the parts of all hollows above a level, along Z, mm.
    pub(crate) fn length_above(&self, level: f64) -> f64 {
        let above = |[low, high]: &[f32; 2]| (f64::from(*high) - f64::from(*low).max(level)).max(0.0);
        // Not `sum`, which makes nothing less than nothing of none.
        self.cells.values().flat_map(|own| &own.all).map(above).fold(0.0, |all, own| all + own)
    }

    pub(crate) fn put(&mut self, cell: usize, own: Spaces) {
        match own.all.is_empty() {
            true => drop(self.cells.remove(&cell)),
            false => drop(self.cells.insert(cell, own)),
        }
    }
}

/// The parts of the first intervals that are in none of the second ones. Intervals of a list do not touch, and the lowest is first.
pub fn without(all: &[[f32; 2]], other: &[[f32; 2]]) -> Vec<[f32; 2]> {
    let mut left = Vec::new();
    for [low, high] in all {
        let mut from = *low;
        for [begin, end] in other.iter().filter(|[begin, end]| begin < high && end > low) {
            if *begin > from {
                left.push([from, *begin]);
            }
            from = from.max(*end);
        }
        if from < *high {
            left.push([from, *high]);
        }
    }
    left
}

fn length(all: &[[f32; 2]]) -> f32 {
    all.iter().map(|[low, high]| high - low).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_taken_leaves_hollows_or_lowers_the_cell() {
        let mut hollows = Hollows::default();
        assert_eq!(hollows.take(7, 0.0, [-6.0, -4.0], 1), (0.0, 2.0));
        assert_eq!(hollows.take(7, 0.0, [-9.0, -8.0], 2), (0.0, 1.0));
        assert_eq!((hollows.of(7), hollows.last(7)), ([[-9.0, -8.0], [-6.0, -4.0]].as_slice(), 2));
        // Twice takes nothing more; between them both become one.
        assert_eq!(hollows.take(7, 0.0, [-6.0, -5.0], 3), (0.0, 0.0));
        assert_eq!(hollows.take(7, 0.0, [-8.0, -5.5], 4), (0.0, 2.0));
        assert_eq!((hollows.of(7), hollows.last(7)), ([[-9.0, -4.0]].as_slice(), 4));
        assert_eq!(hollows.material(7, 0.0, [-10.0, 5.0]), 5.0);
        // From above into the hollow: the cell is as low as that.
        assert_eq!(hollows.take(7, 0.0, [-4.5, f32::INFINITY], 5), (-9.0, 4.0));
        assert!(hollows.is_empty());
        assert_eq!(hollows.take(7, -9.0, [-5.0, f32::INFINITY], 6), (-9.0, 0.0));
    }
}
