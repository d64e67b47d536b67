//! The T and the H code active: those that the program has said last on every path, or, before it has said any, those
//! that the user states of its start, by the variables that a macro reads them with.
//!
//! ```text
//! G43 Z50.            the length entry of the last H
//! G10 L11 P#4120 R0.  the entry of the last T; with `#4120=2` stated, entry 2
//! ```
//!
//! A program that begins again with another of these than what was stated is refused. Not here: what a program asks of
//! the control while it runs; that is execution's.

use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::system::System;
use ncc_ir::source::Span;
use ncc_ir::unsupported::{MoveUnsupported, TableUnsupported};

use super::block_words::{Code, Words};
use super::lower::Lower;
use super::text_facts::AtStart;
use crate::batch::Batch;
use crate::common::known::Know;
use crate::common::words::Word;

const TOOL: usize = 0;
const ENTRY: usize = 1;

impl Lower {
    /// The program says a T code.
    pub(super) fn note_tool_code(&mut self, word: &Word) {
        let tool = word.to_whole();
        self.tools.at_start.says(TOOL, tool);
        self.state.modes.tool = Know::Said(tool);
    }

    /// The program says an H code.
    pub(super) fn note_length_code(&mut self, word: &Word) {
        let entry = word.to_whole();
        self.tools.at_start.says(ENTRY, entry);
        self.state.length_entry = entry.map_or(Know::Lost, Know::Said);
    }

    /// The T or H code that a variable of the control holds before the program has said one, as the user states it
    /// (reported).
    pub(super) fn stated_at_start(&mut self, asked: &System, at: Span, out: &mut Batch) -> Option<u32> {
        let which = match asked {
            System::SelectedTool if self.state.modes.tool == Know::Unsaid => TOOL,
            System::LengthEntry if self.state.length_entry == Know::Unsaid => ENTRY,
            _ => return None,
        };
        if !self.assume {
            return None;
        }
        let (_, stated) = self.settings.stated_of(asked)?;
        let stated = u32::try_from(stated).ok()?;
        self.tools.at_start.used[which] = Some(stated);
        let assumption = match which {
            TOOL => ControlFact::ToolCodeAtStart { letter: self.roles.tool.into(), number: stated },
            _ => ControlFact::LengthCodeAtStart { letter: self.roles.length_entry.into(), number: stated },
        };
        out.report(Fault::AssumedFact { fact: assumption }, at);
        Some(stated)
    }

    /// Applies a length by the entry that was named before: that of the last word.
    pub(super) fn length_as_before(&mut self, code: &Code, words: &Words, out: &mut Batch) {
        let letter = char::from(self.roles.length_entry);
        let code_text: Box<str> = code.row.code.as_str().into();
        let entry = match self.state.length_entry {
            Know::Said(entry) | Know::Taken(entry) => {
                if self.assume && self.first_time(code.row) {
                    let meaning = format!("LAST_ENTRY {letter}").into();
                    out.report(Fault::AssumedRow { code: code_text.clone(), meaning }, code.span);
                }
                Some(entry)
            }
            Know::Unsaid => self.stated_at_start(&System::LengthEntry, code.span, out),
            Know::Lost | Know::Open | Know::Callers => {
                let what = MoveUnsupported::EntryOfBefore { letter }.into();
                return self.fault(Fault::NotSupported { code: code_text, what }, code.span, out);
            }
        };
        let Some(entry) = entry else {
            let word = letter.to_string().into();
            return self.fault(Fault::WordMissing { code: code_text, word }, code.span, out);
        };
        self.use_entry(Expr::int(i64::from(entry)), code.span, words, out);
    }

    /// The end of the text: a program that begins again has active what it was stated to start with.
    pub(super) fn starts_again_alike(&mut self, out: &mut Batch) {
        let Some(at) = self.tools.at_start.begins_again else { return };
        let AtStart { used, said, several, .. } = self.tools.at_start;
        let other = |which: usize| {
            used[which].is_some() && (several[which] || said[which].is_some() && said[which] != used[which])
        };
        if other(TOOL) || other(ENTRY) {
            let what = TableUnsupported::SeveralStarts.into();
            self.fault(Fault::NotSupported { code: "M99".into(), what }, at, out);
        }
    }
}
