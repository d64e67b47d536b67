//! Programs with a clock.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::one::{One, Units, one};

/// A program with a clock.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Time {
    /// As of [`One`].
    pub file: String,
    /// As of [`One`].
    #[serde(default)]
    pub from: Option<String>,
    /// As of [`One`]; a machine file of the case study (`machine.json`) serves too.
    #[serde(default)]
    pub machine: Option<String>,
    /// As of [`One`].
    #[serde(default)]
    pub project: Option<String>,
    /// As of [`One`].
    #[serde(default)]
    pub from_option: BTreeMap<String, String>,
    /// As of [`One`].
    #[serde(default)]
    pub units: Option<Units>,
    /// As of [`One`].
    #[serde(default)]
    pub assume_milling: bool,
    /// As of [`One`].
    #[serde(default)]
    pub zero: Option<[f64; 3]>,
    /// Where the tool stands before the first block, program coordinates: `X-9,Y15.588,Z3`.
    #[serde(default)]
    pub start: Option<String>,
    /// Seconds on the clock before the first block, 0 or more.
    #[serde(default)]
    pub start_time: f64,
    /// The model of the times: `ideal` (without), `trapezoidal`, `jerk-limited`.
    #[serde(default)]
    pub model: Option<String>,
    /// The function that takes the time of a tool change; without, the machine's.
    #[serde(default)]
    pub tool_change_on: Option<ToolChangeOn>,
    /// Before or after processing.
    #[serde(default)]
    pub stage: Stage,
    /// The fields of blocks.
    #[serde(default)]
    pub form: Form,
    /// Whether what was found is wanted as JSON too: a list of objects as of a line of `ncc --format json`.
    #[serde(default)]
    pub findings: bool,
    /// Bytes of the document at most; without, as many as it takes.
    #[serde(default)]
    pub most: Option<u64>,
}

impl Time {
    /// The program alone.
    pub(crate) fn one(&self) -> One {
        One {
            units: self.units,
            assume_milling: self.assume_milling,
            zero: self.zero,
            ..one(&self.file, [&self.from, &self.machine, &self.project], &self.from_option)
        }
    }
}

/// A program whose times are summed up.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Summary {
    /// As of [`One`].
    pub file: String,
    /// As of [`One`].
    #[serde(default)]
    pub from: Option<String>,
    /// As of [`Time`].
    #[serde(default)]
    pub machine: Option<String>,
    /// As of [`One`].
    #[serde(default)]
    pub from_option: BTreeMap<String, String>,
    /// As of [`One`].
    #[serde(default)]
    pub assume_milling: bool,
    /// As of [`Time`].
    #[serde(default)]
    pub start: Option<String>,
    /// As of [`Time`].
    #[serde(default)]
    pub model: Option<String>,
    /// As of [`Time`].
    #[serde(default)]
    pub tool_change_on: Option<ToolChangeOn>,
    /// As of [`Time`].
    #[serde(default)]
    pub findings: bool,
}

impl Summary {
    /// The program with its clock.
    pub(crate) fn time(&self) -> Time {
        Time {
            file: self.file.clone(),
            from: self.from.clone(),
            machine: self.machine.clone(),
            project: None,
            from_option: self.from_option.clone(),
            units: None,
            assume_milling: self.assume_milling,
            zero: None,
            start: self.start.clone(),
            start_time: 0.0,
            model: self.model.clone(),
            tool_change_on: self.tool_change_on,
            stage: Stage::After,
            form: Form::Document,
            findings: self.findings,
            most: None,
        }
    }
}

/// The function that takes the time of a tool change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ToolChangeOn {
    /// `SELECT_TOOL`, as in the case study's table.
    Select,
    /// `CHANGE_TOOL`.
    Change,
}

/// A stage of the case study's document.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Stage {
    /// Cycles as they are called, without times.
    Before,
    /// All moves, with times.
    #[default]
    After,
}

/// A form of the case study's document.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Form {
    /// That of ncc.
    #[default]
    Document,
    /// That of the case study.
    Printed,
}
