//! Execution of a program that is kept whole: calls, repetitions, variables and jumps, one statement at a time.
//!
//! ```text
//! while #1 <= 3 { … }    three times the events of its body
//! CALL("8000", #1 = 5)   those of the subprogram, with #1 = 5
//! ```
//!
//! Not here: what a statement does to the machine (`Exec`).

mod calls;
pub(crate) mod code;
mod compute;
pub(crate) mod endless_loop;
pub(crate) mod entry;
pub(crate) mod go;
pub(crate) mod left;
mod lines;
pub(crate) mod nesting;
mod quick;
mod repeated;
pub(crate) mod required_arguments;
pub(crate) mod term;

use std::rc::Rc;

use super::Exec;
use crate::halt;
use crate::run::code::{At, Code, Counter, Declared, Step};
use crate::run::endless_loop::EndlessLoop;
use crate::run::lines::{LinesAhead, Worth};
use crate::run::nesting::{Blocks, Frame};
pub use crate::run::repeated::again;
use crate::run::required_arguments::required_arguments;
use crate::run::term::{Asked, Indexed, Place, Term, Variables, Why};
use ncc_ir::canon::FeedMode;
use ncc_ir::computed::computed_code::is_last;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Var;
use ncc_ir::expr::value::Value;
use ncc_ir::program::{Op, Program, Stmt};
use ncc_ir::source::Span;
use ncc_ir::unexecuted::ValueUnexecuted;

/// Most steps of a run, unless another number is asked for; a program that needs more is taken for one without an
/// end.
pub const MOST_STEPS: u64 = 50_000_000;

/// Most of them between two statements that are executed by themselves, and between two that anything comes of: a
/// control that executes a thousand blocks a second stands still for half an hour with so many.
const MOST_IDLE: u64 = 2_000_000;

/// A run of a whole program from its first statement.
#[derive(Clone, Debug)]
pub struct Runner<'p> {
    code: Rc<Code<'p>>,
    /// The next step.
    at: At,
    /// Packed moves that are under way.
    lines: LinesAhead<'p>,
    /// Whether [`Runner::run`] halts before them.
    halts_at_lines: bool,
    /// Calls active; the first is the main procedure.
    calls: Vec<Frame>,
    /// Further turns of the bodies that are counted and open.
    turns: Vec<u64>,
    /// Blocks that are executed again.
    blocks: Vec<Blocks>,
    /// Where those of them that are the innermost end, if the present call executes them.
    end: At,
    pub(super) variables: Variables,
    /// The statement of which arguments were computed last, with them, and its place in [`Code::computed`].
    now: Stmt,
    now_of: usize,
    pub(super) steps: u64,
    /// Steps at the last event.
    pub(super) eventful: u64,
    endless_loop: EndlessLoop,
    /// Covered sides of each branch: 1 where it held, 2 where it did not.
    taken: Vec<u8>,
    /// Most steps of all.
    most: u64,
    /// Most steps between two statements that are executed by themselves.
    pub(super) most_idle: u64,
    /// Parameters of the main procedure that are read, with the place where it begins.
    pub(super) required: Vec<(Var, Place, Span)>,
}

/// No step.
const NOWHERE: At = At::MAX;

impl<'p> Runner<'p> {
    /// Ready to run the main procedure.
    pub fn new(program: &'p Program) -> Runner<'p> {
        let code = Code::new(program);
        let required = required_arguments(program, &code.names);
        let (parameters, given) = (Rc::new([]), Rc::new([]));
        let main =
            Frame { entry: 0, back: NOWHERE, again: 0, turns: 0, base: 0, shared: false, parameters, given };
        Runner {
            at: 0,
            lines: LinesAhead::default(),
            halts_at_lines: false,
            calls: vec![main],
            turns: Vec::new(),
            blocks: Vec::new(),
            end: NOWHERE,
            variables: Variables::new(&code.names),
            now: Stmt::new(Span::default(), Op::Blank),
            now_of: usize::MAX,
            steps: 0,
            eventful: 0,
            endless_loop: EndlessLoop::default(),
            taken: vec![0; code.steps.len()],
            most: MOST_STEPS,
            most_idle: MOST_IDLE,
            required,
            code: Rc::new(code),
        }
    }

    /// Gives variables their values before the program begins: local ones of the main procedure, and those that
    /// all procedures see.
    pub fn give(&mut self, value: &mut dyn FnMut(&Var) -> Option<Value>) {
        for (var, place) in self.code.names.all() {
            if let Some(value) = value(&var) {
                self.variables.set(place, value);
            }
        }
    }

    /// What the main procedure takes must be given to it from elsewhere.
    #[cold]
    pub(crate) fn parameters_have_values(&self) -> Result<(), Diagnostic> {
        for (var, place, span) in &self.required {
            if self.variables.get(*place) == Value::Vacant {
                let name = var.name().into();
                return Err(Diagnostic::new(Fault::VariableUnset { name }, *span));
            }
        }
        Ok(())
    }

    /// The block of the step that was made last.
    pub fn here(&self) -> Span {
        let before = || match self.code.steps.get((self.at as usize).saturating_sub(1)) {
            Some(Step::Lines(_, lines, _)) => lines.last(),
            step => step.and_then(Step::stmt).map_or(Span::default(), |stmt| stmt.span),
        };
        self.lines.last().unwrap_or_else(before)
    }

    /// Has a run be taken for one without an end after so many steps.
    pub fn limit(&mut self, most: u64) {
        self.most = most;
    }

    /// Has a run that decides and computes without doing anything, or does only what changes nothing, be taken for one
    /// without an end after so many steps.
    pub fn limit_idle(&mut self, most: u64) {
        self.most_idle = most;
    }

    /// Adds the covered sides of branches to those of other runs of the same program.
    pub fn add_taken(&self, all: &mut Vec<u8>) {
        all.resize(self.taken.len(), 0);
        all.iter_mut().zip(&self.taken).for_each(|(all, taken)| *all |= taken);
    }

    /// Branches with an uncovered side, in the order of the text: the ways that
    /// were, 0 to 2, as of [`Runner::add_taken`]. Checks that the call of a cycle makes of its own values are not
    /// the program's branches.
    pub fn uncovered_branches(&self, all: &[u8]) -> Vec<(Span, u8)> {
        let steps = self.code.steps.iter().zip(all).enumerate();
        let mut found: Vec<(Span, u8)> = steps
            .filter_map(|(at, (step, taken))| match step {
                Step::Unless(stmt, ..) if self.is_check(at, stmt.span) => None,
                Step::Unless(_, _, to) if *taken == 1 && self.is_no_code(*to) => None,
                Step::Unless(stmt, ..) | Step::UnlessCounted(stmt, ..) if *taken != 3 => {
                    Some((stmt.span, *taken))
                }
                _ => None,
            })
            .collect();
        found.sort_by_key(|(span, _)| span.start);
        // Of branches that are made of one place, one that was not reached says nothing further.
        found.dedup_by(|next, before| next.0 == before.0 && next.1 == 0);
        found
    }

    /// Number of branches with an uncovered side, such checks included.
    pub fn open_ways(&self, all: &[u8]) -> usize {
        let decides = |step: &Step| matches!(step, Step::Unless(..) | Step::UnlessCounted(..));
        self.code.steps.iter().zip(all).filter(|(step, taken)| decides(step) && **taken != 3).count()
    }

    /// Whether no value reaches a step, after the last code of a group.
    fn is_no_code(&self, at: u32) -> bool {
        matches!(self.code.steps.get(at as usize), Some(Step::Do(stmt)) if is_last(&stmt.op))
    }

    /// Whether a branch is an alarm's, of the block that then activates a cycle.
    fn is_check(&self, at: usize, block: Span) -> bool {
        let is = |at: usize, op: fn(&Op) -> bool| {
            let step = self.code.steps.get(at);
            matches!(step, Some(Step::Do(stmt) | Step::Compute(stmt, _)) if op(&stmt.op) && stmt.span == block)
        };
        let calls = |after: usize| is(after, |op| matches!(op, Op::StartCycle(_)));
        is(at + 1, |op| matches!(op, Op::Alarm(_))) && (calls(at + 2) || calls(at + 3))
    }

    /// Whether another run of the same program stands at the same step, with the same in its variables.
    pub fn is_at(&self, other: &Runner) -> bool {
        (self.at, self.end, self.steps) == (other.at, other.end, other.steps)
            && self.calls.len() == other.calls.len()
            && self.turns == other.turns
            && self.variables == other.variables
    }

    /// Goes through calls, repetitions, jumps and assignments to the next statement that is to be executed by
    /// itself, its arguments computed; the caller executes it. `None` is the program's end.
    ///
    /// # Errors
    /// A call or label that there is not, a call without an end, an expression without a value.
    pub fn next(&mut self, exec: &Exec) -> Result<Option<&Stmt>, Diagnostic> {
        self.next_of(exec, None)
    }

    /// As [`Runner::next`]; of the control's own values, only those are known of which another control that has
    /// executed the same statements has the same.
    ///
    /// # Errors
    /// As of [`Runner::next`].
    pub fn next_of(&mut self, exec: &Exec, other: Option<&Exec>) -> Result<Option<&Stmt>, Diagnostic> {
        // The steps are shared, so that they can be read while the rest changes.
        let code = Rc::clone(&self.code);
        let asked = Asked { exec, other, system: &code.names.system };
        let before = self.steps;
        if self.steps == 0 {
            self.parameters_have_values()?;
        }
        if exec.ended() {
            return Ok(None);
        }
        loop {
            self.go_quickly(&code, exec, before)?;
            if self.at == self.end {
                self.end_of_blocks();
                continue;
            }
            let step = &code.steps[self.at as usize];
            if let Step::Lines(..) = step {
                match self.lines_ahead(exec).first().map(|stmt| stmt.span) {
                    Some(span) => return self.next_line(before, span),
                    None => match self.lines.fault() {
                        Some(fault) => return Err(fault.clone()),
                        None => continue,
                    },
                }
            }
            self.steps += 1;
            self.at += 1;
            let Some(stmt) = step.stmt() else {
                if self.leave() {
                    continue;
                }
                exec.no_open_corner()?;
                return Ok(None);
            };
            let span = stmt.span;
            self.may_go_on(before, span)?;
            if stmt.skip.is_some_and(|level| exec.skip >> level & 1 == 1) {
                if let Step::Unskipped(_, to) = step {
                    self.at = *to;
                }
                continue;
            }
            match step {
                Step::Do(_) => return Ok(Some(stmt)),
                Step::Compute(_, at) => {
                    if self.compute(*at as usize, asked)? {
                        return Ok(Some(&self.now));
                    }
                }
                Step::Assign(_, to) => self.assign(to.0, &to.1, asked, span)?,
                Step::AssignElement(_, to) => self.assign_element(to.0.as_ref(), &to.1, asked, span)?,
                Step::Declare(_, declared) => self.declare(declared, asked, span)?,
                Step::Jump(_, to) => {
                    let from = std::mem::replace(&mut self.at, *to);
                    self.goes_on(from, span)?;
                }
                Step::Again(_, to) => self.another_turn(*to),
                Step::Unskipped(..) | Step::Lines(..) | Step::End => {}
                Step::Unless(_, condition, to) => {
                    let value = self.variables.number(condition, asked);
                    let value = value.map_err(|why| self.no_value(why, span))?;
                    self.decide(value == 0.0, *to);
                }
                Step::UnlessCounted(_, counter, to) => {
                    self.decide(self.is_counted_out(counter), *to);
                }
                Step::Count(_, counter) => self.count(counter),
                Step::Turns(_, times, to) => {
                    exec.no_open_corner()?;
                    match self.times(times, 0, asked, span)? {
                        0 => self.at = *to,
                        times => self.turns.push(times - 1),
                    }
                }
                Step::Goto(_, to) => {
                    exec.no_open_corner()?;
                    let from = self.at;
                    self.jump(*to, stmt)?;
                    self.goes_on(from, span)?;
                }
                Step::Call(_, called) => {
                    exec.no_open_corner()?;
                    self.call(called, asked, span)?;
                }
                Step::Return(_) => {
                    exec.no_open_corner()?;
                    // A standalone subprogram has been executed.
                    if !self.leave() {
                        return Ok(None);
                    }
                }
                Step::Blocks(_, again) => {
                    exec.no_open_corner()?;
                    let times = self.times(&again.times, u8::from(again.computed), asked, span)?;
                    self.again(again, times, stmt)?;
                }
            }
        }
    }

    /// The next of the packed moves, which stands there.
    #[inline]
    fn next_line(&mut self, before: u64, span: Span) -> Result<Option<&Stmt>, Diagnostic> {
        self.steps += 1;
        self.may_go_on(before, span)?;
        Ok(self.lines.take())
    }

    /// A branch: goes there where it does not hold.
    #[inline]
    fn decide(&mut self, fails: bool, to: At) {
        self.taken[self.at as usize - 1] |= if fails { 2 } else { 1 };
        if fails {
            self.at = to;
        }
    }

    /// Whether a counter is beyond its end.
    #[inline]
    fn is_counted_out(&self, counter: &Counter) -> bool {
        let [count, end, pace] =
            [counter.place, counter.end, counter.pace].map(|place| self.variables.get(place).number());
        if pace < 0.0 { count < end } else { count > end }
    }

    #[inline]
    fn count(&mut self, counter: &Counter) {
        let [count, pace] = [counter.place, counter.pace].map(|place| self.variables.get(place).number());
        self.variables.set(counter.place, Value::Number(count + pace));
    }

    /// Some of the packed moves that come next, if they do.
    pub fn lines_ahead(&mut self, exec: &Exec) -> &[Stmt] {
        if self.at == self.end {
            return &[];
        }
        let Code { steps, shapes, names, .. } = &*self.code;
        let Some(Step::Lines(_, lines, at)) = steps.get(self.at as usize) else { return &[] };
        let worth = Worth {
            shapes: &shapes[*at as usize],
            names,
            variables: &self.variables,
            per_time: exec.state.feed_mode == FeedMode::InverseTime,
        };
        if self.lines.of(lines, worth).is_empty() && self.lines.fault().is_none() {
            self.lines.leave();
            self.at += 1;
        }
        self.lines.unpacked()
    }

    /// Whether [`Runner::run`] and [`Runner::run_until`] halt before packed moves, so that they can be executed once for
    /// two runs.
    pub fn halt_at_lines(&mut self, halts: bool) {
        self.halts_at_lines = halts;
    }

    /// Whether the run halts here: before packed moves, or after the first of them where control has reached it.
    #[inline]
    fn is_before_lines(&mut self, exec: &Exec) -> bool {
        let are_next = matches!(self.code.steps.get(self.at as usize), Some(Step::Lines(..)));
        self.halts_at_lines && are_next && !self.lines_ahead(exec).is_empty()
    }

    /// Another run has executed so many of [`Runner::lines_ahead`] for this one as well, and so many events came of it.
    ///
    /// # Errors
    /// The run has had enough steps, or was stopped.
    pub fn has_passed(&mut self, many: usize, events: u64) -> Result<(), Diagnostic> {
        self.lines.pass(many);
        let before = self.steps;
        self.steps += many as u64;
        if events > 0 {
            self.eventful = self.steps;
        }
        halt::has_made(before, self.steps);
        self.may_go_on(self.steps - 1, self.here())
    }

    /// That the run is within its limits, and nobody has stopped it; `before` is how many steps it had before the present
    /// statement.
    #[inline]
    fn may_go_on(&self, before: u64, span: Span) -> Result<(), Diagnostic> {
        if halt::is_asked_at(self.steps) {
            return Err(Diagnostic::new(Fault::Interrupted { steps: self.steps }, span));
        }
        if self.steps > self.most {
            return Err(Diagnostic::new(Fault::NoEnd { steps: self.most }, span));
        }
        if self.steps - before > self.most_idle {
            return Err(Diagnostic::new(Fault::NoEnd { steps: self.most_idle }, span));
        }
        Ok(())
    }

    /// Gives a variable a value; without a place it is one of the control's own.
    #[inline]
    fn assign(
        &mut self,
        place: Option<Place>,
        term: &Term,
        asked: Asked,
        span: Span,
    ) -> Result<(), Diagnostic> {
        let value = self.variables.value_at_length(term, asked).map_err(|why| self.no_value(why, span))?;
        let Some(place) = place else {
            return Err(Diagnostic::new(Fault::not_executed(ValueUnexecuted::ControlVariableSet), span));
        };
        self.variables.set(place, value);
        Ok(())
    }

    /// Gives an element of an array, or a variable by its number, a value.
    #[inline]
    fn assign_element(
        &mut self,
        element: Option<&Indexed>,
        term: &Term,
        asked: Asked,
        span: Span,
    ) -> Result<(), Diagnostic> {
        let place = element.ok_or(Why::Index).and_then(|e| self.variables.at(e, asked));
        let value = self.variables.value(term, asked);
        let (place, value) =
            place.and_then(|place| Ok((place, value?))).map_err(|why| self.no_value(why, span))?;
        self.variables.set(place, value);
        Ok(())
    }

    /// How many times something is repeated: a whole number, `least` or more.
    #[inline]
    fn times(&self, times: &Term, least: u8, asked: Asked, span: Span) -> Result<u64, Diagnostic> {
        let times = self.variables.number(times, asked).map_err(|why| self.no_value(why, span))?;
        if times < f64::from(least) || times != times.trunc() || times > self.most as f64 {
            return Err(Diagnostic::new(Fault::OutOfRange { word: "times".into() }, span));
        }
        Ok(times as u64)
    }

    /// Whether the program asks for values of the control's own.
    pub fn asks(&self) -> bool {
        !self.code.names.system.is_empty()
    }

    fn declare(&mut self, declared: &Declared, asked: Asked, span: Span) -> Result<(), Diagnostic> {
        let Some((first, count)) = declared.places else { return Err(self.no_value(Why::Index, span)) };
        for offset in 0..count {
            let value = match declared.values.get(offset as usize) {
                Some(Some(term)) => {
                    self.variables.value(term, asked).map_err(|why| self.no_value(why, span))?
                }
                Some(None) | None => Value::Number(0.0),
            };
            let place = match first {
                Place::Local(first) => Place::Local(first + offset),
                Place::Shared(first) => Place::Shared(first + offset),
            };
            self.variables.set(place, value);
        }
        Ok(())
    }

    #[cold]
    fn no_value(&self, why: Why, span: Span) -> Diagnostic {
        Diagnostic::new(self.code.names.fault(why), span)
    }
}
