//! `ncc config`: what the project file states of a program, and in which line.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use codespan_reporting::diagnostic::Severity;
use codespan_reporting::term::termcolor::WriteColor;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::render::report;
use ncc_machines::project::NAME;
use ncc_machines::{ProfileError, Wrong};

use super::args::Config;
use super::load::SCHEMAS;
use super::projects::{InForce, Loaded, Row};
use super::settle::facts;
use super::{Look, Projects};
use crate::registry::DialectRegistry;
use crate::{files, machines};

/// Files and folders that are looked at for a pattern's sake.
const MOST: usize = 100_000;

/// The form of the file, as it is documented.
pub const SCHEMA: &str = include_str!("../../../docs/book/src/reference/project-file.md");

/// Runs it.
///
/// # Errors
/// The file has faults, or there is none; stdout cannot be written.
pub fn run(args: &Config, known: &DialectRegistry, err: &mut dyn WriteColor) -> Result<Exit, Problem> {
    if args.schema {
        files::to_stdout(&mut |out| out.write_all(SCHEMA.as_bytes()))?;
        return Ok(Exit::Done);
    }
    let Some(projects) = known.projects() else {
        return Err(Problem::usage("`--no-config` leaves nothing to show", "leave it out"));
    };
    let text = match &args.program {
        Some(program) => of_program(program, projects, known, err)?,
        None => of_folder(projects, known, err)?,
    };
    files::to_stdout(&mut |out| out.write_all(text.as_bytes()))?;
    Ok(Exit::Done)
}

fn none(where_: &Path) -> Problem {
    Problem::usage(
        format!("there is no {NAME} for {}", where_.display()),
        "the nearest one counts, searched upward from its folder; `ncc init PROGRAM --to DIALECT` writes one",
    )
}

fn head(file: &Loaded) -> String {
    format!("{}  sha256 {}\n", file.shown, &report::hex(&file.sha256)[..8])
}

fn of_program(
    program: &Path,
    projects: &Projects,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<String, Problem> {
    if let Err(error) = program.metadata() {
        return Err(Problem::file("read", &program.display().to_string(), &error));
    }
    let folder = program.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
    let Some((file, _)) = projects.nearest(folder, known, err)? else { return Err(none(program)) };
    let mut text = head(&file);
    match known.project(Look::File(program), err)? {
        Some(row) => text += &table(&lines(&row)),
        // Writing into a text cannot fail.
        None => drop(writeln!(text, "no pattern matches {}; nothing of it is active", program.display())),
    }
    Ok(text)
}

/// A fact: key, value, file and line.
type Line = (String, String, String);

fn lines(row: &InForce) -> Vec<Line> {
    let file = &row.file.shown;
    let place = |line: usize| format!("{file}:{line}");
    let mut all: Vec<Line> = Vec::new();
    for pattern in &row.files {
        all.push(("files".to_owned(), pattern.value.clone(), place(pattern.line)));
    }
    for (key, machine) in [("machine", &row.machine), ("to", &row.to)] {
        if let Some(machine) = machine {
            of_machine(key, machine, &row.file, &mut all);
        }
    }
    for folder in &row.include {
        all.push(("include".to_owned(), folder.value.0.clone(), place(folder.line)));
    }
    if let Some(folder) = &row.output {
        all.push(("output".to_owned(), folder.value.0.clone(), place(folder.line)));
    }
    let bodies = row.stock.iter().map(|body| ("stock", body));
    for (key, body) in bodies.chain(row.fixtures.iter().map(|body| ("fixtures", body))) {
        all.push((key.to_owned(), body.value.0.clone(), place(body.line)));
    }
    if let Some(table) = &row.table {
        all.push(("table".to_owned(), table.value.to_string(), place(table.line)));
    }
    all
}

fn of_machine(key: &str, machine: &Row, file: &Loaded, all: &mut Vec<Line>) {
    let dialect = &machine.profile.dialect.id;
    let place = format!("{}:{}", file.shown, machine.line);
    let value = machine.named.as_ref().map_or(dialect.clone(), |named| format!("{named} ({dialect})"));
    all.push((key.to_owned(), value, place));
    // Of a shipped profile, and of one in a file, the text tells the lines.
    let (name, text) = match &machine.found {
        None => (file.shown.clone(), file.text.clone()),
        Some(found) => match ncc_machines::shipped_text(found) {
            Some(text) => (format!("{found} (shipped)"), text.to_owned()),
            None => (found.clone(), fs::read_to_string(found).unwrap_or_default()),
        },
    };
    for (fact, stated) in facts(&machine.profile) {
        let line = text.get(..stated.span.start).unwrap_or_default().matches('\n').count() + 1;
        all.push((format!("{key}.{fact}"), stated.value.unwrap_or_default(), format!("{name}:{line}")));
    }
}

fn table(lines: &[Line]) -> String {
    let wide =
        |cell: fn(&Line) -> &String| lines.iter().map(|line| cell(line).chars().count()).max().unwrap_or(0);
    let (keys, values) = (wide(|line| &line.0), wide(|line| &line.1).min(40));
    lines.iter().map(|(key, value, place)| format!("  {key:keys$}  {value:values$}  {place}\n")).collect()
}

fn of_folder(
    projects: &Projects,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<String, Problem> {
    let here = Path::new(".");
    let Some((file, _)) = projects.nearest(here, known, err)? else { return Err(none(here)) };
    let mut text = head(&file);
    let names = below(file.folder());
    let mut empty = Vec::new();
    for at in 0..file.project.rows.len() {
        let row = file.row(at, known, err)?;
        if at > 0 {
            text.push('\n');
        }
        text += &table(&lines(&row));
        let patterns = file.project.rows.get(at).into_iter().flat_map(|row| &row.files);
        for pattern in patterns {
            if names.as_ref().is_some_and(|names| !names.iter().any(|name| pattern.matches(name))) {
                let wrong = Wrong::NoFile { pattern: pattern.text.get_ref().clone() };
                empty.push(ProfileError::new(wrong, pattern.text.span()));
            }
        }
    }
    // Warnings that cannot be written change nothing about what is shown.
    let _ = machines::print_as(Severity::Warning, SCHEMAS, &file.shown, &file.text, &empty, err);
    for name in names.iter().flatten() {
        file.project.row(name).map_err(|wrong| file.report(&[wrong], err))?;
    }
    Ok(text)
}

/// Paths of the files below a folder, with `/` between folders; `None` if there are too many.
fn below(folder: &Path) -> Option<Vec<String>> {
    let mut names = Vec::new();
    let mut open = vec![(folder.to_owned(), String::new())];
    let mut seen = 0;
    while let Some((folder, before)) = open.pop() {
        let Ok(entries) = fs::read_dir(&folder) else { continue };
        for entry in entries.flatten() {
            seen += 1;
            if seen > MOST {
                return None;
            }
            let name = format!("{before}{}", entry.file_name().to_string_lossy());
            // A link to a folder may lead back.
            match entry.file_type() {
                Ok(kind) if kind.is_dir() => open.push((entry.path(), name + "/")),
                Ok(_) => names.push(name),
                Err(_) => {}
            }
        }
    }
    names.sort();
    Some(names)
}
