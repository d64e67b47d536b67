//! Parameters of functions in the case study's document: by the letters that its own control has for
//! them, in mm, degrees and seconds, from program zero.

use ncc_exec::{Exec, Kind};
use ncc_ir::canon::{AXES, Axis, Turn};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::cycle::{Along, Clearance, Cycle, CycleKind, First, Pattern, Row, Shift};
use ncc_ir::program::{Coord, Op, Pitch, Point};
use ncc_time::Act;
use serde_json::{Map, Value};

use super::columns::{micro, units};
use crate::render::events;

/// Parameters by name.
type Parameters = Map<String, Value>;

/// One parameter.
pub fn one(name: &str, value: Value) -> Parameters {
    Map::from_iter([(name.to_owned(), value)])
}

/// Of an arc: its centre in the plane's axes (`i`, `j`, `k`), its sense, and whether it is a whole
/// circle.
pub fn arc(act: &Act) -> Parameters {
    let Kind::Arc { plane, turn, full, centre } = &act.event.kind else { return Map::new() };
    let (first, second, _) = plane.axes();
    let mut found = Map::new();
    // Where frames turn, the centre follows the shift of the end point; its way is the machine's.
    for (axis, at) in [first, second].into_iter().zip(centre) {
        let shift = act.program_to[axis as usize] - act.event.end[axis as usize];
        let letter = ["i", "j", "k"][axis as usize];
        found.insert(letter.to_owned(), number(Some(at + shift)));
    }
    let sense = if *turn == Turn::Clockwise { "clockwise" } else { "counterclockwise" };
    found.insert("turn".to_owned(), sense.into());
    found.insert("plane".to_owned(), events::plane(*plane).into());
    found.insert("full".to_owned(), (*full).into());
    found
}

/// Name and parameters of a statement of a cycle.
pub fn of(op: &Op, exec: &Exec) -> (&'static str, Parameters) {
    match op {
        Op::StartCycle(cycle) => ("START_CYCLE", start(cycle, exec)),
        Op::Pattern(p) => (pattern_name(p), pattern(p, exec)),
        Op::Hole(m) | Op::Position(m) => ("HOLE", point(&m.to, exec)),
        Op::Polar(polar) => match exec.by_coordinates(polar) {
            Some(op) => of(&op, exec),
            None => of(&polar.op, exec),
        },
        Op::EndCycle => ("END_CYCLE", Map::new()),
        other => (other.name(), Map::new()),
    }
}

fn number(value: Option<Nanos>) -> Value {
    value.map_or(Value::Null, |nanos| micro(units(nanos)).into())
}

fn start(cycle: &Cycle, exec: &Exec) -> Parameters {
    let mut found = one("kind", cycle.kind.name().into());
    let mut put = |name: &str, value: &Expr| {
        found.insert(name.to_owned(), number(exec.nanos(value)));
    };
    match &cycle.kind {
        CycleKind::Drill => {}
        CycleKind::DrillDwell { dwell } => put("dwell", dwell),
        CycleKind::DrillPeck { peck, first, less, clearance, pause, settle, dwell } => {
            put("peck", peck);
            let words = [
                ("first_peck", first),
                ("less", less),
                ("pause", pause),
                ("settle", settle),
                ("dwell", dwell),
            ];
            words.into_iter().for_each(|(name, value)| value.iter().for_each(|value| put(name, value)));
            if let Clearance::Stated(value) = clearance {
                put("clearance", value);
            }
        }
        CycleKind::DrillBreak { peck, first, less, lift, pause, dwell, .. } => {
            put("peck", peck);
            let words = [("first_peck", first), ("less", less), ("pause", pause), ("dwell", dwell)];
            words.into_iter().for_each(|(name, value)| value.iter().for_each(|value| put(name, value)));
            if let Clearance::Stated(value) = lift {
                put("lift", value);
            }
        }
        CycleKind::Bore { dwell, feed_out, .. } => {
            dwell.iter().for_each(|value| put("dwell", value));
            feed_out.iter().for_each(|value| put("feed_out", value));
        }
        CycleKind::Tap(tap) => {
            if let Pitch::Stated(pitch) = &tap.pitch {
                put("pitch", pitch);
            }
            let words = [("dwell", &tap.dwell), ("back", &tap.back), ("settle", &tap.settle)];
            words.into_iter().for_each(|(name, value)| value.iter().for_each(|value| put(name, value)));
        }
        CycleKind::FineBore(bore) => {
            let words = [("dwell", &bore.dwell), ("angle", &bore.angle)];
            words.into_iter().for_each(|(name, value)| value.iter().for_each(|value| put(name, value)));
            if let Shift::Parameter(amount) = &bore.shift {
                put("shift", amount);
            }
        }
        CycleKind::BoreStop(bore) => bore.dwell.iter().for_each(|value| put("dwell", value)),
    }
    if let Some((plane, retract, depth)) = exec.cycle_levels() {
        // The drilling axis' letter; of most programs, z.
        let normal = (plane.axes().2.letter() as char).to_ascii_lowercase();
        found.insert(normal.to_string(), number(Some(depth)));
        found.insert("r".to_owned(), number(Some(retract)));
    }
    if let Some(feed) = &cycle.feed {
        found.insert("f".to_owned(), number(exec.nanos(feed)));
    }
    found
}

fn pattern_name(pattern: &Pattern) -> &'static str {
    match pattern {
        Pattern::Circle { .. } => "CIRCLE_PATTERN",
        Pattern::Line { .. } => "LINE_PATTERN",
        Pattern::List(_) => "POSITION_LIST",
        Pattern::Grid { .. } => "RECTANGULAR_LAYOUT",
    }
}

fn point(to: &Point, exec: &Exec) -> Parameters {
    let words = Axis::ALL.into_iter().filter_map(|axis| Some((axis, to.get(axis)?)));
    words
        .map(|(axis, word)| (letter(axis), number(exec.word(word, exec.position()[axis as usize]))))
        .collect()
}

fn letter(axis: Axis) -> String {
    (axis.letter() as char).to_ascii_lowercase().to_string()
}

/// Of a circle: first hole `x`, `y` (or radius `r` and angle `a`), centre `i`, `j`, angle from hole to
/// hole `b`, holes `l`. Of a grid: pitches `x`, `y` (or angles `a`, `b` with pitches `p`, `q`),
/// columns `i`, rows `j`. Of a line: direction `a`, distance of the first hole `d`, pitch `p`, holes
/// `l`. Letters of positions are those of the plane's axes.
fn pattern(pattern: &Pattern, exec: &Exec) -> Parameters {
    let plane = exec.cycle_levels().map_or(exec.plane(), |levels| levels.0);
    let (first, second, _) = plane.axes();
    let mut found = Map::new();
    let mut put = |name: &str, value: Value| {
        found.insert(name.to_owned(), value);
    };
    let here = exec.position();
    let pair = |words: &[Coord; 2]| {
        [(first, &words[0]), (second, &words[1])]
            .map(|(axis, word)| (axis, number(exec.word(word, here[axis as usize]))))
    };
    let value = |value: &Expr| number(exec.nanos(value));
    match pattern {
        Pattern::Circle { centre, first: hole, step, count } => {
            match hole {
                First::At(words) => pair(words).into_iter().for_each(|(axis, at)| put(&letter(axis), at)),
                First::Polar { radius, angle } => {
                    put("r", value(radius));
                    put("a", value(angle));
                }
            }
            let letters = |axis: Axis| ["i", "j", "k"][axis as usize % 3];
            let centre = centre.iter().flat_map(pair);
            centre.for_each(|(axis, at)| put(letters(axis), at));
            put("b", value(step));
            put("l", (*count).into());
        }
        Pattern::Line { start, angle, offset, pitch, count } => {
            let start = start.iter().flat_map(pair);
            start.for_each(|(axis, at)| put(&letter(axis), at));
            put("a", value(angle));
            put("d", value(offset));
            put("p", value(pitch));
            put("l", (*count).into());
        }
        Pattern::List(points) => {
            let mut here = exec.position();
            let list = points.iter().map(|to| Value::Object(listed(to, exec, &mut here)));
            put("positions", list.collect());
        }
        Pattern::Grid { columns, rows, serpentine, .. } => {
            let mut direction = |row: &Row, angle: &str, pitch: &str| match &row.along {
                Along::Axis(axis) => put(&letter(*axis), value(&row.pitch)),
                Along::Angle(along) => {
                    put(angle, value(along));
                    put(pitch, value(&row.pitch));
                }
            };
            direction(columns, "a", "p");
            direction(rows, "b", "q");
            put("i", columns.count.into());
            put("j", rows.count.into());
            put("serpentine", (*serpentine).into());
        }
    }
    found
}

/// A position of a list, each measured from the one before where it is incremental.
fn listed(to: &Point, exec: &Exec, here: &mut [Nanos; AXES]) -> Parameters {
    for (axis, at) in Axis::ALL.into_iter().zip(here.iter_mut()) {
        if let Some(there) = to.get(axis).and_then(|word| exec.word(word, *at)) {
            *at = there;
        }
    }
    let words = Axis::ALL.into_iter().filter(|axis| to.get(*axis).is_some());
    words.map(|axis| (letter(axis), number(Some(here[axis as usize])))).collect()
}
