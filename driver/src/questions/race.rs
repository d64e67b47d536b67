//! Two readings of one source, executed side by side up to the first event that differs.
//!
//! ```text
//! G43 H1 Z100     → Z ends at 0.1 mm under one reading, at 100 mm under the other
//! ```
//!
//! Each piece of the text goes through both readers before the next one is read, so the memory that is needed
//! stays that of a piece. A program that is kept whole is run step by step at its end. Not here: which readings
//! there are, and what is done about a difference.

use std::collections::VecDeque;
use std::io::{self, SeekFrom};
use std::mem::discriminant;

use ncc_exec::verify::same_plain;
use ncc_exec::{Event, Exec, Kind, Movement, Runner, State, Stored, are_holes};
use ncc_frontends::{BareNumber, Batch, Reader};
use ncc_ir::canon::{AXES, Axis, FeedMode, Spindle};
use ncc_ir::diag::{Diagnostic, Gravity};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::program::{Program, Stmt};
use ncc_ir::source::Span;
use ncc_machines::reading::Told;

use super::question::Made;
use crate::job::Job;
use crate::machines::pair::Answer;
use crate::review::stream::{clearances, worlds};
use crate::source::Readable;
use crate::source::chunks::{Chunk, Chunks};

/// A program that executes more statements than this is given up.
const MOST_STEPS: u64 = 1_000_000;

/// Numbers without a point that are remembered before an event that differs.
const MOST_BARE: usize = 256;

/// What makes two events different.
#[derive(Clone, Copy, Debug)]
pub struct Measure {
    /// How far end points and centres may be apart, nanos of a millimetre or degree.
    pub length: Nanos,
    /// Whether only moves that cut are held against each other: by their ends, feed, spindle and tool.
    pub cuts: bool,
}

/// The world in which coordinates are the program's own.
pub const PLAIN: usize = 0;

/// A world in which every offset and length is another one.
pub const GENERATED: usize = 1;

/// A tenth of a millimetre: what two readings may be apart without a question.
pub const TENTH: Nanos = ONE / 10;

/// A micrometre.
pub const MICROMETRE: Nanos = ONE / 1000;

/// Two readings are not the same.
#[derive(Clone, Debug)]
pub struct Difference {
    /// The block.
    pub at: Span,
    /// What each makes of it.
    pub made: [Made; 2],
    /// Numbers without a point up to there, in the order of the text; of the first reading.
    pub bare: Vec<BareNumber>,
}

/// What came of a race.
#[derive(Clone, Debug)]
pub enum Finish {
    /// Both readings make the same up to the end.
    Same,
    /// They differ.
    Apart(Box<Difference>),
    /// Nobody knows: neither could be executed to its end. The numbers without a point that were met.
    Unknown(Vec<BareNumber>),
}

/// One of the readings.
struct Run<'j> {
    job: &'j Job,
    measure: Measure,
    reader: Reader,
    batch: Batch,
    exec: Exec,
    /// Events that the other reading has not made yet.
    events: VecDeque<Event>,
    /// Numbers without a point, the last ones.
    bare: VecDeque<BareNumber>,
    /// Whether there are statements to execute.
    fresh: bool,
    /// Whether the tool has been put where it starts.
    stood: bool,
    /// Why it goes no further.
    refused: Option<(u16, Span)>,
    over: bool,
    made: Vec<Event>,
}

impl<'j> Run<'j> {
    fn new(job: &'j Job, measure: Measure, world: usize, watch: bool) -> Run<'j> {
        let world = worlds(job, clearances(job)).swap_remove(world);
        let mut reader = job.reader(true);
        if watch {
            reader.watch();
        }
        Run {
            job,
            measure,
            reader,
            batch: Batch::default(),
            exec: Exec::new(&world, 0),
            events: VecDeque::new(),
            bare: VecDeque::new(),
            fresh: false,
            stood: false,
            refused: None,
            over: false,
            made: Vec::new(),
        }
    }

    /// Reads a piece.
    fn read(&mut self, text: &[u8], base: u32) {
        if self.refused.is_none() {
            self.reader.read(text, base, &mut self.batch);
            self.take_diagnostics();
            self.fresh = !self.batch.whole;
        }
    }

    /// Executes what was read, up to the first block that is refused.
    fn execute(&mut self) {
        if !std::mem::take(&mut self.fresh) {
            return;
        }
        self.assume();
        let mut stmts = std::mem::take(&mut self.batch.stmts);
        let upto = self.refused.map_or(u32::MAX, |(_, at)| at.start);
        for stmt in stmts.iter().take_while(|stmt| stmt.span.start < upto) {
            if !self.step(stmt) {
                break;
            }
        }
        stmts.clear();
        self.batch.stmts = stmts;
    }

    fn assume(&mut self) {
        self.exec.assume(&self.batch.assumed);
        if !std::mem::replace(&mut self.stood, true) {
            self.exec.stand_at(&self.job.start);
        }
    }

    /// Executes a statement; whether that could be done.
    fn step(&mut self, stmt: &Stmt) -> bool {
        self.made.clear();
        if let Err(refusal) = self.exec.step(stmt, &mut self.made) {
            self.refuse(&refusal);
            return false;
        }
        let counts = |event: &Event| !self.measure.cuts || cuts(event);
        self.events.extend(self.made.drain(..).filter(counts));
        true
    }

    fn refuse(&mut self, refusal: &Diagnostic) {
        if self.refused.is_none_or(|(_, at)| refusal.span.start < at.start) {
            self.refused = Some((refusal.fault.code(), refusal.span));
        }
    }

    fn take_diagnostics(&mut self) {
        for bare in self.batch.bare.drain(..) {
            if self.bare.len() == MOST_BARE {
                self.bare.pop_front();
            }
            self.bare.push_back(bare);
        }
        for diagnostic in std::mem::take(&mut self.batch.diagnostics) {
            let (from, to) = (&self.job.from, &self.job.to);
            let denied = match self.job.machines.answer(&diagnostic.fault, Told::Reader, from, to) {
                Answer::Open | Answer::Settled => false,
                Answer::Denied(_) => true,
            };
            if denied || diagnostic.fault.gravity() == Gravity::Error {
                self.refuse(&diagnostic);
            }
        }
    }

    /// The end of the text. What is kept whole comes back, to be run.
    fn finish(&mut self) -> Option<Program> {
        if self.refused.is_none() {
            self.reader.finish(&mut self.batch);
            self.take_diagnostics();
        }
        if self.refused.is_some() || !self.batch.whole {
            self.fresh = !self.batch.whole;
            self.execute();
            self.end();
            return None;
        }
        self.assume();
        let body = std::mem::take(&mut self.batch.stmts);
        let mut procedures = vec![self.batch.main(body)];
        procedures.append(&mut self.batch.procedures);
        Some(Program { procedures, ..Program::default() })
    }

    /// The program is over.
    fn end(&mut self) {
        self.over = true;
        if self.refused.is_none() && !self.measure.cuts {
            self.made.clear();
            self.exec.end_of_text(&mut self.made);
            self.events.extend(self.made.drain(..));
        }
    }
}

/// Holds two readings of a source against each other in one of the worlds of a comparison. With `watch`, numbers without a point are kept, for the message.
///
/// # Errors
/// Reading the source.
pub fn race(
    jobs: [&Job; 2],
    source: &mut dyn Readable,
    measure: Measure,
    world: usize,
    watch: bool,
) -> io::Result<Finish> {
    source.seek(SeekFrom::Start(0))?;
    let mut runs = jobs.map(|job| Run::new(job, measure, world, watch));
    let mut chunks = Chunks::new(source);
    loop {
        match chunks.take()? {
            Chunk::Lines(base, range) => {
                runs.iter_mut().for_each(|run| run.read(chunks.text(range.clone()), base));
                if !pass(&mut runs) {
                    runs.iter_mut().for_each(Run::execute);
                }
            }
            Chunk::TooLong(start, end) => {
                for run in &mut runs {
                    run.reader.too_long(Span::new(start, end), &mut run.batch);
                    run.take_diagnostics();
                }
            }
            Chunk::End => break,
        }
        if let Some(found) = compare(&mut runs) {
            return Ok(found);
        }
        if runs.iter().any(|run| run.refused.is_some()) {
            break;
        }
    }
    let programs: [Option<Program>; 2] = {
        let [a, b] = &mut runs;
        [a.finish(), b.finish()]
    };
    if let Some(found) = compare(&mut runs) {
        return Ok(found);
    }
    Ok(run_kept(&programs, &mut runs).or_else(|| compare(&mut runs)).unwrap_or_else(|| undecided(&runs)))
}

/// Executes a piece once for both, where both readings are the same plain moves and both controls are in one state;
/// whether that was done.
fn pass(runs: &mut [Run; 2]) -> bool {
    let [a, b] = runs;
    let (said, own) = (&a.batch.stmts, &b.batch.stmts);
    let ready = |run: &Run| run.fresh && run.refused.is_none() && run.events.is_empty();
    if !ready(a) || !ready(b) {
        return false;
    }
    let holes = are_holes(said) && are_holes(own);
    if !holes && (said.len() != own.len() || !said.iter().zip(own).all(|(x, y)| same_plain(x, y))) {
        return false;
    }
    a.assume();
    b.assume();
    if holes {
        if !pass_holes(a, b) {
            return false;
        }
    } else if !a.exec.agrees(&b.exec) {
        return false;
    } else if let Err(refusal) = a.exec.pass(&a.batch.stmts) {
        a.refuse(&refusal);
        b.refuse(&refusal);
    }
    b.exec.follow(&a.exec);
    for run in [a, b] {
        run.batch.stmts.clear();
        run.fresh = false;
    }
    true
}

/// Executes holes of the first reading, where the second one makes the same of them; `false`, and nothing done, where it
/// does not, or one of them cannot be executed.
fn pass_holes(a: &mut Run, b: &mut Run) -> bool {
    if !a.exec.makes_holes_of(&b.exec) {
        return false;
    }
    let (before, mut places) = (a.exec.clone(), Vec::with_capacity(a.batch.stmts.len()));
    let valued = a.exec.value_holes(&a.batch.stmts);
    let made = a.exec.pass_holes(&a.batch.stmts, valued.as_ref(), &mut places).is_ok();
    let holes = b.exec.value_holes(&b.batch.stmts);
    let same = made && holes.is_some_and(|holes| b.exec.has_holes_at(&holes, &places));
    if !same {
        a.exec = before;
    }
    same
}

/// Runs both programs that are kept in memory, in turns: neither gets far ahead.
fn run_kept(programs: &[Option<Program>; 2], runs: &mut [Run; 2]) -> Option<Finish> {
    let mut runners = programs.each_ref().map(|program| {
        program.as_ref().map(|program| {
            let mut runner = Runner::new(program);
            runs[0].job.given.start(&mut runner);
            runner
        })
    });
    let mut steps = 0;
    while runners.iter().any(Option::is_some) {
        let before = steps;
        for (runner, run) in runners.iter_mut().zip(&mut *runs) {
            // The one that has events the other has not made waits.
            while let Some(own) = runner.as_mut().filter(|_| run.events.is_empty()) {
                steps += 1;
                let over = match own.next(&run.exec) {
                    Ok(Some(stmt)) => !run.step(stmt) || steps > MOST_STEPS,
                    Ok(None) => true,
                    Err(refusal) => {
                        run.refuse(&refusal);
                        true
                    }
                };
                if over {
                    *runner = None;
                    run.end();
                }
            }
        }
        if let Some(found) = compare(runs) {
            return Some(found);
        }
        if steps == before {
            // One is refused, and the other has gone on.
            return None;
        }
        if steps > MOST_STEPS {
            return Some(Finish::Unknown(runs[0].bare.iter().cloned().collect()));
        }
    }
    None
}

/// Compares events that both have made, and lets go of them.
fn compare(runs: &mut [Run; 2]) -> Option<Finish> {
    let [a, b] = runs;
    while let (Some(x), Some(y)) = (a.events.front(), b.events.front()) {
        if let Some(made) = differ(x, y, a.measure) {
            let at = if x.span.start <= y.span.start { x.span } else { y.span };
            return Some(apart(a, at, made));
        }
        a.events.pop_front();
        b.events.pop_front();
    }
    // Where one is refused or over, and the other goes on.
    let refused = |run: &Run| run.refused.filter(|_| run.events.is_empty());
    match (a.events.front(), b.events.front(), refused(a), refused(b)) {
        (None, Some(y), Some((code, at)), _) if at.start <= y.span.start => {
            Some(apart(a, at, [Made::Refused(code), Made::Otherwise]))
        }
        (None, Some(y), None, _) if a.over => Some(apart(a, y.span, [Made::Otherwise; 2])),
        (Some(x), None, ..) if b.over && b.refused.is_none() => Some(apart(a, x.span, [Made::Otherwise; 2])),
        _ => None,
    }
}

fn apart(first: &Run, at: Span, made: [Made; 2]) -> Finish {
    let bare = first.bare.iter().filter(|bare| bare.span.start < at.end).cloned().collect();
    Finish::Apart(Box::new(Difference { at, made, bare }))
}

/// Neither has made what the other has not.
fn undecided(runs: &[Run; 2]) -> Finish {
    match runs.iter().any(|run| run.refused.is_some()) {
        true => Finish::Unknown(runs[0].bare.iter().cloned().collect()),
        false => Finish::Same,
    }
}

/// Whether an event cuts.
fn cuts(event: &Event) -> bool {
    matches!(event.kind.moves(), Some(Movement::Feed | Movement::Arc { .. }))
}

/// What two events make, if that is not the same.
fn differ(a: &Event, b: &Event, measure: Measure) -> Option<[Made; 2]> {
    if discriminant(&a.kind) != discriminant(&b.kind) {
        return Some([Made::Otherwise; 2]);
    }
    let far = |x: Nanos, y: Nanos| x.abs_diff(y) > measure.length.unsigned_abs();
    for at in 0..AXES {
        if far(a.end[at], b.end[at]) {
            return Some([Made::End(Axis::ALL[at], a.end[at]), Made::End(Axis::ALL[at], b.end[at])]);
        }
    }
    let same = match (&a.kind, &b.kind) {
        (Kind::Arc { plane, turn, centre, .. }, Kind::Arc { plane: own, turn: way, centre: other, .. }) => {
            let (first, second, _) = plane.axes();
            for (i, axis) in [first, second].into_iter().enumerate() {
                if far(centre[i], other[i]) {
                    return Some([Made::Centre(axis, centre[i]), Made::Centre(axis, other[i])]);
                }
            }
            plane == own && turn == way
        }
        (Kind::Dwell(x), Kind::Dwell(y)) => {
            if x.abs_diff(*y) > TENTH.unsigned_abs() {
                return Some([Made::Dwell(*x), Made::Dwell(*y)]);
            }
            true
        }
        (Kind::Synchronised { pitch, chuck }, Kind::Synchronised { pitch: other, chuck: own }) => {
            if ratio(*pitch, *other) {
                let [x, y] = [pitch, other].map(|p| Made::Feed(*p, FeedMode::PerRevolution));
                return Some([x, y]);
            }
            chuck == own
        }
        (Kind::Data(x), Kind::Data(y)) => stored(x, y, measure.length),
        (Kind::Probe { to, .. }, Kind::Probe { to: other, .. }) => {
            (0..AXES).all(|at| !far(to[at], other[at]))
        }
        (x, y) => x == y,
    };
    if !same {
        return Some([Made::Otherwise; 2]);
    }
    if a.kind.moves().is_some_and(|way| way != Movement::Rapid)
        && !matches!(a.kind, Kind::Synchronised { .. })
        && ratio(a.rate, b.rate)
    {
        let made = |event: &Event| Made::Feed(event.rate, event.state.feed_mode);
        return Some([made(a), made(b)]);
    }
    states(&a.state, &b.state)
}

/// What is on, if that is not the same.
fn states(a: &State, b: &State) -> Option<[Made; 2]> {
    let turns = |state: &State| state.spindle != Spindle::Stopped;
    if turns(a) != turns(b) {
        return Some([Made::Spindle(turns(a)), Made::Spindle(turns(b))]);
    }
    if a.tool != b.tool {
        return Some([Made::Tool(a.tool), Made::Tool(b.tool)]);
    }
    let speeds = a.spindle == b.spindle && a.spindle_mode == b.spindle_mode && !ratio(a.speed, b.speed);
    let same =
        (speeds || !turns(a)) && a.feed_mode == b.feed_mode && a.compensation.side == b.compensation.side;
    (!same).then_some([Made::Otherwise; 2])
}

/// Whether two rates are more than a hundredth apart.
fn ratio(a: Nanos, b: Nanos) -> bool {
    a.abs_diff(b) > a.unsigned_abs().max(b.unsigned_abs()) / 100
}

/// Whether values of tables are the same.
fn stored(a: &Stored, b: &Stored, length: Nanos) -> bool {
    let near = |x: Nanos, y: Nanos| x.abs_diff(y) <= length.unsigned_abs();
    let all = |x: &[Nanos; AXES], y: &[Nanos; AXES]| x.iter().zip(y).all(|(x, y)| near(*x, *y));
    match (a, b) {
        (Stored::Offset(n, at, turn), Stored::Offset(m, to, own)) => {
            n == m && all(at, to) && near(*turn, *own)
        }
        (Stored::Position(n, at), Stored::Position(m, to)) => n == m && all(at, to),
        (Stored::Length(n, x), Stored::Length(m, y)) => n == m && near(*x, *y),
        (Stored::Value(n, which, added, x), Stored::Value(m, what, own, y)) => {
            n == m && which == what && added == own && near(*x, *y)
        }
        (a, b) => a == b,
    }
}
