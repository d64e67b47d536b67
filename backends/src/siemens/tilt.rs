//! Tilted working planes: one call says the plane, and whether and which way the tool is swivelled to it.
//!
//! What retracts to the machine's zero in its block is stated by the call, where it turns the tool. No record of
//! the machine's kinematics is named: the only one, or the first, counts. Where the program does not say the way, the one towards minus is written.

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

/// A plane, and how the tool is swivelled to it in the same block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Swivel<'s> {
    /// The end of the plane before it, which a plane set again brings by itself.
    ends: usize,
    /// Moves to the machine's zero before it: along Z, and then X and Y.
    retracts: usize,
    tilt: &'s Tilt,
    /// `None` is not at all.
    turned: Option<Option<Toward>>,
}

impl Swivel<'_> {
    /// How many statements it is.
    pub(super) fn said(self) -> usize {
        self.ends + self.retracts + 1 + usize::from(self.turned.is_some())
    }
}

/// The plane that the statements begin with.
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
    /// `CYCLE800(0,"",0,57,x,y,z,a,b,c,0,0,0,-1)`
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

/// The number of an order of turns: two bits each, the first turn lowest, X 1, Y 2, Z 3.
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
