//! Which pattern a stretch of holes is, and how it is written.

use super::circle::{self, Circle, Wanted};
use super::decimal::Decimal;
use super::rows::{self, Rows, Step};
use super::{Hole, here, may_lead_in, plane};
use crate::canon::{Axis, Plane};
use crate::cycle::{Along, First, Pattern, Row, absolute};
use crate::num::{Nanos, ONE, POW10, Unit};
use crate::passes::Target;
use crate::passes::expand_patterns::sayable;
use crate::passes::walk::Walk;
use crate::passes::write::exact;
use crate::program::Point;

/// Holes one after another, and what is measured of them.
pub(super) struct Stretch<'t> {
    pub(super) holes: Vec<Hole>,
    target: &'t Target,
    unit: Unit,
    /// Nanos of a millimetre in the program's unit.
    of_unit: f64,
    /// Places in the unit of the program.
    at: Vec<[f64; 2]>,
    /// Half a unit of the last digit, in that unit.
    half: f64,
    half_nanos: Nanos,
    /// Most digits after the point of a parameter.
    most: u8,
    /// Whether the cycle can be called up again at another place.
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
    Line(usize, Step),
    Grid(Rows),
    Circle(Circle),
}

impl Shape {
    fn count(&self) -> usize {
        match self {
            Shape::Line(count, _) => *count,
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
        let finest = holes.iter().map(|h| h.digits).max().unwrap_or(0);
        let digits = finest.max(most.min(if inch { 4 } else { 3 })).min(9);
        let of_unit = if inch { 25.4 } else { 1.0 } * ONE as f64;
        let last = POW10[9 - digits as usize];
        Stretch {
            at: holes.iter().map(|h| h.at.map(|v| v as f64 / of_unit)).collect(),
            holes,
            target,
            unit,
            of_unit,
            half: 0.5 / POW10[digits as usize] as f64,
            half_nanos: if inch { last * 127 / 10 } else { last / 2 },
            most,
            leads_in,
        }
    }

    /// The pattern of most holes that begins with a hole; of two, the one that is written with fewer
    /// digits.
    pub(super) fn best(&self, next: usize, walk: &Walk) -> Option<Found> {
        let all = self.shapes(next, walk).into_iter().filter_map(|shape| {
            let holes = &self.holes[next..next + shape.count()];
            let digits = self.digits(&shape, holes);
            if !self.is_worth(&shape, digits, holes) {
                return None;
            }
            let pattern = self.pattern(&shape, holes, walk);
            self.stands(&pattern, holes, walk).then(|| Found { count: holes.len(), pattern, digits })
        });
        all.max_by_key(|found| (found.count, std::cmp::Reverse(found.digits)))
    }

    /// The whole stretch as a list, in which there is nothing else.
    pub(super) fn list(&self, walk: &Walk) -> Option<Found> {
        let (first, second, _) = plane(walk)?.axes();
        if self.holes.len() > self.target.caps.list_pattern as usize {
            return None;
        }
        let point = |hole: &Hole| {
            let mut to = Point::default();
            let [x, y] = self.place(hole.at);
            to.set(first, x);
            to.set(second, y);
            to
        };
        let pattern = Pattern::List(self.holes.iter().map(point).collect());
        Some(Found { count: self.holes.len(), pattern, digits: u32::MAX })
    }

    fn shapes(&self, next: usize, walk: &Walk) -> Vec<Shape> {
        let caps = &self.target.caps;
        let at = &self.at[next..];
        let (half, most) = (self.half, self.most);
        let limit = usize::try_from(caps.grid_pattern).unwrap_or(usize::MAX);
        let mut all = Vec::new();
        if caps.line_pattern || limit > 0 {
            all.extend(rows::line(at, half, most).map(|(count, step)| Shape::Line(count, step)));
        }
        all.extend(rows::grid(at, half, most, limit).into_iter().map(Shape::Grid));
        if caps.circle_pattern {
            let wanted = Wanted {
                half,
                most,
                here: here(walk).map(|here| here.map(|v| v as f64 / self.of_unit)),
                polar: caps.circle_polar,
                only_here: caps.circle_centre_at_zero_only,
            };
            all.extend(circle::circle(at, &wanted).map(Shape::Circle));
        }
        all
    }

    /// How many digits a pattern takes to write.
    fn digits(&self, shape: &Shape, holes: &[Hole]) -> u32 {
        match shape {
            Shape::Line(_, step) => step.digits() + 1,
            Shape::Grid(grid) => grid.columns.digits() + grid.rows.digits() + 2,
            Shape::Circle(circle) => {
                let first = match circle.first {
                    circle::First::AsWritten => self.written(holes[0].at),
                    circle::First::Polar { radius, angle } => radius.digits() + angle.digits(),
                };
                circle.centre.iter().map(|c| c.digits()).sum::<u32>() + first + circle.step.digits()
            }
        }
    }

    /// Digits of a place as it is written.
    fn written(&self, at: [Nanos; 2]) -> u32 {
        let digits = |v: Nanos| exact(v, self.unit).mantissa.unsigned_abs().checked_ilog10().map_or(1, |n| n + 1);
        at.into_iter().map(digits).sum()
    }

    /// Whether a pattern says more than its holes do.
    fn is_worth(&self, shape: &Shape, digits: u32, holes: &[Hole]) -> bool {
        let (sure, from) = match shape {
            Shape::Line(_, step) => (step.along.is_ok(), 1),
            Shape::Grid(grid) => (grid.columns.along.is_ok() && grid.rows.along.is_ok(), 1),
            Shape::Circle(circle) => (circle.count > 4, 0),
        };
        let words: u32 = holes[from..].iter().map(|hole| self.written(hole.at)).sum();
        sure || digits <= words + holes.len() as u32
    }

    fn place(&self, at: [Nanos; 2]) -> [crate::program::Coord; 2] {
        at.map(|v| absolute(exact(v, self.unit)))
    }

    /// A pattern as a statement; it begins where the tool stands, if it can.
    fn pattern(&self, shape: &Shape, holes: &[Hole], walk: &Walk) -> Pattern {
        let caps = &self.target.caps;
        let (first, second, _) = plane(walk).unwrap_or(Plane::Xy).axes();
        let here = here(walk);
        let begin = holes[0].at;
        let start = (caps.pattern_start && here != Some(begin)).then(|| self.place(begin));
        match shape {
            Shape::Line(count, step) if caps.line_pattern => Pattern::Line {
                start,
                angle: step.degrees().literal(Unit::Degree).into(),
                offset: Decimal::ZERO.literal(self.unit).into(),
                pitch: step.pitch.positive().literal(self.unit).into(),
                count: whole(*count),
            },
            Shape::Line(count, step) => {
                let across = Step { along: step.along.map(|side| 1 - side), pitch: Decimal::ZERO };
                let (along, across) = (self.row(*step, *count, first, second), self.row(across, 1, first, second));
                let (columns, rows) = if step.along == Ok(1) { (across, along) } else { (along, across) };
                Pattern::Grid { start, columns, rows, serpentine: caps.grid_serpentine.unwrap_or(false) }
            }
            Shape::Grid(grid) => Pattern::Grid {
                start,
                columns: self.row(grid.columns, grid.counts[0], first, second),
                rows: self.row(grid.rows, grid.counts[1], first, second),
                serpentine: grid.serpentine,
            },
            Shape::Circle(circle) => {
                let centre = circle.centre.map(|c| absolute(c.literal(self.unit)));
                let at = centre.each_ref().map(|c| walk.at.nanos(&c.value));
                let stands = here.is_some_and(|here| at == here.map(Some));
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
                    count: whole(circle.count),
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
        Row { along, pitch: step.pitch.literal(self.unit).into(), count: whole(count) }
    }

    /// Whether the target has words for a pattern, and it makes every hole where it is.
    fn stands(&self, pattern: &Pattern, holes: &[Hole], walk: &Walk) -> bool {
        let mut there = walk.clone();
        if begins_here(pattern) {
            if here(walk) != Some(holes[0].at) && !(self.leads_in && may_lead_in(walk)) {
                return false;
            }
            let Some((first, second, _)) = plane(walk).map(Plane::axes) else { return false };
            there.at.position[first as usize] = Some(holes[0].at[0]);
            there.at.position[second as usize] = Some(holes[0].at[1]);
        }
        let Some(places) = there.at.positions(pattern) else { return false };
        let near = |(place, hole): (&[Nanos; 2], &Hole)| {
            (0..2).all(|i| place[i].abs_diff(hole.at[i]) <= self.half_nanos as u64)
        };
        let same = places.len() == holes.len() && places.iter().zip(holes).all(near);
        same && sayable(&there, pattern, self.target)
    }
}

fn whole(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}

/// Whether a pattern's first hole is where the tool stands.
pub(super) fn begins_here(pattern: &Pattern) -> bool {
    match pattern {
        Pattern::Line { start, .. } | Pattern::Grid { start, .. } => start.is_none(),
        Pattern::Circle { .. } | Pattern::List(_) => false,
    }
}
