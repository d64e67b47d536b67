//! Returns to a block of the caller (16-C, subprogram control: with P in the block of M99, the caller goes on at the
//! block of that number): a jump behind each call.
//!
//! They are made when the text has been read. Refused by name: a subprogram that goes back in more than one way, one
//! that is called several times by one word or not in this text, such a return that can be skipped, and one beside calls
//! of a computed number.

use ncc_ir::diag::Fault;
use ncc_ir::program::{Op, Procedure, Stmt, Text};
use ncc_ir::source::Span;

use super::Source;
use super::computing::{Computes, label};
use super::lower::Lower;
use super::sort::{Code, Words};
use crate::Batch;

/// A return, the subprogram that it stands in, and the block of the caller that it names.
#[derive(Clone, Debug)]
pub(super) struct ReturnTo {
    own: Text,
    block: Option<u32>,
    at: Span,
}

/// Whether a text has a return that names a block.
pub(super) fn has_returns_to(text: &[u8]) -> bool {
    memchr::memmem::find_iter(text, b"99").any(|at| {
        let begins = at > 0 && text[at - 1].eq_ignore_ascii_case(&b'M');
        let behind = text[at + 2..].iter().find(|b| **b != b' ');
        begins && behind.is_some_and(|b| b.eq_ignore_ascii_case(&b'P'))
    })
}

impl Lower {
    /// Takes the block that a return names, if it does; `false` if it cannot be (reported).
    pub(super) fn notes_return(
        &mut self,
        code: &Code,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) -> bool {
        let Some(sub) = &self.sub else { return true };
        let own = sub.name.clone();
        let letter = code.row.blocks.bytes().next();
        let block = match letter.and_then(|letter| words.take(letter)) {
            None => None,
            Some(word) => match self.whole(&word, src, out) {
                Some(number) if self.now.skip.is_none() => Some(number),
                Some(_) => {
                    self.not_one_way(code.span, out);
                    return false;
                }
                None => return false,
            },
        };
        self.computes.returns.push(ReturnTo { own, block, at: code.span });
        true
    }

    fn not_one_way(&mut self, at: Span, out: &mut Batch) {
        let fault = Fault::NotSupported { code: "M99".into(), name: SEVERAL.into() };
        self.fault(fault, at, out);
    }
}

const SEVERAL: &str = "return to a block of the caller, of a subprogram that may go back in another way";

const COMPUTED: &str = "return to a block of the caller, beside calls of a number that is computed";

const ELSEWHERE: &str = "return to a block of a caller that is not in the text";

impl Computes {
    /// The text is over: what calls a subprogram that goes back to a block goes on there.
    pub(super) fn join_returns(&self, out: &mut Batch) {
        let mut to: Vec<(&Text, u32)> = Vec::new();
        for return_to in &self.returns {
            let Some(block) = return_to.block else { continue };
            let mut all = self.returns.iter().filter(|other| other.own == return_to.own);
            let why = match () {
                () if all.any(|other| other.block != Some(block)) => Some(SEVERAL),
                () if self.calls_of => Some(COMPUTED),
                () if !is_called(out, &return_to.own) => Some(ELSEWHERE),
                () => None,
            };
            if let Some(name) = why {
                out.report(Fault::NotSupported { code: "M99".into(), name: name.into() }, return_to.at);
            } else if !to.contains(&(&return_to.own, block)) {
                to.push((&return_to.own, block));
            }
        }
        if to.is_empty() {
            return;
        }
        let mut several = Vec::new();
        join(&mut out.stmts, &to, &mut several);
        let bodies = out.procedures.iter_mut().map(|Procedure { body, .. }| body);
        bodies.for_each(|body| join(body, &to, &mut several));
        for at in several {
            let name = "several calls by one word of a subprogram that goes back to a block".into();
            out.report(Fault::NotSupported { code: "L".into(), name }, at);
        }
    }
}

fn is_called(out: &Batch, name: &Text) -> bool {
    fn calls(body: &[Stmt], name: &Text) -> bool {
        body.iter().any(|stmt| match &stmt.op {
            Op::Call(call) => call.name == *name,
            Op::Control(control) => control.bodies().any(|body| calls(body, name)),
            _ => false,
        })
    }
    calls(&out.stmts, name) || out.procedures.iter().any(|procedure| calls(&procedure.body, name))
}

fn join(body: &mut Vec<Stmt>, to: &[(&Text, u32)], several: &mut Vec<Span>) {
    let mut at = 0;
    while at < body.len() {
        if let Op::Control(control) = &mut body[at].op {
            control.bodies_mut().for_each(|body| join(body, to, several));
        }
        if let Op::Call(call) = &body[at].op
            && let Some((_, block)) = to.iter().find(|(name, _)| **name == call.name)
        {
            if call.times > 1 {
                several.push(body[at].span);
            }
            let mut goes = Stmt::new(body[at].span, Op::Goto(label(*block)));
            goes.skip = body[at].skip;
            body.insert(at + 1, goes);
            at += 1;
        }
        at += 1;
    }
}
