//! Arcs as chords, in the coordinates of the program.
//!
//! A function has its arc in machine coordinates. What lies between them and the program's in the arc's
//! plane (a turn, a scale, a mirror) the caller says; shifts follow from where the arc starts in both.

use ncc_exec::Kind;
use ncc_ir::canon::{AXES, Turn};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_time::{Act, path};

/// Chords of a whole circle. They leave it by less than a sixth of a pixel where its radius is 500.
const CHORDS: f64 = 128.0;

/// X Y Z in mm.
pub(crate) fn place(at: &[Nanos; AXES]) -> [f64; 3] {
    [0, 1, 2].map(|i| at[i] as f64 / ONE as f64)
}

/// What a mm along the first and along the second axis of an arc's plane, in machine coordinates, is along
/// the same axes in the program's.
pub type Turned = [[f64; 2]; 2];

/// Where the chords of an arc end, and after which part of its time; the last is its end. Empty for
/// what is no arc.
pub(crate) fn chords(act: &Act, turned: Option<&Turned>) -> Vec<([f64; 3], f64)> {
    let Kind::Arc { plane, turn, centre, .. } = &act.event.kind else { return Vec::new() };
    let way = path(&act.event, &act.from);
    let (first, second, normal) = plane.axes();
    let [f, s, n] = [first, second, normal].map(|axis| axis as usize);
    let from = place(&act.from);
    let (start, end) = (place(&act.program_from), place(&act.program_to));
    let centre = centre.map(|c| c as f64 / ONE as f64);
    let arm = [from[f] - centre[0], from[s] - centre[1]];
    let [by_first, by_second] = turned.copied().unwrap_or([[1.0, 0.0], [0.0, 1.0]]);
    let times = |v: [f64; 2]| [0, 1].map(|i: usize| v[0] * by_first[i] + v[1] * by_second[i]);
    let sense = if *turn == Turn::Counterclockwise { 1.0 } else { -1.0 };
    let count = (way.sweep / std::f64::consts::TAU * CHORDS).ceil().clamp(2.0, CHORDS) as usize;
    // The end is not exactly on the circle, so what it is off is spread over the arc.
    let to = place(&act.event.end);
    let end_arm = [to[f] - centre[0], to[s] - centre[1]];
    let (radius, end_radius) = (arm[0].hypot(arm[1]), end_arm[0].hypot(end_arm[1]));
    let point = |i: usize| {
        let part = i as f64 / count as f64;
        if i == count {
            return (end, 1.0);
        }
        let (sin, cos) = (sense * way.sweep * part).sin_cos();
        let grown = if radius > 0.0 { 1.0 + part * (end_radius / radius - 1.0) } else { 1.0 };
        let turned = [arm[0] * cos - arm[1] * sin, arm[0] * sin + arm[1] * cos].map(|v| v * grown);
        let off = times([turned[0] - arm[0], turned[1] - arm[1]]);
        let mut at = start;
        at[f] += off[0];
        at[s] += off[1];
        at[n] += part * (end[n] - start[n]);
        (at, part)
    };
    (1..=count).map(point).collect()
}
