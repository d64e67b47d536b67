//! Lowering of words that round or chamfer the corner after a block's move.
//!
//! Not here: whether there is such a corner, which execution finds out.

use ncc_dialects::Quantity;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Num;
use ncc_ir::program::Op;
use ncc_ir::unsupported::MoveUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::common::words::Word;
use crate::word::block_words::Words;
use crate::word::lower::Lower;
use crate::word::word_state::AxisWords;

impl Lower {
    /// A word after a comma.
    pub(in crate::word) fn comma_word(&mut self, word: &Word, src: Source, out: &mut Batch) {
        let letter = char::from(word.letter.to_ascii_uppercase());
        let known = self.settings.dialect.corner.words().any(|(_, own)| own.comma && own.letter == letter);
        if !known {
            let what = match letter {
                'R' => MoveUnsupported::CommaRounding,
                'C' => MoveUnsupported::CommaChamfer,
                'A' => MoveUnsupported::CommaAngle,
                _ => MoveUnsupported::CommaWord,
            };
            self.now.refused = true;
            let code = src.text(word.span);
            return self.fault(Fault::NotSupported { code, what: what.into() }, word.span, out);
        }
        if let Some(other) = self.now.corner {
            let fault = Fault::CodesExclude { first: src.text(other.span), second: src.text(word.span) };
            self.now.failed = true;
            out.diagnostics.push(Diagnostic { fault, span: word.span, related: vec![other.span] });
        }
        self.now.corner = Some(*word);
    }

    /// The word of a corner, if the block has one: its move follows.
    pub(in crate::word) fn corner(&mut self, words: &mut Words, src: Source, out: &mut Batch) {
        let dialect = self.settings.dialect;
        let plain =
            || dialect.corner.words().find(|(_, word)| !word.comma).map(|(_, word)| word.letter as u8);
        let word = self.now.corner.take().or_else(|| words.take(plain()?));
        let Some(word) = word else { return };
        if matches!(self.state.words, AxisWords::Polar { .. }) {
            let what = MoveUnsupported::CornerPolar.into();
            let code = src.text(word.span);
            return self.fault(Fault::NotSupported { code, what }, word.span, out);
        }
        let Some(size) = self.amount(&word, Quantity::Length, words, src, out) else { return };
        // What is computed is positive where the control's word of a corner is: execution holds it to that.
        let (negative, nothing) = size.literal().map_or((false, false), |n| (n.mantissa < 0, n.is_zero()));
        let comma = word.letter.is_ascii_lowercase();
        let letter = char::from(word.letter.to_ascii_uppercase());
        let found = dialect
            .corner
            .words()
            .find(|(_, own)| own.letter == letter && own.comma == comma && own.negative == negative);
        match found {
            Some((shape, _)) if !nothing => {
                let size = match size {
                    Expr::Num(num) => Expr::Num(Num { mantissa: num.mantissa.abs(), ..num }),
                    computed @ Expr::Node(_) => computed,
                };
                self.push(word.span, Op::Corner { shape, size }, out);
            }
            Some(_) | None => {
                self.fault(Fault::OutOfRange { word: src.text(word.span).into() }, word.span, out)
            }
        }
    }

    /// A corner's word that no move has taken.
    pub(in crate::word) fn check_corner(&mut self, src: Source, out: &mut Batch) {
        if let Some(word) = self.now.corner.take() {
            self.fault(Fault::WordUnused { word: src.text(word.span) }, word.span, out);
        }
    }
}
