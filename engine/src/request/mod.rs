//! What an engine is asked for: a JSON object.
//!
//! ```json
//! { "verb": "translate", "file": "part.nc", "from": "haas", "to": "siemens", "to_option": { "path_tolerance": "0.02" } }
//! ```
//!
//! Names and values are those of the command line's options. A field that a verb does not need is an error, so that none
//! is without effect in silence.

use std::collections::BTreeMap;

use serde::Deserialize;

#[cfg(not(target_arch = "wasm32"))]
pub mod drawn;
mod one;
mod time;

use self::one::one;
pub use self::one::{One, Units};
pub use self::time::{Form, Stage, Summary, Time, ToolChangeOn};

/// A request.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "verb", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Request {
    /// Translates a program. Outputs: `output` if it is released, `report`, `messages`, and with `map`
    /// `lines`: for each line of the output the first line of the source that it comes from, or 0 (u32, little-endian).
    Translate(Translate),
    /// Checks a program. Outputs: `findings` (the document of `ncc check --format json`), `messages`.
    Check(One),
    /// Executes a program with a clock. Outputs: `times` (the document of `ncc time --as payload`), `messages`; if they
    /// are wanted, `findings`, and `assumed`: the assumptions of the times, a list of lines.
    Time(Time),
    /// Executes a program with a clock, and sums up. Outputs: `document` (as of `ncc time --as json`), `tools` (as of `ncc time
    /// --as tools`), `messages`; if they are wanted, `findings`, and `called`: a list of the files whose programs it calls.
    Summary(Summary),
    /// Compares what two programs do. Outputs: `document` (as of `ncc diff --format json`), `messages`; but in a page `page`
    /// too, as of `ncc diff --html`.
    Diff(Two),
    /// Compares them as strictly as a translation is verified. Outputs: `document` (the certificate), `messages`.
    Verify(Two),
    /// Explains a message. Output: `output`, the page.
    Explain(Explain),
    /// Tells what an editor colours of some lines. Output: `document`, as `colours` has it.
    Colours(Colours),
    /// Lists the words of a dialect. Output: `document`: `words`, each with `kind`, `word`, `means`, `refused`, `sure` and
    /// `source`, and `sources` by their keys.
    Words(Words),
    /// Lays a program out as `ncc fmt` does. Outputs: `output`, `messages`.
    Layout(Layout),
    /// Tells names and where they stand. Outputs: `document`, as `editing` has it, `messages`.
    Names(One),
    /// Tells where a program that this one calls begins. Outputs: `document`: `file`, one of the engine's, and `line`; none
    /// where no file has it; `messages`.
    Called(Called),
    /// Gives a name another, at all its places or at none. Outputs: `output`, `messages`.
    Rename(Rename),
    /// Writes the answers for a program, and its set-up, into a project file. Outputs: `output`, `messages`.
    Project(Project),
    /// Tells what a project file states of a program. Outputs: `document`, as `stated` has it, and none where it states
    /// nothing; `messages`.
    Stated(Stated),
    /// Lists the machines that come with ncc. Output: `document`, a list of objects with `id`, `title` and `dialect`.
    Machines(Nothing),
    /// Executes a program. Outputs: `path`, its moves as columns of numbers (`ncc_driver::simulate::columns`), `modes`, what
    /// is active in each block and at each move (`ncc_driver::simulate::modes`), `messages`.
    Path(One),
    /// Cuts a program. Outputs: `document` (as of `ncc simulate --json`), `path`, `modes`, and of the part at the end `heights` and
    /// `last`: of each cell, rows of one Y, the height in mm (f32) and the move that cut last there (u32), little-endian;
    /// `messages`.
    Simulate(Simulate),
    /// Shows the part that was cut last after so many moves. Outputs: `heights`, `last`.
    Seek(Seek),
    /// The part as it is shown, as triangles. Output: `stl`.
    Stl(Nothing),
    /// Lists the dialects. Output: `document`, a list of objects with `id` and `title`.
    Dialects(Nothing),
    /// Draws a program over time. Outputs: `picture` (SVG), `messages`. The engine of a page has no such verb.
    #[cfg(not(target_arch = "wasm32"))]
    Chart(drawn::Chart),
    /// Draws the part as it is shown. Output: `picture`. The engine of a page has no such verb.
    #[cfg(not(target_arch = "wasm32"))]
    Picture(drawn::Picture),
    /// Sums up as `summary` does, for a setup sheet. Outputs: those of `summary`, and `used`: `tools`, each with its
    /// `coolants`, and `offsets`. The engine of a page has no such verb.
    #[cfg(not(target_arch = "wasm32"))]
    Sheet(Summary),
}

/// A message.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Explain {
    /// Its code: `NC0107`.
    pub code: String,
}

/// A dialect.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Words {
    /// Its name.
    pub dialect: String,
}

/// Lines of a program.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Colours {
    /// The name of its file.
    pub file: String,
    /// Its dialect; without, or with `auto`, it is recognised, and one of no dialect is coloured as word-address text.
    #[serde(default)]
    pub from: Option<String>,
    /// The first line, counted from 1.
    pub first: usize,
    /// How many lines.
    pub lines: usize,
}

/// No fields.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Nothing {}

/// A program on a part. Bodies and tools are stated as on the command line.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Simulate {
    /// As of [`One`].
    pub file: String,
    /// As of [`One`].
    #[serde(default)]
    pub from: Option<String>,
    /// As of [`One`].
    #[serde(default)]
    pub machine: Option<String>,
    /// As of [`One`].
    #[serde(default)]
    pub project: Option<String>,
    /// As of [`One`].
    #[serde(default)]
    pub from_option: BTreeMap<String, String>,
    /// As of [`One`].
    #[serde(default)]
    pub units: Option<Units>,
    /// As of [`One`].
    #[serde(default)]
    pub assume_milling: bool,
    /// As of [`One`].
    #[serde(default)]
    pub zero: Option<[f64; 3]>,
    /// The raw part: `X0:100 Y0:60 Z-20:0`; without, it is guessed.
    #[serde(default)]
    pub stock: Option<String>,
    /// What holds it.
    #[serde(default)]
    pub fixtures: Vec<String>,
    /// Z of the table, mm.
    #[serde(default)]
    pub table: Option<f64>,
    /// Tools: `4=drill,6.8,angle=118`.
    #[serde(default)]
    pub tools: Vec<String>,
    /// Cells along the longer side of the part, 16 to 8192.
    #[serde(default = "cells")]
    pub cells: usize,
    /// As of [`One`].
    #[serde(default)]
    pub most_moves: Option<usize>,
    /// Another program, whose part of the same raw part, by the same tools, is held against this one: the document has it
    /// too, and `between`.
    #[serde(default)]
    pub compare: Option<One>,
}

fn cells() -> usize {
    1024
}

impl Simulate {
    /// The program alone.
    pub(crate) fn one(&self) -> One {
        One {
            file: self.file.clone(),
            from: self.from.clone(),
            machine: self.machine.clone(),
            project: self.project.clone(),
            from_option: self.from_option.clone(),
            units: self.units,
            assume_milling: self.assume_milling,
            zero: self.zero,
            most_moves: self.most_moves,
            datum: None,
        }
    }
}

/// A program in a project file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stated {
    /// The name of the program's file.
    pub file: String,
    /// The project file among the files of the engine.
    pub project: String,
}

/// Answers for a program, and its set-up. Of the program's side nothing is written where the request states nothing of it;
/// `from` may be `auto`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Project {
    /// As of [`Translate`].
    pub file: String,
    /// The project file among the files of the engine; without, there is none yet.
    #[serde(default)]
    pub project: Option<String>,
    /// As of [`Translate`].
    #[serde(default)]
    pub from: Option<String>,
    /// As of [`Translate`].
    #[serde(default)]
    pub to: Option<String>,
    /// As of [`Translate`].
    #[serde(default)]
    pub machine_from: Option<String>,
    /// As of [`Translate`].
    #[serde(default)]
    pub machine_to: Option<String>,
    /// As of [`Translate`].
    #[serde(default)]
    pub from_option: BTreeMap<String, String>,
    /// As of [`Translate`].
    #[serde(default)]
    pub to_option: BTreeMap<String, String>,
    /// The raw part, as of [`Simulate`]; an empty text takes it out.
    #[serde(default)]
    pub stock: Option<String>,
    /// What holds it; an empty list takes it out.
    #[serde(default)]
    pub fixtures: Option<Vec<String>>,
    /// Z of the table, mm, in a list; an empty list takes it out.
    #[serde(default)]
    pub table: Option<Vec<f64>>,
    /// Tools, as of [`Simulate`]; one without a shape goes: `4=`.
    #[serde(default)]
    pub tools: Vec<String>,
}

/// A program to be laid out.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Layout {
    /// As of [`One`].
    pub file: String,
    /// As of [`One`].
    #[serde(default)]
    pub from: Option<String>,
    /// As of [`One`].
    #[serde(default)]
    pub machine: Option<String>,
    /// As of [`One`].
    #[serde(default)]
    pub project: Option<String>,
    /// As of [`One`].
    #[serde(default)]
    pub from_option: BTreeMap<String, String>,
    /// First block number, and the step to the next; without, numbers stay as they are or as the machine has them.
    #[serde(default)]
    pub number: Option<[u32; 2]>,
}

impl Layout {
    /// The program alone.
    pub(crate) fn one(&self) -> One {
        one(&self.file, [&self.from, &self.machine, &self.project], &self.from_option)
    }
}

/// A program that a program calls, the other files of the engine in one folder with it.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Called {
    /// As of [`One`].
    pub file: String,
    /// As of [`One`].
    #[serde(default)]
    pub from: Option<String>,
    /// As of [`One`].
    #[serde(default)]
    pub machine: Option<String>,
    /// As of [`One`].
    #[serde(default)]
    pub project: Option<String>,
    /// As of [`One`].
    #[serde(default)]
    pub from_option: BTreeMap<String, String>,
    /// A line with a call, from 1.
    pub line: usize,
    /// A column of it, in units of UTF-16, from 0: of several calls the one there.
    pub column: usize,
}

impl Called {
    /// The program that calls it.
    pub(crate) fn one(&self) -> One {
        one(&self.file, [&self.from, &self.machine, &self.project], &self.from_option)
    }
}

/// A name of a program.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rename {
    /// As of [`One`].
    pub file: String,
    /// As of [`One`].
    #[serde(default)]
    pub from: Option<String>,
    /// As of [`One`].
    #[serde(default)]
    pub machine: Option<String>,
    /// As of [`One`].
    #[serde(default)]
    pub project: Option<String>,
    /// As of [`One`].
    #[serde(default)]
    pub from_option: BTreeMap<String, String>,
    /// A line where it stands, from 1.
    pub line: usize,
    /// A column of it, in units of UTF-16, from 0.
    pub column: usize,
    /// The new name.
    pub to: String,
}

impl Rename {
    /// The program alone.
    pub(crate) fn one(&self) -> One {
        one(&self.file, [&self.from, &self.machine, &self.project], &self.from_option)
    }
}

/// A moment of the program that was cut last.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Seek {
    /// How many moves are over.
    pub moves: usize,
}

/// Two programs.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Two {
    /// The first one, or the source.
    pub a: One,
    /// The second one, or the output.
    pub b: One,
    /// How far lengths may be apart, mm: `0.01`.
    #[serde(default)]
    pub tolerance: Option<String>,
}

/// A translation.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Translate {
    /// The name of the source's file. The other files are programs that it may call.
    pub file: String,
    /// Its dialect; without, or with `auto`, it is recognised, or its machine's.
    #[serde(default)]
    pub from: Option<String>,
    /// The dialect of the output; without, that of the machine.
    #[serde(default)]
    pub to: Option<String>,
    /// The machine that the program was written for.
    #[serde(default)]
    pub machine_from: Option<String>,
    /// The machine to translate for.
    #[serde(default)]
    pub machine_to: Option<String>,
    /// As of [`One`].
    #[serde(default)]
    pub project: Option<String>,
    /// Choices where the source's dictionary leaves a question open.
    #[serde(default)]
    pub from_option: BTreeMap<String, String>,
    /// Choices where the target's dictionary does.
    #[serde(default)]
    pub to_option: BTreeMap<String, String>,
    /// The source's units at power-on.
    #[serde(default)]
    pub units: Option<Units>,
    /// Values of variables that the program reads and never sets: `"_td": "0.25"`.
    #[serde(default)]
    pub value: BTreeMap<String, String>,
    /// Passes that the program goes through first.
    #[serde(default)]
    pub pass: Vec<String>,
    /// Program number of the output.
    #[serde(default)]
    pub program_number: Option<u32>,
    /// As of [`Time`].
    #[serde(default)]
    pub start: Option<String>,
    /// Verdicts that would stop and shall not: `dropped`.
    #[serde(default)]
    pub allow: Vec<String>,
    /// Verdicts that would not stop and shall.
    #[serde(default)]
    pub deny: Vec<String>,
    /// Whether it is for a mill, whatever it looks like.
    #[serde(default)]
    pub assume_milling: bool,
    /// Whether open questions are answered with ncc's own readings.
    #[serde(default)]
    pub assume: bool,
    /// Whether it is left out that the output is verified; it says so then.
    #[serde(default)]
    pub no_verify: bool,
    /// Whether it is wanted which line of the source each line of the output comes from.
    #[serde(default)]
    pub map: bool,
    /// Whether the comment at the top is left out.
    #[serde(default)]
    pub no_head: bool,
}
