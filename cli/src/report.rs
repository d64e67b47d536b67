//! Prints a translation's result, for people or as lines of JSON.
//!
//! ```text
//! an outcome    --format human: questions, messages, the account    --format json: one object a line
//! ```
//!
//! Not here: the words (`ncc_driver::render`).

use std::io;

use codespan_reporting::term::termcolor::WriteColor;
use ncc_driver::job::Outcome;
use ncc_driver::questions::of_translation;
use ncc_driver::render::{About, Loudness, json, line, questions, report};

use crate::args::Translate;
use crate::args::typed::Format;

/// Prints a translation's result on `err`.
///
/// # Errors
/// Reading the source, or writing.
pub(crate) fn tell(
    args: &Translate,
    about: &mut About,
    outcome: &Outcome,
    err: &mut dyn WriteColor,
) -> io::Result<()> {
    let loudness = args.telling.loudness();
    match args.format {
        Format::Json => {
            let mut out = ncc_driver::problem::as_write(err);
            for asked in questions::ask(about, &of_translation(about.job, outcome))? {
                line::line(&mut out, &asked)?;
            }
            json::print(&mut out, about, (&outcome.diagnostics, &outcome.counted), loudness)?;
            if loudness != Loudness::Quiet {
                line::line(&mut out, &report::Summary::of(about.job, outcome))?;
            }
        }
        Format::Human => ncc_driver::render::tell(err, about, outcome, loudness)?,
    }
    err.flush()
}
