//! Lowering of O words: settings of parameters, and blocks that decide where a program goes (LinuxCNC 2.9,
//! gcode/o-code.html; what it leaves open, from interp_o_word.cc).
//!
//! Loops and branches are structures, closed by a block with the same label. A label serves once in its program.
//! At a jump target every fact is lost, as after a call. Refused is what the control does
//! otherwise than its documentation says: a loop of `do` in a text where a loop of `while` is left by `break` (the
//! mark of a break stays set), a return out of `repeat` (the count stays).
//!
//! Not here: what parameters and expressions are (`parameters`), and subprograms as such (`o_subs`).

mod bodies;

use ncc_ir::diag::Fault;
use ncc_ir::expr::system::System;
use ncc_ir::expr::{Expr, Function, Node, Target, Unary, Var};
use ncc_ir::program::{Control, Op, Text};
use ncc_ir::source::Span;
use ncc_ir::unsupported::{FlowUnsupported, ValueUnsupported};

use super::o_formula::constant;
use super::o_state::{OpenStructure, Outer, StructureKind, StructurePaths};
use super::parameters::{Named, asks, numbers};
use super::statements::{Decision, Setting, label_text, spelled};
use crate::batch::Batch;
use crate::word::lower::Lower;
use crate::word::macros::formula::Index;
use crate::word::text::block::Block;
use crate::word::text::token::FlowWord;

/// Whether it is where the last move ended.
fn is_end(system: &System) -> bool {
    matches!(system, System::EndPoint(_))
}

/// Whether it is where a work offset lies.
fn is_zero(system: &System) -> bool {
    matches!(system, System::WorkOffset { .. } | System::ExternalOffset(_))
}

impl Lower {
    /// Looks through text that is to be read for parameters and branches: from there on it is kept whole.
    pub(in crate::word) fn o_look_ahead(&mut self, text: &[u8], out: &mut Batch) {
        let letter = self.settings.dialect.program.number.map_or(0, |c| c as u8);
        let decides = |line: &[u8]| {
            let line = line.trim_ascii_start();
            let line = line.strip_prefix(b"/").unwrap_or(line).trim_ascii_start();
            let line = match line {
                [b'N' | b'n', rest @ ..] => {
                    let digits = rest.iter().take_while(|b| b.is_ascii_digit() || b.is_ascii_whitespace());
                    &rest[digits.count()..]
                }
                line => line,
            };
            let [first, rest @ ..] = line else { return false };
            let rest = rest.trim_ascii_start();
            let name = rest.iter().take_while(|b| b.is_ascii_digit()).count();
            let behind = rest[name..].trim_ascii_start().first();
            // A number alone begins a program.
            first.eq_ignore_ascii_case(&letter)
                && behind.is_some_and(|b| !matches!(b, b'(' | b';') || name == 0)
        };
        let found = memchr::memchr(b'#', text).is_some() || text.split(|b| *b == b'\n').any(decides);
        if found || self.computes_anything() {
            out.whole = true;
            self.found_variables(out);
        }
    }

    /// A block begins: the body of what was opened before it does so here.
    pub(in crate::word) fn o_body(&mut self, out: &mut Batch) {
        if self.o.open.last().is_some_and(|open| open.at.is_none()) {
            let at = self.target(out).len();
            if let Some(open) = self.o.open.last_mut() {
                open.at = Some(at);
            }
        }
    }

    /// The comment of a block that sets parameters is a statement of its own: it is shown when they are set.
    pub(in crate::word) fn o_comment(&mut self, block: &Block, src: crate::common::Source, out: &mut Batch) {
        if block.settings.is_empty() || self.now.failed {
            return;
        }
        self.now.commented = true;
        if let Some(text) = self.plain_comment(block, src) {
            self.push(block.span, Op::Comment(text), out);
        }
    }

    /// The settings of a block. They count when the words of the block have been read, which have the values
    /// before them, as the settings have among themselves; a message has those after them. `words` is whether the
    /// words have been stated.
    pub(in crate::word) fn settings(&mut self, block: &Block, words: bool, out: &mut Batch) {
        if block.settings.is_empty() || self.now.failed {
            return;
        }
        let read = block.exprs.iter().any(|expr| block.settings.iter().any(|set| meets(expr, &set.to)));
        if read != words {
            return;
        }
        let refuse = |lower: &mut Lower, what: ValueUnsupported, out: &mut Batch| {
            let fault = Fault::not_supported("#", what);
            lower.fault(fault, block.span, out);
        };
        if read && self.now.message && !block.comments.is_empty() {
            return refuse(self, ValueUnsupported::SettingWithMessage, out);
        }
        // Of two that set one parameter, the later one counts.
        let mut left: Vec<&Setting> = Vec::new();
        for set in &block.settings {
            left.retain(|other| other.to != set.to);
            left.push(set);
        }
        let mut made = Vec::new();
        while !left.is_empty() {
            // First what no other one reads any more.
            let free = left.iter().position(|set| {
                left.iter().all(|other| std::ptr::eq(*other, *set) || !meets(&other.value, &set.to))
            });
            let Some(free) = free else {
                return refuse(self, ValueUnsupported::SettingsCircular, out);
            };
            made.push(left.remove(free));
        }
        let alone = made.len() == 1 && block.words.is_empty();
        for set in made {
            if let Some(op) = self.parameter_by_number(set, alone, out) {
                if let Expr::Node(node) = &set.to
                    && let Node::Var(var) = &**node
                    && self.now.skip.is_none()
                    && let Some(Named::Var(var)) = self.named(&var.name(), set.span, out)
                {
                    self.o.given.set(&var);
                }
                self.assigned(None, set.span, out);
                self.push(set.span, op, out);
                continue;
            }
            if self.now.failed {
                return;
            }
            let mut value = set.value.clone();
            self.parameters(&mut value, set.span, out);
            if read && asks(&value).is_some() {
                return refuse(self, ValueUnsupported::SettingOfControl, out);
            }
            let Some(to) = self.target_of(&set.to, set.span, out) else { continue };
            if let Target::Var(var) = &to
                && self.now.skip.is_none()
            {
                self.o.given.set(var);
            }
            self.saves(&to, &value);
            self.assigned(None, set.span, out);
            self.push(set.span, Op::Assign(to, value), out);
        }
    }

    /// What is set; `None` is refused (reported).
    pub(in crate::word) fn target_of(&mut self, to: &Expr, at: Span, out: &mut Batch) -> Option<Target> {
        let Expr::Node(node) = to else { return None };
        match &**node {
            Node::Element(element) => {
                self.no_place_here(element, at, out);
                let mut element = element.clone();
                element.of = ncc_ir::expr::Many::Numbered(numbers());
                for index in &mut element.at {
                    self.parameters(index, at, out);
                    let digits = Expr::int(super::parameters::WHOLE_DIGITS);
                    let whole = std::mem::replace(index, Expr::int(0));
                    *index = Expr::Node(Box::new(Node::Call(Function::RoundTo, vec![whole, digits])));
                }
                Some(Target::Element(Box::new(element)))
            }
            Node::Var(var) => {
                let name = var.name().into_owned();
                match self.named(&name, at, out)? {
                    Named::Var(Var::Common(word)) if matches!(&*word, "_value" | "_value_returned") => {
                        let fault = Fault::NotSupported {
                            code: name.into(),
                            what: ValueUnsupported::SetResult.into(),
                        };
                        self.refuse(fault, at, out)
                    }
                    Named::Var(var) => Some(Target::Var(var)),
                    Named::Value(_) => {
                        let what = ValueUnsupported::SetControl.into();
                        self.refuse(Fault::NotSupported { code: name.into(), what }, at, out)
                    }
                }
            }
            Node::Vacant | Node::Unary(..) | Node::Binary(..) | Node::Call(..) => None,
        }
    }

    /// All words of a block are read before anything of it happens: what it asks of the control must not have been
    /// changed by what comes before in it.
    pub(in crate::word) fn asked_in_time(&mut self, block: &Block, out: &mut Batch) {
        if self.now.failed || (block.exprs.is_empty() && block.settings.is_empty()) {
            return;
        }
        let mark = self.now.mark;
        let (mut changed, mut moved, mut set) = (false, false, false);
        let mut late = None;
        for stmt in self.target(out).iter_mut().skip(mark) {
            // Whether it is asked where the last move ended; where work offsets lie; and anything else.
            let (mut end, mut zero, mut other) = (false, false, false);
            let mut look = |expr: &Expr| {
                let asks = |of: fn(&System) -> bool| {
                    expr.has(&|node| matches!(node, Node::Var(Var::System(system)) if of(system)))
                };
                end |= asks(is_end);
                zero |= asks(is_zero);
                other |= asks(|system| !is_end(system) && !is_zero(system));
            };
            let seen = ncc_ir::program::arguments::each(&mut stmt.op, &mut |argument, _| {
                argument.expr().into_iter().for_each(&mut look);
                Ok::<(), std::convert::Infallible>(())
            });
            seen.unwrap_or_else(|never| match never {});
            if let Op::Assign(_, value) = &stmt.op {
                look(value);
            }
            if end && moved || other && changed || zero && set {
                late = Some(stmt.span);
            }
            let says_nothing = matches!(
                stmt.op,
                Op::Assign(..) | Op::Message(_) | Op::MessageOf(_) | Op::Comment(_) | Op::SelectTool(_)
            );
            changed |= !says_nothing;
            let stays = matches!(
                stmt.op,
                Op::SetFeedRate(_)
                    | Op::SetFeedMode(_)
                    | Op::SetDistanceMode(_)
                    | Op::SelectPlane(_)
                    | Op::SetSpindleSpeed(_)
            );
            moved |= !says_nothing && !stays;
            // Where work offsets lie, in the active unit.
            let keeps = matches!(
                stmt.op,
                Op::SetOriginOffsets(_)
                    | Op::UseToolLengthOffset(_)
                    | Op::StraightTraverse(_)
                    | Op::StraightFeed(_)
                    | Op::StartSpindleClockwise
                    | Op::StartSpindleCounterclockwise
            );
            set |= !says_nothing && !stays && !keeps;
        }
        if let Some(at) = late {
            let what = ValueUnsupported::ControlLate.into();
            self.fault(Fault::NotSupported { code: "#".into(), what }, at, out);
        }
    }

    /// A block that decides. What begins and ends subprograms has been taken before.
    pub(in crate::word) fn decide_flow(&mut self, decision: &Decision, block: &Block, out: &mut Batch) {
        out.whole = true;
        if self.o.too_deep {
            return;
        }
        let span = block.span;
        let letter = self.settings.dialect.block.number.map_or(0, |c| c as u8);
        self.now.number = block.words.iter().find(|w| w.letter == letter).and_then(|w| match w.value {
            crate::common::words::Value::Number(digits) => digits.to_whole(),
            _ => None,
        });
        let word = decision.word;
        let code = |label: &str| -> Text { format!("{} {}", label_text(label), spelled(word)).into() };
        let label: Text = match &decision.label {
            Index::Number(digits) => match digits.to_whole() {
                Some(number) => number.to_string().into(),
                None => return self.fault(Fault::OutOfRange { word: spelled(word).into() }, span, out),
            },
            Index::Name(name) => name.clone(),
            Index::Computed(_) if word == FlowWord::Call => "".into(),
            Index::Computed(_) => {
                let fault =
                    Fault::NotSupported { code: code("[]"), what: FlowUnsupported::LabelComputed.into() };
                return self.fault(fault, span, out);
            }
        };
        let refuse = |lower: &mut Lower, what: FlowUnsupported, out: &mut Batch| {
            lower.fault(Fault::NotSupported { code: code(&label), what: what.into() }, span, out);
        };
        if block.words.iter().any(|w| w.letter != letter) || !block.settings.is_empty() {
            return refuse(self, FlowUnsupported::OWords, out);
        }
        if block.skip != 0 {
            return refuse(self, FlowUnsupported::OSkipped, out);
        }
        let most = match word {
            FlowWord::Call => 30,
            FlowWord::If | FlowWord::ElseIf | FlowWord::While | FlowWord::Repeat => 1,
            FlowWord::Return | FlowWord::EndSub => 1,
            _ => 0,
        };
        if decision.values.len() > most {
            return refuse(self, FlowUnsupported::OValues, out);
        }
        let mut values = decision.values.clone();
        values.iter_mut().for_each(|value| self.parameters(value, span, out));
        let needs = matches!(word, FlowWord::If | FlowWord::ElseIf | FlowWord::While | FlowWord::Repeat);
        if needs && values.is_empty() {
            return refuse(self, FlowUnsupported::OValue, out);
        }
        self.now.silent = true;
        let first = || values.first().cloned().unwrap_or(Expr::int(0));
        match word {
            FlowWord::If => self.open_body(
                &label,
                StructureKind::If { before: Vec::new(), now: Some(first()) },
                span,
                out,
            ),
            FlowWord::Do => self.open_body(&label, StructureKind::Do, span, out),
            FlowWord::Repeat => self.open_body(&label, StructureKind::Repeat(times(first())), span, out),
            FlowWord::While => {
                let ends = self
                    .o
                    .open
                    .last()
                    .is_some_and(|o| matches!(o.kind, StructureKind::Do) && o.label == label);
                if !ends {
                    return self.open_body(&label, StructureKind::While(first()), span, out);
                }
                let Some((open, body)) = self.close_body(out) else { return };
                let condition = Expr::Node(Box::new(Node::Unary(Unary::Not, first())));
                self.closed(open, Control::Until { body, condition }, out);
            }
            FlowWord::ElseIf | FlowWord::Else => {
                let now = (word == FlowWord::ElseIf).then(first);
                if !self.next_branch(&label, now, span, out) && !self.o.misspelt {
                    refuse(self, FlowUnsupported::OElse, out);
                }
            }
            FlowWord::EndIf | FlowWord::EndWhile | FlowWord::EndRepeat => {
                if !self.end_body(&label, word, out) && !self.o.misspelt {
                    refuse(self, FlowUnsupported::OEnd, out);
                }
            }
            FlowWord::Break | FlowWord::Continue => self.leave(&label, word, span, out),
            FlowWord::Call => self.o_call(decision, &label, values, span, out),
            FlowWord::Return => self.o_return(&label, values, span, out),
            // In front of it all, by the reader.
            FlowWord::Sub | FlowWord::EndSub => {}
        }
    }

    /// The end of a program: what is still open has no end.
    pub(in crate::word) fn open_bodies(&mut self, out: &mut Batch) {
        for open in std::mem::take(&mut self.o.open) {
            let code = format!("{} {}", label_text(&open.label), open.kind.word()).into();
            if !self.o.misspelt {
                out.report(Fault::NotSupported { code, what: FlowUnsupported::OUnclosed.into() }, open.block);
            }
            self.now.failed = true;
        }
        self.o.labels.clear();
    }

    /// What surrounds the block, from the innermost.
    pub(in crate::word) fn kinds(&self) -> impl Iterator<Item = &StructureKind> {
        self.o.open.iter().rev().map(|open| &open.kind)
    }

    /// A subprogram is opened, or closed.
    pub(in crate::word) fn open_sub(&mut self, label: &str, outer: Outer, block: Span) {
        let given = std::mem::take(&mut self.o.given);
        let kind = StructureKind::Sub(Box::new(outer));
        let (label, at, number, paths, turned) =
            (label.into(), Some(0), None, StructurePaths::default(), false);
        self.o.open.push(OpenStructure { label, kind, at, block, number, given, paths, turned });
    }

    /// The subprogram that is open, if it has this label and nothing in it is.
    pub(in crate::word) fn close_sub(&mut self, label: &str) -> Option<Outer> {
        let fits =
            |open: &&OpenStructure| *open.label == *label && matches!(open.kind, StructureKind::Sub(_));
        self.o.open.last().filter(fits)?;
        let open = self.o.open.pop()?;
        self.o.given = open.given;
        match open.kind {
            StructureKind::Sub(outer) => Some(*outer),
            _ => None,
        }
    }
}

/// How many times a body is executed: rounded, and not less than none (interp_o_word.cc, `O_repeat`).
fn times(value: Expr) -> Expr {
    if let Some(whole) = constant(&value).filter(|n| *n >= 0.0 && *n == n.trunc() && *n < 1e9) {
        return Expr::int(whole as i64);
    }
    let call = |function, arguments| Expr::Node(Box::new(Node::Call(function, arguments)));
    call(Function::Max, vec![call(Function::Round, vec![value]), Expr::int(0)])
}

/// Whether an expression of the text may read what another one names.
fn meets(expr: &Expr, to: &Expr) -> bool {
    let (Expr::Node(node), Expr::Node(set)) = (expr, to) else { return false };
    if let Node::Element(element) = &**set
        && element.at.iter().any(|at| meets(at, expr))
    {
        return true;
    }
    match &**node {
        Node::Var(_) if node == set || matches!(**set, Node::Element(_)) => true,
        Node::Element(_) if matches!(**set, Node::Element(_) | Node::Var(_)) => true,
        _ => expr.parts().any(|part| meets(part, to)),
    }
}
