//! Execution of polar points: the active pole, and moves to points by radius and angle.
//!
//! Not here: where such a point is (`polar`).

use crate::{Event, Exec};
use ncc_ir::canon::{Axis, Distance, Fact};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Nanos;
use ncc_ir::geometry::polar::{self, About, Pole};
use ncc_ir::program::{Op, Polar, SetPole, Stmt};
use ncc_ir::source::Span;
use ncc_ir::unexecuted::MoveUnexecuted;

struct Now<'e>(&'e Exec, Span);

impl About for Now<'_> {
    type Unknown = Diagnostic;

    fn value(&self, value: &Expr) -> Result<Nanos, Diagnostic> {
        self.0.value(value, self.1)
    }

    fn is_increment(&self, distance: Fact<Distance>) -> Result<bool, Diagnostic> {
        Ok(distance.or(self.0.modes.distance) == Distance::Incremental)
    }

    fn here(&self, axis: Axis) -> Result<Nanos, Diagnostic> {
        Ok(self.0.position[axis as usize])
    }

    fn pole(&self) -> Result<Pole, Diagnostic> {
        Ok(self.0.pole)
    }

    fn missing(&self, what: &'static str) -> Diagnostic {
        Diagnostic::new(Fault::WordMissing { code: "POLAR".into(), word: what.into() }, self.1)
    }

    fn out_of_range(&self, what: &'static str) -> Diagnostic {
        Diagnostic::new(Fault::OutOfRange { word: what.into() }, self.1)
    }
}

impl Exec {
    /// Sets a pole.
    pub(crate) fn set_pole(&mut self, set: &SetPole, span: Span) -> Result<(), Diagnostic> {
        let plane = self.plane_of(set.plane);
        self.pole = polar::pole(set, plane, &Now(self, span))?;
        Ok(())
    }

    /// The move to a polar point with coordinates in its place, if that is known.
    pub fn by_coordinates(&self, polar: &Polar) -> Option<Op> {
        let plane = self.plane_of(polar.plane);
        let (at, _) = polar::point(polar, plane, &Now(self, Span::default())).ok()?;
        polar::with_words(polar, plane, at, polar::exact)
    }

    /// Makes a move to a polar point.
    pub(crate) fn polar(
        &mut self,
        polar: &Polar,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        if self.raw.is_some() || self.probing.is_some() || self.detour.is_some() {
            return self.not_executed(MoveUnexecuted::PolarInMachine, span);
        }
        let plane = self.plane_of(polar.plane);
        let (at, pole) = polar::point(polar, plane, &Now(self, span))?;
        let Some(op) = polar::with_words(polar, plane, at, polar::exact) else {
            return self.not_executed(MoveUnexecuted::PolarFunction, span);
        };
        self.pole = pole;
        self.do_step(&Stmt::new(span, op), out)
    }
}
