//! Look-ahead over the whole path with constant acceleration.
//!
//! In terms of the squared speed, a leg of length `s` at acceleration `a` can change it by `2as` and no
//! more. The fastest plan under the caps of all junctions is known: forwards, the square at a junction
//! is at most the one before plus the gain between, and at most its cap; backwards likewise from the
//! stop at the end. Here the backward pass is done piece by piece, and gives the same as if the
//! whole path were known: a junction is settled as soon as the path known after it is long enough
//! to stop from the highest speed that the forward pass gives it. What may still come can then only be
//! faster than a stop. So the queue is no longer than the path in which the machine can stop.
//!
//! Each leg is touched once by each pass. The last settled junction is found by keeping candidates:
//! junction `j` is settled when `forward(j) + gains before j` is at most the sum of all gains; one that
//! comes later with a smaller sum is settled before all that are larger and earlier, which then need
//! not be kept.

use crate::limits::Leg;
use crate::profile::Profile;
use crate::queue::Queue;

/// Sum of gains from which it is counted again, so that it keeps its digits.
const RECOUNT: f64 = 1e9;

/// A leg with the squared speed at its start: by the forward pass, later settled.
#[derive(Clone, Copy, Debug)]
struct Planned {
    leg: Leg,
    gain: f64,
    entry: f64,
}

/// A junction that may be settled.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    /// The leg that starts there, counted from the start of the path.
    leg: u64,
    /// Settled when all gains reach this.
    at: f64,
}

/// The legs whose speeds are not certain yet.
#[derive(Clone, Debug, Default)]
pub(crate) struct Plan {
    legs: Queue<Planned>,
    /// Number of the first of them.
    first: u64,
    candidates: Queue<Candidate>,
    /// Gains of all legs since the count began.
    gains: f64,
}

impl Plan {
    /// Takes a leg; gives the profiles of those that are certain now.
    pub(crate) fn push(&mut self, leg: Leg, out: &mut impl FnMut(Profile)) {
        let entry = match self.legs.last() {
            None => 0.0,
            Some(last) => leg.cap.min(last.entry + last.gain),
        };
        let candidate = Candidate { leg: self.first + self.legs.len() as u64, at: entry + self.gains };
        while self.candidates.last().is_some_and(|other| other.at >= candidate.at) {
            self.candidates.drop_last();
        }
        self.candidates.push(candidate);
        let gain = leg.gain();
        self.gains += gain;
        self.legs.push(Planned { leg, gain, entry });
        let gains = self.gains;
        let settled = self.candidates.all().iter().take_while(|next| next.at <= gains).count();
        if let Some(last) = settled.checked_sub(1).and_then(|last| self.candidates.all().get(last)) {
            let legs = (last.leg - self.first) as usize;
            self.candidates.drop_first(settled);
            self.release(legs, out);
        }
        if self.gains > RECOUNT {
            for candidate in self.candidates.all() {
                candidate.at -= gains;
            }
            self.gains = 0.0;
        }
    }

    /// The path ends in a stop: all the rest is certain.
    pub(crate) fn stop(&mut self, out: &mut impl FnMut(Profile)) {
        let leg = Leg::INSTANT;
        self.legs.push(Planned { leg, gain: 0.0, entry: 0.0 });
        self.release(self.legs.len() - 1, out);
        self.legs.clear();
        self.candidates.clear();
        (self.first, self.gains) = (0, 0.0);
    }

    /// Gives the legs before one whose entry is settled.
    fn release(&mut self, settled: usize, out: &mut impl FnMut(Profile)) {
        let Some((legs, [last, ..])) = self.legs.all().split_at_mut_checked(settled) else { return };
        let mut exit = last.entry;
        for planned in legs.iter_mut().rev() {
            exit = planned.entry.min(exit + planned.gain);
            planned.entry = exit;
        }
        let mut entry = exit.sqrt();
        let exits = legs.iter().skip(1).map(|planned| planned.entry).chain([last.entry]);
        for (planned, squared) in legs.iter().zip(exits) {
            let exit = squared.sqrt();
            out(ramps(planned, squared, [entry, exit]));
            entry = exit;
        }
        self.legs.drop_first(settled);
        self.first += settled as u64;
    }
}

/// The fastest way through a leg; `exit` is the square of the second of the speeds at its ends.
fn ramps(planned: &Planned, exit: f64, [from, to]: [f64; 2]) -> Profile {
    let Leg { length, speed, acceleration, .. } = planned.leg;
    if length <= 0.0 {
        return Profile::default();
    }
    let entry = planned.entry;
    let each = 1.0 / acceleration;
    let top = ((entry + exit + planned.gain) / 2.0).max(entry).max(exit);
    let most = speed * speed;
    if top <= most {
        // Never at a constant speed.
        let peak = top.sqrt();
        let (up, down) = ((peak - from) * each, (peak - to) * each);
        return Profile { entry: from, peak, exit: to, t_accel: up, t_cruise: 0.0, t_decel: down };
    }
    let rest = length - (most - (entry + exit) / 2.0) * each;
    Profile {
        entry: from,
        peak: speed,
        exit: to,
        t_accel: (speed - from) * each,
        t_cruise: rest.max(0.0) / speed,
        t_decel: (speed - to) * each,
    }
}
