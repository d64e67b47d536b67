//! The active feed, as far as the program says it.

use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Num;
use ncc_ir::program::cycle::CycleKind;
use ncc_ir::program::kinds::{
    conduct, drilling, flow, frames, machine, miscellaneous, moves, polar, tooling, variables,
};
use ncc_ir::program::{Op, Stmt};

/// What a statement leaves active; `None` is not known.
pub(crate) fn after(stmt: &Stmt, before: Option<Num>) -> Option<Num> {
    let now = feed_after(&stmt.op, before);
    if stmt.skip.is_some() && now != before { None } else { now }
}

fn feed_after(op: &Op, before: Option<Num>) -> Option<Num> {
    match op {
        Op::SetFeedRate(feed) => feed.literal(),
        Op::StartCycle(cycle) => match &cycle.kind {
            CycleKind::Bore { feed_out: Some(_), .. } => None,
            CycleKind::Bore { .. }
            | CycleKind::Drill
            | CycleKind::DrillDwell { .. }
            | CycleKind::DrillPeck { .. }
            | CycleKind::DrillBreak { .. }
            | CycleKind::Tap(_)
            | CycleKind::FineBore(_)
            | CycleKind::BoreStop(_) => cycle.feed.as_ref().map_or(before, Expr::literal),
        },
        Op::UseLengthUnits(_) | Op::SetFeedMode(_) | flow!() => None,
        Op::SetDistanceMode(_)
        | Op::SelectPlane(_)
        | Op::SetReturnLevel(_)
        | Op::Position(_)
        | Op::Hole(_)
        | polar!()
        | Op::Pattern(_)
        | Op::EndCycle
        | Op::ProgramEnd
        | Op::BeginAgain
        | variables!()
        | miscellaneous!()
        | conduct!()
        | tooling!()
        | frames!()
        | machine!()
        | moves!() => before,
    }
}

/// Whether the active feed counts before another is stated.
pub(crate) fn counts(rest: &[Stmt]) -> bool {
    for stmt in rest {
        match &stmt.op {
            Op::SetFeedRate(_) if stmt.skip.is_none() => return false,
            Op::ProgramEnd | Op::BeginAgain if stmt.skip.is_none() => return false,
            Op::StartCycle(cycle) if cycle.feed.is_some() && stmt.skip.is_none() => return false,
            Op::StraightFeed(_)
            | Op::SynchronisedFeed(_)
            | Op::ArcFeed(_)
            | Op::ArcForm(_)
            | Op::Position(_)
            | polar!()
            | drilling!()
            | Op::UseLengthUnits(_)
            | Op::SetFeedMode(_)
            | variables!()
            | flow!() => return true,
            Op::SetFeedRate(_)
            | Op::ProgramEnd
            | Op::BeginAgain
            | Op::SetDistanceMode(_)
            | Op::SelectPlane(_)
            | Op::SetReturnLevel(_)
            | Op::StraightTraverse(_)
            | Op::EndCycle
            | miscellaneous!()
            | conduct!()
            | tooling!()
            | frames!()
            | machine!() => {}
        }
    }
    true
}
