//! Facts of a setup sheet, gathered.

use ncc_driver::time::duration::short;
use serde_json::Value;

/// A value to a thousandth.
pub(super) fn mm(value: f64) -> String {
    short(value, 3)
}

/// The mark of a guess.
pub(super) const GUESS: &str = "<mark>guess</mark>";

/// A translation of the program.
pub(super) struct Translated {
    pub(super) target: String,
    pub(super) state: &'static str,
    pub(super) revision: i64,
    /// Its inputs that are others now.
    pub(super) stale: Vec<&'static str>,
}

/// The part, cut; or the reason why there is none.
pub(super) type Part = Result<(Value, String), String>;

/// Facts of a sheet.
pub(super) struct Facts {
    pub(super) name: String,
    pub(super) folder: String,
    pub(super) revision: i64,
    pub(super) sha256: String,
    pub(super) author: String,
    pub(super) message: String,
    pub(super) made: String,
    /// The dialect of the execution, and whether it was recognised.
    pub(super) dialect: (String, bool),
    /// Document of the times.
    pub(super) summary: Value,
    /// Coolants and work offsets.
    pub(super) used: Value,
    /// The document of the check, or why there is none.
    pub(super) check: Result<Value, String>,
    /// The document of the part and its drawing.
    pub(super) part: Part,
    pub(super) translations: Vec<Translated>,
    /// Whether more translations are not listed.
    pub(super) has_more: bool,
}

impl Facts {
    /// The program in the document of the times.
    pub(super) fn timing(&self) -> &Value {
        &self.summary["programs"][0]
    }
}
