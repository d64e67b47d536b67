//! Centres of arcs that are computed and count from program zero, for a target whose centres count from where the arc
//! starts: where that is, the program asks the control for (`#5001`).
//!
//! Not here: stated centres, which become differences where the start is known, and those of targets
//! whose words say from where they count.

use crate::pass::Pass;
use ncc_ir::canon::Axis;
use ncc_ir::caps::Caps;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::system::System;
use ncc_ir::expr::{Binary, Expr, Node, Var};
use ncc_ir::program::{Arc, Centre, CentreFrom, Op, Program, Stmt};

/// This pass.
pub(crate) const PASS: Pass = Pass::parametric(
    "centres-from-start",
    "measures computed centres of arcs from their start",
    |_, _| true,
    |program, own, _| run(program, own.caps),
);

/// Says them so, for such a target.
pub fn run(program: &mut Program, caps: &Caps) {
    if caps.arcs.centres_from_zero || caps.arcs.forms {
        return;
    }
    program.procedures.iter_mut().for_each(|procedure| within(&mut procedure.body));
}

fn within(body: &mut [Stmt]) {
    for stmt in body {
        match &mut stmt.op {
            Op::Control(control) => control.bodies_mut().for_each(|body| within(body)),
            Op::ArcFeed(arc) => from_start(arc),
            _ => {}
        }
    }
}

fn from_start(arc: &mut Arc) {
    let Centre::Point { words, from: from @ CentreFrom::Zero } = &mut arc.centre else { return };
    let ends = arc.to.axes.iter().flatten().map(|word| &word.value);
    if ends.chain(words.iter().flatten()).all(|value| value.literal().is_some()) {
        return;
    }
    *from = CentreFrom::Start;
    for (axis, word) in [Axis::X, Axis::Y, Axis::Z].into_iter().zip(words) {
        let Some(word) = word else { continue };
        let start = Expr::Node(Box::new(Node::Var(Var::System(System::EndPoint(axis)))));
        // A number in an expression counts in the active unit, in which its word was written.
        let centre = match std::mem::replace(word, Expr::int(0)) {
            Expr::Num(num) => Expr::Num(Num { unit: Unit::One, ..num }),
            centre => centre,
        };
        *word = Expr::Node(Box::new(Node::Binary(Binary::Subtract, centre, start)));
    }
}
