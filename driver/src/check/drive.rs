//! From the text to what was found: read past refused blocks, execute in a world of the machine's
//! tables, show every statement to the checker.
//!
//! A program streams through in pieces until its first call, label or loop; its rest is kept whole and
//! run from there. Not here: the rules (ncc-check), words, rendering.

use std::collections::{BTreeSet, VecDeque};
use std::io::{self, Read, Seek, SeekFrom};

use ncc_check::flow::{Block, Jumps, never_called};
use ncc_check::{Checked, Checker, Finding, LeftOn, Limits, Refusal, What};
use ncc_dialects::{CodeRow, Dialect, Family, Meaning};
use ncc_exec::{Exec, Runner};
use ncc_frontends::{Batch, Flow, REFUSED, Reader, flow};
use ncc_ir::computed::free_variables::asked_of_the_machine;
use ncc_ir::diag::{Diagnostic, Fault, Gravity};
use ncc_ir::program::{Op, Program, Stmt, Text};
use ncc_ir::source::Span;

use crate::job::Job;
use crate::review::stream::{as_stated, clearances, worlds};
use crate::source::Source;
use crate::source::chunks::{Chunk, Chunks};

/// Of what blocks were refused for, so much is kept.
const MOST: usize = 1000;

/// A program that executes more statements than this, and is kept whole, is given up.
const MOST_STEPS: u64 = 50_000_000;

/// What came of a program.
pub struct Course {
    /// What the rules found.
    pub checked: Checked,
    /// What the reader and the execution found.
    pub diagnostics: Vec<Diagnostic>,
    /// How many more there are.
    pub untold: usize,
}

/// Checks a program.
///
/// # Errors
/// Reading the source.
pub fn drive(job: &Job, limits: Limits, skip: u16, source: &mut Source) -> io::Result<Course> {
    source.file.seek(SeekFrom::Start(0))?;
    let mut drive = Drive::new(job, limits, skip);
    let mut chunks = Chunks::new(&mut source.file);
    loop {
        match chunks.take()? {
            Chunk::Lines(base, range) => {
                drive.end = base + range.len() as u32;
                drive.piece(chunks.text(range), base);
            }
            Chunk::TooLong(start, end) => drive.reader.too_long(Span::new(start, end), &mut drive.batch),
            Chunk::End => break,
        }
        if drive.not_text {
            break;
        }
    }
    drive.reader.finish(&mut drive.batch);
    drive.take_diagnostics();
    let bodies = || drive.batch.procedures.iter().map(|p| &p.body).chain([&drive.batch.stmts]);
    drive.jumps |= bodies().any(|body| jumps_in(body));
    if drive.jumps {
        let mut text = Vec::new();
        source.file.seek(SeekFrom::Start(0))?;
        source.file.read_to_end(&mut text)?;
        drive.follow_jumps(&text);
    }
    let stmts = std::mem::take(&mut drive.batch.stmts);
    match drive.batch.whole {
        true => drive.finish_kept(stmts),
        false => drive.statements(&stmts),
    }
    Ok(drive.finish())
}

struct Drive<'d> {
    dialect: &'static Dialect,
    skip: u16,
    job: &'d Job,
    reader: Reader,
    batch: Batch,
    exec: Exec,
    checker: Checker,
    diagnostics: Vec<Diagnostic>,
    untold: usize,
    /// Codes that were refused and switch a mode on, with their places.
    modes: VecDeque<(u32, LeftOn)>,
    /// Places of refusals of a reader that leaves no marks.
    pending: VecDeque<Span>,
    /// Names that were called and are not in the text.
    missing: BTreeSet<Text>,
    /// Blocks after the end of the program.
    after_end: Option<Span>,
    /// Places of those calls.
    missing_at: BTreeSet<u32>,
    /// Whether the text has jumps.
    jumps: bool,
    /// Blocks that jumps can name, and places of jumps that lead nowhere: by the text alone.
    labels: BTreeSet<String>,
    nowhere: BTreeSet<u32>,
    subprogram: bool,
    not_text: bool,
    /// One past the last byte that was read.
    end: u32,
}

impl<'d> Drive<'d> {
    fn new(job: &'d Job, mut limits: Limits, skip: u16) -> Drive<'d> {
        limits.no_lengths = job.from.dialect.can.change_by_hand;
        let mut world = worlds(job, clearances(job)).swap_remove(0);
        world.tables = limits.tables.clone();
        let mut exec = Exec::new(&world, skip);
        exec.narrate();
        let mut reader = job.reader(true);
        reader.watch();
        Drive {
            dialect: job.from.dialect,
            skip,
            job,
            reader,
            batch: Batch::default(),
            checker: Checker::new(limits, &exec),
            exec,
            diagnostics: Vec::new(),
            untold: 0,
            modes: VecDeque::new(),
            pending: VecDeque::new(),
            missing: BTreeSet::new(),
            after_end: None,
            missing_at: BTreeSet::new(),
            jumps: false,
            labels: BTreeSet::new(),
            nowhere: BTreeSet::new(),
            subprogram: false,
            not_text: false,
            end: 0,
        }
    }

    /// Looks where jumps go, by the text alone.
    fn follow_jumps(&mut self, text: &[u8]) {
        let mut jumps = Jumps::default();
        flow(&self.job.from, text, &mut |piece| match piece {
            Flow::Program => jumps.program(),
            Flow::Block { label, at, says, frames } => {
                self.labels.extend(label.clone());
                let block = match frames {
                    true => Block::OfStructure,
                    false if says => Block::Executed,
                    false => Block::Silent,
                };
                jumps.block(label, at, block);
            }
            Flow::Jump { to, at, always, quiet } => jumps.jump(to, (!quiet).then_some(at), always),
        });
        for finding in jumps.finish() {
            if let What::JumpNowhere { .. } = finding.what {
                self.nowhere.insert(finding.span.start);
            }
            self.checker.add(finding);
        }
    }

    /// A piece of the source.
    fn piece(&mut self, text: &[u8], base: u32) {
        self.reader.read(text, base, &mut self.batch);
        self.take_diagnostics();
        if !self.batch.whole {
            let mut stmts = std::mem::take(&mut self.batch.stmts);
            self.statements(&stmts);
            stmts.clear();
            self.batch.stmts = stmts;
        }
    }

    /// Statements of a program that streams.
    fn statements(&mut self, stmts: &[Stmt]) {
        self.exec.assume(&self.batch.assumed);
        for stmt in stmts {
            self.statement(stmt);
        }
    }

    /// Executes the rest of a program, which is kept in memory.
    fn finish_kept(&mut self, main: Vec<Stmt>) {
        self.exec.assume(&self.batch.assumed);
        let mut procedures = vec![self.batch.main(main)];
        procedures.append(&mut self.batch.procedures);
        let program = Program { procedures, ..Program::default() };
        // What was not read may call anything.
        let read = self.diagnostics.iter().all(|d| d.fault.gravity() != Gravity::Error);
        if read && self.missing.is_empty() {
            never_called(&program).into_iter().for_each(|finding| self.checker.add(finding));
        }
        for (asked, at) in asked_of_the_machine(&program) {
            self.diagnostics.push(as_stated(&asked, at));
        }
        let mut runner = Runner::new(&program);
        self.job.given.start(&mut runner);
        for _ in 0..MOST_STEPS {
            match runner.next(&self.exec) {
                Ok(Some(stmt)) => self.statement(stmt),
                Ok(None) => return,
                Err(refusal) => {
                    if self.not_gone_through(refusal, &program) {
                        return;
                    }
                }
            }
        }
        self.checker.give_up();
    }

    /// A call or loop that cannot be gone through; whether that is the end.
    fn not_gone_through(&mut self, refusal: Diagnostic, program: &Program) -> bool {
        let span = refusal.span;
        let main = program.procedures.first().map_or(&[][..], |main| &main.body);
        if main.iter().any(|stmt| stmt.span == span && matches!(stmt.op, Op::Return)) {
            self.subprogram = true;
            return true;
        }
        let endless = matches!(
            refusal.fault,
            Fault::CallRecursive { .. } | Fault::NoEnd { .. } | Fault::Interrupted { .. } | Fault::Endless
        );
        if endless {
            self.checker.give_up();
        }
        self.take(refusal);
        self.checker.lose(&Refusal { span, on: None });
        endless
    }

    #[inline]
    fn statement(&mut self, stmt: &Stmt) {
        if let Some(span) = self.pending.front()
            && span.start <= stmt.span.start
        {
            let span = *span;
            self.pending.pop_front();
            self.checker.lose(&Refusal { span, on: None });
        }
        if let Op::NoEffect(name) = &stmt.op
            && **name == *REFUSED
        {
            return self.refused(stmt);
        }
        if let Op::Return = stmt.op {
            self.subprogram = true;
        }
        if stmt.skip.is_some_and(|level| self.skip >> level & 1 == 1) {
            return;
        }
        if let Some(refusal) = self.checker.run(stmt, &mut self.exec) {
            self.take(refusal);
        }
    }

    /// A block that was not read.
    fn refused(&mut self, stmt: &Stmt) {
        let inside = |at: u32| stmt.span.start <= at && at < stmt.span.end;
        let on = self.modes.iter().find(|(at, _)| inside(*at)).map(|(_, mode)| *mode);
        self.checker.lose(&Refusal { span: stmt.span, on });
    }

    fn take_diagnostics(&mut self) {
        for bare in std::mem::take(&mut self.batch.bare) {
            self.checker.bare(bare.span, bare.read, bare.with_point, bare.feed);
        }
        if self.batch.pointed {
            self.checker.pointed();
        }
        self.subprogram |= self.batch.subprogram;
        let marks = matches!(self.dialect.family, Family::Word | Family::Sinumerik);
        for diagnostic in std::mem::take(&mut self.batch.diagnostics) {
            if !marks && diagnostic.fault.gravity() == Gravity::Error {
                self.pending.push_back(diagnostic.span);
            }
            self.take(diagnostic);
        }
    }

    /// Takes what was found: a rule's matter, or the reader's.
    fn take(&mut self, diagnostic: Diagnostic) {
        let Diagnostic { fault, span, .. } = &diagnostic;
        match fault {
            Fault::CallUnknown { name } => {
                // The reader and the execution may name it differently.
                let fresh = self.missing_at.insert(span.start);
                if self.missing.insert(name.clone()) && fresh {
                    self.checker.add(Finding::new(What::CallNowhere { name: name.clone() }, *span));
                }
                return;
            }
            // What the text has stands in a block that was not read, or in a loop.
            Fault::LabelUnknown { name }
                if self.labels.contains(&**name) || self.nowhere.contains(&span.start) =>
            {
                return;
            }
            Fault::LabelUnknown { name } => {
                return self.checker.add(Finding::new(What::JumpNowhere { name: name.clone() }, *span));
            }
            Fault::TextAfterEnd => {
                self.after_end.get_or_insert(*span);
                return;
            }
            Fault::NotText => self.not_text = true,
            Fault::MacroLanguage { what } => {
                self.jumps |= what.as_bytes().windows(4).any(|word| word.eq_ignore_ascii_case(b"GOTO"));
            }
            Fault::NotSupported { code, .. } => {
                if let Some(row) = row(self.dialect, code) {
                    // It may lead to a block: a return of a main program too.
                    self.jumps |= !row.blocks.is_empty();
                    self.subprogram |= row.means == Some(Meaning::Return);
                    if switches_compensation(self.dialect, row) {
                        self.modes.push_back((span.start, LeftOn::Compensation));
                    }
                }
            }
            _ => {}
        }
        // Some are reported by several steps.
        let known = self.diagnostics.iter().rev().take(16).any(|d| d.span == *span && d.fault == *fault);
        if known {
            return;
        }
        match self.diagnostics.len() < MOST || matches!(fault, Fault::NotText) {
            true => self.diagnostics.push(diagnostic),
            false => self.untold += 1,
        }
    }

    fn finish(mut self) -> Course {
        if !self.not_text && !self.checker.ended() && !self.exec.ended() {
            let mut none = Vec::new();
            self.exec.end_of_text(&mut none);
        }
        match self.after_end {
            // A jump may lead there; they were not read.
            Some(span) if self.jumps => self.checker.lose(&Refusal { span, on: None }),
            Some(span) => self.checker.add(Finding::new(What::AfterEnd, span)),
            None => {}
        }
        let end = Span::new(self.end.saturating_sub(1), self.end);
        let subprogram = self.subprogram || self.not_text;
        Course {
            checked: self.checker.finish(subprogram, end),
            diagnostics: self.diagnostics,
            untold: self.untold,
        }
    }
}

/// Whether statements jump.
fn jumps_in(body: &[Stmt]) -> bool {
    body.iter().any(|stmt| match &stmt.op {
        Op::Goto(_) => true,
        Op::Control(control) => control.bodies().any(|body| jumps_in(body)),
        _ => false,
    })
}

/// The row of a code as it is written: `G42`, `g2`.
fn row(dialect: &'static Dialect, code: &str) -> Option<&'static CodeRow> {
    let letter = code.bytes().next()?.to_ascii_uppercase();
    let number = code.get(1..)?.trim();
    let (whole, tenth) = number.split_once('.').unwrap_or((number, "0"));
    let tenths = whole.parse::<u32>().ok()?.checked_mul(10)?.checked_add(tenth.parse().ok()?)?;
    dialect.code_row(letter, tenths)
}

/// Whether a code is of the group whose off is that of the compensation.
fn switches_compensation(dialect: &'static Dialect, row: &CodeRow) -> bool {
    let off = dialect.code_for(Meaning::StopCutterRadiusCompensation);
    off.is_some_and(|off| !off.group.is_empty() && off.group == row.group)
}
