//! Programs that compute in the words of a control with O words: branches and loops with their blocks, subprograms
//! with variables of their own, messages with values (`[program] o_words`).
//!
//! A label serves once in the text. Subprograms stand before all that calls them: a call of one that has not been met
//! looks for a file of its name first (LinuxCNC's interp_o_word.cc, `control_back_to`). Programs that have their
//! caller's variables are numbered ones, which end with their own code.
//!
//! Not here: expressions (`common::formula`), and jumps, which such a control has not.

mod messages;

use std::collections::BTreeSet;

use ncc_ir::computed::computes::counted;
use ncc_ir::diag::Fault;
use ncc_ir::expr::partial_expr::may_fail;
use ncc_ir::expr::{Expr, Node, Target, Unary, Var};
use ncc_ir::lack::FlowLack;
use ncc_ir::program::{Call, Control, Op, Procedure, Stmt, Text};
use ncc_ir::run_time::RunTimeFlow;
use ncc_ir::source::Span;

use ncc_ir::track::Tracker;

use crate::common::Sink;
use crate::common::block::Rank;
use crate::common::fault::{cannot, cannot_compute};
use crate::common::formula::number_of;
use crate::word::Writer;

/// Most arguments of a call, which are the first of the variables that a call has (LinuxCNC, O Codes, call).
const MOST_ARGUMENTS: u32 = 30;

/// Where a subprogram leaves its result, and whether it has left one: what `return` and `endsub` say.
const RESULT: &str = "_value";
const RESULT_GIVEN: &str = "_value_returned";

/// What is known of the O words of a program.
#[derive(Clone, Debug, Default)]
pub(crate) struct OWords {
    /// Subprograms that have not been written yet.
    waiting: Vec<Procedure>,
    /// Those that are subprograms of O words.
    subs: BTreeSet<Text>,
    /// Numbers that are taken, by labels and programs.
    taken: BTreeSet<u32>,
    /// The subprogram at hand.
    sub: Option<Text>,
    /// The program is that one, which is called from elsewhere; what it is called.
    alone: Option<Text>,
    /// Loops that are open in it.
    open: Vec<Open>,
    /// A result that the next return or end says.
    result: Option<(Expr, Option<bool>)>,
    /// Whether some loop that is tested before its turns is left from within.
    left: bool,
    /// Whether an iteration of a `do` is left somewhere, and whether there is a `repeat`: the one disturbs the other.
    turned: bool,
    repeats: bool,
}

/// A loop that is open.
#[derive(Clone, Debug)]
struct Open {
    label: u32,
    /// Whether a turn of it can be left.
    turns: bool,
    /// Whether it can be left.
    leaves: bool,
    /// Whether it can be left after a place where its turn is: a `do` looks for its end, and takes a `break` on the
    /// way there for one that is made (interp_o_word.cc).
    both: bool,
}

/// A label as it is written.
fn spelt(name: &str) -> String {
    match name.bytes().all(|b| b.is_ascii_digit()) {
        true => format!("o{name}"),
        false => format!("o<{}>", name.to_ascii_lowercase()),
    }
}

impl Writer {
    /// Whether the control decides and calls by O words.
    pub(crate) fn has_o_words(&self) -> bool {
        self.dialect.program.o_words
    }

    /// Takes what must be known of the procedures of a program that computes.
    pub(crate) fn know_o_words(&mut self, procedures: &[Procedure]) {
        let mut own = BTreeSet::new();
        let mut shared = BTreeSet::new();
        let o = &mut self.o_words;
        for procedure in procedures {
            calls(&procedure.body, &mut own, &mut shared);
            o.left |= leaves(&procedure.body, false);
            o.taken.extend(procedure.name.parse::<u32>().ok());
        }
        let mut stated = [false; 2];
        procedures.iter().for_each(|procedure| units(&procedure.body, &mut stated));
        (0..2).for_each(|at| self.words.units_stated[at] |= stated[at]);
        for procedure in procedures.iter().skip(1) {
            if own.contains(&procedure.name) || !shared.contains(&procedure.name) {
                o.subs.insert(procedure.name.clone());
                o.waiting.push(procedure.clone());
            }
        }
    }

    /// Whether a procedure is a subprogram of O words.
    pub(crate) fn is_o_sub(&self, name: &str) -> bool {
        self.o_words.subs.contains(name)
    }

    /// Writes the subprograms of O words, after the comments with which the main program begins; how many of its
    /// statements those are.
    pub(crate) fn o_subs(&mut self, main: &[Stmt], sink: &mut Sink) -> usize {
        let waiting = std::mem::take(&mut self.o_words.waiting);
        if waiting.is_empty() {
            return 0;
        }
        let lead = main.iter().take_while(|s| matches!(s.op, Op::Comment(_) | Op::Blank)).count();
        self.body(&main[..lead], sink);
        if let Some(preamble) = &mut self.words.preamble {
            if let Some(trace) = &mut self.words.trace {
                trace.started(sink.out, &preamble.held);
            }
            sink.out.append(&mut preamble.held);
        }
        // They stand before the blocks that state the units of all.
        let known =
            self.words.preamble.as_ref().and_then(|preamble| preamble.units()).or(self.words.assumed.units);
        known.into_iter().for_each(|units| self.words.units_stated[units as usize] = true);
        // They are passed over where they stand: what is active there stays.
        let preamble = self.words.preamble.take();
        let (force, tracker, held) = (self.words.active, self.words.tracker.clone(), self.held.take());
        let (residue, residual, named, lost) =
            (self.words.residue, self.words.residual, self.words.named, self.words.lost);
        for procedure in &waiting {
            self.o_sub(procedure, sink);
        }
        self.words.preamble = preamble;
        (self.words.active, self.words.tracker, self.held) = (force, tracker, held);
        (self.words.residue, self.words.residual, self.words.named, self.words.lost) =
            (residue, residual, named, lost);
        self.words.forgotten = false;
        lead
    }

    /// The program is a subprogram that is called from elsewhere, by this name: the text is that subprogram.
    pub(crate) fn o_alone(&mut self, name: &str) {
        self.o_words.taken.extend(name.parse::<u32>().ok());
        self.o_words.subs.insert(name.into());
        self.o_words.alone = Some(name.into());
    }

    /// Writes statements of the main program; of one that is called from elsewhere, as that subprogram.
    pub(crate) fn o_main(&mut self, main: &[Stmt], sink: &mut Sink) {
        let alone = self.o_words.alone.clone().filter(|_| self.o_words.sub.is_none());
        let Some(name) = alone else {
            let lead = self.o_subs(main, sink);
            return self.body(&main[lead..], sink);
        };
        let lead = main.iter().take_while(|s| matches!(s.op, Op::Comment(_) | Op::Blank)).count();
        self.body(&main[..lead], sink);
        let span = main.first().map_or(Span::default(), |s| s.span);
        match self.o_name(&name) {
            Ok(()) => self.o_begin(&name, None, sink),
            Err(fault) => return sink.report(fault, span),
        }
        self.o_body(&main[lead..], sink);
    }

    /// The end of a text that is such a subprogram.
    pub(crate) fn o_alone_ends(&mut self, sink: &mut Sink) {
        if let Some(name) = self.o_words.alone.take().filter(|_| self.o_words.sub.is_some()) {
            self.o_end(&name, Span::default(), sink);
            // Its caller goes on before; the file by itself ends (O Codes, Calling Files).
            if let Err(fault) =
                self.words.m_code(Rank::Stop, self.words.codes.end, FlowLack::ProgramEnd, sink)
            {
                sink.report(fault, Span::default());
            }
            self.words.flush(false, sink);
        }
    }

    fn o_sub(&mut self, procedure: &Procedure, sink: &mut Sink) {
        let span = procedure.body.first().map_or(Span::default(), |s| s.span);
        if let Err(fault) = self.o_name(&procedure.name) {
            return sink.report(fault, span);
        }
        self.o_begin(&procedure.name, procedure.title.as_deref(), sink);
        self.forget();
        self.words.tracker = Tracker::default();
        self.o_body(&procedure.body, sink);
        self.o_end(&procedure.name, procedure.body.last().map_or(span, |s| s.span), sink);
    }

    fn o_begin(&mut self, name: &Text, title: Option<&str>, sink: &mut Sink) {
        sink.out.extend_from_slice(format!("{} sub", spelt(name)).as_bytes());
        match title {
            Some(title) => {
                sink.out.push(b' ');
                self.words.comment_line(title, sink.out);
            }
            None => sink.out.extend_from_slice(self.words.eol),
        }
        if let Some(trace) = &mut self.words.trace {
            trace.frame(sink.out);
        }
        self.o_words.sub = Some(name.clone());
        self.o_words.open.clear();
    }

    /// The blocks of a subprogram.
    fn o_body(&mut self, body: &[Stmt], sink: &mut Sink) {
        let silent = |s: &&Stmt| !matches!(s.op, Op::Comment(_) | Op::Blank | Op::NoEffect(_));
        let end = body.iter().rposition(|s| silent(&s));
        let end = end.filter(|at| {
            let last = &body[*at];
            matches!(last.op, Op::Return) && last.skip.is_none() && last.comment.is_none()
        });
        match end {
            // Its end says the same.
            Some(at) => {
                self.body(&body[..at], sink);
                self.body(&body[at + 1..], sink);
            }
            None => self.body(body, sink),
        }
    }

    fn o_end(&mut self, name: &Text, last: Span, sink: &mut Sink) {
        let name = spelt(name);
        self.open_block(&Stmt::new(last, Op::Blank));
        let written = self.o_result_text(last, sink).and_then(|result| {
            self.call_up_now(&Stmt::new(last, Op::Blank), sink)?;
            self.o_line(&format!("{name} endsub{result}"), sink)
        });
        if let Err(fault) = written {
            sink.report(fault, last);
        }
        self.words.flush(false, sink);
        if let Some(trace) = &mut self.words.trace {
            trace.frame(sink.out);
        }
        self.o_words.sub = None;
    }

    /// Whether a subprogram can be called so.
    fn o_name(&self, name: &str) -> Result<(), Fault> {
        if name.is_empty() {
            return Err(cannot(FlowLack::SubprogramUnnamed));
        }
        let fits = |b: u8| b.is_ascii_alphanumeric() || b"_-+.".contains(&b);
        let number = name.bytes().all(|b| b.is_ascii_digit());
        let alike = self.o_words.subs.iter().filter(|other| other.eq_ignore_ascii_case(name)).count();
        let good = match number {
            // By rs274: `o0` is one as any other, in a file `0.ngc` too.
            true => (1..=8).contains(&name.len()) && (name == "0" || !name.starts_with('0')),
            false => name.len() <= 60 && name.bytes().all(fits),
        };
        match good && alike == 1 {
            true => Ok(()),
            false => Err(cannot(FlowLack::SubprogramName { name: name.into() })),
        }
    }

    /// A label that no other block has: after the number of the subprogram that it stands in.
    fn o_label(&mut self) -> u32 {
        let o = &mut self.o_words;
        let first = o.sub.as_deref().and_then(|sub| sub.parse::<u32>().ok()).map_or(1, |number| number + 1);
        let label = (first..).find(|number| !o.taken.contains(number)).unwrap_or(first);
        o.taken.insert(label);
        label
    }

    /// A block of an O word: without a number, since nothing jumps there.
    fn o_line(&mut self, text: &str, sink: &mut Sink) -> Result<(), Fault> {
        self.statement_alone(text, sink)?;
        self.words.numbers.bare = true;
        self.words.flush(false, sink);
        self.words.numbers.bare = false;
        Ok(())
    }

    /// A block from which control goes on into others.
    fn o_head(&mut self, text: &str, sink: &mut Sink) -> Result<(), Fault> {
        self.o_line(text, sink)?;
        self.words.block_written(sink.out);
        self.forget();
        Ok(())
    }

    /// The blocks of a branch or a loop.
    fn o_inner(&mut self, body: &[Stmt], stmt: &Stmt, sink: &mut Sink) {
        let split = self.words.split;
        self.body(body, sink);
        self.open_block(&Stmt::new(stmt.span, Op::Blank));
        self.words.split = split;
        if let Some(trace) = &mut self.words.trace {
            trace.enter(std::slice::from_ref(stmt));
        }
        if let Err(fault) = self.flow(stmt, sink) {
            sink.report(fault, stmt.span);
        }
        self.forget();
    }

    fn o_loop(&mut self, label: u32, open: [bool; 3], body: &[Stmt], stmt: &Stmt, sink: &mut Sink) {
        let [leaves, turns, both] = open;
        self.o_words.open.push(Open { label, turns, leaves, both });
        self.o_inner(body, stmt, sink);
        self.o_words.open.pop();
    }

    /// A branch or a loop.
    pub(crate) fn o_structure(
        &mut self,
        control: &Control,
        stmt: &Stmt,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        self.no_result()?;
        if stmt.skip.is_some() {
            return Err(cannot(FlowLack::SkippedTogether));
        }
        self.flow(stmt, sink)?;
        let label = self.o_label();
        match control {
            Control::If { condition, then, otherwise } => {
                self.o_decision(label, condition, then, otherwise, stmt, sink)
            }
            Control::While { condition, body } => {
                let condition = self.words.condition(condition, stmt.span, sink)?;
                self.o_head(&format!("o{label} while {condition}"), sink)?;
                self.o_loop(label, [true, true, true], body, stmt, sink);
                self.o_line(&format!("o{label} endwhile"), sink)
            }
            Control::Loop { body } => {
                self.o_head(&format!("o{label} while [1]"), sink)?;
                self.o_loop(label, [true, true, true], body, stmt, sink);
                self.o_line(&format!("o{label} endwhile"), sink)
            }
            // A loop of `do` is left after its first turn where one of `while` has been left by `break` before.
            Control::Until { condition, body } if self.o_words.left => {
                self.o_head(&format!("o{label} while [1]"), sink)?;
                self.o_loop(label, [true, false, true], body, stmt, sink);
                let inner = self.o_label();
                let holds = self.words.condition(condition, stmt.span, sink)?;
                self.o_head(&format!("o{inner} if {holds}"), sink)?;
                self.o_head(&format!("o{label} break"), sink)?;
                self.o_head(&format!("o{inner} endif"), sink)?;
                self.o_line(&format!("o{label} endwhile"), sink)
            }
            Control::Until { condition, body } => {
                self.o_head(&format!("o{label} do"), sink)?;
                self.o_loop(label, [true, true, false], body, stmt, sink);
                let again = self.words.condition(&opposite(condition), stmt.span, sink)?;
                self.o_line(&format!("o{label} while {again}"), sink)
            }
            Control::Repeat { times, body } => {
                self.o_words.repeats = true;
                self.undisturbed()?;
                let times = self.words.condition(counted(times), stmt.span, sink)?;
                self.o_head(&format!("o{label} repeat {times}"), sink)?;
                self.o_loop(label, [false, false, false], body, stmt, sink);
                self.o_line(&format!("o{label} endrepeat"), sink)
            }
            Control::For { .. } => Err(cannot_compute(RunTimeFlow::LoopCounts)),
        }
    }

    fn o_decision(
        &mut self,
        label: u32,
        condition: &Expr,
        then: &[Stmt],
        otherwise: &[Stmt],
        stmt: &Stmt,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let holds = self.words.condition(condition, stmt.span, sink)?;
        self.o_head(&format!("o{label} if {holds}"), sink)?;
        self.o_inner(then, stmt, sink);
        let mut rest = otherwise;
        while let [Stmt { op: Op::Control(control), skip: None, comment: None, .. }] = rest
            && let Control::If { condition, then, otherwise } = &**control
            && !may_fail(condition)
        {
            let holds = self.words.condition(condition, stmt.span, sink)?;
            self.o_head(&format!("o{label} elseif {holds}"), sink)?;
            self.o_inner(then, stmt, sink);
            rest = otherwise;
        }
        if !rest.is_empty() {
            self.o_head(&format!("o{label} else"), sink)?;
            self.o_inner(rest, stmt, sink);
        }
        self.o_line(&format!("o{label} endif"), sink)
    }

    /// An iteration of a `do` that is left keeps a mark set, by which the next `repeat` is begun again at its end.
    fn undisturbed(&self) -> Result<(), Fault> {
        match self.o_words.turned && self.o_words.repeats {
            true => Err(cannot_compute(RunTimeFlow::LoopBesideLeft)),
            false => Ok(()),
        }
    }

    /// Leaves the innermost loop, or its turn.
    pub(crate) fn o_leave(&mut self, turn: bool, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        self.no_result()?;
        self.flow(stmt, sink)?;
        let open = self.o_words.open.last().cloned();
        let open = open.filter(|open| if turn { open.turns } else { open.leaves });
        let open = open.ok_or_else(|| cannot_compute(RunTimeFlow::LoopLeftKind))?;
        if let (true, Some(open)) = (turn, self.o_words.open.last_mut()) {
            open.leaves &= open.both;
            if !open.both {
                self.o_words.turned = true;
                self.undisturbed()?;
            }
        }
        let word = if turn { "continue" } else { "break" };
        self.o_line(&format!("o{} {word}", open.label), sink)
    }

    /// A call with variables of its own.
    pub(crate) fn o_call(&mut self, call: &Call, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        self.no_result()?;
        if stmt.skip.is_some() {
            return Err(cannot(FlowLack::CallSkipped));
        }
        self.flow(stmt, sink)?;
        self.o_name(&call.name)?;
        match call.times {
            1 => {}
            0 => return Err(cannot(FlowLack::CallNoTimes)),
            _ => return Err(cannot_compute(RunTimeFlow::CallOwnAgain)),
        }
        let parameters = self.parameters_of(&call.name);
        if parameters.len() < call.arguments.len() {
            return Err(cannot_compute(RunTimeFlow::CallMoreArguments));
        }
        let mut given: Vec<Option<&Expr>> = Vec::new();
        for (parameter, value) in parameters.iter().zip(&call.arguments) {
            let number = match parameter {
                Var::Local(_) => number_of(parameter, "")?.parse::<u32>().ok(),
                Var::Common(_) | Var::Retentive(_) | Var::System(_) => None,
            };
            let number = number.filter(|n| (1..=MOST_ARGUMENTS).contains(n));
            let number = number.ok_or_else(|| cannot_compute(RunTimeFlow::ArgumentNotOfCall))?;
            let place = number as usize - 1;
            given.resize(given.len().max(place + 1), None);
            given[place] = Some(value);
        }
        // What is left out is zero.
        let zero = |value: &Option<&Expr>| value.is_none_or(|e| e.literal().is_some_and(|n| n.is_zero()));
        while given.last().is_some_and(zero) {
            given.pop();
        }
        let mut text = format!("{} call", spelt(&call.name));
        for value in given {
            text.push(' ');
            let nothing = Expr::int(0);
            text.push_str(&self.words.condition(value.unwrap_or(&nothing), stmt.span, sink)?);
        }
        self.o_line(&text, sink)?;
        self.forget();
        Ok(())
    }

    /// Back to the caller, if a subprogram of O words is at hand.
    pub(crate) fn o_return(&mut self, stmt: &Stmt, sink: &mut Sink) -> Option<Result<(), Fault>> {
        let name = spelt(self.o_words.sub.as_deref()?);
        if self.o_words.open.iter().any(|open| !open.leaves) {
            return Some(Err(cannot_compute(RunTimeFlow::ReturnOutOfLoop)));
        }
        let written = self.flow(stmt, sink).and_then(|()| self.o_result_text(stmt.span, sink));
        Some(written.and_then(|result| self.o_line(&format!("{name} return{result}"), sink)))
    }

    /// Takes the setting of a result, which the return that follows says; `false` is another setting.
    pub(crate) fn o_result(&mut self, to: &Var, value: &Expr) -> Result<bool, Fault> {
        let Var::Common(name) = to else { return self.no_result().map(|()| false) };
        let o = &mut self.o_words;
        match (&**name, &mut o.result) {
            (RESULT, None) if o.sub.is_some() => {
                o.result = Some((value.clone(), None));
                Ok(true)
            }
            (RESULT_GIVEN, Some((_, given @ None))) => {
                *given = value.literal().map(|n| !n.is_zero());
                if given.is_some() { Ok(true) } else { Err(unsaid()) }
            }
            (RESULT | RESULT_GIVEN, _) => Err(unsaid()),
            _ => self.no_result().map(|()| false),
        }
    }

    /// Something else comes: no result waits for it.
    fn no_result(&self) -> Result<(), Fault> {
        if self.o_words.result.is_none() { Ok(()) } else { Err(unsaid()) }
    }

    fn o_result_text(&mut self, span: Span, sink: &mut Sink) -> Result<String, Fault> {
        match self.o_words.result.take() {
            None => Ok(String::new()),
            Some((value, Some(false))) if value.literal().is_some_and(|n| n.is_zero()) => Ok(String::new()),
            Some((value, Some(true))) => Ok(format!(" {}", self.words.condition(&value, span, sink)?)),
            Some(_) => Err(unsaid()),
        }
    }
}

/// Whether a statement says that no subprogram has given a result yet, which the control does by itself where a program
/// begins.
pub(in crate::word) fn is_no_result_yet(stmt: &Stmt) -> bool {
    let Op::Assign(Target::Var(Var::Common(name)), value) = &stmt.op else { return false };
    let zero = value.literal().is_some_and(|n| n.is_zero());
    zero && stmt.span == Span::default() && matches!(&**name, RESULT | RESULT_GIVEN)
}

fn unsaid() -> Fault {
    cannot_compute(RunTimeFlow::ResultElsewhere)
}

/// The opposite of a condition.
fn opposite(condition: &Expr) -> Expr {
    if let Expr::Node(node) = condition
        && let Node::Unary(Unary::Not, inner) = &**node
    {
        return inner.clone();
    }
    Expr::Node(Box::new(Node::Unary(Unary::Not, condition.clone())))
}

/// Programs that are called, with variables of their own or their caller's.
fn calls(body: &[Stmt], own: &mut BTreeSet<Text>, shared: &mut BTreeSet<Text>) {
    for stmt in body {
        if let Op::Call(call) = &stmt.op {
            let shares = call.shared && call.arguments.is_empty();
            if shares { &mut *shared } else { &mut *own }.insert(call.name.clone());
        } else if let Op::Control(control) = &stmt.op {
            control.bodies().for_each(|body| calls(body, own, shared));
        }
    }
}

/// Which units a body states anywhere.
fn units(body: &[Stmt], stated: &mut [bool; 2]) {
    for stmt in body {
        if let Op::UseLengthUnits(said) = &stmt.op {
            stated[*said as usize] = true;
        } else if let Op::Control(control) = &stmt.op {
            control.bodies().for_each(|body| units(body, stated));
        }
    }
}

/// Whether a loop that is tested before its turns is left from within; `inside` is whether the body is one of such a
/// loop.
fn leaves(body: &[Stmt], inside: bool) -> bool {
    body.iter().any(|stmt| {
        let Op::Control(control) = &stmt.op else { return inside && stmt.op == Op::Leave };
        let inside = match &**control {
            Control::While { .. } | Control::Loop { .. } => true,
            Control::If { .. } => inside,
            Control::Until { .. } | Control::Repeat { .. } | Control::For { .. } => false,
        };
        control.bodies().any(|body| leaves(body, inside))
    })
}
