//! A tool as somebody describes it: a user, a profile, a comment. Not here: what is made of it (`tooling`).

use ncc_machines::schema::ShapeName;

/// A shape, as far as it is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Shaped {
    /// Its name.
    pub name: ShapeName,
    /// Radius of corners, mm.
    pub corner: Option<f64>,
    /// Angle, degrees, as the profile has it.
    pub angle: Option<f64>,
    /// Diameter of the end, mm.
    pub end_diameter: Option<f64>,
}

/// A tool, as far as somebody describes it. Lengths in mm.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Described {
    /// Its shape.
    pub shape: Option<Shaped>,
    /// Its diameter.
    pub diameter: Option<f64>,
    /// Length of what cuts.
    pub flute: Option<f64>,
    /// Diameter of the shank.
    pub shank: Option<f64>,
    /// Diameter of the holder.
    pub holder: Option<f64>,
    /// How high above the tip the holder begins.
    pub holder_from: Option<f64>,
}

impl Described {
    /// The same with lengths in another unit.
    #[must_use]
    pub(crate) fn times(mut self, unit: f64) -> Described {
        let shape = self.shape.as_mut();
        let (corner, end) =
            shape.map_or((None, None), |own| (own.corner.as_mut(), own.end_diameter.as_mut()));
        let others =
            [&mut self.diameter, &mut self.flute, &mut self.shank, &mut self.holder, &mut self.holder_from];
        let others = others.into_iter().filter_map(Option::as_mut);
        others.chain(corner).chain(end).for_each(|length| *length *= unit);
        self
    }

    /// What this does not say, by another one.
    #[must_use]
    pub(super) fn or(self, other: &Described) -> Described {
        Described {
            shape: self.shape.or_else(|| other.shape.clone()),
            diameter: self.diameter.or(other.diameter),
            flute: self.flute.or(other.flute),
            shank: self.shank.or(other.shank),
            holder: self.holder.or(other.holder),
            holder_from: self.holder_from.or(other.holder_from),
        }
    }
}
