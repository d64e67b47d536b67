//! How far, and in which direction, an absolute word turns a rotary axis.
//!
//! As far as its number says; or the shortest way to that angle; or to that angle in the direction of the number's sign.
//! From a place that the program has not said itself it turns as its number says on all controls: nobody could tell.
//!
//! Not here: words that say the way themselves (`motion_modes`).

use crate::Exec;
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::{AXES, Axis, Distance, FeedMode};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::program::kinds::frames;
use ncc_ir::program::{Coord, Op, Point, Stmt};

/// A full turn, nanos of a degree.
const TURN: Nanos = 360 * ONE;

/// What decides about it.
const WAY: Behaviour = Behaviour::RotaryTurn;

/// The value of the shortest way.
const SHORTEST: u8 = 1;

/// The value of the way in the direction of the number's sign.
const SIGN: u8 = 2;

/// Where an axis that stands at `from` goes by an absolute word, on a control with this value of the behaviour.
pub fn end(value: u8, from: Nanos, to: Nanos) -> Nanos {
    match value {
        SHORTEST => {
            let way = to - from;
            if -TURN / 2 < way && way <= TURN / 2 {
                return to;
            }
            let way = way.rem_euclid(TURN);
            if way > TURN / 2 { from + way - TURN } else { from + way }
        }
        SIGN => {
            let up = (to.abs() - from).rem_euclid(TURN);
            if to < 0 && up != 0 { from + up - TURN } else { from + up }
        }
        _ => to,
    }
}

impl Exec {
    /// Whether a point has words of rotary axes.
    #[inline]
    pub(crate) fn turns(to: &Point) -> bool {
        to.axes[Axis::A as usize..].iter().any(Option::is_some)
    }

    /// Has rotary axes go to where this control takes them; `next` is where the numbers say.
    #[cold]
    pub(crate) fn turn_rotary(&mut self, to: &Point, next: &mut [Nanos; AXES]) {
        for (axis, next) in next.iter_mut().enumerate().skip(Axis::A as usize) {
            let Some(word) = &to.axes[axis] else { continue };
            if word.distance.or(self.modes.distance) == Distance::Absolute {
                *next = self.turned(axis, *next);
            }
        }
    }

    /// Where an absolute word takes a rotary axis from where it stands.
    pub(crate) fn turned(&mut self, axis: usize, to: Nanos) -> Nanos {
        let bit = 1 << axis;
        let known = self.turned_known & bit != 0;
        self.turned_known |= bit;
        if !known || self.own_way {
            return to;
        }
        let from = self.position[axis];
        if end(SHORTEST, from, to) != to {
            self.asked |= WAY.bit();
        }
        end(self.world.behaviours.get(WAY), from, to)
    }

    /// Whether any of these statements turns a rotary axis in a way that controls do not agree about.
    pub(crate) fn turns_far_in(&self, stmts: &[Stmt]) -> bool {
        let (mut at, mut known, mut distance) = (self.position, self.turned_known, self.modes.distance);
        // After another zero, where an axis stands hangs on the tables.
        let mut elsewhere = 0;
        for stmt in stmts.iter().filter(|stmt| !self.skips(stmt)) {
            let to = match &stmt.op {
                Op::SetDistanceMode(mode) => {
                    distance = *mode;
                    continue;
                }
                Op::StraightTraverse(m) | Op::StraightFeed(m) => &m.to,
                frames!() | Op::SetData(_) => {
                    elsewhere = known;
                    continue;
                }
                _ => continue,
            };
            for (axis, at) in at.iter_mut().enumerate().skip(Axis::A as usize) {
                let Some(word) = &to.axes[axis] else { continue };
                let Some(value) = self.degrees(word) else { return true };
                if word.distance.or(distance) == Distance::Incremental {
                    *at += value;
                    continue;
                }
                let unsure = elsewhere >> axis & 1 == 1;
                if unsure || known >> axis & 1 == 1 && end(SHORTEST, *at, value) != value {
                    return true;
                }
                *at = value;
                known |= 1 << axis;
            }
        }
        false
    }

    /// Whether any of these statements may turn a rotary axis at a feed. (A time is the same whatever a feed counts.)
    pub(crate) fn feeds_turns_in(&self, stmts: &[Stmt]) -> bool {
        const A: usize = Axis::A as usize;
        let (mut mode, mut distance) = (self.state.feed_mode, self.modes.distance);
        // The numbers at which the axes stand, as far as the same number again surely turns nothing.
        let mut plain = self.goes_plainly() && self.chain.is_none() && self.world.behaviours.get(WAY) != SIGN;
        let machine = self.machine();
        let mut at: [Option<Nanos>; AXES] = std::array::from_fn(|axis| {
            (plain && machine[axis] == self.last[axis]).then_some(self.position[axis])
        });
        for stmt in stmts.iter().filter(|stmt| !self.skips(stmt)) {
            let (to, feed) = match &stmt.op {
                Op::StraightFeed(m) => (&m.to, mode != FeedMode::InverseTime),
                Op::StraightTraverse(m) | Op::Position(m) => (&m.to, false),
                Op::SetFeedMode(set) => {
                    mode = *set;
                    continue;
                }
                Op::SetDistanceMode(set) => {
                    distance = *set;
                    continue;
                }
                Op::SetFeedRate(_) | Op::Comment(_) | Op::Blank => continue,
                _ => {
                    (plain, at) = (false, [None; AXES]);
                    continue;
                }
            };
            for (word, at) in to.axes[A..].iter().zip(&mut at[A..]) {
                let Some(word) = word else { continue };
                let absolute = word.distance.or(distance) == Distance::Absolute;
                let end = self.degrees(word).filter(|_| absolute);
                if feed && (end.is_none() || *at != end) {
                    return true;
                }
                *at = end.filter(|_| plain);
            }
        }
        false
    }

    fn degrees(&self, word: &Coord) -> Option<Nanos> {
        self.nanos(&word.value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_those_of_the_behaviour() {
        let values = [SHORTEST, SIGN].map(|value| WAY.values().get(usize::from(value)).copied());
        assert_eq!(values, [Some("shortest"), Some("sign")]);
    }

    /// The shortest way is that of the remainder, with half a turn up.
    #[test]
    fn the_shortest_way_is_at_most_half_a_turn() {
        for from in (-800..800).step_by(20) {
            for to in (-800..800).step_by(20) {
                let (at, word) = (from * ONE, to * ONE);
                let went = end(SHORTEST, at, word) - at;
                assert!(-TURN / 2 < went && went <= TURN / 2, "{from} {to}");
                assert_eq!((word - at - went) % TURN, 0, "{from} {to}");
            }
        }
    }
}
