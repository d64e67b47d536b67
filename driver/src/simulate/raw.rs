//! The raw part and fixtures: as a user states them, or the raw part as it can be guessed from the moves.
//!
//! ```text
//! X0:100 Y0:60 Z-20:0    a block between these coordinates
//! D50 X10 Y10 Z-30:0     a cylinder along Z: its diameter, its axis, its ends
//! raw.stl                a body of triangles
//! ```
//!
//! Coordinates are those of the work offset in which the program cuts first, in mm.

use std::collections::BTreeSet;

use ncc_simulate::{Axes, HeightMap, Move, Stock, Triangle, Way, turned, turned_back};

use super::path::Path;
use super::tooling::Fitted;

/// How far a guessed raw part goes beyond the cuts, mm.
pub const MARGIN: f64 = 2.0;

/// How a user states a body.
#[derive(Clone, Debug, PartialEq)]
pub enum Stated {
    /// By coordinates.
    Shape(Stock),
    /// By the name of a file of triangles.
    File(String),
}

/// Why a text states no body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoBody {
    /// It is not of the form.
    Form,
    /// A range is empty or upside down, a diameter is not above zero, or a number is none that can be used.
    Range,
}

/// Reads how a body is stated.
///
/// # Errors
/// As [`NoBody`] says.
pub fn stated(text: &str) -> Result<Stated, NoBody> {
    if text.to_ascii_lowercase().ends_with(".stl") {
        return Ok(Stated::File(text.to_owned()));
    }
    let (mut ranges, mut diameter) = ([None; 3], None);
    for word in text.split([' ', ',']).filter(|word| !word.is_empty()) {
        let mut letters = word.chars();
        let letter = letters.next().map(|letter| letter.to_ascii_uppercase()).ok_or(NoBody::Form)?;
        let (low, high) = match letters.as_str().split_once(':') {
            Some((low, high)) => (number(low)?, number(high)?),
            None => (number(letters.as_str())?, number(letters.as_str())?),
        };
        let place = match letter {
            'X' => &mut ranges[0],
            'Y' => &mut ranges[1],
            'Z' => &mut ranges[2],
            'D' if low == high => {
                diameter = Some(low);
                continue;
            }
            _ => return Err(NoBody::Form),
        };
        if place.replace([low, high]).is_some() {
            return Err(NoBody::Form);
        }
    }
    let is_range = |range: [f64; 2]| range[0] < range[1];
    match (diameter, ranges) {
        (None, [Some(x), Some(y), Some(z)]) if [x, y, z].into_iter().all(is_range) => {
            Ok(Stated::Shape(Stock::Block { low: [x[0], y[0], z[0]], high: [x[1], y[1], z[1]] }))
        }
        (None, [Some(_), Some(_), Some(_)]) => Err(NoBody::Range),
        (Some(diameter), [x, y, Some(z)]) => {
            let centre = |range: Option<[f64; 2]>| match range.unwrap_or_default() {
                [low, high] if low == high => Ok(low),
                _ => Err(NoBody::Form),
            };
            let axis = [centre(x)?, centre(y)?];
            match diameter > 0.0 && is_range(z) {
                true => Ok(Stated::Shape(Stock::Cylinder { axis, radius: diameter / 2.0, between: z })),
                false => Err(NoBody::Range),
            }
        }
        _ => Err(NoBody::Form),
    }
}

/// Farther than any machine goes, mm.
const FARTHEST: f64 = 1e6;

fn number(text: &str) -> Result<f64, NoBody> {
    let value: f64 = text.parse().map_err(|_| NoBody::Form)?;
    if value.is_finite() && value.abs() <= FARTHEST { Ok(value) } else { Err(NoBody::Range) }
}

/// A body of triangles, if it has any with finite corners, and an upper side.
pub fn body(triangles: Vec<Triangle>) -> Option<Stock> {
    let finite =
        triangles.iter().flatten().flatten().all(|at| at.is_finite() && f64::from(at.abs()) <= FARTHEST);
    let stock = Stock::Body(triangles);
    let [low, high] = stock.extent();
    let is_body = finite && low[0] < high[0] && low[1] < high[1] && low[2] < high[2];
    // Walls without a top are none.
    (is_body && stock.map(256).highest() > HeightMap::NOTHING).then_some(stock)
}

/// Places of an arc: as many as a box needs.
fn places(from: [f64; 3], own: &Move, axes: Option<&Axes>) -> Vec<[f64; 3]> {
    let Way::Arc { plane, centre, sweep } = own.way else { return vec![from, own.end] };
    let [from, end] = [from, own.end].map(|at| axes.map_or(at, |axes| turned_back(axes, at)));
    let [f, s, n] = plane.map(usize::from);
    let arm = [from[f] - centre[0], from[s] - centre[1]];
    let count = (sweep.abs() / std::f64::consts::TAU * 128.0).ceil().clamp(1.0, 4096.0) as usize;
    let mut all = vec![from];
    for i in 1..count {
        let part = i as f64 / count as f64;
        let (sin, cos) = (sweep * part).sin_cos();
        let mut at = from;
        at[f] = centre[0] + arm[0] * cos - arm[1] * sin;
        at[s] = centre[1] + arm[0] * sin + arm[1] * cos;
        at[n] += part * (end[n] - from[n]);
        all.push(at);
    }
    all.push(end);
    all.into_iter().map(|at| axes.map_or(at, |axes| turned(axes, at))).collect()
}

/// A height in thousandths of a millimetre.
fn level(z: f64) -> i64 {
    (z * 1000.0).round() as i64
}

/// The raw part that the moves at feed need, and a margin around it.
///
/// Its top is program zero where the program cuts below it and not across above it: so programs are mostly written. Else it
/// is the highest cut across. Moves at feed at a height to which the tool is lifted are none: some posts write their rapids
/// so. Of a top above zero, rapids across are not below it. What is cut on a tilted plane lies within it. `None` where nothing is
/// cut.
pub fn guess(path: &Path, tools: &[Fitted]) -> Option<Stock> {
    let moves = || {
        let starts = std::iter::once(path.start).chain(path.moves.iter().map(|own| own.end));
        starts.zip(&path.moves)
    };
    let axes = |own: &Move| own.tilt.checked_sub(1).map(|n| &path.tilts[usize::from(n)]);
    let upright = |from: &[f64; 3], own: &Move| from[..2] == own.end[..2];
    let lifted: BTreeSet<i64> = moves()
        .filter(|(from, own)| own.tilt == 0 && upright(from, own) && own.end[2] > from[2])
        .map(|(_, own)| level(own.end[2]))
        .collect();
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    let (mut across, mut rapid) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut leaning = f64::NEG_INFINITY;
    for (from, own) in moves() {
        match own.way {
            Way::Away => continue,
            Way::Rapid => {
                if own.tilt == 0 && !upright(&from, own) {
                    rapid = rapid.min(from[2].max(own.end[2]));
                }
                continue;
            }
            Way::Feed | Way::Arc { .. } => {}
        }
        let radius = tools[own.tool].tool.cutter.radius();
        let all = places(from, own, axes(own));
        if let Some(axes) = axes(own) {
            // On its way down to the cut, it is beside the part.
            let axis = axes.map(|row| row[2]);
            let way: [f64; 3] = std::array::from_fn(|n| own.end[n] - from[n]);
            let comes_down = (0..3).map(|n| way[n] * axis[n]).sum::<f64>() < 0.0;
            let all = if comes_down { &all[all.len() - 1..] } else { &all[..] };
            for at in all {
                for n in 0..3 {
                    let wide = radius * (1.0 - axis[n] * axis[n]).max(0.0).sqrt();
                    low[n] = low[n].min(at[n] - wide);
                    high[n] = if n < 2 { high[n].max(at[n] + wide) } else { high[n] };
                }
                leaning = leaning.max(at[2]);
            }
            continue;
        }
        let level_at = level(from[2].min(own.end[2]));
        let lifted = lifted.contains(&level_at) && all.iter().all(|at| level(at[2]) >= level_at);
        if lifted && !upright(&from, own) {
            // The way to the next cut.
            continue;
        }
        for at in &all {
            for axis in 0..2 {
                low[axis] = low[axis].min(at[axis] - radius);
                high[axis] = high[axis].max(at[axis] + radius);
            }
            low[2] = low[2].min(at[2]);
        }
        if !upright(&from, own) {
            // A ridge is as high as the arc over it.
            let top = match own.way {
                Way::Arc { .. } => all.iter().map(|at| at[2]).fold(f64::NEG_INFINITY, f64::max),
                _ => from[2].min(own.end[2]),
            };
            across = across.max(top);
        }
    }
    if !low[2].is_finite() {
        return None;
    }
    // A rapid below zero may be the very fault that is looked for.
    high[2] = if low[2] < 0.0 { across.min(rapid).max(0.0) } else { across };
    high[2] = high[2].max(leaning);
    if high[2] <= low[2] {
        // All that is cut are holes above zero, or one level at zero.
        high[2] = low[2] + MARGIN;
    }
    for axis in 0..2 {
        low[axis] -= MARGIN;
        high[axis] += MARGIN;
    }
    low[2] -= MARGIN;
    Some(Stock::Block { low, high })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_are_stated_by_coordinates_or_files() {
        let block = Stock::Block { low: [0.0, -5.0, -20.0], high: [100.0, 60.0, 0.0] };
        assert_eq!(stated("X0:100 Y-5:60,Z-20:0"), Ok(Stated::Shape(block)));
        let cylinder = Stock::Cylinder { axis: [10.0, 0.0], radius: 25.0, between: [-30.0, 0.0] };
        assert_eq!(stated("d50 x10 z-30:0"), Ok(Stated::Shape(cylinder)));
        assert_eq!(stated("Raw.STL"), Ok(Stated::File("Raw.STL".to_owned())));
        for text in
            ["X100:0 Y0:1 Z0:1", "X0:0 Y0:1 Z0:1", "D0 Z0:1", "D5 Z1:1", "X0:1e9 Y0:1 Z0:1", "D50 Z0:inf"]
        {
            assert_eq!(stated(text), Err(NoBody::Range), "{text}");
        }
        for text in [
            "",
            "X0:1",
            "X0:1 Y0:1",
            "X0:1 X0:1 Y0:1 Z0:1",
            "Q0:1",
            "D5:6 Z0:1",
            "D5 X0:1 Z0:1",
            "Xa:b Y0:1 Z0:1",
            "X",
        ] {
            assert_eq!(stated(text), Err(NoBody::Form), "{text}");
        }
    }
}
