//! A T in the block of M06, in a form that means the same on every control.
//!
//! ```text
//! T1                          T1
//! M06 T2            →         M06        of a control that puts in the tool that waits,
//!                             T2         and then selects the next
//!
//! T5                          T5
//! T2 M6             →         T2         for a control that may put in T5
//!                             M06
//! ```
//!
//! Not here: what a control puts in (`exec`), and the block that a writer's form of a change makes of the two.

use ncc_ir::behaviour::{Behaviour, Behaviours};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::lack::ToolsLack;
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Op, Procedure, Stmt};

const WITH_CHANGE: Behaviour = Behaviour::ToolWithChange;

/// What is known of the tool that waits for the next change.
#[derive(Clone, Debug, Default, PartialEq)]
enum Waiting {
    /// None does.
    #[default]
    None,
    /// This one.
    Tool(Expr),
    /// Nothing is known of it.
    Unknown,
}

impl Waiting {
    /// Whether another tool than this one may wait.
    fn is_other(&self, tool: &Expr) -> bool {
        match self {
            Waiting::None => false,
            Waiting::Tool(waiting) => waiting.literal().is_none() || waiting != tool,
            Waiting::Unknown => true,
        }
    }
}

/// What is known of tools from statement to statement.
#[derive(Clone, Debug, Default)]
pub(crate) struct ToolWords {
    waiting: Waiting,
    /// What waited before the block at hand selected a tool.
    before: Option<Waiting>,
    /// What waits after the change at hand, where the control puts in what waited before.
    left: Option<Waiting>,
    /// No tool ever waits for its change.
    none_waits: bool,
    /// A selection that goes after the block at hand.
    behind: Option<Stmt>,
}

impl ToolWords {
    /// The end of a piece, which is that of a block.
    pub(crate) fn finish(&mut self, made: &mut Vec<Stmt>) {
        made.extend(self.behind.take());
    }

    /// Looks at a program that is kept whole: where each T stands beside its M06, no tool ever waits.
    pub(crate) fn survey(&mut self, procedures: &[Procedure]) {
        self.none_waits = !procedures.iter().any(|procedure| selects_ahead(&procedure.body));
    }

    /// Control comes from elsewhere.
    pub(crate) fn elsewhere(&mut self) {
        self.waiting = if self.none_waits { Waiting::None } else { Waiting::Unknown };
        self.before = None;
    }

    /// Before a statement is put after those of `made`.
    pub(crate) fn before(&mut self, stmt: &Stmt, made: &mut Vec<Stmt>) {
        if !stmt.joined {
            self.before = None;
            made.extend(self.behind.take());
        }
    }

    /// Notes a statement that is left as it is.
    pub(crate) fn note(&mut self, stmt: &Stmt) {
        if !stmt.joined {
            self.before = None;
        }
        let sure = stmt.skip.is_none();
        match &stmt.op {
            Op::SelectTool(tool) => {
                let now = if sure { Waiting::Tool(tool.clone()) } else { Waiting::Unknown };
                self.before = Some(std::mem::replace(&mut self.waiting, now));
            }
            Op::SelectToolByName(_) => {
                self.before = Some(std::mem::replace(&mut self.waiting, Waiting::Unknown));
            }
            Op::ChangeTool => {
                let left = self.left.take().unwrap_or_default();
                self.waiting = if sure { left } else { Waiting::Unknown };
            }
            flow!() => self.elsewhere(),
            _ => {}
        }
    }

    /// A tool change: parts it from the T of its block where the two controls may put in two tools.
    pub(crate) fn change(
        &mut self,
        [source, target]: [&Behaviours; 2],
        stmt: &mut Stmt,
        made: &mut Vec<Stmt>,
        diags: &mut Vec<Diagnostic>,
    ) {
        let Some(before) = self.before.take().filter(|_| stmt.joined) else { return };
        let first = (0..made.len()).rev().find(|at| !made[*at].joined).unwrap_or(0);
        let selects = |stmt: &Stmt| matches!(stmt.op, Op::SelectTool(_));
        let Some(at) = (first..made.len()).rev().find(|at| selects(&made[*at])) else { return };
        let Op::SelectTool(tool) = &made[at].op else { return };
        if !before.is_other(tool) {
            return;
        }
        let waits = source.surely(WITH_CHANGE);
        self.left = waits.then(|| Waiting::Tool(tool.clone()));
        match (waits, before) {
            (true, _) if target.surely(WITH_CHANGE) => {}
            (true, Waiting::Tool(waiting)) if waiting.literal().is_some() && tool.literal().is_some() => {
                let mut selection = made.remove(at);
                if !selection.joined {
                    // The block keeps its number, and its jump target, at what is first now.
                    match made.get_mut(at) {
                        Some(next) => {
                            (next.joined, next.number) = (false, selection.number.take());
                        }
                        None => (stmt.joined, stmt.number) = (false, selection.number.take()),
                    }
                }
                selection.joined = false;
                self.behind = Some(selection);
                diags.push(written(stmt));
            }
            (true, _) => {
                diags.push(Diagnostic::new(Fault::lacks(ToolsLack::ChangeOfSelected), stmt.span));
            }
            (false, _) if source.is_open(WITH_CHANGE) => {}
            (false, _) if target.does(WITH_CHANGE) || target.is_open(WITH_CHANGE) => {
                stmt.joined = false;
                diags.push(Diagnostic::new(Fault::BlockSplit, stmt.span));
            }
            (false, _) => {}
        }
    }
}

/// Whether a block selects a tool that it does not change to.
fn selects_ahead(body: &[Stmt]) -> bool {
    let mut selected = false;
    for stmt in body {
        if !stmt.joined && std::mem::take(&mut selected) {
            return true;
        }
        match &stmt.op {
            Op::SelectTool(_) | Op::SelectToolByName(_) => selected = true,
            Op::ChangeTool => selected = false,
            Op::Control(control) if control.bodies().any(|body| selects_ahead(body)) => return true,
            _ => {}
        }
    }
    selected
}

fn written(stmt: &Stmt) -> Diagnostic {
    Diagnostic::new(Fault::SideEffectWritten { behaviour: WITH_CHANGE }, stmt.span)
}
