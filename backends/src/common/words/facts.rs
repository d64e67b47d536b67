//! Facts of the whole program, known before its blocks are written.

use std::collections::HashMap;

use ncc_ir::canon::{Distance, Modes};
use ncc_ir::program::Stmt;

use super::Words;

/// Facts of the program that no block says.
#[derive(Clone, Debug, Default)]
pub(crate) struct ProgramFacts {
    /// Whether a program that computes is written with its structure.
    pub(super) kept: bool,
    /// Whether lengths count mm wherever the text does not say what they count.
    pub(crate) metric: bool,
    /// Modes active where stretches of blocks begin, by the places of their first statements.
    entries: HashMap<u32, Modes>,
    /// The distance mode of the program where the stretch at hand begins, if it is known.
    pub(super) entry: Option<Distance>,
    /// The distance mode that the text had before this writer put in another one.
    pub(super) replaced: Option<Distance>,
    /// Whether the distance mode is known of the program as a whole, and not of the text where it is read.
    pub(crate) unsaid: bool,
}

impl Words {
    /// A program that computes is written with its structure.
    pub(crate) fn is_kept(&mut self, entries: HashMap<u32, Modes>) {
        self.facts.kept = true;
        self.know_modes(entries);
    }

    /// Takes which modes are active where stretches of blocks begin.
    pub(crate) fn know_modes(&mut self, entries: HashMap<u32, Modes>) {
        self.facts.entries = entries;
    }

    /// Where a stretch of blocks begins, modes that are known there on every path are active in the text as in the
    /// source: the text states each that the source does, and no other.
    pub(crate) fn stand(&mut self, stmt: &Stmt) {
        let known = self.facts.entries.get(&stmt.span.start);
        self.facts.entry = known.and_then(|known| known.distance);
        let Some(known) = known else { return };
        if self.preamble.is_some() {
            return;
        }
        self.forgotten = false;
        self.facts.unsaid = self.active.distance.is_none();
        self.active.distance = self.active.distance.or(known.distance);
        self.active.plane = self.active.plane.or(known.plane);
        self.active.units = self.active.units.or(known.units);
        self.tracker.modes.work_offset = self.tracker.modes.work_offset.or(known.work_offset);
    }
}
