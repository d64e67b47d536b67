//! Values of words: literals, in nanos of their unit.
//!
//! ```text
//! X12.5 under G20    317,500,000 nanos of a millimetre
//! ```
//!
//! Not here: expressions, which a run replaces by literals (`run`).

use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num, POW10, Unit};
use ncc_ir::source::Span;
use ncc_ir::syntax::Ranged;
use ncc_ir::unexecuted::ValueUnexecuted;

use crate::{Exec, MOST_BITS};

impl Exec {
    /// A literal's value in nanos.
    #[inline]
    pub(crate) fn value(&self, value: &Expr, span: Span) -> Result<Nanos, Diagnostic> {
        if let Some(value) = self.plain_value(value) {
            return Ok(value);
        }
        match value {
            Expr::Num(n) => {
                let about = n.mantissa / POW10[usize::from(n.scale)];
                self.fault(Fault::OutOfRange { word: Ranged::TooLarge { about } }, span)
            }
            Expr::Node(_) => self.fault(Fault::not_executed(ValueUnexecuted::Expression), span),
        }
    }

    /// The value of a word; `None` if it is an expression or out of range.
    #[inline]
    pub(crate) fn plain_value(&self, value: &Expr) -> Option<Nanos> {
        let Expr::Num(n) = value else { return None };
        self.plain_number(*n)
    }

    /// The same of a number.
    #[inline(always)]
    pub(crate) fn plain_number(&self, n: Num) -> Option<Nanos> {
        let inch = n.unit == Unit::Entry && self.modes.inch;
        // Controls have words to 999999.999 (Fanuc 30i), and round them in whole numbers of 32 bits.
        n.nanos(inch).filter(|value| value.unsigned_abs() < 1 << MOST_BITS)
    }

    /// The value of a word that counts something.
    #[inline]
    pub(crate) fn whole_number(&self, value: &Expr, span: Span) -> Result<i64, Diagnostic> {
        match value.literal().and_then(|n| n.whole_number()) {
            Some(n) => Ok(n),
            None => self.fault(Fault::OutOfRange { word: Ranged::Unnamed }, span),
        }
    }
}
