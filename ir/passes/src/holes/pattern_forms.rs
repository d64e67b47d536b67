//! A pattern in the form in which a target says it: a circle's first hole by radius and angle or by
//! a position, a line as a grid of one row, a start that is stated or where the tool is.
//!
//! A form is taken only if its holes are the pattern's to half the target's least increment, in
//! the same order. Where a control chooses the order by where the tool is, that is only where the tool is
//! at the first hole.

use crate::support::walk::Walk;
use crate::support::write::{at, is_absolute, rounded};
use crate::target::Target;
use ncc_ir::canon::{Axis, Plane};
use ncc_ir::caps::{Caps, CircleStart, GridWay};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num, ONE, POW10, Unit};
use ncc_ir::geometry::hole_positions::{HolePositions, Step};
use ncc_ir::program::cycle::{Along, First, Pattern, Row};
use ncc_ir::program::{Coord, Point};
use ncc_ir::track::Tracker;

/// Degrees of a quarter turn, in nanos.
const QUARTER: Nanos = 90 * ONE;

/// Most holes of one pattern; more is a slip of the pen.
pub(crate) const MOST_HOLES: u32 = 100_000;

/// What is known here.
struct Here<'h> {
    walk: &'h Walk,
    caps: &'h Caps,
    axes: [Axis; 2],
    decimals: u8,
    /// Digits of an angle.
    angle_decimals: u8,
    unit: Unit,
}

/// The forms, one after another, in which the target says a pattern that stands here; `None` if it
/// has none. A pattern that it can say as it is stays as it is.
pub(crate) fn fit(walk: &Walk, pattern: &Pattern, plane: Plane, target: &Target) -> Option<Vec<Pattern>> {
    let (first, second, _) = plane.axes();
    let unit = walk.unit();
    let decimals = target.decimals_in(unit);
    let angle_decimals = target.decimals_in(Unit::Degree);
    let here = Here { walk, caps: &target.caps, axes: [first, second], decimals, angle_decimals, unit };
    if here.says(pattern) {
        return Some(vec![pattern.clone()]);
    }
    let places = walk.at.hole_positions(pattern);
    if let Pattern::List(points) = pattern {
        return here.lists(points, places.as_ref());
    }
    let places = places.filter(|p| p.count() <= MOST_HOLES)?;
    let same = |form: &Pattern| here.says(form) && here.same_holes(form, &places);
    here.forms(pattern, &places).into_iter().find(same).map(|form| vec![form])
}

/// Whether the target supports a pattern that is computed when the program runs, wherever it stands.
pub(crate) fn says_computed(pattern: &Pattern, plane: Plane, caps: &Caps) -> bool {
    let (first, second, _) = plane.axes();
    let walk = Walk::new(Tracker::unknown());
    let (decimals, angle_decimals) = (9, 9);
    let here = Here { walk: &walk, caps, axes: [first, second], decimals, angle_decimals, unit: walk.unit() };
    here.says(pattern)
}

impl Here<'_> {
    fn stands(&self) -> [Option<Nanos>; 2] {
        self.axes.map(|axis| self.walk.at.position[axis as usize])
    }

    /// Whether the target supports this form as it stands.
    fn says(&self, pattern: &Pattern) -> bool {
        let caps = self.caps;
        let starts = |start: &Option<[Coord; 2]>| match start {
            Some(_) => caps.holes.pattern_start,
            None => caps.holes.pattern_here,
        };
        // A control that states where a pattern begins also counts its holes and ways.
        let counts = |n: u32| n > 0 || caps.holes.pattern_here;
        match pattern {
            Pattern::Circle { centre, first, step, count } => {
                let polar = matches!(first, First::Polar { .. });
                if !caps.holes.circles || !counts(*count) || !caps.holes.circle_start.says(polar) {
                    return false;
                }
                if caps.holes.centre_at_zero_only {
                    let here = self.stands();
                    let centre = match centre {
                        None => here,
                        Some([x, y]) => [self.walk.at.resolve(x, here[0]), self.walk.at.resolve(y, here[1])],
                    };
                    return here == [Some(0); 2] && centre == [Some(0); 2];
                }
                let has_way = match first {
                    _ if caps.holes.pattern_here => true,
                    First::At(_) => *count <= 1 || !self.is_zero(step),
                    First::Polar { radius, .. } => {
                        let positive = radius.literal().is_none_or(|n| n.mantissa > 0);
                        (*count <= 1 || !self.is_zero(step)) && positive
                    }
                };
                (centre.is_some() || caps.holes.pattern_here) && has_way
            }
            Pattern::Line { start, offset, pitch, count, .. } => {
                let signs = caps.holes.pattern_here
                    || *count <= 1
                    || self.is_positive(pitch) && !self.is_negative(offset);
                caps.holes.lines && counts(*count) && starts(start) && signs && self.in_order(pattern)
            }
            Pattern::List(points) => {
                let complete = |p: &Point| self.axes.iter().all(|axis| p.get(*axis).is_some());
                points.len() <= caps.holes.list_upto as usize
                    && (caps.holes.pattern_here || !points.is_empty() && points.iter().all(complete))
            }
            Pattern::Grid { start, columns, rows, serpentine } => {
                let [first, second] = self.axes;
                let along = |row: &Row, axis| row.along == Along::Axis(axis);
                if !starts(start) || !counts(columns.count.min(rows.count)) {
                    return false;
                }
                let straight = columns.count <= 1 || rows.count <= 1;
                let way = straight || caps.holes.grid_way.says(*serpentine);
                let axes = caps.holes.pattern_angle || along(columns, first) && along(rows, second);
                let upto = columns.count.max(rows.count) <= caps.holes.grid_upto;
                way && axes
                    && upto
                    && (!caps.holes.grid_square || self.is_square(columns, rows))
                    && self.in_order(pattern)
            }
        }
    }

    fn is_zero(&self, value: &Expr) -> bool {
        self.walk.at.nanos(value) == Some(0)
    }

    fn is_positive(&self, value: &Expr) -> bool {
        self.walk.at.nanos(value).is_some_and(|v| v > 0)
    }

    fn is_negative(&self, value: &Expr) -> bool {
        self.walk.at.nanos(value).is_none_or(|v| v < 0)
    }

    /// Whether rows stand at +90 degrees to the columns and both are counted positive.
    fn is_square(&self, columns: &Row, rows: &Row) -> bool {
        let direction = |row: &Row| match &row.along {
            Along::Axis(axis) => Some(if *axis == self.axes[0] { 0 } else { QUARTER }),
            Along::Angle(angle) => self.walk.at.nanos(angle).map(|a| a.rem_euclid(4 * QUARTER)),
        };
        let square = direction(columns)
            .zip(direction(rows))
            .is_some_and(|(c, r)| (r - c - QUARTER).rem_euclid(4 * QUARTER) == 0);
        square && self.is_positive(&columns.pitch) && self.is_positive(&rows.pitch)
    }

    /// Whether the control goes through the holes in the pattern's order.
    fn in_order(&self, pattern: &Pattern) -> bool {
        if !self.caps.holes.order_by_position {
            return true;
        }
        let Some(places) = self.walk.at.hole_positions(pattern) else { return false };
        places.count() <= 1 || self.stands() == places.get(0).map(Some)
    }

    /// Whether a form makes the same holes.
    fn same_holes(&self, form: &Pattern, places: &HolePositions) -> bool {
        let unit = POW10[9 - self.decimals.min(9) as usize];
        let half = if self.unit == Unit::Inch { unit * 254 / 10 } else { unit } / 2;
        self.walk.at.hole_positions(form).is_some_and(|other| {
            other.count() == places.count()
                && (0..places.count()).all(|k| {
                    let (a, b) = (places.get(k), other.get(k));
                    (0..2).all(|i| a[i].abs_diff(b[i]) <= half as u64)
                })
        })
    }

    fn length(&self, nanos: Nanos) -> Expr {
        rounded(nanos, self.decimals, self.unit).into()
    }

    fn degrees(&self, nanos: Nanos) -> Expr {
        let turn = 4 * QUARTER;
        let angle = (nanos + 2 * QUARTER).rem_euclid(turn) - 2 * QUARTER;
        let angle = if angle == -2 * QUARTER { 2 * QUARTER } else { angle };
        rounded(angle, self.angle_decimals, Unit::Degree).into()
    }

    /// The words of a place.
    fn words(&self, place: [Nanos; 2]) -> [Coord; 2] {
        [0, 1].map(|i| ncc_ir::program::cycle::absolute(self.length(place[i])))
    }

    /// The ways to say where a pattern begins.
    fn starts(&self, said: Option<&[Coord; 2]>, place: [Nanos; 2]) -> Vec<Option<[Coord; 2]>> {
        let mut starts = Vec::with_capacity(2);
        if self.caps.holes.pattern_start || self.caps.holes.circle_start != CircleStart::Either {
            let stands = || self.words(place);
            // An increment would count from where the form before has left the tool.
            let in_force = self.walk.at.modes.distance;
            let said = said.filter(|words| words.iter().all(|w| is_absolute(w, in_force)));
            starts.push(Some(said.cloned().unwrap_or_else(stands)));
        }
        if self.caps.holes.pattern_here && self.stands() == place.map(Some) {
            starts.push(None);
        }
        starts
    }

    /// Other forms that a pattern may have.
    fn forms(&self, pattern: &Pattern, places: &HolePositions) -> Vec<Pattern> {
        match (pattern, places) {
            (
                Pattern::Circle { centre, first, step, count },
                HolePositions::Circle { centre: c, first: f, .. },
            ) => self.circles(centre.as_ref(), first, step, *count, [*c, *f]),
            (
                Pattern::Line { start, angle, offset, pitch, count },
                HolePositions::Line { angle: a, pitch: p, .. },
            ) => {
                let mut forms = Vec::new();
                if let HolePositions::Line { start: s, .. } = places {
                    for start in self.starts(start.as_ref(), *s) {
                        let (angle, offset, pitch) = (angle.clone(), offset.clone(), pitch.clone());
                        forms.push(Pattern::Line { start, angle, offset, pitch, count: *count });
                    }
                }
                forms.extend(self.straight(places.get(0), a.rem_euclid(4 * QUARTER), *p, *count));
                forms
            }
            (
                Pattern::Grid { start, columns, rows, serpentine },
                HolePositions::Grid { start: s, columns: c, rows: r, counts, .. },
            ) => {
                let mut forms = Vec::new();
                if counts[1] <= 1 {
                    forms.extend(self.straight(*s, angle_of(*c), c.pitch, counts[0]));
                } else if counts[0] <= 1 {
                    forms.extend(self.straight(*s, angle_of(*r), r.pitch, counts[1]));
                }
                for start in self.starts(start.as_ref(), *s) {
                    let row = |row: &Row, step: Step| self.rows(row, step);
                    for columns in row(columns, *c) {
                        for rows in row(rows, *r) {
                            let (start, columns, serpentine) = (start.clone(), columns.clone(), *serpentine);
                            forms.push(Pattern::Grid { start, columns, rows, serpentine });
                        }
                    }
                }
                forms
            }
            _ => Vec::new(),
        }
    }

    fn circles(
        &self,
        said: Option<&[Coord; 2]>,
        first: &First,
        step: &Expr,
        count: u32,
        [centre, place]: [[Nanos; 2]; 2],
    ) -> Vec<Pattern> {
        let (x, y) = ((place[0] - centre[0]) as f64, (place[1] - centre[1]) as f64);
        let other = match first {
            First::Polar { .. } => First::At(self.words(place)),
            First::At(_) => {
                let angle = (y.atan2(x).to_degrees() * ONE as f64).round() as Nanos;
                let angle = Num::from_nanos(angle, self.angle_decimals, Unit::Degree);
                First::Polar { radius: self.length(x.hypot(y).round() as Nanos), angle: angle.into() }
            }
        };
        let mut forms = Vec::new();
        for first in [first.clone(), other] {
            // About where the tool is, if it can be said so: that needs no words.
            for centre in self.starts(said, centre).into_iter().rev() {
                forms.push(Pattern::Circle { centre, first: first.clone(), step: step.clone(), count });
            }
        }
        forms
    }

    /// Lines and grids of one row of holes on a straight line.
    fn straight(&self, first: [Nanos; 2], angle: Nanos, pitch: Nanos, count: u32) -> Vec<Pattern> {
        let (angle, pitch) = if pitch < 0 { (angle + 2 * QUARTER, -pitch) } else { (angle, pitch) };
        let mut forms = Vec::new();
        let words = self.words(first);
        for start in self.starts(Some(&words), first) {
            let (offset, pitch) = (self.length(0), self.length(pitch));
            forms.push(Pattern::Line { start, angle: self.degrees(angle), offset, pitch, count });
        }
        let quarters = (angle % QUARTER == 0).then(|| (angle / QUARTER).rem_euclid(4));
        for start in self.starts(Some(&words), first) {
            let row = |along, pitch, count| Row { along, pitch: self.length(pitch), count };
            let axis = |side: usize| Along::Axis(self.axes[side]);
            let (columns, rows) = match quarters {
                Some(0) => (row(axis(0), pitch, count), row(axis(1), 0, 1)),
                Some(2) => (row(axis(0), -pitch, count), row(axis(1), 0, 1)),
                Some(1) => (row(axis(0), 0, 1), row(axis(1), pitch, count)),
                Some(_) => (row(axis(0), 0, 1), row(axis(1), -pitch, count)),
                None => {
                    let along = |angle| Along::Angle(self.degrees(angle));
                    (row(along(angle), pitch, count), row(along(angle + QUARTER), 0, 1))
                }
            };
            let serpentine = self.caps.holes.grid_way == GridWay::Serpentine;
            forms.push(Pattern::Grid { start, columns, rows, serpentine });
        }
        forms
    }

    /// The ways to say a direction of a grid: as it is, along an axis, at an angle.
    fn rows(&self, row: &Row, step: Step) -> Vec<Row> {
        let mut all = vec![row.clone()];
        let angle = angle_of(step);
        let (angle, pitch) =
            if step.pitch < 0 { (angle + 2 * QUARTER, -step.pitch) } else { (angle, step.pitch) };
        if angle % QUARTER == 0 {
            let quarters = (angle / QUARTER).rem_euclid(4);
            let side = (quarters % 2) as usize;
            let pitch = self.length(if quarters < 2 { pitch } else { -pitch });
            all.push(Row { along: Along::Axis(self.axes[side]), pitch, count: row.count });
        }
        let pitch = self.length(pitch);
        all.push(Row { along: Along::Angle(self.degrees(angle)), pitch, count: row.count });
        all
    }

    /// A list of positions as lists of as many as the target takes.
    fn lists(&self, points: &[Point], places: Option<&HolePositions>) -> Option<Vec<Pattern>> {
        let upto = self.caps.holes.list_upto as usize;
        if upto == 0 || points.is_empty() {
            return None;
        }
        let mut points = points.to_vec();
        if !self.caps.holes.pattern_here {
            for (k, point) in points.iter_mut().enumerate() {
                for (i, axis) in self.axes.into_iter().enumerate() {
                    if point.get(axis).is_none() {
                        let place = places?.get(u32::try_from(k).ok()?);
                        point.set(axis, at(place[i], axis, self.unit));
                    }
                }
            }
        }
        Some(points.chunks(upto).map(|part| Pattern::List(part.to_vec())).collect())
    }
}

/// The direction of a step, degrees from the plane's first axis.
fn angle_of(step: Step) -> Nanos {
    match step.along {
        Ok(0) => 0,
        Ok(_) => QUARTER,
        Err(angle) => angle.rem_euclid(4 * QUARTER),
    }
}
