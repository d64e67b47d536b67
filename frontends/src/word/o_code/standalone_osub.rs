//! A subprogram of O words that is a text of its own, read as the program that is called: LinuxCNC looks for a name that
//! the calling text does not have in a file of that name, in the folders of PROGRAM_PREFIX and SUBROUTINE_PATH, which
//! has `sub` and `endsub` in it and a single such subprogram (LinuxCNC 2.9, gcode/o-code.html, Calling Files).
//!
//! Not here: subprograms in the text that calls them (`o_subs`).

use ncc_dialects::{Dialect, Meaning};
use ncc_ir::computed::free_variables::free_variables;
use ncc_ir::expr::Var;
use ncc_ir::program::{Op, Procedure, Program};
use ncc_ir::unsupported::FlowUnsupported;

use super::o_state::StandaloneOsub;
use super::o_subs::refused;
use crate::batch::Batch;
use crate::common::Source;
use crate::word::reader::Reader;
use crate::word::text::token::FlowWord;

/// Whether a text is the subprogram by whose name its file is called, and nothing else: comments before and after, the
/// end of the program after it.
fn is_whole(text: &[u8], name: &str, dialect: &Dialect) -> bool {
    let mut lines = text.split(|b| *b == b'\n').map(bare).filter(|line| !line.is_empty() && line != "%");
    let is = |line: &str, word: &str| {
        let label = line.strip_prefix('o').and_then(|line| line.strip_suffix(word));
        let label =
            label.map(|own| own.strip_prefix('<').and_then(|own| own.strip_suffix('>')).unwrap_or(own));
        label.is_some_and(|own| match (own.parse::<u32>(), name.parse::<u32>()) {
            (Ok(own), Ok(name)) => own == name,
            _ => own == name,
        })
    };
    lines.next().is_some_and(|first| is(&first, "sub"))
        && lines.any(|line| is(&line, "endsub"))
        && lines.all(|line| is_end(&line, dialect))
}

/// Whether a line is the code that ends a program.
fn is_end(line: &str, dialect: &Dialect) -> bool {
    let number = line.strip_prefix('m').and_then(|number| number.parse::<u32>().ok());
    let row = number.and_then(|number| dialect.code_row(b'M', number.checked_mul(10)?));
    row.is_some_and(|row| row.means == Some(Meaning::ProgramEnd))
}

/// A line without comments and blanks, in small letters.
fn bare(line: &[u8]) -> String {
    let mut inside = false;
    let mut out = String::new();
    for b in line.iter().take_while(|b| **b != b';') {
        match b {
            b'(' => inside = true,
            b')' => inside = false,
            _ if inside || b.is_ascii_whitespace() => {}
            _ => out.push(b.to_ascii_lowercase().into()),
        }
    }
    out
}

impl Reader {
    /// The text is that of a file of this name.
    pub(crate) fn named(&mut self, file: &str) {
        if self.lower.settings.dialect.program.o_words {
            let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
            self.lower.o.standalone = StandaloneOsub::File(stem.to_ascii_lowercase().into());
        }
    }

    /// Looks whether a text that begins is the subprogram that its file is named by. What is longer than one piece of
    /// text is a program with a subprogram in it.
    pub(in crate::word) fn look_for_standalone_osub(&mut self, text: &[u8]) {
        if let StandaloneOsub::File(name) = &self.lower.o.standalone {
            let whole = is_whole(text, name, self.lower.settings.dialect);
            self.lower.o.standalone = if whole { StandaloneOsub::Looked } else { StandaloneOsub::No };
        }
    }

    /// The beginning of such a subprogram, if one is looked for: its body is that of the main procedure.
    pub(in crate::word) fn begin_standalone_osub(&mut self, name: &str, out: &mut Batch) -> bool {
        if self.lower.o.standalone != StandaloneOsub::Looked || self.frame.blocks || self.lower.ended {
            return false;
        }
        self.lower.o.standalone = StandaloneOsub::Open(name.into());
        // Its numbers are its arguments, and zeros after them.
        self.lower.o.given.numbered = true;
        self.frame.blocks = true;
        (out.subprogram, out.whole) = (true, true);
        true
    }

    /// Whether a block after such a subprogram is the end of its file, which its caller never reaches.
    pub(in crate::word) fn ends_the_file(&self, src: Source) -> bool {
        self.lower.o.standalone == StandaloneOsub::Over
            && is_end(&bare(src.bytes(self.block.span)), self.lower.settings.dialect)
    }

    /// Its end.
    pub(in crate::word) fn end_standalone_osub(&mut self, name: &str, out: &mut Batch) -> bool {
        if !self.lower.o.standalone.is(name) {
            return false;
        }
        let span = self.block.span;
        let mut values = self.block.decision.as_deref().map(|own| own.values.clone()).unwrap_or_default();
        if values.len() > 1 || !self.lower.o.open.is_empty() {
            self.sub_fault(refused(name, FlowWord::EndSub, FlowUnsupported::EndWithinElse), span, out);
            return true;
        }
        self.lower.now = crate::word::lower::Now::at(self.lower.target(out).len());
        values.iter_mut().for_each(|value| self.lower.parameters(value, span, out));
        self.lower.results(values.first(), span, out);
        self.lower.leave_motion(None, out);
        self.lower.push(span, Op::Return, out);
        self.frame.faulty |= self.lower.now.failed;
        self.lower.o.standalone = StandaloneOsub::Over;
        self.lower.ended = true;
        let body = std::mem::take(&mut out.stmts);
        let whole =
            Program { procedures: vec![Procedure { body, ..Procedure::default() }], ..Program::default() };
        let number = |var: &Var| var.name().parse().ok().filter(|_| matches!(var, Var::Local(_)));
        let most: u32 = free_variables(&whole).iter().filter_map(|(var, _)| number(var)).max().unwrap_or(0);
        out.stmts = whole.procedures.into_iter().next().map(|main| main.body).unwrap_or_default();
        let parameters = (1..=most).map(|n| Var::Local(n.to_string().into())).collect();
        let heading = Procedure { name: name.into(), parameters, ..Procedure::default() };
        out.heading = Some(Box::new(heading));
        true
    }
}
