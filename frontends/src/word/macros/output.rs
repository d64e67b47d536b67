//! Text for the device that the control has for it: `POPEN`, `DPRNT[X#1[53]*Y#2[53]]`, `PCLOS` (96-8000 Rev AC,
//! macros, formatted output; NCT 2000M, page 193; 8520-GUM, chapter 20: a letter of A to Z, a digit or one of `+ - / *`
//! stands for itself, but `*` for a blank; after a variable, in brackets, how many places its value has before the
//! point and after it, which is rounded).
//!
//! Not here: `BPRNT`, which writes values as bits (refused).

use ncc_dialects::Statement as Says;
use ncc_ir::diag::Fault;
use ncc_ir::program::{Op, Output, Piece};
use ncc_ir::source::Span;
use ncc_ir::unsupported::TextUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::word::lower::Lower;
use crate::word::text::device_text::length;

impl Lower {
    /// Text for a device, with its values.
    pub(in crate::word) fn output(
        &mut self,
        output: Option<&Output>,
        span: Span,
        src: Source,
        out: &mut Batch,
    ) {
        let Some(mut output) = output.cloned() else { return self.leave_output_out(span, src, out) };
        let rules = &self.settings.dialect.formula;
        let (known, most) = (rules.statements.contains(&Says::Output), rules.output_digits);
        let mut fits = known;
        let before = (out.diagnostics.len(), self.now.failed);
        if let Output::Line(pieces) = &mut output {
            for piece in pieces {
                if let Piece::Value { value, digits, places, .. } = piece {
                    fits &= *digits + *places <= most;
                    *value = self.value(value, span, out);
                }
            }
        }
        if known && self.now.failed && !before.1 {
            // A value of the control that has no meaning here: of the text alone, which does not matter to the cut.
            out.diagnostics.truncate(before.0);
            self.now.failed = before.1;
            return self.leave_output_out(span, src, out);
        }
        if !fits {
            let what = if known { TextUnsupported::TooManyDigits } else { TextUnsupported::DeviceText };
            let fault = Fault::NotSupported { code: src.text(span), what: what.into() };
            return self.fault(fault, span, out);
        }
        // What is active may be asked.
        self.leave_motion(None, out);
        self.push(span, Op::Output(Box::new(output)), out);
    }

    /// Text for a device that no target is given: a comment of its words stays.
    fn leave_output_out(&mut self, span: Span, src: Source, out: &mut Batch) {
        let known = self.settings.dialect.formula.statements.contains(&Says::Output);
        if !known {
            let fault =
                Fault::NotSupported { code: src.text(span), what: TextUnsupported::DeviceText.into() };
            return self.fault(fault, span, out);
        }
        out.report(Fault::OutputDropped, span);
        let plain = |sign: char| if "()[]".contains(sign) { ' ' } else { sign };
        let all = src.bytes(span);
        let begins = all.iter().position(|b| b.eq_ignore_ascii_case(&b'D')).unwrap_or(0);
        let own = &all[begins..begins + length(&all[begins..]).unwrap_or(all.len() - begins)];
        let text: String = String::from_utf8_lossy(own).chars().map(plain).collect();
        self.push(span, Op::Comment(text.trim().into()), out);
    }
}
