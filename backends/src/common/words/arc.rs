//! Arcs between the ends that the text writes: two ends that are rounded may be one point.
//!
//! Not here: the words of arcs, which every language has in its own form.

use ncc_ir::canon::{AXES, Axis, Units};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, POW10, Unit};
use ncc_ir::geometry;
use ncc_ir::lack::ArcsLack;
use ncc_ir::program::{Arc, Centre, CentreFrom, Move};
use ncc_ir::source::Span;

use super::{Words, rounded};
use crate::common::codes::Letter;
use crate::common::fault::{cannot, unwritable};
use crate::common::number::Shaped;
use crate::common::{Sink, number};

impl Words {
    /// A word of a centre that is no expression. If it is measured from a start that was rounded, it is changed by as
    /// much: the centre stays where it is.
    pub(crate) fn centre_number(
        &mut self,
        letter: &Letter,
        axis: Axis,
        word: &Expr,
        from: CentreFrom,
        span: Span,
        sink: &mut Sink,
    ) -> Result<Shaped, Fault> {
        let lag = if from == CentreFrom::Start { self.residue[axis as usize] } else { 0 };
        let inch = self.active.units == Some(Units::Inch);
        let literal = word.literal().filter(|n| lag != 0 && n.unit != Unit::Entry);
        let along = literal.and_then(|n| Some((n, n.nanos(inch)?.checked_add(lag)?)));
        let Some((n, along)) = along else { return self.number(letter, word, span, sink) };
        self.check_unit(n, span)?;
        let exact = number::from_nanos(along, &letter.format, n.unit);
        let shaped =
            number::shape(exact, &letter.format).map_err(|why| unwritable(why, letter.letter, exact))?;
        rounded(letter.letter, n, shaped, span, sink);
        Ok(shaped)
    }

    pub(crate) fn centre_letter(&self, axis: Axis) -> Result<Letter, Fault> {
        let letter = self.codes.centre.get(axis as usize).copied().flatten();
        letter.ok_or_else(|| cannot(ArcsLack::Centre))
    }

    /// The place of an axis at the end of an arc, by the words that are written.
    pub(crate) fn arrives(&self, arc: &Arc, axis: Axis) -> Result<Nanos, Fault> {
        let unknown = Fault::PositionUnknown { axis: axis.letter() as char };
        let Some(coord) = arc.to.get(axis) else { return self.axis_position(axis) };
        let target = self.tracker.resolve(coord, self.tracker.position[axis as usize]);
        let target = target.ok_or(unknown)?;
        let Some(letter) = self.codes.axes[axis as usize] else { return Ok(target) };
        let unit = coord.value.literal().map_or(Unit::Mm, |n| n.unit);
        Ok(number::from_nanos(target, &letter.format, unit).nanos(false).unwrap_or(target))
    }

    /// Whether an arc that goes nearly round is a full circle when its ends are rounded.
    pub(crate) fn becomes_full(&self, arc: &Arc) -> bool {
        matches!(arc.centre, Centre::Point { .. })
            && self.sweep_of_vanishing(arc).is_some_and(|sweep| sweep > 270.0)
    }

    /// How far an arc goes round, in degrees, of which the ends become one point when they are rounded.
    fn sweep_of_vanishing(&self, arc: &Arc) -> Option<f64> {
        let (first, second, _) = self.tracker.plane(arc.plane)?.axes();
        let end = self.tracker.target(&arc.to);
        let exact = |axis: Axis| Some([self.tracker.position[axis as usize]?, end[axis as usize]?]);
        let ([x, to_x], [y, to_y]) = (exact(first)?, exact(second)?);
        if self.arrives_apart(first, to_x) || self.arrives_apart(second, to_y) {
            return None;
        }
        let along = |axis: Axis| Some((self.axis_position(axis).ok()?, self.arrives(arc, axis).ok()?));
        let [(a, b), (c, d)] = [along(first)?, along(second)?];
        if (a, c) != (b, d) || (x, y) == (to_x, to_y) || !arc.turns.is_none() {
            return None;
        }
        let centre = self.tracker.centre(arc)?;
        Some(geometry::sweep_degrees([x, y], [to_x, to_y], centre, arc.turn, 0).abs())
    }

    /// Whether a place along an axis is surely another than the one that was written last, however it is rounded: further
    /// from it than one least increment, of inches too.
    fn arrives_apart(&self, axis: Axis, to: Nanos) -> bool {
        let (Some(letter), Ok(from)) = (self.codes.axes[axis as usize], self.axis_position(axis)) else {
            return false;
        };
        let [mm, inch] = letter.format.decimals.map(|decimals| POW10[9 - usize::from(decimals.min(9))]);
        from.abs_diff(to) > mm.max(inch * 254 / 10).unsigned_abs()
    }

    /// An arc of less than a quarter of a turn whose ends become one point when they are rounded is a line: as an arc it
    /// would be a full circle.
    pub(crate) fn as_line(&self, arc: &Arc) -> Option<Move> {
        let normal = self.tracker.plane(arc.plane)?.axes().2 as usize;
        // Along the normal it would go beside the line of a helix.
        let helix = self.tracker.target(&arc.to)[normal] != self.tracker.position[normal];
        let little = !helix && self.sweep_of_vanishing(arc).is_some_and(|sweep| sweep < 90.0);
        little.then(|| Move { to: arc.to.clone(), said: true })
    }

    /// An arc with an end of its own, whose rounded end is its start, would become a full circle or
    /// nothing at all.
    pub(crate) fn check_vanished(&self, arc: &Arc, start_residue: [Nanos; AXES]) -> Result<(), Fault> {
        if start_residue == self.residue {
            return Ok(());
        }
        let plane = arc.plane.known().or(self.active.plane);
        let in_plane = |axis: Axis| plane.is_none_or(|p| p.axes().2 != axis);
        let mut moved = false;
        for axis in [Axis::X, Axis::Y, Axis::Z].into_iter().filter(|a| in_plane(*a)) {
            let at = axis as usize;
            let Some(from) = self.tracker.position[at] else { return Ok(()) };
            let to = arc.to.get(axis).map(|c| self.tracker.resolve(c, Some(from)));
            let Some(to) = to.unwrap_or(Some(from)) else { return Ok(()) };
            moved |= to != from;
            if to - self.residue[at] != from - start_residue[at] {
                return Ok(());
            }
        }
        if moved { Err(Fault::ArcVanishes) } else { Ok(()) }
    }
}
