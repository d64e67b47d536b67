//! G and M codes, the canned cycles and patterns that they call up, and their letters.

use ncc_dialects::{
    CodeRow, CycleRow, DataKind, DataRow, Dialect, Family, Hand, Meaning, NameMeaning, PatternRow, Quantity,
    Thread, ValueName, ValueWord,
};
use ncc_ir::canon::{AdviceKind, Distance, FeedMode, PathMode, Plane, ReturnLevel, SpindleMode, Turn, Units};
use ncc_ir::program::cycle::Approach;
use ncc_ir::program::{CentreFrom, PoleFrom};

use super::proof::{Bench, Said, Tried, in_place, refusal};
use super::words::{pecks_text, with_procedure};
use super::{Row, local_call};

/// A polar point about program zero.
const POLAR: &str = "SET_POLE(XY, zero) & POLAR(XY, radius 12.5mm, angle 30.25deg) said STRAIGHT_FEED()";

/// The rows of the codes.
pub fn rows(bench: &Bench, rows: &mut Vec<Row>) {
    let d = bench.dialect;
    for row in &d.code {
        if let Some(name) = &row.refuse {
            let texts = [(row.code.clone(), ""), (format!("{} X1. Y1. Z1.", row.code), "")];
            rows.push(refusal(bench, "code", &row.code, &texts, name, row.sure));
            continue;
        }
        let Some(meaning) = row.means else { continue };
        match meaning {
            Meaning::StartCycle => {}
            Meaning::SetCentreMode(from) => centre(bench, row, from, rows),
            Meaning::Pattern => {}
            Meaning::Dwell => dwells(bench, row, rows),
            Meaning::SetData => {
                let first = d.tables_of(&row.code).next().map(stored_by).unwrap_or_default();
                let said = Said::new(first.first().map_or("", String::as_str));
                rows.push(must_show(bench.both_ways(&said), &row.code).row("code", &row.code, row.sure));
            }
            Meaning::SetOriginOffsets(first) if row.count.is_some() => counted(bench, row, first, rows),
            Meaning::SetSpindleMode(mode) if row.feed_mode.is_some() => {
                rows.push(speed_and_feed(bench, row, mode).row("code", row.code.clone(), row.sure));
            }
            Meaning::Overrides(_) => {
                for said in said(d, meaning, &row.code) {
                    rows.push(overrides(bench, row, &said).row("code", row.code.clone(), row.sure));
                }
            }
            _ => {
                for said in said(d, meaning, &row.code) {
                    rows.push(code(bench, row, meaning, &said).row("code", row.code.clone(), row.sure));
                }
            }
        }
    }
    for row in &d.cycle {
        cycle(bench, row, rows);
    }
    for row in &d.pattern {
        pattern(bench, row, rows);
    }
    for row in &d.data {
        stored(bench, row, rows);
    }
}

/// Work offsets of which a word of the block says one: the first and the last of them. One that has a code
/// of its own is not written so.
fn counted(bench: &Bench, row: &CodeRow, first: u16, rows: &mut Vec<Row>) {
    let d = bench.dialect;
    for number in [first, first + row.count.unwrap_or(1) - 1] {
        let own = d.code_for(Meaning::SetOriginOffsets(number)).is_some_and(|code| code.code != row.code);
        let said = Said::new(format!("SET_ORIGIN_OFFSETS({number})"));
        let letter = row.words.chars().next().unwrap_or(' ');
        let name = format!("{} {letter}{}", row.code, number - first + 1);
        if !own {
            let tried = must_show(bench.both_ways(&said), &row.code);
            rows.push(tried.row("code", name, row.sure));
        }
    }
}

/// Statements that put values into the last entry of a table.
fn stored_by(row: &DataRow) -> Vec<String> {
    let added: &[&str] = if row.adds { &["", "added "] } else { &[""] };
    match row.kind {
        DataKind::Offset | DataKind::OffsetHere => {
            let last = row.first + row.count - 1;
            let here = if row.kind == DataKind::OffsetHere { "here, " } else { "" };
            let mode = |added: &&str| if added.is_empty() { here } else { "added, " };
            let words = "X 12.345mm, Y -6.7mm";
            added.iter().map(|a| format!("SET_OFFSET_DATA({last}, {}{words})", mode(a))).collect()
        }
        DataKind::ToolHere => {
            let offset =
                if row.in_offset == 0 { String::new() } else { format!("offset {}, ", row.in_offset) };
            vec![format!("MEASURE_TOOL({}, {offset}X 12.345mm, Z -6.7mm)", row.count)]
        }
        DataKind::Tool => {
            let name = |of| match of {
                ValueName::Length => "length",
                ValueName::LengthWear => "length-wear",
                ValueName::Radius => "tool-radius",
                ValueName::RadiusWear => "tool-radius-wear",
                ValueName::OffsetX => "x-offset",
                ValueName::OffsetY => "y-offset",
            };
            let each = |v: &ValueWord| {
                let of = name(v.of);
                let radius = matches!(v.of, ValueName::Radius | ValueName::RadiusWear);
                let kept = if row.kept && !radius { "kept " } else { "" };
                added.iter().map(move |a| format!("SET_TOOL_DATA({}, {of}, {a}{kept}6.15mm)", row.count))
            };
            row.values.iter().flat_map(each).collect()
        }
    }
}

/// A table that values are put into.
fn stored(bench: &Bench, row: &DataRow, rows: &mut Vec<Row>) {
    let select = match row.is_variable() {
        true => row.name.split('[').next().unwrap_or_default(),
        false => row.name.split(' ').nth(1).unwrap_or_default(),
    };
    for say in stored_by(row) {
        let tried = must_show(bench.both_ways(&Said::new(say)), select);
        let code = bench.dialect.code.iter().any(|code| row.name.starts_with(&code.code) && code.sure);
        let sure = code || row.is_variable();
        rows.push(tried.row("data", row.name.clone(), sure));
    }
}

/// A code by the statement that it is written for; read only, if another word is written.
fn code(bench: &Bench, row: &CodeRow, meaning: Meaning, said: &Said) -> Tried {
    let d = bench.dialect;
    let named = d.name_for(NameMeaning::Code(meaning)).map(|n| n.name.as_str());
    let written = match meaning {
        // Each has a name of its own.
        Meaning::NoEffect => Some(row.code.as_str()),
        _ => d.code_for(meaning).map(|first| first.code.as_str()).or(named),
    };
    match written {
        Some(code) if code == row.code => must_show(bench.both_ways(said), &row.code),
        Some(other) if meaning == Meaning::Call && !row.blocks.is_empty() => {
            must_show(local_call::read(bench, said, other, &row.code), &row.code).read_only()
        }
        Some(other) => {
            let put = |text: String| in_place(&text, other, &row.code).unwrap_or(text);
            must_show(bench.reads(said, &said.say, put), &row.code).read_only()
        }
        None if meaning == Meaning::SetSpindleMode(SpindleMode::Turns) => {
            // Where there is no other way, nothing needs to be written.
            let (speed, code) = ("SET_SPINDLE_SPEED(1234)", &row.code);
            let put = |text: String| text.replace("S1234", &format!("{code} S1234"));
            let meant = format!("SET_SPINDLE_MODE(\"turns\") & {speed}");
            must_show(bench.reads(&Said::new(speed), &meant, put), code).read_only()
        }
        None => Tried::failure("no row is written for this meaning: none has `write`"),
    }
}

/// A code that says what a speed counts, and what a feed counts.
fn speed_and_feed(bench: &Bench, row: &CodeRow, mode: SpindleMode) -> Tried {
    let feed = row.feed_mode.map(FeedMode::from).map_or("", feed_mode);
    let (mode, speed) = match mode {
        SpindleMode::Turns => ("turns", ""),
        SpindleMode::Surface => ("surface", " & SET_SPINDLE_SPEED(180)"),
    };
    let said = Said::new(format!("SET_FEED_MODE({feed}) & SET_SPINDLE_MODE(\"{mode}\"){speed}"));
    must_show(bench.both_ways(&said), &row.code)
}

fn feed_mode(mode: FeedMode) -> &'static str {
    match mode {
        FeedMode::PerMinute => "per-minute",
        FeedMode::PerRevolution => "per-revolution",
        FeedMode::InverseTime => "inverse-time",
    }
}

/// A code that says at once what is written by two.
fn overrides(bench: &Bench, row: &CodeRow, said: &Said) -> Tried {
    let own = |kind| bench.dialect.code_for(Meaning::Advise(kind, None)).map(|code| code.code.clone());
    let both = own(AdviceKind::FeedOverride).zip(own(AdviceKind::SpeedOverride));
    let Some((feed, speed)) = both else {
        return Tried::failure("feed and speed have no words of their own");
    };
    let change = |text: String| {
        let one = |line: &str| match line {
            line if line.starts_with(&feed) => Some(row.code.clone()),
            line if line.starts_with(&speed) => None,
            line => Some(line.to_owned()),
        };
        text.lines().filter_map(one).map(|line| line + "\n").collect()
    };
    must_show(bench.reads(said, &said.say, change), &row.code).read_only()
}

/// The row's word must stand in what was written, else nothing was shown of it.
pub fn must_show(mut tried: Tried, word: &str) -> Tried {
    let shown = tried.written.iter().any(|line| in_place(line, word, "").is_some());
    if tried.failed.is_none() && !shown {
        tried.failed = Some(format!("{word} is not written: another word is taken"));
    }
    tried
}

/// Statements of a meaning.
pub fn said(d: &Dialect, meaning: Meaning, name: &str) -> Vec<Said> {
    let one = |text: &str| vec![Said::new(text)];
    match meaning {
        Meaning::StraightTraverse => one("said STRAIGHT_TRAVERSE(X 12.345mm, Y -6.7mm)"),
        Meaning::StraightFeed => one("said STRAIGHT_FEED(X 12.345mm, Y -6.7mm)"),
        Meaning::ArcFeed(turn) => {
            let turn = match turn {
                Turn::Clockwise => "clockwise",
                Turn::Counterclockwise => "counterclockwise",
            };
            ["XY", "ZX", "YZ"].map(|plane| arc(d, plane, turn)).into()
        }
        Meaning::SynchronisedFeed(thread) => {
            const TURNS: &str = "SET_SPINDLE_SPEED(500)\nSTART_SPINDLE_CLOCKWISE()\nSET_FEED_RATE(625mm)";
            const HELD: &str = "SET_SPINDLE_SPEED(500)\nORIENT_SPINDLE(0deg)";
            const IN: &str = "SYNCHRONISED_FEED(Z -20mm, pitch 1.25mm, clockwise)";
            const OUT: &str = "SYNCHRONISED_FEED(Z 2mm, pitch 1.25mm, counterclockwise)";
            match thread {
                Thread::Plain => vec![Said::new("SYNCHRONISED_FEED(Z -20mm, pitch 1.25mm)").after(TURNS)],
                Thread::Back => {
                    vec![Said::new("SYNCHRONISED_FEED(Z -20mm, pitch 1.25mm, back)").after(TURNS)]
                }
                Thread::Turned(Turn::Clockwise) => vec![Said::new(IN).after(HELD)],
                Thread::Turned(Turn::Counterclockwise) => {
                    vec![Said::new(OUT).after(format!("{HELD}\n{IN}"))]
                }
                Thread::Chuck => {
                    vec![Said::new("SYNCHRONISED_FEED(Z -20mm, pitch feed, chuck)").after(TURNS)]
                }
            }
        }
        Meaning::UseLengthUnits(units) => vec![match units {
            Units::Mm => Said::new("USE_LENGTH_UNITS(mm)")
                .after("USE_LENGTH_UNITS(inch)\nsaid STRAIGHT_TRAVERSE(X 2in, Y 2in)"),
            Units::Inch => Said::new("USE_LENGTH_UNITS(inch)"),
        }],
        Meaning::SetDistanceMode(distance) => vec![match distance {
            Distance::Absolute => Said::new("SET_DISTANCE_MODE(absolute)\nsaid STRAIGHT_TRAVERSE(X 1mm)")
                .after("SET_DISTANCE_MODE(incremental)\nsaid STRAIGHT_TRAVERSE(X inc 2mm)"),
            Distance::Incremental => {
                Said::new("SET_DISTANCE_MODE(incremental)\nsaid STRAIGHT_TRAVERSE(X inc 2mm)")
            }
        }],
        Meaning::SelectPlane(plane) => vec![match plane {
            Plane::Xy => {
                Said::new("SELECT_PLANE(XY)").after("SELECT_PLANE(ZX)\nsaid STRAIGHT_TRAVERSE(X 1mm)")
            }
            Plane::Zx => Said::new("SELECT_PLANE(ZX)"),
            Plane::Yz => Said::new("SELECT_PLANE(YZ)"),
        }],
        Meaning::SetFeedMode(mode) => one(&format!("SET_FEED_MODE({})", feed_mode(mode))),
        Meaning::SetReturnLevel(level) => one(match level {
            ReturnLevel::Initial => "SET_RETURN_LEVEL(initial)",
            ReturnLevel::Retract => "SET_RETURN_LEVEL(retract)",
        }),
        Meaning::SetCentreMode(_) => Vec::new(),
        Meaning::SetOriginOffsets(n) => one(&format!("SET_ORIGIN_OFFSETS({n})")),
        Meaning::ClearFrame(slot) => one(&format!("CLEAR_FRAME({})", format!("{slot:?}").to_lowercase())),
        Meaning::SetShift(origin) => {
            let slot = if origin { "shift" } else { "local" };
            one(&format!("SET_SHIFT({slot}, X 12.345mm, Y -6.7mm)"))
        }
        Meaning::SetPole(PoleFrom::Zero) => one("SET_POLE(XY, zero, X 12.345mm, Y -6.7mm)"),
        Meaning::SetPole(PoleFrom::Here) => one("SET_POLE(XY, here, X 12.345mm, Y -6.7mm)"),
        Meaning::SetPole(PoleFrom::Pole) => vec![
            Said::new("SET_POLE(XY, pole, X 12.345mm, Y -6.7mm)"),
            Said::new("SET_POLE(XY, pole, radius 12.345mm, angle 30.5deg)"),
        ],
        Meaning::PolarWords(true) => vec![Said::new(POLAR)],
        Meaning::PolarWords(false) => {
            vec![Said::new("said STRAIGHT_FEED(X 12.345mm, Y -6.7mm)").after(POLAR)]
        }
        Meaning::SetPosition => {
            let limits = d.code.iter().any(|row| row.code == name && row.limits_speed);
            let place = Some(Said::new("SET_POSITION(X 12.345mm, Y -6.7mm)"));
            place.into_iter().chain(limits.then(|| Said::new("LIMIT_SPINDLE_SPEED(2500)"))).collect()
        }
        Meaning::SetSpindleMode(SpindleMode::Surface) => {
            const SURFACE: &str = "SET_SPINDLE_MODE(\"surface\") & SET_SPINDLE_SPEED(180)";
            let limits = d.code.iter().any(|row| row.code == name && row.limit.is_some());
            let limited = || Said::new(format!("LIMIT_SPINDLE_SPEED(2500) & {SURFACE}"));
            std::iter::once(Said::new(SURFACE)).chain(limits.then(limited)).collect()
        }
        Meaning::SetRotation => ["XY", "ZX", "YZ"]
            .map(|plane| {
                let words = match plane {
                    "XY" => "X 12.345mm, Y -6.7mm",
                    "ZX" => "X 12.345mm, Z -6.7mm",
                    _ => "Y 12.345mm, Z -6.7mm",
                };
                Said::new(format!("SELECT_PLANE({plane})\nSET_ROTATION({plane}, {words}, angle 30.5deg)"))
            })
            .into(),
        Meaning::SetScale => vec![
            Said::new("SET_SCALE(centre(X 1mm, Y 2mm, Z 3mm), X 1.5, Y 1.5, Z 1.5)"),
            Said::new("SET_SCALE(centre(X 1mm, Y 2mm, Z 3mm), X 2, Y 1.5, Z 1)"),
        ],
        Meaning::SetTilt => {
            let plane = match d.caps.tilt {
                ncc_ir::caps::TiltForm::AxisByAxis => {
                    "X 10mm, Y -6.7mm, Z 3mm, about Z 30deg Y -12.5deg X 0deg"
                }
                _ => "X 10mm, Y -6.7mm, Z 3mm, about Z 30deg X -12.5deg Z 90deg",
            };
            vec![Said::new(format!("SET_TILT({plane})\nsaid STRAIGHT_TRAVERSE(X 1mm, Y 2mm, Z 3mm)"))]
        }
        Meaning::OrientToolAxis => {
            let plane = "SET_TILT(X 10mm, Y -6.7mm, Z 3mm, about Z 30deg X -12.5deg Z 90deg)";
            vec![Said::new("ORIENT_TOOL_AXIS()").after(plane)]
        }
        Meaning::UseToolCentrePoint(true) => match d.caps.tip {
            ncc_ir::caps::TipForm::WithLength => {
                one("USE_TOOL_CENTRE_POINT(on) & USE_TOOL_LENGTH_OFFSET(7) & said STRAIGHT_TRAVERSE(Z 30mm)")
            }
            _ => one("USE_TOOL_CENTRE_POINT(on)"),
        },
        Meaning::UseOriginShift(false) => one("USE_ORIGIN_SHIFT(off)"),
        Meaning::UseOriginShift(true) => {
            vec![Said::new("USE_ORIGIN_SHIFT(on)").after("SET_POSITION(X 1mm)\nUSE_ORIGIN_SHIFT(off)")]
        }
        Meaning::UseToolCentrePoint(false) => one("USE_TOOL_CENTRE_POINT(off)"),
        Meaning::SetMirror => one("SET_MIRROR(X 12.5mm)"),
        Meaning::ClearMirror => vec![Said::new("CLEAR_MIRROR(X)").after("SET_MIRROR(X 12.5mm)")],
        Meaning::UseMachineCoordinates { length: true, .. } => {
            one("USE_MACHINE_COORDINATES() & said STRAIGHT_TRAVERSE(Z 0mm)")
        }
        Meaning::UseMachineCoordinates { length: false, .. } => {
            one("USE_MACHINE_COORDINATES(no-length) & said STRAIGHT_TRAVERSE(Z 0mm)")
        }
        Meaning::StraightProbe(probe) => {
            let sought = if probe.away { "no-contact" } else { "contact" };
            let error = if probe.error { ", or-error" } else { "" };
            one(&format!("PROBE({sought}{error}) & said STRAIGHT_FEED(X 12.345mm, Z -6.7mm)"))
        }
        Meaning::Detour(detour) => {
            let said = format!("DETOUR({}) & said STRAIGHT_TRAVERSE(X 12.345mm, Y -6.7mm)", detour.name());
            vec![Said::new(said).after("GO_TO_REFERENCE(home, X, Y, via(X 1mm, Y 2mm))")]
        }
        Meaning::GoToReference { point, keeps_length } => {
            let keeps = if keeps_length { ", keeps-length" } else { "" };
            let points = match point {
                ncc_ir::program::ReferencePoint::Home => vec!["home".to_owned()],
                ncc_ir::program::ReferencePoint::Further(_) => {
                    (2..=4).map(|n| format!("further {n}")).collect()
                }
                ncc_ir::program::ReferencePoint::Fixed(n) => vec![format!("fixed {n}")],
                ncc_ir::program::ReferencePoint::Stored(n) => vec![format!("stored {n}")],
            };
            let said = |point: &String| Said::new(format!("GO_TO_REFERENCE({point}, Z{keeps})"));
            points.iter().map(said).collect()
        }
        Meaning::SetData => Vec::new(),
        Meaning::StorePosition(place) => vec![Said::new(format!("STORE_POSITION({place})"))],
        Meaning::SetToolNumber => vec![Said::new("SET_TOOL_NUMBER(7)")],
        Meaning::StartCutterRadiusCompensation(side) => {
            let radii = &d.caps.radii;
            let ways = [("7", radii.entry), ("tool", radii.tool), ("in-force", radii.in_force)];
            let ways = ways.into_iter().filter(|(_, can)| *can);
            ways.map(|(radius, _)| {
                let start = format!("START_CUTTER_RADIUS_COMPENSATION({}, {radius})", side.name());
                Said::new(format!("{start} & said STRAIGHT_TRAVERSE(X 10mm)"))
            })
            .collect()
        }
        Meaning::StartCompensationByDiameter(side) => {
            let start = format!("START_CUTTER_RADIUS_COMPENSATION({}, diameter 12.5mm)", side.name());
            vec![Said::new(format!("{start} & said STRAIGHT_TRAVERSE(X 10mm)"))]
        }
        Meaning::StopCutterRadiusCompensation => one("STOP_CUTTER_RADIUS_COMPENSATION()"),
        Meaning::UseToolLength { added: false } => {
            one("USE_TOOL_LENGTH(82.5mm) & said STRAIGHT_TRAVERSE(Z 30mm)")
        }
        Meaning::UseToolLength { added: true } => {
            one("ADD_TOOL_LENGTH_OFFSET(7) & said STRAIGHT_TRAVERSE(Z 30mm)")
        }
        Meaning::UseToolLengthOffset => one("USE_TOOL_LENGTH_OFFSET(7) & said STRAIGHT_TRAVERSE(Z 30mm)"),
        Meaning::CancelToolLengthOffset => one("USE_TOOL_LENGTH_OFFSET(0)"),
        Meaning::EndCycle => match d.cycle.iter().find(|row| writes(d, row)) {
            Some(row) => {
                let start = cycle_text(d, row, &Values::default());
                vec![Said::new("END_CYCLE()").after(format!("{start}\nHOLE(X 10mm, Y 20mm)"))]
            }
            None => one("END_CYCLE()"),
        },
        Meaning::SetMotionControlMode(PathMode::Distance) => {
            one("SET_MOTION_CONTROL_MODE(\"distance\", 0.5mm)")
        }
        Meaning::SetMotionControlMode(PathMode::Tolerance) => {
            one("SET_MOTION_CONTROL_MODE(\"tolerance\", 0.05mm)")
        }
        Meaning::ExactStop => one("EXACT_STOP() & said STRAIGHT_TRAVERSE(X 12.345mm, Y -6.7mm)"),
        Meaning::Advise(kind, value) => {
            let all = 0..kind.values().len() as u8;
            let values = value.map_or(all.collect(), |value| vec![value]);
            let say = |value: u8| {
                let amount = if kind.has_amount() && value > 0 { ", 0.05mm" } else { "" };
                let name = kind.values()[usize::from(value)];
                Said::new(format!("ADVISE(\"{}\", \"{name}\"{amount})", kind.name()))
            };
            values.into_iter().map(say).collect()
        }
        Meaning::Overrides(on) => {
            let value = if on { "on" } else { "off" };
            one(&format!("ADVISE(\"feed-override\", \"{value}\") & ADVISE(\"speed-override\", \"{value}\")"))
        }
        Meaning::NoEffect => one(&format!("NO_EFFECT(\"{name}\")")),
        Meaning::ChangeTool => one(match d.caps.tool_edges {
            Some(true) => "SELECT_TOOL(5) & CHANGE_TOOL() & USE_TOOL_EDGE(1)",
            Some(false) | None => "SELECT_TOOL(5) & CHANGE_TOOL()",
        }),
        Meaning::Call => {
            let digits = u32::try_from(d.program.number_digits.clamp(1, 8)).unwrap_or(4);
            let highest = 10u32.pow(digits) - 1;
            let calls = [
                (7, "CALL(7)".to_owned()),
                (7, "CALL(7, times 3)".to_owned()),
                (highest, format!("CALL({highest})")),
            ];
            calls.map(|(number, say)| with_procedure(number, Said::new(say))).into()
        }
        // Its arguments are variables, which no text that is written has.
        Meaning::CallMacro
        | Meaning::CallMacroAtMoves
        | Meaning::CallMacroAtBlocks
        | Meaning::EndCallsAtMoves => Vec::new(),
        // The subprogram's own end is compared with it.
        Meaning::Return => vec![with_procedure(7, Said::new("CALL(7)"))],
        Meaning::RigidTapping => {
            let hole = "START_CYCLE(tap-rigid(clockwise, pitch feed, after stopped), XY, retract 3mm, depth -12mm, return initial, plane-first, feed 120mm)\nHOLE(X 10mm)";
            vec![Said { after: "END_CYCLE()".to_owned(), ..Said::new(hole) }]
        }
        Meaning::LeftOut | Meaning::Dwell | Meaning::StartCycle | Meaning::Pattern => Vec::new(),
        Meaning::OrientSpindle => {
            let row = d.code.iter().find(|row| row.code == name);
            let words = row.and_then(|row| row.orient.as_ref()).filter(|words| words.option.is_none());
            let own = words.is_none_or(|words| words.wait.is_none()).then(|| Said::new("ORIENT_SPINDLE()"));
            own.into_iter().chain(words.map(|_| Said::new("ORIENT_SPINDLE(45deg)"))).collect()
        }
        // Spindle, coolant, stops: what is said by its name alone.
        function => {
            let text = function.to_string();
            vec![Said::new(match text.split_once(' ') {
                None => format!("{text}()"),
                Some((name, of)) => format!("{name}(\"{of}\")"),
            })]
        }
    }
}

/// A quarter of a circle with both words of its centre, in a plane.
pub fn arc(d: &Dialect, plane: &str, turn: &str) -> Said {
    // From (3, 4) about (9, 12) to (19, 12), radius 10.
    let (first, second, words) = match plane {
        "XY" => ('X', 'Y', ('I', 'J')),
        "ZX" => ('Z', 'X', ('K', 'I')),
        _ => ('Y', 'Z', ('J', 'K')),
    };
    let (from, centre) = match d.arc.centre_absolute {
        true => ("zero", (9, 12)),
        false => ("start", (6, 8)),
    };
    let mut ends = [(first, 19), (second, 12)];
    let mut centres = [(words.0, centre.0), (words.1, centre.1)];
    ends.sort_unstable();
    centres.sort_unstable();
    let say = format!(
        "said ARC_FEED({plane}, {turn}, {} {}mm, {} {}mm, centre({from}, {} {}mm, {} {}mm))",
        ends[0].0, ends[0].1, ends[1].0, ends[1].1, centres[0].0, centres[0].1, centres[1].0, centres[1].1
    );
    let place = format!("said STRAIGHT_TRAVERSE({first} 3mm, {second} 4mm)");
    // A length offset may have to be taken up again along the axis that moves.
    let place = if plane == "XY" { place } else { format!("SELECT_PLANE({plane})\n{place}") };
    Said::new(say).after(place)
}

/// From where a centre is measured: shown by an arc, which is read only.
fn centre(bench: &Bench, row: &CodeRow, from: CentreFrom, rows: &mut Vec<Row>) {
    let said = arc(bench.dialect, "XY", "clockwise");
    // The writer's own words, from the start point, and what they would be from program zero.
    let (meant, i, j) = match from {
        CentreFrom::Start => (said.say.clone(), "I6", "J8"),
        CentreFrom::Zero => (said.say.replace("start, I 6mm, J 8mm", "zero, I 9mm, J 12mm"), "I9", "J12"),
    };
    let put = |text: String| text.replace("I6", &format!("{} {i}", row.code)).replace("J8", j);
    let tried = must_show(bench.reads(&said, &meant, put), &row.code);
    rows.push(tried.read_only().row("code", row.code.clone(), row.sure));
}

fn dwells(bench: &Bench, row: &CodeRow, rows: &mut Vec<Row>) {
    let said = Said::new("DWELL(1.5s)");
    for (at, word) in row.dwell.iter().enumerate() {
        let name = format!("{} {}", row.code, word.letter);
        if at == 0 {
            rows.push(code(bench, row, Meaning::Dwell, &said).row("code", name, row.sure));
            continue;
        }
        let first = row.dwell[0].letter;
        // One and a half seconds in the word's own form.
        let value = if word.quantity == Quantity::Milliseconds { "1500" } else { "1.5" };
        let put = |text: String| {
            let code_at = text.find(&row.code).unwrap_or(0);
            let (head, rest) = text.split_at(code_at);
            let at = rest.find(first).unwrap_or(0);
            let end =
                at + 1 + rest[at + 1..].bytes().take_while(|b| b.is_ascii_digit() || *b == b'.').count();
            format!("{head}{}{}{value}{}", &rest[..at], word.letter, &rest[end..])
        };
        rows.push(bench.reads(&said, &said.say, put).read_only().row("code", name, row.sure));
    }
    if row.dwell.is_empty() {
        rows.push(Tried::failure("a dwell needs a word: `dwell`").row("code", row.code.clone(), row.sure));
    }
}

/// Values of a cycle's words, in mm and seconds.
#[derive(Clone, Debug)]
pub(super) struct Values {
    retract: &'static str,
    depth: &'static str,
    dwell: &'static str,
    pub(super) peck: &'static str,
}

impl Default for Values {
    fn default() -> Values {
        Values { retract: "3", depth: "-12", dwell: "0.5", peck: "5" }
    }
}

/// A cycle's call in the text form.
fn cycle_text(d: &Dialect, row: &CycleRow, values: &Values) -> String {
    let dwell = format!("dwell {}s", values.dwell);
    if row.kind.starts_with("tap") {
        return tap_text(d, row, values);
    }
    let own: Vec<String> = match row.kind.as_str() {
        "bore" if row.feed_to_level => vec!["to-level".to_owned()],
        "bore-fine" => vec![format!("shift parameter {}mm, after clockwise", values.peck)],
        "bore-stop" if row.turns_on => vec!["after as-before".to_owned()],
        "bore-stop" => vec!["after clockwise".to_owned()],
        "drill-peck" => vec![pecks_text(row, "clearance", values)],
        "drill-break" => vec![pecks_text(row, "lift", values)],
        _ => Vec::new(),
    };
    let last = if row.kind == "bore" { 0 } else { own.len() };
    let mut own = own;
    own.splice(last..last, row.dwell.map(|_| dwell));
    let own = if own.is_empty() { String::new() } else { format!("({})", own.join(", ")) };
    let level = match d.cycles.return_level.map(ReturnLevel::from) {
        Some(ReturnLevel::Retract) => "retract",
        Some(ReturnLevel::Initial) | None => "initial",
    };
    let approach = match Approach::from(d.cycles.approach) {
        Approach::PlaneFirst => "plane-first",
        Approach::RaiseFirst => "raise-first",
        Approach::ClearFirst => "clear-first",
        Approach::RetractFirst => "retract-first",
    };
    format!(
        "START_CYCLE({}{own}, XY, retract {}mm, depth {}mm, return {level}, {approach}, feed 120mm)",
        row.kind, values.retract, values.depth
    )
}

/// A tapping cycle's call in the text form.
fn tap_text(d: &Dialect, row: &CycleRow, values: &Values) -> String {
    let drill = CycleRow { kind: "drill".into(), dwell: None, ..row.clone() };
    let turn = match row.hand {
        Some(Hand::Left) => "counterclockwise",
        Some(Hand::Right) | None => "clockwise",
    };
    let dwells = match row.dwell {
        Some(_) if row.dwells_turned => format!(", back {}s", values.dwell),
        Some(_) => format!(", dwell {0}s, settle {0}s", values.dwell),
        None => String::new(),
    };
    let after = if row.kind == "tap" { turn } else { "stopped" };
    let level = if row.feed_to_level { ", to-level" } else { "" };
    let tap = format!("{}({turn}, pitch feed{dwells}, after {after}{level})", row.kind);
    cycle_text(d, &drill, values).replacen("drill", &tap, 1)
}

/// Whether a cycle is the one that is written for its kind.
fn writes(d: &Dialect, row: &CycleRow) -> bool {
    let same =
        |c: &&CycleRow| c.kind == row.kind && c.dwell.is_some() == row.dwell.is_some() && c.hand == row.hand;
    let code = d.code.iter().find(|c| c.code == row.code);
    code.is_some_and(|c| c.write)
        && d.cycle.iter().find(same).is_some_and(|first| std::ptr::eq(first, row))
        && d.family == Family::Word
}

fn cycle(bench: &Bench, row: &CycleRow, rows: &mut Vec<Row>) {
    let d = bench.dialect;
    let code = d.code.iter().find(|c| c.code == row.code);
    let sure = row.sure && code.is_some_and(|c| c.sure);
    let usual = Values::default();
    // A word that an option may make its dwell is one where that is the working choice.
    let said = CycleRow { dwell: bench.settings.dwell(row), ..row.clone() };
    let mut tries = vec![
        (row.code.clone(), usual.clone()),
        (format!("{} {}", row.code, row.depth), Values { depth: "-7.891", ..usual.clone() }),
        (format!("{} {}", row.code, row.retract), Values { retract: "-2.345", ..usual.clone() }),
    ];
    if let Some(word) = said.dwell {
        tries.push((format!("{} {}", row.code, word.letter), Values { dwell: "0.123", ..usual.clone() }));
    }
    if let Some(letter) = row.peck.or(row.shift) {
        tries.push((format!("{} {letter}", row.code), Values { peck: "1.234", ..usual.clone() }));
    }
    let primary = d.cycle.iter().find(|c| {
        let same = c.kind == row.kind && c.dwell.is_some() == row.dwell.is_some() && c.hand == row.hand;
        same && writes(d, c)
    });
    for (name, values) in tries {
        let say = format!("{}\nHOLE(X 10mm, Y 20mm)", cycle_text(d, &said, &values));
        let said = Said { after: "END_CYCLE()".to_owned(), ..Said::new(say) };
        let tried = match primary {
            Some(first) if first.code == row.code => must_show(bench.both_ways(&said), &row.code),
            Some(first) => {
                let put = |text: String| in_place(&text, &first.code, &row.code).unwrap_or(text);
                must_show(bench.reads(&said, &said.say, put), &row.code).read_only()
            }
            None => Tried::failure("no row is written for this cycle: none has `write`"),
        };
        rows.push(tried.row("cycle", name, sure));
    }
    if let (Some([first, less, least]), Some(first_row)) =
        (row.shrinking, primary.filter(|p| p.code == row.code))
    {
        let usual = cycle_text(d, &CycleRow { dwell: None, ..first_row.clone() }, &usual);
        let shrinks = usual.replace("(peck 5mm", "(peck 2mm").replacen(
            "parameter",
            "parameter, first 5mm, less 1.5mm",
            1,
        );
        let said =
            Said { after: "END_CYCLE()".to_owned(), ..Said::new(format!("{shrinks}\nHOLE(X 10mm, Y 20mm)")) };
        let tried = must_show(bench.both_ways(&said), &row.code);
        rows.push(tried.row("cycle", format!("{} {first}{less}{least}", row.code), sure));
    }
    if let (Some(letter), true) = (d.cycles.repeat, primary.is_some_and(|p| p.code == row.code)) {
        // Written with one hole, and read with the word behind it.
        let start = cycle_text(d, &said, &usual);
        let hole = "\nHOLE(X 10mm, Y 20mm)";
        let one = Said { after: "END_CYCLE()".to_owned(), ..Said::new(format!("{start}{hole}")) };
        let least = usize::from(d.cycles.repeat_once);
        for times in [least, 3] {
            let put = |text: String| {
                let line = |l: &str| match in_place(l, &row.code, "") {
                    Some(_) => format!("{l} {letter}{times}\n"),
                    None => format!("{l}\n"),
                };
                text.lines().map(line).collect::<String>()
            };
            let tried = bench.reads(&one, &format!("{start}{}", hole.repeat(times)), put).read_only();
            rows.push(tried.row("cycle", format!("{} {letter}{times}", row.code), sure));
        }
    }
}

fn pattern(bench: &Bench, row: &PatternRow, rows: &mut Vec<Row>) {
    let d = bench.dialect;
    let Some(cycle) = d.cycle.iter().find(|row| writes(d, row)) else {
        rows.push(Tried::failure("there is no cycle to make its holes").row("pattern", row.code(), true));
        return;
    };
    let start = cycle_text(d, cycle, &Values::default());
    let patterns: Vec<String> = match row {
        PatternRow::Circle { .. } => vec![
            "CIRCLE_PATTERN(centre here, first (18mm, 0mm), step 30deg, count 12)".to_owned(),
            "CIRCLE_PATTERN(centre here, first (0mm, -12.5mm), step -22.5deg, count 3)".to_owned(),
        ],
        PatternRow::Grid { serpentine, .. } => {
            let order = if *serpentine { ", serpentine" } else { "" };
            vec![
                format!("RECTANGULAR_LAYOUT(columns (X, 15mm, 2), rows (Y, 20mm, 2){order})"),
                format!("RECTANGULAR_LAYOUT(columns (X, -7.5mm, 2), rows (Y, 2.25mm, 2){order})"),
            ]
        }
    };
    let code = d.code.iter().find(|c| c.code == row.code());
    for say in patterns {
        let before = format!("said STRAIGHT_TRAVERSE(X 0mm, Y 0mm)\n{start}");
        let said = Said { before, after: "END_CYCLE()".to_owned(), ..Said::new(say) };
        let tried = must_show(bench.both_ways(&said), row.code());
        rows.push(tried.row("pattern", row.code(), code.is_some_and(|c| c.sure)));
    }
}
