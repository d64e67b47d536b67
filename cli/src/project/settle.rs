//! A row of a project file with the options of a call: an option goes before the file.

use std::path::PathBuf;
use std::sync::Arc;

use ncc_dialects::{Dialect, UnitsName};
use ncc_driver::job::project_answers::{Answer, Used};
use ncc_driver::problem::Problem;
use ncc_driver::render::report::hex;
use ncc_driver::source::Source;
use ncc_ir::canon::Units;
use ncc_machines::Profile;
use ncc_machines::schema::{Effect, MCodeRow};
use ncc_machines::table::{Stated as Fact, Tell};

use super::projects::{InForce, Row};
use crate::args::typed::MCode;
use crate::registry::DialectRegistry;

/// What a call states itself.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Stated<'a> {
    /// The dialect of the program; `auto` is none.
    pub(crate) from: Option<&'a str>,
    /// The machine of the program.
    pub(crate) machine: Option<&'a str>,
    /// Options of its dialect.
    pub(crate) from_options: &'a [(String, String)],
    /// The target's dialect.
    pub(crate) to: Option<&'a str>,
    /// The target's machine.
    pub(crate) machine_to: Option<&'a str>,
    /// Options of its dialect.
    pub(crate) to_options: &'a [(String, String)],
    /// Whether `-o` names where the output goes.
    pub(crate) output: Option<&'a std::path::Path>,
}

/// Which of a row's answers a verb needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sides {
    /// The program's machine.
    One,
    /// The target's alone, of a program that is the output: it is the machine of that.
    Target,
    /// The target's too.
    Both,
    /// The target's, and where the output goes.
    Written,
}

/// What is active for a program.
#[derive(Clone, Debug)]
pub(crate) struct Settled {
    /// The machine of the program.
    pub(crate) machine: Option<Arc<Profile>>,
    /// The machine to translate for.
    pub(crate) to: Option<Arc<Profile>>,
    /// Folders of called programs.
    pub(crate) include: Vec<PathBuf>,
    /// The folder of the outputs.
    pub(crate) output: Option<PathBuf>,
    /// All of it, to be reported.
    pub(crate) used: Arc<Used>,
}

impl Settled {
    /// Keeps with a source what the project file says of it.
    pub(crate) fn put_into(&self, source: &mut Source) {
        source.project = Some(Arc::clone(&self.used));
        source.include.clone_from(&self.include);
    }
}

/// Settles a row with what a call states. `dialect` is the program's where the operand names it.
///
/// # Errors
/// The call names a dialect that there is not.
pub(crate) fn settle(
    row: &InForce,
    sides: Sides,
    stated: &Stated,
    dialect: Option<&'static Dialect>,
    known: &DialectRegistry,
) -> Result<Settled, Problem> {
    let mut used = Used { file: row.file.shown.clone(), sha256: hex(&row.file.sha256), ..Used::default() };
    let named = |id: Option<&str>| id.filter(|id| *id != "auto").map(|id| known.dialect(id)).transpose();
    let own = |code: &MCode| Some(code.number);
    let from = match dialect {
        Some(dialect) => Some(dialect),
        None => named(stated.from)?,
    };
    let side = Side {
        key: "machine",
        dialect: from,
        dialect_option: if dialect.is_some() { "" } else { "--from " },
        machine: stated.machine,
        options: stated.from_options,
        units: known.units(),
        codes: codes(known, own),
    };
    let machine = match sides {
        Sides::Target => None,
        Sides::One | Sides::Both | Sides::Written => side.settle(row.machine.as_ref(), row, &mut used),
    };
    let to = match sides {
        Sides::One => None,
        Sides::Both | Sides::Written | Sides::Target => {
            let side = Side {
                key: "to",
                dialect: match dialect.filter(|_| sides == Sides::Target) {
                    Some(dialect) => Some(dialect),
                    None => named(stated.to)?,
                },
                dialect_option: if dialect.is_some() { "" } else { "--to " },
                machine: stated.machine_to,
                options: stated.to_options,
                units: None,
                codes: codes(known, |code| code.written),
            };
            side.settle(row.to.as_ref(), row, &mut used)
        }
    };
    let (machine, to) = if sides == Sides::Target { (to, None) } else { (machine, to) };
    for folder in row.include.iter().filter(|_| sides != Sides::Target) {
        let (key, value) = ("include".to_owned(), folder.value.0.clone());
        used.answers.push(Answer { key, value, line: folder.line });
    }
    let output = row.output.as_ref().filter(|_| sides == Sides::Written);
    let output = match (output, stated.output) {
        (Some(folder), None) => {
            let (key, value) = ("output".to_owned(), folder.value.0.clone());
            used.answers.push(Answer { key, value, line: folder.line });
            Some(folder.value.1.clone())
        }
        (Some(folder), Some(option)) if option != folder.value.1 => {
            let option = format!("-o {}", option.display());
            used.overridden.push(goes_before(&option, row, "output", &folder.value.0, folder.line));
            None
        }
        (Some(_) | None, _) => None,
    };
    let include =
        row.include.iter().filter(|_| sides != Sides::Target).map(|folder| folder.value.1.clone()).collect();
    Ok(Settled { machine, to, include, output, used: Arc::new(used) })
}

/// That an option goes before a fact of the file.
pub(crate) fn goes_before(option: &str, row: &InForce, key: &str, value: &str, line: usize) -> String {
    format!("{option} goes before {key} = {value} ({}:{line})", row.file.shown)
}

fn codes(known: &DialectRegistry, number: impl Fn(&MCode) -> Option<u16>) -> Vec<(u16, MCode)> {
    known.m_codes().iter().filter_map(|code| Some((number(code)?, *code))).collect()
}

/// What a call states of one side.
struct Side<'a> {
    key: &'static str,
    dialect: Option<&'static Dialect>,
    /// What stands before its name where the call states it; nothing before a colon.
    dialect_option: &'static str,
    machine: Option<&'a str>,
    options: &'a [(String, String)],
    units: Option<Units>,
    /// M codes of this side.
    codes: Vec<(u16, MCode)>,
}

impl Side<'_> {
    fn settle(&self, own: Option<&Row>, row: &InForce, used: &mut Used) -> Option<Arc<Profile>> {
        let own = own?;
        let name = own.named.clone().unwrap_or_else(|| own.profile.dialect.id.clone());
        if let Some(machine) = self.machine {
            if own.named.as_deref() != Some(machine) && own.found.as_deref() != Some(machine) {
                let option = match self.key {
                    "to" => format!("--machine-to {machine}"),
                    _ => format!("the machine {machine} of the command line"),
                };
                used.overridden.push(goes_before(&option, row, self.key, &name, own.line));
            }
            return None;
        }
        if let Some(dialect) = self.dialect.filter(|dialect| dialect.id != own.profile.dialect.id) {
            let colon = if self.dialect_option.is_empty() { ":" } else { "" };
            let option = format!("{}{}{colon}", self.dialect_option, dialect.id);
            used.overridden.push(goes_before(&option, row, self.key, &name, own.line));
            return None;
        }
        let value = match &own.named {
            Some(named) => format!("{named} ({})", own.profile.dialect.id),
            None => own.profile.dialect.id.clone(),
        };
        used.answers.push(Answer { key: self.key.to_owned(), value, line: own.line });
        used.profiles.extend(own.found.clone());
        let mut profile = Arc::clone(&own.profile);
        let mut over = |option: String, key: &str, value: &str, at: usize| {
            let line = match own.named {
                Some(_) => own.line,
                None => row.file.line(at),
            };
            used.overridden.push(goes_before(&option, row, &format!("{}.{key}", self.key), value, line));
        };
        if let (Some(units), Some(stated)) = (self.units, profile.schema.power_on.units.get()) {
            let (option, same) = match units {
                Units::Mm => ("mm", stated == UnitsName::Mm),
                Units::Inch => ("inch", stated == UnitsName::Inch),
            };
            if !same {
                let fact = profile.schema.power_on.units.tell("units");
                over(
                    format!("--units {option}"),
                    "power_on.units",
                    &fact.value.unwrap_or_default(),
                    fact.span.start,
                );
                Arc::make_mut(&mut profile).schema.power_on.units = Default::default();
            }
        }
        for (name, value) in self.options {
            let stated = profile.schema.options.iter().find(|(option, _)| option.get_ref() == name);
            let Some((_, choice)) = stated else { continue };
            let fact = choice.tell("");
            let Some(other) = fact.value.filter(|other| other != value) else { continue };
            let option = format!("--{}-option {name}={value}", if self.key == "to" { "to" } else { "from" });
            over(option, &format!("options.{name}"), &other, fact.span.start);
        }
        for (number, code) in &self.codes {
            let is = |fact: &MCodeRow| number_of(fact) == Some(*number);
            let at = profile.schema.m_code.iter().position(|fact| is(fact.get_ref()));
            let Some(at) = at else { continue };
            let fact = Arc::make_mut(&mut profile).schema.m_code.remove(at);
            let same = code.written.is_none() && fact.get_ref().effect.get() == Some(Effect::None);
            if !same {
                over(
                    code.to_string(),
                    &format!("m_code M{number}"),
                    &does(fact.get_ref()),
                    fact.span().start,
                );
            }
        }
        if own.named.is_none() {
            let facts = facts(&profile);
            let answer = |(key, fact): (String, Fact)| Answer {
                key: format!("{}.{key}", self.key),
                value: fact.value.unwrap_or_default(),
                line: row.file.line(fact.span.start),
            };
            used.answers.extend(facts.into_iter().map(answer));
        }
        Some(profile)
    }
}

fn number_of(row: &MCodeRow) -> Option<u16> {
    row.code.value.as_deref()?.trim_start_matches(['M', 'm']).parse().ok()
}

fn does(row: &MCodeRow) -> String {
    row.function.value.clone().unwrap_or_else(|| "no effect".to_owned())
}

/// The facts that a profile states, by their keys from its top, in the order of the schema.
pub(super) fn facts(profile: &Profile) -> Vec<(String, Fact)> {
    let options = profile
        .schema
        .options
        .iter()
        .map(|(name, choice)| (format!("options.{}", name.get_ref()), choice.tell("")));
    let confirmed = profile
        .schema
        .confirmed
        .iter()
        .map(|(name, yes)| (format!("confirmed.{}", name.get_ref()), yes.tell("")));
    let mut facts: Vec<(String, Fact)> = options.chain(confirmed).collect();
    for row in profile.rows() {
        let table = row.head.trim_matches(['[', ']']);
        // A row of several is known by its first key: `tool 3`.
        let several = row.head.starts_with("[[");
        let id = row.facts.first().and_then(|fact| fact.value.clone()).filter(|_| several);
        for fact in row.facts.iter().skip(usize::from(id.is_some())) {
            let key = match &id {
                Some(id) => format!("{table} {id} {}", fact.key),
                None => format!("{table}.{}", fact.key),
            };
            facts.push((key, fact.clone()));
        }
    }
    facts.retain(|(_, fact)| fact.value.is_some());
    facts
}
