//! `rotary-ways`: the direction in which rotary axes turn, for a target that has no such words.
//!
//! Where the axis is known to stand so that the way is the one along the numbers, and less than half a turn, a plain
//! word says it. Another direction, or one from an unknown angle, is refused: how a plain word goes round is each
//! machine's own.

use crate::pass::{Moment, Pass, Step};
use crate::support::needs::TURN;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::rebuild;
use crate::target::Target;
use ncc_ir::canon::{Axis, RotaryWay};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::ONE;
use ncc_ir::lack::WordsLack;
use ncc_ir::program::{Op, Program, Stmt};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "rotary-ways",
    about: "writes the direction of rotary axes by plain words",
    alone: Some(run),
    step: Step::at(
        Moment::Placing,
        |_, p| p.needs(TURN),
        |l, p| state_rotary_ways(p.stmts, &mut p.start.clone(), &l.target, p.diags),
    ),
    program: &[],
    parametric: None,
};

/// Half a turn, in nanos of a degree. Less than that a plain word turns the same way on every machine, whether it
/// goes along the numbers or the shortest way.
const HALF: u64 = 180 * ONE as u64;

/// Leaves out what plain words say.
pub(crate) fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| state_rotary_ways(body, walk, target, diags));
}

/// The same for one piece of a body, which ends with a block.
pub(crate) fn state_rotary_ways(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    if target.caps.moves.rotary_ways {
        return;
    }
    let mut waiting: Option<(Stmt, [Option<RotaryWay>; 3])> = None;
    rebuild(body, |stmt, made| {
        walk.enter(stmt.skip);
        if let Op::TurnRotaryAxes(ways) = stmt.op {
            walk.step(&stmt);
            waiting = Some((stmt.clone(), ways));
            return made.leave_out(stmt);
        }
        if let Op::StraightTraverse(m) | Op::StraightFeed(m) = &stmt.op
            && let Some((said, ways)) = waiting.take()
        {
            for (axis, way) in [Axis::A, Axis::B, Axis::C].into_iter().zip(ways) {
                let Some(way) = way else { continue };
                let from = walk.at.position[axis as usize];
                let to = m.to.get(axis).and_then(|word| walk.at.resolve(word, from));
                let lack = match from.zip(to) {
                    None => WordsLack::RotaryStartUnknown,
                    Some((from, to)) if !way.is_direct(from, to) => WordsLack::RotaryOtherDirection,
                    Some((from, to)) if to.abs_diff(from) < HALF => continue,
                    Some(_) => WordsLack::RotaryHalfTurn,
                };
                diags.push(Diagnostic::new(Fault::lacks(lack), said.span));
            }
        }
        walk.step(&stmt);
        made.push(stmt);
    });
}
