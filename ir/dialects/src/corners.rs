//! Words that round or chamfer the corner between a block's move and the next one.

use ncc_ir::canon::CornerShape;
use serde::Deserialize;

/// Rounded and chamfered corners. A word is a letter, after a comma if it is written after one (`,R`), and
/// after a minus if its value is written as a negative number (`-Q`).
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CornerRules {
    /// Of a rounding, by its radius; empty for none.
    pub round: String,
    /// Of a chamfer, by how far it begins before the corner and ends after it; empty for none.
    pub leg: String,
    /// Of a chamfer, by its own length; empty for none.
    pub length: String,
    /// Whether corners beside arcs can be written so.
    pub arcs: bool,
    /// The manual and its page, or another source.
    pub source: String,
}

/// A word of a corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CornerWord {
    /// Its letter.
    pub letter: char,
    /// Whether it stands after a comma.
    pub comma: bool,
    /// Whether its value is written as a negative number.
    pub negative: bool,
}

impl CornerRules {
    /// The word of a shape.
    pub fn word(&self, shape: CornerShape) -> Option<CornerWord> {
        let text = match shape {
            CornerShape::Round => &self.round,
            CornerShape::Leg => &self.leg,
            CornerShape::Length => &self.length,
        };
        let negative = text.starts_with('-');
        let text = text.trim_start_matches('-');
        let comma = text.starts_with(',');
        let letter = text.trim_start_matches(',').chars().next()?;
        Some(CornerWord { letter, comma, negative })
    }

    /// The words that there are, each with its shape.
    pub fn words(&self) -> impl Iterator<Item = (CornerShape, CornerWord)> + '_ {
        CornerShape::ALL.into_iter().filter_map(|shape| Some((shape, self.word(shape)?)))
    }
}
