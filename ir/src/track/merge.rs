//! The merge of two paths: what holds on both.

use super::{ActiveCycle, Tracker};
use crate::expr::num::Nanos;

impl Tracker {
    /// What holds on both of two ways.
    pub fn join(&mut self, other: &Tracker) {
        fn both<T: PartialEq>(a: &mut Option<T>, b: &Option<T>) {
            if a != b {
                *a = None;
            }
        }
        let (m, o) = (&mut self.modes, &other.modes);
        both(&mut m.motion, &o.motion);
        both(&mut m.distance, &o.distance);
        both(&mut m.units, &o.units);
        both(&mut m.plane, &o.plane);
        both(&mut m.feed_mode, &o.feed_mode);
        both(&mut m.return_level, &o.return_level);
        both(&mut m.work_offset, &o.work_offset);
        both(&mut m.length_offset, &o.length_offset);
        both(&mut m.no_origin_shift, &o.no_origin_shift);
        for (a, b) in self.position.iter_mut().zip(&other.position) {
            both(a, b);
        }
        match (&mut self.cycle, &other.cycle) {
            // A hole that may have been skipped: the next one may be the first.
            (Some(a), Some(b))
                if a.drilled != b.drilled && (ActiveCycle { drilled: b.drilled, ..a.clone() }) == *b =>
            {
                a.drilled = false;
            }
            (a, b) => {
                // A level that is not known does not become known where ways meet.
                let level = |cycle: &Option<ActiveCycle>, doubt: bool, initial: Option<Nanos>| match cycle {
                    Some(cycle) => Some(cycle.initial),
                    None => doubt.then_some(initial),
                };
                let levels = (
                    level(a, self.cycle_in_doubt, self.doubtful_initial),
                    level(b, other.cycle_in_doubt, other.doubtful_initial),
                );
                self.doubtful_initial = match levels {
                    (Some(one), None) | (None, Some(one)) => one,
                    (Some(a), Some(b)) if a == b => a,
                    (Some(_), Some(_)) | (None, None) => None,
                };
                self.cycle_in_doubt |= a != b;
                both(a, b);
            }
        }
        self.cycle_in_doubt |= other.cycle_in_doubt;
        both(&mut self.selected, &other.selected);
        both(&mut self.tool, &other.tool);
        both(&mut self.spindle, &other.spindle);
        both(&mut self.feed, &other.feed);
        both(&mut self.speed, &other.speed);
        self.fed |= other.fed;
        self.stale_feed |= other.stale_feed;
        self.framed |= other.framed;
        self.chained |= other.chained;
        self.turned |= other.turned;
        self.turning.iter_mut().zip(other.turning).for_each(|(own, other)| *own |= other);
        self.local.join(&other.local);
        self.chain.join(&other.chain);
        self.chain_turned |= other.chain_turned;
        self.raw |= other.raw;
        self.probing |= other.probing;
        self.detour |= other.detour;
        self.intermediate.join(&other.intermediate);
        self.none_suspended &= other.none_suspended;
        self.pole_lost |= other.pole_lost || self.pole != other.pole;
        self.compensated |= other.compensated;
        self.tilted |= other.tilted;
        self.aside |= other.aside;
    }
}
