//! Digits of incremental words that are below the least increment of a control.
//!
//! Two hundred times X0.0005 is a tenth of a millimetre, or nothing where each word is cut off to thousandths. Of
//! absolute words no more than the least increment is in question: they are taken as they stand.

use crate::Exec;
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::{AXES, Distance, Units};
use ncc_ir::diag::Diagnostic;
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::program::arguments::words_of;
use ncc_ir::program::{Coord, Op, Stmt};
use ncc_ir::source::Span;

/// Least increments of a control, as digits after the point: of millimetres, of inches, of degrees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Increments {
    /// Of millimetres, 0 to 9.
    pub mm: u8,
    /// Of inches, 0 to 9.
    pub inch: u8,
    /// Of degrees, 0 to 9.
    pub degree: u8,
}

impl Increments {
    /// Digits after the point of an axis.
    pub fn digits(self, axis: usize, inch: bool) -> u8 {
        match (axis < 3, inch) {
            (false, _) => self.degree,
            (true, false) => self.mm,
            (true, true) => self.inch,
        }
    }

    /// The least increment of an axis, nanos of a millimetre or a degree.
    fn least_increment(self, axis: usize, inch: bool) -> Nanos {
        let least = ONE / 10_i64.pow(u32::from(self.digits(axis, inch).min(9)));
        if inch && axis < 3 { least * 127 / 5 } else { least }
    }
}

/// What decides what becomes of such digits.
const DIGITS: Behaviour = Behaviour::FineDigits;

impl Exec {
    /// Puts the first axes where words say; incremental ones count from `from`.
    #[inline(always)]
    pub(crate) fn put(
        &mut self,
        words: &[Option<Coord>],
        next: &mut [Nanos; AXES],
        from: &[Nanos; AXES],
        span: Span,
    ) -> Result<(), Diagnostic> {
        let mut absolute = 0;
        for (axis, (word, next)) in words.iter().zip(next.iter_mut()).enumerate() {
            let Some(word) = word else { continue };
            if word.distance.or(self.modes.distance) == Distance::Absolute {
                *next = self.value(&word.value, span)?;
                absolute |= 1 << axis;
                continue;
            }
            *next = self.target(word, from[axis], span)?;
            if self.world.increments.is_some() {
                *next = from[axis] + self.cut_off(axis, *next - from[axis]);
            }
        }
        self.relies_on_slots(absolute);
        Ok(())
    }

    /// An incremental way of an axis as the control takes it.
    #[cold]
    pub(crate) fn cut_off(&mut self, axis: usize, way: Nanos) -> Nanos {
        let Some(least) = self.world.increments.map(|all| all.least_increment(axis, self.modes.inch)) else {
            return way;
        };
        let rest = way % least;
        if rest == 0 || !self.does(DIGITS) { way } else { way - rest }
    }

    /// Whether any of these statements has an incremental word with such digits.
    pub(crate) fn is_fine_in(&self, stmts: &[Stmt]) -> bool {
        let Some(increments) = self.world.increments else { return false };
        let (mut distance, mut inch) = (self.modes.distance, self.modes.inch);
        stmts.iter().any(|stmt| {
            match &stmt.op {
                Op::SetDistanceMode(mode) => distance = *mode,
                Op::UseLengthUnits(units) => inch = *units == Units::Inch,
                _ => {}
            }
            if distance == Distance::Absolute {
                return false;
            }
            let fine = |(axis, word): (usize, &Option<Coord>)| {
                let nanos = word.as_ref().and_then(|word| word.value.literal()).and_then(|n| n.nanos(inch));
                nanos.is_some_and(|nanos| nanos % increments.least_increment(axis, inch) != 0)
            };
            words_of(&stmt.op).is_some_and(|to| to.axes.iter().take(AXES).enumerate().any(fine))
        })
    }
}
