//! What F counts on arcs under cutter compensation, stated before compensation starts, where the target has a code for it
//! and counts otherwise:
//!
//! ```text
//! G41 D1 X0.  →  CFTCP
//!                G41 D1 X0
//! ```

use crate::modes::side_effects::SideEffects;
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::AdviceKind;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::geometry::arc_feed::ArcFeed;
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Advice, Op, Procedure, Stmt};
use ncc_ir::source::Span;

impl SideEffects {
    /// The target has codes for what F counts on arcs under cutter compensation: the source's meaning is stated where the
    /// target begins with another one, or may.
    #[must_use]
    pub fn with_arc_feed(mut self) -> SideEffects {
        let fact = Behaviour::FeedOnArcs;
        let differ = self.source.get(fact) != self.target.get(fact);
        let open = self.target.is_open(fact) && !self.source.is_open(fact);
        self.arc_feed = (differ || open).then(|| ArcFeed::from_behaviours(&self.source));
        self
    }

    /// Whether what F counts on arcs is to be stated in one of these statements.
    pub(super) fn states_arc_feed(&self, stmts: &[Stmt]) -> bool {
        self.arc_feed.is_some() && !self.arc_feed_said && compensated(stmts).is_some()
    }

    /// States what F counts on arcs, in a block before the one at hand; `at` is where compensation starts.
    pub(super) fn state_arc_feed(
        &mut self,
        joined: &mut bool,
        at: Span,
        made: &mut Vec<Stmt>,
        diags: &mut Vec<Diagnostic>,
    ) {
        let Some(feed) = self.arc_feed.filter(|_| !self.arc_feed_said) else { return };
        let mut place = made.len();
        if *joined {
            place = (0..made.len()).rev().find(|at| !made[*at].joined).unwrap_or(0);
            // What jumps to the block comes to the statement too.
            if matches!(made[place].op, Op::Label(_)) {
                (place, *joined) = (made.len(), false);
            }
        }
        made.insert(place, Stmt::new(at, stated(feed)));
        let behaviour = Behaviour::FeedOnArcs;
        diags.push(Diagnostic::new(Fault::SideEffectWritten { behaviour }, at));
        self.arc_feed_said = true;
    }

    /// States what F counts on arcs where a whole program begins, for all its procedures.
    pub(super) fn arc_feed_at_head(&mut self, procedures: &mut [Procedure], diags: &mut Vec<Diagnostic>) {
        let start = procedures.iter().find_map(|procedure| compensated(&procedure.body));
        let (Some(feed), Some(start), Some(main)) = (self.arc_feed, start, procedures.first_mut()) else {
            return;
        };
        self.arc_feed_at_head = true;
        let body = &mut main.body;
        let goes = |stmt: &Stmt| matches!(stmt.op, flow!() | Op::StartCutterRadiusCompensation { .. });
        let first = body.iter().position(goes).unwrap_or(body.len());
        if body[..first].iter().any(states) {
            self.arc_feed_said = true;
            return;
        }
        let place = (0..=first).rev().find(|at| body.get(*at).is_none_or(|stmt| !stmt.joined)).unwrap_or(0);
        body.insert(place, Stmt::new(start, stated(feed)));
        let behaviour = Behaviour::FeedOnArcs;
        diags.push(Diagnostic::new(Fault::SideEffectWritten { behaviour }, start));
        self.arc_feed_said = true;
    }
}

/// Where cutter compensation starts in statements, or in bodies among them.
pub(super) fn compensated(stmts: &[Stmt]) -> Option<Span> {
    stmts.iter().find_map(|stmt| match &stmt.op {
        Op::StartCutterRadiusCompensation { .. } => Some(stmt.span),
        Op::Control(control) => control.bodies().find_map(|body| compensated(body)),
        _ => None,
    })
}

/// Whether a statement surely states what F counts on arcs.
pub(super) fn states(stmt: &Stmt) -> bool {
    matches!(&stmt.op, Op::Advise(advice) if advice.kind == AdviceKind::CompensatedFeed)
        && stmt.skip.is_none()
}

/// The operation that states what F counts on arcs.
fn stated(feed: ArcFeed) -> Op {
    let (kind, value) = (AdviceKind::CompensatedFeed, feed.advice());
    Op::Advise(Box::new(Advice { kind, value, amount: None }))
}
