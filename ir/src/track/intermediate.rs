//! Through which points axes went to reference points, followed in program coordinates.

use super::Tracker;
use crate::canon::{AXES, Axis};
use crate::expr::num::Nanos;
use crate::program::{Data, Op, Point, Reference};

/// The points, as far as they are known and are where they were.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Intermediate {
    at: [Option<Nanos>; AXES],
    /// The length offset by which Z was measured.
    length: Option<u32>,
}

impl Tracker {
    /// Axes stand at the point through which they go to a reference point.
    pub(super) fn note_intermediate(&mut self, to: &Reference) {
        for (axis, goes) in to.axes.iter().enumerate() {
            if *goes {
                self.intermediate.at[axis] = self.position[axis].filter(|_| !self.framed && !self.tilted);
            }
        }
        if to.axes[Axis::Z as usize] {
            self.intermediate.length = self.modes.length_offset;
        }
    }

    /// Forgets them where coordinates are counted again, or may be.
    pub(super) fn lose_intermediate(&mut self, op: &Op) {
        let anew = match op {
            Op::SetOriginOffsets(offset) => self.modes.work_offset != Some(*offset),
            Op::SetData(data) => matches!(**data, Data::Offset { .. } | Data::Tool { .. }),
            Op::ClearFrame(_)
            | Op::SetFrame(_)
            | Op::SetSlot(_)
            | Op::SetPosition(_)
            | Op::UseOriginShift(_)
            | Op::UseToolCentrePoint(_)
            | Op::OrientToolAxis(_) => true,
            _ => false,
        };
        if anew {
            self.intermediate = Intermediate::default();
        }
    }

    /// The intermediate point of the axes that a move names, if all are known.
    pub fn intermediate(&self, to: &Point) -> Option<[Option<Nanos>; AXES]> {
        let mut found = [None; AXES];
        for axis in Axis::ALL.into_iter().filter(|axis| to.get(*axis).is_some()) {
            let length = self.modes.length_offset;
            let measured = axis != Axis::Z || length.is_some() && self.intermediate.length == length;
            found[axis as usize] = Some(self.intermediate.at[axis as usize].filter(|_| measured)?);
        }
        Some(found)
    }
}

impl Intermediate {
    /// What holds on both of two ways.
    pub(super) fn join(&mut self, other: &Intermediate) {
        if self != other {
            *self = Intermediate::default();
        }
    }
}
