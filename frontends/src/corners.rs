//! Plain rounding, where somebody has stated how far it leaves the path.
//!
//! A control rounds corners by the lag of its axes, or up to a setting. No program says how far that is; the option
//! `path_tolerance` does. Then a program of that control means rounding within that length, and says so to a control
//! that would go as far from the path as its acceleration asks for.

use ncc_dialects::{PATH_TOLERANCE, Settings};
use ncc_ir::canon::{PathMode, Units};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::{Op, PathControl, Stmt};

/// What plain rounding of a control amounts to.
#[derive(Clone, Debug)]
pub(crate) struct Corners {
    /// How far from the path, mm.
    within: Num,
    /// Whether it is active where a program begins, and that has not been stated yet.
    at_start: bool,
    /// Whether lengths are in inches.
    inch: bool,
}

impl Corners {
    /// As the options of a dialect have it; `None` if nothing is stated.
    pub(crate) fn from_settings(settings: &Settings) -> Option<Corners> {
        let within = settings.length(PATH_TOLERANCE).filter(|within| within.mantissa > 0)?;
        let at_start = settings.dialect.starts_rounding();
        Some(Corners { within, at_start, inch: false })
    }

    /// A program that is called begins as its caller has it.
    pub(crate) fn called(&mut self) {
        self.at_start = false;
    }

    fn control(&self) -> Op {
        let within = Some(Expr::Num(if self.inch { inches(self.within) } else { self.within }));
        Op::SetMotionControlMode(Box::new(PathControl { within, ..PathControl::plain(PathMode::Tolerance) }))
    }

    /// States it in further statements of the main procedure, from `first` on; `units` are those assumed.
    pub(crate) fn state(&mut self, stmts: &mut Vec<Stmt>, first: usize, units: Option<Units>) {
        if self.at_start && units.is_some() {
            self.inch = units == Some(Units::Inch);
        }
        let mut begins = None;
        for (at, stmt) in stmts.iter_mut().enumerate().skip(first) {
            if self.at_start && begins.is_none() && acts(&stmt.op) {
                begins = Some(at);
            }
            self.at_start &= begins.is_some() || !matches!(stmt.op, Op::SetMotionControlMode(_));
            self.state_at(stmt);
        }
        if let Some(at) = begins.filter(|_| self.at_start) {
            let at = (first..=at).rev().find(|at| !stmts[*at].joined).unwrap_or(first);
            stmts.insert(at, Stmt::new(stmts[at].span, self.control()));
            self.at_start = false;
        }
    }

    /// The same in a body.
    pub(crate) fn state_in(&mut self, stmts: &mut [Stmt]) {
        stmts.iter_mut().for_each(|stmt| self.state_at(stmt));
    }

    fn state_at(&mut self, stmt: &mut Stmt) {
        match &mut stmt.op {
            Op::UseLengthUnits(units) => self.inch = *units == Units::Inch,
            Op::SetMotionControlMode(control)
                if control.mode == PathMode::Continuous && control.within.is_none() =>
            {
                stmt.op = self.control();
            }
            Op::Control(control) => control.bodies_mut().for_each(|body| self.state_in(body)),
            _ => {}
        }
    }
}

/// The same length in inches, to a hundred-thousandth.
fn inches(mm: Num) -> Num {
    let nanos = mm.nanos(false).unwrap_or(0);
    Num { mantissa: (nanos * 5 + 635_000) / 1_270_000, scale: 5, point: true, unit: Unit::Inch }.trimmed()
}

/// Whether more happens than that a mode is set.
fn acts(op: &Op) -> bool {
    !matches!(
        op,
        Op::Comment(_)
            | Op::Blank
            | Op::NoEffect(_)
            | Op::UseLengthUnits(_)
            | Op::SetDistanceMode(_)
            | Op::SelectPlane(_)
            | Op::SetFeedMode(_)
            | Op::SetReturnLevel(_)
            | Op::SetOriginOffsets(_)
            | Op::StopCutterRadiusCompensation
            | Op::EndCycle
            | Op::UseToolLengthOffset(_)
            | Op::SetMotionControlMode(_)
            | Op::ClearFrame(_)
    )
}
