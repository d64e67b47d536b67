//! Worlds: what execution needs to know that no program says.
//!
//! A world is an explicit argument, never ambient. Verification makes several, distinct and
//! non-round, so that a lost work offset or a swapped length entry shows in machine coordinates.

use crate::canon::{AXES, Modes};
use crate::num::{Nanos, ONE};

/// One state of the machine and its tables before the program starts.
#[derive(Clone, Debug, PartialEq)]
pub struct World {
    /// Which of the generated worlds this is; 0 is the plain one.
    pub seed: u32,
    /// Modes at power-on. Every fact is known to a world.
    pub power_on: Modes,
    /// Where the axes stand, in machine coordinates.
    pub start: [Nanos; AXES],
    /// The control's own clearance of the peck-drilling cycle, in millimetres.
    pub peck_clearance: Nanos,
}

impl World {
    /// Zero of a work offset (1 is the first), in machine coordinates.
    pub fn work_offset(&self, number: u16) -> [Nanos; AXES] {
        if self.seed == 0 {
            return [0; AXES];
        }
        std::array::from_fn(|axis| self.odd(u32::from(number) * 8 + axis as u32, 190))
    }

    /// Length of an entry of the tool-length table, in millimetres; entry 0 is none.
    pub fn tool_length(&self, entry: u32) -> Nanos {
        if self.seed == 0 || entry == 0 { 0 } else { 40 * ONE + self.odd(entry * 8 + 7, 35) }
    }

    /// A value between -range and range mm that looks like no other: to six decimals, so that no
    /// rounding of a program can meet it by chance.
    fn odd(&self, index: u32, range: i64) -> Nanos {
        let mut h = u64::from(self.seed) << 32 | u64::from(index);
        h = (h ^ (h >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
        h = (h ^ (h >> 33)).wrapping_mul(0xc4ce_b9fe_1a85_ec53);
        h ^= h >> 33;
        let micro = (h % (2_000_000 * range as u64)) as i64 - 1_000_000 * range;
        (micro | 1) * 1000
    }
}
