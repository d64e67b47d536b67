//! The legaliser: brings a program within a target's capabilities, piece by piece.
//!
//! It scans each piece once. Where no statement needs work, as in nearly all of a long program, the
//! piece is left as it is and only the tool's position is followed. Bodies of structured control are
//! not looked into: a target that has such control can say everything, or it is `computing`.

mod computing;
pub(crate) mod messages;
pub(crate) mod refuse;
mod settings;
mod subprograms;
mod tool_data;

use std::rc::Rc;

use crate::PASSES;
use crate::Target;
use crate::arcs::{
    arc_form, compensated_modes, convert_arcs, cutter_radius, expand_corners, polar_words, still_blocks,
};
use crate::flow::{
    expand_calls, expand_repeats, number_names, repeat_ends, skip_levels, specialise_procedures,
};
use crate::frames::{
    expand_frames, frame_increments, machine_moves, origin_shift, rotary_turns, work_offset,
};
use crate::holes::{expand_cycles, return_plane};
use crate::modes::{at_once, feed_time, feed_unit, one_distance, one_move, path_control};
use crate::pass::{Moment, Pass, Piece};
use crate::support::known_facts;
use crate::support::needs::{
    ARC, AT_ONCE, CALL, CONTROL, CORNER, CYCLE, EDGE, EVERY, FRAME, LENGTH, MACHINE, MEASURE, MOVE, PATH,
    PATTERN, POLAR, SHIFT, TABLE, THREAD, TOOL_AXIS, WORK, interest, lacks,
};
use crate::support::walk::Walk;
use crate::support::write::EXACT;
use crate::threads::{in_step, taps};
use crate::tools::{
    length_axis, length_by_hand, offset_with_z, spindle_angle, tool_axis, tool_change, tool_edge,
    z_after_change,
};
use crate::watch::ran;
use ncc_ir::behaviour::Behaviours;
use ncc_ir::canon::{AXES, Distance, Modes};
use ncc_ir::caps::{Caps, PolarForm};
use ncc_ir::diag::{Diagnostic, Fault, Gravity};
use ncc_ir::expr::num::{Nanos, Num};
use ncc_ir::geometry::round::ArcRule;
use ncc_ir::program::kinds::moves;
use ncc_ir::program::{Lines, Op, Procedure, Program, Stmt};
use ncc_ir::track::Tracker;

/// Brings a program within a target's capabilities.
#[derive(Clone, Debug)]
pub struct Legaliser {
    pub(crate) target: Target,
    /// What the target lacks.
    pub(crate) lacks: u32,
    /// Whether words of the source may have a measure of their own that the target's cannot have.
    pub(crate) measures: bool,
    /// Which arcs the source's control accepts, if the target's has another rule.
    pub(crate) source_arcs: Option<ArcRule>,
    pub(crate) still_blocks: still_blocks::StillBlocksState,
    /// Whether feeds are said again behind a change of units.
    pub(crate) feed_again: bool,
    /// Whether the target counts F of some moves otherwise than the source.
    pub(crate) times_differ: bool,
    /// Whether any pass wants to know where the tool is.
    pub(crate) follow: bool,
    pub(crate) walk: Walk,
    pub(crate) cycles: expand_cycles::ExpandCyclesState,
    pub(crate) length: offset_with_z::OffsetWithZState,
    pub(crate) one: one_move::OneMoveState,
    pub(crate) work: work_offset::WorkOffsetState,
    pub(crate) shift: origin_shift::OriginShiftState,
    pub(crate) path: path_control::PathControlState,
    pub(crate) polar: polar_words::PolarWordsState,
    pub(crate) corners: expand_corners::ExpandCornersState,
    pub(crate) angle: spindle_angle::SpindleAngleState,
    pub(crate) skip: skip_levels::SkipLevelsState,
    pub(crate) arcs: arc_form::ArcFormState,
    pub(crate) feed: feed_unit::FeedUnitState,
    /// What holds after each call and label of a program that is kept whole.
    pub(crate) entries: Option<Rc<known_facts::Known>>,
    pub(crate) times: feed_time::FeedTimeState,
    pub(crate) edge: tool_edge::ToolEdgeState,
    pub(crate) radius: cutter_radius::CutterRadiusState,
    pub(crate) compensated: compensated_modes::CompensatedModesState,
    pub(crate) axis: tool_axis::ToolAxisState,
    pub(crate) frames: expand_frames::ExpandFramesState,
    pub(crate) taps: taps::TapsState,
    pub(crate) threads: in_step::ThreadsState,
    pub(crate) machine: machine_moves::MachineMovesState,
    pub(crate) change: tool_change::ToolChangeState,
    pub(crate) at_once: at_once::AtOnceState,
    pub(crate) increments: frame_increments::FrameIncrementsState,
    pub(crate) length_axis: length_axis::LengthAxisState,
    pub(crate) by_hand: length_by_hand::LengthByHandState,
    pub(crate) rotary: rotary_turns::RotaryTurnsState,
    pub(crate) z_left: z_after_change::ZAfterChangeState,
}

impl Legaliser {
    /// For a target that writes positions with so many digits after the point (in mm; one more in
    /// inches). `peck_clearance` is the value of the source control's parameter, for peck cycles
    /// that must be written out.
    pub fn new(caps: &Caps, decimals: u8, peck_clearance: Option<Num>) -> Legaliser {
        let lacks = lacks(caps);
        Legaliser {
            target: Target {
                caps: caps.clone(),
                decimals: decimals.min(8),
                peck_clearance,
                ..Target::default()
            },
            lacks,
            measures: false,
            source_arcs: None,
            still_blocks: still_blocks::StillBlocksState::default(),
            times_differ: false,
            feed_again: feed_unit::says_again(&Target { caps: caps.clone(), ..Target::default() }),
            follow: lacks
                & (THREAD
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
                    | AT_ONCE)
                != 0
                || caps.feed_ends_with_mode
                || frame_increments::FrameIncrementsState::new(&Behaviours::default(), &caps.behaviours)
                    .is_used(),
            walk: Walk::default(),
            cycles: expand_cycles::ExpandCyclesState::default(),
            length: offset_with_z::OffsetWithZState::default(),
            one: one_move::OneMoveState::default(),
            work: work_offset::WorkOffsetState::default(),
            shift: origin_shift::OriginShiftState::default(),
            path: path_control::PathControlState::default(),
            polar: polar_words::PolarWordsState::default(),
            corners: expand_corners::ExpandCornersState::default(),
            angle: spindle_angle::SpindleAngleState::default(),
            skip: skip_levels::SkipLevelsState::default(),
            arcs: arc_form::ArcFormState::default(),
            feed: feed_unit::FeedUnitState::default(),
            entries: None,
            times: feed_time::FeedTimeState::default(),
            edge: tool_edge::ToolEdgeState::default(),
            radius: cutter_radius::CutterRadiusState::default(),
            compensated: compensated_modes::CompensatedModesState::default(),
            axis: tool_axis::ToolAxisState::default(),
            frames: expand_frames::ExpandFramesState::default(),
            taps: taps::TapsState::default(),
            threads: in_step::ThreadsState::default(),
            machine: machine_moves::MachineMovesState::default(),
            change: tool_change::ToolChangeState::default(),
            at_once: at_once::AtOnceState::new(caps),
            increments: frame_increments::FrameIncrementsState::new(&Behaviours::default(), &caps.behaviours),
            length_axis: length_axis::LengthAxisState::default(),
            by_hand: length_by_hand::LengthByHandState::default(),
            rotary: rotary_turns::RotaryTurnsState::default(),
            z_left: z_after_change::ZAfterChangeState::default(),
        }
    }

    /// What the target can say.
    pub fn caps(&self) -> &Caps {
        &self.target.caps
    }

    /// Incremental words after a change of frame, in a program that is kept whole: they are done then. Where passes
    /// are to be run first, what the source's control makes of the words is said alone.
    pub fn frame_increments(
        &mut self,
        program: &mut Program,
        passes_first: bool,
        diags: &mut Vec<Diagnostic>,
    ) {
        let start = self.walk.at.clone();
        if passes_first {
            self.increments.take_source().whole(program, &start, diags);
        } else {
            self.increments.whole(program, &start, diags);
        }
    }

    /// The program is called by another: the target's first blocks are not in front of it.
    pub fn stands_alone(&mut self) {
        self.at_once = at_once::AtOnceState::default();
        self.nothing_before();
    }

    /// The program is called by another, which has given each axis a word after its last change of frame.
    pub fn nothing_before(&mut self) {
        self.increments.stands_alone();
    }

    /// Says where the axes stand before the program starts, in its own frame.
    pub fn stand_at(&mut self, position: &[Option<Nanos>; AXES]) {
        self.walk.at.position = *position;
    }

    /// What the target is taken to start with, because it has no words to say it: the work offset
    /// that its only one stands for, and no shift of the origin.
    pub fn taken(&self) -> Modes {
        Modes {
            work_offset: self.work.only.filter(|_| self.target.caps.work_offsets == 0),
            no_origin_shift: self.shift.none.then_some(true),
            ..Modes::default()
        }
    }

    /// Brings further statements of the main procedure within the target's capabilities. `assumed`
    /// are the facts taken for granted so far; `lines`: they go along lines alone.
    pub fn run(
        &mut self,
        stmts: &mut Vec<Stmt>,
        assumed: &Modes,
        lines: Option<Lines>,
        diags: &mut Vec<Diagnostic>,
    ) {
        self.walk.assume(assumed);
        self.frames.assume(assumed);
        let lines = self.absolute(lines);
        // Nothing is mended on arrival, and no walk begins there.
        let nowhere = Walk::default();
        let mut piece = Piece { stmts, needs: 0, start: &nowhere, assumed, lines, diags, done: false };
        self.steps(Moment::Arrival, &mut piece);
        piece.needs = self.needs(piece.stmts);
        self.follow_cycles(&piece);
        let start = (piece.needs != 0).then(|| self.walk.clone());
        self.follow_piece(&piece);
        if let Some(start) = start {
            let mut piece = Piece { start: &start, stmts: piece.stmts, diags: piece.diags, ..piece };
            self.mend(&mut piece, None);
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
        if (step.needed)(self, piece) {
            (step.run)(self, piece);
            if !piece.done {
                ran(pass.name, piece.stmts);
            }
        } else {
            (step.otherwise)(self, piece);
        }
    }

    /// Notes what cycles and threads behind a piece may rely on that has none itself.
    fn follow_cycles(&mut self, piece: &Piece) {
        self.threads.said = self.taps.said;
        if !piece.needs(CYCLE | THREAD) && self.target.caps.threads.turned {
            piece.stmts.iter().for_each(|stmt| self.threads.note(stmt));
        }
        if !piece.needs(CYCLE) {
            // Feeds and speeds that a tap may rely on.
            piece.stmts.iter().for_each(|stmt| self.taps.note(stmt));
        }
    }

    /// Follows the tool, and what passes note of a piece that they do not change.
    fn follow_piece(&mut self, piece: &Piece) {
        let stmts = &*piece.stmts;
        if !piece.needs(MOVE) && self.lacks & MOVE != 0 {
            self.one.note(stmts);
        }
        if !piece.needs(FRAME) && self.lacks & FRAME != 0 {
            self.frames.note(stmts);
        }
        if self.measures && !self.target.caps.arc_forms && !piece.needs(ARC) {
            arc_form::follow(stmts, &mut self.walk, &mut self.arcs);
        } else if self.follow {
            self.walk.pass(stmts);
        }
    }

    /// Lines, if their words count from zero.
    fn absolute(&self, lines: Option<Lines>) -> Option<Lines> {
        lines.filter(|_| self.walk.at.modes.distance == Some(Distance::Absolute))
    }

    /// Whether further statements of the main procedure would be rewritten.
    pub fn touches(&self, stmts: &[Stmt], lines: Option<Lines>) -> bool {
        self.needs(stmts) != 0
            || self.times_differ && lines.is_none() && self.times.concerns(stmts, &self.walk)
            || self.absolute(lines).is_none() && self.increments.concerns(stmts, self.walk.at.modes.distance)
            || self.length_axis.concerns(stmts)
            || self.z_left.concerns(stmts)
    }

    /// What further statements need that the target lacks.
    fn needs(&self, stmts: &[Stmt]) -> u32 {
        let mut found = self.lacks & EVERY;
        for stmt in stmts {
            found |= interest(stmt);
        }
        let mut needs = found & self.lacks;
        if found & ARC != 0 && self.follow {
            let fine = |stmt: &Stmt| convert_arcs::may_be_too_fine(&stmt.op, self.target.decimals);
            needs |= if stmts.iter().any(fine) { ARC } else { 0 };
        }
        needs |= if self.length.is_busy() { LENGTH } else { 0 };
        needs |= if self.cycles.is_busy() || self.taps.is_busy() { CYCLE } else { 0 };
        needs |= if self.threads.is_busy() { THREAD } else { 0 };
        if self.feed_again {
            let changes = |stmt: &Stmt| matches!(stmt.op, Op::UseLengthUnits(_));
            needs |= if self.feed.is_busy() || stmts.iter().any(changes) { MEASURE } else { 0 };
        }
        if self.measures {
            let units = self.walk.at.modes.units;
            let changes = |op: &Op| matches!(op, Op::UseLengthUnits(_));
            let apart = |op: &Op| one_distance::may_mix(op) || feed_unit::differs(op, units) || changes(op);
            needs |= if stmts.iter().any(|stmt| apart(&stmt.op)) { MEASURE } else { 0 };
        }
        if self.path.is_busy() {
            needs |= PATH;
        }
        if self.work.is_busy() {
            needs |= WORK;
        }
        if (needs & MOVE != 0 || self.one.is_busy()) && self.lacks & MOVE != 0 {
            let concerned = needs & PATH != 0 || self.one.concerns(stmts);
            needs = if concerned { needs | MOVE } else { needs & !MOVE };
        }
        if self.frames.is_busy() {
            needs |= FRAME;
        } else if needs & FRAME != 0
            && !stmts.iter().any(|stmt| expand_frames::concerns(&stmt.op, &self.target.caps))
        {
            needs &= !FRAME;
        }
        if self.corners.is_busy() {
            needs |= CORNER;
        }
        if self.machine.is_busy() {
            needs |= MACHINE;
        }
        if self.at_once.is_busy() {
            needs |= AT_ONCE;
        }
        if self.edge.is_busy() || self.target.caps.change_by_hand && self.by_hand.is_busy() {
            needs |= self.lacks & (EDGE | TABLE);
        }
        if self.axis.is_busy() && stmts.iter().any(|stmt| tool_axis::is_length(&stmt.op)) {
            needs |= self.lacks & TOOL_AXIS;
        }
        needs
    }

    /// Runs the passes that a piece needs, or those of them behind one.
    #[cold]
    fn mend(&mut self, piece: &mut Piece, behind: Option<&'static str>) {
        let first = behind.and_then(|name| PASSES.iter().position(|pass| pass.name == name));
        let rest = &PASSES[first.map_or(0, |at| at + 1)..];
        for pass in rest {
            self.step(pass, Moment::Placing, piece);
            if piece.done {
                return;
            }
        }
        if self.follow && piece.needs(CONTROL | WORK | SHIFT | FRAME | MACHINE) {
            self.walk = piece.start.clone();
            if piece.needs(FRAME) && !piece.needs(ARC) {
                self.arcs = arc_form::ArcFormState::default();
                arc_form::follow(piece.stmts, &mut self.walk, &mut self.arcs);
            } else {
                self.walk.pass(piece.stmts);
            }
        }
        self.steps(Moment::Wording, piece);
    }

    /// Says polar points in the target's form; by coordinates where another pass has to write out what they belong to.
    pub(crate) fn polar_words(&mut self, piece: &mut Piece) {
        if let Some(mut found) = self.with_polar_words(piece) {
            piece.diags.append(&mut found);
            piece.done = true;
            return;
        }
        // Corners and frames are worked out from exact points.
        let exact = Target { decimals: EXACT - 1, ..self.target.clone() };
        let target = if piece.needs(CORNER | FRAME) { &exact } else { &self.target };
        polar_words::over(piece.stmts, &mut piece.start.clone(), &mut self.polar, target, false, piece.diags);
        piece.needs &= !POLAR;
    }

    /// The same with polar points in the target's form, and all passes behind; `None`, and nothing done, if another pass
    /// has to write out what they belong to.
    fn with_polar_words(&mut self, piece: &mut Piece) -> Option<Vec<Diagnostic>> {
        let looks_into = piece.needs(FRAME | EVERY | CORNER) || self.cycles.is_busy() || self.taps.is_busy();
        if self.target.caps.polar == PolarForm::None || looks_into {
            return None;
        }
        let (mut own, mut kept, mut found) = (self.clone(), piece.stmts.clone(), Vec::new());
        polar_words::over(&mut kept, &mut piece.start.clone(), &mut own.polar, &own.target, true, &mut found);
        ran(polar_words::PASS.name, &kept);
        let holes = |stmts: &[Stmt]| {
            let polar = stmts.iter().filter(|stmt| matches!(stmt.op, Op::Polar(_))).count();
            let calls = stmts.iter().filter(|stmt| matches!(stmt.op, Op::StartCycle(_))).count();
            let others =
                stmts.iter().filter(|s| matches!(s.op, Op::Hole(_) | Op::Pattern(_) | moves!())).count();
            [polar, calls, others]
        };
        let before = holes(&kept);
        let Piece { start, assumed, lines, .. } = *piece;
        let needs = piece.needs & !POLAR;
        let mut copy =
            Piece { stmts: &mut kept, needs, start, assumed, lines, diags: &mut found, done: false };
        own.mend(&mut copy, Some(polar_words::PASS.name));
        let refused = found.iter().any(|d| d.fault.gravity() == Gravity::Error);
        if refused || needs & (CYCLE | PATTERN) != 0 && holes(&kept) != before {
            return None;
        }
        (*self, *piece.stmts) = (own, kept);
        Some(found)
    }

    /// Whether words of a piece may be measured in several ways, or feeds in another unit than lengths. Computed words
    /// are from zero, others may not be.
    pub(crate) fn is_measured(&self, piece: &Piece) -> bool {
        let computed = self.measures && piece.needs(ARC | FRAME | CORNER);
        piece.needs(MEASURE) || computed && piece.stmts.iter().any(|stmt| one_distance::may_mix(&stmt.op))
    }

    /// The end of the program: further statements, if any were waiting.
    pub fn finish(&mut self, stmts: &mut Vec<Stmt>, diags: &mut Vec<Diagnostic>) {
        self.corners.flush(stmts, diags);
        self.length.flush(stmts, diags);
        self.one.flush(stmts);
        self.threads.finish(stmts, diags);
        self.change.finish(diags);
        self.edge.finish(diags);
    }
}
