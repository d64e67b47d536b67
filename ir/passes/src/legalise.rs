//! The legaliser: brings a program within a target's capabilities, piece by piece.
//!
//! It scans each piece once. Where no statement needs work, as in nearly all of a long program, the
//! piece is left as it is and only the tool's position is followed. Bodies of structured control are
//! not looked into: a target that has such control can say everything, or it is `computing`.

mod computing;
pub(crate) mod messages;
mod settings;
mod subprograms;
mod tool_data;

use std::rc::Rc;

use crate::Target;
use crate::arcs::{
    arc_form, arc_radii, compensated_modes, convert_arcs, cutter_radius, expand_corners, expand_turns,
    polar_words,
};
use crate::flow::{
    expand_calls, expand_repeats, number_names, repeat_ends, skip_levels, specialise_procedures,
};
use crate::frames::{
    expand_frames, frame_increments, machine_moves, offset_here, origin_shift, rotary_turns, rotary_ways,
    work_offset,
};
use crate::holes::{absolute_holes, approach, expand_cycles, expand_patterns, return_plane, state_clearance};
use crate::modes::{at_once, feed_time, feed_unit, flatten_facts, one_distance, one_move, path_control};
use crate::support::known_facts;
use crate::support::needs::{
    ARC, AT_ONCE, CALL, CONTROL, CORNER, CYCLE, EDGE, EVERY, FRAME, LENGTH, MACHINE, MEASURE, MESSAGE, MOVE,
    PATH, PATTERN, POLAR, RADIUS, SHIFT, SKIP, TABLE, THREAD, TOOL_AXIS, TURN, WORK, interest, lacks,
};
use crate::support::walk::Walk;
use crate::support::write::EXACT;
use crate::threads::{in_step, tapped_holes, taps};
use crate::tools::{
    length_axis, length_by_hand, offset_with_z, spindle_angle, tool_axis, tool_change, tool_edge,
    z_after_change,
};
use crate::watch::ran;
use ncc_ir::behaviour::{Behaviour, Behaviours};
use ncc_ir::canon::{AXES, Distance, Modes};
use ncc_ir::caps::{Caps, PolarForm};
use ncc_ir::diag::{Diagnostic, Fault, Gravity};
use ncc_ir::expr::num::{Nanos, Num};
use ncc_ir::geometry::round::ArcRule;
use ncc_ir::program::kinds::moves;
use ncc_ir::program::{Arc, Data, Lines, Op, Procedure, Program, Stmt};
use ncc_ir::track::Tracker;

/// Brings a program within a target's capabilities.
#[derive(Clone, Debug)]
pub struct Legaliser {
    target: Target,
    /// What the target lacks.
    lacks: u32,
    /// Whether words of the source may have a measure of their own that the target's cannot have.
    measures: bool,
    /// Which arcs the source's control accepts, if the target's has another rule.
    source_arcs: Option<ArcRule>,
    /// Whether feeds are said again behind a change of units.
    feed_again: bool,
    /// Whether the target counts F of some moves otherwise than the source.
    times_differ: bool,
    /// Whether any pass wants to know where the tool is.
    follow: bool,
    walk: Walk,
    cycles: expand_cycles::State,
    length: offset_with_z::State,
    one: one_move::State,
    work: work_offset::State,
    shift: origin_shift::State,
    path: path_control::State,
    polar: polar_words::State,
    corners: expand_corners::State,
    angle: spindle_angle::State,
    skip: skip_levels::State,
    arcs: arc_form::State,
    feed: feed_unit::State,
    /// What holds after each call and label of a program that is kept whole.
    entries: Option<Rc<known_facts::Known>>,
    times: feed_time::State,
    edge: tool_edge::State,
    radius: cutter_radius::State,
    compensated: compensated_modes::State,
    axis: tool_axis::State,
    frames: expand_frames::State,
    taps: taps::State,
    threads: in_step::State,
    machine: machine_moves::State,
    change: tool_change::State,
    at_once: at_once::State,
    increments: frame_increments::State,
    length_axis: length_axis::State,
    by_hand: length_by_hand::State,
    rotary: rotary_turns::State,
    z_left: z_after_change::State,
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
                || frame_increments::State::new(&Behaviours::default(), &caps.behaviours).is_used(),
            walk: Walk::default(),
            cycles: expand_cycles::State::default(),
            length: offset_with_z::State::default(),
            one: one_move::State::default(),
            work: work_offset::State::default(),
            shift: origin_shift::State::default(),
            path: path_control::State::default(),
            polar: polar_words::State::default(),
            corners: expand_corners::State::default(),
            angle: spindle_angle::State::default(),
            skip: skip_levels::State::default(),
            arcs: arc_form::State::default(),
            feed: feed_unit::State::default(),
            entries: None,
            times: feed_time::State::default(),
            edge: tool_edge::State::default(),
            radius: cutter_radius::State::default(),
            compensated: compensated_modes::State::default(),
            axis: tool_axis::State::default(),
            frames: expand_frames::State::default(),
            taps: taps::State::default(),
            threads: in_step::State::default(),
            machine: machine_moves::State::default(),
            change: tool_change::State::default(),
            at_once: at_once::State::new(caps),
            increments: frame_increments::State::new(&Behaviours::default(), &caps.behaviours),
            length_axis: length_axis::State::default(),
            by_hand: length_by_hand::State::default(),
            rotary: rotary_turns::State::default(),
            z_left: z_after_change::State::default(),
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
        self.at_once = at_once::State::default();
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
        if self.rotary.is_used() && lines.is_none() {
            self.rotary.check(stmts, &self.walk, diags);
            ran("rotary-turns", stmts);
        }
        if self.length_axis.is_used() {
            self.length_axis.check(stmts, &self.walk, diags);
            ran("length-axis", stmts);
        }
        if lines.is_none() && offset_here::concerns(stmts, &self.target.caps) {
            offset_here::over(stmts, self.walk.clone(), &self.target.caps);
            ran("offset-here", stmts);
        }
        if self.z_left.concerns(stmts) {
            self.z_left.over(stmts, &self.walk);
            ran("z-after-change", stmts);
        }
        match lines {
            Some(lines) => self.increments.note_lines(lines),
            None if self.increments.concerns(stmts, self.walk.at.modes.distance) => {
                self.increments.over(stmts, &self.walk, diags);
                ran("frame-increments", stmts);
            }
            None => self.increments.note(stmts, &self.walk),
        }
        if self.target.caps.change_stops_spindle {
            let up = self.target.caps.behaviours.surely(Behaviour::ZAtChange);
            self.change.over(stmts, up, diags);
            ran("tool-change", stmts);
        }
        let ends = self.target.caps.feed_ends_with_mode;
        if ends || self.feed_again {
            let changes = self.entries.is_some()
                || stmts.iter().any(|stmt| match stmt.op {
                    Op::SetFeedMode(_) => true,
                    Op::UseLengthUnits(_) => self.feed_again,
                    _ => false,
                });
            match changes || self.feed.is_busy() {
                true => {
                    let (mut walk, entries) = (self.walk.clone(), self.entries.clone());
                    feed_unit::again(
                        stmts,
                        &mut walk,
                        &mut self.feed,
                        &self.target,
                        entries.as_deref(),
                        diags,
                    );
                    ran("feed-again", stmts);
                }
                false => stmts.iter().for_each(|stmt| self.feed.note(&stmt.op)),
            }
        }
        if self.times_differ && lines.is_none() {
            match self.entries.is_some() || self.times.concerns(stmts, &self.walk) {
                true => {
                    let (mut walk, entries) = (self.walk.clone(), self.entries.clone());
                    feed_time::over(
                        stmts,
                        &mut walk,
                        &mut self.times,
                        &self.target,
                        entries.as_deref(),
                        diags,
                    );
                    ran("feed-time", stmts);
                }
                false => self.times.note(stmts),
            }
        }
        let needs = self.needs(stmts);
        self.threads.said = self.taps.said;
        if needs & (CYCLE | THREAD) == 0 && self.target.caps.threads.turned {
            stmts.iter().for_each(|stmt| self.threads.note(stmt));
        }
        if needs & CYCLE == 0 {
            // Feeds and speeds that a tap may rely on.
            stmts.iter().for_each(|stmt| self.taps.note(stmt));
        }
        let start = (needs != 0).then(|| self.walk.clone());
        if needs & MOVE == 0 && self.lacks & MOVE != 0 {
            self.one.note(stmts);
        }
        if needs & FRAME == 0 && self.lacks & FRAME != 0 {
            self.frames.note(stmts);
        }
        if self.measures && !self.target.caps.arc_forms && needs & ARC == 0 {
            arc_form::follow(stmts, &mut self.walk, &mut self.arcs);
        } else if self.follow {
            self.walk.pass(stmts);
        }
        if let Some(start) = start {
            self.mend(stmts, needs, &start, assumed, diags);
        }
        if self.compensated.refused.any() {
            let entries = self.entries.clone();
            match entries.is_some() || self.compensated.concerns(stmts) {
                true => {
                    compensated_modes::over(stmts, &mut self.compensated, entries.as_deref(), diags);
                    ran("compensated-modes", stmts);
                }
                false => self.compensated.note(stmts),
            }
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

    #[cold]
    fn mend(
        &mut self,
        stmts: &mut Vec<Stmt>,
        needs: u32,
        start: &Walk,
        assumed: &Modes,
        diags: &mut Vec<Diagnostic>,
    ) {
        if needs & CONTROL != 0 {
            expand_repeats::over(stmts, &self.target, diags);
            ran("expand-repeats", stmts);
        }
        if needs & POLAR != 0 {
            match self.with_polar_words(stmts, needs, start, assumed) {
                Some(mut found) => return diags.append(&mut found),
                None => {
                    // Corners and frames are worked out from exact points.
                    let exact = Target { decimals: EXACT - 1, ..self.target.clone() };
                    let target = if needs & (CORNER | FRAME) != 0 { &exact } else { &self.target };
                    polar_words::over(stmts, &mut start.clone(), &mut self.polar, target, false, diags);
                    ran("polar-words", stmts);
                }
            }
        }
        self.mend_further(stmts, needs & !POLAR, start, assumed, diags);
    }

    /// The same with polar points in the target's form; `None`, and nothing done, if another pass has to
    /// write out what they belong to.
    fn with_polar_words(
        &mut self,
        stmts: &mut Vec<Stmt>,
        needs: u32,
        start: &Walk,
        assumed: &Modes,
    ) -> Option<Vec<Diagnostic>> {
        let looks_into =
            needs & (FRAME | EVERY | CORNER) != 0 || self.cycles.is_busy() || self.taps.is_busy();
        if self.target.caps.polar == PolarForm::None || looks_into {
            return None;
        }
        let (mut own, mut kept, mut found) = (self.clone(), stmts.clone(), Vec::new());
        polar_words::over(&mut kept, &mut start.clone(), &mut own.polar, &own.target, true, &mut found);
        ran("polar-words", &kept);
        let holes = |stmts: &[Stmt]| {
            let polar = stmts.iter().filter(|stmt| matches!(stmt.op, Op::Polar(_))).count();
            let calls = stmts.iter().filter(|stmt| matches!(stmt.op, Op::StartCycle(_))).count();
            let others =
                stmts.iter().filter(|s| matches!(s.op, Op::Hole(_) | Op::Pattern(_) | moves!())).count();
            [polar, calls, others]
        };
        let before = holes(&kept);
        own.mend_further(&mut kept, needs & !POLAR, start, assumed, &mut found);
        let refused = found.iter().any(|d| d.fault.gravity() == Gravity::Error);
        if refused || needs & (CYCLE | PATTERN) != 0 && holes(&kept) != before {
            return None;
        }
        (*self, *stmts) = (own, kept);
        Some(found)
    }

    fn mend_further(
        &mut self,
        stmts: &mut Vec<Stmt>,
        needs: u32,
        start: &Walk,
        assumed: &Modes,
        diags: &mut Vec<Diagnostic>,
    ) {
        if needs & WORK != 0 {
            work_offset::over(stmts, &mut self.work, assumed, &self.target, diags);
            ran("work-offset", stmts);
        }
        if needs & PATH != 0 {
            path_control::over(stmts, &mut self.path, &self.target, diags);
            ran("path-control", stmts);
        }
        if needs & TURN != 0 {
            rotary_ways::over(stmts, &mut start.clone(), &self.target, diags);
            ran("rotary-ways", stmts);
        }
        if needs & SKIP != 0 {
            skip_levels::over(stmts, &mut self.skip, &self.target, diags);
            ran("skip-levels", stmts);
        }
        let needs = needs | self.mend_corners(stmts, needs, start, diags);
        if needs & FRAME != 0 {
            expand_frames::over(stmts, &mut start.clone(), &mut self.frames, &self.target, diags);
            ran("expand-frames", stmts);
        }
        // A shift that the program has set itself is over by now.
        if needs & SHIFT != 0 {
            origin_shift::over(stmts, &mut self.shift, diags);
            ran("origin-shift", stmts);
        }
        let mut needs = needs;
        if needs & MACHINE != 0 {
            let found = diags.len();
            machine_moves::over(stmts, &mut start.clone(), &mut self.machine, &self.target, diags);
            ran("machine-moves", stmts);
            let cut = diags[found..].iter().find(|d| matches!(d.fault, Fault::MachineCutExpanded { .. }));
            if let Some(at) = cut.map(|cut| cut.span) {
                origin_shift::take(&mut self.shift, at, diags);
            }
            needs |= self.lacks & (EDGE | TABLE | LENGTH);
        }
        if self.follow && needs & (CONTROL | WORK | SHIFT | FRAME | MACHINE) != 0 {
            self.walk = start.clone();
            if needs & FRAME != 0 && needs & ARC == 0 {
                self.arcs = arc_form::State::default();
                arc_form::follow(stmts, &mut self.walk, &mut self.arcs);
            } else {
                self.walk.pass(stmts);
            }
        }
        // Every pass walks from the same start: what it walks over does what the piece does.
        if needs & ARC != 0 {
            convert_arcs::too_fine(stmts, &mut start.clone(), &self.target, diags);
            ran("fine-arcs", stmts);
        }
        if needs & ARC != 0 && !self.target.caps.arc_forms {
            arc_form::over(stmts, &mut start.clone(), &mut self.arcs, &self.target, diags);
            ran("arc-form", stmts);
        }
        // Computed words are from zero, others may not be.
        let computed = self.measures && needs & (ARC | FRAME | CORNER) != 0;
        let mixed = computed && stmts.iter().any(|stmt| one_distance::may_mix(&stmt.op));
        let mut needs = if mixed { needs | MEASURE } else { needs };
        if needs & MEASURE != 0 && !self.target.caps.feed_apart {
            feed_unit::over(stmts, &mut start.clone(), &self.target);
            ran("feed-unit", stmts);
        }
        if needs & MEASURE != 0 && !self.target.caps.word_distance {
            one_distance::over(stmts, &mut start.clone(), diags);
            ran("one-distance", stmts);
        }
        if needs & (EDGE | TABLE) != 0 {
            tool_edge::over(stmts, &mut start.clone(), &mut self.edge, &self.target, diags);
            ran("tool-edge", stmts);
        }
        if needs & TABLE != 0 && self.target.caps.change_by_hand {
            length_by_hand::over(stmts, &mut start.clone(), &mut self.by_hand, diags);
            ran("length-by-hand", stmts);
        }
        if needs & TOOL_AXIS != 0 {
            tool_axis::over(stmts, &mut start.clone(), &mut self.axis, &self.target, diags);
            ran("tool-axis", stmts);
        }
        if needs & RADIUS != 0 {
            cutter_radius::over(stmts, &mut start.clone(), &mut self.radius, &self.target, diags);
            ran("cutter-radius", stmts);
        }
        if needs & (ARC | MESSAGE | CALL | CONTROL | MACHINE) != 0 {
            self.check(stmts, &mut start.clone(), diags);
            ran("refuse", stmts);
        }
        if needs & THREAD != 0 && stmts.iter().any(|stmt| in_step::is_cycle(stmt, &self.target)) {
            in_step::as_cycles(stmts, &mut start.clone(), &self.target);
            ran("threads-as-cycles", stmts);
            needs |= self.lacks & CYCLE;
        }
        if needs & THREAD != 0 && stmts.iter().any(|stmt| tapped_holes::is_half(stmt, &self.target)) {
            tapped_holes::over(stmts, &mut start.clone(), &self.target);
            ran("tapped-holes", stmts);
            needs |= self.lacks & CYCLE;
        }
        if needs & CYCLE != 0 {
            state_clearance::over(stmts, start.clone(), &self.target, diags);
            ran("state-clearance", stmts);
            taps::over(stmts, &mut start.clone(), &mut self.taps, &self.target, diags);
            ran("taps", stmts);
            return_plane::over(stmts, &mut start.clone(), &self.target, diags);
            ran("return-plane", stmts);
        }
        if needs & PATTERN != 0 {
            expand_patterns::over(stmts, &mut start.clone(), &self.target, diags);
            ran("expand-patterns", stmts);
        }
        if needs & CYCLE != 0 {
            approach::over(stmts, &mut start.clone(), &self.target, diags);
            ran("approach", stmts);
            expand_cycles::over(stmts, &mut start.clone(), &mut self.cycles, &self.target, diags);
            ran("expand-cycles", stmts);
            if !self.target.caps.incremental_cycles {
                absolute_holes::over(stmts, &mut start.clone(), diags);
                ran("absolute-holes", stmts);
            } else if self.target.caps.cycles_measured_anew {
                absolute_holes::alike(stmts, &mut start.clone(), diags);
                ran("holes-alike", stmts);
            }
        }
        spindle_angle::over(stmts, &mut self.angle, &self.target, diags);
        ran("spindle-angle", stmts);
        if needs & (CYCLE | THREAD) != 0 && self.lacks & THREAD != 0 {
            in_step::over(stmts, &mut start.clone(), &mut self.threads, &self.target, diags);
            ran("threads", stmts);
        }
        if needs & PATTERN != 0 {
            expand_patterns::reform(stmts, &mut start.clone(), &self.target, diags);
            ran("reform-patterns", stmts);
        }
        if needs & ARC != 0 && !self.target.caps.arc_turns {
            expand_turns::over(stmts, &mut start.clone(), &self.target, diags);
            ran("expand-turns", stmts);
        }
        // An expanded cycle may have left an offset that was in its block to take up elsewhere.
        if needs & LENGTH != 0 {
            offset_with_z::over(stmts, &mut start.clone(), &mut self.length, diags);
            ran("offset-with-z", stmts);
        }
        if needs & MOVE != 0 {
            one_move::over(stmts, &mut self.one);
            ran("one-move", stmts);
        }
        if needs & EVERY != 0 {
            flatten_facts::over(stmts, &mut start.clone(), diags);
            ran("flatten-facts", stmts);
        }
        // What is left as it is now is what is written.
        if needs & AT_ONCE != 0 {
            at_once::over(stmts, &mut start.clone(), &mut self.at_once, &self.target, diags);
            ran("at-once", stmts);
        }
    }

    /// Writes corners out, and says what is needed because of it: they are arcs, which their moves need
    /// not be, and their words are measured from zero.
    fn mend_corners(
        &mut self,
        stmts: &mut Vec<Stmt>,
        needs: u32,
        start: &Walk,
        diags: &mut Vec<Diagnostic>,
    ) -> u32 {
        if needs & CORNER == 0 {
            return 0;
        }
        let (found, whole) = (diags.len(), needs & FRAME != 0);
        let keep = if whole { expand_corners::Keep::None } else { expand_corners::Keep::Sayable };
        expand_corners::over(stmts, &mut start.clone(), &mut self.corners, &self.target, keep, diags);
        ran("expand-corners", stmts);
        let written = diags[found..].iter().any(|d| matches!(d.fault, Fault::CornerExpanded));
        if written { self.lacks & ARC } else { 0 }
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

    /// Refuses what no pass can mend.
    fn check(&self, stmts: &mut [Stmt], walk: &mut Walk, diags: &mut Vec<Diagnostic>) {
        let caps = &self.target.caps;
        for stmt in &mut *stmts {
            walk.enter(stmt.skip);
            if !caps.offset_turns {
                work_offset::leave_straight(&mut stmt.op);
            }
            if let (Op::ArcFeed(arc), Some(source)) = (&mut stmt.op, &self.source_arcs) {
                match arc_radii::over(arc, walk, source, &self.target) {
                    arc_radii::Judged::Kept => {}
                    arc_radii::Judged::ByCentre => {
                        diags.push(Diagnostic::new(Fault::ArcReformatted, stmt.span));
                    }
                    arc_radii::Judged::Refused(fault) => diags.push(Diagnostic::new(fault, stmt.span)),
                }
            }
            let mut cannot = |what: &str| {
                diags.push(Diagnostic::new(Fault::CannotSay { what: what.into() }, stmt.span));
            };
            match &stmt.op {
                Op::ArcFeed(arc) if !caps.helix && is_helix(arc, &walk.at) => cannot("a helix"),
                Op::Control(_) if !caps.repeats => cannot("control of the program's flow"),
                Op::Goto(_) if !caps.repeats => cannot("a jump"),
                Op::Label(_) if !caps.repeats && !caps.repeat_blocks => cannot("a jump"),
                Op::Call(_) if !caps.calls => cannot("a call"),
                Op::Return if !caps.calls => cannot("a return"),
                Op::UseMachineCoordinates { .. } if !caps.machine_coordinates => {
                    cannot("a move in machine coordinates");
                }
                Op::UseMachineCoordinates { length } if caps.machine_length.is_some_and(|l| l != *length) => {
                    cannot(if *length {
                        "a move in machine coordinates that is measured with the tool's length"
                    } else {
                        "a move in machine coordinates without the tool's length"
                    });
                }
                Op::UseToolLength(length) if !caps.says_length(length) => cannot("a length of no table"),
                Op::SetData(data) => match &**data {
                    Data::Offset { turn: Some(_), .. } if !caps.offset_turns => {
                        cannot("rotation of a work offset");
                    }
                    Data::Offset { mode, .. } if caps.offset_data[*mode as usize] => {}
                    Data::Tool { .. } | Data::Measured { .. } => {
                        if let Some(what) = tool_data::refusal(data, &walk.at, caps) {
                            cannot(what);
                        }
                    }
                    Data::Position(place) if caps.stored_positions[usize::from(*place == 2)] => {}
                    Data::ToolInSpindle(_) if caps.tool_number => {}
                    Data::Position(_) => cannot("storing where the axes stand"),
                    Data::ToolInSpindle(_) => cannot("setting the number of the tool in the spindle"),
                    Data::Offset { .. } => cannot("this value in the control's tables"),
                },
                _ => {}
            }
            walk.step(stmt);
        }
        if !caps.messages {
            messages::drop_messages(stmts, caps, diags);
        }
    }
}

/// Whether an arc has a word of the third axis that moves it.
fn is_helix(arc: &Arc, here: &Tracker) -> bool {
    let axis = match here.plane(arc.plane) {
        Some(plane) => plane.axes().2,
        None => return true,
    };
    let now = here.position[axis as usize];
    arc.to.get(axis).is_some_and(|word| now.is_none() || here.resolve(word, now) != now)
}
