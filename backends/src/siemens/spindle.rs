//! What speed and feed count, where one code says both.
//!
//! Not here: codes that say one of them.

use ncc_ir::canon::{FeedMode, SpindleMode};
use ncc_ir::diag::Fault;
use ncc_ir::program::{Op, Stmt};
use ncc_ir::source::Span;

use super::{Sink, Writer};
use crate::common::block::{Need, Part, Rank};
use crate::common::codes::Code;
use crate::common::setting::Setting;

/// One code for two statements.
#[derive(Clone, Copy, Debug)]
pub(super) struct Both {
    feed: FeedMode,
    mode: SpindleMode,
    code: Code,
}

impl Writer {
    /// The code for what the statements begin with: what a feed counts, and in the same block what a speed
    /// counts.
    pub(super) fn speed_and_feed(&self, rest: &[Stmt]) -> Option<Both> {
        let [first, second, ..] = rest else { return None };
        let (Op::SetFeedMode(feed), Op::SetSpindleMode(mode)) = (&first.op, &second.op) else { return None };
        let joined = second.joined && second.skip == first.skip && self.words.preamble.is_none();
        let feed = Some(*feed).filter(|_| joined)?;
        Some(Both { feed, mode: *mode, code: self.words.codes.spindle_mode(*mode, Some(feed))? })
    }

    pub(super) fn write_both(&mut self, both: Both, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        self.words.admit(&Need::new(Rank::Setting).code(Some(both.code)), sink)?;
        self.words.block.code(Part::Mode, &both.code);
        self.words.now_in_force(Setting::FeedMode(both.feed));
        match both.mode {
            SpindleMode::Turns => self.words.now_in_force(Setting::Turns),
            SpindleMode::Surface => self.words.surface_in_force(span, sink),
        }
        Ok(())
    }
}
