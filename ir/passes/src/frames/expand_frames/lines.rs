//! Lines where all active frames are stated: they stay as they are, and the tool is followed.

use ncc_exec::Chain;
use ncc_ir::program::{Op, Stmt};

use super::{ExpandFramesState, Frames, Set};
use crate::support::walk::Walk;

impl ExpandFramesState {
    /// Whether a frame is active and leaves these statements as they are.
    pub(crate) fn leaves(&self, stmts: &[Stmt]) -> bool {
        self.framed.as_ref().is_some_and(|framed| framed.0.leaves(&framed.1, stmts))
    }
}

impl Set {
    /// Whether statements are nothing but lines and feeds, and none of them needs to be changed: what is active is stated as
    /// it stands, no move is asked for both axes of a plane, and a word without a distance mode of its own has one.
    fn leaves(&self, inner: &Walk, stmts: &[Stmt]) -> bool {
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
        self.chain == Chain::NONE
            && self.unplaced.is_none()
            && !inner.at.raw
            && inner.at.modes.distance.is_some()
            && stmts.iter().all(|stmt| stmt.skip.is_none() && line(&stmt.op))
    }
}

impl Frames<'_> {
    /// Whether none of these statements needs to be changed.
    pub(super) fn leaves(&self, stmts: &[Stmt]) -> bool {
        self.set.leaves(&self.inner, stmts)
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
