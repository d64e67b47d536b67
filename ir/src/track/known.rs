//! What the abstract execution answers to those who compute places, arcs and polar points.

use super::Tracker;
use crate::canon::{Axis, Distance, Fact};
use crate::expr::Expr;
use crate::expr::num::Nanos;
use crate::geometry::arc_solver::{ArcRule, Around};
use crate::geometry::hole_positions::Here;
use crate::geometry::polar::{About, Pole};
use crate::program::{Coord, Point};

/// What is known of where holes are.
pub(super) struct Known<'t> {
    pub(super) at: &'t Tracker,
    pub(super) axes: [Axis; 2],
}

impl Here for Known<'_> {
    type Unknown = ();

    fn at(&self, side: usize) -> Result<Nanos, ()> {
        self.at.position[self.axes[side] as usize].ok_or(())
    }

    fn word(&self, word: &Coord, side: usize) -> Result<Nanos, ()> {
        self.at.resolve(word, self.at.position[self.axes[side] as usize]).ok_or(())
    }

    fn after(&self, word: &Coord, _: usize, last: Nanos) -> Result<Nanos, ()> {
        self.at.resolve(word, Some(last)).ok_or(())
    }

    fn value(&self, value: &Expr) -> Result<Nanos, ()> {
        self.at.nanos(value).ok_or(())
    }

    fn out_of_range(&self) {}
}

/// What is known of an arc by its angle.
pub(super) struct Turning<'t>(pub(super) &'t Tracker);

impl Around for Turning<'_> {
    type Unknown = ();

    fn value(&self, value: &Expr) -> Result<Nanos, ()> {
        self.0.nanos(value).ok_or(())
    }

    fn via(&self, _: &Point) -> Result<[Nanos; 2], ()> {
        Err(())
    }

    fn heading(&self) -> Result<[f64; 2], ()> {
        Err(())
    }

    fn rule(&self) -> (ArcRule, bool) {
        (ArcRule::UNTESTED, false)
    }
}

/// What is known of a polar point.
pub(super) struct Polarly<'t>(pub(super) &'t Tracker);

impl About for Polarly<'_> {
    type Unknown = ();

    fn value(&self, value: &Expr) -> Result<Nanos, ()> {
        self.0.nanos(value).ok_or(())
    }

    fn is_increment(&self, distance: Fact<Distance>) -> Result<bool, ()> {
        let distance = distance.known().or(self.0.modes.distance).ok_or(())?;
        Ok(distance == Distance::Incremental)
    }

    fn here(&self, axis: Axis) -> Result<Nanos, ()> {
        self.0.position[axis as usize].ok_or(())
    }

    fn pole(&self) -> Result<Pole, ()> {
        if self.0.pole_lost { Err(()) } else { Ok(self.0.pole) }
    }

    fn missing(&self, _: &'static str) {}

    fn out_of_range(&self, _: &'static str) {}
}
