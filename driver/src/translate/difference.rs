//! A difference of two canonical streams in words, for the diagnostic of a failed verification.

use ncc_exec::verify::{Aspect, Difference};
use ncc_exec::{Event, Kind, State};
use ncc_ir::canon::{Axis, Spindle, SpindleMode, Turn};
use ncc_ir::expr::num::{Num, ONE, Unit};

/// Both sides of a difference.
pub fn describe(difference: &Difference) -> String {
    let side = |event: &Option<Event>| match event {
        Some(event) => event_text(event, difference.aspect),
        None => "nothing more".to_owned(),
    };
    format!("the source makes {}; the output makes {}", side(&difference.source), side(&difference.target))
}

fn event_text(event: &Event, aspect: Aspect) -> String {
    let mut text = match &event.kind {
        Kind::Traverse => "a rapid".to_owned(),
        Kind::Feed => "a feed move".to_owned(),
        Kind::Probe { to, probe } => format!(
            "a probing move {} on the way to X{} Y{} Z{}{}",
            if probe.away { "off a contact" } else { "into a contact" },
            number(to[0]),
            number(to[1]),
            number(to[2]),
            if probe.error { ", or an error" } else { "" },
        ),
        Kind::Arc { plane, turn, full, centre } => {
            let (first, second, _) = plane.axes();
            format!(
                "{} {} about {}{} {}{}",
                match turn {
                    Turn::Clockwise => "a clockwise",
                    Turn::Counterclockwise => "a counter-clockwise",
                },
                if *full { "circle" } else { "arc" },
                first.letter() as char,
                number(centre[0]),
                second.letter() as char,
                number(centre[1]),
            )
        }
        Kind::Synchronised { pitch, chuck } => {
            format!("a thread of pitch {} mm{}", number(*pitch), if *chuck { " in a chuck" } else { "" })
        }
        Kind::Orient(angle) => format!("the spindle stopped at {} degrees", number(*angle)),
        Kind::Tilt(Some(plane)) => plane.to_string(),
        Kind::Tilt(None) => "the end of the tilted plane".to_owned(),
        Kind::OrientToolAxis(None) => "the tool turned onto the plane".to_owned(),
        Kind::OrientToolAxis(Some(toward)) => format!("the tool turned onto the plane, {}", toward.name()),
        Kind::Dwell(seconds) => format!("a dwell of {} s", number(*seconds)),
        Kind::ToolChange => format!("a change to tool {}", event.state.tool),
        Kind::Data(stored) => stored.to_string(),
        Kind::MachineFunction(name) => format!("the machine function {name}"),
        Kind::Coolant => "a switch of the coolant".to_owned(),
        Kind::ProgramStop => "a stop".to_owned(),
        Kind::OptionalProgramStop => "an optional stop".to_owned(),
        Kind::ProgramEnd => "the end".to_owned(),
        Kind::BeginAgain => "the program that begins again".to_owned(),
        Kind::TextEnd => "the end of the text".to_owned(),
        Kind::Attribute(_) => "an attribute".to_owned(),
        Kind::Message(text) => format!("the message {text:?}"),
        Kind::Output(written) => written.to_string(),
        Kind::Alarm(None, text) => format!("the alarm {text:?}"),
        Kind::Alarm(Some(number), text) => format!("the alarm {} {text:?}", number / ONE),
    };
    match aspect {
        Aspect::State => {
            let s = &event.state;
            let spindle = match s.spindle {
                Spindle::Stopped => "spindle stopped".to_owned(),
                Spindle::Clockwise => format!("spindle clockwise at {}", speed(s)),
                Spindle::Counterclockwise => format!("spindle counter-clockwise at {}", speed(s)),
            };
            let coolant = match (s.flood, s.mist) {
                (false, false) => "no coolant",
                (true, false) => "flood",
                (false, true) => "mist",
                (true, true) => "flood and mist",
            };
            text += &format!(" with tool {}, {spindle}, {coolant}", s.tool);
            if s.compensation.side.is_some() {
                text += &format!(", compensation {}", s.compensation.words());
            }
            if s.tip {
                text += ", points of the tool's tip";
            }
            if s.tilted {
                text += ", in a tilted plane";
            }
            if s.turned != 0 {
                text += ", a rotary axis the other way round";
            }
            let from_one_side = |axis: &Axis| s.one_side >> *axis as u8 & 1 == 1;
            for axis in Axis::ALL.into_iter().filter(from_one_side) {
                text += &format!(", {} from its one side", axis.letter() as char);
            }
        }
        Aspect::Feed => text += &format!(" at F{}", number(event.rate)),
        Aspect::Kind | Aspect::End(_) | Aspect::Arc | Aspect::Length => {
            text += " to";
            for axis in Axis::ALL.into_iter().take(if event.end[3..] == [0; 3] { 3 } else { 6 }) {
                text += &format!(" {}{}", axis.letter() as char, number(event.end[axis as usize]));
            }
            text += " (machine coordinates of a test world)";
        }
    }
    text
}

/// A speed with what it counts, and the limit that is in force.
fn speed(state: &State) -> String {
    let counts = match state.spindle_mode {
        SpindleMode::Turns => String::new(),
        SpindleMode::Surface => {
            format!(" m/min about X{} (machine coordinates of a test world)", number(state.centre))
        }
    };
    let limit = match state.limit {
        u32::MAX => String::new(),
        limit => format!(", no more than {}", number(i64::from(limit) * 1_000_000)),
    };
    format!("{}{counts}{limit}", number(state.speed))
}

fn number(nanos: i64) -> String {
    let n = Num::from_nanos(nanos, 6, Unit::One);
    format!("{:.*}", n.scale as usize, n.mantissa as f64 / 10f64.powi(i32::from(n.scale)))
}
