//! The legaliser: brings a program within a target's capabilities, piece by piece.
//!
//! It scans each piece once. Where no statement needs work, as in nearly all of a long program, the
//! piece is left as it is and only the tool's position is followed. Bodies of structured control are
//! not looked into: a target that has such control can say everything, or it is `computing`.
//!
//! ```text
//! stmts of a piece ── arrival ── needs ── placing ── wording ── departure ──▶ stmts that the target can say
//! ```
//!
//! Not here: what a pass does: each is a `PASS` in its own file.

mod computing;
pub(crate) mod messages;
pub(crate) mod refuse;
mod settings;
mod subprograms;
mod tool_data;

use crate::arcs::arc_form::ArcFormState;
use crate::arcs::expand_corners::ExpandCornersState;
use crate::arcs::still_blocks::StillBlocksState;
use crate::frames::expand_frames::ExpandFramesState;
use crate::frames::frame_increments::FrameIncrementsState;
use crate::frames::machine_moves::MachineMovesState;
use crate::frames::origin_shift::OriginShiftState;
use crate::frames::work_offset::WorkOffsetState;
use crate::holes::expand_cycles::ExpandCyclesState;
use crate::modes::feed_time::FeedTimeState;
use crate::modes::feed_unit::FeedUnitState;
use crate::modes::immediate_effects::ImmediateEffectsState;
use crate::modes::one_move::OneMoveState;
use crate::modes::path_control::PathControlState;
use crate::pass::{First, KeptProgram, ProgramMoment, Shared, Subprograms};
use crate::support::states::States;
use crate::threads::in_step::ThreadsState;
use crate::threads::taps::TapsState;
use crate::tools::length_axis::LengthAxisState;
use crate::tools::length_by_hand::LengthByHandState;
use crate::tools::offset_with_z::OffsetWithZState;
use crate::tools::tool_axis::ToolAxisState;
use crate::tools::tool_edge::ToolEdgeState;
use crate::tools::z_after_change::ZAfterChangeState;

use crate::arcs::{arc_form, arc_radii, convert_arcs};
use crate::flow::{expand_repeats, repeat_ends};
use crate::frames::expand_frames;
use crate::holes::return_plane;
use crate::modes::{feed_unit, one_distance};
use crate::pass::{Moment, Pass, Piece};
use crate::support::mode_analysis;
use crate::support::needs::{
    ARC, AT_ONCE, CALL, CONTROL, CORNER, CYCLE, EDGE, EVERY, FRAME, LENGTH, MACHINE, MEASURE, MOVE, PATH,
    PATTERN, POLAR, SHIFT, SKIP, TABLE, THREAD, TOOL_AXIS, WORK, interest, lacks,
};
use crate::support::walk::Walk;
use crate::table::PASSES;
use crate::target::Target;
use crate::tools::tool_axis;
use crate::watch::{ran, ran_whole};
use ncc_exec::are_arcs;
use ncc_ir::behaviour::Behaviours;
use ncc_ir::canon::{AXES, Distance, Modes};
use ncc_ir::caps::Caps;
use ncc_ir::diag::{Diagnostic, Fault, Gravity};
use ncc_ir::expr::num::{Nanos, Num};
use ncc_ir::program::{Lines, Op, Procedure, Program, Stmt};
use ncc_ir::track::Tracker;

/// What the tool is followed for.
const FOLLOWED: u32 = THREAD
    | PATTERN
    | CYCLE
    | ARC
    | LENGTH
    | EVERY
    | CALL
    | EDGE
    | TABLE
    | FRAME
    | MACHINE
    | POLAR
    | TOOL_AXIS
    | CORNER
    | AT_ONCE;

/// What the passes do to further statements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Touch {
    /// Nothing concerns them.
    Passes,
    /// They have judged each arc by the target's rule and digits, and change nothing.
    JudgesArcs,
    /// They may change something.
    Changes,
}

/// Brings a program within a target's capabilities.
#[derive(Clone, Debug)]
pub struct Legaliser {
    pub(crate) shared: Shared,
}

impl Legaliser {
    /// For a target that writes positions with so many digits after the point (in mm; one more in
    /// inches). `peck_clearance` is the value of the source control's parameter, for peck cycles
    /// that must be expanded.
    pub fn new(caps: &Caps, decimals: u8, peck_clearance: Option<Num>) -> Legaliser {
        let lacks = lacks(caps);
        let target =
            Target { caps: caps.clone(), decimals: decimals.min(8), peck_clearance, ..Target::default() };
        let increments = FrameIncrementsState::new(&Behaviours::default(), &caps.behaviours);
        let follow = lacks & FOLLOWED != 0 || caps.modes.feed_ends_with_mode || increments.is_used();
        let mut states = States::default();
        states.put(ImmediateEffectsState::new(caps));
        states.put(increments);
        let shared = Shared {
            lacks,
            measures: false,
            source_arcs: None,
            times_differ: false,
            feed_again: feed_unit::says_again(&target),
            follow,
            walk: Walk::default(),
            entries: None,
            states,
            target,
        };
        Legaliser { shared }
    }

    /// What the target can say.
    pub fn caps(&self) -> &Caps {
        &self.shared.target.caps
    }

    /// Incremental words after a change of frame, in a program that is kept whole: they are done then. Where passes
    /// are to be run first, what the source's control makes of the words is stated alone.
    pub fn frame_increments(
        &mut self,
        program: &mut Program,
        passes_first: bool,
        diags: &mut Vec<Diagnostic>,
    ) {
        let moment = if passes_first { ProgramMoment::SourceIncrements } else { ProgramMoment::Increments };
        self.on_program(moment, program, Subprograms::Keep, diags);
    }

    /// Runs the passes of a moment on a program that is kept whole.
    fn on_program(
        &mut self,
        moment: ProgramMoment,
        program: &mut Program,
        subprograms: Subprograms,
        diags: &mut Vec<Diagnostic>,
    ) {
        self.on_kept(moment, &mut KeptProgram { program, subprograms, known: None, diags, refused: false });
    }

    /// The same, until one of them refuses it.
    fn on_kept(&mut self, moment: ProgramMoment, kept: &mut KeptProgram) {
        for pass in PASSES {
            for step in pass.program.iter().filter(|step| step.moment == moment) {
                if kept.refused || !(step.needed)(&self.shared, kept) {
                    continue;
                }
                (step.run)(&mut self.shared, kept);
                if !kept.refused {
                    ran_whole(pass.name, kept.program);
                }
            }
        }
    }

    /// The program is called by another: the target's first blocks are not in front of it.
    pub fn stands_alone(&mut self) {
        self.shared.states.forget::<ImmediateEffectsState>();
        self.shared.states.state_mut::<OffsetWithZState>().stands_alone();
        self.nothing_before();
    }

    /// The program is called by another, which has given each axis a word after its last change of frame.
    pub fn nothing_before(&mut self) {
        self.shared.states.state_mut::<FrameIncrementsState>().stands_alone();
    }

    /// Says where the axes stand before the program starts, in its own frame.
    pub fn stand_at(&mut self, position: &[Option<Nanos>; AXES]) {
        self.shared.walk.at.position = *position;
    }

    /// What the target is taken to start with, because it has no words to say it: the work offset
    /// that its only one stands for, and no G92 shift.
    pub fn taken(&self) -> Modes {
        let only = self.shared.states.ask(|own: &WorkOffsetState| own.only);
        let none = self.shared.states.ask(|own: &OriginShiftState| own.none);
        Modes {
            work_offset: only.filter(|_| self.shared.target.caps.frames.work_offsets == 0),
            no_origin_shift: none.then_some(true),
            ..Modes::default()
        }
    }

    /// Brings further statements of the main procedure within the target's capabilities. `assumed`
    /// are the facts assumed so far; `lines`: they go along lines alone.
    pub fn run(
        &mut self,
        stmts: &mut Vec<Stmt>,
        assumed: &Modes,
        lines: Option<Lines>,
        diags: &mut Vec<Diagnostic>,
    ) {
        self.run_touching(stmts, assumed, (lines, Touch::Changes), diags);
    }

    /// The same, where it is known what the passes do.
    pub fn run_touching(
        &mut self,
        stmts: &mut Vec<Stmt>,
        assumed: &Modes,
        (lines, touch): (Option<Lines>, Touch),
        diags: &mut Vec<Diagnostic>,
    ) {
        let judged = touch == Touch::JudgesArcs;
        self.shared.walk.assume(assumed);
        self.shared.states.state_mut::<ExpandFramesState>().assume(assumed);
        let lines = self.absolute(lines);
        // Nothing is mended on arrival, and no walk begins there.
        let nowhere = Walk::default();
        let mut piece = Piece { stmts, needs: 0, start: &nowhere, assumed, lines, diags, done: false };
        self.steps(Moment::Arrival, &mut piece);
        piece.needs = if judged { 0 } else { self.needs(piece.stmts) };
        self.follow_cycles(&piece);
        let start = (piece.needs != 0).then(|| self.shared.walk.clone());
        if judged && !self.shared.target.caps.arcs.forms {
            let state = self.shared.states.state_mut::<ArcFormState>();
            piece.stmts.iter().for_each(|stmt| state.step(stmt, &mut self.shared.walk));
        } else {
            self.follow_piece(&piece);
        }
        if let Some(start) = start {
            let mut piece = Piece { start: &start, stmts: piece.stmts, diags: piece.diags, ..piece };
            self.run_passes(&mut piece, None);
        }
        let mut piece = Piece { stmts, needs: 0, start: &nowhere, assumed, lines, diags, done: false };
        self.steps(Moment::Departure, &mut piece);
    }

    /// Runs the passes of a moment.
    fn steps(&mut self, moment: Moment, piece: &mut Piece) {
        for pass in PASSES {
            self.step(pass, moment, piece);
        }
    }

    /// Runs a pass if its moment is there and it is needed.
    fn step(&mut self, pass: &Pass, moment: Moment, piece: &mut Piece) {
        let Some(step) = pass.step.filter(|step| step.moment == moment) else { return };
        if !(step.needed)(&self.shared, piece) {
            return (step.otherwise)(&mut self.shared, piece);
        }
        if let Some(mut found) = step.first.and_then(|first| self.with_first(pass, first, piece)) {
            piece.diags.append(&mut found);
            piece.done = true;
            return;
        }
        (step.run)(&mut self.shared, piece);
        ran(pass.name, piece.stmts);
    }

    /// The same in the form that is tried first, with all later passes; `None`, and nothing done, where that has no
    /// sense, or one of them refuses something.
    fn with_first(&mut self, pass: &Pass, first: First, piece: &mut Piece) -> Option<Vec<Diagnostic>> {
        let (mut own, mut kept, mut found) = (self.clone(), piece.stmts.clone(), Vec::new());
        let Piece { start, assumed, lines, needs, .. } = *piece;
        let mut copy =
            Piece { stmts: &mut kept, needs, start, assumed, lines, diags: &mut found, done: false };
        if !(first.tried)(&mut own.shared, &mut copy) {
            return None;
        }
        ran(pass.name, copy.stmts);
        let before = copy.stmts.clone();
        own.run_passes(&mut copy, Some(pass.name));
        let refused = found.iter().any(|d| d.fault.gravity() == Gravity::Error);
        if refused || !(first.kept)(piece, &before, &kept) {
            return None;
        }
        (*self, *piece.stmts) = (own, kept);
        Some(found)
    }

    /// Notes what cycles and threads after a piece may rely on that has none itself.
    fn follow_cycles(&mut self, piece: &Piece) {
        let states = &mut self.shared.states;
        states.state_mut::<ThreadsState>().said = states.ask(|taps: &TapsState| taps.said);
        if !piece.needs(CYCLE | THREAD) && self.shared.target.caps.moves.threads.turned {
            let threads = states.state_mut::<ThreadsState>();
            piece.stmts.iter().for_each(|stmt| threads.note(stmt));
        }
        if !piece.needs(CYCLE) {
            // Feeds and speeds that a tap may rely on.
            let taps = states.state_mut::<TapsState>();
            piece.stmts.iter().for_each(|stmt| taps.note(stmt));
        }
    }

    /// Follows the tool, and what passes note of a piece that they do not change.
    fn follow_piece(&mut self, piece: &Piece) {
        let stmts = &*piece.stmts;
        if !piece.needs(MOVE) && self.shared.lacks & MOVE != 0 {
            self.shared.states.state_mut::<OneMoveState>().note(stmts);
        }
        if !piece.needs(FRAME) && self.shared.lacks & FRAME != 0 {
            self.shared.states.state_mut::<ExpandFramesState>().note(stmts);
        }
        if self.shared.measures && !self.shared.target.caps.arcs.forms && !piece.needs(ARC) {
            arc_form::follow(stmts, &mut self.shared.walk, self.shared.states.state_mut::<ArcFormState>());
        } else if self.shared.follow {
            self.shared.walk.pass(stmts);
        }
    }

    /// Lines, if their words count from zero.
    fn absolute(&self, lines: Option<Lines>) -> Option<Lines> {
        lines.filter(|_| self.shared.walk.at.modes.distance == Some(Distance::Absolute))
    }

    /// Whether further statements of the main procedure would be rewritten.
    pub fn touches(&self, stmts: &[Stmt], lines: Option<Lines>, assumed: &Modes) -> Touch {
        let needs = self.needs(stmts);
        match needs & !ARC != 0 || self.concerns(stmts, lines) {
            false if needs == 0 => Touch::Passes,
            false if self.leaves_arcs(stmts, assumed) => Touch::JudgesArcs,
            _ => Touch::Changes,
        }
    }

    /// Whether all that the passes do with lines, for which these statements stand, is to follow them: nothing concerns
    /// them but a frame that is stated as it stands.
    pub fn follows(&self, stand: &[Stmt], lines: Lines) -> bool {
        let needs = self.needs(stand);
        let framed = || self.shared.states.ask(|own: &ExpandFramesState| own.leaves(stand));
        !self.concerns(stand, Some(lines)) && (needs == 0 || needs == FRAME && framed())
    }

    /// Whether a pass would look at statements for something else than what the target lacks.
    fn concerns(&self, stmts: &[Stmt], lines: Option<Lines>) -> bool {
        let Shared { states, walk, .. } = &self.shared;
        self.shared.times_differ
            && lines.is_none()
            && states.ask(|times: &FeedTimeState| times.concerns(stmts, walk))
            || self.absolute(lines).is_none()
                && states.ask(|own: &FrameIncrementsState| own.concerns(stmts, walk.at.modes.distance))
            || states.ask(|own: &LengthAxisState| own.concerns(stmts))
            || states.ask(|own: &ZAfterChangeState| own.concerns(stmts))
    }

    /// Whether the passes for arcs leave all of them as they are.
    fn leaves_arcs(&self, stmts: &[Stmt], assumed: &Modes) -> bool {
        let Shared { measures, source_arcs, target, walk, states, .. } = &self.shared;
        // One of the passes looks at the lines among them then.
        let others = *measures || states.ask(|own: &StillBlocksState| own.looked_over);
        if others || !are_arcs(stmts) {
            return false;
        }
        let mut walk = walk.clone();
        walk.assume(assumed);
        stmts.iter().all(|stmt| {
            walk.enter(stmt.skip);
            let left = match &stmt.op {
                Op::ArcFeed(arc) => {
                    !convert_arcs::may_be_too_fine(&stmt.op, target.decimals)
                        && source_arcs.is_none_or(|own| arc_radii::keeps(arc, &walk, &own, target))
                        && (target.caps.arcs.helix || !refuse::is_helix(arc, &walk.at))
                        && (target.caps.arcs.turns || arc.turns.is_none())
                }
                _ => true,
            };
            walk.step(stmt);
            left
        })
    }

    /// What further statements need that the target lacks.
    fn needs(&self, stmts: &[Stmt]) -> u32 {
        let mut found = self.shared.lacks & EVERY;
        for stmt in stmts {
            found |= interest(stmt);
        }
        let mut needs = found & self.shared.lacks;
        if found & ARC != 0 && self.shared.follow {
            let fine = |stmt: &Stmt| convert_arcs::may_be_too_fine(&stmt.op, self.shared.target.decimals);
            needs |= if stmts.iter().any(fine) { ARC } else { 0 };
        }
        needs |= if self.shared.states.ask(OffsetWithZState::is_busy) { LENGTH } else { 0 };
        needs |= if self.shared.states.ask(ExpandCyclesState::is_busy)
            || self.shared.states.ask(TapsState::is_busy)
        {
            CYCLE
        } else {
            0
        };
        needs |= if self.shared.states.ask(ThreadsState::is_busy) { THREAD } else { 0 };
        if self.shared.feed_again {
            let changes = |stmt: &Stmt| matches!(stmt.op, Op::UseLengthUnits(_));
            needs |= if self.shared.states.ask(FeedUnitState::is_busy) || stmts.iter().any(changes) {
                MEASURE
            } else {
                0
            };
        }
        if self.shared.measures {
            let units = self.shared.walk.at.modes.units;
            let changes = |op: &Op| matches!(op, Op::UseLengthUnits(_));
            let apart = |op: &Op| one_distance::may_mix(op) || feed_unit::differs(op, units) || changes(op);
            needs |= if stmts.iter().any(|stmt| apart(&stmt.op)) { MEASURE } else { 0 };
        }
        if self.shared.states.ask(PathControlState::is_busy) {
            needs |= PATH;
        }
        if self.shared.states.ask(WorkOffsetState::is_busy) {
            needs |= WORK;
        }
        if (needs & MOVE != 0 || self.shared.states.ask(OneMoveState::is_busy))
            && self.shared.lacks & MOVE != 0
        {
            let concerned =
                needs & PATH != 0 || self.shared.states.ask(|own: &OneMoveState| own.concerns(stmts));
            needs = if concerned { needs | MOVE } else { needs & !MOVE };
        }
        let levels = self.shared.target.caps.flow.skip_levels;
        if needs & SKIP != 0 && !stmts.iter().any(|stmt| stmt.skip.is_some_and(|level| level > levels)) {
            needs &= !SKIP;
        }
        if self.shared.states.ask(ExpandFramesState::is_busy) {
            needs |= FRAME;
        } else if needs & FRAME != 0
            && !stmts.iter().any(|stmt| expand_frames::concerns(&stmt.op, &self.shared.target.caps))
        {
            needs &= !FRAME;
        }
        if self.shared.states.ask(ExpandCornersState::is_busy) {
            needs |= CORNER;
        }
        if self.shared.states.ask(MachineMovesState::is_busy) {
            needs |= MACHINE;
        }
        if self.shared.states.ask(ImmediateEffectsState::is_busy) {
            needs |= AT_ONCE;
        }
        if self.shared.states.ask(ToolEdgeState::is_busy)
            || self.shared.target.caps.tools.change_by_hand
                && self.shared.states.ask(LengthByHandState::is_busy)
        {
            needs |= self.shared.lacks & (EDGE | TABLE);
        }
        if self.shared.states.ask(ToolAxisState::is_busy)
            && stmts.iter().any(|stmt| tool_axis::is_length(&stmt.op))
        {
            needs |= self.shared.lacks & TOOL_AXIS;
        }
        needs
    }

    /// Runs the passes that a piece needs, or those of them after one.
    #[cold]
    fn run_passes(&mut self, piece: &mut Piece, behind: Option<&'static str>) {
        let first = behind.and_then(|name| PASSES.iter().position(|pass| pass.name == name));
        let rest = &PASSES[first.map_or(0, |at| at + 1)..];
        for pass in rest {
            self.step(pass, Moment::Placing, piece);
            if piece.done {
                return;
            }
        }
        if self.shared.follow && piece.needs(CONTROL | WORK | SHIFT | FRAME | MACHINE) {
            self.shared.walk = piece.start.clone();
            if piece.needs(FRAME) && !piece.needs(ARC) {
                self.shared.states.forget::<ArcFormState>();
                arc_form::follow(
                    piece.stmts,
                    &mut self.shared.walk,
                    self.shared.states.state_mut::<ArcFormState>(),
                );
            } else {
                self.shared.walk.pass(piece.stmts);
            }
        }
        self.steps(Moment::Wording, piece);
    }

    /// The end of the program: further statements, if any were waiting.
    pub fn finish(&mut self, stmts: &mut Vec<Stmt>, diags: &mut Vec<Diagnostic>) {
        for step in PASSES.iter().filter_map(|pass| pass.step) {
            (step.finish)(&mut self.shared, stmts, diags);
        }
    }
}
