//! What a text has stated so far, wherever: facts that hold for all of it, and what has been reported.
//!
//! Not here: what holds at the block that is read (`word_state`).

use std::collections::BTreeSet;

use ncc_ir::canon::Motion;
use ncc_ir::diag::Fault;
use ncc_ir::program::CentreFrom;
use ncc_ir::source::Span;

/// From where the text says that centres are measured.
#[derive(Clone, Debug, Default)]
pub(super) struct CentreSeen {
    pub(super) said: Vec<CentreFrom>,
    /// What the subprogram at hand says, where every path has come by it.
    pub(super) own: Option<OwnCentre>,
    /// For a way of measuring, the first arc that relies on the text's saying no other.
    pub(super) relied: Vec<(CentreFrom, Span)>,
}

/// From where the subprogram at hand says that centres are measured.
#[derive(Clone, Copy, Debug)]
pub(super) struct OwnCentre {
    pub(super) from: CentreFrom,
    /// The first arc in a loop or a branch that relies on the subprogram's saying no other.
    pub(super) relied: Option<Span>,
}

/// Blocks in which no cycle may be active.
#[derive(Debug, Default)]
pub(super) struct CyclesMet {
    /// Whether the text calls a cycle up.
    pub(super) any: bool,
    /// Whether one was active where the program began to be kept whole.
    pub(super) entered: bool,
    /// Codes after a call, a jump or a label: decided when the text has been read.
    pub(super) doubts: Vec<(Fault, Span)>,
}

/// Entries of radii in the whole text, for a control that goes without compensation where none is named.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RadiusNamed {
    /// Whether one was named so far.
    pub(super) named: bool,
    /// Whether it was relied on that none is, in blocks that others call or come back to.
    pub(super) none_named: bool,
    pub(super) reported: bool,
}

/// Codes of motion that no move has said.
#[derive(Debug, Default)]
pub(super) struct MotionWithoutMove {
    /// The last one, while no move follows it.
    pub(super) code: Option<(Span, Motion)>,
    /// Of one that was lost: where it stands.
    pub(super) lost: Option<Span>,
    /// Axis words that do what is active.
    pub(super) bare: Option<Span>,
    pub(super) reported: bool,
}

impl MotionWithoutMove {
    /// Puts the code aside, as a program within the text has its own.
    pub(super) fn take_code(&mut self) -> Option<(Span, Motion)> {
        self.code.take()
    }

    /// Takes it up again.
    pub(super) fn restore_code(&mut self, code: Option<(Span, Motion)>) {
        self.code = code;
    }
}

/// Tools as the text names them, from block to block.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ToolsNamed {
    /// The tool that an earlier block selects, and that no change has put in since.
    pub(super) waits: Option<u32>,
    /// The same before the block at hand, and the T of that block.
    pub(super) now: Option<(Option<u32>, u32, Span)>,
    /// The last change: the tool that its block names, and the other one that waited.
    pub(super) doubt: Option<(u32, u32, Span)>,
    /// What the user has stated of the start, and what the text says itself.
    pub(super) at_start: AtStart,
}

/// What the text takes of the active codes at its start, and what it says of them itself.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct AtStart {
    /// The T and the H code that were stated and used.
    pub(super) used: [Option<u32>; 2],
    /// Whether the text has said a T or an H code that may be another one.
    pub(super) said: [Option<u32>; 2],
    /// Whether that is not one number.
    pub(super) several: [bool; 2],
    /// Where the main program begins again.
    pub(super) begins_again: Option<Span>,
}

impl AtStart {
    pub(super) fn says(&mut self, which: usize, number: Option<u32>) {
        self.several[which] |= number.is_none() || self.said[which].is_some_and(|said| Some(said) != number);
        self.said[which] = number;
    }

    /// The main program begins again here.
    pub(super) fn note_begin_again(&mut self, at: Span) {
        self.begins_again.get_or_insert(at);
    }
}

/// Dwells of cycles in the whole text, where they stay active for other cycles.
#[derive(Debug, Default)]
pub(super) struct Dwells {
    /// Whether any was stated so far.
    pub(super) said: bool,
    /// Where it was first relied on that none was stated, in blocks that others call or come back to.
    pub(super) relied: Option<Span>,
    /// Whether control went elsewhere so far while a cycle with a dwell was active.
    pub(super) carried: bool,
    /// Where a cycle was first activated without one while it is not known which is active before it.
    pub(super) over_unknown: Option<(Span, &'static str)>,
}

/// How the main program ends.
#[derive(Debug, Default)]
pub(super) struct MainEnding {
    /// Where it first returns to another.
    pub(super) returns: Option<Span>,
    /// Where it first begins again.
    pub(super) begins_again: Option<Span>,
    /// Whether it ends by itself.
    pub(super) ends: bool,
    /// Where it first moves at a feed that it has not stated: that of its caller, if it is a subprogram.
    pub(super) feed: Option<Span>,
}

/// What has been reported and is not to be reported again.
#[derive(Debug, Default)]
pub(super) struct Reported {
    /// Quantities of numbers without a point, a bit each.
    pub(super) bare: u8,
    /// That computed lengths and angles are rounded to an increment.
    pub(super) increment: bool,
    pub(super) after_cycle: bool,
    pub(super) offset_with_z: bool,
    pub(super) skip: bool,
    /// How the block-skip switch stands, as the user states it.
    pub(super) switch: bool,
    /// That a T beside M06 is taken for the tool that is put in.
    pub(super) tool_change: bool,
    /// By which of two codes of distance the words of a return are read.
    pub(super) return_distance: bool,
    /// Programs whose calls are left out, by their places among those that the user states.
    pub(super) calls_left_out: BTreeSet<usize>,
    /// That a cycle drills beside a code of motion.
    pub(super) cycle_beside_motion: bool,
    /// Rows of codes.
    pub(super) codes: Vec<bool>,
    /// Address letters, a bit each.
    pub(super) letters: u32,
    /// That entry 0 is no length offset.
    pub(super) no_length: bool,
    /// Options of the dictionary, by place.
    pub(super) options: u32,
    /// What is assumed of the control's own values.
    pub(super) values: Vec<&'static str>,
}
