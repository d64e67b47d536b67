//! What the text has said before the block that is read: its modes, the active cycle, and what else a block's meaning
//! depends on.
//!
//! A mode that the text never says is taken from power-on if the source is a user's, and stays open if it is not. After a
//! call, and after a block that a switch may skip, a mode is lost: its value is only known when the program runs.
//!
//! Not here: how modes are asked for and reported (`mode_queries`), and what the whole text says (`text_facts`).

use ncc_dialects::CodeRow;
use ncc_ir::canon::{Fact, Motion, Plane, ReturnLevel};
use ncc_ir::diag::ModeName;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Num;
use ncc_ir::program::cycle::CycleKind;
use ncc_ir::program::{CentreFrom, Coord};
use ncc_ir::source::Span;

use crate::common::known::Know;
use crate::common::modal_state::ModalState;
use crate::initial_modes::Unsaid;

/// Whose the numbers are that a control keeps of a G92 shift, to restore it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum KeptShift {
    /// Some may be an earlier program's.
    #[default]
    Unknown,
    /// This program's, and the active shift has them.
    Active,
    /// This program's, and the shift may be suspended.
    Suspended,
}

impl KeptShift {
    /// After the shift has been restored, or suspended.
    pub(super) fn used(self, on: bool) -> KeptShift {
        match (self, on) {
            (KeptShift::Unknown, _) => KeptShift::Unknown,
            (_, true) => KeptShift::Active,
            (_, false) => KeptShift::Suspended,
        }
    }

    /// After some axes got a shift by their words: what is kept then of the others while the shift is
    /// suspended, no source tells.
    pub(super) fn stated(self) -> KeptShift {
        match self {
            KeptShift::Active => KeptShift::Active,
            KeptShift::Unknown | KeptShift::Suspended => KeptShift::Unknown,
        }
    }

    /// After a block that may have been skipped; `before` is what was before it.
    fn join(&mut self, before: KeptShift) {
        *self = match (*self, before) {
            (KeptShift::Unknown, _) | (_, KeptShift::Unknown) => KeptShift::Unknown,
            (KeptShift::Active, KeptShift::Active) => KeptShift::Active,
            (KeptShift::Suspended, _) | (_, KeptShift::Suspended) => KeptShift::Suspended,
        };
    }
}

/// An active cycle, with the words that stay active with it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ActiveCycle {
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
    /// Return level and retract plane with which it was activated last, on a control whose initial level is where the tool is
    /// before each block.
    pub(super) called: Option<(Fact<ReturnLevel>, Coord)>,
}

/// Whether a cycle is active.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) enum CycleState {
    #[default]
    None,
    Active(Box<ActiveCycle>),
    /// Only known when the program runs.
    Lost,
}

/// All that a block's meaning depends on.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct WordState {
    pub(super) modes: ModalState<Motion>,
    pub(super) return_level: Know<ReturnLevel>,
    /// A return level was stated while it was not known whether a cycle is active.
    pub(super) level_changed: bool,
    /// The entry of the table of lengths that was named last.
    pub(super) length_entry: Know<u32>,
    pub(super) shift_kept: KeptShift,
    /// A cycle has ended without a motion code: whether the motion before it is active again is
    /// the control's way.
    pub(super) after_cycle: bool,
    /// No motion is active: the end of a cycle has taken it away.
    pub(super) no_motion: bool,
    /// From where the words of a centre are measured.
    pub(super) centre: Know<CentreFrom>,
    /// What the program has said of that on every path to here, whatever other programs and bodies of structures that
    /// it has come through may have said since.
    pub(super) centre_before: Option<CentreFrom>,
    pub(super) cycle: CycleState,
    /// The code by which the next tapping cycle is a rigid one.
    pub(super) rigid: Option<Span>,
    /// Rotation, factors or a mirror that the program has active, a bit each.
    pub(super) turned: u8,
    /// What the words of the plane's axes are.
    pub(super) words: AxisWords,
    /// Whether the last thing that moved X or Y was a point by signs of radius and angle, away from the zero.
    pub(super) follows_polar: bool,
    /// Axes that the first move in a new rotation must name absolutely, a bit each.
    pub(super) unplaced: u8,
    /// Another length is active, and no absolute Z was named since.
    pub(super) level_open: bool,
    /// A feed that was stated in a cycle's block and that no hole has used yet.
    pub(super) cycle_feed: Option<Num>,
    /// The dwell that some cycle has said, where it stays active for others.
    pub(super) dwell_left: Know<Num>,
    /// The entry of the table of radii that was named last.
    pub(super) radius_entry: Know<Expr>,
    /// Whether cutter radius compensation is on.
    pub(super) compensated: Know<bool>,
    /// The code of the thread that bare axis words cut on.
    pub(super) thread: Option<&'static CodeRow>,
    /// The lead that the feed word has said for it.
    pub(super) lead: Option<Num>,
    /// Whether points are those of the tool tip.
    pub(super) tip: Know<bool>,
}

impl WordState {
    /// Nothing is known, and nothing is taken from power-on: after a call.
    pub(super) fn lost() -> WordState {
        WordState {
            modes: ModalState::lost(),
            return_level: Know::Lost,
            length_entry: Know::Lost,
            centre: Know::Lost,
            cycle: CycleState::Lost,
            dwell_left: Know::Lost,
            radius_entry: Know::Lost,
            compensated: Know::Lost,
            tip: Know::Lost,
            ..WordState::default()
        }
    }

    /// A subprogram begins: its modes are its caller's.
    pub(super) fn called() -> WordState {
        WordState { modes: ModalState::called(), return_level: Know::Callers, ..WordState::lost() }
    }

    /// Which modes the text has not stated so far.
    pub(super) fn unsaid(&self) -> Unsaid {
        self.modes.unsaid().with(ModeName::ReturnLevel, self.return_level)
    }

    /// Another path to this block has not said these modes.
    pub(super) fn open(&mut self, unsaid: Unsaid, in_sub: bool) {
        self.modes.open(unsaid, in_sub);
        unsaid.open(ModeName::ReturnLevel, &mut self.return_level, in_sub);
    }

    /// Where control may come from elsewhere. Whether a G92 shift is active is asked for before.
    pub(super) fn at_merge(&self) -> WordState {
        WordState {
            modes: ModalState { no_shift: Know::Lost, ..self.modes.at_merge() },
            return_level: self.return_level.lost(),
            length_entry: self.length_entry.lost(),
            radius_entry: self.radius_entry.clone().lost(),
            ..WordState::lost()
        }
    }

    /// A length takes effect with the next Z.
    pub(super) fn length_open(&mut self, active: bool) {
        (self.modes.length, self.level_open) = (Know::Said(active), true);
    }

    /// What is known after a block that may have been skipped.
    pub(super) fn join(&mut self, before: &WordState) {
        self.modes.join(&before.modes);
        self.return_level.join(before.return_level);
        self.length_entry.join(before.length_entry);
        self.shift_kept.join(before.shift_kept);
        self.after_cycle |= before.after_cycle;
        self.centre.join(before.centre);
        self.centre_before = self.centre_before.filter(|from| before.centre_before == Some(*from));
        if self.no_motion != before.no_motion {
            self.no_motion = false;
            self.modes.motion = Know::Lost;
        }
        self.turned |= before.turned;
        self.unplaced |= before.unplaced;
        self.words.join(before.words);
        self.follows_polar &= before.follows_polar;
        self.level_open |= before.level_open;
        self.level_changed |= before.level_changed;
        if self.cycle != before.cycle {
            self.cycle = CycleState::Lost;
        }
        if self.rigid != before.rigid {
            // A block that may be skipped decides: which cycle it is, is not known.
            self.rigid = None;
            self.cycle = CycleState::Lost;
        }
        self.cycle_feed = self.cycle_feed.or(before.cycle_feed);
        self.dwell_left.join(before.dwell_left);
        self.radius_entry.join(before.radius_entry.clone());
        self.compensated.join(before.compensated);
        if self.thread != before.thread {
            (self.thread, self.modes.motion) = (None, Know::Lost);
        }
        self.lead = self.lead.filter(|_| self.lead == before.lead);
        self.tip.join(before.tip);
    }
}

/// What the words of the plane's axes are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum AxisWords {
    /// Coordinates.
    #[default]
    Cartesian,
    /// Radius and angle.
    Polar {
        plane: Plane,
        /// Whether the last thing that moved in the plane was a polar point.
        follows: bool,
    },
}

impl AxisWords {
    /// What is known after a block that may have been skipped.
    pub(super) fn join(&mut self, before: AxisWords) {
        if let (AxisWords::Polar { follows, .. }, AxisWords::Polar { follows: other, .. }) = (self, before) {
            *follows &= other;
        }
    }
}
