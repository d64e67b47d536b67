//! Feeds that a program says by the time of a move, as those of its way: LinuxCNC's interpreter says no others.

use std::f64::consts::TAU;

use ncc_exec::{Event, Kind};
use ncc_ir::canon::{AXES, FeedMode, Turn};
use ncc_ir::expr::num::{Nanos, ONE};

/// Least feed that the interpreter makes of a time, in mm/min and in inches a minute.
const LEAST: [f64; 2] = [0.1, 2.54];

/// Puts the feed of the way, in mm/min, in the place of a time's; moves begin at zero.
pub fn as_feeds(events: &mut [Event]) {
    let mut at = [0; AXES];
    let mut from = 0;
    while from < events.len() {
        // An arc of several turns is one move by one time.
        let arc = |event: &Event| matches!(event.kind, Kind::Arc { .. });
        let span = events[from].span;
        let mut end = from + 1;
        while arc(&events[from]) && end < events.len() && arc(&events[end]) && events[end].span == span {
            end += 1;
        }
        let mut way = 0.0;
        for event in &events[from..end] {
            way += length(event, &at);
            at = event.end;
        }
        for event in events[from..end].iter_mut().filter(|e| e.state.feed_mode == FeedMode::InverseTime) {
            let feed = way * event.rate as f64 / ONE as f64;
            if event.rate != 0 {
                event.rate = (feed.max(LEAST[usize::from(event.inch)]) * ONE as f64).round() as Nanos;
            }
            event.state.feed_mode = FeedMode::PerMinute;
        }
        from = end;
    }
}

/// How far a move goes, in mm; one of rotary axes alone, in degrees.
fn length(event: &Event, from: &[Nanos; AXES]) -> f64 {
    let way: [f64; AXES] = std::array::from_fn(|axis| (event.end[axis] - from[axis]) as f64 / ONE as f64);
    let root = |of: &[f64]| of.iter().map(|n| n * n).sum::<f64>().sqrt();
    let Kind::Arc { plane, turn, full, centre } = &event.kind else {
        let (linear, rotary) = (root(&way[..3]), root(&way[3..]));
        return if linear > 0.0 { linear } else { rotary };
    };
    let (first, second, normal) = plane.axes();
    let (f, s) = (first as usize, second as usize);
    let out = |p: &[Nanos; AXES]| [p[f] - centre[0], p[s] - centre[1]].map(|n| n as f64 / ONE as f64);
    let ([x1, y1], [x2, y2]) = (out(from), out(&event.end));
    let ahead = y2.atan2(x2) - y1.atan2(x1);
    let ahead = if *turn == Turn::Clockwise { -ahead } else { ahead };
    let sweep = if *full { TAU } else { ahead.rem_euclid(TAU) };
    (x1.hypot(y1) * sweep).hypot(way[normal as usize])
}
