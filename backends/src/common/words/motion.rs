//! Moves: straight ones, positions that do what is active, and the axis words of all.
//!
//! Axis words are exactly those of the statement.
//!
//! Not here: arcs (`arc`).

use ncc_dialects::NameMeaning;
use ncc_ir::canon::{Axis, Distance, Fact, FeedMode, Motion};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num, Unit};
use ncc_ir::lack::{MachineLack, WordsLack};
use ncc_ir::program::{Coord, Move, Point};
use ncc_ir::run_time::RunTimeValue;
use ncc_ir::source::Span;

use super::{Words, rounded};
use crate::common::block::{Need, Part, Rank};
use crate::common::codes::Letter;
use crate::common::fault::{cannot, cannot_compute, unwritable};
use crate::common::number::Shaped;
use crate::common::setting::Inserted;
use crate::common::{Sink, number};

impl Words {
    /// A straight move, rapid or at feed.
    pub(crate) fn straight(
        &mut self,
        to: &Move,
        rapid: bool,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let (motion, code) = match rapid {
            true => (Motion::Traverse, self.codes.traverse),
            false => (Motion::Feed, self.codes.feed),
        };
        let code = code.ok_or_else(|| cannot(WordsLack::StraightMove))?;
        let probe = self.probe.take().filter(|_| !rapid);
        let detour = self.detour.take().filter(|_| rapid);
        let code = detour.or(probe.map(|probe| probe.code)).unwrap_or(code);
        let mut inserted = Inserted::default();
        self.need_distance(to.to.axes.iter().flatten(), &mut inserted)?;
        let need = self.point_need(Need::new(Rank::Motion), &to.to)?;
        let says = to.said || probe.is_some() || detour.is_some() || self.active.motion != Some(motion);
        let need = if says { need.code(Some(code)) } else { need };
        let machine = self.machine.take();
        let need = if machine.is_some() { need.code(machine) } else { need };
        self.admit_with(need, inserted, sink)?;
        if let Some(machine) = machine {
            self.block.code(Part::Motion, &machine);
        }
        if says {
            self.block.code(Part::Motion, &code);
        }
        match probe {
            // Whether it stays active is a parameter of some controls.
            None if detour.is_some() => self.active.motion = None,
            None => self.active.motion = Some(motion),
            Some(probe) if probe.stays => self.active.motion = None,
            Some(_) => {}
        }
        self.point(&to.to, span, sink)?;
        self.put_corner();
        if probe.is_some_and(|probe| probe.own_feed) && !self.block.has_feed() {
            let counts = self.active.feed_mode != Some(FeedMode::InverseTime);
            let (Some(feed), Some(letter)) = (self.active.feed.filter(|_| counts), self.codes.feed_word)
            else {
                return Err(cannot(MachineLack::ProbingFeedUnknown));
            };
            let feed = self.value(&letter, &Expr::Num(feed), span, sink)?;
            self.block.word(Part::Feed, letter.letter, feed);
        }
        if probe.is_some() {
            // Where these axes are now, nothing that rounding has left is known of.
            for (residue, word) in self.residue.iter_mut().zip(&to.to.axes) {
                if word.is_some() {
                    *residue = 0;
                }
            }
        }
        Ok(())
    }

    /// Axis words that do whatever is active.
    pub(crate) fn position(&mut self, to: &Move, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        if !self.dialect.caps.flow.inherits_motion {
            return Err(cannot(WordsLack::CallersMotion));
        }
        let mut inserted = Inserted::default();
        self.need_distance(to.to.axes.iter().flatten(), &mut inserted)?;
        let need = self.point_need(Need::new(Rank::Motion), &to.to)?;
        self.admit_with(need, inserted, sink)?;
        self.point(&to.to, span, sink)
    }

    /// What the axis words of a point take of a block.
    pub(crate) fn point_need(&self, mut need: Need, to: &Point) -> Result<Need, Fault> {
        for axis in Axis::ALL {
            if to.get(axis).is_some() {
                let letter = self.codes.axes[axis as usize];
                let letter = letter.ok_or_else(|| cannot(WordsLack::AxisWord { axis }))?;
                need = need.letter(letter.letter);
            }
        }
        Ok(need)
    }

    /// Writes the axis words of a point.
    pub(crate) fn point(&mut self, to: &Point, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        for axis in Axis::ALL {
            if let Some(coord) = to.get(axis) {
                self.axis_word(axis, coord, span, sink)?;
            }
        }
        Ok(())
    }

    pub(crate) fn axis_word(
        &mut self,
        axis: Axis,
        coord: &Coord,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let Some(letter) = self.codes.axes[axis as usize] else { return Ok(()) };
        let Some(n) = coord.value.literal() else {
            let qualifier = self.way_round(axis).or(self.qualifier(coord.distance));
            let qualified = match qualifier {
                Some(qualifier) => Some((qualifier, self.behind(&coord.value, None, span, sink)?)),
                None => None,
            };
            if let Some((qualifier, text)) = qualified {
                let text = text.strip_prefix('=').ok_or_else(|| cannot(WordsLack::ComputedValue))?;
                if coord.distance.known() != Some(Distance::Incremental) {
                    self.residue[axis as usize] = 0;
                }
                let word = format!("{}={qualifier}({text})", letter.letter as char);
                self.block.text(Part::Axes, &word);
                return Ok(());
            }
            let value = self.computed(&letter, &coord.value, span, sink)?;
            // What rounding has left before is left after by a point of its own.
            if coord.distance.known().or(self.active.distance) != Some(Distance::Incremental) {
                self.residue[axis as usize] = 0;
            }
            self.block.word(Part::Axes, letter.letter, value);
            return Ok(());
        };
        self.check_unit(n, span)?;
        let shaped = self.coordinate(axis, &letter, n, coord.distance, span, sink)?;
        match self.way_round(axis).or(self.qualifier(coord.distance)) {
            None => self.block.word(Part::Axes, letter.letter, shaped),
            Some(qualifier) => {
                let text = number::qualified(letter.letter as char, qualifier, shaped);
                self.block.text(Part::Axes, &text);
            }
        }
        Ok(())
    }

    /// The qualifier of an axis with a stated direction.
    fn way_round(&mut self, axis: Axis) -> Option<&'static str> {
        let place = (axis as usize).checked_sub(Axis::A as usize)?;
        let way = self.ways[place].take()?;
        let row = self.dialect.name_for(NameMeaning::TurnRotaryAxis(way))?;
        Some(&row.name)
    }

    /// A coordinate in the control's digits. What rounding leaves after is kept, so that the errors
    /// of incremental words do not add up.
    fn coordinate(
        &mut self,
        axis: Axis,
        letter: &Letter,
        n: Num,
        distance: Fact<Distance>,
        span: Span,
        sink: &mut Sink,
    ) -> Result<Shaped, Fault> {
        let at = axis as usize;
        let metric = self.facts.metric && n.unit == Unit::Entry;
        let n = if metric { Num { unit: Unit::Mm, ..n } } else { n };
        let fault = |why| unwritable(why, letter.letter, n);
        let distance = distance.known().or(self.active.distance);
        let before = match distance {
            Some(Distance::Incremental) => self.residue[at],
            Some(Distance::Absolute) | None => 0,
        };
        let plain = number::shape(n, &letter.format).map_err(fault)?;
        let (shaped, residue) = if before == 0 {
            let left = match plain.rounded {
                true => difference(n, plain.num(n.unit)),
                false => 0,
            };
            (plain, left)
        } else {
            let due = n.nanos(false).and_then(|v| v.checked_add(before));
            let due =
                due.ok_or_else(|| cannot(WordsLack::Number { word: number::spell(letter.letter, n) }))?;
            let near = number::from_nanos(due, &letter.format, n.unit);
            let shaped = number::shape(near, &letter.format).map_err(fault)?;
            // The digits of the source stay where the residue makes no difference to them.
            let same = difference(n, near) == 0 && !plain.rounded;
            let shaped = if same { plain } else { Shaped { rounded: true, ..shaped } };
            (shaped, due - near.nanos(false).unwrap_or(due))
        };
        // How often a block is executed decides what its rounding adds up to.
        if self.facts.kept && distance == Some(Distance::Incremental) && (before, residue) != (0, 0) {
            return Err(cannot_compute(RunTimeValue::FineIncrement));
        }
        if shaped.rounded {
            rounded(letter.letter, n, shaped, span, sink);
        }
        if self.residue[at] != residue {
            self.residue[at] = residue;
            self.residual = self.residue.iter().any(|r| *r != 0);
        }
        Ok(shaped)
    }

    /// Puts the word of a corner into the block of the move before it.
    pub(crate) fn put_corner(&mut self) {
        if let Some(corner) = self.corner.take() {
            self.block.text(Part::Corner, &corner);
        }
    }

    /// Where the written text puts an axis.
    pub(crate) fn axis_position(&self, axis: Axis) -> Result<Nanos, Fault> {
        let unknown = Fault::PositionUnknown { axis: axis.letter() as char };
        let at = self.tracker.position[axis as usize].ok_or_else(|| unknown.clone())?;
        at.checked_sub(self.residue[axis as usize]).ok_or(unknown)
    }
}

/// What is left of `n` when `written` stands for it.
fn difference(n: Num, written: Num) -> Nanos {
    match (n.nanos(false), written.nanos(false)) {
        (Some(n), Some(written)) => n - written,
        // Finer than a nano: what is left is finer than any control.
        _ => 0,
    }
}
