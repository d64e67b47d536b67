//! What a program leaves active at its end, and what its next run makes of that.
//!
//! Shifts and frames outlive a program on some controls and die with it on others. A program that moves by a slot
//! before it has filled it is another program when it runs again and the slot has been left full. So two runs in a row
//! need not be executed: it is enough to know by which slots the program moves as they were left, and what it leaves
//! in them.
//!
//! Not here: modes that outlive a program. What a program assumes of them is reported, and stated in the output.

use crate::frames::frame::Length;
use crate::{Exec, Frames};
use ncc_ir::behaviour::{Behaviour, Behaviours};
use ncc_ir::canon::{AXES, Modes, Units};
use ncc_ir::diag::ModeName;
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::program::{FrameSlot, Slot};
use ncc_ir::source::Span;

/// Bits of the axes of the local shift, of the G92 shift, and of whole slots.
const LOCAL: u32 = 0;
const ORIGIN: u32 = AXES as u32;
const TURN: u32 = 1 << (2 * AXES);
const CHAIN: u32 = 1 << (2 * AXES + 1);
const AXIS_BITS: u32 = (1 << AXES) - 1;

/// Slots at the start and at the end of a program.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outlived {
    /// Slots that the program has not filled or emptied yet.
    fresh: u32,
    /// Slots by which it has moved before it did.
    relied: u32,
    /// Where it filled a slot last.
    at: Option<Span>,
    /// Whether a code of the program has ended it.
    by_code: bool,
    /// The code that has it begin again, with all that is active.
    again: Option<Span>,
}

impl Default for Outlived {
    fn default() -> Self {
        Outlived { fresh: u32::MAX, relied: 0, at: None, by_code: false, again: None }
    }
}

/// Where program zero, and points along X, Y and Z, lie in a second run of a program before it says so itself: nanos of
/// a millimetre or a degree, as against its first run.
pub type Again = [[Nanos; AXES]; 4];

impl Exec {
    /// The program moves these axes (bits) to coordinates of its own.
    #[inline]
    pub(crate) fn relies_on_slots(&mut self, axes: u32) {
        self.outlived.relied |= self.outlived.fresh & (axes << LOCAL | axes << ORIGIN | TURN | CHAIN);
    }

    /// The program fills a slot itself.
    pub(crate) fn fills(&mut self, slot: &Slot, span: Span) {
        self.outlived.at = Some(span);
        let bits = match slot {
            Slot::Shift { origin, axes } => {
                let named = axes.iter().enumerate().filter(|(_, word)| word.is_some());
                let named = named.fold(0, |bits, (axis, _)| bits | 1 << axis);
                if *origin { named << ORIGIN } else { named << LOCAL }
            }
            Slot::Rotation { .. } | Slot::Scale { .. } | Slot::Mirror(_) | Slot::NoMirror(_) => TURN,
            Slot::Tilt(_) => 0,
        };
        self.outlived.fresh &= !bits;
    }

    /// The program gives these axes (bits) coordinates, or chains a frame.
    pub(crate) fn fills_shift(&mut self, axes: Option<u32>, span: Span) {
        self.outlived.at = Some(span);
        self.outlived.fresh &= !axes.map_or(CHAIN, |axes| axes << ORIGIN);
    }

    /// The program empties a slot itself.
    pub(crate) fn empties(&mut self, slot: FrameSlot) {
        self.outlived.fresh &= !match slot {
            FrameSlot::Shift => AXIS_BITS << ORIGIN,
            FrameSlot::Local => AXIS_BITS << LOCAL,
            FrameSlot::Rotation | FrameSlot::Scale | FrameSlot::Mirror => TURN,
            FrameSlot::Chain => CHAIN,
            FrameSlot::Polar | FrameSlot::Tilt => 0,
        };
    }

    /// A code of the program has ended it.
    pub(crate) fn ends_by_code(&mut self) {
        self.outlived.by_code = true;
    }

    /// The program begins again.
    pub(crate) fn begins_again(&mut self, at: Span) {
        (self.outlived.by_code, self.outlived.again) = (true, Some(at));
    }

    /// The first mode that the program assumes at its start (`assumed`), which is not active where it begins
    /// again, and where that is.
    pub fn begins_otherwise(&self, assumed: &Modes) -> Option<(ModeName, Span)> {
        let at = self.outlived.again?;
        let length = match self.waiting.unwrap_or(self.modes.length) {
            Length::Entry(entry) => Some(entry),
            _ => None,
        };
        fn apart<T: PartialEq>(assumed: Option<T>, now: Option<T>) -> bool {
            assumed.is_some() && assumed != now
        }
        let units = if self.modes.inch { Units::Inch } else { Units::Mm };
        let modes = &self.modes;
        [
            (ModeName::Motion, apart(assumed.motion, Some(modes.motion))),
            (ModeName::Distance, apart(assumed.distance, Some(modes.distance))),
            (ModeName::Units, apart(assumed.units, Some(units))),
            (ModeName::Plane, apart(assumed.plane, Some(modes.plane))),
            (ModeName::FeedMode, apart(assumed.feed_mode, Some(self.state.feed_mode))),
            (ModeName::ReturnLevel, apart(assumed.return_level, Some(modes.return_level))),
            (ModeName::WorkOffset, apart(assumed.work_offset, Some(modes.work_offset))),
            (ModeName::LengthOffset, apart(assumed.length_offset, length)),
        ]
        .into_iter()
        .find_map(|(mode, apart)| apart.then_some((mode, at)))
    }

    /// Where the program filled a slot last.
    pub fn filled_at(&self) -> Option<Span> {
        self.outlived.at
    }

    /// Whether the program has ended by a code of its own, having filled slots.
    pub fn leaves_slots(&self) -> bool {
        self.outlived.by_code && self.slots.is_some()
    }

    /// Where a second run of the ended program moves as against the first, before it fills the slots itself, on a
    /// control with these behaviours.
    pub fn again(&self, behaviours: &Behaviours) -> Again {
        let mut left = self.slots.as_deref().cloned().unwrap_or(Frames::NONE);
        let relied = |bit: u32| self.outlived.relied & bit != 0;
        let resets = |behaviour| behaviours.does(behaviour) && self.outlived.again.is_none();
        if !self.outlived.by_code {
            left = Frames::NONE;
        }
        for axis in 0..AXES {
            if resets(Behaviour::ShiftAtEnd) || !relied(1 << (LOCAL + axis as u32)) {
                left.local[axis] = 0;
            }
            if resets(Behaviour::OriginAtEnd) || !relied(1 << (ORIGIN + axis as u32)) {
                left.origin[axis] = None;
            }
        }
        if resets(Behaviour::RotationAtEnd) || !relied(TURN) {
            (left.rotation, left.scale, left.mirror) = (None, None, [None; 3]);
        }
        if resets(Behaviour::ShiftAtEnd) || !relied(CHAIN) {
            left.clear(FrameSlot::Chain);
        }
        let (chain, origin) = (left.chain(), left.origin);
        std::array::from_fn(|point| {
            let mut at = [0; AXES];
            if let Some(along) = point.checked_sub(1) {
                at[along] = 100 * ONE;
            }
            let placed = chain.place(&at);
            std::array::from_fn(|axis| placed[axis].saturating_add(origin[axis].unwrap_or(0)))
        })
    }
}
