//! Tools: the shape that cuts, the shank, the holder.

use std::f64::consts::FRAC_PI_2;

use crate::band::{Band, Form};

/// Pieces of a round corner in an outline.
const CORNERS: usize = 12;

/// Shapes of cutters, as catalogues have them. Lengths in mm, angles in degrees.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// End mill with a flat end, face mill, slot drill.
    Flat,
    /// End mill with a ball end.
    Ball,
    /// End mill with round corners.
    BullNose {
        /// Radius of the corners; at most that of the tool.
        corner: f64,
    },
    /// Drill, spot drill, countersink with a point.
    Drill {
        /// Full angle of the point, above 0 and below 180.
        point: f64,
    },
    /// Cone that ends flat: chamfer mill, face mill with inclined edges.
    Chamfer {
        /// Diameter of the end.
        tip: f64,
        /// Full angle of the cone, above 0 and below 180.
        angle: f64,
    },
    /// Tapered end mill: its diameter is that of the end, and it grows upwards.
    Taper {
        /// Radius of the corners of the end; 0 where they are sharp.
        corner: f64,
        /// Angle between its axis and its side, above 0 and below 90.
        angle: f64,
    },
    /// Any other tool of revolution: radius and height above the tip, from the tip outwards; straight between.
    Profile(
        /// Its points; neither value may fall.
        Vec<[f64; 2]>,
    ),
    /// Ball on a thinner neck.
    Lollipop,
    /// Disc on a thinner neck, as thick as its flutes are long.
    TSlot,
}

/// Why a tool has no [`Cutter`].
#[derive(Clone, Debug, PartialEq)]
pub enum CutterFault {
    /// A length that must be above zero, or an angle out of its range: its name and value.
    Value(&'static str, f64),
    /// The corners are larger than the tool.
    Corner {
        /// Radius of the corners, mm.
        corner: f64,
        /// Radius of the tool, mm.
        radius: f64,
    },
    /// The neck of a lollipop or T-slot cutter is no thinner than what cuts.
    Neck {
        /// Diameter of the neck, mm.
        neck: f64,
        /// Diameter of the tool, mm.
        diameter: f64,
    },
    /// A profile that becomes thinner upwards: it would cut under what stays.
    Undercut,
}

/// The surface that a turning tool has below, and above where it cuts under what stays.
#[derive(Clone, Debug, PartialEq)]
pub struct Cutter {
    bands: Vec<Band>,
    radius: f64,
    /// Its upper surface, as a tool upside down of which the tip is where the tip of this one is.
    upper: Option<Box<Cutter>>,
}

impl Cutter {
    /// The cutter of a shape with a diameter and a length of its flutes, mm.
    ///
    /// # Errors
    /// As [`CutterFault`] says.
    pub fn new(shape: &Shape, diameter: f64, flute: f64) -> Result<Cutter, CutterFault> {
        let above_zero = |name, value: f64| match value.is_finite() && value > 0.0 {
            true => Ok(value),
            false => Err(CutterFault::Value(name, value)),
        };
        let below = |name, value: f64, most: f64| match value > 0.0 && value < most {
            true => Ok(value.to_radians()),
            false => Err(CutterFault::Value(name, value)),
        };
        let round = |corner: f64, radius: f64| match (0.0..=radius).contains(&corner) {
            true => Ok(corner),
            false => Err(CutterFault::Corner { corner, radius }),
        };
        let radius = above_zero("diameter", diameter)? / 2.0;
        let bands = match shape {
            Shape::Flat => vec![Band::flat(radius, 0.0)],
            Shape::Ball => vec![Band { inner: 0.0, outer: radius, base: 0.0, form: Form::Round(radius) }],
            Shape::BullNose { corner } => match round(*corner, radius)? {
                0.0 => vec![Band::flat(radius, 0.0)],
                corner => {
                    vec![Band { inner: radius - corner, outer: radius, base: 0.0, form: Form::Round(corner) }]
                }
            },
            Shape::Drill { point } => {
                vec![Band::cone(0.0, radius, 0.0, cotangent(below("point", *point, 180.0)? / 2.0))]
            }
            Shape::Chamfer { tip, angle } => {
                let inner = tip / 2.0;
                if !(0.0..=radius).contains(&inner) {
                    return Err(CutterFault::Value("tip", *tip));
                }
                vec![Band::cone(inner, radius, 0.0, cotangent(below("angle", *angle, 180.0)? / 2.0))]
            }
            Shape::Taper { corner, angle } => {
                let (corner, side) = (round(*corner, radius)?, below("angle", *angle, 90.0)?);
                tapered(radius, corner, side, above_zero("flute", flute)?)
            }
            Shape::Profile(points) => profiled(points)?,
            Shape::Lollipop => vec![Band { inner: 0.0, outer: radius, base: 0.0, form: Form::Round(radius) }],
            Shape::TSlot => vec![Band::flat(radius, 0.0)],
        };
        let upper = match shape {
            Shape::Lollipop => {
                Some(Band { inner: 0.0, outer: radius, base: -2.0 * radius, form: Form::Round(radius) })
            }
            Shape::TSlot => Some(Band::flat(radius, -above_zero("flute", flute)?)),
            _ => None,
        };
        let radius = bands.iter().map(|band| band.outer).fold(0.0, f64::max);
        let upper = upper.map(|band| Box::new(Cutter { bands: vec![band], radius, upper: None }));
        Ok(Cutter { bands, radius, upper })
    }

    /// Its upper surface, as a tool upside down, of one that cuts under what stays.
    pub(crate) fn upper(&self) -> Option<&Cutter> {
        self.upper.as_deref()
    }

    /// The same with so much less radius.
    pub(crate) fn thinner(&self, by: f64) -> Cutter {
        let bands = self.bands.iter().map(|band| Band { outer: (band.outer - by).max(0.0), ..*band });
        let upper = self.upper.as_ref().map(|upper| Box::new(upper.thinner(by)));
        Cutter { bands: bands.collect(), radius: (self.radius - by).max(0.0), upper }
    }

    /// A cylinder that begins so high above the tip: a shank, a holder.
    pub(crate) fn cylinder(radius: f64, base: f64) -> Cutter {
        Cutter { bands: vec![Band::flat(radius, base)], radius, upper: None }
    }

    /// Its largest radius, mm.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Height of its surface above the tip at a distance from its axis, mm; `None` beyond its radius.
    pub fn height(&self, distance: f64) -> Option<f64> {
        let inside = self.bands.iter().filter(|band| distance <= band.outer);
        inside.map(|band| band.height(distance)).reduce(f64::min)
    }

    /// Its outline: radius and height above the tip, mm, from the axis outwards; straight between, round corners in
    /// twelve pieces.
    pub fn outline(&self) -> Vec<[f64; 2]> {
        let mut points: Vec<[f64; 2]> = vec![[0.0, self.height(0.0).unwrap_or(0.0)]];
        for band in &self.bands {
            let pieces = if matches!(band.form, Form::Round(_)) { CORNERS } else { 1 };
            points.push([band.inner, band.height(band.inner)]);
            points.extend((1..=pieces).map(|n| {
                // Even angles: the steep end of a quarter of a circle has as many pieces as the level one.
                let part = (FRAC_PI_2 * n as f64 / pieces as f64).sin();
                let radius = band.inner + (band.outer - band.inner) * part;
                [radius, band.height(radius)]
            }));
        }
        points.dedup();
        points
    }

    pub(crate) fn bands(&self) -> &[Band] {
        &self.bands
    }
}

fn cotangent(angle: f64) -> f64 {
    (FRAC_PI_2 - angle).tan()
}

/// Round corners, of radius `corner`, that go over into a side at an angle to the axis.
fn tapered(radius: f64, corner: f64, side: f64, flute: f64) -> Vec<Band> {
    // The corner touches the side where its normal is that of the side.
    let inner = radius - corner;
    let (touch, base) = (inner + corner * side.cos(), corner * (1.0 - side.sin()));
    let top = touch + (flute - base).max(0.0) * side.tan();
    let end = match corner {
        0.0 => Band::flat(radius, 0.0),
        _ => Band { inner, outer: touch, base: 0.0, form: Form::Round(corner) },
    };
    vec![end, Band::cone(touch, top, base, cotangent(side))]
}

/// Cones between points.
fn profiled(points: &[[f64; 2]]) -> Result<Vec<Band>, CutterFault> {
    let mut bands = Vec::new();
    if let Some([radius, height]) = points.first().filter(|point| point[0] > 0.0) {
        bands.push(Band::flat(*radius, *height));
    }
    for pair in points.windows(2) {
        let [[r0, z0], [r1, z1]] = [pair[0], pair[1]];
        if r1 < r0 || z1 < z0 {
            return Err(CutterFault::Undercut);
        }
        match r1 > r0 {
            true if z1 > z0 => bands.push(Band::cone(r0, r1, z0, (z1 - z0) / (r1 - r0))),
            true => bands.push(Band::flat(r1, z0)),
            false => {}
        }
    }
    match points.iter().flatten().find(|value| !value.is_finite() || **value < 0.0) {
        Some(value) => Err(CutterFault::Value("profile", *value)),
        None if bands.is_empty() => Err(CutterFault::Value("profile", 0.0)),
        None => Ok(bands),
    }
}

/// A tool with all that may touch something.
#[derive(Clone, Debug, PartialEq)]
pub struct Tool {
    /// Its number in the program.
    pub number: i64,
    /// What cuts.
    pub cutter: Cutter,
    /// Length of what cuts, from the tip, mm; `None` where not known.
    pub flute: Option<f64>,
    /// Radius of the shank above the flutes, mm; `None` where not known. Not looked at where `flute` is not known.
    pub shank: Option<f64>,
    /// Radius of the holder, and how high above the tip it begins, mm; `None` where not known.
    pub holder: Option<[f64; 2]>,
    /// Whether its shape is a guess: what rests on it is marked.
    pub guessed: bool,
}
