//! What a program has said so far: modal facts, the cycle in force, and what was taken for granted.
//!
//! A fact that the program never said is taken from the dictionary's state at power-on if the
//! source is a user's, and stays open if it is not. After a call, and after a block that a switch
//! may skip, a fact is lost: what is in force then is only known when the program runs.
//!
//! Not here: what a control has in force at run time; that is execution's.

use ncc_dialects::CodeRow;
use ncc_ir::canon::{Distance, Fact, FeedMode, Motion, Plane, ReturnLevel, Units};
use ncc_ir::diag::{Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Num;
use ncc_ir::program::cycle::CycleKind;
use ncc_ir::program::{CentreFrom, Coord};
use ncc_ir::source::Span;

use super::lower::Lower;
use super::moves::polar::Words;
use crate::Batch;
use crate::begins::{self, Unsaid, report, take};
use crate::common::known::Know;

/// Whose the numbers are that a control keeps of a shift of the origin, to take it up again.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Kept {
    /// Some may be an earlier program's.
    #[default]
    Unknown,
    /// This program's, and the shift in force has them.
    InForce,
    /// This program's, and the shift may be suspended.
    Suspended,
}

impl Kept {
    /// After the shift has been taken up again, or suspended.
    pub(super) fn used(self, on: bool) -> Kept {
        match (self, on) {
            (Kept::Unknown, _) => Kept::Unknown,
            (_, true) => Kept::InForce,
            (_, false) => Kept::Suspended,
        }
    }

    /// After some axes got a shift by their words: what is kept then of the others while the shift is
    /// suspended, no source tells.
    pub(super) fn stated(self) -> Kept {
        match self {
            Kept::InForce => Kept::InForce,
            Kept::Unknown | Kept::Suspended => Kept::Unknown,
        }
    }

    /// After a block that may have been skipped; `before` is what was before it.
    fn join(&mut self, before: Kept) {
        *self = match (*self, before) {
            (Kept::Unknown, _) | (_, Kept::Unknown) => Kept::Unknown,
            (Kept::InForce, Kept::InForce) => Kept::InForce,
            (Kept::Suspended, _) | (_, Kept::Suspended) => Kept::Suspended,
        };
    }
}

/// A cycle in force, with the words that stay in force with it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Active {
    /// Index of its row among the dictionary's cycles.
    pub(super) row: usize,
    pub(super) plane: Fact<Plane>,
    pub(super) retract: Coord,
    pub(super) depth: Coord,
    pub(super) kind: CycleKind,
    pub(super) dwell: Option<Num>,
    pub(super) peck: Option<Expr>,
    /// Of pecks that decrease: the first, how much less each further one is, and the least.
    pub(super) shrinking: Option<[Num; 3]>,
    /// Feed of the cycle's own block.
    pub(super) feed: Option<Num>,
    /// Level of return and retract plane with which it was called up last, on a control whose initial level is where the
    /// tool stands before each block.
    pub(super) called: Option<(Fact<ReturnLevel>, Coord)>,
}

/// Whether a cycle is in force.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) enum InForce {
    #[default]
    None,
    Active(Box<Active>),
    /// Only known when the program runs.
    Lost,
}

/// All that a block's meaning depends on.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct State {
    pub(super) units: Know<Units>,
    pub(super) distance: Know<Distance>,
    pub(super) plane: Know<Plane>,
    pub(super) feed_mode: Know<FeedMode>,
    pub(super) return_level: Know<ReturnLevel>,
    /// A return level was said while it was not known whether a cycle is in force.
    pub(super) level_changed: bool,
    pub(super) work_offset: Know<u16>,
    /// Whether any length offset was said.
    pub(super) length_offset: Know<()>,
    /// The entry of the table of lengths that was named last.
    pub(super) length_entry: Know<u32>,
    pub(super) no_shift: Know<bool>,
    pub(super) shift_kept: Kept,
    /// What bare axis words do outside cycles.
    pub(super) motion: Know<Motion>,
    /// A cycle has ended without a motion code: whether the motion before it is in force again is
    /// the control's way.
    pub(super) after_cycle: bool,
    /// No motion is in force: the end of a cycle has taken it away.
    pub(super) no_motion: bool,
    /// From where the words of a centre are measured.
    pub(super) centre: Know<CentreFrom>,
    /// What the program has said of that on every way to here, whatever other programs and bodies of structures that
    /// it has come through may have said since.
    pub(super) centre_before: Option<CentreFrom>,
    /// Whether a feed was said.
    pub(super) feed: Know<()>,
    /// Whether a tool was selected, and by which number, where that is a literal.
    pub(super) tool: Know<Option<u32>>,
    pub(super) cycle: InForce,
    /// The code by which the next tapping cycle is a rigid one.
    pub(super) rigid: Option<Span>,
    /// Rotation, factors or a mirror that the program has in force, a bit each.
    pub(super) turned: u8,
    /// What the words of the plane's axes are.
    pub(super) words: Words,
    /// Whether the last thing that moved X or Y was a point by signs of radius and angle, away from the zero.
    pub(super) follows_polar: bool,
    /// Axes that the first move in a new rotation must name absolutely, a bit each.
    pub(super) unplaced: u8,
    /// Another length is in force, and no absolute Z was named since.
    pub(super) level_open: bool,
    /// A feed that was said in a cycle's block and that no hole has used yet.
    pub(super) cycle_feed: Option<Num>,
    /// The dwell that some cycle has said, where it stays in force for others.
    pub(super) dwell_left: Know<Num>,
    /// The entry of the table of radii that was named last.
    pub(super) radius_entry: Know<Expr>,
    /// Whether cutter radius compensation is on.
    pub(super) compensated: Know<bool>,
    /// The code of the thread that bare axis words cut on.
    pub(super) thread: Option<&'static CodeRow>,
    /// The lead that the feed word has said for it.
    pub(super) lead: Option<Num>,
    /// Whether points are those of the tool's tip.
    pub(super) tip: Know<bool>,
    /// Whether points are those of a tilted plane.
    pub(super) tilt: Know<bool>,
}

impl State {
    /// Nothing is known, and nothing is to be taken for granted: a subprogram, after a call.
    pub(super) fn lost() -> State {
        State {
            units: Know::Lost,
            distance: Know::Lost,
            plane: Know::Lost,
            feed_mode: Know::Lost,
            return_level: Know::Lost,
            work_offset: Know::Lost,
            length_offset: Know::Lost,
            length_entry: Know::Lost,
            no_shift: Know::Lost,
            shift_kept: Kept::Unknown,
            motion: Know::Lost,
            after_cycle: false,
            no_motion: false,
            centre: Know::Lost,
            centre_before: None,
            feed: Know::Lost,
            tool: Know::Lost,
            cycle: InForce::Lost,
            rigid: None,
            level_changed: false,
            turned: 0,
            words: Words::Cartesian,
            follows_polar: false,
            unplaced: 0,
            level_open: false,
            cycle_feed: None,
            dwell_left: Know::Lost,
            radius_entry: Know::Lost,
            compensated: Know::Lost,
            thread: None,
            lead: None,
            tip: Know::Lost,
            tilt: Know::Lost,
        }
    }

    /// A subprogram begins: what its caller leaves is in force.
    pub(super) fn called() -> State {
        State {
            units: Know::Callers,
            distance: Know::Callers,
            plane: Know::Callers,
            feed_mode: Know::Callers,
            return_level: Know::Callers,
            work_offset: Know::Callers,
            length_offset: Know::Callers,
            no_shift: Know::Callers,
            ..State::lost()
        }
    }

    /// Which modes the text has not said so far.
    pub(super) fn unsaid(&self) -> Unsaid {
        Unsaid(0)
            .with(ModeName::Distance, self.distance)
            .with(ModeName::Units, self.units)
            .with(ModeName::Plane, self.plane)
            .with(ModeName::FeedMode, self.feed_mode)
            .with(ModeName::ReturnLevel, self.return_level)
            .with(ModeName::WorkOffset, self.work_offset)
            .with(ModeName::LengthOffset, self.length_offset)
            .with(ModeName::OriginShift, self.no_shift)
    }

    /// Control comes here on another way as well, on which these modes have not been said.
    pub(super) fn comes_with(&mut self, unsaid: Unsaid, in_sub: bool) {
        unsaid.open(ModeName::Distance, &mut self.distance, in_sub);
        unsaid.open(ModeName::Units, &mut self.units, in_sub);
        unsaid.open(ModeName::Plane, &mut self.plane, in_sub);
        unsaid.open(ModeName::FeedMode, &mut self.feed_mode, in_sub);
        unsaid.open(ModeName::ReturnLevel, &mut self.return_level, in_sub);
        unsaid.open(ModeName::WorkOffset, &mut self.work_offset, in_sub);
        unsaid.open(ModeName::LengthOffset, &mut self.length_offset, in_sub);
        unsaid.open(ModeName::OriginShift, &mut self.no_shift, in_sub);
    }

    /// What is known where control may come from elsewhere, too.
    pub(super) fn met(&self) -> State {
        State {
            units: self.units.lost(),
            distance: self.distance.lost(),
            plane: self.plane.lost(),
            feed_mode: self.feed_mode.lost(),
            return_level: self.return_level.lost(),
            work_offset: self.work_offset.lost(),
            length_offset: self.length_offset.lost(),
            length_entry: self.length_entry.lost(),
            radius_entry: self.radius_entry.clone().lost(),
            ..State::lost()
        }
    }

    /// A length is taken up with the next Z.
    pub(super) fn length_open(&mut self) {
        (self.length_offset, self.level_open) = (Know::Said(()), true);
    }

    /// What is known after a block that may have been skipped.
    pub(super) fn join(&mut self, before: &State) {
        self.units.join(before.units);
        self.distance.join(before.distance);
        self.plane.join(before.plane);
        self.feed_mode.join(before.feed_mode);
        self.return_level.join(before.return_level);
        self.work_offset.join(before.work_offset);
        self.length_offset.join(before.length_offset);
        self.length_entry.join(before.length_entry);
        self.no_shift.join(before.no_shift);
        self.shift_kept.join(before.shift_kept);
        self.motion.join(before.motion);
        self.feed.join(before.feed);
        self.tool.join(before.tool);
        self.after_cycle |= before.after_cycle;
        self.centre.join(before.centre);
        self.centre_before = self.centre_before.filter(|from| before.centre_before == Some(*from));
        if self.no_motion != before.no_motion {
            self.no_motion = false;
            self.motion = Know::Lost;
        }
        self.turned |= before.turned;
        self.unplaced |= before.unplaced;
        self.words.join(before.words);
        self.follows_polar &= before.follows_polar;
        self.level_open |= before.level_open;
        self.level_changed |= before.level_changed;
        if self.cycle != before.cycle {
            self.cycle = InForce::Lost;
        }
        if self.rigid != before.rigid {
            // A block that may be skipped decides: which cycle it is, is not known.
            self.rigid = None;
            self.cycle = InForce::Lost;
        }
        self.cycle_feed = self.cycle_feed.or(before.cycle_feed);
        self.dwell_left.join(before.dwell_left);
        self.radius_entry.join(before.radius_entry.clone());
        self.compensated.join(before.compensated);
        if self.thread != before.thread {
            (self.thread, self.motion) = (None, Know::Lost);
        }
        self.lead = self.lead.filter(|_| self.lead == before.lead);
        self.tip.join(before.tip);
        self.tilt.join(before.tilt);
    }
}

/// Facts as they are asked for. Each is reported once, where the program first relies on it.
impl Lower {
    pub(super) fn distance(&mut self, at: Span, out: &mut Batch) -> Fact<Distance> {
        self.inherited.rely(&self.state.distance, ModeName::Distance, at);
        if self.assume && self.state.distance.unsaid() {
            begins::distance(&mut self.state.distance, &self.settings.dialect.power_on, at, out);
        }
        self.state.distance.fact()
    }

    pub(super) fn units(&mut self, at: Span, out: &mut Batch) -> Fact<Units> {
        self.inherited.rely(&self.state.units, ModeName::Units, at);
        if self.assume && self.state.units.unsaid() {
            begins::units(&mut self.state.units, &self.settings.dialect.power_on, at, out);
            // Behind this place others may be in force, if the text says others.
            if let Some(units) = out.assumed.units {
                self.see_units(units, out);
            }
        }
        self.state.units.fact()
    }

    pub(super) fn plane(&mut self, at: Span, out: &mut Batch) -> Fact<Plane> {
        self.inherited.rely(&self.state.plane, ModeName::Plane, at);
        if self.assume && self.state.plane.unsaid() {
            begins::plane(&mut self.state.plane, &self.settings.dialect.power_on, at, out);
        }
        self.state.plane.fact()
    }

    /// A feed word relies on what it counts.
    pub(super) fn rely_on_feed_mode(&mut self, at: Span, out: &mut Batch) {
        self.inherited.rely(&self.state.feed_mode, ModeName::FeedMode, at);
        if self.assume && self.state.feed_mode.unsaid() {
            begins::feed_mode(&mut self.state.feed_mode, &self.settings.dialect.power_on, at, out);
        }
    }

    pub(super) fn return_level(&mut self, at: Span, out: &mut Batch) -> Fact<ReturnLevel> {
        if let Some(level) = self.settings.dialect.cycles.return_level {
            return Fact::Known(level.into());
        }
        self.inherited.rely(&self.state.return_level, ModeName::ReturnLevel, at);
        if self.assume && self.state.return_level.unsaid() {
            begins::return_level(&mut self.state.return_level, &self.settings.dialect.power_on, at, out);
        }
        self.state.return_level.fact()
    }

    /// A move relies on the frames between machine and program, and with the drilling axis on the
    /// length offset.
    pub(super) fn rely_on_frames(&mut self, with_z: bool, at: Span, out: &mut Batch) {
        self.inherited.rely(&self.state.work_offset, ModeName::WorkOffset, at);
        self.inherited.rely(&self.state.no_shift, ModeName::OriginShift, at);
        if with_z {
            self.inherited.rely(&self.state.length_offset, ModeName::LengthOffset, at);
        }
        if !self.assume {
            return;
        }
        let dialect = self.settings.dialect;
        if self.state.work_offset.unsaid() {
            begins::work_offset(&mut self.state.work_offset, dialect, at, out);
        }
        if self.state.no_shift == Know::Unsaid {
            begins::no_shift(&mut self.state.no_shift, &dialect.power_on, at, out);
        }
        if with_z
            && self.state.length_offset.unsaid()
            && begins::length_offset(&dialect.power_on, at, out).is_some()
        {
            self.state.length_offset.take(());
        }
    }

    /// A place that can be come to from elsewhere: no fact is known there. That the program began without a shift of
    /// the origin stays so, if it has not said one before; in a subprogram, if its callers have not.
    pub(super) fn lose(&mut self, at: Span, out: &mut Batch) {
        self.inherited.rely(&self.state.no_shift, ModeName::OriginShift, at);
        if self.assume && self.state.no_shift == Know::Unsaid {
            begins::no_shift(&mut self.state.no_shift, &self.settings.dialect.power_on, at, out);
        }
        self.lose_state(out);
    }

    /// Facts are lost where ways join; on one of them these modes have not been said.
    pub(in crate::word) fn join_ways(&mut self, unsaid: Unsaid, at: Span, out: &mut Batch) {
        self.lose(at, out);
        if self.assume {
            self.state.comes_with(unsaid, self.sub.is_some());
        }
    }

    /// What bare axis words do: `None` if that is only known when the program runs.
    ///
    /// # Errors
    /// The program has not said it, and nothing may be taken for granted.
    pub(super) fn motion(&mut self, at: Span, out: &mut Batch) -> Result<Option<Motion>, ()> {
        if self.state.no_motion {
            out.report(Fault::NoMotionMode, at);
            return Err(());
        }
        let power_on = &self.settings.dialect.power_on.motion;
        match self.state.motion {
            Know::Lost | Know::Open | Know::Callers => Ok(None),
            Know::Unsaid if !self.assume => Ok(None),
            Know::Unsaid => match take(&mut self.state.motion, &mut out.assumed.motion, power_on) {
                None if self.state.motion == Know::Unsaid => {
                    out.report(Fault::NoMotionMode, at);
                    Err(())
                }
                value => {
                    report(out, at, ModeName::Motion, value.map(motion_name));
                    Ok(self.state.motion.value())
                }
            },
            Know::Said(motion) | Know::Taken(motion) => {
                if self.state.after_cycle {
                    if !self.assume {
                        return Ok(None);
                    }
                    self.state.after_cycle = false;
                    if !std::mem::replace(&mut self.reported.after_cycle, true) {
                        report(out, at, ModeName::Motion, Some(motion_name(motion)));
                    }
                }
                Ok(Some(motion))
            }
        }
    }
}

fn motion_name(motion: Motion) -> &'static str {
    match motion {
        Motion::Traverse => "rapid",
        Motion::Feed => "line at feed",
        Motion::Arc(_) => "arc",
        Motion::Cycle => "cycle",
    }
}
