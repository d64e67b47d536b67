//! Variables of the program that is being read.
//!
//! Not here: what is done with them.

use std::cell::Cell;
use std::collections::HashMap;

use ncc_ir::expr::Var;
use ncc_ir::program::Text;

use super::typed::Kind;

/// A variable of the program that is being read.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::siemens) struct Variable {
    pub(in crate::siemens) kind: Kind,
    /// Of an array.
    pub(in crate::siemens) sizes: Box<[u32]>,
    /// The text of a text variable.
    pub(in crate::siemens) text: TextOf,
    /// Of a parameter that is the caller's variable itself, where it is kept; of an array, what the names of its elements
    /// begin with.
    pub(in crate::siemens) reference: Option<Var>,
}

/// Variables of the program that is being read, by their names in capitals.
pub(in crate::siemens) type Variables = HashMap<Box<str>, Variable>;

/// What is known of the text of a text variable.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::siemens) struct TextOf {
    /// It, where it is known.
    pub(in crate::siemens) now: Option<Text>,
    /// The one that it has had since before any jump target or jump.
    pub(in crate::siemens) first: Option<Text>,
    /// How many characters it can have.
    pub(in crate::siemens) longest: Option<usize>,
    /// Whether control may have come from elsewhere, or gone past blocks, since; and whether the text was used there.
    pub(in crate::siemens) behind: bool,
    pub(in crate::siemens) relied: Cell<bool>,
}

impl TextOf {
    /// A variable without a first text.
    pub(in crate::siemens) fn empty(longest: Option<usize>) -> TextOf {
        TextOf { now: Some("".into()), first: Some("".into()), longest, ..TextOf::default() }
    }
}
