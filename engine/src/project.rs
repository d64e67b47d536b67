//! Requests about a project file: what it states of a program, and answers and a set-up written into it.
//!
//! Not here: its form (`ncc_machines::project`), and how it is written (`ncc_driver::job::project_file`).

use std::collections::BTreeSet;

use codespan_reporting::term::termcolor::Buffer;
use ncc_driver::job::project_file::{self, SetUp};
use ncc_driver::machines::pair::Machines;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::simulate::raw;
use ncc_machines::project::MachineRef;
use ncc_machines::table::Tell;
use serde_json::{Value, json};
use toml::Spanned;

use crate::program::{Files, Outputs, is_given, open, profile, row, settings};
use crate::request::{Project, Stated};

/// Writes the answers for a program, and its set-up, into a project file.
pub(crate) fn project(
    asked: &Project,
    files: &Files,
    messages: &mut Buffer,
) -> Result<(Exit, Outputs), Problem> {
    let (from, to) = ([&asked.from, &asked.machine_from], [&asked.to, &asked.machine_to]);
    let mut id = None;
    // A tool belongs to a machine, which has a dialect.
    if from.iter().any(|own| own.is_some()) || !asked.from_option.is_empty() || !asked.tools.is_empty() {
        let mut source = open(&asked.file, false, files, messages)?;
        let machines = Machines { from: profile(asked.machine_from.as_deref(), files)?, to: None };
        let (settings, rivals) =
            settings(&mut source, files, asked.from.as_deref(), &machines, &asked.from_option, None)?;
        if !rivals.is_empty() {
            return Err(project_file::undecided(&asked.file));
        }
        id = Some(settings.dialect.id.clone());
    }
    let text = asked.project.as_ref().and_then(|name| files.get(name)).map(Vec::as_slice).unwrap_or_default();
    let text = String::from_utf8_lossy(text);
    let from = id.as_ref().map(|dialect| project_file::Side {
        dialect,
        machine: asked.machine_from.as_deref(),
        options: &asked.from_option,
    });
    let dialect = files.named(to[0].as_deref())?.map_or("", |dialect| dialect.id.as_str());
    let to = project_file::Side { dialect, machine: asked.machine_to.as_deref(), options: &asked.to_option };
    let to = Some(&to).filter(|to| !to.dialect.is_empty() || to.machine.is_some());
    let set_up = SetUp {
        stock: asked.stock.as_deref(),
        fixtures: asked.fixtures.as_deref(),
        table: asked.table.as_ref().map(|table| table.first().copied()),
        tools: &asked.tools,
    };
    let written =
        project_file::answered(&text, &asked.file, from.as_ref(), to, &set_up, &|id| files.dialects.get(id))?;
    Ok((Exit::Done, vec![("output", written.into_bytes())]))
}

/// Statements of a project file about a program, the files that it names (profiles, bodies), and missing files among them.
///
/// ```json
/// { "machine": { "name": null, "dialect": "fanuc", "options": { "decimal_point": "calculator" } }, "to": null,
///   "stock": "X0:80 Y0:50 Z-20:0", "fixtures": ["vise.stl"], "table": -20.0, "files": ["vise.stl"],
///   "told": ["ncc.toml names vise.stl, and there is no such file"] }
/// ```
pub(crate) fn stated(asked: &Stated, files: &Files) -> Result<(Exit, Outputs), Problem> {
    let Some(row) = row(Some(&asked.project), &asked.file, files)? else {
        return Ok((Exit::Done, Vec::new()));
    };
    let bodies = row.stock.iter().chain(&row.fixtures).filter_map(|text| match raw::stated(text.get_ref()) {
        Ok(raw::Stated::File(name)) => Some(name),
        Ok(raw::Stated::Shape(_)) | Err(_) => None,
    });
    let profiles = row.machine.iter().chain(&row.to).filter_map(|side| match side {
        MachineRef::Named(name) if ncc_machines::find(name.get_ref()).is_none() => {
            Some(name.get_ref().clone())
        }
        MachineRef::Named(_) | MachineRef::Inline(..) => None,
    });
    let named: BTreeSet<String> = bodies.chain(profiles).collect();
    let lacking = named.iter().filter(|name| !is_given(name, files));
    let told: Vec<String> = lacking.map(|name| project_file::absent(name).message).collect();
    let document = json!({
        "machine": row.machine.as_ref().map(|side| about(side, files)),
        "to": row.to.as_ref().map(|side| about(side, files)),
        "stock": row.stock.as_ref().map(Spanned::get_ref),
        "fixtures": row.fixtures.iter().map(Spanned::get_ref).collect::<Vec<_>>(),
        "table": row.table.as_ref().map(Spanned::get_ref),
        "files": named,
        "told": told,
    });
    Ok((Exit::Done, vec![("document", serde_json::to_vec(&document).unwrap_or_default())]))
}

/// A machine of a row: its name, unless it stands in the row, and its dialect, where its profile is known.
fn about(side: &MachineRef, files: &Files) -> Value {
    match side {
        MachineRef::Named(name) => {
            let own = profile(Some(name.get_ref()), files).ok().flatten();
            json!({ "name": name.get_ref(), "dialect": own.map(|own| own.dialect.id.clone()), "options": {} })
        }
        MachineRef::Inline(own, _) => {
            let options = own
                .schema
                .options
                .iter()
                .map(|(name, choice)| (name.get_ref().clone(), choice.tell("").value));
            let options: serde_json::Map<String, Value> =
                options.filter_map(|(name, value)| Some((name, Value::String(value?)))).collect();
            json!({ "name": null, "dialect": own.dialect.id, "options": options })
        }
    }
}
