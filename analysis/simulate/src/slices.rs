//! Tools that lean: convex bodies of revolution, and where a vertical line meets them on a straight way.
//!
//! A tool is cut along its axis into slices, each between two levels `g` above the tip, where it is no wider than a cone or
//! a ball:
//!
//! ```text
//! r ≤ ρ + k·g                a cone; a cylinder where k is 0
//! r² + (g − m)² ≤ ρ²         a ball about the level m
//! ```
//!
//! Of a point at height z over a cell, seen from the tip when that has gone t along its way, `r² − …` is a polynomial of
//! second degree in t and z. So the heights between which the line over the cell meets the sweep of a slice are the least
//! and the greatest z of a region of the plane (t, z) that a conic section and four straight lines bound: they lie where two
//! of these meet, or where the conic is level. All of these places are looked at.

use crate::band::{Band, Form};
use crate::tool::Cutter;

/// Longer than any way out of a raw part, mm: a tool that ends nowhere.
pub(crate) const ENDLESS: f64 = 1e5;

/// So far outside a slice a place may lie that counts as one of it, mm.
const NEAR: f64 = 1e-8;

/// Slices of a round corner that are looked at first, radians.
const COARSE: f64 = 0.25;

/// The slice that counts, and each beside it, is cut into so many.
const FINER: usize = 4;

/// How far the rings are apart through whose heights a parabola is laid, radians: one time after the other.
const APART: [f64; 4] = [0.06, 0.01, 0.002, 0.000_5];

/// A height that finer slices twice, or the next parabola, change by less is known, mm.
const KNOWN: f64 = 0.000_003;

/// A part of a tool between two levels.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Slice {
    /// Where it begins and ends above the tip, mm.
    levels: [f64; 2],
    /// Its radii there, mm.
    radii: [f64; 2],
    /// Level of the centre of a ball, and its radius; `None` for a cone.
    ball: Option<[f64; 2]>,
}

impl Slice {
    fn cone(levels: [f64; 2], radii: [f64; 2]) -> Slice {
        Slice { levels, radii, ball: None }
    }

    /// The factors of `w² − β·g² + γ·g + δ`, which is 0 on its surface; w: from the tip.
    fn factors(&self) -> [f64; 3] {
        match self.ball {
            Some([middle, radius]) => [0.0, -2.0 * middle, middle * middle - radius * radius],
            None => {
                let [low, high] = self.levels;
                let k = if low < high { (self.radii[1] - self.radii[0]) / (high - low) } else { 0.0 };
                let foot = self.radii[0] - k * low;
                [1.0 + k * k, -2.0 * k * foot, -foot * foot]
            }
        }
    }

    /// How far it reaches in a direction whose parts along its axis and across it are these, from the tip, mm.
    fn reach(&self, along: f64, across: f64) -> f64 {
        if let Some([middle, radius]) = self.ball
            && (self.levels[0]..=self.levels[1]).contains(&(middle + radius * along))
        {
            return middle * along + radius;
        }
        let ring = |n: usize| self.levels[n] * along + self.radii[n] * across;
        ring(0).max(ring(1))
    }
}

/// A round corner about a level disc: cones between rings, as many as it takes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Corner {
    /// Radius of the disc, mm.
    inner: f64,
    /// Where it begins above the tip, mm.
    base: f64,
    /// Its own radius, mm.
    radius: f64,
    /// The angle about its centre at which it ends; it begins straight below that, at 0.
    end: f64,
}

impl Corner {
    /// Level and radius of the ring at an angle.
    fn ring(&self, angle: f64) -> [f64; 2] {
        let (sin, cos) = angle.sin_cos();
        [self.base + self.radius * (1.0 - cos), self.inner + self.radius * sin]
    }

    /// The cone between two angles.
    fn slice(&self, low: f64, high: f64) -> Slice {
        let [[low, thin], [high, wide]] = [low, high].map(|angle| self.ring(angle));
        Slice::cone([low, high], [thin, wide])
    }

    fn reach(&self, along: f64, across: f64) -> f64 {
        let of = |angle: f64| {
            let [level, radius] = self.ring(angle);
            level * along + radius * across
        };
        let touch = across.atan2(-along);
        of(0.0).max(of(self.end)).max(if touch < self.end { of(touch) } else { f64::NEG_INFINITY })
    }

    fn end_at(&mut self, top: f64) {
        self.end = self.end.min((1.0 - (top - self.base) / self.radius).clamp(-1.0, 1.0).acos());
    }
}

/// A convex part of a tool: all of its slices, and a round corner.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Convex {
    slices: Vec<Slice>,
    corner: Option<Corner>,
}

impl Convex {
    /// The convex parts of a cutter up to a level above its tip. They begin so much higher as `lift` says, and end as much
    /// lower.
    pub(crate) fn of(cutter: &Cutter, top: f64, lift: f64) -> Vec<Convex> {
        let upper = cutter.upper().and_then(|upper| upper.bands().first());
        let all = cutter.bands().iter().map(|band| match upper {
            Some(upper) => Convex::on_neck(band, upper, lift),
            None => Convex::of_band(band, top - 2.0 * lift).raised(lift),
        });
        all.filter(|own| !own.is_empty()).collect()
    }

    /// A ball, which is thinner on all sides where its band is, or a disc.
    fn on_neck(band: &Band, upper: &Band, lift: f64) -> Convex {
        let slice = match band.form {
            Form::Round(radius) => {
                let (middle, radius) = (band.base + radius, band.outer);
                Slice {
                    levels: [middle - radius, middle + radius],
                    radii: [0.0; 2],
                    ball: Some([middle, radius]),
                }
            }
            Form::Flat | Form::Cone(_) => {
                Slice::cone([band.base + lift, -upper.base - lift], [band.outer; 2])
            }
        };
        Convex { slices: vec![slice], corner: None }
    }

    fn of_band(band: &Band, top: f64) -> Convex {
        let mut own = Convex::default();
        let (inner, outer, base) = (band.inner, band.outer, band.base);
        let rim = band.height(outer);
        match band.form {
            Form::Round(radius) if inner == 0.0 => own.slices.push(Slice {
                levels: [base, rim],
                radii: [0.0, outer],
                ball: Some([base + radius, radius]),
            }),
            Form::Round(radius) => {
                let end = ((outer - inner) / radius).clamp(0.0, 1.0).asin();
                own.corner = Some(Corner { inner, base, radius, end });
            }
            Form::Cone(_) => own.slices.push(Slice::cone([base, rim], [inner, outer])),
            Form::Flat => {}
        }
        own.slices.push(Slice::cone([rim, top.max(rim)], [outer; 2]));
        own.up_to(top)
    }

    fn raised(mut self, by: f64) -> Convex {
        for slice in &mut self.slices {
            slice.levels = slice.levels.map(|level| level + by);
            slice.ball = slice.ball.map(|[middle, radius]| [middle + by, radius]);
        }
        self.corner = self.corner.map(|corner| Corner { base: corner.base + by, ..corner });
        self
    }

    /// The same without what is above a level.
    pub(crate) fn up_to(&self, top: f64) -> Convex {
        let mut own = self.clone();
        own.slices.iter_mut().for_each(|slice| slice.end_at(top));
        own.slices.retain(|slice| slice.levels[1] > slice.levels[0]);
        own.corner = own.corner.filter(|corner| top > corner.base);
        own.corner.iter_mut().for_each(|corner| corner.end_at(top));
        own
    }

    /// How far it reaches in a direction whose parts along its axis and across it are these, from the tip, mm.
    pub(crate) fn reach(&self, along: f64, across: f64) -> f64 {
        let slices = self.slices.iter().map(|slice| slice.reach(along, across));
        let corner = self.corner.iter().map(|corner| corner.reach(along, across));
        slices.chain(corner).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Whether nothing of it is left.
    pub(crate) fn is_empty(&self) -> bool {
        self.slices.is_empty() && self.corner.is_none()
    }

    /// Its largest radius, mm.
    fn radius(&self) -> f64 {
        self.reach(0.0, 1.0)
    }
}

impl Slice {
    /// Takes away what is above a level.
    fn end_at(&mut self, top: f64) {
        let [low, high] = self.levels;
        if top >= high {
            return;
        }
        let part = (top - low) / (high - low);
        self.radii[1] = match self.ball {
            Some([middle, radius]) => (radius * radius - (top - middle).powi(2)).max(0.0).sqrt(),
            None => self.radii[0] + part * (self.radii[1] - self.radii[0]),
        };
        self.levels[1] = top;
    }
}

/// A straight way of a tool that leans.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leg {
    from: [f64; 3],
    /// Its direction; nothing where it goes nowhere.
    along: [f64; 3],
    length: f64,
    /// The tool's axis, from the tip to the holder.
    axis: [f64; 3],
}

fn dot(one: [f64; 3], other: [f64; 3]) -> f64 {
    one[0] * other[0] + one[1] * other[1] + one[2] * other[2]
}

impl Leg {
    pub(crate) fn new([from, to]: [[f64; 3]; 2], axis: [f64; 3]) -> Leg {
        let way = [0, 1, 2].map(|n: usize| to[n] - from[n]);
        let length = dot(way, way).sqrt();
        match length < 1e-9 {
            true => Leg { from, along: [0.0; 3], length: 0.0, axis },
            false => Leg { from, along: way.map(|part| part / length), length, axis },
        }
    }

    /// How far a part of the tool reaches in a direction, a unit vector, on this way.
    pub(crate) fn reach(&self, part: &Convex, towards: [f64; 3]) -> f64 {
        let along = dot(self.axis, towards);
        let ahead = (dot(self.along, towards) * self.length).max(0.0);
        dot(self.from, towards) + ahead + part.reach(along, (1.0 - along * along).max(0.0).sqrt())
    }

    /// The level of a part above which it is above or below both heights on all of this way; endless where it never is.
    pub(crate) fn leaves(&self, part: &Convex, [low, high]: [f64; 2]) -> f64 {
        let rise = self.axis[2];
        let wide = part.radius() * (1.0 - rise * rise).max(0.0).sqrt();
        let ends = [self.from[2], self.from[2] + self.along[2] * self.length];
        let beyond = match rise > 0.0 {
            true => high - ends[0].min(ends[1]) + wide,
            false => low - ends[0].max(ends[1]) - wide,
        };
        if rise.abs() > 1e-6 { (beyond / rise).min(ENDLESS) } else { ENDLESS }
    }

    /// Directions across the shadow of this way and of the axis, and so many others.
    pub(crate) fn sides(&self, around: usize) -> impl Iterator<Item = [f64; 2]> {
        let across = [self.along, self.axis].into_iter().filter_map(|[x, y, _]| {
            let length = x.hypot(y);
            (length > 1e-9).then(|| [y / length, -x / length])
        });
        let even = (0..around).map(move |n| {
            let (sin, cos) = (std::f64::consts::TAU * n as f64 / around as f64).sin_cos();
            [cos, sin]
        });
        across.flat_map(|[x, y]| [[x, y], [-x, -y]]).chain(even)
    }

    /// Between which heights the vertical line at a place is within a part of the tool somewhere on the way.
    pub(crate) fn through(&self, part: &Convex, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        let mut all = Span::default();
        part.slices.iter().for_each(|slice| all.add(self.within(slice, [x, y])));
        if let Some(corner) = &part.corner {
            self.within_corner(corner, [x, y], &mut all);
        }
        all.heights()
    }

    /// Adds the same of a round corner.
    fn within_corner(&self, corner: &Corner, at: [f64; 2], all: &mut Span) {
        let [[low, _], [high, wide]] = [0.0, corner.end].map(|angle| corner.ring(angle));
        let around = self.within(&Slice::cone([low, high], [wide; 2]), at);
        // Nothing of it is beyond the cylinder around it.
        let is_beyond = [around.low < all.low, around.high > all.high];
        if around.heights().is_none() || is_beyond == [false; 2] {
            return;
        }
        let count = (corner.end / COARSE).ceil().max(1.0) as usize;
        let mut best = self.best(corner, [0.0, corner.end], count, at);
        if best.is_none() {
            // It meets the corner by a hair, if it does.
            best = self.best(corner, [0.0, corner.end], count * 16, at);
        }
        // From one slice to the next the highest place rises up to one of them, and falls from there; the lowest falls and
        // rises.
        for side in (0..2).filter(|side| is_beyond[*side]) {
            let Some(mut found) = best else { break };
            if let Some(height) = self.polish(corner, found.around[side], side == 1, at) {
                all.add(found.span);
                all.add_height(height);
                continue;
            }
            let mut sure = 0;
            while sure < 2 {
                let Some(finer) = self.best(corner, found.around[side], found.many[side] * FINER, at) else {
                    break;
                };
                let [before, after] = [found.span, finer.span].map(|span| [span.low, span.high][side]);
                sure = if (after - before).abs() < KNOWN { sure + 1 } else { 0 };
                all.add(found.span);
                found = finer;
            }
            all.add(found.span);
        }
    }

    /// The lowest or the highest place of a corner that lies between two angles, if it is one of a smooth curve: the vertex of
    /// a parabola through the heights of three rings, again and again.
    fn polish(&self, corner: &Corner, [begin, end]: [f64; 2], is_high: bool, at: [f64; 2]) -> Option<f64> {
        let height = |angle: f64| {
            let [level, radius] = corner.ring(angle);
            let own = self.within(&Slice::cone([level; 2], [radius; 2]), at);
            let height = if is_high { own.high } else { -own.low };
            height.is_finite().then_some(height)
        };
        let (mut middle, mut last) = (0.5 * (begin + end), f64::NAN);
        for apart in APART {
            middle = middle.clamp(apart, (corner.end - apart).max(apart));
            let [before, own, after] = [middle - apart, middle, middle + apart].map(height);
            let (before, own, after) = (before?, own?, after?);
            let bend = before - 2.0 * own + after;
            if bend >= 0.0 {
                return None;
            }
            let vertex = middle + apart * (0.5 * (before - after) / bend).clamp(-4.0, 4.0);
            middle = vertex.clamp(0.0, corner.end);
            let found = height(middle)?;
            if (found - last).abs() < KNOWN {
                return Some(if is_high { found.max(last) } else { -found.max(last) });
            }
            last = found;
        }
        None
    }

    /// Cuts a part of a corner into slices, and looks for the lowest and the highest place.
    fn best(&self, corner: &Corner, [begin, end]: [f64; 2], count: usize, at: [f64; 2]) -> Option<Best> {
        let step = (end - begin) / count as f64;
        let angle = |n: usize| (begin + step * n as f64).min(end);
        let mut best = Best { span: Span::default(), around: [[begin, end]; 2], many: [count; 2] };
        for n in 0..count {
            let own = self.within(&corner.slice(angle(n), angle(n + 1)), at);
            let near = [n.saturating_sub(1), (n + 2).min(count)];
            for (side, is_better) in
                [own.low < best.span.low, own.high > best.span.high].into_iter().enumerate()
            {
                if is_better {
                    (best.around[side], best.many[side]) = (near.map(angle), near[1] - near[0]);
                }
            }
            best.span.add(own);
        }
        (best.span.low <= best.span.high).then_some(best)
    }

    /// The same of a slice.
    fn within(&self, slice: &Slice, [x, y]: [f64; 2]) -> Span {
        let (n, d) = (self.axis, self.along);
        let foot = [x - self.from[0], y - self.from[1], 0.0];
        let [beta, gamma, delta] = slice.factors();
        let (nd, nz, dz) = (dot(n, d), n[2], d[2]);
        let (foot_n, foot_d) = (dot(foot, n), dot(foot, d));
        // In t and z, from where the way begins.
        let conic = Conic {
            tt: dot(d, d) - beta * nd * nd,
            zz: 1.0 - beta * nz * nz,
            tz: 2.0 * (beta * nz * nd - dz),
            t: 2.0 * (beta * foot_n * nd - foot_d) - gamma * nd,
            z: gamma * nz - 2.0 * beta * foot_n * nz,
            one: dot(foot, foot) - beta * foot_n * foot_n + gamma * foot_n + delta,
        };
        let level = |[t, z]: [f64; 2]| foot_n + z * nz - t * nd;
        let [low, high] = slice.levels;
        let is_between = |at: [f64; 2]| {
            let level = level(at);
            level >= low - NEAR && level <= high + NEAR && at[0] >= -NEAR && at[0] <= self.length + NEAR
        };
        let mut span = Span::default();
        let meet = |span: &mut Span, from: [f64; 2], way: [f64; 2]| {
            for at in conic.on(from, way).into_iter().flatten() {
                if is_between(at) {
                    span.add_height(at[1]);
                }
            }
        };
        meet(&mut span, [0.0, 0.0], [0.0, 1.0]);
        if self.length > 0.0 {
            meet(&mut span, [self.length, 0.0], [0.0, 1.0]);
            // Where the conic is level.
            if conic.tt.abs() > conic.tz.abs() {
                meet(&mut span, [-conic.t / (2.0 * conic.tt), 0.0], [-conic.tz / (2.0 * conic.tt), 1.0]);
            } else if conic.tz != 0.0 {
                meet(&mut span, [0.0, -conic.t / conic.tz], [1.0, -2.0 * conic.tt / conic.tz]);
            }
        }
        let size = slice.radii[0].max(slice.radii[1]).max(slice.ball.map_or(0.0, |ball| ball[1]));
        for level in slice.levels {
            if nz.abs() >= nd.abs() && nz != 0.0 {
                meet(&mut span, [0.0, (level - foot_n) / nz], [1.0, nd / nz]);
            } else if nd != 0.0 {
                meet(&mut span, [(foot_n - level) / nd, 0.0], [nz / nd, 1.0]);
            }
            if nz.abs() > 1e-12 {
                for t in [0.0, self.length] {
                    let at = [t, (level - foot_n + t * nd) / nz];
                    if conic.at(at) <= NEAR * size {
                        span.add_height(at[1]);
                    }
                }
            }
        }
        span.raised(self.from[2])
    }
}

/// A polynomial of second degree in t and z.
struct Conic {
    tt: f64,
    tz: f64,
    zz: f64,
    t: f64,
    z: f64,
    one: f64,
}

impl Conic {
    fn at(&self, [t, z]: [f64; 2]) -> f64 {
        (self.tt * t + self.tz * z + self.t) * t + (self.zz * z + self.z) * z + self.one
    }

    /// Where it is 0 on a line.
    fn on(&self, from: [f64; 2], way: [f64; 2]) -> [Option<[f64; 2]>; 2] {
        let [t, z] = from;
        let [dt, dz] = way;
        let a = (self.tt * dt + self.tz * dz) * dt + self.zz * dz * dz;
        let b =
            (2.0 * self.tt * t + self.tz * z + self.t) * dt + (2.0 * self.zz * z + self.tz * t + self.z) * dz;
        let c = self.at(from);
        let place = |s: f64| s.is_finite().then_some([t + s * dt, z + s * dz]);
        let left = b * b - 4.0 * a * c;
        if left < 0.0 {
            // A tip, which is a point, may seem to be none.
            return match left > -1e-12 * b * b {
                true => [place(-b / (2.0 * a)), None],
                false => [None; 2],
            };
        }
        let sum = -0.5 * (b + left.sqrt().copysign(b));
        [place(sum / a), place(c / sum)]
    }
}

/// The lowest and the highest place of a part of a corner, between which angles each of them is, and how many slices are there.
#[derive(Clone, Copy, Debug)]
struct Best {
    span: Span,
    around: [[f64; 2]; 2],
    many: [usize; 2],
}

/// Heights from the lowest to the highest; none where the lowest is above the highest.
#[derive(Clone, Copy, Debug)]
struct Span {
    low: f64,
    high: f64,
}

impl Default for Span {
    fn default() -> Span {
        Span { low: f64::INFINITY, high: f64::NEG_INFINITY }
    }
}

impl Span {
    fn add_height(&mut self, height: f64) {
        self.low = self.low.min(height);
        self.high = self.high.max(height);
    }

    fn add(&mut self, other: Span) {
        self.low = self.low.min(other.low);
        self.high = self.high.max(other.high);
    }

    fn raised(self, by: f64) -> Span {
        Span { low: self.low + by, high: self.high + by }
    }

    fn heights(self) -> Option<[f64; 2]> {
        (self.low < self.high).then_some([self.low, self.high])
    }
}
