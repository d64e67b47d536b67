//! Bolt circles: holes at equal angles about a centre.

use crate::fold::fold_patterns::Spot;
use crate::fold::fold_patterns::decimal::{Decimal, Range};
use ncc_ir::caps::CircleStart;
use ncc_ir::expr::num::POW10;

/// Most centres that are tried for one number of digits.
const MOST_CENTRES: i64 = 2000;

/// A bolt circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Circle {
    pub(super) centre: [Decimal; 2],
    pub(super) first: First,
    /// Degrees from hole to hole.
    pub(super) step: Decimal,
    pub(super) count: usize,
}

/// Where the first hole is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum First {
    /// As it is written.
    AsWritten,
    /// At a radius and an angle.
    Polar { radius: Decimal, angle: Decimal },
}

/// What is asked of a circle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wanted {
    /// Most digits after the point.
    pub(super) most: u8,
    /// A centre to try first: where the tool is.
    pub(super) here: Option<[f64; 2]>,
    /// How its first hole is stated.
    pub(super) start: CircleStart,
    /// Whether the centre must be where the tool is.
    pub(super) only_here: bool,
}

/// The circle of most holes from the first on.
pub(super) fn circle(spots: &[Spot], wanted: &Wanted) -> Option<Circle> {
    let at: Vec<[f64; 2]> = spots.iter().map(|s| s.at).collect();
    let mut count = rough(&at, spots.first()?.coarse());
    while count >= 3 {
        if let Some(found) = fit(&spots[..count], &at[..count], wanted) {
            return Some(found);
        }
        count = if count > 16 { count / 2 } else { count - 1 };
    }
    None
}

/// How many holes have equal chords with equal turns between them, as far as rough measure tells.
fn rough(at: &[[f64; 2]], half: f64) -> usize {
    let chord = |k: usize| [at[k + 1][0] - at[k][0], at[k + 1][1] - at[k][1]];
    let long = |c: [f64; 2]| c[0].hypot(c[1]);
    if at.len() < 3 {
        return 0;
    }
    let length = long(chord(0));
    if length <= 8.0 * half {
        return 0;
    }
    let turn = |k: usize| {
        let (a, b) = (chord(k), chord(k + 1));
        (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1])
    };
    let first = turn(0);
    let slack = 12.0 * half / length;
    // A turn of nothing is a line, of half a turn a way back.
    if first.abs() <= slack || first.abs() >= std::f64::consts::PI - slack {
        return 0;
    }
    let most = (std::f64::consts::TAU / (first.abs() - slack).max(1e-6)).floor() as usize;
    let whole = (std::f64::consts::TAU / first.abs()).round() as usize;
    let apart = |a: f64| (a + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
    let fits =
        |k: usize| (long(chord(k)) - length).abs() <= 6.0 * half && apart(turn(k - 1) - first).abs() <= slack;
    let holes = 2 + (1..at.len() - 1).take_while(|k| fits(*k)).count();
    holes.min(most.max(3)).min(whole.max(3))
}

/// The circle through the middle of all holes: centre and radius (Kåsa's fit).
fn middle(at: &[[f64; 2]]) -> Option<([f64; 2], f64)> {
    let n = at.len() as f64;
    let mean: [f64; 2] = std::array::from_fn(|i| at.iter().map(|p| p[i]).sum::<f64>() / n);
    let (mut xx, mut xy, mut yy, mut xr, mut yr) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for p in at {
        let (x, y) = (p[0] - mean[0], p[1] - mean[1]);
        let r = x * x + y * y;
        xx += x * x;
        xy += x * y;
        yy += y * y;
        xr += x * r;
        yr += y * r;
    }
    let determinant = 2.0 * (xx * yy - xy * xy);
    if determinant.abs() < 1e-12 {
        return None;
    }
    let centre = [mean[0] + (xr * yy - yr * xy) / determinant, mean[1] + (yr * xx - xr * xy) / determinant];
    let radius = at.iter().map(|p| (p[0] - centre[0]).hypot(p[1] - centre[1])).sum::<f64>() / n;
    (radius.is_finite() && radius < 1e6).then_some((centre, radius))
}

fn fit(spots: &[Spot], at: &[[f64; 2]], wanted: &Wanted) -> Option<Circle> {
    let (centre, radius) = middle(at)?;
    let half = spots[0].coarse();
    // The flatter the arc, the less is known of its centre.
    let last = at[at.len() - 1];
    let chord = (last[0] - at[0][0]).hypot(last[1] - at[0][1]);
    let turned = total(at, centre).abs();
    let sagitta = if turned >= std::f64::consts::PI {
        radius
    } else {
        radius - (radius * radius - chord * chord / 4.0).max(0.0).sqrt()
    };
    let slack = 4.0 * half * (radius / sagitta.max(half)).max(1.0) + half;
    let near = |c: [f64; 2]| (0..2).all(|i| (c[i] - centre[i]).abs() <= slack);
    if let Some(here) = wanted.here.filter(|here| near(*here)) {
        let exactly = here.map(|v| Decimal::near(v, 9));
        if let Some(found) = about(spots, exactly, wanted) {
            return Some(found);
        }
    }
    if wanted.only_here {
        return None;
    }
    for scale in 0..=wanted.most {
        let unit = POW10[scale as usize] as f64;
        let low: [i64; 2] = std::array::from_fn(|i| ((centre[i] - slack) * unit).ceil() as i64);
        let high: [i64; 2] = std::array::from_fn(|i| ((centre[i] + slack) * unit).floor() as i64);
        let sides = [high[0] - low[0] + 1, high[1] - low[1] + 1];
        if sides[0] <= 0 || sides[1] <= 0 {
            continue;
        }
        if sides[0].saturating_mul(sides[1]) > MOST_CENTRES {
            let nearest = centre.map(|v| Decimal::near(v, wanted.most));
            return about(spots, nearest, wanted);
        }
        let mut tried: Vec<[i64; 2]> =
            (low[0]..=high[0]).flat_map(|x| (low[1]..=high[1]).map(move |y| [x, y])).collect();
        let off = |c: &[i64; 2]| (c[0] as f64 / unit - centre[0]).hypot(c[1] as f64 / unit - centre[1]);
        tried.sort_by(|a, b| off(a).total_cmp(&off(b)));
        for candidate in tried {
            let candidate = candidate.map(|v| Decimal::near(v as f64 / unit, scale));
            if let Some(found) = about(spots, candidate, wanted) {
                return Some(found);
            }
        }
    }
    None
}

/// Radians from the first hole to the last, the way through all.
fn total(at: &[[f64; 2]], centre: [f64; 2]) -> f64 {
    at.windows(2).map(|pair| between(pair[0], pair[1], centre)).sum()
}

/// Radians from one point to another about a centre, the short way.
fn between(a: [f64; 2], b: [f64; 2], centre: [f64; 2]) -> f64 {
    let (a, b) = ([a[0] - centre[0], a[1] - centre[1]], [b[0] - centre[0], b[1] - centre[1]]);
    (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1])
}

/// The simplest circle about a centre.
fn about(spots: &[Spot], centre: [Decimal; 2], wanted: &Wanted) -> Option<Circle> {
    let c = centre.map(Decimal::value);
    let radii: Vec<f64> = spots.iter().map(|s| (s.at[0] - c[0]).hypot(s.at[1] - c[1])).collect();
    let slack = |spot: &Spot| spot.half[0].hypot(spot.half[1]);
    let mut radius = Range::ALL;
    for (r, spot) in radii.iter().zip(spots) {
        radius.keep(*r, slack(spot));
    }
    if radius.is_empty() || radius.low <= 8.0 * spots[0].coarse() {
        return None;
    }
    let of_angle = |spot: &Spot| (slack(spot) / radius.low).min(1.0).asin().to_degrees();
    // Degrees from the first hole, unrolled.
    let mut turned = vec![0.0];
    for pair in spots.windows(2) {
        turned.push(turned[turned.len() - 1] + between(pair[0].at, pair[1].at, c).to_degrees());
    }
    let mut steps = Range::ALL;
    for (k, angle) in turned.iter().enumerate().skip(1) {
        steps.keep(angle / k as f64, (of_angle(&spots[0]) + of_angle(&spots[k])) / k as f64);
    }
    if steps.is_empty() {
        return None;
    }
    let count = spots.len();
    let whole = 360.0 / count as f64 * turned[count - 1].signum();
    let mut tried: Vec<Decimal> = Vec::new();
    if steps.low <= whole && whole <= steps.high {
        tried.push(Decimal::near(whole, wanted.most));
    }
    tried.extend(steps.decimals(wanted.most));
    let first = spots[0].at;
    let start = (first[1] - c[1]).atan2(first[0] - c[0]).to_degrees();
    tried.into_iter().find_map(|step| {
        if step.mantissa == 0 {
            return None;
        }
        let written = (wanted.start != CircleStart::Polar && fits(spots, c, radii[0], start, step))
            .then_some(First::AsWritten);
        let polar = || polar(spots, c, radius, (start, &turned), step, wanted);
        let first = match wanted.start {
            CircleStart::Cartesian => written,
            CircleStart::Polar => polar(),
            CircleStart::Either => written.or_else(polar),
        }?;
        Some(Circle { centre, first, step, count })
    })
}

/// The simplest radius and angle of the first hole.
fn polar(
    spots: &[Spot],
    c: [f64; 2],
    radius: Range,
    (start, turned): (f64, &[f64]),
    step: Decimal,
    wanted: &Wanted,
) -> Option<First> {
    let mut angles = Range::ALL;
    for (k, angle) in turned.iter().enumerate() {
        let off = start + angle - k as f64 * step.value();
        let slack = spots[k].half[0].hypot(spots[k].half[1]);
        angles.keep(off, (slack / radius.low).min(1.0).asin().to_degrees());
    }
    let radii: Vec<Decimal> = radius.decimals(wanted.most).collect();
    let angles: Vec<Decimal> = angles.decimals(wanted.most).collect();
    let mut pairs: Vec<(Decimal, Decimal)> =
        radii.iter().flat_map(|r| angles.iter().map(move |a| (*r, *a))).collect();
    pairs.sort_by_key(|(r, a)| r.scale + a.scale);
    let found = pairs.into_iter().find(|(r, a)| fits(spots, c, r.value(), a.value(), step));
    found.map(|(radius, angle)| {
        let round = 360 * POW10[angle.scale as usize];
        First::Polar { radius, angle: Decimal { mantissa: angle.mantissa.rem_euclid(round), ..angle } }
    })
}

/// Whether every hole is where it should be.
fn fits(spots: &[Spot], c: [f64; 2], radius: f64, start: f64, step: Decimal) -> bool {
    spots.iter().enumerate().all(|(k, spot)| {
        let (sin, cos) = (start + k as f64 * step.value()).to_radians().sin_cos();
        spot.is_at([c[0] + radius * cos, c[1] + radius * sin])
    })
}
