//! What a program can ask of the control itself: values by their meaning, whatever a control calls them.
//!
//! Not here: what they are worth (`exec::ask`), and what each control calls them (its front-end's, by its
//! dictionary).

use std::fmt::{self, Display, Formatter};

use crate::canon::{Axis, Distance, FeedMode, Motion, Plane, ReturnLevel, Turn, Units};
use crate::program::tool_value::ToolValue;

/// A value of the control's own.
///
/// Lengths count in the unit in force where none is stated, angles in degrees; whether something holds is 1, else 0.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum System {
    /// Where the tool stands along an axis, in the program's coordinates: the end point of the last move
    /// (Sinumerik `$P_EP`, Fanuc `#5001`, LinuxCNC `#5420`).
    EndPoint(Axis),
    /// Where the last probing move ended along an axis, in the coordinates that the program had then (Fanuc `#5061`).
    TouchPoint(Axis),
    /// The same with the offsets of the tool that were in force counted in: where the spindle's end was.
    TouchWithOffsets(Axis),
    /// Where the spindle's end stands along an axis in the coordinates of the work offset, the offsets of the tool counted
    /// in (Fanuc `#5041`).
    SpindlePoint(Axis),
    /// Where the tool stands in machine coordinates, tool length included (LinuxCNC `#<_abs_x>`, Fanuc `#5021`).
    MachinePoint(Axis),
    /// A work offset along an axis; 1 is the first (`#5221`, `$P_UIFR[1,X,TR]`).
    WorkOffset {
        /// Its number.
        number: u16,
        /// Along this one.
        axis: Axis,
        /// The unit that it counts in, whatever is in force.
        unit: Option<Units>,
    },
    /// By how much all work offsets are shifted along an axis, beside the one in force (Fanuc `#5201`).
    ExternalOffset(Axis),
    /// By how much a work offset is turned about Z.
    WorkTurn(u16),
    /// The number of the work offset in force.
    WorkOffsetNumber,
    /// The number kept of the shift of the origin along an axis, in force or not.
    OriginShift {
        /// Along this one.
        axis: Axis,
        /// The unit that it counts in, whatever is in force.
        unit: Option<Units>,
    },
    /// Whether the shift of the origin is in force.
    OriginShifted,
    /// The length of a tool in force.
    ToolLength,
    /// An offset of the tool in the spindle, as the table of tools has it now, whether in force or not (LinuxCNC
    /// `#5401`).
    TableOffset {
        /// Along this one.
        axis: Axis,
        /// The unit that it counts in, whatever is in force.
        unit: Option<Units>,
    },
    /// The diameter of the tool in the spindle, as the table of tools has it now, wear counted in (LinuxCNC `#5410`).
    TableDiameter {
        /// The unit that it counts in, whatever is in force.
        unit: Option<Units>,
    },
    /// A value of an entry of the table of tools, as the table has it now, whether in force or not (Fanuc `#2201`).
    ToolTable {
        /// Which value.
        value: ToolValue,
        /// The entry; 1 is the first.
        entry: u16,
    },
    /// The number of the entry of the length table in force (Fanuc `#4111`).
    LengthEntry,
    /// The number of the work offset in force, where it is one of the first six (Fanuc `#4014`, less 53).
    FirstWorkOffset,
    /// What the machine keeps count of by itself.
    Kept(Kept, u16),
    /// Number of the tool in the spindle.
    Tool,
    /// Number of the tool selected last.
    SelectedTool,
    /// The feed said last.
    Feed,
    /// The spindle speed said last.
    Speed,
    /// Whether units are these.
    Units(Units),
    /// Whether words are measured so.
    Distance(Distance),
    /// Whether the plane is this one.
    Plane(Plane),
    /// Whether a feed counts so.
    FeedMode(FeedMode),
    /// Whether cycles leave the tool there.
    ReturnLevel(ReturnLevel),
    /// Whether axis words alone do this straight move; what is in force is no arc, and no cycle.
    Motion(Motion),
    /// Whether the spindle turns so.
    Turning(Turn),
    /// Whether the speed is a surface speed.
    SurfaceSpeed,
    /// Whether flood coolant is on.
    Flood,
    /// Whether mist coolant is on.
    Mist,
    /// Something without a meaning here, by the control's own name. Never executed.
    Other(Box<str>),
}

impl System {
    /// Whether the machine's set-up has the answer, or what ran before: two machines may answer differently where they
    /// have executed the same.
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

    /// The value of a name that [`Display`] gives; any other is [`System::Other`].
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

    /// The same value along another axis; `None` of one that is along no axis.
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

    /// The same value of another entry of its table, from 1 on; `None` of one that is in no table.
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

    /// Whether it depends on where the tool stands.
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

/// What a machine keeps count of by itself, and no program says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kept {
    /// Parts made since somebody has set the count to nothing (Fanuc and Haas `#3901`).
    Parts,
    /// Parts that shall be made (Fanuc `#3902`).
    PartsWanted,
    /// The second count of ends of programs (Haas `#3902`).
    PartsAgain,
    /// Seconds that a tool was fed (Haas `#5401` and on).
    FeedTime,
    /// Seconds that a tool was in the spindle (Haas `#5501` and on).
    ToolTime,
    /// How often a tool may be used (Haas `#5601` and on).
    UsesAllowed,
    /// How often a tool was used (Haas `#5701` and on).
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

/// Values of the table of tools that have a name here.
const TOOL_VALUES: [(ToolValue, &str); 2] =
    [(ToolValue::Length, "length"), (ToolValue::LengthWear, "length-wear")];

/// Those that have nothing of their own to say.
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
