//! Counting as the functions go by: times, distances, extents, by tool and by operation.
//!
//! An operation begins where a tool is changed, and at a comment in a block of its own, as the
//! programmer's headings are. A comment before a tool change names the operation of that tool; of
//! several comments in a row the last one counts. What is done before the first one belongs to it.

use std::io;

use ncc_exec::{Attribute, Kind};
use ncc_ir::canon::Spindle;
use ncc_time::{Machine, Timed, ToolChangeOn, path};
use serde::Serialize;

use super::columns::micro;
use super::columns::units;
use super::drive::{Said, Sink};
use super::reach::Reach;

/// Most operations with a row of their own; the time of further ones goes to the last.
const MOST_OPERATIONS: usize = 1000;

/// Longest name of an operation, in characters.
const LONGEST_NAME: usize = 48;

/// What was counted over a stretch of a program.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Tally {
    /// Seconds in all.
    pub time: f64,
    /// Seconds of moves at feed.
    pub cutting: f64,
    /// Seconds of rapids.
    pub rapid: f64,
    /// Seconds of all else: the four that follow.
    pub idle: f64,
    /// Seconds of tool changes.
    pub tool_change: f64,
    /// Seconds until the spindle turns or stands.
    pub spindle: f64,
    /// Seconds of dwells.
    pub dwell: f64,
    /// Seconds of other functions.
    pub other: f64,
    /// Way at feed, mm.
    pub cutting_distance: f64,
    /// Way in rapids, mm.
    pub rapid_distance: f64,
    /// Moves at feed.
    pub cuts: u64,
    /// Holes of cycles.
    pub holes: u64,
    /// Least and greatest feed of moves at feed, mm/min.
    pub feed: Option<[f64; 2]>,
    /// Least and greatest speed of the turning spindle in moves at feed, rev/min.
    pub speed: Option<[f64; 2]>,
    /// Least and greatest X, Y and Z of moves at feed, program coordinates, mm.
    pub extents: Option<[[f64; 2]; 3]>,
}

/// A tool and what it does.
#[derive(Clone, Debug, Serialize)]
pub struct Tool {
    /// Its number; `None` is the one in the spindle at the start.
    pub tool: Option<i64>,
    /// How many times it is put in.
    pub changes: u64,
    /// Entries of the length table that its cuts use.
    pub cut_offsets: Vec<u32>,
    /// Names of its operations, in order, each once.
    pub operations: Vec<String>,
    /// What was counted.
    #[serde(flatten)]
    pub tally: Tally,
}

/// An operation.
#[derive(Clone, Debug, Serialize)]
pub struct Operation {
    /// Its comment, or what it does.
    pub name: String,
    /// Its tool.
    pub tool: Option<i64>,
    /// Line of the source where it begins.
    pub line: u32,
    /// Seconds on the clock when it begins.
    pub start: f64,
    /// Whether the name is a comment of the program.
    #[serde(skip)]
    named: bool,
    /// Whether its tool was put in within it.
    #[serde(skip)]
    changed: bool,
    /// What was counted.
    #[serde(flatten)]
    pub tally: Tally,
}

/// All that is counted of a program.
#[derive(Clone, Debug, Default)]
pub struct Account {
    pub(crate) total: Tally,
    pub(crate) tools: Vec<Tool>,
    pub(crate) operations: Vec<Operation>,
    /// Functions that went by.
    pub functions: u64,
}

/// Counts.
pub struct Tallier {
    account: Account,
    change_on: ToolChangeOn,
    /// A comment that names what comes.
    heading: Option<(String, u32)>,
    tool: usize,
}

impl Tallier {
    /// One without any time yet, for a machine.
    pub fn new(machine: &Machine) -> Tallier {
        Tallier { account: Account::default(), change_on: machine.tool_change_on, heading: None, tool: 0 }
    }

    /// What was counted. Tools that did nothing are left out.
    pub fn finish(mut self) -> Account {
        for operation in self.account.operations.iter_mut().filter(|o| !o.named) {
            operation.name = match (operation.tally.holes, operation.tool) {
                (1, _) => "1 hole".to_owned(),
                (2.., _) => format!("{} holes", operation.tally.holes),
                (0, Some(tool)) => format!("tool {tool}"),
                (0, None) => "start".to_owned(),
            };
        }
        for operation in &self.account.operations {
            let tool = self.account.tools.iter_mut().find(|t| t.tool == operation.tool);
            if let Some(tool) = tool
                && !tool.operations.contains(&operation.name)
                && operation.named
            {
                tool.operations.push(operation.name.clone());
            }
        }
        self.account.tools.retain(|t| t.tool.is_some() || t.tally.time > 0.0 || t.tally.cuts > 0);
        self.account
    }

    /// The tool that a change puts in, if the function is one.
    fn change(&self, timed: &Timed) -> Option<i64> {
        match (&timed.act.event.kind, self.change_on) {
            (Kind::ToolChange, ToolChangeOn::Change) => Some(timed.act.event.state.tool),
            (Kind::Attribute(Attribute::SelectTool(tool)), ToolChangeOn::Select) => Some(*tool),
            _ => None,
        }
    }

    /// Goes on to the tool that the function belongs to.
    fn take_tool(&mut self, number: i64, change: bool) {
        let number = (number >= 0).then_some(number);
        let tools = &mut self.account.tools;
        if tools.get(self.tool).is_none_or(|t| t.tool != number) {
            self.tool = tools.iter().position(|t| t.tool == number).unwrap_or_else(|| {
                tools.push(Tool {
                    tool: number,
                    changes: 0,
                    cut_offsets: Vec::new(),
                    operations: Vec::new(),
                    tally: Tally::default(),
                });
                tools.len() - 1
            });
        }
        tools[self.tool].changes += u64::from(change);
    }

    /// Begins another operation where one begins.
    fn take_operation(&mut self, timed: &Timed, change: bool) {
        let tool = self.account.tools[self.tool].tool;
        let line = timed.act.place.line;
        let heading = self.heading.take();
        let operations = &mut self.account.operations;
        let full = operations.len() >= MOST_OPERATIONS;
        match operations.last_mut() {
            Some(_) if heading.is_none() && !change => {}
            // A change of tool after a heading, or at the beginning, belongs to it.
            Some(last) if heading.is_none() && !last.changed && last.tally.cuts == 0 => {
                (last.tool, last.changed) = (tool, true);
            }
            Some(last) if full => last.name = "further operations".to_owned(),
            Some(_) | None => {
                let (name, line) = match heading {
                    Some((name, at)) => (Some(name), at),
                    None => (None, line),
                };
                let named = name.is_some();
                operations.push(Operation {
                    name: name.unwrap_or_default(),
                    tool,
                    line,
                    start: timed.start,
                    named,
                    changed: change,
                    tally: Tally::default(),
                });
            }
        }
    }
}

impl Sink for Tallier {
    fn wants_reach(&self) -> bool {
        true
    }

    fn wants_bounds(&self) -> bool {
        true
    }

    fn function(&mut self, timed: &Timed, said: &Said) -> io::Result<()> {
        if let Some(remark) = &said.remark {
            let remark = remark.trim();
            let mut name: String = remark.chars().take(LONGEST_NAME).collect();
            if name.len() < remark.len() {
                name.pop();
                name.push('…');
            }
            if !name.is_empty() {
                self.heading = Some((name, timed.act.place.line));
            }
            return Ok(());
        }
        let mark = matches!(timed.act.event.kind, Kind::Attribute(Attribute::Hole) | Kind::TextEnd);
        self.account.functions += u64::from(!mark);
        let change = self.change(timed);
        let tool = match (change, self.change_on) {
            (Some(tool), _) => tool,
            // From the selection on, where that takes the time.
            (None, ToolChangeOn::Select) => match self.account.tools.get(self.tool) {
                Some(tool) if !matches!(timed.act.event.kind, Kind::ToolChange) => tool.tool.unwrap_or(-1),
                Some(_) | None => timed.act.event.state.tool,
            },
            (None, ToolChangeOn::Change) => timed.act.event.state.tool,
        };
        self.take_tool(tool, change.is_some());
        self.take_operation(timed, change.is_some());
        let step = Step::of(timed, said);
        if step.cuts
            && let Some(entry) = timed.act.cut_offset
            && !self.account.tools[self.tool].cut_offsets.contains(&entry)
        {
            self.account.tools[self.tool].cut_offsets.push(entry);
        }
        self.account.total.add(&step);
        self.account.tools[self.tool].tally.add(&step);
        if let Some(operation) = self.account.operations.last_mut() {
            operation.tally.add(&step);
        }
        Ok(())
    }
}

/// What one function adds.
struct Step {
    kind: Sort,
    seconds: f64,
    /// Way of the linear axes, mm.
    length: f64,
    cuts: bool,
    hole: bool,
    feed: Option<f64>,
    speed: Option<f64>,
    /// Least and greatest X, Y and Z, mm.
    reach: Option<[[f64; 2]; 3]>,
}

/// Kinds of time.
enum Sort {
    Cutting,
    Rapid,
    ToolChange,
    Spindle,
    Dwell,
    Other,
}

impl Step {
    fn of(timed: &Timed, said: &Said) -> Step {
        let act = &timed.act;
        let event = &act.event;
        let kind = match &event.kind {
            Kind::Feed | Kind::Probe { .. } | Kind::Synchronised { .. } | Kind::Arc { .. } => Sort::Cutting,
            Kind::Orient(_) => Sort::Spindle,
            Kind::Traverse => Sort::Rapid,
            Kind::Dwell(_) => Sort::Dwell,
            Kind::ToolChange | Kind::Attribute(Attribute::SelectTool(_)) => Sort::ToolChange,
            Kind::Attribute(
                Attribute::StartSpindle(_) | Attribute::StopSpindle | Attribute::SpindleSpeed(_),
            ) => Sort::Spindle,
            Kind::Coolant
            | Kind::MachineFunction(_)
            | Kind::Data(_)
            | Kind::Tilt(_)
            | Kind::OrientToolAxis(_)
            | Kind::ProgramStop
            | Kind::OptionalProgramStop
            | Kind::ProgramEnd
            | Kind::BeginAgain
            | Kind::TextEnd
            | Kind::Message(_)
            | Kind::Output(_)
            | Kind::Alarm(..)
            | Kind::Attribute(Attribute::FeedRate(_) | Attribute::Hole | Attribute::Remark) => Sort::Other,
        };
        let way = path(event, &act.from);
        let moves = way.change[..3].iter().any(|c| *c != 0.0) || way.sweep > 0.0;
        let length = if moves { way.length } else { 0.0 };
        let cuts = matches!(kind, Sort::Cutting) && way.length > 0.0;
        let ends = || -> Reach {
            let mut reach = Reach::default();
            for (side, (a, b)) in reach.iter_mut().zip(act.program_from.iter().zip(&act.program_to)) {
                *side = [*a.min(b), *a.max(b)];
            }
            reach
        };
        let reach = cuts.then(|| {
            let reach = said.reach.as_deref().copied().unwrap_or_else(ends);
            let mut sides = [[0.0; 2]; 3];
            for (side, [least, most]) in sides.iter_mut().zip(reach) {
                *side = [units(least), units(most)];
            }
            sides
        });
        Step {
            kind,
            seconds: timed.duration,
            length,
            cuts,
            hole: matches!(event.kind, Kind::Attribute(Attribute::Hole)),
            feed: cuts.then(|| units(event.rate)),
            speed: (cuts && event.state.spindle != Spindle::Stopped)
                .then(|| units(event.state.turns(event.end[0]))),
            reach,
        }
    }
}

impl Tally {
    fn add(&mut self, step: &Step) {
        self.time += step.seconds;
        match step.kind {
            Sort::Cutting => {
                self.cutting += step.seconds;
                self.cutting_distance += step.length;
            }
            Sort::Rapid => {
                self.rapid += step.seconds;
                self.rapid_distance += step.length;
            }
            Sort::ToolChange => self.tool_change += step.seconds,
            Sort::Spindle => self.spindle += step.seconds,
            Sort::Dwell => self.dwell += step.seconds,
            Sort::Other => self.other += step.seconds,
        }
        if !matches!(step.kind, Sort::Cutting | Sort::Rapid) {
            self.idle += step.seconds;
        }
        self.cuts += u64::from(step.cuts);
        self.holes += u64::from(step.hole);
        if let Some(feed) = step.feed {
            widen(&mut self.feed, [feed; 2]);
        }
        if let Some(speed) = step.speed {
            widen(&mut self.speed, [speed; 2]);
        }
        if let Some(reach) = step.reach {
            self.reach(reach);
        }
    }

    fn reach(&mut self, reach: [[f64; 2]; 3]) {
        match &mut self.extents {
            None => self.extents = Some(reach),
            Some(own) => own.iter_mut().zip(reach).for_each(|(own, side)| take_in(own, side)),
        }
    }

    /// This and another one.
    pub fn join(&mut self, other: &Tally) {
        self.time += other.time;
        self.cutting += other.cutting;
        self.rapid += other.rapid;
        self.idle += other.idle;
        self.tool_change += other.tool_change;
        self.spindle += other.spindle;
        self.dwell += other.dwell;
        self.other += other.other;
        self.cutting_distance += other.cutting_distance;
        self.rapid_distance += other.rapid_distance;
        self.cuts += other.cuts;
        self.holes += other.holes;
        other.feed.into_iter().for_each(|feed| widen(&mut self.feed, feed));
        other.speed.into_iter().for_each(|speed| widen(&mut self.speed, speed));
        if let Some(reach) = other.extents {
            self.reach(reach);
        }
    }

    /// The same, to a millionth, for output.
    pub fn rounded(&self) -> Tally {
        let pair = |p: [f64; 2]| p.map(micro);
        Tally {
            time: micro(self.time),
            cutting: micro(self.cutting),
            rapid: micro(self.rapid),
            idle: micro(self.idle),
            tool_change: micro(self.tool_change),
            spindle: micro(self.spindle),
            dwell: micro(self.dwell),
            other: micro(self.other),
            cutting_distance: micro(self.cutting_distance),
            rapid_distance: micro(self.rapid_distance),
            cuts: self.cuts,
            holes: self.holes,
            feed: self.feed.map(pair),
            speed: self.speed.map(pair),
            extents: self.extents.map(|e| e.map(pair)),
        }
    }
}

/// Has a range have the least and the greatest of another one, too.
#[inline]
fn take_in(own: &mut [f64; 2], other: [f64; 2]) {
    *own = [own[0].min(other[0]), own[1].max(other[1])];
}

/// The same, where there may be none yet.
#[inline]
fn widen(own: &mut Option<[f64; 2]>, other: [f64; 2]) {
    match own {
        Some(own) => take_in(own, other),
        None => *own = Some(other),
    }
}
