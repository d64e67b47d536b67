//! Statements of programs that compute, in the language's own words: assignments, decisions with their blocks, loops,
//! and jumps to labels.
//!
//! A jump says whether its label stands before it or behind. Expressions are spelt by the dictionary (`common::formula`).
//!
//! Not here: which variables there are (`passes/variables`), their types, and calls with arguments (`variable`).

use std::collections::{BTreeSet, HashMap};

use ncc_ir::canon::Modes;
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::lack::{FlowLack, HolesLack};
use ncc_ir::program::{Control, Op, Procedure, Stmt, Text};
use ncc_ir::run_time::RunTimeFlow;
use ncc_ir::source::Span;
use ncc_passes::support::mode_analysis::has_bare_holes;

use super::{Sink, Writer, edge_left};
use crate::common::fault::{cannot, cannot_compute};

/// The last of the arithmetic parameters that every control has: R0 to R99 (PGA, arithmetic parameters).
const LAST_EVERYWHERE: u32 = 99;

/// What of a program that computes the writer must know before its statements.
#[derive(Clone, Debug, Default)]
pub(super) struct Computing {
    /// Whether the program computes at all.
    pub(super) program: bool,
    /// Labels that are jumped to.
    targets: BTreeSet<Text>,
    /// Those of the unit at hand that stand in the text already.
    written: BTreeSet<Text>,
    /// Whether there are cycles in it, each of which is called up in the stretch of blocks that makes its holes.
    cycles: bool,
    /// Statements whose words say their own distance mode, where others rely on the one in force, by their places.
    pub(super) word_distance: BTreeSet<u32>,
    told_number: bool,
    told_comparison: bool,
    /// How many structures are open.
    deep: usize,
}

impl Writer {
    /// Takes what jumps and loops need to know of the procedures of a program that computes, and at which places words
    /// say their own distance mode.
    pub(crate) fn know(
        &mut self,
        procedures: &[Procedure],
        word_distance: &BTreeSet<u32>,
        entries: HashMap<u32, Modes>,
    ) {
        self.computing.program = true;
        self.computing.word_distance.clone_from(word_distance);
        self.words.is_kept(entries);
        procedures.iter().for_each(|procedure| self.computing.look(&procedure.body));
        // Holes that rely on a cycle called up elsewhere: it stays in force over jumps and labels, as in the source.
        self.computing.cycles &= !procedures.iter().any(|procedure| has_bare_holes(&procedure.body));
        self.know_parameters(procedures);
        self.leave_edge = edge_left::leave_edge(procedures);
        self.main = procedures.first().cloned();
    }

    /// Takes which modes are in force where stretches of blocks begin, and what its subprograms leave active.
    pub(crate) fn know_modes(&mut self, procedures: &[Procedure], entries: HashMap<u32, Modes>) {
        self.leave_edge = edge_left::leave_edge(procedures);
        self.words.know_modes(entries);
    }

    /// A unit begins.
    pub(super) fn no_labels_yet(&mut self) {
        self.computing.written.clear();
    }

    /// Whether a label stands for nothing: a block that nothing jumps to.
    pub(super) fn is_idle_label(&self, name: &str) -> bool {
        self.computing.program && !self.computing.targets.contains(name)
    }

    /// Whether a block may be come to from another one than that before it.
    pub(super) fn is_come_to(&self) -> bool {
        self.computing.deep > 0 || !self.computing.written.is_empty()
    }

    /// A label is about to be written, at which no cycle is in force.
    pub(super) fn before_label(&mut self, name: &str, sink: &mut Sink) -> Result<(), Fault> {
        if self.computing.program {
            self.computing.written.insert(name.into());
            self.without_cycle(self.computing.cycles, sink)?;
        }
        Ok(())
    }

    /// Where control goes, or comes from, no cycle is left in force that blocks there call up or end.
    fn without_cycle(&mut self, changes: bool, sink: &mut Sink) -> Result<(), Fault> {
        if changes { self.end_modal(sink) } else { Ok(()) }
    }

    /// A subprogram of a program that computes ends with no cycle in force: its callers call theirs up again.
    pub(super) fn before_return(&mut self, sink: &mut Sink) -> Result<(), Fault> {
        let left = match self.standing.modal {
            super::Modal::Off => self.owed.is_some(),
            super::Modal::On => true,
            super::Modal::Doubtful => self.cycled,
        };
        if self.alone && left {
            // There, whether a caller goes on with it is not said in any manual that could be read.
            return Err(cannot(HolesLack::LeftForUnknownCaller));
        }
        let left = self.computing.program && self.standing.modal == super::Modal::On;
        self.without_cycle(left, sink)
    }

    /// Variables beyond those that every control has are the machine's.
    pub(super) fn tell_number(&mut self, variable: &str, span: Span, sink: &mut Sink) {
        let number = variable.strip_prefix(&self.dialect.formula.prefix).and_then(|n| n.parse::<u32>().ok());
        if number.is_some_and(|n| n > LAST_EVERYWHERE)
            && !std::mem::replace(&mut self.computing.told_number, true)
        {
            let parameter = "MD 28050 MM_NUM_R_PARAM".into();
            let value = format!("more than {}", number.unwrap_or_default()).into();
            sink.report(Fault::AssumedParameter { parameter, value }, span);
        }
    }

    /// Two numbers that are nearly equal are so for `<` and `>` too, unless the machine has it otherwise.
    pub(super) fn tell_comparison(&mut self, condition: &str, span: Span, sink: &mut Sink) {
        let exact = condition.contains(['<', '>']);
        if exact && !std::mem::replace(&mut self.computing.told_comparison, true) {
            let parameter = "MD 10280 PROG_FUNCTION_MASK bit 0".into();
            let value = "0: real numbers that are nearly equal are not less or greater".into();
            sink.report(Fault::AssumedParameter { parameter, value }, span);
        }
    }

    /// A jump.
    pub(super) fn go_to(&mut self, label: &str, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        self.words.spelling(None)?;
        self.flow(span, sink)?;
        self.without_cycle(self.computing.cycles, sink)?;
        let text = self.jump(label, span, sink);
        self.alone(&text, sink)
    }

    fn jump(&mut self, label: &str, span: Span, sink: &mut Sink) -> String {
        let way = if self.computing.written.contains(label) { "GOTOB" } else { "GOTOF" };
        format!("{way} {}", self.label_name(label, span, sink))
    }

    /// What comes next goes another way: what waits is written.
    fn flow(&mut self, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        self.settle_edge(span, sink)?;
        self.pay_call(sink)?;
        self.restate_feed(span, sink)
    }

    /// A decision or a loop.
    pub(super) fn structure(&mut self, control: &Control, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        let span = stmt.span;
        self.words.spelling(None)?;
        let computes = self.dialect.caps.flow.computes.as_ref();
        if let Some(entry) = computes.and_then(|computes| computes.computed_entry(control)) {
            return self.entry_of_number(&entry, stmt, sink);
        }
        if stmt.skip.is_some() {
            return Err(cannot(FlowLack::SkippedTogether));
        }
        let within = |is: fn(&Op) -> bool| control.bodies().any(|body| any(body, is));
        let changes = if within(|op| matches!(op, Op::Goto(_))) {
            self.computing.cycles
        } else {
            within(changes_cycle)
        };
        self.flow(span, sink)?;
        self.without_cycle(changes, sink)?;
        let condition = |writer: &mut Writer, e: &Expr, sink: &mut Sink| {
            let text = writer.words.expression(e, span, sink)?;
            writer.tell_comparison(&text, span, sink);
            Ok::<String, Fault>(text)
        };
        match control {
            Control::If { condition: e, then, otherwise } => {
                let holds = condition(self, e, sink)?;
                if let ([Stmt { op: Op::Goto(label), .. }], []) = (&then[..], &otherwise[..]) {
                    let jump = self.jump(label, span, sink);
                    return self.alone(&format!("IF {holds} {jump}"), sink);
                }
                self.opens(&format!("IF {holds}"), sink)?;
                self.inner(then, changes, stmt, sink);
                if !otherwise.is_empty() {
                    self.opens("ELSE", sink)?;
                    self.inner(otherwise, changes, stmt, sink);
                }
                self.closes("ENDIF", sink)
            }
            Control::While { condition: e, body } => {
                let holds = condition(self, e, sink)?;
                self.opens(&format!("WHILE {holds}"), sink)?;
                self.inner(body, changes, stmt, sink);
                self.closes("ENDWHILE", sink)
            }
            Control::Loop { body } => {
                self.opens("LOOP", sink)?;
                self.inner(body, changes, stmt, sink);
                self.closes("ENDLOOP", sink)
            }
            Control::Until { condition: e, body } => {
                self.opens("REPEAT", sink)?;
                self.inner(body, changes, stmt, sink);
                let holds = condition(self, e, sink)?;
                self.closes(&format!("UNTIL {holds}"), sink)
            }
            Control::For { body, .. } => {
                let head = self.counted(control, span, sink)?;
                self.opens(&head, sink)?;
                self.inner(body, changes, stmt, sink);
                self.closes("ENDFOR", sink)
            }
            Control::Repeat { .. } => Err(cannot(FlowLack::RepetitionUnknown)),
        }
    }

    fn opens(&mut self, text: &str, sink: &mut Sink) -> Result<(), Fault> {
        let most = self.dialect.formula.loops;
        if self.computing.deep >= most.into() {
            return Err(cannot_compute(RunTimeFlow::StructureDepth { most }));
        }
        self.behind_label(sink);
        self.alone(text, sink)?;
        self.words.flush(false, sink);
        self.words.block_written(sink.out);
        self.forget();
        Ok(())
    }

    /// A label has a block of its own before a word of a structure: nothing found says that it may stand in the same
    /// one.
    fn behind_label(&mut self, sink: &mut Sink) {
        if !self.words.block.is_empty() {
            self.words.flush(false, sink);
            self.words.split = true;
        }
    }

    fn inner(&mut self, body: &[Stmt], changes: bool, stmt: &Stmt, sink: &mut Sink) {
        self.computing.deep += 1;
        self.body(body, sink);
        self.computing.deep -= 1;
        self.words.open_block(&Stmt::new(stmt.span, Op::Blank));
        if let Some(trace) = &mut self.words.trace {
            trace.enter(std::slice::from_ref(stmt));
        }
        let over = self.flow(stmt.span, sink).and_then(|()| self.without_cycle(changes, sink));
        if let Err(fault) = over {
            sink.report(fault, stmt.span);
        }
    }

    fn closes(&mut self, text: &str, sink: &mut Sink) -> Result<(), Fault> {
        self.behind_label(sink);
        self.alone(text, sink)?;
        self.forget();
        Ok(())
    }
}

/// Whether any of the blocks, or of those in their bodies, is one of these.
fn any(body: &[Stmt], is: fn(&Op) -> bool) -> bool {
    body.iter().any(|stmt| {
        if let Op::Control(control) = &stmt.op
            && control.bodies().any(|body| any(body, is))
        {
            return true;
        }
        is(&stmt.op)
    })
}

/// Calls cycles up or ends them.
fn changes_cycle(op: &Op) -> bool {
    matches!(op, Op::StartCycle(_) | Op::EndCycle | Op::Pattern(_) | Op::Call(_))
}

impl Computing {
    fn look(&mut self, body: &[Stmt]) {
        for stmt in body {
            self.cycles |= matches!(stmt.op, Op::StartCycle(_) | Op::Pattern(_));
            if let Op::Goto(name) = &stmt.op {
                self.targets.insert(name.clone());
            } else if let Op::RepeatBlocks(repeat) = &stmt.op {
                self.targets.insert(repeat.from.clone());
                self.targets.extend(repeat.to.clone());
            } else if let Op::Control(control) = &stmt.op {
                control.bodies().for_each(|body| self.look(body));
            }
        }
    }
}
