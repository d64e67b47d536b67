//! What the steps change of a translation beside the program, so that they can be done again.

use std::collections::BTreeSet;

use ncc_ir::canon::Modes;
use ncc_passes::Legaliser;
use ncc_passes::modes::side_effects::SideEffects;
use ncc_passes::tools::machine_numbers::Renumbering;

use super::translation::Translation;
use crate::job::Counted;

/// It, as it was.
pub(super) struct Snapshot {
    renumbering: Renumbering,
    side_effects: SideEffects,
    legaliser: Legaliser,
    given: Modes,
    numbers: BTreeSet<u32>,
    counted: Vec<Counted>,
    /// Of the diagnostics and of what rests on them, how many there were.
    reported: [usize; 2],
    errors: usize,
    refused: bool,
    computes: bool,
}

impl Snapshot {
    pub(super) fn of(now: &Translation) -> Snapshot {
        Snapshot {
            renumbering: now.renumbering.clone(),
            side_effects: now.side_effects.clone(),
            legaliser: now.legaliser.clone(),
            given: now.given,
            numbers: now.numbers.clone(),
            counted: now.counted.clone(),
            reported: [now.diagnostics.len(), now.rests.len()],
            errors: now.errors,
            refused: now.refused,
            computes: now.computes,
        }
    }

    /// How many diagnostics there were.
    pub(super) fn diagnostics(&self) -> usize {
        self.reported[0]
    }

    pub(super) fn restore(self, now: &mut Translation) {
        now.renumbering = self.renumbering;
        now.side_effects = self.side_effects;
        now.legaliser = self.legaliser;
        now.given = self.given;
        now.numbers = self.numbers;
        now.counted = self.counted;
        now.diagnostics.truncate(self.reported[0]);
        now.rests.truncate(self.reported[1]);
        (now.errors, now.refused, now.computes) = (self.errors, self.refused, self.computes);
    }
}
