//! NC0802 and NC0804: feeds above the machine's highest, and moves at feed without one.

use ncc_exec::{Event, Kind};
use ncc_ir::canon::{AXES, Axis};
use ncc_ir::expr::num::Nanos;
use ncc_ir::source::Span;

use crate::finding::{Finding, What};
use crate::limits::Unchecked;
use crate::seen::Known;
use crate::watched::Watched;

/// A feed is stated.
pub(crate) fn said(checker: &mut Watched, feed: Nanos, at: Span) {
    match checker.limits.max_feed {
        Some(limit) if feed > limit => {
            checker.find(What::FeedRange { axis: None, feed, limit }, at);
        }
        Some(_) => {}
        None if checker.limits.machine && checker.limits.axis_feed.iter().all(Option::is_none) => {
            checker.unchecked.insert(Unchecked::MaxFeed);
        }
        None => {}
    }
}

/// A move at feed from `last`: the part of each axis.
pub(crate) fn cut(checker: &mut Watched, event: &Event, last: [Nanos; AXES]) {
    let limits = &checker.limits;
    let fast = limits.axis_feed.iter().any(|limit| limit.is_some_and(|limit| event.rate > limit));
    let path = limits.max_feed.is_some_and(|limit| event.rate > limit);
    // One message a move: the path is faster than the machine, so its axes need no other.
    if !fast || path || checker.seen.feed != Known::Said || !matches!(event.kind, Kind::Feed) {
        return;
    }
    let way: [f64; AXES] = std::array::from_fn(|axis| (event.end[axis] - last[axis]).abs() as f64);
    let rotary = Axis::ALL.iter().any(|axis| axis.is_rotary() && way[*axis as usize] > 0.0);
    let length = way[..3].iter().map(|d| d * d).sum::<f64>().sqrt();
    // How fast the axes of a mixed move are depends on what its feed counts.
    if rotary || length == 0.0 {
        return;
    }
    for (axis, way) in way.iter().enumerate().take(3) {
        let feed = (event.rate as f64 * way / length) as Nanos;
        let Some(limit) = checker.limits.axis_feed[axis].filter(|limit| feed > *limit) else { continue };
        match checker.feed.axes[axis].and_then(|index| checker.findings.get_mut(index)) {
            Some(finding) => finding.more += 1,
            None => {
                let what = What::FeedRange { axis: Some(Axis::ALL[axis]), feed, limit };
                checker.feed.axes[axis] = checker.find(what, event.span);
            }
        }
    }
}

/// A feed move without an active feed: the check executes it with a made-up one.
pub(crate) fn missing(checker: &mut Watched, at: Span) {
    checker.feed.made_up = true;
    let known = std::mem::replace(&mut checker.seen.feed, Known::Lost);
    if known != Known::Lost {
        let at_entry = known == Known::Entry;
        checker.findings.add(Finding { at_entry, ..Finding::new(What::NoFeed, at) });
    }
}
