//! Codes of which the number is a variable: `G#3`.
//!
//! Read again, the variable must have its value from the active codes, which the reader of the output tells.

use ncc_dialects::Meaning;
use ncc_ir::computed::computed_code::ComputedCode;
use ncc_ir::diag::Fault;
use ncc_ir::program::{Op, Stmt};
use ncc_ir::run_time::RunTimeWord;

use crate::common::Sink;
use crate::common::fault::cannot_compute;
use crate::word::Writer;

/// What the code that such a statement stands for means.
fn meaning(op: &Op) -> Option<Meaning> {
    if let Op::UseLengthUnits(units) = op {
        Some(Meaning::UseLengthUnits(*units))
    } else if let Op::SelectPlane(plane) = op {
        Some(Meaning::SelectPlane(*plane))
    } else if let Op::SetDistanceMode(distance) = op {
        Some(Meaning::SetDistanceMode(*distance))
    } else if let Op::SetFeedMode(mode) = op {
        Some(Meaning::SetFeedMode(*mode))
    } else if let Op::SetOriginOffsets(offset) = op {
        Some(Meaning::SetOriginOffsets(*offset))
    } else if let Op::SetReturnLevel(level) = op {
        Some(Meaning::SetReturnLevel(*level))
    } else if let Op::StraightTraverse(to) = op {
        to.to.is_empty().then_some(Meaning::StraightTraverse)
    } else if let Op::StraightFeed(to) = op {
        to.to.is_empty().then_some(Meaning::StraightFeed)
    } else {
        None
    }
}

impl Writer {
    /// Such a code as the control says it.
    pub(in crate::word) fn code_of_variable(
        &mut self,
        code: &ComputedCode,
        stmt: &Stmt,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let says = |(number, op): &(i64, &Op)| {
            let row = u32::try_from(number * 10).ok().and_then(|tenths| self.dialect.code_row(b'G', tenths));
            row.is_some_and(|row| row.means.is_some() && row.means == meaning(op))
        };
        if !code.codes.iter().all(says) {
            return Err(cannot_compute(RunTimeWord::ComputedCode));
        }
        self.flow(stmt, sink)?;
        let number = self.words.behind(code.number, None, stmt.span, sink)?;
        self.statement_alone(&format!("G{number}"), sink)?;
        self.forget();
        Ok(())
    }
}
