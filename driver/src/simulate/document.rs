//! A simulation as one JSON document; its form is in `driver/schema/simulate.schema.json`.

use std::collections::BTreeMap;
use std::io::{self, Write};

use ncc_simulate::{Fixture, Shape, Stock};
use serde::Serialize;

use super::compare::Between;
use super::cut::CutProgram;
use super::surroundings::Surroundings;
use super::told::message;
use super::tooling::{Fitted, Known};
use crate::render::Told;
use crate::render::json::JsonPlace;
use crate::render::messages::message::Value;

/// The version of the document's form.
const VERSION: u32 = 1;

/// The JSON Schema of the document.
pub const SCHEMA: &str = include_str!("../../schema/simulate.schema.json");

/// What is said of a program besides what was cut.
#[derive(Clone, Copy, Debug)]
pub struct About<'a> {
    /// The name of its source.
    pub source: &'a str,
    /// Its dialect.
    pub dialect: &'a str,
    /// What its execution assumes, a line each.
    pub assumed: &'a [String],
    /// What lies around the part.
    pub around: &'a Surroundings,
}

#[derive(Serialize)]
struct Document<'a> {
    version: u32,
    tool: Ncc,
    programs: Vec<Program<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    between: Option<Difference>,
}

#[derive(Serialize)]
struct Ncc {
    name: &'static str,
    version: &'static str,
}

#[derive(Serialize)]
struct Program<'a> {
    source: &'a str,
    dialect: &'a str,
    /// Seconds.
    time: f64,
    moves: usize,
    units: &'static str,
    raw: Raw,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    fixtures: Vec<Held>,
    zeros: Vec<Zero<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    travel: Option<[[f64; 3]; 2]>,
    /// Axes of the tilted planes, as rows of matrices.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    tilts: Vec<[[f64; 3]; 3]>,
    tools: Vec<Tool>,
    /// mm³.
    removed: f64,
    /// mm³.
    undercut: f64,
    alarms: Vec<Alarm>,
    assumed: &'a [String],
}

#[derive(Serialize)]
struct Raw {
    form: &'static str,
    low: [f64; 3],
    high: [f64; 3],
    guessed: bool,
    cells: [usize; 2],
    cell: f64,
}

#[derive(Serialize)]
struct Held {
    name: String,
    form: &'static str,
    low: [f64; 3],
    high: [f64; 3],
}

#[derive(Serialize)]
struct Zero<'a> {
    name: &'a str,
    at: [f64; 3],
}

#[derive(Serialize)]
struct Tool {
    number: Option<i64>,
    shape: &'static str,
    diameter: f64,
    known: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<u32>,
    shape_guessed: bool,
    #[serde(flatten)]
    detail: Detail,
    /// Radius and height above the tip.
    outline: Vec<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    flute: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    shank: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    holder: Option<[f64; 2]>,
    removed: f64,
    cutting: f64,
    depth: f64,
}

/// What a shape has besides its diameter, as profiles have it: mm and degrees.
#[derive(Default, Serialize)]
struct Detail {
    #[serde(skip_serializing_if = "Option::is_none")]
    corner: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    angle: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    end_diameter: Option<f64>,
}

#[derive(Serialize)]
struct Alarm {
    id: String,
    kind: &'static str,
    severity: &'static str,
    message: String,
    entry: String,
    values: BTreeMap<&'static str, Value>,
    place: JsonPlace,
    advice: Vec<String>,
    tool: Option<i64>,
    /// Numbers of the first and the last move.
    moves: [u32; 2],
    /// Seconds, of the end of the first move.
    time: f64,
    at: [f64; 3],
    depth: f64,
    guessed: bool,
}

#[derive(Serialize)]
struct Difference {
    more: f64,
    less: f64,
    above: Option<Place>,
    below: Option<Place>,
    tolerance: f64,
    same: bool,
}

#[derive(Serialize)]
struct Place {
    at: [f64; 2],
    by: f64,
}

/// A length to a millionth: computers differ in what is finer.
fn micro(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

/// A volume to a thousandth: it is a sum in single precision.
fn milli(value: f64) -> f64 {
    (value * 1e3).round() / 1e3
}

/// The name of a shape, as profiles have it.
fn shape(own: &Shape) -> &'static str {
    match own {
        Shape::Flat => "flat",
        Shape::Ball => "ball",
        Shape::BullNose { .. } => "bull-nose",
        Shape::Drill { .. } => "drill",
        Shape::Chamfer { .. } => "chamfer",
        Shape::Taper { .. } => "taper",
        Shape::Profile(_) => "profile",
        Shape::Lollipop => "lollipop",
        Shape::TSlot => "t-slot",
    }
}

/// The rest of a shape that is no guess; a corner or an end of no size is none.
fn detail(own: &Fitted) -> Detail {
    let size = |value: f64| Some(micro(value)).filter(|value| *value > 0.0);
    match own.shape {
        _ if own.shape_guessed => Detail::default(),
        Shape::BullNose { corner } => Detail { corner: size(corner), ..Detail::default() },
        Shape::Drill { point } => Detail { angle: size(point), ..Detail::default() },
        Shape::Chamfer { tip, angle } => {
            Detail { angle: size(angle), end_diameter: size(tip), ..Detail::default() }
        }
        Shape::Taper { corner, angle } => {
            Detail { corner: size(corner), angle: size(angle), ..Detail::default() }
        }
        Shape::Flat | Shape::Ball | Shape::Profile(_) | Shape::Lollipop | Shape::TSlot => Detail::default(),
    }
}

/// The form of a body.
fn form(body: &Stock) -> &'static str {
    match body {
        Stock::Block { .. } => "block",
        Stock::Cylinder { .. } => "cylinder",
        Stock::Body(_) => "body",
    }
}

fn held(own: &Fixture) -> Held {
    let [low, high] = own.shape.extent().map(|corner| corner.map(micro));
    Held { name: own.name.clone(), form: form(&own.shape), low, high }
}

/// A tool's number, if it has one.
fn number(number: i64) -> Option<i64> {
    (number >= 0).then_some(number)
}

fn program<'a>(about: About<'a>, cut: &CutProgram, told: &[Told]) -> Program<'a> {
    let setup = cut.simulation.setup();
    let [low, high] = setup.stock.extent().map(|corner| corner.map(micro));
    let grid = cut.simulation.map().grid;
    let tools = cut.path.tools.iter().zip(&cut.tools).zip(&cut.worked);
    let tools = tools.map(|((used, own), worked)| {
        let (known, line) = match own.known {
            Known::Stated => ("stated", None),
            Known::Profile => ("profile", None),
            Known::Comment(line) => ("comment", Some(line)),
            Known::Guess => ("guess", None),
        };
        Tool {
            number: number(used.number),
            shape: shape(&own.shape),
            diameter: micro(own.diameter),
            known,
            line,
            shape_guessed: own.shape_guessed,
            detail: detail(own),
            outline: own.tool.cutter.outline().into_iter().map(|point| point.map(micro)).collect(),
            flute: own.tool.flute.map(micro),
            shank: own.tool.shank.map(|radius| micro(radius * 2.0)),
            holder: own.tool.holder.map(|[radius, from]| [micro(radius * 2.0), micro(from)]),
            removed: milli(worked.volume),
            cutting: micro(worked.cutting),
            depth: micro(worked.depth),
        }
    });
    let alarms = cut.alarms().iter().zip(told).map(|(alarm, told)| {
        let message = message(alarm, cut);
        Alarm {
            id: told.code.clone(),
            kind: alarm.kind.name(),
            severity: if alarm.guessed { "warning" } else { "error" },
            message: message.headline(),
            entry: message.entry(),
            values: message.values(),
            place: told.place.clone().into(),
            advice: told.advice.clone(),
            tool: number(cut.path.tools[alarm.tool].number),
            moves: [alarm.first, alarm.last],
            time: micro(alarm.time),
            at: alarm.place.map(micro),
            depth: micro(alarm.depth),
            guessed: alarm.guessed,
        }
    });
    Program {
        source: about.source,
        dialect: about.dialect,
        time: micro(cut.path.end),
        moves: cut.simulation.moves().len(),
        units: if cut.path.inch { "inch" } else { "mm" },
        raw: Raw {
            form: form(&setup.stock),
            low,
            high,
            guessed: setup.guessed,
            cells: grid.cells,
            cell: micro(grid.cell),
        },
        fixtures: setup.fixtures.iter().map(held).collect(),
        zeros: about.around.zeros.iter().map(|(name, at)| Zero { name, at: at.map(micro) }).collect(),
        travel: about.around.travel.map(|ends| ends.map(|end| end.map(micro))),
        tilts: setup.tilts.iter().map(|axes| axes.map(|row| row.map(micro))).collect(),
        tools: tools.collect(),
        removed: milli(cut.volume()),
        undercut: milli(cut.simulation.map().hollows_above(cut.simulation.setup().stock.extent()[0][2])),
        alarms: alarms.collect(),
        assumed: about.assumed,
    }
}

/// Writes the document of some programs, and what lies between two of them with a tolerance in mm.
///
/// # Errors
/// Writing.
pub fn write(
    out: &mut dyn Write,
    programs: &[(About, &CutProgram, &[Told])],
    between: Option<(Between, f64)>,
) -> io::Result<()> {
    let place =
        |most: Option<([f64; 2], f64)>| most.map(|(at, by)| Place { at: at.map(micro), by: micro(by) });
    let document = Document {
        version: VERSION,
        tool: Ncc { name: "ncc", version: env!("CARGO_PKG_VERSION") },
        programs: programs.iter().map(|(about, cut, told)| program(*about, cut, told)).collect(),
        between: between.map(|(between, tolerance)| Difference {
            more: milli(between.more),
            less: milli(between.less),
            above: place(between.highest),
            below: place(between.deepest),
            tolerance,
            same: between.is_within(tolerance),
        }),
    };
    serde_json::to_writer_pretty(&mut *out, &document)?;
    out.write_all(b"\n")
}
