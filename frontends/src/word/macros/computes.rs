//! What a text computes, as far as read: open loops, and the jumps, calls and returns that are settled at its end.
//!
//! Not here: what is done with them.

use std::collections::{BTreeMap, BTreeSet};

use ncc_ir::expr::{Expr, Var};
use ncc_ir::program::{Call, Procedure, Text};
use ncc_ir::source::Span;

use crate::common::saved::Saved;
use crate::initial_modes::{Jumps, Unsaid};
use crate::word::block_words::Code;

/// What the text computes, as far as read.
#[derive(Debug, Default)]
pub(in crate::word) struct Computes {
    /// Whether it has variables.
    pub(in crate::word) variables: bool,
    /// Whether blocks with numbers may be jumped to.
    pub(in crate::word) jumps: bool,
    /// Whether there were such blocks before that was known.
    pub(in crate::word) unnamed: bool,
    /// Numbers of blocks that the text names; `None` if one is named by what is computed.
    pub(in crate::word) named: Option<BTreeSet<u32>>,
    /// Numbers of blocks that were read as no jump's.
    pub(in crate::word) passed: BTreeSet<u32>,
    pub(in crate::word) loops: Vec<OpenLoop>,
    /// How many arguments programs are called with, by their names.
    pub(in crate::word) called: BTreeMap<Text, usize>,
    /// Jumps to blocks whose number is computed.
    pub(in crate::word) computed_jumps: Vec<ComputedJump>,
    /// Calls of blocks of the main program.
    pub(in crate::word) local_calls: Vec<LocalCall>,
    /// Returns of the subprograms.
    pub(in crate::word) returns: Vec<ReturnTo>,
    /// Whether programs are called whose number is computed.
    pub(in crate::word) calls_of: bool,
    /// The macro that is called after each block that moves.
    pub(in crate::word) at_moves: Option<AtMoves>,
    /// Modes that are saved and restored.
    pub(in crate::word) saved: Saved,
    pub(in crate::word) reach: Reach,
}

/// A loop that has not ended.
#[derive(Debug)]
pub(in crate::word) struct OpenLoop {
    pub(in crate::word) number: u32,
    pub(in crate::word) condition: Option<Expr>,
    /// Where its body begins; `None` until a further block is read.
    pub(in crate::word) at: Option<usize>,
    pub(in crate::word) block: Span,
    pub(in crate::word) skip: Option<u8>,
    pub(in crate::word) label: Option<u32>,
    /// The calls at moves that it began in.
    pub(in crate::word) calls: u32,
    /// What was not said before it.
    pub(in crate::word) unsaid: Unsaid,
}

/// The name by which jumps know the block of a number.
pub(in crate::word) fn label(number: u32) -> Text {
    format!("N{number}").into()
}

/// A jump of which the number is computed, and whether it is one of those that depend on something.
#[derive(Clone, Debug)]
pub(in crate::word) struct ComputedJump {
    pub(in crate::word) condition: Option<Expr>,
    pub(in crate::word) to: Expr,
}

/// Calls of blocks of the main program: the block, the code, and where it stands.
pub(in crate::word) type LocalCall = (u32, &'static str, Span);

/// A return, the subprogram that it stands in, and the block of the caller that it names.
#[derive(Clone, Debug)]
pub(in crate::word) struct ReturnTo {
    pub(in crate::word) own: Text,
    pub(in crate::word) block: Option<u32>,
    pub(in crate::word) code: &'static str,
    pub(in crate::word) at: Span,
}

/// Calls that are active.
#[derive(Clone, Debug)]
pub(in crate::word) struct AtMoves {
    pub(in crate::word) call: Call,
    /// Which of the text's they are, from 1.
    pub(in crate::word) which: u32,
    /// Whether arguments are computed.
    pub(in crate::word) computed: bool,
    /// The code by which the words of every block are the arguments of one.
    pub(in crate::word) by_words: Option<Code>,
}

/// Which calls are active at each jump target, and where it goes away from; 0 is none.
#[derive(Debug, Default)]
pub(in crate::word) struct Reach {
    /// How many of them the text has had.
    pub(in crate::word) seen: u32,
    /// The code that says them.
    pub(in crate::word) code: Text,
    /// Blocks with numbers.
    pub(in crate::word) labels: Vec<(u32, u32)>,
    /// Jumps; of one without a number it is computed.
    pub(in crate::word) jumps: Vec<(Option<u32>, u32, Span)>,
    /// What the program has not said where it jumps.
    pub(in crate::word) unsaid_at_jumps: Jumps,
    /// Programs that are called after moves, and those that have such calls; the main one has no name.
    pub(in crate::word) called: Vec<(Text, Text, Span)>,
}

/// What such a call is called until the text is read; its number is the argument. No program has this name.
pub(in crate::word) const COMPUTED: &str = "#";

/// The local variables that so many arguments are given to.
pub(in crate::word) fn parameters(count: usize) -> Vec<Var> {
    (1..=count).map(|number| Var::Local(number.to_string().into())).collect()
}

impl Computes {
    /// A block with a number is read, and may be one that jumps name: whether none of them does.
    pub(in crate::word) fn passes(&mut self, number: u32) -> bool {
        let passes = self.named.as_ref().is_some_and(|named| !named.contains(&number));
        if passes {
            self.passed.insert(number);
        }
        passes
    }

    /// A program is called with so many arguments.
    pub(in crate::word) fn calls(&mut self, name: &str, arguments: usize) {
        match self.called.get_mut(name) {
            Some(most) => *most = (*most).max(arguments),
            None => _ = self.called.insert(name.into(), arguments),
        }
    }

    /// The text is over: what is called with arguments has them as its first local variables.
    pub(in crate::word) fn give_parameters(&self, procedures: &mut [Procedure]) {
        for procedure in procedures {
            if let Some(most) = self.called.get(&procedure.name) {
                procedure.parameters = parameters(*most);
            }
        }
    }
}
