//! `ncc git-textconv`: what a program does, one line an event, for git's own diff.
//!
//! Lines name no places of the text, so that a block which is put in changes no line but its own. A
//! program that cannot be executed is printed as it is, and that is stated. Exit code 0 always: git takes
//! anything else for a broken driver.

use std::io::{self, BufWriter, Read, Seek, SeekFrom, Write};
use std::ops::ControlFlow;
use std::path::Path;

use codespan_reporting::term::termcolor::WriteColor;
use ncc_diff::record::{Batch, Style};
use ncc_driver::job::Output;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::questions;
use ncc_driver::review::feed::{Settings, records};
use ncc_driver::review::stream::clearances;
use ncc_driver::review::words::{coolant, event, number, spindle};
use ncc_driver::source::not_milling;
use ncc_exec::Kind;
use ncc_ir::canon::Spindle;

use super::args::Textconv;
use super::side::{Asked, open_one};
use crate::files;
use crate::project::Look;
use crate::registry::DialectRegistry;

/// Runs the verb.
///
/// # Errors
/// Wrong usage, or a file that cannot be read.
pub fn run(args: &Textconv, known: &DialectRegistry, err: &mut dyn WriteColor) -> Result<Exit, Problem> {
    let (_, own) = super::side::operand(&args.file, known)?;
    let name = own.file_name().unwrap_or_default().to_string_lossy();
    // Of a version in its store, git hands over a copy somewhere else.
    let look = if own.is_absolute() { Look::Named(&name) } else { Look::Git(own) };
    let asked = Asked {
        look: Some(look),
        operand: &args.file,
        from: args.from.as_deref(),
        options: &args.from_option,
        ..Asked::default()
    };
    let mut output = Output::new();
    let cannot = |e: &io::Error| Problem::file("read", &args.file, e);
    let (_, path) = super::side::operand(&args.file, known)?;
    // git ends with a driver that fails: what is no milling program is text to it.
    let other = match path == Path::new("-") {
        true => None,
        false => not_milling::refusal(&mut files::open(path)?, known.all_for_mills())?,
    };
    let opened = match other {
        Some(other) => Err(format!("{} looks like {}", path.display(), other.kind)),
        None => Ok(open_one(&asked, false, known, err)),
    };
    let why = match opened {
        Err(why) => Some(why),
        Ok(opened) => match opened {
            Ok(mut side) => match listed(&mut side, &mut output, err).map_err(|e| cannot(&e))? {
                true => None,
                false => Some(format!("{} cannot be executed as {}", side.source.shown, side.dialect().id)),
            },
            // What cannot be recognised is text.
            Err(problem) if problem.exit == Exit::Usage && args.from.is_none() => Some(problem.message),
            Err(problem) => return Err(problem),
        },
    };
    match why {
        None => files::data_to_stdout(&mut |out| output.write_to(out))?,
        Some(why) => {
            let _ = writeln!(err, "{why}; shown as it is");
            let mut source = files::open(path)?;
            source.file.seek(SeekFrom::Start(0)).map_err(|e| cannot(&e))?;
            let mut text = Vec::new();
            source.file.read_to_end(&mut text).map_err(|e| cannot(&e))?;
            files::data_to_stdout(&mut |out| out.write_all(&text))?;
        }
    }
    Ok(Exit::Done)
}

/// Writes the events; whether the program could be executed.
fn listed(
    side: &mut ncc_driver::side::Side,
    output: &mut Output,
    err: &mut dyn WriteColor,
) -> io::Result<bool> {
    let settings = Settings { clearances: clearances(&side.job), ..Settings::default() };
    let mut styles: Vec<Style> = Vec::new();
    let mut kept: Vec<Kind> = Vec::new();
    let mut last: Option<Style> = None;
    let mut written = Ok(());
    let course = records(side, settings, &mut |batch: Batch| {
        styles.extend(batch.styles);
        kept.extend(batch.kept);
        let mut piece = BufWriter::new(Vec::new());
        for record in &batch.records {
            let Some(style) = styles.get(record.style as usize).filter(|_| record.world == 0) else {
                continue;
            };
            written = state(&mut piece, last.as_ref(), style)
                .and_then(|()| writeln!(piece, "{}", event(record, style, &kept)));
            last = Some(*style);
            if written.is_err() {
                return ControlFlow::Break(());
            }
        }
        written = piece.into_inner().map_err(io::IntoInnerError::into_error).and_then(|p| output.push(&p));
        if written.is_err() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })?;
    written?;
    // What cannot be reported changes nothing about what was listed.
    let _ = questions::note(&side.job, &mut side.source, &course.diagnostics, !course.refused, err);
    Ok(!course.refused)
}

/// What is switched and set before an event.
fn state(out: &mut dyn Write, last: Option<&Style>, now: &Style) -> io::Result<()> {
    let (is, was) = (&now.state, last.map(|last| &last.state));
    let speed = |s: &ncc_diff::record::Still| match s.spindle {
        Spindle::Stopped => (s.spindle, 0),
        Spindle::Clockwise | Spindle::Counterclockwise => (s.spindle, s.speed),
    };
    if was.map_or((Spindle::Stopped, 0), speed) != speed(is) {
        match is.spindle {
            Spindle::Stopped => writeln!(out, "spindle off")?,
            turning => writeln!(out, "spindle {} {}", spindle(turning), number(is.speed))?,
        }
    }
    if was.map_or((false, false), |s| (s.flood, s.mist)) != (is.flood, is.mist) {
        writeln!(out, "coolant {}", coolant(is.coolant()))?;
    }
    if last.is_none_or(|last| (last.offset, last.length) != (now.offset, now.length)) {
        writeln!(
            out,
            "work offset {}, length {}",
            now.offset,
            ncc_driver::review::words::length(&now.length)
        )?;
    }
    Ok(())
}
