//! Moves to points of the machine.

use super::super::Halt;
use super::{Control, Word, number};

impl Control {
    /// M19: on a Haas R with a point, or whole degrees by P; on a Fanuc without either.
    pub(super) fn stop_at_angle(&mut self, words: &[Word]) -> Result<(), Halt> {
        let angle = match (number(words, 'R'), number(words, 'P')) {
            (None, None) => None,
            (Some((degrees, true)), None) | (None, Some((degrees, false))) if self.haas => Some(degrees),
            _ => return self.m.halt("M19 with other words"),
        };
        self.m.orient(angle);
        Ok(())
    }

    /// G92 with a speed alone: the highest one under G96.
    pub(super) fn highest_speed(&mut self, words: &[Word]) -> bool {
        let alone = !self.haas && self.axis_words(words) == [None; 6];
        if alone {
            self.m.fastest = number(words, 'S').map(|(speed, _)| speed);
        }
        alone
    }

    /// G29: by rapid to where the axes named went to the reference point from, counted from the work's zero of now,
    /// and on to the words. G60: by rapid; how the end is come to is not looked at, and a move to where it stands is
    /// one all the same.
    fn by_detour(&mut self, code: u32, named: [Option<f64>; 6]) -> Result<(), Halt> {
        if self.m.beside.is_some() || named == [None; 6] {
            return self.m.halt("G29 or G60 without axes, or under compensation");
        }
        if code == 29 {
            let mut by = self.m.at;
            for axis in 0..6 {
                if named[axis].is_some() {
                    let Some(kept) = self.by_point[axis] else { return self.m.halt("G29 without G28") };
                    by[axis] = kept + self.m.shift(axis);
                }
            }
            if by != self.m.at {
                self.m.traverse(by);
            }
        }
        let to = self.m.target(named)?;
        self.m.traverse(to);
        Ok(())
    }

    /// G53, G28 and G30: all rapid; what is left of a tool's length by G28 is not looked at.
    pub(super) fn machine_point(&mut self, code: u32, words: &[Word]) -> Result<(), Halt> {
        if self.cycle.is_some() {
            return self.m.halt("a move of the machine within a cycle");
        }
        let mut named = self.axis_words(words);
        let home = self.haas && code == 28 && named == [None; 6];
        if code == 31 {
            // A skip signal ends the block, which is the only one that it is for.
            let to = self.m.target(named)?;
            return self.m.probe(to, false, false);
        }
        if matches!(code, 29 | 60) {
            return self.by_detour(code, named);
        }
        let mut to = self.m.at;
        if code == 53 {
            if !self.m.absolute {
                return self.m.halt("G53 under G91");
            }
            for (to, word) in to.iter_mut().zip(named) {
                *to = word.unwrap_or(*to);
            }
        } else {
            let way = self.m.target(named)?;
            if way != self.m.at {
                self.m.traverse(way);
            }
            to = way;
            if home {
                // Alone it is for all axes, from where they stand (96-8000, p. 152); no rotary one is looked at.
                named[..3].fill(Some(0.0));
            }
            for axis in 0..6 {
                if named[axis].is_some() {
                    self.by_point[axis] = Some(way[axis] - self.m.shift(axis));
                }
            }
            let point = match code {
                28 => [0.0; 6],
                _ => (self.m.setup.reference)(number(words, 'P').map_or(2, |(p, _)| p as u32)),
            };
            for ((to, word), point) in to.iter_mut().zip(named).zip(point) {
                *to = if word.is_some() { point } else { *to };
            }
        }
        self.m.traverse(to);
        if self.haas && code == 28 && named[2].is_some() {
            // G28 cancels the length for the blocks behind it (96-8000, p. 152).
            self.m.use_length(0);
        }
        for (settled, word) in self.m.settled.iter_mut().zip(named) {
            *settled &= word.is_none();
        }
        Ok(())
    }
}
