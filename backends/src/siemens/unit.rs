//! Units of a text: main program and subprograms, calls, labels and repetitions.

use ncc_dialects::NameMeaning;
use ncc_ir::canon::Motion;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::lack::{FlowLack, WordsLack};
use ncc_ir::program::{Call, Control, Op, Procedure, RepeatBlocks, Stmt};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

use super::names::Name;
use super::{Modal, Sink, Standing, Writer};
use crate::Head;
use crate::common::block::{Need, Part, Rank};
use crate::common::fault::cannot;

/// Most repetitions of a call.
const MOST_TIMES: u32 = 9999;

/// Name of a main program whose source has none.
const MAIN: &str = "MAIN";

impl Writer {
    /// The text that goes before all the rest: the header of the unit, if there are several, and the
    /// comment for the operator.
    pub fn head(&self, head: &Head, out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        let number = head.name.number.map(|n| n.to_string());
        let title = head.name.title.as_deref();
        let mut kept = match (&number, title) {
            (Some(number), Some(title)) => Some(format!("{number} {title}")),
            (Some(number), None) => Some(number.clone()),
            (None, title) => title.map(str::to_owned),
        };
        if self.units {
            let name = self.names.main(title.or(number.as_deref()).unwrap_or(MAIN));
            kept = kept.filter(|kept| *kept != name);
            self.header(&name, "MPF", out);
        }
        if let Some(kept) = kept {
            self.words.comment_line(&kept, out);
            diags.push(Diagnostic::new(Fault::NameAsComment, Span::default()));
        }
        for line in &head.lines {
            self.words.comment_line(line, out);
        }
    }

    fn header(&self, name: &str, kind: &str, out: &mut Vec<u8>) {
        out.extend_from_slice(format!("%_N_{name}_{kind}").as_bytes());
        out.extend_from_slice(self.words.eol);
    }

    /// Writes a subprogram, after all of the main procedure.
    pub fn procedure(&mut self, p: &Procedure, out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        let mut sink = Sink { out, diags };
        self.words.no_event(&mut sink);
        self.units = true;
        let span = p.body.first().map_or(Span::default(), |s| s.span);
        let name = self.program_name(&p.name, span, &mut sink);
        self.header(&name, "SPF", sink.out);
        self.begin_variables(p, &mut sink);
        match self.parameters(p, &name) {
            Ok(None) => {}
            Ok(Some(head)) => {
                sink.out.extend_from_slice(head.as_bytes());
                sink.out.extend_from_slice(self.words.eol);
            }
            Err(fault) => return sink.report(fault, span),
        }
        if let Some(title) = &p.title {
            self.words.comment_line(title, sink.out);
        }
        if let Some(trace) = &mut self.words.trace {
            trace.frame(sink.out);
        }
        self.words.forget();
        self.words.tracker = Tracker::default();
        self.no_labels_yet();
        self.standing = Standing::START;
        if self.under_cycle.contains(&p.name) {
            self.standing.modal = Modal::Doubtful;
        }
        // There, the codes of the program's end lead back to what has called it.
        for end in p.body.iter().filter(|s| matches!(s.op, Op::ProgramEnd | Op::BeginAgain)) {
            sink.report(cannot(FlowLack::ProgramEndInSubprogram), end.span);
        }
        self.body(&p.body, &mut sink);
        let silent = |s: &&Stmt| !matches!(s.op, Op::Comment(_) | Op::Blank | Op::NoEffect(_));
        let last = p.body.iter().rev().find(silent);
        if !last.is_some_and(|s| matches!(s.op, Op::Return) && s.skip.is_none()) {
            let end = Stmt::new(p.body.last().map_or(span, |s| s.span), Op::Return);
            self.body(&[end], &mut sink);
        }
    }

    /// Writes the end of the text. A program that does not say its own end is left so.
    pub fn finish(&mut self, out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        let mut sink = Sink { out, diags };
        self.words.no_event(&mut sink);
        self.words.finish(&mut sink);
    }

    pub(super) fn program_name(&mut self, name: &str, span: Span, sink: &mut Sink) -> String {
        let name = self.names.program(name);
        tell(name, span, sink)
    }

    pub(super) fn label_name(&mut self, name: &str, span: Span, sink: &mut Sink) -> String {
        let name = self.names.label(name);
        tell(name, span, sink)
    }

    pub(super) fn call(&mut self, call: &Call, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let arguments = self.arguments(call, span, sink)?;
        let times = match call.times {
            0 => return Err(cannot(FlowLack::CallNoTimes)),
            1 => String::new(),
            2..=MOST_TIMES => format!(" P{}", call.times),
            _ => return Err(Fault::TargetRange { word: call.times.to_string().into() }),
        };
        self.settle_edge(span, sink)?;
        self.pay_call(sink)?;
        if self.standing.modal != Modal::Off {
            // Its positions are reached as the cycle's are.
            self.under_cycle.insert(call.name.clone());
            self.position_in_rapid(sink)?;
        } else {
            self.restate_feed(span, sink)?;
        }
        let name = self.program_name(&call.name, span, sink);
        self.alone(&format!("{name}{arguments}{times}"), sink)?;
        self.forget();
        self.edge_waits_after(&call.name);
        Ok(())
    }

    /// Lets words without a code be rapid moves.
    fn position_in_rapid(&mut self, sink: &mut Sink) -> Result<(), Fault> {
        if self.words.active.motion == Some(Motion::Traverse) {
            return Ok(());
        }
        let code = self.words.codes.traverse.ok_or_else(|| cannot(WordsLack::RapidMove))?;
        self.words.admit(&Need::new(Rank::Motion).code(Some(code)), sink)?;
        self.words.block.code(Part::Motion, &code);
        self.words.active.motion = Some(Motion::Traverse);
        Ok(())
    }

    /// What is active is not known: after a call, at a label.
    pub(super) fn forget(&mut self) {
        self.words.forget();
        (self.standing.feed, self.standing.speed, self.standing.feed_said) = (None, None, true);
    }

    pub(super) fn label(&mut self, name: &str, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        self.pay_call(sink)?;
        self.before_label(name, sink)?;
        let text = self.label_name(name, span, sink);
        if !self.words.block.is_empty() {
            self.words.flush(false, sink);
            self.words.split = true;
        }
        self.words.block.text(Part::Label, &format!("{text}:"));
        self.forget();
        Ok(())
    }

    pub(super) fn repeat_blocks(
        &mut self,
        repeat: &RepeatBlocks,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let count = match repeat.times.literal() {
            None => format!(" P={}", self.words.expression(&repeat.times, span, sink)?),
            Some(times) => match times.whole_number().and_then(|n| u32::try_from(n).ok()) {
                Some(0) => return Ok(()),
                Some(times) => count(times)?,
                None => return Err(cannot(FlowLack::RepetitionUnknown)),
            },
        };
        self.restate_feed(span, sink)?;
        self.pay_call(sink)?;
        let from = self.label_name(&repeat.from, span, sink);
        if repeat.to.as_ref() == Some(&repeat.from) {
            return self.repeat(NameMeaning::RepeatBlock, &from, "", &count, sink);
        }
        let to = repeat.to.as_ref().map(|to| format!(" {}", self.label_name(to, span, sink)));
        self.repeat(NameMeaning::RepeatBlocks, &from, &to.unwrap_or_default(), &count, sink)
    }

    fn repeat(
        &mut self,
        which: NameMeaning,
        from: &str,
        to: &str,
        count: &str,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let row = self.dialect.name_for(which);
        let row = row.ok_or_else(|| cannot(FlowLack::Repetition))?;
        self.alone(&format!("{} {from}{to}{count}", row.name), sink)?;
        self.forget();
        Ok(())
    }

    /// Structured control: a body done a number of times becomes blocks that are repeated.
    pub(super) fn control(&mut self, control: &Control, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        let (times, body) = match control {
            Control::Repeat { times, body } => (times, body),
            Control::Loop { .. }
            | Control::Until { .. }
            | Control::While { .. }
            | Control::For { .. }
            | Control::If { .. } => return self.structure(control, stmt, sink),
        };
        let times = times.literal().and_then(|n| n.whole_number()).and_then(|n| u32::try_from(n).ok());
        let times = times.filter(|n| *n > 0 && stmt.skip.is_none());
        let times = times.ok_or_else(|| cannot(FlowLack::RepetitionUnknown))?;
        let name = loop {
            self.repeats += 1;
            let name = format!("AGAIN_{}", self.repeats);
            if !self.names.has_label(&name) {
                break name;
            }
        };
        self.label(&name, stmt.span, sink)?;
        self.words.flush(false, sink);
        let outer = match &mut self.words.trace {
            Some(trace) => {
                trace.so_far(sink.out);
                trace.enter(std::slice::from_ref(stmt))
            }
            None => Vec::new(),
        };
        self.body(body, sink);
        if let Some(trace) = &mut self.words.trace {
            trace.leave(outer);
        }
        match times {
            1 => Ok(()),
            times => self.repeat(NameMeaning::RepeatBlocks, &name, "", &count(times - 1)?, sink),
        }
    }
}

/// The word for how many times blocks are repeated.
fn count(times: u32) -> Result<String, Fault> {
    match times {
        1 => Ok(String::new()),
        2..=MOST_TIMES => Ok(format!(" P={times}")),
        _ => Err(Fault::TargetRange { word: times.to_string().into() }),
    }
}

/// Tells that a name is not the program's own.
pub(super) fn tell(name: Name, span: Span, sink: &mut Sink) -> String {
    if let Some(fault) = name.changed {
        sink.report(fault, span);
    }
    name.text
}
