//! Passes that the user asks for by name, and folding of long-hand blocks into cycles and
//! patterns.
//!
//! Folding works on a streamed program: statements that may start a hole or a pattern are held
//! until a statement follows that belongs to neither.

use ncc_ir::canon::{Axis, Modes};
use ncc_ir::caps::Caps;
use ncc_ir::diag::Diagnostic;
use ncc_ir::program::{Op, Procedure, Program, Stmt};
use ncc_ir::track::Tracker;
use ncc_passes::flow::flatten;
use ncc_passes::watch::ran_whole;
use ncc_passes::{FOLDS, FOLDS_OF_EVENTS, PASSES, Pass, Target};

use crate::stretches::{Packer, Words};

/// Pass that executes what is computed.
pub const FLATTEN: &str = "flatten";

/// Most held statements; a program of holes only is folded in parts of this size.
const MOST_HELD: usize = 1 << 16;

/// The pass of this name, if the user may ask for it.
pub fn pass(name: &str) -> Option<&'static Pass> {
    PASSES.iter().find(|pass| pass.name == name && pass.alone.is_some())
}

/// Runs passes on a program, one after the other. A requested expansion expands everything,
/// whatever the target takes; a fold writes only forms that the target takes.
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
        let Some(run) = pass.alone else { continue };
        run(program, target, entry, found);
        ran_whole(pass.name, program);
    }
}

/// Runs `flatten` alone, as [`run`] does; what it executes is packed as it comes, in stretches of so many moves or more.
pub fn flatten(
    program: &mut Program,
    target: &Target,
    entry: &Tracker,
    found: &mut Vec<Diagnostic>,
    shortest: usize,
) {
    let nothing = Target { caps: Caps::default(), ..target.clone() };
    let mut packer = Some(Packer::new(shortest, Words::Literal));
    let mut pack = |body: &mut Vec<Stmt>, over: bool| match &mut packer {
        Some(packer) if !over => packer.pack(body, usize::MAX),
        packer => packer.take().into_iter().for_each(|packer| packer.finish(body, usize::MAX)),
    };
    flatten::run_packing(program, &nothing, entry, found, &mut pack);
    ran_whole(FLATTEN, program);
}

/// The passes that fold a program, or an event list.
pub fn folds(events: bool) -> Vec<&'static Pass> {
    let names = if events { FOLDS_OF_EVENTS } else { FOLDS };
    names.iter().filter_map(|name| pass(name)).collect()
}

/// Folds a streamed program.
pub struct Folder {
    passes: Vec<&'static Pass>,
    target: Target,
    /// Statements that wait for the next ones.
    held: Vec<Stmt>,
    /// The state before the held statements.
    pub entry: Tracker,
    assumed: Modes,
}

impl Folder {
    pub(crate) fn new(target: Target, entry: Tracker, events: bool) -> Folder {
        Folder { passes: folds(events), target, held: Vec::new(), entry, assumed: Modes::default() }
    }

    /// Adds statements. Returns those that need not wait, as they were; `stmts` gets them folded.
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
            // Keep blocks whole.
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

    /// The held statements, for a program whose rest is kept whole.
    pub fn held(&mut self) -> Vec<Stmt> {
        std::mem::take(&mut self.held)
    }

    /// Takes over modes that were assumed since the last call.
    fn assume(&mut self, assumed: &Modes) {
        if self.assumed == *assumed {
            return;
        }
        self.entry.modes = self.entry.modes.or(*assumed);
        self.assumed = *assumed;
    }
}

/// Whether a statement can belong neither to a hole nor to a pattern: a cut in the plane, an arc, a
/// tool change, the end.
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
