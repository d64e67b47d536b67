//! How a target says frames: slots as a chain, a chain as slots where it is one.
//!
//! A target with a chain gets the whole of it at each change. One with slots gets a local shift, a
//! rotation, factors and a mirror where that is what the frames amount to, exactly in its digits; they
//! are taken back from the inside before anything outside of them changes.
//!
//! Not here: what becomes of coordinates where a target can say it in neither form (`expand_frames`).

use crate::support::write::{EXACT, exact, rounded, unit_of};
use ncc_exec::{Chain, Frames, Rotation, Scale};
use ncc_ir::canon::{AXES, Axis, Distance, Fact, Plane};
use ncc_ir::caps::Caps;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num, ONE, Unit};
use ncc_ir::program::{Coord, Frame, FrameSlot, FrameStep, Op, Slot};

/// Less than this is no share of an axis.
const NOTHING: f64 = 1e-12;

/// A place computed in another way may be off by this much, nanos.
const NEAR: u64 = 2;

/// What slots amount to, with the G92 shift.
pub(crate) fn shifted(slots: &Frames) -> Chain {
    let by = slots.origin.map(Option::unwrap_or_default);
    Chain::by(by).then(&slots.chain())
}

/// The statements that give a control with a chain these frames; `None` if steps that were chained
/// freely stand beside slots. `before` says whether it has any.
pub(crate) fn as_chain(slots: &Frames, before: bool, unit: Unit) -> Option<Vec<Op>> {
    if slots.steps != Chain::NONE {
        return None;
    }
    let mut all = slots.clone();
    for (local, origin) in all.local.iter_mut().zip(slots.origin) {
        *local = local.wrapping_add(origin.unwrap_or_default());
    }
    let mut steps = all.slot_steps();
    for step in &mut steps {
        if let FrameStep::Translate(words) = step {
            for (axis, word) in Axis::ALL.into_iter().zip(words.iter_mut()) {
                let nanos = word.as_ref().and_then(Expr::literal).and_then(|n| n.nanos(false));
                *word = nanos.map(|nanos| exact(nanos, unit_of(axis, unit)).into());
            }
        }
    }
    if steps.is_empty() {
        return Some(if before { vec![Op::ClearFrame(FrameSlot::Chain)] } else { Vec::new() });
    }
    let frame = |(k, step)| Op::SetFrame(Box::new(Frame { added: k > 0, step }));
    Some(steps.into_iter().enumerate().map(frame).collect())
}

/// The slots that amount to a chain, with places of so many digits; `None` if none do. A local shift
/// that is active `now` stays where it can.
pub(crate) fn as_slots(chain: &Chain, now: &Frames, caps: &Caps, decimals: u8, unit: Unit) -> Option<Frames> {
    let sayable = |slots: &Frames| {
        let lengths = slots.local.iter().take(3).copied();
        let mut lengths = lengths
            .chain(slots.rotation.iter().flat_map(|r| r.centre))
            .chain(slots.scale.iter().flat_map(|s| s.centre))
            .chain(slots.mirror.iter().flatten().copied());
        let whole = lengths.all(|nanos| rounded(nanos, decimals, unit).nanos(false) == Some(nanos));
        whole
            && (slots.local == [0; AXES] || caps.frames.local_shift || caps.frames.stated_shift)
            && (slots.rotation.is_none() || caps.frames.rotation)
            && (slots.scale.is_none() || caps.frames.scale)
            && (slots.mirror == [None; 3] || caps.frames.mirror)
            && same(&slots.chain(), chain)
    };
    let t = *chain.shift();
    let Some(m) = chain.turn() else {
        let slots = Frames { local: t, ..Frames::NONE };
        return sayable(&slots).then_some(slots);
    };
    let mut found = candidates(m, t).into_iter().map(|slots| snapped(slots, decimals, unit)).filter(sayable);
    let best = found.next()?;
    let stays = |slots: &Frames| slots.local != [0; AXES] && slots.local == now.local;
    Some(if stays(&best) { best } else { found.find(stays).unwrap_or(best) })
}

/// What a matrix and a shift may be, the best first.
fn candidates(m: &[[f64; 3]; 3], t: [Nanos; AXES]) -> Vec<Frames> {
    let near = |a: f64, b: f64| (a - b).abs() < NOTHING;
    let diagonal = (0..3).all(|i| (0..3).all(|j| i == j || near(m[i][j], 0.0)));
    if diagonal && (0..3).all(|i| near(m[i][i].abs(), 1.0)) {
        let mirrored = [0, 1, 2].map(|i| m[i][i] < 0.0);
        let lines = Frames { mirror: [0, 1, 2].map(|i| mirrored[i].then_some(t[i] / 2)), ..Frames::NONE };
        let local =
            Frames { local: t, mirror: mirrored.map(|mirrored| mirrored.then_some(0)), ..Frames::NONE };
        return [Some(lines), Some(local), turned(m, t, true), turned(m, t, false)]
            .into_iter()
            .flatten()
            .collect();
    }
    if diagonal && (0..3).all(|i| m[i][i] > 0.0) {
        let factors = [0, 1, 2].map(|i| (m[i][i] * ONE as f64).round() as Nanos);
        let scale = |centre| Some(Scale { centre, factors });
        // The centre is what stays where it is.
        let still = [0, 1, 2].map(|i| match near(m[i][i], 1.0) {
            true => 0,
            false => (t[i] as f64 / (1.0 - m[i][i])).round() as Nanos,
        });
        return vec![
            Frames { scale: scale(still), ..Frames::NONE },
            Frames { local: t, scale: scale([0; 3]), ..Frames::NONE },
        ];
    }
    [turned(m, t, true), turned(m, t, false)].into_iter().flatten().collect()
}

/// A rotation, and a mirror of the first axis before it if there is one; `about` its own centre, or
/// about zero in a local shift.
fn turned(m: &[[f64; 3]; 3], t: [Nanos; AXES], about: bool) -> Option<Frames> {
    let near = |a: f64, b: f64| (a - b).abs() < NOTHING;
    let plane = [Plane::Xy, Plane::Zx, Plane::Yz].into_iter().find(|plane| {
        let (f, s, n) = plane.axes();
        let (f, s, n) = (f as usize, s as usize, n as usize);
        let flat = [m[n][f], m[n][s], m[f][n], m[s][n]].into_iter().all(|v| near(v, 0.0));
        flat && near(m[n][n], 1.0) && near(m[f][f].hypot(m[s][f]), 1.0)
    })?;
    let (f, s, _) = plane.axes();
    let (f, s) = (f as usize, s as usize);
    let odd = m[f][f] * m[s][s] - m[f][s] * m[s][f] < 0.0;
    // After a mirror of the first axis, its column is turned round.
    let (cos, sin) = if odd { (-m[f][f], -m[s][f]) } else { (m[f][f], m[s][f]) };
    let angle = (sin.atan2(cos).to_degrees() * ONE as f64).round() as Nanos;
    let mut slots = Frames::NONE;
    if odd {
        if about {
            return None;
        }
        slots.mirror[f] = Some(0);
    }
    let mut centre = [0; 2];
    if about {
        let others = (0..AXES).any(|i| i != f && i != s && t[i] != 0);
        let det = 2.0 - 2.0 * cos;
        if others || det < NOTHING {
            return None;
        }
        // What stays where it is: (1 - R) c = t.
        let (x, y) = (t[f] as f64, t[s] as f64);
        let of = |a: f64, b: f64| ((1.0 - cos) * a + b * sin) / det;
        centre = [of(x, -y).round() as Nanos, of(y, x).round() as Nanos];
    } else {
        slots.local = t;
    }
    slots.rotation = Some(Rotation { plane, centre, angle: if odd { -angle } else { angle } });
    Some(slots)
}

/// With places that came out of a computation put where the digits are.
fn snapped(mut slots: Frames, decimals: u8, unit: Unit) -> Frames {
    let snap = |nanos: &mut Nanos| {
        if let Some(near) = rounded(*nanos, decimals, unit).nanos(false)
            && near.abs_diff(*nanos) <= 50
        {
            *nanos = near;
        }
    };
    slots.local.iter_mut().take(3).for_each(snap);
    slots.rotation.iter_mut().flat_map(|r| &mut r.centre).for_each(snap);
    slots.scale.iter_mut().flat_map(|s| &mut s.centre).for_each(snap);
    slots.mirror.iter_mut().flatten().for_each(snap);
    if let Some(rotation) = &mut slots.rotation {
        // A millionth of a degree and less comes of the computation.
        let step = ONE / 1_000_000;
        let near = (rotation.angle + rotation.angle.signum() * step / 2) / step * step;
        if near.abs_diff(rotation.angle) <= 50 {
            rotation.angle = near;
        }
    }
    slots
}

/// Whether two chains do the same within what computing them may differ by.
fn same(a: &Chain, b: &Chain) -> bool {
    const ONES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let (m, n) = (a.turn().unwrap_or(&ONES), b.turn().unwrap_or(&ONES));
    let turned = m.iter().flatten().zip(n.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-11);
    turned && a.shift().iter().zip(b.shift()).all(|(a, b)| a.abs_diff(*b) <= NEAR)
}

/// The statements that bring a control with slots from some to others.
pub(crate) fn between(before: &Frames, after: &Frames, caps: &Caps, unit: Unit) -> Vec<Op> {
    let mut ops = Vec::new();
    let slot = |slot| Op::SetSlot(Box::new(slot));
    let length = |nanos: Nanos, axis: Axis| Expr::Num(exact(nanos, unit_of(axis, unit)));
    let local = before.local != after.local;
    let mirror = local || before.mirror != after.mirror;
    let scale = mirror || before.scale != after.scale;
    let rotation = scale || before.rotation != after.rotation;
    if rotation && before.rotation.is_some() {
        ops.push(Op::ClearFrame(FrameSlot::Rotation));
    }
    if scale && before.scale.is_some() {
        ops.push(Op::ClearFrame(FrameSlot::Scale));
    }
    if mirror && before.mirror != [None; 3] {
        ops.push(slot(Slot::NoMirror(before.mirror.map(|line| line.is_some()))));
    }
    if local {
        let axes = Axis::ALL.map(|axis| {
            let (from, to) = (before.local[axis as usize], after.local[axis as usize]);
            (from != to).then(|| length(to, axis))
        });
        ops.push(slot(Slot::Shift { origin: !caps.frames.local_shift, axes: Box::new(axes) }));
    }
    const LINEAR: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];
    if mirror && after.mirror != [None; 3] {
        let lines = LINEAR.map(|axis| after.mirror[axis as usize].map(|line| length(line, axis)));
        ops.push(slot(Slot::Mirror(Box::new(lines))));
    }
    if let (true, Some(new)) = (scale, &after.scale) {
        let centre = LINEAR.map(|axis| Some(length(new.centre[axis as usize], axis)));
        let factors = new.factors.map(|f| Some(Expr::Num(Num::from_nanos(f, EXACT, Unit::One))));
        ops.push(slot(Slot::Scale { centre: Box::new(centre), factors: Box::new(factors) }));
    }
    if let (true, Some(new)) = (rotation, &after.rotation) {
        let (f, s, _) = new.plane.axes();
        let mut centre = [None, None, None];
        for (axis, place) in [f, s].into_iter().zip(new.centre) {
            centre[axis as usize] = Some(length(place, axis));
        }
        let value = Num::from_nanos(new.angle, EXACT, Unit::Degree).into();
        let angle = Coord { value, distance: Fact::Known(Distance::Absolute) };
        ops.push(slot(Slot::Rotation { plane: Fact::Known(new.plane), centre: Box::new(centre), angle }));
    }
    ops
}
