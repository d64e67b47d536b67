//! Cuts with the spindle stopped, of a program that has said a speed.
//!
//! ```text
//! S3200 M00       → M03 was meant: nothing turns
//! G01 X10. F100.  → noted here
//!
//! S0 M03          → nothing turns either
//! G01 X10. F100.  → noted here
//! ```
//!
//! The first such move is noted. A spindle that the program stops at an angle is meant to stand, and so is one with a
//! probe in it. Not here: what is reported of it.

use crate::{Exec, Kind};
use ncc_ir::canon::Spindle;
use ncc_ir::source::Span;

/// What is noted.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Standing {
    /// The first move.
    cut: Option<Span>,
    /// Whether the spindle is meant to stand.
    meant: bool,
    /// Whether the active speed is an S0 of the program.
    pub(crate) at_zero: bool,
}

impl Exec {
    /// The first move at feed that was made with the spindle stopped, by a program that had said a speed before.
    pub fn cut_standing(&self) -> Option<Span> {
        self.standing.cut
    }

    /// Something happens while the spindle is stopped.
    #[cold]
    pub(crate) fn stands_at(&mut self, kind: &Kind, span: Span) {
        let standing = &mut self.standing;
        match kind {
            Kind::Orient(_) => standing.meant = true,
            Kind::Probe { .. } => (standing.cut, standing.meant) = (None, true),
            Kind::ToolChange => standing.meant = false,
            Kind::Feed | Kind::Arc { .. }
                if !standing.meant
                    && (self.state.speed != 0
                        || standing.at_zero && self.state.spindle != Spindle::Stopped) =>
            {
                standing.cut.get_or_insert(span);
            }
            _ => {}
        }
    }

    /// The program says a speed.
    pub(crate) fn speed_said(&mut self) {
        self.standing.at_zero = self.state.speed == 0;
    }

    /// The spindle turns.
    pub(crate) fn spindle_turns(&mut self) {
        self.standing.meant = false;
    }
}
