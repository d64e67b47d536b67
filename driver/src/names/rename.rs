//! Another name for all places of one, or none at all.
//!
//! It is refused where it cannot be shown that all places are known: names that are computed, lines that cannot be taken
//! apart, variables that other programs see too. What is written is executed beside what was there, and must do the same.

use ncc_dialects::{Dialect, Family};

use super::{Name, Names, Sort, find};
use crate::fmt::events::{self, Compared};
use crate::job::Job;
use crate::problem::{Exit, Problem, problem};
use crate::render::messages::message::{Message, Part};
use crate::source::spool::Spool;

/// Longest name.
const LONGEST: usize = 31;

/// Why a name stays.
fn reason(form: &'static str) -> Message {
    Message::part(Part::Rename, form)
}

fn refused(name: &Name, why: String) -> Problem {
    let shown = match name.sort {
        Sort::Variable if name.text.as_bytes()[0].is_ascii_digit() => format!("#{}", name.text),
        _ => name.text.clone(),
    };
    Problem::of(Exit::Refused, &problem("not-renamed").text("name", shown).text("reason", why), None)
}

/// A name at a place of the text, in bytes.
pub fn at(names: &Names, place: usize) -> Option<&Name> {
    let holds =
        |name: &&Name| name.places.iter().any(|own| (own.range.start..=own.range.end).contains(&place));
    names.names.iter().find(holds)
}

/// The text with another name.
///
/// # Errors
/// There is no name at that place, or it cannot be shown that the program stays the same.
pub fn rename(job: &Job, text: &[u8], place: usize, to: &str) -> Result<Vec<u8>, Problem> {
    let dialect = job.from.dialect;
    let names = find(&job.from, text);
    let Some(name) = at(&names, place) else {
        return Err(Problem::of(Exit::Refused, &problem("no-name"), None));
    };
    let to = to.trim().trim_start_matches('#').trim_matches(['<', '>']);
    let refuse = |form| Err(refused(name, reason(form).headline()));
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let by_number = is_number(&name.text);
    let word = |text: &str| {
        let mut letters = text.bytes();
        letters.next().is_some_and(|first| first.is_ascii_alphabetic() || first == b'_')
            && letters.all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
    };
    let fits = if by_number { is_number(to) && to.len() <= 8 } else { word(to) && to.len() <= LONGEST };
    if !fits {
        return refuse("form");
    }
    let new = if by_number { to.trim_start_matches('0').to_owned() } else { to.to_ascii_uppercase() };
    if new == name.text {
        return Ok(text.to_vec());
    }
    if let Some(doubt) = names.doubts.iter().find(|doubt| doubt.sort == name.sort) {
        return Err(refused(name, doubt.what.clone()));
    }
    let in_way = |other: &Name| {
        other.text == new
            && (other.sort == name.sort || !by_number)
            && (other.scope == name.scope || other.scope.is_none() || name.scope.is_none())
    };
    if names.names.iter().any(in_way) || is_block(&names, name, &new) {
        return refuse("taken");
    }
    if !name.places.iter().any(|place| place.defines) {
        return refuse("elsewhere");
    }
    if let Some(form) = seen_elsewhere(dialect, name, &new) {
        return refuse(form);
    }
    let written = replaced(text, name, to);
    // As many names as before, at as many places: nothing has run together.
    let again = find(&job.from, &written);
    let shape = |names: &Names| names.names.iter().map(|name| name.places.len()).collect::<Vec<_>>();
    if shape(&again) != shape(&names) {
        return refuse("runs-together");
    }
    let cannot = |e: std::io::Error| Problem::file("read", &job.source_name, &e);
    let (mut before, mut after) = (Spool::of(text.to_vec()), Spool::of(written.clone()));
    match events::compare(job, &mut before, &mut after, &mut Vec::new()).map_err(cannot)? {
        Compared::Same(_) => Ok(written),
        Compared::Different => refuse("different"),
        Compared::NotExecuted(..) => refuse("not-executed"),
    }
}

fn replaced(text: &[u8], name: &Name, to: &str) -> Vec<u8> {
    let mut written = Vec::with_capacity(text.len());
    let mut at = 0;
    for place in &name.places {
        written.extend_from_slice(&text[at..place.range.start]);
        written.extend_from_slice(to.as_bytes());
        at = place.range.end;
    }
    written.extend_from_slice(&text[at..]);
    written
}

/// Whether a block has this number already: nothing may lead to it.
fn is_block(names: &Names, name: &Name, new: &str) -> bool {
    let number = name.scope.zip(new.parse::<u32>().ok());
    name.sort == Sort::Block && number.is_some_and(|number| names.numbers.contains(&number))
}

/// Why programs that are not in the text may rest on the name.
fn seen_elsewhere(dialect: &Dialect, name: &Name, new: &str) -> Option<&'static str> {
    if name.sort != Sort::Variable {
        return None;
    }
    let within = |ranges: &[[u32; 2]], text: &str| {
        text.parse::<u32>().is_ok_and(|own| ranges.iter().any(|[from, to]| (*from..=*to).contains(&own)))
    };
    if dialect.family == Family::Sinumerik {
        // Parameters R hold their values from program to program; a variable that the program declares is its own.
        return name.scope.is_none().then_some("kept");
    }
    if name.text.bytes().all(|byte| byte.is_ascii_digit()) {
        let formula = &dialect.formula;
        let alike = |ranges: &[[u32; 2]]| within(ranges, &name.text) && within(ranges, new);
        return match alike(&formula.local) || alike(&formula.common) {
            true => None,
            false if within(&formula.local, &name.text) || within(&formula.common, &name.text) => {
                Some("kind")
            }
            false => Some("kept"),
        };
    }
    (name.text.starts_with('_') != new.starts_with('_')).then_some("kind")
}
