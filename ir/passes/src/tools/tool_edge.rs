//! `tool-edge`: a tool's length by an edge of the tool in the spindle, or by an entry of a table.
//!
//! Edge 1 of tool `n` is entry `n` of the table: an assumption, reported once for each tool. Of a tool whose number is not
//! known it stays edge 1 for a target that activates the length of the tool in the spindle without its number. Another edge
//! has an entry only where the target's settings name one, and no other entry has an edge: else they are refused. On a
//! control with edges a tool change makes edge 1 active by itself, so that what is active after the change is stated
//! there: it moves nothing until Z is commanded, and stands right after the change where nothing commands Z between. An edge of a tool
//! that the program has not called is left out where another follows before Z is commanded.

use crate::pass::{Moment, Pass, Step};
use crate::support::needs::{EDGE, TABLE};
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{Rebuild, rebuild};
use crate::target::Target;
use ncc_ir::caps::LengthsOf;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::lack::{Lack, LengthsLack, ToolsLack};
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Data, Op, Program, Stmt};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "tool-edge",
    about: "names tool lengths by edges of the tool or by entries of a table",
    alone: Some(run),
    step: Step::to_the_end(
        Moment::Wording,
        |_, p| p.needs(EDGE | TABLE),
        |l, p| {
            convert_edges(
                p.stmts,
                &mut p.start.clone(),
                l.states.state_mut::<ToolEdgeState>(),
                &l.target,
                p.diags,
            )
        },
        |l, _, diags| l.states.state_mut::<ToolEdgeState>().finish(diags),
    ),
    program: &[],
    parametric: None,
};

/// What the pass remembers from piece to piece of a body.
#[derive(Clone, Debug, Default)]
pub(crate) struct ToolEdgeState {
    /// Tools of which the assumption has been reported.
    reported: Vec<u32>,
    /// A tool change, or the edge that comes with it, after which Z has not been commanded.
    waiting: Option<Waiting>,
}

#[derive(Clone, Debug)]
struct Waiting {
    /// Its place in what has been made of this piece.
    place: Option<usize>,
    span: Span,
    skip: Option<u8>,
    /// The program says the edge itself.
    said: bool,
    /// Why the edge cannot be stated; told only if it is used, or said and active to the end.
    refused: Option<Fault>,
}

/// What stands for a length that is refused: the edge that comes with the tool, so that the moves after
/// it are not refused for it once more. Nothing is released, for the refusal stays.
const REFUSED: Expr = Expr::int(1);

/// Puts one in the other's place, as the target has it.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| {
        let mut state = ToolEdgeState::default();
        convert_edges(body, walk, &mut state, target, diags);
        state.finish(diags);
    });
}

impl ToolEdgeState {
    /// Whether a tool change waits for the length that is active after it.
    pub(crate) fn is_busy(&self) -> bool {
        self.waiting.is_some()
    }

    /// At the start of another body: no tool change waits, what was reported stays reported.
    pub(crate) fn start_over(&mut self) {
        self.waiting = None;
    }

    /// At the end of a body: what the program says itself is active after it.
    pub(crate) fn finish(&mut self, diags: &mut Vec<Diagnostic>) {
        if let Some(Waiting { refused: Some(fault), span, said: true, .. }) = self.waiting.take() {
            diags.push(Diagnostic::new(fault, span));
        }
    }

    fn tell(&mut self, tool: u32, span: Span, diags: &mut Vec<Diagnostic>) {
        if !self.reported.contains(&tool) {
            self.reported.push(tool);
            diags.push(Diagnostic::new(Fault::AssumedEdge { tool }, span));
        }
    }
}

/// The same for one piece of a body.
pub(crate) fn convert_edges(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    state: &mut ToolEdgeState,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    let edges = match target.caps.tools.lengths_of {
        LengthsOf::Either => return,
        LengthsOf::Edges => true,
        LengthsOf::Entries => false,
    };
    if let Some(waiting) = &mut state.waiting {
        waiting.place = None;
    }
    rebuild(body, |stmt, made| {
        walk.enter(stmt.skip);
        match edges {
            true => to_edges(stmt, walk, state, made, diags),
            false => to_entries(stmt, walk, state, target, made, diags),
        }
    });
}

/// Whether a statement may take a length up, or goes where this pass does not follow.
fn may_command_z(walk: &Walk, op: &Op) -> bool {
    let elsewhere = matches!(op, flow!());
    let unknown = matches!(op, Op::Position(_)) && walk.at.modes.motion.is_none();
    elsewhere || unknown || walk.commands_z(op)
}

fn whole_number(value: &Expr) -> Option<u32> {
    value.literal().and_then(|n| n.whole_number()).and_then(|n| u32::try_from(n).ok())
}

/// The tool in the spindle, if it is known to be one.
fn tool(walk: &Walk) -> Option<u32> {
    walk.at.tool.and_then(|t| u32::try_from(t).ok()).filter(|t| *t > 0)
}

fn cannot(lack: impl Into<Lack>) -> Fault {
    Fault::lacks(lack)
}

/// One statement for a control with a table.
fn to_entries(
    mut stmt: Stmt,
    walk: &mut Walk,
    state: &mut ToolEdgeState,
    target: &Target,
    made: &mut Rebuild,
    diags: &mut Vec<Diagnostic>,
) {
    let Op::UseToolEdge { edge, said } = &stmt.op else {
        if may_command_z(walk, &stmt.op)
            && let Some(Waiting { refused: Some(fault), span, .. }) = state.waiting.take()
        {
            diags.push(Diagnostic::new(fault, span));
        }
        walk.step(&stmt);
        return made.push(stmt);
    };
    let (edge, said) = (edge.clone(), *said);
    let (span, skip) = (stmt.span, stmt.skip);
    let further = |edge, tool| target.further_edges.get(&(tool, edge)).copied();
    let found = match (whole_number(&edge), tool(walk)) {
        (Some(0), _) => Ok(Some(0)),
        // No tool has no length, whatever edge is active.
        (Some(_), _) if walk.at.tool == Some(0) => Ok(Some(0)),
        (Some(1), Some(tool)) => {
            state.tell(tool, span, diags);
            // The tool's own number, unless the machine keeps its length elsewhere.
            Ok(Some(target.edge_entries.get(&tool).copied().unwrap_or(tool)))
        }
        (Some(edge), Some(tool)) if let Some(entry) = further(edge, tool) => Ok(Some(entry)),
        (Some(1), None) if target.caps.tools.own_length => Ok(None),
        (Some(1), None) => Err(cannot(ToolsLack::EdgeOfUnknownTool)),
        (Some(edge), _) => Err(cannot(ToolsLack::EdgeNumber { edge })),
        (None, _) => Err(cannot(ToolsLack::ComputedEdge)),
    };
    // Of a tool that the program has not called, it is needed only where Z moves by it.
    let unknown = whole_number(&edge) == Some(1) && tool(walk).is_none() && walk.at.tool != Some(0);
    walk.step(&stmt);
    if let Some(before) = state.waiting.take() {
        // Nothing has applied the edge that came with the tool.
        if stmt.skip.is_none() || stmt.skip == before.skip {
            if let Some(place) = before.place {
                remove(made, place);
            }
        } else if let Some(fault) = before.refused {
            diags.push(Diagnostic::new(fault, before.span));
        }
    }
    let mut waiting = Waiting { place: None, span, skip, said, refused: None };
    match found {
        Ok(entry) => {
            if let Some(entry) = entry {
                stmt.op = Op::UseToolLengthOffset(Expr::int(i64::from(entry)));
            }
            waiting.place = Some(made.out.len());
            made.push(stmt);
        }
        Err(fault) if said && !unknown => {
            diags.push(Diagnostic::new(fault, span));
            made.push(stmt);
        }
        Err(fault) => {
            waiting.refused = Some(fault);
            made.leave_out(stmt);
        }
    }
    if !said || waiting.refused.is_some() {
        state.waiting = Some(waiting);
    }
}

/// Takes a statement out that was passed on before.
fn remove(made: &mut Rebuild, place: usize) {
    if place >= made.out.len() {
        return;
    }
    let gone = made.out.remove(place);
    let next_joined = made.out.get(place).is_some_and(|s| s.joined);
    if !gone.joined && next_joined {
        if let Some(next) = made.out.get_mut(place) {
            next.joined = false;
            next.number = gone.number;
        }
    } else if let Some(comment) = gone.comment {
        let before = place.checked_sub(1).and_then(|p| made.out.get_mut(p)).filter(|_| gone.joined);
        match before {
            Some(before) => before.comment = Some(comment),
            None => {
                let mut alone = Stmt::new(gone.span, Op::Comment(*comment));
                (alone.number, alone.skip) = (gone.number, gone.skip);
                made.out.insert(place, alone);
            }
        }
    }
}

/// One statement for a control with edges.
fn to_edges(
    mut stmt: Stmt,
    walk: &mut Walk,
    state: &mut ToolEdgeState,
    made: &mut Rebuild,
    diags: &mut Vec<Diagnostic>,
) {
    match &stmt.op {
        Op::ChangeTool => {
            if stmt.skip.is_some() && state.waiting.as_ref().is_some_and(|w| w.skip != stmt.skip) {
                in_force(&mut stmt, walk, state, made, diags);
            }
            walk.step(&stmt);
            let (span, skip) = (stmt.span, stmt.skip);
            state.waiting =
                Some(Waiting { place: Some(made.out.len()), span, skip, said: false, refused: None });
            made.push(stmt);
        }
        // The program knows of edges itself.
        Op::UseToolEdge { .. } => {
            walk.step(&stmt);
            if stmt.skip.is_none() || state.waiting.as_ref().is_some_and(|w| w.skip == stmt.skip) {
                state.waiting = None;
            }
            made.push(stmt);
        }
        Op::UseToolLengthOffset(entry) => {
            let found = edge_of(whole_number(entry), tool(walk));
            let may_be_skipped =
                stmt.skip.is_some() && state.waiting.as_ref().is_some_and(|w| w.skip != stmt.skip);
            if may_be_skipped {
                in_force(&mut stmt, walk, state, made, diags);
            }
            walk.step(&stmt);
            let edge = match found {
                Ok(edge) => edge,
                Err(fault) => {
                    state.waiting = None;
                    diags.push(Diagnostic::new(fault, stmt.span));
                    stmt.op = Op::UseToolEdge { edge: REFUSED, said: true };
                    return made.push(stmt);
                }
            };
            if let (1, Some(tool)) = (edge, tool(walk)) {
                state.tell(tool, stmt.span, diags);
            }
            let op = Op::UseToolEdge { edge: Expr::int(edge), said: true };
            match state.waiting.take().filter(|w| w.skip == stmt.skip).and_then(|w| behind(&w, made)) {
                // In the block of the change it stays, as it does where the change is not in sight.
                Some(place) if place < made.out.len() || !stmt.joined => {
                    let mut new = Stmt::new(stmt.span, op);
                    new.skip = stmt.skip;
                    made.out.insert(place, new);
                    made.leave_out(stmt);
                }
                Some(_) | None => {
                    stmt.op = op;
                    made.push(stmt);
                }
            }
        }
        op => {
            if state.waiting.is_some() && may_command_z(walk, op) {
                in_force(&mut stmt, walk, state, made, diags);
            }
            if state.waiting.is_some() && sets_length(&stmt.op, tool(walk)) {
                diags.push(Diagnostic::new(cannot(LengthsLack::LengthInUse), stmt.span));
            }
            walk.step(&stmt);
            made.push(stmt);
        }
    }
}

/// Whether a statement sets the length of a tool while it counts.
fn sets_length(op: &Op, tool: Option<u32>) -> bool {
    let Op::SetData(data) = op else { return false };
    matches!(**data, Data::Tool { entry, which, kept: false, .. }
        if which.is_offset() && tool.is_none_or(|tool| tool == entry))
}

/// The edge of the tool in the spindle that is an entry of the table.
fn edge_of(entry: Option<u32>, tool: Option<u32>) -> Result<i64, Fault> {
    match (entry, tool) {
        (Some(0), _) => Ok(0),
        (Some(entry), Some(tool)) if entry == tool => Ok(1),
        (Some(entry), Some(tool)) => Err(cannot(LengthsLack::EntryWithTool { entry, tool })),
        (Some(entry), None) => Err(cannot(LengthsLack::EntryWithUnknownTool { entry })),
        (None, _) => Err(cannot(LengthsLack::Computed)),
    }
}

/// Where what stands after the block of a tool change is put, if the change is in this piece.
fn behind(waiting: &Waiting, made: &Rebuild) -> Option<usize> {
    let change = waiting.place?;
    let joined = made.out.get(change + 1..)?.iter().take_while(|s| s.joined).count();
    Some(change + 1 + joined)
}

/// Says after a tool change what was active before it, because `stmt`, which comes next, may take
/// it up.
fn in_force(
    stmt: &mut Stmt,
    walk: &Walk,
    state: &mut ToolEdgeState,
    made: &mut Rebuild,
    diags: &mut Vec<Diagnostic>,
) {
    let Some(waiting) = state.waiting.take() else { return };
    let found = match walk.at.modes.length_offset {
        Some(entry) => edge_of(Some(entry), tool(walk)),
        None => Err(cannot(ToolsLack::ChangeUnderUnknownLength)),
    };
    let edge = match found {
        Ok(edge) => {
            if let (1, Some(tool)) = (edge, tool(walk)) {
                state.tell(tool, waiting.span, diags);
            }
            Expr::int(edge)
        }
        Err(fault) => {
            diags.push(Diagnostic::new(fault, waiting.span));
            REFUSED
        }
    };
    let mut new = Stmt::new(waiting.span, Op::UseToolEdge { edge, said: true });
    new.skip = waiting.skip;
    match behind(&waiting, made) {
        Some(place) if place < made.out.len() || !stmt.joined => made.out.insert(place, new),
        // The same block goes on and commands Z.
        Some(_) => {
            new.joined = true;
            made.push(new);
        }
        // The change is not in sight any more: before this block.
        None => {
            let block = match stmt.joined && made.is_open() {
                true => made.out.iter().rev().take_while(|s| s.joined).count() + 1,
                false => 0,
            };
            made.out.insert(made.out.len().saturating_sub(block), new);
        }
    }
}
