//! Surfaces that tools leave over the cells of a row, four cells at once.
//!
//! Along a line, cells lie `s` along it and `d` across ([`Across`]).

use std::ops::Range;

use wide::{CmpGe, CmpGt, CmpLe, CmpLt, f32x4};

use crate::map::Grid;

/// Cells that are worked on together: compilers make one instruction of what is done to four.
pub(crate) const LANES: usize = 4;

/// Their places, from the first of them.
pub(crate) const COUNT: f32x4 = f32x4::new([0.0, 1.0, 2.0, 3.0]);

/// Steps by which the place is found where a round corner touches: each halves what is not known.
const HALVINGS: usize = 10;

/// A visitor of the surface that a move leaves, row by row.
pub(crate) trait Cells {
    /// The grid of the cells.
    fn grid(&self) -> Grid;

    /// Rows of these columns come.
    fn reaches(&mut self, rows: &Range<usize>, columns: &Range<usize>);

    /// The surface over some cells of a row.
    fn row(&mut self, row: usize, columns: Range<usize>, surface: impl Surface);
}

/// A surface over cells of a row. No closure, because each must be part of the loop over the cells.
pub(crate) trait Surface: Copy {
    /// Its heights over four cells, counted from the first one of these; an infinite one is no surface.
    fn at(&self, i: f32x4) -> f32x4;

    /// A height that it does not go below over the first so many cells.
    fn least(&self, cells: usize) -> f32;
}

/// The values that all surfaces along a line share.
#[derive(Clone, Copy)]
pub(super) struct Sloped {
    pub(super) at: Across,
    /// Height of the band's lowest point at the start, mm.
    pub(super) floor: f32,
    /// By how much that rises, a mm.
    pub(super) rise: f32,
    /// Square of the band's radius.
    pub(super) outer: f32,
}

impl Sloped {
    /// The band's lowest point anywhere on the way.
    #[inline(always)]
    pub(super) fn bottom(&self) -> f32 {
        self.floor + (self.rise * self.at.length).min(0.0)
    }

    /// How far along the way the band touches what is so far from it.
    #[inline(always)]
    pub(super) fn half(&self, d: f32x4) -> f32x4 {
        not_below_zero(f32x4::splat(self.outer) - d * d).sqrt()
    }
}

/// A surface along a line, where a tool of that radius comes.
#[derive(Clone, Copy)]
pub(super) struct Within<W> {
    pub(super) way: W,
    pub(super) at: Across,
    /// Square of the radius.
    pub(super) outer: f32,
}

impl<W: Surface> Surface for Within<W> {
    #[inline(always)]
    fn at(&self, i: f32x4) -> f32x4 {
        let (s, d) = self.at.of(i);
        let e = s - self.at.clamped(s);
        let inside = (d * d + e * e).cmp_le(f32x4::splat(self.outer));
        inside.blend(self.way.at(i), f32x4::splat(f32::INFINITY))
    }

    #[inline(always)]
    fn least(&self, cells: usize) -> f32 {
        self.way.least(cells)
    }
}

/// A level bottom on a level way.
#[derive(Clone, Copy)]
pub(super) struct Level(pub(super) f32);

impl Surface for Level {
    #[inline(always)]
    fn at(&self, _i: f32x4) -> f32x4 {
        f32x4::splat(self.0)
    }

    #[inline(always)]
    fn least(&self, _cells: usize) -> f32 {
        self.0
    }
}

/// A level bottom: the lowest end of what touches.
#[derive(Clone, Copy)]
pub(super) struct Flat(pub(super) Sloped);

impl Surface for Flat {
    #[inline(always)]
    fn at(&self, i: f32x4) -> f32x4 {
        let own = &self.0;
        let (s, d) = own.at.of(i);
        let half = own.half(d);
        let half = if own.rise < 0.0 { half } else { -half };
        own.at.clamped(s + half) * own.rise + own.floor
    }

    #[inline(always)]
    fn least(&self, _cells: usize) -> f32 {
        self.0.bottom()
    }
}

/// A ball.
#[derive(Clone, Copy)]
pub(super) struct Ball {
    pub(super) own: Sloped,
    pub(super) radius: f32,
    pub(super) square: f32,
    /// How far ahead of a cell its tip is when it comes lowest there, in parts of its radius there.
    pub(super) ahead: f32,
}

impl Surface for Ball {
    #[inline(always)]
    fn at(&self, i: f32x4) -> f32x4 {
        let own = &self.own;
        let (s, d) = own.at.of(i);
        let left = f32x4::splat(self.square) - d * d;
        let free = not_below_zero(left).sqrt() * self.ahead;
        // Of a whole ball it is never as much as its half.
        let free = if self.square > own.outer {
            let most = own.half(d);
            between(free, -most, most)
        } else {
            free
        };
        let t = own.at.clamped(s - free);
        let e = s - t;
        t * own.rise + (own.floor + self.radius) - not_below_zero(left - e * e).sqrt()
    }

    #[inline(always)]
    fn least(&self, cells: usize) -> f32 {
        let d = self.own.at.nearest(cells);
        self.own.bottom() + self.radius - (self.square - d * d).max(0.0).sqrt()
    }
}

/// Round corners on a level way.
#[derive(Clone, Copy)]
pub(super) struct LevelRound {
    pub(super) own: Sloped,
    pub(super) round: Round,
}

impl Surface for LevelRound {
    #[inline(always)]
    fn at(&self, i: f32x4) -> f32x4 {
        let (s, d) = self.own.at.of(i);
        let e = s - self.own.at.clamped(s);
        self.round.height(d * d + e * e) + self.own.floor
    }

    #[inline(always)]
    fn least(&self, cells: usize) -> f32 {
        let d = self.own.at.nearest(cells);
        self.own.bottom() + self.round.least(d * d)
    }
}

/// Round corners on a slope.
#[derive(Clone, Copy)]
pub(super) struct SlopedRound {
    pub(super) own: Sloped,
    pub(super) round: Round,
}

impl Surface for SlopedRound {
    #[inline(always)]
    fn at(&self, i: f32x4) -> f32x4 {
        let own = &self.own;
        let (s, d) = own.at.of(i);
        // Below the level part of the low end, and beyond it, none of the way is as low.
        let low = if own.rise < 0.0 { own.at.length } else { 0.0 };
        let e = s - low;
        let square = d * d + e * e;
        let beyond = if own.rise < 0.0 { e } else { -e };
        let inner = f32x4::splat(self.round.inner * self.round.inner);
        if (beyond.cmp_ge(f32x4::ZERO) | square.cmp_le(inner)).all() {
            return self.round.height(square) + own.bottom();
        }
        let t = own.at.clamped(s - self.round.touch(d, own.rise));
        let e = s - t;
        t * own.rise + self.round.height(d * d + e * e) + own.floor
    }

    #[inline(always)]
    fn least(&self, cells: usize) -> f32 {
        let d = self.own.at.nearest(cells);
        self.own.bottom() + self.round.least(d * d)
    }
}

/// A cone that is level within.
#[derive(Clone, Copy)]
pub(super) struct Cone {
    pub(super) own: Sloped,
    pub(super) slope: f32,
    pub(super) inner: f32,
    /// How far ahead of a cell its tip is when it comes lowest there, in parts of their distance across.
    pub(super) ahead: f32,
    /// On a way that is steeper than the cone, the sense in which it is steep: its rim comes lowest. Else 0.
    pub(super) beside: f32,
    /// 1 uphill, -1 downhill.
    pub(super) sense: f32,
}

impl Surface for Cone {
    #[inline(always)]
    fn at(&self, i: f32x4) -> f32x4 {
        let own = &self.own;
        let (s, d) = own.at.of(i);
        let (most, level) = (own.half(d), f32x4::splat(self.inner * self.inner) - d * d);
        let free = d.abs() * self.ahead + most * self.beside;
        // Within the level part, its edge is the lowest.
        let edge = not_below_zero(level).sqrt() * self.sense;
        let free = (free * free).cmp_lt(level).blend(edge, free);
        let t = own.at.clamped(s - between(free, -most, most));
        let e = s - t;
        t * own.rise + not_below_zero((d * d + e * e).sqrt() - self.inner) * self.slope + own.floor
    }

    #[inline(always)]
    fn least(&self, cells: usize) -> f32 {
        let beyond = (self.own.at.nearest(cells) - self.inner).max(0.0);
        self.own.bottom() + beyond * self.slope
    }
}

/// Coordinates of the cells of a row along and across a line.
#[derive(Clone, Copy)]
pub(super) struct Across {
    pub(super) s: f32,
    pub(super) d: f32,
    pub(super) ds: f32,
    pub(super) dd: f32,
    pub(super) length: f32,
}

impl Across {
    #[inline(always)]
    pub(super) fn of(&self, i: f32x4) -> (f32x4, f32x4) {
        (i * self.ds + self.s, i * self.dd + self.d)
    }

    /// The least distance of the first so many cells from the line, which goes on at both ends.
    #[inline(always)]
    pub(super) fn nearest(&self, cells: usize) -> f32 {
        let last = self.d + (cells as i32 as f32 - 1.0) * self.dd;
        let (one, other) = (self.d.abs(), last.abs());
        // Not by `f32::min`, which asks for what is no number.
        let least = if one < other { one } else { other };
        if self.d * last <= 0.0 { 0.0 } else { least }
    }

    #[inline(always)]
    pub(super) fn clamped(&self, t: f32x4) -> f32x4 {
        between(t, f32x4::ZERO, f32x4::splat(self.length))
    }
}

#[inline(always)]
pub(crate) fn between(value: f32x4, low: f32x4, high: f32x4) -> f32x4 {
    value.fast_max(low).fast_min(high)
}

#[inline(always)]
pub(crate) fn not_below_zero(value: f32x4) -> f32x4 {
    value.fast_max(f32x4::ZERO)
}

/// Round corners of a tool that is flat within.
#[derive(Clone, Copy)]
pub(super) struct Round {
    pub(super) inner: f32,
    pub(super) radius: f32,
    pub(super) outer: f32,
}

impl Round {
    #[inline(always)]
    pub(super) fn height(&self, square: f32x4) -> f32x4 {
        let beyond = not_below_zero(square.sqrt() - self.inner);
        let all = f32x4::splat(self.radius * self.radius);
        f32x4::splat(self.radius) - not_below_zero(all - beyond * beyond).sqrt()
    }

    /// The height at a distance, which is given as its square.
    #[inline(always)]
    pub(super) fn least(&self, square: f32) -> f32 {
        self.height(f32x4::splat(square)).to_array()[0]
    }

    /// How far the tip is from the foot of a cell where the tool, which rises, comes lowest over it. There
    ///
    /// ```text
    /// q / √(ρ² − q²) · √(r² − d²) / r = m,   r = inner + q
    /// ```
    #[inline(always)]
    pub(super) fn touch(&self, d: f32x4, rise: f32) -> f32x4 {
        let (d2, m2, p2) = (d * d, f32x4::splat(rise * rise), f32x4::splat(self.radius * self.radius));
        let inner = f32x4::splat(self.inner);
        let mut low = not_below_zero(d.abs() - inner);
        let mut high = f32x4::splat(self.outer - self.inner);
        for _ in 0..HALVINGS {
            let q = (low + high) * 0.5;
            let (r, q2) = (inner + q, q * q);
            let r2 = r * r;
            let beyond = (q2 * (r2 - d2)).cmp_gt(m2 * r2 * (p2 - q2));
            high = beyond.blend(q, high);
            low = beyond.blend(low, q);
        }
        let r = inner + (low + high) * 0.5;
        not_below_zero(r * r - d2).sqrt() * if rise < 0.0 { -1.0 } else { 1.0 }
    }
}
