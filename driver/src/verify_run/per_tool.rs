//! Verifies that a file per tool does the same as its part of the whole program, run alone on a machine at rest.
//!
//! The whole text and the files are executed in the same test set-ups, statement by statement. Between two tool changes of
//! the whole, the events of its file must be equal to the last digit. A file starts with a control after a reset, in the
//! power-on modes of the test set-up, with its tool in the spindle and with the axes where the operator left them:
//!
//! ```text
//! whole: … T5 M0 │ S3000 M3 / X10 Y5 / …     file: G21 … / G53 G0 Z0 │ S3000 M3 / X10 Y5 / … │ G53 G0 Z0 / M2
//! ```
//!
//! The further blocks of a file may only bring the machine to rest: spindle and coolant off, rapid moves at
//! machine zero of Z, the end.
//!
//! Not here: how the text is cut (`translate::per_tool`).

use std::collections::VecDeque;
use std::ops::Range;

use ncc_exec::verify::{Aspect, Difference};
use ncc_exec::world::World;
use ncc_exec::{Event, Exec, Kind, State};
use ncc_frontends::{Batch, Reader};
use ncc_ir::canon::{AXES, Axis, Modes, Spindle};
use ncc_ir::diag::{Diagnostic, Fault, Gravity};
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::{Op, Stmt};

use super::controls::with_parameters;
use super::facts::reader_of_output;
use super::{WORLDS, worlds_of};
use crate::job::Job;
use crate::render::events::describe;
use crate::render::per_tool::per_tool;

/// Most bytes that are read at once, without the rest of the last line.
const PIECE: usize = 1 << 16;

/// Added to the seed of a test set-up: there the operator left the axes elsewhere.
const ELSEWHERE: u32 = 1000;

/// A file without its head.
#[derive(Debug)]
pub struct Part {
    /// The tool in the spindle at its start; `None`: the tool that is there.
    pub tool: Option<i64>,
    /// How many tool changes of the whole are before it: 0 or 1.
    pub changes: usize,
    /// Bytes of the program's start, before the first tool change of the whole.
    pub own_beginning: u32,
    /// The parts of its text that the whole contains too.
    pub bodies: Vec<Range<u32>>,
    /// Its text.
    pub text: Vec<u8>,
}

/// How a file differs from its part of the whole.
#[derive(Debug)]
pub struct Differs {
    /// Its place in the text of the whole.
    pub at: usize,
    /// The difference; `None` if the program does more than rest before its first tool change.
    pub difference: Option<String>,
}

/// Pieces of whole lines of a text.
pub fn pieces(text: &[u8]) -> impl Iterator<Item = Range<usize>> + '_ {
    let mut at = 0;
    std::iter::from_fn(move || {
        let begins = at;
        let rest = text.get(begins..).filter(|rest| !rest.is_empty())?;
        let least = PIECE.min(rest.len());
        at = begins + memchr::memchr(b'\n', &rest[least - 1..]).map_or(rest.len(), |end| least + end);
        Some(begins..at)
    })
}

/// Executes the whole and each file, and compares them. `used` are the axes with words; `inherited` are the modes that
/// the whole assumes of a control after a reset.
///
/// # Errors
/// The first difference.
pub fn verify(
    job: &Job,
    whole: &[u8],
    parts: &[Part],
    used: &[bool; AXES],
    inherited: &Modes,
) -> Result<(), Differs> {
    for seed in 1..=WORLDS {
        let [_, world] = worlds_of(job, seed);
        let elsewhere = World::generate(seed + ELSEWHERE, &Modes::default()).start;
        // The whole starts with the tool of its first file too: nothing is cut before its tool change.
        let first = parts.first().and_then(|part| part.tool);
        let mut program = Running::new(job, whole, control(job, &world, first, inherited));
        for part in parts {
            let mut exec = control(job, &world, part.tool, inherited);
            if part.changes > 0 {
                let here = exec.machine();
                let moved = |axis: Axis| !axis.is_rotary() || used[axis as usize];
                let place = |axis| if moved(axis) { elsewhere[axis as usize] } else { here[axis as usize] };
                exec.be_at(Axis::ALL.map(place));
            }
            if part.own_beginning > 0 {
                program.go_to_change().map_err(|found| unread(0, &found))?;
            }
            let file = Running::new(job, &part.text, exec);
            compare(&mut program, file, part)?;
        }
    }
    Ok(())
}

/// The target's control after a reset, with a tool in the spindle.
fn control(job: &Job, world: &World, tool: Option<i64>, inherited: &Modes) -> Exec {
    let mut exec = Exec::new(world, 0);
    if job.between_controls() {
        exec.between_controls();
    }
    with_parameters(&mut exec, job);
    exec.every_move();
    if let Some(tool) = tool.and_then(|tool| u32::try_from(tool).ok()) {
        exec.hold_tool(tool);
    }
    exec.assume(inherited);
    exec.stand_at(&job.start);
    exec
}

/// A text during its execution.
struct Running<'t> {
    text: &'t [u8],
    reader: Reader,
    rest: Box<dyn Iterator<Item = Range<usize>> + 't>,
    batch: Batch,
    /// Executed statements of the batch.
    done: usize,
    over: bool,
    exec: Exec,
    events: VecDeque<Event>,
}

/// The next result of a text.
enum Next {
    /// An event.
    Event(Event),
    /// A tool change, which is not executed yet.
    Change(Stmt),
    /// The end.
    End,
}

impl<'t> Running<'t> {
    fn new(job: &Job, text: &'t [u8], exec: Exec) -> Running<'t> {
        Running {
            text,
            reader: reader_of_output(job),
            rest: Box::new(pieces(text)),
            batch: Batch::default(),
            done: 0,
            over: false,
            exec,
            events: VecDeque::new(),
        }
    }

    /// The next event, or the tool change or end before it.
    fn next(&mut self) -> Result<Next, Diagnostic> {
        loop {
            if let Some(event) = self.events.pop_front() {
                return Ok(Next::Event(event));
            }
            let Some(stmt) = self.batch.stmts.get(self.done) else {
                if !self.read()? {
                    return Ok(Next::End);
                }
                continue;
            };
            if stmt.op == Op::ChangeTool && !self.exec.ended() {
                return Ok(Next::Change(stmt.clone()));
            }
            let mut events = Vec::new();
            self.exec.step(stmt, &mut events)?;
            self.events.extend(events);
            self.done += 1;
        }
    }

    /// Executes up to the next tool change.
    fn go_to_change(&mut self) -> Result<(), Diagnostic> {
        while let Next::Event(_) = self.next()? {}
        Ok(())
    }

    /// Executes this tool change. Its other effects do not concern a file.
    fn change(&mut self, stmt: &Stmt) -> Result<(), Diagnostic> {
        self.done += 1;
        self.exec.step(stmt, &mut Vec::new())
    }

    /// Reads the next piece; `false` at the end.
    fn read(&mut self) -> Result<bool, Diagnostic> {
        self.batch.stmts.clear();
        self.done = 0;
        match self.rest.next() {
            Some(piece) => self.reader.read(&self.text[piece.clone()], piece.start as u32, &mut self.batch),
            None if std::mem::replace(&mut self.over, true) => return Ok(false),
            None => self.reader.finish(&mut self.batch),
        }
        let error = |d: &Diagnostic| d.fault.gravity() == Gravity::Error && d.fault != Fault::EmptyProgram;
        match self.batch.diagnostics.drain(..).find(error) {
            Some(found) => Err(found),
            None => Ok(true),
        }
    }
}

/// Executes a file and its part of the whole. Events before the first move of its tool happen where the operator left
/// the axes.
fn compare(whole: &mut Running, mut file: Running, part: &Part) -> Result<(), Differs> {
    let mut last = 0;
    let mut elsewhere = part.changes > 0;
    let differs = |at: u32, difference: String| Differs { at: at as usize, difference: Some(difference) };
    let mut changes = part.changes;
    let mut begun = file.exec.machine();
    loop {
        let own = next_of_part(whole, &mut changes).map_err(|found| unread(last, &found))?;
        let theirs = loop {
            let next = file.next().map_err(|found| unread(last, &found))?;
            let Next::Event(event) = next else { break None };
            let within = part.bodies.iter().any(|body| body.contains(&event.span.start));
            let from = std::mem::replace(&mut begun, event.end);
            if within {
                break Some(event);
            }
            let at = event.span.start;
            match rests(&event, from) {
                Err(_) if at < part.own_beginning => {
                    return Err(Differs { at: at as usize, difference: None });
                }
                rested => rested.map_err(|what| differs(last, what))?,
            }
        };
        match (own, theirs) {
            (None, None) => break,
            (Some(own), Some(theirs)) => {
                last = own.span.start;
                elsewhere &= own.kind.moves().is_none();
                if let Some(difference) = difference(&own, &theirs, elsewhere) {
                    return Err(differs(last, difference));
                }
            }
            (Some(own), None) => return Err(differs(own.span.start, per_tool("ends-early").headline())),
            (None, Some(_)) => return Err(differs(last, per_tool("does-more").headline())),
        }
    }
    // The last file ends as the whole does.
    match file.exec.ended() || !whole.exec.ended() && whole.over {
        true => Ok(()),
        false => Err(differs(last, per_tool("no-end").headline())),
    }
}

/// The next event of this part of the whole; `None` at the tool change that ends it.
fn next_of_part(whole: &mut Running, changes: &mut usize) -> Result<Option<Event>, Diagnostic> {
    loop {
        match whole.next()? {
            Next::Event(event) => return Ok(Some(event)),
            Next::End => return Ok(None),
            Next::Change(_) if *changes == 0 => return Ok(None),
            Next::Change(stmt) => {
                *changes -= 1;
                whole.change(&stmt)?;
            }
        }
    }
}

fn unread(at: u32, found: &Diagnostic) -> Differs {
    let difference = per_tool("not-read").text("code", format!("NC{:04}", found.fault.code())).headline();
    Differs { at: at as usize, difference: Some(difference) }
}

/// Blocks that the whole does not contain may only bring the machine to rest.
fn rests(event: &Event, from: [Nanos; AXES]) -> Result<(), String> {
    let z = Axis::Z as usize;
    let up =
        Axis::ALL.iter().all(|axis| *axis == Axis::Z || event.end[*axis as usize] == from[*axis as usize]);
    let still = event.state.spindle == Spindle::Stopped && !event.state.flood && !event.state.mist;
    let rests = match event.kind {
        // First Z up, then the other axes at machine zero of Z.
        Kind::Traverse => event.end[z] == 0 && (up || from[z] == 0),
        Kind::Coolant | Kind::ProgramEnd => true,
        _ => false,
    };
    match rests && still {
        true => Ok(()),
        false => Err(per_tool("more-than-rest").text("event", format!("{:?}", event.kind)).headline()),
    }
}

/// The difference of two events; with `elsewhere`, their positions may differ.
fn difference(whole: &Event, file: &Event, elsewhere: bool) -> Option<String> {
    let same = whole.kind == file.kind
        && (whole.end == file.end || elsewhere)
        && whole.rate == file.rate
        && seen(&whole.state) == seen(&file.state);
    let (source, target) = (Some(whole.clone()), Some(file.clone()));
    (!same).then(|| describe(&Difference { aspect: Aspect::State, source, target }))
}

/// The part of a state that matters: no speed of a stopped spindle, and not who switched it.
fn seen(state: &State) -> State {
    let mut seen = State { by_control: 0, ..*state };
    if seen.spindle == Spindle::Stopped {
        let still = State::default();
        (seen.speed, seen.spindle_mode) = (still.speed, still.spindle_mode);
        (seen.limit, seen.centre) = (still.limit, still.centre);
    }
    seen
}

#[cfg(test)]
mod tests;
