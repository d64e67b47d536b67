//! The state of a verification: runs of both programs, and what they have shown.
//!
//! ```text
//! a Verifier    runs: world 1, world 2    each a Run: source | output, events not compared yet
//! ```
//!
//! Not here: how they go on (`verify_run`), and facts that another run has otherwise (`facts`).

use ncc_exec::verify::{Comparison, Pair};
use ncc_exec::{Event, Exec, PacedMove, Stroke};
use ncc_frontends::{Batch, Reader};
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::{AXES, Modes};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::{Nanos, Num};
use ncc_ir::expr::{Function, Var};
use ncc_ir::program::Stmt;
use ncc_ir::source::Span;
use ncc_passes::values::variables::Fineness;

use crate::job;
use crate::job::initial_variables::InitialVariables;

/// Highest level of block skip: a tenth is a Sinumerik's `/1`.
pub(super) const MOST_LEVELS: u8 = 10;

/// Levels of block skip of which every setting is tried; of more, only pairs.
pub(super) const ALL_SETTINGS: u32 = 6;

/// Why a verification ends early.
#[derive(Debug)]
pub enum Stop {
    /// The source cannot be executed.
    Source(Diagnostic),
    /// The output is not the same program, or cannot be read back: a fault of the compiler.
    Target(Diagnostic),
}

/// An open fact of one of the controls, with another value than its usual one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Other {
    /// What a code does besides its name.
    Behaviour {
        /// Which.
        behaviour: Behaviour,
        /// Whether it is the source's control.
        source: bool,
        /// The value.
        value: u8,
    },
    /// The switch for optional stops is on, for both.
    OptionalStop,
}

/// One world under one setting of the block-skip switches.
#[derive(Clone)]
pub struct Run {
    /// The seed of its world.
    pub(super) seed: u32,
    /// Levels that are on in the source: bit n is level n.
    pub(super) skip: u16,
    pub(super) source: Exec,
    pub(super) target: Exec,
    pub(super) source_events: Vec<Event>,
    pub(super) target_events: Vec<Event>,
    pub(super) comparison: Comparison,
    /// Both controls are in one state, with nothing left to compare.
    pub(super) level: bool,
    /// The one fact that is another one than usual, of a run that shows whether it matters.
    pub(super) other: Option<Other>,
    /// How many events of the usual run's source, and target, it has taken of those that are not compared yet.
    pub(super) taken: [usize; 2],
}

impl Run {
    /// Executes lines of the source that the output says as well, and keeps a pair for each of their events; gives how
    /// many there are.
    pub(super) fn pass_in_pairs(&mut self, said: &[Stmt], read: &[Stmt]) -> Result<u64, Diagnostic> {
        let mut many = 0;
        for (stmt, there) in said.iter().zip(read) {
            self.source.step(stmt, &mut self.source_events)?;
            for Event { kind, span, .. } in self.source_events.drain(..) {
                self.comparison.keep_pair(Pair { kind, source: span, target: there.span });
                many += 1;
            }
        }
        Ok(many)
    }
}

/// A variable that the source reads before it sets it, and that outlives its run.
#[derive(Debug)]
pub struct Outliving {
    /// What each side calls it.
    pub(super) sides: [Var; 2],
    /// The first place that reads it.
    pub(super) at: Span,
    /// Whether the program sets it too: then its next run reads what this one has left.
    pub(super) set: bool,
}

/// Holes that the source has made, and the target not yet.
pub(super) struct HolesAhead {
    /// What the source says.
    pub(super) stmts: Vec<Stmt>,
    /// What each run had of them.
    pub(super) runs: Vec<HolesMade>,
    /// Whether they are the end of a piece whose beginning is executed by itself.
    pub(super) at_end: bool,
}

/// Holes of one run.
pub(super) struct HolesMade {
    /// The source's control after them; its run has it as it is before them.
    pub(super) behind: Exec,
    pub(super) form: HoleForm,
    pub(super) events: u64,
}

/// What is known of holes that were executed for their effect alone.
pub(super) enum HoleForm {
    /// Where they are: the target is to make the same holes.
    Places(Vec<[Nanos; AXES]>),
    /// Their straight moves: the target is to go along these.
    Strokes(Vec<Stroke>),
}

/// Arcs of one run that the source has made, and the target not yet.
pub(super) struct ArcsMade {
    /// The source's control before them.
    pub(super) before: Exec,
    pub(super) events: u64,
}

/// Lines of one run that the source has made, and the target not yet.
pub(super) struct PacedMade {
    /// The source's control after them; its run has it as it is before them.
    pub(super) behind: Exec,
    pub(super) moves: Vec<PacedMove>,
}

/// A verification in progress.
pub struct Verifier {
    pub(super) reader: Reader,
    /// Whether the program is called by another.
    pub(super) as_called: bool,
    /// Branches of the source that are reported as one-sided.
    pub(super) answered: Vec<Span>,
    pub(super) batch: Batch,
    pub(super) runs: Vec<Run>,
    /// Runs of the first world in which one open fact is another one than usual.
    pub(super) others: Vec<Run>,
    /// Holes that the source has made, where the target is likely to make the same of them.
    pub(super) holes_ahead: Option<HolesAhead>,
    /// Whether it did not, under the active cycle.
    pub(super) holes_differ: bool,
    /// Whether it did not go along their strokes either.
    pub(super) strokes_differ: bool,
    /// What each run has made of arcs that the source has executed, where the target is likely to make the same.
    pub(super) arcs_ahead: Option<Vec<ArcsMade>>,
    /// What each run has made of lines that turn rotary axes, where the target is likely to make the same moves.
    pub(super) paced_ahead: Option<Vec<PacedMade>>,
    /// Open facts of the source's control, the target's, a bit each, that are looked at.
    pub(super) open: [u64; 2],
    /// Whether the switch for optional stops makes a difference on either control.
    pub(super) optional_stop: bool,
    /// Facts that were found to make another cut, each where it does.
    pub(super) matters: Vec<(Other, Span)>,
    /// Facts that were not tried to the program's end, each where the program reached it.
    pub(super) untried: Vec<(Other, Span)>,
    /// Events and steps for which a fact is tried.
    pub(super) reach: [u64; 2],
    /// Events of the sets of values, where the program cannot be executed without them.
    pub(super) events_of_sets: u64,
    pub(super) levels: u16,
    /// Whether the target's machine has numbers of its own: then controls are never in one state.
    pub(super) renamed: bool,
    /// Whether the pairs of events are kept: then no hole passes for both sides by being executed once, and no move of a
    /// program that is kept whole.
    pub(super) watched: bool,
    /// The target knows one level only: the source's are on or off together.
    pub(super) one_level: bool,
    pub(super) start: job::start::Start,
    pub(super) stood: bool,
    /// What the target's control always begins with, and the source's does not.
    pub(super) own_facts: Modes,
    /// What variables may be given.
    pub(super) given: InitialVariables,
    /// What the target computes with.
    pub(super) functions: Vec<Function>,
    /// How far apart two numbers are that the target's own comparisons find equal.
    pub(super) equal_within: Option<Num>,
    /// Whether its comparisons find real numbers equal that are nearly so.
    pub(super) near: bool,
    /// To which digits its lengths are rounded.
    pub(super) fineness: Fineness,
    /// Last place of the source that was executed, for differences without an event.
    pub(super) last: Span,
    /// Variables that the source reads before it sets them, where both sides compute.
    pub(super) outliving: Vec<Outliving>,
    /// What the source assumes of its start so far.
    pub(super) assumed: Modes,
    /// Straight moves one after the other of which fewer are not packed, in a program that is read back whole.
    pub(super) shortest_stretch: usize,
    /// Bytes of a text that is read back whole, between which moves of it are packed.
    pub(super) piece: usize,
    /// What was not executed, or with values that were made up.
    pub(super) notes: Vec<Diagnostic>,
}

/// The output cannot be read back. What the target's control alone refuses depends on what the program computes, and no
/// other words would do.
pub(super) fn unreadable(d: &Diagnostic, at: Span) -> Stop {
    if let Fault::SpindleForCycle { turn, .. } = d.fault {
        return Stop::Source(Diagnostic::new(Fault::SpindleForCycle { turn, by_target: true }, at));
    }
    Stop::Target(Diagnostic::new(Fault::NotReadBack { code: d.fault.code() }, at))
}

#[cfg(test)]
mod tests {
    use ncc_dialects::{Settings, builtin};

    use super::*;
    use crate::job::Job;

    const PIECES: [[&str; 2]; 3] = [
        [
            "%\nO1\nG21 G17 G90 G40 G49 G80 G94\nG54\nT1 M06\nS500 M03\nG00 X0. Y0.\nG43 H1 Z5.\nG01 Z-1. F100.\n",
            "G21 G17 G90 G40 G49 G80 G94\nG54\nT1 M06\nS500 M03\nG00 X0. Y0.\nG43 H1 Z5.\nG01 Z-1. F100.\n",
        ],
        ["X10.\nX10.\n/Y10. Z-1.5\nX0. F200.\nG00 Z5.\n", "X10.\nX 10.\n/ Y10. Z-1.5\nX0. F200.\nG00 Z5.\n"],
        ["X3.\nG01 Y7.\n", "X3. \nG01  Y7.\n"],
    ];

    /// The pairs of all pieces; `compared` has all of them compared event by event.
    fn pairs(compared: bool) -> Vec<Pair> {
        let settings = Settings::new(builtin("fanuc").expect("a built-in dialect"));
        let job = Job::new(settings.clone(), settings, "piece.nc");
        let mut reader = Reader::new(job.from.clone(), true);
        let mut verifier = Verifier::new(&job);
        verifier.watch();
        verifier.renamed = compared;
        let (mut batch, mut found) = (Batch::default(), Vec::new());
        let mut bases = [0; 2];
        for piece in PIECES {
            reader.read(piece[0].as_bytes(), bases[0], &mut batch);
            let stmts = std::mem::take(&mut batch.stmts);
            let verified =
                verifier.piece(&stmts, &batch.assumed, piece[1].as_bytes(), bases[1], &batch.assumed);
            verified.expect("the same program");
            assert!(verifier.runs.iter().all(|run| run.level != compared));
            found.extend(verifier.take_pairs().0);
            bases = [0, 1].map(|side| bases[side] + piece[side].len() as u32);
        }
        found
    }

    /// A map is made of the same pairs, whether lines are executed once or compared.
    #[test]
    fn lines_that_are_executed_once_leave_their_pairs() {
        let found = pairs(false);
        assert_eq!(found, pairs(true));
        assert!(found.len() > 8, "{found:?}");
    }
}
