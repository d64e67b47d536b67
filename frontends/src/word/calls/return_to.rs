//! Returns to a block of the caller (16-C, subprogram control: with P in the block of M99, the caller goes on at the
//! block of that number): a jump after each call. Where the dictionary says so (`returns_within`), such a code is a
//! jump to that block of its own program instead, the main one too, and returns nowhere.
//!
//! They are made when the text has been read. Refused: a subprogram that returns in more than one way, one
//! that is called several times by one word or not in this text, such a return under block skip, and one beside calls
//! of a computed number.

use ncc_dialects::{Dialect, Meaning};
use ncc_ir::diag::Fault;
use ncc_ir::program::{Op, Procedure, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::unsupported::CallUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::word::block_words::{Code, Words};
use crate::word::lower::Lower;
use crate::word::macros::computes::{Computes, ReturnTo, label};

/// Whether a text has a return that names a block: a code of that meaning, and after it a letter that its row has.
pub(in crate::word) fn has_returns_to(text: &[u8], dialect: &Dialect) -> bool {
    let mut rows =
        dialect.code.iter().filter(|row| row.means == Some(Meaning::Return) && !row.blocks.is_empty());
    rows.any(|row| {
        let (code, letters) = (row.code.as_bytes(), row.blocks.as_bytes());
        memchr::memmem::find_iter(text, &code[1..]).any(|at| {
            let begins = at > 0 && text[at - 1].eq_ignore_ascii_case(&code[0]);
            let behind = text[at + code.len() - 1..].iter().find(|b| **b != b' ');
            begins && behind.is_some_and(|b| letters.contains(&b.to_ascii_uppercase()))
        })
    })
}

impl Lower {
    /// A return that names a block of its own program: a jump there; `false` if it is none.
    pub(in crate::word) fn goes_on_within(
        &mut self,
        code: &Code,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) -> bool {
        let letter = code.row.blocks.bytes().next().filter(|_| self.settings.dialect.program.returns_within);
        let Some(word) = letter.and_then(|letter| words.take(letter)) else { return false };
        if let Some(number) = self.read_whole(&word, src, out)
            && self.jumps_from(&code.row.code, Some(number), code.span, out)
        {
            self.push(code.span.to(word.span), Op::Goto(label(number)), out);
        }
        true
    }

    /// Takes the block that a return names, if it does; `false` if it cannot be (reported).
    pub(in crate::word) fn notes_return(
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
            Some(word) => match self.read_whole(&word, src, out) {
                Some(number) if self.now.skip.is_none() => Some(number),
                Some(_) => {
                    self.fault(refused(&code.row.code, SEVERAL), code.span, out);
                    return false;
                }
                None => return false,
            },
        };
        self.computes.returns.push(ReturnTo { own, block, code: &code.row.code, at: code.span });
        true
    }
}

const SEVERAL: CallUnsupported = CallUnsupported::ReturnSeveral;

const AGAIN: CallUnsupported = CallUnsupported::ReturnAgain;

const COMPUTED: CallUnsupported = CallUnsupported::ReturnComputed;

const ELSEWHERE: CallUnsupported = CallUnsupported::ReturnElsewhere;

impl Computes {
    /// The text is over: what calls a subprogram that returns to a block goes on there.
    pub(in crate::word) fn join_returns(&self, out: &mut Batch) {
        let mut to: Vec<(&Text, u32)> = Vec::new();
        for return_to in &self.returns {
            let Some(block) = return_to.block else { continue };
            let mut all = self.returns.iter().filter(|other| other.own == return_to.own);
            let what = if all.any(|other| other.block != Some(block)) {
                SEVERAL
            } else if self.calls_of {
                COMPUTED
            } else if is_called(out, &return_to.own) {
                to.push((&return_to.own, block));
                continue;
            } else {
                ELSEWHERE
            };
            out.report(refused(return_to.code, what), return_to.at);
        }
        if to.is_empty() {
            return;
        }
        let mut several = Vec::new();
        join(&mut out.stmts, &to, &mut several);
        let bodies = out.procedures.iter_mut().map(|Procedure { body, .. }| body);
        bodies.for_each(|body| join(body, &to, &mut several));
        let code = self.returns.first().map_or("", |first| first.code);
        several.into_iter().for_each(|at| out.report(refused(code, AGAIN), at));
    }
}

fn refused(code: &str, what: CallUnsupported) -> Fault {
    Fault::not_supported(code, what)
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
