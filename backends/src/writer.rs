//! One writer for every dialect: which text form it has is in the dictionary.

use ncc_dialects::{Family, Settings};
use ncc_ir::canon::{AXES, Modes};
use ncc_ir::diag::Diagnostic;
use ncc_ir::num::Nanos;
use ncc_ir::program::{Procedure, Stmt};

use crate::{Head, Layout, canon, ir, siemens, word};

/// A writer of any dialect.
pub enum Writer {
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
        match settings.dialect.family {
            Family::Word => Writer::Word(Box::new(word::Writer::new(settings, layout))),
            Family::Canon => Writer::Canon(Box::new(canon::Writer::new(settings, layout))),
            Family::Ir => Writer::Ir(Box::new(ir::Writer::new(settings, layout))),
            Family::Sinumerik => Writer::Siemens(Box::new(siemens::Writer::new(settings, layout))),
        }
    }

    /// Says where the axes stand before the program starts, in its own frame.
    pub fn stand_at(&mut self, start: &[Option<Nanos>; AXES]) {
        match self {
            Writer::Word(writer) => writer.stand_at(start),
            Writer::Siemens(writer) => writer.stand_at(start),
            Writer::Canon(writer) => writer.stand_at(start),
            // The text form names no position that the program does not.
            Writer::Ir(_) => {}
        }
    }

    /// Writes further statements of the main procedure. `assumed` are the facts taken for granted
    /// so far.
    pub fn write(&mut self, stmts: &[Stmt], assumed: &Modes, out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        match self {
            Writer::Word(writer) => writer.write(stmts, assumed, out, diags),
            Writer::Siemens(writer) => writer.write(stmts, assumed, out, diags),
            Writer::Canon(writer) => writer.write(stmts, assumed, out, diags),
            Writer::Ir(writer) => writer.write(stmts, assumed, out, diags),
        }
    }

    /// Writes a subprogram, after all of the main procedure.
    pub fn procedure(&mut self, procedure: &Procedure, out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        match self {
            Writer::Word(writer) => writer.procedure(procedure, out, diags),
            Writer::Siemens(writer) => writer.procedure(procedure, out, diags),
            Writer::Canon(writer) => writer.procedure(procedure, out, diags),
            Writer::Ir(writer) => writer.procedure(procedure, out, diags),
        }
    }

    /// Writes the end of the text.
    pub fn finish(&mut self, out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        match self {
            Writer::Word(writer) => writer.finish(out, diags),
            Writer::Siemens(writer) => writer.finish(out, diags),
            Writer::Canon(writer) => writer.finish(out, diags),
            Writer::Ir(writer) => writer.finish(out, diags),
        }
    }

    /// Writes what goes before all the rest: frame, name, comment.
    pub fn head(&self, head: &Head, out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        match self {
            Writer::Word(writer) => writer.head(head, out, diags),
            Writer::Siemens(writer) => writer.head(head, out, diags),
            Writer::Canon(writer) => writer.head(head, out, diags),
            Writer::Ir(writer) => writer.head(head, out, diags),
        }
    }

    /// Facts that the written text states by itself, once its first event is written.
    pub fn stated(&self) -> Modes {
        match self {
            Writer::Word(writer) => writer.stated(),
            Writer::Siemens(writer) => writer.stated(),
            Writer::Canon(writer) => writer.stated(),
            Writer::Ir(writer) => writer.stated(),
        }
    }
}
