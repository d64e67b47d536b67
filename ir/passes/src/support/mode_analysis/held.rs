//! What holds at a place of a program, and what a statement makes of it.

use super::called::Called;
use crate::values::constant_queries::{self, Saved};
use ncc_ir::canon::{AXES, Modes, Motion};
use ncc_ir::expr::Target;
use ncc_ir::program::arguments;
use ncc_ir::program::{Op, PathControl};
use ncc_ir::track::Tracker;

/// What holds at a place.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Held {
    pub(super) at: Tracker,
    /// How corners are taken, if the program has said it.
    pub(super) path: Option<Box<PathControl>>,
    /// Whether the active cycle is as its block has called it up: the same words would activate the same.
    pub(super) as_called: bool,
    /// The place of that block, and what holds there.
    pub(super) called_at: (u32, Modes),
    /// Variables that have whole numbers, such as saved active codes.
    pub(super) saved: Saved,
}

impl Held {
    pub(super) fn join(&mut self, other: &Held) {
        self.at.join(&other.at);
        if self.path != other.path {
            self.path = None;
        }
        self.as_called &= other.as_called && self.called_at == other.called_at;
        self.saved.join(&other.saved);
    }

    /// The active cycle, if it is known and as it was activated.
    pub(super) fn cycle(&self) -> Option<Called> {
        let in_force = self.at.cycle.is_some() && !self.at.cycle_in_doubt;
        let sure = self.as_called && self.at.modes.motion == Some(Motion::Cycle);
        let (at, with) = self.called_at;
        (sure && in_force).then_some(Called { at, with, modes: self.at.modes })
    }

    /// After a call that restores the modes of its caller.
    pub(super) fn with_restored_modes(mut self, caller: &Held) -> Held {
        let (own, before) = (&mut self.at, &caller.at);
        let (modes, had) = (&mut own.modes, &before.modes);
        modes.motion = had.motion;
        modes.distance = had.distance;
        modes.units = had.units;
        modes.plane = had.plane;
        modes.feed_mode = had.feed_mode;
        modes.work_offset = had.work_offset;
        (own.framed, own.chained, own.turned) = (before.framed, before.chained, before.turned);
        own.turning = before.turning;
        (own.chain, own.chain_turned) = (before.chain, before.chain_turned);
        own.compensated = before.compensated;
        // They were those of its own frames.
        own.position = [None; AXES];
        self.path.clone_from(&caller.path);
        self
    }

    /// A variable gets another value.
    pub(super) fn sets(&mut self, to: &Target) {
        self.saved.set(to, None);
        let Some(in_force) = &self.at.cycle else { return };
        self.as_called &= !arguments::reads(&Op::StartCycle(Box::new(in_force.cycle.clone())), to);
    }

    pub(super) fn apply(&mut self, op: &Op, at: u32) {
        if let Op::Assign(to, value) = op {
            self.sets(to);
            self.saved.set(to, constant_queries::constant_value(value, &self.at.modes));
        } else if let Op::Declare(_) = op {
            self.saved.forget();
        } else if matches!(op, Op::StartCycle(_)) {
            (self.as_called, self.called_at) = (true, (at, self.at.modes));
        } else if let Op::SetMotionControlMode(control) = op {
            self.path = Some(control.clone());
            self.as_called = false;
        } else if !matches!(
            op,
            Op::Hole(_)
                | Op::Position(_)
                | Op::Pattern(_)
                | Op::SetDistanceMode(_)
                | Op::Comment(_)
                | Op::NoEffect(_)
                | Op::Blank
                | Op::Message(_)
                | Op::MessageOf(_)
                | Op::Output(_)
                | Op::FloodOn
                | Op::MistOn
                | Op::CoolantOff
        ) {
            self.as_called = false;
        }
        self.at.apply(op);
    }
}
