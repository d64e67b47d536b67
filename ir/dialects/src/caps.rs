//! What can be stated in a dialect, as its rows have it. Nothing is decided here that a row does not say.

mod computes;
mod holes;

use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::{AdviceKind, CornerShape, PathMode, RotaryWay, Side, Turn};
use ncc_ir::caps::{
    ArcCaps, Caps, CompensationCaps, Corners, FlowCaps, FrameCaps, LengthThere, LengthsOf, MachineCaps,
    ModeCaps, MoveCaps, PolarForm, Radii, References, Threads, TiltForm, TipForm, ToolCaps,
};
use ncc_ir::compensated::{Kind, Refused};
use ncc_ir::geometry::arc_solver::ArcRule;
use ncc_ir::program::{Detour, FrameSlot, PoleFrom, Probe, ReferencePoint};

use crate::codes::BesideCompensation;
use crate::formula::Statement;
use crate::meaning::{Meaning, Thread};
use crate::names::{FrameWord, NameMeaning, NameRole};
use crate::power_on::SafeStart;
use crate::schema::{Dialect, Family};
use crate::stored::DataKind;

pub use self::computes::ANGLE_RANGE;
pub(crate) use self::computes::TURN;
use self::computes::computes;
use self::holes::holes;

/// The capabilities that follow from a dictionary's rows.
pub(crate) fn caps(dialect: &Dialect) -> Caps {
    Caps {
        holes: holes(dialect),
        moves: moves(dialect),
        arcs: arcs(dialect),
        compensation: compensation(dialect),
        frames: frames(dialect),
        machine: machine(dialect),
        tools: tools(dialect),
        modes: modes(dialect),
        flow: flow(dialect),
        behaviours: dialect.behaviours(),
        flat: dialect.can.flat,
    }
}

/// Moves, but for arcs.
fn moves(dialect: &Dialect) -> MoveCaps {
    let everything = dialect.can.everything;
    let says = |meaning| dialect.code_for(meaning).is_some();
    let names = |meaning| dialect.name_for(meaning).is_some();
    MoveCaps {
        probes: std::array::from_fn(|at| {
            let meaning = Meaning::StraightProbe(Probe { away: at / 2 == 1, error: at % 2 == 1 });
            everything || says(meaning) || names(NameMeaning::Code(meaning))
        }),
        detours: Detour::ALL.map(|detour| everything || says(Meaning::Detour(detour))),
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
        exact_stop: everything || dialect.can.flat || says(Meaning::ExactStop),
        one_move_apart: everything || dialect.can.flat,
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
        own_stop: dialect
            .code_for(Meaning::OrientSpindle)
            .and_then(|row| row.orient.as_ref())
            .is_none_or(|words| words.wait.is_none()),
    }
}

/// Arcs.
fn arcs(dialect: &Dialect) -> ArcCaps {
    let everything = dialect.can.everything;
    let names = |meaning| dialect.name_for(meaning).is_some();
    ArcCaps {
        // The options decide ([`crate::Settings::caps`]).
        rule: ArcRule::default(),
        forms: everything || names(NameMeaning::ArcThrough),
        by_radius: everything
            || dialect.letter_for(crate::Role::Radius).is_some()
            || dialect.name_with(NameRole::Radius).is_some(),
        helix: everything || dialect.can.flat || dialect.arc.helix,
        turns: everything
            || dialect.can.flat
            || dialect.arc.turns.is_some()
            || dialect.name_with(NameRole::Turns).is_some(),
        centres_from_zero: !everything && dialect.arc.centre_absolute,
    }
}

/// Compensation for the radius of the cutter.
fn compensation(dialect: &Dialect) -> CompensationCaps {
    let everything = dialect.can.everything;
    let says = |meaning| dialect.code_for(meaning).is_some();
    CompensationCaps {
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
        again: dialect.can.compensation_again || dialect.can.everything,
        refused: refused_compensated(dialect),
    }
}

/// Zeros and frames.
fn frames(dialect: &Dialect) -> FrameCaps {
    let everything = dialect.can.everything;
    let says = |meaning| dialect.code_for(meaning).is_some();
    let names = |meaning| dialect.name_for(meaning).is_some();
    FrameCaps {
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
        offset_data: match (everything, dialect.can.flat) {
            (true, _) => [true; 3],
            // Its origin by values.
            (_, true) => [true, false, false],
            (false, false) => dialect.sets_offsets(),
        },
        offset_turns: everything || dialect.data.iter().any(|row| row.turns.is_some()),
        chain: everything || names(NameMeaning::SetFrame(FrameWord::Translate)),
        local_shift: everything || says(Meaning::SetShift(false)),
        origin_shift: everything || says(Meaning::SetPosition),
        suspends_shift: everything
            || says(Meaning::UseOriginShift(false)) && says(Meaning::UseOriginShift(true)),
        stated_shift: everything || says(Meaning::SetShift(true)),
        clears_shift: everything
            || dialect.can.flat
            || dialect.power_on.no_origin_shift.as_ref().is_some_and(|f| f.always && f.value)
            || says(Meaning::ClearFrame(ncc_ir::program::FrameSlot::Shift)),
        rotation: everything || says(Meaning::SetRotation) && says(Meaning::ClearFrame(FrameSlot::Rotation)),
        scale: everything || says(Meaning::SetScale) && says(Meaning::ClearFrame(FrameSlot::Scale)),
        mirror: everything || says(Meaning::SetMirror) && says(Meaning::ClearMirror),
        tilt: match () {
            () if everything => TiltForm::Any,
            // What is written are turns about Z, X and Z.
            () if dialect.code_for(Meaning::SetTilt).is_some_and(|row| row.turns == "ZXZ") => TiltForm::Euler,
            () if names(NameMeaning::Code(Meaning::SetTilt)) => TiltForm::AxisByAxis,
            () => TiltForm::None,
        },
        shut: dialect.can.frames_shut,
    }
}

/// Machine coordinates.
fn machine(dialect: &Dialect) -> MachineCaps {
    let everything = dialect.can.everything;
    let says = |meaning| dialect.code_for(meaning).is_some();
    let names = |meaning| dialect.name_for(meaning).is_some();
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
    let keeps = |row: &crate::codes::CodeRow| {
        matches!(row.means, Some(Meaning::GoToReference { keeps_length: true, .. }))
    };
    MachineCaps {
        coordinates: everything || in_machine(true) || in_machine(false),
        length: match (everything, in_machine(true), in_machine(false)) {
            (true, _, _) | (false, true, true) => LengthThere::Either,
            (false, stays, _) => LengthThere::only(stays),
        },
        rapid: !everything
            && ![true, false].into_iter().any(|length| {
                let meaning = Meaning::UseMachineCoordinates { length, rapid: false };
                says(meaning) || names(NameMeaning::Code(meaning))
            }),
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
        reference_length: if everything {
            LengthThere::Either
        } else {
            LengthThere::only(dialect.code.iter().any(keeps))
        },
        stored_positions: [1, 2].map(|place| everything || says(Meaning::StorePosition(place))),
    }
}

/// Tools, and their lengths.
fn tools(dialect: &Dialect) -> ToolCaps {
    let everything = dialect.can.everything;
    let says = |meaning| dialect.code_for(meaning).is_some();
    let names = |meaning| dialect.name_for(meaning).is_some();
    ToolCaps {
        names: everything
            || dialect.family == Family::Canon
            || dialect.address.iter().any(|row| row.role == crate::Role::Tool && row.named),
        number: everything || says(Meaning::SetToolNumber),
        data: if everything { [true; 6] } else { dialect.sets_tools() },
        data_added: everything || dialect.data.iter().any(|r| r.kind == DataKind::Tool && r.adds),
        data_kept: everything || dialect.data.iter().any(|r| r.kind == DataKind::Tool && r.kept),
        measured: if everything { [true; 2] } else { dialect.measures_tools() },
        lengths_of: match dialect.letter_for(crate::Role::ToolEdge) {
            _ if everything => LengthsOf::Either,
            Some(_) => LengthsOf::Edges,
            None => LengthsOf::Entries,
        },
        own_length: dialect
            .code
            .iter()
            .any(|row| row.own_tool && row.means == Some(Meaning::UseToolLengthOffset)),
        stated_lengths: [false, true]
            .map(|added| everything || dialect.can.flat && !added || says(Meaning::UseToolLength { added })),
        offset_with_z: dialect.can.offset_with_z,
        length_at_once: dialect.can.length_at_once,
        starts_without_length: dialect.safe_start.contains(&SafeStart::NoLengthOffset),
        tip: match () {
            () if everything => TipForm::Any,
            () if says(Meaning::UseToolCentrePoint(true)) => TipForm::WithLength,
            () if names(NameMeaning::Code(Meaning::UseToolCentrePoint(true))) => TipForm::Apart,
            () => TipForm::None,
        },
        change_stops_spindle: dialect.behaviours().surely(Behaviour::SpindleAtChange),
        change_by_hand: dialect.can.change_by_hand,
    }
}

/// Modes, advice and messages.
fn modes(dialect: &Dialect) -> ModeCaps {
    let everything = dialect.can.everything;
    let says = |meaning| dialect.code_for(meaning).is_some();
    let names = |meaning| dialect.name_for(meaning).is_some();
    ModeCaps {
        incremental: everything || says(Meaning::SetDistanceMode(ncc_ir::canon::Distance::Incremental)),
        word_distance: everything || dialect.can.flat || dialect.block.qualifiers,
        inch: true,
        units_alone: dialect.can.units_alone,
        feed_apart: everything || dialect.can.flat || dialect.code.iter().any(|row| row.feed_stays),
        feed_again: !everything && dialect.code.iter().any(|row| row.feed_stays),
        feed_by_time: everything || says(Meaning::SetFeedMode(ncc_ir::canon::FeedMode::InverseTime)),
        feed_decimals: dialect.numbers(crate::Quantity::Feed).decimals,
        feed_ends_with_mode: dialect.can.feed_ends_with_mode,
        path: match (everything, dialect.can.flat) {
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
        only_path: dialect.can.only_path.map(Into::into),
        rounds_freely: dialect.can.rounds_freely,
        path_in_rapids: everything || dialect.name_with(NameRole::RoundingInRapids).is_some(),
        path_merges: everything
            || dialect.code.iter().any(|row| {
                let rounded = row.means == Some(Meaning::SetMotionControlMode(PathMode::Continuous));
                rounded && row.words.len() > 1
            }),
        advice: AdviceKind::ALL
            .iter()
            .flat_map(|(kind, _)| (0..kind.values().len() as u8).map(|value| (*kind, value)))
            .filter(|(kind, value)| everything || says_advice(dialect, *kind, *value))
            .collect(),
        messages: everything
            || dialect.can.flat
            || !dialect.comment.message.is_empty()
            || names(NameMeaning::Message),
        stop_messages: dialect.formula.statements.contains(&Statement::Stop),
    }
}

/// The order of blocks.
fn flow(dialect: &Dialect) -> FlowCaps {
    let everything = dialect.can.everything;
    let says = |meaning| dialect.code_for(meaning).is_some();
    let names = |meaning| dialect.name_for(meaning).is_some();
    FlowCaps {
        calls: everything
            || (dialect.program.subprograms
                && (says(Meaning::Call) || dialect.letter_for(crate::Role::Call).is_some())),
        call_digits: if says(Meaning::Call) { dialect.program.number_digits as u32 } else { 0 },
        repeats: everything,
        repeat_blocks: everything || names(NameMeaning::RepeatBlocks) || dialect.repeat.letters().is_some(),
        repeat_by_numbers: !everything && dialect.repeat.letters().is_some(),
        repeat_count_known: false,
        inherits_motion: everything || dialect.can.inherits_motion,
        skip_levels: if everything { 10 } else { dialect.block.skip_levels },
        computes: computes(dialect),
    }
}

/// Capabilities from the codes of a dialect that its control refuses under compensation.
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
