//! Reader of the `ir` text, the neutral program as it is.
//!
//! ```text
//! ncc-ir 1
//! # a note, not part of the program
//! program 1002 "TESTE"
//! assumed(units mm, plane XY)
//! N10 SELECT_TOOL(1) & CHANGE_TOOL() "a comment of the block"
//! /2 said STRAIGHT_TRAVERSE(X -15.mm, Y inc 3.mm, C entry 90.deg)
//! STRAIGHT_FEED(Z -8.mm)
//! ARC_FEED(XY, clockwise, X 1.mm, centre(start, I 0.5mm), turns 1)
//! START_CYCLE(drill, XY, retract 3.mm, depth -8.mm, return retract, raise-first, feed 186.mm)
//! HOLE(X 0.mm)
//! while local:i < 3 {
//!     local:i = local:i + 1
//! }
//! procedure 7 "title" (local:a) {
//!     RETURN()
//! }
//! ```
//!
//! A line holds statements of one block, joined by `&`; a line that begins with `&` goes on with the
//! block before. Statements outside of procedures are the main procedure's. A coordinate is absolute
//! unless marked `inc`, or `entry` for the mode that the caller has active. A number carries its
//! unit: `mm`, `in`, `deg`, `s`, `u` for the unit of length active, none for a pure number. `said`
//! marks a block that writes its motion code itself. A joined statement has the skip level of the
//! statement before it, unless it has its own; `/0` is none.
//!
//! Each line is parsed on its own, so that after a fault the next line is read as if nothing had
//! happened. Not here: whether the program makes sense.

use ncc_dialects::Settings;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::program::{Control, Op, Procedure, Stmt};
use ncc_ir::source::Span;
use ncc_ir::syntax::{Expected, Found};
use ncc_ir::unsupported::TextUnsupported;
use ncc_ir_text::{Line, parse};

use crate::batch::Batch;

/// The version of the text form that is read and written.
const VERSION: u32 = 1;

/// Most bodies inside each other.
const DEPTH: usize = 100;

/// Reads the `ir` text.
pub struct Reader {
    /// Whether this is a user's text, which must say its version.
    strict: bool,
    /// Whether a line with anything on it was read.
    begun: bool,
    /// Whether any statement or fault was found.
    found: bool,
    /// Skip level of the statement before.
    skip: Option<u8>,
    /// Bodies that are open.
    open: Vec<Frame>,
    /// One past the last byte read.
    end: u32,
}

/// An open body.
#[derive(Debug)]
struct Frame {
    opened: Span,
    owner: Owner,
    body: Vec<Stmt>,
}

/// What a body belongs to.
#[derive(Debug)]
enum Owner {
    Procedure(Procedure),
    Control(Stmt),
    /// The other branch of an `if`, with the first one.
    Otherwise(Stmt, Vec<Stmt>),
    /// A line that was refused: the body is dropped.
    Refused,
}

impl Reader {
    /// A reader. A user's text (`assume`) must begin with its version.
    pub fn new(_settings: Settings, assume: bool) -> Reader {
        Reader { strict: assume, begun: !assume, found: false, skip: None, open: Vec::new(), end: 0 }
    }

    /// Reads whole lines; `base` is the place of their first byte.
    pub fn read(&mut self, text: &[u8], base: u32, out: &mut Batch) {
        let mut at = base;
        for line in text.split_inclusive(|&b| b == b'\n') {
            let length = line.len() as u32;
            let line = line.strip_suffix(b"\n").unwrap_or(line);
            self.line(line.strip_suffix(b"\r").unwrap_or(line), at, out);
            at = at.wrapping_add(length);
        }
        self.end = at;
    }

    /// The end of the text.
    pub fn finish(&mut self, out: &mut Batch) {
        for frame in std::mem::take(&mut self.open) {
            if !matches!(frame.owner, Owner::Refused) {
                let fault = Fault::Syntax { found: Found::EndOfText, expected: "`}`".into() };
                let mut diagnostic = Diagnostic::new(fault, frame.opened);
                diagnostic.related.push(Span::new(self.end, self.end));
                out.diagnostics.push(diagnostic);
            }
        }
        if self.strict && !self.found {
            out.diagnostics.push(Diagnostic::new(Fault::EmptyProgram, Span::new(0, self.end)));
        }
    }

    fn line(&mut self, line: &[u8], at: u32, out: &mut Batch) {
        let place = |l: usize, r: usize| Span::new(at.wrapping_add(l as u32), at.wrapping_add(r as u32));
        let (text, refused) = match std::str::from_utf8(line) {
            Ok(text) => (text, None),
            Err(e) => ("", Some((Fault::NotText, place(e.valid_up_to(), e.valid_up_to() + 1)))),
        };
        let parsed = match refused {
            Some(refused) => Err(refused),
            None => parse(text).map_err(|(fault, l, r)| (fault, place(l, r))),
        };
        let result =
            parsed.and_then(|parsed| self.take(parsed, at, place(0, line.trim_ascii_end().len()), out));
        if let Err((fault, span)) = result {
            self.found = true;
            self.begun = true;
            out.diagnostics.push(Diagnostic::new(fault, span));
            // The body of a refused line is read, so that its end is found, and dropped.
            let trimmed = line.trim_ascii();
            if trimmed.ends_with(b"{") && !trimmed.starts_with(b"}") {
                self.open.push(Frame { opened: span, owner: Owner::Refused, body: Vec::new() });
            }
        }
    }

    /// Puts a line in its place.
    fn take(&mut self, line: Line, at: u32, span: Span, out: &mut Batch) -> Result<(), (Fault, Span)> {
        let syntax =
            |found: &str, expected: Expected| (Fault::Syntax { found: found.into(), expected }, span);
        if matches!(line, Line::Empty) {
            return Ok(());
        }
        if !std::mem::replace(&mut self.begun, true) && !matches!(line, Line::Version(_)) {
            out.diagnostics.push(Diagnostic::new(
                Fault::Syntax { found: Found::Line, expected: format!("`ncc-ir {VERSION}`").as_str().into() },
                span,
            ));
            self.found = true;
        }
        match line {
            Line::Empty => {}
            Line::Version(VERSION) => {}
            Line::Version(other) => {
                let fault = Fault::not_supported(format!("ncc-ir {other}"), TextUnsupported::Version);
                return Err((fault, span));
            }
            Line::Program(name) => out.name = name,
            Line::Assumed(facts) => out.assumed = facts.or(out.assumed),
            Line::Procedure(_) if !self.open.is_empty() => {
                return Err(syntax("procedure", Expected::EndOfBody));
            }
            Line::Procedure(procedure) => {
                out.whole = true;
                self.found = true;
                self.skip = None;
                self.open.push(Frame { opened: span, owner: Owner::Procedure(procedure), body: Vec::new() });
            }
            Line::Stmts { joined, items, begins } => return self.stmts(joined, items, begins, at, span, out),
            Line::End => {
                let frame = self.open.pop().ok_or_else(|| syntax("`}`", Expected::Statement))?;
                self.close(frame, out);
            }
            Line::Else => {
                let frame = self.open.pop().ok_or_else(|| syntax("`}`", Expected::Statement))?;
                let is_if = |s: &Stmt| matches!(&s.op, Op::Control(c) if matches!(**c, Control::If { .. }));
                let owner = match frame.owner {
                    Owner::Control(stmt) if is_if(&stmt) => Owner::Otherwise(stmt, frame.body),
                    Owner::Refused => Owner::Refused,
                    owner => {
                        self.close(Frame { opened: frame.opened, owner, body: frame.body }, out);
                        self.open.push(Frame { opened: span, owner: Owner::Refused, body: Vec::new() });
                        return Err(syntax("else", Expected::EndOfBodyAlone));
                    }
                };
                self.open.push(Frame { opened: span, owner, body: Vec::new() });
            }
        }
        Ok(())
    }

    fn stmts(
        &mut self,
        joined: bool,
        items: Vec<Stmt>,
        begins: bool,
        at: u32,
        span: Span,
        out: &mut Batch,
    ) -> Result<(), (Fault, Span)> {
        self.found = true;
        let last = items.len().saturating_sub(1);
        for (place, mut stmt) in items.into_iter().enumerate() {
            stmt.span = Span::new(at.wrapping_add(stmt.span.start), at.wrapping_add(stmt.span.end));
            stmt.joined |= place == 0 && joined;
            stmt.skip = match stmt.skip {
                Some(0) => None,
                None if stmt.joined => self.skip,
                own => own,
            };
            self.skip = stmt.skip;
            let control = matches!(stmt.op, Op::Control(_));
            if control != (begins && place == last) {
                let (found, expected) = match control {
                    true => (stmt.op.name(), Expected::BodyAtEnd),
                    false => ("`{`", Expected::EndOfLine),
                };
                let fault = Fault::Syntax { found: found.into(), expected };
                return Err((fault, stmt.span));
            }
            let flow = matches!(
                stmt.op,
                Op::Call(_)
                    | Op::Return
                    | Op::Goto(_)
                    | Op::Label(_)
                    | Op::Assign(..)
                    | Op::Declare(_)
                    | Op::SynchronisedFeed(_)
                    | Op::Leave
                    | Op::NextTurn
            );
            out.whole |= control || flow;
            if !control {
                self.body(out).push(stmt);
            } else if self.open.len() >= DEPTH {
                let expected = Expected::Bodies { most: DEPTH };
                return Err((Fault::Syntax { found: "`{`".into(), expected }, span));
            } else {
                self.open.push(Frame { opened: span, owner: Owner::Control(stmt), body: Vec::new() });
            }
        }
        Ok(())
    }

    /// Where statements go now.
    fn body<'a>(&'a mut self, out: &'a mut Batch) -> &'a mut Vec<Stmt> {
        match self.open.last_mut() {
            Some(frame) => &mut frame.body,
            None => &mut out.stmts,
        }
    }

    /// Gives a body that is complete to its owner, and the owner to its place.
    fn close(&mut self, frame: Frame, out: &mut Batch) {
        let stmt = match frame.owner {
            Owner::Procedure(mut procedure) => {
                procedure.body = frame.body;
                out.procedures.push(procedure);
                return;
            }
            Owner::Refused => return,
            Owner::Control(mut stmt) => {
                fill(&mut stmt.op, frame.body, Vec::new());
                stmt
            }
            Owner::Otherwise(mut stmt, first) => {
                fill(&mut stmt.op, first, frame.body);
                stmt
            }
        };
        self.body(out).push(stmt);
    }
}

/// Puts the bodies into a control statement.
fn fill(op: &mut Op, first: Vec<Stmt>, second: Vec<Stmt>) {
    if let Op::Control(control) = op {
        for (place, body) in control.bodies_mut().zip([first, second]) {
            *place = body;
        }
    }
}
