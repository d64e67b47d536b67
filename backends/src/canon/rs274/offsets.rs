//! Offsets active, and where the program stands in them.
//!
//! Both are execution's: the interpreter's calls judge it too.

use std::fmt::Write;

use ncc_ir::canon::{AXES, Axis};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::ONE;
use ncc_ir::expr::system::System;
use ncc_ir::lack::{LengthsLack, TablesLack};
use ncc_ir::program::{Data, Op, Stmt};

use super::{Printer, cannot};

impl Printer<'_> {
    /// Lets execution go on by a statement. Contours are computed before they come here; an arc is judged by this
    /// control's own tolerance where it is printed; a return is the end of the body that is followed.
    pub(super) fn execute(&mut self, stmt: &Stmt) -> Result<(), Diagnostic> {
        let of_a_contour =
            matches!(stmt.op, Op::StartCutterRadiusCompensation { .. } | Op::StopCutterRadiusCompensation);
        if let Op::ArcFeed(arc) = &stmt.op {
            self.exec.stand_at(&self.at.target(&arc.to));
            return Ok(());
        }
        if of_a_contour || matches!(stmt.op, Op::Return) {
            return Ok(());
        }
        self.made.clear();
        self.exec.step(stmt, &mut self.made)?;
        // The interpreter counts from the new length at once.
        self.exec.take_up_at_once();
        Ok(())
    }

    /// The offsets of the tool that are activated by now, in the active unit; of an entry, where the program has put
    /// them all there.
    pub(super) fn tool_offsets(&mut self, entry: &Expr) -> Result<(), Fault> {
        let entry = entry.literal().and_then(|n| n.whole_number()).and_then(|n| u32::try_from(n).ok());
        let stated = |entry| entry == 0 || self.exec.stated_entry(entry).is_some();
        if !entry.is_some_and(stated) {
            return Err(cannot(LengthsLack::NotInTable));
        }
        let unit = if self.inch() { 25.4 } else { 1.0 };
        let [x, y, z] = self.exec.called_up().map(|nanos| nanos as f64 / ONE as f64 / unit);
        let rest = "0.0000 0.0000 0.0000, 0.0000 0.0000 0.0000";
        let _ = writeln!(self.out, "USE_TOOL_LENGTH_OFFSET({x:.4} {y:.4} {z:.4}, {rest})");
        Ok(())
    }

    /// The entry of the table of tools that a block has put values into, and the spindle's, if that tool is in it: at
    /// first the interpreter has the first tool of its table there. The table's unit is the machine's, the inch.
    pub(super) fn tool_entries(&mut self, stmts: &[Stmt]) -> Result<(), Diagnostic> {
        let last = stmts.iter().rev().find_map(|stmt| {
            let Op::SetData(data) = &stmt.op else { return None };
            match **data {
                Data::Tool { entry, .. } | Data::Measured { entry, .. } => Some((entry, stmt.span)),
                Data::Offset { .. } | Data::Position(_) | Data::ToolInSpindle(_) => None,
            }
        });
        let Some((entry, span)) = last else { return Ok(()) };
        let unknown = || Diagnostic::new(cannot(TablesLack::ToolNotWhole), span);
        let offsets = self.exec.stated_entry(entry).ok_or_else(unknown)?;
        let [x, y, z] = offsets.map(|nanos| nanos as f64 / ONE as f64 / 25.4);
        let rest = "0.0000 0.0000 0.0000 0.0000 0.0000 0.0000";
        let first = self.tables.lengths.keys().chain(self.tables.radii.keys()).min() == Some(&entry);
        let loaded = match self.at.tool {
            Some(tool) => tool == i64::from(entry),
            None => first,
        };
        for pocket in [Some(entry), loaded.then_some(0)].into_iter().flatten() {
            let _ = writeln!(
                self.out,
                "SET_TOOL_TABLE_ENTRY({pocket}, {entry}, {x:.4} {y:.4} {z:.4} {rest}, 0.0000, 0.0000, 0)"
            );
        }
        Ok(())
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

    /// The G92 shift, zero while it is put aside.
    pub(super) fn origin_shift(&mut self) {
        let shifted = self.exec.answer(&System::OriginShifted) == Some(1.0);
        let values = match shifted {
            true => self.values(|axis| System::OriginShift { axis, unit: None }),
            false => self.values(|_| System::Other("".into())),
        };
        let _ = writeln!(self.out, "SET_G92_OFFSET({values})");
    }

    /// A value for each axis, in the active unit; what has none is zero.
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
