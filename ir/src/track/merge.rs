//! The merge of two paths: what holds on both.

use super::{ActiveCycle, Tracker};
use crate::expr::num::Nanos;
use crate::program::Op;

fn both<T: PartialEq>(a: &mut Option<T>, b: &Option<T>) {
    if a != b {
        *a = None;
    }
}

impl Tracker {
    /// What holds after a line that may be skipped, without a copy of everything; `false`, and nothing done, where more
    /// than position and motion may change.
    pub(super) fn skips_line(&mut self, op: &Op) -> bool {
        let plain = !(self.raw || self.probing || self.detour || self.cycle_in_doubt) && self.cycle.is_none();
        if !plain || !matches!(op, Op::StraightFeed(_) | Op::StraightTraverse(_)) {
            return false;
        }
        let (position, motion) = (self.position, self.modes.motion);
        self.apply(op);
        self.position.iter_mut().zip(&position).for_each(|(here, before)| both(here, before));
        both(&mut self.modes.motion, &motion);
        self.doubtful_initial = None;
        true
    }

    /// What holds on both of two ways.
    pub fn join(&mut self, other: &Tracker) {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canon::{AXES, Distance, Fact, Motion};
    use crate::expr::Expr;
    use crate::program::{Coord, Move, Point, Stmt};
    use crate::source::Span;

    fn line(x: i64, z: Option<i64>, distance: Fact<Distance>) -> Move {
        let mut to = Point::default();
        to.axes[0] = Some(Coord { value: Expr::int(x), distance });
        to.axes[2] = z.map(|z| Coord { value: Expr::int(z), distance });
        Move { to, said: true }
    }

    /// A line that may be skipped leaves what a copy of everything and its merge leave.
    #[test]
    fn skipped_lines_leave_what_the_merge_leaves() {
        let known = Tracker { position: [Some(7); AXES], ..Tracker::default() };
        let starts = [
            Tracker::default(),
            Tracker::unknown(),
            Tracker { doubtful_initial: Some(3), ..known.clone() },
            Tracker { cycle_in_doubt: true, doubtful_initial: Some(3), ..known.clone() },
            Tracker { raw: true, ..known.clone() },
            Tracker { probing: true, ..known.clone() },
            Tracker { detour: true, framed: true, ..known.clone() },
            known,
        ];
        let mut short = 0;
        for (start, motion) in starts.iter().flat_map(|start| {
            [None, Some(Motion::Feed), Some(Motion::Traverse)].map(move |motion| (start, motion))
        }) {
            let mut start = start.clone();
            start.modes.motion = motion;
            for distance in [Fact::Entry, Fact::Known(Distance::Absolute), Fact::Known(Distance::Incremental)]
            {
                for to in [line(0, None, distance), line(1, Some(-2), distance)] {
                    for op in [
                        Op::StraightFeed(to.clone()),
                        Op::StraightTraverse(to),
                        Op::SetFeedRate(Expr::int(9)),
                    ] {
                        let mut merged = start.clone();
                        merged.apply(&op);
                        merged.join(&start);
                        short += u32::from(start.clone().skips_line(&op));
                        let mut stepped = start.clone();
                        stepped.step(&Stmt { skip: Some(1), ..Stmt::new(Span::default(), op) });
                        assert_eq!(stepped, merged);
                    }
                }
            }
        }
        assert!(short > 20, "{short}");
    }
}
