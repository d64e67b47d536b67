//! Moves: straight ones, and arcs in all their forms.

use ncc_dialects::{NameMeaning, NameRole, NameRow, Quantity};
use ncc_ir::canon::{Axis, Distance, Fact, Motion, Turn};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::lack::{ArcsLack, MachineLack};
use ncc_ir::program::{Arc, ArcForm, Centre, CentreFrom, Coord, Op, Point, Shape, Stmt, Turns};
use ncc_ir::source::Span;

use super::{Sink, Writer, digits, lettered};
use crate::common::block::{Need, Part, Rank};
use crate::common::codes::Code;
use crate::common::fault::cannot;
use crate::common::number;
use crate::common::setting::Inserted;

/// Words of an arc besides its end point, ready to be written.
type ArcWords = Vec<String>;

impl Writer {
    /// A straight move, rapid or at feed, in machine coordinates if those were asked for.
    pub(super) fn straight(
        &mut self,
        to: &Point,
        feeds: bool,
        stmt: &Stmt,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let raw = std::mem::replace(&mut self.raw, false);
        let machine = if raw { Some(self.machine_word()?) } else { None };
        self.before_move(to, feeds, stmt.span, sink)?;
        self.words.statement(stmt, sink)?;
        if let Some(word) = machine {
            self.words.block.text(Part::Mode, word);
        }
        Ok(())
    }

    /// What has to be stated before a move so that it is only that.
    pub(super) fn before_move(
        &mut self,
        to: &Point,
        feeds: bool,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        self.end_modal(sink)?;
        if feeds {
            self.restate_feed(span, sink)?;
        }
        self.settle_edge_for(to, span, sink)
    }

    /// An arc or helix about a centre or by its radius.
    pub(super) fn arc(&mut self, arc: &Arc, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        if let Some(line) = self.words.as_line(arc) {
            let to = line.to.clone();
            return self.straight(&to, true, &Stmt::new(span, Op::StraightFeed(line)), sink);
        }
        self.raw = false;
        self.before_move(&arc.to, true, span, sink)?;
        let motion = Motion::Arc(arc.turn);
        let code = self.arc_code(arc.turn)?;
        let mut inserted = Inserted::default();
        self.words.need_distance(arc.to.axes.iter().flatten(), &mut inserted)?;
        self.words.need_plane(arc.plane, &mut inserted)?;
        let start = self.words.residue;
        let full = self.words.becomes_full(arc);
        let mut words = match &arc.centre {
            Centre::Radius(radius) => vec![self.named(NameRole::Radius, radius, None, span, sink)?],
            Centre::Point { words, from } => {
                let plane = arc.plane.known().or(self.words.active.plane);
                let mut written = Vec::with_capacity(3);
                for axis in [Axis::X, Axis::Y, Axis::Z] {
                    let outside = plane.is_some_and(|p| p.axes().2 == axis);
                    match &words[axis as usize] {
                        Some(word) if !outside => {
                            written.push(self.centre_word(axis, word, *from, span, sink)?);
                        }
                        None if !outside && *from == CentreFrom::Zero => {
                            return Err(cannot(ArcsLack::CentreWordMissing));
                        }
                        Some(_) | None => {}
                    }
                }
                written
            }
        };
        self.turns(&arc.turns, span, sink, &mut words)?;
        let says = arc.said || self.words.active.motion != Some(motion);
        self.arc_block(says.then_some(code), None, &arc.to, inserted, &words, span, sink)?;
        self.words.active.motion = Some(motion);
        if full { Ok(()) } else { self.words.check_vanished(arc, start) }
    }

    /// An arc of another form.
    pub(super) fn arc_form(&mut self, arc: &ArcForm, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        self.raw = false;
        self.before_move(&arc.to, true, span, sink)?;
        let mut inserted = Inserted::default();
        self.words.need_distance(arc.to.axes.iter().flatten(), &mut inserted)?;
        self.words.need_plane(arc.plane, &mut inserted)?;
        let (turn, name, mut words) = match &arc.shape {
            Shape::Angle { turn, angle } => {
                (Some(*turn), None, vec![self.named(NameRole::OpeningAngle, angle, None, span, sink)?])
            }
            Shape::AngleAbout { turn, angle, centre } => {
                let mut words = self.mixed_centre(arc, centre, span, sink)?;
                words.push(self.named(NameRole::OpeningAngle, angle, None, span, sink)?);
                (Some(*turn), None, words)
            }
            Shape::Mixed { turn, centre } => (Some(*turn), None, self.mixed_centre(arc, centre, span, sink)?),
            Shape::Through(point) => {
                let roles = [NameRole::ThroughX, NameRole::ThroughY, NameRole::ThroughZ];
                self.words.need_distance(point.axes.iter().flatten(), &mut inserted)?;
                let mut words = Vec::new();
                for (role, coord) in roles.into_iter().zip(&point.axes) {
                    if let Some(coord) = coord {
                        let qualifier = self.words.qualifier(coord.distance);
                        words.push(self.named(role, &coord.value, qualifier, span, sink)?);
                    }
                }
                if point.axes[3..].iter().any(Option::is_some) {
                    return Err(cannot(MachineLack::IntermediateRotary));
                }
                (None, Some(NameMeaning::ArcThrough), words)
            }
            Shape::Tangent => (None, Some(NameMeaning::ArcTangent), Vec::new()),
        };
        self.turns(&Turns::from(arc.turns), span, sink, &mut words)?;
        let motion = turn.map(Motion::Arc);
        let code = match turn {
            Some(turn) if arc.said || self.words.active.motion != motion => Some(self.arc_code(turn)?),
            Some(_) | None => None,
        };
        let name = match name {
            Some(meaning) => Some(self.row(self.dialect.name_for(meaning))?.name.as_str()),
            None => None,
        };
        self.arc_block(code, name, &arc.to, inserted, &words, span, sink)?;
        // A name is stated again in every block: nothing else tells it from the last code.
        self.words.active.motion = motion;
        Ok(())
    }

    /// Puts an arc into a block.
    #[allow(clippy::too_many_arguments)] // One place where the parts of a block come together.
    pub(super) fn arc_block(
        &mut self,
        code: Option<Code>,
        name: Option<&str>,
        to: &Point,
        inserted: Inserted,
        words: &[String],
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let need = self.words.point_need(Need::new(Rank::Motion).code(code), to)?;
        self.words.admit_with(need, inserted, sink)?;
        if let Some(code) = code {
            self.words.block.code(Part::Motion, &code);
        }
        if let Some(name) = name {
            self.words.block.text(Part::Motion, name);
        }
        self.words.point(to, span, sink)?;
        for word in words {
            self.words.block.text(Part::Axes, word);
        }
        self.words.put_corner();
        Ok(())
    }

    fn arc_code(&self, turn: Turn) -> Result<Code, Fault> {
        self.words.codes.arcs[turn as usize].ok_or_else(|| cannot(ArcsLack::Arc))
    }

    fn row(&self, row: Option<&'static NameRow>) -> Result<&'static NameRow, Fault> {
        row.ok_or_else(|| cannot(ArcsLack::Form))
    }

    /// An address of several letters and its value.
    pub(super) fn named(
        &mut self,
        role: NameRole,
        value: &Expr,
        qualifier: Option<&str>,
        span: Span,
        sink: &mut Sink,
    ) -> Result<String, Fault> {
        let row = self.row(self.dialect.name_with(role))?;
        if let Expr::Node(_) = value {
            let text = self.words.behind(value, None, span, sink)?;
            return Ok(match qualifier {
                Some(qualifier) => format!("{}={qualifier}({})", row.name, text.trim_start_matches('=')),
                None => format!("{}{text}", row.name),
            });
        }
        let letter = self.letter(&row.name, row.quantity.unwrap_or(Quantity::Length));
        let value = self.words.number(&letter, value, span, sink)?;
        Ok(match qualifier {
            Some(qualifier) => number::qualified(&row.name, qualifier, value),
            None => format!("{}={}", row.name, digits(value)),
        })
    }

    fn centre_word(
        &mut self,
        axis: Axis,
        value: &Expr,
        from: CentreFrom,
        span: Span,
        sink: &mut Sink,
    ) -> Result<String, Fault> {
        let letter = self.words.centre_letter(axis)?;
        if let Expr::Node(_) = value {
            let name = letter.letter as char;
            let text = self.words.behind(value, None, span, sink)?;
            return Ok(match from {
                CentreFrom::Start => format!("{name}{text}"),
                CentreFrom::Zero => format!("{name}=AC({})", text.trim_start_matches('=')),
            });
        }
        let value = self.words.centre_number(&letter, axis, value, from, span, sink)?;
        let name = letter.letter as char;
        Ok(match from {
            CentreFrom::Start => lettered(letter.letter, value),
            CentreFrom::Zero => number::qualified(name, "AC", value),
        })
    }

    /// Words of a centre, each from where its distance says.
    fn mixed_centre(
        &mut self,
        arc: &ArcForm,
        centre: &[Option<Coord>; 3],
        span: Span,
        sink: &mut Sink,
    ) -> Result<ArcWords, Fault> {
        let plane = arc.plane.known().or(self.words.active.plane);
        let mut words = Vec::new();
        for (axis, coord) in [Axis::X, Axis::Y, Axis::Z].into_iter().zip(centre) {
            let Some(coord) = coord.as_ref().filter(|_| plane.is_none_or(|p| p.axes().2 != axis)) else {
                continue;
            };
            let from = match coord.distance {
                Fact::Known(Distance::Absolute) => CentreFrom::Zero,
                Fact::Known(Distance::Incremental) => CentreFrom::Start,
                Fact::Entry => return Err(cannot(ArcsLack::CentreModeUnknown)),
            };
            words.push(self.centre_word(axis, &coord.value, from, span, sink)?);
        }
        Ok(words)
    }

    fn turns(
        &mut self,
        turns: &Turns,
        span: Span,
        sink: &mut Sink,
        words: &mut ArcWords,
    ) -> Result<(), Fault> {
        // No manual says what the control does with a count that is not whole, so only a written count goes out.
        if turns.count()? > 0 {
            words.push(self.named(NameRole::Turns, &turns.0, None, span, sink)?);
        }
        Ok(())
    }
}
