//! A fault in words: its headline, the label at its place, and the label at further places.
//!
//! ```text
//! Fault::WordWithoutNumber { letter: 'X' }    `X` without a number    fanuc does not read this as zero
//! ```
//!
//! The words are in `messages/`, the values in `facts`; what to do about a fault is in `advice`.

use std::collections::BTreeMap;

use ncc_ir::diag::Fault;
use ncc_ir::geometry::offset_path::Unreachable;

pub use super::context::Context;
use super::facts::{self, message};
use super::message::{Message, Value};

/// The words of a fault.
#[derive(Clone, Debug, PartialEq)]
pub struct Words {
    /// What is wrong, in one line.
    pub message: String,
    /// Why this place.
    pub label: String,
    /// What the further places are.
    pub related: String,
    /// The entry of these words: `NC0225-units`.
    pub entry: String,
    /// The values in them, by their names.
    pub values: BTreeMap<&'static str, Value>,
}

/// The words of a fault.
pub fn words(fault: &Fault, at: Context) -> Words {
    let message = message(fault, at);
    Words {
        message: message.headline(),
        label: message.label(),
        entry: message.entry(),
        values: message.values(),
        related: message.related().unwrap_or_else(|| Message::common("related").headline()),
    }
}

/// Why the tool cannot follow a contour.
pub fn unreachable(why: Unreachable) -> String {
    facts::unreachable(why, Message::new(Fault::ContourUnreachable { why }.code())).label()
}
