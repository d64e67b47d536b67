//! One hole read off its moves: the inverse of `expand-cycles`.

use crate::fold::fold_cycles::acts::{Act, Acts};
use crate::support::write::{at, exact};
use ncc_ir::canon::Plane;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num, Unit};
use ncc_ir::program::cycle::{Clearance, CycleKind, next_peck};
use ncc_ir::program::{Coord, Point};

/// A hole.
#[derive(Clone, Debug)]
pub(super) struct Hole {
    /// Words of its position; empty if it is made where the tool is.
    pub(super) to: Point,
    /// Level from which it is gone to.
    pub(super) from: Nanos,
    /// The retract plane: its word, and where it is.
    pub(super) retract: (Coord, Nanos),
    /// The bottom.
    pub(super) depth: (Coord, Nanos),
    /// The level where the tool is left.
    pub(super) out: (Coord, Nanos),
    /// How it is made.
    pub(super) kind: CycleKind,
    /// Feed into the hole, if it is known, and whether the moves say it.
    pub(super) feed: Option<Num>,
    pub(super) feed_said: bool,
    /// Whether it is left by a cut.
    pub(super) left_by_cut: bool,
    /// Its strokes but the last.
    strokes: usize,
}

impl Hole {
    /// Whether another hole is made by the same cycle after this one.
    pub(super) fn is_like(&self, other: &Hole) -> bool {
        self.retract.1 == other.retract.1
            && self.depth.1 == other.depth.1
            && self.out.1 == other.out.1
            && self.kind == other.kind
            && same(self.feed, other.feed)
    }

    /// Whether it is drilled in one stroke without a dwell, as any plunge is.
    pub(super) fn is_plain(&self) -> bool {
        matches!(self.kind, CycleKind::Drill)
    }
}

/// Whether two feeds are the same.
fn same(a: Option<Num>, b: Option<Num>) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => {
            a.trimmed() == b.trimmed() || a.unit == b.unit && a.nanos(false) == b.nanos(false)
        }
        (a, b) => a == b,
    }
}

/// Why no hole was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unread {
    /// It does not begin here.
    NotHere,
    /// It begins here, and goes on as no cycle does: its moves are passed by, so that no part of it
    /// is taken for a hole.
    NoCycle,
}

/// What comes between two strokes.
#[derive(Clone, Debug, PartialEq)]
enum Between {
    Out { back_to: Nanos, settle: Option<Nanos> },
    Up { to: Nanos, at_feed: bool },
}

/// A stroke but the last: its bottom, the dwell there, and what follows.
#[derive(Clone, Debug)]
struct Stroke {
    bottom: Nanos,
    pause: Option<Nanos>,
    between: Between,
}

/// How moves that could belong to a hole or to what comes after it are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Reading {
    /// Most strokes but the last.
    pub(super) strokes: usize,
    /// Whether a rapid after a cut out belongs to it.
    pub(super) rapid_out: bool,
}

impl Reading {
    /// All that can belong to a hole does.
    pub(super) const LONG: Reading = Reading { strokes: usize::MAX, rapid_out: true };
    /// It ends as soon as it can.
    pub(super) const SHORT: Reading = Reading { strokes: 0, rapid_out: false };

    /// As another hole was read.
    pub(super) fn like(hole: &Hole) -> Reading {
        Reading { strokes: hole.strokes, rapid_out: !hole.left_by_cut }
    }
}

/// Reads a hole.
///
/// # Errors
/// There is none.
pub(super) fn read(acts: &mut Acts<'_>, plane: Plane, reading: Reading) -> Result<Hole, Unread> {
    let normal = plane.axes().2;
    let from = acts.level().ok_or(Unread::NotHere)?;
    let mut act = acts.next().ok_or(Unread::NotHere)?;
    let mut to = Point::default();
    if let Act::Aside(words) = act {
        to = words;
        act = acts.next().ok_or(Unread::NotHere)?;
    }
    let mut retract = (at(from, normal, acts.unit()), from);
    if let Act::Rapid(word, level) = act {
        if level >= from {
            return Err(Unread::NotHere);
        }
        retract = (word, level);
        act = acts.next().ok_or(Unread::NotHere)?;
    }
    let Act::Cut(mut word, mut bottom, feed) = act else { return Err(Unread::NotHere) };
    let up = retract.1;
    if bottom >= up {
        return Err(Unread::NotHere);
    }

    let mut strokes: Vec<Stroke> = Vec::new();
    let mut bad = false;
    loop {
        let mut pause = None;
        let mut act = acts.next().ok_or(Unread::NotHere)?;
        if let Act::Dwell(seconds, nanos) = act {
            pause = Some((seconds, nanos));
            act = acts.next().ok_or(Unread::NotHere)?;
        }
        match act {
            Act::Rapid(out, level) if level > bottom => {
                let mut next = acts.clone();
                let more =
                    if strokes.len() < reading.strokes { again(&mut next, level, bottom) } else { None };
                match more {
                    Some((between, cut, to, rate))
                        if !matches!(between, Between::Up { .. }) || level < up =>
                    {
                        bad |= matches!(between, Between::Out { .. }) && level != up;
                        bad |= !same(rate, feed);
                        strokes.push(Stroke { bottom, pause: pause.map(|p| p.1), between });
                        (word, bottom) = (cut, to);
                        *acts = next;
                    }
                    Some(_) | None => {
                        let depth = (word, bottom);
                        let found = Found { to, from, retract, depth, out: (out, level), feed, dwell: pause };
                        return match found.drilled(&strokes, bad, acts) {
                            Some(hole) => finish(hole, plane, acts),
                            None => Err(Unread::NoCycle),
                        };
                    }
                }
            }
            Act::Cut(out, level, rate_out) if level > bottom => {
                let mut next = acts.clone();
                if let Some((cut, to, rate)) = deeper(&mut next, bottom)
                    && level < up
                    && strokes.len() < reading.strokes
                {
                    bad |= !same(rate, feed) || !same(rate_out, feed);
                    let between = Between::Up { to: level, at_feed: true };
                    strokes.push(Stroke { bottom, pause: pause.map(|p| p.1), between });
                    (word, bottom) = (cut, to);
                    *acts = next;
                    continue;
                }
                if level != up || !strokes.is_empty() {
                    return Err(Unread::NoCycle);
                }
                let mut out = (out, level);
                let mut left_by_cut = true;
                let mut next = acts.clone();
                if reading.rapid_out
                    && let Some(Act::Rapid(word, level)) = next.next()
                    && level > up
                {
                    out = (word, level);
                    left_by_cut = false;
                    *acts = next;
                }
                let feed_out = if same(rate_out, feed) { None } else { rate_out };
                let kind = CycleKind::Bore {
                    dwell: pause.map(|p| p.0),
                    feed_out: feed_out.map(Expr::from),
                    to_level: false,
                };
                let depth = (word, bottom);
                let found = Found { to, from, retract, depth, out, feed, dwell: None };
                return finish(Hole { left_by_cut, ..found.hole(kind, acts) }, plane, acts);
            }
            Act::Aside(_) | Act::Rapid(..) | Act::Cut(..) | Act::Dwell(..) => {
                return Err(if strokes.is_empty() { Unread::NotHere } else { Unread::NoCycle });
            }
        }
    }
}

/// A hole that is made where the tool is says where that is.
fn finish(mut hole: Hole, plane: Plane, acts: &Acts<'_>) -> Result<Hole, Unread> {
    let (first, second, _) = plane.axes();
    if hole.to.is_empty() {
        for axis in [first, second] {
            hole.to.set(axis, acts.here(axis).ok_or(Unread::NotHere)?);
        }
    }
    Ok(hole)
}

/// After a rapid up to `level`: back into the hole, and deeper.
fn again(acts: &mut Acts<'_>, level: Nanos, bottom: Nanos) -> Option<(Between, Coord, Nanos, Option<Num>)> {
    let mut act = acts.next()?;
    let mut settle = None;
    if let Act::Dwell(_, nanos) = act {
        settle = Some(nanos);
        act = acts.next()?;
    }
    match act {
        Act::Rapid(_, back_to) if back_to < level && back_to >= bottom => {
            let (word, to, rate) = deeper(acts, bottom)?;
            Some((Between::Out { back_to, settle }, word, to, rate))
        }
        Act::Cut(word, to, rate) if to < bottom && settle.is_none() => {
            Some((Between::Up { to: level, at_feed: false }, word, to, rate))
        }
        Act::Aside(_) | Act::Rapid(..) | Act::Cut(..) | Act::Dwell(..) => None,
    }
}

/// A cut below the last bottom.
fn deeper(acts: &mut Acts<'_>, bottom: Nanos) -> Option<(Coord, Nanos, Option<Num>)> {
    match acts.next()? {
        Act::Cut(word, to, rate) if to < bottom => Some((word, to, rate)),
        Act::Aside(_) | Act::Rapid(..) | Act::Cut(..) | Act::Dwell(..) => None,
    }
}

/// What is known of a hole before its kind is.
struct Found {
    to: Point,
    from: Nanos,
    retract: (Coord, Nanos),
    depth: (Coord, Nanos),
    out: (Coord, Nanos),
    feed: Option<Num>,
    dwell: Option<(Expr, Nanos)>,
}

impl Found {
    fn hole(self, kind: CycleKind, acts: &Acts<'_>) -> Hole {
        let Found { to, from, retract, depth, out, feed, dwell: _ } = self;
        let feed_said = acts.feed_said;
        Hole { to, from, retract, depth, out, kind, feed, feed_said, left_by_cut: false, strokes: 0 }
    }

    /// A hole that is left by rapid: drilled, in one stroke or several.
    fn drilled(mut self, strokes: &[Stroke], bad: bool, acts: &Acts<'_>) -> Option<Hole> {
        let dwell = self.dwell.take().map(|d| d.0);
        let Some(one) = strokes.first() else {
            let kind = match dwell {
                Some(dwell) => CycleKind::DrillDwell { dwell },
                None => CycleKind::Drill,
            };
            return Some(self.hole(kind, acts));
        };
        if bad {
            return None;
        }
        let unit = acts.unit();
        let length = |nanos: Nanos| Expr::from(exact(nanos, unit));
        let seconds = |nanos: Nanos| Expr::from(exact(nanos, Unit::Second));
        let Pecks { peck, first, less } = self.pecks(strokes)?;
        let (peck, first, less) = (length(peck), first.map(length), less.map(length));
        let alike = |stroke: &Stroke| {
            stroke.pause == one.pause && above(stroke) == above(one) && shape(stroke) == shape(one)
        };
        if !strokes.iter().all(alike) {
            return None;
        }
        let pause = one.pause.map(seconds);
        let kind = match &one.between {
            Between::Out { settle, .. } => CycleKind::DrillPeck {
                peck,
                first,
                less,
                clearance: Clearance::Stated(length(above(one))),
                pause,
                settle: settle.map(seconds),
                dwell,
            },
            Between::Up { at_feed, .. } => CycleKind::DrillBreak {
                peck,
                first,
                less,
                lift: Clearance::Stated(length(above(one))),
                lift_at_feed: *at_feed,
                pause,
                dwell,
            },
        };
        Some(Hole { strokes: strokes.len(), ..self.hole(kind, acts) })
    }

    /// The rule that the pecks follow; the last one is what remains.
    fn pecks(&self, strokes: &[Stroke]) -> Option<Pecks> {
        let mut depths = Vec::with_capacity(strokes.len() + 1);
        let mut last = self.retract.1;
        for bottom in strokes.iter().map(|s| s.bottom).chain([self.depth.1]) {
            depths.push(last - bottom);
            last = bottom;
        }
        let (rest, whole) = depths.split_last()?;
        alike(whole, *rest).or_else(|| shrinking(whole, *rest))
    }
}

/// How deep pecks are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Pecks {
    /// Depth of each; where they shrink, the least.
    peck: Nanos,
    /// Of the first one, where it is another.
    first: Option<Nanos>,
    /// How much less each is than the one before it.
    less: Option<Nanos>,
}

/// Pecks of one depth after the first one, and what remains.
fn alike(whole: &[Nanos], rest: Nanos) -> Option<Pecks> {
    let (first, further) = whole.split_first()?;
    let peck = match further {
        [] => rest.max(*first),
        [peck, others @ ..] if others.iter().all(|d| d == peck) && rest <= *peck => *peck,
        _ => return None,
    };
    Some(Pecks { peck, first: (*first != peck).then_some(*first), less: None })
}

/// Pecks each of which is less than the one before by the same, down to a least one, and what remains.
fn shrinking(whole: &[Nanos], rest: Nanos) -> Option<Pecks> {
    let [first, second, ..] = *whole else { return None };
    let less = first.checked_sub(second).filter(|less| *less > 0)?;
    // The first one that does not follow is the least; of pecks that all do, the one that would come next is.
    let floor = whole.windows(2).find(|pair| pair[1] != pair[0] - less).map(|pair| pair[1]);
    let peck = floor.unwrap_or_else(|| rest.max(whole[whole.len() - 1] - less));
    let follows = whole.windows(2).all(|pair| pair[1] == next_peck(pair[0], peck, Some(less)));
    let remains = rest <= next_peck(whole[whole.len() - 1], peck, Some(less));
    (peck > 0 && follows && remains).then_some(Pecks { peck, first: Some(first), less: Some(less) })
}

/// How far above its bottom a stroke begins again.
fn above(stroke: &Stroke) -> Nanos {
    let to = match stroke.between {
        Between::Out { back_to, .. } => back_to,
        Between::Up { to, .. } => to,
    };
    to - stroke.bottom
}

/// What else must be the same of all strokes.
fn shape(stroke: &Stroke) -> (bool, Option<Nanos>) {
    match stroke.between {
        Between::Out { settle, .. } => (false, settle),
        Between::Up { at_feed, .. } => (at_feed, None),
    }
}
