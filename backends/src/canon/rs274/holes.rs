//! Holes of canned cycles, as the interpreter expands them.

use std::fmt::Write;

use ncc_ir::canon::{AXES, PathMode, ReturnLevel, Turn};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::lack::{HolesLack, ThreadsLack};
use ncc_ir::program::cycle::{BoreStop, Clearance, CycleKind};
use ncc_ir::program::{Op, Stmt};
use ncc_ir::track::ActiveCycle;

use super::{Printer, Turning, cannot, literal};

/// Where a peck goes on, and how far a chip is broken: 0.010 inch.
const GAP: Nanos = 254 * ONE / 1000;

impl Printer<'_> {
    /// The holes of one block: one, or as many as it repeats.
    pub(super) fn holes(&mut self, holes: &[&Stmt]) -> Result<(), Diagnostic> {
        let Some(first) = holes.first() else { return Ok(()) };
        let refuse = |fault| Diagnostic::new(fault, first.span);
        let unknown = || refuse(cannot(HolesLack::PlanesUnknown));
        let in_force = self.at.cycle.clone().ok_or_else(|| refuse(Fault::NoCycle))?;
        let plane = self.at.plane(in_force.cycle.plane).ok_or_else(unknown)?;
        let normal = plane.axes().2 as usize;
        let retract = in_force.retract.ok_or_else(unknown)?;
        let initial = in_force.initial.ok_or_else(unknown)?;
        let clear = match in_force.cycle.return_level.known().or(self.at.modes.return_level) {
            Some(ReturnLevel::Initial) => initial.max(retract),
            Some(ReturnLevel::Retract) | None => retract,
        };
        let mut here = self.here().map_err(refuse)?;
        if initial < retract {
            here[normal] = retract;
            self.straight("STRAIGHT_TRAVERSE", here);
        }
        if self.path != PathMode::ExactPath {
            self.call("SET_MOTION_CONTROL_MODE(CANON_EXACT_PATH)");
        }
        // No higher than the retract plane, it goes straight to where it would return to.
        let mut level = if here[normal] > retract { here[normal] } else { clear };
        for stmt in holes {
            let Op::Hole(hole) = &stmt.op else { continue };
            let mut to = self.target(&hole.to).map_err(refuse)?;
            to[normal] = level;
            self.straight("STRAIGHT_TRAVERSE", to);
            if level > retract {
                to[normal] = retract;
                self.straight("STRAIGHT_TRAVERSE", to);
            }
            self.hole(&in_force, to, normal, retract, clear).map_err(refuse)?;
            self.at.apply(&stmt.op);
            self.execute(stmt)?;
            level = clear;
        }
        self.stand();
        if self.path != PathMode::ExactPath {
            self.path_control();
        }
        Ok(())
    }

    /// One hole, from the retract plane over it.
    fn hole(
        &mut self,
        in_force: &ActiveCycle,
        to: [Nanos; AXES],
        normal: usize,
        retract: Nanos,
        clear: Nanos,
    ) -> Result<(), Fault> {
        let depth = in_force.depth.ok_or_else(|| cannot(HolesLack::PlanesUnknown))?;
        let go = |printer: &mut Self, name: &str, level: Nanos| {
            let mut at = to;
            at[normal] = level;
            printer.straight(name, at);
        };
        let (feed, rapid) = ("STRAIGHT_FEED", "STRAIGHT_TRAVERSE");
        match &in_force.cycle.kind {
            CycleKind::Drill => {
                go(self, feed, depth);
                go(self, rapid, clear);
            }
            CycleKind::DrillDwell { dwell } => {
                go(self, feed, depth);
                let _ = writeln!(self.out, "DWELL({:.4})", literal(dwell)?);
                go(self, rapid, clear);
            }
            CycleKind::DrillPeck { clearance: Clearance::FromReturn, .. } => {
                return Err(cannot(HolesLack::FeedDownPecks));
            }
            CycleKind::DrillPeck { peck, .. } => {
                let peck = self.at.nanos(peck).filter(|p| *p > 0).ok_or_else(|| cannot(HolesLack::Peck))?;
                let mut bottom = retract - peck;
                while bottom > depth {
                    go(self, feed, bottom);
                    go(self, rapid, retract);
                    go(self, rapid, bottom + GAP);
                    bottom -= peck;
                }
                go(self, feed, depth);
                go(self, rapid, clear);
            }
            CycleKind::DrillBreak { peck, .. } => {
                let peck = self.at.nanos(peck).filter(|p| *p > 0).ok_or_else(|| cannot(HolesLack::Peck))?;
                let mut bottom = retract - peck;
                while bottom > depth {
                    go(self, feed, bottom);
                    go(self, rapid, bottom + GAP);
                    bottom -= peck;
                }
                go(self, feed, depth);
                go(self, rapid, clear);
            }
            CycleKind::Bore { dwell: None, .. } => {
                go(self, feed, depth);
                go(self, feed, retract);
                go(self, rapid, clear);
            }
            CycleKind::Bore { dwell: Some(dwell), .. } => {
                go(self, feed, depth);
                let _ = writeln!(self.out, "DWELL({:.4})", literal(dwell)?);
                go(self, feed, clear);
            }
            CycleKind::BoreStop(BoreStop { dwell, stop: false, .. }) => {
                let before = self.turning;
                go(self, feed, depth);
                let dwell = dwell.as_ref().map_or(Ok(0.0), literal)?;
                let _ = writeln!(self.out, "DWELL({dwell:.4})");
                self.turn(Turning::Stopped);
                go(self, rapid, clear);
                self.turn(before);
            }
            CycleKind::Tap(tap) if tap.chuck && tap.dwell.is_none() && tap.settle.is_none() => {
                let (way, back) = match tap.turn {
                    Turn::Clockwise => (Turning::Clockwise, Turning::Counterclockwise),
                    Turn::Counterclockwise => (Turning::Counterclockwise, Turning::Clockwise),
                };
                if self.turning != way {
                    return Err(cannot(ThreadsLack::SpindleDirection));
                }
                self.call("DISABLE_FEED_OVERRIDE()");
                self.call("DISABLE_SPEED_OVERRIDE(0)");
                go(self, feed, depth);
                self.turn(Turning::Stopped);
                self.turn(back);
                let dwell = tap.back.as_ref().map_or(Ok(0.0), literal)?;
                let _ = writeln!(self.out, "DWELL({dwell:.4})");
                go(self, feed, clear);
                self.turn(Turning::Stopped);
                self.turn(way);
                self.call("ENABLE_FEED_OVERRIDE()");
                self.call("ENABLE_SPEED_OVERRIDE(0)");
            }
            CycleKind::BoreStop(_) | CycleKind::Tap(_) | CycleKind::FineBore(_) => {
                return Err(cannot(HolesLack::Kind { kind: in_force.cycle.kind.name() }));
            }
        }
        Ok(())
    }
}
