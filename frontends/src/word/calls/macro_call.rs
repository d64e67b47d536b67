//! Lowering of a macro call: a program is called with arguments, which are its own local variables.
//!
//! `A` to `Z` name a variable each; `I`, `J` and `K` that come again, or in another order, name those of further
//! sets (16-C, custom macro: argument specification I and II). What has no argument has no value.
//!
//! Not here: how calls come again at every move (`modal_call`).

use ncc_dialects::{Meaning, Quantity};
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::{Expr, Node};
use ncc_ir::program::{Call, Op};
use ncc_ir::unsupported::{CallUnsupported, CodeUnsupported};

use crate::batch::Batch;
use crate::common::Source;
use crate::common::words::{Value, Word, tenths};
use crate::word::block_words::Code;
use crate::word::lower::Lower;
use crate::word::macros::computing::has_round;
use crate::word::text::block::Block;

/// Local variables of a program.
const LOCALS: usize = 33;

/// Sets of `I`, `J` and `K`.
const SETS: usize = 10;

/// Most calls by one word.
const MOST_TIMES: u32 = 9999;

/// The variable of a letter but `I`, `J` and `K`.
fn variable(letter: u8) -> Option<usize> {
    Some(match letter {
        b'A' => 1,
        b'B' => 2,
        b'C' => 3,
        b'D' => 7,
        b'E' => 8,
        b'F' => 9,
        b'H' => 11,
        b'M' => 13,
        b'Q' => 17,
        b'R' => 18,
        b'S' => 19,
        b'T' => 20,
        b'U' => 21,
        b'V' => 22,
        b'W' => 23,
        b'X' => 24,
        b'Y' => 25,
        b'Z' => 26,
        _ => return None,
    })
}

impl Lower {
    /// The code of a macro call, if the block has one.
    pub(in crate::word) fn macro_code(&self, block: &Block) -> Option<Code> {
        let dialect = self.settings.dialect;
        if !dialect.program.macro_b {
            return None;
        }
        block.words.iter().enumerate().find_map(|(at, word)| {
            let Value::Number(digits) = word.value else { return None };
            let number = tenths(digits).filter(|_| word.letter == b'G')?;
            let row = dialect.code_row(word.letter, number)?;
            let meaning = row.means.filter(|meaning| meaning.calls_macro())?;
            Some(Code { row, meaning, span: word.span, at })
        })
    }

    /// What the words of a block hand over, but the code's own, which stands at a place where it stands in the block:
    /// the program's number, the repeat count, and the arguments.
    fn handed_over(
        &mut self,
        code: &Code,
        at_code: Option<usize>,
        block: &Block,
        src: Source,
        out: &mut Batch,
    ) -> (Option<u32>, u32, Vec<Expr>) {
        let mut letters = code.row.words.bytes();
        let (program, count) = (letters.next().unwrap_or(b'P'), letters.next().unwrap_or(b'L'));
        let number_letter = self.settings.dialect.block.number.map_or(0, |c| c as u8);
        let (mut name, mut times) = (None, 1);
        let mut arguments: Vec<Option<Expr>> = Vec::new();
        let mut seen = 0u32;
        let (mut set, mut last) = (0, None);
        for (at, word) in block.words.iter().enumerate() {
            if Some(at) == at_code {
                continue;
            }
            if word.value == Value::None {
                let letter = char::from(word.letter);
                self.fault(Fault::WordWithoutNumber { letter }, word.span, out);
                continue;
            }
            let set_place = b"IJK".iter().position(|letter| *letter == word.letter);
            if set_place.is_none() && word.letter.is_ascii_uppercase() {
                let bit = 1u32 << (word.letter - b'A');
                if seen & bit != 0 {
                    self.fault(Fault::WordTwice { letter: char::from(word.letter) }, word.span, out);
                }
                seen |= bit;
            }
            if word.letter == number_letter {
                self.now.number = self.read_whole(word, src, out);
                continue;
            }
            if word.letter == program {
                name = self.read_whole(word, src, out);
                continue;
            }
            if word.letter == count {
                times = self.read_whole(word, src, out).unwrap_or(1);
                if !(1..=MOST_TIMES).contains(&times) {
                    self.fault(Fault::OutOfRange { word: src.text(word.span).into() }, word.span, out);
                }
                continue;
            }
            let place = match set_place {
                Some(place) => {
                    if last.is_some_and(|last| place <= last) {
                        set += 1;
                    }
                    last = Some(place);
                    (set < SETS).then_some(4 + 3 * set + place)
                }
                None => variable(word.letter),
            };
            let Some(place) = place else {
                self.fault(Fault::WordUnused { word: src.text(word.span) }, word.span, out);
                continue;
            };
            let Some(value) = self.argument(word, block, src, out) else { continue };
            if arguments.len() < place {
                arguments.resize(place, None);
            }
            // Of two that name one variable, the later one counts.
            arguments[place - 1] = Some(value);
        }
        debug_assert!(arguments.len() <= LOCALS);
        let nothing = || Expr::Node(Box::new(Node::Vacant));
        (name, times, arguments.into_iter().map(|a| a.unwrap_or_else(nothing)).collect())
    }

    /// A block under a code that makes its words the arguments of a call.
    pub(in crate::word) fn words_call(&mut self, code: &Code, block: &Block, src: Source, out: &mut Batch) {
        self.found_variables(out);
        let (.., arguments) = self.handed_over(code, None, block, src, out);
        if self.level_open() {
            return self.refuse_level(block.span, out);
        }
        self.jumped_to(block, out);
        self.call_by_words(arguments, block, out);
    }

    /// A block with a macro call.
    pub(in crate::word) fn macro_call(&mut self, code: &Code, block: &Block, src: Source, out: &mut Batch) {
        self.found_variables(out);
        let (name, times, arguments) = self.handed_over(code, Some(code.at), block, src, out);
        if times > 1 && !self.settings.dialect.formula.arguments_again {
            let fault = Fault::not_supported(code.row.code.as_str(), CallUnsupported::MacroTimes);
            return self.fault(fault, block.span, out);
        }
        let Some(name) = name.filter(|name| *name > 0) else {
            if !self.now.failed {
                let word = char::from(code.row.words.bytes().next().unwrap_or(b'P')).to_string().into();
                self.fault(Fault::WordMissing { code: code.row.code.as_str().into(), word }, code.span, out);
            }
            return;
        };
        if self.level_open() {
            return self.refuse_level(code.span, out);
        }
        self.jumped_to(block, out);
        let name: Box<str> = name.to_string().into();
        if self.leaves_call_out(&name, block.span, out) {
            return;
        }
        out.whole = true;
        self.computes.calls(&name, arguments.len());
        let call = Call { name, times, arguments, shared: false };
        if code.meaning == Meaning::CallMacroAtMoves {
            return self.begin_calls_at_moves(code, call, block, out);
        }
        if code.meaning == Meaning::CallMacroAtBlocks {
            return self.begin_calls_at_blocks(code, call, block, out);
        }
        if self.within_modal(code.span, out) {
            return;
        }
        self.leave_motion(None, out);
        self.push(block.span, Op::Call(Box::new(call)), out);
        self.lose(block.span, out);
    }

    /// An argument: without a point it counts what the address counts.
    fn argument(&mut self, word: &Word, block: &Block, src: Source, out: &mut Batch) -> Option<Expr> {
        let plain = |num: Num| Expr::Num(Num { unit: Unit::One, ..num });
        match word.value {
            Value::Computed(place) => {
                let expr = &block.exprs[usize::from(place)];
                if has_round(expr) {
                    // To what is open: no address takes it.
                    return self.refuse(Fault::MacroLanguage { what: src.text(word.span) }, word.span, out);
                }
                Some(self.value(expr, word.span, out))
            }
            Value::Number(digits) if digits.point || digits.mantissa == 0 => {
                let Value::Number(digits) = word.value else { return None };
                let num =
                    Num { mantissa: digits.mantissa, scale: digits.scale, point: true, unit: Unit::One };
                Some(Expr::Num(num))
            }
            Value::Number(digits) if b"DHMST".contains(&word.letter) => {
                Some(Expr::Num(Num { mantissa: digits.mantissa, scale: 0, point: false, unit: Unit::One }))
            }
            Value::Number(_) if b"EF".contains(&word.letter) => {
                let what = CodeUnsupported::IncrementUnit;
                let fault = Fault::NotSupported { code: src.text(word.span), what: what.into() };
                self.refuse(fault, word.span, out)
            }
            Value::Number(_) => self.number(word, Quantity::Length, src, out).map(plain),
            Value::None => None,
        }
    }
}
