//! What the text has said before the block that is read: its modes, what `MCALL` has made active, and what else a
//! block's meaning depends on.
//!
//! As in the reader of words: a mode that was never said is taken from power-on if the source is a user's, and stays open
//! if it is not; after a call, and after a block that a switch may skip, it is lost.
//!
//! Not here: how modes are asked for and reported (`mode_queries`), and what repeated blocks and subprograms find
//! (`repeated_blocks`).

use ncc_dialects::Thread;
use ncc_ir::canon::{AXES, Plane, Turn};
use ncc_ir::expr::num::Num;
use ncc_ir::program::cycle::Cycle;
use ncc_ir::source::Span;

use super::values::typed::Typed;
use crate::common::known::Know;
use crate::common::modal_state::ModalState;

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

/// The cycle, or subprogram, that `MCALL` has activated.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) enum ModalCall {
    #[default]
    None,
    Active(Box<Cycle>),
    /// A subprogram that is called where a block with motion ends.
    Subprogram(Box<AfterMove>),
    /// The caller's; one is active.
    Inherited {
        /// Whether it has a feed of its own, or may have.
        own_feed: bool,
    },
    /// Whether one is active is only known when the program runs.
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

impl ModalCall {
    /// Whether a cycle may be active that has a feed of its own.
    pub(super) fn own_feed(&self) -> bool {
        match self {
            ModalCall::None | ModalCall::Refused | ModalCall::Subprogram(_) => false,
            ModalCall::Active(cycle) => cycle.feed.is_some(),
            ModalCall::Inherited { own_feed } | ModalCall::Lost { own_feed } => *own_feed,
        }
    }
}

/// All that a block's meaning depends on.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct SiemensState {
    pub(super) modes: ModalState<Motion>,
    /// Whether F counts in these units as well; else in the basic system of the machine.
    pub(super) scaled: Know<bool>,
    /// Whether a speed is a surface's.
    pub(super) surface: Know<bool>,
    /// Where a tool was changed without naming an edge, which no move has relied on yet.
    pub(super) implied_edge: Option<Span>,
    /// Whether the way of counting has left no active feed: a move without one is refused where it is executed.
    pub(super) spent: bool,
    pub(super) cycle: ModalCall,
    pub(super) pole: Pole,
    /// Axes that the active frames may shift, turn, scale or mirror.
    pub(super) in_frame: [bool; AXES],
}

impl SiemensState {
    /// Nothing is known, and nothing is taken from power-on. The cycle is not lost with it, see `repeated_blocks`.
    pub(super) fn lost(cycle: ModalCall) -> SiemensState {
        SiemensState {
            modes: ModalState::lost(),
            scaled: Know::Lost,
            surface: Know::Lost,
            cycle,
            pole: Pole::Lost,
            in_frame: [true; AXES],
            ..SiemensState::default()
        }
    }

    /// A subprogram begins: its modes are its caller's.
    pub(super) fn called(cycle: ModalCall) -> SiemensState {
        SiemensState { modes: ModalState::called(), ..SiemensState::lost(cycle) }
    }

    /// After a call, a mode that the text has not said is as the program began, or not.
    pub(super) fn after_call(&self, cycle: ModalCall) -> SiemensState {
        SiemensState { modes: self.modes.at_merge(), ..SiemensState::lost(cycle) }
    }

    /// After a block that may have been skipped; `before` is the state before it.
    pub(super) fn join(&mut self, before: &SiemensState) {
        self.modes.join(&before.modes);
        self.scaled.join(before.scaled);
        self.surface.join(before.surface);
        self.implied_edge = self.implied_edge.or(before.implied_edge);
        self.spent &= before.spent;
        self.pole.join(before.pole);
        self.in_frame.iter_mut().zip(before.in_frame).for_each(|(axis, before)| *axis |= before);
        if self.cycle != before.cycle {
            self.cycle = ModalCall::Lost { own_feed: self.cycle.own_feed() || before.cycle.own_feed() };
        }
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

/// What is known of the active pole.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Pole {
    /// None was set: it is at zero.
    #[default]
    Unsaid,
    /// One of a plane; the place in it, if words have said it from zero.
    Said(Plane, Option<[Num; 2]>),
    /// It is known only when the program runs.
    Lost,
}

impl Pole {
    /// After other frames or another plane, nobody says where it is.
    pub(super) fn lose(&mut self) {
        if *self != Pole::Unsaid {
            *self = Pole::Lost;
        }
    }

    /// What is known after a block that may have been skipped.
    pub(super) fn join(&mut self, before: Pole) {
        if *self != before {
            *self = Pole::Lost;
        }
    }
}
