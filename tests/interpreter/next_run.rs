//! What a program leaves to the one that runs after it.
//!
//! From the manuals: a Sinumerik clears programmed frames at the start of a program; LinuxCNC keeps the shifts of G52
//! and G92 after M2 and after power-off; on a Fanuc and a Haas the reset at M30 takes G52 (parameter 1202 bit 3, setting
//! 33), G68, G51 and G51.1 (parameter 3402 bit 6, setting 56) away, as most machines are set, and G92 stays. Values that
//! a program has put into the tables stay everywhere, and so do variables that all programs share, as long as the
//! control is on.

use super::slots::Slots;
use super::stored::Stored;
use super::{Machine, What};

/// What a program has left.
#[derive(Clone, Debug, Default)]
pub struct Left {
    pub(super) stored: Stored,
    pub(super) slots: Slots,
}

impl Left {
    /// A variable with a number that all programs share, with what an earlier program or the operator has put into it.
    #[must_use]
    pub fn variable(number: u32, value: f64) -> Left {
        let mut left = Left::default();
        left.stored.variables.insert(number, value);
        left
    }
}

impl Machine {
    /// What the program that has ended leaves on a control of this dialect.
    pub fn left(&self, dialect: &str) -> Left {
        let mut stored = self.stored.clone();
        stored.nothing_in_force();
        let ended = self.events.iter().any(|event| matches!(event.what, What::End));
        let slots = match (dialect, ended) {
            ("fanuc" | "haas", true) => {
                Slots { origin: self.slots.origin, aside: self.slots.aside, ..Slots::default() }
            }
            ("linuxcnc" | "mach9" | "grbl" | "mach3", true) => Slots {
                origin: self.slots.origin,
                aside: self.slots.aside,
                local: self.slots.local,
                ..Slots::default()
            },
            _ => Slots::default(),
        };
        Left { stored, slots }
    }

    /// Whether the program that has ended leaves shifts or values in the tables.
    pub fn leaves(&self) -> bool {
        self.slots.shift() != [0.0; 6] || self.slots.turn() != super::Frame::NONE || self.stored.holds()
    }
}
