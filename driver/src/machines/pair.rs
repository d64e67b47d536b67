//! The two machines of a translation: what their profiles settle, and how the shop writes programs.
//!
//! A fact that a profile states is no assumption; one that it denies stops the translation. Nothing
//! else is changed here about what was found.

use std::sync::Arc;

use ncc_backends::{Characters, Form, Numbering, ToolChange};
use ncc_dialects::{Dialect, Settings};
use ncc_exec::maps::{Maps, Renaming};
use ncc_ir::diag::Fault;
use ncc_machines::reading::{Place, Side, Told, rests_on};
use ncc_machines::schema::{BlockNumbers, Characters as Set, FileName, ToolChangeForm};
use ncc_machines::{Layout, Profile};

/// The profiles of both machines, where they were given.
#[derive(Clone, Debug, Default)]
pub struct Machines {
    /// The machine that the program was written for.
    pub from: Option<Arc<Profile>>,
    /// The machine that it is translated for.
    pub to: Option<Arc<Profile>>,
}

/// What the profiles say to something that was found.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// Nothing.
    Open,
    /// That it is so: it is no assumption.
    Settled,
    /// That it is not so: the fault that takes its place.
    Denied(Fault),
}

impl Machines {
    /// A side's dialect with what its profile states of it; the dialect alone if there is no profile, or that of another
    /// control.
    pub fn settings(&self, side: Side, dialect: &'static Dialect) -> Settings {
        let own = self.side(side).filter(|profile| profile.dialect.id == dialect.id);
        own.map_or_else(|| Settings::new(dialect), Profile::settings)
    }

    /// Block numbers, as the shop wants them.
    pub fn numbering(&self) -> Numbering {
        match self.layout().numbers {
            None | Some((BlockNumbers::Off, ..)) => Numbering::Off,
            Some((BlockNumbers::Keep, ..)) => Numbering::Keep,
            Some((BlockNumbers::New, first, step)) => Numbering::Every { first, step },
        }
    }

    /// The profile of a side.
    pub fn side(&self, side: Side) -> Option<&Profile> {
        match side {
            Side::From => self.from.as_deref(),
            Side::To => self.to.as_deref(),
        }
    }

    /// What the profiles say to something that was found.
    pub fn answer(&self, fault: &Fault, told: Told, from: &Settings, to: &Settings) -> Answer {
        if self.from.is_none() && self.to.is_none() {
            return Answer::Open;
        }
        let Some((side, place)) = rests_on(fault, told, from.dialect, to.dialect) else {
            return Answer::Open;
        };
        if let Fault::AssumedEdge { tool } = fault
            && let Some(answer) = self.answer_edge(*tool)
        {
            return answer;
        }
        let Some(profile) = self.side(side) else { return Answer::Open };
        let power_on = &profile.schema.power_on;
        let says = match (&place, fault) {
            (Place::Option(option), _) => {
                let chosen = profile.schema.options.iter().find(|(name, _)| name.get_ref() == option);
                chosen.and_then(|(_, choice)| choice.value.as_ref()).map(|_| true)
            }
            (Place::Confirmed(row), _) => {
                let confirmed = profile.schema.confirmed.iter().find(|(name, _)| name.get_ref() == row);
                confirmed.and_then(|(_, yes)| yes.get())
            }
            (Place::PowerOn("work_offset"), Fault::AssumedWorkOffset { offset }) => {
                power_on.work_offset.get().map(|own| own == u32::from(*offset))
            }
            (Place::PowerOn("no_origin_shift"), _) => power_on.no_origin_shift.get(),
            // A reader does not assume what its dictionary has as a fact.
            (Place::PowerOn(_), _) => None,
            // A code that a profile has is in its dictionary.
            (Place::Code(_) | Place::Function(_) | Place::Name(..) | Place::Number(..), _) => None,
        };
        match says {
            None => Answer::Open,
            Some(true) => Answer::Settled,
            Some(false) => Answer::Denied(Fault::ProfileDenies {
                fact: place.to_string().into(),
                machine: profile.id().into(),
            }),
        }
    }

    /// What the profiles say to edge 1 of a tool being the entry of its number. Where tools go by name,
    /// they say which entry is whose; where they do not, an entry of another number is not that.
    fn answer_edge(&self, tool: u32) -> Option<Answer> {
        if self.renaming().tools.is_some() {
            return Some(Answer::Settled);
        }
        let denies = |profile: &&Profile| {
            let mut rows = profile.schema.tool.iter().map(|row| row.get_ref());
            rows.any(|row| {
                row.number.get() == Some(tool) && row.length_entry.get().is_some_and(|n| n != tool)
            })
        };
        let profile = [self.from.as_deref(), self.to.as_deref()].into_iter().flatten().find(denies)?;
        let fact = format!("length_entry of tool {tool}").into();
        Some(Answer::Denied(Fault::ProfileDenies { fact, machine: profile.id().into() }))
    }

    /// The target machine's numbers of what the source's calls by its own.
    pub fn maps(&self, target: &Dialect) -> Maps {
        ncc_machines::maps(self.from.as_deref(), self.to.as_deref(), target)
    }

    /// The way back, for a judge of what was written.
    pub fn renaming(&self) -> Renaming {
        ncc_machines::renaming(self.from.as_deref(), self.to.as_deref())
    }

    /// Whether the shop names files after the numbers of programs.
    pub fn names_by_number(&self) -> bool {
        let emit = self.to.as_deref().map(|profile| &profile.schema.emit);
        emit.and_then(|e| e.file_name.get()) == Some(FileName::ProgramNumber)
    }

    /// The name of an output in a folder: after the source or the program's number, with the
    /// extension that the shop or the dialect has.
    pub fn file_name(&self, to: &Dialect, source: &str, number: Option<u32>) -> String {
        match number.filter(|_| self.names_by_number()) {
            Some(number) => {
                let letter = to.program.number.map(String::from).unwrap_or_default();
                let digits = to.program.number_digits;
                self.with_extension(to, &format!("{letter}{number:0digits$}"))
            }
            None => self.with_extension(to, stem(source)),
        }
    }

    /// The name of a file with the extension that the shop or the dialect has.
    pub fn with_extension(&self, to: &Dialect, stem: &str) -> String {
        let emit = self.to.as_deref().map(|profile| &profile.schema.emit);
        let usual = to.extensions.first().map(String::as_str).unwrap_or_default();
        let extension = emit.and_then(|e| e.extension.value.as_deref()).unwrap_or(usual);
        let name = if extension.is_empty() { stem.to_owned() } else { format!("{stem}.{extension}") };
        match emit.and_then(|e| e.upper_case.get()) {
            Some(true) => name.to_uppercase(),
            Some(false) | None => name,
        }
    }

    /// How the text of the output is formed.
    pub fn form(&self) -> Form {
        let layout = self.layout();
        Form {
            characters: match layout.characters {
                None | Some(Set::Utf8) => Characters::All,
                Some(Set::Capitals | Set::Ascii) => Characters::Ascii,
                Some(Set::Latin1) => Characters::Latin1,
            },
            tool_change: match layout.tool_change {
                None => ToolChange::Kept,
                Some(ToolChangeForm::OneBlock) => ToolChange::OneBlock,
                Some(ToolChangeForm::TwoBlocks) => ToolChange::TwoBlocks,
            },
        }
    }

    /// How programs for the target machine are laid out.
    pub fn layout(&self) -> Layout {
        self.to.as_deref().map(Profile::layout).unwrap_or_default()
    }
}

/// The name of a source without its extension. A name that begins with a point has none; its output is
/// not hidden, though.
fn stem(source: &str) -> &str {
    let shown = source.trim_start_matches('.');
    match shown.rsplit_once('.').map_or(shown, |(stem, _)| stem) {
        "" | "-" => "program",
        stem => stem,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_output_has_a_name() {
        let names = [
            ("part.cn", "part.nc"),
            (".nc", "nc.nc"),
            (".part.cn", "part.nc"),
            ("part", "part.nc"),
            ("a.b.cn", "a.b.nc"),
            ("-", "program.nc"),
            ("..", "program.nc"),
        ];
        let fanuc = ncc_dialects::builtin("fanuc").unwrap();
        for (source, output) in names {
            assert_eq!(Machines::default().file_name(fanuc, source, Some(7)), output, "{source}");
        }
    }
}
