//! Modes as blocks ask for them. Each is reported once, where the text first relies on it.
//!
//! Not here: what is known of them (`siemens_state`).

use ncc_ir::canon::{Distance, Fact, FeedMode, Plane, Units};
use ncc_ir::diag::{Fault, ModeName};
use ncc_ir::expr::num::Unit;
use ncc_ir::source::Span;

use super::lower::Lower;
use super::program::repeated_blocks::{DISTANCE, MOTION, PLANE, SCALED, UNITS};
use super::siemens_state::Motion;
use crate::batch::Batch;
use crate::common::known::Know;
use crate::common::modal_state::ModalState;
use crate::common::number::unit_of;
use crate::initial_modes::Asker;

impl Lower {
    /// The modes, and who asks for them.
    fn asker<'b>(&'b mut self, at: Span, out: &'b mut Batch) -> (&'b mut ModalState<Motion>, Asker<'b>) {
        let (assume, dialect) = (self.assume, self.settings.dialect);
        (&mut self.state.modes, Asker { inherited: &mut self.inherited, dialect, assume, at, out })
    }

    pub(super) fn distance(&mut self, at: Span, out: &mut Batch) -> Fact<Distance> {
        self.repeated_blocks.use_fact(DISTANCE);
        let (modes, mut by) = self.asker(at, out);
        modes.ask_distance(&mut by)
    }

    pub(super) fn units(&mut self, at: Span, out: &mut Batch) -> Fact<Units> {
        self.repeated_blocks.use_fact(UNITS);
        let (modes, mut by) = self.asker(at, out);
        let (units, taken) = modes.ask_units(&mut by);
        if let Some(taken) = taken {
            self.only_units.see(taken);
        }
        units
    }

    pub(super) fn plane(&mut self, at: Span, out: &mut Batch) -> Fact<Plane> {
        self.repeated_blocks.use_fact(PLANE);
        let (modes, mut by) = self.asker(at, out);
        let (plane, taken) = modes.ask_plane(&mut by);
        if let Some(taken) = taken {
            self.only_plane.see(taken);
        }
        plane
    }

    /// The plane where it must be known: in a subprogram, the only one of the text.
    pub(super) fn known_plane(&mut self, at: Span, out: &mut Batch) -> Option<Plane> {
        let plane = self.plane(at, out).known().or_else(|| self.only_plane.rely(None, at));
        plane.or_else(|| self.refuse(Fault::EntryFactNeeded { fact: ModeName::Plane }, at, out))
    }

    /// The units where they must be known: in a subprogram, the only ones of the text.
    pub(super) fn known_units(&mut self, at: Span, out: &mut Batch) -> Option<Units> {
        let units = self.units(at, out).known().or_else(|| self.only_units.rely(None, at));
        units.or_else(|| self.refuse(Fault::EntryFactNeeded { fact: ModeName::Units }, at, out))
    }

    /// The unit of a feed. Under G70 and G71 it is that of the machine's basic system.
    pub(super) fn feed_unit(&mut self, at: Span, out: &mut Batch) -> Option<Unit> {
        self.repeated_blocks.use_fact(SCALED);
        if !matches!(self.state.scaled, Know::Lost | Know::Open | Know::Callers) {
            self.rely_on_scaled(at);
        }
        let scaled = match self.state.scaled {
            Know::Said(scaled) | Know::Taken(scaled) => scaled,
            Know::Unsaid => false,
            Know::Lost | Know::Open | Know::Callers => match self.only_scaled.rely(Some(false), at) {
                Some(scaled) => scaled,
                None => return self.refuse(Fault::EntryFactNeeded { fact: ModeName::Units }, at, out),
            },
        };
        if scaled {
            return Some(unit_of(self.units(at, out)));
        }
        let basic = self.settings.get("feed_unit") == "inch";
        let unit = if basic { Units::Inch } else { Units::Mm };
        if matches!(self.state.modes.units, Know::Lost | Know::Callers)
            && self.only_units.rely(None, at) == Some(unit)
        {
            // The only units of the text are those of the basic system.
            return Some(Unit::Entry);
        }
        if self.state.modes.units == Know::Said(if basic { Units::Mm } else { Units::Inch }) {
            self.option("feed_unit", at, out);
        }
        Some(unit_of(Fact::Known(unit)))
    }

    /// A feed relies on what it counts.
    pub(super) fn rely_on_feed_mode(&mut self, at: Span, out: &mut Batch) {
        let (modes, mut by) = self.asker(at, out);
        modes.ask_feed_mode(&mut by);
    }

    /// A move at feed relies on a feed.
    pub(super) fn rely_on_feed(&mut self, at: Span, out: &mut Batch) {
        if self.state.modes.feed == Know::Unsaid && !self.watch {
            if self.sub.is_some() {
                return self.fault(Fault::NoFeed, at, out);
            }
            // The end of the text says whether it has a caller, which has stated a feed.
            self.callers_feed = Some(at);
            self.state.modes.feed = Know::Callers;
        }
        // A time counts for one move.
        self.state.spent |= self.state.modes.feed_mode.value() == Some(FeedMode::InverseTime);
    }

    /// A move relies on the frames between machine and program, and along Z on the tool's length.
    pub(super) fn rely_on_frames(&mut self, with_z: bool, at: Span, out: &mut Batch) {
        self.no_stale_offset(at, out);
        let (modes, mut by) = self.asker(at, out);
        modes.ask_work_offset(&mut by);
        modes.ask_no_shift(&mut by);
        if !with_z {
            return;
        }
        if self.assume
            && let Some(change) = self.state.implied_edge.take()
        {
            self.option("edge_after_change", change, out);
        }
        let (modes, mut by) = self.asker(at, out);
        modes.ask_length(&mut by);
    }

    /// What bare axis words do: `None` if that is only known when the program runs.
    ///
    /// # Errors
    /// The program has not said it, and nothing may be assumed (reported).
    pub(super) fn motion(&mut self, at: Span, out: &mut Batch) -> Result<Option<Motion>, ()> {
        self.repeated_blocks.use_fact(MOTION);
        let (modes, mut by) = self.asker(at, out);
        let motion = modes.ask_motion(&mut by);
        self.now.failed |= motion.is_err();
        motion
    }

    /// The value of an option that decides here; reported once if nobody chose it.
    pub(super) fn option(&mut self, name: &'static str, at: Span, out: &mut Batch) -> &str {
        if self.assume && !self.settings.is_chosen(name) && self.reported.insert(name.into()) {
            let value = self.settings.get(name).into();
            out.report(Fault::AssumedOption { option: name.into(), value }, at);
        }
        self.settings.get(name)
    }
}
