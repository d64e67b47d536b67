//! Lines and grids: holes at equal distances.

use super::decimal::{Decimal, Range};
use crate::geometry;
use crate::num::ONE;

/// A direction in the plane and the distance from hole to hole along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Step {
    /// The axis of the plane, or degrees from the first axis.
    pub(super) along: Result<usize, Decimal>,
    /// The distance; along an axis it has a sign.
    pub(super) pitch: Decimal,
}

impl Step {
    /// How many digits it takes to write.
    pub(super) fn digits(self) -> u32 {
        self.pitch.digits() + self.along.map_or_else(Decimal::digits, |_| 0)
    }

    /// Degrees from the first axis, of a distance without sign along an axis.
    pub(super) fn degrees(self) -> Decimal {
        match self.along {
            Ok(0) if self.pitch.mantissa >= 0 => Decimal::ZERO,
            Ok(0) => Decimal { mantissa: 180, scale: 0 },
            Ok(_) if self.pitch.mantissa >= 0 => Decimal { mantissa: 90, scale: 0 },
            Ok(_) => Decimal { mantissa: 270, scale: 0 },
            Err(angle) => angle,
        }
    }
}

/// The direction of an angle.
pub(super) fn unit(degrees: Decimal) -> [f64; 2] {
    let (sin, cos) = geometry::sin_cos((degrees.value() * ONE as f64).round() as i64);
    [cos, sin]
}

/// The simplest step of which every `away` is the given multiple, to within `half`. The multiples
/// must not be 0.
pub(super) fn step(away: &[(f64, [f64; 2])], half: f64, most: u8) -> Option<Step> {
    for side in 0..2 {
        if away.iter().all(|(_, by)| by[1 - side].abs() <= half) {
            let mut range = Range::ALL;
            for (times, by) in away {
                range.keep(by[side] / times, half / times.abs());
            }
            let pitch = range.simplest(most)?;
            return (pitch.mantissa != 0).then_some(Step { along: Ok(side), pitch });
        }
    }
    let (times, far) = away.iter().max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
    let middle = (far[1] * times).atan2(far[0] * times).to_degrees();
    let mut angles = Range::ALL;
    for (times, by) in away {
        let long = by[0].hypot(by[1]);
        // At this distance the half unit is the sine of an angle.
        let slack = (half * std::f64::consts::SQRT_2 / long).min(1.0).asin().to_degrees();
        let angle = (by[1] * times).atan2(by[0] * times).to_degrees();
        let turned = (angle - middle + 180.0).rem_euclid(360.0) - 180.0;
        angles.keep(middle + turned, slack);
    }
    angles.decimals(most).find_map(|angle| {
        let along = pitch(away, unit(angle), half)?.simplest(most)?;
        let angle = Decimal { mantissa: angle.mantissa.rem_euclid(360 * power(angle.scale)), ..angle };
        (along.mantissa > 0).then_some(Step { along: Err(angle), pitch: along })
    })
}

fn power(scale: u8) -> i64 {
    crate::num::POW10[scale as usize]
}

/// The distances that do along a direction.
pub(super) fn pitch(away: &[(f64, [f64; 2])], direction: [f64; 2], half: f64) -> Option<Range> {
    let mut range = Range::ALL;
    for (times, by) in away {
        for (by, way) in by.iter().zip(direction) {
            let way = way * times;
            if way.abs() < 1e-12 {
                if by.abs() > half {
                    return None;
                }
            } else {
                range.keep(by / way, (half / way).abs());
            }
        }
    }
    (!range.is_empty()).then_some(range)
}

/// How many holes from the first on lie at equal distances, as far as rough measure tells.
pub(super) fn equidistant(at: &[[f64; 2]], half: f64) -> usize {
    let Some([first, second]) = at.first_chunk::<2>() else { return at.len() };
    let by = [second[0] - first[0], second[1] - first[1]];
    if by[0].hypot(by[1]) <= 2.0 * half {
        return 1;
    }
    // A pair of neighbours is off by up to four halves; what is near enough is tried.
    let near = |a: &[f64; 2], b: &[f64; 2]| (0..2).all(|i| (b[i] - a[i] - by[i]).abs() <= 4.0 * half + 1e-9);
    1 + at.windows(2).take_while(|pair| near(&pair[0], &pair[1])).count()
}

/// Holes on a line from the first one: their step, for the most of `at` for which there is one.
pub(super) fn line(at: &[[f64; 2]], half: f64, most: u8) -> Option<(usize, Step)> {
    let mut count = equidistant(at, half);
    while count >= 3 {
        if let Some(step) = step(&from_first(&at[..count]), half, most) {
            return Some((count, step));
        }
        // A fit fails for all or for the last ones: try half as many, but at least a few.
        count = if count > 16 { count / 2 } else { count - 1 };
    }
    None
}

fn from_first(at: &[[f64; 2]]) -> Vec<(f64, [f64; 2])> {
    let first = at[0];
    let away = |(k, p): (usize, &[f64; 2])| (k as f64, [p[0] - first[0], p[1] - first[1]]);
    at.iter().enumerate().skip(1).map(away).collect()
}

/// Rows of holes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rows {
    /// Along a row.
    pub(super) columns: Step,
    /// From row to row.
    pub(super) rows: Step,
    /// Holes of a row, and rows.
    pub(super) counts: [usize; 2],
    /// Whether every second row runs backwards.
    pub(super) serpentine: bool,
}

/// A grid from the first hole on, of at most `limit` columns and rows.
pub(super) fn grid(at: &[[f64; 2]], half: f64, most: u8, limit: usize) -> Vec<Rows> {
    let columns = equidistant(at, half);
    if columns < 2 || columns > limit || at.len() < 2 * columns {
        return Vec::new();
    }
    [false, true].into_iter().filter_map(|way| rows(at, columns, way, half, most, limit)).collect()
}

fn rows(
    at: &[[f64; 2]],
    columns: usize,
    serpentine: bool,
    half: f64,
    most: u8,
    limit: usize,
) -> Option<Rows> {
    let first = at[0];
    let by = |p: [f64; 2]| [p[0] - first[0], p[1] - first[1]];
    let width = u32::try_from(columns).ok()?;
    let place = |k: usize| geometry::grid_position(width, serpentine, k as u32);
    let along = by(at[1]);
    let second = at[if serpentine { 2 * columns - 1 } else { columns }];
    let up = by(second);
    // Rough: how many rows there are.
    let near = |k: usize| {
        let (c, r) = place(k);
        let (c, r) = (f64::from(c), f64::from(r));
        let slack = (2.0 + 2.0 * c + 2.0 * r) * half + 1e-9;
        (0..2).all(|i| (by(at[k])[i] - c * along[i] - r * up[i]).abs() <= slack)
    };
    let fits = (0..at.len()).take_while(|k| near(*k)).count();
    let mut count = (fits / columns).min(limit);
    let columns_step = step(&from_first(&at[..columns]), half, most)?;
    while count >= 2 {
        let starts: Vec<_> = (1..count)
            .map(|r| (r as f64, by(at[r * columns + if serpentine && r % 2 == 1 { columns - 1 } else { 0 }])))
            .collect();
        let rows_step = square(&starts, columns_step, half, most).or_else(|| step(&starts, half, most));
        if let Some(rows_step) = rows_step {
            let found = Rows { columns: columns_step, rows: rows_step, counts: [columns, count], serpentine };
            if found.fits(at, half) {
                return Some(found);
            }
        }
        count -= 1;
    }
    None
}

/// The step from row to row at a right angle to a row that is turned.
fn square(starts: &[(f64, [f64; 2])], columns: Step, half: f64, most: u8) -> Option<Step> {
    let angle = columns.along.err()?;
    let up = angle.mantissa + 90 * power(angle.scale);
    let up = Decimal { mantissa: up.rem_euclid(360 * power(angle.scale)), ..angle };
    let pitch = pitch(starts, unit(up), half)?.simplest(most)?;
    (pitch.mantissa != 0).then_some(Step { along: Err(up), pitch })
}

impl Rows {
    /// Whether every hole is where it should be.
    fn fits(&self, at: &[[f64; 2]], half: f64) -> bool {
        let way = |step: Step| {
            let direction = match step.along {
                Ok(0) => [1.0, 0.0],
                Ok(_) => [0.0, 1.0],
                Err(angle) => unit(angle),
            };
            direction.map(|d| d * step.pitch.value())
        };
        let (along, up) = (way(self.columns), way(self.rows));
        let [columns, rows] = self.counts;
        (0..columns * rows).all(|k| {
            let (c, r) = geometry::grid_position(columns as u32, self.serpentine, k as u32);
            let (c, r) = (f64::from(c), f64::from(r));
            (0..2).all(|i| (at[0][i] + c * along[i] + r * up[i] - at[k][i]).abs() <= half + 1e-9)
        })
    }
}
