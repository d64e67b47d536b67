//! The result for people: boxes, and a summary of each program.

use std::collections::BTreeMap;
use std::io;

use codespan_reporting::term::termcolor::WriteColor;
use codespan_reporting::term::{self, Config};
use ncc_check::Severity;

use super::told::{Item, Program};
use crate::render::Loudness;
use crate::render::human::{MOST, boxed};

/// Writes a program's findings.
///
/// # Errors
/// Writing.
pub fn write(out: &mut dyn WriteColor, program: &Program, loudness: Loudness) -> io::Result<()> {
    let mut met: BTreeMap<u16, usize> = BTreeMap::new();
    for item in &program.items {
        if loudness == Loudness::Quiet && item.severity != Severity::Error {
            continue;
        }
        let count = met.entry(item.code).or_default();
        *count += 1;
        if *count > most(item) && loudness != Loudness::Verbose {
            continue;
        }
        let boxed = boxed(&item.reported, &program.lines);
        term::emit_to_write_style(out, &Config::default(), &item.reported.excerpt, &boxed)
            .map_err(io::Error::other)?;
    }
    let mut more: BTreeMap<u16, usize> = BTreeMap::new();
    for item in program.items.iter().filter(|_| loudness != Loudness::Verbose) {
        let most = most(item);
        let count = met.get(&item.code).copied().unwrap_or(0);
        if count > most {
            more.insert(item.code, count - most);
        }
    }
    for (code, count) in more {
        writeln!(out, "… and {count} more of NC{code:04} (-v shows them)\n")?;
    }
    if loudness == Loudness::Quiet {
        return Ok(());
    }
    writeln!(out, "{} ({}): {}", program.shown, program.dialect, account(program))?;
    for (what, why) in &program.not_checked {
        writeln!(out, "  not checked  {what}: {why}")?;
    }
    Ok(())
}

/// Of one code, so many are shown. Of what ncc does not read, one place shows what it is about.
fn most(item: &Item) -> usize {
    match (item.name, item.severity) {
        (None, Severity::Note) => 1,
        _ => MOST,
    }
}

/// `1 error, 2 warnings`, or that there is nothing.
pub fn account(program: &Program) -> String {
    let names = ["error", "warning", "note"];
    let mut parts: Vec<String> = program
        .counts
        .iter()
        .zip(names)
        .filter(|(count, _)| **count > 0)
        .map(|(count, name)| format!("{count} {name}{}", if *count == 1 { "" } else { "s" }))
        .collect();
    if parts.is_empty() {
        parts.push("nothing found".to_owned());
    }
    if program.allowed > 0 {
        parts.push(format!("{} allowed", program.allowed));
    }
    parts.join(", ")
}
