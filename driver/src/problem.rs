//! What keeps a command from being done, and the exit codes.

use std::fmt;
use std::io::{self, Write};

use codespan_reporting::term::termcolor::{Color, ColorSpec, WriteColor};
use serde::Serialize;

use crate::render::line;
use crate::render::messages::message::{Help, Message, Part};
use crate::source::interrupted::Interrupted;
use crate::source::spool::Lacking;

/// Exit codes, as the help names them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// Done, and verified unless that was not wanted.
    Done = 0,
    /// The program has errors, or a loss is not allowed; of two programs that are compared: they differ.
    Refused = 1,
    /// Wrong usage.
    Usage = 2,
    /// Verification failed; nothing is released.
    VerificationFailed = 3,
    /// A file, or its character set.
    File = 4,
    /// Programs could not be compared.
    NotCompared = 5,
    /// Ctrl-C: nothing was written (128 and the number of SIGINT, as shells have it).
    Interrupted = 130,
}

impl Exit {
    /// That of two files of one command: the higher one.
    pub fn and(self, other: Exit) -> Exit {
        if other as u8 > self as u8 { other } else { self }
    }
}

/// A command that cannot be done, told before or beside any diagnostics of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// The exit code.
    pub exit: Exit,
    /// What is wrong, in one line; empty if there is nobody to tell.
    pub message: String,
    /// What to do.
    pub help: Vec<String>,
}

/// A fault of a request for the compiler as a library.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RequestFault {
    /// It is not of the form; the reader's words.
    Unread(String),
    /// No message has this code.
    NoMessage(String),
    /// No profile has this name.
    NoMachine(String),
    /// A profile has so many errors.
    Profile(String, usize),
    /// No dialect has this name; the names that there are.
    NoDialect(String, Vec<&'static str>),
    /// No verdict has this name.
    NoVerdict(String),
    /// No target is named.
    NoTarget,
    /// The value of a variable is not of the form; why.
    Value(String, String),
    /// A start position is not of the form; why.
    Start(String, String),
    /// The time on the clock before the first block is not 0 or more.
    StartTime,
    /// No model of times has this name; the names that there are.
    NoModel(String),
    /// No pass has this name.
    NoPass(String),
    /// The output would be several files.
    SeveralFiles,
    /// The tolerance is no length.
    NoTolerance,
    /// A body is not of the form.
    Body(String),
    /// A tool is not of the form.
    Tool(String),
    /// There is no program that was cut.
    NothingCut,
}

impl From<RequestFault> for Problem {
    fn from(fault: RequestFault) -> Problem {
        let mut help = None;
        let message = match fault {
            RequestFault::Unread(reason) => problem("unread-request").text("reason", reason),
            RequestFault::NoMessage(name) => problem("no-message").text("name", name),
            RequestFault::NoMachine(name) => problem("no-machine").text("name", name),
            RequestFault::Profile(name, errors) => {
                problem("profile").text("name", name).count("count", errors as u64)
            }
            RequestFault::NoDialect(name, among) => {
                help = Some(vec![Help::new("help").text("among", among.join(", "))]);
                problem("no-dialect").text("name", name)
            }
            RequestFault::NoVerdict(name) => problem("no-verdict").text("name", name),
            RequestFault::NoTarget => problem("no-target"),
            RequestFault::Value(name, reason) => problem("value").text("name", name).text("reason", reason),
            RequestFault::Start(text, reason) => problem("start").text("text", text).text("reason", reason),
            RequestFault::StartTime => problem("start-time"),
            RequestFault::NoModel(name) => problem("no-model").text("name", name),
            RequestFault::NoPass(name) => problem("no-pass").text("name", name),
            RequestFault::SeveralFiles => problem("several-files"),
            RequestFault::NoTolerance => problem("no-tolerance"),
            RequestFault::Body(text) => problem("body").text("text", text),
            RequestFault::Tool(text) => problem("tool").text("text", text),
            RequestFault::NothingCut => problem("nothing-cut"),
        };
        Problem::of(Exit::Usage, &message, help)
    }
}

/// Work that ncc broke off by itself, as the error of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BrokenOff {
    /// The execution of one of two programs ended before its end.
    Side,
    /// The output is longer than the places of its map.
    LongMap,
    /// The output is longer than so many bytes, which are the host's limit.
    LongOutput(u64),
    /// The program makes more than so many moves, which are the host's limit.
    LongPath(usize),
}

impl fmt::Display for BrokenOff {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self, out)
    }
}

impl std::error::Error for BrokenOff {}

/// An entry about a command that cannot be done.
pub(crate) fn problem(form: &'static str) -> Message {
    Message::part(Part::Problem, form)
}

impl Problem {
    /// A message with its helps: those that are named, or else the entry's own if it has one.
    pub(crate) fn of(exit: Exit, message: &Message, helps: Option<Vec<Help>>) -> Problem {
        Problem { exit, message: message.headline(), help: message.helps(helps) }
    }

    /// Wrong usage.
    pub fn usage(message: impl Into<String>, help: impl Into<String>) -> Problem {
        Problem { exit: Exit::Usage, message: message.into(), help: vec![help.into()] }
    }

    /// A file that cannot be used.
    pub fn file(what: &str, name: &str, error: &io::Error) -> Problem {
        let failed =
            |reason: String| problem("file").text("action", what).text("name", name).text("reason", reason);
        if let Some(lacking) = error.get_ref().and_then(|inner| inner.downcast_ref::<Lacking>()) {
            let reason = problem("no-store")
                .text("folder", lacking.folder.display().to_string())
                .text("reason", lacking.reason.as_str())
                .text("variable", if cfg!(windows) { "TMP" } else { "TMPDIR" });
            return Problem {
                help: reason.helps(None),
                ..Problem::of(Exit::File, &failed(reason.headline()), None)
            };
        }
        if let Some(interrupted) = error.get_ref().and_then(|inner| inner.downcast_ref::<Interrupted>()) {
            let message = match interrupted.line {
                Some(line) => problem("interrupted-at").text("line", line.to_string()),
                None => problem("interrupted"),
            };
            return Problem::of(Exit::Interrupted, &message.text("name", name), None);
        }
        let broken_off = error.get_ref().and_then(|inner| inner.downcast_ref::<BrokenOff>());
        let reason = match (broken_off, error.kind()) {
            (Some(BrokenOff::Side), _) => problem("side-broken-off").headline(),
            (Some(BrokenOff::LongMap), _) => problem("long-map").headline(),
            (Some(BrokenOff::LongOutput(most)), _) => {
                problem("long-output").text("most", most.to_string()).headline()
            }
            (Some(BrokenOff::LongPath(most)), _) => {
                problem("long-path").text("most", most.to_string()).headline()
            }
            (None, io::ErrorKind::NotFound) => problem("not-found").headline(),
            (None, io::ErrorKind::PermissionDenied) => problem("denied").headline(),
            (None, io::ErrorKind::IsADirectory) => problem("folder").headline(),
            (None, _) => error.to_string(),
        };
        Problem::of(Exit::File, &failed(reason), None)
    }

    /// Prints it.
    ///
    /// # Errors
    /// Writing.
    pub fn print(&self, out: &mut dyn WriteColor, json: bool) -> io::Result<()> {
        self.print_as(out, ("error", Color::Red), json)
    }

    /// Prints it as a warning: the command is done without what is lacking.
    ///
    /// # Errors
    /// Writing.
    pub fn warn(&self, out: &mut dyn WriteColor) -> io::Result<()> {
        self.print_as(out, ("warning", Color::Yellow), false)
    }

    fn print_as(
        &self,
        out: &mut dyn WriteColor,
        (severity, colour): (&'static str, Color),
        json: bool,
    ) -> io::Result<()> {
        #[derive(Serialize)]
        struct Line<'a> {
            severity: &'static str,
            message: &'a str,
            advice: &'a [String],
        }
        if self.message.is_empty() {
            return Ok(());
        }
        if json {
            let line = Line { severity, message: &self.message, advice: &self.help };
            return line::line(&mut as_write(out), &line);
        }
        out.set_color(ColorSpec::new().set_fg(Some(colour)).set_bold(true).set_intense(true))?;
        write!(out, "{severity}")?;
        out.reset()?;
        writeln!(out, ": {}", self.message)?;
        for (i, line) in self.help.iter().enumerate() {
            writeln!(out, "{}{line}", if i == 0 { "  help: " } else { "        " })?;
        }
        Ok(())
    }
}

/// A coloured output as a plain one.
pub fn as_write(out: &mut dyn WriteColor) -> impl Write + '_ {
    struct Plain<'a>(&'a mut dyn WriteColor);
    impl Write for Plain<'_> {
        fn write(&mut self, text: &[u8]) -> io::Result<usize> {
            self.0.write(text)
        }
        fn flush(&mut self) -> io::Result<()> {
            self.0.flush()
        }
    }
    Plain(out)
}
