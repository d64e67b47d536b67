//! Bands: the rings of which the lower surface of a tool is made.
//!
//! ```text
//!        │      ╱         z = base + slope · (r − inner)     a cone; within `inner` it is level
//!        │ ____╱          z = base + ρ − √(ρ² − (r − inner)²) a round corner of radius ρ
//!        0  inner outer
//! ```
//!
//! A band is a part of the tool: what lies above it, up to its outer radius, is tool.

/// How a band rises from its inner to its outer radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Form {
    /// Not at all.
    Flat,
    /// By so much a mm.
    Cone(f64),
    /// Along a quarter of a circle of this radius, mm.
    Round(f64),
}

/// A ring of a tool's lower surface. Lengths in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Band {
    /// The radius from which its surface rises.
    pub(crate) inner: f64,
    /// Its outer radius.
    pub(crate) outer: f64,
    /// Its least height above the tip.
    pub(crate) base: f64,
    /// How it rises.
    pub(crate) form: Form,
}

impl Band {
    pub(crate) fn flat(outer: f64, base: f64) -> Band {
        Band { inner: outer, outer, base, form: Form::Flat }
    }

    pub(crate) fn cone(inner: f64, outer: f64, base: f64, slope: f64) -> Band {
        Band { inner, outer, base, form: Form::Cone(slope) }
    }

    /// The radius of its round corner, mm; 0 of others.
    #[inline(always)]
    pub(crate) fn round(&self) -> f64 {
        if let Form::Round(radius) = self.form { radius } else { 0.0 }
    }

    /// Rise of its cone, mm a mm; 0 of others.
    #[inline(always)]
    pub(crate) fn slope(&self) -> f64 {
        if let Form::Cone(slope) = self.form { slope } else { 0.0 }
    }

    /// Its height above the tip at a distance from the axis, at most `outer`.
    #[inline]
    pub(crate) fn height(&self, distance: f64) -> f64 {
        let beyond = (distance - self.inner).max(0.0);
        self.base
            + match self.form {
                Form::Flat => 0.0,
                Form::Cone(slope) => slope * beyond,
                Form::Round(radius) => radius - (radius * radius - beyond * beyond).max(0.0).sqrt(),
            }
    }
}
