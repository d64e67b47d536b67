//! Moves from machine zero, where a tool change has taken Z, for a target that cannot say that Z is there.
//!
//! A Haas goes up at M06. A Mach-9 lacks machine zero, and whether its own M6 goes up is not known; a list of
//! events has the program's own moves alone. As long as the program says no Z, only its rapid moves are the same:
//!
//! ```text
//! T2 M06
//! G00 X20.          the same
//! G01 X30. F200.    refused: cut at machine zero here, and perhaps at the old Z there
//! G91 G00 Z-10.     refused: it counts from machine zero
//! G00 Z10.          from here on all is known
//! ```
//!
//! Not here: the way up in words (`side_effects`).

use std::collections::{BTreeSet, HashMap};

use ncc_ir::canon::{Axis, Distance};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::lack::MachineLack;
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Control, Op, Point, Procedure, Stmt};
use ncc_ir::source::Span;

use crate::modes::side_effects::SideEffects;
use crate::modes::side_effects::kinds::cuts;

/// Procedures by their names, each with its place.
type Places<'p> = HashMap<&'p str, (usize, &'p Procedure)>;

/// How deep calls are followed.
const MOST_CALLS: usize = 16;

/// Whether Z may be at machine zero, unsaid, where a program stands.
#[derive(Clone, Debug, Default)]
pub(super) struct WayUp {
    /// The source's control goes up at a change, and the target, which lacks it, is taken to do the same.
    taken: bool,
    up: bool,
    /// A jump was made there.
    jumped: bool,
    /// The active motion is a rapid one, by which bare axis words go.
    rapid: bool,
    /// What is refused, once each.
    refused: BTreeSet<Span>,
    /// How calls end that were followed: by procedure, depth, and what held before and after each.
    followed: HashMap<(usize, usize, Held), Held>,
}

/// Z up, a jump made there, the motion rapid.
type Held = [bool; 3];

impl SideEffects {
    /// The target lacks machine zero, and is taken to move Z there at a tool change, as the source does.
    #[must_use]
    pub fn with_way_up_taken(mut self) -> SideEffects {
        self.way_up.taken = true;
        self
    }
}

impl WayUp {
    /// Whether Z may be there.
    pub(super) fn is_up(&self) -> bool {
        self.up
    }

    /// Whether statements are to be looked at.
    pub(super) fn concerns(&self, stmts: &[Stmt]) -> bool {
        self.taken && (self.up || changes(stmts))
    }

    /// Refuses what depends on Z in further statements, or in a whole program, whose procedures it calls.
    pub(super) fn check(&mut self, stmts: &[Stmt], procedures: &[Procedure], diags: &mut Vec<Diagnostic>) {
        if !self.taken {
            return;
        }
        let mut found = Vec::new();
        let places: Places = procedures.iter().enumerate().rev().map(|(at, p)| (&*p.name, (at, p))).collect();
        let procedures = &places;
        self.walk(stmts, procedures, 0, &mut found);
        if self.jumped {
            // What is jumped to may stand before.
            self.walk(stmts, procedures, 0, &mut found);
        }
        self.followed.clear();
        diags.append(&mut found);
    }

    fn walk(&mut self, stmts: &[Stmt], all: &Places, depth: usize, found: &mut Vec<Diagnostic>) {
        let led_to = jumps(stmts);
        for stmt in stmts {
            match &stmt.op {
                Op::ChangeTool => self.up = true,
                Op::Label(_) => {
                    self.up |= self.jumped;
                    self.rapid &= !led_to;
                }
                Op::Goto(_) => self.jumped |= self.up,
                Op::Control(control) => self.bodies(control, all, depth, found),
                Op::Call(call) => match all.get(&*call.name) {
                    Some((at, procedure)) if depth < MOST_CALLS => {
                        // As often as it takes to begin as it ends.
                        for _ in 0..call.times.min(2) {
                            let key = (*at, depth, [self.up, self.jumped, self.rapid]);
                            if let Some(after) = self.followed.get(&key) {
                                [self.up, self.jumped, self.rapid] = *after;
                                continue;
                            }
                            self.walk(&procedure.body, all, depth + 1, found);
                            self.followed.insert(key, [self.up, self.jumped, self.rapid]);
                        }
                    }
                    _ => self.refuse(stmt, found),
                },
                Op::RepeatBlocks(_) => self.refuse(stmt, found),
                Op::Return | Op::Leave | Op::NextTurn => {}
                Op::StraightTraverse(to) => {
                    self.rapid = stmt.skip.is_none();
                    self.rapid(&to.to, stmt, found);
                }
                Op::Position(to) if self.rapid => self.rapid(&to.to, stmt, found),
                op if cuts(op) => {
                    self.rapid = false;
                    self.refuse(stmt, found);
                }
                Op::GoToReference(to) if to.axes[Axis::Z as usize] => self.up &= stmt.skip.is_some(),
                _ => {}
            }
        }
    }

    /// What a structure may leave active is not looked for.
    fn bodies(&mut self, control: &Control, all: &Places, depth: usize, found: &mut Vec<Diagnostic>) {
        let before = self.up;
        let runs_again = !matches!(control, Control::If { .. });
        let mut after = before;
        for body in control.bodies() {
            self.up = before;
            self.rapid = false;
            self.walk(body, all, depth, found);
            if runs_again {
                self.walk(body, all, depth, found);
            }
            after |= self.up;
        }
        (self.up, self.rapid) = (after, false);
    }

    /// A rapid move: by a place along Z it is known again.
    fn rapid(&mut self, to: &Point, stmt: &Stmt, found: &mut Vec<Diagnostic>) {
        match to.get(Axis::Z) {
            None => {}
            Some(word) if word.distance.known() == Some(Distance::Incremental) => self.refuse(stmt, found),
            Some(_) => self.up &= stmt.skip.is_some(),
        }
    }

    /// Refuses a statement that needs Z, once for each change.
    fn refuse(&mut self, stmt: &Stmt, found: &mut Vec<Diagnostic>) {
        if std::mem::take(&mut self.up) && self.refused.insert(stmt.span) {
            found.push(Diagnostic::new(Fault::lacks(MachineLack::ZAfterToolChange), stmt.span));
        }
    }
}

/// Whether a tool change, or a call of what may hold one, is among statements.
fn changes(stmts: &[Stmt]) -> bool {
    stmts.iter().any(|stmt| match &stmt.op {
        Op::ChangeTool => true,
        Op::Control(control) => control.bodies().any(|body| changes(body)),
        op => matches!(op, flow!()),
    })
}

/// Whether a jump is among statements.
fn jumps(stmts: &[Stmt]) -> bool {
    stmts.iter().any(|stmt| match &stmt.op {
        Op::Goto(_) => true,
        Op::Control(control) => control.bodies().any(|body| jumps(body)),
        _ => false,
    })
}
