//! Emits poles (`G111 X10 Y0`) and moves in polar coordinates (`G1 AP=30 RP=20`).
//!
//! Not here: replacing polar moves that Sinumerik cannot express. A pass does that first.

use ncc_dialects::{Meaning, NameRole, Quantity};
use ncc_ir::canon::{Axis, Distance, Motion};
use ncc_ir::diag::Fault;
use ncc_ir::lack::{HolesLack, PolarLack};
use ncc_ir::program::{Centre, Coord, Op, Polar, PoleWords, SetPole};
use ncc_ir::source::Span;

use super::{Modal, Sink, Writer, digits};
use crate::common::block::{Need, Rank};
use crate::common::codes::Code;
use crate::common::fault::cannot;
use crate::common::number;
use crate::common::setting::Inserted;

impl Writer {
    /// Emits a pole in a separate block.
    ///
    /// # Errors
    /// The dialect has no such pole, or the plane is unknown.
    pub(super) fn pole(&mut self, set: &SetPole, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let row = self.dialect.code_for(Meaning::SetPole(set.from)).ok_or_else(|| cannot(PolarLack::Pole))?;
        let mut inserted = Inserted::default();
        self.words.need_plane(set.plane, &mut inserted)?;
        self.words.admit_with(Need::new(Rank::Setting), inserted, sink)?;
        let mut text = row.code.clone();
        match &set.at {
            PoleWords::Along(words) => {
                let plane = set.plane.known().or(self.words.active.plane);
                let plane = plane.ok_or_else(|| cannot(PolarLack::PolePlaneUnknown))?;
                let (first, second, _) = plane.axes();
                for axis in [Axis::X, Axis::Y, Axis::Z].into_iter().filter(|a| *a == first || *a == second) {
                    let name = (axis.letter() as char).to_string();
                    let letter = self.letter(&name, Quantity::Length);
                    let word = match &words[axis as usize] {
                        Some(value) => self.lettered(&name, &letter, value, span, sink)?,
                        None => format!("{name}0"),
                    };
                    text.push_str(&format!(" {word}"));
                }
            }
            PoleWords::Polar { radius, angle } => {
                let angle = self.named(NameRole::PolarAngle, angle, None, span, sink)?;
                let radius = self.named(NameRole::PolarRadius, radius, None, span, sink)?;
                text = format!("{text} {angle} {radius}");
            }
        }
        self.alone(&text, sink)
    }

    /// Emits a move to, or a hole at, a polar point.
    ///
    /// # Errors
    /// The function has no polar form, or the cycle of the hole is unknown.
    pub(super) fn polar(&mut self, polar: &Polar, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        self.raw = false;
        let hole = matches!(polar.op, Op::Hole(_));
        let to =
            ncc_ir::geometry::polar::end_of(&polar.op).ok_or_else(|| cannot(PolarLack::FunctionToPoint))?;
        if hole {
            self.pay_call(sink)?;
            if self.standing.modal == Modal::Off {
                return Err(cannot(HolesLack::HoleOfUnknownCycle));
            }
            if !to.is_empty() {
                return Err(cannot(PolarLack::HoleOutsidePlane));
            }
        } else {
            let feeds = !matches!(polar.op, Op::StraightTraverse(_));
            self.before_move(to, feeds, span, sink)?;
        }
        let mut inserted = Inserted::default();
        self.words.need_distance(to.axes.iter().flatten(), &mut inserted)?;
        self.words.need_plane(polar.plane, &mut inserted)?;
        let mut words = Vec::new();
        let angle = if polar.along { NameRole::LineAngle } else { NameRole::PolarAngle };
        for (role, word) in [(angle, &polar.angle), (NameRole::PolarRadius, &polar.radius)] {
            if let Some(word) = word {
                words.push(self.polar_word(role, word, span, sink)?);
            }
        }
        let codes = &self.words.codes;
        let (motion, code, said): (Motion, Option<Code>, bool) = if let Op::StraightTraverse(m) = &polar.op {
            (Motion::Traverse, codes.traverse, m.said)
        } else if let Op::StraightFeed(m) = &polar.op {
            (Motion::Feed, codes.feed, m.said)
        } else if hole {
            (Motion::Traverse, codes.traverse, false)
        } else if let Op::ArcFeed(arc) = &polar.op
            && matches!(arc.centre, Centre::Point { .. })
            && arc.turns.is_none()
        {
            // The arc is centred on the pole: a pass ensures it.
            (Motion::Arc(arc.turn), codes.arcs[arc.turn as usize], arc.said)
        } else {
            return Err(cannot(PolarLack::FunctionToPoint));
        };
        let code = code.ok_or_else(|| cannot(PolarLack::Move))?;
        let says = said || self.words.active.motion != Some(motion);
        self.arc_block(says.then_some(code), None, to, inserted, &words, span, sink)?;
        self.words.active.motion = Some(motion);
        // ncc does not track the rounding of a polar end point.
        self.words.residue[..3].fill(0);
        Ok(())
    }

    /// A word of a role: `AP=30` or `RP=20`. An incremental polar angle gets `IC`. An absolute one gets `AC`, unless
    /// absolute distance mode is active.
    ///
    /// # Errors
    /// The radius or the angle of a line is incremental, or the distance mode is unknown.
    fn polar_word(
        &mut self,
        role: NameRole,
        word: &Coord,
        span: Span,
        sink: &mut Sink,
    ) -> Result<String, Fault> {
        let distance = word.distance.known().or(self.words.active.distance);
        let qualifier = match (role, distance, self.words.active.distance) {
            (NameRole::PolarAngle, Some(Distance::Incremental), _) => Some("IC"),
            (NameRole::LineAngle, Some(Distance::Incremental), _) => {
                return Err(cannot(PolarLack::AngleIncrement));
            }
            (NameRole::PolarRadius, Some(Distance::Incremental), _) | (_, None, _) => {
                return Err(cannot(PolarLack::RadiusIncrement));
            }
            (NameRole::PolarRadius | NameRole::LineAngle, ..) | (_, _, Some(Distance::Absolute)) => None,
            (_, _, Some(Distance::Incremental) | None) => Some("AC"),
        };
        let row = self.dialect.name_with(role).ok_or_else(|| cannot(PolarLack::Word))?;
        let letter = self.letter(&row.name, row.quantity.unwrap_or(Quantity::Length));
        let value = self.words.number(&letter, &word.value, span, sink)?;
        Ok(match qualifier {
            Some(qualifier) => number::qualified(&row.name, qualifier, value),
            None => format!("{}={}", row.name, digits(value)),
        })
    }
}
