//! A word of the `ir` text: its number with the unit, the function it names, or why it is no word.

use ncc_ir::canon::CornerShape;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::{Op, Text, ToolLength};

/// Why a text is no word.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum LexFault {
    /// No word starts like this.
    #[default]
    Character,
    /// More digits than a number can hold.
    Number,
    /// A text with an escape that there is not.
    Escape,
}

/// A number as written, still without a sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Literal {
    pub(super) magnitude: u64,
    pub(super) scale: u8,
    pub(super) point: bool,
    pub(super) unit: Unit,
}

impl Literal {
    /// The number, with a sign; `None` if it has too many digits.
    pub(super) fn signed(self, negative: bool) -> Option<Num> {
        let mantissa = match negative {
            true => 0i64.checked_sub_unsigned(self.magnitude),
            false => i64::try_from(self.magnitude).ok(),
        }?;
        Some(Num { mantissa, scale: self.scale, point: self.point, unit: self.unit })
    }

    /// The value of a plain whole number without unit.
    pub(super) fn plain(self) -> Option<u64> {
        (self.unit == Unit::One && !self.point).then_some(self.magnitude)
    }
}

/// Name of an arc's function that is not the plain one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Form(pub(crate) &'static str);

/// A function with one number as its argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Valued {
    SetFeedRate,
    SetSpindleSpeed,
    LimitSpindleSpeed,
    SelectTool,
    UseToolLengthOffset,
    UseToolLength,
    AddToolLength,
    AddToolLengthOffset,
    Dwell,
    RoundCorner,
    ChamferCorner,
    ChamferCornerByLength,
}

impl Valued {
    /// The function of a number.
    pub(super) fn with_argument(self, value: Expr) -> Op {
        match self {
            Valued::SetFeedRate => Op::SetFeedRate(value),
            Valued::SetSpindleSpeed => Op::SetSpindleSpeed(value),
            Valued::LimitSpindleSpeed => Op::LimitSpindleSpeed(value),
            Valued::SelectTool => Op::SelectTool(value),
            Valued::UseToolLengthOffset => Op::UseToolLengthOffset(value),
            Valued::UseToolLength => Op::UseToolLength(Box::new(ToolLength::Value(value))),
            Valued::AddToolLength => Op::UseToolLength(Box::new(ToolLength::Added(value))),
            Valued::AddToolLengthOffset => Op::UseToolLength(Box::new(ToolLength::AddedEntry(value))),
            Valued::Dwell => Op::Dwell(value),
            Valued::RoundCorner => Op::Corner { shape: CornerShape::Round, size: value },
            Valued::ChamferCorner => Op::Corner { shape: CornerShape::Leg, size: value },
            Valued::ChamferCornerByLength => Op::Corner { shape: CornerShape::Length, size: value },
        }
    }
}

/// A function with a text as its argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Worded {
    Comment,
    NoEffect,
    Message,
    MachineFunction,
    SelectToolByName,
}

impl Worded {
    /// The function of a text.
    pub(super) fn with_argument(self, text: Text) -> Op {
        match self {
            Worded::Comment => Op::Comment(text),
            Worded::NoEffect => Op::NoEffect(text),
            Worded::Message => Op::Message(text),
            Worded::MachineFunction => Op::MachineFunction(text),
            Worded::SelectToolByName => Op::SelectToolByName(text),
        }
    }
}
