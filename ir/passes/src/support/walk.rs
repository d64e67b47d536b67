//! Walking a body of statements: where the tool is on the way, and block skip.
//!
//! A stretch of blocks with one skip level is executed whole or not at all, so that what holds
//! afterwards is what holds on both paths; within the stretch nothing is in doubt. A block of modes alone
//! (`/T2 M06`, `G17 G90`, `/G43 H2 Z5.`) does not end such a stretch.

use ncc_ir::canon::{AXES, Axis, Distance, Fact, Modes, Motion, Plane};
use ncc_ir::expr::num::Unit;
use ncc_ir::program::cycle::Pattern;
use ncc_ir::program::kinds::{conduct, flow, frames, miscellaneous, modes, tooling, variables};
use ncc_ir::program::{Coord, Move, Op, Point, Program, Stmt};
use ncc_ir::track::Tracker;

/// A tracker that knows stretches of skipped blocks.
#[derive(Clone, Debug, Default)]
pub(crate) struct Walk {
    /// State before the statement that comes next.
    pub(crate) at: Tracker,
    /// Whether a length offset waits for a command of Z, or may wait.
    pub(crate) waiting: bool,
    /// The level of the stretch that is being walked, and the state if it is skipped.
    skipped: Option<(u8, Box<Tracker>)>,
    /// A stretch that goes on where only modes come between: its level, the state where it is executed, and the
    /// state where it is skipped.
    paused: Option<(u8, Box<[Tracker; 2]>)>,
    /// Facts assumed that the tracker has already.
    assumed: Modes,
}

/// The last absolute words of plain moves.
#[derive(Default)]
struct Last<'s> {
    words: [Option<&'s Coord>; AXES],
    motion: Option<Motion>,
}

impl<'s> Last<'s> {
    /// Notes a move, if all of its words are absolute.
    #[inline]
    fn note(&mut self, to: &'s Point, motion: Motion) -> bool {
        let absolute = |word: &Option<Coord>| {
            word.as_ref().is_none_or(|w| matches!(w.distance, Fact::Known(Distance::Absolute)))
        };
        if !to.axes.iter().all(absolute) {
            return false;
        }
        for (last, word) in self.words.iter_mut().zip(&to.axes) {
            if let Some(word) = word {
                *last = Some(word);
            }
        }
        self.motion = Some(motion);
        true
    }
}

impl Walk {
    /// A walk that starts in this state.
    pub(crate) fn new(start: Tracker) -> Walk {
        Walk { at: start, ..Walk::default() }
    }

    /// Goes into or out of a stretch of skipped blocks, as the next statement's level says.
    #[inline]
    pub(crate) fn enter(&mut self, skip: Option<u8>) {
        if self.skipped.is_some() || skip.is_some() {
            self.turn(skip);
        }
    }

    #[cold]
    fn turn(&mut self, skip: Option<u8>) {
        if self.skipped.as_ref().map(|s| s.0) == skip {
            return;
        }
        if let Some((level, before)) = self.skipped.take() {
            if skip.is_none() {
                self.paused = Some((level, Box::new([self.at.clone(), (*before).clone()])));
            }
            self.at.join(&before);
        }
        let paused = self.paused.take_if(|_| skip.is_some());
        self.skipped = match (skip, paused) {
            (Some(level), Some((own, states))) if own == level => {
                let [executed, skipped] = *states;
                self.at = executed;
                Some((level, Box::new(skipped)))
            }
            _ => skip.map(|level| (level, Box::new(self.at.clone()))),
        };
    }

    /// Takes a statement outside of skipped blocks into the states of a stretch that may go on.
    #[cold]
    fn pause(&mut self, op: &Op) {
        match op {
            modes!() => self.paused.iter_mut().flat_map(|paused| &mut *paused.1).for_each(|at| at.apply(op)),
            Op::Comment(_) | Op::Blank => {}
            _ => self.paused = None,
        }
    }

    /// Executes a statement.
    #[inline]
    pub(crate) fn step(&mut self, stmt: &Stmt) {
        self.enter(stmt.skip);
        if self.paused.is_some() {
            self.pause(&stmt.op);
        }
        if stmt.op.calls_length() {
            self.waiting = true;
        } else if self.waiting && stmt.skip.is_none() && self.commands_z(&stmt.op) {
            self.waiting = false;
        }
        self.at.apply(&stmt.op);
    }

    /// Executes statements, as [`Walk::step`] does one: plain moves leave no more than their last
    /// words, so that a long surface costs little.
    #[inline]
    pub(crate) fn pass(&mut self, stmts: &[Stmt]) {
        let mut last = Last::default();
        for stmt in stmts {
            let (to, motion) = match &stmt.op {
                Op::StraightFeed(m) => (&m.to, Motion::Feed),
                Op::StraightTraverse(m) => (&m.to, Motion::Traverse),
                _ => {
                    self.take(&mut last);
                    self.step(stmt);
                    continue;
                }
            };
            let plain = stmt.skip.is_none() && self.skipped.is_none() && self.paused.is_none();
            let plain = plain && !self.waiting && !self.at.raw;
            let plain = plain && !self.at.probing && !self.at.detour;
            if !(plain && last.note(to, motion)) {
                self.take(&mut last);
                self.step(stmt);
            }
        }
        self.take(&mut last);
    }

    fn take(&mut self, last: &mut Last<'_>) {
        let Some(motion) = last.motion.take() else { return };
        let to = std::mem::take(&mut last.words);
        for (axis, word) in to.into_iter().enumerate() {
            if let Some(word) = word {
                self.at.position[axis] = self.at.nanos(&word.value);
            }
        }
        // What a move does besides: it sets the motion and ends a cycle.
        self.at.apply(&match motion {
            Motion::Feed => Op::StraightFeed(Move::default()),
            Motion::Traverse | Motion::Arc(_) | Motion::Cycle => Op::StraightTraverse(Move::default()),
        });
    }

    /// Takes over facts that were assumed since the last time.
    pub(crate) fn assume(&mut self, assumed: &Modes) {
        if self.assumed == *assumed {
            return;
        }
        let skipped = self.skipped.as_mut().map(|s| &mut s.1.modes);
        let paused = self.paused.iter_mut().flat_map(|paused| &mut *paused.1).map(|at| &mut at.modes);
        for modes in std::iter::once(&mut self.at.modes).chain(skipped).chain(paused) {
            macro_rules! take {
                ($($fact:ident)*) => {$(
                    if self.assumed.$fact.is_none() && modes.$fact.is_none() {
                        modes.$fact = assumed.$fact;
                    }
                )*};
            }
            take!(motion distance units plane feed_mode return_level work_offset length_offset no_origin_shift);
        }
        self.assumed = *assumed;
    }

    /// Whether a statement surely commands the Z axis, so that a waiting length offset takes effect.
    pub(crate) fn commands_z(&self, op: &Op) -> bool {
        let normal_is_z = || {
            let plane = self.at.cycle.as_ref().and_then(|c| c.cycle.plane.known());
            plane.or(self.at.modes.plane).is_none_or(|p| p == Plane::Xy)
        };
        match op {
            Op::StraightTraverse(m) | Op::StraightFeed(m) => {
                m.to.get(Axis::Z).is_some() && (!self.at.raw || self.at.raw_length)
            }
            Op::SynchronisedFeed(m) => m.to.get(Axis::Z).is_some(),
            Op::ArcFeed(arc) => arc.to.get(Axis::Z).is_some(),
            Op::ArcForm(arc) => arc.to.get(Axis::Z).is_some(),
            Op::Position(m) => {
                m.to.get(Axis::Z).is_some() || self.at.modes.motion == Some(Motion::Cycle) && normal_is_z()
            }
            Op::Hole(m) => m.to.get(Axis::Z).is_some() || normal_is_z(),
            // Its places are in the plane of X and Y, above which it drills, or in one with Z.
            Op::Pattern(pattern) => has_holes(pattern),
            Op::GoToReference(reference) => reference.via.get(Axis::Z).is_some(),
            Op::Polar(polar) => {
                let of_plane = self.at.plane(polar.plane).is_some_and(|plane| plane != Plane::Xy);
                of_plane || self.commands_z(&polar.op)
            }
            Op::SetPole(_) => false,
            Op::SetData(_)
            | Op::OrientToolAxis(_)
            | Op::SetFeedRate(_)
            | Op::StartCycle(_)
            | Op::EndCycle
            | Op::ProgramEnd
            | Op::BeginAgain
            | variables!()
            | miscellaneous!()
            | conduct!()
            | modes!()
            | tooling!()
            | frames!()
            | flow!() => false,
        }
    }

    /// The unit in which lengths are written here: the active one, or that of the active cycle.
    pub(crate) fn unit(&self) -> Unit {
        let of_cycle = || {
            let retract = self.at.cycle.as_ref()?.cycle.retract.value.literal()?;
            (retract.unit == Unit::Inch).then_some(Unit::Inch)
        };
        match self.at.modes.units {
            Some(ncc_ir::canon::Units::Mm) => Unit::Mm,
            Some(ncc_ir::canon::Units::Inch) => Unit::Inch,
            // A literal in mm is what it says, whatever is active.
            None => of_cycle().unwrap_or(Unit::Mm),
        }
    }
}

/// Whether a pattern makes any hole.
pub(crate) fn has_holes(pattern: &Pattern) -> bool {
    match pattern {
        Pattern::Circle { count, .. } | Pattern::Line { count, .. } => *count > 0,
        Pattern::List(points) => !points.is_empty(),
        Pattern::Grid { columns, rows, .. } => columns.count > 0 && rows.count > 0,
    }
}

/// Runs a pass over each procedure; what holds before a subprogram is not known.
pub(crate) fn each_body(
    program: &mut Program,
    entry: &Tracker,
    mut over: impl FnMut(&mut Vec<Stmt>, &mut Walk),
) {
    for (at, procedure) in program.procedures.iter_mut().enumerate() {
        let mut walk = Walk::new(if at == 0 { entry.clone() } else { Tracker::unknown() });
        over(&mut procedure.body, &mut walk);
    }
}
