//! The recogniser of moves by words that are computed, in front of the grammar: sums of numbers and R parameters.
//!
//! ```text
//! G1 X10.5 Z=-0.164+R1    the tree that the grammar would give
//! ```
//!
//! It leaves everything else alone: on any other sign the block goes to the grammar. A test holds both to the same result.

use ncc_ir::source::Span;

use super::build;
use super::tree::{Address, Binary, Block, Expr, Item, Statement, Value};
use crate::common::fast_parse;
use crate::common::words::Digits;

/// Longest line that is looked at, so that no limit of the lexer is met.
const LONGEST: usize = 200;

/// Reads a line without its end; `None` where it is no such block, or one without an expression.
pub(in crate::siemens) fn read(line: &[u8], base: u32) -> Option<Block> {
    if line.len() > LONGEST {
        return None;
    }
    let mut reading = Reading { line, base, at: 0 };
    let mut block = Block::default();
    let mut items = Vec::new();
    let mut computes = false;
    reading.blanks();
    let start = reading.at;
    let mut end = start;
    while reading.at < line.len() {
        let from = reading.at;
        let letter = reading.next()?.to_ascii_uppercase();
        match letter {
            b'N' if from == start => {
                let digits = reading.number()?;
                let [l, r] = [from, reading.at].map(|at| base + at as u32);
                block.number = Some(build::block_number(digits, false, l, r).ok()?);
            }
            b'X' | b'Y' | b'Z' if reading.peek() == Some(b'=') => {
                items.push(reading.set(letter, from)?);
                computes = true;
            }
            b'G' | b'X' | b'Y' | b'Z' | b'F' => {
                let negative = reading.take(b'-');
                let digits = reading.number()?;
                let [l, r] = [from, reading.at].map(|at| base + at as u32);
                items.push(build::word(letter, digits, negative, l, r));
            }
            _ => return None,
        }
        end = reading.at;
        if !reading.blanks() && reading.at < line.len() {
            return None;
        }
    }
    block.statement = Statement::Words { items, jumps: Vec::new() };
    block.span = Span::new(base + start as u32, base + end as u32);
    computes.then_some(block)
}

struct Reading<'l> {
    line: &'l [u8],
    base: u32,
    at: usize,
}

impl Reading<'_> {
    fn peek(&self) -> Option<u8> {
        self.line.get(self.at).copied()
    }

    fn next(&mut self) -> Option<u8> {
        self.at += 1;
        self.line.get(self.at - 1).copied()
    }

    fn take(&mut self, sign: u8) -> bool {
        let there = self.peek() == Some(sign);
        self.at += usize::from(there);
        there
    }

    /// Passes blanks over; whether there are any.
    fn blanks(&mut self) -> bool {
        let from = self.at;
        while matches!(self.peek(), Some(b' ' | b'\t')) {
            self.at += 1;
        }
        self.at > from
    }

    /// A number that begins with a digit, and that no letter follows.
    fn number(&mut self) -> Option<Digits> {
        self.peek().filter(u8::is_ascii_digit)?;
        let (digits, end) = fast_parse::number(self.line, self.at)?;
        self.at = end;
        let goes_on = self.peek().is_some_and(|next| next.is_ascii_alphanumeric() || b"._".contains(&next));
        (!goes_on).then_some(digits)
    }

    /// `X=R1+5`, of which the letter at `from` has been passed over.
    fn set(&mut self, letter: u8, from: usize) -> Option<Item> {
        let [l, r] = [from, self.at].map(|at| self.base + at as u32);
        let place = build::place(Address::Letter(letter), None, Vec::new(), l, r);
        self.at += 1;
        self.blanks();
        let begins = self.at;
        let negative = self.take(b'-');
        let mut all = self.operand()?;
        if negative {
            all = build::negate(all, self.base + begins as u32, self.base + self.at as u32);
        }
        let mut end = self.at;
        loop {
            self.blanks();
            let operator = match self.peek() {
                Some(b'+') => Binary::Add,
                Some(b'-') => Binary::Subtract,
                Some(next) if next.is_ascii_alphabetic() => break,
                None => break,
                Some(_) => return None,
            };
            self.at += 1;
            self.blanks();
            let next = self.operand()?;
            all = build::binary(operator, all, next);
            end = self.at;
        }
        self.at = end;
        let span = Span::new(l, self.base + end as u32);
        Some(Item::Set { place, value: Value::Expr(all), span })
    }

    fn operand(&mut self) -> Option<Expr> {
        let from = self.at;
        let parameter = matches!(self.peek(), Some(b'R' | b'r'));
        self.at += usize::from(parameter);
        let digits = self.number()?;
        if matches!(self.peek(), Some(b'=' | b'[' | b'(')) {
            return None;
        }
        let [l, r] = [from, self.at].map(|at| self.base + at as u32);
        if !parameter {
            return Some(Expr::Number(digits, Span::new(l, r)));
        }
        let extension = build::whole_number(digits, l, r).ok()?;
        Some(Expr::Place(build::place(Address::Letter(b'R'), Some(extension), Vec::new(), l, r)))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::parse::parse;
    use super::*;

    #[test]
    fn usual_moves_by_sums_are_taken() {
        for line in ["X=R1", "G1 X10.5 Z=-0.164+R1 F200", "N10 x=1 - r100+2. Y-3", " Z= R500-R2\t"] {
            assert_eq!(read(line.as_bytes(), 7), Some(parse(line.as_bytes(), 7).expect("a block")), "{line}");
        }
        for line in [
            "X1",
            "X=SIN(R1)",
            "X=R1*2",
            "X=R[1]",
            "X=AC(R1)",
            "A=R1",
            "X=",
            "X=R1 R2=5",
            "/X=R1",
            "X=R1 ; A",
            "A: X=R1",
            "X=R1==2",
            "X=1EX2",
            "CR=R1",
        ] {
            assert_eq!(read(line.as_bytes(), 7), None, "{line}");
        }
    }

    proptest! {
        #[test]
        fn it_gives_what_the_grammar_gives(
            line in " ?(N[0-9.]{1,3} ?)?([GXYZFgx][0-9.-]{1,4} ?){0,2}([XYZ] ?= ?-?(R[0-9.]{1,3}|[0-9.]{1,5})( ?[+-] ?(R[0-9]{1,3}|[0-9.]{1,20})){0,4} ?){1,3}([FAR][0-9]{1,3}=?)?"
        ) {
            if let Some(block) = read(line.as_bytes(), 7) {
                prop_assert_eq!(Some(block), parse(line.as_bytes(), 7).ok());
            }
        }
    }
}
