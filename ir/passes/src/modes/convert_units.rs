//! `millimetres` and `inches`: every length and feed is written in one unit.
//!
//! An inch is 25.4 mm exactly, so to millimetres nothing is lost but digits that are finer than a
//! nano. To inches, positions are rounded to the target's digits, each from its exact place, so that
//! errors do not add up; a pitch or a peck, of which there are many, must come out exact or is
//! refused.

use crate::pass::Pass;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{exact, rounded, unit_of};
use crate::target::Target;
use ncc_ir::canon::{Axis, Distance, SpindleMode, Units};
use ncc_ir::diag::{Diagnostic, Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::geometry::polar;
use ncc_ir::lack::{ModesLack, SpindleLack};
use ncc_ir::program::cycle::{Along, Clearance, Cycle, CycleKind, First, Pattern, Row};
use ncc_ir::program::kinds::{flow, miscellaneous, tooling, variables};
use ncc_ir::program::{
    Centre, Coord, CutterRadius, Data, FrameStep, Op, Pitch, Point, PoleWords, Program, Shape, Slot, Stmt,
    ToolLength,
};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const MILLIMETRES: Pass =
    Pass::named("millimetres", "writes lengths and feeds in millimetres", Some(millimetres));

/// This pass.
pub(crate) const INCHES: Pass = Pass::named("inches", "writes lengths and feeds in inches", Some(inches));

/// Everything in millimetres.
pub fn millimetres(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    run(program, target, entry, Units::Mm, diags);
}

/// Everything in inches.
pub fn inches(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    run(program, target, entry, Units::Inch, diags);
}

fn run(program: &mut Program, target: &Target, entry: &Tracker, to: Units, diags: &mut Vec<Diagnostic>) {
    program.assumed.units = program.assumed.units.map(|_| to);
    each_body(program, entry, |body, walk| {
        for stmt in body {
            walk.enter(stmt.skip);
            let before = walk.clone();
            walk.step(stmt);
            let converter = Converter { target, to, before: &before, after: &walk.at };
            if let Err(fault) = converter.statement(stmt) {
                diags.push(Diagnostic::new(fault, stmt.span));
            }
        }
    });
}

struct Converter<'c> {
    target: &'c Target,
    to: Units,
    before: &'c Walk,
    after: &'c Tracker,
}

impl Converter<'_> {
    fn unit(&self) -> Unit {
        match self.to {
            Units::Mm => Unit::Mm,
            Units::Inch => Unit::Inch,
        }
    }

    fn statement(&self, stmt: &mut Stmt) -> Result<(), Fault> {
        match &mut stmt.op {
            Op::UseLengthUnits(units) => *units = self.to,
            Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Position(m) => self.point(&mut m.to)?,
            Op::SynchronisedFeed(m) => {
                self.point(&mut m.to)?;
                if let Pitch::Stated(pitch) = &mut m.pitch {
                    self.convert_exact(pitch)?;
                }
            }
            // The tool comes out at another level than the words say.
            Op::Hole(m) => self.hole(&mut m.to)?,
            Op::ArcFeed(arc) => {
                self.point(&mut arc.to)?;
                match &mut arc.centre {
                    Centre::Point { words, .. } => {
                        words.iter_mut().flatten().try_for_each(|word| self.loose(word))?;
                    }
                    Centre::Radius(radius) => self.loose(radius)?,
                }
            }
            Op::ArcForm(arc) => {
                self.point(&mut arc.to)?;
                match &mut arc.shape {
                    Shape::AngleAbout { centre, .. } | Shape::Mixed { centre, .. } => {
                        centre.iter_mut().flatten().try_for_each(|word| self.loose(&mut word.value))?;
                    }
                    Shape::Through(via) => {
                        via.axes.iter_mut().take(3).flatten().try_for_each(|w| self.loose(&mut w.value))?;
                    }
                    Shape::Angle { .. } | Shape::Tangent => {}
                }
            }
            Op::SetMotionControlMode(control) => {
                [&mut control.within, &mut control.rapids, &mut control.merged]
                    .into_iter()
                    .flatten()
                    .try_for_each(|length| self.loose(length))?;
            }
            Op::Advise(advice) => advice.amount.iter_mut().try_for_each(|length| self.loose(length))?,
            Op::SetPole(set) => match &mut set.at {
                PoleWords::Along(words) => words.iter_mut().flatten().try_for_each(|w| self.loose(w))?,
                PoleWords::Polar { radius, .. } => self.loose(radius)?,
            },
            Op::Polar(polar) => {
                polar.radius.iter_mut().try_for_each(|word| self.loose(&mut word.value))?;
                if let Some(to) = polar::end(&mut polar.op) {
                    self.hole(to)?;
                }
                if let Op::ArcFeed(arc) = &mut polar.op
                    && let Centre::Radius(radius) = &mut arc.centre
                {
                    self.loose(radius)?;
                }
            }
            Op::SetFeedRate(feed) => self.loose(feed)?,
            Op::SetSpindleMode(SpindleMode::Surface) => {
                return Err(Fault::lacks(SpindleLack::SurfaceOtherUnits));
            }
            // Where the corner ends follows from it.
            Op::Corner { size, .. } => self.convert_exact(size)?,
            Op::StartCutterRadiusCompensation { radius: CutterRadius::Diameter(diameter), .. } => {
                self.convert_exact(diameter)?;
            }
            Op::StartCycle(cycle) => self.cycle(cycle)?,
            Op::Pattern(pattern) => self.pattern(pattern)?,
            Op::GoToReference(reference) => {
                let mut words = reference.via.axes.iter_mut().take(3).flatten();
                words.try_for_each(|word| self.loose(&mut word.value))?;
            }
            Op::SetData(data) => match &mut **data {
                Data::Offset { words, .. } | Data::Measured { words, .. } => {
                    words.iter_mut().take(3).flatten().try_for_each(|word| self.convert_exact(word))?;
                }
                Data::Tool { value, .. } => self.convert_exact(value)?,
                Data::Position(_) | Data::ToolInSpindle(_) => {}
            },
            Op::SetFrame(frame) => {
                if let FrameStep::Translate(words) = &mut frame.step {
                    words.iter_mut().take(3).flatten().try_for_each(|word| self.convert_exact(word))?;
                }
            }
            Op::SetSlot(slot) => match &mut **slot {
                Slot::Shift { axes, .. } => {
                    axes.iter_mut().take(3).flatten().try_for_each(|word| self.convert_exact(word))?;
                }
                Slot::Rotation { centre: words, .. }
                | Slot::Scale { centre: words, .. }
                | Slot::Mirror(words) => {
                    words.iter_mut().flatten().try_for_each(|word| self.convert_exact(word))?;
                }
                Slot::Tilt(tilt) => {
                    tilt.origin.iter_mut().flatten().try_for_each(|word| self.convert_exact(word))?;
                }
                Slot::NoMirror(_) => {}
            },
            Op::SetPosition(axes) => {
                axes.iter_mut().take(3).flatten().try_for_each(|word| self.convert_exact(word))?;
            }
            Op::ExactStop
            | Op::TurnRotaryAxes(_)
            | Op::SetDistanceMode(_)
            | Op::SelectPlane(_)
            | Op::SetFeedMode(_)
            | Op::SetReturnLevel(_)
            | Op::SetOriginOffsets(_)
            | Op::ClearFrame(_)
            | Op::UseToolCentrePoint(_)
            | Op::UseOriginShift(_)
            | Op::OrientToolAxis(_)
            | Op::Probe(_)
            | Op::Detour(_)
            | Op::UseMachineCoordinates { .. }
            | Op::EndCycle
            | Op::ProgramEnd
            | Op::BeginAgain
            | variables!()
            | miscellaneous!()
            | flow!() => {}
            op @ tooling!() => {
                if let Op::UseToolLength(length) = op {
                    match &mut **length {
                        ToolLength::Value(value) | ToolLength::Added(value) => self.convert_exact(value)?,
                        ToolLength::Offsets { words, .. } => {
                            words.iter_mut().flatten().try_for_each(|word| self.convert_exact(word))?;
                        }
                        ToolLength::AddedEntry(_) => {}
                    }
                }
            }
        }
        Ok(())
    }

    /// A number in the unit it is written in now, whichever is active.
    fn known(&self, num: Num) -> Result<Num, Fault> {
        match (num.unit, self.before.at.modes.units) {
            (Unit::Entry, Some(Units::Mm)) => Ok(Num { unit: Unit::Mm, ..num }),
            (Unit::Entry, Some(Units::Inch)) => Ok(Num { unit: Unit::Inch, ..num }),
            (Unit::Entry, None) if !num.is_zero() => Err(Fault::EntryFactNeeded { fact: ModeName::Units }),
            _ => Ok(num),
        }
    }

    /// A number that may be rounded to the target's digits.
    fn loose(&self, value: &mut Expr) -> Result<(), Fault> {
        let Some(num) = value.literal() else {
            return Err(Fault::lacks(ModesLack::ComputedInOtherUnit));
        };
        let num = self.known(num)?;
        let is_length = matches!(num.unit, Unit::Mm | Unit::Inch);
        if is_length && num.unit != self.unit() {
            let nanos = num.nanos(false).ok_or(Fault::OutOfRange { word: "length".into() })?;
            *value = self.nearest(nanos).into();
        }
        Ok(())
    }

    /// The literal of a length: exact in millimetres, rounded in inches.
    fn nearest(&self, nanos: i64) -> Num {
        match self.to {
            Units::Mm => exact(nanos, Unit::Mm),
            Units::Inch => rounded(nanos, self.target.decimals_in(Unit::Inch), Unit::Inch),
        }
    }

    /// A number that must come out exact.
    fn convert_exact(&self, value: &mut Expr) -> Result<(), Fault> {
        let before = value.literal().map(|n| self.known(n)).transpose()?.and_then(|n| n.nanos(false));
        self.loose(value)?;
        match (before, value.literal().and_then(|n| n.nanos(false))) {
            (Some(a), Some(b)) if a == b => Ok(()),
            _ => Err(Fault::lacks(ModesLack::InexactInInches)),
        }
    }

    fn point(&self, to: &mut Point) -> Result<(), Fault> {
        for (axis, word) in Axis::ALL.into_iter().zip(&mut to.axes) {
            if let Some(word) = word {
                let next = self.after.position[axis as usize];
                self.word(word, axis, next)?;
            }
        }
        Ok(())
    }

    fn hole(&self, to: &mut Point) -> Result<(), Fault> {
        let next = self.before.at.target(to);
        for (axis, word) in Axis::ALL.into_iter().zip(&mut to.axes) {
            if let Some(word) = word {
                self.word(word, axis, next[axis as usize])?;
            }
        }
        Ok(())
    }

    /// A coordinate; the step between two places is that between their rounded ones.
    fn word(&self, word: &mut Coord, axis: Axis, next: Option<i64>) -> Result<(), Fault> {
        if axis.is_rotary() {
            return Ok(());
        }
        let incremental =
            word.distance.known().or(self.before.at.modes.distance) == Some(Distance::Incremental);
        let Some(num) = word.value.literal() else { return self.loose(&mut word.value) };
        if !incremental || self.known(num)?.unit == self.unit() {
            return self.loose(&mut word.value);
        }
        let (Some(next), Some(now)) = (next, self.before.at.position[axis as usize]) else {
            return self.convert_exact(&mut word.value);
        };
        let place = |nanos| self.nearest(nanos).nanos(false).unwrap_or(nanos);
        let way = place(next).wrapping_sub(place(now));
        word.value = rounded(way, 9, unit_of(axis, self.unit())).into();
        Ok(())
    }

    fn cycle(&self, cycle: &mut Cycle) -> Result<(), Fault> {
        let planes = [&mut cycle.retract, &mut cycle.depth].into_iter();
        for word in planes.chain(&mut cycle.reference).chain(&mut cycle.return_plane) {
            match word.distance.known().or(self.before.at.modes.distance) {
                Some(Distance::Absolute) => self.loose(&mut word.value)?,
                Some(Distance::Incremental) | None => self.convert_exact(&mut word.value)?,
            }
        }
        if let Some(feed) = &mut cycle.feed {
            self.loose(feed)?;
        }
        match &mut cycle.kind {
            CycleKind::DrillPeck { peck, first, less, clearance, .. }
            | CycleKind::DrillBreak { peck, first, less, lift: clearance, .. } => {
                self.convert_exact(peck)?;
                first.iter_mut().chain(less).try_for_each(|first| self.convert_exact(first))?;
                match clearance {
                    Clearance::Stated(value) => self.loose(value)?,
                    Clearance::Parameter | Clearance::FromReturn => {}
                }
            }
            CycleKind::Bore { feed_out, .. } => {
                feed_out.iter_mut().try_for_each(|feed| self.loose(feed))?;
            }
            kind @ (CycleKind::Tap(_) | CycleKind::FineBore(_)) => {
                kind.each_length(|e| self.convert_exact(e))?
            }
            CycleKind::Drill | CycleKind::DrillDwell { .. } | CycleKind::BoreStop(_) => {}
        }
        Ok(())
    }

    fn pattern(&self, pattern: &mut Pattern) -> Result<(), Fault> {
        let pair = |pair: &mut [Coord; 2]| pair.iter_mut().try_for_each(|c| self.loose(&mut c.value));
        let row = |row: &mut Row| match &mut row.along {
            Along::Axis(_) | Along::Angle(_) if row.count <= 2 => self.loose(&mut row.pitch),
            Along::Axis(_) | Along::Angle(_) => self.convert_exact(&mut row.pitch),
        };
        match pattern {
            Pattern::Circle { centre, first, .. } => {
                centre.iter_mut().try_for_each(pair)?;
                match first {
                    First::At(first) => pair(first),
                    First::Polar { radius, .. } => self.loose(radius),
                }
            }
            Pattern::Line { start, offset, pitch, .. } => {
                start.iter_mut().try_for_each(pair)?;
                self.convert_exact(offset)?;
                self.convert_exact(pitch)
            }
            Pattern::Grid { start, columns, rows, .. } => {
                start.iter_mut().try_for_each(pair)?;
                row(columns)?;
                row(rows)
            }
            Pattern::List(points) => points
                .iter_mut()
                .flat_map(|p| p.axes.iter_mut().take(3).flatten())
                .try_for_each(|word| match word.distance.known().or(self.before.at.modes.distance) {
                    Some(Distance::Absolute) => self.loose(&mut word.value),
                    Some(Distance::Incremental) | None => self.convert_exact(&mut word.value),
                }),
        }
    }
}
