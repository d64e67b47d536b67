//! Slots of the coordinate chain, followed in program coordinates.

use super::Tracker;
use crate::canon::AXES;
use crate::num::Nanos;
use crate::program::{FrameSlot, Slot};

impl Tracker {
    /// There is no shift of the origin any more: from where coordinates count then, no program knows.
    pub(super) fn end_origin_shift(&mut self) {
        if self.modes.no_origin_shift != Some(true) {
            self.modes.no_origin_shift = Some(true);
            self.position = [None; AXES];
        }
    }

    /// Empties a slot of the coordinate chain.
    pub(super) fn clear_frame(&mut self, slot: FrameSlot) {
        match slot {
            FrameSlot::Local => {
                self.shift_locally(&[Some(0); AXES]);
                self.local_lost = false;
            }
            FrameSlot::Tilt => {
                if self.tilted {
                    self.position[..3].fill(None);
                }
                self.tilted = false;
            }
            FrameSlot::Chain if self.chained => {
                self.position = [None; AXES];
                self.chained = false;
                self.framed = self.turned;
            }
            FrameSlot::Rotation | FrameSlot::Scale | FrameSlot::Mirror if self.turned => {
                // Whatever else turns is still in force.
                self.position = [None; AXES];
            }
            FrameSlot::Shift
            | FrameSlot::Rotation
            | FrameSlot::Scale
            | FrameSlot::Mirror
            | FrameSlot::Polar
            | FrameSlot::Chain => {}
        }
    }

    /// Fills a slot of the coordinate chain.
    pub(super) fn set_slot(&mut self, slot: &Slot) {
        match slot {
            Slot::Shift { origin: false, axes } => {
                let to = std::array::from_fn(|i| match &axes[i] {
                    None => Some(self.local[i]),
                    Some(word) => self.nanos(word),
                });
                self.shift_locally(&to);
            }
            Slot::Shift { origin: true, axes } => {
                self.modes.no_origin_shift = None;
                for (at, word) in self.position.iter_mut().zip(axes.iter()) {
                    if word.is_some() || self.turned {
                        *at = None;
                    }
                }
            }
            Slot::Tilt(_) => {
                self.position[..3].fill(None);
                self.tilted = true;
            }
            Slot::Rotation { .. } | Slot::Scale { .. } | Slot::Mirror(_) | Slot::NoMirror(_) => {
                self.position = [None; AXES];
                self.turned = true;
                self.framed = true;
            }
        }
    }

    /// Another local shift: where the axes stand is counted from there.
    fn shift_locally(&mut self, to: &[Option<Nanos>; AXES]) {
        let from = std::mem::replace(&mut self.local, to.map(Option::unwrap_or_default));
        let known = to.iter().all(Option::is_some);
        if self.turned || self.chained || self.local_lost || !known {
            self.position = [None; AXES];
            self.local_lost |= !known;
            return;
        }
        for (i, at) in self.position.iter_mut().enumerate() {
            let by = self.local[i].wrapping_sub(from[i]);
            *at = at.and_then(|at| at.checked_sub(by));
        }
    }
}
