//! A work offset that is set so that words become the coordinates of where the axes stand (LinuxCNC's `G10 L20`), for a
//! control that can only add to its offsets: by the difference, where the place is known.
//!
//! ```text
//! G0 X10 / G10 L20 P1 X0     the offset in force goes 10 mm further along X
//! ```
//!
//! Not here: other offsets than the one in force, whose zero no program knows, and places under a frame, which are not
//! executed.

use super::walk::Walk;
use crate::canon::{Axis, Units};
use crate::caps::Caps;
use crate::expr::Expr;
use crate::num::{Num, Unit};
use crate::program::{Data, DataMode, Op, Stmt};

/// Digits of a difference: both places are exact.
const EXACT: u8 = 9;

/// Whether there is one, and the target cannot say it.
pub(super) fn concerns(stmts: &[Stmt], caps: &Caps) -> bool {
    let [_, adds, here] = caps.offset_data;
    let is = |stmt: &Stmt| matches!(&stmt.op, Op::SetData(data) if matches!(&**data, Data::Offset { mode: DataMode::Here, .. }));
    adds && !here && stmts.iter().any(is)
}

/// Says those whose places are known by what is added.
pub(super) fn over(stmts: &mut [Stmt], mut walk: Walk) {
    for stmt in stmts {
        walk.enter(stmt.skip);
        let before = stmt.clone();
        if let Op::SetData(data) = &mut stmt.op
            && let Data::Offset { offset, mode: mode @ DataMode::Here, words, turn: None } = &mut **data
            && walk.at.modes.work_offset == Some(*offset)
            && let Some(added) = differences(words, &walk)
        {
            (*mode, **words) = (DataMode::Add, added);
        }
        walk.step(&before);
    }
}

/// By how much each coordinate of the words is less than where its axis stands.
fn differences<const N: usize>(words: &[Option<Expr>; N], walk: &Walk) -> Option<[Option<Expr>; N]> {
    let units = walk.at.modes.units?;
    let mut added = [const { None }; N];
    for (axis, word) in words.iter().enumerate() {
        let Some(word) = word else { continue };
        let difference = walk.at.position[axis]?.checked_sub(walk.at.nanos(word)?)?;
        let num = match (Axis::ALL[axis].is_rotary(), units) {
            (true, _) => Num::from_nanos(difference, EXACT, Unit::Degree),
            (false, Units::Mm) => Num::from_nanos(difference, EXACT, Unit::Mm),
            (false, Units::Inch) => {
                let inches = difference.checked_mul(10).filter(|tenths| tenths % 254 == 0)? / 254;
                Num::from_nanos(inches, EXACT, Unit::Inch)
            }
        };
        added[axis] = Some(Expr::Num(num));
    }
    Some(added)
}
