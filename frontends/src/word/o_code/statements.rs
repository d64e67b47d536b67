//! Settings of parameters and branches of O words, as the grammar makes them.

use ncc_ir::expr::Expr;
use ncc_ir::source::Span;

use crate::word::macros::formula::Index;
use crate::word::text::token::FlowWord;

/// A setting of a parameter, as the grammar makes it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Setting {
    /// The parameter as an expression.
    pub(crate) to: Expr,
    pub(crate) value: Expr,
    pub(crate) span: Span,
}

/// A block that begins with the letter of programs and does something.
#[derive(Clone, Debug)]
pub(crate) struct Decision {
    pub(crate) label: Index,
    pub(crate) word: FlowWord,
    /// Contents of the brackets after it.
    pub(crate) values: Vec<Expr>,
}

/// A label as a program writes it.
pub(in crate::word) fn label_text(label: &str) -> String {
    match label.bytes().all(|byte| byte.is_ascii_digit()) {
        true => format!("O{label}"),
        false => format!("O<{label}>"),
    }
}

/// The word of a branch.
pub(in crate::word) fn spelled(word: FlowWord) -> &'static str {
    match word {
        FlowWord::Sub => "sub",
        FlowWord::EndSub => "endsub",
        FlowWord::Call => "call",
        FlowWord::Return => "return",
        FlowWord::If => "if",
        FlowWord::ElseIf => "elseif",
        FlowWord::Else => "else",
        FlowWord::EndIf => "endif",
        FlowWord::Do => "do",
        FlowWord::While => "while",
        FlowWord::EndWhile => "endwhile",
        FlowWord::Repeat => "repeat",
        FlowWord::EndRepeat => "endrepeat",
        FlowWord::Break => "break",
        FlowWord::Continue => "continue",
    }
}
