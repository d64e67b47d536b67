//! Certificates checked again: the files first, by their hashes, then everything that was found.
//!
//! A certificate holds if a comparison that is made again, of the same files as it was asked for then,
//! gives the same document. Not here: making one (`verify`).

use std::fs;
use std::path::{Path, PathBuf};

use codespan_reporting::term::termcolor::WriteColor;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::review::verify::document::{Document, Hashed, KIND, Program, VERSION};
use ncc_ir::canon::AXES;
use ncc_ir::expr::num::Nanos;
use serde_json::Value;

use super::args::Verify;
use super::comparison::{call, cannot_compare, compare, exit, is_stdin, show};
use super::side::{Asked, open};
use crate::args::typed::Format;
use crate::files;
use crate::project::Look;
use crate::registry::DialectRegistry;

/// Longest value that is printed whole, in characters.
const LONGEST: usize = 80;
/// Most disagreements that are reported.
const SHOWN: usize = 20;

/// Checks the certificate in a file again; `recheck` are the programs, where they are not found by the
/// names in it.
///
/// # Errors
/// It is no certificate, or a file that it names is not there.
pub(crate) fn check_again(
    args: &Verify,
    file: &Path,
    recheck: Option<&[String; 2]>,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<Exit, Problem> {
    let certificate = read(file)?;
    if let Some(option) = said_otherwise(args) {
        return Err(Problem::usage(
            format!("{option} is in the certificate"),
            "leave it out; or compare again: ncc verify SRC OUT",
        ));
    }
    let mut known = known.clone();
    let shops: Vec<PathBuf> = certificate
        .dictionaries
        .iter()
        .filter(|row| known.get(&row.name).is_none())
        .filter_map(|row| row.file.as_deref().map(|name| found(file, name)))
        .collect();
    known.add(&shops, Some(&mut *err))?;
    let operands = [0, 1].map(|side: usize| {
        let program = [&certificate.source, &certificate.output][side];
        match recheck {
            Some(names) => names[side].clone(),
            // A name that the certificate has is a path, whatever stands before a colon.
            None => format!("{}:{}", program.dialect, found(file, &program.file).display()),
        }
    });
    let from_stdin = [&certificate.source, &certificate.output].map(|program| is_stdin(&program.file));
    if let Some(side) = from_stdin.iter().position(|is| *is).filter(|_| recheck.is_none()) {
        return Err(Problem::usage(
            format!("the certificate's {} came from stdin", ["source", "output"][side]),
            "name the files: ncc verify --cert FILE --recheck SRC OUT",
        ));
    }
    let programs = [&certificate.source, &certificate.output];
    let machines = programs.map(|program| program.machine.as_deref().map(|name| machine(file, name)));
    let options = programs.map(chosen);
    let start = start(&certificate.asked.start);
    let asked = |side: usize| Asked {
        operand: &operands[side],
        from: Some(&programs[side].dialect),
        machine: machines[side].as_deref(),
        options: &options[side],
        start: start.filter(|_| side == 0),
        look: programs[side].project.is_none().then_some(Look::Nothing),
        is_output: side == 1,
        ..Asked::default()
    };
    let mut sides = open([&asked(0), &asked(1)], false, &known, err)?;
    let files = programs.map(|program| program.file.clone());
    let machines = machines.each_ref().map(|name| name.as_deref());
    let tolerance = certificate.asked.tolerance_mm.map(nanos);
    let call = call(files, machines, tolerance, &sides, &known).map_err(cannot_compare)?;
    let fresh = compare(args, &mut sides, &call, &known, err)?;
    let wrong = disagreements(&certificate, &fresh);
    let other = certificate.ncc_version != fresh.ncc_version;
    let held = match (wrong.is_empty(), exit(&fresh)) {
        (true, verdict) => verdict,
        (false, Exit::NotCompared) => Exit::NotCompared,
        (false, _) => Exit::Refused,
    };
    tell(args, file, [&certificate, &fresh], &wrong, other)?;
    Ok(held)
}

fn tell(
    args: &Verify,
    file: &Path,
    [certificate, fresh]: [&Document; 2],
    wrong: &[String],
    other: bool,
) -> Result<(), Problem> {
    let own = &fresh.ncc_version;
    let to_stdout = match args.format {
        Format::Json => files::data_to_stdout,
        Format::Human => files::to_stdout,
    };
    to_stdout(&mut |out| {
        if args.format == Format::Json {
            let told = serde_json::json!({
                "certificate": file.display().to_string(),
                "version": VERSION,
                "holds": wrong.is_empty(),
                "disagreements": wrong,
                "certificate_ncc_version": certificate.ncc_version,
                "found": fresh,
            });
            serde_json::to_writer_pretty(&mut *out, &told)?;
            return writeln!(out);
        }
        if args.telling.quiet {
            return Ok(());
        }
        let file = file.display();
        let holds = if wrong.is_empty() { "holds" } else { "does not hold" };
        writeln!(out, "{file}: {holds}")?;
        if other {
            writeln!(out, "  it was made by ncc {}; this is ncc {own}", certificate.ncc_version)?;
        }
        for line in wrong.iter().take(SHOWN) {
            writeln!(out, "  {line}")?;
        }
        if wrong.len() > SHOWN {
            writeln!(out, "  … and {} more", wrong.len() - SHOWN)?;
        }
        Ok(())
    })?;
    show(args, fresh).map(drop).or_else(|problem| match args.format {
        Format::Json => Ok(()),
        Format::Human => Err(problem),
    })
}

/// Reads a certificate.
///
/// # Errors
/// It cannot be read, or is none.
fn read(file: &Path) -> Result<Document, Problem> {
    let shown = file.display().to_string();
    let bytes = fs::read(file).map_err(|e| Problem::file("read", &shown, &e))?;
    let none = |why: String| Problem {
        exit: Exit::NotCompared,
        message: format!("{shown} is no certificate of ncc verify: {why}"),
        help: vec!["a certificate is written by: ncc verify SRC OUT --cert FILE".to_owned()],
    };
    let value: Value = serde_json::from_slice(&bytes).map_err(|e| none(e.to_string()))?;
    if value.get("kind").and_then(Value::as_str) != Some(KIND) {
        return Err(none(format!("it does not say that it is a {KIND}")));
    }
    match value.get("version").and_then(Value::as_u64) {
        Some(version) if version == u64::from(VERSION) => {}
        Some(version) => {
            return Err(Problem {
                exit: Exit::NotCompared,
                message: format!(
                    "{shown} has version {version} of the form; this ncc reads version {VERSION}"
                ),
                help: vec!["check it with the ncc that made it, or make it again".to_owned()],
            });
        }
        None => return Err(none("it has no version".to_owned())),
    }
    // From the text, so that what is wrong is reported with its line.
    let certificate: Document = serde_json::from_slice(&bytes).map_err(|e| none(e.to_string()))?;
    // What nobody can have asked for.
    match certificate.asked.tolerance_mm {
        Some(mm) if !(0.0..=1000.0).contains(&mm) => Err(none(format!("a tolerance of {mm} mm"))),
        Some(_) | None => Ok(certificate),
    }
}

/// An option that the certificate says already.
fn said_otherwise(args: &Verify) -> Option<&'static str> {
    let said = [
        ("--from", args.from.is_some()),
        ("--to", args.to.is_some()),
        ("--machine-from", args.machine_from.is_some()),
        ("--machine-to", args.machine_to.is_some()),
        ("--from-option", !args.from_option.is_empty()),
        ("--to-option", !args.to_option.is_empty()),
        ("--start", args.standing.start.is_some()),
        ("--args", args.holding.args.is_some()),
        ("--tolerance", args.nearness.tolerance.is_some()),
    ];
    said.into_iter().find(|(_, is)| *is).map(|(name, _)| name)
}

/// A file by its name in a certificate: from the certificate's folder, else from here, else beside the
/// certificate without its folders.
fn found(certificate: &Path, name: &str) -> PathBuf {
    let folder = certificate.parent().unwrap_or(Path::new(""));
    let name = Path::new(name);
    let beside = name.file_name().map(|name| folder.join(name));
    let places = [Some(folder.join(name)), Some(name.to_owned()), beside];
    places.into_iter().flatten().find(|path| path.is_file()).unwrap_or_else(|| name.to_owned())
}

/// A machine by its name in a certificate.
fn machine(certificate: &Path, name: &str) -> String {
    match ncc_machines::find(name) {
        Some(_) => name.to_owned(),
        None => found(certificate, name).display().to_string(),
    }
}

/// Options that were chosen.
fn chosen(program: &Program) -> Vec<(String, String)> {
    let options = program.options.iter().filter(|(_, choice)| choice.chosen);
    options.map(|(name, choice)| (name.clone(), choice.value.clone())).collect()
}

fn start(start: &[Option<f64>; AXES]) -> Option<[Option<Nanos>; AXES]> {
    start.iter().any(Option::is_some).then(|| start.map(|at| at.map(nanos)))
}

fn nanos(mm: f64) -> Nanos {
    (mm * 1e9).round() as Nanos
}

/// What of a certificate a comparison made again does not bear out: first the hashes of what it rests
/// on, then everything else. By which names files are called, and which ncc made it, is no matter.
pub fn disagreements(certificate: &Document, fresh: &Document) -> Vec<String> {
    let mut wrong = Vec::new();
    let programs = [(&certificate.source, &fresh.source), (&certificate.output, &fresh.output)];
    for (old, new) in programs {
        if old.sha256 != new.sha256 {
            wrong.push(format!("{} is another file: {}", old.file, hashes(&old.sha256, &new.sha256)));
        }
    }
    let texts = [
        ("dictionary", &certificate.dictionaries, &fresh.dictionaries),
        ("profile", &certificate.profiles, &fresh.profiles),
        ("called program", &certificate.source.called, &fresh.source.called),
        ("called program", &certificate.output.called, &fresh.output.called),
    ];
    for (what, old, new) in texts {
        texts_apart(what, old, new, &mut wrong);
    }
    let [mut old, mut new] = [certificate, fresh].map(|document| {
        // Plain data is always a value.
        serde_json::to_value(document).unwrap_or_default()
    });
    for document in [&mut old, &mut new] {
        let Some(all) = document.as_object_mut() else { continue };
        all.retain(|key, _| !matches!(key.as_str(), "ncc_version" | "dictionaries" | "profiles"));
        for side in ["source", "output"] {
            if let Some(side) = all.get_mut(side).and_then(Value::as_object_mut) {
                side.retain(|key, _| !matches!(key.as_str(), "file" | "machine" | "sha256" | "called"));
                if let Some(project) = side.get_mut("project").and_then(Value::as_object_mut) {
                    project.retain(|key, _| !matches!(key.as_str(), "file" | "overridden"));
                }
            }
        }
    }
    apart("", &old, &new, &mut wrong);
    wrong
}

fn texts_apart(what: &str, old: &[Hashed], new: &[Hashed], wrong: &mut Vec<String>) {
    let own = |row: &Hashed| match row.file {
        // A profile in a file is named by it, and may be found at another place.
        Some(_) if what == "profile" => row.name.rsplit(['/', '\\']).next().unwrap_or_default().to_owned(),
        Some(_) | None => row.name.clone(),
    };
    let mut left: Vec<&Hashed> = new.iter().collect();
    for row in old {
        let same = |other: &&Hashed| own(other) == own(row) && other.file.is_some() == row.file.is_some();
        // Two files in two folders may have one name.
        let same_text = |other: &&Hashed| same(other) && other.sha256 == row.sha256;
        let Some(at) = left.iter().position(same_text).or_else(|| left.iter().position(same)) else {
            wrong.push(format!("the {what} {} was not used", row.name));
            continue;
        };
        let other = left.remove(at);
        if other.sha256 != row.sha256 {
            let hashes = hashes(&row.sha256, &other.sha256);
            wrong.push(format!("the {what} {} is another one: {hashes}", row.name));
        }
    }
    for row in left {
        wrong.push(format!("the certificate does not name the {what} {}", row.name));
    }
}

fn hashes(old: &str, new: &str) -> String {
    let short = |hash: &str| hash.chars().take(12).collect::<String>();
    format!("sha256 {}… in the certificate, {}… now", short(old), short(new))
}

/// Where two values are apart, by their places.
fn apart(at: &str, old: &Value, new: &Value, wrong: &mut Vec<String>) {
    let inner = |key: &str| if at.is_empty() { key.to_owned() } else { format!("{at}/{key}") };
    match (old, new) {
        (Value::Object(a), Value::Object(b)) => {
            for (key, value) in a {
                apart(&inner(key), value, b.get(key).unwrap_or(&Value::Null), wrong);
            }
            for (key, value) in b.iter().filter(|(key, _)| !a.contains_key(*key)) {
                apart(&inner(key), &Value::Null, value, wrong);
            }
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            for (i, (a, b)) in a.iter().zip(b).enumerate() {
                apart(&inner(&i.to_string()), a, b, wrong);
            }
        }
        (a, b) if a == b => {}
        (Value::Array(a), Value::Array(b)) => {
            wrong.push(format!("{at}: the certificate has {} rows, found are {}", a.len(), b.len()));
        }
        (a, b) => wrong.push(format!("{at}: the certificate says {}, found is {}", short(a), short(b))),
    }
}

/// A value, or its beginning.
fn short(value: &Value) -> String {
    let text = value.to_string();
    match text.char_indices().nth(LONGEST) {
        Some((cut, _)) => format!("{}…", &text[..cut]),
        None => text,
    }
}
