//! Subprograms of O words: `sub` to `endsub`, `call`, `return`, and how they go with numbered programs that end with
//! M99 (LinuxCNC 2.9, gcode/o-code.html; interp_o_word.cc).
//!
//! A subprogram has `#1` to `#30` to itself: its arguments, and zeros after them. What a `return` gives is in
//! `#<_value>`, and whether it gives anything in `#<_value_returned>`. The two kinds of programs must be called by
//! their own words.

use std::collections::{HashMap, hash_map};

use ncc_ir::diag::Fault;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::{Expr, Function, Many, Node, Scope, Var};
use ncc_ir::program::{Alarm, Call, Control, Op, Procedure, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::unsupported::{CallUnsupported, FlowUnsupported};

use super::o_state::{Outer, StructureKind};
use super::statements::{Decision, label_text, spelled};
use crate::batch::Batch;
use crate::common::Source;
use crate::word::lower::Lower;
use crate::word::macros::computes::COMPUTED;
use crate::word::macros::formula::Index;
use crate::word::reader::Reader;
use crate::word::text::block::Block;
use crate::word::text::token::FlowWord;
use crate::word::word_state::WordState;

/// How many structures can stand in one another.
const DEEPEST: usize = 100;

/// Within what the number of a program is whole (interp_read.cc, `read_integer_value`).
const WHOLE: Num = Num { mantissa: 1, scale: 4, point: true, unit: Unit::One };

pub(in crate::word) fn refused(label: &str, word: FlowWord, what: FlowUnsupported) -> Fault {
    Fault::not_supported(format!("{} {}", label_text(label), spelled(word)), what)
}

/// The label of a block, if it is no computed one.
fn label_of(label: &Index) -> Option<Text> {
    match label {
        Index::Number(digits) => digits.to_whole().map(|number| number.to_string().into()),
        Index::Name(name) => Some(name.clone()),
        Index::Computed(_) => None,
    }
}

impl Reader {
    /// The beginning or end of a subprogram; `true` if the block is that.
    pub(in crate::word) fn sub_word(&mut self, src: Source, out: &mut Batch) -> bool {
        let Some(decision) = self.block.decision.as_deref() else { return false };
        let word = decision.word;
        if !matches!(word, FlowWord::Sub | FlowWord::EndSub) {
            return false;
        }
        let (span, skip) = (self.block.span, self.block.skip);
        let Some(label) = label_of(&decision.label) else {
            self.sub_fault(refused("[]", word, FlowUnsupported::LabelComputed), span, out);
            return true;
        };
        let letter = self.signs.number;
        let beside = self.block.words.iter().any(|word| word.letter != letter);
        if skip != 0 || beside || !self.block.settings.is_empty() {
            self.sub_fault(refused(&label, word, FlowUnsupported::OWords), span, out);
        }
        for (fault, at) in std::mem::take(&mut self.block.faults) {
            self.sub_fault(fault, at, out);
        }
        if word == FlowWord::Sub {
            self.begin_sub(label, span, out);
        } else {
            self.end_sub(&label, src, out);
        }
        true
    }

    pub(in crate::word) fn sub_fault(&mut self, fault: Fault, at: Span, out: &mut Batch) {
        out.report(fault, at);
        self.frame.faulty = true;
    }

    fn begin_sub(&mut self, name: Text, span: Span, out: &mut Batch) {
        if self.begin_standalone_osub(&name, out) {
            return;
        }
        if self.lower.sub.is_some() && self.lower.ended && self.lower.o.open.is_empty() {
            // After a numbered program that is over.
            self.end_of_program(out);
        }
        if self.lower.sub.is_some() {
            let fault = refused(&name, FlowWord::Sub, FlowUnsupported::SubInSub);
            return self.sub_fault(fault, span, out);
        }
        if !self.lower.o.open.is_empty() {
            let fault = refused(&name, FlowWord::Sub, FlowUnsupported::SubInLoop);
            return self.sub_fault(fault, span, out);
        }
        if !self.lower.ended && self.lower.o.subs.called_by_main.contains(&name) {
            // The call has gone on to it, and the program comes to it once more.
            let what = FlowUnsupported::SubRunInto;
            self.sub_fault(refused(&name, FlowWord::Sub, what), span, out);
        }
        if self.frame.programs().contains(&name) || self.lower.o.subs.known.contains_key(&name) {
            self.sub_fault(Fault::ProgramTwice { name: name.clone() }, span, out);
        }
        self.frame.blocks = true;
        self.lower.o.subs.known.insert(name.clone(), false);
        let lower = &mut self.lower;
        lower.centre_said_elsewhere(out);
        let outer = Outer {
            motion_without_move: lower.motion_without_move.take_code(),
            state: std::mem::replace(&mut lower.state, WordState::called()),
            ended: std::mem::replace(&mut lower.ended, false),
            labels: std::mem::take(&mut lower.o.labels),
            numbered_program: std::mem::replace(&mut lower.o.numbered_program, false),
        };
        lower.open_sub(&name, outer, span);
        lower.o.given.numbered = true;
        lower.inherited.enter(name.clone());
        lower.sub = Some(Procedure { name, ..Procedure::default() });
        lower.refresh();
        out.whole = true;
    }

    fn end_sub(&mut self, name: &str, src: Source, out: &mut Batch) {
        let span = self.block.span;
        if self.end_standalone_osub(name, out) {
            return;
        }
        let lower = &mut self.lower;
        let values = match self.block.decision.as_deref() {
            Some(decision) => decision.values.clone(),
            None => Vec::new(),
        };
        if values.len() > 1 {
            out.report(refused(name, FlowWord::EndSub, FlowUnsupported::OValues), span);
            self.frame.faulty = true;
        }
        lower.now = crate::word::lower::Now::at(lower.target(out).len());
        let mut values = values;
        let inner = matches!(lower.kinds().next(), Some(StructureKind::Sub(_)));
        if inner {
            values.iter_mut().for_each(|value| lower.parameters(value, span, out));
            lower.results(values.first(), span, out);
        }
        if lower.sub.is_some() && !lower.ended {
            // Its caller goes on with it.
            lower.leave_motion(None, out);
        }
        let failed = lower.now.failed;
        lower.centre_said_elsewhere(out);
        let Some(outer) = lower.close_sub(name) else {
            if lower.o.misspelt {
                return;
            }
            let fault = refused(name, FlowWord::EndSub, FlowUnsupported::SubEnd);
            return self.sub_fault(fault, span, out);
        };
        let Some(mut procedure) = lower.sub.take() else { return };
        lower.inherited.leave();
        let count = highest(&procedure.body);
        procedure.parameters = (1..=count).map(|n| Var::Local(n.to_string().into())).collect();
        out.procedures.push(procedure);
        (lower.state, lower.ended, lower.o.labels) = (outer.state, outer.ended, outer.labels);
        lower.o.numbered_program = outer.numbered_program;
        lower.motion_without_move.restore_code(outer.motion_without_move);
        lower.refresh();
        self.frame.faulty |= failed;
        // Its comment stands after the subprogram.
        let comments = std::mem::take(&mut self.block.comments);
        self.block.clear();
        (self.block.comments, self.block.span) = (comments, span);
        if !self.block.comments.is_empty() && !self.lower.ended {
            let block = std::mem::take(&mut self.block);
            self.lower.block(&block, src, out);
            self.block = block;
        }
    }
}

impl Lower {
    /// A call. Where the program is computed, it is looked for when all of them are known.
    pub(in crate::word) fn o_call(
        &mut self,
        decision: &Decision,
        label: &str,
        mut arguments: Vec<Expr>,
        span: Span,
        out: &mut Batch,
    ) {
        let mut name: Text = label.into();
        if self.leaves_call_out(&name, span, out) {
            return;
        }
        self.centre_said_elsewhere(out);
        if let Index::Computed(formula) = &decision.label {
            let mut number = formula.expr.clone();
            self.parameters(&mut number, span, out);
            name = COMPUTED.into();
            arguments.insert(0, number);
        }
        if let Some(StructureKind::Sub(_)) = self.kinds().last()
            && self.sub.as_ref().is_some_and(|sub| *sub.name == *name)
            && self.kinds().any(|kind| matches!(kind, StructureKind::Repeat(_)))
        {
            let what = FlowUnsupported::SubRecursive;
            return self.fault(refused(label, FlowWord::Call, what), span, out);
        }
        let main = self.sub.is_none();
        self.o.subs.called_by_main.extend(main.then(|| name.clone()));
        self.o.subs.called.push((name.clone(), false, span, main));
        self.found_variables(out);
        self.leave_motion(None, out);
        self.push(span, Op::Call(Box::new(Call { name, times: 1, arguments, shared: false })), out);
        self.lose_all_but_centres(span, out);
    }

    /// Whether a structure stands within so many others that no further one is looked at.
    pub(in crate::word) fn within_too_many(
        &mut self,
        label: &str,
        kind: &StructureKind,
        block: Span,
        out: &mut Batch,
    ) -> bool {
        self.o.too_deep = self.o.open.len() >= DEEPEST;
        if self.o.too_deep {
            let what = FlowUnsupported::TooDeep { most: DEEPEST }.into();
            self.fault(
                Fault::NotSupported { code: format!("{} {}", label_text(label), kind.word()).into(), what },
                block,
                out,
            );
            self.o.open.clear();
        }
        self.o.too_deep
    }

    /// Whether a subprogram of O words is being read.
    pub(in crate::word) fn in_o_sub(&self) -> bool {
        matches!(self.kinds().last(), Some(StructureKind::Sub(_)))
    }

    /// A return from a subprogram.
    pub(in crate::word) fn o_return(&mut self, label: &str, values: Vec<Expr>, span: Span, out: &mut Batch) {
        // It returns from the program that it stands in, whatever its label (rs274, run).
        let own = self.sub.as_ref().filter(|_| matches!(self.kinds().last(), Some(StructureKind::Sub(_))));
        if own.is_none() && !self.o.standalone.is_open() {
            let what = FlowUnsupported::ReturnNoSub;
            return self.fault(refused(label, FlowWord::Return, what), span, out);
        }
        if self.kinds().any(|kind| matches!(kind, StructureKind::Repeat(_))) {
            return self.fault(refused(label, FlowWord::Return, FlowUnsupported::ReturnRepeat), span, out);
        }
        self.results(values.first(), span, out);
        self.leave_motion(None, out);
        self.push(span, Op::Return, out);
    }

    /// What a call gives: a value, or none, which is zero.
    pub(in crate::word) fn results(&mut self, value: Option<&Expr>, span: Span, out: &mut Batch) {
        if value.is_none() && !self.o.subs.results {
            self.o.subs.plain_return.get_or_insert(span);
            return;
        }
        let to = |name: &str| Var::Common(name.into()).into();
        let given = Expr::int(i64::from(value.is_some()));
        self.push(span, Op::Assign(to("_value"), value.cloned().unwrap_or(Expr::int(0))), out);
        self.push(span, Op::Assign(to("_value_returned"), given), out);
    }

    /// Text that is to be read asks for the result of a call.
    pub(in crate::word) fn look_for_results(&mut self, text: &[u8], out: &mut Batch) {
        let lower = text.to_ascii_lowercase();
        if self.o.subs.results || memchr::memmem::find(&lower, b"_value").is_none() {
            return;
        }
        self.o.subs.results = true;
        if let Some(at) = self.o.subs.plain_return {
            let what = FlowUnsupported::ReturnValue;
            out.report(Fault::NotSupported { code: "#<_value>".into(), what: what.into() }, at);
        }
        if self.sub.is_none() && self.o.open.is_empty() {
            let to = |name: &str| Var::Common(name.into()).into();
            for name in ["_value", "_value_returned"] {
                let stmt = Stmt::new(Span::default(), Op::Assign(to(name), Expr::int(0)));
                self.target(out).push(stmt);
            }
        }
    }

    /// The text is over: calls get as many arguments as their programs have, and programs that are computed are
    /// looked for among all.
    pub(in crate::word) fn settle_calls(&mut self, out: &mut Batch) {
        let subs = std::mem::take(&mut self.o.subs.known);
        for (name, numbered, at, _) in std::mem::take(&mut self.o.subs.called) {
            if let Some(found) = subs.get(&name).filter(|found| **found != numbered) {
                let code = if numbered { "M98" } else { "call" };
                let name = format!("O{name}").into();
                let what = match *found {
                    true => CallUnsupported::KindOfNumbered { name },
                    false => CallUnsupported::KindOfProgram { name },
                };
                out.report(Fault::not_supported(code, what), at);
            }
        }
        // In the order of the text, in which a computed number is compared with them.
        let mut numbers = Vec::new();
        let mut most: HashMap<Text, usize> = HashMap::new();
        for procedure in out.procedures.iter().filter(|p| subs.get(&p.name) == Some(&false)) {
            if let hash_map::Entry::Vacant(entry) = most.entry(procedure.name.clone()) {
                entry.insert(procedure.parameters.len());
                numbers.extend(procedure.name.parse::<u32>().ok().map(|_| procedure.name.clone()));
            }
        }
        let bodies = std::iter::once(&mut out.stmts).chain(out.procedures.iter_mut().map(|p| &mut p.body));
        let mut bodies: Vec<&mut Vec<Stmt>> = bodies.collect();
        bodies.iter_mut().for_each(|body| count(body, &numbers, &mut most));
        bodies.iter_mut().for_each(|body| settle(body, &numbers, &most));
        for procedure in &mut out.procedures {
            if let Some(count) = most.get(&procedure.name) {
                procedure.parameters = (1..=*count).map(|n| Var::Local(n.to_string().into())).collect();
            }
        }
    }
}

/// Finds the most arguments of every program's calls.
fn count(body: &mut [Stmt], numbers: &[Text], most: &mut HashMap<Text, usize>) {
    for stmt in body {
        match &mut stmt.op {
            Op::Call(call) => {
                let computed = *call.name == *COMPUTED;
                let given = call.arguments.len() - usize::from(computed);
                let called = if computed { numbers } else { std::slice::from_ref(&call.name) };
                for name in called {
                    if let Some(most) = most.get_mut(name) {
                        *most = given.max(*most);
                    }
                }
            }
            Op::Control(control) => control.bodies_mut().for_each(|body| count(body, numbers, most)),
            _ => {}
        }
    }
}

/// Gives calls their arguments, and programs to those that are computed.
fn settle(body: &mut [Stmt], numbers: &[Text], most: &HashMap<Text, usize>) {
    for stmt in body {
        let span = stmt.span;
        match &mut stmt.op {
            Op::Call(call) if *call.name == *COMPUTED => {
                let number = call.arguments.remove(0);
                let mut otherwise = vec![Stmt::new(
                    span,
                    Op::Alarm(Box::new(Alarm { number: None, text: "no such O word".into() })),
                )];
                for name in numbers.iter().rev() {
                    let mut call = (**call).clone();
                    call.name = name.clone();
                    pad(&mut call, most);
                    let whole = Expr::int(name.parse().unwrap_or(0));
                    let near = vec![number.clone(), whole, Expr::Num(WHOLE)];
                    let condition = Expr::Node(Box::new(Node::Call(Function::Near, near)));
                    let then = vec![Stmt::new(span, Op::Call(Box::new(call)))];
                    let control = Control::If { condition, then, otherwise };
                    otherwise = vec![Stmt::new(span, Op::Control(Box::new(control)))];
                }
                if let Some(found) = otherwise.pop() {
                    stmt.op = found.op;
                }
            }
            Op::Call(call) if !call.shared => pad(call, most),
            Op::Control(control) => control.bodies_mut().for_each(|body| settle(body, numbers, most)),
            _ => {}
        }
    }
}

fn pad(call: &mut Call, most: &HashMap<Text, usize>) {
    if let Some(count) = most.get(&call.name) {
        call.arguments.resize(*count, Expr::int(0));
    }
}

/// The highest of the numbered locals that a body names.
fn highest(body: &[Stmt]) -> usize {
    let mut most = 0;
    for stmt in body {
        let mut op = stmt.op.clone();
        let seen = ncc_ir::program::arguments::each(&mut op, &mut |argument, _| {
            most = most.max(argument.expr().map_or(0, highest_of));
            Ok::<(), std::convert::Infallible>(())
        });
        seen.unwrap_or_else(|never| match never {});
        match &stmt.op {
            Op::Assign(to, value) => {
                let to = match to {
                    ncc_ir::expr::Target::Var(var) => Expr::Node(Box::new(Node::Var(var.clone()))),
                    ncc_ir::expr::Target::Element(element) => {
                        Expr::Node(Box::new(Node::Element((**element).clone())))
                    }
                };
                most = most.max(highest_of(&to)).max(highest_of(value));
            }
            Op::Call(call) => {
                most = most.max(call.arguments.iter().map(highest_of).max().unwrap_or(0));
            }
            Op::Control(control) => {
                let head = match &**control {
                    Control::Repeat { times: head, .. }
                    | Control::While { condition: head, .. }
                    | Control::Until { condition: head, .. }
                    | Control::If { condition: head, .. } => highest_of(head),
                    Control::Loop { .. } | Control::For { .. } => 0,
                };
                most = most.max(head).max(control.bodies().map(|body| highest(body)).max().unwrap_or(0));
            }
            _ => {}
        }
    }
    most
}

fn highest_of(expr: &Expr) -> usize {
    let Expr::Node(node) = expr else { return 0 };
    match &**node {
        Node::Var(Var::Local(name)) => name.parse().unwrap_or(0),
        Node::Element(element) => match &element.of {
            Many::Numbered(numbers) => {
                let local = numbers.iter().filter(|numbers| numbers.scope == Scope::Local);
                local.map(|numbers| numbers.to as usize).max().unwrap_or(0)
            }
            Many::Array { .. } => 0,
        },
        _ => expr.parts().map(highest_of).max().unwrap_or(0),
    }
}

/// Whether a block says nothing but that a program begins which has a name.
pub(in crate::word) fn is_title(block: &Block) -> bool {
    block.title.is_some() && block.words.is_empty() && block.faults.is_empty() && block.skip == 0
}
