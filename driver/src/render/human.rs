//! Diagnostics for people: codespan's boxes on stderr.

use std::collections::BTreeMap;
use std::io;

use codespan_reporting::diagnostic::{Diagnostic as Boxed, Label, Severity};
use codespan_reporting::term::termcolor::WriteColor;
use codespan_reporting::term::{self, Config};
use ncc_ir::diag::{Diagnostic, Fault, Gravity};
use ncc_ir::source::Span;

use super::about::{About, Loudness, Told};
use super::messages::message::Message;
use super::source::Lines;
use crate::job::{Counted, Job};
use crate::source::called_files::Called;

/// Of one code, so many diagnostics are shown; the rest is counted.
pub const MOST: usize = 20;

/// So many further places of the same fault are listed; the rest is counted.
const LISTED: usize = 8;

/// So many characters are underlined at most.
const LONGEST_LABEL: usize = 80;

/// The diagnostics that are reported at this loudness, in the order of their places.
pub fn reported<'d>(job: &Job, diagnostics: &'d [Diagnostic], loudness: Loudness) -> Vec<&'d Diagnostic> {
    let told = |d: &&Diagnostic| match (d.fault.gravity(), loudness) {
        _ if job.refuses(d) => true,
        (_, Loudness::Quiet) => false,
        (_, Loudness::Verbose) | (Gravity::Error | Gravity::Warning, Loudness::Usual) => true,
        (Gravity::Verdict(verdict), Loudness::Usual) => verdict.stops(),
    };
    let mut all: Vec<&Diagnostic> = diagnostics.iter().filter(told).collect();
    // Of a file that is no text, everything else that was found is noise.
    if all.iter().any(|d| d.fault == Fault::NotText) {
        all.retain(|d| d.fault == Fault::NotText);
        all.truncate(1);
    }
    all.sort_by_key(|d| d.span.start);
    all.dedup_by(|b, a| a.span == b.span && same(&a.fault, &b.fault));
    // Of a word without a known meaning, its place among other words is no second fault.
    let unknown = |fault: &Fault| matches!(fault, Fault::UnknownCode { .. } | Fault::NotSupported { .. });
    let words: Vec<Span> = all.iter().filter(|d| unknown(&d.fault)).map(|d| d.span).collect();
    let follows = |fault: &Fault| matches!(fault, Fault::TooManyCodes { .. } | Fault::CodesExclude { .. });
    all.retain(|d| !(follows(&d.fault) && words.binary_search_by_key(&d.span.start, |w| w.start).is_ok()));
    // Of a statement and an expression in it, the expression is the cause: it is the next one from the end.
    let mut next: Option<Span> = None;
    let cause = |d: &&Diagnostic| match d.fault {
        Fault::MacroLanguage { .. } => next.replace(d.span).is_none_or(|inner| inner.end > d.span.end),
        _ => true,
    };
    let mut causes: Vec<&Diagnostic> = all.into_iter().rev().filter(cause).collect();
    causes.reverse();
    causes
}

/// Diagnostics that are one to the reader: the same fault at several places.
struct Group<'d> {
    first: &'d Diagnostic,
    further: Vec<&'d Diagnostic>,
    /// Places that are counted only.
    more: usize,
}

/// Groups equal diagnostics of `all`, in the order of their first places, and counts those of a code that has more than
/// [`MOST`] groups.
fn grouped<'d>(all: Vec<&'d Diagnostic>, called: Option<&Called>) -> (Vec<Group<'d>>, BTreeMap<u16, usize>) {
    let file = |d: &Diagnostic| called.and_then(|called| called.file(d.span.start)).map(|file| &file.name);
    let mut groups: Vec<Group> = Vec::new();
    let mut of_code: BTreeMap<u16, Vec<usize>> = BTreeMap::new();
    let mut left_out: BTreeMap<u16, usize> = BTreeMap::new();
    for d in all {
        let code = d.fault.code();
        let known = of_code.entry(code).or_default();
        // The help quotes the text of its own place.
        let by_text = matches!(d.fault, Fault::LetterOForZero);
        let same = |at: &&usize| {
            let first = groups[**at].first;
            !by_text && file(first) == file(d) && (first.fault == d.fault || alike(&first.fault, &d.fault))
        };
        match known.iter().find(same) {
            // Each name is in the headline.
            Some(at) if groups[*at].further.len() < LISTED || groups[*at].first.fault != d.fault => {
                groups[*at].further.push(d);
            }
            Some(at) => groups[*at].more += 1,
            None if known.len() < MOST => {
                known.push(groups.len());
                groups.push(Group { first: d, further: Vec::new(), more: 0 });
            }
            None => *left_out.entry(code).or_default() += 1,
        }
    }
    (groups, left_out)
}

/// The same, at most [`MOST`] of a code; and how many of each code are left out.
pub fn choose<'d>(
    job: &Job,
    diagnostics: &'d [Diagnostic],
    counted: &[Counted],
    loudness: Loudness,
) -> (Vec<&'d Diagnostic>, BTreeMap<u16, usize>) {
    let mut all = reported(job, diagnostics, loudness);
    let mut counts: BTreeMap<u16, usize> = BTreeMap::new();
    all.retain(|d| {
        let count = counts.entry(d.fault.code()).or_default();
        *count += 1;
        *count <= MOST
    });
    for counted in counted {
        if let Some(count) = counts.get_mut(&counted.fault.code()) {
            *count += counted.more as usize;
        }
    }
    let left_out = counts.into_iter().filter(|(_, n)| *n > MOST).map(|(code, n)| (code, n - MOST)).collect();
    (all, left_out)
}

/// Prints the diagnostics that are reported at this loudness.
///
/// # Errors
/// Reading the source, or writing.
pub fn print(
    out: &mut dyn WriteColor,
    about: &mut About,
    diagnostics: &[Diagnostic],
    loudness: Loudness,
) -> io::Result<()> {
    print_counted(out, about, (diagnostics, &[]), loudness)
}

/// The same, of what was counted as well.
///
/// # Errors
/// Reading the source, or writing.
pub fn print_counted(
    out: &mut dyn WriteColor,
    about: &mut About,
    (diagnostics, counted): (&[Diagnostic], &[Counted]),
    loudness: Loudness,
) -> io::Result<()> {
    let all = reported(about.job, diagnostics, loudness);
    let (groups, mut left_out) = grouped(all, about.job.called.as_ref());
    for counted in counted {
        let code = counted.fault.code();
        if groups.iter().any(|group| group.first.fault.code() == code) {
            *left_out.entry(code).or_default() += counted.more as usize;
        }
    }
    let places =
        groups.iter().flat_map(|group| [group.first].into_iter().chain(group.further.iter().copied()));
    let lines = about.lines(places)?;
    for group in groups {
        let told = about.tell_among(&lines, &group.named(), diagnostics)?;
        let mut boxed = boxed(&told, &lines);
        boxed.notes.splice(..0, also(&group, &lines));
        term::emit_to_write_style(out, &Config::default(), &told.excerpt, &boxed)
            .map_err(io::Error::other)?;
    }
    for (code, count) in left_out {
        writeln!(out, "… and {count} more of NC{code:04}\n")?;
    }
    Ok(())
}

/// Whether two faults are one to the reader but for the names in them.
fn alike(a: &Fault, b: &Fault) -> bool {
    match (a, b) {
        (
            Fault::ArgumentNeeded { place: 0, check: a, .. },
            Fault::ArgumentNeeded { place: 0, check: b, .. },
        ) => a == b,
        _ => false,
    }
}

impl Group<'_> {
    /// The diagnostic of all of them: the first one, with the names of all.
    fn named(&self) -> Diagnostic {
        let mut all = self.first.clone();
        if let Fault::ArgumentNeeded { name, .. } = &mut all.fault {
            let further = self.further.iter().filter_map(|d| match &d.fault {
                Fault::ArgumentNeeded { name, .. } => Some(name),
                _ => None,
            });
            let mut names: Vec<&str> = [&*name].into_iter().chain(further).map(|name| &**name).collect();
            names.dedup();
            *name = names.join(", ").into();
        }
        all
    }
}

/// The further lines of a group, if it has some.
fn also(group: &Group, lines: &Lines) -> Option<String> {
    let first = lines.line(group.first.span.start)?.number;
    let mut numbers: Vec<u64> =
        group.further.iter().filter_map(|d| Some(lines.line(d.span.start)?.number)).collect();
    numbers.dedup();
    numbers.retain(|number| *number != first);
    let more = (group.more + numbers.len().saturating_sub(LISTED)) as u64;
    numbers.truncate(LISTED);
    let numbers: Vec<String> = numbers.iter().map(u64::to_string).collect();
    let message = match (numbers.split_last(), more) {
        (None, 0) => return None,
        (None, _) => Message::common("also-places").count("more", more),
        (Some(_), 1..) => Message::common("also-more").text("lines", numbers.join(", ")).count("more", more),
        (Some((last, [])), 0) => Message::common("also-line").text("last", last),
        (Some((last, first)), 0) => {
            Message::common("also-lines").text("lines", first.join(", ")).text("last", last)
        }
    };
    Some(message.headline())
}

/// Whether two faults at one place are one to the reader: several steps may find the same, and a
/// pass and a back-end may both lack a place.
fn same(a: &Fault, b: &Fault) -> bool {
    a == b || matches!((a, b), (Fault::TargetLacks { .. }, Fault::TargetLacks { .. }))
}

pub(crate) fn boxed(told: &Told, lines: &Lines) -> Boxed<()> {
    let range = |span| {
        let range = told.excerpt.range(lines, span).unwrap_or(0..0);
        let cut = told.excerpt.cut(range.start, LONGEST_LABEL);
        range.start..range.end.min(cut)
    };
    let mut labels = vec![Label::primary((), range(told.place.span)).with_message(&told.place.label)];
    for place in &told.related {
        labels.push(Label::secondary((), range(place.span)).with_message(&place.label));
    }
    let mut notes = told.details.clone();
    notes.extend(told.advice.iter().map(|line| format!("help: {line}")));
    if told.severity == Severity::Error && told.advice.is_empty() {
        let more = Message::common("explain").text("code", told.code.as_str());
        notes.push(format!("help: {}", more.headline()));
    }
    Boxed::new(told.severity)
        .with_code(&told.code)
        .with_message(&told.message)
        .with_labels(labels)
        .with_notes(notes)
}
