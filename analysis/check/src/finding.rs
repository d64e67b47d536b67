//! Findings: which rule, where, and the figures that belong to it. No words.

use ncc_ir::canon::Axis;
use ncc_ir::expr::num::{Nanos, Num};
use ncc_ir::program::Text;
use ncc_ir::source::Span;

use crate::rule::Rule;

/// Of one rule, so many findings are kept; the rest is counted.
const MOST: usize = 1000;

/// What a rule found at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The rule's own figures.
    pub what: What,
    /// Where.
    pub span: Span,
    /// Other places that belong to it.
    pub related: Vec<Span>,
    /// How many further places are like it.
    pub more: u64,
    /// Whether it holds only if nobody has set before what the program never says: not in a subprogram,
    /// whose caller has.
    pub at_entry: bool,
}

/// On which side of a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    /// Below the least.
    Below,
    /// Above the greatest.
    Above,
}

/// A mode that a program leaves active.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum LeftOn {
    /// Incremental words.
    Incremental,
    /// A canned cycle.
    Cycle,
    /// A frame: shift, rotation, scale, mirror.
    Frame,
    /// Cutter radius compensation.
    Compensation,
    /// The spindle turns.
    Spindle,
    /// Coolant.
    Coolant,
    /// A tool's length.
    Length,
}

/// What a refused code would have switched on: all that is known of it.
pub type Setting = LeftOn;

/// The figures of a finding. Lengths are nanos of a millimetre (degrees of a rotary axis) in machine
/// coordinates unless it is stated otherwise, feeds nanos of mm/min, speeds nanos of rev/min.
#[derive(Clone, Debug, PartialEq)]
pub enum What {
    /// An axis goes beyond its travel.
    AxisTravel {
        /// The axis.
        axis: Axis,
        /// On which side.
        side: Outside,
        /// Where the move takes it.
        to: Nanos,
        /// The limit.
        limit: Nanos,
        /// The farthest of all moves beyond this limit.
        farthest: Nanos,
    },
    /// A feed above the highest.
    FeedRange {
        /// The axis whose limit it is; `None` is the path's.
        axis: Option<Axis>,
        /// The feed along the path, or the axis' part of it.
        feed: Nanos,
        /// The limit.
        limit: Nanos,
    },
    /// A speed above the highest.
    SpeedRange {
        /// The speed.
        speed: Nanos,
        /// The limit.
        limit: Nanos,
    },
    /// No feed has been stated.
    NoFeed,
    /// The spindle is stopped.
    SpindleStands,
    /// The spindle turns and no speed has been stated.
    SpindleWithoutSpeed,
    /// Z moves without the length of the tool; the place of the change is related.
    NoLength {
        /// The tool that was put in.
        tool: i64,
    },
    /// Z moves with the length that was active before the change.
    OldLength {
        /// The tool that was put in.
        tool: i64,
    },
    /// A rapid below the plane.
    RapidBelow {
        /// Where Z ends, or is, program coordinates.
        z: Nanos,
        /// The plane, program coordinates.
        plane: Nanos,
        /// Whether it is the retract plane of a cycle.
        cycle: bool,
    },
    /// A number without a point.
    BareNumber {
        /// By the dialect's rule.
        read: Num,
        /// With a point after its digits.
        with_point: Num,
    },
    /// A mode is left on; the place of the end is related.
    Left(LeftOn),
    /// A called program is not in the text.
    CallNowhere {
        /// Its name.
        name: Text,
    },
    /// There is no such block or label.
    JumpNowhere {
        /// Its name.
        name: Text,
    },
    /// After the end of the program.
    AfterEnd,
    /// After a jump that is always made, and nothing leads here.
    AfterJump,
    /// A subprogram that nothing calls.
    NeverCalled {
        /// Its name.
        name: Text,
    },
    /// A thread with a pitch of no standard.
    ThreadPitch {
        /// Its pitch, nanos of a millimetre.
        pitch: Nanos,
        /// The standard pitch nearest to it, in proportion.
        nearest: StandardPitch,
    },
}

/// A pitch of a standard, as the standard states it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StandardPitch {
    /// Nanos of a millimetre.
    Metric(Nanos),
    /// Threads in two inches: 23 are 11½ per inch.
    InTwoInches(u8),
}

impl What {
    /// Whose finding it is.
    pub const fn rule(&self) -> Rule {
        match self {
            What::AxisTravel { .. } => Rule::AxisTravel,
            What::FeedRange { .. } => Rule::FeedRange,
            What::SpeedRange { .. } => Rule::SpeedRange,
            What::NoFeed => Rule::NoFeed,
            What::SpindleStands | What::SpindleWithoutSpeed => Rule::NoSpindle,
            What::NoLength { .. } | What::OldLength { .. } => Rule::NoLength,
            What::RapidBelow { .. } => Rule::RapidBelow,
            What::BareNumber { .. } => Rule::BareNumber,
            What::Left(LeftOn::Incremental | LeftOn::Cycle | LeftOn::Frame | LeftOn::Compensation) => {
                Rule::LeftOn
            }
            What::Left(LeftOn::Spindle | LeftOn::Coolant | LeftOn::Length) => Rule::LeftRunning,
            What::CallNowhere { .. } => Rule::CallNowhere,
            What::JumpNowhere { .. } => Rule::JumpNowhere,
            What::AfterEnd | What::AfterJump => Rule::Unreachable,
            What::NeverCalled { .. } => Rule::NeverCalled,
            What::ThreadPitch { .. } => Rule::ThreadPitch,
        }
    }
}

impl Finding {
    /// A finding at one place.
    pub fn new(what: What, span: Span) -> Finding {
        Finding { what, span, related: Vec::new(), more: 0, at_entry: false }
    }

    /// With another place.
    pub fn with(mut self, related: impl IntoIterator<Item = Span>) -> Finding {
        self.related.extend(related);
        self
    }
}

/// What was found so far, bounded.
#[derive(Clone, Debug, Default)]
pub struct Findings {
    kept: Vec<Finding>,
    counts: Vec<(Rule, usize)>,
}

impl Findings {
    /// Adds a finding; gives its index if it is kept.
    pub fn add(&mut self, finding: Finding) -> Option<usize> {
        if self.count(finding.what.rule(), 1) > MOST {
            return None;
        }
        self.kept.push(finding);
        Some(self.kept.len() - 1)
    }

    /// Counts findings of a rule, kept or not; gives how many there are by now.
    pub fn count(&mut self, rule: Rule, n: usize) -> usize {
        let place = match self.counts.iter().position(|(of, _)| *of == rule) {
            Some(place) => place,
            None => {
                self.counts.push((rule, 0));
                self.counts.len() - 1
            }
        };
        let count = &mut self.counts[place].1;
        *count += n;
        *count
    }

    /// A finding that was kept.
    pub fn get_mut(&mut self, index: usize) -> Option<&mut Finding> {
        self.kept.get_mut(index)
    }

    /// Keeps only some.
    pub fn retain(&mut self, keep: impl Fn(&Finding) -> bool) {
        self.kept.retain(keep);
    }

    /// All that are kept, in the order of their places.
    pub fn sorted(mut self) -> Vec<Finding> {
        self.kept.sort_by_key(|finding| (finding.span.start, finding.what.rule()));
        self.kept
    }

    /// Of which rules findings are only counted, and how many.
    pub fn left_out(&self) -> impl Iterator<Item = (Rule, usize)> + '_ {
        self.counts.iter().filter(|(_, n)| *n > MOST).map(|(rule, n)| (*rule, n - MOST))
    }
}
