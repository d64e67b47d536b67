//! A diagnostic in words, with the lines that it points at.
//!
//! ```text
//! Fault::UnknownCode { code: "G83.5" } at 3:7    NC0201, an error, its line and column, what to do
//! ```
//!
//! Not here: the wording (`words`, `advice`), and how it is laid out (`human`, `json`).

use std::collections::BTreeMap;
use std::io;

use codespan_reporting::diagnostic::Severity;
use ncc_ir::diag::{Diagnostic, Fault, Gravity, Verdict};
use ncc_ir::rank::Rank;
use ncc_ir::source::Span;

use super::messages::advice;
use super::messages::message::Value;
use super::messages::words::{Context, words};
use super::source::{Excerpt, Lines};
use crate::job::Job;
use crate::source::Readable;

/// The source that diagnostics are about, and the job that they came from.
pub struct About<'a> {
    /// The job.
    pub job: &'a Job,
    /// The source's name as it was given: a path, or `<stdin>`.
    pub name: &'a str,
    /// The source.
    pub source: &'a mut dyn Readable,
}

/// How much is stated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loudness {
    /// What stops the translation.
    Quiet,
    /// That, and warnings.
    Usual,
    /// Every verdict too.
    Verbose,
}

/// A diagnostic in words.
#[derive(Debug)]
pub struct Told {
    /// `NC0107`.
    pub code: String,
    /// How it is headed: an error if it stops the translation.
    pub severity: Severity,
    /// Its verdict, if it is one.
    pub verdict: Option<Verdict>,
    /// What a user has to do about it; an error has none.
    pub rank: Option<Rank>,
    /// What is wrong, or what became of the place.
    pub message: String,
    /// The entry of its words: `NC0225-units`.
    pub entry: String,
    /// The values in its words, by their names.
    pub values: BTreeMap<&'static str, Value>,
    /// Its place.
    pub place: Place,
    /// Further places.
    pub related: Vec<Place>,
    /// Facts that are too long for a label.
    pub details: Vec<String>,
    /// What to do.
    pub advice: Vec<String>,
    /// The lines of all its places.
    pub excerpt: Excerpt,
}

/// A place in words.
#[derive(Clone, Debug)]
pub struct Place {
    /// Bytes of the source.
    pub span: Span,
    /// Line and column of its start, counted from 1.
    pub start: (u64, u64),
    /// Line and column of its end, or of the end of its first line.
    pub end: (u64, u64),
    /// Its text, up to the end of its first line.
    pub text: String,
    /// Why this place.
    pub label: String,
}

impl About<'_> {
    /// The lines that these diagnostics point at.
    ///
    /// # Errors
    /// Reading the source.
    pub fn lines<'d>(&mut self, diagnostics: impl Iterator<Item = &'d Diagnostic>) -> io::Result<Lines> {
        let places = diagnostics.flat_map(|d| std::iter::once(d.span).chain(d.related.iter().copied()));
        let places = places.map(|span| span.start).collect();
        let mut lines = Lines::find(self.source, places)?;
        lines.own_numbers(self.job.called.as_ref());
        Ok(lines)
    }

    /// A diagnostic in words, with what else was found in mind. `lines` must know its places.
    ///
    /// # Errors
    /// Reading the source.
    pub fn tell_among(
        &mut self,
        lines: &Lines,
        diagnostic: &Diagnostic,
        all: &[Diagnostic],
    ) -> io::Result<Told> {
        let mut told = self.tell(lines, diagnostic)?;
        let at =
            Context { from: self.job.from.dialect, to: self.job.to.dialect, snippet: "", beside: ("", "") };
        told.advice.extend(advice::beside(&diagnostic.fault, all, at));
        Ok(told)
    }

    /// A diagnostic in words. `lines` must know its places.
    ///
    /// # Errors
    /// Reading the source.
    pub fn tell(&mut self, lines: &Lines, diagnostic: &Diagnostic) -> io::Result<Told> {
        // Further places are shown that stand in the same file.
        let file = |span: &Span| self.job.called.as_ref().and_then(|called| called.file(span.start));
        let own = file(&diagnostic.span);
        let related: Vec<Span> =
            diagnostic.related.iter().filter(|span| file(span) == own).copied().collect();
        let spans: Vec<Span> = std::iter::once(diagnostic.span).chain(related.iter().copied()).collect();
        let name = own.map_or(self.name, |file| file.name.as_str());
        let excerpt = Excerpt::read(self.source, lines, name, &spans)?;
        let fault = &diagnostic.fault;
        let at = Context {
            from: self.job.from.dialect,
            to: self.job.to.dialect,
            snippet: excerpt.snippet(lines, diagnostic.span),
            beside: excerpt.beside(lines, diagnostic.span),
        };
        let said = words(fault, at);
        let mut advice = advice::advice(fault, at);
        let gravity = fault.gravity();
        let verdict = match gravity {
            Gravity::Verdict(verdict) => Some(verdict),
            Gravity::Error | Gravity::Warning => None,
        };
        let severity = match gravity {
            Gravity::Error if is_internal_error(fault) => Severity::Bug,
            _ if self.job.refuses(diagnostic) => Severity::Error,
            Gravity::Warning => Severity::Warning,
            Gravity::Verdict(verdict) if verdict.stops() => Severity::Warning,
            Gravity::Error | Gravity::Verdict(_) => Severity::Note,
        };
        if let Some(verdict) = verdict.filter(|v| self.job.stops(*v)) {
            advice.push(advice::stopped(verdict, self.job.deny.contains(&verdict)));
        }
        let place = |span: Span, label: &str| {
            let range = excerpt.range(lines, span).unwrap_or(0..0);
            let start = excerpt.location(lines, span.start).unwrap_or((1, 1));
            let text = excerpt.snippet(lines, span).to_owned();
            let end = (start.0, start.1 + text.chars().count() as u64);
            debug_assert!(range.start <= range.end);
            Place { span, start, end, text, label: label.to_owned() }
        };
        let related = related.iter().map(|span| place(*span, &said.related)).collect();
        Ok(Told {
            code: format!("NC{:04}", fault.code()),
            severity,
            verdict,
            rank: fault.rank(),
            place: place(diagnostic.span, &said.label),
            message: said.message,
            entry: said.entry,
            values: said.values,
            related,
            details: advice::details(fault),
            advice,
            excerpt,
        })
    }
}

/// Whether it is a fault of this compiler, not of the program.
fn is_internal_error(fault: &Fault) -> bool {
    matches!(fault, Fault::NotTheSame { .. } | Fault::NotReadBack { .. })
}
