//! ncc-exec: what the machine does. Execution of a program in a world makes the canonical stream, event by event, and
//! [`verify`] compares two of them.
//!
//! Everything that a program does not say comes from the [`World`]. Events are in machine
//! coordinates, so that a lost work offset or a wrong length entry shows. Statements whose meaning
//! is not executed yet (variables, jumps) are refused.
//!
//! ```text
//! HOLE(X 10mm)  in a world with work offset (100, 50, -20)    three moves in machine coordinates, each with its feed
//! ```
//!
//! Not here: who supplies the world, and what is reported of a difference (the driver).

mod ask;
mod at_codes;
mod data;
mod event;
pub mod frames;
pub mod halt;
mod in_block;
pub mod maps;
mod message;
mod motion_modes;
pub mod moves;
mod places;
mod run;
mod tools;
pub mod verify;
mod word_value;
pub mod world;

pub use at_codes::cuts;
pub use at_codes::touched;
pub use event::{Attribute, Coolant, Event, Kind, Movement, Seen, State, Stored, Written, by_control};
pub use frames::chain::Chain;
pub use frames::slots::{Frames, Present, Rotation, Scale};
pub use frames::tilt::TiltedPlane;
pub use motion_modes::named_tool;
pub use moves::arcs::same::are_arcs;
pub use moves::centre_path::AsProgrammed;
pub use moves::compensation::{Compensation, CompensationRadius};
pub use moves::fine::Increments;
pub use moves::holes::repeated::ValuedHoles;
pub use moves::holes::same::are_holes;
pub use moves::lines::paced::{PacedLines, PacedMove};
pub use moves::lines::told::Along;
pub use moves::lines::valued::{Stroke, ValuedLines};
pub use moves::pace::{DEGREES, LINEAR};
pub use moves::rotary::end as rotary_end;
pub use run::again;
pub use run::go::{Halt, Progress};
pub use run::left::Again;
pub use run::{MOST_STEPS, Runner};

use crate::world::World;
use frames::frame::Length;
use moves::arcs::Heading;
use moves::centre_path::CentrePath;
use moves::compensation::Contour;
use moves::holes::ActiveCycle;
use ncc_ir::canon::{
    AXES, Axis, Distance, Fact, FeedMode, Motion, PathMode, Plane, ReturnLevel, RotaryWay, Spindle, Units,
    same_point,
};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::Nanos;
use ncc_ir::geometry::polar::Pole;
use ncc_ir::program::kinds::variables;
use ncc_ir::program::{Detour, FrameSlot, Op, Point, Probe, Slot, Stmt};
use ncc_ir::source::Span;
use ncc_ir::syntax::Ranged;
use ncc_ir::unexecuted::{FlowUnexecuted, Unexecuted};

const Z: usize = Axis::Z as usize;

/// A control that executes statements one by one.
#[derive(Clone, Debug)]
pub struct Exec {
    world: World,
    /// Block-skip switches: bit n is level n.
    skip: u16,
    modes: InModes,
    /// Facts that the program or an assumption has set; the others are still the world's.
    said: u16,
    /// Position in the program's frame.
    position: [Nanos; AXES],
    /// Machine coordinates of program zero, tool length included.
    frame: [Nanos; AXES],
    /// Frames between the program and that.
    chain: Option<Box<Chain>>,
    /// The slots that they come from, and the G92 shift; `None` is nothing in any.
    slots: Option<Box<Frames>>,
    /// Whether the active work offset is turned: then the G92 shift is in the chain.
    offset_turned: bool,
    /// Changes of frames and work offsets that the next incremental words include.
    carried: Option<Box<moves::carried::Carried>>,
    /// Slots that were left full by an earlier run, or will be.
    outlived: run::left::Outlived,
    /// Position of the last move's event.
    last: [Nanos; AXES],
    /// Direction of the last move.
    heading: Heading,
    /// How corners are taken after the next move, which ends in an exact stop.
    after_stop: Option<Option<PathMode>>,
    /// The direction in which A, B and C turn in the next move.
    ways: Option<[Option<RotaryWay>; 3]>,
    /// The next straight move is in machine coordinates, with the tool's length or without.
    raw: Option<bool>,
    /// The next straight move at feed ends where the probe triggers.
    probing: Option<Probe>,
    /// The next rapid straight move goes another way than straight.
    detour: Option<Detour>,
    /// Through which intermediate point each axis went to a reference point last: of the program, and of the machine.
    intermediate: Box<[Option<[Nanos; 2]>; AXES]>,
    /// About which polar points are.
    pole: Pole,
    /// The length that the next Z applies.
    waiting: Option<Length>,
    /// The length activated last, where it counts as none because the operator sets the zero of Z by the tool: its radius
    /// is active all the same.
    zeroed: Option<Length>,
    /// Rotary axes that the program itself has put somewhere, a bit each.
    turned_known: u8,
    /// The move at hand says itself the direction in which rotary axes turn.
    own_way: bool,
    /// The axis along which lengths lie and take effect: Z, but on controls that go by the plane.
    along: usize,
    /// Offsets of the active tool along X and Y.
    aside: [Nanos; 2],
    /// The contour that the tool goes beside.
    contour: Contour,
    /// The tool centre path beside it, where that is computed.
    centre_path: Option<Box<CentrePath>>,
    /// A corner that is to be made.
    corner: Option<Box<moves::corner::Corner>>,
    /// What waits for the end of the block at hand.
    in_block: Option<in_block::InBlock>,
    /// The axis of the length stands at a place of the machine, where no length counts.
    at_place: bool,
    feed: Nanos,
    /// The time of the move at hand, where its feed says it in a way of the control.
    pace: moves::pace::Pace,
    /// Whether it was stated in inches, if it was stated in either.
    feed_inch: Option<bool>,
    selected: i64,
    /// The tool of the last change; -1 before the first.
    changed_to: i64,
    /// Where the last probing move ended, in the coordinates that the program had then.
    touched: Option<Box<[[Nanos; AXES]; 2]>>,
    state: State,
    /// Whether what a speed counts needs to be looked at before anything happens.
    speed_watched: bool,
    cycle: Option<ActiveCycle>,
    /// Behaviours of the control that the program has reached, a bit each.
    asked: u64,
    /// Whether the program has ended.
    ended: bool,
    /// What becomes of messages.
    shown: message::Shown,
    /// Whether events are counted only.
    quiet: bool,
    /// Straight moves that are kept in place of their events.
    strokes: Option<Box<moves::holes::strokes::Strokes>>,
    /// Whether functions without events are reported.
    narrating: bool,
    /// Whether straight moves that go nowhere make events.
    every_move: bool,
    counted: u64,
    /// The rule for arcs of another control, where one execution is to stand for both.
    beside: Option<Box<moves::arcs::same::Beside>>,
    /// Cuts with the spindle stopped.
    standing: moves::standing::Standing,
    /// The first arc under compensation: outer and inner ones, each with F at the tool centre and along the contour.
    arc_feeds: [[Option<Span>; 2]; 2],
}

/// Modes active; a control always has a value for each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct InModes {
    motion: Motion,
    distance: Distance,
    inch: bool,
    plane: Plane,
    return_level: ReturnLevel,
    work_offset: u16,
    length: Length,
    shifted: bool,
}

/// Words and positions are within so many bits, in nanos: 1125899.9 mm.
const MOST_BITS: u32 = 50;

// Bits of `Exec::said`.
const MOTION: u16 = 1;
const DISTANCE: u16 = 2;
const UNITS: u16 = 4;
const PLANE: u16 = 8;
const RETURN: u16 = 16;
const WORK: u16 = 32;
const LENGTH: u16 = 64;
const SHIFT: u16 = 128;
const FEED_MODE: u16 = 256;
/// The numbers kept of a G92 shift are the program's own, all of them.
const SHIFT_STORED: u16 = 512;
/// The G92 shift is active, be it of nothing.
const SHIFT_TAKEN_UP: u16 = 1024;

impl Exec {
    /// A control at power-on in a world, with these block-skip switches on (bit n is level n).
    pub fn new(world: &World, skip: u16) -> Exec {
        let p = world.power_on;
        let modes = InModes {
            motion: p.motion.unwrap_or(Motion::Traverse),
            distance: p.distance.unwrap_or(Distance::Absolute),
            inch: p.units == Some(Units::Inch),
            plane: p.plane.unwrap_or(Plane::Xy),
            return_level: p.return_level.unwrap_or(ReturnLevel::Initial),
            work_offset: p.work_offset.unwrap_or(1),
            length: Length::Entry(p.length_offset.unwrap_or(0)),
            shifted: p.no_origin_shift == Some(false),
        };
        let mut exec = Exec {
            world: world.clone(),
            skip,
            modes,
            said: 0,
            position: [0; AXES],
            frame: [0; AXES],
            chain: None,
            slots: None,
            offset_turned: false,
            carried: None,
            outlived: run::left::Outlived::default(),
            last: world.start,
            heading: Heading::None,
            after_stop: None,
            ways: None,
            raw: None,
            probing: None,
            detour: None,
            intermediate: Box::default(),
            pole: Pole::ZERO,
            waiting: None,
            zeroed: None,
            turned_known: 0,
            own_way: false,
            along: Z,
            aside: [0; 2],
            contour: Contour::default(),
            centre_path: None,
            corner: None,
            in_block: None,
            at_place: true,
            feed: 0,
            pace: None,
            feed_inch: None,
            selected: -1,
            changed_to: -1,
            touched: None,
            state: State {
                feed_mode: p.feed_mode.unwrap_or(FeedMode::PerMinute),
                path: world.path,
                by_control: by_control::Z_AT_START,
                ..State::default()
            },
            speed_watched: false,
            cycle: None,
            asked: 0,
            ended: false,
            shown: message::Shown::default(),
            quiet: false,
            strokes: None,
            narrating: false,
            every_move: false,
            counted: 0,
            beside: None,
            standing: moves::standing::Standing::default(),
            arc_feeds: [[None; 2]; 2],
        };
        exec.along = exec.length_axis();
        exec.reframe(world.start);
        exec
    }

    /// Whether the program has ended.
    pub fn ended(&self) -> bool {
        self.ended
    }

    /// Work offset active, and whether the program or an assumption named it.
    pub fn work_offset(&self) -> Option<u16> {
        (self.said & WORK != 0).then_some(self.modes.work_offset)
    }

    /// Tells functions one by one: those that set an attribute make events too, and so do straight
    /// moves of the program that go nowhere. For tables of what happens; not for a comparison.
    pub fn narrate(&mut self) {
        self.narrating = true;
    }

    /// Makes events of all straight moves, those of cycles that go nowhere too: so that a program makes
    /// the same events in every world, whatever its offsets are. Who asks for this drops those that go
    /// nowhere in all of them.
    pub fn every_move(&mut self) {
        self.every_move = true;
    }

    /// Sets the block-skip switches: bit n is level n.
    pub fn set_skip(&mut self, skip: u16) {
        self.skip = skip;
    }

    /// Whether a block-skip switch leaves a statement out.
    #[inline]
    pub fn skips(&self, stmt: &Stmt) -> bool {
        stmt.skip.is_some_and(|level| self.skip >> level & 1 == 1)
    }

    /// Whether the switches of these levels (bit n is level n) stand here as on another control.
    pub fn skips_as(&self, other: &Exec, levels: u16) -> bool {
        (self.skip ^ other.skip) & levels == 0
    }

    fn fault<T>(&self, fault: Fault, span: Span) -> Result<T, Diagnostic> {
        Err(Diagnostic::new(fault, span))
    }

    /// Executes a statement; its events are pushed to `out`.
    ///
    /// # Errors
    /// What no control could execute, or what is not executed yet.
    #[inline]
    pub fn step(&mut self, stmt: &Stmt, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        if self.in_block.is_some() {
            self.settle_block(stmt, out)?;
        }
        if self.ended || self.skips(stmt) {
            return Ok(());
        }
        if self.state.tip || self.state.tilted {
            self.check_tilted(stmt)?;
        }
        if self.corner.is_some() {
            return self.step_at_corner(stmt, out);
        }
        self.step_on_way(stmt, out)
    }

    #[inline]
    fn step_on_way(&mut self, stmt: &Stmt, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        if self.contour.watched {
            return self.step_on_contour(stmt, out);
        }
        self.step_plainly(stmt, out)
    }

    #[inline]
    fn step_plainly(&mut self, stmt: &Stmt, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        if self.ways.is_some() {
            return self.step_turning(stmt, out);
        }
        if self.after_stop.is_some() {
            return self.step_and_stop(stmt, out);
        }
        self.do_step(stmt, out)
    }

    #[inline]
    fn do_step(&mut self, stmt: &Stmt, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let span = stmt.span;
        self.shown.goes_on();
        match &stmt.op {
            Op::StraightFeed(m) => self.straight(&m.to, true, span, out),
            Op::StraightTraverse(m) => self.straight(&m.to, false, span, out),
            Op::ArcFeed(arc) => self.arc(arc, span, out),
            Op::Position(m) => match self.modes.motion {
                Motion::Traverse => self.straight(&m.to, false, span, out),
                Motion::Feed => self.straight(&m.to, true, span, out),
                Motion::Arc(_) => self.fault(Fault::ArcWithoutCentre, span),
                Motion::Cycle => self.hole(&m.to, span, out),
            },
            Op::SetFeedRate(f) => {
                self.feed = self.value(f, span)?;
                self.feed_inch = Some(self.modes.inch);
                self.tell(Attribute::FeedRate(self.feed), span, out)
            }
            _ => self.other(stmt, out),
        }
    }

    #[inline]
    fn straight(
        &mut self,
        to: &Point,
        feed: bool,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        if self.plain_line(to, feed, span, out)? {
            return Ok(());
        }
        self.other_straight(to, feed, span, out)
    }

    /// A straight move that is no plain line.
    fn other_straight(
        &mut self,
        to: &Point,
        feed: bool,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        if self.detour.is_some() {
            return self.go_by_detour(to, feed, span, out);
        }
        let (before, own) = (self.position, self.modes.motion);
        let own_code = self.has_own_code(span)?;
        if let Some(length) = self.raw.take() {
            self.place_in_machine(to, length, span)?;
        } else {
            self.set_axes(to, span)?;
        }
        if !same_point(&before, &self.position) {
            self.heading = Heading::From(before);
        }
        self.modes.motion = if feed { Motion::Feed } else { Motion::Traverse };
        if own_code && self.modes.motion != own {
            // Its code may hold for its block alone.
            self.modes.motion = Motion::Cycle;
        }
        self.said |= MOTION;
        self.cycle = None;
        if self.probing.is_some() {
            return self.probe(feed, span, out);
        }
        if self.narrating && !(feed && self.feed == 0) && same_point(&self.machine(), &self.last) {
            return self.emit(if feed { Kind::Feed } else { Kind::Traverse }, span, out);
        }
        self.emit_move(feed, span, out)
    }

    /// Everything but plain moves and feeds.
    fn other(&mut self, stmt: &Stmt, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let span = stmt.span;
        match &stmt.op {
            Op::ArcForm(arc) => self.arc_form(arc, span, out)?,
            Op::StraightFeed(_)
            | Op::StraightTraverse(_)
            | Op::ArcFeed(_)
            | Op::Position(_)
            | Op::SetFeedRate(_) => {}
            Op::Comment(_) => self.tell(Attribute::Remark, span, out)?,
            Op::NoEffect(_) | Op::Blank | Op::Label(_) => {}
            Op::Lines(lines) => return lines.unpack().try_for_each(|stmt| self.step(&stmt, out)),
            Op::StartCutterRadiusCompensation { side, radius } => {
                self.start_compensation(*side, radius, span)?;
            }
            Op::StopCutterRadiusCompensation => self.stop_compensation(),
            Op::UseLengthUnits(units) => {
                self.units_of_speed(*units);
                let inch = *units == Units::Inch;
                if self.feed != 0 && inch != self.modes.inch {
                    self.feed_at_units(inch);
                }
                self.modes.inch = inch;
                self.said |= UNITS;
            }
            Op::SetDistanceMode(distance) => {
                self.modes.distance = *distance;
                self.said |= DISTANCE;
            }
            Op::SelectPlane(plane) => {
                self.modes.plane = *plane;
                self.said |= PLANE;
                self.turn_length();
            }
            Op::SetFeedMode(mode) => self.set_feed_mode(*mode),
            Op::Corner { shape, size } => self.ask_corner(*shape, size, span)?,
            Op::SetMotionControlMode(_)
            | Op::ExactStop
            | Op::TurnRotaryAxes(_)
            | Op::Advise(_)
            | Op::SetSpindleMode(_)
            | Op::LimitSpindleSpeed(_) => self.set_motion_mode(&stmt.op, span)?,
            Op::SetReturnLevel(level) => {
                self.modes.return_level = *level;
                self.said |= RETURN;
            }
            Op::SetOriginOffsets(number) => {
                let (here, before) = (self.machine(), self.before_frame());
                self.modes.work_offset = *number;
                self.said |= WORK;
                self.reframe(here);
                self.carry(before);
            }
            Op::ClearFrame(FrameSlot::Tilt) => self.clear_tilt(span, out)?,
            Op::ClearFrame(slot) => self.clear_slot(*slot),
            Op::SetFrame(frame) => self.set_frame(frame, span)?,
            Op::SetSlot(slot) => match &**slot {
                Slot::Tilt(tilt) => self.set_tilt(tilt, span, out)?,
                slot => self.set_slot(slot, span)?,
            },
            Op::UseToolCentrePoint(on) => {
                self.tip_in_block();
                self.use_tip(*on, span)?;
            }
            Op::OrientToolAxis(toward) => self.orient_tool_axis(*toward, span, out)?,
            Op::SetPosition(axes) => self.set_position(axes, span)?,
            Op::UseOriginShift(on) => self.use_origin_shift(*on, span)?,
            Op::UseMachineCoordinates { length } => self.raw = Some(*length),
            Op::Probe(probe) => self.probing = Some(*probe),
            Op::Detour(detour) => self.detour = Some(*detour),
            Op::GoToReference(reference) => self.go_to_reference(reference, span, out)?,
            Op::SetData(data) => self.set_data(data, span, out)?,
            Op::SetPole(set) => self.set_pole(set, span)?,
            Op::Polar(polar) => self.polar(polar, span, out)?,
            Op::SetSpindleSpeed(speed) => self.set_speed(speed, span, out)?,
            Op::SelectTool(tool) => {
                let tool = self.whole_number(tool, span)?;
                self.select(tool);
                self.tell(Attribute::SelectTool(self.selected), span, out)?;
            }
            Op::SelectToolByName(name) => {
                self.select(named_tool(name));
                self.tell(Attribute::SelectTool(self.selected), span, out)?;
            }
            Op::ChangeTool => self.change_tool(span, out)?,
            Op::UseToolLength(length) => self.use_length(length, span)?,
            Op::UseToolLengthOffset(entry) => {
                let entry = u32::try_from(self.whole_number(entry, span)?);
                let Ok(entry) = entry else {
                    return self.fault(Fault::OutOfRange { word: Ranged::Unnamed }, span);
                };
                self.call_up_zeroed(Length::Entry(entry), span)?;
            }
            Op::UseToolEdge { edge, .. } => {
                let Ok(edge @ 0..=9) = u32::try_from(self.whole_number(edge, span)?) else {
                    return self.fault(Fault::OutOfRange { word: Ranged::Unnamed }, span);
                };
                self.call_up_zeroed(self.edge(edge), span)?;
            }
            Op::StartSpindleClockwise => self.turn_spindle(Spindle::Clockwise, span, out)?,
            Op::StartSpindleCounterclockwise => self.turn_spindle(Spindle::Counterclockwise, span, out)?,
            Op::StopSpindleTurning => self.turn_spindle(Spindle::Stopped, span, out)?,
            Op::SynchronisedFeed(m) => self.synchronised(m, span, out)?,
            Op::OrientSpindle(angle) => self.orient(angle.as_ref(), span, out)?,
            Op::MachineFunction(name) => self.emit(Kind::MachineFunction(name.clone()), span, out)?,
            Op::FloodOn => self.coolant(Coolant { flood: true, ..self.state.coolant() }, span, out)?,
            Op::MistOn => self.coolant(Coolant { mist: true, ..self.state.coolant() }, span, out)?,
            Op::CoolantOff => self.coolant(Coolant { flood: false, mist: false }, span, out)?,
            Op::Dwell(amount) => self.dwell_code(amount, span, out)?,
            Op::StartCycle(cycle) => self.start_cycle(cycle, span)?,
            Op::Hole(m) => self.hole(&m.to, span, out)?,
            Op::Pattern(pattern) => self.pattern(pattern, span, out)?,
            Op::EndCycle => self.cycle = None,
            Op::ProgramStop | Op::OptionalProgramStop | Op::ProgramEnd | Op::BeginAgain => {
                self.stop(stmt, out)?
            }
            Op::Message(_) | Op::MessageOf(_) | Op::Output(_) | Op::Alarm(_) => self.message(stmt, out)?,
            Op::Call(_) => return self.not_executed(FlowUnexecuted::CallInStream, span),
            Op::Return => return self.not_executed(FlowUnexecuted::MainReturn, span),
            Op::RepeatBlocks(_) => return self.not_executed(FlowUnexecuted::RepetitionInStream, span),
            variables!() => return self.not_executed(FlowUnexecuted::Variable, span),
            Op::Control(_) => return self.not_executed(FlowUnexecuted::Control, span),
            Op::Goto(_) | Op::Leave | Op::NextTurn => return self.not_executed(FlowUnexecuted::Jump, span),
        }
        Ok(())
    }

    fn not_executed(&self, what: impl Into<Unexecuted>, span: Span) -> Result<(), Diagnostic> {
        self.fault(Fault::not_executed(what), span)
    }

    fn plane_of(&self, plane: Fact<Plane>) -> Plane {
        plane.or(self.modes.plane)
    }
}
