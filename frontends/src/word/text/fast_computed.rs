//! The recogniser of moves by words that are computed, in front of the grammar: sums of numbers and variables in brackets.
//!
//! ```text
//! G1 X10.5 Z[-0.164+#1]    the words and the expression that the grammar would give
//! ```
//!
//! It leaves everything else alone: on any other sign the block goes to the grammar. A test holds both to the same result.

use ncc_ir::expr::Binary;
use ncc_ir::source::Span;

use super::block::Block;
use crate::common::fast_parse;
use crate::common::words::{Value, Word};
use crate::word::macros::formula::{Formula, Index};

/// Most words of such a block.
const MOST_WORDS: usize = 16;

/// Reads the block that begins at `from` of `text` into `block`, and gives where its line's end is; `None` where it is no
/// such block, or one without an expression, and then nothing is in `block`.
pub(in crate::word) fn read(text: &[u8], from: usize, base: u32, block: &mut Block) -> Option<usize> {
    block.clear();
    let end = words(text, from, base, block).filter(|_| !block.exprs.is_empty());
    if end.is_none() {
        block.clear();
    }
    end
}

fn words(text: &[u8], from: usize, base: u32, block: &mut Block) -> Option<usize> {
    let mut at = from;
    loop {
        let letter = match text.get(at) {
            Some(b' ' | b'\t') => {
                at += 1;
                continue;
            }
            Some(b'\n') | None => return Some(at),
            Some(b'\r') if text.get(at + 1) == Some(&b'\n') => return Some(at + 1),
            Some(byte) if byte.is_ascii_alphabetic() => byte & 0xDF,
            Some(_) => return None,
        };
        let computed = b"XYZ".contains(&letter) && text.get(at + 1) == Some(&b'[');
        let (value, end) = if computed {
            let (formula, end) = sum(text, at + 2)?;
            let place = block.exprs.len() as u16;
            block.exprs.push(formula.expr);
            (Value::Computed(place), end)
        } else if b"NGXYZF".contains(&letter) {
            let (digits, end) = fast_parse::number(text, at + 1)?;
            (Value::Number(digits), end)
        } else {
            return None;
        };
        if block.words.len() == MOST_WORDS {
            return None;
        }
        let span = Span::new(base + at as u32, base + end as u32);
        block.words.push(Word { letter, value, span });
        at = end;
    }
}

/// The sum that begins at `at`, and where the bracket after it ends.
fn sum(text: &[u8], at: usize) -> Option<(Formula, usize)> {
    let negative = text.get(at) == Some(&b'-');
    let (first, mut at) = operand(text, at + usize::from(negative))?;
    let mut all = if negative { first.negative()? } else { first };
    loop {
        let operator = match text.get(at)? {
            b']' => return Some((all, at + 1)),
            b'+' => Binary::Add,
            b'-' => Binary::Subtract,
            _ => return None,
        };
        let (next, end) = operand(text, at + 1)?;
        all = Formula::binary(operator, all, next)?;
        at = end;
    }
}

fn operand(text: &[u8], at: usize) -> Option<(Formula, usize)> {
    let variable = text.get(at) == Some(&b'#');
    let from = at + usize::from(variable);
    text.get(from).filter(|byte| byte.is_ascii_digit())?;
    let (digits, end) = fast_parse::number(text, from)?;
    let formula = if variable { Formula::variable(Index::Number(digits))? } else { Formula::number(digits) };
    Some((formula, end))
}

#[cfg(test)]
mod tests {
    use ncc_dialects::builtin;
    use proptest::prelude::*;

    use super::*;
    use crate::word::text::block::parse;
    use crate::word::text::token::Signs;

    fn both(line: &str) -> Option<(Block, Block)> {
        let signs = Signs::new(builtin("fanuc").expect("a built-in dialect"));
        let (mut fast, mut long) = (Block::default(), Block::default());
        let end = read(line.as_bytes(), 0, 100, &mut fast)?;
        assert_eq!(end, line.len());
        parse(line.as_bytes(), 0, 100, signs, &mut long);
        Some((fast, long))
    }

    #[test]
    fn usual_moves_by_sums_are_taken() {
        for line in ["X[#1]", "G1 X10.5 Z[-0.164+#1] F200", "N10 x[1-#100-.5+2.] Y-3", "Z[#500-#2]\t"] {
            let taken = both(line).is_some();
            assert_eq!(taken, !line.contains("-.5"), "{line}");
        }
        for line in [
            "X1.",
            "X[SIN[#1]]",
            "X[#1*2]",
            "X[#[1]]",
            "X[1 +#1]",
            "A[#1]",
            "X[#1",
            "X[]",
            "X[#1]Y",
            "/X[#1]",
        ] {
            assert!(both(line).is_none(), "{line}");
        }
    }

    proptest! {
        #[test]
        fn it_gives_what_the_grammar_gives(
            line in "([NGXYZFxyz][0-9.-]{1,4} ?){0,2}([XYZ]\\[-?(#[0-9]{1,3}|[0-9.]{1,5})([+-](#[0-9.]{1,3}|[0-9.]{1,20})){0,4}\\] ?){1,3}([FA][0-9]{1,3})?"
        ) {
            if let Some((fast, long)) = both(&line) {
                prop_assert!(long.faults.is_empty() && long.statement.is_none() && long.comments.is_empty());
                prop_assert_eq!(&fast.words, &long.words);
                prop_assert_eq!(&fast.exprs, &long.exprs);
            }
        }
    }
}
