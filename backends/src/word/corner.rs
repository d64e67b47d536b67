//! The word that rounds or chamfers the corner after a move. It stands in the block of that move.

use ncc_ir::canon::CornerShape;
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Num;
use ncc_ir::lack::{CornersLack, WordsLack};
use ncc_ir::source::Span;

use super::Writer;
use crate::common::codes::Letter;
use crate::common::fault::cannot;
use crate::common::{Sink, number};

impl Writer {
    /// Makes the word; the move that follows takes it into its block.
    pub(crate) fn ask_corner(
        &mut self,
        shape: CornerShape,
        size: &Expr,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let none = || cannot(CornersLack::Corner);
        let word = self.dialect.corner.word(shape).ok_or_else(none)?;
        let axis = self.words.codes.axes[0].ok_or_else(none)?;
        let n = size.literal().ok_or_else(|| cannot(WordsLack::ComputedValue))?;
        let sign = if word.negative { -1 } else { 1 };
        let n = Num { mantissa: n.mantissa * sign, ..n };
        let letter = Letter { letter: word.letter as u8, format: axis.format };
        let value = self.words.number(&letter, &Expr::Num(n), span, sink)?;
        let mut text = Vec::new();
        number::append(&mut text, value);
        let comma = if word.comma { "," } else { "" };
        self.words.corner = Some(format!("{comma}{}{}", word.letter, String::from_utf8_lossy(&text)));
        let unsure = self.dialect.address_row(word.letter as u8).is_some_and(|row| !row.sure && !word.comma);
        if unsure && !std::mem::replace(&mut self.told_corner, true) {
            let (code, meaning) = (word.letter.to_string().into(), "CORNER".into());
            sink.report(Fault::AssumedRow { code, meaning }, span);
        }
        Ok(())
    }
}
