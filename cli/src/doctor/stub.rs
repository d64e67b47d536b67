//! A profile with exactly the facts that a translation asks for, each empty, with its question.

use std::fmt::Write;

use ncc_driver::render::About;
use ncc_ir::program::numbered::Numbered;
use ncc_machines::reading::{Place, Side, UNNAMED, key_of, quoted};

use super::question::Question;

/// Longest line of a comment.
const WIDE: usize = 100;

/// The text of the profile.
pub(super) fn profile(side: Side, about: &About, asked: &[Question], id: &str) -> String {
    let (from, to) = (&about.job.from.dialect.id, &about.job.to.dialect.id);
    let dialect = if side == Side::From { from } else { to };
    let mut text = String::new();
    comment(
        &mut text,
        &format!(
            "Facts about the machine that the translation of {} from {from} to {to} depends on. Fill in \
             what is known; what stays \"\" stays an assumption, and is reported. `ncc machines schema` \
             lists everything else that a profile can hold.",
            about.job.source_name
        ),
    );
    // Writing into a text cannot fail.
    let _ = writeln!(text, "id = {id:?}");
    let _ = writeln!(text, "title = \"\"");
    let _ = writeln!(text, "dialect = {dialect:?}");
    let own = || asked.iter().filter(|q| q.side == side);
    for (head, is_here) in [
        ("[options]", (|p: &Place| matches!(p, Place::Option(_))) as fn(&Place) -> bool),
        ("[power_on]", |p| matches!(p, Place::PowerOn(_))),
        ("[confirmed]", |p| matches!(p, Place::Confirmed(_))),
    ] {
        let here: Vec<&Question> = own().filter(|q| is_here(&q.place)).collect();
        if here.is_empty() {
            continue;
        }
        let _ = writeln!(text, "\n{head}");
        for question in here {
            let key = match &question.place {
                Place::PowerOn(key) => (*key).to_owned(),
                Place::Option(key) | Place::Confirmed(key) => quoted(key),
                Place::Code(_) | Place::Function(_) | Place::Name(..) | Place::Number(..) => continue,
            };
            let (lines, taken, takes) = (question.lines(), &question.taken, &question.takes);
            comment(&mut text, &format!("{lines}: taken for granted: {taken}"));
            comment(&mut text, takes);
            let _ = writeln!(text, "{key} = \"\"");
        }
    }
    for question in own() {
        let (code, function) = match &question.place {
            Place::Code(code) => (code.as_str(), ""),
            Place::Function(name) if name.starts_with(UNNAMED) => ("", ""),
            Place::Function(name) => ("", name.as_str()),
            Place::Name(..)
            | Place::Number(..)
            | Place::PowerOn(_)
            | Place::Option(_)
            | Place::Confirmed(_) => continue,
        };
        let _ = writeln!(text, "\n[[m_code]]");
        comment(&mut text, &format!("{}: {}", question.lines(), question.taken));
        comment(&mut text, &question.takes);
        let _ = writeln!(text, "code = {code:?}\nfunction = {function:?}");
    }
    for question in own() {
        // What is not known yet makes no profile: it is left out by hand, or filled in.
        let (what, keys) = match &question.place {
            Place::Name(Numbered::LengthEntry, entry) => {
                (Numbered::Tool, format!("number = \"\"\nname = \"\"\nlength_entry = {entry}"))
            }
            Place::Name(what, number) => (*what, format!("number = {number}\nname = \"\"")),
            Place::Number(what, name) => (*what, format!("number = \"\"\nname = {name:?}")),
            Place::Code(_)
            | Place::Function(_)
            | Place::PowerOn(_)
            | Place::Option(_)
            | Place::Confirmed(_) => continue,
        };
        let _ = writeln!(text, "\n[[{}]]", key_of(what));
        comment(&mut text, &format!("{}: {}", question.lines(), question.taken));
        comment(&mut text, &question.takes);
        let _ = writeln!(text, "{keys}");
    }
    text
}

/// A comment in lines that are not too long.
pub(super) fn comment(text: &mut String, words: &str) {
    let mut line = String::from("#");
    for word in words.split_whitespace() {
        if line.chars().count() + 1 + word.chars().count() > WIDE {
            text.push_str(&line);
            text.push('\n');
            line = String::from("#");
        }
        line.push(' ');
        line.push_str(word);
    }
    text.push_str(&line);
    text.push('\n');
}
