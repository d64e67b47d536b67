//! Assumptions of a time estimate, as short lines of its summary: `rapid rate of X Y = …`, `G54 is machine zero`.
//!
//! Five groups: the program, the run, the profile, the machine and the tables of offsets and lengths.
//! Not here: the estimate itself (`drive`), and the texts (`messages/time`).

use ncc_ir::canon::{AXES, Axis};
use ncc_ir::diag::{Diagnostic, Fault, Gravity, Verdict};
use ncc_ir::unsupported::left_out::LeftOut;
use ncc_machines::Profile;
use ncc_time::{AssumedFact, Fact, Model, WHOLE_PATH};

use super::drive::{Course, Plan};
use super::duration::short;
use super::modes::Length;
use crate::job::Job;
use crate::render::head::assumption;
use crate::render::messages::message::{Message, Part};
use crate::render::messages::words::{Context, unreachable, words};
use crate::render::spelled;

/// Assumptions of the front-end about the program and its control. Each line appears once.
pub fn of_program(job: &Job, diagnostics: &[Diagnostic]) -> Vec<String> {
    let dialects = [job.from.dialect, job.to.dialect];
    let assumed = diagnostics.iter().filter(|d| d.fault.gravity() == Gravity::Verdict(Verdict::Assumed));
    let mut lines: Vec<String> = Vec::new();
    for line in assumed.filter_map(|d| assumption(&d.fault, dialects)) {
        if !lines.contains(&line) {
            lines.push(line);
        }
    }
    for diagnostic in diagnostics {
        if let Fault::CodeLeftOut { what: LeftOut::RapidRate { code } } = &diagnostic.fault {
            let line = Message::part(Part::Time, "rapid-rate").text("code", &**code).headline();
            if !lines.contains(&line) {
                lines.push(line);
            }
        }
    }
    lines
}

/// Assumptions about the run: its start position, block skip, operator stops, tilted planes, contours and tables.
pub fn of_run(plan: &Plan, course: &Course) -> Vec<String> {
    let mut lines = Vec::new();
    let silent: Vec<String> = Axis::ALL
        .into_iter()
        .filter(|axis| {
            plan.job.start[*axis as usize].is_none() && (!axis.is_rotary() || course.moved[*axis as usize])
        })
        .map(letter)
        .collect();
    if !silent.is_empty() {
        lines.push(Message::part(Part::Time, "start").text("axes", silent.join(" ")).headline());
    }
    let off: Vec<String> = (1..16)
        .filter(|level| course.skip_levels >> level & 1 == 1 && plan.skip >> level & 1 == 0)
        .map(|level| level.to_string())
        .collect();
    if !off.is_empty() {
        let count = u64::try_from(off.len()).unwrap_or(u64::MAX);
        lines.push(
            Message::part(Part::Time, "skip-off")
                .count("count", count)
                .text("levels", off.join(", "))
                .headline(),
        );
    }
    if course.stops {
        lines.push(Message::part(Part::Time, "stops").headline());
    }
    if course.turns_onto_planes {
        lines.push(Message::part(Part::Time, "tilt").headline());
    }
    if course.tip {
        lines.push(Message::part(Part::Time, "tip").headline());
    }
    lines.extend(of_contours(plan, course));
    lines.extend(of_offsets(plan, course));
    lines.extend(of_lengths(plan, course));
    lines
}

/// Assumptions about contours under cutter compensation: timed on the tool centre path or as programmed.
fn of_contours(plan: &Plan, course: &Course) -> Vec<String> {
    if !course.compensates {
        return Vec::new();
    }
    if !plan.centre {
        return vec![Message::part(Part::Time, "contours").headline()];
    }
    let mut lines: Vec<String> = Vec::new();
    let mut unknown: Vec<String> = Vec::new();
    let mut edge = false;
    for (line, fault) in &course.as_programmed {
        match fault {
            Fault::RadiusUnknown { entry: Some(entry) } => unknown.push(format!("D{entry}")),
            Fault::RadiusUnknown { entry: None } => edge = true,
            Fault::ContourUnreachable { why } => lines.push(from_line(*line, Some(unreachable(*why)))),
            Fault::TargetLacks { .. } | Fault::NotExecuted { .. } => {
                let dialect = plan.job.from.dialect;
                let at = Context { from: dialect, to: dialect, snippet: "", beside: ("", "") };
                lines.push(from_line(*line, Some(words(fault, at).message)));
            }
            _ => lines.push(from_line(*line, None)),
        }
    }
    unknown.sort();
    unknown.dedup();
    if edge {
        lines.insert(0, Message::part(Part::Time, "edge-radius").headline());
    }
    if !unknown.is_empty() {
        lines.insert(0, Message::part(Part::Time, "radius").text("entries", unknown.join(", ")).headline());
    }
    lines.dedup();
    if !plan.job.compensating().known && course.follows_centre {
        lines.push(Message::part(Part::Time, "outer-corners").headline());
    }
    lines
}

/// The first line whose contour is timed as programmed, with the reason if ncc knows it.
fn from_line(line: u32, why: Option<String>) -> String {
    match why {
        Some(why) => Message::part(Part::Time, "as-programmed-why").text("why", why),
        None => Message::part(Part::Time, "as-programmed"),
    }
    .text("line", line.to_string())
    .headline()
}

/// Assumptions about the table of work offsets. A program with one work offset and no machine coordinates needs
/// none.
fn of_offsets(plan: &Plan, course: &Course) -> Vec<String> {
    if course.offsets.len() < 2 && !course.in_machine {
        return Vec::new();
    }
    let table = &plan.tables.work_offsets;
    if !course.offsets.iter().any(|number| table.contains_key(number)) {
        let message = match (course.offsets.first(), course.in_machine) {
            (Some(only), _) if course.offsets.len() == 1 => {
                Message::part(Part::Time, "offset-zero").text("offset", offset(plan, *only))
            }
            (_, true) => Message::part(Part::Time, "offsets-zero"),
            (_, false) => Message::part(Part::Time, "offsets-equal"),
        };
        return vec![message.headline()];
    }
    let silent = |number: &u16| -> Vec<String> {
        let stated = table.get(number).copied().unwrap_or_default();
        let open = |axis: &Axis| {
            (!axis.is_rotary() || course.moved[*axis as usize]) && stated[*axis as usize].is_none()
        };
        Axis::ALL.into_iter().filter(open).map(letter).collect()
    };
    let open = course.offsets.iter().map(|number| (*number, silent(number)));
    open.filter(|(_, axes)| !axes.is_empty())
        .map(|(number, axes)| {
            let message = Message::part(Part::Time, "offset-axes").text("offset", offset(plan, number));
            message.text("axes", axes.join(" ")).headline()
        })
        .collect()
}

fn offset(plan: &Plan, number: u16) -> String {
    spelled::work_offset(number, [plan.job.from.dialect, plan.job.to.dialect])
}

/// Assumptions about the table of tool lengths. A program without a tool length offset needs none.
fn of_lengths(plan: &Plan, course: &Course) -> Vec<String> {
    let is_stated = |length: &Length| match length {
        Length::Entry(entry) => plan.tables.lengths.contains_key(entry),
        Length::Edge(..) => false,
    };
    let used: Vec<&Length> = course.lengths.iter().filter(|length| **length != Length::Entry(0)).collect();
    if used.is_empty() {
        return Vec::new();
    }
    if !used.iter().any(|length| is_stated(length)) {
        return vec![Message::part(Part::Time, "lengths-equal").headline()];
    }
    let open = used.into_iter().filter(|length| !is_stated(length));
    open.map(|length| match length {
        Length::Entry(entry) => {
            let tool = plan.tables.edge_entries.iter().find(|(_, own)| *own == entry);
            Message::part(Part::Time, "length").text("tool", tool.map_or(entry, |(tool, _)| tool).to_string())
        }
        Length::Edge(tool, edge) if *tool < 0 => {
            Message::part(Part::Time, "length-edge-at-start").text("edge", edge.to_string())
        }
        Length::Edge(tool, edge) => Message::part(Part::Time, "length-edge")
            .text("edge", edge.to_string())
            .text("tool", tool.to_string()),
    })
    .map(|message| message.headline())
    .collect()
}

/// Machine facts that the profile marks as assumed. A typical profile gives one line for all.
pub fn of_profile(profile: &Profile) -> Vec<String> {
    if profile.schema.typical {
        return vec![Message::part(Part::Time, "typical").headline()];
    }
    let mut marked: Vec<(&'static str, Vec<String>)> = Vec::new();
    let of_time = ["[rates]", "[times]", "[spindle]", "[[axis]]"];
    for row in profile.rows().into_iter().filter(|row| of_time.contains(&row.head)) {
        let axis = row.facts.iter().find(|fact| fact.key == "letter").and_then(|fact| fact.value.clone());
        for fact in row.facts.iter().filter(|fact| fact.assumed && fact.value.is_some()) {
            match marked.iter_mut().find(|(key, axes)| *key == fact.key && axis.is_some() && !axes.is_empty())
            {
                Some((_, axes)) => axes.extend(axis.clone()),
                None => marked.push((fact.key, axis.clone().into_iter().collect())),
            }
        }
    }
    let word = |(key, axes): &(&str, Vec<String>)| match axes.as_slice() {
        [] => (*key).to_owned(),
        axes => format!("{key} of {}", axes.join(" ")),
    };
    match marked.as_slice() {
        [] => Vec::new(),
        marked => {
            let words: Vec<String> = marked.iter().map(word).collect();
            vec![Message::part(Part::Time, "marked").text("facts", words.join(", ")).headline()]
        }
    }
}

/// Machine facts that the profile lacks, with the value that the model uses. Axes that never move are left out.
pub fn of_machine(plan: &Plan, facts: &[AssumedFact], course: &Course) -> Vec<String> {
    let moved = &course.moved;
    let machine = &plan.machine;
    let needed = |fact: &&AssumedFact| match fact.fact {
        Fact::ExactStop => course.corners.unsaid,
        Fact::PathTolerance => course.corners.unsaid || course.corners.open,
        _ => true,
    };
    let facts: Vec<AssumedFact> = facts.iter().filter(needed).copied().collect();
    let mut lines = in_words(&facts, moved);
    if plan.model != Model::Ideal && course.corners.open {
        let tolerance = machine.path_tolerance.unwrap_or_default();
        lines.push(
            Message::part(Part::Time, "path-tolerance").text("tolerance", short(tolerance, 3)).headline(),
        );
    }
    if plan.model == Model::Ideal && course.bounds.is_some() {
        // The upper bound needs accelerations; the ideal model does not.
        let (_, all) = machine.assumed(Model::Trapezoidal);
        let needed: Vec<AssumedFact> = all.into_iter().filter(|f| f.fact == Fact::Acceleration).collect();
        lines.extend(
            in_words(&needed, moved)
                .into_iter()
                .map(|line| Message::part(Part::Time, "bound").text("fact", line).headline()),
        );
    }
    lines
}

/// Text of a machine fact, without its value: `rapid rate`.
fn fact_words(fact: Fact) -> String {
    let form = match fact {
        Fact::RapidRate => "fact-rapid-rate",
        Fact::Acceleration => "fact-acceleration",
        Fact::Jerk => "fact-jerk",
        Fact::PathTolerance => "fact-path-tolerance",
        Fact::ExactStop => "fact-exact-stop",
        Fact::ToolChange => "fact-tool-change",
        Fact::SpindleStart => "fact-spindle-start",
        Fact::SpindleStop => "fact-spindle-stop",
        Fact::MFunction => "fact-m-function",
        Fact::Block => "fact-block",
        Fact::LookAhead => "fact-look-ahead",
    };
    Message::part(Part::Time, form).headline()
}

fn in_words(facts: &[AssumedFact], moved: &[bool; AXES]) -> Vec<String> {
    let mut lines: Vec<(String, Vec<String>, String)> = Vec::new();
    for fact in facts {
        if fact.axis.is_some_and(|axis| !moved[axis as usize]) {
            continue;
        }
        let name = fact_words(fact.fact);
        let value = match fact.fact.unit(fact.axis) {
            "" if fact.value == 0.0 => "no".to_owned(),
            "" => "yes".to_owned(),
            _ if fact.fact == Fact::LookAhead && fact.value >= f64::from(WHOLE_PATH) => {
                Message::part(Part::Time, "whole-path").headline()
            }
            unit => format!("{} {unit}", short(fact.value, 3)),
        };
        let axis = fact.axis.map(letter);
        match lines.last_mut().filter(|(n, axes, v)| *n == name && *v == value && !axes.is_empty()) {
            Some((_, axes, _)) => axes.extend(axis),
            None => lines.push((name, axis.into_iter().collect(), value)),
        }
    }
    let line = |(name, axes, value): (String, Vec<String>, String)| match axes.as_slice() {
        [] => format!("{name} = {value}"),
        axes => format!("{name} of {} = {value}", axes.join(" ")),
    };
    lines.into_iter().map(line).collect()
}

fn letter(axis: Axis) -> String {
    (axis.letter() as char).to_string()
}
