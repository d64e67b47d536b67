//! Whether the way of a block is the one between its positions.
//!
//! It is another one under a scale or a mirror, and beside a contour. Between blocks, positions jump where the origin
//! changes.

use ncc_ir::canon::Plane;

use super::Block;
use crate::render::events;

/// How far positions and lengths may be apart, mm: they are rounded to the millionth.
const NEAR: f64 = 1e-4;

/// Whether a block begins elsewhere than the one before ends.
pub(super) fn jumps(before: &Block, block: &Block) -> bool {
    let turns = |end: Option<[f64; 3]>| end.unwrap_or_default();
    let end = turns(before.rotary.map(|r| [r.a1, r.b1, r.c1]));
    let start = turns(block.rotary.map(|r| [r.a0, r.b0, r.c0]));
    let linear = [(before.x1, block.x0), (before.y1, block.y0), (before.z1, block.z0)];
    linear.into_iter().chain(end.into_iter().zip(start)).any(|(end, start)| (end - start).abs() > NEAR)
}

/// Whether a move is as long as the line, or the arc, between its positions. A feed move with rotary axes has a length
/// that the machine decides.
pub(super) fn is_between_positions(block: &Block) -> bool {
    let line = block.dx.hypot(block.dy).hypot(block.dz);
    let turns = block.rotary.is_some_and(|r| [r.a0, r.b0, r.c0] != [r.a1, r.b1, r.c1]);
    let near = |length: f64| (block.distance - length).abs() <= NEAR + 1e-6 * length;
    match &*block.function_name {
        "STRAIGHT_FEED" => !turns && near(line),
        "STRAIGHT_TRAVERSE" => turns || near(line),
        "ARC_FEED" => !turns && arc(block).is_some_and(near),
        _ => true,
    }
}

/// Length of an arc, mm; `None` where its ends are on no circle about its centre.
fn arc(block: &Block) -> Option<f64> {
    let text = |name: &str| block.parameters.get(name)?.as_str();
    let planes = [Plane::Xy, Plane::Zx, Plane::Yz];
    let plane = planes.into_iter().find(|plane| text("plane") == Some(events::plane(*plane)))?;
    let (first, second, normal) = plane.axes();
    let centre = |axis: usize| block.parameters.get(["i", "j", "k"][axis])?.as_f64();
    let centre = [centre(first as usize)?, centre(second as usize)?];
    let [from, to] = [[block.x0, block.y0, block.z0], [block.x1, block.y1, block.z1]];
    let beside = |at: [f64; 3]| [at[first as usize] - centre[0], at[second as usize] - centre[1]];
    let [start, end] = [beside(from), beside(to)];
    let radii = [start[0].hypot(start[1]), end[0].hypot(end[1])];
    if (radii[0] - radii[1]).abs() > 0.01 {
        return None;
    }
    let angle = |at: [f64; 2]| at[1].atan2(at[0]);
    let sense = if text("turn")? == "clockwise" { -1.0 } else { 1.0 };
    let full = block.parameters.get("full")?.as_bool()?;
    let turned = match (sense * (angle(end) - angle(start))).rem_euclid(std::f64::consts::TAU) {
        _ if full => std::f64::consts::TAU,
        turned => turned,
    };
    let along = to[normal as usize] - from[normal as usize];
    Some((radii[0].midpoint(radii[1]) * turned).hypot(along))
}
