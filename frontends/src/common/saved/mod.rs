//! Codes active that a text saves in variables and restores, and numbers that it computes codes and
//! table entries from.
//!
//! Each reader notes them as it goes (`rows`, `numbers`, `back`). [`paths`] looks at the whole text when it
//! has been read.
//!
//! ```text
//! #10 = #4001    ...    G#10    the code of group 1 that was active, restored
//! ```
//!
//! Not here: what a text computes besides (`values` of each reader).

pub(crate) mod paths;

use ncc_dialects::SystemRow;
use ncc_ir::expr::Var;
use ncc_ir::program::Text;
use ncc_ir::source::Span;
use ncc_ir::unsupported::{CodeUnsupported, TableUnsupported};

/// What the text saves of the active modes and restores.
#[derive(Debug, Default)]
pub(crate) struct Saved {
    /// Variables that are given the active code of a group, each in its program, in the order of the text.
    pub(crate) rows: Vec<(Text, Var, &'static SystemRow)>,
    /// Variables that are given a whole number, in the same way.
    pub(crate) numbers: Vec<(Text, Var, i64)>,
    /// Where such codes are, and what tells the group.
    pub(crate) back: Vec<(Span, GroupSource)>,
    /// Variables that are set anywhere, each in its program, where values at the start are stated; `None` is one whose
    /// number is computed.
    pub(crate) set: Vec<(Text, Option<Var>)>,
    /// M codes of which the number is a variable whose value at the start is stated: where, as the text has it, which.
    pub(crate) stated: Vec<(Span, Text, Var)>,
}

/// What tells which group a code is of.
#[derive(Debug)]
pub(crate) enum GroupSource {
    /// A variable that has the active code of it.
    Saved(&'static SystemRow, Var),
    /// The range of its number.
    Range,
    /// The same, of a place of a table, by what that is called.
    Entry(&'static str),
}

impl Saved {
    /// A place of a table has a computed number.
    pub(crate) fn entry(&mut self, at: Span, name: &'static str) {
        self.back.push((at, GroupSource::Entry(name)));
    }
}

/// Why a code is refused.
pub(crate) const ANY: CodeUnsupported = CodeUnsupported::AnyNumber;

/// Why a place of a table is refused.
pub(crate) const ANY_PLACE: TableUnsupported = TableUnsupported::AnyEntry;
