//! What a block decides by all of its words: a T beside M06, and a tool length without a word of its axis.
//!
//! ```text
//! T1                     T1 waits
//! M06 T2                 T2 is put in; or T1, and T2 waits
//!
//! G49                    the next Z is measured without the length; or Z moves by the length at once
//! G01 X10.
//! ```
//!
//! Statements of one block follow one another, joined. What waits for the end of the block is settled by the first
//! statement that is not.
//!
//! Not here: which control has which form ([`Behaviour::ToolWithChange`], [`Behaviour::LengthWithoutAxis`]).

use super::{Event, Exec, Length, by_control};
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::Motion;
use ncc_ir::diag::Diagnostic;
use ncc_ir::program::kinds::{drilling, moves, polar};
use ncc_ir::program::{Op, Stmt};
use ncc_ir::source::Span;
use ncc_ir::unexecuted::ToolUnexecuted;

/// What waits for the end of the block at hand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct InBlock {
    /// The block calls a length up, and has no word of its axis so far.
    length: Option<Span>,
    /// The tool that waited before the block selected another one.
    before: Option<i64>,
    /// The block switches tool centre point control, whose length moves nothing.
    tip: bool,
}

impl Exec {
    /// Whether a behaviour is open, or has another value than the first one.
    fn follows(&self, behaviour: Behaviour) -> bool {
        let all = &self.world.behaviours;
        all.does(behaviour) || all.is_open(behaviour)
    }

    /// A tool is selected, which is put in by the next change.
    pub(super) fn select(&mut self, tool: i64) {
        let waits = self.selected != -1 && self.selected != self.state.tool && self.selected != tool;
        if waits && self.follows(Behaviour::ToolWithChange) {
            self.in_block.get_or_insert_default().before = Some(self.selected);
        }
        self.selected = tool;
    }

    /// The tool that a change puts in: the selected one, or the one that waited before the block selected it.
    pub(super) fn tool_of_change(&mut self) -> i64 {
        let before = self.in_block.as_mut().and_then(|block| block.before.take());
        match before {
            Some(waiting) if self.does(Behaviour::ToolWithChange) => waiting,
            _ => self.selected,
        }
    }

    /// A length is activated, which may move its axis at the end of the block.
    pub(super) fn called_in_block(&mut self, span: Span) {
        if self.follows(Behaviour::LengthWithoutAxis) && !self.state.tip {
            let block = self.in_block.get_or_insert_default();
            if !block.tip {
                block.length = Some(span);
            }
        }
    }

    /// Tool centre point control is switched: its length is no call of its own.
    pub(super) fn tip_in_block(&mut self) {
        if self.follows(Behaviour::LengthWithoutAxis) {
            self.in_block.get_or_insert_default().tip = true;
        }
    }

    /// Before a statement, where something waits for the end of a block.
    ///
    /// # Errors
    /// A length moves its axis where that is not executed.
    #[cold]
    pub(super) fn settle_block(&mut self, stmt: &Stmt, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let ends =
            matches!(stmt.op, Op::ProgramStop | Op::OptionalProgramStop | Op::ProgramEnd | Op::BeginAgain);
        if !stmt.joined || ends {
            return self.end_block(out);
        }
        let Some(block) = &mut self.in_block else { return Ok(()) };
        match &stmt.op {
            // The axis goes to a place of the machine, where no length counts.
            Op::GoToReference(_) | Op::UseMachineCoordinates { .. } | Op::Detour(_) | Op::StartCycle(_) => {
                block.length = None;
            }
            Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Position(m)
                if m.to.axes[self.along].is_some() || self.cycle.is_some() =>
            {
                block.length = None;
            }
            Op::StraightTraverse(_) | Op::StraightFeed(_) | Op::Position(_) => {
                if let Some(span) = block.length.take()
                    && self.moves_by_length()
                    && self.does(Behaviour::LengthWithoutAxis)
                {
                    self.check_length_move(span)?;
                    // The axis goes along with the others of the block.
                    self.take_up_moving();
                }
            }
            // With an arc in its block, no source tells.
            op if is_other_move(op) => block.length = None,
            _ => {}
        }
        Ok(())
    }

    /// The block is over.
    ///
    /// # Errors
    /// A length moves its axis where that is not executed.
    #[cold]
    pub(super) fn end_block(&mut self, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let Some(block) = self.in_block.take() else { return Ok(()) };
        let Some(span) = block.length else { return Ok(()) };
        if self.ended || !self.moves_by_length() || !self.does(Behaviour::LengthWithoutAxis) {
            return Ok(());
        }
        self.check_length_move(span)?;
        let feed = match self.modes.motion {
            Motion::Traverse => false,
            Motion::Feed => true,
            Motion::Arc(_) | Motion::Cycle => {
                return self.not_executed(ToolUnexecuted::LengthUnderArc, span);
            }
        };
        self.take_up_moving();
        self.emit_move(feed, span, out)
    }

    /// Whether the length that waits is another one than that which the axis stands with.
    fn moves_by_length(&self) -> bool {
        self.waiting.is_some_and(|length| self.length_of(length) != self.length_of(self.standing_length()))
    }

    /// The length that the axis stands with: none at a place of the machine.
    fn standing_length(&self) -> Length {
        if self.at_place { Length::Entry(0) } else { self.modes.length }
    }

    /// # Errors
    /// The tool goes beside a contour, in a cycle or in a tilted plane.
    fn check_length_move(&self, span: Span) -> Result<(), Diagnostic> {
        if self.cycle.is_some() || self.contour.watched || self.corner.is_some() || self.is_tilted() {
            return self.not_executed(ToolUnexecuted::LengthInCycle, span);
        }
        Ok(())
    }

    /// Takes the length up that waits; the axis keeps its coordinate, and moves by the difference.
    fn take_up_moving(&mut self) {
        if self.at_place {
            let here = self.machine();
            self.modes.length = Length::Entry(0);
            self.reframe(here);
            self.at_place = false;
        }
        self.take_up_length();
    }

    /// The axis of the length goes to a place of the machine.
    pub(super) fn goes_to_place(&mut self) {
        self.at_place = true;
        self.said_by_program(by_control::Z_COUNTED);
    }

    /// Behaviours that these statements reach by all the words of a block, a bit each.
    pub(super) fn by_blocks(&self, stmts: &[Stmt]) -> u64 {
        if !stmts.iter().any(|stmt| matches!(stmt.op, Op::ChangeTool) || stmt.op.calls_length()) {
            return 0;
        }
        let mut bits = 0;
        // The tool that waits, if one may: `None` of a number that is computed.
        let mut waits: Option<Option<i64>> =
            (self.selected != -1 && self.selected != self.state.tool).then_some(Some(self.selected));
        let (mut another, mut bare) = (false, false);
        for stmt in stmts {
            if !stmt.joined {
                bits |= if bare { Behaviour::LengthWithoutAxis.bit() } else { 0 };
                (another, bare) = (false, false);
            }
            match &stmt.op {
                Op::SelectTool(tool) => {
                    let tool = tool.literal().and_then(|n| n.whole_number());
                    another |= waits.is_some_and(|waits| waits.is_none() || tool.is_none() || waits != tool);
                    waits = Some(tool);
                }
                Op::SelectToolByName(_) => {
                    another |= waits.is_some();
                    waits = Some(None);
                }
                Op::ChangeTool => {
                    bits |= if another { Behaviour::ToolWithChange.bit() } else { 0 };
                    if !another {
                        waits = None;
                    }
                }
                op if op.calls_length() => bare = true,
                op => bare &= !self.keeps_axis(op),
            }
        }
        bits | if bare { Behaviour::LengthWithoutAxis.bit() } else { 0 }
    }

    /// Whether an operation of its block leaves nothing for a length to move.
    fn keeps_axis(&self, op: &Op) -> bool {
        match op {
            Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Position(m) => {
                m.to.axes[self.along].is_some()
            }
            Op::GoToReference(_) | Op::UseMachineCoordinates { .. } | Op::Detour(_) | Op::StartCycle(_) => {
                true
            }
            _ => false,
        }
    }

    /// What a block leaves undecided: two controls are in one state only where nothing is.
    pub(super) fn is_between_blocks(&self) -> bool {
        self.in_block.is_none()
    }
}

/// Whether an operation is a move of another form than a straight one of plain words.
fn is_other_move(op: &Op) -> bool {
    matches!(op, moves!() | polar!() | drilling!())
}
