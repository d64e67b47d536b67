//! A straight way of a tool, seen from above.

use fearless_simd::{Simd, SimdBase, SimdFloat, f32x8};

use crate::band::Band;

/// A straight way of the tip, seen from above.
pub(crate) struct Line {
    pub(crate) from: [f64; 3],
    pub(crate) to: [f64; 3],
    /// Its direction.
    pub(crate) along: [f64; 2],
    pub(crate) length: f64,
    /// Its rise, mm a mm.
    pub(crate) rise: f64,
    /// Whether the tool has cut all that it cuts at the start of the line.
    pub(crate) continues: bool,
}

impl Line {
    #[inline]
    pub(crate) fn new([from, to]: [&[f64; 3]; 2], length: f64, continues: bool) -> Line {
        let [x, y] = [to[0] - from[0], to[1] - from[1]];
        if length < 1e-9 {
            // Straight down or up: what counts is the lower end.
            let low = [from[0], from[1], from[2].min(to[2])];
            let continues = continues && to[2] >= from[2];
            return Line { from: low, to: low, along: [1.0, 0.0], length: 0.0, rise: 0.0, continues };
        }
        // One division: each takes as long as the rest of this.
        let per_length = 1.0 / length;
        Line {
            from: *from,
            to: *to,
            along: [x * per_length, y * per_length],
            length,
            rise: (to[2] - from[2]) * per_length,
            continues,
        }
    }
}

/// The values that all surfaces along a line share.
#[derive(Clone, Copy)]
pub(crate) struct Sloped {
    /// Length of the line.
    pub(crate) length: f32,
    /// Height of the band's lowest point at the start, mm.
    pub(crate) floor: f32,
    /// By how much that rises, a mm.
    pub(crate) rise: f32,
    /// Square of the band's radius.
    pub(crate) outer: f32,
}

impl Sloped {
    #[inline(always)]
    pub(crate) fn of(line: &Line, band: &Band) -> Sloped {
        Sloped {
            length: line.length as f32,
            floor: (line.from[2] + band.base) as f32,
            rise: line.rise as f32,
            outer: (band.outer * band.outer) as f32,
        }
    }

    /// The band's lowest point anywhere on the way.
    #[inline(always)]
    pub(crate) fn bottom(&self) -> f32 {
        self.floor + (self.rise * self.length).min(0.0)
    }

    /// The square of the band's radius, less that of how far something is from the line.
    #[inline(always)]
    pub(crate) fn left<S: Simd>(&self, d: f32x8<S>) -> f32x8<S> {
        self.outer - d * d
    }

    /// Half of the stretch along which the band touches a place at this distance from the line.
    #[inline(always)]
    pub(crate) fn half<S: Simd>(&self, d: f32x8<S>) -> f32x8<S> {
        self.left(d).max(0.0).sqrt()
    }

    /// The place of the line next to this one.
    #[inline(always)]
    pub(crate) fn clamped<S: Simd>(&self, t: f32x8<S>) -> f32x8<S> {
        t.max(0.0).min(self.length)
    }

    /// Distance of a cell beyond the low end of the line: below zero on the line.
    #[inline(always)]
    pub(crate) fn beyond<S: Simd>(&self, s: f32x8<S>) -> f32x8<S> {
        if self.rise < 0.0 { s - self.length } else { -s }
    }
}
