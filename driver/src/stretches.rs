//! Long stretches of straight moves of a program that is kept whole: packed before its steps, with statements of them left
//! in front and behind that stand for them.
//!
//! ```text
//! 100,000 moves    some moves | LINES of the rest | some moves
//! ```
//!
//! Those in front have each kind of word that the stretch has: a step that would change one of its moves changes one of
//! them, too, which is looked for ([`stand`]). Those behind say each axis, and the feed, that it says: what follows the tool
//! may go past it.
//!
//! Not here: how moves are packed ([`ncc_ir::program::packing`]).

use std::ops::Range;
use std::sync::Arc;

use ncc_ir::canon::{Axis, Distance};
use ncc_ir::expr::Expr;
use ncc_ir::program::packed::PackedLines;
use ncc_ir::program::packing::packs;
use ncc_ir::program::{Op, Stmt};
use ncc_ir::source::Span;

/// Moves of a stretch of which fewer are not worth it.
pub const SHORTEST: usize = 64;

/// Moves in front that may be changed, as they are the first.
const LEAD: usize = 4;

/// Moves on each side that must not be.
const PROBES: usize = 4;

/// Moves behind, where the stretch is short.
const SHORT_TAIL: usize = 512;

/// A stretch that is packed, and what stands for it.
#[derive(Debug)]
pub(crate) struct Stretch {
    lines: Arc<PackedLines>,
    before: Vec<Stmt>,
    behind: Vec<Stmt>,
}

/// Packs the stretches of a body, of so many moves or more.
pub(crate) fn pack(body: &mut Vec<Stmt>, shortest: usize) -> Vec<Stretch> {
    let mut found = Vec::new();
    let mut made = Vec::new();
    let mut from = 0;
    for Place { probed, packed } in places(body, shortest) {
        let Some(lines) = PackedLines::new(&body[packed.clone()]) else { continue };
        let lines = Arc::new(lines);
        let behind = &body[packed.end..body.len().min(packed.end + PROBES)];
        let before = body[probed..packed.start].to_vec();
        found.push(Stretch { lines: Arc::clone(&lines), before, behind: behind.to_vec() });
        made.extend(body[from..packed.start].iter_mut().map(take));
        let first = &body[packed.start];
        made.push(Stmt::new(first.span, Op::Lines(lines)));
        from = packed.end;
    }
    if !found.is_empty() {
        made.extend(body[from..].iter_mut().map(take));
        *body = made;
    }
    found
}

fn take(stmt: &mut Stmt) -> Stmt {
    std::mem::replace(stmt, Stmt::new(Span::default(), Op::Blank))
}

/// Puts the moves of packed stretches in their places again.
pub(crate) fn unpack(body: &mut Vec<Stmt>) {
    if body.iter().any(|stmt| matches!(stmt.op, Op::Lines(_))) {
        let packed = std::mem::take(body);
        for stmt in packed {
            match &stmt.op {
                Op::Lines(lines) => body.extend(lines.unpack()),
                _ => body.push(stmt),
            }
        }
    }
}

/// Whether all stretches are in a body, in their order, and what stands for each is as it was.
pub(crate) fn stand(stretches: &[Stretch], body: &[Stmt]) -> bool {
    let same = |own: &Stmt, there: &Stmt, lines: &PackedLines| {
        let mut own = own.clone();
        lines.settle_as_these(&mut own);
        own.op == there.op && own.skip == there.skip && own.joined == there.joined
    };
    let alike = |own: &[Stmt], there: Option<&[Stmt]>, lines: &PackedLines| {
        there.is_some_and(|there| own.iter().zip(there).all(|(own, there)| same(own, there, lines)))
    };
    let places = body.iter().enumerate().filter_map(|(at, stmt)| match &stmt.op {
        Op::Lines(lines) => Some((at, lines)),
        _ => None,
    });
    let mut left = stretches.iter();
    places.into_iter().all(|(at, lines)| {
        left.next().is_some_and(|own| {
            let before = at.checked_sub(own.before.len()).map(|from| &body[from..at]);
            let behind = body.get(at + 1..at + 1 + own.behind.len());
            own.lines.are_moves_of(lines)
                && !lines.are_increments()
                && alike(&own.before, before, lines)
                && alike(&own.behind, behind, lines)
        })
    }) && left.next().is_none()
}

/// Whether a place is among those that stand for a stretch.
pub(crate) fn concerns(stretches: &[Stretch], at: Span) -> bool {
    let own = |stmt: &Stmt| stmt.span.start <= at.start && at.start < stmt.span.end;
    stretches.iter().any(|stretch| stretch.before.iter().chain(&stretch.behind).any(own))
}

/// A stretch of a body: where what stands for it begins, and what is packed.
struct Place {
    probed: usize,
    packed: Range<usize>,
}

/// What a statement has, a bit each: what the steps may ask of it.
fn kinds(stmt: &Stmt) -> u32 {
    let (words, feed) = match &stmt.op {
        Op::StraightFeed(to) => (&to.to, true),
        Op::StraightTraverse(to) => (&to.to, false),
        _ => return 1 << 6,
    };
    let mut bits = 0;
    for (axis, word) in words.axes[..Axis::A as usize].iter().enumerate() {
        let Some(word) = word else { continue };
        bits |= if feed { 1 } else { 8 } << axis;
        bits |= match word.distance.known() {
            None => 1 << 7,
            Some(Distance::Absolute) => 1 << 8,
            Some(Distance::Incremental) => 1 << 9,
        };
        if let Expr::Num(num) = &word.value {
            bits |= 1 << (10 + num.unit as u32);
        }
    }
    bits
}

fn places(body: &[Stmt], shortest: usize) -> Vec<Place> {
    let mut found = Vec::new();
    let mut from = 0;
    while from < body.len() {
        let run = body[from..].iter().take_while(|stmt| packs(stmt)).count();
        let end = from + run;
        while let Some((place, next)) = next_place(body, from..end, shortest) {
            found.extend(place);
            from = next;
        }
        from = end + 1;
    }
    found
}

/// The first stretch of a run of moves, if there is one there, and where the next may begin.
fn next_place(body: &[Stmt], run: Range<usize>, shortest: usize) -> Option<(Option<Place>, usize)> {
    let probed = run.start + LEAD;
    let mut start = probed + PROBES;
    if start.saturating_add(shortest) > run.end {
        return None;
    }
    let mut known = body[probed..start].iter().fold(0, |bits, stmt| bits | kinds(stmt));
    let mut end = start;
    while end < run.end {
        let more = kinds(&body[end]) & !known;
        if more != 0 {
            if end - start >= shortest {
                break;
            }
            known |= more;
            start = end + 1;
        }
        end += 1;
    }
    while start < end && body[start].joined {
        start += 1;
    }
    loop {
        let tail = tail(body, start..end);
        if tail < start.saturating_add(shortest) {
            return Some((None, end));
        }
        if end - tail <= SHORT_TAIL.max((end - start) / 8) {
            return Some((Some(Place { probed, packed: start..tail }), end));
        }
        // What is said seldom begins the next stretch.
        end = tail;
    }
}

/// Where the moves begin that say all again that a stretch says.
fn tail(body: &[Stmt], stretch: Range<usize>) -> usize {
    let mut last = [None; 4];
    for (at, stmt) in body[stretch.clone()].iter().enumerate() {
        let at = stretch.start + at;
        match &stmt.op {
            Op::StraightFeed(to) | Op::StraightTraverse(to) => {
                let axes = to.to.axes[..Axis::A as usize].iter().enumerate();
                axes.filter(|(_, word)| word.is_some()).for_each(|(axis, _)| last[axis] = Some(at));
            }
            _ => last[3] = Some(at),
        }
    }
    let least = last.into_iter().flatten().min().unwrap_or(stretch.end);
    let mut tail = least.min(stretch.end.saturating_sub(PROBES)).max(stretch.start);
    while tail > stretch.start && body[tail].joined {
        tail -= 1;
    }
    tail
}

#[cfg(test)]
mod tests {
    use ncc_dialects::{Settings, builtin};
    use ncc_frontends::{Batch, Reader};
    use ncc_ir::canon::Fact;

    use super::*;

    fn read(text: &str) -> Vec<Stmt> {
        let mut reader = Reader::new(Settings::new(builtin("fanuc").expect("a built-in dialect")), true);
        let mut batch = Batch::default();
        reader.read(text.as_bytes(), 0, &mut batch);
        batch.stmts
    }

    const HEAD: &str = "G21 G17 G90 G94 G54\nG00 X0. Y0. Z5.\nG01 Z-1. F100.\n";

    /// What is packed and unpacked is as it was, and what is behind a stretch says all that it says.
    #[test]
    fn what_stands_behind_a_stretch_says_all_of_it() {
        let mut text = HEAD.to_owned();
        for n in 0..3000 {
            let feed = if n % 50 == 0 { format!(" F{}.", 100 + n) } else { String::new() };
            let z = if n % 40 == 3 { format!(" Z-{}.", n % 9) } else { String::new() };
            let rapid = if n == 1500 { "G00 Z5.\nX3.\nG01 Z-1.\n" } else { "" };
            text += &format!("{rapid}X{n}.5 Y{}.{z}{feed}\n", n % 7);
        }
        let own = read(&text);
        let mut body = own.clone();
        let stretches = pack(&mut body, SHORTEST);
        assert!(stretches.len() >= 2 && body.len() < own.len() / 4, "{} {}", stretches.len(), body.len());
        assert!(stand(&stretches, &body));
        for (at, stmt) in body.iter().enumerate() {
            let Op::Lines(lines) = &stmt.op else { continue };
            let all: Vec<Stmt> = lines.unpack().collect();
            let said = |stmts: &[Stmt]| stmts.iter().fold(0, |bits, stmt| bits | kinds(stmt) & 0x7F);
            let axes = |bits: u32| bits & 7 | bits >> 3 & 7 | bits & 1 << 6;
            let behind = body[at + 1..].iter().take_while(|stmt| !matches!(stmt.op, Op::Lines(_)));
            let behind: Vec<Stmt> = behind.take_while(|stmt| packs(stmt)).cloned().collect();
            assert_eq!(axes(said(&all)) & !axes(said(&behind)), 0);
            assert_eq!(said(&all) & !said(&body[..at]), 0);
        }
        unpack(&mut body);
        assert_eq!(body, own);
    }

    /// Increments are no stretch, whether the text says that they are or what is in force where it is executed.
    #[test]
    fn increments_are_not_packed() {
        let moves: String = (0..200).map(|n| format!("X{n}.5\n")).collect();
        let mut body = read(&format!("{HEAD}G91\n{moves}"));
        assert!(pack(&mut body, SHORTEST).is_empty());
        let mut body = read(&format!("{HEAD}{moves}"));
        let words = body.iter_mut().filter_map(|stmt| match &mut stmt.op {
            Op::StraightFeed(to) => Some(to.to.axes.iter_mut().flatten()),
            _ => None,
        });
        words.flatten().for_each(|word| word.distance = Fact::Entry);
        let stretches = pack(&mut body, SHORTEST);
        assert!(!stretches.is_empty() && stand(&stretches, &body));
        for stmt in &mut body {
            match &mut stmt.op {
                Op::Lines(lines) => Arc::make_mut(lines).settle(None, Some(Distance::Incremental)),
                Op::StraightFeed(to) => to.to.axes.iter_mut().flatten().for_each(|word| {
                    word.distance = Fact::Known(Distance::Incremental);
                }),
                _ => {}
            }
        }
        assert!(!stand(&stretches, &body));
    }

    #[test]
    fn a_change_beside_a_stretch_is_seen() {
        let moves: String = (0..200).map(|n| format!("X{n}.5\n")).collect();
        let mut body = read(&format!("{HEAD}{moves}"));
        let stretches = pack(&mut body, SHORTEST);
        let at = body.iter().position(|stmt| matches!(stmt.op, Op::Lines(_))).expect("a stretch");
        for place in [at - 1, at + 1] {
            let mut other = body.clone();
            other[place].op = Op::Blank;
            assert!(!stand(&stretches, &other));
        }
        body.remove(at);
        assert!(!stand(&stretches, &body));
    }
}
