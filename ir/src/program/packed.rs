//! Straight moves of a long stretch, packed into a tenth of the memory of their statements.
//!
//! ```text
//! G1 X0.358 Z-0.164    one byte of which words it has, two of its place, five of its numbers
//! ```
//!
//! Of words that are computed, the numbers alone are packed; the rest of them is a [`WordShape`], of which there are few.
//!
//! A program that is kept whole has a million of them between two statements of control, and no step but writing and
//! execution looks at each. Whoever packs a stretch leaves statements of it in front and after that stand for it: those in
//! front have each kind of word that it has, and those after say all again that it leaves active. So what follows a
//! program may go past it.
//!
//! Not here: how they are packed (`packing`), and which stretches are (the driver).

use std::sync::Arc;

use crate::canon::{Distance, Fact, Units};
use crate::expr::num::Unit;
use crate::program::shapes::WordShape;
use crate::source::Span;

/// Straight moves in X, Y and Z, and feeds: each as [`packs`](super::packing::packs) says.
#[derive(Clone, Debug, PartialEq)]
pub struct PackedLines {
    pub(super) bytes: Arc<[u8]>,
    /// Of the words that are computed.
    pub(super) shapes: Arc<[WordShape]>,
    pub(super) last: Span,
    pub(super) in_force: InForce,
    /// How many statements in front stand for them.
    pub(super) probes: u32,
    pub(super) statements: u32,
    pub(super) blocks: u32,
}

/// What words mean that leave it to what is active, where that is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct InForce {
    pub(super) unit: Unit,
    pub(super) distance: Fact<Distance>,
}

impl InForce {
    pub(super) fn unit(self, own: Unit) -> Unit {
        if own == Unit::Entry { self.unit } else { own }
    }

    pub(super) fn distance(self, own: Fact<Distance>) -> Fact<Distance> {
        if own == Fact::Entry { self.distance } else { own }
    }
}

impl PackedLines {
    /// Puts in what is active where the moves leave it to that.
    pub fn settle(&mut self, units: Option<Units>, distance: Option<Distance>) {
        self.in_force.unit = match (self.in_force.unit, units) {
            (Unit::Entry, Some(Units::Mm)) => Unit::Mm,
            (Unit::Entry, Some(Units::Inch)) => Unit::Inch,
            (own, _) => own,
        };
        self.in_force.distance = self.in_force.distance(distance.into());
    }

    /// Whether these are the same moves, whatever was put into them.
    pub fn are_moves_of(&self, other: &PackedLines) -> bool {
        Arc::ptr_eq(&self.bytes, &other.bytes)
    }

    /// Whether what is active has made increments of them: then no moves after them say where they leave the tool.
    pub fn are_increments(&self) -> bool {
        self.in_force.distance == Fact::Known(Distance::Incremental)
    }

    /// The shapes of the words that are computed.
    pub fn shapes(&self) -> &[WordShape] {
        &self.shapes
    }

    /// Has words of each shape be of another one, with the same numbers; there must be as many.
    pub fn reshape(&mut self, shapes: Vec<WordShape>) {
        let same = |(own, new): (&WordShape, &WordShape)| own.numbers() == new.numbers();
        assert!(shapes.len() == self.shapes.len() && self.shapes.iter().zip(&shapes).all(same));
        self.shapes = shapes.into();
    }

    /// How many statements in front of them have each kind of word that they have.
    pub fn probes(&self) -> usize {
        self.probes as usize
    }

    /// How many statements they are, and how many blocks begin with one of them.
    pub fn counts(&self) -> (usize, usize) {
        (self.statements as usize, self.blocks as usize)
    }

    /// The place of the last statement.
    pub fn last(&self) -> Span {
        self.last
    }
}
