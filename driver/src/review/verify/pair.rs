//! A pair of programs executed and compared, as strictly as a translation compares what it has written:
//! in the same generated worlds, under the same settings of the block-skip switches.
//!
//! What the source relies on and never says is assumed of it. Of the output it is not: what
//! it leaves unsaid is known only where its dialect or its machine's profile settles it, or where a
//! translation would leave it unsaid too (`shared`); about everything else the worlds disagree. Each
//! side runs on a thread of its own and hands its events over in pieces, so that memory does not grow
//! with the programs; two that stream are executed in step (`in_step`), as long as they make the same.
//! Not here: words (`text`), what is written down (`document`).

use std::io;
use std::ops::ControlFlow;

use ncc_dialects::SafeStart;
use ncc_exec::verify::{Comparison, Deviation, Difference, Resolution};
use ncc_exec::world::World;
use ncc_exec::{Event, Exec, Seen};
use ncc_ir::canon::{AXES, Distance, FeedMode, Modes, Plane, Units};
use ncc_ir::diag::{Diagnostic, Gravity};
use ncc_ir::expr::num::Nanos;

use super::in_step;
use super::plan::Plan;
use crate::job::Job;
use crate::machines::pair::Machines;
use crate::problem::BrokenOff;
use crate::review::stream::{Course, Stage, Unsaid, clearances, look, stream, stream_as};
use crate::side::Side;
use crate::side_by_side::{self, Pieces, Take};
use crate::verify_run::controls::{alarms_of, fixed, resolution, writes};
use crate::verify_run::{WORLDS, stops_differ, worlds_of};

/// Events of a piece that a side hands over.
const PIECE: usize = 4096;
/// Pieces that a side may be ahead.
const AHEAD: usize = 4;
/// Levels of block skip of which every setting is tried; of more, each alone, pairs, and all.
const ALL_SETTINGS: u32 = 6;

/// Verdict of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The same, to half the coarser side's least increment.
    Equal,
    /// The same within the tolerance that was asked for.
    WithinTolerance,
    /// Not the same.
    Different,
    /// One of them cannot be read or executed.
    NotCompared,
}

/// Everything that was found.
#[derive(Debug)]
pub struct Found {
    pub(crate) verdict: Verdict,
    /// What became of both programs, the output read as a source of its own; with what its execution
    /// refused.
    pub courses: [Course; 2],
    /// Facts that the output may leave unsaid, because they hold of it as of the source.
    pub shared: Modes,
    /// Events compared, over all worlds and settings.
    pub events: u64,
    /// Settings of the block-skip switches that were tried.
    pub settings: u32,
    /// Levels of block skip of which not every setting was tried.
    pub sampled: Option<u8>,
    /// Within how much places are one.
    pub resolution: Resolution,
    /// Whether one of the programs is in inches.
    pub inches: bool,
    /// The largest deviation.
    pub deviation: Option<Deviation>,
    /// Whether something is further apart than half the output's own least increment.
    pub coarse: bool,
    /// The first difference, and the switches of the source's control under which it shows.
    pub first: Option<(Difference, u16)>,
    /// Whether messages were left out, because one control has none.
    pub muted: bool,
    /// Parameters of cycles that were assumed of both controls.
    pub parameters: bool,
}

/// Source and output as one job.
pub fn job_of(sides: &[Side; 2]) -> Job {
    let [a, b] = sides;
    let machines = Machines { from: a.job.machines.from.clone(), to: b.job.machines.from.clone() };
    Job { to: b.job.from.clone(), machines, ..a.job.clone() }
}

/// Compares.
///
/// # Errors
/// Reading the programs.
pub fn compare(sides: &mut [Side; 2], tolerance: Nanos) -> io::Result<Found> {
    let job = job_of(sides);
    let looked = |side: &mut Side| look(&side.job, &mut side.source.file);
    let courses = [looked(&mut sides[0])?, looked(&mut sides[1])?];
    let in_inches = [&courses[0], &courses[1]]
        .map(|course| course.has.inches || course.assumed.units == Some(Units::Inch));
    let one_control = same_control(sides);
    let (caps, other) = (&sides[0].dialect().caps, &sides[1].dialect().caps);
    let muted = !caps.modes.messages || !other.modes.messages;
    // With how many digits one side's values stand in messages that have zeros at their end.
    let in_full = (courses.iter().all(|course| course.has.values)).then(|| {
        let digits = |side: &Side| side.job.from.caps().flow.computes.and_then(|own| own.values_in_full);
        sides.iter().find_map(digits)
    });
    let says = courses.iter().any(|course| course.has.messages);
    let levels = [courses[0].skip_levels, courses[1].skip_levels];
    let one_level = other.flow.skip_levels <= 1;
    let settings = settings(levels, one_level);
    let most = (levels[0] | levels[1]).count_ones();
    let all = !one_level && most <= ALL_SETTINGS || most <= 1;
    let mut found = Found {
        verdict: Verdict::NotCompared,
        shared: shared(&job, &courses[0], one_control),
        events: 0,
        settings: 0,
        sampled: (!all).then_some(most as u8),
        resolution: coarser(&resolution(&job.from), &resolution(&job.to)),
        inches: in_inches[0] || in_inches[1],
        deviation: None,
        coarse: false,
        first: None,
        muted: muted && says,
        parameters: courses.iter().any(|course| course.has.chips),
        courses,
    };
    if found.courses.iter().any(|course| course.refused) {
        return Ok(found);
    }
    let mut worlds: Vec<[World; 2]> = (1..=WORLDS).map(|seed| worlds_of(&job, seed)).collect();
    // The source's parameters of cycles hold of both controls, as for a translation.
    let own = clearances(&job);
    let theirs = clearances(&sides[1].job);
    for world in worlds.iter_mut().flatten() {
        world.peck_clearance = own[0].or(theirs[0]).unwrap_or(world.peck_clearance);
        world.break_lift = own[1].or(theirs[1]).unwrap_or(world.break_lift);
    }
    let starts = starts(sides, &worlds)?;
    let plan = Plan {
        worlds,
        starts,
        tool: sides[0].job.tool_at_start(),
        muted,
        in_full: in_full.flatten(),
        writes: sides.iter().all(|side| writes(&side.job.from)),
        stops_speak: caps.shows_at_stops() && other.shows_at_stops(),
        lines: job.from.dialect.can.flat || job.to.dialect.can.flat,
        between_controls: job.between_controls(),
        unsaid: Unsaid::Only(found.shared),
        // What stands in inches on one side alone is compared as inches are.
        in_inches: in_inches[0],
        tolerance,
        resolution: found.resolution,
        own: resolution(&job.to),
        tools: job.machines.renaming(),
        alarms: alarms_of(&job.to),
        optional_stops: stops_differ(&job),
        seen: Seen::by(&job.from.dialect.caps).both(Seen::by(&job.to.dialect.caps)),
    };
    let streams = found.courses.iter().all(|course| !course.whole);
    let mut beyond = false;
    for skip in settings {
        found.settings += 1;
        let done = executed(sides, &plan, skip, streams)?;
        found.events += done.events;
        found.coarse |= done.coarse;
        if let Some((deviation, over)) = done.deviation {
            beyond |= over;
            if deviation.by > found.deviation.map_or(0, |farthest| farthest.by) {
                found.deviation = Some(deviation);
            }
        }
        if done.refused.iter().any(|refused| !refused.is_empty()) {
            for (course, refused) in found.courses.iter_mut().zip(done.refused) {
                course.refused |= !refused.is_empty();
                course.diagnostics.extend(refused);
            }
            return Ok(found);
        }
        if let Some(difference) = done.difference {
            found.first = Some((*difference, skip[0]));
            found.verdict = Verdict::Different;
            return Ok(found);
        }
    }
    found.verdict = if beyond { Verdict::WithinTolerance } else { Verdict::Equal };
    Ok(found)
}

/// Whether both programs are for one control: the same dialect with the same options, and the same
/// machine, if one is named. What neither says is then one and the same fact. (Two profiles may have one
/// name: what they state of the control at power-on must be the same too.)
fn same_control(sides: &[Side; 2]) -> bool {
    let [a, b] = sides;
    let machine = |side: &Side| side.job.machines.from.as_ref().map(|machine| machine.id().to_owned());
    let (own, other) = (&a.job.from, &b.job.from);
    let mut options = own.dialect.option.iter();
    own.dialect.id == other.dialect.id
        && machine(a) == machine(b)
        && fixed(own.dialect) == fixed(other.dialect)
        && options.all(|option| own.get(&option.name) == other.get(&option.name))
}

/// Facts that hold of the output's control although the output does not say them: what the source
/// relies on without saying it, where a translation into the output's dialect would not say it either,
/// or where both are for one control; and what a control lacks. In the output's numbers.
fn shared(job: &Job, source: &Course, one_control: bool) -> Modes {
    let facts = job.machines.maps(job.to.dialect).modes(&source.assumed);
    if one_control {
        return facts;
    }
    let caps = job.to.caps();
    let only =
        source.assumed.work_offset.or(source.has.work_offset).filter(|_| caps.frames.work_offsets == 0);
    let no_shift = (!caps.frames.clears_shift && source.has.clears_shift).then_some(true);
    let facts = facts.without(&said_by_custom(job));
    Modes {
        work_offset: only.or(facts.work_offset),
        no_origin_shift: no_shift.or(facts.no_origin_shift),
        ..facts
    }
}

/// Facts that a translation into the output's dialect says at the latest before the first event, or
/// that always hold there. Of their values nothing is stated.
fn said_by_custom(job: &Job) -> Modes {
    let (from, to) = (fixed(job.from.dialect), fixed(job.to.dialect));
    let mut said = to;
    for row in &job.to.dialect.safe_start {
        match row {
            SafeStart::Units => said.units = Some(Units::Mm),
            SafeStart::Plane => said.plane = Some(Plane::Xy),
            SafeStart::Distance => said.distance = Some(Distance::Absolute),
            SafeStart::FeedMode => said.feed_mode = Some(FeedMode::PerMinute),
            SafeStart::NoLengthOffset => said.length_offset = Some(0),
            SafeStart::WorkOffset => said.work_offset = Some(1),
            SafeStart::NoCompensation | SafeStart::NoCycle | SafeStart::Centre => {}
        }
    }
    if job.to.dialect.safe_start.is_empty() && !job.to.dialect.can.everything {
        said.distance = said.distance.or(from.distance);
        said.units = said.units.or(from.units);
        said.plane = said.plane.or(from.plane);
    }
    said
}

/// What both resolve.
fn coarser(a: &Resolution, b: &Resolution) -> Resolution {
    Resolution {
        mm: a.mm.min(b.mm),
        inch: a.inch.min(b.inch),
        degree: a.degree.min(b.degree),
        feed: a.feed.min(b.feed),
        feed_inch: a.feed_inch.min(b.feed_inch),
        second: a.second.min(b.second),
        speed: a.speed.min(b.speed),
    }
}

/// Settings of the switches of both controls, all off first.
fn settings([a, b]: [u16; 2], one_level: bool) -> Vec<[u16; 2]> {
    let levels = a | b;
    if levels == 0 {
        return vec![[0; 2]];
    }
    if one_level {
        // Bit 1 is the level of a control that has one only.
        return vec![[0; 2], [levels, levels | 1 << 1]];
    }
    let many = levels.count_ones() > ALL_SETTINGS;
    (0..=u16::MAX)
        .filter(|skip| skip & !levels == 0)
        .filter(|skip| !many || skip.count_ones() <= 2 || *skip == levels)
        .map(|skip| [skip; 2])
        .collect()
}

/// Where the machines stand before the first event, by world: where the source's tool does.
fn starts(sides: &mut [Side; 2], worlds: &[[World; 2]]) -> io::Result<Vec<[Nanos; AXES]>> {
    let mut starts: Vec<[Nanos; AXES]> = worlds.iter().map(|[source, _]| source.start).collect();
    let source = &mut sides[0];
    if source.job.start.iter().any(Option::is_some) {
        let controls = worlds.iter().map(|[source, _]| Exec::new(source, 0)).collect();
        stream(&source.job, &mut source.source.file, controls, &mut |made| {
            starts = made.controls.iter().map(|control| control.exec.machine()).collect();
            ControlFlow::Break(())
        })?;
    }
    Ok(starts)
}

/// What a side hands over.
struct Piece {
    /// Events of every world.
    events: Vec<Vec<Event>>,
    /// Whether the program is over.
    over: bool,
}

/// What one setting of the switches gave.
struct Done {
    events: u64,
    deviation: Option<(Deviation, bool)>,
    coarse: bool,
    difference: Option<Box<Difference>>,
    /// What the execution of either side refused.
    refused: [Vec<Diagnostic>; 2],
}

impl Done {
    /// Of comparisons that have reached the end.
    fn of(comparisons: &[Comparison]) -> Done {
        let deviations = comparisons.iter().filter_map(Comparison::deviation);
        Done {
            events: comparisons.iter().map(|comparison| comparison.events).sum(),
            deviation: deviations.reduce(|a, b| {
                let farthest = if b.0.by > a.0.by { b.0 } else { a.0 };
                (farthest, a.1 || b.1)
            }),
            coarse: comparisons.iter().any(Comparison::coarse),
            difference: None,
            refused: Default::default(),
        }
    }
}

/// Executes and compares under one setting: in step where both programs stream and make the same.
fn executed(sides: &mut [Side; 2], plan: &Plan, skip: [u16; 2], streams: bool) -> io::Result<Done> {
    if streams && let Some(comparisons) = in_step::once(sides, plan, skip)? {
        return Ok(Done::of(&comparisons));
    }
    once(sides, plan, skip)
}

fn once(sides: &mut [Side; 2], plan: &Plan, skip: [u16; 2]) -> io::Result<Done> {
    let [a, b] = sides;
    let first = |take: Take<Piece>| hand_over(a, Unsaid::Taken, plan.controls(0, skip[0]), take);
    let second = |take: Take<Piece>| hand_over(b, plan.unsaid, plan.controls(1, skip[1]), take);
    let (found, courses) = side_by_side::run(first, second, AHEAD, |pieces| together(pieces, plan));
    let (comparisons, difference, over) = found;
    let broke_off = || io::Error::other(BrokenOff::Side);
    let joined = |course: Option<io::Result<Course>>| -> io::Result<Vec<Diagnostic>> {
        let errors = course.unwrap_or_else(|| Err(broke_off()))?.diagnostics.into_iter();
        Ok(errors.filter(|d| d.fault.gravity() == Gravity::Error).collect())
    };
    // What was found before a side broke off counts.
    let [first, second] = courses;
    let mut refused = [joined(first)?, joined(second)?];
    if difference.is_some() {
        refused = [Vec::new(), Vec::new()];
    } else if !over && refused.iter().all(Vec::is_empty) {
        return Err(broke_off());
    }
    Ok(Done { difference, refused, ..Done::of(&comparisons) })
}

/// Executes a side and hands its events over.
fn hand_over(side: &mut Side, unsaid: Unsaid, controls: Vec<Exec>, take: Take<Piece>) -> io::Result<Course> {
    let mut events: Vec<Vec<Event>> = vec![Vec::new(); controls.len()];
    let Side { source, job } = side;
    stream_as(job, &mut source.file, unsaid, controls, &mut |made| {
        for (events, control) in events.iter_mut().zip(made.controls) {
            events.extend_from_slice(&control.events);
        }
        let over = matches!(made.stage, Stage::End);
        if !over && events.iter().all(|events| events.len() < PIECE) {
            return ControlFlow::Continue(());
        }
        let next = vec![Vec::new(); events.len()];
        take(Piece { events: std::mem::replace(&mut events, next), over })
    })
}

/// Compares the events of both sides as they come; ends with the first difference, or where a side ends
/// without being over. Says last whether both are over, so that all of both was compared.
fn together(mut from: [Pieces<Piece>; 2], plan: &Plan) -> (Vec<Comparison>, Option<Box<Difference>>, bool) {
    let mut comparisons = plan.comparisons();
    let mut waiting: Vec<[Vec<Event>; 2]> = vec![Default::default(); comparisons.len()];
    let mut over = [false; 2];
    loop {
        for side in [0, 1] {
            if over[side] || waiting.iter().all(|events| !events[side].is_empty()) {
                continue;
            }
            let Some(piece) = from[side]() else { return (comparisons, None, false) };
            over[side] = piece.over;
            for (events, mut new) in waiting.iter_mut().zip(piece.events) {
                events[side].append(&mut new);
            }
        }
        for (comparison, [source, target]) in comparisons.iter_mut().zip(&mut waiting) {
            let compared = comparison.advance(source, target, false).and_then(|()| {
                // What is left of one side when the other is over must be nothing.
                let rest = over[0] && source.is_empty() || over[1] && target.is_empty();
                if rest { comparison.advance(source, target, true) } else { Ok(()) }
            });
            if let Err(difference) = compared {
                return (comparisons, Some(difference), false);
            }
        }
        if over == [true; 2] {
            return (comparisons, None, true);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_of_switches() {
        assert_eq!(settings([0, 0], false), [[0, 0]]);
        assert_eq!(settings([0b10, 0b100], false), [[0; 2], [0b10; 2], [0b100; 2], [0b110; 2]]);
        assert_eq!(settings([0b1100, 0], true), [[0; 2], [0b1100, 0b1110]]);
        assert_eq!(settings([0b1111_1110, 0], false).len(), 1 + 7 + 21 + 1);
    }
}
