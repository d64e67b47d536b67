//! Codes that put values into the control's tables.

use ncc_dialects::DataRow;
use ncc_ir::program::ToolValue;

use super::codes::{Code, Letter};

/// A table that values are put into.
#[derive(Clone, Debug)]
pub(crate) struct DataCode {
    pub row: &'static DataRow,
    pub code: Code,
    /// Letter and number that say which table.
    pub select: (u8, u32),
    /// Letter of the entry.
    pub entry: u8,
    /// The word that turns a work offset.
    pub turn: Option<Letter>,
    /// Words of values of tools.
    pub values: Vec<(ToolValue, Letter)>,
}
