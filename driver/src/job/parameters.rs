//! Parameters of the source's control that a translation rests on, as far as they are stated.

use ncc_dialects::{BORE_SHIFT, SPINDLE_ANGLE};
use ncc_exec::world::Sideways;
use ncc_ir::expr::num::{Num, Unit};

use super::Job;

/// Which way the source's control takes a tool off the wall of a bore, as far as it is stated.
pub fn bore_shift(job: &Job) -> Option<Sideways> {
    let stated = job.from.get(BORE_SHIFT);
    Sideways::ALL.iter().find(|(name, _)| *name == stated).map(|(_, direction)| *direction)
}

/// The angle at which the source's control stops the spindle, as far as it is stated.
pub fn orientation(job: &Job) -> Option<Num> {
    job.from
        .length(SPINDLE_ANGLE)
        .filter(|_| job.from.is_chosen(SPINDLE_ANGLE))
        .map(|angle| Num { unit: Unit::Degree, ..angle })
}

/// A parameter of the source's control, in mm, needed where a cycle that rests on it is expanded.
pub fn parameter(job: &Job, option: &str) -> Option<Num> {
    job.from.length(option)
}
