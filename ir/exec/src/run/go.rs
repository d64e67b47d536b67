//! How far a run of a whole program goes at once: to so many events, to a statement, to so many steps.

use crate::{Event, Exec, Runner};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::program::Stmt;

/// How far a run has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    /// There is more.
    More,
    /// The program is over.
    Done,
}

/// How far a run has come that halts before some statements.
#[derive(Clone, Debug, PartialEq)]
pub enum Halt {
    /// There are enough events.
    Enough,
    /// Such a statement is next: the caller has it executed by [`Runner::execute`].
    Before(Stmt),
    /// The program is over.
    Done,
}

impl Runner<'_> {
    /// Executes statements until at least `enough` events are in `out`, or the program is over; or until plain moves begin,
    /// if it halts there.
    ///
    /// # Errors
    /// As of [`Exec::step`] and [`Runner::next`].
    pub fn run(
        &mut self,
        exec: &mut Exec,
        enough: usize,
        out: &mut Vec<Event>,
    ) -> Result<Progress, Diagnostic> {
        Ok(match self.run_until(exec, enough, out, |_, _| false)? {
            Halt::Enough | Halt::Before(_) => Progress::More,
            Halt::Done => Progress::Done,
        })
    }

    /// As [`Runner::run`]; halts before each statement of which `halts` says so, with its arguments computed.
    ///
    /// # Errors
    /// As of [`Exec::step`] and [`Runner::next`].
    #[inline]
    pub fn run_until(
        &mut self,
        exec: &mut Exec,
        enough: usize,
        out: &mut Vec<Event>,
        halts: impl Fn(&Exec, &Stmt) -> bool,
    ) -> Result<Halt, Diagnostic> {
        while out.len() < enough && !self.is_before_lines(exec) {
            let Some(stmt) = self.next(exec)? else { return Ok(Halt::Done) };
            if halts(exec, stmt) {
                return Ok(Halt::Before(stmt.clone()));
            }
            let (before, span) = (out.len(), stmt.span);
            exec.step(stmt, out)?;
            if out.len() > before {
                self.eventful = self.steps;
            } else if self.steps - self.eventful > self.most_idle {
                return Err(Diagnostic::new(Fault::NoEnd { steps: self.most_idle }, span));
            }
        }
        Ok(Halt::Enough)
    }

    /// Executes the statement before which the run has halted.
    ///
    /// # Errors
    /// As of [`Exec::step`].
    pub fn execute(&mut self, exec: &mut Exec, stmt: &Stmt, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let before = out.len();
        exec.step(stmt, out)?;
        if out.len() > before {
            self.eventful = self.steps;
        }
        Ok(())
    }

    /// Executes statements until the run has made so many steps, as another run of the same program has, or is over.
    ///
    /// # Errors
    /// As of [`Exec::step`] and [`Runner::next`].
    pub fn run_to(
        &mut self,
        exec: &mut Exec,
        steps: u64,
        out: &mut Vec<Event>,
    ) -> Result<Progress, Diagnostic> {
        while self.steps < steps {
            let Some(stmt) = self.next(exec)? else { return Ok(Progress::Done) };
            exec.step(stmt, out)?;
        }
        Ok(Progress::More)
    }

    /// How many steps it has made.
    pub fn steps(&self) -> u64 {
        self.steps
    }
}
