//! Events in words, for the reader of a difference: `messages/event`.
//!
//! ```text
//! the source makes a rapid move to X0 Y0 Z5 (…); the output makes a feed move to X0 Y0 Z5 (…)
//! ```
//!
//! Not here: how a difference is found (`ncc_exec::verify`), and the short form of a record (`review::words`).

use ncc_exec::verify::{Aspect, Difference};
use ncc_exec::{Compensation, CompensationRadius, Event, Kind, State, Stored, TiltedPlane, Written};
use ncc_ir::canon::{Axis, Plane, Spindle, SpindleMode, Turn};
use ncc_ir::expr::num::{Nanos, Num, ONE, Unit};
use ncc_ir::program::{ToolValue, Toward};

use super::messages::message::{Message, Part};

/// Both sides of a difference.
pub fn describe(difference: &Difference) -> String {
    let side = |event: &Option<Event>| match event {
        Some(event) => event_text(event, difference.aspect),
        None => entry("nothing").headline(),
    };
    entry("differ")
        .text("source", side(&difference.source))
        .text("output", side(&difference.target))
        .headline()
}

/// An entry about events.
fn entry(form: &'static str) -> Message {
    Message::part(Part::Event, form)
}

fn event_text(event: &Event, aspect: Aspect) -> String {
    let text = kind(&event.kind, event.state.tool);
    match aspect {
        Aspect::State => {
            let facts = state(&event.state);
            [vec![text], facts].concat().join(", ")
        }
        Aspect::Feed => entry("rate").text("event", text).text("rate", number(event.rate)).headline(),
        Aspect::Kind | Aspect::End(_) | Aspect::Arc | Aspect::Length => {
            let axes = if event.end[3..] == [0; 3] { 3 } else { 6 };
            let end = Axis::ALL.into_iter().take(axes);
            let end = end.map(|axis| (axis, event.end[axis as usize]));
            entry("to").text("event", text).text("end", words(end)).headline()
        }
    }
}

/// The name of an event; `tool` is the one in the spindle after it.
pub(crate) fn kind(kind: &Kind, tool: i64) -> String {
    let message = match kind {
        Kind::Traverse => entry("rapid"),
        Kind::Feed => entry("feed"),
        Kind::Probe { to, probe } => entry("probe")
            .text("contact", if probe.away { "away" } else { "into" })
            .text("end", words([(Axis::X, to[0]), (Axis::Y, to[1]), (Axis::Z, to[2])]))
            .text("error", if probe.error { "yes" } else { "no" }),
        Kind::Arc { plane, turn, full, centre } => {
            let (first, second, _) = plane.axes();
            let turn = match turn {
                Turn::Clockwise => "clockwise",
                Turn::Counterclockwise => "counter-clockwise",
            };
            entry("arc")
                .text("turn", turn)
                .text("shape", if *full { "circle" } else { "arc" })
                .text("centre", words([(first, centre[0]), (second, centre[1])]))
        }
        Kind::Synchronised { pitch, chuck: false } => entry("thread").text("pitch", number(*pitch)),
        Kind::Synchronised { pitch, chuck: true } => entry("thread-chuck").text("pitch", number(*pitch)),
        Kind::Orient(angle) => entry("orient").text("angle", number(*angle)),
        Kind::Tilt(Some(plane)) => return tilted_plane(plane),
        Kind::Tilt(None) => entry("tilt-end"),
        Kind::OrientToolAxis(None) => entry("tool-axis"),
        Kind::OrientToolAxis(Some(Toward::Minus)) => entry("tool-axis-minus"),
        Kind::OrientToolAxis(Some(Toward::Plus)) => entry("tool-axis-plus"),
        Kind::Dwell(seconds) => entry("dwell").text("seconds", number(*seconds)),
        Kind::ToolChange => entry("tool-change").text("tool", tool.to_string()),
        Kind::Data(value) => return stored(value),
        Kind::MachineFunction(name) => entry("function").text("name", &**name),
        Kind::Coolant => entry("coolant"),
        Kind::ProgramStop => entry("stop"),
        Kind::OptionalProgramStop => entry("optional-stop"),
        Kind::ProgramEnd => entry("end"),
        Kind::BeginAgain => entry("begin-again"),
        Kind::TextEnd => entry("text-end"),
        Kind::Attribute(_) => entry("attribute"),
        Kind::Message(text) => entry("message").text("text", format!("{text:?}")),
        Kind::Output(line) => return written(line),
        Kind::Alarm(None, text) => entry("alarm").text("text", format!("{text:?}")),
        Kind::Alarm(Some(number), text) => {
            entry("alarm-number").text("number", (number / ONE).to_string()).text("text", format!("{text:?}"))
        }
    };
    message.headline()
}

/// The facts of a state.
fn state(state: &State) -> Vec<String> {
    let mut facts = vec![entry("with-tool").text("tool", state.tool.to_string())];
    let speed = match state.spindle_mode {
        SpindleMode::Turns => entry("speed-turns").text("speed", number(state.speed)),
        SpindleMode::Surface => {
            entry("speed-surface").text("speed", number(state.speed)).text("centre", number(state.centre))
        }
    };
    match state.spindle {
        Spindle::Stopped => facts.push(entry("spindle-stopped")),
        Spindle::Clockwise => facts.push(entry("spindle-clockwise").text("speed", speed.headline())),
        Spindle::Counterclockwise => {
            facts.push(entry("spindle-counter-clockwise").text("speed", speed.headline()));
        }
    }
    if state.spindle != Spindle::Stopped && state.limit != u32::MAX {
        let limit = number(Nanos::from(state.limit) * (ONE / 1000));
        facts.push(entry("speed-limit").text("limit", limit));
    }
    facts.push(entry(match (state.flood, state.mist) {
        (false, false) => "coolant-off",
        (true, false) => "flood",
        (false, true) => "mist",
        (true, true) => "flood-and-mist",
    }));
    if state.compensation.side.is_some() {
        facts.push(entry("compensation").text("compensation", compensation(&state.compensation)));
    }
    let more = [(state.tip, "tip"), (state.tilted, "tilted"), (state.turned != 0, "rotary-other-way")];
    facts.extend(more.into_iter().filter(|(holds, _)| *holds).map(|(_, form)| entry(form)));
    let from_one_side = Axis::ALL.into_iter().filter(|axis| state.one_side >> *axis as u8 & 1 == 1);
    facts.extend(
        from_one_side.map(|axis| entry("from-one-side").text("axis", char::from(axis.letter()).to_string())),
    );
    facts.iter().map(Message::headline).collect()
}

/// Cutter compensation: `off`, or its side, plane and radius.
pub(crate) fn compensation(active: &Compensation) -> String {
    let Some(side) = active.side else { return entry("compensation-off").headline() };
    let message = match active.radius_place() {
        CompensationRadius::Entry(number) => entry("compensation-entry").text("entry", number.to_string()),
        CompensationRadius::Diameter(nanos) => entry("compensation-diameter").text("diameter", number(nanos)),
        CompensationRadius::Edge => entry("compensation-edge"),
    };
    let mut words = message.text("side", side.name()).text("plane", plane(active.plane)).headline();
    for (holds, form) in
        [(active.again, "compensation-again"), (active.on_contour, "compensation-contour-feed")]
    {
        if holds {
            words = entry(form).text("compensation", words).headline();
        }
    }
    words
}

/// A plane's name.
pub(crate) fn plane(plane: Plane) -> &'static str {
    match plane {
        Plane::Xy => "XY",
        Plane::Zx => "ZX",
        Plane::Yz => "YZ",
    }
}

/// Output to a device.
pub(crate) fn written(written: &Written) -> String {
    match written {
        Written::Opened => entry("opened").headline(),
        Written::Line(text) => entry("line").text("text", format!("{text:?}")).headline(),
        Written::Closed => entry("closed").headline(),
    }
}

/// A value in the control's tables.
fn stored(stored: &Stored) -> String {
    let list = |values: &[Nanos]| values.iter().map(|n| number(*n)).collect::<Vec<String>>().join(" ");
    let message = match stored {
        Stored::Offset(offset, zero, 0) => {
            entry("offset").text("number", offset.to_string()).text("zero", list(zero))
        }
        Stored::Offset(offset, zero, angle) => entry("offset-turned")
            .text("number", offset.to_string())
            .text("zero", list(zero))
            .text("angle", number(*angle)),
        Stored::Position(place, at) => {
            entry("position").text("number", place.to_string()).text("place", list(at))
        }
        Stored::Tool(tool) => entry("tool").text("number", tool.to_string()),
        Stored::Length(row, length) => {
            entry("length").text("value", number(*length)).text("entry", row.to_string())
        }
        Stored::Value(row, which, added, value) => {
            let kind = entry(match which {
                ToolValue::Length => "kind-length",
                ToolValue::LengthWear => "kind-length-wear",
                ToolValue::Radius => "kind-radius",
                ToolValue::RadiusWear => "kind-radius-wear",
                ToolValue::OffsetX => "kind-x",
                ToolValue::OffsetY => "kind-y",
            });
            entry(if *added { "value-added" } else { "value" })
                .text("kind", kind.headline())
                .text("value", number(*value))
                .text("entry", row.to_string())
        }
    };
    message.headline()
}

fn tilted_plane(plane: &TiltedPlane) -> String {
    let origin: Vec<String> = plane.origin.iter().map(|at| number(*at)).collect();
    // No zero has a sign.
    let digits = |part: f64| ((part * 1e6).round() / 1e6 + 0.0).to_string();
    let axis = |row: usize| plane.axes.map(|part| digits(part[row])).join(" ");
    entry("tilt").text("origin", origin.join(" ")).text("z", axis(2)).text("x", axis(0)).headline()
}

/// `X1 Y2`.
fn words(values: impl IntoIterator<Item = (Axis, Nanos)>) -> String {
    let word = |(axis, nanos): (Axis, Nanos)| format!("{}{}", char::from(axis.letter()), number(nanos));
    values.into_iter().map(word).collect::<Vec<String>>().join(" ")
}

/// With six digits at most.
fn number(nanos: Nanos) -> String {
    let n = Num::from_nanos(nanos, 6, Unit::One);
    format!("{:.*}", n.scale as usize, n.mantissa as f64 / 10f64.powi(i32::from(n.scale)))
}
