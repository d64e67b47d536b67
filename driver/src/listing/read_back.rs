//! A listing of calls read back: what the machine does by it, held against what it does by the program.
//!
//! The listing's numbers are those of a control whose tables are zero at first and which stands at zero, so the program
//! is executed so too. What it puts into its own tables of offsets is found by the calls that take them up, and where
//! the moves behind them lead. How corners are taken is not compared: the interpreter's own cycles set it for their
//! moves, which no other control's do.
//!
//! Where a probe touches no program says: the interpreter takes it to do so at the end of its way, and stands a little
//! before that. Feeds that the program says by the time of a move are printed, and compared, as those of its way.
//!
//! Not here: how calls are printed. Nothing is shared with the printer but the form that
//! `docs/book/src/reference/rs274-listing.md` and the interpreter itself define.

use ncc_dialects::{BREAK_LIFT, PECK_CLEARANCE};
use ncc_exec::verify::{Comparison, Resolution};
use ncc_exec::world::{Tables, World};
use ncc_exec::{Coolant, Event, Exec, Kind, Progress, Runner, Seen, State, Stored};
use ncc_ir::canon::{AXES, Axis, FeedMode, Modes, Plane, Spindle, SpindleMode, Turn};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::program::{Op, Probe, Program, Stmt};
use ncc_ir::source::Span;

use super::by_time;
use crate::job::Job;
use crate::job::parameters::parameter;
use crate::render::events;
use crate::render::messages::message::{Message, Part};
use crate::render::text::plain;

/// The table of tools of the source's machine: lengths and radii that its profile states, and no offsets beside them.
pub fn tables(job: &Job) -> Tables {
    let stated = job.machines.from.as_ref().map(|machine| machine.tables()).unwrap_or_default();
    let offsets = stated.lengths.keys().map(|entry| (*entry, [0; 2])).collect();
    Tables { lengths: stated.lengths, radii: stated.radii, offsets, ..Tables::default() }
}

/// Digits after the point of every number but whole ones.
const DIGITS: u8 = 4;

/// How far a probe stands before where it has touched, in millimetres.
const BACKS_OFF: Nanos = 254 * ONE / 1000;

/// What a probe looks for leaves no trace in a listing.
const PROBE: Probe = Probe { away: false, error: true };

/// Executes a program and reads its listing back; the first difference, if there is one.
///
/// # Errors
/// The listing is not that of the program, or no listing; or the program cannot be executed.
pub fn verify(job: &Job, program: &Program, text: &[u8], listing: &str) -> Result<(), Diagnostic> {
    let mut source = executed(job, program)?;
    // What goes to the error output is no call.
    source.retain(|event| !matches!(event.kind, Kind::Message(_)) || !is_printed(text, event.span));
    let last = source.last().map_or(Span::default(), |event| event.span);
    let differs = |what: String, at: Span| Diagnostic::new(Fault::NotTheSame { difference: what.into() }, at);
    let read = match Listed::default().events(listing) {
        Ok(events) => events,
        Err(line) => {
            let difference = Message::part(Part::Difference, "no-call").text("line", plain(&line));
            return Err(differs(difference.headline(), last));
        }
    };
    let resolution = Resolution {
        mm: DIGITS,
        inch: DIGITS,
        degree: DIGITS,
        feed: DIGITS,
        feed_inch: DIGITS,
        second: DIGITS,
        speed: DIGITS,
    };
    let mut comparison = Comparison::new(resolution, [0; AXES]);
    comparison.see(Seen { modes: 0, in_rapids: false, merges: false, path: false, advice: 0 });
    let mut rest = read.into_iter().peekable();
    let mut piece = Vec::new();
    loop {
        let within = rest.peek().map_or(0, |(_, within)| *within);
        comparison.measure(within);
        piece.extend(std::iter::from_fn(|| Some(rest.next_if(|(_, own)| *own == within)?.0)));
        let over = rest.peek().is_none();
        comparison.advance(&mut source, &mut piece, over).map_err(|found| {
            let at = found.source.as_ref().map_or(last, |event| event.span);
            differs(events::describe(&found), at)
        })?;
        if over {
            return Ok(());
        }
    }
}

/// The events of a program on a control with its machine's table of tools and no other, from zero.
fn executed(job: &Job, program: &Program) -> Result<Vec<Event>, Diagnostic> {
    let mut world = World::generate(0, &Modes { work_offset: Some(1), ..program.assumed });
    world.start = [0; AXES];
    world.tables = tables(job);
    world.backs_off = BACKS_OFF;
    world.length_by_change = true;
    world.feed_ends_with_mode = job.from.dialect.can.feed_ends_with_mode;
    world.cycles_need_spindle = job.from.dialect.can.cycles_need_spindle;
    world.compensation_again = job.from.dialect.caps.compensation.again;
    world.arcs = job.from.arc_rule();
    world.behaviours = job.source_behaviours();
    world.refused_compensated = job.from.dialect.caps.compensation.refused;
    let nanos = |option| parameter(job, option).and_then(|n| n.nanos(false)).unwrap_or(0);
    (world.peck_clearance, world.break_lift) = (nanos(PECK_CLEARANCE), nanos(BREAK_LIFT));
    let mut exec = Exec::new(&world, 0);
    let is_start = |stmt: &Stmt| matches!(stmt.op, Op::StartCutterRadiusCompensation { .. });
    if program.procedures.iter().any(|procedure| procedure.body.iter().any(is_start)) {
        exec.compute_compensation(job.compensating().rules);
    }
    let (mut runner, mut events) = (Runner::new(program), Vec::new());
    while runner.run(&mut exec, usize::MAX, &mut events)? == Progress::More {}
    exec.end_of_text(&mut events);
    by_time::as_feeds(&mut events);
    for event in &mut events {
        if let Kind::Probe { probe, .. } = &mut event.kind {
            *probe = PROBE;
        }
    }
    let has_call = |kind: &Kind| match kind {
        Kind::Data(stored) => matches!(**stored, Stored::Tool(_)),
        // Taps and bores have one without that.
        Kind::Dwell(seconds) => *seconds != 0,
        _ => true,
    };
    events.retain(|event| has_call(&event.kind));
    Ok(events)
}

/// What the calls have stated so far.
#[derive(Default)]
struct Listed {
    state: State,
    at: [Nanos; AXES],
    inch: bool,
    plane: Option<Plane>,
    /// Feed active, nanos of a millimetre a minute.
    feed: Nanos,
    /// Whether feeds are those of a tap, which the spindle's speed goes with.
    tapping: bool,
    /// How far a spindle-synchronised move goes in a turn, while there is one.
    pitch: Option<Nanos>,
    /// Whether the line before stopped the spindle for a tool change.
    stopped: bool,
    /// Zero of the active work offset, by how many degrees it is turned, and the shift within it.
    offset: [Nanos; AXES],
    turn: Nanos,
    shift: [Nanos; AXES],
    /// Offsets of the active tool.
    tool: [Nanos; 3],
    /// Each with how far rounding moves it along the machine's axes, nanos of a millimetre, where that is more than half the least increment:
    /// where an offset is turned, by half a unit along each of the turned axes, so by at most its
    /// square root of two times along one of the machine's.
    events: Vec<(Event, Nanos)>,
}

impl Listed {
    /// The events of a listing.
    ///
    /// # Errors
    /// A line that is no call of one.
    fn events(mut self, listing: &str) -> Result<Vec<(Event, Nanos)>, String> {
        let lines: Vec<&str> = listing.lines().collect();
        let end = lines.iter().rposition(|line| *line == "PROGRAM_END()");
        // What belongs to the end begins where the first work offset is taken again.
        let tail = end.and_then(|end| lines[..end].iter().rposition(|l| l.starts_with("SET_G5X_OFFSET(1,")));
        for (at, line) in lines.iter().enumerate() {
            if Some(at) == tail {
                self.switched_off_at_end(&lines[at..end.unwrap_or(at)]);
                self.event(Kind::ProgramEnd, 0);
                break;
            }
            self.line(line, &lines[at + 1..]).ok_or_else(|| (*line).to_owned())?;
        }
        Ok(self.events)
    }

    /// The interpreter's end stops the spindle and switches coolant off, each by a line of its own.
    fn switched_off_at_end(&mut self, lines: &[&str]) {
        for line in lines {
            match line.split_once('(').map(|(name, _)| name) {
                Some("STOP_SPINDLE_TURNING") => self.state.spindle = Spindle::Stopped,
                Some("FLOOD_OFF") => self.state.flood = false,
                Some("MIST_OFF") => self.state.mist = false,
                _ => {}
            }
        }
    }

    fn event(&mut self, kind: Kind, rate: Nanos) {
        let (end, state, inch) = (self.at, self.state, self.inch);
        let half = ONE / Nanos::pow(10, u32::from(DIGITS)) / 2;
        let half = if inch { half * 254 / 10 } else { half };
        let aside = if self.turn == 0 { 0 } else { half * 1_415 / 1_000 };
        self.events.push((Event { kind, end, rate, state, inch, span: Span::default() }, aside));
    }

    fn line(&mut self, line: &str, behind: &[&str]) -> Option<()> {
        let next = behind.first().copied();
        let (name, rest) = line.split_once('(')?;
        let inside = rest.strip_suffix(')')?;
        let stopped = std::mem::take(&mut self.stopped);
        match name {
            "COMMENT"
            | "ON_RESET"
            | "SET_FEED_REFERENCE"
            | "SET_NAIVECAM_TOLERANCE"
            | "SET_MOTION_CONTROL_MODE" => {}
            // What stands in the table shows where it is activated.
            "SET_TOOL_TABLE_ENTRY" => {}
            "USE_TOOL_LENGTH_OFFSET" => {
                let mut numbers = inside.split([',', ' ']).filter(|n| !n.is_empty());
                for axis in 0..3 {
                    self.tool[axis] = self.length(numbers.next()?)?;
                }
                numbers.all(|n| number(n) == Some(0)).then_some(())?;
            }
            "SET_G5X_OFFSET" => self.offset = self.values(inside.split_once(", ")?.1)?,
            "SET_G92_OFFSET" => self.shift = self.values(inside)?,
            "SET_XY_ROTATION" => self.turn = number(inside)?,
            "MESSAGE" => self.event(Kind::Message(inside.strip_prefix('"')?.strip_suffix('"')?.into()), 0),
            "USE_LENGTH_UNITS" => self.inch = inside == "CANON_UNITS_INCHES",
            "SELECT_PLANE" => {
                let plane = match inside {
                    "CANON_PLANE_XY" => Plane::Xy,
                    "CANON_PLANE_XZ" => Plane::Zx,
                    "CANON_PLANE_YZ" => Plane::Yz,
                    _ => return None,
                };
                self.plane = Some(plane);
            }
            "SET_FEED_MODE" => {
                self.state.feed_mode = match inside {
                    "0, 0" => FeedMode::PerMinute,
                    "0, 1" => FeedMode::PerRevolution,
                    _ => return None,
                };
            }
            "SET_FEED_RATE" => self.feed = self.length(inside)?,
            "SET_SPINDLE_SPEED" => self.speed(inside.strip_prefix("0, ")?)?,
            "SET_SPINDLE_MODE" => self.spindle_mode(inside.strip_prefix("0 ")?)?,
            "ORIENT_SPINDLE" => {
                let angle = inside.strip_prefix("0, ")?.strip_suffix(", 0")?;
                self.state.spindle = Spindle::Stopped;
                self.event(Kind::Orient(number(angle)?), 0);
            }
            "SPINDLE.0.WAIT_ORIENT_COMPLETE" => {}
            "START_SPINDLE_CLOCKWISE" => self.state.spindle = Spindle::Clockwise,
            "START_SPINDLE_COUNTERCLOCKWISE" => self.state.spindle = Spindle::Counterclockwise,
            "STOP_SPINDLE_TURNING" => {
                self.state.spindle = Spindle::Stopped;
                self.stopped = next.is_some_and(|next| next.starts_with("CHANGE_TOOL("));
            }
            // The exchange of pallets belongs to the stop, or the end, behind it.
            "SELECT_TOOL" | "PALLET_SHUTTLE" => {}
            "CHANGE_TOOL" => {
                // The interpreter stops the spindle for the change, which is a line of its own.
                stopped.then_some(())?;
                self.state.tool = inside.parse().ok()?;
                self.event(Kind::ToolChange, 0);
            }
            "FLOOD_ON" => self.coolant(Coolant { flood: true, ..self.state.coolant() }, false),
            "MIST_ON" => self.coolant(Coolant { mist: true, ..self.state.coolant() }, false),
            // One word switches both off.
            "MIST_OFF" => {
                let on = Coolant { mist: false, ..self.state.coolant() };
                self.coolant(on, next == Some("FLOOD_OFF()"));
            }
            "FLOOD_OFF" => self.coolant(Coolant { flood: false, ..self.state.coolant() }, false),
            // A tap or a bore without a dwell has one of no seconds.
            "DWELL" if number(inside) == Some(0) => {}
            "DWELL" => self.event(Kind::Dwell(number(inside)?), 0),
            "DISABLE_FEED_OVERRIDE" => self.tapping = is_tap(behind),
            "ENABLE_FEED_OVERRIDE" => self.tapping = false,
            "DISABLE_SPEED_OVERRIDE" | "ENABLE_SPEED_OVERRIDE" => {}
            "DISABLE_FEED_HOLD" | "ENABLE_FEED_HOLD" => {}
            "CHANGE_TOOL_NUMBER" => {
                let tool: u32 = inside.parse().ok()?;
                self.state.tool = i64::from(tool);
                self.event(Kind::Data(Box::new(Stored::Tool(tool))), 0);
            }
            "START_SPEED_FEED_SYNC" => self.pitch = Some(self.length(inside.strip_suffix(",0")?)?),
            "STOP_SPEED_FEED_SYNCH" => self.pitch = None,
            "RIGID_TAP" => self.rigid_tap(&inside.split(", ").collect::<Vec<_>>())?,
            "TURN_PROBE_ON" => next?.starts_with("STRAIGHT_PROBE(").then_some(())?,
            "TURN_PROBE_OFF" => {}
            "STRAIGHT_PROBE" => self.probe(&inside.split(", ").collect::<Vec<_>>())?,
            "STRAIGHT_TRAVERSE" => {
                self.at = self.point(&inside.split(", ").collect::<Vec<_>>())?;
                self.event(Kind::Traverse, 0);
            }
            "STRAIGHT_FEED" => {
                self.at = self.point(&inside.split(", ").collect::<Vec<_>>())?;
                let kind = match (self.tapping, self.pitch) {
                    (false, None) => Kind::Feed,
                    (true, None) => Kind::Synchronised { pitch: self.of_a_turn()?, chuck: true },
                    (_, Some(pitch)) => Kind::Synchronised { pitch, chuck: false },
                };
                self.event(kind, self.feed);
            }
            "ARC_FEED" => self.arc(&inside.split(", ").collect::<Vec<_>>())?,
            "PROGRAM_STOP" => self.event(Kind::ProgramStop, 0),
            "OPTIONAL_PROGRAM_STOP" => self.event(Kind::OptionalProgramStop, 0),
            "FINISH" => self.event(Kind::TextEnd, 0),
            _ => return None,
        }
        Some(())
    }

    /// Switches coolant; where the next call switches the rest, that makes the event, and there is none where it is so
    /// already.
    fn coolant(&mut self, on: Coolant, more: bool) {
        let before = self.state.coolant();
        (self.state.flood, self.state.mist) = (on.flood, on.mist);
        if !more && before != on {
            self.event(Kind::Coolant, 0);
        }
    }

    /// A speed of the spindle; that of a surface is stated in ft/min where lengths are inches.
    fn speed(&mut self, text: &str) -> Option<()> {
        let said = number(text)?;
        let feet = self.state.spindle_mode == SpindleMode::Surface && self.inch;
        self.state.speed = if feet { (said * 3048 + 5000) / 10_000 } else { said };
        Some(())
    }

    /// What the speed counts; with a surface speed goes a limit, and the radius is measured from program zero.
    fn spindle_mode(&mut self, text: &str) -> Option<()> {
        if text == "0.0000" {
            self.state.spindle_mode = SpindleMode::Turns;
            return Some(());
        }
        let most: f64 = text.parse().ok()?;
        self.state.limit = if most < 1e9 { (most * 1000.0).round() as u32 } else { u32::MAX };
        self.state.spindle_mode = SpindleMode::Surface;
        self.state.centre = self.placed([0; AXES])[0];
        Some(())
    }

    /// In and out again synchronised with the spindle, which turns the other way for the way out.
    fn rigid_tap(&mut self, words: &[&str]) -> Option<()> {
        let [x, y, z] = words else { return None };
        let pitch = self.pitch?;
        let began = self.at;
        let to = self.placed([self.length(x)?, self.length(y)?, self.length(z)?, 0, 0, 0]);
        self.at[..3].copy_from_slice(&to[..3]);
        self.event(Kind::Synchronised { pitch, chuck: false }, self.feed);
        let turned = self.state.spindle;
        self.state.spindle = match turned {
            Spindle::Counterclockwise => Spindle::Clockwise,
            Spindle::Clockwise | Spindle::Stopped => Spindle::Counterclockwise,
        };
        self.at = began;
        self.event(Kind::Synchronised { pitch, chuck: false }, self.feed);
        self.state.spindle = turned;
        Some(())
    }

    /// A probe's way, to the end of it and back a little.
    fn probe(&mut self, words: &[&str]) -> Option<()> {
        let (from, to) = (self.at, self.point(words)?);
        let way: [f64; 3] = std::array::from_fn(|axis| (to[axis] - from[axis]) as f64);
        let long = way.iter().map(|n| n * n).sum::<f64>().sqrt();
        self.at = to;
        for axis in (0..3).filter(|_| long > 0.0) {
            self.at[axis] -= (way[axis] / long * BACKS_OFF as f64).round() as Nanos;
        }
        self.event(Kind::Probe { to: Box::new(to), probe: PROBE }, self.feed);
        Some(())
    }

    fn length(&self, text: &str) -> Option<Nanos> {
        let n = number(text)?;
        Some(if self.inch { n / 10 * 254 } else { n })
    }

    /// A point of the program's coordinates, in those of the machine.
    fn point(&self, words: &[&str]) -> Option<[Nanos; AXES]> {
        Some(self.placed(self.words(words)?))
    }

    fn values(&self, text: &str) -> Option<[Nanos; AXES]> {
        self.words(&text.split(", ").collect::<Vec<_>>())
    }

    fn placed(&self, point: [Nanos; AXES]) -> [Nanos; AXES] {
        let mut at: [Nanos; AXES] = std::array::from_fn(|axis| point[axis] + self.shift[axis]);
        if self.turn != 0 {
            let (sin, cos) = (self.turn as f64 / ONE as f64).to_radians().sin_cos();
            let [x, y] = [at[0] as f64, at[1] as f64];
            at[0] = (x * cos - y * sin).round() as Nanos;
            at[1] = (x * sin + y * cos).round() as Nanos;
        }
        std::array::from_fn(|axis| at[axis] + self.offset[axis] + self.tool.get(axis).unwrap_or(&0))
    }

    fn words(&self, words: &[&str]) -> Option<[Nanos; AXES]> {
        let mut point = [0; AXES];
        for axis in Axis::ALL {
            let word = words.get(axis as usize)?;
            point[axis as usize] = if axis.is_rotary() { number(word)? } else { self.length(word)? };
        }
        (words.len() == AXES).then_some(point)
    }

    /// How far the active feed goes in a turn of the spindle.
    fn of_a_turn(&self) -> Option<Nanos> {
        let turn = i128::from(self.feed) * i128::from(ONE) / i128::from(self.state.speed).max(1);
        Nanos::try_from(turn).ok()
    }

    fn arc(&mut self, words: &[&str]) -> Option<()> {
        let [e1, e2, c1, c2, turns, normal, a, b, c] = words else { return None };
        let plane = self.plane.unwrap_or(Plane::Xy);
        let (first, second, third) = plane.axes();
        let mut end = [0; AXES];
        for (axis, word) in [(first, e1), (second, e2), (third, normal)] {
            end[axis as usize] = self.length(word)?;
        }
        for (axis, word) in [(Axis::A, a), (Axis::B, b), (Axis::C, c)] {
            end[axis as usize] = number(word)?;
        }
        // Turned about Z, only an arc about Z is one of the machine's planes.
        (plane == Plane::Xy || self.turn == 0).then_some(())?;
        let mut middle = end;
        (middle[first as usize], middle[second as usize]) = (self.length(c1)?, self.length(c2)?);
        let (end, middle) = (self.placed(end), self.placed(middle));
        let turns: i64 = turns.parse().ok().filter(|turns| *turns != 0)?;
        let turn = if turns > 0 { Turn::Counterclockwise } else { Turn::Clockwise };
        let from = self.at;
        let (f, s) = (first as usize, second as usize);
        let centre = [middle[f], middle[s]];
        let closed = from[f] == end[f] && from[s] == end[s];
        let angle = |p: &[Nanos; AXES]| ((p[s] - centre[1]) as f64).atan2((p[f] - centre[0]) as f64);
        let whole = std::f64::consts::TAU;
        let ahead = (angle(&end) - angle(&from)) * turns.signum() as f64;
        let part = if closed { whole } else { ahead.rem_euclid(whole) };
        let sweep = part + whole * (turns.abs() - 1) as f64;
        // Each whole turn is a move of its own, the other axes going with the angle.
        for k in 1..turns.abs() {
            let share = whole * k as f64 / sweep;
            for axis in 0..AXES {
                self.at[axis] = from[axis] + ((end[axis] - from[axis]) as f64 * share).round() as Nanos;
            }
            (self.at[f], self.at[s]) = (from[f], from[s]);
            self.event(Kind::Arc { plane, turn, full: true, centre }, self.feed);
        }
        self.at = end;
        self.event(Kind::Arc { plane, turn, full: closed, centre }, self.feed);
        Some(())
    }
}

/// Whether a message is one that is printed.
fn is_printed(text: &[u8], span: Span) -> bool {
    let comment = text.get(span.start as usize..).unwrap_or_default().trim_ascii_start();
    comment.get(..6).is_some_and(|word| word.eq_ignore_ascii_case(b"PRINT,"))
}

/// Whether what follows a locked override is a tap: down, the spindle turned round, and up.
fn is_tap(behind: &[&str]) -> bool {
    let down = ["DISABLE_SPEED_OVERRIDE", "STRAIGHT_FEED", "STOP_SPINDLE_TURNING", "START_SPINDLE"];
    behind.len() > down.len() && behind.iter().zip(down).all(|(line, name)| line.starts_with(name))
}

/// A number with at most nine digits after the point, in billionths.
fn number(text: &str) -> Option<Nanos> {
    let (minus, text) = text.strip_prefix('-').map_or((false, text), |rest| (true, rest));
    let (whole, part) = text.split_once('.').unwrap_or((text, ""));
    if whole.is_empty() || part.len() > 9 || !whole.bytes().chain(part.bytes()).all(|b| b.is_ascii_digit()) {
        return None;
    }
    let n: Nanos = format!("{whole}{part:0<9}").parse().ok()?;
    Some(if minus { -n } else { n })
}

#[cfg(test)]
mod tests;
