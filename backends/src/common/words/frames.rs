//! What fills a slot of the coordinate chain: a code with axis words, in a block of its own.

use ncc_ir::canon::{Axis, Distance, Fact};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Num;
use ncc_ir::lack::{FramesLack, WordsLack};
use ncc_ir::program::{Coord, FrameSlot, Slot};
use ncc_ir::source::Span;

use super::Words;
use crate::common::Sink;
use crate::common::block::{Need, Part, Rank};
use crate::common::codes::{Code, Letter};
use crate::common::fault::cannot;
use crate::common::setting::Inserted;

impl Words {
    /// Fills a slot.
    pub(crate) fn slot(&mut self, slot: &Slot, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let frames = self.codes.frames;
        match slot {
            Slot::Shift { origin, axes } => {
                let code = if *origin { frames.origin } else { frames.local };
                let code = code.ok_or_else(|| cannot(FramesLack::Shift))?;
                self.filled(code, &self.along(&axes[..])?, &[], Inserted::default(), span, sink)
            }
            Slot::Rotation { plane, centre, angle } => {
                let (code, letter) = frames.rotation.ok_or_else(|| cannot(FramesLack::Rotation))?;
                if angle.distance == Fact::Known(Distance::Incremental) {
                    return Err(cannot(FramesLack::RotationByIncrement));
                }
                let mut inserted = Inserted::default();
                self.need_plane(*plane, &mut inserted)?;
                let axes = self.along(&centre[..])?;
                self.filled(code, &axes, &[(letter, angle.value.clone())], inserted, span, sink)
            }
            Slot::Scale { centre, factors } => {
                let (code, all, each) = frames.scale.ok_or_else(|| cannot(FramesLack::Scale))?;
                let one = Expr::int(1);
                let factors = [0, 1, 2].map(|i| factors[i].clone().unwrap_or_else(|| one.clone()));
                let same = factors.iter().all(|f| *f == factors[0]) && centre.iter().all(Option::is_some);
                let own: Vec<_> = match same {
                    true => vec![(all, factors[0].clone())],
                    false => each.into_iter().zip(factors).collect(),
                };
                let axes = self.along(&centre[..])?;
                self.filled(code, &axes, &own, Inserted::default(), span, sink)
            }
            Slot::Mirror(lines) => {
                let code = frames.mirror.ok_or_else(|| cannot(FramesLack::Mirror))?;
                self.filled(code, &self.along(&lines[..])?, &[], Inserted::default(), span, sink)
            }
            Slot::Tilt(tilt) => {
                let (code, letters, about) = frames.tilt.ok_or_else(|| cannot(FramesLack::TiltedPlane))?;
                if tilt.about != about {
                    return Err(cannot(FramesLack::TiltAxes));
                }
                // All of its words are written.
                let zero = Expr::Num(Num::int(0, ncc_ir::expr::num::Unit::Mm));
                let origin =
                    [0, 1, 2].map(|axis| Some(tilt.origin[axis].clone().unwrap_or_else(|| zero.clone())));
                let own: Vec<_> = letters.into_iter().zip(tilt.angles.iter().cloned()).collect();
                self.filled(code, &self.along(&origin)?, &own, Inserted::default(), span, sink)
            }
            Slot::NoMirror(axes) => self.zeros(frames.no_mirror, *axes, FramesLack::Mirror, span, sink),
        }
    }

    /// Gives the present point coordinates.
    pub(crate) fn present_point(
        &mut self,
        axes: &[Option<Expr>],
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let code = self.codes.frames.position.ok_or_else(|| cannot(FramesLack::PresentPoint))?;
        self.filled(code, &self.along(axes)?, &[], Inserted::default(), span, sink)
    }

    /// Suspends the G92 shift, or restores it.
    pub(crate) fn origin_shift(&mut self, on: bool, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let lack = if on { FramesLack::ShiftResumed } else { FramesLack::ShiftSuspended };
        let code = self.codes.origin_shift[usize::from(on)].ok_or_else(|| cannot(lack))?;
        self.filled(code, &[], &[], Inserted::default(), span, sink)
    }

    /// Turns the tool upright on a tilted plane.
    pub(crate) fn upright(&mut self, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let code = self.codes.frames.upright;
        let code = code.ok_or_else(|| cannot(FramesLack::AxisOntoTilt))?;
        self.filled(code, &[], &[], Inserted::default(), span, sink)
    }

    /// Empties a slot.
    pub(crate) fn clear_slot(&mut self, slot: FrameSlot, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let frames = self.codes.frames;
        let code = match slot {
            FrameSlot::Local => {
                return self.zeros(frames.local, [true; 3], FramesLack::LocalShift, span, sink);
            }
            FrameSlot::Mirror => {
                return self.zeros(frames.no_mirror, [true; 3], FramesLack::Mirror, span, sink);
            }
            FrameSlot::Rotation => frames.no_rotation,
            FrameSlot::Scale => frames.no_scale,
            FrameSlot::Tilt if frames.tilt.is_some() => frames.no_rotation,
            FrameSlot::Shift | FrameSlot::Polar | FrameSlot::Tilt | FrameSlot::Chain => None,
        };
        let code = code.ok_or_else(|| cannot(FramesLack::Clear))?;
        self.filled(code, &[], &[], Inserted::default(), span, sink)
    }

    fn zeros(
        &mut self,
        code: Option<Code>,
        axes: [bool; 3],
        lack: FramesLack,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let code = code.ok_or_else(|| cannot(lack))?;
        let zero = Expr::Num(Num::int(0, ncc_ir::expr::num::Unit::Mm));
        let words = axes.map(|named| named.then(|| zero.clone()));
        self.filled(code, &self.along(&words)?, &[], Inserted::default(), span, sink)
    }

    /// The words of axes, with their letters.
    pub(crate) fn along(&self, words: &[Option<Expr>]) -> Result<Vec<(Letter, Expr)>, Fault> {
        let mut out = Vec::new();
        for (axis, word) in Axis::ALL.into_iter().zip(words) {
            if let Some(word) = word {
                let letter = self.codes.axes[axis as usize];
                out.push((letter.ok_or_else(|| cannot(WordsLack::Axis))?, word.clone()));
            }
        }
        Ok(out)
    }

    /// A code in a block of its own; its axis words are absolute.
    fn filled(
        &mut self,
        code: Code,
        axes: &[(Letter, Expr)],
        own: &[(Letter, Expr)],
        mut inserted: Inserted,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let coords: Vec<Coord> = axes
            .iter()
            .chain(own)
            .map(|(_, value)| Coord { value: value.clone(), distance: Fact::Known(Distance::Absolute) })
            .collect();
        self.need_distance(coords.iter(), &mut inserted)?;
        if !self.block.is_empty() {
            self.flush(false, sink);
            self.split = true;
        }
        let mut shaped = Vec::new();
        for (letter, value) in axes.iter().chain(own) {
            shaped.push((letter.letter, self.value(letter, value, span, sink)?));
        }
        let mut need = Need::new(Rank::Alone).code(Some(code));
        for (letter, _) in &shaped {
            need = need.letter(*letter);
        }
        self.modes_before(inserted, sink)?;
        self.admit(&need, sink)?;
        self.block.code(Part::Mode, &code);
        for (letter, value) in shaped {
            self.block.word(Part::Axes, letter, value);
        }
        Ok(())
    }
}
