//! Lowering of calls and returns.
//!
//! After a call every fact is lost: the subprogram may have changed it.

use ncc_dialects::Statement;
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::Fault;
use ncc_ir::program::{Call, Op, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::unsupported::CallUnsupported;
use ncc_ir::unsupported::left_out::LeftOut;

use crate::batch::Batch;
use crate::common::Source;
use crate::common::words::{Value, Word};
use crate::word::block_words::{Code, Words};
use crate::word::lower::Lower;
use crate::word::text::block::Block;
use crate::word::text::frame::Called;

/// Most calls by one word.
const MOST_TIMES: u32 = 9999;

impl Lower {
    /// A call: the first letter of the row's words names the program, the second the repeat count.
    pub(in crate::word) fn call(&mut self, code: &Code, words: &mut Words, src: Source, out: &mut Batch) {
        let mut letters = code.row.words.bytes();
        let program = letters.next().unwrap_or(b' ');
        if words.get(program).is_none()
            && let Some((name, span)) = self.now.name.take()
        {
            let times = match letters.next().and_then(|l| words.take(l)) {
                Some(word) => self.read_whole(&word, src, out),
                None => Some(1),
            };
            let (Some(times), Some(called)) = (times, Called::parse(name.as_bytes())) else {
                return self.fault(Fault::OutOfRange { word: name.into() }, span, out);
            };
            return self.call_program(called.text(), times, code.span.to(span), span, out);
        }
        let Some(word) = words.take(program) else {
            // Where no program is named, blocks of this one may be.
            if let Some(block) = code.row.blocks.bytes().find_map(|letter| words.take(letter)) {
                let count = letters.next().and_then(|letter| words.take(letter));
                return self.local_call(code, &block, count.as_ref(), words, src, out);
            }
            let (code_text, word) = (code.row.code.as_str().into(), char::from(program).to_string().into());
            return self.fault(Fault::WordMissing { code: code_text, word }, code.span, out);
        };
        let count = letters.next().and_then(|letter| words.take(letter));
        if code.row.blocks.as_bytes().contains(&program) {
            return self.local_call(code, &word, count.as_ref(), words, src, out);
        }
        let computed = |word: &Word| matches!(word.value, Value::Computed(_));
        let says = self.settings.dialect.formula.statements.contains(&Statement::CallOf);
        if says && (computed(&word) || count.as_ref().is_some_and(computed)) {
            return self.computed_call(code, &word, count.as_ref(), words, src, out);
        }
        let Some(mut number) = self.read_whole(&word, src, out) else {
            return;
        };
        let mut times = 1;
        if let Some(word) = count {
            match self.read_whole(&word, src, out) {
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
        if number == 0 {
            return self.fault(Fault::OutOfRange { word: src.text(word.span).into() }, word.span, out);
        }
        if times == 0 || times > MOST_TIMES {
            return self.fault(Fault::OutOfRange { word: src.text(word.span).into() }, word.span, out);
        }
        self.call_program(number.to_string().into(), times, code.span.to(word.span), word.span, out);
    }

    fn call_program(&mut self, name: Text, times: u32, block: Span, word: Span, out: &mut Batch) {
        if self.leaves_call_out(&name, block, out) || self.within_modal(block, out) {
            return;
        }
        if times == 0 || times > MOST_TIMES {
            return self.fault(Fault::OutOfRange { word: name.into() }, word, out);
        }
        out.whole = true;
        self.centre_said_elsewhere(out);
        let shared = self.shares();
        let main = self.sub.is_none();
        self.o.subs.calls_numbered(name.clone(), block, main);
        self.leave_motion(None, out);
        self.push(block, Op::Call(Box::new(Call { name, times, arguments: Vec::new(), shared })), out);
        self.lose_state(out);
    }

    /// Whether a call is left out, as the user states of the program that it names; reported once for each.
    pub(in crate::word) fn leaves_call_out(&mut self, name: &str, at: Span, out: &mut Batch) -> bool {
        let names = &self.settings.dialect.program.calls_left_out;
        let Some(place) = names.iter().position(|own| own == name) else { return false };
        if self.reported.calls_left_out.insert(place) {
            out.report(Fault::CodeLeftOut { what: LeftOut::Call { name: name.into() } }, at);
        }
        true
    }

    /// Whether a block is left out that calls a program by a code of the machine, as the user states of the code.
    pub(in crate::word) fn leaves_coded_call_out(&mut self, block: &Block, out: &mut Batch) -> bool {
        let names = &self.settings.dialect.program.calls_left_out;
        if names.is_empty() {
            return false;
        }
        let named = |word: &Word, name: &str| {
            let Value::Number(digits) = word.value else { return false };
            let number = name.strip_prefix(char::from(word.letter)).and_then(|number| number.parse().ok());
            matches!(word.letter, b'G' | b'M') && digits.scale == 0 && number == Some(digits.mantissa)
        };
        let mut words = block.words.iter();
        let found = words.find_map(|word| Some((word, names.iter().find(|name| named(word, name))?)));
        let found = found.map(|(word, name)| (word.span, name.clone()));
        found.is_some_and(|(at, name)| self.leaves_call_out(&name, at, out))
    }

    /// The end of the main program's text: what returns does not end by itself as well.
    pub(in crate::word) fn settle_main_ending(&mut self, out: &mut Batch) {
        self.callers_feed(out);
        if let Some(at) = self.main_ending.returns {
            self.settle_endless_main(at, out);
        }
        self.starts_again_alike(out);
    }

    fn settle_endless_main(&mut self, at: Span, out: &mut Batch) {
        if self.main_ending.ends {
            if out.subprogram {
                self.began_again(at, out);
            }
        } else if let Some(begins) = self.main_ending.begins_again {
            self.endless(begins, "M99".into(), out);
        } else if self.assume {
            let assumption = ControlFact::ReturnsToCaller { code: "M99" };
            out.report(Fault::AssumedFact { fact: assumption }, at);
        }
    }

    /// A feed that the text has not stated is that of its caller, if it has one.
    fn callers_feed(&mut self, out: &mut Batch) {
        match self.main_ending.feed.take() {
            Some(at) if !out.subprogram || self.main_ending.ends => out.report(Fault::NoFeed, at),
            Some(at) if self.assume => {
                out.report(Fault::AssumedFact { fact: ControlFact::CallersFeed }, at);
            }
            _ => {}
        }
    }

    /// Blocks stand after the return of a text that has no end of its own before: it is a main program.
    pub(in crate::word) fn goes_on_behind_return(&mut self, out: &mut Batch) {
        if let Some(at) = self.main_ending.returns.take_if(|_| self.sub.is_none()) {
            self.began_again(at, out);
        }
    }

    pub(in crate::word) fn endless(&mut self, at: Span, code: Box<str>, out: &mut Batch) {
        let what = CallUnsupported::MainReturn.into();
        self.fault(Fault::NotSupported { code, what }, at, out);
    }

    /// What was taken for the return of a subprogram has the main program begin again.
    fn began_again(&mut self, at: Span, out: &mut Batch) {
        if !self.settings.dialect.program.begins_again {
            return self.endless(at, "M99".into(), out);
        }
        self.tools.at_start.note_begin_again(at);
        out.subprogram = false;
        begin_again_there(&mut out.stmts);
    }

    /// The main program begins again, for ever: its end, after which nothing is reset.
    pub(in crate::word) fn begin_again(&mut self, code: &Code, out: &mut Batch) {
        let name = code.row.code.as_str();
        if self.sub.is_some() {
            let what = CallUnsupported::BeginAgainInSub.into();
            return self.fault(
                Fault::NotSupported { code: code.row.code.as_str().into(), what },
                code.span,
                out,
            );
        }
        if self.within_modal(code.span, out) {
            return;
        }
        if name == "M99" && !self.settings.dialect.program.begins_again {
            return self.endless(code.span, name.into(), out);
        }
        self.main_ending.begins_again.get_or_insert(code.span);
        self.tools.at_start.note_begin_again(code.span);
        self.ended |= self.now.skip.is_none();
        self.leave_motion(None, out);
        self.tap_elsewhere(out);
        self.push(code.span, Op::BeginAgain, out);
    }

    /// Whether a return at hand returns to a caller, as far as the text has been read.
    pub(in crate::word) fn may_go_back(&self) -> bool {
        let alone = self.settings.dialect.program.macro_b && self.now.skip.is_none();
        self.sub.is_some() || self.returns_from_blocks() || alone && !self.main_ending.ends
    }

    /// A return to the caller. A text that ends by it and by nothing else is a standalone subprogram; run by
    /// itself, the control would begin again (16-C, subprogram control: M99 in a main program).
    pub(in crate::word) fn return_from(&mut self, code: &Code, out: &mut Batch) {
        if self.sub.is_none() && !self.returns_from_blocks() {
            if !self.may_go_back() {
                return self.begin_again(code, out);
            }
            self.main_ending.returns.get_or_insert(code.span);
            (out.subprogram, out.whole) = (true, true);
        }
        if self.in_o_sub() {
            let what = CallUnsupported::NumberedInOSub.into();
            let fault = Fault::NotSupported { code: code.row.code.as_str().into(), what };
            return self.fault(fault, code.span, out);
        }
        if self.within_modal(code.span, out) {
            return;
        }
        self.ended |= self.now.skip.is_none();
        self.leave_motion(None, out);
        self.tap_elsewhere(out);
        self.push(code.span, Op::Return, out);
    }
}

fn begin_again_there(stmts: &mut [Stmt]) {
    for stmt in stmts {
        match &mut stmt.op {
            Op::Return => stmt.op = Op::BeginAgain,
            Op::Control(control) => control.bodies_mut().for_each(|body| begin_again_there(body)),
            _ => {}
        }
    }
}
