//! Modes as blocks ask for them. Each is reported once, where the text first relies on it.
//!
//! Not here: what is known of them (`word_state`), and what a control has active at run time; that is execution's.

use ncc_ir::canon::{Distance, Fact, Motion, Plane, ReturnLevel, Units};
use ncc_ir::diag::{Fault, ModeName};
use ncc_ir::source::Span;

use super::lower::Lower;
use crate::batch::Batch;
use crate::common::known::Know;
use crate::common::modal_state::ModalState;
use crate::initial_modes::{Asker, Unsaid, motion_name, report, return_level};

impl Lower {
    /// The modes, and who asks for them.
    fn asker<'b>(&'b mut self, at: Span, out: &'b mut Batch) -> (&'b mut ModalState<Motion>, Asker<'b>) {
        let (assume, dialect) = (self.assume, self.settings.dialect);
        (&mut self.state.modes, Asker { inherited: &mut self.inherited, dialect, assume, at, out })
    }

    pub(super) fn distance(&mut self, at: Span, out: &mut Batch) -> Fact<Distance> {
        let (modes, mut by) = self.asker(at, out);
        modes.ask_distance(&mut by)
    }

    pub(super) fn units(&mut self, at: Span, out: &mut Batch) -> Fact<Units> {
        let (modes, mut by) = self.asker(at, out);
        let (units, taken) = modes.ask_units(&mut by);
        // After this place others may be active, if the text says others.
        if let Some(taken) = taken {
            self.see_units(taken, out);
        }
        units
    }

    pub(super) fn plane(&mut self, at: Span, out: &mut Batch) -> Fact<Plane> {
        let (modes, mut by) = self.asker(at, out);
        modes.ask_plane(&mut by).0
    }

    /// A feed word relies on what it counts.
    pub(super) fn rely_on_feed_mode(&mut self, at: Span, out: &mut Batch) {
        let (modes, mut by) = self.asker(at, out);
        modes.ask_feed_mode(&mut by);
    }

    pub(super) fn return_level(&mut self, at: Span, out: &mut Batch) -> Fact<ReturnLevel> {
        if let Some(level) = self.settings.dialect.cycles.return_level {
            return Fact::Known(level.into());
        }
        let (assume, dialect) = (self.assume, self.settings.dialect);
        let mut by = Asker { inherited: &mut self.inherited, dialect, assume, at, out };
        by.relies(&mut self.state.return_level, ModeName::ReturnLevel, return_level);
        self.state.return_level.fact()
    }

    /// A move relies on the frames between machine and program, and with the drilling axis on the
    /// length offset.
    pub(super) fn rely_on_frames(&mut self, with_z: bool, at: Span, out: &mut Batch) {
        let (modes, mut by) = self.asker(at, out);
        modes.ask_work_offset(&mut by);
        self.rely_on_no_shift(at, out);
        if with_z {
            let (modes, mut by) = self.asker(at, out);
            modes.ask_length(&mut by);
        }
    }

    /// That the program began without a G92 shift stays so where the text has not said one before; in a
    /// subprogram, where its callers have not.
    fn rely_on_no_shift(&mut self, at: Span, out: &mut Batch) {
        let (modes, mut by) = self.asker(at, out);
        if modes.no_shift != Know::Open {
            modes.ask_no_shift(&mut by);
        }
    }

    /// A jump target: no mode is known there.
    pub(super) fn lose(&mut self, at: Span, out: &mut Batch) {
        self.rely_on_no_shift(at, out);
        self.lose_state(out);
    }

    /// Modes are lost where paths merge; one of the paths has not said these.
    pub(in crate::word) fn merge_paths(&mut self, unsaid: Unsaid, at: Span, out: &mut Batch) {
        self.lose(at, out);
        if self.assume {
            self.state.open(unsaid, self.sub.is_some());
        }
    }

    /// What bare axis words do: `None` if that is only known when the program runs.
    ///
    /// # Errors
    /// The program has not said it, and nothing may be assumed.
    pub(super) fn motion(&mut self, at: Span, out: &mut Batch) -> Result<Option<Motion>, ()> {
        if self.state.no_motion {
            out.report(Fault::NoMotionMode, at);
            return Err(());
        }
        if self.state.after_cycle
            && let Some(motion) = self.state.modes.motion.value()
        {
            if !self.assume {
                return Ok(None);
            }
            self.state.after_cycle = false;
            if !std::mem::replace(&mut self.reported.after_cycle, true) {
                report(out, at, ModeName::Motion, Some(motion_name(motion)));
            }
        }
        let (modes, mut by) = self.asker(at, out);
        modes.ask_motion(&mut by)
    }
}
