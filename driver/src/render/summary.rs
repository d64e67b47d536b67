//! The account at the end: what was verified, what was assumed, expanded, rewritten and lost.

use std::collections::HashMap;
use std::io;

use codespan_reporting::term::termcolor::{Color, ColorSpec, WriteColor};
use ncc_ir::diag::{Diagnostic, Fault, Gravity};
use ncc_ir::rank::Rank;
use ncc_ir::source::Span;

use super::about::{About, Loudness};
use super::human::reported;
use super::messages::facts::message;
use super::messages::message::{Message, Part};
use super::messages::words::Context;
use super::questions::taken;
use super::source::Lines;
use crate::job::{Failure, Outcome, Straight};
use crate::questions::Question;
use crate::render::head::{assumption, by_name};
use crate::source::called_files::Called;

/// Of one phrase, so many line numbers are named.
const MOST_LINES: usize = 6;
/// Of one verdict, so many phrases are named.
const MOST_PHRASES: usize = 12;

/// Headings are filled up with blanks to so many characters.
const HEADING: usize = 23;
/// Lists of phrases are broken before so many characters.
const WIDTH: usize = 100;

/// Under which heading something is named, in the order of the account.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Heading {
    /// A loss that was allowed.
    Lost,
    Check,
    Usual,
    NoEffect,
}

impl Heading {
    const ALL: [Heading; 4] = [Heading::Lost, Heading::Check, Heading::Usual, Heading::NoEffect];

    fn words(self) -> String {
        summary(match self {
            Heading::Lost => "lost",
            Heading::Check => "check",
            Heading::Usual => "usual",
            Heading::NoEffect => "no-effect",
        })
        .headline()
    }

    /// Whether each phrase has a line, with its places; else they share one.
    fn each(self) -> bool {
        match self {
            Heading::Lost | Heading::Check => true,
            Heading::Usual | Heading::NoEffect => false,
        }
    }
}

/// The heading under which a fault is named, if it has a place in the account. What was asked has one of its own.
fn heading(fault: &Fault, questions: &[Question]) -> Option<Heading> {
    let Gravity::Verdict(verdict) = fault.gravity() else { return None };
    if verdict.stops() {
        return Some(Heading::Lost);
    }
    let asked = || questions.iter().any(|question| question.fact.code() == fault.code());
    match fault.rank()? {
        Rank::Dangerous if asked() => None,
        // Both values make the same cut.
        Rank::Dangerous | Rank::Usual => Some(Heading::Usual),
        Rank::Check => Some(Heading::Check),
        Rank::NoEffect => Some(Heading::NoEffect),
    }
}

/// Diagnostics that one phrase covers.
struct Group {
    phrase: String,
    count: usize,
    /// First byte of the first few.
    places: Vec<u32>,
}

/// Prints the account of a translation that was done.
///
/// # Errors
/// Reading the source, or writing.
pub fn print(out: &mut dyn WriteColor, about: &mut About, outcome: &Outcome) -> io::Result<()> {
    let (from, to) = (&about.job.from.dialect.id, &about.job.to.dialect.id);
    write!(out, "{}: {from} to {to}", about.name)?;
    match (&outcome.release, &outcome.verified) {
        (Err(_), _) => return print_failure(out, about, outcome),
        (Ok(()), Some(verified)) => {
            write!(out, ", ")?;
            coloured(out, Color::Green, &summary("verified").headline())?;
            let events = match verified.skip_settings {
                0 | 1 => summary("events"),
                n => summary("events-skips").text("skips", n.to_string()),
            };
            let events = events.text("events", verified.events.to_string()).count("set-ups", verified.worlds);
            writeln!(out, ": {}", events.headline())?;
        }
        (Ok(()), None) => {
            write!(out, ", ")?;
            coloured(out, Color::Red, &summary("not-verified").headline())?;
            writeln!(out)?;
        }
    }
    project(out, about)?;
    for line in by_name(&outcome.renumbered, "→") {
        writeln!(out, "  {line}")?;
    }
    let at =
        Context { from: about.job.from.dialect, to: about.job.to.dialect, snippet: "", beside: ("", "") };
    let groups: Vec<(Heading, Vec<Group>)> = Heading::ALL
        .into_iter()
        .map(|heading| (heading, groups(outcome, heading, at)))
        .filter(|(_, groups)| !groups.is_empty())
        .collect();
    let places = groups.iter().flat_map(|(_, groups)| groups).flat_map(|g| g.places.iter().copied());
    let places = places.chain(outcome.questions.iter().map(|question| question.span.start)).collect();
    let mut lines = Lines::find(about.source, places)?;
    lines.own_numbers(about.job.called.as_ref());
    let called = about.job.called.as_ref();
    for (i, question) in outcome.questions.iter().enumerate() {
        let own = Group { phrase: taken(question), count: 1, places: vec![question.span.start] };
        headed(out, Color::Red, &if i == 0 { summary("not-answered").headline() } else { String::new() })?;
        writeln!(out, "{} ({})", own.phrase, line_list(&own, &lines, called))?;
    }
    for (heading, groups) in groups {
        let colour = if heading == Heading::Lost { Color::Red } else { Color::Yellow };
        if !heading.each() {
            headed(out, colour, &heading.words())?;
            writeln!(out, "{}", list(&groups))?;
            continue;
        }
        for (i, group) in groups.iter().take(MOST_PHRASES).enumerate() {
            headed(out, colour, &if i == 0 { heading.words() } else { String::new() })?;
            writeln!(out, "{} ({})", group.phrase, line_list(group, &lines, called))?;
        }
        if let Some(more) = groups.len().checked_sub(MOST_PHRASES).filter(|n| *n > 0) {
            headed(out, colour, "")?;
            writeln!(out, "{}", summary("more-phrases").text("more", more.to_string()).headline())?;
        }
    }
    Ok(())
}

/// What a project file answers, and what options go before.
fn project(out: &mut dyn WriteColor, about: &About) -> io::Result<()> {
    let Some(used) = &about.job.project else { return Ok(()) };
    let mut facts = used.facts().split("; ").map(|fact| format!("{fact};")).collect::<Vec<String>>();
    if let Some(last) = facts.last_mut() {
        last.pop();
    }
    let mut lines = vec![String::new()];
    for fact in facts {
        let last = lines.last().map_or(0, |line| line.chars().count());
        if last > 0 && HEADING + 2 + last + 1 + fact.chars().count() > WIDTH {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            line.push_str(if line.is_empty() { "" } else { " " });
            line.push_str(&fact);
        }
    }
    for (i, line) in lines.iter().chain(&used.overridden).enumerate() {
        headed(out, Color::Green, &if i == 0 { used.title().join(" ") } else { String::new() })?;
        writeln!(out, "{line}")?;
    }
    Ok(())
}

fn headed(out: &mut dyn WriteColor, colour: Color, heading: &str) -> io::Result<()> {
    write!(out, "  ")?;
    coloured(out, colour, &format!("{heading:<HEADING$}"))
}

/// Phrases that share a line: how many, and what they are.
fn list(groups: &[Group]) -> String {
    let mut text = format!("{}: ", groups.len());
    let mut column = HEADING + 2 + text.len();
    let mut phrases: Vec<String> = groups.iter().take(MOST_PHRASES).map(|g| g.phrase.clone()).collect();
    if let Some(more) = groups.len().checked_sub(MOST_PHRASES).filter(|n| *n > 0) {
        phrases.push(summary("more-in-list").text("more", more.to_string()).headline());
    }
    let last = phrases.len().saturating_sub(1);
    let all = format!(" {}", summary("all-in-list").headline());
    for (i, phrase) in phrases.iter().enumerate() {
        let end = if i == last { all.as_str() } else { ";" };
        let wide = phrase.chars().count() + end.len() + 1;
        if i > 0 && column + wide > WIDTH {
            text += &format!("\n{:1$}", "", HEADING + 2);
            column = HEADING + 2;
        } else if i > 0 {
            text.push(' ');
        }
        text += phrase;
        text += end;
        column += wide;
    }
    text
}

fn print_failure(out: &mut dyn WriteColor, about: &About, outcome: &Outcome) -> io::Result<()> {
    failure(out, about, outcome)?;
    project(out, about)
}

fn failure(out: &mut dyn WriteColor, about: &About, outcome: &Outcome) -> io::Result<()> {
    write!(out, ", ")?;
    let stopping = reported(about.job, &outcome.diagnostics, Loudness::Quiet);
    let errors = stopping.iter().filter(|d| d.fault.gravity() == Gravity::Error).count() as u64;
    let refuses = |fault: &Fault| about.job.refuses(&Diagnostic::new(fault.clone(), Span::default()));
    let counted = outcome.counted.iter().filter(|counted| refuses(&counted.fault));
    let losses = stopping.len() as u64 - errors + counted.map(|counted| counted.more).sum::<u64>();
    let questions = outcome.questions.len() as u64;
    match outcome.release {
        Err(Failure::VerificationFailed) => {
            coloured(out, Color::Red, &summary("verification-failed").headline())?;
            writeln!(out, "; {}", summary("nothing-written").headline())
        }
        Err(Failure::Refused) | Ok(()) => {
            coloured(out, Color::Red, &summary("not-translated").headline())?;
            let count = |n: u64, form| (n > 0).then(|| summary(form).count("count", n).headline());
            let reasons = [count(questions, "questions"), count(errors, "errors"), count(losses, "losses")];
            let reasons: Vec<String> = reasons.into_iter().flatten().collect();
            writeln!(out, ": {}; {}", reasons.join(", "), summary("nothing-written").headline())?;
            if let Some(straight) = outcome.straight {
                let form = match straight {
                    Straight::Flattened => "straight",
                    Straight::Switch => "straight-switch",
                    Straight::WithoutMotion => "straight-without-motion",
                };
                writeln!(out, "  help: {}", summary(form).headline())?;
            }
            Ok(())
        }
    }
}

fn coloured(out: &mut dyn WriteColor, colour: Color, text: &str) -> io::Result<()> {
    out.set_color(ColorSpec::new().set_fg(Some(colour)).set_bold(true))?;
    write!(out, "{text}")?;
    out.reset()
}

fn groups(outcome: &Outcome, under: Heading, at: Context) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    let mut by_phrase: HashMap<String, usize> = HashMap::new();
    for diagnostic in &outcome.diagnostics {
        if heading(&diagnostic.fault, &outcome.questions) != Some(under) {
            continue;
        }
        let phrase = phrase(&diagnostic.fault, at);
        let index = *by_phrase.entry(phrase).or_insert_with_key(|phrase| {
            groups.push(Group { phrase: phrase.clone(), count: 0, places: Vec::new() });
            groups.len() - 1
        });
        let group = &mut groups[index];
        group.count += 1;
        if group.places.len() < MOST_LINES {
            group.places.push(diagnostic.span.start);
        }
    }
    for counted in outcome.counted.iter().filter(|counted| counted.more > 0) {
        let phrase = phrase(&counted.fault, at);
        if let Some(group) = by_phrase.get(&phrase).and_then(|index| groups.get_mut(*index)) {
            group.count += counted.more as usize;
        }
    }
    groups.sort_by_key(|group| group.places.iter().copied().min());
    groups
}

/// Words of this account.
fn summary(form: &'static str) -> Message {
    Message::part(Part::Summary, form)
}

/// `line 6`, `lines 9, 19, 30 and 12 more`.
fn line_list(group: &Group, lines: &Lines, called: Option<&Called>) -> String {
    let file = |place: u32| called.and_then(|called| called.file(place));
    if let Some(first) = group.places.iter().find_map(|place| file(*place)) {
        // Lines of several files are reported of the first one alone.
        let in_it = |place: &&u32| file(**place).is_some_and(|other| other.name == first.name);
        let mut numbers: Vec<u64> =
            group.places.iter().filter(in_it).filter_map(|p| Some(lines.line(*p)?.number)).collect();
        numbers.sort_unstable();
        numbers.dedup();
        let others = group.count - group.places.iter().filter(in_it).count();
        let list: Vec<String> = numbers.iter().map(u64::to_string).collect();
        let message = match others {
            0 => summary("file-line"),
            others => summary("file-line-more").text("more", others.to_string()),
        };
        return message.text("file", first.name.as_str()).text("lines", list.join(", ")).headline();
    }
    let mut numbers: Vec<u64> =
        group.places.iter().filter_map(|place| lines.line(*place)).map(|line| line.number).collect();
    numbers.sort_unstable();
    numbers.dedup();
    let more = group.count - group.places.len();
    let list: Vec<String> = numbers.iter().map(u64::to_string).collect();
    let message = match (list.as_slice(), more) {
        ([only], 0) => summary("line").text("line", only),
        ([], _) => summary("places").text("more", group.count.to_string()),
        (list, 0) => {
            let (last, first) = list.split_last().map_or(("", list), |(last, first)| (last.as_str(), first));
            summary("lines").text("lines", first.join(", ")).text("last", last)
        }
        (list, more) => summary("lines-more").text("lines", list.join(", ")).text("more", more.to_string()),
    };
    message.headline()
}

/// A fault as a phrase after its heading. Details that differ from place to place are left out.
pub fn phrase(fault: &Fault, at: Context) -> String {
    // Assumptions, in the words that the operator reads at the top of the program; of those with a line of their own there,
    // and of numbers without a point, which are many, in the words of the message.
    let own = match fault {
        Fault::AssumedBareNumber { .. } | Fault::EdgeNumbered { .. } => None,
        _ => assumption(fault, [at.to, at.from]),
    };
    own.unwrap_or_else(|| message(fault, at).account())
}
