//! The safe start: what a written program states before its first event.
//!
//! It says what the source says before its first event, then what the translation assumes
//! ; a fact that neither knows is left out. Comments that come before wait after it.

use ncc_dialects::SafeStart;
use ncc_ir::canon::{Axis, Distance, Fact, Modes, ReturnLevel, Units};
use ncc_ir::diag::Fault;
use ncc_ir::program::{Op, Stmt};

use super::Words;
use crate::common::Sink;
use crate::common::block::{Need, Part, Rank};
use crate::common::codes::Code;
use crate::common::setting::Setting;

/// Most comment that waits for the safe start; more of it is written before.
const MOST_HELD: usize = 1 << 16;

/// The program up to its first event.
#[derive(Clone, Debug, Default)]
pub(crate) struct Preamble {
    /// Facts that the source has stated.
    said: Modes,
    /// Codes that the source has stated and the safe start has no place for.
    further: Vec<Code>,
    /// Whether anything was absorbed.
    any: bool,
    /// Whether the first way along Z is so far from where the axis stands, or a thread or an arc from there, and no
    /// length is stated before it: whether it is longer by a length that it applies, or cancels, is a setting of the
    /// control.
    up_from_here: bool,
    /// Number of the first absorbed block.
    number: Option<u32>,
    /// Comments and blank lines.
    pub held: Vec<u8>,
}

impl Preamble {
    /// Units that the source has stated.
    pub(crate) fn units(&self) -> Option<Units> {
        self.said.units
    }
}

impl Words {
    /// A program that is called by another states nothing before its first event: it would go on in its caller.
    pub(crate) fn stands_alone(&mut self, taken: &Modes) {
        self.preamble = None;
        if let Some(units) = taken.units {
            self.units_stated[units as usize] = true;
        }
    }

    /// The tool in the spindle before the program begins.
    pub(crate) fn hold_tool(&mut self, tool: u32) {
        let tool = Some(i64::from(tool));
        (self.tracker.tool, self.tracker.selected) = (tool, tool);
    }

    /// Takes a statement before the first event; `Ok(false)` if it must be written.
    pub(crate) fn absorb(&mut self, stmt: &Stmt, sink: &mut Sink) -> Result<bool, Fault> {
        let Some(held) = self.preamble.as_ref().map(|p| p.held.len()) else { return Ok(false) };
        if matches!(stmt.op, Op::Comment(_) | Op::NoEffect(_) | Op::Blank) {
            if held > MOST_HELD
                && let Some(p) = &mut self.preamble
            {
                if let Some(trace) = &mut self.trace {
                    trace.started(sink.out, &p.held);
                }
                sink.out.append(&mut p.held);
            }
            return Ok(false);
        }
        let Some(setting) = Setting::from_op(&stmt.op).filter(|_| stmt.skip.is_none()) else {
            self.start(sink);
            return Ok(false);
        };
        let code = self.setting(setting)?;
        let rows = &self.dialect.safe_start;
        let Some(p) = &mut self.preamble else { return Ok(false) };
        match setting {
            Setting::Units(u) => p.said.units = Some(u),
            Setting::Distance(d) => p.said.distance = Some(d),
            Setting::Plane(plane) => p.said.plane = Some(plane),
            Setting::FeedMode(f) => p.said.feed_mode = Some(f),
            Setting::Origin(n) => p.said.work_offset = Some(n),
            Setting::Level(l) => p.said.return_level = Some(l),
            Setting::NoShift
            | Setting::NoCompensation
            | Setting::NoLength
            | Setting::NoCycle
            | Setting::Turns => {}
        }
        let row = row_of(setting);
        p.any = true;
        if p.number.is_none() {
            p.number = stmt.number;
        }
        if let Some(code) = code.filter(|_| row.is_none_or(|row| !rows.contains(&row))) {
            p.further.retain(|c| *c != code && (c.group == 0 || c.group != code.group));
            p.further.push(code);
        }
        Ok(true)
    }

    /// Looks for what the safe start must not state.
    pub(crate) fn look_ahead(&mut self, stmts: &[Stmt]) {
        let Some(preamble) = &mut self.preamble else { return };
        let ops = stmts.iter().map(|stmt| stmt.op.unwrapped());
        let first = ops.take_while(|op| !op.calls_length()).find_map(|op| {
            if let Op::StraightTraverse(m) | Op::StraightFeed(m) = op {
                return m.to.get(Axis::Z).map(|z| z.distance == Fact::Known(Distance::Incremental));
            }
            let thread = if let Op::SynchronisedFeed(m) = op { m.to.get(Axis::Z) } else { None };
            let arc = if let Op::ArcFeed(arc) = op { arc.to.get(Axis::Z) } else { None };
            thread.or(arc).map(|_| true)
        });
        preamble.up_from_here = first.unwrap_or(false);
    }

    /// What waits for the safe start stands before it: definitions, and the comments among them.
    pub(crate) fn before_start(&mut self, sink: &mut Sink) {
        let number = self.block.number.take();
        self.flush(false, sink);
        self.block.number = number;
        if let Some(preamble) = &mut self.preamble {
            if let Some(trace) = &mut self.trace {
                trace.started(sink.out, &preamble.held);
            }
            sink.out.append(&mut preamble.held);
        }
    }

    /// Writes the safe start and what waits after it, before the first event.
    pub(crate) fn start(&mut self, sink: &mut Sink) {
        // What stands in the block at hand belongs to comments that come before.
        let (number, skip) = (self.block.number, self.block.skip);
        self.block.skip = None;
        self.flush(false, sink);
        let Some(preamble) = self.preamble.take() else { return };
        if let Some(trace) = &mut self.trace {
            trace.held_so_far(&preamble.held);
        }
        let facts = Facts { said: &preamble.said, assumed: &self.assumed };
        let units = facts.get(|m| m.units);
        let plane = facts.get(|m| m.plane);
        // G91 is stated by the block that needs it: nobody expects it in the first line.
        let incremental = facts.get(|m| m.distance).filter(|d| *d == Distance::Incremental && skip.is_none());
        let distance = match incremental {
            Some(_) => Some(Distance::Absolute),
            None => facts.get(|m| m.distance),
        };
        let feed_mode = facts.get(|m| m.feed_mode);
        let origin = facts.get(|m| m.work_offset);
        self.block.number = preamble.number;
        let mut stated = Modes::default();
        let mut own_block = None;
        for row in &self.dialect.safe_start {
            let setting = match row {
                SafeStart::Units => units.map(Setting::Units),
                SafeStart::Plane => plane.map(Setting::Plane),
                SafeStart::Distance => distance.map(Setting::Distance),
                SafeStart::FeedMode => feed_mode.map(Setting::FeedMode),
                SafeStart::NoCompensation => Some(Setting::NoCompensation),
                // Taken for granted instead, as it is for the source.
                SafeStart::NoLengthOffset if preamble.up_from_here => None,
                SafeStart::NoLengthOffset => Some(Setting::NoLength),
                SafeStart::NoCycle => Some(Setting::NoCycle),
                SafeStart::Centre => {
                    if let Some(code) = self.codes.centre_from_start {
                        self.start_code(code, sink);
                    }
                    None
                }
                SafeStart::WorkOffset => {
                    own_block = origin.map(Setting::Origin);
                    None
                }
            };
            if let Some(setting) = setting {
                self.start_setting(setting, &mut stated, sink);
            }
        }
        for code in preamble.further {
            self.start_code(code, sink);
        }
        if let Some(level) = preamble.said.return_level {
            self.now_in_force(Setting::Level(level));
            stated.return_level = Some(level);
        } else if let Some(level) = self.assumed.return_level {
            // Subprograms may rely on it, where this control begins with the other.
            let own = self.dialect.power_on.return_level.as_ref().map(|fact| ReturnLevel::from(fact.value));
            if own.is_some_and(|own| own != level) {
                self.start_setting(Setting::Level(level), &mut stated, sink);
            }
        }
        self.flush(false, sink);
        if let Some(setting) = own_block {
            self.start_setting(setting, &mut stated, sink);
            self.flush(false, sink);
        }
        if let Some(trace) = &mut self.trace {
            trace.started(sink.out, &preamble.held);
        }
        sink.out.extend_from_slice(&preamble.held);
        (self.block.number, self.block.skip) = (number, skip);
        if self.block.number == preamble.number {
            self.block.number = None;
        }
        if let Some(incremental) = incremental {
            self.start_setting(Setting::Distance(incremental), &mut stated, sink);
        }
        self.stated = stated;
    }

    fn start_setting(&mut self, setting: Setting, stated: &mut Modes, sink: &mut Sink) {
        let Ok(Some(code)) = self.setting(setting) else { return };
        self.start_code(code, sink);
        self.now_in_force(setting);
        match setting {
            Setting::Units(u) => stated.units = Some(u),
            Setting::Plane(p) => stated.plane = Some(p),
            Setting::Distance(d) => stated.distance = Some(d),
            Setting::FeedMode(f) => stated.feed_mode = Some(f),
            Setting::Origin(n) => stated.work_offset = Some(n),
            Setting::Level(l) => stated.return_level = Some(l),
            Setting::NoLength => stated.length_offset = Some(0),
            Setting::NoShift => stated.no_origin_shift = Some(true),
            Setting::NoCompensation | Setting::NoCycle | Setting::Turns => {}
        }
    }

    fn start_code(&mut self, code: Code, sink: &mut Sink) {
        let need = Need::new(Rank::Setting).code(Some(code));
        if self.admit(&need, sink).is_ok() {
            self.block.code(Part::Mode, &code);
        }
        // The split of this block is not one of the source's.
        self.split = false;
    }

    /// Writes what waits for a first event that did not come.
    pub(crate) fn no_event(&mut self, sink: &mut Sink) {
        if self.preamble.as_ref().is_some_and(|p| p.any) {
            self.start(sink);
        } else if let Some(p) = self.preamble.take() {
            if let Some(trace) = &mut self.trace {
                trace.started(sink.out, &p.held);
            }
            sink.out.extend_from_slice(&p.held);
        }
    }
}

/// What the source says, else what is assumed.
struct Facts<'a> {
    said: &'a Modes,
    assumed: &'a Modes,
}

impl Facts<'_> {
    fn get<T>(&self, fact: impl Fn(&Modes) -> Option<T>) -> Option<T> {
        fact(self.said).or_else(|| fact(self.assumed))
    }
}

/// The row of the safe start that states a setting.
fn row_of(setting: Setting) -> Option<SafeStart> {
    match setting {
        Setting::Units(_) => Some(SafeStart::Units),
        Setting::Distance(_) => Some(SafeStart::Distance),
        Setting::Plane(_) => Some(SafeStart::Plane),
        Setting::FeedMode(_) => Some(SafeStart::FeedMode),
        Setting::Origin(_) => Some(SafeStart::WorkOffset),
        Setting::NoCompensation => Some(SafeStart::NoCompensation),
        Setting::NoLength => Some(SafeStart::NoLengthOffset),
        Setting::NoCycle => Some(SafeStart::NoCycle),
        Setting::Level(_) | Setting::NoShift | Setting::Turns => None,
    }
}
