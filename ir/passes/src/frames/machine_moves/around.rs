//! Takes G91 away that was there for a return to a reference point alone, once the return is a move in machine
//! coordinates, whose words are places in any mode.
//!
//! ```text
//! G91 G28 Z0. / M05 / G90    G53 G0 Z0 / M5
//! ```
//!
//! Not here: moves that are made of returns.

use ncc_ir::canon::{Distance, Fact};
use ncc_ir::program::{Op, Stmt};

/// What follows a G91 by which nothing counts.
enum Then {
    /// G90, at this place.
    Absolute(usize),
    /// Another G91, or the end of the program.
    NoMatter,
}

/// Takes it away where G90, another G91 or the program's end follows before anything counts by it. `before` is what is
/// active before the first statement.
pub(super) fn drop_distance_mode(stmts: &mut Vec<Stmt>, mut before: Option<Distance>) {
    let mut at = 0;
    while at < stmts.len() {
        let Op::SetDistanceMode(distance) = stmts[at].op else {
            at += 1;
            continue;
        };
        let taken = match distance {
            Distance::Incremental if stmts[at].skip.is_none() => then(stmts, at),
            _ => None,
        };
        let Some(taken) = taken else {
            before = Some(distance).filter(|_| stmts[at].skip.is_none());
            at += 1;
            continue;
        };
        let absolute = before == Some(Distance::Absolute);
        match taken {
            Then::Absolute(close) if absolute => {
                let last = stmts.get(close + 1).is_none_or(|next| !next.joined);
                let own = &stmts[close];
                if last && !own.joined && own.number.is_none() && own.comment.is_none() {
                    stmts.remove(close);
                }
                take_away(stmts, at);
            }
            Then::Absolute(_) => {
                stmts[at].op = Op::SetDistanceMode(Distance::Absolute);
                before = Some(Distance::Absolute);
            }
            Then::NoMatter => take_away(stmts, at),
        }
    }
}

/// Takes a statement out of its block.
fn take_away(stmts: &mut Vec<Stmt>, at: usize) {
    let first = stmts.remove(at);
    if let Some(next) = stmts.get_mut(at).filter(|_| !first.joined) {
        (next.joined, next.number) = (false, first.number);
    }
}

/// What follows a G91 in whose block there is a machine move, if nothing between them counts by the mode.
fn then(stmts: &[Stmt], at: usize) -> Option<Then> {
    let block = stmts[at + 1..].iter().take_while(|stmt| stmt.joined);
    if !block.clone().any(|stmt| matches!(stmt.op, Op::UseMachineCoordinates { .. })) {
        return None;
    }
    let mut machine = false;
    for (place, stmt) in stmts.iter().enumerate().skip(at + 1) {
        machine &= stmt.joined;
        match &stmt.op {
            Op::SetDistanceMode(distance) => {
                let then = match distance {
                    Distance::Absolute => Then::Absolute(place),
                    Distance::Incremental => Then::NoMatter,
                };
                return stmt.skip.is_none().then_some(then);
            }
            Op::ProgramEnd => return stmt.skip.is_none().then_some(Then::NoMatter),
            Op::UseMachineCoordinates { .. } => machine = true,
            Op::StraightTraverse(to) if machine => {
                let places =
                    to.to.axes.iter().flatten().all(|word| word.distance == Fact::Known(Distance::Absolute));
                if !places {
                    return None;
                }
            }
            Op::UseToolLengthOffset(_)
            | Op::UseToolEdge { .. }
            | Op::Comment(_)
            | Op::Blank
            | Op::Message(_)
            | Op::SetSpindleSpeed(_)
            | Op::StartSpindleClockwise
            | Op::StartSpindleCounterclockwise
            | Op::StopSpindleTurning
            | Op::FloodOn
            | Op::MistOn
            | Op::CoolantOff
            | Op::ProgramStop
            | Op::OptionalProgramStop
            | Op::SelectPlane(_)
            | Op::SetOriginOffsets(_)
            | Op::SelectTool(_)
            | Op::ChangeTool => {}
            _ => return None,
        }
    }
    None
}
