//! Execution of what goes synchronised with the spindle, and of what a cycle does with the spindle.
//!
//! Not here: how a hole is reached and left (`holes`).

use crate::{Event, Exec, Kind, by_control};
use ncc_ir::canon::{FeedMode, Motion, Spindle, SpindleMode, Turn, same_point};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::program::{Pitch, Synchronised};
use ncc_ir::source::Span;
use ncc_ir::unexecuted::MoveUnexecuted;

impl Exec {
    /// A straight spindle-synchronised move, said by the program.
    pub(crate) fn synchronised(
        &mut self,
        m: &Synchronised,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        if self.raw.take().is_some() || self.probing.take().is_some() || self.detour.take().is_some() {
            return self.not_executed(MoveUnexecuted::ThreadInMachine, span);
        }
        let stated = self.stated_pitch(&m.pitch, span)?;
        let (began, turns) = (self.position, self.state.spindle);
        if !m.chuck && m.turn.is_none() && turns == Spindle::Stopped {
            return self.not_executed(MoveUnexecuted::ThreadSpindleStopped, span);
        }
        if self.another_length_waits() && m.to.axes[self.along].is_some() {
            // From where it goes by the length before, to where it goes by the one that takes effect on it.
            return self.not_executed(MoveUnexecuted::ThreadTakesLength, span);
        }
        self.set_axes(&m.to, span)?;
        self.heading = crate::Heading::None;
        // Bare axis words after it are no plain feed: without an active cycle they are an error.
        self.modes.motion = Motion::Cycle;
        self.said |= crate::MOTION;
        self.cycle = None;
        if let Some(turn) = m.turn {
            self.turn_spindle(turn.spindle(), span, out)?;
        }
        self.in_step(stated, m.chuck, span, out)?;
        if m.back {
            let turned = m.turn.map_or(turns, Turn::spindle);
            let other = match turned {
                Spindle::Counterclockwise => Spindle::Clockwise,
                Spindle::Clockwise | Spindle::Stopped => Spindle::Counterclockwise,
            };
            self.turn_spindle(other, span, out)?;
            self.position = began;
            self.in_step(stated, m.chuck, span, out)?;
            self.turn_spindle(turned, span, out)?;
        }
        if m.turn.is_some() {
            self.turn_spindle(Spindle::Stopped, span, out)?;
        }
        Ok(())
    }

    /// A pitch that is stated; nothing where feed and speed say it.
    pub(crate) fn stated_pitch(&self, pitch: &Pitch, span: Span) -> Result<Option<Nanos>, Diagnostic> {
        let Pitch::Stated(pitch) = pitch else { return Ok(None) };
        match self.value(pitch, span)? {
            pitch if pitch > 0 => Ok(Some(pitch)),
            _ => self.fault(Fault::OutOfRange { word: "pitch".into() }, span),
        }
    }

    /// Emits a move to the present position synchronised with the spindle as it turns.
    pub(crate) fn in_step(
        &mut self,
        stated: Option<Nanos>,
        chuck: bool,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        let speed = self.state.speed;
        if self.state.spindle_mode == SpindleMode::Surface {
            return self.not_executed(MoveUnexecuted::ThreadSurfaceSpeed, span);
        }
        if speed <= 0 {
            return self.fault(Fault::NoSpeed, span);
        }
        self.within_limit(span)?;
        let pitch = match stated {
            Some(pitch) => pitch,
            None if self.feed == 0 => return self.fault(Fault::NoFeed, span),
            None => self.feed_of_a_turn(speed),
        };
        let end = self.machine();
        if same_point(&end, &self.last) && !self.every_move && !self.narrating {
            return Ok(());
        }
        self.last = end;
        self.emit(Kind::Synchronised { pitch, chuck }, span, out)
    }

    /// How far the active feed goes in one turn.
    fn feed_of_a_turn(&self, speed: Nanos) -> Nanos {
        if self.state.feed_mode == FeedMode::PerRevolution {
            return self.feed;
        }
        let (feed, speed) = (i128::from(self.feed) * i128::from(ONE), i128::from(speed));
        Nanos::try_from((feed + speed / 2) / speed).unwrap_or(Nanos::MAX)
    }

    /// Stops the spindle at an angle.
    pub(crate) fn orient(
        &mut self,
        angle: Option<&Expr>,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        if self.state.spindle_mode == SpindleMode::Surface {
            return self.not_executed(MoveUnexecuted::OrientedStopSurface, span);
        }
        let angle = match angle {
            Some(angle) => self.value(angle, span)?,
            None => self.world.orientation,
        };
        self.state.spindle = Spindle::Stopped;
        self.said_by_program(by_control::SPINDLE | by_control::SPINDLE_AT_CHANGE);
        self.emit(Kind::Orient(angle), span, out)
    }
}
