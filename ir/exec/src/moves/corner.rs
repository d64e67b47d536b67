//! Executes corners: a round or a chamfer between two moves of the plane.
//!
//! ```text
//! feed to X10, round of 2, feed to Y10    →    feed to X8, arc of radius 2 to X10 Y2, feed to Y10
//! ```
//!
//! The executor holds back the first move until the next move is known. Then it shortens both moves and inserts
//! the corner. It refuses corners that controls refuse or execute differently: a corner without a next move, next to
//! a rapid move, or between moves with different feeds. Not here: the geometry (`ncc_ir::geometry::corner`).

use crate::{Event, Exec, Kind, State};
use ncc_ir::canon::{AXES, CornerShape, FeedMode, Plane};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::geometry::corner::{self, Leg};
use ncc_ir::program::{Op, Shape, Stmt};
use ncc_ir::source::Span;
use ncc_ir::unexecuted::{CornerUnexecuted, NoCorner};

/// A programmed corner that is not executed yet.
#[derive(Clone, Debug, Default)]
pub(crate) struct Corner {
    /// Corner at the end of the next move.
    asked: Option<Asked>,
    /// Corner at the end of the move held back, with that move.
    held: Option<Held>,
}

#[derive(Clone, Copy, Debug)]
struct Asked {
    shape: CornerShape,
    size: Nanos,
    span: Span,
}

#[derive(Clone, Debug)]
struct Held {
    asked: Asked,
    plane: Plane,
    leg: Leg,
    event: Event,
    /// Events since the move held back, in order.
    reported: Vec<Event>,
}

/// Role of a statement while a corner is open.
enum Part<'s> {
    Move,
    /// A setting that is allowed between the two moves of a corner.
    Beside,
    Corner(CornerShape, &'s Expr),
    Plane(Plane),
    Other,
}

fn part(op: &Op) -> Part<'_> {
    match op {
        Op::Corner { shape, size } => Part::Corner(*shape, size),
        Op::SelectPlane(plane) => Part::Plane(*plane),
        Op::StraightFeed(_)
        | Op::StraightTraverse(_)
        | Op::ArcFeed(_)
        | Op::ArcForm(_)
        | Op::Polar(_)
        | Op::Position(_) => Part::Move,
        op if corner::may_stand_between(op) => Part::Beside,
        _ => Part::Other,
    }
}

impl Exec {
    /// Span of the corner that is not executed yet, if any.
    pub fn open_corner(&self) -> Option<Span> {
        let corner = self.corner.as_ref()?;
        corner.asked.or(corner.held.as_ref().map(|held| held.asked)).map(|asked| asked.span)
    }

    /// Checks that no corner is left without a next move.
    ///
    /// # Errors
    /// A corner is still open.
    pub fn no_open_corner(&self) -> Result<(), Diagnostic> {
        match self.open_corner() {
            None => Ok(()),
            Some(span) => no_corner(NoCorner::NoNextMove, span),
        }
    }

    /// Records a corner at the end of the next move.
    ///
    /// # Errors
    /// The size is not above 0, or is above [`corner::LARGEST`]; or the next move already has a corner.
    #[cold]
    pub(crate) fn ask_corner(
        &mut self,
        shape: CornerShape,
        size: &Expr,
        span: Span,
    ) -> Result<(), Diagnostic> {
        let size = self.value(size, span)?;
        if size <= 0 || size > corner::LARGEST {
            return no_corner(NoCorner::NoSize, span);
        }
        let corner = self.corner.get_or_insert_default();
        if corner.asked.is_some() {
            return not_told(CornerUnexecuted::TwoAfterMove, span);
        }
        corner.asked = Some(Asked { shape, size, span });
        Ok(())
    }

    /// Executes a statement while a corner is open.
    #[cold]
    pub(crate) fn step_at_corner(&mut self, stmt: &Stmt, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let Some(mut corner) = self.corner.take() else { return self.step_on_way(stmt, out) };
        let span = stmt.span;
        match part(&stmt.op) {
            Part::Move => {
                self.move_at_corner(stmt, &mut corner, out)?;
                self.corner = corner.held.is_some().then_some(corner);
                return Ok(());
            }
            Part::Corner(shape, size) => {
                self.corner = Some(corner);
                return self.ask_corner(shape, size, span);
            }
            Part::Plane(plane) if plane != self.modes.plane => {
                return no_corner(NoCorner::PlaneChanges, span);
            }
            Part::Beside | Part::Plane(_) => {}
            Part::Other => {
                return match &stmt.op {
                    Op::ProgramEnd | Op::BeginAgain | Op::Return => no_corner(NoCorner::NoNextMove, span),
                    _ => not_told(CornerUnexecuted::NotSettings, span),
                };
            }
        }
        let before = out.len();
        self.step_on_way(stmt, out)?;
        if let Some(held) = &mut corner.held {
            held.reported.extend(out.drain(before..));
        }
        self.corner = Some(corner);
        Ok(())
    }

    /// Executes a move with a corner at its start, at its end or at both.
    fn move_at_corner(
        &mut self,
        stmt: &Stmt,
        corner: &mut Corner,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        let span = stmt.span;
        if self.raw.is_some() {
            return not_told(CornerUnexecuted::MachineMove, span);
        }
        if self.probing.is_some() {
            return not_told(CornerUnexecuted::Probing, span);
        }
        if self.detour.is_some() {
            return not_told(CornerUnexecuted::Detour, span);
        }
        if self.centre_path.is_some() && self.contour.watched {
            let what = CornerUnexecuted::OnContour;
            if self.must_follow_centre() {
                return not_told(what, span);
            }
            self.execute_as_programmed(Fault::not_executed(what), span, out);
        }
        if self.state.tip || self.state.tilted {
            return not_told(CornerUnexecuted::AxisTurned, span);
        }
        if corner.held.is_some()
            && let Op::ArcForm(arc) = stmt.op.unwrapped()
            && arc.shape == Shape::Tangent
        {
            return not_told(CornerUnexecuted::TangentArc, span);
        }
        let plane = self.modes.plane;
        self.undistorted(plane, span)?;
        let (before, frame, events) = (self.position, self.frame, out.len());
        self.step_on_way(stmt, out)?;
        if out.len() != events + 1 {
            return match out.len() == events {
                true => no_corner(NoCorner::NoMotion, span),
                false => not_told(CornerUnexecuted::SeveralTurns, span),
            };
        }
        let Some(event) = out.pop() else { return Ok(()) };
        let mut leg = self.leg(&event, plane, &before, frame == self.frame, span)?;
        if let Some(held) = corner.held.take() {
            self.make_corner(held, &event, plane, &mut leg, span, out)?;
        }
        match corner.asked.take() {
            Some(_) if leg.from == leg.to => {
                return no_corner(NoCorner::TooLarge, span);
            }
            Some(asked) => corner.held = Some(Held { asked, plane, leg, event, reported: Vec::new() }),
            None if leg.from == leg.to => {}
            None => out.push(event),
        }
        Ok(())
    }

    /// The move of an event in the plane, in program coordinates. `before` is its start point.
    ///
    /// # Errors
    /// The move leaves the plane, has no length, or is no feed move or arc.
    fn leg(
        &self,
        event: &Event,
        plane: Plane,
        before: &[Nanos; AXES],
        same_frame: bool,
        span: Span,
    ) -> Result<Leg, Diagnostic> {
        let (first, second, _) = plane.axes();
        let (first, second) = (first as usize, second as usize);
        let stays = (0..AXES).all(|i| i == first || i == second || before[i] == self.position[i]);
        if !stays || !same_frame {
            return no_corner(NoCorner::LeavesPlane, span);
        }
        let from = [before[first], before[second]];
        let to = [self.position[first], self.position[second]];
        let bend = match &event.kind {
            Kind::Feed if from == to => return no_corner(NoCorner::NoMotion, span),
            Kind::Feed => None,
            Kind::Arc { full: true, .. } => return not_told(CornerUnexecuted::FullCircle, span),
            Kind::Arc { plane: own, centre, turn, .. } if *own == plane => {
                let mut middle = event.end;
                (middle[first], middle[second]) = (centre[0], centre[1]);
                let middle = self.unplace(&middle);
                // Direction of the arc in the program: a mirror is its own inverse.
                let sense = self.chain.as_ref().map_or(Some(*turn), |chain| chain.sense(plane, *turn));
                let Some(sense) = sense else {
                    return not_told(CornerUnexecuted::Frame, span);
                };
                Some((sense, [middle[first], middle[second]]))
            }
            Kind::Arc { .. } => return no_corner(NoCorner::LeavesPlane, span),
            Kind::Traverse => return not_told(CornerUnexecuted::Rapid, span),
            _ => return not_told(CornerUnexecuted::OtherMove, span),
        };
        Ok(Leg { from, to, bend })
    }

    /// Inserts the corner between the move held back and the next one, and shortens both.
    fn make_corner(
        &mut self,
        held: Held,
        next: &Event,
        plane: Plane,
        leg: &mut Leg,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        let Held { asked, plane: own, leg: before, mut event, mut reported } = held;
        if own != plane {
            return no_corner(NoCorner::PlaneChanges, span);
        }
        if event.state.feed_mode == FeedMode::InverseTime {
            return not_told(CornerUnexecuted::FeedByTime, span);
        }
        if event.rate != next.rate {
            return not_told(CornerUnexecuted::DifferentFeeds, span);
        }
        // With cutter compensation the inserted corner has another feed, so ignore that flag here.
        let but_for_feed = |mut state: State| {
            state.compensation.on_contour = false;
            state
        };
        if but_for_feed(event.state) != but_for_feed(next.state) {
            return not_told(CornerUnexecuted::DifferentPath, span);
        }
        let made = corner::between(&before, leg, asked.shape, asked.size);
        let made = made.map_err(|fault| Diagnostic::new(fault.fault(), asked.span))?;
        let Some(made) = made else {
            out.push(event);
            out.append(&mut reported);
            return Ok(());
        };
        let (first, second, _) = plane.axes();
        let placed = |at: [Nanos; 2]| {
            let mut point = self.position;
            (point[first as usize], point[second as usize]) = (at[0], at[1]);
            self.place(&point)
        };
        let kind = match made.bend {
            None => Kind::Feed,
            Some((turn, centre)) => {
                let sense = self.chain.as_ref().map_or(Some(turn), |chain| chain.sense(plane, turn));
                let Some(turn) = sense else {
                    return not_told(CornerUnexecuted::Frame, span);
                };
                let centre = placed(centre);
                let centre = [centre[first as usize], centre[second as usize]];
                Kind::Arc { plane, turn, full: false, centre }
            }
        };
        let mut inserted = [Event { kind, end: placed(made.to), span: asked.span, ..event.clone() }];
        if made.from != before.from {
            event.end = placed(made.from);
            out.push(event);
        }
        self.feed_of_arcs(&mut inserted);
        out.extend(inserted);
        out.append(&mut reported);
        leg.from = made.to;
        Ok(())
    }

    /// Refuses frames that change a length in the plane, such as scaling.
    fn undistorted(&self, plane: Plane, span: Span) -> Result<(), Diagnostic> {
        if self.chain.is_none() {
            return Ok(());
        }
        let (first, second, _) = plane.axes();
        let zero = self.place(&[0; AXES]);
        let same = [first, second].into_iter().all(|axis| {
            let mut point = [0; AXES];
            point[axis as usize] = 1000 * ONE;
            let placed = self.place(&point);
            let square: f64 = (0..3).map(|i| ((placed[i] - zero[i]) as f64).powi(2)).sum();
            (square.sqrt() - 1000.0 * ONE as f64).abs() < 1000.0
        });
        match same {
            true => Ok(()),
            false => not_told(CornerUnexecuted::Scaled, span),
        }
    }
}

/// Reports a corner that no control can execute.
fn no_corner<T>(why: NoCorner, span: Span) -> Result<T, Diagnostic> {
    Err(Diagnostic::new(Fault::NoCorner { why }, span))
}

/// Refuses a corner that no manual describes, or that controls execute differently.
fn not_told<T>(what: CornerUnexecuted, span: Span) -> Result<T, Diagnostic> {
    Err(Diagnostic::new(Fault::not_executed(what), span))
}
