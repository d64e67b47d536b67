//! A program named on the command line as `PATH` or `DIALECT:PATH`, for verbs that hold two programs
//! side by side.
//!
//! [`open`] finds the dialect as `translate` does: by name, by the machine's profile, or by the text
//! itself. A side is a [`Job`] that translates the program into its own dialect, because that is what
//! execution and the rendering of diagnostics ask for. Not here: executing (`stream`), comparing.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use codespan_reporting::term::termcolor::WriteColor;
use ncc_dialects::Dialect;
use ncc_driver::guess::{Guess, guess};
use ncc_driver::job::initial_variables::InitialVariables;
use ncc_driver::job::options::{choose, state_units};
use ncc_driver::machines::pair::Machines;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::side::Side;
use ncc_driver::source::{Source, include_path};
use ncc_machines::Profile;
use ncc_machines::reading::Side as Whose;

use crate::args::typed::Start;
use crate::args::typed::is_name;
use crate::files::{self, AS_STORED};
use crate::m_codes;
use crate::machines::agreed;
use crate::milling::{self, Voice};
use crate::project::{self, InForce, Look, Sides, Stated, settle};
use crate::registry::DialectRegistry;
use crate::registry::recognised::recognise;

/// What a command says of one side.
#[derive(Clone, Debug, Default)]
pub(crate) struct Asked<'a> {
    /// `PATH` or `DIALECT:PATH`; the path `-` is stdin.
    pub(crate) operand: &'a str,
    /// A dialect that counts where the operand has none; `auto` is none.
    pub(crate) from: Option<&'a str>,
    /// A machine's profile, by name or file; it names the dialect too.
    pub(crate) machine: Option<&'a str>,
    /// Choices where the dictionary leaves a question open.
    pub(crate) options: &'a [(String, String)],
    /// Where the tool stands before the first block.
    pub(crate) start: Option<Start>,
    /// What its variables hold before.
    pub(crate) given: InitialVariables,
    /// A machine that the command line names for another purpose than reading: none of a project file counts beside it.
    pub(crate) beside: Option<&'a str>,
    /// Which program a project file is asked about; by default the one in the operand's file.
    pub(crate) look: Option<Look<'a>>,
    /// Whether it is the output of the other side: the target's machine of that is its own, unless a project file says
    /// something of it.
    pub(crate) is_output: bool,
}

impl Asked<'_> {
    /// What the command line states of it.
    fn stated(&self) -> Stated<'_> {
        let machine = self.machine.or(self.beside);
        Stated {
            from: self.from,
            machine,
            from_options: self.options,
            to: self.from,
            machine_to: machine,
            to_options: self.options,
            output: None,
        }
    }
}

/// An operand taken apart: the dialect, if it names one, and the path. What stands before the colon
/// is a dialect if there is one of that name; `./mach9:a.cn` is always a file.
///
/// # Errors
/// It looks like a dialect, there is none of that name, and no such file either.
pub(crate) fn operand<'o>(
    text: &'o str,
    known: &DialectRegistry,
) -> Result<(Option<&'static Dialect>, &'o Path), Problem> {
    let Some((id, path)) = text.split_once(':').filter(|(id, path)| is_name(id) && !path.is_empty()) else {
        return Ok((None, Path::new(text)));
    };
    match known.get(id) {
        Some(dialect) => Ok((Some(dialect), Path::new(path))),
        None if id == "auto" => Ok((None, Path::new(path))),
        None if Path::new(text).exists() => Ok((None, Path::new(text))),
        None => known.dialect(id).map(|dialect| (Some(dialect), Path::new(path))),
    }
}

/// Opens both sides of a comparison.
///
/// A dialect that nobody names is recognised, and reported on `err` where `say` is set. A text in which
/// too little speaks for any dialect is read as the other side is, if nothing speaks against that.
///
/// # Errors
/// Wrong usage, a file that cannot be read, or a dialect that is not certain.
pub(crate) fn open(
    asked: [&Asked; 2],
    say: bool,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<[Side; 2], Problem> {
    let [a, b] = asked;
    let mut first = Opened::of(a, None, say, known, err).map_err(unread)?;
    let target = first.row.clone().filter(|_| b.is_output);
    let mut second = Opened::of(b, target.as_deref(), say, known, err).map_err(unread)?;
    if first.stdin && second.stdin {
        return Err(Problem::usage("stdin can be read only once", "name a file for one side"));
    }
    first.settle(second.named, say, known, err)?;
    second.settle(first.named, say, known, err)?;
    // The second side may have been recognised after the first was in doubt.
    first.settle(second.named, say, known, err)?;
    for side in [&mut first, &mut second] {
        if side.named.is_none() {
            side.named = Some(recognise(&mut side.source, say, known, err).map_err(uncomparable)?);
        }
    }
    Ok([first.finish(a, say, known, err)?, second.finish(b, say, known, err)?])
}

/// An unknown dialect is no wrong usage here: the programs could not be compared.
fn uncomparable(problem: Problem) -> Problem {
    match problem.exit {
        Exit::File => problem,
        _ => Problem { exit: Exit::NotCompared, ..problem },
    }
}

/// A side that is stored as no control reads it: exit code 1 would say that both differ.
fn unread(problem: Problem) -> Problem {
    match problem.exit {
        Exit::Refused if problem.message.contains(AS_STORED) => uncomparable(problem),
        _ => problem,
    }
}

/// Opens one program.
///
/// # Errors
/// As of [`open`].
pub(crate) fn open_one(
    asked: &Asked,
    say: bool,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<Side, Problem> {
    let mut opened = Opened::of(asked, None, say, known, err)?;
    opened.settle(None, say, known, err)?;
    opened.finish(asked, say, known, err)
}

/// A side of which the dialect may not be known yet.
struct Opened {
    source: Source,
    named: Option<&'static Dialect>,
    profile: Option<Arc<Profile>>,
    /// What a project file says of it.
    row: Option<Arc<InForce>>,
    /// Dialects that explain a text as well which was recognised.
    rivals: Vec<&'static Dialect>,
    stdin: bool,
}

impl Opened {
    /// `target` is what a project file says of the program that this one is the output of.
    fn of(
        asked: &Asked,
        target: Option<&InForce>,
        say: bool,
        known: &DialectRegistry,
        err: &mut dyn WriteColor,
    ) -> Result<Opened, Problem> {
        let (named, path) = operand(asked.operand, known)?;
        let path: PathBuf = path.to_owned();
        let from = asked.from.filter(|id| *id != "auto").map(|id| known.dialect(id)).transpose()?;
        let row = known.project(asked.look.unwrap_or(Look::File(&path)), err)?;
        // An output is never a source of its own row.
        let target = target.filter(|target| row.is_none() || target.has_output(&path));
        let settled = match (&row, target) {
            (_, Some(target)) => Some(settle(target, Sides::Target, &asked.stated(), named, known)?),
            (Some(row), None) => Some(settle(row, Sides::One, &asked.stated(), named, known)?),
            (None, None) => None,
        };
        let profile = match asked.machine {
            Some(name) => Some(Arc::new(crate::machines::find(name, known, err)?)),
            None => settled.as_ref().and_then(|settled| settled.machine.clone()),
        };
        let named = match named {
            Some(dialect) => agreed(Some(dialect), profile.as_deref(), "from")?,
            // What holds for both sides gives way to a profile of one.
            None => profile.as_ref().map(|profile| profile.dialect).or(from),
        };
        let voice = if say { Voice::Human } else { Voice::Quiet };
        let mut source = milling::open(&path, voice, known, err)?;
        if let Some(settled) = &settled {
            settled.put_into(&mut source);
            if say {
                project::note(&source.shown, &settled.used, err);
            }
        }
        Ok(Opened { source, named, profile, row, rivals: Vec::new(), stdin: path == Path::new("-") })
    }

    /// Finds the dialect, if the text or the other side tells it.
    fn settle(
        &mut self,
        other: Option<&'static Dialect>,
        say: bool,
        known: &DialectRegistry,
        err: &mut dyn WriteColor,
    ) -> Result<(), Problem> {
        if self.named.is_some() {
            return Ok(());
        }
        let shown = self.source.shown.clone();
        let found =
            guess(&mut self.source.file, known.all()).map_err(|e| Problem::file("read", &shown, &e))?;
        let (dialect, why) = match found {
            Guess::Sure(dialect, reasons, rivals) => {
                self.rivals = rivals;
                (dialect, reasons.join(", "))
            }
            Guess::Unsure(fits) => {
                let fits = |d: &Dialect| {
                    fits.is_empty() || fits.iter().any(|(f, con)| f.id == d.id && con.is_empty())
                };
                match other.filter(|d| fits(d)) {
                    Some(dialect) => (dialect, "as the other side; nothing speaks against it".to_owned()),
                    None => return Ok(()),
                }
            }
        };
        self.named = Some(dialect);
        if say {
            let _ = writeln!(err, "{shown}: read as {}: {why}", dialect.id);
        }
        Ok(())
    }

    fn finish(
        mut self,
        asked: &Asked,
        say: bool,
        known: &DialectRegistry,
        err: &mut dyn WriteColor,
    ) -> Result<Side, Problem> {
        let dialect = match self.named {
            Some(dialect) => dialect,
            None => recognise(&mut self.source, say, known, err)?,
        };
        // What a profile states of its control holds for programs in that control's language.
        let machines = match self.profile.filter(|profile| profile.dialect.id == dialect.id) {
            Some(profile) => Machines { from: Some(Arc::clone(&profile)), to: Some(profile) },
            None => Machines::default(),
        };
        let stated = machines.from.is_some();
        let mut from = choose(machines.settings(Whose::From, dialect), asked.options)?;
        // Of two sides, one may be in a language that has its own.
        let fixed = !stated && dialect.power_on.units.as_ref().is_some_and(|row| row.always);
        if !fixed {
            state_units(&mut from, known.units())?;
        }
        m_codes::state(&mut from, Whose::From, known)?;
        for name in asked.given.names() {
            let whole = asked.given.only(name).filter(|value| value.fract() == 0.0);
            whole.into_iter().for_each(|value| from.state_value(name, value as i64));
        }
        include_path::load_subprograms(&mut self.source, &from, known.folders(), &files::Disk)?;
        self.source.rewind()?;
        let mut side = Side::of(self.source, from, machines, asked.start);
        side.job.given = asked.given.clone();
        side.job.rivals = self.rivals;
        Ok(side)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dialect_stands_before_a_colon() {
        let known = DialectRegistry::built_in();
        let taken = |text| operand(text, &known).map(|(d, p)| (d.map(|d| d.id.as_str()), p.to_owned()));
        for (text, dialect, path) in [
            ("mach9:a.cn", Some("mach9"), "a.cn"),
            ("fanuc:C:\\a.nc", Some("fanuc"), "C:\\a.nc"),
            ("C:\\a.nc", None, "C:\\a.nc"),
            ("./mach9:a.cn", None, "./mach9:a.cn"),
            ("auto:a.cn", None, "a.cn"),
            ("fanuc:-", Some("fanuc"), "-"),
            ("a.cn", None, "a.cn"),
            (":a", None, ":a"),
            ("mach9:", None, "mach9:"),
        ] {
            assert_eq!(taken(text), Ok((dialect, PathBuf::from(path))), "{text}");
        }
        assert!(taken("nosuch:a.cn").is_err());
    }
}
