//! From the text to functions with their times: read, execute in a world of the machine's tables, run
//! the clock.
//!
//! A program streams through in pieces until its first call, label or loop, as in a translation; its
//! rest is kept whole and run from there. What comes out goes to a [`Sink`], function by function.
//! Not here: what is made of them, and where it is written.

mod lines;
mod notes;
mod plain;

use std::collections::{BTreeSet, VecDeque};
use std::io::{self, Read, Seek, SeekFrom};
use std::rc::Rc;

use ncc_exec::world::{Tables, World};
use ncc_exec::{Event, Exec, Kind, Runner};
use ncc_frontends::{Batch, Reader};
use ncc_ir::canon::{AXES, Modes, PathMode};
use ncc_ir::computed::free_variables::asked_of_the_machine;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::rows::Rows;
use ncc_ir::program::{Op, Program, Stmt};
use ncc_ir::source::Span;
use ncc_plot::Turned;
use ncc_time::{Clock, Longest, Machine, Model, Place, Timed};

use super::blocks::Blocks;
use super::modes::{Followed, Length};
use super::reach::Reach;
use crate::job::Job;
use crate::review::stream::as_stated;
use crate::source::Source;
use crate::source::chunks::{Chunk, Chunks};
use crate::source::reader::reader_for;

/// After so many errors, reading more of the program would help nobody.
const ENOUGH_ERRORS: usize = 200;

/// So many blocks of a contour are remembered, of which an event may come late: one that does not move holds none up.
const MOST_HELD: usize = 64;

/// Stages of the case study's document.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// As the program says it.
    Before,
    /// As the machine does it.
    After,
}

/// Receives the progress of a long program.
pub trait Watch {
    /// So many bytes are read; the clock of the machine stands there, in seconds.
    fn at(&mut self, bytes: u64, now: f64);

    /// All is read, and the machine goes on.
    fn now(&mut self, now: f64);
}

/// Nobody.
#[derive(Clone, Copy, Debug)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn at(&mut self, _bytes: u64, _now: f64) {}

    fn now(&mut self, _now: f64) {}
}

/// What is to be executed, and how it is timed.
pub struct Plan<'p> {
    /// The program's dialect and options; as a translation into itself.
    pub job: &'p Job,
    /// The machine.
    pub machine: Machine,
    /// Its tables of offsets and lengths, as far as they are stated.
    pub tables: Tables,
    /// Clearance of peck drilling and lift of chip-breaking drilling, mm in nanos, that its profile states.
    pub parameters: [Option<Nanos>; 2],
    /// The model.
    pub model: Model,
    /// Block-skip switches that are on: bit n is level n.
    pub skip: u16,
    /// Seconds on the clock before the first block.
    pub start_time: f64,
    /// Whether cycles are reported as they are called, or as they are made.
    pub stage: Stage,
    /// Whether compensated contours are gone along by the tool centre, where its radius is known.
    pub centre: bool,
}

/// What the source says of a function.
#[derive(Clone, Debug, Default)]
pub struct Said {
    /// Text of its block, if the sink wants it.
    pub block: Rc<str>,
    /// The comment, of a remark.
    pub remark: Option<Rc<str>>,
    /// Box around an arc in the program's coordinates, if the sink wants it.
    pub reach: Option<Box<Reach>>,
    /// How frames turn the plane of an arc, if the sink wants it and they do.
    pub turned: Option<Box<Turned>>,
    /// Where its tip is, if the sink wants it.
    pub tip: Tip,
    /// How many blocks have been executed, its own too, if the sink wants modes.
    pub executed: u64,
}

/// What leads from where the machine is to where the tip of the tool is on the part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tip {
    /// What the tool adds: X Y Z in nanos of a millimetre.
    pub tool: [Nanos; 3],
    /// Active work offset; 1 is the first.
    pub offset: u16,
    /// Where program zero lies, as the machine is without a tool, nanos of a millimetre.
    pub zero: [Nanos; 3],
    /// Which of X, Y and Z end at a place of the machine, which has nothing to do with the part.
    pub of_machine: [bool; 3],
    /// Which axes the block brings to stated coordinates, wherever they were.
    pub stated: [bool; AXES],
}

/// What takes the functions.
pub trait Sink {
    /// Whether it wants the text of blocks.
    fn wants_blocks(&self) -> bool {
        false
    }

    /// Whether it wants the boxes around arcs.
    fn wants_reach(&self) -> bool {
        false
    }

    /// Whether it wants to know how frames turn arcs.
    fn wants_turns(&self) -> bool {
        false
    }

    /// Whether it wants to know where the tip is.
    fn wants_tip(&self) -> bool {
        false
    }

    /// Whether it wants the modes behind each block.
    fn wants_modes(&self) -> bool {
        false
    }

    /// Whether it wants bounds of the whole.
    fn wants_bounds(&self) -> bool {
        false
    }

    /// A function with its time.
    ///
    /// # Errors
    /// Writing.
    fn function(&mut self, timed: &Timed, said: &Said) -> io::Result<()>;

    /// The modes behind the statement of a line, if it wants them; its functions come later.
    fn active(&mut self, _line: u32, _followed: &Followed) {}

    /// A statement of a cycle that is reported as it is called; the control stands before the holes.
    ///
    /// # Errors
    /// Writing.
    fn called(&mut self, _stmt: &Stmt, _exec: &Exec, _block: &str) -> io::Result<()> {
        Ok(())
    }
}

/// Corners that a program leaves to the machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Corners {
    /// No path mode is active.
    pub unsaid: bool,
    /// A rounding mode is active, without a stated distance.
    pub open: bool,
}

/// What became of a program.
pub struct Course {
    /// What was found.
    pub diagnostics: Vec<Diagnostic>,
    /// Whether the program has errors; then what the sink has is not to be used.
    pub refused: bool,
    /// Levels of block skip that occur: bit n is level n.
    pub skip_levels: u16,
    /// Whether the program stops for the operator.
    pub stops: bool,
    /// Whether it turns the tool onto tilted planes.
    pub turns_onto_planes: bool,
    /// Whether it has points of the tool tip.
    pub tip: bool,
    /// Active work offsets while it moves.
    pub offsets: BTreeSet<u16>,
    /// Active lengths while it moves.
    pub lengths: BTreeSet<Length>,
    /// Whether it moves in machine coordinates.
    pub in_machine: bool,
    /// Axes that move.
    pub moved: [bool; AXES],
    /// Whether corners are taken as the program says nothing of, and as it says without a length.
    pub corners: Corners,
    /// Seconds at least and at most, where the sink wants them.
    pub bounds: Option<[f64; 2]>,
    /// Whether contours are compensated.
    pub compensates: bool,
    /// Whether a move was one of the tool centre beside a contour.
    pub follows_centre: bool,
    /// Contours that the tool centre was not followed along: in which line that was found, and why.
    pub as_programmed: Vec<(u32, Fault)>,
    /// Blocks of the source that say something.
    pub blocks: u64,
    /// Seconds on the clock at the end.
    pub end: f64,
}

/// Executes a program.
///
/// # Errors
/// Reading the source, or what the sink fails with.
pub fn drive(
    plan: &Plan,
    source: &mut Source,
    sink: &mut dyn Sink,
    watch: &mut dyn Watch,
) -> io::Result<Course> {
    let mut drive = Drive::new(plan, sink);
    drive.reader = reader_for(plan.job, true, &mut source.file)?;
    let mut chunks = Chunks::new(&mut source.file);
    let mut read = 0;
    loop {
        match chunks.take()? {
            Chunk::Lines(base, range) => {
                read = u64::from(base) + range.len() as u64;
                drive.piece(chunks.text(range), base)?;
            }
            Chunk::TooLong(start, end) => drive.reader.too_long(Span::new(start, end), &mut drive.batch),
            Chunk::End => break,
        }
        watch.at(read, drive.clock.now());
        if drive.errors >= ENOUGH_ERRORS {
            break;
        }
    }
    drive.reader.finish(&mut drive.batch);
    drive.take_diagnostics();
    if drive.batch.whole && drive.errors == 0 {
        let mut text = Vec::new();
        source.file.seek(SeekFrom::Start(0))?;
        source.file.read_to_end(&mut text)?;
        drive.finish_kept(&text, watch)?;
    } else {
        let stmts = std::mem::take(&mut drive.batch.stmts);
        drive.statements(&stmts, &[])?;
    }
    drive.end()
}

struct Drive<'d> {
    plan: &'d Plan<'d>,
    sink: &'d mut dyn Sink,
    wants_blocks: bool,
    wants_reach: bool,
    wants_turns: bool,
    wants_tip: bool,
    wants_bounds: bool,
    followed: Option<Followed>,
    reader: Reader,
    batch: Batch,
    blocks: Blocks,
    exec: Exec,
    world: World,
    stood: bool,
    /// Whether there has been a move.
    moved: bool,
    /// Work offset and length that were noted last.
    depends: Option<(u16, Length)>,
    /// Where the axes stood before the next function, machine coordinates.
    last: [Nanos; AXES],
    clock: Clock,
    /// The longest time with acceleration beside a model that has none.
    beside: Option<Longest>,
    events: Vec<Event>,
    /// Of functions whose time is not certain yet, in order.
    said: VecDeque<Said>,
    /// The event of the last statement, where it made just one.
    line: Option<Event>,
    /// Memory for lines of tables.
    along: Vec<lines::Made>,
    /// Whether the words of the next straight move are of the machine.
    of_machine: bool,
    /// The text of blocks that nobody asks for.
    nothing: Rc<str>,
    /// Blocks whose events may wait for the next ones: a contour's end is not known before.
    held: VecDeque<(Span, Place, Said)>,
    course: Course,
    errors: usize,
}

impl<'d> Drive<'d> {
    fn new(plan: &'d Plan<'d>, sink: &'d mut dyn Sink) -> Drive<'d> {
        let world = plain::world(plan);
        let mut exec = Exec::new(&world, plan.skip);
        exec.narrate();
        if plan.centre {
            exec.compute_known_compensation(plan.job.compensating().rules);
        }
        // Cycles that are not made have no time, so that nothing has.
        let model = if plan.stage == Stage::Before { Model::Ideal } else { plan.model };
        let wants_bounds = sink.wants_bounds();
        Drive {
            wants_bounds,
            wants_blocks: sink.wants_blocks(),
            wants_reach: sink.wants_reach(),
            wants_turns: sink.wants_turns(),
            wants_tip: sink.wants_tip(),
            followed: sink.wants_modes().then(Followed::default),
            plan,
            sink,
            reader: plan.job.reader(true),
            batch: Batch::default(),
            blocks: Blocks::new(),
            last: exec.machine(),
            exec,
            world,
            stood: false,
            moved: false,
            depends: None,
            clock: Clock::new(model, plan.machine.clone()),
            beside: (wants_bounds && model == Model::Ideal).then(|| Longest::new(plan.machine.clone())),
            events: Vec::new(),
            said: VecDeque::new(),
            line: None,
            along: Vec::new(),
            of_machine: false,
            nothing: Rc::from(""),
            held: VecDeque::new(),
            course: Course {
                diagnostics: Vec::new(),
                refused: false,
                skip_levels: 0,
                stops: false,
                turns_onto_planes: false,
                tip: false,
                offsets: BTreeSet::new(),
                lengths: BTreeSet::new(),
                in_machine: false,
                moved: [false; AXES],
                corners: Corners::default(),
                bounds: None,
                compensates: false,
                follows_centre: false,
                as_programmed: Vec::new(),
                blocks: 0,
                end: 0.0,
            },
            errors: 0,
        }
    }

    /// A piece of the source.
    fn piece(&mut self, text: &[u8], base: u32) -> io::Result<()> {
        self.reader.read_to_table(text, base, &mut self.batch);
        self.take_diagnostics();
        self.blocks.begin(base);
        if self.batch.whole {
            self.batch.unpack_table();
        } else {
            let mut table = std::mem::take(&mut self.batch.table);
            let mut stmts = std::mem::take(&mut self.batch.stmts);
            self.lines(Rows::of(&table), text)?;
            self.statements(&stmts, text)?;
            // Their memory serves the next piece.
            table.clear();
            stmts.clear();
            (self.batch.table, self.batch.stmts) = (table, stmts);
        }
        self.blocks.end(text);
        Ok(())
    }

    /// Statements of a program that streams.
    fn statements(&mut self, stmts: &[Stmt], text: &[u8]) -> io::Result<()> {
        self.look(stmts);
        if self.errors > 0 {
            return Ok(());
        }
        self.assume(self.batch.assumed);
        for stmt in stmts {
            if let Err(refusal) = self.statement(stmt, text)? {
                self.take(refusal);
                return Ok(());
            }
        }
        Ok(())
    }

    /// Executes the rest of a program, which is kept in memory.
    fn finish_kept(&mut self, text: &[u8], watch: &mut dyn Watch) -> io::Result<()> {
        let body = std::mem::take(&mut self.batch.stmts);
        let mut procedures = vec![self.batch.main(body)];
        procedures.append(&mut self.batch.procedures);
        let program = Program { procedures, ..Program::default() };
        for procedure in &program.procedures {
            self.look(&procedure.body);
        }
        if self.errors > 0 {
            return Ok(());
        }
        self.blocks = Blocks::of_text(text);
        self.assume(self.batch.assumed);
        for (asked, at) in asked_of_the_machine(&program) {
            self.take(as_stated(&asked, at));
        }
        let mut runner = Runner::new(&program);
        self.plan.job.given.start(&mut runner);
        loop {
            let next = match runner.next(&self.exec) {
                Ok(Some(stmt)) => stmt,
                Ok(None) => return Ok(()),
                Err(refusal) => {
                    self.take(refusal);
                    return Ok(());
                }
            };
            if let Err(refusal) = self.statement(next, text)? {
                self.take(refusal);
                return Ok(());
            }
            watch.now(self.clock.now());
        }
    }

    /// Takes facts for granted that the program relies on, and puts the tool where it starts.
    fn assume(&mut self, facts: Modes) {
        self.exec.assume(&facts);
        self.follow_assumed(facts);
        if !std::mem::replace(&mut self.stood, true) {
            let start = self.plan.job.start.map(|at| Some(at.unwrap_or(0)));
            self.exec.stand_at(&start);
            self.last = self.exec.machine();
        }
    }

    /// Puts the tool, which has not moved yet, where it starts in the work offset that has just come into
    /// force: its start is one in the program's coordinates.
    fn start_in(&mut self, before: u16) {
        let [was, is] = [before, self.exec.offset_in_force()].map(|offset| self.world.work_offset(offset));
        let here = self.exec.machine();
        self.exec.be_at(std::array::from_fn(|axis| here[axis] + is[axis] - was[axis]));
        self.last = self.exec.machine();
    }

    /// Executes a statement and passes on what it makes.
    fn statement(&mut self, stmt: &Stmt, text: &[u8]) -> io::Result<Result<(), Diagnostic>> {
        let skipped = stmt.skip.is_some_and(|level| self.plan.skip >> level & 1 == 1);
        if self.exec.ended() || skipped {
            return Ok(Ok(()));
        }
        if self.plan.stage == Stage::Before && self.is_call(&stmt.op) {
            return self.call(stmt, text);
        }
        let exact = self.plan.job.from.dialect.can.cycles_in_exact_path && self.is_call(&stmt.op);
        let contour = self.plan.centre && self.exec.is_on_contour();
        let before = self.exec.offset_in_force();
        let tip = if self.wants_tip { self.tip_of(&stmt.op) } else { Tip::default() };
        if let Err(refusal) = self.exec.step(stmt, &mut self.events) {
            return Ok(Err(refusal));
        }
        self.follow(stmt, text);
        if !self.moved && self.exec.offset_in_force() != before {
            self.start_in(before);
        }
        let contour = contour || self.plan.centre && self.exec.is_on_contour();
        if self.events.is_empty() && !contour {
            return Ok(Ok(()));
        }
        let (place, mut said) = self.place(stmt.span, text);
        if let Op::Comment(remark) = &stmt.op {
            said.remark = Some(Rc::from(&**remark));
        }
        said.tip = tip;
        if contour {
            self.note_contour(stmt.span, place, &said);
        }
        if exact {
            for event in &mut self.events {
                event.state.path = Some(PathMode::ExactPath);
            }
        }
        self.pass_on(contour, place, &said);
        if contour && !self.exec.is_on_contour() {
            self.held.clear();
        }
        self.deliver().map(Ok)
    }

    /// Passes on the events that were made; those of a contour may be of an earlier block.
    fn pass_on(&mut self, contour: bool, place: Place, said: &Said) {
        let mut events = std::mem::take(&mut self.events);
        self.line = match events.as_slice() {
            [event] if !contour => Some(event.clone()),
            _ => None,
        };
        let last = events.iter().rposition(|event| event.kind.moves().is_some());
        for (n, event) in events.drain(..).enumerate() {
            let held = self.held.iter().rev().find(|(span, ..)| contour && *span == event.span);
            let (place, mut said) =
                held.map_or((place, said.clone()), |(_, place, said)| (*place, said.clone()));
            if last != Some(n) {
                // Through a point of the part.
                said.tip.of_machine = [false; 3];
            }
            self.event(event, place, said);
        }
        self.events = events;
    }

    /// Whether a statement belongs to a cycle.
    fn is_call(&self, op: &Op) -> bool {
        match op.unwrapped() {
            Op::StartCycle(_) | Op::Hole(_) | Op::Pattern(_) | Op::EndCycle => true,
            Op::Position(_) => self.exec.cycle_levels().is_some(),
            _ => false,
        }
    }

    /// Tells a statement of a cycle as it is called; its holes are made for the position alone.
    fn call(&mut self, stmt: &Stmt, text: &[u8]) -> io::Result<Result<(), Diagnostic>> {
        let (_, said) = self.place(stmt.span, text);
        let holes = matches!(stmt.op.unwrapped(), Op::Hole(_) | Op::Pattern(_) | Op::Position(_));
        if holes {
            self.moved = true;
            self.sink.called(stmt, &self.exec, &said.block)?;
        }
        if let Err(refusal) = self.exec.step(stmt, &mut self.events) {
            return Ok(Err(refusal));
        }
        self.events.clear();
        self.last = self.exec.machine();
        if !holes {
            self.sink.called(stmt, &self.exec, &said.block)?;
        }
        Ok(Ok(()))
    }

    /// Hands over what has its time.
    fn deliver(&mut self) -> io::Result<()> {
        for timed in self.clock.certain() {
            timed.start += self.plan.start_time;
            let said = self.said.pop_front().unwrap_or_default();
            self.sink.function(timed, &said)?;
        }
        self.clock.forget();
        Ok(())
    }

    /// The end.
    fn end(mut self) -> io::Result<Course> {
        if self.errors == 0 {
            if self.plan.centre && self.exec.is_on_contour() {
                // The text ends on the contour.
                self.exec.end_of_text(&mut self.events);
                self.events.retain(|event| event.kind != Kind::TextEnd);
                self.pass_on(true, Place::default(), &Said::default());
            }
            self.clock.finish();
            self.deliver()?;
        }
        if self.wants_bounds {
            let now = self.clock.now();
            let (least, most) = match &self.beside {
                Some(longest) => (now, longest.seconds().max(now)),
                None => self.clock.bounds(),
            };
            self.course.bounds = Some([least, most]);
        }
        self.course.refused = self.errors > 0;
        self.course.end = self.plan.start_time + self.clock.now();
        Ok(self.course)
    }
}
