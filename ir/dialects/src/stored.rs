//! Tables of a control that a program puts values into, as a dictionary names their words.
//!
//! Not here: what the values are for (`ncc_ir::program::Data`).

use ncc_ir::program::ToolValue;
use serde::Deserialize;

use crate::schema::Dialect;

/// A table that a code with a number puts values into: `G10 L2`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DataRow {
    /// The code, and behind a blank the word that says which table.
    pub name: String,
    /// What the values are of.
    pub kind: DataKind,
    /// Letter of the word that says which entry.
    pub entry: char,
    /// The work offset that entry 1 is.
    #[serde(default = "one")]
    pub first: u16,
    /// How many entries it has.
    pub count: u16,
    /// Whether entry 0 is the work offset in force.
    #[serde(default)]
    pub zero_current: bool,
    /// Whether values are added to those that are there while incremental coordinates are in force.
    #[serde(default)]
    pub adds: bool,
    /// Of tools, the words of a block: what each is, and its letter.
    #[serde(default)]
    pub values: Vec<ValueWord>,
    /// Letter of a word that turns a work offset, which is refused by name.
    #[serde(default)]
    pub turns: Option<char>,
    /// Who says so.
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
}

/// A word for a value of a tool.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ValueWord {
    /// Which value.
    pub of: ValueName,
    /// Its letter.
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
}

impl From<ValueName> for ToolValue {
    fn from(name: ValueName) -> ToolValue {
        match name {
            ValueName::Length => ToolValue::Length,
            ValueName::LengthWear => ToolValue::LengthWear,
            ValueName::Radius => ToolValue::Radius,
            ValueName::RadiusWear => ToolValue::RadiusWear,
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

    /// Whether a word of it is of a radius, which may be meant as a diameter.
    pub fn has_radius(&self) -> bool {
        self.values.iter().any(|value| matches!(value.of, ValueName::Radius | ValueName::RadiusWear))
    }
}

impl Dialect {
    /// The tables of a code.
    pub fn tables_of(&self, code: &str) -> impl Iterator<Item = &DataRow> {
        self.data.iter().filter(move |row| row.selected().is_some_and(|(own, ..)| own == code))
    }

    /// Whether zeros of work offsets can be set, added to, and set so that the present position reads the
    /// words.
    pub(crate) fn sets_offsets(&self) -> [bool; 3] {
        let any = |kind: DataKind, adds: bool| self.data.iter().any(|r| r.kind == kind && (r.adds || !adds));
        [any(DataKind::Offset, false), any(DataKind::Offset, true), any(DataKind::OffsetHere, false)]
    }

    /// Which values of tools can be set, in the order of [`ToolValue::ALL`].
    pub(crate) fn sets_tools(&self) -> [bool; 4] {
        let words = || self.data.iter().flat_map(|row| &row.values);
        ToolValue::ALL.map(|value| words().any(|word| ToolValue::from(word.of) == value))
    }
}
