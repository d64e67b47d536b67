//! Words of moves and arcs under a frame: shifted along their axes, or computed where axes are mixed.
//!
//! Refused: arcs that the frame does not leave arcs, and places that are not known.

use crate::frames::expand_frames::now::value_of;
use crate::frames::expand_frames::{Frames, NOTHING, cannot};
use crate::support::write::{EXACT, exact, rounded, unit_of};
use ncc_ir::canon::{AXES, Axis, Distance, Fact};
use ncc_ir::diag::{Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num};
use ncc_ir::lack::FramesLack;
use ncc_ir::program::cycle::absolute;
use ncc_ir::program::{Arc, Centre, CentreFrom, Coord, Move, Point};

impl Frames<'_> {
    /// Digits of a computed length: all, where the chain leaves it exact, or as many as the target
    /// has.
    pub(super) fn decimals(&self) -> u8 {
        if self.is_exact() { EXACT } else { self.target.decimals_in(self.inner.unit()) }
    }

    /// Whether the chain is one of translations, mirrors and quarter turns.
    pub(super) fn is_exact(&self) -> bool {
        let whole = |v: &f64| v.abs() < NOTHING || (v.abs() - 1.0).abs() < NOTHING;
        self.set.chain.turn().is_none_or(|m| m.iter().flatten().all(whole))
    }

    /// A coordinate moved along its axis.
    pub(super) fn shifted(&self, word: &Coord, axis: Axis) -> Result<Coord, Fault> {
        let at = &self.inner.at;
        let by = self.set.chain.shift()[axis as usize];
        match word.distance.known().or(at.modes.distance) {
            None => Err(Fault::EntryFactNeeded { fact: ModeName::Distance }),
            Some(Distance::Incremental) => Ok(word.clone()),
            Some(Distance::Absolute) if by == 0 => Ok(word.clone()),
            Some(Distance::Absolute) => {
                let value = value_of(at, &word.value)?;
                let unit = unit_of(axis, self.inner.unit());
                Ok(absolute(exact(value.wrapping_add(by), unit)))
            }
        }
    }

    pub(super) fn moved(&self, m: &Move) -> Result<Move, Fault> {
        Ok(Move { to: self.point(&m.to)?, said: m.said })
    }

    pub(super) fn point(&self, to: &Point) -> Result<Point, Fault> {
        self.point_to(to, self.decimals())
    }

    fn point_to(&self, to: &Point, decimals: u8) -> Result<Point, Fault> {
        let unit = self.inner.unit();
        let mut out = Point::default();
        let after = self.set.chain.place_known(&self.inner.at.target(to));
        for (i, axis) in Axis::ALL.into_iter().enumerate() {
            let Some(row) = self.set.chain.turn().and_then(|m| m.get(i)) else {
                if let Some(word) = to.get(axis) {
                    out.set(axis, self.shifted(word, axis)?);
                }
                continue;
            };
            let from = || (0..3).filter(|j| row[*j].abs() >= NOTHING);
            let word = to.get(axis);
            let takes_up = axis == Axis::Z && self.inner.waiting;
            if !(from().any(|j| to.axes[j].is_some()) || takes_up && word.is_some()) {
                continue;
            }
            if takes_up && word.is_none() {
                return Err(cannot(FramesLack::LengthInTurnedFrame));
            }
            // Along its own axis an increment is one outside as well.
            if from().eq([i])
                && (row[i].abs() - 1.0).abs() < NOTHING
                && let Some(word) = word
                && word.distance.known().or(self.inner.at.modes.distance) == Some(Distance::Incremental)
            {
                out.set(axis, if row[i] > 0.0 { word.clone() } else { negative(word)? });
                continue;
            }
            let Some(nanos) = after[i] else {
                let target = self.inner.at.target(to);
                let unknown = from().find(|j| target[*j].is_none()).unwrap_or(i);
                return Err(self.unknown(Axis::ALL[unknown], to));
            };
            out.set(axis, absolute(rounded(nanos, decimals, unit_of(axis, unit))));
        }
        self.placed(&mut out, &after)?;
        Ok(out)
    }

    /// Why it is not known where an axis goes.
    pub(super) fn unknown(&self, axis: Axis, to: &Point) -> Fault {
        let distance = |w: &Coord| w.distance.known().or(self.inner.at.modes.distance).is_none();
        match to.get(axis) {
            Some(word) if distance(word) => Fault::EntryFactNeeded { fact: ModeName::Distance },
            Some(_) | None => Fault::PositionUnknown { axis: axis.letter() as char },
        }
    }

    pub(super) fn arc(&self, arc: &Arc) -> Result<Arc, Fault> {
        let at = &self.inner.at;
        let plane = at.plane(arc.plane).ok_or(Fault::EntryFactNeeded { fact: ModeName::Plane })?;
        let (first, second, _) = plane.axes();
        if self.set.unplaced.is_some() {
            return Err(cannot(FramesLack::ArcFirstInRotation));
        }
        let mut out = arc.clone();
        // How a third axis goes with several turns depends on the very angle.
        let decimals = if !arc.turns.is_none() { EXACT } else { self.decimals() };
        out.to = self.point_to(&arc.to, decimals)?;
        if self.set.chain.turn().is_none() {
            if let Centre::Point { words, from: CentreFrom::Zero } = &mut out.centre {
                for axis in [first, second] {
                    if let Some(word) = &mut words[axis as usize] {
                        *word = self.shifted(&absolute(word.clone()), axis)?.value;
                    }
                }
            }
            return Ok(out);
        }
        let sense = self.set.chain.sense(plane, arc.turn);
        out.turn = sense.ok_or_else(|| cannot(FramesLack::ArcNoLonger))?;
        out.plane = Fact::Known(plane);
        let unknown = |axis: Axis| Fault::PositionUnknown { axis: axis.letter() as char };
        let centre = at.centre(arc).ok_or_else(|| unknown(first))?;
        let mut middle = at.target(&arc.to);
        let start = [first, second].map(|a| at.position[a as usize]);
        let end = [first, second].map(|a| middle[a as usize]);
        for (axis, place) in [first, second].into_iter().zip(centre) {
            middle[axis as usize] = Some(place);
        }
        let middle = self.set.chain.place_known(&middle);
        if start == end {
            // A whole circle stays one, however its ends are rounded.
            out.to.axes[first as usize] = None;
            out.to.axes[second as usize] = None;
        }
        let mut words: [Option<Expr>; 3] = [None, None, None];
        for axis in [first, second] {
            // From where the axis stands as it is written.
            let from = self.outer.at.position[axis as usize].ok_or_else(|| unknown(axis))?;
            let to = middle[axis as usize].ok_or_else(|| unknown(axis))?;
            let unit = self.inner.unit();
            let way = rounded(to.wrapping_sub(from), decimals, unit_of(axis, unit));
            words[axis as usize] = Some(way.into());
        }
        out.centre = Centre::Point { words, from: CentreFrom::Start };
        Ok(out)
    }

    /// Both axes of the plane in which the tool must be placed, as absolute words.
    fn placed(&self, out: &mut Point, after: &[Option<Nanos>; AXES]) -> Result<(), Fault> {
        let Some(plane) = self.set.unplaced else { return Ok(()) };
        let (first, second, _) = plane.axes();
        let in_force = self.inner.at.modes.distance;
        let is_absolute = |axis: Axis, out: &Point| {
            let word = out.get(axis);
            word.is_some_and(|w| w.distance.known().or(in_force) == Some(Distance::Absolute))
        };
        if [first, second].iter().all(|axis| out.get(*axis).is_none()) {
            return Ok(());
        }
        for axis in [first, second] {
            if !is_absolute(axis, out) {
                let nanos = after[axis as usize];
                let nanos = nanos.ok_or(Fault::PositionUnknown { axis: axis.letter() as char })?;
                out.set(axis, absolute(exact(nanos, unit_of(axis, self.inner.unit()))));
            }
        }
        Ok(())
    }
}

/// The same increment the other way.
fn negative(word: &Coord) -> Result<Coord, Fault> {
    let n = word.value.literal().ok_or_else(|| cannot(FramesLack::ComputedWord))?;
    let value = Num { mantissa: n.mantissa.wrapping_neg(), ..n };
    Ok(Coord { value: value.into(), distance: Fact::Known(Distance::Incremental) })
}
