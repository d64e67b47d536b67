//! Lowers corners: rounded or chamfered after one move, or rounded after every move.
//!
//! The modal word is lowered as the word of one corner in each block whose move may have one. While it is active, a call,
//! a jump target or a block skip is refused: the corner there is not in the text.

use ncc_dialects::{NameRole, Quantity};
use ncc_ir::canon::{Axis, CornerShape};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::program::Op;
use ncc_ir::source::Span;
use ncc_ir::unsupported::MoveUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::siemens::block_words::Words;
use crate::siemens::lower::Lower;

const CORNERS: [(NameRole, CornerShape); 3] = [
    (NameRole::RoundCorner, CornerShape::Round),
    (NameRole::ChamferCorner, CornerShape::Leg),
    (NameRole::ChamferCornerByLength, CornerShape::Length),
];

impl Lower {
    /// The word that rounds every corner from this block on.
    pub(in crate::siemens) fn modal_rounding(&mut self, words: &mut Words, src: Source, out: &mut Batch) {
        let Some(given) = words.take_named(NameRole::RoundCorners) else { return };
        let Some(num) = self.number(given, Quantity::Length, src, out) else { return };
        if self.skipped() {
            let what = MoveUnsupported::RoundingSkipped;
            return self.not_supported(&src.text(given.span), what, given.span, out);
        }
        if num.mantissa < 0 {
            return self.fault(Fault::OutOfRange { word: src.text(given.span).into() }, given.span, out);
        }
        self.rounding = (num.mantissa > 0).then_some(num);
        self.now.heading = true;
    }

    /// The word of the corner after this block's move.
    pub(in crate::siemens) fn corner(
        &mut self,
        words: &mut Words,
        block: Span,
        src: Source,
        out: &mut Batch,
    ) {
        let mut first: Option<Span> = None;
        for (role, shape) in CORNERS {
            let Some(given) = words.take_named(role) else { continue };
            if let Some(other) = first.replace(given.span) {
                let fault = Fault::CodesExclude { first: src.text(other), second: src.text(given.span) };
                self.now.failed = true;
                out.diagnostics.push(Diagnostic { fault, span: given.span, related: vec![other] });
                continue;
            }
            let Some(size) = self.amount(given, Quantity::Length, src, out) else { continue };
            if size.literal().is_some_and(|num| num.mantissa <= 0) {
                self.fault(Fault::OutOfRange { word: src.text(given.span).into() }, given.span, out);
                continue;
            }
            self.push(given.span, Op::Corner { shape, size }, out);
        }
        let Some(num) = self.rounding.filter(|_| first.is_none()) else { return };
        let Some(plane) = self.known_plane(block, out) else { return };
        let in_plane = |axis: Axis| plane.axes().0 == axis || plane.axes().1 == axis;
        let polar = [NameRole::PolarRadius, NameRole::PolarAngle, NameRole::LineAngle];
        let goes = polar.into_iter().any(|role| words.named(role).is_some())
            || Axis::ALL.into_iter().any(|axis| in_plane(axis) && words.get(axis.letter()).is_some());
        let leaves = Axis::ALL.into_iter().any(|axis| !in_plane(axis) && words.get(axis.letter()).is_some());
        if goes && !leaves {
            let shape = CornerShape::Round;
            self.push(block, Op::Corner { shape, size: Expr::Num(num) }, out);
        }
    }

    /// Refuses changes of control flow while every corner is rounded.
    pub(in crate::siemens) fn check_rounding(&mut self, op: &Op, span: Span, out: &mut Batch) {
        let leads = matches!(
            op,
            Op::Call(_) | Op::Return | Op::RepeatBlocks(_) | Op::Control(_) | Op::Goto(_) | Op::Label(_)
        );
        if leads && self.rounding.is_some() {
            let what = MoveUnsupported::RoundingFlow;
            self.not_supported("RNDM", what, span, out);
        }
    }
}
