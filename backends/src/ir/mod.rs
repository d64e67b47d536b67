//! Writer of the `ir` text, the neutral program as it is: nothing is lost, nothing is refused.
//!
//! The form is described at the reader (`ncc_frontends::ir`). Statements of one block stand on one
//! line. Not here: anything that is not in the program.
//!
//! ```text
//! a straight move by 10 mm    `STRAIGHT_FEED(X 10mm)`
//! ```

mod cycle;
mod expr;
mod frame;
mod machine;
mod op;
mod polar;
mod words;

use ncc_dialects::Settings;
use ncc_ir::canon::Modes;
use ncc_ir::diag::Diagnostic;
use ncc_ir::expr::Var;
use ncc_ir::program::{Attribute, Control, Op, Procedure, Stmt, Type};
use ncc_ir::source::Span;

use crate::common::packed::{each_blocks, packed};
use crate::common::quoted::{quote, write_whole};
use crate::origin::Trace;
use crate::{Head, Layout};

/// The version of the text form.
const VERSION: &str = "ncc-ir 1";

/// Writes the `ir` text.
pub struct Writer {
    eol: &'static [u8],
    /// Facts that the text has said were assumed.
    assumed: Modes,
    /// Whether a line is begun, to which a joined statement can be added.
    begun: bool,
    /// Skip level of the statement before.
    skip: Option<u8>,
    /// Where the lines come from, if somebody asked.
    pub(crate) trace: Option<Trace>,
}

impl Writer {
    /// A writer. The text has no numbering of its own: block numbers are part of the program.
    pub fn new(_settings: Settings, layout: Layout) -> Writer {
        let eol = if layout.crlf { b"\r\n".as_slice() } else { b"\n" };
        Writer { eol, assumed: Modes::default(), begun: false, skip: None, trace: None }
    }

    /// Writes statements of the main procedure.
    pub fn write(
        &mut self,
        stmts: &[Stmt],
        assumed: &Modes,
        out: &mut Vec<u8>,
        _diags: &mut Vec<Diagnostic>,
    ) {
        if *assumed != self.assumed {
            self.end_line(out);
            op::assumed(assumed, out);
            out.extend_from_slice(self.eol);
            self.frame(out);
            self.assumed = *assumed;
        }
        self.body(stmts, 0, out);
    }

    /// Writes a subprogram.
    pub fn procedure(&mut self, p: &Procedure, out: &mut Vec<u8>, _diags: &mut Vec<Diagnostic>) {
        self.end_line(out);
        self.skip = None;
        out.extend_from_slice(b"procedure ");
        words::name(&p.name, out);
        if let Some(title) = &p.title {
            out.push(b' ');
            quote(title, out);
        }
        if !p.parameters.is_empty() {
            out.extend_from_slice(b" (");
            self.list(&p.parameters, &p.kinds, out);
            out.push(b')');
        }
        for attribute in &p.attributes {
            out.extend_from_slice(match attribute {
                Attribute::GivesBack => b" gives-back",
                Attribute::RunsThrough => b" runs-through",
                Attribute::NotShown => b" not-shown",
            });
        }
        out.extend_from_slice(b" {");
        out.extend_from_slice(self.eol);
        self.frame(out);
        self.body(&p.body, 1, out);
        self.end_line(out);
        out.push(b'}');
        out.extend_from_slice(self.eol);
        self.frame(out);
    }

    /// Ends the text.
    pub fn finish(&mut self, out: &mut Vec<u8>, _diags: &mut Vec<Diagnostic>) {
        self.end_line(out);
    }

    /// Writes what stands before all the rest.
    pub fn head(&self, head: &Head, out: &mut Vec<u8>, _diags: &mut Vec<Diagnostic>) {
        out.extend_from_slice(VERSION.as_bytes());
        out.extend_from_slice(self.eol);
        for line in &head.lines {
            out.extend_from_slice(b"# ");
            out.extend(
                line.chars().map(|c| if c.is_control() { ' ' } else { c }).collect::<String>().bytes(),
            );
            out.extend_from_slice(self.eol);
        }
        if head.name.number.is_some() || head.name.title.is_some() {
            out.extend_from_slice(b"program");
            if let Some(number) = head.name.number {
                out.push(b' ');
                write_whole(u64::from(number), out);
            }
            if let Some(title) = &head.name.title {
                out.push(b' ');
                quote(title, out);
            }
            out.extend_from_slice(self.eol);
        }
    }

    /// Facts that the text states by itself: none, the program's statements say it all.
    pub fn stated(&self) -> Modes {
        Modes::default()
    }

    fn list(&self, variables: &[Var], kinds: &[Type], out: &mut Vec<u8>) {
        for (place, v) in variables.iter().enumerate() {
            if place > 0 {
                out.extend_from_slice(b", ");
            }
            if let Some(kind) = kinds.get(place) {
                out.extend_from_slice(kind.name().as_bytes());
                out.push(b' ');
            }
            expr::var(v, out);
        }
    }

    fn end_line(&mut self, out: &mut Vec<u8>) {
        if std::mem::take(&mut self.begun) {
            out.extend_from_slice(self.eol);
        }
        self.of_block(out, None);
    }

    /// Notes lines that are over as those of the block at hand; `next` is the place of the block that
    /// is at hand from here.
    fn of_block(&mut self, out: &[u8], next: Option<Span>) {
        if let Some(trace) = &mut self.trace {
            trace.so_far(out);
            if let Some(span) = next {
                trace.leave(Vec::new());
                trace.join(span);
            }
        }
    }

    /// Notes lines that are over as nobody's.
    fn frame(&mut self, out: &[u8]) {
        if let Some(trace) = &mut self.trace {
            trace.frame(out);
        }
    }

    fn body(&mut self, stmts: &[Stmt], depth: usize, out: &mut Vec<u8>) {
        for s in stmts {
            match packed(s) {
                Some(lines) => each_blocks(lines, |blocks| self.body(blocks, depth, out)),
                None => self.stmt(s, depth, out),
            }
        }
    }

    fn stmt(&mut self, s: &Stmt, depth: usize, out: &mut Vec<u8>) {
        if s.joined && self.begun {
            out.extend_from_slice(b" & ");
            if let Some(trace) = &mut self.trace {
                trace.join(s.span);
            }
        } else {
            self.end_line(out);
            self.of_block(out, Some(s.span));
            indent(depth, out);
            out.extend_from_slice(if s.joined { b"& ".as_slice() } else { b"" });
        }
        self.begun = true;
        let inherited = if s.joined { self.skip } else { None };
        if s.skip != inherited {
            out.push(b'/');
            write_whole(u64::from(s.skip.unwrap_or(0)), out);
            out.push(b' ');
        }
        self.skip = s.skip;
        if let Some(number) = s.number {
            out.push(b'N');
            write_whole(u64::from(number), out);
            out.push(b' ');
        }
        op::op(&s.op, out);
        if let Some(comment) = &s.comment {
            out.push(b' ');
            quote(comment, out);
        }
        if let Op::Control(control) = &s.op {
            out.extend_from_slice(b" {");
            match &**control {
                Control::Repeat { body, .. }
                | Control::Loop { body }
                | Control::While { body, .. }
                | Control::Until { body, .. }
                | Control::For { body, .. } => self.inner(body, depth, out),
                Control::If { then, otherwise, .. } => {
                    self.inner(then, depth, out);
                    if !otherwise.is_empty() {
                        self.of_block(out, Some(s.span));
                        indent(depth, out);
                        out.extend_from_slice(b"} else {");
                        self.inner(otherwise, depth, out);
                    }
                }
            }
            self.of_block(out, Some(s.span));
            indent(depth, out);
            out.push(b'}');
            out.extend_from_slice(self.eol);
            self.of_block(out, None);
            // A joined statement that follows begins a line of its own.
            self.begun = false;
        }
    }

    /// The lines between `{` and `}`.
    fn inner(&mut self, body: &[Stmt], depth: usize, out: &mut Vec<u8>) {
        out.extend_from_slice(self.eol);
        self.begun = false;
        self.of_block(out, None);
        self.body(body, depth + 1, out);
        self.end_line(out);
    }
}

fn indent(depth: usize, out: &mut Vec<u8>) {
    out.resize(out.len() + 4 * depth, b' ');
}
