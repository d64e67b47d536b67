//! The result of a comparison, as it is written down: the document of `--format json`, and the
//! certificate, which are one form. `docs/book/src/reference/certificate.md` describes it, `driver/schema/certificate.schema.json`
//! is its JSON Schema.
//!
//! The number in `version` changes when a field changes its meaning, comes or goes: a certificate is
//! read back field by field. Not here: how it is reported (`text`), how it is checked again (`cert`).

mod making;

use std::collections::BTreeMap;

use ncc_ir::canon::AXES;
use ncc_ir::expr::num::Nanos;
use serde::{Deserialize, Serialize};

use crate::job::project_answers::Used;
use crate::render::messages::message::{Message, Part};

/// Version of the form.
pub const VERSION: u32 = 1;
/// The kind of the document, by which a reader knows it.
pub const KIND: &str = include_str!("../../../schema/certificate.kind");
/// Its JSON Schema.
pub const SCHEMA: &str = include_str!("../../../schema/certificate.schema.json");

/// The note where the rule of a translation is stricter than what was found.
pub fn finer_note() -> String {
    verify("finer").headline()
}

/// An entry about `ncc verify`.
pub(super) fn verify(form: &'static str) -> Message {
    Message::part(Part::Verify, form)
}

/// What a comparison is called with, as far as the document tells it.
#[derive(Clone, Debug, Default)]
pub struct Call {
    /// The programs' files, as they were named.
    pub files: [String; 2],
    /// Their machines, likewise.
    pub machines: [Option<String>; 2],
    /// How far lengths may be apart.
    pub tolerance: Option<Nanos>,
    /// The dictionaries of both sides, each with what it builds on, each once.
    pub dictionaries: Vec<Hashed>,
    /// The profiles of both sides, each once.
    pub profiles: Vec<Hashed>,
}

/// The document.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Document {
    /// What the document is: [`KIND`].
    pub kind: String,
    /// Its form: [`VERSION`].
    pub version: u32,
    /// The ncc that made it.
    pub ncc_version: String,
    /// The program that is translated.
    pub source: Program,
    /// The program that is held against it.
    pub output: Program,
    /// Dictionaries of both, each with what it builds on.
    pub dictionaries: Vec<Hashed>,
    /// Profiles of both machines.
    pub profiles: Vec<Hashed>,
    /// What the user asked for.
    pub asked: Asked,
    /// What was compared.
    pub compared: Compared,
    /// Its verdict.
    pub verdict: Word,
    /// The differences in one line.
    pub summary: String,
    /// The largest deviation of places that were found the same.
    pub largest_deviation: Option<Deviation>,
    /// The first difference, as the strict comparison meets it.
    pub first_difference: Option<First>,
    /// The differences in the programs' own coordinates.
    pub differences: Vec<One>,
    /// How many more there are.
    pub differences_not_listed: u64,
    /// Why a program could not be executed.
    pub errors: Vec<Mistake>,
}

/// A side.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Program {
    /// What a project file says of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub project: Option<Used>,
    /// As it was named; `-` is stdin.
    pub file: String,
    /// Its length.
    pub bytes: u64,
    /// SHA-256 of its bytes, in hexadecimal.
    pub sha256: String,
    /// Files of called programs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub called: Vec<Hashed>,
    /// Its blocks that say something.
    pub blocks: u64,
    /// The name of its dialect.
    pub dialect: String,
    /// The machine's profile, as it was named.
    pub machine: Option<String>,
    /// Every option of the dialect, as it was used.
    pub options: BTreeMap<String, Choice>,
    /// What was assumed of this program alone.
    pub assumed: Vec<Assumed>,
    /// Rows of its dictionary that nobody has confirmed, and that it uses.
    pub unconfirmed: Vec<Row>,
    /// Facts that it relies on without saying them and that hold of it as of the other one.
    pub shared: Vec<String>,
    /// Facts that it relies on without saying them and that nothing settles: the worlds disagree.
    pub unsaid: Vec<String>,
}

/// An option of a dialect.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Choice {
    /// Its value.
    pub value: String,
    /// By the user or by the machine's profile; else it is the dictionary's working choice.
    pub chosen: bool,
}

/// An assumption.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Assumed {
    /// The code of its message: `NC0301`.
    pub code: String,
    /// It in a few words.
    pub text: String,
    /// How many times it was made.
    pub uses: u64,
}

/// A row of a dictionary that nobody has confirmed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// The code as it is written.
    pub code: String,
    /// What it is read as.
    pub meaning: String,
    /// How many times the program has it.
    pub uses: u64,
}

/// A text that the verdict rests on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hashed {
    /// Its name.
    pub name: String,
    /// Its file; of what comes with ncc, none.
    pub file: Option<String>,
    /// SHA-256 of its bytes, in hexadecimal.
    pub sha256: String,
}

/// What the user asked for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Asked {
    /// How far lengths may be apart, mm.
    pub tolerance_mm: Option<f64>,
    /// X to C in mm and degrees, where they were stated.
    pub start: [Option<f64>; AXES],
}

/// What was compared.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Compared {
    /// Events found the same, over all worlds and settings.
    pub events: u64,
    /// Worlds in which both were executed.
    pub worlds: u32,
    /// Settings of the block-skip switches.
    pub skip_settings: u32,
    /// Levels of block skip, if not every setting of them was tried.
    pub skip_levels_sampled: Option<u8>,
    /// Half the coarser side's least increment.
    pub resolution: Halves,
    /// What was not compared, and why.
    pub notes: Vec<String>,
}

/// Half the least increment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Halves {
    /// Of lengths, mm.
    pub mm: f64,
    /// Of angles, degrees.
    pub degrees: f64,
    /// Of feeds, mm/min.
    pub feed: f64,
    /// Of dwells, seconds.
    pub seconds: f64,
}

/// The verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Word {
    /// The same.
    Equal,
    /// The same within the tolerance that was asked for.
    EqualWithinTolerance,
    /// Not the same.
    Different,
    /// One of them cannot be read or executed.
    NotCompared,
}

/// A block.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// Its line, from 1.
    pub line: u64,
    /// Its text.
    pub text: String,
}

/// How far two places that count as one are apart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Deviation {
    /// By how much, mm or degrees.
    pub mm: f64,
    /// The letter of the axis.
    pub axis: String,
    /// The block of the source.
    pub source: Option<Place>,
    /// The block of the output.
    pub output: Option<Place>,
}

/// A difference, as the strict comparison meets it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct First {
    /// It in words.
    pub text: String,
    /// Levels of block skip that are on.
    pub block_skip: Vec<u8>,
    /// The block of the source.
    pub source: Option<Place>,
    /// The block of the output.
    pub output: Option<Place>,
}

/// A difference in the programs' own coordinates.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct One {
    /// Its kind, a stable name.
    pub kind: String,
    /// It in words.
    pub title: String,
    /// Levels of block skip that are on.
    pub block_skip: Vec<u8>,
    /// Whether places at the same index belong together.
    pub paired: bool,
    /// Blocks of the source.
    pub source: Vec<Place>,
    /// Blocks of the output.
    pub output: Vec<Place>,
    /// Whether there are further ones.
    pub further_places: bool,
}

/// Why a program cannot be compared.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mistake {
    /// `source` or `output`.
    pub program: String,
    /// The code of its message.
    pub code: String,
    /// It in words.
    pub message: String,
    /// Its block.
    pub place: Place,
}

impl Document {
    /// Its verdict.
    pub fn verdict(&self) -> Word {
        self.verdict
    }
}
