//! Lines and grids: holes at equal distances.

use crate::fold::fold_patterns::Spot;
use crate::fold::fold_patterns::decimal::{Decimal, Range};
use ncc_ir::expr::num::{ONE, POW10};
use ncc_ir::geometry;

/// Most digits after the point of a line's distance to its first hole that are searched for.
const DIGITS_OF_OFFSET: u8 = 1;

/// Longest such distance.
const LONGEST_OFFSET: f64 = 100.0;

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
        let right = |quarters: i64| Decimal { mantissa: 90 * quarters, scale: 0 };
        match (self.along, self.pitch.mantissa >= 0) {
            (Ok(0), true) => right(0),
            (Ok(0), false) => right(2),
            (Ok(_), true) => right(1),
            (Ok(_), false) => right(3),
            (Err(angle), _) => angle,
        }
    }

    /// The way of one step.
    fn way(self) -> [f64; 2] {
        let direction = match self.along {
            Ok(0) => [1.0, 0.0],
            Ok(_) => [0.0, 1.0],
            Err(angle) => direction(angle),
        };
        direction.map(|d| d * self.pitch.value())
    }
}

/// The direction of an angle.
fn direction(degrees: Decimal) -> [f64; 2] {
    let (sin, cos) = geometry::sin_cos((degrees.value() * ONE as f64).round() as i64);
    [cos, sin]
}

/// An angle in the first turn.
fn turned(degrees: Decimal, by: i64) -> Decimal {
    let whole = POW10[degrees.scale as usize];
    Decimal { mantissa: (degrees.mantissa + by * whole).rem_euclid(360 * whole), ..degrees }
}

/// How far a hole is away from where the step begins, and how many steps that should be.
#[derive(Clone, Copy, Debug)]
struct Away {
    times: f64,
    by: [f64; 2],
    half: [f64; 2],
}

impl Away {
    fn from(start: [f64; 2], spot: &Spot, times: usize) -> Away {
        Away { times: times as f64, by: std::array::from_fn(|i| spot.at[i] - start[i]), half: spot.half }
    }
}

/// The simplest step of which every hole is so many away.
fn step(away: &[Away], most: u8) -> Option<Step> {
    for side in 0..2 {
        if away.iter().all(|a| a.by[1 - side].abs() <= a.half[1 - side]) {
            let mut range = Range::ALL;
            for a in away {
                range.keep(a.by[side] / a.times, a.half[side] / a.times);
            }
            let pitch = range.simplest(most)?;
            return (pitch.mantissa != 0).then_some(Step { along: Ok(side), pitch });
        }
    }
    angles(away, 1.0).decimals(most).find_map(|angle| {
        let pitch = pitch(away, direction(angle))?.simplest(most)?;
        (pitch.mantissa > 0).then_some(Step { along: Err(turned(angle, 0)), pitch })
    })
}

/// The angles that may do; `more` is how many times the half unit what is measured may be off.
fn angles(away: &[Away], more: f64) -> Range {
    let Some(far) = away.last() else { return Range::ALL };
    let middle = far.by[1].atan2(far.by[0]).to_degrees();
    let mut angles = Range::ALL;
    for a in away {
        let long = a.by[0].hypot(a.by[1]);
        // At this distance the half unit is the sine of an angle.
        let slack = (more * a.half[0].hypot(a.half[1]) / long).min(1.0).asin().to_degrees();
        let angle = a.by[1].atan2(a.by[0]).to_degrees();
        angles.keep(middle + (angle - middle + 180.0).rem_euclid(360.0) - 180.0, slack);
    }
    angles
}

/// The distances that do along a direction.
fn pitch(away: &[Away], direction: [f64; 2]) -> Option<Range> {
    let mut range = Range::ALL;
    for a in away {
        for (i, way) in direction.into_iter().enumerate() {
            let way = way * a.times;
            if way.abs() > 1e-12 {
                range.keep(a.by[i] / way, (a.half[i] / way).abs());
            } else if a.by[i].abs() > a.half[i] {
                return None;
            }
        }
    }
    (!range.is_empty()).then_some(range)
}

/// How many holes from the first on lie at equal distances, as far as rough measure tells.
fn equidistant(spots: &[Spot]) -> usize {
    let Some([first, second]) = spots.first_chunk::<2>() else { return spots.len() };
    let by: [f64; 2] = std::array::from_fn(|i| second.at[i] - first.at[i]);
    let half = spots[0].coarse();
    if by[0].hypot(by[1]) <= 4.0 * half {
        return 1;
    }
    // A pair of neighbours is off by up to two halves; what is near enough is tried.
    let near = |a: &Spot, b: &Spot| (0..2).all(|i| (b.at[i] - a.at[i] - by[i]).abs() <= 4.5 * half);
    1 + spots.windows(2).take_while(|pair| near(&pair[0], &pair[1])).count()
}

/// A line of holes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Line {
    pub(super) count: usize,
    pub(super) step: Step,
    /// Where it begins.
    pub(super) start: Start,
    /// From there to the first hole.
    pub(super) offset: Decimal,
}

/// Where a line or grid begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Start {
    /// At the first hole, as it is written.
    First,
    /// Tool position.
    Here,
    /// There.
    At([Decimal; 2]),
}

/// Lines from the first hole on, with the most holes for which there are any.
pub(super) fn lines(spots: &[Spot], here: Option<[f64; 2]>, most: u8) -> Vec<Line> {
    let mut count = equidistant(spots);
    while count >= 3 {
        let found = lines_of(&spots[..count], here, most);
        if !found.is_empty() {
            return found;
        }
        // A fit fails for all or for the last ones.
        count = if count > 16 { count / 2 } else { count - 1 };
    }
    Vec::new()
}

fn lines_of(spots: &[Spot], here: Option<[f64; 2]>, most: u8) -> Vec<Line> {
    let mut found = Vec::new();
    let count = spots.len();
    let first = &spots[0];
    let from = |start: [f64; 2]| -> Option<Step> {
        let away: Vec<Away> =
            spots.iter().enumerate().skip(1).map(|(k, s)| Away::from(start, s, k)).collect();
        step(&away, most)
    };
    let offset = Decimal::ZERO;
    if let Some(here) = here.filter(|here| first.is_at(*here))
        && let Some(step) = from(here)
    {
        found.push(Line { count, step, start: Start::Here, offset });
    }
    if let Some(step) = from(first.at) {
        found.push(Line { count, step, start: Start::First, offset });
        if step.along.is_ok() {
            return found;
        }
    }
    found.extend(from_afar(spots, here, most));
    found
}

/// A line whose first hole is not where it is written, but rounded: it begins elsewhere, or with more
/// digits.
fn from_afar(spots: &[Spot], here: Option<[f64; 2]>, most: u8) -> Option<Line> {
    let count = spots.len();
    let first = spots[0];
    // Differences are off by the half units of both.
    let both = |(k, s): (usize, &Spot)| {
        let half = std::array::from_fn(|i| s.half[i] + first.half[i]);
        Away { half, ..Away::from(first.at, s, k) }
    };
    let away: Vec<Away> = spots.iter().enumerate().skip(1).map(both).collect();
    for angle in angles(&away, 1.0).decimals(most.min(3)) {
        let way = direction(angle);
        let Some(pitch) = pitch(&away, way).and_then(|p| p.simplest(most.min(3))) else { continue };
        if pitch.mantissa <= 0 {
            continue;
        }
        let mut start = [Range::ALL; 2];
        for (k, spot) in spots.iter().enumerate() {
            for i in 0..2 {
                start[i].keep(spot.at[i] - k as f64 * pitch.value() * way[i], spot.half[i]);
            }
        }
        if start.iter().any(|range| range.is_empty()) {
            continue;
        }
        let step = Step { along: Err(turned(angle, 0)), pitch };
        if let Some((start, offset)) = beginning(start, way, here, most) {
            return Some(Line { count, step, start, offset });
        }
    }
    None
}

/// The simplest beginning of a line whose first hole is within these ranges.
fn beginning(first: [Range; 2], way: [f64; 2], here: Option<[f64; 2]>, most: u8) -> Option<(Start, Decimal)> {
    if let Some(here) = here {
        let mut offset = Range::ALL;
        for i in 0..2 {
            offset.between((first[i].low - here[i]) / way[i], (first[i].high - here[i]) / way[i]);
        }
        if let Some(offset) = offset.simplest(most).filter(|d| d.mantissa >= 0) {
            return Some((Start::Here, offset));
        }
    }
    let at = |offset: Decimal, digits: u8| -> Option<[Decimal; 2]> {
        let start = |i: usize| first[i].shifted(-offset.value() * way[i]).simplest(digits);
        Some([start(0)?, start(1)?])
    };
    // From a simpler place further back, if it takes fewer digits to write.
    let plain = at(Decimal::ZERO, most);
    let cost = |start: &[Decimal; 2]| start[0].digits() + start[1].digits();
    let mut best = plain.map(|start| (cost(&start), start, Decimal::ZERO));
    let unit = POW10[DIGITS_OF_OFFSET as usize];
    for tenths in 1..=(LONGEST_OFFSET * unit as f64) as i64 {
        let offset = Decimal::near(tenths as f64 / unit as f64, DIGITS_OF_OFFSET);
        if let Some(start) = at(offset, most.min(3)) {
            let digits = cost(&start) + offset.digits();
            if best.is_none_or(|best| digits < best.0) {
                best = Some((digits, start, offset));
            }
        }
    }
    best.map(|(_, start, offset)| (Start::At(start), offset))
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
    /// Where it begins.
    pub(super) start: Start,
}

/// Grids from the first hole on, of at most `limit` columns and rows.
pub(super) fn grids(spots: &[Spot], here: Option<[f64; 2]>, most: u8, limit: usize) -> Vec<Rows> {
    let columns = equidistant(spots);
    if columns < 2 || columns > limit || spots.len() < 2 * columns {
        return Vec::new();
    }
    let mut found = Vec::new();
    for serpentine in [false, true] {
        let starts = [(Start::Here, here.filter(|h| spots[0].is_at(*h))), (Start::First, Some(spots[0].at))];
        let of = |(start, at): (Start, Option<[f64; 2]>)| {
            rows(spots, columns, serpentine, at?, start, most, limit)
        };
        let grid = starts.into_iter().filter_map(of).max_by_key(|grid| grid.counts[1]);
        found.extend(grid);
    }
    found
}

fn rows(
    spots: &[Spot],
    columns: usize,
    serpentine: bool,
    first: [f64; 2],
    start: Start,
    most: u8,
    limit: usize,
) -> Option<Rows> {
    let by = |spot: &Spot| -> [f64; 2] { std::array::from_fn(|i| spot.at[i] - first[i]) };
    let along = by(&spots[1]);
    let second = if serpentine { 2 * columns - 1 } else { columns };
    let up = by(&spots[second]);
    let half = spots[0].coarse();
    // Rough: how many rows there are.
    let near = |k: usize| {
        let (c, r) = place(k, columns, serpentine);
        let slack = (2.0 + 2.0 * c + 2.0 * r) * half;
        (0..2).all(|i| (by(&spots[k])[i] - c * along[i] - r * up[i]).abs() <= slack)
    };
    let fits = (0..spots.len()).take_while(|k| near(*k)).count();
    let row: Vec<Away> = (1..columns).map(|k| Away::from(first, &spots[k], k)).collect();
    let columns_step = step(&row, most)?;
    let mut count = (fits / columns).min(limit);
    while count >= 2 {
        let begins = |r: usize| r * columns + if serpentine && r % 2 == 1 { columns - 1 } else { 0 };
        let starts: Vec<Away> = (1..count).map(|r| Away::from(first, &spots[begins(r)], r)).collect();
        let counts = [columns, count];
        let ways = [square(&starts, columns_step, most), step(&starts, most)];
        let grids = ways.into_iter().flatten().map(|rows| Rows {
            columns: columns_step,
            rows,
            counts,
            serpentine,
            start,
        });
        if let Some(found) = grids.into_iter().find(|grid| grid.fits(spots, first)) {
            return Some(found);
        }
        count -= 1;
    }
    None
}

/// Column and row of a hole.
fn place(k: usize, columns: usize, serpentine: bool) -> (f64, f64) {
    let (c, r) = geometry::grid_position(columns as u32, serpentine, k as u32);
    (f64::from(c), f64::from(r))
}

/// The step from row to row at a right angle to a row that is turned.
fn square(starts: &[Away], columns: Step, most: u8) -> Option<Step> {
    let up = turned(columns.along.err()?, 90);
    let pitch = pitch(starts, direction(up))?.simplest(most)?;
    (pitch.mantissa != 0).then_some(Step { along: Err(up), pitch })
}

impl Rows {
    /// Whether every hole is where it should be.
    fn fits(&self, spots: &[Spot], first: [f64; 2]) -> bool {
        let (along, up) = (self.columns.way(), self.rows.way());
        let [columns, rows] = self.counts;
        (0..columns * rows).all(|k| {
            let (c, r) = place(k, columns, self.serpentine);
            spots[k].is_at(std::array::from_fn(|i| first[i] + c * along[i] + r * up[i]))
        })
    }
}
