//! Emits tilted planes as `CYCLE800`, with the swivel of the tool in the same call.
//!
//! ```text
//! tilted plane B30, swivel to minus    →    CYCLE800(0,"",0,57,0,0,0,0,30,0,0,0,0,-1)
//! ```
//!
//! A retract to machine zero in the same block becomes the first argument if the call swivels the tool. The name of
//! the swivel data record is empty: the only or first record is active. Without a stated direction ncc writes minus.

use ncc_dialects::{Meaning, NameMeaning, Quantity};
use ncc_ir::canon::Axis;
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::lack::FramesLack;
use ncc_ir::program::{FrameSlot, Op, Slot, Stmt, Tilt, Toward};
use ncc_ir::source::Span;
use ncc_passes::retract;

use super::{Sink, Writer};
use crate::common::fault::cannot;

/// A tilted plane with the swivel of the tool in the same block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Swivel<'s> {
    /// 1 if the statements first end the old plane, else 0. A new plane replaces the old one.
    ends: usize,
    /// Number of retracts to machine zero before the plane: 1 is Z, 2 is Z and then X and Y.
    retracts: usize,
    tilt: &'s Tilt,
    /// Swivel direction. The outer `None` is no swivel, the inner one no stated direction.
    turned: Option<Option<Toward>>,
}

impl Swivel<'_> {
    /// Number of statements that the call replaces.
    pub(super) fn said(self) -> usize {
        self.ends + self.retracts + 1 + usize::from(self.turned.is_some())
    }
}

/// The tilted plane at the start of the statements; `None` if they do not fit one call.
pub(super) fn first_swivel(rest: &[Stmt]) -> Option<Swivel<'_>> {
    let ends = usize::from(matches!(rest.first()?.op, Op::ClearFrame(FrameSlot::Tilt)));
    let retracts = rest.get(ends..).and_then(retract).unwrap_or(0);
    let parts = rest.get(..=ends + retracts)?;
    if parts.iter().skip(1).any(|part| !part.joined || part.skip != parts[0].skip) {
        return None;
    }
    let (first, behind) = rest.get(ends + retracts..)?.split_first()?;
    let Op::SetSlot(slot) = &first.op else { return None };
    let Slot::Tilt(tilt) = &**slot else { return None };
    let turned = behind.first().filter(|next| next.joined && next.skip == first.skip).and_then(|next| {
        let Op::OrientToolAxis(toward) = next.op else { return None };
        Some(toward)
    });
    if retracts > 0 && turned.is_none() {
        return None;
    }
    Some(Swivel { ends, retracts, tilt, turned })
}

impl Writer {
    /// Emits `CYCLE800(0,"",0,57,x,y,z,a,b,c,0,0,0,-1)`.
    ///
    /// # Errors
    /// The dialect has no tilted plane, or `CYCLE800` has no such order of axes.
    pub(super) fn tilt(&mut self, swivel: Swivel, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let Swivel { retracts, tilt, turned, .. } = swivel;
        if self.words.preamble.is_some() {
            self.words.start(sink);
        }
        let row = self.dialect.name_for(NameMeaning::Code(Meaning::SetTilt));
        let row = row.ok_or_else(|| cannot(FramesLack::TiltedPlane))?;
        let mode = mode_of(tilt.about).ok_or_else(|| cannot(FramesLack::TiltAxes))?;
        let zero = Expr::Num(Num::int(0, Unit::Mm));
        let length = self.letter("X", Quantity::Length);
        let angle = self.letter("A", Quantity::Angle);
        let mut words = Vec::new();
        for word in &tilt.origin {
            words.push(self.value(&length, word.as_ref().unwrap_or(&zero), span, sink)?);
        }
        for word in &tilt.angles {
            words.push(self.value(&angle, word, span, sink)?);
        }
        if retracts > 0 {
            self.words.rely("swivel_retract", span, sink);
        }
        let direction = match turned {
            None => 0,
            Some(Some(Toward::Plus)) => 1,
            Some(None | Some(Toward::Minus)) => -1,
        };
        self.alone(
            &format!("{}({retracts},\"\",0,{mode},{},0,0,0,{direction})", row.name, words.join(",")),
            sink,
        )
    }
}

/// Swivel mode of three rotations: two bits each, the first one lowest; X is 1, Y 2, Z 3. X, Y, Z gives 57.
fn mode_of(about: [Axis; 3]) -> Option<u8> {
    let [a, b, c] = about.map(|axis| match axis {
        Axis::X => Some(1),
        Axis::Y => Some(2),
        Axis::Z => Some(3),
        Axis::A | Axis::B | Axis::C => None,
    });
    let (a, b, c) = (a?, b?, c?);
    (a != b && b != c && a != c).then_some(a | b << 2 | c << 4)
}
