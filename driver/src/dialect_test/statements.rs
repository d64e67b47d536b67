//! Sample statements for dictionary rows: each is written and read back, and must keep its meaning.

use ncc_dialects::{Dialect, Meaning, Thread};
use ncc_ir::canon::{Distance, FeedMode, PathMode, Plane, ReturnLevel, SpindleMode, Turn, Units};
use ncc_ir::caps::LengthsOf;
use ncc_ir::program::PoleFrom;

use super::cycles::{Values, approach, cycle_text, writes};
use super::proof::Said;

/// A polar point about program zero.
const POLAR: &str = "SET_POLE(XY, zero) & POLAR(XY, radius 12.5mm, angle 30.25deg) said STRAIGHT_FEED()";

/// Statements with this meaning.
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
            let plane = match d.caps.frames.tilt {
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
        Meaning::UseToolCentrePoint(true) => match d.caps.tools.tip {
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
            let radii = &d.caps.compensation.radii;
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
        Meaning::ChangeTool => one(match d.caps.tools.lengths_of {
            LengthsOf::Edges => "SELECT_TOOL(5) & CHANGE_TOOL() & USE_TOOL_EDGE(1)",
            LengthsOf::Entries | LengthsOf::Either => "SELECT_TOOL(5) & CHANGE_TOOL()",
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
        // Its arguments are variables, which text never contains.
        Meaning::CallMacro
        | Meaning::CallMacroAtMoves
        | Meaning::CallMacroAtBlocks
        | Meaning::EndCallsAtMoves => Vec::new(),
        // The end of the subprogram is compared too.
        Meaning::Return => vec![with_procedure(7, Said::new("CALL(7)"))],
        Meaning::RigidTapping => {
            let tap = "tap-rigid(clockwise, pitch feed, after stopped)";
            let way = approach(d);
            let hole = format!(
                "START_CYCLE({tap}, XY, retract 3mm, depth -12mm, return initial, {way}, feed 120mm)\nHOLE(X 10mm)"
            );
            vec![Said { after: "END_CYCLE()".to_owned(), ..Said::new(hole) }]
        }
        Meaning::LeftOut | Meaning::Dwell | Meaning::StartCycle | Meaning::Pattern => Vec::new(),
        Meaning::OrientSpindle => {
            let row = d.code.iter().find(|row| row.code == name);
            let words = row.and_then(|row| row.orient.as_ref()).filter(|words| words.option.is_none());
            let own = words.is_none_or(|words| words.wait.is_none()).then(|| Said::new("ORIENT_SPINDLE()"));
            own.into_iter().chain(words.map(|_| Said::new("ORIENT_SPINDLE(45deg)"))).collect()
        }
        // Spindle, coolant, stops: statements without data.
        function => {
            let text = function.to_string();
            vec![Said::new(match text.split_once(' ') {
                None => format!("{text}()"),
                Some((name, of)) => format!("{name}(\"{of}\")"),
            })]
        }
    }
}

/// A quarter circle with both centre words, in a plane.
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
    // A length offset may need a move along the drilling axis.
    let place = if plane == "XY" { place } else { format!("SELECT_PLANE({plane})\n{place}") };
    Said::new(say).after(place)
}

/// A move with a corner after it, and the next move.
pub fn corner(function: &str) -> Said {
    Said {
        after: "said STRAIGHT_FEED(Y 40mm)".to_owned(),
        ..Said::new(format!("SET_FEED_RATE(123mm) & {function}(2.5mm) & said STRAIGHT_FEED(X 50mm)"))
    }
}

/// With the called subprogram.
pub fn with_procedure(number: u32, said: Said) -> Said {
    let procedures = format!("procedure {number} {{\nsaid STRAIGHT_TRAVERSE(X entry 1u)\nRETURN()\n}}\n");
    Said { procedures, ..said }
}

/// Its name in the text form.
pub fn feed_mode(mode: FeedMode) -> &'static str {
    match mode {
        FeedMode::PerMinute => "per-minute",
        FeedMode::PerRevolution => "per-revolution",
        FeedMode::InverseTime => "inverse-time",
    }
}
