//! Words of the canonical stream: names, numbers, texts.

use logos::{Lexer, Logos};
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::Text;
use ncc_ir_text::unquote;

/// Why a stretch of text is no word.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum LexFault {
    /// No word begins like this.
    #[default]
    Character,
    /// More digits than a number holds.
    Number,
    /// A text with an escape that there is not.
    Escape,
    /// More words than any call has.
    Long,
}

/// A word.
#[derive(Clone, Debug, Logos, PartialEq)]
#[logos(error = LexFault)]
#[logos(skip r"[ \t\r]+")]
pub(crate) enum Token {
    #[token("(")]
    Open,
    #[token(")")]
    Close,
    #[token(",")]
    Comma,
    #[token("/")]
    Slash,
    #[token("_", priority = 5)]
    Nothing,
    #[regex(r"[+-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)", number)]
    Number(Num),
    #[regex(r#""([^"\\\n]|\\[^\n])*""#, quoted)]
    Text(Text),
    #[regex(r"[A-Za-z_][A-Za-z0-9_]*", priority = 1)]
    Name,
}

/// An argument.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Argument {
    /// A number, without unit.
    Number(Num),
    /// A text.
    Text(Text),
    /// A name, which the text at its place spells.
    Name,
    /// `_`: an axis that the statement does not name.
    Nothing,
}

/// The value of at most 18 digits. A lone zero after the point is the text's way to show the point
/// and no digit of the number.
pub(super) fn number(lexer: &mut Lexer<'_, Token>) -> Result<Num, LexFault> {
    let (mut mantissa, mut digits, mut scale, mut point) = (0i64, 0u32, 0u8, false);
    for byte in lexer.slice().bytes() {
        match byte {
            b'0'..=b'9' => {
                mantissa = mantissa.wrapping_mul(10).wrapping_add(i64::from(byte - b'0'));
                digits += u32::from(digits > 0 || byte != b'0');
                scale += u8::from(point);
                if digits > 18 || scale > 18 {
                    return Err(LexFault::Number);
                }
            }
            b'.' => point = true,
            _ => {}
        }
    }
    if lexer.slice().starts_with('-') {
        mantissa = -mantissa;
    }
    let n = Num { mantissa, scale, point, unit: Unit::One };
    Ok(if scale == 1 && mantissa % 10 == 0 { n.trimmed() } else { n })
}

fn quoted(lexer: &mut Lexer<'_, Token>) -> Result<Text, LexFault> {
    unquote(lexer.slice()).ok_or(LexFault::Escape)
}
