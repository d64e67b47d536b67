//! Whether two texts of one dialect do the same: both are executed in the worlds of a verification, with
//! all block-skip switches off and with all of them on, and what they do is held against each other.
//!
//! Both must do exactly the same, to the last digit: only places in the text may differ. Two texts that are read as the
//! same statements do the same, because execution knows nothing else of them: these are executed once, and their events
//! counted. Of others a digest of all events is compared, so that memory does not grow with the program. Not here: whether
//! the texts have the same words (`same`), which goes further than two settings of the switches do.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::io;
use std::ops::ControlFlow;

use ncc_exec::{Event, Exec, Kind};
use ncc_ir::canon::Modes;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::program::Stmt;

use crate::job::Job;
use crate::review::stream::{Course, Made, Reading, Unsaid, Waiting, clearances, read, stream, worlds};
use crate::side_by_side::{self, Pieces, Take};
use crate::source::Readable;

/// Pieces that the reader of a text may be ahead.
const AHEAD: usize = 4;

/// What a comparison found out.
#[derive(Debug)]
pub enum Compared {
    /// Both do the same; how many events were compared.
    Same(u64),
    /// They do not.
    Different,
    /// The first text cannot be executed; its first error, if one is known, and whether it is no text.
    NotExecuted(Box<Option<Diagnostic>>, bool),
}

/// Executes and compares; what the first text is found to assume goes to `assumed`.
///
/// # Errors
/// Reading.
pub fn compare(
    job: &Job,
    before: &mut (dyn Readable + Send),
    after: &mut (dyn Readable + Send),
    assumed: &mut Vec<Diagnostic>,
) -> io::Result<Compared> {
    if let Some(events) = once(job, before, after, assumed)? {
        return Ok(Compared::Same(events));
    }
    let (done, levels) = digest(job, before, 0, assumed)?;
    let mut events = match &done {
        Done::Executed(_, events) => *events,
        Done::Refused(first, no_text) => return Ok(Compared::NotExecuted(first.clone(), *no_text)),
    };
    if done != digest(job, after, 0, &mut Vec::new())?.0 {
        return Ok(Compared::Different);
    }
    if levels != 0 {
        let skipped = digest(job, before, levels, &mut Vec::new())?.0;
        match &skipped {
            Done::Executed(_, more) => events += more,
            // With blocks skipped the program may have no sense; then nothing is known of that way.
            Done::Refused(..) => return Ok(Compared::Same(events)),
        }
        if skipped != digest(job, after, levels, &mut Vec::new())?.0 {
            return Ok(Compared::Different);
        }
    }
    Ok(Compared::Same(events))
}

/// How many events both texts make, where they are read as the same statements; what they are found to assume goes to
/// `assumed`. `None` where they are not, or cannot be executed, or are not executed in one way from first to last.
fn once(
    job: &Job,
    before: &mut (dyn Readable + Send),
    after: &mut (dyn Readable + Send),
    assumed: &mut Vec<Diagnostic>,
) -> io::Result<Option<u64>> {
    let Some((mut events, course)) = same_statements(job, before, after, 0)? else { return Ok(None) };
    if course.skip_levels != 0 {
        match same_statements(job, before, after, course.skip_levels)? {
            Some((more, _)) => events += more,
            None => return Ok(None),
        }
    }
    assumed.extend(course.diagnostics);
    Ok(Some(events))
}

/// Reads both texts beside one another, and executes the statements of the first under these block-skip switches.
fn same_statements(
    job: &Job,
    before: &mut (dyn Readable + Send),
    after: &mut (dyn Readable + Send),
    skip: u16,
) -> io::Result<Option<(u64, Course)>> {
    let first = |take: Take<Reading>| read(job, before, Unsaid::Taken, take);
    let second = |take: Take<Reading>| read(job, after, Unsaid::Taken, take);
    let (counted, courses) = side_by_side::run(first, second, AHEAD, |pieces| count_same(job, skip, pieces));
    let (Some(events), [Some(first), Some(second)]) = (counted, courses) else { return Ok(None) };
    let (first, second) = (first?, second?);
    let read = |course: &Course| !course.refused && !course.whole;
    let alike = read(&first) && read(&second) && first.assumed == second.assumed;
    Ok(alike.then_some((events, first)))
}

/// Counts the events of statements that come from both sides; `None` where these are others, or cannot be executed.
fn count_same(job: &Job, skip: u16, mut from: [Pieces<Reading>; 2]) -> Option<u64> {
    let mut controls: Vec<Exec> =
        worlds(job, clearances(job)).iter().map(|world| Exec::new(world, skip)).collect();
    let (mut events, mut many) = (Vec::new(), 0);
    let mut waiting: [Waiting; 2] = Default::default();
    loop {
        for (side, from) in from.iter_mut().enumerate() {
            while waiting[side].is_empty() && !waiting[side].over {
                let Some(reading) = from() else {
                    waiting[side].over = true;
                    break;
                };
                let assumed = reading.assumed;
                let stood = waiting[side].take(reading);
                if side == 0 {
                    begin(job, &mut controls, &assumed, stood);
                }
            }
        }
        match waiting.each_ref().map(|side| side.over) {
            [true, true] => return end(&mut controls, many),
            [false, false] => {}
            [true, false] | [false, true] => return None,
        }
        match count_rows(&mut controls, &mut waiting) {
            Some(counted) => many += counted.ok()?,
            None => many += count_statements(&mut controls, &mut waiting, &mut events)?,
        }
    }
}

/// Executes rows of tables that both sides have next, and counts their events; `None`, and nothing done, where there are
/// none that controls take together.
fn count_rows(controls: &mut [Exec], waiting: &mut [Waiting; 2]) -> Option<Result<u64, Diagnostic>> {
    let [first, second] = waiting.each_ref().map(Waiting::rows);
    let same = first.said_by(second);
    let lines = first.split(same).0;
    let mut valued = controls.first().filter(|_| same > 0)?.value_rows(lines)?;
    let counted = controls.iter_mut().map(|control| control.pass_rows(lines, &mut valued)).sum();
    waiting.iter_mut().for_each(|side| side.pass_rows(same));
    Some(counted)
}

/// Executes statements that both sides have next, and counts their events; `None` where these are others, or cannot be
/// executed.
fn count_statements(
    controls: &mut [Exec],
    waiting: &mut [Waiting; 2],
    events: &mut Vec<Event>,
) -> Option<u64> {
    Waiting::unpack(waiting);
    let [first, second] = waiting.each_ref().map(Waiting::rest);
    let both = first.len().min(second.len());
    let (first, second) = (&first[..both], &second[..both]);
    let same = |(a, b): (&Stmt, &Stmt)| a.op == b.op && a.skip == b.skip && a.joined == b.joined;
    if !first.iter().zip(second).all(same) {
        return None;
    }
    let mut many = 0;
    for control in controls {
        many += control.count(first, events).ok()?;
    }
    waiting.iter_mut().for_each(|side| side.pass(both));
    Some(many)
}

/// What holds where further statements are executed, as [`stream`] has it.
fn begin(job: &Job, controls: &mut [Exec], assumed: &Modes, stood: bool) {
    for control in controls {
        control.assume(assumed);
        if !stood {
            control.stand_at(&job.start);
            job.tool_at_start().into_iter().for_each(|tool| control.hold_tool(tool));
        }
    }
}

/// The events of the whole text, with those of its end.
fn end(controls: &mut [Exec], mut many: u64) -> Option<u64> {
    let mut events = Vec::new();
    for control in controls {
        control.no_open_corner().ok()?;
        control.end_of_text(&mut events);
    }
    many += events.len() as u64;
    Some(many)
}

#[derive(Debug)]
enum Done {
    /// The digest, and how many events went into it.
    Executed(u64, u64),
    Refused(Box<Option<Diagnostic>>, bool),
}

impl PartialEq for Done {
    fn eq(&self, other: &Done) -> bool {
        match (self, other) {
            (Done::Executed(a, n), Done::Executed(b, m)) => (a, n) == (b, m),
            (Done::Refused(..), _) | (_, Done::Refused(..)) => false,
        }
    }
}

/// The digest of what a text does, and the skip levels that occur in it.
fn digest(
    job: &Job,
    file: &mut dyn Readable,
    skip: u16,
    assumed: &mut Vec<Diagnostic>,
) -> io::Result<(Done, u16)> {
    let controls: Vec<Exec> =
        worlds(job, clearances(job)).iter().map(|world| Exec::new(world, skip)).collect();
    let mut hashers = vec![DefaultHasher::new(); controls.len()];
    let mut events = 0;
    let course = stream(job, file, controls, &mut |made: Made| {
        for (control, hasher) in made.controls.iter().zip(&mut hashers) {
            events += control.events.len() as u64;
            control.events.iter().for_each(|event| take(event, hasher));
        }
        ControlFlow::Continue(())
    })?;
    assumed.extend(course.diagnostics.iter().cloned());
    if course.refused {
        let no_text = course.diagnostics.iter().any(|d| d.fault == Fault::NotText);
        let is_error = |d: &&Diagnostic| d.fault.gravity() == ncc_ir::diag::Gravity::Error;
        let first = course.diagnostics.iter().find(is_error).cloned();
        return Ok((Done::Refused(Box::new(first), no_text), course.skip_levels));
    }
    let mut all = DefaultHasher::new();
    hashers.iter().for_each(|hasher| hasher.finish().hash(&mut all));
    Ok((Done::Executed(all.finish(), events), course.skip_levels))
}

/// All of an event but its place.
fn take(event: &Event, into: &mut DefaultHasher) {
    let Event { kind, end, rate, state, inch, span: _ } = event;
    std::mem::discriminant(kind).hash(into);
    match kind {
        Kind::Arc { plane, turn, full, centre } => (plane, turn, full, centre).hash(into),
        Kind::Synchronised { pitch, chuck } => (pitch, chuck).hash(into),
        Kind::Probe { to, probe } => (to, probe).hash(into),
        Kind::Dwell(value) | Kind::Orient(value) => value.hash(into),
        Kind::MachineFunction(text) | Kind::Message(text) => text.hash(into),
        Kind::Output(written) => written.hash(into),
        Kind::Alarm(number, text) => (number, text).hash(into),
        Kind::Data(stored) => stored.hash(into),
        Kind::Tilt(plane) => {
            let digits = |part: f64| (part * 1e6).round() as i64;
            plane.as_ref().map(|plane| (plane.origin, plane.axes.map(|row| row.map(digits)))).hash(into);
        }
        Kind::OrientToolAxis(toward) => toward.hash(into),
        Kind::Traverse
        | Kind::Feed
        | Kind::ToolChange
        | Kind::Coolant
        | Kind::ProgramStop
        | Kind::OptionalProgramStop
        | Kind::ProgramEnd
        | Kind::BeginAgain
        | Kind::TextEnd
        // Made only where functions are narrated.
        | Kind::Attribute(_) => {}
    }
    (end, rate, inch).hash(into);
    (state.tool, state.speed, state.spindle, state.flood, state.mist).hash(into);
    (state.tip, state.tilted, state.turned, state.one_side).hash(into);
    (state.compensation.side, state.compensation.radius).hash(into);
    (state.compensation.gap, state.compensation.again).hash(into);
    (
        state.compensation.plane,
        state.advice,
        (state.limit, state.centre),
        state.within,
        state.spindle_mode,
        state.feed_mode,
        state.path,
    )
        .hash(into);
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use ncc_dialects::{Settings, builtin};

    use super::*;
    use crate::source::chunks::PIECE;
    use crate::source::spliced::behind_a_piece;

    const PROGRAM: &str = "%\nO1\nG21 G17 G90 G94 G40 G49 G80\nG54\nT1 M6\nG0 X0. Y0. S500 M3\nG43 H1 Z50.\n\
        G1 Z-1. F100.\nX10.\nX10.\nG2 X20. Y0. I5. J0.\nG1 X21.\n/2 Y5.\n/X3.\nG91 X1.\nG90 G81 Z-3. R2. F80.\nX1. Y2.\nG80\n\
        (END)\nG0 Z50. M9\nM5\nM30\n%\n";

    fn job() -> Job {
        let settings = Settings::new(builtin("fanuc").expect("a built-in dialect"));
        Job::new(settings.clone(), settings, "text")
    }

    fn executed_once(texts: [&str; 2]) -> Option<u64> {
        let [mut before, mut after] = texts.map(|text| Cursor::new(text.as_bytes().to_vec()));
        once(&job(), &mut before, &mut after, &mut Vec::new()).expect("memory")
    }

    /// What both are found to do by their digests.
    fn executed_twice(texts: [&str; 2]) -> Option<u64> {
        let mut events = 0;
        for skip in [0, 0b110] {
            let [a, b] = texts.map(|text| {
                let mut text = Cursor::new(text.as_bytes().to_vec());
                digest(&job(), &mut text, skip, &mut Vec::new()).expect("memory").0
            });
            let Done::Executed(_, many) = a else { return None };
            if a != b {
                return None;
            }
            events += many;
        }
        Some(events)
    }

    #[test]
    fn statements_that_are_the_same_are_executed_once() {
        let laid_out = PROGRAM.replace("X10.\n", "X 10.\n").replace("G1 ", "G01");
        let texts = [PROGRAM, &laid_out];
        let events = executed_once(texts);
        assert!(events.is_some());
        assert_eq!(events, executed_twice(texts));
    }

    /// Whatever word is another one, the texts are not taken for the same.
    #[test]
    fn other_statements_are_not_taken_for_the_same() {
        let words: Vec<(usize, &str)> = PROGRAM.match_indices(['X', 'Y', 'Z', 'F', 'I', 'S']).collect();
        for (at, _) in words {
            let (before, rest) = PROGRAM.split_at(at + 1);
            let other = format!(
                "{before}{}7{}",
                if rest.starts_with('-') { "-" } else { "" },
                rest.trim_start_matches('-')
            );
            assert_eq!(executed_once([PROGRAM, &other]), None, "{other}");
        }
        for (from, to) in
            [("/2", "/3"), ("/2 ", ""), ("M3\n", "M4\n"), ("M9\n", "M9\nX1.\n"), ("X3.\n", "X3.\nG4 P1\n")]
        {
            let other = PROGRAM.replacen(from, to, 1);
            assert_ne!(other, PROGRAM);
            assert_eq!(executed_once([PROGRAM, &other]), None, "{from} as {to}");
        }
    }

    /// Rows of tables: laid out otherwise they are executed once, and count as their statements do; with another word they
    /// are not the same.
    #[test]
    fn rows_are_executed_once_only_where_both_texts_have_them() {
        let head = "G21 G17 G90 G94 G40 G49 G80\nG54\nT1 M6\nG0 X0. Y0. S500 M3\nG43 H1 Z50.\nG1 X0. F100.\n/2 X3.\n/Y1.\n";
        let rows =
            ["G1 X1.", "X2.", "X3. Z5.", "Y4.", "Y4.", "X5. Y1. F90.", "G0 X1.", "Z7."].map(str::to_owned);
        let text = behind_a_piece(head, "G52 X1.", &rows);
        let laid_out = text.replace("X3. Z5.", "X3.Z5.").replace("G0 X1.", "G00X1.");
        assert_ne!(laid_out, text);
        let events = executed_once([&text, &laid_out]);
        assert!(events.is_some());
        assert_eq!(events, executed_twice([&text, &laid_out]));
        for (from, to) in
            [("X3. Z5.", "X3. Z6."), ("X2.", "Y2."), ("F90.", "F91."), ("G0 X1.", "X1."), ("Y4.\n", "")]
        {
            // In the piece after the first one.
            let at = PIECE + text[PIECE..].find(from).expect("a row");
            let other = format!("{}{to}{}", &text[..at], &text[at + from.len()..]);
            assert_eq!(executed_once([&text, &other]), None, "{from} as {to}");
        }
    }

    /// A program that is kept whole, or cannot be executed, is left to the digests.
    #[test]
    fn what_is_not_executed_in_one_way_is_left_to_digests() {
        let called = PROGRAM.replace("M5\n", "M98 P2\nM5\n").replace("M30\n%", "M30\nO2\nM99\n%");
        assert_eq!(executed_once([&called, &called]), None);
        let refused = PROGRAM.replace("F100.", "");
        assert_eq!(executed_once([&refused, &refused]), None);
        let unread = PROGRAM.replace("X10.\n", "X10. =\n");
        assert_eq!(executed_once([&unread, &unread]), None);
    }
}
