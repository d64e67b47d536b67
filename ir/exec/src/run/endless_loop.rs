//! Loops that a run never leaves: it comes back to where it was, and every variable has the value that it had.
//!
//! What comes next follows from where a run is and from its variables, unless the program asks for values of the
//! control's own. Looked for by Brent's method: what was seen is kept for so many turns, then for twice as many.
//!
//! Not here: a run whose variables change for ever, which ends at a number of steps.

use crate::run::code::At;
use crate::run::nesting::{Blocks, Frame};
use crate::run::term::Variables;

/// Where a run was, and what it knew.
#[derive(Clone, Debug, PartialEq)]
struct Seen {
    at: At,
    variables: Variables,
    calls: Vec<Frame>,
    turns: Vec<u64>,
    blocks: Vec<Blocks>,
}

/// What is kept of a run to see that it goes round.
#[derive(Clone, Debug, Default)]
pub(crate) struct EndlessLoop {
    seen: Option<Box<Seen>>,
    /// Ways back so far.
    backs: u64,
    /// At which of them what is seen is kept next.
    next: u64,
}

impl EndlessLoop {
    /// A way back is gone, to here; whether the run was here before with all as it is.
    #[inline]
    pub(crate) fn again(
        &mut self,
        at: At,
        variables: &Variables,
        calls: &[Frame],
        turns: &[u64],
        blocks: &[Blocks],
    ) -> bool {
        self.backs += 1;
        if let Some(seen) = &self.seen
            && seen.at == at
            && seen.variables == *variables
            && seen.calls == calls
            && seen.turns == turns
            && seen.blocks == blocks
        {
            return true;
        }
        if self.backs > self.next {
            self.next = self.backs * 2;
            self.seen = Some(Box::new(Seen {
                at,
                variables: variables.clone(),
                calls: calls.to_vec(),
                turns: turns.to_vec(),
                blocks: blocks.to_vec(),
            }));
        }
        false
    }
}
