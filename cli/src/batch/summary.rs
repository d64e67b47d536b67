//! What became of a batch, as a table and as one document. `version` is that of the document's form; it
//! changes when a field changes its meaning or goes, not when one is added. Nothing is decided here.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::{self, Write};

use ncc_driver::job::project_answers::Used;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::render::numbers::plural;
use ncc_driver::time::grid::Grid;
use serde::Serialize;
use serde_json::Value;

use super::gather::{Reason, Skipped};

/// The JSON Schema of the document.
pub const SCHEMA: &str = include_str!("../../../driver/schema/batch.schema.json");

/// What became of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Result {
    /// Translated, and source and output do the same.
    Verified,
    /// Translated; nobody wanted to know.
    Unverified,
    /// It has errors, or something would be lost.
    Refused,
    /// Source and output were not shown to do the same.
    VerificationFailed,
    /// It could not be read, or was kept from being translated.
    NotTranslated,
    /// It was translated, and could not be written.
    NotWritten,
}

impl Result {
    /// Whether there is an output.
    pub(super) fn is_done(self) -> bool {
        matches!(self, Result::Verified | Result::Unverified)
    }

    fn words(self) -> &'static str {
        match self {
            Result::Verified => "verified",
            Result::Unverified => "NOT VERIFIED",
            Result::Refused => "refused",
            Result::VerificationFailed => "verification failed",
            Result::NotTranslated => "not translated",
            Result::NotWritten => "not written",
        }
    }
}

/// A program that another one calls and that is not in its file.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Missing {
    /// Its name, as it is called.
    pub(super) name: String,
    /// A file of that name beside the caller's.
    pub(super) beside: Option<String>,
}

/// A file for one use of a tool.
#[derive(Clone, Debug, Serialize)]
pub(super) struct OfTool {
    pub(super) output: String,
    /// The tool that is put in; nothing where it is the one in the spindle.
    pub(super) tool: Option<i64>,
    /// Lines of the source, where its tool changes follow one another.
    pub(super) first_line: Option<u64>,
    pub(super) last_line: Option<u64>,
}

/// What became of one program.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Row {
    pub(super) file: String,
    pub(super) from: Option<String>,
    /// Answers that a project file gave.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) project: Option<Used>,
    pub(super) result: Result,
    pub(super) events: Option<u64>,
    pub(super) warnings: usize,
    pub(super) program_number: Option<u32>,
    pub(super) outputs: Vec<String>,
    /// The outputs of a file per tool, in the order in which they are run.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) tool_files: Vec<OfTool>,
    /// Such files of an earlier run, which lie beside them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) left_over: Vec<String>,
    pub(super) missing: Vec<Missing>,
    /// Why there is no output, in one line.
    pub(super) reason: Option<String>,
    /// Questions, the most dangerous first.
    pub(super) questions: Vec<Value>,
    pub(super) messages: Vec<Value>,
    pub(super) seconds: f64,
    #[serde(serialize_with = "code")]
    pub(super) exit: Exit,
}

impl Row {
    /// Of a program of which nothing is known yet.
    pub(super) fn new(file: String) -> Row {
        Row {
            file,
            from: None,
            project: None,
            result: Result::NotTranslated,
            events: None,
            warnings: 0,
            program_number: None,
            outputs: Vec::new(),
            tool_files: Vec::new(),
            left_over: Vec::new(),
            missing: Vec::new(),
            reason: None,
            questions: Vec::new(),
            messages: Vec::new(),
            seconds: 0.0,
            exit: Exit::Done,
        }
    }

    /// It gives nothing.
    pub(super) fn fails(&mut self, result: Result, problem: &Problem) {
        self.result = result;
        self.reason = Some(problem.message.clone());
        self.exit = self.exit.and(problem.exit);
        self.outputs.clear();
        self.tool_files.clear();
        self.left_over.clear();
    }
}

// The name of the function is the form that serde asks for.
#[allow(clippy::trivially_copy_pass_by_ref)]
fn code<S: serde::Serializer>(exit: &Exit, serializer: S) -> std::result::Result<S::Ok, S::Error> {
    serializer.serialize_u8(*exit as u8)
}

/// What became of all.
#[derive(Debug)]
pub(super) struct Summary<'a> {
    pub(super) to: &'a str,
    pub(super) folder: String,
    pub(super) rows: Vec<Row>,
    pub(super) skipped: &'a [Skipped],
    pub(super) exit: Exit,
    pub(super) seconds: f64,
    /// Whether what was skipped is named.
    pub(super) verbose: bool,
    /// The letter of a program's number, where the target has one.
    pub(super) letter: Option<char>,
}

impl Summary<'_> {
    /// The document.
    pub(super) fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        #[derive(Serialize)]
        struct Left {
            file: String,
            reason: &'static str,
        }
        #[derive(Serialize)]
        struct Document<'a> {
            version: u32,
            ncc_version: &'static str,
            to: &'a str,
            folder: &'a str,
            files: &'a [Row],
            skipped: Vec<Left>,
            seconds: f64,
            exit: u8,
        }
        let left = |s: &Skipped| Left { file: s.path.display().to_string(), reason: s.reason.name() };
        let document = Document {
            version: 1,
            ncc_version: env!("CARGO_PKG_VERSION"),
            to: self.to,
            folder: &self.folder,
            files: &self.rows,
            skipped: self.skipped.iter().map(left).collect(),
            seconds: self.seconds,
            exit: self.exit as u8,
        };
        serde_json::to_writer_pretty(&mut *out, &document)?;
        out.write_all(b"\n")
    }

    /// The table, and what is to be stated beside it.
    pub(super) fn table(&self) -> String {
        let mut text = String::new();
        let cells = |row: &Row| {
            let from = row.from.as_deref().unwrap_or("?");
            let output = match row.outputs.as_slice() {
                [] => "–".to_owned(),
                [one] => one.clone(),
                [main, others @ ..] => format!("{main} and {} more", others.len()),
            };
            vec![
                row.file.clone(),
                format!("{from} → {}", self.to),
                row.result.words().to_owned(),
                output,
                row.events.map_or("–".to_owned(), |n| n.to_string()),
                row.warnings.to_string(),
                format!("{:.2}", row.seconds),
            ]
        };
        let grid = Grid {
            head: vec!["file", "dialects", "verdict", "output", "events", "warnings", "s"],
            rows: self.rows.iter().map(cells).collect(),
            left: 4,
        };
        grid.plain(&mut text);
        // Writing to a string cannot fail.
        let _ = self.beside(&mut text);
        text
    }

    fn beside(&self, out: &mut String) -> std::fmt::Result {
        let done = self.rows.iter().filter(|row| row.result.is_done()).count();
        let all = self.rows.len();
        let verified = self.rows.iter().filter(|row| row.result == Result::Verified).count();
        let how = if verified == done { "verified" } else { "NOT VERIFIED" };
        write!(out, "{all} {}: {done} translated", plural(all as u64, "program"))?;
        if done > 0 {
            write!(out, ", {how}")?;
        }
        match all - done {
            0 => writeln!(out, "; {:.2} s", self.seconds)?,
            rest => writeln!(out, "; {rest} not; {:.2} s", self.seconds)?,
        }
        for row in self.rows.iter().filter(|row| !row.result.is_done()) {
            if row.missing.is_empty() {
                let reason = row.reason.as_deref().unwrap_or(row.result.words());
                // Some problems name the file themselves.
                let reason = reason.strip_prefix(&format!("{}: ", row.file)).unwrap_or(reason);
                writeln!(out, "  {}: {reason}", row.file)?;
            }
            for missing in &row.missing {
                write!(out, "  {}: calls {}, which is not in it", row.file, missing.name)?;
                match &missing.beside {
                    Some(beside) => writeln!(out, "; {beside} lies beside it, and is another text to ncc")?,
                    None => writeln!(out)?,
                }
            }
        }
        self.rows.iter().try_for_each(|row| of_tools(row, out))?;
        self.numbers(out)?;
        self.left_out(out)
    }

    /// Numbers that several outputs have: on the control, one would take the other's place.
    fn numbers(&self, out: &mut String) -> std::fmt::Result {
        let Some(letter) = self.letter else { return Ok(()) };
        let mut numbers: BTreeMap<u32, usize> = BTreeMap::new();
        for number in self.rows.iter().filter(|r| r.result.is_done()).filter_map(|r| r.program_number) {
            *numbers.entry(number).or_default() += 1;
        }
        for (number, count) in numbers.into_iter().filter(|(_, count)| *count > 1) {
            writeln!(
                out,
                "  {letter}{number} is the number of {count} outputs: --program-number FIRST counts them up"
            )?;
        }
        Ok(())
    }

    fn left_out(&self, out: &mut String) -> std::fmt::Result {
        let mut reasons: BTreeMap<Reason, usize> = BTreeMap::new();
        for skipped in self.skipped {
            *reasons.entry(skipped.reason).or_default() += 1;
        }
        if reasons.is_empty() {
            return Ok(());
        }
        let list = reasons.iter().map(|(reason, n)| format!("{n} {}", reason.words(*n > 1)));
        let list: Vec<String> = list.collect();
        let hint = if self.verbose { "" } else { " (--verbose names them)" };
        writeln!(out, "left out: {}{hint}", list.join(", "))?;
        for skipped in self.skipped.iter().filter(|_| self.verbose) {
            writeln!(out, "  {}: {}", skipped.path.display(), skipped.reason.words(false))?;
        }
        Ok(())
    }
}

/// The files per tool of a program, in the order in which they are run.
fn of_tools(row: &Row, out: &mut String) -> std::fmt::Result {
    if row.tool_files.is_empty() {
        return Ok(());
    }
    writeln!(
        out,
        "  {}: reset the control, put the tool in, set the zero of Z as the head of its file says, run the file:",
        row.file
    )?;
    let wide = row.tool_files.iter().map(|file| file.output.chars().count()).max().unwrap_or_default();
    for file in &row.tool_files {
        let tool = file.tool.map_or("the tool in the spindle".to_owned(), |tool| format!("tool {tool}"));
        write!(out, "    {:wide$}  {tool}", file.output)?;
        match (file.first_line, file.last_line) {
            (Some(first), Some(last)) => writeln!(out, ", lines {first} to {last}")?,
            _ => writeln!(out)?,
        }
    }
    for path in &row.left_over {
        writeln!(out, "  {path} is of an earlier run: take it away")?;
    }
    Ok(())
}
