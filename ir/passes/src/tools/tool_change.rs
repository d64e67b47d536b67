//! A target whose tool change leaves the spindle stopped, for programs in which it goes on turning: what
//! they do before they say anything of the spindle would be done with another one, and is refused.
//!
//! Nothing is put in: with which tool a spindle may turn how fast is not for a translation to say.

use crate::pass::{Moment, Pass, Step};
use ncc_ir::behaviour::Behaviour;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::lack::{HolesLack, ToolsLack};
use ncc_ir::program::kinds::{flow, machine, moves};
use ncc_ir::program::{Op, Stmt};
use ncc_ir::source::Span;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "tool-change",
    about: "starts the spindle again after a tool change that stops it on the target alone",
    alone: None,
    step: Step::to_the_end(
        Moment::Arrival,
        |l, _| l.target.caps.tools.change_stops_spindle,
        |l, p| {
            let up = l.target.caps.behaviours.surely(Behaviour::ZAtChange);
            l.states.state_mut::<ToolChangeState>().check_changes(p.stmts, up, p.diags);
        },
        |l, _, diags| l.states.state_mut::<ToolChangeState>().finish(diags),
    ),
    program: &[],
    parametric: None,
};

/// What the statements so far leave.
#[derive(Clone, Debug, Default)]
pub(crate) struct ToolChangeState {
    /// The spindle may turn.
    turning: bool,
    /// The tool change over which it may have gone on, if nothing has been said of it since.
    open: Option<(Span, Option<u8>)>,
    /// A canned cycle may be active.
    cycle: bool,
}

impl ToolChangeState {
    /// A subprogram: its caller may have left the spindle turning.
    pub(crate) fn start_over(&mut self) {
        *self = ToolChangeState { turning: true, open: None, cycle: false };
    }

    /// The text of a main program ends, which may lack its end.
    pub(crate) fn finish(&mut self, diags: &mut Vec<Diagnostic>) {
        if let Some((at, _)) = self.open.take() {
            diags.push(goes_on(at));
        }
    }

    /// Looks at further statements; `up`: Z goes to machine zero for the change, where only a cut needs the spindle.
    pub(crate) fn check_changes(&mut self, stmts: &[Stmt], up: bool, diags: &mut Vec<Diagnostic>) {
        for stmt in stmts {
            if self.open.is_some() && needs_spindle(&stmt.op) && !(up && only_moves(&stmt.op)) {
                let at = self.open.take().map_or(stmt.span, |(at, _)| at);
                diags.push(goes_on(at));
            }
            let sure = stmt.skip.is_none();
            match stmt.op {
                Op::StartCycle(_) => self.cycle = true,
                Op::EndCycle | moves!() => self.cycle &= !sure,
                Op::ChangeTool if up && self.cycle => {
                    diags.push(Diagnostic::new(Fault::lacks(HolesLack::ToolChangeInCycle), stmt.span));
                }
                _ => {}
            }
            if up && sure && matches!(stmt.op, Op::ProgramEnd) {
                self.open = None;
            }
            let said = matches!(
                stmt.op,
                Op::StartSpindleClockwise
                    | Op::StartSpindleCounterclockwise
                    | Op::StopSpindleTurning
                    | Op::OrientSpindle(_)
            );
            if said && self.open.is_some_and(|(_, skip)| sure || skip == stmt.skip) {
                self.open = None;
            }
            if matches!(stmt.op, Op::ChangeTool) && self.turning {
                self.open = Some((stmt.span, stmt.skip));
            } else if matches!(stmt.op, Op::StopSpindleTurning | Op::OrientSpindle(_)) {
                self.turning &= !sure;
            } else if let Op::StartCycle(cycle) = &stmt.op {
                self.turning |= cycle.kind.drives_spindle();
            } else {
                self.turning |= said || matches!(stmt.op, flow!());
            }
        }
    }
}

fn goes_on(at: Span) -> Diagnostic {
    Diagnostic::new(Fault::lacks(ToolsLack::SpindleTurnsAtChange), at)
}

/// Whether a statement cuts nothing, and goes nowhere but rapidly.
fn only_moves(op: &Op) -> bool {
    matches!(
        op,
        Op::StraightTraverse(_)
            | Op::GoToReference(_)
            | Op::Dwell(_)
            | Op::FloodOn
            | Op::MistOn
            | Op::CoolantOff
            | Op::Message(_)
            | Op::ChangeTool
            | Op::ProgramStop
            | Op::OptionalProgramStop
            | Op::ProgramEnd
            | Op::BeginAgain
    )
}

/// Whether a statement makes something happen, for which it matters what the spindle does.
fn needs_spindle(op: &Op) -> bool {
    matches!(
        op,
        Op::Position(_)
            | Op::Hole(_)
            | Op::Pattern(_)
            | Op::Dwell(_)
            | Op::FloodOn
            | Op::MistOn
            | Op::CoolantOff
            | Op::MachineFunction(_)
            | Op::Message(_)
            | Op::ChangeTool
            | Op::ProgramStop
            | Op::OptionalProgramStop
            | Op::ProgramEnd
            | Op::BeginAgain
            | moves!()
            | machine!()
            | flow!()
    )
}
