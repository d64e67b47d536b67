//! A question: the fact that is open, its two readings, and what a user writes to choose one.

use ncc_ir::canon::{Axis, FeedMode, Units};
use ncc_ir::expr::num::{Nanos, Num};
use ncc_ir::source::Span;

/// What a translation does about questions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Policy {
    /// It stops with all of them.
    #[default]
    Ask,
    /// It goes on with ncc's readings; head and report name the questions first.
    Assume,
    /// It looks for none.
    Skip,
}

/// A fact that may be asked, from the most dangerous one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Fact {
    /// For which control the program was written, where its text fits several.
    Control,
    /// The unit of lengths, which the program never states.
    Units,
    /// What a number without a decimal point counts.
    DecimalPoint,
    /// From where the words of an arc's centre are measured.
    Centres,
    /// How far an absolute word turns a rotary axis. An error of the translation, which asks it too.
    RotaryTurn,
    /// By which of two codes of distance the words of a return to a reference point are read.
    ReturnPath,
    /// The tool that M06 puts in, where its block has a T and another tool waits.
    ToolChange,
    /// Whether a cycle drills that stands beside a code of motion.
    CycleBesideMotion,
}

impl Fact {
    /// The number of the message's code.
    pub fn code(self) -> u16 {
        match self {
            Fact::Control => 330,
            Fact::Units => 301,
            Fact::DecimalPoint => 303,
            Fact::Centres => 307,
            Fact::ToolChange => 336,
            Fact::ReturnPath => 337,
            Fact::CycleBesideMotion => 338,
            Fact::RotaryTurn => 522,
        }
    }
}

/// What a user writes to choose a reading.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// `--from fanuc`.
    From(&'static str),
    /// `--units mm`.
    Units(Units),
    /// `--from-option decimal_point=increment`.
    Option(&'static str, &'static str),
    /// No option: decimal points in the program.
    WritePoints,
    /// `--from-option rotary_turn=shortest --to-option rotary_turn=shortest`, of those machines that are not stated.
    OfMachines {
        /// The option.
        option: &'static str,
        /// Its value.
        value: &'static str,
        /// Whether the source's machine is asked.
        from: bool,
        /// Whether the target's machine is asked.
        to: bool,
    },
}

/// One of the two readings of a fact.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// What chooses it.
    pub answer: Answer,
    /// Whether it is ncc's own.
    pub taken: bool,
    /// What it makes, in numbers.
    pub result: Shown,
}

/// A result of a reading that can be shown.
#[derive(Clone, Debug, PartialEq)]
pub enum Shown {
    /// The value of the word at the place: a length, or a feed a minute.
    Word {
        /// In its unit.
        value: Num,
        /// Whether it is a feed.
        feed: bool,
    },
    /// What the machine does there.
    Made(Made),
    /// The path of a return to a reference point.
    Path {
        /// The code.
        code: Box<str>,
        /// Its axis words.
        words: Box<str>,
        /// Whether all of them are nothing.
        zero: bool,
        /// Whether they are places of the part.
        absolute: bool,
    },
    /// A block with a cycle's code and one of motion drills, or moves by the latter.
    Hole {
        /// The code of the cycle.
        cycle: Box<str>,
        /// The code of motion.
        motion: Box<str>,
        /// Whether it drills.
        drills: bool,
    },
    /// A rotary axis turns by so much, nanos of a degree.
    Turn(Axis, Nanos),
    /// Nothing but that the two readings differ.
    Nothing,
}

/// A fact of which two values make two different cuts of the program.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// Which fact.
    pub fact: Fact,
    /// The first place where both readings differ: a word, or a block.
    pub span: Span,
    /// Both readings.
    pub readings: [Reading; 2],
}

impl Question {
    /// The control that was recognised, and the other one.
    pub fn controls(&self) -> Option<(&'static str, &'static str)> {
        match self.readings.each_ref().map(|reading| &reading.answer) {
            [Answer::From(taken), Answer::From(other)] => Some((taken, other)),
            _ => None,
        }
    }

    /// ncc's own reading.
    pub fn taken(&self) -> &Reading {
        let [first, second] = &self.readings;
        if second.taken { second } else { first }
    }
}

/// What one reading makes at the first place where both differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Made {
    /// An axis ends there, nanos of a millimetre or degree in program coordinates.
    End(Axis, Nanos),
    /// The centre of an arc is there along an axis of its plane, in nanos of a millimetre.
    Centre(Axis, Nanos),
    /// A feed, in nanos of its mode's unit: millimetres a minute, millimetres a turn, one a minute.
    Feed(Nanos, FeedMode),
    /// A dwell, in nanos of a second.
    Dwell(Nanos),
    /// The spindle turns, or not.
    Spindle(bool),
    /// A tool is in the spindle.
    Tool(i64),
    /// The reading is refused there, by this code.
    Refused(u16),
    /// Something else.
    Otherwise,
}
