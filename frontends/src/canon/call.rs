//! A call of the stream as written.

use ncc_ir::expr::num::Num;

use super::lexer::Argument;

/// Something with its place in the line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Placed<T> {
    /// What.
    pub(crate) is: T,
    /// First byte.
    pub(crate) l: usize,
    /// One past the last.
    pub(crate) r: usize,
}

/// A call as written.
#[derive(Debug)]
pub(crate) struct Call {
    /// The skip mark, with its level if that is written.
    pub(crate) skip: Option<Placed<Option<Num>>>,
    /// Place of the name.
    pub(crate) name: Placed<()>,
    /// Contents of the brackets.
    pub(crate) arguments: Vec<Placed<Argument>>,
    /// Place of the closing bracket.
    pub(crate) close: usize,
}
