//! Straight moves that are more than one call: synchronised with the spindle, to a probe's touch, to reference points,
//! and of blocks that leave the code of motion to those before.

use std::fmt::Write;

use ncc_exec::Kind;
use ncc_ir::canon::Motion;
use ncc_ir::diag::Fault;
use ncc_ir::lack::WordsLack;
use ncc_ir::program::{Pitch, Reference, Synchronised};

use super::{Printer, cannot, literal};

impl Printer<'_> {
    /// A probing move, over the whole of its way.
    pub(super) fn probe(&mut self) -> Result<(), Fault> {
        let to = self.made.iter().find_map(|event| match &event.kind {
            Kind::Probe { to, .. } => Some(self.exec.in_program(to)),
            _ => None,
        });
        self.call("TURN_PROBE_ON()");
        self.straight("STRAIGHT_PROBE", to.unwrap_or(self.exec.position()));
        self.call("TURN_PROBE_OFF()");
        Ok(())
    }

    /// One thread, or in and out again.
    pub(super) fn thread(&mut self, thread: &Synchronised) -> Result<(), Fault> {
        let Pitch::Stated(pitch) = &thread.pitch else {
            return Err(cannot(WordsLack::Function { function: "SYNCHRONISED_FEED" }));
        };
        if thread.chuck || thread.turn.is_some() {
            return Err(cannot(WordsLack::Function { function: "SYNCHRONISED_FEED" }));
        }
        let _ = writeln!(self.out, "START_SPEED_FEED_SYNC({:.6},0)", literal(pitch)?);
        if thread.back {
            let to = self.target(&thread.to)?;
            let [x, y, z] = [0, 1, 2].map(|axis| self.shown(axis, to[axis]));
            let _ = writeln!(self.out, "RIGID_TAP({x:.4}, {y:.4}, {z:.4})");
        } else {
            self.straight("STRAIGHT_FEED", self.exec.position());
        }
        self.call("STOP_SPEED_FEED_SYNCH()");
        Ok(())
    }

    /// Through a point, which may be where it stands, to the position that is stored.
    pub(super) fn reference(&mut self, reference: &Reference) -> Result<(), Fault> {
        let via = self.target(&reference.via)?;
        self.straight("STRAIGHT_TRAVERSE", via);
        self.straight("STRAIGHT_TRAVERSE", self.exec.position());
        Ok(())
    }

    /// A block with axis words alone, by the active motion.
    pub(super) fn position(&mut self) -> Result<(), Fault> {
        match self.exec.motion() {
            Motion::Traverse => self.straight("STRAIGHT_TRAVERSE", self.exec.position()),
            Motion::Feed => {
                self.rate_of_line()?;
                self.straight("STRAIGHT_FEED", self.exec.position());
            }
            Motion::Arc(_) | Motion::Cycle => {
                return Err(cannot(WordsLack::Function { function: "POSITION" }));
            }
        }
        Ok(())
    }

    /// The number of the tool in the spindle, which exchanges nothing.
    pub(super) fn tool_in_spindle(&mut self) {
        let tool = self.exec.state().tool;
        let _ = writeln!(self.out, "CHANGE_TOOL_NUMBER({tool})");
    }
}
