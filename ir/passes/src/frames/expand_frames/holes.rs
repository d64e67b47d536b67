//! Cycles and patterns under a frame: a pattern stays one where it can be turned as a whole, else it is
//! expanded, a hole at a time.
//!
//! Refused: cycles whose drilling axis the frame turns, mirrors or scales.

use crate::frames::expand_frames::now::value_of;
use crate::frames::expand_frames::{Frames, NOTHING, cannot, leaves_alone};
use crate::holes::pattern_forms;
use crate::support::write::{exact, rounded, unit_of};
use ncc_ir::canon::{Axis, Fact, Plane};
use ncc_ir::diag::{Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num, ONE, POW10, Unit};
use ncc_ir::geometry::hole_positions::HolePositions;
use ncc_ir::lack::FramesLack;
use ncc_ir::program::cycle::{Along, Cycle, First, Pattern, Row, absolute};
use ncc_ir::program::{Coord, Move, Op, Point};

impl Frames<'_> {
    pub(super) fn cycle(&self, cycle: &Cycle) -> Result<Cycle, Fault> {
        let plane = self.inner.at.plane(cycle.plane);
        let plane = plane.ok_or(Fault::EntryFactNeeded { fact: ModeName::Plane })?;
        let (_, _, normal) = plane.axes();
        let n = normal as usize;
        if !leaves_alone(&self.set.chain, n) {
            return Err(cannot(FramesLack::DrillingAxisTurned));
        }
        let mut out = cycle.clone();
        out.plane = Fact::Known(plane);
        out.retract = self.shifted(&cycle.retract, normal)?;
        out.depth = self.shifted(&cycle.depth, normal)?;
        out.reference = cycle.reference.as_ref().map(|p| self.shifted(p, normal)).transpose()?;
        out.return_plane = cycle.return_plane.as_ref().map(|p| self.shifted(p, normal)).transpose()?;
        Ok(out)
    }

    pub(super) fn pattern(&self, pattern: &Pattern) -> Result<Vec<Op>, Fault> {
        let at = &self.inner.at;
        let plane = at.cycle.as_ref().map_or(Fact::Entry, |c| c.cycle.plane);
        let plane = at.plane(plane).ok_or(Fault::EntryFactNeeded { fact: ModeName::Plane })?;
        let (first, second, _) = plane.axes();
        let axes = [first, second];
        let off = axes.into_iter().any(|axis| self.is_rounded(axis as usize));
        if self.set.chain.turn().is_none() && !off && self.set.unplaced.is_none() {
            return Ok(vec![Op::Pattern(Box::new(self.shifted_pattern(pattern, axes)?))]);
        }
        let unknown = |axis: Axis| Fault::PositionUnknown { axis: axis.letter() as char };
        let places = at.hole_positions(pattern).filter(|p| p.count() <= pattern_forms::MOST_HOLES);
        let places = places.ok_or_else(|| {
            unknown(axes.into_iter().find(|a| at.position[*a as usize].is_none()).unwrap_or(first))
        })?;
        let outside = |place: [Nanos; 2]| {
            let mut p = at.position;
            (p[first as usize], p[second as usize]) = (Some(place[0]), Some(place[1]));
            let p = self.set.chain.place_known(&p);
            Ok::<_, Fault>([
                p[first as usize].ok_or_else(|| unknown(first))?,
                p[second as usize].ok_or_else(|| unknown(second))?,
            ])
        };
        let all: Vec<[Nanos; 2]> =
            (0..places.count()).map(|k| outside(places.get(k))).collect::<Result<_, _>>()?;
        let (f, s) = (first as usize, second as usize);
        let turn = self.set.chain.turn().filter(|m| {
            (m[f][f] - m[s][s]).abs() < NOTHING
                && (m[f][s] + m[s][f]).abs() < NOTHING
                && (m[f][f].hypot(m[s][f]) - 1.0).abs() < 1e-9
        });
        if let (Some(m), false, None) = (turn, off, self.set.unplaced) {
            let angle = (m[s][f].atan2(m[f][f]).to_degrees() * ONE as f64).round() as Nanos;
            if let Some(form) = self.turned(pattern, &places, angle, axes, &outside)?
                && self.says(&form, plane, &all)
            {
                return Ok(vec![Op::Pattern(Box::new(form))]);
            }
        }
        let unit = self.inner.unit();
        let hole = |place: &[Nanos; 2]| {
            let mut to = Point::default();
            for (axis, place) in axes.into_iter().zip(place) {
                to.set(axis, absolute(rounded(*place, self.decimals(), unit_of(axis, unit))));
            }
            Op::Hole(Move { to, said: false })
        };
        Ok(all.iter().map(hole).collect())
    }

    /// Whether the target has this very form, and its holes are where they must be.
    fn says(&self, form: &Pattern, plane: Plane, places: &[[Nanos; 2]]) -> bool {
        let at_once = pattern_forms::fit(self.outer, form, plane, self.target);
        let unit = self.inner.unit();
        let half = POW10[9 - self.target.decimals_in(unit).min(9) as usize];
        let half = if unit == Unit::Inch { half * 254 / 10 } else { half } / 2;
        let near = |a: &[Nanos; 2], b: &[Nanos; 2]| (0..2).all(|i| a[i].abs_diff(b[i]) <= half as u64);
        at_once.is_some_and(|forms| forms == [form.clone()])
            && self.outer.at.positions(form).is_some_and(|own| {
                own.len() == places.len() && own.iter().zip(places).all(|(a, b)| near(a, b))
            })
    }

    /// A pattern turned in its plane; `None` if that is better said by its holes.
    fn turned(
        &self,
        pattern: &Pattern,
        places: &HolePositions,
        by: Nanos,
        axes: [Axis; 2],
        outside: &dyn Fn([Nanos; 2]) -> Result<[Nanos; 2], Fault>,
    ) -> Result<Option<Pattern>, Fault> {
        let at = &self.inner.at;
        // With all digits, for what is computed from them later.
        let words = |place: [Nanos; 2]| {
            let (place, unit) = (outside(place)?, self.inner.unit());
            Ok::<_, Fault>([0, 1].map(|i| absolute(exact(place[i], unit_of(axes[i], unit)))))
        };
        let start = |said: &Option<[Coord; 2]>, place: [Nanos; 2]| match said {
            Some(_) => words(place).map(Some),
            None => Ok(None),
        };
        let further = |angle: Nanos| -> Expr {
            let whole = 360 * ONE;
            let angle = (angle.rem_euclid(whole) + by).rem_euclid(whole);
            let angle = if angle > 180 * ONE { angle - whole } else { angle };
            Num::from_nanos(angle, 9, Unit::Degree).into()
        };
        Ok(match (pattern, places) {
            (
                Pattern::Circle { centre, first, step, count },
                HolePositions::Circle { centre: c, first: f, .. },
            ) => {
                let first = match first {
                    // Two roundings would add up on the way round.
                    First::At(_) if !self.is_exact() => return Ok(None),
                    First::At(_) => First::At(words(*f)?),
                    First::Polar { radius, angle } => {
                        First::Polar { radius: radius.clone(), angle: further(value_of(at, angle)?) }
                    }
                };
                let centre = start(centre, *c)?;
                Some(Pattern::Circle { centre, first, step: step.clone(), count: *count })
            }
            (
                Pattern::Line { start: s, offset, pitch, count, .. },
                HolePositions::Line { start: place, angle, .. },
            ) => {
                let start = start(s, *place)?;
                let (offset, pitch) = (offset.clone(), pitch.clone());
                Some(Pattern::Line { start, angle: further(*angle), offset, pitch, count: *count })
            }
            (
                Pattern::Grid { start: s, columns, rows, serpentine },
                HolePositions::Grid { start: place, columns: c, rows: r, .. },
            ) => {
                let start = start(s, *place)?;
                let row = |row: &Row, along: Result<usize, Nanos>| Row {
                    along: Along::Angle(further(along.map_or_else(|a| a, |side| side as Nanos * 90 * ONE))),
                    pitch: row.pitch.clone(),
                    count: row.count,
                };
                let (columns, rows) = (row(columns, c.along), row(rows, r.along));
                Some(Pattern::Grid { start, columns, rows, serpentine: *serpentine })
            }
            _ => None,
        })
    }

    fn shifted_pattern(&self, pattern: &Pattern, axes: [Axis; 2]) -> Result<Pattern, Fault> {
        let mut out = pattern.clone();
        let shift = |pair: &mut [Coord; 2]| {
            for (word, axis) in pair.iter_mut().zip(axes) {
                *word = self.shifted(word, axis)?;
            }
            Ok::<_, Fault>(())
        };
        match &mut out {
            Pattern::Circle { centre, first, .. } => {
                centre.iter_mut().try_for_each(shift)?;
                if let First::At(first) = first {
                    shift(first)?;
                }
            }
            Pattern::Line { start, .. } | Pattern::Grid { start, .. } => {
                start.iter_mut().try_for_each(shift)?;
            }
            Pattern::List(points) => {
                for point in points {
                    for axis in axes {
                        if let Some(word) = &mut point.axes[axis as usize] {
                            *word = self.shifted(word, axis)?;
                        }
                    }
                }
            }
        }
        Ok(out)
    }
}
