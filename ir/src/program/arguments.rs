//! The arguments of a statement, one by one: each expression in it, with what a computed value counts there.
//!
//! Order and number are those of the statement's own fields, the same for statements that differ in values
//! alone. Not here: what an argument is worth.

use std::convert::Infallible;

use crate::canon::Axis;
use crate::expr::num::Unit;
use crate::expr::{Expr, Target};
use crate::program::cycle::{Along, Clearance, Cycle, CycleKind, First, Pattern, Shift};
use crate::program::kinds::{modes, variables};
use crate::program::{
    Arc, ArcForm, Centre, Coord, CutterRadius, Data, Frame, FrameStep, Op, Output, Piece, Pitch, Point,
    PoleWords, Shape, Slot, ToolLength,
};

/// An argument, to be read or replaced.
pub enum Argument<'a> {
    /// A word that may be missing.
    Word(&'a mut Option<Coord>),
    /// An expression that may be missing.
    Optional(&'a mut Option<Expr>),
    /// An expression without which there is no statement.
    Value(&'a mut Expr),
}

impl<'a> Argument<'a> {
    /// The expression, if there is one.
    pub fn expr(&self) -> Option<&Expr> {
        match self {
            Argument::Word(word) => word.as_ref().map(|word| &word.value),
            Argument::Optional(value) => value.as_ref(),
            Argument::Value(value) => Some(value),
        }
    }

    /// The same, to be changed.
    pub fn expr_mut(self) -> Option<&'a mut Expr> {
        match self {
            Argument::Word(word) => word.as_mut().map(|word| &mut word.value),
            Argument::Optional(value) => value.as_mut(),
            Argument::Value(value) => Some(value),
        }
    }

    /// Puts a literal in its place.
    pub fn set(self, value: Expr) {
        match self {
            Argument::Word(word) => word.iter_mut().for_each(|word| word.value = value.clone()),
            Argument::Optional(place) => *place = Some(value),
            Argument::Value(place) => *place = value,
        }
    }
}

/// Whether an argument of a statement follows from what is given a value.
pub fn reads(op: &Op, to: &Target) -> bool {
    let mut found = false;
    each(&mut op.clone(), &mut |argument, _| {
        found |= argument.expr().is_some_and(|expr| expr.reads(to));
        Ok::<(), Infallible>(())
    })
    .unwrap_or_else(|never| match never {});
    found
}

/// Whether any argument of a statement must be computed.
pub fn computed(op: &Op) -> bool {
    // Plain moves are nearly all there is.
    if let Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Position(m) | Op::Hole(m) = op {
        return m.to.axes.iter().flatten().any(|word| matches!(word.value, Expr::Node(_)));
    }
    let mut found = false;
    each(&mut op.clone(), &mut |argument, _| {
        found |= matches!(argument.expr(), Some(Expr::Node(_)));
        Ok::<(), Infallible>(())
    })
    .unwrap_or_else(|never| match never {});
    found
}

type Seen<'f, E> = dyn FnMut(Argument, Unit) -> Result<(), E> + 'f;

/// Shows every argument of a statement, with the unit in which a number without a unit counts there. Those of
/// bodies, of calls and of assignments are not its own.
///
/// # Errors
/// The first that `seen` gives.
pub fn each<E>(op: &mut Op, seen: &mut Seen<'_, E>) -> Result<(), E> {
    match op {
        Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Position(m) | Op::Hole(m) => {
            point(&mut m.to, seen)
        }
        Op::SynchronisedFeed(m) => {
            point(&mut m.to, seen)?;
            pitch(&mut m.pitch, seen)
        }
        Op::ArcFeed(arc) => arc_feed(arc, seen),
        Op::ArcForm(arc) => arc_form(arc, seen),
        Op::SetPole(pole) => match &mut pole.at {
            PoleWords::Along(words) => optional(&mut **words, Unit::Entry, seen),
            PoleWords::Polar { radius, angle } => {
                seen(Argument::Value(radius), Unit::Entry)?;
                seen(Argument::Value(angle), Unit::Degree)
            }
        },
        Op::Polar(polar) => {
            seen(Argument::Word(&mut polar.radius), Unit::Entry)?;
            seen(Argument::Word(&mut polar.angle), Unit::Degree)?;
            each(&mut polar.op, seen)
        }
        Op::StartCycle(of) => cycle(of, seen),
        Op::Pattern(of) => pattern(of, seen),
        Op::GoToReference(reference) => point(&mut reference.via, seen),
        Op::SetFrame(frame) => frame_step(frame, seen),
        Op::SetSlot(of) => slot(of, seen),
        Op::SetPosition(axes) => along_axes(&mut **axes, seen),
        Op::SetData(data) => match &mut **data {
            Data::Offset { words, turn, .. } => {
                along_axes(&mut **words, seen)?;
                seen(Argument::Optional(turn), Unit::Degree)
            }
            Data::Measured { words, .. } => along_axes(&mut **words, seen),
            Data::Tool { value, .. } => seen(Argument::Value(value), Unit::Entry),
            Data::ToolInSpindle(tool) => seen(Argument::Value(tool), Unit::One),
            Data::Position(_) => Ok(()),
        },
        Op::StartCutterRadiusCompensation { radius, .. } => match radius {
            CutterRadius::Entry(entry) => seen(Argument::Value(entry), Unit::One),
            CutterRadius::Diameter(diameter) => seen(Argument::Value(diameter), Unit::Entry),
            CutterRadius::Tool | CutterRadius::InForce => Ok(()),
        },
        Op::SetMotionControlMode(control) => {
            seen(Argument::Optional(&mut control.within), Unit::Entry)?;
            seen(Argument::Optional(&mut control.rapids), Unit::Entry)?;
            seen(Argument::Optional(&mut control.merged), Unit::Entry)
        }
        Op::Corner { size, .. } => seen(Argument::Value(size), Unit::Entry),
        Op::Advise(advice) => seen(Argument::Optional(&mut advice.amount), Unit::Entry),
        Op::SetFeedRate(feed) => seen(Argument::Value(feed), Unit::Entry),
        Op::SetSpindleSpeed(value)
        | Op::LimitSpindleSpeed(value)
        | Op::SelectTool(value)
        | Op::UseToolLengthOffset(value)
        | Op::UseToolEdge { edge: value, .. } => seen(Argument::Value(value), Unit::One),
        Op::UseToolLength(length) => match &mut **length {
            ToolLength::Value(value) | ToolLength::Added(value) => seen(Argument::Value(value), Unit::Entry),
            ToolLength::AddedEntry(entry) => seen(Argument::Value(entry), Unit::One),
            ToolLength::Offsets { words, .. } => along_axes(&mut **words, seen),
        },
        Op::OrientSpindle(angle) => seen(Argument::Optional(angle), Unit::Degree),
        Op::Dwell(seconds) => seen(Argument::Value(seconds), Unit::Second),
        Op::MessageOf(pieces) => values(pieces, seen),
        Op::Output(output) => match &mut **output {
            Output::Line(pieces) => values(pieces, seen),
            Output::Open | Output::Close => Ok(()),
        },
        Op::Alarm(alarm) => seen(Argument::Optional(&mut alarm.number), Unit::One),
        Op::RepeatBlocks(repeat) => seen(Argument::Value(&mut repeat.times), Unit::One),
        modes!()
        | Op::Call(_)
        | Op::Return
        | Op::Control(_)
        | Op::Goto(_)
        | Op::Label(_)
        | Op::Leave
        | Op::NextTurn
        | variables!()
        | Op::Comment(_)
        | Op::Message(_)
        | Op::NoEffect(_)
        | Op::Blank
        | Op::Lines(_)
        | Op::SetOriginOffsets(_)
        | Op::ClearFrame(_)
        | Op::UseMachineCoordinates { .. }
        | Op::Probe(_)
        | Op::Detour(_)
        | Op::UseToolCentrePoint(_)
        | Op::UseOriginShift(_)
        | Op::OrientToolAxis(_)
        | Op::StopCutterRadiusCompensation
        | Op::ExactStop
        | Op::TurnRotaryAxes(_)
        | Op::SetSpindleMode(_)
        | Op::SelectToolByName(_)
        | Op::ChangeTool
        | Op::StartSpindleClockwise
        | Op::StartSpindleCounterclockwise
        | Op::StopSpindleTurning
        | Op::MachineFunction(_)
        | Op::FloodOn
        | Op::MistOn
        | Op::CoolantOff
        | Op::EndCycle
        | Op::ProgramStop
        | Op::OptionalProgramStop
        | Op::ProgramEnd
        | Op::BeginAgain => Ok(()),
    }
}

/// What the coordinates of an axis count.
pub const fn unit_of(axis: Axis) -> Unit {
    match axis {
        Axis::X | Axis::Y | Axis::Z => Unit::Entry,
        Axis::A | Axis::B | Axis::C => Unit::Degree,
    }
}

fn point<E>(to: &mut Point, seen: &mut Seen<'_, E>) -> Result<(), E> {
    to.axes.iter_mut().zip(Axis::ALL).try_for_each(|(word, axis)| seen(Argument::Word(word), unit_of(axis)))
}

fn along_axes<E>(words: &mut [Option<Expr>], seen: &mut Seen<'_, E>) -> Result<(), E> {
    words.iter_mut().zip(Axis::ALL).try_for_each(|(word, axis)| seen(Argument::Optional(word), unit_of(axis)))
}

fn optional<E>(words: &mut [Option<Expr>], unit: Unit, seen: &mut Seen<'_, E>) -> Result<(), E> {
    words.iter_mut().try_for_each(|word| seen(Argument::Optional(word), unit))
}

fn coord<E>(word: &mut Coord, seen: &mut Seen<'_, E>) -> Result<(), E> {
    seen(Argument::Value(&mut word.value), Unit::Entry)
}

fn pitch<E>(of: &mut Pitch, seen: &mut Seen<'_, E>) -> Result<(), E> {
    match of {
        Pitch::Stated(length) => seen(Argument::Value(length), Unit::Entry),
        Pitch::Feed => Ok(()),
    }
}

fn arc_feed<E>(arc: &mut Arc, seen: &mut Seen<'_, E>) -> Result<(), E> {
    point(&mut arc.to, seen)?;
    match &mut arc.centre {
        Centre::Point { words, .. } => optional(words, Unit::Entry, seen)?,
        Centre::Radius(radius) => seen(Argument::Value(radius), Unit::Entry)?,
    }
    seen(Argument::Value(&mut arc.turns.0), Unit::One)
}

fn arc_form<E>(arc: &mut ArcForm, seen: &mut Seen<'_, E>) -> Result<(), E> {
    point(&mut arc.to, seen)?;
    match &mut arc.shape {
        Shape::Angle { angle, .. } => seen(Argument::Value(angle), Unit::Degree),
        Shape::AngleAbout { angle, centre, .. } => {
            seen(Argument::Value(angle), Unit::Degree)?;
            centre.iter_mut().try_for_each(|word| seen(Argument::Word(word), Unit::Entry))
        }
        Shape::Mixed { centre, .. } => {
            centre.iter_mut().try_for_each(|word| seen(Argument::Word(word), Unit::Entry))
        }
        Shape::Through(via) => point(via, seen),
        Shape::Tangent => Ok(()),
    }
}

fn cycle<E>(of: &mut Cycle, seen: &mut Seen<'_, E>) -> Result<(), E> {
    coord(&mut of.retract, seen)?;
    coord(&mut of.depth, seen)?;
    seen(Argument::Word(&mut of.reference), Unit::Entry)?;
    seen(Argument::Word(&mut of.return_plane), Unit::Entry)?;
    seen(Argument::Optional(&mut of.feed), Unit::Entry)?;
    match &mut of.kind {
        CycleKind::Drill => Ok(()),
        CycleKind::DrillDwell { dwell } => seen(Argument::Value(dwell), Unit::Second),
        CycleKind::DrillPeck { peck, first, less, clearance, pause, settle, dwell } => {
            pecks(peck, first, less, clearance, seen)?;
            [pause, settle, dwell].into_iter().try_for_each(|t| seen(Argument::Optional(t), Unit::Second))
        }
        CycleKind::DrillBreak { peck, first, less, lift, pause, dwell, .. } => {
            pecks(peck, first, less, lift, seen)?;
            [pause, dwell].into_iter().try_for_each(|t| seen(Argument::Optional(t), Unit::Second))
        }
        CycleKind::Bore { dwell, feed_out, .. } => {
            seen(Argument::Optional(dwell), Unit::Second)?;
            seen(Argument::Optional(feed_out), Unit::Entry)
        }
        CycleKind::Tap(tap) => {
            pitch(&mut tap.pitch, seen)?;
            [&mut tap.dwell, &mut tap.back, &mut tap.settle]
                .into_iter()
                .try_for_each(|t| seen(Argument::Optional(t), Unit::Second))
        }
        CycleKind::FineBore(bore) => {
            seen(Argument::Optional(&mut bore.dwell), Unit::Second)?;
            seen(Argument::Optional(&mut bore.angle), Unit::Degree)?;
            match &mut bore.shift {
                Shift::Stated(words) => optional(words, Unit::Entry, seen),
                Shift::Parameter(amount) => seen(Argument::Value(amount), Unit::Entry),
            }
        }
        CycleKind::BoreStop(bore) => seen(Argument::Optional(&mut bore.dwell), Unit::Second),
    }
}

fn pecks<E>(
    peck: &mut Expr,
    first: &mut Option<Expr>,
    less: &mut Option<Expr>,
    clearance: &mut Clearance,
    seen: &mut Seen<'_, E>,
) -> Result<(), E> {
    seen(Argument::Value(peck), Unit::Entry)?;
    seen(Argument::Optional(first), Unit::Entry)?;
    seen(Argument::Optional(less), Unit::Entry)?;
    match clearance {
        Clearance::Stated(length) => seen(Argument::Value(length), Unit::Entry),
        Clearance::Parameter | Clearance::FromReturn => Ok(()),
    }
}

fn pattern<E>(of: &mut Pattern, seen: &mut Seen<'_, E>) -> Result<(), E> {
    let two = |words: &mut Option<[Coord; 2]>, seen: &mut Seen<'_, E>| {
        words.iter_mut().flatten().try_for_each(|word| coord(word, seen))
    };
    match of {
        Pattern::Circle { centre, first, step, .. } => {
            two(centre, seen)?;
            match first {
                First::At(at) => at.iter_mut().try_for_each(|word| coord(word, seen))?,
                First::Polar { radius, angle } => {
                    seen(Argument::Value(radius), Unit::Entry)?;
                    seen(Argument::Value(angle), Unit::Degree)?;
                }
            }
            seen(Argument::Value(step), Unit::Degree)
        }
        Pattern::Line { start, angle, offset, pitch, .. } => {
            two(start, seen)?;
            seen(Argument::Value(angle), Unit::Degree)?;
            seen(Argument::Value(offset), Unit::Entry)?;
            seen(Argument::Value(pitch), Unit::Entry)
        }
        Pattern::List(points) => points.iter_mut().try_for_each(|to| point(to, seen)),
        Pattern::Grid { start, columns, rows, .. } => {
            two(start, seen)?;
            for row in [columns, rows] {
                if let Along::Angle(angle) = &mut row.along {
                    seen(Argument::Value(angle), Unit::Degree)?;
                }
                seen(Argument::Value(&mut row.pitch), Unit::Entry)?;
            }
            Ok(())
        }
    }
}

fn frame_step<E>(frame: &mut Frame, seen: &mut Seen<'_, E>) -> Result<(), E> {
    match &mut frame.step {
        FrameStep::Translate(words) => along_axes(&mut **words, seen),
        FrameStep::Rotate { angle, .. } => seen(Argument::Value(angle), Unit::Degree),
        FrameStep::Scale(factors) => optional(&mut **factors, Unit::One, seen),
        FrameStep::Mirror(_) => Ok(()),
    }
}

fn slot<E>(of: &mut Slot, seen: &mut Seen<'_, E>) -> Result<(), E> {
    match of {
        Slot::Shift { axes, .. } => along_axes(&mut **axes, seen),
        Slot::Rotation { centre, angle, .. } => {
            optional(&mut **centre, Unit::Entry, seen)?;
            seen(Argument::Value(&mut angle.value), Unit::Degree)
        }
        Slot::Scale { centre, factors } => {
            optional(&mut **centre, Unit::Entry, seen)?;
            optional(&mut **factors, Unit::One, seen)
        }
        Slot::Mirror(words) => optional(&mut **words, Unit::Entry, seen),
        Slot::NoMirror(_) => Ok(()),
        Slot::Tilt(tilt) => {
            optional(&mut tilt.origin, Unit::Entry, seen)?;
            tilt.angles.iter_mut().try_for_each(|angle| seen(Argument::Value(angle), Unit::Degree))
        }
    }
}

fn values<E>(pieces: &mut [Piece], seen: &mut Seen<'_, E>) -> Result<(), E> {
    pieces.iter_mut().try_for_each(|piece| match piece {
        Piece::Text(_) => Ok(()),
        Piece::Value { value, .. } => seen(Argument::Value(value), Unit::One),
    })
}

/// The words that put the axes somewhere.
pub fn words_of(op: &Op) -> Option<&Point> {
    match op {
        Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Hole(m) | Op::Position(m) => Some(&m.to),
        Op::ArcFeed(arc) => Some(&arc.to),
        Op::ArcForm(arc) => Some(&arc.to),
        Op::SynchronisedFeed(m) => Some(&m.to),
        Op::GoToReference(reference) => Some(&reference.via),
        Op::Polar(polar) => words_of(&polar.op),
        _ => None,
    }
}

/// The same, to be rewritten.
pub fn words_of_mut(op: &mut Op) -> Option<&mut Point> {
    match op {
        Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Hole(m) | Op::Position(m) => Some(&mut m.to),
        Op::ArcFeed(arc) => Some(&mut arc.to),
        Op::ArcForm(arc) => Some(&mut arc.to),
        Op::SynchronisedFeed(m) => Some(&mut m.to),
        Op::GoToReference(reference) => Some(&mut reference.via),
        Op::Polar(polar) => words_of_mut(&mut polar.op),
        _ => None,
    }
}
