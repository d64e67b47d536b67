//! Lowering of calls and returns.
//!
//! After a call every fact is lost: the subprogram may have changed it.

use ncc_ir::diag::Fault;
use ncc_ir::program::{Call, Op};

use super::Source;
use super::facts::State;
use super::lower::Lower;
use super::sort::{Code, Words};
use crate::Batch;

/// Most calls by one word.
const MOST_TIMES: u32 = 9999;

impl Lower {
    /// A call: the first letter of the row's words names the program, the second says how often.
    pub(super) fn call(&mut self, code: &Code, words: &mut Words, src: Source, out: &mut Batch) {
        let mut letters = code.row.words.bytes();
        let program = letters.next().unwrap_or(b' ');
        let Some(word) = words.take(program) else {
            let (code_text, word) = (code.row.code.as_str().into(), char::from(program).to_string().into());
            return self.fault(Fault::WordMissing { code: code_text, word }, code.span, out);
        };
        let Some(mut number) = self.whole(&word, src, out) else {
            return;
        };
        let mut times = 1;
        if let Some(word) = letters.next().and_then(|l| words.take(l)) {
            match self.whole(&word, src, out) {
                Some(n) => times = n,
                None => return,
            }
        } else if let Some(packed) = 10u32.checked_pow(self.settings.dialect.program.packed_call_digits)
            && packed > 1
            && number >= packed
        {
            times = number / packed;
            number %= packed;
        }
        if number == 0 || times == 0 || times > MOST_TIMES {
            return self.fault(Fault::OutOfRange { word: src.text(word.span) }, word.span, out);
        }
        out.whole = true;
        let call = Call { name: number.to_string().into(), times, arguments: Vec::new() };
        self.push(code.span.to(word.span), Op::Call(Box::new(call)), out);
        self.state = State::lost();
    }

    /// A return to the caller.
    pub(super) fn return_from(&mut self, code: &Code, out: &mut Batch) {
        if self.sub.is_none() {
            let name = "return in the main program: endless repetition".into();
            let fault = Fault::NotSupported { code: code.row.code.as_str().into(), name };
            return self.fault(fault, code.span, out);
        }
        self.ended |= self.now.skip.is_none();
        self.push(code.span, Op::Return, out);
    }
}
