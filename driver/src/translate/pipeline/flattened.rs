//! A program that the user has executed by `flatten`: its straight moves go through the other steps packed.
//!
//! ```text
//! WHILE of a million points    flatten    G54 | some moves | LINES | some moves | M30
//! ```
//!
//! Not here: the pass itself, and what packed moves are (`stretches`).

use std::io;

use ncc_ir::program::Program;

use super::{Kept, Part};
use crate::stretches::{stretches, unpack};
use crate::translate::rewrite::FLATTEN;
use crate::translate::snapshot::Snapshot;
use crate::translate::translation::Translation;

impl Translation<'_> {
    /// Whether `flatten` is asked for, and nothing else.
    pub(super) fn packs_flattened(&self) -> bool {
        let alone = matches!(&*self.job.passes, [pass] if pass.name == FLATTEN);
        alone && self.folder.is_none()
    }

    /// Sends a kept program through the steps, with what `flatten` makes of it packed as far as the steps after it leave
    /// that as it is; where they do not, with all of its moves.
    pub(super) fn send_flattened(&mut self, source: Program) -> io::Result<()> {
        let mut part = Part::Kept(Box::new(Kept::new(source)));
        if self.rewrite_source(&mut part).is_err() {
            return Ok(());
        }
        let Part::Kept(kept) = &part else { return Ok(()) };
        let stretches = kept.program.procedures.first().map(|main| stretches(&main.body)).unwrap_or_default();
        let (program, found, before) = (kept.program.clone(), kept.found.clone(), Snapshot::of(self));
        let mut rewritten = self.rewrite_for_target(&mut part);
        let left = rewritten.is_ok() && self.leaves(&stretches, &mut part, (&before, found.len()));
        if !stretches.is_empty() && !left {
            before.restore(self);
            if let Part::Kept(kept) = &mut part {
                (kept.program, kept.found) = (program, found);
                kept.program.procedures.iter_mut().for_each(|procedure| unpack(&mut procedure.body));
            }
            drop(stretches);
            rewritten = self.rewrite_for_target(&mut part);
        }
        if rewritten.is_err() {
            return Ok(());
        }
        self.write(&mut part);
        self.release(&mut part)
    }
}
