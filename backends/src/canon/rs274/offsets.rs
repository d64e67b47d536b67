//! Offsets in force, and where the program stands in them.
//!
//! Both are execution's: the interpreter's calls judge it too.

use std::fmt::Write;

use ncc_ir::canon::{AXES, Axis};
use ncc_ir::diag::Diagnostic;
use ncc_ir::program::{Op, Stmt};
use ncc_ir::system::System;

use super::Printer;

impl Printer<'_> {
    /// Lets execution go on by a statement. Contours are worked out before they come here; an arc is judged by this
    /// control's own tolerance where it is printed; a return is the end of the body that is followed.
    pub(super) fn execute(&mut self, stmt: &Stmt) -> Result<(), Diagnostic> {
        let of_a_contour =
            matches!(stmt.op, Op::StartCutterRadiusCompensation { .. } | Op::StopCutterRadiusCompensation);
        if let Op::ArcFeed(arc) = &stmt.op {
            self.exec.stand_at(&self.at.target(&arc.to));
            return Ok(());
        }
        if of_a_contour || matches!(stmt.op, Op::Return) {
            Ok(())
        } else {
            self.exec.step(stmt, &mut Vec::new())
        }
    }

    /// Takes over from execution where the program stands.
    pub(super) fn stand(&mut self) {
        self.at.position = self.exec.position().map(Some);
    }

    /// The values of a work offset.
    pub(super) fn work_offset(&mut self, number: u16) {
        let values = self.values(|axis| System::WorkOffset { number, axis, unit: None });
        let _ = writeln!(self.out, "SET_G5X_OFFSET({number}, {values})");
    }

    /// By how much it is turned.
    pub(super) fn work_turn(&mut self, number: u16) {
        let turn = self.exec.answer(&System::WorkTurn(number)).unwrap_or(0.0);
        let _ = writeln!(self.out, "SET_XY_ROTATION({turn:.4})");
    }

    /// The shift of the origin, zero while it is put aside.
    pub(super) fn origin_shift(&mut self) {
        let shifted = self.exec.answer(&System::OriginShifted) == Some(1.0);
        let values = match shifted {
            true => self.values(|axis| System::OriginShift { axis, unit: None }),
            false => self.values(|_| System::Other("".into())),
        };
        let _ = writeln!(self.out, "SET_G92_OFFSET({values})");
    }

    /// A value for each axis, in the unit in force; what has none is zero.
    fn values(&self, of: impl Fn(Axis) -> System) -> String {
        let mut values = String::with_capacity(AXES * 8);
        for axis in Axis::ALL {
            let value = self.exec.answer(&of(axis)).unwrap_or(0.0);
            let comma = if axis == Axis::X { "" } else { ", " };
            let _ = write!(values, "{comma}{value:.4}");
        }
        values
    }
}
