//! Threads that are blocks of their own, in machine coordinates.

use super::{Halt, Machine, Place, Spindle};

impl Machine {
    /// A cut of so much a turn, as the spindle turns.
    pub fn cut_thread(&mut self, to: Place, lead: f64) -> Result<(), Halt> {
        if self.spindle == Spindle::Stopped || self.speed.is_none_or(|speed| speed <= 0.0) {
            return self.halt("a thread and a spindle that stands");
        }
        if self.beside.is_some() || lead <= 0.0 {
            return self.halt("a thread without a lead, or beside a contour");
        }
        self.thread(to, lead, false);
        Ok(())
    }

    /// The same, and back to where it began with the spindle turned round.
    pub fn tap_and_back(&mut self, to: Place, lead: f64) -> Result<(), Halt> {
        let (began, turns) = (self.at, self.spindle);
        self.cut_thread(to, lead)?;
        self.turn(other(turns));
        self.thread(began, lead, false);
        self.turn(turns);
        Ok(())
    }

    /// A cut for which the control turns the spindle, and holds it after.
    pub fn turned_thread(&mut self, to: Place, lead: f64, turn: Spindle) -> Result<(), Halt> {
        self.turn(turn);
        self.cut_thread(to, lead)?;
        self.turn(Spindle::Stopped);
        Ok(())
    }

    /// A cut with a compensating chuck: the feed over the speed is the lead.
    pub fn chuck_thread(&mut self, to: Place) -> Result<(), Halt> {
        let (Some(feed), Some(speed)) = (self.feed, self.speed.filter(|speed| *speed > 0.0)) else {
            return self.halt("a thread without feed or speed");
        };
        self.thread(to, feed / speed, true);
        Ok(())
    }
}

/// The other sense.
pub(super) fn other(turn: Spindle) -> Spindle {
    match turn {
        Spindle::Clockwise => Spindle::Counterclockwise,
        _ => Spindle::Clockwise,
    }
}
