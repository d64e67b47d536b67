//! Surfaces that tools leave over the cells of a row, eight cells at once.
//!
//! Along a line, cells lie `s` along it and `d` across ([`Across`]).

use std::ops::Range;
use std::sync::LazyLock;

use fearless_simd::{Select, Simd, SimdBase, SimdFloat, SimdFrom, SimdMask, f32x8};

use crate::band::Band;
use crate::line::{Line, Sloped};
use crate::map::{Grid, LANES};

/// Vector instructions of this processor. All of them give the same results, bit by bit.
pub(crate) fn level() -> fearless_simd::Level {
    #[cfg(test)]
    if let Some(forced) = FORCED.get() {
        return forced;
    }
    static LEVEL: LazyLock<fearless_simd::Level> = LazyLock::new(fearless_simd::Level::new);
    *LEVEL
}

#[cfg(test)]
thread_local! {
    static FORCED: std::cell::Cell<Option<fearless_simd::Level>> = const { std::cell::Cell::new(None) };
}

/// Works with other vector instructions.
#[cfg(test)]
pub(crate) fn with_level<T>(level: fearless_simd::Level, work: impl FnOnce() -> T) -> T {
    FORCED.set(Some(level));
    let made = work();
    FORCED.set(None);
    made
}

/// Indices of the cells of a group whose first cell has index `first`.
#[inline(always)]
pub(crate) fn indices<S: Simd>(simd: S, first: usize) -> f32x8<S> {
    f32x8::simd_from(simd, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]) + first as i32 as f32
}

/// An endless height: the tool cuts no cell that has it.
#[inline(always)]
pub(crate) fn endless<S: Simd>(simd: S) -> f32x8<S> {
    f32x8::splat(simd, f32::INFINITY)
}

/// Steps of Newton's method by which the place is found where a round corner touches.
const STEPS: usize = 3;

/// A visitor of the surface that a move leaves, row by row.
pub(crate) trait Cells {
    /// Sums over the rows of one box. They are apart from the visitor so that they stay in registers from row to row.
    type Sums<S: Simd>: Copy;

    /// Whether narrow boxes are worked on as a whole, by [`Cells::narrow`]: faster, and more code.
    const TAKES_NARROW: bool;

    /// The grid of the cells.
    fn grid(&self) -> Grid;

    /// Begins a box of these rows and columns.
    fn begin<S: Simd>(&mut self, simd: S, rows: &Range<usize>, columns: &Range<usize>) -> Self::Sums<S>;

    /// The surface over some cells of a row, and a height that it does not go below.
    fn row<S: Simd>(
        &mut self,
        sums: Self::Sums<S>,
        simd: S,
        row: usize,
        columns: Range<usize>,
        surface_and_least: (impl Surface, f32),
    ) -> Self::Sums<S>;

    /// The surface along a line over all cells of a box with so few columns; `at` is that of its first cell.
    fn narrow<S: Simd, W: Along>(
        &mut self,
        sums: Self::Sums<S>,
        simd: S,
        rows_and_columns: [Range<usize>; 2],
        at: Across,
        along: W,
    ) -> Self::Sums<S>;

    /// Ends a box.
    fn end<S: Simd>(&mut self, sums: Self::Sums<S>);
}

/// A surface over cells of a row. No closure: a closure is no part of the code compiled for an instruction set.
pub(crate) trait Surface: Copy {
    /// Its heights over eight cells, counted from the first one of these; an infinite one is no surface.
    fn at<S: Simd>(&self, i: f32x8<S>) -> f32x8<S>;
}

/// A surface along a line, where the tool comes.
pub(crate) trait Along: Copy {
    /// Whether [`Along::over`] costs no more than the test whether it is needed.
    const IS_CHEAP: bool = false;

    /// Columns of a narrow box at most: in a wider one, the cells that are not touched take longer than asking where each row
    /// begins.
    const NARROW: usize = 2 * LANES;

    /// That of a band.
    fn of(line: &Line, band: &Band) -> Self;

    /// The values that it shares with the others.
    fn own(&self) -> &Sloped;

    /// Its heights over cells so far along the line and across it.
    fn over<S: Simd>(&self, s: f32x8<S>, d: f32x8<S>) -> f32x8<S>;

    /// Heights that it does not go below at these distances from the line or farther.
    fn least<S: Simd>(&self, nearest: f32x8<S>) -> f32x8<S>;
}

/// A surface along a line, over cells of a row.
#[derive(Clone, Copy)]
pub(crate) struct Row<W> {
    pub(crate) at: Across,
    pub(crate) along: W,
}

impl<W: Along> Surface for Row<W> {
    #[inline(always)]
    fn at<S: Simd>(&self, i: f32x8<S>) -> f32x8<S> {
        let (s, d) = self.at.of(i);
        self.along.over(s, d)
    }
}

/// A surface along a line, and endless beyond the radius of the tool.
#[derive(Clone, Copy)]
pub(super) struct Within<W>(pub(super) W);

impl<W: Along> Along for Within<W> {
    const IS_CHEAP: bool = W::IS_CHEAP;

    #[inline(always)]
    fn of(line: &Line, band: &Band) -> Self {
        Within(W::of(line, band))
    }

    #[inline(always)]
    fn own(&self) -> &Sloped {
        self.0.own()
    }

    #[inline(always)]
    fn over<S: Simd>(&self, s: f32x8<S>, d: f32x8<S>) -> f32x8<S> {
        let own = self.own();
        let e = s - own.clamped(s);
        (e * e).simd_le(own.left(d)).select(self.0.over(s, d), endless(s.simd))
    }

    #[inline(always)]
    fn least<S: Simd>(&self, nearest: f32x8<S>) -> f32x8<S> {
        self.0.least(nearest)
    }
}

/// A level bottom on a level way.
#[derive(Clone, Copy)]
pub(super) struct Level {
    pub(super) own: Sloped,
}

impl Along for Level {
    const NARROW: usize = 4 * LANES;
    const IS_CHEAP: bool = true;

    #[inline(always)]
    fn of(line: &Line, band: &Band) -> Level {
        Level { own: Sloped::of(line, band) }
    }

    #[inline(always)]
    fn own(&self) -> &Sloped {
        &self.own
    }

    #[inline(always)]
    fn over<S: Simd>(&self, s: f32x8<S>, _d: f32x8<S>) -> f32x8<S> {
        f32x8::splat(s.simd, self.own.floor)
    }

    #[inline(always)]
    fn least<S: Simd>(&self, nearest: f32x8<S>) -> f32x8<S> {
        f32x8::splat(nearest.simd, self.own.floor)
    }
}

/// A level bottom: the lowest end of what touches.
#[derive(Clone, Copy)]
pub(super) struct Flat {
    pub(super) own: Sloped,
    /// 1 downhill, -1 uphill. No branch: which of them comes next is not known before.
    pub(super) sense: f32,
}

impl Along for Flat {
    const NARROW: usize = 4 * LANES;

    #[inline(always)]
    fn of(line: &Line, band: &Band) -> Flat {
        Flat { own: Sloped::of(line, band), sense: if line.rise < 0.0 { 1.0 } else { -1.0 } }
    }

    #[inline(always)]
    fn own(&self) -> &Sloped {
        &self.own
    }

    #[inline(always)]
    fn over<S: Simd>(&self, s: f32x8<S>, d: f32x8<S>) -> f32x8<S> {
        let own = &self.own;
        own.clamped(s + own.half(d) * self.sense) * own.rise + own.floor
    }

    #[inline(always)]
    fn least<S: Simd>(&self, nearest: f32x8<S>) -> f32x8<S> {
        f32x8::splat(nearest.simd, self.own.bottom())
    }
}

/// The same of a wide tool on a short way: most cells are below its low end.
#[derive(Clone, Copy)]
pub(super) struct WideFlat(pub(super) Flat);

impl Along for WideFlat {
    const NARROW: usize = 4 * LANES;

    #[inline(always)]
    fn of(line: &Line, band: &Band) -> WideFlat {
        WideFlat(Flat::of(line, band))
    }

    #[inline(always)]
    fn own(&self) -> &Sloped {
        &self.0.own
    }

    #[inline(always)]
    fn over<S: Simd>(&self, s: f32x8<S>, d: f32x8<S>) -> f32x8<S> {
        let e = self.0.own.beyond(s);
        if (d * d + e * e).simd_le(self.0.own.outer).all_true() {
            return f32x8::splat(s.simd, self.0.own.bottom());
        }
        self.0.over(s, d)
    }

    #[inline(always)]
    fn least<S: Simd>(&self, nearest: f32x8<S>) -> f32x8<S> {
        f32x8::splat(nearest.simd, self.0.own.bottom())
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

impl Ball {
    /// [`Ball::ahead`] on a way that rises by so much a mm.
    #[inline(always)]
    pub(super) fn ahead(rise: f32) -> f32 {
        rise / (1.0 + rise * rise).sqrt()
    }
}

impl Along for Ball {
    #[inline(always)]
    fn of(line: &Line, band: &Band) -> Ball {
        let (own, radius) = (Sloped::of(line, band), band.round());
        Ball { own, radius: radius as f32, square: (radius * radius) as f32, ahead: Ball::ahead(own.rise) }
    }

    #[inline(always)]
    fn own(&self) -> &Sloped {
        &self.own
    }

    #[inline(always)]
    fn over<S: Simd>(&self, s: f32x8<S>, d: f32x8<S>) -> f32x8<S> {
        let own = &self.own;
        let left = self.square - d * d;
        let free = not_below_zero(left).sqrt() * self.ahead;
        // Of a whole ball it is never as much as its half.
        let free = if self.square > own.outer {
            let most = own.half(d);
            between(free, -most, most)
        } else {
            free
        };
        let t = own.clamped(s - free);
        let e = s - t;
        t * own.rise + (own.floor + self.radius) - not_below_zero(left - e * e).sqrt()
    }

    #[inline(always)]
    fn least<S: Simd>(&self, nearest: f32x8<S>) -> f32x8<S> {
        self.own.bottom() + self.radius - not_below_zero(self.square - nearest * nearest).sqrt()
    }
}

/// Round corners on a level way.
#[derive(Clone, Copy)]
pub(super) struct LevelRound {
    pub(super) own: Sloped,
    pub(super) round: Round,
}

impl Along for LevelRound {
    #[inline(always)]
    fn of(line: &Line, band: &Band) -> LevelRound {
        LevelRound { own: Sloped::of(line, band), round: Round::of(band) }
    }

    #[inline(always)]
    fn own(&self) -> &Sloped {
        &self.own
    }

    #[inline(always)]
    fn over<S: Simd>(&self, s: f32x8<S>, d: f32x8<S>) -> f32x8<S> {
        let e = s - self.own.clamped(s);
        self.round.height(d * d + e * e) + self.own.floor
    }

    #[inline(always)]
    fn least<S: Simd>(&self, nearest: f32x8<S>) -> f32x8<S> {
        self.own.bottom() + self.round.height(nearest * nearest)
    }
}

/// Round corners on a slope.
#[derive(Clone, Copy)]
pub(super) struct SlopedRound {
    pub(super) own: Sloped,
    pub(super) round: Round,
}

impl Along for SlopedRound {
    #[inline(always)]
    fn of(line: &Line, band: &Band) -> SlopedRound {
        SlopedRound { own: Sloped::of(line, band), round: Round::of(band) }
    }

    #[inline(always)]
    fn own(&self) -> &Sloped {
        &self.own
    }

    #[inline(always)]
    fn over<S: Simd>(&self, s: f32x8<S>, d: f32x8<S>) -> f32x8<S> {
        let own = &self.own;
        // Below the level part of the low end, and beyond it, none of the way is as low.
        let beyond = own.beyond(s);
        let square = d * d + beyond * beyond;
        let inner = self.round.inner * self.round.inner;
        if (beyond.simd_ge(0.0) | square.simd_le(inner)).all_true() {
            return self.round.height(square) + own.bottom();
        }
        let t = own.clamped(s - self.round.touch(d, own.rise));
        let e = s - t;
        t * own.rise + self.round.height(d * d + e * e) + own.floor
    }

    #[inline(always)]
    fn least<S: Simd>(&self, nearest: f32x8<S>) -> f32x8<S> {
        self.own.bottom() + self.round.height(nearest * nearest)
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

impl Along for Cone {
    #[inline(always)]
    fn of(line: &Line, band: &Band) -> Cone {
        let (own, slope) = (Sloped::of(line, band), band.slope() as f32);
        let rise = own.rise;
        let steep = rise.abs() >= slope;
        let ahead = if steep { 0.0 } else { rise / (slope * slope - rise * rise).sqrt() };
        let sense = if rise == 0.0 { 0.0 } else { rise.signum() };
        let beside = if steep { sense } else { 0.0 };
        Cone { own, slope, inner: band.inner as f32, ahead, beside, sense }
    }

    #[inline(always)]
    fn own(&self) -> &Sloped {
        &self.own
    }

    #[inline(always)]
    fn over<S: Simd>(&self, s: f32x8<S>, d: f32x8<S>) -> f32x8<S> {
        let own = &self.own;
        let (most, level) = (own.half(d), self.inner * self.inner - d * d);
        let free = d.abs() * self.ahead + most * self.beside;
        // Within the level part, its edge is the lowest.
        let edge = not_below_zero(level).sqrt() * self.sense;
        let free = (free * free).simd_lt(level).select(edge, free);
        let t = own.clamped(s - between(free, -most, most));
        let e = s - t;
        t * own.rise + not_below_zero((d * d + e * e).sqrt() - self.inner) * self.slope + own.floor
    }

    #[inline(always)]
    fn least<S: Simd>(&self, nearest: f32x8<S>) -> f32x8<S> {
        self.own.bottom() + not_below_zero(nearest - self.inner) * self.slope
    }
}

/// Coordinates of the cells of a row along and across a line.
#[derive(Clone, Copy)]
pub(crate) struct Across {
    pub(crate) s: f32,
    pub(crate) d: f32,
    pub(crate) ds: f32,
    pub(crate) dd: f32,
}

impl Across {
    /// The same of a cell so many rows and columns further.
    #[inline(always)]
    pub(crate) fn shifted(&self, row: usize, column: usize) -> Across {
        let (row, column) = (row as i32 as f32, column as i32 as f32);
        Across {
            s: self.s - row * self.dd + column * self.ds,
            d: self.d + row * self.ds + column * self.dd,
            ..*self
        }
    }

    #[inline(always)]
    pub(crate) fn of<S: Simd>(&self, i: f32x8<S>) -> (f32x8<S>, f32x8<S>) {
        (i * self.ds + self.s, i * self.dd + self.d)
    }
}

#[inline(always)]
pub(crate) fn between<S: Simd>(value: f32x8<S>, low: f32x8<S>, high: f32x8<S>) -> f32x8<S> {
    value.max(low).min(high)
}

#[inline(always)]
pub(crate) fn not_below_zero<S: Simd>(value: f32x8<S>) -> f32x8<S> {
    value.max(0.0)
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
    fn of(band: &Band) -> Round {
        Round { inner: band.inner as f32, radius: band.round() as f32, outer: band.outer as f32 }
    }

    #[inline(always)]
    pub(super) fn height<S: Simd>(&self, square: f32x8<S>) -> f32x8<S> {
        let beyond = not_below_zero(square.sqrt() - self.inner);
        self.radius - not_below_zero(self.radius * self.radius - beyond * beyond).sqrt()
    }

    /// How far the tip is from the foot of a cell where the tool, which rises, comes lowest over it. There
    ///
    /// ```text
    /// h(q) = q² · (1 + m² − d² / r²) − ρ² · m² = 0,   r = inner + q
    /// ```
    ///
    /// `h` is convex: a step of Newton's method from a lower bound ends above the root. The geometric mean of both bounds is
    /// the start. After [`STEPS`] steps more, the height is at most 0.04 µm too high, for corners up to 6 mm and slopes from
    /// 0.001 to 5.
    #[inline(always)]
    pub(super) fn touch<S: Simd>(&self, d: f32x8<S>, rise: f32) -> f32x8<S> {
        let (d2, m2) = (d * d, rise * rise);
        let least = self.radius * rise.abs() / (1.0 + m2).sqrt();
        let low = (d.abs() - self.inner).max(least);
        let mut q = (low * self.newton(low, low, d2, m2)).sqrt();
        for _ in 0..STEPS {
            q = self.newton(q, low, d2, m2);
        }
        let r = q + self.inner;
        not_below_zero(r * r - d2).sqrt() * if rise < 0.0 { -1.0 } else { 1.0 }
    }

    /// One step of Newton's method for [`Round::touch`].
    #[inline(always)]
    fn newton<S: Simd>(&self, q: f32x8<S>, low: f32x8<S>, d2: f32x8<S>, m2: f32) -> f32x8<S> {
        let per_r = 1.0 / (q + self.inner);
        let (part, d2_part) = (q * per_r, d2 * q * per_r);
        let h = q * q * (1.0 + m2) - d2_part * part - self.radius * self.radius * m2;
        let half_slope = q * (1.0 + m2) - d2_part * (1.0 - part) * per_r;
        // The slope is 0 only where rounding has lost it. The surface is nearly level there: any place will do.
        (q - h * 0.5 / half_slope.max(f32::MIN_POSITIVE)).max(low).min(self.outer - self.inner)
    }
}
