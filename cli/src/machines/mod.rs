//! Machine profiles on the command line: finding one, and telling what is wrong with it.

mod words;

use std::path::Path;

use codespan_reporting::diagnostic::{Diagnostic as Boxed, Label};
use codespan_reporting::files::SimpleFile;
use codespan_reporting::term::termcolor::WriteColor;
use codespan_reporting::term::{self, Config};
use ncc_machines::{Profile, ProfileError, shipped};

use crate::known::Known;
use crate::problem::{Exit, Problem};
use words::{message, words};

/// A profile by the name of a shipped one, or by its file. What is wrong with it is told on `err`.
///
/// # Errors
/// There is none of that name, the file cannot be read, or the profile has faults.
pub fn find(name: &str, known: &Known, err: &mut dyn WriteColor) -> Result<Profile, Problem> {
    if let Some(profile) = ncc_machines::find(name) {
        return Ok(profile.clone());
    }
    let path = Path::new(name);
    let is_path = name.contains(['/', '\\', '.']) || path.exists();
    if !is_path {
        let ids: Vec<&str> = shipped().iter().map(Profile::id).collect();
        return Err(Problem::usage(
            format!("there is no machine `{name}`"),
            format!("there are: {}; or name the file of a profile", ids.join(", ")),
        ));
    }
    let bytes = std::fs::read(path).map_err(|e| Problem::file("read", name, &e))?;
    let text = String::from_utf8(bytes).map_err(|_| Problem {
        exit: Exit::File,
        message: format!("{name} is not UTF-8 text"),
        help: vec!["a profile is a TOML file".to_owned()],
    })?;
    Profile::parse(&text, &|id| known.get(id)).map_err(|wrong| {
        // If stderr cannot be written, the exit code has to say it all.
        let _ = print(name, &text, &wrong, err);
        Problem {
            exit: Exit::Usage,
            message: format!("the profile {name} cannot be used: {}", count(wrong.len(), "error")),
            help: Vec::new(),
        }
    })
}

/// Prints what is wrong with a profile.
///
/// # Errors
/// Writing.
pub fn print(
    name: &str,
    text: &str,
    wrong: &[ProfileError],
    err: &mut dyn WriteColor,
) -> Result<(), codespan_reporting::files::Error> {
    let file = SimpleFile::new(name, text);
    for error in wrong {
        let said = words(&error.wrong);
        let mut labels = vec![Label::primary((), error.span.clone()).with_message(said.label)];
        if let Some(related) = &error.related {
            labels.push(Label::secondary((), related.clone()).with_message("the first one"));
        }
        let boxed = Boxed::error()
            .with_code(format!("NC{:04}", error.wrong.code()))
            .with_message(message(&error.wrong))
            .with_labels(labels)
            .with_notes(said.help.into_iter().map(|help| format!("help: {help}")).collect());
        term::emit_to_write_style(err, &Config::default(), &file, &boxed)?;
    }
    Ok(())
}

/// `1 error`, `2 errors`.
fn count(n: usize, noun: &str) -> String {
    format!("{n} {noun}{}", if n == 1 { "" } else { "s" })
}
