//! A point by radius and angle, or a line by its angle, as a move by coordinates.

use crate::support::walk::Walk;
use crate::support::write::{self, EXACT, is_absolute, rounded};
use crate::target::Target;
use ncc_ir::canon::Axis;
use ncc_ir::diag::Fault;
use ncc_ir::geometry::polar;
use ncc_ir::lack::ArcsLack;
use ncc_ir::program::cycle::absolute;
use ncc_ir::program::{Op, Polar};

/// Puts the words of the plane into a polar move, if its place is known.
///
/// # Errors
/// It is not known.
pub(crate) fn by_coordinates(polar: &Polar, walk: &Walk, target: &Target) -> Result<Op, Fault> {
    let unknown = || Fault::lacks(ArcsLack::PolarRunTime);
    let (at, plane, _) = walk.at.polar(polar).ok_or_else(unknown)?;
    let unit = walk.unit();
    let make = |nanos| absolute(rounded(nanos, target.decimals_in(unit).min(EXACT), unit));
    let mut op = polar::with_words(polar, plane, at, make).ok_or_else(unknown)?;
    // One block, one way of measuring.
    for (axis, word) in Axis::ALL.into_iter().zip(polar::end(&mut op).into_iter().flat_map(|to| &mut to.axes))
    {
        let Some(word) = word else { continue };
        let here = walk.at.position[axis as usize];
        if !is_absolute(word, walk.at.modes.distance)
            && let Some(nanos) = walk.at.resolve(word, here)
        {
            *word = write::at(nanos, axis, unit);
        }
    }
    Ok(op)
}
