//! The modal state of a control before and after one line of a program, found by executing the program up
//! to there. A line that is executed several times is reported as it is met first.
//!
//! What the program has not said is not told, whatever a control may have at power-on.

use std::io::{self, Read};

use ncc_dialects::Settings;
use ncc_exec::world::World;
use ncc_exec::{Exec, Runner};
use ncc_frontends::{Batch, Reader};
use ncc_ir::canon::{Distance, FeedMode, Motion, Plane, Spindle, SpindleMode, Turn, Units};
use ncc_ir::program::{Op, Program, Stmt};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

use crate::render::spelled;
use crate::review::words::{coolant, number, spindle};
use crate::source::chunks::{Chunk, Chunks};
use crate::verify_run::controls::fixed;

/// What is reported, in this order.
pub const WHAT: [&str; 12] = [
    "units",
    "distance",
    "plane",
    "motion",
    "feed counts",
    "feed",
    "work offset",
    "tool",
    "length offset",
    "spindle",
    "coolant",
    "cycle",
];

/// A control's state in words, in the order of [`WHAT`]; `None` is what the program has not said.
pub type State = [Option<String>; WHAT.len()];

/// States around a line.
#[derive(Clone, Debug)]
pub enum Around {
    /// Before it and after it.
    Known(Box<[State; 2]>),
    /// The program never comes there with the switches off.
    NotExecuted,
    /// The program cannot be executed so far without what its map does not hold.
    Unknown,
}

/// Executes a program up to the line that lies between two places.
///
/// # Errors
/// It cannot be read.
pub fn around(settings: &Settings, text: &mut dyn Read, line: (u32, u32)) -> io::Result<Around> {
    let mut walk = Walk::new(settings, line);
    let mut reader = Reader::new(settings.clone(), true);
    let mut batch = Batch::default();
    let mut chunks = Chunks::new(text);
    loop {
        match chunks.take()? {
            Chunk::Lines(base, range) => reader.read(chunks.text(range), base, &mut batch),
            Chunk::TooLong(start, end) => reader.too_long(Span::new(start, end), &mut batch),
            Chunk::End => break,
        }
        if !batch.whole {
            walk.exec.assume(&batch.assumed);
            for stmt in batch.stmts.drain(..) {
                if walk.step(&stmt).is_none() {
                    return Ok(walk.found());
                }
            }
        }
    }
    reader.finish(&mut batch);
    walk.exec.assume(&batch.assumed);
    let body = std::mem::take(&mut batch.stmts);
    let mut procedures = vec![batch.main(body)];
    procedures.append(&mut batch.procedures);
    let program = Program { procedures, ..Program::default() };
    walk.occurs |= program.procedures.iter().any(|p| walk.is_in(&p.body));
    for (at, procedure) in program.procedures.iter().enumerate() {
        let flow = walk.flow_in(&procedure.body);
        // What holds where a subprogram begins is its caller's, whichever that is.
        walk.failed |= at > 0 && matches!(flow, Some([None, _]));
        walk.flow = walk.flow.or(flow);
    }
    if walk.failed {
        return Ok(Around::Unknown);
    }
    let mut runner = Runner::new(&program);
    loop {
        match runner.next(&walk.exec) {
            Ok(Some(stmt)) => {
                if walk.step(stmt).is_none() {
                    return Ok(walk.found());
                }
            }
            Ok(None) => break,
            Err(_) => {
                walk.failed = true;
                break;
            }
        }
    }
    Ok(walk.found())
}

struct Walk<'s> {
    settings: &'s Settings,
    line: (u32, u32),
    exec: Exec,
    tracker: Tracker,
    before: Option<State>,
    after: Option<State>,
    /// Whether a statement stands in the line.
    occurs: bool,
    /// The statements beside those of the line, where it only says where the program goes on: such a
    /// line is not executed by itself.
    flow: Option<[Option<Span>; 2]>,
    failed: bool,
}

impl Walk<'_> {
    fn new(settings: &Settings, line: (u32, u32)) -> Walk<'_> {
        let mut world =
            World { behaviours: settings.behaviours(), ..World::generate(1, &fixed(settings.dialect)) };
        world.arcs = settings.arc_rule();
        Walk {
            settings,
            line,
            exec: Exec::new(&world, 0),
            tracker: Tracker::default(),
            before: None,
            after: None,
            occurs: false,
            flow: None,
            failed: false,
        }
    }

    fn holds(&self, span: Span) -> bool {
        (self.line.0..self.line.1).contains(&span.start)
    }

    /// Whether one of the statements, or of those in their bodies, stands in the line.
    fn is_in(&self, stmts: &[Stmt]) -> bool {
        stmts.iter().any(|stmt| {
            self.holds(stmt.span)
                || match &stmt.op {
                    Op::Control(control) => control.bodies().any(|body| self.is_in(body)),
                    _ => false,
                }
        })
    }

    /// The neighbours of the line's statements in their body, if all of them only say where to go on.
    fn flow_in(&self, body: &[Stmt]) -> Option<[Option<Span>; 2]> {
        let flows = |stmt: &&Stmt| matches!(stmt.op, Op::Call(_) | Op::Return | Op::RepeatBlocks(_));
        let first = body.iter().position(|stmt| self.holds(stmt.span))?;
        let count = body[first..].iter().take_while(|stmt| self.holds(stmt.span)).count();
        let (before, rest) = body.split_at(first);
        let (own, after) = rest.split_at(count);
        own.iter().all(|stmt| flows(&stmt)).then(|| {
            let before = before.iter().rev().find(|stmt| !flows(stmt));
            let after = after.iter().find(|stmt| !flows(stmt));
            [before.map(|stmt| stmt.span), after.map(|stmt| stmt.span)]
        })
    }

    /// Executes a statement beside which the line may stand; `None` if nothing further is to be found.
    fn beside(&mut self, stmt: &Stmt, [last, next]: [Option<Span>; 2]) -> Option<()> {
        if self.before.is_some() && next == Some(stmt.span) {
            self.after = Some(self.state());
            return None;
        }
        if self.before.is_none() && last.is_none() {
            self.before = Some(self.state());
        }
        if self.exec.step(stmt, &mut Vec::new()).is_err() {
            self.failed = true;
            return None;
        }
        self.tracker.step(stmt);
        if self.before.is_none() && last == Some(stmt.span) {
            self.before = Some(self.state());
            // The end of a subprogram changes nothing.
            if next.is_none() {
                self.after = self.before.clone();
                return None;
            }
        }
        Some(())
    }

    /// Executes a statement; `None` if nothing further is to be found.
    fn step(&mut self, stmt: &Stmt) -> Option<()> {
        if let Some(beside) = self.flow {
            return self.beside(stmt, beside);
        }
        let here = self.holds(stmt.span);
        if !here && self.after.is_some() {
            return None;
        }
        if here && self.before.is_none() {
            self.occurs = true;
            self.before = Some(self.state());
        }
        if !here && !self.occurs && stmt.span.start >= self.line.1 {
            // The line says nothing that is executed: the program has passed it.
            self.before = Some(self.state());
            self.after = self.before.clone();
            return None;
        }
        if self.exec.step(stmt, &mut Vec::new()).is_err() {
            self.failed = true;
            return None;
        }
        self.tracker.step(stmt);
        if here {
            self.after = Some(self.state());
        }
        Some(())
    }

    fn found(mut self) -> Around {
        if self.before.is_none() && !self.occurs && !self.failed {
            // It stands behind all that is executed.
            self.before = Some(self.state());
            self.after = self.before.clone();
        }
        match (self.before, self.after) {
            (Some(before), Some(after)) => Around::Known(Box::new([before, after])),
            _ if self.failed => Around::Unknown,
            _ => Around::NotExecuted,
        }
    }

    fn state(&self) -> State {
        let modes = &self.tracker.modes;
        let state = self.exec.state();
        let dialects = [self.settings.dialect; 2];
        let length = || match self.exec.length_edge() {
            Some((-1, edge)) => format!("edge {edge}"),
            Some((tool, edge)) => format!("edge {edge} of tool {tool}"),
            None => match self.exec.length_entry() {
                Some(0) | None => "none".to_owned(),
                Some(entry) => format!("entry {entry}"),
            },
        };
        let has_length = modes.length_offset.is_some() || self.exec.length_edge().is_some();
        let turns = state.spindle != Spindle::Stopped || state.speed != 0;
        [
            modes.units.map(|units| match units {
                Units::Mm => "mm".to_owned(),
                Units::Inch => "inch".to_owned(),
            }),
            modes.distance.map(|distance| match distance {
                Distance::Absolute => "absolute".to_owned(),
                Distance::Incremental => "incremental".to_owned(),
            }),
            modes.plane.map(|plane| match plane {
                Plane::Xy => "XY".to_owned(),
                Plane::Zx => "ZX".to_owned(),
                Plane::Yz => "YZ".to_owned(),
            }),
            modes.motion.map(|motion| match motion {
                Motion::Traverse => "rapid".to_owned(),
                Motion::Feed => spelled::feed_move(),
                Motion::Arc(Turn::Clockwise) => "arc clockwise".to_owned(),
                Motion::Arc(Turn::Counterclockwise) => "arc counter-clockwise".to_owned(),
                Motion::Cycle => "cycle".to_owned(),
            }),
            modes.feed_mode.map(|mode| match mode {
                FeedMode::PerMinute => "per minute".to_owned(),
                FeedMode::PerRevolution => "per revolution".to_owned(),
                FeedMode::InverseTime => "inverse time".to_owned(),
            }),
            (self.exec.feed() != 0).then(|| format!("{} mm/min", number(self.exec.feed()))),
            modes.work_offset.map(|offset| spelled::work_offset(offset, dialects)),
            u32::try_from(state.tool).ok().map(|tool| tool.to_string()),
            has_length.then(length),
            turns.then(|| match state.spindle {
                Spindle::Stopped => spindle(state.spindle).to_owned(),
                turning => {
                    let counts = match state.spindle_mode {
                        SpindleMode::Turns => "rev/min",
                        SpindleMode::Surface => "m/min",
                    };
                    format!("{} {} {counts}", spindle(turning), number(state.speed))
                }
            }),
            Some(coolant(state.coolant())),
            Some(self.cycle()),
        ]
    }

    fn cycle(&self) -> String {
        let Some((_, retract, depth)) = self.exec.cycle_levels() else { return "none".to_owned() };
        let kind = self.tracker.cycle.as_ref().map_or("cycle", |own| own.cycle.kind.name());
        spelled::cycle_levels(kind, [number(retract), number(depth)], self.tracker.modes.return_level)
    }
}
