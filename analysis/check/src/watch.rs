//! The checker: executes statements one by one, and shows each rule what it needs.

use std::collections::BTreeSet;

use ncc_exec::{Attribute, Event, Exec, Kind};
use ncc_ir::canon::{AXES, Axis, Distance, Motion, same_point};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num, Unit};
use ncc_ir::program::{FrameSlot, Op, Point, Stmt};
use ncc_ir::source::Span;

use crate::finding::{Finding, Findings, LeftOn, What};
use crate::limits::{Limits, Unchecked};
use crate::rules::{feed, left, length, points, rapid, speed, spindle, travel};
use crate::seen::{Known, Seen};

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
    pub(crate) limits: Limits,
    pub(crate) seen: Seen,
    pub(crate) findings: Findings,
    pub(crate) unchecked: BTreeSet<Unchecked>,
    pub(crate) travel: travel::Met,
    pub(crate) feed: feed::Met,
    pub(crate) spindle: spindle::Met,
    pub(crate) points: points::Met,
    /// Place of the first block that was not read.
    first_refusal: Option<Span>,
    /// Work offset and length that `seen.base` was found out for.
    based: Option<Based>,
    events: Vec<Event>,
    /// Where the axes stood after the last event.
    last: [Nanos; AXES],
    ended: bool,
    /// Whether the program has cancelled a length offset.
    pub(crate) cancels_length: bool,
}

/// Work offset in force, entry of the length table, and edge where the length is no entry.
type Based = (u16, Option<u32>, Option<(i64, u32)>);

/// What of the statement a rule may need besides its events.
pub(crate) struct Step<'s> {
    pub(crate) stmt: &'s Stmt,
    /// Where the axes stood before it, program coordinates.
    pub(crate) from: [Nanos; AXES],
    /// Of which axes that was known.
    pub(crate) from_known: [bool; AXES],
    /// Whether its words are machine coordinates.
    pub(crate) raw: bool,
    /// Whether points were those of the tool's tip, or of a tilted plane.
    pub(crate) tilted: bool,
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
            limits,
            seen: Seen::default(),
            findings: Findings::default(),
            unchecked,
            travel: travel::Met::default(),
            feed: feed::Met::default(),
            spindle: spindle::Met::default(),
            points: points::Met::default(),
            first_refusal: None,
            based: None,
            events: Vec::new(),
            last: exec.machine(),
            ended: false,
            cancels_length: false,
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
            from_known: self.seen.program,
            raw: std::mem::take(&mut self.seen.raw),
            tilted: exec.is_tilted(),
        };
        self.before(stmt);
        let saved = (exec.feed() == 0 && cuts(&stmt.op, exec)).then(|| exec.clone());
        let mut events = std::mem::take(&mut self.events);
        events.clear();
        let mut done = exec.step(stmt, &mut events);
        if let (Err(Diagnostic { fault: Fault::NoFeed, .. }), Some(saved)) = (&done, saved) {
            feed::missing(self, stmt.span);
            *exec = saved;
            events.clear();
            let one = Expr::Num(Num { mantissa: 1, scale: 0, point: true, unit: Unit::Mm });
            // It cannot fail; the feed that follows from it is not looked at.
            let _ = exec.step(&Stmt::new(stmt.span, Op::SetFeedRate(one)), &mut events);
            events.clear();
            done = exec.step(stmt, &mut events);
        }
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

    /// A block that was not read: what it may have changed is not known from here.
    pub fn lose(&mut self, refusal: &Refusal) {
        self.first_refusal.get_or_insert(refusal.span);
        self.seen.lose();
        self.spindle = spindle::Met::default();
        if let Some(mode) = refusal.on {
            self.seen.switch_on(mode, refusal.span);
        }
        self.based = None;
    }

    /// Numbers without a point of the piece of text whose statements come next.
    pub fn bare(&mut self, span: Span, read: Num, with_point: Num, feed: bool) {
        points::note(self, span, read, with_point, feed);
    }

    /// The text has a length with a point.
    pub fn pointed(&mut self) {
        self.points.pointed = true;
    }

    /// Something that was found otherwise.
    pub fn add(&mut self, finding: Finding) {
        self.findings.add(finding);
    }

    /// The execution was given up: it does not come to an end.
    pub fn give_up(&mut self) {
        self.unchecked.insert(Unchecked::Endless);
        self.ended = true;
    }

    /// Whether the program has ended.
    pub fn ended(&self) -> bool {
        self.ended
    }

    /// The end of the program at the end of its text; a subprogram alone leaves everything to its caller.
    pub fn finish(mut self, subprogram: bool, end: Span) -> Checked {
        if subprogram {
            self.findings.retain(|finding| !finding.at_entry && !matches!(finding.what, What::Left(_)));
        } else if !self.ended {
            left::on(&mut self, end);
        }
        points::finish(&mut self);
        let left_out = self.findings.left_out().collect();
        Checked {
            findings: self.findings.sorted(),
            left_out,
            unchecked: self.unchecked.into_iter().collect(),
            first_refusal: self.first_refusal,
        }
    }

    /// What a statement says before it is executed.
    fn before(&mut self, stmt: &Stmt) {
        match &stmt.op {
            Op::UseMachineCoordinates { .. } => self.seen.raw = true,
            Op::StopCutterRadiusCompensation => self.seen.switch_off(LeftOn::Compensation),
            Op::ClearFrame(FrameSlot::Shift) | Op::UseOriginShift(false) => {
                self.seen.switch_off(LeftOn::Frame);
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
            Op::StartCutterRadiusCompensation { .. } => self.seen.switch_on(LeftOn::Compensation, at),
            Op::SetDistanceMode(Distance::Incremental) => self.seen.switch_on(LeftOn::Incremental, at),
            Op::SetDistanceMode(Distance::Absolute) => self.seen.switch_off(LeftOn::Incremental),
            Op::ClearFrame(FrameSlot::Shift) => {}
            Op::SetFrame(_) | Op::SetSlot(_) | Op::SetPosition(_) | Op::ClearFrame(_) => {
                // A shift of zero is none.
                if !exec.has_program_frames() {
                    self.seen.switch_off(LeftOn::Frame);
                } else if !matches!(step.stmt.op, Op::ClearFrame(_)) {
                    self.seen.switch_on(LeftOn::Frame, at);
                }
                self.forget_program();
                if step.tilted != exec.is_tilted() {
                    self.seen.machine[..3].fill(false);
                }
            }
            Op::UseOriginShift(_) => self.forget_program(),
            Op::UseToolCentrePoint(_) => {
                self.forget_program();
                self.seen.machine[..3].fill(false);
            }
            Op::OrientToolAxis(_) => {
                self.forget_program();
                self.seen.machine = [false; AXES];
            }
            Op::SetOriginOffsets(_) => {
                self.rebase(exec);
                self.forget_program();
            }
            Op::UseToolLengthOffset(_) | Op::UseToolLength(_) | Op::UseToolEdge { .. } => {
                self.seen.length_lost = false;
                length::said(self, at, exec);
                self.rebase(exec);
            }
            Op::StartCycle(_) => {
                self.seen.switch_on(LeftOn::Cycle, at);
                rapid::cycle(self, step, exec);
            }
            Op::EndCycle => self.seen.switch_off(LeftOn::Cycle),
            Op::FloodOn | Op::MistOn => self.seen.switch_on(LeftOn::Coolant, at),
            Op::CoolantOff => self.seen.switch_off(LeftOn::Coolant),
            _ => {}
        }
    }

    /// Something that happens.
    fn event(&mut self, step: &Step, event: &Event, exec: &Exec) {
        match &event.kind {
            Kind::Traverse => {
                rapid::moved(self, step, exec);
                self.moved(step, event);
            }
            Kind::Feed | Kind::Arc { .. } => {
                spindle::cut(self, event, self.last);
                feed::cut(self, event, self.last);
                self.moved(step, event);
            }
            // It touches, and cuts nothing.
            Kind::Probe { .. } => {
                spindle::probed(self);
                self.moved(step, event);
            }
            Kind::Synchronised { .. } => {
                spindle::cut(self, event, self.last);
                self.moved(step, event);
            }
            Kind::Orient(_) => {
                self.seen.spindle = Known::Said;
                self.spindle = spindle::Met::held();
                self.seen.switch_off(LeftOn::Spindle);
            }
            Kind::ToolChange => {
                spindle::changed(self);
                length::changed(self, event);
            }
            // Spindle and coolant stay on for the next pass.
            Kind::BeginAgain => self.ended = true,
            Kind::ProgramEnd => {
                left::on(self, event.span);
                self.ended = true;
            }
            Kind::Attribute(Attribute::FeedRate(feed)) => {
                self.seen.feed = Known::Said;
                feed::said(self, *feed, event.span);
            }
            Kind::Attribute(Attribute::SpindleSpeed(revs)) => {
                self.seen.speed = Known::Said;
                self.spindle = spindle::Met::default();
                speed::said(self, *revs, event.span);
            }
            Kind::Attribute(Attribute::StartSpindle(_)) => {
                self.seen.spindle = Known::Said;
                self.spindle = spindle::Met::default();
                self.seen.switch_on(LeftOn::Spindle, event.span);
            }
            Kind::Attribute(Attribute::StopSpindle) => {
                self.seen.spindle = Known::Said;
                self.spindle = spindle::Met::default();
                self.seen.switch_off(LeftOn::Spindle);
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
            length::z_moves(self, event);
        }
        if self.limits.machine {
            travel::moved(self, event, self.last);
        }
    }

    /// The axis words of a move make places known.
    #[inline]
    fn words(&mut self, to: &Point, raw: bool, exec: &Exec) {
        for (axis, word) in to.axes.iter().enumerate() {
            let Some(word) = word else { continue };
            if raw {
                self.seen.machine[axis] = axis != Axis::Z as usize || !self.seen.length_lost;
                self.seen.program[axis] = self.seen.base[axis];
            } else if word.distance.or(exec.distance()) == Distance::Absolute {
                self.seen.program[axis] = true;
                self.seen.machine[axis] = self.seen.base[axis];
            }
        }
        if exec.is_tilted() && !raw {
            self.seen.machine[..3].fill(false);
        }
        if exec.has_frames() && !raw {
            // A turned frame mixes its axes.
            let all = self.seen.program[..3].iter().all(|known| *known);
            for known in &mut self.seen.machine[..3] {
                *known &= all;
            }
        }
    }

    /// Program zero is elsewhere: places in the program's coordinates are not known any more.
    fn forget_program(&mut self) {
        self.seen.program = [false; AXES];
        // Where the machine stands is as well known as before.
    }

    /// Finds out of which axes an absolute word is known in machine coordinates.
    pub(crate) fn rebase(&mut self, exec: &Exec) {
        let key = (exec.offset_in_force(), exec.length_entry(), exec.length_edge());
        if self.based == Some(key) {
            return;
        }
        self.based = Some(key);
        let row = self.limits.tables.work_offsets.get(&key.0);
        let length = !self.seen.length_lost && self.knows_length(exec);
        self.seen.base = std::array::from_fn(|axis| {
            let zero = row.is_some_and(|row| row[axis].is_some());
            !self.seen.frame_lost && zero && (axis != Axis::Z as usize || length)
        });
    }

    fn knows_length(&self, exec: &Exec) -> bool {
        match (exec.length_entry(), exec.length_edge()) {
            (Some(0), _) => true,
            (Some(entry), _) => self.limits.tables.lengths.contains_key(&entry),
            (None, Some((_, edge))) => edge == 0,
            (None, None) => false,
        }
    }

    /// Why the place of an axis is not known in machine coordinates.
    pub(crate) fn why_unknown(&self, axis: usize) -> Unchecked {
        let (offset, entry, edge) = self.based.unwrap_or((0, None, None));
        let row = self.limits.tables.work_offsets.get(&offset);
        if self.seen.frame_lost {
            Unchecked::Frame(axis as u8)
        } else if row.is_none_or(|row| row[axis].is_none()) {
            Unchecked::Offset(offset, axis as u8)
        } else if !self.seen.base[axis] {
            let tool = edge.map(|(tool, _)| tool);
            Unchecked::Length(entry.map(i64::from).or(tool).unwrap_or(-1))
        } else {
            Unchecked::Start(axis as u8)
        }
    }

    pub(crate) fn find(&mut self, what: What, span: Span) -> Option<usize> {
        self.findings.add(Finding::new(what, span))
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
