//! What a speed of the spindle counts, and its limit: what needs to be so before anything happens.
//!
//! Not here: turning and stopping it (`motion_modes`), and what goes synchronised with it (`thread`).

use crate::{Attribute, Event, Exec, Kind};
use ncc_ir::canon::{Spindle, SpindleMode, Units};
use ncc_ir::diag::Diagnostic;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::source::Span;
use ncc_ir::unexecuted::MoveUnexecuted;

/// Metres in ten thousand feet: a foot is 0.3048 m.
const METRES: i128 = 3048;

impl Exec {
    /// Sets the speed: turns a minute, or the surface speed in m/min, which inches say in ft/min.
    pub(crate) fn set_speed(
        &mut self,
        speed: &Expr,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        let said = self.value(speed, span)?;
        let surface = self.state.spindle_mode == SpindleMode::Surface;
        self.state.speed = match surface && self.modes.inch {
            true => Nanos::try_from((i128::from(said) * METRES + 5000) / 10_000).unwrap_or(Nanos::MAX),
            false => said,
        };
        self.speed_said();
        self.speed_watched = surface;
        if surface {
            self.state.centre = self.frame[0];
        }
        self.within_limit(span)?;
        let turns = self.state.turns(self.last[0]);
        self.tell(Attribute::SpindleSpeed(turns), span, out)
    }

    /// Other units leave a surface speed open: what the number said before counts now, no source tells.
    pub(crate) fn units_of_speed(&mut self, units: Units) {
        let other = self.modes.inch != (units == Units::Inch);
        if other && self.state.spindle_mode == SpindleMode::Surface {
            self.state.speed = 0;
            self.speed_watched = true;
        }
    }

    /// Under a speed in rev/min, a limit below it counts on some controls alone.
    pub(crate) fn within_limit(&self, span: Span) -> Result<(), Diagnostic> {
        let state = &self.state;
        let limited = state.limit != u32::MAX && state.spindle != Spindle::Stopped;
        let above = || state.speed > Nanos::from(state.limit) * (ONE / 1000);
        if limited && state.spindle_mode == SpindleMode::Turns && above() {
            return self.not_executed(MoveUnexecuted::SpeedAboveLimit, span);
        }
        Ok(())
    }

    /// Looks at the speed before something happens: there is one, and program zero is where the radius of a
    /// surface speed is measured from.
    ///
    /// # Errors
    /// No speed since what it counts has changed, or its unit; a surface speed in a frame of the program, or with the tool centre path
    /// computed: which X is the radius then, controls may not agree about.
    #[cold]
    pub(crate) fn watch_speed(&mut self, kind: &Kind, span: Span) -> Result<(), Diagnostic> {
        if self.state.spindle == Spindle::Stopped || matches!(kind, Kind::Attribute(_)) {
            return Ok(());
        }
        if self.state.speed <= 0 {
            return self.not_executed(MoveUnexecuted::NoSpeedOfMode, span);
        }
        if self.state.spindle_mode == SpindleMode::Surface {
            let framed = self.chain.is_some() || self.slots.is_some();
            if framed || self.state.tip || self.state.tilted {
                return self.not_executed(MoveUnexecuted::SurfaceInFrame, span);
            }
            if self.must_follow_centre() {
                return self.not_executed(MoveUnexecuted::SurfaceOnContour, span);
            }
            self.state.centre = self.frame[0];
        }
        Ok(())
    }
}
