//! The raw part and fixtures: as a user states them, or the raw part as it can be guessed from the moves.
//!
//! ```text
//! X0:100 Y0:60 Z-20:0    a block between these coordinates
//! D50 X10 Y10 Z-30:0     a cylinder along Z: its diameter, its axis, its ends
//! raw.stl                a body of triangles
//! ```
//!
//! Coordinates are those of the work offset in which the program cuts first, in mm.

use ncc_simulate::{Stock, Triangle, Way};

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

/// A body of triangles, if it has any with finite corners.
pub fn body(triangles: Vec<Triangle>) -> Option<Stock> {
    let finite =
        triangles.iter().flatten().flatten().all(|at| at.is_finite() && f64::from(at.abs()) <= FARTHEST);
    let stock = Stock::Body(triangles);
    let [low, high] = stock.extent();
    (finite && low[0] < high[0] && low[1] < high[1] && low[2] < high[2]).then_some(stock)
}

/// The raw part that the moves at feed need, and a margin around it.
///
/// Its top is program zero where the program cuts below it and not across above it: so programs are mostly written. Else it
/// is the highest cut across. `None` where nothing is cut.
pub fn guess(path: &Path, tools: &[Fitted]) -> Option<Stock> {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    let mut across = f64::NEG_INFINITY;
    let mut from = path.start;
    for own in &path.moves {
        let radius = tools[own.tool].tool.cutter.radius();
        let reach = match own.way {
            Way::Away | Way::Rapid => {
                from = own.end;
                continue;
            }
            Way::Feed => 0.0,
            // An arc stays within its circle.
            Way::Arc { plane, centre, .. } => {
                let [f, s, _] = plane.map(usize::from);
                (from[f] - centre[0]).hypot(from[s] - centre[1])
            }
        };
        let mut boxed = [from, own.end];
        if let Way::Arc { plane, centre, sweep } = own.way
            && sweep.abs() > std::f64::consts::FRAC_PI_2
        {
            for n in 0..2 {
                let axis = usize::from(plane[n]);
                boxed[0][axis] = boxed[0][axis].min(centre[n] - reach);
                boxed[1][axis] = boxed[1][axis].max(centre[n] + reach);
            }
        }
        for at in boxed {
            for axis in 0..2 {
                low[axis] = low[axis].min(at[axis] - radius);
                high[axis] = high[axis].max(at[axis] + radius);
            }
            low[2] = low[2].min(at[2]);
        }
        if from[..2] != own.end[..2] {
            across = across.max(from[2].min(own.end[2]));
        }
        from = own.end;
    }
    if !low[2].is_finite() {
        return None;
    }
    high[2] = if low[2] < 0.0 { across.max(0.0) } else { across };
    // All that is cut may be holes above zero.
    high[2] = high[2].max(low[2] + MARGIN);
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
