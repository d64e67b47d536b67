//! Blocks as the case study prints them (Aguiar 2023, ch. 5): the G word alone, whole feeds and speeds without a point,
//! and parameters as an array of one object.
//!
//! G25 is printed with feed and speed 0, G80 with feed 0; other patterns and positions of holes are taken as G25. No
//! arc is printed: it keeps the parameters of ncc.

use ncc_dialects::Dialect;
use ncc_frontends::{Word, words};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};
use serde_json::{Map, Number, Value};

use super::super::drive::Stage;
use super::{Block, CALLS, Rotary};

/// Parameters that ncc adds: the kind of a cycle, and which way a grid is passed.
const ADDED: [&str; 2] = ["kind", "serpentine"];

/// Parameters that are printed first, in their order; `f` is the last one.
const FIRST: [&str; 7] = ["x", "y", "z", "r", "i", "j", "k"];

/// A block, printed.
#[derive(Debug, Serialize)]
pub(super) struct Printed<'b> {
    gcode: String,
    function_name: &'b str,
    x0: f64,
    y0: f64,
    z0: f64,
    x1: f64,
    y1: f64,
    z1: f64,
    #[serde(flatten)]
    rotary: Option<Rotary>,
    cut_offset: Option<u32>,
    feed: Number,
    speed: Number,
    tool: i64,
    dx: f64,
    dy: f64,
    dz: f64,
    distance: f64,
    time: f64,
    timestamp: f64,
    parameters: [Parameters<'b>; 1],
}

/// Parameters in the order in which they are printed.
#[derive(Debug)]
struct Parameters<'b>(&'b Map<String, Value>);

impl Serialize for Parameters<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let place = |name: &str| match FIRST.iter().position(|first| *first == name) {
            Some(place) => place,
            None => FIRST.len() + usize::from(name == "f"),
        };
        let mut all: Vec<_> = self.0.iter().filter(|(name, _)| !ADDED.contains(&name.as_str())).collect();
        all.sort_by_key(|(name, _)| place(name));
        let mut map = to.serialize_map(Some(all.len()))?;
        for (name, value) in all {
            match (name.as_str(), value.as_f64()) {
                ("f", Some(feed)) => map.serialize_entry(name, &whole(feed))?,
                _ => map.serialize_entry(name, value)?,
            }
        }
        map.end()
    }
}

impl<'b> Printed<'b> {
    /// A block of a program in this dialect. Before processing, nothing has a way.
    pub(super) fn of(block: &'b Block, stage: Stage, dialect: &Dialect) -> Printed<'b> {
        let name = &*block.function_name;
        let (feed, speed) = match name {
            "START_CYCLE" => (block.feed, block.speed),
            "END_CYCLE" => (0.0, block.speed),
            _ if CALLS.contains(&name) => (0.0, 0.0),
            _ => (block.feed, block.speed),
        };
        let way = |value: f64| if stage == Stage::Before { 0.0 } else { value };
        Printed {
            gcode: g_word(&block.gcode, dialect),
            function_name: name,
            x0: block.x0,
            y0: block.y0,
            z0: block.z0,
            x1: block.x1,
            y1: block.y1,
            z1: block.z1,
            rotary: block.rotary,
            cut_offset: block.cut_offset,
            feed: whole(feed),
            speed: whole(speed),
            tool: block.tool,
            dx: way(block.dx),
            dy: way(block.dy),
            dz: way(block.dz),
            distance: way(block.distance),
            time: block.time,
            timestamp: block.timestamp,
            parameters: [Parameters(&block.parameters)],
        }
    }
}

/// A number without a point where it is whole.
fn whole(value: f64) -> Number {
    match Number::from_f64(value) {
        Some(number) if value.fract() != 0.0 || value.abs() > 1e15 => number,
        _ => Number::from(value as i64),
    }
}

/// The first G word of a block, without leading zeros; empty where there is none.
fn g_word(block: &str, dialect: &Dialect) -> String {
    let mut found = None;
    words(dialect, block.as_bytes(), &mut |word| {
        let text = match word {
            Word::Numbered { letter: b'G', tenths: Some(tenths) } if tenths % 10 == 0 => {
                format!("G{}", tenths / 10)
            }
            Word::Numbered { letter: b'G', tenths: Some(tenths) } => {
                format!("G{}.{}", tenths / 10, tenths % 10)
            }
            Word::Letter(b'G') => "G".to_owned(),
            Word::Numbered { .. } | Word::Letter(_) | Word::Name(_) => return,
        };
        found.get_or_insert(text);
    });
    found.unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_g_word_stands_alone() {
        let of =
            |dialect: &str, block: &str| g_word(block, ncc_dialects::builtin(dialect).expect("built in"));
        for (dialect, block, word) in [
            ("mach9", "G81Z-8.R3.F186", "G81"),
            ("mach9", "GX0.Y108.", "G"),
            ("mach9", "T3M6", ""),
            ("fanuc", "N10 (G54) X1. G01 G41 D1", "G1"),
            ("linuxcnc", "g43.1 z5", "G43.1"),
            ("siemens", "CYCLE81(5,0,2,-8)", ""),
        ] {
            assert_eq!(of(dialect, block), word, "{block}");
        }
    }

    #[test]
    fn whole_numbers_have_no_point() {
        for (value, text) in [(186.0, "186"), (0.0, "0"), (12.5, "12.5"), (-3.0, "-3")] {
            assert_eq!(whole(value).to_string(), text);
        }
    }
}
