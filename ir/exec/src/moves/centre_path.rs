//! Execution of cutter radius compensation by the tool centre path: its events in place of those
//! of the programmed contour, in machine coordinates, wherever frames have put the contour.
//!
//! For a comparison with a program in which the compensation is computed. A move is held back until the
//! next one of the plane is known, and with it what stands between them. Refused is what nobody has said:
//! a radius that neither the program nor a profile states; and what has no plain meaning here: a rotary
//! axis that turns along the contour, inverse-time feeds.

use crate::{Event, Exec, Kind};
use ncc_ir::canon::{AXES, Axis, FeedMode, Plane, Side, Turn, same_point};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::geometry;
use ncc_ir::geometry::arc_feed::centre_speed;
use ncc_ir::geometry::offset_path::{Leg, OffsetPath, Rules, Spot, Unreachable};
use ncc_ir::lack::CompensationLack;
use ncc_ir::program::{CutterRadius, Op, Stmt};
use ncc_ir::source::Span;

/// The tool centre path as it is being found.
#[derive(Clone, Debug)]
pub(crate) struct CentrePath {
    rules: Rules,
    /// Radius, less than nothing for the other side; `None` while compensation is off.
    radius: Option<f64>,
    path: Option<OffsetPath>,
    /// The plane, and its axes.
    plane: Plane,
    axes: [usize; 2],
    /// Where the contour is, and where the tool is that goes along it.
    contour: [Nanos; AXES],
    tool: [Nanos; AXES],
    /// The move whose end is not settled, and what stands after it.
    held: Vec<Event>,
    /// The tool is beside the contour that it has to leave.
    leaving: bool,
    /// Where a contour that the tool cannot be followed along is executed as it is programmed, what was left so.
    left_out: Option<Vec<AsProgrammed>>,
}

/// A compensated contour that was executed as it is programmed, though the tool centre path was wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct AsProgrammed {
    /// Why: the fault that stops a comparison there.
    pub fault: Fault,
    /// The block where that was found.
    pub span: Span,
}

fn spot(point: &[Nanos; AXES], axes: [usize; 2]) -> Spot {
    axes.map(|axis| point[axis] as f64 / ONE as f64)
}

fn put(point: &mut [Nanos; AXES], axes: [usize; 2], spot: Spot) {
    for (axis, mm) in axes.into_iter().zip(spot) {
        point[axis] = (mm * ONE as f64).round() as Nanos;
    }
}

fn unreachable(why: Unreachable, span: Span) -> Diagnostic {
    Diagnostic::new(Fault::ContourUnreachable { why }, span)
}

impl Exec {
    /// Makes events of the tool centre path where a contour is compensated.
    pub fn compute_compensation(&mut self, rules: Rules) {
        self.follow_centre(rules, None);
    }

    /// The same for somebody who wants times: a contour whose radius nobody has stated, or along which the tool
    /// cannot go, is executed as it is programmed, and [`Exec::as_programmed`] tells of it.
    pub fn compute_known_compensation(&mut self, rules: Rules) {
        self.follow_centre(rules, Some(Vec::new()));
    }

    /// Contours that were executed as they are programmed, the first first.
    pub fn as_programmed(&self) -> &[AsProgrammed] {
        let left_out = self.centre_path.as_ref().and_then(|path| path.left_out.as_deref());
        left_out.unwrap_or_default()
    }

    /// Whether the tool is beside a contour, and its centre is followed.
    pub fn follows_centre(&self) -> bool {
        self.centre_path.as_ref().is_some_and(|path| path.path.is_some())
    }

    /// Whether what the control does beside a contour must be refused where nobody can follow the tool.
    pub(crate) fn must_follow_centre(&self) -> bool {
        self.centre_path.as_ref().is_some_and(|path| path.left_out.is_none())
    }

    /// The contour goes on as it is programmed.
    pub(crate) fn execute_as_programmed(&mut self, fault: Fault, span: Span, out: &mut Vec<Event>) {
        if let Some(path) = self.centre_path.as_mut().filter(|path| path.radius.is_some()) {
            path.give_up(AsProgrammed { fault, span }, out);
        }
    }

    fn follow_centre(&mut self, rules: Rules, left_out: Option<Vec<AsProgrammed>>) {
        self.centre_path = Some(Box::new(CentrePath {
            rules,
            radius: None,
            path: None,
            plane: Plane::Xy,
            axes: [0, 1],
            contour: self.last,
            tool: self.last,
            held: Vec::new(),
            leaving: false,
            left_out,
        }));
    }

    /// Notes the radius of the compensation that has been switched on.
    pub(crate) fn start_path(&mut self, radius: &CutterRadius, span: Span) -> Result<(), Diagnostic> {
        if self.centre_path.is_none() {
            return Ok(());
        }
        let mm = |nanos: Nanos| nanos as f64 / ONE as f64;
        let known = match radius {
            CutterRadius::Diameter(diameter) => mm(self.value(diameter, span)?).abs() / 2.0,
            CutterRadius::Entry(_) | CutterRadius::Tool | CutterRadius::InForce => {
                let entry = self.state.compensation.entry();
                match entry.and_then(|entry| self.world.tables.radius(entry)) {
                    Some(radius) => mm(radius),
                    None => {
                        let fault = Fault::RadiusUnknown { entry };
                        match self.centre_path.as_mut().and_then(|path| path.left_out.as_mut()) {
                            // A radius of nothing is the contour itself.
                            Some(left_out) => {
                                left_out.push(AsProgrammed { fault, span });
                                0.0
                            }
                            None => return self.fault(fault, span),
                        }
                    }
                }
            }
        };
        let (first, second, _) = self.modes.plane.axes();
        let (plane, here, last) = (self.modes.plane, self.machine(), self.last);
        if let Some(path) = &mut self.centre_path {
            path.radius = (known != 0.0).then_some(known);
            (path.plane, path.axes) = (plane, [first as usize, second as usize]);
            (path.contour, path.tool) = (here, last);
        }
        Ok(())
    }

    /// Executes a statement on a contour that is compensated by computation.
    pub(crate) fn step_beside(
        &mut self,
        stmt: &Stmt,
        on: bool,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        let span = stmt.span;
        if on && matches!(stmt.op, Op::StopCutterRadiusCompensation | Op::ProgramEnd | Op::BeginAgain) {
            self.end_path(span, out)?;
        }
        let mut made = Vec::new();
        self.step_plainly(stmt, &mut made)?;
        self.feed_of_arcs(&mut made);
        let Some(mut path) = self.centre_path.take() else { return Ok(()) };
        let words = crate::moves::compensation::to(&stmt.op);
        let of_the_plane = words.is_some_and(|to| path.axes.iter().any(|axis| to.axes[*axis].is_some()));
        let moves = made.iter().any(|event| event.kind.moves().is_some());
        let named = of_the_plane || path.rules.left_at_once && moves;
        let done = made.into_iter().try_for_each(|event| match on {
            true => path.along_or_as_programmed(event, out),
            false => {
                path.away(event, named, out);
                Ok(())
            }
        });
        if !on && path.leaving {
            // The tool is beside the contour's end, wherever the program believes it to be.
            self.last = path.tool;
            path.leaving = !named;
        }
        self.centre_path = Some(path);
        done
    }

    /// Settles the end of the contour.
    pub(crate) fn end_path(&mut self, span: Span, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let Some(path) = &mut self.centre_path else { return Ok(()) };
        path.radius = None;
        let Some(beside) = path.path.take() else { return Ok(()) };
        let now = beside.now();
        let end = match (beside.leave(), &mut path.left_out) {
            (Ok(end), _) => end,
            (Err(why), None) => return Err(unreachable(why, span)),
            (Err(why), Some(left_out)) => {
                left_out.push(AsProgrammed { fault: Fault::ContourUnreachable { why }, span });
                now
            }
        };
        path.settle(end, out);
        path.leaving = true;
        self.last = path.tool;
        Ok(())
    }
}

impl Exec {
    /// Settles the end of a contour that the text leaves open.
    #[cold]
    pub(crate) fn end_open_path(&mut self, out: &mut Vec<Event>) {
        let Some(path) = &mut self.centre_path else { return };
        path.radius = None;
        if let Some(beside) = path.path.take() {
            path.settle(beside.now(), out);
            self.last = path.tool;
        }
        self.state.compensation = crate::Compensation::default();
    }
}

impl CentrePath {
    /// An event after the contour's end; `named` says whether it leads away from there.
    fn away(&mut self, mut event: Event, named: bool, out: &mut Vec<Event>) {
        event.state.compensation = crate::Compensation::default();
        if event.kind.moves().is_some() {
            if self.leaving && !named {
                for axis in self.axes {
                    event.end[axis] = self.tool[axis];
                }
            }
            if same_point(&event.end, &self.tool) {
                return;
            }
            self.tool = event.end;
        }
        out.push(event);
    }

    /// An event on the contour; where the tool cannot be followed any further and need not be, as it is programmed.
    fn along_or_as_programmed(&mut self, event: Event, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        if self.left_out.is_none() {
            return self.along(event, out);
        }
        let Err(refusal) = self.along(event.clone(), out) else { return Ok(()) };
        self.give_up(AsProgrammed { fault: refusal.fault, span: refusal.span }, out);
        self.along(event, out)
    }

    /// From here on, the contour counts.
    fn give_up(&mut self, why: AsProgrammed, out: &mut Vec<Event>) {
        if let Some(beside) = self.path.take() {
            self.settle(beside.now(), out);
        }
        out.append(&mut self.held);
        self.radius = None;
        if let Some(left_out) = &mut self.left_out {
            left_out.push(why);
        }
    }

    /// An event on the contour.
    fn along(&mut self, mut event: Event, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let span = event.span;
        let (side, on_contour) = (event.state.compensation.side, event.state.compensation.on_contour);
        event.state.compensation = crate::Compensation::default();
        let Some(radius) = self.radius else {
            if event.kind.moves().is_some() {
                (self.contour, self.tool) = (event.end, event.end);
            }
            out.push(event);
            return Ok(());
        };
        let Some(movement) = event.kind.moves() else {
            match self.held.is_empty() {
                true => out.push(event),
                false => self.held.push(event),
            }
            return Ok(());
        };
        let refuse = |lack: CompensationLack| Diagnostic::new(Fault::lacks(lack), span);
        let programmed = event.end;
        if programmed[Axis::A as usize..] != self.contour[Axis::A as usize..] {
            return Err(refuse(CompensationLack::RotaryAxis));
        }
        if event.state.feed_mode == FeedMode::InverseTime && movement != crate::Movement::Rapid {
            return Err(refuse(CompensationLack::FeedByTime));
        }
        let full = matches!(movement, crate::Movement::Arc { full: true, .. });
        let (from, to) = (spot(&self.contour, self.axes), spot(&programmed, self.axes));
        if from == to && !full {
            self.contour = programmed;
            if self.path.is_some() {
                self.held.push(event);
            } else if self.rules.left_at_once {
                return Err(unreachable(Unreachable::Entry, span));
            } else {
                self.tool = event.end;
                out.push(event);
            }
            return Ok(());
        }
        let left = (side == Some(Side::Left)) == (radius > 0.0);
        match &mut self.path {
            None => {
                let path = OffsetPath::enter(radius.abs(), left, self.rules, from, to)
                    .map_err(|why| unreachable(why, span))?;
                put(&mut event.end, self.axes, path.now());
                self.path = Some(path);
                out.append(&mut self.held);
            }
            Some(path) => {
                let leg = match movement {
                    crate::Movement::Rapid => Leg::Line { rapid: true },
                    crate::Movement::Feed => Leg::Line { rapid: false },
                    crate::Movement::Arc { centre, turn, .. } => Leg::Arc {
                        centre: centre.map(|c| c as f64 / ONE as f64),
                        ccw: turn == Turn::Counterclockwise,
                        turns: 0,
                    },
                };
                let corner = path.go_on(leg, to).map_err(|why| unreachable(why, span))?;
                let now = path.now();
                self.settle(corner.end, out);
                if let Some(round) = corner.round {
                    put(&mut self.tool, self.axes, round.to);
                    let mut around = Event { end: self.tool, ..event.clone() };
                    if round.straight {
                        around.kind = Kind::Traverse;
                    } else {
                        let centre = round.centre.map(|mm| (mm * ONE as f64).round() as Nanos);
                        let turn = if round.ccw { Turn::Counterclockwise } else { Turn::Clockwise };
                        around.kind = Kind::Arc { plane: self.plane, turn, full: false, centre };
                    }
                    out.push(around);
                }
                put(&mut event.end, self.axes, now);
                if let (true, Leg::Arc { centre, ccw, .. }) = (on_contour, leg) {
                    let turn = if ccw { Turn::Counterclockwise } else { Turn::Clockwise };
                    event.rate = self.rate_of_centre(event.rate, &programmed, (centre, turn), left);
                }
            }
        }
        self.contour = programmed;
        self.held.push(event);
        Ok(())
    }

    /// The feed of the tool centre on an arc, from where the contour is, of which F is the speed along the contour.
    fn rate_of_centre(
        &self,
        feed: Nanos,
        to: &[Nanos; AXES],
        (centre, turn): (Spot, Turn),
        left: bool,
    ) -> Nanos {
        let Some(tool) = self.radius else { return feed };
        let normal = self.plane.axes().2 as usize;
        let from = spot(&self.contour, self.axes);
        let radius = (from[0] - centre[0]).hypot(from[1] - centre[1]);
        let along = (to[normal] - self.contour[normal]) as f64 / ONE as f64;
        let of = |point: &[Nanos; AXES]| self.axes.map(|axis| point[axis]);
        let middle = centre.map(|mm| (mm * ONE as f64).round() as Nanos);
        let angle = geometry::sweep_degrees(of(&self.contour), of(to), middle, turn, 0).abs().to_radians();
        let part = centre_speed(radius, tool.abs(), left == (turn == Turn::Counterclockwise), angle, along);
        (feed as f64 * part).round() as Nanos
    }

    /// Ends the held move, and passes on what stands after it.
    fn settle(&mut self, end: Spot, out: &mut Vec<Event>) {
        for mut event in self.held.drain(..) {
            if event.kind.moves().is_some() {
                put(&mut event.end, self.axes, end);
                if let Kind::Arc { full, .. } = &mut event.kind {
                    *full &= self.axes.iter().all(|axis| event.end[*axis] == self.tool[*axis]);
                }
                self.tool = event.end;
            }
            out.push(event);
        }
    }
}
