//! Patterns of positions: a call for each kind.
//!
//! Where the control chooses the end at which it begins by where the tool is, a pattern that
//! does not begin there is reported as an assumption.

use ncc_dialects::{CallKind, CallRow, ParameterRole as Role};
use ncc_ir::canon::{Axis, Distance, Plane};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num, ONE, Unit};
use ncc_ir::lack::{HolesLack, PatternsLack, WordsLack};
use ncc_ir::program::cycle::{Along, First, Pattern, Row};
use ncc_ir::program::{Coord, Point, Stmt};
use ncc_ir::source::Span;

use super::cycle::Arguments;
use super::{Modal, Sink, Writer};
use crate::common::fault::cannot;

/// A full turn.
const TURN: Nanos = 360 * ONE;

/// A direction with its pitch made positive.
struct Direction {
    /// Degrees, in nanos, below a full turn.
    angle: Nanos,
    /// The program's own word for the angle, if that is the direction.
    said: Option<Expr>,
    pitch: Expr,
}

impl Writer {
    /// A pattern of holes with the active cycle.
    pub(super) fn pattern(&mut self, pattern: &Pattern, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        self.pay_call(sink)?;
        if self.standing.modal == Modal::Off {
            return Err(cannot(HolesLack::HolesOfUnknownCycle));
        }
        let kind = match pattern {
            Pattern::Circle { .. } => CallKind::Circle,
            Pattern::Line { .. } => CallKind::Line,
            Pattern::Grid { .. } => CallKind::Grid,
            Pattern::List(_) => CallKind::List,
        };
        let row = self.dialect.call_for(kind).ok_or_else(|| cannot(PatternsLack::Pattern))?;
        let plane = self.hole_plane().ok_or_else(|| cannot(HolesLack::PlaneOfHolesUnknown))?;
        let mut to = Arguments::new(row);
        let span = stmt.span;
        match pattern {
            Pattern::Circle { centre, first, step, count } => {
                self.corner(centre.as_ref(), plane, &mut to, span, sink)?;
                self.circle(first, step, *count, &mut to, span, sink)?;
            }
            Pattern::Line { start, angle, offset, pitch, count } => {
                self.corner(start.as_ref(), plane, &mut to, span, sink)?;
                self.line(angle, offset, pitch, &mut to, span, sink)?;
                self.argument(&mut to, Role::Count, &Expr::int((*count).into()), span, sink)?;
            }
            Pattern::Grid { start, columns, rows, serpentine } => {
                if !serpentine && columns.count > 1 && rows.count > 1 {
                    return Err(cannot(PatternsLack::GridOneDirection));
                }
                self.corner(start.as_ref(), plane, &mut to, span, sink)?;
                self.grid(columns, rows, plane, &mut to, span, sink)?;
            }
            Pattern::List(points) => self.list(pattern, points, plane, &mut to, span, sink)?,
        }
        self.tell_order(pattern, plane, row, span, sink);
        self.tell_unsure(row, "PATTERN", span, sink);
        self.alone(&to.text(), sink)
    }

    fn tell_order(&self, pattern: &Pattern, plane: Plane, row: &CallRow, span: Span, sink: &mut Sink) {
        let (first, second, _) = plane.axes();
        let holes = self.words.tracker.positions(pattern);
        let at = [first, second].map(|axis| self.words.tracker.position[axis as usize]);
        let begins_here = holes.as_ref().is_some_and(|holes| match holes.as_slice() {
            [] | [_] => true,
            [begin, ..] => at == begin.map(Some),
        });
        if row.order_by_position && !begins_here {
            sink.report(Fault::AssumedHoleOrder { pattern: row.name.as_str().into() }, span);
        }
    }

    /// Centre or start, absolute; where the tool is if the pattern does not say it.
    fn corner(
        &mut self,
        words: Option<&[Coord; 2]>,
        plane: Plane,
        to: &mut Arguments,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let (first, second, _) = plane.axes();
        for (side, (axis, role)) in [(first, Role::First), (second, Role::Second)].into_iter().enumerate() {
            let letter = self.parameter(to.row, role);
            let here = self.words.tracker.position[axis as usize];
            let text = match words.map(|words| &words[side]) {
                Some(word) if self.is_absolute(word) => self.value(&letter, &word.value, span, sink)?,
                Some(word) => self.known(self.words.tracker.resolve(word, here), axis, to.row, role)?,
                None => self.known(here, axis, to.row, role)?,
            };
            to.put(role, text)?;
        }
        Ok(())
    }

    fn is_absolute(&self, word: &Coord) -> bool {
        word.distance.known().or(self.words.active.distance) == Some(Distance::Absolute)
    }

    fn known(&self, at: Option<Nanos>, axis: Axis, row: &CallRow, role: Role) -> Result<String, Fault> {
        let at = at.ok_or(Fault::PositionUnknown { axis: axis.letter() as char })?;
        self.length(at, &self.parameter(row, role))
    }

    fn circle(
        &mut self,
        first: &First,
        step: &Expr,
        count: u32,
        to: &mut Arguments,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let First::Polar { radius, angle } = first else {
            return Err(cannot(PatternsLack::CircleByFirstHole));
        };
        self.argument(to, Role::Radius, radius, span, sink)?;
        self.argument(to, Role::Angle, angle, span, sink)?;
        let Some(n) = step.literal() else {
            self.argument(to, Role::Step, step, span, sink)?;
            return self.argument(to, Role::Count, &Expr::int(count.into()), span, sink);
        };
        if n.is_zero() && count > 1 {
            return Err(cannot(PatternsLack::CircleInOnePlace));
        }
        // A full circle is shared out by the control: better than an angle that must be rounded.
        let letter = self.parameter(to.row, Role::Step);
        let shares = n.scale > letter.format.decimals_for(Unit::Degree) && is_full(n, count);
        match shares {
            true => to.put(Role::Step, "0".into())?,
            false => self.argument(to, Role::Step, step, span, sink)?,
        }
        self.argument(to, Role::Count, &Expr::int(count.into()), span, sink)
    }

    fn line(
        &mut self,
        angle: &Expr,
        offset: &Expr,
        pitch: &Expr,
        to: &mut Arguments,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let row = Row { along: Along::Angle(angle.clone()), pitch: pitch.clone(), count: 2 };
        let way = self.direction(&row, None)?;
        let turned = way.pitch != *pitch;
        let offset = match (turned, offset.literal()) {
            (true, Some(n)) => Expr::Num(Num { mantissa: n.mantissa.saturating_neg(), ..n }),
            _ => offset.clone(),
        };
        if offset.literal().is_some_and(|n| n.mantissa < 0) {
            return Err(cannot(PatternsLack::LineAwayFromStart));
        }
        self.angle(&way, to, span, sink)?;
        self.argument(to, Role::Offset, &offset, span, sink)?;
        self.argument(to, Role::Pitch, &way.pitch, span, sink)
    }

    fn grid(
        &mut self,
        columns: &Row,
        rows: &Row,
        plane: Plane,
        to: &mut Arguments,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let mut along = self.direction(columns, Some(plane))?;
        let across = self.direction(rows, Some(plane))?;
        let quarter = TURN / 4;
        if columns.count <= 1 && rows.count > 1 {
            // A single column: the rows alone give the direction.
            (along.angle, along.said) = ((across.angle + TURN - quarter) % TURN, None);
        }
        let square = (along.angle + quarter) % TURN == across.angle;
        if !square && columns.count > 1 && rows.count > 1 {
            return Err(cannot(PatternsLack::GridNotSquare));
        }
        self.angle(&along, to, span, sink)?;
        self.argument(to, Role::ColumnPitch, &along.pitch, span, sink)?;
        self.argument(to, Role::RowPitch, &across.pitch, span, sink)?;
        self.argument(to, Role::Columns, &Expr::int(columns.count.into()), span, sink)?;
        self.argument(to, Role::Rows, &Expr::int(rows.count.into()), span, sink)
    }

    /// A direction of a pattern. Without a plane, only one by an angle.
    fn direction(&self, row: &Row, plane: Option<Plane>) -> Result<Direction, Fault> {
        let axes = plane.map(Plane::axes);
        let (mut angle, mut said) = match &row.along {
            Along::Angle(angle) => {
                let nanos = angle.literal().and_then(|n| n.nanos(false));
                (nanos.ok_or_else(|| cannot(WordsLack::ComputedValue))?.rem_euclid(TURN), Some(angle.clone()))
            }
            Along::Axis(axis) if axes.is_some_and(|a| a.0 == *axis) => (0, None),
            Along::Axis(axis) if axes.is_some_and(|a| a.1 == *axis) => (TURN / 4, None),
            Along::Axis(_) => return Err(cannot(PatternsLack::RowAxis)),
        };
        let n = row.pitch.literal().ok_or_else(|| cannot(WordsLack::ComputedValue))?;
        let pitch = Expr::Num(Num { mantissa: n.mantissa.saturating_abs(), ..n });
        if n.mantissa < 0 {
            (angle, said) = ((angle + TURN / 2) % TURN, None);
        }
        Ok(Direction { angle, said, pitch })
    }

    fn angle(
        &mut self,
        way: &Direction,
        to: &mut Arguments,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        match &way.said {
            Some(angle) => self.argument(to, Role::Angle, angle, span, sink),
            None => {
                let text = self.near(way.angle, &self.parameter(to.row, Role::Angle), Unit::Degree)?;
                to.put(Role::Angle, text)
            }
        }
    }

    /// Positions one after another, all absolute.
    fn list(
        &mut self,
        pattern: &Pattern,
        points: &[Point],
        plane: Plane,
        to: &mut Arguments,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let most = to.row.parameters.iter().filter(|p| p.role == Some(Role::PointFirst)).count();
        if points.is_empty() || points.len() > most {
            return Err(cannot(PatternsLack::ListLength { most }));
        }
        let holes = self.words.tracker.positions(pattern);
        let (first, second, _) = plane.axes();
        let sides =
            [(first, Role::PointFirst, Role::FirstFlags), (second, Role::PointSecond, Role::SecondFlags)];
        for (side, (axis, role, flags)) in sides.into_iter().enumerate() {
            let letter = self.parameter(to.row, role);
            let mut texts: Vec<String> = Vec::new();
            for (k, point) in points.iter().enumerate() {
                let place = holes.as_ref().map(|holes| holes[k][side]);
                let text = match (point.get(axis), texts.last()) {
                    (Some(word), _) if self.is_absolute(word) => {
                        self.value(&letter, &word.value, span, sink)?
                    }
                    (None, Some(last)) => last.clone(),
                    (Some(_), _) | (None, None) => self.known(place, axis, to.row, role)?,
                };
                texts.push(text);
            }
            to.put_all(role, texts);
            to.put(flags, "1".repeat(most))?;
        }
        Ok(())
    }
}

/// Whether steps make a full circle, to less than a control can tell.
fn is_full(step: Num, count: u32) -> bool {
    let fine = 10f64.powi(i32::from(step.scale));
    let round = step.mantissa as f64 / fine * f64::from(count);
    (round - 360.0).abs() < 1e-6
}
