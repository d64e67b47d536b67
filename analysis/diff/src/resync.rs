//! Two streams of records held side by side, and brought together again where they part.
//!
//! While the streams agree, they are compared one by one and let go. Where they part, ever larger windows
//! of both are aligned: exactly while they are small ([`myers`]), then between anchors. Where neither the
//! place nor the active shift brings them together, the ways of their tools may: then a whole tail is
//! shifted, as by an insertion into an incremental program. Not here: what the differences are called.

use std::collections::HashMap;

use ncc_ir::canon::AXES;
use ncc_ir::expr::num::Nanos;

use crate::align::{Run, between_anchors, myers};
use crate::change::Collector;
use crate::measure::{Measure, Shift};
use crate::record::Record;
use crate::tape::Tape;

/// Windows that are aligned exactly, and how many records may be without a partner in them.
const WINDOWS: [(usize, usize); 3] = [(64, 128), (512, 1024), (4096, 1500)];
/// Windows that are aligned between anchors; the last is what is kept of a stream at most.
const WIDE: [usize; 2] = [1 << 16, 1 << 21];
/// So many pairs in a row show that two streams have come together, while there is more to come.
const TOGETHER: usize = 8;

/// How two streams are compared.
#[derive(Clone, Copy, Debug)]
pub struct Rules {
    /// What counts as the same.
    pub measure: Measure,
    /// Whether a tail may be found shifted.
    pub shifts: bool,
}

/// Both streams, and how they stand to each other.
struct Both<'t, 'c> {
    rules: Rules,
    tapes: [Tape<'t>; 2],
    shift: Shift,
    /// In which respects pairs of styles differ.
    known: HashMap<(u32, u32), u8>,
    last: ((u32, u32), u8),
    into: &'c mut Collector,
}

/// Holds two streams side by side; what differs goes to the collector.
pub fn compare(a: Tape, b: Tape, rules: Rules, into: &mut Collector) {
    let none = (u32::MAX, u32::MAX);
    let mut both =
        Both { rules, tapes: [a, b], shift: Shift::default(), known: HashMap::new(), last: (none, 0), into };
    while both.alike() {
        both.part();
    }
    let [a, b] = &both.tapes;
    both.into.end([a, b]);
}

/// How two windows fit together.
struct Fit {
    runs: Vec<Run>,
    /// Records that are done with.
    take: [usize; 2],
    /// The shift behind them.
    shift: Shift,
}

impl Both<'_, '_> {
    /// Lets go what agrees; whether there is something that does not.
    fn alike(&mut self) -> bool {
        loop {
            let there = [self.tapes[0].fill(1), self.tapes[1].fill(1)];
            if there == [0, 0] {
                return false;
            }
            let many = there[0].min(there[1]);
            let mut same = 0;
            while same < many {
                let (a, b) = (self.tapes[0].window()[same], self.tapes[1].window()[same]);
                if !self.rules.measure.same(&a, &b, &self.shift) {
                    break;
                }
                self.pair(&a, &b);
                same += 1;
            }
            self.tapes[0].advance(same);
            self.tapes[1].advance(same);
            if same == many && many > 0 {
                continue;
            }
            // A move that rounding has brought to nothing on one side.
            let stays = |one: usize| {
                let (tape, other) = (&self.tapes[one], &self.tapes[1 - one]);
                let Some(head) = tape.window().first() else { return false };
                let by = |axis: usize| if one == 0 { -self.shift.by[axis] } else { self.shift.by[axis] };
                let at = std::array::from_fn(|axis| other.position[axis] + by(axis));
                tape.styles.get(head.style as usize).is_some_and(|s| self.rules.measure.stays(head, s, &at))
            };
            match (stays(0), stays(1)) {
                (true, _) => self.tapes[0].advance(1),
                (false, true) => self.tapes[1].advance(1),
                (false, false) => return true,
            }
        }
    }

    /// A pair that is the same event at the same place.
    #[inline]
    fn pair(&mut self, a: &Record, b: &Record) {
        let styles = (a.style, b.style);
        if self.last.0 != styles {
            let [first, second] = &self.tapes;
            let bits = *self.known.entry(styles).or_insert_with(|| {
                match (first.styles.get(a.style as usize), second.styles.get(b.style as usize)) {
                    (Some(s), Some(t)) => self.rules.measure.styles(s, t, a.inch() || b.inch()),
                    (None, _) | (_, None) => 0,
                }
            });
            self.last = (styles, bits);
        }
        let [first, second] = &self.tapes;
        self.into.pair(a, b, self.last.1, [first, second]);
    }

    /// The streams part: finds where they come together again, and tells what is between.
    fn part(&mut self) {
        let fit = self.fit();
        let mut at = [0, 0];
        let end = Run { a: fit.take[0], b: fit.take[1], len: 0 };
        for run in fit.runs.iter().chain([&end]) {
            self.gap(at, [run.a, run.b]);
            for i in 0..run.len {
                let (a, b) = (self.tapes[0].window()[run.a + i], self.tapes[1].window()[run.b + i]);
                self.pair(&a, &b);
            }
            at = [run.a + run.len, run.b + run.len];
        }
        self.tapes[0].advance(fit.take[0]);
        self.tapes[1].advance(fit.take[1]);
        if fit.shift != self.shift {
            self.shift = fit.shift;
            let heads = [0, 1].map(|side| self.tapes[side].window().first().copied());
            let [first, second] = &self.tapes;
            self.into.shifted(&self.shift, heads, [first, second]);
        }
    }

    fn gap(&mut self, from: [usize; 2], to: [usize; 2]) {
        let [first, second] = &self.tapes;
        let (a, b) = (&first.window()[from[0]..to[0]], &second.window()[from[1]..to[1]]);
        if a.is_empty() && b.is_empty() {
            return;
        }
        // Moves that rounding has brought to nothing are none.
        let left = |side: usize| {
            let tape = &self.tapes[side];
            let records = &tape.window()[from[side]..to[side]];
            let before = from[side].checked_sub(1).and_then(|i| tape.window().get(i));
            let mut stands = before.map_or(tape.position, |record| tape.place(record));
            let mut kept = Vec::with_capacity(records.len());
            for record in records {
                let style = tape.styles.get(record.style as usize);
                if style.is_some_and(|style| self.rules.measure.stays(record, style, &stands)) {
                    // The next is measured from the same place: many short moves are a way.
                    continue;
                }
                kept.push(*record);
                stands = tape.place(record);
            }
            kept
        };
        let (a, b) = (left(0), left(1));
        self.into.gap(&a, &b, &self.rules.measure, &self.shift, [first, second]);
    }

    /// Finds how windows of both streams fit together.
    fn fit(&mut self) -> Fit {
        for (wide, edits) in WINDOWS {
            let [n, m, complete] = self.windows(wide);
            let heads = [0, 1].map(|side| self.tapes[side].window().first());
            let incremental = heads.iter().flatten().any(|record| record.incremental());
            if incremental && let Some(fit) = self.by_way(n, m, complete > 0, edits) {
                return fit;
            }
            for shift in self.shifts() {
                let runs = self.exact(n, m, edits, &shift);
                if let Some(fit) = runs.and_then(|runs| accepted(runs, n, m, complete > 0, shift)) {
                    return fit;
                }
            }
        }
        let (wide, edits) = WINDOWS[WINDOWS.len() - 1];
        let [n, m, complete] = self.windows(wide);
        if let Some(fit) = self.by_way(n, m, complete > 0, edits) {
            return fit;
        }
        for wide in WIDE {
            let [n, m, complete] = self.windows(wide);
            for shift in self.shifts() {
                let runs = self.anchored(n, m, &shift);
                let paired: usize = runs.iter().map(|run| run.len).sum();
                // Of two streams that never meet again, what little they share is reported at the very end.
                if paired * 8 >= n.min(m)
                    && let Some(fit) = accepted(runs, n, m, complete > 0, shift)
                {
                    return fit;
                }
            }
            if let Some(fit) = self.by_way_anchored(n, m) {
                return fit;
            }
        }
        let [n, m, complete] = self.windows(WIDE[WIDE.len() - 1]);
        let runs = self.anchored(n, m, &self.shift);
        self.into.lost |= complete == 0;
        Fit { runs, take: [n, m], shift: self.shift }
    }

    /// Fills both windows; their lengths, and whether there is nothing behind them.
    fn windows(&mut self, wide: usize) -> [usize; 3] {
        let there = [self.tapes[0].fill(wide), self.tapes[1].fill(wide)];
        let complete = (0..2).all(|side| self.tapes[side].over && there[side] <= wide);
        [there[0].min(wide), there[1].min(wide), usize::from(complete)]
    }

    /// Shifts under which the streams may come together: the active one, and none.
    fn shifts(&self) -> Vec<Shift> {
        let mut all = vec![self.shift];
        if self.shift.on {
            all.push(Shift::default());
        }
        all
    }

    fn exact(&self, n: usize, m: usize, edits: usize, shift: &Shift) -> Option<Vec<Run>> {
        let (a, b) = (self.tapes[0].window(), self.tapes[1].window());
        let measure = &self.rules.measure;
        myers(n, m, edits, &mut |i, j| measure.same(&a[i], &b[j], shift))
    }

    /// A tail that is shifted: found by the ways that the tools go.
    fn by_way(&self, n: usize, m: usize, complete: bool, edits: usize) -> Option<Fit> {
        if !self.rules.shifts {
            return None;
        }
        let (a, b) = (self.tapes[0].window(), self.tapes[1].window());
        let from = |side: usize, i: usize| self.before(side, i);
        let measure = &self.rules.measure;
        let runs =
            myers(n, m, edits, &mut |i, j| measure.same_way(&a[i], &b[j], [&from(0, i), &from(1, j)]))?;
        let run = runs.into_iter().find(|run| {
            let moves = a[run.a..run.a + run.len].iter().filter(|record| record.what.moves()).count();
            let to_the_end = complete && run.a + run.len == n && run.b + run.len == m;
            (run.len >= TOGETHER && moves >= TOGETHER / 2) || (to_the_end && moves > 1)
        })?;
        self.behind(run)
    }

    /// The same, for windows that are too wide to be aligned exactly.
    fn by_way_anchored(&self, n: usize, m: usize) -> Option<Fit> {
        if !self.rules.shifts {
            return None;
        }
        let (a, b) = (self.tapes[0].window(), self.tapes[1].window());
        let measure = &self.rules.measure;
        let keys = [0, 1].map(|side| {
            let (records, many) = if side == 0 { (a, n) } else { (b, m) };
            let way = |i: usize| {
                let from = self.before(side, i);
                let record = &records[i];
                key(
                    record,
                    &Shift { by: std::array::from_fn(|x| if x < 3 { from[x] } else { 0 }), on: true },
                    measure,
                )
            };
            // One way alone is found in many places, two in a row are not.
            let mut keys: Vec<u64> = (0..many).map(way).collect();
            for i in 1..many {
                keys[i - 1] = keys[i - 1].rotate_left(17) ^ keys[i].wrapping_mul(0x9e37_79b9_7f4a_7c15);
            }
            keys
        });
        let runs = between_anchors([&keys[0], &keys[1]], &mut |i, j| {
            measure.same_way(&a[i], &b[j], [&self.before(0, i), &self.before(1, j)])
        });
        let run = runs.into_iter().find(|run| run.len >= 4 * TOGETHER)?;
        self.behind(run)
    }

    /// The fit that begins at a run of pairs with equal moves: the run's shift is active from its first pair on. `None` if
    /// that pair is the first of both windows and differs under the shift: the streams would not go on.
    fn behind(&self, run: Run) -> Option<Fit> {
        let (a, b) = (self.tapes[0].window()[run.a], self.tapes[1].window()[run.b]);
        let by: [Nanos; AXES] =
            std::array::from_fn(|axis| if axis < 3 { b.end[axis].wrapping_sub(a.end[axis]) } else { 0 });
        let most = self.rules.measure.length(&a, &b);
        let on = by.iter().any(|by| by.abs() > most);
        let shift = if on { Shift { by, on } } else { Shift::default() };
        // It must bring the streams on: ends agree, centres of arcs may still not.
        if (run.a, run.b) == (0, 0) && !self.rules.measure.same(&a, &b, &shift) {
            return None;
        }
        // Under the shift so far, there may be pairs before it.
        let before = self.exact(run.a, run.b, 1024, &self.shift).unwrap_or_default();
        Some(Fit { runs: before, take: [run.a, run.b], shift })
    }

    /// Where the tool stood before a record of the window.
    fn before(&self, side: usize, i: usize) -> [Nanos; 3] {
        let tape = &self.tapes[side];
        match i.checked_sub(1).and_then(|i| tape.window().get(i)) {
            Some(record) => record.end,
            None => [tape.position[0], tape.position[1], tape.position[2]],
        }
    }

    fn anchored(&self, n: usize, m: usize, shift: &Shift) -> Vec<Run> {
        let (a, b) = (self.tapes[0].window(), self.tapes[1].window());
        let measure = &self.rules.measure;
        let none = Shift::default();
        let first: Vec<u64> = a[..n].iter().map(|record| key(record, &none, measure)).collect();
        let second: Vec<u64> = b[..m].iter().map(|record| key(record, shift, measure)).collect();
        between_anchors([&first, &second], &mut |i, j| measure.same(&a[i], &b[j], shift))
    }
}

/// What of an alignment can be relied upon: all of it, if there is nothing behind; else up to where the
/// streams go together long enough.
fn accepted(runs: Vec<Run>, n: usize, m: usize, complete: bool, shift: Shift) -> Option<Fit> {
    if complete {
        return Some(Fit { runs, take: [n, m], shift });
    }
    let at = runs.iter().position(|run| run.len >= TOGETHER)?;
    let last = runs[at];
    let runs = runs[..=at].to_vec();
    Some(Fit { runs, take: [last.a + last.len, last.b + last.len], shift })
}

/// A value that records have in common which are the same; most that are the same within the tolerance
/// have it in common too.
fn key(record: &Record, shift: &Shift, measure: &Measure) -> u64 {
    let unit = (measure.lengths[usize::from(record.inch())] * 4).max(1);
    let cell = |value: Nanos, by: Nanos| (value.wrapping_sub(by).wrapping_add(unit / 2)).div_euclid(unit);
    let mut h = record.what as u64;
    let mut mix = |value: i64| {
        h = (h ^ value as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        h ^= h >> 29;
    };
    match record.what.moves() {
        true => (0..3).for_each(|axis| mix(cell(record.end[axis], shift.by[axis]))),
        false => mix(record.more[0]),
    }
    h
}
