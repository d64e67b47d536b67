//! What a program has not said where the ways of a structure join: `o1 if [..]`, `G18`, `o1 endif` leaves the plane as
//! the text began on one way, and G18 on the other.
//!
//! Not here: jumps to numbered blocks, which this language has not.

use ncc_ir::source::Span;

use super::o_state::{OpenStructure, StructureKind, StructurePaths};
use crate::batch::Batch;
use crate::initial_modes::Unsaid;
use crate::word::lower::Lower;

impl Lower {
    /// A further body of a structure begins.
    pub(super) fn next_body(&mut self, mut open: OpenStructure, at: Span, out: &mut Batch) {
        self.body_ends(&mut open.paths);
        self.body_begins(open.paths, at, out);
        self.o.open.push(open);
    }

    /// A structure begins here.
    pub(super) fn paths_at_head(&self) -> StructurePaths {
        StructurePaths {
            centre: self.state.centre_before,
            head: self.state.unsaid(),
            ends: Unsaid::default(),
        }
    }

    /// A body of a structure begins.
    pub(super) fn body_begins(&mut self, paths: StructurePaths, at: Span, out: &mut Batch) {
        self.merge_paths(paths.head, at, out);
        self.state.centre_before = paths.centre;
    }

    /// A body is over, or left: the structure goes on elsewhere.
    pub(super) fn body_ends(&self, paths: &mut StructurePaths) {
        paths.ends = paths.ends.and(self.state.unsaid());
    }

    /// The structure is over.
    pub(super) fn merge_bodies(&mut self, paths: StructurePaths, at: Span, out: &mut Batch) {
        self.merge_paths(paths.ends, at, out);
        self.state.centre_before = paths.centre;
    }

    /// Facts are lost, and what the program has said of centres stays said.
    pub(super) fn lose_all_but_centres(&mut self, at: Span, out: &mut Batch) {
        let centre = self.state.centre_before;
        self.lose(at, out);
        self.state.centre_before = centre;
    }

    /// A loop is left here, or its next iteration begins.
    pub(super) fn leaves_loop(&mut self) {
        let unsaid = self.state.unsaid();
        let inner = self.o.open.iter_mut().rev().find(|open| !matches!(open.kind, StructureKind::If { .. }));
        if let Some(OpenStructure { paths, .. }) = inner {
            paths.ends = paths.ends.and(unsaid);
        }
    }
}
