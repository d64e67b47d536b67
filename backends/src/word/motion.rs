//! Moves: arcs, and moves to reference points.
//!
//! An arc's centre is written in the dialect's own form, computed where it has to be from where the written text itself
//! puts the tool.
//!
//! Not here: straight moves (`common::words`).

use std::borrow::Cow;

use ncc_ir::canon::{Axis, Distance, Fact, Motion, Units};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num, Unit};
use ncc_ir::geometry;
use ncc_ir::geometry::arc_solver::MOST_SHORT;
use ncc_ir::lack::{ArcsLack, MachineLack, WordsLack};
use ncc_ir::program::{Arc, Centre, CentreFrom, Coord, Reference, ReferencePoint};
use ncc_ir::source::Span;

use super::Writer;
use crate::common::block::{Need, Part, Rank};
use crate::common::codes::Letter;
use crate::common::fault::{cannot, unwritable};
use crate::common::number::WordValue;
use crate::common::setting::Inserted;
use crate::common::{Sink, number};

/// Words of an arc's centre or radius, ready to be written.
type CentreWords = [Option<(u8, WordValue)>; 3];

impl Writer {
    /// A move to a reference point, through the intermediate point that it names or of where it stands.
    pub(crate) fn reference(&mut self, to: &Reference, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let (point, number) = match to.point {
            ReferencePoint::Further(n) => (ReferencePoint::Further(0), Some(n)),
            point => (point, None),
        };
        let row = self.words.codes.references.iter().find(|(own, ..)| *own == point);
        let (_, code, letter) = *row.ok_or_else(|| cannot(MachineLack::FurtherPoint))?;
        let mut via = to.via.clone();
        // To a stored position all axes go without a word of any.
        let stored = matches!(to.point, ReferencePoint::Stored(_)) && via.is_empty();
        let all = stored && to.axes == self.words.codes.axes.map(|axis| axis.is_some());
        for axis in Axis::ALL.into_iter().filter(|_| !all) {
            if to.axes[axis as usize] && via.get(axis).is_none() {
                let value = Expr::Num(Num::int(0, Unit::Entry));
                via.set(axis, Coord { value, distance: Fact::Known(Distance::Incremental) });
            }
        }
        let mut inserted = Inserted::default();
        self.words.need_distance(via.axes.iter().flatten(), &mut inserted)?;
        let need = self.words.point_need(Need::new(Rank::Motion), &via)?.code(Some(code));
        let need =
            if let (Some(letter), Some(_)) = (letter, number) { need.letter(letter.letter) } else { need };
        self.words.admit_with(need, inserted, sink)?;
        self.words.block.code(Part::Motion, &code);
        if let (Some(letter), Some(number)) = (letter, number) {
            let number = Expr::int(i64::from(number));
            let number = self.words.value(&letter, &number, span, sink)?;
            self.words.block.word(Part::Motion, letter.letter, number);
        }
        self.words.point(&via, span, sink)?;
        // Nothing that rounding has left is known of these axes any more.
        for (residue, goes) in self.words.residue.iter_mut().zip(to.axes) {
            if goes {
                *residue = 0;
            }
        }
        Ok(())
    }

    /// An arc or helix.
    pub(crate) fn arc(&mut self, arc: &Arc, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        if let Some(line) = self.words.as_line(arc) {
            return self.words.straight(&line, false, span, sink);
        }
        let motion = Motion::Arc(arc.turn);
        let code = self.words.codes.arcs[arc.turn as usize].ok_or_else(|| cannot(ArcsLack::Arc))?;
        let turns = match (arc.turns.is_none(), self.words.codes.turns) {
            (true, _) => None,
            (false, None) => return Err(cannot(ArcsLack::SeveralTurns)),
            (false, Some(letter)) => {
                Some((letter.letter, self.words.value(&letter, &arc.turns.all(), span, sink)?))
            }
        };
        let mut inserted = Inserted::default();
        self.words.need_distance(arc.to.axes.iter().flatten(), &mut inserted)?;
        self.words.need_plane(arc.plane, &mut inserted)?;
        if !self.dialect.arc.helix && self.leaves_plane(arc) {
            return Err(cannot(ArcsLack::ThirdAxis));
        }
        let start = self.words.residue;
        let full = self.words.becomes_full(arc);
        let arc = &*self.with_end(arc)?;
        let centre = self.centre(arc, span, sink)?;
        let mut need = self.words.point_need(Need::new(Rank::Motion), &arc.to)?;
        for (letter, _) in centre.iter().flatten() {
            need = need.letter(*letter);
        }
        if let Some((letter, _)) = turns {
            need = need.letter(letter);
        }
        let says = arc.said || self.words.active.motion != Some(motion);
        let need = if says { need.code(Some(code)) } else { need };
        self.words.admit_with(need, inserted, sink)?;
        if says {
            self.words.block.code(Part::Motion, &code);
        }
        self.words.active.motion = Some(motion);
        self.words.point(&arc.to, span, sink)?;
        for (letter, value) in centre.into_iter().flatten() {
            self.words.block.word(Part::Axes, letter, value);
        }
        if let Some((letter, turns)) = turns {
            self.words.block.word(Part::Axes, letter, turns);
        }
        self.words.put_corner();
        if full { Ok(()) } else { self.words.check_vanished(arc, start) }
    }

    /// An arc with a word of its end in its plane, for a control that needs one: a full circle ends where it starts.
    fn with_end<'a>(&self, arc: &'a Arc) -> Result<Cow<'a, Arc>, Fault> {
        let plane = arc.plane.known().or(self.words.active.plane);
        let Some((first, second, _)) =
            plane.map(|plane| plane.axes()).filter(|_| self.dialect.arc.end_needed)
        else {
            return Ok(Cow::Borrowed(arc));
        };
        if arc.to.get(first).is_some() || arc.to.get(second).is_some() {
            return Ok(Cow::Borrowed(arc));
        }
        let (Some(distance), Some(letter)) =
            (self.words.active.distance, self.words.codes.axes[first as usize])
        else {
            return Err(cannot(ArcsLack::CircleModeUnknown));
        };
        let value = match (distance, self.words.active.units) {
            (Distance::Incremental, _) => Num::int(0, Unit::Entry),
            (Distance::Absolute, Some(units)) => {
                let unit = if units == Units::Inch { Unit::Inch } else { Unit::Mm };
                number::from_nanos(self.words.axis_position(first)?, &letter.format, unit)
            }
            (Distance::Absolute, None) => return Err(cannot(ArcsLack::CircleUnitUnknown)),
        };
        let mut arc = arc.clone();
        arc.to.set(first, Coord { value: Expr::Num(value), distance: Fact::Known(distance) });
        Ok(Cow::Owned(arc))
    }

    /// Whether an arc supports a linear axis outside its plane.
    fn leaves_plane(&self, arc: &Arc) -> bool {
        let normal = arc.plane.known().or(self.words.active.plane).map(|p| p.axes().2);
        arc.to.axes.iter().enumerate().any(|(at, word)| {
            word.is_some() && (at > Axis::Z as usize || normal.is_some_and(|n| n as usize == at))
        })
    }

    /// The words that say an arc's centre.
    fn centre(&mut self, arc: &Arc, span: Span, sink: &mut Sink) -> Result<CentreWords, Fault> {
        let absolute = self.dialect.arc.centre_absolute;
        match (&arc.centre, self.words.codes.radius) {
            (Centre::Radius(radius), Some(letter)) => {
                let value = self.words.value(&letter, radius, span, sink)?;
                Ok([Some((letter.letter, value)), None, None])
            }
            (Centre::Point { words, from }, _) if absolute == (*from == CentreFrom::Zero) => {
                let plane = arc.plane.known().or(self.words.active.plane);
                let mut written = [None; 3];
                for axis in [Axis::X, Axis::Y, Axis::Z] {
                    let outside = plane.is_some_and(|p| p.axes().2 == axis);
                    if let Some(word) = words[axis as usize].as_ref().filter(|_| !outside) {
                        let letter = self.words.centre_letter(axis)?;
                        let value = self.centre_value(&letter, axis, word, *from, span, sink)?;
                        written[axis as usize] = Some((letter.letter, value));
                    }
                }
                Ok(written)
            }
            (Centre::Point { .. } | Centre::Radius(_), _) => self.computed_centre(arc, span, sink),
        }
    }

    /// A word of a centre. If it is measured from a start that was rounded, it is changed by as much: the
    /// centre stays where it is.
    fn centre_value(
        &mut self,
        letter: &Letter,
        axis: Axis,
        word: &Expr,
        from: CentreFrom,
        span: Span,
        sink: &mut Sink,
    ) -> Result<WordValue, Fault> {
        match word {
            Expr::Num(_) => {
                self.words.centre_number(letter, axis, word, from, span, sink).map(WordValue::Number)
            }
            Expr::Node(_) => self.words.computed(letter, word, span, sink),
        }
    }

    /// A centre in the other form than the source's.
    pub(crate) fn computed_centre(
        &mut self,
        arc: &Arc,
        span: Span,
        sink: &mut Sink,
    ) -> Result<CentreWords, Fault> {
        let plane = arc.plane.known().or(self.words.active.plane);
        let plane = plane.ok_or_else(|| cannot(ArcsLack::PlaneUnknown))?;
        let (first, second, _) = plane.axes();
        let absolute = self.dialect.arc.centre_absolute;
        let unit = match self.words.active.units {
            Some(Units::Mm) => Unit::Mm,
            Some(Units::Inch) => Unit::Inch,
            None => return Err(cannot(ArcsLack::CentreUnitUnknown)),
        };
        let centre = match &arc.centre {
            // Both from the start: a centre word becomes a difference or a sum, exactly.
            Centre::Point { words, from } => {
                let mut along = [0; 2];
                for (to, axis) in along.iter_mut().zip([first, second]) {
                    let word = match &words[axis as usize] {
                        Some(word) => Some(self.length(word, span)?),
                        None => None,
                    };
                    *to = match (from, word) {
                        (CentreFrom::Start, word) => {
                            // From where the program's arc starts: rounding that has not moved the centre.
                            self.words
                                .axis_position(axis)?
                                .checked_add(self.words.residue[axis as usize])
                                .and_then(|start| start.checked_add(word.unwrap_or(0)))
                        }
                        (CentreFrom::Zero, Some(word)) => word.checked_sub(self.words.axis_position(axis)?),
                        (CentreFrom::Zero, None) => Some(0),
                    }
                    .ok_or_else(|| cannot(ArcsLack::CentreTooFar))?;
                }
                along
            }
            Centre::Radius(radius) => {
                let radius = self.length(radius, span)?;
                let start = [self.words.axis_position(first)?, self.words.axis_position(second)?];
                let end = [self.words.arrives(arc, first)?, self.words.arrives(arc, second)?];
                let centre = geometry::centre_by_radius(start, end, radius, arc.turn, MOST_SHORT);
                let centre = centre.map_err(|fault| match fault {
                    geometry::ArcFault::NoWay | geometry::ArcFault::Straight => Fault::ArcRadiusNoWay,
                    geometry::ArcFault::RadiusTooSmall
                    | geometry::ArcFault::EndOffCircle { .. }
                    | geometry::ArcFault::NoRadius => Fault::ArcRadiusTooSmall,
                })?;
                match absolute {
                    true => centre,
                    false => [centre[0] - start[0], centre[1] - start[1]],
                }
            }
        };
        sink.report(Fault::ArcReformatted, span);
        let mut written = [None; 3];
        for (axis, along) in [first, second].into_iter().zip(centre) {
            let letter = self.words.centre_letter(axis)?;
            let n = number::from_nanos(along, &letter.format, unit);
            let value = number::shape(n, &letter.format).map_err(|w| unwritable(w, letter.letter, n))?;
            written[axis as usize] = Some((letter.letter, value.into()));
        }
        Ok(written)
    }

    /// A length in nanos.
    pub(crate) fn length(&mut self, value: &ncc_ir::expr::Expr, span: Span) -> Result<Nanos, Fault> {
        let n = value.literal().ok_or_else(|| cannot(WordsLack::ComputedValue))?;
        self.words.check_unit(n, span)?;
        let inch = self.words.active.units == Some(Units::Inch);
        n.nanos(inch)
            .ok_or_else(|| cannot(WordsLack::Number { word: number::spell(b' ', n).trim_start().into() }))
    }
}
