//! Absolute words of rotary axes that controls do not turn alike: by half a turn or more, the number's way on one and
//! the shortest way on another.
//!
//! Refused, unless both controls are known to turn them in one way. From where nobody knows, nothing is stated.
//!
//! Not here: what each control does ([`ncc_exec`]).

use crate::pass::{Moment, Pass, Step};
use crate::support::walk::Walk;
use ncc_exec::rotary_end;
use ncc_ir::behaviour::{Behaviour, Behaviours};
use ncc_ir::canon::{AXES, Axis, Distance};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::program::{Op, Stmt};

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "rotary-turns",
    about: "refuses turns of rotary axes that the target would make another way",
    alone: None,
    step: Step::at(
        Moment::Arrival,
        |l, p| p.lines.is_none() && l.states.ask(RotaryTurnsState::is_used),
        |l, p| l.states.state_mut::<RotaryTurnsState>().check(p.stmts, &l.walk, p.diags),
    ),
    program: &[],
    parametric: None,
};

/// What both controls do, as far as it is known.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct RotaryTurnsState {
    /// Values that either may have, a bit each.
    values: u8,
    /// Whether somebody has stated both, so that nothing is left to be asked.
    stated: bool,
    /// Axes of which it was asked, a bit each.
    asked: u8,
}

impl RotaryTurnsState {
    pub(crate) fn new(source: &Behaviours, target: &Behaviours, other_control: bool) -> RotaryTurnsState {
        let way = Behaviour::RotaryTurn;
        let of = |all: &Behaviours| {
            let open = (0..way.values().len() as u8).filter(|value| !way.is_rare(*value));
            let open = open.fold(0, |bits, value| bits | 1 << value);
            if all.is_open(way) { open } else { 1 << all.get(way) }
        };
        let values = if other_control { of(source) | of(target) } else { 0 };
        RotaryTurnsState { values, stated: !source.is_open(way) && !target.is_open(way), asked: 0 }
    }

    /// Whether there is more than one.
    pub(crate) fn is_used(&self) -> bool {
        self.values.count_ones() > 1
    }

    /// Asks about words that are not the same under all of them, once for each axis, or refuses them where both controls
    /// are known.
    pub(crate) fn check(&mut self, stmts: &[Stmt], start: &Walk, diags: &mut Vec<Diagnostic>) {
        let turns = |stmt: &Stmt| match &stmt.op {
            Op::StraightTraverse(m) | Op::StraightFeed(m) => {
                m.to.axes[Axis::A as usize..].iter().any(Option::is_some)
            }
            _ => false,
        };
        if !stmts.iter().any(turns) {
            return;
        }
        let (mut walk, mut own_way) = (start.clone(), false);
        for stmt in stmts {
            walk.enter(stmt.skip);
            let to = match &stmt.op {
                Op::StraightTraverse(m) | Op::StraightFeed(m) if !walk.at.raw && !own_way => Some(&m.to),
                _ => None,
            };
            for axis in Axis::A as usize..AXES {
                let Some(word) = to.and_then(|to| to.axes[axis].as_ref()) else { continue };
                let absolute =
                    word.distance.known().or(walk.at.modes.distance) != Some(Distance::Incremental);
                let Some((from, to)) = walk.at.position[axis].zip(walk.at.nanos(&word.value)) else {
                    continue;
                };
                let values = self.values;
                let ends = (0..8).filter(|value| values >> value & 1 == 1);
                let other = ends.map(|value| rotary_end(value, from, to)).find(|end| *end != to);
                let Some(other) = other.filter(|_| absolute) else { continue };
                let bit = 1 << (axis - Axis::A as usize);
                if self.stated || self.asked & bit == 0 {
                    let axis = Axis::ALL[axis];
                    let fault = Fault::RotaryTurnOpen { axis, by: to - from, or: other - from };
                    diags.push(Diagnostic::new(fault, stmt.span));
                }
                self.asked |= bit;
            }
            own_way = match &stmt.op {
                Op::TurnRotaryAxes(_) => true,
                Op::ExactStop => own_way,
                _ => false,
            };
            walk.step(stmt);
        }
    }
}
