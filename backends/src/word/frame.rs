//! The frame of a program: what stands before the first block, between procedures and at the end.

use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::lack::{CompensationLack, FlowLack, OperatorLack};
use ncc_ir::program::{Control, Op, Procedure, Stmt};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

use super::Writer;
use crate::Head;
use crate::common::Sink;
use crate::common::fault::cannot;

/// Number of a program whose source has none.
const FIRST_PROGRAM: u32 = 1;

impl Writer {
    /// The text that goes before all the rest: the frame's mark, number and title, and the comment
    /// for the operator. A title that the dialect has no place for becomes a comment.
    pub fn head(&self, head: &Head, out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        let rules = &self.dialect.program;
        if !rules.frame.is_empty() {
            out.extend_from_slice(rules.frame.as_bytes());
            out.extend_from_slice(self.words.eol);
        }
        let title = head.name.title.as_deref();
        let letter = rules.main_number();
        if let Some(letter) = letter {
            let number = head.name.number.unwrap_or(FIRST_PROGRAM);
            self.program_line(letter, number, title.filter(|_| rules.title), out);
        }
        if letter.is_none() || !rules.title {
            let number = head.name.number.filter(|_| letter.is_none());
            let kept = match (number, title) {
                (Some(number), Some(title)) => Some(format!("{number} {title}")),
                (Some(number), None) => Some(number.to_string()),
                (None, Some(title)) => Some(title.to_owned()),
                (None, None) => None,
            };
            if let Some(kept) = kept {
                self.words.comment_line(&kept, out);
                diags.push(Diagnostic::new(Fault::NameAsComment, Span::default()));
            }
        }
        for line in &head.lines {
            self.words.comment_line(line, out);
        }
    }

    fn program_line(&self, letter: char, number: u32, title: Option<&str>, out: &mut Vec<u8>) {
        let digits = self.dialect.program.number_digits;
        self.title_line(&format!("{letter}{number:0digits$}"), title, out);
    }

    /// The line that names a program.
    fn title_line(&self, name: &str, title: Option<&str>, out: &mut Vec<u8>) {
        out.extend_from_slice(name.as_bytes());
        match title {
            Some(title) => {
                if self.dialect.block.blanks {
                    out.push(b' ');
                }
                self.words.comment_line(title, out);
            }
            None => out.extend_from_slice(self.words.eol),
        }
    }

    /// Writes a subprogram, after all of the main procedure.
    pub fn procedure(&mut self, p: &Procedure, out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        if self.is_o_sub(&p.name) {
            return;
        }
        let mut sink = Sink { out, diags };
        self.words.no_event(&mut sink);
        let span = p.body.first().map_or(Span::default(), |s| s.span);
        let number = match self.dialect.program.number.filter(|_| self.dialect.program.subprograms) {
            None => Err(cannot(FlowLack::Subprogram)),
            Some(_) if !p.parameters.is_empty() && !self.dialect.program.macro_b => {
                Err(cannot(FlowLack::SubprogramParameters))
            }
            Some(_) if self.has_name(&p.name) => Ok(None),
            Some(letter) => self.program_number(&p.name).map(|number| Some((letter, number))),
        };
        let number = match number {
            // A number in its way ends nothing (LinuxCNC's interpreter, run).
            Ok(_) if self.dialect.program.o_words && !self.main_ends => {
                Err(cannot(FlowLack::ProgramsAfterOpenEnd))
            }
            number => number,
        };
        match number {
            Ok(Some((letter, number))) => self.program_line(letter, number, p.title.as_deref(), sink.out),
            Ok(None) => self.title_line(&format!("<{}>", p.name), p.title.as_deref(), sink.out),
            Err(fault) => return sink.report(fault, span),
        }
        if let Some(trace) = &mut self.words.trace {
            trace.frame(sink.out);
        }
        self.forget();
        self.words.tracker = Tracker::default();
        self.number_jumps(&p.body);
        self.body(&p.body, &mut sink);
        let ends =
            p.body.iter().rev().find(|s| !matches!(s.op, Op::Comment(_) | Op::Blank | Op::NoEffect(_)));
        if !ends
            .is_some_and(|s| matches!(s.op, Op::Return | Op::ProgramEnd | Op::BeginAgain) && s.skip.is_none())
        {
            let end = ncc_ir::program::Stmt::new(p.body.last().map_or(span, |s| s.span), Op::Return);
            self.body(&[end], &mut sink);
        }
    }

    /// Writes the end marks. A program that does not say its own end is left so.
    pub fn finish(&mut self, out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        let mut sink = Sink { out, diags };
        self.o_alone_ends(&mut sink);
        self.words.no_event(&mut sink);
        if self.stop_text.take().is_some() {
            // No stop has come after it that could say it.
            sink.report(cannot(OperatorLack::OperatorMessage), Span::default());
        }
        if self.dialect.program.o_words && !self.main_ends && self.words.tracker.compensated {
            // The last move is made when the program says its end (LinuxCNC's interpreter, run).
            sink.report(cannot(CompensationLack::EndOfText), Span::default());
        }
        self.words.finish(&mut sink);
    }
}

/// Whether nothing goes on after a body; nothing if it has no statement that does anything.
pub(super) fn ends(body: &[Stmt]) -> Option<bool> {
    let last = body.iter().rev().find(|s| !matches!(s.op, Op::Comment(_) | Op::Blank | Op::NoEffect(_)))?;
    let over = if let Op::Control(control) = &last.op
        && let Control::If { then, otherwise, .. } = &**control
    {
        [then, otherwise].iter().all(|body| ends(body) == Some(true))
    } else {
        matches!(last.op, Op::ProgramEnd | Op::BeginAgain | Op::Return | Op::Alarm(_))
    };
    Some(over && last.skip.is_none())
}
