//! `offset-with-z`: a tool-length offset goes into the block that next commands the Z axis.
//!
//! An offset moves nothing and takes effect with the next command of Z, so that the machine does the
//! same. It stands in a block with Z because some controls move the axis by the offset at once if
//! it stands alone (16-C; 30i-C, parameter 5006#6).

use crate::pass::{Moment, Pass, Step};
use crate::support::needs::LENGTH;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::Rebuild;
use crate::target::Target;
use ncc_ir::canon::Axis;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::lack::LengthsLack;
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Op, Program, Stmt, ToolLength};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "offset-with-z",
    about: "moves a tool-length offset into the block that takes it up",
    alone: Some(run),
    step: Step::to_the_end(
        Moment::Wording,
        |_, p| p.needs(LENGTH),
        |l, p| delay_offset(p.stmts, &mut p.start.clone(), l.states.state_mut::<OffsetWithZState>(), p.diags),
        |l, stmts, _| l.states.state_mut::<OffsetWithZState>().flush(stmts),
    ),
    program: &[],
    parametric: None,
};

/// What the pass remembers from piece to piece of a body.
#[derive(Clone, Debug, Default)]
pub(crate) struct OffsetWithZState {
    waiting: Option<Waiting>,
    /// Number of the present block.
    block: u64,
    /// The program returns to a caller that is not in the text, so that no offset may wait at its end.
    alone: bool,
}

#[derive(Clone, Debug)]
struct Waiting {
    entry: Expr,
    span: Span,
    skip: Option<u8>,
    /// Number of its block.
    block: u64,
    /// It has been reported.
    reported: bool,
    /// Whether it is active already: where no move along Z comes, nothing is lost without it.
    in_force: bool,
}

/// Moves the offsets.
pub fn run(program: &mut Program, _: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| {
        let mut state = OffsetWithZState::default();
        delay_offset(body, walk, &mut state, diags);
        state.flush(body);
    });
}

impl OffsetWithZState {
    /// The program is a subprogram without its main program.
    pub(crate) fn stands_alone(&mut self) {
        self.alone = true;
    }

    /// Whether the end of an offset that waits goes into the block of a move to a reference point: Z goes there whatever
    /// its length.
    fn ends_on_the_way(&self, stmt: &Stmt) -> bool {
        let Op::GoToReference(to) = &stmt.op else { return false };
        let goes = to.axes[Axis::Z as usize] && to.via.get(Axis::Z).is_none();
        let ends = |waiting: &Waiting| waiting.skip == stmt.skip && is_zero(&waiting.entry);
        self.alone && goes && self.waiting.as_ref().is_some_and(ends)
    }

    /// Whether an offset waits.
    pub(crate) fn is_busy(&self) -> bool {
        self.waiting.is_some()
    }

    /// The end of the body: an offset that nothing applies stands where it may do no harm, last.
    pub(crate) fn flush(&mut self, body: &mut Vec<Stmt>) {
        if let Some(waiting) = self.waiting.take().filter(|waiting| !waiting.in_force) {
            body.push(waiting.into_stmt());
        }
    }
}

impl Waiting {
    fn into_stmt(self) -> Stmt {
        let mut stmt = Stmt::new(self.span, Op::UseToolLengthOffset(self.entry));
        stmt.skip = self.skip;
        stmt
    }
}

/// The same for one piece of a body.
pub(crate) fn delay_offset(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    state: &mut OffsetWithZState,
    diags: &mut Vec<Diagnostic>,
) {
    let input = std::mem::take(body);
    let mut made = Rebuild::new(input.len() + 1);
    for stmt in input {
        walk.enter(stmt.skip);
        state.block = state.block.wrapping_add(u64::from(!stmt.joined));
        let commands = walk.commands_z(&stmt.op) || calls_up(walk, &stmt.op);
        let leaves = leaves(&stmt.op);
        let with_tip = made.out.last().is_some_and(|last| matches!(last.op, Op::UseToolCentrePoint(_)));
        match &stmt.op {
            // One word says both, where it stands.
            Op::UseToolLengthOffset(_) if stmt.joined && with_tip => {
                walk.step(&stmt);
                if let Some(before) = state.waiting.take()
                    && before.skip.is_some()
                {
                    cannot(diags, before.span);
                }
                made.push(stmt);
            }
            Op::UseToolLengthOffset(entry) => {
                let in_force = state.waiting.is_none() && stmt.skip.is_none() && is_in_force(walk, entry);
                walk.step(&stmt);
                if let Some(before) = state.waiting.take()
                    && before.skip != stmt.skip
                    && stmt.skip.is_some()
                {
                    // With the switch on, the one before is still the one that waits.
                    cannot(diags, stmt.span);
                }
                state.waiting = Some(Waiting {
                    entry: entry.clone(),
                    span: stmt.span,
                    skip: stmt.skip,
                    block: state.block,
                    reported: false,
                    in_force,
                });
                made.leave_out(stmt);
            }
            // A length by value takes the place of the one that waits.
            Op::UseToolLength(length) if state.waiting.is_some() => {
                walk.step(&stmt);
                if let Some(before) = state.waiting.take()
                    && !(matches!(**length, ToolLength::Value(_))
                        && stmt.skip.is_none_or(|_| stmt.skip == before.skip))
                {
                    cannot(diags, before.span);
                }
                made.push(stmt);
            }
            _ if state.waiting.is_some() && commands || state.ends_on_the_way(&stmt) => {
                walk.step(&stmt);
                take_up(stmt, state, &mut made, diags);
            }
            Op::ProgramEnd | Op::BeginAgain if state.waiting.is_some() => {
                walk.step(&stmt);
                match state.waiting.take() {
                    Some(waiting) if !waiting.in_force => put_before(stmt, waiting.into_stmt(), &mut made),
                    Some(_) | None => made.push(stmt),
                }
            }
            _ if leaves && state.waiting.is_some() => {
                walk.step(&stmt);
                if let Some(waiting) = state.waiting.take() {
                    cannot(diags, waiting.span);
                    put_before(stmt, waiting.into_stmt(), &mut made);
                }
            }
            _ => {
                walk.step(&stmt);
                made.push(stmt);
            }
        }
    }
    *body = made.out;
}

/// Whether an entry is surely active, and its values are those that it was activated with.
fn is_in_force(walk: &Walk, entry: &Expr) -> bool {
    let entry = entry.literal().and_then(|n| n.whole_number()).and_then(|n| u32::try_from(n).ok());
    !walk.waiting && entry.is_some() && walk.at.modes.length_offset == entry
}

fn is_zero(entry: &Expr) -> bool {
    entry.literal().is_some_and(|n| n.is_zero())
}

/// Whether a statement activates a cycle that drills along Z: its block says Z.
fn calls_up(walk: &Walk, op: &Op) -> bool {
    match op {
        Op::StartCycle(cycle) => walk.at.plane(cycle.plane).is_none_or(|p| p == ncc_ir::canon::Plane::Xy),
        _ => false,
    }
}

/// Whether the program goes on where this pass does not follow.
fn leaves(op: &Op) -> bool {
    matches!(op, flow!())
}

fn cannot(diags: &mut Vec<Diagnostic>, span: Span) {
    diags.push(Diagnostic::new(Fault::lacks(LengthsLack::ToolOffsetWithoutZ), span));
}

/// Puts a waiting offset into the block of the statement that takes it up.
fn take_up(stmt: Stmt, state: &mut OffsetWithZState, made: &mut Rebuild, diags: &mut Vec<Diagnostic>) {
    let Some(waiting) = &mut state.waiting else { return made.push(stmt) };
    if waiting.skip.is_some() && waiting.skip != stmt.skip {
        cannot(diags, waiting.span);
    }
    let mut offset = waiting.clone().into_stmt();
    offset.skip = stmt.skip;
    if !waiting.reported && waiting.block != state.block {
        diags.push(Diagnostic::new(Fault::AssumedOffsetWithZ, waiting.span));
        waiting.reported = true;
    }
    // A block that may be skipped takes it up only then: the next one has to say it again.
    if stmt.skip == waiting.skip {
        state.waiting = None;
    }
    put_before(stmt, offset, made);
}

/// Puts a statement into the block of another, in its place within the block.
fn put_before(mut stmt: Stmt, mut offset: Stmt, made: &mut Rebuild) {
    if matches!(stmt.op, flow!() | Op::ProgramEnd | Op::BeginAgain) {
        // It goes into no block, but before the whole of this one.
        let block = if stmt.joined && made.is_open() {
            made.out.iter().rev().take_while(|s| s.joined).count() + 1
        } else {
            0
        };
        let at = made.out.len().saturating_sub(block);
        offset.joined = false;
        made.out.insert(at, offset);
        return made.push(stmt);
    }
    // The end of a cycle or its call, in the same block, comes after the offset.
    let mut after = Vec::new();
    let mut with_last = stmt.joined && made.is_open();
    while with_last
        && made.out.last().is_some_and(|last| matches!(last.op, Op::EndCycle | Op::StartCycle(_)))
        && let Some(last) = made.out.pop()
    {
        with_last = last.joined;
        after.push(std::mem::replace(&mut stmt, last));
    }
    offset.joined = stmt.joined;
    offset.number = stmt.number.take();
    made.push(offset);
    stmt.joined = true;
    made.push(stmt);
    while let Some(next) = after.pop() {
        made.push(next);
    }
}
