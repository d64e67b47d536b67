//! What can be said in a dialect, as its rows have it. Nothing is decided here that a row does not say.

use std::sync::Arc;

use ncc_ir::alarms::Alarms;
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::{AdviceKind, CornerShape, PathMode, ReturnLevel, RotaryWay, Side, Turn};
use ncc_ir::caps::{
    Caps, Corners, CycleCap, CycleForm, PolarForm, Radii, References, Threads, TiltForm, TipForm,
};
use ncc_ir::compensated::{Kind, Refused};
use ncc_ir::computed::computes::Computes;
use ncc_ir::expr::Function;
use ncc_ir::expr::system::System;
use ncc_ir::geometry::round::ArcRule;
use ncc_ir::program::{Detour, FrameSlot, PoleFrom, Probe, ReferencePoint};

use crate::codes::BesideCompensation;
use crate::cycles::{CycleRow, PatternRow};
use crate::formula::{Handing, Statement};
use crate::meaning::{Meaning, Thread};
use crate::names::{CallKind, CallRow, FrameWord, NameMeaning, NameRole, ParameterRole};
use crate::power_on::SafeStart;
use crate::schema::{Dialect, Family};
use crate::stored::DataKind;

/// Digits of a value in a message where nothing else is said (LinuxCNC 2.9, gcode/overview, comment parameters).
const VALUE_DIGITS: u8 = 6;

/// The capabilities that follow from a dictionary's rows.
pub(crate) fn caps(dialect: &Dialect) -> Caps {
    let says = |meaning| dialect.code_for(meaning).is_some();
    let returns: Vec<ReturnLevel> = match dialect.cycles.return_level {
        Some(level) => vec![level.into()],
        None => vec![ReturnLevel::Initial, ReturnLevel::Retract],
    };
    let everything = dialect.can.everything;
    let calls = |kind| dialect.call_for(kind);
    let names = |meaning| dialect.name_for(meaning).is_some();
    let states = dialect.states_return_planes();
    let either = |says: bool| (!everything).then_some(says);
    let in_machine = |length| {
        [false, true].into_iter().any(|rapid| {
            let meaning = Meaning::UseMachineCoordinates { length, rapid };
            says(meaning) || names(NameMeaning::Code(meaning))
        })
    };
    let goes = |point| {
        [false, true].into_iter().any(|keeps_length| says(Meaning::GoToReference { point, keeps_length }))
    };
    let is_reference = |meaning: Meaning| matches!(meaning, Meaning::GoToReference { .. });
    let list = calls(CallKind::List).map(|row| {
        row.parameters.iter().filter(|p| p.role == Some(ParameterRole::PointFirst)).count() as u32
    });
    Caps {
        cycles: if everything {
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
                lift_at_feed: None,
                to_level: None,
            };
            all.into_iter().map(cap).collect()
        } else {
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
                    lift_at_feed: Some(has(ParameterRole::Lift)),
                    to_level: Some(false),
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
        },
        circle_pattern: everything
            || calls(CallKind::Circle).is_some()
            || dialect.pattern.iter().any(|p| matches!(p, PatternRow::Circle { .. })),
        grid_pattern: match calls(CallKind::Grid) {
            _ if everything => u32::MAX,
            Some(_) => u32::MAX,
            None => dialect.can.grid_upto,
        },
        grid_serpentine: match calls(CallKind::Grid) {
            Some(_) => Some(true),
            None => dialect.pattern.iter().find_map(|p| match p {
                PatternRow::Grid { serpentine, .. } => Some(*serpentine),
                PatternRow::Circle { .. } => None,
            }),
        },
        grid_square: calls(CallKind::Grid).is_some(),
        order_by_position: dialect.call.iter().any(|row| row.order_by_position),
        line_pattern: everything || calls(CallKind::Line).is_some(),
        list_pattern: if everything { u32::MAX } else { list.unwrap_or(0) },
        circle_polar: either(calls(CallKind::Circle).is_some()),
        pattern_start: everything || calls(CallKind::Grid).is_some(),
        // A pattern that is called has its start among the arguments.
        pattern_here: calls(CallKind::Grid).is_none(),
        pattern_angle: everything || calls(CallKind::Grid).is_some(),
        frames: everything || names(NameMeaning::SetFrame(FrameWord::Translate)),
        local_shift: everything || says(Meaning::SetShift(false)),
        stated_shift: everything || says(Meaning::SetShift(true)),
        origin_shift: everything || says(Meaning::SetPosition),
        suspends_shift: everything
            || says(Meaning::UseOriginShift(false)) && says(Meaning::UseOriginShift(true)),
        rotation: everything || says(Meaning::SetRotation) && says(Meaning::ClearFrame(FrameSlot::Rotation)),
        scale: everything || says(Meaning::SetScale) && says(Meaning::ClearFrame(FrameSlot::Scale)),
        mirror: everything || says(Meaning::SetMirror) && says(Meaning::ClearMirror),
        machine_coordinates: everything || in_machine(true) || in_machine(false),
        machine_rapid: !everything
            && ![true, false].into_iter().any(|length| {
                let meaning = Meaning::UseMachineCoordinates { length, rapid: false };
                says(meaning) || names(NameMeaning::Code(meaning))
            }),
        machine_length: match (everything, in_machine(true), in_machine(false)) {
            (true, _, _) | (false, true, true) => None,
            (false, length, _) => Some(length),
        },
        probes: std::array::from_fn(|at| {
            let meaning = Meaning::StraightProbe(Probe { away: at / 2 == 1, error: at % 2 == 1 });
            everything || says(meaning) || names(NameMeaning::Code(meaning))
        }),
        detours: Detour::ALL.map(|detour| everything || says(Meaning::Detour(detour))),
        references: if everything {
            References::ALL
        } else {
            References {
                home: goes(ReferencePoint::Home),
                further: if goes(ReferencePoint::Further(0)) { 4 } else { 0 },
                fixed: 0,
                stored: u8::from(goes(ReferencePoint::Stored(1))) + u8::from(goes(ReferencePoint::Stored(2))),
            }
        },
        reference_via: everything || dialect.code.iter().any(|row| row.means.is_some_and(is_reference)),
        reference_keeps_length: (!everything).then(|| {
            let keeps = |row: &crate::codes::CodeRow| {
                matches!(row.means, Some(Meaning::GoToReference { keeps_length: true, .. }))
            };
            dialect.code.iter().any(keeps)
        }),
        offset_data: if everything { [true; 3] } else { dialect.sets_offsets() },
        offset_turns: everything || dialect.data.iter().any(|row| row.turns.is_some()),
        stored_positions: [1, 2].map(|place| everything || says(Meaning::StorePosition(place))),
        stated_lengths: [false, true].map(|added| everything || says(Meaning::UseToolLength { added })),
        tool_number: everything || says(Meaning::SetToolNumber),
        tool_data: if everything { [true; 6] } else { dialect.sets_tools() },
        tool_data_kept: everything || dialect.data.iter().any(|r| r.kind == DataKind::Tool && r.kept),
        measures_tools: if everything { [true; 2] } else { dialect.measures_tools() },
        tool_data_added: everything || dialect.data.iter().any(|r| r.kind == DataKind::Tool && r.adds),
        tool_names: everything
            || dialect.family == Family::Canon
            || dialect.address.iter().any(|row| row.role == crate::Role::Tool && row.named),
        radii: match (everything, says(Meaning::StartCutterRadiusCompensation(Side::Left))) {
            (true, _) => Radii::ALL,
            (false, false) => {
                Radii { entry: dialect.can.flat, diameter: dialect.can.flat, ..Radii::default() }
            }
            (false, true) => {
                let entry = dialect.letter_for(crate::Role::RadiusEntry).is_some();
                let by_tool = |row: &crate::codes::CodeRow| {
                    row.own_tool && matches!(row.means, Some(Meaning::StartCutterRadiusCompensation(_)))
                };
                let diameter = says(Meaning::StartCompensationByDiameter(Side::Left));
                Radii { entry, tool: dialect.code.iter().any(by_tool), in_force: !entry, diameter }
            }
        },
        tip: match () {
            () if everything => TipForm::Any,
            () if says(Meaning::UseToolCentrePoint(true)) => TipForm::WithLength,
            () if names(NameMeaning::Code(Meaning::UseToolCentrePoint(true))) => TipForm::Apart,
            () => TipForm::None,
        },
        tilt: match () {
            () if everything => TiltForm::Any,
            // What is written are turns about Z, X and Z.
            () if dialect.code_for(Meaning::SetTilt).is_some_and(|row| row.turns == "ZXZ") => TiltForm::Euler,
            () if names(NameMeaning::Code(Meaning::SetTilt)) => TiltForm::AxisByAxis,
            () => TiltForm::None,
        },
        tool_edges: either(dialect.letter_for(crate::Role::ToolEdge).is_some()),
        own_length: dialect
            .code
            .iter()
            .any(|row| row.own_tool && row.means == Some(Meaning::UseToolLengthOffset)),
        return_planes: either(states),
        arc_forms: everything || names(NameMeaning::ArcThrough),
        word_distance: everything || dialect.can.flat || dialect.block.qualifiers,
        feed_apart: everything || dialect.can.flat || dialect.code.iter().any(|row| row.feed_stays),
        feed_by_time: everything || says(Meaning::SetFeedMode(ncc_ir::canon::FeedMode::InverseTime)),
        feed_decimals: dialect.numbers(crate::Quantity::Feed).decimals,
        units_alone: dialect.can.units_alone,
        feed_again: !everything && dialect.code.iter().any(|row| row.feed_stays),
        call_digits: if says(Meaning::Call) { dialect.program.number_digits as u32 } else { 0 },
        repeat_blocks: everything || names(NameMeaning::RepeatBlocks) || dialect.repeat.letters().is_some(),
        centres_from_zero: !everything && dialect.arc.centre_absolute,
        repeat_by_numbers: !everything && dialect.repeat.letters().is_some(),
        repeat_count_known: false,
        circle_centre_at_zero_only: dialect.can.circle_centre_at_zero_only,
        incremental_cycles: everything || dialect.cycles.incremental,
        calls: everything
            || (dialect.program.subprograms
                && (says(Meaning::Call) || dialect.letter_for(crate::Role::Call).is_some())),
        repeats: everything,
        work_offsets: if everything || dialect.family == Family::Canon {
            u16::MAX
        } else {
            let last = |row: &crate::codes::CodeRow| match row.means {
                Some(Meaning::SetOriginOffsets(n)) => Some(n.saturating_add(row.count.unwrap_or(1)) - 1),
                _ => None,
            };
            dialect.code.iter().filter_map(last).max().unwrap_or(0)
        },
        work_offsets_off: everything || dialect.family == Family::Canon || says(Meaning::SetOriginOffsets(0)),
        clears_shift: everything
            || dialect.can.flat
            || dialect.power_on.no_origin_shift.as_ref().is_some_and(|f| f.always && f.value)
            || says(Meaning::ClearFrame(ncc_ir::program::FrameSlot::Shift)),
        offset_with_z: dialect.can.offset_with_z,
        length_at_once: dialect.can.length_at_once,
        starts_without_length: dialect.safe_start.contains(&SafeStart::NoLengthOffset),
        cycle_ends_motion: dialect.cycles.ends_motion,
        cycle_ends_with_call: dialect.cycles.ends_with_call,
        cycles_measured_anew: dialect.cycles.measured_anew,
        level_of_block: dialect.cycles.level_of_block,
        change_stops_spindle: dialect.behaviours().surely(Behaviour::SpindleAtChange),
        behaviours: dialect.behaviours(),
        feed_ends_with_mode: dialect.can.feed_ends_with_mode,
        compensation_again: dialect.can.compensation_again || dialect.can.everything,
        // The options decide ([`crate::Settings::caps`]).
        arcs: ArcRule::default(),
        refused_compensated: refused_compensated(dialect),
        arc_radius: everything
            || dialect.letter_for(crate::Role::Radius).is_some()
            || dialect.name_with(NameRole::Radius).is_some(),
        helix: everything || dialect.can.flat || dialect.arc.helix,
        arc_turns: everything
            || dialect.can.flat
            || dialect.arc.turns.is_some()
            || dialect.name_with(NameRole::Turns).is_some(),
        skip_levels: if everything { 10 } else { dialect.block.skip_levels },
        incremental: everything || says(Meaning::SetDistanceMode(ncc_ir::canon::Distance::Incremental)),
        inch: true,
        one_move_apart: everything || dialect.can.flat,
        flat: dialect.can.flat,
        inherits_motion: everything || dialect.can.inherits_motion,
        threads: {
            let has = |thread| says(Meaning::SynchronisedFeed(thread));
            Threads {
                plain: has(Thread::Plain),
                back: has(Thread::Back),
                turned: has(Thread::Turned(Turn::Clockwise)) && has(Thread::Turned(Turn::Counterclockwise)),
                chuck: has(Thread::Chuck),
                by_feed: dialect
                    .code_for(Meaning::SynchronisedFeed(Thread::Plain))
                    .is_some_and(|row| row.words.chars().next() == dialect.letter_for(crate::Role::Feed)),
                any: everything,
            }
        },
        path_modes: match (everything, dialect.can.flat) {
            (true, _) => u16::MAX,
            (false, true) => {
                let modes =
                    [PathMode::ExactStop, PathMode::ExactPath, PathMode::Continuous, PathMode::Tolerance];
                modes.into_iter().fold(0, |bits, mode| bits | 1 << mode as u16)
            }
            (false, false) => PathMode::ALL
                .iter()
                .filter(|(mode, _)| {
                    let within = |row: &crate::codes::CodeRow| {
                        let rounded = row.means == Some(Meaning::SetMotionControlMode(PathMode::Continuous));
                        rounded && !row.words.is_empty()
                    };
                    says(Meaning::SetMotionControlMode(*mode))
                        || *mode == PathMode::Tolerance && dialect.code.iter().any(within)
                })
                .fold(0, |bits, (mode, _)| bits | 1 << *mode as u16),
        },
        rounds_freely: dialect.can.rounds_freely,
        path_merges: everything
            || dialect.code.iter().any(|row| {
                let rounded = row.means == Some(Meaning::SetMotionControlMode(PathMode::Continuous));
                rounded && row.words.len() > 1
            }),
        path_in_rapids: everything || dialect.name_with(NameRole::RoundingInRapids).is_some(),
        frames_shut: dialect.can.frames_shut,
        only_path: dialect.can.only_path.map(Into::into),
        change_by_hand: dialect.can.change_by_hand,
        exact_stop: everything || dialect.can.flat || says(Meaning::ExactStop),
        advice: AdviceKind::ALL
            .iter()
            .flat_map(|(kind, _)| (0..kind.values().len() as u8).map(|value| (*kind, value)))
            .filter(|(kind, value)| everything || says_advice(dialect, *kind, *value))
            .collect(),
        own_stop: dialect
            .code_for(Meaning::OrientSpindle)
            .and_then(|row| row.orient.as_ref())
            .is_none_or(|words| words.wait.is_none()),
        rotary_ways: everything
            || dialect.name_for(NameMeaning::TurnRotaryAxis(RotaryWay::Shortest)).is_some(),
        line_angles: everything || dialect.name_with(NameRole::LineAngle).is_some(),
        polar: if everything {
            PolarForm::Any
        } else if says(Meaning::PolarWords(true)) && says(Meaning::PolarWords(false)) {
            PolarForm::Modal
        } else if says(Meaning::SetPole(PoleFrom::Zero)) {
            PolarForm::Pole
        } else {
            PolarForm::None
        },
        corners: if everything {
            Corners::ALL
        } else {
            let says =
                |shape, role| dialect.corner.word(shape).is_some() || dialect.name_with(role).is_some();
            Corners {
                round: says(CornerShape::Round, NameRole::RoundCorner),
                leg: says(CornerShape::Leg, NameRole::ChamferCorner),
                length: says(CornerShape::Length, NameRole::ChamferCornerByLength),
                arcs: dialect.corner.arcs,
            }
        },
        messages: everything
            || dialect.can.flat
            || !dialect.comment.message.is_empty()
            || names(NameMeaning::Message),
        stop_messages: dialect.formula.statements.contains(&Statement::Stop),
        computes: (reads_formulas(dialect) && !dialect.formula.operators.is_empty()).then(|| {
            let rules = &dialect.formula;
            Arc::new(Computes {
                statements: rules.statements.iter().map(|statement| (*statement).into()).collect(),
                operators: rules.operators.keys().map(|operator| (*operator).into()).collect(),
                functions: {
                    let by_bits = [Function::BitAnd, Function::BitOr, Function::BitXor];
                    let own = rules.functions.keys().map(|function| (*function).into());
                    let remainder = rules.remainder.iter().map(|_| Function::Remainder);
                    let given = rules.exists.iter().map(|_| Function::Given);
                    let by_bits = by_bits.into_iter().filter(|f| rules.by_bits(*f).is_some());
                    let between = rules.between.keys().map(|function| (*function).into());
                    own.chain(between).chain(remainder).chain(given).chain(by_bits).collect()
                },
                remainders: rules.remainders.into(),
                values: dialect.named_values().map(|(.., value)| value).collect(),
                local: rules.local.clone(),
                common: rules.common.clone(),
                retentive: rules.retentive.clone(),
                loops: rules.loops,
                calls: rules.calls,
                arguments: says(Meaning::CallMacro) || rules.parameters != Handing::Letters,
                handed: rules.parameters.into(),
                shares: rules.parameters == Handing::Letters,
                mark: rules.variable.as_str().into(),
                named: rules.with_names(dialect.name.iter().map(|row| row.name.as_str())),
                arguments_again: rules.arguments_again,
                exists: rules.exists.is_some(),
                equal_within: rules.tolerance(),
                whole: rules.whole,
                alarms: rules.statements.contains(&Statement::Alarm).then_some(Alarms {
                    numbers: rules.alarms,
                    signs: dialect.comment.upper_ascii.then(|| dialect.comment.signs.as_str().into()),
                    longest: (rules.alarm_text > 0).then_some(rules.alarm_text),
                }),
                values_in_full: (!dialect.comment.shown.is_empty()).then_some(VALUE_DIGITS),
                output_opened: rules.output_opened,
                planes_alarm: dialect.cycles.planes_alarm.map(i64::from),
                system: systems(dialect),
                entries: entries(dialect),
                worth: rules.not_behind.is_some(),
                named_programs: dialect.program.o_words,
                prefix: rules.prefix.as_str().into(),
                vacant: rules.vacant.is_some(),
                rounds: rules.rounds,
                increments: {
                    let lengths = dialect.numbers(crate::Quantity::Length);
                    [lengths.increment, lengths.increment_inch.unwrap_or(lengths.increment)]
                },
                // An option of the control says so ([`crate::Settings::caps`]).
                turn: false,
                blocks: rules.blocks,
                opposite: rules.not.is_some() || rules.not_behind.is_some(),
                near: rules.near,
                restates: rules.restates,
            })
        }),
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
        lift_at_feed: Some(false),
        to_level: Some(row.feed_to_level),
    }
}

/// What the codes of a dialect that its control refuses under compensation come to.
fn refused_compensated(dialect: &Dialect) -> Refused {
    let mut refused = Refused::default();
    for row in &dialect.code {
        let Some((order, meaning)) = row.refused_under_compensation.zip(row.means) else { continue };
        let kind = match meaning {
            Meaning::SetMotionControlMode(_) => Some(Kind::Path),
            Meaning::SetReturnLevel(_) => Some(Kind::ReturnLevel),
            Meaning::SetOriginOffsets(_) => Some(Kind::WorkOffset),
            Meaning::UseToolLengthOffset
            | Meaning::CancelToolLengthOffset
            | Meaning::UseToolLength { .. } => Some(Kind::Length),
            Meaning::SetShift(false) => Some(Kind::LocalShift),
            Meaning::Overrides(_) => Some(Kind::Overrides),
            Meaning::Advise(kind, _) => Kind::of_advice(kind),
            _ => None,
        };
        if let Some(kind) = kind {
            refused.add(kind, order == BesideCompensation::Before);
        }
    }
    refused
}

/// Values of the control's own that a program of the dialect can ask for.
fn systems(dialect: &Dialect) -> Vec<System> {
    dialect.system.iter().flat_map(|row| row.says().map(|(system, _)| system)).collect()
}

/// Those of them that are places of tables, each with the number by which a program has it: that of its parameter, or that
/// of the entry within a name.
fn entries(dialect: &Dialect) -> Vec<(System, i64)> {
    let own = |(system, spelt): (System, String)| {
        let number = match &system {
            System::WorkOffset { number, .. } | System::ToolTable { entry: number, .. } => i64::from(*number),
            _ => return None,
        };
        let number = if spelt.starts_with('$') { number } else { spelt.parse().ok()? };
        Some((system, number))
    };
    dialect.system.iter().flat_map(|row| row.says()).filter_map(own).collect()
}

/// Whether a code, a word or a call gives this advice.
fn says_advice(dialect: &Dialect, kind: AdviceKind, value: u8) -> bool {
    let meaning = Meaning::Advise(kind, Some(value));
    let by_word = dialect.code_for(Meaning::Advise(kind, None)).is_some();
    // A word that is called with the value.
    let called = dialect.name_for(NameMeaning::Code(Meaning::Advise(kind, None))).is_some();
    by_word
        || called
        || dialect.code_for(meaning).is_some()
        || dialect.name_for(NameMeaning::Code(meaning)).is_some()
}

/// Whether a program of this dialect can compute. What a dictionary inherits of a language that it does not read counts
/// for nothing.
fn reads_formulas(dialect: &Dialect) -> bool {
    match dialect.family {
        Family::Word => dialect.program.macro_b || dialect.program.o_words,
        Family::Sinumerik | Family::Canon | Family::Ir => true,
    }
}
