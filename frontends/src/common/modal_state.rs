//! The modes that both readers follow through a text: what is known of each where a block is read.
//!
//! ```text
//! G20 / /G21 / X1.    after the block that may be skipped, the units are `Know::Lost`
//! ```
//!
//! The tracker of ncc-ir cannot serve here: it executes statements and knows a mode or does not, and a reader, which has
//! no statement yet, must tell a mode that the text never says (taken from power-on and reported) from one that is lost.
//!
//! Not here: modes that one family alone has, which stand beside this in the state of its reader.

use ncc_ir::canon::{Distance, Fact, FeedMode, Motion, Plane, Units};
use ncc_ir::diag::{Fault, ModeName};

use super::known::Know;
use crate::initial_modes::{self, Asker, Inherited, Unsaid};

/// What is known of each mode; `M` is the family's motions. A mode is [`Know::Unsaid`] where the text has not said it
/// and nothing has relied on it, [`Know::Taken`] where its power-on value was relied on, and [`Know::Lost`] after a
/// block or a call that may or may not have said another value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ModalState<M> {
    /// Units of lengths and of the feed.
    pub(crate) units: Know<Units>,
    /// Whether coordinates are absolute or incremental.
    pub(crate) distance: Know<Distance>,
    pub(crate) plane: Know<Plane>,
    /// What a feed counts: per minute, per revolution, inverse time.
    pub(crate) feed_mode: Know<FeedMode>,
    /// What bare axis words do, outside cycles.
    pub(crate) motion: Know<M>,
    /// Number of the work offset: 1 for the first (G54), 0 for none.
    pub(crate) work_offset: Know<u16>,
    /// Whether a tool length offset may be active; `false` where it is cancelled.
    pub(crate) length: Know<bool>,
    /// Whether no G92 shift is active.
    pub(crate) no_shift: Know<bool>,
    /// Whether the text has said a feed.
    pub(crate) feed: Know<()>,
    /// Whether the text has selected a tool, and its number; `None` for one that is computed or not followed.
    pub(crate) tool: Know<Option<u32>>,
    /// Whether points are in a tilted plane.
    pub(crate) tilt: Know<bool>,
}

/// Every mode in one state of knowledge.
macro_rules! all_modes {
    ($know:expr) => {
        ModalState {
            units: $know,
            distance: $know,
            plane: $know,
            feed_mode: $know,
            motion: $know,
            work_offset: $know,
            length: $know,
            no_shift: $know,
            feed: $know,
            tool: $know,
            tilt: $know,
        }
    };
}

impl<M> Default for ModalState<M> {
    fn default() -> ModalState<M> {
        all_modes!(Know::Unsaid)
    }
}

impl<M: Copy + PartialEq> ModalState<M> {
    /// Nothing is known, and nothing is taken from power-on.
    pub(crate) fn lost() -> ModalState<M> {
        all_modes!(Know::Lost)
    }

    /// A subprogram begins: its modes are its caller's.
    pub(crate) fn called() -> ModalState<M> {
        ModalState {
            units: Know::Callers,
            distance: Know::Callers,
            plane: Know::Callers,
            feed_mode: Know::Callers,
            work_offset: Know::Callers,
            length: Know::Callers,
            no_shift: Know::Callers,
            ..ModalState::lost()
        }
    }

    /// After a call, or where control may come from elsewhere: a mode that the text has not said is as the program
    /// began on one path.
    pub(crate) fn at_merge(&self) -> ModalState<M> {
        ModalState {
            units: self.units.lost(),
            distance: self.distance.lost(),
            plane: self.plane.lost(),
            feed_mode: self.feed_mode.lost(),
            work_offset: self.work_offset.lost(),
            length: self.length.lost(),
            no_shift: self.no_shift.lost(),
            ..ModalState::lost()
        }
    }

    /// Which modes the text has not stated so far.
    pub(crate) fn unsaid(&self) -> Unsaid {
        Unsaid(0)
            .with(ModeName::Distance, self.distance)
            .with(ModeName::Units, self.units)
            .with(ModeName::Plane, self.plane)
            .with(ModeName::FeedMode, self.feed_mode)
            .with(ModeName::WorkOffset, self.work_offset)
            .with(ModeName::LengthOffset, self.length)
            .with(ModeName::OriginShift, self.no_shift)
    }

    /// Another path to this block has not said these modes.
    pub(crate) fn open(&mut self, unsaid: Unsaid, in_sub: bool) {
        unsaid.open(ModeName::Distance, &mut self.distance, in_sub);
        unsaid.open(ModeName::Units, &mut self.units, in_sub);
        unsaid.open(ModeName::Plane, &mut self.plane, in_sub);
        unsaid.open(ModeName::FeedMode, &mut self.feed_mode, in_sub);
        unsaid.open(ModeName::WorkOffset, &mut self.work_offset, in_sub);
        unsaid.open(ModeName::LengthOffset, &mut self.length, in_sub);
        unsaid.open(ModeName::OriginShift, &mut self.no_shift, in_sub);
    }

    /// After a block that may have been skipped; `before` is the state before it.
    pub(crate) fn join(&mut self, before: &ModalState<M>) {
        self.units.join(before.units);
        self.distance.join(before.distance);
        self.plane.join(before.plane);
        self.feed_mode.join(before.feed_mode);
        self.motion.join(before.motion);
        self.work_offset.join(before.work_offset);
        self.length.join(before.length);
        self.no_shift.join(before.no_shift);
        self.feed.join(before.feed);
        self.tool.join(before.tool);
        self.tilt.join(before.tilt);
    }

    /// After a refused block, which may have said a feed, a tool or a motion: none of them is reported as missing.
    pub(crate) fn forgive(&mut self) {
        self.feed.forgive();
        self.tool.forgive();
        self.motion.forgive();
    }

    /// Whether a straight move relies on a mode that nothing has said or asked for yet, the G92 shift apart.
    pub(crate) fn is_open_to_moves(&self) -> bool {
        self.distance.unsaid() || self.units.unsaid() || self.work_offset.unsaid() || self.length.unsaid()
    }

    /// Whether a move relies on a mode of its caller's for the first time, the tool's length apart.
    pub(crate) fn is_new_to_moves(&self, inherited: &Inherited) -> bool {
        !(inherited.has_noted(&self.distance, ModeName::Distance)
            && inherited.has_noted(&self.units, ModeName::Units)
            && inherited.has_noted(&self.work_offset, ModeName::WorkOffset)
            && inherited.has_noted(&self.no_shift, ModeName::OriginShift))
    }

    /// Whether a move along Z relies on the tool's length without anything to be noted.
    pub(crate) fn is_length_noted(&self, inherited: &Inherited) -> bool {
        inherited.has_noted(&self.length, ModeName::LengthOffset)
    }

    /// Whether a feed word relies on what it counts without anything to be reported of that, or noted.
    pub(crate) fn is_feed_mode_settled(&self, assume: bool, inherited: &Inherited) -> bool {
        !(assume && self.feed_mode.unsaid()) && inherited.has_noted(&self.feed_mode, ModeName::FeedMode)
    }

    pub(crate) fn ask_distance(&mut self, by: &mut Asker) -> Fact<Distance> {
        by.relies(&mut self.distance, ModeName::Distance, initial_modes::distance);
        self.distance.fact()
    }

    /// The units, and those of power-on where they are taken just now.
    pub(crate) fn ask_units(&mut self, by: &mut Asker) -> (Fact<Units>, Option<Units>) {
        let taken = by.relies(&mut self.units, ModeName::Units, initial_modes::units);
        (self.units.fact(), by.out.assumed.units.filter(|_| taken))
    }

    /// The plane, and that of power-on where it is taken just now.
    pub(crate) fn ask_plane(&mut self, by: &mut Asker) -> (Fact<Plane>, Option<Plane>) {
        let taken = by.relies(&mut self.plane, ModeName::Plane, initial_modes::plane);
        (self.plane.fact(), by.out.assumed.plane.filter(|_| taken))
    }

    pub(crate) fn ask_feed_mode(&mut self, by: &mut Asker) {
        by.relies(&mut self.feed_mode, ModeName::FeedMode, initial_modes::feed_mode);
    }

    pub(crate) fn ask_work_offset(&mut self, by: &mut Asker) {
        by.relies(&mut self.work_offset, ModeName::WorkOffset, initial_modes::work_offset);
    }

    pub(crate) fn ask_no_shift(&mut self, by: &mut Asker) {
        by.relies(&mut self.no_shift, ModeName::OriginShift, initial_modes::no_shift);
    }

    pub(crate) fn ask_length(&mut self, by: &mut Asker) {
        by.relies(&mut self.length, ModeName::LengthOffset, initial_modes::length_offset);
    }
}

impl<M: Copy + PartialEq + From<Motion>> ModalState<M> {
    /// What bare axis words do; `None` if that is only known when the program runs.
    ///
    /// # Errors
    /// The text has not said it, and power-on has no motion (reported).
    pub(crate) fn ask_motion(&mut self, by: &mut Asker) -> Result<Option<M>, ()> {
        if self.motion == Know::Unsaid && by.assume {
            let Some(row) = &by.dialect.power_on.motion else {
                by.out.report(Fault::NoMotionMode, by.at);
                return Err(());
            };
            let motion = Motion::from(row.value);
            self.motion = Know::Taken(motion.into());
            by.out.assumed.motion = Some(motion);
            let name = initial_modes::motion_name(motion);
            initial_modes::report(by.out, by.at, ModeName::Motion, Some(name).filter(|_| !row.always));
        }
        Ok(self.motion.value())
    }
}
