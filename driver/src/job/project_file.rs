//! The answers for one program, written into a project file: all else of the file stays as it is, to the byte.
//!
//! ```text
//! part.nc, fanuc, decimal_point = calculator    →    [[programs]]
//!                                                    files = "part.nc"
//!                                                    [programs.machine]
//!                                                    dialect = "fanuc"
//!                                                    options = { decimal_point = "calculator" }
//! ```
//!
//! A row that is about other programs too is the user's, and is left as it is. Not here: where the file is.

use std::collections::BTreeMap;

use ncc_machines::project::{NAME, Project};
use toml_edit::{ArrayOfTables, DocumentMut, InlineTable, Item, Table, value};

use crate::problem::{Exit, Problem, problem};

/// What is answered of one side.
#[derive(Clone, Copy, Debug)]
pub struct Side<'a> {
    /// The dialect of the control.
    pub dialect: &'a str,
    /// The machine's profile, if one is named.
    pub machine: Option<&'a str>,
    /// Options of the dialect.
    pub options: &'a BTreeMap<String, String>,
}

fn refused(form: &'static str, program: &str) -> Problem {
    Problem::of(Exit::Refused, &problem(form).text("program", program).text("file", NAME), None)
}

/// Why nothing is written where several dialects fit: the row would answer which one, and nobody has.
pub fn undecided(program: &str) -> Problem {
    refused("project-undecided", program)
}

/// The name of a program as a pattern that matches nothing else.
fn pattern(program: &str) -> String {
    let plain = |letter: char| match letter {
        '*' | '?' | '[' | ']' | '{' | '}' => format!("[{letter}]"),
        letter => letter.to_string(),
    };
    program.chars().map(plain).collect()
}

/// The text of a project file with the answers for one program; `text` is empty where there is no file yet.
///
/// # Errors
/// The file has faults, or what it says of the program is about others too, or cannot hold the answers.
pub fn answered(text: &str, program: &str, from: &Side, to: Option<&Side>) -> Result<String, Problem> {
    let faulty = || refused("project-faulty", program);
    let mut document: DocumentMut = text.parse().map_err(|_| faulty())?;
    let at = match text.trim().is_empty() {
        true => None,
        false => {
            let project = Project::parse(text, &ncc_dialects::builtin).map_err(|_| faulty())?;
            project.row(program).map_err(|_| faulty())?
        }
    };
    let programs = document.entry("programs").or_insert_with(|| Item::ArrayOfTables(ArrayOfTables::new()));
    let programs = programs.as_array_of_tables_mut().ok_or_else(faulty)?;
    let own = pattern(program);
    let row = match at {
        Some(at) => programs.get_mut(at).ok_or_else(faulty)?,
        None => {
            let mut row = Table::new();
            row.insert("files", value(own.as_str()));
            programs.push(row);
            programs.get_mut(programs.len().saturating_sub(1)).ok_or_else(faulty)?
        }
    };
    if row.get("files").and_then(Item::as_str).is_none_or(|files| !files.eq_ignore_ascii_case(&own)) {
        return Err(refused("project-shared", program));
    }
    put(row, "machine", from).map_err(|()| refused("project-named", program))?;
    if let Some(to) = to {
        put(row, "to", to).map_err(|()| refused("project-named", program))?;
    }
    let written = document.to_string();
    // It says of the program what it should, and is sound.
    match Project::parse(&written, &ncc_dialects::builtin).map(|project| project.row(program)) {
        Ok(Ok(Some(_))) => Ok(written),
        Ok(_) | Err(_) => Err(faulty()),
    }
}

/// Puts a side into a row. A profile that is named has its options in itself.
fn put(row: &mut Table, key: &str, side: &Side) -> Result<(), ()> {
    if let Some(machine) = side.machine {
        if !side.options.is_empty() {
            return Err(());
        }
        row.insert(key, value(machine));
        return Ok(());
    }
    if row.get(key).is_none_or(|own| !own.is_table_like()) {
        row.insert(key, Item::Table(Table::new()));
    }
    let own = row.get_mut(key).and_then(Item::as_table_like_mut).ok_or(())?;
    own.insert("dialect", value(side.dialect));
    let options: InlineTable =
        side.options.iter().map(|(name, chosen)| (name.as_str(), chosen.as_str())).collect();
    match side.options.is_empty() {
        true => drop(own.remove("options")),
        false => drop(own.insert("options", value(options))),
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(text: &str, chosen: &[(&str, &str)]) -> Result<String, Problem> {
        let none = BTreeMap::new();
        let options: BTreeMap<String, String> =
            chosen.iter().map(|(name, own)| ((*name).to_owned(), (*own).to_owned())).collect();
        let from = Side { dialect: "fanuc", machine: None, options: &options };
        let to = Side { dialect: "siemens", machine: None, options: &none };
        answered(text, "part.nc", &from, Some(&to))
    }

    const ROW: &str = "[[programs]]\nfiles = \"part.nc\"\n\n[programs.machine]\ndialect = \"fanuc\"\n\
        options = { decimal_point = \"calculator\" }\n\n[programs.to]\ndialect = \"siemens\"\n";

    #[test]
    fn a_new_file_has_a_row_for_the_program() {
        assert_eq!(written("", &[("decimal_point", "calculator")]).as_deref(), Ok(ROW));
    }

    #[test]
    fn all_else_stays_and_what_is_taken_back_goes() {
        let other = "# ours\n[[programs]]\nfiles = \"old/*.nc\" # these\nmachine = \"haas-vf2\"\n";
        let both = written(other, &[("decimal_point", "calculator")]).expect("written");
        assert_eq!(both, format!("{other}\n{ROW}"));
        let back = written(&both, &[]).expect("written");
        assert_eq!(back, both.replace("options = { decimal_point = \"calculator\" }\n", ""));
    }

    #[test]
    fn a_row_of_several_programs_and_a_file_with_faults_are_left_alone() {
        let shared = "[[programs]]\nfiles = \"*.nc\"\nmachine = \"haas-vf2\"\n";
        for text in [shared, "[[programs]\n", "[[programs]]\nfiles = 7\n"] {
            assert!(written(text, &[]).is_err(), "{text}");
        }
    }
}
