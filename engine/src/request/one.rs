//! A program and how it is read.

use std::collections::BTreeMap;

use serde::Deserialize;

/// A program and how it is read.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct One {
    /// The name of its file.
    pub file: String,
    /// Its dialect; without, or with `auto`, it is recognised, or its machine's.
    #[serde(default)]
    pub from: Option<String>,
    /// The machine's profile: the name of one that comes with ncc, or of a file.
    #[serde(default)]
    pub machine: Option<String>,
    /// The project file among the files of the engine: what its row of the program states holds where the request states
    /// nothing else.
    #[serde(default)]
    pub project: Option<String>,
    /// Choices where the dictionary leaves a question open.
    #[serde(default)]
    pub from_option: BTreeMap<String, String>,
    /// Its units at power-on.
    #[serde(default)]
    pub units: Option<Units>,
    /// Whether it is for a mill, whatever it looks like.
    #[serde(default)]
    pub assume_milling: bool,
    /// Where the zero of the part lies: X, Y and Z of the work offset in which the program cuts first, machine coordinates in
    /// mm. It counts with a machine, and goes before its profile.
    #[serde(default)]
    pub zero: Option<[f64; 3]>,
    /// Moves that it makes at most, where it is executed for its path; without, any number.
    #[serde(default)]
    pub most_moves: Option<usize>,
    /// The number of that work offset, once it is known.
    #[serde(skip)]
    pub(crate) datum: Option<u32>,
}

/// A program of which no more is stated.
pub(super) fn one(
    file: &str,
    [from, machine, project]: [&Option<String>; 3],
    options: &BTreeMap<String, String>,
) -> One {
    One {
        file: file.to_owned(),
        from: from.clone(),
        machine: machine.clone(),
        project: project.clone(),
        from_option: options.clone(),
        units: None,
        assume_milling: false,
        zero: None,
        most_moves: None,
        datum: None,
    }
}

/// The unit of lengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Units {
    /// Millimetres.
    Mm,
    /// Inches.
    Inch,
}
