//! Execution of a program that is kept whole: calls and repetitions, one statement at a time.

use super::{Event, Exec};
use crate::diag::{Diagnostic, Fault};
use crate::program::{Control, Op, Program, Stmt};

/// Deepest nesting of calls and repetitions.
const DEEPEST: usize = 64;

/// Most statements of one run; a program that needs more does not come to an end.
const MOST_STEPS: u64 = 2_000_000_000;

/// How far a run has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    /// There is more.
    More,
    /// The program is over.
    Done,
}

/// A run of a whole program from its first statement.
#[derive(Clone, Debug)]
pub struct Runner<'p> {
    program: &'p Program,
    stack: Vec<Level<'p>>,
    steps: u64,
}

#[derive(Clone, Debug)]
struct Level<'p> {
    body: &'p [Stmt],
    next: usize,
    /// Further turns after this one.
    again: u64,
    /// Whether a return ends it.
    call: bool,
}

impl<'p> Runner<'p> {
    /// Ready to run the main procedure.
    pub fn new(program: &'p Program) -> Runner<'p> {
        let body = program.procedures.first().map_or(&[][..], |p| &p.body);
        Runner { program, stack: vec![Level { body, next: 0, again: 0, call: false }], steps: 0 }
    }

    /// Executes statements until at least `enough` events are in `out`, or the program is over.
    ///
    /// # Errors
    /// As of [`Exec::step`]; an unknown or endless call.
    pub fn run(
        &mut self,
        exec: &mut Exec,
        enough: usize,
        out: &mut Vec<Event>,
    ) -> Result<Progress, Diagnostic> {
        while out.len() < enough {
            let Some(stmt) = self.next(exec)? else {
                return Ok(Progress::Done);
            };
            exec.step(stmt, out)?;
        }
        Ok(Progress::More)
    }

    /// Goes through calls and repetitions to the next statement that is to be executed by itself;
    /// the caller executes it. `None` is the program's end.
    ///
    /// # Errors
    /// An unknown or endless call, or control that is not executed.
    pub fn next(&mut self, exec: &Exec) -> Result<Option<&'p Stmt>, Diagnostic> {
        loop {
            if exec.ended() {
                return Ok(None);
            }
            let Some(level) = self.stack.last_mut() else {
                exec.no_open_corner()?;
                return Ok(None);
            };
            let Some(stmt) = level.body.get(level.next) else {
                if level.again > 0 {
                    level.again -= 1;
                    level.next = 0;
                } else {
                    self.stack.pop();
                }
                continue;
            };
            level.next += 1;
            self.steps += 1;
            if self.steps > MOST_STEPS {
                return Err(Diagnostic::new(Fault::NoEnd { steps: MOST_STEPS }, stmt.span));
            }
            if stmt.skip.is_some_and(|level| exec.skip >> level & 1 == 1) {
                continue;
            }
            if matches!(stmt.op, Op::Call(_) | Op::Return | Op::RepeatBlocks(_) | Op::Control(_)) {
                exec.no_open_corner()?;
            }
            match &stmt.op {
                Op::Call(call) => {
                    let Some(callee) = self.program.procedures.iter().skip(1).find(|p| p.name == call.name)
                    else {
                        return Err(Diagnostic::new(
                            Fault::CallUnknown { name: call.name.clone() },
                            stmt.span,
                        ));
                    };
                    if call.times > 0 {
                        self.push(&callee.body, u64::from(call.times - 1), true, stmt)?;
                    }
                }
                Op::Return => {
                    while let Some(level) = self.stack.last_mut() {
                        if level.call {
                            level.next = level.body.len();
                            break;
                        }
                        if self.stack.len() == 1 {
                            let what = "a return of the main program".into();
                            return Err(Diagnostic::new(Fault::NotExecuted { what }, stmt.span));
                        }
                        self.stack.pop();
                    }
                }
                Op::RepeatBlocks(repeat) => {
                    let (body, at) = (level.body, level.next - 1);
                    let Some(blocks) = again(body, at, &repeat.from, repeat.to.as_deref()) else {
                        let name = repeat.from.clone();
                        return Err(Diagnostic::new(Fault::LabelUnknown { name }, stmt.span));
                    };
                    if repeat.times > 0 {
                        self.push(blocks, u64::from(repeat.times - 1), false, stmt)?;
                    }
                }
                Op::Control(control) => match &**control {
                    Control::Repeat { times, body } => match times.literal().and_then(|n| n.whole()) {
                        Some(0) => {}
                        Some(n) if n > 0 => self.push(body, n as u64 - 1, false, stmt)?,
                        Some(_) | None => exec.not_executed("a computed repetition", stmt.span)?,
                    },
                    Control::Loop { .. }
                    | Control::While { .. }
                    | Control::For { .. }
                    | Control::If { .. } => exec.not_executed("control of the program's flow", stmt.span)?,
                },
                _ => return Ok(Some(stmt)),
            }
        }
    }

    fn push(&mut self, body: &'p [Stmt], again: u64, call: bool, at: &Stmt) -> Result<(), Diagnostic> {
        if self.stack.len() >= DEEPEST {
            let name = match &at.op {
                Op::Call(call) => call.name.clone(),
                _ => "".into(),
            };
            return Err(Diagnostic::new(Fault::CallRecursive { name }, at.span));
        }
        self.stack.push(Level { body, next: 0, again, call });
        Ok(())
    }
}

/// The blocks that a repetition at `at` executes again: from its label to itself, or to the end of
/// another label's block.
pub(crate) fn again<'p>(body: &'p [Stmt], at: usize, from: &str, to: Option<&str>) -> Option<&'p [Stmt]> {
    let label =
        |name: &str| body[..at].iter().rposition(|s| matches!(&s.op, Op::Label(label) if **label == *name));
    let start = label(from)?;
    let end = match to {
        None => {
            // The repetition's own block is not executed again.
            (start..=at).rev().find(|&i| !body[i].joined)?.max(start)
        }
        Some(to) => {
            let last = label(to).filter(|last| *last >= start)?;
            let block = body[last + 1..at].iter().take_while(|s| s.joined).count();
            last + 1 + block
        }
    };
    Some(&body[start..end])
}
