//! The text of a project file: the machines of a program, what the call states of them, and what is asked as comments.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use ncc_driver::render::About;
use ncc_ir::canon::Units;
use ncc_ir::program::numbered::Numbered;
use ncc_machines::reading::{Place, Side, UNNAMED, key_of, quoted};

use super::question::Question;
use super::stub::comment;
use crate::project::args::Init;
use crate::registry::DialectRegistry;

/// The text of the file. Every question is a comment with the key that answers it.
pub(super) fn text(args: &Init, known: &DialectRegistry, about: &About, asked: &[Question]) -> String {
    let mut text = String::new();
    comment(
        &mut text,
        "Which machines the programs of this folder are for. `ncc config` shows what is active; a machine has the keys \
         of a profile (`ncc machines schema`), or is named: the file of a profile, or a machine of `ncc machines`.",
    );
    // Writing into a text cannot fail.
    let _ = writeln!(text, "[[programs]]\nfiles = {:?}", pattern(&args.program));
    for (key, value, words) in [
        ("include", "subs", "where called programs are looked for"),
        ("output", "translated", "where translations go"),
    ] {
        let _ = writeln!(text, "#{key} = {value:?}  # {words}");
    }
    let from = Machine {
        key: "machine",
        about: "The machine that they were written for.",
        named: args.machine_from.as_deref(),
        dialect: &about.job.from.dialect.id,
        options: &args.from_option,
        units: known.units(),
        codes: known.m_codes().iter().map(|code| (code.number, code.written.map(|_| code.number))).collect(),
    };
    from.write(&mut text, args, asked, Side::From);
    let carried = known.m_codes().iter().filter_map(|code| Some((code.written?, Some(code.number))));
    let to = Machine {
        key: "to",
        about: "The machine that they are translated for.",
        named: args.machine_to.as_deref(),
        dialect: &about.job.to.dialect.id,
        options: &[],
        units: None,
        codes: carried.collect(),
    };
    to.write(&mut text, args, asked, Side::To);
    text
}

/// A machine of the file.
struct Machine<'a> {
    key: &'static str,
    about: &'static str,
    /// As the call names it.
    named: Option<&'a str>,
    dialect: &'a str,
    /// Options that the command line states.
    options: &'a [(String, String)],
    units: Option<Units>,
    /// M codes, and the numbers that name their functions; without, they have no effect.
    codes: Vec<(u16, Option<u16>)>,
}

impl Machine<'_> {
    fn write(&self, text: &mut String, args: &Init, asked: &[Question], side: Side) {
        text.push('\n');
        comment(text, self.about);
        match self.named {
            // A key of the row stands above its tables.
            Some(name) => {
                let line = format!("{} = {:?}\n", self.key, written(name, &args.program));
                let at = text.find("\n#include").map_or(text.len(), |at| at + 1);
                text.insert_str(at, &line);
                comment(text, &format!("{} names its profile. What it may state besides:", self.key));
            }
            None => drop(writeln!(text, "[programs.{}]\ndialect = {:?}", self.key, self.dialect)),
        }
        let own = || asked.iter().filter(|question| question.side == side);
        let mut options: Vec<String> =
            self.options.iter().map(|(name, value)| format!("{} = {value:?}", quoted(name))).collect();
        self.table(text, "options", &options, own().filter(|q| matches!(q.place, Place::Option(_))));
        options.clear();
        options.extend(self.units.map(|units| match units {
            Units::Mm => "units = \"mm\"".to_owned(),
            Units::Inch => "units = \"inch\"".to_owned(),
        }));
        self.table(text, "power_on", &options, own().filter(|q| matches!(q.place, Place::PowerOn(_))));
        self.table(text, "confirmed", &[], own().filter(|q| matches!(q.place, Place::Confirmed(_))));
        for (code, function) in &self.codes {
            let does = match function {
                None => "effect = \"none\"".to_owned(),
                Some(number) => format!("function = \"m{number}\""),
            };
            let mark = if self.named.is_some() { "#" } else { "" };
            let head = self.head("m_code");
            let _ = writeln!(text, "\n{mark}[[{head}]]\n{mark}code = \"M{code}\"\n{mark}{does}");
        }
        for question in own() {
            let (table, keys) = match &question.place {
                Place::Code(code) => {
                    let left_out =
                        "#effect = \"none\"  # in place of a function: it has no effect on the cut";
                    ("m_code", format!("code = {code:?}\n#function = \"\"\n{left_out}"))
                }
                Place::Function(name) if name.starts_with(UNNAMED) => {
                    ("m_code", "code = \"\"\n#function = \"\"".to_owned())
                }
                Place::Function(name) => ("m_code", format!("code = \"\"\n#function = {name:?}")),
                Place::Name(Numbered::LengthEntry, entry) => {
                    ("tool", format!("number = \"\"\n#name = \"\"\n#length_entry = {entry}"))
                }
                Place::Name(what, number) => (key_of(*what), format!("number = {number}\n#name = \"\"")),
                Place::Number(what, name) => (key_of(*what), format!("number = \"\"\n#name = {name:?}")),
                Place::PowerOn(_) | Place::Option(_) | Place::Confirmed(_) => continue,
            };
            text.push('\n');
            comment(text, &format!("{}: {}", question.lines(), question.taken));
            comment(text, &question.takes);
            let _ = writeln!(text, "#[[{}]]\n#{keys}", self.head(table));
        }
    }

    /// How a table is headed; in a profile of its own, without the row.
    fn head(&self, table: &str) -> String {
        if self.named.is_some() { table.to_owned() } else { format!("programs.{}.{table}", self.key) }
    }

    fn table<'q>(
        &self,
        text: &mut String,
        table: &str,
        stated: &[String],
        questions: impl Iterator<Item = &'q Question>,
    ) {
        let questions: Vec<&Question> = questions.collect();
        if stated.is_empty() && questions.is_empty() {
            return;
        }
        let mark = if self.named.is_some() { "#" } else { "" };
        let _ = writeln!(text, "\n{mark}[{}]", self.head(table));
        for line in stated {
            let _ = writeln!(text, "{mark}{line}");
        }
        for question in questions {
            let key = match &question.place {
                Place::PowerOn(key) => (*key).to_owned(),
                Place::Option(key) | Place::Confirmed(key) => quoted(key),
                Place::Code(_) | Place::Function(_) | Place::Name(..) | Place::Number(..) => continue,
            };
            comment(text, &format!("{}: taken for granted: {}", question.lines(), question.taken));
            comment(text, &question.takes);
            let _ = writeln!(text, "#{key} = \"\"");
        }
    }
}

/// The pattern of a program: all files of its extension in its folder, or its name if it has none.
fn pattern(program: &Path) -> String {
    let text = |part: Option<&std::ffi::OsStr>| part.map(|part| part.to_string_lossy().into_owned());
    let (before, own) = match text(program.extension()) {
        Some(extension) => ("*.", extension),
        None => ("", text(program.file_name()).unwrap_or_default()),
    };
    let escaped = |c: char| if "*?[]{}!".contains(c) { format!("[{c}]") } else { c.to_string() };
    format!("{before}{}", own.chars().map(escaped).collect::<String>())
}

/// The name of a machine as a file beside a program has it.
fn written(name: &str, program: &Path) -> String {
    if ncc_machines::find(name).is_some() {
        return name.to_owned();
    }
    let folder = program.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
    let whole = |path: &Path| fs::canonicalize(path).ok();
    match (whole(Path::new(name)), whole(folder)) {
        (Some(path), Some(folder)) => {
            path.strip_prefix(&folder).unwrap_or(&path).to_string_lossy().replace('\\', "/")
        }
        _ => name.to_owned(),
    }
}
