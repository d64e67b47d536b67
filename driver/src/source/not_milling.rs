//! Programs that are not for a mill: one message in every verb, before a dialect reads the text.
//!
//! The signs are those of `ncc_frontends::recognise`. Where the user says that all programs are for mills, the finding
//! becomes an assumption of the translation, which its head and report state.
//!
//! Not here: which dialect a milling program is written in (`guess`).

use std::io::{self, Read, Seek, SeekFrom};

use codespan_reporting::diagnostic::Severity;
use codespan_reporting::term::termcolor::WriteColor;
use codespan_reporting::term::{self, Config};
use ncc_frontends::recognise::signs::{Kind, System};
use ncc_frontends::recognise::{BEGINNING, CODE, Finding, Shown, recognise};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::source::Span;

use crate::problem::{Problem, as_write};
use crate::render::human::boxed;
use crate::render::json::Entry;
use crate::render::line;
use crate::render::messages::message::{Help, Message, Part};
use crate::render::questions::{Asked, AskedAnswer};
use crate::render::source::{Excerpt, Lines};
use crate::render::{Place, Told};
use crate::source::Source;

/// Of the further signs, so many are named.
const MOST_SIGNS: usize = 4;

/// The line that is printed of a program which is read as a milling program although it looks otherwise.
pub fn note(source: &Source) -> Option<String> {
    let Diagnostic { fault: Fault::AssumedMilling { looks_like, line }, .. } = source.assumed.first()? else {
        return None;
    };
    let note = looks("read-as-milling").text("file", &source.shown).text("looks", &**looks_like);
    Some(note.text("line", line.to_string()).headline())
}

/// Why a program is refused; `None` is a milling program. Where the user says that all are, what it looks like is
/// kept with the source.
///
/// # Errors
/// It cannot be read.
pub fn refusal(source: &mut Source, all_for_mills: bool) -> Result<Option<Refusal>, Problem> {
    let unread = |shown: &str, e: &io::Error| Problem::file("read", shown, e);
    let shown = source.shown.clone();
    let Some(finding) = look(source).map_err(|e| unread(&shown, &e))? else { return Ok(None) };
    if all_for_mills {
        let assumed = assumed(source, &finding).map_err(|e| unread(&shown, &e))?;
        source.assumed = vec![assumed];
        source.rewind()?;
        return Ok(None);
    }
    let refusal = Refusal::of(source, &finding).map_err(|e| unread(&shown, &e))?;
    source.rewind()?;
    Ok(Some(refusal))
}

/// What the beginning of a source looks like.
fn look(source: &mut Source) -> io::Result<Option<Finding>> {
    source.file.seek(SeekFrom::Start(0))?;
    let mut text = Vec::with_capacity(BEGINNING + 1);
    // One byte more tells whether the text goes on.
    (&mut source.file).take(BEGINNING as u64 + 1).read_to_end(&mut text)?;
    source.file.seek(SeekFrom::Start(0))?;
    // What is no text at all is reported by its readers.
    Ok(recognise(&text).filter(|_| !text.contains(&0)))
}

fn assumed(source: &mut Source, finding: &Finding) -> io::Result<Diagnostic> {
    let span = span(&finding.decisive);
    let lines = Lines::find(&mut source.file, vec![span.start])?;
    let line = lines.line(span.start).map_or(1, |line| line.number);
    let fault = Fault::AssumedMilling { looks_like: kind(finding).into(), line };
    Ok(Diagnostic::new(fault, span))
}

fn span(shown: &Shown) -> Span {
    Span::new(shown.place.start as u32, shown.place.end as u32)
}

/// A program that is not for a mill, in words.
#[derive(Debug)]
pub struct Refusal {
    reported: Told,
    lines: Lines,
    /// What it looks like: `a lathe program`.
    pub kind: String,
}

impl Refusal {
    fn of(source: &mut Source, finding: &Finding) -> io::Result<Refusal> {
        let others: Vec<&Shown> = finding.others.iter().take(MOST_SIGNS).collect();
        let spans: Vec<Span> =
            std::iter::once(&finding.decisive).chain(others.iter().copied()).map(span).collect();
        let lines = Lines::find(&mut source.file, spans.iter().map(|span| span.start).collect())?;
        let excerpt = Excerpt::read(&mut source.file, &lines, &source.shown, &spans[..1])?;
        let start = excerpt.location(&lines, spans[0].start).unwrap_or((1, 1));
        let text = excerpt.snippet(&lines, spans[0]).to_owned();
        let end = (start.0, start.1 + text.chars().count() as u64);
        let label = finding.decisive.sign.label.to_owned();
        let signs: Vec<String> = others
            .iter()
            .zip(&spans[1..])
            .map(|(shown, span)| {
                let line = lines.line(span.start).map_or(0, |line| line.number);
                format!("line {line}: {}", shown.sign.label)
            })
            .collect();
        let message = message(finding);
        let reported = Told {
            code: format!("NC{CODE:04}"),
            severity: Severity::Error,
            verdict: None,
            rank: None,
            message: message.headline(),
            entry: message.entry(),
            values: message.values(),
            place: Place { span: spans[0], start, end, text, label },
            related: Vec::new(),
            details: signs,
            advice: message.helps(Some(helps(finding))),
            excerpt,
        };
        Ok(Refusal { reported, lines, kind: kind(finding) })
    }

    /// Prints it for people.
    ///
    /// # Errors
    /// Writing.
    pub fn print(&self, err: &mut dyn WriteColor) -> io::Result<()> {
        let boxed = boxed(&self.reported, &self.lines);
        term::emit_to_write_style(err, &Config::default(), &self.reported.excerpt, &boxed)
            .map_err(io::Error::other)
    }

    /// It as a message for programs.
    pub fn entry(&self) -> Entry {
        Entry::of(&self.reported)
    }

    /// The same as a line.
    pub fn line(&self, err: &mut dyn WriteColor) -> Result<(), Problem> {
        line::line(&mut as_write(err), &self.entry()).map_err(|e| Problem::file("write", "messages", &e))
    }

    /// The question that it leaves to the user: what it looks like, or a milling program.
    pub fn asked(&self) -> Asked {
        let answer = |option: Option<&str>, result: String, taken| AskedAnswer {
            option: option.map(str::to_owned),
            result: Some(result),
            taken,
        };
        Asked::of_refusal(
            &self.reported,
            [
                answer(None, looks("not-translated").text("looks", &self.kind).headline(), true),
                answer(Some("--assume milling"), looks("translated").headline(), false),
            ],
        )
    }

    /// It in one line, with its place.
    pub fn reason(&self) -> String {
        looks("reason")
            .text("line", self.reported.place.start.0.to_string())
            .text("reason", &self.reported.message)
            .headline()
    }
}

/// An entry about what a text is.
fn looks(form: &'static str) -> Message {
    Message::part(Part::Looks, form)
}

/// What a program looks like: `a lathe program`.
fn kind(finding: &Finding) -> String {
    let message = match finding.kind {
        Kind::Lathe => match finding.system {
            None => looks("lathe"),
            Some(system) => looks("lathe-system").text("system", looks(control(system)).headline()),
        },
        Kind::Heidenhain => looks("heidenhain"),
        Kind::Okuma => looks("okuma"),
        Kind::Mazatrol => looks("mazatrol"),
        Kind::WireEdm => looks("wire-edm"),
        Kind::Printer => looks("printer"),
        Kind::Text => looks("text"),
    };
    message.headline()
}

/// The entry that names a control.
fn control(system: System) -> &'static str {
    match system {
        System::FanucA => "fanuc-a",
        System::FanucB => "fanuc-b",
        System::FanucC => "fanuc-c",
        System::Haas => "haas",
        System::Sinumerik => "sinumerik",
        System::LinuxCnc => "linuxcnc",
    }
}

/// The message, with what it looks like.
fn message(finding: &Finding) -> Message {
    let m = Message::new(CODE).text("looks", kind(finding));
    match (finding.certain || finding.kind == Kind::Text, finding.kind) {
        (true, _) => m,
        (false, Kind::Lathe) => m.form("lathe"),
        (false, _) => m.form("doubt"),
    }
}

/// One action; in doubt the one that answers the question.
fn helps(finding: &Finding) -> Vec<Help> {
    let supported = match finding.kind {
        Kind::Heidenhain | Kind::Okuma | Kind::Mazatrol => "help-control",
        Kind::Text => "help-text",
        Kind::Lathe | Kind::WireEdm | Kind::Printer => "help-mill",
    };
    vec![Help::new(supported), Help::new("help")]
}
