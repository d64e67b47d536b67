//! One writer for every dialect: which text form it has is in the dictionary.

use std::collections::{BTreeSet, HashMap};

use ncc_dialects::{Family, Settings};
use ncc_ir::canon::{AXES, Modes};
use ncc_ir::diag::Diagnostic;
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::line_table::LineTable;
use ncc_ir::program::{Procedure, Program, Stmt};

use crate::characters::encode;
use crate::common::Sink;
use crate::common::table::write_table;
use crate::origin::Trace;
use crate::{Characters, Form, Head, Layout, Origin, canon, ir, siemens, word};

/// A writer of any dialect.
pub struct Writer {
    kind: Kind,
    characters: Characters,
}

enum Kind {
    /// Letters and numbers.
    Word(Box<word::Writer>),
    /// The canonical functions.
    Canon(Box<canon::Writer>),
    /// The text form of the IR.
    Ir(Box<ir::Writer>),
    /// The Sinumerik's language.
    Siemens(Box<siemens::Writer>),
}

impl Writer {
    /// A writer at the start of a program.
    pub fn new(settings: Settings, layout: Layout) -> Writer {
        let kind = match settings.dialect.family {
            Family::Word => Kind::Word(Box::new(word::Writer::new(settings, layout))),
            Family::Canon => Kind::Canon(Box::new(canon::Writer::new(settings, layout))),
            Family::Ir => Kind::Ir(Box::new(ir::Writer::new(settings, layout))),
            Family::Sinumerik => Kind::Siemens(Box::new(siemens::Writer::new(settings, layout))),
        };
        Writer { kind, characters: Characters::All }
    }

    /// Records from now on where every line comes from.
    pub fn trace(&mut self) {
        match &mut self.kind {
            Kind::Word(writer) => writer.words.trace(),
            Kind::Siemens(writer) => writer.words.trace(),
            Kind::Canon(writer) => writer.trace = Some(Trace::default()),
            Kind::Ir(writer) => writer.trace = Some(Trace::default()),
        }
    }

    /// Where the lines come from that have been written since this was last asked, in their order. The
    /// head is not among them. Empty if nothing is recorded.
    pub fn take_origins(&mut self) -> Vec<Origin> {
        self.tracing().map(Trace::take).unwrap_or_default()
    }

    fn tracing(&mut self) -> Option<&mut Trace> {
        match &mut self.kind {
            Kind::Word(writer) => writer.words.trace.as_deref_mut(),
            Kind::Siemens(writer) => writer.words.trace.as_deref_mut(),
            Kind::Canon(writer) => writer.trace.as_mut(),
            Kind::Ir(writer) => writer.trace.as_mut(),
        }
    }

    /// More is about to be written; gives where it begins.
    fn begin(&mut self, out: &[u8]) -> usize {
        if let Some(trace) = self.tracing() {
            trace.begin(out.len());
        }
        out.len()
    }

    /// Writes a text as a comment that can stand at the end of a line of its own dialect, with the
    /// blank before it. What one comment cannot hold is cut off. Returns `false`, with nothing
    /// written, where there are no such comments.
    pub fn beside(&mut self, text: &str, out: &mut Vec<u8>) -> bool {
        let start = out.len();
        let written = match &mut self.kind {
            Kind::Word(writer) => writer.words.beside(text, out),
            Kind::Siemens(writer) => writer.words.beside(text, out),
            Kind::Ir(_) => {
                out.extend_from_slice(b" # ");
                out.extend(
                    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect::<String>().bytes(),
                );
                true
            }
            // A call a line, and a comment is a call.
            Kind::Canon(_) => false,
        };
        encode(out, start, self.characters);
        written
    }

    /// Takes a shop's choices for the form of the text, before anything is written.
    pub fn set_form(&mut self, form: Form) {
        self.characters = form.characters;
        match &mut self.kind {
            Kind::Word(writer) => writer.words.set_form(form),
            Kind::Siemens(writer) => writer.words.set_form(form),
            // A call a line: there are no blocks to choose.
            Kind::Canon(_) | Kind::Ir(_) => {}
        }
    }

    /// The source is another control's: a tool change has a block of its own where it is the machine's whether the
    /// axes of its block move before it or after it.
    pub fn changes_apart(&mut self) {
        match &mut self.kind {
            Kind::Word(writer) => writer.words.changes_apart(),
            Kind::Siemens(writer) => writer.words.changes_apart(),
            // A call a line.
            Kind::Canon(_) | Kind::Ir(_) => {}
        }
    }

    /// Says what program it is, of those that compute, before any of it is written, and the places of statements
    /// whose words say their own distance mode, where others rely on the active one. `stands` are modes that are active
    /// where stretches of blocks begin, by the places of their first statements.
    pub fn know(&mut self, program: &Program, word_distance: &BTreeSet<u32>, entries: HashMap<u32, Modes>) {
        match &mut self.kind {
            Kind::Word(writer) => writer.know(program, entries),
            Kind::Siemens(writer) => writer.know(&program.procedures, word_distance, entries),
            // The text form says them all by itself; the other writes no such programs.
            Kind::Canon(_) | Kind::Ir(_) => {}
        }
    }

    /// Says which modes are active where stretches of blocks begin, by the places of their first statements, in a
    /// program that does not compute.
    pub fn know_modes(&mut self, program: &Program, entries: HashMap<u32, Modes>) {
        match &mut self.kind {
            Kind::Word(writer) => writer.words.know_modes(entries),
            Kind::Siemens(writer) => writer.know_modes(&program.procedures, entries),
            // The text form says what is active with every word; the other writes no subprograms.
            Kind::Canon(_) | Kind::Ir(_) => {}
        }
    }

    /// Says that the program is called by another, before any of it is written: what is active is its caller's, and
    /// of that this is assumed. By `name` it is called.
    pub fn stands_alone(&mut self, taken: &Modes, moves_end_cycles: bool, name: &str) {
        match &mut self.kind {
            Kind::Word(writer) => {
                writer.words.stands_alone(taken);
                if writer.has_o_words() {
                    writer.o_alone(name);
                }
            }
            Kind::Siemens(writer) => writer.stands_alone(taken, moves_end_cycles),
            // The text form states nothing by itself; the other writes no such programs.
            Kind::Canon(_) | Kind::Ir(_) => {}
        }
    }

    /// Says where the axes stand before the program starts, in its own frame.
    pub fn stand_at(&mut self, start: &[Option<Nanos>; AXES]) {
        match &mut self.kind {
            Kind::Word(writer) => writer.words.stand_at(start),
            Kind::Siemens(writer) => writer.words.stand_at(start),
            Kind::Canon(writer) => writer.stand_at(start),
            // The text form names no position that the program does not.
            Kind::Ir(_) => {}
        }
    }

    /// Says which tool is in the spindle before the program begins.
    pub fn hold_tool(&mut self, tool: u32) {
        match &mut self.kind {
            Kind::Word(writer) => writer.words.hold_tool(tool),
            Kind::Siemens(writer) => writer.words.hold_tool(tool),
            // These name no tool that the program does not.
            Kind::Canon(_) | Kind::Ir(_) => {}
        }
    }

    /// Writes further statements of the main procedure. `assumed` are the facts assumed
    /// so far.
    pub fn write(&mut self, stmts: &[Stmt], assumed: &Modes, out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        let start = self.begin(out);
        match &mut self.kind {
            Kind::Word(writer) => writer.write(stmts, assumed, out, diags),
            Kind::Siemens(writer) => writer.write(stmts, assumed, out, diags),
            Kind::Canon(writer) => writer.write(stmts, assumed, out, diags),
            Kind::Ir(writer) => writer.write(stmts, assumed, out, diags),
        }
        encode(out, start, self.characters);
    }

    /// Writes further lines of the main procedure; `false`, and then nothing was done, where they are to be written as
    /// statements.
    pub fn table(
        &mut self,
        table: &LineTable,
        assumed: &Modes,
        out: &mut Vec<u8>,
        diags: &mut Vec<Diagnostic>,
    ) -> bool {
        let start = out.len();
        let mut sink = Sink { out, diags };
        let written = match &mut self.kind {
            Kind::Word(writer) => write_table(&mut **writer, table, assumed, &mut sink),
            Kind::Siemens(writer) => write_table(&mut **writer, table, assumed, &mut sink),
            Kind::Canon(_) | Kind::Ir(_) => false,
        };
        encode(out, start, self.characters);
        written
    }

    /// Writes a subprogram, after all of the main procedure.
    pub fn procedure(&mut self, procedure: &Procedure, out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        let start = self.begin(out);
        match &mut self.kind {
            Kind::Word(writer) => writer.procedure(procedure, out, diags),
            Kind::Siemens(writer) => writer.procedure(procedure, out, diags),
            Kind::Canon(writer) => writer.procedure(procedure, out, diags),
            Kind::Ir(writer) => writer.procedure(procedure, out, diags),
        }
        encode(out, start, self.characters);
    }

    /// Writes the end of the text.
    pub fn finish(&mut self, out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        let start = self.begin(out);
        match &mut self.kind {
            Kind::Word(writer) => writer.finish(out, diags),
            Kind::Siemens(writer) => writer.finish(out, diags),
            Kind::Canon(writer) => writer.finish(out, diags),
            Kind::Ir(writer) => writer.finish(out, diags),
        }
        encode(out, start, self.characters);
    }

    /// Writes what goes before all the rest: frame, name, comment.
    pub fn head(&self, head: &Head, out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        let start = out.len();
        match &self.kind {
            Kind::Word(writer) => writer.head(head, out, diags),
            Kind::Siemens(writer) => writer.head(head, out, diags),
            Kind::Canon(writer) => writer.head(head, out, diags),
            Kind::Ir(writer) => writer.head(head, out, diags),
        }
        encode(out, start, self.characters);
    }

    /// Facts that the written text states by itself, once its first event is written.
    pub fn stated(&self) -> Modes {
        match &self.kind {
            Kind::Word(writer) => writer.stated(),
            Kind::Siemens(writer) => writer.words.stated(),
            Kind::Canon(writer) => writer.stated(),
            Kind::Ir(writer) => writer.stated(),
        }
    }
}
