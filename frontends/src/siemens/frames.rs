//! Lowering of programmed frames: `TRANS`, `ROT`, `SCALE`, `MIRROR` and the forms that append.
//!
//! Refused: rotations about an axis of the active plane, and an appending word without
//! axes.

use ncc_dialects::{FrameWord, NameMeaning, NameRole, Quantity};
use ncc_ir::canon::{AXES, Axis, Fact};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::program::{Frame, FrameSlot, FrameStep, Op};
use ncc_ir::unsupported::FrameUnsupported;

use super::block_words::{Code, Given, Words};
use super::lower::Lower;
use crate::batch::Batch;
use crate::common::Source;

impl Lower {
    /// A frame, which stands alone in its block.
    pub(super) fn frame(&mut self, code: Code, words: &mut Words, src: Source, out: &mut Batch) {
        let (added, word) = match code.meaning {
            NameMeaning::SetFrame(word) => (false, word),
            NameMeaning::AddFrame(word) => (true, word),
            _ => return,
        };
        if words.codes.len() > 1 {
            return self.not_supported(code.name, FrameUnsupported::BesideFunctions, code.span, out);
        }
        self.stand.forget();
        if words.no_address() {
            if added {
                return self.not_supported(code.name, FrameUnsupported::AppendedNothing, code.span, out);
            }
            self.frame_changes(false, [false; AXES]);
            return self.push(code.span, Op::ClearFrame(FrameSlot::Chain), out);
        }
        let step = match word {
            FrameWord::Translate => self.translation(words, src, out),
            FrameWord::Rotate => self.rotation(code, words, src, out),
            FrameWord::Scale => self.factors(words, src, out),
            FrameWord::Mirror => {
                let axes = [b'X', b'Y', b'Z'].map(|letter| words.take(letter).is_some());
                axes.contains(&true).then_some(FrameStep::Mirror(axes))
            }
        };
        if let Some(step) = step
            && !self.now.failed
        {
            self.frame_changes(added, axes_of(&step));
            self.push(code.span, Op::SetFrame(Box::new(Frame { added, step })), out);
        }
    }

    /// The chain of frames is another one for these axes, and where it is not added to, for those that it had before.
    fn frame_changes(&mut self, added: bool, axes: [bool; AXES]) {
        for (axis, within) in axes.into_iter().enumerate() {
            let before = &mut self.state.in_frame[axis];
            *before = within || *before && added;
        }
    }

    fn translation(&mut self, words: &mut Words, src: Source, out: &mut Batch) -> Option<FrameStep> {
        let mut by = [const { None }; AXES];
        for axis in Axis::ALL {
            if let Some(given) = self.unmarked(words.take(axis.letter()), src, out) {
                let quantity = if axis.is_rotary() { Quantity::Angle } else { Quantity::Length };
                by[axis as usize] = self.amount(given, quantity, src, out);
            }
        }
        by.iter().any(Option::is_some).then(|| FrameStep::Translate(Box::new(by)))
    }

    fn rotation(&mut self, code: Code, words: &mut Words, src: Source, out: &mut Batch) -> Option<FrameStep> {
        if let Some(given) = words.take_named(NameRole::PlaneAngle) {
            let plane = self.plane(code.span, out);
            let angle = self.amount(given, Quantity::Angle, src, out)?;
            return Some(FrameStep::Rotate { plane, angle });
        }
        let plane = self.known_plane(code.span, out)?;
        let normal = plane.axes().2;
        let mut angle = None;
        for axis in [Axis::X, Axis::Y, Axis::Z] {
            let Some(given) = self.unmarked(words.take(axis.letter()), src, out) else {
                continue;
            };
            let value = self.amount(given, Quantity::Angle, src, out)?;
            if axis == normal {
                angle = Some(value);
            } else if !value.literal().is_some_and(ncc_ir::expr::num::Num::is_zero) {
                let what = FrameUnsupported::RotationAboutPlaneAxis;
                self.not_supported(code.name, what, given.span, out);
            }
        }
        let zero = ncc_ir::expr::num::Num::int(0, ncc_ir::expr::num::Unit::Degree);
        Some(FrameStep::Rotate { plane: Fact::Known(plane), angle: angle.unwrap_or(Expr::Num(zero)) })
    }

    fn factors(&mut self, words: &mut Words, src: Source, out: &mut Batch) -> Option<FrameStep> {
        let mut by = [const { None }; 3];
        for (by, letter) in by.iter_mut().zip(*b"XYZ") {
            let Some(given) = self.unmarked(words.take(letter), src, out) else {
                continue;
            };
            let factor = self.amount(given, Quantity::Factor, src, out)?;
            if factor.literal().is_some_and(ncc_ir::expr::num::Num::is_zero) {
                return self.refuse(Fault::OutOfRange { word: src.text(given.span).into() }, given.span, out);
            }
            *by = Some(factor);
        }
        by.iter().any(Option::is_some).then(|| FrameStep::Scale(Box::new(by)))
    }

    /// A word of a frame, which is neither absolute nor incremental.
    fn unmarked(&mut self, given: Option<Given>, src: Source, out: &mut Batch) -> Option<Given> {
        let given = given?;
        if given.distance.is_some() {
            let what = FrameUnsupported::FrameDistance;
            self.not_supported(&src.text(given.span), what, given.span, out);
            return None;
        }
        Some(given)
    }
}

/// Axes whose coordinates a frame changes. A rotation changes two, of a plane that may not be known.
fn axes_of(step: &FrameStep) -> [bool; AXES] {
    let mut axes = [false; AXES];
    match step {
        FrameStep::Translate(by) => axes.iter_mut().zip(&**by).for_each(|(axis, by)| *axis = by.is_some()),
        FrameStep::Scale(by) => axes.iter_mut().zip(&**by).for_each(|(axis, by)| *axis = by.is_some()),
        FrameStep::Rotate { plane: Fact::Known(plane), .. } => {
            let (first, second, _) = plane.axes();
            (axes[first as usize], axes[second as usize]) = (true, true);
        }
        FrameStep::Rotate { .. } => axes[..3].fill(true),
        FrameStep::Mirror(mirrored) => axes[..3].copy_from_slice(mirrored),
    }
    axes
}
