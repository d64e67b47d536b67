//! NC0801: an axis leaves its travel, in machine coordinates. ncc reports the first move beyond each limit,
//! with the farthest coordinate and the count of the others.

use std::f64::consts::{FRAC_PI_2, TAU};

use ncc_exec::{Event, Kind};
use ncc_ir::canon::{AXES, Axis, Turn};
use ncc_ir::expr::num::Nanos;

use crate::finding::{Outside, What};
use crate::limits::Unchecked;
use crate::watched::Watched;

/// Tolerance of a limit: a millionth of a millimetre, in nanos.
const TOLERANCE: Nanos = 1000;

/// A move from `last` to the event's end.
pub(crate) fn moved(checker: &mut Watched, event: &Event, last: [Nanos; AXES]) {
    let (least, most) = extent(event, &last);
    for axis in 0..AXES {
        if event.end[axis] == last[axis] && least[axis] == most[axis] {
            continue;
        }
        let Some([low, high]) = checker.limits.travel[axis] else {
            checker.unchecked.insert(Unchecked::Travel(axis as u8));
            continue;
        };
        if axis < 3 && (event.state.tip || event.state.tilted) {
            checker.unchecked.insert(Unchecked::Tilted(axis as u8));
            continue;
        }
        if !checker.seen.machine[axis] {
            let why = checker.why_unknown(axis);
            if checker.travel.noted[axis].as_ref() != Some(&why) {
                checker.travel.noted[axis] = Some(why.clone());
                checker.unchecked.insert(why);
            }
            continue;
        }
        if least[axis] < low - TOLERANCE {
            beyond(checker, event, axis, Outside::Below, least[axis], low);
        }
        if most[axis] > high + TOLERANCE {
            beyond(checker, event, axis, Outside::Above, most[axis], high);
        }
    }
}

#[cold]
fn beyond(checker: &mut Watched, event: &Event, axis: usize, side: Outside, to: Nanos, limit: Nanos) {
    let slot = checker.travel.at[axis][side as usize];
    if let Some(finding) = slot.and_then(|index| checker.findings.get_mut(index)) {
        finding.more += u64::from(finding.span != event.span);
        if let What::AxisTravel { farthest, .. } = &mut finding.what {
            *farthest = match side {
                Outside::Below => (*farthest).min(to),
                Outside::Above => (*farthest).max(to),
            };
        }
        return;
    }
    let what = What::AxisTravel { axis: Axis::ALL[axis], side, to, limit, farthest: to };
    checker.travel.at[axis][side as usize] = checker.find(what, event.span);
}

/// The least and greatest coordinates of a move, without its start point.
fn extent(event: &Event, from: &[Nanos; AXES]) -> ([Nanos; AXES], [Nanos; AXES]) {
    let (mut least, mut most) = (event.end, event.end);
    let Kind::Arc { plane, turn, full, centre } = &event.kind else {
        return (least, most);
    };
    let (first, second, _) = plane.axes();
    let axes = [first as usize, second as usize];
    let about = |p: &[Nanos; AXES]| axes.map(|axis| (p[axis] - centre[usize::from(axis == axes[1])]) as f64);
    let ([x0, y0], [x1, y1]) = (about(from), about(&event.end));
    let radius = x0.hypot(y0);
    let (begin, end) = match turn {
        Turn::Counterclockwise => (y0.atan2(x0), y1.atan2(x1)),
        Turn::Clockwise => (y1.atan2(x1), y0.atan2(x0)),
    };
    let sweep = if *full { TAU } else { (end - begin).rem_euclid(TAU) };
    for quarter in 0..4 {
        let angle = f64::from(quarter) * FRAC_PI_2;
        if (angle - begin).rem_euclid(TAU) <= sweep {
            let side = (quarter & 1) as usize;
            let axis = axes[side];
            let sign = if quarter < 2 { 1.0 } else { -1.0 };
            let place = centre[side] + (sign * radius) as Nanos;
            least[axis] = least[axis].min(place);
            most[axis] = most[axis].max(place);
        }
    }
    (least, most)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ncc_exec::State;
    use ncc_ir::canon::Plane;
    use ncc_ir::source::Span;

    #[test]
    fn an_arc_reaches_as_far_as_its_quadrants() {
        let arc = |turn, full, end: [Nanos; 2]| Event {
            kind: Kind::Arc { plane: Plane::Xy, turn, full, centre: [0, 0] },
            end: [end[0], end[1], 0, 0, 0, 0],
            rate: 1,
            state: State::default(),
            inch: false,
            span: Span::default(),
        };
        let from = [1000, 0, 0, 0, 0, 0];
        let (least, most) = extent(&arc(Turn::Counterclockwise, false, [0, -1000]), &from);
        assert_eq!((least[..2].to_vec(), most[..2].to_vec()), (vec![-1000, -1000], vec![1000, 1000]));
        // The start point belongs to the move before.
        let (least, most) = extent(&arc(Turn::Clockwise, false, [0, -1000]), &from);
        assert_eq!((least[..2].to_vec(), most[..2].to_vec()), (vec![0, -1000], vec![1000, -1000]));
        let (least, most) = extent(&arc(Turn::Clockwise, true, [1000, 0]), &from);
        assert_eq!((least[..2].to_vec(), most[..2].to_vec()), (vec![-1000, -1000], vec![1000, 1000]));
    }
}
