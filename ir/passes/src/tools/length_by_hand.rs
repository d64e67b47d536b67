//! `length-by-hand`: tool lengths for a control that has none, because its tools are changed by hand.
//!
//! ```text
//! T3 M06              M5 M9 G53 G0 Z0 T3 M0
//! G43 H3 Z10.    →    G00 Z10.
//! ```
//!
//! The operator sets the zero of Z by the tool that is put in, so that Z counts from its tip. That is the same cut if all
//! of a tool's moves along Z are measured by its own length, or all of them by none. Anything else is refused: another
//! tool's length, a tool that moves along Z with its length and without, an incremental first move of a tool, and Z of a
//! work offset that the program sets.
//!
//! Not here: the change itself (the writer), and edges of tools (`tool_edge`, which comes before).

use crate::pass::{Moment, Pass, Step};
use crate::support::needs::TABLE;
use crate::support::walk::Walk;
use crate::support::write::rebuild;
use ncc_ir::canon::{Axis, Distance};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::lack::LengthsLack;
use ncc_ir::program::{Data, Op, Stmt};
use ncc_ir::source::Span;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "length-by-hand",
    about: "leaves out lengths where the operator sets the zero of each tool",
    alone: None,
    step: Step::at(
        Moment::Wording,
        |l, p| p.needs(TABLE) && l.target.caps.tools.change_by_hand,
        |l, p| {
            drop_lengths(p.stmts, &mut p.start.clone(), l.states.state_mut::<LengthByHandState>(), p.diags)
        },
    ),
    program: &[],
    parametric: None,
};

/// What is known of the tool in the spindle.
#[derive(Clone, Debug, Default)]
pub(crate) struct LengthByHandState {
    /// Whether Z has moved by its length, or without; `None` if it has not moved.
    used: Option<bool>,
    /// Whether a length that the program states itself may be active.
    stated: bool,
    /// Tools of which the operator's work has been reported.
    reported: Vec<u32>,
    /// A refusal stands, so that no further one follows from it.
    refused: bool,
    /// Where the program has last set Z of a work offset since the tool change.
    offset_z: Option<Span>,
}

impl LengthByHandState {
    /// Whether further moves are to be looked at.
    pub(crate) fn is_busy(&self) -> bool {
        self.used.is_none() || self.offset_z.is_some()
    }
}

/// Leaves lengths out of a piece of a body.
pub(crate) fn drop_lengths(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    state: &mut LengthByHandState,
    diags: &mut Vec<Diagnostic>,
) {
    rebuild(body, |stmt, made| {
        walk.enter(stmt.skip);
        if walk.commands_z(&stmt.op) && !state.stated {
            state.moves_z(&stmt, walk, diags);
        }
        let leaves_out = match &stmt.op {
            Op::ChangeTool => {
                // The operator sets Z again.
                (state.used, state.refused, state.offset_z) = (None, false, None);
                false
            }
            Op::UseToolLengthOffset(entry) => {
                let entry = entry.literal().and_then(|n| n.whole_number());
                let ends_stated = entry == Some(0) && state.stated;
                state.stated = false;
                state.calls(entry, &stmt, walk, diags);
                !ends_stated
            }
            Op::UseToolLength(_) => {
                state.stated = true;
                false
            }
            Op::SetData(data) if sets_z_of_offset(data) => {
                state.offset_z = Some(stmt.span);
                false
            }
            _ => false,
        };
        walk.step(&stmt);
        if leaves_out { made.leave_out(stmt) } else { made.push(stmt) }
    });
}

impl LengthByHandState {
    /// A length is activated.
    fn calls(&mut self, entry: Option<i64>, stmt: &Stmt, walk: &Walk, diags: &mut Vec<Diagnostic>) {
        match (entry, walk.at.tool) {
            (Some(0), _) => {}
            (Some(entry), Some(tool)) if entry == tool => {
                let tool = tool as u32;
                if !self.reported.contains(&tool) {
                    self.reported.push(tool);
                    diags.push(Diagnostic::new(Fault::LengthByHand { tool }, stmt.span));
                }
            }
            (Some(entry), _) => {
                self.refuse(LengthsLack::EntryWithOtherTool { entry }, stmt, diags);
            }
            (None, _) => self.refuse(LengthsLack::Computed, stmt, diags),
        }
    }

    /// Z moves.
    fn moves_z(&mut self, stmt: &Stmt, walk: &Walk, diags: &mut Vec<Diagnostic>) {
        let entry = walk.at.modes.length_offset.filter(|entry| *entry > 0);
        let by_length = entry.is_some();
        let own = entry.is_none_or(|entry| walk.at.tool == Some(i64::from(entry)));
        if !own {
            self.refuse(LengthsLack::ZByOtherLength, stmt, diags);
        } else if by_length && self.used.is_none() && counts_from_z(&stmt.op) {
            // The source adds the length to where Z is. The operator may have left Z anywhere.
            let what = LengthsLack::IncrementTakesLength;
            self.refuse(what, stmt, diags);
        } else if self.used.is_some_and(|used| used != by_length) {
            self.refuse(LengthsLack::WithAndWithout, stmt, diags);
        }
        self.used = Some(by_length);
        if let Some(span) = self.offset_z.take_if(|_| by_length) {
            diags.push(Diagnostic::new(Fault::lacks(LengthsLack::OffsetSetByOperator), span));
        }
    }

    fn refuse(&mut self, lack: LengthsLack, stmt: &Stmt, diags: &mut Vec<Diagnostic>) {
        if !std::mem::replace(&mut self.refused, true) {
            diags.push(Diagnostic::new(Fault::lacks(lack), stmt.span));
        }
    }
}

/// Whether a straight move along Z is incremental.
fn counts_from_z(op: &Op) -> bool {
    let (Op::StraightTraverse(m) | Op::StraightFeed(m)) = op else { return false };
    m.to.get(Axis::Z).is_some_and(|z| z.distance.known() == Some(Distance::Incremental))
}

/// Whether a statement sets Z of a work offset.
fn sets_z_of_offset(data: &Data) -> bool {
    matches!(data, Data::Offset { words, .. } if words[Axis::Z as usize].is_some())
}
