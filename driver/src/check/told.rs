//! What was found of one program, as all forms of the result take it: in words, with lines and columns.

use std::io;

use codespan_reporting::diagnostic::Severity as Heading;
use ncc_check::{Finding, Rule, Severity};
use ncc_ir::diag::{Diagnostic, Fault, Gravity};
use ncc_ir::source::Span;

use super::drive::Course;
use super::words::{message, not_checked};
use crate::job::Job;
use crate::render::source::{Excerpt, Lines};
use crate::render::{About, Place, Told};
use crate::source::Source;

/// A finding, or a message of the reader, in words.
pub struct Item {
    pub(crate) code: u16,
    /// The rule's name; none of a message of the reader.
    pub name: Option<&'static str>,
    pub(crate) severity: Severity,
    pub(crate) reported: Told,
}

/// What a call makes of findings, by their codes.
#[derive(Clone, Debug, Default)]
pub struct Graded {
    /// Those that are not told.
    pub allow: Vec<u16>,
    /// Those that are errors.
    pub deny: Vec<u16>,
    /// Whether assumptions are reported too.
    pub verbose: bool,
}

/// All of one program.
pub struct Program {
    /// Its name as it was given.
    pub shown: String,
    pub(crate) dialect: &'static str,
    pub(crate) items: Vec<Item>,
    /// Errors, warnings, notes: those that are only counted too.
    pub counts: [usize; 3],
    /// How many were allowed.
    pub allowed: usize,
    /// What was not checked, and why.
    pub not_checked: Vec<(String, String)>,
    pub(crate) lines: Lines,
}

impl Program {
    /// Whether anything but notes was found.
    pub fn has_findings(&self) -> bool {
        self.counts[0] + self.counts[1] > 0
    }
}

/// How grave a message of the reader is to somebody who checks a program: what ncc does not read is no
/// fault of it.
fn severity_of(fault: &Fault) -> Severity {
    match fault {
        Fault::NotSupported { .. }
        | Fault::MacroLanguage { .. }
        | Fault::NotExecuted { .. }
        | Fault::EntryFactNeeded { .. }
        | Fault::PositionUnknown { .. }
        | Fault::NoEnd { .. }
        | Fault::Interrupted { .. } => Severity::Note,
        Fault::UnknownCode { .. } => Severity::Warning,
        _ => match fault.gravity() {
            Gravity::Error => Severity::Error,
            Gravity::Warning => Severity::Warning,
            Gravity::Verdict(_) => Severity::Note,
        },
    }
}

/// Brings what was found into words.
///
/// # Errors
/// Reading the source.
pub fn tell(graded: &Graded, job: &Job, source: &mut Source, course: Course) -> io::Result<Program> {
    let Course { checked, mut diagnostics, untold } = course;
    if diagnostics.iter().any(|d| d.fault == Fault::NotText) {
        diagnostics.retain(|d| d.fault == Fault::NotText);
        diagnostics.truncate(1);
    }
    let assumed = |d: &Diagnostic| matches!(d.fault.gravity(), Gravity::Verdict(_));
    diagnostics.retain(|d| !assumed(d) || graded.verbose);
    let findings = match diagnostics.iter().any(|d| d.fault == Fault::NotText) {
        true => &[][..],
        false => &checked.findings,
    };
    let places = diagnostics.iter().flat_map(|d| std::iter::once(&d.span).chain(&d.related));
    let places = places.chain(findings.iter().flat_map(|f| std::iter::once(&f.span).chain(&f.related)));
    let places = places.chain(&checked.first_refusal).map(|span| span.start).collect();
    let mut lines = Lines::find(&mut source.file, places)?;
    lines.own_numbers(job.called.as_ref());
    let shown = source.shown.clone();
    let mut program = Program {
        dialect: &job.from.dialect.id,
        items: Vec::new(),
        counts: [0; 3],
        allowed: 0,
        not_checked: Vec::new(),
        shown: shown.clone(),
        lines,
    };
    let lines = std::mem::take(&mut program.lines);
    let grade = |code: u16, severity: Severity| match graded.deny.contains(&code) {
        true => Severity::Error,
        false => severity,
    };
    for finding in findings {
        let rule = finding.what.rule();
        if graded.allow.contains(&rule.code()) {
            program.allowed += 1;
            continue;
        }
        let severity = grade(rule.code(), rule.severity());
        program.count(severity, 1);
        let file = job.called.as_ref().and_then(|called| called.file(finding.span.start));
        let name = file.map_or(shown.as_str(), |file| file.name.as_str());
        let told = of_finding(finding, severity, source, &lines, name)?;
        program.items.push(Item { code: rule.code(), name: Some(rule.name()), severity, reported: told });
    }
    for (rule, count) in &checked.left_out {
        if !graded.allow.contains(&rule.code()) {
            program.count(grade(rule.code(), rule.severity()), *count);
        }
    }
    for diagnostic in &diagnostics {
        let code = diagnostic.fault.code();
        if graded.allow.contains(&code) {
            program.allowed += 1;
            continue;
        }
        let severity = grade(code, severity_of(&diagnostic.fault));
        program.count(severity, 1);
        let mut about = About { job, name: &shown, source: &mut source.file };
        let mut told = about.tell(&lines, diagnostic)?;
        told.severity = heading(severity);
        program.items.push(Item { code, name: None, severity, reported: told });
    }
    program.count(Severity::Note, untold);
    program.items.sort_by_key(|item| (item.reported.place.span.start, item.code));
    let line = |at: u32| lines.line(at).map_or(0, |line| line.number);
    program.not_checked = not_checked(&checked, program.dialect, &line);
    program.lines = lines;
    Ok(program)
}

impl Program {
    fn count(&mut self, severity: Severity, n: usize) {
        self.counts[2 - severity as usize] += n;
    }
}

fn heading(severity: Severity) -> Heading {
    match severity {
        Severity::Error => Heading::Error,
        Severity::Warning => Heading::Warning,
        Severity::Note => Heading::Note,
    }
}

/// The name of a severity.
pub const fn name(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "note",
    }
}

/// The rule of a code, if it is one's.
pub fn rule(code: u16) -> Option<Rule> {
    Rule::of(code)
}

fn of_finding(
    finding: &Finding,
    severity: Severity,
    source: &mut Source,
    lines: &Lines,
    shown: &str,
) -> io::Result<Told> {
    let file = |span: &Span| source.called.as_ref()?.file(span.start).map(|file| file.places);
    let own = file(&finding.span);
    let others: Vec<Span> = finding.related.iter().filter(|span| file(span) == own).copied().collect();
    let spans: Vec<Span> = std::iter::once(finding.span).chain(others.iter().copied()).collect();
    let excerpt = Excerpt::read(&mut source.file, lines, shown, &spans)?;
    let message = message(finding);
    let place = |span: Span, label: &str| {
        let start = excerpt.location(lines, span.start).unwrap_or((1, 1));
        let text = excerpt.snippet(lines, span).to_owned();
        let end = (start.0, start.1 + text.chars().count() as u64);
        Place { span, start, end, text, label: label.to_owned() }
    };
    let labels = [message.related(), message.related_2()].map(Option::unwrap_or_default);
    let labels = labels.into_iter().chain(std::iter::repeat(String::new()));
    let related = others.iter().zip(labels).map(|(span, label)| place(*span, &label)).collect();
    Ok(Told {
        code: format!("NC{:04}", finding.what.rule().code()),
        severity: heading(severity),
        verdict: None,
        rank: None,
        message: message.headline(),
        entry: message.entry(),
        values: message.values(),
        place: place(finding.span, &message.label()),
        related,
        details: Vec::new(),
        advice: message.helps(None),
        excerpt,
    })
}
