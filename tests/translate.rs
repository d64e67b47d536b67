//! The compiler as the tests call it: without a process.

use std::collections::BTreeSet;
use std::io::Cursor;

use codespan_reporting::term::termcolor::NoColor;
use ncc_dialects::{Settings, builtin};
use ncc_driver::job::{Job, Outcome};
use ncc_driver::questions::Policy;
use ncc_driver::render::About;
use ncc_driver::render::{Loudness, human};
use ncc_driver::translate::rewrite::pass;
use ncc_exec::world::World;
use ncc_exec::{Event, Exec, Runner};
use ncc_frontends::{Batch, Reader};
use ncc_ir::diag::{Diagnostic, Fault, Gravity};
use ncc_ir::program::{Procedure, Program};

use crate::corpus;

/// A Grbl with the options of a grblHAL, as pages and tests call it.
pub const GRBLHAL: &str = "grblhal";

/// A dialect with the working choice for its options.
///
/// # Panics
/// There is no such dialect.
pub fn settings(id: &str) -> Settings {
    if id == GRBLHAL {
        let mut settings = settings("grbl");
        settings.choose("controller", id).expect("an option of the dialect");
        return settings;
    }
    Settings::new(builtin(id).unwrap_or_else(|| panic!("no dialect {id}")))
}

/// A translation of a file of that name.
pub fn job(from: &str, to: &str, file: &str) -> Job {
    Job {
        layout: ncc_backends::Layout { numbering: ncc_backends::Numbering::Keep, crlf: false },
        // `suite/questions.rs` has which programs have two readings.
        questions: Policy::Assume,
        ..Job::new(settings(from), settings(to), file)
    }
}

/// A translation of a program of the corpus: one that computes is written as straight blocks.
///
/// # Panics
/// No pass does that.
pub fn straight_job(program: &corpus::Program, to: &str) -> Job {
    let passes = match computes(program) {
        true => vec![pass("flatten").expect("a pass of that name")],
        false => Vec::new(),
    };
    Job { passes, ..job(program.dialect, to, &program.file) }
}

/// Whether a program computes, decides or jumps, so that a target may take its straight blocks alone.
pub fn computes(program: &corpus::Program) -> bool {
    read(program.dialect, &program.text).is_ok_and(|read| ncc_ir::program::valid::anything(&read).is_some())
}

/// Translates; the text is what would be released, or empty.
///
/// # Panics
/// The anonymous file of the output fails.
pub fn translate(job: &Job, text: &[u8]) -> (Outcome, Vec<u8>) {
    let mut outcome =
        ncc_driver::translate::translate(job, &mut Cursor::new(text)).expect("an output in memory");
    let written = match outcome.release {
        Ok(()) => outcome.output.to_vec().expect("an output in memory"),
        Err(_) => Vec::new(),
    };
    (outcome, written)
}

/// Codes of the diagnostics that stop a translation.
pub fn stopping(job: &Job, outcome: &Outcome) -> BTreeSet<u16> {
    outcome.diagnostics.iter().filter(|d| job.refuses(d)).map(|d| d.fault.code()).collect()
}

/// Every diagnostic in words, verdicts included.
pub fn rendered(job: &Job, name: &str, text: &[u8], diagnostics: &[Diagnostic]) -> String {
    told(job, name, text, diagnostics, Loudness::Verbose)
}

/// Diagnostics as the user sees them.
///
/// # Panics
/// Rendering fails.
pub fn told(job: &Job, name: &str, text: &[u8], diagnostics: &[Diagnostic], how: Loudness) -> String {
    let mut source = Cursor::new(text);
    let mut about = About { job, name, source: &mut source };
    let mut out = NoColor::new(Vec::new());
    human::print(&mut out, &mut about, diagnostics, how).expect("writing to memory");
    String::from_utf8_lossy(&out.into_inner()).into_owned()
}

/// Reads a user's text.
///
/// # Errors
/// It has errors.
pub fn read(dialect: &str, text: &[u8]) -> Result<Program, String> {
    read_as(settings(dialect), text)
}

/// Reads a user's text for a machine with these choices.
///
/// # Errors
/// It has errors.
pub fn read_as(settings: Settings, text: &[u8]) -> Result<Program, String> {
    let mut reader = Reader::new(settings, true);
    let mut batch = Batch::default();
    reader.read(text, 0, &mut batch);
    reader.finish(&mut batch);
    let errors: Vec<_> = batch.diagnostics.iter().filter(|d| d.fault.gravity() == Gravity::Error).collect();
    if !errors.is_empty() {
        return Err(format!("{errors:?}"));
    }
    let mut procedures = vec![Procedure { body: batch.stmts, ..Procedure::default() }];
    procedures.append(&mut batch.procedures);
    Ok(Program { name: batch.name, assumed: batch.assumed, procedures })
}

/// What is found while a user's text is read.
pub fn faults(dialect: &str, text: &[u8]) -> Vec<Fault> {
    let mut reader = Reader::new(settings(dialect), true);
    let mut batch = Batch::default();
    reader.read(text, 0, &mut batch);
    reader.finish(&mut batch);
    batch.diagnostics.into_iter().map(|d| d.fault).collect()
}

/// Executes a program in a world, under a setting of the block-skip switches.
///
/// # Errors
/// It cannot be executed.
pub fn execute(program: &Program, world: &World, skip: u16) -> Result<Vec<Event>, String> {
    execute_by(Exec::new(world, skip), program)
}

/// The same by a control that has something in force already.
///
/// # Errors
/// The program cannot be executed.
pub fn execute_by(mut exec: Exec, program: &Program) -> Result<Vec<Event>, String> {
    exec.assume(&program.assumed);
    let mut events = Vec::new();
    let mut runner = Runner::new(program);
    runner.run(&mut exec, usize::MAX, &mut events).map_err(|d| format!("{:?}", d.fault))?;
    exec.end_of_text(&mut events);
    Ok(events)
}

/// Keeps a text for LinuxCNC's interpreter in the folder `NCC_TEXTS`, where that is asked for.
pub fn keep(name: &str, text: &[u8]) {
    if let Some(folder) = std::env::var_os("NCC_TEXTS") {
        let file = format!("{}.ngc", name.replace(' ', "-"));
        std::fs::write(std::path::Path::new(&folder).join(file), text).expect("a folder for texts");
    }
}
