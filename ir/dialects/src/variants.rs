//! Rows that hold where options are chosen so: another version of a control, or another build.
//!
//! ```toml
//! [[variant]]
//! when = { controller = "grblhal" }
//!
//! [[variant.code]]
//! code = "M1"
//! means = "OPTIONAL_PROGRAM_STOP"
//! source = "its own source: gcode.c"
//! ```
//!
//! A row takes the place of the dictionary's row with the same key, whole; any other is added.
//!
//! Not here: which options are chosen (`settings`).

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::behaviours::BehaviourRow;
use crate::codes::CodeRow;
use crate::cycles::{CycleRow, CycleRules};
use crate::names::NameRow;
use crate::stored::DataRow;
use crate::words::Address;

/// Rows that hold where options are chosen so.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct VariantRow {
    /// Options and the values that all of them must have.
    pub when: BTreeMap<String, String>,
    /// Blocks.
    #[serde(default)]
    pub block: VariantBlock,
    /// What all canned cycles share, in the place of the dictionary's.
    #[serde(default)]
    pub cycles: Option<CycleRules>,
    /// Capabilities that follow from no other row.
    #[serde(default)]
    pub can: VariantCan,
    /// Address letters.
    #[serde(default)]
    pub address: Vec<Address>,
    /// Canned cycles.
    #[serde(default)]
    pub cycle: Vec<CycleRow>,
    /// G and M codes.
    #[serde(default)]
    pub code: Vec<CodeRow>,
    /// Tables that a program puts values into.
    #[serde(default)]
    pub data: Vec<DataRow>,
    /// Words of several letters.
    #[serde(default)]
    pub name: Vec<NameRow>,
    /// What codes do besides their names.
    #[serde(default)]
    pub behaviour: Vec<BehaviourRow>,
}

/// What a variant changes of blocks.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct VariantBlock {
    /// Highest skip level that can be written after the mark.
    pub skip_levels: Option<u8>,
    /// Longest block when reading, in bytes.
    pub longest: Option<u32>,
    /// Most characters of a block without blanks and comments; 0 for no such limit.
    pub longest_bare: Option<u32>,
}

/// What a variant changes of the capabilities that follow from no other row.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct VariantCan {
    /// A tool is changed by hand.
    pub change_by_hand: Option<bool>,
    /// A length offset takes effect at once and moves nothing.
    pub length_at_once: Option<bool>,
}

impl VariantRow {
    /// Whether this variant and another can hold together.
    pub(crate) fn goes_with(&self, other: &VariantRow) -> bool {
        self.when.iter().all(|(option, value)| other.when.get(option).is_none_or(|own| own == value))
    }
}
