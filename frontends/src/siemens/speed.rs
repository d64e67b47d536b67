//! What a speed counts, its limit, and oriented spindle stop.
//!
//! One modal group says what a feed and what a speed counts, so that a code of the feed ends a surface speed.

use ncc_dialects::{Meaning, NameRole, Quantity};
use ncc_ir::canon::SpindleMode;
use ncc_ir::diag::Fault;
use ncc_ir::program::Op;
use ncc_ir::unsupported::SpindleUnsupported;

use super::block_words::{Code, Words};
use super::lower::Lower;
use crate::batch::Batch;
use crate::common::Source;
use crate::common::known::Know;

/// The option that says whose coordinate is the radius of a surface speed.
const AXIS: &str = "surface_axis";

impl Lower {
    /// Before a code that says what a speed counts, or may end a surface speed. Gives whether it ends one, as
    /// far as that can be known.
    pub(super) fn before_spindle_mode(
        &mut self,
        code: &Code,
        meaning: Meaning,
        has_speed: bool,
        out: &mut Batch,
    ) -> bool {
        let surface = self.state.surface;
        match meaning {
            Meaning::SetSpindleMode(SpindleMode::Surface) => {
                if self.surfaces.doubted {
                    let what = SpindleUnsupported::SurfaceAfterCall;
                    self.not_supported(code.name, what, code.span, out);
                }
                self.surfaces.met = true;
                if self.option(AXIS, code.span, out) != "X" {
                    let what = SpindleUnsupported::SurfaceOtherAxis;
                    self.not_supported(code.name, what, code.span, out);
                }
                if !has_speed && surface != Know::Said(true) {
                    let fault = Fault::WordMissing { code: code.name.into(), word: "S".into() };
                    self.fault(fault, code.span, out);
                }
                false
            }
            Meaning::SetFeedMode(_) => {
                self.surfaces.doubted |= surface == Know::Lost && !self.surfaces.met;
                self.surfaces.met && surface != Know::Said(false)
            }
            _ => false,
        }
    }

    /// The highest speed of the spindle, which counts from this block on.
    pub(super) fn speed_limit(&mut self, words: &mut Words, src: Source, out: &mut Batch) {
        if let Some(given) = words.take_named(NameRole::SpindleLimit)
            && let Some(limit) = self.amount(given, Quantity::Speed, src, out)
        {
            self.push(given.span, Op::LimitSpindleSpeed(limit), out);
        }
    }

    /// Oriented spindle stop.
    pub(super) fn spindle_angle(&mut self, words: &mut Words, src: Source, out: &mut Batch) {
        let Some(given) = words.take_named(NameRole::SpindleAngle) else { return };
        if words.has_point() {
            let what = SpindleUnsupported::StopWithAxes;
            self.not_supported(&src.text(given.span), what, given.span, out);
        } else if let Some(angle) = self.amount(given, Quantity::Angle, src, out) {
            self.push(given.span, Op::OrientSpindle(Some(angle)), out);
        }
    }
}
