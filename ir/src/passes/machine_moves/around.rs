//! Takes G91 away that was there for a return to a reference point alone, once the return is a move in machine
//! coordinates, whose words are places in any mode.
//!
//! ```text
//! G91 G28 Z0. / M05 / G90    G53 G0 Z0 / M5
//! ```
//!
//! Not here: moves that are made of returns.

use crate::canon::{Distance, Fact};
use crate::program::{Op, Stmt};

/// Takes it away where G90 follows before anything counts by it. `before` is what is in force before the first statement.
pub(super) fn over(stmts: &mut Vec<Stmt>, mut before: Option<Distance>) {
    let mut at = 0;
    while at < stmts.len() {
        let Op::SetDistanceMode(distance) = stmts[at].op else {
            at += 1;
            continue;
        };
        let taken = match distance {
            Distance::Incremental if stmts[at].skip.is_none() => closes(stmts, at),
            _ => None,
        };
        let Some(close) = taken else {
            before = Some(distance).filter(|_| stmts[at].skip.is_none());
            at += 1;
            continue;
        };
        let absolute = before == Some(Distance::Absolute);
        let last = stmts.get(close + 1).is_none_or(|next| !next.joined);
        let own = &stmts[close];
        if absolute && last && !own.joined && own.number.is_none() && own.comment.is_none() {
            stmts.remove(close);
        }
        match absolute {
            true => {
                let first = stmts.remove(at);
                if let Some(next) = stmts.get_mut(at).filter(|_| !first.joined) {
                    (next.joined, next.number) = (false, first.number);
                }
            }
            false => stmts[at].op = Op::SetDistanceMode(Distance::Absolute),
        }
        before = Some(Distance::Absolute);
    }
}

/// Where G90 follows a G91 in whose block there is a machine move, if nothing between them counts by the mode.
fn closes(stmts: &[Stmt], at: usize) -> Option<usize> {
    let block = stmts[at + 1..].iter().take_while(|stmt| stmt.joined);
    if !block.clone().any(|stmt| matches!(stmt.op, Op::UseMachineCoordinates { .. })) {
        return None;
    }
    let mut machine = false;
    for (place, stmt) in stmts.iter().enumerate().skip(at + 1) {
        machine &= stmt.joined;
        match &stmt.op {
            Op::SetDistanceMode(Distance::Absolute) => return stmt.skip.is_none().then_some(place),
            Op::UseMachineCoordinates { .. } => machine = true,
            Op::StraightTraverse(to) if machine => {
                let places =
                    to.to.axes.iter().flatten().all(|word| word.distance == Fact::Known(Distance::Absolute));
                if !places {
                    return None;
                }
            }
            Op::UseToolLengthOffset(_)
            | Op::Comment(_)
            | Op::Blank
            | Op::StopSpindleTurning
            | Op::CoolantOff
            | Op::SelectPlane(_)
            | Op::SetOriginOffsets(_)
            | Op::SelectTool(_)
            | Op::ChangeTool => {}
            _ => return None,
        }
    }
    None
}
