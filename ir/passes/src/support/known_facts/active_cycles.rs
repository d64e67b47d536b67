//! Where a canned cycle may be active, across calls, labels and loops.
//!
//! ```text
//! G80 … M98 P100 / G91 G28 Z0.      no cycle is active at G28, if program 100 leaves none active
//! ```
//!
//! Not here: whether a block is allowed while a cycle is active (the front-ends).

use std::collections::{BTreeMap, HashMap};

use crate::support::known_facts::{Flow, Held, Ways, places};
use ncc_ir::canon::Modes;
use ncc_ir::program::kinds::flow;
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
    pub fn of(procedures: &[Procedure], entered: bool) -> Option<ActiveCycles> {
        if procedures.iter().any(|procedure| repeats_blocks(&procedure.body)) {
            return None;
        }
        let mut program = Program { procedures: procedures.to_vec(), ..Program::default() };
        let mut flow = Flow { names: places(&program), active: Some(HashMap::new()), ..Flow::default() };
        flow.ways = vec![Ways::default(); program.procedures.len()];
        if let Some(main) = flow.ways.first_mut() {
            let at = Tracker { cycle_in_doubt: entered, modes: Modes::default(), ..Tracker::unknown() };
            main.entry = Some(Held { at, ..Held::default() });
        }
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

/// Notes a statement before it is executed.
pub(super) fn note(active: &mut HashMap<u32, bool>, stmt: &Stmt, before: Option<&Held>) {
    if matches!(stmt.op, flow!()) {
        return;
    }
    let own = before.is_some_and(|held| held.at.cycle.is_some() || held.at.cycle_in_doubt);
    *active.entry(stmt.span.start).or_default() |= own;
}
