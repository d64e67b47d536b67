//! Calls with arguments, and the parameters that they are for.
//!
//! Not here: how they come together (`parameters`).

use ncc_ir::expr::{Expr, Var};
use ncc_ir::program::Text;
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

use crate::siemens::values::typed::{Kind, Typed};

/// What is known of calls with arguments and of parameters.
#[derive(Debug, Default)]
pub(in crate::siemens) struct Handed {
    pub(in crate::siemens) calls: Vec<Call>,
    pub(in crate::siemens) parameters: Vec<(Text, Vec<Taken>)>,
    /// What holds where the part of the text begins that is kept whole.
    pub(in crate::siemens) stood: Tracker,
}

/// A call with arguments, by its place.
#[derive(Debug)]
pub(in crate::siemens) struct Call {
    pub(in crate::siemens) name: Text,
    pub(in crate::siemens) at: Span,
    /// What is handed over; `None` where nothing is.
    pub(in crate::siemens) given: Vec<Option<Argument>>,
    /// Whether it is made after each move.
    pub(in crate::siemens) modal: bool,
}

/// What a call hands over for one parameter.
#[derive(Clone, Debug)]
pub(in crate::siemens) enum Argument {
    /// A value.
    One(Typed),
    /// An array as a whole: its sizes, and its elements.
    Array(Box<[u32]>, Vec<Typed>),
}

/// A parameter: its type, and its value where a call has none.
#[derive(Clone, Debug)]
pub(in crate::siemens) struct Taken {
    pub(in crate::siemens) kind: Kind,
    pub(in crate::siemens) otherwise: Expr,
    /// Where one is kept that is the caller's variable itself; of an array, what the names of its elements begin with.
    pub(in crate::siemens) reference: Option<Var>,
    /// Of an array.
    pub(in crate::siemens) sizes: Box<[u32]>,
}
