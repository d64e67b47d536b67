//! The bench on which rows are tried: statements in the text form of the neutral program are written
//! in the dialect, read back, and compared in the text form again.
//!
//! Numbers are compared by value, whatever zeros they are written with; whether a block says its motion
//! code, and which statements stand in one block, is layout and does not count.

use ncc_backends::{Head, Layout, Numbering, Writer};
use ncc_dialects::{Dialect, Settings, builtin};
use ncc_frontends::{Batch, Reader};
use ncc_ir::canon::Modes;
use ncc_ir::caps::LengthsOf;
use ncc_ir::diag::{Diagnostic, Fault, Gravity};
use ncc_ir::program::{Procedure, ProgramName, Stmt};

use super::row::Row;
use crate::render::dictionary::dictionary;
use crate::render::messages::message::Message;
use crate::render::messages::words::{Context, words};

/// A statement to be tried, in the text form of the neutral program.
#[derive(Clone, Debug, Default)]
pub struct Said {
    /// What has to come before it, besides the bench's own beginning.
    pub before: String,
    /// The statement, one block a line.
    pub say: String,
    /// Statements that must follow it.
    pub after: String,
    /// Subprograms.
    pub procedures: String,
}

impl Said {
    /// A statement by itself.
    pub fn new(say: impl Into<String>) -> Said {
        Said { say: say.into(), ..Said::default() }
    }

    /// With something before it.
    pub fn after(self, before: impl Into<String>) -> Said {
        Said { before: before.into(), ..self }
    }
}

/// What came of writing and reading.
#[derive(Clone, Debug, Default)]
pub struct Tried {
    /// The lines that say it.
    pub written: Vec<String>,
    /// What they were read as.
    pub read: Vec<String>,
    /// Why it failed, if it did.
    pub failed: Option<String>,
}

/// A text that was written.
struct Text {
    text: String,
    /// What its writer could not say.
    faults: Vec<String>,
}

/// A dialect, and the beginning of a program that it can say.
pub struct Bench {
    pub(crate) dialect: &'static Dialect,
    pub(crate) settings: Settings,
    begin: Vec<Stmt>,
    end: String,
}

/// A beginning, as far as the dialect supports it.
const BEGIN: &[&str] = &[
    "USE_LENGTH_UNITS(mm)",
    "SELECT_PLANE(XY)",
    "SET_DISTANCE_MODE(absolute)",
    "SET_FEED_MODE(per-minute)",
    "SET_ORIGIN_OFFSETS(1)",
    "SELECT_TOOL(1) & CHANGE_TOOL()",
    "SELECT_TOOL(1) & CHANGE_TOOL() & USE_TOOL_EDGE(1)",
    "SET_SPINDLE_SPEED(1000) & START_SPINDLE_CLOCKWISE()",
    "USE_TOOL_LENGTH_OFFSET(1) & said STRAIGHT_TRAVERSE(Z 50mm)",
    "said STRAIGHT_TRAVERSE(Z 50mm)",
    "said STRAIGHT_TRAVERSE(X 3mm, Y 4mm)",
    "SET_FEED_RATE(100mm) & said STRAIGHT_FEED(Z 40mm)",
    "SET_RETURN_LEVEL(initial)",
];

impl Bench {
    pub(crate) fn new(dialect: &'static Dialect) -> Bench {
        let settings = Settings::new(dialect);
        let mut bench = Bench { dialect, settings, begin: Vec::new(), end: "PROGRAM_END()".to_owned() };
        for line in BEGIN {
            let edge = line.contains("USE_TOOL_EDGE");
            if line.contains("CHANGE_TOOL") && edge != (dialect.caps.tools.lengths_of == LengthsOf::Edges) {
                continue;
            }
            let before = bench.begin.len();
            bench.begin.extend(parse(line).stmts);
            let text = bench.write(&bench.begin, "", "", &ProgramName::default());
            let whole = text.faults.is_empty() && bench.read(&text.text).1.is_empty();
            // The way that needs a length offset is tried first.
            let stands =
                line.starts_with("said STRAIGHT_TRAVERSE(Z") && bench.has("STRAIGHT_TRAVERSE(Z", before);
            if !whole || stands {
                bench.begin.truncate(before);
            }
        }
        let end = bench.write(&bench.begin, "PROGRAM_END()", "", &ProgramName::default());
        if !end.faults.is_empty() {
            bench.end.clear();
        }
        bench
    }

    fn has(&self, what: &str, upto: usize) -> bool {
        spelled(&self.begin[..upto], &[]).iter().any(|line| line.contains(what))
    }

    /// Writes a statement and reads it back.
    pub fn both_ways(&self, said: &Said) -> Tried {
        self.reads(said, &said.say, |text| text)
    }

    /// Tries how a text is read that is not quite the written one.
    pub fn reads(&self, said: &Said, meant: &str, change: impl Fn(String) -> String) -> Tried {
        self.reads_as(said, meant, change, Some)
    }

    /// The same, of a text of which the lines that are read are stated in another way, or not at all.
    pub fn reads_as(
        &self,
        said: &Said,
        meant: &str,
        change: impl Fn(String) -> String,
        read_as: impl Fn(String) -> Option<String>,
    ) -> Tried {
        let mut before = self.begin.clone();
        before.extend(parse(&said.before).stmts);
        let name = &ProgramName::default();
        let ended = said.say.contains("PROGRAM_END");
        let after = if ended { String::new() } else { format!("{}\n{}", said.after, self.end) };
        let without = self.write(&before, &after, "", name);
        let with = self.write(&before, &format!("{}\n{after}", said.say), &said.procedures, name);
        let text = change(with.text);
        let (read, faults) = self.read(&text);
        let read: Vec<String> = read.into_iter().filter_map(read_as).collect();
        let mut tried =
            Tried { written: between(&lines(&without.text), &lines(&text)), read: Vec::new(), failed: None };
        if let Some(fault) = with.faults.first() {
            tried.failed = Some(dictionary("cannot-write").text("why", fault).headline());
            return tried;
        }
        let expected = parse(&format!("{meant}\n{after}"));
        let procedures = parse(&said.procedures).procedures;
        let expected = spelled(&expected.stmts, &procedures);
        let tail = read.len().saturating_sub(expected.len());
        let own = spelled(&parse(meant).stmts, &[]).len();
        tried.read = match read[tail..] == expected[..] {
            true => expected[..own].to_vec(),
            false => {
                let (whole, _) = self.read(&without.text);
                let found = between(&whole, &read);
                if found.is_empty() { read[tail..].to_vec() } else { found }
            }
        };
        if let Some(fault) = faults.first() {
            tried.read.clear();
            tried.failed = Some(dictionary("cannot-read").text("why", fault).headline());
        } else if read[tail..] != expected[..] {
            let meant = expected[..own].join(" ¶ ");
            tried.failed = Some(dictionary("meant").text("meant", meant).headline());
        }
        tried
    }

    /// Reads a text in place of a statement; it must be refused by a name.
    pub fn refused(&self, text: &str, before: &str, name: &str) -> Result<(), String> {
        let mut begin = self.begin.clone();
        begin.extend(parse(before).stmts);
        let written = self.write(&begin, "", "", &ProgramName::default()).text;
        let frame = &self.dialect.program.frame;
        let open = match frame.is_empty() {
            true => written.as_str(),
            false => written.trim_end().strip_suffix(frame.as_str()).unwrap_or(&written),
        };
        let mut batch = Batch::default();
        let mut reader = Reader::new(self.settings.clone(), false);
        reader.read(format!("{open}{text}\n").as_bytes(), 0, &mut batch);
        reader.finish(&mut batch);
        let named =
            |d: &Diagnostic| matches!(&d.fault, Fault::NotSupported { what, .. } if what.is_named(name));
        if batch.diagnostics.iter().any(named) {
            return Ok(());
        }
        let at = open.len() as u32;
        let found = batch.diagnostics.iter().find(|d| d.span.start >= at && is_error(d));
        Err(match found {
            Some(other) => self.words(&other.fault),
            None => dictionary("not-refused").headline(),
        })
    }

    /// Writes a program and gives its name as it is read back.
    pub fn name(&self, name: &ProgramName, change: impl Fn(String) -> String) -> (String, ProgramName) {
        let text = change(self.write(&self.begin, &self.end, "", name).text);
        let mut batch = Batch::default();
        let mut reader = Reader::new(self.settings.clone(), false);
        reader.read(text.as_bytes(), 0, &mut batch);
        reader.finish(&mut batch);
        let line = lines(&text).into_iter().find(|l| *l != self.dialect.program.frame).unwrap_or_default();
        (line, batch.name)
    }

    fn write(&self, before: &[Stmt], rest: &str, procedures: &str, name: &ProgramName) -> Text {
        let layout = Layout { numbering: Numbering::Keep, crlf: false };
        let mut writer = Writer::new(self.settings.clone(), layout);
        let (mut text, mut diagnostics) = (Vec::new(), Vec::new());
        let number = name.number.or(Some(90));
        writer.head(
            &Head { name: ProgramName { number, title: name.title.clone() }, lines: Vec::new() },
            &mut text,
            &mut Vec::new(),
        );
        let mut stmts = before.to_vec();
        stmts.extend(parse(rest).stmts);
        writer.write(&stmts, &Modes::default(), &mut text, &mut diagnostics);
        for procedure in parse(procedures).procedures {
            writer.procedure(&procedure, &mut text, &mut diagnostics);
        }
        writer.finish(&mut text, &mut diagnostics);
        let faults = diagnostics.iter().filter(|d| is_error(d)).map(|d| self.words(&d.fault)).collect();
        Text { text: String::from_utf8_lossy(&text).into_owned(), faults }
    }

    /// What a text reads as, and what is wrong with it.
    fn read(&self, text: &str) -> (Vec<String>, Vec<String>) {
        let mut batch = Batch::default();
        let mut reader = Reader::new(self.settings.clone(), false);
        reader.read(text.as_bytes(), 0, &mut batch);
        reader.finish(&mut batch);
        let faults = batch.diagnostics.iter().filter(|d| is_error(d)).map(|d| self.words(&d.fault)).collect();
        (spelled(&batch.stmts, &batch.procedures), faults)
    }

    fn words(&self, fault: &Fault) -> String {
        let at = Context { from: self.dialect, to: self.dialect, snippet: "", beside: ("", "") };
        words(fault, at).message
    }
}

fn is_error(diagnostic: &Diagnostic) -> bool {
    diagnostic.fault.gravity() == Gravity::Error
}

/// Reads the text form of the neutral program; the cases are our own, and a test holds them well-formed.
fn parse(text: &str) -> Batch {
    let mut batch = Batch::default();
    let Some(ir) = builtin("ir") else { return batch };
    let mut reader = Reader::new(Settings::new(ir), false);
    reader.read(text.as_bytes(), 0, &mut batch);
    reader.finish(&mut batch);
    debug_assert!(
        text.trim().is_empty() || !batch.diagnostics.iter().any(is_error),
        "{text}: {:?}",
        batch.diagnostics
    );
    batch
}

/// Statements in the text form, one a line, without what is layout.
fn spelled(stmts: &[Stmt], procedures: &[Procedure]) -> Vec<String> {
    let Some(ir) = builtin("ir") else { return Vec::new() };
    let mut writer = Writer::new(Settings::new(ir), Layout::default());
    let mut text = Vec::new();
    writer.write(stmts, &Modes::default(), &mut text, &mut Vec::new());
    for procedure in procedures {
        writer.procedure(procedure, &mut text, &mut Vec::new());
    }
    writer.finish(&mut text, &mut Vec::new());
    let mut all = Vec::new();
    for line in String::from_utf8_lossy(&text).lines() {
        plain(line.trim(), &mut all);
    }
    all
}

/// A line of the text form, statement by statement, numbers without the zeros behind them.
fn plain(line: &str, all: &mut Vec<String>) {
    let mut skip = String::new();
    let mut quoted = false;
    let mut piece = String::new();
    let mut pieces = Vec::new();
    for c in line.chars() {
        quoted ^= c == '"';
        match c == '&' && !quoted {
            true => pieces.push(std::mem::take(&mut piece)),
            false => piece.push(c),
        }
    }
    pieces.push(piece);
    for (i, piece) in pieces.iter().enumerate() {
        let mut piece = piece.trim();
        if let Some((mark, rest)) = piece.split_once(' ').filter(|(mark, _)| mark.starts_with('/')) {
            skip = format!("{mark} ");
            piece = rest;
        } else if i == 0 {
            skip.clear();
        }
        let number =
            piece.split_once(' ').filter(|(n, _)| n.starts_with('N') && n[1..].parse::<u32>().is_ok());
        let (number, piece) = number.map_or((String::new(), piece), |(n, rest)| (format!("{n} "), rest));
        let piece = piece.strip_prefix("said ").unwrap_or(piece);
        if piece.is_empty() || piece == "BLANK()" {
            continue;
        }
        all.push(format!("{skip}{number}{}", values(piece)));
    }
}

/// The text with its numbers as short as they can be; what is quoted stays.
fn values(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    let mut quoted = false;
    while let Some(c) = rest.chars().next() {
        let digits = rest.bytes().take_while(|b| b.is_ascii_digit() || *b == b'.').count();
        let inside_word = out.ends_with(|c: char| c.is_ascii_alphanumeric() || c == '_');
        if quoted || digits == 0 || inside_word {
            quoted ^= c == '"';
            out.push(c);
            rest = &rest[c.len_utf8()..];
            continue;
        }
        let number = &rest[..digits];
        out.push_str(match number.contains('.') {
            true => number.trim_end_matches('0').trim_end_matches('.'),
            false => number,
        });
        rest = &rest[digits..];
    }
    out
}

fn lines(text: &str) -> Vec<String> {
    text.lines().map(str::to_owned).collect()
}

/// The lines of `with` between what it begins and ends with in common with `without`.
fn between(without: &[String], with: &[String]) -> Vec<String> {
    let first = without.iter().zip(with).take_while(|(a, b)| a == b).count();
    let left = &with[first..];
    let last = without[first..].iter().rev().zip(left.iter().rev()).take_while(|(a, b)| a == b).count();
    left[..left.len() - last].to_vec()
}

impl Tried {
    /// As a row of the table.
    pub fn row(self, table: &'static str, row: impl Into<String>, sure: bool) -> Row {
        Row {
            table,
            row: row.into(),
            written: self.written.join(" ¶ "),
            read: self.read.join(" ¶ "),
            failed: self.failed,
            sure,
        }
    }

    /// A failure without a text.
    pub(crate) fn failure(why: Message) -> Tried {
        Tried { failed: Some(why.headline()), ..Tried::default() }
    }

    /// Marks what is read only.
    pub fn read_only(mut self) -> Tried {
        self.written = vec![format!("[{}]", self.written.join(" ¶ "))];
        self
    }
}

/// A word put in the place of another wherever it stands as a word of its own.
pub fn in_place(text: &str, of: &str, word: &str) -> Option<String> {
    let mut out = String::new();
    let mut rest = text;
    let mut found = false;
    while let Some(at) = rest.find(of) {
        let before = rest[..at].chars().next_back();
        let behind = rest[at + of.len()..].chars().next();
        let part = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit() || c == '.' || c == '_');
        let letters = |c: Option<char>| c.is_some_and(|c| c.is_ascii_alphabetic());
        let named = of.len() > 3 && of.bytes().all(|b| b.is_ascii_alphabetic());
        let of_another = part(behind) || letters(before) || (named && letters(behind));
        let own = !of_another;
        out.push_str(&rest[..at]);
        out.push_str(if own { word } else { of });
        found |= own;
        rest = &rest[at + of.len()..];
    }
    out.push_str(rest);
    found.then_some(out)
}

/// What is refused, as a row of the table.
pub fn refusal(
    bench: &Bench,
    table: &'static str,
    row: &str,
    texts: &[(String, &str)],
    name: &str,
    sure: bool,
) -> Row {
    let mut failed = None;
    for (text, before) in texts {
        match bench.refused(text, before, name) {
            Ok(()) => {
                return Row {
                    table,
                    row: row.to_owned(),
                    written: format!("[{text}]"),
                    read: format!("refused: {name}"),
                    failed: None,
                    sure,
                };
            }
            Err(why) => failed = failed.or(Some((text.clone(), why))),
        }
    }
    let (text, why) = failed.unwrap_or_default();
    Row {
        table,
        row: row.to_owned(),
        written: format!("[{text}]"),
        read: why,
        failed: Some(dictionary("meant-refused").text("name", name).headline()),
        sure,
    }
}

/// The row's word must stand in what was written, else nothing was shown of it.
pub fn must_show(mut tried: Tried, word: &str) -> Tried {
    let shown = tried.written.iter().any(|line| in_place(line, word, "").is_some());
    if tried.failed.is_none() && !shown {
        tried.failed = Some(dictionary("other-written").text("word", word).headline());
    }
    tried
}
