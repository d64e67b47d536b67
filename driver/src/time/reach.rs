//! How far an arc reaches, in the program's coordinates.
//!
//! The arc is one in machine coordinates; its points are taken back through the frames. Where frames
//! turn or stretch, points every few degrees stand for the whole.

use std::f64::consts::{FRAC_PI_2, TAU};

use ncc_exec::{Exec, Kind};
use ncc_ir::canon::{AXES, Turn};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_plot::Turned;
use ncc_time::Act;

/// Least and greatest coordinate in X, Y and Z, nanos.
pub type Reach = [[Nanos; 2]; 3];

/// Points of a turn where frames turn.
const POINTS: usize = 72;

/// The box around an arc; `None` of anything else.
pub fn reach(act: &Act, exec: &Exec) -> Option<Reach> {
    let Kind::Arc { plane, turn, full, centre } = &act.event.kind else { return None };
    let (f, s, n) = plane.axes();
    let (f, s, n) = (f as usize, s as usize, n as usize);
    let arm = |p: &[Nanos; AXES]| [(p[f] - centre[0]) as f64, (p[s] - centre[1]) as f64];
    let (a, b) = (arm(&act.from), arm(&act.event.end));
    let radius = a[0].hypot(a[1]);
    let (from, to) = (a[1].atan2(a[0]), b[1].atan2(b[0]));
    let sense = if *turn == Turn::Counterclockwise { 1.0 } else { -1.0 };
    let sweep = if *full { TAU } else { ((to - from) * sense).rem_euclid(TAU) };
    let parts = if is_shift(exec) { 4 } else { POINTS };
    let mut found = [act.program_from, act.program_to];
    let mut reach: Reach = std::array::from_fn(|i| {
        found.sort_by_key(|p| p[i]);
        [found[0][i], found[1][i]]
    });
    for k in 0..parts {
        let angle = FRAC_PI_2 * 4.0 * k as f64 / parts as f64;
        let along = ((angle - from) * sense).rem_euclid(TAU);
        if along > sweep {
            continue;
        }
        let mut point = act.event.end;
        point[f] = centre[0] + (radius * angle.cos()).round() as Nanos;
        point[s] = centre[1] + (radius * angle.sin()).round() as Nanos;
        let rise = (act.event.end[n] - act.from[n]) as f64;
        point[n] = act.from[n] + (rise * along / sweep).round() as Nanos;
        for (side, at) in reach.iter_mut().zip(exec.in_program(&point)) {
            *side = [side[0].min(at), side[1].max(at)];
        }
    }
    Some(reach)
}

/// What a mm along the axes of an arc's plane, in machine coordinates, is along the same axes in the
/// program's; `None` of anything else, and where it is the same.
pub fn turned(act: &Act, exec: &Exec) -> Option<Turned> {
    let Kind::Arc { plane, .. } = &act.event.kind else { return None };
    if is_shift(exec) {
        return None;
    }
    // Of a long way: coordinates are rounded.
    let far = 1000 * ONE;
    let (f, s, _) = plane.axes();
    let zero = exec.in_program(&[0; AXES]);
    Some([f, s].map(|axis| {
        let mut point = [0; AXES];
        point[axis as usize] = far;
        let there = exec.in_program(&point);
        [f, s].map(|i| (there[i as usize] - zero[i as usize]) as f64 / far as f64)
    }))
}

/// Whether program and machine coordinates differ by a shift alone.
fn is_shift(exec: &Exec) -> bool {
    let zero = exec.in_program(&[0; AXES]);
    (0..3).all(|axis| {
        let mut point = [0; AXES];
        point[axis] = ONE;
        let there = exec.in_program(&point);
        (0..3).all(|i| there[i] - zero[i] == if i == axis { ONE } else { 0 })
    })
}
