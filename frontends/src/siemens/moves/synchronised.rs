//! Lowering of threads that are blocks of their own: as the spindle turns, with a spindle that the control
//! turns itself, and with a compensating chuck.
//!
//! Refused: threads along several axes or round one, with an angle to begin at, in machine coordinates, and
//! while a cycle or a subprogram is modal. Not here: tapping cycles (`threads`).

use ncc_dialects::{Quantity, Thread};
use ncc_ir::canon::{Axis, Turn};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::program::{Op, Pitch, Point, Synchronised};
use ncc_ir::source::Span;
use ncc_ir::unsupported::MoveUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::siemens::block_words::{Code, Words};
use crate::siemens::lower::Lower;
use crate::siemens::siemens_state::ModalCall;

/// Letters of leads along X, Y and Z.
const LEADS: [u8; 3] = *b"IJK";

impl Lower {
    /// A thread, whose code is active.
    pub(in crate::siemens) fn thread(
        &mut self,
        thread: Thread,
        machine: Option<Code>,
        block: Span,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        let Some((along, to)) = self.along(machine.is_some(), block, words, src, out) else { return };
        let letter = LEADS[along as usize];
        let Some(given) = words.take(letter) else {
            let (code, word) = (src.text(block), char::from(letter).to_string().into());
            return self.fault(Fault::WordMissing { code, word }, block, out);
        };
        if given.distance.is_some() {
            return self.fault(Fault::OutOfRange { word: src.text(given.span).into() }, given.span, out);
        }
        let Some(mut lead) = self.number(given, Quantity::Length, src, out) else { return };
        let minus = lead.mantissa < 0;
        lead.mantissa = lead.mantissa.abs();
        let turn = match thread {
            Thread::Turned(turn) => Some(if minus { turn.back() } else { turn }),
            Thread::Plain | Thread::Back | Thread::Chuck => None,
        };
        if lead.is_zero() || minus && turn.is_none() {
            return self.fault(Fault::OutOfRange { word: src.text(given.span).into() }, given.span, out);
        }
        let pitch = Pitch::Stated(Expr::Num(lead));
        self.push_thread(to, pitch, turn, block, out);
    }

    /// A move with a compensating chuck, at feed and speed active.
    pub(in crate::siemens) fn chuck_thread(
        &mut self,
        code: &Code,
        other: bool,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        self.moved = None;
        self.rely_on_feed(code.span, out);
        let Some((_, to)) = self.along(other, code.span, words, src, out) else { return };
        self.push_thread(to, Pitch::Feed, None, code.span, out);
    }

    fn push_thread(&mut self, to: Point, pitch: Pitch, turn: Option<Turn>, block: Span, out: &mut Batch) {
        let chuck = pitch == Pitch::Feed;
        // In and out may become one cycle.
        out.whole = true;
        let thread = Synchronised { to, pitch, chuck, turn, back: false };
        self.push(block, Op::SynchronisedFeed(Box::new(thread)), out);
    }

    /// The one axis of a thread, and its end point.
    fn along(
        &mut self,
        other: bool,
        block: Span,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) -> Option<(Axis, Point)> {
        let what = match &self.state.cycle {
            _ if other => Some(MoveUnsupported::ThreadBesideMotion),
            ModalCall::None | ModalCall::Refused => None,
            ModalCall::Active(_)
            | ModalCall::Subprogram(_)
            | ModalCall::Inherited { .. }
            | ModalCall::Lost { .. } => Some(MoveUnsupported::ThreadInModal),
        };
        let to = self.point(false, None, words, src, out);
        let along: Vec<Axis> = Axis::ALL.into_iter().filter(|axis| to.get(*axis).is_some()).collect();
        let what = match (what, &along[..]) {
            (None, [axis]) if !axis.is_rotary() => return Some((*axis, to)),
            (Some(what), _) => what,
            (None, _) => MoveUnsupported::ThreadAxes,
        };
        for letter in LEADS {
            let _ = words.take(letter);
        }
        self.not_supported(&src.text(block), what, block, out);
        None
    }
}
