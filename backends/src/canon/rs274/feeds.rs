//! What feeds and speeds count, and the inverse-time feed of each move.

use std::f64::consts::TAU;
use std::fmt::Write;

use ncc_ir::canon::{AXES, FeedMode, SpindleMode};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::lack::CompensationLack;
use ncc_ir::program::{Op, Stmt};

use super::{Printer, cannot, literal, notes};

/// Least feed that the interpreter makes of a time, in the active unit a minute.
const LEAST: f64 = 0.1;

/// Limit of the spindle under a surface speed where the program says none.
const NO_LIMIT: f64 = 1e30;

impl Printer<'_> {
    pub(super) fn feed(&mut self, feed: f64) {
        self.feed = Some(feed);
        let _ = writeln!(self.out, "SET_FEED_RATE({feed:.4})");
    }

    /// Inverse time sets no feed until a move has one.
    pub(super) fn feed_mode(&mut self, mode: FeedMode) -> Result<(), Fault> {
        self.feed = None;
        let turns = u8::from(mode == FeedMode::PerRevolution);
        self.note(notes::feed_mode(mode));
        let _ = writeln!(self.out, "SET_FEED_MODE(0, {turns})");
        if mode != FeedMode::InverseTime {
            self.call("SET_FEED_RATE(0.0000)");
        }
        Ok(())
    }

    /// The limit of the spindle that a block says.
    pub(super) fn limit_of(&self, stmts: &[Stmt]) -> Result<Option<f64>, Diagnostic> {
        let limit = |stmt: &Stmt| {
            let Op::LimitSpindleSpeed(limit) = &stmt.op else { return None };
            Some(literal(limit).map_err(|fault| Diagnostic::new(fault, stmt.span)))
        };
        stmts.iter().find_map(limit).transpose()
    }

    pub(super) fn spindle_mode(&mut self, mode: SpindleMode) {
        let limit = match mode {
            SpindleMode::Turns => 0.0,
            SpindleMode::Surface => self.limit.unwrap_or(NO_LIMIT),
        };
        let _ = writeln!(self.out, "SET_SPINDLE_MODE(0 {limit:.4})");
    }

    /// The inverse-time feed of a straight move.
    pub(super) fn rate_of_line(&mut self) -> Result<(), Fault> {
        let (here, to) = (self.here()?, self.exec.position());
        let way: [f64; AXES] = std::array::from_fn(|axis| self.shown(axis, to[axis] - here[axis]));
        let root = |of: &[f64]| of.iter().map(|n| n * n).sum::<f64>().sqrt();
        let (linear, rotary) = (root(&way[..3]), root(&way[3..]));
        self.rate_of(if linear > 0.0 { linear } else { rotary })
    }

    /// The inverse-time feed of an arc: start, end and centre in its plane, turns by their sense, and how
    /// far it goes along the normal.
    pub(super) fn rate_of_arc(
        &mut self,
        [start, end, centre]: [[Nanos; 2]; 3],
        turns: i64,
        along: Nanos,
    ) -> Result<(), Fault> {
        let out = |p: [Nanos; 2]| [0, 1].map(|i| (p[i] - centre[i]) as f64 / ONE as f64);
        let ([x1, y1], [x2, y2]) = (out(start), out(end));
        let ahead = (y2.atan2(x2) - y1.atan2(x1)) * turns.signum() as f64;
        let part = if start == end { TAU } else { ahead.rem_euclid(TAU) };
        let round = x1.hypot(y1) * (part + TAU * (turns.abs() - 1) as f64);
        let unit = if self.inch() { 25.4 } else { 1.0 };
        self.rate_of(round.hypot(along as f64 / ONE as f64) / unit)
    }

    fn rate_of(&mut self, way: f64) -> Result<(), Fault> {
        if self.at.modes.feed_mode != Some(FeedMode::InverseTime) {
            return Ok(());
        }
        if self.beside {
            // The tool centre path is another, and settled late.
            return Err(cannot(CompensationLack::FeedModeListed));
        }
        let often = self.feed.ok_or(Fault::NoFeed)?;
        let _ = writeln!(self.out, "SET_FEED_RATE({:.4})", (way * often).max(LEAST));
        Ok(())
    }
}
