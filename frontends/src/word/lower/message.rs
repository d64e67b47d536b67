//! Comments that are messages.

use ncc_ir::diag::Fault;
use ncc_ir::program::Op;
use ncc_ir::source::Span;
use ncc_ir::unsupported::TextUnsupported;

use super::super::text::block::Block;
use super::Lower;
use crate::batch::Batch;
use crate::common::Source;
use crate::common::text::{begins, decode};

impl Lower {
    /// The last comment of a block may be a message, which comes before all that the block does, or
    /// something else that acts.
    pub(super) fn message(&mut self, block: &Block, src: Source, out: &mut Batch) {
        let rules = &self.settings.dialect.comment;
        let Some(&span) = block.comments.last().filter(|_| !rules.message.is_empty()) else { return };
        let bracketed = src.bytes(Span::new(span.end, span.end + 1)) == rules.close.as_bytes();
        let bytes = src.bytes(span);
        if !bracketed {
            return;
        }
        if let Some(at) = begins(bytes, &rules.message) {
            let text = decode(&bytes[at..]);
            self.now.message = true;
            return self.push(span, Op::Message(text), out);
        }
        if let Some((name, at)) = rules.shown.iter().find_map(|name| Some((name, begins(bytes, name)?))) {
            if bytes.contains(&b'#') && self.settings.dialect.program.o_words {
                self.now.message = true;
                return self.operator_text(&bytes[at..], span, out);
            }
            if bytes.contains(&b'#') {
                let code = format!("{}{name}", rules.open).into();
                let what = TextUnsupported::ParameterInMessage.into();
                return self.fault(Fault::NotSupported { code, what }, span, out);
            }
            let text = decode(&bytes[at..]);
            self.now.message = true;
            return self.push(span, Op::Message(text), out);
        }
        if let Some(at) = begins(bytes, &rules.alarm).filter(|_| !rules.alarm.is_empty()) {
            self.now.message = true;
            return self.alarm(&bytes[at..], span, out);
        }
        if rules.logs.iter().any(|name| begins(bytes, name).is_some()) {
            out.report(Fault::OutputDropped, span);
        }
        if let Some(name) = rules.active.iter().find(|name| begins(bytes, name).is_some()) {
            let code = format!("{}{name}", rules.open).into();
            self.fault(Fault::NotSupported { code, what: TextUnsupported::ActiveComment.into() }, span, out);
        }
    }
}
