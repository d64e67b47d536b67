//! Which fact of which machine an assumption rests on.
//!
//! A translation tells what it assumed. Each of these assumptions is one fact of one of the
//! two machines, with a place in its profile; a profile that states the fact settles it, and one that
//! states the contrary forbids it. What has no place in a profile stays an assumption. The same
//! goes for what is refused because a profile does not name it.

use std::fmt;

use ncc_dialects::{BLOCK_WITHOUT_WAY, BREAK_LIFT, CallRow, Dialect, FIRST_TOOL, PECK_CLEARANCE, Role};
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::{Fault, ModeName};
use ncc_ir::lack::{Lack, ToolsLack, WordsLack};
use ncc_ir::program::numbered::Numbered;

/// One of the two machines of a translation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Side {
    /// The one that the program was written for.
    From,
    /// The one that it is translated for.
    To,
}

/// Who told the assumption.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Told {
    /// The reader of the source.
    Reader,
    /// A pass, or the writer of the output.
    Writer,
}

/// A place in a profile.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Place {
    /// A key of `[power_on]`.
    PowerOn(&'static str),
    /// A key of `[options]`.
    Option(String),
    /// A key of `[confirmed]`.
    Confirmed(String),
    /// A row of `[[m_code]]`: what a code does.
    Code(String),
    /// A row of `[[m_code]]`: which code does something, by its name.
    Function(String),
    /// A row of `[[tool]]`, `[[work_offset]]` or `[[program]]`: the name of a number.
    Name(Numbered, u32),
    /// The same: which number has a name.
    Number(Numbered, String),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::PowerOn(key) => write!(f, "power_on.{key}"),
            Place::Option(key) => write!(f, "options.{}", quoted(key)),
            Place::Confirmed(key) => write!(f, "confirmed.{}", quoted(key)),
            Place::Code(code) => write!(f, "m_code {code}"),
            Place::Function(name) => match name.strip_prefix(UNNAMED) {
                Some(number) => write!(f, "m_code for M{number}"),
                None => write!(f, "m_code for {name}"),
            },
            Place::Name(what, number) => write!(f, "{} {number}", key_of(*what)),
            Place::Number(what, name) => write!(f, "{} {name:?}", key_of(*what)),
        }
    }
}

/// The key of a profile's table in which something numbered has its rows, or its key in such a row.
pub fn key_of(what: Numbered) -> &'static str {
    match what {
        Numbered::Tool => "tool",
        Numbered::LengthEntry => "length_entry",
        Numbered::WorkOffset => "work_offset",
        Numbered::Program => "program",
    }
}

/// A key as TOML wants it.
pub fn quoted(key: &str) -> String {
    let bare = !key.is_empty() && key.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_' || b == b'-');
    if bare { key.to_owned() } else { format!("{key:?}") }
}

/// What stands before the number of an M code in the name of a function that nobody has named yet.
pub const UNNAMED: &str = "as-m";

/// Key of the reading that a length offset takes effect with the next Z.
pub const OFFSET_WITH_Z: &str = "length-offset-with-next-z";

/// Key of the reading of numbers without a decimal point, where it is no option.
pub const BARE_NUMBERS: &str = "numbers-without-point";

/// Key of the reading that edge 1 of a tool is the length entry of its number.
pub const EDGE_IS_ENTRY: &str = "edge-1-is-length-entry";

/// Key of the reading that a radius entry has the radius of the tool, edge or length entry of its number.
pub const RADIUS_IS_ENTRY: &str = "radius-entry-is-tool";

/// Key of the reading that positions under a cycle are reached in rapid, and that the motion before a
/// cycle is active again after it.
pub const MOTION_AT_CYCLES: &str = "motion-at-cycles";

/// Key of the reading that a control that lacks it always takes corners in one way.
pub const CORNERS: &str = "corners";

/// Key of the reading that corners of programs without a path mode may be taken as the control begins.
pub const CORNERS_AT_START: &str = "corners-at-start";

/// Key of the reading that F on arcs under cutter compensation may count otherwise than on the other control.
pub const FEED_ON_ARCS: &str = "feed-on-compensated-arcs";

/// Key of the reading that the tool goes onto a compensated contour, and leaves it, as on the other control.
pub const CONTOUR_ENDS: &str = "contour-ends";

/// Key of the reading that rotary axes, and the zero of points of the tool tip, are those of the other machine.
pub const TIP: &str = "tool-centre-point";

/// Key of the reading that the tool is swivelled to tilted planes as on the other machine.
pub const TILT: &str = "tilted-plane";

/// Key of the reading that the control goes beside a contour, onto it and off it, as RS274/NGC describes it.
pub const CONTOUR_PATH: &str = "contour-path";

/// What follows the name of a pattern whose order of holes is the one that is written.
const ORDER: &str = "-order";

/// What follows the name of a function that acts after the move of its block.
const AFTER: &str = "-in-a-block-with-a-move";

/// What follows the name of an argument that is computed by the control.
const AUTOMATIC: &str = "-automatic";

/// Machine data that say which spindle words without a number mean.
const MASTER_SPINDLE: &str = "MD-20090-SPIND_DEF_MASTER_SPIND";

/// That a machine has one record of its kinematics, whatever a program calls it.
const SWIVEL_RECORD: &str = "only-swivel-data-record";

/// The fact that an assumption rests on, or that is missing where an M code is refused; `None` for
/// anything else.
pub fn rests_on(fault: &Fault, told: Told, from: &Dialect, to: &Dialect) -> Option<(Side, Place)> {
    let side = match told {
        Told::Reader => Side::From,
        Told::Writer => Side::To,
    };
    let has_option = |name: &str| from.option.iter().any(|o| o.name == name);
    let edges = |dialect: &Dialect| dialect.letter_for(Role::ToolEdge).is_some();
    Some(match fault {
        // Where the motion at power-on is a fact, or nothing is assumed of it, it is the one
        // around a cycle that is meant.
        Fault::AssumedMode { fact: ModeName::Motion, .. }
            if from.power_on.motion.as_ref().is_none_or(|row| row.always) =>
        {
            (side, Place::Confirmed(MOTION_AT_CYCLES.to_owned()))
        }
        Fault::AssumedMode { fact, .. } => (side, Place::PowerOn(power_on_key(*fact))),
        Fault::AssumedWorkOffset { .. } => (side, Place::PowerOn("work_offset")),
        Fault::AssumedOption { option, .. } => (side, Place::Option(option.to_string())),
        Fault::AssumedBareNumber { .. } if has_option("decimal_point") => {
            (Side::From, Place::Option("decimal_point".to_owned()))
        }
        Fault::AssumedBareNumber { .. } => (Side::From, Place::Confirmed(BARE_NUMBERS.to_owned())),
        Fault::AssumedToolChange { .. } => (Side::From, Place::Option("tool_with_change".to_owned())),
        Fault::AssumedCycle { .. } => (Side::From, Place::Option("cycle_beside_motion".to_owned())),
        Fault::AssumedReturn { .. } => (Side::From, Place::Option("return_distance".to_owned())),
        Fault::AssumedFact { fact } => match fact {
            ControlFact::PeckClearance { .. } => (Side::From, Place::Option(PECK_CLEARANCE.to_owned())),
            ControlFact::BreakLift { .. } => (Side::From, Place::Option(BREAK_LIFT.to_owned())),
            ControlFact::StillBlock => (Side::From, Place::Option(BLOCK_WITHOUT_WAY.to_owned())),
            ControlFact::WaitingTool { .. } => (Side::From, Place::Option(FIRST_TOOL.to_owned())),
            other => (side, Place::Confirmed(key(other))),
        },
        Fault::UnknownCode { code } if is_m_code(code) => (Side::From, Place::Code(code.to_string())),
        Fault::TargetLacks { lack } => match lack {
            Lack::Tools(ToolsLack::Name { name }) => {
                (Side::To, Place::Number(Numbered::Tool, name.to_string()))
            }
            Lack::Words(WordsLack::MachineFunction { name }) => (Side::To, Place::Function(name.to_string())),
            _ => return None,
        },
        Fault::AssumedNoEffect { code } => (side, Place::Confirmed(code.to_string())),
        Fault::AssumedRow { code, .. } => (side, Place::Confirmed(row_key(code))),
        // Where the target wants the offset with a Z word, it is still the source that takes it up so.
        Fault::AssumedOffsetWithZ => (Side::From, Place::Confirmed(OFFSET_WITH_Z.to_owned())),
        Fault::AssumedHoleOrder { pattern } => (side, Place::Confirmed(format!("{pattern}{ORDER}"))),
        Fault::PathAtStart { .. } => (Side::To, Place::Confirmed(CORNERS_AT_START.to_owned())),
        Fault::FeedOnArcs { .. } => (Side::To, Place::Confirmed(FEED_ON_ARCS.to_owned())),
        Fault::AssumedPath { .. } | Fault::RoundsFreely => (Side::To, Place::Confirmed(CORNERS.to_owned())),
        Fault::AssumedTip => (Side::To, Place::Confirmed(TIP.to_owned())),
        Fault::AssumedTilt => (Side::To, Place::Confirmed(TILT.to_owned())),
        Fault::OpenBehaviour { behaviour, source, .. } => {
            (if *source { Side::From } else { Side::To }, Place::Option(behaviour.option()))
        }
        Fault::MustBeStated { behaviour } => (Side::From, Place::Option(behaviour.option())),
        Fault::AssumedContourPath => (Side::From, Place::Confirmed(CONTOUR_PATH.to_owned())),
        Fault::AssumedContourEnds => (Side::To, Place::Confirmed(CONTOUR_ENDS.to_owned())),
        Fault::AssumedRadius { .. } => {
            let side = if to.caps.compensation.radii.entry { Side::To } else { Side::From };
            (side, Place::Confirmed(RADIUS_IS_ENTRY.to_owned()))
        }
        Fault::AssumedEdge { .. } => {
            let side = if edges(to) { Side::To } else { Side::From };
            (side, Place::Confirmed(EDGE_IS_ENTRY.to_owned()))
        }
        Fault::NotInMap { what, number, name: None } => (Side::From, Place::Name(*what, *number)),
        // The name is that of the tool.
        Fault::NotInMap { what: Numbered::LengthEntry, name: Some(name), .. } => {
            (Side::To, Place::Number(Numbered::Tool, name.to_string()))
        }
        Fault::NotInMap { what, name: Some(name), .. } => (Side::To, Place::Number(*what, name.to_string())),
        _ => return None,
    })
}

fn is_m_code(code: &str) -> bool {
    code.strip_prefix('M').is_some_and(|n| !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit()))
}

/// The key of `[power_on]` for a fact.
fn power_on_key(fact: ModeName) -> &'static str {
    match fact {
        ModeName::Motion => "motion",
        ModeName::Distance => "distance",
        ModeName::Units => "units",
        ModeName::Plane => "plane",
        ModeName::FeedMode => "feed_mode",
        ModeName::ReturnLevel => "return_level",
        ModeName::WorkOffset => "work_offset",
        ModeName::LengthOffset => "length_offset",
        ModeName::OriginShift => "no_origin_shift",
    }
}

/// `O00` and `O0` are one word.
fn row_key(code: &str) -> String {
    match code.as_bytes() {
        [letter, digits @ ..] if !digits.is_empty() && digits.iter().all(|d| *d == b'0') => {
            format!("{}0", *letter as char)
        }
        _ => code.to_owned(),
    }
}

/// Words made into a key.
fn slug(words: &str) -> String {
    let mut key = String::new();
    for c in words.chars() {
        if c.is_ascii_alphanumeric() || c == '_' {
            key.push(c);
        } else if !key.ends_with('-') {
            key.push('-');
        }
    }
    key
}

/// The key under which a profile confirms an assumption.
fn key(fact: &ControlFact) -> String {
    use ControlFact as A;
    let fixed = match fact {
        A::PeckClearance { .. } => "clearance-of-peck-drilling",
        A::BreakLift { .. } => "lift-of-chip-breaking-drilling",
        A::StillBlock => "block-of-a-compensated-contour-that-goes-nowhere",
        A::WaitingTool { .. } => "tool-that-waits-at-the-start",
        A::WordIncrement { .. } => WORD_INCREMENT,
        A::CallersFeed => "F-where-the-subprogram-begins",
        A::CallersUnit { .. } => "unit-of-length-of-its-caller",
        A::NoCycleOfCaller => "a-cycle-of-the-caller-s-where-a-subprogram-that-may-not-move-begins",
        A::ElseIf => "elseif-can-be-worked-out-where-it-is-passed-over",
        A::NoSuchAxes => NO_SUCH_AXES,
        A::OriginWorkOffset { .. } => ORIGIN,
        A::AlarmsEnd => ALARMS,
        A::SwivelRecord { .. } => SWIVEL_RECORD,
        A::QuickCode => "QU-of-an-M-code",
        A::InexactComparison => COMPARISON,
        A::RoundUpNegative => ROUND_UP,
        A::HalfRounded => HALF,
        A::RepeatCount => REPEAT,
        A::MasterSpindle => MASTER_SPINDLE,
        A::ManyVariables { .. } => VARIABLES,
        A::FineShifts => "fine-shifts-of-work-offsets-P_UIFR-FI-",
        A::DeviceValue => DEVICE_VALUE,
        A::NearNumbers | A::NearerNumbers => "numbers-that-are-compared",
        A::WholeRemainder => "numbers-divided-for-a-remainder",
        A::RoundedUp => ROUNDED_UP,
        A::RoundedDown => "what-is-rounded-down",
        A::Divided => "what-is-divided-for-a-remainder",
        A::RoundedIncrements => "increments-that-the-control-rounds",
        A::Orientation { .. } => "orientation-of-the-spindle",
        A::SpindleZero => "zero-of-angles-of-the-spindle",
        A::BoreShift { .. } => "direction-of-the-shift-of-fine-boring",
        A::ToolCodeAtStart { letter, .. } => {
            return format!("{letter}-code-of-the-tool-in-the-spindle-at-the-start");
        }
        A::LengthCodeAtStart { letter, .. } => return format!("{letter}-code-in-force-at-the-start"),
        A::SystemVariable { fact } => return slug(fact),
        A::VariableAtStart { name, .. } => return slug(&format!("variable-{name}-at-the-start")),
        A::ReturnsToCaller { code } => return format!("{code}-goes-back-to-a-program-that-calls-this-one"),
        A::AfterMove { code } => return format!("{code}{AFTER}"),
        A::EndsMain { code } => return format!("{code}-ends-a-main-program"),
        A::Argument { name, .. } => return slug(name),
        A::AutomaticClearance { name, .. } | A::ComputedClearance { name } => {
            return format!("{}{AUTOMATIC}", slug(name));
        }
        A::ComputedRadius { name } => return format!("{}-computed", slug(name)),
        A::AxisAtStart { axis, .. } => return format!("{}-at-the-start", char::from(axis.letter())),
        A::MachineValue { asked } => {
            return slug(&format!("the-machine-s-{asked}-which-the-program-asks-for"));
        }
    };
    fixed.to_owned()
}

const WORD_INCREMENT: &str = "increment-to-which-computed-words-are-rounded";
const NO_SUCH_AXES: &str = "axes-U-V-and-W-which-the-machine-does-not-have";
const ORIGIN: &str = "work-offset-1-which-the-program-overwrites-with-its-origin";
const ALARMS: &str = "alarms-61000-to-61999-and-65000-to-66999";
const COMPARISON: &str = "MD-10280-PROG_FUNCTION_MASK-bit-0";
const VARIABLES: &str = "MD-28050-MM_NUM_R_PARAM";
const ROUND_UP: &str = "ROUNDUP-of-a-negative-number";
const HALF: &str = "half-of-a-negative-number-rounded";
const ROUNDED_UP: &str = "what-is-rounded-up";
const REPEAT: &str = "P-of-REPEAT-computed";
const DEVICE_VALUE: &str = "a-value-that-is-written-to-a-device";

/// Keys of what programs that compute rely on.
const COMPUTING: [&str; 10] = [
    WORD_INCREMENT,
    NO_SUCH_AXES,
    ALARMS,
    COMPARISON,
    VARIABLES,
    ROUND_UP,
    HALF,
    ROUNDED_UP,
    REPEAT,
    DEVICE_VALUE,
];

/// Whether a key of `[confirmed]` names a row of the dictionary, or a reading of it.
pub fn is_reading(key: &str, dialect: &Dialect) -> bool {
    let readings = [
        OFFSET_WITH_Z,
        BARE_NUMBERS,
        CONTOUR_ENDS,
        CONTOUR_PATH,
        CORNERS,
        CORNERS_AT_START,
        EDGE_IS_ENTRY,
        FEED_ON_ARCS,
        MOTION_AT_CYCLES,
        ORIGIN,
        RADIUS_IS_ENTRY,
        TIP,
        TILT,
    ];
    if COMPUTING.contains(&key) {
        return true;
    }
    if readings.contains(&key) || [MASTER_SPINDLE, SWIVEL_RECORD].contains(&key) {
        return true;
    }
    let call = |name: &str| dialect.call_row(name).is_some();
    let code = |name: &str| dialect.code.iter().any(|row| row.code == name);
    if let Some(name) = key.strip_suffix(ORDER) {
        return call(name);
    }
    if let Some(name) = key.strip_suffix(AFTER) {
        return code(name);
    }
    if let Some(name) = key.strip_suffix(AUTOMATIC) {
        return dialect.call.iter().any(|row| row.parameters.iter().any(|p| p.name == name));
    }
    let unsure = |row: &CallRow| row.parameters.iter().any(|p| !p.sure && slug(&p.name) == key);
    if dialect.call.iter().any(unsure) {
        return true;
    }
    let letter = |key: &str| match key.as_bytes() {
        [letter] | [letter, b'0'] => dialect.address_row(*letter).is_some(),
        _ => false,
    };
    let variable = |number: u32| format!("{}{number}", dialect.formula.variable);
    let told = |assumes: &str| !assumes.is_empty() && slug(assumes) == key;
    if dialect.system.iter().any(|row| told(&row.assumes) || variable(row.number) == key) {
        return true;
    }
    let skip = !dialect.block.skip.is_empty() && key == dialect.block.skip;
    code(key) || call(key) || dialect.name_row(key).is_some() || letter(key) || skip
}
