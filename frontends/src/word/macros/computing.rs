//! Lowering of what is computed: words with expressions, assignments, jumps, loops and macro calls.
//!
//! At a jump target (a block that jumps name, the head of a loop, after its end) every fact is lost, as after a call.
//! A word with an empty variable is left out at run time.
//!
//! Not here: which expressions there are (`formula`), and their values.

mod values;

use std::collections::BTreeSet;

use ncc_dialects::Dialect;
use ncc_ir::diag::Fault;
use ncc_ir::expr::{Element, Expr, Function, Many, Node, Numbers, Scope, Target, Var};
use ncc_ir::program::{Control, Op, Stmt};
use ncc_ir::source::Span;
use ncc_ir::unsupported::{CallUnsupported, FlowUnsupported, ValueUnsupported};

use super::computes::{OpenLoop, label};
use super::formula::{Statement, To};
use super::named_blocks::{has_jumps, named_blocks};
use crate::batch::Batch;
use crate::common::Source;
use crate::word::calls::local_call::has_local_calls;

use crate::word::calls::return_to::has_returns_to;
use crate::word::lower::Lower;
use crate::word::text::block::Block;
use crate::word::word_state::CycleState;

/// Deepest nesting of loops (16-C, custom macro: numbers 1 to 3).
const MOST_LOOPS: usize = 3;

/// Whether any of these lines may go to another block of its program.
pub(crate) fn may_jump(dialect: &Dialect, lines: &[u8]) -> bool {
    dialect.program.macro_b
        && (has_jumps(lines) || has_returns_to(lines, dialect) || has_local_calls(lines, dialect))
}

impl Lower {
    /// Looks through text that is to be read for what is computed in it.
    pub(in crate::word) fn look_ahead(&mut self, text: &[u8], out: &mut Batch) {
        if self.settings.dialect.program.o_words {
            self.o_look_ahead(text, out);
            return self.look_for_results(text, out);
        }
        if !self.settings.dialect.program.macro_b {
            return;
        }
        if !self.computes.variables && memchr::memchr(b'#', text).is_some() {
            self.found_variables(out);
        }
        let dialect = self.settings.dialect;
        if !self.computes.jumps && may_jump(dialect, text) {
            self.computes.jumps = true;
            self.computes.named = Some(BTreeSet::new());
            self.found_variables(out);
            out.whole = true;
            self.refresh();
        }
        out.whole |= self.computes.jumps;
        if self.computes.jumps {
            self.computes.named = self.computes.named.take().and_then(|all| named_blocks(text, dialect, all));
        }
        let number = self.settings.dialect.block.number.map_or(0, |c| c as u8);
        if !self.computes.jumps {
            self.computes.unnamed |= memchr::memchr2(number, number.to_ascii_lowercase(), text).is_some();
        }
    }

    /// The text jumps somewhere: the blocks that these lines of it name are known before any of it is read.
    pub(in crate::word) fn foresee_jumps(&mut self, lines: &[u8]) {
        let computes = &mut self.computes;
        if !std::mem::replace(&mut computes.jumps, true) {
            computes.named = Some(BTreeSet::new());
            computes.variables = true;
        }
        let dialect = self.settings.dialect;
        computes.named = computes.named.take().and_then(|all| named_blocks(lines, dialect, all));
        self.refresh();
    }

    /// The text computes: programs that it calls by number have no variables of their own, the calls met before as
    /// well, whether it names a variable or not.
    pub(in crate::word) fn found_variables(&mut self, out: &mut Batch) {
        if std::mem::replace(&mut self.computes.variables, true) {
            return;
        }
        for stmt in out.stmts.iter_mut().chain(out.procedures.iter_mut().flat_map(|p| &mut p.body)) {
            share(stmt);
        }
        self.sub.iter_mut().flat_map(|p| &mut p.body).for_each(share);
    }

    /// Whether it has.
    pub(in crate::word) fn computes_anything(&self) -> bool {
        self.computes.variables
    }

    /// Whether a call has its caller's variables to itself.
    pub(in crate::word) fn shares(&self) -> bool {
        self.computes.variables
    }

    /// A block begins: the body of a loop that was opened before it does so here.
    pub(in crate::word) fn in_loop(&mut self, out: &mut Batch) {
        if self.computes.loops.last().is_some_and(|open| open.at.is_none()) {
            let at = self.target(out).len();
            if let Some(open) = self.computes.loops.last_mut() {
                open.at = Some(at);
            }
        }
    }

    /// A block with a number that jumps may name.
    pub(in crate::word) fn jumped_to(&mut self, block: &Block, out: &mut Batch) {
        let Some(number) = self.now.number.filter(|_| self.computes.jumps) else { return };
        // Control comes to it from the block before alone.
        if self.computes.passes(number) {
            return;
        }
        self.merge_paths(self.computes.reach.unsaid_at_jumps.unsaid(number), block.span, out);
        let calls = self.active_calls();
        self.computes.reach.labels.push((number, calls));
        let skip = self.now.skip.take();
        self.push(block.span, Op::Label(label(number)), out);
        self.now.skip = skip;
    }

    /// A statement of the macro language.
    pub(in crate::word) fn statement(
        &mut self,
        statement: &Statement,
        block: &Block,
        src: Source,
        out: &mut Batch,
    ) {
        self.found_variables(out);
        out.whole = true;
        let span = block.span;
        if self.now.failed {
            // A loop whose head is refused has its end all the same.
            if let Statement::Do(_, number) = statement {
                self.open(*number, None, span);
            }
            if let Statement::End(_) = statement {
                self.computes.loops.pop();
            }
            return;
        }
        match statement {
            Statement::Assign(to, value) => {
                for op in self.assignment(to, value, block, src, out) {
                    self.push(span, op, out);
                }
            }
            Statement::Goto(condition, to) => {
                let named = if let To::Number(to) = to { Some(*to) } else { None };
                if !self.jumps_from("GOTO", named, span, out) {
                    return;
                }
                match (to, condition) {
                    (To::Number(to), None) => self.push(span, Op::Goto(label(*to)), out),
                    (To::Number(to), Some(condition)) => {
                        self.decide(condition, vec![Op::Goto(label(*to))], span, out);
                    }
                    (To::Computed(to), condition) => {
                        let to = self.value(to, span, out);
                        let condition = condition.as_ref().map(|c| self.value(c, span, out));
                        let mark = self.computes.computed_jump(condition, to);
                        self.push(span, Op::Goto(mark), out);
                    }
                }
            }
            Statement::Then(condition, to, value) => {
                let then = self.assignment(to, value, block, src, out);
                self.decide(condition, then, span, out);
            }
            Statement::Do(condition, number) => {
                let twice = self.computes.loops.iter().any(|open| open.number == *number);
                if !(1..=3).contains(number) || twice || self.computes.loops.len() >= MOST_LOOPS {
                    let what = if twice { FlowUnsupported::LoopTwice } else { FlowUnsupported::LoopNumber };
                    let code = format!("DO{number}").into();
                    self.fault(Fault::NotSupported { code, what: what.into() }, span, out);
                }
                let condition = condition.as_ref().map(|c| self.value(c, span, out));
                self.now.silent = true;
                self.open(*number, condition, span);
                self.lose(span, out);
            }
            Statement::End(number) => self.end_loop(*number, span, out),
            Statement::Output(output) => self.output(output.as_ref(), span, src, out),
        }
    }

    /// A jump to the block of a number, or of one that is computed; `false` if there can be none (reported).
    pub(in crate::word) fn jumps_from(
        &mut self,
        code: &str,
        to: Option<u32>,
        span: Span,
        out: &mut Batch,
    ) -> bool {
        let passed = &self.computes.passed;
        if self.computes.unnamed || to.map_or(!passed.is_empty(), |to| passed.contains(&to)) {
            let what = FlowUnsupported::LongText.into();
            self.fault(Fault::NotSupported { code: code.into(), what }, span, out);
            return false;
        }
        let calls = self.active_calls();
        self.computes.reach.jumps.push((to, calls, span));
        self.computes.reach.unsaid_at_jumps.jump(to, self.state.unsaid());
        self.leave_motion(None, out);
        true
    }

    fn open(&mut self, number: u32, condition: Option<Expr>, block: Span) {
        let (skip, label) = (self.now.skip, self.now.number.filter(|_| !self.computes.jumps));
        let (calls, unsaid) = (self.active_calls(), self.state.unsaid());
        self.computes.loops.push(OpenLoop { number, condition, at: None, block, skip, label, calls, unsaid });
    }

    fn end_loop(&mut self, number: u32, span: Span, out: &mut Batch) {
        let found = self.computes.loops.pop();
        let Some(OpenLoop { at: Some(at), number: own, condition, block, skip, label, calls, unsaid }) =
            found
        else {
            let code = format!("END{number}").into();
            return self.fault(
                Fault::NotSupported { code, what: FlowUnsupported::EndOfNoLoop.into() },
                span,
                out,
            );
        };
        let code = format!("END{number}").into();
        if own != number {
            let what = FlowUnsupported::EndOfOther { own }.into();
            return self.fault(Fault::NotSupported { code, what }, span, out);
        }
        if calls != self.active_calls() {
            return self.refuse_under(CallUnsupported::ModalLoop, span, out);
        }
        if skip.is_some() || self.now.skip.is_some() {
            let what = FlowUnsupported::LoopSkipped.into();
            return self.fault(Fault::NotSupported { code, what }, span, out);
        }
        self.leave_motion(None, out);
        let stmts = self.target(out);
        let mut body = stmts.split_off(at.min(stmts.len()));
        if let Some(first) = body.first_mut() {
            first.joined = false;
        }
        let control = match condition {
            Some(condition) => Control::While { condition, body },
            None => Control::Loop { body },
        };
        // The statement is the whole loop, and stands where its head does.
        self.now.mark = self.now.mark.min(at);
        let own = std::mem::replace(&mut self.now.number, label);
        self.push(block, Op::Control(Box::new(control)), out);
        self.now.number = own;
        self.separate(out);
        self.merge_paths(unsaid, span, out);
    }

    /// The end of a program: a loop that is still open has none.
    pub(in crate::word) fn open_loops(&mut self, out: &mut Batch) {
        self.calls_over(out);
        for open in std::mem::take(&mut self.computes.loops) {
            let code = format!("DO{}", open.number).into();
            out.report(Fault::NotSupported { code, what: FlowUnsupported::LoopUnclosed.into() }, open.block);
            self.now.failed = true;
        }
    }

    fn decide(&mut self, condition: &Expr, then: Vec<Op>, span: Span, out: &mut Batch) {
        let condition = self.value(condition, span, out);
        let mut then: Vec<Stmt> = then.into_iter().map(|op| Stmt::new(span, op)).collect();
        then.iter_mut().skip(1).for_each(|stmt| stmt.joined = true);
        let control = Control::If { condition, then, otherwise: Vec::new() };
        self.push(span, Op::Control(Box::new(control)), out);
    }

    /// A value for a variable, or for the one whose number is computed; one of the control's own may act by it.
    fn assignment(
        &mut self,
        to: &Target,
        value: &Expr,
        block: &Block,
        src: Source,
        out: &mut Batch,
    ) -> Vec<Op> {
        match self.by_number(to, value, block, src, out) {
            Some(ops) => ops,
            None => self.plain_assignment(to, value, block, src, out),
        }
    }

    /// The same without table entries by computed numbers.
    pub(in crate::word) fn plain_assignment(
        &mut self,
        to: &Target,
        value: &Expr,
        block: &Block,
        src: Source,
        out: &mut Batch,
    ) -> Vec<Op> {
        let span = block.span;
        self.saves(to, value);
        if value.has(&|part| matches!(part, Node::Var(Var::System(_)))) {
            // What is active is asked.
            self.leave_motion(None, out);
        }
        let value = self.value(value, span, out);
        if let Target::Var(Var::System(system)) = to {
            return self.control_set(system, value, block, src, out);
        }
        let to = match to {
            Target::Var(var) => Target::Var(var.clone()),
            Target::Element(element) => {
                let Element { at, .. } = &**element;
                let at = at.iter().map(|index| self.value(index, span, out)).collect();
                Target::Element(Box::new(Element { of: self.numbered(), at }))
            }
        };
        self.assigned(Some(&to), span, out);
        vec![Op::Assign(to, value)]
    }

    /// The variables that have numbers.
    fn numbered(&self) -> Many {
        let rules = &self.settings.dialect.formula;
        let of = |scope, ranges: &[[u32; 2]]| {
            let numbers = |&[from, to]: &[u32; 2]| Numbers { scope, prefix: "".into(), from, to };
            ranges.iter().map(numbers).collect::<Vec<_>>()
        };
        let scopes = [
            of(Scope::Local, &rules.local),
            of(Scope::Common, &rules.common),
            of(Scope::Retentive, &rules.retentive),
        ];
        Many::Numbered(scopes.concat().into())
    }

    /// A variable gets another value, any where it is not said which: what has been computed from it and is not said
    /// yet must not be stated with it.
    pub(in crate::word) fn assigned(&mut self, to: Option<&Target>, span: Span, out: &mut Batch) {
        self.argument_changes(span, out);
        let reads = |value: &Expr| match to {
            Some(to) => value.reads(to),
            None => value.literal().is_none(),
        };
        self.entry_changes(reads);
        if let CycleState::Active(active) = &self.state.cycle
            && ([&active.depth, &active.retract].iter().any(|word| reads(&word.value))
                || active.peck.as_ref().is_some_and(reads))
        {
            if self.state.cycle_feed.is_some() {
                let what = ValueUnsupported::CycleUnset.into();
                self.fault(Fault::NotSupported { code: "#".into(), what }, span, out);
            }
            self.state.cycle = CycleState::Lost;
        }
    }
}

/// Whether anything is rounded in an expression.
pub(in crate::word) fn has_round(expr: &Expr) -> bool {
    let Expr::Node(node) = expr else { return false };
    match &**node {
        // Within the number of a variable it goes to a whole number wherever that stands.
        Node::Var(_) | Node::Vacant | Node::Element(_) => false,
        Node::Unary(_, a) => has_round(a),
        Node::Binary(_, a, b) => has_round(a) || has_round(b),
        Node::Call(function, arguments) => *function == Function::Round || arguments.iter().any(has_round),
    }
}

/// Gives the calls in a statement their caller's variables.
fn share(stmt: &mut Stmt) {
    if let Op::Call(call) = &mut stmt.op {
        call.shared = true;
    }
}
