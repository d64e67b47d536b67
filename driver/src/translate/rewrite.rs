//! Rewriting that the user asks for: passes by name, and folding long-hand text back into cycles and
//! patterns.
//!
//! Folding works on a program that streams: what could be the beginning of a hole or of a pattern is
//! held back until a statement comes that can be part of neither.

use ncc_ir::canon::{Axis, Modes};
use ncc_ir::caps::Caps;
use ncc_ir::diag::Diagnostic;
use ncc_ir::program::{Op, Procedure, Program, Stmt};
use ncc_ir::track::Tracker;
use ncc_passes::watch::ran_whole;
use ncc_passes::{FOLDS, FOLDS_OF_EVENTS, PASSES, Pass, Target};

/// Statements that are held back at most; a program of holes alone is folded in stretches.
const MOST_HELD: usize = 1 << 16;

/// The pass of a name.
pub fn pass(name: &str) -> Option<&'static Pass> {
    PASSES.iter().find(|pass| pass.name == name)
}

/// Runs passes on a program, one after the other. An expansion that is asked for expands everything,
/// whatever the target could say; a fold writes what the target can say.
pub fn run(
    passes: &[&'static Pass],
    program: &mut Program,
    target: &Target,
    entry: &Tracker,
    found: &mut Vec<Diagnostic>,
) {
    let nothing = Target { caps: Caps::default(), ..target.clone() };
    for pass in passes {
        let target = if FOLDS_OF_EVENTS.contains(&pass.name) { target } else { &nothing };
        (pass.run)(program, target, entry, found);
        ran_whole(pass.name, program);
    }
}

/// The passes that fold a program, or a list of events.
pub fn folds(events: bool) -> Vec<&'static Pass> {
    let names = if events { FOLDS_OF_EVENTS } else { FOLDS };
    names.iter().filter_map(|name| pass(name)).collect()
}

/// Folding of a program that streams.
pub struct Folder {
    passes: Vec<&'static Pass>,
    target: Target,
    /// Statements that more may have to be known about.
    held: Vec<Stmt>,
    /// What holds before the held ones.
    pub entry: Tracker,
    assumed: Modes,
}

impl Folder {
    pub(crate) fn new(target: Target, entry: Tracker, events: bool) -> Folder {
        Folder { passes: folds(events), target, held: Vec::new(), entry, assumed: Modes::default() }
    }

    /// Further statements. What need not be held back is given as it was, and folded.
    pub fn piece(
        &mut self,
        stmts: &mut Vec<Stmt>,
        assumed: &Modes,
        over: bool,
        found: &mut Vec<Diagnostic>,
    ) -> Vec<Stmt> {
        self.assume(assumed);
        self.held.append(stmts);
        let ready = if over || self.held.len() > MOST_HELD {
            self.held.len()
        } else {
            // A block stays whole.
            let end = self.held.iter().rposition(|s| separates(&s.op)).map_or(0, |at| at + 1);
            end + self.held[end..].iter().take_while(|s| s.joined).count()
        };
        let original: Vec<Stmt> = self.held.drain(..ready).collect();
        let procedures = vec![Procedure { body: original.clone(), ..Procedure::default() }];
        let mut program = Program { procedures, ..Program::default() };
        run(&self.passes, &mut program, &self.target, &self.entry, found);
        for stmt in &original {
            self.entry.step(stmt);
        }
        if let Some(main) = program.procedures.first_mut() {
            stmts.append(&mut main.body);
        }
        original
    }

    /// The statements that are held back, for a program of which the rest is kept whole.
    pub fn held(&mut self) -> Vec<Stmt> {
        std::mem::take(&mut self.held)
    }

    /// Takes over facts that were taken for granted since the last time.
    fn assume(&mut self, assumed: &Modes) {
        if self.assumed == *assumed {
            return;
        }
        self.entry.modes = self.entry.modes.or(*assumed);
        self.assumed = *assumed;
    }
}

/// Whether a statement can be part neither of a hole nor of a pattern: a cut in the plane, an arc, a
/// change of the tool, the end.
fn separates(op: &Op) -> bool {
    match op {
        Op::StraightFeed(m) => {
            [Axis::X, Axis::Y].into_iter().any(|axis| m.to.get(axis).is_some()) && m.to.get(Axis::Z).is_none()
        }
        Op::ArcFeed(_) | Op::ArcForm(_) | Op::ChangeTool | Op::EndCycle | Op::ProgramEnd | Op::BeginAgain => {
            true
        }
        Op::Polar(polar) => !matches!(polar.op, Op::Hole(_) | Op::Position(_)),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ncc_ir::canon::{Plane, Units};
    use ncc_ir::source::Span;

    #[test]
    fn what_the_program_has_said_is_not_taken_for_granted() {
        let target = Target::default();
        let mut folder = Folder::new(target, Tracker::default(), false);
        let mut said =
            [Op::SelectPlane(Plane::Yz), Op::ChangeTool].map(|op| Stmt::new(Span::default(), op)).to_vec();
        folder.piece(&mut said, &Modes::default(), false, &mut Vec::new());
        let assumed = Modes { plane: Some(Plane::Xy), units: Some(Units::Mm), ..Modes::default() };
        folder.piece(&mut Vec::new(), &assumed, false, &mut Vec::new());
        assert_eq!(folder.entry.modes.plane, Some(Plane::Yz), "the program's own word");
        assert_eq!(folder.entry.modes.units, Some(Units::Mm), "what it never said");
    }
}
