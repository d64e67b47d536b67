//! `--report FILE`: everything that is known of a translation, as JSON.
//!
//! The number in `ncc_report` is the version of the form; it changes when a field changes its
//! meaning or goes, not when one is added.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::io::{self, Write};

use ncc_dialects::Settings;
use ncc_ir::diag::{Diagnostic, Fault, Gravity, Verdict};
use ncc_ir::rank::Rank;
use ncc_machines::reading::key_of;
use serde::Serialize;
use serde::ser::{SerializeMap, SerializeSeq, Serializer};

use crate::job::project_answers::Used;
use crate::job::{Failure, Job, Outcome};
use crate::questions::of_translation;
use crate::render::json::Entry;
use crate::render::messages::words::Context;
use crate::render::{About, questions, summary};
use crate::source::called_files;
use crate::source::chunks::{Chunk, Chunks, PIECE};
use crate::source::not_milling::Refusal;

#[derive(Serialize)]
struct Source<'a> {
    name: &'a str,
    dialect: &'a str,
    options: Options<'a>,
    bytes: u64,
    sha256: String,
    blocks: u64,
    /// Files of called programs.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    called: Vec<CalledFile<'a>>,
}

#[derive(Serialize)]
struct CalledFile<'a> {
    file: &'a str,
    bytes: u64,
    sha256: String,
}

#[derive(Serialize)]
struct Target<'a> {
    dialect: &'a str,
    options: Options<'a>,
    bytes: u64,
}

/// Every option of the dialect with its value, and whether the user chose it.
struct Options<'a>(&'a Settings);

impl Serialize for Options<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Value<'a> {
            value: &'a str,
            chosen: bool,
        }
        let rows = &self.0.dialect.option;
        let mut map = serializer.serialize_map(Some(rows.len()))?;
        for row in rows {
            let value = Value { value: self.0.get(&row.name), chosen: self.0.is_chosen(&row.name) };
            map.serialize_entry(&row.name, &value)?;
        }
        map.end()
    }
}

/// What became of a translation, as a line of `--format json`.
#[derive(Serialize)]
pub struct Summary<'a> {
    /// Answers that a project file gave.
    #[serde(skip_serializing_if = "Option::is_none")]
    project: Option<&'a Used>,
    result: &'static str,
    verification: Option<Verification>,
    verdicts: Counts<'a>,
}

impl<'a> Summary<'a> {
    /// Of this outcome.
    pub fn of(job: &'a Job, outcome: &'a Outcome) -> Summary<'a> {
        Summary {
            project: job.project.as_deref(),
            result: match (outcome.release, outcome.verified) {
                (Ok(()), Some(_)) => "verified",
                (Ok(()), None) => "unverified",
                (Err(Failure::Refused), _) => "refused",
                (Err(Failure::VerificationFailed), _) => "verification failed",
            },
            verification: outcome.verified.map(|v| Verification {
                worlds: v.worlds,
                skip_settings: v.skip_settings,
                events: v.events,
            }),
            verdicts: Counts(outcome),
        }
    }
}

#[derive(Serialize)]
struct Verification {
    worlds: u32,
    skip_settings: u32,
    events: u64,
}

/// Counts by verdict, from harmless to loss.
struct Counts<'a>(&'a Outcome);

impl Serialize for Counts<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(Verdict::ALL.len()))?;
        for verdict in Verdict::ALL {
            map.serialize_entry(verdict.name(), &self.0.count(verdict))?;
        }
        map.end()
    }
}

#[derive(Serialize)]
struct UnconfirmedRow<'a> {
    code: &'a str,
    meaning: &'a str,
    uses: usize,
}

/// A number that was put in for the target's machine.
#[derive(Serialize)]
struct Renumbered<'a> {
    what: &'static str,
    from: &'a str,
    to: &'a str,
}

/// What the translation assumed; each once, however often it was relied on.
#[derive(Serialize)]
struct Assumption {
    code: String,
    text: String,
    /// As of a diagnostic.
    rank: Option<&'static str>,
    uses: usize,
}

/// Diagnostics, told one by one while they are written, so that no second list is kept.
struct Entries<'a, 'b> {
    about: RefCell<&'a mut About<'b>>,
    diagnostics: &'a [Diagnostic],
}

impl Serialize for Entries<'_, '_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::Error;
        let mut about = self.about.borrow_mut();
        let lines = about.lines(self.diagnostics.iter()).map_err(S::Error::custom)?;
        let mut list = serializer.serialize_seq(None)?;
        for diagnostic in self.diagnostics {
            let told = about.tell(&lines, diagnostic).map_err(S::Error::custom)?;
            list.serialize_element(&Entry::from(told))?;
        }
        list.end()
    }
}

/// Writes the report.
///
/// # Errors
/// Reading the source again, or writing.
pub fn write(out: &mut dyn Write, about: &mut About, outcome: &Outcome) -> io::Result<()> {
    let mut out = io::BufWriter::new(out);
    let job: &Job = about.job;
    let mut json = serde_json::Serializer::pretty(&mut out);
    let mut map = json.serialize_map(None)?;
    map.serialize_entry("ncc_report", &1)?;
    map.serialize_entry("ncc_version", env!("CARGO_PKG_VERSION"))?;
    if let Some(project) = &job.project {
        map.serialize_entry("project", &**project)?;
    }
    map.serialize_entry(
        "source",
        &Source {
            name: &job.source_name,
            dialect: &job.from.dialect.id,
            options: Options(&job.from),
            bytes: outcome.source_bytes,
            sha256: hex(&outcome.source_sha256),
            blocks: outcome.blocks,
            called: job.called.iter().flat_map(|called| &called.files).map(called_file).collect(),
        },
    )?;
    let bytes = if outcome.release.is_ok() { outcome.output.bytes() } else { 0 };
    map.serialize_entry("target", &Target { dialect: &job.to.dialect.id, options: Options(&job.to), bytes })?;
    let summary = Summary::of(job, outcome);
    map.serialize_entry("result", summary.result)?;
    map.serialize_entry("verification", &summary.verification)?;
    let names = |verdicts: &[Verdict]| verdicts.iter().map(|v| v.name()).collect::<Vec<_>>();
    // The most dangerous first; they stop the translation but under `--assume`.
    let questions = questions::ask(about, &of_translation(job, outcome))?;
    map.serialize_entry("questions", &questions)?;
    map.serialize_entry("allow", &names(&job.allow))?;
    map.serialize_entry("deny", &names(&job.deny))?;
    map.serialize_entry("verdicts", &summary.verdicts)?;
    map.serialize_entry("renumbered", &renumbered(outcome))?;
    map.serialize_entry("unconfirmed_rows", &unconfirmed(&outcome.diagnostics))?;
    map.serialize_entry("assumptions", &assumptions(job, &outcome.diagnostics))?;
    let entries = Entries { about: RefCell::new(about), diagnostics: &outcome.diagnostics };
    map.serialize_entry("diagnostics", &entries)?;
    let further: BTreeMap<String, u64> = outcome.further().collect();
    if !further.is_empty() {
        map.serialize_entry("further_diagnostics", &further)?;
    }
    SerializeMap::end(map)?;
    out.write_all(b"\n")?;
    out.flush()
}

/// Writes the report of a program that no dialect reads, because it is not for a mill.
///
/// # Errors
/// Reading the source again, or writing.
pub fn refused(
    out: &mut dyn Write,
    (dialect, target): (Option<&str>, &Settings),
    source: &mut crate::source::Source,
    refusal: &Refusal,
) -> io::Result<()> {
    #[derive(Serialize)]
    struct Unread<'a> {
        name: &'a str,
        /// That which was named.
        dialect: Option<&'a str>,
        bytes: u64,
        sha256: String,
    }
    source.rewind().map_err(|problem| io::Error::other(problem.message))?;
    let mut chunks = Chunks::hashed(&mut source.file, PIECE);
    while !matches!(chunks.take()?, Chunk::End) {}
    let (hash, bytes) = chunks.finish();
    let mut out = io::BufWriter::new(out);
    let mut json = serde_json::Serializer::pretty(&mut out);
    let mut map = json.serialize_map(None)?;
    map.serialize_entry("ncc_report", &1)?;
    map.serialize_entry("ncc_version", env!("CARGO_PKG_VERSION"))?;
    if let Some(project) = &source.project {
        map.serialize_entry("project", &**project)?;
    }
    let unread = Unread { name: &source.name, dialect, bytes, sha256: hex(&hash) };
    map.serialize_entry("source", &unread)?;
    map.serialize_entry(
        "target",
        &Target { dialect: &target.dialect.id, options: Options(target), bytes: 0 },
    )?;
    map.serialize_entry("result", "refused")?;
    map.serialize_entry("questions", &[refusal.asked()])?;
    map.serialize_entry("diagnostics", &[refusal.entry()])?;
    SerializeMap::end(map)?;
    out.write_all(b"\n")?;
    out.flush()
}

fn called_file(file: &called_files::CalledFile) -> CalledFile<'_> {
    CalledFile { file: &file.name, bytes: file.bytes, sha256: hex(&file.sha256) }
}

fn renumbered(outcome: &Outcome) -> Vec<Renumbered<'_>> {
    outcome.renumbered.iter().map(|(what, from, to)| Renumbered { what: key_of(*what), from, to }).collect()
}

fn assumptions(job: &Job, diagnostics: &[Diagnostic]) -> Vec<Assumption> {
    let at = Context { from: job.from.dialect, to: job.to.dialect, snippet: "", beside: ("", "") };
    let mut list: Vec<Assumption> = Vec::new();
    for diagnostic in diagnostics {
        if diagnostic.fault.gravity() != Gravity::Verdict(Verdict::Assumed) {
            continue;
        }
        let text = summary::phrase(&diagnostic.fault, at);
        match list.iter_mut().find(|a| a.text == text) {
            Some(assumption) => assumption.uses += 1,
            None => {
                let code = format!("NC{:04}", diagnostic.fault.code());
                list.push(Assumption { code, text, rank: diagnostic.fault.rank().map(Rank::name), uses: 1 });
            }
        }
    }
    // The most dangerous first; those of one rank as they were met.
    let place =
        |assumption: &Assumption| Rank::ALL.iter().position(|rank| Some(rank.name()) == assumption.rank);
    list.sort_by_key(place);
    list
}

fn unconfirmed(diagnostics: &[Diagnostic]) -> Vec<UnconfirmedRow<'_>> {
    let mut rows: Vec<UnconfirmedRow> = Vec::new();
    for diagnostic in diagnostics {
        let Fault::AssumedRow { code, meaning } = &diagnostic.fault else { continue };
        match rows.iter_mut().find(|row| row.code == &**code) {
            Some(row) => row.uses += 1,
            None => rows.push(UnconfirmedRow { code, meaning, uses: 1 }),
        }
    }
    rows
}

/// Bytes in hexadecimal.
pub fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|b| format!("{b:02x}")).collect()
}
