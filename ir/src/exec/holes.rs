//! Execution of canned cycles and patterns.
//!
//! The moves are defined in `passes::expand_cycles` as statements and here as events; a law in the
//! tests holds the two together.

use super::{Event, Exec, Kind};
use crate::canon::{AXES, Axis, Motion, Plane, ReturnLevel};
use crate::cycle::{Approach, Clearance, Cycle, CycleKind, Pattern};
use crate::diag::{Diagnostic, Fault};
use crate::geometry;
use crate::num::Nanos;
use crate::program::Point;
use crate::source::Span;

/// Most pecks of one hole; more is a slip of the pen.
const MOST_PECKS: i64 = 100_000;

/// A cycle in force, in program coordinates.
#[derive(Clone, Debug)]
pub(super) struct InForce {
    plane: Plane,
    initial: Nanos,
    retract: Nanos,
    depth: Nanos,
    return_level: Option<ReturnLevel>,
    approach: Approach,
    way: Way,
}

/// How the hole is made.
#[derive(Clone, Copy, Debug)]
enum Way {
    Drill { dwell: Option<Nanos> },
    Peck { peck: Nanos, clearance: Nanos, dwell: Option<Nanos> },
    Bore { dwell: Option<Nanos> },
}

impl Exec {
    pub(super) fn start_cycle(&mut self, cycle: &Cycle, span: Span) -> Result<(), Diagnostic> {
        let plane = self.plane_of(cycle.plane);
        let normal = plane.axes().2 as usize;
        let initial = self.cycle.as_ref().map_or(self.position[normal], |c| c.initial);
        let retract = self.target(&cycle.retract, initial, span)?;
        let depth = self.target(&cycle.depth, retract, span)?;
        if depth > retract {
            return self.fault(Fault::CycleUpsideDown, span);
        }
        let dwell = |d: &Option<crate::expr::Expr>| d.as_ref().map(|d| self.value(d, span)).transpose();
        let way = match &cycle.kind {
            CycleKind::Drill => Way::Drill { dwell: None },
            CycleKind::DrillDwell { dwell } => Way::Drill { dwell: Some(self.value(dwell, span)?) },
            CycleKind::DrillPeck { peck, clearance, dwell: d } => {
                let peck = self.value(peck, span)?;
                if peck <= 0 || (retract - depth) / peck > MOST_PECKS {
                    return self.fault(Fault::OutOfRange { word: "Q".into() }, span);
                }
                let clearance = match clearance {
                    Clearance::Stated(value) => self.value(value, span)?,
                    Clearance::Parameter => self.world.peck_clearance,
                };
                Way::Peck { peck, clearance, dwell: dwell(d)? }
            }
            CycleKind::Bore { dwell: d } => Way::Bore { dwell: dwell(d)? },
        };
        if let Some(feed) = &cycle.feed {
            self.feed = self.value(feed, span)?;
        }
        self.modes.motion = Motion::Cycle;
        self.cycle = Some(InForce {
            plane,
            initial,
            retract,
            depth,
            return_level: cycle.return_level.known(),
            approach: cycle.approach,
            way,
        });
        Ok(())
    }

    pub(super) fn hole(&mut self, to: &Point, span: Span, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let Some(cycle) = self.cycle.clone() else {
            return self.fault(Fault::NoCycle, span);
        };
        let mut next = self.position;
        for (axis, word) in to.axes.iter().enumerate() {
            if let Some(word) = word {
                next[axis] = self.target(word, self.position[axis], span)?;
            }
        }
        self.make_hole(&cycle, next, to.axes[super::Z].is_some(), span, out)
    }

    pub(super) fn pattern(
        &mut self,
        pattern: &Pattern,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        let Some(cycle) = self.cycle.clone() else {
            return self.fault(Fault::NoCycle, span);
        };
        let (first, second, _) = cycle.plane.axes();
        let (f, s) = (first as usize, second as usize);
        let origin = [self.position[f], self.position[s]];
        match pattern {
            Pattern::Circle { centre, first, step, count } => {
                let pair = |exec: &Exec, p: &[crate::program::Coord; 2]| -> Result<_, Diagnostic> {
                    Ok([exec.target(&p[0], origin[0], span)?, exec.target(&p[1], origin[1], span)?])
                };
                let centre = centre.as_ref().map_or(Ok(origin), |c| pair(self, c))?;
                let first = pair(self, first)?;
                let step = self.value(step, span)?;
                for k in 0..*count {
                    let p = geometry::circle_position(centre, first, step, k);
                    self.hole_at(&cycle, f, s, p, span, out)?;
                }
            }
            Pattern::Grid { columns, rows, serpentine } => {
                let (dx, dy) = (self.value(&columns.pitch, span)?, self.value(&rows.pitch, span)?);
                let total = u64::from(columns.count) * u64::from(rows.count);
                let Ok(total) = u32::try_from(total) else {
                    return self.fault(Fault::OutOfRange { word: "".into() }, span);
                };
                let side = |axis: Axis| usize::from(axis == second);
                for k in 0..total {
                    let (c, r) = geometry::grid_position(columns.count, *serpentine, k);
                    let mut p = origin;
                    p[side(columns.axis)] += dx.wrapping_mul(i64::from(c));
                    p[side(rows.axis)] += dy.wrapping_mul(i64::from(r));
                    self.hole_at(&cycle, f, s, p, span, out)?;
                }
            }
        }
        Ok(())
    }

    fn hole_at(
        &mut self,
        cycle: &InForce,
        first: usize,
        second: usize,
        at: [Nanos; 2],
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        let mut next = self.position;
        next[first] = at[0];
        next[second] = at[1];
        self.make_hole(cycle, next, first == super::Z || second == super::Z, span, out)
    }

    /// One hole; `next` says where, the drilling axis of it is not used. `z` says whether Z is
    /// commanded in the plane, which takes a waiting length up.
    fn make_hole(
        &mut self,
        cycle: &InForce,
        next: [Nanos; AXES],
        z: bool,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        let normal = cycle.plane.axes().2 as usize;
        if self.position[normal] < cycle.retract && cycle.approach == Approach::RaiseFirst {
            self.go_to_level(normal, cycle.retract, false, span, out)?;
        }
        let level = self.position[normal];
        self.position = next;
        self.position[normal] = level;
        if z && normal != super::Z {
            self.take_up_length();
        }
        self.emit_move(false, span, out)?;
        self.go_to_level(normal, cycle.retract, false, span, out)?;
        match cycle.way {
            Way::Drill { dwell } => {
                self.go_to_level(normal, cycle.depth, true, span, out)?;
                self.dwell(dwell, span, out)?;
            }
            Way::Peck { peck, clearance, dwell } => {
                let mut bottom = cycle.retract - peck;
                while bottom > cycle.depth {
                    self.go_to_level(normal, bottom, true, span, out)?;
                    self.go_to_level(normal, cycle.retract, false, span, out)?;
                    self.go_to_level(normal, bottom + clearance, false, span, out)?;
                    bottom -= peck;
                }
                self.go_to_level(normal, cycle.depth, true, span, out)?;
                self.dwell(dwell, span, out)?;
            }
            Way::Bore { dwell } => {
                self.go_to_level(normal, cycle.depth, true, span, out)?;
                self.dwell(dwell, span, out)?;
                self.go_to_level(normal, cycle.retract, true, span, out)?;
            }
        }
        let out_to = match cycle.return_level.unwrap_or(self.modes.return_level) {
            ReturnLevel::Retract => cycle.retract,
            ReturnLevel::Initial => cycle.initial,
        };
        self.go_to_level(normal, out_to, false, span, out)
    }

    fn go_to_level(
        &mut self,
        axis: usize,
        level: Nanos,
        feed: bool,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        if axis == super::Z {
            self.take_up_length();
        }
        self.position[axis] = level;
        self.emit_move(feed, span, out)
    }

    fn dwell(&mut self, seconds: Option<Nanos>, span: Span, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        match seconds {
            Some(seconds) => self.emit(Kind::Dwell(seconds), span, out),
            None => Ok(()),
        }
    }
}
