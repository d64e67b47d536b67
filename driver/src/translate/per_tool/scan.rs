//! The tool changes of a text, and what is active at each of them.

use std::ops::Range;

use ncc_frontends::Batch;
use ncc_ir::canon::{AXES, Axis, Distance, Fact, Modes, Motion};
use ncc_ir::diag::{FileNeeds, Gravity};
use ncc_ir::expr::num::{Nanos, Num};
use ncc_ir::program::kinds::{machine, moves};
use ncc_ir::program::{Op, Point, Stmt, Text};
use ncc_ir::track::Tracker;

use crate::job::Job;
use crate::verify_run::facts::reader_of_output;
use crate::verify_run::per_tool::pieces;

/// What was found of a text.
#[derive(Debug, Default)]
pub(super) struct Scanned {
    /// Its tool changes.
    pub(super) changes: Vec<Change>,
    /// Whether something is cut before the first one.
    pub(super) cuts_before: bool,
    /// Axes that have words anywhere.
    pub(super) used: [bool; AXES],
}

/// A tool change.
#[derive(Debug)]
pub(super) struct Change {
    /// Its line, with its end.
    pub(super) block: Range<usize>,
    /// Where comments begin that stand right before it.
    pub(super) comments: usize,
    /// The tool's number.
    pub(super) tool: i64,
    /// Modes that are active there.
    pub(super) modes: Modes,
    /// Where the axes stand, in program coordinates, as far as it is known.
    pub(super) position: [Option<Nanos>; AXES],
    /// The feed.
    pub(super) feed: Option<Num>,
    /// The spindle's speed.
    pub(super) speed: Option<Num>,
    /// Axes whose place the first move after it relies on; not Z, which is at machine zero.
    pub(super) unstated: [bool; AXES],
    /// The place of that move in the text.
    pub(super) next_move: Option<usize>,
    /// Whether a cut comes before the feed is stated.
    pub(super) needs_feed: bool,
    /// Whether the spindle starts before its speed is stated.
    pub(super) needs_speed: bool,
    /// Where the first word of Z after it is incremental.
    pub(super) relative_z: Option<usize>,
    /// Work offsets that are active after it, by their numbers.
    pub(super) offsets: Vec<u16>,
    /// The comment in its block, without the tool's name.
    pub(super) remark: Option<Text>,
}

/// Looks through a text. What no file could state by itself is an error: its place, and what it is.
pub(super) fn scan(job: &Job, text: &[u8]) -> Result<Scanned, (usize, FileNeeds)> {
    let mut reader = reader_of_output(job);
    let mut batch = Batch::default();
    let mut walk = Walk { text, ..Walk::default() };
    for piece in pieces(text) {
        reader.read(&text[piece.clone()], piece.start as u32, &mut batch);
        walk.piece(&mut batch)?;
    }
    reader.finish(&mut batch);
    walk.piece(&mut batch)?;
    let used = walk.found.used;
    for change in &mut walk.found.changes {
        // X and Y are always the operator's; of the others those that the program turns.
        for axis in Axis::ALL.into_iter().filter(|axis| axis.is_rotary() && !used[*axis as usize]) {
            change.unstated[axis as usize] = false;
        }
    }
    Ok(walk.found)
}

/// The text so far.
#[derive(Debug, Default)]
struct Walk<'t> {
    text: &'t [u8],
    at: Tracker,
    found: Scanned,
    /// The end of the last statement that is more than a comment.
    last: usize,
    /// What a later file would need of what came so far, by its place: lasting settings, values in tables.
    lasting: Option<(usize, FileNeeds)>,
    /// A shift of program zero may be active.
    shifted: bool,
    /// A length that the program states may be active.
    length: bool,
    /// Where the spindle is started, or a value put into a table, before the first tool change: the executor makes no event
    /// of the one, and knows nothing of what the operator sets by the tool.
    early: Option<(usize, FileNeeds)>,
    /// What has come since the last change.
    since: Since,
}

#[derive(Debug, Default)]
struct Since {
    moved: bool,
    moved_z: bool,
    fed: bool,
    speed: bool,
}

impl Walk<'_> {
    fn piece(&mut self, batch: &mut Batch) -> Result<(), (usize, FileNeeds)> {
        let error = batch.diagnostics.iter().find(|d| d.fault.gravity() == Gravity::Error);
        if batch.whole || !batch.procedures.is_empty() || error.is_some() {
            return Err((self.last, FileNeeds::Control));
        }
        for stmt in batch.stmts.drain(..) {
            self.stmt(&stmt)?;
            self.at.step(&stmt);
        }
        batch.diagnostics.clear();
        Ok(())
    }

    fn stmt(&mut self, stmt: &Stmt) -> Result<(), (usize, FileNeeds)> {
        let place = stmt.span.start as usize;
        if matches!(stmt.op, Op::Comment(_) | Op::Blank | Op::NoEffect(_)) {
            return Ok(());
        }
        if stmt.skip.is_some() {
            return Err((place, FileNeeds::Switch));
        }
        if stmt.op == Op::ChangeTool {
            return self.change(stmt);
        }
        self.moves(&stmt.op, place);
        match &stmt.op {
            Op::SetFeedRate(_) => self.since.fed = true,
            // Its holes go at the feed of its own block.
            Op::StartCycle(cycle) => self.since.fed |= cycle.feed.is_some(),
            Op::SetSpindleSpeed(_) => self.since.speed = true,
            Op::StartSpindleClockwise | Op::StartSpindleCounterclockwise if self.found.changes.is_empty() => {
                self.early.get_or_insert((place, FileNeeds::AnotherTool));
            }
            Op::StartSpindleClockwise | Op::StartSpindleCounterclockwise if !self.since.speed => {
                self.last_change(|change| change.needs_speed = true);
            }
            Op::SetData(_) => {
                if self.found.changes.is_empty() {
                    self.early.get_or_insert((place, FileNeeds::TableValue));
                }
                self.lasts(place, FileNeeds::TableValue);
            }
            Op::SetMotionControlMode(_)
            | Op::Advise(_)
            | Op::SetSpindleMode(_)
            | Op::LimitSpindleSpeed(_)
            | Op::TurnRotaryAxes(_)
            | Op::UseToolCentrePoint(_)
            | Op::OrientToolAxis(_)
            | Op::MachineFunction(_) => self.lasts(place, FileNeeds::Setting),
            Op::SetPosition(_) | Op::SetSlot(_) | Op::SetFrame(_) | Op::UseOriginShift(true) => {
                self.shifted = true;
            }
            Op::ClearFrame(_) | Op::UseOriginShift(false) => self.shifted = false,
            Op::UseToolLength(_) => self.length = true,
            Op::UseToolLengthOffset(entry) => {
                self.length = entry.literal().and_then(|entry| entry.whole_number()) != Some(0);
            }
            _ => {}
        }
        // A tool's own word may stand in the block of its change.
        if !matches!(stmt.op, Op::SelectTool(_)) {
            self.last = self.last.max(stmt.span.end as usize);
        }
        Ok(())
    }

    fn lasts(&mut self, place: usize, what: FileNeeds) {
        self.lasting.get_or_insert((place, what));
    }

    fn last_change(&mut self, note: impl FnOnce(&mut Change)) {
        if let Some(change) = self.found.changes.last_mut() {
            note(change);
        }
    }

    /// Notes what a statement needs to know of what came before its file.
    fn moves(&mut self, op: &Op, place: usize) {
        let cuts = match op {
            Op::StraightFeed(_)
            | Op::SynchronisedFeed(_)
            | Op::ArcFeed(_)
            | Op::ArcForm(_)
            | Op::Hole(_)
            | Op::Pattern(_) => true,
            Op::Position(_) => self.at.modes.motion != Some(Motion::Traverse),
            _ => false,
        };
        if cuts {
            self.found.cuts_before |= self.found.changes.is_empty();
            if !self.since.fed {
                self.last_change(|change| change.needs_feed = true);
            }
        }
        let words = match op {
            Op::StraightTraverse(to) | Op::StraightFeed(to) | Op::Position(to) | Op::Hole(to) => Some(&to.to),
            Op::SynchronisedFeed(to) => Some(&to.to),
            Op::ArcFeed(arc) => Some(&arc.to),
            _ => None,
        };
        for axis in
            words.into_iter().flat_map(|to| Axis::ALL.into_iter().filter(|axis| to.get(*axis).is_some()))
        {
            self.found.used[axis as usize] = true;
        }
        if let Some(to) = words.filter(|to| to.get(Axis::Z).is_some())
            && !std::mem::replace(&mut self.since.moved_z, true)
            && !states(to, Axis::Z, self.at.raw, self.at.modes.distance)
        {
            self.last_change(|change| change.relative_z = Some(place));
        }
        let any = cuts || matches!(op, moves!() | machine!() | Op::Position(_) | Op::Polar(_));
        if let Some(offset) = self.at.modes.work_offset.filter(|_| any) {
            self.last_change(|change| {
                if !change.offsets.contains(&offset) {
                    change.offsets.push(offset);
                }
            });
        }
        if !any || std::mem::replace(&mut self.since.moved, true) {
            return;
        }
        let raw = self.at.raw;
        let modal = self.at.modes.distance;
        let rapid = words.filter(|_| !cuts && !matches!(op, Op::Polar(_)));
        let states = |axis: Axis| rapid.is_some_and(|to| states(to, axis, raw, modal));
        let unstated = Axis::ALL.map(|axis| axis != Axis::Z && !states(axis));
        self.last_change(|change| (change.unstated, change.next_move) = (unstated, Some(place)));
    }

    /// Refuses a tool change, which a file ends with, where the next one would go on with more than modes.
    fn leaves_nothing(&self, place: usize) -> Result<(), (usize, FileNeeds)> {
        let refused = |what: FileNeeds| Err((place, what));
        if let Some((place, what)) = self.lasting {
            return Err((place, what));
        }
        if self.shifted || self.at.framed || self.at.turned {
            return refused(FileNeeds::Shift);
        }
        if self.length {
            return refused(FileNeeds::Length);
        }
        if self.at.cycle.is_some() || self.at.cycle_in_doubt {
            return refused(FileNeeds::Cycle);
        }
        if self.at.compensated {
            return refused(FileNeeds::Compensation);
        }
        Ok(())
    }

    fn change(&mut self, stmt: &Stmt) -> Result<(), (usize, FileNeeds)> {
        let place = stmt.span.start as usize;
        let refused = |what: FileNeeds| Err((place, what));
        let Some(tool) = self.at.selected else { return refused(FileNeeds::ToolNumber) };
        if self.found.cuts_before || !self.found.changes.is_empty() {
            self.leaves_nothing(place)?;
        } else if let Some(early) = self.early {
            return Err(early);
        }
        let line =
            |from: usize| memchr::memchr(b'\n', &self.text[from..]).map_or(self.text.len(), |n| from + n + 1);
        let start = memchr::memrchr(b'\n', &self.text[..place]).map_or(0, |n| n + 1);
        let block = start..line(stmt.span.end as usize);
        let comments = if self.last == 0 { 0 } else { line(self.last).min(start) };
        let change = Change {
            comments,
            tool,
            modes: self.at.modes,
            position: self.at.position,
            feed: self.at.feed.filter(|_| !self.at.stale_feed),
            speed: self.at.speed,
            unstated: [false; AXES],
            next_move: None,
            needs_feed: false,
            needs_speed: false,
            relative_z: None,
            offsets: Vec::new(),
            remark: stmt.comment.as_ref().and_then(|comment| remark(comment, tool)),
            block,
        };
        self.last = change.block.end.saturating_sub(1);
        self.found.changes.push(change);
        self.since = Since::default();
        Ok(())
    }
}

/// Whether a word states the place of an axis by itself.
fn states(to: &Point, axis: Axis, raw: bool, modal: Option<Distance>) -> bool {
    to.get(axis).is_some_and(|word| {
        let own = if let Fact::Known(own) = word.distance { Some(own) } else { modal };
        raw || own == Some(Distance::Absolute)
    })
}

/// The comment of a tool change without the tool's name: `TOOL 1 6MM ENDMILL`.
fn remark(comment: &Text, tool: i64) -> Option<Text> {
    let comment = comment.to_string();
    let own = comment.strip_prefix(&format!("TOOL {tool}")).unwrap_or(&comment).trim();
    (!own.is_empty()).then(|| own.into())
}
