//! The checker: executes statements one by one, and shows each rule what it needs.

use std::collections::BTreeSet;

use ncc_exec::{Attribute, Event, Exec, Kind};
use ncc_ir::canon::{AXES, Axis, Distance, Motion, same_point};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num, Unit};
use ncc_ir::program::{FrameSlot, Op, Point, Stmt};
use ncc_ir::source::Span;

use crate::finding::{Finding, LeftOn, What};
use crate::limits::{Limits, Unchecked};
use crate::met::SpindleMet;
use crate::rules::{feed, left, length, points, rapid, speed, spindle, thread, travel};
use crate::seen::Known;
use crate::watched::{Step, Watched};

/// A block that was not read, as far as its faults tell.
#[derive(Clone, Debug, Default)]
pub struct Refusal {
    /// Where.
    pub span: Span,
    /// A mode that one of its codes switches on.
    pub on: Option<LeftOn>,
}

/// Checks one program, statement by statement.
#[derive(Debug)]
pub struct Checker {
    watched: Watched,
    /// Place of the first block that was not read.
    first_refusal: Option<Span>,
    events: Vec<Event>,
    /// Where the axes stood after the last event.
    last: [Nanos; AXES],
    ended: bool,
}

impl Checker {
    /// A checker of a program that is executed from here. Where the tool stands before the first block is
    /// not known.
    pub fn new(limits: Limits, exec: &Exec) -> Checker {
        let mut unchecked = BTreeSet::new();
        if !limits.machine {
            unchecked.insert(Unchecked::NoMachine);
        }
        if limits.rapid_plane.is_none() {
            unchecked.insert(Unchecked::NoPlane);
        }
        let mut checker = Checker {
            watched: Watched::new(limits, unchecked),
            first_refusal: None,
            events: Vec::new(),
            last: exec.machine(),
            ended: false,
        };
        checker.rebase(exec);
        checker
    }

    /// Executes a statement and checks what it does. Gives why it could not be executed, where that is
    /// not only because of blocks that were not read.
    pub fn run(&mut self, stmt: &Stmt, exec: &mut Exec) -> Option<Diagnostic> {
        if self.ended {
            return None;
        }
        let step = Step {
            stmt,
            from: exec.position(),
            from_known: self.watched.seen.program,
            raw: std::mem::take(&mut self.watched.seen.raw),
            tilted: exec.is_tilted(),
        };
        self.before(stmt);
        let mut events = std::mem::take(&mut self.events);
        events.clear();
        let done = match exec.feed() == 0 && cuts(&stmt.op, exec) {
            true => self.step_without_feed(stmt, exec, &mut events),
            false => exec.step(stmt, &mut events),
        };
        if let Err(refusal) = done {
            self.events = events;
            self.last = exec.machine();
            let certain = self.first_refusal.is_none() || !concerns_position(&refusal.fault);
            self.lose(&Refusal { span: stmt.span, on: None });
            return certain.then_some(refusal);
        }
        self.after(&step, exec);
        for event in events.drain(..) {
            self.event(&step, &event, exec);
            self.last = event.end;
        }
        self.events = events;
        None
    }

    /// Executes a cut before any feed is set. If the control refuses it for that, it is reported, and executed with a
    /// feed.
    #[cold]
    fn step_without_feed(
        &mut self,
        stmt: &Stmt,
        exec: &mut Exec,
        events: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        let saved = exec.clone();
        let done = exec.step(stmt, events);
        if !matches!(done, Err(Diagnostic { fault: Fault::NoFeed, .. })) {
            return done;
        }
        feed::missing(&mut self.watched, stmt.span);
        *exec = saved;
        events.clear();
        let one = Expr::Num(Num { mantissa: 1, scale: 0, point: true, unit: Unit::Mm });
        // It cannot fail; the feed that follows from it is not looked at.
        let _ = exec.step(&Stmt::new(stmt.span, Op::SetFeedRate(one)), events);
        events.clear();
        exec.step(stmt, events)
    }

    /// A block that was not read: what it may have changed is not known from here.
    pub fn lose(&mut self, refusal: &Refusal) {
        self.first_refusal.get_or_insert(refusal.span);
        self.watched.seen.lose();
        self.watched.spindle = SpindleMet::default();
        if let Some(mode) = refusal.on {
            self.watched.seen.switch_on(mode, refusal.span);
        }
        self.watched.based = None;
    }

    /// Numbers without a point of the piece of text whose statements come next.
    pub fn bare(&mut self, span: Span, read: Num, with_point: Num, feed: bool) {
        points::note(&mut self.watched, span, read, with_point, feed);
    }

    /// The text has a length with a point.
    pub fn pointed(&mut self) {
        self.watched.points.pointed = true;
    }

    /// Something that was found otherwise.
    pub fn add(&mut self, finding: Finding) {
        self.watched.findings.add(finding);
    }

    /// The execution was given up: it does not end.
    pub fn give_up(&mut self) {
        self.watched.unchecked.insert(Unchecked::Endless);
        self.ended = true;
    }

    /// Whether the program has ended.
    pub fn ended(&self) -> bool {
        self.ended
    }

    /// The end of the program at the end of its text; a subprogram alone leaves everything to its caller.
    pub fn finish(mut self, subprogram: bool, end: Span) -> Checked {
        if subprogram {
            self.watched
                .findings
                .retain(|finding| !finding.at_entry && !matches!(finding.what, What::Left(_)));
        } else if !self.ended {
            left::on(&mut self.watched, end);
        }
        points::finish(&mut self.watched);
        let left_out = self.watched.findings.left_out().collect();
        Checked {
            findings: self.watched.findings.sorted(),
            left_out,
            unchecked: self.watched.unchecked.into_iter().collect(),
            first_refusal: self.first_refusal,
        }
    }

    /// What a statement says before it is executed.
    fn before(&mut self, stmt: &Stmt) {
        match &stmt.op {
            Op::UseMachineCoordinates { .. } => self.watched.seen.raw = true,
            Op::StopCutterRadiusCompensation => self.watched.seen.switch_off(LeftOn::Compensation),
            Op::ClearFrame(FrameSlot::Shift) | Op::UseOriginShift(false) => {
                self.watched.seen.switch_off(LeftOn::Frame);
            }
            _ => {}
        }
    }

    /// What is known after a statement has been executed.
    fn after(&mut self, step: &Step, exec: &Exec) {
        let at = step.stmt.span;
        match &step.stmt.op {
            Op::StraightFeed(m) | Op::StraightTraverse(m) => self.words(&m.to, step.raw, exec),
            Op::Position(m) | Op::Hole(m) => self.words(&m.to, step.raw, exec),
            Op::ArcFeed(arc) => self.words(&arc.to, step.raw, exec),
            Op::ArcForm(arc) => self.words(&arc.to, step.raw, exec),
            Op::StartCutterRadiusCompensation { .. } => self.watched.seen.switch_on(LeftOn::Compensation, at),
            Op::SetDistanceMode(Distance::Incremental) => {
                self.watched.seen.switch_on(LeftOn::Incremental, at)
            }
            Op::SetDistanceMode(Distance::Absolute) => self.watched.seen.switch_off(LeftOn::Incremental),
            Op::ClearFrame(FrameSlot::Shift) => {}
            Op::SetFrame(_) | Op::SetSlot(_) | Op::SetPosition(_) | Op::ClearFrame(_) => {
                // A shift of zero is none.
                if !exec.has_program_frames() {
                    self.watched.seen.switch_off(LeftOn::Frame);
                } else if !matches!(step.stmt.op, Op::ClearFrame(_)) {
                    self.watched.seen.switch_on(LeftOn::Frame, at);
                }
                self.forget_program();
                if step.tilted != exec.is_tilted() {
                    self.watched.seen.machine[..3].fill(false);
                }
            }
            Op::UseOriginShift(_) => self.forget_program(),
            Op::UseToolCentrePoint(_) => {
                self.forget_program();
                self.watched.seen.machine[..3].fill(false);
            }
            Op::OrientToolAxis(_) => {
                self.forget_program();
                self.watched.seen.machine = [false; AXES];
            }
            Op::SetOriginOffsets(_) => {
                self.rebase(exec);
                self.forget_program();
            }
            Op::UseToolLengthOffset(_) | Op::UseToolLength(_) | Op::UseToolEdge { .. } => {
                self.watched.seen.length_lost = false;
                length::said(&mut self.watched, at, exec);
                self.rebase(exec);
            }
            Op::StartCycle(_) => {
                self.watched.seen.switch_on(LeftOn::Cycle, at);
                rapid::cycle(&mut self.watched, step, exec);
            }
            Op::EndCycle => self.watched.seen.switch_off(LeftOn::Cycle),
            Op::FloodOn | Op::MistOn => self.watched.seen.switch_on(LeftOn::Coolant, at),
            Op::CoolantOff => self.watched.seen.switch_off(LeftOn::Coolant),
            _ => {}
        }
    }

    /// Something that happens.
    fn event(&mut self, step: &Step, event: &Event, exec: &Exec) {
        match &event.kind {
            Kind::Traverse => {
                rapid::moved(&mut self.watched, step, exec);
                self.moved(step, event);
            }
            Kind::Feed | Kind::Arc { .. } => {
                spindle::cut(&mut self.watched, event, self.last);
                feed::cut(&mut self.watched, event, self.last);
                self.moved(step, event);
            }
            // It touches, and cuts nothing.
            Kind::Probe { .. } => {
                spindle::probed(&mut self.watched);
                self.moved(step, event);
            }
            Kind::Synchronised { .. } => {
                spindle::cut(&mut self.watched, event, self.last);
                thread::cut(&mut self.watched, event);
                self.moved(step, event);
            }
            Kind::Orient(_) => {
                self.watched.seen.spindle = Known::Said;
                self.watched.spindle = SpindleMet::held();
                self.watched.seen.switch_off(LeftOn::Spindle);
            }
            Kind::ToolChange => {
                spindle::changed(&mut self.watched);
                thread::changed(&mut self.watched);
                length::changed(&mut self.watched, event);
            }
            // Spindle and coolant stay on for the next pass.
            Kind::BeginAgain => self.ended = true,
            Kind::ProgramEnd => {
                left::on(&mut self.watched, event.span);
                self.ended = true;
            }
            Kind::Attribute(Attribute::FeedRate(feed)) => {
                if matches!(step.stmt.op.unwrapped(), Op::SetFeedRate(_)) {
                    self.watched.feed.made_up = false;
                }
                if !self.watched.feed.made_up {
                    self.watched.seen.feed = Known::Said;
                    feed::said(&mut self.watched, *feed, event.span);
                }
            }
            Kind::Attribute(Attribute::SpindleSpeed(revs)) => {
                self.watched.seen.speed = Known::Said;
                self.watched.spindle = self.watched.spindle.renewed();
                speed::said(&mut self.watched, *revs, event.span);
            }
            Kind::Attribute(Attribute::StartSpindle(_)) => {
                self.watched.seen.spindle = Known::Said;
                self.watched.spindle = SpindleMet::default();
                self.watched.seen.switch_on(LeftOn::Spindle, event.span);
            }
            Kind::Attribute(Attribute::StopSpindle) => {
                self.watched.seen.spindle = Known::Said;
                self.watched.spindle = SpindleMet::stopped(event.span);
                self.watched.seen.switch_off(LeftOn::Spindle);
            }
            Kind::Attribute(Attribute::SelectTool(_) | Attribute::Hole | Attribute::Remark)
            | Kind::Dwell(_)
            | Kind::Coolant
            | Kind::MachineFunction(_)
            | Kind::Data(_)
            | Kind::Tilt(_)
            | Kind::OrientToolAxis(_)
            | Kind::ProgramStop
            | Kind::OptionalProgramStop
            | Kind::TextEnd
            | Kind::Alarm(..)
            | Kind::Output(_)
            | Kind::Message(_) => {}
        }
    }

    /// A move of any kind.
    fn moved(&mut self, step: &Step, event: &Event) {
        if same_point(&event.end, &self.last) {
            return;
        }
        if !step.raw && event.end[Axis::Z as usize] != self.last[Axis::Z as usize] {
            length::z_moves(&mut self.watched, event);
        }
        if self.watched.limits.machine {
            travel::moved(&mut self.watched, event, self.last);
        }
    }

    /// The axis words of a move make places known.
    #[inline]
    fn words(&mut self, to: &Point, raw: bool, exec: &Exec) {
        for (axis, word) in to.axes.iter().enumerate() {
            let Some(word) = word else { continue };
            if raw {
                self.watched.seen.machine[axis] = axis != Axis::Z as usize || !self.watched.seen.length_lost;
                self.watched.seen.program[axis] = self.watched.seen.base[axis];
            } else if word.distance.or(exec.distance()) == Distance::Absolute {
                self.watched.seen.program[axis] = true;
                self.watched.seen.machine[axis] = self.watched.seen.base[axis];
            }
        }
        if exec.is_tilted() && !raw {
            self.watched.seen.machine[..3].fill(false);
        }
        if exec.has_frames() && !raw {
            // A turned frame mixes its axes.
            let all = self.watched.seen.program[..3].iter().all(|known| *known);
            for known in &mut self.watched.seen.machine[..3] {
                *known &= all;
            }
        }
    }

    /// Program zero is elsewhere: places in the program's coordinates are not known any more.
    fn forget_program(&mut self) {
        self.watched.seen.program = [false; AXES];
        // Where the machine stands is as well known as before.
    }

    /// Finds out of which axes an absolute word is known in machine coordinates.
    pub(crate) fn rebase(&mut self, exec: &Exec) {
        let key = (exec.offset_in_force(), exec.length_entry(), exec.length_edge());
        if self.watched.based == Some(key) {
            return;
        }
        self.watched.based = Some(key);
        let row = self.watched.limits.tables.work_offsets.get(&key.0);
        let length = !self.watched.seen.length_lost && self.knows_length(exec);
        self.watched.seen.base = std::array::from_fn(|axis| {
            let zero = row.is_some_and(|row| row[axis].is_some());
            !self.watched.seen.frame_lost && zero && (axis != Axis::Z as usize || length)
        });
    }

    fn knows_length(&self, exec: &Exec) -> bool {
        match (exec.length_entry(), exec.length_edge()) {
            (Some(0), _) => true,
            (Some(entry), _) => self.watched.limits.tables.lengths.contains_key(&entry),
            (None, Some((_, edge))) => edge == 0,
            (None, None) => false,
        }
    }
}

/// What came of a program.
#[derive(Clone, Debug)]
pub struct Checked {
    /// What was found, in the order of places.
    pub findings: Vec<Finding>,
    /// Of which rules findings are only counted, and how many.
    pub left_out: Vec<(crate::Rule, usize)>,
    /// What was not checked, and why.
    pub unchecked: Vec<Unchecked>,
    /// The first block that was not read.
    pub first_refusal: Option<Span>,
}

/// Whether a statement may cut.
fn cuts(op: &Op, exec: &Exec) -> bool {
    match op.unwrapped() {
        Op::StraightFeed(_) | Op::ArcFeed(_) | Op::ArcForm(_) | Op::Hole(_) | Op::Pattern(_) => true,
        Op::Position(_) => exec.motion() != Motion::Traverse,
        _ => false,
    }
}

/// Whether a refusal may come only from a place that is not known.
fn concerns_position(fault: &Fault) -> bool {
    matches!(
        fault,
        Fault::ArcEndOffCircle { .. }
            | Fault::ArcRadiusTooSmall
            | Fault::ArcRadiusNoWay
            | Fault::NoArc
            | Fault::NoCorner { .. }
            | Fault::ArcWithoutCentre
            | Fault::PositionUnknown { .. }
            | Fault::NoMotionMode
            | Fault::NoCycle
            | Fault::NoToolSelected
            | Fault::CycleUpsideDown
            | Fault::OutOfRange { .. }
    )
}
