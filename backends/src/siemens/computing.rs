//! Statements of programs that compute, in Sinumerik's language: assignments, branches with their blocks, loops,
//! and jumps to labels.
//!
//! `GOTO 10` becomes `GOTOB` if label 10 is already written, else `GOTOF`. `common::formula` writes the expressions.
//!
//! Not here: the variables (`passes/variables`), their types, and calls with arguments (`variable`).

use std::collections::{BTreeSet, HashMap};

use ncc_ir::canon::Modes;
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::lack::{FlowLack, HolesLack};
use ncc_ir::program::{Control, Op, Procedure, Stmt, Text};
use ncc_ir::run_time::RunTimeFlow;
use ncc_ir::source::Span;
use ncc_passes::support::mode_analysis::has_bare_holes;

use super::{Sink, Writer, edge_left};
use crate::common::fault::{cannot, cannot_compute};

/// The last arithmetic parameter of every control: R0 to R99 (PGA, arithmetic parameters).
const LAST_EVERYWHERE: u32 = 99;

/// Facts of a program that computes, which the writer needs before its statements.
#[derive(Clone, Debug, Default)]
pub(super) struct Computing {
    /// Whether the program computes at all.
    pub(super) program: bool,
    /// Labels of all jumps and block repetitions in the program.
    targets: BTreeSet<Text>,
    /// Jump targets of the current unit that are already written.
    written: BTreeSet<Text>,
    /// Whether the program has cycles, each called in the basic block of its holes.
    cycles: bool,
    /// Source positions of statements with a distance mode per word (`IC`, `AC`), if other words depend on the
    /// active mode.
    pub(super) word_distance: BTreeSet<u32>,
    told_number: bool,
    told_comparison: bool,
    /// Number of open branches and loops around the current block.
    deep: usize,
}

impl Writer {
    /// Collects, from the procedures of a program that computes, the facts for jumps and loops, and the places of words
    /// with a distance mode of their own.
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
        // Holes of a cycle that another block calls: the cycle stays active over jumps and labels, as in the source.
        self.computing.cycles &= !procedures.iter().any(|procedure| has_bare_holes(&procedure.body));
        self.know_parameters(procedures);
        self.leave_edge = edge_left::leave_edge(procedures);
        self.main = procedures.first().cloned();
    }

    /// Collects the modes that are active at each basic block, and those that subprograms leave active.
    pub(crate) fn know_modes(&mut self, procedures: &[Procedure], entries: HashMap<u32, Modes>) {
        self.leave_edge = edge_left::leave_edge(procedures);
        self.words.know_modes(entries);
    }

    /// Starts a unit: none of its labels is written yet.
    pub(super) fn no_labels_yet(&mut self) {
        self.computing.written.clear();
    }

    /// Whether no jump names this label.
    pub(super) fn is_idle_label(&self, name: &str) -> bool {
        self.computing.program && !self.computing.targets.contains(name)
    }

    /// Whether a jump may reach this block.
    pub(super) fn is_come_to(&self) -> bool {
        self.computing.deep > 0 || !self.computing.written.is_empty()
    }

    /// Before a label, the writer cancels the active cycle.
    pub(super) fn before_label(&mut self, name: &str, sink: &mut Sink) -> Result<(), Fault> {
        if self.computing.program {
            self.computing.written.insert(name.into());
            self.without_cycle(self.computing.cycles, sink)?;
        }
        Ok(())
    }

    /// At a jump or a jump target, the writer cancels a cycle that the blocks there call or cancel.
    fn without_cycle(&mut self, changes: bool, sink: &mut Sink) -> Result<(), Fault> {
        if changes { self.end_modal(sink) } else { Ok(()) }
    }

    /// A subprogram of a program that computes ends without an active cycle: its callers call theirs again.
    pub(super) fn before_return(&mut self, sink: &mut Sink) -> Result<(), Fault> {
        let left = match self.standing.modal {
            super::Modal::Off => self.owed.is_some(),
            super::Modal::On => true,
            super::Modal::Doubtful => self.cycled,
        };
        if self.alone && left {
            // No manual at hand states whether the cycle goes on in the caller.
            return Err(cannot(HolesLack::LeftForUnknownCaller));
        }
        let left = self.computing.program && self.standing.modal == super::Modal::On;
        self.without_cycle(left, sink)
    }

    /// Reports once that variables above R99 depend on the machine data.
    pub(super) fn tell_number(&mut self, variable: &str, span: Span, sink: &mut Sink) {
        let number = variable.strip_prefix(&self.dialect.formula.prefix).and_then(|n| n.parse::<u32>().ok());
        if number.is_some_and(|n| n > LAST_EVERYWHERE)
            && !std::mem::replace(&mut self.computing.told_number, true)
        {
            let assumption = ControlFact::ManyVariables { number: number.unwrap_or_default() };
            sink.report(Fault::AssumedFact { fact: assumption }, span);
        }
    }

    /// Reports once that `<` and `>` treat nearly equal numbers as equal, unless machine data decide otherwise.
    pub(super) fn tell_comparison(&mut self, condition: &str, span: Span, sink: &mut Sink) {
        let exact = condition.contains(['<', '>']);
        if exact && !std::mem::replace(&mut self.computing.told_comparison, true) {
            sink.report(Fault::AssumedFact { fact: ControlFact::InexactComparison }, span);
        }
    }

    /// Writes a jump in its own block: `GOTOF` or `GOTOB`.
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

    /// Before a change of control flow, pending text is written.
    fn flow(&mut self, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        self.settle_edge(span, sink)?;
        self.pay_call(sink)?;
        self.restate_feed(span, sink)
    }

    /// Writes a branch or a loop with its body. Refuses it if the block has a block skip.
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

    /// Ends the block of a label before a keyword. No manual at hand allows both in one block.
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

/// Whether the blocks, or their bodies, contain a statement with `is`.
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

/// Whether a statement may call or cancel a cycle.
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
