//! Incremental words of a control that cuts off their digits below its least increment: as the control takes them.
//!
//! Not here: controls of which nobody has said whether they do so. Their programs are executed with both values.

use ncc_exec::Increments;
use ncc_ir::behaviour::{Behaviour, Behaviours};
use ncc_ir::canon::{Distance, Units};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, POW10};
use ncc_ir::program::arguments::words_of_mut;
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Op, Stmt};

/// What is known from piece to piece of a program.
#[derive(Clone, Debug, Default)]
pub(crate) struct FineDigitsState {
    /// Of the source's control, if it cuts digits off and the target's does not.
    increments: Option<Increments>,
    distance: Option<Distance>,
    inch: bool,
    reported: bool,
}

impl FineDigitsState {
    pub(crate) fn new(
        source: &Behaviours,
        target: &Behaviours,
        increments: Option<Increments>,
    ) -> FineDigitsState {
        let digits = Behaviour::FineDigits;
        let cuts = source.surely(digits) && !target.surely(digits);
        FineDigitsState { increments: increments.filter(|_| cuts), ..FineDigitsState::default() }
    }

    /// Whether there is anything to do.
    pub(crate) fn is_used(&self) -> bool {
        self.increments.is_some()
    }

    /// Whether further statements may have such digits, or say what they count.
    pub(crate) fn touches(&self, stmts: &[Stmt]) -> bool {
        let incremental = |stmt: &Stmt| matches!(stmt.op, Op::SetDistanceMode(_));
        self.increments.is_some()
            && (self.distance != Some(Distance::Absolute) || stmts.iter().any(incremental))
    }

    /// Cuts the digits off in further statements.
    pub(crate) fn cut_digits(&mut self, stmts: &mut [Stmt], diags: &mut Vec<Diagnostic>) {
        let Some(increments) = self.increments else { return };
        for stmt in stmts {
            match &stmt.op {
                Op::SetDistanceMode(distance) => {
                    self.distance = Some(*distance).filter(|_| stmt.skip.is_none())
                }
                Op::UseLengthUnits(units) => self.inch = *units == Units::Inch,
                flow!() => self.distance = None,
                _ => {}
            }
            let (span, known) = (stmt.span, self.distance);
            let Some(to) = words_of_mut(&mut stmt.op) else { continue };
            for (axis, word) in to.axes.iter_mut().enumerate() {
                let Some(word) = word else { continue };
                let incremental = word.distance.known().or(known) == Some(Distance::Incremental);
                let Expr::Num(n) = &mut word.value else { continue };
                let digits = increments.digits(axis, self.inch);
                if incremental && n.scale > digits {
                    let cut = n.mantissa / POW10[usize::from(n.scale - digits)];
                    if cut * POW10[usize::from(n.scale - digits)] == n.mantissa {
                        continue;
                    }
                    *n = Num { mantissa: cut, scale: digits, ..*n }.trimmed();
                    if !std::mem::replace(&mut self.reported, true) {
                        let behaviour = Behaviour::FineDigits;
                        diags.push(Diagnostic::new(Fault::SideEffectWritten { behaviour }, span));
                    }
                }
            }
        }
    }
}
