//! System variables: values of the control that a program can read, by their meaning.
//!
//! ```text
//! #5001 (Fanuc), $P_EP[X] (Sinumerik)    System::EndPoint(Axis::X)
//! ```
//!
//! Not here: their values (`exec::ask`), and their names on each control (the dictionaries).

use std::fmt::{self, Display, Formatter};

use crate::canon::{Axis, Distance, FeedMode, Motion, Plane, ReturnLevel, Turn, Units};
use crate::program::tool_value::ToolValue;

/// A system variable.
///
/// Lengths are in the active unit unless a unit is stated, angles in degrees. A condition is 1 or 0.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum System {
    /// End point of the last move along an axis, in program coordinates
    /// (Sinumerik `$P_EP`, Fanuc `#5001`, LinuxCNC `#5420`).
    EndPoint(Axis),
    /// Touch point of the last probing move along an axis, in the program coordinates of that move (Fanuc `#5061`).
    TouchPoint(Axis),
    /// The same for the spindle nose: with the tool offsets that were active.
    TouchWithOffsets(Axis),
    /// Position of the spindle nose along an axis, in the coordinates of the work offset, with the tool offsets (Fanuc
    /// `#5041`).
    SpindlePoint(Axis),
    /// Position in machine coordinates along an axis, with the tool length (LinuxCNC `#<_abs_x>`, Fanuc `#5021`).
    MachinePoint(Axis),
    /// A work offset along an axis; 1 is the first (`#5221`, `$P_UIFR[1,X,TR]`).
    WorkOffset {
        /// 1 is G54.
        number: u16,
        /// Along this one.
        axis: Axis,
        /// The unit that it counts in, whatever is active.
        unit: Option<Units>,
    },
    /// External work offset along an axis: it shifts all work offsets (Fanuc `#5201`).
    ExternalOffset(Axis),
    /// Rotation of a work offset about Z.
    WorkTurn(u16),
    /// Number of the active work offset; 1 is G54.
    WorkOffsetNumber,
    /// Stored G92 shift along an axis, active or not.
    OriginShift {
        /// Along this one.
        axis: Axis,
        /// The unit that it counts in, whatever is active.
        unit: Option<Units>,
    },
    /// Whether the G92 shift is active.
    OriginShifted,
    /// The active tool length.
    ToolLength,
    /// Offset of the tool in the spindle, in the tool table now, active or not (LinuxCNC `#5401`).
    TableOffset {
        /// Along this one.
        axis: Axis,
        /// The unit that it counts in, whatever is active.
        unit: Option<Units>,
    },
    /// Diameter of the tool in the spindle, in the tool table now, with wear (LinuxCNC `#5410`).
    TableDiameter {
        /// The unit that it counts in, whatever is active.
        unit: Option<Units>,
    },
    /// Value of an entry of the tool table now, active or not (Fanuc `#2201`).
    ToolTable {
        /// Which value.
        value: ToolValue,
        /// The entry; 1 is the first.
        entry: u16,
    },
    /// The active H number (Fanuc `#4111`).
    LengthEntry,
    /// Number of the active work offset, 1 to 6 (Fanuc `#4014` minus 53).
    FirstWorkOffset,
    /// A counter of the machine, and its index.
    Kept(Kept, u16),
    /// Number of the tool in the spindle.
    Tool,
    /// Number of the tool selected last.
    SelectedTool,
    /// The last programmed feed.
    Feed,
    /// The last programmed spindle speed.
    Speed,
    /// Whether this unit is active.
    Units(Units),
    /// Whether G90 or G91 is active.
    Distance(Distance),
    /// Whether this plane is active.
    Plane(Plane),
    /// Whether this feed mode is active.
    FeedMode(FeedMode),
    /// Whether this return level of cycles (G98, G99) is active.
    ReturnLevel(ReturnLevel),
    /// Whether this motion mode is active: G00 or G01, and no arc or cycle.
    Motion(Motion),
    /// Whether the spindle turns in this direction.
    Turning(Turn),
    /// Whether G96 is active.
    SurfaceSpeed,
    /// Whether flood coolant is on.
    Flood,
    /// Whether mist coolant is on.
    Mist,
    /// Any other system variable, by its name on the control. Never executed.
    Other(Box<str>),
}

impl System {
    /// Whether the value depends on the machine's set-up or on earlier programs: two machines that execute the same
    /// program may differ.
    pub fn is_of_the_machine(&self) -> bool {
        match self {
            System::MachinePoint(_)
            | System::SpindlePoint(_)
            | System::TouchPoint(_)
            | System::TouchWithOffsets(_)
            | System::WorkOffset { .. }
            | System::ExternalOffset(_)
            | System::WorkTurn(_)
            | System::OriginShift { .. }
            | System::OriginShifted
            | System::ToolLength
            | System::TableOffset { .. }
            | System::TableDiameter { .. }
            | System::ToolTable { .. }
            | System::Kept(..) => true,
            System::EndPoint(_)
            | System::WorkOffsetNumber
            | System::FirstWorkOffset
            | System::LengthEntry
            | System::Tool
            | System::SelectedTool
            | System::Feed
            | System::Speed
            | System::Units(_)
            | System::Distance(_)
            | System::Plane(_)
            | System::FeedMode(_)
            | System::ReturnLevel(_)
            | System::Motion(_)
            | System::Turning(_)
            | System::SurfaceSpeed
            | System::Flood
            | System::Mist
            | System::Other(_) => false,
        }
    }

    /// Reverses [`Display`]; any other name is [`System::Other`].
    pub fn named(name: &str) -> System {
        System::meaning(name).unwrap_or_else(|| System::Other(name.into()))
    }

    fn meaning(name: &str) -> Option<System> {
        if let Some(plain) = PLAIN.iter().find(|(other, _)| *other == name) {
            return Some(plain.1.clone());
        }
        let mut parts = name.split('.');
        let kind = parts.next()?;
        let rest: Vec<&str> = parts.collect();
        let number = |text: &str| -> Option<u16> {
            text.parse().ok().filter(|number: &u16| number.to_string() == text)
        };
        let found = match (kind, &rest[..]) {
            ("end", [along]) => System::EndPoint(axis(along)?),
            ("touch", [along]) => System::TouchPoint(axis(along)?),
            ("spindle-touch", [along]) => System::TouchWithOffsets(axis(along)?),
            ("spindle", [along]) => System::SpindlePoint(axis(along)?),
            ("machine", [along]) => System::MachinePoint(axis(along)?),
            ("offset", [of, along]) => {
                System::WorkOffset { number: number(of)?, axis: axis(along)?, unit: None }
            }
            ("offset", [of, along, in_unit]) => {
                System::WorkOffset { number: number(of)?, axis: axis(along)?, unit: Some(unit(in_unit)?) }
            }
            ("external", [along]) => System::ExternalOffset(axis(along)?),
            ("table", ["diameter"]) => System::TableDiameter { unit: None },
            ("table", ["diameter", in_unit]) => System::TableDiameter { unit: Some(unit(in_unit)?) },
            ("table", [along]) => System::TableOffset { axis: axis(along)?, unit: None },
            ("table", [along, in_unit]) => {
                System::TableOffset { axis: axis(along)?, unit: Some(unit(in_unit)?) }
            }
            ("tool", [of, entry]) => {
                let value = TOOL_VALUES.iter().find(|(_, name)| name == of)?.0;
                System::ToolTable { value, entry: number(entry)? }
            }
            ("kept", [what]) => System::Kept(Kept::named(what)?, 0),
            ("kept", [what, of]) => System::Kept(Kept::named(what)?, number(of).filter(|of| *of > 0)?),
            ("turn", [of]) => System::WorkTurn(number(of)?),
            ("shift", [along]) => System::OriginShift { axis: axis(along)?, unit: None },
            ("shift", [along, in_unit]) => {
                System::OriginShift { axis: axis(along)?, unit: Some(unit(in_unit)?) }
            }
            _ => return None,
        };
        Some(found)
    }

    /// The same value along another axis; `None` if it belongs to no axis.
    pub fn along(mut self, along: Axis) -> Option<System> {
        match &mut self {
            System::EndPoint(axis)
            | System::TouchPoint(axis)
            | System::TouchWithOffsets(axis)
            | System::SpindlePoint(axis)
            | System::MachinePoint(axis)
            | System::ExternalOffset(axis)
            | System::WorkOffset { axis, .. }
            | System::OriginShift { axis, .. }
            | System::TableOffset { axis, .. } => *axis = along,
            _ => return None,
        }
        Some(self)
    }

    /// The same value of another entry of its table, from 1; `None` if it is in no table.
    pub fn numbered(mut self, entry: u16) -> Option<System> {
        match &mut self {
            System::WorkOffset { number, .. }
            | System::ToolTable { entry: number, .. }
            | System::WorkTurn(number)
            | System::Kept(_, number) => *number = entry,
            _ => return None,
        }
        Some(self)
    }

    /// Whether it depends on the position.
    pub fn is_place(&self) -> bool {
        matches!(
            self,
            System::EndPoint(_)
                | System::TouchPoint(_)
                | System::TouchWithOffsets(_)
                | System::SpindlePoint(_)
                | System::MachinePoint(_)
        )
    }
}

/// Counters of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kept {
    /// Parts made since the operator has reset the count (Fanuc and Haas `#3901`).
    Parts,
    /// Parts required (Fanuc `#3902`).
    PartsWanted,
    /// Second counter of program ends (Haas `#3902`).
    PartsAgain,
    /// Feed time of a tool, seconds (Haas from `#5401`).
    FeedTime,
    /// Time of a tool in the spindle, seconds (Haas from `#5501`).
    ToolTime,
    /// Allowed uses of a tool (Haas from `#5601`).
    UsesAllowed,
    /// Uses of a tool (Haas from `#5701`).
    Uses,
}

impl Kept {
    /// Its name in text.
    pub const fn name(self) -> &'static str {
        match self {
            Kept::Parts => "parts",
            Kept::PartsWanted => "parts-wanted",
            Kept::PartsAgain => "parts-again",
            Kept::FeedTime => "feed-time",
            Kept::ToolTime => "tool-time",
            Kept::UsesAllowed => "uses-allowed",
            Kept::Uses => "uses",
        }
    }

    fn named(name: &str) -> Option<Kept> {
        KEPT.into_iter().find(|kept| kept.name() == name)
    }
}

const KEPT: [Kept; 7] = [
    Kept::Parts,
    Kept::PartsWanted,
    Kept::PartsAgain,
    Kept::FeedTime,
    Kept::ToolTime,
    Kept::UsesAllowed,
    Kept::Uses,
];

/// Values of the tool table by their names in the text form.
const TOOL_VALUES: [(ToolValue, &str); 2] =
    [(ToolValue::Length, "length"), (ToolValue::LengthWear, "length-wear")];

/// System variables without data, by their names in the text form.
const PLAIN: [(&str, System); 28] = [
    ("offset.first", System::FirstWorkOffset),
    ("length.entry", System::LengthEntry),
    ("offset", System::WorkOffsetNumber),
    ("shifted", System::OriginShifted),
    ("length", System::ToolLength),
    ("tool", System::Tool),
    ("selected", System::SelectedTool),
    ("feed", System::Feed),
    ("speed", System::Speed),
    ("mm", System::Units(Units::Mm)),
    ("inch", System::Units(Units::Inch)),
    ("absolute", System::Distance(Distance::Absolute)),
    ("incremental", System::Distance(Distance::Incremental)),
    ("plane.xy", System::Plane(Plane::Xy)),
    ("plane.zx", System::Plane(Plane::Zx)),
    ("plane.yz", System::Plane(Plane::Yz)),
    ("feed.minute", System::FeedMode(FeedMode::PerMinute)),
    ("feed.turn", System::FeedMode(FeedMode::PerRevolution)),
    ("feed.time", System::FeedMode(FeedMode::InverseTime)),
    ("return.initial", System::ReturnLevel(ReturnLevel::Initial)),
    ("return.retract", System::ReturnLevel(ReturnLevel::Retract)),
    ("motion.traverse", System::Motion(Motion::Traverse)),
    ("motion.feed", System::Motion(Motion::Feed)),
    ("spindle.clockwise", System::Turning(Turn::Clockwise)),
    ("spindle.counterclockwise", System::Turning(Turn::Counterclockwise)),
    ("speed.surface", System::SurfaceSpeed),
    ("flood", System::Flood),
    ("mist", System::Mist),
];

fn axis(text: &str) -> Option<Axis> {
    match text.as_bytes() {
        [letter] if letter.is_ascii_lowercase() => Axis::from_letter(letter.to_ascii_uppercase()),
        _ => None,
    }
}

fn unit(text: &str) -> Option<Units> {
    match text {
        "mm" => Some(Units::Mm),
        "inch" => Some(Units::Inch),
        _ => None,
    }
}

/// Its name in text.
impl Display for System {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let letter = |axis: &Axis| char::from(axis.letter().to_ascii_lowercase());
        let unit = |unit: &Option<Units>| match unit {
            None => "",
            Some(Units::Mm) => ".mm",
            Some(Units::Inch) => ".inch",
        };
        match self {
            System::EndPoint(axis) => write!(f, "end.{}", letter(axis)),
            System::TouchPoint(axis) => write!(f, "touch.{}", letter(axis)),
            System::TouchWithOffsets(axis) => write!(f, "spindle-touch.{}", letter(axis)),
            System::SpindlePoint(axis) => write!(f, "spindle.{}", letter(axis)),
            System::MachinePoint(axis) => write!(f, "machine.{}", letter(axis)),
            System::WorkOffset { number, axis, unit: of } => {
                write!(f, "offset.{number}.{}{}", letter(axis), unit(of))
            }
            System::ExternalOffset(axis) => write!(f, "external.{}", letter(axis)),
            System::WorkTurn(number) => write!(f, "turn.{number}"),
            System::TableOffset { axis, unit: of } => write!(f, "table.{}{}", letter(axis), unit(of)),
            System::TableDiameter { unit: of } => write!(f, "table.diameter{}", unit(of)),
            System::OriginShift { axis, unit: of } => write!(f, "shift.{}{}", letter(axis), unit(of)),
            System::ToolTable { value, entry } => {
                let name = TOOL_VALUES.iter().find(|(own, _)| own == value).map_or("", |(_, name)| name);
                write!(f, "tool.{name}.{entry}")
            }
            System::Kept(what, 0) => write!(f, "kept.{}", what.name()),
            System::Kept(what, of) => write!(f, "kept.{}.{of}", what.name()),
            System::Other(name) => f.write_str(name),
            plain => f.write_str(PLAIN.iter().find(|(_, other)| other == plain).map_or("", |(name, _)| name)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_has_one_meaning() {
        let more = [
            System::EndPoint(Axis::X),
            System::TouchPoint(Axis::Z),
            System::TouchWithOffsets(Axis::Z),
            System::SpindlePoint(Axis::Y),
            System::MachinePoint(Axis::C),
            System::WorkOffset { number: 12, axis: Axis::Z, unit: None },
            System::WorkOffset { number: 1, axis: Axis::A, unit: Some(Units::Inch) },
            System::ExternalOffset(Axis::Y),
            System::WorkTurn(9),
            System::TableOffset { axis: Axis::X, unit: None },
            System::TableOffset { axis: Axis::Z, unit: Some(Units::Inch) },
            System::TableDiameter { unit: None },
            System::TableDiameter { unit: Some(Units::Inch) },
            System::OriginShift { axis: Axis::Y, unit: Some(Units::Mm) },
            System::OriginShift { axis: Axis::Y, unit: None },
            System::ToolTable { value: ToolValue::LengthWear, entry: 7 },
            System::Kept(Kept::Parts, 0),
            System::Kept(Kept::FeedTime, 12),
            System::Other("$AA_IW".into()),
        ];
        for system in PLAIN.iter().map(|(_, system)| system).chain(&more) {
            let name = system.to_string();
            assert!(!name.is_empty(), "{system:?}");
            assert_eq!(System::named(&name), *system);
        }
        for name in [
            "end.X",
            "end.u",
            "offset.01.x",
            "offset.x",
            "",
            "shift.x.cm",
            "END.x",
            "kept.uses.0",
            "tool.width.1",
        ] {
            assert_eq!(System::named(name), System::Other(name.into()));
        }
    }
}
