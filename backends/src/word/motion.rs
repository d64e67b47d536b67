//! Moves: straight, arcs, and positions that do what is in force.
//!
//! Axis words are exactly those of the statement. An arc's centre is written in the dialect's own
//! form, computed where it has to be from where the written text itself puts the tool.

use std::borrow::Cow;

use ncc_dialects::NameMeaning;
use ncc_ir::canon::{AXES, Axis, Distance, Fact, FeedMode, Motion, Units};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num, Unit};
use ncc_ir::geometry;
use ncc_ir::geometry::arc_solver::MOST_SHORT;
use ncc_ir::program::{Arc, Centre, CentreFrom, Coord, Move, Point, Reference, ReferencePoint, Stmt};
use ncc_ir::source::Span;

use super::Writer;
use super::statement::rounded;
use crate::common::block::{Need, Part, Rank};
use crate::common::codes::Letter;
use crate::common::fault::{cannot, cannot_compute, unwritable};
use crate::common::number::{Shaped, WordValue};
use crate::common::setting::Inserted;
use crate::common::{Sink, number};

/// Words of an arc's centre or radius, ready to be written.
type CentreWords = [Option<(u8, WordValue)>; 3];

impl Writer {
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
        let code = code.ok_or_else(|| cannot("a straight move"))?;
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
            // Whether it stays in force is a parameter of some controls.
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
                return Err(cannot("a probing move whose feed is not known"));
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

    /// A move to a point of the machine, by way of the point that it names or of where it stands.
    pub(crate) fn reference(&mut self, to: &Reference, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let (point, number) = match to.point {
            ReferencePoint::Further(n) => (ReferencePoint::Further(0), Some(n)),
            point => (point, None),
        };
        let row = self.codes.references.iter().find(|(own, ..)| *own == point);
        let (_, code, letter) = *row.ok_or_else(|| cannot("a move to this point of the machine"))?;
        let mut via = to.via.clone();
        // To a stored position all axes go without a word of any.
        let stored = matches!(to.point, ReferencePoint::Stored(_)) && via.is_empty();
        let all = stored && to.axes == self.codes.axes.map(|axis| axis.is_some());
        for axis in Axis::ALL.into_iter().filter(|_| !all) {
            if to.axes[axis as usize] && via.get(axis).is_none() {
                let value = Expr::Num(Num::int(0, Unit::Entry));
                via.set(axis, Coord { value, distance: Fact::Known(Distance::Incremental) });
            }
        }
        let mut inserted = Inserted::default();
        self.need_distance(via.axes.iter().flatten(), &mut inserted)?;
        let need = self.point_need(Need::new(Rank::Motion), &via)?.code(Some(code));
        let need =
            if let (Some(letter), Some(_)) = (letter, number) { need.letter(letter.letter) } else { need };
        self.admit_with(need, inserted, sink)?;
        self.block.code(Part::Motion, &code);
        if let (Some(letter), Some(number)) = (letter, number) {
            let number = Expr::int(i64::from(number));
            let number = self.value(&letter, &number, span, sink)?;
            self.block.word(Part::Motion, letter.letter, number);
        }
        self.point(&via, span, sink)?;
        // Nothing that rounding has left is known of these axes any more.
        for (residue, goes) in self.residue.iter_mut().zip(to.axes) {
            if goes {
                *residue = 0;
            }
        }
        Ok(())
    }

    /// Axis words that do whatever is in force.
    pub(crate) fn position(&mut self, to: &Move, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        if !self.dialect.caps.flow.inherits_motion {
            return Err(cannot("a position that does what the caller has in force"));
        }
        self.call_up_now(stmt, sink)?;
        let mut inserted = Inserted::default();
        self.need_distance(to.to.axes.iter().flatten(), &mut inserted)?;
        let need = self.point_need(Need::new(Rank::Motion), &to.to)?;
        self.admit_with(need, inserted, sink)?;
        self.point(&to.to, stmt.span, sink)
    }

    /// What the axis words of a point take of a block.
    pub(crate) fn point_need(&self, mut need: Need, to: &Point) -> Result<Need, Fault> {
        for axis in Axis::ALL {
            if to.get(axis).is_some() {
                let letter = self.codes.axes[axis as usize];
                let letter = letter.ok_or_else(|| cannot(format!("the axis {}", axis.letter() as char)))?;
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
                let text = text.strip_prefix('=').ok_or_else(|| cannot("a computed value"))?;
                if coord.distance.known() != Some(Distance::Incremental) {
                    self.residue[axis as usize] = 0;
                }
                let word = format!("{}={qualifier}({text})", letter.letter as char);
                self.block.text(Part::Axes, &word);
                return Ok(());
            }
            let value = self.computed(&letter, &coord.value, span, sink)?;
            // What rounding has left before is left behind by a point of its own.
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

    /// The qualifier of an axis that was told which way round it goes.
    fn way_round(&mut self, axis: Axis) -> Option<&'static str> {
        let place = (axis as usize).checked_sub(Axis::A as usize)?;
        let way = self.ways[place].take()?;
        let row = self.dialect.name_for(NameMeaning::TurnRotaryAxis(way))?;
        Some(&row.name)
    }

    /// A coordinate in the control's digits. What rounding leaves behind is kept, so that the errors
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
        let metric = self.computing.metric && n.unit == Unit::Entry;
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
            let due = due.ok_or_else(|| cannot(number::spell(letter.letter, n)))?;
            let near = number::from_nanos(due, &letter.format, n.unit);
            let shaped = number::shape(near, &letter.format).map_err(fault)?;
            // The digits of the source stay where the residue makes no difference to them.
            let same = difference(n, near) == 0 && !plain.rounded;
            let shaped = if same { plain } else { Shaped { rounded: true, ..shaped } };
            (shaped, due - near.nanos(false).unwrap_or(due))
        };
        // How often a block is executed decides what its rounding adds up to.
        if self.computing.kept && distance == Some(Distance::Incremental) && (before, residue) != (0, 0) {
            return Err(cannot_compute("an incremental word that is finer than the digits of the control"));
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

    /// Where the written text puts an axis.
    pub(crate) fn axis_position(&self, axis: Axis) -> Result<Nanos, Fault> {
        let unknown = Fault::PositionUnknown { axis: axis.letter() as char };
        let at = self.tracker.position[axis as usize].ok_or_else(|| unknown.clone())?;
        at.checked_sub(self.residue[axis as usize]).ok_or(unknown)
    }

    /// An arc or helix.
    pub(crate) fn arc(&mut self, arc: &Arc, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        if let Some(line) = self.as_line(arc) {
            return self.straight(&line, false, span, sink);
        }
        let motion = Motion::Arc(arc.turn);
        let code = self.codes.arcs[arc.turn as usize].ok_or_else(|| cannot("an arc"))?;
        let turns = match (arc.turns.is_none(), self.codes.turns) {
            (true, _) => None,
            (false, None) => return Err(cannot("an arc of more than one turn")),
            (false, Some(letter)) => {
                Some((letter.letter, self.value(&letter, &arc.turns.all(), span, sink)?))
            }
        };
        let mut inserted = Inserted::default();
        self.need_distance(arc.to.axes.iter().flatten(), &mut inserted)?;
        self.need_plane(arc.plane, &mut inserted)?;
        if !self.dialect.arc.helix && self.leaves_plane(arc) {
            return Err(cannot("an arc with a third axis"));
        }
        let start = self.residue;
        let full = self.becomes_full(arc);
        let arc = &*self.with_end(arc)?;
        let centre = self.centre(arc, span, sink)?;
        let mut need = self.point_need(Need::new(Rank::Motion), &arc.to)?;
        for (letter, _) in centre.iter().flatten() {
            need = need.letter(*letter);
        }
        if let Some((letter, _)) = turns {
            need = need.letter(letter);
        }
        let says = arc.said || self.active.motion != Some(motion);
        let need = if says { need.code(Some(code)) } else { need };
        self.admit_with(need, inserted, sink)?;
        if says {
            self.block.code(Part::Motion, &code);
        }
        self.active.motion = Some(motion);
        self.point(&arc.to, span, sink)?;
        for (letter, value) in centre.into_iter().flatten() {
            self.block.word(Part::Axes, letter, value);
        }
        if let Some((letter, turns)) = turns {
            self.block.word(Part::Axes, letter, turns);
        }
        self.put_corner();
        if full { Ok(()) } else { self.check_vanished(arc, start) }
    }

    /// An arc with a word of its end in its plane, for a control that needs one: a full circle ends where it starts.
    fn with_end<'a>(&self, arc: &'a Arc) -> Result<Cow<'a, Arc>, Fault> {
        let plane = arc.plane.known().or(self.active.plane);
        let Some((first, second, _)) =
            plane.map(|plane| plane.axes()).filter(|_| self.dialect.arc.end_needed)
        else {
            return Ok(Cow::Borrowed(arc));
        };
        if arc.to.get(first).is_some() || arc.to.get(second).is_some() {
            return Ok(Cow::Borrowed(arc));
        }
        let (Some(distance), Some(letter)) = (self.active.distance, self.codes.axes[first as usize]) else {
            return Err(cannot("a full circle where the distance mode is not known"));
        };
        let value = match (distance, self.active.units) {
            (Distance::Incremental, _) => Num::int(0, Unit::Entry),
            (Distance::Absolute, Some(units)) => {
                let unit = if units == Units::Inch { Unit::Inch } else { Unit::Mm };
                number::from_nanos(self.axis_position(first)?, &letter.format, unit)
            }
            (Distance::Absolute, None) => return Err(cannot("a full circle in a unit that is not known")),
        };
        let mut arc = arc.clone();
        arc.to.set(first, Coord { value: Expr::Num(value), distance: Fact::Known(distance) });
        Ok(Cow::Owned(arc))
    }

    /// Whether an arc has a word for a linear axis outside its plane.
    fn leaves_plane(&self, arc: &Arc) -> bool {
        let normal = arc.plane.known().or(self.active.plane).map(|p| p.axes().2);
        arc.to.axes.iter().enumerate().any(|(at, word)| {
            word.is_some() && (at > Axis::Z as usize || normal.is_some_and(|n| n as usize == at))
        })
    }

    /// The words that say an arc's centre.
    fn centre(&mut self, arc: &Arc, span: Span, sink: &mut Sink) -> Result<CentreWords, Fault> {
        let absolute = self.dialect.arc.centre_absolute;
        match (&arc.centre, self.codes.radius) {
            (Centre::Radius(radius), Some(letter)) => {
                let value = self.value(&letter, radius, span, sink)?;
                Ok([Some((letter.letter, value)), None, None])
            }
            (Centre::Point { words, from }, _) if absolute == (*from == CentreFrom::Zero) => {
                let plane = arc.plane.known().or(self.active.plane);
                let mut written = [None; 3];
                for axis in [Axis::X, Axis::Y, Axis::Z] {
                    let outside = plane.is_some_and(|p| p.axes().2 == axis);
                    if let Some(word) = words[axis as usize].as_ref().filter(|_| !outside) {
                        let letter = self.centre_letter(axis)?;
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
            Expr::Num(_) => self.centre_number(letter, axis, word, from, span, sink).map(WordValue::Number),
            Expr::Node(_) => self.computed(letter, word, span, sink),
        }
    }

    /// The same, of one that is no expression.
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

    /// A centre in the other form than the source's.
    pub(crate) fn computed_centre(
        &mut self,
        arc: &Arc,
        span: Span,
        sink: &mut Sink,
    ) -> Result<CentreWords, Fault> {
        let plane = arc.plane.known().or(self.active.plane);
        let plane = plane.ok_or_else(|| cannot("an arc in a plane that is not known"))?;
        let (first, second, _) = plane.axes();
        let absolute = self.dialect.arc.centre_absolute;
        let unit = match self.active.units {
            Some(Units::Mm) => Unit::Mm,
            Some(Units::Inch) => Unit::Inch,
            None => return Err(cannot("an arc's centre in a unit that is not known")),
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
                            self.axis_position(axis)?
                                .checked_add(self.residue[axis as usize])
                                .and_then(|start| start.checked_add(word.unwrap_or(0)))
                        }
                        (CentreFrom::Zero, Some(word)) => word.checked_sub(self.axis_position(axis)?),
                        (CentreFrom::Zero, None) => Some(0),
                    }
                    .ok_or_else(|| cannot("a centre this far away"))?;
                }
                along
            }
            Centre::Radius(radius) => {
                let radius = self.length(radius, span)?;
                let start = [self.axis_position(first)?, self.axis_position(second)?];
                let end = [self.arrives(arc, first)?, self.arrives(arc, second)?];
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
            let letter = self.centre_letter(axis)?;
            let n = number::from_nanos(along, &letter.format, unit);
            let value = number::shape(n, &letter.format).map_err(|w| unwritable(w, letter.letter, n))?;
            written[axis as usize] = Some((letter.letter, value.into()));
        }
        Ok(written)
    }

    pub(crate) fn centre_letter(&self, axis: Axis) -> Result<Letter, Fault> {
        let letter = self.codes.centre.get(axis as usize).copied().flatten();
        letter.ok_or_else(|| cannot("an arc's centre"))
    }

    /// A length in nanos.
    pub(crate) fn length(&mut self, value: &ncc_ir::expr::Expr, span: Span) -> Result<Nanos, Fault> {
        let n = value.literal().ok_or_else(|| cannot("a computed value"))?;
        self.check_unit(n, span)?;
        let inch = self.active.units == Some(Units::Inch);
        n.nanos(inch).ok_or_else(|| cannot(number::spell(b' ', n).trim_start()))
    }

    /// Where the written words of an arc put an axis.
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
        let along = |axis: Axis| Some((self.axis_position(axis).ok()?, self.arrives(arc, axis).ok()?));
        let [(a, b), (c, d)] = [along(first)?, along(second)?];
        let end = self.tracker.target(&arc.to);
        let exact = |axis: Axis| Some([self.tracker.position[axis as usize]?, end[axis as usize]?]);
        let ([x, to_x], [y, to_y]) = (exact(first)?, exact(second)?);
        if (a, c) != (b, d) || (x, y) == (to_x, to_y) || !arc.turns.is_none() {
            return None;
        }
        let centre = self.tracker.centre(arc)?;
        Some(geometry::sweep_degrees([x, y], [to_x, to_y], centre, arc.turn, 0).abs())
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

/// What is left of `n` when `written` stands for it.
fn difference(n: Num, written: Num) -> Nanos {
    match (n.nanos(false), written.nanos(false)) {
        (Some(n), Some(written)) => n - written,
        // Finer than a nano: what is left is finer than any control.
        _ => 0,
    }
}
