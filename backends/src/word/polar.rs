//! Points by radius and angle, in a mode of their own: the words of the plane's axes are radius and
//! angle while it is on, and coordinates again when it is off.
//!
//! What can be said so at all, a pass has seen to.

use ncc_ir::diag::Fault;
use ncc_ir::geometry::polar;
use ncc_ir::lack::PolarLack;
use ncc_ir::program::{Op, Polar, Stmt};

use super::Writer;
use crate::common::Sink;
use crate::common::block::{Need, Part, Rank};
use crate::common::fault::cannot;

impl Writer {
    /// Writes a move to a polar point.
    ///
    /// # Errors
    /// The dialect has no such mode, or the point is not one of it.
    pub(crate) fn polar(&mut self, polar: &Polar, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        let on = self.words.codes.polar[1].ok_or_else(|| cannot(PolarLack::Point))?;
        if stmt.skip.is_some() {
            return Err(cannot(PolarLack::PointSkipped));
        }
        let plane = polar.plane.known().or(self.words.active.plane);
        let plane = plane.ok_or_else(|| cannot(PolarLack::PointPlaneUnknown))?;
        let mut inserted = crate::common::setting::Inserted::default();
        self.words.need_plane(polar.plane, &mut inserted)?;
        self.words.admit_with(Need::new(Rank::Setting), inserted, sink)?;
        if !self.polar {
            self.words.admit(&Need::new(Rank::Setting).code(Some(on)), sink)?;
            self.words.block.code(Part::Mode, &on);
            self.polar = true;
        }
        let (first, second, _) = plane.axes();
        let mut op = polar.op.clone();
        let to = polar::end(&mut op).ok_or_else(|| cannot(PolarLack::FunctionToPoint))?;
        for (axis, word) in [(first, &polar.radius), (second, &polar.angle)] {
            if let Some(word) = word {
                to.set(axis, word.clone());
            }
        }
        let span = stmt.span;
        if let Op::StraightTraverse(to) = &op {
            self.words.straight(to, true, span, sink)
        } else if let Op::StraightFeed(to) = &op {
            self.words.straight(to, false, span, sink)
        } else if let Op::ArcFeed(arc) = &op {
            self.arc(arc, span, sink)
        } else if let Op::Hole(to) = &op {
            self.hole(to, stmt, sink)
        } else {
            Err(cannot(PolarLack::FunctionToPoint))
        }
    }

    /// Goes back to coordinates before a statement that the mode would change.
    pub(crate) fn leave_polar(&mut self, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        if !self.polar || !polar::leaves_points(&stmt.op, self.words.active.plane) {
            return Ok(());
        }
        let off = self.words.codes.polar[0].ok_or_else(|| cannot(PolarLack::PointsEnd))?;
        // A block that is skipped must not say it.
        let skip = self.words.block.skip.take();
        self.words.admit(&Need::new(Rank::Setting).code(Some(off)), sink)?;
        self.words.block.code(Part::Mode, &off);
        if skip.is_some() {
            self.words.flush(false, sink);
            self.words.block.skip = skip;
        }
        self.polar = false;
        Ok(())
    }
}
