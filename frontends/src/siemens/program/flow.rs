//! Lowering of the program's own flow: loops, alternatives, labels and jumps.
//!
//! A structure becomes one statement when it ends; its body is taken out of the statements before. At a jump target
//! (a label that a jump names, the head and the end of a loop) every fact is lost, as after a call. After an IF, the
//! facts are those that both branches leave.
//!
//! A jump looks for its label in its direction, the nearest first, and labels may stand there twice. Which label is
//! meant is found when the program has been read; labels of one name then get names of their own.
//!
//! Refused: jumps that are computed, jumps to the start of a subprogram, structures that a switch may skip,
//! and a modal cycle or rounding that differs between a jump and its label.

mod structures;

use std::collections::HashSet;

use ncc_ir::diag::Fault;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::{Binary, Expr, Function, Node};
use ncc_ir::program::{Control, Op, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::unsupported::{CallUnsupported, FlowUnsupported};

use super::labels::{InPlace, Label, Pending, marked, resolve};
use super::open_structures::Flow;
use crate::batch::Batch;
use crate::common::Source;
use crate::siemens::lower::Lower;
use crate::siemens::siemens_state::SiemensState;
use crate::siemens::text::tree::{Expr as Tree, Jump, Place, Target};
use crate::siemens::text::{tree, unit};
use crate::siemens::values::typed::{Kind, Typed};

/// The name by which jumps know a block number.
fn numbered(number: u32) -> Text {
    format!("N{number}").into()
}

/// Looks for what jumps of a text name, by the bytes alone.
fn named(text: &[u8], targets: &mut HashSet<Text>) {
    for at in memchr::memchr2_iter(b'G', b'g', text) {
        let Some(rest) = text.get(at + 1..).filter(|rest| rest.len() > 3) else { continue };
        if !rest[..3].eq_ignore_ascii_case(b"OTO") {
            continue;
        }
        let rest = &rest[3..];
        let rest = match rest.first().map(u8::to_ascii_uppercase) {
            Some(b'F' | b'B' | b'C') => &rest[1..],
            _ => rest,
        };
        let blanks = rest.iter().take_while(|b| matches!(b, b' ' | b'\t' | b'"' | b'&')).count();
        let rest = &rest[blanks..];
        let word = |text: &[u8]| -> String {
            let end = text.iter().position(|b| !(b.is_ascii_alphanumeric() || *b == b'_'));
            String::from_utf8_lossy(&text[..end.unwrap_or(text.len())]).to_ascii_uppercase()
        };
        let name = match rest.first() {
            Some(b':') => word(&rest[1..]).parse().ok().map(numbered),
            _ => {
                let name = word(rest);
                match name.strip_prefix('N').map(str::parse) {
                    Some(Ok(number)) => Some(numbered(number)),
                    _ => Some(name.into()),
                }
            }
        };
        targets.extend(name.filter(|name| !name.is_empty()));
    }
}

impl Lower {
    /// Looks through text that is to be read for where its jumps go.
    pub(in crate::siemens) fn look_ahead(&mut self, text: &[u8], out: &mut Batch) {
        let before = self.flow.targets.len();
        named(text, &mut self.flow.targets);
        if self.flow.targets.len() != before {
            let is_number = |name: &Text| name.strip_prefix('N').is_some_and(|n| n.parse::<u32>().is_ok());
            self.flow.numbered = self.flow.targets.iter().any(is_number);
            out.whole = true;
            self.refresh();
        }
    }

    /// Whether blocks may stand after the end of the program that are executed.
    pub(in crate::siemens) fn goes_on(&self) -> bool {
        !self.flow.targets.is_empty() || !self.flow.open.is_empty()
    }

    /// Whether a block number is gone to.
    pub(in crate::siemens) fn has_numbered_targets(&self) -> bool {
        self.flow.numbered
    }

    /// Whether a block may be gone to.
    pub(in crate::siemens) fn has_targets(&self) -> bool {
        !self.flow.targets.is_empty()
    }

    fn in_place(&self) -> InPlace {
        InPlace { cycle: self.state.cycle.clone(), rounding: self.rounding }
    }

    /// Facts that no block has said are those of the program's begin: from here on that could not be seen.
    fn settle(&mut self, at: Span, out: &mut Batch) {
        if !self.assume || self.sub.is_some() {
            return;
        }
        self.units(at, out);
        if self.called {
            // Of all else it has the modes active in its caller.
            return;
        }
        self.distance(at, out);
        self.plane(at, out);
        self.rely_on_frames(true, at, out);
        self.rely_on_feed_mode(at, out);
        let _ = self.motion(at, out);
    }

    /// Control may come here from elsewhere.
    fn lose(&mut self, at: Span, src: Source, out: &mut Batch) {
        self.no_idle_tap(at, src, out);
        self.no_stale_offset(at, out);
        self.settle(at, out);
        self.leave_motion_before(at, out);
        self.motion_goes_on(&[self.state.modes.motion], out);
        let cycle = std::mem::take(&mut self.state.cycle);
        self.state = SiemensState::lost(cycle);
        self.stand.forget();
        self.repeated_blocks.use_all();
        self.forget_texts();
        // After a cycle, what was active before it is still not known where it was not told.
        self.cycled &= self.moved.is_none();
        self.moved = None;
    }

    /// A block that a jump names, by its number or its label.
    pub(in crate::siemens) fn arrive(
        &mut self,
        name: Option<&str>,
        number: Option<u32>,
        at: Span,
        src: Source,
        out: &mut Batch,
    ) {
        let number = number.map(numbered).filter(|number| self.flow.targets.contains(number));
        let named = name.filter(|name| self.flow.targets.contains(*name)).map(Text::from);
        if number.is_none() && named.is_none() {
            if let Some(name) = name {
                self.flow.labels.push(Label { name: name.into(), at: at.start, found: None });
            }
            return;
        }
        self.lose(at, src, out);
        self.flow.over = false;
        out.whole = true;
        let found = self.in_place();
        if let Some(name) = number {
            let start = self.now.span.start;
            self.flow.labels.push(Label { name: name.clone(), at: start, found: Some(found.clone()) });
            self.push(Span::new(start, start), Op::Label(name), out);
        }
        if let Some(name) = name {
            let found = named.is_some().then_some(found);
            self.flow.labels.push(Label { name: name.into(), at: at.start, found });
        }
    }

    /// The jumps of a block, in their order.
    pub(in crate::siemens) fn jumps(&mut self, jumps: &[Jump], src: Source, out: &mut Batch) {
        for jump in jumps {
            out.whole = true;
            let Some(op) = self.jump(jump, src, out) else { continue };
            match &jump.condition {
                None => {
                    self.flow.over |= !self.skipped() && self.flow.open.is_empty();
                    self.push(jump.span, op, out);
                }
                Some(condition) => {
                    let Some(condition) = self.condition(condition, src, out) else { continue };
                    let (place, typed) =
                        (self.exprs.len(), Typed { expr: condition.clone(), kind: Kind::Bool });
                    self.exprs.insert(place, typed);
                    let then = vec![Stmt::new(jump.span, op)];
                    let control = Control::If { condition, then, otherwise: Vec::new() };
                    self.push(jump.span, Op::Control(Box::new(control)), out);
                }
            }
        }
        if !jumps.is_empty() {
            self.no_word_reads_what_is_set(src, out);
        }
    }

    /// A jump without its condition; its label is found at the end.
    fn jump(&mut self, jump: &Jump, src: Source, out: &mut Batch) -> Option<Op> {
        let name: Text = match &jump.target {
            None if self.sub.is_some() || self.unit == Some(unit::Kind::Sub) => {
                self.not_supported("GOTOS", CallUnsupported::StartOfSub, jump.span, out);
                return None;
            }
            None => {
                self.idle_tap_ends("GOTOS", jump.span, out);
                self.leave_motion(jump.span, out);
                self.flow.has_end = true;
                return Some(Op::BeginAgain);
            }
            Some(Target::Number(number)) => numbered(number.value),
            Some(Target::Named(Tree::Place(Place { address: tree::Address::Name(name), index, .. })))
                if index.is_empty()
                    && !self.variables.contains_key(&*src.text(*name).to_ascii_uppercase()) =>
            {
                src.text(*name).to_ascii_uppercase().into()
            }
            Some(Target::Named(Tree::Text(span))) => {
                crate::siemens::values::texts::unquoted(src.bytes(*span)).to_ascii_uppercase().into()
            }
            Some(Target::Named(other)) => {
                let span = other.span();
                self.not_supported(&src.text(span), FlowUnsupported::Computed, span, out);
                return None;
            }
        };
        self.texts_may_be_passed_over();
        self.no_idle_tap(jump.span, src, out);
        self.no_stale_offset(jump.span, out);
        self.leave_motion(jump.span, out);
        let (direction, span, found) = (jump.direction, jump.span, self.in_place());
        let mark = marked(&name, span);
        self.flow.jumps.push(Pending { name, direction, span, found });
        Some(Op::Goto(mark))
    }

    /// `CASE value OF 1 GOTOF A 2 GOTOF B DEFAULT GOTOF C`
    pub(in crate::siemens) fn case(
        &mut self,
        value: &Tree,
        branches: &[(Tree, Jump)],
        default: Option<&Jump>,
        span: Span,
        src: Source,
        out: &mut Batch,
    ) {
        out.whole = true;
        let Some(value) = self.formula(value, src, out) else { return };
        let mut otherwise = match default {
            None => Vec::new(),
            Some(jump) => match self.jump(jump, src, out) {
                Some(op) => vec![Stmt::new(jump.span, op)],
                None => return,
            },
        };
        for (constant, jump) in branches.iter().rev() {
            let Some(constant) = self.formula(constant, src, out) else { return };
            let Some(op) = self.jump(jump, src, out) else { return };
            let condition = if value.kind == Kind::Real {
                let near = Num { mantissa: 1, scale: 12, point: true, unit: Unit::One };
                let arguments = vec![value.expr.clone(), constant.expr, Expr::Num(near)];
                Expr::Node(Box::new(Node::Call(Function::NearRatio, arguments)))
            } else {
                Expr::binary(Binary::Equal, value.expr.clone(), constant.expr)
            };
            let then = vec![Stmt::new(jump.span, op)];
            let control = Control::If { condition, then, otherwise };
            otherwise = vec![Stmt::new(span, Op::Control(Box::new(control)))];
        }
        self.flow.over |= default.is_some() && !self.skipped() && self.flow.open.is_empty();
        for stmt in otherwise {
            self.push(span, stmt.op, out);
        }
    }

    /// A feed relies on what feeds count in here.
    pub(in crate::siemens) fn rely_on_scaled(&mut self, at: Span) {
        if !self.flow.open.is_empty() {
            self.flow.relied.get_or_insert(at);
        }
    }

    /// The end of a program: jumps find their labels.
    pub(in crate::siemens) fn end_flow(&mut self, out: &mut Batch) -> bool {
        let Flow { labels, jumps, open, .. } = &mut self.flow;
        let (labels, jumps, open) = (std::mem::take(labels), std::mem::take(jumps), std::mem::take(open));
        (self.flow.over, self.flow.has_end) = (false, false);
        let mut faulty = false;
        for open in open {
            let (code, what) = (open.what.word().into(), FlowUnsupported::Unclosed.into());
            out.report(Fault::NotSupported { code, what }, open.head);
            faulty = true;
        }
        if jumps.is_empty() {
            return faulty;
        }
        let mut told = Vec::new();
        let refused = resolve(&labels, &jumps, self.target(out), &mut told);
        out.diagnostics.extend(told);
        faulty | refused
    }
}
