//! The comment that opens an emitted program: source and hash, verified or not, assumptions. The
//! operator at the machine never sees what the command line printed. Its words are in `messages/head`.
//!
//! ```text
//! (ncc: mach9 teste.cn sha256 0f63f2c7, verified)
//! (assumed: units = mm; work offset = G54)
//! ```

use std::collections::BTreeSet;

use ncc_dialects::Dialect;
use ncc_ir::diag::{Diagnostic, Fault, Gravity, ModeName, Verdict};
use ncc_ir::program::Text;
use ncc_ir::program::numbered::Numbered;

use super::messages::message::{Message, Part};
use super::{questions, spelled};
use crate::job::Job;
use crate::questions::Question;

/// An entry about the head of a program.
fn head(form: &'static str) -> Message {
    Message::part(Part::Head, form)
}

/// The lines of the comment.
pub fn lines(
    job: &Job,
    hash: &[u8; 32],
    questions: &[Question],
    diagnostics: &[Diagnostic],
    renumbered: &BTreeSet<(Numbered, Text, Text)>,
) -> Vec<String> {
    let first = head(if job.verify { "verified" } else { "unverified" })
        .text("dialect", job.from.dialect.id.as_str())
        .text("name", job.source_name.as_str())
        .text("hash", beginning(hash));
    let mut lines = vec![first.headline()];
    if let Some(project) = &job.project {
        lines.push(project.line());
    }
    for file in job.called.iter().flat_map(|called| &called.files) {
        let name = std::path::Path::new(&file.name).file_name();
        let name = name.map_or(file.name.clone().into(), |name| name.to_string_lossy());
        let called = head("called").text("name", name).text("hash", beginning(&file.sha256));
        lines.push(called.headline());
    }
    if !questions.is_empty() {
        let own: Vec<String> = questions.iter().map(questions::taken).collect();
        lines.push(head("not-answered").text("facts", own.join("; ")).headline());
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
        lines.push(head("assumed").text("facts", assumed.join("; ")).headline());
    }
    lines.extend(by_name(renumbered, "to"));
    lines
}

/// The first digits of a hash.
fn beginning(hash: &[u8; 32]) -> String {
    hash[..4].iter().map(|b| format!("{b:02x}")).collect()
}

/// What was renumbered, a line for each kind: `tools by name: 3 to 7, 4 to 1`.
pub fn by_name(renumbered: &BTreeSet<(Numbered, Text, Text)>, arrow: &str) -> Vec<String> {
    let line = |what: Numbered| {
        let mut own: Vec<&(Numbered, Text, Text)> = renumbered.iter().filter(|row| row.0 == what).collect();
        own.sort_by_key(|(_, from, _)| (from.len(), from.clone()));
        let pairs: Vec<String> = own.iter().map(|(_, from, to)| format!("{from} {arrow} {to}")).collect();
        let form = match what {
            Numbered::Tool => "tool-numbers",
            Numbered::LengthEntry => "length-entry-numbers",
            Numbered::WorkOffset => "work-offset-numbers",
            Numbered::Program => "program-numbers",
        };
        (!pairs.is_empty()).then(|| head(form).text("pairs", pairs.join(", ")).headline())
    };
    Numbered::ALL.into_iter().filter_map(line).collect()
}

/// An assumption in the few words that fit a program's head; `None` for what is none. A work offset
/// is named by the first of the dialects that supports it.
pub fn assumption(fault: &Fault, dialects: [&Dialect; 2]) -> Option<String> {
    let controls = |form| {
        let [to, from] = dialects.map(|dialect| dialect.id.as_str());
        head(form).text("source", from).text("target", to)
    };
    let message = match fault {
        Fault::AssumedMode { fact, value } => match fact {
            ModeName::Motion => head("motion").text("value", spelled::mode_value(*fact, value)),
            ModeName::Distance => head("distance").text("value", &**value),
            ModeName::Units => head("units").text("value", &**value),
            ModeName::Plane => head("plane").text("value", &**value),
            ModeName::FeedMode => head("feed-mode").text("value", &**value),
            ModeName::ReturnLevel => head("return-level").text("value", &**value),
            ModeName::WorkOffset => {
                let offset = value.parse().map(|number| spelled::work_offset(number, dialects));
                head("work-offset").text("value", offset.unwrap_or_else(|_| value.to_string()))
            }
            ModeName::LengthOffset => head("no-length-offset"),
            ModeName::OriginShift => head("no-origin-shift"),
        },
        Fault::AssumedNoEffect { code } => head("no-effect").text("code", &**code),
        Fault::AssumedFunction { name, .. } => head("function").text("code", &**name),
        Fault::AssumedBareNumber { word, value } => {
            head("bare-number").text("word", &**word).text("value", &**value)
        }
        Fault::AssumedOffsetWithZ => head("offset-with-z"),
        Fault::AssumedWorkOffset { offset } => {
            head("only-work-offset").text("value", spelled::work_offset(*offset, dialects))
        }
        Fault::AssumedRow { code, meaning } => {
            head("fact").text("name", &**code).text("value", spelled::row_meaning(code, meaning, dialects))
        }
        Fault::AssumedOption { option, value } => {
            head("fact").text("name", &**option).text("value", &**value)
        }
        Fault::AssumedFact { fact } => {
            let [name, value] = spelled::assumed_fact(fact);
            head("fact").text("name", name).text("value", value)
        }
        // The head has a line of its own about them.
        Fault::ToolNumbered { .. } => return None,
        Fault::AssumedHoleOrder { pattern } => head("hole-order").text("pattern", &**pattern),
        Fault::AssumedPath { path } => head("corners").text("path", &**path),
        Fault::AssumedMilling { looks_like, line } => {
            head("milling").text("line", line.to_string()).text("looks-like", &**looks_like)
        }
        Fault::AssumedTip => head("tip"),
        Fault::AssumedToolChange { .. } => head("tool-change"),
        Fault::CallDepth { depth, sure, macros } => {
            head(if *macros { "macro-call-depth" } else { "call-depth" })
                .text("depth", depth.to_string())
                .text("sure", sure.to_string())
        }
        Fault::AssumedCycle { .. } => head("cycle"),
        Fault::AssumedReturn { .. } => head("return"),
        Fault::AssumedControl { taken, other } => {
            head("control").text("taken", &**taken).text("other", &**other)
        }
        Fault::AssumedTilt => head("tilt"),
        Fault::AssumedContourPath => head("contour-path"),
        Fault::StartedAgain { behaviour } => head("started-again").text("behaviour", behaviour.about()),
        Fault::OpenBehaviour { behaviour, source, taken, .. } => {
            let [to, from] = dialects.map(|dialect| dialect.id.as_str());
            head("behaviour")
                .text("option", behaviour.option())
                .text("taken", *taken)
                .text("control", if *source { from } else { to })
        }
        Fault::OptionalStopDiffers => head("optional-stop"),
        Fault::PathAtStart { source, target } => controls("path-at-start")
            .text("source-path", spelled::path_start(source))
            .text("target-path", spelled::path_start(target)),
        Fault::NextRunShifted { axis, .. } => {
            head("next-run-shifted").text("axis", char::from(axis.letter()).to_string())
        }
        Fault::NextRunTurned => head("next-run-turned"),
        Fault::NextRunVariables { names, source, target } => controls("next-run-variables")
            .text("variables", spelled::variables(names))
            .text("source-kept", spelled::kept(*source))
            .text("target-kept", spelled::kept(*target)),
        Fault::RoundsFreely => head("rounds-freely"),
        Fault::FeedOnArcs { contour_in_source: true, .. } => controls("feed-on-contour"),
        Fault::FeedOnArcs { contour_in_source: false, .. } => controls("feed-on-centre"),
        Fault::LengthByHand { tool } => head("length-by-hand").text("tool", tool.to_string()),
        Fault::MovedAtChange => head("moved-at-change"),
        Fault::AssumedContourEnds => head("contour-ends"),
        Fault::AssumedRadius { .. } => head("radius"),
        Fault::EdgeNumbered { tool, edge, entry } => head("edge-number")
            .text("edge", edge.to_string())
            .text("tool", tool.to_string())
            .text("entry", entry.to_string()),
        Fault::AssumedEdge { .. } => head("edge"),
        _ => return None,
    };
    Some(message.headline())
}
