//! The document for people.

use std::io::{self, Write};

use super::document::{Deviation, Document, First, One, Place, Program, Word, verify};
use crate::render::spelled::meaning_words;

/// Differences that are shown.
const SHOWN: usize = 10;

/// Writes it.
///
/// # Errors
/// Writing.
pub fn write(out: &mut dyn Write, document: &Document) -> io::Result<()> {
    let named = |program: &Program| format!("{} ({})", program.file, program.dialect);
    let verdict = match document.verdict {
        Word::Equal => "equal",
        Word::EqualWithinTolerance => "within-tolerance",
        Word::Different => "different",
        Word::NotCompared => "not-compared",
    };
    let verdict = verify("verdict")
        .text("source", named(&document.source))
        .text("output", named(&document.output))
        .text("verdict", verdict);
    writeln!(out, "{}", verdict.headline())?;
    let mut line = |head: Option<&'static str>, text: &str| {
        let head = head.map(|head| verify(head).headline()).unwrap_or_default();
        writeln!(out, "  {head:<11} {text}")
    };
    if document.verdict != Word::Equal {
        let head = (document.verdict == Word::Different).then_some("head-differs");
        line(head, &document.summary)?;
    }
    if document.verdict != Word::NotCompared {
        line(Some("head-compared"), &compared(document))?;
    }
    for note in &document.compared.notes {
        line(None, note)?;
    }
    if let Some(deviation) = &document.largest_deviation
        && document.verdict != Word::NotCompared
    {
        line(Some("head-deviation"), &largest(document, deviation))?;
    }
    for (head, program) in [("head-source", &document.source), ("head-output", &document.output)] {
        for (form, list) in left_to_control(program, document.verdict) {
            line(Some(head), &verify(form).text("facts", list.join("; ")).headline())?;
        }
    }
    if let Some(first) = &document.first_difference {
        self::first(out, document, first)?;
    }
    for difference in document.differences.iter().take(SHOWN) {
        one(out, document, difference)?;
    }
    let left = document.differences.len().saturating_sub(SHOWN) as u64 + document.differences_not_listed;
    if left > 0 {
        writeln!(out, "\n{}", verify("further-differences").text("more", left.to_string()).headline())?;
    }
    Ok(())
}

fn compared(document: &Document) -> String {
    let c = &document.compared;
    let form = match (c.skip_settings, c.skip_levels_sampled) {
        (_, Some(_)) => "events-sampled",
        (0 | 1, None) => "events",
        (_, None) => "events-skip",
    };
    let within = document.asked.tolerance_mm.unwrap_or(0.0).max(c.resolution.mm);
    verify(form)
        .text("events", c.events.to_string())
        .count("events-count", c.events)
        .count("set-ups", c.worlds)
        .text("settings", c.skip_settings.to_string())
        .text("levels", c.skip_levels_sampled.unwrap_or_default().to_string())
        .text("within", within.to_string())
        .headline()
}

/// By how much positions differ at most, and where.
fn largest(document: &Document, deviation: &Deviation) -> String {
    let at = |place: &Option<Place>, program: &Program| {
        place.as_ref().map(|place| format!("{}:{}", program.file, place.line))
    };
    let places = [at(&deviation.source, &document.source), at(&deviation.output, &document.output)];
    let form = match &places {
        [Some(_), Some(_)] => "deviation-at-both",
        [None, None] => "deviation",
        [Some(_), None] | [None, Some(_)] => "deviation-at",
    };
    let mut message = verify(form).text("mm", deviation.mm.to_string()).text("axis", deviation.axis.as_str());
    for (name, place) in ["place", "output-place"].into_iter().zip(places.into_iter().flatten()) {
        message = message.text(name, place);
    }
    message.headline()
}

/// What each program leaves to its control, each list with its entry.
fn left_to_control(program: &Program, verdict: Word) -> Vec<(&'static str, Vec<String>)> {
    let assumed = program.assumed.iter().map(|assumed| assumed.text.clone()).collect();
    let rows = program
        .unconfirmed
        .iter()
        .map(|row| format!("{} = {}", row.code, meaning_words(&row.meaning)))
        .collect();
    let unstated = match verdict {
        Word::Equal | Word::EqualWithinTolerance => "unstated",
        Word::Different | Word::NotCompared => "unstated-unsettled",
    };
    let all: [(&str, Vec<String>); 4] = [
        ("assumed", assumed),
        ("unconfirmed", rows),
        ("shared", program.shared.clone()),
        (unstated, program.unsaid.clone()),
    ];
    all.into_iter().filter(|(_, list)| !list.is_empty()).collect()
}

fn first(out: &mut dyn Write, document: &Document, first: &First) -> io::Result<()> {
    let text = verify("first").text("difference", first.text.as_str()).headline();
    writeln!(out, "\n{}", with_switches(text, &first.block_skip))?;
    let sides = [(&document.source, &first.source), (&document.output, &first.output)];
    for (sign, (program, place)) in ['-', '+'].into_iter().zip(sides) {
        if let Some(place) = place {
            block(out, sign, program, place)?;
        }
    }
    Ok(())
}

fn one(out: &mut dyn Write, document: &Document, difference: &One) -> io::Result<()> {
    writeln!(out, "\n{}", with_switches(difference.title.clone(), &difference.block_skip))?;
    if difference.paired {
        for (source, output) in difference.source.iter().zip(&difference.output) {
            block(out, '-', &document.source, source)?;
            block(out, '+', &document.output, output)?;
        }
    } else {
        for place in &difference.source {
            block(out, '-', &document.source, place)?;
        }
        for place in &difference.output {
            block(out, '+', &document.output, place)?;
        }
    }
    if difference.further_places {
        writeln!(out, "    {}", verify("further-blocks").headline())?;
    }
    Ok(())
}

fn block(out: &mut dyn Write, sign: char, program: &Program, place: &Place) -> io::Result<()> {
    writeln!(out, "{}", format!("  {sign} {}:{}  {}", program.file, place.line, place.text).trim_end())
}

/// A difference with the block-skip switches that are on when it shows.
fn with_switches(difference: String, levels: &[u8]) -> String {
    if levels.is_empty() {
        return difference;
    }
    let levels: Vec<String> = levels.iter().map(u8::to_string).collect();
    verify("skip").text("difference", difference).text("levels", levels.join(", ")).headline()
}
