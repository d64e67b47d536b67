//! Canned cycles: called by name, for the blocks that follow or once where the tool is.
//!
//! The reference plane is the one that the cycle states. Where it states none it is the retract plane itself,
//! without a safety distance: the control's checks then see it as the surface, and the moves are the same whatever
//! the surface is. Only a first peck of its own needs the two apart.

use ncc_dialects::{CallKind, CallRow, NameMeaning, ParameterRole as Role, Quantity};
use ncc_ir::canon::{Axis, Distance, Fact, Motion, Plane, ReturnLevel, Spindle, Turn, Units};
use ncc_ir::caps::CycleForm;
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::{Nanos, Num, Unit};
use ncc_ir::expr::{Binary, Expr, Node};
use ncc_ir::lack::{HolesLack, ThreadsLack, WordsLack};
use ncc_ir::program::cycle::{Clearance, Cycle, CycleKind, Shift, Tap, clearance_by_depth};
use ncc_ir::program::{Coord, Op, Pitch, Point, Stmt};
use ncc_ir::source::Span;
use ncc_ir::track::ActiveCycle;

use super::{Modal, Sink, Writer, call_text};
use crate::common::block::{Need, Part, Rank};
use crate::common::codes::Letter;
use crate::common::fault::cannot;
use crate::common::number;
use crate::common::setting::Inserted;

/// Values of the unit of a pitch: millimetres a turn, inches a turn.
const PITCH_IN_MM: &str = "1";
const PITCH_IN_INCHES: &str = "3";

/// How many of a block's statements are one call: a cycle activated with its hole where the tool is,
/// and its end if that follows.
pub(super) fn called_here(rest: &[Stmt]) -> usize {
    let [call, hole, further @ ..] = rest else { return 1 };
    let joined = |s: &Stmt| s.joined && s.skip == call.skip;
    let here = matches!(&hole.op, Op::Hole(to) if to.to.is_empty());
    if !matches!(call.op, Op::StartCycle(_)) || !here || !joined(hole) || call.comment.is_some() {
        return 1;
    }
    match further.first() {
        Some(end) if end.op == Op::EndCycle && joined(end) && hole.comment.is_none() => 3,
        _ if call.skip.is_none() => 2,
        Some(_) | None => 1,
    }
}

/// The arguments of a call, by their places.
pub(super) struct Arguments {
    pub(super) row: &'static CallRow,
    values: Vec<Option<String>>,
}

impl Arguments {
    pub(super) fn new(row: &'static CallRow) -> Arguments {
        Arguments { row, values: vec![None; row.parameters.len()] }
    }

    /// Puts an argument in its place.
    ///
    /// # Errors
    /// The call has no such parameter.
    pub(super) fn put(&mut self, role: Role, value: String) -> Result<(), Fault> {
        let place = self.row.place(role);
        let place =
            place.ok_or_else(|| cannot(HolesLack::CycleArgument { cycle: (*self.row.name).into() }))?;
        self.values[place] = Some(value);
        Ok(())
    }

    /// Puts arguments in the places of a role that several parameters have.
    pub(super) fn put_all(&mut self, role: Role, values: impl IntoIterator<Item = String>) {
        let places = self.row.parameters.iter().enumerate().filter(|(_, p)| p.role == Some(role));
        for ((place, _), value) in places.zip(values) {
            self.values[place] = Some(value);
        }
    }

    pub(super) fn text(self) -> String {
        call_text(self.row, self.values)
    }
}

impl Writer {
    pub(super) fn call_modal(&self) -> Result<&'static str, Fault> {
        let row = self.dialect.name_for(NameMeaning::CallModal);
        Ok(&row.ok_or_else(|| cannot(HolesLack::ModalCall))?.name)
    }

    /// The letter and the form of a parameter's numbers.
    pub(super) fn parameter(&self, row: &CallRow, role: Role) -> Letter {
        let parameter = row.parameters.iter().find(|p| p.role == Some(role));
        let quantity = parameter.and_then(|p| p.quantity).unwrap_or(Quantity::Length);
        self.letter(parameter.map_or("X", |p| &p.name), quantity)
    }

    /// Writes an argument.
    pub(super) fn argument(
        &mut self,
        to: &mut Arguments,
        role: Role,
        value: &Expr,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let letter = self.parameter(to.row, role);
        let text = self.value(&letter, value, span, sink)?;
        to.put(role, text)
    }

    /// Calls a cycle up: for the blocks that follow, or once where the tool is. Then the program
    /// may go on with it, or not: it is activated for the next blocks when one needs it.
    pub(super) fn start_cycle(
        &mut self,
        cycle: &Cycle,
        with: usize,
        stmt: &Stmt,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let span = stmt.span;
        self.owed = None;
        self.cycled = true;
        if with > 1 {
            self.end_modal(sink)?;
        }
        self.settle_edge(span, sink)?;
        let text = self.cycle_text(cycle, stmt, sink)?;
        self.variables.cycle_begins(cycle);
        let bores = matches!(cycle.kind, CycleKind::Bore { .. })
            && self.cycle_row(&cycle.kind, cycle.feed.is_some())?.place(Role::FeedIn).is_some();
        match (&cycle.feed, bores) {
            (Some(feed), false) => {
                if !self.standing.feed_said || self.standing.feed != feed.literal() {
                    self.feed(feed, span, sink)?;
                }
                (self.standing.feed, self.standing.feed_said) = (feed.literal(), true);
            }
            (None, false) => self.restate_feed(span, sink)?,
            (_, true) => {
                let out = matches!(&cycle.kind, CycleKind::Bore { feed_out: Some(_), .. });
                let feed = cycle.feed.as_ref().and_then(Expr::literal).or(self.standing.feed);
                self.standing.feed = feed.filter(|_| !out);
                self.standing.feed_said = false;
            }
        }
        let row = self.cycle_row(&cycle.kind, cycle.feed.is_some())?;
        self.tell_unsure(row, "START_CYCLE", span, sink);
        match with {
            1 => {
                self.owed = Some(text);
                // What the spindle does for a tap that makes no hole is left open: it is activated for one.
                let waits = matches!(&cycle.kind, CycleKind::Tap(tap) if !tap.chuck) && stmt.skip.is_none();
                if waits { Ok(()) } else { self.pay_call(sink) }
            }
            2 => {
                self.alone(&text, sink)?;
                self.owed = Some(text);
                Ok(())
            }
            _ => self.alone(&text, sink),
        }
    }

    fn cycle_row(&self, kind: &CycleKind, feed: bool) -> Result<&'static CallRow, Fault> {
        let call = match kind {
            CycleKind::Drill => CallKind::Drill,
            CycleKind::DrillDwell { .. } => CallKind::DrillDwell,
            CycleKind::DrillPeck { .. } | CycleKind::DrillBreak { .. } => CallKind::DrillPeck,
            CycleKind::Bore { .. } => CallKind::Bore,
            CycleKind::Tap(tap) if tap.chuck => CallKind::Tap,
            CycleKind::Tap(_) => CallKind::TapRigid,
            CycleKind::FineBore(_) => CallKind::BoreFine,
            CycleKind::BoreStop(_) => CallKind::BoreStop,
        };
        if !CycleForm::Stated.says(kind) {
            return Err(cannot(HolesLack::CycleForm { kind: kind.name() }));
        }
        // Of several, the one that says what there is to say and no more.
        let fits = |row: &&CallRow| match kind {
            CycleKind::Bore { dwell: Some(_), feed_out: None, .. } if !feed => {
                row.place(Role::FeedIn).is_none()
            }
            CycleKind::Bore { .. } => row.place(Role::FeedIn).is_some(),
            CycleKind::BoreStop(bore) => row.place(Role::Dwell).is_some() == bore.dwell.is_some(),
            _ => true,
        };
        let mut rows = self.dialect.call.iter().filter(|row| row.kind == call);
        rows.find(fits).ok_or_else(|| cannot(HolesLack::Cycle { kind: kind.name() }))
    }

    /// The call of a cycle.
    fn cycle_text(&mut self, cycle: &Cycle, stmt: &Stmt, sink: &mut Sink) -> Result<String, Fault> {
        let span = stmt.span;
        let row = self.cycle_row(&cycle.kind, cycle.feed.is_some())?;
        let mut inserted = Inserted::default();
        self.words.need_plane(cycle.plane, &mut inserted)?;
        self.words.admit_with(Need::new(Rank::Setting), inserted, sink)?;
        let mut ahead = self.words.tracker.clone();
        ahead.apply(&stmt.op);
        let planes = ahead.cycle.ok_or_else(|| cannot(HolesLack::CycleUnknown))?;
        let mut to = Arguments::new(row);
        self.planes(&planes, &mut to, span, sink)?;
        match &cycle.kind {
            CycleKind::Drill => {}
            CycleKind::Tap(tap) => self.tap(tap, &mut to, span, sink)?,
            CycleKind::FineBore(bore) => {
                if let Some(dwell) = &bore.dwell {
                    self.argument(&mut to, Role::Dwell, dwell, span, sink)?;
                }
                to.put(Role::Sense, sense(bore.turn.map_or(Spindle::Stopped, Turn::spindle)).into())?;
                let plane = cycle.plane.known().or(self.words.active.plane).unwrap_or(Plane::Xy);
                let (first, second, normal) = plane.axes();
                let roles =
                    [(first, Role::ShiftFirst), (second, Role::ShiftSecond), (normal, Role::ShiftNormal)];
                if let Shift::Stated(by) = &bore.shift {
                    for (axis, role) in roles {
                        match &by[axis as usize] {
                            Some(by) => self.argument(&mut to, role, by, span, sink)?,
                            None => to.put(role, "0".into())?,
                        }
                    }
                }
                if let Some(angle) = &bore.angle {
                    self.argument(&mut to, Role::Orientation, angle, span, sink)?;
                }
            }
            CycleKind::BoreStop(bore) => {
                if let Some(dwell) = &bore.dwell {
                    self.argument(&mut to, Role::Dwell, dwell, span, sink)?;
                }
                to.put(Role::Sense, sense(bore.turn.map_or(Spindle::Stopped, Turn::spindle)).into())?;
            }
            CycleKind::DrillDwell { dwell } => self.argument(&mut to, Role::Dwell, dwell, span, sink)?,
            CycleKind::DrillPeck { less: Some(_), .. } | CycleKind::DrillBreak { less: Some(_), .. } => {
                return Err(cannot(HolesLack::DecreasingPecks));
            }
            CycleKind::DrillPeck { peck, first, less: None, clearance, pause, settle, dwell } => {
                self.strokes(&planes, peck, first.as_ref(), &mut to, span, sink)?;
                self.pauses(pause.as_ref(), dwell.as_ref(), &mut to, span, sink)?;
                if let Some(settle) = settle {
                    self.argument(&mut to, Role::Settle, settle, span, sink)?;
                }
                to.put(Role::Way, "1".into())?;
                if !self.is_own_clearance(&planes.cycle, row) {
                    self.distance(Role::Clearance, clearance, &mut to, span, sink)?;
                }
            }
            CycleKind::DrillBreak { peck, first, less: None, lift, lift_at_feed, pause, dwell } => {
                if !lift_at_feed {
                    return Err(cannot(HolesLack::RapidLift));
                }
                self.strokes(&planes, peck, first.as_ref(), &mut to, span, sink)?;
                self.pauses(pause.as_ref(), dwell.as_ref(), &mut to, span, sink)?;
                to.put(Role::Way, "0".into())?;
                self.distance(Role::Lift, lift, &mut to, span, sink)?;
            }
            CycleKind::Bore { dwell, .. } if row.place(Role::FeedIn).is_none() => {
                if let Some(dwell) = dwell {
                    self.argument(&mut to, Role::Dwell, dwell, span, sink)?;
                }
            }
            CycleKind::Bore { dwell, feed_out, .. } => {
                if let Some(dwell) = dwell {
                    self.argument(&mut to, Role::Dwell, dwell, span, sink)?;
                }
                let in_force = || self.standing.feed.map(Expr::Num);
                let feed = cycle.feed.clone().or_else(in_force);
                let feed = feed.ok_or_else(|| cannot(HolesLack::BoringFeedUnknown))?;
                self.argument(&mut to, Role::FeedIn, &feed, span, sink)?;
                self.argument(&mut to, Role::FeedOut, feed_out.as_ref().unwrap_or(&feed), span, sink)?;
            }
        }
        Ok(to.text())
    }

    /// Arguments of a tapping cycle.
    fn tap(&mut self, tap: &Tap, to: &mut Arguments, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        if let Some(dwell) = &tap.dwell {
            self.argument(to, Role::Dwell, dwell, span, sink)?;
        }
        to.put(Role::After, sense(tap.after).into())?;
        if tap.chuck {
            to.put(Role::Back, sense(tap.turn.back().spindle()).into())?;
            to.put(Role::Encoder, if tap.pitch == Pitch::Feed { "1" } else { "0" }.into())?;
        } else {
            let speed = self.standing.speed.filter(|speed| !speed.is_zero());
            let speed = speed.ok_or_else(|| cannot(ThreadsLack::RigidSpeedUnknown))?;
            self.argument(to, Role::Speed, &Expr::Num(speed), span, sink)?;
            self.argument(to, Role::SpeedOut, &Expr::Num(speed), span, sink)?;
        }
        let Pitch::Stated(pitch) = &tap.pitch else { return Ok(()) };
        let pitch = pitch.literal().ok_or_else(|| cannot(ThreadsLack::ComputedPitch))?.trimmed();
        // Without a unit of its own a pitch counts in the machine's basic system.
        let inch = match (self.words.active.units, pitch.unit) {
            (_, Unit::Inch) | (Some(Units::Inch), Unit::Entry) => true,
            (_, Unit::Mm) | (Some(Units::Mm), Unit::Entry) => false,
            _ => {
                self.words.check_unit(pitch, span)?;
                return Err(cannot(ThreadsLack::PitchUnitUnknown));
            }
        };
        if inch {
            to.put(Role::PitchUnit, PITCH_IN_INCHES.into())?;
        } else if self.inch_machine || self.words.active.units == Some(Units::Inch) {
            to.put(Role::PitchUnit, PITCH_IN_MM.into())?;
        }
        let sign = if tap.turn == Turn::Counterclockwise { "-" } else { "" };
        let digits = format!("{:0>1$}", pitch.mantissa.unsigned_abs(), usize::from(pitch.scale) + 1);
        let (whole, rest) = digits.split_at(digits.len() - usize::from(pitch.scale));
        let point = if rest.is_empty() { "" } else { "." };
        to.put(Role::ThreadPitch, format!("{sign}{whole}{point}{rest}"))
    }

    /// Return plane, retract plane and bottom.
    fn planes(
        &mut self,
        planes: &ActiveCycle,
        to: &mut Arguments,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let cycle = &planes.cycle;
        let axis = cycle.plane.known().or(self.words.active.plane).unwrap_or(Plane::Xy).axes().2;
        let retract = self.level(&cycle.retract, planes.retract, axis, to.row, span, sink)?;
        let (back, level) = match (&cycle.return_plane, cycle.return_level) {
            (Some(word), _) => {
                let text = self.level(word, planes.return_plane, axis, to.row, span, sink)?;
                (text, planes.return_plane)
            }
            (None, Fact::Known(ReturnLevel::Retract)) => (retract.clone(), planes.retract),
            (None, Fact::Known(ReturnLevel::Initial)) => {
                let unknown = Fault::PositionUnknown { axis: axis.letter() as char };
                let initial = planes.initial.ok_or(unknown)?;
                (self.length(initial, &self.parameter(to.row, Role::ReturnPlane))?, Some(initial))
            }
            (None, Fact::Entry) => return Err(cannot(HolesLack::CallersReturnLevel)),
        };
        if level.zip(planes.retract).is_some_and(|(level, retract)| level < retract) {
            return Err(cannot(HolesLack::BelowRetractPlane));
        }
        let depth = self.level(&cycle.depth, planes.depth, axis, to.row, span, sink)?;
        to.put(Role::ReturnPlane, back)?;
        match self.above_reference(cycle, to.row) {
            Some((reference, safety)) => {
                self.argument(to, Role::ReferencePlane, reference, span, sink)?;
                self.argument(to, Role::SafetyDistance, &Expr::Num(safety), span, sink)?;
            }
            None => {
                to.put(Role::ReferencePlane, retract)?;
                to.put(Role::SafetyDistance, "0".into())?;
            }
        }
        to.put(Role::Depth, depth)
    }

    /// The reference plane of a cycle that states it, and how far the retract plane is above it, where that is a number
    /// and both have digits enough here to add up. The first peck counts from there: it must be longer by just that.
    fn above_reference<'c>(&self, cycle: &'c Cycle, row: &CallRow) -> Option<(&'c Expr, Num)> {
        let reference = cycle.reference.as_ref()?;
        let absolute = |word: &Coord| word.distance == Fact::Known(Distance::Absolute);
        let safety = apart(&cycle.retract.value, &reference.value)?;
        let first = match &cycle.kind {
            CycleKind::DrillPeck { peck, first, .. } | CycleKind::DrillBreak { peck, first, .. } => {
                let more = apart(first.as_ref()?, peck)?;
                (more.mantissa, more.scale) == (safety.mantissa, safety.scale)
            }
            _ => true,
        };
        let unit = match self.words.active.units? {
            Units::Mm => Unit::Mm,
            Units::Inch => Unit::Inch,
        };
        let decimals = self.parameter(row, Role::Depth).format.decimals_for(unit);
        let whole = |num: Num| num.trimmed().scale <= decimals;
        let digits = whole(safety) && reference.value.literal().is_none_or(whole);
        let stated = absolute(reference) && absolute(&cycle.retract) && safety.mantissa > 0;
        (first && digits && stated).then_some((&reference.value, safety))
    }

    /// A level along the drilling axis, in the digits of the program where it is absolute there.
    fn level(
        &mut self,
        word: &Coord,
        resolved: Option<Nanos>,
        axis: Axis,
        row: &CallRow,
        span: Span,
        sink: &mut Sink,
    ) -> Result<String, Fault> {
        let letter = self.parameter(row, Role::Depth);
        let distance = word.distance.known().or(self.words.active.distance);
        match (distance, resolved) {
            (Some(Distance::Absolute), _) => self.value(&letter, &word.value, span, sink),
            (_, Some(nanos)) => self.length(nanos, &letter),
            (_, None) => Err(Fault::PositionUnknown { axis: axis.letter() as char }),
        }
    }

    /// Depth of the pecks. The first one is measured from the reference plane as all the others are,
    /// so that a longer one needs that plane below the retract plane.
    fn strokes(
        &mut self,
        planes: &ActiveCycle,
        peck: &Expr,
        first: Option<&Expr>,
        to: &mut Arguments,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let stated = self.above_reference(&planes.cycle, to.row).map(|(_, safety)| safety);
        let mut below_retract = stated;
        if let Some(first) = first.filter(|_| stated.is_none()) {
            let word = &planes.cycle.retract;
            let distance = word.distance.known().or(self.words.active.distance);
            let more = difference(first, peck);
            let plane = more.filter(|_| distance == Some(Distance::Absolute));
            let plane = plane.and_then(|more| difference(&word.value, &Expr::Num(more)));
            let (Some(more), Some(plane)) = (more, plane) else {
                return Err(cannot(HolesLack::FirstPeckUnknown));
            };
            if more.mantissa < 0 {
                return Err(cannot(HolesLack::ShortFirstPeck));
            }
            for (role, value) in [(Role::SafetyDistance, more), (Role::ReferencePlane, plane)] {
                self.argument(to, role, &Expr::Num(value), span, sink)?;
            }
            below_retract = Some(more);
        }
        // A first depth below the bottom is alarm 61107: such a hole is made in one go.
        let inch = self.words.active.units == Some(Units::Inch);
        let lower = below_retract.map_or(Some(0), |more| more.nanos(inch));
        let in_one = peck.literal().and_then(|peck| peck.nanos(inch)).zip(planes.retract).and_then(
            |(peck, retract)| {
                let whole = retract.checked_sub(lower?)?.checked_sub(planes.depth?)?;
                (0 < whole && whole < peck).then_some(whole)
            },
        );
        if let Some(whole) = in_one {
            sink.report(Fault::PeckShortened, span);
            let text = self.length(whole, &self.parameter(to.row, Role::RelativeFirstDepth))?;
            return to.put(Role::RelativeFirstDepth, text);
        }
        self.argument(to, Role::RelativeFirstDepth, peck, span, sink)
    }

    /// Dwells at the bottom of pecks and of the hole.
    fn pauses(
        &mut self,
        pause: Option<&Expr>,
        dwell: Option<&Expr>,
        to: &mut Arguments,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        if let Some(pause) = pause {
            self.argument(to, Role::Dwell, pause, span, sink)?;
        }
        match (pause, dwell) {
            (None, None) => Ok(()),
            (Some(pause), Some(dwell)) if pause == dwell => Ok(()),
            (_, Some(dwell)) => self.argument(to, Role::LastDwell, dwell, span, sink),
            (Some(_), None) => Err(cannot(HolesLack::DwellAfterPecks)),
        }
    }

    /// Whether a clearance is the one that the control takes for the depth of the hole where none is stated.
    fn is_own_clearance(&self, cycle: &Cycle, row: &CallRow) -> bool {
        let CycleKind::DrillPeck { first, clearance: Clearance::Stated(said), .. } = &cycle.kind else {
            return false;
        };
        let reference = match self.above_reference(cycle, row) {
            Some((reference, _)) => reference,
            // For a first peck of its own another plane is stated.
            None if first.is_some() => return false,
            None => &cycle.retract.value,
        };
        let absolute = |word: &Coord| word.distance == Fact::Known(Distance::Absolute);
        let own = |units| clearance_by_depth(&reference.minus(&cycle.depth.value), units);
        let stated = absolute(&cycle.retract) && absolute(&cycle.depth);
        stated && self.words.active.units.is_some_and(|units| *said == own(units))
    }

    /// A clearance or a lift, which cannot be zero: that stands for the control's own.
    fn distance(
        &mut self,
        role: Role,
        value: &Clearance,
        to: &mut Arguments,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        match value {
            Clearance::Stated(value) if value.literal().is_some_and(|n| n.mantissa > 0) => {
                self.argument(to, role, value, span, sink)
            }
            Clearance::Stated(Expr::Node(_)) => Err(cannot(HolesLack::ComputedClearance)),
            Clearance::Stated(Expr::Num(_)) => Err(cannot(HolesLack::NoClearance)),
            Clearance::Parameter => Err(cannot(HolesLack::ParameterClearance)),
            Clearance::FromReturn => Err(cannot(HolesLack::FeedDownPecks)),
        }
    }

    /// A hole at a position, with the active cycle.
    pub(super) fn hole(&mut self, to: &Point, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        self.pay_call(sink)?;
        if self.standing.modal == Modal::Off {
            return Err(cannot(HolesLack::HoleOfUnknownCycle));
        }
        let plane = self.hole_plane();
        if plane.is_some_and(|p| to.get(p.axes().2).is_some()) {
            return Err(cannot(HolesLack::AlongDrillingAxis));
        }
        let here;
        let to = match to.is_empty() {
            true => {
                here = self.here(plane.ok_or_else(|| cannot(HolesLack::HolePlaneUnknown))?)?;
                &here
            }
            false => to,
        };
        let traverse = self.words.codes.traverse.ok_or_else(|| cannot(WordsLack::RapidMove))?;
        let says = self.words.active.motion != Some(Motion::Traverse);
        let mut inserted = Inserted::default();
        self.words.need_distance(to.axes.iter().flatten(), &mut inserted)?;
        let need = self.words.point_need(Need::new(Rank::Motion).code(says.then_some(traverse)), to)?;
        self.words.admit_with(need, inserted, sink)?;
        if says {
            self.words.block.code(Part::Motion, &traverse);
        }
        self.words.active.motion = Some(Motion::Traverse);
        self.words.point(to, span, sink)
    }

    /// The plane of the active cycle.
    pub(super) fn hole_plane(&self) -> Option<Plane> {
        let cycle = self.words.tracker.cycle.as_ref();
        cycle.and_then(|c| c.cycle.plane.known()).or(self.words.active.plane)
    }

    /// Words for the position where the tool is: a cycle is made only after a block with some.
    fn here(&self, plane: Plane) -> Result<Point, Fault> {
        let (first, second, _) = plane.axes();
        let unit = match self.words.active.units {
            Some(Units::Mm) => Unit::Mm,
            Some(Units::Inch) => Unit::Inch,
            None => Unit::Entry,
        };
        let mut to = Point::default();
        for axis in [first, second] {
            let letter = self.words.codes.axes[axis as usize].ok_or_else(|| cannot(WordsLack::Axis))?;
            let (value, distance) = match (self.words.axis_position(axis), unit) {
                (Ok(nanos), Unit::Mm | Unit::Inch) => {
                    (number::from_nanos(nanos, &letter.format, unit), Distance::Absolute)
                }
                _ => (Num::int(0, unit), Distance::Incremental),
            };
            to.set(axis, Coord { value: Expr::Num(value), distance: Fact::Known(distance) });
        }
        Ok(to)
    }
}

/// The machine's code for what the spindle does, as an argument.
fn sense(spindle: Spindle) -> &'static str {
    match spindle {
        Spindle::Clockwise => "3",
        Spindle::Counterclockwise => "4",
        Spindle::Stopped => "5",
    }
}

/// By how much a length is said to be more than another one, where that is a number.
fn apart(more: &Expr, than: &Expr) -> Option<Num> {
    if let Expr::Node(node) = more
        && let Node::Binary(Binary::Add, of, by) = &**node
        && same_length(of, than)
    {
        return by.literal().map(Num::trimmed);
    }
    difference(more, than)
}

/// Whether an operand is a length: a literal has no unit there.
fn same_length(operand: &Expr, length: &Expr) -> bool {
    match (operand.literal(), length.literal()) {
        (Some(a), Some(b)) => (a.mantissa, a.scale) == (b.mantissa, b.scale),
        _ => operand == length,
    }
}

/// The exact difference of two literals in one unit.
fn difference(a: &Expr, b: &Expr) -> Option<Num> {
    a.literal()?.minus(b.literal()?).map(Num::trimmed)
}
