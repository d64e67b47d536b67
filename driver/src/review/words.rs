//! Records in words: places, moves and what they are done with.

use ncc_diff::record::{Length, Record, Style, What};
use ncc_exec::{Coolant, Kind};
use ncc_ir::canon::{AXES, Axis, Spindle, Turn};
use ncc_ir::expr::num::{Nanos, Num, ONE, Unit};

use crate::render::events;
use crate::render::messages::message::{Message, Part};

/// Digits after the point of what is shown.
const DIGITS: u8 = 4;

/// A value in nanos as a decimal, rounded, without zeros at its end.
pub fn number(nanos: Nanos) -> String {
    rounded(nanos, DIGITS)
}

/// With so many digits after the point at most.
pub fn rounded(nanos: Nanos, digits: u8) -> String {
    decimal(Num::from_nanos(nanos, digits, Unit::One))
}

/// A number with its own digits.
pub fn decimal(n: Num) -> String {
    let (sign, digits) = (if n.mantissa < 0 { "-" } else { "" }, n.mantissa.unsigned_abs().to_string());
    let scale = n.scale as usize;
    let digits = format!("{digits:0>width$}", width = scale + 1);
    let (whole, part) = digits.split_at(digits.len() - scale);
    if part.is_empty() { format!("{sign}{whole}") } else { format!("{sign}{whole}.{part}") }
}

/// A place: X Y Z, and rotary axes that are not at zero.
pub fn place(at: &[Nanos; AXES]) -> String {
    let axes = Axis::ALL.into_iter().filter(|axis| !axis.is_rotary() || at[*axis as usize] != 0);
    let words: Vec<String> =
        axes.map(|axis| format!("{}{}", axis.letter() as char, number(at[axis as usize]))).collect();
    words.join(" ")
}

/// A spindle's sense.
pub fn spindle(spindle: Spindle) -> &'static str {
    match spindle {
        Spindle::Stopped => "off",
        Spindle::Clockwise => "clockwise",
        Spindle::Counterclockwise => "counter-clockwise",
    }
}

/// Coolant, by what is on.
pub fn coolant(on: Coolant) -> String {
    let form = match on {
        Coolant { flood: false, mist: false } => "off",
        Coolant { flood: true, mist: false } => "flood",
        Coolant { flood: false, mist: true } => "mist",
        Coolant { flood: true, mist: true } => "flood-and-mist",
    };
    match form {
        "off" => form.to_owned(),
        _ => Message::part(Part::Event, form).headline(),
    }
}

/// Whose length is active.
pub fn length(length: &Length) -> String {
    match length {
        Length::Entry(0) => "none".to_owned(),
        Length::Entry(entry) => format!("entry {entry}"),
        Length::Edge(-1, edge) => format!("edge {edge}"),
        Length::Edge(tool, edge) => format!("edge {edge} of tool {tool}"),
    }
}

/// An event in one line.
pub fn event(record: &Record, style: &Style, kept: &[Kind]) -> String {
    let text = || match kept.get(record.more[1] as usize) {
        Some(Kind::Message(text) | Kind::Alarm(None, text)) => text.to_string(),
        Some(Kind::Alarm(Some(number), text)) => format!("{} {text}", number / ONE),
        Some(Kind::MachineFunction(name)) => format!("function {name}"),
        Some(kind) => events::kind(kind, style.state.tool),
        None => String::new(),
    };
    let at = place(&record.place(style));
    match record.what {
        What::Traverse => format!("rapid {at}"),
        What::Feed => format!("feed {at} F{}", number(style.rate)),
        What::Arc => {
            let (in_plane, turn, full) = record.arc();
            let (first, second, _) = in_plane.axes();
            format!(
                "{} {} {} {at} centre {}{} {}{} F{}",
                if full { "circle" } else { "arc" },
                match turn {
                    Turn::Clockwise => "clockwise",
                    Turn::Counterclockwise => "counter-clockwise",
                },
                events::plane(in_plane),
                first.letter() as char,
                number(record.more[0]),
                second.letter() as char,
                number(record.more[1]),
                number(style.rate)
            )
        }
        What::Thread => format!("thread {at} F{}", number(style.rate)),
        What::Orient => {
            Message::part(Part::Event, "line-orient").text("angle", number(record.more[0])).headline()
        }
        What::Dwell => format!("dwell {} s", number(record.more[0])),
        What::ToolChange => format!("tool T{}", style.state.tool),
        What::Function => text(),
        What::Stop => "stop".to_owned(),
        What::OptionalStop => "optional stop".to_owned(),
        What::End => "end".to_owned(),
        What::BeginAgain => "beginning again".to_owned(),
        What::TextEnd => Message::part(Part::Event, "line-text-end").headline(),
        What::Message => format!("message {:?}", text()),
        What::Alarm => format!("alarm {:?}", text()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_exact() {
        for (nanos, text) in [
            (0, "0"),
            (-500_000_000, "-0.5"),
            (10_000_000_000, "10"),
            (20_000_000, "0.02"),
            (-1_234_567_890, "-1.2346"),
            (49_999, "0"),
            (9_000_000_000_000_000_000, "9000000000"),
        ] {
            assert_eq!(number(nanos), text);
        }
    }
}
