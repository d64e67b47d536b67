//! The verification of a long program on a second thread, while the next pieces are read, rewritten and written.
//!
//! ```text
//! first thread     read, passes, write    | piece 5 | piece 6 | piece 7
//! second thread    read back, compare               | piece 5 | piece 6
//! ```
//!
//! The outcome is that of one thread: both do the same steps in the same order. Where the verification stops, the first
//! thread is ahead of it, and may have found what it would not have looked for. So the whole attempt is thrown away, and
//! the program is translated again on one thread, which reports the stop (`translate::run`). A host without threads, such
//! as a page in a browser, starts none, and verifies on the first.
//!
//! Not here: what a step of the verification does (`verify_run`).

use std::sync::mpsc::{Receiver, Sender, SyncSender, channel, sync_channel};
use std::thread::{Builder, JoinHandle};

use ncc_exec::halt;
use ncc_ir::canon::Modes;
use ncc_ir::program::Stmt;
use ncc_ir::program::line_table::LineTable;

use crate::verify_run::{Stop, Verifier};

/// How much is handed over at once, and how much of that a table and statements are: to wake a thread costs as much as
/// to execute some tables, and statements take much memory.
const TOGETHER: usize = 8;
const TABLE: usize = 1;
const STATEMENTS: usize = 4;

/// So many times that the first thread may be ahead: enough that neither waits for long, and few enough for memory.
const AHEAD: usize = 1;

/// The stack of the second thread, in bytes: that of a program's first thread.
const STACK: usize = 8 << 20;

/// What a text is to say of the source, one by one.
pub(super) enum Saying {
    Lines(Vec<Stmt>),
    /// Lines, and arcs among them.
    Arcs(Vec<Stmt>),
    Table(LineTable),
    /// Something else, which is executed by itself.
    Otherwise,
}

/// A step of the verification, with what it works on.
pub(super) enum Step {
    /// Statements of the source that the passes change.
    Source { stmts: Vec<Stmt>, assumed: Modes },
    /// A piece of the output.
    Text { said: Saying, assumed: Modes, text: Vec<u8>, base: u32, inherited: Modes },
}

/// What the step of a text has worked on, without its contents: its memory serves a later piece.
#[derive(Default)]
pub(super) struct Spare {
    pub(super) stmts: Option<Vec<Stmt>>,
    pub(super) table: Option<LineTable>,
    pub(super) text: Option<Vec<u8>>,
}

/// A verification that runs on a second thread.
pub(super) struct Beside {
    /// Steps that are not handed over yet, and how much they are.
    held: Vec<Step>,
    much: usize,
    steps: SyncSender<Vec<Step>>,
    spare: Receiver<Spare>,
    thread: JoinHandle<(Verifier, Result<(), Stop>)>,
}

impl Beside {
    /// Moves a verification to a second thread; gives it back where there is none to be had.
    pub(super) fn start(verifier: Verifier) -> Result<Beside, Box<Verifier>> {
        let (hand, handed) = channel();
        let (steps, to_do) = sync_channel(AHEAD);
        let (done, spare) = channel();
        let own = halt::own();
        let work = move || {
            let mut verifier: Verifier = handed.recv().expect("the first thread hands it over");
            let result = halt::under(own, || work(&mut verifier, &to_do, &done));
            (verifier, result)
        };
        let thread = Builder::new().stack_size(STACK).spawn(work);
        match thread {
            Ok(thread) => match hand.send(verifier) {
                Ok(()) => Ok(Beside { held: Vec::new(), much: 0, steps, spare, thread }),
                Err(back) => Err(Box::new(back.0)),
            },
            Err(_) => Err(Box::new(verifier)),
        }
    }

    /// Has a step done after those before it; `false` if it is known that the verification has stopped.
    pub(super) fn go_on(&mut self, step: Step) -> bool {
        self.much += match &step {
            Step::Text { said: Saying::Table(_), .. } => TABLE,
            Step::Text { .. } | Step::Source { .. } => STATEMENTS,
        };
        self.held.push(step);
        self.much < TOGETHER || self.hand_over()
    }

    fn hand_over(&mut self) -> bool {
        self.much = 0;
        self.steps.send(std::mem::take(&mut self.held)).is_ok()
    }

    /// Memory for the next piece, where there is some.
    pub(super) fn spare(&self) -> Spare {
        self.spare.try_recv().unwrap_or_default()
    }

    /// Waits until all steps are done; gives the verification back, and why it stopped, if it did.
    pub(super) fn end(mut self) -> (Verifier, Result<(), Stop>) {
        // Where it has stopped, it says so itself.
        let _ = self.hand_over();
        drop(self.steps);
        self.thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    }
}

/// The second thread's work: all steps up to the first that stops.
fn work(verifier: &mut Verifier, steps: &Receiver<Vec<Step>>, done: &Sender<Spare>) -> Result<(), Stop> {
    for step in steps.iter().flatten() {
        match step {
            Step::Source { stmts, assumed } => verifier.source(&stmts, &assumed)?,
            Step::Text { said, assumed, mut text, base, inherited } => {
                match &said {
                    Saying::Lines(stmts) => verifier.piece(stmts, &assumed, &text, base, &inherited)?,
                    Saying::Arcs(stmts) => {
                        verifier.source_said(stmts, &assumed)?;
                        verifier.target_saying(stmts, &text, base, &inherited)?;
                    }
                    Saying::Table(table) => verifier.table(table, &assumed, &text, base, &inherited)?,
                    Saying::Otherwise => verifier.target(&text, base, &inherited)?,
                }
                text.clear();
                let mut spare = Spare { text: Some(text), ..Spare::default() };
                match said {
                    Saying::Lines(mut stmts) | Saying::Arcs(mut stmts) => {
                        stmts.clear();
                        spare.stmts = Some(stmts);
                    }
                    Saying::Table(mut table) => {
                        table.clear();
                        spare.table = Some(table);
                    }
                    Saying::Otherwise => {}
                }
                // Nobody waits for it at the end.
                let _ = done.send(spare);
            }
        }
    }
    Ok(())
}
