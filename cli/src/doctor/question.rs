//! Collects the open questions of a translation: facts that no profile states and that ncc assumed.
//!
//! ```text
//! no code for through-coolant    line 6
//! ```
//!
//! Not here: printing the questions, and writing answers into a profile.

use std::collections::BTreeMap;
use std::io;

use ncc_dialects::Dialect;
use ncc_driver::job::Outcome;
use ncc_driver::machines::words::takes_words;
use ncc_driver::render::About;
use ncc_driver::render::dialects::option_about;
use ncc_driver::render::messages::words::Context;
use ncc_driver::render::numbers::numbered;
use ncc_driver::render::summary::phrase;
use ncc_ir::program::numbered::Numbered;
use ncc_machines::reading::{Place, Side, UNNAMED};
use ncc_machines::schema::PowerOn;
use ncc_machines::table::Table;

/// Greatest number of line numbers shown for one question.
const MOST_LINES: usize = 8;

/// A fact that the profile does not state.
#[derive(Clone, Debug)]
pub(super) struct Question {
    /// The machine that the question is about.
    pub(super) side: Side,
    /// Key or row of the profile that answers it.
    pub(super) place: Place,
    /// The assumption of ncc, in words.
    pub(super) taken: String,
    /// The possible answers, in words.
    pub(super) takes: String,
    /// Numbers of the lines that depend on it, in order; at most [`MOST_LINES`].
    lines: Vec<u64>,
    /// Number of further diagnostics about it.
    more: usize,
}

impl Question {
    /// `line 6`, `lines 9, 18, 28 and 3 more`, or `the whole program`.
    pub(super) fn lines(&self) -> String {
        let list: Vec<String> = self.lines.iter().map(u64::to_string).collect();
        let more = match self.more {
            0 => String::new(),
            n => format!(" and {n} more"),
        };
        match list.as_slice() {
            [] => "the whole program".to_owned(),
            [only] if self.more == 0 => format!("line {only}"),
            list => format!("lines {}{more}", list.join(", ")),
        }
    }
}

/// The questions, by machine, then by the first line that depends on each.
///
/// # Errors
/// ncc cannot read the source.
pub(super) fn questions(about: &mut About, outcome: &Outcome) -> io::Result<Vec<Question>> {
    let lines = about.lines(outcome.rests.iter().map(|rest| &outcome.diagnostics[rest.diagnostic]))?;
    let (from, to) = (about.job.from.dialect, about.job.to.dialect);
    let at = Context { from, to, snippet: "", beside: ("", "") };
    let mut found: BTreeMap<(Side, Place), Question> = BTreeMap::new();
    for rest in &outcome.rests {
        let diagnostic = &outcome.diagnostics[rest.diagnostic];
        let dialect = if rest.side == Side::From { from } else { to };
        let question = found.entry((rest.side, rest.place.clone())).or_insert_with(|| Question {
            side: rest.side,
            place: rest.place.clone(),
            taken: match &rest.place {
                Place::Code(code) => format!("what {code} does is not known"),
                Place::Function(name) => format!("no code for {}", function(name)),
                Place::Name(what, number) => format!("{} {number} has no name", numbered(*what, 1)),
                Place::Number(what, name) => format!("no {} named {name}", numbered(*what, 1)),
                Place::PowerOn(_) | Place::Option(_) | Place::Confirmed(_) => phrase(&diagnostic.fault, at),
            },
            takes: takes(&rest.place, dialect),
            lines: Vec::new(),
            more: 0,
        });
        let Some(line) = lines.line(diagnostic.span.start) else { continue };
        match question.lines.len() < MOST_LINES {
            _ if question.lines.contains(&line.number) => {}
            true => question.lines.push(line.number),
            false => question.more += 1,
        }
    }
    let mut questions: Vec<Question> = found.into_values().collect();
    questions.sort_by_key(|q| (q.side, q.lines.first().copied()));
    Ok(questions)
}

/// Name of a function; for a code without a name, a description of it.
fn function(name: &str) -> String {
    match name.strip_prefix(UNNAMED) {
        Some(number) => format!("what M{number} does on the other machine"),
        None => name.to_owned(),
    }
}

/// Possible values of a place in a profile, in words.
fn takes(place: &Place, dialect: &Dialect) -> String {
    match place {
        Place::PowerOn(key) => {
            let key = PowerOn::KEYS.iter().find(|k| k.name == *key);
            key.map_or(String::new(), |k| {
                format!("{} possible: {}", k.about.trim(), takes_words(k.takes).replace('`', ""))
            })
        }
        Place::Option(name) => dialect.option.iter().find(|o| o.name == *name).map_or(String::new(), |row| {
            let values = match row.values.is_empty() {
                true => "a number".to_owned(),
                false => row.values.join(", "),
            };
            format!("{} possible: {values}", option_about(dialect, row))
        }),
        Place::Confirmed(_) => "is it so on this machine? possible: true, false".to_owned(),
        Place::Code(_) => "a name for its function, in small letters; the same in the profile of the other \
                           machine. It must move no axis and change no tool."
            .to_owned(),
        Place::Name(Numbered::LengthEntry, _) => {
            "the tool whose length it is, with its number and its name, \
                                                  the same in the profile of the other machine"
                .to_owned()
        }
        Place::Name(..) => "its name, the same in the profile of the other machine".to_owned(),
        Place::Number(..) => "its number on this machine".to_owned(),
        Place::Function(_) => "the code, and the name as the profile of the other machine has it".to_owned(),
    }
}
