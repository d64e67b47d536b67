//! What is known where a frame changes: the plane, the point, and the values of words.

use ncc_exec::Present;
use ncc_ir::canon::{AXES, Axis, Distance, Fact, Plane};
use ncc_ir::diag::{Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Unit};
use ncc_ir::lack::FramesLack;
use ncc_ir::program::Coord;
use ncc_ir::track::Tracker;

/// What is known where a frame changes.
pub(super) struct Now<'t> {
    pub(super) at: &'t Tracker,
    /// Where the tool stands in the work offset.
    pub(super) work: [Option<Nanos>; AXES],
    pub(super) shift: [Nanos; AXES],
}

impl Present for Now<'_> {
    type Unknown = Fault;

    fn plane(&self, plane: Fact<Plane>) -> Result<Plane, Fault> {
        self.at.plane(plane).ok_or(Fault::EntryFactNeeded { fact: ModeName::Plane })
    }

    fn value(&self, value: &Expr) -> Result<Nanos, Fault> {
        value_of(self.at, value)
    }

    fn distance(&self, word: &Coord) -> Result<Distance, Fault> {
        let distance = word.distance.known().or(self.at.modes.distance);
        distance.ok_or(Fault::EntryFactNeeded { fact: ModeName::Distance })
    }

    fn work(&self, axis: usize) -> Result<Nanos, Fault> {
        let at = self.work[axis].ok_or(Fault::PositionUnknown { axis: Axis::ALL[axis].letter() as char })?;
        Ok(at.wrapping_sub(self.shift[axis]))
    }

    fn out_of_range(&self) -> Fault {
        Fault::OutOfRange { word: "factor".into() }
    }
}

/// A literal's value.
pub(super) fn value_of(at: &Tracker, value: &Expr) -> Result<Nanos, Fault> {
    at.nanos(value).ok_or_else(|| match value.literal() {
        Some(n) if n.unit == Unit::Entry => Fault::EntryFactNeeded { fact: ModeName::Units },
        Some(_) | None => cannot(FramesLack::ComputedWord),
    })
}

/// The target lacks this.
pub(super) fn cannot(lack: FramesLack) -> Fault {
    Fault::lacks(lack)
}
