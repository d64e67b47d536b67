//! Slots of the coordinate chain, followed in program coordinates.

use super::Tracker;
use super::shifted::Shifted;
use crate::canon::AXES;
use crate::expr::num::Nanos;
use crate::program::{Frame, FrameSlot, FrameStep, Slot};

impl Tracker {
    /// No G92 shift is active any more: from where coordinates count then, no program knows.
    pub(super) fn end_origin_shift(&mut self) {
        if self.modes.no_origin_shift != Some(true) {
            self.modes.no_origin_shift = Some(true);
            self.position = [None; AXES];
        }
    }

    /// Empties a slot of the coordinate chain.
    pub(super) fn clear_frame(&mut self, slot: FrameSlot) {
        if let Some(turning) = turning(slot) {
            self.turning[turning] = false;
        }
        match slot {
            FrameSlot::Local => {
                self.shift_locally(&[Some(Some(0)); AXES]);
            }
            FrameSlot::Tilt => {
                if self.tilted {
                    self.position[..3].fill(None);
                }
                self.tilted = false;
            }
            FrameSlot::Chain if self.chained => {
                self.move_origin(|_| Some(Some(0)), false);
                self.chained = false;
                self.framed = self.turned;
            }
            FrameSlot::Rotation | FrameSlot::Scale | FrameSlot::Mirror if self.turned => {
                // Whatever else turns is still active.
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
                let to = std::array::from_fn(|i| axes[i].as_ref().map(|word| self.nanos(word)));
                self.shift_locally(&to);
            }
            Slot::Shift { origin: true, axes } => {
                // The first shift is all that there is of it.
                let first = self.modes.no_origin_shift == Some(true);
                self.modes.no_origin_shift = None;
                for (axis, word) in axes.iter().enumerate() {
                    let Some(word) = word else { continue };
                    let by = self.nanos(word).filter(|_| first);
                    let at = self.position[axis].zip(by).and_then(|(at, by)| at.checked_sub(by));
                    self.position[axis] = at;
                }
                if self.turned || self.chain_turned {
                    self.position = [None; AXES];
                }
            }
            Slot::Tilt(_) => {
                self.position[..3].fill(None);
                self.tilted = true;
            }
            Slot::Rotation { .. } | Slot::Scale { .. } | Slot::Mirror(_) | Slot::NoMirror(_) => {
                let own = match slot {
                    Slot::Rotation { .. } => FrameSlot::Rotation,
                    Slot::Scale { .. } => FrameSlot::Scale,
                    _ => FrameSlot::Mirror,
                };
                if let Some(turning) = turning(own) {
                    self.turning[turning] = true;
                }
                self.position = [None; AXES];
                self.turned = true;
                self.framed = true;
            }
        }
    }

    /// Another local shift of the axes that are named, as far as it is known: where they stand is counted from there.
    fn shift_locally(&mut self, to: &[Option<Option<Nanos>>; AXES]) {
        for (axis, to) in to.iter().enumerate() {
            if let Some(to) = to {
                let by = self.local.to(axis, *to);
                self.position[axis] = self.position[axis].zip(by).and_then(|(at, by)| at.checked_sub(by));
            }
        }
        if self.turned || self.chain_turned {
            self.position = [None; AXES];
        }
    }

    /// A step of the chain.
    pub(super) fn set_frame(&mut self, frame: &Frame) {
        match &frame.step {
            FrameStep::Translate(words) => {
                let words: [_; AXES] =
                    std::array::from_fn(|axis| words[axis].as_ref().map(|word| self.nanos(word)));
                self.move_origin(|axis| words[axis].or(Some(Some(0)).filter(|_| !frame.added)), frame.added);
            }
            FrameStep::Rotate { .. } | FrameStep::Scale(_) | FrameStep::Mirror(_) => {
                if !frame.added {
                    self.chain = Shifted::default();
                }
                self.position = [None; AXES];
                self.chain_turned = true;
            }
        }
    }

    /// The chain is a translation of the axes that are named, or one is added to it.
    fn move_origin(&mut self, of: impl Fn(usize) -> Option<Option<Nanos>>, added: bool) {
        if self.turned || self.chain_turned {
            self.position = [None; AXES];
        }
        self.chain_turned &= added;
        for axis in 0..AXES {
            let Some(to) = of(axis) else { continue };
            let before = self.chain.at(axis).filter(|_| added);
            let to = if added { to.zip(before).and_then(|(to, before)| to.checked_add(before)) } else { to };
            let by = self.chain.to(axis, to);
            self.position[axis] = self.position[axis].zip(by).and_then(|(at, by)| at.checked_sub(by));
        }
    }
}

/// Which of the slots that turn, scale or mirror it is.
const fn turning(slot: FrameSlot) -> Option<usize> {
    match slot {
        FrameSlot::Rotation => Some(0),
        FrameSlot::Scale => Some(1),
        FrameSlot::Mirror => Some(2),
        FrameSlot::Local | FrameSlot::Shift | FrameSlot::Tilt | FrameSlot::Polar | FrameSlot::Chain => None,
    }
}
