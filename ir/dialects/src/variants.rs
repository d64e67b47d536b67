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
use std::sync::{Mutex, PoisonError};

use serde::Deserialize;

use crate::behaviours::BehaviourRow;
use crate::codes::CodeRow;
use crate::cycles::{CycleRow, CycleRules};
use crate::load::renew;
use crate::merge::same;
use crate::names::NameRow;
use crate::schema::Dialect;
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
    /// A length offset is taken up at once and moves nothing.
    pub length_at_once: Option<bool>,
}

impl VariantRow {
    /// Whether this variant and another can hold together.
    pub(crate) fn goes_with(&self, other: &VariantRow) -> bool {
        self.when.iter().all(|(option, value)| other.when.get(option).is_none_or(|own| own == value))
    }

    /// The dictionary with this variant's rows in, and with its options at their values.
    pub(crate) fn put_into(&self, dialect: &mut Dialect) {
        let block = &mut dialect.block;
        block.skip_levels = self.block.skip_levels.unwrap_or(block.skip_levels);
        block.longest = self.block.longest.unwrap_or(block.longest);
        block.longest_bare = self.block.longest_bare.unwrap_or(block.longest_bare);
        let can = &mut dialect.can;
        can.change_by_hand = self.can.change_by_hand.unwrap_or(can.change_by_hand);
        can.length_at_once = self.can.length_at_once.unwrap_or(can.length_at_once);
        if let Some(cycles) = &self.cycles {
            dialect.cycles = cycles.clone();
        }
        lay(&mut dialect.address, &self.address, |row| row.letter.to_string());
        lay(&mut dialect.cycle, &self.cycle, |row| same(&row.code));
        lay(&mut dialect.code, &self.code, |row| same(&row.code));
        lay(&mut dialect.data, &self.data, |row| row.name.clone());
        lay(&mut dialect.name, &self.name, |row| row.name.clone());
        lay(&mut dialect.behaviour, &self.behaviour, |row| row.name.clone());
        for (option, value) in &self.when {
            dialect.option.iter_mut().filter(|row| row.name == *option).for_each(|row| {
                row.default.clone_from(value);
            });
        }
    }
}

/// Lays rows over others.
fn lay<T: Clone>(under: &mut Vec<T>, over: &[T], key: impl Fn(&T) -> String) {
    for row in over {
        match under.iter_mut().find(|own| key(own) == key(row)) {
            Some(own) => own.clone_from(row),
            None => under.push(row.clone()),
        }
    }
}

/// The dictionary as it is with these options. Each is made once and lives as long as the process.
pub(crate) fn chosen(dialect: &'static Dialect, value: impl Fn(&str) -> String) -> &'static Dialect {
    static MADE: Mutex<Vec<(&'static Dialect, Vec<usize>, &'static Dialect)>> = Mutex::new(Vec::new());
    let fits = |row: &VariantRow| row.when.iter().all(|(option, wanted)| value(option) == *wanted);
    let at: Vec<usize> =
        dialect.variant.iter().enumerate().filter(|(_, row)| fits(row)).map(|(at, _)| at).collect();
    if at.is_empty() {
        return dialect;
    }
    let mut made = MADE.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((.., derived)) = made.iter().find(|(own, rows, _)| std::ptr::eq(*own, dialect) && *rows == at)
    {
        return derived;
    }
    let mut derived = dialect.clone();
    for row in at.iter().filter_map(|at| dialect.variant.get(*at)) {
        row.put_into(&mut derived);
    }
    // What a user has chosen is never left out in silence.
    renew(&mut derived).expect("variants of which the loader has tried each two together");
    let derived: &'static Dialect = Box::leak(Box::new(derived));
    made.push((dialect, at, derived));
    derived
}

impl Dialect {
    /// The dictionary as each of its variants makes it, with that variant.
    pub fn variants(&'static self) -> impl Iterator<Item = (&'static VariantRow, &'static Dialect)> {
        self.variant.iter().map(move |row| {
            let value = |option: &str| {
                let own = || self.option.iter().find(|own| own.name == option).map(|own| own.default.clone());
                row.when.get(option).cloned().or_else(own).unwrap_or_default()
            };
            (row, chosen(self, value))
        })
    }
}
