//! Diagnostics for people: codespan's boxes on stderr.

use std::collections::BTreeMap;
use std::io;

use codespan_reporting::diagnostic::{Diagnostic as Boxed, Label, Severity};
use codespan_reporting::term::termcolor::WriteColor;
use codespan_reporting::term::{self, Config};
use ncc_ir::diag::{Diagnostic, Fault, Gravity};

use super::about::{About, Loudness, Told};
use crate::job::{Counted, Job};

/// Of one code, so many diagnostics are shown; the rest is counted.
pub const MOST: usize = 20;

/// So many characters are underlined at most.
const LONGEST_LABEL: usize = 80;

/// Which diagnostics are told at this loudness, in the order of their places.
pub fn told<'d>(job: &Job, diagnostics: &'d [Diagnostic], loudness: Loudness) -> Vec<&'d Diagnostic> {
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
    all
}

/// The same, at most [`MOST`] of a code; and how many of each code are left out.
pub fn choose<'d>(
    job: &Job,
    diagnostics: &'d [Diagnostic],
    counted: &[Counted],
    loudness: Loudness,
) -> (Vec<&'d Diagnostic>, BTreeMap<u16, usize>) {
    let mut all = told(job, diagnostics, loudness);
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

/// Prints the diagnostics that are told at this loudness.
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
    let (shown, left_out) = choose(about.job, diagnostics, counted, loudness);
    let lines = about.lines(shown.iter().copied())?;
    for diagnostic in shown {
        let told = about.tell_among(&lines, diagnostic, diagnostics)?;
        let boxed = boxed(&told, &lines);
        term::emit_to_write_style(out, &Config::default(), &told.excerpt, &boxed)
            .map_err(io::Error::other)?;
    }
    for (code, count) in left_out {
        writeln!(out, "… and {count} more of NC{code:04}\n")?;
    }
    Ok(())
}

/// Whether two faults at one place are one to the reader: several steps may find the same, and a
/// pass and a back-end may both have no words for a place.
fn same(a: &Fault, b: &Fault) -> bool {
    a == b || matches!((a, b), (Fault::TargetLacks { .. }, Fault::TargetLacks { .. }))
}

pub(crate) fn boxed(told: &Told, lines: &super::source::Lines) -> Boxed<()> {
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
        notes.push(format!("help: `ncc explain {}` says more", told.code));
    }
    Boxed::new(told.severity)
        .with_code(&told.code)
        .with_message(&told.message)
        .with_labels(labels)
        .with_notes(notes)
}
