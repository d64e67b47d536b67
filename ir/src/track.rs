//! Where the tool stands and what is in force, as far as the program itself says it.
//!
//! An abstract execution in program coordinates: an axis is known or it is not. For passes and
//! back-ends, which have no world. Nothing is taken for granted beyond the entry facts given.

use crate::canon::{AXES, Axis, Distance, Fact, Modes, Motion, Plane, ReturnLevel, Units};
use crate::cycle::{Cycle, Pattern};
use crate::expr::Expr;
use crate::geometry;
use crate::num::Nanos;
use crate::program::{Arc, Coord, FrameSlot, Move, Op, Point, Stmt};

/// State of the abstract execution.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tracker {
    /// Facts in force; `None` is not known.
    pub modes: Modes,
    /// Position in the program's frame, nanos; `None` is not known.
    pub position: [Option<Nanos>; AXES],
    /// The cycle in force.
    pub cycle: Option<InForce>,
    /// Whether another cycle than `cycle` may be in force, because of a block that may be skipped.
    pub cycle_in_doubt: bool,
    /// The selected tool, if it is a literal.
    pub selected: Option<i64>,
}

/// A cycle in force, with its planes resolved as far as they are known.
#[derive(Clone, Debug, PartialEq)]
pub struct InForce {
    /// The cycle.
    pub cycle: Cycle,
    /// Level of the drilling axis when it was called up.
    pub initial: Option<Nanos>,
    /// The retract plane.
    pub retract: Option<Nanos>,
    /// The bottom.
    pub depth: Option<Nanos>,
    /// Whether it has made a hole since its call.
    pub drilled: bool,
}

impl Tracker {
    /// A start with these facts in force and no axis known.
    pub fn new(entry: Modes) -> Tracker {
        Tracker { modes: entry, ..Tracker::default() }
    }

    /// The value of a literal in nanos; `None` if it is computed, too fine, or of unknown unit.
    #[inline]
    pub fn nanos(&self, value: &Expr) -> Option<Nanos> {
        let n = value.literal()?;
        if n.unit == crate::num::Unit::Entry && !n.is_zero() {
            return n.nanos(self.modes.units? == Units::Inch);
        }
        n.nanos(false)
    }

    /// The plane of a statement.
    pub fn plane(&self, plane: Fact<Plane>) -> Option<Plane> {
        plane.known().or(self.modes.plane)
    }

    /// Where a coordinate word puts an axis that stands at `from`.
    #[inline]
    pub fn resolve(&self, coord: &Coord, from: Option<Nanos>) -> Option<Nanos> {
        let value = self.nanos(&coord.value)?;
        match coord.distance.known().or(self.modes.distance)? {
            Distance::Absolute => Some(value),
            Distance::Incremental => from?.checked_add(value),
        }
    }

    /// Where the words of a point put the axes.
    #[inline]
    pub fn target(&self, to: &Point) -> [Option<Nanos>; AXES] {
        let mut position = self.position;
        for (axis, word) in to.axes.iter().enumerate() {
            if let Some(coord) = word {
                position[axis] = self.resolve(coord, position[axis]);
            }
        }
        position
    }

    /// Centre of an arc in its plane, in program coordinates, if it is known.
    pub fn centre(&self, arc: &Arc) -> Option<[Nanos; 2]> {
        use crate::program::{Centre, CentreFrom};
        let (first, second, _) = self.plane(arc.plane)?.axes();
        let at = |axis: Axis| self.position[axis as usize];
        match &arc.centre {
            Centre::Point { words, from } => {
                let along = |axis: Axis| -> Option<Nanos> {
                    match (&words[axis as usize], from) {
                        (None, CentreFrom::Start) => at(axis),
                        (None, CentreFrom::Zero) => None,
                        (Some(word), CentreFrom::Zero) => self.nanos(word),
                        (Some(word), CentreFrom::Start) => at(axis)?.checked_add(self.nanos(word)?),
                    }
                };
                Some([along(first)?, along(second)?])
            }
            Centre::Radius(radius) => {
                let end = self.target(&arc.to);
                let start = [at(first)?, at(second)?];
                let end = [end[first as usize]?, end[second as usize]?];
                geometry::centre_by_radius(start, end, self.nanos(radius)?, arc.turn).ok()
            }
        }
    }

    /// Hole positions of a pattern in the plane's two axes, as far as they are known.
    pub fn positions(&self, pattern: &Pattern) -> Option<Vec<[Nanos; 2]>> {
        let plane = self.cycle.as_ref().map_or(Fact::Entry, |c| c.cycle.plane);
        let (first, second, _) = self.plane(plane)?.axes();
        let at = |axis: Axis| self.position[axis as usize];
        match pattern {
            Pattern::Circle { centre, first: start, step, count } => {
                let centre = match centre {
                    Some([x, y]) => [self.resolve(x, at(first))?, self.resolve(y, at(second))?],
                    None => [at(first)?, at(second)?],
                };
                let start = [self.resolve(&start[0], at(first))?, self.resolve(&start[1], at(second))?];
                let step = self.nanos(step)?;
                Some((0..*count).map(|k| geometry::circle_position(centre, start, step, k)).collect())
            }
            Pattern::Grid { columns, rows, serpentine } => {
                let (dx, dy) = (self.nanos(&columns.pitch)?, self.nanos(&rows.pitch)?);
                let origin = [at(first)?, at(second)?];
                let total = columns.count.checked_mul(rows.count)?;
                let place = |axis: Axis, pitch: Nanos, n: u32, p: &mut [Nanos; 2]| -> Option<()> {
                    let along = &mut p[usize::from(axis == second)];
                    *along = along.checked_add(pitch.checked_mul(i64::from(n))?)?;
                    Some(())
                };
                (0..total)
                    .map(|k| {
                        let (c, r) = geometry::grid_position(columns.count, *serpentine, k);
                        let mut p = origin;
                        place(columns.axis, dx, c, &mut p)?;
                        place(rows.axis, dy, r, &mut p)?;
                        Some(p)
                    })
                    .collect()
            }
        }
    }

    /// Forgets everything: after a call, at a label.
    pub fn forget(&mut self) {
        *self = Tracker::default();
    }

    /// Executes a statement.
    #[inline]
    pub fn step(&mut self, stmt: &Stmt) {
        if stmt.skip.is_some() {
            let skipped = self.clone();
            self.apply(&stmt.op);
            self.join(&skipped);
        } else {
            self.apply(&stmt.op);
        }
    }

    /// What holds on both of two ways.
    pub fn join(&mut self, other: &Tracker) {
        fn both<T: PartialEq>(a: &mut Option<T>, b: &Option<T>) {
            if a != b {
                *a = None;
            }
        }
        let (m, o) = (&mut self.modes, &other.modes);
        both(&mut m.motion, &o.motion);
        both(&mut m.distance, &o.distance);
        both(&mut m.units, &o.units);
        both(&mut m.plane, &o.plane);
        both(&mut m.feed_mode, &o.feed_mode);
        both(&mut m.return_level, &o.return_level);
        both(&mut m.work_offset, &o.work_offset);
        both(&mut m.length_offset, &o.length_offset);
        both(&mut m.no_origin_shift, &o.no_origin_shift);
        for (a, b) in self.position.iter_mut().zip(&other.position) {
            both(a, b);
        }
        match (&mut self.cycle, &other.cycle) {
            // A hole that may have been skipped: the next one may be the first.
            (Some(a), Some(b))
                if a.drilled != b.drilled && (InForce { drilled: b.drilled, ..a.clone() }) == *b =>
            {
                a.drilled = false;
            }
            (a, b) => {
                self.cycle_in_doubt |= a != b;
                both(a, b);
            }
        }
        self.cycle_in_doubt |= other.cycle_in_doubt;
        both(&mut self.selected, &other.selected);
    }

    /// Executes an operation, whatever the block-skip switches say.
    pub fn apply(&mut self, op: &Op) {
        match op {
            Op::StraightTraverse(m) => self.go(&m.to, Motion::Traverse),
            Op::StraightFeed(m) => self.go(&m.to, Motion::Feed),
            Op::ArcFeed(arc) => self.go(&arc.to, Motion::Arc(arc.turn)),
            Op::Position(m) => match self.modes.motion {
                Some(Motion::Cycle) => self.hole(m),
                Some(motion) => self.go(&m.to, motion),
                // A hole would move the drilling axis as well.
                None => {
                    self.position = self.target(&m.to);
                    self.position[..3].fill(None);
                }
            },
            Op::StartCycle(cycle) => self.start_cycle(cycle),
            Op::Hole(m) => self.hole(m),
            Op::Pattern(pattern) => {
                let last = self.positions(pattern).and_then(|p| p.last().copied());
                let plane = self.cycle.as_ref().and_then(|c| self.plane(c.cycle.plane));
                match (plane, last) {
                    (Some(plane), Some(last)) => {
                        let (first, second, _) = plane.axes();
                        self.position[first as usize] = Some(last[0]);
                        self.position[second as usize] = Some(last[1]);
                        self.out_of_hole();
                    }
                    _ => self.position[..3].fill(None),
                }
            }
            Op::EndCycle => {
                self.cycle = None;
                self.cycle_in_doubt = false;
                if self.modes.motion == Some(Motion::Cycle) {
                    self.modes.motion = None;
                }
            }
            Op::UseLengthUnits(u) => self.modes.units = Some(*u),
            Op::SetDistanceMode(d) => self.modes.distance = Some(*d),
            Op::SelectPlane(p) => self.modes.plane = Some(*p),
            Op::SetFeedMode(f) => self.modes.feed_mode = Some(*f),
            Op::SetReturnLevel(r) => self.modes.return_level = Some(*r),
            Op::SetOriginOffsets(n) => {
                if self.modes.work_offset != Some(*n) {
                    self.modes.work_offset = Some(*n);
                    self.position = [None; AXES];
                }
            }
            Op::ClearFrame(FrameSlot::Shift) => {
                if self.modes.no_origin_shift != Some(true) {
                    self.modes.no_origin_shift = Some(true);
                    self.position = [None; AXES];
                }
            }
            Op::ClearFrame(_) | Op::SetFrame(..) => self.position = [None; AXES],
            Op::UseToolLengthOffset(entry) => {
                let entry = entry.literal().and_then(|n| n.whole()).and_then(|n| u32::try_from(n).ok());
                self.modes.length_offset = entry;
            }
            Op::SelectTool(tool) => self.selected = tool.literal().and_then(|n| n.whole()),
            Op::Call(_) | Op::Control(_) | Op::Goto(_) | Op::Label(_) | Op::Return => self.forget(),
            Op::Comment(_)
            | Op::NoEffect(_)
            | Op::Blank
            | Op::StopCutterRadiusCompensation
            | Op::SetFeedRate(_)
            | Op::SetSpindleSpeed(_)
            | Op::ChangeTool
            | Op::StartSpindleClockwise
            | Op::StartSpindleCounterclockwise
            | Op::StopSpindleTurning
            | Op::FloodOn
            | Op::MistOn
            | Op::CoolantOff
            | Op::Dwell(_)
            | Op::ProgramStop
            | Op::OptionalProgramStop
            | Op::ProgramEnd
            | Op::Message(_)
            | Op::Assign(..) => {}
        }
    }

    #[inline]
    fn go(&mut self, to: &Point, motion: Motion) {
        self.position = self.target(to);
        self.modes.motion = Some(motion);
        self.cycle = None;
        self.cycle_in_doubt = false;
    }

    fn start_cycle(&mut self, cycle: &Cycle) {
        let normal = self.plane(cycle.plane).map(|p| p.axes().2);
        let initial = match &self.cycle {
            Some(before) => before.initial,
            None if self.cycle_in_doubt => None,
            None => normal.and_then(|axis| self.position[axis as usize]),
        };
        let retract = self.resolve(&cycle.retract, initial);
        let depth = self.resolve(&cycle.depth, retract);
        self.cycle = Some(InForce { cycle: cycle.clone(), initial, retract, depth, drilled: false });
        self.cycle_in_doubt = false;
        self.modes.motion = Some(Motion::Cycle);
    }

    fn hole(&mut self, m: &Move) {
        self.position = self.target(&m.to);
        self.out_of_hole();
    }

    fn out_of_hole(&mut self) {
        let Some(in_force) = &mut self.cycle else {
            self.position[..3].fill(None);
            return;
        };
        in_force.drilled = true;
        let level = match in_force.cycle.return_level.known().or(self.modes.return_level) {
            Some(ReturnLevel::Retract) => in_force.retract,
            Some(ReturnLevel::Initial) => in_force.initial,
            None => None,
        };
        match in_force.cycle.plane.known().or(self.modes.plane) {
            Some(plane) => self.position[plane.axes().2 as usize] = level,
            None => self.position[..3].fill(None),
        }
    }
}
