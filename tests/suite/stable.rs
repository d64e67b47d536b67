//! Editing one block of a source changes only the emitted lines that say it.
//!
//! A block of a corpus program is edited at random; both programs go to every dialect. The lines that
//! differ, the head's aside, are at most two more than the edit requires: one for each event that is another
//! one, told by what it changes in the distances of the emitted text, and one for each statement of the
//! block without an event (each time that it is executed, where the target has no subprograms).
//!
//! Apart are edits after which the target can say less, or more, of the program's structure than before: a
//! plane for which it has no word takes the form of a cycle from every hole, a length offset that is not
//! cancelled the calls from a program; a mirror left out of a chain of frames makes words of frames of what
//! was worked into the coordinates. They must stay rare.

use std::collections::BTreeMap;
use std::fmt::Write;

use fastrand::Rng;
use ncc_driver::job::Outcome;
use ncc_exec::world::World;
use ncc_exec::{Event, Exec, Kind, Runner};
use ncc_ir::canon::{AXES, Distance, Fact, Modes};
use ncc_ir::expr::Expr;
use ncc_ir::program::{Centre, CentreFrom, FrameSlot, FrameStep, Op, Program, Slot, Stmt};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;
use ncc_passes::{PASSES, Target};
use ncc_tests::corpus::{self, DIALECTS};
use ncc_tests::expect::Failures;
use ncc_tests::translate::{computes, job, read, settings, translate};
use similar::{Algorithm, DiffOp, capture_diff_slices};

/// How many edits are tried; a variable of that name asks for more.
const EDITS: usize = 1000;

/// Lines that may differ besides those that the motion requires.
const SLACK: usize = 2;

#[test]
fn an_edit_of_one_block_stays_where_it_is() {
    // What a program computes another digit changes everywhere, or without end.
    let programs: Vec<_> = corpus::all().into_iter().filter(|program| !computes(program)).collect();
    let edits = std::env::var("NCC_STABLE_EDITS").ok().and_then(|n| n.parse().ok()).unwrap_or(EDITS);
    let mut rng = Rng::with_seed(20_260_728);
    let mut before = BTreeMap::new();
    let mut failures = Failures::default();
    let (mut tried, mut compared, mut refused, mut formed, mut most) = (0, 0, 0, 0, 0);
    while tried < edits {
        let at = rng.usize(..programs.len());
        let program = &programs[at];
        let Some((edited, what)) = edit(&program.text, &mut rng) else { continue };
        // A program that is none any more says nothing about lines.
        let Ok(new) = Meaning::of(program.dialect, &edited) else { continue };
        let Ok(old) = Meaning::of(program.dialect, &program.text) else { continue };
        tried += 1;
        for to in DIALECTS {
            let was = before.entry((at, to)).or_insert_with(|| emitted(program, to, &program.text));
            let (Some(was), Some(is)) = (&*was, emitted(program, to, &edited)) else {
                refused += 1;
                continue;
            };
            compared += 1;
            let qualified = settings(program.dialect).dialect.can.everything;
            if another_form([&old.program, &new.program], [&was.program, &is.program], qualified) {
                formed += 1;
                continue;
            }
            let required = required(&old, &new, settings(to).dialect.caps.flat, &is.program);
            let differ = lines(&was.text, &is.text);
            most = most.max(differ.saturating_sub(required));
            if differ > required + SLACK {
                let told = format!("{what}: {differ} lines differ, {required} are required");
                let diff = ncc_tests::expect::diff(was.text.as_bytes(), is.text.as_bytes());
                let pair = format!("{}/{} to {to}", program.dialect, program.file);
                failures.add(pair, format!("{told}\n{diff}"));
            }
        }
    }
    println!(
        "{tried} edits of one block: {compared} pairs of outputs, {refused} refused, {formed} in another \
         form; of the others at most {most} lines more than required"
    );
    if formed * 25 > compared {
        failures.add("in another form", format!("{formed} of {compared}"));
    }
    failures.finish();
}

/// The program with one of its blocks edited, and what was done.
fn edit(text: &[u8], rng: &mut Rng) -> Option<(Vec<u8>, String)> {
    let mut blocks: Vec<&[u8]> = text.split_inclusive(|c| *c == b'\n').collect();
    let at = rng.usize(..blocks.len().max(1));
    let block = *blocks.get(at)?;
    let digits: Vec<usize> = (0..block.len()).filter(|at| block[*at].is_ascii_digit()).collect();
    let (changed, what) = match rng.u8(..5) {
        0..=2 if !digits.is_empty() => {
            let mut changed = block.to_vec();
            changed[digits[rng.usize(..digits.len())]] = b'0' + rng.u8(..10);
            (changed, "a digit")
        }
        0..=2 => return None,
        3 => (Vec::new(), "left out"),
        _ => (block.repeat(2), "said twice"),
    };
    if changed == block {
        return None;
    }
    let [was, is] = [block, &changed].map(|block| String::from_utf8_lossy(block).trim_end().to_owned());
    let what = format!("line {}, {what}: {was:?} is now {is:?}", at + 1);
    blocks[at] = &changed;
    Some((blocks.concat(), what))
}

/// What a program says and what it does.
struct Meaning {
    /// What it says.
    program: Program,
    /// Its events, in two worlds.
    events: [Vec<Event>; 2],
    /// The same, with what sets something.
    narrated: [Vec<Event>; 2],
}

impl Meaning {
    fn of(dialect: &str, text: &[u8]) -> Result<Meaning, String> {
        let program = read(dialect, text)?;
        let run = |seed, narrate| {
            let world = World::generate(seed, &Modes::default());
            let mut exec = Exec::new(&world, 0);
            if narrate {
                exec.narrate();
            }
            exec.assume(&program.assumed);
            let mut events = Vec::new();
            Runner::new(&program).run(&mut exec, usize::MAX, &mut events).map_err(|d| format!("{d:?}"))?;
            Ok::<_, String>(events)
        };
        let events = [run(1, false)?, run(2, false)?];
        let narrated = [run(1, true)?, run(2, true)?];
        Ok(Meaning { program, events, narrated })
    }

    /// Its statements and their places; those that are executed if the text has no calls.
    fn said(&self, text: &Program) -> (Vec<String>, Vec<Span>) {
        let mut program = self.program.clone();
        if structure(text)[0] == 0 {
            write_out(&mut program);
        }
        let said = |s: &Stmt| (format!("{:?} {:?} {:?}", s.skip, s.op, s.comment), s.span);
        program.procedures.iter().flat_map(|p| p.body.iter().map(said)).unzip()
    }
}

/// Without calls and repetitions.
fn write_out(program: &mut Program) {
    for pass in PASSES.iter().filter(|p| p.name == "expand-calls" || p.name == "expand-repeats") {
        (pass.run)(program, &Target::default(), &Tracker::unknown(), &mut Vec::new());
    }
}

/// How many moves are made outside of frames, and within.
fn framed(program: &Program) -> [usize; 2] {
    let is_frame = |s: &Stmt| matches!(s.op, Op::SetFrame(_) | Op::SetSlot(_) | Op::SetPosition(_));
    if !program.procedures.iter().flat_map(|p| &p.body).any(is_frame) {
        return [0; 2];
    }
    let mut program = program.clone();
    write_out(&mut program);
    let zero = |word: &Option<Expr>| word.as_ref().and_then(Expr::literal).is_some_and(|n| n.mantissa == 0);
    let nothing = |words: &[Option<Expr>]| words.iter().all(|word| word.is_none() || zero(word));
    let (mut moves, mut chain, mut origin, mut rotation, mut scale) = ([0; 2], false, false, false, false);
    let (mut local, mut mirror) = ([false; AXES], [false; 3]);
    for stmt in program.procedures.iter().take(1).flat_map(|p| &p.body) {
        match &stmt.op {
            Op::SetFrame(frame) => {
                let none = matches!(&frame.step, FrameStep::Translate(words) if nothing(&**words));
                chain = frame.added && chain || !none;
            }
            Op::SetPosition(_) => origin = true,
            Op::SetSlot(slot) => match &**slot {
                Slot::Shift { origin: true, axes } => origin = !nothing(&**axes),
                Slot::Shift { origin: false, axes } => {
                    for (local, word) in local.iter_mut().zip(axes.iter()).filter(|(_, w)| w.is_some()) {
                        *local = !zero(word);
                    }
                }
                Slot::Rotation { .. } => rotation = true,
                // It is never worked into coordinates.
                Slot::Tilt(_) => {}
                Slot::Scale { .. } => scale = true,
                Slot::Mirror(lines) => {
                    mirror.iter_mut().zip(lines.iter()).for_each(|(m, line)| *m |= line.is_some());
                }
                Slot::NoMirror(axes) => mirror.iter_mut().zip(axes).for_each(|(m, off)| *m &= !off),
            },
            Op::ClearFrame(FrameSlot::Chain) => chain = false,
            Op::ClearFrame(FrameSlot::Shift) => origin = false,
            Op::ClearFrame(FrameSlot::Local) => local = [false; AXES],
            Op::ClearFrame(FrameSlot::Rotation) => rotation = false,
            Op::ClearFrame(FrameSlot::Scale) => scale = false,
            Op::ClearFrame(FrameSlot::Mirror) => mirror = [false; 3],
            Op::StraightTraverse(_) | Op::StraightFeed(_) | Op::ArcFeed(_) | Op::Hole(_) | Op::Pattern(_) => {
                let within = chain || origin || rotation || scale;
                let within = within || local.contains(&true) || mirror.contains(&true);
                moves[usize::from(within)] += 1;
            }
            _ => {}
        }
    }
    moves
}

/// Whether frames of a source are said in one output, and worked into coordinates in the other: moves
/// that the source makes within a frame are made outside of all.
fn frames_in_another_form(sources: [&Program; 2], outputs: [&Program; 2]) -> bool {
    let (sources, outputs) = (sources.map(framed), outputs.map(framed));
    // Without a word of frames in the output the form is the same: coordinates.
    if sources.iter().chain(&outputs).any(|moves| moves[1] == 0) {
        return false;
    }
    let worked_in = |at: usize| outputs[at][0] > sources[at][0] && outputs[at][1] < sources[at][1];
    worked_in(0) != worked_in(1)
}

/// How many calls and repetitions, and statements of cycles, there are.
fn structure(program: &Program) -> [i64; 2] {
    let mut found = [0; 2];
    for stmt in program.procedures.iter().flat_map(|p| &p.body) {
        match stmt.op {
            Op::Call(_) | Op::RepeatBlocks(_) => found[0] += 1,
            Op::StartCycle(_) | Op::Hole(_) | Op::Pattern(_) => found[1] += 1,
            _ => {}
        }
    }
    found
}

/// Whether an output's structure changed as the source's did not; or a cycle came or went whose holes are
/// written out, or every position under one a call of its own, or a mode whose words say themselves what they
/// are; or frames took another form, or have corners written out.
fn another_form(sources: [&Program; 2], outputs: [&Program; 2], qualified: bool) -> bool {
    let ([old, new], [was, is]) = (sources.map(structure), outputs.map(structure));
    let count = |program: &Program, of: fn(&Op) -> bool| {
        program.procedures.iter().flat_map(|p| &p.body).filter(|s| of(&s.op)).count()
    };
    let [starts_old, starts_new] = sources.map(|p| count(p, |op| matches!(op, Op::StartCycle(_))));
    let [modes_old, modes_new] = sources.map(|p| count(p, |op| matches!(op, Op::SetDistanceMode(_))));
    let written_out = (was[1], is[1]) == (0, 0) && starts_old != starts_new;
    let by_words = qualified && modes_old != modes_new;
    let changed = (0..2).any(|at| (was[at], is[at]) != (0, 0) && is[at] - was[at] != new[at] - old[at]);
    // Under a modal cycle, positions reached at feed are moves, each with a call of its own.
    let calls_apart = starts_old.abs_diff(starts_new) > 1;
    // In a program of frames corners are written out.
    let frames = sources
        .map(|p| count(p, |op| matches!(op, Op::ClearFrame(_) | Op::SetFrame(_) | Op::SetSlot(_))) > 0);
    let corners = outputs.map(|p| count(p, |op| matches!(op, Op::Corner { .. })));
    let corners_out = frames[0] != frames[1] && corners[0] != corners[1];
    changed
        || written_out
        || calls_apart
        || by_words
        || corners_out
        || frames_in_another_form(sources, outputs)
}

/// How a line names places.
#[derive(Clone, Copy, PartialEq)]
enum Form {
    /// All of them, whether they change or not.
    Whole,
    /// Those that change.
    Absolute,
    /// By how much those change that do.
    Incremental,
}

/// How many lines must differ for an edit, in the dialect of a text.
fn required(old: &Meaning, new: &Meaning, flat: bool, text: &Program) -> usize {
    let forms = match distances(text) {
        _ if flat => vec![Form::Whole],
        (true, true) => vec![Form::Absolute, Form::Incremental],
        (_, false) => vec![Form::Absolute],
        (false, true) => vec![Form::Incremental],
    };
    let (old_said, old_places) = old.said(text);
    let (new_said, new_places) = new.said(text);
    let [gone_said, come_said] = changes(&old_said, &new_said);
    let (old, new) = if flat { (&old.narrated, &new.narrated) } else { (&old.events, &new.events) };
    let mut most = 0;
    let centres = counts_centres_from_zero(text);
    for form in forms {
        for (old, new) in old.iter().zip(new) {
            let [gone, come] = changes(&steps(old, form, centres), &steps(new, form, centres));
            most = most.max(lines_of(&gone, old, &gone_said, &old_places));
            most = most.max(lines_of(&come, new, &come_said, &new_places));
        }
    }
    most
}

/// How many lines changed events and changed statements are: a statement is told by its own events.
fn lines_of(events: &[usize], all: &[Event], said: &[usize], places: &[Span]) -> usize {
    let told = |at: &usize| events.iter().any(|e| all[*e].span == places[*at]);
    // A cycle that stops the spindle between its own moves, written out, says so in a line.
    let switches = |at: &&usize| match all[..=**at] {
        [.., ref before, ref event] => {
            before.span == event.span && before.state.spindle != event.state.spindle
        }
        _ => false,
    };
    let switched = events.iter().filter(switches).count();
    events.len() + switched + said.iter().filter(|at| !told(at)).count()
}

/// A line for each event, by what it changes.
fn steps(events: &[Event], form: Form, centres: bool) -> Vec<String> {
    let last = std::iter::once(None).chain(events.iter().map(Some));
    events.iter().zip(last).map(|(e, last)| told(e, last, form, centres)).collect()
}

/// Whether a text says the centres of its arcs from program zero: there an arc that moves is said otherwise.
fn counts_centres_from_zero(text: &Program) -> bool {
    let from_zero = |stmt: &Stmt| match &stmt.op {
        Op::ArcFeed(arc) => matches!(arc.centre, Centre::Point { from: CentreFrom::Zero, .. }),
        _ => false,
    };
    text.procedures.iter().flat_map(|p| &p.body).any(from_zero)
}

/// Whether a text has absolute and incremental words.
fn distances(text: &Program) -> (bool, bool) {
    let mut found = (false, false);
    for stmt in text.procedures.iter().flat_map(|p| &p.body) {
        if let Op::StraightFeed(to) | Op::StraightTraverse(to) = &stmt.op {
            for word in to.to.axes.iter().flatten() {
                match word.distance {
                    Fact::Known(Distance::Absolute) => found.0 = true,
                    Fact::Known(Distance::Incremental) => found.1 = true,
                    Fact::Entry => found = (true, true),
                }
            }
        }
    }
    found
}

/// An event in words, after another.
fn told(event: &Event, last: Option<&Event>, form: Form, from_zero: bool) -> String {
    let Event { kind, end, rate, state, .. } = event;
    let from = |axis: usize| last.filter(|_| !from_zero).map_or(0, |last| last.end[axis]);
    let mut out = match kind {
        Kind::Arc { plane, turn, full, centre } => {
            let (a, b, _) = plane.axes();
            let centre = [centre[0] - from(a as usize), centre[1] - from(b as usize)];
            format!("arc {plane:?} {turn:?} {full} {centre:?}")
        }
        other => format!("{other:?}"),
    };
    let last = last.filter(|_| form != Form::Whole);
    for (axis, at) in end.iter().enumerate() {
        let before = last.map(|last| last.end[axis]);
        if before != Some(*at) {
            let zero = before.filter(|_| form == Form::Incremental).unwrap_or(0);
            let _ = write!(out, " {axis}={}", at - zero);
        }
    }
    if last.is_none_or(|last| last.rate != *rate) {
        let _ = write!(out, " at {rate}");
    }
    if last.is_none_or(|last| last.state != *state) {
        let _ = write!(out, " {state:?}");
    }
    out
}

/// What was emitted.
struct Emitted {
    /// Its text, without a head.
    text: String,
    /// What it says, read back.
    program: Program,
}

/// What is released of a program; `None` if nothing is.
fn emitted(program: &corpus::Program, to: &str, text: &[u8]) -> Option<Emitted> {
    let mut job = job(program.dialect, to, &program.file);
    job.layout = ncc_backends::Layout::default();
    job.head = false;
    job.fold = Some(false);
    let (outcome, written): (Outcome, _) = translate(&job, text);
    outcome.release.ok()?;
    let program = read(to, &written).ok()?;
    Some(Emitted { text: String::from_utf8_lossy(&written).into_owned(), program })
}

/// How many lines of two texts differ: of what was left out and what came in, the longer.
fn lines(old: &str, new: &str) -> usize {
    let (old, new): (Vec<_>, Vec<_>) = (old.lines().collect(), new.lines().collect());
    changes(&old, &new).iter().map(Vec::len).max().unwrap_or(0)
}

/// Places in two lists of what was left out, and of what came in.
fn changes<T: std::hash::Hash + Ord>(old: &[T], new: &[T]) -> [Vec<usize>; 2] {
    let (mut gone, mut come) = (Vec::new(), Vec::new());
    for change in capture_diff_slices(Algorithm::Myers, old, new) {
        match change {
            DiffOp::Equal { .. } => {}
            DiffOp::Delete { .. } | DiffOp::Insert { .. } | DiffOp::Replace { .. } => {
                gone.extend(change.old_range());
                come.extend(change.new_range());
            }
        }
    }
    [gone, come]
}
