//! Words of a dictionary that are not known, and the known ones that are nearest to them.
//!
//! ```text
//! means = "FLOD_ON"     near it: FLOOD_ON
//! means = "FLOOD_OFF"   near it: FLOOD_ON, COOLANT_OFF
//! ```
//!
//! Not here: the words of a message about it.

use crate::check::CYCLE_KINDS;
use crate::fault::DialectFault;

/// A word that a dictionary cannot have at a place, and those that it can have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownWord<'f> {
    /// What it is.
    pub kind: UnknownKind,
    /// The word.
    pub name: &'f str,
    /// The words of this kind.
    pub among: Vec<&'f str>,
}

/// What an unknown word is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnknownKind {
    /// A meaning.
    Meaning,
    /// The name of a field.
    Field,
    /// A value of a field.
    Value,
    /// The kind of a cycle.
    CycleKind,
}

impl DialectFault {
    /// The word that is not known, if that is the fault.
    pub fn unknown(&self) -> Option<UnknownWord<'_>> {
        let message = match self {
            DialectFault::Form(message) => message,
            DialectFault::NoCycleKind { kind, .. } => {
                let among = CYCLE_KINDS.to_vec();
                return Some(UnknownWord { kind: UnknownKind::CycleKind, name: kind, among });
            }
            DialectFault::NoDefaultValue { name, among } => {
                let among = among.iter().map(String::as_str).collect();
                return Some(UnknownWord { kind: UnknownKind::Value, name, among });
            }
            _ => return None,
        };
        let meaning = message.strip_prefix("no ").and_then(|rest| rest.split_once(": "));
        if let Some((_, name)) = meaning {
            return Some(UnknownWord { kind: UnknownKind::Meaning, name, among: MEANINGS.to_vec() });
        }
        let (kind, rest) = match message.strip_prefix("unknown field `") {
            Some(rest) => (UnknownKind::Field, rest),
            None => (UnknownKind::Value, message.strip_prefix("unknown variant `")?),
        };
        let (name, rest) = rest.split_once('`')?;
        Some(UnknownWord { kind, name, among: rest.split('`').skip(1).step_by(2).collect() })
    }

    /// The field that a row lacks, if that is the fault.
    pub fn missing(&self) -> Option<&str> {
        match self {
            DialectFault::Form(message) => message.strip_prefix("missing field `")?.strip_suffix('`'),
            _ => None,
        }
    }
}

impl UnknownWord<'_> {
    /// The known words that are nearest to it, the nearest first; empty if none is near.
    pub fn near(&self) -> Vec<&str> {
        near(self.name, self.among.iter().copied())
    }
}

/// Most words that are suggested for one.
const MOST: usize = 3;

/// Words that differ from one in a third of its letters at most, the nearest first. If none differs in one letter alone,
/// also those that share a part: `FLOOD_OFF` shares one with `COOLANT_OFF`.
pub fn near<'w>(word: &str, among: impl Iterator<Item = &'w str>) -> Vec<&'w str> {
    let among: Vec<&str> = among.collect();
    let far = (word.len() / 3).max(1);
    let mut found: Vec<(usize, &str)> =
        among.iter().map(|other| (distance(word, other), *other)).filter(|(by, _)| *by <= far).collect();
    found.sort_by_key(|(by, _)| *by);
    let least = found.first().map_or(far, |(by, _)| *by);
    let mut words: Vec<&str> =
        found.into_iter().filter(|(by, _)| *by == least).map(|(_, other)| other).collect();
    if words.is_empty() || least > 1 {
        let parts = |text: &str| -> Vec<String> {
            let long = |part: &&str| part.len() > 2;
            let name = text.split(' ').next().unwrap_or_default();
            name.split(['_', '-']).filter(long).map(str::to_ascii_lowercase).collect()
        };
        let own = parts(word);
        let shares = |other: &&str| parts(other).iter().filter(|part| own.contains(part)).count();
        let mut sharing: Vec<(usize, &str)> =
            among.iter().map(|other| (shares(other), *other)).filter(|(parts, _)| *parts > 0).collect();
        sharing.sort_by_key(|(parts, _)| std::cmp::Reverse(*parts));
        let most = sharing.first().map_or(0, |(parts, _)| *parts);
        for (_, other) in sharing.into_iter().filter(|(parts, _)| *parts == most) {
            if !words.contains(&other) {
                words.push(other);
            }
        }
    }
    words.truncate(MOST);
    words
}

/// Letters that must be put in, left out, replaced or exchanged with their neighbour to make one word of the other;
/// capitals are as small letters.
fn distance(a: &str, b: &str) -> usize {
    let letters = |text: &str| text.to_lowercase().chars().collect::<Vec<_>>();
    let (a, b) = (letters(a), letters(b));
    let mut rows = vec![(0..=b.len()).collect::<Vec<_>>()];
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let change = rows[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut least = change.min(rows[i - 1][j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                least = least.min(rows[i - 2][j - 2] + 1);
            }
            row.push(least);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
}

/// The meanings, those with an argument of many values with one of them.
const MEANINGS: &[&str] = &[
    "STRAIGHT_TRAVERSE",
    "STRAIGHT_FEED",
    "ARC_FEED clockwise",
    "ARC_FEED counterclockwise",
    "SYNCHRONISED_FEED",
    "SYNCHRONISED_FEED back",
    "SYNCHRONISED_FEED clockwise",
    "SYNCHRONISED_FEED counterclockwise",
    "SYNCHRONISED_FEED chuck",
    "DWELL",
    "USE_LENGTH_UNITS mm",
    "USE_LENGTH_UNITS inch",
    "SET_DISTANCE_MODE absolute",
    "SET_DISTANCE_MODE incremental",
    "SELECT_PLANE XY",
    "SELECT_PLANE ZX",
    "SELECT_PLANE YZ",
    "SET_FEED_MODE per-minute",
    "SET_FEED_MODE per-revolution",
    "SET_FEED_MODE inverse-time",
    "SET_RETURN_LEVEL initial",
    "SET_RETURN_LEVEL retract",
    "SET_CENTRE_MODE absolute",
    "SET_CENTRE_MODE incremental",
    "CLEAR_FRAME shift",
    "CLEAR_FRAME rotation",
    "CLEAR_FRAME scale",
    "SET_SHIFT shift",
    "SET_SHIFT local",
    "SET_POSITION",
    "USE_ORIGIN_SHIFT on",
    "USE_ORIGIN_SHIFT off",
    "SET_ROTATION",
    "SET_SCALE",
    "SET_MIRROR",
    "CLEAR_MIRROR",
    "USE_TOOL_CENTRE_POINT on",
    "USE_TOOL_CENTRE_POINT off",
    "SET_TILT",
    "ORIENT_TOOL_AXIS",
    "STRAIGHT_PROBE",
    "STRAIGHT_PROBE or-error",
    "STRAIGHT_PROBE away",
    "STRAIGHT_PROBE away or-error",
    "DETOUR one-side",
    "DETOUR intermediate",
    "USE_MACHINE_COORDINATES",
    "USE_MACHINE_COORDINATES no-length",
    "USE_MACHINE_COORDINATES no-length rapid",
    "GO_TO_REFERENCE home",
    "GO_TO_REFERENCE home keeps-length",
    "GO_TO_REFERENCE further",
    "GO_TO_REFERENCE stored 1",
    "GO_TO_REFERENCE stored 1 keeps-length",
    "GO_TO_REFERENCE stored 2",
    "GO_TO_REFERENCE stored 2 keeps-length",
    "SET_DATA",
    "STORE_POSITION 1",
    "STORE_POSITION 2",
    "SET_TOOL_NUMBER",
    "SET_POLE zero",
    "SET_POLE here",
    "SET_POLE pole",
    "POLAR on",
    "POLAR off",
    "START_CUTTER_RADIUS_COMPENSATION left",
    "START_CUTTER_RADIUS_COMPENSATION right",
    "START_CUTTER_RADIUS_COMPENSATION left by-diameter",
    "START_CUTTER_RADIUS_COMPENSATION right by-diameter",
    "STOP_CUTTER_RADIUS_COMPENSATION",
    "EXACT_STOP",
    "ENABLE_OVERRIDES",
    "DISABLE_OVERRIDES",
    "SET_SPINDLE_MODE turns",
    "SET_SPINDLE_MODE surface",
    "LIMIT_SPINDLE_SPEED",
    "ORIENT_SPINDLE",
    "USE_TOOL_LENGTH_OFFSET",
    "USE_TOOL_LENGTH",
    "ADD_TOOL_LENGTH",
    "USE_TOOL_LENGTH_OFFSET 0",
    "START_CYCLE",
    "END_CYCLE",
    "PATTERN",
    "NO_EFFECT",
    "LEFT_OUT",
    "START_SPINDLE_CLOCKWISE",
    "START_SPINDLE_COUNTERCLOCKWISE",
    "STOP_SPINDLE_TURNING",
    "RIGID_TAPPING",
    "CHANGE_TOOL",
    "FLOOD_ON",
    "MIST_ON",
    "COOLANT_OFF",
    "PROGRAM_STOP",
    "OPTIONAL_PROGRAM_STOP",
    "PROGRAM_END",
    "BEGIN_AGAIN",
    "CALL",
    "CALL_MACRO",
    "CALL_MACRO_AT_MOVES",
    "CALL_MACRO_AT_BLOCKS",
    "END_CALLS_AT_MOVES",
    "RETURN",
    "ARC_THROUGH",
    "ARC_TANGENT",
    "CALL modal",
    "MESSAGE",
    "REPEAT_BLOCKS",
    "REPEAT_BLOCKS one",
    "TURN_ROTARY_AXES shortest",
    "TURN_ROTARY_AXES positive",
    "TURN_ROTARY_AXES negative",
    "END_OF_REPEAT",
    "SET_ORIGIN_OFFSETS 1",
    "ADD_FRAME mirror",
    "ADD_FRAME rotate",
    "ADD_FRAME scale",
    "ADD_FRAME translate",
    "ADVISE acceleration reduced",
    "ADVISE acceleration soft",
    "ADVISE acceleration stepped",
    "ADVISE chip-conveyor forward",
    "ADVISE chip-conveyor stopped",
    "ADVISE compensated-feed centre",
    "ADVISE compensated-feed contour",
    "ADVISE compensated-feed inside",
    "ADVISE compressor cad",
    "ADVISE compressor curves",
    "ADVISE compressor lines",
    "ADVISE compressor off",
    "ADVISE compressor surface",
    "ADVISE contour-control",
    "ADVISE door closed",
    "ADVISE door open",
    "ADVISE dynamics finishing",
    "ADVISE dynamics normal",
    "ADVISE dynamics positioning",
    "ADVISE dynamics roughing",
    "ADVISE dynamics semi-finishing",
    "ADVISE exact-stop-window coarse",
    "ADVISE exact-stop-window fine",
    "ADVISE exact-stop-window set-point",
    "ADVISE feed-forward off",
    "ADVISE feed-forward on",
    "ADVISE feed-override",
    "ADVISE feed-stop",
    "ADVISE high-precision",
    "ADVISE look-ahead",
    "ADVISE orientation machine",
    "ADVISE orientation workpiece",
    "ADVISE path-tolerance",
    "ADVISE read-ahead",
    "ADVISE screen off",
    "ADVISE screen on",
    "ADVISE smoothness",
    "ADVISE speed-override",
    "ADVISE stroke-check off",
    "ADVISE stroke-check on",
    "ADVISE working-area off",
    "ADVISE working-area on",
    "SET_FRAME mirror",
    "SET_FRAME rotate",
    "SET_FRAME scale",
    "SET_FRAME translate",
    "SET_MOTION_CONTROL_MODE axis-tolerances",
    "SET_MOTION_CONTROL_MODE continuous",
    "SET_MOTION_CONTROL_MODE distance",
    "SET_MOTION_CONTROL_MODE dynamics",
    "SET_MOTION_CONTROL_MODE exact-path",
    "SET_MOTION_CONTROL_MODE exact-stop",
    "SET_MOTION_CONTROL_MODE slow-corners",
    "SET_MOTION_CONTROL_MODE tangential",
    "SET_MOTION_CONTROL_MODE tapping",
    "SET_MOTION_CONTROL_MODE within-blocks",
    "MACHINE_FUNCTION pallet change",
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::NameMeaning;

    #[test]
    fn every_meaning_that_is_suggested_is_one() {
        for meaning in MEANINGS {
            assert!(meaning.parse::<NameMeaning>().is_ok(), "{meaning}");
        }
        let of = |text: &str| text.parse::<NameMeaning>().ok();
        for row in crate::builtins().flat_map(|d| &d.code).filter_map(|row| row.means) {
            let text = row.to_string();
            let word = text.split(' ').next().unwrap_or_default();
            let listed = MEANINGS.iter().any(|m| of(m) == of(&text) || m.starts_with(word));
            assert!(listed, "{text}");
        }
    }

    #[test]
    fn a_misspelt_word_has_its_neighbours() {
        let of = |word| near(word, MEANINGS.iter().copied());
        assert_eq!(of("FLOD_ON"), ["FLOOD_ON"]);
        assert_eq!(of("flood_on"), ["FLOOD_ON"]);
        assert_eq!(of("FLOOD_OFF"), ["FLOOD_ON", "COOLANT_OFF"]);
        assert_eq!(of("DWEL"), ["DWELL"]);
        assert_eq!(of("WIBBLE"), [""; 0]);
        assert_eq!(near("lenght", ["length", "angle"].into_iter()), ["length"]);
        assert_eq!(near("M7", ["M07", "M08"].into_iter()), ["M07"]);
    }
}
