//! What a statement takes from the modes before it, put into the statement itself.
//!
//! ```text
//! X10. under G01 G91 in inches    G91 G01 X10in
//! ```
//!
//! Not here: which modes are active (`ncc_ir::track`, the must-analysis).

use std::sync::Arc;

use ncc_ir::canon::{Fact, Motion};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Unit;
use ncc_ir::program::cycle::{Clearance, CycleKind, First, Pattern};
use ncc_ir::program::kinds::{conduct, flow, miscellaneous, modes, tooling, variables};
use ncc_ir::program::{Centre, Coord, Data, FrameStep, Op, Pitch, Point, PoleWords, Shape, Slot, ToolLength};
use ncc_ir::track::Tracker;

/// Replaces what a statement takes from its caller by what is active.
pub(crate) fn settle(op: &mut Op, here: &Tracker) {
    if let Op::Position(m) = op {
        let m = std::mem::take(m);
        *op = match here.modes.motion {
            Some(Motion::Traverse) => Op::StraightTraverse(m),
            Some(Motion::Feed) => Op::StraightFeed(m),
            Some(Motion::Cycle) => Op::Hole(m),
            Some(Motion::Arc(_)) | None => Op::Position(m),
        };
    }
    match op {
        Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Position(m) | Op::Hole(m) => {
            settle_point(&mut m.to, here);
        }
        Op::SynchronisedFeed(m) => {
            settle_point(&mut m.to, here);
            if let Pitch::Stated(pitch) = &mut m.pitch {
                settle_expr(pitch, here);
            }
        }
        Op::ArcFeed(arc) => {
            settle_fact(&mut arc.plane, here.modes.plane);
            settle_point(&mut arc.to, here);
            match &mut arc.centre {
                Centre::Point { words, .. } => words.iter_mut().flatten().for_each(|w| settle_expr(w, here)),
                Centre::Radius(radius) => settle_expr(radius, here),
            }
        }
        Op::Polar(polar) => {
            settle_fact(&mut polar.plane, here.modes.plane);
            for word in [&mut polar.radius, &mut polar.angle].into_iter().flatten() {
                settle_coord(word, here);
            }
            settle(&mut polar.op, here);
        }
        Op::SetPole(set) => {
            settle_fact(&mut set.plane, here.modes.plane);
            match &mut set.at {
                PoleWords::Along(words) => words.iter_mut().flatten().for_each(|w| settle_expr(w, here)),
                PoleWords::Polar { radius, .. } => settle_expr(radius, here),
            }
        }
        Op::StartCycle(cycle) => {
            settle_fact(&mut cycle.plane, here.modes.plane);
            settle_fact(&mut cycle.return_level, here.modes.return_level);
            settle_coord(&mut cycle.retract, here);
            settle_coord(&mut cycle.depth, here);
            cycle.reference.iter_mut().chain(&mut cycle.return_plane).for_each(|c| settle_coord(c, here));
            cycle.feed.iter_mut().for_each(|f| settle_expr(f, here));
            settle_kind(&mut cycle.kind, here);
        }
        Op::Pattern(pattern) => settle_pattern(pattern, here),
        Op::ArcForm(arc) => {
            settle_fact(&mut arc.plane, here.modes.plane);
            settle_point(&mut arc.to, here);
            match &mut arc.shape {
                Shape::AngleAbout { centre, .. } | Shape::Mixed { centre, .. } => {
                    centre.iter_mut().flatten().for_each(|c| settle_coord(c, here));
                }
                Shape::Through(via) => settle_point(via, here),
                Shape::Angle { .. } | Shape::Tangent => {}
            }
        }
        Op::SetFrame(frame) => match &mut frame.step {
            FrameStep::Translate(words) => words.iter_mut().flatten().for_each(|w| settle_expr(w, here)),
            FrameStep::Rotate { plane, .. } => settle_fact(plane, here.modes.plane),
            FrameStep::Scale(_) | FrameStep::Mirror(_) => {}
        },
        Op::SetSlot(slot) => match &mut **slot {
            Slot::Shift { axes, .. } => axes.iter_mut().flatten().for_each(|w| settle_expr(w, here)),
            Slot::Rotation { plane, centre, angle } => {
                settle_fact(plane, here.modes.plane);
                centre.iter_mut().flatten().for_each(|w| settle_expr(w, here));
                settle_coord(angle, here);
            }
            Slot::Scale { centre: words, .. } | Slot::Mirror(words) => {
                words.iter_mut().flatten().for_each(|w| settle_expr(w, here));
            }
            Slot::Tilt(tilt) => tilt.origin.iter_mut().flatten().for_each(|w| settle_expr(w, here)),
            Slot::NoMirror(_) => {}
        },
        Op::SetPosition(axes) => axes.iter_mut().flatten().for_each(|w| settle_expr(w, here)),
        Op::SetFeedRate(feed) => settle_expr(feed, here),
        Op::Lines(lines) => Arc::make_mut(lines).settle(here.modes.units, here.modes.distance),
        Op::GoToReference(reference) => settle_point(&mut reference.via, here),
        Op::SetData(data) => match &mut **data {
            Data::Offset { words, .. } | Data::Measured { words, .. } => {
                words.iter_mut().flatten().for_each(|w| settle_expr(w, here))
            }
            Data::Tool { value, .. } => settle_expr(value, here),
            Data::Position(_) | Data::ToolInSpindle(_) => {}
        },
        Op::SetOriginOffsets(_)
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
        | modes!()
        | flow!() => {}
        tooling!() => {
            if let Op::UseToolLength(length) = op {
                match &mut **length {
                    ToolLength::Value(value) | ToolLength::Added(value) => settle_expr(value, here),
                    ToolLength::Offsets { words, .. } => {
                        words.iter_mut().flatten().for_each(|word| settle_expr(word, here));
                    }
                    ToolLength::AddedEntry(_) => {}
                }
            }
        }
        conduct!() => {
            if let Op::Corner { size, .. } = op {
                settle_expr(size, here);
            }
        }
    }
}

/// The lengths of a kind of cycle.
fn settle_kind(kind: &mut CycleKind, here: &Tracker) {
    match kind {
        CycleKind::DrillPeck { peck, first, less, clearance, .. }
        | CycleKind::DrillBreak { peck, first, less, lift: clearance, .. } => {
            settle_expr(peck, here);
            first.iter_mut().chain(less).for_each(|f| settle_expr(f, here));
            if let Clearance::Stated(clearance) = clearance {
                settle_expr(clearance, here);
            }
        }
        CycleKind::Bore { feed_out, .. } => {
            feed_out.iter_mut().for_each(|f| settle_expr(f, here));
        }
        kind @ (CycleKind::Tap(_) | CycleKind::FineBore(_)) => {
            let settled: Result<(), std::convert::Infallible> = kind.each_length(|e| {
                settle_expr(e, here);
                Ok(())
            });
            settled.unwrap_or_else(|never| match never {});
        }
        CycleKind::Drill | CycleKind::DrillDwell { .. } | CycleKind::BoreStop(_) => {}
    }
}

/// The words of a pattern of holes.
fn settle_pattern(pattern: &mut Pattern, here: &Tracker) {
    match pattern {
        Pattern::Circle { centre, first, .. } => {
            centre.iter_mut().flatten().for_each(|c| settle_coord(c, here));
            match first {
                First::At(first) => first.iter_mut().for_each(|c| settle_coord(c, here)),
                First::Polar { radius, .. } => settle_expr(radius, here),
            }
        }
        Pattern::Line { start, offset, pitch, .. } => {
            start.iter_mut().flatten().for_each(|c| settle_coord(c, here));
            settle_expr(offset, here);
            settle_expr(pitch, here);
        }
        Pattern::List(points) => points.iter_mut().for_each(|p| settle_point(p, here)),
        Pattern::Grid { start, columns, rows, .. } => {
            start.iter_mut().flatten().for_each(|c| settle_coord(c, here));
            settle_expr(&mut columns.pitch, here);
            settle_expr(&mut rows.pitch, here);
        }
    }
}

fn settle_fact<T: Copy>(fact: &mut Fact<T>, in_force: Option<T>) {
    if let (Fact::Entry, Some(value)) = (&fact, in_force) {
        *fact = Fact::Known(value);
    }
}

pub(crate) fn settle_point(to: &mut Point, here: &Tracker) {
    to.axes.iter_mut().flatten().for_each(|c| settle_coord(c, here));
}

fn settle_coord(coord: &mut Coord, here: &Tracker) {
    settle_fact(&mut coord.distance, here.modes.distance);
    settle_expr(&mut coord.value, here);
}

fn settle_expr(value: &mut Expr, here: &Tracker) {
    match value {
        Expr::Num(n) if n.unit == Unit::Entry => match here.modes.units {
            Some(ncc_ir::canon::Units::Mm) => n.unit = Unit::Mm,
            Some(ncc_ir::canon::Units::Inch) => n.unit = Unit::Inch,
            None => {}
        },
        Expr::Num(_) => {}
        Expr::Node(_) => value.parts_mut().for_each(|part| settle_expr(part, here)),
    }
}
