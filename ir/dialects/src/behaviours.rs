//! Rows of what codes do besides their names.

use ncc_ir::behaviour::Behaviour;
use serde::Deserialize;

/// What codes of the control do besides their names: a fact that no program states.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BehaviourRow {
    /// Its name: `spindle-at-stop`.
    pub name: String,
    /// The value: `stops`. Of an open one, the usual value, which is executed first.
    pub value: String,
    /// A parameter, a machine datum or the builder decides it. Then it is an option too, of the same name with `_`,
    /// whose value `unknown` leaves it open; and every program that reaches it is executed with the other values.
    #[serde(default)]
    pub open: bool,
    /// Of an open one: the values that this control can have besides the usual one. Without it all values that are not rare.
    #[serde(default)]
    pub others: Vec<String>,
    /// Codes that it belongs to, for readers of the tables.
    #[serde(default)]
    pub codes: Vec<String>,
    /// How sure the source is.
    pub sure: Sureness,
    /// The manual and its page, or another source; of an open one, what decides it.
    pub source: String,
}

impl BehaviourRow {
    /// The behaviour and its value; `None` where one of the names is none.
    pub fn meaning(&self) -> Option<(Behaviour, u8)> {
        let behaviour = Behaviour::named(&self.name)?;
        Some((behaviour, behaviour.value(&self.value)?))
    }
}

/// How sure the source of a behaviour is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sureness {
    /// A manual or the control's own code, read; or the control was run.
    Read,
    /// A text that names the manual's page.
    SecondHand,
    /// Common knowledge of the trade, without a page.
    Memory,
}
