//! Where the tool stands and what is active, as far as the program itself says it.
//!
//! An abstract execution in program coordinates: an axis is known or it is not. For passes and
//! back-ends, which have no world. Nothing is assumed beyond the entry facts given.

mod frames;
mod holes;
mod intermediate;
mod known;
mod merge;
mod shifted;

pub use self::shifted::Shifted;

use known::{Known, Polarly, Turning};

use crate::canon::{AXES, Axis, Distance, Fact, Modes, Motion, Plane, Spindle, Units};
use crate::computed::computed_code::computed_code;
use crate::computed::computed_entry::is_about_entries;
use crate::expr::Expr;
use crate::expr::num::{Nanos, Num};
use crate::geometry;
use crate::geometry::arc_solver::{MOST_SHORT, solve_arc};
use crate::geometry::hole_positions::HolePositions;
use crate::geometry::polar::{self, Pole};
use crate::program::cycle::{Cycle, Pattern};
use crate::program::kinds::{conduct, flow, frames, machine, miscellaneous, variables};
use crate::program::{
    Arc, ArcForm, Coord, Data, FrameSlot, Op, Point, Polar, SetPole, Shape, Stmt, ToolLength, ToolValue,
};

/// State of the abstract execution.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tracker {
    /// Facts active; `None` is not known.
    pub modes: Modes,
    /// Position in the program's frame, nanos; `None` is not known.
    pub position: [Option<Nanos>; AXES],
    /// The active cycle.
    pub cycle: Option<ActiveCycle>,
    /// Whether another cycle than `cycle` may be active, because of a block that may be skipped.
    pub cycle_in_doubt: bool,
    /// From which level it then works, if it is active.
    pub doubtful_initial: Option<Nanos>,
    /// The selected tool, if it is a literal.
    pub selected: Option<i64>,
    /// The tool in the spindle, if it is known.
    pub tool: Option<i64>,
    /// Whether a frame of the chain may be active.
    pub framed: bool,
    /// Whether that is one of the chain of frames.
    pub chained: bool,
    /// What the spindle does, if it is known.
    pub spindle: Option<Spindle>,
    /// The active spindle speed, if it is a number that is known.
    pub speed: Option<Num>,
    /// The active feed, if it is a number that is known.
    pub feed: Option<Num>,
    /// Whether any feed may have been stated.
    pub fed: bool,
    /// Whether the units may have changed since it was stated.
    pub stale_feed: bool,
    /// Whether a slot may turn, scale or mirror.
    pub turned: bool,
    /// Which slots may: rotation, scale, mirror.
    pub turning: [bool; 3],
    /// The local shift.
    pub local: Shifted,
    /// By how much the chain moves the origin.
    pub chain: Shifted,
    /// Whether it may turn, scale or mirror too.
    pub chain_turned: bool,
    /// Whether the next straight move is in machine coordinates.
    pub raw: bool,
    /// Whether that move is measured with the tool's length.
    pub raw_length: bool,
    /// Whether the next straight move at feed is a probing one.
    pub probing: bool,
    /// Whether the next rapid straight move goes another way than straight.
    pub detour: bool,
    /// Through which points axes went to reference points.
    pub intermediate: intermediate::Intermediate,
    /// The pole of polar words.
    pub pole: Pole,
    /// Whether it is not known.
    pub pole_lost: bool,
    /// Whether no numbers of a G92 shift are kept that are not active.
    pub none_suspended: bool,
    /// Whether cutter radius compensation may be on.
    pub compensated: bool,
    /// Whether points may be those of the tool tip, or of a tilted plane.
    pub tilted: bool,
    /// Whether offsets of tools along X and Y have been stated: a length activated may then put the tool elsewhere in
    /// the plane too.
    pub aside: bool,
    /// A tool change takes Z to where nothing but the machine knows.
    pub z_lost_at_change: bool,
}

/// An active cycle, with its planes resolved as far as they are known.
#[derive(Clone, Debug, PartialEq)]
pub struct ActiveCycle {
    /// The cycle.
    pub cycle: Cycle,
    /// Level of the drilling axis when it was activated.
    pub initial: Option<Nanos>,
    /// The retract plane.
    pub retract: Option<Nanos>,
    /// The bottom.
    pub depth: Option<Nanos>,
    /// The plane to which it returns, if the cycle states one.
    pub return_plane: Option<Nanos>,
    /// Whether it has made a hole since its call.
    pub drilled: bool,
}

impl Tracker {
    /// A start with these active facts and no axis known.
    pub fn new(entry: Modes) -> Tracker {
        Tracker { modes: entry, ..Tracker::default() }
    }

    /// The start of a subprogram: whatever its caller has done.
    pub fn unknown() -> Tracker {
        Tracker {
            fed: true,
            framed: true,
            chained: true,
            turned: true,
            turning: [true; 3],
            local: Shifted::LOST,
            chain: Shifted::LOST,
            chain_turned: true,
            pole_lost: true,
            ..Tracker::default()
        }
    }

    /// The value of a literal in nanos; `None` if it is computed, too fine, or of unknown unit.
    #[inline]
    pub fn nanos(&self, value: &Expr) -> Option<Nanos> {
        let n = value.literal()?;
        if n.unit == crate::expr::num::Unit::Entry && !n.is_zero() {
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
                geometry::centre_by_radius(start, end, self.nanos(radius)?, arc.turn, MOST_SHORT).ok()
            }
        }
    }

    /// Hole positions of a pattern in the plane's two axes, as far as they are known.
    pub fn positions(&self, pattern: &Pattern) -> Option<Vec<[Nanos; 2]>> {
        let places = self.hole_positions(pattern)?;
        Some((0..places.count()).map(|k| places.get(k)).collect())
    }

    /// The places of a pattern in the plane's two axes, as far as they are known.
    pub fn hole_positions(&self, pattern: &Pattern) -> Option<HolePositions> {
        let plane = self.cycle.as_ref().map_or(Fact::Entry, |c| c.cycle.plane);
        let plane = self.plane(plane)?;
        let (first, second, _) = plane.axes();
        HolePositions::from_pattern(pattern, plane, &Known { at: self, axes: [first, second] }).ok()
    }

    /// Forgets everything: after a call, at a label.
    pub fn forget(&mut self) {
        // What is called leaves compensation as it was, or executes with another.
        let Tracker { compensated, tilted, aside, .. } = *self;
        *self = Tracker { compensated, tilted, aside, ..Tracker::unknown() };
    }

    /// Executes a statement.
    #[inline]
    pub fn step(&mut self, stmt: &Stmt) {
        if stmt.skip.is_none() {
            self.apply(&stmt.op);
        } else if !self.skips_line(&stmt.op) {
            let skipped = self.clone();
            self.apply(&stmt.op);
            self.join(&skipped);
        }
    }

    /// Executes an operation, whatever the block-skip switches say.
    pub fn apply(&mut self, op: &Op) {
        if matches!(op, frames!() | machine!()) {
            self.lose_intermediate(op);
        }
        match op {
            Op::StraightTraverse(m) => self.go(&m.to, Motion::Traverse),
            Op::StraightFeed(m) => self.go(&m.to, Motion::Feed),
            Op::SynchronisedFeed(m) => {
                let began = self.position;
                self.go(&m.to, Motion::Feed);
                if m.back {
                    self.position = began;
                }
                // What a block without a code does after it is another thing on each control.
                self.modes.motion = None;
                if m.turn.is_some() {
                    self.spindle = Some(Spindle::Stopped);
                }
            }
            Op::ArcFeed(arc) => self.go(&arc.to, Motion::Arc(arc.turn)),
            Op::ArcForm(arc) => self.go_form(arc),
            Op::Position(m) => match self.modes.motion {
                Some(Motion::Cycle) => self.hole(m),
                Some(motion) => self.go(&m.to, motion),
                // A hole would move the drilling axis as well.
                None => {
                    self.position = self.target(&m.to);
                    self.position[..3].fill(None);
                }
            },
            Op::SetPole(set) => self.set_pole(set),
            Op::Polar(polar) => self.go_polar(polar),
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
            Op::UseLengthUnits(u) => {
                self.stale_feed |= self.fed && self.modes.units != Some(*u);
                self.modes.units = Some(*u);
                self.feed = None;
            }
            Op::SetDistanceMode(d) => self.modes.distance = Some(*d),
            Op::SelectPlane(p) => self.modes.plane = Some(*p),
            Op::SetFeedMode(f) => {
                // Another mode ends the feed on every control.
                self.stale_feed &= self.modes.feed_mode == Some(*f);
                self.modes.feed_mode = Some(*f);
                self.feed = None;
            }
            Op::SetReturnLevel(r) => self.modes.return_level = Some(*r),
            Op::SetOriginOffsets(n) => {
                if self.modes.work_offset != Some(*n) {
                    self.modes.work_offset = Some(*n);
                    self.position = [None; AXES];
                }
            }
            Op::ClearFrame(FrameSlot::Shift) => {
                self.none_suspended = true;
                self.end_origin_shift();
            }
            Op::UseOriginShift(false) => {
                self.none_suspended &= self.modes.no_origin_shift == Some(true);
                self.end_origin_shift();
            }
            Op::UseOriginShift(true) => {
                self.modes.no_origin_shift = None;
                self.position = [None; AXES];
                self.none_suspended = true;
            }
            Op::ClearFrame(slot) => self.clear_frame(*slot),
            Op::SetSlot(slot) => self.set_slot(slot),
            Op::SetPosition(axes) => {
                self.modes.no_origin_shift = None;
                self.none_suspended = true;
                for (axis, word) in axes.iter().enumerate() {
                    if let Some(word) = word {
                        self.position[axis] = self.nanos(word);
                        self.local.to(axis, Some(0));
                    }
                }
            }
            Op::SetFrame(frame) => {
                self.set_frame(frame);
                self.framed = true;
                self.chained = true;
            }
            Op::UseToolCentrePoint(on) => {
                self.position[..3].fill(None);
                self.tilted = *on;
            }
            Op::OrientToolAxis(_) => self.position = [None; AXES],
            Op::Probe(_) => self.probing = true,
            Op::Detour(_) => self.detour = true,
            Op::UseMachineCoordinates { length } => {
                self.raw = true;
                self.raw_length = *length;
            }
            Op::GoToReference(reference) => {
                if !reference.via.is_empty() {
                    self.position = self.target(&reference.via);
                }
                self.note_intermediate(reference);
                self.lose(&reference.axes);
                if reference.axes[Axis::Z as usize]
                    && !reference.keeps_length
                    && self.modes.length_offset != Some(0)
                {
                    self.modes.length_offset = None;
                }
            }
            Op::SetData(data) => match &**data {
                // Where the axes stand is counted again, if it is the active offset.
                Data::Offset { offset, words, turn, .. }
                    if self.modes.work_offset.is_none_or(|own| own == *offset) =>
                {
                    let turns = turn.is_some();
                    self.lose(&std::array::from_fn(|axis| words[axis].is_some() || turns && axis < 2));
                }
                Data::ToolInSpindle(tool) => self.tool = tool.literal().and_then(|n| n.whole_number()),
                Data::Tool { entry, which, .. } if which.is_offset() => {
                    self.aside |= matches!(which, ToolValue::OffsetX | ToolValue::OffsetY);
                    self.change_entry(*entry);
                }
                Data::Measured { entry, words, .. } => {
                    self.aside |= words[..2].iter().any(Option::is_some);
                    self.change_entry(*entry);
                }
                Data::Offset { .. } | Data::Tool { .. } | Data::Position(_) => {}
            },
            Op::UseToolEdge { edge, .. } => {
                self.move_aside();
                let edge = edge.literal().and_then(|n| n.whole_number());
                self.modes.length_offset = match (edge, self.tool) {
                    (Some(0), _) | (Some(_), Some(0)) => Some(0),
                    // Edge 1 of a tool is the table's entry with its number.
                    (Some(1), Some(tool)) if tool > 0 => u32::try_from(tool).ok(),
                    (Some(_) | None, _) => None,
                };
            }
            Op::UseToolLength(length) => {
                self.aside |= matches!(**length, ToolLength::Offsets { .. });
                self.move_aside();
                self.modes.length_offset = None;
            }
            Op::UseToolLengthOffset(entry) => {
                self.move_aside();
                let entry =
                    entry.literal().and_then(|n| n.whole_number()).and_then(|n| u32::try_from(n).ok());
                self.modes.length_offset = entry;
            }
            Op::ChangeTool => {
                self.tool = self.selected;
                if self.z_lost_at_change {
                    self.position[Axis::Z as usize] = None;
                }
            }
            Op::SelectToolByName(_) => self.selected = None,
            Op::SelectTool(tool) => self.selected = tool.literal().and_then(|n| n.whole_number()),
            // One of them does what it says, and nothing else.
            Op::Control(control) if computed_code(control).is_some_and(|code| is_about_entries(&code)) => {
                let code = computed_code(control);
                code.iter().flat_map(|code| &code.codes).for_each(|(_, op)| self.apply(op));
            }
            flow!() => self.forget(),
            miscellaneous!() => match op {
                Op::SetSpindleSpeed(speed) => self.speed = speed.literal(),
                Op::SetSpindleMode(_) => self.speed = None,
                Op::StartSpindleClockwise => self.spindle = Some(Spindle::Clockwise),
                Op::StartSpindleCounterclockwise => self.spindle = Some(Spindle::Counterclockwise),
                Op::StopSpindleTurning | Op::OrientSpindle(_) => self.spindle = Some(Spindle::Stopped),
                Op::StartCutterRadiusCompensation { .. } => self.compensated = true,
                Op::StopCutterRadiusCompensation => self.compensated = false,
                _ => {}
            },
            Op::SetFeedRate(feed) => self.feed_is(feed),
            Op::ProgramEnd | Op::BeginAgain | variables!() | conduct!() => {}
        }
    }

    /// An entry of the table of tools has other values; what is active of it may be the ones before.
    fn change_entry(&mut self, entry: u32) {
        if self.modes.length_offset == Some(entry) {
            self.modes.length_offset = None;
        }
    }

    /// Another offset of the tool may put it elsewhere in the plane.
    fn move_aside(&mut self) {
        if self.aside {
            self.position[..2].fill(None);
        }
    }

    /// Where a polar point is, its plane, and the pole after it, as far as they are known.
    pub fn polar(&self, polar: &Polar) -> Option<([Nanos; 2], Plane, Pole)> {
        let plane = self.plane(polar.plane)?;
        let (at, pole) = polar::point(polar, plane, &Polarly(self)).ok()?;
        Some((at, plane, pole))
    }

    fn set_pole(&mut self, set: &SetPole) {
        let found = self.plane(set.plane).and_then(|plane| polar::pole(set, plane, &Polarly(self)).ok());
        self.pole_lost = found.is_none();
        self.pole = found.unwrap_or_default();
    }

    fn go_polar(&mut self, polar: &Polar) {
        let found = self.polar(polar);
        if found.is_none() {
            // The pole stays where it is; which words are active after it is not known.
            (self.pole.radius, self.pole.angle) = (None, None);
            self.pole_lost |= self.plane(polar.plane).is_none();
        }
        if let Some((at, plane, pole)) = found {
            self.pole = pole;
            if let Some(op) = polar::with_words(polar, plane, at, polar::exact) {
                return self.apply(&op);
            }
        }
        self.apply(&polar.op);
        match self.plane(polar.plane) {
            Some(plane) => {
                let (first, second, _) = plane.axes();
                self.position[first as usize] = None;
                self.position[second as usize] = None;
            }
            None => self.position[..3].fill(None),
        }
    }

    #[inline]
    fn go(&mut self, to: &Point, motion: Motion) {
        // A code that may hold for its block alone.
        let own_code = self.raw || self.probing || self.detour;
        if std::mem::take(&mut self.raw) {
            self.lose(&std::array::from_fn(|axis| to.axes[axis].is_some()));
        } else {
            self.position = self.target(to);
        }
        self.detour = false;
        if std::mem::take(&mut self.probing) {
            self.lose(&std::array::from_fn(|axis| to.axes[axis].is_some()));
        }
        self.modes.motion = Some(motion).filter(|_| !own_code || self.modes.motion == Some(motion));
        self.cycle = None;
        self.cycle_in_doubt = false;
    }

    /// The machine goes along these axes to where the program does not know; a frame may mix them.
    fn lose(&mut self, axes: &[bool; AXES]) {
        for (at, goes) in self.position.iter_mut().zip(axes) {
            if *goes || self.framed || self.tilted {
                *at = None;
            }
        }
    }

    fn go_form(&mut self, arc: &ArcForm) {
        let end = self.end_of(arc);
        self.go(&arc.to, Motion::Traverse);
        let turn = match &arc.shape {
            Shape::Angle { turn, .. } | Shape::Mixed { turn, .. } => Some(*turn),
            Shape::AngleAbout { turn, .. } => {
                match self.plane(arc.plane) {
                    Some(plane) => {
                        let (first, second, _) = plane.axes();
                        self.position[first as usize] = end.map(|end| end[0]);
                        self.position[second as usize] = end.map(|end| end[1]);
                    }
                    None => self.position[..3].fill(None),
                }
                Some(*turn)
            }
            Shape::Through(_) | Shape::Tangent => None,
        };
        self.modes.motion = turn.map(Motion::Arc);
    }

    /// Where an arc ends of which the end follows from its angle.
    fn end_of(&self, arc: &ArcForm) -> Option<[Nanos; 2]> {
        let plane = self.plane(arc.plane)?;
        let (first, second, _) = plane.axes();
        let start = [self.position[first as usize]?, self.position[second as usize]?];
        let found = solve_arc(&arc.shape, plane, start, start, &Turning(self)).ok()?.ok()?;
        Some(found.end)
    }

    fn feed_is(&mut self, feed: &Expr) {
        (self.feed, self.fed, self.stale_feed) = (feed.literal(), true, false);
    }
}
