//! Tables of a control that a program puts values into, as a dictionary names their words.
//!
//! Not here: what the values are for (`ncc_ir::program::Data`).

use std::fmt::{self, Display, Formatter};

use ncc_ir::canon::{AXES, Axis};
use ncc_ir::expr::system::System;
use ncc_ir::expr::{Binary, Expr, Node, Var};
use ncc_ir::program::ToolValue;
use serde::Deserialize;

use crate::words::RefusalHelp;

/// A table that a code with a number puts values into: `G10 L2`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DataRow {
    /// The code, and after a blank the word that says which table; or a variable of the control with a `$`: in it,
    /// `#` is the number of the entry, `@` the letter of the axis.
    pub name: String,
    /// What the values are of.
    pub kind: DataKind,
    /// Letter of the word that says which entry; none of a table that is a variable.
    #[serde(default)]
    pub entry: char,
    /// The work offset that entry 1 is.
    #[serde(default = "one")]
    pub first: u16,
    /// How many entries it has.
    pub count: u16,
    /// Whether entry 0 is the active work offset.
    #[serde(default)]
    pub zero_current: bool,
    /// Whether values are added to those that are there while incremental coordinates are active.
    #[serde(default)]
    pub adds: bool,
    /// Whether what is active of a tool stays as it is until it is activated again; else nobody knows.
    #[serde(default)]
    pub kept: bool,
    /// Where tools are measured, the work offset in whose coordinates; 0 is those active.
    #[serde(default)]
    pub in_offset: u16,
    /// Of tools, the words of a block: what each is, and its letter.
    #[serde(default)]
    pub values: Vec<ValueWord>,
    /// Letter of a word that turns a work offset, which is refused.
    #[serde(default)]
    pub turns: Option<char>,
    /// The manual and its page, or another source.
    pub source: String,
}

/// What values in a table are of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DataKind {
    /// Zeros of work offsets, in machine coordinates, by axis words.
    Offset,
    /// Zeros of work offsets, so that the axis words become the coordinates of where the axes stand.
    OffsetHere,
    /// Tools.
    Tool,
    /// Offsets of tools, so that the axis words become the coordinates of where the axes stand, as soon as the tool
    /// is activated.
    ToolHere,
}

/// A word for a value of a tool.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ValueWord {
    /// Which value.
    pub of: ValueName,
    /// Its letter; none in a table that is a variable.
    #[serde(default)]
    pub letter: char,
}

/// A value of a tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ValueName {
    /// Length, without wear.
    Length,
    /// Wear of the length.
    LengthWear,
    /// Radius, without wear; the option `radius_data` may say that the word is a diameter.
    Radius,
    /// Wear of the radius; the option `radius_data` may say that the word is of the diameter.
    RadiusWear,
    /// Offset along X.
    OffsetX,
    /// Offset along Y.
    OffsetY,
}

impl From<ValueName> for ToolValue {
    fn from(name: ValueName) -> ToolValue {
        match name {
            ValueName::Length => ToolValue::Length,
            ValueName::LengthWear => ToolValue::LengthWear,
            ValueName::Radius => ToolValue::Radius,
            ValueName::RadiusWear => ToolValue::RadiusWear,
            ValueName::OffsetX => ToolValue::OffsetX,
            ValueName::OffsetY => ToolValue::OffsetY,
        }
    }
}

fn one() -> u16 {
    1
}

/// Name of the option that says whether values of radii are radii or diameters.
pub const RADIUS_DATA: &str = "radius_data";

impl DataRow {
    /// The code, and letter and number of the word that says which table.
    pub fn selected(&self) -> Option<(&str, u8, u32)> {
        let (code, word) = self.name.split_once(' ')?;
        let letter = *word.as_bytes().first().filter(|letter| letter.is_ascii_uppercase())?;
        Some((code, letter, word[1..].parse().ok()?))
    }

    /// Whether it is a variable of the control's own.
    pub fn is_variable(&self) -> bool {
        self.name.starts_with('$')
    }

    /// Whether a word of it is of a radius, which may be meant as a diameter.
    pub fn has_radius(&self) -> bool {
        self.values.iter().any(|value| matches!(value.of, ValueName::Radius | ValueName::RadiusWear))
    }
}

/// A value of the control's own that a program can ask for.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SystemRow {
    /// Number of the parameter, or of the first of several; 0 for none.
    pub number: u32,
    /// How many there are; 0 is one, or as many as there are axes of X, Y, Z, A, B and C.
    pub count: u32,
    /// Name of the parameter, as programs write it within `<` and `>`; empty for none. One with a `$` is written as it
    /// is: `@` in it is the letter of the axis, `#` the number of one of `count` entries, from 1 on.
    pub name: String,
    /// Whether there is one for each of X, Y, Z, A, B and C, by the numbers that follow.
    pub axes: bool,
    /// Whether lengths count in the machine's own unit, whatever is active: the option `machine_units`.
    pub machine_units: bool,
    /// Whether there is one for each entry of a table, from 1 on, by the numbers that follow: as many as `count`.
    pub entries: bool,
    /// The option of the dictionary that decides whether the row counts; empty if it always does.
    pub option: String,
    /// The value of the option with which it does.
    pub when: String,
    /// What is assumed where it is asked, in words; empty if nothing is.
    pub assumes: String,
    /// What it means: the name of a system variable, without its axis, entry and unit.
    pub means: String,
    /// What it means, where it is several such values together.
    pub sum: Vec<SystemTerm>,
    /// Whether it is zero, since there is no such axis.
    pub zero: bool,
    /// What it is, if it is not translated.
    pub refuse: Option<String>,
    /// Where it is refused, what to do instead.
    pub help: Option<RefusalHelp>,
    /// The manual and its page, or another source.
    pub source: String,
}

/// How a program names a value of the control's own, after the sign of variables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VariableName<'r> {
    /// By the number of its parameter: `5001`.
    Number(u32),
    /// By a name in brackets: `<_x>`.
    Bracketed(&'r str),
    /// By a name that stands as it is, `#` in it the entry and `@` the letter of the axis: `$P_UIFR[1,X,TR]`.
    Whole {
        /// The name as the dictionary has it.
        name: &'r str,
        /// The entry; 0 where the name has none.
        entry: u32,
        /// The axis.
        axis: Axis,
    },
}

impl VariableName<'_> {
    /// The number of the parameter, of a value that is named so.
    pub fn number(self) -> Option<u32> {
        match self {
            VariableName::Number(number) => Some(number),
            VariableName::Bracketed(_) | VariableName::Whole { .. } => None,
        }
    }
}

impl Display for VariableName<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            VariableName::Number(number) => write!(f, "{number}"),
            VariableName::Bracketed(name) => write!(f, "<{name}>"),
            VariableName::Whole { name, entry, axis } => {
                let letter = char::from(axis.letter());
                f.write_str(
                    &name.replace('#', &entry.to_string()).replace('@', letter.encode_utf8(&mut [0; 4])),
                )
            }
        }
    }
}

/// A value and what it is multiplied by.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SystemTerm {
    /// The name of a system variable; empty for a plain number.
    pub means: String,
    /// How many times it counts.
    pub times: i64,
}

impl SystemRow {
    /// The value of one of its parameters by its place among them, lengths in this unit, or else in the active one;
    /// `None` where it is none that is known.
    pub fn value(&self, place: u32, unit: &str) -> Option<Expr> {
        let node = |node| Expr::Node(Box::new(node));
        let of = |means: &str| {
            let mut name = means.to_owned();
            if self.axes {
                let axis = *Axis::ALL.get(place as usize)?;
                name.push('.');
                name.push(char::from(axis.letter().to_ascii_lowercase()));
            }
            if self.entries {
                name.push_str(&format!(".{}", place + 1));
            }
            if !unit.is_empty() {
                name.push('.');
                name.push_str(unit);
            }
            match System::named(&name) {
                System::Other(_) => None,
                system => Some(node(Node::Var(Var::System(system)))),
            }
        };
        if self.sum.is_empty() {
            return of(&self.means);
        }
        self.sum.iter().try_fold(None, |all, term| {
            let worth = match term.means.is_empty() {
                true => Expr::int(term.times),
                false => node(Node::Binary(Binary::Multiply, of(&term.means)?, Expr::int(term.times))),
            };
            Some(Some(match all {
                None => worth,
                Some(before) => node(Node::Binary(Binary::Add, before, worth)),
            }))
        })?
    }

    /// Values that it is by itself on one machine or another.
    pub fn says(&self) -> impl Iterator<Item = (System, VariableName<'_>)> {
        let units: &[&str] = if self.machine_units { &["mm", "inch"] } else { &[""] };
        self.by_name().chain(units.iter().flat_map(|machine| self.says_by_number(machine)))
    }

    /// Values that it is by itself on a machine of this unit, each with how a program names it after the sign of
    /// variables: by the row's name, else by its number. Those that are several together are none.
    pub fn says_in<'r>(
        &'r self,
        machine: &str,
    ) -> impl Iterator<Item = (System, VariableName<'r>)> + use<'r> {
        self.by_name().chain(self.says_by_number(machine))
    }

    /// Those whose name stands in programs as it is.
    fn by_name(&self) -> impl Iterator<Item = (System, VariableName<'_>)> {
        let named = self.name.starts_with('$') && self.refuse.is_none();
        let entries = match (named, self.name.contains('#')) {
            (false, _) => 0..0,
            (true, true) => 1..self.count.max(1) + 1,
            (true, false) => 0..1,
        };
        let first = named.then(|| self.first(if entries.start > 0 { ".1" } else { "" }, "")).flatten();
        entries.flat_map(move |entry| {
            let axes = if self.axes { &Axis::ALL[..] } else { &Axis::ALL[..1] };
            let first = first.clone();
            axes.iter().filter_map(move |axis| {
                let mut system = first.clone()?;
                if entry > 0 {
                    system = system.numbered(u16::try_from(entry).ok()?)?;
                }
                if self.axes {
                    system = system.along(*axis)?;
                }
                Some((system, VariableName::Whole { name: &self.name, entry, axis: *axis }))
            })
        })
    }

    fn says_by_number<'r>(
        &'r self,
        machine: &str,
    ) -> impl Iterator<Item = (System, VariableName<'r>)> + use<'r> {
        let plain = self.refuse.is_none() && !self.means.is_empty() && !self.name.starts_with('$');
        let entries = self.entries && !self.axes;
        let unit = if self.machine_units && !entries { machine } else { "" };
        let places = match (self.axes, self.count as usize) {
            (true, 0) => AXES,
            (true, count) => count.min(AXES),
            (false, count) if self.entries => count,
            (false, _) => 1,
        };
        let first = plain.then(|| self.first(if entries { ".1" } else { "" }, unit)).flatten();
        (0..if first.is_some() { places } else { 0 }).filter_map(move |place| {
            let first = first.clone()?;
            let system = match () {
                () if self.axes => first.along(Axis::ALL[place])?,
                () if entries => first.numbered(u16::try_from(place + 1).ok()?)?,
                () => first,
            };
            let spelling = match self.name.is_empty() {
                true => VariableName::Number(self.number + place as u32),
                false => VariableName::Bracketed(&self.name),
            };
            Some((system, spelling))
        })
    }

    /// The first of its values, along X if it has axes; with what its meaning is followed by for the first entry.
    fn first(&self, entry: &str, unit: &str) -> Option<System> {
        let axis = if self.axes { ".x" } else { "" };
        let dot = if unit.is_empty() { "" } else { "." };
        match System::named(&format!("{}{entry}{axis}{dot}{unit}", self.means)) {
            System::Other(_) => None,
            system => Some(system),
        }
    }

    /// The numbers of its parameters.
    pub fn numbers(&self) -> std::ops::Range<u32> {
        let axes = if self.count == 0 { ncc_ir::canon::AXES as u32 } else { self.count };
        let count = if self.axes { axes } else { self.count.max(1) };
        if self.number == 0 { 0..0 } else { self.number..self.number + count }
    }
}
