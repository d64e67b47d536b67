//! What a program has said so far, as far as the meaning of a block depends on it, and what was
//! taken for granted.
//!
//! As in the word-address reader: a fact that was never said is taken from the dictionary's state at
//! power-on if the source is a user's, and stays open if it is not; after a call, and after a block
//! that a switch may skip, it is lost.
//!
//! Not here: what repeated blocks and subprograms find in force (`again`).

use ncc_dialects::Thread;
use ncc_ir::canon::{AXES, Distance, Fact, FeedMode, Plane, Turn, Units};
use ncc_ir::diag::{Fault, ModeName};
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::cycle::Cycle;
use ncc_ir::source::Span;

use super::lower::Lower;
use super::moves::polar::Pole;
use super::values::formula::Typed;
use crate::Batch;
use crate::begins::{self, Unsaid, report};
use crate::common::known::Know;
use crate::common::number::unit_of;

/// What axis words do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Motion {
    Traverse,
    Feed,
    Arc(Turn),
    /// `CIP`
    Through,
    /// `CT`
    Tangent,
    /// `G33`, `G331`, `G332`
    Thread(Thread),
}

impl From<ncc_ir::canon::Motion> for Motion {
    /// A state at power-on: only lines.
    fn from(motion: ncc_ir::canon::Motion) -> Motion {
        match motion {
            ncc_ir::canon::Motion::Feed => Motion::Feed,
            ncc_ir::canon::Motion::Arc(turn) => Motion::Arc(turn),
            ncc_ir::canon::Motion::Traverse | ncc_ir::canon::Motion::Cycle => Motion::Traverse,
        }
    }
}

/// The cycle, or subprogram, that `MCALL` has put in force.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) enum InForce {
    #[default]
    None,
    Active(Box<Cycle>),
    /// A subprogram that is called where a block with motion ends.
    Subprogram(Box<AfterMove>),
    /// The caller's; one is in force.
    Inherited {
        /// Whether it has a feed of its own, or may have.
        own_feed: bool,
    },
    /// Whether one is in force is only known when the program runs.
    Lost {
        /// Whether it may have a feed of its own.
        own_feed: bool,
    },
    /// One that was refused: what follows from it is not blamed as well.
    Refused,
}

/// A subprogram that `MCALL` has called where each block with motion ends.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct AfterMove {
    /// Its name in the text.
    pub(super) name: Box<str>,
    /// What each call hands over; `None` where nothing is.
    pub(super) given: Vec<Option<Typed>>,
}

impl InForce {
    /// Whether a cycle may be in force that has a feed of its own.
    pub(super) fn own_feed(&self) -> bool {
        match self {
            InForce::None | InForce::Refused | InForce::Subprogram(_) => false,
            InForce::Active(cycle) => cycle.feed.is_some(),
            InForce::Inherited { own_feed } | InForce::Lost { own_feed } => *own_feed,
        }
    }
}

/// All that a block's meaning depends on.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct State {
    pub(super) units: Know<Units>,
    /// Whether F counts in these units as well; else in the basic system of the machine.
    pub(super) scaled: Know<bool>,
    pub(super) distance: Know<Distance>,
    pub(super) plane: Know<Plane>,
    pub(super) feed_mode: Know<FeedMode>,
    /// Whether a speed is a surface's.
    pub(super) surface: Know<bool>,
    pub(super) motion: Know<Motion>,
    pub(super) work_offset: Know<u16>,
    /// Whether a tool's length is in force.
    pub(super) length: Know<bool>,
    /// Where a tool was changed without naming an edge, which no move has relied on yet.
    pub(super) implied_edge: Option<Span>,
    pub(super) no_shift: Know<bool>,
    /// Whether a feed was said.
    pub(super) feed: Know<()>,
    /// Whether the way of counting has left no feed in force: a move without one is refused where it is executed.
    pub(super) spent: bool,
    /// Whether a tool was selected.
    pub(super) tool: Know<()>,
    pub(super) cycle: InForce,
    pub(super) pole: Pole,
    /// Whether points are those of a tilted plane.
    pub(super) tilt: Know<bool>,
    /// Axes that the frames in force may shift, turn, scale or mirror.
    pub(super) in_frame: [bool; AXES],
}

impl State {
    /// Nothing is known, and nothing is to be taken for granted: a subprogram, after a call. The
    /// cycle is not lost with it, see `again`.
    pub(super) fn lost(cycle: InForce) -> State {
        State {
            units: Know::Lost,
            scaled: Know::Lost,
            distance: Know::Lost,
            plane: Know::Lost,
            feed_mode: Know::Lost,
            surface: Know::Lost,
            motion: Know::Lost,
            work_offset: Know::Lost,
            length: Know::Lost,
            implied_edge: None,
            no_shift: Know::Lost,
            feed: Know::Lost,
            spent: false,
            tool: Know::Lost,
            cycle,
            pole: Pole::Lost,
            tilt: Know::Lost,
            in_frame: [true; AXES],
        }
    }

    /// A subprogram begins: what its caller leaves is in force.
    pub(super) fn called(cycle: InForce) -> State {
        State {
            units: Know::Callers,
            distance: Know::Callers,
            plane: Know::Callers,
            feed_mode: Know::Callers,
            work_offset: Know::Callers,
            length: Know::Callers,
            no_shift: Know::Callers,
            ..State::lost(cycle)
        }
    }

    /// Behind a call, what the text has not said is as the program began, or not.
    pub(super) fn behind_call(&self, cycle: InForce) -> State {
        State {
            units: self.units.lost(),
            distance: self.distance.lost(),
            plane: self.plane.lost(),
            feed_mode: self.feed_mode.lost(),
            work_offset: self.work_offset.lost(),
            length: self.length.lost(),
            no_shift: self.no_shift.lost(),
            ..State::lost(cycle)
        }
    }

    /// Which modes the text has not said so far.
    pub(super) fn unsaid(&self) -> Unsaid {
        Unsaid(0)
            .with(ModeName::Distance, self.distance)
            .with(ModeName::Units, self.units)
            .with(ModeName::Plane, self.plane)
            .with(ModeName::FeedMode, self.feed_mode)
            .with(ModeName::WorkOffset, self.work_offset)
            .with(ModeName::LengthOffset, self.length)
            .with(ModeName::OriginShift, self.no_shift)
    }

    /// What is known after a block that may have been skipped.
    pub(super) fn join(&mut self, before: &State) {
        self.units.join(before.units);
        self.scaled.join(before.scaled);
        self.distance.join(before.distance);
        self.plane.join(before.plane);
        self.feed_mode.join(before.feed_mode);
        self.surface.join(before.surface);
        self.motion.join(before.motion);
        self.work_offset.join(before.work_offset);
        self.length.join(before.length);
        self.implied_edge = self.implied_edge.or(before.implied_edge);
        self.no_shift.join(before.no_shift);
        self.feed.join(before.feed);
        self.spent &= before.spent;
        self.tool.join(before.tool);
        self.pole.join(before.pole);
        self.tilt.join(before.tilt);
        self.in_frame.iter_mut().zip(before.in_frame).for_each(|(axis, before)| *axis |= before);
        if self.cycle != before.cycle {
            self.cycle = InForce::Lost { own_feed: self.cycle.own_feed() || before.cycle.own_feed() };
        }
    }
}

/// The one value that a whole text says of a fact, for where the fact is lost.
#[derive(Clone, Copy, Debug)]
pub(super) struct Only<T> {
    value: Option<T>,
    mixed: bool,
    /// The first place that relied on there being one value.
    relied: Option<Span>,
}

impl<T> Default for Only<T> {
    fn default() -> Only<T> {
        Only { value: None, mixed: false, relied: None }
    }
}

impl<T: Copy + PartialEq> Only<T> {
    /// The text says it; gives a place that relied on another value.
    pub(super) fn see(&mut self, value: T) -> Option<Span> {
        if *self.value.get_or_insert(value) == value {
            return None;
        }
        self.mixed = true;
        self.relied.take()
    }

    /// Blocks may run under a value that the text does not say.
    pub(super) fn open(&mut self) {
        self.mixed = true;
    }

    /// The value, if there is only one; `otherwise` if the text has said none.
    pub(super) fn rely(&mut self, otherwise: Option<T>, at: Span) -> Option<T> {
        if self.mixed {
            return None;
        }
        let value = self.value.or(otherwise)?;
        // A later one that differs is found by it.
        self.value = Some(value);
        self.relied.get_or_insert(at);
        Some(value)
    }
}

/// Facts as they are asked for. Each is reported once, where the program first relies on it.
impl Lower {
    pub(super) fn distance(&mut self, at: Span, out: &mut Batch) -> Fact<Distance> {
        self.again.use_fact(crate::siemens::program::again::DISTANCE);
        self.inherited.rely(&self.state.distance, ModeName::Distance, at);
        if self.assume && self.state.distance.unsaid() {
            begins::distance(&mut self.state.distance, &self.settings.dialect.power_on, at, out);
        }
        self.state.distance.fact()
    }

    pub(super) fn units(&mut self, at: Span, out: &mut Batch) -> Fact<Units> {
        self.again.use_fact(crate::siemens::program::again::UNITS);
        self.inherited.rely(&self.state.units, ModeName::Units, at);
        if self.assume && self.state.units.unsaid() {
            begins::units(&mut self.state.units, &self.settings.dialect.power_on, at, out);
            if let Some(units) = out.assumed.units {
                self.only_units.see(units);
            }
        }
        self.state.units.fact()
    }

    pub(super) fn plane(&mut self, at: Span, out: &mut Batch) -> Fact<Plane> {
        self.again.use_fact(crate::siemens::program::again::PLANE);
        self.inherited.rely(&self.state.plane, ModeName::Plane, at);
        if self.assume && self.state.plane.unsaid() {
            begins::plane(&mut self.state.plane, &self.settings.dialect.power_on, at, out);
            if let Some(plane) = out.assumed.plane {
                self.only_plane.see(plane);
            }
        }
        self.state.plane.fact()
    }

    /// The plane where it must be known: in a subprogram, the only one of the text.
    pub(super) fn known_plane(&mut self, at: Span, out: &mut Batch) -> Option<Plane> {
        match self.plane(at, out) {
            Fact::Known(plane) => Some(plane),
            Fact::Entry => match self.only_plane.rely(None, at) {
                Some(plane) => Some(plane),
                None => self.refuse(Fault::EntryFactNeeded { fact: ModeName::Plane }, at, out),
            },
        }
    }

    /// The units where they must be known: in a subprogram, the only ones of the text.
    pub(super) fn known_units(&mut self, at: Span, out: &mut Batch) -> Option<Units> {
        match self.units(at, out) {
            Fact::Known(units) => Some(units),
            Fact::Entry => match self.only_units.rely(None, at) {
                Some(units) => Some(units),
                None => self.refuse(Fault::EntryFactNeeded { fact: ModeName::Units }, at, out),
            },
        }
    }

    /// The unit of a feed. Under G70 and G71 it is that of the machine's basic system.
    pub(super) fn feed_unit(&mut self, at: Span, out: &mut Batch) -> Option<Unit> {
        self.again.use_fact(crate::siemens::program::again::SCALED);
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
        if matches!(self.state.units, Know::Lost | Know::Callers)
            && self.only_units.rely(None, at) == Some(unit)
        {
            // The only units of the text are those of the basic system.
            return Some(Unit::Entry);
        }
        if self.state.units == Know::Said(if basic { Units::Mm } else { Units::Inch }) {
            self.option("feed_unit", at, out);
        }
        Some(unit_of(Fact::Known(unit)))
    }

    /// A feed relies on what it counts.
    pub(super) fn rely_on_feed_mode(&mut self, at: Span, out: &mut Batch) {
        self.inherited.rely(&self.state.feed_mode, ModeName::FeedMode, at);
        if self.assume && self.state.feed_mode.unsaid() {
            begins::feed_mode(&mut self.state.feed_mode, &self.settings.dialect.power_on, at, out);
        }
    }

    /// A move at feed relies on a feed.
    pub(super) fn rely_on_feed(&mut self, at: Span, out: &mut Batch) {
        if self.state.feed == Know::Unsaid && !self.watch {
            if self.sub.is_some() {
                return self.fault(Fault::NoFeed, at, out);
            }
            // The end of the text says whether it has a caller, which has stated a feed.
            self.callers_feed = Some(at);
            self.state.feed = Know::Callers;
        }
        // A time counts for one move.
        self.state.spent |= self.state.feed_mode.value() == Some(FeedMode::InverseTime);
    }

    /// A move relies on the frames between machine and program, and along Z on the tool's length.
    pub(super) fn rely_on_frames(&mut self, with_z: bool, at: Span, out: &mut Batch) {
        self.no_stale_offset(at, out);
        self.inherited.rely(&self.state.work_offset, ModeName::WorkOffset, at);
        self.inherited.rely(&self.state.no_shift, ModeName::OriginShift, at);
        if with_z {
            self.inherited.rely(&self.state.length, ModeName::LengthOffset, at);
        }
        if !self.assume {
            return;
        }
        let dialect = self.settings.dialect;
        if self.state.work_offset.unsaid() {
            begins::work_offset(&mut self.state.work_offset, dialect, at, out);
        }
        if self.state.no_shift.unsaid() {
            begins::no_shift(&mut self.state.no_shift, &dialect.power_on, at, out);
        }
        if !with_z {
            return;
        }
        if let Some(change) = self.state.implied_edge.take() {
            self.option("edge_after_change", change, out);
        }
        if self.state.length.unsaid()
            && let Some(entry) = begins::length_offset(&dialect.power_on, at, out)
        {
            self.state.length.take(entry != 0);
        }
    }

    /// What bare axis words do: `None` if that is only known when the program runs.
    ///
    /// # Errors
    /// The program has not said it, and nothing may be taken for granted (reported).
    pub(super) fn motion(&mut self, at: Span, out: &mut Batch) -> Result<Option<Motion>, ()> {
        self.again.use_fact(crate::siemens::program::again::MOTION);
        match self.state.motion {
            Know::Lost | Know::Open | Know::Callers => Ok(None),
            Know::Said(motion) | Know::Taken(motion) => Ok(Some(motion)),
            Know::Unsaid if !self.assume => Ok(None),
            Know::Unsaid => {
                let row = &self.settings.dialect.power_on.motion;
                let Some(row) = row else {
                    self.fault(Fault::NoMotionMode, at, out);
                    return Err(());
                };
                let value: ncc_ir::canon::Motion = row.value.into();
                out.assumed.motion = Some(value);
                let motion = Motion::from(value);
                self.state.motion = Know::Taken(motion);
                if !row.always {
                    let name = if motion == Motion::Traverse { "rapid" } else { "line at feed" };
                    report(out, at, ModeName::Motion, Some(name));
                }
                Ok(Some(motion))
            }
        }
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

/// Where the tool is known to stand in program coordinates, by the words that put it there.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Stand {
    pub(super) axes: [Option<Num>; 3],
}

impl Stand {
    /// After a move that is not followed.
    pub(super) fn forget(&mut self) {
        self.axes = [None; 3];
    }
}
