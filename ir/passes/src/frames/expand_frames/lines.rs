//! Lines where all frames in force are said: they stay as they are, and the tool is followed.

use ncc_exec::Chain;
use ncc_ir::program::{Op, Stmt};

use super::Frames;

impl Frames<'_> {
    /// Whether statements are nothing but lines and feeds, and none of them needs to be changed: what is in force is said as
    /// it stands, no move is asked for both axes of a plane, and a word without a distance mode of its own has one.
    pub(super) fn leaves(&self, stmts: &[Stmt]) -> bool {
        let line = |op: &Op| {
            matches!(
                op,
                Op::StraightTraverse(_)
                    | Op::StraightFeed(_)
                    | Op::SetFeedRate(_)
                    | Op::Comment(_)
                    | Op::Blank
            )
        };
        self.set.chain == Chain::NONE
            && self.set.unplaced.is_none()
            && !self.inner.at.raw
            && self.inner.at.modes.distance.is_some()
            && stmts.iter().all(|stmt| stmt.skip.is_none() && line(&stmt.op))
    }

    /// Goes along them.
    pub(super) fn follow(&mut self, stmts: &[Stmt]) {
        for stmt in stmts {
            self.inner.enter(None);
            self.outer.enter(None);
            self.arcs.step(stmt, &mut self.inner);
            self.outer.step(stmt);
        }
    }
}
