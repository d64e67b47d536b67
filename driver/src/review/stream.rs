//! Executing a whole program of any dialect in several worlds at once: statement by statement, each
//! handed out with what it makes in every world.
//!
//! [`stream`] is what `verify` and `diff` have in common with the timing of programs: pieces of the
//! source, the reader, facts that the dialect assumes, controls that execute. A program
//! streams in constant memory until its first call, label or loop; its rest is kept whole and run from
//! there. What is done with the events is the caller's matter; nothing is compared or told here.
//!
//! ```text
//! let worlds = worlds(&side.job, clearances(&side.job));
//! let controls = worlds.iter().map(|world| Exec::new(world, skip)).collect();
//! let course = stream(&side.job, &mut side.source.file, controls, &mut |made| { …; ControlFlow::Continue(()) })?;
//! if course.refused { /* course.diagnostics say why, at their places */ }
//! ```

mod lines;
mod made;
mod waiting;

use std::io;
use std::mem::discriminant;
use std::ops::ControlFlow;

use ncc_dialects::{BREAK_LIFT, PECK_CLEARANCE};
use ncc_exec::world::World;
use ncc_exec::{Exec, Runner};
use ncc_frontends::{Batch, Reader};
use ncc_ir::canon::{AXES, Modes, Units};
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::{Diagnostic, Fault, Gravity};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::expr::system::System;
use ncc_ir::program::cycle::{Clearance, CycleKind};
use ncc_ir::program::rows::Rows;
use ncc_ir::program::{FrameSlot, Op, Program, Stmt};
use ncc_ir::source::Span;
use ncc_ir::unexecuted::FlowUnexecuted;
use ncc_machines::reading::Told;

use self::made::OfStatements;
use crate::job::Job;
use crate::job::parameters::parameter;
use crate::machines::pair::Answer;
use crate::source::Readable;
use crate::source::chunks::{Chunk, Chunks, PIECE};
use crate::source::reader::reader_for;
use crate::verify_run::controls::fixed;
use crate::verify_run::{WORLDS, levels};

pub use self::made::{Control, Made, Stage, Takes};
pub use self::waiting::{Reading, Waiting};

/// After so many errors, reading more of the program would help nobody.
const ENOUGH_ERRORS: usize = 200;

/// What becomes of facts that a program relies on and never says.
#[derive(Clone, Copy, Debug)]
pub enum Unsaid {
    /// Its dialect's power-on rows are assumed and reported: a user's source.
    Taken,
    /// Only these facts hold; the worlds disagree about every other: a text that has to say it all.
    Only(Modes),
}

/// What became of a program.
#[derive(Clone, Debug, Default)]
pub struct Course {
    /// What was found, in the order in which it was found.
    pub diagnostics: Vec<Diagnostic>,
    /// Whether the program has errors; then it was not executed to its end.
    pub refused: bool,
    /// Levels of block skip that occur: bit n is level n.
    pub skip_levels: u16,
    /// Blocks that say something.
    pub blocks: u64,
    /// Facts that the program relies on and never says, where they are assumed.
    pub assumed: Modes,
    /// What its text has of what a comparison must know of the whole.
    pub has: Has,
    /// Whether it is kept whole from some block on.
    pub whole: bool,
    /// Length and SHA-256 of the source's bytes; only where [`look`] has read them to their end.
    pub bytes: Option<(u64, [u8; 32])>,
}

/// What is assumed where a program asks for a value of the machine's own.
pub fn as_stated(asked: &System, at: Span) -> Diagnostic {
    let assumption = ControlFact::MachineValue { asked: asked.to_string().into() };
    Diagnostic::new(Fault::AssumedFact { fact: assumption }, at)
}

/// What a program has somewhere in its text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Has {
    /// Messages for the operator.
    pub messages: bool,
    /// Messages with values in them.
    pub values: bool,
    /// Words of inches.
    pub inches: bool,
    /// The first work offset that it names.
    pub work_offset: Option<u16>,
    /// A word that cancels a G92 shift.
    pub clears_shift: bool,
    /// Cycles that clear chips with a parameter of the control: pecks, breaks of chips.
    pub chips: bool,
}

/// The control's own parameters of cycles, where options or a profile state them: clearance of peck
/// drilling and lift of chip-breaking drilling, in nanos of a millimetre.
pub fn clearances(job: &Job) -> [Option<Nanos>; 2] {
    [PECK_CLEARANCE, BREAK_LIFT].map(|option| parameter(job, option).and_then(|value| value.nanos(false)))
}

/// The worlds in which a program is judged. The first is plain: offsets and lengths are nothing and
/// the tool stands at program zero, so that its coordinates are those of the program. The others are
/// generated, as for a verification. `clearances` are those of the side itself or, where it states
/// none, of the other side.
pub fn worlds(job: &Job, clearances: [Option<Nanos>; 2]) -> Vec<World> {
    let fixed = fixed(job.from.dialect);
    let plain = World {
        seed: 0,
        power_on: Modes { no_origin_shift: Some(true), ..fixed },
        start: [0; AXES],
        peck_clearance: ONE,
        break_lift: ONE,
        // No tables, nothing renamed.
        ..World::generate(0, &fixed)
    };
    let mut worlds = vec![plain];
    worlds.extend((1..=WORLDS).map(|seed| World::generate(seed, &fixed).with_external()));
    for world in &mut worlds {
        world.behaviours = job.from.behaviours();
        world.increments = job.from.fine_increments();
        world.feed_ends_with_mode = job.from.dialect.can.feed_ends_with_mode;
        world.cycles_need_spindle = job.from.dialect.can.cycles_need_spindle;
        world.compensation_again = job.from.dialect.caps.compensation.again;
        world.arcs = job.from.arc_rule();
        world.refused_compensated = job.from.dialect.caps.compensation.refused;
        let [clearance, lift] = clearances;
        world.peck_clearance = clearance.unwrap_or(world.peck_clearance);
        world.break_lift = lift.unwrap_or(world.break_lift);
    }
    worlds
}

/// Executes a program from its beginning in all the controls at once. `take` gets the start, every
/// statement that makes something, and at last the end of the text; it may break off.
///
/// The controls should be fresh. What the program relies on and never says is assumed of
/// each, as its dialect has it, and is among the diagnostics.
///
/// # Errors
/// Reading the source.
pub fn stream(
    job: &Job,
    file: &mut dyn Readable,
    controls: Vec<Exec>,
    take: &mut dyn FnMut(Made) -> ControlFlow<()>,
) -> io::Result<Course> {
    stream_as(job, file, Unsaid::Taken, controls, take)
}

/// The same of a program of which it is said what becomes of the facts that it leaves unsaid.
///
/// # Errors
/// Reading the source.
pub fn stream_as(
    job: &Job,
    file: &mut dyn Readable,
    unsaid: Unsaid,
    controls: Vec<Exec>,
    take: &mut dyn FnMut(Made) -> ControlFlow<()>,
) -> io::Result<Course> {
    let mut take = OfStatements(take);
    execute(Run::new(job, file, unsaid, &mut take)?, file, controls)
}

/// The same for somebody who takes lines by many.
///
/// # Errors
/// Reading the source.
pub fn stream_lines(
    job: &Job,
    file: &mut dyn Readable,
    controls: Vec<Exec>,
    take: &mut dyn Takes,
) -> io::Result<Course> {
    let run = Run { tabled: true, ..Run::new(job, file, Unsaid::Taken, take)? };
    execute(run, file, controls)
}

fn execute(mut run: Run, file: &mut dyn Readable, controls: Vec<Exec>) -> io::Result<Course> {
    run.controls = controls.into_iter().map(|exec| Control { exec, events: Vec::new() }).collect();
    run.through(&mut Chunks::new(file))?;
    run.last_statements();
    Ok(run.end())
}

/// Reads a program without executing anything: what is known of the whole of it, with its length and its hash.
///
/// # Errors
/// Reading the source.
pub fn look(job: &Job, file: &mut dyn Readable) -> io::Result<Course> {
    let mut nothing = |_: Made| ControlFlow::Continue(());
    let mut nothing = OfStatements(&mut nothing);
    let mut run = Run { tabled: true, ..Run::new(job, file, Unsaid::Taken, &mut nothing)? };
    let mut chunks = Chunks::hashed(file, PIECE);
    let over = run.through(&mut chunks)?;
    run.last_statements();
    let (sha256, bytes) = chunks.finish();
    run.course.bytes = over.then_some((bytes, sha256));
    Ok(run.end())
}

/// Reads a program and hands its statements out, for somebody who executes them: as long as it streams, and has no errors.
///
/// # Errors
/// Reading the source.
pub fn read(
    job: &Job,
    file: &mut dyn Readable,
    unsaid: Unsaid,
    hand_out: &mut dyn FnMut(Reading) -> ControlFlow<()>,
) -> io::Result<Course> {
    let mut nothing = |_: Made| ControlFlow::Continue(());
    let mut nothing = OfStatements(&mut nothing);
    let mut run = Run { tabled: true, ..Run::new(job, file, unsaid, &mut nothing)? };
    run.reads = Some(hand_out);
    run.through(&mut Chunks::new(file))?;
    run.reader.finish(&mut run.batch);
    run.take_diagnostics();
    if !run.batch.whole {
        run.next_statements();
    }
    Ok(run.end())
}

struct Run<'r> {
    job: &'r Job,
    reader: Reader,
    unsaid: Unsaid,
    batch: Batch,
    controls: Vec<Control>,
    /// Whether the tools have been put where they start.
    stood: bool,
    course: Course,
    errors: usize,
    take: &'r mut dyn Takes,
    /// Whether lines are read as tables.
    tabled: bool,
    /// Takes statements that are read and not executed here.
    reads: Option<&'r mut dyn FnMut(Reading) -> ControlFlow<()>>,
    broken_off: bool,
}

impl<'r> Run<'r> {
    /// One without controls, before its first piece.
    fn new(
        job: &'r Job,
        file: &mut dyn Readable,
        unsaid: Unsaid,
        take: &'r mut dyn Takes,
    ) -> io::Result<Run<'r>> {
        Ok(Run {
            job,
            reader: reader_for(job, matches!(unsaid, Unsaid::Taken), file)?,
            unsaid,
            batch: Batch::default(),
            controls: Vec::new(),
            stood: false,
            course: Course::default(),
            errors: 0,
            take,
            tabled: false,
            reads: None,
            broken_off: false,
        })
    }

    /// Reads piece by piece; says whether that went to the end.
    fn through(&mut self, chunks: &mut Chunks) -> io::Result<bool> {
        loop {
            match chunks.take()? {
                Chunk::Lines(base, range) => self.piece(chunks.text(range), base),
                Chunk::TooLong(start, end) => self.reader.too_long(Span::new(start, end), &mut self.batch),
                Chunk::End => return Ok(true),
            }
            let kept = self.reads.is_some() && self.batch.whole;
            if self.errors >= ENOUGH_ERRORS || self.broken_off || kept {
                return Ok(false);
            }
        }
    }

    fn piece(&mut self, text: &[u8], base: u32) {
        match self.tabled {
            true => self.reader.read_to_table(text, base, &mut self.batch),
            false => self.reader.read(text, base, &mut self.batch),
        }
        self.take_diagnostics();
        if self.batch.whole {
            self.batch.unpack_table();
        } else {
            self.next_statements();
        }
    }

    /// Executes what was read, or hands it out.
    fn next_statements(&mut self) {
        let mut table = std::mem::take(&mut self.batch.table);
        let mut stmts = std::mem::take(&mut self.batch.stmts);
        match &mut self.reads {
            None => {
                self.lines(Rows::of(&table));
                self.statements(&stmts);
                // Their memory serves the next piece.
                table.clear();
                stmts.clear();
                (self.batch.table, self.batch.stmts) = (table, stmts);
            }
            Some(_) if self.errors > 0 || table.is_empty() && stmts.is_empty() => {}
            Some(hand_out) => {
                self.course.skip_levels |= levels(&stmts);
                let assumed = self.batch.assumed;
                self.broken_off = hand_out(Reading { table, stmts, assumed }).is_break();
            }
        }
    }

    /// Executes what the end of the text has left: the rest of a program that is kept whole.
    fn last_statements(&mut self) {
        self.reader.finish(&mut self.batch);
        self.take_diagnostics();
        if self.batch.whole && self.errors == 0 {
            self.finish_kept();
        } else {
            let stmts = std::mem::take(&mut self.batch.stmts);
            self.statements(&stmts);
        }
    }

    fn statements(&mut self, stmts: &[Stmt]) {
        self.look(stmts);
        if self.errors > 0 {
            return;
        }
        self.assume();
        self.each_statement(stmts);
    }

    fn each_statement(&mut self, stmts: &[Stmt]) {
        for stmt in stmts {
            if self.broken_off {
                return;
            }
            if let Err(refusal) = self.statement(stmt) {
                self.take_diagnostic(refusal);
                return;
            }
        }
    }

    /// Executes the rest of a program, which is kept in memory.
    fn finish_kept(&mut self) {
        let body = std::mem::take(&mut self.batch.stmts);
        let mut procedures = vec![self.batch.main(body)];
        procedures.append(&mut self.batch.procedures);
        let program = Program { procedures, ..Program::default() };
        for procedure in &program.procedures {
            self.look(&procedure.body);
        }
        self.assume();
        let mut runner = Runner::new(&program);
        self.job.given.start(&mut runner);
        let done = if runner.asks() {
            self.each_its_way(vec![runner; self.controls.len()])
        } else {
            self.all_one_way(runner)
        };
        if let Err(refusal) = done {
            self.take_diagnostic(refusal);
        }
    }

    /// All controls execute the same: what the program decides and computes depends on nothing that differs between
    /// them.
    fn all_one_way(&mut self, mut runner: Runner) -> Result<(), Diagnostic> {
        while !self.broken_off
            && let Some(control) = self.controls.first()
            && let Some(stmt) = runner.next(&control.exec)?
        {
            self.statement(stmt)?;
        }
        Ok(())
    }

    /// Each control executes the blocks that the program reaches with its own answers. Where they go different ways there is no
    /// statement that all have made, and the program is refused.
    fn each_its_way(&mut self, mut runners: Vec<Runner>) -> Result<(), Diagnostic> {
        while !self.broken_off {
            let mut silent = true;
            let mut first: Option<Stmt> = None;
            let mut over = 0;
            for (control, runner) in self.controls.iter_mut().zip(&mut runners) {
                control.events.clear();
                let Some(stmt) = runner.next(&control.exec)? else {
                    over += 1;
                    continue;
                };
                control.exec.step(stmt, &mut control.events)?;
                silent &= control.events.is_empty();
                match &first {
                    Some(first)
                        if first.span == stmt.span && discriminant(&first.op) == discriminant(&stmt.op) => {}
                    Some(first) => return Err(other_way(first.span)),
                    None => first = Some(stmt.clone()),
                }
            }
            match first {
                None => return Ok(()),
                Some(first) if over > 0 => return Err(other_way(first.span)),
                Some(first) if !silent => self.hand_out(Stage::Stmt(&first)),
                Some(_) => {}
            }
        }
        Ok(())
    }

    /// Takes facts for granted that the program relies on, and puts the tool where it starts: at
    /// program zero in the plain world, and where the world has it in the others.
    fn assume(&mut self) {
        let stood = std::mem::replace(&mut self.stood, true);
        for control in &mut self.controls {
            // What the text itself assumes goes before what holds for it.
            control.exec.assume(&self.batch.assumed);
            if let Unsaid::Only(facts) = &self.unsaid {
                control.exec.assume(facts);
            }
            if !stood {
                control.exec.stand_at(&self.job.start);
                self.job.tool_at_start().into_iter().for_each(|tool| control.exec.hold_tool(tool));
            }
        }
        if !stood {
            self.hand_out(Stage::Start);
        }
    }

    #[inline]
    fn statement(&mut self, stmt: &Stmt) -> Result<(), Diagnostic> {
        let mut silent = true;
        for control in &mut self.controls {
            control.events.clear();
            control.exec.step(stmt, &mut control.events)?;
            silent &= control.events.is_empty();
        }
        if !silent {
            self.hand_out(Stage::Stmt(stmt));
        }
        Ok(())
    }

    fn hand_out(&mut self, stage: Stage) {
        self.broken_off = self.take.made(Made { stage, controls: &self.controls }).is_break();
    }

    fn end(mut self) -> Course {
        let open = self.controls.iter().find_map(|control| control.exec.no_open_corner().err());
        if let Some(refusal) = open.filter(|_| self.errors == 0 && !self.broken_off) {
            self.take_diagnostic(refusal);
        }
        self.course.refused = self.errors > 0;
        self.course.assumed = self.batch.assumed;
        self.course.whole = self.batch.whole;
        if self.errors == 0 && !self.broken_off {
            for control in &mut self.controls {
                control.events.clear();
                control.exec.end_of_text(&mut control.events);
            }
            self.hand_out(Stage::End);
        }
        self.course
    }

    /// Looks through statements for what is to be known of the whole.
    fn look(&mut self, stmts: &[Stmt]) {
        self.course.skip_levels |= levels(stmts);
        for stmt in stmts {
            note(&stmt.op, &mut self.course.has);
        }
        let says = |s: &&Stmt| !s.joined && !matches!(s.op, Op::Blank | Op::Comment(_));
        self.course.blocks += stmts.iter().filter(says).count() as u64;
    }

    fn take_diagnostics(&mut self) {
        for diagnostic in std::mem::take(&mut self.batch.diagnostics) {
            self.take_diagnostic(diagnostic);
        }
    }

    /// Takes what was found. An assumption that the machine's profile settles is none.
    fn take_diagnostic(&mut self, mut diagnostic: Diagnostic) {
        match self.job.machines.answer(&diagnostic.fault, Told::Reader, &self.job.from, &self.job.to) {
            Answer::Open => {}
            Answer::Settled => return,
            Answer::Denied(denied) => diagnostic.fault = denied,
        }
        self.errors += usize::from(diagnostic.fault.gravity() == Gravity::Error);
        self.course.diagnostics.push(diagnostic);
    }
}

/// Machines that answer differently go different ways from here on.
fn other_way(at: Span) -> Diagnostic {
    Diagnostic::new(Fault::not_executed(FlowUnexecuted::MachineDecides), at)
}

/// Notes what a statement has, and those inside of it.
fn note(op: &Op, has: &mut Has) {
    if let Op::SetOriginOffsets(number) = op {
        has.work_offset.get_or_insert(*number);
    } else if let Op::StartCycle(cycle) = op {
        has.chips |= matches!(
            cycle.kind,
            CycleKind::DrillPeck { clearance: Clearance::Parameter, .. }
                | CycleKind::DrillBreak { lift: Clearance::Parameter, .. }
        );
    } else if let Op::Control(control) = op {
        control.bodies().flatten().for_each(|stmt| note(&stmt.op, has));
    } else {
        has.messages |= matches!(op, Op::Message(_) | Op::MessageOf(_));
        has.values |= matches!(op, Op::MessageOf(_));
        has.inches |= matches!(op, Op::UseLengthUnits(Units::Inch));
        has.clears_shift |= matches!(op, Op::ClearFrame(FrameSlot::Shift) | Op::UseOriginShift(_));
    }
}
