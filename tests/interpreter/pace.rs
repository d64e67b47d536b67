//! How long moves take whose F each control counts in a way of its own, from the manuals.

use super::beside::ArcFeed;
use super::{Machine, Per, Place};

/// What F counts where linear and rotary axes move together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rotary {
    /// The way of X, Y and Z (LinuxCNC; a Sinumerik whose FGROUP nobody has set; the text forms).
    #[default]
    Linear,
    /// A degree is a millimetre (Fanuc 15i-MA, 4.3).
    Degrees,
    /// The way at a diameter that is set on the machine (Haas).
    Diameter,
}

/// What F counts, where controls differ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Feeds {
    /// With rotary axes.
    pub rotary: Rotary,
    /// Under a feed by time, F of an arc is the feed over its radius (Fanuc B-62764EN, chapter 5).
    pub arcs_by_radius: bool,
    /// On arcs beside a contour.
    pub arcs: ArcFeed,
}

impl Machine {
    /// The last event's feed is one over so many minutes.
    pub(super) fn take(&mut self, minutes: f64) {
        if let Some(event) = self.events.last_mut() {
            (event.feed, event.per, event.timed) = (Some(1.0 / minutes), Per::Move, true);
        }
    }

    /// The minutes of a line in which rotary axes turn.
    pub(super) fn minutes(&self, from: Place, to: Place) -> Option<f64> {
        let way = |axes: std::ops::Range<usize>| {
            axes.map(|axis| (to[axis] - from[axis]).powi(2)).sum::<f64>().sqrt()
        };
        let unit = if self.inch { 25.4 } else { 1.0 };
        let (line, turn) = (way(0..3) / unit, way(3..6));
        if turn < 1e-9 || self.tip || self.plane_set {
            return None;
        }
        let feed = match self.per {
            Per::Minute => self.feed?,
            Per::Turn if !self.surface => self.feed? * self.speed?,
            Per::Turn | Per::Move => return None,
        };
        let whole = match self.feeds.rotary {
            Rotary::Linear if line > 1e-9 => line,
            Rotary::Linear => turn,
            Rotary::Degrees => (line * line + turn * turn).sqrt(),
            Rotary::Diameter => {
                let round = turn.to_radians() * self.setup.rotary_radius? / unit;
                (line * line + round * round).sqrt()
            }
        };
        Some(whole / (feed / unit))
    }

    /// The time of the arc recorded last, where F by time counts radii.
    pub(super) fn time_of_arc(&mut self, sweep: f64) {
        if let (true, Per::Move, Some(feed)) = (self.feeds.arcs_by_radius, self.per, self.feed) {
            self.take(sweep.abs().to_radians() / feed);
        }
    }

    /// G20 and G21 of a control that keeps the number of F (B-63944EN, p. 192), or of one that keeps the feed.
    pub(super) fn units(&mut self, inch: bool, keeps_number: bool) {
        let scale = match (self.inch, inch) {
            (false, true) => 25.4,
            (true, false) => 1.0 / 25.4,
            _ => 1.0,
        };
        if keeps_number && self.per != Per::Move {
            self.feed = self.feed.map(|feed| feed * scale);
        }
        self.inch = inch;
    }
}
