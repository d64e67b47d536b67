//! Writer of the canonical stream, one call a line, as NIST and the case study print it.
//!
//! Every coordinate is absolute; an axis that a statement does not name gets the place where it
//! stands, or `_` if that is not known, cannot be stated exactly, or would apply a length offset
//! that no statement has applied yet. Modes that change no call print nothing. Structure (cycles,
//! patterns, control, calls) has been expanded by passes before; what still arrives is refused.
//!
//! The calls are listed at the reader (`ncc_frontends::canon`).
//!
//! ```text
//! a straight move to X 10    `STRAIGHT_FEED(10.0000, 0.0000, 5.0000)`
//! ```

mod arguments;
mod modes;
pub mod rs274;

use ncc_dialects::{Quantity, Settings};
use ncc_ir::canon::{AXES, Axis, Distance, FeedMode, Modes, Motion, Plane, SpindleMode, Turn, Units};
use ncc_ir::diag::{Diagnostic, Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Nanos;
use ncc_ir::lack::{FlowLack, WordsLack};
use ncc_ir::program::{Arc, Centre, CentreFrom, CutterRadius, FrameSlot, Op, Point, Procedure, Stmt};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

use crate::common::packed::{each_blocks, packed};
use crate::common::quoted::{quote, write_whole};
use crate::origin::Trace;
use crate::{Head, Layout};

/// Digits after the point that are written.
#[derive(Clone, Copy, Debug)]
struct Decimals {
    mm: u8,
    inch: u8,
    degree: u8,
    second: u8,
    speed: u8,
}

/// The work offset that an origin by values is.
const FIRST: u16 = 1;

/// How a text says origins: by the number of a work offset, or by values, never both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Origin {
    Number,
    Values,
}

/// Writes the canonical stream.
pub struct Writer {
    eol: &'static [u8],
    decimals: Decimals,
    /// What the program itself knows.
    at: Tracker,
    /// Where the axes stand before the first statement.
    start: [Option<Nanos>; AXES],
    /// What the text has active; `None` after a setting that may be skipped.
    units: Option<Units>,
    plane: Option<Plane>,
    feed_mode: Option<FeedMode>,
    /// Whether a statement has named a rotary axis: moves then have six arguments.
    six: bool,
    /// Whether a length offset waits for the next Z word.
    offset_waits: bool,
    /// In which form the text says origins.
    origin: Option<Origin>,
    /// The call of an origin by values that counts if the next statement activates the first work offset, and its place.
    waiting: Option<(Vec<u8>, Fault, Span)>,
    begun: bool,
    /// Block numbers left out, and the first place.
    numbers: (u32, Span),
    /// Where the lines come from, if somebody asked.
    pub(crate) trace: Option<Trace>,
}

impl Writer {
    /// A writer. The text has no block numbers, whatever the layout says.
    pub fn new(settings: Settings, layout: Layout) -> Writer {
        let numbers = |quantity| settings.dialect.numbers(quantity);
        let length = numbers(Quantity::Length);
        let decimals = Decimals {
            mm: length.decimals,
            inch: length.decimals_inch.unwrap_or(length.decimals),
            degree: numbers(Quantity::Angle).decimals,
            second: numbers(Quantity::Seconds).decimals,
            speed: numbers(Quantity::Speed).decimals,
        };
        Writer {
            eol: if layout.crlf { b"\r\n" } else { b"\n" },
            decimals,
            at: Tracker::default(),
            start: [None; AXES],
            units: Some(Units::Mm),
            plane: Some(Plane::Xy),
            feed_mode: Some(FeedMode::PerMinute),
            six: false,
            offset_waits: false,
            origin: None,
            waiting: None,
            begun: false,
            numbers: (0, Span::default()),
            trace: None,
        }
    }

    /// Says where the axes stand before the program starts, in its own frame.
    pub fn stand_at(&mut self, start: &[Option<Nanos>; AXES]) {
        self.start = *start;
    }

    /// Writes statements of the main procedure.
    pub fn write(&mut self, stmts: &[Stmt], assumed: &Modes, out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        if !std::mem::replace(&mut self.begun, true) {
            // Where Z is after a tool change, the source knows: it is named before this, or left as it is.
            self.at = Tracker { position: self.start, z_lost_at_change: true, ..Tracker::new(*assumed) };
        }
        for stmt in stmts {
            if let Some(lines) = packed(stmt) {
                each_blocks(lines, |blocks| self.write(blocks, assumed, out, diags));
                continue;
            }
            if let Some(trace) = &mut self.trace {
                trace.enter(std::slice::from_ref(stmt));
            }
            self.stmt(stmt, assumed, out, diags);
            if let Some(trace) = &mut self.trace {
                trace.wrote(out, &[]);
            }
        }
    }

    /// Refuses a subprogram: the canonical stream has none.
    pub fn procedure(&mut self, p: &Procedure, _out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        let place = p.body.first().map_or(Span::default(), |s| s.span);
        diags.push(Diagnostic::new(Fault::lacks(FlowLack::Subprogram), place));
    }

    /// Ends the text.
    pub fn finish(&mut self, _out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        diags.extend(self.waiting.take().map(|(_, fault, span)| Diagnostic::new(fault, span)));
        let (count, place) = self.numbers;
        if count > 0 {
            diags.push(Diagnostic::new(Fault::NumbersLeftOut { count }, place));
        }
    }

    /// Writes what stands before all the rest: comments.
    pub fn head(&self, head: &Head, out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        let mut name = String::new();
        if let Some(number) = head.name.number {
            name = number.to_string();
        }
        if let Some(title) = &head.name.title {
            name.push_str(if name.is_empty() { "" } else { " " });
            name.push_str(title);
        }
        if !name.is_empty() {
            self.comment(&name, out);
            diags.push(Diagnostic::new(Fault::NameAsComment, Span::default()));
        }
        for line in &head.lines {
            self.comment(line, out);
        }
    }

    /// Facts that the text states by its own definition, before it says anything.
    pub fn stated(&self) -> Modes {
        Modes {
            distance: Some(Distance::Absolute),
            units: Some(Units::Mm),
            plane: Some(Plane::Xy),
            feed_mode: Some(FeedMode::PerMinute),
            ..Modes::default()
        }
    }

    fn comment(&self, text: &str, out: &mut Vec<u8>) -> bool {
        out.extend_from_slice(b"COMMENT(");
        let changed = quote(text, out);
        out.extend_from_slice(b")");
        out.extend_from_slice(self.eol);
        changed
    }

    #[inline]
    fn stmt(&mut self, s: &Stmt, assumed: &Modes, out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        if let Some((call, fault, span)) = self.waiting.take() {
            if s.op == Op::SetOriginOffsets(FIRST) && s.skip.is_none() {
                out.extend_from_slice(&call);
                self.origin = Some(Origin::Values);
            } else {
                diags.push(Diagnostic::new(fault, span));
            }
        }
        let line = out.len();
        if let Err((fault, out_of)) = self.call(s, assumed, out, diags) {
            out.truncate(line);
            diags.push(Diagnostic::new(fault, out_of));
        }
        self.at.step(s);
        if s.number.is_some() {
            if self.numbers.0 == 0 {
                self.numbers.1 = s.span;
            }
            self.numbers.0 = self.numbers.0.saturating_add(1);
        }
        if let Some(comment) = &s.comment
            && self.comment(comment, out)
        {
            diags.push(Diagnostic::new(Fault::CommentReformatted, s.span));
        }
    }

    /// Writes the call of a statement, and the settings that it needs first.
    fn call(
        &mut self,
        s: &Stmt,
        assumed: &Modes,
        out: &mut Vec<u8>,
        diags: &mut Vec<Diagnostic>,
    ) -> Result<(), (Fault, Span)> {
        let here = |fault| (fault, s.span);
        match &s.op {
            Op::StraightFeed(m) | Op::StraightTraverse(m) => {
                return self.straight(s, s.op.name(), &m.to, out, diags).map_err(here);
            }
            Op::Position(m) => {
                let name = match self.at.modes.motion {
                    Some(Motion::Traverse) => "STRAIGHT_TRAVERSE",
                    Some(Motion::Feed) => "STRAIGHT_FEED",
                    Some(Motion::Arc(_) | Motion::Cycle) => return Err(here(cannot(&s.op))),
                    None => return Err(here(Fault::EntryFactNeeded { fact: ModeName::Motion })),
                };
                return self.straight(s, name, &m.to, out, diags).map_err(here);
            }
            Op::ArcFeed(arc) => return self.arc(s, arc, out, diags).map_err(here),

            Op::Comment(text) | Op::NoEffect(text) => {
                if self.comment(text, out) {
                    diags.push(Diagnostic::new(Fault::CommentReformatted, s.span));
                }
                return Ok(());
            }
            Op::Lines(_) => return Err(here(Fault::lacks(WordsLack::Packed))),
            Op::Blank => {
                out.extend_from_slice(self.eol);
                return Ok(());
            }
            // Every coordinate is absolute and there are no cycles.
            Op::SetDistanceMode(_) | Op::SetReturnLevel(_) | Op::EndCycle => return Ok(()),

            Op::UseLengthUnits(u) => {
                self.open(s, out);
                out.extend_from_slice(arguments::units(*u));
                after(&mut self.units, *u, s);
            }
            Op::SelectPlane(p) => {
                self.open(s, out);
                out.extend_from_slice(arguments::plane(*p));
                after(&mut self.plane, *p, s);
            }
            Op::SetFeedMode(f) => {
                self.open(s, out);
                out.extend_from_slice(arguments::feed_mode(*f));
                after(&mut self.feed_mode, *f, s);
            }
            Op::SetFeedRate(feed) => {
                self.feed_mode(assumed, out);
                let value = arguments::literal(feed).map_err(here)?;
                self.use_units(value.unit, out);
                self.open(s, out);
                self.value(value, "F", s.span, out, diags).map_err(here)?;
            }
            Op::SetMotionControlMode(control) => self.path_mode(s, control, out, diags).map_err(here)?,
            Op::StartCutterRadiusCompensation {
                side,
                radius: radius @ (CutterRadius::Entry(_) | CutterRadius::Diameter(_)),
            } => self.start_compensation(s, *side, radius, out, diags).map_err(here)?,
            Op::SetSpindleMode(mode) => {
                self.open(s, out);
                out.extend_from_slice(match mode {
                    SpindleMode::Turns => b"CANON_TURNS_PER_MINUTE",
                    SpindleMode::Surface => b"CANON_SURFACE_SPEED",
                });
            }
            Op::OrientSpindle(angle) => {
                let angle = angle.as_ref().map(arguments::literal).transpose().map_err(here)?;
                self.open(s, out);
                if let Some(angle) = angle {
                    self.value(angle, "angle", s.span, out, diags).map_err(here)?;
                }
            }
            Op::SetSpindleSpeed(value) | Op::LimitSpindleSpeed(value) | Op::Dwell(value) => {
                let value = arguments::literal(value).map_err(here)?;
                self.open(s, out);
                self.value(value, s.op.name(), s.span, out, diags).map_err(here)?;
            }
            Op::SelectTool(n) => {
                self.open(s, out);
                write_whole(arguments::count(n, "SELECT_TOOL").map_err(here)?, out);
            }
            Op::UseToolLengthOffset(n) => {
                self.open(s, out);
                write_whole(arguments::count(n, "USE_TOOL_LENGTH_OFFSET").map_err(here)?, out);
                self.offset_waits = true;
            }
            Op::UseToolLength(length) => self.tool_length(s, length, out, diags).map_err(here)?,
            Op::SetData(data) => return self.origin_by_values(s, data, out, diags).map_err(here),
            // The values have called it up.
            Op::SetOriginOffsets(FIRST) if self.origin == Some(Origin::Values) => return Ok(()),
            Op::SetOriginOffsets(n) => {
                if self.origin == Some(Origin::Values) {
                    return Err(here(cannot(&s.op)));
                }
                self.origin = Some(Origin::Number);
                self.open(s, out);
                write_whole(u64::from(*n), out);
            }
            Op::ChangeTool => {
                self.open(s, out);
                // Which tool, for the reader; not known if its selection may have been skipped.
                if let Some(tool) = self.at.selected.and_then(|n| u64::try_from(n).ok()) {
                    write_whole(tool, out);
                }
            }
            Op::Message(text) | Op::MachineFunction(text) | Op::SelectToolByName(text) => {
                self.open(s, out);
                if quote(text, out) {
                    diags.push(Diagnostic::new(Fault::CommentReformatted, s.span));
                }
            }
            Op::ClearFrame(FrameSlot::Shift) => self.begin(s, "CLEAR_ORIGIN_SHIFT", out),
            Op::StopCutterRadiusCompensation
            | Op::ExactStop
            | Op::StartSpindleClockwise
            | Op::StartSpindleCounterclockwise
            | Op::StopSpindleTurning
            | Op::FloodOn
            | Op::MistOn
            | Op::CoolantOff
            | Op::ProgramStop
            | Op::OptionalProgramStop
            | Op::ProgramEnd
            | Op::BeginAgain => self.open(s, out),

            Op::StartCutterRadiusCompensation { .. }
            | Op::Corner { .. }
            | Op::ClearFrame(_)
            | Op::UseToolCentrePoint(_)
            | Op::OrientToolAxis(_)
            | Op::SetFrame(_)
            | Op::Advise(_)
            | Op::SetSlot(_)
            | Op::SetPosition(_)
            | Op::UseOriginShift(_)
            | Op::UseMachineCoordinates { .. }
            | Op::Probe(_)
            | Op::Detour(_)
            | Op::GoToReference(_)
            | Op::UseToolEdge { .. }
            | Op::ArcForm(_)
            | Op::SynchronisedFeed(_)
            | Op::RepeatBlocks(_)
            | Op::StartCycle(_)
            | Op::Hole(_)
            | Op::SetPole(_)
            | Op::Polar(_)
            | Op::TurnRotaryAxes(_)
            | Op::Pattern(_)
            | Op::Call(_)
            | Op::Return
            | Op::MessageOf(_)
            | Op::Output(_)
            | Op::Alarm(_)
            | Op::Assign(..)
            | Op::Declare(_)
            | Op::Leave
            | Op::NextTurn
            | Op::Control(_)
            | Op::Goto(_)
            | Op::Label(_) => return Err(here(cannot(&s.op))),
        }
        self.close(out);
        Ok(())
    }

    /// Skip mark, name and bracket.
    #[inline]
    fn begin(&self, s: &Stmt, name: &str, out: &mut Vec<u8>) {
        match s.skip {
            None => {}
            Some(1) => out.push(b'/'),
            Some(level) => {
                out.push(b'/');
                write_whole(u64::from(level), out);
                out.push(b' ');
            }
        }
        out.extend_from_slice(name.as_bytes());
        out.push(b'(');
    }

    #[inline]
    fn open(&self, s: &Stmt, out: &mut Vec<u8>) {
        self.begin(s, s.op.name(), out);
    }

    #[inline]
    fn close(&self, out: &mut Vec<u8>) {
        out.push(b')');
        out.extend_from_slice(self.eol);
    }

    /// A straight move.
    #[inline]
    fn straight(
        &mut self,
        s: &Stmt,
        name: &str,
        to: &Point,
        out: &mut Vec<u8>,
        diags: &mut Vec<Diagnostic>,
    ) -> Result<(), Fault> {
        self.prepare(to, out);
        self.begin(s, name, out);
        self.axis(Axis::X, to, s, out, diags)?;
        out.extend_from_slice(b", ");
        self.axis(Axis::Y, to, s, out, diags)?;
        out.extend_from_slice(b", ");
        self.axis(Axis::Z, to, s, out, diags)?;
        self.rotary(to, s, out, diags)?;
        self.close(out);
        self.took_up(to, s);
        Ok(())
    }

    /// Rotary axes from now on, and the unit of the move's lengths.
    #[inline]
    fn prepare(&mut self, to: &Point, out: &mut Vec<u8>) {
        let [x, y, z, a, b, c] = &to.axes;
        self.six |= a.is_some() || b.is_some() || c.is_some();
        if let Some(Expr::Num(n)) = x.as_ref().or(y.as_ref()).or(z.as_ref()).map(|coord| &coord.value) {
            self.use_units(n.unit, out);
        }
    }

    #[inline]
    fn rotary(
        &self,
        to: &Point,
        s: &Stmt,
        out: &mut Vec<u8>,
        diags: &mut Vec<Diagnostic>,
    ) -> Result<(), Fault> {
        if self.six {
            for axis in [Axis::A, Axis::B, Axis::C] {
                out.extend_from_slice(b", ");
                self.axis(axis, to, s, out, diags)?;
            }
        }
        Ok(())
    }

    /// A Z word applies the length offset, unless the block may be skipped.
    #[inline]
    fn took_up(&mut self, to: &Point, s: &Stmt) {
        self.offset_waits &= to.get(Axis::Z).is_none() || s.skip.is_some();
    }

    /// An arc: end, centre, rotation, end along the normal, rotary axes.
    fn arc(
        &mut self,
        s: &Stmt,
        arc: &Arc,
        out: &mut Vec<u8>,
        diags: &mut Vec<Diagnostic>,
    ) -> Result<(), Fault> {
        let plane = self.at.plane(arc.plane).ok_or(Fault::EntryFactNeeded { fact: ModeName::Plane })?;
        let (first, second, normal) = plane.axes();
        let turns = arc.turns.count()?;
        self.prepare(&arc.to, out);
        if let Centre::Point { words, .. } = &arc.centre
            && let Some(Expr::Num(n)) = words[first as usize].as_ref().or(words[second as usize].as_ref())
        {
            self.use_units(n.unit, out);
        }
        self.use_plane(plane, out);
        self.open(s, out);
        self.axis(first, &arc.to, s, out, diags)?;
        out.extend_from_slice(b", ");
        self.axis(second, &arc.to, s, out, diags)?;
        out.extend_from_slice(b", ");
        self.centre(s, arc, [first, second], out, diags)?;
        out.extend_from_slice(if arc.turn == Turn::Clockwise { b", -" } else { b", " });
        write_whole(u64::from(turns) + 1, out);
        out.extend_from_slice(b", ");
        self.axis(normal, &arc.to, s, out, diags)?;
        self.rotary(&arc.to, s, out, diags)?;
        self.close(out);
        self.took_up(&arc.to, s);
        Ok(())
    }

    /// The centre, from program zero.
    fn centre(
        &self,
        s: &Stmt,
        arc: &Arc,
        axes: [Axis; 2],
        out: &mut Vec<u8>,
        diags: &mut Vec<Diagnostic>,
    ) -> Result<(), Fault> {
        if let Centre::Point { words, from: CentreFrom::Zero } = &arc.centre
            && let [Some(Expr::Num(i)), Some(Expr::Num(j))] = axes.map(|axis| words[axis as usize].as_ref())
        {
            self.value(*i, "centre", s.span, out, diags)?;
            out.extend_from_slice(b", ");
            return self.value(*j, "centre", s.span, out, diags);
        }
        let centre = arguments::centre(&self.at, arc, axes)?;
        diags.push(Diagnostic::new(Fault::ArcReformatted, s.span));
        for (place, nanos) in centre.into_iter().enumerate() {
            out.extend_from_slice(if place > 0 { b", " } else { b"" });
            let unit = arguments::unit(axes[place], self.units);
            self.computed(nanos, unit, "centre", s.span, out, diags)?;
        }
        Ok(())
    }
}

/// What is active after a setting that may be skipped.
fn after<T: PartialEq>(in_force: &mut Option<T>, value: T, s: &Stmt) {
    let value = Some(value);
    let unsure = s.skip.is_some() && *in_force != value;
    *in_force = if unsure { None } else { value };
}

fn cannot(op: &Op) -> Fault {
    Fault::lacks(WordsLack::Function { function: op.name() })
}
