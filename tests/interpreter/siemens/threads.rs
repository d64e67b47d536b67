//! Threads of a block, and what ends one.

use super::super::threads::other;
use super::super::{Halt, Place, Spindle, What};
use super::{Control, Next, Words};

impl Control<'_> {
    /// G33, G331 and G332 by the lead of their axis; the sign turns the spindle the other way.
    pub(super) fn thread(
        &mut self,
        turns: Option<Spindle>,
        w: &Words,
        axes: &[usize],
        to: Place,
    ) -> Result<(), Halt> {
        let [axis @ 0..=2] = axes[..] else { return self.m.halt("a thread along several axes") };
        let leads = w.letters.iter().filter(|l| "IJK".contains(l.0)).count();
        let Some(lead) = w.letter(['I', 'J', 'K'][axis]).filter(|_| leads == 1 && w.named.is_empty()) else {
            return self.m.halt("a thread without the lead of its axis, or with other words");
        };
        let (lead, to) = (lead.number * self.unit(), self.machine(to));
        self.tangent = None;
        if self.modal.is_some() || self.suppressed {
            return self.m.halt("a thread under a modal cycle or in machine coordinates");
        }
        match turns {
            None => self.m.cut_thread(to, lead),
            Some(turn) => self.m.turned_thread(to, lead.abs(), if lead < 0.0 { other(turn) } else { turn }),
        }
    }

    /// G63: at the feed, for one block, whatever motion is modal.
    pub(super) fn floating_thread(&mut self, axes: &[usize], to: Place) -> Result<(), Halt> {
        if !matches!(axes, [0..=2]) || self.modal.is_some() || self.suppressed {
            return self.m.halt("G63 along several axes, under a modal cycle or in machine coordinates");
        }
        self.tangent = None;
        self.m.chuck_thread(self.machine(to))
    }

    pub(super) fn end_codes(&mut self, codes: &[u32]) -> Result<Next, Halt> {
        let last: Vec<u32> = codes.iter().copied().filter(|c| [0, 1, 2, 17, 30].contains(c)).collect();
        match (&last[..], self.depth) {
            ([], _) => {}
            ([0], _) => self.m.record(What::Stop),
            ([1], _) => self.m.record(What::OptionalStop),
            (_, 1..) if last.len() == 1 => return Ok(Next::Back),
            (_, 0) if last.len() == 1 => {
                self.m.record(What::End);
                return Ok(Next::End);
            }
            _ => return self.m.halt("several stops or ends"),
        }
        Ok(Next::Block)
    }
}
