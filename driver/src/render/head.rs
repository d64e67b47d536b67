//! The comment that opens an emitted program: source and hash, verified or not, assumptions. The
//! operator at the machine never sees what the command line printed.

use std::collections::BTreeSet;

use ncc_dialects::Dialect;
use ncc_ir::diag::{Diagnostic, Fault, Gravity, ModeName, Verdict};
use ncc_ir::program::Text;
use ncc_ir::program::numbered::Numbered;

use crate::job::Job;
use crate::questions::Question;
use crate::render::numbers::given_number;
use crate::render::{numbers, questions, spelled};

/// The lines of the comment.
pub fn lines(
    job: &Job,
    hash: &[u8; 32],
    questions: &[Question],
    diagnostics: &[Diagnostic],
    renumbered: &BTreeSet<(Numbered, Text, Text)>,
) -> Vec<String> {
    let hash: String = hash[..4].iter().map(|b| format!("{b:02x}")).collect();
    let verified = if job.verify { "verified" } else { "UNVERIFIED" };
    let mut lines =
        vec![format!("ncc: {} {} sha256 {hash}, {verified}", job.from.dialect.id, job.source_name)];
    if let Some(project) = &job.project {
        lines.push(project.line());
    }
    for file in job.called.iter().flat_map(|called| &called.files) {
        let hash: String = file.sha256[..4].iter().map(|b| format!("{b:02x}")).collect();
        let name = std::path::Path::new(&file.name).file_name();
        let name = name.map_or(file.name.clone().into(), |name| name.to_string_lossy());
        lines.push(format!("called: {name} sha256 {hash}"));
    }
    if !questions.is_empty() {
        let own: Vec<String> = questions.iter().map(questions::taken).collect();
        lines.push(format!("not answered: {}", own.join("; ")));
    }
    let dialects = [job.to.dialect, job.from.dialect];
    let mut seen = BTreeSet::new();
    let assumed: Vec<String> = diagnostics
        .iter()
        .filter(|d| d.fault.gravity() == Gravity::Verdict(Verdict::Assumed))
        .filter_map(|d| assumption(&d.fault, dialects))
        .filter(|text| seen.insert(text.clone()))
        .collect();
    if !assumed.is_empty() {
        lines.push(format!("assumed: {}", assumed.join("; ")));
    }
    lines.extend(by_name(renumbered, "to"));
    lines
}

/// What was renumbered, a line for each kind: `tools by name: 3 to 7, 4 to 1`.
pub fn by_name(renumbered: &BTreeSet<(Numbered, Text, Text)>, arrow: &str) -> Vec<String> {
    let line = |what: Numbered| {
        let mut own: Vec<&(Numbered, Text, Text)> = renumbered.iter().filter(|row| row.0 == what).collect();
        own.sort_by_key(|(_, from, _)| (from.len(), from.clone()));
        let pairs: Vec<String> = own.iter().map(|(_, from, to)| format!("{from} {arrow} {to}")).collect();
        (!pairs.is_empty()).then(|| format!("{} by name: {}", numbers::numbered(what, 2), pairs.join(", ")))
    };
    Numbered::ALL.into_iter().filter_map(line).collect()
}

/// An assumption in the few words that fit a program's head; `None` for what is none. A work offset
/// is named by the first of the dialects that has a word for it.
pub fn assumption(fault: &Fault, dialects: [&Dialect; 2]) -> Option<String> {
    Some(match fault {
        Fault::AssumedMode { fact, value } => match fact {
            ModeName::Motion => format!("motion = {value}"),
            ModeName::Distance => format!("start in {value} mode"),
            ModeName::Units => format!("units = {value}"),
            ModeName::Plane => format!("plane = {value}"),
            ModeName::FeedMode => format!("feed {value}"),
            ModeName::ReturnLevel => format!("cycles return to {value}"),
            ModeName::WorkOffset => match value.parse() {
                Ok(number) => format!("work offset = {}", spelled::work_offset(number, dialects)),
                Err(_) => format!("work offset = {value}"),
            },
            ModeName::LengthOffset => "no length offset at the start".to_owned(),
            ModeName::OriginShift => "no origin shift at the start".to_owned(),
        },
        Fault::AssumedNoEffect { code } => format!("{code} has no effect"),
        Fault::AssumedBareNumber { word, value } => format!("{word} without point = {value}"),
        Fault::AssumedOffsetWithZ => "length offset taken up with the next Z".to_owned(),
        Fault::AssumedWorkOffset { offset } => {
            format!("the only work offset = {}", spelled::work_offset(*offset, dialects))
        }
        Fault::AssumedRow { code, meaning } => {
            format!("{code} = {}", spelled::row_meaning(code, meaning, dialects))
        }
        Fault::AssumedOption { option, value } => format!("{option} = {value}"),
        Fault::AssumedParameter { parameter, value } => format!("{parameter} = {value}"),
        // The head has a line of its own about them.
        Fault::ToolNumbered { .. } => return None,
        Fault::AssumedHoleOrder { pattern } => format!("order of the holes of {pattern}"),
        Fault::AssumedPath { path } => format!("corners always by {path}"),
        Fault::AssumedMilling { looks_like, line } => {
            format!("a milling program, though line {line} looks like {looks_like}")
        }
        Fault::AssumedTip => {
            "rotary axes, and the zero of the tool's tip, as on the other control".to_owned()
        }
        Fault::AssumedToolChange { .. } => "tool_with_change = named".to_owned(),
        Fault::CallDepth { depth, sure, macros } => {
            format!("{} go {depth} deep, older controls take {sure}", numbers::calls(*macros))
        }
        Fault::AssumedCycle { .. } => "cycle_beside_motion = drilled".to_owned(),
        Fault::AssumedReturn { .. } => "return_distance = last".to_owned(),
        Fault::AssumedControl { taken, other } => format!("control = {taken}, not {other}"),
        Fault::AssumedTilt => "the tool turned onto tilted planes as on the other control".to_owned(),
        Fault::AssumedContourPath => "compensation worked out as RS274/NGC has it".to_owned(),
        Fault::StartedAgain { behaviour } => {
            format!("{}: started again before the next cut", behaviour.about())
        }
        Fault::OpenBehaviour { behaviour, source, taken, .. } => {
            let [to, from] = dialects.map(|dialect| dialect.id.as_str());
            format!("{} = {taken} on {}", behaviour.option(), if *source { from } else { to })
        }
        Fault::OptionalStopDiffers => "the switch for optional stops is off".to_owned(),
        Fault::PathAtStart { source, target } => {
            let [to, from] = dialects.map(|dialect| dialect.id.as_str());
            format!("no path mode is programmed: corners {source} on {from}, {target} on {to}")
        }
        Fault::NextRunShifted { axis, .. } => {
            format!("no shift of {} at the start, though the program leaves one", char::from(axis.letter()))
        }
        Fault::NextRunTurned => {
            "no rotation, scale or mirror at the start, though the program leaves one".to_owned()
        }
        Fault::NextRunVariables { names, source, target } => {
            let [to, from] = dialects.map(|dialect| dialect.id.as_str());
            let [source, target] = [*source, *target].map(spelled::kept);
            format!("{} kept {source} on {from}, {target} on {to}", spelled::variables(names))
        }
        Fault::RoundsFreely => "corners rounded without a tolerance".to_owned(),
        Fault::FeedOnArcs { contour_in_source, .. } => {
            let [to, from] = dialects.map(|dialect| dialect.id.as_str());
            let [source, target] = match contour_in_source {
                true => ["along the contour", "at the tool centre"],
                false => ["at the tool centre", "along the contour"],
            };
            format!("F on arcs under cutter compensation: {source} on {from}, {target} on {to}")
        }
        Fault::LengthByHand { tool } => format!("the zero of Z is set by tool {tool} when it is put in"),
        Fault::MovedAtChange => "a tool change takes Z to machine zero".to_owned(),
        Fault::AssumedContourEnds => "the same way onto a compensated contour, and off it".to_owned(),
        Fault::AssumedRadius { .. } => "a radius entry = the radius of the tool of its number".to_owned(),
        Fault::EdgeNumbered { .. } => given_number(fault),
        Fault::AssumedEdge { .. } => "edge 1 of a tool = the length entry of its number".to_owned(),
        _ => return None,
    })
}
