//! A compensated contour: which statements it may contain, and its tool centre path.

use super::written::{Written, cannot, straight};
use crate::support::walk::Walk;
use crate::support::write::Rebuild;
use ncc_ir::canon::{Axis, Motion, Plane, Side, Turn};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::geometry::arc_feed::{ArcFeed, centre_speed, is_inner};
use ncc_ir::geometry::offset_path::{Corner, Leg, OffsetPath, Rules, Spot, Unreachable};
use ncc_ir::lack::ExpandedContour;
use ncc_ir::program::{Op, Point, Stmt};
use ncc_ir::source::Span;

/// A compensated contour.
pub(super) struct Contour {
    pub(super) plane: Plane,
    /// The tool radius, nanos; 0 is the contour itself.
    pub(super) radius: f64,
    pub(super) left: bool,
    pub(super) path: Option<OffsetPath>,
    /// Index of the held move in the output.
    pub(super) held: usize,
    pub(super) start: Span,
}

pub(super) fn contour(plane: Plane, side: Side, radius: f64, start: Span) -> Contour {
    let left = (side == Side::Left) == (radius >= 0.0);
    Contour { plane, radius: radius.abs(), left, path: None, held: 0, start }
}

impl Contour {
    /// The words of a move, which must lie in the plane and move no rotary axis.
    pub(super) fn words<'s>(&self, stmt: &'s Stmt, walk: &Walk) -> Result<&'s Point, Diagnostic> {
        let words = match &stmt.op {
            Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Position(m) => &m.to,
            Op::ArcFeed(arc) => {
                if arc.plane.known().or(walk.at.modes.plane) != Some(self.plane) {
                    return cannot(ExpandedContour::OtherPlane, stmt.span);
                }
                &arc.to
            }
            _ => return cannot(ExpandedContour::Function { function: stmt.op.name() }, stmt.span),
        };
        if words.axes[Axis::A as usize..].iter().any(Option::is_some) {
            return cannot(ExpandedContour::RotaryAxis, stmt.span);
        }
        Ok(words)
    }

    /// The feed of the tool centre on an arc, as a part of F, where F counts on the contour.
    pub(super) fn part_of_feed(
        &self,
        feed: ArcFeed,
        leg: Leg,
        [from, to]: [Spot; 2],
        words: &Point,
        writer: &Written,
    ) -> Result<Option<f64>, Fault> {
        let Leg::Arc { centre, ccw, turns } = leg else { return Ok(None) };
        let side = if self.left { Side::Left } else { Side::Right };
        let turn = if ccw { Turn::Counterclockwise } else { Turn::Clockwise };
        let radius = (from[0] - centre[0]).hypot(from[1] - centre[1]);
        match feed.on_contour(side, turn) {
            true => {
                let arc = (centre, turn, turns);
                let (angle, along) = writer.climb(words, from, to, arc)?;
                Ok(Some(centre_speed(radius, self.radius, is_inner(side, turn), angle, along)))
            }
            false => Ok(None),
        }
    }

    /// Continues the contour, or enters it: sets the end point of the move before, which is known now. Returns the
    /// move around an outer corner, if there is one.
    pub(super) fn go_on(
        &mut self,
        leg: Leg,
        [from, to]: [Spot; 2],
        rules: Rules,
        writer: &Written,
        made: &mut Rebuild,
    ) -> Result<Option<Op>, Unreachable> {
        let Some(path) = &mut self.path else {
            self.path = Some(OffsetPath::enter(self.radius, self.left, rules, from, to)?);
            return Ok(None);
        };
        let Corner { end, round } = path.go_on(leg, to)?;
        writer.settle(&mut made.out[self.held], end);
        Ok(round.map(|round| match round.straight {
            true => straight(Motion::Traverse, writer.spot(round.to, Point::default())),
            false => {
                let to = writer.spot(round.to, Point::default());
                writer.arc(to, round.centre, round.ccw, 0)
            }
        }))
    }
}
