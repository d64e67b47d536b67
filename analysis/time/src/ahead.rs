//! A control that looks only so many blocks ahead.
//!
//! It must be able to stop at the end of the last block that it knows. So at a junction it is no faster than what
//! the next blocks give room to stop from, however the path goes on: that is a cap of the junction, like those of
//! corners. Under such caps the plan over the whole path is that of the control: what lies behind the last block
//! it knows can only ask for less than the stop there does.
//!
//! A leg waits here until the blocks after it are known, or the path ends.

use std::collections::VecDeque;

use crate::limits::Leg;
use crate::ramp::stop_from;

/// After so many legs the sum is counted again, so that it keeps its digits.
const RECOUNT: u32 = 1 << 12;

/// Legs that wait for those after them.
#[derive(Clone, Debug)]
pub(crate) struct Ahead {
    /// Blocks beyond the one that is carried out.
    blocks: usize,
    waiting: VecDeque<Leg>,
    /// How many of them are moves.
    moves: usize,
    /// Gains of all of them.
    gains: f64,
    counted: u32,
}

impl Ahead {
    /// Of a control that knows so many blocks beyond the one that it carries out; at least 1.
    pub(crate) fn new(blocks: u32) -> Ahead {
        Ahead { blocks: blocks.max(1) as usize, waiting: VecDeque::new(), moves: 0, gains: 0.0, counted: 0 }
    }

    /// Takes a leg; gives those whose caps are known now.
    pub(crate) fn push(&mut self, leg: Leg, out: &mut impl FnMut(Leg)) {
        self.moves += usize::from(leg.length > 0.0);
        self.gains += leg.gain();
        self.waiting.push_back(leg);
        while self.moves >= self.blocks {
            self.first(out);
        }
    }

    /// The path ends in a stop, which every block before it may know of.
    pub(crate) fn stop(&mut self, out: &mut impl FnMut(Leg)) {
        while !self.waiting.is_empty() {
            self.first(out);
        }
        (self.moves, self.gains) = (0, 0.0);
    }

    /// Gives the first, at most as fast as all of them give room to stop from.
    fn first(&mut self, out: &mut impl FnMut(Leg)) {
        let soft = self.waiting.iter().fold(0.0, |soft: f64, leg| soft.max(leg.softness));
        let Some(mut leg) = self.waiting.pop_front() else { return };
        if leg.length > 0.0 {
            let speed = stop_from(self.gains, soft);
            leg.cap = leg.cap.min(speed * speed);
            self.moves -= 1;
        }
        self.counted += 1;
        self.gains = match self.counted % RECOUNT {
            0 => self.waiting.iter().map(Leg::gain).sum(),
            _ => (self.gains - leg.gain()).max(0.0),
        };
        out(leg);
    }
}
