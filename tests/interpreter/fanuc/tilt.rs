//! G43.4 or, on a Haas, G234: control of the tool's tip. G68.2, G53.1: a plane in space, and the tool upright
//! on it.

use super::super::Halt;
use super::{Control, Word, number};

impl Control {
    /// Whether it is one of these codes (in tenths); each kind of control has its own.
    pub(super) fn five_axes(&self, code: u32, length: &mut Option<u32>, slot: &mut Option<u32>) -> bool {
        match (code, self.haas) {
            (434, false) | (2340, true) => *length = Some(434),
            (682 | 531, false) => *slot = Some(code),
            _ => return false,
        }
        true
    }

    /// `G68.2 X Y Z I J K` and `G53.1`, each in its own block.
    pub(super) fn plane(&mut self, code: u32, words: &[Word]) -> Result<(), Halt> {
        if self.cycle.is_some() {
            return self.m.halt("a plane in a cycle");
        }
        if code == 531 {
            return match words.iter().any(|w| "XYZABC".contains(w.0)) {
                true => self.m.halt("G53.1 and axis words"),
                false => self.m.stand_upright(),
            };
        }
        let zero = ['X', 'Y', 'Z'].map(|letter| self.length(words, letter));
        let angles = ['I', 'J', 'K'].map(|letter| self.angle(words, letter));
        let ([Some(x), Some(y), Some(z)], [Some(i), Some(j), Some(k)]) = (zero, angles) else {
            return self.m.halt("G68.2 without all of its words");
        };
        if !self.m.absolute || number(words, 'P').is_some() {
            return self.m.halt("G68.2 under G91, or with P");
        }
        self.m.set_plane([x, y, z], [(2, i), (0, j), (2, k)])
    }
}
