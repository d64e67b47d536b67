//! The document for people.

use std::io::{self, Write};

use super::document::{Document, First, One, Place, Program, Word};
use crate::render::numbers::plural;

/// Differences that are shown.
const SHOWN: usize = 10;

/// Writes it.
///
/// # Errors
/// Writing.
pub fn write(out: &mut dyn Write, document: &Document) -> io::Result<()> {
    let named = |program: &Program| format!("{} ({})", program.file, program.dialect);
    let [source, output] = [named(&document.source), named(&document.output)];
    let verdict = match document.verdict {
        Word::Equal => "equal",
        Word::EqualWithinTolerance => "equal within the tolerance",
        Word::Different => "different",
        Word::NotCompared => "could not be compared",
    };
    writeln!(out, "{source} and {output}: {verdict}")?;
    let mut line = |head: &str, text: &str| writeln!(out, "  {head:<11} {text}");
    if document.verdict != Word::Equal {
        line(if document.verdict == Word::Different { "differs" } else { "" }, &document.summary)?;
    }
    if document.verdict != Word::NotCompared {
        line("compared", &compared(document))?;
    }
    for note in &document.compared.notes {
        line("", note)?;
    }
    if let Some(deviation) = &document.largest_deviation
        && document.verdict != Word::NotCompared
    {
        let at = |place: &Option<Place>, program: &Program| {
            place.as_ref().map(|place| format!("{}:{}", program.file, place.line))
        };
        let places = [at(&deviation.source, &document.source), at(&deviation.output, &document.output)];
        let places: Vec<String> = places.into_iter().flatten().collect();
        line(
            "deviation",
            &format!("{} mm at most, in {}, at {}", deviation.mm, deviation.axis, places.join(" and ")),
        )?;
    }
    for (head, program) in [("source", &document.source), ("output", &document.output)] {
        for (text, list) in told(program, document.verdict) {
            line(head, &format!("{text}: {}", list.join("; ")))?;
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
        writeln!(out, "\n… and {left} more; ncc diff --all shows them")?;
    }
    Ok(())
}

fn compared(document: &Document) -> String {
    let c = &document.compared;
    let settings = match c.skip_settings {
        0 | 1 => String::new(),
        n => format!(" and {n} settings of the block-skip switches"),
    };
    let sampled = match c.skip_levels_sampled {
        None => String::new(),
        Some(levels) => format!(" (not all that {levels} levels have)"),
    };
    let within = document.asked.tolerance_mm.unwrap_or(0.0).max(c.resolution.mm);
    format!(
        "{} {} in {} {}{settings}{sampled}, to {within} mm",
        c.events,
        plural(c.events, "event"),
        c.worlds,
        plural(c.worlds.into(), "test set-up"),
    )
}

/// What each program leaves to others, with a heading each.
fn told(program: &Program, verdict: Word) -> Vec<(&'static str, Vec<String>)> {
    let assumed = program.assumed.iter().map(|assumed| assumed.text.clone()).collect();
    let rows = program.unconfirmed.iter().map(|row| format!("{} = {}", row.code, row.meaning)).collect();
    let unsaid = match verdict {
        Word::Equal | Word::EqualWithinTolerance => "never said, but no event depends on it",
        Word::Different | Word::NotCompared => "never said, and nothing settles it",
    };
    let all: [(&str, Vec<String>); 4] = [
        ("taken for granted", assumed),
        ("rows that nobody has confirmed", rows),
        ("not said, as of the source", program.shared.clone()),
        (unsaid, program.unsaid.clone()),
    ];
    all.into_iter().filter(|(_, list)| !list.is_empty()).collect()
}

fn first(out: &mut dyn Write, document: &Document, first: &First) -> io::Result<()> {
    writeln!(out, "\nfirst: {}{}", first.text, switches(&first.block_skip))?;
    let sides = [(&document.source, &first.source), (&document.output, &first.output)];
    for (sign, (program, place)) in ['-', '+'].into_iter().zip(sides) {
        if let Some(place) = place {
            block(out, sign, program, place)?;
        }
    }
    Ok(())
}

fn one(out: &mut dyn Write, document: &Document, difference: &One) -> io::Result<()> {
    writeln!(out, "\n{}{}", difference.title, switches(&difference.block_skip))?;
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
        writeln!(out, "    … and further blocks")?;
    }
    Ok(())
}

fn block(out: &mut dyn Write, sign: char, program: &Program, place: &Place) -> io::Result<()> {
    writeln!(out, "{}", format!("  {sign} {}:{}  {}", program.file, place.line, place.text).trim_end())
}

fn switches(levels: &[u8]) -> String {
    let list: Vec<String> = levels.iter().map(u8::to_string).collect();
    if list.is_empty() { String::new() } else { format!(" (with block skip {} on)", list.join(", ")) }
}
