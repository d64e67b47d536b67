//! `ncc diff`: do two programs make the same cut, and if not, what differs?
//!
//! `motion` executes both and holds their events side by side, `text` compares blocks. `tell` puts
//! what was found into words, which `plain`, `json` and `html` lay out; `git` is the driver for git. Not
//! here: what counts as the same, and how streams come together again (ncc-diff).

pub mod args;
mod edits;
pub mod git;
mod lines;
mod plain;
mod text;

use std::io::{self, Write};

use codespan_reporting::term::termcolor::WriteColor;
use ncc_dialects::Settings;
use ncc_driver::machines::pair::Machines;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::questions;
use ncc_driver::render::{About, human};
use ncc_driver::review::diff::{html, json};

use self::args::{Diff, Form, Ignore};
use self::text::Texts;
use super::side::{Asked, open};
use crate::registry::DialectRegistry;
use crate::time::running::Running;
use crate::{files, project};
pub use ncc_driver::review::diff::json::SCHEMA;
use ncc_driver::review::diff::motion::Motion;
use ncc_driver::review::diff::motion::motion;
use ncc_driver::review::diff::tell::Account;
use ncc_driver::side::Side;
use ncc_driver::source::Source;
use ncc_driver::source::spool::Spool;

/// Differences that are shown where not all are.
const SHOWN: usize = 10;

/// Runs the verb.
///
/// # Errors
/// Wrong usage, or a file that cannot be read or written. What is wrong with a program is reported on `err`.
pub fn run(args: &Diff, known: &DialectRegistry, err: &mut dyn WriteColor) -> Result<Exit, Problem> {
    if args.schema {
        files::to_stdout(&mut |out| out.write_all(SCHEMA.as_bytes()))?;
        return Ok(Exit::Done);
    }
    let (Some(a), Some(b)) = (args.a.as_deref(), args.b.as_deref()) else {
        return Err(Problem::usage("two programs are compared", "ncc diff A B"));
    };
    let from = args.from.as_deref();
    let given = args.holding.read()?;
    let asked = |operand, machine, options| Asked {
        operand,
        from,
        machine,
        options,
        start: args.standing.start,
        given: given.clone(),
        ..Asked::default()
    };
    let a = asked(a, args.a_machine.as_deref(), args.a_option.as_slice());
    let b = asked(b, args.b_machine.as_deref(), args.b_option.as_slice());
    let mut sides = open([&a, &b], args.telling.verbose, known, err)?;
    if !args.telling.quiet && !args.telling.verbose {
        for source in sides.iter().map(|side| &side.source) {
            if let Some(used) = &source.project {
                project::note(&source.shown, used, err);
            }
        }
    }
    if let Some(page) = &args.html {
        sides[0].source.guard(Some(page))?;
        sides[1].source.guard(Some(page))?;
    }
    let cannot = |e: &io::Error| Problem::file("compare", "the programs", e);
    let mut texts = None;
    let account = if args.text {
        let found = text::compare(&mut sides, &args.ignore).map_err(|e| cannot(&e))?;
        let account = found.account.clone();
        texts = Some(found);
        account
    } else {
        let running = Running::shown(&sides[0].source.name, !args.telling.quiet);
        let found = motion(&mut sides, args.nearness.tolerance).map_err(|e| cannot(&e))?;
        drop(running);
        if !args.telling.quiet {
            for (side, course) in sides.iter_mut().zip(&found.courses) {
                questions::note(&side.job, &mut side.source, &course.diagnostics, !course.refused, err)?;
            }
        }
        let _ = say(args, &mut sides, &found, known, err);
        if found.refused() {
            return Ok(Exit::NotCompared);
        }
        Account::of(&found, &mut sides).map_err(|e| cannot(&e))?
    };
    if let Some(page) = &args.html {
        files::to_file(page, &mut |out| html::write(out, &account))?;
    }
    show(args, &account, texts.as_ref())?;
    Ok(if account.equal { Exit::Done } else { Exit::Refused })
}

/// Two texts held side by side without a process, for tests: the document of `--format json`; `None` if
/// they cannot be executed.
///
/// # Errors
/// Anonymous files.
pub fn document(texts: [(Settings, &[u8]); 2], by_text: Option<&[Ignore]>) -> io::Result<Option<String>> {
    let mut sides = Vec::new();
    for ((settings, text), name) in texts.into_iter().zip(["a", "b"]) {
        sides.push(Side::of(Source::of(Spool::of(text.to_vec()), name), settings, Machines::default(), None));
    }
    let Ok(mut sides) = <[Side; 2]>::try_from(sides) else { return Ok(None) };
    let account = match by_text {
        Some(ignore) => text::compare(&mut sides, ignore)?.account,
        None => {
            let found = motion(&mut sides, None)?;
            if found.refused() {
                return Ok(None);
            }
            Account::of(&found, &mut sides)?
        }
    };
    let mut out = Vec::new();
    json::write(&mut out, &account)?;
    Ok(Some(String::from_utf8_lossy(&out).into_owned()))
}

fn show(args: &Diff, account: &Account, texts: Option<&Texts>) -> Result<(), Problem> {
    let most = if args.all { usize::MAX } else { SHOWN };
    let to_stdout = match args.format {
        Form::Json => files::data_to_stdout,
        Form::Human => files::to_stdout,
    };
    to_stdout(&mut |out: &mut dyn Write| match (args.format, args.telling.quiet) {
        (Form::Json, _) => json::write(out, account),
        (Form::Human, true) => Ok(()),
        (Form::Human, false) if args.summary => writeln!(out, "{}", account.summary),
        (Form::Human, false) if args.side_by_side => plain::columns(out, account, most, plain::width()),
        (Form::Human, false) => match texts {
            Some(texts) => unified(out, texts, most),
            None => plain::write(out, account, most),
        },
    })
}

/// Texts in the unified form.
fn unified(out: &mut dyn Write, texts: &Texts, most: usize) -> io::Result<()> {
    let account = &texts.account;
    for note in &account.notes {
        writeln!(out, "note: {note}")?;
    }
    if account.equal {
        return writeln!(out, "{} and {}: {}", account.names[0], account.names[1], account.summary);
    }
    writeln!(out, "--- {}\n+++ {}", account.names[0], account.names[1])?;
    for hunk in texts.unified.iter().take(most) {
        write!(out, "{hunk}")?;
    }
    match texts.unified.len().saturating_sub(most) {
        0 => Ok(()),
        left => writeln!(out, "… and {left} more; --all shows them"),
    }
}

/// Tells what was found in both programs.
fn say(
    args: &Diff,
    sides: &mut [Side; 2],
    found: &Motion,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> io::Result<()> {
    for (side, course) in sides.iter_mut().zip(&found.courses) {
        let shown = side.source.shown.clone();
        let mut about = About { job: &side.job, name: &shown, source: &mut side.source.file };
        human::print(err, &mut about, &course.diagnostics, args.telling.loudness())?;
        if course.refused {
            writeln!(
                err,
                "{shown}: not compared, because it cannot be executed as {}",
                side.job.from.dialect.id
            )?;
            let found = ncc_driver::guess::better(&mut side.source.file, &side.job.from, known.all())?;
            if let Some((other, reasons)) = found {
                writeln!(err, "{shown} reads like {}: {}", other.id, reasons.join(", "))?;
                writeln!(err, "  help: {}:{shown}", other.id)?;
            }
        }
    }
    err.flush()
}
