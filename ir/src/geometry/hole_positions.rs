//! Places of a pattern's holes in the plane.
//!
//! One definition for execution, which knows where everything is, and for passes, which know it as
//! far as the program says it. Places of circles and of rows at an angle pass through floats, and
//! are rounded to a nano.

use crate::canon::{Axis, Plane};
use crate::expr::Expr;
use crate::expr::num::Nanos;
use crate::geometry;
use crate::program::Coord;
use crate::program::cycle::{Along, First, Pattern, Row};

/// What must be known to say where holes are.
pub trait Here {
    /// What is reported if it is not.
    type Unknown;

    /// Tool position in the plane: first axis, second axis.
    ///
    /// # Errors
    /// It is not known.
    fn at(&self, side: usize) -> Result<Nanos, Self::Unknown>;

    /// Where a word puts an axis of the plane.
    ///
    /// # Errors
    /// It is not known.
    fn word(&self, word: &Coord, side: usize) -> Result<Nanos, Self::Unknown>;

    /// Where a word puts an axis of the plane that stood at `last`.
    ///
    /// # Errors
    /// It is not known.
    fn after(&self, word: &Coord, side: usize, last: Nanos) -> Result<Nanos, Self::Unknown>;

    /// A length or an angle.
    ///
    /// # Errors
    /// It is not known.
    fn value(&self, value: &Expr) -> Result<Nanos, Self::Unknown>;

    /// What is reported of a pattern that has no such place.
    fn out_of_range(&self) -> Self::Unknown;
}

/// The places of a pattern.
#[derive(Clone, Debug, PartialEq)]
pub enum HolePositions {
    /// On a circle.
    Circle {
        /// Its centre.
        centre: [Nanos; 2],
        /// The first hole.
        first: [Nanos; 2],
        /// Degrees from hole to hole.
        step: Nanos,
        /// How many.
        count: u32,
    },
    /// On a line.
    Line {
        /// Where it begins.
        start: [Nanos; 2],
        /// Degrees from the first axis.
        angle: Nanos,
        /// Distance of the first hole.
        offset: Nanos,
        /// From hole to hole.
        pitch: Nanos,
        /// How many.
        count: u32,
    },
    /// In rows.
    Grid {
        /// The first hole.
        start: [Nanos; 2],
        /// Along a row.
        columns: Step,
        /// From row to row.
        rows: Step,
        /// Holes of a row, and rows.
        counts: [u32; 2],
        /// Whether every second row runs backwards.
        serpentine: bool,
    },
    /// One by one.
    List(Vec<[Nanos; 2]>),
}

/// A direction of a grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// Side of the plane, or degrees from its first axis.
    pub along: Result<usize, Nanos>,
    /// Pitch.
    pub pitch: Nanos,
}

impl Step {
    /// The `n`-th step.
    fn times(self, n: u32) -> [Nanos; 2] {
        let way = self.pitch.wrapping_mul(i64::from(n));
        match self.along {
            Ok(0) => [way, 0],
            Ok(_) => [0, way],
            Err(angle) => geometry::polar(way, angle),
        }
    }
}

impl HolePositions {
    /// The places of a pattern in a plane.
    ///
    /// # Errors
    /// Something that must be known is not.
    pub fn from_pattern<H: Here>(
        pattern: &Pattern,
        plane: Plane,
        here: &H,
    ) -> Result<HolePositions, H::Unknown> {
        let (first_axis, second_axis, _) = plane.axes();
        let pair = |words: &[Coord; 2]| Ok([here.word(&words[0], 0)?, here.word(&words[1], 1)?]);
        let or_here = |words: &Option<[Coord; 2]>| match words {
            Some(words) => pair(words),
            None => Ok([here.at(0)?, here.at(1)?]),
        };
        Ok(match pattern {
            Pattern::Circle { centre, first, step, count } => {
                let centre = or_here(centre)?;
                let first = match first {
                    First::At(words) => pair(words)?,
                    First::Polar { radius, angle } => {
                        let [x, y] = geometry::polar(here.value(radius)?, here.value(angle)?);
                        [centre[0].wrapping_add(x), centre[1].wrapping_add(y)]
                    }
                };
                HolePositions::Circle { centre, first, step: here.value(step)?, count: *count }
            }
            Pattern::Line { start, angle, offset, pitch, count } => HolePositions::Line {
                start: or_here(start)?,
                angle: here.value(angle)?,
                offset: here.value(offset)?,
                pitch: here.value(pitch)?,
                count: *count,
            },
            Pattern::Grid { start, columns, rows, serpentine } => {
                let step = |row: &Row| {
                    let along = match &row.along {
                        Along::Axis(axis) if *axis == first_axis => Ok(0),
                        Along::Axis(axis) if *axis == second_axis => Ok(1),
                        Along::Axis(_) => return Err(here.out_of_range()),
                        Along::Angle(angle) => Err(here.value(angle)?),
                    };
                    Ok(Step { along, pitch: here.value(&row.pitch)? })
                };
                if columns.count.checked_mul(rows.count).is_none() {
                    return Err(here.out_of_range());
                }
                HolePositions::Grid {
                    start: or_here(start)?,
                    columns: step(columns)?,
                    rows: step(rows)?,
                    counts: [columns.count, rows.count],
                    serpentine: *serpentine,
                }
            }
            Pattern::List(points) => {
                let mut places: Vec<[Nanos; 2]> = Vec::with_capacity(points.len());
                for point in points {
                    // A pattern lies in its plane.
                    let other = |axis: &Axis| *axis != first_axis && *axis != second_axis;
                    if Axis::ALL.into_iter().filter(other).any(|axis| point.get(axis).is_some()) {
                        return Err(here.out_of_range());
                    }
                    let side = |side: usize, axis: Axis| match (point.get(axis), places.last()) {
                        (None, None) => here.at(side),
                        (None, Some(last)) => Ok(last[side]),
                        (Some(word), None) => here.word(word, side),
                        (Some(word), Some(last)) => here.after(word, side, last[side]),
                    };
                    let place = [side(0, first_axis)?, side(1, second_axis)?];
                    places.push(place);
                }
                HolePositions::List(places)
            }
        })
    }

    /// How many.
    pub fn count(&self) -> u32 {
        match self {
            HolePositions::Circle { count, .. } | HolePositions::Line { count, .. } => *count,
            HolePositions::Grid { counts, .. } => counts[0] * counts[1],
            HolePositions::List(places) => u32::try_from(places.len()).unwrap_or(u32::MAX),
        }
    }

    /// The `k`-th (0 is the first), which must be below [`HolePositions::count`].
    pub fn get(&self, k: u32) -> [Nanos; 2] {
        match self {
            HolePositions::Circle { centre, first, step, .. } => {
                geometry::circle_position(*centre, *first, *step, k)
            }
            HolePositions::Line { start, angle, offset, pitch, .. } => {
                let way = offset.wrapping_add(pitch.wrapping_mul(i64::from(k)));
                let [x, y] = geometry::polar(way, *angle);
                [start[0].wrapping_add(x), start[1].wrapping_add(y)]
            }
            HolePositions::Grid { start, columns, rows, counts, serpentine } => {
                let (c, r) = geometry::grid_position(counts[0], *serpentine, k);
                let (a, b) = (columns.times(c), rows.times(r));
                std::array::from_fn(|i| start[i].wrapping_add(a[i]).wrapping_add(b[i]))
            }
            HolePositions::List(places) => places.get(k as usize).copied().unwrap_or_default(),
        }
    }
}
