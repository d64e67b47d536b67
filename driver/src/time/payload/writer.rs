//! Writes the document block by block: the whole is never in memory.

use std::io::{self, Write};

use ncc_exec::{Attribute, Exec, Kind};
use ncc_ir::canon::{AXES, Axis};
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::Stmt;
use ncc_time::{Machine, Timed};
use serde_json::{Map, Value};

use super::super::columns::{Columns, Row, micro, units};
use super::super::drive::{Said, Sink, Stage};
use super::super::parameters;
use super::printed::Printed;
use super::{Block, Document, Fields, Header, Look, Rotary, Shape};
use crate::render::events;

/// Writes the document.
pub struct Writer<'m, W: Write> {
    machine: &'m Machine,
    columns: Columns,
    look: Look,
    any: bool,
    /// Feed active.
    feed: f64,
    /// The text of a block: its many small pieces go out as one.
    text: Vec<u8>,
    out: W,
}

impl<'m, W: Write> Writer<'m, W> {
    /// Writes what stands before the blocks.
    pub fn new(header: &Header, machine: &'m Machine, look: Look, mut out: W) -> io::Result<Writer<'m, W>> {
        if look.shape == Shape::Lines {
            serde_json::to_writer(&mut out, header)?;
            out.write_all(b"\n")?;
        } else {
            out.write_all(b"{\n")?;
            for (key, value) in [
                ("prog_name", header.prog_name),
                ("machine_name", header.machine_name),
                ("dialect", header.dialect),
            ] {
                write!(out, "  \"{key}\": ")?;
                serde_json::to_writer(&mut out, value)?;
                out.write_all(b",\n")?;
            }
            out.write_all(b"  \"blocks\": [")?;
        }
        Ok(Writer {
            machine,
            columns: Columns::default(),
            look,
            any: false,
            feed: 0.0,
            text: Vec::new(),
            out,
        })
    }

    /// Writes what stands after the blocks.
    pub fn finish(&mut self) -> io::Result<()> {
        if self.look.shape == Shape::Document {
            self.out.write_all(b"\n  ]\n}\n")?;
        }
        self.out.flush()
    }

    fn block(&mut self, block: &Block) -> io::Result<()> {
        self.text.clear();
        if self.look.shape == Shape::Document {
            self.text.extend_from_slice(if self.any { b",\n    " } else { b"\n    " });
        }
        self.any = true;
        match self.look.fields {
            Fields::Full => serde_json::to_writer(&mut self.text, block)?,
            Fields::Printed(dialect) => {
                serde_json::to_writer(&mut self.text, &Printed::of(block, self.look.stage, dialect))?;
            }
        }
        if self.look.shape == Shape::Lines {
            self.text.push(b'\n');
        }
        self.out.write_all(&self.text)
    }
}

/// Writes a document that was read back, with these fields and under this name of its machine. In the printed form, nothing
/// has a way before processing.
///
/// # Errors
/// Writing.
pub fn write(document: &Document, machine_name: &str, fields: Fields, out: impl Write) -> io::Result<()> {
    let header = Header { prog_name: &document.prog_name, machine_name, dialect: &document.dialect };
    let stage = if document.processed().is_ok() { Stage::After } else { Stage::Before };
    let machine = Machine::default();
    let look = Look { shape: Shape::Document, stage, fields };
    let mut writer = Writer::new(&header, &machine, look, out)?;
    document.blocks.iter().try_for_each(|block| writer.block(block))?;
    writer.finish()
}

/// A block without times, between two points of the program.
fn block<'b>(gcode: &'b str, row: &Row, from: &[Nanos; AXES], to: &[Nanos; AXES]) -> Block<'b> {
    let [f, t] = [from, to].map(|p| p.map(|n| micro(units(n))));
    let turns = Axis::ALL.into_iter().any(|a| a.is_rotary() && (f[a as usize], t[a as usize]) != (0.0, 0.0));
    let rotary = Rotary { a0: f[3], b0: f[4], c0: f[5], a1: t[3], b1: t[4], c1: t[5] };
    Block {
        gcode: gcode.into(),
        function_name: row.name.into(),
        x0: f[0],
        y0: f[1],
        z0: f[2],
        x1: t[0],
        y1: t[1],
        z1: t[2],
        rotary: turns.then_some(rotary),
        cut_offset: None,
        feed: micro(row.feed),
        speed: micro(row.speed),
        tool: row.tool,
        dx: micro(units(to[0] - from[0])),
        dy: micro(units(to[1] - from[1])),
        dz: micro(units(to[2] - from[2])),
        distance: micro(row.distance),
        time: 0.0,
        timestamp: 0.0,
        parameters: Map::new(),
    }
}

impl<W: Write> Sink for Writer<'_, W> {
    fn wants_blocks(&self) -> bool {
        true
    }

    fn function(&mut self, timed: &Timed, said: &Said) -> io::Result<()> {
        let Some(row) = self.columns.row(timed, self.machine) else { return Ok(()) };
        let act = &timed.act;
        if let Kind::Attribute(Attribute::FeedRate(feed)) = &act.event.kind {
            self.feed = units(*feed);
        }
        let mut block = block(&said.block, &row, &act.program_from, &act.program_to);
        block.cut_offset = act.cut_offset;
        if self.look.stage == Stage::After {
            block.time = micro(timed.duration);
            block.timestamp = micro(timed.end());
        }
        block.parameters = match &act.event.kind {
            Kind::Arc { .. } => parameters::arc(act),
            Kind::Dwell(seconds) => parameters::one("seconds", micro(units(*seconds)).into()),
            Kind::Orient(angle) => parameters::one("angle", micro(units(*angle)).into()),
            Kind::Output(written) => parameters::one("written", events::written(written).into()),
            Kind::Alarm(_, text) | Kind::Message(text) => parameters::one("text", (&**text).into()),
            Kind::Traverse
            | Kind::Feed
            | Kind::Probe { .. }
            | Kind::Synchronised { .. }
            | Kind::ToolChange
            | Kind::Coolant
            | Kind::MachineFunction(_)
            | Kind::Data(_)
            | Kind::Tilt(_)
            | Kind::OrientToolAxis(_)
            | Kind::ProgramStop
            | Kind::OptionalProgramStop
            | Kind::ProgramEnd
            | Kind::BeginAgain
            | Kind::TextEnd
            | Kind::Attribute(_) => Map::new(),
        };
        self.block(&block)
    }

    fn called(&mut self, stmt: &Stmt, exec: &Exec, gcode: &str) -> io::Result<()> {
        let (name, parameters) = parameters::of(&stmt.op, exec);
        if let Some(feed) = parameters.get("f").and_then(Value::as_f64) {
            self.feed = feed;
        }
        let row = self.columns.called(name, self.feed);
        let here = exec.position();
        let mut block = block(gcode, &row, &here, &here);
        block.cut_offset = exec.length_entry();
        block.parameters = parameters;
        self.block(&block)
    }
}
