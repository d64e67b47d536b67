//! Spindle-synchronised moves: the code, one axis word and its lead.
//!
//! What the target has of them, a pass has seen to.

use ncc_dialects::Thread;
use ncc_ir::canon::{Axis, Turn};
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::Num;
use ncc_ir::lack::ThreadsLack;
use ncc_ir::program::{Pitch, Synchronised};
use ncc_ir::source::Span;

use super::Words;
use crate::common::block::{Need, Part, Rank};
use crate::common::fault::{cannot, unwritable};
use crate::common::setting::Inserted;
use crate::common::{Sink, number};

impl Words {
    /// Writes a spindle-synchronised move.
    ///
    /// # Errors
    /// The dialect has no such move, or the lead has more digits than its word.
    pub(crate) fn thread(&mut self, m: &Synchronised, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        // In and out of one thread, the lead's sign is that of the way in.
        let turned_in = self.turned_in.filter(|turn| m.turn == Some(turn.back()));
        let (thread, minus) = match (m.turn, m.chuck, m.back) {
            (None, true, false) => (Thread::Chuck, false),
            (None, false, false) => (Thread::Plain, false),
            (None, false, true) => (Thread::Back, false),
            (Some(turn), false, false) => {
                let way_in = turned_in.unwrap_or(turn);
                self.turned_in = Some(way_in);
                let code = if turned_in.is_some() { Turn::Counterclockwise } else { Turn::Clockwise };
                (Thread::Turned(code), way_in == Turn::Counterclockwise)
            }
            _ => return Err(cannot(ThreadsLack::SynchronisedForm)),
        };
        let row = self.codes.threads.iter().find(|(own, ..)| *own == thread);
        let (_, code, letters) = row.ok_or_else(|| cannot(ThreadsLack::Synchronised))?.clone();
        let along = Axis::ALL.into_iter().find(|axis| m.to.get(*axis).is_some());
        let lead = match (&m.pitch, along.and_then(|axis| letters.get(axis as usize)).or(letters.first())) {
            (Pitch::Feed, None) => None,
            (Pitch::Stated(pitch), Some(letter)) => {
                let pitch = pitch.literal().ok_or_else(|| cannot(ThreadsLack::ComputedLead))?;
                self.check_unit(pitch, span)?;
                let mantissa = if minus { -pitch.mantissa } else { pitch.mantissa };
                let pitch = Num { mantissa, ..pitch };
                let shaped = number::shape(pitch, &letter.format)
                    .map_err(|why| unwritable(why, letter.letter, pitch))?;
                if shaped.rounded {
                    return Err(cannot(ThreadsLack::LeadDigits));
                }
                Some((letter.letter, shaped))
            }
            _ => return Err(cannot(ThreadsLack::LeadForm)),
        };
        let mut inserted = Inserted::default();
        self.need_distance(m.to.axes.iter().flatten(), &mut inserted)?;
        let need = self.point_need(Need::new(Rank::Motion), &m.to)?.code(Some(code));
        let need = lead.map_or(need, |(letter, _)| need.letter(letter));
        self.admit_with(need, inserted, sink)?;
        self.block.code(Part::Motion, &code);
        self.point(&m.to, span, sink)?;
        if let Some((letter, shaped)) = lead {
            self.block.word(Part::Axes, letter, shaped);
        }
        (self.active.motion, self.active.feed) = (None, None);
        Ok(())
    }
}
