//! What a control refuses while cutter radius compensation is on, by kind of statement: what some controls refuse and
//! others do not. What every control refuses or does in a way of its own is refused by execution
//! (`exec/compensation.rs`).

pub mod kind;

pub use kind::Kind;

use crate::canon::AdviceKind;
use crate::program::{FrameSlot, Op};

impl Kind {
    /// The kind of a statement, if it has one.
    pub fn from_op(op: &Op) -> Option<Kind> {
        match op {
            Op::SetMotionControlMode(_) => Some(Kind::Path),
            Op::SetReturnLevel(_) => Some(Kind::ReturnLevel),
            Op::SetOriginOffsets(_) => Some(Kind::WorkOffset),
            Op::UseToolLengthOffset(_) | Op::UseToolLength(_) | Op::UseToolEdge { .. } => Some(Kind::Length),
            Op::ClearFrame(FrameSlot::Local) => Some(Kind::LocalShift),
            Op::Advise(advice) => Kind::of_advice(advice.kind),
            _ => None,
        }
    }

    /// The kind of an advice.
    pub const fn of_advice(kind: AdviceKind) -> Option<Kind> {
        match kind {
            AdviceKind::FeedOverride | AdviceKind::SpeedOverride | AdviceKind::FeedStop => {
                Some(Kind::Overrides)
            }
            _ => None,
        }
    }
}

/// What a control refuses there, a bit for each [`Kind`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Refused {
    /// Of codes that act after those of compensation in one block: refused in the block that switches it on.
    pub after: u8,
    /// Of codes that act before those of compensation in one block: refused in the block that switches it off.
    pub before: u8,
}

impl Refused {
    /// Adds a kind.
    pub fn add(&mut self, kind: Kind, before: bool) {
        match before {
            true => self.before |= 1 << kind as u8,
            false => self.after |= 1 << kind as u8,
        }
    }

    /// What it refuses and another does not.
    #[must_use]
    pub fn without(self, other: Refused) -> Refused {
        let all = other.after | other.before;
        Refused { after: self.after & !all, before: self.before & !all }
    }

    /// Whether it refuses anything.
    pub fn any(self) -> bool {
        self.after | self.before != 0
    }

    /// The kind of a statement, if it is refused.
    pub fn kind(self, op: &Op) -> Option<Kind> {
        Kind::from_op(op).filter(|kind| (self.after | self.before) >> *kind as u8 & 1 == 1)
    }

    /// Whether codes of a kind act before those of compensation.
    pub fn acts_before(self, kind: Kind) -> bool {
        self.before >> kind as u8 & 1 == 1
    }
}
