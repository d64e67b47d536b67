//! How long moves take whose F each control counts in a way of its own: arcs with an inverse-time feed, and linear and rotary
//! axes together. Such a move's event has the time in the place of the feed, as one over minutes, so that the comparison
//! holds the times of both controls together, whatever words say them.
//!
//! Not here: every other move, whose F says the same on every control.

use crate::{Exec, by_control};
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::{AXES, FeedMode, SpindleMode};
use ncc_ir::expr::num::{Nanos, ONE};

/// Values of [`Behaviour::RotaryFeed`].
pub const LINEAR: u8 = 0;
/// A degree counts as a unit of length.
pub const DEGREES: u8 = 1;

/// One over minutes, nanos.
pub(crate) type Pace = Option<Nanos>;

impl Exec {
    /// The feed that is active at the first statement: that of a caller, in nanometres a minute or a turn.
    pub fn begin_at_feed(&mut self, feed: Nanos) {
        self.feed = feed;
    }

    /// The program says what a feed counts.
    pub(crate) fn set_feed_mode(&mut self, mode: FeedMode) {
        // What a feed said before would count now, nobody knows; a time is one block's.
        let ends = self.world.feed_ends_with_mode || mode == FeedMode::InverseTime;
        if self.state.feed_mode != mode || ends {
            self.state.feed_mode = mode;
            self.feed = 0;
        }
        self.said |= crate::FEED_MODE;
    }

    /// The time of a cut along a line from where the machine stands, if rotary axes turn in it.
    #[inline]
    pub(crate) fn pace_of_line(&mut self, end: &[Nanos; AXES]) -> Pace {
        let turns = |axis: usize| end[axis] != self.last[axis];
        if turns(3) || turns(4) || turns(5) { self.pace_of_turn(end) } else { None }
    }

    #[cold]
    fn pace_of_turn(&mut self, end: &[Nanos; AXES]) -> Pace {
        if self.state.tip || self.state.tilted {
            return None;
        }
        let unit = if self.modes.inch { 25.4 } else { 1.0 };
        let per_minute = match self.state.feed_mode {
            FeedMode::PerMinute => 1.0,
            FeedMode::PerRevolution if self.state.spindle_mode == SpindleMode::Turns => {
                self.state.speed as f64 / ONE as f64
            }
            FeedMode::PerRevolution | FeedMode::InverseTime => return None,
        };
        self.asked |= Behaviour::RotaryFeed.bit();
        let number = self.feed as f64 / ONE as f64 / unit * per_minute;
        let along = |axes: std::ops::Range<usize>| {
            axes.map(|axis| (end[axis] - self.last[axis]) as f64 / ONE as f64).fold(0.0, f64::hypot)
        };
        let (line, turn) = (along(0..3) / unit, along(3..AXES));
        let way = match self.world.behaviours.get(Behaviour::RotaryFeed) {
            LINEAR if line > 0.0 => line,
            LINEAR => turn,
            DEGREES => line.hypot(turn),
            _ => line.hypot(turn.to_radians() * self.world.rotary_radius()? / unit),
        };
        rate(number / way)
    }

    /// The time of an arc of so many degrees, where inverse-time F counts radii.
    pub(crate) fn pace_of_arc(&mut self, degrees: f64) -> Pace {
        if self.state.feed_mode != FeedMode::InverseTime || !self.does(Behaviour::ArcByTime) {
            return None;
        }
        rate(self.feed as f64 / ONE as f64 / degrees.abs().to_radians())
    }

    /// The event's feed, and whether it is a time.
    pub(crate) fn paced(&self, pace: Pace) -> (Nanos, crate::State) {
        let mut state = self.state;
        let Some(pace) = pace else { return (self.feed, state) };
        (state.feed_mode, state.by_control) = (FeedMode::InverseTime, state.by_control | by_control::TIMED);
        (pace, state)
    }
}

fn rate(per_minute: f64) -> Pace {
    let nanos = (per_minute * ONE as f64).round();
    (nanos >= 1.0 && nanos < Nanos::MAX as f64).then_some(nanos as Nanos)
}
