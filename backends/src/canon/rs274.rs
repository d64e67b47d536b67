//! Prints canonical calls as LinuxCNC's stand-alone interpreter does, without the count and the block number before
//! each call: `G1 X10 F100` gives `SET_FEED_RATE(100.0000)` and `STRAIGHT_FEED(10.0000, …)`.
//!
//! The printer executes the program from program zero, in millimetres, with the given tables. It writes each call at
//! the point where the interpreter makes it. This includes the order of calls in a block, expanded cycles, the
//! interpreter's notes on modes, and its calls before the first and after the last block. The printer follows
//! subprogram calls. Cutter compensation makes no call: the printer writes the tool centre path, with the radius from
//! the program or the tool table.
//!
//! Points are in program coordinates. A change of an offset prints its values. Refused: a tool length that neither
//! the program nor a profile states, and functions without a canonical call.

mod arcs;
mod feeds;
mod holes;
mod moves;
mod notes;
mod offsets;
mod order;
mod switches;

use std::fmt::Write;

use ncc_exec::world::{Tables, World};
use ncc_exec::{Event, Exec};
use ncc_ir::canon::{AXES, Axis, Distance, FeedMode, Modes, PathMode, Plane, ReturnLevel, Units};
use ncc_ir::diag::{Diagnostic, Fault, Gravity};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::geometry::arc_solver::ArcRule;
use ncc_ir::geometry::offset_path::Rules;
use ncc_ir::lack::{CompensationLack, FlowLack, Lack, WordsLack};
use ncc_ir::program::valid::leads_nowhere;
use ncc_ir::program::{Data, FrameSlot, Op, Point, Program, Slot, Stmt, ToolLength};
use ncc_ir::track::Tracker;
use ncc_passes::arcs::expand_compensation;
use ncc_passes::arcs::polar_words;
use ncc_passes::flow::flatten;
use ncc_passes::{Compensating, Target};

use self::order::{overtakes, rank};

/// Distance between the interpreter's position after a probing move and the touch point: 0.01 inch, in nanos of a mm.
pub const BACKS_OFF: Nanos = 254 * ONE / 1000;

/// Highest depth of nested subprogram calls.
const DEPTH: u32 = 10;

/// State of the spindle.
#[derive(Clone, Copy, PartialEq)]
enum Turning {
    Stopped,
    Clockwise,
    Counterclockwise,
}

/// Prints the calls of a program. `source` is its text, for the comments. `tables` has tool lengths and radii by tool
/// number. `arcs` is the interpreter's rule for valid arcs.
///
/// # Errors
/// The interpreter refuses the program, or the program needs a table value or a function that the printer lacks.
pub fn print(program: &Program, source: &[u8], tables: &Tables, arcs: ArcRule) -> Result<String, Diagnostic> {
    let entry = Modes {
        units: Some(Units::Mm),
        plane: Some(Plane::Xy),
        distance: Some(Distance::Absolute),
        feed_mode: Some(FeedMode::PerMinute),
        return_level: Some(ReturnLevel::Retract),
        ..Modes::default()
    };
    if let Some(unknown) = leads_nowhere(program).into_iter().next() {
        return Err(unknown);
    }
    let start = Tracker { position: [Some(0); AXES], ..Tracker::new(entry) };
    let modes = Modes { work_offset: Some(1), no_origin_shift: Some(true), length_offset: Some(0), ..entry };
    let mut world = World::generate(0, &modes);
    world.start = [0; AXES];
    world.tables = tables.clone();
    world.backs_off = BACKS_OFF;
    world.length_by_change = true;
    world.arcs = arcs;
    let mut exec = Exec::new(&world, 0);
    // The interpreter also makes a call for a move without motion.
    exec.every_move();
    let straight = flatten::by(program, &start, exec.clone())?;
    let program = &write_offset_path(straight.as_ref().unwrap_or(program), &start, tables)?;
    let mut printer = Printer {
        exec,
        program,
        source,
        tables,
        arcs,
        out: String::new(),
        at: start,
        beside: false,
        path: PathMode::Continuous,
        within: 0.0,
        merged: 0.0,
        turning: Turning::Stopped,
        mist: false,
        flood: false,
        offset: 1,
        feed: None,
        limit: None,
        probing: false,
        made: Vec::new(),
        ended: false,
    };
    for call in [
        "USE_LENGTH_UNITS(CANON_UNITS_MM)",
        "SET_G5X_OFFSET(1, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)",
        "SET_G92_OFFSET(0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)",
        "SET_XY_ROTATION(0.0000)",
        "SET_FEED_REFERENCE(CANON_XYZ)",
        "ON_RESET()",
    ] {
        printer.call(call);
    }
    if let Some(main) = program.procedures.first() {
        printer.body(&main.body, 0)?;
    }
    if !printer.ended {
        ["FINISH()", "ON_RESET()", "ON_RESET()"].into_iter().for_each(|call| printer.call(call));
    }
    Ok(printer.out)
}

struct Printer<'p> {
    program: &'p Program,
    source: &'p [u8],
    tables: &'p Tables,
    /// The interpreter's rule for valid arcs.
    arcs: ArcRule,
    out: String,
    /// Modes, position and the active cycle.
    at: Tracker,
    /// The executed state, which also has the frames.
    exec: Exec,
    turning: Turning,
    mist: bool,
    flood: bool,
    offset: u16,
    /// Last printed feed.
    feed: Option<f64>,
    /// Spindle speed limit of the current block.
    limit: Option<f64>,
    /// Whether the next feed move is a probing move.
    probing: bool,
    /// Machine events of the current statement.
    made: Vec<Event>,
    /// Whether cutter compensation is active: then the interpreter holds each move until it knows the next one.
    beside: bool,
    /// Path mode. `within` is its tolerance, and `merged` the tolerance for merging moves; both in the unit that was
    /// active at the code.
    path: PathMode,
    within: f64,
    merged: f64,
    ended: bool,
}

/// Replaces polar words by coordinates, and compensated contours by the tool centre path.
fn write_offset_path(program: &Program, start: &Tracker, tables: &Tables) -> Result<Program, Diagnostic> {
    let compensating = Compensating {
        rules: Rules::INTERPRETER,
        known: true,
        radii: tables.radii.clone(),
        listing: true,
        ..Compensating::default()
    };
    let target = Target { decimals: 9, compensating, ..Target::default() };
    let (mut program, mut found) = (program.clone(), Vec::new());
    polar_words::run(&mut program, &target, start, &mut found);
    expand_compensation::run(&mut program, &target, start, &mut found);
    match found.into_iter().find(|d| d.fault.gravity() == Gravity::Error) {
        Some(refused) => Err(refused),
        None => Ok(program),
    }
}

impl Printer<'_> {
    fn call(&mut self, text: &str) {
        self.out.push_str(text);
        self.out.push('\n');
    }

    fn note(&mut self, text: &str) {
        let _ = writeln!(self.out, "COMMENT(\"interpreter: {text}\")");
    }

    fn body(&mut self, stmts: &[Stmt], depth: u32) -> Result<(), Diagnostic> {
        let mut from = 0;
        while from < stmts.len() && !self.ended {
            let mut end = from + 1;
            // Repetitions of a cycle are separate statements with one span; they print as one block.
            let again =
                |a: &Stmt, b: &Stmt| a.span == b.span && matches!((&a.op, &b.op), (Op::Hole(_), Op::Hole(_)));
            while end < stmts.len() && (stmts[end].joined || again(&stmts[end - 1], &stmts[end])) {
                end += 1;
            }
            self.block(&stmts[from..end], depth)?;
            if matches!(stmts[end - 1].op, Op::Return) {
                return Ok(());
            }
            from = end;
        }
        Ok(())
    }

    fn block(&mut self, stmts: &[Stmt], depth: u32) -> Result<(), Diagnostic> {
        let says = stmts.iter().any(|s| matches!(s.op, Op::Message(_)));
        let comment = stmts.first().and_then(|s| last_comment(self.source, s.span.start as usize));
        if let Some(text) = comment.filter(|_| !says) {
            let _ = writeln!(self.out, "COMMENT(\"{}\")", String::from_utf8_lossy(text.trim_ascii_start()));
        }
        self.limit = self.limit_of(stmts)?;
        // The feed of a cycle's block. A cycle that starts again with other words repeats it: print changes only.
        for stmt in stmts {
            if let Op::StartCycle(cycle) = &stmt.op
                && let Some(feed) = &cycle.feed
            {
                let feed = literal(feed).map_err(|fault| Diagnostic::new(fault, stmt.span))?;
                if self.feed != Some(feed) {
                    self.feed(feed);
                }
            }
        }
        // The tool change prints its spindle stop itself.
        let changes = |span| stmts.iter().any(|s| s.span == span && matches!(s.op, Op::ChangeTool));
        let implied = |s: &&Stmt| matches!(s.op, Op::StopSpindleTurning) && changes(s.span);
        let mut ordered: Vec<&Stmt> = stmts.iter().filter(|s| !implied(s)).collect();
        ordered.sort_by_key(|s| rank(&s.op));
        let holes: Vec<&Stmt> = ordered.iter().copied().filter(|s| matches!(s.op, Op::Hole(_))).collect();
        let mut drilled = false;
        for stmt in ordered {
            let refuse = |fault| Diagnostic::new(fault, stmt.span);
            if let Op::Hole(_) = &stmt.op {
                if !std::mem::replace(&mut drilled, true) {
                    self.holes(&holes)?;
                }
                continue;
            }
            if let Op::Call(call) = &stmt.op {
                let found = self.program.procedures.iter().skip(1).find(|p| p.name == call.name);
                let procedure = match found {
                    Some(procedure) if depth < DEPTH && call.arguments.is_empty() => procedure,
                    Some(_) | None => return Err(refuse(cannot(FlowLack::ThisCall))),
                };
                for _ in 0..call.times {
                    self.body(&procedure.body, depth + 1)?;
                }
                continue;
            }
            self.execute(stmt)?;
            self.statement(stmt).map_err(refuse)?;
            self.at.apply(&stmt.op);
            self.stand();
        }
        self.tool_entries(stmts)
    }

    fn statement(&mut self, stmt: &Stmt) -> Result<(), Fault> {
        if self.beside && overtakes(&stmt.op) {
            // The interpreter would print it before the move that it still holds.
            return Err(cannot(CompensationLack::Listed { function: stmt.op.name() }));
        }
        match &stmt.op {
            // `block` prints the comment.
            Op::Comment(_) | Op::Blank | Op::Return | Op::EndCycle | Op::StartCycle(_) | Op::NoEffect(_) => {}
            Op::Lines(lines) => return lines.unpack().try_for_each(|stmt| self.statement(&stmt)),
            // A message to the error output is not a call.
            Op::Message(_) if self.is_printed(stmt) => {}
            Op::Message(text) => {
                let _ = writeln!(self.out, "MESSAGE(\"{text}\")");
            }
            Op::UseLengthUnits(units) => self.call(match units {
                Units::Mm => "USE_LENGTH_UNITS(CANON_UNITS_MM)",
                Units::Inch => "USE_LENGTH_UNITS(CANON_UNITS_INCHES)",
            }),
            Op::SelectPlane(plane) => self.call(match plane {
                Plane::Xy => "SELECT_PLANE(CANON_PLANE_XY)",
                Plane::Zx => "SELECT_PLANE(CANON_PLANE_XZ)",
                Plane::Yz => "SELECT_PLANE(CANON_PLANE_YZ)",
            }),
            Op::SetDistanceMode(distance) if self.at.modes.distance != Some(*distance) => {
                self.note(notes::distance(*distance));
            }
            Op::SetDistanceMode(_) => {}
            Op::SetReturnLevel(level) => self.note(notes::return_level(*level)),
            Op::StartCutterRadiusCompensation { side, .. } => {
                self.beside = true;
                self.note(notes::compensation(*side));
            }
            Op::StopCutterRadiusCompensation => {
                self.beside = false;
                self.note(notes::COMPENSATION_OFF);
            }
            Op::SetFeedMode(mode) => self.feed_mode(*mode)?,
            // Inverse time: each move prints its own feed.
            Op::SetFeedRate(feed) if self.at.modes.feed_mode == Some(FeedMode::InverseTime) => {
                self.feed = Some(literal(feed)?);
            }
            Op::SetFeedRate(feed) => {
                let feed = literal(feed)?;
                self.feed(feed);
            }
            Op::SetSpindleMode(mode) => self.spindle_mode(*mode),
            // The limit is printed with the spindle mode.
            Op::LimitSpindleSpeed(_) => {}
            Op::SetSpindleSpeed(speed) => {
                let _ = writeln!(self.out, "SET_SPINDLE_SPEED(0, {:.4})", literal(speed)?);
            }
            Op::SelectTool(tool) => {
                let _ = writeln!(self.out, "SELECT_TOOL({:.0})", literal(tool)?);
            }
            Op::ChangeTool => {
                self.call("STOP_SPINDLE_TURNING(0)");
                self.turning = Turning::Stopped;
                let _ = writeln!(self.out, "CHANGE_TOOL({})", self.at.selected.unwrap_or(0));
            }
            Op::StartSpindleClockwise => self.turn(Turning::Clockwise),
            Op::StartSpindleCounterclockwise => self.turn(Turning::Counterclockwise),
            Op::StopSpindleTurning => self.turn(Turning::Stopped),
            Op::MistOn => {
                self.mist = true;
                self.call("MIST_ON()");
            }
            Op::FloodOn => {
                self.flood = true;
                self.call("FLOOD_ON()");
            }
            Op::CoolantOff => self.dry(),
            Op::Dwell(seconds) => {
                let _ = writeln!(self.out, "DWELL({:.4})", literal(seconds)?);
            }
            Op::SetOriginOffsets(number) if *number == self.offset => {
                self.note(notes::SAME_OFFSET);
            }
            Op::SetOriginOffsets(number) => {
                self.offset = *number;
                self.work_offset(*number);
                self.origin_shift();
                self.work_turn(*number);
            }
            Op::ClearFrame(FrameSlot::Shift) | Op::UseOriginShift(_) | Op::SetPosition(_) => {
                self.origin_shift()
            }
            Op::SetSlot(slot) if matches!(**slot, Slot::Shift { origin: true, .. }) => self.origin_shift(),
            Op::SetData(data) => match **data {
                Data::Offset { offset, .. } if offset == self.offset => {
                    self.work_offset(offset);
                    self.work_turn(offset);
                }
                Data::Offset { .. } => self.note(notes::OFFSET_SET),
                // `tool_entries` prints the entry at the end of the block; that call has no radius.
                Data::Tool { .. } | Data::Measured { .. } => {}
                // The interpreter stores it without a call.
                Data::Position(_) => {}
                Data::ToolInSpindle(_) => self.tool_in_spindle(),
            },
            Op::UseMachineCoordinates { .. } => {}
            Op::Probe(_) => self.probing = true,
            Op::GoToReference(reference) => self.reference(reference)?,
            Op::SynchronisedFeed(thread) => self.thread(thread)?,
            Op::Position(_) => self.position()?,
            Op::Advise(advice) => self.switch(advice)?,
            Op::OrientSpindle(angle) => self.orient(angle.as_ref(), stmt)?,
            Op::UseToolLengthOffset(entry) => self.tool_offsets(entry)?,
            Op::UseToolEdge { .. } => {
                let entry = self
                    .exec
                    .length_entry()
                    .ok_or_else(|| cannot(WordsLack::Function { function: stmt.op.name() }))?;
                self.tool_offsets(&Expr::int(i64::from(entry)))?;
            }
            Op::UseToolLength(length) => match &**length {
                ToolLength::AddedEntry(entry) => self.tool_offsets(entry)?,
                ToolLength::Value(_) | ToolLength::Added(_) | ToolLength::Offsets { .. } => {
                    self.tool_offsets(&Expr::int(0))?;
                }
            },
            Op::StraightTraverse(_) => self.straight("STRAIGHT_TRAVERSE", self.exec.position()),
            Op::StraightFeed(_) if std::mem::take(&mut self.probing) => self.probe()?,
            Op::StraightFeed(_) => {
                self.rate_of_line()?;
                self.straight("STRAIGHT_FEED", self.exec.position());
            }
            Op::ArcFeed(arc) => self.arc(arc)?,
            Op::SetMotionControlMode(control) => {
                self.path = control.mode;
                self.within = match &control.within {
                    // In the unit that is active here.
                    Some(within) => literal(within)?,
                    None => 0.0,
                };
                self.merged = control.merged.as_ref().map_or(Ok(self.within), literal)?;
                self.path_control();
            }
            Op::ProgramStop => {
                let code = self.source.get(stmt.span.start as usize..stmt.span.end as usize);
                if code.is_some_and(|code| code.eq_ignore_ascii_case(b"M60")) {
                    self.call("PALLET_SHUTTLE()");
                }
                self.call("PROGRAM_STOP()");
            }
            Op::OptionalProgramStop => self.call("OPTIONAL_PROGRAM_STOP()"),
            Op::BeginAgain => return Err(cannot(FlowLack::ProgramBeginsAgain)),
            Op::ProgramEnd => {
                let code = self.source.get(stmt.span.start as usize..stmt.span.end as usize);
                self.end(code.is_some_and(|code| code.eq_ignore_ascii_case(b"M30")));
            }
            Op::SetFrame(_)
            | Op::SetSlot(_)
            | Op::ClearFrame(_)
            | Op::Detour(_)
            | Op::UseToolCentrePoint(_)
            | Op::OrientToolAxis(_)
            | Op::ExactStop
            | Op::TurnRotaryAxes(_)
            | Op::Corner { .. }
            | Op::SelectToolByName(_)
            | Op::MachineFunction(_)
            | Op::SetPole(_)
            | Op::ArcForm(_)
            | Op::Hole(_)
            | Op::Polar(_)
            | Op::Pattern(_)
            | Op::Call(_)
            | Op::RepeatBlocks(_)
            | Op::MessageOf(_)
            | Op::Output(_)
            | Op::Alarm(_)
            | Op::Assign(..)
            | Op::Declare(_)
            | Op::Leave
            | Op::NextTurn
            | Op::Control(_)
            | Op::Goto(_)
            | Op::Label(_) => return Err(cannot(WordsLack::Function { function: stmt.op.name() })),
        }
        Ok(())
    }

    /// Whether a message goes to the error output: its comment starts with `PRINT,`.
    fn is_printed(&self, stmt: &Stmt) -> bool {
        let text = self.source.get(stmt.span.start as usize..).unwrap_or_default().trim_ascii_start();
        text.get(..6).is_some_and(|word| word.eq_ignore_ascii_case(b"PRINT,"))
    }

    /// Prints the path mode; for path blending also the tolerance for merging moves.
    fn path_control(&mut self) {
        match self.path {
            PathMode::ExactPath => self.call("SET_MOTION_CONTROL_MODE(CANON_EXACT_PATH)"),
            PathMode::ExactStop => self.call("SET_MOTION_CONTROL_MODE(CANON_EXACT_STOP)"),
            _ => {
                let within = self.within;
                let _ = writeln!(self.out, "SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, {within:.6})");
            }
        }
        if self.path != PathMode::ExactPath && self.path != PathMode::ExactStop {
            let _ = writeln!(self.out, "SET_NAIVECAM_TOLERANCE({:.4})", self.merged);
        }
    }

    fn turn(&mut self, turning: Turning) {
        self.turning = turning;
        self.call(match turning {
            Turning::Stopped => "STOP_SPINDLE_TURNING(0)",
            Turning::Clockwise => "START_SPINDLE_CLOCKWISE(0)",
            Turning::Counterclockwise => "START_SPINDLE_COUNTERCLOCKWISE(0)",
        });
    }

    fn dry(&mut self) {
        if std::mem::take(&mut self.mist) {
            self.call("MIST_OFF()");
        }
        if std::mem::take(&mut self.flood) {
            self.call("FLOOD_OFF()");
        }
    }

    /// Prints the calls of the program end; `pallets` (M30) adds the pallet change.
    fn end(&mut self, pallets: bool) {
        self.work_offset(1);
        self.work_turn(1);
        if self.at.modes.plane != Some(Plane::Xy) {
            self.call("SELECT_PLANE(CANON_PLANE_XY)");
        }
        for call in [
            "SET_FEED_MODE(0, 0)",
            "SET_FEED_RATE(0.0000)",
            "STOP_SPINDLE_TURNING(0)",
            "SET_SPINDLE_MODE(0 0.0000)",
        ] {
            self.call(call);
        }
        self.dry();
        if pallets {
            self.call("PALLET_SHUTTLE()");
        }
        ["PROGRAM_END()", "ON_RESET()", "ON_RESET()"].into_iter().for_each(|call| self.call(call));
        self.ended = true;
    }

    /// End point of a move, in nanos. Fails if the position of an axis is unknown.
    fn target(&self, to: &Point) -> Result<[Nanos; AXES], Fault> {
        let target = self.at.target(to);
        let mut known = [0; AXES];
        for (axis, (to, place)) in Axis::ALL.into_iter().zip(known.iter_mut().zip(target)) {
            *to = place.ok_or(Fault::PositionUnknown { axis: char::from(axis.letter()) })?;
        }
        Ok(known)
    }

    fn here(&self) -> Result<[Nanos; AXES], Fault> {
        self.target(&Point::default())
    }

    /// A coordinate as printed: axes 0 to 2 in the active unit, others in degrees.
    fn shown(&self, axis: usize, nanos: Nanos) -> f64 {
        let unit = if axis < 3 && self.inch() { 25.4 } else { 1.0 };
        nanos as f64 / ONE as f64 / unit
    }

    fn inch(&self) -> bool {
        self.at.modes.units == Some(Units::Inch)
    }

    fn straight(&mut self, name: &str, to: [Nanos; AXES]) {
        let [x, y, z, a, b, c]: [f64; AXES] = std::array::from_fn(|axis| self.shown(axis, to[axis]));
        let _ = writeln!(self.out, "{name}({x:.4}, {y:.4}, {z:.4}, {a:.4}, {b:.4}, {c:.4})");
    }
}

/// The last comment in brackets of the line at byte `at`. Text after a semicolon does not count. A block that starts
/// with the letter O gives `None`.
fn last_comment(source: &[u8], at: usize) -> Option<&[u8]> {
    let start = source.get(..at)?.iter().rposition(|b| *b == b'\n').map_or(0, |at| at + 1);
    let line = source[start..].split(|b| *b == b'\n').next()?;
    if line.trim_ascii_start().first().is_some_and(|b| b.eq_ignore_ascii_case(&b'O')) {
        return None;
    }
    let mut last = None;
    let mut rest = line;
    while let Some(open) = rest.iter().position(|b| matches!(b, b'(' | b';')) {
        if rest[open] == b';' {
            break;
        }
        let close = rest[open..].iter().position(|b| *b == b')')? + open;
        last = Some(&rest[open + 1..close]);
        rest = &rest[close + 1..];
    }
    last
}

fn literal(value: &Expr) -> Result<f64, Fault> {
    let n = value.literal().ok_or_else(|| cannot(WordsLack::Expression))?;
    Ok(n.mantissa as f64 / 10f64.powi(i32::from(n.scale)))
}

fn cannot(lack: impl Into<Lack>) -> Fault {
    Fault::lacks(lack)
}
