//! Variables of the control's own that a program sets: those by which it gives an alarm, or stops with a message. The
//! comment of the block is the text (16-C, custom macro, system variables, alarms: `#3000 = n (MESSAGE)`; B-63684EN,
//! stop with a message: `#3006 = 1 (MESSAGE)`).
//!
//! Which numbers they have is in the dictionary, `[[system]]`.

use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::program::{Alarm, Op, Text};
use ncc_ir::system::System;

use super::Source;
use super::block::Block;
use super::lower::{Lower, decode};
use crate::Batch;

impl Lower {
    /// What setting a variable of the control's own does; nothing is refused by name.
    pub(super) fn control_set(
        &mut self,
        to: &System,
        value: Expr,
        block: &Block,
        src: Source,
        out: &mut Batch,
    ) -> Vec<Op> {
        let name = to.to_string();
        let number: Option<u32> = name.strip_prefix('#').and_then(|number| number.parse().ok());
        let rows = &self.settings.dialect.system;
        let row = number.and_then(|number| rows.iter().find(|row| row.numbers().contains(&number)));
        match row.map(|row| &*row.means) {
            Some("alarm") => {
                let text = self.text_of(block, src, out).unwrap_or_default();
                vec![Op::Alarm(Box::new(Alarm { number: Some(value), text }))]
            }
            Some("stop") => {
                let text = self.text_of(block, src, out);
                text.map(Op::Message).into_iter().chain([Op::ProgramStop]).collect()
            }
            _ => {
                let told = row.and_then(|row| row.refuse.clone());
                let told = told.unwrap_or_else(|| "variable of the control's own that is set".into());
                let fault = Fault::NotSupported { code: name.into(), name: told.into() };
                self.fault(fault, block.span, out);
                Vec::new()
            }
        }
    }

    /// The text of an alarm or a stop: the comment of its block.
    fn text_of(&mut self, block: &Block, src: Source, out: &mut Batch) -> Option<Text> {
        match &block.comments[..] {
            [] => None,
            [one] => {
                self.now.message = true;
                Some(decode(src.bytes(*one)))
            }
            [_, more, ..] => {
                let code = src.text(*more);
                let name = "second comment in a block whose comment is a text for the operator".into();
                self.refuse(Fault::NotSupported { code, name }, *more, out)
            }
        }
    }
}
