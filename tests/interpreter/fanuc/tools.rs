//! Tools and their lengths, as the builder and parameter 5006#6 (TOS) have them, from `reference/fanuc.md` and
//! `reference/effects-fanuc-haas.md`: on some machines M06 with a T in its block puts in the tool that an earlier T has
//! called, and that T calls the next one; with TOS = 0 a length that is called up or cancelled in a block without an axis
//! word moves Z by it. G28 and G53 along Z cancel the vector of the length (B-63844EN/02, p. 204).

use super::super::{Halt, What};
use super::{Control, Word, number};

impl Control {
    /// G43, G43.4 or G49 with what its block has for H.
    pub(super) fn length_code(&mut self, code: Option<u32>, entry: Option<u32>) -> Result<(), Halt> {
        match (code, entry) {
            (Some(43 | 434), Some(entry)) => {
                self.entry = Some(entry);
                self.m.use_length(entry);
            }
            // The length comes back with the next G43 or the next H (0i-MB, 14.1.2): H is modal.
            (Some(43), None) => match self.entry {
                Some(entry) => self.m.use_length(entry),
                None => return self.m.halt("G43 and no H so far"),
            },
            (Some(49), None) => self.m.use_length(0),
            (None, None) => {}
            _ => return self.m.halt("G43 and H"),
        }
        Ok(())
    }

    /// T: selects. What waited before, where the block names another one.
    pub(super) fn select(&mut self, words: &[Word]) -> Option<u32> {
        let (tool, _) = number(words, 'T')?;
        let waited = self.m.selected.filter(|waited| self.m.tool != Some(*waited) && *waited != tool as u32);
        self.m.selected = Some(tool as u32);
        waited
    }

    /// M06, in a block before which a tool waited that the block does not name.
    pub(super) fn change(&mut self, waited: Option<u32>) -> Result<(), Halt> {
        let named = self.m.selected;
        let waiting = waited.filter(|_| self.m.setup.waiting_tool);
        self.m.selected = waiting.or(named);
        self.m.change_tool()?;
        self.m.selected = named;
        Ok(())
    }

    /// The length that Z stands with.
    pub(super) fn standing_length(&self) -> f64 {
        if self.placed { 0.0 } else { self.m.length_of(self.m.entry) }
    }

    /// The end of a block's words of length: with TOS = 0 one without a Z moves Z by what it is more than before.
    pub(super) fn bare_length(
        &mut self,
        code: Option<u32>,
        machine: Option<u32>,
        words: &[Word],
        old: f64,
    ) -> Result<(), Halt> {
        let axes = self.axis_words(words);
        let by = self.m.length_of(self.m.entry) - old;
        let bare = matches!(code, Some(43 | 49)) && axes[2].is_none() && machine.is_none();
        if bare && self.m.setup.length_moves && by != 0.0 {
            if self.cycle.is_some() || self.motion > 1 || axes != [None; 6] || self.m.tip {
                return self.m.halt("a length that moves Z in a cycle, under an arc or beside other words");
            }
            let mut to = self.m.at;
            to[2] += by;
            self.m.settled[2] = !self.placed;
            self.placed = false;
            match self.motion {
                0 => self.m.traverse(to),
                _ => self.m.straight(to)?,
            }
        }
        if axes[2].is_some() {
            self.placed = machine.is_some_and(|code| matches!(code, 28 | 30 | 53));
        }
        Ok(())
    }

    /// G04: on a Fanuc a number without a point counts milliseconds.
    pub(super) fn dwell(&mut self, words: &[Word]) -> Result<(), Halt> {
        let seconds = match (number(words, 'X'), number(words, 'P')) {
            (Some(_), None) if self.haas => return self.m.halt("G04 X"),
            (Some((x, true)), None) => x,
            (Some((x, false)), None) => x * 0.001,
            (None, Some((p, true))) if self.haas => p,
            (None, Some((p, _))) => p * 0.001,
            _ => return self.m.halt("G04 needs X or P"),
        };
        self.m.record(What::Dwell(seconds));
        Ok(())
    }
}
