//! The S-curve: how speed changes where acceleration takes time to build up.
//!
//! A change of speed by Δ under acceleration `a` and jerk `j` builds the acceleration up, holds it, and
//! takes it back alike. It lasts `Δ/a + a/j` where Δ is at least `a²/j`, else `2√(Δ/j)`; being symmetrical,
//! it covers the mean of both speeds times that (the seven-segment profile of any text on motion
//! control; so HEIDENHAIN, iTNC 530 HSCI Technical Manual, July 2013, page 813).
//!
//! All is reckoned along the *gain*, `∫2a ds`, in which the trapezoid is `v1² − v0²` whatever the
//! acceleration of each move, and with the softness `w = a²/j`: from `v0` to `v1` takes the gain
//! `(v0 + v1)·h`, h being `Δ + w` or `2√(Δw)`. Time along the gain is counted so that acceleration is ½;
//! a move's own seconds are that divided by its `2a`. So one ramp may go on over moves of different
//! directions; with `w = 0` it is the trapezoid.

use crate::limits::Leg;

/// Half the time, along the gain, of a change of speed.
fn half_time(change: f64, softness: f64) -> f64 {
    if change >= softness { change + softness } else { 2.0 * (change * softness).sqrt() }
}

/// The gain that a change of speed takes.
pub(crate) fn gain(from: f64, to: f64, softness: f64) -> f64 {
    (from + to) * half_time((to - from).abs(), softness)
}

/// The highest speed that so much gain gives room to stop from.
pub(crate) fn stop_from(gain: f64, softness: f64) -> f64 {
    if softness == 0.0 {
        gain.sqrt()
    } else if gain >= 2.0 * softness * softness {
        ((softness * softness + 4.0 * gain).sqrt() - softness) / 2.0
    } else {
        (gain / (2.0 * softness.sqrt())).cbrt().powi(2)
    }
}

/// Seconds of a leg from rest to rest.
pub(crate) fn stop_to_stop(leg: &Leg) -> f64 {
    let Leg { length, acceleration, softness, .. } = *leg;
    let half = acceleration * length;
    if softness == 0.0 {
        let Leg { speed, .. } = *leg;
        let whole = half >= speed * speed;
        return if whole { length / speed + speed / acceleration } else { 2.0 * half.sqrt() / acceleration };
    }
    let peak = stop_from(half, softness).min(leg.speed);
    let half_time = half_time(peak, softness);
    let rest = (length - peak * half_time / acceleration).max(0.0);
    2.0 * half_time / acceleration + rest / peak
}

/// The highest speed between two that so much gain leaves time for; softness on the way up and down.
fn peak(from: f64, to: f64, whole: f64, [up, down]: [f64; 2]) -> f64 {
    let over = |at: f64| gain(from, at, up) + gain(at, to, down) - whole;
    let mut low = from.max(to);
    // Without any softness it would be this.
    let mut high = ((from * from + to * to + whole) / 2.0).sqrt().max(low);
    let mut at = high;
    for _ in 0..80 {
        let by = over(at);
        if by > 0.0 {
            high = at;
        } else {
            low = at;
        }
        if high - low <= 1e-15 * high {
            break;
        }
        let newton = at - by / (slope(from, at, up) + slope(to, at, down));
        let next = if newton > low && newton < high { newton } else { (low + high) / 2.0 };
        let step = (next - at).abs();
        at = next;
        if step <= 1e-10 * at {
            break;
        }
    }
    // From below: near the speed at an end, the last digit of the peak is much gain. What is left over is
    // spent at the peak.
    let near = [at, at * (1.0 - 1e-15), at * (1.0 - 1e-14), at * (1.0 - 1e-12)];
    near.into_iter().find(|at| *at >= low && over(*at) <= 0.0).unwrap_or(low)
}

/// How the gain of a ramp grows with its upper speed.
fn slope(from: f64, to: f64, softness: f64) -> f64 {
    let change = to - from;
    let half = half_time(change, softness);
    let steep = if change >= softness { 1.0 } else { (softness / change.max(f64::MIN_POSITIVE)).sqrt() };
    half + (from + to) * steep
}

/// Up from a speed to a peak, along at the peak, and down to another.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Curve {
    from: f64,
    pub(crate) peak: f64,
    to: f64,
    /// On the way up, and down.
    softness: [f64; 2],
    /// Gain of the way up, and of the way up and along.
    pub(crate) up: f64,
    pub(crate) level: f64,
    whole: f64,
}

/// Where a curve is after some gain.
#[derive(Clone, Copy, Debug)]
pub(crate) struct At {
    pub(crate) speed: f64,
    /// Time along the gain on the way up, at the peak, and down, from the start to here.
    pub(crate) times: [f64; 3],
}

impl Curve {
    /// The fastest over so much gain; softness on the way up, and down.
    pub(crate) fn new(from: f64, to: f64, whole: f64, softness: [f64; 2]) -> Curve {
        let mut softness = softness;
        let side = &mut softness[usize::from(from > to)];
        if gain(from, to, *side) > whole {
            // Moves of different softness: no more of it than there is room for.
            let change = (to - from).abs();
            let half = whole / (from + to).max(f64::MIN_POSITIVE);
            *side = if half <= change {
                0.0
            } else if half <= 2.0 * change {
                half - change
            } else {
                half * half / (4.0 * change.max(f64::MIN_POSITIVE))
            };
        }
        let peak = peak(from, to, whole, softness);
        let up = gain(from, peak, softness[0]).min(whole);
        let level = (whole - gain(peak, to, softness[1])).max(up);
        Curve { from, peak, to, softness, up, level, whole }
    }

    /// At one speed.
    pub(crate) fn level(speed: f64, whole: f64) -> Curve {
        Curve { from: speed, peak: speed, to: speed, softness: [0.0; 2], up: 0.0, level: whole, whole }
    }

    /// Gain of the whole.
    pub(crate) fn whole(&self) -> f64 {
        self.whole
    }

    /// The highest speed between two places.
    pub(crate) fn highest(&self, a: f64, b: f64) -> f64 {
        if b < self.up {
            self.at(b).speed
        } else if a > self.level {
            self.at(a).speed
        } else {
            self.peak
        }
    }

    /// After so much gain.
    pub(crate) fn at(&self, gain: f64) -> At {
        let Curve { from, peak, to, softness: [rising, falling], up, level, whole } = *self;
        if gain < up {
            let (time, speed) = ramp(from, peak, rising, up, gain.max(0.0));
            return At { speed, times: [time, 0.0, 0.0] };
        }
        let rise = 2.0 * half_time(peak - from, rising);
        if gain <= level {
            let along = if peak > 0.0 { (gain - up) / peak } else { 0.0 };
            return At { speed: peak, times: [rise, along, 0.0] };
        }
        let along = if peak > 0.0 { (level - up) / peak } else { 0.0 };
        let fall = 2.0 * half_time(peak - to, falling);
        // The way down is the way up, seen from its end.
        let (left, speed) = ramp(to, peak, falling, whole - level, (whole - gain).max(0.0));
        At { speed, times: [rise, along, (fall - left).max(0.0)] }
    }
}

/// Time and speed on a ramp up, after some of its whole gain.
fn ramp(from: f64, to: f64, softness: f64, whole: f64, gain: f64) -> (f64, f64) {
    let change = to - from;
    let half = half_time(change, softness);
    if gain >= whole {
        return (2.0 * half, to);
    }
    if softness <= 0.0 {
        let speed = (from * from + gain).sqrt().min(to);
        return (2.0 * (speed - from), speed);
    }
    let jerk = 1.0 / (4.0 * softness);
    // Time in which acceleration is built up, and what the speed gains in it.
    let build = if change >= softness { 2.0 * softness } else { half };
    let part = jerk * build * build / 2.0;
    let first = from * build + jerk * build * build * build / 6.0;
    let last = to * build - jerk * build * build * build / 6.0;
    if gain <= first {
        let time = first_part(from, jerk, build, gain);
        return (time, from + jerk * time * time / 2.0);
    }
    if gain >= whole - last {
        let left = last_part(to, jerk, build, whole - gain);
        return (2.0 * half - left, to - jerk * left * left / 2.0);
    }
    let start = from + part;
    let speed = (start * start + (gain - first)).sqrt();
    (build + 2.0 * (speed - start), speed)
}

/// The time `t` of `v·t + j·t³/6 = x`, at most `most`. From above, steps of Newton come down to it.
fn first_part(v: f64, j: f64, most: f64, x: f64) -> f64 {
    let mut t = (6.0 * x / j).cbrt().min(most);
    if v > 0.0 {
        t = t.min(x / v);
    }
    for _ in 0..60 {
        let slope = v + j * t * t / 2.0;
        if slope <= 0.0 {
            break;
        }
        let next = t - (v * t + j * t * t * t / 6.0 - x) / slope;
        // A step of Newton doubles the digits.
        if (next - t).abs() <= 1e-9 * t {
            return next.max(0.0);
        }
        t = next;
    }
    t.max(0.0)
}

/// The time `t` of `v·t − j·t³/6 = x`, at most `most`, while the speed goes down from `v`.
fn last_part(v: f64, j: f64, most: f64, x: f64) -> f64 {
    let mut t = (x / v).min(most);
    for _ in 0..60 {
        let slope = v - j * t * t / 2.0;
        if slope <= 0.0 {
            break;
        }
        let next = (t - (v * t - j * t * t * t / 6.0 - x) / slope).min(most);
        if (next - t).abs() <= 1e-9 * t {
            return next;
        }
        t = next;
    }
    t
}
