//! Cycles and patterns that a dialect supports.

use ncc_ir::canon::{ReturnLevel, Turn};
use ncc_ir::caps::{CircleStart, CycleCap, CycleForm, FeedsOutTo, GridWay, HoleCaps, Lift, ReturnsTo};

use crate::cycles::{CycleRow, PatternRow};
use crate::meaning::Meaning;
use crate::names::{CallKind, CallRow, ParameterRole};
use crate::schema::Dialect;

/// All cycles, said in any way.
fn every_cycle() -> Vec<CycleCap> {
    let all = [
        "drill",
        "drill-dwell",
        "drill-peck",
        "drill-break",
        "bore",
        "tap",
        "tap-rigid",
        "bore-fine",
        "bore-stop",
    ];
    let cap = |kind: &str| CycleCap {
        kind: kind.to_owned(),
        returns: vec![ReturnLevel::Initial, ReturnLevel::Retract],
        dwell: true,
        clearance: true,
        parameter: true,
        from_return: true,
        pause: None,
        strokes: true,
        shrinks: true,
        feed_out: true,
        form: CycleForm::Any,
        turns: Vec::new(),
        lift: Lift::Either,
        feeds_out_to: FeedsOutTo::Either,
    };
    all.into_iter().map(cap).collect()
}

/// The cycles of the rows, by codes and by calls.
fn cycles(dialect: &Dialect) -> Vec<CycleCap> {
    if dialect.can.everything {
        return every_cycle();
    }
    let says = |meaning| dialect.code_for(meaning).is_some();
    let returns: Vec<ReturnLevel> = match dialect.cycles.return_level {
        Some(level) => vec![level.into()],
        None => vec![ReturnLevel::Initial, ReturnLevel::Retract],
    };

    let cap = |row: &CycleRow, kind: &str| cycle_cap(row, kind, &returns);
    let called = |row: &CallRow| {
        let has = |role| row.place(role).is_some();
        let caps = row.kind.cycles().iter().map(|kind| CycleCap {
            kind: (*kind).to_owned(),
            returns: returns.clone(),
            dwell: has(ParameterRole::Dwell),
            clearance: has(ParameterRole::Clearance),
            parameter: !has(ParameterRole::Clearance),
            from_return: false,
            pause: None,
            strokes: has(ParameterRole::RelativeFirstDepth),
            shrinks: false,
            feed_out: has(ParameterRole::FeedOut),
            form: CycleForm::Stated,
            turns: vec![Turn::Clockwise, Turn::Counterclockwise],
            lift: Lift::only(has(ParameterRole::Lift)),
            feeds_out_to: FeedsOutTo::Retract,
        });
        caps.collect::<Vec<_>>()
    };
    // A code beside the cycle's makes a tap rigid.
    let rigid = says(Meaning::RigidTapping);
    let rows = dialect.cycle.iter().flat_map(|row| {
        let also = (rigid && row.kind == "tap").then_some("tap-rigid");
        std::iter::once(cap(row, &row.kind)).chain(also.map(|kind| cap(row, kind)))
    });
    rows.chain(dialect.call.iter().flat_map(called)).collect()
}

/// Cycles and patterns.
pub(super) fn holes(dialect: &Dialect) -> HoleCaps {
    let everything = dialect.can.everything;
    let calls = |kind| dialect.call_for(kind);
    let list = calls(CallKind::List).map(|row| {
        row.parameters.iter().filter(|p| p.role == Some(ParameterRole::PointFirst)).count() as u32
    });
    HoleCaps {
        cycles: cycles(dialect),
        circles: everything
            || calls(CallKind::Circle).is_some()
            || dialect.pattern.iter().any(|p| matches!(p, PatternRow::Circle { .. })),
        circle_start: if everything {
            CircleStart::Either
        } else {
            CircleStart::only(calls(CallKind::Circle).is_some())
        },
        centre_at_zero_only: dialect.can.circle_centre_at_zero_only,
        bore_needs_spindle: dialect.can.cycles_need_spindle,
        grid_upto: match calls(CallKind::Grid) {
            _ if everything => u32::MAX,
            Some(_) => u32::MAX,
            None => dialect.can.grid_upto,
        },
        grid_way: match calls(CallKind::Grid) {
            Some(_) => GridWay::Serpentine,
            None => dialect
                .pattern
                .iter()
                .find_map(|p| match p {
                    PatternRow::Grid { serpentine, .. } => Some(GridWay::only(*serpentine)),
                    PatternRow::Circle { .. } => None,
                })
                .unwrap_or_default(),
        },
        grid_square: calls(CallKind::Grid).is_some(),
        lines: everything || calls(CallKind::Line).is_some(),
        list_upto: if everything { u32::MAX } else { list.unwrap_or(0) },
        pattern_start: everything || calls(CallKind::Grid).is_some(),
        // A pattern that is called has its start among the arguments.
        pattern_here: calls(CallKind::Grid).is_none(),
        pattern_angle: everything || calls(CallKind::Grid).is_some(),
        order_by_position: dialect.call.iter().any(|row| row.order_by_position),
        incremental: everything || dialect.cycles.incremental,
        returns: if everything { ReturnsTo::Either } else { ReturnsTo::only(dialect.states_return_planes()) },
        measured_anew: dialect.cycles.measured_anew,
        level_of_block: dialect.cycles.level_of_block,
        end_motion: dialect.cycles.ends_motion,
        end_with_call: dialect.cycles.ends_with_call,
        approach: if everything { None } else { Some(dialect.cycles.approach.into()) },
    }
}

/// What a row of a cycle can say.
fn cycle_cap(row: &CycleRow, kind: &str, returns: &[ReturnLevel]) -> CycleCap {
    CycleCap {
        kind: kind.to_owned(),
        returns: returns.to_vec(),
        dwell: row.dwell.is_some(),
        clearance: false,
        parameter: !row.from_return,
        from_return: row.from_return,
        pause: row.own_pause(),
        strokes: false,
        shrinks: row.shrinking.is_some(),
        feed_out: false,
        form: CycleForm::Control(row.own()),
        turns: row.hand.map(|hand| hand.turn()).into_iter().collect(),
        lift: Lift::Rapid,
        feeds_out_to: FeedsOutTo::only(row.feed_to_level),
    }
}
