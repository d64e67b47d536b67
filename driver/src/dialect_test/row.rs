//! What was found out about a row of a dictionary.

/// What was found out about a row.
#[derive(Clone, Debug)]
pub struct Row {
    /// Its table: `code`.
    pub table: &'static str,
    /// The row: `G81`, or what of it: `G81 R`.
    pub row: String,
    /// What was written, lines parted by ` ¶ `; in brackets where it was only read.
    pub written: String,
    /// What was read, in the neutral program's words; or the name of the refusal.
    pub read: String,
    /// Why it failed, if it did.
    pub failed: Option<String>,
    /// Whether its source confirms the row.
    pub sure: bool,
}
