//! Where a canned cycle may be active, across calls, labels and loops.
//!
//! ```text
//! G80 … M98 P100 / G91 G28 Z0.      no cycle is active at G28, if program 100 leaves none active
//! ```
//!
//! Not here: whether a block is allowed while a cycle is active (the front-ends).

use std::collections::{BTreeMap, HashMap};

use super::flow::Flow;
use super::held::Held;
use ncc_ir::canon::Modes;
use ncc_ir::program::{Op, Procedure, Program, Stmt};
use ncc_ir::track::Tracker;

/// Whether a cycle may be active before a statement, by the places of the statements.
#[derive(Clone, Debug)]
pub struct ActiveCycles {
    places: BTreeMap<u32, bool>,
}

impl ActiveCycles {
    /// Looks at a whole program. `entered` says whether a cycle may be active at its first statement. `None` if the
    /// program has a statement that this analysis does not follow.
    pub fn from_procedures(procedures: &[Procedure], entered: bool) -> Option<ActiveCycles> {
        if procedures.iter().any(|procedure| repeats_blocks(&procedure.body)) {
            return None;
        }
        let mut program = Program { procedures: procedures.to_vec(), ..Program::default() };
        let at = Tracker { cycle_in_doubt: entered, modes: Modes::default(), ..Tracker::unknown() };
        let mut flow = Flow::new(&program, Held { at, ..Held::default() });
        flow.active = Some(HashMap::new());
        let settled = flow.until_settled(&mut program);
        settled.then(|| ActiveCycles { places: flow.active.unwrap_or_default().into_iter().collect() })
    }

    /// Whether a cycle may be active in the block that a place of the text is in. Statements that no path reaches have
    /// none.
    pub fn at(&self, place: u32) -> bool {
        self.places.range(..=place).next_back().is_some_and(|(_, active)| *active)
    }
}

/// Whether blocks are repeated by their numbers: which ones, only the executor knows.
fn repeats_blocks(body: &[Stmt]) -> bool {
    body.iter().any(|stmt| match &stmt.op {
        Op::RepeatBlocks(_) => true,
        Op::Control(control) => control.bodies().any(|body| repeats_blocks(body)),
        _ => false,
    })
}
