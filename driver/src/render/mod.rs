//! Telling what was found: typed diagnostics become words, with the lines that they point at.
//!
//! `messages` has the wording, `source` fetches the lines, `human` and `json` are the
//! two forms on stderr, `summary` is the account at the end. Nothing here decides anything.
//!
//! ```text
//! Fault::UnknownCode { code: "G83.5" } at 3:7    error[NC0201], the line, a mark under it, a help
//! ```

mod about;
pub mod dialects;
pub mod dictionary;
pub mod events;
pub mod explain;
pub mod head;
pub mod human;
pub mod json;
pub mod line;
pub mod messages;
pub mod numbers;
pub(crate) mod per_tool;
pub mod questions;
pub mod report;
pub mod scaffold;
pub mod source;
pub mod spelled;
pub mod summary;
pub mod terminal;
pub mod text;

use std::io;

use codespan_reporting::term::termcolor::WriteColor;

pub use self::about::{About, Loudness, Place, Told};
use crate::job::Outcome;

/// Tells people of a translation: its questions, what was found, and an account.
///
/// # Errors
/// Reading the source, or writing.
pub fn tell(
    out: &mut dyn WriteColor,
    about: &mut About,
    outcome: &Outcome,
    loudness: Loudness,
) -> io::Result<()> {
    if loudness != Loudness::Quiet || outcome.release.is_err() {
        questions::print(out, about, &outcome.questions)?;
        if !outcome.questions.is_empty()
            && !human::reported(about.job, &outcome.diagnostics, loudness).is_empty()
        {
            writeln!(out)?;
        }
    }
    human::print_counted(out, about, (&outcome.diagnostics, &outcome.counted), loudness)?;
    if loudness != Loudness::Quiet {
        summary::print(out, about, outcome)?;
    }
    Ok(())
}
