//! Lowering of patterns of hole positions that are called with arguments.
//!
//! The positions are not made here: a pattern stays a pattern. A control may begin a line or a grid
//! where it is nearest to the tool; that it takes the order of the arguments is an assumption that is reported,
//! unless the tool stands at the first hole.

use ncc_dialects::{CallKind, CallRow, ParameterRole};
use ncc_ir::canon::{Axis, Plane};
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::{Num, ONE, Unit};
use ncc_ir::expr::{Binary, Expr, Node, Unary};
use ncc_ir::geometry::polar;
use ncc_ir::program::cycle::{Along, First, Pattern, Row, absolute};
use ncc_ir::program::{Coord, Op, Point};
use ncc_ir::unsupported::CycleUnsupported;

use super::drilling::Arguments;
use crate::batch::Batch;
use crate::common::Source;
use crate::common::number::unit_of;
use crate::siemens::block_words::Given;
use crate::siemens::lower::Lower;
use crate::siemens::program::repeated_blocks::CYCLE;
use crate::siemens::siemens_state::ModalCall;
use crate::siemens::text::tree::Called;

/// Most holes of a pattern, along one direction.
const MOST_HOLES: i64 = 9999;

/// Flags of positions that are all absolute.
const ALL_ABSOLUTE: i64 = 111_111_111;

impl Lower {
    /// A pattern that is called: the active cycle at each of its positions.
    pub(in crate::siemens) fn pattern(
        &mut self,
        row: &'static CallRow,
        called: &Called,
        src: Source,
        out: &mut Batch,
    ) {
        self.repeated_blocks.use_fact(CYCLE);
        if self.state.cycle == ModalCall::None {
            self.fault(Fault::NoCycle, called.span, out);
        }
        if matches!(self.state.cycle, ModalCall::Subprogram(_)) {
            let what = CycleUnsupported::PatternOfSubprogram;
            return self.not_supported(&row.name, what, called.span, out);
        }
        let Some(arguments) = self.arguments(row, called, src, out) else {
            return;
        };
        let Some(plane) = self.known_plane(called.span, out) else {
            return;
        };
        let Some((pattern, first)) = self.pattern_of(&arguments, plane, src, out) else {
            return;
        };
        if self.now.failed {
            return;
        }
        if row.order_by_position && !self.stands_at(plane, first) && self.first_time(&row.name) {
            let pattern = row.name.as_str().into();
            out.report(Fault::AssumedHoleOrder { pattern }, called.span);
        }
        self.rely_on_frames(true, called.span, out);
        if let ModalCall::Active(cycle) = &self.state.cycle {
            let cycle = cycle.clone();
            if cycle.relies_on_feed() {
                self.rely_on_feed(called.span, out);
            }
            self.call_up_again(&cycle, called.span, out);
            self.hole_made(&cycle);
            self.moved = None;
        }
        self.push(called.span, Op::Pattern(Box::new(pattern)), out);
        self.stand.forget();
    }

    /// Whether the tool stands at a place of the plane, or there is only one.
    fn stands_at(&self, plane: Plane, first: Option<[Num; 2]>) -> bool {
        let Some(first) = first else {
            return true;
        };
        let (a, b, _) = plane.axes();
        [a, b].into_iter().zip(first).all(|(axis, at)| {
            let stands = self.stand.axes.get(axis as usize).copied().flatten();
            stands.is_some_and(|s| s.unit == at.unit && s.nanos(false) == at.nanos(false))
        })
    }

    /// The pattern, and its first hole if the order of the holes is open.
    fn pattern_of(
        &mut self,
        a: &Arguments,
        plane: Plane,
        src: Source,
        out: &mut Batch,
    ) -> Option<(Pattern, Option<[Num; 2]>)> {
        match a.row.kind {
            CallKind::List => Some((Pattern::List(self.points(a, plane, src, out)?), None)),
            CallKind::Grid => self.grid(a, plane, src, out),
            CallKind::Circle => Some((self.circle(a, src, out)?, None)),
            CallKind::Line => self.line(a, src, out),
            CallKind::Drill
            | CallKind::DrillDwell
            | CallKind::DrillPeck
            | CallKind::Bore
            | CallKind::Tap
            | CallKind::TapRigid
            | CallKind::BoreFine
            | CallKind::BoreStop => None,
        }
    }

    /// Centre of a circle, or the beginning of a line.
    fn start(&mut self, a: &Arguments, src: Source, out: &mut Batch) -> Option<[Coord; 2]> {
        let x = self.needed_value(a, ParameterRole::First, src, out)?;
        let y = self.needed_value(a, ParameterRole::Second, src, out)?;
        Some([absolute(x), absolute(y)])
    }

    /// Holes on a circle.
    fn circle(&mut self, a: &Arguments, src: Source, out: &mut Batch) -> Option<Pattern> {
        use ParameterRole as Role;
        let centre = self.start(a, src, out)?;
        let angle = self.value(a, Role::Angle, src, out).unwrap_or(Num::int(0, Unit::Degree).into());
        let radius = self.needed_value(a, Role::Radius, src, out)?;
        match radius.literal() {
            Some(radius) if radius.mantissa <= 0 => return self.out_of_range(a, Role::Radius, out),
            Some(_) => {}
            None => {
                // The cycle ends the program by an alarm where it is not (reference, 9).
                let assumption = ControlFact::ComputedRadius { name: a.name(Role::Radius).into() };
                out.report(Fault::AssumedFact { fact: assumption }, a.at(Role::Radius));
            }
        }
        let count = self.count(a, Role::Count, src, out)?;
        let step = self.step(a, count, src, out)?;
        Some(Pattern::Circle { centre: Some(centre), first: First::Polar { radius, angle }, step, count })
    }

    /// Holes on a line.
    fn line(&mut self, a: &Arguments, src: Source, out: &mut Batch) -> Option<(Pattern, Option<[Num; 2]>)> {
        use ParameterRole as Role;
        let zero = Num::int(0, unit_of(self.units(a.span, out)));
        let start = self.start(a, src, out)?;
        let angle = self.value(a, Role::Angle, src, out).unwrap_or(Num::int(0, Unit::Degree).into());
        let count = self.count(a, Role::Count, src, out)?;
        let offset = self.value(a, Role::Offset, src, out).unwrap_or(zero.into());
        let pitch = match count {
            1 => self.value(a, Role::Pitch, src, out).unwrap_or(zero.into()),
            _ => self.needed_value(a, Role::Pitch, src, out)?,
        };
        let first = match [&start[0].value, &start[1].value, &offset, &angle].map(Expr::literal) {
            [Some(x), Some(y), Some(offset), _] if offset.is_zero() => Some([x, y]),
            [Some(x), Some(y), Some(offset), Some(angle)] => shifted([x, y], offset, angle),
            _ => None,
        };
        // Without a known first hole the tool stands elsewhere.
        let nowhere = [Num { unit: Unit::One, ..zero }; 2];
        let first = (count > 1).then_some(first.unwrap_or(nowhere));
        Some((Pattern::Line { start: Some(start), angle, offset, pitch, count }, first))
    }

    /// From hole to hole on a circle: the angle that is written, or the circle shared out.
    fn step(&mut self, a: &Arguments, count: u32, src: Source, out: &mut Batch) -> Option<Expr> {
        let role = ParameterRole::Step;
        if a.get(role).is_none() {
            return Some(Expr::Num(share(count)));
        }
        let step = self.value(a, role, src, out)?;
        match step.literal() {
            Some(step) if step.is_zero() => Some(Expr::Num(share(count))),
            None if !is_never_zero(&step) => {
                // The control shares the circle out where it is 0.
                let what = CycleUnsupported::StepComputed { parameter: a.name(role).into() };
                self.not_supported(&a.row.name, what, a.at(role), out);
                None
            }
            Some(_) | None => Some(step),
        }
    }

    /// Rows of holes.
    fn grid(
        &mut self,
        a: &Arguments,
        plane: Plane,
        src: Source,
        out: &mut Batch,
    ) -> Option<(Pattern, Option<[Num; 2]>)> {
        use ParameterRole as Role;
        let x = self.needed(a, Role::First, src, out)?;
        let y = self.needed(a, Role::Second, src, out)?;
        let start = Some([absolute(x), absolute(y)]);
        let angle = self.argument(a, Role::Angle, src, out).unwrap_or(Num::int(0, Unit::Degree));
        let zero = Num::int(0, x.unit);
        let columns = self.count(a, Role::Columns, src, out)?;
        let rows = self.count(a, Role::Rows, src, out)?;
        let across = self.pitch(a, Role::ColumnPitch, columns, zero, src, out)?;
        let up = self.pitch(a, Role::RowPitch, rows, zero, src, out)?;
        let right = self.sum(a, angle, Num::int(90, Unit::Degree), out)?;
        let (first, second, _) = plane.axes();
        let begins = (columns * rows > 1).then_some([x, y]);
        match self.whole_of(a, Role::Way) {
            Some(0) => {}
            // In two rows, or two columns of one, every position is on the border, in this order.
            Some(1) if rows <= 2 || columns == 1 => {}
            Some(1) => {
                let (angles, pitches) = ([angle, right], [across, up]);
                let points = border([x, y], angles, pitches, [columns, rows]);
                let Some(points) = points else { return self.out_of_range(a, Role::ColumnPitch, out) };
                let point = |[x, y]: [Num; 2]| {
                    let mut point = Point::default();
                    point.set(first, absolute(x));
                    point.set(second, absolute(y));
                    point
                };
                return Some((Pattern::List(points.into_iter().map(point).collect()), begins));
            }
            _ => {
                let what = CycleUnsupported::PatternOrder { parameter: a.name(Role::Way).into() };
                self.not_supported(&a.row.name, what, a.at(Role::Way), out);
                return None;
            }
        }
        let row = |axis: Axis, turned: Num, pitch: Num, count: u32| Row {
            along: if angle.is_zero() { Along::Axis(axis) } else { Along::Angle(Expr::Num(turned)) },
            pitch: Expr::Num(pitch),
            count,
        };
        let pattern = Pattern::Grid {
            start,
            columns: row(first, angle, across, columns),
            rows: row(second, right, up, rows),
            serpentine: true,
        };
        Some((pattern, begins))
    }

    /// A distance that counts only where there is more than one hole.
    fn pitch(
        &mut self,
        a: &Arguments,
        role: ParameterRole,
        count: u32,
        zero: Num,
        src: Source,
        out: &mut Batch,
    ) -> Option<Num> {
        match count {
            1 => Some(self.argument(a, role, src, out).unwrap_or(zero)),
            _ => self.needed(a, role, src, out),
        }
    }

    /// A number of holes, at least one.
    fn count(&mut self, a: &Arguments, role: ParameterRole, src: Source, out: &mut Batch) -> Option<u32> {
        match self.needed(a, role, src, out)?.whole_number() {
            Some(count @ 1..=MOST_HOLES) => u32::try_from(count).ok(),
            Some(_) | None => self.out_of_range(a, role, out),
        }
    }

    /// Positions one after another; all absolute.
    fn points(&mut self, a: &Arguments, plane: Plane, src: Source, out: &mut Batch) -> Option<Vec<Point>> {
        use ParameterRole as Role;
        for role in [Role::FirstFlags, Role::SecondFlags] {
            if self.needed(a, role, src, out)?.whole_number() != Some(ALL_ABSOLUTE) {
                self.not_supported(&a.row.name, CycleUnsupported::PointsNotAbsolute, a.span, out);
                return None;
            }
        }
        let side = |wanted: Role| -> Vec<Option<Given>> {
            let places = a.row.parameters.iter().enumerate().filter(|(_, p)| p.role == Some(wanted));
            places.map(|(place, _)| a.given.get(place).copied().flatten()).collect()
        };
        let (firsts, seconds) = (side(Role::PointFirst), side(Role::PointSecond));
        let (first, second, _) = plane.axes();
        let mut points = Vec::new();
        let mut gap = false;
        for pair in firsts.into_iter().zip(seconds) {
            let (x, y) = match pair {
                (None, None) => {
                    gap = true;
                    continue;
                }
                (Some(x), Some(y)) if !gap => (x, y),
                (x, y) => {
                    let at = x.or(y).map_or(a.span, |given| given.span);
                    self.not_supported(&a.row.name, CycleUnsupported::PointsGap, at, out);
                    return None;
                }
            };
            let mut point = Point::default();
            for (axis, given) in [(first, x), (second, y)] {
                let num = self.number(given, ncc_dialects::Quantity::Length, src, out)?;
                point.set(axis, absolute(num));
            }
            points.push(point);
        }
        if points.is_empty() {
            let (code, word) = (a.row.name.as_str().into(), "_X0".into());
            return self.refuse(Fault::WordMissing { code, word }, a.span, out);
        }
        Some(points)
    }
}

/// A full circle shared out among holes.
fn share(count: u32) -> Num {
    Num::from_nanos(360 * ONE / i64::from(count.max(1)), 9, Unit::Degree)
}

/// Whether a value can never be 0, whatever its variables hold.
fn is_never_zero(value: &Expr) -> bool {
    let Expr::Node(node) = value else { return value.literal().is_some_and(|n| !n.is_zero()) };
    match &**node {
        Node::Binary(Binary::Divide, share, _) => share.literal().is_some_and(|n| !n.is_zero()),
        Node::Unary(Unary::Negate, of) => is_never_zero(of),
        _ => false,
    }
}

/// A place at a distance and an angle from another, if it is exact along an axis.
/// Positions on the border of a grid, round it from the first: along the first row, up the last column, and back.
fn border(
    from: [Num; 2],
    [across, up]: [Num; 2],
    pitches: [Num; 2],
    [columns, rows]: [u32; 2],
) -> Option<Vec<[Num; 2]>> {
    let (last, top) = (columns - 1, rows - 1);
    let places = (0..columns)
        .map(|i| (i, 0))
        .chain((1..rows).map(|j| (last, j)))
        .chain((0..last).rev().map(|i| (i, top)))
        .chain((1..top).rev().map(|j| (0, j)));
    let times = |pitch: Num, n: u32| {
        let mantissa = pitch.mantissa.checked_mul(i64::from(n))?;
        Some(Num { mantissa, ..pitch })
    };
    places
        .map(|(i, j)| {
            let (along, over) = (times(pitches[0], i)?, times(pitches[1], j)?);
            match across.is_zero() {
                true => Some([from[0].plus(along)?, from[1].plus(over)?]),
                false => shifted(shifted(from, along, across)?, over, up),
            }
        })
        .collect()
}

fn shifted(from: [Num; 2], by: Num, angle: Num) -> Option<[Num; 2]> {
    // In its own unit, whatever that is.
    let [x, y] = polar(Num { unit: Unit::One, ..by }.nanos(false)?, angle.nanos(false)?);
    let along = |n: i64| Num::from_nanos(n, 9, by.unit);
    Some([from[0].plus(along(x))?, from[1].plus(along(y))?])
}
