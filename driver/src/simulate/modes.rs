//! The modes of a program as columns of changes, in the words of its own dialect: what is active in each block, and at each
//! move.
//!
//! The first line is JSON: `modes` (names of [`MODES`]), `texts` (words; a change names one by its place, from 1, and 0 is
//! not known), `columns` as of [`columns`](super::columns). Lengths are mm, angles degrees, times seconds.
//!
//! | columns | what they are |
//! |---|---|
//! | `change_mode`, `change_text`, `change_move` | a mode, its words, and the first move that it is active in, from 1 |
//! | `line`, `line_changes` | a line, and how many changes hold after it and what follows, up to the next row, plus one; 0 where nothing is executed. A line that is passed several times has its first pass |
//! | `shift_move`, `shift_known` | from this move on; bits of X, Y, Z where it is stated what leads to the machine |
//! | `shift_x` … `shift_z`, `offset_x` … `offset_z` | added to a place of the part: one of the machine; one of the active work offset |
//! | `turn_move`, `turn_a` … `turn_c` | where rotary axes stand behind a move; none where none moves |
//! | `spindle_from`, `spindle_to`, `spindle_before`, `spindle_after` | from when until when the spindle runs up or down, between which rev/min; the same moment where its machine states no time for it |

use std::collections::HashMap;
use std::io::{self, Write};

use ncc_dialects::{Dialect, Meaning, NameMeaning, Role};
use ncc_exec::{Attribute, Kind};
use ncc_ir::canon::{Motion, Spindle, SpindleMode, Turn, Units};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_time::{Model, Timed};
use serde_json::Map;

use super::columns::{bytes, table};
use super::path::{Path, Recorder};
use crate::problem::BrokenOff;
use crate::render::spelled;
use crate::review::words::number;
use crate::time::drive::{Plan, Said, Sink};
use crate::time::modes::{Active, Followed, Length};

/// The modes that are followed.
pub const MODES: [&str; 14] = [
    "motion",
    "plane",
    "distance",
    "feed-mode",
    "units",
    "compensation",
    "work-offset",
    "return-level",
    "spindle",
    "coolant",
    "length-offset",
    "feed",
    "speed",
    "tool",
];

/// What leads from a place of the part to one of the machine and to one of the active work offset.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Shift {
    /// Nanos that the tool adds.
    tool: [Nanos; 3],
    offset: u16,
    known: [bool; 3],
}

/// A run of the spindle to another speed.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Run {
    /// Seconds.
    times: [f64; 2],
    /// rev/min
    speeds: [f64; 2],
}

/// Takes the moves of a program, and its modes beside them.
#[allow(missing_debug_implementations)] // A plan has none.
pub struct Watched<'t> {
    recorder: Recorder<'t>,
    /// Moves at most.
    most: usize,
    plan: &'t Plan<'t>,
    texts: Vec<String>,
    places: HashMap<String, u32>,
    last: Active,
    now: [u32; MODES.len()],
    /// Mode, words, and how many blocks have been executed with it.
    changes: Vec<(u8, u32, u64)>,
    /// The first move of each change, as far as there are moves.
    moves: Vec<u32>,
    /// Of each line, how many changes hold after it, plus one.
    lines: Vec<u32>,
    /// The line whose block is passed for the first time.
    passed: usize,
    shifts: Vec<(u32, Shift)>,
    turns: Vec<(u32, [f64; 3])>,
    runs: Vec<Run>,
    speed: f64,
}

impl<'t> Watched<'t> {
    /// Of a plan.
    pub fn new(plan: &'t Plan<'t>) -> Watched<'t> {
        Watched {
            recorder: Recorder::new(&plan.tables, false),
            most: usize::MAX,
            plan,
            texts: Vec::new(),
            places: HashMap::new(),
            last: Active::default(),
            now: [0; MODES.len()],
            changes: Vec::new(),
            moves: Vec::new(),
            lines: Vec::new(),
            passed: 0,
            shifts: Vec::new(),
            turns: Vec::new(),
            runs: Vec::new(),
            speed: 0.0,
        }
    }

    /// With so many moves at most: a loop of a few lines can make any number.
    #[must_use]
    pub fn at_most(self, most: Option<usize>) -> Watched<'t> {
        Watched { most: most.unwrap_or(usize::MAX), ..self }
    }

    fn text(&mut self, text: Option<String>) -> u32 {
        let Some(text) = text else { return 0 };
        if let Some(place) = self.places.get(&text) {
            return *place;
        }
        self.texts.push(text.clone());
        let place = u32::try_from(self.texts.len()).unwrap_or(u32::MAX);
        self.places.insert(text, place);
        place
    }

    /// Takes what leads to the machine in a move, and where rotary axes stand after it.
    fn moved(&mut self, timed: &Timed, said: &Said) {
        let own = u32::try_from(self.recorder.moves()).unwrap_or(u32::MAX);
        while self.changes.get(self.moves.len()).is_some_and(|(.., executed)| *executed <= said.executed) {
            self.moves.push(own);
        }
        let act = &timed.act;
        let tables = &self.plan.tables;
        let (offset, tool) = (said.tip.offset, said.tip.tool);
        let entry = act.cut_offset.or_else(|| {
            let number = u32::try_from(act.event.state.tool).ok()?;
            Some(tables.edge_entries.get(&number).copied().unwrap_or(number))
        });
        let length = entry.is_some_and(|entry| entry == 0 || tables.lengths.contains_key(&entry));
        let known = [0, 1, 2].map(|axis| self.recorder.is_placed(offset, axis) && (axis < 2 || length));
        let shift = Shift { tool, offset, known };
        if self.shifts.last().is_none_or(|(_, last)| *last != shift) {
            self.shifts.push((own, shift));
        }
        let [from, to] = [&act.program_from, &act.program_to].map(|at| [3, 4, 5].map(|axis| units(at[axis])));
        if self.turns.is_empty() && (from != to || from != [0.0; 3]) {
            self.turns.push((0, from));
        }
        if self.turns.last().is_some_and(|(_, last)| *last != to) {
            self.turns.push((own, to));
        }
    }

    /// Takes a run of the spindle to another speed.
    fn runs(&mut self, timed: &Timed) {
        let state = &timed.act.event.state;
        let most = self.plan.machine.spindle_max.unwrap_or(f64::INFINITY);
        let after = match (&timed.act.event.kind, state.spindle) {
            (Kind::Orient(_) | Kind::Attribute(Attribute::StopSpindle), _) | (_, Spindle::Stopped) => 0.0,
            (_, Spindle::Clockwise) => units(state.turns(timed.act.event.end[0])).min(most),
            (_, Spindle::Counterclockwise) => -units(state.turns(timed.act.event.end[0])).min(most),
        };
        let before = std::mem::replace(&mut self.speed, after);
        let takes_time = matches!(
            timed.act.event.kind,
            Kind::Orient(_)
                | Kind::Attribute(
                    Attribute::StopSpindle | Attribute::StartSpindle(_) | Attribute::SpindleSpeed(_)
                )
        );
        if takes_time && before != after {
            // The time of the M function itself is none of the run; the ideal clock has none.
            let function = self.plan.machine.m_function.filter(|_| self.plan.model != Model::Ideal);
            let run = (timed.duration - function.unwrap_or(0.0)).max(0.0);
            self.runs.push(Run { times: [timed.start, timed.start + run], speeds: [before, after] });
        }
    }

    /// The moves, and the modes as columns.
    ///
    /// # Errors
    /// Writing.
    pub fn finish(self, out: &mut dyn Write) -> io::Result<Path> {
        let Watched { recorder, plan, texts, changes, mut moves, lines, shifts, turns, runs, .. } = self;
        moves.resize(changes.len(), u32::try_from(recorder.moves() + 1).unwrap_or(u32::MAX));
        let zero = |offset: Option<u16>| {
            let zero = offset.and_then(|offset| plan.tables.work_offsets.get(&offset)).copied();
            [0, 1, 2].map(|axis| units(zero.unwrap_or_default()[axis].unwrap_or(0)))
        };
        let part = zero(recorder.offset());
        let stretches: Vec<(u32, u32)> = (1u32..)
            .zip(lines.iter().skip(1))
            .scan(None, |last, (line, own)| Some((last.replace(*own) != Some(*own)).then_some((line, *own))))
            .flatten()
            .collect();
        let wholes = |values: Vec<u32>| bytes(&values, u32::to_le_bytes);
        let doubles = |values: Vec<f64>| bytes(&values, f64::to_le_bytes);
        let of = |at: usize| {
            let machine = shifts.iter().map(|(_, own)| part[at] + units(own.tool[at])).collect();
            let offset = shifts.iter().map(|(_, own)| part[at] - zero(Some(own.offset))[at]).collect();
            (doubles(machine), doubles(offset))
        };
        let [(machine_x, offset_x), (machine_y, offset_y), (machine_z, offset_z)] = [of(0), of(1), of(2)];
        let turn = |at: usize| doubles(turns.iter().map(|(_, to)| to[at]).collect());
        let known = |own: &Shift| (0..3).fold(0u8, |bits, axis| bits | u8::from(own.known[axis]) << axis);
        let run = |of: fn(&Run) -> f64| doubles(runs.iter().map(of).collect());
        let columns = [
            ("turn_a", "f64", turn(0)),
            ("turn_b", "f64", turn(1)),
            ("turn_c", "f64", turn(2)),
            ("shift_x", "f64", machine_x),
            ("shift_y", "f64", machine_y),
            ("shift_z", "f64", machine_z),
            ("offset_x", "f64", offset_x),
            ("offset_y", "f64", offset_y),
            ("offset_z", "f64", offset_z),
            ("spindle_from", "f64", run(|own| own.times[0])),
            ("spindle_to", "f64", run(|own| own.times[1])),
            ("spindle_before", "f64", run(|own| own.speeds[0])),
            ("spindle_after", "f64", run(|own| own.speeds[1])),
            ("turn_move", "u32", wholes(turns.iter().map(|(own, _)| *own).collect())),
            ("shift_move", "u32", wholes(shifts.iter().map(|(own, _)| *own).collect())),
            ("line", "u32", wholes(stretches.iter().map(|(line, _)| *line).collect())),
            ("line_changes", "u32", wholes(stretches.iter().map(|(_, own)| *own).collect())),
            ("change_move", "u32", wholes(moves)),
            ("change_text", "u32", wholes(changes.iter().map(|(_, text, _)| *text).collect())),
            ("change_mode", "u8", changes.iter().map(|(mode, ..)| *mode).collect()),
            ("shift_known", "u8", shifts.iter().map(|(_, own)| known(own)).collect()),
        ];
        let about = [("modes".to_owned(), MODES.to_vec().into()), ("texts".to_owned(), texts.into())];
        table(out, Map::from_iter(about), &columns)?;
        Ok(recorder.finish())
    }
}

impl Sink for Watched<'_> {
    fn wants_tip(&self) -> bool {
        self.recorder.wants_tip()
    }

    fn wants_modes(&self) -> bool {
        true
    }

    fn active(&mut self, line: u32, followed: &Followed) {
        if followed.active != self.last {
            self.last = followed.active;
            let words = words(self.plan.job.from.dialect, followed);
            for (mode, words) in (0u8..).zip(words) {
                let text = self.text(words);
                if std::mem::replace(&mut self.now[usize::from(mode)], text) != text {
                    self.changes.push((mode, text, followed.executed()));
                }
            }
        }
        let line = line as usize;
        if self.lines.len() <= line {
            self.lines.resize(line + 1, 0);
        }
        let goes_on = followed.joined && self.passed == line;
        if self.lines[line] == 0 || goes_on {
            self.lines[line] = u32::try_from(self.changes.len() + 1).unwrap_or(u32::MAX);
            self.passed = line;
        } else {
            self.passed = 0;
        }
    }

    fn function(&mut self, timed: &Timed, said: &Said) -> io::Result<()> {
        let before = self.recorder.moves();
        if before >= self.most {
            return Err(io::Error::other(BrokenOff::LongPath(self.most)));
        }
        self.recorder.function(timed, said)?;
        self.runs(timed);
        if self.recorder.moves() > before {
            self.moved(timed, said);
        }
        Ok(())
    }
}

fn units(nanos: Nanos) -> f64 {
    nanos as f64 / ONE as f64
}

/// The word of a dialect for a meaning; where it has none, the meaning's name.
fn word(dialect: &Dialect, meaning: Meaning) -> String {
    let code = dialect.code_for(meaning).map(|row| row.code.clone());
    let name = || dialect.name_for(NameMeaning::Code(meaning)).map(|row| row.name.clone());
    code.or_else(name).unwrap_or_else(|| meaning.to_string())
}

/// The code of units, or their name where several codes say them: they are not the same to a feed.
fn units_word(dialect: &Dialect, units: Units) -> String {
    let meaning = Meaning::UseLengthUnits(units);
    let rows = dialect.code.iter().filter(|row| row.means == Some(meaning)).count();
    match (rows, units) {
        (0 | 1, _) => word(dialect, meaning),
        (_, Units::Mm) => "mm".to_owned(),
        (_, Units::Inch) => "inch".to_owned(),
    }
}

/// The letter of a word.
fn letter(dialect: &Dialect, roles: &[Role]) -> Option<char> {
    let of = |role: &Role| dialect.address.iter().find(|row| row.role == *role);
    roles.iter().find_map(of).map(|row| row.letter)
}

/// A letter and a value, or the value alone.
fn valued(dialect: &Dialect, roles: &[Role], value: &str) -> String {
    letter(dialect, roles).map_or_else(|| value.to_owned(), |letter| format!("{letter}{value}"))
}

fn cycle(dialect: &Dialect, kind: &'static str) -> String {
    let code = dialect.cycle.iter().find(|row| row.kind == kind).map(|row| row.code.clone());
    let call =
        || dialect.call.iter().find(|row| row.kind.cycles().contains(&kind)).map(|row| row.name.clone());
    code.or_else(call).unwrap_or_else(|| kind.to_owned())
}

/// The work offset: one of several that share a code has a word that says which.
fn work_offset(dialect: &Dialect, number: u16) -> String {
    let counted = dialect.counted_offsets().and_then(|row| {
        let Some(Meaning::SetOriginOffsets(first)) = row.means else { return None };
        let which = number.checked_sub(first).filter(|n| *n < row.count.unwrap_or(0))? + 1;
        Some(format!("{} {}{which}", row.code, row.words.chars().next()?))
    });
    counted.unwrap_or_else(|| spelled::work_offset(number, [dialect; 2]))
}

fn length(dialect: &Dialect, own: Length) -> String {
    let takes = dialect
        .code_for(Meaning::UseToolLengthOffset)
        .filter(|_| letter(dialect, &[Role::LengthEntry]).is_some());
    match (own, takes) {
        (Length::Entry(0), _) if dialect.code_for(Meaning::CancelToolLengthOffset).is_some() => {
            word(dialect, Meaning::CancelToolLengthOffset)
        }
        (Length::Entry(entry), Some(row)) => {
            format!("{} {}", row.code, valued(dialect, &[Role::LengthEntry], &entry.to_string()))
        }
        (Length::Entry(0), None) => valued(dialect, &[Role::ToolEdge, Role::Corrector], "0"),
        // An entry is the first edge of the tool with its number.
        (Length::Entry(entry), None) => match letter(dialect, &[Role::Corrector]) {
            Some(letter) => format!("{letter}{entry}"),
            None => valued(dialect, &[Role::ToolEdge], "1"),
        },
        (Length::Edge(_, edge), _) => valued(dialect, &[Role::ToolEdge, Role::Corrector], &edge.to_string()),
    }
}

/// The words of all modes, in the order of [`MODES`].
fn words(dialect: &Dialect, followed: &Followed) -> [Option<String>; MODES.len()] {
    let own = &followed.active;
    let code = |meaning| word(dialect, meaning);
    let motion = own.modes.motion.map(|motion| match (motion, own.cycle) {
        (Motion::Traverse, _) => code(Meaning::StraightTraverse),
        (Motion::Feed, _) => code(Meaning::StraightFeed),
        (Motion::Arc(turn @ (Turn::Clockwise | Turn::Counterclockwise)), _) => code(Meaning::ArcFeed(turn)),
        (Motion::Cycle, Some(kind)) => cycle(dialect, kind),
        (Motion::Cycle, None) => code(Meaning::StartCycle),
    });
    let compensation = own.compensation.map(|compensation| match compensation {
        None => code(Meaning::StopCutterRadiusCompensation),
        Some((side, None)) => code(Meaning::StartCutterRadiusCompensation(side)),
        Some((side, Some(entry))) => {
            let entry = valued(dialect, &[Role::RadiusEntry], &entry.to_string());
            format!("{} {entry}", code(Meaning::StartCutterRadiusCompensation(side)))
        }
    });
    let spindle = own.spindle.map(|spindle| {
        code(match spindle {
            Spindle::Clockwise => Meaning::StartSpindleClockwise,
            Spindle::Counterclockwise => Meaning::StartSpindleCounterclockwise,
            Spindle::Stopped => Meaning::StopSpindleTurning,
        })
    });
    let coolant = own.coolant.map(|on| match (on.flood, on.mist) {
        (false, false) => code(Meaning::CoolantOff),
        (true, false) => code(Meaning::FloodOn),
        (false, true) => code(Meaning::MistOn),
        (true, true) => format!("{} {}", code(Meaning::FloodOn), code(Meaning::MistOn)),
    });
    let inch = own.modes.units == Some(Units::Inch);
    let counted = |nanos: Nanos| number(if inch { (nanos as f64 / 25.4).round() as Nanos } else { nanos });
    let feed = own.feed.map(|feed| valued(dialect, &[Role::Feed], &counted(feed)));
    let speed = own.speed.map(|speed| {
        let speed = valued(dialect, &[Role::Speed], &number(speed));
        match own.spindle_mode {
            Some(SpindleMode::Surface) => {
                format!("{} {speed}", code(Meaning::SetSpindleMode(SpindleMode::Surface)))
            }
            Some(SpindleMode::Turns) | None => speed,
        }
    });
    let tool = own.tool.and_then(|tool| match followed.tool_name() {
        Some(name) => Some(format!("\"{name}\"")),
        None => (tool >= 0).then(|| valued(dialect, &[Role::Tool], &tool.to_string())),
    });
    [
        motion,
        own.modes.plane.map(|plane| code(Meaning::SelectPlane(plane))),
        own.modes.distance.map(|distance| code(Meaning::SetDistanceMode(distance))),
        own.modes.feed_mode.map(|mode| code(Meaning::SetFeedMode(mode))),
        own.modes.units.map(|own| units_word(dialect, own)),
        compensation,
        own.modes.work_offset.map(|number| work_offset(dialect, number)),
        own.modes.return_level.map(|level| code(Meaning::SetReturnLevel(level))),
        spindle,
        coolant,
        own.length.map(|own| length(dialect, own)),
        feed,
        speed,
        tool,
    ]
}
