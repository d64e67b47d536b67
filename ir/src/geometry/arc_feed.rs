//! What F counts on an arc under cutter compensation.
//!
//! With a tool of radius 5 round an outer arc of radius 0.5, F100 is 100 mm/min at the tool centre on one control. On
//! another one it is 100 mm/min on the contour: the centre then goes 1100 mm/min. On straight lines both are the same.
//!
//! Not here: which control has which meaning (the dictionaries), and what a program states (`ADVISE compensated-feed`).

use crate::behaviour::{Behaviour, Behaviours};
use crate::canon::{AdviceKind, Side, Turn};

/// What F counts on arcs under cutter compensation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ArcFeed {
    /// The speed of the tool centre.
    #[default]
    Centre,
    /// The speed along the contour.
    Contour,
    /// The speed along the contour on inner arcs, that of the tool centre on outer ones.
    Inside,
}

impl ArcFeed {
    /// The meaning by a name that behaviours and advice share.
    fn named(name: &str) -> ArcFeed {
        match name {
            "contour" => ArcFeed::Contour,
            "inside" => ArcFeed::Inside,
            _ => ArcFeed::Centre,
        }
    }

    const fn name(self) -> &'static str {
        match self {
            ArcFeed::Centre => "centre",
            ArcFeed::Contour => "contour",
            ArcFeed::Inside => "inside",
        }
    }

    /// The meaning on a control where the program states none.
    pub fn from_behaviours(behaviours: &Behaviours) -> ArcFeed {
        let value = usize::from(behaviours.get(Behaviour::FeedOnArcs));
        ArcFeed::named(Behaviour::FeedOnArcs.values().get(value).copied().unwrap_or_default())
    }

    /// The meaning that the program has stated: a value of [`AdviceKind::CompensatedFeed`].
    pub fn stated(value: u8) -> ArcFeed {
        let value = AdviceKind::CompensatedFeed.values().get(usize::from(value));
        ArcFeed::named(value.copied().unwrap_or_default())
    }

    /// The value of [`AdviceKind::CompensatedFeed`] that states it.
    pub fn advice(self) -> u8 {
        AdviceKind::CompensatedFeed.value(self.name()).unwrap_or(0)
    }

    /// Whether F counts along the contour on one arc: with the tool on this side of it.
    pub fn on_contour(self, side: Side, turn: Turn) -> bool {
        match self {
            ArcFeed::Centre => false,
            ArcFeed::Contour => true,
            ArcFeed::Inside => is_inner(side, turn),
        }
    }
}

/// Whether the tool is on the side of the centre of an arc.
pub fn is_inner(side: Side, turn: Turn) -> bool {
    (side == Side::Left) == (turn == Turn::Counterclockwise)
}

/// Bits of an execution's advice that state it.
pub const ADVICE: u64 = 7 << AdviceKind::CompensatedFeed.bits();

/// The speed of the tool centre as a part of F, where F counts along the contour: an arc of this radius and angle (in
/// radians), so far along the axis at right angles to its plane; the tool is `inner` or outer by its own radius. Lengths
/// in mm.
pub fn centre_speed(radius: f64, tool: f64, inner: bool, angle: f64, along: f64) -> f64 {
    let centre = if inner { radius - tool } else { radius + tool };
    (centre * angle).hypot(along) / (radius * angle).hypot(along)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Names of behaviour and advice are the same, whatever their order.
    #[test]
    fn names_are_shared() {
        for (value, name) in Behaviour::FeedOnArcs.values().iter().enumerate() {
            let mut behaviours = Behaviours::default();
            behaviours.set(Behaviour::FeedOnArcs, value as u8, false);
            let feed = ArcFeed::from_behaviours(&behaviours);
            assert_eq!(feed.name(), *name);
            assert_eq!(ArcFeed::stated(feed.advice()), feed);
        }
    }

    /// The speed of the centre round an outer arc of 0.5 mm with a tool of 5 mm is eleven times F.
    #[test]
    fn speeds_of_the_centre() {
        assert!((centre_speed(0.5, 5.0, false, 1.0, 0.0) - 11.0).abs() < 1e-12);
        assert!((centre_speed(20.0, 5.0, true, 3.0, 0.0) - 0.75).abs() < 1e-12);
        let helix = centre_speed(10.0, 5.0, true, 1.0, 10.0);
        assert!((helix - (125.0_f64 / 200.0).sqrt()).abs() < 1e-12);
    }
}
