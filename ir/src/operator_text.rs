//! Texts with values in them, for the operator or for a device, and alarms.

use crate::expr::Expr;
use crate::program::text::Text;

/// Part of a text that is made when the program runs.
#[derive(Clone, Debug, PartialEq)]
pub enum Piece {
    /// As it is.
    Text(Text),
    /// A number.
    Value {
        /// Its value; nothing is written as an empty text.
        value: Expr,
        /// Digits after the point, 0 to 9.
        digits: u8,
        /// Whether zeros at the end, and then the point, are left out.
        short: bool,
        /// Places before the point, blank where there are fewer digits.
        places: u8,
    },
}

/// An alarm that a program gives.
#[derive(Clone, Debug, PartialEq)]
pub struct Alarm {
    /// Its number, as the program says it.
    pub number: Option<Expr>,
    /// Its text; may be empty.
    pub text: Text,
}

/// What is written to the device that the control has for it, a printer or a file.
#[derive(Clone, Debug, PartialEq)]
pub enum Output {
    /// `OPEN_OUTPUT`: the device is made ready.
    Open,
    /// `OUTPUT`: a line of text with values in it.
    Line(Box<[Piece]>),
    /// `CLOSE_OUTPUT`: nothing more is written.
    Close,
}
