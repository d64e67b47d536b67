//! A change of the active work offset, at a known place, in the other of two forms: by the coordinates that the words
//! give to where the axes stand (LinuxCNC's `G10 L20`), and by the difference that a control adds to its offset.
//!
//! ```text
//! G0 X10 / G10 L20 P1 X0       the active offset goes 10 mm further along X
//! G0 X10 / G91 G10 L2 P1 X10   the same
//! ```
//!
//! Not here: other offsets than the active one, whose zero no program knows, and places under a frame, which are not
//! executed.

use crate::pass::{Moment, Pass, Step};
use crate::support::walk::Walk;
use ncc_ir::canon::{Axis, Units};
use ncc_ir::caps::Caps;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::{Data, DataMode, Op, Stmt};

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "offset-here",
    about: "writes work offsets that are set to where the axes stand as the target does",
    alone: None,
    step: Step::at(
        Moment::Arrival,
        |l, p| p.lines.is_none() && concerns(p.stmts, &l.target.caps),
        |l, p| set_offset_here(p.stmts, l.walk.clone(), &l.target.caps),
    ),
    program: &[],
    parametric: None,
};

/// Digits of a difference: both places are exact.
const EXACT: u8 = 9;

/// The form that the target has not, and the one that it has.
fn forms(caps: &Caps) -> Option<[DataMode; 2]> {
    match caps.frames.offset_data {
        [_, true, false] => Some([DataMode::Here, DataMode::Add]),
        [_, false, true] => Some([DataMode::Add, DataMode::Here]),
        [_, true, true] | [_, false, false] => None,
    }
}

/// Whether there is one in a form that the target has not.
pub(crate) fn concerns(stmts: &[Stmt], caps: &Caps) -> bool {
    let Some([lacks, _]) = forms(caps) else { return false };
    let is = |stmt: &Stmt| match &stmt.op {
        Op::SetData(data) => matches!(&**data, Data::Offset { mode, .. } if *mode == lacks),
        _ => false,
    };
    stmts.iter().any(is)
}

/// Says those whose places are known in the other form.
pub(crate) fn set_offset_here(stmts: &mut [Stmt], mut walk: Walk, caps: &Caps) {
    let Some([lacks, has]) = forms(caps) else { return };
    for stmt in stmts {
        walk.enter(stmt.skip);
        let before = stmt.clone();
        if let Op::SetData(data) = &mut stmt.op
            && let Data::Offset { offset, mode, words, turn: None } = &mut **data
            && *mode == lacks
            && walk.at.modes.work_offset == Some(*offset)
            && let Some(other) = differences(words, &walk)
        {
            (*mode, **words) = (has, other);
        }
        walk.step(&before);
    }
}

/// By how much each word is less than the coordinate at which its axis stands: what is added for a coordinate of its own,
/// and the coordinate that an axis gets by what is added.
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
