//! Lowering of what fills a slot of the coordinate chain: shifts, coordinates of the present point,
//! rotation, factors and mirror.
//!
//! Refused: their words under incremental coordinates, a first move in a new rotation that does
//! not name both axes of its plane absolutely (which controls do not take alike), and another zero while
//! a rotation, factors or a mirror are active where the dictionary says that a control forbids it.

use ncc_dialects::{Meaning, Quantity};
use ncc_ir::canon::{AXES, Axis, Distance, Fact, Plane};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::program::{Coord, FrameSlot, Op, Point, Slot};
use ncc_ir::source::Span;
use ncc_ir::unsupported::FrameUnsupported;

use super::block_words::{Code, Words, motion_of};
use super::lower::Lower;
use super::word_state::{CycleState, KeptShift};
use crate::batch::Batch;
use crate::common::Source;
use crate::common::words::Value;

const ROTATION: u8 = 1;
const SCALE: u8 = 2;
/// From here on, an axis each.
const MIRROR: u8 = 4;

/// Whether a code fills a slot with the words of its block.
pub(super) fn is_frame(meaning: Meaning) -> bool {
    matches!(
        meaning,
        Meaning::SetShift(_)
            | Meaning::SetPosition
            | Meaning::SetRotation
            | Meaning::SetScale
            | Meaning::SetMirror
            | Meaning::SetTilt
            | Meaning::ClearMirror
    )
}

/// The bit of an axis.
fn bit(axis: Axis) -> u8 {
    1 << axis as u8
}

impl Lower {
    /// A code that fills a slot.
    pub(super) fn frame(
        &mut self,
        code: &Code,
        functions: &[Code],
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        if !self.stands_beside(code, functions, true, src, out) {
            return;
        }
        if matches!(code.meaning, Meaning::SetShift(_) | Meaning::SetPosition) {
            self.check_shut(code, out);
        }
        let by_mode = !matches!(code.meaning, Meaning::SetScale | Meaning::ClearMirror);
        // Zeros take the shift back, however other words count.
        let takes_back = code.meaning == Meaning::SetShift(false)
            && Axis::ALL
                .into_iter()
                .filter_map(|axis| words.get(axis.letter()))
                .all(|word| matches!(word.value, Value::Number(digits) if digits.mantissa == 0));
        if by_mode && !takes_back && self.state.modes.distance.value() == Some(Distance::Incremental) {
            return self.no_frame(code, in_increments(code.meaning), out);
        }
        if matches!(self.state.cycle, CycleState::Active(_)) {
            return self.no_frame(code, FrameUnsupported::InCycle, out);
        }
        let op = match code.meaning {
            Meaning::SetShift(origin) => {
                if origin {
                    self.state.shift_kept = self.state.shift_kept.stated();
                }
                let axes = self.frame_axes(code, words, src, out);
                axes.map(|axes| Op::SetSlot(Box::new(Slot::Shift { origin, axes: Box::new(axes) })))
            }
            Meaning::SetPosition => {
                if words.get(b'Z').is_some() && self.level_open() {
                    self.refuse_level(code.span, out);
                }
                self.state.shift_kept = KeptShift::Active;
                let axes = self.frame_axes(code, words, src, out);
                axes.map(|axes| Op::SetPosition(Box::new(axes)))
            }
            Meaning::SetRotation => self.rotation(code, words, src, out),
            Meaning::SetScale => self.scale(code, words, src, out),
            Meaning::SetMirror => self.mirror(code, words, src, out),
            Meaning::SetTilt => self.tilt(code, words, src, out),
            Meaning::ClearMirror => self.clear_mirror(code, words, src, out),
            _ => None,
        };
        if let (Some(op), false) = (op, self.now.failed) {
            self.push(code.span, op, out);
        }
    }

    /// Whether nothing else in the block takes the words of a code: M codes may stand beside it, and a motion
    /// where that is stated. The first other one is refused.
    pub(super) fn stands_beside(
        &mut self,
        code: &Code,
        functions: &[Code],
        motion: bool,
        src: Source,
        out: &mut Batch,
    ) -> bool {
        let may_stand = |c: &Code| match motion_of(c.meaning) {
            Some(_) => motion,
            None => c.span.start == code.span.start || c.row.code.starts_with('M'),
        };
        let Some(other) = functions.iter().find(|c| !may_stand(c)) else { return true };
        let fault = Fault::CodesExclude { first: src.text(code.span), second: src.text(other.span) };
        self.fault(fault, other.span, out);
        false
    }

    fn no_frame(&mut self, code: &Code, what: FrameUnsupported, out: &mut Batch) {
        self.fault(Fault::not_supported(code.row.code.as_str(), what), code.span, out);
    }

    /// Whether factors are active, or a mirror of the drilling axis.
    pub(super) fn drills_scaled(&self) -> bool {
        let normal = self.state.modes.plane.value().unwrap_or(Plane::Xy).axes().2;
        self.state.turned & (SCALE | MIRROR << normal as u8) != 0
    }

    /// Refuses another zero in a frame that turns, scales or mirrors.
    pub(super) fn check_shut(&mut self, code: &Code, out: &mut Batch) {
        if self.state.turned != 0 && self.settings.dialect.can.frames_shut {
            let what = FrameUnsupported::ZeroUnderFrame.into();
            self.fault(Fault::NotSupported { code: code.row.code.as_str().into(), what }, code.span, out);
        }
    }

    /// A slot is empty from here on.
    pub(super) fn frame_over(&mut self, slot: FrameSlot) {
        match slot {
            FrameSlot::Rotation => {
                if self.state.turned & ROTATION != 0 {
                    // The plane may be another by now: whichever two axes it has.
                    self.state.unplaced = self.plane_axes(self.state.modes.plane.fact());
                }
                self.state.turned &= !ROTATION;
            }
            FrameSlot::Scale => self.state.turned &= !SCALE,
            FrameSlot::Mirror => self.state.turned &= ROTATION | SCALE,
            FrameSlot::Shift | FrameSlot::Local | FrameSlot::Polar | FrameSlot::Tilt | FrameSlot::Chain => {}
        }
    }

    fn plane_axes(&self, plane: Fact<Plane>) -> u8 {
        let (first, second, _) = plane.or(Plane::Xy).axes();
        bit(first) | bit(second)
    }

    /// The first move in a new rotation, or after it, names the axes of its plane absolutely.
    pub(super) fn place_first(&mut self, to: &Point, block: Span, out: &mut Batch) {
        let wanted = self.state.unplaced;
        let named = |axis: &Axis| wanted & bit(*axis) != 0 && to.get(*axis).is_some();
        if !Axis::ALL.iter().any(named) {
            return;
        }
        let absolute = |axis: &Axis| {
            wanted & bit(*axis) == 0
                || to.get(*axis).is_some_and(|word| word.distance != Fact::Known(Distance::Incremental))
        };
        if !Axis::ALL.iter().all(absolute) {
            let what = FrameUnsupported::FirstMove.into();
            let code = self.rotation_code();
            self.fault(Fault::NotSupported { code, what }, block, out);
        }
        self.state.unplaced = 0;
    }

    fn rotation_code(&self) -> ncc_ir::program::Text {
        let row = self.settings.dialect.code_for(Meaning::SetRotation);
        row.map_or("", |row| row.code.as_str()).into()
    }

    /// The block's axis words, of which there must be one.
    fn frame_axes(
        &mut self,
        code: &Code,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) -> Option<[Option<Expr>; AXES]> {
        let mut axes = [const { None }; AXES];
        for axis in Axis::ALL {
            let Some(row) = self.axis_row(axis) else { continue };
            if let Some(word) = words.take(axis.letter()) {
                axes[axis as usize] = self.amount(&word, row.quantity, words, src, out);
            }
        }
        if axes.iter().all(Option::is_none) && !self.now.failed {
            return self.refuse(
                Fault::WordMissing { code: code.row.code.as_str().into(), word: "X".into() },
                code.span,
                out,
            );
        }
        Some(axes)
    }

    /// The block's words along X, Y and Z.
    pub(super) fn linear(&mut self, words: &mut Words, src: Source, out: &mut Batch) -> [Option<Expr>; 3] {
        [b'X', b'Y', b'Z'].map(|letter| {
            let word = words.take(letter)?;
            self.amount(&word, Quantity::Length, words, src, out)
        })
    }

    fn rotation(&mut self, code: &Code, words: &mut Words, src: Source, out: &mut Batch) -> Option<Op> {
        let plane = self.plane(code.span, out);
        let mut centre = [None, None, None];
        for axis in [Axis::X, Axis::Y, Axis::Z] {
            // A word along the normal is left, and blamed as one that nothing uses.
            if plane.known().is_none_or(|plane| plane.axes().2 != axis)
                && let Some(word) = words.take(axis.letter())
            {
                centre[axis as usize] = self.amount(&word, Quantity::Length, words, src, out);
            }
        }
        let letter = code.row.words.bytes().next().unwrap_or(b'R');
        let Some(word) = words.take(letter) else {
            let word = char::from(letter).to_string().into();
            let fault = Fault::WordMissing { code: code.row.code.as_str().into(), word };
            return self.refuse(fault, code.span, out);
        };
        let value = self.amount(&word, Quantity::Angle, words, src, out)?;
        self.state.turned |= ROTATION;
        self.state.unplaced = self.plane_axes(plane);
        let angle = Coord { value, distance: Fact::Known(Distance::Absolute) };
        Some(Op::SetSlot(Box::new(Slot::Rotation { plane, centre: Box::new(centre), angle })))
    }

    fn scale(&mut self, code: &Code, words: &mut Words, src: Source, out: &mut Batch) -> Option<Op> {
        let centre = self.linear(words, src, out);
        let mut letters = code.row.words.bytes();
        let all = letters.next().and_then(|letter| words.take(letter));
        let each = [letters.next(), letters.next(), letters.next()]
            .map(|letter| letter.and_then(|letter| words.take(letter)));
        let missing =
            |word: &str| Fault::WordMissing { code: code.row.code.as_str().into(), word: word.into() };
        let mut factor = |word| {
            let num = self.number(&word, Quantity::Factor, src, out)?;
            match num.mantissa > 0 {
                true => Some(Expr::Num(num)),
                false => self.refuse(Fault::OutOfRange { word: src.text(word.span).into() }, word.span, out),
            }
        };
        let factors = match (all, each) {
            (Some(all), [None, None, None]) => {
                let value = factor(all)?;
                // Whether an axis that is left out is scaled is the machine's own.
                if let Some(left_out) = centre.iter().position(Option::is_none) {
                    let letter = char::from(b"XYZ"[left_out]).to_string();
                    return self.refuse(missing(&letter), code.span, out);
                }
                [Some(value.clone()), Some(value.clone()), Some(value)]
            }
            (None, [Some(x), Some(y), Some(z)]) => [Some(factor(x)?), Some(factor(y)?), Some(factor(z)?)],
            (None, [None, None, None]) => return self.refuse(missing("P"), code.span, out),
            _ => return self.refuse(missing("I, J and K"), code.span, out),
        };
        self.state.turned |= SCALE;
        Some(Op::SetSlot(Box::new(Slot::Scale { centre: Box::new(centre), factors: Box::new(factors) })))
    }

    /// Mirrors are set and taken back outside rotations and factors.
    fn mirror_in_turn(&mut self, code: &Code, out: &mut Batch) -> Option<()> {
        if self.state.turned & (ROTATION | SCALE) != 0 && self.settings.dialect.can.frames_shut {
            self.no_frame(code, FrameUnsupported::MirrorUnderFrame, out);
            return None;
        }
        Some(())
    }

    fn mirror(&mut self, code: &Code, words: &mut Words, src: Source, out: &mut Batch) -> Option<Op> {
        self.mirror_in_turn(code, out)?;
        let lines = self.linear(words, src, out);
        if lines.iter().all(Option::is_none) {
            let fault = Fault::WordMissing { code: code.row.code.as_str().into(), word: "X".into() };
            return self.refuse(fault, code.span, out);
        }
        for (i, line) in lines.iter().enumerate() {
            self.state.turned |= if line.is_some() { MIRROR << i } else { 0 };
        }
        Some(Op::SetSlot(Box::new(Slot::Mirror(Box::new(lines)))))
    }

    fn clear_mirror(&mut self, code: &Code, words: &mut Words, src: Source, out: &mut Batch) -> Option<Op> {
        self.mirror_in_turn(code, out)?;
        let axes = self.linear(words, src, out).map(|line| line.is_some());
        if !axes.contains(&true) {
            let fault = Fault::WordMissing { code: code.row.code.as_str().into(), word: "X".into() };
            return self.refuse(fault, code.span, out);
        }
        for (i, over) in axes.into_iter().enumerate() {
            self.state.turned &= if over { !(MIRROR << i) } else { u8::MAX };
        }
        Some(Op::SetSlot(Box::new(Slot::NoMirror(axes))))
    }
}

/// Why a frame is refused under G91.
fn in_increments(meaning: Meaning) -> FrameUnsupported {
    match meaning {
        Meaning::SetShift(_) => FrameUnsupported::ShiftInIncrements,
        Meaning::SetPosition => FrameUnsupported::PositionInIncrements,
        Meaning::SetRotation => FrameUnsupported::RotationInIncrements,
        Meaning::SetScale => FrameUnsupported::ScaleInIncrements,
        Meaning::SetTilt => FrameUnsupported::TiltInIncrements,
        _ => FrameUnsupported::MirrorInIncrements,
    }
}
