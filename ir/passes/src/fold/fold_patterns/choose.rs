//! Which pattern a stretch of holes is, and how it is written.

use std::ops::Range;

use crate::fold::fold_patterns::circle::{self, Circle, Wanted};
use crate::fold::fold_patterns::decimal::Decimal;
use crate::fold::fold_patterns::rows::{self, Line, Rows, Start, Step};
use crate::fold::fold_patterns::{Hole, LEAST_DIGITS, Spot, here, may_lead_in, plane, stand};
use crate::holes::expand_patterns::sayable;
use crate::support::walk::Walk;
use crate::support::write::exact;
use crate::target::Target;
use ncc_ir::canon::{Axis, Plane};
use ncc_ir::caps::GridWay;
use ncc_ir::expr::num::{Nanos, ONE, POW10, Unit};
use ncc_ir::program::Point;
use ncc_ir::program::cycle::{Along, First, Pattern, Row, absolute};

/// Holes one after another, and what is measured of them.
pub(super) struct Stretch<'t> {
    pub(super) holes: Vec<Hole>,
    target: &'t Target,
    pub(super) unit: Unit,
    /// Nanos of a millimetre in the program's unit.
    of_unit: f64,
    spots: Vec<Spot>,
    /// Half the least increment of each hole's words, nanos.
    half: u64,
    /// Digits after the point to which the holes are written.
    pub(super) digits: u8,
    /// Most digits after the point of a parameter.
    most: u8,
    /// Whether the cycle can be activated again at another place.
    leads_in: bool,
}

/// A pattern found.
#[derive(Clone, Debug)]
pub(super) struct Found {
    /// Its holes.
    pub(super) count: usize,
    pub(super) pattern: Pattern,
    /// How many digits it takes to write.
    digits: u32,
}

#[derive(Clone, Copy, Debug)]
enum Shape {
    Line(Line),
    Grid(Rows),
    Circle(Circle),
}

impl Shape {
    fn count(&self) -> usize {
        match self {
            Shape::Line(line) => line.count,
            Shape::Grid(grid) => grid.counts[0] * grid.counts[1],
            Shape::Circle(circle) => circle.count,
        }
    }
}

impl<'t> Stretch<'t> {
    pub(super) fn new(holes: Vec<Hole>, walk: &Walk, target: &'t Target, leads_in: bool) -> Stretch<'t> {
        let unit = walk.unit();
        let inch = unit == Unit::Inch;
        let most = target.decimals_in(unit).min(9);
        let of_unit = if inch { 25.4 } else { 1.0 } * ONE as f64;
        // Zeros at the end are left out, so that every hole is written as finely as the finest one.
        let least = most.min(LEAST_DIGITS + u8::from(inch));
        let digits = holes.iter().flat_map(|hole| hole.digits).fold(least, u8::max).min(9);
        let last = POW10[9 - digits as usize].unsigned_abs();
        let spot = |hole: &Hole| Spot {
            at: hole.at.map(|v| v as f64 / of_unit),
            half: [0.5 / POW10[digits as usize] as f64; 2],
        };
        Stretch {
            spots: holes.iter().map(spot).collect(),
            half: last * if inch { 254 } else { 10 } / 20,
            digits,
            holes,
            target,
            unit,
            of_unit,
            most,
            leads_in,
        }
    }

    /// The pattern of most holes that begins with a hole; of two, the one that is written with fewer
    /// digits.
    pub(super) fn best(&self, next: usize, walk: &Walk) -> Option<Found> {
        let all = self.shapes(next, walk).into_iter().filter_map(|shape| {
            let holes = next..next + shape.count();
            let digits = self.digits(&shape, self.holes[next].at, walk);
            if !self.is_worth(&shape, digits, &self.holes[holes.clone()]) {
                return None;
            }
            let pattern = self.pattern(&shape, self.holes[next].at, walk);
            self.stands(&pattern, holes, walk).then_some(Found { count: shape.count(), pattern, digits })
        });
        all.max_by_key(|found| (found.count, std::cmp::Reverse(found.digits)))
    }

    /// Holes in which there is nothing else, as a list.
    pub(super) fn list(&self, holes: Range<usize>, walk: &Walk) -> Option<Found> {
        let (first, second, _) = plane(walk)?.axes();
        let holes = &self.holes[holes];
        if holes.len() < 3 || holes.len() > self.target.caps.holes.list_upto as usize {
            return None;
        }
        let point = |hole: &Hole| {
            let mut to = Point::default();
            let [x, y] = self.place(hole.at);
            to.set(first, x);
            to.set(second, y);
            to
        };
        let pattern = Pattern::List(holes.iter().map(point).collect());
        Some(Found { count: holes.len(), pattern, digits: u32::MAX })
    }

    fn shapes(&self, next: usize, walk: &Walk) -> Vec<Shape> {
        let caps = &self.target.caps;
        let spots = &self.spots[next..];
        let here = here(walk).map(|here| here.map(|v| v as f64 / self.of_unit));
        let limit = usize::try_from(caps.holes.grid_upto).unwrap_or(usize::MAX);
        let mut all = Vec::new();
        if caps.holes.lines || limit > 0 {
            all.extend(rows::lines(spots, here, self.most).into_iter().map(Shape::Line));
        }
        all.extend(rows::grids(spots, here, self.most, limit).into_iter().map(Shape::Grid));
        if caps.holes.circles {
            let only_here = caps.holes.centre_at_zero_only;
            let wanted = Wanted { most: self.most, here, start: caps.holes.circle_start, only_here };
            all.extend(circle::circle(spots, &wanted).map(Shape::Circle));
        }
        all
    }

    /// How many digits a pattern takes to write.
    fn digits(&self, shape: &Shape, begin: [Nanos; 2], walk: &Walk) -> u32 {
        let sum = |place: &[Decimal; 2]| place[0].digits() + place[1].digits();
        let start = |start: &Start| match start {
            Start::First if here(walk) == Some(begin) => 0,
            Start::First => self.written(begin),
            Start::Here => 0,
            Start::At(place) => sum(place),
        };
        match shape {
            Shape::Line(line) => {
                let offset = if line.offset == Decimal::ZERO { 0 } else { line.offset.digits() };
                start(&line.start) + offset + line.step.digits() + 1
            }
            Shape::Grid(grid) => start(&grid.start) + grid.columns.digits() + grid.rows.digits() + 2,
            Shape::Circle(circle) => {
                let first = match circle.first {
                    circle::First::AsWritten => self.written(begin),
                    circle::First::Polar { radius, angle } => radius.digits() + angle.digits(),
                };
                let centre = if self.stands_at(&circle.centre, walk) { 0 } else { sum(&circle.centre) };
                centre + first + circle.step.digits()
            }
        }
    }

    /// Whether the tool stands there.
    fn stands_at(&self, place: &[Decimal; 2], walk: &Walk) -> bool {
        let at = place.map(|c| walk.at.nanos(&c.literal(self.unit).into()));
        here(walk).is_some_and(|here| at == here.map(Some))
    }

    /// Digits of a place as it is written.
    fn written(&self, at: [Nanos; 2]) -> u32 {
        let digits =
            |v: Nanos| exact(v, self.unit).mantissa.unsigned_abs().checked_ilog10().map_or(1, |n| n + 1);
        at.into_iter().map(digits).sum()
    }

    /// Whether a pattern says more than its holes do.
    fn is_worth(&self, shape: &Shape, digits: u32, holes: &[Hole]) -> bool {
        let sure = match shape {
            Shape::Line(line) => line.step.along.is_ok(),
            Shape::Grid(grid) => grid.columns.along.is_ok() && grid.rows.along.is_ok(),
            Shape::Circle(circle) => circle.count > 4,
        };
        let words: u32 = holes.iter().map(|hole| self.written(hole.at)).sum();
        sure || digits <= words + holes.len() as u32
    }

    fn place(&self, at: [Nanos; 2]) -> [ncc_ir::program::Coord; 2] {
        at.map(|v| absolute(exact(v, self.unit)))
    }

    /// A pattern as a statement; it begins where the tool is, if it can.
    fn pattern(&self, shape: &Shape, begin: [Nanos; 2], walk: &Walk) -> Pattern {
        let caps = &self.target.caps;
        let (first, second, _) = plane(walk).unwrap_or(Plane::Xy).axes();
        let start = |start: &Start| match start {
            Start::First => {
                (caps.holes.pattern_start && here(walk) != Some(begin)).then(|| self.place(begin))
            }
            Start::Here => None,
            Start::At(place) => Some(place.map(|c| absolute(c.literal(self.unit)))),
        };
        match shape {
            Shape::Line(line) if caps.holes.lines => Pattern::Line {
                start: start(&line.start),
                angle: line.step.degrees().literal(Unit::Degree).into(),
                offset: line.offset.literal(self.unit).into(),
                pitch: line.step.pitch.positive().literal(self.unit).into(),
                count: count_u32(line.count),
            },
            Shape::Line(line) => {
                let step = line.step;
                let across = Step { along: step.along.map(|side| 1 - side), pitch: Decimal::ZERO };
                let (along, across) =
                    (self.row(step, line.count, first, second), self.row(across, 1, first, second));
                let (columns, rows) = if step.along == Ok(1) { (across, along) } else { (along, across) };
                let serpentine = caps.holes.grid_way == GridWay::Serpentine;
                Pattern::Grid { start: start(&line.start), columns, rows, serpentine }
            }
            Shape::Grid(grid) => Pattern::Grid {
                start: start(&grid.start),
                columns: self.row(grid.columns, grid.counts[0], first, second),
                rows: self.row(grid.rows, grid.counts[1], first, second),
                serpentine: grid.serpentine,
            },
            Shape::Circle(circle) => {
                let centre = circle.centre.map(|c| absolute(c.literal(self.unit)));
                let stands = self.stands_at(&circle.centre, walk);
                Pattern::Circle {
                    centre: (!stands).then_some(centre),
                    first: match circle.first {
                        circle::First::AsWritten => First::At(self.place(begin)),
                        circle::First::Polar { radius, angle } => First::Polar {
                            radius: radius.literal(self.unit).into(),
                            angle: angle.literal(Unit::Degree).into(),
                        },
                    },
                    step: circle.step.literal(Unit::Degree).into(),
                    count: count_u32(circle.count),
                }
            }
        }
    }

    fn row(&self, step: Step, count: usize, first: Axis, second: Axis) -> Row {
        let along = match step.along {
            Ok(0) => Along::Axis(first),
            Ok(_) => Along::Axis(second),
            Err(angle) => Along::Angle(angle.literal(Unit::Degree).into()),
        };
        Row { along, pitch: step.pitch.literal(self.unit).into(), count: count_u32(count) }
    }

    /// Whether the target supports a pattern, and it makes every hole where it is.
    fn stands(&self, pattern: &Pattern, holes: Range<usize>, walk: &Walk) -> bool {
        let mut there = walk.clone();
        let first = &self.holes[holes.start];
        if begins_here(pattern) && !self.begins(pattern, holes.start, walk) {
            if !(self.leads_in && may_lead_in(walk)) {
                return false;
            }
            stand(&mut there, first.at);
        }
        let Some(places) = there.at.positions(pattern) else { return false };
        let near = |k: usize, place: &[Nanos; 2]| {
            (0..2).all(|i| place[i].abs_diff(self.holes[k].at[i]) <= self.half)
        };
        let same = places.len() == holes.len() && holes.zip(&places).all(|(k, place)| near(k, place));
        same && sayable(&there, pattern, self.target)
    }

    /// Whether a pattern that begins where the tool is begins with this hole.
    pub(super) fn begins(&self, pattern: &Pattern, hole: usize, walk: &Walk) -> bool {
        let places = walk.at.positions(pattern);
        let Some(first) = places.as_ref().and_then(|places| places.first()) else { return false };
        (0..2).all(|i| first[i].abs_diff(self.holes[hole].at[i]) <= self.half)
    }
}

fn count_u32(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}

/// Whether a pattern's first hole is where the tool is.
pub(super) fn begins_here(pattern: &Pattern) -> bool {
    match pattern {
        Pattern::Line { start, .. } | Pattern::Grid { start, .. } => start.is_none(),
        Pattern::Circle { .. } | Pattern::List(_) => false,
    }
}
