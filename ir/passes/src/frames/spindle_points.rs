//! Where the spindle's end stands, asked of a target that tells of the tool tip alone: along X and Y both are one, along
//! Z they are the tool's length apart.
//!
//! Where frames of the program are active, or the tool is beside its contour, the source's question has no answer
//! (execution refuses it); so what is put in its place is asked where both are in the same coordinates.
//!
//! Not here: targets that do not tell the active length, for which it is refused.

use crate::pass::Pass;
use crate::values::variables::expressions;
use ncc_ir::canon::Axis;
use ncc_ir::expr::system::System;
use ncc_ir::expr::{Binary, Expr, Node, Var};
use ncc_ir::program::Program;

/// This pass.
pub(crate) const PASS: Pass = Pass::parametric(
    "spindle-points",
    "writes places of the spindle that a program reads as the target has them",
    |_, _| true,
    |program, own, _| run(program, own.tells),
);

/// Puts the tip's place there. `tells` is whether the target answers a question, as it is set up.
pub fn run(program: &mut Program, tells: &dyn Fn(&System) -> bool) {
    for procedure in &mut program.procedures {
        expressions(&mut procedure.body, &mut |_, value| by_the_tip(value, tells));
    }
}

fn by_the_tip(value: &mut Expr, tells: &dyn Fn(&System) -> bool) {
    if let Expr::Node(node) = value
        && let Node::Var(Var::System(asked @ System::SpindlePoint(axis))) = &**node
        && !tells(asked)
    {
        let of = |system| Expr::Node(Box::new(Node::Var(Var::System(system))));
        let tip = of(System::EndPoint(*axis));
        match axis {
            Axis::Z if tells(&System::ToolLength) => {
                *value = Expr::binary(Binary::Add, tip, of(System::ToolLength));
            }
            Axis::Z => {}
            _ => *value = tip,
        }
        return;
    }
    value.parts_mut().for_each(|part| by_the_tip(part, tells));
}
