//! Making events: of straight moves, and of whatever else happens.

use crate::{Event, Exec, Kind, Z, by_control};
use ncc_ir::canon::{FeedMode, Spindle, same_point};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::source::Span;

impl Exec {
    /// Emits a straight move to the present position, if it is one.
    #[inline]
    pub(crate) fn emit_move(
        &mut self,
        feed: bool,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        let end = self.machine();
        // A cutting move without a feed is a fault wherever it goes: controls stop at its block.
        let needs_feed = feed && self.feed == 0;
        if same_point(&end, &self.last) && !self.every_move && !needs_feed {
            return Ok(());
        }
        if self.state.by_control & (by_control::Z | by_control::Z_AT_START) != 0 && end[Z] != self.last[Z] {
            return self.emit_first_of_z(feed, end, span, out);
        }
        let kind = if feed { Kind::Feed } else { Kind::Traverse };
        self.pace = if feed { self.pace_of_line(&end) } else { None };
        self.last = end;
        self.emit(kind, span, out)
    }

    #[inline]
    pub(crate) fn emit(&mut self, kind: Kind, span: Span, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let cutting = matches!(kind, Kind::Feed | Kind::Probe { .. } | Kind::Arc { .. });
        if cutting && self.feed == 0 {
            return self.fault(Fault::NoFeed, span);
        }
        if self.speed_watched {
            self.watch_speed(&kind, span)?;
        }
        if self.state.spindle == Spindle::Stopped || self.standing.at_zero {
            self.stands_at(&kind, span);
        }
        if self.quiet {
            self.counted += 1;
            self.keep_stroke(&kind);
        } else {
            let mut state = self.state;
            let rate = match kind {
                Kind::Synchronised { pitch, .. } => {
                    let rate = i128::from(pitch) * i128::from(self.state.speed) / i128::from(ONE);
                    Nanos::try_from(rate).unwrap_or(Nanos::MAX)
                }
                _ if cutting && self.pace.is_some() => {
                    let (rate, timed) = self.paced(self.pace);
                    state = timed;
                    rate
                }
                _ if cutting => self.feed,
                _ => 0,
            };
            out.push(Event { kind, end: self.last, rate, state, inch: self.modes.inch, span });
        }
        self.pace = None;
        if cutting && self.state.feed_mode == FeedMode::InverseTime {
            // The time of one move says nothing of the next.
            self.feed = 0;
        }
        Ok(())
    }
}
