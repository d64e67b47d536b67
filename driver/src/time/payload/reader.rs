//! Reads the document back, of either form and either stage.
//!
//! Every field must be there, and no other; functions are those that ncc writes. Not here: what is made of the blocks.

use std::borrow::Cow;
use std::fmt;

use serde::Deserialize;
use serde::de::{self, Deserializer, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value};

use super::refusal::{NotProcessed, Unread};
use super::{Block, CALLS, Document, Rotary};

/// Functions that occur after processing.
const FUNCTIONS: [&str; 29] = [
    "SELECT_TOOL",
    "CHANGE_TOOL",
    "SET_SPINDLE_SPEED",
    "START_SPINDLE_CLOCKWISE",
    "START_SPINDLE_COUNTERCLOCKWISE",
    "STOP_SPINDLE_TURNING",
    "SET_DATA",
    "FLOOD_ON",
    "MIST_ON",
    "COOLANT_OFF",
    "SET_FEED_RATE",
    "STRAIGHT_TRAVERSE",
    "STRAIGHT_FEED",
    "ARC_FEED",
    "DWELL",
    "SYNCHRONISED_FEED",
    "STRAIGHT_PROBE",
    "ORIENT_SPINDLE",
    "MACHINE_FUNCTION",
    "SET_TILT",
    "CLEAR_FRAME",
    "ORIENT_TOOL_AXIS",
    "MESSAGE",
    "OUTPUT",
    "ALARM",
    "PROGRAM_STOP",
    "OPTIONAL_PROGRAM_STOP",
    "PROGRAM_END",
    "BEGIN_AGAIN",
];

/// Reads a document.
///
/// # Errors
/// It is no JSON, or not of this form.
pub fn read(text: &[u8]) -> Result<Document, Unread> {
    serde_json::from_slice(text).map_err(unread)
}

/// Reads blocks alone, as a list.
///
/// # Errors
/// It is no JSON, or not of this form.
pub fn read_blocks(text: &[u8]) -> Result<Vec<Block<'static>>, Unread> {
    serde_json::from_slice(text).map_err(unread)
}

fn unread(error: serde_json::Error) -> Unread {
    let reason = error.to_string();
    // The place is a field of its own.
    let end = reason.rfind(" at line ").unwrap_or(reason.len());
    Unread { line: error.line(), column: error.column(), reason: reason[..end].to_owned() }
}

/// A block as it is read.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Read {
    gcode: String,
    #[serde(deserialize_with = "function")]
    function_name: Cow<'static, str>,
    x0: f64,
    y0: f64,
    z0: f64,
    x1: f64,
    y1: f64,
    z1: f64,
    a0: Option<f64>,
    b0: Option<f64>,
    c0: Option<f64>,
    a1: Option<f64>,
    b1: Option<f64>,
    c1: Option<f64>,
    // Null where it is an edge, but there.
    #[serde(deserialize_with = "Option::deserialize")]
    cut_offset: Option<u32>,
    #[serde(deserialize_with = "from_zero")]
    feed: f64,
    #[serde(deserialize_with = "from_zero")]
    speed: f64,
    tool: u32,
    dx: f64,
    dy: f64,
    dz: f64,
    #[serde(deserialize_with = "from_zero")]
    distance: f64,
    #[serde(deserialize_with = "from_zero")]
    time: f64,
    #[serde(deserialize_with = "from_zero")]
    timestamp: f64,
    #[serde(deserialize_with = "parameters")]
    parameters: Map<String, Value>,
}

impl TryFrom<Read> for Block<'_> {
    type Error = &'static str;

    fn try_from(read: Read) -> Result<Self, &'static str> {
        let rotary = match (read.a0, read.b0, read.c0, read.a1, read.b1, read.c1) {
            (None, None, None, None, None, None) => None,
            (Some(a0), Some(b0), Some(c0), Some(a1), Some(b1), Some(c1)) => {
                Some(Rotary { a0, b0, c0, a1, b1, c1 })
            }
            _ => return Err("missing field: a0, b0, c0, a1, b1, c1"),
        };
        Ok(Block {
            gcode: read.gcode.into(),
            function_name: read.function_name,
            x0: read.x0,
            y0: read.y0,
            z0: read.z0,
            x1: read.x1,
            y1: read.y1,
            z1: read.z1,
            rotary,
            cut_offset: read.cut_offset,
            feed: read.feed,
            speed: read.speed,
            tool: read.tool.into(),
            dx: read.dx,
            dy: read.dy,
            dz: read.dz,
            distance: read.distance,
            time: read.time,
            timestamp: read.timestamp,
            parameters: read.parameters,
        })
    }
}

impl Document {
    /// Whether it has been processed: no cycle stands as it is called, and what moves takes time.
    ///
    /// # Errors
    /// The first block that shows that it was not.
    pub fn processed(&self) -> Result<(), NotProcessed> {
        let call = self.blocks.iter().position(|block| CALLS.contains(&&*block.function_name));
        let timed = self.blocks.iter().any(|block| block.timestamp > 0.0);
        let first = call.or_else(|| self.blocks.iter().position(Block::moves).filter(|_| !timed));
        first.map_or(Ok(()), |place| Err(NotProcessed(place)))
    }
}

impl Block<'_> {
    /// Whether an axis is elsewhere after it.
    fn moves(&self) -> bool {
        let turned = |r: &Rotary| [r.a0, r.b0, r.c0] != [r.a1, r.b1, r.c1];
        [self.x0, self.y0, self.z0] != [self.x1, self.y1, self.z1] || self.rotary.as_ref().is_some_and(turned)
    }
}

/// The name of a function.
fn function<'de, D: Deserializer<'de>>(from: D) -> Result<Cow<'static, str>, D::Error> {
    struct Named;
    impl Visitor<'_> for Named {
        type Value = &'static str;

        fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
            out.write_str("function")
        }

        fn visit_str<E: de::Error>(self, name: &str) -> Result<&'static str, E> {
            let known = FUNCTIONS.iter().chain(&CALLS).find(|known| **known == name);
            known.copied().ok_or_else(|| E::unknown_variant(name, &FUNCTIONS))
        }
    }
    from.deserialize_str(Named).map(Cow::Borrowed)
}

/// Parameters: an object, or an array of one.
fn parameters<'de, D: Deserializer<'de>>(from: D) -> Result<Map<String, Value>, D::Error> {
    struct Either;
    impl<'de> Visitor<'de> for Either {
        type Value = Map<String, Value>;

        fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
            out.write_str("parameters")
        }

        fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
            Map::deserialize(de::value::MapAccessDeserializer::new(map))
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut all: A) -> Result<Self::Value, A::Error> {
            let first = all.next_element()?.ok_or_else(|| de::Error::invalid_length(0, &self))?;
            match all.next_element::<de::IgnoredAny>()? {
                None => Ok(first),
                Some(_) => Err(de::Error::invalid_length(2, &self)),
            }
        }
    }
    from.deserialize_any(Either)
}

/// A number that is not negative.
fn from_zero<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    let value = f64::deserialize(from)?;
    match value >= 0.0 {
        // No minus zero.
        true => Ok(value.abs()),
        false => Err(de::Error::invalid_value(de::Unexpected::Float(value), &">= 0")),
    }
}
