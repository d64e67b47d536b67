//! The case study's JSON document: every function as a block, in two stages and two forms.
//!
//! Before processing, cycles and patterns are blocks with their parameters, and nothing has a time;
//! after it they are the moves that they stand for, and every block has its time. The form of ncc has
//! whole blocks of the source and more parameters; the printed form is that of the case study to the
//! letter (Aguiar 2023, ch. 5). `schema/payload.schema.json` describes both.
//!
//! ```text
//! G25X30.Y130.I2J2    {"gcode":"G25","function_name":"RECTANGULAR_LAYOUT", … "feed":0,"speed":0,"tool":3, …}
//! ```
//!
//! `writer` makes it of a program that runs, `reader` reads it back. Not here: times.

mod printed;
mod reader;
mod refusal;
mod writer;

use std::borrow::Cow;

use ncc_dialects::Dialect;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::drive::Stage;

pub use reader::{read, read_blocks};
pub use refusal::{NotProcessed, Unread};
pub use writer::{Writer, write};

/// The JSON Schema of the document and of the lines of its long form.
pub const SCHEMA: &str = include_str!("../../../schema/payload.schema.json");

/// Functions that occur before processing only: a cycle, its end, and where it makes holes.
const CALLS: [&str; 7] = [
    "START_CYCLE",
    "HOLE",
    "CIRCLE_PATTERN",
    "LINE_PATTERN",
    "POSITION_LIST",
    "RECTANGULAR_LAYOUT",
    "END_CYCLE",
];

/// What stands at the top.
#[derive(Clone, Debug, Serialize)]
pub struct Header<'h> {
    /// The program's name.
    pub prog_name: &'h str,
    /// The machine's name: its title, in the printed form the short name of its profile.
    pub machine_name: &'h str,
    /// The name of the program's dialect.
    pub dialect: &'h str,
}

/// A block. Positions are the program's, mm; rotary axes, degrees, where the program moves any.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "reader::Read")]
pub struct Block<'b> {
    /// The block of the source; in the printed form its G word alone.
    pub gcode: Cow<'b, str>,
    /// Canonical function.
    pub function_name: Cow<'b, str>,
    /// Position before it.
    pub x0: f64,
    #[allow(missing_docs)]
    pub y0: f64,
    #[allow(missing_docs)]
    pub z0: f64,
    /// Position after it.
    pub x1: f64,
    #[allow(missing_docs)]
    pub y1: f64,
    #[allow(missing_docs)]
    pub z1: f64,
    /// Rotary axes before and after it; all six, or none.
    #[serde(flatten)]
    pub rotary: Option<Rotary>,
    /// Entry of the table of lengths; `None` is an edge of the tool.
    pub cut_offset: Option<u32>,
    /// mm/min.
    pub feed: f64,
    /// rev/min.
    pub speed: f64,
    /// Tool, 0 where none is known.
    pub tool: i64,
    /// Change of position.
    pub dx: f64,
    #[allow(missing_docs)]
    pub dy: f64,
    #[allow(missing_docs)]
    pub dz: f64,
    /// Length of the way, mm.
    pub distance: f64,
    /// Seconds that it takes.
    pub time: f64,
    /// Seconds from the start to its end.
    pub timestamp: f64,
    /// What it has besides.
    pub parameters: Map<String, Value>,
}

/// Rotary axes, degrees.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[allow(missing_docs, reason = "before and after the function")]
pub struct Rotary {
    pub a0: f64,
    pub b0: f64,
    pub c0: f64,
    pub a1: f64,
    pub b1: f64,
    pub c1: f64,
}

/// A document that was read back.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Document {
    /// The program's name.
    pub prog_name: String,
    /// The machine's name.
    pub machine_name: String,
    /// The name of the program's dialect.
    pub dialect: String,
    /// Its functions, in their order.
    pub blocks: Vec<Block<'static>>,
}

/// How blocks stand in the output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One document with all of them.
    Document,
    /// One block a line, and nothing around them.
    Lines,
}

/// Which fields blocks have.
#[derive(Clone, Copy, Debug)]
pub enum Fields {
    /// Those of ncc.
    Full,
    /// Those of the case study, of a program in this dialect.
    Printed(&'static Dialect),
}

/// How the document is written.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// The document, or its lines.
    pub shape: Shape,
    /// Before or after processing.
    pub stage: Stage,
    /// In which form.
    pub fields: Fields,
}

impl Look {
    /// The document after processing, in the form of ncc.
    pub const DOCUMENT: Look = Look { shape: Shape::Document, stage: Stage::After, fields: Fields::Full };
}
